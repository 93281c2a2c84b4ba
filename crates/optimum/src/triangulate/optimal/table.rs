//! The table: its tiles, the order in which they are filled, and the trace of the optimum.

mod filling;
mod shared;

use super::lanes::{lowest, of_lane};
use super::memory_needed;
use super::threads::Helpers;
use super::tile_pool::TilePool;
use crate::cost::{FarEnds, LANES, Lanes};
use crate::triangulate::{Terms, TriangulateError};
use shared::Shared;
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;
use std::ops::Range;

/// The share of a length that rounding may take off it.
const SLACK: f64 = 1e-12;

/// The door between the table and all pruning: what it may leave out, since it can't be part of
/// an answer up to a bound on the price.
///
/// The table asks nothing else. Whatever answers [`Unpruned`] gives, or others that are true, the
/// triangulation and its price are the same, ties included.
pub(super) trait Pruning: Sync {
    /// Entries above it are left out; infinite if none are.
    fn bound(&self) -> f64;

    /// Lower bound on the price of any rung between these rows and this column of tiles, with what
    /// the rest of the loop costs beside it, where no edge of the boundary is among them.
    /// A tile whose least is above the bound is left out.
    fn least(&self, row: usize, column: usize) -> f64;

    /// Lower bounds on what the rest of the loop and half of the rung cost, for each rung from
    /// sample `i` to the far ends; 0 for edges of the boundary, infinite for what is left out.
    fn rests(&self, i: usize, to: &FarEnds) -> Lanes;

    /// What it takes beside the table, bytes.
    fn bytes(&self) -> u64;
}

/// Leaves out nothing.
pub(super) struct Unpruned;

impl Pruning for Unpruned {
    fn bound(&self) -> f64 {
        f64::INFINITY
    }

    fn least(&self, _row: usize, _column: usize) -> f64 {
        0.0
    }

    fn rests(&self, _i: usize, _to: &FarEnds) -> Lanes {
        [0.0; LANES]
    }

    fn bytes(&self) -> u64 {
        0
    }
}

/// The table in tiles of [`LANES`] rows by as many columns, on and above the diagonal.
pub(super) struct Table<'a> {
    pub(super) terms: &'a Terms<'a>,
    pub(super) m: usize,
    store: TilePool,
    folds: bool,
    /// Whether samples are numbered in order, so that many triangles can be priced at once.
    in_order: bool,
    /// The widest registers of the processor.
    pub(super) registers: pulp::Arch,
}

impl<'a> Table<'a> {
    pub(super) fn new(terms: &'a Terms<'a>) -> Self {
        let m = terms.prices.len();
        let folds = terms.folds();
        Self {
            terms,
            m,
            store: TilePool::new(m.div_ceil(LANES), folds),
            folds,
            in_order: terms.prices.in_order(),
            registers: pulp::Arch::new(),
        }
    }

    /// Fills the table with all entries that pruning does not leave out, and returns the price of
    /// the answer. `share` is the part of the progress that this is.
    pub(super) fn fill(
        &mut self,
        pruning: &dyn Pruning,
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<f64, TriangulateError> {
        self.clear();
        let columns = self.m.div_ceil(LANES);
        let ends: Vec<FarEnds> =
            (0..columns).map(|at| self.terms.prices.far_ends(at * LANES)).collect();
        self.fit(pruning)?;
        let shared = Shared::new(self, &ends, pruning);
        match Helpers::call(columns) {
            Some(helpers) => helpers.join(|| shared.help(), || shared.lead(watch, share))?,
            None => shared.lead(watch, share)?,
        }
        Ok(self.entry(0, self.m - 1))
    }

    /// Refuses tiles that do not fit the memory.
    fn fit(&self, pruning: &dyn Pruning) -> Result<(), TriangulateError> {
        let limit = self.terms.memory;
        if self.bytes().saturating_add(pruning.bytes()) > limit {
            return Err(TriangulateError::TooLarge { needed: memory_needed(self.m), limit });
        }
        Ok(())
    }

    /// Forgets all entries.
    pub(super) fn clear(&mut self) {
        self.store.clear();
    }

    /// What it takes, with who sees whom, bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.store.bytes() + self.terms.visibility.bytes()
    }

