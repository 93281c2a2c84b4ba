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
use crate::boundary::SupportingPlane;
use crate::watch::Watch;
use chains::Chains;
use std::ops::Range;

/// What the tables of loops of these lengths take, bytes.
pub(super) fn memory_needed(lengths: &[usize]) -> u64 {
    band::memory_needed(lengths[0], lengths[1..].iter().sum())
}

/// Passes on a wish to stop, and no progress: parts of the work do not know how much there is.
struct Quiet<'w>(&'w mut dyn Watch);

impl Watch for Quiet<'_> {
    fn stop(&self) -> bool {
        self.0.stop()
    }
}

/// The cheapest triangles between the loops; `None` if there are none.
pub(super) fn solve(
    terms: &Terms<'_>,
    plane: Option<&SupportingPlane>,
    loops: &[Range<usize>],
    watch: &mut dyn Watch,
) -> Result<Option<Found>, TriangulateError> {
    let watch = &mut Quiet(watch);
    let chains = Chains::new(terms, plane, loops);
    if loops.len() == 2 {
        let found = band::solve(&chains, f64::INFINITY, true, watch)?;
        return Ok(found.map(|found| Found { triangles: found.triangles, lower_bound: None }));
    }
    let found = search::solve(&chains, watch)?;
    let Some(best) = found else { return Ok(None) };
    let (best, lower_bound) = prove::prove(&chains, best, watch)?;
    Ok(Some(Found { triangles: best.triangles, lower_bound }))
}
