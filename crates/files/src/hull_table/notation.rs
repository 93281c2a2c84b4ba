//! Lengths as builders write them in the cells of a table: `2-3-5` (feet, inches, eighths),
//! `1-10-2+`, `23 3/4`, `1'-4 1/2"`, `12,5`, `40 cm`.
//!
//! What a cell says by itself is kept apart from what only the table can say: a number without a
//! unit stays one until the unit of the whole table is known.

use crate::quantity::{plain, read_length};
use crate::units::Units;

/// What a cell holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell {
    /// Nothing is there: an empty cell, `x`, `-` and the like.
    None,
    /// A length in mm, whose notation says its unit.
    Length {
        /// The length, mm.
        mm: f64,
        /// Whether it is in feet and inches.
        is_feet: bool,
    },
    /// A number without a unit.
    Bare {
        /// The number.
        number: f64,
        /// Whether it has a fraction such as 3/4, as inches have.
        has_fraction: bool,
    },
    /// No length: why, as the rest of a sentence.
    Wrong(String),
    /// A text that does not begin with a number.
    Text,
}

/// Texts that stand for "no value".
const NONE: [&str; 12] = ["", "x", "-", "--", "–", "—", "−", "*", ".", "n/a", "none", "xx"];

/// Fractions that have a character of their own.
const FRACTIONS: [(char, &str); 9] = [
    ('½', "1/2"),
    ('¼', "1/4"),
    ('¾', "3/4"),
    ('⅛', "1/8"),
    ('⅜', "3/8"),
    ('⅝', "5/8"),
    ('⅞', "7/8"),
    ('⅓', "1/3"),
    ('⅔', "2/3"),
];

/// Reads a cell; `decimal_comma` says that commas in its numbers are decimal points.
pub(super) fn cell(text: &str, decimal_comma: bool) -> Cell {
    let text = text.trim();
    if NONE.contains(&text.to_lowercase().as_str()) {
        return Cell::None;
    }
    let text = in_ascii(text);
    let first = text.trim_start_matches('-').trim_start();
    if !first.starts_with(|c: char| c.is_ascii_digit() || c == '.' || c == ',') {
        return Cell::Text;
    }
    if let Some(read) = eighths(&text) {
        return read;
    }
    let number = if decimal_comma && is_decimal_comma(&text) {
        text.replacen(',', ".", 1)
    } else {
        text.clone()
    };
    with_marks(&number).unwrap_or_else(|| with_unit(&number))
}

/// Whether a text is a number with one comma between digits.
pub(super) fn is_decimal_comma(text: &str) -> bool {
    let text = text.trim().trim_start_matches(['-', '−']);
    text.split_once(',').is_some_and(|(whole, part)| {
        let digits = |text: &str| text.chars().all(|c| c.is_ascii_digit());
        !part.is_empty() && digits(whole) && digits(part)
    })
}

/// Whether a text is a number whose comma can only be a decimal point.
pub(super) fn shows_decimal_comma(text: &str) -> bool {
    let part = text.trim().split_once(',').map_or("", |(_, part)| part);
    is_decimal_comma(text) && (part.len() != 3 || text.trim_start_matches('-').starts_with('0'))
}

/// The text with the marks of feet and inches, dashes and fractions in ASCII.
fn in_ascii(text: &str) -> String {
    let mut ascii = String::new();
    for c in text.chars() {
        let fraction = FRACTIONS.iter().find(|(sign, _)| *sign == c);
        match (c, fraction) {
            (_, Some((_, fraction))) => {
                // 4½ is four and a half.
                if ascii.ends_with(|c: char| c.is_ascii_digit()) {
                    ascii.push(' ');
                }
                ascii.push_str(fraction);
            }
            ('′' | '’' | '‘' | '`', _) => ascii.push('\''),
            ('″' | '”' | '“', _) => ascii.push('"'),
            ('–' | '—' | '−' | '‐' | '‑', _) => ascii.push('-'),
            (c, _) if c.is_whitespace() => ascii.push(' '),
            (c, _) => ascii.push(c),
        }
    }
    ascii.replace("''", "\"")
}

