//! Quads as OBJ and smooth surfaces as STEP: what a reader relies on. Programs that are not ours
//! read the examples in `.ci/step.py`.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use sheetwright::make::{Made, make};
use sheetwright::quads::{PlanarEnd, lay_quads_flat};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, InputFormat, PanelQuads, PdfOptions, ReadOptions, output_files, read_bytes,
};
use std::collections::BTreeSet;

/// A strip of a cylinder, a ring of a cone with a name to be careful with, and a strip that twists.
const DESIGN: &str = r#"{ "sheetwright": 1, "name": "three", "units": "mm", "curves": {
    "low": { "kind": "spline", "points": [[0,0,0],[50,0,30],[100,0,40],[150,0,30],[200,0,0]] },
    "high": { "kind": "spline", "points": [[0,90,0],[50,90,30],[100,90,40],[150,90,30],[200,90,0]] },
    "twisted": { "kind": "spline", "points": [[0,180,-40],[100,180,40],[200,180,60]] },
    "outer": { "kind": "spline", "closed": true,
      "points": [[100,0,0],[0,100,0],[-100,0,0],[0,-100,0]] },
    "inner": { "kind": "spline", "closed": true,
      "points": [[50,0,60],[0,50,60],[-50,0,60],[0,-50,60]] } },
  "panels": [
    { "name": "arch", "rails": ["low", "high"], "samples": 40 },
    { "name": "ring's", "boundary": ["outer"], "holes": [["inner"]], "samples": 60 },
    { "name": "tw ist", "rails": ["high", "twisted"], "samples": 40 } ] }"#;

fn made() -> Made {
    let options = ReadOptions::default();
    let design =
        read_bytes(InputFormat::Design, DESIGN.as_bytes(), "d.sheet.json", None, &options).unwrap();
    make(&design, &mut Unwatched).unwrap()
}

fn file(made: &Made, formats: &[Format], name: &str) -> String {
    let outputs = output_files(made, formats, &PdfOptions::default()).unwrap();
    let file = outputs.files.into_iter().find(|file| file.name == name).unwrap();
    String::from_utf8(file.bytes).unwrap()
}

#[test]
fn quads_have_a_group_a_panel_and_lie_in_planes() {
    let made = made();
    let obj = file(&made, &[Format::Quads], "quads.obj");
    let groups: Vec<&str> = obj.lines().filter_map(|line| line.strip_prefix("g ")).collect();
    assert_eq!(groups, ["arch", "ring's", "tw_ist"]);
    let mut points: Vec<[f64; 3]> = Vec::new();
    let (mut quads, mut faces) = (0, 0);
    for line in obj.lines() {
        let mut words = line.split(' ');
        match words.next() {
            Some("v") => {
                let p: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
                points.push(p.try_into().unwrap());
            }
            Some("f") => {
                let corners: Vec<usize> = words.map(|word| word.parse().unwrap()).collect();
                faces += 1;
                let &[a, b, c, d] = &corners[..] else { continue };
                quads += 1;
                let [a, b, c, d] = [a, b, c, d].map(|n| points[n - 1]);
                let way = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| q[k] - p[k]);
                let (ac, bd, ab) = (way(a, c), way(b, d), way(a, b));
                let cross = [
                    ac[1] * bd[2] - ac[2] * bd[1],
                    ac[2] * bd[0] - ac[0] * bd[2],
                    ac[0] * bd[1] - ac[1] * bd[0],
                ];
                let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
                let distance = dot(cross, ab) / dot(cross, cross).sqrt();
                assert!(distance.abs() < 1e-9 * 200.0, "{distance}");
            }
            _ => {}
        }
    }
    assert!(quads > 100 && faces - quads < 10, "{quads} of {faces}");
}

#[test]
fn the_report_says_how_planar_quads_are_and_how_smooth_strips() {
    let made = made();
    let report = file(&made, &[Format::Quads, Format::Report], "report.json");
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    for (panel, made) in report["panels"].as_array().unwrap().iter().zip(&made.parts) {
        let quads = &panel["quads"];
        let own = PanelQuads::new(made.found().unwrap());
        assert_eq!(quads["planar"], true);
        let number = |key: &str| quads[key].as_f64().unwrap();
        assert!(number("planarity_after_mm") < 1e-9 * made.found().unwrap().boundary.size());
        assert_eq!(number("moved_max_mm"), own.planar.moved_max_mm);
        assert_eq!(number("smooth_deviation_mm"), own.smooth.deviation_max_mm);
        assert!(number("strips") > 0.0 && number("quads") > 10.0);
        let is_off = own.planar.end == PlanarEnd::OffOutline;
        let codes: Vec<&str> = panel["findings"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|finding| finding["code"].as_str())
            .collect();
        assert_eq!(codes.contains(&"quads-off-boundary"), is_off);
        assert_eq!(number("off_boundary_max_mm") > 0.0, is_off);
        let flat = lay_quads_flat(&own.planar.mesh, &[], &mut Unwatched).unwrap().1;
        assert_eq!(flat.overlap, None);
    }
    // Whoever asks for neither waits for neither.
    let report = file(&made, &[Format::Report], "report.json");
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert!(report["panels"][0]["quads"].is_null());
}

#[test]
fn step_names_every_panel_and_every_record() {
    let made = made();
    let step = file(&made, &[Format::Step], "surface.step");
    assert_eq!(step, file(&made, &[Format::Step], "surface.step"));
    assert!(step.starts_with("ISO-10303-21;\n") && step.ends_with("END-ISO-10303-21;\n"));
    assert!(step.is_ascii());
    let count = |what: &str| step.matches(what).count();
    for name in ["'arch'", "'ring''s'", "'tw ist'"] {
        assert_eq!(count(&format!("=PRODUCT({name},{name},")), 1);
        assert_eq!(count(&format!("=OPEN_SHELL({name},(")), 1);
    }
    assert!(count("=B_SPLINE_SURFACE_WITH_KNOTS('',3,1,(") >= 4);
    // Every record is there that another names, and before it.
    let mut known = BTreeSet::new();
    for line in step.lines().filter(|line| line.starts_with('#')) {
        let (own, record) = line.split_once('=').unwrap();
        for named in record.split(['(', ')', ',', ';']).filter(|word| word.starts_with('#')) {
            assert!(known.contains(named), "{line}");
        }
        assert!(known.insert(own.to_owned()));
    }
}
