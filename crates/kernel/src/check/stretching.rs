//! Findings on a mesh that was laid flat: how much must the sheet stretch?

use super::{
    EASY_SHARE, Finding, FindingKind, MeshOrigin, Place, SeamCause, Subject, overlap, seams, title,
};
use crate::material::stretch_limit;
use crate::measure::Distortion;
use crate::mesh::{Healing, Specks, crease_angles};
use crate::pattern::SCORED_CREASE_DEG;
use sheetwright_geometry::math::to_deg;

/// The border is true up to this share of a length.
const TRUE_BORDER: f64 = 1e-9;
/// Length errors below it, as a share, are rounding and no finding: less than any shop can measure.
const UNSEEN: f64 = 1e-6;

/// A part with its mesh.
pub(super) struct Panel<'a> {
    pub(super) part: &'a Subject<'a>,
    pub(super) origin: MeshOrigin<'a>,
}

/// The findings on it.
pub(super) fn findings(panel: &Panel<'_>) -> Vec<Finding> {
    let checks: [fn(&Panel<'_>) -> Option<Finding>; 9] = [
        stretch,
        border,
        |panel: &Panel<'_>| overlap(panel.part),
        flipped,
        folds,
        |panel: &Panel<'_>| seams(panel.part, why_cut(panel)),
        left_out,
        specks,
        contacts,
    ];
    let healed = panel.origin.healings.iter().map(healing);
    let skins = panel.origin.skins.map(|kind| Finding::of_whole(kind.clone()));
    checks.iter().filter_map(|check| check(panel)).chain(healed).chain(skins).collect()
}

fn stretch(panel: &Panel<'_>) -> Option<Finding> {
    let largest = panel.part.measures.length_error_max;
    let limit = stretch_limit(panel.part.material);
    let sheet = title(panel.part.material);
    // True for NaN, too.
    let kind = if largest.is_nan() || largest > limit {
        FindingKind::StretchTooLarge {
            largest,
            limit,
            sheet,
            cut: panel.origin.suggested_cut,
            has_darts: panel.origin.darts > 0,
            has_creases: sharp_creases(panel).next().is_some(),
        }
    } else if largest > EASY_SHARE * limit {
        FindingKind::StretchHigh { largest, limit, sheet }
    } else if largest > UNSEEN {
        FindingKind::Stretch { largest }
    } else {
        return None;
    };
    let mesh = panel.part.sheet.mesh();
    let worst = panel.part.measures.distortion.as_ref().and_then(Distortion::worst_edge).map(|n| {
        let [a, b] = mesh.edges()[n].ends.map(|v| mesh.position(v));
        Place::at(a.lerp(b, 0.5))
    });
    Some(Finding::new(kind, worst.unwrap_or_default()))
}

fn border(panel: &Panel<'_>) -> Option<Finding> {
    let distortion =
        panel.part.measures.distortion.as_ref().filter(|_| panel.origin.keeps_border)?;
    let largest = distortion.border_error_max;
    (largest > TRUE_BORDER).then(|| Finding::of_whole(FindingKind::BorderNotTrue { largest }))
}

fn flipped(panel: &Panel<'_>) -> Option<Finding> {
    let count = panel.origin.flipped;
    (count > 0).then(|| Finding::of_whole(FindingKind::Flipped { count }))
}

/// The angles of all creases to be scored, radians.
fn sharp_creases(panel: &Panel<'_>) -> impl Iterator<Item = f64> {
    let angles = crease_angles(panel.part.sheet.mesh());
    angles.into_iter().filter(|&angle| to_deg(angle) > SCORED_CREASE_DEG)
}

fn folds(panel: &Panel<'_>) -> Option<Finding> {
    let sharp: Vec<f64> = sharp_creases(panel).collect();
    let sharpest = sharp.iter().copied().reduce(f64::max)?;
    let stiff = title(panel.part.material.filter(|m| !m.folds()));
    Some(Finding::of_whole(FindingKind::Creases { count: sharp.len(), sharpest, stiff }))
}

fn why_cut(panel: &Panel<'_>) -> SeamCause {
    if panel.origin.mesh.loops().is_empty() {
        SeamCause::Closed
    } else if panel.origin.darts > 0 {
        SeamCause::Darts
    } else {
        SeamCause::NotFlat
    }
}

fn left_out(panel: &Panel<'_>) -> Option<Finding> {
    let count = panel.origin.left_out;
    (count > 0).then(|| Finding::of_whole(FindingKind::TrianglesLeftOut { count }))
}

fn specks(panel: &Panel<'_>) -> Option<Finding> {
    let Specks { parts: count, first } = panel.origin.specks?;
    Some(Finding::new(FindingKind::PartsLeftOut { count }, Place::at(first)))
}

fn healing(&Healing { damage, count, first }: &Healing) -> Finding {
    Finding::new(FindingKind::Healed { damage, count }, Place::at(first))
}

fn contacts(panel: &Panel<'_>) -> Option<Finding> {
    let count = panel.origin.contacts;
    (count > 0).then(|| Finding::of_whole(FindingKind::PointContacts { count }))
}
