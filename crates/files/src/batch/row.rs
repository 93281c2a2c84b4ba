//! A table of panels as it is written: a row for each part, or for what could not be made. The
//! columns are in `docs/batch.md`.

use crate::messages::{FindingFile, ValuesFile, findings_of, line};
use crate::names::is_invisible;
use crate::table::{guarded, number, quoted};
use serde::Serialize;
use sheetwright::check::{Finding, Severity};
use sheetwright::make::{PanelRow, PanelValues};
use std::path::Path;

/// The columns before the values.
const FIRST: [&str; 6] = ["number", "id", "panel", "verdict", "severity", "findings"];
/// The columns of the values, in the order of [`cells_of`].
const VALUES: [&str; 9] = [
    "warp_max_deg",
    "strain_p95",
    "strain_limit",
    "bend_radius_min_mm",
    "area_flat_mm2",
    "area_space_mm2",
    "outline_length_mm",
    "flat_width_mm",
    "flat_height_mm",
];
/// The column of the time, where it is asked for.
const SECONDS: &str = "seconds";
/// The columns behind the values.
const LAST: [&str; 3] = ["source", "error", "hint"];

/// The form of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableForm {
    /// Comma-separated values, with a header line.
    Csv,
    /// A JSON object a line.
    JsonLines,
}

impl TableForm {
    /// The form of a table in a file of this name; `None` for an ending that tells none.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_lowercase();
        match &ending[..] {
            "csv" => Some(Self::Csv),
            "jsonl" | "ndjson" => Some(Self::JsonLines),
            _ => None,
        }
    }
}

/// What a row begins and ends with, beside what was made.
#[derive(Clone, Copy, Debug)]
pub struct RowHead<'a> {
    /// The number of the panel or design among all inputs, from 1.
    pub number: u64,
    /// Its name; no two have one.
    pub id: &'a str,
    /// Where it was read: a file, with a line if it holds several.
    pub source: &'a str,
    /// How long it took, if that is to be told, seconds.
    pub seconds: Option<f64>,
}

/// Why there is an error in place of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowError {
    /// What is wrong and where, in words.
    pub message: String,
    /// What to do.
    pub hint: String,
}

/// How the rows of a table are written.
#[derive(Clone, Copy, Debug)]
pub struct TableRows {
    /// Its form.
    pub form: TableForm,
    /// Whether it has a column for the time.
    pub has_seconds: bool,
}

#[derive(Serialize)]
struct JsonRow<'a> {
    number: u64,
    id: &'a str,
    panel: Option<&'a str>,
    verdict: Option<&'a str>,
    severity: Option<&'a str>,
    findings: Vec<FindingFile<'a>>,
    #[serde(flatten)]
    values: ValuesFile,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    source: &'a str,
    error: Option<&'a str>,
    hint: Option<&'a str>,
}

impl TableRows {
    /// What the table begins with: the names of the columns, in CSV.
    pub fn header(self) -> Vec<u8> {
        match self.form {
            TableForm::Csv => {
                let seconds = self.has_seconds.then_some(SECONDS);
                let names = FIRST.iter().chain(&VALUES).chain(seconds.as_ref()).chain(&LAST);
                let names: Vec<&str> = names.copied().collect();
                (names.join(",") + "\n").into_bytes()
            }
            TableForm::JsonLines => Vec::new(),
        }
    }

    /// What the rows of a panel or a design begin with.
    pub fn begins(self, head: &RowHead<'_>) -> Vec<u8> {
        match self.form {
            TableForm::Csv => format!("{},{},", head.number, cell(head.id)).into_bytes(),
            TableForm::JsonLines => {
                let id = line(&head.id);
                format!("{{\"number\":{},\"id\":{},", head.number, id.trim_end()).into_bytes()
            }
        }
    }

    /// The rows of the parts that were made.
    pub fn made(self, head: &RowHead<'_>, rows: &[PanelRow]) -> Vec<u8> {
        let share = head.seconds.map(|seconds| seconds / rows.len().max(1) as f64);
        let head = &RowHead { seconds: share, ..*head };
        rows.iter().flat_map(|row| self.row(head, Ok(row))).collect()
    }

    /// The row of what could not be made.
    pub fn failed(self, head: &RowHead<'_>, error: &RowError) -> Vec<u8> {
        self.row(head, Err(error))
    }

