//! The table of equation (5) over the rungs that can belong to the answer.
//!
//! Rows are filled from the last to the first, each from left to right, as E(a,b) needs the entries
//! (a,c) to its left and (c,b) below it. The row is spread out over all samples and the columns are
//! packed, so that the sums E(a,c) + E(c,b) run over two slices, as in the dense table. They alone
//! show for most pairs that nothing comes of them; only then is a rung priced.

use super::super::{EDGE, Side, Solved, Terms, TriangulateError};
use super::blocks::Blocks;
use super::debts::Debts;
use super::sweep::Alive;
use crate::cost::{QUANTUM, quantised};
use crate::math::Vec3;
use crate::watch::Watch;
use std::ops::Range;

/// How many sums are compared at once.
const LANES: usize = 8;
/// What the bound of F may lose to rounding and to the quantum: far more than ν · 2⁻⁴⁹.
const SLACK: f64 = 1e-12;
/// What an entry takes, bytes, while the lists grow.
const BYTES_AN_ENTRY: usize = 2 * 44;

pub(super) struct Table<'a> {
    terms: &'a Terms<'a>,
    m: usize,
    folds: bool,
    /// The entries of the rows: second sample and E.
    entries: Vec<Range<usize>>,
    to: Vec<u32>,
    prices: Vec<f64>,
    columns: Vec<Column>,
    /// Positions by axis, the last sample first; empty where folds cost nothing.
    positions: [Vec<f64>; 3],
}

/// The entries (c, b) of a column, c from high to low.
#[derive(Clone, Default)]
struct Column {
    /// Entries that follow one another: how far the first is from the last sample, and their places.
    runs: Vec<(usize, Range<usize>)>,
    prices: Vec<f64>,
    /// N by axis, where folds cost something.
    means: [Vec<f64>; 3],
}

