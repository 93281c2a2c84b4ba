//! A design: all inputs as one plain value, from which [`make`] derives every stage.

mod error;
mod joining;
mod links;
mod live;
mod mesh_design;
mod meshes;
mod outline;
mod rebuilt;
mod run_on;
mod sampling;
mod specks;
mod varying;
mod without_plane;

pub use error::{MakeCause, MakeError, VaryCause};
pub use joining::Join;
pub use live::{Live, LivePanel};
pub use mesh_design::{MeshDesign, MeshGroup};
pub use meshes::{
    Joint, MAX_MESH_PANELS, MadeMesh, MadeMeshes, MeshCause, MeshMakeError, MeshOptions,
    make_meshes,
};
pub use rebuilt::Rebuilt;
pub use varying::{Change, MovedBy, Vary};

use crate::boundary::{Boundary, Outline, PlaneChoice, SupportingPlane, supporting_plane};
use crate::check::{Checked, Finding, Panel, check, ran_on, rounded_corner, stayed_straight};
use crate::cost::{DEFAULT_FOLD, Prices};
use crate::curve::{CurveKind, CurvePoint};
use crate::flatten::{Flattened, Sheet, lay_flat};
use crate::material::Material;
use crate::math::Point3;
use crate::measure::{Measures, measures};
use crate::pattern::{PatternOptions, Piece, piece};
use crate::surface::{Connectivity, Surface};
use crate::triangulate::{
    DEFAULT_WORK, Goal, Method, TriangulateOptions, Triangulation, refuse, triangulate_near,
    with_holes_facing,
};
use crate::watch::{Stage, Watch};
pub(crate) use sampling::LEAST_OF_HOLE;
use sampling::{Sampled, Sampler, Sourced, matched};
use std::collections::BTreeSet;
use without_plane::Known;

/// A curve of a design, under its name.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignCurve {
    /// Its name; no two curves share one.
    pub name: String,
    /// How its points make the curve; `None` if the points are the samples themselves, with
    /// tangents from central differences.
    pub kind: Option<CurveKind>,
    /// Whether it ends where it begins.
    pub closed: bool,
    /// Its points.
    pub points: Vec<CurvePoint>,
}

/// A curve as a part of a loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CurveUse {
    /// Its name.
    pub name: String,
    /// Whether it is run from its end to its beginning.
    pub reversed: bool,
}

/// What bounds a panel.
#[derive(Clone, Debug, PartialEq)]
pub enum PanelShape {
    /// Two open curves, which may run either way; straight edges join their ends.
    Rails([CurveUse; 2]),
    /// Curves chained end to end to closed loops.
    Loops {
        /// The outer loop.
        outer: Vec<CurveUse>,
        /// The holes.
        holes: Vec<Vec<CurveUse>>,
    },
    /// Other panels, joined.
    Join(Join),
}

/// Which triangulations of a panel are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PanelMethod {
    /// All of them.
    #[default]
    Optimal,
    /// Those whose every triangle has an edge of the boundary.
    Bridge,
    /// Those whose every rung joins the two rails; only for rails.
    Rails,
}

impl PanelMethod {
    /// How designs and reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Bridge => "bridge",
            Self::Rails => "rails",
        }
    }
}

/// The least effort of a panel, as a multiple of the default.
pub const LEAST_EFFORT: f64 = 0.001;
/// The greatest effort of a panel, as a multiple of the default: up to an hour and a half.
pub const MOST_EFFORT: f64 = 1000.0;

/// A panel of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignPanel {
    /// Its name, which its files get; no two panels share one.
    pub name: String,
    /// What bounds it.
    pub shape: PanelShape,
    /// Samples of the outer loop, or of each rail.
    pub samples: usize,
    /// Which triangulations are looked at.
    pub method: PanelMethod,
    /// What is made as small as can be.
    pub goal: Goal,
    /// Which supporting plane it asks for.
    pub plane: PlaneChoice,
    /// Whether the rails run on beyond their ends, so that rulings may leave the strip there; its
    /// ends are then no longer straight. Only for rails.
    pub run_on: bool,
    /// The weight ν of the fold price.
    pub fold: f64,
    /// How much work the search may do where there are holes, as a multiple of [`DEFAULT_WORK`],
    /// within [`LEAST_EFFORT`] ..= [`MOST_EFFORT`].
    pub effort: f64,
    /// Where the pattern is to be cut open if it must be, mm: along the rungs from loop to loop
    /// whose middles lie nearest. Empty: where the cuts are shortest.
    pub cut: Vec<Point3>,
}

