//! An edge on the flat pattern, with places along it by their lengths in space.

use crate::edge::{Edge, lengths};
use sheetwright_geometry::math::{Point2, Point3, Vec2, Vec3, unit, unit2};
use std::collections::BTreeMap;

/// The cosine of the least turn, in space or on the pattern, at which an edge has a corner: 35°,
/// between the turns of a ring of twelve samples and of an octagon.
const CORNER: f64 = 0.819;

/// An edge of a flat piece, the sheet to its left.
pub(super) struct Stretch {
    points: Vec<Point2>,
    /// The length in space to each point, mm.
    lengths: Vec<f64>,
    space: Vec<Point3>,
    /// The third corner in space of the triangle beside each step, where it is known.
    apexes: Vec<Option<Point3>>,
    is_loop: bool,
}

/// How the sheet lies in space beside a step of an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// The unit direction into the sheet, square to the step.
    pub(super) into: Vec3,
    /// The unit normal towards the side from which the pattern is seen.
    pub(super) up: Vec3,
}

/// A step of an edge that has a length.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Where it begins, mm along the edge.
    from: f64,
    /// Its unit direction in space.
    space: Vec3,
    /// Its unit direction on the pattern.
    flat: Vec2,
}

impl Way {
    /// Whether the edge has a corner between it and the next.
    fn has_corner(&self, next: &Self) -> bool {
        self.space.dot(next.space).min(self.flat.dot(next.flat)) < CORNER
    }
}

/// A place on an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Where it lies.
    pub(super) at: Point2,
    /// The unit direction of the edge there.
    pub(super) along: Vec2,
}

impl Spot {
    /// The unit direction away from the sheet.
    pub(super) fn outwards(&self) -> Vec2 {
        -self.along.perp()
    }

    /// The point so far ahead along the edge, and so far outwards, mm.
    pub(super) fn beside(&self, ahead: f64, outwards: f64) -> Point2 {
        self.at + self.along * ahead + self.outwards() * outwards
    }
}

impl Stretch {
    /// An edge of a sheet whose vertices lie at `space` and on the pattern at `flat`; `beside` has
    /// the third corner of the triangle to the left of a side.
    pub(super) fn new(
        edge: &Edge,
        space: &[Point3],
        flat: &[Point2],
        beside: &BTreeMap<[usize; 2], usize>,
    ) -> Self {
        let in_space: Vec<Point3> = edge.run.iter().map(|&v| space[v]).collect();
        let apex = |step: &[usize]| beside.get(&[step[0], step[1]]).map(|&v| space[v]);
        Self {
            points: edge.run.iter().map(|&v| flat[v]).collect(),
            lengths: lengths(&in_space),
            apexes: edge.run.windows(2).map(apex).collect(),
            space: in_space,
            is_loop: edge.is_loop(),
        }
    }

    /// How long it is in space, mm.
    pub(super) fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    pub(super) fn is_loop(&self) -> bool {
        self.is_loop
    }

