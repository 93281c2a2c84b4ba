//! Findings on how far a sheet stretches and bends in its shape: the verdict.

use super::{Checked, CutWay, Finding, FindingKind, LinePlace, Place, Verdict, title};
use crate::elastic::{Basis, Elastic, Predicted};
use crate::material::{EASY_SHARE, Material};
use crate::measure::{Measures, RungMeasures};
use sheetwright_geometry::math::from_deg;

/// With so many rungs or more, a computed sheet shows the tight ends of a surface itself.
const FINE: usize = 200;

/// The findings that follow from a prediction and from the measures of a surface that was found.
pub(super) fn findings(
    predicted: Option<&Predicted>,
    measures: &Measures,
    material: Option<&Material>,
) -> Vec<Finding> {
    let radius = material.and_then(|material| radius(predicted, measures, material));
    let is_beyond = |finding: &Finding| matches!(finding.kind, FindingKind::RadiusTooSmall { .. });
    let is_refused = radius.as_ref().is_some_and(is_beyond);
    // What is bent more tightly than it takes is not held by any force.
    let is_idle = |f: &Finding| is_refused && matches!(f.kind, FindingKind::NeedsForce { .. });
    let found = [
        predicted.and_then(roll),
        predicted.and_then(stretch).filter(|finding| !is_idle(finding)),
        radius,
        folds(measures, material),
        folds_not_needed(measures),
    ];
    found.into_iter().flatten().collect()
}

/// The finding on how much of what it takes the sheet uses.
fn stretch(predicted: &Predicted) -> Option<Finding> {
    let Predicted { limits, basis, strain, strain_range, .. } = predicted;
    let (limit, sheet) = (limits.strain, limits.sheet.clone());
    let (basis, strain) = (*basis, *strain);
    let [least, most] = strain_range.map(|strain| strain / limit);
    // While the hand drags, the middle of the range decides: a hint in the right colour.
    let is_screen = basis == Basis::Screen;
    let is_beyond = if is_screen { strain > limit } else { least > 1.0 };
    let kind = if is_beyond {
        let thickest_mm = predicted.thickest_mm;
        FindingKind::StrainTooLarge { strain, limit, sheet, thickest_mm, basis }
    } else if most > 1.0 && !is_screen {
        FindingKind::CantTell { strain: *strain_range, limit, sheet, basis }
    } else if predicted.usage() > EASY_SHARE {
        let outer_fibre = limits.outer_fibre.map(|limit| [predicted.outer_fibre(), limit]);
        let moment_n = predicted.hold_moment_n();
        let is_formed = limits.yields_at(predicted.curvature);
        FindingKind::NeedsForce { strain, limit, outer_fibre, sheet, moment_n, is_formed, basis }
    } else {
        return None;
    };
    let at = predicted.at_rest.as_ref().map(Elastic::most_strained);
    Some(Finding::new(kind, at.map_or(Place::Whole, |at| Place::Points { at })))
}

/// The finding that the sheet keeps its bend.
fn roll(predicted: &Predicted) -> Option<Finding> {
    let Predicted { limits, curvature, .. } = predicted;
    let yields = limits.yields.filter(|_| limits.yields_at(*curvature))?;
    let from_mm = 0.5 * limits.thickness_mm / yields;
    let sheet = limits.sheet.clone().unwrap_or_default();
    Some(Finding::of_whole(FindingKind::Roll { radius_mm: 1.0 / curvature, from_mm, sheet }))
}

