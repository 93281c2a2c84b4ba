//! Which files are written, and how.

use super::values::size_mm;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use sheetwright::design::Design;
use sheetwright_files::{
    BrakeSettings, DxfRelease, Format, MaxSheets, OffsetOptions, OutputOptions, Paper, PdfOptions,
    Preset,
};

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
    /// The first of its options that is given.
    pub(super) fn option(&self) -> Option<&'static str> {
        let all = [
            ("--die", self.die.is_some()),
            ("--brake-length", self.brake_length.is_some()),
            ("--rolls", self.rolls),
        ];
        all.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    pub(super) fn settings(&self) -> BrakeSettings {
        let Self { die, brake_length, rolls } = *self;
        BrakeSettings { die_mm: die, length_mm: brake_length, rolls }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ReportArg {
    /// A table of all panels with thumbnails, and the findings
    Short,
    /// Everything of every panel
    Long,
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
    /// Cut lines in DXF files have arcs, within this distance of the pattern, in mm or with a unit
    /// (0.05mm) [default: as the design says, or straight sides]
    #[arg(long, value_name = "TOLERANCE", value_parser = arcs_mm)]
    arcs: Option<f64>,
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
    /// The first option for `offsets.csv` that is given.
    pub(super) fn offsets_option(&self) -> Option<&'static str> {
        let all = [("--stations", self.stations.is_some()), ("--feet", self.feet)];
        all.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// The options for a design, which may say how its files are written.
    pub(crate) fn options(&self, design: &Design) -> OutputOptions {
        let of_design = OutputOptions::with_preset(design, self.preset);
        OutputOptions {
            dxf: self.dxf.or(of_design.dxf),
            arcs_mm: self.arcs.or(of_design.arcs_mm),
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

fn arcs_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::distance_mm(given).filter(|mm| (0.0001..=10.0).contains(mm));
    mm.ok_or_else(|| "give a length of 0.0001 to 10 mm, such as 0.05mm or 0.002in".to_owned())
}

fn pitch_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::distance_mm(given).filter(|&mm| mm >= 0.01);
    mm.ok_or_else(|| "give a length of at least 0.01 mm, such as 100, 100mm or 6in".to_owned())
}

/// How patterns are laid out on paper.
#[derive(Debug, Args)]
pub(crate) struct PdfArgs {
    /// What the PDF is printed on: a4, a3, a2, a1, a0, letter, legal, tabloid; roll:914mm, pages as
    /// wide as a roll and as long as need be; projector, all parts beside one another on one page
    /// with a grid, or projector:each, a page for every part
    #[arg(long, value_name = "PAPER", default_value = "a4", value_parser = Paper::parse)]
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

pub(super) fn format_parser() -> impl TypedValueParser<Value = Format> {
    let names = Format::ALL.map(Format::name);
    PossibleValuesParser::new(names)
        .try_map(|name| Format::from_name(&name.to_lowercase()).ok_or("this format is not known"))
}
