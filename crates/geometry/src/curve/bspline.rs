//! The uniform cubic B-spline.
//!
//! Every span is turned into Bézier form by its blossom \[Ramshaw1989\]: over the knots
//! u_1 … u_6 that a span [u_3, u_4] depends on, the control point of Bézier form with k of its
//! three arguments at the end of the span is the blossom at (u_3 … u_3, u_4 … u_4). Open ends are
//! clamped: the knots there are repeated, so that the curve begins at the first control point and
//! runs towards the second.

use super::{Cubic, StretchMaker};
use crate::math::Point3;

pub(super) const BSPLINE: StretchMaker =
    StretchMaker { open: |_, points| clamped(points), closed: |_, points| periodic(points) };

/// The periodic B-spline with these control points (3 or more). The spans begin at the points of
/// the curve nearest to the first control point.
fn periodic(points: &[Point3]) -> Vec<Cubic> {
    let m = points.len();
    let knots = [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0];
    (0..m).map(|i| bezier([i + m - 1, i, i + 1, i + 2].map(|k| points[k % m]), knots)).collect()
}

/// The clamped B-spline with these control points (2 or more). Two or three make one span of degree
/// one or two, raised to three.
fn clamped(points: &[Point3]) -> Vec<Cubic> {
    match *points {
        [a, b] => vec![Cubic::line(a, b)],
        [a, b, c] => vec![Cubic { control: [a, a.lerp(b, 2.0 / 3.0), c.lerp(b, 2.0 / 3.0), c] }],
        _ => {
            let spans = points.len() - 3;
            let knot = |k: usize| (k as f64 - 3.0).clamp(0.0, spans as f64);
            (0..spans)
                .map(|i| {
                    bezier(
                        [0, 1, 2, 3].map(|k| points[i + k]),
                        [1, 2, 3, 4, 5, 6].map(|k| knot(i + k)),
                    )
                })
                .collect()
        }
    }
}

/// The span between the two middle knots, of the four control points that reach it.
fn bezier(points: [Point3; 4], knots: [f64; 6]) -> Cubic {
    let (start, end) = (knots[2], knots[3]);
    let control = [
        blossom(points, knots, [start, start, start]),
        blossom(points, knots, [start, start, end]),
        blossom(points, knots, [start, end, end]),
        blossom(points, knots, [end, end, end]),
    ];
    Cubic { control }
}

/// The blossom at three arguments: de Boor's algorithm with another argument in every round.
fn blossom(mut points: [Point3; 4], knots: [f64; 6], arguments: [f64; 3]) -> Point3 {
    for (round, argument) in arguments.into_iter().enumerate() {
        for i in 0..3 - round {
            let (low, high) = (knots[i + round], knots[i + 3]);
            points[i] = points[i].lerp(points[i + 1], (argument - low) / (high - low));
        }
    }
    points[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn control(m: usize) -> Vec<Point3> {
        (0..m).map(|i| Point3::new(i as f64, ((i * i) % 7) as f64, ((3 * i) % 5) as f64)).collect()
    }

    #[test]
    fn inner_spans_have_the_textbook_form() {
        let p = control(9);
        let span = clamped(&p)[2];
        let third = |a: Point3, b: Point3| a.lerp(b, 1.0 / 3.0);
        let textbook = third(p[3], p[2]).lerp(third(p[3], p[4]), 0.5);
        assert!(span.control[0].distance(textbook) < 1e-12);
        assert!(span.control[1].distance(third(p[3], p[4])) < 1e-12);
    }

    #[test]
    fn clamped_ends_interpolate() {
        for m in 2..8 {
            let p = control(m);
            let spans = clamped(&p);
            assert!(spans[0].position(0.0).distance(p[0]) < 1e-12);
            assert!(spans[spans.len() - 1].position(1.0).distance(p[m - 1]) < 1e-12);
        }
    }

    #[test]
    fn curvature_is_continuous_in_a_ring() {
        let spans = periodic(&control(7));
        for i in 0..7 {
            let (a, b) = (spans[i], spans[(i + 1) % 7]);
            assert!((a.derivative(1.0) - b.derivative(0.0)).length() < 1e-12);
            assert!((a.second_derivative(1.0) - b.second_derivative(0.0)).length() < 1e-12);
        }
    }
}
