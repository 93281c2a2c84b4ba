//! What a person edits: a design, and how it is drawn.

pub mod edit;
pub(crate) mod file;
mod history;

pub use history::History;

use sheetwright::design::Design;
pub use sheetwright_files::{Drawing, Mirror, Plan, Reference};

/// Everything that undo brings back and that a file keeps. One plain value, cheap to clone as long
/// as pictures are shared.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// The design, as the command line reads it.
    pub design: Design,
    /// How it is drawn.
    pub drawing: Drawing,
}

impl Default for Document {
    /// An empty one.
    fn default() -> Self {
        let design = Design { name: "untitled".to_owned(), ..Design::default() };
        Self { design, drawing: Drawing::default() }
    }
}
