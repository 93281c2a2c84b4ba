//! Files that are written whole or not at all: under a temporary name in the same folder, then
//! renamed.

use crate::failure::Failure;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The folder that files go to.
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// The folder of this path, which need not be there yet.
    pub(crate) fn new(path: &Path) -> Result<Self, Failure> {
        if path.exists() && !path.is_dir() {
            let hint = "Name a folder, or leave the name free for a new one.";
            return Err(Failure::new("this is no folder", hint).at(path.display().to_string()));
        }
        Ok(Self { path: path.to_owned() })
    }

    /// Files to be kept together. Creates the folder if need be.
    pub(crate) fn batch(&self) -> Result<Batch<'_>, Failure> {
        let mut created = Vec::new();
        for folder in self.path.ancestors() {
            if folder.as_os_str().is_empty() || folder.exists() {
                break;
            }
            created.push(folder.to_owned());
        }
        // From here on the batch removes what it has created, unless it is kept.
        let batch = Batch { folder: &self.path, files: Vec::new(), created };
        fs::create_dir_all(&self.path).map_err(|error| Failure::of_write(&self.path, &error))?;
        Ok(batch)
    }
}

/// Files that get their names together, or go.
pub(crate) struct Batch<'a> {
    folder: &'a Path,
    files: Vec<(NamedTempFile, PathBuf)>,
    /// Folders that were not there before, the innermost first.
    created: Vec<PathBuf>,
}

impl Batch<'_> {
    /// Writes a file under a temporary name.
    pub(crate) fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        let path = self.folder.join(name);
        let file = written(self.folder, &path, bytes)?;
        self.files.push((file, path));
        Ok(())
    }

    /// Gives all files their names.
    pub(crate) fn keep(mut self) -> Result<(), Failure> {
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
pub(crate) fn write_one(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    renamed(written(folder, path, bytes)?, path)
}

/// The bytes under a temporary name in the folder, to become `path`.
fn written(folder: &Path, path: &Path, bytes: &[u8]) -> Result<NamedTempFile, Failure> {
    if path.is_dir() {
        let hint = "Remove or rename it.";
        return Err(Failure::new("a folder has this name", hint).at(path.display().to_string()));
    }
    let failed = |error: std::io::Error| Failure::of_write(path, &error);
    let mut builder = tempfile::Builder::new();
    builder.prefix(".sheetwright-");
    // A file for others, too, as far as the person's own mask goes; not the private kind.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder).map_err(failed)?;
    file.write_all(bytes).map_err(failed)?;
    Ok(file)
}

fn renamed(file: NamedTempFile, path: &Path) -> Result<(), Failure> {
    file.persist(path).map(drop).map_err(|error| Failure::of_write(path, &error.error))
}
