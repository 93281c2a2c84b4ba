//! The folds of a surface that was found, which of them its boundary has itself, and the area
//! beside each of its rungs.

use crate::flatten::Flattened;
use crate::measure::Measures;
use crate::sheet::Sheet;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{angle_between, atan2, to_deg};

/// A fold is needed where the boundary turns in space by so much more or less than on the pattern,
/// degrees.
const KINK_DEG: f64 = 5.0;

/// The folds for which `is_so`, by their rungs, in increasing order.
pub(super) fn folds(measures: &Measures, is_so: impl Fn(usize) -> bool) -> Vec<usize> {
    let is_fold = |n: &usize| measures.rungs[*n].is_fold && is_so(*n);
    (0..measures.rungs.len()).filter(is_fold).collect()
}

/// A border that turns by more on the pattern has a corner there, degrees.
const CORNER_DEG: f64 = 30.0;

/// The border of a sheet in space and on its pattern.
pub(super) struct Border<'a> {
    sheet: &'a Sheet,
    flat: &'a Flattened,
    /// The loop of each vertex that lies on the border, and its place there.
    places: Vec<Option<[usize; 2]>>,
}

impl<'a> Border<'a> {
    pub(super) fn new(sheet: &'a Sheet, flat: &'a Flattened) -> Self {
        let mut places = vec![None; sheet.mesh().positions().len()];
        for (n, line) in sheet.loops().iter().enumerate() {
            for (at, vertex) in line.iter().enumerate() {
                places[vertex.get()].get_or_insert([n, at]);
            }
        }
        Self { sheet, flat, places }
    }

    /// Whether the boundary has the fold, at one of its ends at least: there the boundary turns in
    /// space by another angle than on the pattern, and by far more so than at the samples beside
    /// it. No smooth sheet does that. A corner of the pattern does not tell: its angle depends on
    /// the folds that the surface has there, whether the sheet needs them or not.
    pub(super) fn demands(&self, rung: usize) -> bool {
        self.sheet.rung_ends()[rung].into_iter().any(|end| {
            let [before, here, after] = [-1, 0, 1].map(|step| self.kink(end, step));
            let is_corner = self.turns(end, 0).is_some_and(|[_, turn]| to_deg(turn) > CORNER_DEG);
            !is_corner && here > KINK_DEG && here > 2.0 * (before + after)
        })
    }

    /// Whether the boundary follows a bend of the surface at a rung: at both ends it turns in space
    /// otherwise than on the pattern by at least half of the bend. A sheet is free to spread a bend
    /// that the boundary does not have so.
    pub(super) fn follows(&self, rung: usize, crease: f64) -> bool {
        let least_deg = 0.5 * to_deg(crease.abs());
        self.sheet.rung_ends()[rung].into_iter().all(|end| self.kink(end, 0) >= least_deg)
    }

    /// By how much the border turns in space more or less than on the pattern, degrees, at a vertex
    /// so many steps after another.
    fn kink(&self, from: VertexIndex, steps: isize) -> f64 {
        self.turns(from, steps).map_or(0.0, |[space, pattern]| to_deg((space - pattern).abs()))
    }

    /// By how much the border turns there in space and on the pattern, radians; `None` of a vertex
    /// within the sheet.
    fn turns(&self, from: VertexIndex, steps: isize) -> Option<[f64; 2]> {
        let Self { sheet, flat, places } = self;
        let [line, at] = places[from.get()]?;
        let line = &sheet.loops()[line];
        let at = at as isize + steps;
        let vertex = |n: isize| line[n.rem_euclid(line.len() as isize) as usize];
        let [a, b, c] = [at - 1, at, at + 1].map(vertex);
        let space = |v: VertexIndex| sheet.mesh().position(v);
        let point = |v: VertexIndex| flat.points[v.get()];
        let in_space = angle_between(space(b) - space(a), space(c) - space(b));
        let (came, goes) = (point(b) - point(a), point(c) - point(b));
        Some([in_space, atan2(came.perp_dot(goes).abs(), came.dot(goes))])
    }
}

/// The area beside every rung, mm².
pub(super) fn weights(sheet: &Sheet) -> Vec<f64> {
    let mesh = sheet.mesh();
    let area = |t: TriangleIndex| mesh.area_vector(t).length();
    let beside = |&[a, b]: &[VertexIndex; 2]| -> f64 {
        let edge = mesh.topology().edge_between(a, b).map(|n| &mesh.edges()[n]);
        edge.map_or(0.0, |edge| edge.triangles.iter().flatten().map(|&t| area(t)).sum())
    };
    sheet.rung_ends().iter().map(beside).collect()
}
