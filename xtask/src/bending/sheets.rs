//! Sheets whose verdicts are compared with a finer net: which, and how they are judged.

use sheetwright::check::{FindingKind, Verdict};
use sheetwright::design::Design;
use sheetwright::elastic::{Basis, Elastic, ElasticOptions, Predicted, Stiffness, elastic, screen};
use sheetwright::flatten::Flattened;
use sheetwright::index::VertexIndex;
use sheetwright::make::{MakeError, Part, make};
use sheetwright::mesh::Cut;
use sheetwright::sheet::cut_along;
use sheetwright::template::catalogue;
use sheetwright::watch::Unwatched;
use sheetwright_files::{ReadOptions, design_from_template, material_named, read_input};
use sheetwright_shapes::bent;
use std::error::Error;

/// The sheets that every design is made of, whatever its own.
pub(super) const THICKNESSES: [&str; 2] = ["steel-1mm", "steel-5mm"];
/// A verdict is wrong if the finer net is beyond the limit by more than this factor.
pub(super) const MOST_WRONG: f64 = 1.5;
/// Smaller strains are rounding.
pub(super) const NO_STRAIN: f64 = 1e-9;
/// Triangles of the finer net.
const FINE: usize = 2000;
/// Panels whose strain is within this factor of the limit have a finer net, beside the panel of a
/// design that is strained most.
const NEAR: f64 = 4.0;
/// Strains that agree to this share are those of panels that are equal but for where they lie.
const EQUAL: f64 = 1e-3;

const EXAMPLES: [&str; 8] = [
    "leaf.csv",
    "flower.sheet.json",
    "hat.sheet.json",
    "mouse.sheet.json",
    "reducer.sheet.json",
    "square-to-round.sheet.json",
    "three-cones.sheet.json",
    "ubc-fishing-vessel.sheet.json",
];
const GALLERY: [&str; 6] = [
    "hemisphere-36",
    "multiply-connected",
    "raised",
    "revolution-12",
    "revolution-4",
    "three-cones",
];
const TWISTS_DEG: [f64; 6] = [5.0, 10.0, 20.0, 45.0, 60.0, 90.0];
const WAVES: [[f64; 2]; 5] = [[20.0, 0.35], [40.0, 0.35], [40.0, 0.8], [60.0, 0.8], [80.0, 1.2]];
const SADDLES_MM: [f64; 4] = [15.0, 40.0, 80.0, 150.0];
const CURVES: std::ops::Range<u64> = 0..8;

/// A design to be judged.
pub(super) struct Case {
    pub(super) name: String,
    design: Design,
}

/// All designs: templates, examples, the gallery, and known kinds of panels.
pub(super) fn cases() -> Result<Vec<Case>, Box<dyn Error>> {
    let mut cases = Vec::new();
    let mut add = |name: String, design: Design| cases.push(Case { name, design });
    for template in catalogue() {
        add(template.name.to_owned(), design_from_template(template.name, &[])?);
    }
    let read = |path: String| read_input(&crate::root().join(path), &ReadOptions::default());
    for name in EXAMPLES {
        let stem = name.split('.').next().unwrap_or(name);
        add(format!("example: {stem}"), read(format!("examples/{name}"))?);
    }
    for name in GALLERY {
        let path = format!("examples/gallery/{name}.sheet.json");
        add(format!("gallery: {name}"), read(path)?);
    }
    let twisted = TWISTS_DEG.map(bent::twisted);
    let wavy = WAVES.map(|[height, phase]| bent::wavy(height, phase));
    let saddles = SADDLES_MM.map(bent::saddle);
    let curves = CURVES.map(bent::fourier);
    for design in twisted.into_iter().chain(wavy).chain(saddles).chain(curves) {
        add(design.name.clone(), design);
    }
    Ok(cases)
}

/// A panel as it is judged.
pub(super) struct Judged {
    pub(super) panel: String,
    /// Its strain by the formula, by the computed sheet, and its limit, without unit.
    pub(super) quick: f64,
    pub(super) computed: f64,
    pub(super) limit: f64,
    /// Its strain on the finer net; `None` where its pattern overlaps itself or it finds no rest,
    /// and of a panel that was not compared.
    pub(super) fine: Option<f64>,
    pub(super) verdict: Verdict,
    /// Whether the verdict is that it must stretch by too much.
    pub(super) is_refused: bool,
}

impl Judged {
    /// By what factor the finer net is on the other side of the limit; 1 at most if it is not.
    fn beyond(&self) -> f64 {
        match self.fine {
            Some(fine) if self.is_refused => self.limit / fine,
            Some(fine) if self.verdict != Verdict::Undecided => fine / self.limit,
            _ => 0.0,
        }
    }
}

/// A design as it is judged in both thicknesses.
pub(super) struct Row {
    pub(super) name: String,
    pub(super) panels: usize,
    /// Its panels that bend, equal ones once.
    pub(super) judged: [Vec<Judged>; 2],
}

