//! The bar at the side and the pages: the worst is seen first, fields stay where they are and what
//! they are, what is refused says why, and nothing behind a page is reached.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;
#[path = "side/meshes.rs"]
mod meshes;
#[path = "side/workshop.rs"]
mod workshop;

use eframe::egui::accesskit::Role;
use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, Rect, Shape, TouchPhase, vec2,
};
use egui_kittest::kittest::{NodeT, Queryable};
use hands::{Hands, picture};
use sheetwright::check::{Finding, Place, Verdict};
use sheetwright::design::{DesignPanel, FEWEST_ON_LOOP, SampleTolerance};
use sheetwright::material::Material;
use sheetwright::math::Point3;
use sheetwright_editor::command::Command;
use sheetwright_editor::document::{Document, Draft};
use sheetwright_editor::document::{Edit, PointRef, Selection};
use sheetwright_editor::editor::Page;
use sheetwright_editor::engine::shown::ShownPanel;
use sheetwright_editor::panes::plan::Tool;
use sheetwright_editor::scene::Act;
use sheetwright_files::{
    Drawing, Units, design_from_template, finding_place, finding_text, material_named,
};

const SIZE: [f32; 2] = [1280.0, 800.0];
/// So high that all fields are in sight.
const HIGH: [f32; 2] = [1280.0, 2000.0];

/// A window with what a template draws, in these units.
fn with_template(name: &str, units: Units) -> Hands {
    let mut hands = Hands::new(SIZE, false);
    let design = design_from_template(name, &[]).unwrap();
    let document = Document { design, drawing: Drawing::in_units(units) };
    hands.harness.state_mut().editor_mut().replace(document, None);
    hands.settle();
    hands
}

/// A circle with a selected handle.
fn with_handle() -> Hands {
    let mut hands = Hands::new(HIGH, false);
    hands.run(Command::New);
    hands.run(Command::AddCircle);
    hands.run(Command::Select);
    select(&mut hands, 0);
    hands.settle();
    hands
}

fn select(hands: &mut Hands, point: usize) {
    let selection = Selection::of_point(PointRef { curve: 0, point });
    hands.harness.state_mut().editor_mut().carry_out(Act::Select(selection));
    hands.step();
    hands.step();
}

fn point(hands: &Hands, n: usize) -> Point3 {
    hands.app().editor().document().design.curves[0].points[n].at
}

/// Opens the list that shows this.
fn open_list(hands: &mut Hands, shows: &str) {
    hands.harness.run_steps(30);
    let all = hands.harness.query_all_by_role(Role::ComboBox);
    let is_it = |value: Option<String>| value.is_some_and(|value| value == shows);
    let list = all.into_iter().find(|node| is_it(node.accesskit_node().value())).unwrap();
    let at = list.rect().center();
    hands.drag(&[at, at]);
    hands.step();
}

/// Where a field is, and what it holds.
fn field(hands: &Hands, label: &str) -> Option<(Rect, String)> {
    let mut all = hands.harness.query_all_by_label(label);
    let node = all.find(|node| node.accesskit_node().role() == Role::TextInput)?;
    Some((node.rect(), node.accesskit_node().value().unwrap_or_default()))
}

fn text(hands: &mut Hands, text: &str) {
    hands.harness.event(Event::Text(text.to_owned()));
    hands.step();
}

/// Clicks into a field and types, without Enter.
fn begin_to_type(hands: &mut Hands, label: &str, typed: &str) {
    hands.harness.run_steps(30);
    let at = field(hands, label).unwrap().0.center();
    hands.drag(&[at, at]);
    hands.step();
    text(hands, typed);
}

fn says(hands: &Hands, words: &str) -> bool {
    hands.harness.query_all_by_label_contains(words).next().is_some()
}

fn pane(hands: &Hands, name: &str) -> Rect {
    let all = hands.harness.query_all_by_role(Role::Canvas);
    let is_it = |label: Option<String>| label.is_some_and(|label| label.starts_with(name));
    let found = all.into_iter().find(|node| is_it(node.accesskit_node().label()));
    found.unwrap().rect()
}

fn wheel(hands: &mut Hands, at: Pos2, turns: usize) {
    hands.move_to(at);
    for _ in 0..turns {
        hands.harness.event(Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta: vec2(0.0, 300.0),
            source: MouseWheelSource::Unknown,
            phase: TouchPhase::Move,
            modifiers: Modifiers::NONE,
        });
        hands.step();
    }
    hands.harness.run_steps(20);
}

