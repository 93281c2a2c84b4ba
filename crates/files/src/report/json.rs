//! `report.json`: what was measured and found, for scripts.

use super::Written;
use super::advice_json::{DivisionReport, PointReport, division_report, point_reports};
use super::sheets_json::{SheetsReport, sheets_report};
use crate::mesh::aim_name;
use crate::quads::PanelQuads;
use crate::words::{finding_place, finding_text};
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::Result;
use sheetwright::check::{Checked, Verdict};
use sheetwright::edge::{Edge, EdgePlace};
use sheetwright::elastic::{Basis, Predicted};
use sheetwright::make::{Change, CutItem, Found, Given, Made, Origin, Part};
use sheetwright::material::{stretch_limit, warp_limit_deg};
use sheetwright::math::to_deg;
use sheetwright::pattern::seam_mark;
use sheetwright::quads::PlanarEnd;
use sheetwright::sheet::Seam;
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
    material: Option<&'a str>,
    /// The panels, in the order of the design.
    panels: Vec<PanelReport<'a>>,
    /// The sheets with the parts on them, in order; null where parts are not laid out.
    sheets: Option<SheetsReport>,
}

/// One panel.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Panel")]
struct PanelReport<'a> {
    /// Its name.
    name: &'a str,
    /// The panel whose pattern it is cut from: its own, or that of the first of equal panels. The
    /// files of the pattern are called so.
    pattern: &'a str,
    /// How many are cut from its pattern, itself included; 0 where it is cut from another's.
    count: usize,
    /// How many of those are its pattern turned over.
    mirrored: usize,
    /// The names of those, its own first.
    instances: Vec<&'a str>,
    /// Which triangulations were looked at: `optimal`, `bridge` or `rails`; or `mesh` for a mesh
    /// that was flattened as it stands.
    method: &'static str,
    /// What was made as small as could be: `price`, or `worst-warp`, which is the largest twist
    /// first and then the price. Null for a mesh.
    #[schemars(extend("enum" = [Some(Goal::Price.name()), Some(Goal::WorstWarp.name()), None::<&str>]))]
    goal: Option<&'static str>,
    /// What flattening made small where it could not be exact: the `mean` length error, the largest
    /// (`max`), or that of the border (`seams`, kept exact). Null unless it is a mesh.
    #[schemars(extend("enum" = [Some("mean"), Some("max"), Some("seams"), None::<&str>]))]
    aim: Option<&'static str>,
    /// Whether no triangulation at all, of those that the supporting plane admits, is better by
    /// that goal. Null for a mesh.
    proven_optimal: Option<bool>,
    /// The share of the price that a cheaper one could save at the most: 0 where there is none,
    /// null where nothing is known.
    gap: Option<f64>,
    /// Samples of the boundary; of a mesh, the points of the outline and the holes of its pattern.
    samples: usize,
    /// The largest distance of the curves from the polygon through the samples, along which the
    /// pattern is cut, mm; null for a mesh, and where the rows of a table are the samples.
    curve_distance_max_mm: Option<f64>,
    /// The length by which that polygon is shorter than the curves, along the edge that loses most,
    /// mm.
    curve_shorter_max_mm: Option<f64>,
    /// The length that both were to stay below, mm; null where the number of samples was given.
    tolerance_mm: Option<f64>,
    /// Triangles of the surface.
    triangles: usize,
    /// Rungs: the straight lines that the surface is ruled by. Null for a mesh, as are all numbers
    /// that come from rungs.
    rungs: Option<usize>,
    /// The weight of the fold price.
    fold: Option<f64>,
    /// The price: twist and weighted folds, summed. Without unit.
    price_total: Option<f64>,
    /// The sum of the twist (1 - cosine of the warp angle) of all rungs. Without unit.
    twist_total: Option<f64>,
    /// The largest angle between the normals of two triangles across a rung, degrees; of a mesh,
    /// across a side that is not cut.
    crease_max_deg: f64,
    /// The largest angle between the tangent planes at the two ends of a rung, degrees.
    warp_max_deg: Option<f64>,
    /// The mean of that angle over all rungs, degrees.
    warp_mean_deg: Option<f64>,
    /// The largest warp angle that is accepted, degrees: the material's, or the default without
    /// one.
    warp_limit_deg: f64,
    /// The strain within its plane that 95 % of the sheet stays below, in its shape. Without unit.
    strain_p95: Option<f64>,
    /// The least and the greatest that this may be.
    strain_range: Option<[f64; 2]>,
    /// The strain within its plane that the sheet takes: the material's, or the default without
    /// one.
    strain_limit: f64,
    /// How the strain was found: `computed` on an elastic sheet, or by a formula: `quick`, `no-net`
    /// where the outline can't be divided into triangles, `no-rest` where the sheet found no rest,
    /// `too-tight` where metal is rolled more tightly than a computed sheet can tell;
    /// `pattern` by the triangles of a mesh for which no sheet was computed.
    #[schemars(extend("enum" = [Some("computed"), Some("quick"), Some("no-net"), Some("no-rest"), Some("too-tight"), Some("pattern"), None::<&str>]))]
    strain_by: Option<&'static str>,
    /// The strain of the outer fibre that 95 % of the sheet stays below. Without unit.
    outer_fibre: Option<f64>,
    /// The strain of the outer fibre that the sheet takes, at the smallest bend radius of its
    /// material; null without one.
    outer_fibre_limit: Option<f64>,
    /// The thickness that the strain was predicted for, mm: the material's; without one, a
    /// thousandth of the side of a square with the area of the panel, at most a fiftieth of its
    /// bend radius.
    thickness_mm: Option<f64>,
    /// The moment that holds an edge, N·m for each metre; null where Young's modulus is unknown.
    hold_moment_n: Option<f64>,
    /// The load across the sheet that holds its border, N for each metre, within a factor of 1.5.
    hold_load_n_per_m: Option<f64>,
    /// The largest distance of the sheet at rest from the surface, mm; null where none was
    /// computed.
    rest_distance_mm: Option<f64>,
    /// How far its edges slide along the boundary at the most, mm; null where they are held, or
    /// where no sheet was computed.
    slide_mm: Option<f64>,
    /// The thickest sheet of its kind that takes the shape, mm; null unless this one does not and
    /// such a sheet was found.
    thickest_mm: Option<f64>,
    /// The smallest radius that the sheet is bent to, mm; null for a flat panel, and for a mesh,
    /// where it is not measured.
    bend_radius_min_mm: Option<f64>,
    /// The area of the Gauss image, steradians: how much of the unit sphere the normals sweep. 0
    /// for a developable surface; of a mesh, the angle defects at its inner vertices.
    gauss_area_sr: f64,
    /// The largest relative difference of a length, flat against space. Without unit.
    length_error_max: f64,
    /// The mean relative difference of all lengths. Without unit.
    length_error_mean: f64,
    /// The mean relative difference of all lengths, each weighed by the area of its triangles.
    /// Without unit; null unless it is a mesh.
    length_error_area_mean: Option<f64>,
    /// The largest factor by which a triangle is stretched in some direction, flat against space;
    /// null where the panel unrolls exactly.
    stretch_max: Option<f64>,
    /// The smallest such factor: below 1 it is pressed together.
    stretch_min: Option<f64>,
    /// The largest relative difference of a length that is accepted: the material's, or the default
    /// without one; null unless it is a mesh.
    stretch_limit: Option<f64>,
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
    /// Where a mesh was divided along its creases: the lines along which it is joined to other
    /// panels.
    joints: Vec<JointReport<'a>>,
    /// The edges of the pattern, loop after loop: runs of one curve, the ends of rails, the sides
    /// of cuts; of a mesh, where it meets other panels, and its border.
    edges: Vec<EdgeReport<'a>>,
    /// How far the pattern as it was written comes from the surface when it is folded up again,
    /// mm; null if it could not be read back. Of a mesh, how far its outline and holes as they were
    /// written lie from where they were laid.
    refold_error_mm: Option<f64>,
    /// The largest distance of the mesh from the optimal surface of its border alone, mm; null
    /// unless a mesh is divided along its creases, and where there is no such surface.
    rebuilt_distance_max_mm: Option<f64>,
    /// The mean of that distance over the area of the mesh, mm.
    rebuilt_distance_mean_mm: Option<f64>,
    /// Whether the flat pattern overlaps itself.
    overlaps: bool,
    /// Whether the surface passes through itself in space; null for a mesh, where it is not looked
    /// for.
    self_intersects: Option<bool>,
    /// The largest distance that a sample was moved, mm.
    moved_max_mm: f64,
    /// All distances that samples were moved, summed, mm.
    moved_total_mm: f64,
    /// What the panel was before it was to be moved; null where nothing was to be.
    before: Option<BeforeReport>,
    /// Points that rulings run together in, as in the tip of a cone.
    points: Vec<PointReport>,
    /// Where to divide it so that its parts bend; null where it bends, where no such division was
    /// found, and where none was looked for.
    division: Option<DivisionReport>,
    /// The panel in planar quads, and as a smooth surface; null unless the format `quads` or `step`
    /// was asked for.
    quads: Option<QuadsReport>,
    /// Will it bend?
    #[schemars(extend("enum" = Verdict::ALL.map(Verdict::name)))]
    verdict: &'static str,
    /// What was found, the worst first.
    findings: Vec<FindingReport>,
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

