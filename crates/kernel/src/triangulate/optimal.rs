//! The cheapest triangulation of all: equations (2) and (5) as one triangular table.
//!
//! 1. The edge ⟨0, m−1⟩ belongs to every triangulation, so one table answers the whole loop. Let
//!    E(i,j) be the least price of the part of the loop from i to j *with* the rung ⟨i,j⟩; it is 0
//!    for an edge of the boundary. Then equation (5) reads
//!    E(i,j) = w(i,j) + min over i<k<j of E(i,k) + E(k,j) + F(i,k,j),
//!    with F the fold price of the triangle. Θ(m³) sums, Θ(m²) memory.
//! 2. Row i (all k of E(i,k)) and column j (all k of E(k,j)) are both kept contiguous, so that the
//!    inner loop runs over two slices and the compiler vectorises it.
//! 3. F is never negative, and dear to work out. So a first k, the best one of the neighbouring
//!    entry, sets a bound; the sums E(i,k) + E(k,j) are compared with it eight at a time; and F is
//!    worked out only where a sum lies below it. On boundaries near to a developable surface that
//!    is a handful of k for every entry.
//! 4. Which k was best is not stored but found again on the way back, for the m − 2 entries that
//!    belong to the answer. Of equal prices (prices are exact, see [`crate::cost`], so flat regions
//!    do tie) the k with the least |P_i P_k| + |P_k P_j| wins, then the smallest: strips of compact
//!    triangles rather than fans.

use super::{Terms, TriangulateError};
use crate::math::Vec3;
use crate::watch::Watch;

/// How many sums are compared at once: two to four vector registers on common processors.
const LANES: usize = 8;

/// What the table of m samples takes, bytes.
pub fn memory_needed(m: usize) -> u64 {
    let pairs = (m as u64) * (m as u64).saturating_sub(1) / 2;
    pairs * (2 * size_of::<f64>() + size_of::<Vec3>()) as u64
}

/// The triangles of the cheapest triangulation; `None` if there is none.
pub(super) fn solve(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    let m = terms.prices.len();
    let mut table = Table::new(terms);
    for j in 1..m {
        if watch.stop() {
            return Err(TriangulateError::Stopped);
        }
        let done = j as f64 / m as f64;
        watch.progress(done * done * done);
        table.fill_column(j);
    }
    Ok(table.trace())
}

/// Packed triangles over pairs i < k.
struct Table<'a> {
    terms: &'a Terms<'a>,
    m: usize,
    /// E by rows: E(i,k) at row_start(i) + k − i − 1.
    rows: Vec<f64>,
    /// E by columns: E(k,j) at column_start(j) + k.
    columns: Vec<f64>,
    /// N by rows, as `rows`; empty when folds cost nothing.
    means: Vec<Vec3>,
    folds: bool,
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

impl<'a> Table<'a> {
    fn new(terms: &'a Terms<'a>) -> Self {
        let m = terms.prices.len();
        let pairs = m * (m - 1) / 2;
        let folds = terms.prices.options().fold > 0.0;
        Self {
            terms,
            m,
            rows: vec![0.0; pairs],
            columns: vec![0.0; pairs],
            means: vec![Vec3::ZERO; if folds { pairs } else { 0 }],
            folds,
            best_before: (0..m).map(|i| i + 1).collect(),
        }
    }

    /// Fills E(i,j) for all i, from j − 1 down to 0.
    fn fill_column(&mut self, j: usize) {
        let mut best_below = j;
        for i in (0..j).rev() {
            let side = self.terms.side(i, j);
            let here = row_start(self.m, i) + j - i - 1;
            if self.folds {
                self.means[here] = side.mean;
            }
            let price = if side.price == f64::INFINITY || i + 1 == j {
                side.price
            } else {
                let first = [best_below.clamp(i + 1, j - 1), self.best_before[i].clamp(i + 1, j - 1)];
                let (least, best) = self.least(i, j, first);
                (best_below, self.best_before[i]) = (best, best);
                least + side.price
            };
            self.rows[here] = price;
            self.columns[column_start(j) + i] = price;
        }
    }

