//! Findings: what is wrong with a panel, where, how bad, and what to do; and the verdict.

mod finding;
mod mesh;
mod origin;

pub use finding::{Checked, Finding, Remedy, Severity, Verdict};
pub use mesh::{MeshPanel, check_mesh, seam_length};
pub use origin::{
    BoundaryMoved, moved, ran_on, rounded_corner, smoothed_joints, stayed_straight, turned_round,
};

use crate::flatten::{Flattened, Seam, Sheet};
use crate::material::{Material, warp_limit_deg};
use crate::measure::{Measures, RungMeasures, SHARP_CREASE_DEG};
use crate::pattern::seam_mark;
use sheetwright_geometry::boundary::Boundary;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{from_deg, to_deg};
use sheetwright_geometry::tolerance::Tolerance;
use sheetwright_optimum::triangulate::Triangulation;

/// How much of a long list is shown: the first few stand for all.
const SHOWN: usize = 6;
/// Up to this share of the warp limit a sheet goes into shape by itself; above it, with force.
/// Half of the limit: a choice, not a measurement, so that a warning comes well before the limit.
pub const EASY_SHARE: f64 = 0.5;
/// Length errors below it, as a share of the size over the shortest side, are rounding: an exact
/// pattern has a thousandth of it.
const ROUNDING: f64 = 1e-9;

/// Everything known of a panel when it is checked.
#[derive(Clone, Copy, Debug)]
pub struct Panel<'a> {
    /// Its boundary.
    pub boundary: &'a Boundary,
    /// Its triangulation.
    pub triangulation: &'a Triangulation,
    /// Its sheet.
    pub sheet: &'a Sheet,
    /// Its flat pattern.
    pub flat: &'a Flattened,
    /// Its measures.
    pub measures: &'a Measures,
    /// Its material, if one is named.
    pub material: Option<&'a Material>,
}

/// Checks a panel.
pub fn check(panel: &Panel<'_>) -> Checked {
    let checks = [
        warp,
        coarse_samples,
        bend_radius,
        points,
        crossing,
        overlap,
        forced_rungs,
        folds,
        bend_lines,
        length_error,
        open_windows,
        seams,
        not_proven,
    ];
    let mut findings: Vec<Finding> = checks.iter().filter_map(|check| check(panel)).collect();
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    let has = |code: &str, severity: Severity| {
        findings.iter().any(|f| f.code == code && f.severity == severity)
    };
    let broken = ["warp-too-large", "radius-too-small", "point", "self-crossing", "folds"];
    let verdict = if broken.iter().any(|code| has(code, Severity::Error)) {
        Verdict::WillNotBend
    } else if has("coarse-samples", Severity::Warning) {
        Verdict::Undecided
    } else if has("warp-high", Severity::Warning) {
        Verdict::BendsWithForce
    } else if has("folds", Severity::Warning) {
        Verdict::BendsAndFolds
    } else {
        Verdict::Bends
    };
    Checked { verdict, findings }
}

/// The finding that a written pattern does not fold back onto its surface; `None` if it does.
/// `error_mm` is how far it comes from it, `size_mm` the size of the boundary; `known_mm` is how
/// far the pattern comes from it before it is written, where its lengths are not exact: else 0.
pub fn refolding(error_mm: f64, size_mm: f64, known_mm: f64) -> Option<Finding> {
    let limit = Tolerance::REFOLD.length_mm(size_mm) + known_mm;
    (error_mm.is_nan() || error_mm > limit).then(|| Finding {
        severity: Severity::Error,
        code: "refold",
        text: format!(
            "Folded up again, the written pattern misses the surface by {error_mm:.3} mm \
             ({limit:.2e} mm is allowed). Do not cut it; this is a fault of the program."
        ),
        place: String::new(),
        remedies: Vec::new(),
    })
}