/// A panel in planar quads, and as a smooth surface over them.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Quads")]
struct QuadsReport {
    /// Quads.
    quads: usize,
    /// Triangles: ends of strips, and what is left of larger polygons with an odd number of
    /// corners.
    triangles: usize,
    /// Larger polygons where strips meet, before they were split.
    larger_polygons: usize,
    /// Whether all quads are planar.
    planar: bool,
    /// The largest distance between the diagonals of a quad before they were made planar, mm.
    planarity_before_mm: f64,
    /// The largest distance between the diagonals of a quad afterwards, mm.
    planarity_after_mm: f64,
    /// The largest distance by which a vertex was moved, mm.
    moved_max_mm: f64,
    /// The largest distance from a vertex to the boundary, mm; where not all are planar, that which
    /// it would take.
    off_boundary_max_mm: f64,
    /// Ruled strips of the smooth surface.
    strips: usize,
    /// The largest distance of the smooth surface's border from the boundary, mm.
    smooth_deviation_mm: f64,
    /// The largest angle between the tangent planes at both ends of a ruling of the smooth surface,
    /// degrees.
    smooth_warp_deg: f64,
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
    /// How long each of its sides is on the pattern, mm.
    sides_mm: [f64; 2],
    /// The sample of the boundary that it begins at, counted from 1 through all loops; null for a
    /// mesh.
    from_sample: Option<usize>,
    /// The sample that it ends at.
    to_sample: Option<usize>,
    /// How far apart the two places of a sample lie on the pattern, the larger of both, mm.
    gap_mm: f64,
}

