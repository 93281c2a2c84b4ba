//! The panels of a curve table, one after the other: all rows of a panel stand together, so one
//! panel at a time is in memory.
//!
//! Splitting looks at one cell of each row. Numbers are read when a panel becomes a design, which
//! many threads can do at once.

use super::lines::{Line, Lines};
use crate::hull_table::is_hull_table;
use crate::input::{InputFormat, check_options, settle};
use crate::linework::says_rail;
use crate::names::shown;
use crate::reading::{
    InputError, ReadOptions, display_name, io_error, refuse_large, stem, text_of, without_utf16,
};
use crate::table::{Columns, MAX_ROWS, is_curve_table, no_rows, too_many_rows};
use crate::table_design::{design_of_curves, is_open};
use crate::units::Units;
use sheetwright::design::Design;
use std::collections::BTreeMap;
use std::io::BufRead;
use std::sync::Arc;

/// The most bytes of a row: far more than its cells can have.
const MOST_ROW_BYTES: usize = 1 << 16;

/// A panel of a table.
#[derive(Debug)]
pub struct TablePanel {
    /// Its name: the cell of the column `panel`, else of `curve`; of a table without these columns,
    /// the file's.
    pub name: String,
    /// The line of its first row.
    pub line: u64,
    /// How messages name the table.
    table: Arc<str>,
    columns: Arc<Columns>,
    /// Its rows, without the header.
    rows: Vec<u8>,
    /// Why its rows can't be used, if that shows already.
    fault: Option<InputError>,
}

impl TablePanel {
    /// About how much memory it takes, bytes.
    pub fn size(&self) -> usize {
        self.rows.len() + self.name.len()
    }

    /// The panel as a design: closed curves are its outline and holes, in order; two curves that
    /// are named rails are its rails.
    ///
    /// # Errors
    /// A row that can't be read, with its line; rows of the panel that stand apart; more rows than
    /// the limit; rails that are not two; settings out of range.
    pub fn design(&self, options: &ReadOptions) -> Result<Design, InputError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        check_options(InputFormat::Table, options)?;
        let above = self.line - 1;
        let text = std::str::from_utf8(&self.rows).map_err(|error| {
            let before = &self.rows[..error.valid_up_to()];
            let line = self.line + before.iter().filter(|&&b| b == b'\n').count() as u64;
            let place = format!("{}:{line}", self.table);
            let hint = "Save it as UTF-8 (in a spreadsheet: CSV UTF-8).";
            InputError::at(place, "the text is not encoded as UTF-8", hint)
        })?;
        let units = options.units.unwrap_or_default();
        let curves = self.columns.curves_of(text, &self.table, above, units)?;
        let place = format!("{}:{}", self.table, self.line);
        let mut design = design_of_curves(curves, &self.name, &place, options)?;
        settle(&mut design, InputFormat::Table, options)?;
        Ok(design)
    }

    /// Refuses rows of more bytes than an input may have, and frees them.
    fn limit(&mut self) {
        if let Err(error) = refuse_large(&self.rows, &self.table) {
            (self.fault, self.rows) = (Some(error), Vec::new());
        }
    }

    /// Whether it is an open curve that is named a rail; one whose rows can't be read is none.
    fn is_rail(&self) -> bool {
        let text = String::from_utf8_lossy(&self.rows);
        let curves = self.columns.curves_of(&text, &self.table, self.line - 1, Units::default());
        says_rail(&self.name) && curves.is_ok_and(|curves| curves.iter().all(is_open))
    }
}

/// Reads the panels of a table.
#[derive(Debug)]
pub struct TablePanels<R> {
    lines: Lines<R>,
    table: Arc<str>,
    columns: Arc<Columns>,
    /// The name of panels without one: the file's.
    unnamed: String,
    /// A row that belongs to the next panel, its line and the name of the panel.
    next: Option<(u64, String, Vec<u8>)>,
    /// The line where the rows of each panel began.
    begun: BTreeMap<String, u64>,
    /// A panel that was read ahead, or why it can't be read.
    ahead: Option<Result<TablePanel, InputError>>,
    is_at_end: bool,
}

