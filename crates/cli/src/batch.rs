//! `sheetwright batch`: a table with a row for each of many panels, of which few are in memory.
//!
//! A thread reads panels or designs, one after the other (`inputs`); others make them (`work`), and
//! the rows are written in the order of reading (`in_order`). A table that an earlier run began
//! says which of them are done (`earlier`, `table`).

mod earlier;
mod in_order;
mod inputs;
mod progress;
mod table;
mod work;

use crate::args::{BatchArgs, Shard};
use crate::failure::Failure;
use crate::signals;
use crate::voice::{Voice, print};
use earlier::Earlier;
use in_order::{Limits, in_order};
use inputs::{Item, Items};
use progress::Progress;
use sheetwright::make::Judging;
use sheetwright_files::whole::Folder;
use std::path::PathBuf;
use std::thread;
use std::time::Instant;
use table::{Table, WRITTEN_AFTER};
use work::Worker;

/// Panels and lines that were read and have no row yet have at most so many bytes in all, unless
/// one has more.
const MOST_WAITING_BYTES: usize = 64 << 20;
/// At most so many panels or designs wait, for each thread.
const MOST_WAITING_EACH: usize = 64;
/// The table in the folder of files, if the call names none.
const TABLE: &str = "table.csv";

pub(crate) fn run(args: &BatchArgs, voice: Voice) -> Result<bool, Failure> {
    let start = Instant::now();
    if let Some(out) = &args.out {
        Folder::new(out)?.create()?;
    }
    let in_out = || args.out.as_ref().map(|out| out.join(TABLE));
    let path: Option<PathBuf> = args.table.clone().or_else(in_out);
    let items = Items::new(args, path.as_deref())?;
    let (mut table, earlier) = Table::open(path.as_deref(), args)?;
    let worker = Worker::new(args, table.rows(), args.source.judging(Judging::Auto));
    // A system that does not say how many cores it has gets one thread.
    let cores = || thread::available_parallelism().map_or(1, usize::from);
    let threads = args.threads.unwrap_or_else(cores);
    let limits = Limits {
        threads,
        items: threads.saturating_mul(MOST_WAITING_EACH),
        bytes: MOST_WAITING_BYTES,
        every: WRITTEN_AFTER,
    };
    if let Some(path) = &path {
        let path = path.display();
        signals::say_when_stopped(format!("stopped: --resume goes on with {path}\n"));
    }
    let mut progress = Progress::new(voice);
    let todo = Todo { items, shard: args.shard, earlier, is_at_end: false };
    let mut made = 0;
    let work = |item: Item| worker.done(&item);
    let done = in_order(&limits, todo, Item::size, work, |done| {
        if let Some(done) = &done {
            made += done.count.rows();
            progress.show(made);
        }
        table.add(done)
    });
    progress.end();
    if let Err(failure) = done {
        table.give_up()?;
        return Err(failure);
    }
    table.end()?;
    let count = table.count();
    let shown = path.as_ref().map(|path| path.display().to_string());
    match (&shown, voice.json) {
        (Some(table), true) => print(&count.json(Some(table)))?,
        (Some(table), false) => print(&format!("{}\n{table}\n", count.text()))?,
        (None, _) => voice.note(&count.text()),
    }
    let seconds = start.elapsed().as_secs_f64();
    let counted =
        |count: u64, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (rows, threads) = (counted(made, "row"), counted(threads as u64, "thread"));
    voice.note(&format!("{rows} in {seconds:.1} s by {threads}"));
    Ok(count.has_errors())
}

/// What is left to make.
struct Todo {
    items: Items,
    shard: Option<Shard>,
    earlier: Option<Earlier>,
    is_at_end: bool,
}

impl Todo {
    fn is_done(&mut self, item: &Item) -> Result<bool, Failure> {
        self.earlier.as_mut().map_or(Ok(false), |earlier| earlier.has(item))
    }

    /// The refusal of inputs that have nothing to make, or less than an earlier run found in them.
    fn ended(&mut self) -> Option<Failure> {
        let count = self.items.begun();
        let earlier = self.earlier.take().and_then(|earlier| earlier.ended(count));
        let empty = || {
            Failure::new(
                "the inputs hold no panel",
                "Give designs, curve tables, drawings or meshes, or folders with such files.",
            )
        };
        earlier.or_else(|| (count == 0).then(empty))
    }
}

impl Iterator for Todo {
    type Item = Result<Item, Failure>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.is_at_end {
            let Some(item) = self.items.next() else {
                self.is_at_end = true;
                return self.ended().map(Err);
            };
            if self.shard.is_some_and(|shard| !shard.has(item.number)) {
                continue;
            }
            match self.is_done(&item) {
                Ok(true) => {}
                Ok(false) => return Some(Ok(item)),
                Err(failure) => {
                    self.is_at_end = true;
                    return Some(Err(failure));
                }
            }
        }
        None
    }
}
