//! Meshes as panels of a design: beside panels that are bounded by curves, from a file or in the
//! design itself, and written again.

#![allow(clippy::unwrap_used)] // tests panic

use serde_json::Value;
use sheetwright::check::Verdict;
use sheetwright::design::{Design, PanelShape};
use sheetwright::make::{Made, Origin, make};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    DxfRelease, Format, InputFormat, MeshSettings, Outputs, PdfOptions, Preset, ReadOptions,
    hint_for, output_files, read_bytes, read_dxf, read_input, write_design, write_dxf_for,
};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A folder of its own, which goes with the value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("sheetwright-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A floor and a front that share a side, and a lid apart from both.
const TRAY: &str = "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nv 0 0 80\nv 100 0 80\nv 0 0 200\n\
                    v 50 0 200\nv 0 50 220\no floor\nf 1 2 3 4\no front\nf 1 5 6 2\no lid\nf 7 8 9\n";

/// A plank between two rails, and two groups of the tray.
const MIXED: &str = r#"{
  "sheetwright": 1, "name": "box", "material": "steel-1mm",
  "curves": {
    "keel": { "kind": "spline", "points": [[0,0,0], [500,40,10], [1000,50,20]] },
    "chine": { "kind": "spline", "points": [[0,0,300], [500,60,310], [1000,80,320]] }
  },
  "panels": [
    { "name": "floor", "mesh": "tray.obj", "group": "floor" },
    { "name": "plank", "rails": ["keel", "chine"], "samples": 60 },
    { "name": "apron", "mesh": "tray.obj", "group": "front", "aim": "seams", "darts": true }
  ]
}"#;

fn read(text: &str, folder: Option<&Path>) -> Result<Design, String> {
    let options = ReadOptions::default();
    read_bytes(InputFormat::Design, text.as_bytes(), "box.sheet.json", folder, &options)
        .map_err(|error| format!("{error} {}", error.hint))
}

fn made(design: &Design) -> Made {
    make(design, &mut Unwatched).unwrap()
}

fn text<'a>(outputs: &'a Outputs, name: &str) -> &'a str {
    let file = outputs.files.iter().find(|file| file.name == name).unwrap();
    std::str::from_utf8(&file.bytes).unwrap()
}

#[test]
fn a_design_holds_panels_of_both_kinds() {
    let folder = Folder::new("mixed");
    folder.write("tray.obj", TRAY);
    let design = read(MIXED, Some(&folder.0)).unwrap();
    let made = made(&design);
    let kinds: Vec<(&str, bool)> =
        made.parts.iter().map(|part| (&part.name[..], part.given().is_some())).collect();
    assert_eq!(kinds, [("floor", true), ("plank", false), ("apron", true)]);
    // Edges of meshes are called as the part that they meet, wherever it stands in the design.
    let edges =
        |n: usize| -> Vec<&str> { made.parts[n].edges.iter().map(|e| &e.name[..]).collect() };
    assert_eq!(edges(0), ["apron", "border"]);
    assert_eq!(edges(1), ["keel", "end", "chine", "start"]);
    assert_eq!((made.parts[0].edges[0].mates[0].part, made.parts[1].edges[0].mates.len()), (2, 0));

    let formats: Vec<Format> =
        Format::ALL.into_iter().filter(|format| *format != Format::Sheets).collect();
    let outputs = output_files(&made, &formats, &PdfOptions::default()).unwrap();
    let report: Value = serde_json::from_str(text(&outputs, "report.json")).unwrap();
    let methods: Vec<&Value> =
        report["panels"].as_array().unwrap().iter().map(|panel| &panel["method"]).collect();
    assert_eq!(methods, ["mesh", "optimal", "mesh"]);
    assert_eq!(report["panels"][2]["aim"], "seams");
    assert_eq!(report["panels"][0]["edges"][0]["mates"][0], "apron/floor");
    assert!(report["panels"][0]["warp_max_deg"].is_null());
    assert!(report["panels"][1]["stretch_max"].is_null());
    // Every part is in the surface and has a pattern; what needs rulings has those with rulings.
    let objects = |name: &str| text(&outputs, name).matches("\no ").count();
    assert_eq!((objects("surface.obj"), objects("quads.obj")), (3, 1));
    for name in ["floor.svg", "plank.svg", "apron.dxf"] {
        assert!(!text(&outputs, name).is_empty());
    }
    let page = text(&outputs, "report.html");
    for words in ["3 panels of ", "bend radius ", "Limits: strain ", "Warp, largest", "Seams"] {
        assert!(page.contains(words), "{words}");
    }
    // An edge that has the name of the part that it meets says it once.
    assert!(page.contains("mm, joined to apron</li>") && !page.contains("<li>apron,"));
}

