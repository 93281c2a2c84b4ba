//! Edits of the points of a curve.
//!
//! A *leg* is the part of a curve from one of its points to the next: leg i begins at point i, and
//! the last leg of a closed curve ends at point 0. For polylines and splines legs are the spans of
//! the curve; of a B-spline, which runs beside its points, they are those of its control polygon.

use crate::design::{Design, DesignCurve};
use sheetwright_geometry::curve::{Curve, CurveError, CurveKind, CurvePoint, point_shares};
use sheetwright_geometry::math::{Point2, Point3};
use std::fmt;

/// Why an edit of a curve fails.
#[derive(Clone, Debug, PartialEq)]
pub enum EditError {
    /// There is no point of this number.
    NoPoint {
        /// The point, counted from 0.
        point: usize,
        /// How many there are.
        points: usize,
    },
    /// There is no leg of this number.
    NoLeg {
        /// The leg, counted from 0.
        leg: usize,
        /// How many there are.
        legs: usize,
    },
    /// Too few points would be left.
    TooFewLeft {
        /// How many such a curve needs.
        needed: usize,
    },
    /// The points are samples themselves: there is no curve between them to be changed.
    Samples,
    /// The leg is no straight line.
    NotStraight,
    /// The edit is for open curves, and this one is closed.
    Closed {
        /// Its name.
        curve: String,
    },
    /// The edit is for closed curves, and this one is open.
    Open {
        /// Its name.
        curve: String,
    },
    /// Control points and points on the curve can't be mixed in one curve.
    Kinds,
    /// An end of the half does not lie on the mirror.
    OffMirror {
        /// Its distance from the mirror, mm.
        off_mm: f64,
        /// The largest distance allowed, mm.
        within_mm: f64,
    },
    /// The points make no curve.
    Curve(CurveError),
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPoint { point, points } => {
                write!(f, "there is no point {}: the curve has {points}", point + 1)
            }
            Self::NoLeg { leg, legs } => {
                write!(f, "there is no side {}: the curve has {legs}", leg + 1)
            }
            Self::TooFewLeft { needed } => {
                write!(f, "the curve needs at least {needed} points; remove the curve instead")
            }
            Self::Samples => write!(
                f,
                "the points of this curve are taken as they are, with nothing between them; make \
                 it a polyline or a spline first"
            ),
            Self::NotStraight => write!(f, "this side is curved already; drag it to bend it"),
            Self::Closed { curve } => write!(f, "'{curve}' is closed and has no ends"),
            Self::Open { curve } => write!(f, "'{curve}' is open already"),
            Self::Kinds => write!(
                f,
                "one of the curves runs beside its points and the other through them; make both \
                 splines first"
            ),
            Self::OffMirror { off_mm, within_mm } => write!(
                f,
                "an end of the curve is {off_mm:.1} mm off the mirror; both ends must be within \
                 {within_mm:.1} mm of it"
            ),
            Self::Curve(error) => write!(f, "the curve {error}"),
        }
    }
}

impl std::error::Error for EditError {}

impl From<CurveError> for EditError {
    fn from(error: CurveError) -> Self {
        Self::Curve(error)
    }
}

/// The curve as it runs: samples are joined straight.
pub(super) fn built(curve: &DesignCurve) -> Result<Curve, EditError> {
    let kind = curve.kind.unwrap_or(CurveKind::Polyline);
    Ok(Curve::new(kind, &curve.points, curve.closed)?)
}

/// `curve` with other points, if they make a curve.
pub(super) fn with_points(
    curve: &DesignCurve,
    points: Vec<CurvePoint>,
) -> Result<DesignCurve, EditError> {
    let needed = if curve.closed { 3 } else { 2 };
    if points.len() < needed {
        return Err(EditError::TooFewLeft { needed });
    }
    let changed = DesignCurve { points, ..curve.clone() };
    built(&changed)?;
    Ok(changed)
}

fn point_of(curve: &DesignCurve, point: usize) -> Result<CurvePoint, EditError> {
    let points = curve.points.len();
    curve.points.get(point).copied().ok_or(EditError::NoPoint { point, points })
}

/// How many legs a curve has.
pub fn legs(curve: &DesignCurve) -> usize {
    curve.points.len().saturating_sub(usize::from(!curve.closed))
}

fn check_leg(curve: &DesignCurve, leg: usize) -> Result<(), EditError> {
    let legs = legs(curve);
    if leg < legs { Ok(()) } else { Err(EditError::NoLeg { leg, legs }) }
}

/// A place on a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The span of the curve that it lies on, counted from 0.
    pub span: usize,
    /// The parameter on the span, 0 ..= 1.
    pub t: f64,
    /// The leg that it belongs to: a point inserted here comes after point `leg`.
    pub leg: usize,
    /// The place in space, mm.
    pub position: Point3,
    /// Its distance from the given point in the plan, mm.
    pub distance_mm: f64,
}

