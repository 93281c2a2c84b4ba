//! Findings on the strain that a sheet is predicted to have: the verdict.

use super::{Checked, EASY_SHARE, Finding, FindingKind, Place};
use crate::elastic::{Basis, Elastic, Predicted};
use crate::measure::Measures;

/// The findings on a prediction.
pub(super) fn findings(predicted: &Predicted) -> Vec<Finding> {
    let Predicted { limits, basis, strain, strain_range, .. } = predicted;
    let (limit, sheet) = (limits.strain, limits.sheet.clone());
    let (basis, strain) = (*basis, *strain);
    let worst = || {
        let at = predicted.at_rest.as_ref().map(Elastic::worst_places);
        at.map_or(Place::Whole, |at| Place::Points { at })
    };
    let [least, most] = predicted.usage_range();
    // While the hand drags, the middle of the range decides: a hint in the right colour.
    let is_screen = basis == Basis::Screen;
    let is_beyond = if is_screen { predicted.usage() > 1.0 } else { least > 1.0 };
    let mut found = Vec::new();
    if is_beyond && strain > limit {
        let thickest_mm = predicted.thickest_mm;
        let kind = FindingKind::StrainTooLarge { strain, limit, sheet, thickest_mm, basis };
        found.push(Finding::new(kind, worst()));
    } else if most > 1.0 && !is_screen && !is_beyond {
        let kind = FindingKind::CantTell { strain: *strain_range, limit, sheet, basis };
        found.push(Finding::new(kind, worst()));
    } else if predicted.usage() > EASY_SHARE {
        let outer_fibre = [limits.outer_fibre.map(|_| predicted.outer_fibre()), limits.outer_fibre];
        let moment_n = predicted.hold_moment_n();
        let kind = FindingKind::NeedsForce { strain, limit, outer_fibre, sheet, moment_n, basis };
        found.push(Finding::new(kind, worst()));
    }
    found.extend(roll(predicted));
    found
}

/// The finding that the sheet keeps its bend.
fn roll(predicted: &Predicted) -> Option<Finding> {
    let Predicted { limits, curvature, .. } = predicted;
    let yields = limits.yields.filter(|&yields| predicted.outer_fibre() > yields)?;
    let from_mm = 0.5 * limits.thickness_mm / yields;
    let sheet = limits.sheet.clone().unwrap_or_default();
    Some(Finding::of_whole(FindingKind::Roll { radius_mm: 1.0 / curvature, from_mm, sheet }))
}

/// The findings on folds: those that the sheet needs, and those that it does not.
pub(super) fn not_needed(measures: &Measures) -> Option<Finding> {
    let is_spare = |n: &usize| {
        let rung = &measures.rungs[*n];
        rung.is_fold && !rung.is_scored
    };
    let numbers: Vec<usize> = (0..measures.rungs.len()).filter(is_spare).collect();
    let creases = numbers.iter().map(|&n| measures.rungs[n].crease.abs());
    let sharpest = creases.reduce(f64::max)?;
    let kind = FindingKind::FoldsNotNeeded { count: numbers.len(), sharpest };
    Some(Finding::new(kind, Place::Rungs { numbers }))
}

impl FindingKind {
    /// Whether it follows from a prediction, so that a better one replaces it.
    fn is_predicted(&self) -> bool {
        matches!(
            self,
            Self::StrainTooLarge { .. }
                | Self::NeedsForce { .. }
                | Self::Roll { .. }
                | Self::CantTell { .. }
                | Self::Folds { .. }
                | Self::FoldsNotNeeded { .. }
        )
    }
}

impl Checked {
    /// Replaces the findings that follow from a prediction by these, and the verdict.
    pub(crate) fn predicted_again(&mut self, found: Vec<Finding>) {
        self.findings.retain(|finding| !finding.kind.is_predicted());
        // The worst first, and of those that are as bad, what was predicted.
        let others = std::mem::replace(&mut self.findings, found);
        self.findings.extend(others);
        *self = Self::of(std::mem::take(&mut self.findings));
    }
}
