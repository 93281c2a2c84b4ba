//! Curves: chains of cubic spans, smooth but for their corners.
//!
//! A polyline, an interpolating spline and a B-spline differ only in how their spans are made (one
//! file each). All are then evaluated with exact derivatives and sampled evenly by arc length.

mod arc_length;
mod bspline;
mod chord;
mod cubic;
mod polyline;
mod sample;
mod shares;
mod spline;

pub(crate) use arc_length::parameter_at;
pub use arc_length::{NODES, length};
pub use chord::{Chord, chord};
pub use cubic::Cubic;
pub use sample::{Place, Placed, chain_placed, chained_samples, divisions_of, open_placed};
pub use sample::{Sample, SampleError, sample_chain, sample_open};
pub use shares::{PointShare, SpanShares, derivative_shares, point_shares, position_shares};

use crate::math::{Point3, Vec3};
use std::fmt;

/// Largest size of a coordinate, mm (a thousand km): its cubes stay far inside the range of the
/// exact predicates, and no sheet is larger.
pub const MAX_COORDINATE_MM: f64 = 1e9;

/// A point that a curve is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Where it lies, mm.
    pub at: Point3,
    /// Whether the curve has a corner here: it passes through the point with two tangents.
    pub corner: bool,
    /// How far the point may move so that the sheet bends better, mm; 0: as the design says.
    pub move_mm: f64,
}

impl CurvePoint {
    /// A point where the curve runs smoothly.
    pub fn smooth(at: Point3) -> Self {
        Self { at, corner: false, move_mm: 0.0 }
    }

    /// A point where the curve has a corner.
    pub fn corner(at: Point3) -> Self {
        Self { at, corner: true, move_mm: 0.0 }
    }
}

/// How the points make the curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// Straight from point to point; every point is a corner.
    Polyline,
    /// An interpolating cubic spline over chord length: natural at open ends and at corners,
    /// periodic when closed without corners.
    Spline,
    /// A uniform cubic B-spline whose control points the points are: clamped at open ends and at
    /// corners, periodic when closed without corners.
    BSpline,
}

/// Why points do not make a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum CurveError {
    /// Fewer points than the kind needs.
    TooFewPoints {
        /// How many there are.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// A coordinate that is no finite number, or beyond [`MAX_COORDINATE_MM`].
    OutOfRange {
        /// The point, counted from 0.
        point: usize,
    },
    /// Two points that follow one another and lie on the same spot.
    Repeated {
        /// The second of them, counted from 0.
        point: usize,
    },
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewPoints { found, needed } => {
                write!(f, "has {found} points and needs at least {needed}")
            }
            Self::OutOfRange { point } => write!(
                f,
                "has a coordinate at point {} that is not a number within ±1e9 mm",
                point + 1
            ),
            Self::Repeated { point } => {
                write!(f, "has point {} on the same spot as the one before", point + 1)
            }
        }
    }
}

impl std::error::Error for CurveError {}

/// A chain of cubic spans, each beginning where the last ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    spans: Vec<Cubic>,
    /// Whether the curve has a corner where span `i` begins; the ends of an open curve are corners.
    corner_before: Vec<bool>,
    closed: bool,
}

impl Curve {
    /// The curve of a kind through, or controlled by, `points`.
    ///
    /// # Errors
    /// Too few points (2 for an open curve, 3 for a closed one), coordinates that are not finite,
    /// or two points in a row on the same spot.
    pub fn new(kind: CurveKind, points: &[CurvePoint], closed: bool) -> Result<Self, CurveError> {
        let needed = if closed { 3 } else { 2 };
        if points.len() < needed {
            return Err(CurveError::TooFewPoints { found: points.len(), needed });
        }
        let in_range = |p: Point3| p.to_vec().abs().max_element() <= MAX_COORDINATE_MM;
        if let Some(point) = points.iter().position(|p| !p.at.is_finite() || !in_range(p.at)) {
            return Err(CurveError::OutOfRange { point });
        }
        let pairs = if closed { points.len() } else { points.len() - 1 };
        for i in 0..pairs {
            let next = (i + 1) % points.len();
            if points[i].at == points[next].at {
                return Err(CurveError::Repeated { point: next });
            }
        }
        let maker = kind.maker();
        let at =
            |numbers: &[usize]| -> Vec<Point3> { numbers.iter().map(|&n| points[n].at).collect() };
        let open = |numbers: &[usize]| (maker.open)(&at(numbers), &at(numbers));
        let ring = |numbers: &[usize]| (maker.closed)(&at(numbers), &at(numbers));
        let (spans, corner_before) = spread(kind, points, closed, open, ring);
        Ok(Self::from_spans(spans, corner_before, closed))
    }

