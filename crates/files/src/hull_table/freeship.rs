//! Reads the text files in which FREE!ship and DELFTship write and take curves of hulls as points
//! in space.
//!
//! A point is a line `x y z`, with `KNUCKLE` behind it where its curve has a corner. There are two
//! forms [FreeShip]:
//!
//! ```text
//! written (File > Export > Offsets)         taken (Import chines, Import surface)
//!
//! Station   1.250                           0            in metres; 1: in feet
//!        1.2500  0.0000  0.1000                0.000  0.000  0.150
//!        1.2500  0.4000  0.2000  KNUCKLE       0.856  0.000  0.048
//!        1.2500  0.6000  0.7000
//! Waterline   0.500                            0.100  0.662  0.844
//! 2 segments.                                  0.900  1.219  0.666
//! SEGMENT 1                                 EOF
//!        …
//! CONTROLCURVE
//!        …
//! ```
//!
//! The words of the first form are in the language of the program; curves are told by how they run
//! (`sections`). Its numbers are metres or feet, which it does not say.

use super::bare::GivenUnits;
use super::lines::HullTable;
use super::sections::{HullCurve, hull_of};
use crate::names::refused_for_curve;
use crate::reading::InputError;
use crate::table::{RANGE_HINT, in_range_mm};
use crate::units::Units;
use sheetwright::curve::CurvePoint;
use sheetwright::math::Point3;

/// The most curves of a file; a hull has some tens.
const MOST_CURVES: usize = 1000;
/// The most points of a file.
const MOST_POINTS: usize = 100_000;

/// What a line of the text is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Line<'a> {
    /// Nothing: a curve of the form that is taken ends.
    Empty,
    /// `0` or `1`: the unit of the form that is taken.
    Unit(Units),
    Point {
        numbers: [f64; 3],
        is_knuckle: bool,
    },
    /// The name of a section, such as `Station 1.250`.
    Name(&'a str),
    ControlCurve,
    /// `2 segments.`
    Count,
    /// `SEGMENT 1`
    Segment,
    End,
}

fn line(text: &str) -> Option<Line<'_>> {
    let text = text.trim();
    let words: Vec<&str> = text.split_whitespace().take(8).collect();
    let is = |at: usize, word: &str| {
        words.get(at).is_some_and(|found| found.trim_end_matches('.').eq_ignore_ascii_case(word))
    };
    // The programs write the decimal separator of the country.
    let number = |word: &&str| word.replace(',', ".").parse().ok().filter(|n: &f64| n.is_finite());
    let numbers: Vec<Option<f64>> = words.iter().map(number).collect();
    Some(match (&words[..], &numbers[..]) {
        ([], _) => Line::Empty,
        (["0"], _) => Line::Unit(Units::Metres),
        (["1"], _) => Line::Unit(Units::Feet),
        (_, &[Some(x), Some(y), Some(z)]) => Line::Point { numbers: [x, y, z], is_knuckle: false },
        (_, &[Some(x), Some(y), Some(z), None]) if is(3, "KNUCKLE") => {
            Line::Point { numbers: [x, y, z], is_knuckle: true }
        }
        ([_], _) if is(0, "EOF") => Line::End,
        ([_], _) if is(0, "CONTROLCURVE") => Line::ControlCurve,
        (_, [Some(_), None]) if is(1, "segments") => Line::Count,
        (_, [None, Some(_)]) if is(0, "SEGMENT") => Line::Segment,
        (_, [None, Some(_)]) => Line::Name(text),
        _ => return None,
    })
}

/// Whether a text is of this kind, by its first lines.
pub(super) fn is_freeship(text: &str) -> bool {
    let rows = || text.lines().filter(|row| !row.trim().is_empty());
    // A table has columns in its first line.
    let has_columns = |row: &str| row.trim().contains(['\t', ';']) || row.contains(", ");
    if rows().next().is_some_and(has_columns) {
        return false;
    }
    let mut firsts = rows().map(line);
    match (firsts.next().flatten(), firsts.next().flatten()) {
        (Some(Line::Unit(_) | Line::ControlCurve), second) => {
            matches!(second, Some(Line::Point { .. }))
        }
        (Some(Line::Name(_)), second) => matches!(second, Some(Line::Point { .. } | Line::Count)),
        _ => false,
    }
}

/// The lines of a hull that are given as points in space.
///
/// # Errors
/// A line that is not understood, numbers of an unknown unit, more curves than a hull has.
pub(super) fn read(text: &str, place: &str, units: GivenUnits) -> Result<HullTable, InputError> {
    let at = |number: usize| format!("{place}:{}", number + 1);
    let mut curves: Vec<HullCurve> = Vec::new();
    let (mut named, mut is_open, mut said, mut count) = (None, false, None, 0);
    for (number, row) in text.lines().enumerate() {
        let found = line(row).ok_or_else(|| not_understood(&at(number)))?;
        match found {
            Line::End => break,
            Line::Unit(unit) if curves.is_empty() && said.is_none() => said = Some(unit),
            Line::Unit(_) => return Err(not_understood(&at(number))),
            Line::Empty | Line::Segment => is_open = false,
            Line::Count => {}
            Line::Name(name) => {
                let words: Vec<&str> = name.split_whitespace().collect();
                let name = words.join(" ");
                if let Some(why) = refused_for_curve(&name) {
                    let message = format!("the name of the section {why}");
                    return Err(InputError::at(at(number), message, "Give it another name."));
                }
                (named, is_open) = (Some(name), false);
            }
            Line::ControlCurve => (named, is_open) = (None, false),
            Line::Point { numbers, is_knuckle } => {
                count += 1;
                if count > MOST_POINTS || !is_open && curves.len() == MOST_CURVES {
                    let message = format!(
                        "the file has more than {MOST_CURVES} curves or {MOST_POINTS} points"
                    );
                    return Err(InputError::at(at(number), message, "Export fewer sections."));
                }
                if !is_open {
                    curves.push(HullCurve { name: named.clone(), points: Vec::new() });
                    is_open = true;
                }
                let unit = units.asked.or(said).or(units.usual);
                let unit = unit.ok_or_else(|| without_unit(&at(number)))?;
                let [x, y, z] = numbers.map(|number| in_range_mm(number, unit));
                let (Some(x), Some(y), Some(z)) = (x, y, z) else {
                    return Err(InputError::at(
                        at(number),
                        "the point is out of range",
                        RANGE_HINT,
                    ));
                };
                let point = Point3::new(x, y, z);
                let point = CurvePoint { corner: is_knuckle, ..CurvePoint::smooth(point) };
                let Some(curve) = curves.last_mut() else { continue };
                match curve.points.last_mut() {
                    Some(last) if last.at == point.at => last.corner |= is_knuckle,
                    _ => curve.points.push(point),
                }
            }
        }
    }
    curves.retain(|curve| curve.points.len() > 1);
    if curves.is_empty() {
        return Err(InputError::at(place, "the file has no curve of two points or more", WHAT));
    }
    Ok(hull_of(curves))
}

const WHAT: &str = "It is read as a file of FREE!ship or DELFTship: names of sections or \
     CONTROLCURVE, and points 'x y z', with KNUCKLE behind those where a curve has a corner; or 0 \
     or 1 for metres or feet, curves parted by empty lines, and EOF.";

fn not_understood(place: &str) -> InputError {
    InputError::at(place, "the line is neither a point nor the name of a section", WHAT)
}

fn without_unit(place: &str) -> InputError {
    let message = "FREE!ship and DELFTship write metres or feet, and the file does not say which";
    InputError::at(place, message, "Set the units of the input.")
}
