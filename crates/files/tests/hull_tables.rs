//! Tables of offsets of published boats and of one hull in many forms, from the file to planks.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use sheetwright::check::FindingKind;
use sheetwright::design::{Design, MarkKind, StationPlaces};
use sheetwright::make::{Made, make};
use sheetwright::watch::Unwatched;
use sheetwright_files::{InputFormat, ReadOptions, Units, finding_text, read_bytes, read_input};
use std::fmt::Write as _;
use std::path::Path;

fn root() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn table(name: &str) -> Design {
    match read_input(&root().join("corpus/offsets").join(name), &ReadOptions::default()) {
        Ok(design) => design,
        Err(error) => panic!("{error} / {}", error.hint),
    }
}

fn panels(design: &Design) -> Vec<&str> {
    design.panels.iter().map(|panel| panel.name.as_str()).collect()
}

fn point(design: &Design, curve: &str, n: usize) -> [f64; 3] {
    let curve = design.curves.iter().find(|one| one.name == curve).unwrap();
    let at = curve.points[n].at;
    [at.x, at.y, at.z]
}

fn unfair(made: &Made) -> Vec<String> {
    let findings = made.parts.iter().flat_map(|part| &part.checked.findings);
    let is_unfair = |kind: &FindingKind| matches!(kind, FindingKind::UnfairLine { .. });
    findings.filter(|finding| is_unfair(&finding.kind)).map(finding_text).collect()
}

#[test]
fn published_boats_become_planks() {
    let inch = 25.4;
    let near = |found: [f64; 3], inches: [f64; 3]| {
        let off = (0..3).map(|n| (found[n] - inches[n] * inch).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{found:?} {inches:?}");
    };
    let sharpie = table("chesapeake-bay-sharpie.csv");
    assert_eq!(panels(&sharpie), ["bottom", "side", "transom"]);
    near(point(&sharpie, "sheer", 2), [48.0, 23.0, 27.625]);
    near(point(&sharpie, "skeg", 7), [168.0, 0.5, 2.5]);
    // Heights of the car topper are measured downwards; half of them are feet,inches,eighths.
    let topper = table("car-topper.csv");
    assert_eq!(panels(&topper), ["strake-1", "side", "bottom", "transom"]);
    near(point(&topper, "Gunwale", 0), [0.0, 15.875, -7.75]);
    near(point(&topper, "Bottom", 12), [138.0, 0.125, -36.0 + 33.0]);
    let dory = table("sport-dory.csv");
    assert_eq!(
        panels(&dory),
        ["strake-1", "strake-2", "strake-3", "strake-4", "side", "bottom", "transom"]
    );
    near(point(&dory, "line1", 5), [17.5, 0.595, 1.084]);
    for design in [&sharpie, &topper, &dory] {
        let made = make(design, &mut Unwatched).unwrap();
        assert_eq!(made.parts.len(), design.panels.len(), "{}", design.name);
        assert_eq!(unfair(&made), Vec::<String>::new(), "{}", design.name);
    }
}

#[test]
fn a_workbook_is_the_table_that_it_holds() {
    let text = table("skiff.csv");
    assert_eq!(panels(&text), ["bottom", "side", "transom"]);
    assert_eq!((text.panels[0].count, text.panels[0].mirrored), (2, 1));
    let MarkKind::Stations { at: StationPlaces::Listed { planes }, .. } = &text.marks[0].kind
    else {
        panic!("{:?}", text.marks)
    };
    let named: Vec<&str> = planes.iter().filter_map(|plane| plane.name.as_deref()).collect();
    assert_eq!(named, ["Sta 1", "Sta 2", "Sta 3", "Sta 4", "Sta 5"]);
    for workbook in ["skiff.xlsx", "skiff.ods"] {
        assert_eq!(table(workbook), text, "{workbook}");
    }
}

/// The slip of 40 mm in a sheer, which went unnoticed.
#[test]
fn a_slip_is_found_and_a_fair_hull_gives_no_warning() {
    let fair = table("skiff.csv");
    assert_eq!(unfair(&make(&fair, &mut Unwatched).unwrap()), Vec::<String>::new());
    let text = std::fs::read_to_string(root().join("corpus/offsets/skiff.csv")).unwrap();
    // The sheer at station 3: 1-7-0 is 482.6 mm, 1-8-4+ is 522.3.
    let slip = text.replacen("1-7-0,", "1-8-4+,", 1);
    let options = ReadOptions::default();
    let read = read_bytes(InputFormat::Table, slip.as_bytes(), "skiff.csv", None, &options);
    let said = unfair(&make(&read.unwrap(), &mut Unwatched).unwrap());
    let [said] = &said[..] else { panic!("{said:?}") };
    assert!(said.contains("'Sheer' is not fair at x = 1828.8 mm"), "{said}");
    assert!(said.contains("522.3 mm") && said.contains("less"), "{said}");
}

#[test]
fn the_fishing_vessel_is_one_hull_in_every_form() {
    let path = root().join("examples/ubc-fishing-vessel.csv");
    let curves = std::fs::read_to_string(path).unwrap();
    let mut lines: Vec<(String, Vec<[f64; 3]>)> = Vec::new();
    for row in curves.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let at = [1, 2, 3].map(|n| cells[n].parse::<f64>().unwrap());
        match lines.last_mut().filter(|line| line.0 == cells[0]) {
            Some(line) => line.1.push(at),
            None => lines.push((cells[0].to_owned(), vec![at])),
        }
    }
    let feet = |n: f64| format!("{n}'");
    let inches = |n: f64| format!("{} in", n * 12.0);
    let comma = |n: f64| n.to_string().replace('.', ",");
    let bare = |n: f64| n.to_string();
    let marks = |n: f64| {
        let sign = if n < 0.0 { "-" } else { "" };
        let n = n.abs();
        format!("{sign}{}'-{}\"", n.floor(), (n - n.floor()) * 12.0)
    };
    for (of, title) in [
        (&bare as &dyn Fn(f64) -> String, "Offsets in feet"),
        (&feet, "Offsets"),
        (&inches, "Offsets"),
        (&comma, "Offsets (ft)"),
        (&marks, "Offsets"),
    ] {
        for is_down in [false, true] {
            let text = form(&lines, of, title, is_down);
            let options = ReadOptions::default();
            let read = read_bytes(InputFormat::Table, text.as_bytes(), "ubc.txt", None, &options);
            let design = match read {
                Ok(design) => design,
                Err(error) => panic!("{error} / {}\n{text}", error.hint),
            };
            assert_eq!(panels(&design)[..3], ["bottom", "strake-1", "side"]);
            for (name, points) in &lines {
                // The table is from bow to stern, as its stations lie.
                for (n, at) in points.iter().rev().enumerate() {
                    let found = point(&design, name, n);
                    let off = (0..3).map(|k| (found[k] - at[k] * 304.8).abs());
                    assert!(off.fold(0.0, f64::max) < 1e-9, "{title} {name} {n}: {found:?} {at:?}");
                }
            }
        }
    }
}

