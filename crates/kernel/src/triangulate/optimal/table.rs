//! The table itself, and how it is filled.

use super::memory_needed;
use super::near::Band;
use super::store::{Store, Tile};
use crate::cost::{FarEnds, LANES, Lanes, QUANTUM, Strip, TwistForm};
use crate::math::Vec3;
use crate::triangulate::span::Span;
use crate::triangulate::{Rule, Terms, TriangulateError};
use crate::watch::Watch;
use std::ops::Range;

/// What the bound of F may lose to rounding, for ν = 1: |s|² is at most 9 and comes from some ten
/// operations.
const SLACK: f64 = 1e-13;
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
    /// Entries above it are infinite; a multiple of the quantum.
    bound: f64,
}

/// Which tiles may have finite entries.
struct Open<'a> {
    /// Only those with rungs of the band.
    band: Option<&'a Band>,
    /// What the samples of the tiles have in common; empty where that tells nothing.
    spans: Vec<Span>,
    bound: f64,
    /// The number of the last column.
    last: usize,
}

impl<'a> Open<'a> {
    fn new(terms: &Terms<'_>, bound: f64, band: Option<&'a Band>) -> Self {
        let m = terms.prices.len();
        let tells = bound < f64::INFINITY
            && terms.prices.in_order()
            && terms.prices.options().form == TwistForm::Normalised;
        let starts = (0..if tells { m } else { 0 }).step_by(LANES);
        let spans = starts.map(|start| Span::of(terms, start..m.min(start + LANES))).collect();
        Self { band, spans, bound, last: m.div_ceil(LANES) - 1 }
    }

    fn is_open(&self, row: usize, column: usize) -> bool {
        // With edges of the boundary.
        if row + 1 >= column || (row, column) == (0, self.last) {
            return true;
        }
        let is_dear =
            !self.spans.is_empty() && self.spans[row].least(&self.spans[column]) > self.bound;
        !is_dear && self.band.is_none_or(|band| band.has(row * LANES, column * LANES, LANES))
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
    row: usize,
    column: &'a mut Column,
    band: Option<&'a Band>,
    tile: &'a mut Tile,
}

impl pulp::WithSimd for Filling<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.table.fill_tile(self.row, self.column, self.band, self.tile);
    }
}

