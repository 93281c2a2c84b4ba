//! The field `sheets`: what parts are cut from, from a design's file and back.

mod form;

pub(super) use form::SheetsFile;

use super::source::Source;
use super::trims::{LengthFile, Problem, Reader, problem};
use crate::json::json;
use crate::names::shown;
use crate::reading::{EFFORTS, GAP_AND_COMMON_LINES, InputError, LEAVE_THE_GAP_OUT};
use crate::stock::{MOST_OF_A_KIND, MOST_SHEET_MM};
use crate::table::in_range_mm;
use crate::units::Units;
use form::{DivideFile, DivideWord, FilesWord, SheetFile, TurnFile, TurnWord};
use sheetwright::design::{
    DesignPanel, Divide, DivideJoint, LEAST_EFFORT, MOST_EFFORT, SheetForm, Stock, StockSheet, Turn,
};
use sheetwright::math::{Point2, from_deg, to_deg};
use sheetwright::predicate::{first_crossing, signed_area_doubled};

/// The most kinds of sheets of a design.
const MAX_SHEETS: usize = 1000;
/// The most corners of an offcut.
const MAX_CORNERS: usize = 10_000;
const FORMS: &str = "Write one of `size`, `roll` and `outline`, such as \"size\": [1220, 2440].";

/// Reads the field `sheets` of a design with these panels. `thickness_mm` is that of its sheet.
pub(super) fn read(
    file: Option<SheetsFile>,
    panels: &[DesignPanel],
    units: Units,
    thickness_mm: Option<f64>,
    source: &Source<'_>,
) -> Result<Option<Stock>, InputError> {
    let Some(file) = file else { return Ok(None) };
    let reader = Reader { units, thickness_mm };
    let refused = |path: &str, (message, hint): Problem| {
        source.error(&format!("sheets{path}"), message, hint)
    };
    if file.sizes.len() > MAX_SHEETS {
        let hint = format!("The limit is {MAX_SHEETS}.");
        let message = format!("there are {} kinds of sheets", file.sizes.len());
        return Err(refused(".sizes", (message, hint)));
    }
    let usual = Stock::default();
    let length = |name: &str, given: Option<LengthFile>, usual: f64| match given {
        None => Ok(usual),
        Some(given) => reader.mm(name, &given).map_err(|it| refused(&format!(".{name}"), it)),
    };
    let mut sheets = Vec::with_capacity(file.sizes.len());
    for (n, sheet) in file.sizes.into_iter().enumerate() {
        let read = read_sheet(&reader, sheet);
        sheets.push(read.map_err(|it| refused(&format!(".sizes[{n}]"), it))?);
    }
    for (n, group) in file.together.iter().enumerate() {
        let is_known = |name: &&String| !panels.iter().any(|panel| panel.name == **name);
        if let Some(name) = group.iter().find(is_known) {
            let hint = "Write names of panels.";
            let it = problem(format!("there is no panel {}", shown(name)), hint);
            return Err(refused(&format!(".together[{n}]"), it));
        }
    }
    if file.common_lines && file.gap.is_some() {
        return Err(refused(".gap", problem(GAP_AND_COMMON_LINES, LEAVE_THE_GAP_OUT)));
    }
    let effort = file.effort.unwrap_or(usual.effort);
    if !(LEAST_EFFORT..=MOST_EFFORT).contains(&effort) {
        return Err(refused(".effort", problem(format!("the effort is {effort}"), EFFORTS)));
    }
    let tolerance_deg = file.grain_tolerance_deg.unwrap_or(0.0);
    if !(0.0..=45.0).contains(&tolerance_deg) {
        let message = format!("the tolerance is {tolerance_deg}°");
        return Err(refused(".grain_tolerance_deg", problem(message, "Write 0 to 45 degrees.")));
    }
    let turn = match file.turn {
        None | Some(TurnFile::Word(TurnWord::Free)) => Turn::Free,
        Some(TurnFile::Word(TurnWord::Grain)) => Turn::Grain,
        Some(TurnFile::Word(TurnWord::OneWay)) => Turn::OneWay,
        Some(TurnFile::Step(deg)) if deg > 0.0 && deg <= 360.0 => {
            Turn::Steps { angle: from_deg(deg) }
        }
        Some(TurnFile::Step(deg)) => {
            return Err(refused(".turn", problem(format!("the step is {deg}°"), TURNS)));
        }
    };
    let divide = file.divide.and_then(|file| read_divide(&reader, file).transpose());
    let divide = divide.transpose().map_err(|it| refused(".divide", it))?;
    Ok(Some(Stock {
        sheets,
        gap_mm: length("gap", file.gap, usual.gap_mm)?,
        margin_mm: length("margin", file.margin, usual.margin_mm)?,
        kerf_mm: length("kerf", file.kerf, usual.kerf_mm)?,
        turn,
        grain_tolerance: from_deg(tolerance_deg),
        may_turn_over: file.turn_over,
        together: file.together,
        has_common_lines: file.common_lines,
        has_file_each: file.files == Some(FilesWord::Each),
        effort,
        divide,
    }))
}

