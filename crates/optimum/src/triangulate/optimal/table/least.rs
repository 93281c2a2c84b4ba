//! What is known of the rungs from one sample to those of a tile, while their entries are looked
//! for.

use crate::cost::{Aligned, Fans, FarEnds, LANES, Lanes, Segment};

/// The least sums below the rungs from one sample to those of a tile, on the way.
pub(super) struct Least<'a> {
    pub(super) i: usize,
    pub(super) to: &'a FarEnds,
    pub(super) means: &'a [Lanes; 3],
    /// Means nothing where folds cost nothing.
    pub(super) fans: Fans<'a>,
    /// Where those of the tile lie, if that is known.
    pub(super) segment: Option<&'a Segment>,
    /// Infinitely low where nothing is looked for.
    pub(super) prices: Aligned<Lanes>,
    /// The k that they were found at; 0 for none.
    pub(super) best: Aligned<Lanes>,
}

impl Least<'_> {
    /// Takes what is lower with this k for one lane.
    #[inline(always)]
    pub(super) fn lower_one(&mut self, n: usize, k: usize, price: f64) {
        if price < self.prices[n] {
            (self.prices[n], self.best[n]) = (price, k as f64);
        }
    }

    /// What F must be below, with E(i,k) = `entry` and E(k,j) = `entries`.
    #[inline(always)]
    pub(super) fn left(&self, entry: f64, entries: &Lanes) -> Lanes {
        let mut left = [0.0; LANES];
        for n in 0..LANES {
            left[n] = self.prices[n] - (entry + entries[n]);
        }
        left
    }

    /// What F must be below, as [`Self::left`] has it, but 0 for the lane `one`, whose triangle is
    /// known: no F is below that.
    #[inline(always)]
    pub(super) fn left_but(&self, one: usize, entry: f64, entries: &Lanes) -> Lanes {
        let mut left = [0.0; LANES];
        for n in 0..LANES {
            let rest = self.prices[n] - (entry + entries[n]);
            left[n] = if n == one { 0.0 } else { rest };
        }
        left
    }

    /// Takes what is lower with this k.
    #[inline(always)]
    pub(super) fn lower(&mut self, k: usize, price: impl Fn(usize) -> f64) {
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            prices[n] = price(n);
        }
        // One list after the other, of one type: else the lanes are compared one by one.
        let before = self.prices;
        for n in 0..LANES {
            self.prices[n] = if prices[n] < before[n] { prices[n] } else { before[n] };
        }
        for n in 0..LANES {
            self.best[n] = if prices[n] < before[n] { k as f64 } else { self.best[n] };
        }
    }
}
