//! Sheets as they stand in a file: what serde reads and writes, and the JSON Schema.

use crate::design_json::trims::LengthFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What parts are cut from, and how they may lie on it.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Sheets")]
pub(in crate::design_json) struct SheetsFile {
    /// The sheets there are. Default: none; parts are not laid out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) sizes: Vec<SheetFile>,
    /// The least distance between two parts. Default: 3 mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) gap: Option<LengthFile>,
    /// The least distance of a part from the edge of its sheet. Default: 5 mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) margin: Option<LengthFile>,
    /// The width that a cut takes away. Default: 0, where the machine sees to it itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) kerf: Option<LengthFile>,
    /// How parts may be turned: `free`, `grain` (along the grain, either way round), `one-way`
    /// (along the grain, all alike) or a step in degrees. Default: free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) turn: Option<TurnFile>,
    /// By how many degrees the grain of a part may lie off that of its sheet. Default: 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 45))]
    pub(super) grain_tolerance_deg: Option<f64>,
    /// Whether parts may be turned over: both faces of the sheet are alike. Default: false.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) turn_over: bool,
    /// Groups of panels whose parts lie on one sheet together, by name. Default: none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) together: Vec<Vec<String>>,
    /// Whether equal parts lie side by side, a kerf apart, so that one cut parts two. `gap` then
    /// is left out. Default: false.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) common_lines: bool,
    /// Whether `all` sheets are drawn beside each other in one file, or `each` has its own.
    /// Default: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) files: Option<FilesWord>,
    /// How much work the search may do, as a multiple of the default. Default: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.001, max = 1000))]
    pub(super) effort: Option<f64>,
    /// How parts that are larger than every sheet are divided. Default: they are not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) divide: Option<DivideFile>,
}

/// How parts that are larger than every sheet are divided.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Divide")]
pub(super) struct DivideFile {
    /// What joins the pieces.
    pub(super) joint: DivideWord,
    /// How long the taper of a scarf is, in thicknesses. Default: 8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 100))]
    pub(super) ratio: Option<f64>,
    /// How far pieces of an overlap lie over one another. Default: 30 mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) overlap: Option<LengthFile>,
}

/// What joins the pieces of a divided part, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum DivideWord {
    /// Both pieces are planed to a taper and glued over one another.
    Scarf,
    /// Both pieces meet, with a strap behind them.
    Butt,
    /// Knobs of each piece in sockets of the other.
    Puzzle,
    /// Both pieces lie over one another.
    Overlap,
    /// Parts are not divided.
    None,
}

/// Which files sheets are drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum FilesWord {
    /// One for all of them.
    All,
    /// One for each.
    Each,
}

/// A kind of sheet: one of `size`, `roll` and `outline` says its form.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "StockSheet")]
pub(super) struct SheetFile {
    /// Its width and height; the grain runs along the longer side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) size: Option<[LengthFile; 2]>,
    /// The width of a roll, which is as long as it takes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) roll: Option<LengthFile>,
    /// The corners of an offcut, in the units of the design; the grain runs along x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) outline: Option<Vec<[f64; 2]>>,
    /// Its name. Default: its size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) name: Option<String>,
    /// How many there are. Default: as many as it takes; of an offcut, 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub(super) count: Option<usize>,
    /// What one costs, or a metre of a roll. Default: not known; the fewest sheets are best.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub(super) cost: Option<f64>,
}

/// How parts may be turned.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum TurnFile {
    /// By multiples of this angle, degrees.
    Step(f64),
    /// In words.
    Word(TurnWord),
}

/// How parts may be turned, in words.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum TurnWord {
    /// By any angle.
    Free,
    /// Along the grain, either way round.
    Grain,
    /// Along the grain, all alike.
    OneWay,
}
