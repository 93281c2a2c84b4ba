//! What the editor asks of the system: files to open and to write.
//!
//! [`Dialogs`] is what a window or a browser does about it, and a test instead of both. Answers come
//! later, with the next frames.

#[cfg(target_arch = "wasm32")]
mod browser;
#[cfg(not(target_arch = "wasm32"))]
mod desktop;

#[cfg(target_arch = "wasm32")]
pub use browser::SystemDialogs;
#[cfg(not(target_arch = "wasm32"))]
pub use desktop::SystemDialogs;

use crate::editor::{FileWish, Opened};

/// What came of a wish.
#[derive(Clone, Debug, PartialEq)]
pub enum FileAnswer {
    /// A design or a table was chosen.
    Opened(Opened),
    /// A picture was chosen.
    Picture(Opened),
    /// A design was written.
    Saved {
        /// Where to.
        path: String,
        /// The version of the document that it holds.
        version: u64,
    },
    /// Files were written.
    Exported {
        /// How many.
        count: usize,
        /// Where to.
        folder: String,
    },
    /// It did not work out: why, and what to do.
    Failed(String),
}

/// Who asks the person for files.
pub trait Dialogs {
    /// Does something about a wish, now or later.
    fn grant(&mut self, wish: FileWish);

    /// What has come of wishes since the last call. Whoever changes his mind answers nothing.
    fn answers(&mut self) -> Vec<FileAnswer>;

    /// A file by its path, if there are paths here.
    fn read(&mut self, path: &str) -> Result<Opened, String>;
}
