//! Parts on their sheets, as files and reports list them.

use crate::stock::sheet_title;
use sheetwright::design::SheetForm;
use sheetwright::make::{CutItem, Made, Nested};
use sheetwright::math::{Point2, to_deg};
use sheetwright::nest::Placement;
use sheetwright::predicate::{Box2, signed_area_doubled};
use std::f64::consts::TAU;

/// What there is to say of a sheet.
pub(crate) struct SheetRow {
    /// What its kind is called.
    pub(crate) title: String,
    /// Its width and height, mm.
    pub(crate) size: [f64; 2],
    pub(crate) area_mm2: f64,
    /// The area of the parts on it, mm².
    pub(crate) used_mm2: f64,
    /// How many parts lie on it.
    pub(crate) parts: usize,
    /// What it costs, if that is known.
    pub(crate) cost: Option<f64>,
    /// The names of its parts, each with the middle of its box and its width, mm.
    pub(crate) names: Vec<(String, Point2, f64)>,
}

impl SheetRow {
    /// The share of it that is used.
    pub(crate) fn share(&self) -> f64 {
        self.used_mm2 / self.area_mm2.max(f64::MIN_POSITIVE)
    }
}

/// A row for each sheet, in order.
pub(crate) fn sheet_rows(made: &Made, nested: &Nested) -> Vec<SheetRow> {
    let Some(stock) = &made.stock else { return Vec::new() };
    let list = made.cut_list();
    let laid = laid(made, nested, &list);
    let row = |(n, used): (usize, &sheetwright::nest::UsedSheet)| {
        let kind = &stock.sheets[used.kind];
        let [width, height] = used.size;
        let (area_mm2, times) = match &kind.form {
            SheetForm::Rectangle { .. } => (width * height, 1.0),
            // A roll costs by the metre.
            SheetForm::Roll { .. } => (width * height, width / 1000.0),
            SheetForm::Outline { points } => (0.5 * signed_area_doubled(points), 1.0),
        };
        let on_it: Vec<&LaidPart> = laid.iter().filter(|it| it.placement.sheet == n).collect();
        let name = |it: &&LaidPart| (it.name.clone(), it.middle, it.width_mm);
        SheetRow {
            title: sheet_title(kind),
            size: used.size,
            area_mm2,
            used_mm2: used.used_mm2,
            parts: on_it.len(),
            cost: kind.cost.map(|cost| cost * times),
            names: on_it.iter().map(name).collect(),
        }
    };
    nested.nest.sheets.iter().enumerate().map(row).collect()
}

/// How parts lie on their sheets, in a sentence or two; `None` where they are not laid out.
pub fn sheets_sentence(made: &Made) -> Option<String> {
    let nested = made.nested.as_ref()?;
    let rows = sheet_rows(made, nested);
    let parts: usize = rows.iter().map(|row| row.parts).sum();
    let used: f64 = rows.iter().map(|row| row.used_mm2).sum();
    let whole: f64 = rows.iter().map(|row| row.area_mm2).sum();
    let share = 100.0 * used / whole.max(f64::MIN_POSITIVE);
    let several = |count: usize, one: &str| {
        if count == 1 { format!("1 {one}") } else { format!("{count} {one}s") }
    };
    let mut words = format!(
        "{} on {}, of which {share:.0} % is used",
        several(parts, "part"),
        several(rows.len(), "sheet")
    );
    let without = without_sheet(made, nested);
    if !without.is_empty() {
        words = format!("{words}. {without}");
    }
    Some(words)
}

/// Which parts lie on no sheet, in words; empty where all do.
pub(crate) fn without_sheet(made: &Made, nested: &Nested) -> String {
    let list = made.cut_list();
    let names = |parts: &[usize]| -> String {
        let name = |&part: &usize| &made.parts[list[nested.items[part].item].first()].name[..];
        parts.iter().map(name).collect::<Vec<_>>().join(", ")
    };
    let mut words = Vec::new();
    if !nested.nest.too_large.is_empty() {
        words.push(format!("Larger than every sheet: {}.", names(&nested.nest.too_large)));
    }
    if !nested.nest.left_over.is_empty() {
        words.push(format!("No sheet is left for: {}.", names(&nested.nest.left_over)));
    }
    words.join(" ")
}

/// A part where it lies.
pub(crate) struct LaidPart {
    /// The pattern, by its number in the list to cut.
    pub(crate) item: usize,
    /// The name of the part.
    pub(crate) name: String,
    pub(crate) placement: Placement,
    /// The middle of its box on the sheet, mm.
    pub(crate) middle: Point2,
    /// The width of that box, mm.
    pub(crate) width_mm: f64,
}

impl LaidPart {
    /// By how much it is turned, degrees from 0 to 360.
    pub(crate) fn turn_deg(&self) -> f64 {
        let turns = self.placement.turn / TAU;
        let degrees = to_deg((turns - turns.floor()) * TAU);
        // What rounding leaves of a whole turn is none.
        if degrees > 360.0 - 1e-6 { 0.0 } else { degrees }
    }
}

/// All parts that are laid out; `list` is [`Made::cut_list`].
pub(crate) fn laid(made: &Made, nested: &Nested, list: &[CutItem]) -> Vec<LaidPart> {
    let of = |placement: &Placement| {
        let item = nested.item(placement);
        let points = list[item].piece.outline().iter().map(|&p| placement.lay(p));
        let around = Box2::of_points(points);
        let (low, high) = around.map_or_else(Default::default, |it| (it.min, it.max));
        LaidPart {
            item,
            name: made.parts[nested.instance(made, list, placement)].name.clone(),
            placement: *placement,
            middle: low.lerp(high, 0.5),
            width_mm: high.x - low.x,
        }
    };
    nested.nest.placements.iter().map(of).collect()
}
