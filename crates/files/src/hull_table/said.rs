//! What is said about a table that is not understood: the place, what was recognised so far, and a
//! table that works.

use super::layout::Layout;
use super::notation::Cell;
use crate::reading::InputError;
use std::collections::BTreeSet;

/// A table that works, in one line; `/` stands between its rows.
const EXAMPLE: &str = "Station,0,1,2 / Position (mm),0,900,1800 / Heights / Sheer,520,480,500 / \
     Chine,110,90,130 / Half-breadths / Sheer,600,640,560 / Chine,410,450,370";

/// Why a table is refused.
#[derive(Clone, Debug)]
pub(super) struct Refusal {
    message: String,
    place: Option<String>,
    hint: Option<String>,
}

impl Refusal {
    /// At a place of the table.
    pub(super) fn at(place: &str, message: String) -> Self {
        Self { message, place: Some(place.to_owned()), hint: None }
    }

    /// Of the table as a whole.
    pub(super) fn of_table(message: &str) -> Self {
        Self { message: message.to_owned(), place: None, hint: None }
    }

    /// With advice.
    pub(super) fn with(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }

    /// The error: advice, or an example of a table, and what was recognised.
    pub(super) fn error(self, layout: &Layout, source: &str) -> InputError {
        let recognised = recognised(layout);
        let is_whole = self.place.is_none();
        let hint = match self.hint {
            Some(hint) => format!("{hint} {recognised}"),
            None if is_whole => format!("{recognised} A table that works: {EXAMPLE}"),
            None => format!("{LENGTHS} {recognised}"),
        };
        InputError::at(self.place.unwrap_or_else(|| source.to_owned()), self.message, hint)
    }
}

const LENGTHS: &str = "Write lengths as 2-3-5 (feet-inches-eighths), 2' 3 5/8\", 27 5/8, 702 or \
     70.2 cm, and x or - where there is none.";

/// What was recognised of a table, in a sentence.
fn recognised(layout: &Layout) -> String {
    let stations: Vec<String> = layout.stations.iter().map(|s| s.head.typed.clone()).collect();
    let mut lines: Vec<String> = Vec::new();
    let mut seen = BTreeSet::new();
    for row in &layout.rows {
        if seen.insert(&row.label.name) {
            lines.push(row.label.name.clone());
        }
    }
    let cells = || layout.rows.iter().flat_map(|row| row.cells.iter().map(|(_, cell)| &cell.cell));
    let lengths = cells().filter(|cell| matches!(cell, Cell::Length { .. } | Cell::Bare { .. }));
    let are_feet = cells().any(|cell| matches!(cell, Cell::Length { is_feet: true, .. }));
    let unit = match layout.unit {
        _ if are_feet => ", in feet and inches".to_owned(),
        Some(unit) => format!(", in {}", unit.name()),
        None => String::new(),
    };
    let counted = |list: &[String], one: &str, many: &str| match list {
        [] => format!("no {many}"),
        [only] => format!("the {one} {only}"),
        _ => format!("{} {many} ({})", list.len(), listed(list)),
    };
    format!(
        "Recognised: {}, {} and {} lengths{unit}.",
        counted(&stations, "station", "stations"),
        counted(&lines, "line", "lines"),
        lengths.count()
    )
}

/// Names one after the other, those in the middle left out where there are many.
pub(super) fn listed(names: &[String]) -> String {
    const SHOWN: usize = 6;
    match names {
        _ if names.len() <= SHOWN => names.join(", "),
        [first, second, .., last] => format!("{first}, {second} … {last}"),
        _ => String::new(),
    }
}

/// `at station 3`, or `at Transom`.
pub(super) fn at_station(typed: &str) -> String {
    let is_number = typed.starts_with(|c: char| c.is_ascii_digit());
    if is_number { format!("at station {typed}") } else { format!("at {typed}") }
}
