//! How the nodes of the border are held.
//!
//! The border lies on the boundary, and so does every point of it. Either each stays where the
//! surface has it, by its length along the outline, as where an edge is fastened before the sheet
//! is bent. Or edges slide: a point may lie anywhere along the boundary, as where a plank is pulled
//! onto its stringers and fastened then. Sheets are strained less so.
//!
//! A node that slides has one unknown instead of three: how far along a track it lies. A track is
//! the twice differentiable spline through the nodes of an edge from corner to corner, so Newton's
//! method has slopes and curvatures of it, and goes on straight beyond its ends. A corner stays,
//! since it lies on two edges, unless one of them is let go: then it slides along the other. Edges
//! that were cut open are held, since both sides lie on one another. Where nothing else stays, the
//! middle of the longest edge does, as the place that is fastened first.

use crate::sheet::Sheet;
use sheetwright_geometry::curve::{Cubic, Curve, CurveKind, CurvePoint};
use sheetwright_geometry::index::{SampleIndex, VertexIndex};
use sheetwright_geometry::math::{Point3, Vec3};
use std::collections::BTreeMap;

/// What holds the border of a sheet, step by step from vertex to vertex. Default: every step stays.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edges {
    /// The steps that do not stay.
    loose: BTreeMap<[VertexIndex; 2], Edge>,
}

impl Edges {
    /// The edges of the sheet of a found surface slide, but those along its seams. Nothing holds
    /// the steps from one sample to the next that are `free`.
    pub fn sliding(sheet: &Sheet, free: &[[SampleIndex; 2]]) -> Self {
        let cut: Vec<[VertexIndex; 2]> =
            sheet.seams().iter().flat_map(|s| s.steps().concat()).collect();
        let edge = |step: [VertexIndex; 2]| {
            let is_free = free.contains(&step.map(|v| sheet.sample(v)));
            (step, if is_free { Edge::IsFree } else { Edge::Slides })
        };
        let open = sheet.border_steps().filter(|step| !cut.contains(step));
        Self { loose: open.map(edge).collect() }
    }

    /// Those of a sheet that was cut further: it is held along the cuts.
    pub(super) fn of_cut(&self, cut: &Sheet) -> Self {
        let edge =
            |step: [VertexIndex; 2]| Some((step, *self.loose.get(&step.map(|v| cut.origin(v)))?));
        Self { loose: cut.border_steps().filter_map(edge).collect() }
    }

    /// What holds a step of the border.
    pub(super) fn of(&self, step: [VertexIndex; 2]) -> Edge {
        self.loose.get(&step).copied().unwrap_or(Edge::Stays)
    }
}

/// What holds an edge of the outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Edge {
    /// Every point of it stays.
    Stays,
    /// It may slide along the boundary.
    Slides,
    /// Nothing holds it.
    IsFree,
}

/// How a node may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// Everywhere.
    Free,
    /// It stays.
    Stays,
    /// Along a track, by its number; at first it lies so far along it, mm.
    Slides { track: usize, at_mm: f64 },
}

/// A stretch of a loop of nodes, from one corner of the outline to the next, both included.
pub(super) struct Stretch {
    pub(super) nodes: Vec<usize>,
    pub(super) edge: Edge,
}

/// How every node is held.
#[derive(Default)]
pub(super) struct Holds {
    of_nodes: Vec<Hold>,
    tracks: Vec<Track>,
}

impl Holds {
    /// Nodes at these places in space are held as the stretches of the border say that they lie on,
    /// component by component.
    pub(super) fn new(space: &[Point3], components: &[Vec<Stretch>]) -> Self {
        let mut holds = Self { of_nodes: vec![Hold::Free; space.len()], tracks: Vec::new() };
        for stretches in components {
            holds.add(space, stretches);
        }
        holds
    }

