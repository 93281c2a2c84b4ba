//! A part as it lies in a picture of space: its triangles and its lines, whether its surface was
//! found or given.

use super::raster::Facet;
use super::rungs::{MOST_RUNGS, rung_classes};
use super::scene::is_front;
use super::view::View;
use sheetwright::index::{SampleIndex, TriangleIndex, VertexIndex};
use sheetwright::make::{Found, Given, Origin, Part};
use sheetwright::material::Material;
use sheetwright::math::{Point2, Point3, Vec3, from_deg};
use sheetwright::mesh::SCORED_CREASE_DEG;
use sheetwright::mesh::crease_angles;
use sheetwright::sheet::Sheet;
use std::collections::BTreeSet;

/// A side that joins two triangles: its ends, and the numbers of the triangles.
type Hinge = ([usize; 2], [usize; 2]);

/// The surface of a part with the lines that are drawn on it, by its points.
pub(crate) struct Solid {
    pub(crate) positions: Vec<Point3>,
    triangles: Vec<[usize; 3]>,
    /// The area vectors of the triangles.
    pub(crate) areas: Vec<Vec3>,
    hinges: Vec<Hinge>,
    /// The loops of the border.
    pub(crate) loops: Vec<Vec<usize>>,
    /// The steps of the border, without the sides of cuts.
    pub(crate) border: Vec<[usize; 2]>,
    /// The steps of the cuts.
    pub(crate) cuts: Vec<[usize; 2]>,
    /// The sharp creases of a mesh.
    pub(crate) creases: Vec<[usize; 2]>,
    /// The class of every rung that is drawn; the rungs are the hinges of a found surface.
    pub(crate) rungs: Vec<Option<&'static str>>,
}

impl Solid {
    pub(crate) fn of(part: &Part, material: Option<&Material>) -> Self {
        match &part.origin {
            Origin::Found(found) => Self::of_surface(part, found, material),
            Origin::Given(given) => Self::of_mesh(&part.sheet, given),
        }
    }

    fn of_surface(part: &Part, found: &Found, material: Option<&Material>) -> Self {
        let (surface, connectivity) = (&found.surface, found.surface.connectivity());
        let triangles = connectivity.triangles();
        let hinges = connectivity.hinges().iter();
        let seams = part.sheet.seams().iter();
        Self {
            positions: surface.positions().to_vec(),
            triangles: triangles.iter().map(|t| t.map(SampleIndex::get)).collect(),
            areas: (0..triangles.len())
                .map(|n| surface.area_vector(TriangleIndex::new(n)))
                .collect(),
            hinges: hinges
                .map(|h| (h.rung.ends().map(SampleIndex::get), h.triangles.map(|t| t.get())))
                .collect(),
            loops: connectivity.loops().iter().map(|range| range.clone().collect()).collect(),
            border: connectivity.edges().map(|edge| edge.map(SampleIndex::get)).collect(),
            cuts: seams
                .map(|seam| part.sheet.seam_rung(seam).ends().map(SampleIndex::get))
                .collect(),
            creases: Vec::new(),
            rungs: rung_classes(part, material, MOST_RUNGS),
        }
    }

    fn of_mesh(sheet: &Sheet, given: &Given) -> Self {
        let mesh = sheet.mesh();
        let hinge = |edge: &sheetwright::mesh::MeshEdge| {
            let [Some(first), Some(second)] = edge.triangles else { return None };
            Some((edge.ends.map(VertexIndex::get), [first.get(), second.get()]))
        };
        let cut: BTreeSet<[VertexIndex; 2]> =
            sheet.seams().iter().flat_map(|seam| seam.steps()).flatten().collect();
        let border = sheet.border_steps().filter(|step| !cut.contains(step));
        let cuts = sheet.seams().iter().flat_map(|seam| {
            let [first, _] = seam.steps();
            first
        });
        let is_sharp = |angle: f64| angle > from_deg(SCORED_CREASE_DEG);
        let creases = mesh.edges().iter().zip(crease_angles(mesh));
        Self {
            positions: mesh.positions().to_vec(),
            triangles: mesh.triangles().iter().map(|t| t.map(VertexIndex::get)).collect(),
            areas: (0..mesh.triangles().len())
                .map(|n| given.mesh.area_vector(TriangleIndex::new(n)))
                .collect(),
            hinges: mesh.edges().iter().filter_map(hinge).collect(),
            loops: sheet.loops().iter().map(|l| l.iter().map(|v| v.get()).collect()).collect(),
            border: border.map(|step| step.map(VertexIndex::get)).collect(),
            cuts: cuts.map(|step| step.map(VertexIndex::get)).collect(),
            creases: creases
                .filter(|(_, angle)| is_sharp(*angle))
                .map(|(edge, _)| edge.ends.map(VertexIndex::get))
                .collect(),
            rungs: Vec::new(),
        }
    }
}

/// A part as it lies in the picture.
pub(crate) struct Drawn {
    pub(crate) solid: Solid,
    /// Where its points lie in the picture.
    pub(crate) points: Vec<Point2>,
    /// Their nearness to the eye, mm.
    near: Vec<f64>,
}

impl Drawn {
    pub(crate) fn new(solid: Solid, view: &View, points: Vec<Point2>) -> Self {
        let near = solid.positions.iter().map(|&p| view.nearness(p)).collect();
        Self { solid, points, near }
    }

    /// Its triangles in their shades.
    pub(crate) fn facets<'a>(&'a self, shades: &'a [u16]) -> impl Iterator<Item = Facet> + 'a {
        self.solid.triangles.iter().zip(shades).map(|(corners, &class)| Facet {
            corners: corners.map(|n| self.points[n]),
            near: corners.map(|n| self.near[n]),
            class,
        })
    }

    /// The ends of a line in the picture, and their nearness to the eye, mm.
    pub(crate) fn line(&self, ends: [usize; 2]) -> ([Point2; 2], [f64; 2]) {
        (ends.map(|n| self.points[n]), ends.map(|n| self.near[n]))
    }

    /// The rungs of a class, each with its ends and whether it lies on the front and on the back,
    /// given the shades of the triangles.
    pub(crate) fn rungs_of<'a>(
        &'a self,
        class: &'static str,
        shades: &'a [u16],
    ) -> impl Iterator<Item = ([usize; 2], [bool; 2])> + 'a {
        let rungs = self.solid.hinges.iter().zip(&self.solid.rungs);
        let of_class = rungs.filter(move |(_, c)| **c == Some(class));
        of_class.map(|(hinge, _)| (hinge.0, sides(hinge, shades)))
    }

    /// The silhouette, where the surface turns away from the eye: the sides between its front and
    /// its back.
    pub(crate) fn turns<'a>(&'a self, shades: &'a [u16]) -> impl Iterator<Item = [usize; 2]> + 'a {
        let turning = self.solid.hinges.iter().filter(|hinge| sides(hinge, shades) == [true; 2]);
        turning.map(|(ends, _)| *ends)
    }
}

/// Whether one of the triangles of a side is seen from the front, and one from the back.
fn sides((_, triangles): &Hinge, shades: &[u16]) -> [bool; 2] {
    let front = triangles.map(|t| is_front(shades[t]));
    [front[0] || front[1], !front[0] || !front[1]]
}
