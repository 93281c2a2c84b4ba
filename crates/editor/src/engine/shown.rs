//! What panes show of a made panel: plain numbers, which cross from a worker to the page.

use super::Refusal;
use sheetwright::check::{Finding, FindingKind, Place, Verdict};
use sheetwright::elastic::Predicted;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Origin, Part};
use sheetwright::material::{Material, warp_limit_deg};
use sheetwright::math::{Point2, Point3, Vec3, to_deg};
use sheetwright::measure::length_errors;
use sheetwright::pattern::Piece;

/// A part of a panel that was made, or a panel that was not.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownPanel {
    /// The name of the part, or of the panel.
    pub name: String,
    /// The panel of the design, by name.
    pub panel: String,
    /// What was made of it, or why nothing was.
    pub made: Result<Shown, Refusal>,
}

impl ShownPanel {
    /// How bad it is: 0 where it bends, more the worse, most where it could not be made.
    pub fn badness(&self) -> usize {
        let place = |shown: &Shown| Verdict::ALL.iter().position(|v| *v == shown.verdict);
        self.made.as_ref().ok().and_then(place).unwrap_or(Verdict::ALL.len())
    }
}

/// How far a panel twists, in the order of how bad that is: what the sampling may explain comes
/// first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Whether the sampling does not explain it.
    pub is_sure: bool,
    /// The warp angle, degrees.
    pub deg: f64,
}

impl Eq for Twist {}

impl Ord for Twist {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.is_sure.cmp(&other.is_sure).then(self.deg.total_cmp(&other.deg))
    }
}

impl PartialOrd for Twist {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// What is shown of a panel that was made.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// Will it bend?
    pub verdict: Verdict,
    /// What was found, the worst first.
    pub findings: Vec<Finding>,
    /// Whether its surface is a mesh that was given.
    pub is_mesh: bool,
    /// The points in space, mm; the samples, where the surface was found.
    pub positions: Vec<Point3>,
    /// The loops of the boundary, the outer one first, by points in space; of a mesh, both sides of
    /// its cuts are among them.
    pub loops: Vec<Vec<u32>>,
    /// The triangles in space, by points, counter-clockwise from where the surface faces.
    pub triangles: Vec<[u32; 3]>,
    /// The corners of the sheet laid flat, mm.
    pub flat: Vec<Point2>,
    /// The triangles on the sheet, in the order of those in space.
    pub flat_triangles: Vec<[u32; 3]>,
    /// The sides of the triangles on the sheet, and the relative length error of each.
    pub sides: Vec<([u32; 2], f64)>,
    /// The rungs, along the panel.
    pub rungs: Vec<ShownRung>,
    /// The pattern.
    pub piece: Piece,
    /// The warp angle that its material takes, degrees.
    pub warp_limit_deg: f64,
    /// The largest warp angle, degrees.
    pub warp_max_deg: f64,
    /// The smallest bend radius, mm; infinite where flat.
    pub bend_radius_min_mm: f64,
    /// The area of the Gauss image, steradians.
    pub gauss_area_sr: f64,
    /// The area of the pattern, mm².
    pub area_flat_mm2: f64,
    /// The largest relative length error.
    pub length_error_max: f64,
    /// The largest distance of the curves from the polygon through the samples, and by how much
    /// that is shorter along an edge, mm, where curves are known.
    pub chords_mm: Option<[f64; 2]>,
    /// How much the sheet stretches in its shape, once that is computed.
    pub strain: Option<ShownStrain>,
}

/// The sheet as it rests in its shape, by a net of triangles, and how much each is strained.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownStrain {
    /// Where the nodes lie flat, mm.
    pub flat: Vec<Point2>,
    /// Where they lie in space, mm.
    pub positions: Vec<Point3>,
    /// The triangles, by nodes, counter-clockwise from where the surface faces.
    pub triangles: Vec<[u32; 3]>,
    /// The strain of every triangle in its plane, as a share.
    pub strains: Vec<f64>,
    /// The strain that 95 % of the area stays below, on which the verdict rests.
    pub decides: f64,
    /// The strain that the material takes.
    pub limit: f64,
}

impl ShownStrain {
    /// Of a sheet that was computed; a flat one is not strained and has no net.
    fn new(predicted: &Predicted) -> Option<Self> {
        let sheet = predicted.at_rest.as_ref()?;
        Some(Self {
            flat: sheet.flat.clone(),
            positions: sheet.positions.clone(),
            triangles: sheet.triangles.iter().map(|t| t.map(|n| n as u32)).collect(),
            strains: sheet.strains.clone(),
            decides: predicted.strain,
            limit: predicted.limits.strain,
        })
    }
}

