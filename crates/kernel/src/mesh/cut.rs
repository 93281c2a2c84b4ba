//! Cuts that let a mesh lie flat: along its sides, along the shortest ways there are.
//!
//! 1. A ring, a tube or a torus is opened into a disk. A forest of shortest ways starts at the
//!    border (at the worst point where there is none). Every other side closes a loop, or a way
//!    from border to border, with the ways from its two ends. Between the triangles a tree is grown
//!    across those sides whose loops are longest; the sides that are neither in the forest nor
//!    crossed by the tree are left, as many as the surface has handles (twice) and holes, and they
//!    and their ways are the cut: the shortest for a surface with one source \[EW05\].
//! 2. A closed surface, and one whose worst points are to be freed, is cut on to these points, each
//!    from wherever the cut is nearest to it (the tree of shortest ways of \[TM80\], at most twice
//!    as long as the shortest tree).
//!
//! The worst points are those whose angles lack most of a full turn, or have most beyond it (their
//! angle defect, the Gauss curvature that sits in the vertex).

use super::Mesh;
use super::ways::{Search, Ways};
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{angle_between, from_deg};
use std::collections::BTreeSet;
use std::f64::consts::PI;

/// A closed mesh is cut to vertices whose angle defect is above this, degrees: that of the pole of
/// a football's cap divided by six, where a pattern begins to need a dart.
const SHARP_DEFECT_DEG: f64 = 30.0;
/// The most points that a mesh is cut to: a cut through more is no pattern but a puzzle.
const MOST_POINTS: usize = 256;

/// Sides along which a mesh is to be cut, by their numbers among [`Mesh::edges`].
pub type Cut = BTreeSet<usize>;

/// The sides of a part of a mesh that are of a cut of it; `vertices` are those of the part by their
/// numbers in the mesh.
pub fn cut_of_part(mesh: &Mesh, cut: &Cut, part: &Mesh, vertices: &[VertexIndex]) -> Cut {
    let is_cut = |n: &usize| {
        let [a, b] = part.edges()[*n].ends.map(|end| vertices[end.get()]);
        mesh.topology().edge_between(a, b).is_some_and(|n| cut.contains(&n))
    };
    (0..part.edges().len()).filter(|_| !cut.is_empty()).filter(is_cut).collect()
}

/// The angle defect of every vertex, radians: a full turn, or half a turn on the border, less the
/// sum of its angles.
pub fn angle_defects(mesh: &Mesh) -> Vec<f64> {
    let on_border = mesh.topology().on_border();
    let mut defects: Vec<f64> =
        on_border.iter().map(|&border| if border { PI } else { 2.0 * PI }).collect();
    for corners in mesh.triangles() {
        for k in 0..3 {
            let [at, b, c] = [0, 1, 2].map(|step| mesh.position(corners[(k + step) % 3]));
            defects[corners[k].get()] -= angle_between(b - at, c - at);
        }
    }
    defects
}

/// The vertices inside the mesh whose angle defect is above `least`, radians, the worst first; not
/// more of them than a pattern can bear.
pub fn worst_points(mesh: &Mesh, least: f64) -> Vec<VertexIndex> {
    let on_border = mesh.topology().on_border();
    let defects = angle_defects(mesh);
    let mut worst: Vec<usize> =
        (0..defects.len()).filter(|&v| !on_border[v] && defects[v].abs() > least).collect();
    worst.sort_by(|&a, &b| defects[b].abs().total_cmp(&defects[a].abs()).then(a.cmp(&b)));
    worst.truncate(MOST_POINTS);
    worst.into_iter().map(VertexIndex::new).collect()
}

/// The cut that makes a disk of a mesh of one component: none for a disk. A closed mesh is cut
/// through its worst points, or from end to end where it has none.
pub fn cut_to_disk(mesh: &Mesh) -> Cut {
    let mut cut = cut_handles_and_holes(mesh);
    if mesh.loops().is_empty() {
        let mut points = worst_points(mesh, from_deg(SHARP_DEFECT_DEG));
        if cut.is_empty() && points.len() < 2 {
            points = ends(mesh).to_vec();
        }
        cut_through(mesh, &mut cut, &points);
        // A cut along one side opens nothing.
        if cut.len() < 2 {
            cut_through(mesh, &mut cut, &[farthest(mesh, &points)]);
        }
    }
    cut
}

