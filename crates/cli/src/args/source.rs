//! The input, and the options that replace its values.

use super::sheets::SheetArgs;
use super::values::{Name, distance_mm, size_mm};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use sheetwright::boundary::PlaneChoice;
use sheetwright::design::{BendMarks, BendRule, Dimensions, PanelMethod};
use sheetwright::make::Judging;
use sheetwright::triangulate::WhichSurface;
use sheetwright_files::{
    BendSettings, DrawingFormat, InputFormat, MOST_TOLERANCE_MM, MeshFormat, MeshSettings,
    ReadOptions, Units, VarySettings, catalogue_names, known_materials, trade_names,
};
use std::path::PathBuf;

/// The input of a command that takes one.
#[derive(Debug, Args)]
pub(crate) struct InputArgs {
    /// A design (.sheet.json), a curve table (.csv), a table of offsets (.csv, .tsv, .txt, .xlsx,
    /// .ods), a drawing (.svg, .dxf), a mesh (.obj, .stl, .ply, .glb), or - for standard input
    #[arg(value_name = "INPUT")]
    pub(crate) input: PathBuf,
    #[command(flatten)]
    pub(crate) form: FormArgs,
}

/// What the name of an input does not tell.
#[derive(Debug, Args)]
pub(crate) struct FormArgs {
    /// The format of standard input [default: told from its content]
    #[arg(long, value_enum, ignore_case = true, value_name = "FORMAT")]
    pub(crate) from: Option<StdinFormat>,
    /// A second file of a table of offsets: its half-breadths, where INPUT has its heights
    #[arg(long, value_name = "FILE")]
    pub(crate) with: Option<PathBuf>,
}

/// The options that replace the values of an input.
#[derive(Debug, Args)]
pub(crate) struct SourceArgs {
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
    /// how far it may be from the best possible; with sheets, the work of laying parts out, too
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    effort: Option<f64>,
    /// What the verdict comes from [default: exact; auto in a batch]
    #[arg(long, value_enum, ignore_case = true, value_name = "HOW")]
    verdict: Option<VerdictArg>,
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
    /// The edges slide along the boundary while the sheet is bent, as a plank does that is pulled
    /// onto its stringers before it is fastened, and nothing holds the straight ends between rails;
    /// else every point of an edge is held
    #[arg(long)]
    slide: bool,
    /// The unit of a curve table, a drawing or a mesh [default: mm; of a drawing, the one that it
    /// states; of a mesh that would be smaller than 5 mm: m]; a design states its own
    #[arg(long, value_name = "UNITS", ignore_case = true, value_parser = units_parser())]
    pub(crate) units: Option<Units>,
    /// The curves or layers of a drawing that are rails, by name, separated by commas; a panel
    /// comes between each and the next [default: those named `rail…`, or two open curves alone]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    rails: Vec<String>,
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
    /// The inner radius of the tool that makes sharp folds, whose bend allowance the pattern has
    /// where the dimensions are those of a face [default: as the design says, or the smallest of
    /// the material, or the thickness]
    #[arg(long, value_name = "LENGTH", value_parser = bend_radius_mm)]
    bend_radius: Option<f64>,
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
    sheets: SheetArgs,
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

fn bend_radius_mm(given: &str) -> Result<f64, String> {
    // No radius needs no unit, and is no size.
    let mm = if given.trim() == "0" { Some(0.0) } else { sheetwright_files::size_mm(given) };
    let mm = mm.filter(|mm| *mm <= 1000.0);
    mm.ok_or_else(|| "give a radius of 0 to 1 m, such as 2mm or 1/16in".to_owned())
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

fn tolerance_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::size_mm(given).filter(|mm| *mm <= MOST_TOLERANCE_MM);
    mm.ok_or_else(|| "give a tolerance above 0 and up to 1 m, such as 0.05mm or 1/64in".to_owned())
}

fn scale(given: &str) -> Result<f64, String> {
    let factor = given.parse().ok().filter(|factor| (1e-6..=1e6).contains(factor));
    factor.ok_or_else(|| "give a factor from 0.000001 to 1000000, such as 2 or 0.5".to_owned())
}

impl SourceArgs {
    /// `--sheet`, if it is given.
    pub(super) fn sheet_option(&self) -> Option<&'static str> {
        self.sheets.sheet_option()
    }

    /// The first option for the thickness of a face's sheet that is given.
    pub(super) fn thickness_option(&self) -> Option<&'static str> {
        let all = [
            ("--thickness", self.thickness.is_some()),
            ("--bend-radius", self.bend_radius.is_some()),
        ];
        all.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// What verdicts come from; where the call does not say it, `usual`.
    pub(crate) fn judging(&self, usual: Judging) -> Judging {
        match self.verdict {
            None => usual,
            Some(VerdictArg::Quick) => Judging::Quick,
            Some(VerdictArg::Auto) => Judging::Auto,
            Some(VerdictArg::Exact) => Judging::Exact,
        }
    }

    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            second_table: None,
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
            slides: self.slide.then_some(true),
            units: self.units,
            rails: self.rails.clone(),
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
            bend_radius_mm: self.bend_radius,
            sheets: self.sheets.settings(self.effort),
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
    /// The formula, and an elastic sheet where that factor decides whether the sheet takes it
    Auto,
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
    /// A drawing, SVG
    Svg,
    /// A drawing, DXF
    Dxf,
    /// A mesh or lines, Wavefront OBJ
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
            Self::Svg => InputFormat::Drawing(DrawingFormat::Svg),
            Self::Dxf => InputFormat::Drawing(DrawingFormat::Dxf),
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

fn units_parser() -> impl TypedValueParser<Value = Units> {
    let names = Units::ALL.map(Units::name);
    PossibleValuesParser::new(names)
        .try_map(|name| Units::from_name(&name.to_lowercase()).ok_or("this unit is not known"))
}