/// A hemisphere of 36 pieces, one of whose seams was dragged outwards at a handle.
fn dragged_hemisphere() -> Hands {
    let mut hands = with_template("hemisphere", Units::Millimetres);
    let curves = &hands.app().editor().document().design.curves;
    let curve = curves.iter().position(|curve| curve.name == "side-2-5").unwrap();
    // Its lower end, where four pieces meet.
    let at = curves[curve].points[0].at;
    let to = Point3::from_vec(at.to_vec() * 1.1);
    let editor = hands.harness.state_mut().editor_mut();
    editor.carry_out(Act::Move(vec![(PointRef { curve, point: 0 }, to)]));
    editor.carry_out(Act::Rest);
    hands.settle();
    hands
}

#[test]
fn what_will_not_bend_is_counted_stands_first_and_comes_into_sight() {
    let mut hands = dragged_hemisphere();
    let editor = hands.app().editor();
    let is_bad = |n: &usize| {
        editor.shown()[*n].made.as_ref().is_ok_and(|made| made.verdict == Verdict::WillNotBend)
    };
    let order = editor.worst_first();
    let bad = order.iter().filter(|n| is_bad(n)).count();
    assert!((1..=4).contains(&bad), "{bad}");
    assert!(order[..bad].iter().all(is_bad));
    let shown = editor.shown()[order[0]].made.as_ref().unwrap();
    let worst = Selection::of_rung(order[0], shown.worst_rung().unwrap());
    let ends = shown.rungs[worst.rung().unwrap().1].ends.map(|end| shown.positions[end as usize]);
    let name = editor.shown()[order[0]].name.clone();
    // Its card is in sight, and at the top.
    let card = hands.harness.get_by_label(&name).rect();
    let heading = hands.harness.get_by_label("Will it bend?").rect();
    assert!(card.top() > heading.top() && card.top() < heading.bottom() + 40.0, "{card} {heading}");
    // Somebody looks elsewhere.
    for name in ["Space", "Flat pattern"] {
        let rect = pane(&hands, name);
        wheel(&mut hands, rect.left_bottom() + vec2(6.0, -6.0), 12);
    }
    let is_seen = |hands: &Hands| {
        let rect = pane(hands, "Space");
        let camera = &hands.app().space().camera;
        let seen = ends.map(|p| camera.seen(p, rect));
        seen.iter().all(|seen| seen.is_some_and(|seen| rect.contains(seen.at)))
    };
    let is_cut_seen = |hands: &Hands| {
        let piece = hands.harness.get_by_label_contains(&format!("{name}, ")).rect();
        pane(hands, "Flat pattern").intersects(piece)
    };
    assert!(!is_seen(&hands) && !is_cut_seen(&hands));
    let many = if bad == 1 { "1 of 36 panels".to_owned() } else { format!("{bad} of 36 panels") };
    hands.click(&format!("■ {many} will not bend"));
    hands.harness.run_steps(40);
    assert_eq!(*hands.app().editor().selection(), worst);
    assert!(is_seen(&hands) && is_cut_seen(&hands));
}

#[test]
fn a_click_on_a_finding_selects_its_place_and_brings_it_into_sight() {
    let mut hands = dragged_hemisphere();
    let panel = hands.app().editor().worst_first()[0];
    let shown = hands.app().editor().shown()[panel].made.clone().unwrap();
    let is_placed = |finding: &&Finding| matches!(finding.place, Place::Rungs { .. });
    let finding = shown.findings.iter().find(is_placed).unwrap();
    for name in ["Space", "Flat pattern"] {
        let rect = pane(&hands, name);
        wheel(&mut hands, rect.left_bottom() + vec2(6.0, -6.0), 12);
    }
    let label = format!("{} ({})", finding_text(finding), finding_place(finding));
    hands.harness.get_by_label(&label).scroll_to_me();
    hands.harness.run_steps(40);
    hands.click(&label);
    hands.harness.run_steps(40);
    let selected = hands.app().editor().selection().clone();
    assert_eq!(selected, Selection::of_place(panel, finding.place.clone()));
    let Place::Rungs { numbers } = &finding.place else { panic!("{finding:?}") };
    let ends = numbers.iter().flat_map(|&n| shown.rungs[n].ends);
    let (rect, camera) = (pane(&hands, "Space"), &hands.app().space().camera);
    for p in ends.map(|end| shown.positions[end as usize]) {
        assert!(camera.seen(p, rect).is_some_and(|seen| rect.contains(seen.at)));
    }
}