/// A rung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownRung {
    /// Its ends, by samples in space.
    pub ends: [u32; 2],
    /// Its ends, by corners of the sheet; where the sheet is cut along it, on one side.
    pub flat_ends: [u32; 2],
    /// Its warp angle, degrees.
    pub warp_deg: f64,
    /// Whether the sampling may explain it.
    pub is_unsure: bool,
    /// Its crease, degrees, positive for a mountain.
    pub crease_deg: f64,
    /// The unit normals at its ends; zero without tangent planes.
    pub normals: [Vec3; 2],
}

/// Whether a finding says something that the panes don't show: a curve that runs round a handle is
/// seen to do so, and a corner has a handle of another shape.
fn is_news(finding: &Finding) -> bool {
    !matches!(finding.kind, FindingKind::RoundedCorner { .. })
}

impl Shown {
    /// What is shown of a part.
    pub fn new(panel: &Part, material: Option<&Material>) -> Self {
        let sheet = panel.sheet.mesh();
        let number = |v: VertexIndex| v.get() as u32;
        let errors = length_errors(&panel.sheet, &panel.flat).into_iter().map(f64::abs);
        let measured = panel.measures.rungs.iter().zip(panel.sheet.rung_ends());
        let rungs = measured.map(|(rung, on_sheet)| ShownRung {
            ends: rung.rung.ends().map(|v| v.get() as u32),
            flat_ends: on_sheet.map(number),
            warp_deg: to_deg(rung.warp),
            is_unsure: rung.warp <= rung.resolution,
            crease_deg: to_deg(rung.crease),
            normals: rung.normals,
        });
        Self {
            verdict: panel.checked.verdict,
            findings: panel.checked.findings.iter().filter(|f| is_news(f)).cloned().collect(),
            is_mesh: panel.given().is_some(),
            positions: panel.positions().to_vec(),
            loops: loops(panel),
            triangles: panel.triangles().map(|t| t.map(|n| n as u32)).collect(),
            flat: panel.flat.points.clone(),
            flat_triangles: sheet.triangles().iter().map(|t| t.map(number)).collect(),
            sides: sheet.edges().iter().map(|edge| edge.ends.map(number)).zip(errors).collect(),
            rungs: rungs.collect(),
            piece: panel.piece.clone(),
            warp_limit_deg: warp_limit_deg(material),
            warp_max_deg: to_deg(panel.measures.warp_max),
            bend_radius_min_mm: panel.measures.bend_radius_min_mm,
            gauss_area_sr: panel.measures.gauss_area_sr,
            area_flat_mm2: panel.measures.area_flat_mm2,
            length_error_max: panel.measures.length_error_max,
            chords_mm: panel.found().and_then(|found| {
                Some([found.chords.distance_max_mm()?, found.chords.shorter_max_mm()?])
            }),
            strain: panel.predicted.as_ref().and_then(ShownStrain::new),
        }
    }

    /// Adds a finding in its place, the worst first, unless it is there; whether it was not.
    pub fn add(&mut self, finding: Finding) -> bool {
        let is_new = !self.findings.contains(&finding);
        if is_new {
            let is_as_bad = |other: &Finding| other.severity() >= finding.severity();
            let place = self.findings.partition_point(is_as_bad);
            self.findings.insert(place, finding);
        }
        is_new
    }

    /// Whether a place can be marked: one rung that is there, or where something is found. With
    /// other samples a number means something else.
    pub fn has(&self, place: &Place) -> bool {
        match place {
            Place::Whole => true,
            Place::Rungs { numbers } if numbers.len() == 1 => numbers[0] < self.rungs.len(),
            _ => self.findings.iter().any(|finding| finding.place == *place),
        }
    }

    /// The rung that twists most, by its number among [`Self::rungs`]: of those whose warp angle
    /// the sampling does not explain, if there are any.
    pub fn worst_rung(&self) -> Option<usize> {
        (0..self.rungs.len()).max_by_key(|&n| self.rungs[n].twist())
    }

    /// The largest twist that is said of the panel, wherever that is: that of [`Self::worst_rung`].
    pub fn twist(&self) -> Twist {
        self.worst_rung().map_or(Twist::default(), |n| self.rungs[n].twist())
    }
}

/// The loops of the boundary of a part, by the numbers of its points where it is not cut.
fn loops(part: &Part) -> Vec<Vec<u32>> {
    match &part.origin {
        Origin::Found(found) => {
            let of_loop = |range: &std::ops::Range<usize>| range.clone().map(|n| n as u32);
            found.boundary.loops().iter().map(|range| of_loop(range).collect()).collect()
        }
        Origin::Given(_) => {
            let origin = |v: &VertexIndex| part.sheet.origin(*v).get() as u32;
            part.sheet.loops().iter().map(|l| l.iter().map(origin).collect()).collect()
        }
    }
}

impl ShownRung {
    fn twist(&self) -> Twist {
        Twist { is_sure: !self.is_unsure, deg: self.warp_deg }
    }
}
