//! Files from outside: dropped on the window, and by typed paths where the system has no dialog.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::{DroppedFile, Event, HoveredFile, Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use hands::{Hands, picture, round};
use sheetwright::check::Place;
use sheetwright::design::PanelShape;
use sheetwright::math::{Point2, from_deg};
use sheetwright_editor::command::Command;
use sheetwright_editor::document::{Document, Edit, Selection};
use sheetwright_editor::editor::{FileWish, Opened, Page};
use sheetwright_editor::io::{Dialogs, FileAnswer, SystemDialogs, Typed};
use sheetwright_editor::scene::Act;
use sheetwright_files::OutputFile;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

const SIZE: [f32; 2] = [1280.0, 800.0];

/// A file that lies nowhere.
#[derive(Debug)]
struct File(PathBuf, Result<Vec<u8>, String>);

impl DroppedFile for File {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        self.1.clone()
    }
}

fn design(name: &str) -> Vec<u8> {
    let mut document = Document::default();
    document.design.name = name.to_owned();
    document.bytes()
}

fn dropped(hands: &mut Hands, files: Vec<(&str, Result<Vec<u8>, String>)>) {
    for (path, bytes) in files {
        let file = Arc::new(File(PathBuf::from(path), bytes));
        hands.harness.input_mut().dropped_files.push(file);
    }
    hands.step();
    hands.step();
}

fn notice(hands: &Hands) -> String {
    hands.app().editor().notice.as_ref().map_or(String::new(), |notice| notice.text.clone())
}

/// Two faces of a box, which share a side.
const MESH: &[u8] = b"v 0 0 0\nv 90 0 0\nv 0 90 0\nv 0 0 70\nf 1 2 3\nf 1 4 2\n";
const TABLE: &[u8] = b"x,y,z\n0,0,0\n9,0,0\n9,9,3";

#[test]
fn a_design_or_a_table_that_is_dropped_opens() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    dropped(&mut hands, vec![("/home/hood.sheet.json", Ok(design("hood")))]);
    let editor = hands.app().editor();
    assert_eq!(editor.document().design.name, "hood");
    assert_eq!((editor.file(), editor.page), (Some("/home/hood.sheet.json"), Page::Panes));
    dropped(&mut hands, vec![("/home/rim.csv", Ok(TABLE.to_vec()))]);
    let editor = hands.app().editor();
    assert_eq!((editor.document().design.curves.len(), editor.file()), (1, None));
    // Later it stands among recent files.
    hands.run(Command::Start);
    assert!(hands.sees("hood.sheet.json") && hands.sees("rim.csv"));
}

#[test]
fn of_several_the_first_that_can_be_opened_is_and_the_others_are_named() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    let files = vec![
        ("/a/hull.dwg", Ok(Vec::new())),
        ("/a/gone.json", Err("No such file".to_owned())),
        ("/a/hood.sheet.json", Ok(design("hood"))),
        ("/a/brim.sheet.json", Ok(design("brim"))),
    ];
    dropped(&mut hands, files);
    assert_eq!(hands.app().editor().document().design.name, "hood");
    let said = "hull.dwg, gone.json and brim.sheet.json were not opened: one file opens at a time.";
    assert_eq!(notice(&hands), said);
}

#[test]
fn what_can_not_be_opened_is_refused_as_open_refuses_it() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    let files = [("/a/hull.step", Ok(Vec::new())), ("/a/hull.dwg", Ok(Vec::new()))];
    for (path, bytes) in files {
        let opened = Opened { path: path.to_owned(), bytes: bytes.clone().unwrap() };
        hands.harness.state_mut().editor_mut().open(opened);
        let said = notice(&hands);
        assert!(said.starts_with(path) && said.ends_with(['.', 'd']), "{said}");
        assert!(
            said.contains("The editor opens designs (.json), tables of curves (.csv), tables of")
        );
        dropped(&mut hands, vec![(path, bytes)]);
        assert_eq!(notice(&hands), said);
        assert_eq!(hands.app().editor().page, Page::Start);
    }
    // A file whose name does not tell what it is may still be of use, and what it holds may tell.
    let texts = [
        ("/a/milk.doc", "milk", "Pictures to trace (.png, .jpg)"),
        ("/a/rows.doc", "curve,x,y,z\na,0,0,0\n", "give it the ending .csv."),
        ("/a/rows", "curve,x,y,z\na,0,0,0\n", "give it the ending .csv."),
        ("/a/hull.doc", "solid hull", "give it the ending of its format."),
        ("/a/hood.doc", "{\"format\": \"sheetwright-design\"}", "give it the ending .json."),
    ];
    for (path, holds, way_out) in texts {
        dropped(&mut hands, vec![(path, Ok(holds.as_bytes().to_vec()))]);
        let said = notice(&hands);
        assert!(said.contains("The editor opens designs") && said.contains(way_out), "{said}");
    }
    let gone = vec![("/a/gone.csv", Err("No such file".to_owned())), ("/a/b.stl", Ok(Vec::new()))];
    dropped(&mut hands, gone);
    let said = notice(&hands);
    assert!(said.starts_with("/a/gone.csv can't be read: No such file. b.stl was not"), "{said}");
}

