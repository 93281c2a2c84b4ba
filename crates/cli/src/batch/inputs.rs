//! What a batch makes: the panels of curve tables, designs in lines, and whole files, in the order
//! of the call. A file that can't be read is an item too: its row says why.

use crate::args::{BatchArgs, StdinFormat};
use crate::failure::Failure;
use crate::source::{STDIN, STDIN_TWICE, STDIN_TWICE_HINT, is_stdin};
use sheetwright_files::{
    DesignLine, DesignLines, INPUT_ENDINGS, Ids, InputError, InputFormat, TablePanel, TablePanels,
    holds_panels, io_error, stem,
};
use std::collections::VecDeque;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

/// The endings of files with designs as JSON lines.
const LINES: [&str; 2] = [".jsonl", ".ndjson"];
/// What is looked at to tell a curve table from a table of offsets, bytes.
const LOOKED_AT: usize = 1 << 16;

/// What is read from standard input or a file with several panels.
type Stream = Box<dyn BufRead + Send>;

/// A panel or a design.
#[derive(Debug)]
pub(super) struct Item {
    /// Its number among all, from 1.
    pub(super) number: u64,
    /// Its name; no two have one.
    pub(super) id: String,
    /// Where it was read: a file, with a line if it holds several.
    pub(super) source: String,
    pub(super) work: Work,
}

/// What an item is read from.
#[derive(Debug)]
pub(super) enum Work {
    File(PathBuf),
    Panel(TablePanel),
    Line(DesignLine),
    /// It could not be opened or read.
    Failed(InputError),
}

impl Item {
    /// About how much memory it takes, bytes.
    pub(super) fn size(&self) -> usize {
        let held = match &self.work {
            Work::Panel(panel) => panel.size(),
            Work::Line(line) => line.size(),
            Work::File(_) | Work::Failed(_) => 0,
        };
        held + self.id.len() + self.source.len()
    }
}

/// A source that is open.
enum Open {
    Panels(Box<TablePanels<Stream>>),
    Designs(DesignLines<Stream>),
}

/// Reads the items of a call.
pub(super) struct Items {
    paths: VecDeque<PathBuf>,
    from: Option<StdinFormat>,
    /// The table that is written, which is no input.
    table: Option<PathBuf>,
    /// What is open, and how messages name it.
    open: Option<(Open, String)>,
    ids: Ids,
    count: u64,
}

impl Items {
    /// The items of a call that writes this table.
    pub(super) fn new(args: &BatchArgs, table: Option<&Path>) -> Result<Self, Failure> {
        let stdin = args.inputs.iter().filter(|input| is_stdin(input)).count();
        let (from, paths) = (args.from, args.inputs.iter().cloned().collect());
        if stdin > 1 {
            return Err(Failure::new(STDIN_TWICE, STDIN_TWICE_HINT));
        }
        if from.is_some() && stdin == 0 {
            let hint = "Leave --from out: the ending of a file's name tells its format.";
            return Err(Failure::new("--from is for standard input", hint));
        }
        if from.is_some_and(|from| !matches!(from, StdinFormat::Csv | StdinFormat::Json)) {
            let message = "a batch reads JSON lines or a curve table from standard input";
            let hint = "Add --from json or csv, or name files or a folder instead.";
            return Err(Failure::new(message, hint));
        }
        // It need not be there yet; its folder is.
        let table = table.and_then(|path| {
            let folder = path.parent().filter(|folder| *folder != Path::new(""));
            let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
            Some(folder.join(path.file_name()?))
        });
        Ok(Self { paths, from, table, open: None, ids: Ids::default(), count: 0 })
    }

    /// How many there were until now.
    pub(super) fn begun(&self) -> u64 {
        self.count
    }

    fn item(&mut self, name: &str, source: String, work: Work) -> Item {
        self.count += 1;
        let (number, id) = (self.count, self.ids.take(name, self.count));
        Item { number, id, source, work }
    }

    /// The next item of what is open; `None` at its end.
    fn next_of_open(&mut self) -> Option<Item> {
        let (open, place) = self.open.as_mut()?;
        let place = place.clone();
        let at = |line: u64| format!("{place}:{line}");
        let read = match open {
            Open::Panels(panels) => panels.next().map(|read| {
                read.map(|panel| (panel.name.clone(), at(panel.line), Work::Panel(panel)))
            }),
            Open::Designs(lines) => lines.next().map(|read| {
                let name = |line: &DesignLine| line.name.clone().unwrap_or_default();
                read.map(|line| (name(&line), at(line.line), Work::Line(line)))
            }),
        };
        let Some(read) = read else {
            self.open = None;
            return None;
        };
        let failed = |error| (stem(&place), place.clone(), Work::Failed(error));
        let (name, source, work) = read.unwrap_or_else(failed);
        Some(self.item(&name, source, work))
    }

