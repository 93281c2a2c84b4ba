//! The shapes of triangles by their lengths, and how the plane has them.

use crate::mesh::Topology;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Point2, Vec2, atan2};
use sheetwright_geometry::predicate::orientation;

/// A triangle by its lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Twice its area, mm².
    pub doubled_area: f64,
    /// The products of the two sides at each corner with the cosine of the angle between them, mm².
    pub dots: [f64; 3],
}

impl Shape {
    /// The shape with sides from the first corner to the second, on to the third, and back; `None`
    /// where they make no triangle.
    pub(super) fn of([ab, bc, ca]: [f64; 3]) -> Option<Self> {
        let [x, y, z] = sorted([ab, bc, ca]);
        // Kahan's form of Heron's, which keeps the digits of needles; x is the longest.
        let product = (x + (y + z)) * (z - (x - y)) * (z + (x - y)) * (x + (y - z));
        let doubled_area = 0.5 * product.max(0.0).sqrt();
        let [a2, b2, c2] = [ab, bc, ca].map(|side| side * side);
        let dots = [c2 + a2 - b2, a2 + b2 - c2, b2 + c2 - a2].map(|twice| 0.5 * twice);
        (doubled_area > 0.0 && doubled_area.is_finite()).then_some(Self { doubled_area, dots })
    }

    /// The angle at each corner, radians.
    pub(super) fn angles(&self) -> [f64; 3] {
        self.dots.map(|dot| atan2(self.doubled_area, dot))
    }

    /// The cotangent of the angle at each corner.
    pub(super) fn cotangents(&self) -> [f64; 3] {
        self.dots.map(|dot| dot / self.doubled_area)
    }
}

fn sorted([a, b, c]: [f64; 3]) -> [f64; 3] {
    let (a, b) = (a.max(b), a.min(b));
    let (b, c) = (b.max(c), b.min(c));
    [a.max(b), a.min(b), c]
}

/// The corners of a triangle in the plane.
pub(super) fn corners_of(topology: &Topology, triangle: usize, points: &[Point2]) -> [Point2; 3] {
    topology.triangles()[triangle].map(|v| points[v.get()])
}

/// How many triangles do not run counter-clockwise. Exact.
pub(super) fn flipped(topology: &Topology, points: &[Point2]) -> usize {
    (0..topology.triangles().len())
        .filter(|&n| {
            let [a, b, c] = corners_of(topology, n, points);
            !orientation(a, b, c).is_gt()
        })
        .count()
}

/// Whether the triangles round every inner vertex go round it once. If all of them run
/// counter-clockwise, no two that are near one another overlap then. Exact: differences of
/// coordinates have the right sign.
pub(super) fn goes_round_once(topology: &Topology, points: &[Point2]) -> bool {
    let upper = |from: Point2, to: Point2| to.y > from.y || (to.y == from.y && to.x > from.x);
    let mut turns = vec![0u32; points.len()];
    for corners in topology.triangles() {
        for at in 0..3 {
            let [v, next, last] = [0, 1, 2].map(|k| corners[(at + k) % 3].get());
            // Angles of triangles are below half a turn: a full turn comes up through the x axis
            // once.
            if !upper(points[v], points[next]) && upper(points[v], points[last]) {
                turns[v] += 1;
            }
        }
    }
    let on_border = topology.on_border();
    turns.iter().zip(on_border).all(|(&turns, on_border)| on_border || turns == 1)
}

/// No step squeezes a triangle below this share of its area in space, nor one that is below already
/// by much more: flatter ones turn over by rounding, and a sheet does not do it anyway.
pub(super) const LEAST_AREA: f64 = 0.01;

/// The largest share of a step, at most 1, on whose way no triangle is squeezed below
/// [`LEAST_AREA`].
pub(super) fn longest_step(
    topology: &Topology,
    shapes: &[Shape],
    points: &[Point2],
    step: &[Vec2],
) -> f64 {
    // The area of a triangle whose corners move evenly is a + b·t + c·t².
    let mut longest = f64::INFINITY;
    for (corners, shape) in topology.triangles().iter().zip(shapes) {
        let [p, q, r] = corners.map(|v| points[v.get()]);
        let [u, v, w] = corners.map(|v| step[v.get()]);
        let (d1, d2, e1, e2) = (q - p, r - p, v - u, w - u);
        let (a, b, c) = (d1.perp_dot(d2), d1.perp_dot(e2) + e1.perp_dot(d2), e1.perp_dot(e2));
        let least = (LEAST_AREA * shape.doubled_area).min(0.999 * a);
        longest = longest.min(first_zero(a - least, b, c));
    }
    // Rounding must not take what is kept.
    (0.99 * longest).min(1.0)
}

/// The least t > 0 where a + b·t + c·t², positive at 0, is zero; infinite where it stays positive.
fn first_zero(a: f64, b: f64, c: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return f64::INFINITY;
    }
    // The form of the roots that has no difference of near numbers.
    let q = -0.5 * (b + if b < 0.0 { -1.0 } else { 1.0 } * discriminant.sqrt());
    let positive = |t: f64| if t > 0.0 { t } else { f64::INFINITY };
    positive(q / c).min(positive(a / q))
}

/// The corners of a triangle laid down with the first at the origin and the second along x.
pub(super) fn laid_down(shape: &Shape, first_side: f64) -> [Vec2; 3] {
    let height = shape.doubled_area / first_side;
    [Vec2::ZERO, Vec2::new(first_side, 0.0), Vec2::new(shape.dots[0] / first_side, height)]
}

/// The shapes of all triangles.
///
/// # Errors
/// The first whose lengths make no triangle.
pub(super) fn shapes(topology: &Topology, lengths: &[f64]) -> Result<Vec<Shape>, TriangleIndex> {
    (0..topology.triangles().len())
        .map(|n| {
            let triangle = TriangleIndex::new(n);
            Shape::of(topology.edges_of(triangle).map(|edge| lengths[edge])).ok_or(triangle)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_of_lengths() {
        let right = Shape::of([3.0, 5.0, 4.0]).unwrap();
        assert_eq!(right.doubled_area, 12.0);
        assert!((right.angles()[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        assert_eq!(laid_down(&right, 3.0)[2], Vec2::new(0.0, 4.0));
        assert!(Shape::of([1.0, 2.0, 3.0]).is_none());
        let sum: f64 = Shape::of([1.0, 1e-3, 1.0]).unwrap().angles().iter().sum();
        assert!((sum - std::f64::consts::PI).abs() < 1e-12);
    }

    #[test]
    fn a_moving_triangle_is_flat_at_the_first_zero() {
        assert_eq!(first_zero(1.0, -1.0, 0.0), 1.0);
        assert_eq!(first_zero(2.0, -3.0, 1.0), 1.0);
        assert_eq!(first_zero(2.0, 3.0, 1.0), f64::INFINITY);
        assert_eq!(first_zero(1.0, 0.0, 1.0), f64::INFINITY);
        assert_eq!(first_zero(1.0, 0.0, -1.0), 1.0);
    }
}
