//! The editor, driven as a person does: by its panes, names and keys.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, TouchPhase, pos2, vec2,
};
use egui_kittest::kittest::Queryable;
use hands::{Hands, picture, round};
use sheetwright::make::make;
use sheetwright::math::{Point2, Point3};
use sheetwright::watch::Unwatched;
use sheetwright_editor::command::Command;
use sheetwright_editor::document::{Document, Mirror};
use sheetwright_editor::document::{Edit, PointRef};
use sheetwright_editor::editor::{Opened, Page};
use sheetwright_editor::scene::Act;
use sheetwright_files::{Format, PdfOptions, output_files};

const SIZE: [f32; 2] = [1280.0, 800.0];

/// Draws an outline in the middle of the plan.
fn drawn() -> Hands {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let middle = hands.on_plan(0.0, 0.0);
    hands.drag(&round(middle, vec2(170.0, 110.0), 90));
    hands.settle();
    hands
}

/// Lifts a point by its field at the side.
fn lift(hands: &mut Hands, point: usize, text: &str) {
    let at = PointRef { curve: 0, point };
    let selection = sheetwright_editor::document::Selection::of_point(at);
    hands.harness.state_mut().editor_mut().carry_out(Act::Select(selection));
    hands.step();
    hands.type_into("Lift (z)", text);
    hands.settle();
}

#[test]
fn a_stroke_becomes_an_outline_and_a_panel() {
    let hands = drawn();
    let document = hands.app().editor().document();
    assert_eq!(document.design.curves.len(), 1);
    let curve = &document.design.curves[0];
    assert!(curve.closed && (4..=10).contains(&curve.points.len()), "{curve:?}");
    assert!(curve.points.iter().all(|p| !p.corner && p.at.z == 0.0));
    assert_eq!(document.design.panels.len(), 1);
    let shown = hands.app().editor().shown()[0].made.as_ref().unwrap();
    assert_eq!(shown.positions.len(), 400);
    assert!(shown.length_error_max < 1e-9 && shown.warp_max_deg < 1e-6);
}

#[test]
fn a_lifted_handle_stays_over_its_place_and_its_number_is_the_one_typed() {
    let mut hands = drawn();
    let before = hands.app().editor().document().design.curves[0].points[1].at;
    lift(&mut hands, 1, "4cm");
    let after = hands.app().editor().document().design.curves[0].points[1].at;
    assert_eq!((after.x, after.y, after.z), (before.x, before.y, 40.0));
    let shown = hands.app().editor().shown()[0].made.as_ref().unwrap();
    assert!(shown.positions.iter().any(|p| p.z > 39.0));
    // What can't be read changes nothing.
    lift(&mut hands, 1, "4 kg");
    assert_eq!(hands.app().editor().document().design.curves[0].points[1].at, after);
}

#[test]
fn a_hole_is_found_by_where_it_lies() {
    let mut hands = drawn();
    hands.key(Modifiers::NONE, Key::D);
    let middle = hands.on_plan(0.0, 0.0);
    hands.drag(&round(middle, vec2(50.0, 36.0), 60));
    hands.settle();
    let design = &hands.app().editor().document().design;
    assert_eq!((design.curves.len(), design.panels.len()), (2, 1));
    let shown = hands.app().editor().shown()[0].made.as_ref().unwrap();
    assert_eq!(shown.loops.len(), 2);
}