impl<R: BufRead> TablePanels<R> {
    /// Reads the header of a table; `name` is that of its file, or `-` for standard input.
    ///
    /// # Errors
    /// The header can't be read, or lacks x, y or z.
    pub fn new(from: R, name: &str) -> Result<Self, InputError> {
        let table = display_name(name);
        let mut lines = Lines::new(from, MOST_ROW_BYTES);
        let mut header = Vec::new();
        loop {
            match lines.read(&mut header).map_err(|error| io_error(table, &error))? {
                Line::Read if header.trim_ascii().is_empty() => {}
                Line::Read => break,
                Line::TooLong => return Err(too_long(&format!("{table}:{}", lines.number))),
                // Refused as an empty file is.
                Line::End => break,
            }
        }
        let place = format!("{table}:{}", lines.number);
        if header.trim_ascii_end().contains(&b'\r') {
            return Err(lone_returns(&place));
        }
        let columns = Columns::of_line(text_of(&header, name)?, &place)?;
        Ok(Self {
            lines,
            table: table.into(),
            columns: columns.into(),
            unnamed: stem(name),
            next: None,
            begun: BTreeMap::new(),
            ahead: None,
            is_at_end: false,
        })
    }

    fn begin(&mut self, line: u64, name: String) -> TablePanel {
        let mut fault = None;
        let began = *self.begun.entry(name.clone()).or_insert(line);
        if began != line {
            let message = format!(
                "the rows of the panel {} do not stand together: they begin on line {began}",
                shown(&name)
            );
            let hint = "Sort the table by the name of the panel, or give each panel its own name.";
            fault = Some(InputError::at(format!("{}:{line}", self.table), message, hint));
        }
        let (table, columns) = (self.table.clone(), self.columns.clone());
        TablePanel { name, line, table, columns, rows: Vec::new(), fault }
    }

    /// The next panel, or the error of reading. The two curves of a table without the column
    /// `panel` are one where both are rails, as they are for a reader of the table as a whole.
    fn read(&mut self) -> Result<Option<TablePanel>, InputError> {
        if let Some(ahead) = self.ahead.take() {
            return ahead.map(Some);
        }
        let is_first = self.begun.is_empty();
        let Some(mut first) = self.read_rows()? else { return Ok(None) };
        let may_pair = is_first && !self.columns.has_panels() && first.fault.is_none();
        if !(may_pair && self.next.is_some() && first.is_rail()) {
            return Ok(Some(first));
        }
        let second = self.read_rows().transpose();
        let is_whole = self.next.is_none();
        match second {
            Some(Ok(second)) if is_whole && second.fault.is_none() && second.is_rail() => {
                first.name.clone_from(&self.unnamed);
                first.rows.extend(second.rows);
                first.limit();
            }
            other => self.ahead = other,
        }
        Ok(Some(first))
    }

