//! The command line.

use clap::builder::{PossibleValue, PossibleValuesParser, StringValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use sheetwright::boundary::PlaneChoice;
use sheetwright::design::{BendMarks, BendRule, Design, Dimensions, PanelMethod};
use sheetwright::flatten::Aim;
use sheetwright::make::Judging;
use sheetwright::math::from_deg;
use sheetwright::mesh::Skin;
use sheetwright::template::catalogue;
use sheetwright::triangulate::WhichSurface;
use sheetwright_files::{
    BendSettings, BrakeSettings, DxfRelease, Format, InputFormat, MOST_TOLERANCE_MM, MaxSheets,
    MeshFormat, MeshSettings, OffsetOptions, OutputOptions, Paper, PdfOptions, Preset, ReadOptions,
    ReportForm, Units, VarySettings, catalogue_names, known_materials, trade_names,
};
use std::ffi::OsStr;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sheetwright make dinghy.sheet.json --out build
      Every panel of the design: patterns, surface and report into build/
  sheetwright make leaf.csv --out build --samples 300 --formats svg,report
      A closed curve from a spreadsheet, smoothed through its points
  sheetwright make hood.stl --out build --units cm --material leather-2mm
      A mesh from another program, flattened as it is: by how much must it stretch?
  sheetwright check dinghy.sheet.json
      Will it bend? Prints the verdict and writes no files
  sheetwright new --list
      Templates: cones, ducts, domes and others, with their parameters
  sheetwright new cone --set bottom=40cm --make build
      From a template to patterns in one step; with -o hood.sheet.json, a design to edit
  sheetwright convert leaf.csv leaf.sheet.json
      A curve table becomes a design to edit

Exit status:
  0  done, and no finding is an error
  1  done, and some finding is an error: a panel will not bend, or overlaps itself
  2  the input or the call can't be used; nothing is written";

const MAKE_EXAMPLES: &str = "\
Examples:
  sheetwright make dinghy.sheet.json --out build
  sheetwright make leaf.csv --out build --units in --samples 300
  generate-curve | sheetwright make - --out build
  sheetwright make dinghy.sheet.json --out build --json --formats dxf,report
  sheetwright make tent.obj --out build --units m --aim seams
      Meshes (.obj, .stl, .ply, .glb): one panel for each group, both sides of a seam equally long
  sheetwright make box.stl --out build --split-creases 30
  sheetwright make dinghy.sheet.json --out build --preset lightburn --formats svg,report
  sheetwright make bear.obj --out build --facets --pieces-within a4
  sheetwright make dinghy.sheet.json --out build --vary-warp 6 --vary-limit 5mm
      Moves the curves as little as needed for a warp of 6°, and writes the moved curves";

const CHECK_EXAMPLES: &str = "\
Examples:
  sheetwright check dinghy.sheet.json
  sheetwright check leaf.csv --samples 300 --method bridge
  sheetwright check hood.stl --units cm --material leather-2mm
  sheetwright check dinghy.sheet.json --json";

const CONVERT_EXAMPLES: &str = "\
Examples:
  sheetwright convert leaf.csv leaf.sheet.json        a table becomes a design
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

/// The machine that the format `brake` is for.
#[derive(Debug, Args)]
#[command(next_help_heading = "Press brake (--formats brake)")]
pub(crate) struct BrakeArgs {
    /// The opening of the die [default: eight thicknesses of the sheet]
    #[arg(long, value_name = "LENGTH", value_parser = size_mm)]
    die: Option<f64>,
    /// The longest line that the brake bends [default: any]
    #[arg(long, value_name = "LENGTH", value_parser = size_mm)]
    brake_length: Option<f64>,
    /// The plan is for plate rolls: the radius at each station instead of hits
    #[arg(long, conflicts_with_all = ["die", "brake_length"])]
    rolls: bool,
}

impl BrakeArgs {
    fn settings(&self) -> BrakeSettings {
        let Self { die, brake_length, rolls } = *self;
        BrakeSettings { die_mm: die, length_mm: brake_length, rolls }
    }
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
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ReportArg {
    /// A table of all panels with thumbnails, and the findings
    Short,
    /// Everything of every panel
    Long,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

/// How meshes are flattened.
#[derive(Debug, Args)]
#[command(next_help_heading = "Meshes")]
pub(crate) struct MeshArgs {
    /// What flattening minimises where a mesh can't be laid flat exactly [default: mean]
    #[arg(long, value_enum, ignore_case = true, value_name = "AIM")]
    pub(crate) aim: Option<AimArg>,
    /// Divide a mesh into panels along the creases above this angle, in degrees
    #[arg(long, value_name = "DEG", value_parser = crease_deg)]
    pub(crate) split_creases: Option<f64>,
    /// Cut a mesh that would stretch too much, from its border to the points that stretch most
    #[arg(long)]
    pub(crate) darts: bool,
    /// Lay one skin flat alone of a plate that comes as a closed mesh with two
    #[arg(long, value_enum, ignore_case = true, value_name = "SKIN")]
    pub(crate) skin: Option<SkinArg>,
    /// Fold a mesh between its facets and stretch nothing, as a paper model is made; --facets=off
    /// never does [default: where a coarse mesh would not bend as one surface]
    #[arg(long, value_enum, ignore_case = true, value_name = "HOW", num_args = 0..=1,
        require_equals = true, default_missing_value = "on")]
    pub(crate) facets: Option<FacetsArg>,
    /// No piece of a mesh that is folded is larger than this: the name of a paper, on one sheet of
    /// which it is printed, or a width and a height in mm, such as 280x200
    #[arg(long, value_name = "SIZE", value_parser = piece_size)]
    pub(crate) pieces_within: Option<PieceSize>,
}

/// Whether facets are folded.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum FacetsArg {
    /// They are
    On,
    /// They are not
    Off,
}

