//! A domain while it is cut open: its loops as chains of samples.
//!
//! A rung between two loops, walked on both sides (an artificial cut), joins them into one closed
//! chain, which passes the ends of the cut twice: c1 up to its end, the other loop once round from
//! the other end to itself, and on along c1. A rung belongs to one of the two banks of a sample
//! that is passed twice. With a supporting plane, the side on which it leaves decides, exactly;
//! without one, each bank may have it, but only one of them: pairs are then barred one by one.

use super::super::BARRED;
use super::super::EDGE;
use super::super::Side;
use super::super::Terms;
use super::work::{CUT, FOLD, SIDE, Work};
use sheetwright_geometry::boundary::SupportingPlane;
use sheetwright_geometry::math::{Point2, Vec3};
use sheetwright_geometry::predicate::{orientation, segments_touch};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::ops::Range;

/// A place on a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Spot {
    pub(super) chain: usize,
    pub(super) at: usize,
}

/// The chains of a domain, the outer one first.
#[derive(Clone)]
pub(super) struct Chains<'a> {
    pub(super) terms: &'a Terms<'a>,
    /// The samples on the plane, if there is one.
    pub(super) projected: Option<&'a [Point2]>,
    pub(super) chains: Vec<Vec<usize>>,
    /// The cuts made so far, the lower sample first.
    pub(super) cuts: Vec<[usize; 2]>,
    /// Pairs of spots on the only chain left that may not be joined, the lower place first.
    pub(super) barred: BTreeSet<[usize; 2]>,
    /// The work allowed for it.
    pub(super) work: Work<'a>,
}

impl<'a> Chains<'a> {
    pub(super) fn new(
        terms: &'a Terms<'a>,
        plane: Option<&'a SupportingPlane>,
        loops: &[Range<usize>],
        work: Work<'a>,
    ) -> Self {
        Self {
            terms,
            projected: plane.map(|plane| &plane.projected[..]),
            chains: loops.iter().map(|of_loop| of_loop.clone().collect()).collect(),
            cuts: Vec::new(),
            barred: BTreeSet::new(),
            work,
        }
    }

    /// These chains with `work` as their counter.
    pub(super) fn within(&self, work: Work<'a>) -> Self {
        Self { work, ..self.clone() }
    }

    pub(super) fn has_plane(&self) -> bool {
        self.projected.is_some()
    }

    pub(super) fn sample(&self, spot: Spot) -> usize {
        self.chains[spot.chain][spot.at]
    }

    /// How many samples a chain passes.
    pub(super) fn len(&self, chain: usize) -> usize {
        self.chains[chain].len()
    }

    pub(super) fn next(&self, spot: Spot) -> usize {
        let chain = &self.chains[spot.chain];
        chain[(spot.at + 1) % chain.len()]
    }

    pub(super) fn previous(&self, spot: Spot) -> usize {
        let chain = &self.chains[spot.chain];
        chain[(spot.at + chain.len() - 1) % chain.len()]
    }

    /// Where a sample lies on the plane.
    pub(super) fn point(&self, sample: usize) -> Option<Point2> {
        self.projected.map(|points| points[sample])
    }

    pub(super) fn is_cut(&self, a: usize, b: usize) -> bool {
        self.cuts.contains(&[a.min(b), a.max(b)])
    }

    /// Whether two spots follow one another on their chain.
    pub(super) fn consecutive(&self, p: Spot, q: Spot) -> bool {
        let apart = p.at.abs_diff(q.at);
        p.chain == q.chain && (apart == 1 || apart + 1 == self.len(p.chain))
    }

    /// The side between two spots.
    pub(super) fn side(&self, p: Spot, q: Spot) -> Side {
        self.work.count(SIDE);
        let (a, b) = (self.sample(p), self.sample(q));
        if self.consecutive(p, q) {
            return if self.is_cut(a, b) { self.bank(a, b) } else { EDGE };
        }
        if self.sees(p, q) { self.terms.side(a, b) } else { BARRED }
    }

    /// One bank of a cut: its price is counted once, beside those of both banks.
    pub(super) fn bank(&self, a: usize, b: usize) -> Side {
        Side { price: 0.0, ..self.terms.side(a, b) }
    }

