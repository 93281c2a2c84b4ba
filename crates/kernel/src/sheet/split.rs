//! A mesh divided into panels along its sharp creases or other sides.

use super::{Sheet, cut_along};
use crate::mesh::{Cut, Mesh, MeshError, crease_angles};
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::TriangleIndex;

/// The sheet of a mesh that is taken apart along the sides at which it turns by more than
/// `crease`, radians, so that every part is a piece of its own. A crease that ends within a part is
/// not cut: it separates nothing.
///
/// # Errors
/// See [`MeshError`]; a valid mesh has none.
pub fn split_along_creases(mesh: &Mesh, crease: f64) -> Result<Sheet, MeshError> {
    let turns = crease_angles(mesh);
    split_at(mesh, |n| turns[n] > crease)
}

/// The sheet of a mesh that is taken apart along some of its sides, so that every part that they
/// enclose is a piece of its own. Sides within a part are not cut.
///
/// # Errors
/// See [`MeshError`]; a valid mesh has none.
pub(crate) fn split_at(mesh: &Mesh, parts_at: impl Fn(usize) -> bool) -> Result<Sheet, MeshError> {
    let mut parts = DisjointSets::new(mesh.triangles().len());
    for (n, edge) in mesh.edges().iter().enumerate() {
        if let ([Some(a), Some(b)], false) = (edge.triangles, parts_at(n)) {
            parts.join(a.get(), b.get());
        }
    }
    let mut apart = |triangles: [Option<TriangleIndex>; 2]| match triangles {
        [Some(a), Some(b)] => parts.first(a.get()) != parts.first(b.get()),
        _ => false,
    };
    let cut: Cut = (0..mesh.edges().len()).filter(|&n| apart(mesh.edges()[n].triangles)).collect();
    cut_along(mesh, &cut)
}
