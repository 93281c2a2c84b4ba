//! The strain of a sheet by a formula: for a screen while a hand drags, and where no net is found.
//!
//! Thin sheet is strained by the bend that it resists crosswise, about a twelfth of that of the
//! outer fibre, and by the warp along its rulings, ω²/24 for a strip that is free to find its
//! length. The sum is within a factor of two of the elastic sheet on most panels, and twice too
//! kind to thick plate, where the warp is not relieved by leaving the ruled surface.

use super::{Basis, DECIDES, Predicted, at_share};
use crate::material::{Limits, Material};
use crate::measure::{Measures, RungMeasures};
use crate::sheet::Sheet;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};

/// The strain of the elastic sheet is at least that of the formula over this factor and at most
/// that times it, on nine panels of ten.
pub const DOUBT: f64 = 2.2;

/// What a formula predicts of a sheet whose surface was found.
pub fn screen(sheet: &Sheet, measures: &Measures, material: Option<&Material>) -> Predicted {
    let weights = weights(sheet);
    let of_rungs = |of: fn(&RungMeasures) -> f64| measures.rungs.iter().map(of);
    let curvatures: Vec<f64> = of_rungs(|rung| 1.0 / rung.bend_radius_mm).collect();
    let curvature = at_share(&curvatures, &weights, DECIDES);
    let limits = Limits::of(material, measures.area_flat_mm2, curvature);
    let whole: f64 = weights.iter().sum();
    let squares: f64 =
        of_rungs(|rung| rung.warp * rung.warp).zip(&weights).map(|(w, a)| w * a).sum();
    let warp_squared = if whole > 0.0 { squares / whole } else { 0.0 };
    let scored = (0..measures.rungs.len()).filter(|&n| measures.rungs[n].is_fold).collect();
    Predicted { scored, ..by_formula(limits, curvature, warp_squared) }
}

/// What the formula predicts of a sheet with this curvature, 1/mm, and this mean square of the
/// warp, by area, square radians.
pub(super) fn by_formula(limits: Limits, curvature: f64, warp_squared: f64) -> Predicted {
    let strain = limits.outer_fibre_at(curvature) / 12.0 + warp_squared / 24.0;
    Predicted {
        limits,
        basis: Basis::Screen,
        strain,
        strain_range: [strain / DOUBT, strain * DOUBT],
        curvature,
        scored: Vec::new(),
        at_rest: None,
        thickest_mm: None,
    }
}

/// The area beside every rung, mm².
fn weights(sheet: &Sheet) -> Vec<f64> {
    let mesh = sheet.mesh();
    let area = |t: TriangleIndex| mesh.area_vector(t).length();
    let beside = |&[a, b]: &[VertexIndex; 2]| -> f64 {
        let edge = mesh.topology().edge_between(a, b).map(|n| &mesh.edges()[n]);
        edge.map_or(0.0, |edge| edge.triangles.iter().flatten().map(|&t| area(t)).sum())
    };
    sheet.rung_ends().iter().map(beside).collect()
}
