//! The rows that an earlier run wrote to the table: how far they go, and whether they are those of
//! the inputs of this run.

use super::inputs::Item;
use crate::failure::Failure;
use sheetwright_files::whole::Growing;
use sheetwright_files::{BatchCount, RowHead, TableRows};
use std::fs::File;
use std::io::{self, BufRead as _, BufReader};
use std::path::Path;

/// How far a table goes.
#[derive(Debug)]
pub(super) struct Reach {
    /// The number of the last item with a row; it is made again, since more may belong to it.
    last: u64,
    /// Where its rows begin, bytes from the beginning.
    pub(super) start: u64,
    /// Its rows that are whole.
    pub(super) rows: Vec<u8>,
    /// The rows before.
    pub(super) count: BatchCount,
}

/// Compares the rows with the items of this run, one after the other.
pub(super) struct Earlier {
    table: String,
    from: BufReader<File>,
    rows: TableRows,
    last: u64,
    /// The row that is compared next, and its line.
    row: Vec<u8>,
    line: u64,
}

const OTHER: &str = "Give the inputs and options of the first run, or begin a new table.";

/// What an earlier run has left in a table; `None` if that is no row.
pub(super) fn read(
    table: &Growing,
    path: &Path,
    rows: TableRows,
) -> Result<Option<(Reach, Earlier)>, Failure> {
    let shown = path.display().to_string();
    let failed = |error: &io::Error| unreadable(&shown, error);
    let mut from = table.read()?;
    let mut line = Vec::new();
    let (mut number, mut at) = (0, 0);
    let header = rows.header();
    if !header.is_empty() {
        from.read_until(b'\n', &mut line).map_err(|error| failed(&error))?;
        if header.starts_with(&line) && line != header {
            return Ok(None);
        }
        if line != header {
            let message = "this is no table that such a batch writes";
            return Err(Failure::new(message, OTHER).at(format!("{shown}:1")));
        }
        (number, at) = (1, header.len() as u64);
    }
    let mut reach: Option<Reach> = None;
    // Those of the item that is read.
    let mut count = BatchCount::default();
    loop {
        line.clear();
        from.read_until(b'\n', &mut line).map_err(|error| failed(&error))?;
        if line.last() != Some(&b'\n') {
            break;
        }
        line.pop();
        number += 1;
        let row = rows.kept(&line).ok_or_else(|| no_row(&shown, number))?;
        match &mut reach {
            Some(reach) if reach.last == row.number => {}
            reach => {
                let mut before = reach.take().map_or_else(BatchCount::default, |r| r.count);
                before.join(&count);
                count = BatchCount::default();
                let rows = Vec::new();
                *reach = Some(Reach { last: row.number, start: at, rows, count: before });
            }
        }
        count.add_kept(&row);
        if let Some(reach) = &mut reach {
            reach.rows.extend(&line);
            reach.rows.push(b'\n');
        }
        at += line.len() as u64 + 1;
    }
    if !rows.may_be_cut(&line) {
        return Err(no_row(&shown, number + 1));
    }
    let Some(reach) = reach else { return Ok(None) };
    let mut from = table.read()?;
    let mut line = 0;
    if !header.is_empty() {
        from.read_until(b'\n', &mut Vec::new()).map_err(|error| failed(&error))?;
        line = 1;
    }
    let last = reach.last;
    let row = Vec::new();
    Ok(Some((reach, Earlier { table: shown, from, rows, last, row, line })))
}

impl Earlier {
    /// Whether an item has all its rows; the last one that has any is made again.
    pub(super) fn has(&mut self, item: &Item) -> Result<bool, Failure> {
        if item.number > self.last {
            return Ok(false);
        }
        let head = RowHead { number: item.number, id: &item.id, source: "", seconds: None };
        let begins = self.rows.begins(&head);
        if self.row.is_empty() {
            self.read()?;
        }
        if !self.row.starts_with(&begins) {
            let message = format!(
                "the row of number {}, id {} belongs here: the table is of other inputs",
                item.number, item.id
            );
            return Err(Failure::new(message, OTHER).at(format!("{}:{}", self.table, self.line)));
        }
        if item.number == self.last {
            return Ok(false);
        }
        while self.row.starts_with(&begins) {
            self.read()?;
        }
        Ok(true)
    }

    fn read(&mut self) -> Result<(), Failure> {
        self.row.clear();
        let read = self.from.read_until(b'\n', &mut self.row);
        read.map_err(|error| unreadable(&self.table, &error))?;
        self.line += 1;
        Ok(())
    }

    /// The refusal of inputs that end before the rows do.
    pub(super) fn ended(self, items: u64) -> Option<Failure> {
        (items < self.last).then(|| {
            let message = format!(
                "the table goes to number {}, and the inputs to {items}: they are others",
                self.last
            );
            Failure::new(message, OTHER).at(self.table)
        })
    }
}

fn no_row(table: &str, line: u64) -> Failure {
    let message = "this is no row that such a batch writes";
    Failure::new(message, OTHER).at(format!("{table}:{line}"))
}

fn unreadable(table: &str, error: &io::Error) -> Failure {
    Failure::new(format!("the table can't be read: {error}"), "Check the disk.").at(table)
}
