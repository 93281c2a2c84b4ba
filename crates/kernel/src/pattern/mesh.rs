//! The pattern of a mesh that was laid flat: its outline and holes, its sharp creases to score, the
//! marks of its seams. Sides of triangles are nothing to a workshop and are not drawn.

use super::edge_names;
use super::seam::{Side, seam_mark};
use super::{LABEL_SHARE, PathKind, PatternPath, Piece, Role, TICK_SHARE, dimension, label_at};
use crate::edge::Edge;
use crate::mesh::{Mesh, MeshSeam, crease_angles};
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Vec2, from_deg};
use sheetwright_geometry::predicate::{Box2, signed_area_doubled};
use std::collections::BTreeMap;

/// Creases above this angle, degrees, are scored: below it they may be the facets that a smooth
/// bend was divided into; a circle has as much of a turn at each of fourteen sides.
pub const SCORED_CREASE_DEG: f64 = 25.0;

/// A side of a seam that is to be marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EdgeMark {
    /// The mark: the same on both sides.
    pub mark: String,
    /// The sides of triangles that it runs along, by vertices of the sheet, which lies to their
    /// left.
    pub steps: Vec<[VertexIndex; 2]>,
    /// Whether it says how long the seam is.
    pub first: bool,
}

/// The marks of the seams along which a sheet is cut.
pub fn seam_marks(seams: &[MeshSeam]) -> Vec<EdgeMark> {
    let of_seam = |(n, seam): (usize, &MeshSeam)| {
        let [left, right] = &seam.sides;
        let left = left.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        // The sheet lies to the right of the second side.
        let right = right.windows(2).rev().map(|pair| [pair[1], pair[0]]).collect();
        let marked = |first: bool, steps| EdgeMark { mark: seam_mark(n), steps, first };
        [marked(true, left), marked(false, right)]
    };
    seams.iter().enumerate().flat_map(of_seam).collect()
}

/// The pattern of a mesh of one piece with these edges. `points` are where its vertices lie when it
/// is flat, mm.
pub fn mesh_piece(
    name: &str,
    sheet: &Mesh,
    points: &[Point2],
    edges: &[Edge],
    marks: &[EdgeMark],
) -> Piece {
    let at = |v: VertexIndex| points[v.get()];
    let mut loops: Vec<Vec<Point2>> =
        sheet.loops().iter().map(|list| list.iter().map(|&v| at(v)).collect()).collect();
    // The outline holds all others, so that it encloses most.
    loops.sort_by(|a, b| signed_area_doubled(b).abs().total_cmp(&signed_area_doubled(a).abs()));
    let mut paths: Vec<PatternPath> = Vec::new();
    for points in loops {
        let kind = if paths.is_empty() { PathKind::Outline } else { PathKind::Hole };
        paths.push(PatternPath { role: Role::Cut, kind, points, closed: true });
    }
    let outline = paths.first().map_or(&[][..], |path| &path.points);
    let size = Box2::of_points(outline.iter().copied())
        .map_or(Vec2::ZERO, |around| around.max - Point2::default());
    let shorter = size.x.min(size.y);
    let height_mm = (LABEL_SHARE * shorter).clamp(2.0, 25.0);
    let tick_mm = (TICK_SHARE * shorter).clamp(2.0, 10.0);
    paths.extend(creases(sheet).into_iter().map(|chain| PatternPath {
        role: Role::Score,
        kind: PathKind::Crease,
        points: chain.into_iter().map(at).collect(),
        closed: false,
    }));

    let border: Vec<[Point2; 2]> =
        sheet.edges().iter().filter(|edge| edge.is_border()).map(|e| e.ends.map(at)).collect();
    let middles: Vec<Point2> = sheet
        .triangles()
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(at);
            a + ((b - a) + (c - a)) / 3.0
        })
        .collect();
    let mut labels = vec![label_at(name, &middles, &border, height_mm)];
    for EdgeMark { mark, steps, first } in marks {
        let Some((step, share, length_mm)) = middle(sheet, steps) else { continue };
        let [from, to] = steps[step].map(at);
        let side = Side { mark: mark.clone(), first: *first, length_mm, from, to };
        let (tick, texts) = side.marks(from.lerp(to, share), tick_mm, height_mm);
        paths.push(tick);
        labels.extend(texts);
    }
    labels.extend(edge_names::labels(edges, points, tick_mm, height_mm));
    let (dimension_paths, dimension_labels) = dimension::overall(size, height_mm);
    paths.extend(dimension_paths);
    labels.extend(dimension_labels);
    Piece { name: name.to_owned(), paths, labels, size }
}

/// The middle of a way along sides in space: the step on which it lies, how much of the step comes
/// before it, and the length of the whole, mm. `None` for no way.
fn middle(sheet: &Mesh, steps: &[[VertexIndex; 2]]) -> Option<(usize, f64, f64)> {
    let length = |n: usize| sheet.position(steps[n][0]).distance(sheet.position(steps[n][1]));
    let whole: f64 = (0..steps.len()).map(length).sum();
    let mut left = 0.5 * whole;
    for n in 0..steps.len() {
        if left <= length(n) {
            return Some((n, left / length(n), whole));
        }
        left -= length(n);
    }
    // Rounding may leave a little.
    steps.len().checked_sub(1).map(|last| (last, 1.0, whole))
}

/// The sharp creases as ways along sides, each as long as can be without branching.
fn creases(sheet: &Mesh) -> Vec<Vec<VertexIndex>> {
    let angles = crease_angles(sheet);
    let sharp: Vec<usize> =
        (0..angles.len()).filter(|&n| angles[n] > from_deg(SCORED_CREASE_DEG)).collect();
    let mut at: BTreeMap<VertexIndex, Vec<usize>> = BTreeMap::new();
    for &n in &sharp {
        sheet.edges()[n].ends.iter().for_each(|&end| at.entry(end).or_default().push(n));
    }
    let goes_on = |v: VertexIndex| at.get(&v).is_some_and(|list| list.len() == 2);
    let mut used = vec![false; angles.len()];
    let mut chains = Vec::new();
    // Those that have ends first; what is left runs in rings.
    for ends_only in [true, false] {
        for &n in &sharp {
            for [start, next] in [sheet.edges()[n].ends, {
                let [a, b] = sheet.edges()[n].ends;
                [b, a]
            }] {
                if used[n] || (ends_only && goes_on(start)) {
                    continue;
                }
                used[n] = true;
                let mut chain = vec![start, next];
                let mut to = next;
                while goes_on(to) {
                    let Some(&n) = at[&to].iter().find(|&&n| !used[n]) else { break };
                    used[n] = true;
                    let [a, b] = sheet.edges()[n].ends;
                    to = if a == to { b } else { a };
                    chain.push(to);
                }
                chains.push(chain);
            }
        }
    }
    chains
}
