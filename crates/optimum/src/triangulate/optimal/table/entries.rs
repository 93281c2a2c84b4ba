//! The entries of a row of a tile, one after the other: E(i,j) with k among the samples of the
//! tile's own column depends on E(i,k) of the same row.
//!
//! Nearly all of these k matter only for the triangle on the edge of the boundary from k to the
//! next sample. So with a fold price, F of those triangles is computed for all j at once. Their
//! prices, from left to right, come before all other k, few of which are then lower.

use super::Table;
use super::least::Least;
use crate::cost::{Aligned, Fan, FanRungs, LANES, Lanes};
use crate::triangulate::optimal::lanes::of_lane;
use crate::triangulate::optimal::tile_pool::Tile;

/// The rungs of a row of a tile.
pub(super) struct RungsOfRow<'a> {
    pub(super) prices: &'a Lanes,
    /// Upper limits of the sums below each.
    pub(super) below: &'a Lanes,
}

impl RungsOfRow<'_> {
    /// E(i,j), as far as is known.
    #[inline(always)]
    fn entry(&self, least: &Least<'_>, n: usize, together: impl Fn(f64, f64) -> f64) -> f64 {
        let j = least.to.first + n;
        if j == least.i + 1 {
            self.prices[n]
        } else if j > least.i && least.prices[n] < self.below[n] {
            together(self.prices[n], least.prices[n])
        } else {
            f64::INFINITY
        }
    }
}

/// The triangles i, j − 1, j on edges of the boundary, for all j of a row. Most triangles of a
/// triangulation are such, or have their edge at i, so F is computed for all of them at once, and
/// only here.
pub(super) struct OnEdgesOfRow {
    folds: Aligned<Lanes>,
    /// E of the rung before the first of the row.
    before: f64,
}

impl OnEdgesOfRow {
    pub(super) const NONE: Self =
        Self { folds: Aligned([f64::INFINITY; LANES]), before: f64::INFINITY };

    /// Lowers the least sums to these, from left to right.
    #[inline(always)]
    pub(super) fn lower(&self, least: &mut Least<'_>, rungs: &RungsOfRow<'_>) {
        let mut entry = self.before;
        for n in 0..least.to.count {
            if least.to.first > 0 {
                least.lower_one(n, least.to.first + n - 1, entry + self.folds[n]);
            }
            entry = rungs.entry(least, n, |a, b| a + b);
        }
    }
}

impl Table<'_> {
    /// The entries of a row, from left to right, since those to the left are E(i,k) with k in the
    /// column itself. `least` holds the least sums over all other k.
    #[inline(always)]
    pub(super) fn entries_of_row<const FOLDS: bool, const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        rungs: &RungsOfRow<'_>,
        on_edges: &OnEdgesOfRow,
        diagonal: Option<&Tile>,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) -> Lanes {
        let mut entries = [f64::INFINITY; LANES];
        for n in 0..least.to.count {
            let (j, next) = (least.to.first + n, n + 1);
            entries[n] = rungs.entry(least, n, together);
            let Some(diagonal) = diagonal.filter(|_| entries[n] < f64::INFINITY) else { continue };
            if !(FOLDS && self.in_order) {
                let means = Some(least.means);
                self.look::<FOLDS, FUSED>(least, j, entries[n], means, diagonal, together);
            } else if next < LANES {
                least.lower_one(next, j, entries[n] + on_edges.folds[next]);
                self.look_beyond_edge::<FUSED>(least, j, entries[n], diagonal);
            }
        }
        entries
    }

    /// The data of the triangles i, j − 1, j.
    #[inline(always)]
    pub(super) fn on_edges_of_row(&self, least: &Least<'_>, row: usize) -> OnEdgesOfRow {
        let (i, first) = (least.i, least.to.first);
        let last = if i == 0 { self.m - 1 } else { usize::MAX };
        // ⟨i,j−1⟩ may be an edge, too, and so may ⟨i,j⟩.
        let rungs =
            FanRungs { most: 2.0, fewer: [i + 2, last].map(|edge| edge.wrapping_sub(first)) };
        let own = if first > i + 1 { self.store.tile(row, first / LANES - 1) } else { None };
        let (mut before, mut entry) = ([[0.0; 3]; 2], f64::INFINITY);
        if let Some(own) = own
            && let Some(means) = own.means_from(i)
        {
            entry = own.sums.entries[i % LANES][LANES - 1];
            before = [self.terms.prices.offset(i, first - 1), of_lane(means, LANES - 1)];
        }
        OnEdgesOfRow { folds: Aligned(least.fans.on_edges(before, rungs)), before: entry }
    }

    /// Tests the triangles i, k, j with k in the column of j, except the j next to it.
    #[inline(always)]
    fn look_beyond_edge<const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        diagonal: &Tile,
    ) {
        let (entries, n) = (&diagonal.sums.entries[k % LANES], k - least.to.first);
        let left = least.left_but(n + 1, entry, entries);
        let mut any = false;
        for lane in 0..LANES {
            any |= left[lane] > 0.0;
        }
        if any && let Some(beyond) = diagonal.means_from(k) {
            let side = self.terms.prices.offset(least.i, k);
            let fan = Fan { side, shared: of_lane(least.means, n), beyond };
            let rungs = self.least_rungs(least.i, k);
            self.look_at_fan::<FUSED>(least, (k, entry), (&fan, rungs), (entries, &left));
        }
    }
}
