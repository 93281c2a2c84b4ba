//! The least sums so far below the rungs from one sample to those of a tile.

use crate::cost::{Aligned, Fans, FarEnds, LANES, Lanes, Segment};

/// The least sums so far below the rungs from one sample to those of a tile.
pub(super) struct Least<'a> {
    pub(super) i: usize,
    pub(super) to: &'a FarEnds,
    pub(super) means: &'a [Lanes; 3],
    /// Undefined where folds cost nothing.
    pub(super) fans: Fans<'a>,
    /// The segment near which the samples of the tile lie, if it is known.
    pub(super) segment: Option<&'a Segment>,
    /// −∞ where no entry is wanted.
    pub(super) prices: Aligned<Lanes>,
    /// The k that they were found at; 0 for none.
    pub(super) best: Aligned<Lanes>,
}

impl Least<'_> {
    /// Lowers the sum of one lane, if it is lower with this k.
    #[inline(always)]
    pub(super) fn lower_one(&mut self, n: usize, k: usize, price: f64) {
        if price < self.prices[n] {
            (self.prices[n], self.best[n]) = (price, k as f64);
        }
    }

    /// Upper limits of F, with E(i,k) = `entry` and E(k,j) = `entries`.
    #[inline(always)]
    pub(super) fn left(&self, entry: f64, entries: &Lanes) -> Lanes {
        let mut left = [0.0; LANES];
        for n in 0..LANES {
            left[n] = self.prices[n] - (entry + entries[n]);
        }
        left
    }

    /// Upper limits of F, as [`Self::left`] has them, but 0 for the lane `one`, whose triangle is
    /// done: no F is below 0.
    #[inline(always)]
    pub(super) fn left_but(&self, one: usize, entry: f64, entries: &Lanes) -> Lanes {
        let mut left = [0.0; LANES];
        for n in 0..LANES {
            let rest = self.prices[n] - (entry + entries[n]);
            left[n] = if n == one { 0.0 } else { rest };
        }
        left
    }

    /// Lowers the sums that are lower with this k.
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
