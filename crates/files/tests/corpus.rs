//! The named boundaries of `corpus/good`: whatever is known of each of them holds.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use serde_json::{Map, Value};
use sheetwright::boundary::PlaneChoice;
use sheetwright::check::Verdict;
use sheetwright::design::BendMarks;
use sheetwright::make::{Made, Part, make};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    BendSettings, Format, Outputs, PatternReadError, PdfOptions, ReadOptions, ReadPattern, Units,
    finding_text, material_named, output_files, read_dxf, read_input, read_svg,
};
use std::fs;
use std::path::{Path, PathBuf};

/// Lengths in space and flat agree to this share, whatever the boundary.
const LENGTH_ERROR: f64 = 1e-9;
/// So do areas, in which the errors of two lengths meet.
const AREA_ERROR: f64 = 1e-9;
/// What was written, folded up again, misses the surface by less than this share of its size.
const REFOLD_ERROR: f64 = 1e-6;

/// The files with one of these endings, in the order of their names.
fn entries(endings: &[&str]) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good");
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let has = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy();
        endings.iter().any(|ending| name.ends_with(&format!(".{ending}")))
    };
    let mut found: Vec<PathBuf> = entries.filter(has).collect();
    found.sort();
    found
}

/// The name of an entry, without its endings.
fn name_of(entry: &Path) -> String {
    let file = entry.file_name().unwrap().to_string_lossy();
    file.split('.').next().unwrap().to_owned()
}

fn facts_of(entry: &Path) -> Map<String, Value> {
    let facts = fs::read(entry.with_file_name(format!("{}.facts.json", name_of(entry)))).unwrap();
    serde_json::from_slice(&facts).unwrap()
}

