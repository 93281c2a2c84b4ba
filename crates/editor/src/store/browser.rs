//! In the browser: work in the browser's database, settings in the page's local storage.
//!
//! The database (IndexedDB) has room for gigabytes, and what it says is done outlasts the tab and a
//! browser that is killed. Local storage does not: browsers write it to the disk seconds later. It
//! answers at once, which is enough for settings. The browser may clear both, so work is read back
//! and compared when it was written, and people are told to save to a file.
//!
//! The page's script speaks to the database (`kept.js`), and only it knows which other tabs run
//! (Web Locks, which go when their tab does). It says all that to [`prepare`] before anything is
//! opened.

use super::{Recovered, StoreError, checked, is_name};
use crate::envelope::{opened, sealed};
use js_sys::{Error, Function, Promise, Uint8Array};
use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::Storage;

/// How the keys of settings begin.
const SETTING: &str = "sheetwright/setting/";

thread_local! {
    static PREPARED: RefCell<Option<Prepared>> = const { RefCell::new(None) };
}

/// What the page knows.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The slot of this tab.
    pub slot: String,
    /// What tabs left behind which run no more, by their slots.
    pub left: Vec<(String, Vec<u8>)>,
    /// Takes a slot and its bytes, or `undefined` to empty it; gives a promise.
    pub keep: Function,
}

/// Takes what the page knows.
pub fn prepare(prepared: Prepared) {
    PREPARED.with(|place| *place.borrow_mut() = Some(prepared));
}

/// Where work and settings are kept. Clones share the slot.
#[derive(Clone, Debug)]
pub struct Store {
    slot: Rc<str>,
    left: Vec<(String, Vec<u8>)>,
    keep: Function,
}

impl Store {
    /// Opens what the page has prepared.
    ///
    /// # Errors
    /// The browser gives pages no database, as some do in private windows.
    pub fn open() -> Result<Self, StoreError> {
        let prepared = PREPARED.with(|place| place.borrow_mut().take());
        let Prepared { slot, left, keep } =
            prepared.filter(|prepared| is_name(&prepared.slot)).ok_or_else(|| {
                StoreError::new(
                    "this browser keeps nothing for this page",
                    "Allow the page to store data, and save your work to a file often.",
                )
            })?;
        Ok(Self { slot: slot.into(), left, keep })
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
    /// It is done when the future ends, but asked for at once.
    ///
    /// # Errors
    /// They don't fit, or they don't come back as they were written.
    pub fn save(
        &self,
        slot: &str,
        bytes: &[u8],
    ) -> impl Future<Output = Result<(), StoreError>> + 'static {
        let now = js_sys::Date::now() as u64;
        let bytes = sealed(&[&now.to_le_bytes()[..], bytes].concat());
        self.asked(slot, Uint8Array::from(&bytes[..]).into())
    }

    /// What tabs left behind that had ended when this one began, the newest first. What is not
    /// whole is passed over.
    pub fn load_all(&mut self) -> Vec<Recovered> {
        let now = js_sys::Date::now() as u64;
        let mut found: Vec<Recovered> = self
            .left
            .drain(..)
            .filter_map(|(slot, all)| {
                let (when, bytes) = opened(&all)?.split_first_chunk()?;
                let age = now.checked_sub(u64::from_le_bytes(*when)).map(Duration::from_millis);
                Some(Recovered { slot, bytes: bytes.to_owned(), age })
            })
            .collect();
        found.sort_by(|a, b| a.age.cmp(&b.age).then_with(|| a.slot.cmp(&b.slot)));
        found
    }

    /// Empties a slot, soon. Where the browser does not do it, the work is offered once more.
    ///
    /// # Errors
    /// There is no such slot.
    pub fn remove(&mut self, slot: &str) -> Result<(), StoreError> {
        let emptied = self.emptied(checked(slot)?);
        spawn_local(async move {
            let _ = emptied.await;
        });
        Ok(())
    }

    /// Empties a slot. It is done when the future ends, but asked for at once.
    ///
    /// # Errors
    /// The browser does not let it.
    pub fn emptied(&self, slot: &str) -> impl Future<Output = Result<(), StoreError>> + 'static {
        self.asked(slot, JsValue::UNDEFINED)
    }

    fn asked(
        &self,
        slot: &str,
        bytes: JsValue,
    ) -> impl Future<Output = Result<(), StoreError>> + 'static {
        let asked = checked(slot).map(|slot| self.keep.call2(&JsValue::NULL, &slot.into(), &bytes));
        async move {
            let promise = asked?.and_then(JsCast::dyn_into::<Promise>).map_err(|e| told(&e))?;
            JsFuture::from(promise).await.map(drop).map_err(|e| told(&e))
        }
    }

    /// A setting; `None` if it was never set.
    pub fn get(&self, name: &str) -> Option<String> {
        storage()?.get_item(&format!("{SETTING}{}", checked(name).ok()?)).ok()?
    }

    /// Keeps a setting.
    ///
    /// # Errors
    /// The browser does not keep it.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), StoreError> {
        let key = format!("{SETTING}{}", checked(name)?);
        let is_set = storage().and_then(|storage| storage.set_item(&key, text).ok());
        is_set.ok_or_else(|| {
            StoreError::new("the browser keeps no settings", "Allow the page to store data.")
        })
    }
}

/// What the page's script says of an error.
fn told(error: &JsValue) -> StoreError {
    let text =
        error.dyn_ref::<Error>().map_or_else(|| format!("{error:?}"), |e| e.message().into());
    StoreError::new(text, "Save your work to a file; it is not safe here.")
}

fn storage() -> Option<Storage> {
    web_sys::window()?.local_storage().ok().flatten()
}
