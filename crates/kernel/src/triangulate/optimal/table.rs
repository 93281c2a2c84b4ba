//! The table itself, and how it is filled.

use super::near::Band;
use super::store::Store;
use crate::cost::{FarEnds, LANES, Lanes, QUANTUM, Strip};
use crate::math::Vec3;
use crate::triangulate::{Rule, Terms, TriangulateError};
use crate::watch::Watch;
use std::ops::Range;

/// What the bound of F may lose to rounding, for ν = 1: |s|² is at most 9 and comes from some ten
/// operations.
const SLACK: f64 = 1e-13;
/// Loops with fewer samples are not worth a second thread.
const LEAST_SHARED: usize = 256;

/// The table in tiles of [`LANES`] rows by as many columns, on and above the diagonal. The tiles of
/// as many columns follow one another, from the first row down to the diagonal, and so do the rows
/// of each: a row holds E(k,j) of one k and all j of the tile.
pub(super) struct Table<'a> {
    pub(super) terms: &'a Terms<'a>,
    pub(super) m: usize,
    store: Store,
    /// How many finite entries each row has; those of row i begin at `row_start`.
    row_lengths: Vec<usize>,
    folds: bool,
    /// Whether samples are numbered in order, so that many triangles can be priced at once.
    in_order: bool,
    /// Entries above it are infinite; a multiple of the quantum.
    bound: f64,
}

/// What one tile holds.
struct Tile {
    entries: [Lanes; LANES],
    means: [[Lanes; 3]; LANES],
}

