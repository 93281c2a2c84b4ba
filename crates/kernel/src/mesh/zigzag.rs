//! The creases of a twisted strip in one row of triangles, which are no folds.
//!
//! One row of triangles between two rails samples a surface by its border alone. Where that is
//! twisted, the row turns one way at a side and back at the next, by as much as the surface twists
//! across the strip: however many triangles there are, the creases stay. They run to and fro
//! between the rails as one zigzag, mountain and valley in turn. Folds that are meant lie side by
//! side, meet in a point or turn the same way.

use super::Mesh;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::from_deg;
use std::collections::BTreeMap;

/// A zigzag has so many creases at least: what is folded by hand, fewer.
const LEAST_COUNT: usize = 8;
/// Creases of a zigzag turn by so much at the most, degrees: what twists by more across its width
/// is no sheet.
const MOST_DEG: f64 = 60.0;
/// One crease of a zigzag turns by so many times the next at the most.
const ALIKE: f64 = 2.0;
/// Sides that turn by less than this share of a crease are flat beside it, as where the row is of
/// flat cells whose diagonals alone are creases, or the other way round.
const FLAT_SHARE: f64 = 0.3;
/// Most flat sides between two creases of a zigzag.
const MOST_FLAT: usize = 3;

/// Whether each side of a mesh is a crease of a zigzag; none is of a mesh that has vertices inside
/// its border.
pub(super) fn of_zigzags(mesh: &Mesh) -> Vec<bool> {
    let edges = mesh.edges();
    if mesh.topology().on_border().contains(&false) {
        return vec![false; edges.len()];
    }
    let crease = |n: usize| match edges[n].triangles {
        [Some(a), Some(b)] => mesh.crease(edges[n].ends, [a, b]),
        _ => 0.0,
    };
    let creases: Vec<f64> = (0..edges.len()).map(crease).collect();
    let mut runs = DisjointSets::new(edges.len());
    for n in 0..edges.len() {
        let links = edges[n].triangles.map(|t| linked(mesh, &creases, n, t?));
        // To and fro: the next crease on one side starts where the one on the other does not.
        let ends = links.iter().flatten().map(|link| link.1).collect::<Vec<_>>();
        if ends.len() < 2 || ends[0] != ends[1] {
            links.iter().flatten().for_each(|link| _ = runs.join(n, link.0));
        }
    }
    let runs = runs.all_first();
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    runs.iter().for_each(|&run| *counts.entry(run).or_default() += 1);
    runs.iter().map(|run| counts[run] >= LEAST_COUNT).collect()
}

/// The next crease of the zigzag of a side, across one of its triangles, and which end of the side
/// both share.
fn linked(
    mesh: &Mesh,
    creases: &[f64],
    side: usize,
    mut via: TriangleIndex,
) -> Option<(usize, usize)> {
    let edges = mesh.edges();
    let turn = creases[side];
    if turn == 0.0 || turn.abs() > from_deg(MOST_DEG) {
        return None;
    }
    let mut from = side;
    for _ in 0..=MOST_FLAT {
        let others = mesh.topology().edges_of(via);
        let mut inner = others.iter().filter(|&&n| n != from && !edges[n].is_border());
        let next = *inner.next()?;
        if inner.next().is_some() {
            return None;
        }
        if creases[next].abs() >= FLAT_SHARE * turn.abs() {
            let ratio = -creases[next] / turn;
            let shared = edges[side].ends.iter().position(|end| edges[next].ends.contains(end))?;
            let is_alike = (1.0 / ALIKE..=ALIKE).contains(&ratio);
            return is_alike.then_some((next, shared));
        }
        let [a, b] = edges[next].triangles;
        via = if a == Some(via) { b? } else { a? };
        from = next;
    }
    None
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // tests panic
mod tests {
    use super::*;
    use crate::mesh::MeshEdge;
    use sheetwright_geometry::index::VertexIndex;
    use sheetwright_geometry::math::{Point3, cos, sin};

    /// A row of cells between two rails, with the diagonal of each by its number.
    fn row(count: usize, diagonal: fn(usize) -> bool, at: impl Fn(f64, f64) -> Point3) -> Mesh {
        let place = |k: usize| at((k / 2) as f64 / count as f64, (k % 2) as f64);
        let cell = |n: usize| {
            let [a, b, c, d] = [2 * n, 2 * n + 2, 2 * n + 3, 2 * n + 1].map(VertexIndex::new);
            if diagonal(n) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
        };
        let triangles = (0..count).flat_map(cell).collect();
        Mesh::new((0..2 * count + 2).map(place).collect(), triangles).unwrap()
    }

    /// How many creases of more than 25° are left to be scored.
    fn scored(mesh: &Mesh) -> usize {
        let is_sharp = |side: &MeshEdge| match side.triangles {
            [Some(a), Some(b)] => mesh.crease(side.ends, [a, b]).abs() > from_deg(25.0),
            _ => false,
        };
        mesh.edges().iter().zip(of_zigzags(mesh)).filter(|(side, of)| is_sharp(side) && !of).count()
    }

    #[test]
    fn a_twisted_row_has_no_folds_however_it_was_divided() {
        for deg in [90.0, 120.0, 180.0] {
            let at = |along: f64, across: f64| {
                let (turn, side) = (from_deg(deg) * along, 300.0 * (across - 0.5));
                Point3::new(1000.0 * along, side * cos(turn), side * sin(turn))
            };
            for count in [12, 40, 160] {
                for diagonal in [|_| true, |_| false, |n| n % 2 == 0] as [fn(usize) -> bool; 3] {
                    assert_eq!(scored(&row(count, diagonal, at)), 0, "{deg} {count}");
                }
            }
        }
    }

    #[test]
    fn folds_side_by_side_round_a_point_or_one_way_are_folds() {
        // An accordion.
        let zigzag = |along: f64, across: f64| {
            let n = (12.0 * along).round();
            Point3::new(30.0 * n, 200.0 * across, if n % 2.0 == 0.0 { 0.0 } else { 10.0 })
        };
        assert_eq!(scored(&row(12, |_| true, zigzag)), 11);
        // A ring of triangles, all of whose folds are mountains, less one of them.
        let antiprism = |along: f64, across: f64| {
            let turn = from_deg(300.0) * (along + 0.5 * across / 5.0);
            Point3::new(100.0 * cos(turn), 100.0 * sin(turn), 55.0 * across)
        };
        assert_eq!(scored(&row(5, |_| false, antiprism)), 9);
        // A fan whose folds meet nearly in a point.
        let fan = |along: f64, across: f64| {
            let n = (12.0 * along).round();
            let (turn, far) = (from_deg(15.0) * n, 1.0 + 200.0 * across);
            let up = if n % 2.0 == 0.0 { 0.0 } else { 0.1 * far };
            Point3::new(far * cos(turn), far * sin(turn), up)
        };
        assert_eq!(scored(&row(12, |_| true, fan)), 11);
        // A few folds to and fro are meant.
        let few = |along: f64, across: f64| {
            let turn = from_deg(30.0) * along;
            let side = 300.0 * (across - 0.5);
            Point3::new(300.0 * along, side * cos(turn), side * sin(turn))
        };
        assert_eq!(scored(&row(3, |_| true, few)), 5);
    }
}
