//! The flat pattern of a quad mesh.

use super::QuadMesh;
use crate::flatten::{FlattenError, Flattened, lay_flat};
use crate::sheet::Sheet;
use crate::surface::{Connectivity, ConnectivityError, Surface};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::watch::Watch;

impl QuadMesh {
    /// The mesh in triangles, with its vertices as samples. Each quad is divided along its shorter
    /// diagonal (of equals that from its first corner); a quad with a reflex corner, along the
    /// diagonal from there.
    ///
    /// # Errors
    /// If the faces are no manifold with the loops as its border; those of
    /// [`quads`](super::quads) are.
    pub fn triangulated(&self) -> Result<Surface, ConnectivityError> {
        let mut triangles = Vec::new();
        for face in self.faces() {
            match *face {
                [a, b, c, d] if self.is_divided_at_first(face) => {
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
                [a, b, c, d] => triangles.extend([[b, c, d], [b, d, a]]),
                [a, b, c] => triangles.push([a, b, c]),
                _ => {}
            }
        }
        let triangles = triangles.into_iter().map(|t| t.map(SampleIndex::new)).collect();
        Ok(Surface::new(Connectivity::new(&self.loops, triangles)?, self.positions()))
    }

    /// How many quads cross themselves: neither diagonal divides them in two triangles that face
    /// one side. Such a quad folds over when it is laid flat.
    pub fn crossed_quads(&self) -> usize {
        let is_crossed = |face: &&[usize]| {
            face.len() == 4 && self.leaning(face, 0) <= 0.0 && self.leaning(face, 1) <= 0.0
        };
        self.faces().filter(is_crossed).count()
    }

    /// Positive if the two triangles of a quad, divided at corner `n`, face one side.
    fn leaning(&self, quad: &[usize], n: usize) -> f64 {
        let at = |k: usize| self.vertices[quad[(n + k) % 4]].position;
        let across = at(2) - at(0);
        (at(1) - at(0)).cross(across).dot(across.cross(at(3) - at(0)))
    }

    fn is_divided_at_first(&self, quad: &[usize]) -> bool {
        let length = |n: usize| {
            self.vertices[quad[n]].position.distance(self.vertices[quad[n + 2]].position)
        };
        match (self.leaning(quad, 0) > 0.0, self.leaning(quad, 1) > 0.0) {
            (true, false) => true,
            (false, true) => false,
            _ => length(0) <= length(1),
        }
    }
}

/// Lays a quad mesh flat, as [`lay_flat`] does a surface: cut open near these places, mm, if it
/// must be. All sides keep their lengths, and so do both diagonals of planar quads.
///
/// # Errors
/// See [`FlattenError`]; and [`FlattenError::Pieces`] for a mesh that is no manifold.
pub fn lay_quads_flat(
    mesh: &QuadMesh,
    near: &[Point3],
    watch: &mut dyn Watch,
) -> Result<(Sheet, Flattened), FlattenError> {
    let surface = mesh.triangulated().map_err(|_| FlattenError::Pieces)?;
    lay_flat(&surface, near, watch)
}
