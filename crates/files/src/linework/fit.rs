//! From the pieces of a drawn curve to the points of a curve of a design.
//!
//! A chain of straight lines is a polyline, to the bit. Of everything else an interpolating spline
//! is made, with corners at both ends of every straight line and where the direction breaks, so
//! that lines and corners stay exact. Its other points lie on the drawn curve, as many as keep the
//! spline within a millionth of the size of the curve: the spline is built, compared with what was
//! drawn, and where it is farther off, the point halfway comes in, until none is.

use super::chain::size_of;
use super::drawn::Drawn;
use super::segment::Segment;
use sheetwright::curve::{Cubic, Curve, CurveError, CurveKind, CurvePoint};
use sheetwright::math::{Point3, angle_between, from_deg};

/// How far a spline may lie from the drawn curve, as a share of its size.
const OFF: f64 = 1e-6;
/// Directions that differ by more make a corner.
const CORNER_DEG: f64 = 1.0;
/// Straight lines in space that turn by less are parts of a smooth curve.
const SMOOTH_DEG: f64 = 20.0;
/// ... if none is longer than its neighbour by more than this factor.
const SMOOTH_RATIO: f64 = 5.0;
/// The fewest straight lines of such a curve.
const SMOOTH_LINES: usize = 3;
/// The most rounds of halving, by which a step falls below the rounding of its length.
const ROUNDS: usize = 24;
/// The most points of a curve.
pub(super) const MAX_POINTS: usize = 200_000;

/// The points of a curve, and how they make it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fitted {
    pub(super) kind: CurveKind,
    pub(super) closed: bool,
    pub(super) points: Vec<CurvePoint>,
    /// Whether straight lines were made a smooth curve.
    pub(super) smoothed: bool,
}

/// Why a drawn curve can't be one of a design.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FitError {
    /// It has no length.
    Nothing,
    /// It takes more than [`MAX_POINTS`].
    TooManyPoints,
    /// The kernel does not take its points.
    Curve(CurveError),
}

impl FitError {
    /// Whether a closed curve has too few points to bound anything.
    pub(super) fn bounds_nothing(&self) -> bool {
        matches!(self, Self::Nothing | Self::Curve(CurveError::TooFewPoints { .. }))
    }
}

/// A point of the spline: where it lies on the drawn curve.
#[derive(Clone, Copy)]
struct Node {
    segment: usize,
    t: f64,
    point: CurvePoint,
}

/// Fits a drawn curve; in space (`smooth`), many short lines become smooth.
pub(super) fn fitted(curve: &Drawn, smooth: bool) -> Result<Fitted, FitError> {
    let size = size_of([curve]);
    let is_long = |segment: &&Segment| {
        let [a, b, c] = [0.0, 0.5, 1.0].map(|t| segment.position(t));
        a.distance(b).max(a.distance(c)) > 1e-9 * size
    };
    let segments: Vec<&Segment> = curve.segments.iter().filter(is_long).collect();
    if segments.is_empty() {
        return Err(FitError::Nothing);
    }
    if segments.iter().map(|segment| segment.parts()).sum::<usize>() > MAX_POINTS {
        return Err(FitError::TooManyPoints);
    }
    let joints = joints(&segments, curve.closed, smooth);
    let smoothed = joints.contains(&Joint::Smoothed);
    let is_polyline = !smoothed && segments.iter().all(|segment| segment.is_line());
    let kind = if is_polyline { CurveKind::Polyline } else { CurveKind::Spline };
    let mut nodes = first_nodes(&segments, &joints, curve.closed);
    for _ in 0..ROUNDS {
        if nodes.len() > MAX_POINTS {
            return Err(FitError::TooManyPoints);
        }
        let points: Vec<CurvePoint> = nodes.iter().map(|node| node.point).collect();
        let spline = Curve::new(kind, &points, curve.closed).map_err(FitError::Curve)?;
        let before = nodes.len();
        nodes = refined(&nodes, &segments, spline.spans(), OFF * size);
        if nodes.len() == before {
            break;
        }
    }
    let points = nodes.into_iter().map(|node| node.point).collect();
    Ok(Fitted { kind, closed: curve.closed, points, smoothed })
}

#[derive(Clone, Copy, PartialEq)]
enum Joint {
    Corner,
    Smooth,
    /// Between two straight lines of a smooth curve.
    Smoothed,
}