    fn row(self, head: &RowHead<'_>, made: Result<&PanelRow, &RowError>) -> Vec<u8> {
        let (row, error) = (made.ok(), made.err());
        let seconds = head.seconds.filter(|_| self.has_seconds);
        let severity = row.and_then(PanelRow::severity).map(Severity::name);
        let verdict = row.map(|row| row.verdict.name());
        let panel = row.map(|row| &row.panel[..]);
        let findings = row.map_or(&[][..], |row| &row.findings);
        let values = row.map(|row| &row.values);
        let RowHead { number: at, id, source, .. } = *head;
        let (error, hint) = (error.map(|e| &e.message[..]), error.map(|e| &e.hint[..]));
        if self.form == TableForm::JsonLines {
            let values = values.map(ValuesFile::of).unwrap_or_default();
            let findings = findings_of(findings);
            let row = JsonRow {
                number: at,
                id,
                panel,
                verdict,
                severity,
                findings,
                values,
                seconds,
                source,
                error,
                hint,
            };
            return line(&row).into_bytes();
        }
        let codes: Vec<&str> = findings.iter().map(Finding::code).collect();
        let text = |text: Option<&str>| cell(text.unwrap_or(""));
        let first = [at.to_string(), cell(id), text(panel), text(verdict), text(severity)];
        let time = self.has_seconds.then(|| seconds.map_or_else(String::new, number));
        let cells = first
            .into_iter()
            .chain([codes.join("; ")])
            .chain(cells_of(values))
            .chain(time)
            .chain([cell(source), text(error), text(hint)]);
        (cells.collect::<Vec<_>>().join(",") + "\n").into_bytes()
    }
}

fn cells_of(values: Option<&PanelValues>) -> [String; VALUES.len()] {
    let Some(values) = values else { return Default::default() };
    [
        values.warp_max_deg,
        values.strain_p95,
        Some(values.strain_limit),
        values.bend_radius_min_mm,
        Some(values.area_flat_mm2),
        Some(values.area_space_mm2),
        Some(values.outline_length_mm),
        Some(values.flat_width_mm),
        Some(values.flat_height_mm),
    ]
    .map(|value| value.map_or_else(String::new, number))
}

/// A text as a cell that is one line and no formula.
fn cell(text: &str) -> String {
    let line: String = text.chars().map(|c| if is_invisible(c) { '\u{fffd}' } else { c }).collect();
    quoted(&guarded(&line))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::check::Verdict;

    fn values() -> PanelValues {
        PanelValues {
            warp_max_deg: Some(0.1),
            strain_p95: None,
            strain_limit: 0.002,
            bend_radius_min_mm: None,
            area_flat_mm2: 1e20,
            area_space_mm2: 2.5,
            outline_length_mm: 7.0,
            flat_width_mm: 3.0,
            flat_height_mm: 1.0 / 3.0,
        }
    }

    const HEAD: RowHead<'_> =
        RowHead { number: 7, id: "=a,\n\"b\"", source: "t.csv:2", seconds: Some(0.5) };

    #[test]
    fn a_row_is_one_line_in_both_forms() {
        let row = PanelRow {
            panel: "p".to_owned(),
            verdict: Verdict::Bends,
            findings: Vec::new(),
            values: values(),
        };
        let error = RowError { message: "no".to_owned(), hint: "do".to_owned() };
        for form in [TableForm::Csv, TableForm::JsonLines] {
            for has_seconds in [false, true] {
                let rows = TableRows { form, has_seconds };
                let written =
                    [rows.made(&HEAD, &[row.clone(), row.clone()]), rows.failed(&HEAD, &error)];
                let text = String::from_utf8(written.concat()).unwrap();
                assert_eq!(text.lines().count(), 3);
                let begins = String::from_utf8(rows.begins(&HEAD)).unwrap();
                assert!(text.lines().all(|line| line.starts_with(&begins)), "{begins} {text}");
                assert_eq!(
                    text.contains(if form == TableForm::Csv { ",0.25," } else { ":0.25" }),
                    has_seconds
                );
            }
        }
        let rows = TableRows { form: TableForm::Csv, has_seconds: false };
        let text = String::from_utf8(rows.made(&HEAD, &[row])).unwrap();
        let expected = "7,\"'=a,\u{fffd}\"\"b\"\"\",p,bends,,,0.1,,0.002,,1e20,2.5,7,3,\
                        0.3333333333333333,t.csv:2,,\n";
        assert_eq!(text, expected);
        let header = String::from_utf8(rows.header()).unwrap();
        let record = |text: &str| {
            csv::ReaderBuilder::new()
                .has_headers(false)
                .from_reader(text.as_bytes())
                .records()
                .next()
                .unwrap()
                .unwrap()
        };
        assert_eq!(record(&header).len(), record(&text).len());
    }
}
