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

/// Files as one archive, stored as they are: PDF and pictures of it are packed already, and the rest
/// is small.
#[cfg(any(target_arch = "wasm32", test))]
fn zip(files: &[sheetwright_files::OutputFile]) -> Vec<u8> {
    use std::io::Write;
    use zip::write::SimpleFileOptions;
    let stored = SimpleFileOptions::default()
        .compression_method(zip::CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::default());
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let mut add = |file: &sheetwright_files::OutputFile| {
        archive.start_file(&file.name[..], stored).is_ok() && archive.write_all(&file.bytes).is_ok()
    };
    // Writing to memory fails for nothing but two files of one name, which outputs don't have.
    let is_whole = files.iter().all(&mut add);
    debug_assert!(is_whole);
    archive.finish().map(std::io::Cursor::into_inner).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_files::OutputFile;
    use std::io::Read;

    #[test]
    fn an_archive_holds_every_file_and_is_the_same_each_time() {
        let file = |name: &str, bytes: &[u8]| OutputFile { name: name.into(), bytes: bytes.into() };
        let files = [file("a.svg", b"<svg/>"), file("b c.dxf", &[0, 255, 7])];
        let bytes = zip(&files);
        assert_eq!(bytes, zip(&files));
        let mut archive = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
        for OutputFile { name, bytes } in &files {
            let mut found = Vec::new();
            archive.by_name(name).unwrap().read_to_end(&mut found).unwrap();
            assert_eq!(found, *bytes);
        }
        assert_eq!(archive.len(), 2);
    }
}
