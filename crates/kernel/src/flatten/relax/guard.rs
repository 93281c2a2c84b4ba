//! What keeps triangles from being squeezed flat where lengths alone would have it.
//!
//! Sides as springs do not mind a triangle whose corners lie on one line. So a triangle whose area
//! has come below a share a₀ of what it is in space costs ½·κ·log²(a/a₀), a being its share:
//! nothing at a₀, without bound as it is flattened. Where no triangle is squeezed so much, it is
//! not there.

use super::Inner;
use sheetwright_geometry::math::sparse::Matrix;
use sheetwright_geometry::math::{Point2, Vec2, ln};

/// Triangles are guarded below this share of their area. A sheet never comes here: it would be
/// stretched or squeezed by half.
const GUARDED: f64 = 0.3;

/// The guarded triangles of a form.
pub(super) struct Guard {
    stiffness: f64,
    /// The number, log(a/a₀), and its derivative by the corners.
    squeezed: Vec<(usize, f64, [Vec2; 3])>,
}

impl Guard {
    /// The guard of a form, as stiff as a side of this weight.
    pub(super) fn new(inner: &Inner<'_>, points: &[Point2], stiffness: f64) -> Self {
        let squeezed = squeezed(inner, points).map(|(n, depth)| {
            let [p, q, r] = inner.corners(n, points);
            let doubled_area = (q - p).perp_dot(r - p);
            (n, depth, [r - q, p - r, q - p].map(|side| side.perp() / doubled_area))
        });
        Self { stiffness, squeezed: squeezed.collect() }
    }

    /// Its cost for other points.
    pub(super) fn cost(&self, inner: &Inner<'_>, points: &[Point2]) -> f64 {
        let squares = squeezed(inner, points).map(|(_, depth)| depth * depth);
        0.5 * self.stiffness * squares.sum::<f64>()
    }

    /// Adds its part of the matrix of Gauss and Newton.
    pub(super) fn add_to(&self, inner: &Inner<'_>, matrix: &mut Matrix<'_, 2>) {
        let outer = |a: Vec2, b: Vec2| {
            let k = self.stiffness;
            [[k * a.x * b.x, k * a.x * b.y], [k * a.y * b.x, k * a.y * b.y]]
        };
        for &(n, _, by) in &self.squeezed {
            let corners = inner.topology.triangles()[n];
            let edges = inner.edges_of(n);
            for k in 0..3 {
                let next = (k + 1) % 3;
                matrix.add_diagonal(corners[k].get(), outer(by[k], by[k]));
                // Pairs are sides, the lower vertex first.
                let upwards = corners[k] < corners[next];
                let (low, high) = if upwards { (k, next) } else { (next, k) };
                matrix.add_pair(edges[k], outer(by[low], by[high]));
            }
        }
    }

    /// Adds what it pulls at the vertices.
    pub(super) fn add_pulls(&self, inner: &Inner<'_>, force: &mut [[f64; 2]]) {
        for &(n, depth, by) in &self.squeezed {
            for (corner, by) in inner.topology.triangles()[n].iter().zip(by) {
                force[corner.get()][0] -= self.stiffness * depth * by.x;
                force[corner.get()][1] -= self.stiffness * depth * by.y;
            }
        }
    }

    /// How fast its cost changes along a step.
    pub(super) fn slope(&self, inner: &Inner<'_>, step: &[[f64; 2]]) -> f64 {
        let change = |&(n, depth, by): &(usize, f64, [Vec2; 3])| {
            let corners = inner.topology.triangles()[n].iter().zip(by);
            let along: f64 = corners.map(|(v, by)| by.dot(Vec2::from(step[v.get()]))).sum();
            self.stiffness * depth * along
        };
        self.squeezed.iter().map(change).sum()
    }
}

/// The guarded triangles of some points, with log(a/a₀).
fn squeezed<'a>(
    inner: &'a Inner<'_>,
    points: &'a [Point2],
) -> impl Iterator<Item = (usize, f64)> + 'a {
    inner.shapes.iter().enumerate().filter_map(move |(n, shape)| {
        let [p, q, r] = inner.corners(n, points);
        let share = (q - p).perp_dot(r - p) / (GUARDED * shape.doubled_area);
        (share < 1.0).then(|| (n, ln(share)))
    })
}
