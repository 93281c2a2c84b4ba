//! How sharply a mesh turns at its sides.

use super::Mesh;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::angle_between;

/// The angle between the two triangles at every side, radians, in the order of [`Mesh::edges`]; 0
/// on the border.
pub fn crease_angles(mesh: &Mesh) -> Vec<f64> {
    let turn = |triangles: [Option<TriangleIndex>; 2]| match triangles {
        [Some(a), Some(b)] => angle_between(mesh.area_vector(a), mesh.area_vector(b)),
        _ => 0.0,
    };
    mesh.edges().iter().map(|edge| turn(edge.triangles)).collect()
}
