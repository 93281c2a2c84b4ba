//! Marks on faces, from a design to files that read back.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::{Finding, Severity};
use sheetwright::design::Design;
use sheetwright::make::{Made, make};
use sheetwright::pattern::{LabelKind, PathKind};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, InputFormat, OutputOptions, ReadOptions, finding_text, hint_for, output_files,
    read_bytes, write_design, write_svg,
};
use std::path::Path;

fn root() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The design in `docs/marks.md`.
fn of_docs() -> String {
    let text = std::fs::read_to_string(root().join("docs/marks.md")).unwrap();
    let (_, json) = text.split_once("```json\n").unwrap();
    json.split_once("```").unwrap().0.to_owned()
}

fn read(text: &str) -> Result<Design, String> {
    let options = ReadOptions::default();
    read_bytes(InputFormat::Design, text.as_bytes(), "d.sheet.json", None, &options)
        .map_err(|error| format!("{error} {}", error.hint))
}

/// That design with another list of marks.
fn with(marks: &str) -> Result<Design, String> {
    let mut design: serde_json::Value = serde_json::from_str(&of_docs()).unwrap();
    design["marks"] = serde_json::from_str(marks).unwrap();
    read(&design.to_string())
}

fn made(design: &Design) -> Made {
    make(design, &mut Unwatched).unwrap()
}

/// With `SHEETWRIGHT_REWRITE=1`, draws the picture anew.
#[test]
fn the_design_of_the_docs_makes_its_picture() {
    let made = made(&read(&of_docs()).unwrap());
    let part = &made.parts[0];
    let notes: Vec<&Finding> =
        part.checked.findings.iter().filter(|f| f.severity() != Severity::Note).collect();
    assert!(notes.is_empty(), "{notes:?}");
    let svg = write_svg(&part.piece);
    let path = root().join("docs/pictures/marks.svg");
    if std::env::var_os("SHEETWRIGHT_REWRITE").is_some() {
        std::fs::write(&path, &svg).unwrap();
    }
    assert!(std::fs::read(path).unwrap() == svg, "another picture: SHEETWRIGHT_REWRITE=1");
    let count = |kind: fn(&PathKind) -> bool| {
        part.piece.paths.iter().filter(|path| kind(&path.kind)).count()
    };
    assert_eq!(count(|kind| *kind == PathKind::Station), 3);
    assert_eq!(count(|kind| *kind == PathKind::Grain), 1);
    assert_eq!(count(|kind| *kind == PathKind::Arrow), 1);
    assert_eq!(count(|kind| *kind == PathKind::OnFold), 1);
    assert_eq!(count(|kind| matches!(kind, PathKind::Drill { .. })), 1);
    let said = part.piece.labels.iter().filter(|label| label.kind == LabelKind::OnFace);
    let mut said: Vec<&str> = said.map(|label| label.text.as_str()).collect();
    said.sort_unstable();
    let wanted = [
        "cut on fold",
        "frame 1",
        "frame 2",
        "grain",
        "outside, downwards",
        "wet before bending",
        "y 350",
    ];
    assert_eq!(said, wanted);
}

#[test]
fn marks_are_written_as_they_are_read() {
    let design = read(&of_docs()).unwrap();
    assert_eq!(design.marks.len(), 6);
    let again = read(std::str::from_utf8(&write_design(&design)).unwrap()).unwrap();
    assert_eq!(again, design);
    let others = r#"[
        { "kind": "stations", "pitch": 40, "from": -5.5 },
        { "on": ["cover", "all"], "kind": "grain", "edge": "hem", "length": "3 cm" },
        { "kind": "grain", "angle_deg": 30 },
        { "kind": "drill", "at": [40, 200, 60], "within": "2 mm", "diameter": 3 },
        { "kind": "drill", "at": [40, 60], "diameter": "0.5 in" },
        { "kind": "text", "text": "left", "at": [1, 200, 60], "within": 5, "height": 7 },
        { "kind": "face" }
    ]"#;
    let design = with(others).unwrap();
    let again = read(std::str::from_utf8(&write_design(&design)).unwrap()).unwrap();
    assert_eq!(again, design);
}

