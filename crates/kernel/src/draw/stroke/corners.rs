//! Finds the corners of a stroke.
//!
//! At a place of the stroke, the turn within a short length w is the angle between the directions
//! of two arms, one before and one behind, whose middles are w apart. Each direction is that of the
//! straight line that fits the arm best, so that the jitter of single positions counts little. On a
//! bend the turn grows with w, at a corner it does not. So a corner is a place where the turn
//! within w reaches the option's angle, is not much smaller than within 2 w, and is larger than
//! beside it.

use super::StrokeOptions;
use super::path::Path;
use sheetwright_geometry::math::{Point2, Vec2, atan2, from_deg};

/// Places at equal steps at which a stroke is examined.
pub(super) const EVEN: usize = 480;
/// The length w, as a share of the stroke, if positions are exact: hands round corners off within
/// about that length.
const SHORT_WAY: f64 = 1.0 / 80.0;
/// Upper limit of w: sides of a star are a tenth of its length.
const LONGEST_WAY: f64 = 1.0 / 26.0;
/// w in terms of the jitter of positions, which then turns an arm by some 5° only.
const WAY_BY_JITTER: f64 = 30.0;
/// w in terms of the grain of the pointer: arms of five pixels have a clear direction.
const WAY_BY_GRAIN: f64 = 8.0;
/// The turn within w is at least this share of that within 2 w at a corner; on a bend it is half.
const SHARP: f64 = 0.72;
/// Corners are farther apart than this, in terms of w: two nearer ones are one that was cut off.
const APART: f64 = 2.0;
/// The gap between a place and an arm, and the length of an arm, as shares of w.
const GAP: f64 = 1.0 / 6.0;
const ARM: f64 = 2.0 / 3.0;
/// The median distance of a position from the middle between its neighbours is, for positions that
/// scatter evenly, this share of the spread of a coordinate.
const MEDIAN_BY_JITTER: f64 = 0.83;

/// The corners of a stroke: numbers of its places at equal steps.
pub(super) fn corners(drawn: &Path, even: &[Point2], options: &StrokeOptions) -> Vec<usize> {
    let length = drawn.length();
    let way = (SHORT_WAY * length)
        .max(WAY_BY_JITTER * jitter(drawn))
        .max(WAY_BY_GRAIN * options.grain_mm)
        .min(LONGEST_WAY * length);
    let m = even.len();
    let step = length / (m - usize::from(!drawn.closed)) as f64;
    let look = Look { even, closed: drawn.closed, step };
    let within: Vec<f64> = (0..m).map(|i| look.turn(i, way)).collect();
    let least = from_deg(options.corner_deg);
    let reach = (APART * way / step).ceil() as usize;
    // The turn is nearly constant near a corner: the middle is where the mean is largest.
    let mean = |i: usize| {
        let beside = (way / (2.0 * step)).round().max(1.0) as i64;
        let near = (-beside..=beside).map(|d| look.number(i, d).map_or(0.0, |j| within[j]));
        near.sum::<f64>()
    };
    let means: Vec<f64> = (0..m).map(mean).collect();
    let is_corner = |&i: &usize| {
        // Of equal ones in a row, the first.
        let before = |d: usize| look.number(i, -(d as i64)).is_none_or(|j| means[j] < means[i]);
        let behind = |d: usize| look.number(i, d as i64).is_none_or(|j| means[j] <= means[i]);
        let is_largest = (1..=reach).all(|d| before(d) && behind(d));
        within[i] >= least && is_largest && within[i] >= SHARP * look.turn(i, 2.0 * way)
    };
    (0..m).filter(is_corner).collect()
}

/// The scatter of positions about a smooth path, mm.
fn jitter(drawn: &Path) -> f64 {
    let p = &drawn.points;
    let off = |i: usize| {
        let along = p[i + 1] - p[i - 1];
        let across = along.perp_dot(p[i] - p[i - 1]).abs();
        if along.length() > 0.0 { across / along.length() } else { 0.0 }
    };
    let mut offs: Vec<f64> = (1..p.len().saturating_sub(1)).map(off).collect();
    offs.sort_by(f64::total_cmp);
    offs.get(offs.len() / 2).map_or(0.0, |median| median / MEDIAN_BY_JITTER)
}

struct Look<'a> {
    even: &'a [Point2],
    closed: bool,
    step: f64,
}

impl Look<'_> {
    /// The number of the place `d` steps on from place `i`, if there is one.
    fn number(&self, i: usize, d: i64) -> Option<usize> {
        let (m, n) = (self.even.len() as i64, i as i64 + d);
        let n = if self.closed { n.rem_euclid(m) } else { n };
        usize::try_from(n).ok().filter(|&n| n < self.even.len())
    }

    /// The turn at place `i` within `way` mm, radians; 0 too near to an end for arms.
    fn turn(&self, i: usize, way: f64) -> f64 {
        let first = (GAP * way / self.step).round().max(1.0) as i64;
        let last = first + (ARM * way / self.step).round().max(2.0) as i64;
        let arm = |sign: i64| -> Option<Vec2> {
            let ends = [sign * first, sign * last].map(|d| self.number(i, d));
            let [Some(_), Some(_)] = ends else { return None };
            let arm: Vec<Point2> = (first..=last)
                .filter_map(|d| self.number(i, sign * d))
                .map(|n| self.even[n])
                .collect();
            Some(direction(&arm))
        };
        let (Some(before), Some(behind)) = (arm(-1), arm(1)) else { return 0.0 };
        let before = -before;
        atan2(before.perp_dot(behind), before.dot(behind)).abs()
    }
}

/// The direction of points at equal steps, from the first to the last: the slope by least squares.
fn direction(points: &[Point2]) -> Vec2 {
    let middle = (points.len() - 1) as f64 / 2.0;
    let origin = points[0];
    points.iter().enumerate().map(|(n, p)| (*p - origin) * (n as f64 - middle)).sum()
}
