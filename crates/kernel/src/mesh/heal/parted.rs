//! Sides that belong to more than two triangles: the mesh is parted there.
//!
//! A rib on a plate, an inner wall, two sheets that cross: at each such side the triangles that go
//! on straightest stay together, two and two, and the others end there. Where triangles hang
//! together beyond such sides, as the faces of either of two boxes that touch along an edge, they
//! stay together first, as long as they run the same way round.
//!
//! A triangle that ends at a side may hang together with those that go on there round both ends of
//! the side, so that these have no vertices to tell them apart. It is divided at the middle of the
//! side then.

use super::joined::divided;
use super::{Damage, Work, middle};
use crate::mesh::topology::{HalfEdge, groups};
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Vec3, unit};
use std::collections::BTreeMap;

/// Which triangles hang together, and which run the same way round: by two numbers of every
/// triangle, one for each way, of which one may be joined with one of a neighbour.
struct Ways(DisjointSets);

impl Ways {
    /// Whether two triangles hang together so that they run the same way round; `None` if they do
    /// not hang together. `agree`: whether they do as they are given.
    fn agree(&mut self, [a, b]: [usize; 2]) -> Option<bool> {
        let (a, [same, other]) = (self.0.first(2 * a), [2 * b, 2 * b + 1]);
        if self.0.first(same) == a {
            Some(true)
        } else if self.0.first(other) == a {
            Some(false)
        } else {
            None
        }
    }

    fn join(&mut self, [a, b]: [usize; 2], agree: bool) {
        let other = usize::from(!agree);
        self.0.join(2 * a, 2 * b + other);
        self.0.join(2 * a + 1, 2 * b + 1 - other);
    }
}

/// Parts the mesh at sides of more than two triangles; whether there are some. All its sides are
/// given.
pub(super) fn part(work: &mut Work, sides: &[HalfEdge]) -> bool {
    let branches: Vec<&[HalfEdge]> = groups(sides).filter(|group| group.len() > 2).collect();
    let Some([first, ..]) = branches.first() else { return false };
    let place = middle(first.ends.map(|v| work.at(v)));
    let mut ways = Ways(DisjointSets::new(2 * work.triangles.len()));
    let mut corners = DisjointSets::new(3 * work.triangles.len());
    for group in groups(sides) {
        if let [a, b] = group {
            ways.join([a, b].map(|side| side.triangle as usize), a.upwards != b.upwards);
            keep(&mut corners, work, [a, b]);
        }
    }
    // Which hang together before any are joined at branches.
    let mut before = Ways(ways.0.clone());
    let mut units: Vec<Vec<Vec<&HalfEdge>>> = Vec::with_capacity(branches.len());
    for group in &branches {
        let mut of_side = Vec::new();
        let mut left: Vec<&HalfEdge> = group.iter().collect();
        while let Some([a, b]) = best(work, &left, &mut ways, &mut before) {
            let pair = [left[a], left[b]];
            let ended = pair.map(|side| side.triangle as usize);
            ways.join(ended, pair[0].upwards != pair[1].upwards);
            keep(&mut corners, work, pair);
            left.remove(b);
            left.remove(a);
            of_side.push(pair.to_vec());
        }
        of_side.extend(left.into_iter().map(|side| vec![side]));
        units.push(of_side);
    }
    let count = branches.len();
    let at_branches = branches.iter().flat_map(|group| group[0].ends).collect();
    split(work, at_branches, &corners.all_first());
    divide(work, &units);
    work.note(Damage::Branch, count, Some(place));
    true
}

