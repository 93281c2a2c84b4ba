//! The cheapest triangulation of all: equations (2) and (5) as one triangular table.
//!
//! 1. The edge ⟨0, m−1⟩ belongs to every triangulation, so one table answers the whole loop. Let
//!    E(i,j) be the least price of the part of the loop from i to j *with* the rung ⟨i,j⟩; it is 0
//!    for an edge of the boundary. Then equation (5) reads
//!    E(i,j) = w(i,j) + min over i<k<j of E(i,k) + E(k,j) + F(i,k,j),
//!    with F the fold price of the triangle. Θ(m³) sums, Θ(m²) memory.
//! 2. Row i (all k of E(i,k)) and column j (all k of E(k,j)) are both kept contiguous, so that the
//!    inner loop runs over two slices and the compiler vectorises it, for the widest registers that
//!    the processor has (crate `pulp`; the bits are the same with any).
//! 3. F is never negative, and dear to work out. So a first k, the best one of the neighbouring
//!    entries, sets a bound; the sums E(i,k) + E(k,j) are compared with it eight at a time; where
//!    one lies below, so is a bound of F from its three rungs alone, and F is worked out only where
//!    that does not decide. With s the sum of the three N, no unit normal n makes
//!    Σ (1 − n·N) less than 3 − |s| ≥ (9 − |s|²) / 6. That is done in f32, less a slack for its
//!    rounding.
//! 4. Prices are never negative, so no entry above the price of the answer is a part of it. A
//!    bound on that price is guessed from the optimum of every fourth sample (a developable surface
//!    has four times as much twist there, a hopeless boundary as much); entries above it are
//!    dropped, and rungs whose own twist is above it are not even looked at. An answer at or below
//!    the bound is the optimum of all; without one, the bound is raised.
//! 5. Which k was best is not stored but found again on the way back, for the m − 2 entries that
//!    belong to the answer. Of equal prices (prices are exact, see [`crate::cost`], so flat regions
//!    do tie) the k with the least |P_i P_k| + |P_k P_j| wins, then the smallest: strips of compact
//!    triangles rather than fans.

use super::{Rule, Solved, Terms, TriangulateError};
use crate::cost::{QUANTUM, RungColumn, quantised};
use crate::math::Vec3;
use crate::watch::Watch;
use std::ops::Range;

/// How many sums are compared at once: two to four vector registers on common processors.
const LANES: usize = 8;
/// What the bound of F may lose to rounding in f32, for ν = 1: |s|² is at most 9 and comes from
/// some ten operations with an error of 2⁻²⁴ each.
const SLACK: f32 = 4e-6;

/// Loops with fewer samples are solved without a bound: the guess would cost more than it saves.
const LEAST_THINNED: usize = 64;
/// The guess comes from every fourth sample, at a 64th of the cost.
const THINNING: usize = 4;
/// How much more than expected the answer may cost. Guesses that are too low cost little, as they
/// leave few entries; those that are too high leave many.
const GUESS: f64 = 1.3;
/// Above it no bound is tried: a boundary like that needs all entries.
const HIGHEST_BOUND: f64 = 100.0;

/// What the tables of m samples take, bytes: this one, those of the thinned loops, a sixteenth each
/// of the one before, and who sees whom.
pub fn memory_needed(m: usize) -> u64 {
    let pairs = (m as u64) * (m as u64).saturating_sub(1) / 2;
    let entry = 2 * size_of::<f64>() + 6 * size_of::<f32>() + size_of::<Vec3>();
    pairs * (entry as u64) / 15 * 16 + pairs / 4
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
    for bound in bounds(terms, watch)? {
        // Nobody knows how many bounds it takes: each gets half of what is left of the progress.
        let share = 1.0 - left..1.0 - 0.5 * left;
        let price = table.fill(bound, watch, share)?;
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
    let price = table.fill(bound, watch, 0.0..0.0)?;
    Ok((price < f64::INFINITY).then(|| Solved { price, triangles: table.trace() }))
}

/// Bounds to try on the price of the answer, one after the other; the last is none at all.
fn bounds(terms: &Terms<'_>, watch: &mut dyn Watch) -> Result<Vec<f64>, TriangulateError> {
    if terms.prices.len() < LEAST_THINNED {
        return Ok(vec![f64::INFINITY]);
    }
    let thinned = terms.thinned(THINNING);
    let coarse = thinned.terms();
    let mut table = Table::new(&coarse);
    for bound in bounds(&coarse, watch)? {
        let price = table.fill(bound, watch, 0.0..0.0)?;
        if price < f64::INFINITY {
            let steps = [GUESS / THINNING as f64, GUESS, GUESS * THINNING as f64];
            let tried = steps.iter().map(|step| quantised((step * price).min(HIGHEST_BOUND)));
            return Ok(tried.chain([f64::INFINITY]).collect());
        }
    }
    Ok(vec![f64::INFINITY])
}

/// Packed triangles over pairs i < k.
struct Table<'a> {
    terms: &'a Terms<'a>,
    m: usize,
    /// E by rows: E(i,k) at row_start(i) + k − i − 1.
    rows: Vec<f64>,
    /// E by columns: E(k,j) at column_start(j) + k.
    columns: Vec<f64>,
    /// N by rows, by rows and axis in f32, and by columns and axis in f32; all empty when folds
    /// cost nothing.
    means: Vec<Vec3>,
    mean_rows: [Vec<f32>; 3],
    mean_columns: [Vec<f32>; 3],
    folds: bool,
    /// Entries above it are infinite; a multiple of the quantum.
    bound: f64,
    /// The rungs to sample j, while column j is filled.
    rungs: RungColumn,
    /// The best k of E(i, j − 1) for every i, while column j is filled.
    best_before: Vec<usize>,
}