/// The least sums below the rungs from one sample to those of a tile, on the way.
struct Least<'a> {
    i: usize,
    to: &'a FarEnds,
    means: [Lanes; 3],
    /// Infinitely low where nothing is looked for.
    prices: Lanes,
    /// The k that they were found at; 0 for none.
    best: [u64; LANES],
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
            bound: f64::INFINITY,
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
        self.bound = bound;
        self.store.clear();
        let open = Open::new(self.terms, bound, band);
        let columns = self.m.div_ceil(LANES);
        let mut columns: Vec<Column> = (0..columns).map(|at| Column::new(self.terms, at)).collect();
        self.fits()?;
        let tell = |done: f64, watch: &mut dyn Watch| {
            watch.progress(share.start + (share.end - share.start) * done);
        };
        if cfg!(feature = "rayon") && self.m >= LEAST_SHARED {
            self.fill_by_diagonals(&mut columns, &open, watch, tell)?;
        } else {
            self.fill_by_columns(&mut columns, &open, watch, tell)?;
        }
        Ok(self.entry(0, self.m - 1))
    }

    /// Whether the tiles that are there fit the memory.
    fn fits(&self) -> Result<(), TriangulateError> {
        if self.store.bytes() + self.terms.visibility.bytes() <= self.terms.memory {
            return Ok(());
        }
        Err(TriangulateError::TooLarge { needed: memory_needed(self.m), limit: self.terms.memory })
    }

    /// How many tiles have finite entries.
    pub(super) fn tiles(&self) -> usize {
        self.store.kept
    }

    /// One column of tiles after the other, each from the diagonal upwards.
    fn fill_by_columns(
        &mut self,
        columns: &mut [Column],
        open: &Open<'_>,
        watch: &mut dyn Watch,
        tell: impl Fn(f64, &mut dyn Watch),
    ) -> Result<(), TriangulateError> {
        let registers = pulp::Arch::new();
        let count = columns.len() as f64;
        for (at, column) in columns.iter_mut().enumerate() {
            for row in (0..=at).rev().filter(|&row| open.is_open(row, at)) {
                if watch.stop() {
                    return Err(TriangulateError::Stopped);
                }
                let mut tile = self.store.fresh();
                let (table, band) = (&*self, open.band);
                registers.dispatch(Filling { table, row, column, band, tile: &mut tile });
                self.store.put(row, at, tile);
            }
            self.fits()?;
            let done = at as f64 / count;
            tell(done * done * done, watch);
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
        let registers = pulp::Arch::new();
        for diagonal in 0..columns.len() {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let (table, band) = (&*self, open.band);
            let tiles: Vec<Option<Tile>> = columns[diagonal..]
                .par_iter_mut()
                .enumerate()
                .map(|(row, column)| {
                    open.is_open(row, row + diagonal).then(|| {
                        let mut tile = Tile::new(table.folds);
                        let filling = Filling { table, row, column, band, tile: &mut tile };
                        registers.dispatch(filling);
                        tile
                    })
                })
                .collect();
            for (row, tile) in tiles.into_iter().enumerate() {
                if let Some(tile) = tile {
                    self.store.put(row, row + diagonal, tile);
                }
            }
            self.fits()?;
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
    fn fill_tile(&self, row: usize, column: &mut Column, band: Option<&Band>, tile: &mut Tile) {
        match (self.folds, self.terms.rule) {
            (true, _) => self.fill_by::<true>(row, column, band, tile, |a, b| a + b),
            (false, Rule::Sum) => self.fill_by::<false>(row, column, band, tile, |a, b| a + b),
            (false, Rule::Worst) => {
                self.fill_by::<false>(row, column, band, tile, |a, b| if a > b { a } else { b });
            }
        }
    }

    #[inline(always)]
    fn fill_by<const FOLDS: bool>(
        &self,
        row: usize,
        Column { to, best }: &mut Column,
        band: Option<&Band>,
        tile: &mut Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let rows = row * LANES..self.m.min((row + 1) * LANES);
        let (to, column) = (&*to, to.first / LANES);
        for i in rows.clone().rev() {
            let near = band.map(|band| band.lanes(i, to));
            if near.is_some_and(|near| near == [false; LANES]) {
                continue;
            }
            let Strip { mut prices, means } = self.terms.strip(i, to);
            if let Some(of_tile) = &mut tile.means {
                of_tile[i - rows.start] = means;
            }
            let mut below = [f64::NEG_INFINITY; LANES];
            for n in 0..LANES {
                if near.is_some_and(|near| !near[n]) && to.first + n > i + 1 {
                    prices[n] = f64::INFINITY;
                }
                let left = match self.terms.rule {
                    Rule::Sum => self.bound - prices[n],
                    Rule::Worst => self.bound,
                };
                let open = prices[n] <= self.bound && prices[n] < f64::INFINITY;
                // Prices up to the bound lie below the next multiple of the quantum.
                below[n] = if open { left + QUANTUM } else { f64::NEG_INFINITY };
            }
            if below == [f64::NEG_INFINITY; LANES] {
                continue;
            }
            let mut least = Least { i, to, means, prices: below, best: [0; LANES] };
            self.look_first::<FOLDS>(&mut least, best, column, tile, together);
            self.look_between::<FOLDS>(&mut least, column, tile, together);
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
                // What lies below the diagonal has no tile yet while that of the diagonal is filled.
                let diagonal =
                    if row == column { Some(&*tile) } else { self.store.tile(column, column) };
                if let Some(diagonal) = diagonal {
                    self.look::<FOLDS>(&mut least, j, entries[n], diagonal, together);
                }
            }
            tile.sums.least[i - rows.start] = lowest(&entries);
            tile.sums.entries[i - rows.start] = entries;
            *best = least.best;
        }
    }

    /// Looks at those k that were best one row below.
    #[inline(always)]
    fn look_first<const FOLDS: bool>(
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
            let entry = self.entry(least.i, k);
            if entry < f64::INFINITY
                && let Some(beyond) = self.tile_of(k / LANES, row, column, tile)
            {
                self.look::<FOLDS>(least, k, entry, beyond, together);
            }
        }
    }

    /// Looks at the k before those of the column. Of the 16 of a tile, only those whose E(i,k) and
    /// the least E(k,j) together lie below the highest of the least prices.
    #[inline(always)]
    fn look_between<const FOLDS: bool>(
        &self,
        least: &mut Least<'_>,
        column: usize,
        tile: &Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let row = least.i / LANES;
        let mut highest = highest(&least.prices);
        for &between in self.store.beside(row) {
            let between = between as usize;
            if between >= column || highest <= 0.0 {
                break;
            }
            let (Some(own), Some(beyond)) =
                (self.store.tile(row, between), self.tile_of(between, row, column, tile))
            else {
                continue;
            };
            let entries = &own.sums.entries[least.i % LANES];
            let mut left = 0u32;
            for n in 0..LANES {
                let is_below = together(entries[n], beyond.sums.least[n]) < highest;
                left |= u32::from(is_below) << n;
            }
            if left == 0 {
                continue;
            }
            while left != 0 {
                let n = left.trailing_zeros() as usize;
                left &= left - 1;
                self.look::<FOLDS>(least, between * LANES + n, entries[n], beyond, together);
            }
            highest = self::highest(&least.prices);
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

    /// Looks at the triangles i, k, j of all j of the tile `beyond`, with E(i,k) = `entry`.
    #[inline(always)]
    fn look<const FOLDS: bool>(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        beyond: &Tile,
        together: impl Fn(f64, f64) -> f64,
    ) {
        let entries = &beyond.sums.entries[k % LANES];
        if FOLDS {
            let mut below = false;
            for n in 0..LANES {
                below |= entry + entries[n] < least.prices[n];
            }
            if below && let Some(means) = &beyond.means {
                self.look_closer(least, k, entry, (entries, &means[k % LANES]));
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
    fn look_closer(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        (entries, means): (&Lanes, &[Lanes; 3]),
    ) {
        let (i, to) = (least.i, least.to);
        let own = match k.checked_sub(to.first) {
            Some(n) => least.means.map(|mean| mean[n]),
            None => self.mean(i, k),
        };
        let mut sums = [[0.0; LANES]; 3];
        for axis in 0..3 {
            for n in 0..LANES {
                sums[axis][n] = own[axis] + means[axis][n] + least.means[axis][n];
            }
        }
        let mut rungs = [if k == i + 1 { 2.0 } else { 3.0 }; LANES];
        if (to.first..to.first + LANES).contains(&(k + 1)) {
            rungs[k + 1 - to.first] -= 1.0;
        }
        if i == 0 && to.first + LANES >= self.m {
            rungs[self.m - 1 - to.first] -= 1.0;
        }
        if self.in_order {
            let fan = self.terms.prices.fan([i, k], to, &rungs, &sums);
            let mut left = [0.0; LANES];
            for n in 0..LANES {
                left[n] = least.prices[n] - (entry + entries[n]);
            }
            if !fan.may_be_below(&left) {
                return;
            }
            let folds = fan.prices();
            for n in 0..LANES {
                let price = entry + entries[n] + folds[n];
                let lower = price < least.prices[n];
                least.prices[n] = if lower { price } else { least.prices[n] };
                least.best[n] = if lower { k as u64 } else { least.best[n] };
            }
            return;
        }
        let fold = self.terms.prices.options().fold;
        for n in 0..to.count {
            let sum = entry + entries[n];
            let square: f64 = sums.iter().map(|sums| sums[n] * sums[n]).sum();
            let bound = fold * ((rungs[n] * rungs[n] - square) / (2.0 * rungs[n].max(1.0)) - SLACK);
            if sum.max(sum + bound) < least.prices[n] {
                let own = own.into();
                let beyond = Vec3::from_array([means[0][n], means[1][n], means[2][n]]);
                let across = least.means.map(|mean| mean[n]).into();
                let corners = [i, k, to.first + n];
                let price = sum + self.terms.prices.triangle(corners, [own, beyond, across]);
                if price < least.prices[n] {
                    (least.prices[n], least.best[n]) = (price, k as u64);
                }
            }
        }
    }

    /// N of the rung ⟨i,j⟩; zero where folds cost nothing or none is stored.
    #[inline(always)]
    fn mean(&self, i: usize, j: usize) -> [f64; 3] {
        let means = self.store.tile(i / LANES, j / LANES).and_then(|tile| tile.means.as_ref());
        means.map_or([0.0; 3], |means| means[i % LANES].map(|mean| mean[j % LANES]))
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
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

#[inline(always)]
fn highest(prices: &Lanes) -> f64 {
    // Written out: `f64::max` also orders NaN, which costs instructions and can't occur.
    chosen(prices, |a, b| if b > a { b } else { a })
}

#[inline(always)]
fn lowest(prices: &Lanes) -> f64 {
    chosen(prices, |a, b| if b < a { b } else { a })
}

/// What is chosen of all lanes, two by two.
#[inline(always)]
fn chosen(prices: &Lanes, of_two: impl Fn(f64, f64) -> f64) -> f64 {
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
