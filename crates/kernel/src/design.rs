//! A design: all inputs as one plain value, from which [`make`] derives every stage.

mod joining;
mod links;
mod run_on;

pub use joining::Join;

use crate::boundary::{
    Boundary, BoundaryError, JoinCause, MAX_SAMPLES, PlaneChoice, PlaneError, SupportingPlane,
    samples_from_points, supporting_plane,
};
use crate::check::{
    Checked, Finding, Panel, Verdict, better_without_plane, check, ran_on, rounded_corner,
    stayed_straight,
};
use crate::cost::{PriceOptions, Prices};
use crate::curve::{
    Curve, CurveError, CurveKind, CurvePoint, Sample, SampleError, sample_chain, sample_open,
};
use crate::flatten::{FlattenError, Flattened, Sheet, lay_flat};
use crate::material::Material;
use crate::math::Point3;
use crate::measure::{Measures, first_self_crossing, measures};
use crate::pattern::{PatternOptions, Piece, piece};
use crate::surface::{Connectivity, ConnectivityError, Surface};
use crate::tolerance::Tolerance;
use crate::triangulate::{
    Goal, Method, TriangulateError, TriangulateOptions, Triangulation, refuse, triangulate,
    with_holes_facing,
};
use crate::watch::{Stage, Watch};
use std::collections::BTreeSet;
use std::fmt;

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
    /// Where the pattern is to be cut open if it must be, mm: along the rungs from loop to loop
    /// whose middles lie nearest. Empty: where the cuts are shortest.
    pub cut: Vec<Point3>,
}

/// All inputs of the main job.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Its name.
    pub name: String,
    /// The sheet it is made from, if one is named.
    pub material: Option<&'static Material>,
    /// Its curves.
    pub curves: Vec<DesignCurve>,
    /// Its panels.
    pub panels: Vec<DesignPanel>,
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
}

/// Why a design can't be made.
#[derive(Clone, Debug, PartialEq)]
pub struct MakeError {
    /// The panel; empty where it is a curve or the design as a whole.
    pub panel: String,
    /// The curve, if it is one.
    pub curve: Option<String>,
    /// What is wrong.
    pub cause: MakeCause,
}

/// What is wrong with a panel or a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum MakeCause {
    /// A design without panels.
    NoPanels,
    /// A curve that the design does not have.
    UnknownCurve,
    /// Points that make no curve.
    Curve(CurveError),
    /// A closed curve as a rail or as one part of several of a loop.
    ClosedCurve,
    /// A loop of one open curve, or of curves whose ends do not meet.
    NotChained {
        /// The curve that should begin where this one ends.
        next: String,
        /// How far apart they are, mm.
        gap_mm: f64,
    },
    /// Both rails are the same curve.
    SameRails,
    /// A rails method for a panel without rails.
    NoRails,
    /// Rails that run on, for a panel without rails or one that is joined to others.
    RunOn,
    /// A join of a panel that the design does not have.
    UnknownPanel {
        /// Its name.
        name: String,
    },
    /// A join of a panel that is a join itself.
    JoinOfJoins {
        /// Its name.
        name: String,
    },
    /// Panels that can't be joined.
    Join {
        /// The one that is not like the others, where it is one.
        part: Option<String>,
        /// What is wrong.
        cause: JoinCause,
    },
    /// Too few samples.
    Sampling(SampleError),
    /// Samples that are no boundary.
    Boundary(BoundaryError),
    /// A plane that supports nothing.
    Plane(PlaneError),
    /// No triangulation.
    Triangulate(TriangulateError),
    /// Triangles that are no surface.
    Surface(ConnectivityError),
    /// No flat pattern.
    Flatten(FlattenError),
}

impl fmt::Display for MakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.panel[..], &self.curve) {
            ("", None) => {}
            ("", Some(curve)) => write!(f, "curve '{curve}': ")?,
            (panel, None) => write!(f, "panel '{panel}': ")?,
            (panel, Some(curve)) => write!(f, "panel '{panel}', curve '{curve}': ")?,
        }
        write!(f, "{}", self.cause)
    }
}

impl std::error::Error for MakeError {}

