//! The table itself, and how it is filled.

use super::near::Band;
use super::outside::{Limits, Outside};
use super::store::{Store, Tile};
use super::{HIGHEST_BOUND, memory_needed};
use crate::cost::{
    Aligned, Fan, FanRungs, Fans, FarEnds, LANES, Lanes, QUANTUM, Segment, Strip, TwistForm,
};
use crate::math::Vec3;
use crate::triangulate::part::Part;
use crate::triangulate::span::Span;
use crate::triangulate::{Rule, Terms, TriangulateError};
use crate::watch::Watch;
use std::ops::Range;

/// What the bound of F may lose to rounding, for ν = 1: |s|² is at most 9 and comes from some ten
/// operations.
const SLACK: f64 = 1e-13;
/// So many columns of tiles are filled together: the tiles to the left in the same rows, which all of
/// them need, then come from the processor's cache for all but the first. Alone, with folds, the cone
/// takes 1.7 times as long at 10,000 samples, where 7 % of all tiles are kept; random curves and the
/// twisted strip 1.2 to 2.1 times at 3,200, where 38 to 67 % are.
const GROUP: usize = 8;
/// Loops with fewer samples are not worth a second thread.
const LEAST_SHARED: usize = 256;

/// The table in tiles of [`LANES`] rows by as many columns, on and above the diagonal.
pub(super) struct Table<'a> {
    pub(super) terms: &'a Terms<'a>,
    pub(super) m: usize,
    store: Store,
    folds: bool,
    /// Whether samples are numbered in order, so that many triangles can be priced at once.
    in_order: bool,
    /// The widest that the processor has.
    pub(super) registers: pulp::Arch,
    /// What is known of the rest of the loop beside each rung.
    outside: Option<Outside>,
}

/// Which tiles may have finite entries.
pub(super) struct Open<'a> {
    /// Only those with rungs of the band.
    band: Option<&'a Band>,
    /// What the samples of the tiles have in common; empty where that tells nothing.
    spans: Vec<Span>,
    /// Entries above it are infinite; a multiple of the quantum.
    bound: f64,
    samples: usize,
}

impl<'a> Open<'a> {
    pub(super) fn new(terms: &Terms<'_>, bound: f64, band: Option<&'a Band>) -> Self {
        let m = terms.prices.len();
        let tells = bound < f64::INFINITY
            && terms.prices.in_order()
            && terms.prices.options().form == TwistForm::Normalised;
        let starts = (0..if tells { m } else { 0 }).step_by(LANES);
        let spans = starts.map(|start| Span::of(terms, start..m.min(start + LANES))).collect();
        Self { band, spans, bound, samples: m }
    }

    /// Whether the tile of these rows and columns has edges of the boundary.
    fn has_edges(&self, row: usize, column: usize) -> bool {
        row + 1 >= column || (row, column) == (0, (self.samples - 1) / LANES)
    }

    /// No rung of the tile of these rows and columns costs less, as far as spans tell.
    pub(super) fn least(&self, row: usize, column: usize) -> f64 {
        if self.has_edges(row, column) || self.spans.is_empty() {
            return 0.0;
        }
        self.spans[row].least(&self.spans[column])
    }

    /// Whether the tile of these rows and columns may have finite entries.
    fn is_open(&self, row: usize, column: usize) -> bool {
        let is_dear = self.least(row, column) > self.bound;
        let run = |at: usize| at * LANES..self.samples.min((at + 1) * LANES);
        let is_near = |band: &Band| band.has(run(row), run(column));
        !is_dear && (self.has_edges(row, column) || self.band.is_none_or(is_near))
    }

    /// Where the samples of a column of tiles lie, if spans tell.
    fn segment(&self, column: usize) -> Option<Segment> {
        self.spans.get(column).map(Span::segment)
    }
}

/// A column of tiles, while it is filled from the diagonal upwards.
struct Column {
    to: FarEnds,
    /// The best k of the row that was filled last, which is near to that of the next one; 0 for
    /// none.
    best: [u64; LANES],
}

impl Column {
    fn new(terms: &Terms<'_>, at: usize) -> Self {
        Self { to: terms.prices.far_ends(at * LANES), best: [0; LANES] }
    }
}

/// A tile to be filled. A type rather than a closure: the call of a closure by value goes through a
/// function of its own, which is not compiled for the wider registers.
struct Filling<'a> {
    table: &'a Table<'a>,
    open: &'a Open<'a>,
    row: usize,
    column: &'a mut Column,
    tile: &'a mut Tile,
}

