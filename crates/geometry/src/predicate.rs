//! Exact orientation and crossing tests: topology is decided here, never by a tolerance.
//!
//! The answers are exact for the coordinates as they are stored (Shewchuk's adaptive predicates
//! \[Shewchuk1997\], from the crate `robust`).

mod cover;

use crate::math::{Point2, Point3, Vec3};
use std::cmp::Ordering;
use std::ops::Range;

fn coord(p: Point2) -> robust::Coord<f64> {
    robust::Coord { x: p.x, y: p.y }
}

fn coord3(p: Point3) -> robust::Coord3D<f64> {
    robust::Coord3D { x: p.x, y: p.y, z: p.z }
}

/// On which side of the line from `a` to `b` the point `c` lies: `Greater` on the left, `Less` on
/// the right, `Equal` on the line. Exact.
pub fn orientation(a: Point2, b: Point2, c: Point2) -> Ordering {
    robust::orient2d(coord(a), coord(b), coord(c)).total_cmp_zero()
}

/// On which side of the plane through `a`, `b`, `c` the point `d` lies: `Greater` where a, b, c
/// run counter-clockwise as seen from `d`, `Equal` in the plane. Exact.
pub fn orientation3(a: Point3, b: Point3, c: Point3, d: Point3) -> Ordering {
    // Shewchuk's sign is positive when d lies below the plane.
    robust::orient3d(coord3(a), coord3(b), coord3(c), coord3(d)).total_cmp_zero().reverse()
}

trait TotalCmpZero {
    fn total_cmp_zero(self) -> Ordering;
}

impl TotalCmpZero for f64 {
    fn total_cmp_zero(self) -> Ordering {
        self.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
    }
}

/// Whether the closed segments `a`–`b` and `c`–`d` have a point in common. Exact.
pub fn segments_touch(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    let (abc, abd) = (orientation(a, b, c), orientation(a, b, d));
    let (cda, cdb) = (orientation(c, d, a), orientation(c, d, b));
    if abc == Ordering::Equal && abd == Ordering::Equal {
        // All on one line, or a segment without length.
        return boxes_touch(a, b, c, d) && (cda == Ordering::Equal || cdb == Ordering::Equal);
    }
    abc != abd && cda != cdb
}

/// Whether the bounding boxes of two segments have a point in common.
fn boxes_touch(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    a.x.min(b.x) <= c.x.max(d.x)
        && c.x.min(d.x) <= a.x.max(b.x)
        && a.y.min(b.y) <= c.y.max(d.y)
        && c.y.min(d.y) <= a.y.max(b.y)
}

/// The first pair of edges of a closed polygon, in order, that touch without being neighbours, or
/// that are neighbours folded back on one another; `None` for a simple polygon. Edge `i` runs from
/// corner `i` to corner `i + 1`. Exact; time O(m log m) for polygons as people
/// draw them, O(m²) at worst.
pub fn first_crossing(polygon: &[Point2]) -> Option<(usize, usize)> {
    first_crossing_of_loops(polygon, std::slice::from_ref(&(0..polygon.len())))
}

/// The first pair of edges of several closed polygons together, in order, that touch without being
/// neighbours, or that are neighbours folded back on one another; `None` if there is none. The
/// corners follow one another in `points`; those of each polygon are the numbers in one of `loops`.
pub fn first_crossing_of_loops(
    points: &[Point2],
    loops: &[Range<usize>],
) -> Option<(usize, usize)> {
    let mut next: Vec<usize> = (1..=points.len()).collect();
    for of_loop in loops.iter().filter(|of_loop| !of_loop.is_empty()) {
        next[of_loop.end - 1] = of_loop.start;
    }
    let edge = |i: usize| (points[i], points[next[i]]);
    let boxes: Vec<(Vec3, Vec3)> = (0..points.len())
        .map(|i| {
            let (a, b) = (edge(i).0.to_vec().extend(0.0), edge(i).1.to_vec().extend(0.0));
            (a.min(b), a.max(b))
        })
        .collect();
    let mut first: Option<(usize, usize)> = None;
    for_touching_boxes(&boxes, |i, j| {
        let ((a, b), (c, d)) = (edge(i), edge(j));
        let crossing = if next[i] == j {
            folded_back(a, b, d)
        } else if next[j] == i {
            folded_back(c, d, b)
        } else {
            segments_touch(a, b, c, d)
        };
        if crossing && first.is_none_or(|best| (i, j) < best) {
            first = Some((i, j));
        }
    });
    first
}

