//! In which order the tiles of a table are filled, by one thread or more.
//!
//! 1. Of [`WIDTH`] columns of tiles, one diagonal after the other is filled. The tiles of a
//!    diagonal do not depend on one another, so the bits are the same whichever thread fills them.
//!    Data that neighbouring tiles share then comes from the processors' caches; with diagonals of
//!    all columns, two threads take 1.4 times as long at 100,000 samples (*wavy*).
//! 2. A table of 400 samples has 25 diagonals and takes a few milliseconds: waking threads for each
//!    of them would take longer than the work. So helpers are called once for a table, and wait for
//!    the next diagonal in a loop until the last is filled (`threads`).

use super::filling::Filling;
use super::{Pruning, Table};
use crate::cost::FarEnds;
use crate::triangulate::TriangulateError;
use crate::triangulate::optimal::tile_pool::Tile;
use sheetwright_geometry::watch::Watch;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError, RwLock, RwLockWriteGuard, TryLockError};

/// So many columns of tiles are filled together: twice as many as there may be threads, so that
/// none waits for others.
const WIDTH: usize = 32;
/// The numbers that no diagonal has, before the first and after the last.
const NONE_YET: usize = usize::MAX - 1;
const NONE_LEFT: usize = usize::MAX;

/// What threads share while they fill a table.
pub(super) struct Shared<'s, 'a> {
    ends: &'s [FarEnds],
    pruning: &'s dyn Pruning,
    /// A thread that fills a tile reads it.
    diagonal: RwLock<Diagonal<'s, 'a>>,
    /// The number of the diagonal that is filled, [`NONE_YET`] or [`NONE_LEFT`].
    at: AtomicUsize,
}

/// A diagonal of tiles, and the table that has all before it.
struct Diagonal<'s, 'a> {
    table: &'s mut Table<'a>,
    /// Its open tiles, with their rows and columns.
    tiles: Vec<([usize; 2], Mutex<Tile>)>,
    /// How many of them were given out to be filled.
    given: AtomicUsize,
}

/// Dismisses the helpers when it is dropped, also in a panic.
struct End<'s>(&'s AtomicUsize);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.store(NONE_LEFT, Ordering::Release);
    }
}

// A thread that panics leaves a lock that says so. The others go on, and `rayon` passes the panic
// on in the end.
impl<'s, 'a> Shared<'s, 'a> {
    pub(super) fn new(
        table: &'s mut Table<'a>,
        ends: &'s [FarEnds],
        pruning: &'s dyn Pruning,
    ) -> Self {
        let diagonal = Diagonal { table, tiles: vec![], given: AtomicUsize::new(0) };
        Self { ends, pruning, diagonal: RwLock::new(diagonal), at: AtomicUsize::new(NONE_YET) }
    }

    /// Fills tiles of the diagonal until all are given out.
    fn fill_some(&self) {
        let diagonal = self.diagonal.read().unwrap_or_else(PoisonError::into_inner);
        let (table, pruning) = (&*diagonal.table, self.pruning);
        let next = || diagonal.tiles.get(diagonal.given.fetch_add(1, Ordering::Relaxed));
        while let Some(&([row, column], ref tile)) = next() {
            let mut tile = tile.lock().unwrap_or_else(PoisonError::into_inner);
            let (to, tile) = (&self.ends[column], &mut *tile);
            table.registers.dispatch(Filling { table, pruning, row, to, tile });
        }
    }

    /// Fills tiles of one diagonal after the other, until none is left.
    pub(super) fn help(&self) {
        let mut last = NONE_YET;
        loop {
            match self.at.load(Ordering::Acquire) {
                NONE_LEFT => return,
                at if at == last => std::thread::yield_now(),
                at => {
                    last = at;
                    self.fill_some();
                }
            }
        }
    }

