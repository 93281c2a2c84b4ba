//! How rungs wind round the hole of a band on a supporting plane.
//!
//! On the plane a rung is straight and has one winding round the hole. A reference cut ⟨o,e⟩
//! determines it: whether the rung crosses the cut and, where it begins at o or e, on which side of
//! the cut it leaves. Exact predicates decide both.

use super::chains::{Chains, Spot, in_sector};
use super::pockets::Walk;
use sheetwright_geometry::math::Point2;
use sheetwright_geometry::predicate::orientation;
use std::cmp::Ordering;

/// How rungs wind round the hole of a band on a supporting plane.
pub(super) struct Winding<'c, 'a> {
    pub(super) chains: &'c Chains<'a>,
    /// The reference cut, and where it lies.
    pub(super) o: Spot,
    pub(super) e: Spot,
    pub(super) points: &'c dyn Fn(usize) -> Point2,
}

impl Winding<'_, '_> {
    /// Whether a rung from o or e leaves in front of the cut, as the band is walked, rather than
    /// behind it.
    pub(super) fn leaves_in_front(&self, from: Spot, to: usize) -> bool {
        let own = (self.points)(self.chains.sample(from));
        let next = (self.points)(self.chains.next(from));
        let across = if from == self.o { self.e } else { self.o };
        let along_cut = (self.points)(self.chains.sample(across));
        let between = in_sector(own, next, along_cut, (self.points)(to));
        // The boundary goes with the walk at o and against it at e.
        between == (from == self.o)
    }

    pub(super) fn crosses(&self, a: usize, b: usize) -> bool {
        let cut = [self.o, self.e].map(|spot| self.chains.sample(spot));
        self.chains.crosses([a, b], cut)
    }

    /// How often the inner place of a joining rung winds round the hole.
    pub(super) fn of_join(&self, p: Spot, q: Spot) -> i8 {
        let [a, b] = [p, q].map(|spot| self.chains.sample(spot));
        match (p == self.o, q == self.e) {
            (true, true) => 0,
            (true, false) => -i8::from(!self.leaves_in_front(p, b)),
            (false, true) => i8::from(!self.leaves_in_front(q, a)),
            (false, false) if !self.crosses(a, b) => 0,
            (false, false) => {
                let [o, e] = [self.o, self.e].map(|spot| (self.points)(self.chains.sample(spot)));
                // To the right of the cut lies what is in front of it.
                if orientation(o, e, (self.points)(a)) == Ordering::Less { -1 } else { 1 }
            }
        }
    }

    /// Whether the rung between two places of a walk that begins at o or e closes off the run from
    /// the first on to the second.
    pub(super) fn closes(&self, walk: &Walk, s: usize, q: usize) -> bool {
        let (low, high) = (s.min(q), s.max(q));
        let over_cut = if low == 0 {
            !self.leaves_in_front(walk.spots[0], walk.samples[high])
        } else {
            self.crosses(walk.samples[low], walk.samples[high])
        };
        (s > q) == over_cut
    }
}