#[test]
fn a_mesh_of_a_file_and_one_in_a_design_come_to_the_same() {
    let folder = Folder::new("embedded");
    folder.write("tray.obj", TRAY);
    let of_file = read_input(&folder.0.join("tray.obj"), &ReadOptions::default()).unwrap();
    assert_eq!(of_file.panels.len(), 3);
    // Written, it needs no file beside it.
    let written = String::from_utf8(write_design(&of_file)).unwrap();
    let back = read(&written, None).unwrap();
    assert_eq!(back, of_file);
    assert_eq!(made(&back), made(&of_file));
    let mixed = read(MIXED, Some(&folder.0)).unwrap();
    let again = read(&String::from_utf8(write_design(&mixed)).unwrap(), None).unwrap();
    assert_eq!(again, mixed);
    let PanelShape::Mesh(apron) = &again.panels[2].shape else { panic!() };
    assert!(apron.darts && apron.split_creases.is_none());
    let floor = |made: &Made| match &made.parts[0].origin {
        Origin::Given(given) => given.mesh.clone(),
        Origin::Found(_) => panic!(),
    };
    assert_eq!(floor(&made(&again)), floor(&made(&of_file)));
}

#[test]
fn parts_of_one_mesh_have_the_name_of_their_panel_and_a_number() {
    let cube = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good/mesh-cube.obj");
    let mut design = read_input(&cube, &ReadOptions::default()).unwrap();
    let PanelShape::Mesh(mesh) = &mut design.panels[0].shape else { panic!() };
    mesh.split_creases = Some(sheetwright::math::from_deg(30.0));
    design.panels[0].name = "side".to_owned();
    // Another panel has a name that a part would get.
    let mut other = design.panels[0].clone();
    other.name = "Side-2".to_owned();
    let PanelShape::Mesh(mesh) = &mut other.shape else { panic!() };
    mesh.split_creases = None;
    design.panels.insert(0, other);
    let made = made(&design);
    let names: Vec<&str> = made.parts.iter().map(|part| &part.name[..]).collect();
    assert_eq!(names, ["Side-2", "side-1", "side-3", "side-4", "side-5", "side-6", "side-7"]);
    assert!(made.parts[1..].iter().all(|part| part.panel == "side"));
    // Joints are counted through the design, and lead to parts by their numbers in it.
    let joints = &made.parts[1].given().unwrap().joints;
    assert_eq!(joints.len(), 4);
    assert!(joints.iter().all(|joint| (2..7).contains(&joint.with)));
}

