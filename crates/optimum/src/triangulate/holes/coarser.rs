//! A first triangulation of a large ring without a plane, from that of fewer samples.
//!
//! A good first triangulation is worth much: the exact search drops whatever is dearer, and where
//! its work ends, the first is the answer. Cut along its shortest rung, a ring often gets folds
//! there that the best surface has not. So the ring of about every second sample is triangulated
//! first (from a quarter of the samples, if it is large itself, and so on), and all samples are cut
//! where that surface has its cheapest rung (coarse to fine \[Raphael2001\]). Far from developable,
//! few samples tell little of the surface of many, and the shortest rung does as well.

use super::super::thinned::kept;
use super::super::{Method, Solved, TriangulateError};
use super::chains::{Chains, Spot};
use super::{Part, WORTH_A_BOUND, outcome, polygon, solve};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::watch::Watch;
use std::ops::Range;

/// One sample in about so many is kept.
const THINNING: usize = 2;
/// Loops of fewer samples are not thinned: they hardly have the shape of all.
const LEAST_SAMPLES: usize = 12;
/// The share of the remaining work for the ring of fewer samples.
const SHARE: f64 = 0.25;

/// The triangulation of a ring of two loops; `None` if none is found up to `bound`, where the ring
/// is far from developable, and where no work is left or there are few samples already.
pub(super) fn first(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let Some([p, q]) = cheapest_join(chains, &mut Part::new(watch, 0.0..0.5))? else {
        return Ok(None);
    };
    if chains.side(p, q).price == f64::INFINITY {
        return Ok(None);
    }
    polygon::solve_simple(&chains.with_cut(p, q), bound, &mut Part::new(watch, 0.5..1.0))
}

/// The cheapest rung that joins the loops in the triangulation of fewer samples; `None` if that is
/// dear.
fn cheapest_join(
    chains: &Chains<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<[Spot; 2]>, TriangulateError> {
    let all = [0, 1].map(|chain| {
        let start = chains.chains[chain][0];
        start..start + chains.len(chain)
    });
    let kept = [&all[0], &all[1]].map(|of_loop| kept(chains.terms.prices, of_loop, THINNING));
    if chains.work.left() == 0 || kept.iter().any(|kept| kept.len() < LEAST_SAMPLES) {
        return Ok(None);
    }
    let (outer, samples) = (kept[0].len(), kept.concat());
    let loops: [Range<usize>; 2] = [0..outer, outer..samples.len()];
    let thinned = chains.terms.thinned(&samples, &loops);
    let thinned = thinned.terms();
    let work = chains.work.part(SHARE);
    let Some(found) = solve(&thinned, None, &loops, f64::INFINITY, work, watch)? else {
        return Ok(None);
    };
    let found = outcome(&thinned, found, Method::Optimal);
    if found.price >= WORTH_A_BOUND {
        return Ok(None);
    }
    let corners = found.triangles.iter().map(|triangle| triangle.map(SampleIndex::get));
    let sides = corners.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let joins = sides.filter(|[a, b]| *a < outer && outer <= *b);
    let price = |[a, b]: [usize; 2]| (thinned.side(a, b).price, thinned.prices.length(a, b));
    let least = joins.min_by(|&one, &other| {
        let (one_price, other_price) = (price(one), price(other));
        one_price.0.total_cmp(&other_price.0).then(one_price.1.total_cmp(&other_price.1))
    });
    let spot = |chain: usize, n: usize| Spot { chain, at: samples[n] - all[chain].start };
    Ok(least.map(|[a, b]| [spot(0, a), spot(1, b)]))
}
