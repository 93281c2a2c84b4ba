//! Reads tables of offsets of hulls, as builders write them, from text and from workbooks.
//! (`offsets` writes those of patterns.)
//!
//! ```text
//! text, workbook ──► grid ──► layout ──► lines ──► design
//!                      (label, notation)
//! ```
//!
//! A table has stations one way and lines the other. `grid` has its cells, `notation` reads a
//! length, `label` a word; `layout` finds stations and lines, `bare` the unit of numbers without
//! one, `lines` makes curves in space of them, and `design` draws the planks between the edges as
//! the template `hull` does. What is not understood is refused with its place and with what was
//! recognised (`said`). docs/offset-tables.md is the page for people.
//!
//! Files that have points in space in place of tables go past all that: `freeship ──► sections`.

mod bare;
mod design;
mod freeship;
mod grid;
mod label;
mod layout;
mod lines;
mod notation;
mod said;
mod sections;
mod workbook;

pub(crate) use bare::GivenUnits;
pub(crate) use design::read_as_design;

use crate::names::refused_for_curve;
use crate::reading::{InputError, ReadOptions, SecondTable, display_name, stem, text_of};
use crate::table::{TableCurve, is_curve_table, read_table};
use crate::units::Units;
use grid::Grid;
use label::{Quantity, is_line, is_station_word, quantity_of};
use lines::HullTable;
use std::path::Path;

/// Rows at the beginning of a text that are looked at for words of a table of offsets.
const LOOKED_AT: usize = 40;

/// Whether a text is a table of offsets, by its words, or has the curves of a hull.
pub(crate) fn is_hull_table(text: &str) -> bool {
    let is_word = |cell: &str| {
        let cell = cell.trim_matches([' ', '"']);
        is_station_word(cell) || is_line(cell)
    };
    let rows = text.lines().filter(|row| !row.trim().is_empty()).take(LOOKED_AT);
    !is_curve_table(text)
        && (freeship::is_freeship(text)
            || rows.into_iter().any(|row| row.split([',', ';', '\t']).any(is_word)))
}

/// Whether a file of this name is a workbook.
pub(crate) fn is_workbook(name: &str) -> bool {
    let ending = Path::new(name).extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    ["xlsx", "ods"].contains(&&ending[..])
}

/// The lines of a table of offsets, or of a workbook that holds one; of a `second` file, too, which
/// has the half-breadths if the first has the heights.
///
/// # Errors
/// What is not understood of it.
pub(crate) fn read_hull_table(
    bytes: &[u8],
    name: &str,
    is_workbook: bool,
    second: Option<&SecondTable>,
    units: GivenUnits,
) -> Result<HullTable, InputError> {
    let place = display_name(name);
    let text = if is_workbook { "" } else { text_of(bytes, name)? };
    if freeship::is_freeship(text) {
        if second.is_some() {
            let message = "the file has whole points, and no second table goes with it";
            return Err(InputError::at(place, message, "Leave the second table out."));
        }
        return named_well(freeship::read(text, place, units)?, place);
    }
    let mut grids = grids_in(bytes, name, is_workbook)?;
    if let Some(SecondTable { name: second, bytes }) = second {
        // A file with one table has the quantity that its name says.
        let called = |name: &str| quantity_of(&stem(name).replace(['_', '-'], " "));
        if let [(quantity, _)] = &mut grids[..] {
            *quantity = quantity.or(called(name));
        }
        let more = grids_in(bytes, second, self::is_workbook(second))?.into_iter();
        grids.extend(more.map(|(quantity, grid)| (quantity.or(called(second)), grid)));
    }
    let layout = layout::layout(&grids);
    let source = match &grids[..] {
        [(_, only)] => only.source(),
        _ => place,
    };
    let table = lines::lines(&layout, units).map_err(|refusal| refusal.error(&layout, source))?;
    named_well(table, source)
}

/// The table, if all its lines have names that curves may have.
fn named_well(table: HullTable, source: &str) -> Result<HullTable, InputError> {
    for line in &table.lines {
        if let Some(why) = refused_for_curve(&line.name) {
            let message = format!("the name of the line {} {why}", crate::names::shown(&line.name));
            return Err(InputError::at(source, message, "Give it another name."));
        }
    }
    Ok(table)
}