impl fmt::Display for MakeCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPanels => write!(f, "the design has no panels"),
            Self::UnknownCurve => write!(f, "there is no such curve"),
            Self::Curve(error) => write!(f, "the curve {error}"),
            Self::ClosedCurve => write!(f, "the curve is closed where an open one is needed"),
            Self::NotChained { next, gap_mm } => {
                write!(f, "the curve ends {gap_mm:.6} mm away from where '{next}' begins")
            }
            Self::SameRails => write!(f, "both rails are the same curve"),
            Self::NoRails => write!(f, "the method 'rails' needs a panel with rails"),
            Self::RunOn => {
                write!(f, "only a panel with rails of its own, joined to no other, can run on")
            }
            Self::UnknownPanel { name } => write!(f, "there is no panel '{name}' to join"),
            Self::JoinOfJoins { name } => write!(f, "the panel '{name}' is a join itself"),
            Self::Join { part: Some(part), cause } => write!(f, "joining '{part}': {cause}"),
            Self::Join { part: None, cause } => write!(f, "{cause}"),
            Self::Sampling(error) => write!(f, "{error}"),
            Self::Boundary(error) => write!(f, "{error}"),
            Self::Plane(error) => write!(f, "{error}"),
            Self::Triangulate(error) => write!(f, "{error}"),
            Self::Surface(error) => write!(f, "{error}"),
            Self::Flatten(error) => write!(f, "{error}"),
        }
    }
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
    let panels = design
        .panels_to_make()
        .into_iter()
        .map(|panel| make_panel(design, panel, watch))
        .collect::<Result<Vec<MadePanel>, MakeError>>()?;
    Ok(Made { name: design.name.clone(), material: design.material, panels })
}

/// A surface that need not lie over the plane is worth a word if its price is below this share.
const MUCH_CHEAPER: f64 = 0.5;

fn make_panel(
    design: &Design,
    panel: &DesignPanel,
    watch: &mut dyn Watch,
) -> Result<MadePanel, MakeError> {
    match make_as_asked(design, panel, watch) {
        Err(error) if panel.run_on && error.cause != MakeCause::RunOn && !watch.stop() => {
            let straight = DesignPanel { run_on: false, ..panel.clone() };
            let mut made = make_as_asked(design, &straight, watch)?;
            made.checked.add(stayed_straight(&error.cause.to_string()));
            Ok(made)
        }
        made => made,
    }
}

fn make_as_asked(
    design: &Design,
    panel: &DesignPanel,
    watch: &mut dyn Watch,
) -> Result<MadePanel, MakeError> {
    let failed = |cause: MakeCause| MakeError { panel: panel.name.clone(), curve: None, cause };
    watch.begin(&panel.name, Stage::Sample);
    let sampled = sampled(design, panel)?;
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
    // Before the boundary is looked at, which takes its time for a long one.
    let lengths: Vec<usize> = sampled.loops.iter().map(Vec::len).collect();
    refuse(&lengths, &options).map_err(|e| failed(MakeCause::Triangulate(e)))?;
    let boundary = Boundary::new(sampled.loops).map_err(|e| failed(MakeCause::Boundary(e)))?;
    let plane =
        supporting_plane(&boundary, panel.plane).map_err(|e| failed(MakeCause::Plane(e)))?;

    watch.begin(&panel.name, Stage::Solve);
    let (boundary, plane) = if boundary.holes() == 0 {
        (boundary, plane)
    } else {
        let facing = with_holes_facing(&boundary, plane.as_ref(), &options, watch)
            .map_err(|e| failed(MakeCause::Triangulate(e)))?;
        let plane =
            supporting_plane(&facing, panel.plane).map_err(|e| failed(MakeCause::Plane(e)))?;
        (facing, plane)
    };
    let triangulation = triangulate(&boundary, plane.as_ref(), &options, watch)
        .map_err(|e| failed(MakeCause::Triangulate(e)))?;
    let connectivity = Connectivity::new(boundary.loops(), triangulation.triangles.clone())
        .map_err(|e| failed(MakeCause::Surface(e)))?;
    let surface = Surface::new(connectivity, boundary.positions());

    watch.begin(&panel.name, Stage::Flatten);
    let (sheet, flat) =
        lay_flat(&surface, &panel.cut, watch).map_err(|e| failed(MakeCause::Flatten(e)))?;

    watch.begin(&panel.name, Stage::Check);
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
    let bends = checked.verdict == Verdict::Bends;
    if panel.plane == PlaneChoice::Auto && plane.is_some() && boundary.holes() < 2 && !bends {
        // The plane, rather than the boundary, may be what keeps it from bending.
        let free = triangulate(&boundary, None, &options, watch)
            .map_err(|e| failed(MakeCause::Triangulate(e)))?;
        let connectivity = Connectivity::new(boundary.loops(), free.triangles)
            .map_err(|e| failed(MakeCause::Surface(e)))?;
        let surface = Surface::new(connectivity, boundary.positions());
        if free.price < MUCH_CHEAPER * triangulation.price
            && first_self_crossing(&surface).is_none()
        {
            checked.add(better_without_plane(triangulation.price, free.price));
        }
    }
    if let Some(bulges_mm) = sampled.new_ends {
        let straight = DesignPanel { run_on: false, ..panel.clone() };
        let straight = make_as_asked(design, &straight, watch).ok();
        checked.add(ran_on(bulges_mm, &measures, straight.as_ref().map(|made| &made.measures)));
    }
    sampled.findings.into_iter().for_each(|finding| checked.add(finding));
    let piece = piece(&panel.name, &sheet, &flat, &measures, &PatternOptions::default());
    Ok(MadePanel {
        name: panel.name.clone(),
        method: panel.method,
        goal: panel.goal,
        fold: panel.fold,
        boundary,
        plane,
        triangulation,
        surface,
        sheet,
        flat,
        measures,
        checked,
        piece,
    })
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

struct Sampled {
    loops: Vec<Vec<Sample>>,
    /// How many of the samples lie on the first rail.
    on_first_rail: Option<usize>,
    /// Where rails ran on: how far each end bulges from the straight line, mm, if it does.
    new_ends: Option<[Option<f64>; 2]>,
    /// What is to be said of the samples.
    findings: Vec<Finding>,
}

fn sampled(design: &Design, panel: &DesignPanel) -> Result<Sampled, MakeError> {
    if panel.run_on && !matches!(panel.shape, PanelShape::Rails(_)) {
        let cause = MakeCause::RunOn;
        return Err(MakeError { panel: panel.name.clone(), curve: None, cause });
    }
    match &panel.shape {
        PanelShape::Rails(rails) => sampled_rails(design, panel, rails),
        PanelShape::Join(join) => joining::sampled(design, panel, join),
        PanelShape::Loops { outer, holes } => {
            let outer = sampled_loop(design, panel, outer, |_| panel.samples, 0)?;
            let length: f64 = ring_length(&outer);
            let spacing = length / outer.len() as f64;
            let mut loops = vec![outer];
            for hole in holes {
                let as_spaced = |length: f64| (length / spacing - SAME_SPACING).ceil() as usize;
                loops.push(sampled_loop(design, panel, hole, as_spaced, LEAST_OF_HOLE)?);
            }
            Ok(Sampled { loops, on_first_rail: None, new_ends: None, findings: Vec::new() })
        }
    }
}

/// Lengths that differ by less than this share of the spacing get as many samples: two equal circles
/// are built from different numbers.
const SAME_SPACING: f64 = 1e-6;
/// Samples of a hole at the least, however small it is: a round one must not be cut as a triangle.
const LEAST_OF_HOLE: usize = 24;

fn ring_length(samples: &[Sample]) -> f64 {
    let m = samples.len();
    (0..m).map(|i| samples[i].position.distance(samples[(i + 1) % m].position)).sum()
}

fn found<'a>(
    design: &'a Design,
    panel: &DesignPanel,
    wanted: &CurveUse,
) -> Result<&'a DesignCurve, MakeError> {
    design.curves.iter().find(|curve| curve.name == wanted.name).ok_or_else(|| MakeError {
        panel: panel.name.clone(),
        curve: Some(wanted.name.clone()),
        cause: MakeCause::UnknownCurve,
    })
}

