//! A part: one piece of sheet of a panel, whether its surface was found or given.

use super::Rebuilt;
use crate::bend::Blank;
use crate::check::{BoundaryMoved, Checked};
use crate::design::{Bends, PanelMethod, Thick, VaryGoal};
use crate::edge::{Edge, EdgeSource};
use crate::elastic::Predicted;
use crate::fair::{self, Shift};
use crate::flatten::{Aim, Ended, Flattened};
use crate::measure::Measures;
use crate::mesh::Mesh;
use crate::pattern::{Piece, seam_mark};
use crate::sample::Chords;
use crate::sheet::Sheet;
use crate::surface::Surface;
use sheetwright_geometry::boundary::{Boundary, Outline, SupportingPlane};
use sheetwright_geometry::index::{SampleIndex, VertexIndex};
use sheetwright_geometry::math::{Point2, Point3};
use sheetwright_optimum::triangulate::{Goal, Triangulation};

/// A part with everything that was derived from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name: that of its panel, with a number where a mesh makes several parts.
    pub name: String,
    /// The panel of the design that it is made of, by name.
    pub panel: String,
    /// Its surface as it is cut open to lie flat: where the thickness counts, the neutral one with
    /// its faces moved so that folds have what their bends take ([`crate::bend`]).
    pub sheet: Sheet,
    /// Its sheet laid flat.
    pub flat: Flattened,
    /// Its measures.
    pub measures: Measures,
    /// The strain that it is predicted to have in its shape; `None` of one triangle that was found.
    pub predicted: Option<Predicted>,
    /// The verdict and its findings.
    pub checked: Checked,
    /// The pattern to cut.
    pub piece: Piece,
    /// The thickness of its sheet and the face that was drawn, where its pattern is that of the
    /// neutral surface.
    pub thick: Option<Thick>,
    /// How its bends are marked on the pattern.
    pub bends: Bends,
    /// The edges of its sheet, in the order of the loops; mates are parts of one [`super::Made`].
    pub edges: Vec<Edge>,
    /// The boundary or the mesh that it was made from.
    pub origin: Origin,
}

/// The boundary or the mesh that a part was made from.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// A boundary, for which the surface was found.
    Found(Box<Found>),
    /// A mesh, whose surface was given.
    Given(Box<Given>),
}

/// The boundary of a part, and the surface that was found for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Which triangulations were searched.
    pub method: PanelMethod,
    /// The quantity that was minimised.
    pub goal: Goal,
    /// The weight ν of the fold price.
    pub fold: f64,
    /// Whether its edges slide along the boundary while it is bent.
    pub slides: bool,
    /// The steps along the straight ends between two rails; none of any other boundary.
    pub(crate) ends: Vec<[SampleIndex; 2]>,
    /// The boundary as it was sampled.
    pub boundary: Boundary,
    /// The curves between the samples of the boundary.
    pub outline: Outline,
    /// How far the straight steps between the samples lie from those curves.
    pub chords: Chords,
    /// The tolerance that its number of samples was chosen for, mm, if it was.
    pub tolerance_mm: Option<f64>,
    /// The supporting plane, if there is one.
    pub plane: Option<SupportingPlane>,
    /// Its triangulation.
    pub triangulation: Triangulation,
    /// Its surface in space.
    pub surface: Surface,
    /// How its boundary was moved, if it was to be.
    pub change: Option<Change>,
    /// The other surface that fits its boundary about as well, if it was looked for and there is
    /// one.
    pub other: Option<Other>,
}

/// The other surface that fits a boundary about as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Other {
    /// The part that it makes, judged as this one is; its edges have no names.
    pub part: Box<Part>,
    /// How far both surfaces are apart, mm.
    pub apart_mm: f64,
}

/// The mesh of a part, and how it was laid flat.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Its surface in space.
    pub mesh: Mesh,
    /// The length error that flattening minimised.
    pub aim: Aim,
    /// How flattening ended.
    pub ended: Ended,
    /// How many triangles lie upside down when it is flat.
    pub flipped: usize,
    /// Where it is joined to the parts that its panel was divided into.
    pub joints: Vec<Joint>,
    /// The optimal surface of its border alone, if meshes are divided along creases and there is
    /// one.
    pub rebuilt: Option<Rebuilt>,
    /// Whether it is a piece of a net, folded between facets and stretched nowhere.
    pub is_net: bool,
}

/// A line along which a part of a mesh is joined to another, where the mesh was divided.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its mark on both parts.
    pub mark: String,
    /// The number of the other part in the design.
    pub with: usize,
    /// How long it is in space, mm.
    pub length_mm: f64,
    /// The steps of the border along it, by vertices of the sheet, which lies to their left.
    pub steps: Vec<[VertexIndex; 2]>,
    /// Its number among the lines along which its panel was divided, and that of the other part
    /// among those of the panel.
    pub(super) in_panel: (usize, usize),
}

impl Joint {
    /// How long it is on the pattern of its part, whose vertices lie at these points, mm.
    pub fn flat_mm(&self, points: &[Point2]) -> f64 {
        self.steps.iter().map(|[a, b]| points[a.get()].distance(points[b.get()])).sum()
    }
}