/// The tables in a file, each with the quantity that the name of its sheet says.
fn grids_in(
    bytes: &[u8],
    name: &str,
    is_workbook: bool,
) -> Result<Vec<(Option<Quantity>, Grid)>, InputError> {
    let place = display_name(name);
    if is_workbook {
        let sheets = workbook::sheets(bytes, place)?;
        return Ok(sheets.into_iter().map(|(name, grid)| (quantity_of(&name), grid)).collect());
    }
    let text = text_of(bytes, name)?;
    refuse_delftship(text, place)?;
    Ok(vec![(None, Grid::of_text(text, place)?)])
}

/// What is to be noted of an input that is a table of offsets: how many stations and lines it has,
/// and what it does not say in so many words. Nothing of other inputs, and of tables that can't be
/// read.
pub fn hull_table_notes(bytes: &[u8], name: &str, options: &ReadOptions) -> Vec<String> {
    let (units, second) = (options.units, options.second_table.as_ref());
    let is_workbook = bytes.starts_with(b"PK\x03\x04");
    if !is_workbook && !text_of(bytes, name).is_ok_and(is_hull_table) {
        return Vec::new();
    }
    let units = GivenUnits { asked: units, usual: None };
    let Ok(table) = read_hull_table(bytes, name, is_workbook, second, units) else {
        return Vec::new();
    };
    let names: Vec<String> = table.lines.iter().map(|line| line.name.clone()).collect();
    let place = |at: Option<&(String, f64)>| at.map_or(0.0, |(_, at)| *at);
    let at_stations = match table.stations.len() {
        0 => String::new(),
        count => format!(
            "{count} stations from {:.0} to {:.0} mm and ",
            place(table.stations.first()),
            place(table.stations.last()),
        ),
    };
    let first =
        format!("a table of offsets with {at_stations}{} lines: {}", names.len(), names.join(", "));
    let edges = table.lines.iter().filter(|line| line.is_edge).count();
    let round = (edges < 2).then(|| {
        "waterlines and buttocks alone bound no planks: name two of the curves as the `rails` of a \
         panel in a design, or add the lines of sheer, chine and keel to the table"
            .to_owned()
    });
    [first].into_iter().chain(table.notes).chain(round).collect()
}

/// The curves of a table that a design or a template names: of a curve table, or of a table of
/// offsets. Without `units`, those of an offset table are those that it names, else millimetres.
///
/// # Errors
/// Bytes that are neither.
pub(crate) fn read_curves(
    bytes: &[u8],
    name: &str,
    units: Option<Units>,
) -> Result<Vec<TableCurve>, InputError> {
    let is_workbook = is_workbook(name);
    if !is_workbook {
        let text = text_of(bytes, name)?;
        if !is_hull_table(text) {
            return read_table(text, name, units.unwrap_or_default());
        }
    }
    let units = GivenUnits { asked: units, usual: Some(Units::default()) };
    let table = read_hull_table(bytes, name, is_workbook, None, units)?;
    let curve = |line: lines::HullLine| TableCurve { name: line.name, points: line.points };
    Ok(table.lines.into_iter().map(curve).collect())
}

/// Refuses the text files that DELFTship exports as tables of offsets. Their first ten lines are
/// known (numbers of waterlines and stations, five flags, length, beam, draft); how the lengths
/// follow is not published.
fn refuse_delftship(text: &str, place: &str) -> Result<(), InputError> {
    let firsts: Vec<&str> = text.lines().map(str::trim).take(10).collect();
    let counts = firsts.iter().take(2).all(|line| line.parse::<u32>().is_ok());
    let flags = firsts.iter().skip(2).take(5).all(|line| ["0", "1"].contains(line));
    let sizes = firsts.iter().skip(7).all(|line| line.parse::<f64>().is_ok());
    if firsts.len() < 10 || !(counts && flags && sizes) {
        return Ok(());
    }
    let message = format!(
        "this is an export of DELFTship, of {} waterlines and {} stations, which have no edges of \
         planks",
        firsts[0], firsts[1]
    );
    let hint = "Export the stations as text with their knuckles, the chines and the sheer as 3D \
                curves (.dxf), or the hull as a mesh (.obj, .stl).";
    Err(InputError::at(place, message, hint))
}

#[cfg(test)]
mod tests;
