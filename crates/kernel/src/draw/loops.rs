//! Which closed curves of a plan lie inside which, which cross, and which are neighbours.
//!
//! Loops that do not meet are disjoint or nested. Counted from outside, a loop at an even depth
//! bounds a panel and one at an odd depth is a hole of the panel around it. Loops that meet in
//! corners or along sides, each outside of the other, are neighbours, as panels drawn off one
//! another are; neither lies inside the other. Loops that meet in any other way cross: one runs
//! through the other, touches it from inside, or lies on it.
//!
//! All tests are exact on the given polygons. Two edges that cross in their interiors decide at
//! once. Where loops only touch, each contact is a corner of one of them. Orientation tests about
//! that corner show whether the edges of either run into the other, out of it, or along it.

use sheetwright_geometry::math::Point2;
use sheetwright_geometry::predicate::{
    Box2, first_crossing, for_touching_boxes, inside, orientation, segments_touch,
};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// The place of a loop among others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nested {
    /// The innermost of the loops around it, counted from 0; `None` if there is none.
    pub parent: Option<usize>,
    /// How many loops lie around it.
    pub depth: usize,
}

impl Nested {
    /// Whether it is a hole: an odd number of loops lies around it.
    pub fn is_hole(self) -> bool {
        !self.depth.is_multiple_of(2)
    }
}

/// The nesting, crossings and contacts of loops in a plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Nesting {
    /// Each loop, in the order given. Loops that cross or touch are not inside one another.
    pub loops: Vec<Nested>,
    /// The pairs of loops that cross, lie on one another, or touch with one inside the other; the
    /// smaller number first, in order.
    pub crossing: Vec<[usize; 2]>,
    /// The pairs of loops that touch, each outside of the other; the smaller number first, in
    /// order.
    pub touching: Vec<[usize; 2]>,
    /// The loops that cross or touch themselves, in order.
    pub crossing_itself: Vec<usize>,
}

/// The nesting, crossings and contacts of closed polygons in a plan. A polygon of fewer than three
/// corners lies inside no other and has none inside. Time O(m log m) for m corners as people draw
/// them.
pub fn nesting(loops: &[Vec<Point2>]) -> Nesting {
    let meetings = meetings(loops);
    let meets = |a: usize, b: usize| meetings.contains_key(&[a.min(b), a.max(b)]);
    let boxes: Vec<Option<Box2>> =
        loops.iter().map(|polygon| Box2::of_points(polygon.iter().copied())).collect();
    let in_box = |a: usize, b: usize| match (boxes[a], boxes[b]) {
        (Some(a), Some(b)) => {
            b.min.x <= a.min.x && a.max.x <= b.max.x && b.min.y <= a.min.y && a.max.y <= b.max.y
        }
        _ => false,
    };
    let is_loop = |a: usize| loops[a].len() >= 3;
    let within = |a: usize, b: usize| {
        let distinct = a != b && is_loop(a) && is_loop(b) && !meets(a, b);
        distinct && in_box(a, b) && inside(&loops[b], loops[a][0])
    };
    let around: Vec<Vec<usize>> =
        (0..loops.len()).map(|a| (0..loops.len()).filter(|&b| within(a, b)).collect()).collect();
    let nested = around.iter().map(|around_this| Nested {
        // The innermost has the most loops around itself; of ones that meet the first counts.
        parent: around_this.iter().copied().max_by_key(|&b| (around[b].len(), usize::MAX - b)),
        depth: around_this.len(),
    });
    let loops_now = nested.collect();
    let itself = |&a: &usize| is_loop(a) && first_crossing(&loops[a]).is_some();
    let crossing_itself = (0..loops.len()).filter(itself).collect();
    let (touching, crossing): (Vec<_>, Vec<_>) =
        meetings.into_iter().partition(|(_, meeting)| meeting.is_of_neighbours());
    let [touching, crossing] = [touching, crossing].map(|pairs| pairs.into_iter().map(|p| p.0));
    Nesting {
        loops: loops_now,
        crossing: crossing.collect(),
        touching: touching.collect(),
        crossing_itself,
    }
}

/// How two polygons meet, the one of the smaller number first.
#[derive(Clone, Copy, Default)]
struct Meeting {
    /// Whether edges of both cross in their middles.
    crosses: bool,
    /// Whether each runs into the other, and out of it, where they touch.
    runs: [Runs; 2],
}

#[derive(Clone, Copy, Default)]
struct Runs {
    inside: bool,
    outside: bool,
}

impl Meeting {
    /// Whether each lies outside of the other. Neither runs in nor out where one lies on the other.
    fn is_of_neighbours(&self) -> bool {
        let enters = self.runs.iter().any(|runs| runs.inside);
        !self.crosses && !enters && self.runs.iter().any(|runs| runs.outside)
    }
}

