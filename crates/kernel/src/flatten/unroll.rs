//! Exact unrolling: triangle is laid beside triangle.
//!
//! The triangles of a surface without interior vertices and without holes form a tree by their
//! rungs. The first is laid down, and each neighbour beside it by its three lengths. No length is
//! changed but by rounding. The walk starts at the middle of the tree's longest way, so that
//! rounding travels half as far.

use super::{FlattenError, Flattened, pose::posed};
use crate::surface::Connectivity;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::first_crossing;
use sheetwright_geometry::watch::Watch;

/// Lays a surface flat, given the lengths between samples that are joined, mm.
///
/// # Errors
/// See [`FlattenError`].
pub fn unroll(
    connectivity: &Connectivity,
    length: impl Fn(SampleIndex, SampleIndex) -> f64,
    watch: &mut dyn Watch,
) -> Result<Flattened, FlattenError> {
    let triangles = connectivity.triangles();
    if connectivity.hinges().len() + 1 != triangles.len() || connectivity.loops().len() != 1 {
        let cycle = connectivity.hinges().len() + 1 > triangles.len();
        return Err(if cycle { FlattenError::Cycle } else { FlattenError::Pieces });
    }
    if watch.stop() {
        return Err(FlattenError::Stopped);
    }
    let order = Tree::new(connectivity).outwards();
    let mut points: Vec<Option<Point2>> = vec![None; connectivity.samples()];
    for &(triangle, entered_by) in &order {
        let [a, b, c] = match entered_by {
            // Turned so that the side that is already laid comes first.
            Some([from, to]) => [from, to, connectivity.far_corner(triangle, [from, to])],
            None => triangles[triangle.get()],
        };
        if entered_by.is_none() {
            points[a.get()] = Some(Point2::new(0.0, 0.0));
            points[b.get()] = Some(Point2::new(length(a, b), 0.0));
        }
        let (Some(at_a), Some(at_b)) = (points[a.get()], points[b.get()]) else {
            return Err(FlattenError::Pieces);
        };
        let laid = beside(at_a, at_b, length(a, b), length(a, c), length(b, c));
        points[c.get()] = Some(laid.ok_or(FlattenError::NoTriangle { triangle })?);
    }
    let points: Option<Vec<Point2>> = points.into_iter().collect();
    let points = posed(&points.ok_or(FlattenError::Pieces)?, &connectivity.loops()[0]);
    let overlap = first_crossing(&points[connectivity.loops()[0].clone()]);
    Ok(Flattened { points, overlap })
}

/// The third corner of a triangle to the left of a–b, whose sides are ab, ac and bc long; `None`
/// where the lengths make no triangle.
pub(super) fn beside(a: Point2, b: Point2, ab: f64, ac: f64, bc: f64) -> Option<Point2> {
    // From the nearer end, so that the foot of the height loses no digits.
    let (origin, near, far, sign) = if ac <= bc { (a, ac, bc, 1.0) } else { (b, bc, ac, -1.0) };
    // near² − far² as a product keeps digits where both are much longer than ab.
    let foot = 0.5 * (ab + (near - far) * (near + far) / ab);
    let height_squared = (near - foot) * (near + foot);
    // Rounding may leave a flat triangle a little less than none.
    let rounding = -1e-9 * near * near.max(ab);
    if !(foot.is_finite() && height_squared >= rounding) {
        return None;
    }
    let height = height_squared.max(0.0).sqrt();
    // The laid side has its length but for rounding; its direction is what is needed.
    let along = (b - a) / (b - a).length();
    let left = Vec2::new(-along.y, along.x);
    Some(origin + along * (foot * sign) + left * height)
}

/// The triangles as a tree.
struct Tree<'a> {
    connectivity: &'a Connectivity,
    hinges: Vec<Vec<usize>>,
}

/// A triangle and the side it is laid at, in the direction in which it lies to the left.
type Laid = (TriangleIndex, Option<[SampleIndex; 2]>);

impl<'a> Tree<'a> {
    fn new(connectivity: &'a Connectivity) -> Self {
        Self { connectivity, hinges: connectivity.hinges_of_triangles() }
    }

    /// All triangles, each after the one that it is laid at.
    fn outwards(&self) -> Vec<Laid> {
        let first = TriangleIndex::new(0);
        let one_end = self.walk(first).last().map_or(first, |laid| laid.0);
        let back = self.walk(one_end);
        // The way back from the other end, half of it.
        let mut parent = vec![None; self.connectivity.triangles().len()];
        let mut depth = vec![0usize; parent.len()];
        for &(triangle, side) in &back {
            if let Some(side) = side {
                let before = self.across(triangle, side);
                parent[triangle.get()] = Some(before);
                depth[triangle.get()] = depth[before.get()] + 1;
            }
        }
        let mut middle = back.last().map_or(one_end, |laid| laid.0);
        let half = depth[middle.get()] / 2;
        while depth[middle.get()] > half {
            match parent[middle.get()] {
                Some(before) => middle = before,
                None => break,
            }
        }
        self.walk(middle)
    }

    /// All triangles by their distance from `start`, nearest first.
    fn walk(&self, start: TriangleIndex) -> Vec<Laid> {
        let mut order = vec![(start, None)];
        let mut at = 0;
        while at < order.len() {
            let (triangle, entered): Laid = order[at];
            at += 1;
            for &n in &self.hinges[triangle.get()] {
                let hinge = self.connectivity.hinges()[n];
                let [low, high] = hinge.rung.ends();
                // The first triangle of a hinge lies to the left of low → high.
                let (other, side) = if hinge.triangles[0] == triangle {
                    (hinge.triangles[1], [high, low])
                } else {
                    (hinge.triangles[0], [low, high])
                };
                let came_from = entered.is_some_and(|e| e == [side[1], side[0]]);
                if !came_from {
                    order.push((other, Some(side)));
                }
            }
        }
        order
    }

    /// The triangle on the other side of a side.
    fn across(&self, triangle: TriangleIndex, side: [SampleIndex; 2]) -> TriangleIndex {
        let rung = sheetwright_optimum::rung::Rung::new(side[0].get(), side[1].get());
        self.hinges[triangle.get()]
            .iter()
            .map(|&n| self.connectivity.hinges()[n])
            .find(|hinge| hinge.rung == rung)
            .map_or(triangle, |hinge| {
                let [a, b] = hinge.triangles;
                if a == triangle { b } else { a }
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_third_corner_keeps_both_lengths() {
        for (ab, ac, bc) in [(3.0, 4.0, 5.0), (1e-3, 10.0, 10.0), (5.0, 1e-4, 5.0), (2.0, 1.0, 1.0)]
        {
            let (a, b) = (Point2::new(0.0, 0.0), Point2::new(ab * 0.6, ab * 0.8));
            let c = beside(a, b, ab, ac, bc).unwrap();
            assert!((c.distance(a) - ac).abs() < 1e-12 * ac.max(bc), "{ab} {ac} {bc}");
            assert!((c.distance(b) - bc).abs() < 1e-12 * ac.max(bc), "{ab} {ac} {bc}");
            assert!((b - a).perp_dot(c - a) >= 0.0);
        }
        assert!(beside(Point2::new(0., 0.), Point2::new(1., 0.), 1.0, 0.2, 0.3).is_none());
    }
}
