//! Dashed lines, of which only what can be seen is drawn: a handle far away, looked at closely, is
//! at the end of more dashes than fit into memory.

use eframe::egui::{Painter, Pos2, Rect, Shape, Stroke};
use sheetwright::math::Point2;
use sheetwright::predicate::Box2;

/// Lines end this far outside of what is seen, points.
const BEYOND: f32 = 20.0;

/// Draws a way through points with dashes and gaps of these lengths, points.
pub(super) fn dashed(painter: &Painter, way: &[Pos2], stroke: Stroke, dash: f32, gap: f32) {
    for run in runs(way, painter.clip_rect().expand(BEYOND)) {
        painter.extend(Shape::dashed_line(&run, stroke, dash, gap));
    }
}

/// The parts of a way inside of a rectangle.
fn runs(way: &[Pos2], within: Rect) -> Vec<Vec<Pos2>> {
    let mut runs: Vec<Vec<Pos2>> = Vec::new();
    for ends in way.windows(2) {
        let Some([from, to]) = clipped([ends[0], ends[1]], within) else { continue };
        match runs.last_mut() {
            Some(run) if run.last() == Some(&from) => run.push(to),
            _ => runs.push(vec![from, to]),
        }
    }
    runs
}

/// The part of a line inside of a rectangle.
fn clipped([from, to]: [Pos2; 2], within: Rect) -> Option<[Pos2; 2]> {
    if !(from.is_finite() && to.is_finite() && within.is_finite()) {
        return None;
    }
    let exact = |p: Pos2| Point2::new(f64::from(p.x), f64::from(p.y));
    let (from, to) = (exact(from), exact(to));
    let inside = Box2 { min: exact(within.min), max: exact(within.max) }.part_inside(from, to)?;
    Some(inside.map(|share| {
        let at = from + (to - from) * share;
        Pos2::new(at.x as f32, at.y as f32)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    const WITHIN: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(100.0, 50.0) };

    #[test]
    fn a_way_that_leaves_and_comes_back_has_two_parts() {
        let at = |x, y| pos2(x, y);
        let way = [at(10.0, 10.0), at(20.0, 10.0), at(20.0, 1e9), at(60.0, 1e9), at(60.0, 10.0)];
        let found = runs(&way, WITHIN);
        assert_eq!(found.len(), 2);
        assert_eq!(found[0], [at(10.0, 10.0), at(20.0, 10.0), at(20.0, 50.0)]);
        assert!(found[1][0].y < 60.0 && found[1][1] == at(60.0, 10.0), "{found:?}");
    }

    #[test]
    fn what_is_seen_of_a_line_stays_and_the_rest_goes() {
        let inside = [pos2(10.0, 10.0), pos2(90.0, 40.0)];
        assert_eq!(clipped(inside, WITHIN), Some(inside));
        let far = clipped([pos2(50.0, 25.0), pos2(1e12, 25.0)], WITHIN).unwrap();
        assert_eq!(far, [pos2(50.0, 25.0), pos2(100.0, 25.0)]);
        let through = clipped([pos2(-50.0, -25.0), pos2(150.0, 75.0)], WITHIN).unwrap();
        assert_eq!(through, [pos2(0.0, 0.0), pos2(100.0, 50.0)]);
        for unseen in [
            [pos2(-5.0, -5.0), pos2(-5.0, 500.0)],
            [pos2(200.0, 0.0), pos2(0.0, 200.0)],
            [pos2(f32::NAN, 0.0), pos2(1.0, 1.0)],
            [pos2(0.0, 0.0), pos2(f32::INFINITY, 1.0)],
        ] {
            assert_eq!(clipped(unseen, WITHIN), None, "{unseen:?}");
        }
    }
}
