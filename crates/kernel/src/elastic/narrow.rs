//! Bends that are narrower than the triangles of a net, as those of a bracket.
//!
//! A triangle that lies across a whole bend is no measure of its strain. But such a bend is a small
//! part of a sheet, and developable: it is bent to its radius and strained by nothing else. So the
//! sheet is held at each of its rulings, as at folds, where the surface has them; what is computed
//! is the sheet beside it. How tightly it is bent decides as any curvature does, however little of
//! the area it is. That is said only of bends that the boundary itself follows: others the cheapest
//! surface has, and a sheet spreads them.

use super::ElasticOptions;
use super::folds::{Border, weights};
use super::rolled::is_developable;
use crate::flatten::Flattened;
use crate::material::Limits;
use crate::measure::{Measures, RungMeasures};
use crate::sheet::Sheet;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::from_deg;

/// A bend is narrow if it would turn by more than this within the length of a side of the net, and
/// does so in all, radians.
const TURN: f64 = 0.35;
/// Turns up to this angle, degrees, tell no bend: those of narrow triangles are rounding.
const LEAST_DEG: f64 = 1.0;
/// Narrow bends take up to this share of the area. What is bent all over is a tube, not a bracket.
const MOST: f64 = 0.25;
/// A line across the sheet is at least as long as so many sides. Shorter ones cut off its tips.
const LEAST_SIDES: f64 = 3.0;
/// A bend as wide as so many sides is told by the net.
const MOST_SIDES: f64 = 3.5;

/// A line across a sheet at which it turns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// The angle, radians.
    pub(super) angle: f64,
    /// Its length, mm.
    pub(super) length_mm: f64,
    /// The area of both triangles beside it, mm².
    pub(super) area_mm2: f64,
    /// Its place along the sheet: those of neighbours differ by one or two.
    pub(super) place: usize,
    /// The angle by which the sheet is twisted along it, radians.
    pub(super) warp: f64,
    /// Whether the sheet is folded there.
    pub(super) is_fold: bool,
}

impl Turn {
    /// The curvature across it, 1/mm: the angle over half of the width of both triangles.
    pub(super) fn curvature(&self) -> f64 {
        self.angle * self.length_mm / self.area_mm2
    }
}

/// Whether a sheet of this area, mm², whose bends are this tight, 1/mm, is bent more tightly than
/// its net can follow.
pub(super) fn is_beyond_net(curvature: f64, area_mm2: f64) -> bool {
    curvature * side_mm(area_mm2) > TURN
}

/// The length of a side of a net over this area, mm².
fn side_mm(area_mm2: f64) -> f64 {
    (area_mm2 / ElasticOptions::default().triangles as f64).sqrt()
}

/// The numbers of those turns of a sheet of this area, mm², at which it is bent tightly, not
/// twisted nor folded, in increasing order; none if they take much of it. Without a material
/// nothing says how tightly it may be bent, and there are none.
pub(super) fn tight(turns: &[Turn], area_mm2: f64, limits: &Limits) -> Vec<usize> {
    if limits.outer_fibre.is_none() {
        return Vec::new();
    }
    let side_mm = side_mm(area_mm2);
    let is_tight = |turn: &Turn| {
        let is_bent = !turn.is_fold && is_developable(limits, turn.warp * turn.warp);
        is_bent && turn.angle > from_deg(LEAST_DEG) && turn.curvature() * side_mm > TURN
    };
    let found: Vec<usize> = (0..turns.len()).filter(|&n| is_tight(&turns[n])).collect();
    let taken: f64 = found.iter().map(|&n| turns[n].area_mm2).sum();
    if taken <= MOST * area_mm2 { found } else { Vec::new() }
}

/// Those of them that belong to narrow bends, where each is a line from border to border; in
/// increasing order.
pub(super) fn narrow(turns: &[Turn], area_mm2: f64, limits: &Limits) -> Vec<usize> {
    let side_mm = side_mm(area_mm2);
    let mut tight = tight(turns, area_mm2, limits);
    tight.retain(|&n| turns[n].length_mm >= LEAST_SIDES * side_mm);
    tight.sort_by_key(|&n| turns[n].place);
    let is_narrow = |bend: &&[usize]| {
        let width = |&n: &usize| turns[n].area_mm2 / turns[n].length_mm;
        let angle: f64 = bend.iter().map(|&n| turns[n].angle).sum();
        bend.iter().map(width).sum::<f64>() <= MOST_SIDES * side_mm && angle > TURN
    };
    // Between two of them, the diagonal of a flat cell may lie.
    let bends = tight.chunk_by(|&one, &next| turns[next].place - turns[one].place <= 2);
    let mut found: Vec<usize> = bends.filter(is_narrow).flatten().copied().collect();
    found.sort_unstable();
    found
}

/// The tightest curvature of those turns, 1/mm; 0 of none.
pub(super) fn tightest(turns: &[Turn], narrow: &[usize]) -> f64 {
    narrow.iter().map(|&n| turns[n].curvature()).fold(0.0, f64::max)
}

/// A rung as it was measured, and its ends.
type Rung<'a> = (&'a RungMeasures, &'a [VertexIndex; 2]);

/// The rungs of the narrow bends of a sheet, and their tightest curvature, 1/mm; 0 of none.
pub(super) fn narrow_rungs(
    sheet: &Sheet,
    flat: &Flattened,
    measures: &Measures,
    limits: &Limits,
) -> (Vec<usize>, f64) {
    let turn = |(place, ((rung, ends), area_mm2)): (usize, (Rung<'_>, f64))| {
        let [a, b] = ends.map(|v| flat.points[v.get()]);
        Turn {
            angle: rung.crease.abs(),
            length_mm: a.distance(b),
            area_mm2,
            place,
            warp: rung.warp_of_surface(),
            is_fold: rung.is_fold,
        }
    };
    let rungs = measures.rungs.iter().zip(sheet.rung_ends());
    let turns: Vec<Turn> = rungs.zip(weights(sheet)).enumerate().map(turn).collect();
    let border = Border::new(sheet, flat);
    let mut narrow = narrow(&turns, measures.area_flat_mm2, limits);
    narrow.retain(|&n| border.follows(n, measures.rungs[n].crease));
    let tightest = tightest(&turns, &narrow);
    (narrow, tightest)
}
