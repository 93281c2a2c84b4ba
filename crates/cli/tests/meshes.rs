//! Meshes on the command line: what comes out, and what is said.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A box of 100 mm, one panel; a plate of two groups beside it, of which one is in two parts.
const BOX: &str = "o box\nv 0 0 0\nv 100 0 0\nv 0 100 0\nv 100 100 0\nv 0 0 100\nv 100 0 100\n\
    v 0 100 100\nv 100 100 100\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
const GROUPS: &str = "v 0 0 0\nv 90 0 0\nv 90 40 0\nv 0 40 0\ng one\nf 1 2 3 4\n\
    v 0 50 0\nv 30 50 0\nv 30 70 0\nv 50 50 0\nv 90 50 0\nv 90 70 0\ng two\nf 5 6 7\nf 8 9 10\n";

fn run(folder: &Path, call: &str, input: Option<&str>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sheetwright"));
    command.current_dir(folder).args(call.split_whitespace());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.unwrap_or_default().as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

/// What a call says on both streams; it ends with this status.
fn says(folder: &Path, call: &str, status: i32) -> (String, String) {
    let output = run(folder, call, None);
    let said = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(status), "{call}: {said:?}");
    let [out, err] = said;
    (out, err)
}

fn desk() -> (tempfile::TempDir, PathBuf) {
    let desk = tempfile::tempdir().unwrap();
    fs::write(desk.path().join("box.obj"), BOX).unwrap();
    fs::write(desk.path().join("groups.obj"), GROUPS).unwrap();
    let path = desk.path().to_owned();
    (desk, path)
}

fn report(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("report.json")).unwrap()).unwrap()
}

#[test]
fn a_closed_box_is_cut_open_and_comes_out_with_every_file() {
    let (_kept, desk) = desk();
    let (said, noted) = says(&desk, "make box.obj --out out", 0);
    assert!(said.starts_with("box: bends, with sharp folds\n"), "{said}");
    assert!(said.contains("cut open along"), "{said}");
    assert!(noted.contains("7 files written"), "{noted}");
    let files = ["surface.obj", "box.svg", "box.dxf", "pattern.pdf", "report.json", "report.html"];
    assert!(files.iter().all(|name| desk.join("out").join(name).exists()));
    let panel = &report(&desk.join("out"))["panels"][0];
    assert_eq!((panel["method"].as_str(), panel["aim"].as_str()), (Some("mesh"), Some("mean")));
    assert!(panel["rungs"].is_null() && panel["self_intersects"].is_null());
    assert!((panel["area_flat_mm2"].as_f64().unwrap() - 60000.0).abs() < 1e-6);
    for seam in panel["seams"].as_array().unwrap() {
        for side in seam["sides_mm"].as_array().unwrap() {
            assert!((side.as_f64().unwrap() - seam["length_mm"].as_f64().unwrap()).abs() < 1e-7);
        }
    }
    let page = fs::read_to_string(desk.join("out/report.html")).unwrap();
    assert!(page.contains("Laid flat.") && page.contains("Seams") && !page.contains("NaN"));
}

#[test]
fn groups_and_their_parts_are_panels_and_creases_divide() {
    let (_kept, desk) = desk();
    let (said, _) = says(&desk, "check groups.obj", 0);
    let names: Vec<&str> =
        said.lines().filter_map(|line| line.split_once(": ")).map(|l| l.0).collect();
    assert_eq!(names, ["one", "two-1", "two-2"]);
    says(&desk, "make box.obj --out faces --split-creases 30 --formats report,svg", 0);
    let report = report(&desk.join("faces"));
    let panels = report["panels"].as_array().unwrap();
    assert_eq!(panels.len(), 6);
    for panel in panels {
        assert_eq!(panel["verdict"], "bends");
        assert!((panel["area_flat_mm2"].as_f64().unwrap() - 10000.0).abs() < 1e-6);
        assert!(panel["rebuilt_distance_max_mm"].as_f64().unwrap() < 1e-9);
    }
    // Six squares are one pattern.
    assert_eq!((&panels[0]["count"], &panels[5]["pattern"]), (&6.into(), &"box-1".into()));
    assert!(desk.join("faces/box-1.svg").exists() && !desk.join("faces/box-6.svg").exists());
    says(&desk, "make box.obj --out each --split-creases 30 --formats svg --each-part", 0);
    assert!(desk.join("each/box-6.svg").exists());
}

