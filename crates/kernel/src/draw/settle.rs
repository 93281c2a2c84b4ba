//! Points drawn onto existing points.
//!
//! A plan does not show how far a point is lifted. A curve drawn from an existing point means that
//! point: the new point takes its whole position in space, bit by bit, so that the curves meet in
//! space, too, and move together from then on.

use super::edit::{EditError, insert_point, nearest, with_points};
use crate::design::DesignCurve;
use sheetwright_geometry::math::{Point2, Point3};

/// A shared point replaces a fitted one within this share of the distance to its neighbours;
/// farther off, the curve gets another point.
const TAKES: f64 = 0.35;

/// The point that `project` puts exactly at a place of the plan; of several the one with the
/// greatest `lift`, which lies on top in the plan. `None` if there is no such point.
pub fn point_at(
    points: impl Iterator<Item = Point3>,
    place: Point2,
    project: impl Fn(Point3) -> Point2,
    lift: impl Fn(Point3) -> f64,
) -> Option<Point3> {
    let on_it = points.filter(|&p| project(p) == place);
    on_it.max_by(|a, b| lift(*a).total_cmp(&lift(*b)))
}

/// A drawn curve that begins at `start` and ends at `end`, as far as these are given. A closed
/// curve, which has no ends, gets a point at each.
///
/// # Errors
/// Points that make no curve.
pub fn settled(
    curve: &DesignCurve,
    [start, end]: [Option<Point3>; 2],
    project: impl Fn(Point3) -> Point2,
) -> Result<DesignCurve, EditError> {
    let mut settled = curve.clone();
    if curve.closed {
        for to in [start, end.filter(|_| end != start)].into_iter().flatten() {
            settled = through(&settled, to, &project)?;
        }
        return Ok(settled);
    }
    let ends = [settled.points.first().map(|_| 0), settled.points.len().checked_sub(1)];
    for (point, to) in ends.into_iter().zip([start, end]) {
        if let (Some(point), Some(to)) = (point, to) {
            settled.points[point].at = to;
        }
    }
    with_points(&settled, settled.points.clone())
}

/// A closed curve with a point at a place near it.
fn through(
    curve: &DesignCurve,
    to: Point3,
    project: &impl Fn(Point3) -> Point2,
) -> Result<DesignCurve, EditError> {
    let place = project(to);
    let m = curve.points.len();
    let at = |n: usize| project(curve.points[n % m].at);
    let by_distance =
        |a: &usize, b: &usize| at(*a).distance(place).total_cmp(&at(*b).distance(place));
    let Some(found) = (0..m).min_by(by_distance) else { return Ok(curve.clone()) };
    let room = at(found).distance(at(found + 1)).min(at(found).distance(at(found + m - 1)));
    let (mut settled, point) = if at(found).distance(place) <= TAKES * room {
        (curve.clone(), found)
    } else {
        insert_point(curve, &nearest(curve, place, project)?)?
    };
    settled.points[point].at = to;
    with_points(&settled, settled.points.clone())
}