impl Tile {
    const EMPTY: Self =
        Self { entries: [[f64::INFINITY; LANES]; LANES], means: [[[0.0; LANES]; 3]; LANES] };
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

/// Where the row of sample `k` stands in the tiles of `column`.
fn slot(k: usize, column: usize) -> usize {
    column * (column + 1) / 2 * LANES + k
}

fn row_start(m: usize, i: usize) -> usize {
    // Rows before i have m − 1, m − 2, … entries; i · (i + 1) / 2 is what they lack.
    i * m - i * (i + 1) / 2
}

impl<'a> Table<'a> {
    pub(super) fn new(terms: &'a Terms<'a>) -> Self {
        let m = terms.prices.len();
        let tiles = m.div_ceil(LANES);
        let (pairs, slots) = (m * (m - 1) / 2, slot(0, tiles));
        let folds = terms.folds();
        Self {
            terms,
            m,
            store: Store::new(slots, folds, pairs),
            row_lengths: vec![0; m],
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
        self.row_lengths.fill(0);
        let columns = self.m.div_ceil(LANES);
        let mut columns: Vec<Column> = (0..columns).map(|at| Column::new(self.terms, at)).collect();
        let tell = |done: f64, watch: &mut dyn Watch| {
            watch.progress(share.start + (share.end - share.start) * done);
        };
        if cfg!(feature = "rayon") && self.m >= LEAST_SHARED {
            self.fill_by_diagonals(&mut columns, band, watch, tell)?;
        } else {
            self.fill_by_columns(&mut columns, band, watch, tell)?;
        }
        Ok(self.entry(0, self.m - 1))
    }

    /// One column of tiles after the other, each from the diagonal upwards.
    fn fill_by_columns(
        &mut self,
        columns: &mut [Column],
        band: Option<&Band>,
        watch: &mut dyn Watch,
        tell: impl Fn(f64, &mut dyn Watch),
    ) -> Result<(), TriangulateError> {
        let registers = pulp::Arch::new();
        let mut tile = Tile::EMPTY;
        let count = columns.len() as f64;
        for (at, column) in columns.iter_mut().enumerate() {
            for row in (0..=at).rev() {
                if watch.stop() {
                    return Err(TriangulateError::Stopped);
                }
                let tile = &mut tile;
                registers.dispatch(Filling { table: self, row, column, band, tile });
                self.store(row, at, tile);
            }
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
        band: Option<&Band>,
        watch: &mut dyn Watch,
        tell: impl Fn(f64, &mut dyn Watch),
    ) -> Result<(), TriangulateError> {
        use rayon::prelude::*;
        let registers = pulp::Arch::new();
        for diagonal in 0..columns.len() {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let table = &*self;
            let tiles: Vec<Tile> = columns[diagonal..]
                .par_iter_mut()
                .enumerate()
                .map(|(row, column)| {
                    let mut tile = Tile::EMPTY;
                    let filling = Filling { table, row, column, band, tile: &mut tile };
                    registers.dispatch(filling);
                    tile
                })
                .collect();
            for (row, tile) in tiles.iter().enumerate() {
                self.store(row, row + diagonal, tile);
            }
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
        band: Option<&Band>,
        watch: &mut dyn Watch,
        tell: impl Fn(f64, &mut dyn Watch),
    ) -> Result<(), TriangulateError> {
        self.fill_by_columns(columns, band, watch, tell)
    }

    fn store(&mut self, row: usize, column: usize, tile: &Tile) {
        let first = slot(row * LANES, column);
        self.store.entries[first..][..LANES].copy_from_slice(&tile.entries);
        if self.folds {
            self.store.means[first..][..LANES].copy_from_slice(&tile.means);
        }
        for (i, entries) in (row * LANES..self.m).zip(&tile.entries) {
            let mut at = row_start(self.m, i) + self.row_lengths[i];
            for (n, &entry) in entries.iter().enumerate() {
                if entry < f64::INFINITY {
                    self.store.row_k[at] = (column * LANES + n) as u32;
                    self.store.row_entries[at] = entry;
                    at += 1;
                }
            }
            self.row_lengths[i] = at - row_start(self.m, i);
        }
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
        tile.entries = [[f64::INFINITY; LANES]; LANES];
        let rows = row * LANES..self.m.min((row + 1) * LANES);
        let (to, column) = (&*to, to.first / LANES);
        for i in rows.clone().rev() {
            let near = band.map(|band| band.lanes(i, to));
            if near.is_some_and(|near| near == [false; LANES]) {
                continue;
            }
            let Strip { mut prices, means } = self.terms.strip(i, to);
            if FOLDS {
                tile.means[i - rows.start] = means;
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
            if FOLDS {
                self.look_first(&mut least, best, &rows, column, tile);
            }
            let listed = row_start(self.m, i)..row_start(self.m, i) + self.row_lengths[i];
            for (&k, &entry) in
                self.store.row_k[listed.clone()].iter().zip(&self.store.row_entries[listed])
            {
                let k = k as usize;
                let beyond = self.row_of(k, &rows, column, tile);
                self.look::<FOLDS>(&mut least, k, entry, beyond, together);
            }
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
                let beyond = self.row_of(j, &rows, column, tile);
                self.look::<FOLDS>(&mut least, j, entries[n], beyond, together);
            }
            tile.entries[i - rows.start] = entries;
            *best = least.best;
        }
    }

    /// Looks at those k that were best one row below.
    #[inline(always)]
    fn look_first(
        &self,
        least: &mut Least<'_>,
        best: &[u64; LANES],
        rows: &Range<usize>,
        column: usize,
        tile: &Tile,
    ) {
        let mut last = 0;
        for n in 0..LANES {
            let k = best[n] as usize;
            if k <= least.i || k == last || k >= least.to.first {
                continue;
            }
            last = k;
            let entry = self.entry(least.i, k);
            if entry < f64::INFINITY {
                let beyond = self.row_of(k, rows, column, tile);
                self.look::<true>(least, k, entry, beyond, |a, b| a + b);
            }
        }
    }

    /// The row of sample `k` in the tiles of a column, of which `tile`, with these rows, is not yet
    /// stored.
    #[inline(always)]
    fn row_of<'t>(
        &'t self,
        k: usize,
        rows: &Range<usize>,
        column: usize,
        tile: &'t Tile,
    ) -> (&'t Lanes, &'t [Lanes; 3]) {
        const NONE: [Lanes; 3] = [[0.0; LANES]; 3];
        if rows.contains(&k) {
            (&tile.entries[k - rows.start], &tile.means[k - rows.start])
        } else {
            let at = slot(k, column);
            (&self.store.entries[at], self.store.means.get(at).unwrap_or(&NONE))
        }
    }

    /// Looks at the triangles i, k, j of all j of the tile, with E(i,k) = `entry`, E(k,j) in
    /// `entries` and N of ⟨k,j⟩ in `means`.
    #[inline(always)]
    fn look<const FOLDS: bool>(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        (entries, means): (&Lanes, &[Lanes; 3]),
        together: impl Fn(f64, f64) -> f64,
    ) {
        if !FOLDS {
            for n in 0..LANES {
                let price = together(entry, entries[n]);
                // Written out: `f64::min` also orders NaN, which costs instructions and can't occur.
                least.prices[n] = if price < least.prices[n] { price } else { least.prices[n] };
            }
            return;
        }
        let mut below = false;
        for n in 0..LANES {
            below |= entry + entries[n] < least.prices[n];
        }
        if below {
            self.look_closer(least, k, entry, (entries, means));
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

    /// N of the rung ⟨i,j⟩, which must be stored.
    #[inline(always)]
    fn mean(&self, i: usize, j: usize) -> [f64; 3] {
        self.store.means[slot(i, j / LANES)].map(|mean| mean[j % LANES])
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        self.store.entries[slot(i, j / LANES)][j % LANES]
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
        let listed = row_start(self.m, i)..row_start(self.m, i) + self.row_lengths[i];
        for (&k, &entry) in
            self.store.row_k[listed.clone()].iter().zip(&self.store.row_entries[listed])
        {
            let k = k as usize;
            if k >= j {
                break;
            }
            let sum = self.terms.together(entry, self.entry(k, j));
            if sum > chosen.0 {
                continue;
            }
            let key = (sum + self.fold(i, k, j), self.terms.prices.detour(i, k, j), k);
            if (key.0, key.1) < (chosen.0, chosen.1) {
                chosen = key;
            }
        }
        chosen.2
    }
}

impl Drop for Table<'_> {
    fn drop(&mut self) {
        std::mem::take(&mut self.store).keep();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_tiles_are_packed() {
        let m = 7;
        let rows = (0..m).flat_map(|i| (i + 1..m).map(move |k| row_start(m, i) + k - i - 1));
        assert!(rows.eq(0..21));
        let slots =
            (0..3).flat_map(|column| (0..(column + 1) * LANES).map(move |k| slot(k, column)));
        assert!(slots.eq(0..slot(0, 3)));
    }
}
