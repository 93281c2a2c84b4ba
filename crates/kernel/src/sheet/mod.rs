//! A surface as it is cut to lie flat: triangles, with the seams that join it again.
//!
//! Along a cut, every vertex lies on two sides and so becomes two of the sheet. Triangles keep
//! their numbers and the order of their corners. A surface that lies flat as it is has a sheet
//! without seams. Sheets are of one kind, whether their triangles were found from a boundary
//! ([`crate::flatten::lay_flat`]) or given as a mesh ([`cut_along`]).

mod cut;
mod split;

pub use cut::cut_along;
pub(crate) use cut::cut_along_lines;
pub use split::split_along_creases;
pub(crate) use split::split_at;

use crate::mesh::{Mesh, MeshEdge};
use crate::surface::{Hinge, Surface};
use sheetwright_geometry::index::{SampleIndex, VertexIndex};
use sheetwright_geometry::math::{Point2, Point3};
use sheetwright_optimum::rung::Rung;

/// A cut that the pattern needs: its two sides are joined when the sheet is bent.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// Its sides by vertices of the sheet: as many on both, in the direction of the first side, of
    /// which those in one place of the list are joined. The sheet lies to the left of the first
    /// side, and to the right of the second.
    pub sides: [Vec<VertexIndex>; 2],
    /// How long it is in space, mm.
    pub length_mm: f64,
    /// How far apart both places of either end lie on the pattern, the larger of both, mm; 0 until
    /// the sheet is laid flat.
    pub gap_mm: f64,
}

impl Seam {
    /// The steps of both sides along the border of the sheet, which lies to their left.
    pub fn steps(&self) -> [Vec<[VertexIndex; 2]>; 2] {
        let [left, right] = &self.sides;
        let forth = left.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        let back = right.windows(2).rev().map(|pair| [pair[1], pair[0]]).collect();
        [forth, back]
    }

    /// How long both sides are on the pattern, mm, where vertices lie at these points.
    pub fn sides_flat_mm(&self, points: &[Point2]) -> [f64; 2] {
        let step = |pair: &[VertexIndex]| points[pair[0].get()].distance(points[pair[1].get()]);
        self.sides.each_ref().map(|side| side.windows(2).map(step).sum())
    }
}

/// The steps along a loop of vertices, each from a vertex to the next.
pub fn steps_of(line: &[VertexIndex]) -> impl Iterator<Item = [VertexIndex; 2]> + '_ {
    let next = line.iter().cycle().skip(1);
    line.iter().zip(next).map(|(&a, &b)| [a, b])
}

/// A surface cut to lie flat.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    mesh: Mesh,
    origin: Vec<VertexIndex>,
    seams: Vec<Seam>,
    first_seam: usize,
    rung_ends: Vec<[VertexIndex; 2]>,
    tool_folds: Option<ToolFolds>,
    /// The flat face of each triangle; empty where none is known.
    faces: Vec<usize>,
}

/// The folds of a sheet that has, on the flat, what a tool of a radius takes at them.
#[derive(Clone, Debug, PartialEq)]
struct ToolFolds {
    radius_mm: f64,
    /// By the sides of the mesh, in increasing order.
    sides: Vec<usize>,
}

impl Sheet {
    /// The sheet of a surface that is not cut.
    pub fn whole(surface: &Surface) -> Self {
        let origin = (0..surface.positions().len()).map(VertexIndex::new).collect();
        let ends = |hinge: &Hinge| hinge.rung.ends().map(|sample| VertexIndex::new(sample.get()));
        let rung_ends = surface.connectivity().hinges().iter().map(ends).collect();
        Self::new(Mesh::of_surface(surface), origin, Vec::new()).with_rungs(rung_ends)
    }

    /// The sheet of these triangles, whose vertices were those of `origin` before they were cut
    /// along seams with these sides.
    pub(crate) fn new(
        mesh: Mesh,
        origin: Vec<VertexIndex>,
        seams: Vec<[Vec<VertexIndex>; 2]>,
    ) -> Self {
        let step = |pair: &[VertexIndex]| mesh.position(pair[0]).distance(mesh.position(pair[1]));
        let seam = |sides: [Vec<VertexIndex>; 2]| {
            let length_mm = sides[0].windows(2).map(step).sum();
            Seam { sides, length_mm, gap_mm: 0.0 }
        };
        let seams = seams.into_iter().map(seam).collect();
        let (rung_ends, tool_folds, faces) = (Vec::new(), None, Vec::new());
        Self { mesh, origin, seams, first_seam: 0, rung_ends, tool_folds, faces }
    }

    /// The sheet with its vertices elsewhere in space, mm.
    pub(crate) fn moved_to(mut self, positions: Vec<Point3>) -> Self {
        self.mesh = self.mesh.moved_to(positions);
        for seam in &mut self.seams {
            let at = |v: VertexIndex| self.mesh.position(v);
            let steps = seam.sides[0].windows(2).map(|pair| at(pair[0]).distance(at(pair[1])));
            seam.length_mm = steps.sum();
        }
        self
    }

