//! Meshes from elsewhere as one plain value: the other kind of design, whose surfaces are given
//! instead of found.

use crate::material::Material;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point3;

/// Triangles that are one panel, or several that do not hang together.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshGroup {
    /// Its name; no two groups share one.
    pub name: String,
    /// Its vertices, mm, each used by some triangle.
    pub positions: Vec<Point3>,
    /// Its triangles.
    pub triangles: Vec<[VertexIndex; 3]>,
    /// How many of its triangles were left out because two of their corners lie in one place.
    pub left_out: usize,
}

/// All inputs of the main job, where surfaces are given as meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshDesign {
    /// Its name.
    pub name: String,
    /// The sheet it is made from, if one is named.
    pub material: Option<Material>,
    /// Its groups.
    pub groups: Vec<MeshGroup>,
}
