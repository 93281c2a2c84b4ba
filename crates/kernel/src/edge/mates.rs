//! Which edges are joined to one another, and how much their lengths differ.
//!
//! Two edges on one curve are mates where they have a stretch of it in common. Where both have the
//! same samples, that is the steps that they share, bit by bit. Where they were sampled apart, the
//! ends of each are looked for on the other, at the point that lies nearest.

use super::{Edge, EdgePlace, EdgeSource, PartEdges};
use crate::sample::StepPlace;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::math::{Point2, Point3};
use sheetwright_geometry::tolerance::Tolerance;
use std::collections::{BTreeMap, BTreeSet};

/// An edge with the places of its points.
struct Placed {
    at: EdgePlace,
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
        Self { at, space, flat, steps }
    }

    fn is_loop(&self) -> bool {
        self.space.first() == self.space.last()
    }
}

/// Looks for the mates of all edges of a design, and compares their lengths: of edges on one curve,
/// of the two sides of a cut, and of parts of meshes that meet.
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
    for (group, list) in &groups {
        for [n, k] in pairs(group, list) {
            let (a, b) = (&list[n], &list[k]);
            let Some([of_a, of_b]) = in_common(a, b, least_mm) else { continue };
            for (own, mate) in [(a.at, b.at), (b.at, a.at)] {
                let edge = &mut parts[own.part].edges[own.edge];
                edge.mates.push(mate);
                let difference = (of_a - of_b).abs();
                edge.difference_mm = Some(edge.difference_mm.unwrap_or(0.0).max(difference));
            }
        }
    }
    let edges = parts.iter_mut().flat_map(|part| part.edges.iter_mut());
    edges.for_each(|edge| edge.mates.sort_unstable());
}

/// The group of edges among which mates are found: edges of one curve, one cut or two meshes.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Curve(usize),
    /// A cut of a part, both by their numbers.
    Cut(usize, usize),
    Meshes,
}

impl Group {
    fn of(at: EdgePlace, source: EdgeSource) -> Option<Self> {
        match source {
            EdgeSource::Curve(number) => Some(Self::Curve(number)),
            EdgeSource::Cut { number, .. } => Some(Self::Cut(at.part, number)),
            EdgeSource::Part { .. } => Some(Self::Meshes),
            EdgeSource::Start | EdgeSource::End | EdgeSource::Border => None,
        }
    }
}

/// The pairs of a group that may be mates: all on one curve; of meshes those with a common step.
fn pairs(group: &Group, list: &[Placed]) -> BTreeSet<[usize; 2]> {
    if *group != Group::Meshes {
        return (0..list.len()).flat_map(|n| (0..n).map(move |k| [k, n])).collect();
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

/// The length that two edges have in common, on the pattern of each, mm; `None` if it is not above
/// `least_mm`.
fn in_common(a: &Placed, b: &Placed, least_mm: f64) -> Option<[f64; 2]> {
    let (few, many) = if a.steps.len() < b.steps.len() { (a, b) } else { (b, a) };
    let shared: BTreeSet<&StepPlace> =
        few.steps.keys().filter(|step| many.steps.contains_key(*step)).collect();
    if !shared.is_empty() {
        return Some([a, b].map(|edge| shared.iter().map(|step| edge.steps[*step]).sum()));
    }
    let lengths = [along(a, b, least_mm)?, along(b, a, least_mm)?];
    Some(lengths)
}

/// The length on the pattern, mm, of the part of an edge that another edge on its curve has in
/// common with it.
fn along(own: &Placed, other: &Placed, least_mm: f64) -> Option<f64> {
    let lengths = |points: &mut dyn Iterator<Item = f64>| -> Vec<f64> {
        let mut sum = 0.0;
        let summed = points.map(|step| {
            sum += step;
            sum
        });
        std::iter::once(0.0).chain(summed).collect()
    };
    let space = lengths(&mut own.space.windows(2).map(|p| p[0].distance(p[1])));
    let flat = lengths(&mut own.flat.windows(2).map(|p| p[0].distance(p[1])));
    let whole = [space[space.len() - 1], flat[flat.len() - 1]];
    if other.is_loop() {
        return Some(whole[1]);
    }
    let places = [other.space.first()?, other.space.last()?].map(|p| nearest(&own.space, *p));
    let at = |lengths: &[f64]| {
        let [a, b] = places.map(|(n, t)| lengths[n] + t * (lengths[n + 1] - lengths[n]));
        (b - a).abs()
    };
    let (mut in_space, mut on_pattern) = (at(&space), at(&flat));
    if own.is_loop() {
        // Of the two ways round, the one that is nearer to the length of the other.
        let wanted: f64 = other.space.windows(2).map(|p| p[0].distance(p[1])).sum();
        if (whole[0] - in_space - wanted).abs() < (in_space - wanted).abs() {
            (in_space, on_pattern) = (whole[0] - in_space, whole[1] - on_pattern);
        }
    }
    (in_space > least_mm).then_some(on_pattern)
}

/// The place on a polyline of two points or more that lies nearest to a point: the step, and the
/// share of it.
fn nearest(line: &[Point3], p: Point3) -> (usize, f64) {
    let on_step = |n: usize| {
        let way = line[n + 1] - line[n];
        let share = (p - line[n]).dot(way) / way.length_squared();
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
        (p.distance(line[n].lerp(line[n + 1], share)), n, share)
    };
    let found = (0..line.len() - 1).map(on_step).reduce(|a, b| if b.0 < a.0 { b } else { a });
    found.map_or((0, 0.0), |(_, n, share)| (n, share))
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
    fn a_part_of_a_ring_is_compared_with_that_part() {
        let ring: &[[f64; 2]] = &[[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 0.]];
        let part: &[[f64; 2]] = &[[0., 1.], [0., 0.], [1., 0.]];
        let found = joined(&[ring, part]);
        assert_eq!(found[0], (vec![1], Some(0.0)));
        assert_eq!(joined(&[ring, ring])[1], (vec![0], Some(0.0)));
        assert_eq!(joined(&[part])[0], (vec![], None));
    }
}