/// The largest size of a piece, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceSize([f64; 2]);

fn piece_size(given: &str) -> Result<PieceSize, String> {
    let given = given.to_lowercase();
    if let Some(paper) = Paper::from_name(&given) {
        return Ok(PieceSize(paper.whole_piece_mm()));
    }
    let lengths = given.split_once(['x', '×']);
    let size = lengths.and_then(|(width, height)| {
        let mm = |text: &str| sheetwright_files::distance_mm(text).filter(|&mm| mm > 0.0);
        Some(PieceSize([mm(width.trim())?, mm(height.trim())?]))
    });
    size.ok_or_else(|| "give a4, letter, or a width and a height such as 280x200".to_owned())
}

impl MeshArgs {
    pub(crate) fn settings(&self) -> MeshSettings {
        MeshSettings {
            aim: self.aim.map(|aim| match aim {
                AimArg::Mean => Aim::Mean,
                AimArg::Max => Aim::Max,
                AimArg::Seams => Aim::Seams,
            }),
            split_creases: self.split_creases.map(from_deg),
            darts: self.darts,
            skin: self.skin.map(|skin| match skin {
                SkinArg::Outer => Skin::Outer,
                SkinArg::Inner => Skin::Inner,
            }),
            facets: self.facets.map(|facets| matches!(facets, FacetsArg::On)),
            pieces_within_mm: self.pieces_within.map(|PieceSize(size)| size),
        }
    }

    /// The first option for meshes that is given, as it is written.
    pub(crate) fn given(&self) -> Option<String> {
        let aim = self.aim.map(|aim| format!("--aim {}", aim.name()));
        let others = [
            ("--split-creases", self.split_creases.is_some()),
            ("--darts", self.darts),
            ("--skin", self.skin.is_some()),
            ("--facets", self.facets.is_some()),
            ("--pieces-within", self.pieces_within.is_some()),
        ];
        let other = others.iter().find(|(_, is_given)| *is_given);
        aim.or_else(|| other.map(|(name, _)| (*name).to_owned()))
    }
}

fn crease_deg(given: &str) -> Result<f64, String> {
    let deg = given.parse().ok().filter(|deg| (1.0..180.0).contains(deg));
    deg.ok_or_else(|| "give an angle from 1 to below 180 degrees".to_owned())
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
}

