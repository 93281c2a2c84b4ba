//! The fields `trims` and `for`: what is done along edges, from a design's file and back.
//!
//! A trade (`for`) is a list of trims with defaults, of which `trades.json` holds one for each. A
//! trim of the design with the `kind` and the `on` of one of these replaces single fields of it;
//! others come after them. Lengths are numbers in the design's units, or texts: `"10 mm"`, or
//! `"2 t"`, two thicknesses of the sheet.

mod form;
mod read;
mod write;

pub(super) use form::TrimFile;

use super::source::Source;
use crate::names::{did_you_mean, shown};
use crate::reading::InputError;
use crate::units::Units;
use read::Reader;
use serde::Deserialize;
use serde_json::{Map, Value};
use sheetwright::design::{Design, Trim};
use std::collections::BTreeMap;
use std::sync::OnceLock;
use write::file_of;

/// A trim as it stands in a file: a JSON object.
pub(super) type Written = Map<String, Value>;

/// The most trims of a design.
const MAX_TRIMS: usize = 1000;
/// The fields that are numbers without a unit.
const PLAIN: [&str; 5] = ["angle_deg", "at", "count", "numbered", "span"];

/// A trade: what people of one kind do along the edges of their patterns.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Trade {
    /// What it is for, in a line.
    title: String,
    /// The thickness that its trims reckon with where no material is named, mm.
    thickness_mm: f64,
    /// Its trims.
    trims: Vec<Written>,
}

/// The trades, by name.
///
/// # Panics
/// Where the list of the program itself can't be read, which its tests show.
fn trades() -> &'static BTreeMap<String, Trade> {
    static TRADES: OnceLock<BTreeMap<String, Trade>> = OnceLock::new();
    TRADES.get_or_init(|| match serde_json::from_str(include_str!("../trades.json")) {
        Ok(trades) => trades,
        Err(error) => panic!("trades.json: {error}"),
    })
}

/// The names of the trades, in order.
pub fn trade_names() -> Vec<&'static str> {
    trades().keys().map(String::as_str).collect()
}

/// What a trade is for, in a line; `None` if there is none of this name.
pub fn trade_title(name: &str) -> Option<&'static str> {
    trades().get(name).map(|trade| trade.title.as_str())
}

/// The trims of a design when it is made for another trade, or of another material: those of the
/// trade that it had give way to those of the new one, its own stay. `thickness_mm` is that of its
/// sheet before and now. `None` if there is no such trade.
pub fn trims_for(
    design: &Design,
    trade: Option<&str>,
    thickness_mm: [Option<f64>; 2],
) -> Option<Vec<Trim>> {
    let of = |trade: Option<&str>, thickness_mm| {
        trims_of(trade, Vec::new(), Units::Millimetres, thickness_mm).ok()
    };
    let before = of(design.trade.as_deref(), thickness_mm[0])?;
    let own = design.trims.strip_prefix(&before[..]).unwrap_or(&design.trims);
    let mut trims = of(trade, thickness_mm[1])?;
    trims.extend_from_slice(own);
    Some(trims)
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
    let known = trades();
    let trade = match trade {
        None => None,
        Some(name) => Some(known.get(name).ok_or_else(|| {
            let names: Vec<&str> = known.keys().map(String::as_str).collect();
            let hint = did_you_mean(name, &names);
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

/// The trims of a design as its file has them: without those of its trade, if it has them as
/// they are.
pub(super) fn written(
    trade: Option<&str>,
    trims: &[Trim],
    thickness_mm: Option<f64>,
) -> (Option<String>, Vec<TrimFile>) {
    let of_trade =
        trims_of(trade, Vec::new(), Units::Millimetres, thickness_mm).unwrap_or_default();
    let has_all = trims.starts_with(&of_trade);
    let rest = if has_all { &trims[of_trade.len()..] } else { trims };
    let trade = trade.filter(|_| has_all).map(str::to_owned);
    (trade, rest.iter().map(file_of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The trims of a trade as a row of the table in `docs/trims.md`.
    fn row(name: &str, trade: &Trade) -> String {
        let trim = |trim: &Written| {
            let fields = trim.iter().filter(|(field, _)| !["on", "kind"].contains(&field.as_str()));
            let said = |value: &Value| value.as_str().map_or(value.to_string(), str::to_owned);
            let fields: Vec<String> =
                fields.map(|(field, value)| format!("{field} {}", said(value))).collect();
            format!("`{}` on {}: {}", said(&trim["kind"]), said(&trim["on"]), fields.join(", "))
        };
        let trims: Vec<String> = trade.trims.iter().map(trim).collect();
        format!("| `{name}` | {} | {} |\n", trade.title, trims.join("; "))
    }

    /// With `SHEETWRIGHT_REWRITE=1`, writes the table anew.
    #[test]
    fn the_docs_have_every_trade_with_its_numbers() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/trims.md");
        let text = std::fs::read_to_string(path).unwrap().replace('\r', "");
        let head = "| `for` | what for | trims |\n|---|---|---|\n";
        let (before, _) = text.split_once(head).unwrap();
        let rows: String = trades().iter().map(|(name, trade)| row(name, trade)).collect();
        let wanted = format!("{before}{head}{rows}");
        if std::env::var_os("SHEETWRIGHT_REWRITE").is_some() {
            std::fs::write(path, &wanted).unwrap();
            return;
        }
        assert!(text == wanted, "docs/trims.md differs from trades.json: SHEETWRIGHT_REWRITE=1");
    }

    #[test]
    fn every_trade_is_read() {
        for name in trade_names() {
            assert!(!trims_of(Some(name), Vec::new(), Units::Inches, None).unwrap().is_empty());
            assert!(trade_title(name).is_some());
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
}
