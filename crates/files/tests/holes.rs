//! Panels with holes, from their designs to the files of their patterns and back.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use serde_json::{Value, json};
use sheetwright::design::BendMarks;
use sheetwright::make::{Made, Part, make};
use sheetwright::math::{Point2, Vec2, cos, sin};
use sheetwright::triangulate::DEFAULT_WORK;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    BendSettings, Format, InputFormat, Outputs, PdfOptions, ReadOptions, RefoldFileError,
    output_files, read_bytes, read_dxf, read_input, read_svg, refold_error_mm, write_svg,
};
use std::f64::consts::TAU;

/// Four loops far from developable, of 240 samples: with no end to its work, the search took
/// minutes.
#[test]
fn the_vessel_is_made_with_the_work_that_a_panel_may_take() {
    let vessel = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/ubc-fishing-vessel.csv");
    let options = ReadOptions { samples: Some(60), effort: Some(0.2), ..ReadOptions::default() };
    let design = read_input(vessel.as_ref(), &options).unwrap();
    let panel = &make(&design, &mut Unwatched).unwrap().parts[0];
    let (found, may) = (&panel.found().unwrap().triangulation, 0.2 * DEFAULT_WORK as f64);
    assert!(found.cut_short && !found.proven_optimal);
    assert!(found.work as f64 <= 1.1 * may, "{} of {may}", found.work);
    // Five times as much work finds one for 21.9.
    assert!(found.price < 22.5, "{}", found.price);
}

/// Cut along its shortest rung, this tube got folds of 114° with 800 samples, where the search for
/// the best cut ends early.
#[test]
fn a_tube_has_no_folds_however_many_samples_it_has() {
    let tube = concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpus/good/mitred-tube.csv");
    let mut before = f64::INFINITY;
    for samples in [200, 400, 800] {
        let options = ReadOptions { samples: Some(samples), ..ReadOptions::default() };
        let design = read_input(tube.as_ref(), &options).unwrap();
        let panel = &make(&design, &mut Unwatched).unwrap().parts[0];
        let price = panel.found().unwrap().triangulation.price;
        // The twist of a smooth surface is shared by more and more rungs.
        assert!(price < 0.6 * before, "{samples}: {price} after {before}");
        before = price;
    }
}

/// A spline through points of a circle.
fn circle(radius: f64, centre: [f64; 3]) -> Value {
    let point = |i: u32| {
        let a = TAU * f64::from(i) / 24.0;
        [centre[0] + radius * cos(a), centre[1] + radius * sin(a), centre[2]]
    };
    let points: Vec<[f64; 3]> = (0..24).map(point).collect();
    json!({ "kind": "spline", "closed": true, "points": points })
}

/// Makes a design whose patterns show all rungs.
fn made(design: &Value) -> Made {
    let bytes = design.to_string().into_bytes();
    let bends = BendSettings { marks: Some(BendMarks::Rulings), ..BendSettings::default() };
    let options = ReadOptions { bends, ..ReadOptions::default() };
    let design = read_bytes(InputFormat::Design, &bytes, "d.sheet.json", None, &options).unwrap();
    make(&design, &mut Unwatched).unwrap()
}

fn ring(rim: Value, hole: Value, cut: Value) -> Made {
    made(&json!({
        "sheetwright": 1,
        "curves": { "rim": rim, "hole": hole },
        "panels": [
            { "name": "ring", "boundary": ["rim"], "holes": [["hole"]], "samples": 48, "cut": cut }
        ]
    }))
}

fn frustum(cut: Value) -> Made {
    ring(circle(200.0, [0.0; 3]), circle(100.0, [0.0, 0.0, 120.0]), cut)
}

fn washer() -> Made {
    ring(circle(200.0, [0.0; 3]), circle(80.0, [30.0, 50.0, 0.0]), json!([]))
}

