//! How the spans of a curve follow its points.
//!
//! A polyline and a B-spline are linear in their points, and so is an interpolating spline while
//! its chord lengths are held. The share of a point in a control point of a span is then the value
//! of that control point when this point is 1 and all others are 0.

use super::{CurveKind, CurvePoint, spread};
use crate::math::Point3;
use std::collections::BTreeMap;

/// Smaller shares are left out. A spline's shares fall to a quarter from point to point, so those
/// two dozen points away are.
const NO_SHARE: f64 = 1e-14;

/// The share of a point's displacement that a control point or a place on the curve follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointShare {
    /// The point of the curve, counted from 0.
    pub point: usize,
    /// The share, without unit.
    pub factor: f64,
}

/// The shares of points in the four control points of a span.
pub type SpanShares = [Vec<PointShare>; 4];

/// The shares of points in the spans of a curve, in their order. The points must make a curve.
pub fn point_shares(kind: CurveKind, points: &[CurvePoint], closed: bool) -> Vec<SpanShares> {
    let maker = kind.maker();
    let open = |numbers: &[usize]| of_stretch(maker.open, points, numbers);
    let ring = |numbers: &[usize]| of_stretch(maker.closed, points, numbers);
    spread(kind, points, closed, open, ring).0
}

fn of_stretch(
    make: fn(&[Point3], &[Point3]) -> Vec<super::Cubic>,
    points: &[CurvePoint],
    numbers: &[usize],
) -> Vec<SpanShares> {
    let shape: Vec<Point3> = numbers.iter().map(|&n| points[n].at).collect();
    let mut alone = vec![Point3::new(0.0, 0.0, 0.0); shape.len()];
    let mut spans: Vec<SpanShares> = Vec::new();
    for (k, &point) in numbers.iter().enumerate() {
        alone[k].x = 1.0;
        let made = make(&shape, &alone);
        alone[k].x = 0.0;
        spans.resize_with(made.len(), SpanShares::default);
        for (shares, span) in spans.iter_mut().zip(made) {
            for (list, control) in shares.iter_mut().zip(span.control) {
                if control.x.abs() > NO_SHARE {
                    list.push(PointShare { point, factor: control.x });
                }
            }
        }
    }
    spans
}

/// The shares of the points of a curve in its position at `t` of a span.
pub fn position_shares(span: &SpanShares, t: f64) -> Vec<PointShare> {
    let s = 1.0 - t;
    weighed(span, [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t])
}

/// The shares of the points of a curve in its derivative by `t`, at `t` of a span.
pub fn derivative_shares(span: &SpanShares, t: f64) -> Vec<PointShare> {
    let s = 1.0 - t;
    let (a, b, c) = (3.0 * s * s, 6.0 * s * t, 3.0 * t * t);
    weighed(span, [-a, a - b, b - c, c])
}

fn weighed(span: &SpanShares, weights: [f64; 4]) -> Vec<PointShare> {
    let mut by_point: BTreeMap<usize, f64> = BTreeMap::new();
    for (list, weight) in span.iter().zip(weights) {
        for share in list {
            *by_point.entry(share.point).or_default() += weight * share.factor;
        }
    }
    by_point.into_iter().map(|(point, factor)| PointShare { point, factor }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Curve;
    use crate::math::Vec3;

    #[test]
    fn spans_follow_their_points() {
        let at = |i: usize| {
            let t = i as f64;
            Point3::new(3.0 * t + (i % 2) as f64, 0.4 * t * t, ((i * 5) % 7) as f64)
        };
        for kind in [CurveKind::Polyline, CurveKind::Spline, CurveKind::BSpline] {
            for closed in [false, true] {
                for corner in [None, Some(0), Some(4)] {
                    let points: Vec<CurvePoint> = (0..9)
                        .map(|i| CurvePoint { at: at(i), corner: corner == Some(i), move_mm: 0.0 })
                        .collect();
                    let curve = Curve::new(kind, &points, closed).unwrap();
                    let shares = point_shares(kind, &points, closed);
                    assert_eq!(shares.len(), curve.spans().len());
                    // All is linear, so the shares applied to the points give the curve.
                    for (span, shares) in curve.spans().iter().zip(&shares) {
                        for (control, shares) in span.control.iter().zip(shares) {
                            let made: Vec3 =
                                shares.iter().map(|s| at(s.point).to_vec() * s.factor).sum();
                            let sum: f64 = shares.iter().map(|s| s.factor).sum();
                            assert!((sum - 1.0).abs() < 1e-12);
                            assert!(
                                (made - control.to_vec()).length() < 1e-11,
                                "{kind:?} {closed}"
                            );
                        }
                    }
                }
            }
        }
    }
}
