//! The table: its tiles, the order in which they are filled, and the trace of the optimum.

mod between;
mod entries;
mod filling;
mod least;
#[cfg(feature = "rayon")]
mod shared;

use super::band::Band;
use super::completion_bound::CompletionBound;
use super::lanes::{lowest, of_lane};
use super::prune::Open;
#[cfg(feature = "rayon")]
use super::threads::Helpers;
use super::tile_pool::{Tile, TilePool};
use super::{HIGHEST_BOUND, memory_needed};
use crate::cost::{EXACT_BELOW, LANES};
use crate::triangulate::part::Part;
use crate::triangulate::{Rule, Terms, TriangulateError};
use filling::{Column, Filling};
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;
use std::ops::Range;

/// So many columns of tiles are filled together: the tiles to the left in these rows, which all of
/// them need, then come from the processor's cache for all but the first. One column at a time,
/// with folds, the cone takes 1.7 times as long at 10,000 samples, where 7 % of all tiles are kept;
/// random curves and the twisted strip 1.2 to 2.1 times at 3,200, where 38 to 67 % are.
const GROUP: usize = 8;
/// With fewer samples, the completion bound takes longer on the whole than it saves: at 400 a strip
/// takes 0.65 times as long with it, but random curves 1.1 to 1.3 times.
const LEAST_OUTSIDE: usize = 640;
/// Its share of the time, about.
const SHARE_OF_OUTSIDE: f64 = 0.3;
/// Rounding error of a length at most, as a share of it.
const SLACK: f64 = 1e-12;

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
    /// Lower bounds on the price of the rest of the loop beside each rung.
    outside: Option<CompletionBound>,
}

