//! Flat faces of a mesh, each laid in its plane.
//!
//! The triangles of most faces form a tree, like those of a polygon that a file divides. They are
//! laid one beside the other, so that every length is exact even where rounding has moved points
//! off the plane. A face with points inside or with holes has no such layout: the ways round them
//! close but for rounding, which short sides of narrow triangles turn into angles. It is projected
//! on its plane, square to the sum of its area vectors. A triangle that rounding turns by an angle
//! then loses lengths by the square of that angle, and no other triangle feels it.

use super::unroll::beside;
use crate::mesh::Mesh;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Frame, Point2, Vec3, unit};

/// A flat face in its plane, as seen from the side that it faces.
pub(crate) struct LaidFace {
    /// Its vertices, in increasing order.
    pub(crate) vertices: Vec<VertexIndex>,
    /// Where they lie, mm.
    pub(crate) points: Vec<Point2>,
    /// The sum of its area vectors, mm².
    pub(crate) area: Vec3,
}

/// A face of these triangles, which hang together; `faces` has the face of every triangle.
pub(crate) fn laid_face(mesh: &Mesh, triangles: &[usize], faces: &[usize]) -> LaidFace {
    let corners = |n: usize| mesh.triangles()[n];
    let mut vertices: Vec<VertexIndex> = triangles.iter().flat_map(|&n| corners(n)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let area: Vec3 = triangles.iter().map(|&n| mesh.area_vector(TriangleIndex::new(n))).sum();
    let tree = if vertices.len() == triangles.len() + 2 {
        by_triangles(mesh, triangles, faces, &vertices)
    } else {
        None
    };
    let points = tree.unwrap_or_else(|| {
        let plane = Frame::with_normal(mesh.position(vertices[0]), unit(area).unwrap_or(Vec3::Z));
        let flat = |v: &VertexIndex| {
            plane.map_or(Point2::default(), |plane| plane.project(mesh.position(*v)))
        };
        vertices.iter().map(flat).collect()
    });
    LaidFace { vertices, points, area }
}

/// The points of a face laid triangle by triangle, from the largest outwards; `None` where its
/// triangles form no tree.
fn by_triangles(
    mesh: &Mesh,
    triangles: &[usize],
    faces: &[usize],
    vertices: &[VertexIndex],
) -> Option<Vec<Point2>> {
    let area = |n: usize| mesh.area_vector(TriangleIndex::new(n)).length();
    let largest = triangles.iter().copied().reduce(|a, b| if area(b) > area(a) { b } else { a })?;
    let length = |a: VertexIndex, b: VertexIndex| mesh.position(a).distance(mesh.position(b));
    let place = |v: VertexIndex| vertices.binary_search(&v).ok();
    let mut points: Vec<Option<Point2>> = vec![None; vertices.len()];
    let [a, b, _] = mesh.triangles()[largest];
    points[place(a)?] = Some(Point2::default());
    points[place(b)?] = Some(Point2::new(length(a, b), 0.0));
    // A triangle, and which of its sides is laid already.
    let mut waiting = vec![(largest, 0)];
    let mut at = 0;
    while let Some(&(triangle, entered)) = waiting.get(at) {
        at += 1;
        let corners = mesh.triangles()[triangle];
        let [a, b, c] = [0, 1, 2].map(|n| corners[(entered + n) % 3]);
        let (at_a, at_b) = (points[place(a)?]?, points[place(b)?]?);
        let laid = beside(at_a, at_b, length(a, b), length(a, c), length(b, c))?;
        // Laid before, it would close a cycle.
        if points[place(c)?].replace(laid).is_some() {
            return None;
        }
        let sides = mesh.topology().edges_of(TriangleIndex::new(triangle));
        for (k, &side) in sides.iter().enumerate() {
            if k == entered && at > 1 {
                continue;
            }
            let both = mesh.edges()[side].triangles.into_iter().flatten().map(|t| t.get());
            let mut others = both.filter(|&t| t != triangle && faces[t] == faces[triangle]);
            if let Some(other) = others.next() {
                let entered = mesh.topology().edges_of(TriangleIndex::new(other));
                waiting.push((other, entered.iter().position(|&n| n == side)?));
            }
        }
    }
    points.into_iter().collect()
}
