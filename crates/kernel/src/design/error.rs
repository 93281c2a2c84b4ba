//! Why a design can't be made, in words.

use crate::boundary::{BoundaryError, JoinCause, PlaneError};
use crate::curve::{CurveError, SampleError};
use crate::flatten::FlattenError;
use crate::surface::ConnectivityError;
use crate::triangulate::TriangulateError;
use crate::vary::VaryError;
use std::fmt;

/// Why a design can't be made.
#[derive(Clone, Debug, PartialEq)]
pub struct MakeError {
    /// The panel; empty where it is a curve or the design as a whole.
    pub panel: String,
    /// The curve, if it is one.
    pub curve: Option<String>,
    /// What is wrong.
    pub cause: MakeCause,
}

/// What is wrong with a panel or a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum MakeCause {
    /// A design without panels.
    NoPanels,
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
    /// A rails method for a panel without rails.
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
    /// Panels that can't be joined.
    Join {
        /// The one that is not like the others, where it is one.
        part: Option<String>,
        /// What is wrong.
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
    /// Triangles that are no surface.
    Surface(ConnectivityError),
    /// No flat pattern.
    Flatten(FlattenError),
    /// Curves that can't be moved.
    Vary(VaryCause),
}

/// Why curves can't be moved so that panels bend better.
#[derive(Clone, Debug, PartialEq)]
pub enum VaryCause {
    /// A panel is joined from others, and its boundary is not that of the curves alone.
    Joined,
    /// The rails of a panel run on, and its ends follow them in their own way.
    RunsOn,
    /// A panel that the design does not have, or does not make.
    UnknownPanel {
        /// Its name.
        name: String,
    },
    /// A curve that bounds none of the panels that are to bend better.
    BoundsNothing,
    /// A curve that would be moved for two reasons that know nothing of one another.
    MovedTwice,
    /// More points than can be moved together.
    TooManyPoints {
        /// How many there are.
        found: usize,
        /// How many are taken.
        most: usize,
    },
    /// Whatever else is in the way.
    Failed(VaryError),
}

impl fmt::Display for VaryCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Joined => write!(f, "a panel that joins others can't be varied"),
            Self::RunsOn => write!(f, "a panel whose rails run on can't be varied"),
            Self::UnknownPanel { name } => write!(f, "there is no panel '{name}' to vary"),
            Self::BoundsNothing => {
                write!(f, "the curve may move, and bounds none of the panels to vary")
            }
            Self::MovedTwice => write!(f, "two panels would move the curve, each in its own way"),
            Self::TooManyPoints { found, most } => {
                write!(f, "{found} points may move, and {most} are the most")
            }
            Self::Failed(error) => write!(f, "{error}"),
        }
    }
}

impl fmt::Display for MakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.panel[..], &self.curve) {
            ("", None) => {}
            ("", Some(curve)) => write!(f, "curve '{curve}': ")?,
            (panel, None) => write!(f, "panel '{panel}': ")?,
            (panel, Some(curve)) => write!(f, "panel '{panel}', curve '{curve}': ")?,
        }
        write!(f, "{}", self.cause)
    }
}

impl std::error::Error for MakeError {}

impl fmt::Display for MakeCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPanels => write!(f, "the design has no panels"),
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
            Self::JoinOfJoins { name } => write!(f, "the panel '{name}' is a join itself"),
            Self::Join { part: Some(part), cause } => write!(f, "joining '{part}': {cause}"),
            Self::Join { part: None, cause } => write!(f, "{cause}"),
            Self::Sampling(error) => write!(f, "{error}"),
            Self::Boundary(error) => write!(f, "{error}"),
            Self::Plane(error) => write!(f, "{error}"),
            Self::Triangulate(error) => write!(f, "{error}"),
            Self::Surface(error) => write!(f, "{error}"),
            Self::Flatten(error) => write!(f, "{error}"),
            Self::Vary(cause) => write!(f, "{cause}"),
        }
    }
}
