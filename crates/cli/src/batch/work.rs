//! Makes the panels of one item, with its files if some are asked for, and writes its rows.
//! Whatever goes wrong becomes a row of its own.

use super::inputs::{Item, Work};
use crate::args::BatchArgs;
use crate::failure::Failure;
use crate::size::sized;
use crate::source;
use crate::voice::Voice;
use sheetwright::design::Design;
use sheetwright::make::{Judging, Made, PanelRow, make_judged, make_rows};
use sheetwright::triangulate::on_one_thread;
use sheetwright::watch::Unwatched;
use sheetwright_files::whole::Folder;
use sheetwright_files::{
    BatchCount, FAULT, Format, InputFormat, ReadOptions, RowError, RowHead, TableRows,
    output_files, refuse_unmade, refused_for_file, shown,
};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Notes on single inputs would drown in a batch.
const QUIET: Voice = Voice { json: false, quiet: true };

/// What came of an item.
#[derive(Debug)]
pub(super) struct Done {
    /// Its rows as they stand in the table.
    pub(super) rows: Vec<u8>,
    pub(super) count: BatchCount,
}

/// Makes items.
pub(super) struct Worker<'a> {
    args: &'a BatchArgs,
    options: ReadOptions,
    judging: Judging,
    rows: TableRows,
    formats: Vec<Format>,
}

impl<'a> Worker<'a> {
    pub(super) fn new(args: &'a BatchArgs, rows: TableRows, judging: Judging) -> Self {
        let options = source::options(&args.source, &args.mesh);
        let is_asked = |format: &Format| args.formats.contains(format);
        let formats = Format::ALL.into_iter().filter(is_asked).collect();
        Self { args, options, judging, rows, formats }
    }

    /// Makes an item.
    pub(super) fn done(&self, item: &Item) -> Done {
        let start = Instant::now();
        // As many are made at once as there are cores.
        let made = catch_unwind(AssertUnwindSafe(|| on_one_thread(|| self.made(item))));
        let made =
            made.unwrap_or_else(|_| Err(Failure::new("the program stumbled over it", FAULT)));
        let seconds = self.rows.has_seconds.then(|| start.elapsed().as_secs_f64());
        let head = RowHead { number: item.number, id: &item.id, source: &item.source, seconds };
        let mut count = BatchCount::default();
        let rows = match made {
            Ok(rows) => {
                rows.iter().for_each(|row| count.add(row));
                self.rows.made(&head, &rows)
            }
            Err(failure) => {
                count.add_failed();
                self.rows.failed(&head, &in_row(failure, item))
            }
        };
        Done { rows, count }
    }

    fn made(&self, item: &Item) -> Result<Vec<PanelRow>, Failure> {
        let design = self.design(item)?;
        let failed = |error| Failure::of_make(&error, &design, &item.source);
        let rows = if self.formats.is_empty() {
            make_rows(&design, self.judging, &mut Unwatched).map_err(failed)?
        } else {
            let mut made = make_judged(&design, self.judging, &mut Unwatched).map_err(failed)?;
            self.write(item, &design, &mut made)?;
            made.rows()
        };
        if rows.is_empty() {
            let message = "no part of it is large enough to be sheet";
            return Err(Failure::new(message, "Check its units."));
        }
        Ok(rows)
    }

    fn design(&self, item: &Item) -> Result<Design, Failure> {
        let BatchArgs { source, mesh, .. } = self.args;
        match &item.work {
            Work::File(path) => source::design_in(path, source, mesh, QUIET),
            Work::Panel(panel) => {
                let design = panel.design(&self.options)?;
                sized(design, InputFormat::Table, None, source, QUIET)
            }
            Work::Line(line) => {
                let design = line.design(&self.options)?;
                sized(design, InputFormat::Design, None, source, QUIET)
            }
            Work::Failed(error) => Err(error.clone().into()),
        }
    }

    /// Writes the files of an item into a folder of its own. What is found while they are written
    /// goes to the parts.
    fn write(&self, item: &Item, design: &Design, made: &mut Made) -> Result<(), Failure> {
        let Some(out) = &self.args.out else { return Ok(()) };
        if let Some(why) = refused_for_file(&item.id) {
            let message =
                format!("the folder of its files would be {}, which {why}", shown(&item.id));
            return Err(Failure::new(message, "Name it otherwise, or make the table alone."));
        }
        refuse_unmade(design, &self.formats)?;
        made.lay_out(&mut Unwatched);
        let outputs = output_files(made, &self.formats, self.args.options(design));
        let outputs = outputs
            .map_err(|error| Failure::new(error.to_string(), error.hint().unwrap_or(FAULT)))?;
        let mut batch = Folder::new(&out.join(&item.id))?.batch()?;
        for file in &outputs.files {
            batch.add(&file.name, &file.bytes)?;
        }
        batch.keep()?;
        for (part, checked) in made.parts.iter_mut().zip(outputs.panels) {
            part.checked = checked;
        }
        Ok(())
    }
}

/// A failure as a row tells it: the place is left out where the row names it already.
fn in_row(failure: Failure, item: &Item) -> RowError {
    let Failure { message, place, hint } = failure;
    let place = place.filter(|place| *place != item.source);
    let message = match place {
        Some(place) => format!("{place}: {message}"),
        None => message,
    };
    RowError { message, hint }
}
