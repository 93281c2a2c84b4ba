//! Work that no file has never goes unasked: whatever takes its place, the person saves it, drops
//! it or stays with it; and what was dropped can be had back.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::{Event, Key, Modifiers, ViewportCommand, ViewportEvent, ViewportId, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use hands::{Hands, round};
use sheetwright_editor::command::Command;
use sheetwright_editor::document::Document;
use sheetwright_editor::document::{PointRef, Selection};
use sheetwright_editor::editor::{Opened, Page};
use sheetwright_editor::scene::Act;
use sheetwright_editor::store::Store;
use std::path::Path;
use std::time::{Duration, Instant};

const SIZE: [f32; 2] = [1280.0, 800.0];

/// A dome from the start page, changed by hand.
fn changed_dome() -> Hands {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    hands.click("Dome in gores");
    hands.click("Make it");
    assert!(hands.sees("· not saved yet"), "it has no file");
    lift(&mut hands);
    hands
}

/// Changes the design: a handle is lifted.
fn lift(hands: &mut Hands) {
    let editor = hands.harness.state_mut().editor_mut();
    let at = PointRef { curve: 0, point: 1 };
    let mut to = editor.document().design.curves[0].points[1].at;
    to.z += 7.0;
    editor.carry_out(Act::Select(Selection::of_point(at)));
    editor.carry_out(Act::Move(vec![(at, to)]));
    editor.carry_out(Act::Rest);
    hands.step();
}

