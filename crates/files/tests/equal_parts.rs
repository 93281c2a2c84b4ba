//! Equal parts: one pattern for all, its count on it, and all of them named in the report.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::design::Design;
use sheetwright::make::{Made, make};
use sheetwright::pattern::LabelKind;
use sheetwright::template::template;
use sheetwright::watch::Unwatched;
use sheetwright_files::{Format, OutputOptions, Outputs, output_files, read_dxf, trims_for};

fn made(name: &str) -> Made {
    let design = template(name).unwrap().defaults().design().unwrap();
    make(&design, &mut Unwatched).unwrap()
}

fn written(made: &Made, each_part: bool) -> Outputs {
    let formats = [Format::Svg, Format::Dxf, Format::Astm, Format::Parts, Format::Report];
    let options = OutputOptions { each_part, ..OutputOptions::default() };
    output_files(made, &formats, options).unwrap()
}

fn text(outputs: &Outputs, name: &str) -> String {
    let file = outputs.files.iter().find(|file| file.name == name).unwrap();
    String::from_utf8(file.bytes.clone()).unwrap()
}

fn names(outputs: &Outputs, ending: &str) -> Vec<String> {
    let names = outputs.files.iter().map(|file| file.name.clone());
    names.filter(|name| name.ends_with(ending)).collect()
}

#[test]
fn a_dome_of_twelve_gores_is_one_file() {
    let made = made("dome");
    let outputs = written(&made, false);
    assert_eq!(names(&outputs, ".svg"), ["gore-1.svg"]);
    assert_eq!(names(&outputs, ".dxf"), ["gore-1.dxf", "pattern-astm.dxf"]);
    assert!(outputs.panels.iter().all(|checked| checked.findings.is_empty()));
    assert!(outputs.refold_error_mm.iter().all(|&error| error < 1e-6));
    let report: serde_json::Value = serde_json::from_str(&text(&outputs, "report.json")).unwrap();
    for (n, panel) in report["panels"].as_array().unwrap().iter().enumerate() {
        assert_eq!(panel["pattern"], "gore-1");
        assert_eq!(panel["count"], if n == 0 { 12 } else { 0 });
        assert_eq!(panel["instances"].as_array().unwrap().len(), if n == 0 { 12 } else { 0 });
    }
    let page = text(&outputs, "report.html");
    assert!(page.contains("What to cut") && page.contains("Its pattern: cut 12. It is for gore-1"));
    assert_eq!(page.matches("It is cut from the pattern of <b>gore-1</b>.").count(), 11);
    assert!(text(&outputs, "pattern-astm.dxf").contains("Quantity: 12"));
    // The texts of a DXF are strokes; the pattern is that of the part.
    let read = read_dxf(text(&outputs, "gore-1.dxf").as_bytes()).unwrap();
    assert_eq!(read.outline.len(), made.parts[0].piece.outline().len());
    let item = &made.cut_list()[0];
    let labels = &item.piece.labels;
    let quantity = labels.iter().find(|label| label.kind == LabelKind::Quantity).unwrap();
    assert_eq!(quantity.text, "cut 12");

    let each = written(&made, true);
    assert_eq!(names(&each, ".svg").len(), 12);
    assert!(!text(&each, "report.html").contains("What to cut"));
}

#[test]
fn the_table_of_parts_names_all_instances_and_what_they_join() {
    let outputs = written(&made("hemisphere"), false);
    let table = text(&outputs, "parts.csv");
    let rows: Vec<&str> = table.split_terminator("\r\n").collect();
    assert_eq!(rows.len(), 4);
    assert!(rows[0].starts_with("part,count,mirrored,width_mm"));
    assert!(rows[1].starts_with("band-1-1,12,0,") && rows[2].starts_with("band-2-1,12,6,"));
    let instances = |row: &str| row.matches("; band-").count();
    // Twelve names, and then what each of the twelve joins.
    assert_eq!(instances(rows[1]), 11 + 11);
    assert!(rows[1].contains("band-1-12: band-1-1/side-1-1, band-2-12/level-2-12"), "{}", rows[1]);
    let page = text(&outputs, "report.html");
    assert!(page.contains("Joined edges") && page.contains("band-2-3 (mirrored)"));
    assert_eq!(page.matches("<td data-label=\"Joined to\">").count(), 60);
}

#[test]
fn segments_of_an_elbow_are_cut_three_times_with_what_its_trade_adds() {
    let design = template("elbow").unwrap().defaults().design().unwrap();
    let trims = trims_for(&design, Some("duct"), [None, Some(1.0)]).unwrap();
    let design = Design { thickness_mm: Some(1.0), trims, ..design };
    let made = make(&design, &mut Unwatched).unwrap();
    let counts = made.cut_list().iter().map(|item| item.quantity().count).collect::<Vec<_>>();
    assert_eq!(counts.iter().max(), Some(&3), "{counts:?}");
}
