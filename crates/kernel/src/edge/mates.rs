//! Which edges are joined to one another, and how much their lengths differ.
//!
//! Two edges on one curve are mates where they have a stretch of it in common. Where both have the
//! same samples, that is the steps that they share, bit by bit. Where they were sampled apart, it
//! is what `shared` finds. Edges on two curves are mates where they lie on one another (`twins`),
//! and so are the straight end of a strip and an edge on a curve.

use super::shared::{Shared, lengths, shared};
use super::twins::{Twins, twins};
use super::{Edge, EdgePlace, EdgeSource, PartEdges};
use crate::sample::StepPlace;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::math::{Point2, Point3};
use sheetwright_geometry::tolerance::Tolerance;
use std::collections::{BTreeMap, BTreeSet};

/// An edge with the places of its points.
struct Placed {
    at: EdgePlace,
    /// The number of the curve that it lies on, if it lies on one.
    curve: Option<usize>,
    /// Whether it is a whole loop.
    is_loop: bool,
    space: Vec<Point3>,
    flat: Vec<Point2>,
    /// The flat length of each of its steps, mm, by where it lies in space.
    steps: BTreeMap<StepPlace, f64>,
}

impl Placed {
    fn new(at: EdgePlace, edge: &Edge, part: &PartEdges<'_>) -> Self {
        let space: Vec<Point3> = edge.run.iter().map(|&v| part.space[v]).collect();
        let flat: Vec<Point2> = edge.run.iter().map(|&v| part.flat[v]).collect();
        let steps = space.windows(2).zip(flat.windows(2));
        let steps =
            steps.map(|(s, f)| (StepPlace::between([s[0], s[1]]), f[0].distance(f[1]))).collect();
        let curve = match edge.source {
            EdgeSource::Curve(number) => Some(number),
            _ => None,
        };
        Self { at, curve, is_loop: edge.is_loop(), space, flat, steps }
    }

    /// The stretches that it shares with another edge of its group.
    fn shared(&self, other: &Self) -> Vec<Shared> {
        shared((&self.space, self.is_loop), (&other.space, other.is_loop))
    }

    /// The length on the pattern, mm, from one length in space to another, which may go on beyond
    /// the end of a closed edge.
    fn flat_mm(&self, [from, to]: [f64; 2]) -> f64 {
        let space = lengths(&self.space);
        let steps = self.flat.windows(2).map(|p| p[0].distance(p[1]));
        let flat: Vec<f64> = std::iter::once(0.0)
            .chain(steps.scan(0.0, |sum, step| {
                *sum += step;
                Some(*sum)
            }))
            .collect();
        let [whole, whole_flat] = [&space, &flat].map(|lengths| lengths[lengths.len() - 1]);
        let at = |along: f64| {
            let rounds = if along > whole || along < 0.0 { (along / whole).floor() } else { 0.0 };
            let rest = along - rounds * whole;
            let n = space[1..].partition_point(|&length| length < rest).min(space.len() - 2);
            let step = space[n + 1] - space[n];
            let share = if step > 0.0 { ((rest - space[n]) / step).clamp(0.0, 1.0) } else { 0.0 };
            rounds * whole_flat + flat[n] + share * (flat[n + 1] - flat[n])
        };
        (at(to) - at(from)).abs()
    }
}