#[test]
fn a_mesh_is_a_panel_that_is_shown_set_and_saved_as_a_design() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    dropped(&mut hands, vec![("/a/box.obj", Ok(MESH.to_vec()))]);
    hands.settle();
    let editor = hands.app().editor();
    // It is no design yet: saving asks where to, and does not write over the mesh.
    assert_eq!((editor.file(), editor.document().design.name.as_str()), (None, "box"));
    let [part] = editor.shown() else { panic!("{:?}", editor.shown().len()) };
    let shown = part.made.as_ref().unwrap();
    assert!(shown.is_mesh && shown.triangles.len() == 2 && shown.rungs.is_empty());
    assert_eq!((shown.loops.len(), shown.sides.len()), (1, 5));
    // Divided along its crease it is two parts, both of the one panel.
    let mut to = editor.document().design.panels[0].clone();
    let PanelShape::Mesh(mesh) = &mut to.shape else { panic!() };
    mesh.split_creases = Some(from_deg(30.0));
    hands
        .harness
        .state_mut()
        .editor_mut()
        .carry_out(Act::Edit(Edit::SetPanel { panel: 0, to: Box::new(to) }));
    hands.settle();
    let editor = hands.app().editor();
    let names: Vec<[&str; 2]> = editor.shown().iter().map(|p| [&p.name[..], &p.panel]).collect();
    assert_eq!(names, [["box-1", "box"], ["box-2", "box"]]);
    // The part that is selected has the fields of its panel.
    hands
        .harness
        .state_mut()
        .editor_mut()
        .carry_out(Act::Select(Selection::of_place(1, Place::Whole)));
    hands.settle();
    assert!(hands.sees("Divide along creases"));
    let editor = hands.app().editor();
    let back = Document::read("box.sheet.json", &editor.bytes()).unwrap();
    assert_eq!(&back, editor.document());
    // It can be brought into sight, saved and exported; it has no curves that could move.
    assert!(hands.sees("Click a panel on the pattern"));
    hands.run(Command::Fit);
    let pane = hands.app().plan();
    assert!(
        pane.on_screen(Point2::new(0.0, 0.0)).distance(pane.on_screen(Point2::new(90.0, 0.0)))
            > 200.0
    );
    assert!(hands.app().editor().why_not(Command::Vary).is_some());
    hands.run(Command::SaveAs);
    hands.settle();
    let saved = hands.disk.lock().unwrap().saved.clone();
    assert_eq!(Document::read("box.sheet.json", &saved).as_ref(), Ok(&back));
    hands.run(Command::Export);
    assert_eq!(hands.app().editor().page, Page::Export);
}

/// As the command does: numbers that are too small for millimetres are metres, which is said.
#[test]
fn a_small_mesh_without_a_unit_is_read_in_metres_and_said_so() {
    let extent = |text: &str| {
        let mut hands = Hands::new(SIZE, false);
        hands.step();
        dropped(&mut hands, vec![("/a/box.obj", Ok(text.as_bytes().to_vec()))]);
        hands.settle();
        (hands.app().editor().document().design.extent_mm(), notice(&hands))
    };
    let faces = "v 0 0 0\nv 0.9 0 0\nv 0 0.9 0\nv 0 0 0.7\nf 1 2 3\nf 1 4 2\n";
    let (in_metres, said) = extent(faces);
    assert_eq!(in_metres, 900.0);
    assert!(said.contains("it is read in metres"), "{said}");
    let (in_inches, said) = extent(&format!("# File units = inches\n{faces}"));
    assert!((in_inches - 22.86).abs() < 1e-9 && !said.contains("metres"), "{in_inches} {said}");
}

