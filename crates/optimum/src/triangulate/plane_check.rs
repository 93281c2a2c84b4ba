//! Triangulations over a supporting plane, found without knowing which rungs lie inside the
//! projection.
//!
//! To know that of all pairs of samples takes longer than to fill the table. So the table is filled
//! with more rungs than those, and the answer is looked at: mostly it lies over the plane as it
//! should, and then it is the answer.

use super::memory::obtainable;
use super::{
    Found, Method, Terms, TriangulateError, TriangulateOptions, Triangulation, holes, if_it_fits,
    is_bounded, memory_needed, optimal, outcome, warm_start,
};
use crate::cost::{Prices, quantised};
use crate::rung::Visibility;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::predicate::orientation;
use sheetwright_geometry::watch::Watch;

/// The cheapest triangulation, and what the search for it shows of others.
#[derive(Clone, Debug, PartialEq)]
pub struct Cheapest {
    /// The cheapest triangulation that the method and the supporting plane admit.
    pub triangulation: Triangulation,
    /// Whether it is that without the plane too, if the search has shown that.
    pub also_without_plane: Option<bool>,
    /// A triangulation whose rungs begin and end inside the projection, but do not all lie there,
    /// that was cheaper, if the search has come upon one or knows of one from before.
    pub astray: Option<Triangulation>,
}

/// What the cheapest triangulation is of those with more rungs than lie inside the projection.
pub(super) enum Looked {
    /// It lies over the plane as it should.
    Lies(Triangulation),
    /// It does not.
    Astray(Triangulation),
    /// There is none, or it was not looked for.
    None,
}

/// The cheapest triangulation of one loop among those with these rungs, which are all that lie
/// inside the projection and more; `known` is a triangulation that is known.
pub(super) fn solve_then_check(
    prices: &Prices,
    visibility: &Visibility,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    known: Option<&Triangulation>,
    watch: &mut dyn Watch,
) -> Result<Looked, TriangulateError> {
    if !may_ask_less(prices, options) {
        return Ok(Looked::None);
    }
    let terms = Terms::new(prices, visibility, false).within(options.memory_limit);
    let found = optimal::solve(&terms, warm_start::bound(&terms, known, watch)?, watch)?;
    Ok(match found {
        Some(triangles) => looked(plane, &terms, triangles, options.method),
        None => Looked::None,
    })
}

/// A triangulation that is `known`, mended where rungs only have to begin and end inside the
/// projection; `None` if it can't be mended, or if nothing is known.
pub(super) fn mended_at_ends(
    prices: &Prices,
    at_ends: &Visibility,
    known: Option<&Triangulation>,
) -> Option<Triangulation> {
    let terms = Terms::new(prices, at_ends, false);
    let triangles = warm_start::triangles(&terms, known)?;
    Some(outcome(&terms, Found { triangles, lower_bound: Some(0.0) }, Method::Optimal))
}

/// Whether the table of all rungs may be filled without asking which lie inside the projection.
pub(super) fn may_ask_less(prices: &Prices, options: &TriangulateOptions) -> bool {
    is_bounded(options) && prices.one_loop()
}

/// Whether the cheapest triangulation of those with more rungs than lie inside the projection is
/// that with the plane too: where its triangles all lie on the plane as they should, they do not
/// overlap, and their rungs lie inside. Then it is the cheapest of those too, and ties were decided
/// among the same.
fn looked(
    plane: Option<&SupportingPlane>,
    terms: &Terms<'_>,
    triangles: Vec<[usize; 3]>,
    method: Method,
) -> Looked {
    let lie = |plane: &SupportingPlane| {
        let at = |i: usize| plane.projected[i];
        triangles.iter().all(|&[i, k, j]| orientation(at(i), at(k), at(j)).is_gt())
    };
    let lies = plane.is_none_or(lie);
    let found = outcome(terms, Found { triangles, lower_bound: None }, method);
    if lies { Looked::Lies(found) } else { Looked::Astray(found) }
}

/// The cheapest triangulation of one loop, or the best that is found of a ring, any two samples
/// joined, if it costs less than `limit`; only those count whose rungs all have tangent planes.
/// `None` as well where the table that would tell does not fit the memory. What a triangulation
/// costs that is `known` from before is a bound, on which the answer does not depend, unless it
/// makes the table small enough for the memory.
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
    let prices = Prices::new(boundary, None, options.price);
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
