//! A document as a file: what the command line reads, and how it is drawn.

use super::Document;
use sheetwright_files::{InputError, read_drawn, write_drawn};
use std::path::Path;

/// The bytes of its file.
pub(crate) fn written(document: &Document) -> Vec<u8> {
    write_drawn(&document.design, &document.drawing)
}

/// The document in a file.
pub(crate) fn read(path: &str, bytes: &[u8]) -> Result<Document, InputError> {
    let (design, drawing) = read_drawn(bytes, path, Path::new(path).parent())?;
    Ok(Document { design, drawing })
}