#[test]
fn every_format_has_the_marks_and_proves_its_pattern() {
    let made = made(&read(&of_docs()).unwrap());
    let formats = [Format::Svg, Format::Dxf, Format::Pdf, Format::Report, Format::Astm];
    let outputs = output_files(&made, &formats, OutputOptions::default()).unwrap();
    let text = |name: &str| {
        let file = outputs.files.iter().find(|file| file.name == name).unwrap();
        String::from_utf8_lossy(&file.bytes).into_owned()
    };
    let svg = text("cover.svg");
    for class in ["station", "grain", "arrow", "on-fold", "drill"] {
        assert!(svg.contains(&format!("class=\"{class}\"")), "{class}");
    }
    assert!(svg.contains("data-text=\"frame 2\""));
    let report: serde_json::Value = serde_json::from_str(&text("report.json")).unwrap();
    assert!(report["panels"][0]["refold_error_mm"].as_f64().unwrap() < 1e-9);
    let html = text("report.html");
    assert!(html.contains(">frame 2</text>") && html.contains("class=\"tick\""));
    assert!(text("pattern-astm.dxf").contains("frame 2"));
}

#[test]
fn what_can_not_be_read_is_said_with_a_way_out() {
    for (marks, message, hint) in [
        (r#"[{ "kind": "frames" }]"#, "'frames' is not known", "stations, grain, fold"),
        (r#"[{ "kind": "stations" }]"#, "neither `at` nor `pitch`", "\"pitch\": 500"),
        (r#"[{ "kind": "stations", "at": [1], "pitch": 5 }]"#, "`at` beside `pitch`", "Keep"),
        (r#"[{ "kind": "stations", "pitch": -5 }]"#, "`pitch` is -5", "above 0"),
        (r#"[{ "kind": "stations", "at": [1e30] }]"#, "too far", "1e9 mm"),
        (r#"[{ "kind": "grain", "edge": "a", "angle_deg": 3 }]"#, "two of", "Keep one"),
        (r#"[{ "kind": "face", "toward": [0, 0, 0] }]"#, "[0, 0, 0]", "a direction"),
        (r#"[{ "kind": "drill", "at": [1], "diameter": 3 }]"#, "`at` is '[1]'", "[x, y, z]"),
        (r#"[{ "kind": "drill", "at": [1, 2], "diameter": 0 }]"#, "`diameter` is 0", "10 mm"),
        (
            r#"[{ "kind": "drill", "at": [1, 2], "within": 3, "diameter": 3 }]"#,
            "no `within`",
            "Leave",
        ),
        (r#"[{ "kind": "text" }]"#, "`text` is missing", "Add it"),
        (r#"[{ "kind": "text", "text": "a\nb" }]"#, "`text`", "one line"),
        (r#"[{ "on": [], "kind": "face" }]"#, "`on` is empty", "all"),
        (r#"[{ "on": 3, "kind": "face" }]"#, "`on` is neither", "all"),
        (r#"[{ "kind": "fold", "edge": "hem", "side": 1 }]"#, "'side' is not known", "edge"),
    ] {
        let error = with(marks).unwrap_err();
        assert!(error.contains("marks[0]"), "{error}");
        assert!(error.contains(message) && error.contains(hint), "{error}");
    }
}

#[test]
fn what_can_not_be_made_is_said_with_a_way_out() {
    for (marks, message, hint) in [
        (r#"[{ "on": "hull", "kind": "face" }]"#, "no part is called 'hull'", "all"),
        (r#"[{ "kind": "fold", "edge": "keel" }]"#, "no edge is called 'keel'", "without"),
        (r#"[{ "kind": "stations", "pitch": "0.001" }]"#, "", ""),
        (r#"[{ "kind": "stations", "pitch": 0.001 }]"#, "the limit is 1000", "larger"),
    ] {
        let Ok(design) = with(marks) else {
            assert!(message.is_empty());
            continue;
        };
        let error = make(&design, &mut Unwatched).unwrap_err();
        let said = format!("{error} {}", hint_for(&error));
        assert!(said.contains(message) && said.contains(hint), "{said}");
    }
    let marks = r#"[
        { "kind": "stations", "at": [{ "at": 300, "name": "far" }] },
        { "kind": "drill", "at": [40, 200, 90], "diameter": 3 },
        { "kind": "drill", "at": [1, 100], "diameter": 3 }
    ]"#;
    let made = made(&with(marks).unwrap());
    let said: Vec<String> = made.parts[0].checked.findings.iter().map(finding_text).collect();
    let has = |words: &str| said.iter().any(|text| text.contains(words));
    assert!(has("Station far, at x = 300.0 mm, crosses none of its parts"), "{said:?}");
    assert!(has("from x = 0.0 to 160.0 mm"), "{said:?}");
    assert!(has("mm from the nearest part; the limit is 1.00 mm"), "{said:?}");
    assert!(has("The drill at (1.0, 100.0) mm of the pattern lies less than 1.50 mm"), "{said:?}");
}