    fn add(&mut self, space: &[Point3], stretches: &[Stretch]) {
        // Edges in the order in which they decide: what lies on two that hold it stays.
        let mut longest: Option<(f64, usize)> = None;
        for stretch in stretches.iter().filter(|stretch| stretch.edge == Edge::Slides) {
            let points: Vec<Point3> = stretch.nodes.iter().map(|&n| space[n]).collect();
            let Some(track) = Track::through(&points) else {
                stretch.nodes.iter().for_each(|&n| self.of_nodes[n] = Hold::Stays);
                continue;
            };
            let number = self.tracks.len();
            for (&n, &at_mm) in stretch.nodes.iter().zip(&track.knots_mm) {
                self.of_nodes[n] = match self.of_nodes[n] {
                    Hold::Free => Hold::Slides { track: number, at_mm },
                    _ => Hold::Stays,
                };
            }
            let length = track.length_mm();
            if longest.is_none_or(|(most, _)| length > most) {
                longest = Some((length, stretch.nodes[stretch.nodes.len() / 2]));
            }
            self.tracks.push(track);
        }
        for stretch in stretches.iter().filter(|stretch| stretch.edge == Edge::Stays) {
            stretch.nodes.iter().for_each(|&n| self.of_nodes[n] = Hold::Stays);
        }
        let nodes = || stretches.iter().flat_map(|stretch| &stretch.nodes);
        let stays = nodes().any(|&n| self.of_nodes[n] == Hold::Stays);
        if let (false, Some((_, middle))) = (stays, longest) {
            self.of_nodes[middle] = Hold::Stays;
        }
    }

    /// How a node may move.
    pub(super) fn of(&self, node: usize) -> Hold {
        self.of_nodes[node]
    }

    /// How far every node lies along its track at first, mm; 0 of those that are on none.
    pub(super) fn begin_mm(&self) -> Vec<f64> {
        let at = |hold: &Hold| match hold {
            Hold::Slides { at_mm, .. } => *at_mm,
            _ => 0.0,
        };
        self.of_nodes.iter().map(at).collect()
    }

    /// The place of a track so far along it.
    pub(super) fn place(&self, track: usize, at_mm: f64) -> OnTrack {
        self.tracks[track].place(at_mm)
    }
}

/// An edge in space, along which nodes slide.
struct Track {
    /// From node to node.
    spans: Vec<Cubic>,
    /// How far along it each node lies, by chords, mm.
    knots_mm: Vec<f64>,
}

/// A place on a track.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnTrack {
    pub(super) at: Point3,
    /// Its derivatives by the length along the track: how it goes on, without unit, and how that
    /// changes, 1/mm.
    pub(super) along: Vec3,
    pub(super) turn: Vec3,
}

impl Track {
    fn through(points: &[Point3]) -> Option<Self> {
        let smooth: Vec<CurvePoint> = points.iter().copied().map(CurvePoint::smooth).collect();
        let curve = Curve::new(CurveKind::Spline, &smooth, false).ok()?;
        let mut knots_mm = vec![0.0];
        for pair in points.windows(2) {
            knots_mm.push(knots_mm[knots_mm.len() - 1] + pair[0].distance(pair[1]));
        }
        Some(Self { spans: curve.spans().to_vec(), knots_mm })
    }

    fn length_mm(&self) -> f64 {
        self.knots_mm[self.knots_mm.len() - 1]
    }

    fn place(&self, at_mm: f64) -> OnTrack {
        let within = at_mm.clamp(0.0, self.length_mm());
        let last = self.spans.len() - 1;
        let n = self.knots_mm.partition_point(|&knot| knot <= within).clamp(1, last + 1) - 1;
        let h = self.knots_mm[n + 1] - self.knots_mm[n];
        let t = (within - self.knots_mm[n]) / h;
        let span = &self.spans[n];
        let (at, along) = (span.position(t), span.derivative(t) / h);
        let beyond = at_mm - within;
        let turn = if beyond == 0.0 { span.second_derivative(t) / (h * h) } else { Vec3::ZERO };
        OnTrack { at: at + along * beyond, along, turn }
    }
}
