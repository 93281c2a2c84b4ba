//! The thickness of the sheet, the face that is drawn and the radius of folds: the fields
//! `thickness`, `dimensions` and `bend_radius`.

use super::grammar::DimensionsName;
use super::source::Source;
use crate::json::json;
use crate::reading::InputError;
use crate::units::Units;
use sheetwright::design::{Design, Dimensions};

/// The thickest sheet, mm: beyond it, a length has the wrong unit.
pub(crate) const MOST_THICKNESS_MM: f64 = 1000.0;

/// The face that is drawn.
pub(super) fn dimensions(file: Option<DimensionsName>) -> Option<Dimensions> {
    file.map(|name| match name {
        DimensionsName::Inside => Dimensions::Inside,
        DimensionsName::Mean => Dimensions::Mean,
        DimensionsName::Outside => Dimensions::Outside,
    })
}

/// The thickness, mm.
pub(super) fn thickness_mm(
    file: Option<f64>,
    units: Units,
    source: &Source<'_>,
) -> Result<Option<f64>, InputError> {
    let Some(thickness) = file else { return Ok(None) };
    let mm = thickness * units.in_mm();
    if mm > 0.0 && mm <= MOST_THICKNESS_MM {
        return Ok(Some(mm));
    }
    let hint = "Write a thickness above 0 and up to 1 m, in the units of the design.";
    Err(source.error("thickness", format!("the thickness is {thickness}"), hint))
}

/// The largest inner radius of a tool that makes folds, mm.
pub(crate) const MOST_FOLD_RADIUS_MM: f64 = 1000.0;

/// The inner radius of folds, mm.
pub(super) fn bend_radius_mm(
    file: Option<f64>,
    units: Units,
    source: &Source<'_>,
) -> Result<Option<f64>, InputError> {
    let Some(radius) = file else { return Ok(None) };
    let mm = radius * units.in_mm();
    if (0.0..=MOST_FOLD_RADIUS_MM).contains(&mm) {
        return Ok(Some(mm));
    }
    let hint = "Write the inner radius of the tool, 0 to 1 m, in the units of the design.";
    Err(source.error("bend_radius", format!("the bend radius is {radius}"), hint))
}

/// The three fields as they are written, in mm.
pub(super) fn written(design: &Design) -> impl Iterator<Item = String> {
    let name = design.dimensions.map(Dimensions::name);
    let dimensions = name.map(|name| format!("  \"dimensions\": {}", json(&name)));
    let thickness = design.thickness_mm.map(|mm| format!("  \"thickness\": {}", json(&mm)));
    let radius = design.bend_radius_mm.map(|mm| format!("  \"bend_radius\": {}", json(&mm)));
    dimensions.into_iter().chain(thickness).chain(radius)
}