/// Two edges where a sheet overlaps itself, whose border are these closed lines; it lies on their
/// left. Returns the first two edges that cross or touch, or else an edge of a line on whose left
/// the sheet does not lie exactly once, and one beside it; `None` if the sheet covers no point
/// twice. Exact.
pub fn first_overlap_of_loops(points: &[Point2], loops: &[Range<usize>]) -> Option<(usize, usize)> {
    first_crossing_of_loops(points, loops).or_else(|| cover::first_not_covered_once(points, loops))
}

/// Whether a point lies inside a closed polygon that does not touch it: on which side of the
/// polygon a ray leaves it. Exact.
pub fn inside(polygon: &[Point2], p: Point2) -> bool {
    let m = polygon.len();
    let crossed = |a: Point2, b: Point2| {
        let upwards = a.y <= p.y && p.y < b.y;
        let downwards = b.y <= p.y && p.y < a.y;
        (upwards && orientation(a, b, p) == Ordering::Greater)
            || (downwards && orientation(a, b, p) == Ordering::Less)
    };
    (0..m).filter(|&i| crossed(polygon[i], polygon[(i + 1) % m])).count() % 2 == 1
}

/// Whether b–c runs back over a–b.
fn folded_back(a: Point2, b: Point2, c: Point2) -> bool {
    orientation(a, b, c) == Ordering::Equal && (a - b).dot(c - b) >= 0.0
}

/// An axis-parallel box in a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box2 {
    /// Smallest coordinates.
    pub min: Point2,
    /// Largest coordinates.
    pub max: Point2,
}

impl Box2 {
    /// The box around a segment.
    pub fn of_segment(a: Point2, b: Point2) -> Self {
        Self {
            min: Point2::new(a.x.min(b.x), a.y.min(b.y)),
            max: Point2::new(a.x.max(b.x), a.y.max(b.y)),
        }
    }

    /// The box around some points; `None` without any.
    pub fn of_points(points: impl IntoIterator<Item = Point2>) -> Option<Self> {
        points.into_iter().map(|p| Self { min: p, max: p }).reduce(|a, b| Self {
            min: Point2::new(a.min.x.min(b.min.x), a.min.y.min(b.min.y)),
            max: Point2::new(a.max.x.max(b.max.x), a.max.y.max(b.max.y)),
        })
    }

    /// The part of the segment from `a` to `b`, which are finite, that lies in the box, sides
    /// included, as two parameters in 0 ..= 1; `None` if the segment passes beside it. By the
    /// method of Liang and Barsky, one side of the box after the other. Not exact: rounding decides
    /// whether a segment touches a corner.
    pub fn part_inside(&self, a: Point2, b: Point2) -> Option<[f64; 2]> {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (way, low, high) in [
            (b.x - a.x, self.min.x - a.x, self.max.x - a.x),
            (b.y - a.y, self.min.y - a.y, self.max.y - a.y),
        ] {
            if low > way.max(0.0) || high < way.min(0.0) {
                return None;
            }
            if way != 0.0 {
                let (enter, leave) = (low / way, high / way);
                from = from.max(enter.min(leave));
                to = to.min(enter.max(leave));
            }
        }
        (from <= to).then_some([from, to])
    }
}

