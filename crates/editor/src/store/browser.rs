//! In the browser: entries of the page's local storage.
//!
//! Local storage answers at once: what was handed to it outlasts the tab, however it ends. It keeps
//! text only, about ten megabytes for everything, and the browser may clear it. So what was written
//! is read back and compared, and people are told to save to a file.
//!
//! Only the page knows which other tabs run (Web Locks, which go when their tab does), so it says so
//! to [`prepare`] before anything is opened.

use super::text::{packed, unpacked};
use super::{Recovered, StoreError, checked, is_name};
use crate::envelope::{opened, sealed};
use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;
use web_sys::Storage;

/// How the keys of saved work and of settings begin.
const SAVED: &str = "sheetwright/saved/";
const SETTING: &str = "sheetwright/setting/";
/// What browsers give a page, in units of 16 bits.
const LIMIT_UNITS: usize = 5 << 20;
/// How many bits of ours go into such a unit.
const BITS: usize = 15;

thread_local! {
    static PREPARED: RefCell<Option<Prepared>> = const { RefCell::new(None) };
}

/// What the page knows.
struct Prepared {
    slot: String,
    /// Slots that tabs left behind which run no more.
    left: Vec<String>,
}

/// Tells the slot of this tab, and those of the tabs that run.
pub fn prepare(slot: String, running: &[String]) {
    let keys = storage().map(|storage| keys(&storage, SAVED)).unwrap_or_default();
    let left = keys.into_iter().filter(|key| *key != slot && !running.contains(key)).collect();
    PREPARED.with(|prepared| *prepared.borrow_mut() = Some(Prepared { slot, left }));
}

/// Where work and settings are kept. Clones share the slot.
#[derive(Clone, Debug)]
pub struct Store {
    storage: Storage,
    slot: Rc<str>,
    left: Vec<String>,
}

impl Store {
    /// Opens the storage of the page.
    ///
    /// # Errors
    /// The browser does not give any, as some do in private windows.
    pub fn open() -> Result<Self, StoreError> {
        let storage = storage().ok_or_else(|| {
            StoreError::new(
                "this browser keeps nothing for this page",
                "Allow the page to store data, and save your work to a file often.",
            )
        })?;
        let prepared = PREPARED.with(|prepared| prepared.borrow_mut().take());
        let prepared = prepared.filter(|prepared| is_name(&prepared.slot));
        let (slot, left) = prepared.map_or_else(
            || ("page".to_owned(), Vec::new()),
            |prepared| (prepared.slot, prepared.left),
        );
        Ok(Self { storage, slot: slot.into(), left })
    }

    /// The slot of this tab.
    pub fn own_slot(&self) -> &str {
        &self.slot
    }

    /// What people should know about this way of keeping things.
    pub fn warning(&self) -> Option<&'static str> {
        Some(
            "Your browser keeps a copy of your work while you draw, but it may clear it at any time. \
             Save to a file what you want to keep.",
        )
    }

    /// Keeps bytes in a slot, in place of what was there; where they don't fit, the old ones stay.
    ///
    /// # Errors
    /// They don't fit, or they don't come back as they were written.
    pub fn save(&mut self, slot: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let now = js_sys::Date::now() as u64;
        let text = packed(&sealed(&[&now.to_le_bytes()[..], bytes].concat()));
        self.write(&format!("{SAVED}{}", checked(slot)?), &text)
    }

    /// What tabs left behind that had ended when this one began, the newest first. What is not
    /// whole is passed over.
    pub fn load_all(&mut self) -> Vec<Recovered> {
        let now = js_sys::Date::now() as u64;
        let mut found: Vec<Recovered> = self
            .left
            .iter()
            .filter_map(|slot| {
                let text = self.read(&format!("{SAVED}{slot}"))?;
                let all = unpacked(&text)?;
                let (when, bytes) = opened(&all)?.split_first_chunk()?;
                let age = now.checked_sub(u64::from_le_bytes(*when)).map(Duration::from_millis);
                Some(Recovered { slot: slot.clone(), bytes: bytes.to_owned(), age })
            })
            .collect();
        found.sort_by(|a, b| a.age.cmp(&b.age).then_with(|| a.slot.cmp(&b.slot)));
        found
    }

    /// Empties a slot.
    ///
    /// # Errors
    /// The browser does not let it.
    pub fn remove(&mut self, slot: &str) -> Result<(), StoreError> {
        let key = format!("{SAVED}{}", checked(slot)?);
        self.storage.remove_item(&key).map_err(|_| refused())
    }

    /// A setting; `None` if it was never set.
    pub fn get(&self, name: &str) -> Option<String> {
        self.read(&format!("{SETTING}{}", checked(name).ok()?))
    }

    /// Keeps a setting.
    ///
    /// # Errors
    /// It does not fit.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), StoreError> {
        self.write(&format!("{SETTING}{}", checked(name)?), text)
    }

    fn read(&self, key: &str) -> Option<String> {
        self.storage.get_item(key).ok().flatten()
    }

    fn write(&self, key: &str, text: &str) -> Result<(), StoreError> {
        if self.storage.set_item(key, text).is_err() {
            return Err(self.no_room(key, text));
        }
        if self.read(key).as_deref() != Some(text) {
            return Err(StoreError::new(
                "the browser did not keep what was written",
                "Save your work to a file; it is not safe here.",
            ));
        }
        Ok(())
    }

    /// Why a text does not fit. What it would take the place of counts as free.
    fn no_room(&self, key: &str, text: &str) -> StoreError {
        let units = |text: &str| text.chars().map(char::len_utf16).sum::<usize>();
        let others = keys(&self.storage, "").into_iter().filter(|other| other != key);
        let used = others.map(|key| units(&key) + self.read(&key).map_or(0, |text| units(&text)));
        let free = LIMIT_UNITS.saturating_sub(used.sum());
        let mb = |units: usize| (units * BITS) as f64 / 8e6;
        StoreError::new(
            format!(
                "there is no room in the browser's storage: this takes {:.1} MB, and {:.1} MB are left",
                mb(units(text)),
                mb(free)
            ),
            "Save your work to a file; pictures take the most room.",
        )
    }
}

fn storage() -> Option<Storage> {
    web_sys::window()?.local_storage().ok().flatten()
}

/// The keys that begin so, without that beginning, in order.
fn keys(storage: &Storage, prefix: &str) -> Vec<String> {
    let all = (0..storage.length().unwrap_or(0)).filter_map(|n| storage.key(n).ok().flatten());
    let mut found: Vec<String> =
        all.filter_map(|key| Some(key.strip_prefix(prefix)?.to_owned())).collect();
    found.sort();
    found
}

fn refused() -> StoreError {
    StoreError::new("the browser's storage can't be changed", "Allow the page to store data.")
}