/// A table of offsets that names no unit is opened once the unit is chosen.
#[test]
fn the_unit_of_a_table_is_asked_for_where_it_names_none() {
    const HULL: &[u8] = b"Station,0,1,2\nPosition,0,40,80\nHeights\nSheer,20,18,19\n\
        Chine,5,4,6\nHalf-breadths\nSheer,22,25,20\nChine,15,18,13\n";
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    dropped(&mut hands, vec![("/a/hull.csv", Ok(HULL.to_vec()))]);
    hands.settle();
    assert_eq!(hands.app().editor().page, Page::Unit);
    assert!(hands.sees("hull.csv does not say in which unit its numbers are."));
    hands.harness.get_by_label("in: 2.032 m long").click();
    hands.settle();
    let editor = hands.app().editor();
    assert_eq!(editor.page, Page::Panes);
    let sheer = &editor.document().design.curves[0].points[1].at;
    assert_eq!([sheer.x, sheer.y, sheer.z], [40.0, 25.0, 18.0].map(|n| n * 25.4));
    // A table that can't be read in any unit is refused at once.
    dropped(&mut hands, vec![("/a/broken.csv", Ok(b"Station,0,1\nSheer height,x,y z\n".to_vec()))]);
    assert_eq!(hands.app().editor().page, Page::Panes);
}

#[test]
fn a_dropped_picture_lies_under_the_plan() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let Opened { path, bytes } = picture("/a/Photo.PNG");
    dropped(&mut hands, vec![(&path, Ok(bytes))]);
    assert!(hands.app().editor().document().drawing.reference.is_some());
}

#[test]
fn dropped_files_ask_about_unsaved_work_as_well() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let middle = hands.on_plan(0.0, 0.0);
    hands.drag(&round(middle, vec2(120.0, 90.0), 60));
    dropped(&mut hands, vec![("/a/hood.sheet.json", Ok(design("hood")))]);
    assert!(hands.app().editor().asks().is_some());
    dropped(&mut hands, vec![("/a/brim.sheet.json", Ok(design("brim")))]);
    assert!(hands.sees("Answer the question first"));
    hands.click("Drop");
    assert_eq!(hands.app().editor().document().design.name, "hood");
}

#[test]
fn a_file_that_hovers_is_seen() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    hands.harness.run_steps(40);
    let shapes = hands.harness.output().shapes.len();
    hands.harness.input_mut().hovered_files.push(HoveredFile::default());
    hands.step();
    assert!(hands.harness.output().shapes.len() > shapes);
    hands.harness.input_mut().hovered_files.clear();
    hands.step();
    assert_eq!(hands.harness.output().shapes.len(), shapes);
}

/// Types a path in place of what stands there.
fn type_path(hands: &mut Hands, label: &str, path: &str) {
    hands.step();
    assert!(hands.harness.query_all_by_label(label).next().is_some(), "no field {label}");
    hands.key(Modifiers::COMMAND, Key::A);
    hands.harness.event(Event::Text(path.to_owned()));
    hands.step();
    hands.key(Modifiers::NONE, Key::Enter);
}

/// A window on a system without dialogs for files.
fn without_dialogs(paths: &[&str]) -> Hands {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let middle = hands.on_plan(0.0, 0.0);
    hands.drag(&round(middle, vec2(120.0, 90.0), 60));
    hands.settle();
    hands.disk.lock().unwrap().paths = Some(paths.iter().map(|path| (*path).to_owned()).collect());
    hands
}

#[test]
fn without_a_dialog_a_path_is_typed_to_save() {
    let mut hands = without_dialogs(&["/home/old.sheet.json"]);
    hands.run(Command::Save);
    hands.step();
    assert!(hands.sees("This system shows no dialog for files"));
    type_path(&mut hands, "Path of the file", "/home/old.sheet.json");
    assert!(hands.sees("/home/old.sheet.json is there already"));
    assert!(hands.disk.lock().unwrap().saved.is_empty(), "Enter replaces nothing");
    // It grows by what it says.
    hands.harness.run_steps(3);
    hands.click("Replace it");
    assert!(!hands.disk.lock().unwrap().saved.is_empty());
    assert_eq!(hands.app().editor().file(), Some("/home/old.sheet.json"));
    assert!(!hands.sees("This system shows no dialog"));
    // Save as begins with the name of the design.
    hands.run(Command::SaveAs);
    hands.step();
    hands.key(Modifiers::NONE, Key::Enter);
    assert_eq!(hands.app().editor().file(), Some("/home/untitled.sheet.json"));
}

