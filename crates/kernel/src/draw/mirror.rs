//! Curves and their images in a mirror, given by the function `reflect`: usually a plane.

use super::edit::{EditError, built, with_points};
use crate::design::DesignCurve;
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, Vec3, angle_between, from_deg};

/// A curve that meets its image at a smaller turn, degrees, is meant to run on smoothly: a hand is
/// no more exact than that.
const SMOOTH_DEG: f64 = 25.0;
/// The part of a span over which the direction of its image is found.
const SHORT: f64 = 1e-3;

/// The image of a curve, run from the image of its first point.
pub fn mirrored(curve: &DesignCurve, reflect: impl Fn(Point3) -> Point3) -> DesignCurve {
    let points = curve.points.iter().map(|p| CurvePoint { at: reflect(p.at), ..*p }).collect();
    DesignCurve { points, ..curve.clone() }
}

/// An open half and its image as one closed, symmetrical curve. Both ends of the half must lie
/// within `within_mm` of the mirror; `onto` moves them exactly on it. Where the half meets the
/// mirror nearly at right angles, the curve runs on smoothly; else, or where the end is a corner
/// already, it has a corner.
///
/// # Errors
/// A closed curve, ends that are off the mirror, or no points between them.
pub fn closed_by_mirror(
    half: &DesignCurve,
    reflect: impl Fn(Point3) -> Point3,
    onto: impl Fn(Point3) -> Point3,
    within_mm: f64,
) -> Result<DesignCurve, EditError> {
    if half.closed {
        return Err(EditError::Closed { curve: half.name.clone() });
    }
    let m = half.points.len();
    if m < 3 {
        return Err(EditError::TooFewLeft { needed: 3 });
    }
    let mut points = half.points.clone();
    for end in [0, m - 1] {
        let on = onto(points[end].at);
        let off_mm = on.distance(points[end].at);
        if off_mm > within_mm {
            return Err(EditError::OffMirror { off_mm, within_mm });
        }
        points[end].at = on;
    }
    let made = built(&DesignCurve { points: points.clone(), ..half.clone() })?;
    let spans = made.spans();
    let turn = |end: Point3, along: Vec3| {
        // From the end back along the curve, and on along its image.
        let image = reflect(end + along) - reflect(end);
        angle_between(-along, image)
    };
    let (first, last) = (spans[0], spans[spans.len() - 1]);
    let turns = [
        turn(points[0].at, first.position(SHORT) - first.position(0.0)),
        turn(points[m - 1].at, last.position(1.0 - SHORT) - last.position(1.0)),
    ];
    for (end, turn) in [0, m - 1].into_iter().zip(turns) {
        points[end].corner |= turn > from_deg(SMOOTH_DEG);
    }
    let images: Vec<CurvePoint> =
        points[1..m - 1].iter().rev().map(|p| CurvePoint { at: reflect(p.at), ..*p }).collect();
    points.extend(images);
    with_points(&DesignCurve { closed: true, ..half.clone() }, points)
}

/// The point of `other`, which may be the same curve, that is the image of point `point` of `curve`
/// within `within_mm`: the nearest, the first of equals. A point on the mirror is its own image.
pub fn mirror_partner(
    curve: &DesignCurve,
    point: usize,
    other: &DesignCurve,
    reflect: impl Fn(Point3) -> Point3,
    within_mm: f64,
) -> Option<usize> {
    let image = reflect(curve.points.get(point)?.at);
    let off = |i: &usize| other.points[*i].at.distance(image);
    let nearest = (0..other.points.len()).min_by(|a, b| off(a).total_cmp(&off(b)))?;
    (off(&nearest) <= within_mm).then_some(nearest)
}
