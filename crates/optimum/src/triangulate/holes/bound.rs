//! A lower bound on the price of all triangulations of a domain.
//!
//! A triangulation is a set of triangles such that every edge of the boundary has one, and every
//! rung as many on one side as on the other. Let each rung move the same amount of the price of
//! every triangle on one of its sides to every triangle on the other, and let each edge of the
//! boundary take an amount off its triangles. While no remaining price is negative, the sum of the
//! amounts that the edges have taken is a lower bound on the price of every triangulation (the dual
//! of the linear relaxation; the ascent is that of message passing, \[Kolmogorov2006\]).
//!
//! 1. Only triangles count that can belong to a triangulation cheaper than the one that is known.
//! 2. The loops are cut into one chain along rungs of that triangulation. In the order of the table
//!    of equation (5), short runs first, each rung moves the least remaining price on its inner
//!    side to its outer side. Moved whole, one sweep evaluates equation (5), and on a simple
//!    polygon the whole price of the optimum arrives at the last edge. Rungs that cross a cut move
//!    theirs, too.
//! 3. Sweeps back and forth correct the effect of the cuts; then moving only a part works better.
//!    The bound never falls.
//! 4. A triangle whose remaining price exceeds the gap belongs to no cheaper triangulation and is
//!    dropped.
//! 5. Every triangulation has the same number of triangles, so the same amount may be taken off all
//!    of them. Without a plane that is needed: a lid over each hole, with the panel closed behind
//!    it, has fewer triangles.
//!
//! All prices are whole numbers of half quanta, so that the bound is exact.

use super::super::{BARRED, EDGE, Solved, TriangulateError};
use super::chains::Chains;
use super::work::{SIDE, TRIANGLE};
use crate::cost::QUANTUM;
use sheetwright_geometry::predicate::orientation;
use sheetwright_geometry::watch::Watch;
use std::cmp::Ordering;
use std::ops::Range;

/// No side.
const NONE: u32 = u32::MAX;
/// The remaining price of dropped triangles.
const DROPPED: i64 = i64::MAX;
/// Limit of the triangles, 50 bytes each.
const MOST_TRIANGLES: usize = 20_000_000;

/// Memory of the tables of m samples, bytes.
pub(super) fn memory_needed(m: usize) -> u64 {
    // The number of every pair, the sides, and the triangles with their places in lists.
    let pairs = (m as u64) * (m as u64);
    let triangles = (pairs * m as u64 / 3).min(MOST_TRIANGLES as u64);
    pairs * 48 + triangles * 50
}

/// A price in half quanta.
pub(super) fn units(price: f64) -> i64 {
    2 * (price / QUANTUM) as i64
}

/// The price of so many half quanta.
pub(super) fn price_of(units: i64) -> f64 {
    0.5 * units as f64 * QUANTUM
}

/// A side of triangles: a rung or an edge of the boundary.
#[derive(Clone)]
struct Side {
    is_edge: bool,
    /// The triangles to its left, walked from the lower sample to the higher, and to its right, by
    /// their places in the lists.
    triangles: [Range<usize>; 2],
}

/// A direction in which a side is walked: twice the number of the side, plus one from high to low.
type Way = u32;

/// The triangles that may belong to a cheaper triangulation, and their sides.
#[derive(Clone)]
pub(super) struct Relaxation {
    pub(super) corners: Vec<[u32; 3]>,
    /// The ways in which the triangle walks its sides, from each corner to the next.
    pub(super) ways: Vec<[Way; 3]>,
    /// The price of each triangle with half of its rungs', in half quanta.
    pub(super) prices: Vec<i64>,
    sides: Vec<Side>,
    lists: Vec<u32>,
    /// The ways of the rungs on which the inner side has its triangles, in the order of the sweep.
    order: Vec<Way>,
    /// The ways along the boundary.
    edges: Vec<Way>,
    /// The price to fall below, in half quanta.
    pub(super) limit: i64,
}

/// The remaining prices, and the sum that the edges have taken.
#[derive(Clone)]
pub(super) struct Left {
    of_triangles: Vec<i64>,
    /// What the edges have taken, in half quanta.
    pub(super) bound: i64,
    /// Triangles read in the last sweep.
    pub(super) looked: u64,
}

