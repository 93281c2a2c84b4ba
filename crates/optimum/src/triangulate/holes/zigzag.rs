//! A triangulation without a plane that always exists: rings from edge to edge, without pockets.
//!
//! Without a plane any two samples may be joined. A *zigzag* is a band between two loops whose
//! steps each run along one edge; the cheapest is a shortest path through the lattice of all pairs,
//! in one pass. It is the result where the work ended before another triangulation was found.
//!
//! It is a surface for any number of loops of three or more samples each:
//!
//! 1. A zigzag uses no rung twice. The path begins along either chain in turn, (0,0), (1,0), (1,1),
//!    (2,1), (2,2), so that from there on both places are 2 or more, and at most once round. Two
//!    pairs of it that stand for the same samples would differ by a round along one chain, so that
//!    one of them had a place 0; only (0,0) and (1,0) have one, and only the end, (m,k), comes back
//!    to either. A rung joins two loops, so it is no edge.
//! 2. Another loop goes into one of these triangles: a zigzag between that triangle and the loop
//!    replaces it. Its rungs all end at samples that had no triangle before, so none is
//!    used twice; each side of the triangle keeps one triangle on its inner side, and the fans at
//!    its corners stay whole.
//! 3. Where rungs without tangent planes are admitted, every rung has a price.

use super::super::{Found, Method, Side, Solved, outcome};
use super::chains::{Chains, Spot, shortest_join};
use super::pockets::Walk;
use super::work::SIDE;
use sheetwright_geometry::math::Vec3;
use std::collections::{BTreeMap, BTreeSet};

/// Where the path is free: two steps along each chain, in turn, lead there.
const FREE_FROM: usize = 2;

/// A triangulation without a plane, which always is a surface: see above. `None` if a rung without
/// tangent planes would be needed, and is not admitted.
pub(super) fn nested(chains: &Chains<'_>) -> Option<Solved> {
    let (outer, holes) = chains.chains.split_first()?;
    let (first, others) = holes.split_first()?;
    let mut triangles = zigzag(&ring(chains, outer, first))?.triangles;
    for hole in others {
        let triangle = triangles.swap_remove(nearest(chains, &triangles, hole)?);
        triangles.extend(zigzag(&ring(chains, &triangle, hole))?.triangles);
    }
    let found = Found { triangles: triangles.clone(), lower_bound: None };
    Some(Solved { price: outcome(chains.terms, found, Method::Optimal).price, triangles })
}

/// The ring between two loops; sides of the outer one that are rungs are banks of cuts.
fn ring<'a>(chains: &Chains<'a>, outer: &[usize], hole: &[usize]) -> Chains<'a> {
    let sides = outer.iter().zip(outer.iter().cycle().skip(1));
    let rungs = sides.filter(|&(&a, &b)| !chains.terms.prices.neighbours(a, b));
    let cuts = rungs.map(|(&a, &b)| [a.min(b), a.max(b)]).collect();
    Chains { chains: vec![outer.to_vec(), hole.to_vec()], cuts, ..chains.clone() }
}

/// The triangle whose corners are nearest to a loop: the one with the least sum of the three
/// distances from its samples.
fn nearest(chains: &Chains<'_>, triangles: &[[usize; 3]], hole: &[usize]) -> Option<usize> {
    let corners: BTreeSet<usize> = triangles.iter().flatten().copied().collect();
    chains.work.count((corners.len() * hole.len()) as u64);
    let away = |corner: usize| {
        let lengths = hole.iter().map(|&sample| chains.terms.prices.length(corner, sample));
        (corner, lengths.fold(f64::INFINITY, f64::min))
    };
    let away: BTreeMap<usize, f64> = corners.into_iter().map(away).collect();
    let sum = |n: usize| triangles[n].iter().map(|corner| away[corner]).sum::<f64>();
    (0..triangles.len()).min_by(|&one, &other| sum(one).total_cmp(&sum(other)))
}

/// The cheapest band between the two chains whose steps run along one edge each and begin at their
/// shortest join, without the price of the cuts; `None` if a rung without tangent planes would be
/// needed, and is not admitted.
fn zigzag(chains: &Chains<'_>) -> Option<Solved> {
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

#[cfg(test)]
#[allow(clippy::unwrap_used)] // tests panic
mod tests {
    use super::super::search::Sides;
    use super::*;
    use crate::cost::{PriceOptions, Prices};
    use crate::rung::Visibility;
    use crate::triangulate::Terms;
    use crate::triangulate::holes::{Tally, Work};
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, sin};

    #[test]
    fn any_loops_have_a_surface() {
        for case in 0..60 {
            // Points of a cube in no order; corners too, which have no tangent plane.
            let point = |n: usize| {
                let [x, y, z] = [1.3, 2.7, 4.1].map(|f| 50.0 * sin(f * (n * n + case) as f64));
                let at = Point3::new(x, y, z);
                if n % 4 == case % 4 { CurvePoint::corner(at) } else { CurvePoint::smooth(at) }
            };
            let points = |of: usize| (0..3 + (7 * case + 5 * of) % 23).map(move |n| 100 * of + n);
            let loops = (0..2 + case % 6).map(|of| points(of).map(point).collect::<Vec<_>>());
            let loops = loops.map(|points| samples_from_points(&points)).collect();
            let boundary = Boundary::new(loops).unwrap();
            let prices = Prices::new(&boundary, None, PriceOptions::default());
            let everything = Visibility::everything();
            let terms = Terms::new(&prices, &everything, true);
            let tally = Tally::default();
            let chains = Chains::new(&terms, None, boundary.loops(), Work::new(&tally, 0));
            let found = nested(&chains).unwrap();
            assert_eq!(found.triangles.len(), boundary.len() + 2 * boundary.holes() - 2);
            let sides = Sides::new(&chains, &found.triangles).unwrap();
            assert!(sides.fans_are_whole(&found.triangles), "{case}");
            assert!(found.price.is_finite() && super::super::floor::floor(&chains) <= found.price);
        }
    }
}
