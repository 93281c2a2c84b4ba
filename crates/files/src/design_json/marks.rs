//! The field `marks`: what is marked on the faces of parts, from a design's file and back.
//!
//! Places in space are numbers in the design's units, as its points are; sizes on the sheet are
//! numbers in them or texts with a unit, as those of trims.

mod form;
mod read;
mod write;

pub(super) use form::MarkFile;

use super::source::Source;
use super::trims::{Reader, Written};
use crate::reading::InputError;
use crate::units::Units;
use sheetwright::design::Mark;

/// The most marks of a design.
const MAX_MARKS: usize = 1000;

/// Reads the field `marks` of a design. `thickness_mm` is that of its sheet.
pub(super) fn read(
    list: Vec<Written>,
    units: Units,
    thickness_mm: Option<f64>,
    source: &Source<'_>,
) -> Result<Vec<Mark>, InputError> {
    if list.len() > MAX_MARKS {
        let message = format!("the design has {} marks", list.len());
        return Err(source.error("marks", message, format!("The limit is {MAX_MARKS} marks.")));
    }
    let reader = Reader { units, thickness_mm };
    let mark = |(n, written): (usize, Written)| {
        read::mark(&reader, written)
            .map_err(|(message, hint)| source.error(&format!("marks[{n}]"), message, hint))
    };
    list.into_iter().enumerate().map(mark).collect()
}

/// The marks of a design as its file has them, in units.
pub(super) fn written(marks: &[Mark], units: Units) -> Vec<MarkFile> {
    marks.iter().map(|mark| write::file_of(mark, units)).collect()
}