fn warp(panel: &Panel<'_>) -> Option<Finding> {
    let limit = from_deg(warp_limit_deg(panel.material));
    let rungs = &panel.measures.rungs;
    let sheet = panel.material.map_or("a sheet", |m| &m.title);
    let beyond = |bound: f64| move |r: &RungMeasures| r.warp_beyond_sampling() > bound;
    let largest = |bound: f64| {
        rungs.iter().filter(|r| beyond(bound)(r)).map(|r| r.warp).reduce(f64::max).map(to_deg)
    };
    if let Some(most) = largest(limit) {
        let count = rungs.iter().filter(|r| beyond(limit)(r)).count();
        return Some(Finding {
            severity: Severity::Error,
            code: "warp-too-large",
            text: format!(
                "The surface twists by up to {most:.1}° along its rulings, at {count} of {} of \
                 them by more than the {:.1}° that {sheet} takes. Move the boundary there, or \
                 divide the panel.",
                rungs.len(),
                to_deg(limit)
            ),
            place: where_rungs(rungs, beyond(limit)),
            remedies: Vec::new(),
        });
    }
    if let Some(most) = largest(EASY_SHARE * limit) {
        return Some(Finding {
            severity: Severity::Warning,
            code: "warp-high",
            text: format!(
                "The surface twists by up to {most:.1}° along its rulings, and {sheet} takes \
                 {:.1}°: it needs force.",
                to_deg(limit)
            ),
            place: where_rungs(rungs, beyond(EASY_SHARE * limit)),
            remedies: Vec::new(),
        });
    }
    None
}

fn coarse_samples(panel: &Panel<'_>) -> Option<Finding> {
    let limit = from_deg(warp_limit_deg(panel.material));
    let rungs = &panel.measures.rungs;
    let told = |r: &RungMeasures| r.warp <= limit || r.warp_beyond_sampling() > 0.0;
    // What is known to twist too much needs no doubt beside it.
    let known = rungs.iter().any(|r| r.warp_beyond_sampling() > limit);
    (!known && !rungs.iter().all(told)).then(|| Finding {
        severity: Severity::Warning,
        code: "coarse-samples",
        text: format!(
            "Rungs turn by up to {:.1}°, which may be the bend from one sample to the next or \
             twist: these samples are too coarse to tell. Ask for more.",
            to_deg(panel.measures.warp_max)
        ),
        place: where_rungs(rungs, |r| !told(r)),
        remedies: Vec::new(),
    })
}

fn bend_radius(panel: &Panel<'_>) -> Option<Finding> {
    let material = panel.material?;
    let least = panel.measures.bend_radius_min_mm;
    let takes = material.bend_radius_mm.value;
    (least < takes).then(|| Finding {
        severity: Severity::Error,
        code: "radius-too-small",
        text: format!(
            "The panel is bent to a radius of {least:.1} mm, and {} takes {takes:.1} mm. Take a \
             thinner sheet, or a rounder boundary.",
            material.title
        ),
        place: where_rungs(&panel.measures.rungs, |r| r.bend_radius_mm < takes),
        remedies: Vec::new(),
    })
}

/// A point round which the sheet turns by less than this, degrees, is rounded off and hardly seen.
const SEEN_POINT_DEG: f64 = 15.0;

