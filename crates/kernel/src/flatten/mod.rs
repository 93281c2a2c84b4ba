//! Laying a surface flat.

mod beside;
mod choose;
mod close;
mod face;
mod lay;
mod motion;
mod opened;
mod pose;
mod refold;
mod relax;
mod unfold;
mod unroll;

pub use lay::lay_flat;
pub use refold::{RefoldError, refold};
pub use relax::{Aim, Ended, RelaxError, RelaxOptions, Relaxed, relax, relax_lengths};

pub(crate) use beside::{Beside, shares};
pub(crate) use face::{LaidFace, laid_face};
pub(crate) use motion::Motion;
pub(crate) use pose::{convex_hull, fits_in, fits_in_with, is_no_larger, long_side, posed};
pub(crate) use relax::{conformal_scales, laid_at, triangle_stretches};
pub use unfold::unfold;
pub use unroll::unroll;

use sheetwright_geometry::math::Point2;
use std::fmt;

/// A surface laid flat.
#[derive(Clone, Debug, PartialEq)]
pub struct Flattened {
    /// Where the vertices of the sheet lie in the plane, mm, seen from the side that the surface
    /// faces. The pattern lies in the rectangle of least area around it, its longer side along x,
    /// with its lower left corner at the origin.
    pub points: Vec<Point2>,
    /// Two steps of the border between which the pattern overlaps itself, by the vertices that they
    /// begin at: they cross in the plane, or lie where it is covered twice without a crossing. It
    /// can't be cut from one sheet then. Exact. Without one, no two triangles overlap.
    pub overlap: Option<(usize, usize)>,
}

/// Why a surface cannot be laid flat exactly.
#[derive(Clone, Debug, PartialEq)]
pub enum FlattenError {
    /// Its triangles hang together in a cycle, as round a hole that was not cut open, so laying one
    /// beside the other need not close.
    Cycle,
    /// It falls apart into pieces.
    Pieces,
    /// Three lengths that make no triangle.
    NoTriangle {
        /// The triangle.
        triangle: sheetwright_geometry::index::TriangleIndex,
    },
    /// The watcher asked to stop.
    Stopped,
}

impl fmt::Display for FlattenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cycle => write!(f, "the triangles of the surface form a cycle that no cut opens"),
            Self::Pieces => write!(f, "the surface has separate pieces"),
            Self::NoTriangle { triangle } => {
                write!(f, "the lengths of triangle {triangle} make no triangle")
            }
            Self::Stopped => write!(f, "stopped"),
        }
    }
}

impl std::error::Error for FlattenError {}
