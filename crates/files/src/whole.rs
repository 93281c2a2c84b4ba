//! Files that are written whole or not at all: under a temporary name in the same folder, then
//! renamed.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// How temporary names begin. A program that is killed leaves them behind.
pub const TEMPORARY: &str = ".sheetwright-";

/// Why a file can't be written, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteError {
    /// What is wrong.
    pub message: String,
    /// The file or folder.
    pub place: String,
    /// What to do.
    pub hint: String,
}

impl WriteError {
    fn new(path: &Path, message: impl Into<String>, hint: impl Into<String>) -> Self {
        let place = path.display().to_string();
        Self { message: message.into(), place, hint: hint.into() }
    }

    fn of(path: &Path, error: &io::Error) -> Self {
        let (message, hint) = match error.kind() {
            io::ErrorKind::PermissionDenied => {
                ("it may not be written".to_owned(), "Check the permissions of the folder.")
            }
            io::ErrorKind::NotFound => {
                ("there is no such folder".to_owned(), "Create it, or check the spelling.")
            }
            io::ErrorKind::StorageFull => {
                ("the disk is full".to_owned(), "Make room, or write to another disk.")
            }
            _ => (format!("it can't be written: {error}"), "Check the path and the disk."),
        };
        Self::new(path, message, hint)
    }
}

impl std::fmt::Display for WriteError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

impl std::error::Error for WriteError {}

/// The folder that files go to.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// The folder of this path, which need not be there yet.
    ///
    /// # Errors
    /// A file has this name.
    pub fn new(path: &Path) -> Result<Self, WriteError> {
        if path.exists() && !path.is_dir() {
            let hint = "Name a folder, or leave the name free for a new one.";
            return Err(WriteError::new(path, "this is no folder", hint));
        }
        Ok(Self { path: path.to_owned() })
    }

    /// Files to be kept together. Creates the folder if need be.
    ///
    /// # Errors
    /// The folder can't be created.
    pub fn batch(&self) -> Result<Batch<'_>, WriteError> {
        let mut created = Vec::new();
        for folder in self.path.ancestors() {
            if folder.as_os_str().is_empty() || folder.exists() {
                break;
            }
            created.push(folder.to_owned());
        }
        // From here on the batch removes what it has created, unless it is kept.
        let batch = Batch { folder: &self.path, files: Vec::new(), created };
        fs::create_dir_all(&self.path).map_err(|error| WriteError::of(&self.path, &error))?;
        Ok(batch)
    }
}

/// Files that get their names together, or go.
#[derive(Debug)]
pub struct Batch<'a> {
    folder: &'a Path,
    files: Vec<(NamedTempFile, PathBuf)>,
    /// Folders that were not there before, the innermost first.
    created: Vec<PathBuf>,
}

impl Batch<'_> {
    /// Writes a file under a temporary name.
    ///
    /// # Errors
    /// It can't be written, or a folder has its name.
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        let path = self.folder.join(name);
        let file = written(self.folder, &path, bytes)?;
        self.files.push((file, path));
        Ok(())
    }

    /// Gives all files their names.
    ///
    /// # Errors
    /// A file can't be renamed; those before it have their names.
    pub fn keep(mut self) -> Result<(), WriteError> {
        for (file, path) in std::mem::take(&mut self.files) {
            renamed(file, &path)?;
            self.created.clear();
        }
        Ok(())
    }
}

impl Drop for Batch<'_> {
    fn drop(&mut self) {
        self.files.clear();
        for folder in &self.created {
            // A folder that something else has come into stays.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Writes one file, into a folder that is there.
///
/// # Errors
/// It can't be written, or a folder has its name.
pub fn write_one(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    renamed(written(folder_of(path), path, bytes)?, path)
}

/// [`write_one`], and waits until the disk has it, so that it outlasts a loss of power.
///
/// # Errors
/// As [`write_one`].
pub fn write_to_last(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let folder = folder_of(path);
    let file = written(folder, path, bytes)?;
    file.as_file().sync_all().map_err(|error| WriteError::of(path, &error))?;
    renamed(file, path)?;
    // The name is the folder's. Where a folder can't be opened as a file, its system sees to it.
    #[cfg(unix)]
    fs::File::open(folder)
        .and_then(|folder| folder.sync_all())
        .map_err(|error| WriteError::of(path, &error))?;
    Ok(())
}

/// The folder that a file lies in.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The bytes under a temporary name in the folder, to become `path`.
fn written(folder: &Path, path: &Path, bytes: &[u8]) -> Result<NamedTempFile, WriteError> {
    if path.is_dir() {
        let hint = "Remove or rename it.";
        return Err(WriteError::new(path, "a folder has this name", hint));
    }
    let failed = |error: io::Error| WriteError::of(path, &error);
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY);
    // A file for others, too, as far as the person's own mask goes; not the private kind.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder).map_err(failed)?;
    file.write_all(bytes).map_err(failed)?;
    Ok(file)
}

fn renamed(file: NamedTempFile, path: &Path) -> Result<(), WriteError> {
    file.persist(path).map(drop).map_err(|error| WriteError::of(path, &error.error))
}
