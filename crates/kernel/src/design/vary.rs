//! Moving curves so that a sheet bends better: goal and limits.

/// The goal of moving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VaryGoal {
    /// The least price that the limit allows.
    Price,
    /// No warp angle above a given one, and of that the smallest displacements.
    Warp {
        /// The angle, radians; positive.
        largest: f64,
    },
    /// No more predicted strain than a share of what the sheet takes, and of that the smallest
    /// displacements that were found.
    Strain {
        /// The share, above 0 and up to 1.
        share: f64,
    },
}

/// Whether points of curves move, or samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MovedBy {
    /// The points that curves are made from, so that curves stay as fair as they are drawn.
    #[default]
    Points,
    /// Each sample, so that curves may become any curves.
    Samples,
}

/// The curves that may move, the limits and the goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// The panels that are to bend better; empty: all that are made. Other panels that share a
    /// curve that moves follow: their prices count, too.
    pub panels: Vec<String>,
    /// The curves that may move; empty: all those of the panels, or those of them that have points
    /// with a distance by which they may move.
    pub curves: Vec<String>,
    /// The goal.
    pub goal: VaryGoal,
    /// The longest way of a sample, mm.
    pub limit_mm: Option<f64>,
    /// The limit on the sum of the ways of all samples, mm.
    pub budget_mm: Option<f64>,
    /// Whether points of curves move, or samples.
    pub by: MovedBy,
    /// Whether panels that are developable already, as far as their samples tell, stay as they are.
    pub leave_developable: bool,
}

impl Default for Vary {
    fn default() -> Self {
        Self {
            panels: Vec::new(),
            curves: Vec::new(),
            goal: VaryGoal::Price,
            limit_mm: None,
            budget_mm: None,
            by: MovedBy::Points,
            leave_developable: true,
        }
    }
}
