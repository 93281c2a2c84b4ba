//! Pockets: the parts of a domain between a run of one chain and the rung that closes it off.
//!
//! The table of equation (5) for every run round a chain. E(s,q) is the least price of the part
//! between the run from s on to q and the rung ⟨s,q⟩, *with* that rung:
//! E(s,q) = w(s,q) + min over k of E(s,k) + E(k,q) + F(s,k,q); 0 for an edge. O(n³) time and O(n²)
//! memory for a chain of n samples.

use super::super::{Side, TriangulateError};
use super::chains::{Chains, Spot};
use crate::cost::QUANTUM;
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;

/// How many sums are compared at once.
const LANES: usize = 8;

/// A chain in the order in which the band is walked.
#[derive(Clone)]
pub(super) struct Walk {
    /// The places on the chain, in the order of the walk.
    pub(super) spots: Vec<Spot>,
    /// The samples there.
    pub(super) samples: Vec<usize>,
    /// Whether the walk runs against the direction of the boundary.
    pub(super) backwards: bool,
}

impl Walk {
    /// The chain from place `start` on, or back.
    pub(super) fn new(chains: &Chains<'_>, chain: usize, start: usize, backwards: bool) -> Self {
        let n = chains.len(chain);
        let spots: Vec<Spot> = (0..n)
            .map(|i| Spot { chain, at: if backwards { start + n - i } else { start + i } % n })
            .collect();
        let samples = spots.iter().map(|&spot| chains.sample(spot)).collect();
        Self { spots, samples, backwards }
    }

    pub(super) fn len(&self) -> usize {
        self.samples.len()
    }

    /// The corners of a triangle over three places that follow one another on the walk, with the
    /// N of its sides (first–second, second–third, first–third), counter-clockwise.
    pub(super) fn oriented(
        &self,
        [a, b, c]: [usize; 3],
        [ab, bc, ac]: [Vec3; 3],
    ) -> ([usize; 3], [Vec3; 3]) {
        if self.backwards { ([c, b, a], [bc, ab, ac]) } else { ([a, b, c], [ab, bc, ac]) }
    }
}

/// E of all runs of a walk.
pub(super) struct Pockets {
    n: usize,
    /// E by start: E(s, s + l) at s · n + l.
    by_start: Vec<f64>,
    /// E by end: E(q − l, q) at q · n + (n − l), so that starts ascend.
    by_end: Vec<f64>,
    /// The N of the side between two places, at s · n + q.
    means: Vec<Vec3>,
    /// Whether all runs are computed: else the long ones have no price, since the work limit ended
    /// the table.
    pub(super) are_all: bool,
}

impl Pockets {
    /// Memory of the tables of a chain, bytes.
    pub(super) fn memory_needed(n: usize) -> u64 {
        let entry = 2 * size_of::<f64>() + size_of::<Vec3>() + size_of::<Side>();
        (n as u64) * (n as u64) * entry as u64
    }

    /// The pockets of a walk up to the price `bound`, as far as the work limit allows.
    /// `closes(s, q)` says whether the rung between two places may close off the run from the first
    /// on to the second.
    pub(super) fn new(
        chains: &Chains<'_>,
        walk: &Walk,
        closes: impl Fn(usize, usize) -> bool,
        bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let n = walk.len();
        let mut sides = vec![super::super::BARRED; n * n];
        for s in 0..n {
            for q in 0..s {
                let side = chains.side(walk.spots[s], walk.spots[q]);
                sides[s * n + q] = side;
                sides[q * n + s] = side;
            }
        }
        let mut pockets = Self {
            n,
            by_start: vec![f64::INFINITY; n * n],
            by_end: vec![f64::INFINITY; n * n],
            means: sides.iter().map(|side| side.mean).collect(),
            are_all: true,
        };
        for s in 0..n {
            pockets.set(s, 1, 0.0);
        }
        // A run of all samples but one is closed off by an edge that is there already.
        for length in 2..n.saturating_sub(1) {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            if chains.work.is_out() {
                pockets.are_all = false;
                break;
            }
            watch.progress(length as f64 / n as f64);
            chains.work.count(n as u64);
            for s in 0..n {
                let q = (s + length) % n;
                let Side { price, .. } = sides[s * n + q];
                if price <= bound && closes(s, q) {
                    let below = bound - price + QUANTUM;
                    if let Some((least, _)) = pockets.least(chains, walk, s, length, below) {
                        pockets.set(s, length, price + least);
                    }
                }
            }
        }
        Ok(pockets)
    }

    fn set(&mut self, s: usize, length: usize, price: f64) {
        let n = self.n;
        self.by_start[s * n + length] = price;
        self.by_end[(s + length) % n * n + (n - length)] = price;
    }

    /// E of the run from place `s` over `length` edges.
    pub(super) fn price(&self, s: usize, length: usize) -> f64 {
        self.by_start[s * self.n + length]
    }

