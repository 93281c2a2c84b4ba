//! How bars and panes share windows of all sizes.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::accesskit::Role;
use eframe::egui::{Pos2, Rect, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use hands::{Hands, round};
use sheetwright_editor::command::Command;
use sheetwright_editor::document::{Document, Plan};
use sheetwright_editor::pages::start::CARD;
use sheetwright_editor::room::WindowPart;
use sheetwright_editor::views::SurfaceView;

/// Where a pane lies, if it is seen.
fn pane(hands: &Hands, begins: &str) -> Option<Rect> {
    let mut all = hands.harness.query_all_by_role(Role::Canvas);
    let named = |label: String| label.starts_with(begins);
    all.find(|node| node.accesskit_node().label().is_some_and(named)).map(|node| node.rect())
}

fn panes(hands: &Hands) -> [bool; 3] {
    ["Plan", "Space", "Flat pattern"].map(|name| pane(hands, name).is_some())
}

#[test]
fn where_there_is_no_room_for_all_one_part_is_seen_at_a_time() {
    for (size, has_side) in [(vec2(390.0, 844.0), false), (vec2(640.0, 400.0), true)] {
        let mut hands = Hands::new(size.into(), false);
        hands.run(Command::New);
        assert_eq!(panes(&hands), [true, false, false]);
        let middle = pane(&hands, "Plan").unwrap().center();
        hands.drag(&round(middle, vec2(120.0, 60.0), 90));
        hands.settle();
        let answer = |hands: &Hands| hands.harness.query_by_label("● Bends").is_some();
        assert_eq!(answer(&hands), has_side);
        hands.click("Space");
        assert_eq!(panes(&hands), [false, true, false]);
        hands.run(Command::Show(WindowPart::Pattern));
        assert_eq!(panes(&hands), [false, false, true]);
        // What is asked for is brought into sight.
        hands.run(Command::Draw);
        assert_eq!(panes(&hands), [true, false, false]);
        hands.run(Command::View(SurfaceView::Warp));
        assert_eq!(panes(&hands), [false, true, false]);
        hands.run(Command::Show(WindowPart::Answer));
        assert_eq!(panes(&hands), [false, has_side, false]);
        assert!(answer(&hands));
        assert_eq!(hands.app().editor().notice.is_some(), has_side);
    }
}

#[test]
fn what_is_begun_anew_is_drawn_on_a_plan_that_is_seen() {
    let mut hands = Hands::new([390.0, 844.0], false);
    for command in [Command::New, Command::AddCircle, Command::PlanOf(Plan::Front)] {
        hands.harness.state_mut().editor_mut().replace(Document::default(), None);
        hands.run(Command::Show(WindowPart::Pattern));
        assert_eq!(panes(&hands), [false, false, true]);
        hands.run(command);
        assert_eq!(panes(&hands), [true, false, false], "{command:?}");
    }
}

#[test]
fn a_hand_whose_pane_goes_away_lets_go() {
    let mut hands = Hands::new([390.0, 844.0], false);
    hands.run(Command::New);
    hands.run(Command::AddCircle);
    hands.run(Command::Select);
    hands.settle();
    let point = hands.app().editor().document().design.curves[0].points[0].at;
    let handle = hands.on_plan(point.x, point.y);
    hands.press(handle);
    for n in 1..=6 {
        hands.move_to(handle - vec2(6.0 * n as f32, 0.0));
    }
    assert!(hands.app().editor().history().is_dragging());
    let moved = hands.app().editor().document().design.curves[0].points[0].at;
    assert_ne!(moved, point);
    hands.run(Command::Show(WindowPart::Space));
    assert!(!hands.app().editor().history().is_dragging());
    hands.release(handle);
    hands.run(Command::Show(WindowPart::Plan));
    // The next press is one of its own.
    let elsewhere = handle - vec2(100.0, 200.0);
    hands.drag(&[elsewhere, elsewhere - vec2(30.0, 0.0)]);
    let after = hands.app().editor().document().design.curves[0].points[0].at;
    assert_eq!(after, moved);
}

#[test]
fn panes_keep_their_share_of_a_window_that_grows() {
    let mut hands = Hands::new([1280.0, 800.0], false);
    hands.run(Command::New);
    let share = |hands: &Hands| {
        let [plan, space, pattern] =
            ["Plan", "Space", "Flat pattern"].map(|name| pane(hands, name).unwrap());
        let title = pattern.top() - space.bottom();
        [
            plan.width() / (space.right() - plan.left()),
            (pattern.height() + title) / (plan.height() + title),
        ]
    };
    let small = share(&hands);
    // Somebody draws the line between plan and space to the left.
    let edge = pane(&hands, "Plan").unwrap().right_center();
    hands.drag(&[edge, edge - vec2(60.0, 0.0), edge - vec2(120.0, 0.0)]);
    hands.step();
    let drawn = share(&hands);
    assert!(drawn[0] < small[0] - 0.08, "{small:?} {drawn:?}");
    hands.harness.set_size(vec2(1920.0, 1200.0));
    for _ in 0..3 {
        hands.step();
    }
    let grown = share(&hands);
    for n in 0..2 {
        assert!((grown[n] - drawn[n]).abs() < 0.02, "{drawn:?} {grown:?}");
    }
    // Also after it was so narrow that the plan had to be larger.
    for width in [900.0, 905.0, 1920.0] {
        hands.harness.set_size(vec2(width, 1200.0));
        for _ in 0..3 {
            hands.step();
        }
    }
    let back = share(&hands);
    assert!((back[0] - drawn[0]).abs() < 0.02, "{drawn:?} {back:?}");
}

#[test]
fn pages_fit_into_every_window() {
    for size in [vec2(390.0, 844.0), vec2(640.0, 400.0), vec2(1280.0, 800.0)] {
        let mut hands = Hands::new(size.into(), false);
        hands.step();
        let room = Rect::from_min_size(Pos2::ZERO, size);
        let card = hands.harness.get_by_label("Dome in gores").rect();
        assert!(card.min.x >= 0.0 && card.max.x <= size.x && card.width() <= CARD.x, "{card}");
        hands.run(Command::AddCircle);
        hands.settle();
        for (command, title) in
            [(Command::Export, "Export"), (Command::Vary, "Make it bend"), (Command::Keys, "Keys")]
        {
            hands.run(command);
            for _ in 0..20 {
                hands.step();
            }
            let all = hands.harness.query_all_by_role(Role::Window);
            let window = all
                .into_iter()
                .find(|node| node.accesskit_node().label().is_some_and(|label| label == title));
            let rect = window.unwrap_or_else(|| panic!("no window {title}")).rect();
            assert!(room.contains_rect(rect), "{title}: {rect} in {room}");
            hands.run(Command::Escape);
        }
    }
}

#[test]
fn no_window_is_too_small_for_a_page() {
    for size in [vec2(1.0, 1.0), vec2(60.0, 60.0), vec2(60.0, 900.0), vec2(900.0, 60.0)] {
        let mut hands = Hands::new([800.0, 600.0], false);
        hands.run(Command::AddCircle);
        hands.settle();
        hands.harness.set_size(size);
        for command in Command::all() {
            hands.run(command);
            hands.step();
            hands.run(Command::Escape);
        }
        hands.run(Command::Start);
        hands.step();
    }
}