/// Lines as a table with heights and half-breadths in two blocks, the stations across or down.
fn form(
    lines: &[(String, Vec<[f64; 3]>)],
    of: &dyn Fn(f64) -> String,
    title: &str,
    is_down: bool,
) -> String {
    let stations: Vec<String> = (0..lines[0].1.len()).map(|n| format!("Sta {n}")).collect();
    let places: Vec<String> = lines[0].1.iter().map(|at| of(at[0])).collect();
    let mut text = format!("{title}\n");
    for (quantity, axis) in [("Heights", 2), ("Half-breadths", 1)] {
        writeln!(text, "\n{quantity}").unwrap();
        let mut rows: Vec<Vec<String>> = vec![
            [vec!["Station".to_owned()], stations.clone()].concat(),
            [vec!["Position".to_owned()], places.clone()].concat(),
        ];
        for (name, points) in lines {
            let cells: Vec<String> = points.iter().map(|at| of(at[axis])).collect();
            rows.push([vec![name.clone()], cells].concat());
        }
        let (count, length) =
            if is_down { (rows[0].len(), rows.len()) } else { (rows.len(), rows[0].len()) };
        for row in 0..count {
            let cell =
                |column: usize| if is_down { &rows[column][row] } else { &rows[row][column] };
            let cells: Vec<&str> = (0..length).map(|column| cell(column).as_str()).collect();
            writeln!(text, "{}", cells.join("\t")).unwrap();
        }
    }
    text
}

#[test]
fn a_design_and_the_template_take_points_from_a_table_of_offsets() {
    let new = sheetwright_files::new_design(
        "hull",
        &["table=skiff.xlsx".to_owned()],
        &root().join("corpus/offsets"),
    );
    let new = new.unwrap();
    let names: Vec<&str> = new.design.panels.iter().map(|panel| panel.name.as_str()).collect();
    assert_eq!(names, ["bottom", "side"]);
    let text = String::from_utf8(new.bytes()).unwrap();
    assert!(text.contains("\"table\": \"skiff.xlsx\""), "{text}");
    let options = ReadOptions::default();
    let folder = root().join("corpus/offsets");
    let again =
        read_bytes(InputFormat::Design, text.as_bytes(), "a.sheet.json", Some(&folder), &options);
    assert_eq!(again.unwrap().curves, new.design.curves);
}

#[test]
fn a_round_hull_has_curves_and_the_words_for_rails() {
    let text = "Station,0,1000,2000\nWL 100,300,400,200\nWL 200,350,450,250\n";
    let options = ReadOptions { units: Some(Units::Millimetres), ..ReadOptions::default() };
    let design =
        read_bytes(InputFormat::Table, text.as_bytes(), "round.csv", None, &options).unwrap();
    assert_eq!((design.curves.len(), design.panels.len()), (2, 0));
    // A single edge bounds no plank and stays a curve.
    let edge = "Station,0,1000\nWL 100,300,400\nWL 200,350,450\nSheer height,500,510\n\
                Sheer half-breadth,400,420\n";
    let read = read_bytes(InputFormat::Table, edge.as_bytes(), "round.csv", None, &options);
    let names: Vec<String> = read.unwrap().curves.into_iter().map(|curve| curve.name).collect();
    assert_eq!(names, ["WL 100", "WL 200", "Sheer"]);
    let error = make(&design, &mut Unwatched).unwrap_err();
    let hint = sheetwright_files::hint_in_design(&error, &design);
    assert!(hint.contains("\"rails\": [\"WL 100\", \"WL 200\"]"), "{hint}");
    let notes = sheetwright_files::hull_table_notes(text.as_bytes(), "round.csv", &options);
    assert!(notes.iter().any(|note| note.contains("bound no planks")), "{notes:?}");
}
