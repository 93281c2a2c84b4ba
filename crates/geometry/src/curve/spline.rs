//! The interpolating cubic spline over chord length.
//!
//! With h_i the chord from point i to i + 1, the derivatives d_i of the twice differentiable
//! piecewise cubic obey, at every inner point,
//! h_i d_{i−1} + 2 (h_{i−1} + h_i) d_i + h_{i−1} d_{i+1} = 3 (h_i s_{i−1} + h_{i−1} s_i),
//! where s_i is the slope of chord i. Natural ends have no second derivative:
//! 2 d_0 + d_1 = 3 s_0. A closed spline closes the system into a ring. With the chords given, all
//! of it is linear in the points.

use super::{Cubic, StretchMaker};
use crate::math::{Point3, Vec3};

pub(super) const SPLINE: StretchMaker = StretchMaker { open: natural, closed: periodic };

/// The spline through `points` (2 or more) with natural ends, over the chords of `shape`.
fn natural(shape: &[Point3], points: &[Point3]) -> Vec<Cubic> {
    let m = points.len();
    let h: Vec<f64> = shape.windows(2).map(|p| p[0].distance(p[1])).collect();
    let s: Vec<Vec3> = points.windows(2).zip(&h).map(|(p, h)| (p[1] - p[0]) / *h).collect();
    let mut rows = Vec::with_capacity(m);
    rows.push(Row { before: 0.0, here: 2.0, after: 1.0, right: s[0] * 3.0 });
    for i in 1..m - 1 {
        rows.push(inner_row(h[i - 1], h[i], s[i - 1], s[i]));
    }
    rows.push(Row { before: 1.0, here: 2.0, after: 0.0, right: s[m - 2] * 3.0 });
    let d = solve(&rows);
    (0..m - 1).map(|i| span(points[i], points[i + 1], d[i], d[i + 1], h[i])).collect()
}

/// The periodic spline through `points` (3 or more), the last joined to the first, over the chords
/// of `shape`.
fn periodic(shape: &[Point3], points: &[Point3]) -> Vec<Cubic> {
    let m = points.len();
    let h: Vec<f64> = (0..m).map(|i| shape[i].distance(shape[(i + 1) % m])).collect();
    let s: Vec<Vec3> = (0..m).map(|i| (points[(i + 1) % m] - points[i]) / h[i]).collect();
    let rows: Vec<Row> =
        (0..m).map(|i| inner_row(h[(i + m - 1) % m], h[i], s[(i + m - 1) % m], s[i])).collect();
    let d = solve_ring(&rows);
    (0..m).map(|i| span(points[i], points[(i + 1) % m], d[i], d[(i + 1) % m], h[i])).collect()
}

fn span(a: Point3, b: Point3, a_slope: Vec3, b_slope: Vec3, h: f64) -> Cubic {
    Cubic::hermite(a, a_slope * h, b, b_slope * h)
}

/// One equation: before · d_{i−1} + here · d_i + after · d_{i+1} = right.
#[derive(Clone, Copy)]
struct Row {
    before: f64,
    here: f64,
    after: f64,
    right: Vec3,
}

fn inner_row(h_before: f64, h: f64, s_before: Vec3, s: Vec3) -> Row {
    Row {
        before: h,
        here: 2.0 * (h_before + h),
        after: h_before,
        right: (s_before * h + s * h_before) * 3.0,
    }
}

/// Solves the tridiagonal system (diagonally dominant, so elimination needs no pivots).
fn solve(rows: &[Row]) -> Vec<Vec3> {
    let m = rows.len();
    let mut after = vec![0.0; m];
    let mut d = vec![Vec3::ZERO; m];
    for i in 0..m {
        let Row { before, here, after: next, right } = rows[i];
        let (after_before, d_before) =
            if i == 0 { (0.0, Vec3::ZERO) } else { (after[i - 1], d[i - 1]) };
        let pivot = here - before * after_before;
        after[i] = next / pivot;
        d[i] = (right - d_before * before) / pivot;
    }
    for i in (0..m - 1).rev() {
        let next = d[i + 1];
        d[i] -= next * after[i];
    }
    d
}

/// Solves the ring, whose first row also names the last unknown and whose last row the first, as
/// a tridiagonal system plus a product of two vectors (Sherman and Morrison).
fn solve_ring(rows: &[Row]) -> Vec<Vec3> {
    let m = rows.len();
    let (corner_top, corner_bottom) = (rows[0].before, rows[m - 1].after);
    let gamma = -rows[0].here;
    let mut cut = rows.to_vec();
    cut[0].here -= gamma;
    cut[m - 1].here -= corner_top * corner_bottom / gamma;
    let y = solve(&cut);
    for row in &mut cut {
        row.right = Vec3::ZERO;
    }
    cut[0].right.x = gamma;
    cut[m - 1].right.x = corner_bottom;
    let z: Vec<f64> = solve(&cut).into_iter().map(|v| v.x).collect();
    let share = corner_top / gamma;
    let factor = (y[0] + y[m - 1] * share) / (1.0 + z[0] + z[m - 1] * share);
    (0..m).map(|i| y[i] - factor * z[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wavy(m: usize) -> Vec<Point3> {
        (0..m)
            .map(|i| {
                let t = std::f64::consts::TAU * i as f64 / m as f64 + 0.1 * (i % 3) as f64;
                Point3::new(
                    crate::math::cos(t),
                    crate::math::sin(t),
                    0.3 * crate::math::sin(3.0 * t),
                )
            })
            .collect()
    }

    /// Second derivative by chord length at both sides of every joint.
    fn kinks(spans: &[Cubic], joints: impl Iterator<Item = (usize, usize)>) -> f64 {
        let h = |c: &Cubic| c.control[0].distance(c.control[3]);
        joints
            .map(|(a, b)| {
                let (a, b) = (&spans[a], &spans[b]);
                let jump = a.second_derivative(1.0) / (h(a) * h(a))
                    - b.second_derivative(0.0) / (h(b) * h(b));
                jump.length()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn second_derivatives_are_continuous() {
        let points = wavy(11);
        let spans = natural(&points, &points);
        assert!(kinks(&spans, (0..9).map(|i| (i, i + 1))) < 1e-9);
        assert!(spans[0].second_derivative(0.0).length() < 1e-12);
        assert!(spans[9].second_derivative(1.0).length() < 1e-12);
        let spans = periodic(&points, &points);
        assert!(kinks(&spans, (0..11).map(|i| (i, (i + 1) % 11))) < 1e-9);
    }

    #[test]
    fn two_points_make_a_line() {
        let ends = [Point3::new(0.0, 0.0, 0.0), Point3::new(3.0, 0.0, 0.0)];
        let spans = natural(&ends, &ends);
        assert!((spans[0].derivative(0.3).x - 3.0).abs() < 1e-14);
    }
}
