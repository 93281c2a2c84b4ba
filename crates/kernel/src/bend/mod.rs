//! Bend lines: where a sheet is bent by hand or at a press brake, in place of the many rulings of
//! its surface.
//!
//! A sheet without vertices inside is a tree of triangles, joined at rungs. `strip` takes strips
//! from it, the one that bends most first: rows of triangles whose rungs run from a left side to a
//! right one. A strip is divided at its folds. Along each run between them, the tangent plane turns
//! by the creases of the rungs, and `rail` knows for both sides how far it has turned at each place
//! of the border. One line of the smooth surface, a ruling, is where both sides have turned equally
//! far: single rungs are none, since they end at samples. `divide` cuts the turn into steps, and
//! the bend line of a step is the ruling at which half of its turn is done. So a bend of a step's
//! angle along each line in turn gives a row of flat facets that touch the smooth surface between
//! the lines (\[PGSRL\] for cylinders; for rulings that are not parallel we know of no source).

mod divide;
mod fold;
mod fold_lines;
mod neutral;
mod plan;
mod plane_edges;
mod rail;
mod rounded;
mod strip;
mod tool;

pub use fold::FOLDED_DEG;
pub use fold_lines::Mitred;
pub use plan::{Blank, Brake, BrakeFault, DIE_THICKNESSES, Hit, LEAST_SHARE, Reference, hits};

pub(crate) use fold::fold_counts;
pub(crate) use neutral::{bends_up, k_factor, neutral_surface};
pub(crate) use plane_edges::plane_edges;
pub(crate) use rounded::{Rounded, rounded};
pub(crate) use tool::FoldTool;

use crate::design::Bends;
use crate::flatten::Flattened;
use crate::measure::{Measures, RungMeasures};
use crate::mesh::{Mesh, MeshEdge, SCORED_CREASE_DEG, scored_creases};
use crate::sheet::Sheet;
use divide::divided;
use fold::{FoldLine, folds};
use rail::{Corners, Rail, rails};
use sheetwright_geometry::math::{Point2, from_deg};
use strip::{Strip, strips};

/// Turns up to this angle, degrees, are no bends: a hand does not feel them, and sampling makes
/// such ones where there are none.
pub const LEAST_BEND_DEG: f64 = 1.0;

/// A line along which a sheet is bent.
#[derive(Clone, Debug, PartialEq)]
pub struct BendLine {
    /// Its strip, from 0: lines of one strip follow one another.
    pub strip: usize,
    /// Whether it is a sharp fold of the surface; else it is a step of a smooth bend.
    pub is_fold: bool,
    /// Its ends on the pattern, mm: the left one and the right one as seen along the strip.
    pub ends: [Point2; 2],
    /// The angle that the sheet is bent by along it, radians, positive for a mountain: down, away
    /// from the side that the pattern is seen from.
    pub angle: f64,
    /// The inner radius of the tool that makes it, mm, where it is a fold and the flat sheet has
    /// the bend allowance of that tool.
    pub inside_radius_mm: Option<f64>,
    /// How wide its step is at both ends, across the line, mm; 0 of a fold and in an apex.
    pub pitch_mm: [f64; 2],
    /// How far both ends lie from the beginning of the strip along its sides, mm.
    pub along_mm: [f64; 2],
    /// How far the sheet reaches beyond it, mm, before the first line of a strip and behind its
    /// last: at the end of the strip that comes nearer.
    pub beyond_mm: [Option<f64>; 2],
}

impl BendLine {
    /// Whether the sheet beside it is bent up, towards the viewer of the pattern.
    pub fn is_up(&self) -> bool {
        self.angle < 0.0
    }

    /// The radius of the bend at both ends, mm: the width of its step over its angle; 0 of a fold.
    pub fn radius_mm(&self) -> [f64; 2] {
        self.pitch_mm.map(|pitch| pitch / self.angle.abs())
    }

    /// How long it is, mm.
    pub fn length_mm(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }

    /// The distance of a point from the whole straight line, mm, positive to its left.
    pub fn side_mm(&self, point: Point2) -> f64 {
        let along = self.ends[1] - self.ends[0];
        along.perp_dot(point - self.ends[0]) / along.length()
    }
}

/// The bend lines of a sheet, strip after strip, each from its beginning on. A mesh with vertices
/// inside has no rulings, so only its folds are lines, as are those of the net that `is_net` says
/// it is a piece of.
pub(crate) fn bend_lines(
    sheet: &Sheet,
    flat: &Flattened,
    measures: &Measures,
    bends: &Bends,
    is_net: bool,
) -> Vec<BendLine> {
    let mesh = sheet.mesh();
    let on_border: usize = mesh.loops().iter().map(Vec::len).sum();
    if is_net || on_border != mesh.positions().len() {
        let least_deg = if is_net { FOLDED_DEG } else { SCORED_CREASE_DEG };
        let folds = folds(sheet, &flat.points, from_deg(least_deg));
        let line = |(strip, fold): (usize, FoldLine)| BendLine {
            strip,
            is_fold: true,
            ends: fold.ends,
            angle: fold.crease,
            inside_radius_mm: inside_radius_mm(sheet, &fold.sides),
            pitch_mm: [0.0; 2],
            along_mm: [0.0; 2],
            beyond_mm: [None; 2],
        };
        return folds.into_iter().enumerate().map(line).collect();
    }
    let is_fold = folded_edges(sheet, &measures.rungs);
    let strips = strips(mesh);
    let corners = Corners::of(sheet, measures);
    let laid = Laid { sheet, mesh, flat: &flat.points, corners: &corners, is_fold: &is_fold };
    let runs: Vec<Vec<Run>> = strips.iter().map(|strip| runs(strip, &laid)).collect();
    let of_runs: Vec<&Run> = runs.iter().flatten().collect();
    let mut divided = divided(&of_runs, bends.rule).into_iter();
    let mut lines = Vec::new();
    for (number, (strip, runs)) in strips.iter().zip(&runs).enumerate() {
        let first = lines.len();
        for run in runs {
            lines.extend(divided.next().into_iter().flatten());
            lines.extend(run.fold_after.clone());
        }
        let of_strip = &mut lines[first..];
        of_strip.iter_mut().for_each(|line: &mut BendLine| line.strip = number);
        note_beyond(of_strip, strip, &laid);
    }
    lines
}

