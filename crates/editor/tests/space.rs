//! The pane of space: what the hand and the keys do to views and handles, and what a screen reader
//! says.

#![allow(clippy::print_stdout)] // the time of a frame, for whoever asks

mod panes;

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use panes::{Pane, Window, example, template};
use sheetwright::design::Design;
use sheetwright_editor::document::{PointRef, Selection};
use sheetwright_editor::panes::space::SpacePane;
use sheetwright_editor::scene::Act;
use sheetwright_editor::views::SurfaceView;

const SIZE: eframe::egui::Vec2 = vec2(640.0, 700.0);

fn window(design: Design) -> Harness<'static, Window> {
    let harness = Harness::builder().with_size(SIZE).with_max_steps(60);
    harness.build_eframe(|cc| {
        let pane = SpacePane::new(cc);
        Window::new(Pane::Space(Box::new(pane)), design)
    })
}

fn press(harness: &mut Harness<'_, Window>, at: Pos2, button: PointerButton, pressed: bool) {
    let modifiers = Modifiers::NONE;
    harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
    harness.step();
}

fn drag(harness: &mut Harness<'_, Window>, from: Pos2, to: Pos2, button: PointerButton) {
    harness.hover_at(from);
    harness.step();
    press(harness, from, button, true);
    for k in 1..=8 {
        harness.hover_at(from.lerp(to, k as f32 / 8.0));
        harness.step();
    }
    press(harness, to, button, false);
    harness.step();
}

/// A place of the pane on which nothing is.
const EMPTY: Pos2 = pos2(30.0, 640.0);

/// A handle that no other one is near on the screen, but those on the same spot of space.
fn apart(harness: &Harness<'_, Window>) -> (PointRef, Pos2) {
    let curves = &harness.state().document.design.curves;
    let all: Vec<_> = (0..curves.len())
        .flat_map(|curve| (0..curves[curve].points.len()).map(move |point| (curve, point)))
        .map(|(curve, point)| {
            let name = format!("{}, point {}, ", curves[curve].name, point + 1);
            let at = harness.get_by_label_contains(&name).rect().center();
            (PointRef { curve, point }, at, curves[curve].points[point].at)
        })
        .collect();
    let lonely = |a: &&(PointRef, Pos2, sheetwright::math::Point3)| {
        all.iter().all(|b| b.2 == a.2 || b.1.distance(a.1) > 25.0)
    };
    let found = all.iter().find(lonely).map(|&(of, at, _)| (of, at));
    found.unwrap_or((all[0].0, all[0].1))
}

#[test]
fn a_handle_moves_along_the_normal_only() {
    let mut harness = window(template("dinghy"));
    harness.run();
    let before = harness.state().document.clone();
    let (of, handle) = apart(&harness);
    drag(&mut harness, handle, handle - vec2(0.0, 60.0), PointerButton::Primary);
    let state = harness.state();
    let Some(Act::Select(selection)) = state.acts.first() else { panic!("{:?}", state.acts) };
    assert_eq!(selection.points.len(), 1);
    let place = |of: PointRef| before.design.curves[of.curve].points[of.point].at;
    // The one that was taken hold of lies on the spot of the one that was meant.
    let grabbed = place(of);
    assert_eq!(place(selection.points[0]), grabbed);
    assert_eq!(state.acts.last(), Some(&Act::Rest));
    let moves = state.acts.iter().filter(|act| matches!(act, Act::Move(_))).count();
    assert!(moves >= 3, "{moves} moves");
    let after = &state.document.design.curves;
    for (n, (old, new)) in before.design.curves.iter().zip(after).enumerate() {
        for (k, (a, b)) in old.points.iter().zip(&new.points).enumerate() {
            assert_eq!((a.at.x, a.at.y), (b.at.x, b.at.y), "curve {n}, point {k} left its place");
            let lifted = b.at.z - a.at.z;
            assert_eq!(lifted > 0.0, a.at == grabbed, "curve {n}, point {k} by {lifted} mm");
        }
    }
}

