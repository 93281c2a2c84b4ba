//! A quadratic triangle: six nodes, the corners first, then the middles of the sides from each
//! corner to the next. Its sides may be curved.

use sheetwright_geometry::math::{Point2, Vec2};

/// The nodes of an element.
pub(super) type Nodes = [usize; 6];

/// Where in a triangle something is evaluated: barycentric coordinates of the second and the third
/// corner.
pub(super) type Place = [f64; 2];

/// The middle of a triangle.
pub(super) const CENTROID: Place = [1.0 / 3.0; 2];

/// The derivatives of the six shape functions at a place, by the coordinates of the flat sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Derivatives {
    /// First derivatives, 1/mm.
    pub(super) gradients: [Vec2; 6],
    /// Second derivatives by xx, yy and xy, 1/mm².
    pub(super) hessians: [[f64; 3]; 6],
    /// The area of the triangle as it is here, mm²: half of the determinant of the map.
    pub(super) area: f64,
}

/// The values of the six shape functions.
pub(super) fn values([s, t]: Place) -> [f64; 6] {
    let r = 1.0 - s - t;
    [
        r * (2.0 * r - 1.0),
        s * (2.0 * s - 1.0),
        t * (2.0 * t - 1.0),
        4.0 * r * s,
        4.0 * s * t,
        4.0 * t * r,
    ]
}

/// The derivatives of the six shape functions by s and t.
fn first([s, t]: Place) -> [[f64; 2]; 6] {
    let r = 1.0 - s - t;
    [
        [1.0 - 4.0 * r, 1.0 - 4.0 * r],
        [4.0 * s - 1.0, 0.0],
        [0.0, 4.0 * t - 1.0],
        [4.0 * (r - s), -4.0 * s],
        [4.0 * t, 4.0 * s],
        [-4.0 * t, 4.0 * (r - t)],
    ]
}

/// Their second derivatives by ss, tt and st.
const SECOND: [[f64; 3]; 6] = [
    [4.0, 4.0, 4.0],
    [4.0, 0.0, 0.0],
    [0.0, 4.0, 0.0],
    [-8.0, 0.0, -4.0],
    [0.0, 0.0, 4.0],
    [0.0, -8.0, -4.0],
];

impl Derivatives {
    /// Those of a triangle whose nodes lie at these points of the flat sheet, mm; `None` where the
    /// triangle is turned over.
    pub(super) fn at(nodes: [Point2; 6], place: Place) -> Option<Self> {
        let first = first(place);
        let sum = |of: &dyn Fn(usize) -> f64| -> Vec2 {
            (0..6).fold(Vec2::ZERO, |sum, n| sum + nodes[n].to_vec() * of(n))
        };
        // The map from s, t to the sheet and its second derivatives.
        let [by_s, by_t] = [sum(&|n| first[n][0]), sum(&|n| first[n][1])];
        let second = [sum(&|n| SECOND[n][0]), sum(&|n| SECOND[n][1]), sum(&|n| SECOND[n][2])];
        let determinant = by_s.perp_dot(by_t);
        if determinant.is_nan() || determinant <= 0.0 {
            return None;
        }
        // The derivatives of s and t by x and y.
        let (s, t) = (
            Vec2::new(by_t.y, -by_t.x) * (1.0 / determinant),
            Vec2::new(-by_s.y, by_s.x) * (1.0 / determinant),
        );
        let gradients: [Vec2; 6] = std::array::from_fn(|n| s * first[n][0] + t * first[n][1]);
        let hessians = std::array::from_fn(|n| {
            // What is left of the second derivatives once the bend of the map is taken away.
            let own: [f64; 3] = std::array::from_fn(|k| SECOND[n][k] - gradients[n].dot(second[k]));
            let [ss, tt, st] = own;
            [
                ss * s.x * s.x + tt * t.x * t.x + 2.0 * st * s.x * t.x,
                ss * s.y * s.y + tt * t.y * t.y + 2.0 * st * s.y * t.y,
                ss * s.x * s.y + tt * t.x * t.y + st * (s.x * t.y + s.y * t.x),
            ]
        });
        Some(Self { gradients, hessians, area: 0.5 * determinant })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle with one bent side.
    fn bent() -> [Point2; 6] {
        let p = Point2::new;
        [p(0., 0.), p(4., 1.), p(1., 3.), p(2.1, 0.3), p(2.5, 2.), p(0.5, 1.5)]
    }

    #[test]
    fn shape_functions_are_one_at_their_node_and_sum_to_one() {
        let places = [[0., 0.], [1., 0.], [0., 1.], [0.5, 0.], [0.5, 0.5], [0., 0.5]];
        for (n, place) in places.into_iter().enumerate() {
            let values = values(place);
            assert!((0..6).all(|k| (values[k] - f64::from(u8::from(k == n))).abs() < 1e-15));
        }
        let sum: f64 = values([0.2, 0.3]).iter().sum();
        assert!((sum - 1.0).abs() < 1e-15);
    }

    #[test]
    fn linear_functions_have_their_gradient_and_no_hessian_in_bent_triangles() {
        let d = Derivatives::at(bent(), [0.2, 0.5]).unwrap();
        let of = |n: usize| 3.0 * bent()[n].x - 2.0 * bent()[n].y + 5.0;
        let gradient = (0..6).fold(Vec2::ZERO, |sum, n| sum + d.gradients[n] * of(n));
        assert!((gradient - Vec2::new(3.0, -2.0)).length() < 1e-12);
        for k in 0..3 {
            let sum: f64 = (0..6).map(|n| d.hessians[n][k] * of(n)).sum();
            assert!(sum.abs() < 1e-12, "{sum}");
        }
    }

    #[test]
    fn quadratic_functions_have_their_hessian_in_straight_triangles() {
        let p = Point2::new;
        let (a, b, c) = (p(0., 0.), p(4., 1.), p(1., 3.));
        let nodes = [a, b, c, a.lerp(b, 0.5), b.lerp(c, 0.5), c.lerp(a, 0.5)];
        let d = Derivatives::at(nodes, [0.3, 0.1]).unwrap();
        let of = |p: Point2| p.x * p.x - 3.0 * p.x * p.y + 0.5 * p.y * p.y + p.x;
        let sum = |k: usize| (0..6).map(|n| d.hessians[n][k] * of(nodes[n])).sum::<f64>();
        for (k, wanted) in [2.0, 1.0, -3.0].into_iter().enumerate() {
            assert!((sum(k) - wanted).abs() < 1e-12, "{}", sum(k));
        }
        assert!((d.area - 5.5).abs() < 1e-12);
    }
}
