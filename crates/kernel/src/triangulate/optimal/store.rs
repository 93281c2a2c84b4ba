//! The memory of a table, kept for the next one.
//!
//! While a handle is dragged, and over many holes or panels, one table follows another of about the
//! same size. Fresh memory comes page by page from the system, which took a seventh of the time. So each
//! thread keeps the memory of its last small table. Nothing is read of it before it is written.

use crate::cost::{LANES, Lanes};
use std::cell::Cell;

/// Larger tables give their memory back, bytes: there, filling them takes far longer.
const MOST_KEPT: usize = 16 << 20;

thread_local! {
    static SPARE: Cell<Option<Store>> = const { Cell::new(None) };
}

/// The memory of a table.
#[derive(Default)]
pub(super) struct Store {
    /// Rows of tiles.
    pub(super) entries: Vec<Lanes>,
    /// N in the same order, by axis; empty when folds cost nothing.
    pub(super) means: Vec<[Lanes; 3]>,
    /// The finite entries of every row once more, packed: where and what.
    pub(super) row_k: Vec<u32>,
    pub(super) row_entries: Vec<f64>,
}

impl Store {
    /// Memory for so many rows of tiles, with or without N, and so many pairs. What it holds is left
    /// over from before.
    pub(super) fn new(slots: usize, folds: bool, pairs: usize) -> Self {
        let mut store = SPARE.take().unwrap_or_default();
        fit(&mut store.entries, slots, [0.0; LANES]);
        fit(&mut store.means, if folds { slots } else { 0 }, [[0.0; LANES]; 3]);
        fit(&mut store.row_k, pairs, 0);
        fit(&mut store.row_entries, pairs, 0.0);
        store
    }

    fn bytes(&self) -> usize {
        self.entries.capacity() * size_of::<Lanes>()
            + self.means.capacity() * size_of::<[Lanes; 3]>()
            + self.row_k.capacity() * (size_of::<u32>() + size_of::<f64>())
    }
}

/// Gives a list this length. One that must grow begins anew: nothing need be carried over.
fn fit<T: Clone>(list: &mut Vec<T>, length: usize, fill: T) {
    if list.capacity() < length {
        *list = vec![fill; length];
    } else {
        list.resize(length, fill);
    }
}

impl Store {
    /// Keeps it for the next table of this thread, unless what is kept is larger.
    pub(super) fn keep(self) {
        if self.bytes() > MOST_KEPT {
            return;
        }
        // A thread that ends keeps nothing.
        let _ = SPARE.try_with(|spare| {
            let other = spare.take().filter(|other| other.bytes() > self.bytes());
            spare.set(Some(other.unwrap_or(self)));
        });
    }
}