#[derive(Debug, Args)]
pub(crate) struct ConvertArgs {
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

/// What patterns are written for.
#[derive(Debug, Args)]
#[command(next_help_heading = "Files for machines and by hand")]
pub(crate) struct FileArgs {
    /// What SVG and DXF files are written for: layers, colours and their order [default: as the
    /// design or its trade says, or generic]
    #[arg(long, value_name = "NAME", ignore_case = true, hide_possible_values = true,
        value_parser = preset_parser(), long_help = preset_help())]
    preset: Option<&'static Preset>,
    /// The release of DXF files: r12, which every program reads, or r2000, which says that the unit
    /// is the millimetre [default: as the design, its trade or the preset wants it, r12 mostly]
    #[arg(long, value_name = "RELEASE", ignore_case = true, value_parser = dxf_parser())]
    dxf: Option<DxfRelease>,
    /// The distance of the stations in offsets.csv, in mm or with a unit (100mm, 6in) [default: a
    /// round one for 10 to 20 stations]
    #[arg(long, value_name = "LENGTH", value_parser = pitch_mm)]
    stations: Option<f64>,
    /// Write offsets.csv in feet, inches and eighths, such as 2-3-5
    #[arg(long)]
    feet: bool,
    /// Write a pattern for every part; without it, equal parts are cut from that of the first
    #[arg(long)]
    each_part: bool,
}

impl FileArgs {
    /// The options for a design, which may say how its files are written.
    pub(crate) fn options(&self, design: &Design) -> OutputOptions {
        let of_design = OutputOptions::with_preset(design, self.preset);
        OutputOptions {
            dxf: self.dxf.or(of_design.dxf),
            offsets: OffsetOptions { pitch_mm: self.stations, feet: self.feet },
            each_part: self.each_part,
            ..of_design
        }
    }
}

fn preset_parser() -> impl TypedValueParser<Value = &'static Preset> {
    let value = |preset: &Preset| PossibleValue::new(preset.name).help(preset.about);
    let values: Vec<PossibleValue> = Preset::all().iter().map(value).collect();
    PossibleValuesParser::new(values)
        .try_map(|name| Preset::from_name(&name.to_lowercase()).ok_or("this preset is not known"))
}

fn preset_help() -> String {
    let rows = Preset::all().iter().map(|preset| format!("  {:<11} {}", preset.name, preset.about));
    format!(
        "What SVG and DXF files are written for: layers, colours and their order [default: as the \
         design or its trade says, or generic]\n{}",
        rows.collect::<Vec<_>>().join("\n")
    )
}

fn dxf_parser() -> impl TypedValueParser<Value = DxfRelease> {
    let names = DxfRelease::ALL.map(DxfRelease::name);
    PossibleValuesParser::new(names).try_map(|name| {
        DxfRelease::from_name(&name.to_lowercase()).ok_or("this release is not known")
    })
}

fn pitch_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::distance_mm(given).filter(|&mm| mm >= 0.01);
    mm.ok_or_else(|| "give a length of at least 0.01 mm, such as 100, 100mm or 6in".to_owned())
}

/// How patterns are laid out on paper.
#[derive(Debug, Args)]
pub(crate) struct PdfArgs {
    /// The paper size of the PDF
    #[arg(long, value_name = "PAPER", default_value = "a4", ignore_case = true,
        value_parser = paper_parser())]
    paper: Paper,
    /// The most sheets of paper for one panel in the PDF, 1 to 20000 [default: 2000]; a larger
    /// panel is drawn to a smaller scale on one page, with a table of offsets
    #[arg(long, value_name = "N", value_parser = max_sheets)]
    max_sheets: Option<MaxSheets>,
}

impl PdfArgs {
    pub(crate) fn options(&self) -> PdfOptions {
        PdfOptions { paper: self.paper, max_sheets: self.max_sheets.unwrap_or_default() }
    }
}

fn max_sheets(given: &str) -> Result<MaxSheets, String> {
    let number = given.parse().ok().and_then(MaxSheets::new);
    number.ok_or_else(|| format!("give a whole number from 1 to {}", MaxSheets::MOST.get()))
}