#[test]
fn fields_stay_where_they_are_while_the_verdict_grows() {
    let mut hands = with_handle();
    let labels = ["Lift (z)", "Name of curve", "Name of panel", "Grid"];
    let places = |hands: &Hands| labels.map(|label| field(hands, label).unwrap().0);
    let before = places(&hands);
    let is_same = |now: &[Rect; 4]| {
        now.iter().zip(&before).all(|(now, before)| now.min.distance(before.min) < 1.0)
    };
    let cards = |hands: &Hands| {
        let verdicts = &hands.app().editor().shown()[0].made;
        verdicts.as_ref().map(|made| made.findings.len()).ok()
    };
    let findings = cards(&hands);
    for (point, lift) in [(0, "90"), (2, "-90"), (4, "90"), (6, "-90")] {
        select(&mut hands, point);
        hands.type_into("Lift (z)", lift);
        hands.settle();
        assert!(is_same(&places(&hands)));
    }
    assert!(cards(&hands) > findings, "{findings:?}");
    // Also while it can't be made at all.
    let to = point(&hands, 1);
    select(&mut hands, 0);
    for (label, to) in [("x", to.x), ("y", to.y), ("Lift (z)", to.z)] {
        hands.type_into(label, &to.to_string());
    }
    hands.settle();
    assert_eq!(cards(&hands), None);
    assert!(is_same(&places(&hands)));
}

#[test]
fn what_is_typed_goes_to_what_it_was_typed_for() {
    let mut hands = with_handle();
    begin_to_type(&mut hands, "Lift (z)", "40");
    // The hand takes hold of another handle.
    let other = point(&hands, 4);
    let from = hands.on_plan(other.x, other.y);
    hands.drag(&[from, from + vec2(3.0, 0.0), from + vec2(9.0, 0.0), from + vec2(20.0, 0.0)]);
    hands.settle();
    assert_eq!(point(&hands, 0).z, 40.0);
    assert_eq!(point(&hands, 4).z, 0.0);
    assert!(point(&hands, 4).x != other.x);
    // What is selected meanwhile gets nothing of it.
    begin_to_type(&mut hands, "Lift (z)", "77");
    select(&mut hands, 6);
    hands.key(Modifiers::NONE, Key::Enter);
    hands.settle();
    assert_eq!(field(&hands, "Lift (z)").unwrap().1, "0 mm");
    assert!((0..8).all(|n| point(&hands, n).z != 77.0));
    // Nor what was left with it: it is gone when it is shown again.
    select(&mut hands, 4);
    assert_eq!(field(&hands, "Lift (z)").unwrap().1, "0 mm");
}

#[test]
fn a_refused_number_says_why_and_stays_until_it_is_right_or_esc() {
    let mut hands = with_handle();
    for (typed, why) in [
        ("4 kg", "‘kg’ is not a unit of length"),
        ("1,250", "‘1,250’ can mean 1250 or 1.250"),
        ("-1e9", "-1000 km is out of range. It takes -100 km to 100 km."),
        ("4 +", "A number is missing at the end."),
    ] {
        hands.type_into("Lift (z)", typed);
        hands.step();
        assert!(says(&hands, why), "{typed}");
        assert_eq!(field(&hands, "Lift (z)").unwrap().1, typed);
        assert_eq!(point(&hands, 0).z, 0.0);
        // Leaving it drops neither.
        hands.key(Modifiers::NONE, Key::Tab);
        assert!(says(&hands, why), "{typed}");
        begin_to_type(&mut hands, "Lift (z)", "x");
        hands.key(Modifiers::NONE, Key::Escape);
        hands.step();
        assert!(!says(&hands, why), "{typed}");
        assert_eq!(field(&hands, "Lift (z)").unwrap().1, "0 mm");
        assert_eq!(hands.app().editor().selection().points.len(), 1, "Esc is the field's");
    }
    for (typed, z) in [("12,5", 12.5), ("200+50", 250.0), ("1' - 2in", 254.0), ("-1e8", -1e8)] {
        hands.type_into("Lift (z)", typed);
        hands.settle();
        assert_eq!(point(&hands, 0).z, z, "{typed}");
    }
    // What was accepted is refused nowhere else.
    assert!(!says(&hands, "not a number within"));
    hands.type_into("Grid", "0");
    assert!(says(&hands, "0 mm is out of range."));
    let design = &hands.app().editor().document().design;
    let to = Box::new(DesignPanel { tolerance: None, ..design.panels[0].clone() });
    let act = Act::Edit(Edit::SetPanel { panel: 0, to });
    hands.harness.state_mut().editor_mut().carry_out(act);
    hands.settle();
    hands.type_into("Samples", "12.5");
    assert!(says(&hands, "12.5 is not a whole number."));
}

