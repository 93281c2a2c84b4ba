//! The folds of a net: mountains and valleys, with their angles.

use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use crate::mesh::{Mesh, MeshEdge};
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Vec2, from_deg, to_deg, unit2};
use std::collections::BTreeMap;

/// Creases up to this angle, degrees, are no folds: paper does not tell them from a plane, and
/// faces of more than three corners, whose corners a modeller's numbers put a little off their
/// plane, stay whole.
pub const FOLDED_DEG: f64 = 1.0;
/// A fold goes straight on where it turns by less than this on the pattern, as the sine.
const STRAIGHT: f64 = 1e-3;
/// Two stretches of one fold differ by less than this, radians.
const ONE_FOLD: f64 = 1e-3;
/// Angles below it, degrees, are not written: a hand can't fold so finely.
const WRITTEN_DEG: f64 = 5.0;
/// Letters of an angle are as high as those of the piece times this, at the most.
const BESIDE_NAME: f64 = 0.3;
/// Letters are as high as this share of the fold, at the most.
const ALONG: f64 = 0.12;
/// Lower letters can't be read.
const LEAST_MM: f64 = 1.5;

/// A fold on the pattern.
pub(super) struct Fold {
    ends: [Point2; 2],
    /// Radians, positive for a mountain.
    crease: f64,
}

/// The crease at a side that is folded, radians; `None` of one that is flat or on the border.
pub(super) fn fold_at(mesh: &Mesh, edge: &MeshEdge) -> Option<f64> {
    let [Some(a), Some(b)] = edge.triangles else { return None };
    let crease = mesh.crease(edge.ends, [a, b]);
    (crease.abs() > from_deg(FOLDED_DEG)).then_some(crease)
}

/// The folds of a sheet, each as long as it goes straight on.
pub(super) fn folds(sheet: &Mesh, flat: &[Point2]) -> Vec<Fold> {
    let edges = sheet.edges();
    let creases: Vec<Option<f64>> = edges.iter().map(|edge| fold_at(sheet, edge)).collect();
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
        let ends = edges[n].ends.map(|start| {
            let (mut side, mut end) = (n, start);
            while let Some(next) = on(side, end).filter(|&next| !used[next]) {
                used[next] = true;
                (side, end) = (next, far(next, end));
            }
            flat[end.get()]
        });
        folds.push(Fold { ends, crease });
    }
    folds
}

/// How many folds of a sheet are mountains, and how many valleys.
pub(crate) fn fold_counts(sheet: &Mesh, flat: &[Point2]) -> [usize; 2] {
    let folds = folds(sheet, flat);
    let mountains = folds.iter().filter(|fold| fold.crease > 0.0).count();
    [mountains, folds.len() - mountains]
}

impl Fold {
    pub(super) fn path(&self) -> PatternPath {
        PatternPath {
            role: Role::Score,
            kind: PathKind::Fold { mountain: self.crease > 0.0 },
            points: self.ends.to_vec(),
            closed: false,
        }
    }

    /// Its angle beside its middle, upright as far as it can; `None` where there is no room.
    pub(super) fn label(&self, height_mm: f64) -> Option<PatternLabel> {
        let [from, to] = self.ends;
        let height_mm = (BESIDE_NAME * height_mm).min(ALONG * from.distance(to));
        let is_written = height_mm >= LEAST_MM && to_deg(self.crease.abs()) >= WRITTEN_DEG;
        let way = unit2(to - from).filter(|_| is_written)?;
        let along = if way.x > 0.0 || (way.x == 0.0 && way.y > 0.0) { way } else { -way };
        let beside: Vec2 = along.perp() * (0.4 * height_mm);
        Some(PatternLabel {
            kind: LabelKind::Angle,
            role: Role::Note,
            at: from.lerp(to, 0.5) + beside,
            along,
            height_mm,
            text: format!("{:.0}°", to_deg(self.crease.abs())),
        })
    }
}
