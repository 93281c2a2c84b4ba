//! A sharp fold as a tool of a radius makes it: what it takes of the flat sheet.
//!
//! The tool rounds a fold by an angle θ. The faces end at its tangent lines, a setback before they
//! would meet, and between these lines the flat sheet has the bend allowance: θ·(R + K·T) by a
//! K-factor, or what a table of deductions that was measured at the brake says.

use crate::design::Thick;
use crate::material::{Material, bend_allowance_mm, setback_mm};

use super::neutral::k_factor;

/// Thicknesses that differ by a smaller share are one.
const SAME_THICKNESS: f64 = 1e-3;

/// What a fold takes of the flat sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FoldSize {
    /// How far its tangent lines lie from where the faces of the sheet's surface meet, mm.
    pub(crate) setback_mm: f64,
    /// How far apart they lie on the flat sheet, mm.
    pub(crate) allowance_mm: f64,
}

/// A tool that folds a sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FoldTool<'a> {
    material: Option<&'a Material>,
    thickness_mm: f64,
    radius_mm: f64,
    /// How far the surface that the sheet is laid flat by lies from the inner face of a mountain,
    /// and of a valley, mm.
    inner_mm: [f64; 2],
}

impl<'a> FoldTool<'a> {
    /// The tool for a sheet whose drawn face is laid flat.
    pub(crate) fn of_drawn(
        thick: Thick,
        material: Option<&'a Material>,
        bends_up: bool,
    ) -> Option<Self> {
        Self::at(thick, material, (thick.dimensions.share(), bends_up))
    }

    /// The tool for a surface that lies a share of the thickness, as K, from the inner face of most
    /// bends, which are valleys or mountains; `None` if the sheet
    /// can't be folded.
    pub(crate) fn at(
        thick: Thick,
        material: Option<&'a Material>,
        (share, bends_up): (f64, bool),
    ) -> Option<Self> {
        let Thick { thickness_mm, fold_radius_mm, .. } = thick;
        let [mountain, valley] = if bends_up { [1.0 - share, share] } else { [share, 1.0 - share] };
        let inner_mm = [mountain * thickness_mm, valley * thickness_mm];
        Some(Self { material, thickness_mm, radius_mm: fold_radius_mm?, inner_mm })
    }

    /// Its inner radius, mm.
    pub(crate) fn radius_mm(&self) -> f64 {
        self.radius_mm
    }

    /// What a fold takes by its crease, radians, positive for a mountain.
    pub(crate) fn size(&self, crease: f64) -> FoldSize {
        let &Self { material, thickness_mm, radius_mm, inner_mm } = self;
        // A table was measured in the material's own thickness.
        let is_of_sheet = |material: &&Material| {
            (material.thickness_mm.value - thickness_mm).abs() <= SAME_THICKNESS * thickness_mm
        };
        let table = material.filter(is_of_sheet).and_then(|it| it.deductions.as_ref());
        let angle = crease.abs();
        let measured = table.and_then(|table| table.allowance_mm(angle, radius_mm, thickness_mm));
        let allowance_mm = measured.unwrap_or_else(|| {
            let k = k_factor(material, radius_mm, thickness_mm);
            bend_allowance_mm(angle, radius_mm, thickness_mm, k)
        });
        let inner_mm = inner_mm[usize::from(crease < 0.0)];
        FoldSize { setback_mm: setback_mm(angle, radius_mm + inner_mm), allowance_mm }
    }
}