#[test]
fn a_tolerance_of_samples_is_typed_and_what_it_comes_to_is_said() {
    let mut hands = with_handle();
    let panel = |hands: &Hands| hands.app().editor().document().design.panels[0].clone();
    let count =
        |hands: &Hands| hands.app().editor().shown()[0].made.as_ref().unwrap().positions.len();
    // What is drawn has the usual ones.
    assert_eq!(panel(&hands).tolerance, Some(SampleTolerance::USUAL));
    assert!(field(&hands, "Samples").is_none() && says(&hands, "400 samples in all"));
    let to = Box::new(panel(&hands).within_mm(0.5));
    let act = Act::Edit(Edit::SetPanel { panel: 0, to });
    hands.harness.state_mut().editor_mut().carry_out(act);
    hands.settle();
    assert_eq!((panel(&hands).samples, count(&hands)), (FEWEST_ON_LOOP, FEWEST_ON_LOOP));
    hands.type_into("Tolerance", "0.01");
    hands.settle();
    assert_eq!(panel(&hands).tolerance, Some(SampleTolerance::Mm(0.01)));
    // A circle of 200 mm: π³ 200 / 6 n² is shorter by that.
    assert!((315..330).contains(&count(&hands)), "{}", count(&hands));
    assert!(says(&hands, &format!("{} samples in all", count(&hands))));
    hands.type_into("Tolerance", "0");
    assert!(says(&hands, "0 mm is out of range."));
}

#[test]
fn numbers_of_templates_are_refused_in_words_too() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    hands.click("Lampshade");
    hands.harness.run_steps(3);
    hands.type_into("Diameter of the lower ring", "5m");
    hands.step();
    assert!(says(&hands, "5000 mm is out of range. It takes "));
    assert_eq!(field(&hands, "Diameter of the lower ring").unwrap().1, "5m");
    hands.key(Modifiers::COMMAND, Key::A);
    text(&mut hands, "250,5mm + 1cm");
    hands.key(Modifiers::NONE, Key::Enter);
    assert!(!says(&hands, "out of range"));
    assert_eq!(field(&hands, "Diameter of the lower ring").unwrap().1, "260.5 mm");
    // Esc drops what is typed, and leaves no page.
    begin_to_type(&mut hands, "Diameter of the lower ring", "77");
    hands.key(Modifiers::NONE, Key::Escape);
    assert_eq!(hands.app().editor().page, Page::Start);
    assert_eq!(field(&hands, "Diameter of the lower ring").unwrap().1, "260.5 mm");
}

#[test]
fn a_template_is_not_made_while_a_refused_number_stands_in_red() {
    let mut hands = Hands::new(SIZE, false);
    hands.step();
    hands.click("Lampshade");
    hands.type_into("Diameter of the lower ring", "9km");
    assert!(says(&hands, "First correct the diameter of the lower ring"));
    // Esc drops it, and what is typed but not yet taken is refused when the button is pressed.
    hands.key(Modifiers::NONE, Key::Escape);
    assert!(!says(&hands, "First correct"));
    begin_to_type(&mut hands, "Diameter of the lower ring", "9km");
    let button = hands.harness.get_by_label("Make it").rect().center();
    hands.drag(&[button, button]);
    assert_eq!(hands.app().editor().page, Page::Start);
    assert!(says(&hands, "First correct"));
    hands.click("Make it");
    assert_eq!(hands.app().editor().page, Page::Start);
    hands.type_into("Diameter of the lower ring", "30cm");
    hands.click("Make it");
    assert_eq!(hands.app().editor().page, Page::Panes);
}

