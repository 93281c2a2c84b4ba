//! Sheets as they are typed on a command line.

use crate::quantity::length_text;
use crate::units::Units;
use sheetwright::design::{SheetForm, StockSheet};

/// The longest side of a sheet, mm: a longer one has the wrong unit.
pub(crate) const MOST_SHEET_MM: f64 = 1e6;
/// A sheet without a unit is larger on one side, mm: 4x8 means feet.
const LEAST_BARE_MM: f64 = 50.0;
/// The most sheets of a kind.
pub(crate) const MOST_OF_A_KIND: usize = 1_000_000;

/// A kind of sheet, as it is typed: `1220x2440mm`, `4x8ft`, `3x1220x2440mm` for three of them,
/// `roll:1370mm` for a roll.
///
/// # Errors
/// Another text, or a length out of range; the error says what to type.
pub fn stock_sheet(text: &str) -> Result<StockSheet, String> {
    const EXAMPLES: &str = "give a width and a height such as 1220x2440mm or 4x8ft, with a number \
                            of sheets before them if there are only so many (3x1220x2440mm), or \
                            the width of a roll such as roll:1370mm";
    let sheet = |form, count| StockSheet { name: None, form, count, cost: None };
    let in_range = |mm: f64| (mm > 0.0 && mm <= MOST_SHEET_MM).then_some(mm);
    let text = text.trim().to_lowercase();
    let read = || {
        if let Some(width) = text.strip_prefix("roll:") {
            let width = crate::quantity::size_mm(width).and_then(in_range)?;
            return Some((sheet(SheetForm::Roll { width }, None), false));
        }
        let letters = text.trim_end_matches(|c: char| c.is_alphabetic() || "\"″'′".contains(c));
        let unit = text[letters.len()..].trim();
        let units =
            if unit.is_empty() { Units::Millimetres } else { crate::quantity::unit_of(unit)? };
        let numbers: Vec<&str> = letters.split(['x', '×', '*']).collect();
        let (count, [width, height]) = match numbers[..] {
            [width, height] => (None, [width, height]),
            [count, width, height] => {
                let count = count.trim().parse().ok();
                let is_some = |count: &usize| (1..=MOST_OF_A_KIND).contains(count);
                (Some(count.filter(is_some)?), [width, height])
            }
            _ => return None,
        };
        let mm = |text: &str| crate::quantity::length_in(text.trim(), units).and_then(in_range);
        let size = [mm(width)?, mm(height)?];
        Some((sheet(SheetForm::Rectangle { size }, count), unit.is_empty()))
    };
    let (read, is_bare) = read().ok_or_else(|| EXAMPLES.to_owned())?;
    match read.form {
        SheetForm::Rectangle { size: [width, height] }
            if is_bare && width.max(height) < LEAST_BARE_MM =>
        {
            Err(format!(
                "without a unit these are millimetres; give {width}x{height}ft or \
                 {width}x{height}in, or {width}x{height}mm if it is so small"
            ))
        }
        _ => Ok(read),
    }
}

/// A kind of sheet as it is typed; `None` of an offcut, which has corners.
pub fn stock_text(sheet: &StockSheet) -> Option<String> {
    let count = sheet.count.map_or_else(String::new, |count| format!("{count}x"));
    match sheet.form {
        SheetForm::Rectangle { size } => Some(count + &size_text(size)),
        SheetForm::Roll { width } => Some(format!("roll:{width}mm")),
        SheetForm::Outline { .. } => None,
    }
}

/// A width and a height, mm, as they are typed.
pub(crate) fn size_text([width, height]: [f64; 2]) -> String {
    // Inches in millimetres end in digits that nobody has typed.
    let [width, height] = [width, height].map(|mm| (mm * 1e6).round() / 1e6);
    format!("{width}x{height}mm")
}

/// What a sheet is called: by its name, or by its size.
pub fn sheet_title(sheet: &StockSheet) -> String {
    let mm = |mm: f64| length_text(mm, Units::Millimetres);
    match (&sheet.name, &sheet.form) {
        (Some(name), _) => name.clone(),
        (None, SheetForm::Rectangle { size: [width, height] }) => {
            format!("{} × {}", mm(*width).trim_end_matches(" mm"), mm(*height))
        }
        (None, SheetForm::Roll { width }) => format!("roll of {}", mm(*width)),
        (None, SheetForm::Outline { .. }) => "offcut".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sheets_are_read_as_they_are_typed() {
        let size = |text: &str| match stock_sheet(text).unwrap() {
            StockSheet { form: SheetForm::Rectangle { size }, count, .. } => (size, count),
            other => panic!("{other:?}"),
        };
        assert_eq!(size("1220x2440mm"), ([1220.0, 2440.0], None));
        assert_eq!(size(" 3x1220×2440 "), ([1220.0, 2440.0], Some(3)));
        assert_eq!(size("4 x 8 ft"), ([1219.2, 2438.4], None));
        let roll = stock_sheet("roll:54in").unwrap();
        assert_eq!(roll.form, SheetForm::Roll { width: 1371.6 });
        assert_eq!(sheet_title(&roll), "roll of 1371.6 mm");
        assert_eq!(sheet_title(&stock_sheet("4x8ft").unwrap()), "1219.2 × 2438.4 mm");
        for text in ["1220x2440mm", "3x1219.2x2438.4mm", "roll:1370mm"] {
            assert_eq!(stock_text(&stock_sheet(text).unwrap()).unwrap(), text);
        }
        let small = stock_sheet("2x4x8").unwrap_err();
        assert!(small.contains("give 4x8ft"), "{small}");
        assert_eq!(size("4x8mm"), ([4.0, 8.0], None));
        for text in ["", "1220", "0x3", "1x2x3x4", "axb", "roll:", "2kmx3", "1.5x3x4", "9e9x1"] {
            assert!(stock_sheet(text).is_err(), "{text}");
        }
    }
}
