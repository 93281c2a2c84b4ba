//! A panel whose surface is given as a mesh.

use crate::flatten::Aim;
use crate::mesh::Skin;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point3;
use std::sync::Arc;

/// Triangles of one part, or of several separate ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Their vertices, mm, each used by some triangle.
    pub positions: Vec<Point3>,
    /// Their corners.
    pub triangles: Vec<[VertexIndex; 3]>,
    /// How many triangles were left out because two of their corners lie in one place.
    pub left_out: usize,
}

/// The surface of a panel as a mesh, and how it is laid flat.
#[derive(Clone, Debug)]
pub struct PanelMesh {
    /// Its triangles, which copies of a design share.
    pub triangles: Arc<Triangles>,
    /// What flattening minimises where it can't be exact. Default: the mean length error.
    pub aim: Aim,
    /// The mesh is divided into parts along creases above this angle, radians. Default: it is not.
    pub split_creases: Option<f64>,
    /// Whether parts that would stretch by more than the limit of the material are cut from their
    /// border to the points that stretch most. Default: they are not.
    pub darts: bool,
    /// The skin that is laid flat of a plate that comes as a closed mesh with two. Default: all of
    /// the mesh.
    pub skin: Option<Skin>,
}

impl PanelMesh {
    /// A mesh that is laid flat with the defaults.
    pub fn new(triangles: Triangles) -> Self {
        let triangles = Arc::new(triangles);
        Self { triangles, aim: Aim::Mean, split_creases: None, darts: false, skin: None }
    }
}

impl PartialEq for PanelMesh {
    fn eq(&self, other: &Self) -> bool {
        // Copies of a design are compared at every move of a handle.
        let same_triangles =
            Arc::ptr_eq(&self.triangles, &other.triangles) || self.triangles == other.triangles;
        same_triangles
            && (self.aim, self.split_creases, self.darts, self.skin)
                == (other.aim, other.split_creases, other.darts, other.skin)
    }
}
