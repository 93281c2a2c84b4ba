//! Findings on a surface that was found: does the sheet follow it by bending?

use super::{Finding, FindingKind, Place, PointReach, SeamCause, Subject, TooTight, Verdict};
use super::{overlap, seams, strain};
use crate::design::Thick;
use crate::measure::{RungMeasures, SHARP_CREASE_DEG};
use crate::sheet::Seam;
use sheetwright_geometry::boundary::Boundary;
use sheetwright_geometry::math::{Vec3, to_deg};
use sheetwright_optimum::triangulate::Triangulation;

/// Length errors below it, as a share of the size over the shortest side, are rounding: an exact
/// pattern has a thousandth of it.
const ROUNDING: f64 = 1e-9;

/// A part with the boundary that its surface was found for.
pub(super) struct Panel<'a> {
    pub(super) part: &'a Subject<'a>,
    pub(super) boundary: &'a Boundary,
    pub(super) triangulation: &'a Triangulation,
}

/// The findings on it.
pub(super) fn findings(panel: &Panel<'_>) -> Vec<Finding> {
    let checks: [fn(&Panel<'_>) -> Option<Finding>; 9] = [
        points,
        crossing,
        |panel: &Panel<'_>| overlap(panel.part),
        forced_rungs,
        bend_lines,
        length_error,
        open_windows,
        |panel: &Panel<'_>| seams(panel.part, SeamCause::NotFlat),
        not_proven,
    ];
    let Subject { predicted, measures, material, .. } = *panel.part;
    let strained = strain::findings(predicted, measures, material);
    strained.into_iter().chain(checks.iter().filter_map(|check| check(panel))).collect()
}

/// A point where the sheet turns by less than this, degrees, is rounded off and hardly seen.
const SEEN_POINT_DEG: f64 = 15.0;

/// A point is no harder on a sheet than a fold through it. So a sheet that folds takes points; a
/// stiff one takes them only if the shallowest roll that rounds them off is wide enough.
fn points(panel: &Panel<'_>) -> Option<Finding> {
    let apexes = &panel.part.measures.apexes;
    let sharpest = apexes.iter().max_by(|a, b| a.turn.total_cmp(&b.turn))?;
    let stiff =
        panel.part.material.filter(|m| !m.folds() && sharpest.radius_mm < m.bend_radius_mm.value);
    if stiff.is_none() && to_deg(sharpest.turn) < SEEN_POINT_DEG {
        return None;
    }
    let too_tight = stiff.map(|m| TooTight {
        sheet: m.title.clone(),
        limit_mm: m.bend_radius_mm.value,
        needed_mm: sharpest.radius_mm,
    });
    let numbers = apexes.iter().map(|apex| apex.sample).collect();
    let reach = panel.part.material.and_then(|m| {
        let limit_mm = m.bend_radius_mm.value;
        let reach_mm = apexes.iter().map(|apex| apex.reach_mm(limit_mm)).fold(0.0, f64::max);
        // A point that reaches over the whole panel has no size of its own.
        let reach = PointReach { reach_mm, limit_mm, folds: m.folds() };
        (reach_mm < panel.boundary.size()).then_some(reach)
    });
    let kind = FindingKind::Points { count: apexes.len(), turn: sharpest.turn, reach, too_tight };
    Some(Finding::new(kind, Place::Samples { numbers }))
}

/// The finding on smooth bends so tight that the inner face of the sheet has no radius left, where
/// its thickness counts. `rungs` are those of the drawn face; `bends_up` says whether most of it
/// bends towards the side that it faces, so that its inner face is there.
pub(crate) fn sheet_too_thick(
    rungs: &[RungMeasures],
    thick: Thick,
    bends_up: bool,
) -> Option<Finding> {
    let Thick { dimensions, thickness_mm, .. } = thick;
    // How far inside of the drawn face the inner face of a bend lies.
    let inside_mm = |rung: &RungMeasures| {
        let share = dimensions.share();
        let is_most = (rung.crease < 0.0) == bends_up;
        thickness_mm * if is_most { share } else { 1.0 - share }
    };
    let is_tight = |rung: &RungMeasures| {
        rung.bends() && !rung.is_fold && rung.bend_radius_mm <= inside_mm(rung)
    };
    let left_mm = |rung: &RungMeasures| rung.bend_radius_mm - inside_mm(rung);
    let tight = rungs.iter().filter(|rung| is_tight(rung));
    let worst = tight.min_by(|a, b| left_mm(a).total_cmp(&left_mm(b)))?;
    let (drawn_mm, inside_mm) = (worst.bend_radius_mm, inside_mm(worst));
    let kind = FindingKind::SheetTooThick { drawn_mm, inside_mm, thickness_mm };
    Some(Finding::new(kind, Place::rungs(rungs, is_tight)))
}

fn crossing(panel: &Panel<'_>) -> Option<Finding> {
    let crossing = panel.part.measures.self_crossing?;
    let corners = crossing.map(|t| panel.triangulation.triangles[t.get()]).to_vec();
    Some(Finding::new(FindingKind::SelfCrossing, Place::Triangles { corners }))
}

fn forced_rungs(panel: &Panel<'_>) -> Option<Finding> {
    let count = panel.triangulation.forced_rungs;
    let forced = |r: &RungMeasures| r.normals[0] == Vec3::ZERO;
    let place = || Place::rungs(&panel.part.measures.rungs, forced);
    (count > 0).then(|| Finding::new(FindingKind::RungWithoutPlane { count }, place()))
}

/// The finding that a surface which need not lie over the supporting plane has a much lower price.
pub(crate) fn better_without_plane(with: f64, without: f64) -> Finding {
    Finding::of_whole(FindingKind::BetterWithoutPlane { with, without })
}

/// The finding that another surface fits the boundary about as well, so far apart, mm, with this
/// verdict, and with the pattern of the first or one of its own.
pub(crate) fn two_surfaces(apart_mm: f64, is_one_pattern: bool, other: Verdict) -> Finding {
    Finding::of_whole(FindingKind::TwoSurfaces { apart_mm, is_one_pattern, other })
}

/// The finding that the other surface was asked for and there is none.
pub(crate) fn no_other_surface() -> Finding {
    Finding::of_whole(FindingKind::NoOtherSurface)
}

fn not_proven(panel: &Panel<'_>) -> Option<Finding> {
    let gap = panel.triangulation.gap();
    // For one loop, a method other than optimal proves nothing, so no gap is known.
    let is_open = gap.map_or(panel.boundary.holes() > 0, |gap| gap > 0.0);
    let cut_short = panel.triangulation.cut_short;
    is_open.then(|| Finding::of_whole(FindingKind::NotProven { gap, cut_short }))
}

fn bend_lines(panel: &Panel<'_>) -> Option<Finding> {
    let is_line = |r: &RungMeasures| to_deg(r.crease.abs()) > SHARP_CREASE_DEG && !r.is_fold;
    let lines = panel.part.measures.rungs.iter().filter(|r| is_line(r));
    let sharpest = lines.clone().map(|r| r.crease.abs()).reduce(f64::max)?;
    let kind = FindingKind::BendLines { count: lines.count(), sharpest };
    Some(Finding::new(kind, Place::rungs(&panel.part.measures.rungs, is_line)))
}

fn length_error(panel: &Panel<'_>) -> Option<Finding> {
    let largest = panel.part.measures.length_error_max;
    let exact = ROUNDING * panel.boundary.size() / shortest_side(panel.boundary);
    let closes_holes = panel.boundary.holes() > 0;
    (largest > exact.max(ROUNDING))
        .then(|| Finding::of_whole(FindingKind::LengthError { largest, closes_holes }))
}

/// The widest gap of a seam round a window that nearly lies flat, as a share of the size; a wider
/// one opens a tube. (A ring that rises by 2° has such a gap.)
const WINDOW_GAP: f64 = 2e-3;

fn open_windows(panel: &Panel<'_>) -> Option<Finding> {
    if panel.part.flat.overlap.is_some() {
        return None;
    }
    let nearly = |seam: &Seam| seam.gap_mm <= WINDOW_GAP * panel.boundary.size();
    let widest = panel.part.sheet.seams().iter().filter(|s| nearly(s)).map(|s| s.gap_mm);
    let kind = FindingKind::WindowGap { widest_mm: widest.reduce(f64::max)? };
    Some(Finding::new(kind, Place::seams(panel.part.sheet, nearly)))
}

fn shortest_side(boundary: &Boundary) -> f64 {
    (0..boundary.len())
        .map(|i| {
            let at = |k: usize| boundary.samples()[k].position;
            at(i).distance(at(boundary.next(i)))
        })
        .fold(f64::INFINITY, f64::min)
}
