//! Handles by least squares.
//!
//! While its chord lengths are held, an interpolating spline is linear in its points: its position
//! at a parameter u is a sum of the points, each times its share. So with a parameter for every
//! place of the stroke, the points with the least sum of squared distances solve a small system of
//! linear equations. Then every place gets the parameter of the nearest place of the new curve,
//! near the one it had, and the system is solved again. Both ends of an open stroke stay where they
//! are.

use sheetwright_geometry::curve::{Curve, CurveKind, CurvePoint, point_shares};
use sheetwright_geometry::math::{Point2, Point3, Vec2};

/// Rounds of solving and finding the nearest places: after these, handles move by less than the
/// jitter of the stroke.
const ROUNDS: usize = 8;
/// Places of a span among which the nearest is searched.
const PLACES: usize = 16;
/// The range of that search about the last parameter, in spans.
const REACH: f64 = 1.5;
/// Weight of a handle's old position beside that of a place of the stroke: for handles to which no
/// place belongs.
const STAY: f64 = 1e-3;
/// Places of the stroke this near to a corner, as a share of its length, don't count: a hand rounds
/// corners off.
const ROUNDED: f64 = 1.0 / 300.0;

/// A point of the curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Handle {
    /// The number of the place of the stroke that it lies nearest to, rising along the curve; those
    /// of a closed one may run over the number of places.
    pub(super) place: usize,
    pub(super) at: Point2,
    pub(super) corner: bool,
}

fn points_of(handles: &[Handle]) -> Vec<CurvePoint> {
    let point = |h: &Handle| CurvePoint {
        at: Point3::new(h.at.x, h.at.y, 0.0),
        corner: h.corner,
        move_mm: 0.0,
    };
    handles.iter().map(point).collect()
}

/// The spline through handles; `None` where two in a row lie on the same spot.
pub(super) fn curve(handles: &[Handle], closed: bool) -> Option<Curve> {
    Curve::new(CurveKind::Spline, &points_of(handles), closed).ok()
}

/// The handles moved to where the curve fits the places of the stroke best; corners stay where they
/// are if they are `pinned`.
pub(super) fn solved(
    mut handles: Vec<Handle>,
    even: &[Point2],
    closed: bool,
    length: f64,
    pinned: bool,
) -> Option<Vec<Handle>> {
    let m = even.len();
    let n = handles.len();
    let spans = if closed { n } else { n - 1 };
    let first = handles[0].place;
    let place_of = |handles: &[Handle], k: usize| if k < n { handles[k].place } else { first + m };
    // Places of the stroke in the order of the curve, and their parameters.
    let order: Vec<usize> =
        (first..first + m).take(place_of(&handles, spans) + 1 - first).collect();
    let order = &order[..order.len().min(m)];
    let mut us: Vec<f64> = Vec::with_capacity(order.len());
    let mut span = 0;
    for &place in order {
        while span + 1 < spans && place >= place_of(&handles, span + 1) {
            span += 1;
        }
        let (from, to) = (place_of(&handles, span), place_of(&handles, span + 1));
        us.push(span as f64 + (place - from) as f64 / (to - from).max(1) as f64);
    }
    let corners: Vec<usize> = (0..=spans)
        .filter(|&k| handles[k % n].corner || (!closed && (k == 0 || k == spans)))
        .collect();
    let step = length / m as f64;
    let corner_places: Vec<usize> = corners
        .iter()
        .filter(|&&k| handles[k % n].corner)
        .map(|&k| place_of(&handles, k))
        .collect();
    let counts = |place: usize| {
        corner_places.iter().all(|&c| place.abs_diff(c) as f64 * step > ROUNDED * length)
    };
    // The spans between the corners around each place, which it keeps to.
    let bounds: Vec<Option<(f64, f64)>> = us
        .iter()
        .map(|&u| {
            let below = corners.iter().rev().find(|&&k| k as f64 <= u);
            let above = corners.iter().find(|&&k| k as f64 > u);
            match (below, above) {
                (Some(&a), Some(&b)) => Some((a as f64, b as f64)),
                // A closed curve whose first handle is no corner begins inside a stretch.
                _ if corners.is_empty() => None,
                _ => Some((0.0, spans as f64)),
            }
        })
        .collect();
    let fixed: Vec<bool> = (0..n)
        .map(|k| (pinned && handles[k].corner) || (!closed && (k == 0 || k == n - 1)))
        .collect();
    let mut kept = None;
    for _ in 0..ROUNDS {
        let moved = least_squares(&handles, even, order, &us, closed, &fixed, &counts)?;
        handles.iter_mut().zip(moved).for_each(|(handle, at)| handle.at = at);
        let Some(curve) = curve(&handles, closed) else { break };
        let looked: Vec<Point2> = (0..=spans * PLACES)
            .map(|i| curve.position(i as f64 / PLACES as f64))
            .map(|p| Point2::new(p.x, p.y))
            .collect();
        for ((u, &place), bounds) in us.iter_mut().zip(order).zip(&bounds) {
            *u = nearest(&looked, even[place % m], *u, *bounds);
        }
        let placed = placed(&handles, order, &us, m, closed.then_some(spans as f64));
        // A curve that runs back along the stroke fits worse than that of the last round.
        if !placed.windows(2).all(|pair| pair[0].place < pair[1].place) {
            break;
        }
        kept = Some(placed);
    }
    kept
}