/// The row that is being filled, spread out: the entry (a, c) is at m − 1 − c.
struct Row {
    prices: Vec<f64>,
    means: [Vec<f64>; 3],
    /// The best c of the last entry of every column.
    best: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Least {
    price: f64,
    c: usize,
}

impl<'a> Table<'a> {
    /// Fills the table with all entries that can belong to an answer up to `bound`; `None` if it
    /// takes more than `memory`.
    pub(super) fn fill(
        terms: &'a Terms<'a>,
        blocks: &Blocks,
        alive: &Alive,
        debts: Option<&Debts>,
        bound: f64,
        memory: u64,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>, TriangulateError> {
        let m = terms.prices.len();
        let folds = terms.folds();
        let mut table = Self {
            terms,
            m,
            folds,
            entries: vec![0..0; m],
            to: Vec::new(),
            prices: Vec::new(),
            columns: vec![Column::default(); m],
            positions: [0, 1, 2].map(|axis| {
                let position = |i: usize| terms.prices.smooth_end(i).0[axis];
                (0..m).rev().filter(|_| folds).map(position).collect()
            }),
        };
        let width = if folds { m } else { 0 };
        let mut row = Row {
            prices: vec![f64::INFINITY; m],
            means: [0, 1, 2].map(|_| vec![0.0; width]),
            best: vec![0; m],
        };
        let registers = pulp::Arch::new();
        // Second samples, and what their inner sides may cost.
        let mut list: Vec<(usize, f64)> = Vec::new();
        let mut whole = blocks.len() - 1;
        let mut owed = vec![0.0; m];
        for a in (0..m - 1).rev() {
            if a % 64 == 0 && watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            while blocks.samples(whole).start > a {
                whole -= 1;
            }
            list.clear();
            let reached = alive.samples(blocks, whole, a).filter(|&(b, _)| a > 0 || b + 1 < m);
            match debts {
                Some(debts) => {
                    debts.row(a).for_each(|(b, debt)| owed[b] = debt);
                    let gap = bound - debts.bound;
                    list.extend(reached.map(|(b, outside)| {
                        let most = gap + debts.asked(a, b) - owed[b];
                        (b, most.min(bound - f64::from(outside)))
                    }));
                    debts.row(a).for_each(|(b, _)| owed[b] = 0.0);
                }
                None => list.extend(reached.map(|(b, outside)| (b, bound - f64::from(outside)))),
            }
            if a == 0 {
                list.push((m - 1, bound));
            }
            let share = if debts.is_some() { 0.5 } else { 1.0 };
            registers.dispatch(
                #[inline(always)]
                || table.fill_row(a, &list, share, &mut row),
            );
            if (table.to.len() * BYTES_AN_ENTRY) as u64 > memory {
                return Ok(None);
            }
        }
        Ok(Some(table))
    }

    /// Fills row a. The inner sides of a rung may cost what the list says less `share` of its own
    /// price.
    #[inline(always)]
    fn fill_row(&mut self, a: usize, list: &[(usize, f64)], share: f64, row: &mut Row) {
        let first = self.to.len();
        self.entries[a] = first..first;
        self.keep(a, a + 1, 0.0, Vec3::ZERO, row);
        let mut before = a + 1;
        for &(b, most) in list {
            if self.columns[b].prices.is_empty() || self.least_sum(b, row) > most {
                continue;
            }
            let is_root = a == 0 && b + 1 == self.m;
            let side = if is_root { EDGE } else { self.terms.side(a, b) };
            let most = if is_root { most } else { most - share * side.price };
            if most >= 0.0 {
                let guesses = [before, row.best[b] as usize];
                let least = self.least(a, b, side, most + QUANTUM, guesses, row);
                if least.price <= most {
                    before = least.c;
                    row.best[b] = least.c as u32;
                    self.keep(a, b, side.price + least.price, side.mean, row);
                }
            }
        }
        for at in first..self.to.len() {
            row.prices[self.m - 1 - self.to[at] as usize] = f64::INFINITY;
        }
    }

    #[inline(always)]
    fn keep(&mut self, a: usize, b: usize, price: f64, mean: Vec3, row: &mut Row) {
        let place = self.to.len();
        self.to.push(b as u32);
        self.prices.push(price);
        self.entries[a].end = place + 1;
        let (spread, from) = (self.m - 1 - b, self.m - 1 - a);
        row.prices[spread] = price;
        let column = &mut self.columns[b];
        let at = column.prices.len();
        match column.runs.last_mut() {
            Some((first, run)) if *first + run.len() == from => run.end += 1,
            _ => column.runs.push((from, at..at + 1)),
        }
        column.prices.push(price);
        if self.folds {
            for axis in 0..3 {
                column.means[axis].push(mean[axis]);
                row.means[axis][spread] = mean[axis];
            }
        }
    }

    /// The least of E(a,c) + E(c,b) over all c.
    #[inline(always)]
    fn least_sum(&self, b: usize, row: &Row) -> f64 {
        let column = &self.columns[b];
        let mut least = [f64::INFINITY; LANES];
        for (first, run) in &column.runs {
            let (one, one_rest) = row.prices[*first..*first + run.len()].as_chunks::<LANES>();
            let (other, other_rest) = column.prices[run.clone()].as_chunks::<LANES>();
            for (x, y) in one.iter().zip(other) {
                for n in 0..LANES {
                    let sum = x[n] + y[n];
                    least[n] = if sum < least[n] { sum } else { least[n] };
                }
            }
            for (x, y) in one_rest.iter().zip(other_rest) {
                let sum = x + y;
                least[0] = if sum < least[0] { sum } else { least[0] };
            }
        }
        least.into_iter().fold(f64::INFINITY, |a, b| if b < a { b } else { a })
    }

    /// The least of E(a,c) + E(c,b) + F(a,c,b) if it lies below `below`, and a c that reaches it.
    #[inline(always)]
    fn least(
        &self,
        a: usize,
        b: usize,
        side: Side,
        below: f64,
        guesses: [usize; 2],
        row: &Row,
    ) -> Least {
        let mut least = Least { price: below, c: guesses[0] };
        if !self.folds {
            let price = self.least_sum(b, row);
            return Least { price: if price < below { price } else { below }, ..least };
        }
        for c in guesses.into_iter().chain([a + 1, b - 1]) {
            if a < c
                && c < b
                && row.prices[self.m - 1 - c] < f64::INFINITY
                && let Some(at) = self.columns[b].place(self.m - 1 - c)
            {
                self.look_at(a, c, b, at, side, row, &mut least);
            }
        }
        let rungs = if a == 0 && b + 1 == self.m { 2.0 } else { 3.0 };
        for n in 0..self.columns[b].runs.len() {
            let (first, run) = self.columns[b].runs[n].clone();
            let blocks = run.len() / LANES * LANES;
            for n in (0..blocks).step_by(LANES) {
                self.look_at_lanes(a, b, first + n, run.start + n, rungs, side, row, &mut least);
            }
            for n in blocks..run.len() {
                let c = self.m - 1 - (first + n);
                self.look_at(a, c, b, run.start + n, side, row, &mut least);
            }
        }
        least
    }

    /// Looks at the triangles of eight c, whose entries (a, c) are at `here` in the row and (c, b)
    /// at `at` in the column. All of their sides but so many are taken to be rungs; those with
    /// edges come out too dear, and have been looked at.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn look_at_lanes(
        &self,
        a: usize,
        b: usize,
        here: usize,
        at: usize,
        rungs: f64,
        side: Side,
        row: &Row,
        least: &mut Least,
    ) {
        let lanes = |list: &[f64], at: usize| -> [f64; LANES] {
            list[at..].first_chunk().copied().unwrap_or([f64::INFINITY; LANES])
        };
        let column = &self.columns[b];
        let (x, y) = (lanes(&row.prices, here), lanes(&column.prices, at));
        let mut below = false;
        for n in 0..LANES {
            below |= x[n] + y[n] < least.price;
        }
        if !below {
            return;
        }
        let p = [0, 1, 2].map(|axis| lanes(&row.means[axis], here));
        let q = [0, 1, 2].map(|axis| lanes(&column.means[axis], at));
        let own = side.mean.to_array();
        let fold = self.terms.prices.options().fold;
        let mut is_open = rungs < 3.0;
        for n in 0..LANES {
            let sum = [0, 1, 2].map(|axis| p[axis][n] + q[axis][n] + own[axis]);
            let square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
            let bound = x[n] + y[n] + fold / 6.0 * (9.0 - square);
            is_open |= bound < least.price + SLACK;
        }
        if !is_open {
            return;
        }
        // As `Prices::triangle` has it, so that the bits are the same.
        let point = |i: usize| [0, 1, 2].map(|axis| self.positions[axis][self.m - 1 - i]);
        let (from, to) = (point(a), point(b));
        let v = [0, 1, 2].map(|axis| to[axis] - from[axis]);
        let c = [0, 1, 2].map(|axis| lanes(&self.positions[axis], here));
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            let u = [c[0][n] - from[0], c[1][n] - from[1], c[2][n] - from[2]];
            let area =
                [u[1] * v[2] - v[1] * u[2], u[2] * v[0] - v[2] * u[0], u[0] * v[1] - v[0] * u[1]];
            let sum = [0, 1, 2].map(|axis| p[axis][n] + q[axis][n] + own[axis]);
            let doubled = (area[0] * area[0] + area[1] * area[1] + area[2] * area[2]).sqrt();
            let dot = area[0] * sum[0] + area[1] * sum[1] + area[2] * sum[2];
            let along = if doubled > 0.0 { dot / doubled } else { -rungs };
            prices[n] = x[n] + y[n] + quantised(fold * (rungs - along));
        }
        for n in 0..LANES {
            if prices[n] < least.price {
                *least = Least { price: prices[n], c: self.m - 1 - (here + n) };
            }
        }
    }

