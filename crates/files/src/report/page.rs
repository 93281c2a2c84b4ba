//! A part with all that its section of `report.html` shows.

use sheetwright::check::Checked;
use sheetwright::edge::Edge;
use sheetwright::make::{Made, Part};

/// A part with all that its section of the page shows.
pub(super) struct PartPage<'a> {
    pub(super) made: &'a Made,
    /// From 1.
    pub(super) number: usize,
    pub(super) part: &'a Part,
    /// See [`crate::Outputs::refold_error_mm`].
    pub(super) refold_error_mm: f64,
    pub(super) checked: &'a Checked,
}

impl PartPage<'_> {
    /// The name of an edge, how long it is, and what it is joined to.
    pub(super) fn edge_text(&self, edge: &Edge, length: &str) -> String {
        let mates = edge.mates.iter().map(|mate| &self.made.parts[mate.part].name[..]);
        let mates: Vec<&str> = mates.collect();
        if mates.is_empty() {
            format!("{}, {length}", edge.name)
        } else {
            format!("{}, {length}, joined to {}", edge.name, mates.join(", "))
        }
    }
}

/// A number with its name.
pub(super) type Number = (&'static str, String);