#[test]
fn selected_points_are_lifted_together_and_settle_on_the_plan() {
    let mut harness = window(template("dinghy"));
    harness.run();
    let points: Vec<PointRef> = (0..3).map(|point| PointRef { curve: 0, point }).collect();
    harness.state_mut().selection =
        Selection { points: points.clone(), curve: Some(0), ..Selection::default() };
    harness.run();
    let before = harness.state().document.design.curves[0].clone();
    let name = format!("{}, point 2,", before.name);
    let from = harness.get_by_label_contains(&name).rect().center();
    drag(&mut harness, from, from + vec2(0.0, 30.0), PointerButton::Primary);
    let after = &harness.state().document.design.curves[0];
    let by: Vec<f64> =
        before.points.iter().zip(&after.points).map(|(a, b)| b.at.z - a.at.z).collect();
    assert!(by[0] < 0.0 && by[0] == by[1] || (by[0] - by[1]).abs() < 1e-9, "{by:?}");
    assert!((by[1] - by[2]).abs() < 1e-9 && by[3..].iter().all(|&b| b == 0.0), "{by:?}");
}

#[test]
fn a_lift_settles_on_the_plan_unless_alt_is_held() {
    for alt in [false, true] {
        let mut harness = window(template("dinghy"));
        harness.run();
        let (of, from) = apart(&harness);
        let camera = harness.state_mut().space().camera;
        let place = |h: &Harness<'_, Window>| {
            h.state().document.design.curves[of.curve].points[of.point].at
        };
        let start = place(&harness);
        assert!(start.z > 1.0, "{start:?} is on the plan already");
        // Where the point would be seen a little above the plan.
        let rect = eframe::egui::Rect::from_min_size(Pos2::ZERO, SIZE);
        let foot = sheetwright::math::Point3::new(start.x, start.y, 0.0);
        let to = camera.seen(foot, rect).unwrap().at - vec2(0.0, 3.0);
        let modifiers = Modifiers { alt, ..Modifiers::NONE };
        harness.hover_at(from);
        harness.step();
        press(&mut harness, from, PointerButton::Primary, true);
        harness.event(Event::ModifiersChanged(modifiers));
        for k in 1..=10 {
            let at = from.lerp(to, k as f32 / 10.0);
            harness.event(Event::PointerMoved(at));
            harness.step();
        }
        let lift = place(&harness).z;
        press(&mut harness, to, PointerButton::Primary, false);
        assert_eq!(lift == 0.0, !alt, "lifted {lift} mm");
        assert!(lift.abs() < 30.0, "lifted {lift} mm");
    }
}

#[test]
fn the_wheel_zooms_to_the_cursor() {
    let mut harness = window(template("cone"));
    harness.run();
    let rect = eframe::egui::Rect::from_min_size(Pos2::ZERO, SIZE);
    let at = pos2(200.0, 500.0);
    harness.hover_at(at);
    harness.step();
    let before = harness.state_mut().space().camera;
    let under = before.under(at, rect);
    harness.event(Event::MouseWheel {
        unit: eframe::egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 120.0),
        phase: eframe::egui::TouchPhase::Move,
        source: eframe::egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    harness.run();
    let after = harness.state_mut().space().camera;
    assert!(after.height_mm < 0.9 * before.height_mm, "{}", after.height_mm);
    assert!(after.seen(under, rect).unwrap().at.distance(at) < 0.1);
}

#[test]
fn two_fingers_pinch() {
    use eframe::egui::{TouchDeviceId, TouchId, TouchPhase};
    let mut harness = window(template("cone"));
    harness.run();
    let before = harness.state_mut().space().camera;
    let touch = |harness: &mut Harness<'_, Window>, phase, apart: f32| {
        for (id, side) in [(1, -1.0), (2, 1.0)] {
            let pos = pos2(320.0 + side * apart, 400.0);
            let (device_id, id) = (TouchDeviceId(0), TouchId(id));
            harness.event(Event::Touch { device_id, id, phase, pos, force: None });
        }
        harness.step();
    };
    // The first finger moves the pointer too.
    harness.hover_at(pos2(270.0, 400.0));
    touch(&mut harness, TouchPhase::Start, 50.0);
    for k in 0..10 {
        touch(&mut harness, TouchPhase::Move, 50.0 + 5.0 * k as f32);
    }
    touch(&mut harness, TouchPhase::End, 95.0);
    let after = harness.state_mut().space().camera;
    let factor = before.height_mm / after.height_mm;
    assert!((factor - 95.0 / 50.0).abs() < 0.25, "larger by {factor}");
    assert_eq!(after.direction, before.direction);
}

