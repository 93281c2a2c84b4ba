//! A part as marks see it: its triangles in space and on the flat pattern.

use crate::edge::Edge;
use crate::mesh::Mesh;
use crate::pattern::Room;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec2, Vec3, unit, unit2};
use sheetwright_geometry::triangle::nearest_in_triangle;

/// A direction in space is square to a triangle where it lies less than this along it, as the sine
/// of 3°.
const SQUARE_SIN: f64 = 0.052_335_956_242_943_83;

/// A part that is marked.
pub(crate) struct MarkPart<'a> {
    /// Its name.
    pub(crate) name: &'a str,
    /// The panel that it is made of.
    pub(crate) panel: &'a str,
    /// Its edges.
    pub(crate) edges: &'a [Edge],
    /// Its sheet in space.
    pub(crate) mesh: &'a Mesh,
    /// Where the vertices of that lie on the pattern, mm.
    pub(crate) flat: &'a [Point2],
    /// The inside of its finished outline.
    pub(crate) room: Room,
}

impl MarkPart<'_> {
    /// Where a vertex lies on the pattern.
    pub(super) fn laid(&self, vertex: VertexIndex) -> Point2 {
        self.flat[vertex.get()]
    }

    /// The edge of a name.
    pub(super) fn edge(&self, name: &str) -> Option<&Edge> {
        self.edges.iter().find(|edge| edge.name == name)
    }

    /// The place on the pattern of the point of the part that is nearest to a place in space, and
    /// how far that is off, mm.
    pub(super) fn nearest(&self, to: Point3) -> (Point2, f64) {
        let mut best = (Point2::default(), f64::INFINITY);
        for triangle in self.mesh.triangles() {
            let corners = triangle.map(|v| self.mesh.position(v));
            let at = nearest_in_triangle(corners, to);
            let off = at.distance(to);
            if off < best.1 {
                best = (self.carried(*triangle, at), off);
            }
        }
        best
    }

    /// Where a point of a triangle in space lies on the pattern: at the same shares of its corners.
    fn carried(&self, triangle: [VertexIndex; 3], at: Point3) -> Point2 {
        let [a, b, c] = triangle.map(|v| self.mesh.position(v));
        let [s, t] = shares(b - a, c - a, at - a).unwrap_or_default();
        let [a, b, c] = triangle.map(|v| self.laid(v));
        a + (b - a) * s + (c - a) * t
    }

    /// The triangle that a place of the pattern lies in, or that is nearest to it.
    fn triangle_at(&self, place: Point2) -> Option<[VertexIndex; 3]> {
        let lifted = place.to_vec().extend(0.0);
        let off = |triangle: &[VertexIndex; 3]| {
            let corners = triangle.map(|v| Point3::from_vec(self.laid(v).to_vec().extend(0.0)));
            nearest_in_triangle(corners, Point3::from_vec(lifted))
                .distance(Point3::from_vec(lifted))
        };
        let all = self.mesh.triangles().iter().map(|triangle| (off(triangle), *triangle));
        all.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, triangle)| triangle)
    }

    /// The direction on the pattern, at a place of it, of a vector in space that is laid on the
    /// part there; `None` where it is square to the part.
    pub(super) fn way_at(&self, place: Point2, way: Vec3) -> Option<Vec2> {
        let triangle = self.triangle_at(place)?;
        let [a, b, c] = triangle.map(|v| self.mesh.position(v));
        let normal = unit((b - a).cross(c - a))?;
        let way = unit(way)?;
        let along = way - normal * normal.dot(way);
        if along.length() < SQUARE_SIN {
            return None;
        }
        let [s, t] = shares(b - a, c - a, along)?;
        let [a, b, c] = triangle.map(|v| self.laid(v));
        unit2((b - a) * s + (c - a) * t)
    }
}

/// The shares of two vectors whose sum is nearest to a third; `None` where they are parallel.
fn shares(first: Vec3, second: Vec3, sum: Vec3) -> Option<[f64; 2]> {
    let (aa, ab, bb) = (first.dot(first), first.dot(second), second.dot(second));
    let (a, b) = (first.dot(sum), second.dot(sum));
    let whole = aa * bb - ab * ab;
    (whole > 0.0).then(|| [(bb * a - ab * b) / whole, (aa * b - ab * a) / whole])
}
