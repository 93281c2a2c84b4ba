//! A surface through a boundary that a part may have, laid flat and judged by a formula: the
//! cheapest, and the other one where there are two.

use super::MakeCause;
use crate::bend::{k_factor, neutral_surface};
use crate::check::{Checked, CheckedFrom, Subject, check};
use crate::design::Thick;
use crate::elastic::{Predicted, screen};
use crate::flatten::{Flattened, lay_flat};
use crate::material::Material;
use crate::measure::{CutFrom, Measures, measures, rung_measures};
use crate::sheet::Sheet;
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::watch::{Stage, Watch};
use sheetwright_optimum::cost::Prices;
use sheetwright_optimum::triangulate::{TriangulateOptions, Triangulation};

/// What a surface through a boundary is judged by.
pub(super) struct Setting<'a> {
    pub(super) boundary: &'a Boundary,
    pub(super) plane: Option<&'a SupportingPlane>,
    pub(super) options: &'a TriangulateOptions,
    pub(super) material: Option<&'a Material>,
    pub(super) thick: Option<Thick>,
}

/// A surface through a boundary, laid flat and judged by a formula.
pub(super) struct Candidate {
    pub(super) surface: Surface,
    pub(super) sheet: Sheet,
    pub(super) flat: Flattened,
    pub(super) measures: Measures,
    pub(super) predicted: Option<Predicted>,
    pub(super) checked: Checked,
}

impl Setting<'_> {
    /// Lays the surface of a triangulation flat, or its neutral one, and judges it; `name` is that
    /// of its panel, `cut` says where its pattern is to be cut open.
    pub(super) fn candidate(
        &self,
        name: &str,
        triangulation: &Triangulation,
        cut: &[Point3],
        watch: &mut dyn Watch,
    ) -> Result<Candidate, MakeCause> {
        let &Self { boundary, plane, options, material, thick } = self;
        let connectivity = Connectivity::new(boundary.loops(), triangulation.triangles.clone())
            .map_err(MakeCause::Surface)?;
        let surface = Surface::new(connectivity, boundary.positions());
        watch.begin(&[name], Stage::Flatten);
        let prices = Prices::new(boundary, plane, options.price);
        let neutral = thick.map(|Thick { dimensions, thickness_mm }| {
            let rungs = rung_measures(&surface, &prices);
            let radius_mm = rungs.iter().map(|r| r.bend_radius_mm).fold(f64::INFINITY, f64::min);
            let k = k_factor(material, radius_mm, thickness_mm);
            neutral_surface(&surface, dimensions, thickness_mm, k)
        });
        let (sheet, flat) = lay_flat(neutral.as_ref().unwrap_or(&surface), cut, watch)
            .map_err(MakeCause::Flatten)?;
        watch.begin(&[name], Stage::Check);
        let measures = measures(CutFrom::Surface(&surface, &prices), &sheet, &flat);
        let predicted = sheet.has_rungs().then(|| screen(&sheet, &measures, material));
        let checked = check(&Subject {
            sheet: &sheet,
            flat: &flat,
            measures: &measures,
            predicted: predicted.as_ref(),
            material,
            from: CheckedFrom::Boundary(boundary, triangulation),
        });
        Ok(Candidate { surface, sheet, flat, measures, predicted, checked })
    }
}