impl Relaxation {
    /// The relaxation of a domain of which `best` is a triangulation; `None` if it has too many
    /// triangles, or more than there is work left for. `chain` is the chain that remains when
    /// `best` is cut open.
    pub(super) fn new(
        chains: &Chains<'_>,
        chain: &[usize],
        best: &Solved,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>, TriangulateError> {
        let m = chains.terms.prices.len();
        let limit = units(best.price);
        let mut number = vec![NONE; m * m];
        let mut later: Vec<Vec<usize>> = vec![Vec::new(); m];
        let mut found = Vec::new();
        chains.work.count(SIDE * (m as u64).pow(2) / 2);
        for a in 0..m {
            for b in a + 1..m {
                let is_edge = chains.terms.prices.neighbours(a, b);
                let side = if is_edge { EDGE } else { chains.terms.side(a, b) };
                if side.price <= best.price && side.price < BARRED.price {
                    number[a * m + b] = found.len() as u32;
                    number[b * m + a] = found.len() as u32;
                    found.push(([a, b], is_edge, units(side.price) / 2, side.mean));
                    later[a].push(b);
                }
            }
        }
        let way = |a: usize, b: usize| 2 * number[a * m + b] + u32::from(a > b);
        let on_loops = Loops::new(chains);
        let mut relaxation = Self {
            corners: Vec::new(),
            ways: Vec::new(),
            prices: Vec::new(),
            sides: Vec::new(),
            lists: Vec::new(),
            order: order(chain, m, found.iter().map(|&(ends, is_edge, ..)| (ends, is_edge))),
            edges: Vec::new(),
            limit,
        };
        for a in 0..m {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            for (n, &b) in later[a].iter().enumerate() {
                if relaxation.corners.len() > MOST_TRIANGLES || chains.work.is_out() {
                    return Ok(None);
                }
                let (others, before) = (later[a].len() - n, relaxation.corners.len());
                for &c in &later[a][n + 1..] {
                    if number[b * m + c] == NONE {
                        continue;
                    }
                    for corners in [[a, b, c], [a, c, b]] {
                        let [i, k, j] = corners;
                        let ways = [way(i, k), way(k, j), way(j, i)];
                        let of = [ways[0], ways[1], ways[2]].map(|w| &found[w as usize / 2]);
                        let twist = of[0].2 + of[1].2 + of[2].2;
                        if twist >= limit || !on_loops.admit(corners) {
                            continue;
                        }
                        let fold = chains.fold(corners, of.map(|side| side.3));
                        let price = twist + units(fold);
                        if price < limit && lies_in_domain(chains, corners) {
                            relaxation.corners.push(corners.map(|sample| sample as u32));
                            relaxation.ways.push(ways);
                            relaxation.prices.push(price);
                        }
                    }
                }
                let new = relaxation.corners.len() - before;
                chains.work.count(others as u64 + TRIANGLE * new as u64);
            }
        }
        relaxation.sides = found
            .iter()
            .map(|&(_, is_edge, ..)| Side { is_edge, triangles: [0..0, 0..0] })
            .collect();
        for list in &chains.chains {
            let next = list.iter().cycle().skip(1);
            relaxation.edges.extend(list.iter().zip(next).map(|(&a, &b)| way(a, b)));
        }
        relaxation.list();
        Ok(Some(relaxation))
    }

    /// Lists the triangles by their ways.
    fn list(&mut self) {
        let mut count = vec![0usize; 2 * self.sides.len()];
        for &way in self.ways.iter().flatten() {
            count[way as usize] += 1;
        }
        let mut at = 0;
        for (side, count) in self.sides.iter_mut().zip(count.as_chunks::<2>().0) {
            side.triangles = [at..at + count[0], at + count[0]..at + count[0] + count[1]];
            at += count[0] + count[1];
        }
        self.lists = vec![0; at];
        let mut next: Vec<usize> =
            self.sides.iter().flat_map(|side| side.triangles.clone().map(|t| t.start)).collect();
        for (t, ways) in self.ways.iter().enumerate() {
            for &way in ways {
                self.lists[next[way as usize]] = t as u32;
                next[way as usize] += 1;
            }
        }
    }

    /// The triangles that walk a side in one way.
    pub(super) fn on(&self, way: Way) -> &[u32] {
        &self.lists[self.sides[way as usize / 2].triangles[way as usize % 2].clone()]
    }

    pub(super) fn is_edge(&self, way: Way) -> bool {
        self.sides[way as usize / 2].is_edge
    }

    /// The ways along the boundary.
    pub(super) fn edges(&self) -> &[Way] {
        &self.edges
    }

    /// Nothing moved or taken yet.
    pub(super) fn whole(&self) -> Left {
        Left { of_triangles: self.prices.clone(), bound: 0, looked: 0 }
    }

    /// Only the triangles that are not dropped.
    pub(super) fn without_dropped(&self, left: &Left) -> (Self, Left) {
        let kept: Vec<usize> =
            (0..self.corners.len()).filter(|&t| left.of_triangles[t] != DROPPED).collect();
        let mut small = Self {
            corners: kept.iter().map(|&t| self.corners[t]).collect(),
            ways: kept.iter().map(|&t| self.ways[t]).collect(),
            prices: kept.iter().map(|&t| self.prices[t]).collect(),
            sides: self.sides.clone(),
            lists: Vec::new(),
            order: Vec::new(),
            edges: self.edges.clone(),
            limit: self.limit,
        };
        small.list();
        let of_triangles = kept.iter().map(|&t| left.of_triangles[t]).collect();
        let used = |way: &Way| !small.on(*way).is_empty() || !small.on(*way ^ 1).is_empty();
        small.order = self.order.iter().copied().filter(used).collect();
        (small, Left { of_triangles, ..left.clone() })
    }
}

impl Left {
    pub(super) fn is_dropped(&self, triangle: u32) -> bool {
        self.of_triangles[triangle as usize] == DROPPED
    }

