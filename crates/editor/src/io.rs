//! What the editor asks of the system: files to open and to write.
//!
//! [`Dialogs`] is what a window or a browser does about it, and a test instead of both. Answers
//! come later, with the next frames. Where the system has no dialog for files, as on a bare Linux,
//! that is an answer too, and the person types a path instead.

#[cfg(target_arch = "wasm32")]
mod browser;
#[cfg(not(target_arch = "wasm32"))]
mod desktop;

#[cfg(target_arch = "wasm32")]
pub use browser::SystemDialogs;
#[cfg(not(target_arch = "wasm32"))]
pub use desktop::SystemDialogs;

#[cfg(not(target_arch = "wasm32"))]
pub use desktop::read_dropped;

use crate::editor::{Dropped, FileWish, Opened};
use eframe::egui::DroppedFileHandle;

/// The endings of the names of files that are opened.
const OPENED: [&str; 12] =
    ["json", "csv", "tsv", "txt", "xlsx", "ods", "svg", "dxf", "obj", "stl", "ply", "glb"];

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
    /// Files that were dropped on the window were read.
    Dropped(Vec<Dropped>),
    /// The system has no dialog for this wish.
    NoDialog {
        /// The wish.
        wish: FileWish,
        /// The folder that a typed path may begin with.
        folder: String,
    },
    /// It did not work out: why, and what to do.
    Failed(String),
}

/// What came of a wish with a typed path.
#[derive(Clone, Debug, PartialEq)]
pub enum Typed {
    /// It was granted.
    Granted(FileAnswer),
    /// There are files of these names, which would be replaced.
    IsThere {
        /// The path of the first.
        first: String,
        /// How many there are.
        count: usize,
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

    /// Grants a wish with a path that the person has typed. Files that are there are replaced only
    /// where that is said.
    fn grant_at(&mut self, wish: &FileWish, path: &str, replaces: bool) -> Typed;

    /// Reads files that were dropped on the window, now or later.
    fn read_dropped(&mut self, files: Vec<DroppedFileHandle>);

    /// A file by its path, if there are paths here.
    fn read(&mut self, path: &str) -> Result<Opened, String>;
}
