//! What parts are cut from.

use super::values::distance_mm;
use clap::{Args, ValueEnum};
use sheetwright::design::{DivideJoint, StockSheet};
use sheetwright_files::SheetSettings;

/// What parts are cut from, in place of what the design says.
#[derive(Debug, Args)]
#[command(next_help_heading = "Sheets")]
pub(crate) struct SheetArgs {
    /// A sheet to lay parts out on: 1220x2440mm, 4x8ft, roll:1370mm, or 3x1220x2440mm where there
    /// are only three; several may be given
    #[arg(long, value_name = "SIZE", value_parser = sheetwright_files::stock_sheet)]
    sheet: Vec<StockSheet>,
    /// The least distance between two parts on a sheet [default: as the design says, or 3 mm]
    #[arg(long, value_name = "LENGTH", value_parser = distance_mm)]
    gap: Option<f64>,
    /// The least distance of a part from the edge of its sheet [default: as the design says, or
    /// 5 mm]
    #[arg(long, value_name = "LENGTH", value_parser = distance_mm)]
    margin: Option<f64>,
    /// The width that a cut takes away: outlines move out by half of it, and holes in [default: as
    /// the design says, or 0]
    #[arg(long, value_name = "LENGTH", value_parser = distance_mm)]
    kerf: Option<f64>,
    /// Lay equal parts side by side, a kerf apart, so that one cut parts two [default: as the
    /// design says]
    #[arg(long)]
    common_lines: bool,
    /// Whether all sheets are drawn beside each other, in sheets.svg and sheets.dxf, or each has
    /// files of its own [default: as the design says, or all]
    #[arg(long, value_enum, ignore_case = true, value_name = "FILES")]
    sheet_files: Option<FilesArg>,
    /// What joins the pieces of a part that is larger than every sheet and so is divided [default:
    /// as the design says, or none: it is not]
    #[arg(long, value_enum, ignore_case = true, value_name = "JOINT")]
    divide: Option<DivideArg>,
}

/// Which files sheets are drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FilesArg {
    /// One for all of them
    All,
    /// One for each: sheet-1.svg, sheet-1.dxf, sheet-2.svg, …
    Each,
}

/// What joins the pieces of a divided part.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum DivideArg {
    /// Both pieces are planed to a taper of 8 : 1 and glued over one another
    Scarf,
    /// Both pieces meet, with a strap behind them
    Butt,
    /// Knobs of each piece in sockets of the other
    Puzzle,
    /// Both pieces lie over one another
    Overlap,
    /// It is not divided
    None,
}

impl DivideArg {
    fn joint(self) -> Option<DivideJoint> {
        match self {
            Self::Scarf => Some(DivideJoint::Scarf),
            Self::Butt => Some(DivideJoint::Butt),
            Self::Puzzle => Some(DivideJoint::Puzzle),
            Self::Overlap => Some(DivideJoint::Overlap),
            Self::None => None,
        }
    }
}

impl SheetArgs {
    /// `--sheet`, if it is given.
    pub(super) fn sheet_option(&self) -> Option<&'static str> {
        (!self.sheet.is_empty()).then_some("--sheet")
    }

    /// What is set, with the effort of the whole call.
    pub(crate) fn settings(&self, effort: Option<f64>) -> SheetSettings {
        SheetSettings {
            sheets: self.sheet.clone(),
            gap_mm: self.gap,
            margin_mm: self.margin,
            kerf_mm: self.kerf,
            common_lines: self.common_lines.then_some(true),
            file_each: self.sheet_files.map(|files| files == FilesArg::Each),
            effort,
            divide: self.divide.map(DivideArg::joint),
        }
    }
}
