//! Findings of how a boundary came to be: what its curves look like, and what was done to them.

use super::{Checked, Finding, Severity, Verdict, where_rungs};
use crate::fair::Ended;
use crate::measure::Measures;
use sheetwright_geometry::boundary::Joined;
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{angle_between, to_deg};

/// Points where a spline turns by more than this without being a corner, degrees, are named: what
/// was typed as a corner comes out round. A smooth curve of eight points turns by 45° at each.
const ROUNDED_CORNER_DEG: f64 = 60.0;

/// The finding that the points of a spline turn sharply where no corner is marked, so that the
/// curve runs round a corner that its maker may have meant; `None` if they do not. `points` are
/// those of the curve of this name.
pub fn rounded_corner(name: &str, points: &[CurvePoint], closed: bool) -> Option<Finding> {
    let m = points.len();
    let inner = if closed { 0..m } else { 1..m.saturating_sub(1) };
    let turn = |i: usize| {
        let at = |k: usize| points[k % m].at;
        to_deg(angle_between(at(i) - at(i + m - 1), at(i + 1) - at(i)))
    };
    let rounded: Vec<(usize, f64)> = inner
        .filter(|&i| !points[i].corner)
        .map(|i| (i, turn(i)))
        .filter(|(_, turn)| *turn > ROUNDED_CORNER_DEG)
        .collect();
    let sharpest = rounded.iter().map(|(_, turn)| *turn).reduce(f64::max)?;
    let (first, more) = (rounded[0].0 + 1, rounded.len() - 1);
    let others = if more > 0 { format!(" and {more} more") } else { String::new() };
    Some(Finding {
        severity: Severity::Warning,
        code: "rounded-corner",
        text: format!(
            "The points of the curve '{name}' turn by up to {sharpest:.0}°, and the spline runs \
             round there. If that is a corner, mark it as one."
        ),
        place: format!("point {first}{others} of '{name}'"),
        remedies: Vec::new(),
    })
}

/// The finding that a boundary was made smooth where the panels that it joins meet; `None` if it
/// was left as it came.
pub fn smoothed_joints(joined: &Joined) -> Option<Finding> {
    let smoothed = joined.joints.iter().filter(|joint| joint.window.is_some());
    let places: Vec<String> = smoothed.map(|joint| (joint.sample.get() + 1).to_string()).collect();
    let count = match places.len() {
        0 => return None,
        1 => "one place".to_owned(),
        count => format!("{count} places"),
    };
    Some(Finding {
        severity: Severity::Note,
        code: "joint-smoothed",
        text: format!(
            "The boundary was made smooth at {count} where joined panels meet, and lies up to \
             {:.2} mm from theirs.",
            joined.deviation_mm()
        ),
        place: format!("around samples {}", places.join(", ")),
        remedies: Vec::new(),
    })
}

/// The finding that the rails of a panel were let run on, what became of its ends, and whether that
/// was worth it: a warning if both the largest warp and the smallest bend radius are worse.
/// `bulges_mm` is how far the end at the beginning of the first rail, and that at its end, bulge
/// from the straight line, mm; `None` for an end that stays straight. `straight` are the measures
/// of the same panel with straight ends, if it can be made.
pub fn ran_on(
    bulges_mm: [Option<f64>; 2],
    measures: &Measures,
    straight: Option<&Measures>,
) -> Finding {
    let said = |bulge: Option<f64>| match bulge {
        Some(mm) => format!("a curve up to {mm:.2} mm beside the straight line"),
        None => "straight".to_owned(),
    };
    let [start, end] = bulges_mm.map(said);
    let mut severity = Severity::Note;
    let mut text = format!(
        "The rails were let run on beyond their ends. The end of the panel where the first rail \
         begins is {start}; the one where it ends is {end}."
    );
    if bulges_mm == [None; 2] {
        text.push_str(" Rulings would gain nothing by leaving there.");
    } else if let Some(straight) = straight {
        let said = [measures, straight].map(|m| {
            let warp = to_deg(m.warp_max);
            match m.bend_radius_min_mm {
                r if r.is_finite() => format!("{warp:.2}° and {r:.1} mm"),
                _ => format!("{warp:.2}°, and it is flat"),
            }
        });
        text.push_str(&format!(
            " Largest warp and smallest bend radius are {}; with straight ends they are {}.",
            said[0], said[1]
        ));
        let is_worse = measures.warp_max > straight.warp_max
            && measures.bend_radius_min_mm < straight.bend_radius_min_mm;
        if is_worse {
            severity = Severity::Warning;
            text.push_str(" The panel bends better with straight ends.");
        }
    }
    Finding { severity, code: "ran-on", text, place: String::new(), remedies: Vec::new() }
}

/// The finding that the ends that the rails of a panel would run on to make no panel, and why, so
/// that its ends stay straight.
pub fn stayed_straight(cause: &str) -> Finding {
    Finding {
        severity: Severity::Warning,
        code: "ran-on",
        text: format!(
            "The rails can't run on: with the ends that they would get, {cause}. The ends of the \
             panel stay straight."
        ),
        place: String::new(),
        remedies: Vec::new(),
    }
}

