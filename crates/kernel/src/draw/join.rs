//! Joins two open curves, closes an open one, opens a closed one.

use super::edit::{EditError, reversed, with_points};
use crate::design::DesignCurve;
use sheetwright_geometry::curve::{CurveKind, CurvePoint};

fn ends(curve: &DesignCurve) -> Result<[CurvePoint; 2], EditError> {
    if curve.closed {
        return Err(EditError::Closed { curve: curve.name.clone() });
    }
    match (curve.points.first(), curve.points.last()) {
        (Some(&first), Some(&last)) if curve.points.len() > 1 => Ok([first, last]),
        _ => Err(EditError::TooFewLeft { needed: 2 }),
    }
}

/// Two open curves joined at the ends that are nearest to one another. Ends within `within_mm`
/// become one point half way between them; otherwise a straight side joins them. The curve has
/// corners there, so that both keep their shapes. It has the name and the direction of the first;
/// a polyline and a spline make a spline.
///
/// # Errors
/// A closed curve, or one of control points with one that runs through its points.
pub fn join(a: &DesignCurve, b: &DesignCurve, within_mm: f64) -> Result<DesignCurve, EditError> {
    let ([a_start, a_end], [b_start, b_end]) = (ends(a)?, ends(b)?);
    let kind = match (a.kind, b.kind) {
        (a, b) if a == b => a,
        (None, Some(CurveKind::Polyline)) | (Some(CurveKind::Polyline), None) => {
            Some(CurveKind::Polyline)
        }
        (Some(CurveKind::BSpline), _) | (_, Some(CurveKind::BSpline)) => {
            return Err(EditError::Kinds);
        }
        _ => Some(CurveKind::Spline),
    };
    let with_corners = |curve: &DesignCurve| {
        let sharp = kind != curve.kind && kind == Some(CurveKind::Spline);
        let mut curve = curve.clone();
        curve.points.iter_mut().for_each(|point| point.corner |= sharp);
        curve
    };
    let (first, second) = (with_corners(a), with_corners(b));
    let ways = [
        (a_end.at.distance(b_start.at), false, false),
        (a_end.at.distance(b_end.at), false, true),
        (a_start.at.distance(b_end.at), true, false),
        (a_start.at.distance(b_start.at), true, true),
    ];
    // The first of equals, so that the first curve is continued from its end.
    let (_, before, turned) = ways
        .into_iter()
        .reduce(|best, way| if way.0 < best.0 { way } else { best })
        .unwrap_or(ways[0]);
    let second = if turned { reversed(&second) } else { second };
    let (head, tail) = if before { (second, first) } else { (first, second) };
    let mut points = head.points;
    let mut rest = tail.points;
    meet(&mut points, &mut rest, within_mm);
    points.extend(rest);
    with_points(&DesignCurve { kind, ..a.clone() }, points)
}

/// Makes the last of `points` and the first of `rest` corners, and one point if they are within
/// `within_mm`.
fn meet(points: &mut [CurvePoint], rest: &mut Vec<CurvePoint>, within_mm: f64) {
    let (Some(end), Some(start)) = (points.last_mut(), rest.first_mut()) else { return };
    end.corner = true;
    start.corner = true;
    if end.at.distance(start.at) <= within_mm {
        end.at = end.at.lerp(start.at, 0.5);
        end.move_mm = end.move_mm.max(start.move_mm);
        rest.remove(0);
    }
}

/// An open curve closed on itself: where its ends meet within `within_mm` they become one corner,
/// half way between both; else a straight side joins them.
///
/// # Errors
/// A closed curve, or too few points: a closed one needs three.
pub fn close(curve: &DesignCurve, within_mm: f64) -> Result<DesignCurve, EditError> {
    ends(curve)?;
    let mut points = curve.points.clone();
    let mut first: Vec<CurvePoint> = points.drain(..1).collect();
    meet(&mut points, &mut first, within_mm);
    if first.is_empty() {
        // The merged point, at the end, becomes the first point.
        points.rotate_right(1);
    } else {
        points.splice(0..0, first);
    }
    with_points(&DesignCurve { closed: true, ..curve.clone() }, points)
}

/// A closed curve opened at one of its points, where it then begins and ends.
///
/// # Errors
/// An open curve, or no such point.
pub fn open_at(curve: &DesignCurve, point: usize) -> Result<DesignCurve, EditError> {
    if !curve.closed {
        return Err(EditError::Open { curve: curve.name.clone() });
    }
    let points = curve.points.len();
    if point >= points {
        return Err(EditError::NoPoint { point, points });
    }
    let mut points = curve.points.clone();
    points.rotate_left(point);
    points.push(points[0]);
    with_points(&DesignCurve { closed: false, ..curve.clone() }, points)
}
