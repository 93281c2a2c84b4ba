//! A mesh from elsewhere: triangles over vertices in space, with interior vertices or without.
//!
//! [`Topology`] knows which vertices are joined and nothing of where they lie; [`Mesh`] adds
//! positions. Both are validated once, in [`Mesh::new`], and trusted afterwards: every side belongs
//! to one triangle or two, every vertex has one fan of triangles, neighbours run the same way
//! round, no triangle is without area, and the whole is not smaller than [`MIN_SIZE_MM`]. A mesh
//! may be of several [`Component`]s.

mod along;
mod corners;
mod crease;
mod cut;
mod error;
mod heal;
mod rounding;
mod skins;
mod specks;
mod topology;
mod tree;
mod ways;
mod zigzag;

pub use along::SeamFault;
pub(crate) use along::{Before, sides_along};
pub(crate) use corners::separated;
pub use crease::{SCORED_CREASE_DEG, crease_angles, scored_creases};
pub use cut::{Cut, angle_defects, cut_of_part, cut_through, cut_to_disk, worst_points};
pub use error::MeshError;
pub use heal::{Damage, Healed, Healing, healed};
pub(crate) use rounding::Rounding;
pub use skins::{Skin, Skins, two_skins};
pub use specks::Specks;
pub(crate) use specks::{WithoutSpecks, without_specks};
pub use topology::{Component, MeshEdge, Topology};
pub(crate) use ways::Ways;

use crate::surface::{Surface, signed_crease};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::tolerance::MIN_SIZE_MM;

/// The most triangles that a mesh may have: two million take about a gigabyte on their way to a
/// pattern.
pub const MAX_TRIANGLES: usize = 2_000_000;

/// No vertex of a mesh from a file lies farther out, mm: what is measured from the centre of the
/// Earth, in metres, reaches 6.4e9 mm, where doubles lie 1e-6 mm apart; here, 1.5e-5 mm.
pub const MAX_MESH_COORDINATE_MM: f64 = 1e11;

/// A triangle is without area if its least height is below this share of its longest side: a
/// thousand times the height that rounding to 16 digits gives to three points on a line.
const LEAST_HEIGHT: f64 = 1e-12;

/// Triangles over vertices in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<Point3>,
    topology: Topology,
}

