//! What panes show of a made panel: plain numbers, which cross from a worker to the page.

use super::Refusal;
use sheetwright::check::{Finding, FindingKind, Place, Verdict};
use sheetwright::make::MadePanel;
use sheetwright::material::{Material, warp_limit_deg};
use sheetwright::math::{Point2, Point3, Vec3, to_deg};
use sheetwright::measure::length_errors;
use sheetwright::pattern::Piece;

/// A panel, made or not.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownPanel {
    /// Its name.
    pub name: String,
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
    /// Whether nothing cheaper exists.
    pub proven_optimal: bool,
    /// The samples in space, mm: the outer loop, then the holes.
    pub positions: Vec<Point3>,
    /// Where each loop ends among them.
    pub loop_ends: Vec<u32>,
    /// The triangles in space, by samples, counter-clockwise from where the surface faces.
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
    /// What is shown of a panel.
    pub fn new(panel: &MadePanel, material: Option<&Material>) -> Self {
        let sheet = panel.sheet.surface().connectivity();
        let of = |t: &[sheetwright::index::SampleIndex; 3]| t.map(|v| v.get() as u32);
        let errors = length_errors(&panel.sheet, &panel.flat);
        let rungs = panel.measures.rungs.iter().enumerate().map(|(n, rung)| ShownRung {
            ends: rung.rung.ends().map(|v| v.get() as u32),
            flat_ends: panel.sheet.rung_ends(n).map(|v| v.get() as u32),
            warp_deg: to_deg(rung.warp),
            is_unsure: rung.warp <= rung.resolution,
            crease_deg: to_deg(rung.crease),
            normals: rung.normals,
        });
        Self {
            verdict: panel.checked.verdict,
            findings: panel.checked.findings.iter().filter(|f| is_news(f)).cloned().collect(),
            proven_optimal: panel.triangulation.proven_optimal,
            positions: panel.surface.positions().to_vec(),
            loop_ends: panel.boundary.loops().iter().map(|l| l.end as u32).collect(),
            triangles: panel.surface.connectivity().triangles().iter().map(of).collect(),
            flat: panel.flat.points.clone(),
            flat_triangles: sheet.triangles().iter().map(of).collect(),
            sides: sheet.sides().map(|side| side.map(|v| v.get() as u32)).zip(errors).collect(),
            rungs: rungs.collect(),
            piece: panel.piece.clone(),
            warp_limit_deg: warp_limit_deg(material),
            warp_max_deg: to_deg(panel.measures.warp_max),
            bend_radius_min_mm: panel.measures.bend_radius_min_mm,
            gauss_area_sr: panel.measures.gauss_area_sr,
            area_flat_mm2: panel.measures.area_flat_mm2,
            length_error_max: panel.measures.length_error_max,
        }
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

impl ShownRung {
    fn twist(&self) -> Twist {
        Twist { is_sure: !self.is_unsure, deg: self.warp_deg }
    }
}
