//! Straight from point to point.

use super::{Cubic, Curve, CurvePoint};

/// The polyline through `points`; every point is a corner.
pub(super) fn polyline(points: &[CurvePoint], closed: bool) -> Curve {
    let spans_count = if closed { points.len() } else { points.len() - 1 };
    let spans: Vec<Cubic> = (0..spans_count)
        .map(|i| Cubic::line(points[i].at, points[(i + 1) % points.len()].at))
        .collect();
    Curve::from_spans(spans, vec![true; spans_count], closed)
}
