//! The cheapest triangulation of all: equations (2) and (5) as one triangular table.
//!
//! 1. The edge ⟨0, m−1⟩ belongs to every triangulation, so one table answers the whole loop. Let
//!    E(i,j) be the least price of the part of the loop from i to j *with* the rung ⟨i,j⟩; it is 0
//!    for an edge of the boundary. Then equation (5) reads
//!    E(i,j) = w(i,j) + min over i<k<j of E(i,k) + E(k,j) + F(i,k,j),
//!    with F the fold price of the triangle. Θ(m³) sums, Θ(m²) memory.
//! 2. The table is kept in tiles of 16 × 16. What a column of tiles holds stays in the processor's
//!    cache while it is filled, from the diagonal upwards. The innermost loop runs over 16 j side by
//!    side, for one i and one k, which the compiler vectorises for the widest registers that the
//!    processor has (crate `pulp`; the bits are the same with any).
//! 3. Prices are never negative, so no entry above the price of a known triangulation is a part of
//!    the answer. One is found by the optimum of every fourth sample: only rungs near to its rungs
//!    are priced and put together (a band of the table), which is cheap, and near to the optimum or
//!    the optimum itself. In the table of all rungs, entries above that price are then dropped. Each
//!    row keeps a list of its finite entries, and k runs over that list alone. If the band has no
//!    triangulation, the bound is guessed from the optimum of every fourth sample, and raised until
//!    there is an answer below it.
//! 4. F is never negative, and dear to work out. So those k come first that were best one row below;
//!    of the others, the sums E(i,k) + E(k,j) are compared with the least price so far, 16 at a time.
//!    Where one lies below, a test without root and quotient says whether F may leave it there, and
//!    only then F is worked out.
//! 5. Which k was best is not stored but found again on the way back, for the m − 2 entries that
//!    belong to the answer. Of equal prices (prices are exact, see [`crate::cost`], so flat regions
//!    do tie) the k with the least |P_i P_k| + |P_k P_j| wins, then the smallest: strips of compact
//!    triangles rather than fans.

use super::part::Part;
use super::{Rule, Solved, Terms, TriangulateError};
use crate::cost::{FarEnds, LANES, Lanes, QUANTUM, Strip, quantised};
use crate::math::Vec3;
use crate::watch::Watch;
use std::ops::Range;

/// What the bound of F may lose to rounding, for ν = 1: |s|² is at most 9 and comes from some ten
/// operations.
const SLACK: f64 = 1e-13;

/// Loops with fewer samples are solved without a bound: it would cost more than it saves.
const LEAST_THINNED: usize = 64;
/// The bound comes from every fourth sample, at a 64th of the cost.
const THINNING: usize = 4;
/// How far from a rung of the thinned loop rungs are tried, in samples of the thinned loop.
const REACH: usize = 1;
/// How much more than that of the thinned loop the answer may cost, where its rungs lead to none.
const GUESSES: [f64; 2] = [1.3, 5.2];
/// Above it no bound is tried: a boundary like that needs all entries.
const HIGHEST_BOUND: f64 = 100.0;

/// What the tables of m samples take, bytes: this one, with folds, those of the thinned loops, a
/// sixteenth each of the one before, who sees whom, and the band.
pub fn memory_needed(m: usize) -> u64 {
    let m = m as u64;
    let lanes = LANES as u64;
    let tiles = m.div_ceil(lanes) * (m.div_ceil(lanes) + 1) / 2;
    let tile = lanes * (size_of::<Lanes>() + size_of::<[Lanes; 3]>()) as u64;
    let pairs = m * m.saturating_sub(1) / 2;
    let listed = (size_of::<u32>() + size_of::<f64>()) as u64;
    (tiles * tile + pairs * listed) / 15 * 16 + pairs / 4 + pairs / 8
}

/// The triangles of the cheapest triangulation; `None` if there is none.
pub(super) fn solve(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    Ok(solve_priced(terms, watch)?.map(|solved| solved.triangles))
}

/// The same, with its price.
pub(super) fn solve_priced(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut table = Table::new(terms);
    let mut left = 1.0;
    for bound in bounds(&mut table, watch)? {
        // Nobody knows how many bounds it takes: each gets half of what is left of the progress.
        let share = 1.0 - left..1.0 - 0.5 * left;
        let price = table.fill(bound, None, watch, share)?;
        if price < f64::INFINITY {
            return Ok(Some(Solved { price, triangles: table.trace() }));
        }
        left *= 0.5;
    }
    Ok(None)
}

