//! The cheapest triangulation of a domain with holes.

mod band;
mod bound;
mod chains;
mod pockets;
mod polygon;
mod prove;
mod search;

use super::Found;
use super::Terms;
use super::TriangulateError;
use super::memory_needed as memory_needed_for_chain;
use crate::boundary::SupportingPlane;
use crate::watch::Watch;
use chains::Chains;
use std::ops::Range;

/// Prices above which a bound prunes little on a ring, so that it isn't worth looking for one.
const WORTH_A_BOUND: f64 = 4.0;

/// What the tables of loops of these lengths take, bytes.
pub(super) fn memory_needed(lengths: &[usize]) -> u64 {
    let holes = lengths.len() - 1;
    let all = lengths.iter().sum::<usize>() + 2 * holes;
    let chain = memory_needed_for_chain(all);
    let band = band::memory_needed(all - lengths[holes], lengths[holes]);
    let bound = if holes > 1 { bound::memory_needed(all) } else { 0 };
    chain.max(band).max(bound)
}

/// A part of the work, and the part of its progress that this is.
struct Part<'w> {
    watch: &'w mut dyn Watch,
    share: Range<f64>,
}

impl<'w> Part<'w> {
    fn new(watch: &'w mut dyn Watch, share: Range<f64>) -> Self {
        Self { watch, share }
    }

    /// A part whose progress nobody can tell.
    fn silent(watch: &'w mut dyn Watch) -> Self {
        Self { watch, share: f64::NAN..f64::NAN }
    }
}

impl Watch for Part<'_> {
    fn progress(&mut self, done: f64) {
        if self.share.start.is_finite() {
            self.watch.progress(self.share.start + (self.share.end - self.share.start) * done);
        }
    }

    fn stop(&self) -> bool {
        self.watch.stop()
    }
}

/// The cheapest triangles between the loops; `None` if there are none.
pub(super) fn solve(
    terms: &Terms<'_>,
    plane: Option<&SupportingPlane>,
    loops: &[Range<usize>],
    watch: &mut dyn Watch,
) -> Result<Option<Found>, TriangulateError> {
    let chains = Chains::new(terms, plane, loops);
    if loops.len() == 2 {
        let first = search::first(&chains, WORTH_A_BOUND, &mut Part::new(watch, 0.0..0.1))?;
        return band::solve_exactly(&chains, first, &mut Part::new(watch, 0.1..1.0));
    }
    let first = search::first(&chains, f64::INFINITY, &mut Part::new(watch, 0.0..0.1))?;
    let Some(first) = first else { return Ok(None) };
    let best = search::improved(&chains, first, &mut Part::new(watch, 0.1..0.5))?;
    let (best, lower_bound) = prove::prove(&chains, best, &mut Part::new(watch, 0.5..1.0))?;
    Ok(Some(Found { triangles: best.triangles, lower_bound }))
}
