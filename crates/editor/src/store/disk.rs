//! On the desktop: files in a folder of the person's own.
//!
//! ```text
//! recovery/lock            held while slots are opened, listed or removed
//! recovery/4711-0.lock     held as long as the window runs; the system lets go of it at a kill
//! recovery/4711-0.saved    the work of that window
//! settings/look.txt        a setting
//! ```

use super::{Recovered, StoreError, checked, is_name};
use crate::envelope::{opened, sealed};
use sheetwright_files::whole::{TEMPORARY, WriteError, write_to_last};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// Names the folder, in place of the usual one.
const FOLDER: &str = "SHEETWRIGHT_DATA";
/// A setting or a saved design that is larger is none of ours.
const MOST_BYTES: u64 = 1 << 30;
/// Slots that a process tries; each window of one process has another.
const MOST_SLOTS: u32 = 1000;
/// A file that has been written for longer is left over.
const LONG_WRITE: Duration = Duration::from_secs(3600);

/// Where work and settings are kept. Clones share the slot.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
    slot: String,
    /// Held as long as any clone is there.
    _running: Arc<File>,
}

impl Store {
    /// Opens the folder, creates it if need be, and takes a slot.
    ///
    /// # Errors
    /// There is no place for it, or it can't be written.
    pub fn open() -> Result<Self, StoreError> {
        let named = std::env::var_os(FOLDER).filter(|name| !name.is_empty()).map(PathBuf::from);
        let folder = named.or_else(|| Some(dirs::data_dir()?.join("sheetwright")));
        let folder = folder.ok_or_else(|| {
            let hint = format!("Set the variable {FOLDER} to a folder.");
            StoreError::new("this system names no folder for data", hint)
        })?;
        Self::open_at(&folder)
    }

    /// [`Self::open`] in this folder.
    ///
    /// # Errors
    /// It can't be written.
    pub fn open_at(folder: &Path) -> Result<Self, StoreError> {
        for name in ["recovery", "settings"] {
            let path = folder.join(name);
            fs::create_dir_all(&path).map_err(|error| failed(&path, &error))?;
        }
        let recovery = folder.join("recovery");
        let _alone = alone(&recovery)?;
        for n in 0..MOST_SLOTS {
            let slot = format!("{}-{n}", std::process::id());
            // Ids of processes come back: a slot that was left behind stays as it is.
            if recovery.join(format!("{slot}.saved")).exists() {
                continue;
            }
            let path = recovery.join(format!("{slot}.lock"));
            let file = File::options().create(true).append(true).open(&path);
            let file = file.map_err(|error| failed(&path, &error))?;
            if is_locked_by_me(&file, &path)? {
                return Ok(Self { folder: folder.to_owned(), slot, _running: Arc::new(file) });
            }
        }
        let hint = format!("Empty the folder {}.", recovery.display());
        Err(StoreError::new("there are too many unsaved designs", hint))
    }

    /// The slot of this window.
    pub fn own_slot(&self) -> &str {
        &self.slot
    }