    /// The rows of the next name, or the error of reading.
    fn read_rows(&mut self) -> Result<Option<TablePanel>, InputError> {
        let mut row = Vec::new();
        let mut panel: Option<TablePanel> = None;
        let mut count = 0;
        if let Some((line, name, first)) = self.next.take() {
            let begun = panel.insert(self.begin(line, name));
            begun.rows.extend(first);
            begun.rows.push(b'\n');
            count = 1;
        }
        while !self.is_at_end {
            let read = self.lines.read(&mut row).map_err(|error| io_error(&self.table, &error));
            let line = match read.inspect_err(|_| self.is_at_end = true)? {
                Line::End => {
                    self.is_at_end = true;
                    if panel.is_none() && self.begun.is_empty() {
                        return Err(no_rows(&self.table));
                    }
                    break;
                }
                line => line,
            };
            let number = self.lines.number;
            if line == Line::TooLong {
                // Which panel it is of, nothing tells: the one before is not whole.
                let place = format!("{}:{number}", self.table);
                let panel = panel.get_or_insert_with(|| self.begin(number, String::new()));
                panel.fault.get_or_insert(too_long(&place));
                continue;
            }
            if row.trim_ascii().is_empty() {
                // Lines within a panel keep their numbers.
                if let Some(panel) = panel.as_mut().filter(|panel| panel.fault.is_none()) {
                    panel.rows.push(b'\n');
                    panel.limit();
                }
                continue;
            }
            let name = if self.columns.names_panels() {
                self.columns.panel_of(&String::from_utf8_lossy(&row))
            } else {
                self.unnamed.clone()
            };
            let panel = match &mut panel {
                Some(panel) if panel.name == name => panel,
                Some(_) => {
                    self.next = Some((number, name, std::mem::take(&mut row)));
                    break;
                }
                none => none.insert(self.begin(number, name)),
            };
            count += 1;
            if count > MAX_ROWS {
                let place = format!("{}:{number}", self.table);
                panel.fault.get_or_insert(too_many_rows(&place));
                panel.rows = Vec::new();
            } else if panel.fault.is_none() && row.trim_ascii_end().contains(&b'\r') {
                panel.fault = Some(lone_returns(&format!("{}:{number}", self.table)));
                panel.rows = Vec::new();
            } else if panel.fault.is_none() {
                panel.rows.extend(&row);
                panel.rows.push(b'\n');
                panel.limit();
            }
        }
        Ok(panel)
    }
}

impl<R: BufRead> Iterator for TablePanels<R> {
    type Item = Result<TablePanel, InputError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.read().transpose()
    }
}

/// Whether a text table of this name that begins so is a curve table, each panel of which is read
/// by itself; it may be a table of offsets, which is a design as a whole.
pub fn holds_panels(beginning: &[u8], name: &str) -> bool {
    let text = without_utf16(beginning);
    let text = String::from_utf8_lossy(&text);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let is_csv = name == "-" || name.to_lowercase().ends_with(".csv");
    is_curve_table(text) || is_csv && !is_hull_table(text)
}

fn lone_returns(place: &str) -> InputError {
    let hint = "Save it as CSV UTF-8, whose lines end otherwise.";
    InputError::at(place, "lines end in carriage returns alone", hint)
}

