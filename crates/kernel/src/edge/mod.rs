//! The edges of parts: named runs of the border of a sheet, each with its source and its mates, the
//! edges that it is joined to.
//!
//! An edge ends where the border passes from one curve to another, to the straight end of a strip
//! or to a side of a cut. Edges that lie on one stretch of a curve are *mates*, also across parts
//! and of one part with itself (a tube along its seam); so are edges on two curves that lie on one
//! another, both sides of a cut, also of one that divides a part, and the edges along which two
//! parts of meshes meet. Letters, lengths and marks of joints read this list.

mod border;
mod mates;
mod of_boundary;
mod of_mesh;
mod of_piece;
mod shared;
mod twins;

pub(crate) use border::runs;
pub(crate) use mates::join_mates;
pub(crate) use of_boundary::edges_of_boundary;
pub(crate) use of_mesh::{MeshBorder, edges_of_meshes};
pub(crate) use of_piece::{PieceStep, edges_of_piece};
#[cfg(test)]
pub(crate) use shared::shared;
pub(crate) use shared::{Shared, lengths};

use sheetwright_geometry::math::{Point2, Point3};

/// The source of an edge: the curve, end or cut that it lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EdgeSource {
    /// A curve, by its number in the design.
    Curve(usize),
    /// The end of a strip that joins the beginnings of its rails.
    Start,
    /// The end of a strip that joins the ends of its rails.
    End,
    /// A side of a cut: the first or the second of the cut of this number.
    Cut {
        /// The number of the cut in its part, from 0.
        number: usize,
        /// Whether it is the second side.
        second: bool,
    },
    /// A side of a cut that divides a part that is too large: the first or the second of the cut
    /// of this number.
    Division {
        /// The number of the cut in the part before it was divided, from 0.
        number: usize,
        /// Whether it is the second side, which is of another piece.
        second: bool,
    },
    /// Where a part of a mesh meets another.
    Part {
        /// The number of the other part in the design.
        with: usize,
    },
    /// Where nothing meets a mesh, or a strap.
    Border,
}

/// An edge, by its part and its number there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgePlace {
    /// The number of the part in the design.
    pub part: usize,
    /// The number of the edge in it.
    pub edge: usize,
}

/// An edge of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// Its name, as in `PANEL/EDGE`; no two of a part share one.
    pub name: String,
    /// Its source.
    pub source: EdgeSource,
    /// The vertices of the sheet along it, by their numbers, the sheet to the left; of an edge that
    /// is a whole loop, the first stands at the end once more.
    pub run: Vec<usize>,
    /// How long it is in space, mm.
    pub length_space_mm: f64,
    /// How long it is on the pattern, mm.
    pub length_flat_mm: f64,
    /// The edges that it is joined to, in order; none of a free edge.
    pub mates: Vec<EdgePlace>,
    /// The stretches that it shares with each of those, by lengths in space.
    pub(crate) common: Vec<Vec<Shared>>,
    /// How long it and each of those is on the pattern along what both share, mm.
    pub shared_mm: Vec<[f64; 2]>,
    /// The largest difference between its length on the pattern and that of a mate, along what both
    /// share, mm; `None` of a free edge.
    pub difference_mm: Option<f64>,
}

impl Edge {
    /// An edge along these vertices, without mates.
    pub(crate) fn new(
        name: String,
        source: EdgeSource,
        run: Vec<usize>,
        space: &[Point3],
        flat: &[Point2],
    ) -> Self {
        let steps = || run.windows(2);
        let length_space_mm = steps().map(|s| space[s[0]].distance(space[s[1]])).sum();
        let length_flat_mm = steps().map(|s| flat[s[0]].distance(flat[s[1]])).sum();
        Self {
            name,
            source,
            run,
            length_space_mm,
            length_flat_mm,
            mates: Vec::new(),
            common: Vec::new(),
            shared_mm: Vec::new(),
            difference_mm: None,
        }
    }

    /// Whether it is a whole loop.
    pub fn is_loop(&self) -> bool {
        self.run.first() == self.run.last()
    }
}

/// The edges of a part and the places of its vertices, for finding mates.
#[derive(Debug)]
pub(crate) struct PartEdges<'a> {
    /// Its edges.
    pub(crate) edges: &'a mut Vec<Edge>,
    /// Where the vertices of its sheet were drawn in space, mm.
    pub(crate) space: &'a [Point3],
    /// Where they lie on the pattern, mm.
    pub(crate) flat: &'a [Point2],
}
