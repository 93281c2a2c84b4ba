//! Triangles that only fill a line: three corners on it, or two in one place.
//!
//! Some programs close the gap between a long side and the two sides along it by a triangle without
//! area. Left out, it leaves the corner in its middle on the long side. Which corner that is, is
//! remembered, so that [`super::joined`] divides the neighbour there, however thin that is.

use super::{Damage, Work, middle, places};
use crate::mesh::has_area;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point3;
use std::collections::BTreeMap;

/// A filler tapers to the ends of its longest side by less than this angle, radians: twenty times
/// less than a triangle that someone meant.
const TAPER: f64 = 1e-3;
/// Fillers within fillers, the most: each halves a side.
const MOST_DEPTH: usize = 60;

/// The corners in the middle of fillers. Points are named by the first vertex in their place, since
/// a neighbour may have points of its own.
#[derive(Default)]
pub(super) struct Fillers {
    /// The first vertex in the place of each; none if there are no fillers.
    place: Vec<usize>,
    /// By the places of the ends of their longest sides, the lower first.
    middles: BTreeMap<[usize; 2], Vec<usize>>,
}

impl Fillers {
    /// The place of a vertex, if there are fillers.
    pub(super) fn place(&self, vertex: VertexIndex) -> Option<usize> {
        self.place.get(vertex.get()).copied()
    }

    /// The places that lie on a side with these ends, in no order.
    pub(super) fn on(&self, ends: [VertexIndex; 2]) -> Vec<usize> {
        let [Some(a), Some(b)] = ends.map(|end| self.place(end)) else { return Vec::new() };
        let mut found = Vec::new();
        let mut left = vec![([a.min(b), a.max(b)], 0)];
        while let Some((ends, depth)) = left.pop() {
            for &middle in self.middles.get(&ends).into_iter().flatten() {
                if depth == MOST_DEPTH || found.contains(&middle) {
                    continue;
                }
                found.push(middle);
                left.extend(ends.map(|end| ([end.min(middle), end.max(middle)], depth + 1)));
            }
        }
        found
    }
}

/// Leaves out the fillers.
pub(super) fn leave_out(work: &mut Work) -> Fillers {
    let mut fillers: Vec<[VertexIndex; 3]> = Vec::new();
    let mut kept = Vec::with_capacity(work.triangles.len());
    for &corners in &work.triangles {
        match filler(work.corners(corners), work.filler) {
            Some(longest) => fillers.push([0, 1, 2].map(|k| corners[(longest + k) % 3])),
            None => kept.push(corners),
        }
    }
    let Some(&first) = fillers.first() else { return Fillers::default() };
    work.triangles = kept;
    work.note(Damage::Filler, fillers.len(), Some(middle(work.corners(first))));
    let place = places(&work.positions);
    let mut middles: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for corners in fillers {
        let [a, b, between] = corners.map(|v| place[v.get()]);
        if a != b && b != between && between != a {
            middles.entry([a.min(b), a.max(b)]).or_default().push(between);
        }
    }
    Fillers { place, middles }
}

/// Of a filler, the corner at which its longest side begins; `None` of any other triangle.
/// `height` is that below which it may be one, mm.
fn filler(at: [Point3; 3], height: f64) -> Option<usize> {
    let side = |n: usize| at[(n + 1) % 3] - at[n];
    let longest = (1..3).fold(0, |most, n| {
        if side(n).length_squared() > side(most).length_squared() { n } else { most }
    });
    if !has_area(at) {
        return Some(longest);
    }
    let (along, other) = (side(longest), at[(longest + 2) % 3] - at[longest]);
    let length = along.length();
    let low = along.cross(other).length() / length;
    let foot = along.dot(other) / length;
    (low < height && low < TAPER * foot.min(length - foot)).then_some(longest)
}