/// A line along which a panel is joined to another.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Joint")]
struct JointReport<'a> {
    /// How it is marked on the patterns of both panels.
    mark: &'a str,
    /// The name of the other panel.
    with: &'a str,
    /// How long it is, mm.
    length_mm: f64,
    /// How long it is on the pattern of this panel, mm.
    flat_mm: f64,
}

/// A named run of the border of a pattern.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Edge")]
struct EdgeReport<'a> {
    /// Its name on the panel: that of its curve; `start` or `end` between two rails; `cut-1a` and
    /// `cut-1b` along a cut; of a mesh, the panel that it meets, or `border`. A second one of a
    /// name has `-2` after it, and so on.
    name: &'a str,
    /// How long it is in space, mm.
    length_space_mm: f64,
    /// How long it is on the pattern, mm.
    length_flat_mm: f64,
    /// By how much the polygon through its samples is shorter than its curve, mm; null along a cut,
    /// for a mesh, and where the rows of a table are the samples.
    curve_shorter_mm: Option<f64>,
    /// The edges that it is joined to, as `PANEL/EDGE`: those on the same stretch of a curve, and
    /// the other side of a cut. Empty for a free edge.
    mates: Vec<String>,
    /// The largest difference between its length on the pattern and that of a mate, along the
    /// stretch that both have in common, mm; null for a free edge.
    difference_mm: Option<f64>,
}

