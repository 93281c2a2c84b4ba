//! Round holes inside the net line.

use crate::pattern::{PathKind, PatternPath, Role};
use sheetwright_geometry::math::{Point2, Vec2, cos, from_deg, sin};

/// A circle is drawn with as many sides.
const SIDES: u16 = 24;

/// A hole around a point.
pub(crate) fn drilled(at: Point2, diameter_mm: f64) -> PatternPath {
    PatternPath {
        role: Role::Drill,
        kind: PathKind::Drill { diameter_mm },
        points: circle(at, 0.5 * diameter_mm, SIDES),
        closed: true,
    }
}

/// A polygon of this many sides on a circle, clockwise.
pub(super) fn circle(at: Point2, radius: f64, sides: u16) -> Vec<Point2> {
    let corner = |n: u16| {
        let angle = -from_deg(360.0 * f64::from(n) / f64::from(sides));
        at + Vec2::new(cos(angle), sin(angle)) * radius
    };
    (0..sides).map(corner).collect()
}

/// The distance of a point from closed lines, mm.
pub(super) fn distance_mm(at: Point2, lines: &[Vec<Point2>]) -> f64 {
    let of_side =
        |line: &[Point2], n: usize| at.distance_to_segment([line[n], line[(n + 1) % line.len()]]);
    let of_line = |line: &Vec<Point2>| {
        (0..line.len()).map(|n| of_side(line, n)).fold(f64::INFINITY, f64::min)
    };
    lines.iter().map(of_line).fold(f64::INFINITY, f64::min)
}