/// The triangles of the cheapest triangulation up to the price `bound`, and that price; `None` if
/// there is none.
pub(super) fn solve_within(
    terms: &Terms<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut table = Table::new(terms);
    let bound = if bound > HIGHEST_BOUND { f64::INFINITY } else { bound };
    let price = table.fill(bound, None, watch, 0.0..0.0)?;
    Ok((price < f64::INFINITY).then(|| Solved { price, triangles: table.trace() }))
}

/// Bounds to try on the price of the answer, one after the other; the last is none at all.
fn bounds(table: &mut Table<'_>, watch: &mut dyn Watch) -> Result<Vec<f64>, TriangulateError> {
    if table.m < LEAST_THINNED {
        return Ok(vec![f64::INFINITY]);
    }
    let thinned = table.terms.thinned(THINNING);
    let Some(coarse) = solve_priced(&thinned.terms(), &mut Part::silent(watch))? else {
        return Ok(vec![f64::INFINITY]);
    };
    let band = Band::along(&coarse.triangles, table.m);
    let price = table.fill(f64::INFINITY, Some(&band), watch, 0.0..0.0)?;
    Ok(match price {
        _ if coarse.price.min(price) > HIGHEST_BOUND => vec![f64::INFINITY],
        f64::INFINITY => {
            let guessed = |guess: f64| quantised((guess * coarse.price).min(HIGHEST_BOUND));
            GUESSES.map(guessed).into_iter().chain([f64::INFINITY]).collect()
        }
        _ => vec![price],
    })
}

/// The rungs near those of a triangulation of the thinned loop.
struct Band {
    /// How many samples the thinned loop has.
    n: usize,
    /// Whether rungs from the samples of one part of the loop to those of another are near, by
    /// pairs of parts, the lower first; part a begins with sample a of the thinned loop.
    near: Vec<bool>,
}

impl Band {
    fn along(triangles: &[[usize; 3]], m: usize) -> Self {
        let n = m.div_ceil(THINNING);
        let mut near = vec![false; n * n];
        for &[i, k, j] in triangles {
            for (a, b) in [(i, k), (k, j), (i, j)] {
                for a in (0..=2 * REACH).map(|step| (a + n + step - REACH) % n) {
                    for b in (0..=2 * REACH).map(|step| (b + n + step - REACH) % n) {
                        near[a.min(b) * n + a.max(b)] = true;
                    }
                }
            }
        }
        Self { n, near }
    }

    /// Which of the rungs from sample `i` to the far ends are near.
    fn lanes(&self, i: usize, to: &FarEnds) -> [bool; LANES] {
        let row = &self.near[i / THINNING * self.n..][..self.n];
        std::array::from_fn(|n| row[((to.first + n) / THINNING).min(self.n - 1)])
    }
}

/// The table in tiles of [`LANES`] rows by as many columns, on and above the diagonal. The tiles of
/// as many columns follow one another, from the first row down to the diagonal, and so do the rows
/// of each: a row holds E(k,j) of one k and all j of the tile.
struct Table<'a> {
    terms: &'a Terms<'a>,
    m: usize,
    entries: Vec<Lanes>,
    /// N in the same order, by axis; empty when folds cost nothing.
    means: Vec<[Lanes; 3]>,
    /// The finite entries of every row once more, packed: where and what. Row i begins at
    /// `row_start` and has as many as `row_lengths` says.
    row_k: Vec<u32>,
    row_entries: Vec<f64>,
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
    /// The best k of the row that was filled last, which is near to that of the next one; 0 for
    /// none.
    best: [u64; LANES],
}

/// A tile to be filled. A type rather than a closure: the call of a closure by value goes through a
/// function of its own, which is not compiled for the wider registers.
struct Filling<'a> {
    table: &'a Table<'a>,
    row: usize,
    to: &'a FarEnds,
    band: Option<&'a Band>,
    tile: &'a mut Tile,
}