/// How parts are divided; `None` where they are not.
fn read_divide(reader: &Reader, file: DivideFile) -> Result<Option<Divide>, Problem> {
    let joint = match file.joint {
        DivideWord::Scarf => DivideJoint::Scarf,
        DivideWord::Butt => DivideJoint::Butt,
        DivideWord::Puzzle => DivideJoint::Puzzle,
        DivideWord::Overlap => DivideJoint::Overlap,
        DivideWord::None => return Ok(None),
    };
    let usual = Divide::by(joint);
    let ratio = file.ratio.unwrap_or(usual.ratio);
    if !(1.0..=100.0).contains(&ratio) {
        let hint = "Write 1 to 100 thicknesses, such as 8.";
        return Err(problem(format!("the ratio is {ratio}"), hint));
    }
    let overlap_mm = match &file.overlap {
        Some(overlap) => reader.above_0("overlap", overlap)?,
        None => usual.overlap_mm,
    };
    Ok(Some(Divide { joint, ratio, overlap_mm }))
}

fn divide_file(divide: &Divide) -> DivideFile {
    let usual = Divide::by(divide.joint);
    DivideFile {
        joint: match divide.joint {
            DivideJoint::Scarf => DivideWord::Scarf,
            DivideJoint::Butt => DivideWord::Butt,
            DivideJoint::Puzzle => DivideWord::Puzzle,
            DivideJoint::Overlap => DivideWord::Overlap,
        },
        ratio: (divide.ratio != usual.ratio).then_some(divide.ratio),
        overlap: (divide.overlap_mm != usual.overlap_mm)
            .then(|| LengthFile::of_mm(divide.overlap_mm)),
    }
}

/// The steps that parts may turn by.
const TURNS: &str = "Write a step above 0 and up to 360 degrees, such as 90.";

fn read_sheet(reader: &Reader, file: SheetFile) -> Result<StockSheet, Problem> {
    let length = |name: &str, given: &LengthFile| {
        let mm = reader.above_0(name, given)?;
        if mm <= MOST_SHEET_MM {
            return Ok(mm);
        }
        Err(problem(format!("`{name}` is {mm} mm"), "Write a length up to 1 km."))
    };
    let form = match (file.size, file.roll, file.outline) {
        (Some([width, height]), None, None) => {
            SheetForm::Rectangle { size: [length("size", &width)?, length("size", &height)?] }
        }
        (None, Some(width), None) => SheetForm::Roll { width: length("roll", &width)? },
        (None, None, Some(points)) => SheetForm::Outline { points: offcut(points, reader.units)? },
        (None, None, None) => return Err(problem("the form of the sheet is missing", FORMS)),
        _ => return Err(problem("the sheet has several forms", FORMS)),
    };
    let is_offcut = matches!(form, SheetForm::Outline { .. });
    let count = file.count.or(is_offcut.then_some(1));
    if count.is_some_and(|count| !(1..=MOST_OF_A_KIND).contains(&count)) {
        return Err(problem("the count is out of range", "Write a whole number from 1."));
    }
    if file.cost.is_some_and(|cost| !(0.0..=1e12).contains(&cost)) {
        return Err(problem("the cost is out of range", "Write a number of 0 or more."));
    }
    Ok(StockSheet { name: file.name, form, count, cost: file.cost })
}

