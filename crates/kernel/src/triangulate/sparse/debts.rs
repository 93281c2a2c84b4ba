//! What the edges of the boundary ask for, and who owes it.
//!
//! 1. Each edge asks for what it is paid in the triangulation that is known: the price of its
//!    triangle, with half the price of each of its rungs, shared between its edges.
//! 2. A triangle pays its price, with half of its rungs', towards what its inner sides ask for. What
//!    it lacks, at most, over all triangles below a rung, is the debt of that rung: what the rung
//!    asks of the triangle on its outer side. What it pays too much is lost.
//! 3. So every triangle pays at least what its inner sides ask for less the debt it passes on, and
//!    every triangulation at least what the edges ask for less the debt of the last edge. That is
//!    the bound.
//! 4. What is inside a rung of a good triangulation may exceed what is asked and not owed there by
//!    no more than U exceeds the bound, since outside of it no triangle pays too little.
//!
//! Only triangles count whose rungs may be part of good triangulations. Debts are few where the
//! bound is good: a rung has one only if one of the inner sides of a triangle below it has one, and
//! if the triangle's rungs are cheap. So they are found from the edges on, by looking at each side
//! with a debt for the samples to which it has cheap rungs. In another surface through the same
//! boundary, which is cheaper here and dearer there, debts pile up; then the search is given up.

use super::super::{BARRED, Side, Solved, Terms, TriangulateError};
use super::blocks::Blocks;
use super::sweep::{Alive, Rows};
use crate::cost::QUANTUM;
use crate::watch::Watch;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Rungs up to so many times what an edge asks for in the mean are listed for each sample.
const SHORT: f64 = 128.0;
/// The search is given up with more debts than this for every sample that was looked at,
const MOST_DEBTS: usize = 24;
/// or more rungs that had to be priced,
const MOST_PRICED: usize = 4000;
/// over this many samples more than there were.
const HEAD_START: usize = 100;

/// What is asked for and owed, in half quanta, so that all sums are exact.
pub(super) struct Debts {
    /// What the edges before each sample ask for, together.
    asked: Vec<f64>,
    rows: Rows,
    debts: Vec<f64>,
    sides: Vec<Side>,
    /// No triangulation is cheaper, unless it has rungs that were ruled out.
    pub(super) bound: f64,
}

/// A rung or an edge of the boundary that has a debt.
#[derive(Clone, Copy)]
struct Debtor {
    ends: [usize; 2],
    debt: f64,
    side: Side,
}

/// The row that is being worked out, by second sample.
struct Row {
    /// The debt so far.
    debts: Vec<f64>,
    /// The rung, once something was found for it.
    sides: Vec<Option<Side>>,
    /// The samples with something of either.
    touched: Vec<usize>,
    /// The samples with debts to come.
    queue: BinaryHeap<Reverse<usize>>,
}

