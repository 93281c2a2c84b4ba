//! Quantities as typed: `400mm`, `40 cm`, `15 3/4in`, `1' 4"`, `45°`, `200 + 50`, `12,5`.
//!
//! ```text
//! quantity = [sign] part {("+" | "-") part}
//! part     = term+                 (1' 4": the sum; a sign before it is for all of it)
//! term     = number [unit]         (either every number of a length has a unit, or none has)
//! number   = decimal | [whole] whole "/" whole
//! decimal  = digits ["." digits | "," digits] [exponent]
//! unit     = mm cm m in ft, " ″ inch inches, ' ′ foot feet; of an angle deg ° degree degrees
//! ```
//!
//! A comma separates decimals. A text where it could also separate thousands, as in `1,250`, is
//! refused, since a wrong guess would be a factor of 1000. Fields of the editor, settings of
//! templates and options of the command all read quantities here.

use crate::table::in_range_mm;
use crate::units::Units;
use std::ops::RangeInclusive;

/// The largest warp angle that can be set as a goal, degrees.
pub(crate) const MOST_WARP_DEG: f64 = 90.0;

/// The shares of the strain of the sheet that can be set as a goal: less than a twentieth is below
/// what a prediction tells.
pub(crate) fn strain_shares() -> RangeInclusive<f64> {
    0.05..=1.0
}

/// Examples of lengths, for messages.
pub(crate) const LENGTH_EXAMPLES: &str = "400, 400mm, 40cm, 0.4m, 15 3/4in or 1' 4\"";

/// The most bytes of a quantity; a longer text is no typing error.
const MAX_BYTES: usize = 100;

/// Why a text is no quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Slip {
    /// There is no text.
    Empty,
    /// The text is too long.
    Long,
    /// The text where a number was expected.
    NoNumber(String),
    /// A comma that may separate decimals or thousands.
    Ambiguous(String),
    /// More separators than a number can have.
    Separators(String),
    /// Some numbers have a unit and some have none.
    SomeUnits,
    /// A unit that this quantity does not have.
    Unit(String),
    /// The value is not finite.
    Huge,
}

impl Slip {
    /// Why, in a sentence; `what` names the quantity, such as `length`.
    fn words(&self, what: &str) -> String {
        match self {
            Self::Empty => format!("Type a {what}."),
            Self::Long => format!("This is too long for a {what}."),
            Self::NoNumber(text) if text.is_empty() => "A number is missing at the end.".to_owned(),
            Self::NoNumber(text) => format!("‘{text}’ is not a number."),
            Self::Ambiguous(text) => {
                let [whole, point] = [text.replace(',', ""), text.replace(',', ".")];
                format!("‘{text}’ can mean {whole} or {point}: write one of them.")
            }
            Self::Separators(text) => {
                format!("‘{text}’: leave the separators between thousands out.")
            }
            Self::SomeUnits => "Give every number a unit, as in 1' 4\", or none.".to_owned(),
            Self::Unit(unit) => match what {
                "length" => format!("‘{unit}’ is not a unit of length: mm, cm, m, in or ft."),
                "angle" => format!("‘{unit}’ is not a unit of angle: deg or °."),
                _ => format!("‘{unit}’ does not belong here: this number has no unit."),
            },
            Self::Huge => "No number is that large.".to_owned(),
        }
    }

    /// Advice on the form of the text, where "write a quantity" is not enough.
    pub(crate) fn advice(&self, what: &str) -> Option<String> {
        let is_of_form = matches!(self, Self::Ambiguous(_) | Self::Separators(_) | Self::SomeUnits);
        is_of_form.then(|| self.words(what))
    }
}

/// A length, mm; a number without a unit is in `units`.
///
/// # Errors
/// Why the text is no length, in a sentence.
pub fn read_length(text: &str, units: Units) -> Result<f64, String> {
    length(text, units).map_err(|slip| slip.words("length"))
}

/// Lengths, mm, separated by commas, or by semicolons so that a comma may separate decimals.
///
/// # Errors
/// Why one of them is no length, in a sentence.
pub fn read_lengths(text: &str, units: Units) -> Result<Vec<f64>, String> {
    lengths(text, units).map_err(|slip| slip.words("length"))
}

/// An angle, degrees.
///
/// # Errors
/// Why the text is no angle, in a sentence.
pub fn read_angle(text: &str) -> Result<f64, String> {
    angle(text).map_err(|slip| slip.words("angle"))
}

