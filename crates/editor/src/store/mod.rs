//! What outlasts the program: work that was not saved yet, and small settings.
//!
//! On the desktop both are files in a folder of the person's own, in the browser they are in its
//! database and in the page's local storage; [`Store`] is one or the other. Each running window
//! has a slot of its own for its work. A window that is killed leaves its slot behind, and the next
//! one finds it with `load_all`; slots of windows that still run are not found.

mod autosave;
#[cfg(target_arch = "wasm32")]
mod browser;
#[cfg(not(target_arch = "wasm32"))]
mod disk;
mod pace;

pub use autosave::{Autosave, Job};
#[cfg(target_arch = "wasm32")]
pub use browser::{Prepared, Store, prepare};
#[cfg(not(target_arch = "wasm32"))]
pub use disk::Store;
pub use pace::{Due, PAUSE, Pace};

use std::time::Duration;

/// Work that a window left behind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// Its slot, for `remove`.
    pub slot: String,
    /// What was saved, whole.
    pub bytes: Vec<u8>,
    /// How long ago it was saved; `None` if the clock has been set back since.
    pub age: Option<Duration>,
}

/// Why something can't be kept, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoreError {
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub hint: String,
}

impl StoreError {
    fn new(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { message: message.into(), hint: hint.into() }
    }
}

impl std::fmt::Display for StoreError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}. {}", self.message, self.hint)
    }
}

impl std::error::Error for StoreError {}

/// Whether something may be the name of a slot or a setting: it becomes the name of a file.
fn is_name(name: &str) -> bool {
    let allowed = |c: u8| c.is_ascii_lowercase() || c.is_ascii_digit() || c == b'-';
    (1..=64).contains(&name.len()) && name.bytes().all(allowed)
}

fn checked(name: &str) -> Result<&str, StoreError> {
    let hint = "This is a fault of the program.";
    is_name(name).then_some(name).ok_or_else(|| StoreError::new("nothing can have this name", hint))
}
