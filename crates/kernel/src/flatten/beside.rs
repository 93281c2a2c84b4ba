//! Where a place near a surface lies on it, and where that is on its pattern: at the same shares of
//! the corners of a triangle.

use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec3};
use sheetwright_geometry::triangle::nearest_in_triangle;

/// A surface in space beside its pattern.
pub(crate) struct Beside<'a> {
    /// The triangles of both.
    pub(crate) triangles: &'a [[VertexIndex; 3]],
    /// Where the vertices lie in space, mm.
    pub(crate) positions: &'a [Point3],
    /// Where the vertices lie on the pattern, mm.
    pub(crate) flat: &'a [Point2],
}

/// The point of a surface that is nearest to a place.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Nearest {
    /// Where it is in space, mm.
    pub(crate) at: Point3,
    /// Where it lies on the pattern, mm.
    pub(crate) flat: Point2,
    /// How far it is from the place, mm; infinite without triangles.
    pub(crate) off_mm: f64,
}

impl Beside<'_> {
    /// The point of the surface that is nearest to a place; of several, that of the first triangle.
    pub(crate) fn nearest(&self, to: Point3) -> Nearest {
        let mut best = Nearest { off_mm: f64::INFINITY, ..Nearest::default() };
        for triangle in self.triangles {
            let at = nearest_in_triangle(triangle.map(|v| self.positions[v.get()]), to);
            let off_mm = at.distance(to);
            if off_mm < best.off_mm {
                best = Nearest { at, flat: self.carried(*triangle, at), off_mm };
            }
        }
        best
    }

    /// Where a point of a triangle in space lies on the pattern.
    fn carried(&self, triangle: [VertexIndex; 3], at: Point3) -> Point2 {
        let [a, b, c] = triangle.map(|v| self.positions[v.get()]);
        let [s, t] = shares(b - a, c - a, at - a).unwrap_or_default();
        let [a, b, c] = triangle.map(|v| self.flat[v.get()]);
        a + (b - a) * s + (c - a) * t
    }
}

/// The shares of two vectors whose sum is nearest to a third; `None` where they are parallel.
pub(crate) fn shares(first: Vec3, second: Vec3, sum: Vec3) -> Option<[f64; 2]> {
    let (aa, ab, bb) = (first.dot(first), first.dot(second), second.dot(second));
    let (a, b) = (first.dot(sum), second.dot(sum));
    let whole = aa * bb - ab * ab;
    (whole > 0.0).then(|| [(bb * a - ab * b) / whole, (aa * b - ab * a) / whole])
}
