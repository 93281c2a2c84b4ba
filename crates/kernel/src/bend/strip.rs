//! Strips: rows of triangles of a sheet without vertices inside, from rung to rung.
//!
//! The triangles of such a sheet hang together as a tree, or round windows in rings, which are
//! opened at their flattest rungs. The way through the tree along which the creases add up to most
//! is the first strip; each branch off it is a strip again, which begins at the triangle where it
//! branches off (a heavy-path decomposition \[ST83\], by bend instead of size).

use super::{Laid, crease};
use crate::mesh::Mesh;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Vec3, unit};
use std::ops::Range;

/// The weight of a rung without a crease, radians: of flat ways the longest is taken.
const FLAT_RUNG: f64 = 1e-9;
/// How far to either side rungs are asked for the direction of the ruling beside them.
const BESIDE: usize = 4;

/// A row of triangles, each joined to the next at a rung.
pub(super) struct Strip {
    /// Its triangles, in order.
    pub(super) triangles: Vec<usize>,
    /// The sides of the mesh between them.
    pub(super) rungs: Vec<usize>,
    /// The left and the right end of each rung, as seen along the strip.
    pub(super) ends: Vec<[VertexIndex; 2]>,
    /// Whether it branches off another strip; its first triangle then is of that one.
    pub(super) starts_inside: bool,
}

/// The ends of a strip: the left and the right vertex of its first ruling, and of its last; `None`
/// where it branches off another.
pub(super) fn tips(strip: &Strip, laid: &Laid<'_>) -> [Option<[VertexIndex; 2]>; 2] {
    let (Some(&first), Some(&last)) = (strip.ends.first(), strip.ends.last()) else {
        return [None; 2];
    };
    let of = |triangle: usize, rung: [VertexIndex; 2]| {
        let tip = strip.far(laid.mesh, triangle, rung)?;
        Some(Tip::of(tip, rung, laid).ruling(tip, rung))
    };
    let start = if strip.starts_inside { None } else { of(0, first) };
    [start, of(strip.triangles.len() - 1, last)]
}

/// How a strip ends in a triangle: in its far corner, or in one of the sides there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tip {
    /// In the far corner, where both sides of the strip meet.
    Point,
    /// In the side from the far corner to the left end of the rung.
    Left,
    /// In the side from the far corner to the right end of the rung.
    Right,
}

impl Tip {
    /// How the strip ends beyond a rung, in the triangle with this far corner. A strip between two
    /// rails ends in a straight side between two corners of the border, others in a point.
    pub(super) fn of(tip: VertexIndex, [left, right]: [VertexIndex; 2], laid: &Laid<'_>) -> Self {
        let is_side = |end: VertexIndex| {
            let ends = if end < tip { [end, tip] } else { [tip, end] };
            let edges = laid.mesh.edges();
            let edge = edges.binary_search_by_key(&ends, |edge| edge.ends);
            let is_inside = edge.is_ok_and(|n| !edges[n].is_border());
            is_inside || (laid.corners.is_corner(end) && laid.corners.is_corner(tip))
        };
        match (is_side(left), is_side(right)) {
            (false, false) => Self::Point,
            (true, false) => Self::Left,
            (false, true) => Self::Right,
            // The one that lies more along the rung is a ruling.
            (true, true) => {
                let way = |end: VertexIndex| laid.flat[end.get()] - laid.flat[tip.get()];
                let rung = laid.flat[right.get()] - laid.flat[left.get()];
                let lies = |end| way(end).dot(rung).abs() / way(end).length();
                if lies(left) > lies(right) { Self::Left } else { Self::Right }
            }
        }
    }

    /// The left and the right vertex of the last ruling.
    fn ruling(self, tip: VertexIndex, [left, right]: [VertexIndex; 2]) -> [VertexIndex; 2] {
        match self {
            Self::Point => [tip; 2],
            Self::Left => [left, tip],
            Self::Right => [tip, right],
        }
    }
}