/// A quarter of a cylinder with an elliptic window.
fn shade() -> Made {
    let at = |along: f64, z: f64| [300.0 * sin(along), -300.0 * cos(along), z];
    let arc = |z: f64, way: f64| -> Value {
        let points: Vec<_> = (0..=12).map(|i| at(way * (f64::from(i) / 6.0 - 1.0), z)).collect();
        json!({ "kind": "spline", "points": points })
    };
    let side = |along: f64, z: [f64; 2]| -> Value {
        json!({ "kind": "polyline", "points": [at(along, z[0]), at(along, z[1])] })
    };
    let window: Vec<_> = (0..24)
        .map(|i| TAU * f64::from(i) / 24.0)
        .map(|a| at(0.4 * cos(a), 200.0 + 90.0 * sin(a)))
        .collect();
    made(&json!({
        "sheetwright": 1,
        "curves": {
            "foot": arc(0.0, 0.8),
            "right": side(0.8, [0.0, 400.0]),
            "top": arc(400.0, -0.8),
            "left": side(-0.8, [400.0, 0.0]),
            "window": { "kind": "spline", "closed": true, "points": window }
        },
        "panels": [{
            "name": "shade", "boundary": ["foot", "right", "top", "left"], "holes": [["window"]],
            "samples": 100
        }]
    }))
}

fn outputs(made: &Made) -> Outputs {
    output_files(made, &Format::DEFAULT, &PdfOptions::default()).unwrap()
}

fn text<'a>(outputs: &'a Outputs, name: &str) -> &'a str {
    let file = outputs.files.iter().find(|file| file.name == name).unwrap();
    std::str::from_utf8(&file.bytes).unwrap()
}

fn report(outputs: &Outputs) -> Value {
    serde_json::from_str::<Value>(text(outputs, "report.json")).unwrap()["panels"][0].clone()
}

/// What was written reads back as the pattern and folds up to the surface, up to what closing its
/// windows takes, mm.
fn assert_reads_back(panel: &Part, outputs: &Outputs, within_mm: f64) {
    let name = &panel.name;
    let svg = read_svg(text(outputs, &format!("{name}.svg")).as_bytes()).unwrap();
    let dxf = read_dxf(text(outputs, &format!("{name}.dxf")).as_bytes()).unwrap();
    for read in [svg, dxf] {
        assert_eq!(read.points().len(), panel.flat.points.len());
        assert!(read.points().iter().zip(&panel.flat.points).all(|(a, b)| a.distance(*b) < 1e-9));
        assert_eq!(read.rungs, panel.sheet.rungs());
    }
    assert!(outputs.refold_error_mm[0] <= within_mm, "{}", outputs.refold_error_mm[0]);
    assert!(outputs.panels[0].findings.iter().all(|finding| finding.code() != "refold"));
}

#[test]
fn a_ring_is_cut_open_and_marked_on_both_sides() {
    let made = frustum(json!([]));
    let (panel, outputs) = (&made.parts[0], outputs(&made));
    assert_reads_back(panel, &outputs, 1e-9);
    let svg = text(&outputs, "ring.svg");
    assert_eq!(svg.matches("class=\"outline\"").count(), 1);
    assert_eq!(svg.matches("class=\"hole\"").count(), 0);
    assert_eq!(svg.matches("data-text=\"S1\"").count(), 2);
    assert_eq!(svg.matches("class=\"seam-tick\"").count(), 2);
    let slant = Vec2::new(100.0, 120.0).length();
    assert_eq!(svg.matches(&format!("data-text=\"seam S1, {slant:.1} mm\"")).count(), 1);
    let report = report(&outputs);
    assert_eq!(report["holes_flat"], 0);
    let [seam] = report["seams"].as_array().unwrap().as_slice() else { panic!("{report}") };
    assert_eq!(seam["mark"], "S1");
    assert!((seam["length_mm"].as_f64().unwrap() - slant).abs() < 0.01 * slant);
    assert!(text(&outputs, "report.html").contains("cut open along <b>S1</b>"));
}