/// The finding that the sheet is bent more tightly than it takes, or that its radius is too near to
/// the limit to tell. The radius is that of the computed sheet at rest, or of the formula. Samples
/// may be too coarse to tell, of a sheet that does not fold, where the formula decides or rungs are
/// few: rulings turn so much from one to the next that a tight end may lie between two.
fn radius(
    predicted: Option<&Predicted>,
    measures: &Measures,
    material: &Material,
) -> Option<Finding> {
    let predicted = predicted?;
    let (limit_mm, sheet) = (material.bend_radius_mm.value, material.title.clone());
    let ([least_mm, most_mm], thickest_mm) = (predicted.radius_range_mm(), predicted.thickest_mm);
    let is_mesh = measures.distortion.is_some();
    let is_tight = |r: &RungMeasures| !r.is_fold && r.bend_radius_mm < limit_mm;
    let is_told = measures.rungs.iter().any(is_tight);
    let is_sure = most_mm < limit_mm;
    if is_sure || is_told && least_mm < limit_mm {
        let kind = if is_sure {
            FindingKind::RadiusTooSmall { least_mm, limit_mm, sheet, thickest_mm }
        } else {
            FindingKind::RadiusUnsure { least_mm, limit_mm, is_coarse: false, sheet }
        };
        let place = if is_told { Place::rungs(&measures.rungs, is_tight) } else { Place::Whole };
        return Some(Finding::new(kind, place));
    }
    let is_fine = predicted.basis == Basis::Computed && measures.rungs.len() >= FINE;
    if is_mesh || is_fine {
        return None;
    }
    let limit = from_deg(material.warp_limit_deg.value);
    let is_coarse = |r: &RungMeasures| r.warp > limit && r.warp_beyond_sampling() == 0.0;
    let is_unsure = !material.folds() && measures.rungs.iter().any(is_coarse);
    let least_mm = measures.bend_radius_min_mm;
    let kind = FindingKind::RadiusUnsure { least_mm, limit_mm, is_coarse: true, sheet };
    is_unsure.then(|| Finding::new(kind, Place::rungs(&measures.rungs, is_coarse)))
}

/// The finding on the folds that the sheet needs.
fn folds(measures: &Measures, material: Option<&Material>) -> Option<Finding> {
    let scored = measures.rungs.iter().filter(|r| r.is_scored);
    let sharpest = scored.clone().map(|r| r.crease.abs()).reduce(f64::max)?;
    let stiff = title(material.filter(|m| !m.folds()));
    let kind = FindingKind::Folds { count: scored.count(), sharpest, stiff };
    Some(Finding::new(kind, Place::rungs(&measures.rungs, |r| r.is_scored)))
}

/// The finding on the folds that it does not need.
fn folds_not_needed(measures: &Measures) -> Option<Finding> {
    let is_spare = |r: &RungMeasures| r.is_fold && !r.is_scored;
    let spare = measures.rungs.iter().filter(|r| is_spare(r));
    let sharpest = spare.clone().map(|r| r.crease.abs()).reduce(f64::max)?;
    let kind = FindingKind::FoldsNotNeeded { count: spare.count(), sharpest };
    Some(Finding::new(kind, Place::rungs(&measures.rungs, is_spare)))
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
                | Self::RadiusTooSmall { .. }
                | Self::RadiusUnsure { .. }
                | Self::Folds { .. }
                | Self::FoldsNotNeeded { .. }
        )
    }
}

impl Checked {
    /// Replaces the findings that follow from a prediction by these, and the verdict.
    pub(super) fn predicted_again(&mut self, found: Vec<Finding>) {
        let others = std::mem::take(&mut self.findings);
        let kept = others.into_iter().filter(|finding| !finding.kind.is_predicted());
        *self = Self::of(found.into_iter().chain(kept).collect());
    }
}

/// The finding that moving the boundary leaves more strain than wanted, both as shares of what the
/// sheet takes.
pub(crate) fn strain_not_reached(wanted: f64, reached: f64) -> Finding {
    Finding::of_whole(FindingKind::StrainNotReached { wanted, reached })
}

/// The finding that a panel would bend as several parts, with the lines between them.
pub(crate) fn bends_divided(
    way: CutWay,
    parts: usize,
    strain: f64,
    verdict: Verdict,
    lines: Vec<LinePlace>,
) -> Finding {
    let kind = FindingKind::BendsDivided { parts, way, strain, verdict };
    Finding::new(kind, Place::Lines { lines })
}

/// The finding that a panel would not bend as so many parts or fewer either.
pub(crate) fn divided_in_vain(most: usize) -> Finding {
    Finding::of_whole(FindingKind::DividedInVain { most })
}
