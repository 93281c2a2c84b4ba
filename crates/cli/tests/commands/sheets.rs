//! Parts on sheets, and parts that are larger than them.

use super::{Desk, SQUARE, names_in};
use std::fs;

#[test]
fn parts_are_laid_out_where_sheets_are_given() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    let call = "make square.csv --effort 0.01 --sheet 300x200mm";
    let (_, said) = desk.says(&format!("{call} --out out"), 0);
    assert!(said.contains("1 part on 1 sheet, of which 17 % is used"), "{said}");
    let names = names_in(&desk.path("out"));
    for name in ["sheets.svg", "sheets.dxf", "parts.csv"] {
        assert!(names.iter().any(|other| other == name), "{names:?}");
    }
    desk.says(&format!("{call} --out again"), 0);
    let bytes = |folder: &str, name: &str| fs::read(desk.path(folder).join(name)).unwrap();
    for name in names.iter().filter(|name| *name != "timing.json") {
        assert_eq!(bytes("out", name), bytes("again", name), "{name}");
    }
    let (_, said) = desk.says("make square.csv --out no --formats sheets", 2);
    assert!(said.contains("the design has no sheets to lay its parts out on"), "{said}");
    assert!(!desk.path("no").exists());
}

#[test]
fn sheets_have_a_file_each_and_what_is_said_of_sheets_needs_one() {
    let desk = Desk::new(&[("square.csv", SQUARE), ("sheets.csv", SQUARE)]);
    let call = "make square.csv --effort 0.01 --sheet 300x200mm --formats sheets";
    desk.says(&format!("{call} --sheet-files each --out each"), 0);
    assert_eq!(names_in(&desk.path("each")), ["sheets-1.dxf", "sheets-1.svg"]);
    desk.says(&format!("{call} --common-lines --out common"), 0);
    assert_eq!(names_in(&desk.path("common")), ["sheets.dxf", "sheets.svg"]);
    let (_, said) = desk.says(&format!("{call} --common-lines --gap 2mm --out no"), 2);
    assert!(said.contains("parts with cuts in common lie a kerf apart"), "{said}");
    for asked in ["--divide scarf", "--gap 2mm", "--margin 9mm", "--sheet-files each"] {
        let (_, said) = desk.says(&format!("make square.csv --out no {asked}"), 2);
        assert!(said.contains("there is no sheet to lay parts out on"), "{asked}: {said}");
    }
    // Two files of one name are never written.
    let call = "make sheets.csv --effort 0.01 --sheet 300x200mm --out no";
    let (_, said) = desk.says(call, 2);
    assert!(said.contains("a panel has the name of a file that is written as well"), "{said}");
    assert!(!desk.path("no").exists());
}

#[test]
fn what_is_larger_than_its_sheet_is_said_and_divided_where_that_is_asked_for() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    let call = "make square.csv --effort 0.01 --margin 0 --sheet 80x120mm --formats parts";
    let (words, said) = desk.says(&format!("{call} --out whole"), 0);
    assert!(words.contains("--divide scarf divides it"), "{words}");
    assert!(said.contains("Larger than every sheet: square."), "{said}");
    let (words, said) = desk.says(&format!("{call} --out pieces --divide overlap"), 0);
    assert!(words.contains("square-1: bends") && words.contains("square-2: bends"), "{words}");
    assert!(said.contains("2 parts on 2 sheets"), "{said}");
    let (_, said) = desk.says("new dinghy --make boat --sheet 1220", 2);
    assert!(said.contains("give a width and a height such as 1220x2440mm"), "{said}");
}
