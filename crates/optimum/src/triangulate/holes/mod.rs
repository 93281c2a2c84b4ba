//! The cheapest triangulation of a domain with holes.

mod band;
mod bound;
mod chains;
mod coarser;
mod cover;
mod floor;
mod pockets;
mod polygon;
mod prove;
mod search;
mod winding;
mod work;
mod zigzag;

use super::Found;
use super::Method;
use super::Terms;
use super::TriangulateError;
use super::memory_needed as memory_needed_for_chain;
use super::outcome;
use super::part::Part;
use band::RingFound;
use chains::Chains;
use sheetwright_geometry::boundary::SupportingPlane;
use sheetwright_geometry::watch::Watch;
use std::ops::Range;
pub(super) use work::{Tally, Work};

/// A bound above this price prunes little on a ring and is not worth a search.
const WORTH_A_BOUND: f64 = 4.0;

/// Memory of the tables of loops of these lengths, bytes.
pub(super) fn memory_needed(lengths: &[usize]) -> u64 {
    let holes = lengths.len() - 1;
    let all = lengths.iter().sum::<usize>() + 2 * holes;
    let chain = memory_needed_for_chain(all);
    let band = band::memory_needed(all - lengths[holes], lengths[holes]);
    let bound = if holes > 1 { bound::memory_needed(all) } else { 0 };
    chain.max(band).max(bound)
}

/// The share of the remaining work for improving the first triangulation: a good triangulation
/// comes before the proof that it is good.
const SHARE_OF_IMPROVING: f64 = 0.4;

/// The cheapest triangulation between the loops; `None` if there is none up to the price `bound`.
/// Where the work limit ends the search, the best found so far, and a lower bound.
pub(super) fn solve(
    terms: &Terms<'_>,
    plane: Option<&SupportingPlane>,
    loops: &[Range<usize>],
    bound: f64,
    work: Work<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Found>, TriangulateError> {
    let chains = Chains::new(terms, plane, loops, work);
    let mut found = searched(&chains, bound, watch)?;
    if let Some(Found { lower_bound: Some(least), .. }) = &mut found {
        *least = least.max(floor::floor(&chains));
    }
    Ok(found)
}

/// The best triangulation found up to `bound`, and the lower bound that the search has reached.
fn searched(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Found>, TriangulateError> {
    let watch = &mut Part::new(watch, 0.0..1.0);
    if chains.chains.len() == 2 {
        return of_ring(chains, bound, watch);
    }
    let first = search::first(chains, bound, &mut Part::new(watch, 0.0..0.1))?;
    let Some(first) = first else { return Ok(None) };
    if first.price == 0.0 {
        // Its price is 0: it lies flat, and no other is cheaper.
        return Ok(Some(Found { triangles: first.triangles, lower_bound: None }));
    }
    let improving = chains.within(chains.work.part(SHARE_OF_IMPROVING));
    let best = search::improved(&improving, first, &mut Part::new(watch, 0.1..0.5))?;
    let (best, lower_bound) = prove::prove(chains, best, &mut Part::new(watch, 0.5..1.0))?;
    Ok(Some(Found { triangles: best.triangles, lower_bound }))
}

/// As [`searched`], for one hole.
fn of_ring(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Found>, TriangulateError> {
    // A large table is filled once; its result stands unless the search finds a better one.
    let places = chains.len(0) + chains.len(1) + 2;
    let is_large = polygon::is_large(chains, places);
    let worth = if is_large { bound } else { bound.min(WORTH_A_BOUND) };
    let part = &mut Part::new(watch, 0.0..0.1);
    // Where few samples tell little, the shortest cut may be better: a table is spent on that if
    // there is work for one.
    let is_affordable = polygon::is_affordable(chains, places);
    let mut first = None;
    if is_large && !chains.has_plane() {
        first = coarser::first(chains, bound, part)?;
    }
    if first.is_none() || is_affordable {
        let known = first.as_ref().map_or(worth, |first| first.price.min(worth));
        first = search::first(chains, known, part)?.or(first);
    }
    let limit = first.as_ref().map_or(bound, |first| first.price.min(bound));
    let part = &mut Part::new(watch, 0.1..1.0);
    let RingFound { triangles, lower_bound } = band::solve_exactly(chains, limit, part)?;
    if let Some(triangles) = triangles {
        return Ok(Some(Found { triangles, lower_bound }));
    }
    // Without an open lower bound, there is no triangulation.
    if lower_bound.is_none() {
        return Ok(None);
    }
    let first = match first {
        None if worth < bound => search::first(chains, bound, &mut Part::silent(watch))?,
        first => first,
    };
    Ok(first.map(|first| Found { triangles: first.triangles, lower_bound }))
}

/// The price of a good triangulation without a plane up to `bound`: the best on a ring, and with
/// more holes the best that is found without proof; infinite if none is.
pub(super) fn good_price(
    terms: &Terms<'_>,
    loops: &[Range<usize>],
    bound: f64,
    work: Work<'_>,
    watch: &mut dyn Watch,
) -> Result<f64, TriangulateError> {
    let chains = Chains::new(terms, None, loops, work);
    if loops.len() == 2 {
        let found = solve(terms, None, loops, bound, work, watch)?;
        return Ok(
            found.map_or(f64::INFINITY, |found| outcome(terms, found, Method::Optimal).price)
        );
    }
    let Some(first) = search::first(&chains, bound, watch)? else { return Ok(f64::INFINITY) };
    Ok(search::improved(&chains, first, watch)?.price)
}

/// The price of a first triangulation without a plane; infinite if none is found.
pub(super) fn guess(
    terms: &Terms<'_>,
    loops: &[Range<usize>],
    work: Work<'_>,
    watch: &mut dyn Watch,
) -> Result<f64, TriangulateError> {
    let first = search::first(&Chains::new(terms, None, loops, work), f64::INFINITY, watch)?;
    Ok(first.map_or(f64::INFINITY, |first| first.price))
}