#[test]
fn twenty_steps_are_taken_back_and_done_again() {
    let mut hands = drawn();
    let empty_steps = hands.app().editor().history().steps_back();
    assert_eq!(empty_steps, 1);
    let mut documents = vec![hands.app().editor().document().clone()];
    for n in 0..20 {
        lift(&mut hands, n % 4, &format!("{}mm", 5 + n));
        documents.push(hands.app().editor().document().clone());
    }
    assert_eq!(hands.app().editor().history().steps_back(), 21);
    for wanted in documents.iter().rev().skip(1) {
        hands.key(Modifiers::COMMAND, Key::Z);
        assert_eq!(hands.app().editor().document(), wanted);
    }
    for wanted in &documents[1..] {
        hands.key(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
        assert_eq!(hands.app().editor().document(), wanted);
    }
    // What was typed last is what is shown.
    hands.settle();
}

#[test]
fn dragging_a_handle_on_the_plan_is_one_step_and_snaps_level() {
    let mut hands = drawn();
    let points = hands.app().editor().document().design.curves[0].points.clone();
    let from = hands.on_plan(points[0].at.x, points[0].at.y);
    let way: Vec<_> = (0..=20).map(|n| from + vec2(2.0 * n as f32, -0.2 * n as f32)).collect();
    hands.drag(&way);
    hands.settle();
    let editor = hands.app().editor();
    assert_eq!(editor.history().steps_back(), 2);
    let moved = editor.document().design.curves[0].points[0].at;
    assert!((moved.x - points[0].at.x).abs() > 30.0, "{moved:?} {:?}", points[0].at);
    assert_eq!(editor.selection().points, [PointRef { curve: 0, point: 0 }]);
}

#[test]
fn points_move_so_that_the_sheet_bends_and_are_accepted_or_dropped() {
    let mut hands = Hands::new(SIZE, false);
    let hull = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/ubc-fishing-vessel.sheet.json");
    let app = hands.harness.state_mut();
    app.open_path(hull);
    let mut document = app.editor().document().clone();
    document.design.panels.iter_mut().for_each(|panel| panel.samples = 60);
    app.editor_mut().replace(document, None);
    hands.settle();
    let before = hands.app().editor().document().clone();
    let worst = |hands: &Hands| {
        let shown = hands.app().editor().shown().iter();
        shown.map(|panel| panel.made.as_ref().unwrap().warp_max_deg).fold(0.0, f64::max)
    };
    let was = worst(&hands);
    for accept in [false, true] {
        hands.key(Modifiers::NONE, Key::V);
        assert_eq!(hands.app().editor().page, Page::Vary);
        hands.harness.run_steps(3);
        hands.click("As little twist as these limits allow");
        hands.click("Try it");
        hands.settle();
        let varied = hands.app().editor().varied().unwrap().as_ref().unwrap();
        assert!(varied.moved.is_some() && varied.moved_max_mm > 0.0);
        hands.click(if accept { "Accept" } else { "Drop" });
        hands.settle();
        assert_eq!(*hands.app().editor().document() == before, !accept);
    }
    assert!(worst(&hands) < was);
    hands.key(Modifiers::COMMAND, Key::Z);
    assert_eq!(*hands.app().editor().document(), before);
}

#[test]
fn exported_files_are_those_of_the_command_line() {
    let mut hands = drawn();
    lift(&mut hands, 2, "35mm");
    hands.save_and_export();
    let disk = hands.disk.lock().unwrap();
    // What the command line does with the saved file.
    let options = sheetwright_files::ReadOptions::default();
    let format = sheetwright_files::InputFormat::Design;
    let read = sheetwright_files::read_bytes(format, &disk.saved, "a.sheet.json", None, &options);
    let made = make(&read.unwrap(), &mut Unwatched).unwrap();
    let wanted = output_files(&made, &Format::DEFAULT, &PdfOptions::default()).unwrap().files;
    assert!(wanted.len() >= 5);
    assert_eq!(disk.exported.len(), wanted.len());
    for (found, wanted) in disk.exported.iter().zip(&wanted) {
        assert_eq!(found.name, wanted.name);
        assert!(found.bytes == wanted.bytes, "{}", wanted.name);
    }
}

#[test]
fn what_is_saved_opens_as_it_was() {
    let mut hands = drawn();
    lift(&mut hands, 0, "1' 4\"");
    hands.run(Command::ToggleMirror);
    hands.run(Command::Save);
    hands.step();
    assert!(!hands.app().editor().is_unsaved());
    let document = hands.app().editor().document().clone();
    let bytes = hands.disk.lock().unwrap().saved.clone();
    assert_eq!(Document::read("untitled.sheet.json", &bytes), Ok(document.clone()));
    hands.run(Command::New);
    hands.disk.lock().unwrap().to_open =
        Some(Opened { path: "untitled.sheet.json".to_owned(), bytes });
    hands.run(Command::Open);
    hands.step();
    assert_eq!(*hands.app().editor().document(), document);
}

#[test]
fn keys_alone_make_a_panel_with_a_hole() {
    let mut hands = Hands::new(SIZE, false);
    hands.key(Modifiers::COMMAND, Key::N);
    hands.key(Modifiers::NONE, Key::B);
    hands.key(Modifiers::NONE, Key::N);
    hands.settle();
    let shown = hands.app().editor().shown()[0].made.as_ref().unwrap();
    assert_eq!(shown.loops.len(), 2);
    // The round one is a circle within some millionths of its size.
    let curve = &hands.app().editor().document().design.curves[1];
    let made = sheetwright::curve::Curve::new(curve.kind.unwrap(), &curve.points, true).unwrap();
    let radius = |u: f64| made.position(u).to_vec().length();
    let off = |n: i32| (radius(f64::from(n) / 100.0) - 100.0).abs();
    assert!((0..3200).all(|n| off(n) < 5e-4));
    hands.key(Modifiers::COMMAND, Key::E);
    assert_eq!(hands.app().editor().page, Page::Export);
}

#[test]
fn escape_ends_the_tool_and_then_the_selection() {
    let mut hands = drawn();
    hands.key(Modifiers::COMMAND, Key::A);
    assert!(!hands.app().editor().selection().is_empty());
    hands.key(Modifiers::NONE, Key::D);
    let draws = sheetwright_editor::panes::plan::Tool::Draw;
    assert_eq!(hands.app().editor().tool, draws);
    hands.key(Modifiers::NONE, Key::Escape);
    assert_ne!(hands.app().editor().tool, draws);
    assert!(!hands.app().editor().selection().is_empty());
    hands.key(Modifiers::NONE, Key::Escape);
    assert!(hands.app().editor().selection().is_empty());
}

#[test]
fn with_a_mirror_both_sides_move_alike() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    hands.run(Command::ToggleMirror);
    // Half an outline, from the mirror to the mirror.
    let middle = hands.on_plan(0.0, 0.0);
    let whole = round(middle, vec2(130.0, 150.0), 80);
    let half: Vec<_> = whole.into_iter().filter(|at| at.x > middle.x - 4.0).collect();
    let turn = half.iter().position(|at| at.y == half.iter().map(|p| p.y).fold(f32::MAX, f32::min));
    let mut half = half;
    half.sort_by(|a, b| a.y.total_cmp(&b.y));
    assert!(turn.is_some());
    hands.run(Command::Draw);
    hands.drag(&half);
    hands.settle();
    let curve = hands.app().editor().document().design.curves[0].clone();
    assert!(curve.closed, "{curve:?}");
    let alike = |curve: &sheetwright::design::DesignCurve| {
        curve.points.iter().all(|p| {
            let is_image = |q: &sheetwright::curve::CurvePoint| {
                (q.at.x + p.at.x).abs() < 1e-6
                    && (q.at.y - p.at.y).abs() < 1e-6
                    && (q.at.z - p.at.z).abs() < 1e-6
            };
            curve.points.iter().any(is_image)
        })
    };
    assert!(alike(&curve), "{curve:?}");
    lift(&mut hands, 1, "25");
    let lifted = &hands.app().editor().document().design.curves[0];
    assert_eq!(lifted.points[1].at.z, 25.0);
    assert!(alike(lifted), "{lifted:?}");
}