#[test]
fn without_a_dialog_a_path_is_typed_to_export() {
    let mut hands = without_dialogs(&[]);
    hands.run(Command::Export);
    hands.click("Choose a folder…");
    hands.settle();
    hands.step();
    assert!(hands.sees("This system shows no dialog for files"));
    type_path(&mut hands, "Path of the folder", "/home/cut");
    assert!(!hands.disk.lock().unwrap().exported.is_empty());
    assert!(notice(&hands).ends_with("files are in /home/cut."));
}

#[test]
fn files_that_an_export_would_replace_are_asked_about() {
    let mut hands = without_dialogs(&[]);
    let export = |hands: &mut Hands| {
        hands.run(Command::Export);
        hands.click("Choose a folder…");
        hands.settle();
        hands.step();
        type_path(hands, "Path of the folder", "/home/cut");
    };
    export(&mut hands);
    let files = std::mem::take(&mut hands.disk.lock().unwrap().exported);
    assert!(files.len() > 1);
    let paths: Vec<String> = files.iter().map(|file| format!("/home/cut/{}", file.name)).collect();
    let first = paths[0].clone();
    hands.disk.lock().unwrap().paths = Some(paths);
    export(&mut hands);
    assert!(hands.sees(&format!("{first} and {} more file", files.len() - 1)));
    hands.key(Modifiers::NONE, Key::Enter);
    assert!(hands.disk.lock().unwrap().exported.is_empty(), "Enter replaces nothing");
    hands.harness.run_steps(3);
    hands.click("Replace them");
    assert_eq!(hands.disk.lock().unwrap().exported, files);
    assert!(!hands.sees("This system shows no dialog"));
}

#[test]
fn a_typed_path_to_what_can_not_be_opened_can_be_typed_again() {
    let mut hands = without_dialogs(&["/home/notes.doc", "/home/hood.sheet.json"]);
    hands.run(Command::Save);
    hands.step();
    hands.key(Modifiers::NONE, Key::Enter);
    let notes = || Opened { path: "/home/notes.doc".to_owned(), bytes: b"milk".to_vec() };
    let refusals = [
        (Command::AddReference, "is no picture in PNG or JPEG."),
        (Command::Open, "The editor opens designs (.json)"),
    ];
    for (command, why) in refusals {
        hands.disk.lock().unwrap().to_open = Some(notes());
        hands.run(command);
        hands.step();
        let said = notice(&hands);
        type_path(&mut hands, "Path of the file", "/home/notes.doc");
        hands.step();
        assert!(hands.sees("This system shows no dialog"), "{command:?}");
        // Once, where the path is typed.
        let found = hands.harness.query_all_by_label_contains(why).count();
        assert!(found == 1 && notice(&hands) == said, "{command:?}: {found}");
        if command == Command::AddReference {
            hands.key(Modifiers::NONE, Key::Escape);
        }
    }
    let (path, bytes) = ("/home/hood.sheet.json".to_owned(), design("hood"));
    hands.disk.lock().unwrap().to_open = Some(Opened { path: path.clone(), bytes });
    type_path(&mut hands, "Path of the file", &path);
    assert!(!hands.sees("This system shows no dialog"));
    assert_eq!(hands.app().editor().document().design.name, "hood");
}

#[test]
fn without_a_dialog_a_path_is_typed_to_open() {
    let mut hands = without_dialogs(&["/home/hood.sheet.json"]);
    let (path, bytes) = ("/home/hood.sheet.json".to_owned(), design("hood"));
    hands.disk.lock().unwrap().to_open = Some(Opened { path, bytes });
    for command in [Command::Open, Command::AddReference] {
        hands.run(command);
        hands.step();
        type_path(&mut hands, "Path of the file", "/home/nothing");
        assert!(hands.sees("/home/nothing is not there."));
        hands.key(Modifiers::NONE, Key::Escape);
        assert!(!hands.sees("This system shows no dialog"));
    }
    hands.run(Command::Open);
    hands.step();
    type_path(&mut hands, "Path of the file", "/home/hood.sheet.json");
    assert!(hands.app().editor().asks().is_some());
    // Its path is typed too where the work is saved first.
    hands.click("Save");
    hands.step();
    hands.key(Modifiers::NONE, Key::Enter);
    hands.step();
    assert_eq!(hands.app().editor().document().design.name, "hood");
}

const CHILD: &str = "SHEETWRIGHT_TEST_CHILD";