/// Feet, inches and eighths; `None` if the text is not of that form.
fn eighths(text: &str) -> Option<Cell> {
    let (sign, rest) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest.trim_start()),
        None => (1.0, text),
    };
    // A sixteenth more or less.
    let (rest, more) = match (rest.strip_suffix('+'), rest.strip_suffix('-')) {
        (Some(rest), _) => (rest.trim_end(), 1.0),
        (_, Some(rest)) => (rest.trim_end(), -1.0),
        _ => (rest, 0.0),
    };
    let (rest, half) = match rest.strip_suffix("1/2").map(str::trim_end) {
        Some(whole) if more == 0.0 && whole.matches(['-', ',', ':']).count() == 2 => (whole, 1.0),
        _ => (rest, 0.0),
    };
    let between = ['-', ',', ':', '.', ' ', '/'].into_iter().find(|&c| rest.contains(c))?;
    let parts: Vec<&str> = rest.split(between).map(str::trim).collect();
    let is_number = |part: &&str| (1..=4).contains(&part.len()) && is_whole(part);
    if !parts.iter().all(is_number) {
        return None;
    }
    let numbers: Vec<u32> = parts.iter().filter_map(|part| part.parse().ok()).collect();
    match numbers[..] {
        [a, b, c] if is_date([a, b, c]) => Some(Cell::Wrong(
            "looks like a date, as spreadsheets make of feet-inches-eighths".to_owned(),
        )),
        [feet, inches, eighths] if inches < 12 && eighths < 8 => {
            let sixteenths = f64::from(feet * 192 + inches * 16 + eighths * 2) + more + half;
            // An inch is 254 tenths of a millimetre, so that 24 inches are exactly 609.6 mm.
            Some(Cell::Length { mm: sign * sixteenths * 254.0 / 160.0, is_feet: true })
        }
        [_, inches, eighths] if between == '-' || between == ':' => {
            Some(Cell::Wrong(if inches >= 12 {
                format!("has {inches} inches in feet-inches-eighths, where 11 are the most")
            } else {
                format!("has {eighths} eighths in feet-inches-eighths, where 7 are the most")
            }))
        }
        [_, _] if between == '-' => Some(Cell::Wrong(
            "has two parts, which may be feet and inches or inches and eighths".to_owned(),
        )),
        _ => None,
    }
}

/// Whether three numbers are a date of our time: year, month and day in some order.
fn is_date([a, b, c]: [u32; 3]) -> bool {
    let is_year = |n: u32| (1900..=2099).contains(&n);
    let are_days = |m: u32, d: u32| (1..=31).contains(&m) && (1..=31).contains(&d);
    (is_year(a) && are_days(b, c)) || (is_year(c) && are_days(a, b))
}

fn is_whole(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_digit())
}

/// Feet and inches by their marks: `1' 4"`, `1'-4 1/2"`, `1'-4 1/2`; `None` without a mark.
fn with_marks(text: &str) -> Option<Cell> {
    if !text.contains(['\'', '"']) {
        return None;
    }
    let (sign, rest) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest.trim()),
        None => (1.0, text.trim()),
    };
    // The hyphen behind the feet is no minus.
    let mut typed = match rest.split_once('\'') {
        Some((feet, inches)) => {
            let inches = inches.trim_start().strip_prefix('-').unwrap_or(inches).trim();
            format!("{feet}' {inches}")
        }
        None => rest.to_owned(),
    };
    typed = typed.trim().to_owned();
    // The mark of the inches may be left out.
    if typed.ends_with(|c: char| c.is_ascii_digit()) {
        typed.push('"');
    }
    Some(match read_length(&typed, Units::Inches) {
        Ok(mm) => Cell::Length { mm: sign * mm, is_feet: true },
        Err(why) => Cell::Wrong(as_rest(&why)),
    })
}

