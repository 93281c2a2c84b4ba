//! The pieces that a sheet was divided into, each with its own numbers of vertices, and the cuts
//! between them.

use crate::divide::{Border, DivideFault, Dividing, Vertex};
use crate::edge::runs;
use crate::make::part::Part;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3};
use std::collections::BTreeMap;
use std::ops::Range;

/// The sheet of a part before it is divided.
pub(super) fn whole_sheet(whole: &Part) -> Dividing {
    let (mesh, drawn) = (whole.sheet.mesh(), whole.drawn());
    let vertex = |n: usize| Vertex {
        space: mesh.positions()[n],
        drawn: drawn[n],
        flat: whole.flat.points[n],
        between: vec![n],
    };
    let vertices = (0..mesh.positions().len()).map(vertex).collect();
    let triangles: Vec<[usize; 3]> =
        mesh.triangles().iter().map(|corners| corners.map(VertexIndex::get)).collect();
    Dividing::new(vertices, &triangles)
}

/// A piece. Its vertices have numbers of their own: those of the border first, loop after loop.
pub(super) struct Cutout<'a> {
    dividing: &'a Dividing,
    border: Border,
    /// Its vertices by those numbers, as vertices of the sheet that is divided.
    vertices: Vec<usize>,
    /// Its triangles by those numbers.
    triangles: Vec<[usize; 3]>,
}

impl<'a> Cutout<'a> {
    pub(super) fn new(dividing: &'a Dividing, piece: usize) -> Result<Self, DivideFault> {
        let border = dividing.border(piece)?;
        let mut vertices: Vec<usize> = border.loops.concat();
        let mut number: BTreeMap<usize, usize> =
            vertices.iter().enumerate().map(|(n, &v)| (v, n)).collect();
        let mut inside: Vec<usize> =
            dividing.facets(piece).flatten().filter(|v| !number.contains_key(v)).collect();
        inside.sort_unstable();
        inside.dedup();
        for v in inside {
            number.insert(v, vertices.len());
            vertices.push(v);
        }
        let triangles = dividing.facets(piece).map(|corners| corners.map(|v| number[&v])).collect();
        Ok(Self { dividing, border, vertices, triangles })
    }

    pub(super) fn border(&self) -> &Border {
        &self.border
    }

    pub(super) fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// The numbers of the vertices of each loop.
    pub(super) fn loops(&self) -> Vec<Range<usize>> {
        let mut start = 0;
        let range = |line: &Vec<usize>| {
            let range = start..start + line.len();
            start = range.end;
            range
        };
        self.border.loops.iter().map(range).collect()
    }

    pub(super) fn vertices(&self) -> impl Iterator<Item = &'a Vertex> + '_ {
        self.vertices.iter().map(|&v| self.dividing.vertex(v))
    }

    pub(super) fn vertex(&self, number: usize) -> &'a Vertex {
        self.dividing.vertex(self.vertices[number])
    }

    pub(super) fn space(&self) -> Vec<Point3> {
        self.vertices().map(|vertex| vertex.space).collect()
    }

    pub(super) fn drawn(&self) -> Vec<Point3> {
        self.vertices().map(|vertex| vertex.drawn).collect()
    }

    /// Where they lie on the pattern of the whole, mm.
    pub(super) fn flat(&self) -> Vec<Point2> {
        self.vertices().map(|vertex| vertex.flat).collect()
    }

    /// A side by the vertices of the sheet that is divided.
    pub(super) fn side(&self, ends: [usize; 2]) -> [usize; 2] {
        ends.map(|v| self.vertices[v])
    }

    /// The side of the whole sheet that two vertices lie on, lower end first.
    pub(super) fn whole_side(&self, ends: [usize; 2]) -> Option<[usize; 2]> {
        let [a, b] = ends.map(|v| self.vertex(v));
        let mut between: Vec<usize> = a.between.iter().chain(&b.between).copied().collect();
        between.sort_unstable();
        between.dedup();
        <[usize; 2]>::try_from(between).ok()
    }

    /// The vertex of the whole sheet that each of its vertices is, if it is one.
    pub(super) fn whole_vertex(&self, number: usize) -> Option<usize> {
        match self.vertex(number).between[..] {
            [alone] => Some(alone),
            _ => None,
        }
    }

    /// By the vertices of the whole sheet, the numbers of those that are left.
    pub(super) fn numbers(&self) -> BTreeMap<usize, usize> {
        let all = 0..self.vertices.len();
        all.filter_map(|n| Some((self.whole_vertex(n)?, n))).collect()
    }
}

/// A cut between two pieces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Division {
    /// The pieces on both sides, by their places in the list.
    pub(super) pieces: [usize; 2],
    /// Its steps along the border of the first piece, by vertices of the sheet that is divided.
    pub(super) steps: Vec<[usize; 2]>,
}

/// The cuts between some pieces, in the order in which the pieces meet them.
pub(super) fn divisions(cutouts: &[Cutout<'_>]) -> Vec<Division> {
    let mut of_step: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for (n, cutout) in cutouts.iter().enumerate() {
        of_step.extend(cutout.border.steps().map(|step| (step, n)));
    }
    let mut found = Vec::new();
    for (n, cutout) in cutouts.iter().enumerate() {
        for line in &cutout.border.loops {
            let next = line.iter().cycle().skip(1);
            let beside = line.iter().zip(next).map(|(&a, &b)| (a, of_step.get(&[b, a]).copied()));
            for (beside, run) in runs(&beside.collect::<Vec<_>>()) {
                if let Some(other) = beside.filter(|&other| other > n) {
                    let steps = run.windows(2).map(|pair| [pair[0], pair[1]]).collect();
                    found.push(Division { pieces: [n, other], steps });
                }
            }
        }
    }
    found
}

/// The sides of cuts by the steps of the borders that they lie on: the number of the cut, and
/// whether it is its second side.
pub(super) fn sides_of(divisions: &[Division]) -> BTreeMap<[usize; 2], (usize, bool)> {
    let both = |(number, division): (usize, &Division)| {
        let forth = division.steps.iter().map(move |&step| (step, (number, false)));
        let back = division.steps.iter().map(move |&[a, b]| ([b, a], (number, true)));
        forth.chain(back).collect::<Vec<_>>()
    };
    divisions.iter().enumerate().flat_map(both).collect()
}

/// A vertex by its number in the sheet of a piece.
pub(super) fn in_sheet(vertex: usize) -> VertexIndex {
    VertexIndex::new(vertex)
}