/// The input, and the options that replace its values.
#[derive(Debug, Args)]
pub(crate) struct SourceArgs {
    /// A design (.sheet.json), a curve table (.csv), a mesh (.obj, .stl, .ply, .glb), or - for
    /// standard input
    #[arg(value_name = "INPUT")]
    pub(crate) input: PathBuf,
    /// The format of standard input [default: told from its content]
    #[arg(long, value_enum, ignore_case = true, value_name = "FORMAT")]
    pub(crate) from: Option<StdinFormat>,
    /// The number of samples of each outer loop or rail; with it, the curves of a table become
    /// splines through their points
    #[arg(long, value_name = "N")]
    samples: Option<usize>,
    /// As many samples as keep the outline this near to its curves, where no number is given: no
    /// curve lies farther from it, along no edge is it shorter by more (0.05mm, 1/64in); the rows
    /// of a table stay the samples [default: as the design says, or a ten-thousandth of the size of
    /// each panel]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance_mm, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// The weight of the fold price, from 0 (twist alone) to 10
    #[arg(long, value_name = "NU", allow_negative_numbers = true)]
    fold: Option<f64>,
    /// The limit on the search for the surface of a panel with holes, as a multiple of the default,
    /// which is up to 5 seconds; at the limit, the best surface found is used, and a finding says
    /// how far it may be from the best possible
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    effort: Option<f64>,
    /// What the verdict comes from
    #[arg(long, value_enum, ignore_case = true, value_name = "HOW", default_value = "exact")]
    verdict: VerdictArg,
    /// Which triangulations are searched
    #[arg(long, value_enum, ignore_case = true, value_name = "METHOD")]
    method: Option<MethodArg>,
    /// Which surface is made where two fit a boundary about as well
    #[arg(long, value_enum, ignore_case = true, value_name = "SIDE")]
    side: Option<SideArg>,
    /// Whether the surface lies over a plane onto which the boundary projects without crossing
    /// itself [default: as the design says, or auto]
    #[arg(long, value_enum, ignore_case = true, value_name = "PLANE")]
    plane: Option<PlaneArg>,
    /// The unit of a curve table or a mesh [default: mm; of a mesh that would be smaller than 5 mm:
    /// m]; a design states its own
    #[arg(long, value_name = "UNITS", ignore_case = true, value_parser = units_parser())]
    pub(crate) units: Option<Units>,
    /// The largest extent of the whole design along x, y or z, in mm or with a unit (300mm, 1ft):
    /// all its lengths change by one factor
    #[arg(long, value_name = "LENGTH", value_parser = size_mm,
        conflicts_with_all = ["scale", "vary_limit", "vary_budget"])]
    pub(crate) size: Option<f64>,
    /// The factor by which all lengths of the design change
    #[arg(long, value_name = "FACTOR", value_parser = scale,
        conflicts_with_all = ["vary_limit", "vary_budget"])]
    pub(crate) scale: Option<f64>,
    /// The material of the sheet, in place of the design's: one of the design's own materials, or
    /// one of the catalogue, which docs/materials.md lists
    #[arg(
        long,
        value_name = "NAME",
        value_parser = Name { known: material_values },
        hide_possible_values = true,
        long_help = material_help()
    )]
    material: Option<String>,
    /// The trade that it is made for: what is done along its edges, such as tabs, holes or
    /// allowances, and which files are written [default: as the design says, or bare outlines];
    /// docs/trades.md lists them
    #[arg(long = "for", value_name = "TRADE", value_parser = PossibleValuesParser::new(trade_names()))]
    trade: Option<String>,
    /// The width of an allowance along all edges, in mm or with a unit (10mm, 3/8in), in place of
    /// other strips
    #[arg(long, value_name = "LENGTH", value_parser = size_mm)]
    allowance: Option<f64>,
    /// The face of the sheet that the curves lie on: the pattern then is that of the neutral fibre
    /// [default: as the design says, or of the surface through the curves]
    #[arg(long, value_enum, ignore_case = true, value_name = "FACE")]
    dimensions: Option<DimensionsArg>,
    /// How thick the sheet is, where the dimensions are those of a face [default: as the design
    /// says, or its material]
    #[arg(long, value_name = "LENGTH", value_parser = thickness_mm)]
    thickness: Option<f64>,
    /// How many bend lines a bend is divided into: a number for each part (24), the largest angle
    /// of a step (5deg), the farthest that the smooth surface lies from flat steps (chord=0.5mm) or
    /// the largest width of a step (pitch=20mm) [default: as the design says, or steps of 5°, 24
    /// lines at the most]
    #[arg(long, value_name = "HOW", value_parser = sheetwright_files::bend_rule)]
    bends: Option<BendRule>,
    /// How bend lines are drawn [default: as the design says, or ticks]
    #[arg(long, value_enum, ignore_case = true, value_name = "HOW")]
    bend_marks: Option<BendMarksArg>,
    #[command(flatten)]
    vary: VaryArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum DimensionsArg {
    /// The inner one of its bends, as duct shops give clear sizes
    Inside,
    /// The middle of the sheet
    Mean,
    /// The outer one
    Outside,
}

