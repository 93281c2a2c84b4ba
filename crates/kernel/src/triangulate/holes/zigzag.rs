//! A ring that is triangulated in no time: from edge to edge, without pockets.
//!
//! Without a plane any two samples may be joined, so that there always is a band whose steps each run
//! along one edge; its cheapest is a shortest path through the lattice of all pairs, in one pass. The
//! steps begin along either chain in turn, as no rung is used twice then. It is the answer where none
//! else was found before the work ended.

use super::super::{Side, Solved};
use super::chains::{Chains, Spot, shortest_join};
use super::pockets::Walk;
use super::work::SIDE;
use crate::math::Vec3;

/// Where the path is free: two steps along each chain, in turn, lead there.
const FREE_FROM: usize = 2;

/// The cheapest band between the two chains whose steps run along one edge each and begin at their
/// shortest join, without the price of the cuts; `None` if a rung without tangent planes would be
/// needed, and is not admitted.
pub(super) fn zigzag(chains: &Chains<'_>) -> Option<Solved> {
    let (o, e) = shortest_join(chains)?;
    let band = Lattice {
        chains,
        outer: Walk::new(chains, 0, o.at, false),
        inner: Walk::new(chains, 1, e.at, true),
    };
    band.cheapest()
}

struct Lattice<'c, 'a> {
    chains: &'c Chains<'a>,
    outer: Walk,
    inner: Walk,
}

/// A pair of places, each once round at the most.
type Pair = (usize, usize);

impl Lattice<'_, '_> {
    fn spots(&self, (p, a): Pair) -> (Spot, Spot) {
        (self.outer.spots[p % self.outer.len()], self.inner.spots[a % self.inner.len()])
    }

    fn join(&self, pair: Pair) -> Side {
        let (p, a) = self.spots(pair);
        self.chains.side(p, a)
    }

    /// The corners of the triangle of a step, and the N of its sides, of which the joins are known.
    fn triangle(&self, from: Pair, to: Pair, joins: [Vec3; 2]) -> ([usize; 3], [Vec3; 3]) {
        let ((p, a), (q, b)) = (self.spots(from), self.spots(to));
        let sample = |spot| self.chains.sample(spot);
        if p == q {
            let edge = self.chains.side(a, b).mean;
            ([sample(p), sample(b), sample(a)], [joins[1], edge, joins[0]])
        } else {
            let edge = self.chains.side(p, q).mean;
            ([sample(p), sample(q), sample(a)], [edge, joins[1], joins[0]])
        }
    }

    /// The price of a step with the rung that it arrives at.
    fn step(&self, from: Pair, to: Pair, [left, reached]: [&Side; 2]) -> f64 {
        let (corners, means) = self.triangle(from, to, [left.mean, reached.mean]);
        reached.price + self.chains.fold(corners, means)
    }

    fn cheapest(&self) -> Option<Solved> {
        let (m, k) = (self.outer.len(), self.inner.len());
        self.chains.work.count(2 * SIDE * (m * k) as u64);
        let at = |(p, a): Pair| p * (k + 1) + a;
        let pairs = || (0..=m).flat_map(|p| (0..=k).map(move |a| (p, a)));
        let joins: Vec<Side> = pairs().map(|pair| self.join(pair)).collect();
        let mut least = vec![f64::INFINITY; joins.len()];
        least[0] = 0.0;
        for (p, a) in pairs().skip(1) {
            let ways = before((p, a)).map(|from| {
                let before = least[at(from)];
                let sides = [&joins[at(from)], &joins[at((p, a))]];
                if before < f64::INFINITY {
                    before + self.step(from, (p, a), sides)
                } else {
                    before
                }
            });
            least[at((p, a))] = ways.fold(f64::INFINITY, f64::min);
        }
        let price = least[at((m, k))];
        let mut triangles = Vec::with_capacity(m + k);
        let mut here = (m, k);
        while price < f64::INFINITY && here != (0, 0) {
            let cost = |from: Pair| {
                let sides = [&joins[at(from)], &joins[at(here)]];
                least[at(from)] + self.step(from, here, sides)
            };
            let from = before(here).min_by(|&one, &other| cost(one).total_cmp(&cost(other)))?;
            triangles.push(self.triangle(from, here, [Vec3::ZERO; 2]).0);
            here = from;
        }
        (price < f64::INFINITY).then_some(Solved { price, triangles })
    }
}

/// The pairs from which a step leads to a pair.
fn before((p, a): Pair) -> impl Iterator<Item = Pair> {
    let is_free = p > FREE_FROM && a >= FREE_FROM || p >= FREE_FROM && a > FREE_FROM;
    let along_outer = if is_free { p > FREE_FROM } else { p == a + 1 };
    let along_inner = if is_free { a > FREE_FROM } else { p == a };
    let within = p <= FREE_FROM && a <= FREE_FROM || is_free;
    let outer = (within && along_outer && p > 0).then(|| (p - 1, a));
    outer.into_iter().chain((within && along_inner && a > 0).then(|| (p, a - 1)))
}