    /// The remaining price of a triangle.
    pub(super) fn with(&self, triangle: u32) -> i64 {
        self.of_triangles[triangle as usize]
    }

    /// Whether no remaining price is negative, so that the bound is valid.
    pub(super) fn is_bound(&self) -> bool {
        self.of_triangles.iter().all(|&left| left >= 0)
    }

    /// How many triangles are not dropped.
    pub(super) fn triangles(&self) -> usize {
        self.of_triangles.iter().filter(|&&left| left != DROPPED).count()
    }

    pub(super) fn drop_triangle(&mut self, triangle: u32) {
        self.of_triangles[triangle as usize] = DROPPED;
    }

    fn least(&mut self, list: &[u32]) -> i64 {
        self.looked += list.len() as u64;
        list.iter().map(|&t| self.of_triangles[t as usize]).min().unwrap_or(DROPPED)
    }

    fn add(&mut self, list: &[u32], amount: i64) {
        for &t in list {
            let left = &mut self.of_triangles[t as usize];
            if *left != DROPPED {
                *left += amount;
            }
        }
    }

    /// Takes `amount` off every triangle, of which every triangulation has `count`. Remaining
    /// prices may become negative; the bound is invalid until sweeps have made up for that.
    pub(super) fn take(&mut self, amount: i64, count: usize) {
        for left in &mut self.of_triangles {
            *left -= amount;
        }
        self.bound += amount * count as i64;
    }