impl Mesh {
    /// The mesh of `triangles` over vertices at `positions`, mm. Triangles that run the other way
    /// round than most of their component are turned round; where as many run each way, the first
    /// stays.
    ///
    /// # Errors
    /// See [`MeshError`]. Vertices that no triangle uses are for the caller to leave out.
    pub fn new(
        positions: Vec<Point3>,
        triangles: Vec<[VertexIndex; 3]>,
    ) -> Result<Self, MeshError> {
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        let found = triangles.len().max(positions.len());
        if found > MAX_TRIANGLES {
            return Err(MeshError::TooMany { found });
        }
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshError::NotFinite { vertex: VertexIndex::new(vertex) });
        }
        if size_of(positions.iter().copied()) < MIN_SIZE_MM {
            return Err(MeshError::TooSmall);
        }
        for (n, corners) in triangles.iter().enumerate() {
            let triangle = TriangleIndex::new(n);
            if corners.iter().any(|v| v.get() >= positions.len()) {
                return Err(MeshError::BadCorner { triangle });
            }
            let at = corners.map(|v| positions[v.get()]);
            if corners[0] == corners[1]
                || corners[1] == corners[2]
                || corners[2] == corners[0]
                || !has_area(at)
            {
                return Err(MeshError::Degenerate { triangle });
            }
        }
        let mut topology = Topology::new(positions.len(), triangles)?;
        topology.sort_loops(|a, b| positions[a.get()].distance(positions[b.get()]));
        Ok(Self { positions, topology })
    }

    /// The mesh of the triangles of a surface without interior vertices, whose loops keep their
    /// order and whose samples keep their numbers. It is valid as the surface is: nothing is looked
    /// at again, so triangles may be without area.
    pub(crate) fn of_surface(surface: &Surface) -> Self {
        let topology = Topology::of_surface(surface.connectivity());
        Self { positions: surface.positions().to_vec(), topology }
    }

    /// The mesh with its vertices elsewhere, mm: as many as there are. Nothing is looked at again.
    pub(crate) fn moved_to(self, positions: Vec<Point3>) -> Self {
        Self { positions, ..self }
    }

    /// Where the vertices lie, mm.
    pub fn positions(&self) -> &[Point3] {
        &self.positions
    }

    /// Which vertices are joined.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The triangles; the corners of neighbours run the same way round, counter-clockwise as seen
    /// from the side that the mesh faces.
    pub fn triangles(&self) -> &[[VertexIndex; 3]] {
        self.topology.triangles()
    }

    /// All sides, in increasing order of their ends.
    pub fn edges(&self) -> &[MeshEdge] {
        self.topology.edges()
    }

    /// The loops of the border, the longest (in mm) first, each in the direction of the triangles
    /// that it belongs to and from its lowest vertex on.
    pub fn loops(&self) -> &[Vec<VertexIndex>] {
        self.topology.loops()
    }

    /// The connected components, in the order of their lowest triangles.
    pub fn components(&self) -> &[Component] {
        self.topology.components()
    }

    /// Euler's number, vertices − sides + triangles: 1 for a disk, 0 for a ring, 2 for a sphere.
    pub fn euler(&self) -> isize {
        self.topology.euler()
    }

    /// Where a vertex lies, mm.
    pub fn position(&self, vertex: VertexIndex) -> Point3 {
        self.positions[vertex.get()]
    }

    /// The lengths of the sides, mm, in the order of [`Mesh::edges`].
    pub fn lengths(&self) -> Vec<f64> {
        let length =
            |edge: &MeshEdge| self.position(edge.ends[0]).distance(self.position(edge.ends[1]));
        self.edges().iter().map(length).collect()
    }

    /// The corners of a triangle, mm.
    pub fn corners(&self, triangle: TriangleIndex) -> [Point3; 3] {
        self.triangles()[triangle.get()].map(|v| self.position(v))
    }

    /// The area vector of a triangle, mm²: along its normal, as long as its area.
    pub fn area_vector(&self, triangle: TriangleIndex) -> Vec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a) * 0.5
    }

    /// The angle between two triangles that share a side, radians in −π ..= π: positive where the
    /// mesh bends away from the side that it faces. The first triangle lies to the left of the side
    /// as its `ends` run.
    pub fn crease(&self, ends: [VertexIndex; 2], triangles: [TriangleIndex; 2]) -> f64 {
        let [from, to] = ends.map(|v| self.position(v));
        signed_crease(triangles.map(|t| self.area_vector(t)), to - from)
    }

    /// The mesh of some of the triangles alone, as of one component or of one group, with the
    /// number in this mesh of each of its vertices, in increasing order.
    ///
    /// # Errors
    /// See [`MeshError`]: triangles of a part of a component may meet only in a point, and no
    /// triangles are no mesh.
    pub fn part(&self, triangles: &[TriangleIndex]) -> Result<(Self, Vec<VertexIndex>), MeshError> {
        let corners = || triangles.iter().map(|t| self.triangles()[t.get()]);
        let mut vertices: Vec<VertexIndex> = corners().flatten().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut number = vec![0; self.positions.len()];
        for (n, vertex) in vertices.iter().enumerate() {
            number[vertex.get()] = n;
        }
        let positions = vertices.iter().map(|&v| self.position(v)).collect();
        let renamed = corners().map(|t| t.map(|v| VertexIndex::new(number[v.get()]))).collect();
        Ok((Self::new(positions, renamed)?, vertices))
    }
}

/// Whether three points are the corners of a triangle with an area.
fn has_area([a, b, c]: [Point3; 3]) -> bool {
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let doubled_area = (b - a).cross(c - a).length();
    // Also refused where products leave the range of numbers.
    longest.is_finite() && doubled_area > LEAST_HEIGHT * longest * longest
}

#[cfg(test)]
mod tests;
