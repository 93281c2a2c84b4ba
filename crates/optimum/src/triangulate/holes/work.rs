//! Counted work, so that a search ends after a stated amount of it with the same answer on every
//! machine, however busy. With a clock, the answer would vary.
//!
//! A *step* is about the time of comparing a sum of two prices with the least one so far: a
//! nanosecond on a core of 2020. Slower operations count as several steps.

use std::cell::Cell;

/// Steps for the fold price of a triangle.
pub(super) const FOLD: u64 = 16;
/// Steps for the price of a rung.
pub(super) const SIDE: u64 = 40;
/// Steps for testing whether a rung crosses a cut.
pub(super) const CUT: u64 = 8;
/// Steps for a triangle of the bound: it lies anywhere in memory, and is read and written.
pub(super) const LOOK: u64 = 6;
/// Steps for a new triangle of the bound.
pub(super) const TRIANGLE: u64 = 100;

/// The steps done, and whether the limit cut the search short.
#[derive(Default)]
pub(in crate::triangulate) struct Tally {
    done: Cell<u64>,
    cut_short: Cell<bool>,
}

impl Tally {
    pub(in crate::triangulate) fn done(&self) -> u64 {
        self.done.get()
    }

    pub(in crate::triangulate) fn is_cut_short(&self) -> bool {
        self.cut_short.get()
    }
}

/// The steps that a search has done, and its limit.
#[derive(Clone, Copy)]
pub(in crate::triangulate) struct Work<'a> {
    tally: &'a Tally,
    end: u64,
}

impl<'a> Work<'a> {
    /// Work that may go on until this many steps are done.
    pub(in crate::triangulate) fn new(tally: &'a Tally, end: u64) -> Self {
        Self { tally, end }
    }

    /// A share of the remaining work.
    pub(in crate::triangulate) fn part(self, share: f64) -> Self {
        let done = self.tally.done();
        Self { end: done + (share * self.end.saturating_sub(done) as f64) as u64, ..self }
    }

    /// Counts steps that were done.
    #[inline]
    pub(super) fn count(self, steps: u64) {
        self.tally.done.set(self.tally.done().saturating_add(steps));
    }

    /// How many steps are left.
    pub(in crate::triangulate) fn left(self) -> u64 {
        self.end.saturating_sub(self.tally.done())
    }

    /// Whether the limit is reached: then the caller ends, and the search is cut short.
    #[inline]
    pub(super) fn is_out(self) -> bool {
        let is_out = self.tally.done() >= self.end;
        if is_out {
            self.cut_short();
        }
        is_out
    }

    /// Notes that the limit cut the search short.
    pub(super) fn cut_short(self) {
        self.tally.cut_short.set(true);
    }

    /// The share of the work that is done, 0 ..= 1.
    pub(super) fn share(self) -> f64 {
        (self.tally.done() as f64 / self.end.max(1) as f64).min(1.0)
    }
}
