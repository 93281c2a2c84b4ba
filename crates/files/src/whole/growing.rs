//! A file that grows by whole pieces, such as the rows of a table, while others may read it (not on
//! Windows, where its lock keeps readers out).
//!
//! It stands under its own name from the start: what is in it is of use at once, and a batch of
//! hours that ends early goes on where it ended. Each piece is handed to the system in one call,
//! and no signal that ends the program comes between its bytes.

use super::WriteError;
use super::room::hold;
use std::fs::{File, TryLockError};
use std::io::{self, BufReader, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

/// A file that grows; no other program of this kind writes it meanwhile.
#[derive(Debug)]
pub struct Growing {
    path: PathBuf,
    file: File,
}

impl Growing {
    /// Opens the file of this path for growing, or begins it.
    ///
    /// # Errors
    /// It can't be opened, or another run has it open.
    pub fn open(path: &Path) -> Result<Self, WriteError> {
        let failed = |error: &io::Error| WriteError::of(path, error);
        if path.is_dir() {
            let hint = "Remove or rename it, or choose another name.";
            return Err(WriteError::new(path, "a folder has this name", hint));
        }
        let _opening = hold();
        let mut options = File::options();
        let file = options.read(true).write(true).create(true).truncate(false).open(path);
        let file = file.map_err(|error| failed(&error))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let hint = "Wait until it ends, or choose another name.";
                Err(WriteError::new(path, "another run is writing this file", hint))
            }
            // Not every disk has locks.
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self { path: path.to_owned(), file }),
        }
    }

    /// Its bytes from the beginning, as they are now.
    ///
    /// # Errors
    /// It can't be read.
    pub fn read(&self) -> Result<BufReader<File>, WriteError> {
        // On Windows, the lock of the file is in the way of any handle but its own. WASI has no
        // second handle, and no locks.
        let handle =
            if cfg!(target_os = "wasi") { File::open(&self.path) } else { self.file.try_clone() };
        let read = handle.and_then(|mut file| {
            file.seek(SeekFrom::Start(0))?;
            Ok(BufReader::new(file))
        });
        read.map_err(|error| WriteError::of(&self.path, &error))
    }

    /// Cuts off all bytes but the first so many; the next piece comes behind them.
    ///
    /// # Errors
    /// It can't be changed.
    pub fn cut(&mut self, bytes: u64) -> Result<(), WriteError> {
        let _cutting = hold();
        let cut = self.file.set_len(bytes);
        let placed = cut.and_then(|()| self.file.seek(SeekFrom::Start(bytes)));
        placed.map(drop).map_err(|error| WriteError::of(&self.path, &error))
    }

    /// Removes it, if it is empty.
    ///
    /// # Errors
    /// It can't be removed.
    pub fn remove_empty(self) -> Result<(), WriteError> {
        let failed = |error: &io::Error| WriteError::of(&self.path, error);
        if self.file.metadata().map_err(|error| failed(&error))?.len() > 0 {
            return Ok(());
        }
        let _removing = hold();
        std::fs::remove_file(&self.path).map_err(|error| failed(&error))
    }

    /// Adds a piece.
    ///
    /// # Errors
    /// It can't be written, as on a full disk; a part of the piece may be.
    pub fn add(&mut self, piece: &[u8]) -> Result<(), WriteError> {
        let _adding = hold();
        // A reader of the file has moved its place.
        let placed = self.file.seek(SeekFrom::End(0));
        let added = placed.and_then(|_| self.file.write_all(piece));
        added.map_err(|error| WriteError::of(&self.path, &error))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;
    use std::io::Read as _;

    #[test]
    fn it_grows_and_is_one_program_s_alone() {
        let folder =
            std::env::temp_dir().join(format!("sheetwright-growing-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("t.csv");
        let mut growing = Growing::open(&path).unwrap();
        growing.add(b"one\ntwo\nth").unwrap();
        growing.cut(8).unwrap();
        growing.add(b"three\n").unwrap();
        let error = Growing::open(&path).unwrap_err();
        assert_eq!(error.message, "another run is writing this file");
        let mut text = String::new();
        growing.read().unwrap().read_to_string(&mut text).unwrap();
        assert_eq!(text, "one\ntwo\nthree\n");
        growing.read().unwrap().read_exact(&mut [0; 2]).unwrap();
        growing.add(b"four\n").unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "one\ntwo\nthree\nfour\n");
        drop(growing);
        assert!(Growing::open(&path).is_ok());
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
