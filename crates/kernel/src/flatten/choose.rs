//! Which rungs a surface with holes is cut along.
//!
//! A cut runs along a rung from loop to loop, and a set of them that joins all loops without a
//! cycle (a tree over the loops) leaves one piece without holes. Which set matters to a person,
//! because a cut round which the surface lies flat can be closed again (a window), and one round
//! which it does not is a seam to be joined in the shop (a tube). So:
//!
//! 1. For every loop, the triangles round it are laid beside one another in the plane. If the last
//!    comes to lie where the first one lay, the loop *closes*: it can be a hole of the pattern.
//! 2. Cuts are first made where the user says.
//! 3. The loops that do not close are joined by as few rungs as can be, the shortest of equally
//!    few: through windows only where there is no other way. With three of them or more, each is
//!    joined to what is joined already; the fewest of all is not sought.
//! 4. The loops that close are joined to the others by the shortest rungs.

use super::unroll::beside;
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Point2, Point3, Vec2, unit2};
use sheetwright_geometry::tolerance::Tolerance;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A rung that joins two loops.
#[derive(Clone, Copy)]
struct LoopRung {
    hinge: usize,
    loops: [usize; 2],
    length_mm: f64,
}

/// Rungs up to this share longer than the shortest are as good. Of those, the one farthest from all
/// other loops is taken, since a seam a millimetre beside a window can't be welded.
const AS_SHORT: f64 = 0.02;
/// Lengths nearer to one another than this share are equal, and the first rung is taken: of the
/// rulings of a cone, rounding must not choose.
const SAME_LENGTH: f64 = 1e-9;

/// The hinges to cut, in increasing order, so that one piece without holes is left; `near` are the
/// places that the user names. Fewer than there are holes if no rungs join the loops.
pub(super) fn cuts(surface: &Surface, near: &[Point3], closing: Tolerance) -> Vec<usize> {
    let loops = surface.connectivity().loops().len();
    if loops < 2 {
        return Vec::new();
    }
    let joints = joints(surface);
    let limit_mm = closing.length_mm(size_of(surface.positions().iter().copied()));
    let left_of = left_of(surface.connectivity());
    let opens: Vec<bool> =
        (0..loops).map(|n| gap_round_mm(surface, &left_of, n) > limit_mm).collect();
    let mut joined = Joined { trees: DisjointSets::new(loops), cuts: Vec::new() };
    for &place in near {
        joined.nearest(surface, &joints, place);
    }
    let shortest = shortest_between(surface, &joints);
    while joined.two_open_ones(&shortest, &opens) {}
    joined.others(&shortest);
    joined.cuts.sort_unstable();
    joined.cuts
}

/// The rungs that join two loops, in their order.
fn joints(surface: &Surface) -> Vec<LoopRung> {
    let connectivity = surface.connectivity();
    let loop_of = |s: SampleIndex| connectivity.loops().partition_point(|l| l.end <= s.get());
    let of_hinge = |(hinge, ends): (usize, [SampleIndex; 2])| {
        let loops = ends.map(loop_of);
        let length_mm = surface.length(ends[0], ends[1]);
        (loops[0] != loops[1]).then_some(LoopRung { hinge, loops, length_mm })
    };
    connectivity.hinges().iter().map(|h| h.rung.ends()).enumerate().filter_map(of_hinge).collect()
}

/// The rung between every two loops that have any to cut along, in the order of the loops: the
/// shortest, or one as good that keeps clear of other loops.
fn shortest_between(surface: &Surface, joints: &[LoopRung]) -> Vec<LoopRung> {
    let mut of_pairs: BTreeMap<[usize; 2], Vec<LoopRung>> = BTreeMap::new();
    for joint in joints {
        let [a, b] = joint.loops;
        of_pairs.entry([a.min(b), a.max(b)]).or_default().push(*joint);
    }
    let best = |of_pair: Vec<LoopRung>| {
        let shortest = of_pair.iter().map(|j| j.length_mm).fold(f64::INFINITY, f64::min);
        let clear = |joint: &LoopRung| clearance_mm(surface, joint);
        of_pair.into_iter().filter(|j| j.length_mm <= shortest * (1.0 + AS_SHORT)).reduce(
            |best, other| {
                let (clear, better) = (clear(&best), clear(&other));
                let as_clear = (clear - better).abs() <= SAME_LENGTH * clear || clear == better;
                let shorter = other.length_mm < best.length_mm * (1.0 - SAME_LENGTH);
                if if as_clear { shorter } else { better > clear } { other } else { best }
            },
        )
    };
    of_pairs.into_values().filter_map(best).collect()
}