#[test]
fn units_aims_and_materials_are_taken_from_the_call() {
    let (_kept, desk) = desk();
    for aim in ["mean", "max", "seams"] {
        let call = format!(
            "make box.obj --out in --units in --aim {aim} --material paper --formats report"
        );
        let (_, noted) = says(&desk, &call, 0);
        assert!(!noted.contains("has no effect"), "{noted}");
        let report = report(&desk.join("in"));
        assert_eq!(report["material"], "paper");
        let panel = &report["panels"][0];
        assert_eq!(panel["aim"], aim);
        assert_eq!(panel["stretch_limit"], 0.01);
        let area = panel["area_space_mm2"].as_f64().unwrap();
        assert!((area / (60000.0 * 25.4 * 25.4) - 1.0).abs() < 1e-12);
    }
    let (said, _) = says(&desk, "check box.obj --material plywood-4mm", 1);
    assert!(
        said.contains("does not fold; divide the mesh there. --split-creases 30 divides"),
        "{said}"
    );
}

/// A pyramid, which only a cut to its tip or its edges lays flat.
#[test]
fn options_that_help_are_named_by_the_command_and_not_on_the_page() {
    let (_kept, desk) = desk();
    let pyramid = "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nv 0 0 80\n\
        f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    fs::write(desk.join("tip.obj"), pyramid).unwrap();
    let (said, _) = says(&desk, "make tip.obj --out out --formats report --facets=off", 1);
    let options = "(at (-25.0, -25.0, 40.0) mm) --darts cuts it there. --split-creases 30 divides";
    assert!(said.contains(options), "{said}");
    for name in ["report.html", "report.json"] {
        let page = fs::read_to_string(desk.join("out").join(name)).unwrap();
        assert!(page.contains("Cut it from the border"), "{name}");
        assert!(!page.contains("--darts") && !page.contains("--split-creases"), "{name}");
    }
    let (said, _) = says(&desk, "check tip.obj --darts", 0);
    assert!(!said.contains("--"), "{said}");
}

#[test]
fn facets_are_folded_into_pieces_that_fit_the_paper() {
    let (_kept, desk) = desk();
    // The pyramid's facets are meant.
    let pyramid = "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nv 0 0 80\n\
        f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    fs::write(desk.join("tip.obj"), pyramid).unwrap();
    let (said, _) = says(&desk, "check tip.obj", 0);
    assert!(said.contains("its facets are meant") && said.contains("--facets=off lays"), "{said}");
    let (said, _) = says(&desk, "check tip.obj --facets", 0);
    assert!(said.contains("3 mountain folds of up to") && !said.contains("--"), "{said}");
    let all = "make box.obj --out net --facets=on --pieces-within a4";
    says(&desk, all, 0);
    let report = report(&desk.join("net"));
    let panels = report["panels"].as_array().unwrap();
    assert!(panels.len() > 1);
    for panel in panels {
        assert!(panel["length_error_max"].as_f64().unwrap() < 1e-9);
        assert_eq!(panel["overlaps"], false);
    }
    let svg = fs::read_to_string(desk.join("net/box-1.svg")).unwrap();
    assert!(svg.contains("class=\"fold mountain\" stroke-dasharray"), "{svg}");
    // What does nothing is said.
    let (said, _) = says(&desk, "check box.obj --facets --darts --aim max", 0);
    assert!(said.contains("so the aim of flattening and cuts where it would stretch"), "{said}");
    assert!(said.contains("--facets=off lays"), "{said}");
    let (said, _) = says(&desk, "check box.obj --facets=off --pieces-within a4", 0);
    assert!(said.contains("so the largest size of pieces has no effect. --facets folds"), "{said}");
    let (said, _) = says(&desk, "check box.obj --facets --pieces-within 80x80", 0);
    assert!(said.contains("This facet by itself is") && said.contains("80 × 80 mm"), "{said}");
    // Tabs name what is printed: marks.
    let narrow = "make box.obj --out tabs --facets --for paper --pieces-within a4";
    let (said, _) = says(&desk, narrow, 0);
    assert!(!said.contains("cut-"), "{said}");
    let page = fs::read_to_string(desk.join("tabs/report.html")).unwrap();
    assert!(!page.contains("/cut-"));
    let (said, _) = says(&desk, "check box.obj --pieces-within 3", 2);
    assert!(said.is_empty());
}

