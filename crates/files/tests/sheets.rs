//! Parts on sheets as files: one drawing, the list of parts, the report.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::make::make;
use sheetwright::template::template;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, OutputOptions, Outputs, ReadOptions, SheetSettings, formats_for, output_files,
    read_input, stock_sheet,
};

fn written(sheet: &str) -> Outputs {
    let mut design = template("elbow").unwrap().defaults().design().unwrap();
    let sheets = vec![stock_sheet(sheet).unwrap()];
    let settings = SheetSettings { sheets, effort: Some(0.02), ..SheetSettings::default() };
    settings.set(&mut design).unwrap();
    let formats = formats_for(&design);
    assert!(formats.contains(&Format::Sheets) && formats.contains(&Format::Parts));
    let mut made = make(&design, &mut Unwatched).unwrap();
    made.lay_out(&mut Unwatched);
    output_files(&made, &formats, OutputOptions::of(&design)).unwrap()
}

fn text(outputs: &Outputs, name: &str) -> String {
    let file = outputs.files.iter().find(|file| file.name == name).unwrap();
    String::from_utf8(file.bytes.clone()).unwrap()
}

#[test]
fn sheets_are_one_drawing_with_a_layer_for_their_edges() {
    let outputs = written("800x500mm");
    let svg = text(&outputs, "sheets.svg");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let of_class = |class: &str| {
        document.descendants().filter(|node| node.attribute("class") == Some(class)).count()
    };
    assert_eq!((of_class("outline"), of_class("label") > 20), (5, true));
    assert!(of_class("sheet") >= 1 && of_class("dimension") == 0);
    let ids: Vec<&str> = document.descendants().filter_map(|node| node.attribute("id")).collect();
    let mut unique = ids.clone();
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(ids.len(), unique.len(), "{ids:?}");
    assert!(ids.contains(&"sheet"));
    let dxf = text(&outputs, "sheets.dxf");
    assert!(dxf.matches("POLYLINE").count() > 5);
}

#[test]
fn sheets_of_a_design_without_any_are_refused_and_copies_have_places_of_their_own() {
    let mut design = template("cone").unwrap().defaults().design().unwrap();
    design.panels[0].count = 3;
    let made = make(&design, &mut Unwatched).unwrap();
    let refused = output_files(&made, &[Format::Sheets], OutputOptions::of(&design)).unwrap_err();
    assert_eq!(refused.to_string(), "the design has no sheets to lay its parts out on");
    let sheets = vec![stock_sheet("2x1000x600mm").unwrap()];
    SheetSettings { sheets, effort: Some(0.01), ..SheetSettings::default() }
        .set(&mut design)
        .unwrap();
    let mut made = make(&design, &mut Unwatched).unwrap();
    made.lay_out(&mut Unwatched);
    let outputs = output_files(&made, &[Format::Parts], OutputOptions::of(&design)).unwrap();
    let table = text(&outputs, "parts.csv");
    let row = table.lines().nth(1).unwrap();
    // Three are cut, and each has a sheet, or nothing where none is left.
    let nested = made.nested.as_ref().unwrap();
    let sheets: Vec<&str> = row.rsplit(',').nth(4).unwrap().split("; ").collect();
    assert_eq!(sheets.len(), 3, "{row}");
    let laid = sheets.iter().filter(|sheet| !sheet.is_empty()).count();
    assert_eq!((laid, nested.parts.len() > 1), (nested.parts.len(), true), "{row}");
}

#[test]
fn the_list_of_parts_and_the_report_say_where_each_lies() {
    let outputs = written("800x500mm");
    let table = text(&outputs, "parts.csv");
    let mut lines = table.lines();
    assert!(lines.next().unwrap().ends_with("sheet,x_mm,y_mm,turn_deg,turned_over"));
    let row = lines.next().unwrap();
    assert!(row.ends_with(",no; no"), "{row}");
    let report: serde_json::Value = serde_json::from_str(&text(&outputs, "report.json")).unwrap();
    let sheets = report["sheets"]["list"].as_array().unwrap();
    let parts = sheets.iter().flat_map(|sheet| sheet["parts"].as_array().unwrap());
    let mut names: Vec<&str> = parts.map(|part| part["name"].as_str().unwrap()).collect();
    names.sort_unstable();
    assert_eq!(names, ["segment-1", "segment-2", "segment-3", "segment-4", "segment-5"]);
    assert_eq!(report["sheets"]["proved"], true);
    assert_eq!(sheets[0]["kind"], "800 × 500 mm");
    let page = text(&outputs, "report.html");
    assert!(page.contains("<h2>Sheets</h2>") && page.contains("sheet-1, 800 × 500 mm"));
    let small = text(&written("300x200mm"), "report.html");
    assert!(small.contains("Larger than every sheet: segment-1, segment-2."));
}

#[test]
fn holes_are_cut_before_any_outline() {
    let options = ReadOptions::default();
    let mut design = read_input("../../corpus/good/lid-with-hatch.csv".as_ref(), &options).unwrap();
    design.panels[0].count = 2;
    let sheets = vec![stock_sheet("5x5m").unwrap()];
    let settings = SheetSettings { sheets, effort: Some(0.01), ..SheetSettings::default() };
    settings.set(&mut design).unwrap();
    let mut made = make(&design, &mut Unwatched).unwrap();
    made.lay_out(&mut Unwatched);
    let outputs = output_files(&made, &[Format::Sheets], OutputOptions::of(&design)).unwrap();
    let svg = text(&outputs, "sheets.svg");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let cut = document.descendants().find(|node| node.attribute("id") == Some("cut")).unwrap();
    let classes: Vec<&str> = cut.children().filter_map(|path| path.attribute("class")).collect();
    assert_eq!(classes, ["hole", "hole", "outline", "outline"]);
}