    /// N of the rung ⟨i,j⟩; zero where folds cost nothing or none is stored.
    fn mean(&self, i: usize, j: usize) -> [f64; 3] {
        let means = self.store.tile(i / LANES, j / LANES).and_then(|tile| tile.means_from(i));
        means.map_or([0.0; 3], |means| of_lane(means, j % LANES))
    }

    pub(super) fn entry(&self, i: usize, j: usize) -> f64 {
        let tile = self.store.tile(i / LANES, j / LANES);
        tile.map_or(f64::INFINITY, |tile| tile.sums.entries[i % LANES][j % LANES])
    }

    /// F(i,k,j).
    fn fold(&self, i: usize, k: usize, j: usize) -> f64 {
        if !self.folds {
            return 0.0;
        }
        let mean = |a: usize, b: usize| Vec3::from_array(self.mean(a, b));
        self.terms.prices.triangle([i, k, j], [mean(i, k), mean(k, j), mean(i, j)])
    }

    /// The triangles below the edge ⟨0, m−1⟩, whose price must be finite.
    pub(super) fn trace(&self) -> Vec<[usize; 3]> {
        let reaches = self.reaches();
        let mut triangles = Vec::with_capacity(self.m - 2);
        let mut parts = vec![(0, self.m - 1)];
        while let Some((i, j)) = parts.pop() {
            if j - i < 2 {
                continue;
            }
            let k = self.chosen(i, j, &reaches);
            triangles.push([i, k, j]);
            parts.extend([(i, k), (k, j)]);
        }
        triangles
    }

    /// The sample in the middle of each column of tiles, and how far the others are from it, mm.
    fn reaches(&self) -> Vec<(usize, f64)> {
        let reach = |at: usize| {
            let samples = at * LANES..self.m.min((at + 1) * LANES);
            let middle = usize::midpoint(samples.start, samples.end);
            let lengths = samples.map(|k| self.terms.prices.length(middle, k));
            (middle, lengths.fold(0.0, f64::max))
        };
        (0..self.m.div_ceil(LANES)).map(reach).collect()
    }

    /// The k of E(i,j), by the rule for equals.
    fn chosen(&self, i: usize, j: usize, reaches: &[(usize, f64)]) -> usize {
        let mut chosen = (f64::INFINITY, f64::INFINITY, usize::MAX);
        let columns = self.store.beside(i / LANES).iter().map(|at| *at as usize);
        for at in columns.take_while(|at| at * LANES < j) {
            let (Some(own), Some(beyond)) =
                (self.store.tile(i / LANES, at), self.store.tile(at, j / LANES))
            else {
                continue;
            };
            let least = [own.sums.least[i % LANES], lowest(&beyond.sums.least)];
            let least = self.terms.together(least[0], least[1]);
            // On flat stretches all are equal, and most are a long way round.
            let (middle, reach) = reaches[at];
            let detour = self.terms.prices.detour(i, middle, j);
            let is_longer = detour - 2.0 * reach - SLACK * detour > chosen.1;
            if least > chosen.0 || (least == chosen.0 && is_longer) {
                continue;
            }
            for n in 0..LANES {
                let (k, entry) = (at * LANES + n, own.sums.entries[i % LANES][n]);
                let sum = self.terms.together(entry, beyond.sums.entries[n][j % LANES]);
                if sum == f64::INFINITY || sum > chosen.0 {
                    continue;
                }
                // None is cheaper than its own sum.
                let detour = self.terms.prices.detour(i, k, j);
                if sum == chosen.0 && detour > chosen.1 {
                    continue;
                }
                let key = (sum + self.fold(i, k, j), detour, k);
                if key < chosen {
                    chosen = key;
                }
            }
        }
        debug_assert!(chosen.2 < j, "no sums make the entry {i} {j}");
        chosen.2
    }
}

#[cfg(test)]
mod tests;
