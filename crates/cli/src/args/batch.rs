//! What `sheetwright batch` takes.

use super::mesh::MeshArgs;
use super::output::{FileArgs, PdfArgs, format_parser};
use super::source::{SourceArgs, StdinFormat};
use clap::Args;
use sheetwright::design::Design;
use sheetwright_files::{Format, OutputOptions};
use std::num::NonZeroU64;
use std::path::PathBuf;

/// The most panels that are made at once.
const MOST_THREADS: usize = 1024;

#[derive(Debug, Args)]
pub(crate) struct BatchArgs {
    /// Files of every kind that `make` takes, folders of such files, designs as JSON lines
    /// (.jsonl), or - for standard input, JSON lines or a curve table. Every curve of a curve table
    /// is a panel, unless a column `panel` groups several
    #[arg(value_name = "INPUT", required = true)]
    pub(crate) inputs: Vec<PathBuf>,
    /// The format of standard input: json (JSON lines) or csv [default: told from its content]
    #[arg(long, value_enum, ignore_case = true, value_name = "FORMAT")]
    pub(crate) from: Option<StdinFormat>,
    /// The table to write, .csv or .jsonl [default: table.csv in the folder of --out, or standard
    /// output]
    #[arg(long, value_name = "FILE")]
    pub(crate) table: Option<PathBuf>,
    /// The folder for files: each panel has a folder of its own in it, named after its id
    #[arg(long, short, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// The formats to write, separated by commas [default: none, the table alone]
    #[arg(long, value_name = "LIST", value_delimiter = ',', ignore_case = true,
        value_parser = format_parser(), requires = "out")]
    pub(crate) formats: Vec<Format>,
    /// Go on after the last whole row of the table, which must be of the same inputs
    #[arg(long)]
    pub(crate) resume: bool,
    /// Every Nth panel or design alone, beginning with the Kth, such as 3/16
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub(crate) shard: Option<Shard>,
    /// How many panels are made at once [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<usize>,
    /// Add a column with the seconds that each panel took; two runs then differ
    #[arg(long)]
    pub(crate) times: bool,
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
    #[command(flatten)]
    pdf: PdfArgs,
    #[command(flatten)]
    files: FileArgs,
}

impl BatchArgs {
    pub(crate) fn options(&self, design: &Design) -> OutputOptions {
        OutputOptions { pdf: self.pdf.options(), ..self.files.options(design) }
    }
}

/// A share of all panels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shard {
    first: u64,
    of: NonZeroU64,
}

impl Shard {
    /// Whether it has the item of this number, from 1.
    pub(crate) fn has(self, number: u64) -> bool {
        number % self.of == self.first % self.of
    }
}

fn shard(given: &str) -> Result<Shard, String> {
    let parsed = given.split_once('/').and_then(|(first, of)| {
        Some(Shard { first: first.trim().parse().ok()?, of: of.trim().parse().ok()? })
    });
    let within = parsed.filter(|shard| (1..=shard.of.get()).contains(&shard.first));
    within
        .ok_or_else(|| "give the number of the share and how many there are, as in 3/16".to_owned())
}

fn threads(given: &str) -> Result<usize, String> {
    let number = given.parse().ok().filter(|number| (1..=MOST_THREADS).contains(number));
    number.ok_or_else(|| format!("give a whole number from 1 to {MOST_THREADS}"))
}