impl DesignPanel {
    /// A panel with the defaults: the best of all triangulations by its price with the default
    /// fold, on the best-fit plane where there is one, and straight ends.
    pub fn new(name: impl Into<String>, shape: PanelShape, samples: usize) -> Self {
        Self {
            name: name.into(),
            shape,
            samples,
            method: PanelMethod::Optimal,
            goal: Goal::Price,
            plane: PlaneChoice::Auto,
            run_on: false,
            fold: DEFAULT_FOLD,
            effort: 1.0,
            cut: Vec::new(),
        }
    }
}

/// All inputs of the main job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Design {
    /// Its name.
    pub name: String,
    /// The sheet it is made from, if one is named.
    pub material: Option<&'static Material>,
    /// Its curves.
    pub curves: Vec<DesignCurve>,
    /// Its panels.
    pub panels: Vec<DesignPanel>,
    /// What may move so that the sheet bends better, one after the other. Where there is none and
    /// some points have a distance by which they may move, those may.
    pub vary: Vec<Vary>,
    /// Whether curves that several panels share get as many samples on each, the most that any of
    /// them gives it, so that both sides of a seam have the same samples. They do in any case where
    /// something moves.
    pub match_seams: bool,
}

impl Design {
    /// The panels that are made, in order: all but those that a join takes the place of.
    pub fn panels_to_make(&self) -> Vec<&DesignPanel> {
        let mut replaced: BTreeSet<&str> = BTreeSet::new();
        let mut kept: BTreeSet<&str> = BTreeSet::new();
        for panel in &self.panels {
            if let PanelShape::Join(join) = &panel.shape {
                let names = if join.keep_parts { &mut kept } else { &mut replaced };
                names.extend(join.parts.iter().map(String::as_str));
            }
        }
        // A join is no part of another, whatever is written there; making it says so.
        let is_made = |panel: &&DesignPanel| {
            let name = panel.name.as_str();
            let is_join = matches!(panel.shape, PanelShape::Join(_));
            is_join || !replaced.contains(name) || kept.contains(name)
        };
        self.panels.iter().filter(is_made).collect()
    }
}

/// A panel with everything that was derived from it.
#[derive(Clone, Debug, PartialEq)]
pub struct MadePanel {
    /// Its name.
    pub name: String,
    /// Which triangulations were looked at.
    pub method: PanelMethod,
    /// What was made as small as could be.
    pub goal: Goal,
    /// The weight ν of the fold price.
    pub fold: f64,
    /// The boundary as it was sampled.
    pub boundary: Boundary,
    /// The curves between the samples of the boundary.
    pub outline: Outline,
    /// The supporting plane, if there is one.
    pub plane: Option<SupportingPlane>,
    /// Its triangulation.
    pub triangulation: Triangulation,
    /// Its surface in space.
    pub surface: Surface,
    /// Its surface as it is cut open to lie flat: itself where there are no seams.
    pub sheet: Sheet,
    /// Its sheet laid flat.
    pub flat: Flattened,
    /// What was measured.
    pub measures: Measures,
    /// The verdict and its findings.
    pub checked: Checked,
    /// The pattern to cut.
    pub piece: Piece,
    /// How its boundary was moved, if it was to be.
    pub change: Option<Change>,
}

/// A design with everything that was derived from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// Its name.
    pub name: String,
    /// The sheet it is made from, if one is named.
    pub material: Option<&'static Material>,
    /// Its panels, in the order of the design, without those that a join takes the place of.
    pub panels: Vec<MadePanel>,
    /// The design with its points moved, if any were: making it comes to the same.
    pub moved: Option<Design>,
}