impl pulp::WithSimd for Filling<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { table, open, row, column, tile } = self;
        // Wide registers come with products that are added in one step, but for those of browsers.
        if S::IS_SCALAR || cfg!(target_family = "wasm") {
            table.fill_tile::<false>(open, row, column, tile);
        } else {
            table.fill_tile::<true>(open, row, column, tile);
        }
    }
}

/// The least sums below the rungs from one sample to those of a tile, on the way.
struct Least<'a> {
    i: usize,
    to: &'a FarEnds,
    means: &'a [Lanes; 3],
    /// Means nothing where folds cost nothing.
    fans: Fans<'a>,
    /// Where those of the tile lie, if that is known.
    segment: Option<&'a Segment>,
    /// Infinitely low where nothing is looked for.
    prices: Aligned<Lanes>,
    /// The k that they were found at; 0 for none.
    best: Aligned<[u64; LANES]>,
}

impl<'a> Table<'a> {
    pub(super) fn new(terms: &'a Terms<'a>) -> Self {
        let m = terms.prices.len();
        let folds = terms.folds();
        Self {
            terms,
            m,
            store: Store::new(m.div_ceil(LANES), folds),
            folds,
            in_order: terms.prices.in_order(),
            registers: pulp::Arch::new(),
            outside: None,
        }
    }

    /// Fills the table with all entries up to `bound`, those of rungs outside the band excepted,
    /// and returns the price of the answer. `share` is the part of the progress that this is.
    pub(super) fn fill(
        &mut self,
        bound: f64,
        band: Option<&Band>,
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<f64, TriangulateError> {
        self.outside = None;
        self.fill_open(&Open::new(self.terms, bound, band), watch, share)
    }

    /// The same for all rungs, once it is known what the rest of the loop costs beside each, where that
    /// is worth it; `is_sure` says that it was for the thinned loop.
    pub(super) fn fill_from_outside(
        &mut self,
        (bound, is_sure): (f64, bool),
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<f64, TriangulateError> {
        self.outside = None;
        let open = Open::new(self.terms, bound, None);
        let mut start = share.start;
        if self.folds && self.in_order && bound <= HIGHEST_BOUND {
            self.store.clear();
            let memory = self.terms.memory.saturating_sub(self.bytes());
            self.clear_for(memory);
            // It takes most of the time.
            start += 0.8 * (share.end - share.start);
            let mut part = Part::new(watch, share.start..start);
            let limits = Limits::new(bound, is_sure, memory);
            self.outside = Outside::new(self, &open, limits, &mut part)?;
        }
        self.fill_open(&open, watch, start..share.end)
    }

    /// The same for the tiles that are open.
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
        if cfg!(feature = "rayon") && self.m >= LEAST_SHARED {
            self.fill_by_diagonals(&mut columns, open, watch, tell)?;
        } else {
            self.fill_by_columns(&mut columns, open, watch, tell)?;
        }
        Ok(self.entry(0, self.m - 1))
    }

    /// Refuses tiles that do not fit the memory.
    fn fit(&mut self) -> Result<(), TriangulateError> {
        let limit = self.terms.memory;
        if self.bytes() > limit {
            return Err(TriangulateError::TooLarge { needed: memory_needed(self.m), limit });
        }
        self.store.shrink_to(limit - self.terms.visibility.bytes() - self.outside_bytes());
        Ok(())
    }

    /// Forgets all entries, and gives back memory where another needs it, bytes.
    pub(super) fn clear_for(&mut self, another: u64) {
        self.store.clear();
        let taken = self.terms.visibility.bytes() + another;
        self.store.shrink_to(self.terms.memory.saturating_sub(taken));
    }

    /// What it takes, with who sees whom and what is known of the rest of the loop, bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.store.bytes() + self.terms.visibility.bytes() + self.outside_bytes()
    }

    fn outside_bytes(&self) -> u64 {
        self.outside.as_ref().map_or(0, Outside::bytes)
    }

    /// Whether the tile of these rows and columns may have finite entries.
    fn is_open(&self, open: &Open<'_>, row: usize, column: usize) -> bool {
        match &self.outside {
            Some(outside) => outside.has(row, column),
            None => open.is_open(row, column),
        }
    }

    /// Whether it was filled with what the rest of the loop costs in view.
    pub(super) fn is_from_outside(&self) -> bool {
        self.outside.is_some()
    }

    #[cfg(test)]
    pub(super) fn set_outside(&mut self, outside: Outside) {
        self.outside = Some(outside);
    }

