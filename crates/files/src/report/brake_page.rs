//! The plan for the press brake in `report.html`: a row a hit.

use super::page::{PartPage, table};
use crate::brake::{reference, warning};
use crate::wording::{decimal, degrees};
use maud::{Markup, html};
use sheetwright::bend::Hit;
use sheetwright::math::{Point2, to_deg};

/// The plan of a part; nothing where it is not bent, no plan is made, or another's is for both.
pub(super) fn brake_plan(page: &PartPage<'_>) -> Markup {
    let own = page.plan.filter(|hits| !hits.is_empty() && page.is_first());
    let Some(hits) = own else { return html! {} };
    let labels = [
        "Bend",
        "So far",
        "Line from – to (x, y), mm",
        "Gauge left / right, mm",
        "Fingers at, mm",
        "From",
        "Radius left / right, mm",
        "Pitch left / right, mm",
        "Warning",
    ];
    let rows = hits.iter().enumerate().map(|(n, hit)| ((n + 1).to_string(), row(page, hit)));
    html! {
        h3 { "Bends, in order" }
        p {
            "Up is towards the side that the pattern shows. The numbers stand on the pattern. Gauges "
            "are square to the bend line, from each finger to the edge that is named; from the base "
            "line, the lower side of the box around the piece, they are heights above it."
        }
        (table(None, "Hit", &labels, rows))
    }
}

fn row(page: &PartPage<'_>, hit: &Hit) -> Vec<String> {
    let line = &hit.line;
    let pair = |numbers: [f64; 2]| numbers.map(|mm| decimal(mm, 1)).join(" / ");
    let place = |p: Point2| format!("{}, {}", decimal(p.x, 1), decimal(p.y, 1));
    let way = if line.is_up() { "up" } else { "down" };
    let smooth = |numbers: [f64; 2]| if line.is_fold { "fold".to_owned() } else { pair(numbers) };
    let inside = line.inside_radius_mm.map(|mm| format!("inside {}", decimal(mm, 2)));
    vec![
        format!("{way} {}", degrees(to_deg(line.angle.abs()))),
        degrees(to_deg(-hit.running)),
        format!("{} – {}", place(line.ends[0]), place(line.ends[1])),
        pair(hit.gauges_mm),
        pair(hit.fingers_mm),
        reference(page.part, hit),
        inside.unwrap_or_else(|| smooth(line.radius_mm())),
        smooth(line.pitch_mm),
        warning(hit),
    ]
}
