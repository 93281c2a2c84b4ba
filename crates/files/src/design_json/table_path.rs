//! Points that a design takes from a table beside it. A design may be untrusted, so its tables must
//! lie in its own folder or below it.

use super::beside::{Kind, file_beside};
use super::source::Source;
use crate::hull_table::read_curves;
use crate::names::{did_you_mean, shown};
use crate::reading::{InputError, MAX_INPUT_BYTES, read_whole};
use crate::table::{TableCurve, points_named};
use crate::units::Units;
use sheetwright::curve::CurvePoint;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const TABLE: Kind =
    Kind { word: "table", files: "a curve table or a table of offsets (.csv, .xlsx or .ods)" };

/// The tables of a design, each read once.
pub(super) struct Tables<'a> {
    source: &'a Source<'a>,
    units: Option<Units>,
    read: BTreeMap<PathBuf, Vec<TableCurve>>,
    /// The bytes left for the other tables of the design.
    bytes_left: u64,
}

impl<'a> Tables<'a> {
    pub(super) fn new(source: &'a Source<'a>, units: Option<Units>) -> Self {
        Self { source, units, read: BTreeMap::new(), bytes_left: MAX_INPUT_BYTES }
    }

    /// The points of a curve of a table. `path` is the JSON path of the curve in the design.
    pub(super) fn points(
        &mut self,
        table: &str,
        wanted: Option<&str>,
        closed: bool,
        path: &str,
    ) -> Result<Vec<CurvePoint>, InputError> {
        let source = self.source;
        let file = self.file_of(table, path)?;
        if !self.read.contains_key(&file) {
            let curves = self.read_anew(&file, table, path)?;
            self.read.insert(file.clone(), curves);
        }
        let curves = self.read.get(&file).map_or(&[][..], Vec::as_slice);
        let points = match (wanted, curves) {
            (Some(wanted), _) => points_named(curves, wanted, closed),
            (None, [only]) => Some(only.curve_points(closed)),
            (None, _) => None,
        };
        points.ok_or_else(|| {
            let known: Vec<&str> = curves.iter().map(|c| c.name.as_str()).collect();
            let message = match wanted {
                Some(name) => format!("{} has no curve {}", shown(table), shown(name)),
                None => format!("{} has {} curves, and none is named", shown(table), curves.len()),
            };
            let hint = match wanted {
                Some(name) => did_you_mean(name, &known),
                None => format!("Name one with \"curve\". {}", did_you_mean("", &known)),
            };
            source.error(&format!("{path}.curve"), message, hint)
        })
    }

    /// The file that a table's path leads to, inside the design's folder.
    fn file_of(&self, table: &str, path: &str) -> Result<PathBuf, InputError> {
        let path = format!("{path}.table");
        let Some(folder) = self.source.folder else {
            let message = "a design from standard input can't take points from a table";
            let hint = "Save the design as a file in the folder of its tables.";
            return Err(self.source.error(&path, message, hint));
        };
        file_beside(folder, table, TABLE, &|message, hint| self.source.error(&path, message, hint))
    }

    fn read_anew(
        &mut self,
        file: &Path,
        table: &str,
        path: &str,
    ) -> Result<Vec<TableCurve>, InputError> {
        let bytes = read_whole(file).map_err(|error| InputError {
            // Errors show the path as the design has it, not the resolved one.
            place: Some(table.to_owned()),
            ..error
        })?;
        let size = bytes.len() as u64;
        if size > self.bytes_left {
            let message = "the tables of the design are larger than 256 MiB in total";
            let hint = "Remove points; a few hundred are enough for a curve.";
            return Err(self.source.error(&format!("{path}.table"), message, hint));
        }
        self.bytes_left -= size;
        read_curves(&bytes, table, self.units)
    }
}

/// All curves of a table inside a folder, in `units` where they are given. Messages about its path
/// begin with `place`.
pub(crate) fn table_beside(
    folder: &Path,
    table: &str,
    units: Option<Units>,
    place: &str,
) -> Result<Vec<TableCurve>, InputError> {
    let file =
        file_beside(folder, table, TABLE, &|message, hint| InputError::at(place, message, hint))?;
    let bytes =
        read_whole(&file).map_err(|error| InputError { place: Some(table.to_owned()), ..error })?;
    read_curves(&bytes, table, units)
}
