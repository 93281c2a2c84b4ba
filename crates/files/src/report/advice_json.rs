//! Places of a panel in `report.json`: points that rulings run together in, and where to divide it.

use schemars::JsonSchema;
use serde::Serialize;
use sheetwright::check::{CutWay, FindingKind, LinePlace, Place, Verdict};
use sheetwright::make::{Found, Made, Part};
use sheetwright::math::{Point3, to_deg};

/// A point that rulings run together in.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Point")]
pub(super) struct PointReport {
    /// Where it is, mm.
    at: [f64; 3],
    /// By how much the sheet turns round it, degrees.
    turn_deg: f64,
    /// The mean bend radius around it over the distance from it. Without unit. Null where its turns
    /// cancel out.
    radius_by_distance: Option<f64>,
    /// How far from it the bend radius is below the least of the material, mm: there the sheet
    /// creases softly, or breaks if it does not fold. Null without a material.
    reach_mm: Option<f64>,
}

/// The points of a part whose surface was found, in the order of the samples.
pub(super) fn point_reports(made: &Made, part: &Part, found: &Found) -> Vec<PointReport> {
    let limit_mm = made.material.as_ref().map(|material| material.bend_radius_mm.value);
    let report = |apex: &sheetwright::measure::Apex| PointReport {
        at: coordinates(found.boundary.position(apex.sample)),
        turn_deg: to_deg(apex.turn),
        radius_by_distance: Some(apex.radius_by_distance).filter(|ratio| ratio.is_finite()),
        reach_mm: limit_mm.map(|mm| apex.reach_mm(mm)),
    };
    part.measures.apexes.iter().map(report).collect()
}

/// A division of a panel that will not bend into panels that do.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Division")]
pub(super) struct DivisionReport {
    /// How many panels it makes.
    parts: usize,
    /// How the lines run: `across` the long direction, or `lengthwise`.
    #[schemars(extend("enum" = ["across", "lengthwise"]))]
    way: &'static str,
    /// The lines between the panels, each by its points, mm: through a hole, one on each side of
    /// it.
    lines: Vec<Vec<[f64; 3]>>,
    /// The largest strain of a panel within its plane that 95 % of it stays below. Without unit.
    strain_p95: f64,
    /// The worst verdict on one of them.
    #[schemars(extend("enum" = Verdict::ALL.map(Verdict::name)))]
    verdict: &'static str,
}

/// The division that a finding on a part advises.
pub(super) fn division_report(part: &Part) -> Option<DivisionReport> {
    part.checked.findings.iter().find_map(|finding| {
        let FindingKind::BendsDivided { parts, way, strain, verdict } = &finding.kind else {
            return None;
        };
        let Place::Lines { lines } = &finding.place else { return None };
        let points = |line: &LinePlace| line.at.iter().copied().map(coordinates).collect();
        Some(DivisionReport {
            parts: *parts,
            way: match way {
                CutWay::Across => "across",
                CutWay::Lengthwise => "lengthwise",
            },
            lines: lines.iter().map(points).collect(),
            strain_p95: *strain,
            verdict: verdict.name(),
        })
    })
}

fn coordinates(p: Point3) -> [f64; 3] {
    [p.x, p.y, p.z]
}