#[test]
fn keys_lift_what_is_selected() {
    let mut harness = window(template("cone"));
    harness.run();
    let of = PointRef { curve: 0, point: 0 };
    harness.state_mut().selection = Selection::of_point(of);
    harness.get_by_label("Space").focus();
    harness.run();
    let lift = |h: &Harness<'_, Window>| h.state().document.design.curves[0].points[0].at.z;
    let before = lift(&harness);
    harness.key_press(Key::PageUp);
    harness.run();
    assert!((lift(&harness) - before - 50.0).abs() < 1e-9);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::PageDown);
    harness.run();
    assert!((lift(&harness) - before - 45.0).abs() < 1e-9);
    assert_eq!(harness.state().acts.iter().filter(|act| **act == Act::Rest).count(), 2);
}

#[test]
fn the_view_turns_shifts_and_zooms() {
    let mut harness = window(template("cone"));
    harness.run();
    let camera = harness.state_mut().space().camera;
    drag(&mut harness, EMPTY, EMPTY + vec2(80.0, -20.0), PointerButton::Secondary);
    let turned = harness.state_mut().space().camera;
    assert_ne!(turned.direction, camera.direction);
    assert_eq!(turned.target, camera.target);
    drag(&mut harness, EMPTY, EMPTY + vec2(80.0, -20.0), PointerButton::Middle);
    let shifted = harness.state_mut().space().camera;
    assert_eq!(shifted.direction, turned.direction);
    assert_ne!(shifted.target, turned.target);
    harness.get_by_label("Space").focus();
    harness.run();
    harness.key_press(Key::Plus);
    harness.run();
    let closer = harness.state_mut().space().camera;
    assert!((closer.height_mm * 1.25 - shifted.height_mm).abs() < 1e-6);
    harness.key_press(Key::ArrowLeft);
    harness.run();
    assert_ne!(harness.state_mut().space().camera.direction, closer.direction);
    harness.state_mut().space().fit();
    harness.run();
    assert!(harness.state_mut().space().camera.target.distance(camera.target) < 60.0);
}

#[test]
fn faces_of_the_cube_are_views() {
    let mut harness = window(template("cone"));
    harness.run();
    for (name, toward) in [
        ("View from top", [0.0, 0.0, 1.0]),
        ("View from front", [0.0, -1.0, 0.0]),
        ("View from right", [1.0, 0.0, 0.0]),
        ("View from back", [0.0, 1.0, 0.0]),
    ] {
        harness.get_by_label(name).click_accesskit();
        harness.run();
        let now = harness.state_mut().space().camera.toward().to_array();
        let off: f64 = now.iter().zip(toward).map(|(a, b)| (a - b).abs()).sum();
        assert!(off < 1e-9, "{name}: {now:?}");
    }
    // By hand, on the face that is seen.
    harness.get_by_label("View from a corner").click();
    harness.run();
    harness.get_by_label("View from top").click();
    harness.run();
    assert!(harness.state_mut().space().camera.toward().z > 0.999);
}

