//! A surface through a boundary that a part may have, laid flat and judged by a formula: the
//! cheapest, and the other one where there are two.

use super::MakeCause;
use crate::bend::{
    FoldTool, Rounded, bends_up, folded_edges, k_factor, neutral_surface, plane_edges, rounded,
};
use crate::check::{Checked, CheckedFrom, Subject, check, mitred_folds, sheet_too_thick};
use crate::design::Thick;
use crate::elastic::{Predicted, screen};
use crate::flatten::{Flattened, lay_flat};
use crate::material::Material;
use crate::measure::{CutFrom, Measures, RungMeasures, measures, rung_measures};
use crate::sheet::Sheet;
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::index::SampleIndex;
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
    /// The steps along the ends between two rails.
    pub(super) ends: &'a [[SampleIndex; 2]],
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
        let &Self { boundary, plane, options, material, thick, ends } = self;
        let connectivity = Connectivity::new(boundary.loops(), triangulation.triangles.clone())
            .map_err(MakeCause::Surface)?;
        let surface = Surface::new(connectivity, boundary.positions());
        watch.begin(&[name], Stage::Flatten);
        let prices = Prices::new(boundary, plane, options.price);
        let neutral = thick.map(|thick| {
            let rungs = rung_measures(&surface, &prices);
            let k = neutral_k(thick, material, &rungs);
            let Thick { dimensions, thickness_mm, .. } = thick;
            let planes = plane_edges(boundary, ends);
            (neutral_surface(&surface, &planes, dimensions, thickness_mm, k), k, rungs)
        });
        let to_lay = neutral.as_ref().map_or(&surface, |(neutral, ..)| neutral);
        let (sheet, flat) = lay_flat(to_lay, cut, watch).map_err(MakeCause::Flatten)?;
        let tool = thick.zip(neutral.as_ref()).and_then(|(thick, (_, k, rungs))| {
            let tool = FoldTool::at(thick, material, (*k, bends_up(&surface)))?;
            Some((tool, folded_edges(&sheet, rungs)))
        });
        let Rounded { sheet, flat, folds, mitred } = match tool {
            Some((tool, is_fold)) => rounded(sheet, flat, &is_fold, &tool),
            None => Rounded::none(sheet, flat),
        };
        watch.begin(&[name], Stage::Check);
        let mut measures = measures(CutFrom::Surface(&surface, &prices), &sheet, &flat);
        let predicted = sheet.has_rungs().then(|| screen(&sheet, &flat, &measures, material));
        if let Some(predicted) = &predicted {
            measures.score(&predicted.scored);
        }
        let mut checked = check(&Subject {
            sheet: &sheet,
            flat: &flat,
            measures: &measures,
            predicted: predicted.as_ref(),
            material,
            from: CheckedFrom::Boundary(boundary, triangulation),
        });
        mitred_folds(folds, &mitred).for_each(|finding| checked.add(finding));
        let too_thick =
            thick.and_then(|thick| sheet_too_thick(&measures.rungs, thick, bends_up(&surface)));
        too_thick.into_iter().for_each(|finding| checked.add_of_bending(finding));
        Ok(Candidate { surface, sheet, flat, measures, predicted, checked })
    }
}

/// K of a sheet at its tightest bend: that of the tool, where it is folded.
fn neutral_k(thick: Thick, material: Option<&Material>, rungs: &[RungMeasures]) -> f64 {
    let smooth = rungs.iter().map(|rung| rung.bend_radius_mm);
    let folds = rungs.iter().filter(|rung| rung.is_fold).filter_map(|_| thick.fold_radius_mm);
    let radius_mm = smooth.chain(folds).fold(f64::INFINITY, f64::min);
    k_factor(material, radius_mm, thick.thickness_mm)
}