/// The curve of a name, run the way that it is used.
fn built(design: &Design, panel: &DesignPanel, wanted: &CurveUse) -> Result<Curve, MakeError> {
    let source = found(design, panel, wanted)?;
    // Points that are samples themselves are joined straight when they are a part of something.
    let kind = source.kind.unwrap_or(CurveKind::Polyline);
    let curve = Curve::new(kind, &source.points, source.closed).map_err(|error| MakeError {
        panel: String::new(),
        curve: Some(wanted.name.clone()),
        cause: MakeCause::Curve(error),
    })?;
    Ok(if wanted.reversed { curve.reversed() } else { curve })
}

fn sampled_loop(
    design: &Design,
    panel: &DesignPanel,
    parts: &[CurveUse],
    count: impl Fn(f64) -> usize,
    least: usize,
) -> Result<Vec<Sample>, MakeError> {
    let failed = |curve: &str, cause: MakeCause| MakeError {
        panel: panel.name.clone(),
        curve: Some(curve.to_owned()),
        cause,
    };
    if let [only] = parts {
        let source = found(design, panel, only)?;
        if source.kind.is_none() && source.closed {
            let mut points = source.points.clone();
            if only.reversed {
                points.reverse();
            }
            return Ok(samples_from_points(&points));
        }
    }
    let curves =
        parts.iter().map(|part| built(design, panel, part)).collect::<Result<Vec<_>, _>>()?;
    let controls = curves.iter().flat_map(|c| c.spans()).flat_map(|span| span.control);
    let size = crate::boundary::size_of(controls);
    for (n, curve) in curves.iter().enumerate() {
        if curve.closed() {
            if curves.len() > 1 {
                return Err(failed(&parts[n].name, MakeCause::ClosedCurve));
            }
            continue;
        }
        let next = (n + 1) % curves.len();
        let gap_mm = curve.end().distance(curves[next].start());
        if gap_mm > Tolerance::CHAIN.length_mm(size) {
            let cause = MakeCause::NotChained { next: parts[next].name.clone(), gap_mm };
            return Err(failed(&parts[n].name, cause));
        }
    }
    let length: f64 = curves.iter().map(Curve::length).sum();
    let count = count(length).max(least);
    if count > MAX_SAMPLES {
        let cause = MakeCause::Boundary(BoundaryError::TooManySamples { found: count });
        return Err(MakeError { panel: panel.name.clone(), curve: None, cause });
    }
    let sampled = match sample_chain(&curves, count) {
        // Nobody asked for a number of samples of a hole.
        Err(SampleError::TooFew { needed, .. }) if least > 0 => sample_chain(&curves, needed),
        sampled => sampled,
    };
    sampled.map_err(|error| MakeError {
        panel: panel.name.clone(),
        curve: None,
        cause: MakeCause::Sampling(error),
    })
}

