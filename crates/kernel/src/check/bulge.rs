//! Splines that bulge beyond their points: where points only rise, or only fall, a line drawn with
//! a batten does, too, but a spline may swing beyond them, most of all in a span beside an end or a
//! tight bend.

use super::{Finding, FindingKind, Place};
use sheetwright_geometry::curve::{Curve, CurveKind, CurvePoint};
use sheetwright_geometry::math::{Point3, Vec3};

/// A spline may swing beyond its points by this share of the span.
const MOST: f64 = 0.01;
/// Each span is looked at in so many places.
const PLACES: usize = 16;

/// The finding that an open spline swings beyond its points between two of them, at the worst
/// place; `None` where it does not. `points` are those of the curve of this name.
pub(crate) fn spline_bulge(name: &str, points: &[CurvePoint]) -> Option<Finding> {
    let curve = Curve::new(CurveKind::Spline, points, false).ok()?;
    let stretches = curve.stretches();
    let spans = stretches.into_iter().flat_map(|stretch| {
        let (first, last) = (stretch.start, stretch.end);
        stretch.map(move |n| (n, [n.max(first + 1) - 1, n + 1], n + 2 - usize::from(n + 1 == last)))
    });
    let worst = spans.filter_map(|(n, [from, to], end)| {
        let around: Vec<Point3> = points[from..=end].iter().map(|point| point.at).collect();
        let span = curve.spans()[n];
        let limit = MOST * points[n].at.distance(points[to].at);
        let at_place = |k: usize| {
            let at = span.position(k as f64 / PLACES as f64);
            (at, beyond(&around, [points[n].at, points[to].at], at))
        };
        let (at, by_mm) = (1..PLACES).map(at_place).max_by(|a, b| a.1.total_cmp(&b.1))?;
        (by_mm > limit).then_some((n, at, by_mm))
    });
    let (n, at, by_mm) = worst.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let kind = FindingKind::SplineBulge { curve: name.to_owned(), at, by_mm };
    Some(Finding::new(kind, Place::CurvePoints { curve: name.to_owned(), numbers: vec![n, n + 1] }))
}

/// How far a point lies beyond the two ends of its span, mm, along the axes on which the points
/// around only rise or only fall.
fn beyond(around: &[Point3], ends: [Point3; 2], at: Point3) -> f64 {
    let coordinates = |p: Vec3| [p.x, p.y, p.z];
    let steps: Vec<[f64; 3]> =
        around.windows(2).map(|pair| coordinates(pair[1] - pair[0])).collect();
    let [from, to, at] = [ends[0], ends[1], at].map(|p| coordinates(p.to_vec()));
    let of_axis = |axis: usize| {
        let rises = steps.iter().all(|step| step[axis] >= 0.0);
        let falls = steps.iter().all(|step| step[axis] <= 0.0);
        let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
        if rises || falls { (low - at[axis]).max(at[axis] - high).max(0.0) } else { 0.0 }
    };
    (0..3).map(of_axis).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(heights: &[f64]) -> Vec<CurvePoint> {
        let at = |(n, &z): (usize, &f64)| Point3::new(400.0 * n as f64, 0.0, z);
        heights.iter().enumerate().map(at).map(CurvePoint::smooth).collect()
    }

    #[test]
    fn a_keel_that_turns_up_at_once_bulges_below_itself() {
        let found = spline_bulge("keel", &line(&[0.0, 0.0, 0.0, 0.0, 420.0])).unwrap();
        let FindingKind::SplineBulge { curve, at, by_mm } = found.kind else { panic!() };
        assert_eq!(curve, "keel");
        assert!(at.z < -15.0 && (by_mm + at.z).abs() < 1e-9, "{at:?} {by_mm}");
        assert!(at.x > 800.0 && at.x < 1200.0, "{at:?}");
        let numbers = vec![2, 3];
        assert_eq!(found.place, Place::CurvePoints { curve: "keel".to_owned(), numbers });
        // A corner there, or points that lead into it, mend it.
        let mut mended = line(&[0.0, 0.0, 0.0, 0.0, 420.0]);
        mended[3].corner = true;
        assert_eq!(spline_bulge("keel", &mended), None);
        let led = line(&[0.0, 0.0, 2.0, 12.0, 40.0, 110.0, 240.0, 420.0]);
        assert_eq!(spline_bulge("keel", &led), None);
    }

    #[test]
    fn a_fair_line_and_one_that_turns_do_not() {
        assert_eq!(spline_bulge("a", &line(&[500.0, 470.0, 460.0, 470.0, 500.0, 550.0])), None);
        assert_eq!(spline_bulge("b", &line(&[0.0, 300.0, 300.0, 0.0])), None);
        assert_eq!(spline_bulge("c", &line(&[1.0, 2.0])), None);
    }
}
