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
/// The unit of numbers without one.
pub(super) struct Bare {
    /// The unit of the table, if it is known.
    pub(super) unit: Option<Units>,
    /// Whether other cells are in feet and inches.
    pub(super) has_feet: bool,
}

impl Bare {
    /// The unit of the numbers of a table: that of the caller, that which the table names, or that
    /// which its numbers show.
    pub(super) fn of(layout: &Layout, units: Option<Units>, notes: &mut Vec<String>) -> Self {
        let of_rows = layout.rows.iter().flat_map(|row| row.cells.iter().map(|(_, placed)| placed));
        let places = layout.stations.iter().filter_map(|station| station.at.as_ref());
        let (mut has_feet, mut has_fraction, mut largest) = (false, false, 0.0_f64);
        for placed in of_rows.chain(places) {
            match placed.cell {
                Cell::Length { is_feet, .. } => has_feet |= is_feet,
                Cell::Bare { number, has_fraction: fraction } if placed.unit.is_none() => {
                    has_fraction |= fraction;
                    largest = largest.max(number.abs());
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
        let mut unit = units.or(layout.unit);
        if unit.is_none() && has_fraction {
            notes.push("numbers without a unit are inches, as their fractions say".to_owned());
            unit = Some(Units::Inches);
        } else if unit.is_none() && !has_feet && largest >= PLAINLY_MM {
            notes.push("the table names no unit: its numbers are read as millimetres".to_owned());
            unit = Some(Units::Millimetres);
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
        let out_of_range = || {
            let message = format!("{} is out of range", shown(&placed.typed));
            Refusal::at(&placed.place, message)
        };
        mm.map(|mm| Some(mm + 0.0)).ok_or_else(out_of_range)
    }

    fn without_unit(&self, placed: &Placed) -> Refusal {
        let typed = shown(&placed.typed);
        let message = if self.has_feet {
            format!("{typed} has no unit, and other cells are in feet and inches")
        } else {
            format!("{typed} has no unit, and nothing in the table says which it is")
        };
        Refusal::at(&placed.place, message).with(
            "Name the unit in a title such as 'Offsets in mm' or in the label of the row, such as \
             'Position (in)', or set the units of the input.",
        )
    }
}

/// The number in the name of a station or a waterline.
pub(super) fn number_of(name: &str) -> Option<f64> {
    match cell(name, false) {
        Cell::Bare { number, .. } => Some(number),
        _ => None,
    }
}