fn sampled_rails(
    design: &Design,
    panel: &DesignPanel,
    rails: &[CurveUse; 2],
) -> Result<Sampled, MakeError> {
    let failed = |curve: Option<&str>, cause: MakeCause| MakeError {
        panel: panel.name.clone(),
        curve: curve.map(str::to_owned),
        cause,
    };
    if rails[0].name == rails[1].name {
        return Err(failed(Some(&rails[0].name), MakeCause::SameRails));
    }
    let first = built(design, panel, &rails[0])?;
    let second = built(design, panel, &rails[1])?;
    for (curve, rail) in [&first, &second].into_iter().zip(rails) {
        if curve.closed() {
            return Err(failed(Some(&rail.name), MakeCause::ClosedCurve));
        }
    }
    let sample = |curve: &Curve| {
        sample_open(curve, panel.samples).map_err(|e| failed(None, MakeCause::Sampling(e)))
    };
    let curves = [first, second];
    let (mut first, mut second) = (sample(&curves[0])?, sample(&curves[1])?);
    // The second runs back: the way that leaves the rails nearer to one another all along. Their
    // ends alone would not tell where each rail ends where it begins, as those of a duct do.
    let turned = apart(&first, &second) < apart(&first, &run_back(&second));
    if turned {
        second = run_back(&second);
    }
    let size = crate::boundary::size_of(first.iter().chain(&second).map(|s| s.position));
    let same = Tolerance::CHAIN.length_mm(size);
    let mut new_ends = None;
    if panel.run_on {
        let price = PriceOptions { fold: panel.fold, ..PriceOptions::default() };
        let ran = run_on::run_on(&first, &second, same, price);
        new_ends = Some(ran.bulges_mm);
        [first, second] = ran.rails;
    }
    // Rails that meet at an end share that sample; it keeps the tangents of both.
    let meet = |a: &[Sample], b: &[Sample]| {
        let (end, start) = (a[a.len() - 1], b[0]);
        (end.position.distance(start.position) <= same).then_some(start.tangent_out)
    };
    let (at_end, at_start) = (meet(&first, &second), meet(&second, &first));
    if let Some(tangent) = at_end {
        let last = first.len() - 1;
        first[last].tangent_out = tangent;
        second.remove(0);
    }
    if at_start.is_some()
        && let Some(end) = second.pop()
    {
        first[0].tangent_in = end.tangent_in;
    }
    let on_first_rail = first.len();
    first.extend(second);
    close_ends(&mut first, on_first_rail, [at_start.is_some(), at_end.is_some()]);
    let loops = vec![first];
    let findings = Vec::new();
    Ok(Sampled { loops, on_first_rail: Some(on_first_rail), new_ends, findings })
}

/// How far apart two rails of as many samples are, run side by side: the sum over their samples, mm.
fn apart(first: &[Sample], second: &[Sample]) -> f64 {
    first.iter().zip(second).map(|(a, b)| a.position.distance(b.position)).sum()
}

/// The same rail, from its end to its beginning.
fn run_back(rail: &[Sample]) -> Vec<Sample> {
    let back = |s: &Sample| Sample {
        position: s.position,
        tangent_in: -s.tangent_out,
        tangent_out: -s.tangent_in,
    };
    rail.iter().rev().map(back).collect()
}

/// Where straight edges join the ends of two rails, those ends are corners of the loop.
fn close_ends(samples: &mut [Sample], on_first: usize, meeting: [bool; 2]) {
    let m = samples.len();
    for ((from, to), meeting) in
        [((m - 1, 0), meeting[0]), ((on_first - 1, on_first % m), meeting[1])]
    {
        let across = crate::math::unit(samples[to].position - samples[from].position);
        if let (false, Some(across)) = (meeting, across) {
            samples[from].tangent_out = across;
            samples[to].tangent_in = across;
        }
    }
}