/// Frames for so long, so that what is kept by itself is kept.
fn wait(hands: &mut Hands) {
    let start = Instant::now();
    while start.elapsed() < Duration::from_millis(1300) {
        hands.step();
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn document(hands: &Hands) -> Document {
    hands.app().editor().document().clone()
}

fn asks(hands: &mut Hands) -> bool {
    // It is measured before it is seen.
    hands.step();
    assert_eq!(hands.app().editor().asks().is_some(), hands.sees("is not saved yet"));
    hands.app().editor().asks().is_some()
}

fn kept_in(hands: &mut Hands, folder: &Path) {
    hands.harness.state_mut().keep_in(Store::open_at(folder).unwrap());
    hands.step();
}

/// A way in which another document takes the place of one.
type Way = (&'static str, fn(&mut Hands));

/// All ways in which that happens.
fn ways() -> Vec<Way> {
    vec![
        ("another template", |hands| {
            hands.run(Command::Start);
            hands.click("Cone or frustum");
            hands.click("Make it");
        }),
        ("an example", |hands| {
            hands.run(Command::Start);
            // What was searched for last is still there.
            if hands.harness.query_by_label("Mouse").is_some() {
                hands.type_into("Search shapes", "hat");
            }
            hands.click("Hat");
        }),
        ("New", |hands| hands.run(Command::New)),
        ("New by its key", |hands| hands.key(Modifiers::COMMAND, Key::N)),
        ("Draw an outline", |hands| {
            hands.run(Command::Start);
            hands.click("Draw an outline");
        }),
        ("Open", |hands| {
            let bytes = Document::default().bytes();
            let path = "other.sheet.json".to_owned();
            hands.disk.lock().unwrap().to_open = Some(Opened { path, bytes });
            hands.run(Command::Open);
            hands.step();
        }),
        ("a file by its path", |hands| {
            let leaf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/leaf.csv");
            hands.harness.state_mut().open_path(leaf);
            hands.step();
        }),
    ]
}

#[test]
fn nothing_takes_the_place_of_unsaved_work_unasked() {
    for (way, go) in ways() {
        let mut hands = changed_dome();
        let work = document(&hands);
        go(&mut hands);
        assert!(asks(&mut hands), "{way}");
        assert_eq!(document(&hands), work, "{way}: it waits");
        // To stay, by the button and by the key.
        hands.click("Cancel");
        assert!(!asks(&mut hands) && document(&hands) == work, "{way}");
        go(&mut hands);
        hands.key(Modifiers::NONE, Key::Escape);
        assert!(!asks(&mut hands) && document(&hands) == work, "{way}");
        // To save.
        go(&mut hands);
        hands.click("Save");
        hands.step();
        assert!(!asks(&mut hands) && document(&hands) != work, "{way}");
        let saved = hands.disk.lock().unwrap().saved.clone();
        assert_eq!(Document::read("a.sheet.json", &saved), Ok(work), "{way}");
        assert_ne!(hands.app().editor().page, Page::Start, "{way}");
    }
}

#[test]
fn who_stays_with_unsaved_work_keeps_the_numbers_typed_for_a_template() {
    let mut hands = changed_dome();
    hands.run(Command::Start);
    hands.click("Lampshade");
    hands.type_into("Diameter of the lower ring", "30cm");
    for leaves in ["Esc", "Cancel"] {
        hands.click("Make it");
        assert!(asks(&mut hands));
        match leaves {
            "Esc" => hands.key(Modifiers::NONE, Key::Escape),
            _ => hands.click("Cancel"),
        }
        assert!(!asks(&mut hands) && hands.app().editor().page == Page::Start);
        let field = hands.harness.query_all_by_label("Diameter of the lower ring");
        let values: Vec<_> = field.filter_map(|node| node.accesskit_node().value()).collect();
        assert!(values.contains(&"300 mm".to_owned()), "{leaves}: {values:?}");
    }
    hands.click("Make it");
    assert!(asks(&mut hands));
    hands.click("Drop");
    assert_eq!(hands.app().editor().page, Page::Panes);
    // Once it is taken, the shapes are shown again.
    hands.run(Command::Start);
    assert!(hands.sees("Dome in gores") && !hands.sees("Make it"));
}

#[test]
fn who_changes_his_mind_about_saving_is_asked_again() {
    let mut hands = changed_dome();
    let work = document(&hands);
    hands.disk.lock().unwrap().saves_nothing = true;
    hands.run(Command::New);
    hands.click("Save");
    hands.step();
    assert!(asks(&mut hands));
    assert_eq!(document(&hands), work);
}

#[test]
fn while_it_asks_no_key_reaches_what_is_below() {
    let mut hands = changed_dome();
    let work = document(&hands);
    hands.run(Command::New);
    for key in [Key::Delete, Key::ArrowLeft, Key::PageUp, Key::B, Key::H, Key::C] {
        hands.key(Modifiers::NONE, key);
    }
    hands.key(Modifiers::COMMAND, Key::Z);
    hands.harness.event(Event::Text("b".to_owned()));
    hands.step();
    assert!(asks(&mut hands));
    assert_eq!(document(&hands), work);
    // Enter saves: that button is where keys are.
    hands.key(Modifiers::NONE, Key::Enter);
    hands.step();
    assert!(!hands.disk.lock().unwrap().saved.is_empty());
    assert_ne!(document(&hands), work);
}

#[test]
fn what_is_to_be_had_again_is_not_asked_about() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    for shape in ["Dome in gores", "Cone or frustum"] {
        hands.run(Command::Start);
        hands.click(shape);
        hands.click("Make it");
        assert!(!asks(&mut hands), "{shape}");
    }
    hands.run(Command::New);
    assert!(!asks(&mut hands));
    // What has typed numbers is work.
    hands.run(Command::Start);
    hands.click("Lampshade");
    hands.type_into("Diameter of the lower ring", "30cm");
    hands.click("Make it");
    hands.run(Command::New);
    assert!(asks(&mut hands));
}

#[test]
fn a_saved_design_is_asked_about_only_after_a_change() {
    let mut hands = changed_dome();
    hands.run(Command::Save);
    hands.step();
    assert!(!hands.sees("· not saved yet"));
    lift(&mut hands);
    assert!(hands.sees("· not saved yet"));
    // Taken back, it is what the file has.
    hands.run(Command::Undo);
    assert!(!hands.sees("· not saved yet"));
    hands.run(Command::Redo);
    assert!(hands.sees("· not saved yet"));
    hands.run(Command::New);
    assert!(asks(&mut hands));
    hands.click("Save");
    hands.step();
    assert!(!asks(&mut hands) && document(&hands).is_blank());
    assert!(!hands.sees("· not saved yet"));
}

#[test]
fn what_was_dropped_is_recently_closed_and_comes_back_with_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut hands = changed_dome();
    kept_in(&mut hands, folder.path());
    hands.run(Command::Save);
    hands.step();
    let file = hands.app().editor().file().unwrap().to_owned();
    lift(&mut hands);
    let work = document(&hands);
    hands.run(Command::New);
    hands.click("Drop");
    assert!(document(&hands).is_blank());
    // In this window,
    hands.run(Command::Start);
    assert!(hands.sees("Recently closed"));
    wait(&mut hands);
    drop(hands);
    // and in the next.
    for n in 0..2 {
        let mut hands = Hands::new(SIZE, false);
        kept_in(&mut hands, folder.path());
        assert!(!hands.sees("Not saved when the editor ended"), "{n}");
        hands.harness.get_by_label_contains(" ago").click();
        hands.step();
        hands.step();
        assert_eq!(document(&hands), work);
        assert!(hands.app().editor().is_unsaved());
        assert_eq!(hands.app().editor().file(), Some(&file[..]));
        if n == 0 {
            hands.run(Command::New);
            hands.click("Drop");
        } else {
            hands.run(Command::Save);
            hands.step();
        }
        wait(&mut hands);
    }
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    assert!(!hands.sees("Recently closed") && !hands.sees(" ago"));
}

#[test]
fn of_what_was_dropped_the_newest_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    for n in 0..11 {
        let editor = hands.harness.state_mut().editor_mut();
        let mut document = Document::default();
        document.design.name = format!("design {n}");
        editor.replace(document, None);
        hands.run(Command::AddCircle);
        hands.run(Command::New);
        hands.click("Drop");
    }
    wait(&mut hands);
    drop(hands);
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    let found = hands.harness.query_all_by_label_contains(" ago").count();
    assert_eq!(found, 8);
    assert!(hands.sees("design 10,") && hands.sees("design 3,") && !hands.sees("design 2,"));
}

