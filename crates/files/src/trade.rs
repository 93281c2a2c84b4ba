//! Trades: what people of one kind do along the edges of their patterns, and which files they need.
//!
//! A trade is an entry of `trades.json`. A design names one (`for`), and each of its fields gives
//! way to a field of the design, which gives way to an option of the call.

use crate::format::Format;
use crate::preset::{DxfRelease, Preset};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A trade.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Trade {
    /// What it is for, in a line.
    pub(crate) title: String,
    /// The thickness that its trims reckon with where no material is named, mm.
    pub(crate) thickness_mm: f64,
    /// Its trims, as a design has them.
    pub(crate) trims: Vec<Map<String, Value>>,
    /// The names of the formats that are written.
    formats: Vec<String>,
    /// The preset of its SVG and DXF files. Default: generic.
    #[serde(default)]
    preset: Option<String>,
    /// The release of its DXF files. Default: that of the preset.
    #[serde(default)]
    dxf: Option<String>,
}

impl Trade {
    /// The formats that are written.
    pub(crate) fn formats(&self) -> Vec<Format> {
        self.formats.iter().filter_map(|name| Format::from_name(name)).collect()
    }

    /// The preset of its SVG and DXF files, if it has one.
    pub(crate) fn preset(&self) -> Option<&'static Preset> {
        self.preset.as_deref().and_then(Preset::from_name)
    }

    /// The release of its DXF files, if it has one.
    pub(crate) fn dxf(&self) -> Option<DxfRelease> {
        self.dxf.as_deref().and_then(DxfRelease::from_name)
    }
}

/// The trades, by name.
///
/// # Panics
/// Where the list of the program itself can't be read, which its tests show.
pub(crate) fn trades() -> &'static BTreeMap<String, Trade> {
    static TRADES: OnceLock<BTreeMap<String, Trade>> = OnceLock::new();
    TRADES.get_or_init(|| match serde_json::from_str(include_str!("trades.json")) {
        Ok(trades) => trades,
        Err(error) => panic!("trades.json: {error}"),
    })
}

/// The trade of a name.
pub(crate) fn trade(name: &str) -> Option<&'static Trade> {
    trades().get(name)
}

/// The names of the trades, in order.
pub fn trade_names() -> Vec<&'static str> {
    trades().keys().map(String::as_str).collect()
}

/// What a trade is for, in a line; `None` if there is none of this name.
pub fn trade_title(name: &str) -> Option<&'static str> {
    trade(name).map(|trade| trade.title.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_trades_name_is_known() {
        for (name, trade) in trades() {
            assert_eq!(trade.formats().len(), trade.formats.len(), "{name}");
            assert!(trade.formats().is_sorted() && trade.formats().contains(&Format::Report));
            assert_eq!(trade.preset().is_some(), trade.preset.is_some(), "{name}");
            assert_eq!(trade.dxf().is_some(), trade.dxf.is_some(), "{name}");
        }
    }
    /// A value of a trim in words: a number is a length, an angle or a list.
    fn said(field: &str, value: &Value) -> String {
        match value {
            Value::Number(number) if field == "angle_deg" => format!("{number}°"),
            Value::Number(number) => format!("{number} mm"),
            Value::String(text) => text.clone(),
            other => other.to_string(),
        }
    }

    /// The numbers of a trade, a row each.
    fn numbers(trade: &Trade) -> String {
        let mut rows = "| what | on | field | value |\n|---|---|---|---|\n".to_owned();
        for trim in &trade.trims {
            let mut what = format!("| `{}` | {} |", said("", &trim["kind"]), said("", &trim["on"]));
            for (field, value) in
                trim.iter().filter(|(field, _)| !["on", "kind"].contains(&&field[..]))
            {
                rows.push_str(&format!("{what} `{field}` | {} |\n", said(field, value)));
                what = "| | |".to_owned();
            }
        }
        let files = [
            ("formats", Some(trade.formats.join(", "))),
            ("preset", trade.preset.clone()),
            ("dxf", trade.dxf.clone()),
        ];
        let mut what = "| files | |";
        for (field, value) in files {
            if let Some(value) = value {
                rows.push_str(&format!("{what} `{field}` | {value} |\n"));
                what = "| | |";
            }
        }
        rows + &format!(
            "| sheet | | `thickness` | {} mm, where the design says none |\n",
            trade.thickness_mm
        )
    }

    /// Compares what a page of the docs has from this line on; with `SHEETWRIGHT_REWRITE=1`, writes
    /// it.
    fn assert_page_ends(name: &str, head: &str, wanted: &str) {
        let path = format!("{}/../../docs/{name}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap().replace('\r', "");
        let kept = text.split_once(head).map_or(&text[..], |(before, _)| before);
        let wanted = format!("{kept}{wanted}");
        if std::env::var_os("SHEETWRIGHT_REWRITE").is_some() {
            std::fs::write(path, &wanted).unwrap();
            return;
        }
        assert!(text == wanted, "docs/{name} differs from trades.json: SHEETWRIGHT_REWRITE=1");
    }

    #[test]
    fn the_docs_have_every_trade_with_its_numbers() {
        let head = "| `for` | what for | along edges | files |\n";
        let mut table = format!("{head}|---|---|---|---|\n");
        for (name, trade) in trades() {
            let head = "| what | on | field | value |\n";
            assert_page_ends(&format!("trades/{name}.md"), head, &numbers(trade));
            let trims = trade
                .trims
                .iter()
                .map(|trim| format!("{} on {}", said("", &trim["kind"]), said("", &trim["on"])));
            let trims: Vec<String> = trims.collect();
            let files = [&trade.preset, &trade.dxf]
                .into_iter()
                .flatten()
                .fold(trade.formats.join(", "), |files, of_drawings| {
                    format!("{files}; {of_drawings}")
                });
            let (title, trims) = (&trade.title, trims.join(", "));
            table.push_str(&format!(
                "| [`{name}`](trades/{name}.md) | {title} | {trims} | {files} |\n"
            ));
        }
        assert_page_ends("trades.md", head, &table);
    }
}
