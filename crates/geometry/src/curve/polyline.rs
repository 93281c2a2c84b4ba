//! Straight from point to point: every point is a corner, so every stretch has two.

use super::{Cubic, StretchMaker};

pub(super) const POLYLINE: StretchMaker = StretchMaker {
    open: |_, points| lines(points, false),
    closed: |_, points| lines(points, true),
};

fn lines(points: &[crate::math::Point3], closed: bool) -> Vec<Cubic> {
    let count = if closed { points.len() } else { points.len() - 1 };
    (0..count).map(|i| Cubic::line(points[i], points[(i + 1) % points.len()])).collect()
}