/// One thing found.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Finding")]
struct FindingReport {
    /// How bad it is: `error` do not cut, `warning` look at it before cutting, `note` good to know.
    #[schemars(extend("enum" = ["error", "warning", "note"]))]
    severity: &'static str,
    /// A name that scripts may rely on.
    code: &'static str,
    /// What is so, in words, and what to do.
    text: String,
    /// Where; empty where it is the whole panel.
    r#where: String,
}

/// `report.json` of a made design. What was written, and `quads`, have one entry a part; a refold
/// error that is not finite says that the written pattern could not be read back.
///
/// # Errors
/// What JSON can't say; a report is numbers, texts and lists, which it can.
///
/// # Panics
/// Unless there is one entry a part.
pub fn report_json(
    made: &Made,
    written: &Written<'_>,
    quads: &[Option<PanelQuads>],
) -> Result<Vec<u8>> {
    written.assert_complete(made);
    assert_eq!(made.parts.len(), quads.len(), "quads or none a part");
    let panels = made.parts.iter().enumerate().map(|(number, part)| {
        let common = of_part(made, number, written);
        match &part.origin {
            Origin::Found(found) => of_found(common, made, part, found, quads[number].as_ref()),
            Origin::Given(given) => of_given(common, made, part, given),
        }
    });
    let panels = panels.collect();
    let (name, material) = (&made.name[..], made.material.as_ref().map(|m| &m.name[..]));
    let sheets = sheets_report(made);
    to_bytes(&Report { sheetwright: VERSION, name, units: "mm", material, panels, sheets })
}

/// The JSON Schema of `report.json`.
///
/// # Errors
/// What JSON can't say; a schema is texts, numbers and lists, which it can.
pub fn report_schema() -> Result<Vec<u8>> {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    to_bytes(&settings.into_generator().into_root_schema_for::<Report<'_>>())
}

fn to_bytes(value: &impl Serialize) -> Result<Vec<u8>> {
    let mut bytes = serde_json::to_vec_pretty(value)?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn of_findings(checked: &Checked) -> Vec<FindingReport> {
    let findings = checked.findings.iter().map(|finding| FindingReport {
        severity: finding.severity().name(),
        code: finding.code(),
        text: finding_text(finding),
        r#where: finding_place(finding),
    });
    findings.collect()
}

fn of_edges<'a>(part: &'a Part, parts: &[Part]) -> Vec<EdgeReport<'a>> {
    let mate = |at: &EdgePlace| {
        let other = &parts[at.part];
        format!("{}/{}", other.name, other.edges[at.edge].name)
    };
    let of_edge = |edge: &'a Edge| EdgeReport {
        name: &edge.name,
        length_space_mm: edge.length_space_mm,
        length_flat_mm: edge.length_flat_mm,
        curve_shorter_mm: part.curve_shorter_mm(edge),
        mates: edge.mates.iter().map(mate).collect(),
        difference_mm: edge.difference_mm,
    };
    part.edges.iter().map(of_edge).collect()
}

fn of_seams(part: &Part) -> Vec<SeamReport> {
    let of_seam = |(n, seam): (usize, &Seam)| {
        let ends = part.found().map(|_| part.sheet.seam_rung(seam).ends().map(|s| s.get() + 1));
        SeamReport {
            mark: seam_mark(part.sheet.first_seam() + n),
            length_mm: seam.length_mm,
            sides_mm: seam.sides_flat_mm(&part.flat.points),
            from_sample: ends.map(|[from, _]| from),
            to_sample: ends.map(|[_, to]| to),
            gap_mm: seam.gap_mm,
        }
    };
    part.sheet.seams().iter().enumerate().map(of_seam).collect()
}

