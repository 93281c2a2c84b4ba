//! How sharply a mesh turns at its sides.

use super::Mesh;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::angle_between;

/// Creases above this angle, degrees, are scored: below it they may be the facets that a smooth
/// bend was divided into; a circle has as much of a turn at each of fourteen sides.
pub const SCORED_CREASE_DEG: f64 = 25.0;

/// The angle between the two triangles at every side, radians, in the order of [`Mesh::edges`]; 0
/// on the border.
pub fn crease_angles(mesh: &Mesh) -> Vec<f64> {
    let turn = |triangles: [Option<TriangleIndex>; 2]| match triangles {
        [Some(a), Some(b)] => angle_between(mesh.area_vector(a), mesh.area_vector(b)),
        _ => 0.0,
    };
    mesh.edges().iter().map(|edge| turn(edge.triangles)).collect()
}