#[test]
fn esc_closes_menus_and_lists_first() {
    let mut hands = with_handle();
    let kept = hands.app().editor().selection().clone();
    hands.click("Edit");
    assert!(says(&hands, "Corner or smooth"));
    hands.key(Modifiers::NONE, Key::Escape);
    hands.step();
    assert!(!says(&hands, "Corner or smooth"));
    assert_eq!(*hands.app().editor().selection(), kept);
    open_list(&mut hands, "Not named");
    assert!(says(&hands, "aluminium 5754, 1 mm"));
    hands.key(Modifiers::NONE, Key::D);
    assert_eq!(hands.app().editor().tool, Tool::Select);
    hands.key(Modifiers::NONE, Key::Escape);
    hands.step();
    assert!(!says(&hands, "aluminium 5754, 1 mm"));
    assert_eq!(*hands.app().editor().selection(), kept);
    hands.key(Modifiers::NONE, Key::Escape);
    assert!(hands.app().editor().selection().is_empty());
}

#[test]
fn materials_of_the_design_are_listed_before_those_of_the_catalogue_and_kept() {
    let mut hands = with_template("cone", Units::Millimetres);
    let mut document = hands.app().editor().document().clone();
    let paper = material_named("paper", &[]).unwrap();
    let mine = Material { name: "mine".to_owned(), title: "paper of mine".to_owned(), ..paper };
    document.design.materials = vec![mine.clone()];
    hands.harness.state_mut().editor_mut().replace(document, None);
    hands.settle();
    open_list(&mut hands, "Not named");
    let top = |label| hands.harness.query_all_by_label(label).last().unwrap().rect().top();
    assert!(top("paper of mine") < top("aluminium 5754, 1 mm"));
    hands.click("paper of mine");
    hands.settle();
    let chosen = |hands: &Hands| hands.app().editor().document().design.material.clone();
    assert_eq!(chosen(&hands), Some(mine.clone()));
    open_list(&mut hands, "paper of mine");
    hands.click("aluminium 5754, 1 mm");
    hands.settle();
    assert_eq!(chosen(&hands), material_named("aluminium-1mm", &[]));
    hands.run(Command::Undo);
    assert_eq!(chosen(&hands), Some(mine));
    // What is kept of work that is not saved.
    let document = hands.app().editor().document().clone();
    let draft = Draft { document, file: None };
    assert_eq!(Draft::read(&draft.bytes()).as_ref(), Ok(&draft));
}

#[test]
fn nothing_behind_a_page_is_reached() {
    let mut hands = with_handle();
    let before = hands.app().editor().document().clone();
    let handle = hands.on_plan(point(&hands, 0).x, point(&hands, 0).y);
    let draw = hands.harness.get_by_label("Draw").rect().center();
    // The handle has the keys.
    hands.drag(&[handle, handle]);
    let pages = [
        (Command::Vary, Page::Vary),
        (Command::Export, Page::Export),
        (Command::Keys, Page::Keys),
        (Command::Palette, Page::Palette),
    ];
    for (command, page) in pages {
        let kept = hands.app().editor().selection().clone();
        hands.run(command);
        hands.harness.run_steps(10);
        for key in [Key::ArrowRight, Key::PageUp, Key::D, Key::C, Key::Delete, Key::M, Key::G] {
            hands.key(Modifiers::NONE, key);
        }
        assert_eq!(hands.app().editor().page, page);
        hands.key(Modifiers::COMMAND, Key::Z);
        assert_eq!(*hands.app().editor().document(), before, "{page:?}");
        assert_eq!(hands.app().editor().tool, Tool::Select);
        if page != Page::Palette {
            let beside = pane(&hands, "Plan").left_top() + vec2(30.0, 30.0);
            for from in [handle, beside] {
                hands.drag(&[from, from + vec2(0.0, 12.0), from + vec2(0.0, 40.0)]);
                hands.drag(&[from, from]);
            }
            hands.drag(&[draw, draw]);
            assert_eq!(hands.app().editor().page, page);
        }
        assert_eq!(*hands.app().editor().document(), before, "{page:?}");
        assert_eq!(*hands.app().editor().selection(), kept, "{page:?}");
        assert_eq!(hands.app().editor().tool, Tool::Select, "{page:?}");
        hands.key(Modifiers::NONE, Key::Escape);
        hands.harness.run_steps(10);
        assert_eq!(hands.app().editor().page, Page::Panes);
    }
}

