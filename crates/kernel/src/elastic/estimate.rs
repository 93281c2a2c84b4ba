//! The strain of a sheet by a formula: for a screen while a hand drags, and where no net is found.
//!
//! Thin sheet is strained by the bend that it resists crosswise, about a twelfth of that of the
//! outer fibre, and by the warp along its rulings, ω²/24 for a strip that is free to find its
//! length. The sum is within a factor of two of the elastic sheet on most panels, and twice too
//! kind to thick plate, where the warp is not relieved by leaving the ruled surface.

use super::at_share;
use crate::measure::Measures;
use crate::sheet::Sheet;
use sheetwright_geometry::index::TriangleIndex;

/// The strain of the elastic sheet is at least the estimate over this factor and at most the
/// estimate times it, on nine panels of ten.
pub const DOUBT: f64 = 2.2;

/// An estimate of the strain of a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The strain in the plane that 95 % of the area stays below, without unit.
    pub strain: f64,
    /// The curvature that 95 % of the area stays below, 1/mm.
    pub curvature: f64,
}

/// Estimates the strain of a sheet of this thickness, mm, whose surface was found.
pub fn estimate(sheet: &Sheet, measures: &Measures, thickness_mm: f64) -> Estimate {
    let mesh = sheet.mesh();
    let area = |t: TriangleIndex| mesh.area_vector(t).length();
    let mut weights = Vec::with_capacity(measures.rungs.len());
    for &[a, b] in sheet.rung_ends() {
        let edge = mesh.topology().edge_between(a, b).map(|n| &mesh.edges()[n]);
        weights.push(edge.map_or(0.0, |e| e.triangles.iter().flatten().map(|&t| area(t)).sum()));
    }
    let curvatures: Vec<f64> = measures.rungs.iter().map(|r| 1.0 / r.bend_radius_mm).collect();
    let curvature = at_share(&curvatures, &weights, super::DECIDES);
    let whole: f64 = weights.iter().sum();
    let squares: f64 =
        measures.rungs.iter().zip(&weights).map(|(rung, w)| w * rung.warp * rung.warp).sum();
    let warp_squared = if whole > 0.0 { squares / whole } else { 0.0 };
    Estimate { strain: 0.5 * thickness_mm * curvature / 12.0 + warp_squared / 24.0, curvature }
}