fn thickness_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::size_mm(given).filter(|mm| *mm <= 1000.0);
    mm.ok_or_else(|| "give a thickness above 0 and up to 1 m, such as 1mm or 1/16in".to_owned())
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum BendMarksArg {
    /// A tick at each end to engrave; the line and its text as notes
    Ticks,
    /// The whole line and its text, to engrave
    Lines,
    /// As ticks, and all rulings as notes
    Rulings,
    /// Not at all; folds alone
    None,
}

/// Limits and goal of moving curves so that panels bend better. In a design without `vary`, any of
/// these options lets all curves move.
#[derive(Debug, Args)]
#[command(next_help_heading = "Moving the boundary so that it bends better")]
struct VaryArgs {
    /// Move the curves as little as possible so that no warp angle is above this one, in degrees
    #[arg(long, value_name = "DEG", value_parser = warp_deg)]
    vary_warp: Option<f64>,
    /// Move the curves as little as possible so that the sheet stretches by no more than this share
    /// of what it takes (80%)
    #[arg(long, value_name = "SHARE", value_parser = strain_share, conflicts_with = "vary_warp")]
    vary_strain: Option<f64>,
    /// The longest way that a sample may move: in mm, or with a unit (2mm, 1/8in)
    #[arg(long, value_name = "LENGTH", value_parser = distance_mm)]
    vary_limit: Option<f64>,
    /// The most that the ways of all samples may add up to
    #[arg(long, value_name = "LENGTH", value_parser = distance_mm)]
    vary_budget: Option<f64>,
}

fn warp_deg(given: &str) -> Result<f64, String> {
    let deg = sheetwright_files::warp_deg(given);
    deg.ok_or_else(|| "give an angle above 0 and up to 90".to_owned())
}

fn strain_share(given: &str) -> Result<f64, String> {
    let share = sheetwright_files::strain_share(given);
    share.ok_or_else(|| "give a share from 5% to 100%".to_owned())
}

fn size_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::size_mm(given);
    mm.ok_or_else(|| "give a length above 0, such as 300, 300mm or 12in".to_owned())
}

fn tolerance_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::size_mm(given).filter(|mm| *mm <= MOST_TOLERANCE_MM);
    mm.ok_or_else(|| "give a tolerance above 0 and up to 1 m, such as 0.05mm or 1/64in".to_owned())
}

fn scale(given: &str) -> Result<f64, String> {
    let factor = given.parse().ok().filter(|factor| (1e-6..=1e6).contains(factor));
    factor.ok_or_else(|| "give a factor from 0.000001 to 1000000, such as 2 or 0.5".to_owned())
}

fn distance_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::distance_mm(given);
    mm.ok_or_else(|| "give a length of 0 or more, such as 2, 2mm or 1/8in".to_owned())
}