impl Debts {
    /// What the edges ask for that are paid in a known triangulation, and the debts for it; `None`
    /// if they are too many.
    pub(super) fn new(
        terms: &Terms<'_>,
        blocks: &Blocks,
        alive: &Alive,
        known: &Solved,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>, TriangulateError> {
        let m = terms.prices.len();
        let asks = asks(terms, known);
        let mut asked = vec![0.0; m];
        for i in 1..m {
            asked[i] = asked[i - 1] + asks[i - 1];
        }
        let mut near = Near::new(terms, blocks, alive, SHORT * asked[m - 1] / m as f64);
        let mut debts =
            Self { asked, rows: Rows::new(m), debts: Vec::new(), sides: Vec::new(), bound: 0.0 };
        let mut row = Row {
            debts: vec![0.0; m],
            sides: vec![None; m],
            touched: Vec::new(),
            queue: BinaryHeap::new(),
        };
        // Debts found from the upper of their inner sides, by their first sample.
        let mut pending: Vec<Vec<(usize, f64)>> = vec![Vec::new(); m];
        for a in (0..m - 1).rev() {
            if a % 64 == 0 && watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let done = m - a + HEAD_START;
            if debts.debts.len() > MOST_DEBTS * done || near.priced > MOST_PRICED * done {
                return Ok(None);
            }
            row.owe(a + 1, asks[a]);
            row.know(a + 1, super::super::EDGE);
            for (b, debt) in std::mem::take(&mut pending[a]) {
                row.owe(b, debt);
            }
            debts.rows.begin(a);
            while let Some(Reverse(c)) = row.queue.pop() {
                let debt = std::mem::take(&mut row.debts[c]);
                if debt > 0.0 && !(a == 0 && c + 1 == m) {
                    let side = row.side(c, || terms.side(a, c));
                    let debtor = Debtor { ends: [a, c], debt, side };
                    debts.add(&debtor);
                    debts.pass_on(terms, &near, &debtor, &mut row);
                    near.look(&debtor, |near, o, from, to| {
                        let lack = lack(terms, &debtor, o, from, to);
                        if lack > 0.0 && o < a && near.contains(o, a) && near.contains(o, c) {
                            pending[o].push((c, lack));
                        } else if lack > 0.0 && o > c && near.contains(a, o) {
                            row.owe(o, lack);
                            row.know(o, from);
                        }
                    });
                } else if debt > 0.0 {
                    // Of the last edge, which asks for something itself.
                    debts.bound = -debt;
                }
            }
            row.clear();
        }
        debts.bound += debts.asked[m - 1];
        Ok(Some(debts))
    }

    fn add(&mut self, debtor: &Debtor) {
        let [a, c] = debtor.ends;
        self.rows.push(a, c);
        self.debts.push(debtor.debt);
        self.sides.push(debtor.side);
    }

    /// What triangles lack that have a debtor and another one, beyond it, as their inner sides.
    fn pass_on(&self, terms: &Terms<'_>, near: &Near<'_>, debtor: &Debtor, row: &mut Row) {
        let [a, c] = debtor.ends;
        for at in self.rows.entries(c) {
            let (b, other) = (self.rows.second(at), self.sides[at]);
            let asked = debtor.debt + self.debts[at] - 0.5 * (debtor.side.price + other.price);
            if asked <= 0.0 {
                continue;
            }
            let is_open = || near.contains(a, b);
            let own = row.side(b, || if is_open() { terms.side(a, b) } else { BARRED });
            let mut lack = asked - 0.5 * own.price;
            if lack > 0.0 {
                lack -= terms.fold([a, c, b], [debtor.side.mean, other.mean, own.mean]);
            }
            if lack > 0.0 {
                row.owe(b, lack);
            }
        }
    }

    /// What the edges from sample a to sample b ask for.
    pub(super) fn asked(&self, a: usize, b: usize) -> f64 {
        self.asked[b] - self.asked[a]
    }

    /// The debts of the rungs from a, with their second samples.
    pub(super) fn row(&self, a: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.rows.entries(a).map(|at| (self.rows.second(at), self.debts[at]))
    }
}

impl Row {
    /// The rung to sample b owes at least so much.
    fn owe(&mut self, b: usize, debt: f64) {
        if debt > self.debts[b] {
            if self.debts[b] == 0.0 {
                self.queue.push(Reverse(b));
                self.touched.push(b);
            }
            self.debts[b] = debt;
        }
    }

    fn know(&mut self, b: usize, side: Side) {
        self.side(b, || side);
    }

    fn side(&mut self, b: usize, side: impl FnOnce() -> Side) -> Side {
        let touched = &mut self.touched;
        *self.sides[b].get_or_insert_with(|| {
            touched.push(b);
            side()
        })
    }

    fn clear(&mut self) {
        for b in self.touched.drain(..) {
            self.sides[b] = None;
            self.debts[b] = 0.0;
        }
    }
}

/// What the triangle of a debtor and sample `o` lacks, if its other inner side owes nothing. `from`
/// and `to` are its sides from `o` to the lower and the upper end of the debtor.
fn lack(terms: &Terms<'_>, debtor: &Debtor, o: usize, from: Side, to: Side) -> f64 {
    let ([a, c], side) = (debtor.ends, debtor.side);
    let lack = debtor.debt - 0.5 * (side.price + from.price + to.price);
    if lack <= 0.0 {
        return lack;
    }
    let (corners, means) = if o < a {
        ([o, a, c], [from.mean, side.mean, to.mean])
    } else {
        ([a, c, o], [side.mean, to.mean, from.mean])
    };
    lack - terms.fold(corners, means)
}

/// What each edge is paid: the price of its triangle with half of its rungs', shared with the other
/// edges of the triangle. The last edge runs from the last sample to the first; it asks for nothing
/// here, as nothing lies outside of it.
fn asks(terms: &Terms<'_>, known: &Solved) -> Vec<f64> {
    let mut asks = vec![0.0; terms.prices.len()];
    for &[i, k, j] in &known.triangles {
        let sides = [terms.side(i, k), terms.side(k, j), terms.side(i, j)];
        let twist: f64 = sides.iter().map(|side| side.price).sum();
        let price = 0.5 * twist + terms.fold([i, k, j], sides.map(|side| side.mean));
        let edges = [(k == i + 1, i), (j == k + 1, k)];
        let count = edges.iter().filter(|(is_edge, _)| *is_edge).count();
        for (_, edge) in edges.iter().filter(|(is_edge, _)| *is_edge) {
            // Rounded down to whole quanta.
            asks[*edge] = (price / count as f64 / QUANTUM).floor() * QUANTUM;
        }
    }
    asks
}

/// Who may be joined with whom.
struct Near<'a> {
    terms: &'a Terms<'a>,
    blocks: &'a Blocks,
    alive: &'a Alive,
    /// The block of each sample.
    of: Vec<u32>,
    /// The blocks that each may be joined with, itself and its neighbours included, and what no
    /// rung costs less than.
    to: Vec<Vec<(u32, f32)>>,
    /// What a listed rung costs less than.
    short: f64,
    /// The samples that each may be joined with for less than that, in increasing order, and what
    /// the rung costs, rounded down; once they were asked for.
    lists: Vec<Option<Vec<(u32, f32)>>>,
    /// How many rungs were priced.
    priced: usize,
}

