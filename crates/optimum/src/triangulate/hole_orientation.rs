//! The orientation of holes.
//!
//! A hole must run the other way round than the outer loop, as seen from the side that the surface
//! faces; drawings have it either way. On a supporting plane the sign of its area decides. Without
//! one, as at the two ends of a tube, each orientation bounds another surface, and the cheaper one
//! is meant: a tube rather than a surface that passes through itself. That is decided on a few of
//! the samples, with a share of the work limit. Where the share ends early, the other holes keep
//! their orientation.

use super::holes::{Tally, Work};
use super::part::Part;
use super::{Terms, TriangulateError, TriangulateOptions, holes};
use crate::cost::{PriceOptions, Prices};
use crate::rung::Visibility;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::predicate::signed_area_doubled;
use sheetwright_geometry::watch::Watch;

/// About so many samples of each loop decide.
const FEW: usize = 16;
/// The share of the work that the choice may take.
const SHARE: f64 = 0.25;

/// The boundary with those holes turned that run the wrong way. `plane` is the supporting plane, if
/// there is one.
///
/// # Errors
/// [`TriangulateError::Stopped`] if the watch stops it.
pub fn with_holes_facing(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    watch: &mut dyn Watch,
) -> Result<Boundary, TriangulateError> {
    let holes = 1..=boundary.holes();
    if let Some(plane) = plane {
        let turned = |hole: &usize| {
            signed_area_doubled(&plane.projected[boundary.loops()[*hole].clone()]) > 0.0
        };
        let wrong = holes.filter(turned);
        return Ok(wrong.fold(boundary.clone(), |turned, hole| turned.with_hole_turned(hole)));
    }
    // Progress is reported for the search that follows, not for this one.
    let watch = &mut Part::silent(watch);
    let mut few = boundary.thinned(FEW);
    let mut turned = vec![false; boundary.holes() + 1];
    let tally = Tally::default();
    let work = Work::new(&tally, options.work_limit).part(SHARE);
    let left = |hole: usize| 1.0 / (boundary.holes() + 1 - hole) as f64;
    // Each hole with the outer loop alone, then, where there are several, each among all others.
    for hole in holes.clone() {
        let drawn = few.with_holes(&[hole]);
        let part = work.part(0.5 * left(hole));
        if is_cheaper(&drawn.with_hole_turned(1), &drawn, options.price, part, watch)? {
            few = few.with_hole_turned(hole);
            turned[hole] = !turned[hole];
        }
    }
    if boundary.holes() > 1 {
        for hole in holes.clone() {
            let other = few.with_hole_turned(hole);
            let part = work.part(left(hole));
            if part.left() < least_work(few.len() + 2 * few.holes()) {
                break;
            }
            if is_cheaper(&other, &few, options.price, part, watch)? {
                few = other;
                turned[hole] = !turned[hole];
            }
        }
    }
    let wrong = holes.filter(|&hole| turned[hole]);
    Ok(wrong.fold(boundary.clone(), |turned, hole| turned.with_hole_turned(hole)))
}

/// Whether the surface of one boundary is cheaper than that of another.
fn is_cheaper(
    one: &Boundary,
    other: &Boundary,
    price: PriceOptions,
    work: Work<'_>,
    watch: &mut dyn Watch,
) -> Result<bool, TriangulateError> {
    // A tube through itself is slow to search, so the one whose first triangulation is cheaper goes
    // first, and the other is searched up to its price.
    let guess = |boundary: &Boundary, watch: &mut dyn Watch| {
        let work = work.part(SHARE);
        with_terms(boundary, price, |terms| holes::guess(terms, boundary.loops(), work, watch))
    };
    let one_first = guess(one, watch)? < guess(other, watch)?;
    let (first, second) = if one_first { (one, other) } else { (other, one) };
    let least = |boundary: &Boundary, bound: f64, work: Work<'_>, watch: &mut dyn Watch| {
        with_terms(boundary, price, |terms| {
            holes::good_price(terms, boundary.loops(), bound, work, watch)
        })
    };
    let first_price = least(first, f64::INFINITY, work.part(0.5), watch)?;
    let second_price = least(second, first_price, work, watch)?;
    Ok(if one_first { first_price < second_price } else { second_price < first_price })
}

/// Lower bound on the work of comparing two boundaries, steps: two tables each, of so many places.
fn least_work(places: usize) -> u64 {
    4 * (places as u64).pow(3) / 6
}

fn with_terms<T>(
    boundary: &Boundary,
    price: PriceOptions,
    what: impl FnOnce(&Terms<'_>) -> T,
) -> T {
    let prices = Prices::new(boundary, None, price);
    let visibility = Visibility::new(boundary, None);
    what(&Terms::new(&prices, &visibility, true))
}