    /// What people should know about this way of keeping things: nothing on the desktop.
    pub fn warning(&self) -> Option<&'static str> {
        None
    }

    /// Keeps bytes in a slot, in place of what was there. They are on the disk when it returns;
    /// killed on the way, the old ones stay.
    ///
    /// # Errors
    /// They can't be written.
    pub fn save(&mut self, slot: &str, bytes: &[u8]) -> Result<(), StoreError> {
        write(&self.saved(checked(slot)?), &sealed(bytes))
    }

    /// What windows left behind that run no more, the newest first. What is not whole is passed
    /// over.
    pub fn load_all(&mut self) -> Vec<Recovered> {
        let recovery = self.folder.join("recovery");
        let Ok(_alone) = alone(&recovery) else { return Vec::new() };
        let Ok(entries) = fs::read_dir(&recovery) else { return Vec::new() };
        let now = SystemTime::now();
        let mut found = Vec::new();
        for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
            if path.extension().is_none_or(|ending| ending != "saved") {
                self.sweep(&path, now);
                continue;
            }
            let Some(slot) = path.file_stem().and_then(|stem| stem.to_str()) else { continue };
            if slot == self.slot || !is_name(slot) || self.runs(slot) {
                continue;
            }
            let Some(all) = read(&path) else { continue };
            let Some(bytes) = opened(&all) else { continue };
            let when = fs::metadata(&path).and_then(|data| data.modified()).unwrap_or(now);
            let (slot, bytes, age) =
                (slot.to_owned(), bytes.to_owned(), now.duration_since(when).ok());
            found.push(Recovered { slot, bytes, age });
        }
        found.sort_by(|a, b| a.age.cmp(&b.age).then_with(|| a.slot.cmp(&b.slot)));
        found
    }

    /// Empties a slot.
    ///
    /// # Errors
    /// It can't be emptied.
    pub fn remove(&mut self, slot: &str) -> Result<(), StoreError> {
        let _alone = alone(&self.folder.join("recovery"))?;
        let path = self.saved(checked(slot)?);
        remove(&path)?;
        if slot != self.slot && !self.runs(slot) {
            remove(&path.with_extension("lock"))?;
        }
        Ok(())
    }

    /// A setting; `None` if it was never set.
    pub fn get(&self, name: &str) -> Option<String> {
        String::from_utf8(read(&self.setting(checked(name).ok()?))?).ok()
    }

    /// Keeps a setting.
    ///
    /// # Errors
    /// It can't be written.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), StoreError> {
        write(&self.setting(checked(name)?), text.as_bytes())
    }

    fn saved(&self, slot: &str) -> PathBuf {
        self.folder.join("recovery").join(format!("{slot}.saved"))
    }

    fn setting(&self, name: &str) -> PathBuf {
        self.folder.join("settings").join(format!("{name}.txt"))
    }

    /// Removes what a killed window left that is of no use: the lock of an empty slot, and a file
    /// that was not written to its end.
    fn sweep(&self, path: &Path, now: SystemTime) {
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return };
        let useless = if let Some(slot) = name.strip_suffix(".lock") {
            is_name(slot) && !self.saved(slot).exists() && !self.runs(slot)
        } else {
            let written = fs::metadata(path).and_then(|data| data.modified()).unwrap_or(now);
            let age = now.duration_since(written).unwrap_or_default();
            name.starts_with(TEMPORARY) && age > LONG_WRITE
        };
        if useless {
            let _ = remove(path);
        }
    }

    /// Whether the window of a slot runs. Its lock is tried, and let go of again.
    fn runs(&self, slot: &str) -> bool {
        let path = self.saved(slot).with_extension("lock");
        let file = File::options().append(true).open(&path);
        // Without a lock nobody holds it.
        file.is_ok_and(|file| is_locked_by_me(&file, &path).is_ok_and(|mine| !mine))
    }
}

/// Gives the slot back, if nothing is left in it.
impl Drop for Store {
    fn drop(&mut self) {
        if Arc::strong_count(&self._running) == 1 && !self.saved(&self.slot).exists() {
            let _ = alone(&self.folder.join("recovery"))
                .and_then(|_alone| remove(&self.saved(&self.slot).with_extension("lock")));
        }
    }
}

/// Waits until no other window opens, lists or removes slots, and keeps them from it as long as
/// the file is held.
fn alone(recovery: &Path) -> Result<File, StoreError> {
    let path = recovery.join("lock");
    let file = File::options().create(true).append(true).open(&path);
    let file = file.map_err(|error| failed(&path, &error))?;
    file.lock().map_err(|error| failed(&path, &error))?;
    Ok(file)
}

/// Whether the lock could be taken: nobody else holds it.
fn is_locked_by_me(file: &File, path: &Path) -> Result<bool, StoreError> {
    match file.try_lock() {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(error)) => Err(failed(path, &error)),
    }
}

fn read(path: &Path) -> Option<Vec<u8>> {
    let is_file = fs::metadata(path).is_ok_and(|data| data.is_file() && data.len() <= MOST_BYTES);
    is_file.then(|| fs::read(path).ok()).flatten()
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    write_to_last(path, bytes).map_err(|WriteError { message, place, hint }| {
        StoreError::new(format!("{place}: {message}"), hint)
    })
}

fn remove(path: &Path) -> Result<(), StoreError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(failed(path, &error)),
        _ => Ok(()),
    }
}

