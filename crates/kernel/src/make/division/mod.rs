//! Whether a panel that will not bend would as several panels, and where to divide it.
//!
//! What a sheet must stretch grows with the Gauss curvature of its surface times the square of a
//! distance, so smaller panels may take what a large one does not. Not every line helps:
//!
//! - Along a ruling of the surface that was found, both parts keep their triangles and their
//!   patterns, and the sheet is held at more places. So it is strained no less.
//! - Any other line gives boundaries with surfaces and patterns of their own. Straight across from
//!   rail to rail, it helps strips that are twisted; lengthwise it does not, since their outer
//!   parts are strained more. Lengthwise it helps some that wave, and not across.
//! - A thick sheet that is bent tightly stretches at its edges, however it is divided.
//!
//! No formula tells them apart. So a panel is divided both ways, into two, three and four parts of
//! equal length or width: one between two rails along those ([`between`]), any other by straight
//! chords ([`within`]). Each part gets the surface that fits it best, and an elastic sheet is
//! computed. What is advised is the least number of parts that all take their shape clearly: with
//! the limit beyond the doubt of two nets. No part may have a sharper fold than the whole, since
//! with folds a part may take any shape.
//!
//! Each part of a division takes an elastic sheet. So the search goes part by part, and whoever
//! edits a design can leave it in between.

mod between;
mod parts;
mod search;
mod within;

pub(super) use search::Search;

use super::candidate::{Candidate, Setting};
use super::part::{Found, Part};
use crate::check::{
    CutWay, Finding, FindingKind, LinePlace, Severity, Verdict, bends_divided, check_strain,
    divided_in_vain,
};
use crate::design::PanelMethod;
use crate::elastic::{Basis, Predicted, predict_alone};
use crate::flatten::Beside;
use crate::material::Material;
use between::Between;
use parts::Divisible;
use search::{Division, MOST_PARTS, Step, rank};
use sheetwright_geometry::boundary::{Boundary, PlaneChoice, supporting_plane};
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::triangulate::{Method, TriangulateError, TriangulateOptions, triangulate};
use within::Within;

/// Points that a line is given by, and places beside it on the part that is divided.
const POINTS: usize = 9;
const PLACES: usize = 49;

/// Looks for a division of a part that one [`may_help`], and adds a finding: where to divide it, or
/// that no division was found. Returns whether it added one.
pub(super) fn add_division(
    part: &mut Part,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) -> Result<bool, Stopped> {
    let mut search = Search::default();
    loop {
        if let Looked::Over(finding) = look_on(part, &mut search, material, watch)? {
            let is_said = finding.is_some();
            finding.into_iter().for_each(|finding| part.checked.add(finding));
            return Ok(is_said);
        }
    }
}

/// What looking on comes to.
#[derive(Clone, Debug)]
pub(super) enum Looked {
    /// There is more to look at.
    GoesOn,
    /// The finding: where to divide the part, or that no division was found; `None` where none is
    /// looked for.
    Over(Option<Finding>),
}

/// Goes on with the search for a division of a part that one [`may_help`], by one part of one
/// division. If the watcher asks to stop, that is judged again next time.
pub(super) fn look_on(
    part: &Part,
    search: &mut Search,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) -> Result<Looked, Stopped> {
    let Some(divider) = Divider::new(part, material) else { return Ok(Looked::Over(None)) };
    let judge = |division: &Division, n: usize| divider.judged(division, n, watch);
    Ok(match search.step(judge)? {
        Step::GoesOn => Looked::GoesOn,
        Step::Over(None) => Looked::Over(Some(divided_in_vain(MOST_PARTS))),
        Step::Over(Some(Division { way, parts, strain, verdict })) => {
            let lines = divider.lines(way, parts);
            Looked::Over(Some(bends_divided(way, parts, strain, verdict, lines)))
        }
    })
}

/// The watcher asked to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stopped;

/// The parts are triangulated as the whole was; `first` is how many samples the first of two rails
/// has.
fn options(found: &Found, first: Option<usize>) -> TriangulateOptions {
    let method = match found.method {
        PanelMethod::Optimal => Method::Optimal,
        PanelMethod::Bridge => Method::Bridge,
        PanelMethod::Rails => first.map_or(Method::Optimal, |first| Method::Rails { first }),
    };
    let mut options =
        TriangulateOptions { method, goal: found.goal, ..TriangulateOptions::default() };
    options.price.fold = found.fold;
    options
}

/// Whether nothing but strain, and folds that come with it, keeps a part between curves from
/// bending, and the strain is not that of its edges alone.
pub(super) fn may_help(part: &Part) -> bool {
    let (Some(predicted), Some(_)) = (&part.predicted, part.found()) else { return false };
    let errors = part.checked.findings.iter().filter(|f| f.severity() == Severity::Error);
    let is_strain = |kind: &FindingKind| {
        matches!(kind, FindingKind::StrainTooLarge { basis: Basis::Computed, .. })
    };
    let comes_with_it = |kind: &FindingKind| matches!(kind, FindingKind::Folds { .. });
    let limits = &predicted.limits;
    let of_edges = limits.outer_fibre_at(predicted.curvature) * EDGE_SHARE;
    errors.clone().any(|f| is_strain(&f.kind))
        && errors.clone().all(|f| is_strain(&f.kind) || comes_with_it(&f.kind))
        && of_edges <= limits.strain
}

