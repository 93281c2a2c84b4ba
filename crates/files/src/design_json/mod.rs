//! Designs (`*.sheet.json`): JSON to a kernel design and back.
//!
//! Reading has two steps: serde makes the file's own types ([`grammar`]) and knows lines; then
//! [`convert`] makes the kernel's and knows JSON paths.

mod bends;
mod beside;
mod convert;
mod drawing;
mod grammar;
mod join;
mod marks;
mod material;
mod mesh;
mod sampling;
mod sheets;
mod source;
mod table_path;
mod thickness;
mod trims;
mod vary;
mod write;

pub(crate) use bends::{RuleName, rule};
pub(crate) use table_path::table_beside;
pub(crate) use trims::trims_of;
pub use trims::{trims_for, usual_trim};
pub use write::write_design;
pub(crate) use write::write_design_of_table;

use crate::drawing::Drawing;
use crate::json::{Object, TWICE};
use crate::names::{nearest, shown};
use crate::reading::{InputError, ReadOptions, display_name, refuse_large, text_of};
use crate::table::RANGE_HINT;
use grammar::DesignFile;
use serde::Deserialize;
use sheetwright::design::Design;
use source::Source;
use std::path::Path;

/// The version of the format that this program reads and writes.
const VERSION: u64 = 1;
const GRAMMAR_HINT: &str = "docs/files.md says what each field takes.";
const SYNTAX_HINT: &str =
    "Look for a missing comma, quotation mark or bracket, or for text after the last bracket.";

/// The design in a text. Tables that it refers to lie in `folder` or below.
pub(crate) fn read(
    text: &str,
    name: &str,
    folder: Option<&Path>,
    options: &ReadOptions,
) -> Result<Design, InputError> {
    let place = display_name(name);
    let mut file = parse(text, place)?;
    let source = Source { name, place, folder, options };
    // `make` ignores the field `drawing`, but refuses errors in it.
    drawing::read(file.drawing.take(), file.units.unwrap_or_default(), &source)?;
    convert::design(file, &source)
}

/// The design in some bytes, and how it is drawn. Tables that it refers to lie in `folder` or
/// below.
///
/// # Errors
/// Bytes that are no design, or a design that this version can't read.
pub fn read_drawn(
    bytes: &[u8],
    name: &str,
    folder: Option<&Path>,
) -> Result<(Design, Drawing), InputError> {
    let place = display_name(name);
    refuse_large(bytes, place)?;
    let mut file = parse(text_of(bytes, name)?, place)?;
    let source = Source { name, place, folder, options: &ReadOptions::default() };
    let drawing = drawing::read(file.drawing.take(), file.units.unwrap_or_default(), &source)?;
    Ok((convert::design(file, &source)?, drawing))
}

/// The bytes of the file of a design and its drawing. Both read back equal.
pub fn write_drawn(design: &Design, drawing: &Drawing) -> Vec<u8> {
    write::write_with(design, drawing::file_of(drawing).as_ref())
}

fn parse(text: &str, place: &str) -> Result<DesignFile, InputError> {
    let mut json = serde_json::Deserializer::from_str(text);
    let Object(file) = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        // A design of another version may have unknown fields; the error then names the version.
        other_version(text, place).unwrap_or_else(|| {
            let path = error.path().to_string();
            not_a_design(place, &path, error.inner())
        })
    })?;
    json.end().map_err(|error| not_a_design(place, "", &error))?;
    Ok(file)
}

/// The error for a design of another version; `None` if the text is no such design.
fn other_version(text: &str, place: &str) -> Option<InputError> {
    #[derive(Deserialize)]
    struct Versioned {
        sheetwright: u64,
    }
    let versioned: Versioned = serde_json::from_str(text).ok()?;
    wrong_version(versioned.sheetwright, place)
}

fn wrong_version(version: u64, place: &str) -> Option<InputError> {
    (version != VERSION).then(|| {
        InputError::at(
            format!("{place}: sheetwright"),
            format!("the version of the format is {version}"),
            format!("This program reads version {VERSION}: write \"sheetwright\": {VERSION}."),
        )
    })
}