impl Part {
    /// It as it comes to a press brake.
    pub fn blank(&self) -> Blank<'_> {
        Blank {
            lines: &self.piece.bends,
            outline: self.piece.outline(),
            edges: &self.edges,
            flat: &self.flat.points,
        }
    }

    /// Its boundary and the surface that was found for it; `None` of a mesh.
    pub fn found(&self) -> Option<&Found> {
        match &self.origin {
            Origin::Found(found) => Some(found),
            Origin::Given(_) => None,
        }
    }

    /// The mesh that was given; `None` of a boundary.
    pub fn given(&self) -> Option<&Given> {
        match &self.origin {
            Origin::Given(given) => Some(given),
            Origin::Found(_) => None,
        }
    }

    /// Where its vertices lie in space before it is cut, mm; the samples of its boundary, where its
    /// surface was found.
    pub fn positions(&self) -> &[Point3] {
        match &self.origin {
            Origin::Found(found) => found.surface.positions(),
            Origin::Given(given) => given.mesh.positions(),
        }
    }

    /// Where the vertices of its sheet were drawn, mm. The sheet itself lies apart from there where
    /// the thickness counts, and so do those of parts that were drawn to meet.
    pub(super) fn drawn(&self) -> Vec<Point3> {
        let drawn = self.positions();
        let vertices = (0..self.sheet.mesh().positions().len()).map(VertexIndex::new);
        vertices.map(|v| drawn[self.sheet.origin(v).get()]).collect()
    }

    /// Its triangles before it is cut, by those vertices, in the order of those of its sheet.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let corners = |t: &[VertexIndex; 3]| t.map(|v| self.sheet.origin(v).get());
        self.sheet.mesh().triangles().iter().map(corners)
    }

    /// By how much the polygon through the samples of an edge is shorter than its curve, mm; `None`
    /// along a cut and where no curve is known.
    pub fn curve_shorter_mm(&self, edge: &Edge) -> Option<f64> {
        let found = self.found().filter(|_| !matches!(edge.source, EdgeSource::Cut { .. }))?;
        let from = edge.run.split_last().map_or(&[][..], |(_, from)| from);
        found.chords.shorter_mm(from.iter().map(|&v| self.sheet.sample(VertexIndex::new(v)).get()))
    }

    /// The marks by which its pattern shows an edge, `S1` for a side of a cut, or `J1` where a mesh
    /// was divided, on the sides `with` a part if one is given; none of an edge that has a name
    /// there.
    pub fn edge_marks(&self, edge: &Edge, with: Option<usize>) -> Vec<String> {
        if let EdgeSource::Cut { number, .. } = edge.source {
            return vec![seam_mark(self.sheet.first_seam() + number)];
        }
        let joints = self.given().map_or(&[][..], |given| &given.joints);
        let mut steps: Vec<[usize; 2]> =
            edge.run.windows(2).map(|step| [step[0], step[1]]).collect();
        steps.sort_unstable();
        let is_along =
            |step: &[VertexIndex; 2]| steps.binary_search(&step.map(VertexIndex::get)).is_ok();
        let of_edge = joints.iter().filter(|joint| with.is_none_or(|with| joint.with == with));
        let marks = of_edge.filter(|joint| joint.steps.iter().any(is_along));
        marks.map(|joint| joint.mark.clone()).collect()
    }

    /// How its boundary was moved, if it has one that was to be.
    pub fn change(&self) -> Option<&Change> {
        self.found().and_then(|found| found.change.as_ref())
    }
}

/// How the boundary of a panel was moved, and the part before.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The part before.
    pub before: Box<Part>,
    /// How moving ended. Rungs that resist are those of the panels that were moved together.
    pub ended: fair::Ended,
    /// The goal of moving.
    pub goal: VaryGoal,
    /// The curves of the panel that moved, by name.
    pub curves: Vec<String>,
    /// For each sample, its place on the boundary before and now, mm.
    pub moved: Vec<[Point3; 2]>,
}

impl Change {
    pub(super) fn new(before: Part, shift: &Shift) -> Self {
        Self {
            before: Box::new(before),
            ended: shift.ended.clone(),
            goal: shift.goal,
            curves: shift.curves.clone(),
            moved: shift.moved.clone(),
        }
    }

    /// The largest distance that a sample was moved, mm.
    pub fn moved_max_mm(&self) -> f64 {
        self.moved_mm().fold(0.0, f64::max)
    }

    /// All distances that samples were moved, summed, mm.
    pub fn moved_total_mm(&self) -> f64 {
        self.moved_mm().sum()
    }

    fn moved_mm(&self) -> impl Iterator<Item = f64> {
        self.moved.iter().map(|[from, to]| from.distance(*to))
    }

    /// The data of the finding on it; `now` is the part as it was moved. `None` for a mesh, which
    /// does not move.
    pub(super) fn said<'a>(&'a self, now: &'a Part) -> Option<BoundaryMoved<'a>> {
        Some(BoundaryMoved {
            ended: &self.ended,
            wanted: match self.goal {
                VaryGoal::Warp { largest } => Some(largest),
                VaryGoal::Price | VaryGoal::Strain { .. } => None,
            },
            curves: &self.curves,
            moved_max_mm: self.moved_max_mm(),
            moved_total_mm: self.moved_total_mm(),
            size_mm: now.found()?.boundary.size(),
            before: &self.before.measures,
            after: &now.measures,
            checked: &now.checked,
        })
    }
}
