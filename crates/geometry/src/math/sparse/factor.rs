//! The numbers of a factor L·Lᵀ of a matrix of B × B blocks, row of blocks after row of blocks.
//!
//! A row of L solves a triangular system. Its unknowns are the columns that the tree of elimination
//! reaches from the row's entries, each subtracted from what is left of the row (up-looking
//! Cholesky \[Davis2006, section 4.7\]). Two things make that two to three times as fast:
//!
//! 1. The B rows of a node reach the same columns, so they are computed together.
//! 2. Columns that follow one another and have the same rows below them are subtracted together,
//!    four at a time, so that what is left of a row is loaded and stored once for them.
//!
//! Neither changes a bit: for each entry, the same products are subtracted in the same order.

use super::TooLarge;

/// So many columns are subtracted together at the most.
const WIDE: usize = 4;

/// Where the entries of a triangle lie, column after column.
#[derive(Clone, Copy)]
pub(super) struct Columns<'a> {
    /// Where each column starts, and where the last one ends.
    pub(super) starts: &'a [u32],
    /// The row of each entry.
    pub(super) rows: &'a [u32],
}

impl Columns<'_> {
    fn start(&self, column: usize) -> usize {
        self.starts[column] as usize
    }

    fn count(&self, column: usize) -> usize {
        self.start(column + 1) - self.start(column)
    }

    /// Of a factor, the column that a column is eliminated into: its first row below the diagonal.
    fn parent(&self, column: usize) -> u32 {
        self.rows[self.start(column) + 1]
    }
}

/// The factor of the matrix with these entries in its upper triangle, whose entries lie where
/// `lower` says, the diagonal first in each column; `None` unless the matrix is positive definite.
///
/// # Errors
/// [`TooLarge`].
pub(super) fn factored<const B: usize>(
    upper: Columns<'_>,
    entries: &[f64],
    lower: Columns<'_>,
) -> Result<Option<Vec<f64>>, TooLarge> {
    let n = lower.starts.len() - 1;
    let mut reach = Reach::new(n)?;
    let mut rows = Rows::<B> {
        lower,
        values: filled(0.0, lower.rows.len())?,
        known: filled(0, n)?,
        left: filled([0.0; B], n)?,
        corner: [[0.0; B]; B],
    };
    for k in (0..n).step_by(B) {
        rows.load(k, upper, entries);
        let above = &upper.rows[upper.start(k)..upper.start(k + 1)];
        let mut reached = reach.of(k, above, &lower);
        while let Some(&first) = reached.first() {
            let wide = rows.width(reached);
            rows.eliminate(first as usize, wide);
            reached = &reached[wide..];
        }
        if !rows.finish(k) {
            return Ok(None);
        }
    }
    Ok(Some(rows.values))
}

/// So many of a value.
fn filled<T: Clone>(value: T, count: usize) -> Result<Vec<T>, TooLarge> {
    let mut all = Vec::new();
    all.try_reserve_exact(count).map_err(|_| TooLarge)?;
    all.resize(count, value);
    Ok(all)
}

/// The rows of a node while they are computed.
struct Rows<'a, const B: usize> {
    lower: Columns<'a>,
    /// The entries of the factor.
    values: Vec<f64>,
    /// How many entries of each column are known, the diagonal among them.
    known: Vec<u32>,
    /// What is left of the rows, by columns before the node's own.
    left: Vec<[f64; B]>,
    /// What is left of them in its own columns, each row up to its diagonal.
    corner: [[f64; B]; B],
}