impl SourceArgs {
    pub(crate) fn judging(&self) -> Judging {
        match self.verdict {
            VerdictArg::Quick => Judging::Quick,
            VerdictArg::Exact => Judging::Exact,
        }
    }

    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            samples: self.samples,
            tolerance_mm: self.tolerance,
            fold: self.fold,
            effort: self.effort,
            method: self.method.map(|method| match method {
                MethodArg::Optimal => PanelMethod::Optimal,
                MethodArg::Bridge => PanelMethod::Bridge,
                MethodArg::Rails => PanelMethod::Rails,
            }),
            which: self.side.map(|side| match side {
                SideArg::Cheapest => WhichSurface::Cheapest,
                SideArg::Other => WhichSurface::Other,
            }),
            plane: self.plane.map(|plane| match plane {
                PlaneArg::Auto => PlaneChoice::Auto,
                PlaneArg::None => PlaneChoice::None,
            }),
            units: self.units,
            material: self.material.clone(),
            vary: VarySettings {
                limit_mm: self.vary.vary_limit,
                budget_mm: self.vary.vary_budget,
                warp_deg: self.vary.vary_warp,
                strain: self.vary.vary_strain,
            },
            mesh: MeshSettings::default(),
            trade: self.trade.clone(),
            allowance_mm: self.allowance,
            dimensions: self.dimensions.map(|face| match face {
                DimensionsArg::Inside => Dimensions::Inside,
                DimensionsArg::Mean => Dimensions::Mean,
                DimensionsArg::Outside => Dimensions::Outside,
            }),
            thickness_mm: self.thickness,
            bends: BendSettings {
                rule: self.bends,
                marks: self.bend_marks.map(|marks| match marks {
                    BendMarksArg::Ticks => BendMarks::Ticks,
                    BendMarksArg::Lines => BendMarks::Lines,
                    BendMarksArg::Rulings => BendMarks::Rulings,
                    BendMarksArg::None => BendMarks::None,
                }),
            },
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum VerdictArg {
    /// A formula: true within a factor of two, for many panels
    Quick,
    /// An elastic sheet, computed for each panel
    Exact,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum SideArg {
    /// The one with the lower price
    Cheapest,
    /// The other one
    Other,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PlaneArg {
    /// Over the best-fit plane, if the boundary projects onto it without crossing itself
    Auto,
    /// Free in space: for sheets that wrap round or hang over
    None,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum StdinFormat {
    /// A curve table
    Csv,
    /// A design
    Json,
    /// A mesh, Wavefront OBJ
    Obj,
    /// A mesh, STL
    Stl,
    /// A mesh, PLY
    Ply,
    /// A mesh, glTF binary
    Glb,
}

impl StdinFormat {
    pub(crate) fn format(self) -> InputFormat {
        match self {
            Self::Csv => InputFormat::Table,
            Self::Json => InputFormat::Design,
            Self::Obj => InputFormat::Mesh(MeshFormat::Obj),
            Self::Stl => InputFormat::Mesh(MeshFormat::Stl),
            Self::Ply => InputFormat::Mesh(MeshFormat::Ply),
            Self::Glb => InputFormat::Mesh(MeshFormat::Glb),
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum MethodArg {
    /// All triangulations: finds the best surface
    Optimal,
    /// Triangulations in which every triangle has an edge of the boundary, for comparison: mostly
    /// slower than optimal
    Bridge,
    /// Triangulations in which every rung joins the two rails, for panels with rails
    Rails,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SkinArg {
    /// The larger skin, which lies outside where the plate bends one way
    Outer,
    /// The smaller skin
    Inner,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum AimArg {
    /// The mean length error
    Mean,
    /// The largest length error
    Max,
    /// The length error of the seams and the border, which stay exact
    Seams,
}

impl AimArg {
    fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Max => "max",
            Self::Seams => "seams",
        }
    }
}

/// Any name; completions and help show the known ones. An unknown name is refused later, with the
/// nearest known one, as everywhere.
#[derive(Clone)]
struct Name {
    /// The known ones.
    known: fn() -> Vec<PossibleValue>,
}

fn template_values() -> Vec<PossibleValue> {
    catalogue().iter().map(|one| PossibleValue::new(one.name).help(one.title)).collect()
}

/// The help of `--material`: a line of names by group, not one for each.
fn material_help() -> String {
    format!(
        "The material of the sheet, in place of the design's: one of the design's own materials, \
         or one of the catalogue, which docs/materials.md describes: {}",
        catalogue_names()
    )
}

fn material_values() -> Vec<PossibleValue> {
    let known = known_materials(&[]).into_iter();
    known.map(|one| PossibleValue::new(one.name.as_str()).help(one.title.as_str())).collect()
}

impl TypedValueParser for Name {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        StringValueParser::new().parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.known)().into_iter()))
    }
}

fn format_parser() -> impl TypedValueParser<Value = Format> {
    let names = Format::ALL.map(Format::name);
    PossibleValuesParser::new(names)
        .try_map(|name| Format::from_name(&name.to_lowercase()).ok_or("this format is not known"))
}

fn paper_parser() -> impl TypedValueParser<Value = Paper> {
    let names = Paper::ALL.map(Paper::name);
    PossibleValuesParser::new(names)
        .try_map(|name| Paper::from_name(&name.to_lowercase()).ok_or("this paper is not known"))
}

fn units_parser() -> impl TypedValueParser<Value = Units> {
    let names = Units::ALL.map(Units::name);
    PossibleValuesParser::new(names)
        .try_map(|name| Units::from_name(&name.to_lowercase()).ok_or("this unit is not known"))
}