#[test]
fn a_click_selects_a_rung() {
    let mut harness = window(template("dinghy"));
    harness.state_mut().view = SurfaceView::Rungs;
    harness.run();
    let (at, panel, rung) = {
        let state = harness.state_mut();
        let camera = state.space().camera;
        let shown = state.panels[0].made.as_ref().unwrap();
        let rung = shown.rungs.len() / 2;
        let [a, b] = shown.rungs[rung].ends.map(|end| shown.positions[end as usize]);
        let rect = eframe::egui::Rect::from_min_size(Pos2::ZERO, SIZE);
        (camera.seen(a.lerp(b, 0.37), rect).unwrap().at, 0, rung)
    };
    harness.hover_at(at);
    harness.step();
    press(&mut harness, at, PointerButton::Primary, true);
    press(&mut harness, at, PointerButton::Primary, false);
    harness.run();
    let selected = harness.state().selection.clone();
    assert_eq!(selected.panel, Some(panel), "{selected:?}");
    let near = selected.rung().unwrap().1.abs_diff(rung);
    assert!(near <= 1, "rung {selected:?} for {rung}");
}

#[test]
fn a_screen_reader_hears_of_panels_and_handles() {
    let harness = window(template("dinghy"));
    let pane = harness.get_by_label("Space");
    let said = pane.accesskit_node().description().unwrap_or_default();
    let panels = harness.state().panels.len();
    assert!(said.starts_with(&format!("{panels} panel")), "{said}");
    assert!(said.contains("bends"), "{said}");
    for curve in &harness.state().document.design.curves {
        for k in 1..=curve.points.len() {
            let name = format!("{}, point {k}, ", curve.name);
            assert!(harness.query_by_label_contains(&name).is_some(), "{name}");
        }
    }
}

#[test]
fn legends_say_their_units_and_the_limit() {
    let mut harness = window(template("dinghy"));
    harness.state_mut().view = SurfaceView::Warp;
    harness.run();
    let legend = harness.get_by_label_contains("Legend: ° of twist");
    let name = legend.accesskit_node().value().unwrap_or_default();
    assert!(name.contains("limit"), "{name}");
    harness.state_mut().view = SurfaceView::LengthError;
    harness.run();
    harness.get_by_label_contains("Legend: Lengths: exact");
    harness.state_mut().view = SurfaceView::Strain;
    harness.run();
    let legend = harness.get_by_label_contains("Legend: % of strain, 95 % below 0.0");
    let name = legend.accesskit_node().value().unwrap_or_default();
    assert!(name.contains("limit 0.3 %"), "{name}");
    // Before the elastic sheet is there, no colour claims anything.
    for panel in &mut harness.state_mut().panels {
        panel.made.as_mut().unwrap().strain = None;
    }
    harness.state_mut().version += 1;
    harness.run();
    harness.get_by_label_contains("Legend: Strain: not known yet");
    // The Gauss image tells twist by its width, not by colours.
    harness.state_mut().view = SurfaceView::Gauss;
    harness.run();
    assert!(harness.query_by_label_contains("Legend:").is_none());
}

#[test]
fn twist_that_the_sampling_may_explain_is_said_and_shown() {
    let mut harness = window(template("dinghy"));
    harness.state_mut().view = SurfaceView::Warp;
    for panel in &mut harness.state_mut().panels {
        for rung in &mut panel.made.as_mut().unwrap().rungs {
            (rung.warp_deg, rung.is_unsure) = (7.6, true);
        }
    }
    harness.state_mut().version += 1;
    harness.run();
    let legend = harness.get_by_label_contains("Legend: ° of twist: none that is sure");
    let said = legend.accesskit_node().value().unwrap_or_default();
    assert!(said.contains("Pale: up to 7.6°, maybe from coarse samples"), "{said}");
    let pane = harness.get_by_label("Space");
    let said = pane.accesskit_node().description().unwrap_or_default();
    assert!(said.contains("up to 7.6° from coarse samples"), "{said}");
    let text = |clipped: &eframe::egui::epaint::ClippedShape| match &clipped.shape {
        eframe::egui::Shape::Text(text) => text.galley.text().starts_with("Pale: "),
        _ => false,
    };
    assert!(harness.output().shapes.iter().any(text), "the note is not drawn");
}

#[test]
fn an_empty_pane_says_what_to_do() {
    let mut harness = window(Design::default());
    harness.run();
    harness.get_by_label("Space");
}

