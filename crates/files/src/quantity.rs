//! Quantities as people type them: `400mm`, `40 cm`, `15 3/4in`, `1' 4"`, `45°`.
//!
//! ```text
//! length   = [sign] term+                 (1' 4": the sum; the sign is for all of it)
//! term     = number [unit]                (without a unit, alone: millimetres)
//! number   = decimal | [whole] whole "/" whole
//! unit     = mm cm m in ft, " ″ inch inches, ' ′ foot feet
//! angle    = [sign] number [deg | ° | degree | degrees]
//! ```

use crate::design_json::MOST_WARP_DEG;
use crate::table::in_range_mm;
use crate::units::Units;

/// Lengths as they can be written.
pub(crate) const LENGTH_EXAMPLES: &str = "400, 400mm, 40cm, 0.4m, 15 3/4in or 1' 4\"";

/// A quantity has this many bytes at the most; more is no slip of the fingers.
const MAX_BYTES: usize = 100;

/// A length, mm; `None` if the text is none. Several terms each have a unit.
pub(crate) fn length_mm(text: &str) -> Option<f64> {
    let (sign, terms) = terms(text)?;
    if let [(number, "")] = terms[..] {
        return finite(sign * number);
    }
    let mut sum = 0.0;
    for (number, unit) in terms {
        // Units are whole tenths of a mm; counted in these, 15.75 inches are 400.05 mm to the digit.
        sum += number * (unit_of(unit)?.in_mm() * 10.0) / 10.0;
    }
    finite(sign * sum)
}

/// A length, mm, where a number without a unit is in `units`; `None` if the text is none.
pub fn length_in(text: &str, units: Units) -> Option<f64> {
    match plain(text) {
        Some(number) => finite(number * (units.in_mm() * 10.0) / 10.0),
        None => length_mm(text),
    }
}

/// A length with its unit, as short as a hundredth of a millimetre allows: `400 mm`, `40.5 cm`,
/// `15.75 in`. It reads back within that.
pub fn length_text(mm: f64, units: Units) -> String {
    let decimals = match units {
        Units::Millimetres => 2,
        Units::Centimetres | Units::Inches => 3,
        Units::Metres => 5,
        Units::Feet => 4,
    };
    let digits = format!("{:.decimals$}", mm / units.in_mm());
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    let digits = if digits == "-0" { "0" } else { digits };
    format!("{digits} {}", units.name())
}

/// A distance that something may move, mm; `None` where the text is none, or the distance is not
/// taken.
pub fn distance_mm(text: &str) -> Option<f64> {
    length_mm(text).and_then(|mm| in_range_mm(mm, Units::Millimetres)).filter(|mm| *mm >= 0.0)
}

/// A warp angle that may be asked for, degrees; `None` where the text is none.
pub fn warp_deg(text: &str) -> Option<f64> {
    angle_deg(text).filter(|deg| *deg > 0.0 && *deg <= MOST_WARP_DEG)
}

/// An angle, degrees; `None` if the text is none.
pub(crate) fn angle_deg(text: &str) -> Option<f64> {
    let (sign, terms) = terms(text)?;
    match terms[..] {
        [(number, "" | "deg" | "°" | "degree" | "degrees")] => finite(sign * number),
        _ => None,
    }
}

/// A number without a unit; `None` if the text is none.
pub(crate) fn plain(text: &str) -> Option<f64> {
    let (sign, terms) = terms(text)?;
    match terms[..] {
        [(number, "")] => finite(sign * number),
        _ => None,
    }
}

fn finite(number: f64) -> Option<f64> {
    // -0 is 0 to people.
    number.is_finite().then_some(number + 0.0)
}

fn unit_of(name: &str) -> Option<Units> {
    match &name.to_ascii_lowercase()[..] {
        "\"" | "″" | "”" | "''" | "inch" | "inches" => Some(Units::Inches),
        "'" | "′" | "’" | "foot" | "feet" => Some(Units::Feet),
        name => Units::from_name(name),
    }
}

/// The sign, and the numbers with what stands behind each.
fn terms(text: &str) -> Option<(f64, Vec<(f64, &str)>)> {
    if text.len() > MAX_BYTES {
        return None;
    }
    let text = text.trim();
    let (sign, mut rest) = match text.strip_prefix(['-', '−']) {
        Some(rest) => (-1.0, rest.trim_start()),
        None => (1.0, text.strip_prefix('+').unwrap_or(text).trim_start()),
    };
    let mut terms = Vec::new();
    while !rest.is_empty() {
        let (number, after) = number(rest)?;
        let after = after.trim_start();
        let end = after.find(|c: char| c.is_ascii_digit() || c == '.' || c.is_whitespace());
        let (unit, after) = after.split_at(end.unwrap_or(after.len()));
        terms.push((number, unit));
        rest = after.trim_start();
    }
    (!terms.is_empty()).then_some((sign, terms))
}