fn row_start(m: usize, i: usize) -> usize {
    // Rows before i have m − 1, m − 2, … entries; i · (i + 1) / 2 is what they lack.
    i * m - i * (i + 1) / 2
}

fn column_start(j: usize) -> usize {
    j * (j.max(1) - 1) / 2
}

/// The least price found so far, and where.
#[derive(Clone, Copy)]
struct Least {
    price: f64,
    k: usize,
}

impl<'a> Table<'a> {
    fn new(terms: &'a Terms<'a>) -> Self {
        let m = terms.prices.len();
        let pairs = m * (m - 1) / 2;
        let folds = terms.folds();
        let of_folds = if folds { pairs } else { 0 };
        Self {
            terms,
            m,
            rows: vec![0.0; pairs],
            columns: vec![0.0; pairs],
            means: vec![Vec3::ZERO; of_folds],
            mean_rows: [0, 1, 2].map(|_| vec![0.0; of_folds]),
            mean_columns: [0, 1, 2].map(|_| vec![0.0; of_folds]),
            folds,
            bound: f64::INFINITY,
            rungs: RungColumn::default(),
            best_before: vec![0; m],
        }
    }

    /// Fills the table with all entries up to `bound`, and returns the price of the answer. `share`
    /// is the part of the progress that this is.
    fn fill(
        &mut self,
        bound: f64,
        watch: &mut dyn Watch,
        share: Range<f64>,
    ) -> Result<f64, TriangulateError> {
        self.bound = bound;
        let registers = pulp::Arch::new();
        for j in 1..self.m {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let done = j as f64 / self.m as f64;
            watch.progress(share.start + (share.end - share.start) * done * done * done);
            registers.dispatch(
                #[inline(always)]
                || self.fill_column(j),
            );
        }
        Ok(self.rows[self.m - 2])
    }

    /// Fills E(i,j) for all i, from j − 1 down to 0.
    #[inline(always)]
    fn fill_column(&mut self, j: usize) {
        let mut rungs = std::mem::take(&mut self.rungs);
        self.terms.column(j, &mut rungs);
        let mut best_below = j;
        for i in (0..j).rev() {
            let here = row_start(self.m, i) + j - i - 1;
            if self.folds {
                self.keep_mean(i, j, here, [0, 1, 2].map(|axis| rungs.means[axis][i]));
            }
            let mut price = rungs.prices[i];
            if price > self.bound {
                price = f64::INFINITY;
            } else if price < f64::INFINITY && i + 1 < j {
                let first = [best_below, self.best_before[i]].map(|k| k.clamp(i + 1, j - 1));
                let left = match self.terms.rule {
                    Rule::Sum => self.bound - price,
                    Rule::Worst => self.bound,
                };
                // Prices up to the bound lie below the next multiple of the quantum.
                let below = left + QUANTUM;
                let least = self.least(i, j, below, first);
                (best_below, self.best_before[i]) = (least.k, least.k);
                price = if least.price < below {
                    self.terms.together(price, least.price)
                } else {
                    f64::INFINITY
                };
            }
            self.rows[here] = price;
            self.columns[column_start(j) + i] = price;
        }
        self.rungs = rungs;
    }

    #[inline(always)]
    fn keep_mean(&mut self, i: usize, j: usize, here: usize, mean: [f64; 3]) {
        self.means[here] = Vec3::from_array(mean);
        for axis in 0..3 {
            self.mean_rows[axis][here] = mean[axis] as f32;
            self.mean_columns[axis][column_start(j) + i] = mean[axis] as f32;
        }
    }