/// The pairs of polygons that have a point of their edges in common, and how they meet.
fn meetings(loops: &[Vec<Point2>]) -> BTreeMap<[usize; 2], Meeting> {
    let edges: Vec<(usize, usize)> = loops
        .iter()
        .enumerate()
        .flat_map(|(n, polygon)| (0..polygon.len()).map(move |i| (n, i)))
        .collect();
    let ends = |(n, i): (usize, usize)| [loops[n][i], loops[n][(i + 1) % loops[n].len()]];
    let boxes: Vec<_> = edges
        .iter()
        .map(|&edge| {
            let [a, b] = ends(edge).map(|p| p.to_vec().extend(0.0));
            (a.min(b), a.max(b))
        })
        .collect();
    let ways: Vec<Ordering> = loops.iter().map(|polygon| way_round(polygon)).collect();
    let mut found: BTreeMap<[usize; 2], Meeting> = BTreeMap::new();
    for_touching_boxes(&boxes, |i, j| {
        let (first, second) = (edges[i].min(edges[j]), edges[i].max(edges[j]));
        let ([a, b], [c, d]) = (ends(first), ends(second));
        if first.0 == second.0 || !segments_touch(a, b, c, d) {
            return;
        }
        let meeting = found.entry([first.0, second.0]).or_default();
        if parts(a, b, c, d) && parts(c, d, a, b) {
            meeting.crosses = true;
        }
        for p in [a, b, c, d].into_iter().filter(|&p| lies_on(p, a, b) && lies_on(p, c, d)) {
            let beside = [first, second].map(|(n, i)| beside(&loops[n], i, p));
            for (its, other) in [(0, 1), (1, 0)] {
                let way = ways[if other == 0 { first.0 } else { second.0 }];
                for toward in beside[its] {
                    match side(p, beside[other], way, toward) {
                        Ordering::Greater => meeting.runs[its].inside = true,
                        Ordering::Less => meeting.runs[its].outside = true,
                        Ordering::Equal => {}
                    }
                }
            }
        }
    });
    found
}

/// Whether the line through `a` and `b` separates `c` and `d`.
fn parts(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    let sides = [orientation(a, b, c), orientation(a, b, d)];
    !sides.contains(&Ordering::Equal) && sides[0] != sides[1]
}

/// Whether `p` lies on the closed segment `a`–`b`.
fn lies_on(p: Point2, a: Point2, b: Point2) -> bool {
    let between = |p: f64, a: f64, b: f64| a.min(b) <= p && p <= a.max(b);
    between(p.x, a.x, b.x) && between(p.y, a.y, b.y) && orientation(a, b, p) == Ordering::Equal
}

/// The corners before and behind a place on edge `i` of a polygon: those of the edge, or of both
/// edges where the place is a corner.
fn beside(polygon: &[Point2], i: usize, p: Point2) -> [Point2; 2] {
    let m = polygon.len();
    // Seen from the side, corners in a row may lie on one spot.
    let off = |&q: &Point2| q != p;
    let before = (0..m).map(|k| polygon[(i + m - k) % m]).find(off);
    let behind = (1..=m).map(|k| polygon[(i + k) % m]).find(off);
    [before.unwrap_or(p), behind.unwrap_or(p)]
}

/// Which way round a simple polygon runs: `Greater` counter-clockwise, `Less` clockwise, `Equal` if
/// it has no inside.
fn way_round(polygon: &[Point2]) -> Ordering {
    let order = |a: &usize, b: &usize| {
        let (a, b) = (polygon[*a], polygon[*b]);
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
    };
    // The polygon turns at the lowest of its leftmost corners in its own direction.
    let Some(corner) = (0..polygon.len()).min_by(order) else { return Ordering::Equal };
    let [before, behind] = beside(polygon, corner, polygon[corner]);
    orientation(before, polygon[corner], behind)
}

/// Where the segment from a place `p` on a polygon towards another point begins: `Greater` inside
/// of the polygon, `Less` outside, `Equal` along it. `before` and `behind` are the corners of the
/// polygon beside `p`, and `way` is its direction.
fn side(p: Point2, [before, behind]: [Point2; 2], way: Ordering, toward: Point2) -> Ordering {
    let alike = |a: f64, b: f64, from: f64| a.partial_cmp(&from) == b.partial_cmp(&from);
    let runs_along = |corner: Point2| {
        let same_way = alike(corner.x, toward.x, p.x) && alike(corner.y, toward.y, p.y);
        same_way && orientation(p, corner, toward) == Ordering::Equal
    };
    if runs_along(before) || runs_along(behind) {
        return Ordering::Equal;
    }
    let inwards = |a: Point2, b: Point2| orientation(a, b, toward) == way;
    let is_inside = way != Ordering::Equal
        && match orientation(before, p, behind) {
            Ordering::Equal => inwards(before, p),
            turn if turn == way => inwards(before, p) && inwards(p, behind),
            _ => inwards(before, p) || inwards(p, behind),
        };
    if is_inside { Ordering::Greater } else { Ordering::Less }
}
