//! The room of a batch: a folder `.sheetwright-…` beside where its files go.
//!
//! Files wait there under numbers until all are written, each closed as soon as it is. A lock on
//! the file `lock` says that the batch is alive; the system lets go of it when the program ends,
//! however it ends. So a room whose lock can be had was left by a program that was killed, and the
//! next batch in the same folder removes it. Two programs at once leave each other's rooms alone.

use std::fs::{self, File, TryLockError};
use std::io;
use std::mem;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// How the names of temporary folders begin.
pub const TEMPORARY: &str = ".sheetwright-";
/// The file whose lock says that a room is in use.
const LOCK: &str = "lock";
/// Files that wait for their names.
const NEW: &str = "new-";
/// What was there before, until all files have their names.
const OLD: &str = "old-";
/// Names that are tried for a room, at the most; each is taken by another batch of this process, or
/// of a process of this number on another computer.
const TRIES: usize = 10_000;

/// What a program that is stopped has to remove: the rooms in use, and the folders made for them.
/// A thread holds it while it creates, writes or renames files.
static OPEN: Mutex<Vec<Open>> = Mutex::new(Vec::new());

struct Open {
    room: PathBuf,
    /// Folders that were not there before, the innermost first.
    created: Vec<PathBuf>,
}

/// Keeps the files of all batches as they are, as long as it lives.
pub(super) struct Hold(MutexGuard<'static, Vec<Open>>);

pub(super) fn hold() -> Hold {
    Hold(OPEN.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Removes what unfinished batches have written, once a batch that is about to be kept is kept. No
/// file is written afterwards: the program is to end.
pub fn give_up() {
    let Hold(open) = hold();
    for Open { room, created } in open.iter() {
        remove(room);
        remove_empty(created);
    }
    // Threads that are about to write wait until the program ends.
    mem::forget(open);
}

/// The room of one batch. It goes when it is dropped, with all that waits in it.
#[derive(Debug)]
pub(super) struct Room {
    path: PathBuf,
    lock: Option<File>,
}

impl Room {
    /// A room in a folder that is there; no sweep removes it as long as it lives.
    pub(super) fn new(hold: &mut Hold, folder: &Path) -> io::Result<Self> {
        for n in 0..TRIES {
            let path = folder.join(format!("{TEMPORARY}{}-{n}", process::id()));
            match create(&path).and_then(|()| locked(&path)) {
                Ok(lock) => {
                    hold.0.push(Open { room: path.clone(), created: Vec::new() });
                    return Ok(Self { path, lock: Some(lock) });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                // Swept before it was locked.
                Err(error) if error.kind() == io::ErrorKind::NotFound && folder.is_dir() => {}
                Err(error) => {
                    remove(&path);
                    return Err(error);
                }
            }
        }
        Err(io::Error::new(io::ErrorKind::AlreadyExists, "no name is left for a temporary folder"))
    }

    /// Where the file of this number waits.
    pub(super) fn new_file(&self, n: usize) -> PathBuf {
        self.path.join(format!("{NEW}{n}"))
    }

    /// Where what the file of this number takes the place of is kept.
    pub(super) fn old_file(&self, n: usize) -> PathBuf {
        self.path.join(format!("{OLD}{n}"))
    }

    /// These folders, the innermost first, were made for the room and go with it, where nothing
    /// else is in them.
    pub(super) fn goes_with(&self, hold: &mut Hold, created: Vec<PathBuf>) {
        if let Some(open) = hold.0.iter_mut().find(|open| open.room == self.path) {
            open.created = created;
        }
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        let mut hold = hold();
        // Some systems remove no folder of an open file.
        self.lock = None;
        remove(&self.path);
        hold.0.retain(|open| {
            if open.room == self.path {
                remove_empty(&open.created);
            }
            open.room != self.path
        });
    }
}

/// Removes the rooms in a folder that killed programs have left.
pub(super) fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let is_named_so = entry.file_name().to_string_lossy().starts_with(TEMPORARY);
        if is_named_so && entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            sweep_room(&entry.path());
        }
    }
}

fn sweep_room(room: &Path) {
    if !holds_our_files_only(room) {
        return;
    }
    match File::options().write(true).open(room.join(LOCK)) {
        // The lock is held until all is gone, so that a batch that has just made the room sees it.
        Ok(lock) if lock.try_lock().is_ok() => remove(room),
        // Empty, it was left before it had its lock; or it gets it now, and the batch tries again.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let _ = fs::remove_dir(room);
        }
        _ => {}
    }
}

fn holds_our_files_only(room: &Path) -> bool {
    let is_ours = |entry: fs::DirEntry| {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_named_so = name == LOCK || name.starts_with(NEW) || name.starts_with(OLD);
        is_named_so && entry.file_type().is_ok_and(|kind| !kind.is_dir())
    };
    fs::read_dir(room).is_ok_and(|entries| entries.flatten().all(is_ours))
}

/// A new folder that its owner alone may enter.
fn create(path: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(path)
}

/// The lock of a new room; "not found" if the room was swept meanwhile.
fn locked(room: &Path) -> io::Result<File> {
    let path = room.join(LOCK);
    let file = File::create_new(&path)?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(io::ErrorKind::NotFound.into()),
        // Where a disk has no locks, no sweep removes a room.
        Ok(()) | Err(TryLockError::Error(_)) if path.exists() => Ok(file),
        _ => Err(io::ErrorKind::NotFound.into()),
    }
}

/// Removes a room, its lock last. What can't be removed stays for the next sweep.
fn remove(room: &Path) {
    for entry in fs::read_dir(room).into_iter().flatten().flatten() {
        if entry.file_name() != LOCK {
            let _ = fs::remove_file(entry.path());
        }
    }
    let _ = fs::remove_file(room.join(LOCK));
    let _ = fs::remove_dir(room);
}

/// Removes folders, the innermost first. One that something else has come into stays.
pub(super) fn remove_empty(folders: &[PathBuf]) {
    for folder in folders {
        let _ = fs::remove_dir(folder);
    }
}
