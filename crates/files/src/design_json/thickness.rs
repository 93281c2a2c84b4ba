//! The thickness of the sheet, and the face that is drawn: the fields `thickness` and `dimensions`.

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

/// Both fields as they are written, in mm.
pub(super) fn written(design: &Design) -> impl Iterator<Item = String> {
    let name = design.dimensions.map(Dimensions::name);
    let dimensions = name.map(|name| format!("  \"dimensions\": {}", json(&name)));
    let thickness = design.thickness_mm.map(|mm| format!("  \"thickness\": {}", json(&mm)));
    dimensions.into_iter().chain(thickness)
}