/// Looks for the mates of all edges of a design, and compares their lengths: of edges on one curve
/// or on one another, of the two sides of a cut, and of parts of meshes that meet.
pub(crate) fn join_mates(parts: &mut [PartEdges<'_>]) {
    let mut groups: BTreeMap<Group, Vec<Placed>> = BTreeMap::new();
    for (number, part) in parts.iter().enumerate() {
        for (edge, found) in part.edges.iter().enumerate() {
            let at = EdgePlace { part: number, edge };
            if let Some(group) = Group::of(at, found.source) {
                groups.entry(group).or_default().push(Placed::new(at, found, part));
            }
        }
    }
    let size = size_of(groups.values().flatten().flat_map(|edge| edge.space.iter().copied()));
    let least_mm = Tolerance::CHAIN.length_mm(size);
    let of_groups = groups.iter().flat_map(|(group, list)| {
        let pairs = pairs(group, list, least_mm).into_iter();
        pairs.map(move |pair| (pair.map(|n| &list[n]), None))
    });
    let may_lie_on_another = |group: &Group| matches!(group, Group::Curve(_) | Group::Ends);
    let apart = groups.iter().filter(|(group, _)| may_lie_on_another(group));
    let apart: Vec<&Placed> = apart.flat_map(|(_, list)| list).collect();
    let of_twins = {
        let lines: Vec<(&[Point3], bool)> =
            apart.iter().map(|edge| (&edge.space[..], edge.is_loop)).collect();
        // Two ends, which have no curve, are looked at as a group.
        let is_other = |[a, b]: [usize; 2]| apart[a].curve != apart[b].curve;
        let pairs = twins(&lines, least_mm, is_other).into_iter();
        pairs.map(|Twins { pair, common }| (pair.map(|n| apart[n]), common)).collect::<Vec<_>>()
    };
    for ([a, b], found) in of_groups.chain(of_twins) {
        let commons = match found {
            Some(common) => {
                let swapped = common.iter().map(|shared| shared.swapped()).collect();
                [common, swapped]
            }
            None => [a.shared(b), b.shared(a)],
        };
        let Some([of_a, of_b]) = in_common(a, b, &commons[0], least_mm) else { continue };
        let [common, swapped] = commons;
        let sides = [(a.at, b.at, [of_a, of_b], common), (b.at, a.at, [of_b, of_a], swapped)];
        for (own, mate, shared_mm, common) in sides {
            let edge = &mut parts[own.part].edges[own.edge];
            let place = edge.mates.partition_point(|other| *other < mate);
            edge.mates.insert(place, mate);
            edge.common.insert(place, common);
            edge.shared_mm.insert(place, shared_mm);
            let difference = (of_a - of_b).abs();
            edge.difference_mm = Some(edge.difference_mm.unwrap_or(0.0).max(difference));
        }
    }
}

/// The group of edges among which mates are found: edges of one curve, one cut or two meshes, sides
/// of the cuts that divide parts, and the ends of strips.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Curve(usize),
    /// A cut of a part, both by their numbers.
    Cut(usize, usize),
    Meshes,
    /// Sides of the cuts that divide parts.
    Divisions,
    /// Ends of strips, which meet where a strip is closed.
    Ends,
}

impl Group {
    fn of(at: EdgePlace, source: EdgeSource) -> Option<Self> {
        match source {
            EdgeSource::Curve(number) => Some(Self::Curve(number)),
            EdgeSource::Cut { number, .. } => Some(Self::Cut(at.part, number)),
            EdgeSource::Division { .. } => Some(Self::Divisions),
            EdgeSource::Part { .. } => Some(Self::Meshes),
            EdgeSource::Start | EdgeSource::End => Some(Self::Ends),
            EdgeSource::Border => None,
        }
    }
}

/// The pairs of a group that may be mates: all on one curve; of meshes and of divided parts those
/// with a common step; of ends those that lie on one another within `least_mm`.
fn pairs(group: &Group, list: &[Placed], least_mm: f64) -> BTreeSet<[usize; 2]> {
    match group {
        Group::Curve(_) | Group::Cut(..) => {
            return (0..list.len()).flat_map(|n| (0..n).map(move |k| [k, n])).collect();
        }
        Group::Ends => return ends_on_one_another(list, least_mm),
        Group::Meshes | Group::Divisions => {}
    }
    let mut at_step: BTreeMap<&StepPlace, Vec<usize>> = BTreeMap::new();
    for (n, edge) in list.iter().enumerate() {
        edge.steps.keys().for_each(|step| at_step.entry(step).or_default().push(n));
    }
    let of_step = |edges: &Vec<usize>| -> Vec<[usize; 2]> {
        let pair = |n: usize| edges[..n].iter().map(move |&k| [k, edges[n]]);
        (0..edges.len()).flat_map(pair).collect()
    };
    at_step.values().flat_map(of_step).collect()
}