/// What is told of every part; what is told of a kind alone is left out.
fn of_part<'a>(made: &'a Made, number: usize, written: &Written<'_>) -> PanelReport<'a> {
    let part = &made.parts[number];
    let (sheet, measures, checked) = (&part.sheet, &part.measures, &written.checked[number]);
    let item = written.pattern_of(number).map(|(item, _)| item);
    let first = item.map_or(number, CutItem::first);
    let own = item.filter(|_| first == number);
    let instances = own.map_or(&[][..], |item| &item.instances);
    let predicted = part.predicted.as_ref();
    PanelReport {
        name: &part.name,
        pattern: &made.parts[first].name,
        count: own.map_or(0, |item| item.quantity().count),
        mirrored: own.map_or(0, |item| item.quantity().mirrored),
        instances: instances.iter().map(|of| &made.parts[of.number].name[..]).collect(),
        method: "mesh",
        goal: None,
        aim: None,
        proven_optimal: None,
        gap: None,
        samples: part.piece.net_loops().map(<[_]>::len).sum(),
        curve_distance_max_mm: None,
        curve_shorter_max_mm: None,
        tolerance_mm: None,
        triangles: sheet.mesh().triangles().len(),
        rungs: None,
        fold: None,
        price_total: None,
        twist_total: None,
        crease_max_deg: to_deg(measures.crease_max),
        warp_max_deg: None,
        warp_mean_deg: None,
        warp_limit_deg: warp_limit_deg(made.material.as_ref()),
        strain_p95: predicted.map(|p| p.strain),
        strain_range: predicted.map(|p| p.strain_range),
        strain_limit: stretch_limit(made.material.as_ref()),
        strain_by: predicted.map(|p| basis_name(p.basis)),
        outer_fibre: predicted.map(Predicted::outer_fibre),
        outer_fibre_limit: predicted.and_then(|p| p.limits.outer_fibre),
        thickness_mm: predicted.map(|p| p.limits.thickness_mm),
        hold_moment_n: predicted.and_then(Predicted::hold_moment_n),
        hold_load_n_per_m: predicted.and_then(Predicted::hold_load_n_per_mm).map(|n| 1e3 * n),
        rest_distance_mm: predicted.and_then(Predicted::rest_distance_mm),
        slide_mm: predicted.and_then(Predicted::slide_mm),
        thickest_mm: predicted.and_then(|p| p.thickest_mm),
        bend_radius_min_mm: None,
        gauss_area_sr: measures.gauss_area_sr,
        length_error_max: measures.length_error_max,
        length_error_mean: measures.length_error_mean,
        length_error_area_mean: None,
        stretch_max: None,
        stretch_min: None,
        stretch_limit: None,
        area_space_mm2: measures.area_space_mm2,
        area_flat_mm2: measures.area_flat_mm2,
        flat_width_mm: part.piece.size.x,
        flat_height_mm: part.piece.size.y,
        holes_flat: sheet.loops().len() - 1,
        seams: of_seams(part),
        joints: Vec::new(),
        edges: of_edges(part, &made.parts),
        refold_error_mm: finite(written.refold_errors_mm[number]),
        rebuilt_distance_max_mm: None,
        rebuilt_distance_mean_mm: None,
        overlaps: part.flat.overlap.is_some(),
        self_intersects: None,
        moved_max_mm: 0.0,
        moved_total_mm: 0.0,
        before: None,
        points: Vec::new(),
        division: division_report(part),
        quads: None,
        verdict: checked.verdict.name(),
        findings: of_findings(checked),
    }
}

/// The name of how a strain was found.
fn basis_name(basis: Basis) -> &'static str {
    match basis {
        Basis::Computed => "computed",
        Basis::Screen => "quick",
        Basis::NoNet => "no-net",
        Basis::NoRest => "no-rest",
        Basis::TooTight => "too-tight",
        Basis::Pattern => "pattern",
    }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

