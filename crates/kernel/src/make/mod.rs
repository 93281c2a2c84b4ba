//! From a design to panels with everything that is derived from them: [`make`] and, while a design
//! is edited, [`Live`].

mod change;
mod error;
mod live;
mod meshes;
mod rebuilt;
mod specks;
mod unrestricted;

pub use change::Change;
pub use error::{MakeCause, MakeError};
pub use live::{Live, LivePanel};
pub use meshes::{
    Joint, MAX_MESH_PANELS, MadeMesh, MadeMeshes, MeshCause, MeshMakeError, MeshOptions,
    make_meshes,
};
pub use rebuilt::Rebuilt;

use crate::check::{
    Checked, Panel, check, ran_on, rounded_corner, smoothed_joints, stayed_straight, turned_round,
};
use crate::design::{Design, DesignPanel, PanelMethod, PanelShape, used};
use crate::edge::{Edge, PartEdges, edges_of_sheet, join_mates};
use crate::fair::varied_design;
use crate::flatten::{Flattened, Sheet, lay_flat};
use crate::material::Material;
use crate::measure::{Measures, measures};
use crate::pattern::{PatternOptions, Piece, piece};
use crate::sample::{PanelCause, Prepared, Sampler, matched, outline, prepare};
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::boundary::{Boundary, Outline, SupportingPlane};
use sheetwright_geometry::curve::CurveKind;
use sheetwright_geometry::watch::{Stage, Watch};
use sheetwright_optimum::cost::Prices;
use sheetwright_optimum::triangulate::{Goal, Triangulation, triangulate_near};
use unrestricted::Known;

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
    /// The edges of its sheet, in the order of the loops; mates are panels of one [`Made`].
    pub edges: Vec<Edge>,
    /// How its boundary was moved, if it was to be.
    pub change: Option<Change>,
}

/// A design with everything that was derived from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// Its name.
    pub name: String,
    /// The sheet it is made from, if one is named.
    pub material: Option<Material>,
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
        return Err(MakeError::of_design(MakeCause::NoPanels));
    }
    let varied = varied_design(design, watch)?;
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
    find_mates(&mut panels);
    let (name, material) = (design.name.clone(), design.material.clone());
    Ok(Made { name, material, panels, moved })
}

/// Looks for the mates of the edges of all panels of a design.
fn find_mates(panels: &mut [MadePanel]) {
    let parts = panels.iter_mut().map(|panel| PartEdges {
        edges: &mut panel.edges,
        space: panel.sheet.surface().positions(),
        flat: &panel.flat.points,
    });
    join_mates(&mut parts.collect::<Vec<_>>());
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
            let failed = |cause: MakeCause| MakeError::of_panel(&panel.name, cause);
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
        Err(error) if panel.run_on && error.cause != PanelCause::RunOn.into() && !watch.stop() => {
            let straight = DesignPanel { run_on: false, ..panel.clone() };
            *known = None;
            let mut made = make_as_asked(sampler, &straight, known, watch)?;
            made.checked.add(stayed_straight(&error.cause.to_string()));
            Ok(made)
        }
        made => made,
    }
}

fn make_as_asked(
    sampler: &Sampler<'_>,
    panel: &DesignPanel,
    known: &mut Option<Known>,
    watch: &mut dyn Watch,
) -> Result<MadePanel, MakeError> {
    let design = sampler.design;
    watch.begin(&[&panel.name], Stage::Sample);
    let Prepared { boundary, plane, options, sources, steps, new_ends, joined } =
        prepare(sampler, panel, watch)?;
    let outline = outline(design, &boundary, &sources);

    watch.begin(&[&panel.name], Stage::Solve);
    let before = known.as_ref().map(Known::cheapest);
    let cheapest = triangulate_near(&boundary, plane.as_ref(), &options, before, watch)
        .map_err(|e| MakeError::of_panel(&panel.name, e))?;
    let triangulation = cheapest.triangulation.clone();
    let next = Known::next(known.take(), cheapest);
    let known = known.insert(next);
    let connectivity = Connectivity::new(boundary.loops(), triangulation.triangles.clone())
        .map_err(|e| MakeError::of_panel(&panel.name, MakeCause::Surface(e)))?;
    let surface = Surface::new(connectivity, boundary.positions());

    watch.begin(&[&panel.name], Stage::Flatten);
    let (sheet, flat) = lay_flat(&surface, &panel.cut, watch)
        .map_err(|e| MakeError::of_panel(&panel.name, MakeCause::Flatten(e)))?;

    watch.begin(&[&panel.name], Stage::Check);
    let prices = Prices::new(&boundary, plane.as_ref(), options.price);
    let measures = measures(&surface, &sheet, &flat, &prices);
    let mut checked = check(&Panel {
        boundary: &boundary,
        triangulation: &triangulation,
        sheet: &sheet,
        flat: &flat,
        measures: &measures,
        material: design.material.as_ref(),
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
    if let (Some(joined), PanelShape::Join(join)) = (&joined, &panel.shape) {
        let said = smoothed_joints(joined).into_iter().chain(turned_round(joined, &join.parts));
        said.for_each(|finding| checked.add(finding));
    }
    let curve = |number: usize| design.curves[number].name.clone();
    let edges = edges_of_sheet(&sheet, &flat.points, &steps, curve);
    let piece = piece(&panel.name, &sheet, &flat, &edges, &measures, &PatternOptions::default());
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
        edges,
        change: None,
    };
    known.ask(panel, &made, options);
    Ok(made)
}