fn failed(path: &Path, error: &io::Error) -> StoreError {
    let hint = format!("Check its permissions, or set the variable {FOLDER} to another folder.");
    StoreError::new(format!("{}: {error}", path.display()), hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().unwrap()
    }

    /// Whatever a killed window leaves: its files, without its locks.
    fn left_behind(folder: &Path, slot: &str, bytes: &[u8]) {
        let path = folder.join("recovery").join(slot);
        fs::write(path.with_extension("lock"), b"").unwrap();
        fs::write(path.with_extension("saved"), bytes).unwrap();
    }

    #[test]
    fn what_is_left_behind_is_found_once() {
        let folder = folder();
        let mut store = Store::open_at(folder.path()).unwrap();
        assert_eq!(store.load_all(), []);
        left_behind(folder.path(), "1-0", &sealed(b"a boat"));
        let found = store.load_all();
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].slot.as_str(), found[0].bytes.as_slice()), ("1-0", &b"a boat"[..]));
        store.remove("1-0").unwrap();
        assert_eq!(store.load_all(), []);
        assert!(!folder.path().join("recovery/1-0.lock").exists());
    }

    #[test]
    fn the_locks_of_empty_slots_are_swept_away() {
        let folder = folder();
        let mut store = Store::open_at(folder.path()).unwrap();
        let lock = folder.path().join("recovery/1-0.lock");
        fs::write(&lock, b"").unwrap();
        assert_eq!(store.load_all(), []);
        assert!(!lock.exists());
        let own = folder.path().join("recovery").join(format!("{}.lock", store.own_slot()));
        assert!(own.exists());
    }

    #[test]
    fn windows_that_run_are_left_alone() {
        let folder = folder();
        let mut a = Store::open_at(folder.path()).unwrap();
        let mut b = Store::open_at(folder.path()).unwrap();
        assert_ne!(a.own_slot(), b.own_slot());
        let (of_a, of_b) = (a.own_slot().to_owned(), b.own_slot().to_owned());
        a.save(&of_a, b"in a").unwrap();
        b.save(&of_b, b"in b").unwrap();
        assert_eq!(a.load_all(), []);
        assert_eq!(b.load_all(), []);
        // As at a kill: the lock goes, and what was saved stays.
        drop(a);
        let found = b.load_all();
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].slot.as_str(), found[0].bytes.as_slice()), (&of_a[..], &b"in a"[..]));
        // A new window does not take the slot of the old one.
        let c = Store::open_at(folder.path()).unwrap();
        assert_ne!(c.own_slot(), of_a);
        assert_eq!(b.load_all().len(), 1);
    }

    #[test]
    fn what_is_not_whole_is_passed_over() {
        let folder = folder();
        let mut store = Store::open_at(folder.path()).unwrap();
        let whole = sealed(b"a boat");
        left_behind(folder.path(), "1-0", &whole[..whole.len() - 1]);
        left_behind(folder.path(), "1-1", b"");
        left_behind(folder.path(), "Not-Ours", &whole);
        fs::create_dir(folder.path().join("recovery/2-0.saved")).unwrap();
        assert_eq!(store.load_all(), []);
    }

    #[test]
    fn an_empty_slot_leaves_nothing() {
        let folder = folder();
        let mut store = Store::open_at(folder.path()).unwrap();
        let slot = store.own_slot().to_owned();
        store.save(&slot, b"a boat").unwrap();
        store.remove(&slot).unwrap();
        drop(store);
        let left: Vec<_> = fs::read_dir(folder.path().join("recovery")).unwrap().collect();
        assert_eq!(left.len(), 1, "{left:?}");
    }

    #[test]
    fn settings_are_kept() {
        let folder = folder();
        let mut store = Store::open_at(folder.path()).unwrap();
        assert_eq!(store.get("look"), None);
        store.set("look", "dark").unwrap();
        store.set("recent", "a/b.sheet.json\nc d.sheet.json").unwrap();
        drop(store);
        let mut store = Store::open_at(folder.path()).unwrap();
        assert_eq!(store.get("look").as_deref(), Some("dark"));
        assert_eq!(store.get("recent").as_deref(), Some("a/b.sheet.json\nc d.sheet.json"));
        for name in ["", "..", "a/b", "A", "look.txt", &"a".repeat(65)] {
            assert!(store.set(name, "x").is_err(), "{name}");
            assert_eq!(store.get(name), None);
        }
    }

    #[test]
    fn a_folder_that_can_not_be_written_is_said() {
        let folder = folder();
        let file = folder.path().join("file");
        fs::write(&file, b"").unwrap();
        let error = Store::open_at(&file).unwrap_err();
        assert!(error.message.contains("file"), "{error}");
        assert!(error.hint.contains(FOLDER), "{error}");
    }
}