/// A number, with a unit in letters or without one.
fn with_unit(text: &str) -> Cell {
    let inside = text.trim_start_matches('-');
    let is_sum = inside.char_indices().any(|(at, c)| {
        let before = inside[..at].chars().next_back();
        let is_power = before.is_some_and(|c| c.eq_ignore_ascii_case(&'e'));
        let is_mixed = c == '-' && inside[at..].contains('/');
        matches!(c, '+' | '-') && !is_power && !is_mixed
    });
    if is_sum {
        return Cell::Wrong("is no length".to_owned());
    }
    if text.contains(|c: char| c.is_alphabetic() && !c.eq_ignore_ascii_case(&'e')) {
        return match read_length(text, Units::Millimetres) {
            Ok(mm) => {
                let lower = text.to_lowercase();
                let is_feet = ["in", "ft", "foot", "feet"].iter().any(|unit| lower.contains(unit));
                Cell::Length { mm, is_feet }
            }
            Err(why) => Cell::Wrong(as_rest(&why)),
        };
    }
    match plain(text) {
        Ok(number) => Cell::Bare { number, has_fraction: text.contains('/') },
        Err(slip) => Cell::Wrong(
            slip.advice("number").map_or_else(|| "is no length".to_owned(), |why| as_rest(&why)),
        ),
    }
}

/// The sentence about a text as the rest of one that begins with it.
fn as_rest(sentence: &str) -> String {
    format!("is no length: {}", sentence.trim_end_matches('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inches(text: &str) -> Option<f64> {
        match cell(text, false) {
            Cell::Length { mm, .. } => Some(mm / 25.4),
            _ => None,
        }
    }

    #[test]
    fn feet_inches_and_eighths_are_read_as_builders_write_them() {
        for (text, value) in [
            ("2-3-5", 27.625),
            ("2-3-5+", 27.6875),
            ("2-3-5-", 27.5625),
            ("1-10-2+", 22.3125),
            ("-0-2-2", -2.25),
            ("0,7,6", 7.75),
            ("1.10.2", 22.25),
            ("1 10 2", 22.25),
            ("1:10:2", 22.25),
            ("2–3–5", 27.625),
            ("2-3-5½", 27.6875),
            ("2-3-5 1/2", 27.6875),
            ("0-0-0", 0.0),
            ("12-11-7", 155.875),
        ] {
            let read = inches(text);
            assert!(read.is_some_and(|read| (read - value).abs() < 1e-12), "{text}: {read:?}");
        }
    }

    #[test]
    fn feet_and_inches_with_marks_or_units() {
        for (text, value) in [
            ("1' 4\"", 16.0),
            ("1'-4 1/2\"", 16.5),
            ("1' 4 1/2\"", 16.5),
            ("1'-4½\"", 16.5),
            ("1'4", 16.0),
            ("1'-10-1/2\"", 22.5),
            ("-1' 4\"", -16.0),
            ("2'", 24.0),
            ("9 3/8\"", 9.375),
            ("2 ft 3 in", 27.0),
            ("27.5in", 27.5),
            ("1’-4”", 16.0),
        ] {
            let read = inches(text);
            assert!(read.is_some_and(|read| (read - value).abs() < 1e-12), "{text}: {read:?}");
        }
        assert_eq!(cell("40 cm", false), Cell::Length { mm: 400.0, is_feet: false });
    }

    #[test]
    fn bare_numbers_wait_for_the_unit_of_the_table() {
        let bare = |number, has_fraction| Cell::Bare { number, has_fraction };
        for (text, read) in [
            ("23 3/4", bare(23.75, true)),
            ("23-3/4", bare(23.75, true)),
            ("5/8", bare(0.625, true)),
            ("-12.5", bare(-12.5, false)),
            ("12,5", bare(12.5, false)),
            ("1e3", bare(1000.0, false)),
            ("0", bare(0.0, false)),
        ] {
            assert_eq!(cell(text, false), read, "{text}");
        }
        assert_eq!(cell("1,250", true), bare(1.25, false));
        assert!(matches!(cell("1,250", false), Cell::Wrong(_)));
    }

    #[test]
    fn what_is_none_and_what_is_wrong() {
        for text in ["", " ", "x", "X", "-", "–", "—", "n/a"] {
            assert_eq!(cell(text, false), Cell::None, "{text:?}");
        }
        for (text, why) in [
            ("2-13-1", "13 inches"),
            ("2-3-8", "8 eighths"),
            ("3-5", "two parts"),
            ("2005-02-03", "date"),
            ("2/3/2005", "date"),
            ("12 kg", "no length"),
            ("1 250", "separators"),
            ("12?", "no length"),
        ] {
            let Cell::Wrong(said) = cell(text, false) else { panic!("{text}") };
            assert!(said.contains(why), "{text}: {said}");
        }
        assert_eq!(cell("Sheer", false), Cell::Text);
    }
}
