//! A part as a row of plain values, for tables of many panels: what a batch writes of each, and
//! what scripts read. Every value is that of the report, to the last bit.

use super::{How, Judging, Made, MakeError, Part, make_with};
use crate::check::{Finding, Severity, Verdict};
use crate::design::Design;
use crate::material::{Material, stretch_limit};
use sheetwright_geometry::math::to_deg;
use sheetwright_geometry::watch::Watch;

/// What a table of panels says of one part.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelRow {
    /// The name of the part: that of its panel, with a number where a mesh makes several.
    pub panel: String,
    /// Will it bend?
    pub verdict: Verdict,
    /// What was found, the worst first.
    pub findings: Vec<Finding>,
    /// The values that were measured.
    pub values: PanelValues,
}

/// The values that were measured of one part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelValues {
    /// The largest angle between the tangent planes at the two ends of a rung, degrees; `None` of a
    /// mesh.
    pub warp_max_deg: Option<f64>,
    /// The strain within its plane that 95 % of the sheet stays below, without unit; `None` of a
    /// single triangle.
    pub strain_p95: Option<f64>,
    /// The strain that the sheet takes, without unit.
    pub strain_limit: f64,
    /// The smallest radius that the sheet is bent to, mm; `None` of a flat panel and of a mesh.
    pub bend_radius_min_mm: Option<f64>,
    /// The area of the flat pattern, mm².
    pub area_flat_mm2: f64,
    /// The area of the surface in space, mm².
    pub area_space_mm2: f64,
    /// The length of the outline as it is cut, without holes, mm.
    pub outline_length_mm: f64,
    /// The width of the box around that outline, mm.
    pub flat_width_mm: f64,
    /// The height of that box, mm.
    pub flat_height_mm: f64,
}

impl PanelRow {
    /// The row of a part that is made from this material.
    pub fn of(part: &Part, material: Option<&Material>) -> Self {
        let (verdict, findings) = (part.checked.verdict, part.checked.findings.clone());
        let values = PanelValues::of(part, material);
        Self { panel: part.name.clone(), verdict, findings, values }
    }

    /// How bad the worst finding is, if there are any.
    pub fn severity(&self) -> Option<Severity> {
        self.findings.iter().map(Finding::severity).max()
    }
}

impl PanelValues {
    /// The values of a part that is made from this material.
    pub fn of(part: &Part, material: Option<&Material>) -> Self {
        let measures = &part.measures;
        let of_found = |value: f64| part.found().map(|_| value);
        let outline = part.piece.outline();
        let next = outline.iter().cycle().skip(1);
        Self {
            warp_max_deg: of_found(to_deg(measures.warp_max)),
            strain_p95: part.predicted.as_ref().map(|predicted| predicted.strain),
            strain_limit: stretch_limit(material),
            bend_radius_min_mm: of_found(measures.bend_radius_min_mm).filter(|r| r.is_finite()),
            area_flat_mm2: measures.area_flat_mm2,
            area_space_mm2: measures.area_space_mm2,
            outline_length_mm: outline.iter().zip(next).map(|(p, q)| p.distance(*q)).sum(),
            flat_width_mm: part.piece.size.x,
            flat_height_mm: part.piece.size.y,
        }
    }
}

impl Made {
    /// The rows of its parts, in their order.
    pub fn rows(&self) -> Vec<PanelRow> {
        self.parts.iter().map(|part| PanelRow::of(part, self.material.as_ref())).collect()
    }
}

/// Makes a design and keeps the rows of its parts alone, which are those of
/// [`super::make_judged`]. Many panels at once are made fastest on as many threads as there are
/// cores, each in [`sheetwright_optimum::triangulate::on_one_thread`].
///
/// # Errors
/// As [`super::make_judged`].
pub fn make_rows(
    design: &Design,
    judging: Judging,
    watch: &mut dyn Watch,
) -> Result<Vec<PanelRow>, MakeError> {
    make_with(design, How { judging, is_bare: true }, watch).map(|made| made.rows())
}