    /// Whether two spots that do not follow one another may be joined.
    pub(super) fn sees(&self, p: Spot, q: Spot) -> bool {
        let (a, b) = (self.sample(p), self.sample(q));
        if a == b || self.terms.prices.neighbours(a, b) || self.is_cut(a, b) {
            return false;
        }
        if !self.terms.visibility.allows(a, b) {
            return false;
        }
        if self.barred.contains(&[p.at.min(q.at), p.at.max(q.at)]) {
            return false;
        }
        let Some(points) = self.projected else { return true };
        self.work.count(CUT * self.cuts.len() as u64);
        let leaves = |from: Spot, to: usize| {
            let own = points[self.sample(from)];
            let doubled = self.cuts.iter().any(|cut| cut.contains(&self.sample(from)));
            !doubled
                || in_sector(own, points[self.next(from)], points[self.previous(from)], points[to])
        };
        leaves(p, b) && leaves(q, a) && !self.cuts.iter().any(|&cut| self.crosses([a, b], cut))
    }

    /// Whether two segments between samples cross on the plane, other than at samples they share.
    pub(super) fn crosses(&self, [a, b]: [usize; 2], [c, d]: [usize; 2]) -> bool {
        let Some(points) = self.projected else { return false };
        let shared = a == c || a == d || b == c || b == d;
        !shared && segments_touch(points[a], points[b], points[c], points[d])
    }

    /// The domain with one cut more, between spots of two chains, which become one.
    pub(super) fn with_cut(&self, p: Spot, q: Spot) -> Self {
        let (p, q) = if p.chain < q.chain { (p, q) } else { (q, p) };
        let (first, second) = (&self.chains[p.chain], &self.chains[q.chain]);
        let joined = first[..=p.at]
            .iter()
            .chain(&second[q.at..])
            .chain(&second[..=q.at])
            .chain(&first[p.at..])
            .copied()
            .collect();
        let mut cut = self.clone();
        let (a, b) = (self.sample(p), self.sample(q));
        cut.cuts.push([a.min(b), a.max(b)]);
        cut.chains[p.chain] = joined;
        cut.chains.remove(q.chain);
        cut
    }

    /// The price of a triangle between samples, counter-clockwise, with the N of its sides.
    pub(super) fn fold(&self, corners: [usize; 3], means: [Vec3; 3]) -> f64 {
        if self.terms.prices.options().fold > 0.0 {
            self.work.count(FOLD);
            self.terms.prices.triangle(corners, means)
        } else {
            0.0
        }
    }

    /// The price of the cuts themselves.
    pub(super) fn price_of_cuts(&self) -> f64 {
        self.cuts.iter().map(|&[a, b]| self.terms.side(a, b).price).sum()
    }
}

/// Whether the direction from `own` to `to` lies strictly inside the sector that runs
/// counter-clockwise from the direction to `from` to that to `until`. Exact.
pub(super) fn in_sector(own: Point2, from: Point2, until: Point2, to: Point2) -> bool {
    let left = |a: Point2, b: Point2| orientation(own, a, b) == Ordering::Greater;
    let right = |a: Point2, b: Point2| orientation(own, a, b) == Ordering::Less;
    let straight = !left(from, until) && !right(from, until);
    if straight && (from - own).dot(until - own) < 0.0 {
        return left(from, to);
    }
    if left(from, until) {
        left(from, to) && left(to, until)
    } else {
        // A sector of more than half a turn, or a whole turn: the complement of the closed rest.
        left(from, to) || right(until, to) || opposite(own, from, to) || opposite(own, until, to)
    }
}

/// Whether two directions from `own` are opposite.
fn opposite(own: Point2, a: Point2, b: Point2) -> bool {
    orientation(own, a, b) == Ordering::Equal && (a - own).dot(b - own) < 0.0
}

/// The joining rung that is allowed and shortest; of equals, the first.
pub(super) fn shortest_join(chains: &Chains<'_>) -> Option<(Spot, Spot)> {
    let mut best: Option<(f64, (Spot, Spot))> = None;
    for p in (0..chains.len(0)).map(|at| Spot { chain: 0, at }) {
        for q in (0..chains.len(1)).map(|at| Spot { chain: 1, at }) {
            let length = chains.terms.prices.length(chains.sample(p), chains.sample(q));
            if best.is_none_or(|(least, _)| length < least)
                && chains.side(p, q).price < f64::INFINITY
            {
                best = Some((length, (p, q)));
            }
        }
    }
    best.map(|(_, pair)| pair)
}