fn too_long(place: &str) -> InputError {
    let hint = "Give each point a row of its own.";
    InputError::at(place, "the row is longer than 64 KiB", hint)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;
    use sheetwright::design::PanelShape;

    fn panels(text: &str) -> Vec<TablePanel> {
        TablePanels::new(text.as_bytes(), "t.csv").unwrap().map(Result::unwrap).collect()
    }

    fn refused(panel: &TablePanel) -> String {
        panel.design(&ReadOptions::default()).unwrap_err().to_string()
    }

    #[test]
    fn every_curve_is_a_panel() {
        let text = "curve,x,y,z\r\na,0,0,0\r\na,1,0,0\r\na,1,1,0\r\n\r\nb,0,0,0\r\nb,1,0,x\r\n";
        let panels = panels(text);
        let names: Vec<(&str, u64)> = panels.iter().map(|p| (&p.name[..], p.line)).collect();
        assert_eq!(names, [("a", 2), ("b", 6)]);
        let design = panels[0].design(&ReadOptions::default()).unwrap();
        assert_eq!((&design.name[..], design.curves[0].points.len()), ("a", 3));
        assert_eq!(refused(&panels[1]), "t.csv:7: z is 'x', which is no number");
    }

    #[test]
    fn a_table_of_two_rails_is_one_panel() {
        let rails = "curve,x,y,z\nrail a,0,0,0\nrail a,9,0,0\n\nrail b,0,9,0\nrail b,9,9,1\n";
        let names = |text: &str| -> Vec<(String, u64)> {
            let panels = TablePanels::new(text.as_bytes(), "plank.csv").unwrap();
            panels.map(|panel| panel.unwrap()).map(|panel| (panel.name, panel.line)).collect()
        };
        assert_eq!(names(rails), [("plank".to_owned(), 2)]);
        let mut panels = TablePanels::new(rails.as_bytes(), "plank.csv").unwrap();
        let options = ReadOptions::default();
        let design = panels.next().unwrap().unwrap().design(&options).unwrap();
        let alone = crate::table_design::read_as_design(rails, "plank.csv", &options).unwrap();
        assert_eq!(design.curves, alone.curves);
        assert_eq!(design.panels, alone.panels);
        assert_eq!(design.notes, alone.notes);
        // A third curve, and closed ones, are panels of their own.
        let a = ("rail a".to_owned(), 2);
        let third = format!("{rails}c,0,0,0\nc,9,0,0\nc,0,9,0\n");
        assert_eq!(names(&third), [a.clone(), ("rail b".to_owned(), 5), ("c".to_owned(), 7)]);
        let closed = rails.replace("9,9,1\n", "9,9,1\nrail b,0,9,0\n");
        assert_eq!(names(&closed), [a, ("rail b".to_owned(), 5)]);
    }

    #[test]
    fn a_panel_has_holes_or_two_rails() {
        let text = "panel;curve;x;y;z\n\
                    p;rim;0;0;0\np;rim;9,5;0;0\np;rim;9;9;0\np;\"hole\";1;1;0\np;hole;2;1;0\np;hole;2;2;0\n\
                    q;rail 1;0;0;0\nq;rail 1;9;0;0\nq;Rail-2;0;9;0\nq;Rail-2;9;9;1\n\
                    r;rail;0;0;0\nr;rail;9;0;0\nr;b;0;9;0\nr;c;9;9;1\n";
        let panels = panels(text);
        let options = ReadOptions::default();
        let holes = panels[0].design(&options).unwrap();
        let PanelShape::Loops { holes, .. } = &holes.panels[0].shape else { panic!() };
        assert_eq!(holes.len(), 1);
        let strip = panels[1].design(&options).unwrap();
        assert!(matches!(strip.panels[0].shape, PanelShape::Rails(_)));
        assert_eq!(refused(&panels[2]), "t.csv:12: 1 of the 3 curves of the panel 'r' are rails");
    }

    #[test]
    fn rows_that_stand_apart_are_refused_there_alone() {
        let panels = panels("x,y,z,curve\n0,0,0,a\n0,0,0,b\n0,0,0,a\n");
        assert_eq!(panels.len(), 3);
        let said = "t.csv:4: the rows of the panel 'a' do not stand together: they begin on line 2";
        assert_eq!(refused(&panels[2]), said);
        assert!(panels[0].fault.is_none() && panels[1].fault.is_none());
    }

    #[test]
    fn a_table_without_names_is_one_panel() {
        let panels = panels("x,y,z\n0,0,0\n1,0,0\n1,1,0\n");
        assert_eq!((panels.len(), &panels[0].name[..]), (1, "t"));
    }

    #[test]
    fn a_table_without_panels_and_lines_with_returns_alone_are_refused() {
        let mut none = TablePanels::new(&b"x,y,z\n\n"[..], "t.csv").unwrap();
        let error = none.next().unwrap().unwrap_err();
        assert_eq!(error.to_string(), "t.csv: the table has no rows below its header");
        assert!(none.next().is_none());
        let error = TablePanels::new(&b"x,y,z\r0,0,0\r9,0,0\r"[..], "t.csv").unwrap_err();
        assert_eq!(error.to_string(), "t.csv:1: lines end in carriage returns alone");
        let panels = panels("curve,x,y,z\na,0,0,0\rb,1,1,1\nc,0,0,0\nc,1,0,0\nc,1,1,0\n");
        assert_eq!(refused(&panels[0]), "t.csv:2: lines end in carriage returns alone");
        assert!(panels[1].design(&ReadOptions::default()).is_ok());
    }

    #[test]
    fn a_header_is_refused_as_ever() {
        let refused = |text: &str| TablePanels::new(text.as_bytes(), "t.csv").unwrap_err();
        assert_eq!(
            refused("\n\nx,y,colour\n").to_string(),
            "t.csv:3: the column 'colour' is not known"
        );
        assert_eq!(refused("").to_string(), "t.csv: the input is empty");
    }
}