/// Calls `visit(i, j)` with i < j for every two boxes, given by their smallest and largest
/// coordinates, that touch.
pub fn for_touching_boxes(boxes: &[(Vec3, Vec3)], mut visit: impl FnMut(usize, usize)) {
    any_touching_boxes(boxes, |i, j| {
        visit(i, j);
        false
    });
}

/// Whether `holds(i, j)`, with i < j, for some two boxes that touch: a sweep along the axis that
/// they spread over farthest, which stops there.
pub fn any_touching_boxes(
    boxes: &[(Vec3, Vec3)],
    mut holds: impl FnMut(usize, usize) -> bool,
) -> bool {
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    let low = boxes.iter().fold(Vec3::INFINITY, |low, b| low.min(b.0));
    let high = boxes.iter().fold(Vec3::NEG_INFINITY, |high, b| high.max(b.0));
    let spread = high - low;
    let axis = (1..3).fold(0, |best, axis| if spread[axis] > spread[best] { axis } else { best });
    order.sort_by(|&i, &j| boxes[i].0[axis].total_cmp(&boxes[j].0[axis]).then(i.cmp(&j)));
    let mut open: Vec<usize> = Vec::new();
    for &i in &order {
        open.retain(|&j| boxes[j].1[axis] >= boxes[i].0[axis]);
        for &j in &open {
            let touch = (boxes[i].0.cmple(boxes[j].1) & boxes[j].0.cmple(boxes[i].1)).all();
            if touch && holds(i.min(j), i.max(j)) {
                return true;
            }
        }
        open.push(i);
    }
    false
}