impl<'a> Near<'a> {
    fn new(terms: &'a Terms<'a>, blocks: &'a Blocks, alive: &'a Alive, short: f64) -> Self {
        let (n, m) = (blocks.len(), terms.prices.len());
        let beside = |a: usize| [a + n - 1, a, a + 1].map(|b| ((b % n) as u32, 0.0));
        let mut to: Vec<Vec<(u32, f32)>> = (0..n).map(|a| beside(a).to_vec()).collect();
        for a in 0..n {
            for (b, least) in alive.row(a) {
                to[a].push((b as u32, least));
                to[b].push((a as u32, least));
            }
        }
        let (of, lists) = (blocks.of_samples(m), vec![None; m]);
        Self { terms, blocks, alive, of, to, short, lists, priced: 0 }
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        self.alive.contains(self.of[i] as usize, self.of[j] as usize)
    }

    fn side(&self, i: usize, j: usize) -> Side {
        self.terms.side(i.min(j), i.max(j))
    }

    /// Makes the list of a sample.
    fn list(&mut self, x: usize) {
        if self.lists[x].is_some() {
            return;
        }
        let mut list: Vec<(u32, f32)> = Vec::new();
        for &(other, least) in &self.to[self.of[x] as usize] {
            if f64::from(least) < self.short {
                let samples = self.blocks.samples(other as usize).filter(|&o| o != x);
                self.priced += samples.clone().count();
                let priced = samples.map(|o| (o as u32, self.side(o, x).price));
                let short = priced.filter(|(_, price)| *price < self.short);
                list.extend(short.map(|(o, price)| (o, price as f32 * (1.0 - 1e-6))));
            }
        }
        list.sort_unstable_by_key(|&(o, _)| o);
        list.dedup_by_key(|&mut (o, _)| o);
        self.lists[x] = Some(list);
    }

    /// Looks at all samples outside a debtor that have two rungs to it that, together and with half
    /// its own, cost less than twice its debt: calls with the sample and the sides to the lower and
    /// the upper end.
    fn look(&mut self, debtor: &Debtor, mut found: impl FnMut(&Self, usize, Side, Side)) {
        let [x, y] = debtor.ends;
        let room = 2.0 * debtor.debt - debtor.side.price;
        if room <= self.short {
            self.list(x);
            self.list(y);
            let (Some(one), Some(other)) = (&self.lists[x], &self.lists[y]) else { return };
            let mut rest = other.iter().peekable();
            for &(o, from) in one {
                while rest.next_if(|(p, _)| *p < o).is_some() {}
                let to = rest.peek().filter(|(p, _)| *p == o).map(|(_, to)| *to);
                let is_cheap = to.is_some_and(|to| f64::from(from) + f64::from(to) < room);
                let o = o as usize;
                if is_cheap && !(x..=y).contains(&o) {
                    found(self, o, self.side(o, x), self.side(o, y));
                }
            }
            return;
        }
        let mut priced = 0;
        for &(other, least) in &self.to[self.of[x] as usize] {
            if f64::from(least) >= room {
                continue;
            }
            for o in self.blocks.samples(other as usize).filter(|o| !(x..=y).contains(o)) {
                priced += 1;
                let from = self.side(o, x);
                if from.price < room {
                    let to = self.side(o, y);
                    if from.price + to.price < room {
                        found(self, o, from, to);
                    }
                }
            }
        }
        self.priced += priced;
    }
}
