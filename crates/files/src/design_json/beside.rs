//! Files that a design takes points or triangles from. A design may be untrusted, so they must lie
//! in its own folder or below it.

use crate::names::shown;
use crate::reading::InputError;
use std::path::{Path, PathBuf};

/// A kind of file that a design names by a path.
#[derive(Clone, Copy)]
pub(super) struct Kind {
    /// The word for it in messages.
    pub(super) word: &'static str,
    /// The accepted files, as messages name them.
    pub(super) files: &'static str,
}

/// The file that a path in a design leads to, inside the design's folder.
pub(super) fn file_beside(
    folder: &Path,
    path: &str,
    kind: Kind,
    error: &dyn Fn(String, &str) -> InputError,
) -> Result<PathBuf, InputError> {
    let Kind { word, files } = kind;
    let leaves = || {
        let message = format!("the {word} {} is not inside the design's folder", shown(path));
        let hint = format!(
            "Put the {word} beside the design or below it, and write its path from there, with / \
             between folders."
        );
        error(message, &hint)
    };
    // Refused on every operating system, so that a design means the same on each.
    let parts = || path.split('/');
    let odd = |c: char| c.is_control() || c == '\\' || c == ':';
    if path.contains(odd) || parts().any(|part| part.is_empty() || part == "..") {
        return Err(leaves());
    }
    let missing = |_| {
        let message = format!("there is no {word} {}", shown(path));
        error(message, "Check the path; it begins at the design's folder.")
    };
    // Resolves links first, so that no link leads out of the folder.
    let home = folder.canonicalize().map_err(missing)?;
    let file = home.join(Path::new(path)).canonicalize().map_err(missing)?;
    if !file.starts_with(&home) {
        return Err(leaves());
    }
    // Reading a pipe or a device may block or never end.
    if !file.is_file() {
        return Err(error(format!("{} is no file", shown(path)), &format!("Name {files}.")));
    }
    Ok(file)
}
