//! How a drawing was read, in words.

use super::place::point;
use sheetwright::design::{ReadNote, Unused};

/// A note about how a drawing was read, in sentences.
pub fn read_note_text(note: &ReadNote) -> String {
    match note {
        ReadNote::NotUsed { what, count, names, at } => not_used(*what, *count, names, at.as_ref()),
        ReadNote::GapsClosed { count, widest_mm, at } => format!(
            "{} between ends of curves {} closed; the widest was {} mm, at {}.",
            if *count == 1 { "A gap".to_owned() } else { format!("{count} gaps") },
            if *count == 1 { "was" } else { "were" },
            short_mm(*widest_mm),
            point(*at)
        ),
        ReadNote::TakenForRails { names: [a, b] } => format!(
            "The input has two open curves and no outline, so they were taken for the rails of a \
             panel: '{a}' and '{b}'."
        ),
        ReadNote::TakenForRing { names: [a, b] } => format!(
            "The drawing has two closed curves that do not lie in one plane, so they were taken for \
             the two borders of one panel: '{a}' and '{b}'."
        ),
        ReadNote::Smoothed { names } => format!(
            "{} {} drawn in space as many short lines and {} made smooth through their points; \
             corners of 20° or more stay, and so do those between lines of very different length.",
            listed(names),
            if names.len() == 1 { "is" } else { "are" },
            if names.len() == 1 { "was" } else { "were" },
        ),
        ReadNote::NoUnit { unit_mm } if *unit_mm == 1.0 => {
            "The drawing names no unit of length, so it was read in millimetres.".to_owned()
        }
        ReadNote::NoUnit { unit_mm } => format!(
            "The drawing names no unit of length, so it was read in pixels of {} mm.",
            short_mm(*unit_mm)
        ),
    }
}

fn not_used(
    what: Unused,
    count: usize,
    names: &[String],
    at: Option<&sheetwright::Point3>,
) -> String {
    let [one, several] = words(what);
    let things =
        if count == 1 { format!("One {one} was") } else { format!("{count} {several} were") };
    let named = if names.is_empty() { String::new() } else { format!(": {}", listed(names)) };
    let place = match at {
        Some(at) if count == 1 && !names.is_empty() => format!(" at {}", point(*at)),
        Some(at) if count == 1 => format!(" (at {})", point(*at)),
        Some(at) => format!(", the first at {}", point(*at)),
        None => String::new(),
    };
    let why = match what {
        Unused::Open => " Close what should be an outline, or name rails.",
        _ => "",
    };
    format!("{things} not used{named}{place}.{why}")
}

/// What one of them is called, and several.
fn words(what: Unused) -> [&'static str; 2] {
    match what {
        Unused::Open => ["open curve", "open curves"],
        Unused::Closed => ["closed curve", "closed curves"],
        Unused::NotNamed => ["curve beside the named ones", "curves beside the named ones"],
        Unused::Doubled => ["curve that is drawn twice", "curves that are drawn twice"],
        Unused::Marks => ["curve on a layer of marks", "curves on layers of marks"],
        Unused::Hidden => ["hidden thing", "hidden things"],
        Unused::Text => ["text", "texts"],
        Unused::Image => ["picture", "pictures"],
        Unused::Hatch => ["hatch", "hatches"],
        Unused::Dimension => ["dimension or leader", "dimensions or leaders"],
        Unused::Point => ["point", "points"],
        Unused::Surface => ["face or solid", "faces or solids"],
        Unused::Lines => {
            ["line beside the faces of the mesh", "lines beside the faces of the mesh"]
        }
        Unused::Page => ["thing on a page of the drawing", "things on pages of the drawing"],
        Unused::Other => ["entity of another type", "entities of other types"],
    }
}

/// The most names that a sentence shows.
const SHOWN: usize = 4;

fn listed(names: &[String]) -> String {
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("'{name}'")).collect();
    // Not all names are kept, so how many more there are is not known.
    let rest = if names.len() > SHOWN { " and others" } else { "" };
    shown.join(", ") + rest
}

/// A length with two significant digits below 1 mm, else with hundredths.
fn short_mm(mm: f64) -> String {
    let decimals = match mm {
        _ if mm >= 0.1 || mm == 0.0 => 2,
        _ if mm >= 0.01 => 3,
        _ if mm >= 0.001 => 4,
        _ => return format!("{mm:.1e}"),
    };
    format!("{mm:.decimals$}")
}