/// The ways from one sample to another over those of a column of tiles.
struct Ways<'t> {
    /// Lower bound on their lengths, mm.
    least: f64,
    at: usize,
    /// With E of their first halves.
    own: &'t Tile,
    /// With E of their second halves.
    beyond: &'t Tile,
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
            outside: None,
        }
    }

    /// Fills the table with all entries that may be part of a triangulation up to the price
    /// `bound`, except those of rungs outside the band, and returns the price of the optimum.
    /// `share` is the range of the progress for this.
    pub(super) fn fill(
        &mut self,
        bound: f64,
        band: Option<&Band>,
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<f64, TriangulateError> {
        let open = Open::new(self.terms, bound, band);
        self.outside = None;
        let mut start = share.start;
        if self.has_outside() && bound <= HIGHEST_BOUND && band.is_none() {
            let runs = CompletionBound::runs(self.terms);
            let needed = CompletionBound::most_bytes(&runs);
            self.clear_for(needed);
            if self.bytes().saturating_add(needed) <= self.terms.memory {
                start += SHARE_OF_OUTSIDE * (share.end - share.start);
                let mut part = Part::new(watch, share.start..start);
                self.outside =
                    Some(CompletionBound::new(runs, self.terms, self.registers, &open, &mut part)?);
            }
        }
        self.fill_open(&open, watch, start..share.end)
    }

    /// Fills the open tiles, and returns the price of the optimum. `share` is the range of the
    /// progress for this.
    pub(super) fn fill_open(
        &mut self,
        open: &Open<'_>,
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<f64, TriangulateError> {
        self.store.clear();
        let columns = self.m.div_ceil(LANES);
        let mut columns: Vec<Column> = (0..columns).map(|at| Column::new(self.terms, at)).collect();
        self.fit()?;
        let tell = |done: f64, watch: &mut dyn Watch| {
            watch.progress(share.start + (share.end - share.start) * done);
        };
        #[cfg(feature = "rayon")]
        if let Some(helpers) = Helpers::call(self.m.div_ceil(LANES)) {
            self.fill_shared(&helpers, columns, open, watch, tell)?;
            return Ok(self.entry(0, self.m - 1));
        }
        self.fill_by_columns(&mut columns, open, watch, tell)?;
        Ok(self.entry(0, self.m - 1))
    }

    /// Refuses tiles that exceed the memory limit.
    fn fit(&mut self) -> Result<(), TriangulateError> {
        let limit = self.terms.memory;
        if self.bytes() > limit {
            return Err(TriangulateError::TooLarge { needed: memory_needed(self.m), limit });
        }
        self.store.shrink_to(limit - self.terms.visibility.bytes() - self.outside_bytes());
        Ok(())
    }

    /// Clears all entries, and releases memory if another table needs so much, bytes.
    pub(super) fn clear_for(&mut self, another: u64) {
        self.store.clear();
        let taken = self.terms.visibility.bytes() + another;
        self.store.shrink_to(self.terms.memory.saturating_sub(taken));
    }

    /// Memory, with visible pairs and completion bounds, bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.store.bytes() + self.terms.visibility.bytes() + self.outside_bytes()
    }

    fn outside_bytes(&self) -> u64 {
        self.outside.as_ref().map_or(0, CompletionBound::bytes)
    }

    /// Whether the tile of these rows and columns may have finite entries.
    fn is_open(&self, open: &Open<'_>, row: usize, column: usize) -> bool {
        let has_some = |outside: &CompletionBound| {
            open.has_edges(row, column) || outside.least(row, column) < f64::INFINITY
        };
        self.outside.as_ref().is_none_or(has_some) && open.is_open(row, column)
    }

    /// Whether the completion bound is computed, where memory allows.
    fn has_outside(&self) -> bool {
        self.folds && self.in_order && self.m >= LEAST_OUTSIDE
    }

    /// Fills the open tiles, with the lower bounds `outside` on the price of the rest of the loop,
    /// if any. Returns the price of the optimum.
    #[cfg(test)]
    pub(super) fn fill_beside(
        &mut self,
        outside: Option<CompletionBound>,
        open: &Open<'_>,
        watch: &mut dyn Watch,
    ) -> Result<f64, TriangulateError> {
        self.outside = outside;
        self.fill_open(open, watch, 0.0..1.0)
    }

    /// [`GROUP`] columns of tiles at a time, row by row from the diagonal upwards.
    fn fill_by_columns(
        &mut self,
        columns: &mut [Column],
        open: &Open<'_>,
        watch: &mut dyn Watch,
        tell: impl Fn(f64, &mut dyn Watch),
    ) -> Result<(), TriangulateError> {
        let count = columns.len() as f64;
        for first in (0..columns.len()).step_by(GROUP) {
            let end = columns.len().min(first + GROUP);
            let [before, after] = [first, end].map(|at| at as f64 / count).map(|x| x * x * x);
            for row in (0..end).rev() {
                for at in first.max(row)..end {
                    if !self.is_open(open, row, at) {
                        continue;
                    }
                    if watch.stop() {
                        return Err(TriangulateError::Stopped);
                    }
                    let mut tile = self.store.fresh();
                    let column = &mut columns[at];
                    let filling = Filling { table: self, open, row, column, tile: &mut tile };
                    self.registers.dispatch(filling);
                    self.store.put(row, at, tile);
                }
                self.fit()?;
                // The sums of a tile are as many as its distance from the diagonal.
                let of_group = (end - row) as f64 / end as f64;
                tell(before + (after - before) * of_group * of_group, watch);
            }
        }
        Ok(())
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
    pub(super) fn fold(&self, i: usize, k: usize, j: usize) -> f64 {
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

    /// The sample in the middle of each column of tiles.
    fn middle(&self, at: usize) -> usize {
        (self.m - 1).min(at * LANES + LANES / 2)
    }

    /// How far the samples of each column of tiles are from the one in the middle, mm.
    fn reaches(&self) -> Vec<f64> {
        let reach = |at: usize| {
            let samples = at * LANES..self.m.min((at + 1) * LANES);
            let lengths = samples.map(|k| self.terms.prices.length(self.middle(at), k));
            lengths.fold(0.0, f64::max)
        };
        (0..self.m.div_ceil(LANES)).map(reach).collect()
    }

    /// The k of E(i,j), by the rule for equals.
    fn chosen(&self, i: usize, j: usize, reaches: &[f64]) -> usize {
        let price = self.price_below(i, j);
        let is_known = price < f64::INFINITY;
        let mut chosen = (price, f64::INFINITY, usize::MAX);
        // On flat stretches all prices tie, and most ways are long: the shortest come first.
        for Ways { least, at, own, beyond } in self.ways(i, j, price, reaches) {
            if is_known && least > chosen.1 {
                break;
            }
            for n in 0..LANES {
                let (k, entry) = (at * LANES + n, own.sums.entries[i % LANES][n]);
                let sum = self.terms.together(entry, beyond.sums.entries[n][j % LANES]);
                if sum > chosen.0 || sum == f64::INFINITY {
                    continue;
                }
                // No sum is below the known price, nor below its own least.
                let detour = self.terms.prices.detour(i, k, j);
                if (is_known || sum == chosen.0) && detour > chosen.1 {
                    continue;
                }
                let key = (sum + self.fold(i, k, j), detour, k);
                if key < chosen {
                    chosen = key;
                }
            }
        }
        debug_assert!(chosen.2 < j, "no sums make the entry {i} {j}: {price}");
        chosen.2
    }

    /// The tiles whose sums may be the least of E(i,j), the shortest ways first; without those
    /// whose sums exceed `price`.
    fn ways(&self, i: usize, j: usize, price: f64, reaches: &[f64]) -> Vec<Ways<'_>> {
        let columns = self.store.beside(i / LANES).iter().map(|at| *at as usize);
        let mut ways: Vec<Ways<'_>> = columns
            .take_while(|at| at * LANES < j)
            .filter_map(|at| {
                let own = self.store.tile(i / LANES, at)?;
                let beyond = self.store.tile(at, j / LANES)?;
                let sums = [own.sums.least[i % LANES], lowest(&beyond.sums.least)];
                if self.terms.together(sums[0], sums[1]) > price {
                    return None;
                }
                let detour = self.terms.prices.detour(i, self.middle(at), j);
                let least = detour - 2.0 * reaches[at] - SLACK * detour;
                Some(Ways { least, at, own, beyond })
            })
            .collect();
        ways.sort_by(|a, b| a.least.total_cmp(&b.least));
        ways
    }

    /// E(i,j) without the price of the rung ⟨i,j⟩, as far as sums are exact: the triangle below it
    /// and all below that; infinite where no entry is known.
    fn price_below(&self, i: usize, j: usize) -> f64 {
        let entry = self.entry(i, j);
        let is_exact = self.terms.rule == Rule::Sum && entry < EXACT_BELOW;
        if is_exact { entry - self.terms.side(i, j).price } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests;