    /// How many tiles have entries up to `bound`.
    pub(super) fn tiles_up_to(&self, bound: f64) -> usize {
        self.store.tiles_up_to(bound)
    }

    /// What so many tiles take, bytes.
    pub(super) fn bytes_of(&self, tiles: usize) -> u64 {
        self.store.bytes_of(tiles)
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

    /// One diagonal of tiles after the other. The tiles of a diagonal need nothing of one another,
    /// so threads share them; each has the same bits whoever fills it.
    #[cfg(feature = "rayon")]
    fn fill_by_diagonals(
        &mut self,
        columns: &mut [Column],
        open: &Open<'_>,
        watch: &mut dyn Watch,
        tell: impl Fn(f64, &mut dyn Watch),
    ) -> Result<(), TriangulateError> {
        use rayon::prelude::*;
        let registers = self.registers;
        for diagonal in 0..columns.len() {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let mut rows: Vec<usize> = (0..columns.len() - diagonal).collect();
            rows.retain(|&row| self.is_open(open, row, row + diagonal));
            let mut tiles: Vec<(usize, Tile)> =
                rows.into_iter().map(|row| (row, self.store.fresh())).collect();
            let table = &*self;
            // Each tile with its column, of which no other has a part on this diagonal.
            let mut next = 0;
            let wanted: Vec<&mut Column> = columns[diagonal..]
                .iter_mut()
                .enumerate()
                .filter(|(row, _)| {
                    let is_next = tiles.get(next).is_some_and(|(at, _)| at == row);
                    next += usize::from(is_next);
                    is_next
                })
                .map(|(_, column)| column)
                .collect();
            tiles.par_iter_mut().zip(wanted).for_each(|((row, tile), column)| {
                registers.dispatch(Filling { table, open, row: *row, column, tile });
            });
            for (row, tile) in tiles {
                self.store.put(row, row + diagonal, tile);
            }
            self.fit()?;
            // The sums of a diagonal are as many as its tiles, times their distance from the
            // diagonal of the table.
            let done = diagonal as f64 / columns.len() as f64;
            tell(done * done * (3.0 - 2.0 * done), watch);
        }
        Ok(())
    }

    #[cfg(not(feature = "rayon"))]
    fn fill_by_diagonals(
        &mut self,
        columns: &mut [Column],
        open: &Open<'_>,
        watch: &mut dyn Watch,
        tell: impl Fn(f64, &mut dyn Watch),
    ) -> Result<(), TriangulateError> {
        self.fill_by_columns(columns, open, watch, tell)
    }

    /// Fills the tile of these rows and the columns of the far ends, from all tiles to its left and
    /// below.
    #[inline(always)]
    fn fill_tile<const FUSED: bool>(
        &self,
        open: &Open<'_>,
        row: usize,
        column: &mut Column,
        tile: &mut Tile,
    ) {
        match (self.folds, self.terms.rule) {
            (true, _) => self.fill_by::<true, FUSED>(open, row, column, tile, |a, b| a + b),
            (false, Rule::Sum) => {
                self.fill_by::<false, FUSED>(open, row, column, tile, |a, b| a + b);
            }
            (false, Rule::Worst) => {
                self.fill_by::<false, FUSED>(
                    open,
                    row,
                    column,
                    tile,
                    |a, b| if a > b { a } else { b },
                );
            }
        }
    }

    #[inline(always)]
    fn fill_by<const FOLDS: bool, const FUSED: bool>(
        &self,
        open: &Open<'_>,
        row: usize,
        Column { to, best }: &mut Column,
        tile: &mut Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let rows = row * LANES..self.m.min((row + 1) * LANES);
        let (to, column) = (&*to, to.first / LANES);
        let segment = if FOLDS && self.in_order { open.segment(column) } else { None };
        let mut strip = Strip::BLANK;
        for i in rows.clone().rev() {
            let near = open.band.map(|band| band.lanes(i, to));
            if near.is_some_and(|near| near == [false; LANES]) {
                continue;
            }
            self.terms.strip::<FOLDS>(i, to, open.bound, &mut strip);
            let Strip { prices, means } = &mut strip;
            if let Some(of_tile) = &mut tile.means {
                of_tile[i - rows.start] = **means;
            }
            let rests = match &self.outside {
                Some(outside) => outside.row(i, column).copied().unwrap_or([f64::INFINITY; LANES]),
                None => [0.0; LANES],
            };
            let mut below = [f64::NEG_INFINITY; LANES];
            for n in 0..LANES {
                if near.is_some_and(|near| !near[n]) && to.first + n > i + 1 {
                    prices[n] = f64::INFINITY;
                }
                let price = prices[n] + rests[n];
                let left = match self.terms.rule {
                    Rule::Sum => open.bound - price,
                    Rule::Worst => open.bound,
                };
                let admitted = price <= open.bound && price < f64::INFINITY;
                // Prices up to the bound lie below the next multiple of the quantum.
                below[n] = if admitted { left + QUANTUM } else { f64::NEG_INFINITY };
            }
            if below == [f64::NEG_INFINITY; LANES] {
                continue;
            }
            let none = Aligned([[0.0; LANES]; 3]);
            let offsets = if FOLDS { self.terms.prices.offsets(i, to) } else { none };
            let mut least = Least {
                i,
                to,
                means,
                fans: self.terms.prices.fans(&offsets, means),
                segment: segment.as_ref(),
                prices: Aligned(below),
                best: Aligned([0; LANES]),
            };
            self.look_first::<FOLDS, FUSED>(&mut least, best, column, tile, together);
            self.look_between::<FOLDS, FUSED>(&mut least, column, tile, together);
            let mut entries = [f64::INFINITY; LANES];
            for n in 0..to.count {
                let j = to.first + n;
                if j <= i || below[n] == f64::NEG_INFINITY {
                    continue;
                }
                if j == i + 1 {
                    entries[n] = prices[n];
                } else if least.prices[n] < below[n] {
                    entries[n] = together(prices[n], least.prices[n]);
                } else {
                    continue;
                }
                // The tile of the diagonal is not stored while it is being filled.
                let diagonal =
                    if row == column { Some(&*tile) } else { self.store.tile(column, column) };
                if let Some(diagonal) = diagonal {
                    self.look::<FOLDS, FUSED>(
                        &mut least,
                        j,
                        entries[n],
                        Some(means),
                        diagonal,
                        together,
                    );
                }
            }
            tile.sums.least[i - rows.start] = lowest(&entries);
            tile.sums.entries[i - rows.start] = entries;
            *best = *least.best;
        }
    }

    /// Looks at those k that were best one row below.
    #[inline(always)]
    fn look_first<const FOLDS: bool, const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        best: &[u64; LANES],
        column: usize,
        tile: &Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let row = least.i / LANES;
        let mut last = 0;
        for n in 0..LANES {
            let k = best[n] as usize;
            if k <= least.i || k == last || k >= least.to.first {
                continue;
            }
            last = k;
            let (Some(own), Some(beyond)) =
                (self.store.tile(row, k / LANES), self.tile_of(k / LANES, row, column, tile))
            else {
                continue;
            };
            let entry = own.sums.entries[least.i % LANES][k % LANES];
            if entry < f64::INFINITY {
                let means = own.means_from(least.i);
                self.look::<FOLDS, FUSED>(least, k, entry, means, beyond, together);
            }
        }
    }

