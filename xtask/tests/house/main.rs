//! What holds for the source as a whole: which way its arrows point, that no files run in circles,
//! how its comments read, and that options of the command are named by the command alone.

#![allow(clippy::unwrap_used)] // tests panic

mod arrows;
mod circles;
mod comments;
mod flags;
mod sources;