/// Divides triangles at the middle of a side whose vertices others have as well, from which they
/// are parted there. Of each side of too many triangles, `units` has those that stay together.
fn divide(work: &mut Work, units: &[Vec<Vec<&HalfEdge>>]) {
    let mut middles: BTreeMap<usize, [Vec<VertexIndex>; 3]> = BTreeMap::new();
    for of_side in units {
        let mut taken: Vec<[VertexIndex; 2]> = Vec::with_capacity(of_side.len());
        for unit in of_side {
            let side = unit[0];
            let corners = work.triangles[side.triangle as usize];
            let ends = [0, 1].map(|k| corners[(usize::from(side.at) + k) % 3]);
            let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            if !taken.contains(&ends) {
                taken.push(ends);
                continue;
            }
            let number = VertexIndex::new(work.positions.len());
            work.positions.push(middle(ends.map(|v| work.at(v))));
            for side in unit {
                let of_triangle = middles.entry(side.triangle as usize).or_default();
                of_triangle[usize::from(side.at)].push(number);
            }
        }
    }
    for (triangle, on) in middles {
        let mut parts = divided(work, work.triangles[triangle], on).into_iter();
        if let Some(first) = parts.next() {
            work.triangles[triangle] = first;
        }
        work.triangles.extend(parts);
    }
}

/// Keeps two triangles together along a side.
fn keep(of: &mut DisjointSets, work: &Work, [a, b]: [&HalfEdge; 2]) {
    for end in a.ends {
        let corner = |side: &HalfEdge| {
            let corners = work.triangles[side.triangle as usize];
            3 * side.triangle as usize + corners.iter().position(|&v| v == end).unwrap_or(0)
        };
        of.join(corner(a), corner(b));
    }
}

/// The two sides, by their numbers in the list, whose triangles best stay together.
fn best(work: &Work, left: &[&HalfEdge], ways: &mut Ways, before: &mut Ways) -> Option<[usize; 2]> {
    /// Triangles that hang together come before those that only go on straight: cosines differ by
    /// two at most.
    const TOGETHER: f64 = 3.0;
    let off: Vec<Vec3> = left.iter().map(|side| off_side(work, side)).collect();
    let mut found: Option<(f64, [usize; 2])> = None;
    for a in 0..left.len() {
        for b in a + 1..left.len() {
            let pair = [left[a], left[b]].map(|side| side.triangle as usize);
            let agree = left[a].upwards != left[b].upwards;
            if ways.agree(pair).is_some_and(|known| known != agree) {
                continue;
            }
            let together = if before.agree(pair).is_some() { TOGETHER } else { 0.0 };
            let cost = off[a].dot(off[b]) - together;
            if found.is_none_or(|(least, _)| cost < least) {
                found = Some((cost, [a, b]));
            }
        }
    }
    found.map(|(_, pair)| pair)
}

/// The direction in which a triangle leaves its side, square to it.
fn off_side(work: &Work, side: &HalfEdge) -> Vec3 {
    let corners = work.corners(work.triangles[side.triangle as usize]);
    let [a, b, c] = [0, 1, 2].map(|k| corners[(usize::from(side.at) + k) % 3]);
    let along = unit(b - a).unwrap_or_default();
    unit((c - a) - along * along.dot(c - a)).unwrap_or_default()
}

/// Gives each of these vertices a copy for every set of corners but the first.
fn split(work: &mut Work, mut at: Vec<VertexIndex>, corners: &[usize]) {
    at.sort_unstable();
    at.dedup();
    let mut copies: BTreeMap<(VertexIndex, usize), VertexIndex> = BTreeMap::new();
    let mut is_taken = vec![false; work.positions.len()];
    for n in 0..corners.len() {
        let vertex = work.triangles[n / 3][n % 3];
        if at.binary_search(&vertex).is_err() {
            continue;
        }
        let positions = &mut work.positions;
        let copy = *copies.entry((vertex, corners[n])).or_insert_with(|| {
            if !std::mem::replace(&mut is_taken[vertex.get()], true) {
                return vertex;
            }
            positions.push(positions[vertex.get()]);
            VertexIndex::new(positions.len() - 1)
        });
        work.triangles[n / 3][n % 3] = copy;
    }
}
