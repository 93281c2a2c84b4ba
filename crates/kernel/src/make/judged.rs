//! The verdict on a part whose surface was found: a formula screens it at once, since while a hand
//! drags there is no time for more; then an elastic sheet is computed.

use super::part::{Origin, Part};
use crate::check::check_strain;
use crate::elastic::{Basis, Predicted, estimate, predict};
use crate::material::{Limits, Material};
use crate::measure::Measures;
use crate::pattern::{PatternOptions, piece, seam_marks};
use crate::sheet::Sheet;
use sheetwright_geometry::watch::Watch;

/// What a formula predicts of a part with this sheet.
pub(super) fn screen(sheet: &Sheet, measures: &Measures, material: Option<&Material>) -> Predicted {
    let limits = Limits::of(material, measures.area_flat_mm2);
    let estimate = estimate(sheet, measures, limits.thickness_mm);
    Predicted::estimated(limits, Basis::Screen, estimate)
}

/// Judges a part by an elastic sheet in place of the formula: its verdict, its findings, and which
/// folds its pattern has scored. Returns whether it was stopped.
pub(super) fn judge(part: &mut Part, material: Option<&Material>, watch: &mut dyn Watch) -> bool {
    let Some(screened) = &part.predicted else { return false };
    let limits = &screened.limits;
    let Some(predicted) = predict(&part.sheet, &part.flat, &part.measures, limits, watch) else {
        return true;
    };
    for (n, rung) in part.measures.rungs.iter_mut().enumerate() {
        rung.is_scored = rung.is_fold && predicted.scored.contains(&n);
    }
    check_strain(&mut part.checked, &predicted, &part.measures, material);
    part.predicted = Some(predicted);
    if part.measures.rungs.iter().any(|rung| rung.is_fold && !rung.is_scored) {
        let marks = seam_marks(&part.sheet);
        let Part { name, sheet, flat, edges, measures, .. } = part;
        let options = PatternOptions::default();
        part.piece = piece(name, sheet, flat, edges, measures, &marks, &options);
    }
    false
}

/// Whether a part has a prediction that a better one may replace.
pub(super) fn is_screened(part: &Part) -> bool {
    let is_screen = |predicted: &Predicted| predicted.basis == Basis::Screen;
    matches!(part.origin, Origin::Found(_)) && part.predicted.as_ref().is_some_and(is_screen)
}
