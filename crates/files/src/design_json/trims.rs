//! The fields `trims` and `for`: what is done along edges, from a design's file and back.
//!
//! A trade (`for`) has a list of trims with defaults. A trim of the design with the `kind` and the
//! `on` of one of these replaces single fields of it; others come after them. Lengths are numbers
//! in the design's units, or texts: `"10 mm"`, or `"2 t"`, two thicknesses of the sheet.

mod form;
mod read;
mod write;

pub(super) use form::{LengthFile, OneOrMore, TrimFile};
pub(super) use read::{Problem, Reader, problem};

use super::source::Source;
use crate::names::{did_you_mean, shown};
use crate::reading::InputError;
use crate::trade::{trade, trade_names};
use crate::units::Units;
use serde_json::{Map, Value};
use sheetwright::design::{Design, Trim, TrimKind};
use write::file_of;

/// The fields that say where notches and ticks stand, each in a way of its own.
const PLACES: [&str; 3] = ["at", "at_lengths", "every"];

/// A trim as it stands in a file: a JSON object.
pub(super) type Written = Map<String, Value>;

/// The most trims of a design.
const MAX_TRIMS: usize = 1000;
/// The fields that are numbers without a unit.
const PLAIN: [&str; 5] = ["angle_deg", "at", "count", "numbered", "span"];

/// The trims of a design when it is made for another trade, or of another sheet: those that the
/// design has of its own stay, in place of fields of the new trade where they fit. `thickness_mm`
/// is that of its sheet before and now. `None` if there is no such trade.
pub fn trims_for(
    design: &Design,
    trade: Option<&str>,
    thickness_mm: [Option<f64>; 2],
) -> Option<Vec<Trim>> {
    let before = of_trade(design.trade.as_deref(), thickness_mm[0])?;
    let own = own_trims(&before, &design.trims).unwrap_or_else(|| design.trims.iter().collect());
    let mut trims = of_trade(trade, thickness_mm[1])?;
    let count = trims.len();
    for trim in own {
        match trims[..count].iter_mut().find(|of_trade| is_alike(of_trade, trim)) {
            Some(replaced) => *replaced = trim.clone(),
            None => trims.push(trim.clone()),
        }
    }
    Some(trims)
}

/// A trim of this kind with numbers to begin with, for a sheet of this thickness; `None` if there
/// is no such kind.
pub fn usual_trim(kind: &str, thickness_mm: Option<f64>) -> Option<TrimKind> {
    let written = match kind {
        "allowance" => r#"{ "width": 10 }"#,
        "hem" => r#"{ "width": 20, "turn": 10 }"#,
        "flange" => r#"{ "width": 25 }"#,
        "holes" => r#"{ "pitch": 20, "diameter": 2 }"#,
        "fingers" if thickness_mm.is_none() => r#"{ "depth": 3 }"#,
        "slots" if thickness_mm.is_none() => r#"{ "thickness": 3 }"#,
        _ => "{}",
    };
    let mut written: Written = serde_json::from_str(written).ok()?;
    written.insert("on".to_owned(), Value::from("all"));
    written.insert("kind".to_owned(), Value::from(kind));
    let reader = Reader { units: Units::Millimetres, thickness_mm };
    reader.trim(written).ok().map(|trim| trim.kind)
}

/// The trims of a trade, those of none if none is named; `None` if there is no such trade.
fn of_trade(trade: Option<&str>, thickness_mm: Option<f64>) -> Option<Vec<Trim>> {
    trims_of(trade, Vec::new(), Units::Millimetres, thickness_mm).ok()
}

/// Whether two trims are of one kind and on the same edges: then the one of a design stands in
/// place of the one of its trade.
fn is_alike(a: &Trim, b: &Trim) -> bool {
    a.on == b.on && a.kind.name() == b.kind.name()
}

/// The trims that a design has beside those of its trade, those that stand in place of one first.
/// `None` where it has not all of its trade, or one of its own would take the place of another.
fn own_trims<'a>(of_trade: &[Trim], trims: &'a [Trim]) -> Option<Vec<&'a Trim>> {
    let (first, rest) = trims.split_at_checked(of_trade.len())?;
    let is_taken = |trim: &Trim| of_trade.iter().any(|other| is_alike(other, trim));
    let is_whole = of_trade.iter().zip(first).all(|(of_trade, trim)| is_alike(of_trade, trim));
    if !is_whole || rest.iter().any(is_taken) {
        return None;
    }
    let replaced = of_trade.iter().zip(first).filter(|(of_trade, trim)| of_trade != trim);
    Some(replaced.map(|(_, trim)| trim).chain(rest).collect())
}

/// Why a list of trims can't be read: where in it, the problem, and what to do.
pub(crate) type Refused = (String, String, String);

