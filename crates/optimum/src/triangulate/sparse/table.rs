//! The table of equation (5) over a list of rungs.
//!
//! What is kept of a rung is q = s + ½ w, with s the surplus of its inner side (what its triangles
//! pay beyond what its edges ask for) and w its own price. A triangle pays half of the prices of
//! its sides and its folds, so that s(a,b) = ½ w(a,b) + min over c of q(a,c) + q(c,b) + F(a,c,b).
//!
//! Rows are filled from the last to the first. Row a is worked out from left to right: once q(a,c)
//! is known, row c is run through for all b beyond c at once, several side by side. Surpluses count
//! only up to a limit, so that one of q(a,c) and q(c,b) must be below half of it: if q(a,c) is not,
//! only the few b are looked at for which q(c,b) is. F is worked out only where the sum alone does
//! not reach what was found so far; most often the first c, a + 1, has found the least.

use super::super::{EDGE, Side, Terms, TriangulateError};
use super::Budget;
use super::asks::HALF;
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;
use std::ops::Range;

/// How many sums are compared at once.
const LANES: usize = 8;
/// What the bound of F may lose to rounding and to the quantum: far more than ν · 2⁻⁴⁹.
const SLACK: f64 = 1e-12;
/// What a fold price counts as work.
const A_FOLD: u64 = 8;
/// What an entry takes at least, bytes: in its row, in the list that it comes from, among those
/// that are low; and N.
const BYTES_AN_ENTRY: usize = 12 + 8 + 4;
const BYTES_A_MEAN: usize = 24;

/// What a table is worked out for.
pub(super) enum Aim<'a> {
    /// The cheapest triangulation among the rungs listed, if one costs no more than this. Edges ask
    /// for nothing.
    Among(f64),
    /// The cheapest triangulation of all: see [`super`].
    Proof(&'a Proof),
}

impl Budget {
    /// How many rungs a table may have.
    pub(super) fn most_rungs(&self, terms: &Terms<'_>) -> u64 {
        let mean = if terms.folds() { BYTES_A_MEAN } else { 0 };
        (self.memory / (BYTES_AN_ENTRY + mean) as u64).min(u32::MAX.into())
    }
}

/// What the edges ask for, and what may be owed.
pub(super) struct Proof {
    /// What the edges before each sample ask for, together.
    asked: Vec<f64>,
    /// The most that sides of each sample may owe.
    pub(super) owed: Vec<f64>,
    /// Surpluses count up to this, if what is not listed allows.
    surplus: f64,
}

impl Proof {
    pub(super) fn new(asks: &[f64], owed: Vec<f64>, surplus: f64) -> Self {
        let mut asked = vec![0.0; asks.len()];
        for i in 1..asks.len() {
            asked[i] = asked[i - 1] + asks[i - 1];
        }
        Self { asked, owed, surplus }
    }

    /// Surpluses of the rung (a, b) count up to this: no triangle with a side that is not listed
    /// leaves less.
    fn most(&self, a: usize, b: usize) -> f64 {
        self.owed[a].min(self.owed[b]).min(self.surplus) + HALF
    }

    /// What the edges from sample a to sample b ask for.
    fn asked(&self, a: usize, b: usize) -> f64 {
        self.asked[b] - self.asked[a]
    }
}

pub(super) struct Table<'a> {
    terms: &'a Terms<'a>,
    m: usize,
    folds: bool,
    aim: Aim<'a>,
    /// The entries of the rows.
    entries: Vec<Range<usize>>,
    /// The second sample, q, and N by axis where folds cost something.
    to: Vec<u32>,
    prices: Vec<f64>,
    means: [Vec<f64>; 3],
    /// The runs of entries of each row that follow one another.
    runs_of: Vec<Range<usize>>,
    runs: Vec<Range<usize>>,
    /// The places of the entries of each row that are low.
    lows_of: Vec<Range<usize>>,
    lows: Vec<u32>,
    /// Of every two sides of a triangle that matters, one has a q below this.
    low: f64,
    /// A sixth of the weight of folds: a fold price is at least that times the square of how far
    /// the N are from adding up to 3, since no unit n makes Σ (1 − n·N) less than 3 − |Σ N|.
    sixth: f64,
    /// The most that sides of each sample owe.
    pub(super) owed: Vec<f64>,
    /// How many sums were compared, each fold price counted as so many.
    pub(super) work: u64,
}

