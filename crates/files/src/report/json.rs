//! `report.json`: what was measured and found, for scripts.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use sheetwright::check::{Checked, Verdict};
use sheetwright::design::{Change, Made, MadePanel};
use sheetwright::material::warp_limit_deg;
use sheetwright::math::to_deg;
use sheetwright::pattern::seam_mark;
use sheetwright::triangulate::Goal;

/// The version of the format.
const VERSION: u32 = 1;

/// What `sheetwright make` measured and found. Lengths are mm, angles degrees. The same design
/// gives the same bytes.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Sheetwright report")]
struct Report<'a> {
    /// The version of this format: 1.
    sheetwright: u32,
    /// The name of the design.
    name: &'a str,
    /// The unit of all lengths: always `mm`.
    units: &'static str,
    /// The material by its name, null if the design names none.
    material: Option<&'static str>,
    /// The panels, in the order of the design.
    panels: Vec<PanelReport<'a>>,
}

/// One panel.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Panel")]
struct PanelReport<'a> {
    /// Its name; its files are called so.
    name: &'a str,
    /// Which triangulations were looked at: `optimal`, `bridge` or `rails`.
    method: &'static str,
    /// What was made as small as could be: `price`, or `worst-warp`, which is the largest twist
    /// first and then the price.
    #[schemars(extend("enum" = [Goal::Price.name(), Goal::WorstWarp.name()]))]
    goal: &'static str,
    /// Whether no triangulation at all, of those that the supporting plane admits, is better by
    /// that goal.
    proven_optimal: bool,
    /// The share of the price that a cheaper one could save at the most: 0 where there is none, null
    /// where nothing is known.
    gap: Option<f64>,
    /// Samples of the boundary.
    samples: usize,
    /// Triangles of the surface.
    triangles: usize,
    /// Rungs: the straight lines that the surface is ruled by.
    rungs: usize,
    /// The weight of the fold price.
    fold: f64,
    /// The price: twist and weighted folds, summed. Without unit.
    price_total: f64,
    /// The sum of the twist (1 - cosine of the warp angle) of all rungs. Without unit.
    twist_total: f64,
    /// The largest angle between the normals of two triangles across a rung, degrees.
    crease_max_deg: f64,
    /// The largest angle between the tangent planes at the two ends of a rung, degrees.
    warp_max_deg: f64,
    /// The mean of that angle over all rungs, degrees.
    warp_mean_deg: f64,
    /// The largest warp angle that is accepted, degrees: the material's, or the default without
    /// one.
    warp_limit_deg: f64,
    /// The smallest radius that the sheet is bent to, mm; null for a flat panel.
    bend_radius_min_mm: Option<f64>,
    /// The area of the Gauss image, steradians: how much of the unit sphere the normals sweep. 0 for a
    /// developable surface.
    gauss_area_sr: f64,
    /// The largest relative difference of a length, flat against space. Without unit.
    length_error_max: f64,
    /// The mean relative difference of all lengths. Without unit.
    length_error_mean: f64,
    /// The area of the surface in space, mm².
    area_space_mm2: f64,
    /// The area of the flat pattern, mm².
    area_flat_mm2: f64,
    /// The width of the flat pattern, its longer side, mm.
    flat_width_mm: f64,
    /// The height of the flat pattern, mm.
    flat_height_mm: f64,
    /// Holes that the flat pattern has.
    holes_flat: usize,
    /// Where the pattern had to be cut open, to be joined again; none where there are no holes or
    /// it lies flat with them.
    seams: Vec<SeamReport>,
    /// How far the pattern as it was written comes from the surface when it is folded up again,
    /// mm; null if it could not be read back.
    refold_error_mm: Option<f64>,
    /// Whether the flat pattern overlaps itself.
    overlaps: bool,
    /// Whether the surface passes through itself in space.
    self_intersects: bool,
    /// The largest distance that a sample was moved, mm.
    moved_max_mm: f64,
    /// All distances that samples were moved, summed, mm.
    moved_total_mm: f64,
    /// What the panel was before it was to be moved; null where nothing was to be.
    before: Option<BeforeReport>,
    /// Will it bend?
    #[schemars(extend("enum" = Verdict::ALL.map(Verdict::name)))]
    verdict: &'static str,
    /// What was found, the worst first.
    findings: Vec<FindingReport<'a>>,
}

/// A panel before its boundary was moved.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Before")]
struct BeforeReport {
    /// The price: twist and weighted folds, summed. Without unit.
    price_total: f64,
    /// The sum of the twist of all rungs. Without unit.
    twist_total: f64,
    /// The largest warp angle, degrees.
    warp_max_deg: f64,
    /// The mean warp angle, degrees.
    warp_mean_deg: f64,
    /// Would it have bent?
    #[schemars(extend("enum" = Verdict::ALL.map(Verdict::name)))]
    verdict: &'static str,
}

/// A cut of the pattern whose two sides are joined.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Seam")]
struct SeamReport {
    /// How both sides are marked on the pattern.
    mark: String,
    /// How long it is, mm.
    length_mm: f64,
    /// The sample of the boundary that it begins at, counted from 1 through all loops.
    from_sample: usize,
    /// The sample that it ends at.
    to_sample: usize,
    /// How far apart the two places of a sample lie on the pattern, the larger of both, mm.
    gap_mm: f64,
}