    /// Looks at the k before those of the column. Of the 16 of a tile, only those whose E(i,k) and
    /// the least E(k,j) together lie below the highest of the least prices.
    #[inline(always)]
    fn look_between<const FOLDS: bool, const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        column: usize,
        tile: &Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let row = least.i / LANES;
        let mut reach = highest(&least.prices);
        for &between in self.store.beside(row) {
            let between = between as usize;
            if reach <= 0.0 {
                break;
            }
            let (Some(own), Some(beyond)) =
                (self.store.tile(row, between), self.tile_of(between, row, column, tile))
            else {
                continue;
            };
            let (entries, means) = (&own.sums.entries[least.i % LANES], own.means_from(least.i));
            let mut left = 0u32;
            for n in 0..LANES {
                let is_below = together(entries[n], beyond.sums.least[n]) < reach;
                left |= u32::from(is_below) << n;
            }
            if left == 0 {
                continue;
            }
            if FOLDS
                && self.in_order
                && let Some(offsets) = self.terms.prices.offsets_to_run(least.i, between * LANES)
            {
                self.look_at_sides::<FUSED>(least, between, &offsets, (left, reach), (own, beyond));
                reach = highest(&least.prices);
                continue;
            }
            while left != 0 {
                let n = left.trailing_zeros() as usize;
                left &= left - 1;
                let k = between * LANES + n;
                self.look::<FOLDS, FUSED>(least, k, entries[n], means, beyond, together);
            }
            reach = highest(&least.prices);
        }
    }

    /// The tile in a column of them, of which `tile`, in `row`, is not yet stored.
    #[inline(always)]
    fn tile_of<'t>(
        &'t self,
        wanted: usize,
        row: usize,
        column: usize,
        tile: &'t Tile,
    ) -> Option<&'t Tile> {
        if wanted == row { Some(tile) } else { self.store.tile(wanted, column) }
    }

    /// Looks at the triangles i, k, j of all j of the tile `beyond`, with E(i,k) = `entry` and N of the
    /// rungs from i to the samples around k.
    #[inline(always)]
    fn look<const FOLDS: bool, const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        means_from_i: Option<&[Lanes; 3]>,
        beyond: &Tile,
        together: impl Fn(f64, f64) -> f64,
    ) {
        let entries = &beyond.sums.entries[k % LANES];
        if FOLDS {
            let mut below = false;
            for n in 0..LANES {
                below |= entry + entries[n] < least.prices[n];
            }
            if below && let (Some(from_i), Some(means)) = (means_from_i, beyond.means_from(k)) {
                let shared = of_lane(from_i, k % LANES);
                self.look_closer::<FUSED>(least, k, entry, shared, (entries, means));
            }
            return;
        }
        for n in 0..LANES {
            let price = together(entry, entries[n]);
            let lower = price < least.prices[n];
            least.prices[n] = if lower { price } else { least.prices[n] };
            least.best[n] = if lower { k as u64 } else { least.best[n] };
        }
    }

    /// The same where some of the sums lie below the least prices, so that F decides.
    #[inline(always)]
    fn look_closer<const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        shared: [f64; 3],
        (entries, means): (&Lanes, &[Lanes; 3]),
    ) {
        if !self.in_order {
            return self.look_singly(least, k, entry, shared, (entries, means));
        }
        let rungs = self.rungs_of_fan(least.i, k, least.to).least();
        let fan = Fan { side: self.terms.prices.offset(least.i, k), shared, beyond: means };
        self.look_at_fan::<FUSED>(least, (k, entry), (&fan, rungs), entries);
    }

    /// Looks at the triangles of those sides ⟨i,k⟩ that have a bit in `left`, with k in the column of
    /// tiles `between`, which `offsets` lead to, on loops whose members are numbered in order. Sides
    /// whose own share in F is too much for all j go without a look at each.
    #[inline(always)]
    fn look_at_sides<const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        between: usize,
        offsets: &[Lanes; 3],
        (mut left, reach): (u32, f64),
        (own, beyond): (&Tile, &Tile),
    ) {
        let (i, first) = (least.i, between * LANES);
        let entries = &own.sums.entries[i % LANES];
        let (Some(means), Some(means_beyond)) = (own.means_from(i), &beyond.means) else { return };
        if let Some(segment) = least.segment {
            let mut limits = [0.0; LANES];
            for n in 0..LANES {
                limits[n] = reach - (entries[n] + beyond.sums.least[n]);
            }
            left &= self.terms.prices.sides_below::<FUSED>(i, offsets, means, segment, &limits);
        }
        // No triangle has fewer.
        let mut rungs = [if i == 0 { 2.0 } else { 3.0 }; LANES];
        for edge in [i + 1, least.to.first - 1] {
            if let Some(rungs) = rungs.get_mut(edge.wrapping_sub(first)) {
                *rungs -= 1.0;
            }
        }
        while left != 0 {
            let n = left.trailing_zeros() as usize;
            left &= left - 1;
            let fan = Fan {
                side: of_lane(offsets, n),
                shared: of_lane(means, n),
                beyond: &means_beyond[n],
            };
            let sums = &beyond.sums.entries[n];
            self.look_at_fan::<FUSED>(least, (first + n, entries[n]), (&fan, rungs[n]), sums);
        }
    }

    /// Looks at the triangles i, k, j of one k and all j, with E(i,k) = `entry`, E(k,j) = `entries`, and
    /// at least so many `rungs` each.
    #[inline(always)]
    fn look_at_fan<const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        (k, entry): (usize, f64),
        (fan, rungs): (&Fan<'_>, f64),
        entries: &Lanes,
    ) {
        let mut left = [0.0; LANES];
        for n in 0..LANES {
            left[n] = least.prices[n] - (entry + entries[n]);
        }
        if !least.fans.may_be_below::<FUSED>(fan, rungs, &left) {
            return;
        }
        let folds = least.fans.prices(fan, self.rungs_of_fan(least.i, k, least.to));
        for n in 0..LANES {
            let price = entry + entries[n] + folds[n];
            let lower = price < least.prices[n];
            least.prices[n] = if lower { price } else { least.prices[n] };
            least.best[n] = if lower { k as u64 } else { least.best[n] };
        }
    }

    /// How many sides of the triangles i, k, j are rungs: ⟨i,k⟩, ⟨k,j⟩ or ⟨i,j⟩ may be an edge of
    /// the boundary.
    #[inline(always)]
    pub(super) fn rungs_of_fan(&self, i: usize, k: usize, to: &FarEnds) -> FanRungs {
        let last = if i == 0 { self.m - 1 } else { usize::MAX };
        FanRungs {
            most: if k == i + 1 { 2.0 } else { 3.0 },
            fewer: [(k + 1).wrapping_sub(to.first), last.wrapping_sub(to.first)],
        }
    }

    /// The same as [`Self::look_closer`] for one triangle after the other, where samples are not
    /// numbered in order. First comes a bound of F from the N alone.
    #[inline(never)]
    fn look_singly(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        shared: [f64; 3],
        (entries, means): (&Lanes, &[Lanes; 3]),
    ) {
        let rungs = self.rungs_of_fan(least.i, k, least.to);
        let fold = self.terms.prices.options().fold;
        for n in 0..least.to.count {
            let sum = entry + entries[n];
            if sum >= least.prices[n] {
                continue;
            }
            let of_sides =
                [shared, of_lane(means, n), of_lane(least.means, n)].map(Vec3::from_array);
            let square = (of_sides[0] + of_sides[1] + of_sides[2]).length_squared();
            let rungs = rungs.of(n);
            let bound = fold * ((rungs * rungs - square) / (2.0 * rungs.max(1.0)) - SLACK);
            if sum + bound < least.prices[n] {
                let corners = [least.i, k, least.to.first + n];
                let price = sum + self.terms.prices.triangle(corners, of_sides);
                if price < least.prices[n] {
                    (least.prices[n], least.best[n]) = (price, k as u64);
                }
            }
        }
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
        let mut triangles = Vec::with_capacity(self.m - 2);
        let mut parts = vec![(0, self.m - 1)];
        while let Some((i, j)) = parts.pop() {
            if j - i < 2 {
                continue;
            }
            let k = self.chosen(i, j);
            triangles.push([i, k, j]);
            parts.extend([(i, k), (k, j)]);
        }
        triangles
    }

    /// The k of E(i,j), by the rule for equals.
    fn chosen(&self, i: usize, j: usize) -> usize {
        let mut chosen = (f64::INFINITY, f64::INFINITY, i + 1);
        for &at in self.store.beside(i / LANES) {
            let first = at as usize * LANES;
            if first >= j {
                break;
            }
            let tiles =
                (self.store.tile(i / LANES, at as usize), self.store.tile(at as usize, j / LANES));
            let (Some(own), Some(beyond)) = tiles else { continue };
            for n in 0..LANES {
                let (k, entry) = (first + n, own.sums.entries[i % LANES][n]);
                let sum = self.terms.together(entry, beyond.sums.entries[n][j % LANES]);
                if sum > chosen.0 || sum == f64::INFINITY {
                    continue;
                }
                let key = (sum + self.fold(i, k, j), self.terms.prices.detour(i, k, j), k);
                if (key.0, key.1) < (chosen.0, chosen.1) {
                    chosen = key;
                }
            }
        }
        chosen.2
    }
}

/// The N of one lane.
#[inline(always)]
pub(super) fn of_lane(means: &[Lanes; 3], n: usize) -> [f64; 3] {
    // Not `means.map`, which takes all lanes by value.
    [means[0][n], means[1][n], means[2][n]]
}

#[inline(always)]
fn highest(prices: &Lanes) -> f64 {
    // Written out: `f64::max` also orders NaN, which costs instructions and can't occur.
    reduced(prices, |a, b| if b > a { b } else { a })
}

#[inline(always)]
pub(super) fn lowest(prices: &Lanes) -> f64 {
    reduced(prices, |a, b| if b < a { b } else { a })
}

/// What is left of all lanes where one of every two is.
#[inline(always)]
fn reduced(prices: &Lanes, of_two: impl Fn(f64, f64) -> f64) -> f64 {
    let mut lanes = *prices;
    let mut count = LANES;
    while count > 1 {
        count /= 2;
        for n in 0..count {
            lanes[n] = of_two(lanes[n], lanes[n + count]);
        }
    }
    lanes[0]
}

#[cfg(test)]
mod tests;