/// The row that is being filled, spread out by second samples.
struct Row {
    /// Nothing up to this sample can be less than it is.
    settled: usize,
    /// What q(a,c) + q(c,b) + F must be less than: the least so far, or what makes the surplus
    /// count; −∞ where no rung is listed.
    limits: Vec<f64>,
    means: [Vec<f64>; 3],
}

/// A rung that is listed.
struct Listed {
    b: usize,
    side: Side,
    /// Its limit to begin with.
    limit: f64,
}

/// A row to be filled. A type rather than a closure, so that it is compiled for the widest
/// registers.
struct Filling<'f, 'a> {
    table: &'f mut Table<'a>,
    a: usize,
    listed: &'f [Listed],
    row: &'f mut Row,
}

impl pulp::WithSimd for Filling<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.table.fill_row(self.a, self.listed, self.row);
    }
}

impl<'a> Table<'a> {
    /// Fills the table with the rungs that are listed for each sample, the second ones in
    /// increasing order; `None` if that takes more than the budget.
    pub(super) fn fill(
        terms: &'a Terms<'a>,
        rungs: &[Vec<u32>],
        aim: Aim<'a>,
        budget: &Budget,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>, TriangulateError> {
        let m = terms.prices.len();
        let most = m + rungs.iter().map(Vec::len).sum::<usize>();
        let with_folds = if terms.folds() { most } else { 0 };
        if (most as u64) > budget.most_rungs(terms) {
            return Ok(None);
        }
        let low = match &aim {
            Aim::Among(_) => f64::INFINITY,
            Aim::Proof(proof) => 0.5 * (proof.surplus + HALF),
        };
        let mut table = Self {
            terms,
            m,
            folds: terms.folds(),
            aim,
            entries: vec![0..0; m],
            to: Vec::with_capacity(most),
            prices: Vec::with_capacity(most),
            means: [0, 1, 2].map(|_| Vec::with_capacity(with_folds)),
            runs_of: vec![0..0; m],
            runs: Vec::new(),
            lows_of: vec![0..0; m],
            lows: Vec::new(),
            low,
            sixth: terms.prices.options().fold / 6.0,
            owed: vec![0.0; m],
            work: 0,
        };
        let width = if table.folds { m } else { 0 };
        let mut row = Row {
            settled: 0,
            limits: vec![f64::NEG_INFINITY; m],
            means: [0, 1, 2].map(|_| vec![0.0; width]),
        };
        let registers = pulp::Arch::new();
        let mut listed = Vec::new();
        for a in (0..m - 1).rev() {
            if a % 64 == 0 {
                if watch.stop() {
                    return Err(TriangulateError::Stopped);
                }
                watch.progress(1.0 - a as f64 / m as f64);
            }
            table.list(a, &rungs[a], &mut listed);
            registers.dispatch(Filling { table: &mut table, a, listed: &listed, row: &mut row });
            if table.work > budget.work || table.bytes() > budget.memory {
                return Ok(None);
            }
        }
        Ok(Some(table))
    }

    /// What is taken at the most, when what grows by doubling is next moved.
    fn bytes(&self) -> u64 {
        let (to, prices) = (size_of::<u32>(), size_of::<f64>());
        let of_entries = self.to.capacity() * (to + prices) + 3 * prices * self.means[0].capacity();
        let lows = 3 * to * self.lows.capacity();
        let runs = 3 * size_of::<Range<usize>>() * self.runs.capacity();
        (of_entries + lows + runs) as u64
    }

    /// What the edges from sample a to sample b ask for.
    fn asked(&self, a: usize, b: usize) -> f64 {
        match &self.aim {
            Aim::Among(_) => 0.0,
            Aim::Proof(proof) => proof.asked(a, b),
        }
    }

    fn is_root(&self, a: usize, b: usize) -> bool {
        a == 0 && b + 1 == self.m
    }

    /// Prices the rungs of row a.
    fn list(&self, a: usize, rungs: &[u32], listed: &mut Vec<Listed>) {
        listed.clear();
        let second = rungs.iter().map(|&b| b as usize).filter(|&b| !self.is_root(a, b));
        listed.extend(second.map(|b| {
            let side = self.terms.side(a, b);
            let most = match &self.aim {
                Aim::Among(bound) => *bound + HALF,
                Aim::Proof(proof) => proof.most(a, b),
            };
            Listed { b, side, limit: most - 0.5 * side.price }
        }));
        if a == 0 {
            let limit = match &self.aim {
                Aim::Among(bound) => *bound + HALF,
                Aim::Proof(_) => f64::INFINITY,
            };
            listed.push(Listed { b: self.m - 1, side: EDGE, limit });
        }
    }

    /// Fills row a.
    #[inline(always)]
    fn fill_row(&mut self, a: usize, listed: &[Listed], row: &mut Row) {
        for Listed { b, side, limit } in listed {
            row.limits[*b] = *limit;
            if self.folds {
                (0..3).for_each(|axis| row.means[axis][*b] = side.mean[axis]);
            }
        }
        let start = self.to.len();
        self.entries[a] = start..start;
        self.runs_of[a] = self.runs.len()..self.runs.len();
        self.lows_of[a] = self.lows.len()..self.lows.len();
        let ask = self.asked(a, a + 1);
        self.keep(a, a + 1, -ask, EDGE);
        row.settled = a + 1;
        self.run_through(a, a + 1, -ask, EDGE, row);
        // In a flat run, all that follows from the first c costs nothing.
        for Listed { b, .. } in listed {
            if *b > row.settled + 1 || row.limits[*b] > -self.asked(a, *b) {
                break;
            }
            row.settled = *b;
        }
        let is_proof = matches!(self.aim, Aim::Proof(_));
        for Listed { b, side, limit } in listed {
            let least = row.limits[*b];
            if !is_proof && (least == *limit || least == f64::NEG_INFINITY) {
                continue;
            }
            let q = least + side.price;
            self.keep(a, *b, q, *side);
            self.run_through(a, *b, q, *side, row);
        }
        for Listed { b, .. } in listed {
            row.limits[*b] = f64::NEG_INFINITY;
        }
    }

    #[inline(always)]
    fn keep(&mut self, a: usize, b: usize, q: f64, side: Side) {
        let at = self.to.len();
        self.to.push(b as u32);
        self.prices.push(q);
        if self.folds {
            (0..3).for_each(|axis| self.means[axis].push(side.mean[axis]));
        }
        self.entries[a].end = at + 1;
        match self.runs[self.runs_of[a].clone()].last_mut() {
            Some(run) if self.to[run.start] as usize + run.len() == b => run.end += 1,
            _ => {
                self.runs.push(at..at + 1);
                self.runs_of[a].end += 1;
            }
        }
        if !self.is_root(a, b) {
            let debt = 0.5 * side.price - q;
            self.owed[a] = self.owed[a].max(debt);
            self.owed[b] = self.owed[b].max(debt);
        }
        if q < self.low {
            self.lows.push(at as u32);
            self.lows_of[a].end += 1;
        }
    }

    /// Looks at the triangles a, c, b for all b beyond c, q(a,c) being `q`.
    #[inline(always)]
    fn run_through(&mut self, a: usize, c: usize, q: f64, side: Side, row: &mut Row) {
        if q >= self.low {
            for n in self.lows_of[c].clone() {
                self.look_at(a, c, self.lows[n] as usize, q, side, row);
            }
            self.work += self.lows_of[c].len() as u64;
            return;
        }
        for n in self.runs_of[c].clone() {
            let mut run = self.runs[n].clone();
            let settled = (row.settled + 1).saturating_sub(self.to[run.start] as usize);
            run.start += settled.min(run.len());
            if run.is_empty() {
                continue;
            }
            self.work += 1 + run.len() as u64 / 4;
            let first = self.to[run.start] as usize;
            let prices = &self.prices[run.clone()];
            let limits = &mut row.limits[first..first + prices.len()];
            if !self.folds {
                for (limit, price) in limits.iter_mut().zip(prices) {
                    let sum = q + price;
                    *limit = if sum < *limit { sum } else { *limit };
                }
                continue;
            }
            let whole = run.len() / LANES * LANES;
            for n in (0..whole).step_by(LANES) {
                let limits = &row.limits[first + n..first + n + LANES];
                let mut below = false;
                for (limit, price) in limits.iter().zip(&self.prices[run.start + n..][..LANES]) {
                    below |= q + price < *limit;
                }
                if below {
                    (n..n + LANES).for_each(|n| self.look_at(a, c, run.start + n, q, side, row));
                }
            }
            (whole..run.len()).for_each(|n| self.look_at(a, c, run.start + n, q, side, row));
        }
    }

    /// Looks at the triangle of the rung ⟨a,c⟩, whose q is given, and the entry of row c at `at`.
    #[inline(always)]
    fn look_at(&mut self, a: usize, c: usize, at: usize, q: f64, side: Side, row: &mut Row) {
        let b = self.to[at] as usize;
        let mut sum = q + self.prices[at];
        if sum >= row.limits[b] {
            return;
        }
        if self.folds {
            let far = Vec3::from_array([0, 1, 2].map(|axis| self.means[axis][at]));
            let own = Vec3::from_array([0, 1, 2].map(|axis| row.means[axis][b]));
            let total = side.mean + far + own;
            let least = sum + self.sixth * (9.0 - total.length_squared());
            let has_edge = c == a + 1 || b == c + 1 || self.is_root(a, b);
            if !has_edge && least >= row.limits[b] + SLACK {
                return;
            }
            self.work += A_FOLD;
            sum += self.terms.prices.triangle([a, c, b], [side.mean, far, own]);
            if sum >= row.limits[b] {
                return;
            }
        }
        row.limits[b] = sum;
    }

    /// What the triangles pay beyond what the edges ask for, at the least.
    pub(super) fn surplus(&self) -> Option<f64> {
        self.place(0, self.m - 1).map(|root| self.prices[root])
    }

    /// The surplus of the inner side of a rung, as far as it counts; `None` if it is not listed.
    #[cfg(test)]
    pub(super) fn surplus_of(&self, a: usize, b: usize) -> Option<f64> {
        Some(self.prices[self.place(a, b)?] - 0.5 * self.terms.side(a, b).price)
    }

    /// The triangles of the answer; `None` if there is none, or if it may have parts of which only
    /// a bound is known.
    pub(super) fn triangles(&self) -> Option<Vec<[usize; 3]>> {
        self.place(0, self.m - 1)?;
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
        Some(triangles)
    }

    /// The k of E(i,j), by the rule for equals of the dense table.
    fn chosen(&self, i: usize, j: usize) -> Option<usize> {
        let mean = |i: usize, j: usize| self.terms.side(i, j).mean;
        let own = self.terms.side(i, j);
        // Nothing can be less, and all that is as little is known.
        let floor = -self.asked(i, j);
        let mut chosen: Option<(f64, f64, usize)> = None;
        let mut is_known = true;
        for at in self.entries[i].clone() {
            let k = self.to[at] as usize;
            if k >= j {
                break;
            }
            let detour = self.terms.prices.detour(i, k, j);
            if chosen.is_some_and(|(least, way, _)| least == floor && detour >= way) {
                continue;
            }
            let Some(other) = self.place(k, j) else { continue };
            let sum = self.prices[at] + self.prices[other];
            if chosen.is_some_and(|(least, ..)| sum > least) {
                continue;
            }
            let fold = if self.folds {
                let means = [mean(i, k), mean(k, j), own.mean];
                self.terms.prices.triangle([i, k, j], means)
            } else {
                0.0
            };
            let key = (sum + fold, detour, k);
            if chosen.is_none_or(|least| key.0 < least.0) {
                is_known = true;
            }
            if chosen.is_none_or(|least| key.0 <= least.0) {
                is_known &= self.is_known(i, k, at) && self.is_known(k, j, other);
            }
            if chosen.is_none_or(|least| (key.0, key.1) < (least.0, least.1)) {
                chosen = Some(key);
            }
        }
        chosen.filter(|_| is_known).map(|(.., k)| k)
    }

    /// Whether an entry is the least, and not just a bound.
    fn is_known(&self, a: usize, b: usize, at: usize) -> bool {
        match &self.aim {
            Aim::Among(_) => true,
            Aim::Proof(proof) => {
                b == a + 1 || self.prices[at] - 0.5 * self.terms.side(a, b).price < proof.most(a, b)
            }
        }
    }

    /// The place of the entry (a, b).
    fn place(&self, a: usize, b: usize) -> Option<usize> {
        let row = self.entries[a].clone();
        self.to[row.clone()].binary_search(&(b as u32)).ok().map(|n| row.start + n)
    }
}
