//! How the boundary of a panel was moved, and what the panel was before.

use super::MadePanel;
use crate::check::BoundaryMoved;
use crate::design::VaryGoal;
use crate::fair::{Ended, Shift};
use sheetwright_geometry::math::Point3;

/// How the boundary of a panel was moved, and what it was before.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The panel before.
    pub before: Box<MadePanel>,
    /// How moving ended. Rungs that resist are those of the panels that were moved together.
    pub ended: Ended,
    /// What moving was for.
    pub goal: VaryGoal,
    /// The curves of the panel that moved, by name.
    pub curves: Vec<String>,
    /// Where places of the boundary lay before, one a sample, and where they lie now, mm.
    pub moved: Vec<[Point3; 2]>,
}

impl Change {
    pub(super) fn new(before: MadePanel, shift: &Shift) -> Self {
        Self {
            before: Box::new(before),
            ended: shift.ended.clone(),
            goal: shift.goal,
            curves: shift.curves.clone(),
            moved: shift.moved.clone(),
        }
    }

    /// The largest distance that a sample was moved, mm.
    pub fn moved_max_mm(&self) -> f64 {
        self.moved_mm().fold(0.0, f64::max)
    }

    /// All distances that samples were moved, summed, mm.
    pub fn moved_total_mm(&self) -> f64 {
        self.moved_mm().sum()
    }

    fn moved_mm(&self) -> impl Iterator<Item = f64> {
        self.moved.iter().map(|[from, to]| from.distance(*to))
    }

    /// What is to be said of it, where the panel is this now.
    pub(super) fn said<'a>(&'a self, now: &'a MadePanel) -> BoundaryMoved<'a> {
        BoundaryMoved {
            ended: &self.ended,
            wanted: match self.goal {
                VaryGoal::Warp { largest } => Some(largest),
                VaryGoal::Price => None,
            },
            curves: &self.curves,
            moved_max_mm: self.moved_max_mm(),
            moved_total_mm: self.moved_total_mm(),
            size_mm: now.boundary.size(),
            before: &self.before.measures,
            after: &now.measures,
            checked: &now.checked,
        }
    }
}