#[test]
fn a_recovered_design_keeps_its_file_and_is_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let mut hands = changed_dome();
    kept_in(&mut hands, folder.path());
    hands.run(Command::Save);
    hands.step();
    lift(&mut hands);
    let work = document(&hands);
    wait(&mut hands);
    drop(hands);
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    assert!(hands.sees("Not saved when the editor ended"));
    hands.harness.get_by_label_contains(" ago").click();
    hands.step();
    hands.step();
    assert_eq!(document(&hands), work);
    assert!(hands.sees("· not saved yet"));
    hands.run(Command::New);
    assert!(asks(&mut hands));
    hands.click("Cancel");
    // It goes to its own file, unasked.
    hands.disk.lock().unwrap().saves_nothing = true;
    hands.run(Command::Save);
    hands.step();
    assert!(!hands.app().editor().is_unsaved());
    let saved = hands.disk.lock().unwrap().saved.clone();
    assert_eq!(Document::read("a.sheet.json", &saved), Ok(work));
}

#[test]
fn unsaved_work_waits_for_a_recovered_design_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut hands = changed_dome();
    kept_in(&mut hands, folder.path());
    lift(&mut hands);
    wait(&mut hands);
    drop(hands);
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    hands.run(Command::New);
    let middle = hands.on_plan(0.0, 0.0);
    hands.drag(&round(middle, vec2(120.0, 90.0), 60));
    let drawn = document(&hands);
    hands.run(Command::Start);
    hands.harness.get_by_label_contains(" ago").click();
    hands.step();
    hands.step();
    assert!(asks(&mut hands));
    hands.click("Cancel");
    assert_eq!(document(&hands), drawn);
    assert!(hands.sees("Not saved when the editor ended"), "it is still offered");
    hands.click(&format!("Back to {}", drawn.design.name));
    assert_eq!(hands.app().editor().page, Page::Panes);
}

/// Whether the window closes when its cross is clicked.
fn closes(hands: &mut Hands) -> bool {
    let viewport = hands.harness.input_mut().viewports.get_mut(&ViewportId::ROOT).unwrap();
    viewport.events.push(ViewportEvent::Close);
    hands.harness.step();
    let output = &hands.harness.output().viewport_output[&ViewportId::ROOT];
    !output.commands.contains(&ViewportCommand::CancelClose)
}

#[test]
fn a_window_with_unsaved_work_asks_before_it_closes() {
    let folder = tempfile::tempdir().unwrap();
    let mut hands = Hands::new(SIZE, false);
    assert!(closes(&mut hands), "without work");
    let mut hands = changed_dome();
    kept_in(&mut hands, folder.path());
    let work = document(&hands);
    assert!(!closes(&mut hands));
    assert!(asks(&mut hands));
    hands.click("Cancel");
    assert!(!closes(&mut hands));
    hands.click("Drop");
    assert!(hands.app().editor().closes());
    assert!(closes(&mut hands));
    drop(hands);
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    assert!(!hands.sees("Not saved when the editor ended"));
    hands.harness.get_by_label_contains(" ago").click();
    hands.step();
    hands.step();
    assert_eq!(document(&hands), work);
    assert!(!closes(&mut hands) && asks(&mut hands));
    hands.click("Save");
    hands.step();
    assert!(closes(&mut hands));
}

#[test]
fn a_file_saved_late_is_not_that_of_the_next_design() {
    let mut hands = changed_dome();
    let editor = hands.harness.state_mut().editor_mut();
    let version = editor.history().version();
    editor.replace(Document::default(), None);
    editor.saved("dome.sheet.json".to_owned(), version);
    assert_eq!(editor.file(), None);
}

#[test]
fn a_long_name_leaves_the_button_that_forgets_it_in_sight() {
    let folder = tempfile::tempdir().unwrap();
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    let mut document = Document::default();
    document.design.name = "a hood over a stove with a name that is longer than any".to_owned();
    hands.harness.state_mut().editor_mut().replace(document, None);
    hands.run(Command::AddCircle);
    wait(&mut hands);
    drop(hands);
    let mut hands = Hands::new(SIZE, false);
    kept_in(&mut hands, folder.path());
    hands.step();
    let button = hands.harness.get_by_label("×").rect();
    assert!(button.min.x > 0.0 && button.max.x <= 230.0, "{button}");
    hands.click("×");
    assert!(!hands.sees("Not saved when the editor ended"));
}
