//! Files that are written whole or not at all. They wait in a temporary folder beside their place
//! (`room`), then all are renamed. If one rename fails, the files before it are restored. One kind
//! of file stands under its name while it is written: a table that grows by whole rows (`growing`).

mod growing;
mod room;

pub use growing::Growing;
pub use room::{TEMPORARY, give_up};

use room::{Room, hold, remove_empty, sweep};
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

/// Why a file can't be written, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteError {
    /// The problem, in words.
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

/// The folder that files are written to.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// The folder of this path, which need not be there yet.
    ///
    /// # Errors
    /// A file has the name of this folder or of one above it, or a link there is broken.
    pub fn new(path: &Path) -> Result<Self, WriteError> {
        for above in path.ancestors().filter(|above| !above.as_os_str().is_empty()) {
            let Ok(found) = above.symlink_metadata() else { continue };
            if found.is_symlink() && !above.exists() {
                return Err(leads_nowhere(above));
            }
            if !above.is_dir() {
                let hint = "Name a folder, or leave the name free for a new one.";
                return Err(WriteError::new(above, "this is no folder", hint));
            }
            break;
        }
        Ok(Self { path: path.to_owned() })
    }

    /// Creates it, and those above it, where they are missing.
    ///
    /// # Errors
    /// It can't be created.
    pub fn create(&self) -> Result<(), WriteError> {
        fs::create_dir_all(&self.path).map_err(|error| WriteError::of(&self.path, &error))
    }

    /// Begins a batch of files that are kept together. Creates the folder if needed, and removes
    /// temporary files that killed programs left in it.
    ///
    /// # Errors
    /// The folder can't be created.
    pub fn batch(&self) -> Result<Batch, WriteError> {
        let is_new = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
        let mut hold = hold();
        let created: Vec<PathBuf> =
            self.path.ancestors().take_while(is_new).map(Path::to_owned).collect();
        let room = fs::create_dir_all(&self.path).and_then(|()| {
            sweep(&self.path);
            Room::new(&mut hold, &self.path)
        });
        let room = room.map_err(|error| {
            remove_empty(&created);
            WriteError::of(&self.path, &error)
        })?;
        room.goes_with(&mut hold, created);
        Ok(Batch { folder: self.path.clone(), room, paths: Vec::new(), lasts: false })
    }
}

fn leads_nowhere(link: &Path) -> WriteError {
    let target = fs::read_link(link).unwrap_or_default();
    let message = format!("this link leads to '{}', which is not there", target.display());
    WriteError::new(link, message, "Create what it leads to, or choose another name.")
}

/// Files that get their final names together, or are removed.
#[derive(Debug)]
pub struct Batch {
    folder: PathBuf,
    room: Room,
    /// The final paths of the files in the room.
    paths: Vec<PathBuf>,
    /// Whether each file is flushed to the disk before it gets its final name.
    lasts: bool,
}

impl Batch {
    /// Writes a file into the room.
    ///
    /// # Errors
    /// It can't be written, or a folder or a read-only file has its name.
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        self.write(self.folder.join(name), bytes)
    }

    fn write(&mut self, path: PathBuf, bytes: &[u8]) -> Result<(), WriteError> {
        check_replaceable(&path)?;
        let _writing = hold();
        let waiting = self.room.new_file(self.paths.len());
        File::create_new(waiting)
            .and_then(|mut file| {
                file.write_all(bytes)?;
                if self.lasts { file.sync_all() } else { Ok(()) }
            })
            .map_err(|error| WriteError::of(&path, &error))?;
        self.paths.push(path);
        Ok(())
    }

    /// Gives all files their final names.
    ///
    /// # Errors
    /// A file can't get its final name. Then all files are as they were before.
    pub fn keep(self) -> Result<(), WriteError> {
        let mut naming = hold();
        self.back_up()?;
        for (n, path) in self.paths.iter().enumerate() {
            if let Err(error) = fs::rename(self.room.new_file(n), path) {
                self.put_back(n);
                return Err(not_replaced(path, &error));
            }
        }
        self.room.goes_with(&mut naming, Vec::new());
        // The folder holds the name, so it is flushed too. Systems that can't open a folder as a
        // file flush it themselves.
        #[cfg(unix)]
        if self.lasts {
            File::open(&self.folder)
                .and_then(|folder| folder.sync_all())
                .map_err(|error| WriteError::of(&self.folder, &error))?;
        }
        Ok(())
    }

    /// Keeps copies of the files that the new files replace. A single file needs none, since its
    /// rename succeeds or changes nothing.
    fn back_up(&self) -> Result<(), WriteError> {
        if self.paths.len() < 2 {
            return Ok(());
        }
        for (n, path) in self.paths.iter().enumerate() {
            if path.symlink_metadata().is_ok() {
                let old = self.room.old_file(n);
                // Not every file system has hard links.
                fs::hard_link(path, &old)
                    .or_else(|_| fs::copy(path, &old).map(drop))
                    .map_err(|error| not_replaced(path, &error))?;
            }
        }
        Ok(())
    }

    /// Restores the files that the first `count` new files have replaced.
    fn put_back(&self, count: usize) {
        for (n, path) in self.paths[..count].iter().enumerate() {
            let old = self.room.old_file(n);
            // A file that can't be restored stays new: it is complete, too.
            let _ = if old.exists() { fs::rename(old, path) } else { fs::remove_file(path) };
        }
    }
}

fn check_replaceable(path: &Path) -> Result<(), WriteError> {
    let Ok(found) = path.metadata() else { return Ok(()) };
    if found.is_dir() {
        let hint = "Remove or rename it.";
        return Err(WriteError::new(path, "a folder has this name", hint));
    }
    if found.permissions().readonly() {
        let hint = "Make it writable, remove it, or choose another name or folder.";
        return Err(WriteError::new(path, "the file there is read-only", hint));
    }
    Ok(())
}

fn not_replaced(path: &Path, error: &io::Error) -> WriteError {
    if error.kind() != io::ErrorKind::PermissionDenied {
        return WriteError::of(path, error);
    }
    let hint = "It belongs to another user, or another program has it open. Remove it, or choose \
                another name or folder.";
    WriteError::new(path, "the file there may not be replaced", hint)
}

/// Writes one file, into an existing folder. If its name is a link, the link stays and its target
/// is written; a device or a pipe gets the bytes.
///
/// # Errors
/// It can't be written, or a folder or a read-only file has its name.
pub fn write_one(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let linked = path.is_symlink().then(|| path.canonicalize().map_err(|_| leads_nowhere(path)));
    let target = linked.transpose()?.unwrap_or_else(|| path.to_owned());
    if target.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        let mut options = File::options();
        let written = options.write(true).open(&target).and_then(|mut to| to.write_all(bytes));
        return written.map_err(|error| WriteError::of(path, &error));
    }
    write_single(&target, bytes, false)
}

/// Writes one file as [`write_one`] does, but without following links, and waits until the disk has
/// the file, so that it survives a loss of power.
///
/// # Errors
/// As [`write_one`].
pub fn write_to_last(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_single(path, bytes, true)
}

fn write_single(path: &Path, bytes: &[u8], lasts: bool) -> Result<(), WriteError> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    check_replaceable(path)?;
    let room = {
        let mut hold = hold();
        sweep(folder);
        Room::new(&mut hold, folder).map_err(|error| WriteError::of(path, &error))?
    };
    let mut batch = Batch { folder: folder.to_owned(), room, paths: Vec::new(), lasts };
    batch.write(path.to_owned(), bytes)?;
    batch.keep()
}
