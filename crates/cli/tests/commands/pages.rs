//! Pages: the paper of patterns, and how long a report is.

use super::{Desk, SQUARE, TWO_PANELS};
use std::fs;
use std::path::Path;

/// A flat rectangle of 3 by 4 metres: some 180 sheets of A4, and fewer than 300.
const LARGE: &str = "x,y,z,corner\n0,0,0,1\n4000,0,0,1\n4000,3000,0,1\n0,3000,0,1\n";

/// The boxes of the pages of a PDF, without repetitions.
fn page_boxes(path: &Path) -> Vec<String> {
    let bytes = fs::read(path).unwrap();
    let pdf = String::from_utf8_lossy(&bytes);
    let rest = pdf.split("/MediaBox [").skip(1);
    let mut boxes: Vec<String> = rest.map(|r| r.split(']').next().unwrap().to_owned()).collect();
    boxes.sort();
    boxes.dedup();
    boxes
}

#[test]
fn patterns_come_on_the_paper_that_is_asked_for() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    desk.says("make square.csv --out a4 --formats pdf", 0);
    desk.says("make square.csv --out letter --formats pdf --paper letter", 0);
    desk.says("convert square.csv letter.pdf --paper letter", 0);
    let a4 = page_boxes(&desk.path("a4/pattern.pdf"));
    assert!(a4.iter().all(|page| page.contains("595.2756") && page.contains("841.8898")), "{a4:?}");
    let letter = page_boxes(&desk.path("letter/pattern.pdf"));
    assert!(letter.iter().all(|page| page.contains("612") && page.contains("792")), "{letter:?}");
    let bytes = |name: &str| fs::read(desk.path(name)).unwrap();
    assert_eq!(bytes("letter/pattern.pdf"), bytes("letter.pdf"));
    let (_, error) = desk.says("make square.csv --out no --paper a9", 2);
    assert!(error.contains("invalid value 'a9' for '--paper <PAPER>'"), "{error}");
}

#[test]
fn the_page_of_a_report_is_long_or_short_as_it_is_asked_for() {
    let desk = Desk::new(&[("two.sheet.json", TWO_PANELS)]);
    let page = |asked: &str| {
        desk.says(&format!("make two.sheet.json --out out --formats report {asked}"), 0);
        fs::read_to_string(desk.path("out/report.html")).unwrap()
    };
    let short = page("--report short");
    assert!(short.contains("Of 2 panels") && !short.contains("id=\"panel-1\""));
    for long in [page("--report long"), page("")] {
        assert!(long.contains("id=\"panel-1\"") && !long.contains("Of 2 panels"));
    }
    let (_, said) = desk.says("make two.sheet.json --out out --report some", 2);
    assert!(said.contains("short") && said.contains("long"), "{said}");
}

#[test]
fn a_page_that_is_short_for_its_many_panels_says_how_it_is_had_whole() {
    let curves = r#""a": { "kind": "polyline", "points": [[0,0,0], [100,0,0]] },
        "b": { "kind": "polyline", "points": [[0,50,0], [100,50,0]] }"#;
    let panel =
        |n: usize| format!("{{ \"name\": \"p{n}\", \"rails\": [\"a\", \"b\"], \"samples\": 3 }}");
    let panels: Vec<String> = (0..101).map(panel).collect();
    let panels = panels.join(",");
    let design =
        format!("{{ \"sheetwright\": 1, \"curves\": {{ {curves} }}, \"panels\": [{panels}] }}");
    let desk = Desk::new(&[("many.sheet.json", &design)]);
    let call = "make many.sheet.json --out out --formats report";
    assert!(desk.says(call, 0).1.contains("--report long"));
    let page = fs::read_to_string(desk.path("out/report.html")).unwrap();
    assert!(page.contains("short form") && !page.contains("--report"));
    for form in ["short", "long"] {
        let (_, said) = desk.says(&format!("{call} --report {form}"), 0);
        assert!(!said.contains("--report"), "{said}");
    }
}

#[test]
fn a_large_panel_is_tiled_if_so_many_sheets_are_allowed() {
    let desk = Desk::new(&[("large.csv", LARGE)]);
    let (words, _) = desk.says("make large.csv --out few --formats pdf --max-sheets 200", 0);
    let asked = words.split("--max-sheets ").nth(1).unwrap_or_else(|| panic!("{words}"));
    let enough = asked.split(' ').next().unwrap();
    let pages = |name: &str| {
        let bytes = fs::read(desk.path(name)).unwrap();
        String::from_utf8_lossy(&bytes).matches("/Type /Page\n").count()
    };
    assert_eq!(pages("few/pattern.pdf"), 2);
    let (words, _) = desk.says(&format!("make large.csv --out all --max-sheets {enough}"), 0);
    assert_eq!(words, "large: bends\n");
    assert_eq!(pages("all/pattern.pdf"), 1 + enough.parse::<usize>().unwrap());
    desk.says(&format!("convert large.csv all.pdf --max-sheets {enough}"), 0);
    assert_eq!(
        fs::read(desk.path("all.pdf")).unwrap(),
        fs::read(desk.path("all/pattern.pdf")).unwrap()
    );
    for wrong in ["0", "20001", "-1", "many", "1e3"] {
        let (_, error) = desk.says(&format!("make large.csv --out no --max-sheets={wrong}"), 2);
        assert!(error.contains("give a whole number from 1 to 20000"), "{error}");
    }
    assert!(!desk.path("no").exists());
}