/// The pairs of straight ends that lie on one another, whichever way they run.
fn ends_on_one_another(list: &[Placed], within_mm: f64) -> BTreeSet<[usize; 2]> {
    let ends = |n: usize| [list[n].space[0], list[n].space[list[n].space.len() - 1]];
    let middle = |n: usize| {
        let [a, b] = ends(n);
        a.lerp(b, 0.5).x
    };
    let mut by_x: Vec<usize> = (0..list.len()).collect();
    by_x.sort_by(|&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
    let mut pairs = BTreeSet::new();
    for (place, &n) in by_x.iter().enumerate() {
        let [a, b] = ends(n);
        for &k in by_x[place + 1..].iter().take_while(|&&k| middle(k) - middle(n) <= within_mm) {
            let [c, d] = ends(k);
            let apart = a.distance(c).max(b.distance(d)).min(a.distance(d).max(b.distance(c)));
            if apart <= within_mm {
                pairs.insert([n.min(k), n.max(k)]);
            }
        }
    }
    pairs
}

/// The length that two edges have in common, on the pattern of each, mm; `None` if it is not above
/// `least_mm`. `common` are the stretches of it.
fn in_common(a: &Placed, b: &Placed, common: &[Shared], least_mm: f64) -> Option<[f64; 2]> {
    let (few, many) = if a.steps.len() < b.steps.len() { (a, b) } else { (b, a) };
    let steps: BTreeSet<&StepPlace> =
        few.steps.keys().filter(|step| many.steps.contains_key(*step)).collect();
    if !steps.is_empty() {
        return Some([a, b].map(|edge| steps.iter().map(|step| edge.steps[*step]).sum()));
    }
    let length_mm: f64 = common.iter().map(|Shared { first: [from, to], .. }| to - from).sum();
    (length_mm > least_mm).then(|| {
        let of_a = common.iter().map(|shared| a.flat_mm(shared.first)).sum();
        [of_a, common.iter().map(|shared| b.flat_mm(shared.second)).sum()]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An edge through these points, flat as it is, on curve 0.
    fn edge(points: &[[f64; 2]]) -> (Vec<Edge>, Vec<Point3>, Vec<Point2>) {
        let space: Vec<Point3> = points.iter().map(|p| Point3::new(p[0], p[1], 0.0)).collect();
        let flat: Vec<Point2> = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
        let run = (0..points.len()).collect();
        (vec![Edge::new("a".into(), EdgeSource::Curve(0), run, &space, &flat)], space, flat)
    }

    fn joined(lines: &[&[[f64; 2]]]) -> Vec<(Vec<usize>, Option<f64>)> {
        let mut made: Vec<_> = lines.iter().map(|line| edge(line)).collect();
        let mut parts: Vec<PartEdges<'_>> =
            made.iter_mut().map(|(edges, space, flat)| PartEdges { edges, space, flat }).collect();
        join_mates(&mut parts);
        let of = |(edges, _, _): &(Vec<Edge>, _, _)| {
            (edges[0].mates.iter().map(|m| m.part).collect(), edges[0].difference_mm)
        };
        made.iter().map(of).collect()
    }

    #[test]
    fn a_short_edge_is_the_mate_of_a_long_one_along_what_they_share() {
        // Sampled apart: the short one lies on the second half of the long one.
        let long: &[[f64; 2]] = &[[0., 0.], [3., 0.], [7., 0.], [10., 0.]];
        let short: &[[f64; 2]] = &[[10., 0.], [8., 0.], [5., 0.]];
        let apart: &[[f64; 2]] = &[[0., 0.], [2., 0.], [5., 0.]];
        let found = joined(&[long, short, apart]);
        assert_eq!(found[0], (vec![1, 2], Some(0.0)));
        // Both halves meet in a point, which is no common stretch.
        assert_eq!(found[1], (vec![0], Some(0.0)));
        assert_eq!(found[2], (vec![0], Some(0.0)));
    }

    #[test]
    fn ends_that_meet_up_to_rounding_are_mates() {
        let mut made: Vec<_> =
            [[[0., 0.], [5., 0.]], [[5., 1e-12], [0., 0.]], [[0., 1.], [5., 1.]]]
                .iter()
                .map(|line| edge(line))
                .collect();
        for (edges, _, _) in &mut made {
            edges[0].source = EdgeSource::End;
        }
        let mut parts: Vec<PartEdges<'_>> =
            made.iter_mut().map(|(edges, space, flat)| PartEdges { edges, space, flat }).collect();
        join_mates(&mut parts);
        let mates: Vec<usize> = made.iter().map(|(edges, _, _)| edges[0].mates.len()).collect();
        assert_eq!(mates, [1, 1, 0]);
    }

    #[test]
    fn the_end_of_a_strip_is_the_mate_of_a_part_of_a_curve() {
        let mut made: Vec<_> = [
            &[[0., 0.], [2., 0.], [5., 0.], [5., 4.]][..],
            &[[4., 0.], [1., 0.]],
            &[[5., 4.], [5., 0.]],
            &[[0., 1.], [5., 1.]],
        ]
        .iter()
        .map(|line| edge(line))
        .collect();
        for (edges, _, _) in &mut made[1..] {
            edges[0].source = EdgeSource::Start;
        }
        let mut parts: Vec<PartEdges<'_>> =
            made.iter_mut().map(|(edges, space, flat)| PartEdges { edges, space, flat }).collect();
        join_mates(&mut parts);
        let mates: Vec<usize> = made.iter().map(|(edges, _, _)| edges[0].mates.len()).collect();
        assert_eq!(mates, [2, 1, 1, 0]);
        assert_eq!(made[0].0[0].shared_mm, [[3.0, 3.0], [4.0, 4.0]]);
    }

    #[test]
    fn a_part_of_a_ring_is_compared_with_that_part() {
        let ring: &[[f64; 2]] = &[[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 0.]];
        let part: &[[f64; 2]] = &[[0., 1.], [0., 0.], [1., 0.]];
        let found = joined(&[ring, part]);
        assert_eq!(found[0], (vec![1], Some(0.0)));
        assert_eq!(joined(&[ring, ring])[1], (vec![0], Some(0.0)));
        assert_eq!(joined(&[part])[0], (vec![], None));
    }
}