/// A point is no harder on a sheet than a fold through it would be. So what takes folds takes
/// points; what does not can't have any, unless the shallowest roll that rounds it off is wide
/// enough.
fn points(panel: &Panel<'_>) -> Option<Finding> {
    let apexes = &panel.measures.apexes;
    let sharpest = apexes.iter().max_by(|a, b| a.turn.total_cmp(&b.turn))?;
    let stiff =
        panel.material.filter(|m| !m.folds() && sharpest.radius_mm < m.bend_radius_mm.value);
    if stiff.is_none() && to_deg(sharpest.turn) < SEEN_POINT_DEG {
        return None;
    }
    let one = apexes.len() == 1;
    let (severity, advice) = match stiff {
        Some(m) => (
            Severity::Error,
            format!(
                "{} takes a radius of {:.1} mm, and there it would have to take {:.1} mm. Cut the \
                 point off, or move the boundary there.",
                m.title, m.bend_radius_mm.value, sharpest.radius_mm
            ),
        ),
        None => (
            Severity::Note,
            format!(
                "The bend radius in this report leaves {} out.",
                if one { "it" } else { "them" }
            ),
        ),
    };
    let begin = match (severity, one) {
        (Severity::Note, true) => "Bend the corner in steps: bend lines run together in it",
        (Severity::Note, false) => "Bend the corners in steps: bend lines run together in them",
        (_, true) => "Bend lines run together in a point",
        (_, false) => "Bend lines run together in points",
    };
    let samples: Vec<String> =
        apexes.iter().take(SHOWN).map(|apex| (apex.sample.get() + 1).to_string()).collect();
    let more = apexes.len().saturating_sub(SHOWN);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    Some(Finding {
        severity,
        code: "point",
        text: format!(
            "{begin} and turn the sheet by up to {:.1}° there. {advice}",
            to_deg(sharpest.turn)
        ),
        place: format!("sample{} {}{rest}", if one { "" } else { "s" }, samples.join(", ")),
        remedies: Vec::new(),
    })
}

fn crossing(panel: &Panel<'_>) -> Option<Finding> {
    let [t, u] = panel.measures.self_crossing?;
    let corners = |t: sheetwright_geometry::index::TriangleIndex| {
        panel.triangulation.triangles[t.get()].map(|s| (s.get() + 1).to_string()).join(", ")
    };
    Some(Finding {
        severity: Severity::Error,
        code: "self-crossing",
        text: "The surface passes through itself in space. Ask for a supporting plane, or change \
               the boundary."
            .to_owned(),
        place: format!("triangles at samples {} and {}", corners(t), corners(u)),
        remedies: Vec::new(),
    })
}

fn overlap(panel: &Panel<'_>) -> Option<Finding> {
    let (a, b) = panel.flat.overlap?;
    let sample = |n: usize| panel.sheet.origin(SampleIndex::new(n)).get() + 1;
    // Both sides of a cut may begin at one sample, so an edge is named by both of its ends.
    let loops = panel.sheet.surface().connectivity().loops();
    let next = |n: usize| {
        let of_loop = loops.iter().find(|of_loop| of_loop.contains(&n));
        of_loop.filter(|of_loop| n + 1 == of_loop.end).map_or(n + 1, |of_loop| of_loop.start)
    };
    let edge = |n: usize| format!("{} to {}", sample(n), sample(next(n)));
    Some(Finding {
        severity: Severity::Error,
        code: "overlap",
        text: "Laid flat, the pattern overlaps itself, so it can't be cut from one sheet. Divide \
               the panel."
            .to_owned(),
        place: format!("edges from sample {} and from {}", edge(a), edge(b)),
        remedies: Vec::new(),
    })
}

fn forced_rungs(panel: &Panel<'_>) -> Option<Finding> {
    let count = panel.triangulation.forced_rungs;
    (count > 0).then(|| Finding {
        severity: Severity::Warning,
        code: "rung-without-plane",
        text: format!(
            "{} along the boundary's own direction, where no tangent plane is given, and no \
             surface does without {}. More samples may help.",
            if count == 1 { "One rung runs".to_owned() } else { format!("{count} rungs run") },
            if count == 1 { "it" } else { "them" }
        ),
        place: where_rungs(&panel.measures.rungs, |r| {
            r.normals[0] == sheetwright_geometry::math::Vec3::ZERO
        }),
        remedies: Vec::new(),
    })
}

/// The finding that a surface which need not lie over the supporting plane has a much lower price.
pub fn better_without_plane(with: f64, without: f64) -> Finding {
    Finding {
        severity: Severity::Note,
        code: "better-without-plane",
        text: format!(
            "Seen along its normal the boundary is a simple outline, so the surface was laid over that \
             plane. Where it may wrap round or hang over, there is one that bends better, at {:.0} % \
             of the price: ask for the plane \"none\".",
            100.0 * without / with
        ),
        place: String::new(),
        remedies: Vec::new(),
    }
}

