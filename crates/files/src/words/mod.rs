//! Findings in words: what was found, where, and what to do, written once for reports, the command
//! and the editor.
//!
//! The kernel gives kinds with their numbers and places; units and digits are chosen here.

mod bends;
mod divided;
mod finding;
mod healed;
mod marks;
mod moved;
mod nets;
mod parted;
mod place;
mod points;
mod read;
#[cfg(test)]
mod tests;
mod trims;

pub(crate) use divided::division_sentence;
pub use finding::finding_text;
pub use place::finding_place;
pub use read::read_note_text;