#[test]
fn standard_input_and_conversions_work() {
    let (_kept, desk) = desk();
    let output = run(&desk, "check - --from obj", Some(BOX));
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.starts_with(b"box: "));
    says(&desk, "convert box.obj box.svg", 0);
    says(&desk, "convert groups.obj all.pdf", 0);
    let (_, said) = says(&desk, "convert groups.obj one.dxf", 2);
    assert!(said.contains("there are several"), "{said}");
    let (_, said) = says(&desk, "convert box.obj box.step", 2);
    assert!(said.contains("step can't be made of a mesh"), "{said}");
    let (_, said) = says(&desk, "convert box.obj box.csv", 2);
    assert!(said.contains("a mesh has no boundary curves"), "{said}");
    // As a design it keeps its triangles, and comes to the same.
    says(&desk, "convert groups.obj kept.sheet.json", 0);
    says(&desk, "make groups.obj --out of-mesh --split-creases 30", 0);
    says(&desk, "make kept.sheet.json --out of-design --split-creases 30", 0);
    for entry in fs::read_dir(desk.join("of-mesh")).unwrap() {
        let name = entry.unwrap().file_name();
        if name.to_str().is_some_and(|n| n.ends_with(".svg") || n.ends_with(".dxf")) {
            let [a, b] =
                ["of-mesh", "of-design"].map(|out| fs::read(desk.join(out).join(&name)).unwrap());
            assert!(a == b, "{name:?}");
        }
    }
    // What was written as a surface is a mesh again, and still flat in the same way.
    says(&desk, "make box.obj --out out --formats obj", 0);
    let (said, _) = says(&desk, "check out/surface.obj", 0);
    assert!(said.starts_with("box: bends, with sharp folds"), "{said}");
}

#[test]
fn the_same_mesh_gives_the_same_bytes() {
    let (_kept, desk) = desk();
    says(&desk, "make box.obj --out a", 0);
    says(&desk, "make box.obj --out b", 0);
    for entry in fs::read_dir(desk.join("a")).unwrap() {
        let name = entry.unwrap().file_name();
        if name != "timing.json" {
            let [a, b] = ["a", "b"].map(|out| fs::read(desk.join(out).join(&name)).unwrap());
            assert!(a == b, "{name:?}");
        }
    }
}

/// The number of a field of the first panel of a report.
fn number(folder: &Path, field: &str) -> f64 {
    report(folder)["panels"][0][field].as_f64().unwrap()
}

#[test]
fn a_size_and_a_scale_change_all_lengths() {
    let (_kept, desk) = desk();
    let area = |call: &str| {
        let (_, noted) = says(&desk, &format!("make {call} --out out"), 0);
        (number(&desk.join("out"), "area_flat_mm2"), noted)
    };
    let (found, noted) = area("box.obj --size 300mm");
    assert!((found - 540_000.0).abs() < 1e-6, "{found}");
    assert!(noted.contains("note: all lengths are 3 times those of the file"), "{noted}");
    let (found, noted) = area("box.obj --units cm --scale 0.5");
    assert!((found - 1_500_000.0).abs() < 1e-5 && !noted.contains("times those"), "{found}");
    // The largest extent is that of all groups together: 90 mm along x.
    let (found, _) = area("groups.obj --size 9");
    assert!((found - 36.0).abs() < 1e-9, "{found}");
    // Other inputs have a size, too.
    fs::write(desk.join("leaf.csv"), "x,y,z\n0,0,0\n20,0,0\n20,10,0\n0,10,0\n").unwrap();
    let (found, _) = area("leaf.csv --size 1m");
    assert!((found - 500_000.0).abs() < 1e-6, "{found}");
    for (options, words) in [
        ("--size 0", "give a length above 0"),
        ("--size big", "give a length above 0"),
        ("--scale 0", "give a factor"),
        ("--scale 2 --size 10", "cannot be used with"),
        ("--scale 2 --vary-limit 1", "cannot be used with"),
    ] {
        let (_, said) = says(&desk, &format!("check leaf.csv {options}"), 2);
        assert!(said.contains(words), "{options}: {said}");
    }
}