/// Twice the signed area of a closed polygon, mm²: positive when it runs counter-clockwise.
pub fn signed_area_doubled(polygon: &[Point2]) -> f64 {
    let Some(&origin) = polygon.first() else { return 0.0 };
    let m = polygon.len();
    (0..m).map(|i| (polygon[i] - origin).perp_dot(polygon[(i + 1) % m] - origin)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point2 {
        Point2::new(x, y)
    }

    #[test]
    fn loops_cross_and_contain_one_another() {
        let square = |x: f64, y: f64, r: f64| {
            [p(x - r, y - r), p(x + r, y - r), p(x + r, y + r), p(x - r, y + r)]
        };
        let outer = square(0.0, 0.0, 4.0);
        let together = |hole: [Point2; 4]| {
            let points: Vec<Point2> = outer.iter().chain(&hole).copied().collect();
            first_crossing_of_loops(&points, &[0..4, 4..8])
        };
        assert_eq!(together(square(1.0, 1.0, 1.0)), None);
        assert_eq!(together(square(4.0, 0.0, 1.0)), Some((1, 4)));
        for (at, is_inside) in [(p(1.0, 1.0), true), (p(5.0, 0.0), false), (p(-5.0, -4.0), false)] {
            assert_eq!(inside(&outer, at), is_inside);
        }
    }

    #[test]
    fn orientation_is_exact_where_rounding_is_not() {
        let (a, b) = (p(12.0, 12.0), p(24.0, 24.0));
        assert_eq!(orientation(a, b, p(0.5, 0.5)), Ordering::Equal);
        let nudge = f64::EPSILON / 2.0;
        assert_eq!(orientation(a, b, p(0.5, 0.5 + nudge)), Ordering::Greater);
        assert_eq!(orientation(a, b, p(0.5, 0.5 - nudge)), Ordering::Less);
    }

    #[test]
    fn segments_touch_at_ends_and_on_lines() {
        assert!(segments_touch(p(0.0, 0.0), p(1.0, 0.0), p(1.0, 0.0), p(2.0, 5.0)));
        assert!(segments_touch(p(0.0, 0.0), p(2.0, 0.0), p(1.0, 0.0), p(3.0, 0.0)));
        assert!(!segments_touch(p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(3.0, 0.0)));
        assert!(!segments_touch(p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0), p(1.0, 1.0)));
    }

    #[test]
    fn simple_polygons_and_others() {
        let square = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)];
        assert_eq!(first_crossing(&square), None);
        let bow = [p(0.0, 0.0), p(1.0, 1.0), p(1.0, 0.0), p(0.0, 1.0)];
        assert_eq!(first_crossing(&bow), Some((0, 2)));
        let spike = [p(0.0, 0.0), p(2.0, 0.0), p(1.0, 0.0), p(1.0, 1.0)];
        assert_eq!(first_crossing(&spike), Some((0, 1)));
        let straight_run = [p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(1.0, 1.0)];
        assert_eq!(first_crossing(&straight_run), None);
    }

    #[test]
    fn a_segment_crosses_a_box_or_passes_its_corner() {
        let square = Box2 { min: p(0.0, 0.0), max: p(1.0, 1.0) };
        assert_eq!(square.part_inside(p(-1.0, 0.5), p(3.0, 0.5)), Some([0.25, 0.5]));
        assert_eq!(square.part_inside(p(3.0, 0.5), p(-1.0, 0.5)), Some([0.5, 0.75]));
        assert_eq!(square.part_inside(p(0.2, 0.2), p(0.3, 0.2)), Some([0.0, 1.0]));
        // Along a side, at one end, and a segment without length.
        assert_eq!(square.part_inside(p(1.0, -1.0), p(1.0, 1.0)), Some([0.5, 1.0]));
        assert_eq!(square.part_inside(p(1.0, 0.5), p(2.0, 0.5)), Some([0.0, 0.0]));
        assert_eq!(square.part_inside(p(0.5, 0.5), p(0.5, 0.5)), Some([0.0, 1.0]));
        assert_eq!(square.part_inside(p(0.5, 1.5), p(0.5, 1.5)), None);
        // Past a corner, beside a side, and short of one.
        assert_eq!(square.part_inside(p(-1.0, 0.5), p(0.5, 2.1)), None);
        assert_eq!(square.part_inside(p(2.0, -1.0), p(2.0, 3.0)), None);
        assert_eq!(square.part_inside(p(-2.0, 0.5), p(-1.0, 0.5)), None);
    }

    #[test]
    fn a_segment_is_in_a_box_where_an_end_is_or_where_it_crosses_a_side() {
        let square = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)];
        let around = Box2 { min: square[0], max: square[2] };
        // Away from the corners, where rounding decides: multiples of irrational numbers.
        let spread = |n: u32, by: f64| (f64::from(n) * by).fract() * 3.0 - 1.0;
        let mut found = [0, 0];
        for n in 0..2000 {
            let a = p(spread(n, 0.618_033_988_75), spread(n, 0.414_213_562_37));
            let b = p(spread(n, 0.732_050_807_57), spread(n, 0.236_067_977_5));
            let crosses = (0..4).any(|n| segments_touch(a, b, square[n], square[(n + 1) % 4]));
            let part = around.part_inside(a, b);
            assert_eq!(part.is_some(), crosses || inside(&square, a), "{a:?} {b:?}");
            found[usize::from(part.is_some())] += 1;
            for share in part.into_iter().flatten().filter(|share| 0.0 < *share && *share < 1.0) {
                let at = a.lerp(b, share);
                let off = square.map(|corner| (at.x - corner.x).abs().min((at.y - corner.y).abs()));
                assert!(off.iter().any(|off| *off < 1e-12), "{at:?}");
            }
        }
        assert!(found.iter().all(|count| *count > 300), "{found:?}");
    }

    #[test]
    fn the_third_dimension_is_seen_from_d() {
        let (a, b, c) =
            (Point3::new(0.0, 0.0, 0.0), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0));
        assert_eq!(orientation3(a, b, c, Point3::new(0.0, 0.0, 1.0)), Ordering::Greater);
        assert_eq!(orientation3(a, b, c, Point3::new(0.0, 0.0, -1.0)), Ordering::Less);
        assert_eq!(orientation3(a, b, c, Point3::new(5.0, 5.0, 0.0)), Ordering::Equal);
    }
}
