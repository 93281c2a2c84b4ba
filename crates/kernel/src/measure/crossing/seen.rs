//! A look at a surface as a whole, from afar.
//!
//! Seen along some direction, a point lies in as many triangles that turn one way, less those that
//! turn the other, as the boundary winds around it, since the two triangles at a rung run along it
//! in opposite directions. So if all triangles turn the same way and the boundary is a simple
//! polygon, each point lies in one triangle at the most, and none crosses another.
//!
//! A panel that lies over the plane of its area vector, which is its supporting plane unless
//! another is asked for, is like that as seen along it. The coordinate axis nearest to it is tried
//! first: seen along an axis, coordinates are only left out, so exact predicates of the plane
//! decide. Seen along any other direction they are rounded, so there only what holds by more than
//! rounding counts.

use super::{Plane, seen_along};
use crate::surface::Surface;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Frame, Point2, Point3, Vec3};
use sheetwright_geometry::predicate::{any_touching_boxes, first_crossing, orientation};
use std::cmp::Ordering;

/// What rounding may make of the coordinates of a projection, as a share of how far its points lie
/// from its origin: more than a hundred times what the dozen sums and products in each can come to.
const ROUNDING: f64 = 1e-12;

/// Whether, seen along its area vector or the axis nearest to that, all triangles of a surface with
/// one loop certainly turn the same way and its boundary is certainly a simple polygon.
pub(super) fn is_simple_as_seen(surface: &Surface) -> bool {
    // All samples are looked at as one polygon.
    let of_all = 0..surface.positions().len();
    if surface.connectivity().loops() != [of_all] {
        return false;
    }
    let numbers = (0..surface.connectivity().triangles().len()).map(TriangleIndex::new);
    let area_vector = numbers.fold(Vec3::ZERO, |sum, t| sum + surface.area_vector(t));
    is_simple_along_axis(surface, area_vector) || is_simple_along(surface, area_vector)
}

/// Whether, seen along the axis nearest to a direction, all triangles turn the same way and the
/// boundary is a simple polygon. Exact.
pub(super) fn is_simple_along_axis(surface: &Surface, direction: Vec3) -> bool {
    let flat = seen_along(direction);
    let seen: Vec<Point2> = surface.positions().iter().map(|&p| flat(p)).collect();
    let exact = |[a, b, c]: [usize; 3]| Some(orientation(seen[a], seen[b], seen[c]));
    all_turn_alike(surface, exact) && first_crossing(&seen).is_none()
}

/// Whether, seen along a direction, all triangles turn the same way and the boundary is a simple
/// polygon; `false` as well where rounding leaves it open.
pub(super) fn is_simple_along(surface: &Surface, direction: Vec3) -> bool {
    let positions = surface.positions();
    let certain =
        |[a, b, c]: [usize; 3]| turn(direction, [positions[a], positions[b], positions[c]]);
    let Some(frame) = Frame::with_normal(positions[0], direction) else { return false };
    if !all_turn_alike(surface, certain) {
        return false;
    }
    let seen: Vec<Point2> = positions.iter().map(|&p| frame.project(p)).collect();
    let farthest = positions.iter().map(|p| p.distance(frame.origin)).fold(0.0, f64::max);
    let margin = ROUNDING * farthest;
    let next = |i: usize| (i + 1) % seen.len();
    let boxes: Vec<(Vec3, Vec3)> = (0..seen.len())
        .map(|i| {
            let [a, b] = [seen[i], seen[next(i)]].map(|p| p.to_vec().extend(0.0));
            (a.min(b) - Vec3::splat(margin), a.max(b) + Vec3::splat(margin))
        })
        .collect();
    let is_same =
        |a: Option<Ordering>, b: Option<Ordering>| a == b && a.is_some_and(Ordering::is_ne);
    let may_meet = |i: usize, j: usize| {
        let (a, b, c, d) = (i, next(i), j, next(j));
        if b == c {
            return may_fold_back([a, b, d], certain, &seen, margin);
        }
        if d == a {
            return may_fold_back([c, d, b], certain, &seen, margin);
        }
        !is_same(certain([a, b, c]), certain([a, b, d]))
            && !is_same(certain([c, d, a]), certain([c, d, b]))
    };
    !any_touching_boxes(&boxes, may_meet)
}

fn all_turn_alike(surface: &Surface, turn: impl Fn([usize; 3]) -> Option<Ordering>) -> bool {
    let triangles = surface.connectivity().triangles().iter();
    let mut turns = triangles.map(|corners| turn(corners.map(SampleIndex::get)));
    let first = turns.next().flatten().filter(|turn| turn.is_ne());
    first.is_some() && turns.all(|turn| turn == first)
}

/// Whether the edge from b to c may run back over that from a to b.
fn may_fold_back(
    [a, b, c]: [usize; 3],
    turn: impl Fn([usize; 3]) -> Option<Ordering>,
    seen: &[Point2],
    margin: f64,
) -> bool {
    if turn([a, b, c]).is_some_and(Ordering::is_ne) {
        return false;
    }
    let (back, on) = (seen[a] - seen[b], seen[c] - seen[b]);
    back.dot(on) >= -4.0 * margin * (back.length() + on.length())
}

/// Which way three points turn as seen against a direction: `Greater` counter-clockwise. `None`
/// where rounding leaves it open.
fn turn(direction: Vec3, [a, b, c]: [Point3; 3]) -> Option<Ordering> {
    Plane::new(b - a, c - a).certain_side(direction)
}
