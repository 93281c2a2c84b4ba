//! Why curves can't be moved so that panels bend better, in words.

use crate::design::Failure;
use crate::fair::VaryError;
use crate::sample::{PanelCause, PanelError};
use std::fmt;

/// Why curves of a design can't be moved: the panel or curve, and what is wrong.
pub type FairError = Failure<FairCause>;

/// What prevents moving curves.
#[derive(Clone, Debug, PartialEq)]
pub enum FairCause {
    /// A panel that can't be sampled or triangulated.
    Panel(PanelCause),
    /// Curves that should move can't.
    Vary(VaryCause),
}

impl From<PanelCause> for FairCause {
    fn from(cause: PanelCause) -> Self {
        Self::Panel(cause)
    }
}

impl From<VaryCause> for FairCause {
    fn from(cause: VaryCause) -> Self {
        Self::Vary(cause)
    }
}

impl From<PanelError> for FairError {
    fn from(error: PanelError) -> Self {
        error.caused(FairCause::Panel)
    }
}

/// Why curves can't be moved so that panels bend better.
#[derive(Clone, Debug, PartialEq)]
pub enum VaryCause {
    /// A panel is joined from others, and its boundary is not that of the curves alone.
    Joined,
    /// The rails of a panel run on, so its ends do not follow the curves alone.
    RunsOn,
    /// A panel that the design does not have, or does not make.
    UnknownPanel {
        /// Its name.
        name: String,
    },
    /// None of the panels that are to bend better has curves: they are meshes.
    NoCurves,
    /// A curve that bounds none of the panels that are to bend better.
    BoundsNothing,
    /// A curve that two independent `vary` would move.
    MovedTwice,
    /// More points than can be moved together.
    TooManyPoints {
        /// How many there are.
        found: usize,
        /// The limit.
        most: usize,
    },
    /// Another failure of the variation.
    Failed(VaryError),
}

impl fmt::Display for VaryCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Joined => write!(f, "a panel that joins others can't be varied"),
            Self::RunsOn => write!(f, "a panel whose rails run on can't be varied"),
            Self::UnknownPanel { name } => write!(f, "there is no panel '{name}' to vary"),
            Self::NoCurves => write!(f, "a mesh has no curves that could move"),
            Self::BoundsNothing => {
                write!(f, "the curve may move, but bounds none of the panels to vary")
            }
            Self::MovedTwice => write!(f, "two panels would move the curve, each in its own way"),
            Self::TooManyPoints { found, most } => {
                write!(f, "{found} points may move; the limit is {most}")
            }
            Self::Failed(error) => write!(f, "{error}"),
        }
    }
}