    /// A curve from its spans and the corners before each; the ends of an open one are corners.
    fn from_spans(spans: Vec<Cubic>, corner_before: Vec<bool>, closed: bool) -> Self {
        debug_assert_eq!(spans.len(), corner_before.len());
        Self { spans, corner_before, closed }
    }

    /// Whether the curve ends where it begins, running on smoothly or with a corner.
    pub fn closed(&self) -> bool {
        self.closed
    }

    /// Whether there is a corner where the curve begins.
    pub fn begins_with_a_corner(&self) -> bool {
        self.corner_before[0]
    }

    /// The spans, in order.
    pub fn spans(&self) -> &[Cubic] {
        &self.spans
    }

    /// Where the curve begins, mm.
    pub fn start(&self) -> Point3 {
        self.spans[0].position(0.0)
    }

    /// Where the curve ends, mm.
    pub fn end(&self) -> Point3 {
        self.spans[self.spans.len() - 1].position(1.0)
    }

    /// The point at parameter `u`, mm: span ⌊u⌋ at its own parameter u − ⌊u⌋, clamped to the curve.
    pub fn position(&self, u: f64) -> Point3 {
        let (span, t) = self.locate(u);
        self.spans[span].position(t)
    }

    /// The exact derivative by `u`, mm, of the span that `u` lies in.
    pub fn derivative(&self, u: f64) -> Vec3 {
        let (span, t) = self.locate(u);
        self.spans[span].derivative(t)
    }

    /// The exact second derivative by `u`, mm, of the span that `u` lies in.
    pub fn second_derivative(&self, u: f64) -> Vec3 {
        let (span, t) = self.locate(u);
        self.spans[span].second_derivative(t)
    }

    /// The length of the curve, mm.
    pub fn length(&self) -> f64 {
        self.spans.iter().map(|span| length(span, 0.0, 1.0)).sum()
    }

    fn locate(&self, u: f64) -> (usize, f64) {
        let last = self.spans.len() - 1;
        let span = (u.max(0.0).floor() as usize).min(last);
        (span, (u - span as f64).clamp(0.0, 1.0))
    }

    /// This curve, run from its end to its beginning.
    pub fn reversed(&self) -> Self {
        let spans: Vec<Cubic> = self.spans.iter().rev().map(Cubic::reversed).collect();
        // The corner before a reversed span is the one after the span as it was.
        let m = spans.len();
        let corner_before = (0..m).map(|i| self.corner_before[(m - i) % m]).collect();
        Self { spans, corner_before, closed: self.closed }
    }

    /// The smooth runs between its corners, as curves: open ones in order, or the closed curve
    /// itself if it has no corner.
    pub fn smooth_runs(&self) -> Vec<Self> {
        let m = self.spans.len();
        if self.closed && !self.corner_before.contains(&true) {
            return vec![self.clone()];
        }
        let run = |range: std::ops::Range<usize>| {
            let spans: Vec<Cubic> = range.map(|i| self.spans[i % m]).collect();
            let corner_before = (0..spans.len()).map(|n| n == 0).collect();
            Self::from_spans(spans, corner_before, false)
        };
        self.stretches().into_iter().map(run).collect()
    }