fn of_given<'a>(
    common: PanelReport<'a>,
    made: &'a Made,
    part: &'a Part,
    given: &'a Given,
) -> PanelReport<'a> {
    let distortion = part.measures.distortion.as_ref();
    let joints = given.joints.iter().map(|joint| JointReport {
        mark: &joint.mark,
        with: &made.parts[joint.with].name,
        length_mm: joint.length_mm,
        flat_mm: joint.flat_mm(&part.flat.points),
    });
    PanelReport {
        aim: Some(aim_name(given.aim)),
        length_error_area_mean: distortion.map(|d| d.length_error_mean_by_area),
        stretch_max: distortion.map(|d| d.stretch_max),
        stretch_min: distortion.map(|d| d.stretch_min),
        stretch_limit: Some(stretch_limit(made.material.as_ref())),
        joints: joints.collect(),
        rebuilt_distance_max_mm: given.rebuilt.as_ref().map(|r| r.distance_max_mm),
        rebuilt_distance_mean_mm: given.rebuilt.as_ref().map(|r| r.distance_mean_mm),
        ..common
    }
}

fn of_found<'a>(
    common: PanelReport<'a>,
    made: &'a Made,
    part: &'a Part,
    found: &'a Found,
    quads: Option<&PanelQuads>,
) -> PanelReport<'a> {
    let measures = &part.measures;
    let change = found.change.as_ref();
    PanelReport {
        method: found.method.name(),
        goal: Some(found.goal.name()),
        proven_optimal: Some(found.triangulation.proven_optimal),
        gap: found.triangulation.gap(),
        samples: found.boundary.len(),
        curve_distance_max_mm: found.chords.distance_max_mm(),
        curve_shorter_max_mm: found.chords.shorter_max_mm(),
        tolerance_mm: found.tolerance_mm,
        rungs: Some(found.surface.connectivity().hinges().len()),
        fold: Some(found.fold),
        price_total: Some(found.triangulation.price_without_hints()),
        twist_total: Some(measures.twist_total),
        warp_max_deg: Some(to_deg(measures.warp_max)),
        warp_mean_deg: Some(to_deg(measures.warp_mean)),
        bend_radius_min_mm: finite(measures.bend_radius_min_mm),
        self_intersects: Some(measures.self_crossing.is_some()),
        moved_max_mm: change.map_or(0.0, Change::moved_max_mm),
        moved_total_mm: change.map_or(0.0, Change::moved_total_mm),
        before: change.and_then(|change| of_before(&change.before)),
        points: point_reports(made, part, found),
        quads: quads.map(of_quads),
        ..common
    }
}

fn of_quads(quads: &PanelQuads) -> QuadsReport {
    let PanelQuads { planar, smooth } = quads;
    let of_corners = |n: usize| planar.mesh.faces().filter(|face| face.len() == n).count();
    QuadsReport {
        quads: of_corners(4),
        triangles: of_corners(3),
        larger_polygons: planar.mesh.larger_polygons(),
        planar: matches!(planar.end, PlanarEnd::OnOutline | PlanarEnd::OffOutline),
        planarity_before_mm: planar.uneven_before_mm,
        planarity_after_mm: planar.uneven_after_mm,
        moved_max_mm: planar.moved_max_mm,
        off_boundary_max_mm: planar.off_max_mm,
        strips: smooth.strips(),
        smooth_deviation_mm: smooth.deviation_max_mm,
        smooth_warp_deg: to_deg(smooth.warp_max),
    }
}

fn of_before(before: &Part) -> Option<BeforeReport> {
    Some(BeforeReport {
        price_total: before.found()?.triangulation.price_without_hints(),
        twist_total: before.measures.twist_total,
        warp_max_deg: to_deg(before.measures.warp_max),
        warp_mean_deg: to_deg(before.measures.warp_mean),
        verdict: before.checked.verdict.name(),
    })
}
