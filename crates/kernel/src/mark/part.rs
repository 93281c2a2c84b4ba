//! A part as marks see it: its triangles in space and on the flat pattern.

use crate::edge::Edge;
use crate::flatten::{Beside, shares};
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
        let (triangles, positions) = (self.mesh.triangles(), self.mesh.positions());
        let nearest = Beside { triangles, positions, flat: self.flat }.nearest(to);
        (nearest.flat, nearest.off_mm)
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
