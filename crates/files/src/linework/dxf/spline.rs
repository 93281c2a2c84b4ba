//! B-splines with weights as rational Bézier curves: each control point of a piece is the polar
//! form (blossom) of the spline at the ends of its knot interval, by de Boor's recursion with one
//! argument a level.

use super::super::drawn::MAX_SEGMENTS;
use super::super::segment::Segment;
use sheetwright::curve::{Curve, CurveKind, CurvePoint};
use sheetwright::math::Point3;

/// The highest degree that is read.
const MAX_DEGREE: usize = 15;

/// A spline as a file has it.
pub(super) struct Spline {
    pub(super) degree: usize,
    pub(super) knots: Vec<f64>,
    pub(super) weights: Vec<f64>,
    pub(super) control: Vec<Point3>,
}

impl Spline {
    /// Its pieces.
    ///
    /// # Errors
    /// What is wrong with its numbers, in words.
    pub(super) fn pieces(&self) -> Result<Vec<Segment>, String> {
        let Self { degree, knots, weights, control } = self;
        let (degree, count) = (*degree, control.len());
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(format!("its degree is {degree}; 1 to {MAX_DEGREE} are read"));
        }
        if count > MAX_SEGMENTS {
            return Err(format!("it has more than {MAX_SEGMENTS} control points"));
        }
        if count <= degree {
            return Err(format!("it has {count} control points and degree {degree}"));
        }
        if knots.len() != count + degree + 1 {
            let needed = count + degree + 1;
            return Err(format!("it has {} knots and needs {needed}", knots.len()));
        }
        if !knots.windows(2).all(|pair| pair[0] <= pair[1]) {
            return Err("its knots do not ascend".to_owned());
        }
        if !(weights.is_empty() || weights.len() == count) {
            return Err(format!("it has {} weights for {count} points", weights.len()));
        }
        if !weights.iter().all(|w| *w > 0.0 && w.is_finite()) {
            return Err("its weights are not all above 0".to_owned());
        }
        let weighted: Vec<[f64; 4]> = control
            .iter()
            .enumerate()
            .map(|(n, p)| {
                let w = weights.get(n).copied().unwrap_or(1.0);
                [p.x * w, p.y * w, p.z * w, w]
            })
            .collect();
        let pieces = (degree..count).filter(|&k| knots[k] < knots[k + 1]).map(|k| {
            let (a, b) = (knots[k], knots[k + 1]);
            let corner = |i: usize| {
                let at = |level: usize| if level < degree - i { a } else { b };
                blossom(&weighted[k - degree..=k], &knots[k - degree..], degree, at)
            };
            Segment::rational((0..=degree).map(corner).collect())
        });
        Ok(pieces.collect())
    }
}

/// The polar form of the piece of these control points, whose first has the knots from `knots` on.
fn blossom(
    points: &[[f64; 4]],
    knots: &[f64],
    degree: usize,
    at: impl Fn(usize) -> f64,
) -> [f64; 4] {
    let mut d = points.to_vec();
    for level in 1..=degree {
        for j in (level..=degree).rev() {
            let (low, high) = (knots[j], knots[j + degree + 1 - level]);
            let share = if high > low { (at(level - 1) - low) / (high - low) } else { 0.0 };
            d[j] = std::array::from_fn(|n| d[j - 1][n] * (1.0 - share) + d[j][n] * share);
        }
    }
    d[degree]
}

/// The interpolating spline through points, of splines that have no control points, and whether it
/// is closed: one of two points is not.
///
/// # Errors
/// Too few points, in words.
pub(super) fn through(points: &[Point3], closed: bool) -> Result<(Vec<Segment>, bool), String> {
    let mut points: Vec<CurvePoint> = points.iter().map(|p| CurvePoint::smooth(*p)).collect();
    points.dedup_by(|b, a| a.at == b.at);
    if closed && points.len() > 2 && points[0].at == points[points.len() - 1].at {
        points.pop();
    }
    let closed = closed && points.len() > 2;
    let curve =
        Curve::new(CurveKind::Spline, &points, closed).map_err(|error| format!("it {error}"))?;
    Ok((curve.spans().iter().map(|span| Segment::bezier(&span.control)).collect(), closed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_of_nine_points_is_round() {
        let corners = [(1., 0.), (1., 1.), (0., 1.), (-1., 1.), (-1., 0.), (-1., -1.), (0., -1.)];
        let corners = corners.into_iter().chain([(1., -1.), (1., 0.)]);
        let control: Vec<Point3> = corners.map(|(x, y)| Point3::new(x, y, 0.0)).collect();
        let w = std::f64::consts::FRAC_1_SQRT_2;
        let weights = (0..9).map(|n| if n % 2 == 0 { 1.0 } else { w }).collect();
        let knots = vec![0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
        let pieces = Spline { degree: 2, knots, weights, control }.pieces().unwrap();
        assert_eq!(pieces.len(), 4);
        for piece in &pieces {
            for n in 0..=8 {
                let p = piece.position(f64::from(n) / 8.0).to_vec();
                assert!((p.length() - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_uniform_spline_begins_where_its_basis_says() {
        let control: Vec<Point3> =
            [0.0, 6.0, 0.0, 6.0, 0.0].map(|y| Point3::new(y, y * y, 1.0)).to_vec();
        let knots = (0..9).map(f64::from).collect();
        let pieces = Spline { degree: 3, knots, weights: Vec::new(), control }.pieces().unwrap();
        // (P0 + 4 P1 + P2) / 6
        assert_eq!(pieces.len(), 2);
        assert!(pieces[0].start().distance(Point3::new(4.0, 24.0, 1.0)) < 1e-13);
        assert!(pieces[0].end().distance(pieces[1].start()) < 1e-13);
    }
}
