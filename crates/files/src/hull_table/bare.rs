//! The unit of numbers that are written without one.

use super::layout::{Layout, Placed};
use super::notation::{Cell, cell};
use super::said::Refusal;
use crate::names::shown;
use crate::table::in_range_mm;
use crate::units::Units;

/// Numbers without a unit of which the largest is this or more are millimetres: as inches they
/// would be a boat of 25 m, as feet one of 300 m.
const PLAINLY_MM: f64 = 1000.0;

/// What a caller says of the unit of numbers without one.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GivenUnits {
    /// The unit, whatever the table says.
    pub(crate) asked: Option<Units>,
    /// The unit if the table shows none.
    pub(crate) usual: Option<Units>,
}

/// The unit of numbers without one.
pub(super) struct Bare {
    /// The unit of the table, if it is known.
    pub(super) unit: Option<Units>,
    /// Whether other cells are in feet and inches, or a title says that all are.
    pub(super) has_feet: bool,
}

impl Bare {
    /// The unit of the numbers of a table: that of the caller, that which the table names, or that
    /// which its numbers show.
    pub(super) fn of(layout: &Layout, units: GivenUnits, notes: &mut Vec<String>) -> Self {
        let of_rows = layout.rows.iter().flat_map(|row| row.cells.iter().map(|(_, placed)| placed));
        let places = layout.stations.iter().filter_map(|station| station.at.as_ref());
        let (mut has_feet, mut has_fraction, mut largest) = (layout.is_in_feet, false, 0.0_f64);
        let (mut of_labels, mut largest_labelled) = (Vec::new(), 0.0_f64);
        for placed in of_rows.chain(places) {
            match placed.cell {
                Cell::Length { is_feet, .. } => has_feet |= is_feet,
                Cell::Bare { number, has_fraction: fraction } if placed.unit.is_none() => {
                    has_fraction |= fraction;
                    largest = largest.max(number.abs());
                }
                Cell::Bare { number, .. } => {
                    of_labels.extend(placed.unit.filter(|unit| !of_labels.contains(unit)));
                    largest_labelled = largest_labelled.max(number.abs());
                }
                _ => {}
            }
        }
        // Stations may be named by their places.
        if layout.spacing[0].is_none() && layout.stations.iter().all(|station| station.at.is_none())
        {
            let names = layout.stations.iter().filter_map(|station| number_of(&station.name));
            largest = names.map(f64::abs).fold(largest, f64::max);
        }
        let mut unit = units.asked.or(layout.unit);
        if unit.is_none() && has_fraction {
            notes.push("numbers without a unit are inches, as their fractions say".to_owned());
            unit = Some(Units::Inches);
        } else if let [of_label] = of_labels[..]
            && unit.is_none()
            && !has_feet
            && 0.0 < largest
            && largest <= largest_labelled
        {
            // Numbers that exceed those of the label are in a smaller unit: a boat that is 4 m long
            // is not 500 m high.
            notes.push(format!(
                "numbers without a unit are in {}, the one that a label names",
                of_label.name()
            ));
            unit = Some(of_label);
        } else if unit.is_none() && !has_feet && largest >= PLAINLY_MM {
            notes.push("the table names no unit: its numbers are read as millimetres".to_owned());
            unit = Some(Units::Millimetres);
        } else if unit.is_none() && !has_feet {
            unit = units.usual;
        }
        Self { unit, has_feet }
    }

    /// The length in a cell, mm; `None` where there is none.
    pub(super) fn mm(&self, placed: &Placed) -> Result<Option<f64>, Refusal> {
        let mm = match placed.cell {
            Cell::None | Cell::Text | Cell::Wrong(_) => return Ok(None),
            Cell::Length { mm, .. } => in_range_mm(mm, Units::Millimetres),
            Cell::Bare { number: 0.0, .. } => Some(0.0),
            Cell::Bare { number, .. } => match placed.unit.or(self.unit) {
                Some(unit) => {
                    in_range_mm(number * (unit.in_mm() * 10.0) / 10.0, Units::Millimetres)
                }
                None => return Err(self.without_unit(placed)),
            },
        };
        mm.map(|mm| Some(mm + 0.0)).ok_or_else(|| out_of_range(&placed.typed, &placed.place))
    }

    fn without_unit(&self, placed: &Placed) -> Refusal {
        let typed = shown(&placed.typed);
        let message = if self.has_feet {
            format!("{typed} has no unit, and the table is in feet and inches")
        } else {
            format!("{typed} has no unit, and nothing in the table says which it is")
        };
        Refusal::at(&placed.place, message).with(
            "Name the unit in a title such as 'Offsets in mm' or in the label of the row, such as \
             'Position (in)', or set the units of the input.",
        )
    }
}

/// A length that is made of a number in a name, if it is in range.
pub(super) fn made_mm(mm: f64, typed: &str, place: &str) -> Result<f64, Refusal> {
    in_range_mm(mm, Units::Millimetres).ok_or_else(|| out_of_range(typed, place))
}

fn out_of_range(typed: &str, place: &str) -> Refusal {
    Refusal::at(place, format!("{} is out of range", shown(typed)))
}

/// The number in the name of a station or a waterline.
pub(super) fn number_of(name: &str) -> Option<f64> {
    match cell(name, false) {
        Cell::Bare { number, .. } => Some(number),
        _ => None,
    }
}