/// The outline of an offcut, counter-clockwise.
fn offcut(points: Vec<[f64; 2]>, units: Units) -> Result<Vec<Point2>, Problem> {
    let hint = "Write three or more corners in order, without the first once more.";
    if !(3..=MAX_CORNERS).contains(&points.len()) {
        return Err(problem(format!("the outline has {} corners", points.len()), hint));
    }
    let mut outline = Vec::with_capacity(points.len());
    for [x, y] in points {
        let at = [in_range_mm(x, units), in_range_mm(y, units)];
        let [Some(x), Some(y)] = at else {
            return Err(problem("a corner of the outline is out of range", hint));
        };
        outline.push(Point2::new(x, y));
    }
    if first_crossing(&outline).is_some() {
        return Err(problem("the outline crosses itself", hint));
    }
    if signed_area_doubled(&outline) < 0.0 {
        outline.reverse();
    }
    Ok(outline)
}

/// The field as it is written, in units; `None` for none.
pub(super) fn written(stock: Option<&Stock>, units: Units) -> Option<String> {
    let stock = stock?;
    let usual = Stock::default();
    let unless = |value: f64, usual: f64| (value != usual).then(|| LengthFile::of_mm(value));
    let turn = match stock.turn {
        Turn::Free => None,
        Turn::Grain => Some(TurnFile::Word(TurnWord::Grain)),
        Turn::OneWay => Some(TurnFile::Word(TurnWord::OneWay)),
        Turn::Steps { angle } => Some(TurnFile::Step(degrees(angle))),
    };
    let tolerance = stock.grain_tolerance;
    let file = SheetsFile {
        sizes: stock.sheets.iter().map(|sheet| sheet_file(sheet, units)).collect(),
        gap: unless(stock.gap_mm, usual.gap_mm).filter(|_| !stock.has_common_lines),
        margin: unless(stock.margin_mm, usual.margin_mm),
        kerf: unless(stock.kerf_mm, usual.kerf_mm),
        turn,
        grain_tolerance_deg: (tolerance != 0.0).then(|| degrees(tolerance)),
        turn_over: stock.may_turn_over,
        together: stock.together.clone(),
        common_lines: stock.has_common_lines,
        files: stock.has_file_each.then_some(FilesWord::Each),
        effort: (stock.effort != usual.effort).then_some(stock.effort),
        divide: stock.divide.as_ref().map(divide_file),
    };
    Some(json(&file))
}

/// The degrees, rounded if they are meant to be, that read as an angle in radians.
fn degrees(angle: f64) -> f64 {
    let exact = to_deg(angle);
    let rounded = (exact * 1e6).round() / 1e6;
    if from_deg(rounded) == angle { rounded } else { exact }
}

fn sheet_file(sheet: &StockSheet, units: Units) -> SheetFile {
    let mut file = SheetFile {
        name: sheet.name.clone(),
        count: sheet.count,
        cost: sheet.cost,
        ..SheetFile::default()
    };
    match &sheet.form {
        SheetForm::Rectangle { size } => file.size = Some(size.map(LengthFile::of_mm)),
        SheetForm::Roll { width } => file.roll = Some(LengthFile::of_mm(*width)),
        SheetForm::Outline { points } => {
            let in_units = |p: &Point2| [p.x / units.in_mm(), p.y / units.in_mm()];
            file.outline = Some(points.iter().map(in_units).collect());
        }
    }
    file
}

#[cfg(test)]
mod tests {
    use crate::{InputFormat, ReadOptions, read_bytes, write_design};
    use sheetwright::design::{Design, Divide, DivideJoint, SheetForm, Turn};
    use sheetwright::math::from_deg;