/// The error of serde in the words of this program.
fn not_a_design(place: &str, path: &str, error: &serde_json::Error) -> InputError {
    let text = error.to_string();
    let at = format!(" at line {} column {}", error.line(), error.column());
    let text = text.strip_suffix(&at).unwrap_or(&text);
    // Before the first character of a line there is no column.
    let place = match error.column() {
        0 => format!("{place}:{}", error.line()),
        column => format!("{place}:{}:{column}", error.line()),
    };
    let place = match path {
        // There is no path at the top level or where a key is unreadable; serde_path_to_error gives
        // a dot or a question mark there.
        "" | "." | "?" => place,
        // A path contains names of the file, which may be of any length.
        path if path.len() > 200 => place,
        path => format!("{place}: {}", path.escape_debug()),
    };
    if text == "number out of range" {
        return InputError::at(place, "the number is out of range", RANGE_HINT);
    }
    if !error.is_data() {
        return InputError::at(place, format!("this is no JSON: {text}"), SYNTAX_HINT);
    }
    let (message, hint) = in_our_words(text);
    InputError::at(place, message, hint)
}

fn in_our_words(text: &str) -> (String, String) {
    for (what, beginning) in [("field", "unknown field `"), ("value", "unknown variant `")] {
        if let Some(rest) = text.strip_prefix(beginning)
            && let Some((wrong, known)) = rest.rsplit_once("`, expected ")
        {
            // The known names stand between backticks: every second part.
            let known: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
            // `$schema` is for editors.
            let known: Vec<&str> = known.into_iter().filter(|n| *n != "$schema").collect();
            let nearest = match nearest(wrong, known.iter().copied()) {
                Some(name) => format!("Did you mean `{name}`? "),
                None => String::new(),
            };
            let hint = format!("{nearest}Known here: {}.", known.join(", "));
            return (format!("the {what} {} is not known", shown(wrong)), hint);
        }
    }
    if let Some(field) = text.strip_prefix("missing field `") {
        let field = field.trim_end_matches('`');
        return (format!("the field `{field}` is missing"), format!("Add it: {GRAMMAR_HINT}"));
    }
    if let Some(field) = text.strip_prefix("duplicate field `") {
        let field = field.trim_end_matches('`');
        return (format!("the field `{field}` is written twice"), "Keep one of them.".to_owned());
    }
    if text.ends_with(TWICE) {
        return (text.to_owned(), "Keep one of them, or give the other a new name.".to_owned());
    }
    for kind in ["invalid type: ", "invalid value: "] {
        if let Some(rest) = text.strip_prefix(kind)
            && let Some((found, wanted)) = rest.rsplit_once(", expected ")
        {
            let message =
                format!("found {}, expected {}", found_in_words(found), wanted_in_words(wanted));
            return (message, GRAMMAR_HINT.to_owned());
        }
    }
    (text.to_owned(), GRAMMAR_HINT.to_owned())
}

/// The value that serde found, in words. `found` is in serde's notation: `string "12,5"`, `integer
/// `5``, `map`, `sequence`, `null`.
fn found_in_words(found: &str) -> String {
    match found {
        "map" => "an object".to_owned(),
        "sequence" => "a list".to_owned(),
        "null" => "null".to_owned(),
        _ => match found.split_once(' ') {
            Some(("string", text)) => {
                format!("the text {}", shown(text.trim_matches('"')))
            }
            Some(("boolean", value)) => value.trim_matches('`').to_owned(),
            Some(("integer", value)) => format!("the number {}", value.trim_matches('`')),
            Some(("floating", value)) => {
                let value = value.trim_start_matches("point ").trim_matches('`');
                format!("the number {value}")
            }
            _ => shown(found),
        },
    }
}

