//! Drawing on from what is there: points that are shared, neighbours, messages, and whose handles
//! are shown.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::{Modifiers, Pos2, Rect, Shape, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use hands::{Hands, picture};
use sheetwright::design::DesignCurve;
use sheetwright::math::{Point2, Point3};
use sheetwright_editor::command::Command;
use sheetwright_editor::document::{Document, Plan};
use sheetwright_editor::document::{Edit, PointRef, Selection};
use sheetwright_editor::scene::Act;
use sheetwright_editor::theme::HANDLE;

const SIZE: [f32; 2] = [1280.0, 800.0];

fn curves(hands: &Hands) -> &[DesignCurve] {
    &hands.app().editor().document().design.curves
}

/// Clicks corners one by one, places of the plan, and closes them.
fn click_corners(hands: &mut Hands, corners: &[[f64; 2]]) {
    hands.run(Command::Draw);
    for &[x, y] in corners {
        let at = hands.on_plan(x, y);
        hands.drag(&[at, at]);
        // Slower than a double click.
        hands.harness.run_steps(40);
    }
    hands.key(Modifiers::NONE, eframe::egui::Key::Enter);
    hands.settle();
}

fn move_point(hands: &mut Hands, curve: usize, point: usize, to: Point3) {
    let editor = hands.harness.state_mut().editor_mut();
    editor.carry_out(Act::Move(vec![(PointRef { curve, point }, to)]));
    editor.carry_out(Act::Rest);
    hands.settle();
}

/// A rectangle of which two corners are lifted.
fn lifted() -> Hands {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    click_corners(&mut hands, &[[-200.0, -80.0], [20.0, -80.0], [20.0, 90.0], [-200.0, 90.0]]);
    for (point, lift) in [(1, 120.0), (2, 70.0)] {
        let at = curves(&hands)[0].points[point].at;
        move_point(&mut hands, 0, point, Point3::new(at.x, at.y, lift));
    }
    hands
}

#[test]
fn a_rectangle_drawn_off_two_lifted_corners_is_a_neighbour_that_shares_them() {
    let mut hands = lifted();
    let [a, b] = [1, 2].map(|n| curves(&hands)[0].points[n].at);
    // The hand comes near them only, and goes the other way round.
    let near = |p: Point3| [p.x + 3.0, p.y - 2.0];
    click_corners(&mut hands, &[near(b), near(a), [220.0, -80.0], [220.0, 90.0]]);
    let editor = hands.app().editor();
    assert!(editor.notice.is_none(), "{:?}", editor.notice);
    assert_eq!(editor.document().design.panels.len(), 2);
    let drawn = &curves(&hands)[1].points;
    assert_eq!([drawn[0].at, drawn[1].at], [b, a]);
    assert_eq!([drawn[2].at.z, drawn[3].at.z], [0.0, 0.0]);
    for panel in editor.shown() {
        let shown = panel.made.as_ref().unwrap();
        let up = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|n| shown.positions[n as usize]);
            (b - a).cross(c - a).z > 0.0
        };
        assert!(shown.triangles.iter().all(up), "{} faces down", panel.name);
    }
    // From now on they move together.
    let to = Point3::new(a.x, a.y, 40.0);
    move_point(&mut hands, 0, 1, to);
    assert_eq!(curves(&hands)[1].points[1].at, to);
}

#[test]
fn a_stroke_from_a_handle_to_a_handle_shares_both() {
    let mut hands = lifted();
    let [a, b] = [1, 2].map(|n| curves(&hands)[0].points[n].at);
    hands.run(Command::Draw);
    let [from, to] = [a, b].map(|p| hands.on_plan(p.x, p.y));
    let way: Vec<Pos2> = (0..=40)
        .map(|n| {
            let t = n as f32 / 40.0;
            from.lerp(to, t) + vec2(90.0 * (std::f32::consts::PI * t).sin() + 4.0, 2.0)
        })
        .collect();
    hands.drag(&way);
    hands.settle();
    let drawn = &curves(&hands)[1];
    assert!(!drawn.closed, "{drawn:?}");
    assert_eq!([drawn.points[0].at, drawn.points.last().unwrap().at], [a, b]);
    // Round from a handle back to it: an outline with a point there.
    hands.run(Command::Undo);
    hands.run(Command::Draw);
    let way: Vec<Pos2> = (0..=60)
        .map(|n| {
            let t = std::f32::consts::TAU * n as f32 / 60.0;
            from + vec2(70.0 * (1.0 - t.cos()) + 2.0, 50.0 * t.sin())
        })
        .collect();
    hands.drag(&way);
    hands.settle();
    let drawn = &curves(&hands)[1];
    assert!(drawn.closed && drawn.points.iter().filter(|p| p.at == a).count() == 1, "{drawn:?}");
}

