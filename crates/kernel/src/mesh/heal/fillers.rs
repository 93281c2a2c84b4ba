//! Triangles that only fill a line: three corners on it, or two in one place.
//!
//! Some programs close the gap between a long side and the two sides along it by a triangle without
//! area. Left out, it leaves the corner in its middle on the long side. Which corner that is, is
//! remembered, so that [`super::joined`] divides the neighbour there, however thin that is.
//!
//! Where the numbers of the file are rounded, the corner in the middle lies beside the line by up
//! to two steps, and the filler faces anywhere. A triangle as low as that is one if it is turned
//! against its neighbour across the long side, so the ears of a finely divided rim are none.

use super::{Damage, Work, middle, places};
use crate::mesh::has_area;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point3, Vec3, angle_between, from_deg};
use std::collections::BTreeMap;

/// A filler tapers to the ends of its longest side by less than this angle, radians: twenty times
/// less than a triangle that someone meant.
const TAPER: f64 = 1e-3;
/// A filler that rounding made a triangle may taper by this angle, radians: that by which sides may
/// turn where they are joined.
const ROUNDED_TAPER: f64 = 0.01;
/// It is turned against its neighbour by this angle at least, degrees: as in nets, where a triangle
/// that turns by less may lie in one plane with others.
const TURNED_DEG: f64 = 15.0;
/// Fillers within fillers, the most: each halves a side.
const MOST_DEPTH: usize = 60;
/// Of the triangles at a side, so many are looked at: a surface has two.
const MOST_BESIDE: usize = 16;

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
    let as_filler = |corners: &[VertexIndex; 3]| filler(work.corners(*corners), work.filler);
    let mut longest: Vec<Option<usize>> = work.triangles.iter().map(as_filler).collect();
    add_rounded(work, &mut longest);
    let mut fillers: Vec<[VertexIndex; 3]> = Vec::new();
    let mut kept = Vec::with_capacity(work.triangles.len());
    for (&corners, longest) in work.triangles.iter().zip(longest) {
        match longest {
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

/// Adds the fillers that rounding made triangles to those that are known, each as the corner at
/// which its longest side begins. A long side is judged before those that lie on it, since
/// what remains of a filler that is left out fills the line, too.
fn add_rounded(work: &Work, longest: &mut [Option<usize>]) {
    let may_be = |n: usize| {
        let at = work.corners(work.triangles[n]);
        low(at).filter(|low| low.is_within(work.rounding, ROUNDED_TAPER)).map(|low| (low, n))
    };
    let others = (0..longest.len()).filter(|&n| work.rounding > 0.0 && longest[n].is_none());
    let mut low: Vec<(Low, usize)> = others.filter_map(may_be).collect();
    if low.is_empty() {
        return;
    }
    low.sort_by(|a, b| b.0.length.total_cmp(&a.0.length).then(a.1.cmp(&b.1)));
    let place = places(&work.positions);
    let side = |n: usize, k: usize| {
        let [a, b] = [k, (k + 1) % 3].map(|k| place[work.triangles[n][k].get()]);
        ([a.min(b), a.max(b)], a < b)
    };
    let sides_of = |n: usize| (0..3).map(move |k| side(n, k));
    let mut at: BTreeMap<[usize; 2], Vec<(usize, bool)>> = BTreeMap::new();
    for (ends, _) in low.iter().flat_map(|&(_, n)| sides_of(n)) {
        at.insert(ends, Vec::new());
    }
    for n in 0..work.triangles.len() {
        for (ends, upwards) in sides_of(n) {
            at.entry(ends).and_modify(|there| {
                if there.len() < MOST_BESIDE {
                    there.push((n, upwards));
                }
            });
        }
    }
    let long: BTreeMap<usize, [usize; 2]> =
        low.iter().map(|(of, n)| (*n, side(*n, of.longest).0)).collect();
    let long = &long;
    for (of, n) in low {
        // Across its longest side; or across the others, on the rim and where two that may be
        // fillers have their longest side in common, which tell nothing of one another.
        for k in [vec![of.longest], vec![(of.longest + 1) % 3, (of.longest + 2) % 3]] {
            let sides = k.into_iter().map(|k| side(n, k));
            let there = sides.flat_map(|(ends, upwards)| {
                let is_mate = move |other: usize| long.get(&other) == Some(&ends);
                let others = at.get(&ends).into_iter().flatten();
                let others = others.filter(move |(other, _)| *other != n && !is_mate(*other));
                others.map(move |&(other, of_other)| (other, upwards != of_other))
            });
            let there: Vec<(usize, bool)> = there.collect();
            if there.is_empty() {
                continue;
            }
            let is_turned = |&(other, agrees): &(usize, bool)| {
                let [own, other] = [n, other].map(|n| area(work.corners(work.triangles[n])));
                let other = if agrees { other } else { -other };
                angle_between(own, other) > from_deg(TURNED_DEG)
            };
            if there.iter().all(|on| longest[on.0].is_some() || is_turned(on)) {
                longest[n] = Some(of.longest);
            }
            break;
        }
    }
}

/// The area vector of a triangle, twice.
fn area([a, b, c]: [Point3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}

/// Of a filler, the corner at which its longest side begins; `None` of any other triangle.
/// `height` is that below which it may be one, mm.
fn filler(at: [Point3; 3], height: f64) -> Option<usize> {
    if !has_area(at) {
        return Some(longest_side(at));
    }
    low(at).filter(|low| low.is_within(height, TAPER)).map(|low| low.longest)
}

/// The corner at which the longest side of a triangle begins.
fn longest_side(at: [Point3; 3]) -> usize {
    let square = |n: usize| (at[(n + 1) % 3] - at[n]).length_squared();
    (1..3).fold(0, |most, n| if square(n) > square(most) { n } else { most })
}

/// How low a triangle is over its longest side, lengths in mm.
struct Low {
    longest: usize,
    length: f64,
    height: f64,
    /// How far the foot of the height is from the nearer end.
    to_end: f64,
}

impl Low {
    fn is_within(&self, height: f64, taper: f64) -> bool {
        self.height < height && self.height < taper * self.to_end
    }
}

/// How low a triangle is; `None` of one without a side.
fn low(at: [Point3; 3]) -> Option<Low> {
    let longest = longest_side(at);
    let [from, to, across] = [0, 1, 2].map(|k| at[(longest + k) % 3]);
    let (along, other) = (to - from, across - from);
    let length = along.length();
    let foot = along.dot(other) / length;
    let height = along.cross(other).length() / length;
    (length > 0.0).then_some(Low { longest, length, height, to_end: foot.min(length - foot) })
}
