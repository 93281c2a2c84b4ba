//! Findings on a mesh that was laid flat: how much must the sheet stretch, and where would a cut
//! help?

use super::{FacetsMeant, Finding, FindingKind, MeshOrigin, Place, SeamCause, Subject};
use super::{overlap, seams, strain, title};
use crate::bend::fold_counts;
use crate::measure::Distortion;
use crate::mesh::{Healing, Specks, scored_creases};

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
    let checks: [fn(&Panel<'_>) -> Option<Finding>; 11] = [
        divide,
        stretch,
        border,
        |panel: &Panel<'_>| overlap(panel.part),
        flipped,
        |panel: &Panel<'_>| {
            if panel.origin.net.is_some() { net_folds(panel) } else { folds(panel) }
        },
        facets_meant,
        |panel: &Panel<'_>| seams(panel.part, panel.origin.cut_for),
        left_out,
        specks,
        contacts,
    ];
    let Subject { predicted, measures, material, .. } = *panel.part;
    let is_net = panel.origin.net.is_some();
    let strained =
        if is_net { Vec::new() } else { strain::findings(predicted, measures, material) };
    let healed = panel.origin.healings.iter().map(healing);
    let skins = panel.origin.skins.map(|kind| Finding::of_whole(kind.clone()));
    let checked = checks.iter().filter_map(|check| check(panel));
    strained.into_iter().chain(checked).chain(healed).chain(skins).collect()
}

/// The finding on how far the lengths of the pattern are from those in space.
fn stretch(panel: &Panel<'_>) -> Option<Finding> {
    let distortion = panel.part.measures.distortion.as_ref()?;
    let [stretch, shrink] = distortion.to_shape();
    // True for NaN, too.
    let is_unseen = stretch <= UNSEEN && shrink <= UNSEEN;
    let kind = FindingKind::Stretch { stretch, shrink };
    (!is_unseen).then(|| Finding::new(kind, worst(panel)))
}

/// Where its lengths differ most from those in space.
fn worst(panel: &Panel<'_>) -> Place {
    let mesh = panel.part.sheet.mesh();
    let worst = panel.part.measures.distortion.as_ref().and_then(Distortion::worst_edge);
    worst.map_or(Place::Whole, |n| {
        let [a, b] = mesh.edges()[n].ends.map(|v| mesh.position(v));
        Place::at(a.lerp(b, 0.5))
    })
}

/// The finding on what would let a sheet that does not take its shape do so.
fn divide(panel: &Panel<'_>) -> Option<Finding> {
    let predicted = panel.part.predicted?;
    let kind = FindingKind::Divide {
        cut: panel.origin.suggested_cut,
        has_darts: panel.origin.cut_for == SeamCause::Darts,
        has_creases: sharp_creases(panel).next().is_some(),
    };
    (predicted.usage_range()[0] > 1.0).then(|| Finding::new(kind, worst(panel)))
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
    scored_creases(panel.part.sheet.mesh()).into_iter().filter(|&angle| angle > 0.0)
}

fn folds(panel: &Panel<'_>) -> Option<Finding> {
    let sharp: Vec<f64> = sharp_creases(panel).collect();
    let sharpest = sharp.iter().copied().reduce(f64::max)?;
    let stiff = title(panel.part.material.filter(|m| !m.folds()));
    Some(Finding::of_whole(FindingKind::Creases { count: sharp.len(), sharpest, stiff }))
}

/// The folds of a piece of a net.
fn net_folds(panel: &Panel<'_>) -> Option<Finding> {
    let ([mountains, valleys], sharpest) = fold_counts(panel.part.sheet, &panel.part.flat.points);
    let stiff = title(panel.part.material.filter(|m| !m.folds()));
    let kind = FindingKind::FoldedFacets { mountains, valleys, sharpest, stiff };
    (mountains + valleys > 0).then(|| Finding::of_whole(kind))
}

/// The rule by which a mesh is folded without being asked for.
fn facets_meant(panel: &Panel<'_>) -> Option<Finding> {
    let FacetsMeant { coarse, overlaps } = panel.origin.net?.meant?;
    let (facets, turn) = (coarse.facets, coarse.median_turn);
    Some(Finding::of_whole(FindingKind::FacetsMeant { facets, turn, overlaps }))
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