/// One thing found.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Finding")]
struct FindingReport<'a> {
    /// How bad it is: `error` do not cut, `warning` look at it before cutting, `note` good to know.
    #[schemars(extend("enum" = ["error", "warning", "note"]))]
    severity: &'static str,
    /// A name that scripts may rely on.
    code: &'a str,
    /// What is so, in words, and what to do.
    text: &'a str,
    /// Where; empty where it is the whole panel.
    r#where: &'a str,
}

/// `report.json` of a made design. `refold_error_mm` and `checked` have one entry a panel; a refold
/// error that is not finite says that the written pattern could not be read back.
///
/// # Panics
/// Unless there is one entry a panel.
pub fn report_json(made: &Made, refold_error_mm: &[f64], checked: &[Checked]) -> Vec<u8> {
    assert_eq!(made.panels.len(), refold_error_mm.len(), "one refold error a panel");
    assert_eq!(made.panels.len(), checked.len(), "one verdict a panel");
    let limit = warp_limit_deg(made.material);
    let each = made.panels.iter().zip(refold_error_mm).zip(checked);
    let report = Report {
        sheetwright: VERSION,
        name: &made.name,
        units: "mm",
        material: made.material.map(|m| m.name),
        panels: each
            .map(|((panel, &error), checked)| of_panel(panel, error, checked, limit))
            .collect(),
    };
    to_bytes(&report)
}

/// The JSON Schema of `report.json`.
pub fn report_schema() -> Vec<u8> {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    to_bytes(&settings.into_generator().into_root_schema_for::<Report<'_>>())
}

/// Plain structs of numbers and strings: writing them to memory has no way to fail.
#[allow(clippy::expect_used)]
fn to_bytes(value: &impl Serialize) -> Vec<u8> {
    let mut bytes = serde_json::to_vec_pretty(value).expect("numbers and strings are JSON");
    bytes.push(b'\n');
    bytes
}

fn of_panel<'a>(
    panel: &'a MadePanel,
    refold_error_mm: f64,
    checked: &'a Checked,
    warp_limit_deg: f64,
) -> PanelReport<'a> {
    let finite = |x: f64| x.is_finite().then_some(x);
    let (connectivity, measures) = (panel.surface.connectivity(), &panel.measures);
    let findings = checked.findings.iter().map(|finding| FindingReport {
        severity: finding.severity.name(),
        code: finding.code,
        text: &finding.text,
        r#where: &finding.place,
    });
    let seams = panel.sheet.seams().iter().enumerate().map(|(n, seam)| {
        let [from, to] = seam.rung.ends();
        SeamReport {
            mark: seam_mark(n),
            length_mm: panel.surface.length(from, to),
            from_sample: from.get() + 1,
            to_sample: to.get() + 1,
            gap_mm: seam.gap_mm,
        }
    });
    PanelReport {
        name: &panel.name,
        method: panel.method.name(),
        goal: panel.goal.name(),
        proven_optimal: panel.triangulation.proven_optimal,
        gap: panel.triangulation.gap(),
        samples: panel.boundary.len(),
        triangles: connectivity.triangles().len(),
        rungs: connectivity.hinges().len(),
        fold: panel.fold,
        price_total: panel.triangulation.price,
        twist_total: measures.twist_total,
        crease_max_deg: to_deg(measures.crease_max),
        warp_max_deg: to_deg(measures.warp_max),
        warp_mean_deg: to_deg(measures.warp_mean),
        warp_limit_deg,
        bend_radius_min_mm: finite(measures.bend_radius_min_mm),
        gauss_area_sr: measures.gauss_area_sr,
        length_error_max: measures.length_error_max,
        length_error_mean: measures.length_error_mean,
        area_space_mm2: measures.area_space_mm2,
        area_flat_mm2: measures.area_flat_mm2,
        flat_width_mm: panel.piece.size.x,
        flat_height_mm: panel.piece.size.y,
        holes_flat: panel.sheet.surface().connectivity().loops().len() - 1,
        seams: seams.collect(),
        refold_error_mm: finite(refold_error_mm),
        overlaps: panel.flat.overlap.is_some(),
        self_intersects: measures.self_crossing.is_some(),
        moved_max_mm: panel.change.as_ref().map_or(0.0, Change::moved_max_mm),
        moved_total_mm: panel.change.as_ref().map_or(0.0, Change::moved_total_mm),
        before: panel.change.as_ref().map(|change| of_before(&change.before)),
        verdict: checked.verdict.name(),
        findings: findings.collect(),
    }
}

fn of_before(before: &MadePanel) -> BeforeReport {
    BeforeReport {
        price_total: before.triangulation.price,
        twist_total: before.measures.twist_total,
        warp_max_deg: to_deg(before.measures.warp_max),
        warp_mean_deg: to_deg(before.measures.warp_mean),
        verdict: before.checked.verdict.name(),
    }
}
