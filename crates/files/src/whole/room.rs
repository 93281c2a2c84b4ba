//! The room of a batch: a folder `.sheetwright-…` beside where its files go.
//!
//! Files wait there under numbers until all are written; each is closed as soon as it is written. A
//! lock on the file `lock` shows that the batch is alive; the system releases it when the program
//! ends in any way. So a room whose lock is free was left by a killed program, and the next batch
//! in the same folder removes it. Two programs at once do not touch each other's rooms.

use std::fs::{self, File, TryLockError};
use std::io;
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The prefix of the names of temporary folders.
pub const TEMPORARY: &str = ".sheetwright-";
/// The file whose lock says that a room is in use.
const LOCK: &str = "lock";
/// The prefix of new files that wait for their final names.
const NEW: &str = "new-";
/// The prefix of replaced files, which are kept until all new files have their final names.
const OLD: &str = "old-";
/// The most names tried for a room. Another batch of this process, or of a process of this number
/// on another computer, may have taken a name.
const TRIES: usize = 10_000;

/// The rooms in use, and the folders made for them, which a program removes when it is stopped. A
/// thread holds the lock while it creates, writes or renames files.
static OPEN: Mutex<Vec<Open>> = Mutex::new(Vec::new());

struct Open {
    room: PathBuf,
    /// Folders that did not exist before, the innermost first.
    created: Vec<PathBuf>,
}

/// While it lives, no other thread changes the files of any batch.
pub(super) struct Hold(MutexGuard<'static, Vec<Open>>);

pub(super) fn hold() -> Hold {
    Hold(OPEN.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Removes the files of unfinished batches, after a batch that is being renamed is complete. It
/// blocks all later writes: call it just before the program ends.
pub fn give_up() {
    let Hold(open) = hold();
    for Open { room, created } in open.iter() {
        remove(room);
        remove_empty(created);
    }
    // Threads that are about to write wait until the program ends.
    mem::forget(open);
}

/// The room of one batch. Dropping it removes it, with all files that wait in it.
#[derive(Debug)]
pub(super) struct Room {
    path: PathBuf,
    lock: Option<File>,
}

impl Room {
    /// A room in an existing folder; no sweep removes it as long as it lives.
    pub(super) fn new(hold: &mut Hold, folder: &Path) -> io::Result<Self> {
        for n in 0..TRIES {
            let path = folder.join(format!("{TEMPORARY}{}-{n}", own_number()));
            match create(&path).and_then(|()| locked(&path)) {
                Ok(lock) => {
                    hold.0.push(Open { room: path.clone(), created: Vec::new() });
                    return Ok(Self { path, lock: Some(lock) });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                // Another batch swept the room before it was locked.
                Err(error) if error.kind() == io::ErrorKind::NotFound && folder.is_dir() => {}
                Err(error) => {
                    remove(&path);
                    return Err(error);
                }
            }
        }
        Err(io::Error::new(io::ErrorKind::AlreadyExists, "no name is left for a temporary folder"))
    }

    /// The path where the file of this number waits.
    pub(super) fn new_file(&self, n: usize) -> PathBuf {
        self.path.join(format!("{NEW}{n}"))
    }

    /// The path that keeps the file which the new file of this number replaces.
    pub(super) fn old_file(&self, n: usize) -> PathBuf {
        self.path.join(format!("{OLD}{n}"))
    }

    /// Registers folders, the innermost first, that were made for the room. They are removed with
    /// it if they are empty.
    pub(super) fn goes_with(&self, hold: &mut Hold, created: Vec<PathBuf>) {
        if let Some(open) = hold.0.iter_mut().find(|open| open.room == self.path) {
            open.created = created;
        }
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        let mut hold = hold();
        // Some systems can't remove a folder with an open file.
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
        // An empty room was left before it had its lock, or is about to get it: then its batch
        // tries again.
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

/// The number of this process; 0 where the system numbers none, and asking would panic.
fn own_number() -> u32 {
    if cfg!(target_os = "wasi") { 0 } else { std::process::id() }
}

/// A new folder that its owner alone may enter.
fn create(path: &Path) -> io::Result<()> {
    let builder = fs::DirBuilder::new();
    #[cfg(unix)]
    let builder = {
        let mut builder = builder;
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder
    };
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

/// Removes folders, the innermost first. Folders that are not empty stay.
pub(super) fn remove_empty(folders: &[PathBuf]) {
    for folder in folders {
        let _ = fs::remove_dir(folder);
    }
}