    /// The least of E(i,k) + E(k,j) + F(i,k,j), and a k that reaches it (without folds, the best of
    /// `first`); `first` are the k to look at first.
    fn least(&self, i: usize, j: usize, first: [usize; 2]) -> (f64, usize) {
        let row = &self.rows[row_start(self.m, i)..][..j - i - 1];
        let column = &self.columns[column_start(j)..][i + 1..j];
        if !self.folds {
            return (least_sum(row, column), first[0]);
        }
        let (mut least, mut best) = (f64::INFINITY, first[0]);
        for k in first {
            let price = row[k - i - 1] + column[k - i - 1];
            if price < least {
                let price = price + self.fold(i, k, j);
                if price < least {
                    (least, best) = (price, k);
                }
            }
        }
        let (row_blocks, row_rest) = row.as_chunks::<LANES>();
        let (column_blocks, column_rest) = column.as_chunks::<LANES>();
        for (block, (a, b)) in row_blocks.iter().zip(column_blocks).enumerate() {
            let sums: [f64; LANES] = std::array::from_fn(|n| a[n] + b[n]);
            let below = sums.iter().fold(false, |any, &sum| any | (sum < least));
            if below {
                for (n, sum) in sums.into_iter().enumerate() {
                    self.look_at(i, i + 1 + block * LANES + n, j, sum, &mut least, &mut best);
                }
            }
        }
        let done = row_blocks.len() * LANES;
        for (n, (a, b)) in row_rest.iter().zip(column_rest).enumerate() {
            self.look_at(i, i + 1 + done + n, j, a + b, &mut least, &mut best);
        }
        (least, best)
    }

    #[inline]
    fn look_at(
        &self,
        i: usize,
        k: usize,
        j: usize,
        sum: f64,
        least: &mut f64,
        best: &mut usize,
    ) {
        if sum < *least {
            let price = sum + self.fold(i, k, j);
            if price < *least {
                (*least, *best) = (price, k);
            }
        }
    }

    /// F(i,k,j).
    fn fold(&self, i: usize, k: usize, j: usize) -> f64 {
        if !self.folds {
            return 0.0;
        }
        let mean = |a: usize, b: usize| self.means[row_start(self.m, a) + b - a - 1];
        self.terms.prices.triangle([i, k, j], [mean(i, k), mean(k, j), mean(i, j)])
    }

    /// The triangles below the edge ⟨0, m−1⟩; `None` if its price is infinite.
    fn trace(&self) -> Option<Vec<[usize; 3]>> {
        if self.rows[self.m - 2] == f64::INFINITY {
            return None;
        }
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
        Some(triangles)
    }

    /// The k of E(i,j), by the rule for equals.
    fn chosen(&self, i: usize, j: usize) -> usize {
        let row = &self.rows[row_start(self.m, i)..];
        let column = &self.columns[column_start(j)..];
        let mut chosen = (f64::INFINITY, f64::INFINITY, i + 1);
        for k in i + 1..j {
            let sum = row[k - i - 1] + column[k];
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

/// The least of the sums of two slices, element by element; infinite for empty ones.
fn least_sum(row: &[f64], column: &[f64]) -> f64 {
    let (row_blocks, row_rest) = row.as_chunks::<LANES>();
    let (column_blocks, column_rest) = column.as_chunks::<LANES>();
    let mut least = [f64::INFINITY; LANES];
    for (a, b) in row_blocks.iter().zip(column_blocks) {
        for n in 0..LANES {
            let sum = a[n] + b[n];
            // Written out: `f64::min` also orders NaN, which costs instructions and can't occur.
            least[n] = if sum < least[n] { sum } else { least[n] };
        }
    }
    let rest = row_rest.iter().zip(column_rest).map(|(a, b)| a + b);
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