/// Places of a span that are compared before the nearest is narrowed down.
const PLACES: usize = 32;
/// Steps of the golden-section search for the nearest place: to some 1e-8 of a span.
const NARROWINGS: usize = 36;

/// The place of a curve that lies nearest to `at` in the plan that `project` makes of space.
///
/// # Errors
/// Points that make no curve.
pub fn nearest(
    curve: &DesignCurve,
    at: Point2,
    project: impl Fn(Point3) -> Point2,
) -> Result<Nearest, EditError> {
    let made = built(curve)?;
    let spans = made.spans();
    let off = |span: usize, t: f64| project(spans[span].position(t)).distance(at);
    let tries = (0..spans.len()).flat_map(|span| (0..=PLACES).map(move |n| (span, n)));
    let tried = tries.map(|(span, n)| (off(span, n as f64 / PLACES as f64), span, n));
    let (best, span, n) =
        tried.fold((f64::INFINITY, 0, 0), |best, this| if this.0 < best.0 { this } else { best });
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let mut low = n.saturating_sub(1) as f64 / PLACES as f64;
    let mut high = (n + 1).min(PLACES) as f64 / PLACES as f64;
    for _ in 0..NARROWINGS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if off(span, a) <= off(span, b) {
            high = b;
        } else {
            low = a;
        }
    }
    let narrowed = 0.5 * (low + high);
    let first = n as f64 / PLACES as f64;
    let t = if off(span, narrowed) < best { narrowed } else { first };
    Ok(Nearest {
        span,
        t,
        leg: leg_at(curve, span, t),
        position: spans[span].position(t),
        distance_mm: off(span, t),
    })
}

/// The leg that a place on a span belongs to.
fn leg_at(curve: &DesignCurve, span: usize, t: f64) -> usize {
    if curve.kind != Some(CurveKind::BSpline) {
        return span;
    }
    // The mean number of the control points, each weighed with its share in the place: on a uniform
    // B-spline it rises steadily along the curve, from a point to the next.
    let m = curve.points.len();
    let shares = &point_shares(CurveKind::BSpline, &curve.points, curve.closed)[span];
    let s = 1.0 - t;
    let bernstein = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    let mut weights = vec![0.0; m];
    for (control, weight) in shares.iter().zip(bernstein) {
        control.iter().for_each(|share| weights[share.point] += weight * share.factor);
    }
    let most = (0..m).fold(0, |best, i| if weights[i] > weights[best] { i } else { best });
    // Round a closed curve, numbers are counted from the point with the largest share.
    let from_most = |i: usize| {
        let d = i as f64 - most as f64;
        if !curve.closed {
            d
        } else if d > m as f64 / 2.0 {
            d - m as f64
        } else if d < -(m as f64) / 2.0 {
            d + m as f64
        } else {
            d
        }
    };
    let mean: f64 = (0..m).map(|i| weights[i] * from_most(i)).sum();
    let leg = if mean >= 0.0 { most } else { (most + m - 1) % m };
    leg.min(legs(curve) - 1)
}

/// A place is on a point of the curve if it is nearer to it than this share of the leg: a spline
/// between points so near would wind about them.
const ON_A_POINT: f64 = 1e-4;

/// The curve with another smooth point at a place on it, and the number of that point. Polylines
/// and splines then run through it, B-splines have it as a control point. Splines keep their shape
/// nearly, polylines and straight legs exactly.
///
/// # Errors
/// A place that does not exist, or lies on a point.
pub fn insert_point(
    curve: &DesignCurve,
    place: &Nearest,
) -> Result<(DesignCurve, usize), EditError> {
    check_leg(curve, place.leg)?;
    let mut points = curve.points.clone();
    let number = place.leg + 1;
    let ends = [place.leg, number % points.len()];
    let length = points[ends[0]].at.distance(points[ends[1]].at);
    for point in ends {
        if points[point].at.distance(place.position) <= ON_A_POINT * length {
            return Err(CurveError::Repeated { point }.into());
        }
    }
    points.insert(number, CurvePoint::smooth(place.position));
    Ok((with_points(curve, points)?, number))
}

/// The curve without one of its points.
///
/// # Errors
/// No such point, or too few that would be left: an open curve has two, a closed one three.
pub fn remove_point(curve: &DesignCurve, point: usize) -> Result<DesignCurve, EditError> {
    point_of(curve, point)?;
    let mut points = curve.points.clone();
    points.remove(point);
    with_points(curve, points)
}

