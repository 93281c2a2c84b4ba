//! Which closed curves of a plan lie inside which, and which cross.
//!
//! Loops that do not touch one another are nested like bowls. Counted from outside, a loop at an
//! even depth bounds a panel and one at an odd depth is a hole of the panel around it. All tests
//! are exact on the polygons that are given.

use crate::math::Point2;
use crate::predicate::{Box2, first_crossing, for_touching_boxes, inside, segments_touch};
use std::collections::BTreeSet;

/// Where a loop lies among others.
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

/// How loops lie in a plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Nesting {
    /// Each loop, in the order given. Loops that cross are not inside one another.
    pub loops: Vec<Nested>,
    /// The pairs of loops that cross or touch, the smaller number first, in order.
    pub crossing: Vec<[usize; 2]>,
    /// The loops that cross or touch themselves, in order.
    pub crossing_itself: Vec<usize>,
}

/// How closed polygons lie in a plan. Those of fewer than three corners lie inside nothing and have
/// nothing inside. Time O(m log m) for m corners as people draw them.
pub fn nesting(loops: &[Vec<Point2>]) -> Nesting {
    let crossing = crossing_pairs(loops);
    let crosses = |a: usize, b: usize| crossing.contains(&[a.min(b), a.max(b)]);
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
        let distinct = a != b && is_loop(a) && is_loop(b) && !crosses(a, b);
        distinct && in_box(a, b) && inside(&loops[b], loops[a][0])
    };
    let around: Vec<Vec<usize>> =
        (0..loops.len()).map(|a| (0..loops.len()).filter(|&b| within(a, b)).collect()).collect();
    let nested = around.iter().map(|around_this| Nested {
        // The innermost has the most loops around itself; of crossing ones the first counts.
        parent: around_this.iter().copied().max_by_key(|&b| (around[b].len(), usize::MAX - b)),
        depth: around_this.len(),
    });
    let loops_now = nested.collect();
    let itself = |&a: &usize| is_loop(a) && first_crossing(&loops[a]).is_some();
    let crossing_itself = (0..loops.len()).filter(itself).collect();
    Nesting { loops: loops_now, crossing: crossing.into_iter().collect(), crossing_itself }
}

/// The pairs of polygons that have a point of their edges in common.
fn crossing_pairs(loops: &[Vec<Point2>]) -> BTreeSet<[usize; 2]> {
    let mut edges = Vec::new();
    for (n, polygon) in loops.iter().enumerate() {
        let m = polygon.len();
        edges.extend((0..m).map(|i| (n, polygon[i], polygon[(i + 1) % m])));
    }
    let boxes: Vec<_> = edges
        .iter()
        .map(|(_, a, b)| {
            let (a, b) = (a.to_vec().extend(0.0), b.to_vec().extend(0.0));
            (a.min(b), a.max(b))
        })
        .collect();
    let mut found = BTreeSet::new();
    for_touching_boxes(&boxes, |i, j| {
        let ((m, a, b), (n, c, d)) = (edges[i], edges[j]);
        if m != n && segments_touch(a, b, c, d) {
            found.insert([m.min(n), m.max(n)]);
        }
    });
    found
}