fn not_proven(panel: &Panel<'_>) -> Option<Finding> {
    let better = match panel.triangulation.gap() {
        Some(gap) if gap > 0.0 => {
            format!("A better one may exist, with a price up to {:.2} % lower", 100.0 * gap)
        }
        // Of one loop this is said where another method was asked for, which proves nothing.
        None if panel.boundary.holes() > 0 => {
            "A better one may exist; how much lower its price may be is not known".to_owned()
        }
        _ => return None,
    };
    let (how, remedies) = if panel.triangulation.cut_short {
        let how = " The search ended with the work that it may do; a greater \"effort\" of the panel \
                   allows more.";
        (how, vec![Remedy::Effort])
    } else {
        ("", Vec::new())
    };
    Some(Finding {
        severity: Severity::Note,
        code: "not-proven",
        text: format!(
            "This is the best surface that was found. {better}; the pattern is exact for this one.{how}"
        ),
        place: String::new(),
        remedies,
    })
}

fn folds(panel: &Panel<'_>) -> Option<Finding> {
    let rungs = &panel.measures.rungs;
    let sharpest = rungs.iter().filter(|r| r.is_fold).map(|r| r.crease.abs()).reduce(f64::max)?;
    let count = rungs.iter().filter(|r| r.is_fold).count();
    let (severity, advice) = match panel.material {
        Some(m) if !m.folds() => {
            (Severity::Error, format!("{} does not fold; move the boundary there.", m.title))
        }
        _ => (Severity::Warning, "The pattern marks it to be scored.".to_owned()),
    };
    Some(Finding {
        severity,
        code: "folds",
        text: format!(
            "The surface has {count} sharp {}, of up to {:.1}°, where it can't bend smoothly. \
             {advice}",
            if count == 1 { "fold" } else { "folds" },
            to_deg(sharpest)
        ),
        place: where_rungs(rungs, |r| r.is_fold),
        remedies: Vec::new(),
    })
}

fn bend_lines(panel: &Panel<'_>) -> Option<Finding> {
    let is_line = |r: &RungMeasures| to_deg(r.crease.abs()) > SHARP_CREASE_DEG && !r.is_fold;
    let lines = panel.measures.rungs.iter().filter(|r| is_line(r));
    let sharpest = lines.clone().map(|r| r.crease.abs()).reduce(f64::max)?;
    let limit = format!("more than {SHARP_CREASE_DEG:.0}°");
    let lines = match lines.count() {
        1 => format!(
            "One ruling turns by {limit} ({:.1}°); the pattern marks it as a line to bend along.",
            to_deg(sharpest)
        ),
        count => format!(
            "{count} rulings turn by {limit} (up to {:.1}°); the pattern marks them as lines to bend \
             along.",
            to_deg(sharpest)
        ),
    };
    Some(Finding {
        severity: Severity::Note,
        code: "bend-lines",
        text: format!("{lines} More samples divide the bend more finely."),
        place: where_rungs(&panel.measures.rungs, is_line),
        remedies: Vec::new(),
    })
}

fn length_error(panel: &Panel<'_>) -> Option<Finding> {
    let most = panel.measures.length_error_max;
    let exact = ROUNDING * panel.boundary.size() / shortest_side(panel.boundary);
    let per_cent = most * 100.0;
    // As many digits as show two of the number.
    let shifted = std::iter::successors(Some(per_cent), |x| Some(x * 10.0));
    let digits = shifted.take(9).take_while(|x| *x < 10.0).count();
    // What closing windows changes is mostly less than anyone cuts to.
    let of_windows = panel.boundary.holes() > 0;
    let unseen = of_windows && most <= Tolerance::STRETCH.share();
    (most > exact.max(ROUNDING)).then(|| Finding {
        severity: if unseen { Severity::Note } else { Severity::Warning },
        code: "length-error",
        text: if of_windows {
            format!(
                "Lengths of the pattern differ from the surface by up to {per_cent:.digits$} %, so \
                 that its holes close when it is laid flat."
            )
        } else {
            format!("Lengths of the pattern differ from the surface by up to {per_cent:.3} %.")
        },
        place: String::new(),
        remedies: Vec::new(),
    })
}

