//! Rules for the source as a whole: the direction of its arrows, no circles of files, readable
//! comments, and options that the command alone names.

#![allow(clippy::unwrap_used)] // tests panic

mod arrows;
mod changelog;
mod circles;
mod comments;
mod flags;
mod sources;
