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