/// The joint before each piece.
fn joints(segments: &[&Segment], closed: bool, smooth: bool) -> Vec<Joint> {
    let n = segments.len();
    let mut joints: Vec<Joint> = (0..n)
        .map(|i| {
            if i == 0 && !closed {
                return Joint::Corner;
            }
            let (before, after) = (segments[(i + n - 1) % n], segments[i]);
            let turn = angle_between(before.tangent_at_end(true), after.tangent_at_end(false));
            match before.is_line() || after.is_line() {
                true if smooth && before.is_line() && after.is_line() => {
                    let [a, b] = [before, after].map(|line| line.start().distance(line.end()));
                    let is_even = a.max(b) <= SMOOTH_RATIO * a.min(b);
                    let is_smooth = is_even && turn < from_deg(SMOOTH_DEG);
                    if is_smooth { Joint::Smoothed } else { Joint::Corner }
                }
                true => Joint::Corner,
                false if turn > from_deg(CORNER_DEG) => Joint::Corner,
                false => Joint::Smooth,
            }
        })
        .collect();
    drop_short_runs(&mut joints, closed);
    joints
}

/// Runs of lines that are too few for a smooth curve keep their corners.
fn drop_short_runs(joints: &mut [Joint], closed: bool) {
    let n = joints.len();
    let Some(first) = joints.iter().position(|joint| *joint != Joint::Smoothed) else {
        // A ring of lines without a corner, which has as many joints as lines.
        if n < SMOOTH_LINES + 1 {
            joints.fill(Joint::Corner);
        }
        return;
    };
    debug_assert!(closed || first == 0);
    let mut run: Vec<usize> = Vec::new();
    for i in (first..first + n + 1).map(|i| i % n) {
        if joints[i] == Joint::Smoothed {
            run.push(i);
            continue;
        }
        if run.len() + 1 < SMOOTH_LINES {
            run.iter().for_each(|&i| joints[i] = Joint::Corner);
        }
        run.clear();
    }
}

/// The ends of the pieces, and some points of those that are curved.
fn first_nodes(segments: &[&Segment], joints: &[Joint], closed: bool) -> Vec<Node> {
    let mut nodes = Vec::new();
    for (i, segment) in segments.iter().enumerate() {
        let parts = segment.parts();
        nodes.extend((0..parts).map(|k| {
            let t = k as f64 / parts as f64;
            let corner = k == 0 && joints[i] == Joint::Corner;
            Node { segment: i, t, point: point(segment.position(t), corner) }
        }));
    }
    if let (false, Some(last)) = (closed, segments.last()) {
        let point = point(last.end(), true);
        nodes.push(Node { segment: segments.len() - 1, t: 1.0, point });
    }
    nodes.dedup_by(|b, a| a.point.at == b.point.at);
    nodes
}

fn point(at: Point3, corner: bool) -> CurvePoint {
    // Adding 0 turns −0 into 0.
    let at = Point3::new(at.x + 0.0, at.y + 0.0, at.z + 0.0);
    if corner { CurvePoint::corner(at) } else { CurvePoint::smooth(at) }
}

/// The nodes with those halfway where a span leaves the drawn curve by more than `most`.
fn refined(nodes: &[Node], segments: &[&Segment], spans: &[Cubic], most: f64) -> Vec<Node> {
    let mut all = Vec::with_capacity(nodes.len());
    for (i, node) in nodes.iter().enumerate() {
        all.push(*node);
        let (segment, Some(span)) = (segments[node.segment], spans.get(i)) else { continue };
        if segment.is_line() {
            continue;
        }
        let next = nodes.get(i + 1).filter(|next| next.segment == node.segment);
        let (low, high) = (node.t, next.map_or(1.0, |next| next.t));
        let is_off = [0.25, 0.5, 0.75]
            .iter()
            .any(|&u| distance(segment, span.position(u), low + (high - low) * u) > most);
        let t = 0.5 * (low + high);
        let between = point(segment.position(t), false);
        let ends = [segment.position(low), segment.position(high)];
        let is_new = ends.iter().all(|end| end.distance(between.at) > 1e-9 * most);
        if is_off && low < t && t < high && is_new {
            all.push(Node { segment: node.segment, t, point: between });
        }
    }
    all
}

/// The distance of a point from a piece, near a parameter (Gauss–Newton).
fn distance(segment: &Segment, p: Point3, near: f64) -> f64 {
    let mut t = near;
    let mut best = segment.position(t).distance(p);
    for _ in 0..4 {
        let derivative = segment.derivative(t);
        let slope = derivative.length_squared();
        if slope <= 0.0 || slope.is_nan() {
            break;
        }
        t = (t - (segment.position(t) - p).dot(derivative) / slope).clamp(0.0, 1.0);
        best = best.min(segment.position(t).distance(p));
    }
    best
}
