//! Why a design can't be made, in words.

use crate::design::Failure;
use crate::fair::{FairCause, FairError, VaryCause};
use crate::flatten::FlattenError;
use crate::sample::{PanelCause, PanelError};
use crate::surface::ConnectivityError;
use sheetwright_optimum::triangulate::TriangulateError;
use std::fmt;

/// Why a design can't be made: the panel or curve, and what is wrong.
pub type MakeError = Failure<MakeCause>;

/// What is wrong with a design, a panel or a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum MakeCause {
    /// A design without panels.
    NoPanels,
    /// A panel that can't be sampled or triangulated.
    Panel(PanelCause),
    /// Triangles that are no surface.
    Surface(ConnectivityError),
    /// No flat pattern.
    Flatten(FlattenError),
    /// Curves that can't be moved.
    Vary(VaryCause),
}

impl From<PanelCause> for MakeCause {
    fn from(cause: PanelCause) -> Self {
        Self::Panel(cause)
    }
}

impl From<TriangulateError> for MakeCause {
    fn from(error: TriangulateError) -> Self {
        Self::Panel(PanelCause::Triangulate(error))
    }
}

impl From<PanelError> for MakeError {
    fn from(error: PanelError) -> Self {
        error.caused(MakeCause::Panel)
    }
}

impl From<FairError> for MakeError {
    fn from(error: FairError) -> Self {
        error.caused(|cause| match cause {
            FairCause::Panel(cause) => MakeCause::Panel(cause),
            FairCause::Vary(cause) => MakeCause::Vary(cause),
        })
    }
}

impl fmt::Display for MakeCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPanels => write!(f, "the design has no panels"),
            Self::Panel(cause) => write!(f, "{cause}"),
            Self::Surface(error) => write!(f, "{error}"),
            Self::Flatten(error) => write!(f, "{error}"),
            Self::Vary(cause) => write!(f, "{cause}"),
        }
    }
}