#[test]
fn what_a_mesh_can_not_be_is_refused_with_its_place_and_a_way_out() {
    let folder = Folder::new("refused");
    folder.write("tray.obj", TRAY);
    folder.write("rim.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n");
    let panel = |fields: &str| {
        format!(r#"{{ "sheetwright": 1, "panels": [{{ "name": "a", {fields} }}] }}"#)
    };
    for (fields, wanted) in [
        (r#""mesh": "tray.obj""#, ["panels[0].group", "has 3 groups, and none is named", "floor"]),
        (r#""mesh": "tray.obj", "group": "flor""#, ["panels[0].group", "no group", "floor"]),
        (r#""mesh": "tray.obj", "rails": ["a", "b"]"#, ["panels[0]", "has `rails`", "Keep one"]),
        (r#""mesh": "rim.csv""#, ["panels[0].mesh", "is no mesh", ".stl"]),
        (r#""mesh": "gone.stl""#, ["panels[0].mesh", "there is no mesh", "Check the path"]),
        (r#""mesh": "../tray.obj""#, ["panels[0].mesh", "is not inside", "beside the design"]),
        (r#""rails": ["a", "b"], "aim": "max""#, ["panels[0].aim", "no mesh", "mesh"]),
        (
            r#""mesh": { "points": [[0,0,0], [1,0,0], [0,1,0]], "triangles": [[0,1,3]] }"#,
            ["mesh.triangles[0]", "there is no point 3", "counted from 0"],
        ),
        (
            r#""mesh": { "points": [[0,0,0]], "triangles": [] }"#,
            ["panels[0].mesh", "no triangle", ""],
        ),
        (
            r#""mesh": { "points": [], "triangles": [] }, "group": "b""#,
            ["panels[0].group", "there is no file", "Leave `group` out"],
        ),
        (
            r#""mesh": "tray.obj", "group": "lid", "split_creases_deg": 200"#,
            ["panels[0].split_creases_deg", "200°", "180"],
        ),
    ] {
        let error = read(&panel(fields), Some(&folder.0)).unwrap_err();
        for words in wanted {
            assert!(error.contains(words), "{fields}: {error}");
        }
    }
    let from_input = read(&panel(r#""mesh": "tray.obj""#), None).unwrap_err();
    assert!(from_input.contains("standard input"), "{from_input}");
}

#[test]
fn meshes_are_not_joined_nor_moved() {
    let folder = Folder::new("joined");
    folder.write("tray.obj", TRAY);
    let with = |more: &str| {
        let text = MIXED.replace("\n  ]\n}", &format!("{more}\n}}"));
        read(&text, Some(&folder.0))
    };
    let joined = with(r#", { "name": "both", "join": ["floor", "plank"] }]"#);
    let refused = match joined {
        Err(error) => error,
        Ok(design) => {
            let error = make(&design, &mut Unwatched).unwrap_err();
            format!("{error} {}", hint_for(&error))
        }
    };
    assert!(refused.contains("is a mesh"), "{refused}");
    let design = with(r#"], "vary": { "panels": ["floor"], "limit": 5 }"#).unwrap();
    let error = make(&design, &mut Unwatched).unwrap_err();
    assert_eq!(error.to_string(), "a mesh has no curves that could move");
    assert!(hint_for(&error).contains("curves"));
    // Where curves move, meshes stay.
    let design = with(r#"], "vary": { "limit": 5 }"#).unwrap();
    let made = made(&design);
    assert!(made.parts[1].change().is_some() && made.parts[0].change().is_none());
}

#[test]
fn a_mesh_with_a_handle_is_cut_open_where_its_facets_are_not_folded() {
    let torus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good/mesh-torus.obj");
    let mesh = MeshSettings { facets: Some(false), ..MeshSettings::default() };
    let options = ReadOptions { mesh, ..ReadOptions::default() };
    let made = make(&read_input(&torus, &options).unwrap(), &mut Unwatched).unwrap();
    let [part] = &made.parts[..] else { panic!("{}", made.parts.len()) };
    // Its loops cut it into a disk; each ends where it begins.
    assert_eq!((part.sheet.loops().len(), part.sheet.mesh().euler()), (1, 1));
    assert!(part.sheet.seams().len() >= 2);
    assert_eq!(part.checked.verdict, Verdict::WillNotBend);
}

/// A roof with a lower roof beside it: two mountains and a valley between them.
const ROOFS: &str = "v 0 0 0\nv 50 0 40\nv 100 0 10\nv 150 0 40\nv 200 0 0\nv 0 90 0\nv 50 90 40\n\
                     v 100 90 10\nv 150 90 40\nv 200 90 0\nf 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\n\
                     f 4 5 10 9\n";

#[test]
fn dxf_tells_mountains_from_valleys_by_their_line_types() {
    let mesh = MeshSettings { facets: Some(true), ..MeshSettings::default() };
    let options = ReadOptions { mesh, ..ReadOptions::default() };
    let format = InputFormat::of(Path::new("roofs.obj")).unwrap();
    let design = read_bytes(format, ROOFS.as_bytes(), "roofs.obj", None, &options).unwrap();
    let piece = &made(&design).parts[0].piece;
    for release in DxfRelease::ALL {
        let bytes = write_dxf_for(piece, Preset::generic(), release);
        let drawing = dxf::Drawing::load(&mut std::io::Cursor::new(&bytes)).unwrap();
        let declared: Vec<&str> = drawing.line_types().map(|of| of.name.as_str()).collect();
        for name in ["MOUNTAIN", "VALLEY"] {
            assert!(declared.contains(&name), "{declared:?}");
        }
        let of_layer = |layer: &str| {
            let on_layer = drawing.entities().filter(|of| of.common.layer == layer);
            let mut types: Vec<&str> =
                on_layer.map(|of| of.common.line_type_name.as_str()).collect();
            types.sort_unstable();
            types
        };
        // The outside is above the roofs, and the pattern is seen from there.
        assert_eq!(of_layer("score"), ["MOUNTAIN", "MOUNTAIN", "VALLEY"]);
        assert_eq!(of_layer("cut"), ["BYLAYER"]);
        // Angles stand beside the folds, and what is read back is the pattern.
        assert!(of_layer("engrave").len() + of_layer("note").len() > 4);
        assert_eq!(read_dxf(&bytes).unwrap().outline, piece.outline());
    }
    // A pattern without folds declares neither.
    let flat = made(&read(LID, None).unwrap());
    let bytes = write_dxf_for(&flat.parts[0].piece, Preset::generic(), DxfRelease::R12);
    assert!(!String::from_utf8(bytes).unwrap().contains("MOUNTAIN"));
}

/// A flat panel.
const LID: &str = r#"{
  "sheetwright": 1, "name": "lid",
  "curves": {
    "rim": { "kind": "polyline", "closed": true,
             "points": [[0,0,0], [100,0,0], [100,80,0], [0,80,0]] }
  },
  "panels": [{ "name": "lid", "boundary": ["rim"], "samples": 20 }]
}"#;

#[test]
fn panels_share_the_seams_of_their_file_and_add_their_own() {
    let folder = Folder::new("mesh-seams-shared");
    folder.write("tray.obj", &format!("{TRAY}l 1 2\n"));
    let panel = |name: &str, more: &str| {
        format!(r#"{{ "name": "{name}", "mesh": "tray.obj", "group": "floor"{more} }}"#)
    };
    let own = r#", "seams": [[[0, 0, 0], [100, 0, 0], [100, 100, 0]]]"#;
    let panels = [panel("a", ""), panel("b", own), panel("c", "")].join(", ");
    let text = format!(r#"{{ "sheetwright": 1, "panels": [{panels}] }}"#);
    let design = read(&text, Some(&folder.0)).unwrap();
    let seams = |n: usize| match &design.panels[n].shape {
        PanelShape::Mesh(mesh) => mesh.seams.clone(),
        _ => panic!("a panel is no mesh"),
    };
    let [a, b, c] = [0, 1, 2].map(seams);
    assert!(Arc::ptr_eq(&a, &c));
    assert_eq!((a.len(), b.len()), (1, 2));
    assert_eq!((&b[0], b[1].len()), (&a[0], 3));
}