impl Strip {
    /// The corner of one of its triangles that lies on neither end of a rung.
    pub(super) fn far(
        &self,
        mesh: &Mesh,
        triangle: usize,
        rung: [VertexIndex; 2],
    ) -> Option<VertexIndex> {
        mesh.triangles()[self.triangles[triangle]].into_iter().find(|corner| !rung.contains(corner))
    }

    /// By how much each triangle of a run is turned against its first one, radians. A rung that
    /// ends at samples lies aslant to the ruling beside it, so its crease counts by how far it lies
    /// along the mean of the rungs beside it, by their creases: of rungs to and fro that cross a
    /// strip of a cylinder, that is the ruling, and the sum is the turn, both exactly.
    pub(super) fn turns(&self, run: &Range<usize>, mesh: &Mesh) -> Vec<f64> {
        let rungs = run.start..run.end - 1;
        let creases: Vec<(Vec3, f64)> = rungs
            .map(|n| {
                let [left, right] = self.ends[n].map(|v| mesh.position(v));
                let way = unit(right - left).unwrap_or(Vec3::ZERO);
                (way, crease(mesh, &mesh.edges()[self.rungs[n]]))
            })
            .collect();
        let mut turns = vec![0.0];
        let mut turned = 0.0;
        for (n, &(way, crease)) in creases.iter().enumerate() {
            let near = n.saturating_sub(BESIDE)..(n + BESIDE + 1).min(creases.len());
            let weighed = near.map(|other| {
                let (way, crease) = creases[other];
                way * (crease.abs() * (BESIDE + 1 - n.abs_diff(other)) as f64)
            });
            let ruling = unit(weighed.sum()).unwrap_or(way);
            turned += crease * way.dot(ruling);
            turns.push(turned);
        }
        turns
    }
}

/// The strips of a mesh without vertices inside. Of one triangle alone there is none.
pub(super) fn strips(mesh: &Mesh) -> Vec<Strip> {
    let tree = Tree::of(mesh);
    let mut strips = Vec::new();
    let mut seen = vec![false; mesh.triangles().len()];
    for triangle in 0..seen.len() {
        if seen[triangle] {
            continue;
        }
        // The way along which most is bent runs between the triangles that are farthest apart.
        let end = tree.rooted(triangle).farthest();
        let mut rooted = tree.rooted(end);
        let other = rooted.farthest();
        let lowest = |triangle: usize| mesh.triangles()[triangle].iter().min().copied();
        if lowest(other) < lowest(end) {
            rooted = tree.rooted(other);
        }
        rooted.order.iter().for_each(|&(triangle, _)| seen[triangle] = true);
        strips.extend(rooted.ways().into_iter().filter_map(|way| strip(mesh, way)));
    }
    strips
}

/// The strip along a way.
fn strip(mesh: &Mesh, Way { triangles, rungs, starts_inside }: Way) -> Option<Strip> {
    let &first = rungs.first()?;
    let edge = &mesh.edges()[first];
    // The first triangle lies to the left of the side as it runs from the lower end to the higher,
    // and is left over its right.
    let [low, high] = edge.ends;
    let is_left = edge.triangles[0].is_some_and(|t| t.get() == triangles[0]);
    let mut ends = vec![if is_left { [high, low] } else { [low, high] }];
    for &rung in &rungs[1..] {
        let [left, right] = ends[ends.len() - 1];
        let next = mesh.edges()[rung].ends;
        let other = |end: VertexIndex| if next[0] == end { next[1] } else { next[0] };
        ends.push(if next.contains(&left) { [left, other(left)] } else { [other(right), right] });
    }
    Some(Strip { triangles, rungs, ends, starts_inside })
}

/// The triangles of a mesh, joined by rungs as a tree.
struct Tree {
    /// For each triangle, its neighbours with the side between and its weight.
    next: Vec<Vec<(usize, usize, f64)>>,
}