/// The finding that some of the joined panels were turned round to face as the first does; `None`
/// if all do. `names` are theirs.
pub fn turned_round(joined: &Joined, names: &[String]) -> Option<Finding> {
    let turned = names.iter().zip(&joined.turned).filter(|(_, turned)| **turned);
    let turned: Vec<String> = turned.map(|(name, _)| format!("'{name}'")).collect();
    let first = names.first()?;
    (!turned.is_empty()).then(|| Finding {
        severity: Severity::Note,
        code: "turned-round",
        text: format!(
            "{} faced the other way, and was turned round to face as '{first}' does.",
            turned.join(", ")
        ),
        place: String::new(),
        remedies: Vec::new(),
    })
}

/// How a boundary was moved so that the sheet bends better.
#[derive(Clone, Copy, Debug)]
pub struct BoundaryMoved<'a> {
    /// How it ended.
    pub ended: &'a Ended,
    /// The largest warp angle that was asked for, radians, if one was.
    pub wanted: Option<f64>,
    /// The curves of the panel that moved, by name.
    pub curves: &'a [String],
    /// The largest distance that a sample was moved, mm.
    pub moved_max_mm: f64,
    /// All those distances, summed, mm.
    pub moved_total_mm: f64,
    /// The size of the boundary, mm.
    pub size_mm: f64,
    /// What was measured before.
    pub before: &'a Measures,
    /// What is measured now.
    pub after: &'a Measures,
    /// What is found now.
    pub checked: &'a Checked,
}

/// The finding that a boundary was moved, and what came of it: a warning where an angle that was
/// asked for is not reached.
pub fn moved(moving: &BoundaryMoved<'_>) -> Finding {
    let BoundaryMoved { ended, curves, before, after, .. } = moving;
    let [warp_before, warp_after] = [before, after].map(|m| to_deg(m.warp_max));
    let missed = moving.wanted.filter(|&wanted| after.warp_max > wanted);
    let names: Vec<String> = curves.iter().map(|name| format!("'{name}'")).collect();
    let mut text = if curves.is_empty() {
        "Nothing was moved".to_owned()
    } else {
        format!(
            "{} moved by up to {:.2} mm ({:.3} % of the size), {:.1} mm over all samples: the \
             largest warp angle goes from {warp_before:.2}° to {warp_after:.2}°, the total twist \
             from {:.3e} to {:.3e}",
            listed(&names),
            moving.moved_max_mm,
            100.0 * moving.moved_max_mm / moving.size_mm,
            moving.moved_total_mm,
            before.twist_total,
            after.twist_total
        )
    };
    let mut severity = Severity::Note;
    let mut code = "moved";
    let mut place = String::new();
    match (ended, missed) {
        (Ended::NothingToDo, None) => {
            text.push_str(&not_needed(moving));
            code = "not-moved";
        }
        (Ended::NothingToDo, Some(_)) => {
            text.push_str(
                ": the samples explain every warp angle by bending, so the panel is developable as \
                 far as they tell. Ask for more samples to see its warp angles fall.",
            );
            code = "not-moved";
        }
        (_, Some(wanted)) => {
            severity = Severity::Warning;
            code = "warp-not-reached";
            let wanted = to_deg(wanted);
            text.push_str(&format!(
                ". The {wanted:.1}° that were asked for are not reached within the limits: {ended}. \
                 Let the boundary move farther, or draw it with less twist."
            ));
            place = where_rungs(&after.rungs, |rung| to_deg(rung.warp) > wanted);
        }
        (_, None) => {
            text.push_str(&format!("; {ended}."));
            text.push_str(other_reason(moving.checked));
        }
    }
    Finding { severity, code, text, place, remedies: Vec::new() }
}

/// Why nothing was moved, as the end of a sentence, and what is to be done instead where the panel
/// does not bend.
fn not_needed(moving: &BoundaryMoved<'_>) -> String {
    let tell = "as far as its samples tell";
    if moving.checked.verdict != Verdict::WillNotBend {
        return format!(": the panel bends as it is, {tell}.");
    }
    let twist = match moving.wanted.map(to_deg) {
        Some(wanted) => format!("no ruling twists by more than the {wanted:.1}° asked for"),
        None => "no ruling twists".to_owned(),
    };
    format!(": {twist}, {tell}.{}", other_reason(moving.checked))
}

/// What keeps a panel from bending that has all the warp angles asked for, as a sentence.
fn other_reason(checked: &Checked) -> &'static str {
    let has =
        |code| checked.findings.iter().any(|f| f.code == code && f.severity == Severity::Error);
    if checked.verdict != Verdict::WillNotBend {
        ""
    } else if has("warp-too-large") {
        " The sheet takes less than that: ask for a smaller angle."
    } else if has("radius-too-small") {
        " What keeps the panel from bending is its radius, which moving for less twist does not \
         change: take a thinner sheet, or draw the curves rounder."
    } else {
        " What keeps the panel from bending is not its twist: see the errors beside this."
    }
}

/// Names in a sentence.
fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}