#[test]
fn a_handle_that_is_dragged_settles_on_another_in_space_and_picks_none_up() {
    let mut hands = lifted();
    click_corners(&mut hands, &[[60.0, -60.0], [220.0, -60.0], [220.0, 60.0], [60.0, 60.0]]);
    hands.run(Command::Select);
    let target = curves(&hands)[0].points[1].at;
    let own = curves(&hands)[1].points[0].at;
    let (from, to) = (hands.on_plan(own.x, own.y), hands.on_plan(target.x, target.y));
    let on_the_way = |hands: &mut Hands, from: Pos2, to: Pos2| {
        for n in 1..=10 {
            hands.move_to(from.lerp(to, n as f32 / 10.0));
        }
    };
    hands.press(from);
    on_the_way(&mut hands, from, to);
    assert_eq!(curves(&hands)[1].points[0].at, target);
    // On and away from there: what it lay on stays, and its own lift comes back.
    let beyond = to + vec2(60.0, 40.0);
    on_the_way(&mut hands, to, beyond);
    assert_eq!(curves(&hands)[0].points[1].at, target);
    assert_eq!(curves(&hands)[1].points[0].at.z, own.z);
    on_the_way(&mut hands, beyond, to);
    hands.release(to);
    assert_eq!(curves(&hands)[1].points[0].at, target);
    // Let go, both are one, and the hand can take them away from there.
    let away = to + vec2(0.0, 50.0);
    hands.press(to);
    on_the_way(&mut hands, to, away);
    hands.release(away);
    let [first, second] = [curves(&hands)[0].points[1].at, curves(&hands)[1].points[0].at];
    assert_eq!(first, second);
    assert!(first.y < target.y - 20.0 && first.z == target.z, "{first:?}");
}

#[test]
fn of_several_points_on_one_spot_of_the_plan_the_one_on_top_is_taken() {
    let mut hands = Hands::new(SIZE, false);
    let mut document = Document::default();
    document.drawing.plan = Plan::Front;
    let editor = hands.harness.state_mut().editor_mut();
    editor.replace(document, None);
    // A floor, seen along it: corners lie behind one another.
    let floor =
        [[0.0, 0.0], [100.0, 0.0], [100.0, 60.0], [0.0, 60.0]].map(|[x, y]| Point2::new(x, y));
    let corners = |corners: &[Point2]| Edit::Corners { corners: corners.to_vec(), closed: true };
    editor.carry_out(Act::Run(Command::PlanOf(Plan::Top)));
    editor.carry_out(Act::Edit(corners(&floor)));
    editor.carry_out(Act::Run(Command::PlanOf(Plan::Front)));
    let wall =
        [[0.0, 0.0], [100.0, 0.0], [100.0, 80.0], [0.0, 80.0]].map(|[x, y]| Point2::new(x, y));
    editor.carry_out(Act::Edit(corners(&wall)));
    assert!(editor.notice.is_none(), "{:?}", editor.notice);
    let design = &editor.document().design;
    let front = [0, 1].map(|n| design.curves[0].points[n].at);
    assert_eq!([design.curves[1].points[0].at, design.curves[1].points[1].at], front);
    assert_eq!(design.panels.len(), 2);
}

#[test]
fn a_figure_eight_is_told_one_thing_and_is_a_panel_once_it_crosses_no_more() {
    let mut hands = Hands::new(SIZE, false);
    hands.run(Command::New);
    let corners = [[-100.0, -60.0], [100.0, 60.0], [100.0, -60.0], [-100.0, 60.0]];
    let corners = corners.map(|[x, y]| Point2::new(x, y)).to_vec();
    let editor = hands.harness.state_mut().editor_mut();
    editor.carry_out(Act::Edit(Edit::Corners { corners, closed: true }));
    hands.settle();
    let said = hands.app().editor().notice.as_ref().unwrap().text.clone();
    assert!(said.starts_with("outline crosses itself on the plan"), "{said}");
    let has = |hands: &Hands, text: &str| hands.harness.query_all_by_label_contains(text).count();
    assert_eq!(has(&hands, "No outline is closed"), 0);
    assert!(has(&hands, &said) > 0);
    let steps = hands.app().editor().history().steps_back();
    let swapped = [1, 2].map(|n| curves(&hands)[0].points[n].at);
    let editor = hands.harness.state_mut().editor_mut();
    let to = |n: usize, to| (PointRef { curve: 0, point: n }, to);
    editor.carry_out(Act::Move(vec![to(1, swapped[1]), to(2, swapped[0])]));
    editor.carry_out(Act::Rest);
    hands.settle();
    let editor = hands.app().editor();
    assert_eq!((editor.document().design.panels.len(), editor.notice.is_some()), (1, false));
    assert_eq!(editor.history().steps_back(), steps + 1);
    assert_eq!(has(&hands, &said), 0);
}

/// The handles that are drawn: circles and squares in white with an edge.
fn handles_drawn(hands: &Hands, within: Rect) -> usize {
    let is_handle = |shape: &&eframe::egui::epaint::ClippedShape| match &shape.shape {
        Shape::Circle(c) => {
            c.stroke.width > 1.0 && c.radius <= HANDLE + 2.0 && within.contains(c.center)
        }
        Shape::Rect(r) => {
            let side = r.rect.width();
            r.stroke.width > 1.0
                && side == r.rect.height()
                && side <= 2.0 * (HANDLE + 2.0)
                && within.contains(r.rect.center())
        }
        _ => false,
    };
    hands.harness.output().shapes.iter().filter(is_handle).count()
}

