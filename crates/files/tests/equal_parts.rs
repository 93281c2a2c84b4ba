//! Equal parts: one pattern for all, its count on it, and all of them named in the report.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::design::Design;
use sheetwright::make::{Made, make};
use sheetwright::pattern::LabelKind;
use sheetwright::template::template;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, InputError, InputFormat, OutputOptions, Outputs, ReadOptions, output_files, read_bytes,
    read_dxf, trims_for, write_design,
};

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

/// Counts of panels go to the pattern, the lists and the files; those of equal panels add up, and
/// what a mirrored panel wants turned over lies as the pattern does.
#[test]
fn a_panel_is_cut_as_often_as_it_asks_for() {
    let mut design = template("facade").unwrap().defaults().design().unwrap();
    for panel in &mut design.panels {
        (panel.count, panel.mirrored) = (4, 1);
    }
    let made = make(&design, &mut Unwatched).unwrap();
    let quantities = made.cut_list().iter().map(|item| item.quantity()).collect::<Vec<_>>();
    // Each pattern is for a panel and for one that is its mirror image: 1 + 3 of 8 turned over.
    assert!(quantities.iter().all(|it| (it.count, it.mirrored) == (8, 4)), "{quantities:?}");
    let outputs = written(&made, false);
    assert!(text(&outputs, "parts.csv").contains("\r\npanel-1,8,4,"));
    assert!(text(&outputs, "pattern-astm.dxf").contains("Quantity: 8"));
    let report: serde_json::Value = serde_json::from_str(&text(&outputs, "report.json")).unwrap();
    assert_eq!(
        (&report["panels"][0]["count"], &report["panels"][0]["mirrored"]),
        (&8.into(), &4.into())
    );
    let each = made.cut_each();
    assert!(each.iter().all(|it| it.quantity().text().as_deref() == Some("cut 4, 1 mirrored")));
    assert!(text(&outputs, "report.html").contains("What to cut"));
}

fn bytes_read(bytes: &[u8]) -> Result<Design, InputError> {
    read_bytes(InputFormat::Design, bytes, "it.sheet.json", None, &ReadOptions::default())
}

#[test]
fn counts_are_read_written_and_checked() {
    let read = |count: &str| {
        let text = format!(
            r#"{{"sheetwright": 1, "curves": {{"rim": {{"kind": "polyline", "closed": true,
            "points": [[0, 0, 0], [50, 0, 0], [50, 30, 0], [0, 30, 0]]}}}},
            "panels": [{{"name": "tab", "boundary": ["rim"]{count}}}]}}"#
        );
        bytes_read(text.as_bytes())
    };
    let design = read(r#", "count": 6, "mirrored": 2"#).unwrap();
    assert_eq!((design.panels[0].count, design.panels[0].mirrored), (6, 2));
    let again = bytes_read(&write_design(&design)).unwrap();
    assert_eq!(again.panels, design.panels);
    let refused = |count: &str| read(count).unwrap_err().to_string();
    assert!(refused(r#", "count": 0"#).contains("the count is 0"));
    let turned = refused(r#", "mirrored": 2"#);
    assert!(turned.contains("2 are turned over, of 1 that are cut"), "{turned}");
}