#[test]
fn the_start_page_hides_a_drawing_from_keys() {
    let mut hands = with_handle();
    let before = hands.app().editor().document().clone();
    hands.run(Command::Start);
    for key in [Key::Delete, Key::C, Key::M, Key::G, Key::B, Key::N] {
        hands.key(Modifiers::NONE, key);
    }
    hands.key(Modifiers::COMMAND, Key::Z);
    assert_eq!(*hands.app().editor().document(), before);
}

#[test]
fn the_scale_of_a_picture_is_typed_at_once() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    hands.disk.lock().unwrap().to_open = Some(picture("photo.png"));
    hands.run(Command::AddReference);
    hands.step();
    hands.run(Command::CalibrateReference);
    for x in [-200.0, 200.0] {
        hands.harness.run_steps(30);
        let at = hands.on_plan(x, 0.0);
        hands.drag(&[at, at]);
    }
    hands.harness.run_steps(3);
    assert_eq!(hands.app().editor().page, Page::Calibrate);
    for (key, typed) in [(Key::Num2, "2"), (Key::F, "f"), (Key::T, "t")] {
        hands.harness.event(Event::Text(typed.to_owned()));
        hands.key(Modifiers::NONE, key);
    }
    assert_eq!(field(&hands, "Distance").unwrap().1, "2ft");
    assert_eq!(hands.app().editor().view, sheetwright_editor::views::SurfaceView::default());
    hands.key(Modifiers::NONE, Key::Enter);
    let drawing = &hands.app().editor().document().drawing;
    let picture = drawing.reference.as_ref().unwrap();
    assert!((picture.mm_per_pixel - 5.0 * 609.6 / 400.0).abs() < 0.05, "{}", picture.mm_per_pixel);
    assert_eq!(hands.app().editor().page, Page::Panes);
}

#[test]
fn make_it_bend_has_the_numbers_of_the_cards_and_the_units_of_the_design() {
    let mut hands = Hands::new(SIZE, false);
    let hull = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/ubc-fishing-vessel.sheet.json");
    let app = hands.harness.state_mut();
    app.open_path(hull);
    let mut document = app.editor().document().clone();
    document.design.panels.iter_mut().for_each(|panel| panel.samples = 60);
    document.drawing = Drawing::in_units(Units::Feet);
    app.editor_mut().replace(document, None);
    hands.settle();
    let twists = |hands: &Hands| {
        let shown = hands.app().editor().shown().iter();
        shown.map(|panel| panel.made.as_ref().unwrap().twist().deg).collect::<Vec<f64>>()
    };
    let largest = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
    let was = twists(&hands);
    for (panel, deg) in hands.app().editor().shown().iter().zip(&was) {
        assert!(says(&hands, &format!("Largest twist {deg:.1}°")), "{}", panel.name);
    }
    hands.run(Command::Vary);
    hands.harness.run_steps(3);
    assert_eq!(field(&hands, "Distance").unwrap().1, "0.04 ft");
    hands.click("Until it twists no more than an angle");
    let takes = hands.app().editor().shown()[0].made.as_ref().unwrap().warp_limit_deg;
    assert_eq!(field(&hands, "Largest twist").unwrap().1, format!("{takes}°"));
    hands.click("As little twist as these limits allow");
    hands.click("Try it");
    hands.settle();
    hands.step();
    for deg in &was {
        assert!(says(&hands, &format!(", {deg:.1}°")), "{deg}");
    }
    let from = format!("The largest twist goes from {:.1}° to ", largest(&was));
    let said = hands.harness.get_by_label_contains(&from).accesskit_node().value().unwrap();
    assert!(said.contains(" ft. ") && !said.contains(" mm"), "{said}");
    hands.click("Accept");
    hands.settle();
    let now = largest(&twists(&hands));
    assert!(said.contains(&format!(" to {now:.1}°;")), "{said}: {now}");
}