/// The shortest cut after which a mesh of one component has no handle and no more than one loop.
fn cut_handles_and_holes(mesh: &Mesh) -> Cut {
    let Some(piece) = mesh.components().first() else { return Cut::new() };
    if piece.handles() == 0 && piece.loops.len() < 2 {
        return Cut::new();
    }
    let edges = mesh.edges();
    let sources: Vec<VertexIndex> = if mesh.loops().is_empty() {
        worst_points(mesh, -1.0).first().copied().into_iter().collect()
    } else {
        mesh.loops().iter().flatten().copied().collect()
    };
    let ways = Ways::from(mesh, &sources, |_| false);
    let in_forest: BTreeSet<usize> = ways.by.iter().flatten().copied().collect();
    let lengths = mesh.lengths();
    let detour = |n: usize| {
        let [a, b] = edges[n].ends.map(|v| ways.length[v.get()]);
        a + lengths[n] + b
    };
    let mut crossed: Vec<usize> =
        (0..edges.len()).filter(|&n| !edges[n].is_border() && !in_forest.contains(&n)).collect();
    crossed.sort_by(|&a, &b| detour(b).total_cmp(&detour(a)).then(a.cmp(&b)));
    let mut trees = DisjointSets::new(mesh.triangles().len());
    let mut cut = Cut::new();
    for n in crossed {
        let [Some(a), Some(b)] = edges[n].triangles else { continue };
        if !trees.join(a.get(), b.get()) {
            cut.insert(n);
            for end in edges[n].ends {
                cut.extend(ways.back(edges, end));
            }
        }
    }
    // A way that two loops share, from where they part to the source, is no cut of its own unless
    // it holds them together: with a border, it ends there; without one, all end in the source.
    trim(mesh, &mut cut);
    cut
}

/// Removes branches of a cut that end inside the mesh: they separate nothing.
fn trim(mesh: &Mesh, cut: &mut Cut) {
    let on_border = mesh.topology().on_border();
    let edges = mesh.edges();
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); mesh.positions().len()];
    for &n in cut.iter() {
        edges[n].ends.iter().for_each(|end| at[end.get()].push(n));
    }
    let mut blind: Vec<usize> =
        (0..at.len()).filter(|&v| at[v].len() == 1 && !on_border[v]).collect();
    while let Some(v) = blind.pop() {
        let Some(n) = at[v].pop() else { continue };
        cut.remove(&n);
        let [a, b] = edges[n].ends.map(|end| end.get());
        let other = if a == v { b } else { a };
        at[other].retain(|&m| m != n);
        if at[other].len() == 1 && !on_border[other] {
            blind.push(other);
        }
    }
}

/// Cuts on to some points, each from the border or the cut, wherever it is nearest; where there is
/// neither, from the first of the points.
pub fn cut_through(mesh: &Mesh, cut: &mut Cut, points: &[VertexIndex]) {
    let edges = mesh.edges();
    let mut reached = mesh.topology().on_border();
    for &n in cut.iter() {
        edges[n].ends.iter().for_each(|end| reached[end.get()] = true);
    }
    if let (Some(first), false) = (points.first(), reached.contains(&true)) {
        reached[first.get()] = true;
    }
    let mut left: BTreeSet<VertexIndex> =
        points.iter().copied().filter(|v| !reached[v.get()]).collect();
    let sources: Vec<VertexIndex> =
        (0..reached.len()).filter(|&v| reached[v]).map(VertexIndex::new).collect();
    let mut search = Search::new(mesh, &sources);
    while let Some(found) = search.next(|v| left.contains(&v)) {
        let way: Vec<usize> = search.ways.back(edges, found).collect();
        search.add(found);
        left.remove(&found);
        for n in way {
            cut.insert(n);
            for end in edges[n].ends {
                search.add(end);
                left.remove(&end);
            }
        }
    }
}

/// Two points that lie far apart: the farthest from the first vertex, and the farthest from that.
fn ends(mesh: &Mesh) -> [VertexIndex; 2] {
    let one = farthest(mesh, &[VertexIndex::new(0)]);
    [one, farthest(mesh, &[one])]
}

/// The vertex that lies farthest from some, along sides.
fn farthest(mesh: &Mesh, from: &[VertexIndex]) -> VertexIndex {
    let ways = Ways::from(mesh, from, |_| false);
    let far = |v: usize| if ways.length[v].is_finite() { ways.length[v] } else { 0.0 };
    let best = (0..ways.length.len()).reduce(|a, b| if far(b) > far(a) { b } else { a });
    VertexIndex::new(best.unwrap_or(0))
}