/// A number without a unit.
///
/// # Errors
/// Why the text is no number, in a sentence.
pub fn read_number(text: &str) -> Result<f64, String> {
    plain(text).map_err(|slip| slip.words("number"))
}

/// A length, mm, where a number without a unit is in `units`; `None` if the text is none.
pub fn length_in(text: &str, units: Units) -> Option<f64> {
    length(text, units).ok()
}

/// A length with its unit, as short as a hundredth of a millimetre allows: `400 mm`, `40.5 cm`,
/// `15.75 in`. It reads back with this accuracy.
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

/// A step of a grid with its unit: inches as binary fractions, and steps below a foot in inches.
pub fn step_text(mm: f64, units: Units) -> String {
    let inch = Units::Inches.in_mm();
    let is_small = matches!(units, Units::Inches | Units::Feet) && mm < 0.999 * units.in_mm();
    if !is_small {
        return length_text(mm, units);
    }
    let is_whole = |number: f64| (number - number.round()).abs() < 1e-6;
    let below = [2.0, 4.0, 8.0, 16.0, 32.0, 64.0].into_iter().find(|d| is_whole(mm / inch * d));
    match below {
        Some(below) if mm < inch => format!("{}/{below} in", (mm / inch * below).round()),
        _ => length_text(mm, Units::Inches),
    }
}

/// A limit on movement, mm; `None` if the text is no length, or the length is negative or out of
/// range.
pub fn distance_mm(text: &str) -> Option<f64> {
    let mm = length(text, Units::Millimetres).ok()?;
    in_range_mm(mm, Units::Millimetres).filter(|mm| *mm >= 0.0)
}

/// A size, mm; `None` if the text is no length above 0 and within range.
pub fn size_mm(text: &str) -> Option<f64> {
    distance_mm(text).filter(|mm| *mm > 0.0)
}

/// A goal for the warp angle, degrees; `None` if the text is no angle above 0° and up to 90°.
pub fn warp_deg(text: &str) -> Option<f64> {
    angle(text).ok().filter(|deg| *deg > 0.0 && *deg <= MOST_WARP_DEG)
}

/// A goal for the strain, as a share of what the sheet takes, from a percentage or a number (80%,
/// 0.8); `None` if it is below 5 % or above 100 %.
pub fn strain_share(text: &str) -> Option<f64> {
    let text = text.trim();
    let share = match text.strip_suffix('%') {
        Some(per_cent) => per_cent.trim().parse::<f64>().ok()? / 100.0,
        None => text.parse().ok()?,
    };
    strain_shares().contains(&share).then_some(share)
}

/// A length, mm.
pub(crate) fn length(text: &str, units: Units) -> Result<f64, Slip> {
    let parts = parts(text)?;
    let has_unit = |(_, unit): &(f64, &str)| !unit.is_empty();
    let terms = || parts.iter().flat_map(|part| &part.terms);
    if !terms().any(has_unit) {
        // Two numbers without units side by side are no sum: 1 250.
        let beside = parts.iter().find(|part| part.terms.len() > 1);
        if beside.is_some() {
            return Err(Slip::Separators(text.trim().to_owned()));
        }
        return finite(parts.iter().map(|part| part.sign * bare(part.terms[0].0, units)).sum());
    }
    if !terms().all(has_unit) {
        return Err(Slip::SomeUnits);
    }
    let mut total = 0.0;
    for part in &parts {
        let mut sum = 0.0;
        for (number, unit) in &part.terms {
            let of = unit_of(unit).ok_or_else(|| Slip::Unit((*unit).to_owned()))?;
            // All units are whole tenths of a mm. Computed in tenths, 15.75 inches are exactly
            // 400.05 mm.
            sum += number * (of.in_mm() * 10.0) / 10.0;
        }
        total += part.sign * sum;
    }
    finite(total)
}

fn bare(number: f64, units: Units) -> f64 {
    match units {
        Units::Millimetres => number,
        units => number * (units.in_mm() * 10.0) / 10.0,
    }
}

/// Lengths, mm, separated by commas or semicolons.
pub(crate) fn lengths(text: &str, units: Units) -> Result<Vec<f64>, Slip> {
    let between = if text.contains(';') { ';' } else { ',' };
    text.split(between).map(|text| length(text, units)).collect()
}

/// An angle, degrees.
pub(crate) fn angle(text: &str) -> Result<f64, Slip> {
    alone(text, &["", "deg", "°", "degree", "degrees"])
}

/// A number without a unit.
pub(crate) fn plain(text: &str) -> Result<f64, Slip> {
    alone(text, &[""])
}