    fn read(text: &str) -> Result<Design, crate::InputError> {
        let options = ReadOptions::default();
        read_bytes(InputFormat::Design, text.as_bytes(), "d.sheet.json", None, &options)
    }

    fn with(sheets: &str) -> Result<Design, crate::InputError> {
        let head = r#""sheetwright": 1, "units": "cm", "material": "plywood-4mm""#;
        read(&format!(r#"{{ {head}, "panels": [], "sheets": {sheets} }}"#))
    }

    #[test]
    fn sheets_read_back_as_they_were_written() {
        let design = with(
            r#"{ "sizes": [
                { "size": [122, "8 ft"], "count": 3, "cost": 41.5, "name": "ply" },
                { "roll": "1370 mm" },
                { "outline": [[0, 0], [0, 30], [40, 0]] } ],
              "gap": "2 t", "kerf": "0.2 mm", "turn": 90, "grain_tolerance_deg": 3,
              "turn_over": true, "effort": 2, "files": "each",
              "divide": { "joint": "scarf", "ratio": 12, "overlap": "5 t" } }"#,
        )
        .unwrap();
        let stock = design.stock.as_ref().unwrap();
        assert_eq!(stock.sheets[0].form, SheetForm::Rectangle { size: [1220.0, 2438.4] });
        assert_eq!(stock.sheets[1].form, SheetForm::Roll { width: 1370.0 });
        let SheetForm::Outline { points } = &stock.sheets[2].form else { panic!("an offcut") };
        assert_eq!((points[0].x, stock.sheets[2].count), (400.0, Some(1)), "turned round");
        assert_eq!((stock.gap_mm, stock.margin_mm, stock.kerf_mm), (8.0, 5.0, 0.2));
        assert_eq!(stock.turn, Turn::Steps { angle: from_deg(90.0) });
        let divide = Divide { ratio: 12.0, overlap_mm: 20.0, ..Divide::by(DivideJoint::Scarf) };
        assert_eq!(stock.divide, Some(divide));
        assert!(stock.has_file_each && !stock.has_common_lines);
        let none = with(r#"{ "divide": { "joint": "none" } }"#).unwrap();
        assert_eq!(none.stock.unwrap().divide, None);
        let again = read(std::str::from_utf8(&write_design(&design)).unwrap()).unwrap();
        assert_eq!(again, design);
        assert_eq!(with(r#"{ "turn": "one-way" }"#).unwrap().stock.unwrap().turn, Turn::OneWay);
    }

    #[test]
    fn what_is_no_sheet_is_refused_in_words() {
        for (sheets, words) in [
            (r#"{ "sizes": [{}] }"#, "the form of the sheet is missing"),
            (r#"{ "sizes": [{ "size": [1, 2], "roll": 3 }] }"#, "several forms"),
            (r#"{ "sizes": [{ "size": [0, 2] }] }"#, "size"),
            (r#"{ "sizes": [{ "roll": "2 km" }] }"#, "roll"),
            (r#"{ "sizes": [{ "outline": [[0, 0], [1, 1], [1, 0], [0, 1]] }] }"#, "crosses"),
            (r#"{ "turn": 0 }"#, "the step is 0°"),
            (r#"{ "effort": 0 }"#, "the effort is 0"),
            (r#"{ "together": [["bow"]] }"#, "there is no panel"),
            (r#"{ "gap": -1 }"#, "gap"),
            (r#"{ "gap": 1, "common_lines": true }"#, "a kerf apart"),
            (r#"{ "files": "some" }"#, "some"),
            (r#"{ "divide": { "joint": "scarf", "ratio": 0 } }"#, "the ratio is 0"),
            (r#"{ "divide": { "joint": "overlap", "overlap": 0 } }"#, "overlap"),
        ] {
            let error = with(sheets).unwrap_err().to_string();
            assert!(error.contains(words), "{sheets}: {error}");
        }
    }
}
