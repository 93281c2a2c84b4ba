//! The edges that are joined, in `report.html`: their lengths on the patterns, side by side.

use super::page::table;
use crate::wording::{decimal, mark_ranges};
use maud::{Markup, html};
use sheetwright::edge::Edge;
use sheetwright::make::{Made, Part};

/// The most rows; `report.json` has all.
const MOST_ROWS: usize = 200;

/// One pair of joined edges.
struct Joined {
    names: [String; 2],
    lengths_mm: [f64; 2],
}

impl Joined {
    fn difference_mm(&self) -> f64 {
        (self.lengths_mm[0] - self.lengths_mm[1]).abs()
    }
}

/// The table of joined edges, in the order of the panels; nothing where none are. Of too many,
/// those that differ most.
pub(super) fn joined_edges(made: &Made) -> Markup {
    let mut all = pairs(made);
    let count = all.len();
    if count == 0 {
        return html! {};
    }
    if count > MOST_ROWS {
        all.sort_by(|a, b| b.difference_mm().total_cmp(&a.difference_mm()));
        all.truncate(MOST_ROWS);
    }
    let labels = ["Length, mm", "Joined to", "Length, mm", "Difference, mm"];
    let rows = all.into_iter().map(|pair| {
        let [a, b] = pair.lengths_mm.map(|mm| decimal(mm, 2));
        let difference = decimal(pair.difference_mm(), 3);
        let [name, other] = pair.names;
        (name, vec![a, other, b, difference])
    });
    html! {
        section.joined {
            h2 { "Joined edges" }
            p {
                "Both lengths are measured on the patterns, along what the two edges share. "
                @if count > MOST_ROWS {
                    "Of " (count) " pairs, the " (MOST_ROWS) " that differ most are listed; report.json \
                     has all."
                }
            }
            (table(None, "Edge", &labels, rows))
        }
    }
}

/// Every pair of joined edges once.
fn pairs(made: &Made) -> Vec<Joined> {
    let mut pairs = Vec::new();
    for (number, part) in made.parts.iter().enumerate() {
        for (n, edge) in part.edges.iter().enumerate() {
            for (mate, &lengths_mm) in edge.mates.iter().zip(&edge.shared_mm) {
                if (mate.part, mate.edge) < (number, n) {
                    continue;
                }
                let other = &made.parts[mate.part];
                let of_other = &other.edges[mate.edge];
                let names = [shown(part, edge, mate.part), shown(other, of_other, number)];
                pairs.push(Joined { names, lengths_mm });
            }
        }
    }
    pairs
}

/// An edge as the pattern shows it where it meets another part.
fn shown(part: &Part, edge: &Edge, with: usize) -> String {
    let marks = part.edge_marks(edge, Some(with));
    let shown = if marks.is_empty() { edge.name.clone() } else { mark_ranges(marks) };
    format!("{}/{shown}", part.name)
}
