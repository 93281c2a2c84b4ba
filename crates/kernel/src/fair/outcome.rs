//! The outcome of a variation, and its errors.

use sheetwright_geometry::boundary::{Boundary, BoundaryError, PlaneError, SupportingPlane};
use sheetwright_geometry::math::{Vec3, to_deg};
use sheetwright_optimum::rung::Rung;
use sheetwright_optimum::triangulate::{TriangulateError, Triangulation};
use std::fmt;

/// How a variation ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    /// No sample moved: the sampling explains every warp angle, or none is above the goal.
    NothingToDo,
    /// No displacement within the limit lowers the price any more by a noticeable share.
    Converged,
    /// The held triangulations would be cheaper, but the true price does not fall.
    NoGain,
    /// All rounds are used.
    Rounds,
    /// The watch stopped it; the result so far is kept.
    Stopped,
    /// No warp angle is above the goal, and the displacements are the smallest found.
    Reached,
    /// Some warp angles stay above the goal.
    Closest {
        /// The goal, radians.
        wanted: f64,
        /// The largest warp angle at the start, radians.
        before: f64,
        /// The largest warp angle that was reached, radians.
        reached: f64,
        /// The rungs above the goal, with the numbers of their panels.
        resisting: Vec<(usize, Rung)>,
    },
}

impl fmt::Display for Ended {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingToDo => write!(f, "nothing needs to move"),
            Self::Converged => write!(f, "no further move within the limits helps"),
            Self::NoGain => write!(f, "no move was found that lowers the price"),
            Self::Rounds => write!(f, "all rounds are used; further rounds may gain more"),
            Self::Stopped => write!(f, "stopped early"),
            Self::Reached => write!(f, "no warp angle is above the goal"),
            Self::Closest { wanted, before, reached, resisting } => {
                let (count, verb) = match resisting.len() {
                    1 => ("1 rung".to_owned(), "stays"),
                    n => (format!("{n} rungs"), "stay"),
                };
                let [wanted, before, reached] = [wanted, before, reached].map(|a| to_deg(*a));
                write!(f, "{count} {verb} above {wanted:.1}°: within the limits, ")?;
                if reached < before {
                    write!(
                        f,
                        "the largest warp angle comes down from {before:.1}° to {reached:.1}°"
                    )
                } else {
                    write!(
                        f,
                        "nothing was found that lowers the largest warp angle of {before:.1}°"
                    )
                }
            }
        }
    }
}

/// A panel after its samples have moved.
#[derive(Clone, Debug, PartialEq)]
pub struct VariedPanel {
    /// The moved boundary; samples that did not move keep their bits.
    pub boundary: Boundary,
    /// Its supporting plane.
    pub plane: Option<SupportingPlane>,
    /// Its triangulation.
    pub triangulation: Triangulation,
    /// The displacement of each sample, mm.
    pub moved_mm: Vec<f64>,
    /// The largest warp angle, radians.
    pub warp_max: f64,
    /// The mean warp angle over the rungs, radians.
    pub warp_mean: f64,
}

/// Panels after their samples have moved, and their prices and warp angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// The panels, in the order in which they were given.
    pub panels: Vec<VariedPanel>,
    /// The displacement of each unknown, mm.
    pub displacements: Vec<Vec3>,
    /// How it ended.
    pub ended: Ended,
    /// The true price Π of all panels at the start and after each accepted step. With
    /// [`VaryGoal::Price`](crate::design::VaryGoal::Price) it only falls.
    pub prices: Vec<f64>,
    /// The total twist W of all panels, likewise; with
    /// [`VaryGoal::Price`](crate::design::VaryGoal::Price) it never rises.
    pub twists: Vec<f64>,
    /// The largest warp angle of all panels at the start, radians.
    pub warp_max_before: f64,
    /// The largest warp angle of all panels, radians.
    pub warp_max: f64,
    /// The largest displacement of a sample, mm.
    pub moved_max_mm: f64,
    /// The sum of the displacements of all samples, mm; those on one spot count once.
    pub moved_total_mm: f64,
}

/// Why panels can't be varied. Panels and unknowns are counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum VaryError {
    /// The number of motions of a panel is not that of its samples.
    Motions {
        /// The panel.
        panel: usize,
    },
    /// A motion follows an unknown that the limit does not have.
    Unknown {
        /// The panel.
        panel: usize,
        /// The sample.
        sample: usize,
    },
    /// A limit that is negative or NaN, a weight that is not positive, or a goal that is no angle.
    Limit,
    /// The printed form of twist is for comparison only and has no slopes.
    PrintedTwist {
        /// The panel.
        panel: usize,
    },
    /// A tangent has no direction.
    Tangent {
        /// The panel.
        panel: usize,
    },
    /// Samples are no boundary.
    Boundary {
        /// The panel.
        panel: usize,
        /// The reason.
        error: BoundaryError,
    },
    /// The plane does not support the boundary.
    Plane {
        /// The panel.
        panel: usize,
        /// The reason.
        error: PlaneError,
    },
    /// There is no triangulation.
    Triangulate {
        /// The panel.
        panel: usize,
        /// The reason.
        error: TriangulateError,
    },
    /// The moved curves make no panels for another reason.
    NoPanels,
    /// The watch stopped it before there was a result to keep.
    Stopped,
}

impl fmt::Display for VaryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |n: &usize| n + 1;
        match self {
            Self::Motions { panel } => {
                write!(f, "panel {} needs one motion a sample", number(panel))
            }
            Self::Unknown { panel, sample } => write!(
                f,
                "sample {} of panel {} follows something that has no limit",
                number(sample),
                number(panel)
            ),
            Self::Limit => write!(f, "a limit is not a length, or the goal not an angle"),
            Self::PrintedTwist { panel } => {
                write!(f, "panel {} is priced by the printed twist, for comparison", number(panel))
            }
            Self::Tangent { panel } => {
                write!(f, "a tangent of panel {} has no direction", number(panel))
            }
            Self::Boundary { panel, error } => write!(f, "panel {}: {error}", number(panel)),
            Self::Plane { panel, error } => write!(f, "panel {}: {error}", number(panel)),
            Self::Triangulate { panel, error } => write!(f, "panel {}: {error}", number(panel)),
            Self::NoPanels => write!(f, "the panels can't be made"),
            Self::Stopped => write!(f, "stopped"),
        }
    }
}

impl std::error::Error for VaryError {}