fn wanted_in_words(wanted: &str) -> &str {
    match wanted {
        "f64" => "a number",
        "u64" => "a whole number of 0 or more",
        "a string" => "a text",
        "a boolean" => "true or false",
        "a sequence" => "a list",
        _ if wanted.starts_with("struct ") => "an object",
        _ if wanted.contains("enum ") || wanted.contains("variant") => "one of the known words",
        _ => wanted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{InputFormat, read_bytes};
    use crate::reading::VarySettings;
    use sheetwright::boundary::{Continuity, Within};
    use sheetwright::curve::CurveKind;
    use sheetwright::design::{CurveUse, MovedBy, PanelMethod, PanelShape, Vary};
    use sheetwright::math::{Point3, from_deg};
    use sheetwright::triangulate::{Goal, WhichSurface};

    const DINGHY: &str = r#"{
  "sheetwright": 1, "name": "dinghy", "units": "m", "material": "plywood-4mm", "match_seams": true,
  "vary": { "budget": 0.5, "panels": ["lid"], "curves": ["rim"], "leave_developable": false },
  "curves": {
    "keel": { "kind": "spline", "points": [[0,0,0], [1,0,0.1], {"at": [2,0,0.3], "corner": true, "move": 0.01}] },
    "chine": { "kind": "polyline", "closed": false, "points": [[0,1,0], [2,1,0.2]] },
    "rim": { "kind": "bspline", "closed": true, "points": [[0,0,0], [1,0,0], [1,1,0], [0,1,0]] }
  },
  "panels": [
    { "name": "bottom", "rails": ["keel", "-chine"], "method": "rails", "goal": "worst-warp", "run_on": true, "slide": true, "fold": 0,
      "vary": { "warp_deg": 5.6, "limit": 0.02, "curves": ["keel"], "by": "samples" } },
    { "name": "lid", "boundary": ["-rim"], "holes": [["rim"]], "samples": 50, "plane": [0, 0, 1], "cut": [[0.5, 0, 0]],
      "side": "other", "near": [[0.5, 0.5, 0.1]] }
  ]
}"#;

    const QUILT: &str = r#"{
  "sheetwright": 1, "name": "quilt", "units": "cm",
  "curves": {
    "left": { "kind": "polyline", "points": [[4,9,0], [0,9,0], [0,0,0], [4,0,0]] },
    "seam": { "kind": "spline", "points": [[4,0,0], [5,4,1], [4,9,0]] },
    "right": { "kind": "polyline", "points": [[4,0,0], [9,0,0], [9,9,0], [4,9,0]] }
  },
  "panels": [
    { "name": "whole", "join": ["west", "east"], "smooth": "G2", "within": 0.5, "samples": 60 },
    { "name": "west", "boundary": ["left", "seam"] },
    { "name": "east", "boundary": ["right", "-seam"] }
  ]
}"#;

    fn read(text: &str) -> Result<Design, InputError> {
        let options = ReadOptions::default();
        read_bytes(InputFormat::Design, text.as_bytes(), "d.sheet.json", None, &options)
    }

    fn refused_in(text: &str, from: &str, to: &str) -> (String, String) {
        assert!(text.contains(from), "{from}");
        let error = read(&text.replacen(from, to, 1)).unwrap_err();
        (error.to_string(), error.hint)
    }

    fn refused(from: &str, to: &str) -> (String, String) {
        refused_in(DINGHY, from, to)
    }

    #[test]
    fn a_join_is_read_and_written() {
        let within = |text: &str| {
            let design = read(&QUILT.replace("\"within\": 0.5", text)).unwrap();
            let again = read(std::str::from_utf8(&write_design(&design)).unwrap()).unwrap();
            assert_eq!(design, again);
            let PanelShape::Join(join) = &design.panels[0].shape else { panic!() };
            assert_eq!(join.parts, ["west", "east"]);
            assert_eq!((join.smooth, design.panels[0].samples), (Continuity::G2, 60));
            (join.within, join.keep_parts)
        };
        assert_eq!(within("\"within\": 0.5"), (Within::Mm(5.0), false));
        assert_eq!(within("\"within\": 2, \"keep_parts\": true"), (Within::Mm(20.0), true));
        assert_eq!(within("\"within\": {\"share\": 0.07}"), (Within::Share(0.07), false));
        assert_eq!(within("\"method\": \"bridge\""), (Within::default(), false));
        let sharp = QUILT.replace("\"smooth\": \"G2\", \"within\": 0.5, ", "");
        let design = read(&sharp).unwrap();
        assert_eq!(read(std::str::from_utf8(&write_design(&design)).unwrap()), Ok(design));
    }

    #[test]
    fn joins_that_say_nothing_are_refused() {
        for (from, to, said) in [
            ("\"east\"]", "\"eest\"]", "panels[0].join[1]: there is no panel 'eest'"),
            ("\"east\"]", "\"west\"]", "panels[0].join[1]: the list names the panel 'west' twice"),
            ("\"east\"]", "\"whole\"]", "panels[0].join[1]: the panel joins itself"),
            (", \"east\"]", "]", "panels[0].join: `join` names one panel only"),
            ("\"G2\"", "\"G3\"", "panels[0].smooth: the value 'G3' is not known"),
            ("\"G2\"", "\"none\"", "panels[0].within: `within` applies to smooth joints only"),
            ("0.5", "0", "panels[0].within: `within` is neither a distance above 0 nor"),
            ("0.5", "{\"share\": 0.6}", "panels[0].within: `within` is neither a distance above 0"),
            ("0.5", "{\"part\": 0.6}", "panels[0].within.part: the field 'part' is not known"),
            ("0.5", "\"5%\"", "panels[0].within: found the text '5%', expected a distance or"),
            ("0.5", "1e300", "panels[0].within: the distance 1e300 cm is out of range"),
            ("\"join\"", "\"rails\"", "panels[0].smooth: the panel joins no others"),
            ("\"samples\"", "\"holes\": [], \"samples\"", "panels[0]: the panel joins others and"),
        ] {
            let (error, hint) = refused_in(QUILT, from, to);
            assert!(error.contains(&format!(": {said}")), "{said}: {error}");
            assert!(hint.ends_with('.'), "{hint}");
        }
        let join = "\"join\": [\"whole\", \"west\"]";
        let (error, _) = refused_in(QUILT, "\"boundary\": [\"right\", \"-seam\"]", join);
        assert!(error.ends_with("panels[0].join[1]: the panel 'east' is a join itself"), "{error}");
    }

    #[test]
    fn a_design_is_read() {
        let design = read(DINGHY).unwrap();
        assert_eq!(design.material.as_ref().map(|m| &m.name[..]), Some("plywood-4mm"));
        let names: Vec<&str> = design.curves.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["keel", "chine", "rim"]);
        let keel = &design.curves[0];
        assert_eq!((keel.kind, keel.closed), (Some(CurveKind::Spline), false));
        assert_eq!(keel.points[2].at, Point3::new(2000.0, 0.0, 300.0));
        assert!(keel.points[2].corner && !keel.points[1].corner);
        let [bottom, lid] = design.panels.as_slice() else { panic!() };
        let rails = [("keel", false), ("chine", true)]
            .map(|(name, reversed)| CurveUse { name: name.into(), reversed });
        assert_eq!(bottom.shape, PanelShape::Rails(rails));
        assert_eq!((bottom.method, bottom.fold), (PanelMethod::Rails, 0.0));
        assert_eq!((bottom.goal, lid.goal), (Goal::WorstWarp, Goal::Price));
        assert!(bottom.run_on && !lid.run_on);
        assert!(bottom.slides && !lid.slides);
        assert_eq!((bottom.samples, lid.samples), (200, 50));
        assert_eq!((bottom.cut.len(), lid.cut[0]), (0, Point3::new(500.0, 0.0, 0.0)));
        assert_eq!((bottom.which, lid.which), (WhichSurface::Cheapest, WhichSurface::Other));
        assert_eq!((bottom.near.len(), lid.near[0]), (0, Point3::new(500.0, 500.0, 100.0)));
        assert_eq!(keel.points.iter().map(|p| p.move_mm).collect::<Vec<_>>(), [0.0, 0.0, 10.0]);
        assert!(design.match_seams);
        let of_lid = Vary {
            panels: vec!["lid".into()],
            curves: vec!["rim".into()],
            budget_mm: Some(500.0),
            leave_developable: false,
            ..Vary::default()
        };
        let of_bottom = Vary {
            panels: vec!["bottom".into()],
            curves: vec!["keel".into()],
            goal: sheetwright::design::VaryGoal::Warp { largest: from_deg(5.6) },
            limit_mm: Some(20.0),
            by: MovedBy::Samples,
            ..Vary::default()
        };
        assert_eq!(design.vary, [of_bottom, of_lid]);
    }

    #[test]
    fn a_design_reads_back_equal() {
        let design = read(DINGHY).unwrap();
        let written = write_design(&design);
        let again = read(std::str::from_utf8(&written).unwrap()).unwrap();
        assert_eq!(design, again);
        assert_eq!(written, write_design(&again));
    }

    #[test]
    fn a_number_of_samples_comes_before_a_tolerance_and_that_of_a_panel_before_the_designs() {
        use sheetwright::design::SampleTolerance;
        let text = |top: &str, panel: &str| {
            DINGHY
                .replace("\"match_seams\": true,", &format!("\"match_seams\": true, {top}"))
                .replace("\"samples\": 50", panel)
        };
        let lid = |top: &str, panel: &str, options: &ReadOptions| {
            let text = text(top, panel);
            let design =
                read_bytes(InputFormat::Design, text.as_bytes(), "d.json", None, options).unwrap();
            let again = read(std::str::from_utf8(&write_design(&design)).unwrap()).unwrap();
            assert_eq!(again, design, "{text}");
            let lid = design.panels.into_iter().find(|panel| panel.name == "lid").unwrap();
            (lid.samples, lid.tolerance)
        };
        let none = ReadOptions::default();
        let mm = |mm: f64| Some(SampleTolerance::Mm(mm));
        let asked = ReadOptions { tolerance_mm: Some(0.25), ..ReadOptions::default() };
        // The units are metres.
        for (top, panel, options, expected) in [
            ("", "\"effort\": 1", &none, (400, Some(SampleTolerance::USUAL))),
            ("", "\"tolerance\": 0.002", &none, (100, mm(2.0))),
            ("\"tolerance\": 0.001,", "\"effort\": 1", &none, (100, mm(1.0))),
            ("\"tolerance\": 0.001,", "\"tolerance\": 0.002", &none, (100, mm(2.0))),
            ("\"tolerance\": 0.001,", "\"samples\": 60", &none, (60, None)),
            ("", "\"samples\": 60, \"tolerance\": 0.002", &none, (60, None)),
            ("\"tolerance\": 0.001,", "\"samples\": 60", &asked, (100, mm(0.25))),
        ] {
            assert_eq!(lid(top, panel, options), expected, "{top} {panel}");
        }
    }

    #[test]
    fn what_the_caller_sets_comes_first() {
        let options = ReadOptions {
            rails: Vec::new(),
            second_table: None,
            plane: Some(sheetwright::boundary::PlaneChoice::None),
            samples: Some(77),
            tolerance_mm: Some(0.1),
            fold: Some(2.0),
            effort: Some(20.0),
            method: Some(PanelMethod::Bridge),
            which: Some(WhichSurface::Other),
            slides: Some(true),
            units: None,
            material: Some("Leather-2mm".to_owned()),
            vary: VarySettings {
                warp_deg: Some(3.0),
                limit_mm: Some(7.0),
                ..VarySettings::default()
            },
            mesh: crate::MeshSettings::default(),
            trade: None,
            allowance_mm: None,
            bends: crate::BendSettings::default(),
            dimensions: None,
            thickness_mm: None,
            bend_radius_mm: None,
            sheets: crate::SheetSettings::default(),
        };
        let design =
            read_bytes(InputFormat::Design, DINGHY.as_bytes(), "d.json", None, &options).unwrap();
        assert_eq!(design.material.as_ref().map(|m| &m.name[..]), Some("leather-2mm"));
        for panel in &design.panels {
            assert_eq!((panel.samples, panel.fold, panel.effort), (77, 2.0, 20.0));
            assert_eq!(panel.tolerance, None);
            assert_eq!((panel.method, panel.which), (PanelMethod::Bridge, WhichSurface::Other));
        }
        for vary in &design.vary {
            assert_eq!(vary.limit_mm, Some(7.0));
            assert_eq!(vary.goal, sheetwright::design::VaryGoal::Warp { largest: from_deg(3.0) });
        }
        assert_eq!(design.vary[1].budget_mm, Some(500.0));
        let still = DINGHY.lines().filter(|line| !line.contains("vary")).collect::<String>();
        let still = still.replace("\"fold\": 0,", "\"fold\": 0 },");
        let moved = read_bytes(InputFormat::Design, still.as_bytes(), "d.json", None, &options);
        assert_eq!(moved.unwrap().vary.len(), 1);
    }

    #[test]
    fn an_unknown_field_names_the_nearest_known_one() {
        let (error, hint) = refused("\"samples\": 50", "\"sampels\": 50");
        assert!(error.starts_with("d.sheet.json:12:"), "{error}");
        assert!(error.ends_with("panels[1].sampels: the field 'sampels' is not known"), "{error}");
        assert!(hint.starts_with("Did you mean `samples`? Known here: name, rails,"), "{hint}");
    }

    #[test]
    fn a_later_version_is_named_before_its_fields() {
        let (error, _) = refused("\"sheetwright\": 1,", "\"sheetwright\": 2, \"skins\": [],");
        assert_eq!(error, "d.sheet.json: sheetwright: the version of the format is 2");
    }

    #[test]
    fn errors_know_their_path() {
        for (from, to, path) in [
            ("[1,0,0.1]", "[1,0]", "curves.keel.points[1]"),
            ("[1,0,0.1]", "[1,0,\"a\"]", "curves.keel.points[1][2]"),
            ("[1,0,0.1]", "[1,0,1e9]", "curves.keel.points[1]"),
            ("\"-chine\"", "\"-chin\"", "panels[0].rails[1]"),
            ("\"name\": \"lid\"", "\"name\": \"BOTTOM\"", "panels[1].name"),
            ("\"fold\": 0", "\"fold\": 11", "panels[0].fold"),
            ("\"fold\": 0", "\"effort\": 0", "panels[0].effort"),
            ("\"fold\": 0", "\"effort\": 1001", "panels[0].effort"),
            ("\"plane\": [0, 0, 1]", "\"plane\": \"automatic\"", "panels[1].plane"),
            ("\"worst-warp\"", "\"max\"", "panels[0].goal"),
            ("\"samples\": 50", "\"run_on\": true", "panels[1].run_on"),
            ("\"samples\": 50", "\"vary\": {\"budget\": -1}", "panels[1].vary.budget"),
            ("\"samples\": 50", "\"vary\": [1]", "panels[1].vary"),
            ("\"limit\": 0.02", "\"limit\": 1e9", "panels[0].vary.limit"),
            ("\"warp_deg\": 5.6", "\"warp_deg\": 91", "panels[0].vary.warp_deg"),
            ("[\"keel\"]", "[\"keel\", \"kiel\"]", "panels[0].vary.curves[1]"),
            ("[\"lid\"]", "[]", "vary.panels"),
            ("[\"lid\"]", "[\"bottom\"]", "panels[0].vary"),
            ("\"cut\": [[0.5, 0, 0]]", "\"cut\": [0.5, 0, 0]", "panels[1].cut[0]"),
            ("\"cut\": [[0.5, 0, 0]]", "\"cut\": [[0.5, 0, 1e9]]", "panels[1].cut[0]"),
            ("\"fold\": 0", "\"cut\": [[0, 0, 0]]", "panels[0].cut"),
            ("plywood-4mm", "plywod-4mm", "material"),
            ("\"m\"", "\"metre\"", "units"),
        ] {
            let (error, _) = refused(from, to);
            assert!(error.contains(&format!(": {path}: ")), "{path}: {error}");
        }
    }

    #[test]
    fn the_schema_is_that_of_the_code() {
        let schema = schemars::schema_for!(DesignFile);
        let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        crate::json::assert_schema_in_docs("design.schema.json", &text);
    }
}
