//! Panels that are bounded by curves: the surface that fits them best is found.

use super::MakeError;
use super::candidate::{Candidate, Setting};
use super::part::{Found, Origin, Part};
use super::unrestricted::Known;
use crate::check::{
    no_other_surface, off_tolerance, ran_on, rounded_corner, smoothed_joints, spline_bulge,
    stayed_straight, turned_round, unfair_line,
};
use crate::design::{DesignPanel, PanelShape, used};
use crate::edge::edges_of_boundary;
use crate::pattern::{PatternOptions, piece, seam_marks};
use crate::sample::{Chords, PanelCause, Prepared, Sampler, outline, prepare};
use sheetwright_geometry::curve::CurveKind;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::watch::{Stage, Watch};
use sheetwright_optimum::triangulate::{WhichSurface, triangulate_near};

/// Makes one panel, its pattern without texts if it is bare. `known` holds its triangulation from
/// the last time it was made, and then the new one, with a question that may be open.
pub(super) fn make_found(
    sampler: &Sampler<'_>,
    panel: &DesignPanel,
    is_bare: bool,
    known: &mut Option<Known>,
    watch: &mut dyn Watch,
) -> Result<Part, MakeError> {
    match make_as_asked(sampler, panel, is_bare, known, watch) {
        Err(error) if panel.run_on && error.cause != PanelCause::RunOn.into() && !watch.stop() => {
            let straight = DesignPanel { run_on: false, ..panel.clone() };
            *known = None;
            let mut made = make_as_asked(sampler, &straight, is_bare, known, watch)?;
            made.checked.add(stayed_straight(&error.cause.to_string()));
            Ok(made)
        }
        made => made,
    }
}

fn make_as_asked(
    sampler: &Sampler<'_>,
    panel: &DesignPanel,
    is_bare: bool,
    known: &mut Option<Known>,
    watch: &mut dyn Watch,
) -> Result<Part, MakeError> {
    let design = sampler.design;
    watch.begin(&[&panel.name], Stage::Sample);
    let Prepared { boundary, plane, options, sources, steps, new_ends, joined } =
        prepare(sampler, panel, watch)?;
    let outline = outline(design, &boundary, &sources);
    let chords = Chords::new(design, &sources, &steps, boundary.loops());

    watch.begin(&[&panel.name], Stage::Solve);
    let before = known.as_ref().map(Known::cheapest);
    let cheapest = triangulate_near(&boundary, plane.as_ref(), &options, before, watch)
        .map_err(|e| MakeError::of_panel(&panel.name, e))?;
    let triangulation = cheapest.triangulation.clone();
    let next = Known::next(known.take(), cheapest);
    let known = known.insert(next);
    let cut = &panel.cut;
    let (material, thick) = (design.material.as_ref(), design.thick());
    // Ends that run on are curves, and hold the sheet as any other.
    let is_end = |n: &usize| new_ends.is_none() && steps[*n].is_end();
    let step = |n: usize| [n, boundary.next(n)].map(SampleIndex::new);
    let ends = (0..boundary.len()).filter(is_end).map(step).collect::<Vec<_>>();
    let setting = Setting {
        boundary: &boundary,
        plane: plane.as_ref(),
        options: &options,
        material,
        thick,
        ends: &ends,
    };
    let failed = |cause| MakeError::of_panel(&panel.name, cause);
    let candidate = setting.candidate(&panel.name, &triangulation, cut, watch).map_err(failed)?;
    let Candidate { surface, sheet, flat, measures, predicted, mut checked } = candidate;
    if panel.which == WhichSurface::Other && !triangulation.is_other {
        checked.add(no_other_surface());
    }
    for curve in used(design, &panel.shape).filter(|c| c.kind == Some(CurveKind::Spline)) {
        if let Some(finding) = rounded_corner(&curve.name, &curve.points, curve.closed) {
            checked.add(finding);
        }
        if !curve.closed {
            let found = [unfair_line, spline_bulge].map(|of| of(&curve.name, &curve.points));
            found.into_iter().flatten().for_each(|finding| checked.add(finding));
        }
    }
    let tolerance_mm = panel.tolerance.map(|tolerance| tolerance.mm(boundary.size()));
    if let Some(finding) = tolerance_mm.and_then(|mm| off_tolerance(panel, &chords, mm)) {
        checked.add(finding);
    }
    if let Some(bulges_mm) = new_ends {
        let straight = DesignPanel { run_on: false, ..panel.clone() };
        let straight = make_as_asked(sampler, &straight, is_bare, &mut None, watch).ok();
        checked.add(ran_on(bulges_mm, &measures, straight.as_ref().map(|made| &made.measures)));
    }
    if let (Some(joined), PanelShape::Join(join)) = (&joined, &panel.shape) {
        let said = smoothed_joints(joined).into_iter().chain(turned_round(joined, &join.parts));
        said.for_each(|finding| checked.add(finding));
    }
    let curve = |number: usize| design.curves[number].name.clone();
    let edges = edges_of_boundary(&sheet, &flat.points, &steps, curve);
    let marks = seam_marks(&sheet);
    let bends = design.bends_of(panel);
    let options_of_piece = PatternOptions { bends, is_net: false, is_bare };
    let piece = piece(&panel.name, &sheet, &flat, &edges, &measures, &marks, &options_of_piece);
    let found = Found {
        method: panel.method,
        goal: panel.goal,
        fold: panel.fold,
        slides: panel.slides,
        ends,
        boundary,
        outline,
        chords,
        tolerance_mm,
        plane,
        triangulation,
        surface,
        change: None,
        other: None,
    };
    known.ask(panel, &found, options);
    let (name, origin) = (panel.name.clone(), Origin::Found(Box::new(found)));
    Ok(Part {
        name: name.clone(),
        panel: name,
        sheet,
        flat,
        measures,
        predicted,
        checked,
        piece,
        thick,
        bends,
        edges,
        origin,
    })
}