impl<const B: usize> Rows<'_, B> {
    /// Begins with the matrix's entries.
    fn load(&mut self, k: usize, upper: Columns<'_>, entries: &[f64]) {
        self.corner = [[0.0; B]; B];
        for r in 0..B {
            for at in upper.start(k + r)..upper.start(k + r + 1) {
                let column = upper.rows[at] as usize;
                match column.checked_sub(k) {
                    None => self.left[column][r] += entries[at],
                    Some(own) => self.corner[r][own] += entries[at],
                }
            }
        }
    }

    /// How many of the columns reached, from the first on, follow one another and have the same
    /// rows below them.
    fn width(&self, reached: &[u32]) -> usize {
        let follows = |pair: &&[u32]| {
            let [a, b] = [pair[0] as usize, pair[1] as usize];
            let lower = &self.lower;
            lower.parent(a) == pair[1] && b == a + 1 && lower.count(a) == lower.count(b) + 1
        };
        1 + reached.windows(2).take(WIDE - 1).take_while(follows).count()
    }

    /// Solves for the entries in so many columns from the first on, and subtracts these.
    fn eliminate(&mut self, first: usize, wide: usize) {
        let mut solved = [[0.0; B]; WIDE];
        for a in 0..wide {
            let start = self.lower.start(first + a);
            let inverse = 1.0 / self.values[start];
            let x = self.left[first + a].map(|entry| entry * inverse);
            self.left[first + a] = [0.0; B];
            for b in a + 1..wide {
                subtract(&mut self.left[first + b], self.values[start + b - a], &x);
            }
            for r in 0..B {
                for s in 0..=r {
                    self.corner[r][s] -= x[s] * x[r];
                }
            }
            let end = start + self.known[first + a] as usize;
            self.values[end..end + B].copy_from_slice(&x);
            solved[a] = x;
        }
        self.subtract_below(first, wide, &solved);
        self.known[first..first + wide].iter_mut().for_each(|known| *known += B as u32);
    }

    /// Subtracts columns from what is left of the rows below all of them.
    fn subtract_below(&mut self, first: usize, wide: usize, solved: &[[f64; B]; WIDE]) {
        let count = self.known[first + wide - 1] as usize - 1;
        let below = |a: usize| self.lower.start(first + a) + wide - a;
        let rows = &self.lower.rows[below(0)..below(0) + count];
        let column = |a: usize| &self.values[below(a)..below(a) + count];
        if wide == WIDE {
            let [p, q, r, s] = [column(0), column(1), column(2), column(3)];
            for (n, &row) in rows.iter().enumerate() {
                let mut left = self.left[row as usize];
                subtract(&mut left, p[n], &solved[0]);
                subtract(&mut left, q[n], &solved[1]);
                subtract(&mut left, r[n], &solved[2]);
                subtract(&mut left, s[n], &solved[3]);
                self.left[row as usize] = left;
            }
            return;
        }
        for (a, x) in solved.iter().enumerate().take(wide) {
            for (&row, &value) in rows.iter().zip(column(a)) {
                subtract(&mut self.left[row as usize], value, x);
            }
        }
    }

    /// Solves for the entries in the node's own columns; whether they are those of a positive
    /// definite matrix.
    fn finish(&mut self, k: usize) -> bool {
        let corner = &mut self.corner;
        for r in 0..B {
            for s in 0..r {
                let start = self.lower.start(k + s);
                let x = corner[r][s] * (1.0 / self.values[start]);
                for t in s + 1..r {
                    corner[r][t] -= self.values[start + t - s] * x;
                }
                corner[r][r] -= x * x;
                self.values[start + r - s] = x;
            }
            if corner[r][r].is_nan() || corner[r][r] <= 0.0 {
                return false;
            }
            self.values[self.lower.start(k + r)] = corner[r][r].sqrt();
            self.known[k + r] = (B - r) as u32;
        }
        true
    }
}

#[inline(always)]
fn subtract<const B: usize>(from: &mut [f64; B], value: f64, times: &[f64; B]) {
    for r in 0..B {
        from[r] -= value * times[r];
    }
}

/// The columns that have an entry in a row.
struct Reach {
    path: Vec<u32>,
    order: Vec<u32>,
    /// The last row that reached each column.
    seen: Vec<u32>,
}

impl Reach {
    fn new(n: usize) -> Result<Self, TooLarge> {
        Ok(Self { path: Vec::new(), order: filled(0, n)?, seen: filled(u32::MAX, n)? })
    }

    /// Those of row `k`, whose entries up to the diagonal are `above`, in an order in which they
    /// can be solved: up the tree of elimination from each entry; of two branches, the later comes
    /// first.
    fn of(&mut self, k: usize, above: &[u32], lower: &Columns<'_>) -> &[u32] {
        let row = k as u32;
        let mut top = self.order.len();
        self.seen[k] = row;
        for &entry in above {
            self.path.clear();
            let mut column = entry;
            while self.seen[column as usize] != row {
                self.seen[column as usize] = row;
                self.path.push(column);
                column = lower.parent(column as usize);
            }
            top -= self.path.len();
            self.order[top..top + self.path.len()].copy_from_slice(&self.path);
        }
        &self.order[top..]
    }
}