/// Found by the monkey: a mirror a thousand kilometres away made an image twice as far out, and a
/// file that could not be opened again.
#[test]
fn what_no_file_could_hold_is_refused() {
    let mut hands = drawn();
    let refuses = |hands: &mut Hands, what: &str, act: Act| {
        let editor = hands.harness.state_mut().editor_mut();
        let before = editor.document().clone();
        editor.carry_out(act);
        editor.carry_out(Act::Rest);
        let notice = editor.notice.as_ref().unwrap();
        assert!(notice.is_refusal, "{what}: {}", notice.text);
        let says = format!("{what} would lie farther out than 100 km.");
        assert!(notice.text.starts_with(&says), "{}", notice.text);
        assert_eq!(editor.document(), &before);
        assert_eq!(Document::read("a.sheet.json", &editor.bytes()).as_ref(), Ok(&before));
    };
    let at = PointRef { curve: 0, point: 1 };
    let name = hands.app().editor().document().design.curves[0].name.clone();
    refuses(&mut hands, &name, Act::Move(vec![(at, Point3::new(0.0, 0.0, 1.1e8))]));
    let mut drawing = hands.app().editor().document().drawing.clone();
    drawing.mirror = Some(Mirror { upright: true, at_mm: 1e8 });
    let editor = hands.harness.state_mut().editor_mut();
    editor.carry_out(Act::Edit(Edit::SetDrawing(Box::new(drawing))));
    assert!(editor.document().drawing.mirror.is_some());
    let corners = [[-300.0, 0.0], [-200.0, 0.0], [-200.0, 90.0]].map(|[x, y]| Point2::new(x, y));
    let corners = Edit::Corners { corners: corners.to_vec(), closed: true };
    refuses(&mut hands, "outline 3", Act::Edit(corners));
}

