//! The verdict on a part whose surface was found: a formula has screened it at once, since while a
//! hand drags there is no time for more; here an elastic sheet is computed.

use super::Judging;
use super::part::{Origin, Part};
use crate::check::check_strain;
use crate::elastic::{Basis, Edges, Predicted, predict};
use crate::material::Material;
use crate::pattern::{PatternOptions, piece, seam_marks};
use sheetwright_geometry::watch::Watch;

/// Judges a part by an elastic sheet in place of the formula: its verdict, its findings, and which
/// folds its pattern has scored. Returns whether it was stopped.
pub(super) fn judge(part: &mut Part, material: Option<&Material>, watch: &mut dyn Watch) -> bool {
    let Some(screened) = &part.predicted else { return false };
    let edges = edges_of(part);
    let Part { sheet, flat, measures, .. } = &*part;
    let Some(predicted) = predict(sheet, flat, &edges, measures, screened, watch) else {
        return true;
    };
    let is_new = part.measures.score(&predicted.scored);
    check_strain(&mut part.checked, &predicted, &part.measures, material);
    part.predicted = Some(predicted);
    if is_new {
        let marks = seam_marks(&part.sheet);
        let Part { name, sheet, flat, edges, measures, bends, .. } = part;
        let options = PatternOptions { bends: *bends, ..PatternOptions::default() };
        part.piece = piece(name, sheet, flat, edges, measures, &marks, &options);
    }
    false
}

/// What holds the edges of a part: where they slide, nothing holds straight ends between rails.
fn edges_of(part: &Part) -> Edges {
    match &part.origin {
        Origin::Found(found) if found.slides => Edges::sliding(&part.sheet, &found.ends),
        _ => Edges::default(),
    }
}

/// Whether a part that a formula has screened wants an elastic sheet: always, or where its limit
/// lies within what the strain may be by the formula.
pub(super) fn is_to_judge(part: &Part, judging: Judging) -> bool {
    let is_near = || {
        part.predicted.as_ref().is_some_and(|predicted| {
            let [least, most] = predicted.strain_range;
            (least..=most).contains(&predicted.limits.strain)
        })
    };
    match judging {
        Judging::Quick => false,
        Judging::Auto => is_screened(part) && is_near(),
        Judging::Exact => is_screened(part),
    }
}

/// Whether a part has a prediction that a better one may replace.
pub(super) fn is_screened(part: &Part) -> bool {
    let is_screen = |predicted: &Predicted| predicted.basis == Basis::Screen;
    matches!(part.origin, Origin::Found(_)) && part.predicted.as_ref().is_some_and(is_screen)
}