#[test]
fn the_facts_of_every_mesh_hold() {
    let meshes = entries(&["obj", "stl", "ply", "glb"]);
    assert!(meshes.len() >= 4, "{meshes:?}");
    let mut wrong = Vec::new();
    for mesh in meshes {
        let name = name_of(&mesh);
        let facts = facts_of(&mesh);
        let units =
            facts.get("units").map(|name| Units::from_name(name.as_str().unwrap()).unwrap());
        let options = ReadOptions { units, ..ReadOptions::default() };
        let mut design = read_input(&mesh, &options).unwrap();
        if let Some(name) = facts.get("material") {
            design.material = Some(material_named(name.as_str().unwrap(), &[]).unwrap());
        }
        let made = make(&design, &mut Unwatched).unwrap();
        let outputs = output_files(&made, &Format::DEFAULT, &PdfOptions::default()).unwrap();
        let report: Value = serde_json::from_slice(file(&outputs, "report.json")).unwrap();
        let mut problems = differences(&report["panels"][0], &facts);
        let panels = facts.get("panels").map_or(1, |count| count.as_u64().unwrap());
        if made.parts.len() as u64 != panels {
            wrong.push(format!("{name}: it has {} panels, not {panels}", made.parts.len()));
            continue;
        }
        assert!(panels != 1 || outputs.files.len() == 6);
        let panel = &made.parts[0];
        problems.extend(fault_of_files(&outputs));
        let svg = read_svg(file(&outputs, &format!("{}.svg", panel.name)));
        let dxf = read_dxf(file(&outputs, &format!("{}.dxf", panel.name)));
        let near = 1e-9_f64.max(1e-12 * panel.piece.size.length());
        for read in [svg, dxf] {
            let Some(read) = readable(read, panel.flat.overlap.is_some()) else { continue };
            let lines = || std::iter::once(&read.outline).chain(&read.holes);
            let same = lines().map(Vec::len).eq(panel.piece.loops().map(<[_]>::len));
            let mut corners = lines().flatten().zip(panel.piece.loops().flatten());
            if !same || !corners.all(|(read, corner)| read.distance(*corner) <= near) {
                problems.push("a file reads back as another pattern".to_owned());
            }
        }
        wrong.extend(problems.into_iter().map(|what| format!("{name}: {what}")));
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn the_facts_of_every_boundary_hold() {
    let boundaries = entries(&["csv", "sheet.json", "svg", "dxf"]);
    assert!(boundaries.len() >= 19, "{boundaries:?}");
    let mut wrong = Vec::new();
    for entry in boundaries {
        let name = name_of(&entry);
        let facts = facts_of(&entry);
        let plane = facts.get("plane").map(|plane| match plane.as_str() {
            Some("none") => PlaneChoice::None,
            _ => panic!("{name}: {plane}"),
        });
        // All rungs are drawn, so that files tell whether they are those of the surface.
        let bends = BendSettings { marks: Some(BendMarks::Rulings), ..BendSettings::default() };
        let options = ReadOptions { plane, bends, ..ReadOptions::default() };
        let mut made = make(&read_input(&entry, &options).unwrap(), &mut Unwatched).unwrap();
        made.advise(&mut Unwatched);
        let outputs = output_files(&made, &Format::DEFAULT, &PdfOptions::default()).unwrap();
        // Whatever the boundary, quads and a smooth surface come out, or a finding says why not.
        let smooth = [Format::Quads, Format::Step];
        let smooth = output_files(&made, &smooth, &PdfOptions::default()).unwrap();
        assert_eq!(smooth.files.len(), 2, "{name}");
        let report: Value = serde_json::from_slice(file(&outputs, "report.json")).unwrap();
        let problems = differences(&report["panels"][0], &facts);
        let problems = problems.into_iter().chain(always(&made, &outputs));
        wrong.extend(problems.map(|what| format!("{name}: {what}")));
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// A verdict may become "can't tell" with other samples, or be told then, and no more.
#[test]
fn verdicts_stay_with_twice_the_samples() {
    let mut wrong = Vec::new();
    for entry in entries(&["csv", "sheet.json"]) {
        let name = name_of(&entry);
        let plane = facts_of(&entry).contains_key("plane").then_some(PlaneChoice::None);
        let verdict = |samples: usize| {
            let options = ReadOptions { plane, samples: Some(samples), ..ReadOptions::default() };
            let made = make(&read_input(&entry, &options).unwrap(), &mut Unwatched).unwrap();
            made.parts[0].checked.verdict
        };
        let verdicts = [100, 200, 400].map(verdict);
        let mut told = verdicts.into_iter().filter(|&verdict| verdict != Verdict::Undecided);
        let first = told.next();
        if told.any(|verdict| Some(verdict) != first) {
            wrong.push(format!("{name}: {verdicts:?}"));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// A file as it was read; `None` if its lines are no outline with holes since the pattern overlaps
/// itself.
fn readable(read: Result<ReadPattern, PatternReadError>, overlaps: bool) -> Option<ReadPattern> {
    match read {
        Err(PatternReadError::Outlines(_)) if overlaps => None,
        read => Some(read.unwrap()),
    }
}

/// What the finding says that written files are not what was laid, which is a fault of the program.
fn fault_of_files(outputs: &Outputs) -> Option<String> {
    let fault = outputs.panels[0].findings.iter().find(|finding| finding.code() == "refold");
    fault.map(finding_text)
}

fn file<'a>(outputs: &'a Outputs, name: &str) -> &'a [u8] {
    &outputs.files.iter().find(|file| file.name == name).unwrap().bytes
}

/// How a panel of a report differs from the facts. Those that are listed under `not_yet` must: who
/// mends one strikes it off the list.
fn differences(panel: &Value, facts: &Map<String, Value>) -> Vec<String> {
    let none = Map::new();
    let not_yet = facts.get("not_yet").map_or(&none, |list| list.as_object().unwrap());
    assert!(not_yet.keys().all(|fact| facts.contains_key(fact)), "{not_yet:?}");
    let facts = facts.iter().filter(|(fact, _)| *fact != "not_yet");
    let problems = facts.map(|(fact, wanted)| (fact, differs(panel, fact, wanted)));
    let problems = problems.filter_map(|(fact, problem)| match not_yet.get(fact) {
        None => problem,
        Some(_) if problem.is_some() => None,
        Some(_) => Some(format!("{fact} holds by now: take it out of not_yet")),
    });
    problems.collect()
}

/// How a panel of a report differs from a fact, if it does.
fn differs(panel: &Value, fact: &str, wanted: &Value) -> Option<String> {
    let found = &panel[fact];
    let holds = match (fact, wanted) {
        ("about" | "plane" | "units" | "material", Value::String(_))
        | ("panels", Value::Number(_)) => true,
        ("says", Value::Array(texts)) => texts.iter().all(|text| {
            let findings = panel["findings"].as_array().unwrap();
            let text = text.as_str().unwrap();
            findings.iter().any(|finding| finding["text"].as_str().unwrap().starts_with(text))
        }),
        ("findings", Value::Array(codes)) => codes.iter().all(|code| {
            assert!(code.is_string(), "findings are codes, not {code}");
            found.as_array().unwrap().iter().any(|finding| finding["code"] == *code)
        }),
        (_, Value::String(_) | Value::Bool(_)) => found == wanted,
        (_, Value::Array(range)) => {
            let range: Vec<f64> = range.iter().map(|end| end.as_f64().unwrap()).collect();
            assert_eq!(range.len(), 2, "{fact}: a range has two ends");
            found.as_f64().is_some_and(|found| range[0] <= found && found <= range[1])
        }
        _ => panic!("{fact}: {wanted} is no fact"),
    };
    let found = if fact == "says" { &panel["findings"] } else { found };
    (!holds).then(|| format!("{fact} is {found}, not {wanted}"))
}

/// What must hold of every boundary, and does not.
fn always(made: &Made, outputs: &Outputs) -> Vec<String> {
    assert_eq!((made.parts.len(), outputs.refold_error_mm.len()), (1, 1));
    let panel = &made.parts[0];
    let (measures, size) = (&panel.measures, panel.found().unwrap().boundary.size());
    let refold = outputs.refold_error_mm[0] / size;
    let areas = measures.area_flat_mm2 / measures.area_space_mm2 - 1.0;
    let mut wrong = Vec::new();
    for (what, found, most) in [
        ("length error", measures.length_error_max, LENGTH_ERROR),
        ("refold error by size", refold, REFOLD_ERROR),
        ("areas, flat by space, less 1", areas.abs(), AREA_ERROR),
    ] {
        // NaN is no error below a limit.
        if found.is_nan() || found >= most {
            wrong.push(format!("{what} is {found}, not below {most}"));
        }
    }
    let name = &panel.name;
    wrong.extend(fault_of_files(outputs));
    let svg = read_svg(file(outputs, &format!("{name}.svg")));
    let dxf = read_dxf(file(outputs, &format!("{name}.dxf")));
    for (format, read) in [("SVG", svg), ("DXF", dxf)] {
        let Some(read) = readable(read, panel.flat.overlap.is_some()) else { continue };
        if !is_pattern_of(&read, panel) {
            wrong.push(format!("the {format} reads back as another pattern"));
        }
    }
    wrong
}

fn is_pattern_of(read: &ReadPattern, panel: &Part) -> bool {
    let near = 1e-9_f64.max(1e-12 * panel.found().unwrap().boundary.size());
    let lines = || std::iter::once(&read.outline).chain(&read.holes);
    let mut corners = lines().flatten().zip(panel.piece.loops().flatten());
    read.rungs == panel.sheet.rungs()
        && lines().map(Vec::len).eq(panel.piece.loops().map(<[_]>::len))
        && corners.all(|(read, corner)| read.distance(*corner) <= near)
}