/// A seam that gapes by no more than this share of the size is one round a window that nearly
/// lies flat, not one that opens a tube. (A ring that rises by 2° gapes by as much.)
const WINDOW_GAP: f64 = 2e-3;

fn open_windows(panel: &Panel<'_>) -> Option<Finding> {
    if panel.flat.overlap.is_some() {
        return None;
    }
    let nearly = |seam: &Seam| seam.gap_mm <= WINDOW_GAP * panel.boundary.size();
    let widest = panel.sheet.seams().iter().filter(|s| nearly(s)).map(|s| s.gap_mm);
    let widest = widest.reduce(f64::max)?;
    Some(Finding {
        severity: Severity::Warning,
        code: "window-gap",
        text: format!(
            "Round a hole the panel lies flat but for a gap of {widest:.2} mm. Closing it would \
             change lengths by more than {} %, so the pattern is cut from edge to edge there.",
            Tolerance::STRETCH.share() * 100.0
        ),
        place: where_seams(panel.sheet, nearly),
        remedies: Vec::new(),
    })
}

fn seams(panel: &Panel<'_>) -> Option<Finding> {
    let list = panel.sheet.seams();
    let length = |seam: &Seam| {
        let [a, b] = seam.rung.ends();
        panel.boundary.position(a).distance(panel.boundary.position(b))
    };
    let (count, what) = match list {
        [] => return None,
        [only] => ("a seam".to_owned(), format!("{:.1} mm long", length(only))),
        _ => (
            format!("{} seams", list.len()),
            format!("{:.1} mm long together", list.iter().map(length).sum::<f64>()),
        ),
    };
    Some(Finding {
        severity: Severity::Note,
        code: "seam",
        text: format!(
            "In one piece it does not lie flat, so it is cut open along {count}, {what}. Join the \
             sides that have the same mark."
        ),
        place: where_seams(panel.sheet, |_| true),
        remedies: Vec::new(),
    })
}

/// The seams for which `is_so`: `S1 from sample 3 to 17`.
fn where_seams(sheet: &Sheet, is_so: impl Fn(&Seam) -> bool) -> String {
    let list: Vec<String> = sheet
        .seams()
        .iter()
        .enumerate()
        .filter(|(_, seam)| is_so(seam))
        .map(|(n, seam)| {
            let [a, b] = seam.rung.ends().map(|s| s.get() + 1);
            format!("{} from sample {a} to {b}", seam_mark(n))
        })
        .collect();
    let more = list.len().saturating_sub(SHOWN);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{rest}", list[..list.len().min(SHOWN)].join(", "))
}

fn shortest_side(boundary: &Boundary) -> f64 {
    (0..boundary.len())
        .map(|i| {
            let at = |k: usize| boundary.samples()[k].position;
            at(i).distance(at(boundary.next(i)))
        })
        .fold(f64::INFINITY, f64::min)
}

/// The rungs for which `is_so`, as ranges of their numbers from 1: `rungs 41–47, 60`.
fn where_rungs(rungs: &[RungMeasures], is_so: impl Fn(&RungMeasures) -> bool) -> String {
    let numbers: Vec<usize> =
        (0..rungs.len()).filter(|&n| is_so(&rungs[n])).map(|n| n + 1).collect();
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for n in numbers {
        match ranges.last_mut() {
            Some((_, end)) if *end + 1 == n => *end = n,
            _ => ranges.push((n, n)),
        }
    }
    let more = ranges.len().saturating_sub(SHOWN);
    let shown: Vec<String> = ranges
        .iter()
        .take(SHOWN)
        .map(|&(a, b)| if a == b { a.to_string() } else { format!("{a}–{b}") })
        .collect();
    let rest = if more > 0 { format!(" and {more} more ranges") } else { String::new() };
    let word = if ranges.len() == 1 && ranges[0].0 == ranges[0].1 { "rung" } else { "rungs" };
    format!("{word} {}{rest}", shown.join(", "))
}
