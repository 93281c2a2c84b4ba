//! Why a panel of a design has no boundary that can be triangulated, in words.

use crate::design::Failure;
use sheetwright_geometry::boundary::{BoundaryError, JoinCause, PlaneError};
use sheetwright_geometry::curve::{CurveError, SampleError};
use sheetwright_optimum::triangulate::TriangulateError;
use std::fmt;

/// Why a panel can't be sampled and triangulated: the panel or its curve, and the cause.
pub type PanelError = Failure<PanelCause>;

/// The cause why a panel can't be sampled and triangulated.
#[derive(Clone, Debug, PartialEq)]
pub enum PanelCause {
    /// A curve that the design does not have.
    UnknownCurve,
    /// Points that make no curve.
    Curve(CurveError),
    /// A closed curve as a rail or as one part of several of a loop.
    ClosedCurve,
    /// A loop of one open curve, or of curves whose ends do not meet.
    NotChained {
        /// The curve that should begin where this one ends.
        next: String,
        /// How far apart they are, mm.
        gap_mm: f64,
    },
    /// Both rails are the same curve.
    SameRails,
    /// The method `rails` for a panel without rails.
    NoRails,
    /// Rails that run on, for a panel without rails or one that is joined to others.
    RunOn,
    /// A join of a panel that the design does not have.
    UnknownPanel {
        /// Its name.
        name: String,
    },
    /// A join of a panel that is a join itself.
    JoinOfJoins {
        /// Its name.
        name: String,
    },
    /// A mesh where curves are needed, as in a join.
    NoCurves {
        /// Its name.
        name: String,
    },
    /// Panels that can't be joined.
    Join {
        /// The panel at fault, if it is one.
        part: Option<String>,
        /// The cause.
        cause: JoinCause,
    },
    /// Too few samples.
    Sampling(SampleError),
    /// Samples that are no boundary.
    Boundary(BoundaryError),
    /// A plane that supports nothing.
    Plane(PlaneError),
    /// No triangulation.
    Triangulate(TriangulateError),
}

impl fmt::Display for PanelCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownCurve => write!(f, "there is no such curve"),
            Self::Curve(error) => write!(f, "the curve {error}"),
            Self::ClosedCurve => write!(f, "the curve is closed where an open one is needed"),
            Self::NotChained { next, gap_mm } => {
                write!(f, "the curve ends {gap_mm:.6} mm away from where '{next}' begins")
            }
            Self::SameRails => write!(f, "both rails are the same curve"),
            Self::NoRails => write!(f, "the method 'rails' needs a panel with rails"),
            Self::RunOn => {
                write!(f, "only a panel with rails of its own, joined to no other, can run on")
            }
            Self::UnknownPanel { name } => write!(f, "there is no panel '{name}' to join"),
            Self::NoCurves { name } => {
                write!(f, "panel '{name}' is a mesh, which has no curves to join")
            }
            Self::JoinOfJoins { name } => write!(f, "the panel '{name}' is a join itself"),
            Self::Join { part: Some(part), cause } => write!(f, "joining '{part}': {cause}"),
            Self::Join { part: None, cause } => write!(f, "{cause}"),
            Self::Sampling(error) => write!(f, "{error}"),
            Self::Boundary(error) => write!(f, "{error}"),
            Self::Plane(error) => write!(f, "{error}"),
            Self::Triangulate(error) => write!(f, "{error}"),
        }
    }
}
