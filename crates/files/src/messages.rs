//! Messages of the command to other programs: errors, findings and times as JSON. docs/files.md
//! lists the fields.

use crate::names::is_invisible;
use crate::words::{finding_place, finding_text};
use serde::Serialize;
use sheetwright::check::{Checked, Finding};
use sheetwright::make::{Made, PanelValues};

#[derive(Serialize)]
struct ErrorFile<'a> {
    error: &'a str,
    #[serde(rename = "where", skip_serializing_if = "Option::is_none")]
    place: Option<&'a str>,
    hint: &'a str,
}

#[derive(Serialize)]
struct FindingsFile<'a> {
    sheetwright: u32,
    name: &'a str,
    panels: Vec<PanelFile<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    files: Option<&'a [String]>,
}

#[derive(Serialize)]
struct PanelFile<'a> {
    name: &'a str,
    verdict: &'a str,
    findings: Vec<FindingFile<'a>>,
    #[serde(flatten)]
    values: ValuesFile,
}

#[derive(Serialize)]
pub(crate) struct FindingFile<'a> {
    severity: &'a str,
    code: &'a str,
    text: String,
    #[serde(rename = "where")]
    place: String,
}

/// Values of a panel, called as in `report.json`; none where there is no panel.
#[derive(Default, Serialize)]
pub(crate) struct ValuesFile {
    warp_max_deg: Option<f64>,
    strain_p95: Option<f64>,
    strain_limit: Option<f64>,
    bend_radius_min_mm: Option<f64>,
    area_flat_mm2: Option<f64>,
    area_space_mm2: Option<f64>,
    outline_length_mm: Option<f64>,
    flat_width_mm: Option<f64>,
    flat_height_mm: Option<f64>,
}

impl ValuesFile {
    pub(crate) fn of(values: &PanelValues) -> Self {
        Self {
            warp_max_deg: values.warp_max_deg,
            strain_p95: values.strain_p95,
            strain_limit: Some(values.strain_limit),
            bend_radius_min_mm: values.bend_radius_min_mm,
            area_flat_mm2: Some(values.area_flat_mm2),
            area_space_mm2: Some(values.area_space_mm2),
            outline_length_mm: Some(values.outline_length_mm),
            flat_width_mm: Some(values.flat_width_mm),
            flat_height_mm: Some(values.flat_height_mm),
        }
    }
}

/// How long each stage of a panel took, in seconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PanelTimes {
    /// The panel.
    pub name: String,
    /// From curves to a triangulation.
    pub solve: f64,
    /// Moving samples within their limits. The time of panels that move together is divided evenly.
    pub vary: f64,
    /// Laying the surface flat, measuring and checking it.
    pub flatten: f64,
    /// Making and writing its files. The time of shared files is divided evenly.
    pub write: f64,
}

#[derive(Serialize)]
struct TimingFile<'a> {
    panels: &'a [PanelTimes],
    total: f64,
}

/// An error as one line of JSON: `{"error": …, "where": …, "hint": …}`.
pub fn error_json(message: &str, place: Option<&str>, hint: &str) -> String {
    line(&ErrorFile { error: message, place, hint })
}

/// The verdict, the findings and the main values of every part as one line of JSON, called as in
/// `report.json`. `checked` has one entry a part; `files` are the written files, `None` where the
/// command writes none.
pub fn findings_json(made: &Made, checked: &[Checked], files: Option<&[String]>) -> String {
    let panels = made.parts.iter().zip(checked).map(|(part, checked)| PanelFile {
        name: &part.name,
        verdict: checked.verdict.name(),
        findings: findings_of(&checked.findings),
        values: ValuesFile::of(&PanelValues::of(part, made.material.as_ref())),
    });
    line(&FindingsFile { sheetwright: 1, name: &made.name, panels: panels.collect(), files })
}

pub(crate) fn findings_of(findings: &[Finding]) -> Vec<FindingFile<'_>> {
    let of = |f: &'_ Finding| FindingFile {
        severity: f.severity().name(),
        code: f.code(),
        text: finding_text(f),
        place: finding_place(f),
    };
    findings.iter().map(of).collect()
}

/// `timing.json`: how long each panel and the whole took, in seconds.
pub fn timing_json(panels: &[PanelTimes], total: f64) -> Vec<u8> {
    line(&TimingFile { panels, total }).into_bytes()
}

/// One line of JSON. Texts and finite numbers always serialise. Control and invisible characters
/// are escaped, also where JSON does not require it.
pub(crate) fn line(value: &impl Serialize) -> String {
    let json = serde_json::to_string(value).unwrap_or_default();
    let mut line = String::with_capacity(json.len() + 1);
    for c in json.chars() {
        if is_invisible(c) {
            // All of them have at most four hexadecimal digits.
            line.push_str(&format!("\\u{:04x}", u32::from(c)));
        } else {
            line.push(c);
        }
    }
    line + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_one_line() {
        assert_eq!(
            error_json("a \"b\"\nc", Some("f.csv:2"), "do"),
            "{\"error\":\"a \\\"b\\\"\\nc\",\"where\":\"f.csv:2\",\"hint\":\"do\"}\n"
        );
        let odd = error_json("a\u{9b}\u{202e}\u{1b}", None, "do");
        assert_eq!(odd, "{\"error\":\"a\\u009b\\u202e\\u001b\",\"hint\":\"do\"}\n");
        assert_eq!(error_json("a", None, "do"), "{\"error\":\"a\",\"hint\":\"do\"}\n");
    }

    #[test]
    fn times_are_as_the_contract_says() {
        let panel = PanelTimes { name: "bottom".into(), solve: 0.5, ..PanelTimes::default() };
        assert_eq!(
            String::from_utf8(timing_json(&[panel], 0.75)).unwrap(),
            "{\"panels\":[{\"name\":\"bottom\",\"solve\":0.5,\"vary\":0.0,\"flatten\":0.0,\
             \"write\":0.0}],\"total\":0.75}\n"
        );
    }
}