#[test]
fn an_obj_keeps_one_surface_and_lays_its_seam_open() {
    let made = frustum(json!([]));
    let panel = &made.parts[0];
    let written = outputs(&made);
    let numbers = |kind: &str| -> Vec<Vec<f64>> {
        let lines = text(&written, "surface.obj").lines().filter_map(|l| l.strip_prefix(kind));
        lines.map(|l| l.split(' ').map(|x| x.parse().unwrap()).collect()).collect()
    };
    let (space, flat) = (numbers("v "), numbers("vt "));
    assert_eq!(
        (space.len(), flat.len()),
        (panel.found().unwrap().boundary.len(), panel.found().unwrap().boundary.len() + 2)
    );
    let distance = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
    };
    for face in text(&written, "surface.obj").lines().filter_map(|l| l.strip_prefix("f ")) {
        let corners: Vec<[usize; 2]> = face
            .split(' ')
            .map(|corner| corner.split_once('/').unwrap())
            .map(|(v, vt)| [v, vt].map(|n| n.parse::<usize>().unwrap() - 1))
            .collect();
        for n in 0..3 {
            let ([a, p], [b, q]) = (corners[n], corners[(n + 1) % 3]);
            let gap = distance(&space[a], &space[b]) - distance(&flat[p], &flat[q]);
            assert!(gap.abs() < 1e-9, "{gap}");
        }
    }
}

#[test]
fn the_user_says_where_to_cut() {
    let seam = |cut: Value| {
        let panel = frustum(cut).parts.remove(0);
        let [seam] = panel.sheet.seams() else { panic!() };
        let [a, b] =
            panel.sheet.seam_rung(seam).ends().map(|s| panel.found().unwrap().boundary.position(s));
        a.lerp(b, 0.5)
    };
    for [x, y] in [[-150.0, 0.0], [0.0, 150.0], [100.0, -110.0]] {
        let middle = seam(json!([[x, y, 60.0]]));
        let off = Vec2::new(middle.x - x, middle.y - y).length();
        assert!(off < 15.0, "{middle:?}");
    }
}

#[test]
fn a_plane_ring_and_a_window_stay_closed() {
    for (made, within_mm) in [(washer(), 1e-9), (shade(), 0.1)] {
        let (panel, outputs) = (&made.parts[0], outputs(&made));
        assert_reads_back(panel, &outputs, within_mm);
        let report = report(&outputs);
        assert_eq!((&report["holes_flat"], &report["seams"]), (&json!(1), &json!([])));
        assert_eq!(report["overlaps"], false);
        assert!(report["length_error_max"].as_f64().unwrap() < 1e-5);
        let svg = text(&outputs, &format!("{}.svg", panel.name));
        assert_eq!(svg.matches("class=\"hole\"").count(), 1);
        assert_eq!(svg.matches("seam").count(), 0);
    }
}

#[test]
fn a_pattern_with_a_wrong_hole_is_seen() {
    let panel = &washer().parts[0];
    let right = refold_error_mm(panel, None, None).unwrap();
    assert!(right < 1e-9);
    let before = panel.piece.paths[1].points.clone();
    let folded = |change: &dyn Fn(usize, Point2) -> Point2| {
        let mut wrong = panel.piece.clone();
        // The hole, and the rungs that end on it.
        for point in wrong.paths[1..].iter_mut().flat_map(|path| &mut path.points) {
            if let Some(n) = before.iter().position(|corner| corner == point) {
                *point = change(n, *point);
            }
        }
        refold_error_mm(panel, Some(&write_svg(&wrong)), None)
    };
    // One corner moved by half a millimetre, and the whole hole by one.
    let corner = |n: usize, p: Point2| if n == 3 { p + Vec2::new(0.3, 0.4) } else { p };
    let moved = folded(&corner).unwrap();
    assert!((moved - 0.5).abs() < 0.2, "{moved}");
    let moved = folded(&|_, p| p + Vec2::X).unwrap();
    assert!(moved > 0.5, "{moved}");
    let mut none = panel.piece.clone();
    none.paths.remove(1);
    let error = refold_error_mm(panel, Some(&write_svg(&none)), None);
    assert_eq!(error, Err(RefoldFileError::Lines));
}