/// A way from a triangle on, away from the root.
struct Way {
    triangles: Vec<usize>,
    rungs: Vec<usize>,
    starts_inside: bool,
}

impl Tree {
    fn of(mesh: &Mesh) -> Self {
        let edges = mesh.edges();
        let weight = |n: usize| crease(mesh, &edges[n]).abs() + FLAT_RUNG;
        let mut inside: Vec<(f64, usize)> =
            (0..edges.len()).filter(|&n| !edges[n].is_border()).map(|n| (weight(n), n)).collect();
        // Rings round windows are opened where they bend least.
        inside.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut sets = DisjointSets::new(mesh.triangles().len());
        let mut next = vec![Vec::new(); mesh.triangles().len()];
        for (weight, n) in inside {
            let [Some(a), Some(b)] = edges[n].triangles.map(|t| t.map(|t| t.get())) else {
                continue;
            };
            if sets.join(a, b) {
                next[a].push((b, n, weight));
                next[b].push((a, n, weight));
            }
        }
        next.iter_mut().for_each(|list| list.sort_by_key(|&(triangle, ..)| triangle));
        Self { next }
    }

    /// The tree as it hangs from a triangle.
    fn rooted(&self, root: usize) -> Rooted<'_> {
        let mut order = vec![(root, None)];
        let mut distance = vec![(root, 0.0)];
        let mut n = 0;
        while n < order.len() {
            let (triangle, parent): (usize, Option<(usize, usize)>) = order[n];
            let from = parent.map(|(parent, _)| parent);
            for &(next, rung, weight) in &self.next[triangle] {
                if Some(next) != from {
                    order.push((next, Some((triangle, rung))));
                    distance.push((next, distance[n].1 + weight));
                }
            }
            n += 1;
        }
        Rooted { tree: self, order, distance }
    }
}

struct Rooted<'a> {
    tree: &'a Tree,
    /// The triangles, each behind the one that it hangs from, with that and the rung between.
    order: Vec<(usize, Option<(usize, usize)>)>,
    /// Their distances from the root, by weight.
    distance: Vec<(usize, f64)>,
}

impl Rooted<'_> {
    fn farthest(&self) -> usize {
        let farther = |a: (usize, f64), b: (usize, f64)| if b.1 > a.1 { b } else { a };
        self.distance.iter().copied().reduce(farther).map_or(0, |(triangle, _)| triangle)
    }

    /// The ways down the tree, the one from the root first.
    fn ways(&self) -> Vec<Way> {
        let count = self.tree.next.len();
        // How much is bent below each triangle, and which way it goes on there.
        let mut below = vec![0.0f64; count];
        let mut heavy: Vec<Option<(usize, usize)>> = vec![None; count];
        for &(triangle, parent) in self.order.iter().rev() {
            let Some((parent, rung)) = parent else { continue };
            let list = &self.tree.next[parent];
            let weight = list.iter().find(|n| n.0 == triangle).map_or(0.0, |n| n.2);
            let reach = below[triangle] + weight;
            if heavy[parent].is_none() || reach > below[parent] {
                below[parent] = reach;
                heavy[parent] = Some((triangle, rung));
            }
        }
        let mut ways = Vec::new();
        for &(triangle, parent) in &self.order {
            let begins = match parent {
                None => Way { triangles: vec![triangle], rungs: Vec::new(), starts_inside: false },
                Some((parent, _)) if heavy[parent].is_some_and(|(heavy, _)| heavy == triangle) => {
                    continue;
                }
                Some((parent, rung)) => Way {
                    triangles: vec![parent, triangle],
                    rungs: vec![rung],
                    starts_inside: true,
                },
            };
            let mut way = begins;
            let mut at = triangle;
            while let Some((next, rung)) = heavy[at] {
                way.triangles.push(next);
                way.rungs.push(rung);
                at = next;
            }
            ways.push(way);
        }
        ways
    }
}