/// How far a rung keeps from the samples of the loops that it does not join, mm; infinite where
/// there are no others.
fn clearance_mm(surface: &Surface, joint: &LoopRung) -> f64 {
    let [a, b] = surface.connectivity().hinges()[joint.hinge].rung.ends();
    let (from, to) = (surface.position(a), surface.position(b));
    let along = to - from;
    let away = |p: Point3| {
        let share = ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        p.distance(from.lerp(to, share))
    };
    let others = surface.connectivity().loops().iter().enumerate();
    others
        .filter(|(n, _)| !joint.loops.contains(n))
        .flat_map(|(_, of_loop)| surface.positions()[of_loop.clone()].iter().copied())
        .map(away)
        .fold(f64::INFINITY, f64::min)
}

/// The loops as a forest of those that are joined by cuts.
struct Joined {
    trees: DisjointSets,
    cuts: Vec<usize>,
}

impl Joined {
    /// The two trees that a rung would join; `None` if they are one.
    fn trees(&mut self, joint: &LoopRung) -> Option<[usize; 2]> {
        let [a, b] = joint.loops.map(|n| self.trees.first(n));
        (a != b).then_some([a, b])
    }

    fn join(&mut self, joint: &LoopRung) {
        let [a, b] = joint.loops;
        if self.trees.join(a, b) {
            self.cuts.push(joint.hinge);
        }
    }

    /// Cuts along the rung whose middle lies nearest to a place, of those that join two trees.
    fn nearest(&mut self, surface: &Surface, joints: &[LoopRung], place: Point3) {
        let away = |joint: &LoopRung| {
            let [a, b] = surface.connectivity().hinges()[joint.hinge].rung.ends();
            surface.position(a).lerp(surface.position(b), 0.5).distance(place)
        };
        let free = joints.iter().filter(|joint| self.trees(joint).is_some());
        let best = free.min_by(|a, b| away(a).total_cmp(&away(b)).then(a.hinge.cmp(&b.hinge)));
        if let Some(joint) = best.copied() {
            self.join(&joint);
        }
    }

    /// Joins the tree of the first open loop with another tree that has one, along the fewest rungs
    /// and the shortest way of those; `false` if there is no other, or no way.
    fn two_open_ones(&mut self, joints: &[LoopRung], opens: &[bool]) -> bool {
        let roots: Vec<usize> = (0..opens.len()).map(|n| self.trees.first(n)).collect();
        let mut open = roots.iter().zip(opens).filter(|(_, opens)| **opens).map(|(root, _)| *root);
        let Some(start) = open.next() else { return false };
        let goals: Vec<usize> = open.filter(|&root| root != start).collect();
        // Dijkstra's algorithm over the trees; loops are few.
        let mut ways: BTreeMap<usize, Way> = BTreeMap::new();
        ways.insert(start, Way { cuts: 0, length_mm: 0.0, last: None, done: false });
        loop {
            let next = ways
                .iter()
                .filter(|(_, way)| !way.done)
                .min_by(|a, b| a.1.shorter(b.1).then(a.0.cmp(b.0)))
                .map(|(&root, &way)| (root, way));
            let Some((at, way)) = next else { return false };
            if goals.contains(&at) {
                self.join_along(&ways, &roots, at);
                return true;
            }
            ways.insert(at, Way { done: true, ..way });
            for joint in joints {
                let [a, b] = joint.loops.map(|n| roots[n]);
                let to = match (a == at, b == at) {
                    (true, false) => b,
                    (false, true) => a,
                    _ => continue,
                };
                let longer = Way {
                    cuts: way.cuts + 1,
                    length_mm: way.length_mm + joint.length_mm,
                    last: Some((*joint, at)),
                    done: false,
                };
                if ways.get(&to).is_none_or(|known| !known.done && longer.shorter(known).is_lt()) {
                    ways.insert(to, longer);
                }
            }
        }
    }