/// Makes a design: the surface, the flat pattern, the measures and the verdict of every panel.
///
/// # Errors
/// The first panel or curve that can't be made, and why.
pub fn make(design: &Design, watch: &mut dyn Watch) -> Result<Made, MakeError> {
    if design.panels.is_empty() {
        let cause = MakeCause::NoPanels;
        return Err(MakeError { panel: String::new(), curve: None, cause });
    }
    let varied = varying::varied(design, watch)?;
    let made_from = varied.as_ref().map_or(design, |varied| &varied.after);
    let mut panels = make_panels(made_from, |_| true, watch)?;
    let mut moved = None;
    if let Some(varied) = varied {
        let shifts = &varied.shifts;
        let is_shifted = |panel: &DesignPanel| shifts.contains_key(&panel.name);
        let before = make_panels(&varied.before, is_shifted, watch)?;
        for before in before {
            let panel = panels.iter_mut().find(|panel| panel.name == before.name);
            if let (Some(panel), Some(shift)) = (panel, shifts.get(&before.name)) {
                let change = Change::new(before, shift);
                panel.checked.add(crate::check::moved(&change.said(panel)));
                panel.change = Some(change);
            }
        }
        let is_moved = shifts.values().any(|shift| shift.is_moved());
        moved = is_moved.then_some(varied.after);
    }
    Ok(Made { name: design.name.clone(), material: design.material, panels, moved })
}

fn make_panels(
    design: &Design,
    wanted: impl Fn(&DesignPanel) -> bool,
    watch: &mut dyn Watch,
) -> Result<Vec<MadePanel>, MakeError> {
    let matched = matched(design);
    let sampler = Sampler { design, matched: &matched };
    let panels = design.panels_to_make().into_iter().filter(|panel| wanted(panel));
    let make = |panel: &DesignPanel| {
        let mut known = None;
        let mut made = make_panel(&sampler, panel, &mut known, watch)?;
        if let Some(known) = &mut known {
            let failed = |cause| MakeError { panel: panel.name.clone(), curve: None, cause };
            known.answer(&mut made, watch).map_err(failed)?;
        }
        Ok(made)
    };
    panels.map(make).collect()
}

/// Makes one panel; `known` is what is known of its triangulation from when it was made before, and
/// then from now, with a question that may be open.
fn make_panel(
    sampler: &Sampler<'_>,
    panel: &DesignPanel,
    known: &mut Option<Known>,
    watch: &mut dyn Watch,
) -> Result<MadePanel, MakeError> {
    match make_as_asked(sampler, panel, known, watch) {
        Err(error) if panel.run_on && error.cause != MakeCause::RunOn && !watch.stop() => {
            let straight = DesignPanel { run_on: false, ..panel.clone() };
            *known = None;
            let mut made = make_as_asked(sampler, &straight, known, watch)?;
            made.checked.add(stayed_straight(&error.cause.to_string()));
            Ok(made)
        }
        made => made,
    }
}

/// What a panel is triangulated from.
struct Prepared {
    boundary: Boundary,
    plane: Option<SupportingPlane>,
    options: TriangulateOptions,
    /// Where the samples of the boundary are from.
    sources: Vec<Sourced>,
    /// Where rails ran on: how far each end bulges from the straight line, mm, if it does.
    new_ends: Option<[Option<f64>; 2]>,
    findings: Vec<Finding>,
}

fn prepare(
    sampler: &Sampler<'_>,
    panel: &DesignPanel,
    watch: &mut dyn Watch,
) -> Result<Prepared, MakeError> {
    let failed = |cause: MakeCause| MakeError { panel: panel.name.clone(), curve: None, cause };
    let sampled = sampler.sampled(panel)?;
    let method = match panel.method {
        PanelMethod::Optimal => Method::Optimal,
        PanelMethod::Bridge => Method::Bridge,
        PanelMethod::Rails => Method::Rails {
            first: sampled.on_first_rail.ok_or_else(|| failed(MakeCause::NoRails))?,
        },
    };
    let mut options =
        TriangulateOptions { method, goal: panel.goal, ..TriangulateOptions::default() };
    options.price.fold = panel.fold;
    options.work_limit = (panel.effort * DEFAULT_WORK as f64) as u64;
    // Before the boundary is looked at, which takes its time for a long one.
    let lengths: Vec<usize> = sampled.loops.iter().map(Vec::len).collect();
    refuse(&lengths, &options).map_err(|e| failed(MakeCause::Triangulate(e)))?;
    let boundary = Boundary::new(sampled.samples()).map_err(|e| failed(MakeCause::Boundary(e)))?;
    let plane_of = |boundary: &Boundary| {
        supporting_plane(boundary, panel.plane).map_err(|e| failed(MakeCause::Plane(e)))
    };
    let mut plane = plane_of(&boundary)?;
    let Sampled { mut loops, new_ends, findings, .. } = sampled;
    let mut faced = boundary;
    if faced.holes() > 0 {
        faced = with_holes_facing(&faced, plane.as_ref(), &options, watch)
            .map_err(|e| failed(MakeCause::Triangulate(e)))?;
        plane = plane_of(&faced)?;
        for (sources, range) in loops.iter_mut().zip(faced.loops()) {
            // A hole that was turned keeps its first sample.
            if sources[1].sample.position != faced.samples()[range.start + 1].position {
                sources[1..].reverse();
                sources.iter_mut().for_each(|source| *source = source.back());
            }
        }
    }
    let sources = loops.into_iter().flatten().collect();
    Ok(Prepared { boundary: faced, plane, options, sources, new_ends, findings })
}

