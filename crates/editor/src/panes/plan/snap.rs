//! Snapping: where the hand seems to want to go.
//!
//! In order: onto another point; level or upright with a neighbour, both at once where they cross;
//! onto the mirror; onto the grid. What was snapped to is shown, so that nothing jumps unseen.

use crate::document::{Drawing, Mirror};
use sheetwright::math::Point2;

/// What a place was snapped to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Snap {
    /// A point.
    Point(Point2),
    /// The upright line through a point.
    Upright(Point2),
    /// The level line through a point.
    Level(Point2),
    /// The mirror.
    Mirror(Mirror),
    /// A crossing of the grid.
    Grid(Point2),
}

/// Snaps a place of the plan: `others` are points that it may settle on, `lines` those that it may
/// be level or upright with, `reach` is how far it may jump, mm.
pub(super) fn snapped(
    at: Point2,
    others: &[Point2],
    lines: &[Point2],
    drawing: &Drawing,
    reach: f64,
) -> (Point2, Vec<Snap>) {
    let near = |p: &&Point2| p.distance(at) <= reach;
    let nearest = |a: &&Point2, b: &&Point2| a.distance(at).total_cmp(&b.distance(at));
    if let Some(&other) = others.iter().filter(near).min_by(nearest) {
        return (other, vec![Snap::Point(other)]);
    }
    let mut to = at;
    let mut snaps = Vec::new();
    let mut is_held = [false; 2];
    let by_x = |p: &&Point2| (p.x - at.x).abs();
    let by_y = |p: &&Point2| (p.y - at.y).abs();
    let upright = lines.iter().filter(|p| by_x(p) <= reach);
    if let Some(p) = upright.min_by(|a, b| by_x(a).total_cmp(&by_x(b))) {
        to.x = p.x;
        is_held[0] = true;
        snaps.push(Snap::Upright(*p));
    }
    let level = lines.iter().filter(|p| by_y(p) <= reach);
    if let Some(p) = level.min_by(|a, b| by_y(a).total_cmp(&by_y(b))) {
        to.y = p.y;
        is_held[1] = true;
        snaps.push(Snap::Level(*p));
    }
    if let Some(mirror) = drawing.mirror {
        let (axis, value) = if mirror.upright { (0, at.x) } else { (1, at.y) };
        if !is_held[axis] && (value - mirror.at_mm).abs() <= reach {
            *(if mirror.upright { &mut to.x } else { &mut to.y }) = mirror.at_mm;
            is_held[axis] = true;
            snaps.push(Snap::Mirror(mirror));
        }
    }
    if drawing.snap_to_grid && is_held != [true; 2] {
        let on_grid = |x: f64| (x / drawing.grid_mm).round() * drawing.grid_mm;
        if !is_held[0] {
            to.x = on_grid(to.x);
        }
        if !is_held[1] {
            to.y = on_grid(to.y);
        }
        snaps.push(Snap::Grid(to));
    }
    (to, snaps)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_come_before_lines_and_lines_before_the_grid() {
        let drawing = Drawing { snap_to_grid: true, grid_mm: 10.0, ..Drawing::default() };
        let others = [Point2::new(50.0, 50.0)];
        let lines = [Point2::new(0.0, 33.0)];
        let (to, snaps) = snapped(Point2::new(51.0, 49.0), &others, &lines, &drawing, 2.0);
        assert_eq!((to, snaps.len()), (others[0], 1));
        let (to, snaps) = snapped(Point2::new(77.0, 32.0), &others, &lines, &drawing, 2.0);
        assert_eq!(to, Point2::new(80.0, 33.0));
        assert_eq!(snaps, [Snap::Level(lines[0]), Snap::Grid(to)]);
    }

    #[test]
    fn the_mirror_holds_what_comes_near() {
        let mirror = Mirror { upright: true, at_mm: 5.0 };
        let drawing = Drawing { mirror: Some(mirror), ..Drawing::default() };
        let (to, snaps) = snapped(Point2::new(6.0, 70.0), &[], &[], &drawing, 2.0);
        assert_eq!((to, snaps), (Point2::new(5.0, 70.0), vec![Snap::Mirror(mirror)]));
        let far = Point2::new(9.0, 70.0);
        assert_eq!(snapped(far, &[], &[], &drawing, 2.0), (far, vec![]));
    }
}
