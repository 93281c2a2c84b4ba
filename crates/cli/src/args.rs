//! The command line: what each command takes.

mod batch;
mod mesh;
mod output;
mod sheets;
mod source;
mod values;

pub(crate) use batch::{BatchArgs, Shard};
pub(crate) use mesh::MeshArgs;
pub(crate) use source::{FormArgs, InputArgs, SourceArgs, StdinFormat};

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use output::{BrakeArgs, FileArgs, PdfArgs, ReportArg, format_parser};
use sheets::SheetArgs;
use sheetwright::design::Design;
use sheetwright::template::catalogue;
use sheetwright_files::{Format, OutputOptions, ReportForm, trade_names};
use std::path::PathBuf;
use values::Name;

const EXAMPLES: &str = "\
Examples:
  sheetwright make dinghy.sheet.json --out build
      Every panel of the design: patterns, surface and report into build/
  sheetwright make leaf.csv --out build --samples 300 --formats svg,report
      A closed curve from a spreadsheet, smoothed through its points
  sheetwright make skiff.xlsx --out build --for boat
      A table of offsets in feet, inches and eighths, or in mm: the planks of a hull
  sheetwright make hood.stl --out build --units cm --material leather-2mm
      A mesh from another program, flattened as it is: by how much must it stretch?
  sheetwright make shade.svg --out build
      A drawing (.svg, .dxf): closed curves are outlines and holes, two open ones are rails
  sheetwright check dinghy.sheet.json
      Will it bend? Prints the verdict and writes no files
  sheetwright batch facade.csv --table panels.csv
      A row a panel: verdict, strain, radius, areas, sizes, for as many as there are
  sheetwright new --list
      Templates: cones, ducts, domes and others, with their parameters
  sheetwright new cone --set bottom=40cm --make build
      From a template to patterns in one step; with -o hood.sheet.json, a design to edit
  sheetwright convert leaf.csv leaf.sheet.json
      A curve table becomes a design to edit

Exit status:
  0  done, and no finding is an error
  1  done, and some finding is an error: a panel will not bend, or overlaps itself
  2  the input or the call can't be used; nothing is written of that input";

const MAKE_EXAMPLES: &str = "\
Examples:
  sheetwright make dinghy.sheet.json --out build
  sheetwright make leaf.csv --out build --units in --samples 300
  generate-curve | sheetwright make - --out build
  sheetwright make dinghy.sheet.json --out build --json --formats dxf,report
  sheetwright make plank.dxf --out build --rails sheer,chine --samples 200
      Two curves of a drawing, by their layers or ids, as the rails of a panel
  sheetwright make tent.obj --out build --units m --aim seams
      Meshes (.obj, .stl, .ply, .glb): one panel for each group, both sides of a seam equally long
  sheetwright make box.stl --out build --split-creases 30
  sheetwright make dinghy.sheet.json --out build --preset lightburn --formats svg,report
  sheetwright make bear.obj --out build --facets --pieces-within a4
  sheetwright make hull.sheet.json deck.dxf --out build
      Several inputs: build/hull/ and build/deck/
  sheetwright make dome.sheet.json --out build --sheet 1220x2440mm --gap 6mm
      All parts laid out on sheets of plywood, in sheets.svg and sheets.dxf
  sheetwright make dinghy.sheet.json --out build --vary-warp 6 --vary-limit 5mm
      Moves the curves as little as needed for a warp of 6°, and writes the moved curves";

const CHECK_EXAMPLES: &str = "\
Examples:
  sheetwright check dinghy.sheet.json
  sheetwright check leaf.csv --samples 300 --method bridge
  sheetwright check hood.stl --units cm --material leather-2mm
  sheetwright check dinghy.sheet.json --json";

