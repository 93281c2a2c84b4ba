//! What holds for the source as a whole: which way its arrows point, that no files run in circles,
//! and how its comments read.

#![allow(clippy::unwrap_used)] // tests panic

mod arrows;
mod circles;
mod comments;
mod sources;
