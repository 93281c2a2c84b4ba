//! Why triangles are no mesh, in words.

use super::MAX_TRIANGLES;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use std::fmt;

/// Why triangles are no mesh. Vertices and triangles are numbered from 0, as they were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshError {
    /// There is no triangle.
    Empty,
    /// More than [`MAX_TRIANGLES`] triangles or vertices.
    TooMany {
        /// How many there are.
        found: usize,
    },
    /// A corner that is no vertex.
    BadCorner {
        /// The triangle.
        triangle: TriangleIndex,
    },
    /// A coordinate that is no finite number.
    NotFinite {
        /// The vertex.
        vertex: VertexIndex,
    },
    /// All vertices within [`sheetwright_geometry::tolerance::MIN_SIZE_MM`].
    TooSmall,
    /// A triangle without area: two corners in one place, or three on one line.
    Degenerate {
        /// The triangle.
        triangle: TriangleIndex,
    },
    /// A vertex that no triangle uses.
    Unused {
        /// The vertex.
        vertex: VertexIndex,
    },
    /// A side of more than two triangles.
    NotManifold {
        /// One end of the side.
        from: VertexIndex,
        /// The other end.
        to: VertexIndex,
    },
    /// A vertex in which parts of the mesh meet that have no side in common there.
    PinchedVertex {
        /// The vertex.
        vertex: VertexIndex,
    },
    /// A surface with one side only, as a Möbius strip or a Klein bottle: no choice of a front
    /// makes neighbours agree.
    NotOrientable {
        /// One end of a side whose triangles disagree.
        from: VertexIndex,
        /// The other end.
        to: VertexIndex,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "the mesh has no triangle"),
            Self::TooMany { found } => {
                write!(
                    f,
                    "the mesh has {found} triangles or vertices; the limit is {MAX_TRIANGLES}"
                )
            }
            Self::BadCorner { triangle } => {
                write!(f, "triangle {triangle} has a corner that is no vertex")
            }
            Self::NotFinite { vertex } => {
                write!(f, "vertex {vertex} has a coordinate that is no finite number")
            }
            Self::TooSmall => {
                write!(f, "the whole mesh is smaller than a millionth of a millimetre")
            }
            Self::Degenerate { triangle } => write!(f, "triangle {triangle} has no area"),
            Self::Unused { vertex } => write!(f, "vertex {vertex} belongs to no triangle"),
            Self::NotManifold { from, to } => {
                write!(f, "the side {from}–{to} belongs to more than two triangles")
            }
            Self::PinchedVertex { vertex } => {
                write!(f, "parts of the mesh meet only in vertex {vertex}")
            }
            Self::NotOrientable { from, to } => write!(
                f,
                "the mesh has one side only, as a Möbius strip: round it, the two triangles at \
                 {from}–{to} disagree about which side is the front"
            ),
        }
    }
}

impl std::error::Error for MeshError {}