    /// E of the runs that end at place `q`, by their starts: that from q − l at n − l.
    pub(super) fn ending_at(&self, q: usize) -> &[f64] {
        &self.by_end[q * self.n..][..self.n]
    }

    /// The N of the side between two places.
    pub(super) fn mean(&self, s: usize, q: usize) -> Vec3 {
        self.means[s * self.n + q]
    }

    fn fold(&self, chains: &Chains<'_>, walk: &Walk, [s, k, q]: [usize; 3]) -> f64 {
        let corners = [s, k, q].map(|place| walk.samples[place]);
        let means = [self.mean(s, k), self.mean(k, q), self.mean(s, q)];
        let (corners, means) = walk.oriented(corners, means);
        chains.fold(corners, means)
    }

    /// The least of E(s,k) + E(k,q) + F(s,k,q) if it lies below `below`, and how far the first k
    /// that reaches it lies behind s.
    fn least(
        &self,
        chains: &Chains<'_>,
        walk: &Walk,
        s: usize,
        length: usize,
        below: f64,
    ) -> Option<(f64, usize)> {
        let n = self.n;
        let q = (s + length) % n;
        let first = &self.by_start[s * n + 1..][..length - 1];
        let second = &self.by_end[q * n + n - length + 1..][..length - 1];
        chains.work.count(length as u64);
        least_of(first, second, below, |at| {
            let k = (s + at + 1) % n;
            self.fold(chains, walk, [s, k, q])
        })
        .map(|(price, at)| (price, at + 1))
    }

    /// The triangles of the pocket over the run from `s` over `length` edges, which has a price.
    pub(super) fn trace(
        &self,
        chains: &Chains<'_>,
        walk: &Walk,
        s: usize,
        length: usize,
        triangles: &mut Vec<[usize; 3]>,
    ) {
        let mut runs = vec![(s, length)];
        while let Some((s, length)) = runs.pop() {
            if length < 2 {
                continue;
            }
            let (q, n) = ((s + length) % self.n, self.n);
            let Some(split) = self.chosen(chains, walk, s, length) else { continue };
            let k = (s + split) % n;
            let corners = [s, k, q].map(|place| walk.samples[place]);
            triangles.push(walk.oriented(corners, [Vec3::ZERO; 3]).0);
            runs.extend([(s, split), (k, length - split)]);
        }
    }

    /// The k of E(s,q) as its distance from s: of equal prices the k with the shortest way, then
    /// the first.
    fn chosen(&self, chains: &Chains<'_>, walk: &Walk, s: usize, length: usize) -> Option<usize> {
        let n = self.n;
        let q = (s + length) % n;
        let mut chosen: Option<(f64, f64, usize)> = None;
        for split in 1..length {
            let k = (s + split) % n;
            let sum = self.price(s, split) + self.price(k, length - split);
            if sum == f64::INFINITY || chosen.is_some_and(|best| sum > best.0) {
                continue;
            }
            let price = sum + self.fold(chains, walk, [s, k, q]);
            let [a, b, c] = [s, k, q].map(|place| walk.samples[place]);
            let key = (price, chains.terms.prices.detour(a, b, c));
            if chosen.is_none_or(|best| key < (best.0, best.1)) {
                chosen = Some((key.0, key.1, split));
            }
        }
        chosen.map(|best| best.2)
    }
}

/// The least of first + second + F below `below`, element by element, and its place. F is never
/// negative and expensive, so it is computed only where the sum does not decide.
#[inline]
pub(super) fn least_of(
    first: &[f64],
    second: &[f64],
    below: f64,
    mut fold: impl FnMut(usize) -> f64,
) -> Option<(f64, usize)> {
    let mut least = below;
    let mut place = None;
    let (first_blocks, first_rest) = first.as_chunks::<LANES>();
    let (second_blocks, second_rest) = second.as_chunks::<LANES>();
    let mut look = |at: usize, sum: f64, least: &mut f64| {
        if sum < *least {
            let price = sum + fold(at);
            if price < *least {
                *least = price;
                place = Some(at);
            }
        }
    };
    // The shortest step and the first one are good guesses, which spare most others their F.
    if let [a, .., b] = first
        && let [c, .., d] = second
    {
        look(first.len() - 1, b + d, &mut least);
        look(0, a + c, &mut least);
    }
    for (block, (a, b)) in first_blocks.iter().zip(second_blocks).enumerate() {
        let mut some = false;
        for n in 0..LANES {
            some |= a[n] + b[n] < least;
        }
        if some {
            for n in 0..LANES {
                look(block * LANES + n, a[n] + b[n], &mut least);
            }
        }
    }
    let done = first_blocks.len() * LANES;
    for (n, (a, b)) in first_rest.iter().zip(second_rest).enumerate() {
        look(done + n, a + b, &mut least);
    }
    place.map(|at| (least, at))
}
