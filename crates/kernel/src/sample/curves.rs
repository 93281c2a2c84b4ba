//! The curves of a design, built as panels use them.

use super::error::{PanelCause, PanelError};
use crate::design::{CurveUse, Design, DesignCurve, DesignPanel};
use sheetwright_geometry::curve::{Curve, CurveKind};

pub(super) fn found<'a>(
    design: &'a Design,
    panel: &DesignPanel,
    wanted: &CurveUse,
) -> Result<&'a DesignCurve, PanelError> {
    design
        .curves
        .iter()
        .find(|curve| curve.name == wanted.name)
        .ok_or_else(|| PanelError::of_curve_in(&panel.name, &wanted.name, PanelCause::UnknownCurve))
}

/// The curve of a name, run the way that it is used.
pub(crate) fn built(
    design: &Design,
    panel: &DesignPanel,
    wanted: &CurveUse,
) -> Result<Curve, PanelError> {
    let source = found(design, panel, wanted)?;
    let curve = Curve::new(kind_of_part(source), &source.points, source.closed);
    let curve =
        curve.map_err(|error| PanelError::of_curve(&wanted.name, PanelCause::Curve(error)))?;
    Ok(if wanted.reversed { curve.reversed() } else { curve })
}

/// How a curve is made when it is a part of something: points that are samples themselves are
/// joined straight.
pub(crate) fn kind_of_part(source: &DesignCurve) -> CurveKind {
    source.kind.unwrap_or(CurveKind::Polyline)
}