#[test]
fn a_grid_is_round_in_the_units_of_the_design() {
    let mut hands = with_handle();
    assert_eq!(field(&hands, "Grid").unwrap().1, "50 mm");
    let choose = |hands: &mut Hands, units: &str| {
        let now = hands.app().editor().document().drawing.units.name();
        open_list(hands, now);
        hands.click(units);
        hands.step();
    };
    choose(&mut hands, "ft");
    assert_eq!(field(&hands, "Grid").unwrap().1, "2 in");
    hands.type_into("Grid", "1/8in");
    assert_eq!(field(&hands, "Grid").unwrap().1, "1/8 in");
    choose(&mut hands, "cm");
    assert_eq!(field(&hands, "Grid").unwrap().1, "0.5 cm");
    // What somebody chose for itself stays.
    hands.type_into("Grid", "37mm");
    choose(&mut hands, "in");
    let grid_mm = hands.app().editor().document().drawing.grid_mm;
    assert_eq!(grid_mm, 37.0);
}

/// The bars of what scrolls, none of which lies over anything that can be pressed or typed into.
fn scroll_bars(hands: &Hands) -> Vec<Rect> {
    let all = |role| {
        let nodes = hands.harness.query_all_by_role(role);
        // Handles on the plan may lie behind a menu.
        let is_handle = |label: Option<String>| label.is_some_and(|it| it.contains(", point "));
        nodes.filter(move |node| !is_handle(node.accesskit_node().label())).map(|node| node.rect())
    };
    let bars: Vec<Rect> = all(Role::ScrollBar).collect();
    for of in [Role::TextInput, Role::Button, Role::CheckBox].into_iter().flat_map(all) {
        let covered = bars.iter().find(|bar| bar.shrink(0.5).intersects(of));
        assert_eq!(covered, None, "{of} is under a scroll bar");
    }
    bars
}

/// Whether something opaque enough is drawn in this part of the window alone.
fn is_drawn(hands: &Hands, part: Rect) -> bool {
    hands.harness.output().shapes.iter().any(|clipped| match &clipped.shape {
        Shape::Rect(shape) => part.contains_rect(shape.rect) && shape.fill.a() > 60,
        _ => false,
    })
}

#[test]
fn what_scrolls_has_a_bar_that_covers_nothing() {
    let mut hands = with_handle();
    assert!(scroll_bars(&hands).is_empty());
    hands.harness.set_size(vec2(1280.0, 560.0));
    hands.harness.run_steps(10);
    let bars = scroll_bars(&hands);
    assert!(!bars.is_empty() && bars.iter().all(|bar| is_drawn(&hands, *bar)), "{bars:?}");
    for menu in ["Edit", "View"] {
        hands.click(menu);
        hands.harness.run_steps(10);
        let with_menu = scroll_bars(&hands);
        assert!(with_menu.len() > bars.len(), "{menu} is longer than the window");
        assert!(with_menu.iter().all(|bar| is_drawn(&hands, *bar)), "{menu} {with_menu:?}");
        hands.key(Modifiers::NONE, Key::Escape);
        hands.harness.run_steps(10);
    }
}

#[test]
fn numbers_on_cards_are_short_in_every_unit() {
    let hands = with_template("cone", Units::Feet);
    let said = |words: &str| {
        let node = hands.harness.get_by_label_contains(words);
        node.accesskit_node().value().unwrap_or_default()
    };
    let decimals = |text: &str| {
        let numbers = text.split(' ').filter_map(|word| word.split_once('.'));
        numbers.map(|(_, decimals)| decimals.len()).max().unwrap_or(0)
    };
    let size = said("Pattern: ");
    assert!(size.ends_with(" ft") && decimals(&size) <= 3, "{size}");
    let radius = said("Tightest bend");
    assert!(radius.ends_with(" in radius") && decimals(&radius) <= 2, "{radius}");
}

#[test]
fn no_angle_is_less_than_nothing_by_nothing() {
    let mut hands = with_template("bag", Units::Millimetres);
    let all: Vec<usize> = hands.app().editor().shown().iter().map(rungs).collect();
    for (panel, count) in all.into_iter().enumerate() {
        for rung in (0..count).step_by(7) {
            let act = Act::Select(Selection::of_rung(panel, rung));
            hands.harness.state_mut().editor_mut().carry_out(act);
            hands.step();
            hands.step();
            assert!(says(&hands, "Bend ") && !says(&hands, "Bend -"), "{panel} {rung}");
        }
    }
}

fn rungs(panel: &ShownPanel) -> usize {
    panel.made.as_ref().map_or(0, |shown| shown.rungs.len())
}
