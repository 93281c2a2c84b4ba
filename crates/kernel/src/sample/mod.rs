//! From the curves of a design to the boundaries of its panels, whose samples have their places on
//! curves.

mod chords;
mod count;
mod curves;
mod error;
mod joined;
mod loops;
mod matched;
mod outline;
mod prepare;
mod run_on;
mod shared_runs;
mod source;
mod steps;

pub use chords::Chords;
pub use count::Counts;
pub use error::{PanelCause, PanelError};
pub use steps::StepSource;

pub(crate) use steps::StepPlace;

pub(crate) use count::counted;
pub(crate) use curves::{built, kind_of_part};
pub(crate) use loops::{LEAST_OF_HOLE, Matched, Sampler};
pub(crate) use matched::matched;
pub(crate) use outline::outline;
pub(crate) use prepare::{Prepared, prepare, sampled};
pub(crate) use source::{OnCurve, Sampled, Sourced};
