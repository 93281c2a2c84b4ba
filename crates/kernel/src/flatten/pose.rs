//! How a pattern lies: in the rectangle of least area around it.
//!
//! One side of that rectangle lies along a side of the convex hull \[FreemanShapira1975\]; all are
//! tried, and as the sides turn, the corners that the rectangle touches only move on. The longer
//! side is laid along x and the lower left corner at the origin, so that a pattern needs as little
//! sheet as can be and its size can be read off.

use sheetwright_geometry::math::{Point2, Vec2, unit2};
use sheetwright_geometry::predicate::{Box2, orientation};
use std::ops::Range;

/// Sizes are rounded by this share of those that they may have.
const ROUNDING: f64 = 1e-9;

/// The points turned and moved, not mirrored, so that those of the loop lie as told above.
pub(crate) fn posed(points: &[Point2], of_loop: &Range<usize>) -> Vec<Point2> {
    let along = least_rectangle(&points[of_loop.clone()]).1;
    let laid: Vec<Point2> = points.iter().map(turned(along)).collect();
    let origin = Box2::of_points(laid[of_loop.clone()].iter().copied())
        .map_or(Vec2::ZERO, |b| b.min.to_vec());
    laid.into_iter().map(|p| p + -origin).collect()
}

/// Whether points that are laid so lie within a rectangle of this width and height, mm, either way
/// round.
pub(crate) fn fits_in(points: &[Point2], within_mm: [f64; 2]) -> bool {
    is_no_larger(least_rectangle(points).0, within_mm, ROUNDING)
}

/// Whether points that are laid so lie within a rectangle of this width and height, mm, either way
/// round, with others that are no farther from them than `reach_mm`.
pub(crate) fn fits_in_with(
    points: &[Point2],
    (reach_mm, others): (f64, impl FnOnce() -> Vec<Point2>),
    within_mm: [f64; 2],
) -> bool {
    let (size, along) = least_rectangle(points);
    let fits = |size: Vec2| is_no_larger(size, within_mm, ROUNDING);
    if !fits(size) || fits(size + Vec2::splat(2.0 * reach_mm)) {
        return fits(size);
    }
    let all = points.iter().copied().chain(others()).map(|p| turned(along)(&p));
    Box2::of_points(all).is_none_or(|around| fits(around.max - around.min))
}

/// Whether a size is no larger than a rectangle of this width and height, mm, either way round, but
/// for rounding by this share of both.
pub(crate) fn is_no_larger(size: Vec2, [width, height]: [f64; 2], rounding: f64) -> bool {
    let rounding_mm = rounding * (width + height);
    size.max_element() <= width.max(height) + rounding_mm
        && size.min_element() <= width.min(height) + rounding_mm
}

/// The direction of the longer side of the rectangle of least area around some points.
pub(crate) fn long_side(points: &[Point2]) -> Vec2 {
    least_rectangle(points).1
}

/// A point by its coordinates along a direction and across it.
fn turned(along: Vec2) -> impl Fn(&Point2) -> Point2 {
    let across = along.perp();
    move |p: &Point2| Point2::new(p.to_vec().dot(along), p.to_vec().dot(across))
}

/// The size of the rectangle of least area around some points, its longer side first, mm, and the
/// direction of that side.
fn least_rectangle(points: &[Point2]) -> (Vec2, Vec2) {
    let hull = convex_hull(points);
    let mut best: Option<(Vec2, Vec2)> = None;
    // The corners that lie farthest along, across and back.
    let mut farthest = [0; 3];
    for (n, corner) in hull.iter().enumerate() {
        let Some(along) = unit2(hull[(n + 1) % hull.len()] - *corner) else { continue };
        for (n, way) in [along, along.perp(), -along].into_iter().enumerate() {
            let from = if n == 0 { farthest[0] } else { farthest[n].max(farthest[n - 1]) };
            farthest[n] = climb(&hull, from, way);
        }
        let touched = farthest.iter().map(|&n| hull[n % hull.len()]).chain([*corner]);
        let Some(around) = Box2::of_points(touched.map(|p| turned(along)(&p))) else { continue };
        let size = around.max - around.min;
        // Equal areas, as the sides of a rectangle give, must not be told apart by rounding.
        if best.is_none_or(|(b, _)| size.x * size.y < b.x * b.y * (1.0 - 1e-9)) {
            best = Some(if size.x >= size.y {
                (size, along)
            } else {
                (Vec2::new(size.y, size.x), -along.perp())
            });
        }
    }
    best.unwrap_or((Vec2::ZERO, Vec2::X))
}

/// From corner to corner of a hull, as far as they lie farther and farther along; corners are
/// counted on round it.
fn climb(hull: &[Point2], from: usize, along: Vec2) -> usize {
    let height = |n: usize| hull[n % hull.len()].to_vec().dot(along);
    let goes_on = |n: &usize| height(n + 1) < height(*n);
    (from..from + hull.len()).find(goes_on).unwrap_or(from)
}

/// The corners of the convex hull, counter-clockwise (Andrew's monotone chain).
pub(crate) fn convex_hull(points: &[Point2]) -> Vec<Point2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = Point2>| {
        let mut hull: Vec<Point2> = Vec::new();
        for p in points {
            while let [.., a, b] = hull[..] {
                if orientation(a, b, p).is_gt() {
                    break;
                }
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
        hull
    };
    let mut hull = chain(&mut sorted.iter().copied());
    hull.extend(chain(&mut sorted.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilted_rectangle_is_laid_straight() {
        let (c, s) = (0.8, 0.6);
        let tilted = [[0.0, 0.0], [2.0, 0.0], [2.0, 5.0], [0.0, 5.0], [1.0, 3.0]]
            .map(|[x, y]| Point2::new(7.0 + c * x - s * y, -3.0 + s * x + c * y));
        let laid = posed(&tilted, &(0..5));
        let around = Box2::of_points(laid.iter().copied()).unwrap();
        assert!(around.min.to_vec().length() < 1e-12);
        assert!((around.max.x - 5.0).abs() < 1e-12 && (around.max.y - 2.0).abs() < 1e-12);
        let turn = (laid[1] - laid[0]).perp_dot(laid[2] - laid[1]);
        assert!((turn - 10.0).abs() < 1e-12, "turned, not mirrored");
    }
}
