//! A part as trims see it: its edges on the flat pattern, loop after loop.

use super::stretch::Stretch;
use crate::edge::Edge;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3};
use sheetwright_geometry::predicate::{Box2, signed_area_doubled};
use std::collections::BTreeMap;

/// A part whose edges have their mates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrimPart<'a> {
    /// Its name.
    pub(crate) name: &'a str,
    /// The panel that it is made of.
    pub(crate) panel: &'a str,
    /// Its edges, in the order of the loops.
    pub(crate) edges: &'a [Edge],
    /// How its pattern shows each of them: by a mark, or by its name.
    pub(crate) shown: &'a [String],
    /// Where the vertices of its sheet were drawn in space, mm.
    pub(crate) space: &'a [Point3],
    /// Where they lie on the pattern, mm.
    pub(crate) flat: &'a [Point2],
    /// The triangles of its sheet, counter-clockwise as the pattern is seen.
    pub(crate) triangles: &'a [[VertexIndex; 3]],
}

impl TrimPart<'_> {
    /// The name of an edge in designs, `PART/EDGE`.
    pub(super) fn called(&self, edge: &Edge) -> String {
        format!("{}/{}", self.name, edge.name)
    }

    /// What its pattern shows of an edge, `PART/MARK` or `PART/EDGE`.
    pub(super) fn shown(&self, number: usize) -> String {
        format!("{}/{}", self.name, self.shown[number])
    }

    /// The numbers of the edges of each loop, in its order.
    pub(super) fn loops(&self) -> Vec<Vec<usize>> {
        let mut loops: Vec<Vec<usize>> = Vec::new();
        let mut start = None;
        for (number, edge) in self.edges.iter().enumerate() {
            match (start, loops.last_mut()) {
                (Some(_), Some(last)) => last.push(number),
                _ => {
                    start = edge.run.first();
                    loops.push(vec![number]);
                }
            }
            if edge.run.last() == start {
                start = None;
            }
        }
        loops
    }

    /// The net lines, one a loop, in the order of the edges.
    pub(super) fn net(&self) -> Vec<Vec<Point2>> {
        let line = |edges: &Vec<usize>| {
            let runs = edges.iter().map(|&edge| &self.edges[edge].run);
            runs.flat_map(|run| &run[..run.len() - 1]).map(|&v| self.flat[v]).collect()
        };
        self.loops().iter().map(line).collect()
    }

    /// Whether an edge is part of a loop other than the outline.
    pub(super) fn is_around_hole(&self, number: usize) -> bool {
        let area = |line: &Vec<Point2>| signed_area_doubled(line).abs();
        let areas: Vec<f64> = self.net().iter().map(area).collect();
        let of_edge = self.loops().iter().position(|edges| edges.contains(&number));
        of_edge.is_some_and(|n| areas.iter().any(|&other| other > areas[n]))
    }

    /// The shorter side of the box around it, mm.
    pub(super) fn shorter_mm(&self) -> f64 {
        let around = Box2::of_points(self.net().into_iter().flatten());
        around.map_or(0.0, |around| {
            let size = around.max - around.min;
            size.x.min(size.y)
        })
    }

    pub(super) fn stretches(&self) -> Vec<Stretch> {
        let mut beside: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for corners in self.triangles {
            let [a, b, c] = corners.map(VertexIndex::get);
            beside.extend([([a, b], c), ([b, c], a), ([c, a], b)]);
        }
        let stretch = |edge| Stretch::new(edge, self.space, self.flat, &beside);
        self.edges.iter().map(stretch).collect()
    }
}
