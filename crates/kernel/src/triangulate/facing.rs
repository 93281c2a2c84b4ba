//! Which way holes run.
//!
//! A hole must run the other way round than the outer loop, as seen from the side that the surface
//! faces; people draw it either way. On a supporting plane its area says which. Without one, as at
//! the two ends of a tube, each way bounds a surface of its own, and the cheaper one is meant: a
//! tube rather than one that passes through itself. That is decided on a few of the samples.

use super::{Method, TriangulateError, TriangulateOptions, triangulate};
use crate::boundary::Boundary;
use crate::boundary::SupportingPlane;
use crate::predicate::signed_area_doubled;
use crate::watch::Watch;

/// Samples of each loop that the choice is made on, about.
const FEW: usize = 24;

/// The boundary with those holes turned that run the wrong way. `plane` is the supporting plane, if
/// there is one.
///
/// # Errors
/// [`TriangulateError::Stopped`] if the watcher asks to stop.
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
    let options = TriangulateOptions { method: Method::Optimal, ..options.clone() };
    let mut price = |few: &Boundary| match triangulate(few, None, &options, watch) {
        Ok(found) => Ok(found.price),
        Err(TriangulateError::Stopped) => Err(TriangulateError::Stopped),
        Err(_) => Ok(f64::INFINITY),
    };
    let mut few = boundary.thinned(FEW);
    let mut turned = vec![false; boundary.holes() + 1];
    // Each hole with the outer loop alone, then, where there are several, each among all others.
    for hole in holes.clone() {
        let pair = few.with_holes(&[hole]);
        if price(&pair.with_hole_turned(1))? < price(&pair)? {
            few = few.with_hole_turned(hole);
            turned[hole] = !turned[hole];
        }
    }
    if boundary.holes() > 1 {
        let mut least = price(&few)?;
        for hole in holes.clone() {
            let other = few.with_hole_turned(hole);
            let tried = price(&other)?;
            if tried < least {
                (least, few) = (tried, other);
                turned[hole] = !turned[hole];
            }
        }
    }
    let wrong = holes.filter(|&hole| turned[hole]);
    Ok(wrong.fold(boundary.clone(), |turned, hole| turned.with_hole_turned(hole)))
}