    /// The least of E(i,k) + E(k,j) + F(i,k,j) if it lies below `below`, and a k that reaches it
    /// (without folds, or at or above `below`, one of `first`); `first` are the k to look at first.
    #[inline(always)]
    fn least(&self, i: usize, j: usize, below: f64, first: [usize; 2]) -> Least {
        let row = &self.rows[row_start(self.m, i)..][..j - i - 1];
        let column = &self.columns[column_start(j)..][i + 1..j];
        if !self.folds {
            let price = match self.terms.rule {
                Rule::Sum => least_of(row, column, |a, b| a + b),
                Rule::Worst => least_of(row, column, |a, b| if a > b { a } else { b }),
            };
            return Least { price, k: first[0] };
        }
        let mut least = Least { price: below, k: first[0] };
        // The ends too: their triangles have an edge of the boundary, for which the bound of F
        // does not hold.
        for k in [first[0], first[1], i + 1, j - 1] {
            self.look_at(i, k, j, row[k - i - 1] + column[k - i - 1], &mut least);
        }
        if i == 0 && j + 1 == self.m {
            // The last entry's own side is an edge as well.
            for k in i + 2..j - 1 {
                self.look_at(i, k, j, row[k - i - 1] + column[k - i - 1], &mut least);
            }
            return least;
        }
        let (row_blocks, row_rest) = row.as_chunks::<LANES>();
        let (column_blocks, column_rest) = column.as_chunks::<LANES>();
        for (block, (a, b)) in row_blocks.iter().zip(column_blocks).enumerate() {
            let mut below = false;
            for n in 0..LANES {
                below |= a[n] + b[n] < least.price;
            }
            if below {
                self.look_at_block(i, i + 1 + block * LANES, j, a, b, &mut least);
            }
        }
        let done = row_blocks.len() * LANES;
        for (n, (a, b)) in row_rest.iter().zip(column_rest).enumerate() {
            self.look_at(i, i + 1 + done + n, j, a + b, &mut least);
        }
        least
    }

    /// Looks at the eight k from `start` on, of which some sum lies below the least price.
    #[inline(always)]
    fn look_at_block(
        &self,
        i: usize,
        start: usize,
        j: usize,
        row: &[f64; LANES],
        column: &[f64; LANES],
        least: &mut Least,
    ) {
        let block = |list: &[f32], at: usize| -> [f32; LANES] {
            list[at..].first_chunk().copied().unwrap_or([0.0; LANES])
        };
        let row_at = row_start(self.m, i) + start - i - 1;
        let column_at = column_start(j) + start;
        let own = self.means[row_start(self.m, i) + j - i - 1];
        let mut square = [0.0f32; LANES];
        for axis in 0..3 {
            let a = block(&self.mean_rows[axis], row_at);
            let b = block(&self.mean_columns[axis], column_at);
            let c = own[axis] as f32;
            for n in 0..LANES {
                let sum = a[n] + b[n] + c;
                square[n] += sum * sum;
            }
        }
        let fold = self.terms.prices.options().fold as f32;
        let (sixth, slack) = (fold / 6.0, fold * SLACK);
        let mut open = [false; LANES];
        for n in 0..LANES {
            let room = (least.price - (row[n] + column[n])) as f32;
            open[n] = sixth * (9.0 - square[n]) - slack < room;
        }
        for n in 0..LANES {
            if open[n] {
                self.look_at(i, start + n, j, row[n] + column[n], least);
            }
        }
    }

    #[inline(always)]
    fn look_at(&self, i: usize, k: usize, j: usize, sum: f64, least: &mut Least) {
        if sum < least.price {
            let price = sum + self.fold(i, k, j);
            if price < least.price {
                *least = Least { price, k };
            }
        }
    }

    /// F(i,k,j).
    #[inline(always)]
    fn fold(&self, i: usize, k: usize, j: usize) -> f64 {
        if !self.folds {
            return 0.0;
        }
        let mean = |a: usize, b: usize| self.means[row_start(self.m, a) + b - a - 1];
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
        let row = &self.rows[row_start(self.m, i)..];
        let column = &self.columns[column_start(j)..];
        let mut chosen = (f64::INFINITY, f64::INFINITY, i + 1);
        for k in i + 1..j {
            let sum = self.terms.together(row[k - i - 1], column[k]);
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

/// The least of what two slices are together, element by element; infinite for empty ones.
#[inline(always)]
fn least_of(row: &[f64], column: &[f64], together: impl Fn(f64, f64) -> f64) -> f64 {
    let (row_blocks, row_rest) = row.as_chunks::<LANES>();
    let (column_blocks, column_rest) = column.as_chunks::<LANES>();
    let mut least = [f64::INFINITY; LANES];
    for (a, b) in row_blocks.iter().zip(column_blocks) {
        for n in 0..LANES {
            let price = together(a[n], b[n]);
            // Written out: `f64::min` also orders NaN, which costs instructions and can't occur.
            least[n] = if price < least[n] { price } else { least[n] };
        }
    }
    let rest = row_rest.iter().zip(column_rest).map(|(&a, &b)| together(a, b));
    least.into_iter().chain(rest).fold(f64::INFINITY, |a, b| if b < a { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_columns_are_packed() {
        let m = 7;
        let mut rows = Vec::new();
        let mut columns = Vec::new();
        for i in 0..m {
            rows.extend((i + 1..m).map(|k| row_start(m, i) + k - i - 1));
        }
        for j in 1..m {
            columns.extend((0..j).map(|k| column_start(j) + k));
        }
        assert_eq!(rows, (0..21).collect::<Vec<_>>());
        assert_eq!(columns, (0..21).collect::<Vec<_>>());
    }
}