    /// One sweep, after which triangles are dropped; false if none below the limit is left. A rung
    /// moves `share` sixteenths of the difference.
    pub(super) fn sweep(&mut self, relaxation: &Relaxation, forwards: bool, share: i64) -> bool {
        // All are looked at once more at the end.
        self.looked = self.of_triangles.len() as u64;
        let moved = relaxation.order.len();
        for n in 0..moved {
            let inner = relaxation.order[if forwards { n } else { moved - 1 - n }];
            let from = if forwards { inner } else { inner ^ 1 };
            let (from, to) = (relaxation.on(from), relaxation.on(from ^ 1));
            match (self.least(from), self.least(to)) {
                (DROPPED, DROPPED) => {}
                // Nothing is left on one side, so nothing can be used on the other.
                (DROPPED, _) => to.iter().for_each(|&t| self.drop_triangle(t)),
                (_, DROPPED) => from.iter().for_each(|&t| self.drop_triangle(t)),
                (has, other) => {
                    let amount = has - (has + other) * (16 - share) / 16;
                    if amount != 0 {
                        self.add(from, -amount);
                        self.add(to, amount);
                    }
                }
            }
        }
        for &edge in &relaxation.edges {
            let least = self.least(relaxation.on(edge));
            if least == DROPPED {
                return false;
            }
            self.bound += least;
            self.add(relaxation.on(edge), -least);
        }
        if !self.is_bound() {
            return true;
        }
        for left in &mut self.of_triangles {
            if *left != DROPPED && *left + self.bound >= relaxation.limit {
                *left = DROPPED;
            }
        }
        self.bound < relaxation.limit
    }
}

/// The ways of the rungs on which their inner sides lie, in the order of the table over a chain:
/// short runs first. `sides` are the ends of all sides and whether they are edges.
fn order(chain: &[usize], m: usize, sides: impl Iterator<Item = ([usize; 2], bool)>) -> Vec<Way> {
    let mut places: Vec<Vec<usize>> = vec![Vec::new(); m];
    for (at, &sample) in chain.iter().enumerate() {
        places[sample].push(at);
    }
    let mut keyed: Vec<((usize, usize), Way)> = Vec::new();
    for (n, ([a, b], is_edge)) in sides.enumerate() {
        let pairs = places[a].iter().flat_map(|&p| places[b].iter().map(move |&q| (p, q)));
        if let (false, Some((p, q))) = (is_edge, pairs.min_by_key(|&(p, q)| (p.abs_diff(q), p))) {
            // A triangle over the run from p to q walks its rung back from q to p.
            let way = 2 * n as u32 + u32::from(p < q);
            keyed.push(((p.abs_diff(q), p.min(q)), way));
        }
    }
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, way)| way).collect()
}

/// The loop of each sample, and the sample that follows it.
struct Loops {
    of_sample: Vec<usize>,
    after: Vec<usize>,
}

impl Loops {
    fn new(chains: &Chains<'_>) -> Self {
        let m = chains.terms.prices.len();
        let mut loops = Self { of_sample: vec![0; m], after: vec![0; m] };
        for (number, list) in chains.chains.iter().enumerate() {
            for (&sample, &next) in list.iter().zip(list.iter().cycle().skip(1)) {
                loops.of_sample[sample] = number;
                loops.after[sample] = next;
            }
        }
        loops
    }

    /// Whether a triangle walks no edge of the boundary backwards and, on one loop, runs with it.
    fn admit(&self, corners: [usize; 3]) -> bool {
        let [i, k, j] = corners;
        let backwards = |a: usize, b: usize| self.after[b] == a;
        let [on_i, on_k, on_j] = corners.map(|sample| self.of_sample[sample]);
        // The first corner is the lowest, and samples of a loop are numbered in its direction.
        let with_loop = on_i != on_k || on_k != on_j || k < j;
        with_loop && !backwards(i, k) && !backwards(k, j) && !backwards(j, i)
    }
}

/// Whether a triangle between samples that see one another lies in the domain: counter-clockwise on
/// the plane, and without a hole inside.
fn lies_in_domain(chains: &Chains<'_>, corners: [usize; 3]) -> bool {
    let [Some(a), Some(b), Some(c)] = corners.map(|sample| chains.point(sample)) else {
        return true;
    };
    if orientation(a, b, c) != Ordering::Greater {
        return false;
    }
    let inside = |sample: usize| {
        let left = |from, to| {
            chains.point(sample).is_some_and(|p| orientation(from, to, p) != Ordering::Less)
        };
        left(a, b) && left(b, c) && left(c, a)
    };
    // A hole lies inside or outside as a whole, but for the corners that it may have in common.
    chains.chains[1..].iter().all(|hole| {
        let free = hole.iter().find(|sample| !corners.contains(sample));
        !free.is_some_and(|&sample| inside(sample))
    })
}