/// The trims of a design with its trade: those that it has of its own replace fields of the
/// trade's. `thickness_mm` is that of its sheet.
pub(crate) fn trims_of(
    trade: Option<&str>,
    own: Vec<Written>,
    units: Units,
    thickness_mm: Option<f64>,
) -> Result<Vec<Trim>, Refused> {
    let trade = match trade {
        None => None,
        Some(name) => Some(self::trade(name).ok_or_else(|| {
            let hint = did_you_mean(name, &trade_names());
            ("for".to_owned(), format!("there is no trade {}", shown(name)), hint)
        })?),
    };
    if own.len() > MAX_TRIMS {
        let hint = format!("The limit is {MAX_TRIMS} trims.");
        return Err(("trims".to_owned(), format!("the design has {} trims", own.len()), hint));
    }
    let thickness_mm = thickness_mm.or(trade.map(|trade| trade.thickness_mm));
    let mut list: Vec<(String, Written, Units)> = Vec::new();
    for (n, written) in trade.into_iter().flat_map(|trade| &trade.trims).enumerate() {
        list.push((format!("for.trims[{n}]"), written.clone(), Units::Millimetres));
    }
    let of_trade = list.len();
    for (n, written) in own.into_iter().enumerate() {
        let path = format!("trims[{n}]");
        let names = |written: &Written| [written.get("kind").cloned(), written.get("on").cloned()];
        let replaced =
            list[..of_trade].iter_mut().find(|(_, other, _)| names(other) == names(&written));
        match replaced {
            None => list.push((path, written, units)),
            Some((place, other, _)) => {
                // The trade's own numbers are mm; those of the design are in its units.
                *place = path;
                // Places are said in one way.
                if PLACES.iter().any(|field| written.contains_key(*field)) {
                    PLACES.iter().for_each(|field| _ = other.remove(*field));
                }
                let is_length = |field: &str| !PLAIN.contains(&field);
                other.extend(written.into_iter().map(|(field, value)| {
                    let value = if is_length(&field) { in_mm(value, units) } else { value };
                    (field, value)
                }));
            }
        }
    }
    let read = |(path, written, units): (String, Written, Units)| {
        let reader = Reader { units, thickness_mm };
        reader.trim(written).map_err(|(message, hint)| (path, message, hint))
    };
    list.into_iter().map(read).collect()
}

/// A length, or a list of some, in mm where it is a number in these units.
fn in_mm(value: Value, units: Units) -> Value {
    match value {
        Value::Array(list) => list.into_iter().map(|value| in_mm(value, units)).collect(),
        value => match value.as_f64() {
            Some(number) => Value::from(number * units.in_mm()),
            None => value,
        },
    }
}

/// Reads the fields `for` and `trims` of a design.
pub(super) fn read(
    trade: Option<&str>,
    own: Vec<Written>,
    units: Units,
    thickness_mm: Option<f64>,
    source: &Source<'_>,
) -> Result<Vec<Trim>, InputError> {
    trims_of(trade, own, units, thickness_mm)
        .map_err(|(path, message, hint)| source.error(&path, message, hint))
}

/// The trade and the trims of a design as its file has them: without those of its trade, and
/// without the trade where those are not there.
pub(super) fn written(
    trade: Option<&str>,
    trims: &[Trim],
    thickness_mm: Option<f64>,
) -> (Option<String>, Vec<TrimFile>) {
    let own = of_trade(trade, thickness_mm).and_then(|of_trade| own_trims(&of_trade, trims));
    match own {
        Some(own) => (trade.map(str::to_owned), own.into_iter().map(file_of).collect()),
        None => (None, trims.iter().map(file_of).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_trade_is_read() {
        for name in trade_names() {
            assert!(!trims_of(Some(name), Vec::new(), Units::Inches, None).unwrap().is_empty());
        }
    }

    #[test]
    fn a_trim_that_replaces_one_of_a_trade_is_in_the_units_of_the_design() {
        let own = r#"{ "on": "joined", "kind": "allowance", "width": [1, 2] }"#;
        let own: Written = serde_json::from_str(own).unwrap();
        let trims = trims_of(Some("sewing"), vec![own], Units::Centimetres, None).unwrap();
        assert_eq!(trims.len(), 3);
        assert!(format!("{:?}", trims[0].kind).contains("width: [10.0, 20.0]"), "{trims:?}");
    }
    fn read(text: &str) -> Design {
        let options = crate::ReadOptions::default();
        let format = crate::InputFormat::Design;
        crate::read_bytes(format, text.as_bytes(), "d.sheet.json", None, &options).unwrap()
    }

    /// A design with these fields beside its panels, of which it has none.
    fn with(fields: &str) -> Design {
        read(&format!(r#"{{ "sheetwright": 1, "panels": [], {fields} }}"#))
    }

    #[test]
    fn a_design_that_replaces_fields_of_its_trade_keeps_the_trade_when_written() {
        let text = r#""for": "boat", "trims": [
            { "on": "joined", "kind": "ticks", "at": [0.25] },
            { "on": "sheer", "kind": "hem", "width": 9 },
            { "on": "joined", "kind": "holes", "pitch": 100 }]"#;
        let design = with(text);
        assert_eq!(design.trims.len(), 3);
        let again = read(std::str::from_utf8(&crate::write_design(&design)).unwrap());
        assert_eq!(again, design);
        assert_eq!(again.trade.as_deref(), Some("boat"));
        // What is its own stays with another trade, in place of what that has there.
        let none = trims_for(&design, None, [None; 2]).unwrap();
        let of = |trims: &[Trim]| -> Vec<&'static str> {
            trims.iter().map(|trim| trim.kind.name()).collect()
        };
        assert_eq!(of(&none), ["holes", "ticks", "hem"]);
        let leather = trims_for(&design, Some("leather"), [None; 2]).unwrap();
        assert_eq!(leather, none);
        assert_eq!(trims_for(&with(r#""for": "boat""#), None, [None; 2]), Some(Vec::new()));
    }

    #[test]
    fn every_kind_has_numbers_to_begin_with() {
        let kinds = [
            "allowance",
            "hem",
            "flange",
            "tabs",
            "holes",
            "notches",
            "ticks",
            "fingers",
            "puzzle",
            "slots",
        ];
        for kind in kinds {
            for thickness_mm in [None, Some(2.0)] {
                assert_eq!(usual_trim(kind, thickness_mm).unwrap().name(), kind);
            }
        }
        assert_eq!(usual_trim("hams", None), None);
    }
}
