//! The field `sheets` of `report.json`: the parts on their sheets.

use crate::sheets::{SheetRow, laid, pattern_names, sheet_rows};
use schemars::JsonSchema;
use serde::Serialize;
use sheetwright::make::Made;

/// Parts on sheets.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Sheets")]
pub(super) struct SheetsReport {
    /// Each sheet, in order.
    list: Vec<SheetReport>,
    /// The names of the parts that are larger than every sheet.
    too_large: Vec<String>,
    /// The names of the patterns of which some parts have no sheet.
    left_over: Vec<String>,
    /// Whether the layout was proved: no overlap, every gap and margin kept, every part laid once.
    proved: bool,
}

/// One sheet.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Sheet")]
struct SheetReport {
    /// What its kind is called: its name, or its size.
    kind: String,
    /// Its width; of a roll, the length that is used.
    width_mm: f64,
    /// Its height; of a roll, its width.
    height_mm: f64,
    /// Its area.
    area_mm2: f64,
    /// The area of the parts on it.
    used_mm2: f64,
    /// What it costs; null where that is not known.
    cost: Option<f64>,
    /// The parts on it.
    parts: Vec<LaidReport>,
}

/// A part on a sheet.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Part on a sheet")]
struct LaidReport {
    /// Its name.
    name: String,
    /// The name of the pattern that it is cut from.
    pattern: String,
    /// The middle of its box, from the lower left corner of the sheet.
    x_mm: f64,
    /// Likewise.
    y_mm: f64,
    /// By how much it is turned, counter-clockwise, degrees from 0 to 360.
    turn_deg: f64,
    /// Whether it is turned over, top to bottom, before that.
    turned_over: bool,
}

/// The sheets of a made design, if its parts are laid out.
pub(super) fn sheets_report(made: &Made) -> Option<SheetsReport> {
    let nested = made.nested.as_ref()?;
    let name = |part: usize| made.parts[part].name.clone();
    let mut parts: Vec<Vec<LaidReport>> = nested.nest.sheets.iter().map(|_| Vec::new()).collect();
    for it in laid(nested) {
        parts[it.placement.sheet].push(LaidReport {
            name: name(it.part),
            pattern: name(nested.list[it.item].first()),
            x_mm: it.middle.x,
            y_mm: it.middle.y,
            turn_deg: it.turn_deg(),
            turned_over: it.placement.is_over,
        });
    }
    let sheet = |(row, parts): (SheetRow, Vec<LaidReport>)| SheetReport {
        kind: row.title,
        width_mm: row.size[0],
        height_mm: row.size[1],
        area_mm2: row.area_mm2,
        used_mm2: row.used_mm2,
        cost: row.cost,
        parts,
    };
    let names = |parts: &[usize]| {
        pattern_names(made, nested, parts).into_iter().map(str::to_owned).collect()
    };
    Some(SheetsReport {
        list: sheet_rows(made, nested).into_iter().zip(parts).map(sheet).collect(),
        too_large: names(&nested.nest.too_large),
        left_over: names(&nested.nest.left_over),
        proved: nested.is_proved,
    })
}
