//! `assembly.pdf`: the book that a builder works from. What to buy, each part, the order in which
//! parts are joined, and what to measure. `docs/outputs.md` says what it shows.

mod buy;
mod checks;
mod corners;
mod flow;
mod part_page;
mod scene;
mod stages;
mod step_page;
mod title;

use crate::pdf::{Paper, PdfPage, document};
use crate::wording::{mark_ranges as ranges, millimetres};
use flow::Flow;
use sheetwright::bend::Hit;
use sheetwright::edge::{Edge, EdgePlace};
use sheetwright::make::{CutItem, Made, Part};

/// Lengths of joined edges that differ by less than this, mm, are equal to a builder.
const EQUAL_MM: f64 = 0.05;

/// What a book is about.
pub(crate) struct Book<'a> {
    pub(crate) made: &'a Made,
    /// The patterns to cut.
    pub(crate) patterns: &'a [CutItem],
    /// The bends of each part at the press brake, if a plan for it is asked for.
    pub(crate) plans: Option<&'a [Vec<Hit>]>,
    pub(crate) paper: Paper,
}

impl Book<'_> {
    /// The bytes of the file.
    pub(crate) fn written(&self) -> Vec<u8> {
        document(self.title(), self.pages().into_iter())
    }

    fn pages(&self) -> Vec<PdfPage> {
        let mut flow = Flow::new(self.paper);
        title::title_page(&mut flow, self);
        buy::what_to_buy(&mut flow, self);
        part_page::parts(&mut flow, self);
        step_page::steps(&mut flow, self);
        checks::checks(&mut flow, self);
        title::notes(&mut flow);
        flow.finish(self.title())
    }

    /// How many parts are cut.
    fn count(&self) -> usize {
        self.patterns.iter().map(|item| item.quantity().count).sum()
    }

    fn title(&self) -> &str {
        if self.made.name.is_empty() { "Assembly" } else { &self.made.name }
    }
}

/// Two edges that are joined.
struct JoinedPair {
    /// The parts and the edges, by their numbers.
    places: [EdgePlace; 2],
    /// How long both are on their patterns along what they share, mm.
    lengths_mm: [f64; 2],
}

/// Every pair of joined edges once.
fn joined_pairs(made: &Made) -> Vec<JoinedPair> {
    let mut pairs = Vec::new();
    for (part, of_part) in made.parts.iter().enumerate() {
        for (edge, found) in of_part.edges.iter().enumerate() {
            let own = EdgePlace { part, edge };
            for (&mate, &lengths_mm) in found.mates.iter().zip(&found.shared_mm) {
                if mate > own {
                    pairs.push(JoinedPair { places: [own, mate], lengths_mm });
                }
            }
        }
    }
    pairs
}

/// Some lines, and of too many how many more there are.
fn first_lines(mut lines: Vec<String>, most: usize) -> Vec<String> {
    if lines.len() > most {
        let more = lines.len() - most + 1;
        lines.truncate(most - 1);
        lines.push(format!("… and {more} more lines: the patterns name all edges."));
    }
    lines
}

/// How long an edge is along which nothing is joined, on its pattern, mm.
fn free_of_edge_mm(edge: &Edge) -> f64 {
    let shared: f64 = edge.shared_mm.iter().map(|shared| shared[0]).sum();
    let left = edge.length_flat_mm - shared;
    // What rounding leaves of an edge that is joined all along is nothing.
    if left > 1e-6 * edge.length_flat_mm { left } else { 0.0 }
}

/// How an edge of a part is called where it meets another part: by the marks of its seam or its
/// joints where the pattern shows those, else by its name.
fn edge_name(part: &Part, edge: &Edge, with: usize) -> String {
    ranges(edge_marks(part, edge, with))
}

/// The marks by which an edge is called, or its name.
fn edge_marks(part: &Part, edge: &Edge, with: usize) -> Vec<String> {
    let marks = part.edge_marks(edge, Some(with));
    if marks.is_empty() { vec![edge.name.clone()] } else { marks }
}

/// How the seam of two edges is called on both patterns: by the marks or the name that both have.
/// `None` where they have other names.
fn seam_names(made: &Made, [own, other]: [EdgePlace; 2]) -> Option<Vec<String>> {
    let names = |place: EdgePlace, with: EdgePlace| {
        let part = &made.parts[place.part];
        edge_marks(part, &part.edges[place.edge], with.part)
    };
    let of_other = names(other, own);
    let mut both = names(own, other);
    both.retain(|name| of_other.contains(name));
    (!both.is_empty()).then_some(both)
}

/// Likewise; where they have other names, that of the first.
fn seam_or_own_names(made: &Made, places: [EdgePlace; 2]) -> Vec<String> {
    let [own, other] = places;
    let part = &made.parts[own.part];
    let own_names = || edge_marks(part, &part.edges[own.edge], other.part);
    seam_names(made, places).unwrap_or_else(own_names)
}

/// A length with the one that it is joined to, where they differ.
fn both_lengths(own_mm: f64, other_mm: f64) -> String {
    let length = millimetres(own_mm);
    if (own_mm - other_mm).abs() < EQUAL_MM {
        length
    } else {
        format!("{length}, the other {}", millimetres(other_mm))
    }
}

/// A count with its noun, such as `1 part`.
fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

#[cfg(test)]
mod tests;