    /// Opens an input; an item, if it is one by itself.
    fn open(&mut self, path: PathBuf) -> Option<Item> {
        // Where a shell names all files, the table is among them.
        if path.canonicalize().is_ok_and(|path| Some(path) == self.table) {
            return None;
        }
        let name = path.display().to_string();
        let lower = name.to_lowercase();
        let opened = if name == "-" {
            self.open_stdin()
        } else if path.is_dir() {
            return self.open_folder(&path);
        } else if LINES.iter().any(|ending| lower.ends_with(ending)) {
            let folder = path.parent().filter(|folder| *folder != Path::new(""));
            let lines = |from| {
                Open::Designs(DesignLines::new(from, &name, folder.or(Some(Path::new(".")))))
            };
            open_file(&path, &name).map(lines)
        } else if InputFormat::of(&path) == Ok(InputFormat::Table) {
            match open_file(&path, &name).and_then(|from| panels_of(from, &name)) {
                Ok(None) => return Some(self.item(&stem(&name), name, Work::File(path))),
                Ok(Some(panels)) => Ok(Open::Panels(Box::new(panels))),
                Err(error) => Err(error),
            }
        } else {
            return Some(self.item(&stem(&name), name, Work::File(path)));
        };
        let shown = if name == "-" { STDIN.to_owned() } else { name.clone() };
        match opened {
            Ok(open) => {
                self.open = Some((open, shown));
                None
            }
            Err(error) => Some(self.item(&stem(&name), shown, Work::Failed(error))),
        }
    }

    fn open_stdin(&self) -> Result<Open, InputError> {
        let mut from: Stream = Box::new(BufReader::with_capacity(LOOKED_AT, io::stdin()));
        let is_json = match self.from {
            Some(from) => matches!(from, StdinFormat::Json),
            None => {
                let beginning = from.fill_buf().unwrap_or_default();
                let text = beginning.strip_prefix(b"\xef\xbb\xbf").unwrap_or(beginning);
                text.trim_ascii_start().first().is_none_or(|&first| first == b'{')
            }
        };
        if is_json {
            return Ok(Open::Designs(DesignLines::new(from, "-", None)));
        }
        TablePanels::new(from, "-").map(|panels| Open::Panels(Box::new(panels)))
    }

    /// Puts the files of a folder that have the ending of an input before what is left, by name.
    fn open_folder(&mut self, folder: &Path) -> Option<Item> {
        let name = folder.display().to_string();
        let entries = match fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(error) => {
                let message = format!("the folder can't be read: {error}");
                let hint = "Check its permissions.".to_owned();
                let error = InputError { message, place: Some(name.clone()), hint };
                return Some(self.item(&stem(&name), name, Work::Failed(error)));
            }
        };
        let is_input = |path: &PathBuf| {
            let name = path.display().to_string().to_lowercase();
            let mut endings = INPUT_ENDINGS.iter().chain(&LINES);
            endings.any(|ending| name.ends_with(ending)) && path.is_file()
        };
        let paths = entries.flatten().map(|entry| entry.path());
        let mut paths: Vec<PathBuf> = paths.filter(is_input).collect();
        paths.sort();
        paths.into_iter().rev().for_each(|path| self.paths.push_front(path));
        None
    }
}

impl Iterator for Items {
    type Item = Item;

    fn next(&mut self) -> Option<Item> {
        loop {
            if let Some(item) = self.next_of_open() {
                return Some(item);
            }
            let path = self.paths.pop_front()?;
            if let Some(item) = self.open(path) {
                return Some(item);
            }
        }
    }
}

fn open_file(path: &Path, name: &str) -> Result<Stream, InputError> {
    let opened = File::open(path).map_err(|error| io_error(name, &error))?;
    Ok(Box::new(BufReader::with_capacity(LOOKED_AT, opened)))
}

/// The panels of a table; `None` of a table of offsets, which is a design as a whole.
fn panels_of(mut from: Stream, name: &str) -> Result<Option<TablePanels<Stream>>, InputError> {
    let beginning = from.fill_buf().unwrap_or_default();
    if holds_panels(beginning, name) { TablePanels::new(from, name).map(Some) } else { Ok(None) }
}
