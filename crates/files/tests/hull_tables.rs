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

/// The names of these planks, which come in halves, and of whole panels.
fn hull(planks: &[&str], whole: &[&str]) -> Vec<String> {
    let halves = planks.iter().flat_map(|p| [format!("{p}-port"), format!("{p}-starboard")]);
    halves.chain(whole.iter().map(|&name| name.to_owned())).collect()
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

fn near(found: [f64; 3], expected: [f64; 3]) {
    let off = (0..3).map(|n| (found[n] - expected[n]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{found:?} {expected:?}");
}

#[test]
fn published_boats_become_planks() {
    let inch = 25.4;
    let near = |found: [f64; 3], inches: [f64; 3]| near(found, inches.map(|n| n * inch));
    let sharpie = table("chesapeake-bay-sharpie.csv");
    assert_eq!(panels(&sharpie), hull(&["bottom", "side"], &["transom"]));
    near(point(&sharpie, "sheer", 2), [48.0, 23.0, 27.625]);
    near(point(&sharpie, "skeg", 7), [168.0, 0.5, 2.5]);
    // Heights of the car topper are measured downwards; half of them are feet,inches,eighths.
    let topper = table("car-topper.csv");
    assert_eq!(panels(&topper), hull(&["strake-1", "side"], &["bottom", "transom"]));
    near(point(&topper, "Gunwale", 0), [0.0, 15.875, -7.75]);
    near(point(&topper, "Bottom", 12), [138.0, 0.125, -36.0 + 33.0]);
    let dory = table("sport-dory.csv");
    let planks = ["strake-1", "strake-2", "strake-3", "strake-4", "side"];
    assert_eq!(panels(&dory), hull(&planks, &["bottom", "transom"]));
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
    assert_eq!(panels(&text), hull(&["bottom", "side"], &["transom"]));
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

#[test]
fn curves_of_freeship_are_planks() {
    let options = ReadOptions { units: Some(Units::Metres), ..ReadOptions::default() };
    let read = |name: &str, options: &ReadOptions| {
        let path = root().join("corpus/offsets").join(name);
        read_input(&path, options).unwrap_or_else(|error| panic!("{error} / {}", error.hint))
    };
    let notes = |name: &str| {
        let bytes = std::fs::read(root().join("corpus/offsets").join(name)).unwrap();
        sheetwright_files::hull_table_notes(&bytes, name, &options)
    };
    let stations = read("freeship-stations.txt", &options);
    assert_eq!(panels(&stations), hull(&["bottom", "side"], &["transom", "transom-2"]));
    near(point(&stations, "Keel", 0), [100.0, 0.0, 110.9]);
    near(point(&stations, "Chine 1", 2), [1300.0, 701.0, 140.3]);
    near(point(&stations, "Sheer", 8), [4900.0, 117.1, 840.1]);
    assert_eq!(stations.marks.len(), 1);
    let said = notes("freeship-stations.txt");
    assert!(said[0].contains("9 stations from 100 to 4900 mm and 3 lines"), "{said:?}");
    assert!(said[1].starts_with("11 sections and other curves are left out"), "{said:?}");
    // Control curves reach the ends; the chines are their points to a millimetre.
    let controls = read("freeship-control-curves.txt", &options);
    let chines = read("freeship-chines.txt", &ReadOptions::default());
    for design in [&controls, &chines] {
        assert_eq!(panels(design), hull(&["bottom", "side"], &[]));
        // Chine and sheer to starboard stand behind the lines.
        assert_eq!(design.curves.len(), 5);
    }
    for (a, b) in controls.curves.iter().zip(&chines.curves).take(3) {
        assert_eq!((&a.name, a.points.len()), (&b.name, 12));
        for (a, b) in a.points.iter().zip(&b.points) {
            let off = a.at - b.at;
            assert!(off.x.abs().max(off.y.abs()).max(off.z.abs()) <= 0.55, "{off:?}");
        }
    }
    let feet = ReadOptions { units: Some(Units::Feet), ..ReadOptions::default() };
    assert_eq!(point(&read("freeship-chines.txt", &feet), "Keel", 11)[0], 1524.0);
    let path = root().join("corpus/offsets/freeship-stations.txt");
    let error = read_input(&path, &ReadOptions::default()).unwrap_err();
    assert!(error.message.contains("metres or feet"), "{error}");
}

/// Sections that show no edges: a round hull is curves to choose rails from; a station with another
/// number of corners gives its ends; one of several parts is left out.
#[test]
fn sections_without_edges_are_curves() {
    let options = ReadOptions { units: Some(Units::Metres), ..ReadOptions::default() };
    let read = |text: &str| {
        let format = InputFormat::Table;
        read_bytes(format, text.as_bytes(), "hull.txt", None, &options).unwrap()
    };
    let notes = |text: &str| {
        sheetwright_files::hull_table_notes(text.as_bytes(), "hull.txt", &options).join("; ")
    };
    let station = |x: f64, knuckle: &str| {
        format!("Spant {x}\n{x} 0 0 {knuckle}\n{x} -1 0.2 {knuckle}\n{x} -2 1 {knuckle}\n")
    };
    let round: String = (0..4).map(|n| station(f64::from(n), "")).collect();
    let design = read(&round);
    assert_eq!((design.panels.len(), design.curves.len()), (0, 4));
    assert_eq!(design.curves[1].name, "Spant 1");
    assert_eq!(point(&design, "Spant 2", 1), [2000.0, 1000.0, 200.0]);
    assert!(notes(&round).contains("negative y is turned over"), "{}", notes(&round));
    let (knuckled, ends): (String, _) =
        ((0..4).map(|n| station(f64::from(n), "KNUCKLE")).collect(), station(4.0, ""));
    let design = read(&format!("{knuckled}{ends}"));
    let counts: Vec<usize> = design.curves.iter().map(|curve| curve.points.len()).collect();
    assert_eq!(panels(&design)[..4], hull(&["bottom", "side"], &[]));
    assert!(counts.contains(&4) && counts.contains(&5), "{counts:?}");
    assert!(notes(&format!("{knuckled}{ends}")).contains("station '4' has 0 corners"));
    // A curve that is drawn from the bow to the stern is an edge all the same.
    let chines =
        std::fs::read_to_string(root().join("corpus/offsets/freeship-chines.txt")).unwrap();
    let mut blocks: Vec<String> = chines.split("\n\n").map(str::to_owned).collect();
    let mut rows: Vec<&str> = blocks[1].lines().collect();
    rows.reverse();
    blocks[1] = rows.join("\n");
    let turned = blocks.join("\n\n");
    assert_ne!(turned, chines);
    assert_eq!(read(&turned).curves, read(&chines).curves);
    // Where no number of corners is usual, they show no edges.
    let odd = "Spant 0\n0 0 0\n0 1 0\n0 2 1\nSpant 1\n1 0 0\n1 1 0 KNUCKLE\n1 2 1\nSpant 2\n\
               2 0 0\n2 1 0 KNUCKLE\n2 2 1 KNUCKLE\n2 3 2\n";
    assert_eq!((read(odd).panels.len(), read(odd).curves.len()), (0, 3));
    // Tables with columns of white space are tables.
    let waterlines = "Station\tWL 100\tWL 200\n0\t300\t350\n1000\t400\t450\n";
    assert_eq!(point(&read(waterlines), "WL 100", 1), [1e6, 4e5, 1e5]);
    let twice = format!(
        "{knuckled}Spant 9\n2 segments.\nSEGMENT 1\n9 0 0\n9 -1 0\nSEGMENT 2\n9 -2 1\n9 -2 2\n"
    );
    assert!(notes(&twice).contains("2 stations of several parts"), "{}", notes(&twice));
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
    // The planks of both sides say so, each of its own sheer.
    assert_eq!(said.len(), 2, "{said:?}");
    for (said, curve) in said.iter().zip(["Sheer", "Sheer-starboard"]) {
        assert!(said.contains(&format!("'{curve}' is not fair at x = 1828.8 mm")), "{said}");
        assert!(said.contains("522.3 mm") && said.contains("less"), "{said}");
    }
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
            assert_eq!(panels(&design)[..6], hull(&["bottom", "strake-1", "side"], &[]));
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

/// Planks, transoms, a deck and a flat bottom come back to the bit, whatever the unit.
#[test]
fn a_design_and_the_template_take_points_from_a_table_of_offsets() {
    let folder = root().join("corpus/offsets");
    let options = ReadOptions::default();
    let boats = [
        ("skiff.xlsx", ["bottom", "side"], &["transom", "deck"][..]),
        ("skiff.csv", ["bottom", "side"], &["transom", "deck"]),
        ("car-topper.csv", ["strake-1", "side"], &["bottom", "transom", "deck"]),
        ("chesapeake-bay-sharpie.csv", ["bottom", "side"], &["transom", "deck"]),
    ];
    for (table, planks, boards) in boats {
        for units in ["", "mm", "cm", "m", "in", "ft"] {
            let mut settings =
                vec![format!("table={table}"), "transoms=yes".to_owned(), "deck=yes".to_owned()];
            settings.extend((!units.is_empty()).then(|| format!("units={units}")));
            let new = sheetwright_files::new_design("hull", &settings, &folder).unwrap();
            assert_eq!(panels(&new.design), hull(&planks, boards), "{table}");
            let text = String::from_utf8(new.bytes()).unwrap();
            for name in ["Sheer", "Sheer-starboard"] {
                let name =
                    if table.starts_with("ch") { name.to_lowercase() } else { name.to_owned() };
                let name =
                    if table.starts_with("car") { name.replace("Sheer", "Gunwale") } else { name };
                let kept = format!("\"table\": \"{table}\", \"curve\": \"{name}\"");
                assert!(text.contains(&kept), "{kept}: {text}");
            }
            let file = "a.sheet.json";
            let format = InputFormat::Design;
            let again = read_bytes(format, text.as_bytes(), file, Some(&folder), &options);
            let again = again.unwrap_or_else(|error| panic!("{table} {units}: {error}"));
            assert_eq!(again, new.design, "{table} {units}");
        }
    }
}

#[test]
fn every_example_of_the_page_is_read() {
    let page = std::fs::read_to_string(root().join("docs/offset-tables.md")).unwrap();
    let blocks: Vec<&str> = page.split("```\n").skip(1).step_by(2).collect();
    let [commands, tables @ ..] = &blocks[..] else { panic!("{page}") };
    assert!(commands.starts_with("sheetwright "), "{commands}");
    assert_eq!(tables.len(), 3);
    let flat = hull(&["side"], &["bottom", "transom", "transom-2"]);
    let keeled = hull(&["bottom", "side"], &["transom", "transom-2"]);
    for (text, expected) in tables.iter().zip([&keeled, &flat, &flat]) {
        let options = ReadOptions::default();
        let read = read_bytes(InputFormat::Table, text.as_bytes(), "a.csv", None, &options);
        let design = read.unwrap_or_else(|error| panic!("{error} / {}\n{text}", error.hint));
        assert_eq!(&panels(&design), expected, "{text}");
    }
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
