//! Where a design comes from.

use crate::reading::{InputError, ReadOptions};
use std::path::Path;

/// The origin of a design, and the settings of the caller that replace its own.
pub(super) struct Source<'a> {
    /// The file's name, or `-`.
    pub(super) name: &'a str,
    /// How messages name it.
    pub(super) place: &'a str,
    /// The folder of its tables.
    pub(super) folder: Option<&'a Path>,
    /// The settings of the caller.
    pub(super) options: &'a ReadOptions,
}

impl Source<'_> {
    /// An error at a JSON path.
    pub(super) fn error(
        &self,
        path: &str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> InputError {
        InputError::at(format!("{}: {path}", self.place), message, hint)
    }
}