/// The time of the pane itself, without the graphics card; run with `--nocapture` to see it.
#[test]
fn dragging_a_panel_of_400_samples_is_quick() {
    let mut design = template("dinghy");
    design.panels.truncate(1);
    design.panels[0].samples = 400;
    let mut harness = window(design);
    harness.run();
    let samples = harness.state().panels[0].made.as_ref().unwrap().positions.len();
    for view in [SurfaceView::Shaded, SurfaceView::Rungs, SurfaceView::Warp] {
        harness.state_mut().view = view;
        harness.run();
        let name = format!("{}, point 2,", harness.state().document.design.curves[0].name);
        let from = harness.get_by_label_contains(&name).rect().center();
        harness.hover_at(from);
        harness.step();
        press(&mut harness, from, PointerButton::Primary, true);
        harness.state_mut().took.clear();
        for k in 0..200 {
            // Every frame new panels, as the engine gives while the hand moves.
            harness.state_mut().version += 1;
            harness.hover_at(from - vec2(0.0, k as f32 * 0.3));
            harness.step();
        }
        press(&mut harness, from, PointerButton::Primary, false);
        let mut took = harness.state().took.clone();
        took.sort_by(f64::total_cmp);
        let at = |share: f64| 1e3 * took[((took.len() - 1) as f64 * share) as usize];
        println!(
            "{view:?}, {samples} samples: median {:.2} ms, 99 % {:.2} ms, most {:.2} ms",
            at(0.5),
            at(0.99),
            at(1.0)
        );
        // A sixtieth of a second is for everything; this is one pane of it, on a slow machine.
        assert!(at(0.5) < 8.0, "{} ms", at(0.5));
    }
}

/// Pictures to look at, into the folder that `SHEETWRIGHT_PICTURES` names.
#[test]
fn pictures_to_look_at() {
    let Some(folder) = std::env::var_os("SHEETWRIGHT_PICTURES") else { return };
    let folder = std::path::PathBuf::from(folder);
    use sheetwright_editor::theme::Look;
    let designs = [
        ("dinghy", template("dinghy")),
        ("hull", example("ubc-fishing-vessel.sheet.json")),
        ("square-to-round", template("square-to-round")),
        ("three-cones", example("three-cones.sheet.json")),
        ("cone", template("cone")),
    ];
    let wanted = std::env::var("SHEETWRIGHT_ONLY").unwrap_or_default();
    for (name, design) in designs {
        for (look, scale) in [(Look::Light, 1.0), (Look::Dark, 2.0)] {
            if !wanted.is_empty() && !format!("{name}-{look:?}").contains(&wanted) {
                continue;
            }
            let design = design.clone();
            let mut harness = Harness::builder()
                .with_size(SIZE)
                .with_pixels_per_point(scale)
                .with_max_steps(60)
                .with_render_cursor(false)
                .wgpu()
                .build_eframe(|cc| {
                    let card = cc.wgpu_render_state.as_ref().map(|card| card.adapter.get_info());
                    println!("{name}: {:?}", card.map(|card| (card.backend, card.name)));
                    let pane = SpacePane::new(cc);
                    Window::new(Pane::Space(Box::new(pane)), design)
                });
            harness.state_mut().look = look;
            for view in SurfaceView::ALL {
                harness.state_mut().view = view;
                harness.run();
                let picture = harness.render().unwrap();
                picture.save(folder.join(format!("{name}-{look:?}-{view:?}.png"))).unwrap();
            }
            // A handle in the hand, level with another one.
            harness.state_mut().view = SurfaceView::Rungs;
            harness.state_mut().selection = Selection::of_rung(0, 5);
            harness.run();
            let (_, at) = apart(&harness);
            harness.hover_at(at);
            harness.step();
            press(&mut harness, at, PointerButton::Primary, true);
            for k in 0..60 {
                harness.hover_at(at - vec2(0.0, 10.0 + k as f32));
                harness.step();
            }
            let picture = harness.render().unwrap();
            picture.save(folder.join(format!("{name}-{look:?}-drag.png"))).unwrap();
        }
    }
}