#[test]
fn corners_put_by_clicks_make_straight_sides() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let centre = hands.on_plan(0.0, 0.0);
    for [x, y] in [[-100.0, -80.0], [120.0, -80.0], [120.0, 90.0], [-100.0, 90.0]] {
        let at = centre + vec2(x, y);
        hands.drag(&[at, at]);
        // Slower than a double click.
        hands.harness.run_steps(40);
    }
    hands.key(Modifiers::NONE, Key::Enter);
    hands.settle();
    let curve = &hands.app().editor().document().design.curves[0];
    assert_eq!((curve.points.len(), curve.closed), (4, true));
    assert!(curve.points.iter().all(|p| p.corner));
}

#[test]
fn everything_can_be_found_by_name_and_a_greyed_command_says_why() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let editor = hands.app().editor();
    for command in Command::all() {
        let why = editor.why_not(command);
        assert!(why.is_none_or(|why| why.ends_with('.')), "{command:?}");
    }
    assert!(editor.why_not(Command::Undo).is_some());
    assert!(editor.why_not(Command::Export).is_some());
    hands.key(Modifiers::COMMAND, Key::K);
    assert_eq!(hands.app().editor().page, Page::Palette);
    hands.harness.event(Event::Text("snap".to_owned()));
    hands.step();
    hands.key(Modifiers::NONE, Key::Enter);
    hands.step();
    assert!(hands.app().editor().document().drawing.snap_to_grid);
    assert_eq!(hands.app().editor().page, Page::Panes);
}

#[test]
fn what_was_not_saved_comes_back_and_settings_stay() {
    let folder = tempfile::tempdir().unwrap();
    let open = || sheetwright_editor::store::Store::open_at(folder.path()).unwrap();
    let mut hands = Hands::new(SIZE, false);
    hands.harness.state_mut().keep_in(open());
    hands.run(Command::Look(sheetwright_editor::theme::Look::Dark));
    hands.run(Command::New);
    let middle = hands.on_plan(0.0, 0.0);
    hands.drag(&round(middle, vec2(120.0, 90.0), 60));
    let lost = hands.app().editor().document().clone();
    let start = std::time::Instant::now();
    while start.elapsed() < std::time::Duration::from_millis(1500) {
        hands.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    drop(hands);
    let mut hands = Hands::new(SIZE, false);
    hands.harness.state_mut().keep_in(open());
    hands.step();
    assert_eq!(hands.app().editor().look, sheetwright_editor::theme::Look::Dark);
    let found = hands.harness.get_by_label_contains("ago").rect().center();
    hands.drag(&[found, found]);
    assert_eq!(*hands.app().editor().document(), lost);
    assert!(hands.app().editor().is_unsaved());
}

/// What is not possible now is no error: it is said in passing, and gone as soon as anything
/// changes.
#[test]
fn what_is_not_possible_now_is_said_in_passing() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    for key in [Key::Z, Key::S, Key::E, Key::A] {
        hands.key(Modifiers::COMMAND, key);
        let notice = hands.app().editor().notice.clone().unwrap();
        assert!(notice.is_passing && !notice.is_refusal, "{notice:?}");
    }
    assert!(hands.sees("Nothing is drawn yet."));
    let middle = hands.on_plan(0.0, 0.0);
    let way = round(middle, vec2(170.0, 110.0), 90);
    hands.drag(&way);
    hands.settle();
    assert!(!hands.sees("Nothing is drawn yet."));
    // It goes by itself too.
    hands.key(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!(hands.sees("Nothing was taken back."));
    let start = std::time::Instant::now();
    while hands.sees("Nothing was taken back.") {
        assert!(start.elapsed() < std::time::Duration::from_secs(10), "it stays");
        std::thread::sleep(std::time::Duration::from_millis(50));
        hands.step();
    }
    // What stands in no hurry stays.
    hands.run(Command::Save);
    hands.step();
    let saved = hands.app().editor().notice.clone().unwrap();
    assert!(!saved.is_passing && saved.text.ends_with('.'), "{saved:?}");
}

/// Seen: "… on the same spot as the one before Remove one of the two; …".
#[test]
fn why_a_panel_is_not_made_stands_in_sentences() {
    let mut hands = drawn();
    let mut document = hands.app().editor().document().clone();
    let points = &mut document.design.curves[0].points;
    points[1].at = points[0].at;
    hands.harness.state_mut().editor_mut().replace(document, None);
    hands.settle();
    let refusal = hands.app().editor().shown()[0].made.clone().unwrap_err();
    assert!(refusal.message.ends_with("as the one before."), "{refusal:?}");
    assert!(refusal.message.starts_with(char::is_uppercase), "{refusal:?}");
    assert!(refusal.hint.starts_with("Remove one") && refusal.hint.ends_with('.'), "{refusal:?}");
    assert!(hands.sees("as the one before. Remove one of the two"));
    // Its name selects it, as that of any panel does.
    let name = hands.app().editor().shown()[0].name.clone();
    hands.click(&name);
    assert_eq!(hands.app().editor().selection().panel, Some(0));
}

#[test]
fn a_picture_is_scaled_by_two_places_and_their_distance() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    hands.disk.lock().unwrap().to_open = Some(picture("photo.png"));
    hands.key(Modifiers::NONE, Key::P);
    hands.step();
    let reference = |hands: &Hands| {
        let drawing = &hands.app().editor().document().drawing;
        let picture = drawing.reference.as_ref().unwrap();
        (picture.mm_per_pixel, picture.centre.x, picture.centre.y)
    };
    assert_eq!(reference(&hands), (5.0, 0.0, 0.0));
    hands.key(Modifiers::NONE, Key::K);
    for x in [-200.0, 200.0] {
        // Two clicks that follow one another quickly are one double click.
        hands.harness.run_steps(30);
        let at = hands.on_plan(x, 0.0);
        hands.drag(&[at, at]);
    }
    hands.step();
    assert_eq!(hands.app().editor().page, Page::Calibrate);
    hands.type_into("Distance", "1m");
    // The first place stays where it is, and the second is 1 m from it.
    let (mm_per_pixel, x, y) = reference(&hands);
    assert!((mm_per_pixel - 12.5).abs() < 0.05 && (x - 300.0).abs() < 3.0 && y.abs() < 3.0);
    assert_eq!(hands.app().editor().page, Page::Panes);
    hands.key(Modifiers::COMMAND, Key::Z);
    assert_eq!(reference(&hands), (5.0, 0.0, 0.0));
    // As far apart as nothing is.
    let editor = hands.harness.state_mut().editor_mut();
    editor.calibrate([Point2::new(0.0, 0.0), Point2::new(1e-3, 0.0)]);
    editor.calibrated(1e9);
    assert!(editor.notice.as_ref().unwrap().text.starts_with("The picture would lie farther out"));
    assert_eq!(reference(&hands), (5.0, 0.0, 0.0));
    hands.key(Modifiers::SHIFT, Key::K);
    assert!(hands.app().editor().document().drawing.reference.is_none());
}