/// Edges of a bent sheet are strained by this share of its outer fibre, as in the formula.
const EDGE_SHARE: f64 = 1.0 / 12.0;

/// What is needed to judge the parts of a panel.
struct Divider<'a> {
    part: &'a Part,
    shape: Box<dyn Divisible + 'a>,
    plane: PlaneChoice,
    options: TriangulateOptions,
    material: Option<&'a Material>,
    /// The sharpest fold of the whole, radians.
    sharpest: f64,
}

impl<'a> Divider<'a> {
    /// `None` of a mesh, and where no lines could run.
    fn new(part: &'a Part, material: Option<&'a Material>) -> Option<Self> {
        let found = part.found()?;
        let (boundary, outline) = (&found.boundary, &found.outline);
        let shape: Box<dyn Divisible> = match Between::new(boundary, outline) {
            Some(between) => Box::new(between),
            None => Box::new(Within::new(boundary, outline, found.plane.is_some())?),
        };
        let folds = part.measures.rungs.iter().filter(|rung| rung.is_fold);
        Some(Self {
            part,
            options: options(found, shape.of_first_rail()),
            shape,
            plane: if found.plane.is_some() { PlaneChoice::Auto } else { PlaneChoice::None },
            material,
            sharpest: folds.map(|rung| rung.crease.abs()).fold(0.0, f64::max),
        })
    }

    /// The strain of the `n`-th part of a division and the verdict on it, if it takes its shape.
    fn judged(
        &self,
        division: &Division,
        n: usize,
        watch: &mut dyn Watch,
    ) -> Result<Option<(f64, Verdict)>, Stopped> {
        let around = self.shape.around(division.way, division.parts, n);
        let Some(boundary) = around.and_then(|loops| Boundary::new(loops).ok()) else {
            return Ok(None);
        };
        let Ok(plane) = supporting_plane(&boundary, self.plane) else { return Ok(None) };
        let (plane, options) = (plane.as_ref(), &self.options);
        let triangulation = match triangulate(&boundary, plane, options, watch) {
            Err(TriangulateError::Stopped) => return Err(Stopped),
            Err(_) => return Ok(None),
            Ok(found) => found,
        };
        let (material, thick) = (self.material, self.part.thick);
        // Its edges end at its corners: it is judged, and no pattern of it is cut.
        let boundary = &boundary;
        let setting = Setting { boundary, plane, options, material, thick, ends: &[] };
        let candidate = match setting.candidate(&self.part.name, &triangulation, &[], watch) {
            Ok(candidate) => candidate,
            Err(_) if watch.stop() => return Err(Stopped),
            Err(_) => return Ok(None),
        };
        let Candidate { sheet, flat, mut measures, predicted, mut checked, .. } = candidate;
        let Some(screened) = predicted else { return Ok(None) };
        let Some(predicted) = predict_alone(&sheet, &flat, &measures, &screened, watch) else {
            return Err(Stopped);
        };
        measures.score(&predicted.scored);
        check_strain(&mut checked, &predicted, &measures, material);
        let scored = measures.rungs.iter().filter(|rung| rung.is_scored);
        let is_sharper = |crease: f64| crease > self.sharpest;
        let is_fine = rank(checked.verdict) < rank(Verdict::Undecided)
            && checked.findings.iter().all(|f| f.severity() != Severity::Error)
            && clearly_takes(&predicted)
            && !scored.map(|rung| rung.crease.abs()).any(is_sharper);
        Ok(is_fine.then_some((predicted.strain, checked.verdict)))
    }

    /// The lines that divide it.
    fn lines(&self, way: CutWay, parts: usize) -> Vec<LinePlace> {
        let Part { sheet, flat, .. } = self.part;
        let (triangles, positions) = (sheet.mesh().triangles(), &self.part.drawn()[..]);
        let part = Beside { triangles, positions, flat: &flat.points };
        let line = |(at, places): (Vec<Point3>, Vec<Point3>)| {
            let nearest = places.into_iter().map(|at| part.nearest(at));
            LinePlace { at, on_part: nearest.map(|nearest| (nearest.at, nearest.flat)).collect() }
        };
        let [points, places] = [POINTS, PLACES].map(|count| self.shape.lines(way, parts, count));
        points.into_iter().zip(places).map(line).collect()
    }
}

/// Whether a sheet was computed that takes the shape even at the upper end of its doubt.
fn clearly_takes(predicted: &Predicted) -> bool {
    predicted.basis == Basis::Computed && predicted.usage_range()[1] <= 1.0
}