/// The number that a text begins with, and the rest: `3/4`, `15 3/4`, `15-3/4`, `0.4`, `1e3`.
fn number(text: &str) -> Option<(f64, &str)> {
    let (first, rest) = decimal(text)?;
    if let Some(below) = rest.strip_prefix('/') {
        return fraction(first, below);
    }
    // A whole number may have a fraction behind it, after a space or a hyphen.
    let behind = rest.strip_prefix('-').unwrap_or(rest).trim_start();
    if behind.len() < rest.len()
        && let Some((over, slash)) = decimal(behind)
        && let Some(below) = slash.strip_prefix('/')
    {
        let (part, rest) = fraction(over, below)?;
        return (first.fract() == 0.0 && part < 1.0).then_some((first + part, rest));
    }
    Some((first, rest))
}

fn fraction(over: f64, below: &str) -> Option<(f64, &str)> {
    let (below, rest) = decimal(below)?;
    let whole = over.fract() == 0.0 && below.fract() == 0.0 && below > 0.0;
    whole.then_some((over / below, rest))
}

/// Digits with at most one point, and an exponent if there is one.
fn decimal(text: &str) -> Option<(f64, &str)> {
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let mut end = digits(text);
    if text[end..].starts_with('.') {
        end += 1 + digits(&text[end + 1..]);
    }
    if let Some(power) = text[end..].strip_prefix(['e', 'E']) {
        let signed = power.strip_prefix(['+', '-']).unwrap_or(power);
        let count = digits(signed);
        if count > 0 {
            end = text.len() - signed.len() + count;
        }
    }
    // What is no number on its own, as "." is none, is refused by the parser.
    let number = text[..end].parse().ok()?;
    Some((number, &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_read_as_people_type_them() {
        for (text, mm) in [
            ("400", 400.0),
            ("400mm", 400.0),
            (" 400 mm ", 400.0),
            ("40cm", 400.0),
            ("0.4m", 400.0),
            (".4m", 400.0),
            ("4e2", 400.0),
            ("15 3/4in", 400.05),
            ("15-3/4in", 400.05),
            ("400MM", 400.0),
            ("15 3/4\"", 400.05),
            ("15.75 inches", 400.05),
            ("3/4in", 19.05),
            ("3/4 inch", 19.05),
            ("1' 4\"", 406.4),
            ("1'4\"", 406.4),
            ("1ft 4in", 406.4),
            ("1 ft 4 1/2 in", 419.1),
            ("1′ 4″", 406.4),
            ("1' 4''", 406.4),
            ("6 feet", 1828.8),
            ("1m 20cm", 1200.0),
            ("-20mm", -20.0),
            ("−1' 4\"", -406.4),
            ("+5", 5.0),
            ("15 3/4", 15.75),
            ("-0", 0.0),
        ] {
            let read = length_mm(text);
            assert!(read.is_some_and(|read| (read - mm).abs() < 1e-9), "{text}: {read:?}");
        }
        assert_eq!(length_mm("-0").map(f64::to_bits), Some(0));
        assert_eq!(length_mm("15 3/4in").map(|mm| mm.to_string()), Some("400.05".to_owned()));
    }

    #[test]
    fn what_is_no_length_is_refused() {
        for text in [
            "",
            " ",
            "-",
            "mm",
            "40x",
            "40 kg",
            "4,5",
            "1' 4",
            "4 3/4 3/4in",
            "1/0in",
            "1.5/2in",
            "1.5 3/4in",
            "1 5/4in",
            "nan",
            "inf",
            "1e999",
            "--5",
            "1.2.3",
            "5mm-3mm",
            "0x10",
            "4 4mm",
            ".",
            "e5",
            "1/",
            "400 m m",
            "½in",
        ] {
            assert_eq!(length_mm(text), None, "{text:?}");
        }
        assert_eq!(length_mm(&"1mm ".repeat(1000)), None);
    }

    #[test]
    fn lengths_are_shown_in_units_and_read_back() {
        for (mm, units, text) in [
            (400.0, Units::Millimetres, "400 mm"),
            (-0.001, Units::Millimetres, "0 mm"),
            (400.05, Units::Inches, "15.75 in"),
            (-1250.5, Units::Metres, "-1.2505 m"),
            (0.004, Units::Millimetres, "0 mm"),
        ] {
            assert_eq!(length_text(mm, units), text);
            let back = length_in(text, Units::Feet);
            assert!(back.is_some_and(|back| (back - mm).abs() <= 0.005), "{text}: {back:?}");
        }
        assert_eq!(length_in("2", Units::Inches), Some(50.8));
        assert_eq!(length_in("2 cm", Units::Inches), Some(20.0));
        assert_eq!(length_in("2 kg", Units::Inches), None);
    }

    #[test]
    fn angles_and_plain_numbers_too() {
        for text in ["45", "45deg", "45°", "45 degrees", "4.5e1°"] {
            assert_eq!(angle_deg(text), Some(45.0), "{text}");
        }
        assert_eq!(angle_deg("-22.5°"), Some(-22.5));
        assert_eq!(angle_deg("45mm"), None);
        assert_eq!(angle_deg("45' 3\""), None);
        assert_eq!(plain("3/4"), Some(0.75));
        assert_eq!(plain("3mm"), None);
    }
}