#[test]
fn what_cannot_be_opened_is_said_on_the_start_page_too() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    let bytes = include_bytes!("../../../examples/ubc-fishing-vessel.sheet.json").to_vec();
    let path = "elsewhere.sheet.json".to_owned();
    hands.disk.lock().unwrap().to_open = Some(Opened { path, bytes });
    hands.click("Open…");
    hands.step();
    assert_eq!(hands.app().editor().page, Page::Start);
    assert!(hands.harness.query_by_label_contains("there is no table").is_some());
    assert!(hands.harness.query_by_label("Recent files").is_none());
}

#[test]
fn of_lines_that_lead_far_away_only_what_is_seen_is_drawn() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let corners = vec![Point2::new(0.0, 0.0), Point2::new(1e8, 1e8)];
    let editor = hands.harness.state_mut().editor_mut();
    editor.carry_out(Act::Edit(Edit::Corners { corners, closed: false }));
    let at = PointRef { curve: 0, point: 0 };
    editor.carry_out(Act::Move(vec![(at, Point3::new(0.0, 0.0, 1e8))]));
    editor.carry_out(Act::Rest);
    hands.settle();
    // As close as it goes, on the plan and in space.
    for pane in [hands.on_plan(0.0, 0.0), pos2(740.0, 300.0)] {
        hands.move_to(pane);
        for _ in 0..60 {
            hands.harness.event(Event::MouseWheel {
                unit: MouseWheelUnit::Point,
                delta: vec2(0.0, 400.0),
                source: MouseWheelSource::Unknown,
                phase: TouchPhase::Move,
                modifiers: Modifiers::NONE,
            });
            hands.step();
            assert!(hands.harness.output().shapes.len() < 20_000);
        }
    }
}
