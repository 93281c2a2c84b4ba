//! Findings on a mesh that was laid flat, and its verdict: how much it must stretch.

use super::{Checked, EASY_SHARE, Finding, Remedy, Severity, Verdict};
use crate::material::{Material, stretch_limit};
use crate::mesh::{CutMesh, Mesh, Specks, crease_angles};
use crate::pattern::{SCORED_CREASE_DEG, seam_mark};
use sheetwright_geometry::math::{Point3, to_deg};

/// The border is true up to this share of a length.
const TRUE_BORDER: f64 = 1e-9;
/// Length errors below it, as a share, are rounding and no finding: less than any shop can measure.
const UNSEEN: f64 = 1e-6;

/// Everything known of a mesh panel when it is checked.
#[derive(Clone, Copy, Debug)]
pub struct MeshPanel<'a> {
    /// The mesh in space.
    pub mesh: &'a Mesh,
    /// The mesh as it is cut to lie flat.
    pub sheet: &'a CutMesh,
    /// The largest relative length error of a side, flat against space, without its sign.
    pub length_error_max: f64,
    /// The side with that error, by its number among those of the sheet.
    pub worst_edge: Option<usize>,
    /// The largest relative length error of the border's sides, where it was to be true.
    pub border_error: Option<f64>,
    /// A cut that would help, from inside or from a hole to the border: its ends, mm.
    pub cut: Option<[Point3; 2]>,
    /// Two sides of the border, by their first vertices on the sheet, between which it overlaps
    /// itself when it is flat.
    pub overlap: Option<[Point3; 2]>,
    /// Triangles that lie upside down when it is flat.
    pub flipped: usize,
    /// Triangles of the file that were left out, with two corners in one place.
    pub left_out: usize,
    /// Parts of it that were left out because they are too small to be sheet.
    pub specks: Option<Specks>,
    /// Points in which parts of it met that have no side in common there.
    pub contacts: usize,
    /// Cuts that were asked for, from the border to points inside.
    pub darts: usize,
    /// Its material, if one is named.
    pub material: Option<&'a Material>,
}

/// Checks a mesh panel.
pub fn check_mesh(panel: &MeshPanel<'_>) -> Checked {
    let checks = [stretch, border, overlap, flipped, folds, seams, left_out, specks, contacts];
    let mut findings: Vec<Finding> = checks.iter().filter_map(|check| check(panel)).collect();
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    let has = |code: &str, severity: Severity| {
        findings.iter().any(|f| f.code == code && f.severity == severity)
    };
    let verdict = if has("stretch-too-large", Severity::Error) || has("folds", Severity::Error) {
        Verdict::WillNotBend
    } else if has("stretch", Severity::Warning) {
        Verdict::BendsWithForce
    } else if has("folds", Severity::Warning) {
        Verdict::BendsAndFolds
    } else {
        Verdict::Bends
    };
    Checked { verdict, findings }
}

/// A share in per cent, with two digits that count.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let shifted = std::iter::successors(Some(percent), |x| Some(x * 10.0));
    let digits = shifted.take(9).take_while(|x| *x < 10.0).count();
    format!("{percent:.digits$} %")
}

fn place(p: Point3) -> String {
    // Rounded first, so that no zero has a sign.
    let [x, y, z] = [p.x, p.y, p.z].map(|c| (c * 10.0).round() / 10.0 + 0.0);
    format!("({x:.1}, {y:.1}, {z:.1}) mm")
}

fn stretch(panel: &MeshPanel<'_>) -> Option<Finding> {
    let error = panel.length_error_max;
    let limit = stretch_limit(panel.material);
    let worst = panel.worst_edge.map(|n| {
        let [a, b] = panel.sheet.mesh.edges()[n].ends.map(|v| panel.sheet.mesh.position(v));
        format!("at {}", place(a.lerp(b, 0.5)))
    });
    let takes = match panel.material {
        Some(m) => format!("{} takes {}", first_up(&m.title), percent(limit)),
        None => format!("Without a material that is named, {} is accepted", percent(limit)),
    };
    let what = format!(
        "Laid flat, lengths differ from the surface by up to {}: by so much the sheet must stretch.",
        percent(error)
    );
    let mut remedies = Vec::new();
    // Also for what is no number.
    let (severity, code, text) = if error.is_nan() || error > limit {
        let mut advice = Vec::new();
        if let Some([inside, border]) = panel.cut {
            let (to, from) = (place(inside), place(border));
            advice.push(format!("cut it from the border at {from} to {to}"));
            remedies.extend((panel.darts == 0).then_some(Remedy::Darts));
        }
        if sharp_creases(panel).next().is_some() {
            advice.push("divide it along its sharp creases".to_owned());
            remedies.push(Remedy::SplitCreases);
        }
        advice.push("divide it into more panels in the program that it is from".to_owned());
        let text = format!(
            "{what} {takes}. {}, or take a sheet that stretches more.",
            first_up(&advice.join(", "))
        );
        (Severity::Error, "stretch-too-large", text)
    } else if error > EASY_SHARE * limit {
        (Severity::Warning, "stretch", format!("{what} {takes}."))
    } else if error > UNSEEN {
        (Severity::Note, "length-error", what)
    } else {
        return None;
    };
    Some(Finding { severity, code, text, place: worst.unwrap_or_default(), remedies })
}