/// In a program that finds neither a portal nor zenity: this one, started once more.
#[test]
fn a_system_without_dialogs_is_told_from_a_person_who_changes_his_mind() {
    let name = "a_system_without_dialogs_is_told_from_a_person_who_changes_his_mind";
    if std::env::var_os(CHILD).is_none() {
        let status = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--exact", name])
            .env(CHILD, "1")
            .env("PATH", "/nowhere")
            .env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nowhere")
            .status()
            .unwrap();
        assert!(status.success());
        return;
    }
    let save = FileWish::Save { to: None, name: "a".to_owned(), bytes: Vec::new(), version: 1 };
    for wish in [FileWish::Open, FileWish::Picture, save, FileWish::Export(Vec::new())] {
        let mut dialogs = SystemDialogs::new(Arc::new(|| {}));
        dialogs.grant(wish.clone());
        let start = Instant::now();
        let answer = loop {
            if let Some(answer) = dialogs.answers().pop() {
                break answer;
            }
            assert!(start.elapsed() < Duration::from_secs(20), "no answer to {wish:?}");
            std::thread::sleep(Duration::from_millis(5));
        };
        let FileAnswer::NoDialog { wish: found, folder } = answer else { panic!("{answer:?}") };
        assert_eq!(found, wish);
        assert!(Path::new(&folder).is_dir() && folder.ends_with('/'));
    }
}

#[test]
fn typed_paths_are_paths_of_the_system() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let mut dialogs = SystemDialogs::new(Arc::new(|| {}));
    let (name, bytes) = ("hood.sheet.json".to_owned(), design("hood"));
    let save = FileWish::Save { to: None, name, bytes: bytes.clone(), version: 3 };
    // With the ending that it takes to be opened again, and with the name that was offered.
    for (typed, path) in [("a", "a.sheet.json"), ("b.json", "b.json"), ("", "hood.sheet.json")] {
        let path = at(path);
        let granted = Typed::Granted(FileAnswer::Saved { path: path.clone(), version: 3 });
        assert_eq!(dialogs.grant_at(&save, &at(typed), false), granted);
        let is_there = Typed::IsThere { first: path.clone(), count: 1 };
        assert_eq!(dialogs.grant_at(&save, &at(typed), false), is_there);
        assert_eq!(dialogs.grant_at(&save, &at(typed), true), granted);
        let opened = Opened { path, bytes: bytes.clone() };
        let found = dialogs.grant_at(&FileWish::Open, &format!(" {} ", opened.path), false);
        assert_eq!(found, Typed::Granted(FileAnswer::Opened(opened)));
    }
    let Typed::Failed(text) = dialogs.grant_at(&FileWish::Open, &at("none"), false) else {
        panic!("there is none")
    };
    assert!(text.contains("none can't be read"), "{text}");
    let export = dialogs.grant_at(&FileWish::Export(Vec::new()), &at("new/folder"), false);
    assert!(matches!(export, Typed::Granted(FileAnswer::Exported { count: 0, .. })), "{export:?}");
}

#[test]
fn files_in_a_typed_folder_are_replaced_only_where_that_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let (path, name) = (folder.path().display().to_string(), |name: &str| name.to_owned());
    let mut dialogs = SystemDialogs::new(Arc::new(|| {}));
    for file in ["b.dxf", "c.dxf"] {
        std::fs::write(folder.path().join(file), "mine").unwrap();
    }
    let file = |of: &str| OutputFile { name: name(of), bytes: b"new".to_vec() };
    let export = FileWish::Export(vec![file("a.dxf"), file("b.dxf"), file("c.dxf")]);
    let read = |file: &str| std::fs::read_to_string(folder.path().join(file)).ok();
    let first = folder.path().join("b.dxf").display().to_string();
    assert_eq!(dialogs.grant_at(&export, &path, false), Typed::IsThere { first, count: 2 });
    assert_eq!((read("a.dxf"), read("b.dxf")), (None, Some(name("mine"))));
    let granted = Typed::Granted(FileAnswer::Exported { count: 3, folder: path.clone() });
    assert_eq!(dialogs.grant_at(&export, &path, true), granted);
    assert_eq!((read("a.dxf"), read("c.dxf")), (Some(name("new")), Some(name("new"))));
    // Other names stay unasked.
    let other = FileWish::Export(vec![file("d.dxf")]);
    let granted = Typed::Granted(FileAnswer::Exported { count: 1, folder: path.clone() });
    assert_eq!(dialogs.grant_at(&other, &path, false), granted);
}