    fn join_along(&mut self, ways: &BTreeMap<usize, Way>, roots: &[usize], goal: usize) {
        let mut at = goal;
        // A way passes through a tree once.
        for _ in 0..roots.len() {
            let Some((joint, before)) = ways.get(&at).and_then(|way| way.last) else { break };
            self.join(&joint);
            at = before;
        }
    }

    /// Joins what is still apart by the shortest rungs (Kruskal's algorithm).
    fn others(&mut self, joints: &[LoopRung]) {
        let mut by_length = joints.to_vec();
        by_length.sort_by(|a, b| a.length_mm.total_cmp(&b.length_mm).then(a.hinge.cmp(&b.hinge)));
        for joint in by_length {
            self.join(&joint);
        }
    }
}

/// A way from tree to tree.
#[derive(Clone, Copy)]
struct Way {
    cuts: usize,
    length_mm: f64,
    /// Its last rung, and the tree that it comes from.
    last: Option<(LoopRung, usize)>,
    /// Whether no shorter one is left to be found.
    done: bool,
}

impl Way {
    fn shorter(&self, other: &Self) -> Ordering {
        self.cuts.cmp(&other.cuts).then(self.length_mm.total_cmp(&other.length_mm))
    }
}

type LeftOf = BTreeMap<[SampleIndex; 2], TriangleIndex>;

/// The triangle to the left of every side, in its direction.
fn left_of(connectivity: &Connectivity) -> LeftOf {
    let triangles = connectivity.triangles().iter().enumerate();
    triangles
        .flat_map(|(n, &[a, b, c])| {
            [[a, b], [b, c], [c, a]].map(|side| (side, TriangleIndex::new(n)))
        })
        .collect()
}

/// How far the samples of a loop lie from where they began when the triangles along it are laid
/// beside one another, once round, mm: the largest distance; infinite where they can't be.
fn gap_round_mm(surface: &Surface, left_of: &LeftOf, of_loop: usize) -> f64 {
    laid_round(surface, left_of, of_loop).map_or(f64::INFINITY, |(points, [from, to])| {
        let [a, b] = [points[0], points[1]];
        let (Some(x), Some(along)) = (unit2(b - a), unit2(to - from)) else {
            return f64::INFINITY;
        };
        // Where a point comes to lie that lies so in the frame of the first edge.
        let moved = |p: Point2| {
            let way = p - a;
            from + along * way.dot(x) + along.perp() * x.perp_dot(way)
        };
        points.iter().map(|&p| moved(p).distance(p)).fold(0.0, f64::max)
    })
}

/// Where the samples of a loop lie in the plane, and the ends of its first edge again after the
/// way round.
fn laid_round(
    surface: &Surface,
    left_of: &LeftOf,
    of_loop: usize,
) -> Option<(Vec<Point2>, [Point2; 2])> {
    let connectivity = surface.connectivity();
    let range = connectivity.loops()[of_loop].clone();
    let (first, second) = (SampleIndex::new(range.start), SampleIndex::new(range.start + 1));
    let far = |side: [SampleIndex; 2]| {
        left_of.get(&side).map(|&triangle| connectivity.far_corner(triangle, side))
    };
    let beyond = |u: SampleIndex, v: SampleIndex, c: SampleIndex, at: [Point2; 2]| {
        let length = |a, b| surface.length(a, b);
        beside(at[0], at[1], length(u, v), length(u, c), length(v, c))
    };
    let (mut u, mut v) = (first, second);
    let mut c = far([u, v])?;
    let (mut at_u, mut at_v) =
        (Point2::default(), Point2::default() + Vec2::X * surface.length(u, v));
    let mut at_c = beyond(u, v, c, [at_u, at_v])?;
    let mut points = vec![at_u];
    // Every triangle is come through three times at the most, once a corner.
    for _ in 0..4 * connectivity.triangles().len() {
        if let Some(next) = far([c, v]) {
            // About v, over the side v–c.
            let at_next = beyond(c, v, next, [at_c, at_v])?;
            (u, at_u) = (c, at_c);
            (c, at_c) = (next, at_next);
        } else {
            // v–c is the next edge of the loop.
            (u, at_u, v, at_v, c, at_c) = (v, at_v, c, at_c, u, at_u);
            if u == first {
                return Some((points, [at_u, at_v]));
            }
            points.push(at_u);
        }
    }
    None
}
