//! Triangulations over a supporting plane, found without computing which rungs lie inside the
//! projection.
//!
//! To compute that for all pairs of samples takes longer than to fill the table. So the table is
//! filled with more rungs, and its optimum is checked: if all of its triangles face up over the
//! plane, which is mostly so, it is the optimum with the plane, too.

use super::memory::obtainable;
use super::optimal::warm_start;
use super::{
    Found, Terms, TriangulateError, TriangulateOptions, Triangulation, holes, if_it_fits,
    is_bounded, memory_needed, optimal, outcome,
};
use crate::cost::{Prices, quantised};
use crate::rung::Visibility;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::predicate::orientation;
use sheetwright_geometry::watch::Watch;

/// The cheapest triangulation, and by-products of the search.
#[derive(Clone, Debug, PartialEq)]
pub struct Cheapest {
    /// The cheapest triangulation that the method and the supporting plane admit.
    pub triangulation: Triangulation,
    /// Whether it is the cheapest without the plane, too; `None` if the search did not show that.
    pub also_without_plane: Option<bool>,
}

/// The cheapest triangulation of one loop among those with these rungs, which are all that lie
/// inside the projection and more, if it lies over the plane as it should; `known` is a
/// triangulation that is known.
pub(super) fn solve_then_check(
    prices: &Prices,
    visibility: &Visibility,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    known: Option<&Triangulation>,
    watch: &mut dyn Watch,
) -> Result<Option<Triangulation>, TriangulateError> {
    if !may_ask_less(prices, options) {
        return Ok(None);
    }
    let terms = Terms::new(prices, visibility, false).within(options.memory_limit);
    let found = optimal::solve(&terms, known, watch)?;
    let lies = |triangles: &Vec<[usize; 3]>| plane.is_none_or(|plane| lie_on(plane, triangles));
    Ok(found
        .filter(lies)
        .map(|triangles| outcome(&terms, Found { triangles, lower_bound: None }, options.method)))
}

/// Whether the table of all rungs may be filled before it is known which lie inside the projection.
pub(super) fn may_ask_less(prices: &Prices, options: &TriangulateOptions) -> bool {
    is_bounded(options) && prices.one_loop()
}

/// Whether triangles all lie on the plane as they should. Then they do not overlap, and their rungs
/// lie inside the projection: the cheapest triangulation of those with more rungs is that with the
/// plane too, and ties were decided among the same.
fn lie_on(plane: &SupportingPlane, triangles: &[[usize; 3]]) -> bool {
    let at = |i: usize| plane.projected[i];
    triangles.iter().all(|&[i, k, j]| orientation(at(i), at(k), at(j)).is_gt())
}

/// The cheapest triangulation without a plane of one loop, or the best found of a ring, if it costs
/// less than `limit` and all its rungs have tangent planes; else `None`. `None` as well where the
/// table exceeds the memory limit. The price of a triangulation `known` from before is an upper
/// bound; the answer does not depend on it, unless it makes the table small enough for the memory.
///
/// # Errors
/// See [`TriangulateError`].
pub fn cheaper_than(
    boundary: &Boundary,
    options: &TriangulateOptions,
    limit: f64,
    known: Option<&Triangulation>,
    watch: &mut dyn Watch,
) -> Result<Option<Triangulation>, TriangulateError> {
    let prices = Prices::new(boundary, None, options.price).with_hints(&options.hints, boundary);
    let everything = Visibility::everything();
    let limit_bytes = obtainable(options.memory_limit, memory_needed(boundary.len()));
    let terms = Terms::new(&prices, &everything, false).within(limit_bytes);
    if boundary.holes() == 1 {
        let tally = holes::Tally::default();
        let work = holes::Work::new(&tally, options.work_limit);
        let found = holes::solve(&terms, None, boundary.loops(), quantised(limit), work, watch)?;
        let found = found.map(|found| outcome(&terms, found, options.method));
        return Ok(found.filter(|found| found.price < limit));
    }
    let known = known.filter(|known| warm_start::is_of(known, &[boundary.len()]));
    let bound = warm_start::price(&terms, known).map_or(limit, |price| price.min(limit));
    let found = if_it_fits(optimal::solve_within(&terms, quantised(bound), watch))?;
    let found = found.filter(|found| found.price < limit);
    Ok(found.map(|found| {
        let found = Found { triangles: found.triangles, lower_bound: None };
        outcome(&terms, found, options.method)
    }))
}