impl pulp::WithSimd for Filling<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.table.fill_tile(self.row, self.to, self.band, self.tile);
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
    fn new(terms: &'a Terms<'a>) -> Self {
        let m = terms.prices.len();
        let tiles = m.div_ceil(LANES);
        let (pairs, slots) = (m * (m - 1) / 2, slot(0, tiles));
        let folds = terms.folds();
        Self {
            terms,
            m,
            entries: vec![[0.0; LANES]; slots],
            means: vec![[[0.0; LANES]; 3]; if folds { slots } else { 0 }],
            row_k: vec![0; pairs],
            row_entries: vec![0.0; pairs],
            row_lengths: vec![0; m],
            folds,
            in_order: terms.prices.in_order(),
            bound: f64::INFINITY,
        }
    }

    /// Fills the table with all entries up to `bound`, those of rungs outside the band excepted,
    /// and returns the price of the answer. `share` is the part of the progress that this is.
    fn fill(
        &mut self,
        bound: f64,
        band: Option<&Band>,
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<f64, TriangulateError> {
        self.bound = bound;
        self.row_lengths.fill(0);
        let registers = pulp::Arch::new();
        let mut tile = Tile {
            entries: [[f64::INFINITY; LANES]; LANES],
            means: [[[0.0; LANES]; 3]; LANES],
            best: [0; LANES],
        };
        for column in 0..self.m.div_ceil(LANES) {
            let to = self.terms.prices.far_ends(column * LANES);
            tile.best = [0; LANES];
            for row in (0..=column).rev() {
                if watch.stop() {
                    return Err(TriangulateError::Stopped);
                }
                registers.dispatch(Filling { table: self, row, to: &to, band, tile: &mut tile });
                self.store(row, column, &tile);
            }
            let done = to.first as f64 / self.m as f64;
            watch.progress(share.start + (share.end - share.start) * done * done * done);
        }
        Ok(self.entry(0, self.m - 1))
    }

    fn store(&mut self, row: usize, column: usize, tile: &Tile) {
        let first = slot(row * LANES, column);
        self.entries[first..][..LANES].copy_from_slice(&tile.entries);
        if self.folds {
            self.means[first..][..LANES].copy_from_slice(&tile.means);
        }
        for (i, entries) in (row * LANES..self.m).zip(&tile.entries) {
            let mut at = row_start(self.m, i) + self.row_lengths[i];
            for (n, &entry) in entries.iter().enumerate() {
                if entry < f64::INFINITY {
                    self.row_k[at] = (column * LANES + n) as u32;
                    self.row_entries[at] = entry;
                    at += 1;
                }
            }
            self.row_lengths[i] = at - row_start(self.m, i);
        }
    }

    /// Fills the tile of these rows and the columns of the far ends, from all tiles to its left and
    /// below.
    #[inline(always)]
    fn fill_tile(&self, row: usize, to: &FarEnds, band: Option<&Band>, tile: &mut Tile) {
        match (self.folds, self.terms.rule) {
            (true, _) => self.fill_by::<true>(row, to, band, tile, |a, b| a + b),
            (false, Rule::Sum) => self.fill_by::<false>(row, to, band, tile, |a, b| a + b),
            (false, Rule::Worst) => {
                self.fill_by::<false>(row, to, band, tile, |a, b| if a > b { a } else { b });
            }
        }
    }

    #[inline(always)]
    fn fill_by<const FOLDS: bool>(
        &self,
        row: usize,
        to: &FarEnds,
        band: Option<&Band>,
        tile: &mut Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        tile.entries = [[f64::INFINITY; LANES]; LANES];
        let rows = row * LANES..self.m.min((row + 1) * LANES);
        let column = to.first / LANES;
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
                self.look_first(&mut least, &rows, column, tile);
            }
            let listed = row_start(self.m, i)..row_start(self.m, i) + self.row_lengths[i];
            for (&k, &entry) in self.row_k[listed.clone()].iter().zip(&self.row_entries[listed]) {
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
            tile.best = least.best;
        }
    }

    /// Looks at those k that were best one row below.
    #[inline(always)]
    fn look_first(&self, least: &mut Least<'_>, rows: &Range<usize>, column: usize, tile: &Tile) {
        let mut last = 0;
        for n in 0..LANES {
            let k = tile.best[n] as usize;
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
            (&self.entries[at], self.means.get(at).unwrap_or(&NONE))
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
        self.means[slot(i, j / LANES)].map(|mean| mean[j % LANES])
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        self.entries[slot(i, j / LANES)][j % LANES]
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
    fn trace(&self) -> Vec<[usize; 3]> {
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
        for (&k, &entry) in self.row_k[listed.clone()].iter().zip(&self.row_entries[listed]) {
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