fn make_as_asked(
    sampler: &Sampler<'_>,
    panel: &DesignPanel,
    known: &mut Option<Known>,
    watch: &mut dyn Watch,
) -> Result<MadePanel, MakeError> {
    let failed = |cause: MakeCause| MakeError { panel: panel.name.clone(), curve: None, cause };
    let design = sampler.design;
    watch.begin(&[&panel.name], Stage::Sample);
    let Prepared { boundary, plane, options, sources, new_ends, findings } =
        prepare(sampler, panel, watch)?;
    let outline = outline::outline(design, &boundary, &sources);

    watch.begin(&[&panel.name], Stage::Solve);
    let before = known.as_ref().map(Known::cheapest);
    let cheapest = triangulate_near(&boundary, plane.as_ref(), &options, before, watch)
        .map_err(|e| failed(MakeCause::Triangulate(e)))?;
    let triangulation = cheapest.triangulation.clone();
    let next = Known::next(known.take(), cheapest);
    let known = known.insert(next);
    let connectivity = Connectivity::new(boundary.loops(), triangulation.triangles.clone())
        .map_err(|e| failed(MakeCause::Surface(e)))?;
    let surface = Surface::new(connectivity, boundary.positions());

    watch.begin(&[&panel.name], Stage::Flatten);
    let (sheet, flat) =
        lay_flat(&surface, &panel.cut, watch).map_err(|e| failed(MakeCause::Flatten(e)))?;

    watch.begin(&[&panel.name], Stage::Check);
    let prices = Prices::new(&boundary, plane.as_ref(), options.price);
    let measures = measures(&surface, &sheet, &flat, &prices);
    let mut checked = check(&Panel {
        boundary: &boundary,
        triangulation: &triangulation,
        sheet: &sheet,
        flat: &flat,
        measures: &measures,
        material: design.material,
    });
    for curve in used(design, &panel.shape).filter(|c| c.kind == Some(CurveKind::Spline)) {
        if let Some(finding) = rounded_corner(&curve.name, &curve.points, curve.closed) {
            checked.add(finding);
        }
    }
    if let Some(bulges_mm) = new_ends {
        let straight = DesignPanel { run_on: false, ..panel.clone() };
        let straight = make_as_asked(sampler, &straight, &mut None, watch).ok();
        checked.add(ran_on(bulges_mm, &measures, straight.as_ref().map(|made| &made.measures)));
    }
    findings.into_iter().for_each(|finding| checked.add(finding));
    let piece = piece(&panel.name, &sheet, &flat, &measures, &PatternOptions::default());
    let made = MadePanel {
        name: panel.name.clone(),
        method: panel.method,
        goal: panel.goal,
        fold: panel.fold,
        boundary,
        outline,
        plane,
        triangulation,
        surface,
        sheet,
        flat,
        measures,
        checked,
        piece,
        change: None,
    };
    known.ask(panel, &made, options);
    Ok(made)
}

/// The curves that bound a panel, or the panels that it joins.
fn used<'a>(design: &'a Design, shape: &'a PanelShape) -> impl Iterator<Item = &'a DesignCurve> {
    fn names(shape: &PanelShape) -> Vec<&str> {
        match shape {
            PanelShape::Rails(rails) => rails.iter().map(|rail| rail.name.as_str()).collect(),
            PanelShape::Loops { outer, holes } => {
                let uses = std::iter::once(outer).chain(holes).flatten();
                uses.map(|part| part.name.as_str()).collect()
            }
            PanelShape::Join(_) => Vec::new(),
        }
    }
    let names = match shape {
        PanelShape::Join(join) => {
            let parts = design.panels.iter().filter(|panel| join.parts.contains(&panel.name));
            parts.flat_map(|part| names(&part.shape)).collect()
        }
        _ => names(shape),
    };
    design.curves.iter().filter(move |curve| names.contains(&curve.name.as_str()))
}
