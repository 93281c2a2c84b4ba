//! Whatever the main job takes, from a file or from standard input.
