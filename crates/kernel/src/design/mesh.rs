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
    /// Whether its facets are folded and nothing is stretched, as a paper model is made. Default:
    /// where the mesh would not bend as one surface, or its pattern would overlap itself, and its
    /// facets are coarse ([`crate::nets::Coarseness::is_meant`]).
    pub facets: Option<bool>,
    /// The width and height of a rectangle that no piece of facets exceeds, mm. Default: no limit.
    pub pieces_within_mm: Option<[f64; 2]>,
    /// Ways along which it is cut, each by points, mm: from the vertex nearest to one to that
    /// nearest to the next, along sides. Copies of a design share them. Default: the lines of its
    /// file, if any.
    pub seams: Arc<Vec<Vec<Point3>>>,
}

impl PanelMesh {
    /// A mesh that is laid flat with the defaults.
    pub fn new(triangles: Triangles) -> Self {
        let triangles = Arc::new(triangles);
        Self {
            triangles,
            aim: Aim::Mean,
            split_creases: None,
            darts: false,
            skin: None,
            facets: None,
            pieces_within_mm: None,
            seams: Arc::default(),
        }
    }
}

impl PartialEq for PanelMesh {
    fn eq(&self, other: &Self) -> bool {
        // Copies of a design are compared at every move of a handle.
        let same_triangles =
            Arc::ptr_eq(&self.triangles, &other.triangles) || self.triangles == other.triangles;
        let settings = |mesh: &Self| {
            let Self { aim, split_creases, darts, skin, facets, pieces_within_mm, .. } = mesh;
            (*aim, *split_creases, *darts, *skin, *facets, *pieces_within_mm)
        };
        same_triangles && settings(self) == settings(other) && self.seams == other.seams
    }
}
