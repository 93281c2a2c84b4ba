//! What is to be cut, in `report.html`: each pattern with its count and the panels that it is for.

use super::page::{PartPage, table};
use crate::parts::cut_length_mm;
use crate::wording::{area, millimetres};
use maud::{Markup, html};
use sheetwright::make::{CutItem, Made};

/// The table of patterns, if several parts are cut from one.
pub(super) fn cut_list(made: &Made, patterns: &[CutItem]) -> Markup {
    let is_counted = patterns.iter().any(|item| item.quantity().count > 1);
    if patterns.len() == made.parts.len() && !is_counted {
        return html! {};
    }
    let labels = ["Cut", "Flat size", "Area", "Length of cuts", "Panels"];
    let row = |item: &CutItem| {
        let part = &made.parts[item.first()];
        let size = part.piece.size;
        let cut = item.quantity().text().unwrap_or_else(|| "cut 1".to_owned());
        let values = vec![
            cut.trim_start_matches("cut ").to_owned(),
            format!("{} × {}", millimetres(size.x), millimetres(size.y)),
            area(part.piece.area_mm2()),
            millimetres(cut_length_mm(&part.piece)),
            names(made, item),
        ];
        (&part.name[..], values)
    };
    html! {
        div.cuts {
            (table(Some("What to cut"), "Pattern", &labels, patterns.iter().map(row)))
            p.sub { "Equal panels are cut from one pattern, that of the first." }
        }
    }
}

/// The panels of a pattern by their names; those for which it is turned over are marked.
fn names(made: &Made, item: &CutItem) -> String {
    let name = |n: usize| {
        let instance = &item.instances[n];
        let name = &made.parts[instance.number].name;
        if instance.mirrored { format!("{name} (mirrored)") } else { name.clone() }
    };
    (0..item.instances.len()).map(name).collect::<Vec<_>>().join(", ")
}

/// Which pattern a panel is cut from, or for which panels its pattern is; nothing of a panel alone.
pub(super) fn cut_from(page: &PartPage<'_>) -> Markup {
    let Some((item, instance)) = page.pattern else { return html! {} };
    let first = &page.made.parts[item.first()].name;
    let Some(quantity) = item.quantity().text() else { return html! {} };
    html! {
        p {
            @if page.is_first() {
                "Its pattern: " (quantity) ". It is for " (names(page.made, item)) "."
            } @else {
                "It is cut from the pattern of " b { (first) }
                @if instance.mirrored { ", turned over" }
                "."
            }
        }
    }
}