/// The curve with a corner at a point, or without. A polyline of which a point is to be smooth
/// becomes a spline with corners at all others.
///
/// # Errors
/// No such point, or points that are samples themselves.
pub fn set_corner(
    curve: &DesignCurve,
    point: usize,
    corner: bool,
) -> Result<DesignCurve, EditError> {
    point_of(curve, point)?;
    if curve.kind.is_none() {
        return Err(EditError::Samples);
    }
    let mut changed = curve.clone();
    if curve.kind == Some(CurveKind::Polyline) {
        if corner {
            return Ok(changed);
        }
        changed = as_spline(curve);
    }
    changed.points[point].corner = corner;
    Ok(changed)
}

/// A polyline as the spline that runs the same: every point is a corner.
fn as_spline(curve: &DesignCurve) -> DesignCurve {
    let mut spline = DesignCurve { kind: Some(CurveKind::Spline), ..curve.clone() };
    spline.points.iter_mut().for_each(|point| point.corner = true);
    spline
}

/// The curve with a straight side from point `from` on to point `to`: both become corners, and the
/// points between them, in the direction of the curve, are removed. For the leg i: from i to i + 1.
///
/// # Errors
/// No such points, no way from the one to the other, or too few points that would be left.
pub fn straighten(curve: &DesignCurve, from: usize, to: usize) -> Result<DesignCurve, EditError> {
    let m = curve.points.len();
    point_of(curve, from)?;
    point_of(curve, to)?;
    if curve.kind.is_none() {
        return Err(EditError::Samples);
    }
    if from == to || (!curve.closed && from > to) {
        return Err(EditError::NoLeg { leg: from, legs: legs(curve) });
    }
    let between = |i: usize| if from < to { from < i && i < to } else { i > from || i < to };
    let kept = (0..m).filter(|&i| !between(i));
    let corner = |i: usize| i == from || i == to || curve.points[i].corner;
    let points = kept.map(|i| CurvePoint { corner: corner(i), ..curve.points[i] });
    with_points(curve, points.collect())
}

/// The largest bulge of a straight leg, as a share of its length: rounding.
const STRAIGHT: f64 = 1e-9;

/// The curve with a smooth point in the middle of a straight leg, so that it can be bent, and the
/// number of that point. A polyline becomes a spline.
///
/// # Errors
/// No such leg, one that is bent already, or points that are samples themselves.
pub fn curve_leg(curve: &DesignCurve, leg: usize) -> Result<(DesignCurve, usize), EditError> {
    check_leg(curve, leg)?;
    let changed = match curve.kind {
        None => return Err(EditError::Samples),
        Some(CurveKind::Polyline) => as_spline(curve),
        Some(_) => curve.clone(),
    };
    let m = curve.points.len();
    let (a, b) = (changed.points[leg], changed.points[(leg + 1) % m]);
    let sharp = |i: usize| changed.points[i].corner || (!curve.closed && (i == 0 || i == m - 1));
    let middle = a.at.lerp(b.at, 0.5);
    let is_straight = if sharp(leg) && sharp((leg + 1) % m) {
        true
    } else {
        // A smooth spline may run straight all the same.
        let made = built(&changed)?;
        let spline = changed.kind == Some(CurveKind::Spline);
        spline && {
            let off = |t: f64| made.spans()[leg].position(t).distance(a.at.lerp(b.at, t));
            [0.25, 0.5, 0.75].into_iter().all(|t| off(t) <= STRAIGHT * a.at.distance(b.at))
        }
    };
    if !is_straight {
        return Err(EditError::NotStraight);
    }
    let mut points = changed.points.clone();
    points.insert(leg + 1, CurvePoint::smooth(middle));
    Ok((with_points(&changed, points)?, leg + 1))
}

/// The curve run the other way; a closed one still begins at its first point.
pub fn reversed(curve: &DesignCurve) -> DesignCurve {
    let mut points = curve.points.clone();
    let kept = usize::from(curve.closed).min(points.len());
    points[kept..].reverse();
    DesignCurve { points, ..curve.clone() }
}

/// A name like `base` that no curve and no panel of a design has: `base` itself, or with the next
/// free number after it.
pub fn free_name(design: &Design, base: &str) -> String {
    let curves = design.curves.iter().map(|curve| curve.name.as_str());
    let names: Vec<&str> = curves.chain(design.panels.iter().map(|p| p.name.as_str())).collect();
    free_of(&names, base)
}

pub(super) fn free_of(names: &[&str], base: &str) -> String {
    if !base.is_empty() && !names.contains(&base) {
        return base.to_owned();
    }
    // Counted from the number at the end of the base, if there is one.
    let stem = base.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = base[stem.len()..].parse::<u32>().unwrap_or(1);
    let stem = if stem.trim().is_empty() { "curve" } else { stem.trim_end() };
    let numbered =
        (1..=names.len() as u64 + 1).map(|n| format!("{stem} {}", u64::from(number) + n));
    // There are more numbers than names, so one is free.
    numbered.into_iter().find(|name| !names.contains(&name.as_str())).unwrap_or_default()
}
