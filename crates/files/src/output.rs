//! All files of a made design.
