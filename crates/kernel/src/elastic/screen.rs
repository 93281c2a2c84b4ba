//! The strain of a sheet by a formula: for a screen while a hand drags, and where no net is found.
//!
//! Thin sheet is strained by the bend that it resists crosswise, about a twelfth of that of the
//! outer fibre, and by the warp along its rulings, ω²/24 for a strip that is free to find its
//! length. The sum is within a factor of two of the elastic sheet on most panels, and twice too
//! kind to thick plate, where the warp is not relieved by leaving the ruled surface.
//!
//! **Folds that the boundary has not itself** need not be there: the cheapest surface of a strip
//! that is twisted by φ is two triangles with a fold of about φ along its diagonal, where the sheet
//! is nearly a helicoid, whose rulings warp by ω = φ W / L. So the formula takes such a fold as
//! smoothed over the whole sheet: along a fold of length ℓ the sheet, of area A, is A/ℓ wide, which
//! is the shorter way (a diagonal) or the longer one (a rung of a strip), so ω = φ min(A/ℓ², ℓ²/A).
//! The curvature is taken as 2 φ ℓ/A, twice that of the fold spread over A/ℓ: the sheet leaves the
//! helicoid, and computed sheets of strips twisted by 5 to 22° have 1.8 to 3.1 times φ ℓ/A. Thick
//! sheet, which resists the fold, is strained by a quarter of its outer fibre so: those strips in
//! 5 mm by .26 to .30 of it. The folds stay where the sheet so smoothed would use more than it
//! takes.

use super::folds::{Border, folds, weights};
use super::narrow::narrow_rungs;
use super::rolled::{is_developable, rolled};
use super::{Basis, DECIDES, Predicted, at_share};
use crate::flatten::Flattened;
use crate::material::{Limits, Material};
use crate::measure::{Measures, RungMeasures};
use crate::sheet::Sheet;

/// The strain of the elastic sheet is at least that of the formula over this factor and at most
/// that times it, on nine panels of ten.
pub const DOUBT: f64 = 2.2;

/// The curvature of a sheet that smooths a fold, as a multiple of that of the fold spread over the
/// width of the sheet beside it.
const TIGHTER: f64 = 2.0;
/// The least strain of a sheet that smooths a fold, as a share of that of its outer fibre.
const RESISTED: f64 = 0.25;

/// What a formula predicts of a sheet whose surface was found, and the folds that it scores. Narrow
/// bends strain it by nothing, but count by how tight they are.
pub fn screen(
    sheet: &Sheet,
    flat: &Flattened,
    measures: &Measures,
    material: Option<&Material>,
) -> Predicted {
    let predicted = beside_narrow(sheet, flat, measures, material);
    let (_, tightest) = narrow_rungs(sheet, flat, measures, &predicted.limits);
    Predicted { curvature: predicted.curvature.max(tightest), ..predicted }
}

/// What it predicts of a sheet with all its bends as parts of its area.
fn beside_narrow(
    sheet: &Sheet,
    flat: &Flattened,
    measures: &Measures,
    material: Option<&Material>,
) -> Predicted {
    let weights = weights(sheet);
    let curvature = curvature_of_rungs(measures, &weights);
    let whole: f64 = weights.iter().sum();
    let squares =
        measures.rungs.iter().zip(&weights).map(|(rung, area)| rung.warp * rung.warp * area);
    let squares: f64 = squares.sum();
    let warp_squared = if whole > 0.0 { squares / whole } else { 0.0 };
    let limits = |curvature| Limits::of(material, measures.area_flat_mm2, curvature);
    let scored = folds(measures, |_| true);
    let folded = Predicted { scored, ..by_formula(limits(curvature), curvature, warp_squared) };
    if folded.scored.is_empty() {
        return folded;
    }
    let border = Border::new(sheet, flat);
    let needed = folds(measures, |rung| border.demands(rung));
    if needed.len() == folded.scored.len() {
        return folded;
    }
    let spare = folded.scored.iter().filter(|rung| needed.binary_search(rung).is_err());
    let [warp, bent] = smoothed(sheet, flat, measures, spare.copied());
    let curvature = curvature.max(bent);
    let limits = limits(curvature);
    let strain = strain_of(&limits, curvature, warp_squared + warp * warp);
    let strain = strain.max(limits.outer_fibre_at(bent) * RESISTED);
    let smooth = screened(limits, strain, curvature);
    let [least, most] = smooth.strain_range;
    let limit = smooth.limits.strain;
    if smooth.usage() <= 1.0 || !smooth.limits.folds {
        Predicted { scored: needed, ..smooth }
    } else if least <= limit {
        let strain_range = [folded.strain_range[0], most.max(folded.strain_range[1])];
        Predicted { strain_range, ..folded }
    } else {
        folded
    }
}

/// The curvature that 95 % of the area of a sheet stays below, 1/mm, where its rungs have these
/// weights.
pub(super) fn curvature_of_rungs(measures: &Measures, weights: &[f64]) -> f64 {
    let curvature = |rung: &RungMeasures| 1.0 / rung.bend_radius_mm;
    let curvatures: Vec<f64> = measures.rungs.iter().map(curvature).collect();
    at_share(&curvatures, weights, DECIDES)
}

/// The warp, radians, and the curvature, 1/mm, of a sheet that smooths these folds.
fn smoothed(
    sheet: &Sheet,
    flat: &Flattened,
    measures: &Measures,
    folds: impl Iterator<Item = usize>,
) -> [f64; 2] {
    let area = measures.area_flat_mm2;
    folds.fold([0.0, 0.0], |[warp, bent], rung| {
        let [a, b] = sheet.rung_ends()[rung].map(|v| flat.points[v.get()]);
        let (length, angle) = (a.distance(b), measures.rungs[rung].crease.abs());
        let ratio = length * length / area;
        [warp + angle * ratio.min(1.0 / ratio), f64::max(bent, TIGHTER * angle * length / area)]
    })
}

/// What the formula predicts of a sheet with this curvature, 1/mm, and this mean square of the
/// warp, by area, square radians.
pub(super) fn by_formula(limits: Limits, curvature: f64, warp_squared: f64) -> Predicted {
    let predicted = |limits: &Limits| {
        screened(limits.clone(), strain_of(limits, curvature, warp_squared), curvature)
    };
    let elastic = predicted(&limits);
    if is_developable(&limits, warp_squared) {
        return rolled(elastic, [curvature, 0.0], |yielding| Some(predicted(yielding)));
    }
    elastic
}

/// The strain of a sheet with this curvature, 1/mm, and this mean square of the warp, by area,
/// square radians. It is strained by its bend as one is that is as stiff and does not yield: by
/// a thickness that is less by the root of the share of the moment.
fn strain_of(limits: &Limits, curvature: f64, warp_squared: f64) -> f64 {
    let of_bend = limits.outer_fibre_at(curvature) * limits.moment_share.sqrt() / 12.0;
    of_bend + warp_squared / 24.0
}

/// What is predicted by a strain that a formula gives, and a curvature, 1/mm.
fn screened(limits: Limits, strain: f64, curvature: f64) -> Predicted {
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