/// Everything that strips are laid out by.
struct Laid<'a> {
    sheet: &'a Sheet,
    mesh: &'a Mesh,
    flat: &'a [Point2],
    corners: &'a Corners,
    /// Whether the sheet is folded at each side of the mesh.
    is_fold: &'a [bool],
}

/// A stretch of a strip without a fold.
struct Run {
    /// Its left and its right side.
    rails: [Rail; 2],
    /// By how much each triangle of the strip is turned against the first of the run, radians.
    turns: Vec<f64>,
    /// Whether the smooth bend goes on to the beginning and the end of the run.
    goes_on: [bool; 2],
    /// The fold that ends it.
    fold_after: Option<BendLine>,
}

/// The stretches of a strip between its folds.
fn runs(strip: &Strip, laid: &Laid<'_>) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut first = 0;
    let mut along_mm = [0.0; 2];
    for last in 0..strip.triangles.len() {
        let fold = strip.rungs.get(last).filter(|&&edge| laid.is_fold[edge]);
        if fold.is_none() && last + 1 < strip.triangles.len() {
            continue;
        }
        let range = first..last + 1;
        let rails = rails(strip, &range, laid, along_mm);
        along_mm = [0, 1].map(|n| rails[n].length_mm());
        let fold_after = fold.map(|&edge| BendLine {
            strip: 0,
            is_fold: true,
            ends: strip.ends[last].map(|v| laid.flat[v.get()]),
            angle: crease(laid.mesh, &laid.mesh.edges()[edge]),
            inside_radius_mm: inside_radius_mm(laid.sheet, &[edge]),
            pitch_mm: [0.0; 2],
            along_mm,
            beyond_mm: [None; 2],
        });
        let goes_on = [first == 0 && !strip.starts_inside, fold.is_none()];
        let turns = strip.turns(&range, laid.mesh);
        runs.push(Run { rails, turns, goes_on, fold_after });
        first = last + 1;
    }
    runs
}

/// The inner radius of the tool that makes a fold along these sides, if one makes all of them.
fn inside_radius_mm(sheet: &Sheet, sides: &[usize]) -> Option<f64> {
    let radii = sides.iter().map(|&side| sheet.fold_radius_mm(side));
    radii.reduce(|a, b| a.zip(b).map(|(a, _)| a)).flatten()
}

/// The crease at a side, radians; 0 on the border.
pub(crate) fn crease(mesh: &Mesh, edge: &MeshEdge) -> f64 {
    match edge.triangles {
        [Some(a), Some(b)] => mesh.crease(edge.ends, [a, b]),
        _ => 0.0,
    }
}

/// Whether the sheet is folded at each side of its mesh: where the surface was found, at the folds
/// that were measured; of a mesh, where it is scored.
pub(crate) fn folded_edges(sheet: &Sheet, rungs: &[RungMeasures]) -> Vec<bool> {
    let edges = sheet.mesh().edges();
    if !sheet.has_rungs() {
        return scored_creases(sheet.mesh()).into_iter().map(|turn| turn > 0.0).collect();
    }
    let measured = sheet.rung_ends().iter().zip(rungs);
    let mut folds: Vec<_> = measured
        .filter(|(_, rung)| rung.is_fold)
        .map(|(&[a, b], _)| if a < b { [a, b] } else { [b, a] })
        .collect();
    folds.sort_unstable();
    edges.iter().map(|edge| folds.binary_search(&edge.ends).is_ok()).collect()
}

/// Notes how far the sheet reaches beyond the first and the last line of a strip.
fn note_beyond(lines: &mut [BendLine], strip: &Strip, laid: &Laid<'_>) {
    let reach = |line: &BendLine, ends: [_; 2]| {
        let [a, b] = ends.map(|v: sheetwright_geometry::index::VertexIndex| {
            line.side_mm(laid.flat[v.get()]).abs()
        });
        a.min(b)
    };
    let [start, end] = strip::tips(strip, laid);
    if let Some(line) = lines.first_mut() {
        line.beyond_mm[0] = start.map(|ends| reach(line, ends));
    }
    if let Some(line) = lines.last_mut() {
        line.beyond_mm[1] = end.map(|ends| reach(line, ends));
    }
}