    /// Looks at the triangle a, c, b, whose entry (c, b) is at this place of its column.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn look_at(
        &self,
        a: usize,
        c: usize,
        b: usize,
        at: usize,
        side: Side,
        row: &Row,
        least: &mut Least,
    ) {
        let column = &self.columns[b];
        let sum = row.prices[self.m - 1 - c] + column.prices[at];
        if sum < least.price {
            let spread = self.m - 1 - c;
            let from = Vec3::from_array([0, 1, 2].map(|axis| row.means[axis][spread]));
            let to = Vec3::from_array([0, 1, 2].map(|axis| column.means[axis][at]));
            let means = [from, to, side.mean];
            let price = sum + self.terms.prices.triangle([a, c, b], means);
            if price < least.price {
                *least = Least { price, c };
            }
        }
    }

    /// The answer; `None` if there is none up to the bound.
    pub(super) fn solved(&self) -> Option<Solved> {
        let root = self.place(0, self.m - 1)?;
        let mut triangles = Vec::with_capacity(self.m - 2);
        let mut parts = vec![(0, self.m - 1)];
        while let Some((i, j)) = parts.pop() {
            if j - i < 2 {
                continue;
            }
            let k = self.chosen(i, j)?;
            triangles.push([i, k, j]);
            parts.extend([(i, k), (k, j)]);
        }
        Some(Solved { price: self.prices[root], triangles })
    }

    /// The k of E(i,j), by the rule for equals of the dense table.
    fn chosen(&self, i: usize, j: usize) -> Option<usize> {
        let mean = |i: usize, j: usize| self.terms.side(i, j).mean;
        let own = mean(i, j);
        let mut chosen: Option<(f64, f64, usize)> = None;
        for at in self.entries[i].clone() {
            let k = self.to[at] as usize;
            if k >= j {
                break;
            }
            let Some(other) = self.place(k, j) else { continue };
            let sum = self.prices[at] + self.prices[other];
            if chosen.is_some_and(|(least, ..)| sum > least) {
                continue;
            }
            let fold = if self.folds {
                let means = [mean(i, k), mean(k, j), own];
                self.terms.prices.triangle([i, k, j], means)
            } else {
                0.0
            };
            let key = (sum + fold, self.terms.prices.detour(i, k, j), k);
            if chosen.is_none_or(|least| (key.0, key.1) < (least.0, least.1)) {
                chosen = Some(key);
            }
        }
        chosen.map(|(.., k)| k)
    }

    /// The place of the entry (a, b).
    fn place(&self, a: usize, b: usize) -> Option<usize> {
        let row = self.entries[a].clone();
        self.to[row.clone()].binary_search(&(b as u32)).ok().map(|n| row.start + n)
    }
}

impl Column {
    /// The place of the entry that is so far from the last sample.
    fn place(&self, from: usize) -> Option<usize> {
        let n = self.runs.partition_point(|(first, _)| *first <= from);
        let (first, run) = self.runs.get(n.checked_sub(1)?)?;
        (from - first < run.len()).then(|| run.start + from - first)
    }
}