#[test]
fn a_mesh_that_would_be_too_small_is_read_in_metres() {
    let (_kept, desk) = desk();
    let tent = "v 0 0 0\nv 1.8 0 0\nv 1.8 1.2 0\nv 0 1.2 0\nf 1 2 3 4\n";
    fs::write(desk.join("tent.obj"), tent).unwrap();
    for (options, area, note) in [
        ("", 2.16e6, "the file names no unit, and 1.8 mm would be small for a sheet"),
        ("--scale 2", 8.64e6, "it is read in metres; --units mm reads it in millimetres"),
        ("--units mm", 2.16, ""),
        ("--size 18mm", 216.0, "all lengths are 10 times"),
    ] {
        let (_, noted) = says(&desk, &format!("make tent.obj {options} --out out"), 0);
        let found = number(&desk.join("out"), "area_flat_mm2");
        assert!((found / area - 1.0).abs() < 1e-12, "{options}: {found}");
        assert!(noted.contains(note), "{options}: {noted}");
        assert_eq!(noted.contains("in metres"), area > 1e6, "{options}: {noted}");
    }
}

#[test]
fn a_unit_in_a_comment_is_believed() {
    let (_kept, desk) = desk();
    let lid = "# File units = inches\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n";
    fs::write(desk.join("lid.obj"), lid).unwrap();
    for (options, area, note) in [
        ("", 2.0 * 25.4 * 25.4, "note: this file is read in inches, as a comment in it says"),
        ("--units mm", 2.0, ""),
    ] {
        let (_, noted) = says(&desk, &format!("make lid.obj {options} --out out"), 0);
        let found = number(&desk.join("out"), "area_flat_mm2");
        assert!((found / area - 1.0).abs() < 1e-12, "{options}: {found}");
        assert!(noted.contains(note) && !noted.contains("in metres"), "{options}: {noted}");
    }
}

#[test]
fn one_skin_of_a_plate_is_laid_flat_alone() {
    let (_kept, desk) = desk();
    let plate = BOX.replace("100\n", "3\n");
    fs::write(desk.join("plate.obj"), plate).unwrap();
    let (said, _) = says(&desk, "check plate.obj", 0);
    assert!(said.contains("The mesh is a plate with two skins, 3.00 mm apart"), "{said}");
    assert!(said.contains("--skin outer lays the outer one flat."), "{said}");
    for skin in ["outer", "inner"] {
        let (said, _) = says(&desk, &format!("make plate.obj --skin {skin} --out out"), 0);
        assert!(said.starts_with("box: bends\n"), "{said}");
        assert!(said.contains(&format!("The {skin} skin alone is laid flat.")), "{said}");
        assert!((number(&desk.join("out"), "area_flat_mm2") - 10_000.0).abs() < 1e-6);
    }
    // The design keeps both skins, and which of them is laid flat.
    says(&desk, "convert plate.obj plate.sheet.json --skin inner", 0);
    let text = fs::read_to_string(desk.join("plate.sheet.json")).unwrap();
    assert!(text.contains("\"skin\": \"inner\""), "{text}");
    let (said, _) = says(&desk, "check plate.sheet.json", 0);
    assert!(said.contains("The inner skin alone is laid flat."), "{said}");
    let (said, _) = says(&desk, "check box.obj --skin outer", 0);
    assert!(said.contains("warning: One skin of a plate was to be laid flat alone"), "{said}");
}

#[test]
fn what_is_healed_is_said_and_the_design_keeps_the_mesh_as_it_came() {
    let (_kept, desk) = desk();
    let quads = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 10 0 0\nv 10 0 10\nv 10 10 10\nv 10 10 0\n\
                 f 1 2 3 4\nf 5 6 7 8\n";
    fs::write(desk.join("quads.obj"), quads).unwrap();
    let (said, _) = says(&desk, "check quads.obj", 0);
    let note = "note: 2 points of the file lie where others do, at sides that they share. They count \
                as one, so that the mesh hangs together there. (the first at (10.0, ";
    assert!(said.contains(note), "{said}");
    says(&desk, "convert quads.obj quads.sheet.json", 0);
    assert_eq!(says(&desk, "check quads.sheet.json", 0).0, said);
}