/// A sum of numbers with one of `units`, which are spellings of the same unit.
fn alone(text: &str, units: &[&str]) -> Result<f64, Slip> {
    let mut total = 0.0;
    for part in parts(text)? {
        if let Some((_, unit)) = part.terms.iter().find(|(_, unit)| !units.contains(unit)) {
            return Err(Slip::Unit((*unit).to_owned()));
        }
        let [(number, _)] = part.terms[..] else {
            return Err(Slip::Separators(text.trim().to_owned()));
        };
        total += part.sign * number;
    }
    finite(total)
}

fn finite(number: f64) -> Result<f64, Slip> {
    // Adding 0 turns −0 into 0.
    if number.is_finite() { Ok(number + 0.0) } else { Err(Slip::Huge) }
}

pub(crate) fn unit_of(name: &str) -> Option<Units> {
    match &name.to_ascii_lowercase()[..] {
        "\"" | "″" | "”" | "''" | "inch" | "inches" => Some(Units::Inches),
        "'" | "′" | "’" | "foot" | "feet" => Some(Units::Feet),
        name => Units::from_name(name),
    }
}

/// A summand: its sign and its numbers with their units.
struct Summand<'a> {
    sign: f64,
    /// Numbers, each with the text of its unit; at least one.
    terms: Vec<(f64, &'a str)>,
}

const SIGNS: [char; 3] = ['+', '-', '−'];

fn parts(text: &str) -> Result<Vec<Summand<'_>>, Slip> {
    if text.len() > MAX_BYTES {
        return Err(Slip::Long);
    }
    let mut rest = text.trim();
    if rest.is_empty() {
        return Err(Slip::Empty);
    }
    let mut parts = Vec::new();
    while !rest.is_empty() {
        let unsigned = rest.trim_start_matches(SIGNS);
        let sign = if rest.starts_with(['-', '−']) { -1.0 } else { 1.0 };
        if rest[..rest.len() - unsigned.len()].chars().count() > 1 {
            return Err(Slip::NoNumber(rest.to_owned()));
        }
        rest = unsigned.trim_start();
        let mut terms = Vec::new();
        while terms.is_empty() || !(rest.is_empty() || rest.starts_with(SIGNS)) {
            let (number, after) = number(rest)?;
            let after = after.trim_start();
            let ends = |c: char| {
                c.is_ascii_digit()
                    || matches!(c, '.' | ',')
                    || c.is_whitespace()
                    || SIGNS.contains(&c)
            };
            let (unit, after) = after.split_at(after.find(ends).unwrap_or(after.len()));
            terms.push((number, unit));
            rest = after.trim_start();
        }
        parts.push(Summand { sign, terms });
    }
    Ok(parts)
}

/// The number that a text begins with, and the rest: `3/4`, `15 3/4`, `15-3/4`, `0.4`, `1e3`.
fn number(text: &str) -> Result<(f64, &str), Slip> {
    let (first, rest) = decimal(text)?;
    if let Some(below) = rest.strip_prefix('/') {
        return fraction(first, below).ok_or_else(|| Slip::NoNumber(text.to_owned()));
    }
    // A whole number may have a fraction behind it, after a space or a hyphen.
    let behind = rest.strip_prefix('-').unwrap_or_else(|| rest.trim_start());
    if behind.len() < rest.len()
        && let Ok((over, slash)) = decimal(behind)
        && let Some(below) = slash.strip_prefix('/')
    {
        let mixed = fraction(over, below).filter(|(part, _)| first.fract() == 0.0 && *part < 1.0);
        let (part, rest) = mixed.ok_or_else(|| Slip::NoNumber(text.to_owned()))?;
        return Ok((first + part, rest));
    }
    Ok((first, rest))
}

fn fraction(over: f64, below: &str) -> Option<(f64, &str)> {
    let (below, rest) = decimal(below).ok()?;
    let whole = over.fract() == 0.0 && below.fract() == 0.0 && below > 0.0;
    whole.then_some((over / below, rest))
}