    /// The diagonal, as soon as no thread fills tiles of it. It yields in a loop, since the wait is
    /// shorter than putting the thread to sleep.
    fn alone(&self) -> RwLockWriteGuard<'_, Diagonal<'s, 'a>> {
        loop {
            match self.diagonal.try_write() {
                Ok(diagonal) => return diagonal,
                Err(TryLockError::Poisoned(poisoned)) => return poisoned.into_inner(),
                Err(TryLockError::WouldBlock) => std::thread::yield_now(),
            }
        }
    }

    /// Fills all diagonals, with helpers or alone.
    pub(super) fn lead(
        &self,
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<(), TriangulateError> {
        let _end = End(&self.at);
        let count = self.ends.len();
        let mut number = 0;
        for first in (0..count).step_by(WIDTH) {
            let end = count.min(first + WIDTH);
            let [before, after] =
                [first, end].map(|at| at as f64 / count as f64).map(|x| x * x * x);
            for away in 0..end {
                let places = (first.max(away)..end).map(|column| [column - away, column]);
                // A diagonal may take long: it is asked for each of its tiles.
                if places.clone().any(|_| watch.stop()) {
                    return Err(TriangulateError::Stopped);
                }
                if self.alone().begin(self.pruning, places) {
                    self.at.store(number, Ordering::Release);
                    number += 1;
                    self.fill_some();
                    self.alone().keep(self.pruning)?;
                }
                // The sums of a tile are as many as its distance from the diagonal.
                let of_group = (away + 1) as f64 / end as f64;
                let done = before + (after - before) * of_group * of_group;
                watch.progress(share.start + (share.end - share.start) * done);
            }
        }
        Ok(())
    }
}

impl Diagonal<'_, '_> {
    /// Gives out the tiles in these places that are open; returns whether there are any.
    fn begin(&mut self, pruning: &dyn Pruning, places: impl Iterator<Item = [usize; 2]>) -> bool {
        for [row, column] in places {
            if pruning.least(row, column) <= pruning.bound() {
                self.tiles.push(([row, column], Mutex::new(self.table.store.fresh())));
            }
        }
        *self.given.get_mut() = 0;
        !self.tiles.is_empty()
    }

    /// Takes those that were filled into the table.
    fn keep(&mut self, pruning: &dyn Pruning) -> Result<(), TriangulateError> {
        for ([row, column], tile) in self.tiles.drain(..) {
            let tile = tile.into_inner().unwrap_or_else(PoisonError::into_inner);
            self.table.store.put(row, column, tile);
        }
        self.table.fit(pruning)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Unpruned;
    use super::*;
    use crate::cost::{LANES, PriceOptions, Prices};
    use crate::rung::Visibility;
    use crate::test_boundaries::waving;
    use crate::triangulate::Terms;
    use sheetwright_geometry::watch::Unwatched;

    #[test]
    fn a_helper_alone_fills_all() {
        let prices = Prices::new(&waving(320, 0.3), None, PriceOptions::default());
        let everything = Visibility::everything();
        let terms = Terms::new(&prices, &everything, false);
        let (mut led, mut helped) = (Table::new(&terms), Table::new(&terms));
        let ends: Vec<FarEnds> = (0..20).map(|at| prices.far_ends(at * LANES)).collect();
        Shared::new(&mut led, &ends, &Unpruned).lead(&mut Unwatched, 0.0..1.0).unwrap();
        let shared = Shared::new(&mut helped, &ends, &Unpruned);
        std::thread::scope(|scope| {
            scope.spawn(|| shared.help());
            let _end = End(&shared.at);
            for away in 0..20 {
                let places = (away..20).map(|column| [column - away, column]);
                if shared.alone().begin(&Unpruned, places) {
                    shared.at.store(away, Ordering::Release);
                    let is_left = || {
                        let diagonal = shared.diagonal.read().unwrap();
                        diagonal.given.load(Ordering::Relaxed) < diagonal.tiles.len()
                    };
                    while is_left() {
                        std::thread::yield_now();
                    }
                    shared.alone().keep(&Unpruned).unwrap();
                }
            }
        });
        drop(shared);
        assert!(led.entry(0, 319) < 1.0);
        for (i, j) in (0..320).flat_map(|i| (i + 1..320).map(move |j| (i, j))) {
            assert_eq!(helped.entry(i, j).to_bits(), led.entry(i, j).to_bits(), "{i} {j}");
        }
    }
}