const BATCH_EXAMPLES: &str = "\
Examples:
  sheetwright batch facade.csv --table panels.csv
      Every curve of a table is a panel; a column `panel` groups outlines with holes, or two rails
  sheetwright batch designs/ --table panels.jsonl --threads 8
      All designs, tables, drawings and meshes of a folder, each finding in words
  make-designs | sheetwright batch - --table panels.csv
      Designs as JSON lines, a .sheet.json in each
  sheetwright batch facade.csv --table panels.csv --resume
      Goes on after the last whole row of a table that was stopped
  sheetwright batch facade.csv --table part-3.csv --shard 3/16
      Every 16th panel, from the third: for clusters; docs/batch.md tells how to merge
  sheetwright batch facade.csv --out build --formats dxf
      The patterns, too: build/ID/ for each panel, and build/table.csv

Exit status: as of the others; 1 also where a panel could not be made, and its row says why";

const CONVERT_EXAMPLES: &str = "\
Examples:
  sheetwright convert leaf.csv leaf.sheet.json        a table becomes a design
  sheetwright convert lid.svg lid.sheet.json          a drawing becomes a design
  sheetwright convert skiff.xlsx skiff.sheet.json     a table of offsets becomes planks, to edit
  sheetwright convert dinghy.sheet.json curves.csv    the points of its curves
  sheetwright convert dinghy.sheet.json dinghy.obj    all surfaces; also .pdf, .html, .json
  sheetwright convert dinghy.sheet.json dinghy.step   smooth surfaces for CAD
  sheetwright convert leaf.csv leaf.dxf               the pattern of a single panel; also .svg
  sheetwright convert hood.stl hood.svg --units cm    the pattern of a mesh";

const NEW_EXAMPLES: &str = "\
Examples:
  sheetwright new --list                              all templates and their parameters
  sheetwright new cone --list                         the parameters of one template
  sheetwright new cone --set bottom=40cm --set height='15 3/4in' -o hood.sheet.json
  sheetwright new hemisphere --make build             the patterns and the report in one step
  sheetwright new elbow --for duct --make build       with flanges, laps and a plan of bends
  sheetwright new cone --set material=steel-1mm | sheetwright check -";

/// From boundary curves to the developable surface that fits them best, and its flat pattern.
#[derive(Debug, Parser)]
#[command(name = "sheetwright", version, after_help = EXAMPLES, arg_required_else_help = true)]
pub(crate) struct Cli {
    /// Print findings and errors as JSON, one object per line
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Show no progress and no notes
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Everything that the command does.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Make surfaces, flat patterns and a report
    #[command(after_help = MAKE_EXAMPLES)]
    Make(MakeArgs),
    /// Say whether the panels will bend
    #[command(after_help = CHECK_EXAMPLES)]
    Check(CheckArgs),
    /// Make a table with a row for each of many panels
    #[command(after_help = BATCH_EXAMPLES)]
    Batch(Box<BatchArgs>),
    /// Write a design from a template
    #[command(after_help = NEW_EXAMPLES)]
    New(NewArgs),
    /// Turn one format into another, by the endings of the names
    #[command(after_help = CONVERT_EXAMPLES)]
    Convert(ConvertArgs),
    /// Print the completions of a shell
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the manual page, or that of a command
    Man {
        /// The command
        command: Option<String>,
    },
}

#[derive(Debug, Args)]
pub(crate) struct MakeArgs {
    /// Designs (.sheet.json), curve tables (.csv), tables of offsets (.csv, .tsv, .txt, .xlsx,
    /// .ods), drawings (.svg, .dxf), meshes (.obj, .stl, .ply, .glb), or - for standard input; of
    /// several, each has a folder of its own in DIR, called after its file
    #[arg(value_name = "INPUT", required = true)]
    pub(crate) inputs: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) form: FormArgs,
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// The folder for the files; it is created if it is missing, and its other files stay
    #[arg(long, short, value_name = "DIR")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
    /// The formats to write, separated by commas [default: as the design or its trade says, or obj,
    /// svg, dxf, pdf and report]
    #[arg(long, value_name = "LIST", value_delimiter = ',', ignore_case = true,
        value_parser = format_parser())]
    pub(crate) formats: Vec<Format>,
    /// How much report.html shows: everything of every panel, or a table with thumbnails [default:
    /// long up to 100 panels, short beyond]
    #[arg(long, value_enum, value_name = "FORM")]
    pub(crate) report: Option<ReportArg>,
    #[command(flatten)]
    pub(crate) pdf: PdfArgs,
    #[command(flatten)]
    pub(crate) files: FileArgs,
    #[command(flatten)]
    pub(crate) brake: BrakeArgs,
}