/// Digits with at most one point or comma, and an exponent if there is one.
fn decimal(text: &str) -> Result<(f64, &str), Slip> {
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let whole = digits(text);
    let mut end = whole;
    let is_comma = text[end..].starts_with(',') && digits(&text[end + 1..]) > 0;
    let is_parted = is_comma || text[end..].starts_with('.');
    if is_parted {
        end += 1 + digits(&text[end + 1..]);
    }
    // One more separator with a digit behind it: 1,000,000 or 1.000,5.
    let more = |at: usize| text[at..].starts_with(['.', ',']) && digits(&text[at + 1..]) > 0;
    if is_parted && more(end) {
        while more(end) {
            end += 1 + digits(&text[end + 1..]);
        }
        return Err(Slip::Separators(text[..end].to_owned()));
    }
    // A leading zero rules out thousands: 0,125.
    if is_comma && end - whole == 4 && (1..=3).contains(&whole) && !text.starts_with('0') {
        return Err(Slip::Ambiguous(text[..end].to_owned()));
    }
    if let Some(power) = text[end..].strip_prefix(['e', 'E']) {
        let signed = power.strip_prefix(['+', '-']).unwrap_or(power);
        let count = digits(signed);
        if count > 0 {
            end = text.len() - signed.len() + count;
        }
    }
    // The parser refuses digits that are no number, such as a lone ".".
    let number = text[..end].replace(',', ".").parse();
    number.map(|number| (number, &text[end..])).map_err(|_| Slip::NoNumber(text.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length_mm(text: &str) -> Option<f64> {
        length_in(text, Units::Millimetres)
    }

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
            ("250,5", 250.5),
            ("12,5 cm", 125.0),
            (",5m", 500.0),
            ("0,125in", 3.175),
            ("1234,567", 1234.567),
            ("1.250", 1.25),
            ("200+50", 250.0),
            ("200 - 50,5", 149.5),
            ("200 −50", 150.0),
            ("5mm-3mm", 2.0),
            ("1' + 3 1/2in", 393.7),
            ("1' 4\" - 2\" + 1cm", 365.6),
            ("-1' 4\" + 4\"", -304.8),
            ("15 - 3/4", 14.25),
            ("1e2+5e-1", 100.5),
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
            "5 - -3",
            "5+",
            "+",
            "200 + 3in",
            "200+50mm",
            "4,",
            "1,250",
            "12,500 mm",
            "1,000,000",
            "1.000,5",
            "1,000.5",
            "1 250",
            "1'000",
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
        for text in ["45", "45deg", "45°", "45 degrees", "4.5e1°", "30 + 15deg", "50,5° - 5,5°"]
        {
            assert_eq!(read_angle(text), Ok(45.0), "{text}");
        }
        assert_eq!(read_angle("-22.5°"), Ok(-22.5));
        assert!(read_angle("45mm").is_err() && read_angle("45' 3\"").is_err());
        assert_eq!((plain("3/4"), plain("1 + 0,5")), (Ok(0.75), Ok(1.5)));
        assert!(plain("3mm").is_err());
        assert_eq!(read_lengths("1cm, 20", Units::Millimetres), Ok(vec![10.0, 20.0]));
        assert_eq!(read_lengths("1,5; 2,5", Units::Inches), Ok(vec![38.1, 63.5]));
    }

    #[test]
    fn what_is_refused_says_why() {
        let mm = Units::Millimetres;
        for (text, words) in [
            ("1,250", "‘1,250’ can mean 1250 or 1.250: write one of them."),
            ("12,500 mm", "‘12,500’ can mean 12500 or 12.500: write one of them."),
            ("1,000,000", "‘1,000,000’: leave the separators between thousands out."),
            ("1 250", "‘1 250’: leave the separators between thousands out."),
            ("1' 4", "Give every number a unit, as in 1' 4\", or none."),
            ("5 kg", "‘kg’ is not a unit of length: mm, cm, m, in or ft."),
            ("abc", "‘abc’ is not a number."),
            ("200 +", "A number is missing at the end."),
            (" ", "Type a length."),
        ] {
            assert_eq!(read_length(text, mm), Err(words.to_owned()), "{text}");
        }
        let said = read_angle("15mm");
        assert_eq!(said, Err("‘mm’ is not a unit of angle: deg or °.".to_owned()));
    }

    #[test]
    fn steps_of_a_grid_are_shown_as_people_say_them() {
        for (mm, units, text) in [
            (50.0, Units::Millimetres, "50 mm"),
            (50.8, Units::Feet, "2 in"),
            (3.175, Units::Inches, "1/8 in"),
            (9.525, Units::Feet, "3/8 in"),
            (609.6, Units::Feet, "2 ft"),
            (38.1, Units::Inches, "1.5 in"),
        ] {
            assert_eq!(step_text(mm, units), text);
            let back = length_in(text, units);
            assert!(back.is_some_and(|back| (back - mm).abs() < 1e-9), "{text}: {back:?}");
        }
    }
}