impl Row {
    /// Of each thickness the panel that is strained most.
    pub(super) fn worst(&self) -> [Option<&Judged>; 2] {
        let most = |a: &&Judged, b: &&Judged| a.computed.total_cmp(&b.computed);
        self.judged.each_ref().map(|panels| panels.iter().max_by(most))
    }

    /// What is wrong with the verdicts on its panels, in words.
    pub(super) fn wrong(&self) -> Vec<String> {
        let panels = THICKNESSES.iter().zip(&self.judged);
        let panels = panels.flat_map(|(sheet, panels)| panels.iter().map(move |p| (sheet, p)));
        let wrong = panels.filter(|(_, panel)| panel.beyond() > MOST_WRONG);
        wrong
            .map(|(sheet, panel)| {
                format!(
                    "{}, {} of {sheet}: {:?} at {:.4} %, and a finer net has {:.4} %",
                    self.name,
                    panel.panel,
                    panel.verdict,
                    100.0 * panel.computed,
                    100.0 * panel.fine.unwrap_or(f64::NAN),
                )
            })
            .collect()
    }
}

/// Judges a design in both thicknesses.
pub(super) fn row(case: &Case) -> Result<Row, MakeError> {
    let mut panels = 0;
    let mut judge = |sheet: &str| -> Result<Vec<Judged>, MakeError> {
        let material = material_named(sheet, &[]);
        let design = Design { material, ..case.design.clone() };
        let made = make(&design, &mut Unwatched)?;
        panels = made.parts.len();
        let strains = made.parts.iter().filter_map(|part| part.predicted.as_ref());
        let most = strains.map(|predicted| predicted.strain).fold(0.0, f64::max);
        let mut judged: Vec<Judged> = Vec::new();
        for part in &made.parts {
            let Some(predicted) = &part.predicted else { continue };
            let is_known = |p: &Judged| {
                let away = (p.computed - predicted.strain).abs();
                away <= EQUAL * p.computed && p.verdict == part.checked.verdict
            };
            if !judged.iter().any(is_known) {
                judged.push(of_panel(part, predicted, &design, most));
            }
        }
        Ok(judged)
    };
    let judged = [judge(THICKNESSES[0])?, judge(THICKNESSES[1])?];
    Ok(Row { name: case.name.clone(), panels, judged })
}

/// How a panel is judged, in a design whose panels are strained by `most`.
fn of_panel(part: &Part, predicted: &Predicted, design: &Design, most: f64) -> Judged {
    let is_too_much = |kind: &FindingKind| matches!(kind, FindingKind::StrainTooLarge { .. });
    let is_refused = part.checked.findings.iter().any(|finding| is_too_much(&finding.kind));
    let fine = |scored: &[usize]| strain_on_fine_net(part, predicted, scored);
    let fine = match (&predicted.at_rest, predicted.basis) {
        (None, Basis::Computed) => Some(0.0),
        _ if predicted.strain < most && !is_near(predicted) => None,
        // A sheet that is refused must be refused whether it is scored or not.
        _ if is_refused => {
            [&[][..], &predicted.scored].map(fine).into_iter().flatten().reduce(f64::min)
        }
        _ => fine(&predicted.scored),
    };
    Judged {
        panel: part.name.clone(),
        quick: screen(&part.sheet, &part.flat, &part.measures, design.material.as_ref()).strain,
        computed: predicted.strain,
        limit: predicted.limits.strain,
        fine,
        verdict: part.checked.verdict,
        is_refused,
    }
}

/// Whether the strain is near the limit.
fn is_near(predicted: &Predicted) -> bool {
    let share = predicted.strain / predicted.limits.strain;
    share > 1.0 / NEAR && share < NEAR
}

/// The strain of the panel on a finer net, scored along these rungs.
fn strain_on_fine_net(part: &Part, predicted: &Predicted, scored: &[usize]) -> Option<f64> {
    let limits = &predicted.limits;
    let modulus = limits.modulus_n_per_mm2.unwrap_or(1.0);
    let stiffness = Stiffness::new(limits.thickness_mm, modulus, limits.poisson);
    let bending_n_mm = stiffness.bending_n_mm * limits.moment_share;
    let stiffness = Stiffness { bending_n_mm, ..stiffness };
    let mesh = part.sheet.mesh();
    let ends = scored.iter().map(|&rung| part.sheet.rung_ends()[rung]);
    let cut: Cut = ends.filter_map(|[a, b]| mesh.topology().edge_between(a, b)).collect();
    let sheet = cut_along(mesh, &cut).ok()?;
    let vertices = (0..sheet.mesh().positions().len()).map(VertexIndex::new);
    let points = vertices.map(|v| part.flat.points[sheet.origin(v).get()]).collect();
    let flat = Flattened { points, overlap: None };
    let options = ElasticOptions { triangles: FINE, ..ElasticOptions::default() };
    elastic(&sheet, &flat, stiffness, &options, &mut Unwatched).ok().as_ref().map(Elastic::strain)
}