    /// Its points on the pattern, each with the length to it.
    pub(super) fn points(&self) -> impl Iterator<Item = (f64, Point2)> + '_ {
        self.lengths.iter().copied().zip(self.points.iter().copied())
    }

    /// Its ends are gone over where it is closed, and kept to where it is open.
    pub(super) fn within(&self, along: f64) -> f64 {
        let whole = self.length();
        if !self.is_loop || (0.0..=whole).contains(&along) {
            along
        } else {
            along.rem_euclid(whole)
        }
    }

    /// The place at a length from its beginning.
    pub(super) fn at(&self, along: f64) -> Spot {
        let ((n, share), last) = (self.step_at(along), self.points.len() - 2);
        // Exact at both ends, so that places there are corners of the net line.
        let at = match share {
            0.0 => self.points[n],
            1.0 => self.points[n + 1],
            share => self.points[n].lerp(self.points[n + 1], share),
        };
        let way =
            (n..=last).chain((0..n).rev()).find_map(|n| unit2(self.points[n + 1] - self.points[n]));
        Spot { at, along: way.unwrap_or(Vec2::X) }
    }

    /// The step that has the place at a length, and the share of the step up to the place.
    fn step_at(&self, along: f64) -> (usize, f64) {
        let (along, last) = (self.within(along), self.points.len() - 2);
        let n = self.lengths[1..].partition_point(|&length| length < along).min(last);
        let step = self.lengths[n + 1] - self.lengths[n];
        let share =
            if step > 0.0 { ((along - self.lengths[n]) / step).clamp(0.0, 1.0) } else { 0.0 };
        (n, share)
    }

    /// How the sheet lies beside the place at a length; `None` where no triangle is known.
    pub(super) fn face_at(&self, along: f64) -> Option<Face> {
        self.face(self.step_at(along).0)
    }

    fn face(&self, n: usize) -> Option<Face> {
        let from = self.space[n];
        let along = unit(self.space[n + 1] - from)?;
        let across = self.apexes[n]? - from;
        let into = unit(across - along * across.dot(along))?;
        Some(Face { into, up: along.cross(into) })
    }

    /// Its steps that have a length.
    fn ways(&self) -> impl DoubleEndedIterator<Item = Way> + '_ {
        (0..self.points.len() - 1).filter_map(|n| {
            let space = unit(self.space[n + 1] - self.space[n])?;
            let flat = unit2(self.points[n + 1] - self.points[n])?;
            Some(Way { from: self.lengths[n], space, flat })
        })
    }

    /// Whether an edge has a corner where the next one, which may be itself, begins.
    pub(super) fn has_corner_before(&self, next: &Self) -> bool {
        let ends = (self.ways().next_back(), next.ways().next());
        matches!(ends, (Some(arrives), Some(leaves)) if arrives.has_corner(&leaves))
    }

    /// Its corners between its ends: the length to each, mm, and the sine of the turn on the
    /// pattern, positive where the sheet sticks out.
    pub(super) fn corners(&self) -> Vec<(f64, f64)> {
        let ways: Vec<Way> = self.ways().collect();
        let corners = ways.windows(2).filter(|pair| pair[0].has_corner(&pair[1]));
        corners.map(|pair| (pair[1].from, pair[0].flat.perp_dot(pair[1].flat))).collect()
    }

    /// The lengths to the ends of a span and to all points between them, in order.
    pub(super) fn stations(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let inner = self.lengths.iter().copied().filter(|&along| from < along && along < to);
        let mut stations: Vec<f64> = [from].into_iter().chain(inner).chain([to]).collect();
        stations.dedup();
        stations
    }

    /// Where the place at a length lies in space.
    pub(super) fn in_space(&self, along: f64) -> Point3 {
        let (n, share) = self.step_at(along);
        self.space[n].lerp(self.space[n + 1], share)
    }

    /// The points from one length to a larger one, both ends included.
    pub(super) fn part(&self, [from, to]: [f64; 2]) -> Vec<Point2> {
        let whole = self.length();
        let mut line = vec![self.at(from).at];
        let rounds = i32::from(self.is_loop);
        for round in -rounds..=rounds {
            let before = f64::from(round) * whole;
            let inner = self.lengths.iter().zip(&self.points);
            let inner = inner.filter(|&(&along, _)| from < along + before && along + before < to);
            line.extend(inner.map(|(_, &point)| point));
        }
        line.push(self.at(to).at);
        line.dedup();
        line
    }
}

/// A polyline moved to its right by a distance, mm, with its corners where the moved sides meet.
pub(super) fn moved_out(line: &[Point2], by_mm: f64) -> Vec<Point2> {
    let ways: Vec<Vec2> = line.windows(2).filter_map(|step| unit2(step[1] - step[0])).collect();
    let (Some(&first), Some(&last)) = (ways.first(), ways.last()) else { return line.to_vec() };
    let count = line.len();
    let moved = |(n, &p): (usize, &Point2)| {
        let before = if n == 0 { first } else { ways[(n - 1).min(ways.len() - 1)] };
        let after = if n + 1 == count { last } else { ways[n.min(ways.len() - 1)] };
        // The sum of the normals over one plus the cosine of the turn reaches both moved sides.
        let mean = (-before.perp() - after.perp()) * (1.0 / (1.0 + before.dot(after)).max(0.2));
        p + mean * by_mm
    };
    line.iter().enumerate().map(moved).collect()
}
