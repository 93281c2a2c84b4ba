//! The folds of a sheet whose triangles are given: sharp creases, each as long as it goes straight
//! on.

use super::crease;
use crate::mesh::MeshEdge;
use crate::sheet::Sheet;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, from_deg, unit2};
use std::collections::BTreeMap;

/// Creases up to this angle, degrees, are no folds of a net: paper does not tell them from a plane,
/// and faces of more than three corners, whose corners a modeller's numbers put a little off their
/// plane, stay whole.
pub const FOLDED_DEG: f64 = 1.0;
/// A fold goes straight on where it turns by less than this on the pattern, as the sine.
const STRAIGHT: f64 = 1e-3;
/// Two stretches of one fold differ by less than this, radians.
const ONE_FOLD: f64 = 1e-3;

/// A fold on the pattern.
pub(crate) struct FoldLine {
    /// Its ends, mm.
    pub(crate) ends: [Point2; 2],
    /// Radians, positive for a mountain.
    pub(crate) crease: f64,
    /// Its sides of the mesh.
    pub(crate) sides: Vec<usize>,
}

/// The folds of a sheet above this angle, radians, each as long as it goes straight on.
pub(crate) fn folds(sheet: &Sheet, flat: &[Point2], least: f64) -> Vec<FoldLine> {
    let edges = sheet.mesh().edges();
    let of_edge = |edge: &MeshEdge| {
        let crease = crease(sheet.mesh(), edge);
        (crease.abs() > least && !sheet.is_within_face(edge)).then_some(crease)
    };
    let creases: Vec<Option<f64>> = edges.iter().map(of_edge).collect();
    let mut at: BTreeMap<VertexIndex, Vec<usize>> = BTreeMap::new();
    for (n, edge) in edges.iter().enumerate().filter(|&(n, _)| creases[n].is_some()) {
        edge.ends.iter().for_each(|&end| at.entry(end).or_default().push(n));
    }
    let far = |n: usize, from: VertexIndex| {
        let [a, b] = edges[n].ends;
        if a == from { b } else { a }
    };
    let on = |n: usize, via: VertexIndex| -> Option<usize> {
        let way = |n: usize| unit2(flat[far(n, via).get()] - flat[via.get()]);
        let before = way(n)?;
        let goes_on = |&&next: &&usize| {
            let turns = way(next).is_none_or(|next| {
                next.dot(before) > 0.0 || next.perp_dot(before).abs() > STRAIGHT
            });
            let differs = |a: f64, b: f64| (a - b).abs() > ONE_FOLD;
            let is_other = creases[n].zip(creases[next]).is_none_or(|(a, b)| differs(a, b));
            next != n && !turns && !is_other
        };
        at.get(&via)?.iter().find(goes_on).copied()
    };
    let mut used = vec![false; edges.len()];
    let mut folds = Vec::new();
    for n in 0..edges.len() {
        let Some(crease) = creases[n].filter(|_| !used[n]) else { continue };
        used[n] = true;
        let mut sides = vec![n];
        let ends = edges[n].ends.map(|start| {
            let (mut side, mut end) = (n, start);
            while let Some(next) = on(side, end).filter(|&next| !used[next]) {
                used[next] = true;
                sides.push(next);
                (side, end) = (next, far(next, end));
            }
            flat[end.get()]
        });
        folds.push(FoldLine { ends, crease, sides });
    }
    folds
}

/// How many folds of a net are mountains and how many valleys, and the sharpest of them, radians.
pub(crate) fn fold_counts(sheet: &Sheet, flat: &[Point2]) -> ([usize; 2], f64) {
    let folds = folds(sheet, flat, from_deg(FOLDED_DEG));
    let mountains = folds.iter().filter(|fold| fold.crease > 0.0).count();
    let sharpest = folds.iter().map(|fold| fold.crease.abs()).fold(0.0, f64::max);
    ([mountains, folds.len() - mountains], sharpest)
}