impl MakeArgs {
    pub(crate) fn options(&self, design: &Design) -> OutputOptions {
        let report = match self.report {
            None => ReportForm::Auto,
            Some(ReportArg::Short) => ReportForm::Short,
            Some(ReportArg::Long) => ReportForm::Long,
        };
        let (pdf, brake) = (self.pdf.options(), self.brake.settings());
        OutputOptions { pdf, report, brake, ..self.files.options(design) }
    }

    /// What is to be said of options that show in no file of a design in these formats.
    pub(crate) fn idle(&self, design: &Design, formats: &[Format]) -> Vec<String> {
        let lacks = |needed: &[Format]| !needed.iter().any(|format| formats.contains(format));
        let mut said = Vec::new();
        let mut say = |option: Option<&str>, is_idle: bool, why: &str| {
            said.extend(option.filter(|_| is_idle).map(|option| format!("{option} {why}")));
        };
        let why = "has no effect without offsets among the --formats";
        say(self.files.offsets_option(), lacks(&[Format::Offsets]), why);
        let why = "has no effect without brake among the --formats";
        say(self.brake.option(), lacks(&[Format::Brake]), why);
        let why = "shows in no file without sheets, report or assembly among the --formats";
        let shown = [Format::Sheets, Format::Report, Format::Assembly];
        say(self.source.sheet_option(), lacks(&shown), why);
        let why = "has no effect on the pattern without --dimensions, which is that of the surface \
                   that was drawn";
        say(self.source.thickness_option(), design.dimensions.is_none(), why);
        said
    }
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

#[derive(Debug, Args)]
pub(crate) struct NewArgs {
    /// The template
    #[arg(value_name = "TEMPLATE", required_unless_present = "list",
        value_parser = Name { known: template_values })]
    pub(crate) template: Option<String>,
    /// List the templates and their parameters, or the parameters of this template
    #[arg(long, conflicts_with_all = ["set", "out", "make"])]
    pub(crate) list: bool,
    /// Set a parameter: a length in mm or with a unit (400mm, 40cm, 0.4m, 15 3/4in, 1' 4"), an
    /// angle in degrees, a number or a choice
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// The trade that it is made for: what is done along its edges, and which files are written
    /// [default: none, bare outlines]; the list says which trade each template is usually for
    #[arg(long = "for", value_name = "TRADE", conflicts_with = "list",
        value_parser = PossibleValuesParser::new(trade_names()))]
    pub(crate) trade: Option<String>,
    /// The design to write [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Also make the design, as `make` does: design, patterns and report go into this folder
    #[arg(long, value_name = "DIR", conflicts_with = "out")]
    pub(crate) make: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) sheets: SheetArgs,
}

#[derive(Debug, Args)]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// The file to write: .sheet.json (design), .csv (table), .obj, .step, .fold, .pdf, .html or
    /// .json (report), or, of a single panel, .svg or .dxf
    #[arg(value_name = "OUT")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
    #[command(flatten)]
    pub(crate) pdf: PdfArgs,
    #[command(flatten)]
    pub(crate) files: FileArgs,
}

fn template_values() -> Vec<PossibleValue> {
    catalogue().iter().map(|one| PossibleValue::new(one.name).help(one.title)).collect()
}
