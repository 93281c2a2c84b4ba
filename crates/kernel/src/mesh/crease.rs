//! How sharply a mesh turns at its sides.

use super::Mesh;
use super::zigzag::of_zigzags;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{angle_between, from_deg};

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

/// The angle at every side that is scored, radians: a crease above [`SCORED_CREASE_DEG`] other than
/// those that one row of triangles has where it is twisted; 0 elsewhere.
pub fn scored_creases(mesh: &Mesh) -> Vec<f64> {
    let mut angles = crease_angles(mesh);
    let is_zigzag = of_zigzags(mesh);
    for (angle, is_zigzag) in angles.iter_mut().zip(is_zigzag) {
        if is_zigzag || *angle <= from_deg(SCORED_CREASE_DEG) {
            *angle = 0.0;
        }
    }
    angles
}