    /// The sheet with rungs, by their ends.
    pub(crate) fn with_rungs(self, rung_ends: Vec<[VertexIndex; 2]>) -> Self {
        Self { rung_ends, ..self }
    }

    /// The sheet with the gaps of its seams, where its vertices lie at these points.
    pub(crate) fn laid_at(mut self, points: &[Point2]) -> Self {
        for seam in &mut self.seams {
            let [left, right] = &seam.sides;
            let gap = |n: usize| points[left[n].get()].distance(points[right[n].get()]);
            seam.gap_mm = gap(0).max(gap(left.len() - 1));
        }
        self
    }

    /// The sheet whose triangles are of these flat faces.
    pub(crate) fn with_faces(self, faces: Vec<usize>) -> Self {
        Self { faces, ..self }
    }

    /// Whether a side of its mesh lies within a flat face: it turns there by rounding alone.
    pub fn is_within_face(&self, edge: &MeshEdge) -> bool {
        let face = |n: usize| edge.triangles[n].and_then(|t| self.faces.get(t.get()));
        face(0).is_some() && face(0) == face(1)
    }

    /// The sheet that a tool of an inner radius folds at these sides of the mesh, in increasing
    /// order.
    pub(crate) fn with_tool_folds(self, radius_mm: f64, sides: Vec<usize>) -> Self {
        Self { tool_folds: Some(ToolFolds { radius_mm, sides }), ..self }
    }

    /// The inner radius of the tool, mm, whose bend allowance the sheet has at the fold along a
    /// side of its mesh; `None` where faces meet as mitred boards do.
    pub(crate) fn fold_radius_mm(&self, side: usize) -> Option<f64> {
        let folds = self.tool_folds.as_ref()?;
        folds.sides.binary_search(&side).is_ok().then_some(folds.radius_mm)
    }

    /// Its triangles in space: along a cut, vertices lie on one another in pairs.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Its border, the sheet to the left; where the surface was found, the outline first.
    pub fn loops(&self) -> &[Vec<VertexIndex>] {
        self.mesh.loops()
    }

    /// The steps of its border, loop after loop, each from a vertex to the next.
    pub fn border_steps(&self) -> impl Iterator<Item = [VertexIndex; 2]> + '_ {
        self.loops().iter().flat_map(|line| steps_of(line))
    }

    /// The vertex of the uncut surface that a vertex of the sheet is: where the surface was found,
    /// of the same number as the sample.
    pub fn origin(&self, vertex: VertexIndex) -> VertexIndex {
        self.origin[vertex.get()]
    }

    /// The sample of the boundary that a vertex of the sheet of a found surface is.
    pub fn sample(&self, vertex: VertexIndex) -> SampleIndex {
        SampleIndex::new(self.origin(vertex).get())
    }

    /// Its seams, in the order of their marks.
    pub fn seams(&self) -> &[Seam] {
        &self.seams
    }

    /// The number that the mark of its first seam shows, counted from 0: seams of the pieces of one
    /// net are counted on from piece to piece.
    pub fn first_seam(&self) -> usize {
        self.first_seam
    }

    /// The sheet whose first seam has this number.
    pub(crate) fn with_first_seam(self, first_seam: usize) -> Self {
        Self { first_seam, ..self }
    }

    /// Where the rungs of a found surface begin and end on the sheet, in their order; of a rung
    /// that is cut, its first side. Empty for a mesh.
    pub fn rung_ends(&self) -> &[[VertexIndex; 2]] {
        &self.rung_ends
    }

    /// The rungs that are left on the sheet, by its own vertices, in increasing order: the sides
    /// that join two triangles.
    pub fn rungs(&self) -> Vec<Rung> {
        let within = self.mesh.edges().iter().filter(|edge| !edge.is_border());
        within.map(|edge| Rung::new(edge.ends[0].get(), edge.ends[1].get())).collect()
    }

    /// Whether its surface was found and has rungs: not that of a mesh, nor one triangle alone.
    pub fn has_rungs(&self) -> bool {
        !self.rung_ends.is_empty()
    }

    /// The rung that a seam of a found surface was cut along.
    pub fn seam_rung(&self, seam: &Seam) -> Rung {
        let [from, to] = [seam.sides[0][0], seam.sides[0][seam.sides[0].len() - 1]];
        Rung::new(self.origin(from).get(), self.origin(to).get())
    }

    /// The vertex that comes after one on the border; `None` for a vertex inside.
    pub fn next_on_border(&self, vertex: VertexIndex) -> Option<VertexIndex> {
        self.loops().iter().find_map(|of_loop| {
            let at = of_loop.iter().position(|&v| v == vertex)?;
            Some(of_loop[(at + 1) % of_loop.len()])
        })
    }
}
