//! Presets: what a machine's files hold, and that every one of them is proved.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use sheetwright::make::{Made, Part, make};
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use sheetwright::predicate::signed_area_doubled;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    DxfRelease, Format, OutputOptions, PatternFiles, Preset, ReadOptions, RefoldFileError,
    output_files, read_dxf, read_input, refold_files_error_mm, write_dxf_for, write_dxf_with,
    write_svg_for,
};
use std::path::Path;

fn made(file: &str) -> Made {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    make(&read_input(&path, &ReadOptions::default()).unwrap(), &mut Unwatched).unwrap()
}

/// A panel whose cut lies off the finished piece, with everything that a trim may add.
fn trimmed() -> Part {
    let mut part = made("corpus/good/lid-with-hatch.csv").parts.remove(0);
    let loops: Vec<Vec<Point2>> = part.piece.net_loops().map(<[Point2]>::to_vec).collect();
    let middle = Point2::default() + part.piece.size * 0.5;
    let path = |role, kind, points, closed| PatternPath { role, kind, points, closed };
    let wider = |p: &Point2| middle + (*p - middle) * 1.1;
    let cut: Vec<Point2> = loops[0].iter().map(wider).collect();
    let corner = cut[0];
    let drill = |at: Point2| {
        let round = [(2.0, 0.0), (0.0, -2.0), (-2.0, 0.0), (0.0, 2.0)];
        let points = round.map(|(x, y)| at + Vec2::new(x, y)).to_vec();
        path(Role::Drill, PathKind::Drill { diameter_mm: 4.0 }, points, true)
    };
    let others = part.piece.paths.split_off(loops.len());
    let mut paths = vec![path(Role::Cut, PathKind::Outline, cut, true)];
    let holes = loops[1..].iter().cloned();
    paths.extend(holes.map(|hole| path(Role::Inner, PathKind::Hole, hole, true)));
    paths.extend(loops.into_iter().map(|line| path(Role::Net, PathKind::Net, line, true)));
    paths.extend([drill(middle), drill(middle + Vec2::new(9.0, 0.0))]);
    paths.push(path(Role::Cut, PathKind::Notch, vec![corner, corner.lerp(middle, 0.02)], false));
    paths.extend(others);
    part.piece.paths = paths;
    part
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// The colours of the groups of an SVG, in order, each with its name.
fn groups(svg: &[u8]) -> Vec<(String, String)> {
    let document = roxmltree::Document::parse(text(svg)).unwrap();
    let groups = document.root_element().children().filter(|n| n.has_tag_name("g"));
    let painted = |node: &roxmltree::Node<'_, '_>| {
        let colour = ["stroke", "fill"].map(|name| node.attribute(name).unwrap());
        colour.into_iter().find(|colour| *colour != "none").unwrap().to_owned()
    };
    groups.map(|node| (node.attribute("id").unwrap().to_owned(), painted(&node))).collect()
}

/// The refold error of a part whose files were written of another.
fn proved(part: &Part, written: &Part, preset: &'static Preset) -> Result<f64, RefoldFileError> {
    let mut worst = 0.0f64;
    let svg = write_svg_for(&written.piece, preset);
    worst = worst.max(refold_files_error_mm(
        part,
        &PatternFiles { svg: Some(&svg), dxf: None, preset, arcs_mm: None },
    )?);
    for release in DxfRelease::ALL {
        let dxf = write_dxf_for(&written.piece, preset, release);
        let files = PatternFiles { svg: None, dxf: Some(&dxf), preset, arcs_mm: None };
        worst = worst.max(refold_files_error_mm(part, &files)?);
    }
    Ok(worst)
}

#[test]
fn files_of_every_preset_fold_up_again() {
    let files = [
        "examples/three-cones.sheet.json",
        "corpus/good/lid-with-hatch.csv",
        "corpus/good/mesh-cube.obj",
        "corpus/good/mesh-flap-on-a-slit.obj",
    ];
    for file in files {
        let made = made(file);
        for preset in Preset::all() {
            for part in &made.parts {
                let error_mm = proved(part, part, preset).unwrap();
                assert!(error_mm < 1e-6, "{file} for {}: {error_mm}", preset.name);
            }
            let options = OutputOptions { preset, ..OutputOptions::default() };
            let outputs = output_files(&made, &[Format::Svg, Format::Dxf], options).unwrap();
            for (part, panel) in made.parts.iter().zip(&outputs.panels) {
                assert_eq!(panel.findings, part.checked.findings, "{file} for {}", preset.name);
            }
        }
    }
}

#[test]
fn trimmed_pieces_are_proved_by_their_net_and_every_other_line_is_compared() {
    let part = trimmed();
    let after = |change: &dyn Fn(&mut Vec<PatternPath>)| {
        let mut other = part.clone();
        change(&mut other.piece.paths);
        other
    };
    let of_kind = |is: fn(PathKind) -> bool| part.piece.paths.iter().position(|p| is(p.kind));
    let notch = of_kind(|kind| kind == PathKind::Notch).unwrap();
    let drill = of_kind(|kind| matches!(kind, PathKind::Drill { .. })).unwrap();
    let net = of_kind(|kind| kind == PathKind::Net).unwrap();
    for preset in Preset::all() {
        let name = preset.name;
        let is_clean = proved(&part, &part, preset).unwrap() < 1e-6;
        assert!(is_clean, "{name}");
        let lost = after(&|paths| drop(paths.remove(notch)));
        assert_eq!(proved(&part, &lost, preset), Err(RefoldFileError::Lines), "{name}");
        let moved = after(&|paths| paths[0].points[3].x += 0.01);
        let error = proved(&part, &moved, preset);
        assert!(matches!(error, Err(RefoldFileError::Moved { .. })), "{name}: {error:?}");
        let moved = after(&|paths| paths[drill].points.iter_mut().for_each(|p| p.y += 0.01));
        let error = proved(&part, &moved, preset);
        assert!(matches!(error, Err(RefoldFileError::Moved { .. })), "{name}: {error:?}");
        let wide = after(&|paths| paths[drill].kind = PathKind::Drill { diameter_mm: 4.1 });
        let error = proved(&part, &wide, preset);
        assert!(matches!(error, Err(RefoldFileError::Moved { .. })), "{name}: {error:?}");
        if preset.shows(Role::Net) {
            let bent = after(&|paths| paths[net].points[3].x += 0.01);
            let error = proved(&part, &bent, preset);
            assert!(error.is_err() || error.unwrap() > 1e-4, "{name}");
        }
    }
}

#[test]
fn machines_find_their_colours_in_their_order() {
    let part = trimmed();
    let of = |name: &str| groups(&write_svg_for(&part.piece, Preset::from_name(name).unwrap()));
    let order = |name: &str| of(name).into_iter().map(|(layer, _)| layer).collect::<Vec<_>>();
    assert_eq!(order("generic"), ["cut", "score", "net", "engrave", "note"]);
    assert_eq!(order("lightburn"), ["engrave", "score", "net", "inner", "cut", "note"]);
    assert_eq!(order("wazer"), ["cut"]);
    // The palette of LightBurn: C00 to C08, C16, and the tool layers, which do not burn.
    let palette = [
        "#000000", "#0000ff", "#ff0000", "#00e000", "#d0d000", "#ff8000", "#00e0e0", "#ff00ff",
        "#b4b4b4", "#808080", "#f36926", "#0c96d9",
    ];
    for (layer, colour) in of("lightburn") {
        assert!(palette.contains(&colour.as_str()), "{layer}: {colour}");
        assert_eq!(layer == "note", colour == "#f36926", "notes alone do not burn");
    }
    // One step a colour.
    for name in ["lightburn", "glowforge", "cricut", "silhouette"] {
        let mut colours: Vec<String> = of(name).into_iter().map(|(_, colour)| colour).collect();
        colours.sort();
        colours.dedup();
        assert_eq!(colours.len(), of(name).len(), "{name}");
    }
    // Only Glowforge engraves filled areas, and notes stay away from machines that would cut them.
    for preset in Preset::all() {
        let svg = write_svg_for(&part.piece, preset);
        let is_filled = text(&svg).contains("fill=\"#");
        assert_eq!(is_filled, preset.name == "glowforge", "{}", preset.name);
        let reads_notes = ["generic", "lightburn", "plotter"].contains(&preset.name);
        assert_eq!(text(&svg).contains("id=\"reference\""), reads_notes, "{}", preset.name);
    }
    // Cricut cuts closed paths alone.
    let svg = write_svg_for(&part.piece, Preset::from_name("cricut").unwrap());
    let document = roxmltree::Document::parse(text(&svg)).unwrap();
    let cut = document.descendants().find(|n| n.attribute("id") == Some("cut")).unwrap();
    let paths: Vec<&str> = cut.descendants().filter_map(|n| n.attribute("d")).collect();
    assert!(paths.len() >= 3 && paths.iter().all(|d| d.ends_with('Z')), "{paths:?}");
}

#[test]
fn release_2000_says_its_unit_and_another_reader_sees_its_lines() {
    let part = trimmed();
    let bytes = write_dxf_for(&part.piece, Preset::generic(), DxfRelease::R2000);
    let drawing = dxf::Drawing::load(&mut std::io::Cursor::new(&bytes)).unwrap();
    assert_eq!(drawing.header.version, dxf::enums::AcadVersion::R2000);
    assert_eq!(drawing.header.default_drawing_units, dxf::enums::Units::Millimeters);
    let (mut closed, mut circles) = (Vec::new(), Vec::new());
    for entity in drawing.entities() {
        match &entity.specific {
            dxf::entities::EntityType::LwPolyline(line) if entity.common.layer == "cut" => {
                let points = line.vertices.iter().map(|v| Point2::new(v.x, v.y));
                closed.extend(line.is_closed().then(|| points.collect::<Vec<_>>()));
            }
            dxf::entities::EntityType::LwPolyline(_) => {}
            dxf::entities::EntityType::Circle(circle) => circles.push(circle.radius),
            other => panic!("{other:?}"),
        }
    }
    // Holes are cut before the outline.
    closed.rotate_right(1);
    assert_eq!(closed, part.piece.loops().map(<[Point2]>::to_vec).collect::<Vec<_>>());
    assert_eq!(circles, [2.0, 2.0]);
    // The finished piece, not what is cut.
    let read = read_dxf(&bytes).unwrap();
    assert_eq!(read.outline.len(), part.flat.points.len() - read.holes.concat().len());
    // Handles are told apart, and all are below the seed.
    let lines: Vec<&str> = text(&bytes).lines().collect();
    let mut section = "";
    let (mut handles, mut seed) = (Vec::new(), 0);
    for pair in lines.chunks_exact(2) {
        match (pair[0].trim(), section) {
            ("2", _) if ["HEADER", "TABLES", "OBJECTS"].contains(&pair[1]) => section = pair[1],
            ("5", "HEADER") => seed = u64::from_str_radix(pair[1], 16).unwrap(),
            ("5" | "105", _) => handles.push(u64::from_str_radix(pair[1], 16).unwrap()),
            _ => {}
        }
    }
    let count = handles.len();
    handles.sort_unstable();
    handles.dedup();
    assert_eq!((handles.len(), handles.iter().all(|&handle| handle < seed)), (count, true));
}

#[test]
fn dots_and_letters_become_areas_that_fill() {
    let mut part = trimmed();
    let label = PatternLabel {
        kind: LabelKind::Mark,
        role: Role::Engrave,
        at: Point2::new(10.0, 10.0),
        along: Vec2::X,
        height_mm: 6.0,
        text: "i.".to_owned(),
    };
    part.piece.labels = vec![label];
    let glowforge = Preset::from_name("glowforge").unwrap();
    let svg = write_svg_for(&part.piece, glowforge);
    let document = roxmltree::Document::parse(text(&svg)).unwrap();
    let label = document.descendants().find(|n| n.attribute("data-text").is_some()).unwrap();
    let areas = label.attribute("d").unwrap();
    assert!(
        areas.matches('Z').count() >= 3 && areas.matches('M').count() == areas.matches('Z').count()
    );
    assert!(proved(&part, &part, glowforge).is_ok());
}

#[test]
fn the_docs_list_every_layer_of_every_preset() {
    let docs = include_str!("../../../docs/outputs.md");
    let rows = Preset::all().iter().flat_map(|preset| {
        let about = format!("| `{}` | {} | {} |", preset.name, preset.about, preset.dxf.name());
        std::iter::once(about).chain(preset.table_rows())
    });
    let missing: Vec<String> = rows.filter(|row| !docs.contains(row.as_str())).collect();
    assert!(missing.is_empty(), "docs/outputs.md lacks these rows:\n{}", missing.join("\n"));
}

/// Files with arcs are the pattern within the tolerance: their lines are those that are fitted to
/// it, and its area and length agree with theirs.
#[test]
fn files_with_arcs_are_proved_and_read_back_within_the_tolerance() {
    let made = made("examples/three-cones.sheet.json");
    for part in &made.parts {
        for (release, arcs_mm) in [(DxfRelease::R12, 0.05), (DxfRelease::R2000, 0.1)] {
            let preset = Preset::generic();
            let plain = write_dxf_for(&part.piece, preset, release);
            let dxf = write_dxf_with(&part.piece, preset, release, Some(arcs_mm));
            assert!(text(&dxf).contains("\r\n 42\r\n"), "{}", part.name);
            assert!(dxf.len() < plain.len());
            let files = PatternFiles { svg: None, dxf: Some(&dxf), preset, arcs_mm: Some(arcs_mm) };
            assert!(refold_files_error_mm(part, &files).unwrap() < 1e-6);
            // They are no straight sides, and no arcs of another tolerance.
            let straight = PatternFiles { arcs_mm: None, ..files };
            assert!(refold_files_error_mm(part, &straight).is_err());
            let finer = PatternFiles { arcs_mm: Some(0.1 * arcs_mm), ..files };
            assert!(refold_files_error_mm(part, &finer).is_err());
            let [with, without] = [&dxf, &plain].map(|bytes| read_dxf(bytes).unwrap().outline);
            let length = |line: &[Point2]| -> f64 {
                (0..line.len()).map(|n| line[n].distance(line[(n + 1) % line.len()])).sum()
            };
            let off_mm = (length(&with) - length(&without)).abs();
            assert!(off_mm < 10.0 * arcs_mm, "{off_mm}");
            let area = |line: &[Point2]| 0.5 * signed_area_doubled(line);
            let off_mm2 = (area(&with) - area(&without)).abs();
            assert!(off_mm2 < arcs_mm * length(&without), "{off_mm2}");
        }
    }
}