    /// An open curve cut in two inside span `span`, at its parameter `t`; at a joint of two spans
    /// for `t` = 0. The two have at least one span each.
    pub fn cut(&self, span: usize, t: f64) -> [Self; 2] {
        debug_assert!(!self.closed && (span > 0 || t > 0.0) && t < 1.0);
        let mut before = self.spans[..span].to_vec();
        let mut after = self.spans[span..].to_vec();
        if t > 0.0 {
            let [first, second] = self.spans[span].halves(t);
            before.push(first);
            after[0] = second;
        }
        let mut corners = self.corner_before[..before.len()].to_vec();
        corners[0] = true;
        let mut corners_after = self.corner_before[span..].to_vec();
        corners_after[0] = true;
        [Self::from_spans(before, corners, false), Self::from_spans(after, corners_after, false)]
    }

    /// The runs of spans between corners, as ranges of span numbers; a range may run over the end
    /// of a closed curve, so its end may exceed the number of spans. One range without corners.
    pub fn stretches(&self) -> Vec<std::ops::Range<usize>> {
        let m = self.spans.len();
        let corners: Vec<usize> = (0..m).filter(|&i| self.corner_before[i]).collect();
        let Some((&first, &last)) = corners.first().zip(corners.last()) else {
            return std::iter::once(0..m).collect();
        };
        let mut ranges: Vec<_> = corners.windows(2).map(|pair| pair[0]..pair[1]).collect();
        ranges.push(last..first + m);
        ranges
    }
}

/// How one kind makes the spans of a smooth stretch, open between two corners or a closed curve
/// without corners: from the points that give the chord lengths, and the points that the stretch
/// follows. The spans are linear in the latter.
struct StretchMaker {
    open: fn(&[Point3], &[Point3]) -> Vec<Cubic>,
    closed: fn(&[Point3], &[Point3]) -> Vec<Cubic>,
}

impl CurveKind {
    fn maker(self) -> &'static StretchMaker {
        match self {
            Self::Polyline => &polyline::POLYLINE,
            Self::Spline => &spline::SPLINE,
            Self::BSpline => &bspline::BSPLINE,
        }
    }
}

