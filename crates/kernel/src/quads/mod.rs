//! From the triangles of a surface without interior vertices to planar quads.
//!
//! The rungs of an optimal triangulation lie along the rulings of the surface, except those that
//! cross a strip aslant because samples of its two sides do not lie opposite one another. Planar
//! quads need one rung for each ruling, with separate vertices at both ends. \[L11\] section 6 and
//! \[G14\] make them in five steps:
//!
//! 1. A vertex with more than three sides is a candidate.
//! 2. A rung between two candidates is a candidate; a heap holds them by their bending angle.
//! 3. The flattest is removed, and the heap updated, until it is empty (`merge`).
//! 4. The remaining candidate vertices are found.
//! 5. Each candidate v becomes deg(v) − 2 copies, spread over a small stretch of the boundary about
//!    v, one for each of its rungs, so that each has three sides (`spread`).
//!
//! Then no two rungs share a vertex. A face between two rungs is a quad. A face with one rung is
//! the end of a strip, with the samples there that never had a rung: one sample makes a triangle,
//! the two of a straight end make a quad. A face with three rungs or more, where strips meet, is a
//! larger polygon; it is split into quads (`split`), so that its vertices have more than three
//! sides again.
//!
//! The quads are not planar yet. [`planar`] makes them so by sliding their vertices along the
//! boundary \[LPW06\]; [`lay_quads_flat`] unrolls them, and [`smooth`] makes ruled strips of them.

mod flat;
mod merge;
mod planar;
mod smooth;
mod solve;
mod split;
mod spread;

pub use flat::lay_quads_flat;
pub use planar::{Planar, PlanarEnd, PlanarOptions, planar};
pub use smooth::{EdgeCurve, FaceShape, Rail, SmoothEdge, SmoothFace, SmoothSurface, smooth};

use crate::surface::Surface;
use sheetwright_geometry::boundary::{Boundary, Outline};
use sheetwright_geometry::math::Point3;
use std::ops::Range;

/// A vertex of a quad mesh: a place on the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// The loop that it lies on.
    pub of_loop: usize,
    /// Its arc length along the outline of the loop, mm, which increases from vertex to vertex,
    /// beginning a little before the first sample.
    pub along_mm: f64,
    /// Whether it is a corner of the boundary, where it stays.
    pub is_corner: bool,
    /// Its position, mm: its place on the outline, unless it had to leave it.
    pub position: Point3,
}

/// A part of the surface between the rungs that are left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Its vertices, counter-clockwise as seen from the side that the surface faces.
    pub corners: Vec<usize>,
    /// The quads that divide the cell, and triangles where needed; the cell itself if it has no
    /// more than four corners.
    pub faces: Vec<Vec<usize>>,
}

/// A surface of quads, and a few triangles, whose vertices all lie on the boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadMesh {
    /// The vertices, loop after loop, each loop in order.
    pub vertices: Vec<Vertex>,
    /// The numbers of the vertices of each loop, the outer one first.
    pub loops: Vec<Range<usize>>,
    /// The cells between the rungs.
    pub cells: Vec<Cell>,
    /// The rungs, each with its lower end first, in order; none shares an end with another.
    pub rungs: Vec<[usize; 2]>,
}

impl QuadMesh {
    /// Its faces, cell after cell: three or four vertices each.
    pub fn faces(&self) -> impl Iterator<Item = &[usize]> {
        self.cells.iter().flat_map(|cell| cell.faces.iter().map(Vec::as_slice))
    }

    /// The positions of the vertices, mm.
    pub fn positions(&self) -> Vec<Point3> {
        self.vertices.iter().map(|vertex| vertex.position).collect()
    }

    /// How many cells have more than four corners.
    pub fn larger_polygons(&self) -> usize {
        self.cells.iter().filter(|cell| cell.corners.len() > 4).count()
    }

    /// The vertex after vertex `i` on its loop.
    pub fn next(&self, i: usize) -> usize {
        let range = &self.loops[self.vertices[i].of_loop];
        if i + 1 == range.end { range.start } else { i + 1 }
    }

    /// The arc length along the outline from vertex `i` to the next one, mm.
    pub fn gap_mm(&self, outline: &Outline, i: usize) -> f64 {
        self.gap_of_moved_mm(outline, i, |_| 0.0)
    }

    /// The arc length along the outline from vertex `i` to the next one, mm, if each vertex has
    /// moved along it by `moved`, mm.
    fn gap_of_moved_mm(&self, outline: &Outline, i: usize, moved: impl Fn(usize) -> f64) -> f64 {
        let next = self.next(i);
        let round = if next <= i { outline.length(self.vertices[i].of_loop) } else { 0.0 };
        self.vertices[next].along_mm + moved(next) + round - self.vertices[i].along_mm - moved(i)
    }

    /// The planarity error of a face: the distance between its two diagonals, mm; 0 for a triangle.
    /// No corner of a quad lies farther than half of it from the plane between the diagonals.
    pub fn unevenness_mm(&self, face: &[usize]) -> f64 {
        match *face {
            [a, b, c, d] => {
                let at = [a, b, c, d].map(|i| self.vertices[i].position);
                planar::distance_of_diagonals(at).map_or(0.0, |(distance, _)| distance.abs())
            }
            _ => 0.0,
        }
    }

    /// The largest of [`Self::unevenness_mm`] over all faces, mm.
    pub fn unevenness_max_mm(&self) -> f64 {
        self.faces().map(|face| self.unevenness_mm(face)).fold(0.0, f64::max)
    }
}

/// The quads of a surface over the samples of a boundary, by the five steps; larger polygons are
/// split. They are not planar yet, only as near to it as the surface is to developable.
///
/// # Panics
/// Unless surface and outline are of this boundary.
pub fn quads(surface: &Surface, boundary: &Boundary, outline: &Outline) -> QuadMesh {
    assert_eq!(surface.connectivity().samples(), boundary.len(), "a surface of this boundary");
    let merged = merge::merge(surface, &|i| boundary.samples()[i].is_corner());
    let mut mesh = spread::spread(&merged, boundary, outline);
    split::split(&mut mesh);
    mesh
}