fn pane(hands: &Hands, begins: &str) -> Rect {
    let all = hands.harness.query_all_by_role(eframe::egui::accesskit::Role::Canvas);
    let named = |label: String| label.starts_with(begins);
    all.into_iter().find(|n| n.accesskit_node().label().is_some_and(named)).unwrap().rect()
}

#[test]
fn of_many_handles_those_of_the_curve_under_the_hand_are_shown() {
    let mut hands = Hands::new(SIZE, false);
    let design = sheetwright::template::template("dome").unwrap().defaults().design().unwrap();
    let document = Document { design, ..Document::default() };
    hands.harness.state_mut().editor_mut().replace(document, None);
    hands.settle();
    hands.harness.run_steps(30);
    let all: usize = curves(&hands).iter().map(|curve| curve.points.len()).sum();
    assert!(all > 80, "{all}");
    hands.move_to(pane(&hands, "Flat pattern").center());
    hands.harness.run_steps(3);
    let panes = ["Plan", "Space"].map(|name| pane(&hands, name));
    for pane in panes {
        assert_eq!(handles_drawn(&hands, pane), 0);
    }
    // Every handle is there for the hand: one that it comes to shows those of its curve.
    let of = &curves(&hands)[2];
    let (count, middle) = (of.points.len(), of.points[of.points.len() / 2].at);
    let at = hands.on_plan(middle.x, middle.y);
    hands.move_to(at);
    hands.harness.run_steps(3);
    let shown = handles_drawn(&hands, panes[0]);
    assert!((count.min(3)..all / 2).contains(&shown), "{shown} of {count} of {all}");
    // A selected curve keeps them, in both panes.
    let selection = Selection { curve: Some(2), ..Selection::default() };
    hands.harness.state_mut().editor_mut().carry_out(Act::Select(selection));
    hands.move_to(pane(&hands, "Flat pattern").center());
    hands.harness.run_steps(3);
    for pane in panes {
        let shown = handles_drawn(&hands, pane);
        assert!((1..=count).contains(&shown), "{shown} of {count}");
    }
}

#[test]
fn panes_whose_view_is_not_the_hands_show_everything_when_the_window_shrinks() {
    let mut hands = lifted();
    let is_seen = |hands: &Hands| {
        let plan = pane(hands, "Plan");
        let space = pane(hands, "Space");
        let nodes = hands.harness.query_all_by_label_contains(", point ");
        let handles: Vec<Rect> = nodes.map(|node| node.rect()).collect();
        let inside = handles.iter().filter(|h| plan.contains_rect(**h) || space.contains_rect(**h));
        (inside.count(), handles.len())
    };
    hands.run(Command::Fit);
    hands.harness.run_steps(40);
    let shrink = |hands: &mut Hands, size: [f32; 2]| {
        hands.harness.set_size(size.into());
        hands.harness.run_steps(5);
    };
    for size in [[940.0, 600.0], [1500.0, 1000.0], [910.0, 580.0]] {
        shrink(&mut hands, size);
        let (inside, all) = is_seen(&hands);
        assert_eq!((inside, all), (8, 8), "{size:?}");
    }
    // Once the hand has zoomed, the view is its own.
    shrink(&mut hands, SIZE);
    let plan = pane(&hands, "Plan");
    hands.move_to(plan.center());
    hands.harness.event(eframe::egui::Event::MouseWheel {
        unit: eframe::egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 200.0),
        source: eframe::egui::MouseWheelSource::Unknown,
        phase: eframe::egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    hands.harness.run_steps(40);
    let apart = |hands: &Hands| hands.on_plan(100.0, 0.0).x - hands.on_plan(0.0, 0.0).x;
    let before = apart(&hands);
    shrink(&mut hands, [940.0, 600.0]);
    assert!((apart(&hands) - before).abs() < 1e-3);
}

#[test]
fn keys_move_and_lift_what_is_selected_on_the_plan() {
    let mut hands = lifted();
    let before = curves(&hands)[0].points[0].at;
    let at = hands.on_plan(before.x, before.y);
    hands.drag(&[at, at]);
    for key in [eframe::egui::Key::PageUp, eframe::egui::Key::ArrowRight] {
        hands.key(Modifiers::NONE, key);
        hands.settle();
    }
    let grid = hands.app().editor().document().drawing.grid_mm;
    let after = curves(&hands)[0].points[0].at;
    assert_eq!(after, Point3::new(before.x + grid, before.y, before.z + grid));
}

#[test]
fn a_picture_comes_in_as_wide_as_what_is_drawn() {
    let mut hands = lifted();
    let points = &curves(&hands)[0].points;
    let [least, most] =
        [f64::min, f64::max].map(|of| points.iter().map(|p| p.at.x).reduce(of).unwrap());
    hands.harness.state_mut().editor_mut().trace(picture("photo.png"));
    let reference = hands.app().editor().document().drawing.reference.clone().unwrap();
    assert!((200.0 * reference.mm_per_pixel - (most - least)).abs() < 1e-9);
    assert!((reference.centre.x - 0.5 * (least + most)).abs() < 1e-9);
}
