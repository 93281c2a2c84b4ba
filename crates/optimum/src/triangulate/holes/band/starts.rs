//! The cheapest closed walk round a band, by branch and bound over sets of starts.
//!
//! For a set of starts, the cheapest path from any of them to the image of any other
//! ([`super::sweep`]) is a lower bound on all of their walks, and the optimum if it closes. Sets
//! are halved between start and end until the cheapest path of all closes (as for circular shortest
//! paths \[Appleton2003\]). A set whose bound is not below the price of a known walk is dropped. A
//! few dozen sets are usual; at worst there is one for each pair. Where the work limit ends the
//! search, the result is the best closed walk, and the cheapest path of the remaining sets is the
//! lower bound.

use super::super::Part;
use super::super::cover::{BandWalk, Starts};
use super::super::work::Work;
use super::{Band, TriangulateError};
use crate::cost::QUANTUM;
use sheetwright_geometry::watch::Watch;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The share of the work for sets of starts; the rest is for closed walks where that did not
/// suffice.
const SHARE_OF_SETS: f64 = 0.8;

/// The result of a search for the cheapest closed walk.
pub(super) struct Sought {
    /// The cheapest known walk.
    pub(super) walk: Option<BandWalk>,
    /// Lower bound on all closed walks, if it is below the price of that walk.
    pub(super) lower_bound: Option<f64>,
}

/// A set of starts waiting to be halved; the cheapest first.
struct Open {
    walk: BandWalk,
    starts: Starts,
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |open: &Self| (!open.walk.closes(), open.starts);
        other.walk.price.total_cmp(&self.walk.price).then_with(|| key(other).cmp(&key(self)))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl Band<'_, '_> {
    /// The cheapest closed walk up to `bound`; with `counting`, of those that use no rung twice.
    pub(super) fn cheapest_walk(
        &self,
        counting: bool,
        mut bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Sought, TriangulateError> {
        let work = self.chains.work.part(SHARE_OF_SETS);
        let (m, k) = (self.m(), self.k());
        // A walk through the reference cut gives a first bound.
        let through_cut = Starts { outer: (0, 0), inner: (0, 0) };
        let mut open = BinaryHeap::new();
        let mut left = 1.0;
        let mut part = Part::new(watch, 0.0..0.3);
        if let Some(walk) =
            self.swept(&through_cut, counting, bound, self.chains.work, &mut part)?
        {
            // From here on, only what is cheaper counts.
            bound = bound.min(walk.price - QUANTUM);
            open.push(Open { walk, starts: through_cut });
        }
        let (first, all) = if self.chains.has_plane() {
            ((-k, k - 1), (-k, 2 * k - 1))
        } else {
            ((0, k - 1), (0, k - 1))
        };
        let mut sets = vec![
            (Starts { outer: (0, 0), inner: first }, 0.0),
            (Starts { outer: (1, m - 1), inner: all }, 0.0),
        ];
        left *= 0.7;
        // Lower bound on walks from starts that were not searched.
        let mut unsought = f64::INFINITY;
        loop {
            for (starts, least) in sets.drain(..) {
                // How often sets are halved is not known: each sweep gets half of what is left.
                let mut part = Part::new(watch, 1.0 - left..1.0 - 0.5 * left);
                left *= 0.5;
                if let Some(walk) = self.swept(&starts, counting, bound, work, &mut part)? {
                    if walk.closes() {
                        // From here on, only what is cheaper counts.
                        bound = bound.min(walk.price - QUANTUM);
                    }
                    open.push(Open { walk, starts });
                } else if work.is_out() {
                    unsought = unsought.min(least);
                }
            }
            if unsought < f64::INFINITY {
                return self.given_up(open.into_sorted_vec(), unsought, counting, bound, watch);
            }
            let Some(Open { walk, starts }) = open.pop() else {
                return Ok(self.sought(None, f64::INFINITY));
            };
            if walk.closes() {
                let price = walk.price;
                return Ok(self.sought(Some(walk), price));
            }
            sets.extend(starts.halved(walk.start(), walk.end).map(|half| (half, walk.price)));
        }
    }

    /// The result if `least` is a lower bound on all walks, provided that all pockets are computed.
    fn sought(&self, walk: Option<BandWalk>, least: f64) -> Sought {
        let are_all = self.outer_pockets.are_all && self.inner_pockets.are_all;
        let least = if are_all { least } else { 0.0 };
        let is_least = least >= walk.as_ref().map_or(f64::INFINITY, |walk| walk.price);
        Sought { walk, lower_bound: (!is_least).then_some(least) }
    }

    /// The result where not all starts could be searched: `open` has the cheapest paths from those
    /// that were, the cheapest last. With the work that is left, a few more closed walks are
    /// searched from where these begin.
    fn given_up(
        &self,
        open: Vec<Open>,
        unsought: f64,
        counting: bool,
        mut bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Sought, TriangulateError> {
        let least = open.iter().map(|open| open.walk.price).fold(unsought, f64::min);
        let (mut closed, paths): (Vec<Open>, Vec<Open>) =
            open.into_iter().rev().partition(|open| open.walk.closes());
        for (p, a) in paths.iter().flat_map(|path| [path.walk.start(), path.walk.end]) {
            let starts = Starts { outer: (p, p), inner: (a, a) };
            let part = &mut Part::silent(watch);
            if let Some(walk) = self.swept(&starts, counting, bound, self.chains.work, part)? {
                bound = bound.min(walk.price - QUANTUM);
                closed.push(Open { walk, starts });
            }
        }
        let key = |open: &Open| (!open.walk.is_simple(), open.walk.price);
        let best = closed.into_iter().min_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        Ok(self.sought(best.map(|best| best.walk), least))
    }

    /// The cheapest path from one of the starts to the image of one of them, if there is work left
    /// to find it.
    fn swept(
        &self,
        starts: &Starts,
        counting: bool,
        bound: f64,
        work: Work<'_>,
        watch: &mut dyn Watch,
    ) -> Result<Option<BandWalk>, TriangulateError> {
        if work.is_out() {
            return Ok(None);
        }
        if counting {
            self.counting_sweep(starts, bound, work, watch)
        } else {
            self.sweep(starts, bound, work, watch)
        }
    }
}
