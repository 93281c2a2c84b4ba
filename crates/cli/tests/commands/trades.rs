//! What a trade brings, and the walks of its pages.

use super::{Desk, TWO_PANELS, names_in};
use std::fs;
use std::path::Path;

#[test]
fn a_trade_brings_its_files_and_gives_way_to_what_is_said() {
    let own = r#"{ "for": "duct", "formats": ["report", "svg"], "preset": "glowforge", "#;
    let own = TWO_PANELS.replacen("{ ", own, 1);
    let desk = Desk::new(&[("own.sheet.json", &own)]);
    let names = |folder: &str| names_in(&desk.path(folder));
    let dxf = |folder: &str| fs::read_to_string(desk.path(folder).join("segment-1.dxf")).unwrap();
    let has = |folder: &str, name: &str| names(folder).iter().any(|other| other == name);
    // A template says what it is usually made for; the design is bare until it is told.
    let (bare, said) = desk.says("new elbow", 0);
    assert!(!bare.contains("\"for\"") && said.contains("--for duct"), "{said}");
    let (design, said) = desk.says("new elbow --for duct", 0);
    assert!(design.contains("\"for\": \"duct\"") && said.is_empty(), "{said}");
    let (list, _) = desk.says("new elbow --list", 0);
    assert!(list.contains("Usually made for: duct."), "{list}");
    desk.says("new elbow --for dact", 2);

    desk.says("new elbow --for duct --make out", 0);
    assert!(has("out", "brake.csv") && !has("out", "surface.obj"), "{:?}", names("out"));
    assert!(dxf("out").contains("AC1015"));
    // As make makes it.
    desk.says("make out/elbow.sheet.json --out again", 0);
    let beside: Vec<String> =
        names("out").into_iter().filter(|n| n != "elbow.sheet.json").collect();
    assert_eq!(names("again"), beside);
    // The command comes first, also with another trade.
    desk.says("make out/elbow.sheet.json --out few --formats dxf --dxf r12", 0);
    assert!(
        names("few").iter().all(|name| name.ends_with(".dxf")) && dxf("few").contains("AC1009")
    );
    desk.says("make out/elbow.sheet.json --out laser --for laser", 0);
    assert!(!has("laser", "brake.csv") && !has("laser", "pattern.pdf"));
    let svg = fs::read_to_string(desk.path("laser/segment-1.svg")).unwrap();
    assert!(svg.contains("#f36926"), "LightBurn's tool layer");
    // A preset that is chosen brings its own release.
    desk.says("make out/elbow.sheet.json --out chosen --preset lightburn --formats dxf", 0);
    assert!(dxf("chosen").contains("AC1009"));
    // Then come the fields of the design, which stay when it is written again.
    desk.says("make own.sheet.json --out own", 0);
    assert_eq!(names("own"), ["one.svg", "report.html", "report.json", "timing.json", "two.svg"]);
    let svg = fs::read_to_string(desk.path("own/one.svg")).unwrap();
    assert!(svg.contains("#00a000") || !svg.contains("id=\"note\""), "Glowforge has no notes");
    desk.says("convert own.sheet.json twice.sheet.json", 0);
    let twice = fs::read_to_string(desk.path("twice.sheet.json")).unwrap();
    for field in
        ["\"for\": \"duct\"", "\"formats\": [\"report\",\"svg\"]", "\"preset\": \"glowforge\""]
    {
        assert!(twice.contains(field), "{twice}");
    }
}

/// The fenced blocks of a page: what stands after the fence, and the lines.
fn fenced(page: &str) -> Vec<(&str, Vec<&str>)> {
    let blocks = page.split("```").skip(1).step_by(2);
    blocks
        .map(|block| {
            let (kind, lines) = block.split_once('\n').unwrap();
            (kind, lines.lines().collect())
        })
        .collect()
}

/// Every page of a trade walks from a template to files; its lines run as they stand.
#[test]
fn the_walks_of_the_trades_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/trades");
    let pages = names_in(&folder);
    assert_eq!(pages.len(), 9);
    for name in pages {
        let page = fs::read_to_string(folder.join(&name)).unwrap().replace('\r', "");
        let blocks = fenced(&page);
        let desk = Desk::new(&[]);
        let calls: Vec<&str> =
            blocks[0].1.iter().map(|line| line.strip_prefix("sheetwright ").unwrap()).collect();
        for call in &calls {
            desk.says(call, 0);
        }
        let out = calls[1].split_once("--out ").unwrap().1.split(' ').next().unwrap();
        let made = names_in(&desk.path(out));
        assert_eq!(blocks[1].0, "text", "{name}");
        for file in blocks[1].1.iter().flat_map(|line| line.split(' ')) {
            assert!(made.iter().any(|other| other == file), "{name}: {file} of {made:?}");
        }
        // What a design may say instead goes with the template, but for names that are mine.
        for (_, lines) in blocks.iter().skip(2) {
            let design = calls[0].split_once("-o ").unwrap().1;
            let text = fs::read_to_string(desk.path(design)).unwrap();
            let fields: String = lines.concat();
            let text = text.replacen("\"for\"", "\"instead\"", 1);
            let at = text.find("  \"instead\"").unwrap();
            let own = format!("{}{fields}\n}}\n", &text[..at]);
            fs::write(desk.path("own.sheet.json"), own).unwrap();
            desk.says("check own.sheet.json --verdict quick", 0);
        }
    }
}