fn border(panel: &MeshPanel<'_>) -> Option<Finding> {
    let error = panel.border_error.filter(|error| *error > TRUE_BORDER)?;
    Some(Finding {
        severity: Severity::Warning,
        code: "border-not-true",
        text: format!(
            "The border was to keep its lengths, and could not: they differ by up to {}. Cut the panel \
             open, or divide it.",
            percent(error)
        ),
        place: String::new(),
        remedies: Vec::new(),
    })
}

fn first_up(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |c| c.to_uppercase().chain(chars).collect())
}

fn overlap(panel: &MeshPanel<'_>) -> Option<Finding> {
    let [a, b] = panel.overlap?;
    Some(Finding {
        severity: Severity::Error,
        code: "overlap",
        text:
            "Laid flat, the pattern overlaps itself, so it can't be cut from one sheet. Divide the \
               panel."
                .to_owned(),
        place: format!("the border at {} and at {}", place(a), place(b)),
        remedies: Vec::new(),
    })
}

fn flipped(panel: &MeshPanel<'_>) -> Option<Finding> {
    let count = panel.flipped;
    (count > 0).then(|| Finding {
        severity: Severity::Error,
        code: "flipped",
        text: format!(
            "Laid flat, {} upside down: the pattern is folded over itself there. Divide the panel.",
            if count == 1 {
                "a triangle lies".to_owned()
            } else {
                format!("{count} triangles lie")
            }
        ),
        place: String::new(),
        remedies: Vec::new(),
    })
}

/// The angles of all creases to be scored, degrees.
fn sharp_creases(panel: &MeshPanel<'_>) -> impl Iterator<Item = f64> {
    let angles = crease_angles(&panel.sheet.mesh);
    angles.into_iter().map(to_deg).filter(|&deg| deg > SCORED_CREASE_DEG)
}

fn folds(panel: &MeshPanel<'_>) -> Option<Finding> {
    let sharp: Vec<f64> = sharp_creases(panel).collect();
    let sharpest = sharp.iter().copied().reduce(f64::max)?;
    let (severity, advice, remedies) = match panel.material {
        Some(m) if !m.folds() => (
            Severity::Error,
            format!("{} does not fold: divide it there.", first_up(&m.title)),
            vec![Remedy::SplitCreases],
        ),
        _ => (Severity::Warning, "The pattern marks them to be scored.".to_owned(), Vec::new()),
    };
    Some(Finding {
        severity,
        code: "folds",
        text: format!(
            "The mesh has sharp creases, of up to {sharpest:.1}°, along {} of its sides. {advice}",
            sharp.len()
        ),
        place: String::new(),
        remedies,
    })
}

fn seams(panel: &MeshPanel<'_>) -> Option<Finding> {
    let sheet = panel.sheet;
    let lengths: Vec<f64> = sheet.seams.iter().map(|seam| seam_length(&sheet.mesh, seam)).collect();
    let whole: f64 = lengths.iter().sum();
    let last = seam_mark(lengths.len().checked_sub(1)?);
    let (along, marks) = match lengths.len() {
        1 => ("a seam".to_owned(), last),
        n => (format!("{n} seams"), format!("{} to {last}", seam_mark(0))),
    };
    let why = if panel.mesh.loops().is_empty() {
        "It is closed, so it is cut open"
    } else if panel.darts > 0 {
        "To stretch less, it is cut"
    } else {
        "In one piece it does not lie flat, so it is cut open"
    };
    Some(Finding {
        severity: Severity::Note,
        code: "seam",
        text: format!(
            "{why} along {along}, {whole:.1} mm long{}. Join the sides that have the same mark.",
            if lengths.len() == 1 { "" } else { " together" }
        ),
        place: marks,
        remedies: Vec::new(),
    })
}

/// How long a seam is in space, mm.
pub fn seam_length(sheet: &Mesh, seam: &crate::mesh::MeshSeam) -> f64 {
    let way = seam.sides[0].windows(2);
    way.map(|pair| sheet.position(pair[0]).distance(sheet.position(pair[1]))).sum()
}

fn left_out(panel: &MeshPanel<'_>) -> Option<Finding> {
    let count = panel.left_out;
    (count > 0).then(|| Finding {
        severity: Severity::Note,
        code: "left-out",
        text: format!(
            "{} of the file with two corners in one place, without area, {} left out.",
            if count == 1 { "A triangle".to_owned() } else { format!("{count} triangles") },
            if count == 1 { "was" } else { "were" }
        ),
        place: String::new(),
        remedies: Vec::new(),
    })
}

fn specks(panel: &MeshPanel<'_>) -> Option<Finding> {
    let Specks { parts, first } = panel.specks?;
    Some(Finding {
        severity: Severity::Note,
        code: "left-out",
        text: format!(
            "{} left out: smaller than 1e-6 mm, or narrower than 1e-12 of the size of the file.",
            match parts {
                1 => "A part of the mesh was".to_owned(),
                _ => format!("{parts} parts of the mesh were"),
            }
        ),
        place: format!("{}at {}", if parts == 1 { "" } else { "the first " }, place(first)),
        remedies: Vec::new(),
    })
}

fn contacts(panel: &MeshPanel<'_>) -> Option<Finding> {
    let count = panel.contacts;
    (count > 0).then(|| Finding {
        severity: Severity::Note,
        code: "point-contact",
        text: format!(
            "Parts of the mesh meet in {} alone, where nothing would hold them: they are taken apart \
             there.",
            if count == 1 { "a point".to_owned() } else { format!("{count} points") }
        ),
        place: String::new(),
        remedies: Vec::new(),
    })
}
