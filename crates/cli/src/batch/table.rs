//! The table of a batch: a file that grows by whole rows, or standard output.

use super::earlier::{self, Earlier, Reach};
use super::work::Done;
use crate::args::BatchArgs;
use crate::failure::Failure;
use crate::voice::print_as_it_is;
use sheetwright_files::whole::Growing;
use sheetwright_files::{BatchCount, TableForm, TableRows};
use std::path::Path;
use std::time::{Duration, Instant};

/// So many bytes are written at once.
const WRITTEN_AT_ONCE: usize = 1 << 16;
/// So long a row waits for others.
pub(super) const WRITTEN_AFTER: Duration = Duration::from_millis(500);

/// A table that is written.
pub(super) struct Table {
    rows: TableRows,
    /// `None` is standard output.
    file: Option<Growing>,
    /// What an earlier run wrote of the item that is made first.
    again: Option<Reach>,
    /// Rows that wait to be written.
    waiting: Vec<u8>,
    written: Instant,
    count: BatchCount,
    is_empty: bool,
}

impl Table {
    /// Opens the table of a call, and reads what an earlier run wrote to it.
    pub(super) fn open(
        path: Option<&Path>,
        args: &BatchArgs,
    ) -> Result<(Self, Option<Earlier>), Failure> {
        let form = path.map_or(Some(TableForm::Csv), TableForm::of).ok_or_else(|| {
            let shown = path.unwrap_or(Path::new("")).display().to_string();
            let message = "the ending of the table's name is no form of tables";
            Failure::new(message, "End it in .csv or .jsonl.").at(shown)
        })?;
        let rows = TableRows { form, has_seconds: args.times };
        let (mut again, mut before, mut file) = (None, None, None);
        if let Some(path) = path {
            let mut growing = Growing::open(path)?;
            let is_new = path.metadata().is_ok_and(|data| data.len() == 0);
            if !is_new && !args.resume {
                let hint = "Add --resume to go on with it, remove it, or choose another name.";
                let failure = Failure::new("there is a table of this name", hint);
                return Err(failure.at(path.display().to_string()));
            }
            (again, before) = earlier::read(&growing, path, rows)?.unzip();
            if again.is_none() {
                growing.cut(0)?;
            }
            file = Some(growing);
        } else if args.resume {
            let hint = "Name the table that the first run wrote: --table FILE.";
            return Err(Failure::new("standard output can't be gone on with", hint));
        }
        let count = again.as_ref().map(|again: &Reach| again.count.clone()).unwrap_or_default();
        let waiting = if again.is_none() { rows.header() } else { Vec::new() };
        let is_empty = again.is_none();
        let written = Instant::now();
        Ok((Self { rows, file, again, waiting, written, count, is_empty }, before))
    }

    pub(super) fn rows(&self) -> TableRows {
        self.rows
    }

    /// Its rows, counted.
    pub(super) fn count(&self) -> &BatchCount {
        &self.count
    }

    /// Adds the rows of an item, or hears that time has passed.
    pub(super) fn add(&mut self, done: Option<Done>) -> Result<(), Failure> {
        if let Some(done) = done {
            self.go_on(&done)?;
            self.waiting.extend(done.rows);
            self.count.join(&done.count);
        } else if self.count.rows() == 0 {
            // The header comes with the first row.
            return Ok(());
        }
        let is_time = self.written.elapsed() >= WRITTEN_AFTER;
        if self.waiting.len() >= WRITTEN_AT_ONCE || is_time { self.write() } else { Ok(()) }
    }

    /// The rows of the first item take the place of those that an earlier run wrote of it, which
    /// are the beginning of them: else that run was made with other options, or by another version.
    fn go_on(&mut self, done: &Done) -> Result<(), Failure> {
        let Some(again) = self.again.take() else { return Ok(()) };
        // Times differ from run to run.
        if !self.rows.has_seconds && !done.rows.starts_with(&again.rows) {
            let row = String::from_utf8_lossy(&done.rows);
            let row = row.lines().next().unwrap_or_default();
            let message = format!(
                "the last row of the table comes out otherwise now: other options, another input \
                 or another version; it would be: {row}"
            );
            let hint = "Give the inputs and options of the first run, or begin a new table.";
            return Err(Failure::new(message, hint));
        }
        match &mut self.file {
            Some(file) => Ok(file.cut(again.start)?),
            None => Ok(()),
        }
    }

    fn write(&mut self) -> Result<(), Failure> {
        self.written = Instant::now();
        if self.waiting.is_empty() {
            return Ok(());
        }
        match &mut self.file {
            Some(file) => file.add(&self.waiting)?,
            None => print_as_it_is(&self.waiting)?,
        }
        self.waiting.clear();
        self.is_empty = false;
        Ok(())
    }

    /// Writes what waits.
    pub(super) fn end(&mut self) -> Result<(), Failure> {
        self.write()
    }

    /// After a failure: what was made is written, and a table without a row is removed.
    pub(super) fn give_up(&mut self) -> Result<(), Failure> {
        if !self.is_empty || self.count.rows() > 0 {
            return self.write();
        }
        match self.file.take() {
            Some(file) => Ok(file.remove_empty()?),
            None => Ok(()),
        }
    }
}