/// Splits the points at corners and lets `open` make the spans (or what stands for them) of each
/// stretch, given the numbers of its points, or `ring` those of a closed curve without corners.
/// Returns them with a flag for each span: whether a corner comes before it.
///
/// A closed curve with corners begins at its first point all the same. Where that is no corner, the
/// spans are rotated back by the number of points before the first corner: a spline then begins at
/// its first point, a B-spline somewhere before that corner.
fn spread<T>(
    kind: CurveKind,
    points: &[CurvePoint],
    closed: bool,
    open: impl Fn(&[usize]) -> Vec<T>,
    ring: impl Fn(&[usize]) -> Vec<T>,
) -> (Vec<T>, Vec<bool>) {
    let m = points.len();
    let is_corner = |i: usize| kind == CurveKind::Polyline || points[i].corner;
    let mut corners: Vec<usize> = (0..m).filter(|&i| is_corner(i)).collect();
    if !closed {
        corners.retain(|&i| i != 0 && i != m - 1);
        corners.insert(0, 0);
        corners.push(m - 1);
    }
    let Some(&first) = corners.first() else {
        let all: Vec<usize> = (0..m).collect();
        let spans = ring(&all);
        let corner_before = vec![false; spans.len()];
        return (spans, corner_before);
    };
    if closed {
        corners.push(first + m);
    }
    let mut spans = Vec::new();
    let mut corner_before = Vec::new();
    for pair in corners.windows(2) {
        let stretch: Vec<usize> = (pair[0]..=pair[1]).map(|i| i % m).collect();
        for (n, span) in open(&stretch).into_iter().enumerate() {
            spans.push(span);
            corner_before.push(n == 0);
        }
    }
    if closed && first > 0 {
        // `first` points precede the first corner, so `first` spans of the last stretch do.
        let turn = first.min(spans.len() - 1);
        spans.rotate_right(turn);
        corner_before.rotate_right(turn);
    }
    (spans, corner_before)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 3]]) -> Vec<CurvePoint> {
        list.iter().map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2]))).collect()
    }

    fn kinds() -> [CurveKind; 3] {
        [CurveKind::Polyline, CurveKind::Spline, CurveKind::BSpline]
    }

    const ZIGZAG: [[f64; 3]; 6] = [
        [0.0, 0.0, 0.0],
        [1.0, 2.0, 0.5],
        [3.0, 1.0, -1.0],
        [4.0, 4.0, 2.0],
        [6.0, 3.0, 0.0],
        [5.0, -2.0, 1.0],
    ];

    #[test]
    fn derivatives_are_those_of_the_positions() {
        for kind in kinds() {
            for closed in [false, true] {
                let curve = Curve::new(kind, &points(&ZIGZAG), closed).unwrap();
                let end = curve.spans().len() as f64;
                let h = 1e-5;
                for step in 1..50 {
                    let u = end * (step as f64 + 0.37) / 51.0;
                    let numeric = (curve.position(u + h) - curve.position(u - h)) / (2.0 * h);
                    assert!((numeric - curve.derivative(u)).length() < 1e-7, "{kind:?} {u}");
                    let numeric = (curve.derivative(u + h) - curve.derivative(u - h)) / (2.0 * h);
                    assert!((numeric - curve.second_derivative(u)).length() < 1e-5, "{kind:?} {u}");
                }
            }
        }
    }

    #[test]
    fn spans_join_and_keep_their_tangent_but_at_corners() {
        let mut list = points(&ZIGZAG);
        list[2].corner = true;
        for kind in [CurveKind::Spline, CurveKind::BSpline] {
            for closed in [false, true] {
                let curve = Curve::new(kind, &list, closed).unwrap();
                let m = curve.spans.len();
                for i in usize::from(!closed)..m {
                    let (a, b) = (curve.spans[(i + m - 1) % m], curve.spans[i]);
                    assert!(a.position(1.0).distance(b.position(0.0)) < 1e-12);
                    let bend = crate::math::angle_between(a.tangent(1.0), b.tangent(0.0));
                    if curve.corner_before[i] {
                        assert!(bend > 0.05 && b.position(0.0).distance(list[2].at) < 1e-12);
                    } else {
                        assert!(bend < 1e-7, "{kind:?} {closed} {i}: {bend}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_spline_goes_through_its_points_and_a_reversed_one_too() {
        let curve = Curve::new(CurveKind::Spline, &points(&ZIGZAG), true).unwrap();
        let back = curve.reversed();
        for (i, p) in ZIGZAG.iter().enumerate() {
            let p = Point3::new(p[0], p[1], p[2]);
            assert!(curve.position(i as f64).distance(p) < 1e-12);
            assert!(back.position((6 - i) as f64).distance(p) < 1e-12);
        }
    }

    #[test]
    fn a_closed_curve_with_corners_begins_at_its_first_point() {
        let mut list = points(&ZIGZAG);
        list[2].corner = true;
        list[4].corner = true;
        let curve = Curve::new(CurveKind::Spline, &list, true).unwrap();
        assert!(curve.start().distance(list[0].at) < 1e-12);
        assert_eq!(curve.stretches(), vec![2..4, 4..8]);
        let back = curve.reversed();
        assert_eq!(back.stretches(), vec![2..4, 4..8]);
    }

    #[test]
    fn what_is_no_curve_is_refused() {
        let one = points(&ZIGZAG[..1]);
        assert_eq!(
            Curve::new(CurveKind::Spline, &one, false),
            Err(CurveError::TooFewPoints { found: 1, needed: 2 })
        );
        let mut twice = points(&ZIGZAG);
        twice[3].at = twice[2].at;
        let refused = Curve::new(CurveKind::BSpline, &twice, false);
        assert_eq!(refused, Err(CurveError::Repeated { point: 3 }));
        twice[3].at.y = f64::NAN;
        let refused = Curve::new(CurveKind::Polyline, &twice, false);
        assert_eq!(refused, Err(CurveError::OutOfRange { point: 3 }));
    }
}
