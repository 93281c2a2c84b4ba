//! Parts on their sheets, as files and reports list them.

use crate::stock::sheet_title;
use crate::wording::millimetres;
use sheetwright::design::SheetForm;
use sheetwright::make::{Made, Nested};
use sheetwright::math::{Point2, to_deg};
use sheetwright::nest::Placement;
use sheetwright::predicate::{Box2, signed_area_doubled};
use std::f64::consts::TAU;

/// What there is to say of a sheet.
pub(crate) struct SheetRow {
    /// Its kind, by its number in the stock.
    pub(crate) kind: usize,
    /// What its kind is called.
    pub(crate) title: String,
    /// Whether it is a roll.
    pub(crate) is_roll: bool,
    /// Whether that is its size.
    pub(crate) is_called_by_size: bool,
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
    /// What it is called, with its size where that says something else.
    pub(crate) fn named(&self) -> String {
        let [width, height] = self.size.map(millimetres);
        match self.is_called_by_size {
            true => self.title.clone(),
            false => format!("{}, {width} × {height}", self.title),
        }
    }

    /// The share of it that is used.
    pub(crate) fn share(&self) -> f64 {
        self.used_mm2 / self.area_mm2.max(f64::MIN_POSITIVE)
    }
}

/// A row for each sheet, in order.
pub(crate) fn sheet_rows(made: &Made, nested: &Nested) -> Vec<SheetRow> {
    let Some(stock) = &made.stock else { return Vec::new() };
    let mut on: Vec<Vec<LaidPart>> = nested.nest.sheets.iter().map(|_| Vec::new()).collect();
    for part in laid(nested) {
        on[part.placement.sheet].push(part);
    }
    let row = |(n, used): (usize, &sheetwright::nest::UsedSheet)| {
        let kind = &stock.sheets[used.kind];
        let [width, height] = used.size;
        let (area_mm2, times) = match &kind.form {
            SheetForm::Rectangle { .. } => (width * height, 1.0),
            // A roll costs by the metre.
            SheetForm::Roll { .. } => (width * height, width / 1000.0),
            SheetForm::Outline { points } => (0.5 * signed_area_doubled(points), 1.0),
        };
        let name = |it: &LaidPart| (made.parts[it.part].name.clone(), it.middle, it.width_mm);
        SheetRow {
            kind: used.kind,
            title: sheet_title(kind),
            is_roll: matches!(kind.form, SheetForm::Roll { .. }),
            is_called_by_size: kind.name.is_none()
                && matches!(kind.form, SheetForm::Rectangle { .. }),
            size: used.size,
            area_mm2,
            used_mm2: used.used_mm2,
            parts: on[n].len(),
            cost: kind.cost.map(|cost| cost * times),
            names: on[n].iter().map(name).collect(),
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
    let mut words = match rows.len() {
        0 => "No part is on a sheet".to_owned(),
        sheets => format!(
            "{} on {}, of which {share:.0} % is used",
            several(parts, "part"),
            several(sheets, "sheet")
        ),
    };
    let without = without_sheet(made, nested);
    if !without.is_empty() {
        words = format!("{words}. {without}");
    }
    Some(words)
}

/// What so much of the sheet weighs, kg, where its thickness and its density are known.
pub(crate) fn weight_kg(made: &Made, area_mm2: f64) -> Option<f64> {
    let density = made.material.as_ref()?.density_kg_per_m3.as_ref()?.value;
    Some(area_mm2 * made.thickness_mm? * 1e-9 * density)
}

/// Which parts lie on no sheet, in words; empty where all do.
pub(crate) fn without_sheet(made: &Made, nested: &Nested) -> String {
    let names = |parts: &[usize]| pattern_names(made, nested, parts).join(", ");
    let mut words = Vec::new();
    if !nested.nest.too_large.is_empty() {
        words.push(format!("Larger than every sheet: {}.", names(&nested.nest.too_large)));
    }
    if !nested.nest.left_over.is_empty() {
        words.push(format!("No sheet is left for: {}.", names(&nested.nest.left_over)));
    }
    words.join(" ")
}

/// The names of the patterns of some parts of the layout, each once.
pub(crate) fn pattern_names<'a>(made: &'a Made, nested: &Nested, parts: &[usize]) -> Vec<&'a str> {
    // Those that are turned over come after the others of their pattern.
    let mut items: Vec<usize> = parts.iter().map(|&part| nested.items[part].item).collect();
    items.dedup();
    items.into_iter().map(|item| &made.parts[nested.list[item].first()].name[..]).collect()
}

/// A part where it lies.
pub(crate) struct LaidPart {
    /// The pattern, by its number in [`Nested::list`].
    pub(crate) item: usize,
    /// The part, by its number in the design.
    pub(crate) part: usize,
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

/// All parts that are laid out, pattern after pattern.
pub(crate) fn laid(nested: &Nested) -> Vec<LaidPart> {
    let of = |(placement, &part): (&Placement, &usize)| {
        let item = nested.item(placement);
        let points = nested.list[item].piece.outline().iter().map(|&p| placement.lay(p));
        let around = Box2::of_points(points);
        let (low, high) = around.map_or_else(Default::default, |it| (it.min, it.max));
        LaidPart {
            item,
            part,
            placement: *placement,
            middle: low.lerp(high, 0.5),
            width_mm: high.x - low.x,
        }
    };
    nested.nest.placements.iter().zip(&nested.parts).map(of).collect()
}