/// The handles with the places that lie nearest to them, counted on from the first round a closed
/// stroke, which has `round` spans.
fn placed(
    handles: &[Handle],
    order: &[usize],
    us: &[f64],
    m: usize,
    round: Option<f64>,
) -> Vec<Handle> {
    let mut placed = handles.to_vec();
    for k in 0..placed.len() {
        let near = |i: &usize| {
            let apart = (us[*i] - k as f64).abs();
            round.map_or(apart, |round| apart.min(round - apart))
        };
        if let Some(i) = (0..us.len()).min_by(|a, b| near(a).total_cmp(&near(b))) {
            placed[k].place = order[i] % m;
        }
        if round.is_some() && placed[k].place < placed[0].place {
            placed[k].place += m;
        }
    }
    placed
}

/// The parameter nearest to `p` of a curve given by places on it, near `u`, and within bounds; on a
/// closed curve without bounds, counted on round it.
fn nearest(looked: &[Point2], p: Point2, u: f64, bounds: Option<(f64, f64)>) -> f64 {
    let last = (looked.len() - 1) as i64;
    let scale = PLACES as f64;
    let (low, high) = bounds.unwrap_or((u - REACH, u + REACH));
    let from = ((u - REACH).max(low) * scale).floor() as i64;
    let to = ((u + REACH).min(high) * scale).ceil() as i64;
    let mut best = (f64::INFINITY, u);
    for i in from..to {
        let i = i.rem_euclid(last) as usize;
        let (a, b): (Point2, Point2) = (looked[i], looked[i + 1]);
        let along: Vec2 = b - a;
        let squared = along.length_squared();
        let t = if squared > 0.0 { ((p - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
        let off = p.distance(a.lerp(b, t));
        if off < best.0 {
            best = (off, (i as f64 + t) / scale);
        }
    }
    best.1
}

fn least_squares(
    handles: &[Handle],
    even: &[Point2],
    order: &[usize],
    us: &[f64],
    closed: bool,
    fixed: &[bool],
    counts: &impl Fn(usize) -> bool,
) -> Option<Vec<Point2>> {
    let n = handles.len();
    curve(handles, closed)?;
    let shares = point_shares(CurveKind::Spline, &points_of(handles), closed);
    let mut matrix = vec![vec![0.0; n]; n];
    let mut right = vec![Vec2::ZERO; n];
    let origin = handles[0].at;
    let mut row = vec![0.0; n];
    for (&place, &u) in order.iter().zip(us) {
        if !counts(place) {
            continue;
        }
        let span = (u.max(0.0).floor() as usize).min(shares.len() - 1);
        let t = (u - span as f64).clamp(0.0, 1.0);
        let s = 1.0 - t;
        let bernstein = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        row.fill(0.0);
        for (control, weight) in shares[span].iter().zip(bernstein) {
            control.iter().for_each(|share| row[share.point] += weight * share.factor);
        }
        let to = even[place % even.len()] - origin;
        for i in 0..n {
            for j in 0..n {
                matrix[i][j] += row[i] * row[j];
            }
            right[i] += to * row[i];
        }
    }
    for i in 0..n {
        let to = handles[i].at - origin;
        if fixed[i] {
            // Its terms in the other equations move to the right sides.
            for j in 0..n {
                let shared = matrix[j][i];
                right[j] -= to * shared;
                (matrix[j][i], matrix[i][j]) = (0.0, 0.0);
            }
            (matrix[i][i], right[i]) = (1.0, to);
        } else {
            matrix[i][i] += STAY;
            right[i] += to * STAY;
        }
    }
    let solution = positive_definite(matrix, right)?;
    Some(solution.into_iter().map(|way| origin + way).collect())
}

/// The solution of a symmetric, positive definite system, by elimination; `None` if it is not
/// positive definite.
fn positive_definite(mut matrix: Vec<Vec<f64>>, mut right: Vec<Vec2>) -> Option<Vec<Vec2>> {
    let n = right.len();
    for i in 0..n {
        let pivot = matrix[i][i];
        if !(pivot > 0.0 && pivot.is_finite()) {
            return None;
        }
        for j in i + 1..n {
            let factor = matrix[j][i] / pivot;
            for k in i..n {
                matrix[j][k] -= factor * matrix[i][k];
            }
            let above = right[i];
            right[j] -= above * factor;
        }
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            let known = right[k];
            right[i] -= known * matrix[i][k];
        }
        right[i] /= matrix[i][i];
    }
    Some(right)
}
