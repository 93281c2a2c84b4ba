//! The pane of the flat pattern: what is selected in it, how it is looked at, and what it says.

mod panes;

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Shape, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use panes::{Pane, Window, example, template};
use sheetwright::design::Design;
use sheetwright_editor::document::Selection;
use sheetwright_editor::panes::pattern::PatternPane;
use sheetwright_editor::views::SurfaceView;
use sheetwright_files::Units;

const SIZE: Vec2 = vec2(640.0, 360.0);

fn window(design: Design) -> Harness<'static, Window> {
    let harness = Harness::builder().with_size(SIZE).with_max_steps(60);
    harness.build_eframe(|_| Window::new(Pane::Pattern(PatternPane::new()), design))
}

fn click(harness: &mut Harness<'_, Window>, pos: Pos2) {
    harness.hover_at(pos);
    harness.step();
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        harness.event(Event::PointerButton { pos, button, pressed, modifiers });
        harness.step();
    }
    harness.run();
}

#[test]
fn pieces_are_named_with_their_size_in_the_units_of_the_drawing() {
    let mut harness = window(template("dinghy"));
    harness.run();
    for units in [Units::Millimetres, Units::Inches] {
        harness.state_mut().document.drawing.units = units;
        harness.run();
        let state = harness.state();
        for panel in &state.panels {
            let shown = panel.made.as_ref().unwrap();
            let [wide, high] =
                [shown.piece.size.x, shown.piece.size.y].map(|mm| mm / units.in_mm());
            let wanted = format!("{}, ", panel.name);
            let node = harness.get_by_label_contains(&wanted);
            let name = node.accesskit_node().label().unwrap_or_default();
            let said = name.split_once(", ").unwrap().1;
            let (w, rest) = said.split_once(" × ").unwrap();
            let (h, unit) = rest.split_once(' ').unwrap();
            assert!((w.parse::<f64>().unwrap() - wide).abs() < 0.06, "{name}: {wide}");
            assert!((h.parse::<f64>().unwrap() - high).abs() < 0.06, "{name}: {high}");
            assert_eq!(unit, units.name());
        }
    }
    let pane = harness.get_by_label("Flat pattern");
    let said = pane.accesskit_node().description().unwrap_or_default();
    assert!(said.starts_with(&format!("{} piece", harness.state().panels.len())), "{said}");
}

#[test]
fn a_click_selects_a_rung_or_the_piece_or_nothing() {
    let mut harness = window(template("dinghy"));
    harness.run();
    let name = format!("{}, ", harness.state().panels[0].name);
    let around = harness.get_by_label_contains(&name).rect();
    // A place on a rung: half way along the middle one, as the pattern has it.
    let shown = harness.state().panels[0].made.as_ref().unwrap().clone();
    let rung = shown.rungs.len() / 2;
    let [a, b] = shown.rungs[rung].flat_ends.map(|end| shown.flat[end as usize]);
    let middle = a.lerp(b, 0.5);
    let scale = f64::from(around.width()) / shown.piece.size.x;
    let at = around.left_bottom() + vec2((middle.x * scale) as f32, -(middle.y * scale) as f32);
    click(&mut harness, at);
    let selected = harness.state().selection.clone();
    assert_eq!(selected.panel, Some(0));
    assert!(selected.rung().unwrap().1.abs_diff(rung) <= 1, "{selected:?} for rung {rung}");
    click(&mut harness, Pos2::new(5.0, 5.0));
    assert_eq!(harness.state().selection, Selection::default());
    harness.get_by_label_contains(&name).click_accesskit();
    harness.run();
    assert_eq!(harness.state().selection.panel, Some(0));
}

#[test]
fn the_view_keeps_everything_in_sight_until_it_is_moved() {
    let mut harness = window(template("cone"));
    harness.run();
    let name = format!("{}, ", harness.state().panels[0].name);
    let width = |h: &Harness<'_, Window>| h.get_by_label_contains(&name).rect().width();
    let before = width(&harness);
    assert!(before > 0.3 * SIZE.x.min(SIZE.y), "{before}");
    harness.get_by_label("Flat pattern").focus();
    harness.run();
    harness.key_press(Key::Plus);
    harness.run();
    assert!((width(&harness) / before - 1.25).abs() < 0.01);
    if let Pane::Pattern(pane) = &mut harness.state_mut().pane {
        pane.fit();
    }
    harness.run();
    assert!((width(&harness) - before).abs() < 0.5);
}

/// Dimensions cover no piece and no other dimension; how many there are.
fn measured(harness: &Harness<'_, Window>, size: Vec2) -> usize {
    let unit = format!(" {}", harness.state().document.drawing.units.name());
    let text = |clipped: &eframe::egui::epaint::ClippedShape| match &clipped.shape {
        Shape::Text(text) if text.galley.text().ends_with(&unit) => {
            Some(text.visual_bounding_rect())
        }
        _ => None,
    };
    let texts: Vec<Rect> = harness.output().shapes.iter().filter_map(text).collect();
    let pieces = boxes(harness);
    for (n, text) in texts.iter().enumerate() {
        assert!(!pieces.iter().any(|piece| piece.intersects(*text)), "{text} {pieces:?} {size}");
        assert!(!texts[..n].iter().any(|other| other.intersects(*text)), "{text} {size}");
    }
    texts.len()
}

#[test]
fn dimensions_cover_no_piece_and_no_other_dimension() {
    let mut count = 0;
    for design in [
        template("dinghy"),
        example("ubc-fishing-vessel.sheet.json"),
        template("cone"),
        template("lampshade"),
        example("hat.sheet.json"),
    ] {
        let mut harness = window_of(SIZE, design);
        let sizes = (0..24).map(|n| vec2(260.0 + 20.0 * n as f32, 258.0));
        let others = [vec2(497.0, 258.0), vec2(900.0, 200.0), vec2(320.0, 500.0)];
        for size in sizes.chain(others) {
            harness.set_size(size);
            harness.run();
            count += measured(&harness, size);
        }
        // Nor when the hand looks more closely, or from farther away.
        harness.get_by_label("Flat pattern").focus();
        harness.run();
        for key in [Key::Plus; 6].into_iter().chain([Key::Minus; 12]) {
            harness.key_press(key);
            harness.run();
            measured(&harness, Vec2::ZERO);
        }
    }
    assert!(count > 100, "{count}");
}

#[test]
fn parts_are_as_large_as_they_fit() {
    // How much of its width the pane shows of the longest plank of a hull, and of a part of a dome.
    for (design, size, least) in [
        (example("ubc-fishing-vessel.sheet.json"), vec2(497.0, 258.0), 300.0),
        (template("dinghy"), vec2(497.0, 258.0), 220.0),
    ] {
        let harness = window_of(size, design);
        let all = boxes(&harness);
        let longest = all.iter().map(|b| b.size().max_elem()).fold(0.0, f32::max);
        let pane = Rect::from_min_size(Pos2::ZERO, size);
        assert!(all.iter().all(|b| pane.contains_rect(*b)), "{all:?}");
        assert!(longest > least, "{longest}");
    }
}

#[test]
fn an_empty_pane_says_what_to_do() {
    let mut harness = window(Design::default());
    harness.run();
    harness.get_by_label("Draw a closed outline on the plan to see its pattern here.");
}

#[test]
fn what_is_not_made_says_why() {
    let mut design = template("dinghy");
    design.panels[0].samples = 1;
    let mut harness = window(design);
    harness.run();
    let refused = harness.state().panels[0].made.clone().unwrap_err();
    harness.get_by_label_contains(&refused.message);
}

fn window_of(size: Vec2, design: Design) -> Harness<'static, Window> {
    let harness = Harness::builder().with_size(size).with_max_steps(60);
    let mut harness =
        harness.build_eframe(|_| Window::new(Pane::Pattern(PatternPane::new()), design));
    harness.run();
    harness
}

/// Where the part of each panel lies.
fn boxes(harness: &Harness<'_, Window>) -> Vec<Rect> {
    let panels = harness.state().panels.iter();
    let named = |name: &str| harness.get_by_label_contains(&format!("{name}, ")).rect();
    panels.map(|panel| named(&panel.name)).collect()
}

fn drawn_texts(harness: &Harness<'_, Window>) -> Vec<String> {
    let text = |clipped: &eframe::egui::epaint::ClippedShape| match &clipped.shape {
        Shape::Text(text) => Some(text.galley.text().to_owned()),
        _ => None,
    };
    harness.output().shapes.iter().filter_map(text).collect()
}

#[test]
fn pieces_that_are_one_part_stand_once_and_large() {
    let mut harness = window_of(vec2(720.0, 250.0), template("dome"));
    let count = harness.state().panels.len();
    let all = boxes(&harness);
    assert!(count >= 8 && all.iter().all(|b| *b == all[0]), "{all:?}");
    assert!(all[0].size().max_elem() > 150.0, "{}", all[0]);
    let texts = drawn_texts(&harness);
    assert!(texts.iter().any(|text| text.ends_with(&format!(" ×{count}"))), "{texts:?}");
    harness.hover_at(all[0].center());
    for _ in 0..60 {
        harness.step();
    }
    let texts = drawn_texts(&harness).join("\n");
    assert!(texts.contains("mm each"), "{texts}");
    harness.hover_at(Pos2::new(2.0, 2.0));
    harness.run();
    // The one that is selected stands for all.
    let name = harness.state().panels[3].name.clone();
    harness.get_by_label_contains(&format!("{name}, ")).click_accesskit();
    harness.run();
    assert_eq!(harness.state().selection.panel, Some(3));
}

#[test]
fn parts_lie_where_they_lie_whatever_is_looked_at() {
    for size in [SIZE, vec2(500.0, 700.0)] {
        let mut harness = window_of(size, template("dinghy"));
        let before = boxes(&harness);
        for view in SurfaceView::ALL {
            harness.state_mut().view = view;
            harness.run();
            assert_eq!(boxes(&harness), before, "{view:?}");
        }
    }
}

#[test]
fn while_a_button_is_down_parts_stay_about_their_middles() {
    let mut harness = window_of(SIZE, template("dinghy"));
    let before = boxes(&harness);
    let press = |harness: &mut Harness<'_, Window>, pressed| {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        let pos = Pos2::new(4.0, 4.0);
        harness.hover_at(pos);
        harness.step();
        harness.event(Event::PointerButton { pos, button, pressed, modifiers });
        harness.step();
    };
    press(&mut harness, true);
    let mut design = harness.state().document.design.clone();
    // One of the curves bulges: its panels become larger, and no longer mirror images of others.
    let points = &mut design.curves[0].points;
    let inner = 1..points.len() - 1;
    for point in &mut points[inner] {
        point.at.y *= 1.25;
    }
    harness.state_mut().panels = panes::shown(&design);
    harness.state_mut().version += 1;
    harness.step();
    let held = boxes(&harness);
    assert_ne!(held, before);
    for (a, b) in held.iter().zip(&before) {
        assert!(a.center().distance(b.center()) < 0.01, "{a} {b}");
    }
    press(&mut harness, false);
    harness.run();
    let pane = Rect::from_min_size(Pos2::ZERO, SIZE);
    assert!(boxes(&harness).iter().all(|b| pane.contains_rect(*b)));
}

#[test]
fn rungs_are_drawn_where_they_tell_something() {
    let lines = |harness: &Harness<'_, Window>| {
        let is_line =
            |c: &&eframe::egui::epaint::ClippedShape| matches!(c.shape, Shape::LineSegment { .. });
        harness.output().shapes.iter().filter(is_line).count()
    };
    let flat = |design: &mut Design| {
        design.curves.iter_mut().flat_map(|c| &mut c.points).for_each(|p| p.at.z = 0.0);
    };
    let mut design = template("dinghy");
    assert!(lines(&window_of(SIZE, design.clone())) > 60);
    assert!(lines(&window_of(vec2(90.0, 60.0), design.clone())) < 40);
    design.panels.retain(|panel| panel.name.contains("bottom"));
    design.panels.truncate(1);
    assert!(!design.panels.is_empty());
    flat(&mut design);
    assert!(lines(&window_of(SIZE, design)) < 20);
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
        ("three-cones", example("three-cones.sheet.json")),
        ("cone", template("cone")),
        ("dome", template("dome")),
        ("hemisphere", template("hemisphere")),
        ("empty", Design::default()),
    ];
    for (name, design) in designs {
        for (look, scale) in [(Look::Light, 1.0), (Look::Dark, 2.0)] {
            let design = design.clone();
            let mut harness = Harness::builder()
                .with_size(SIZE)
                .with_pixels_per_point(scale)
                .with_max_steps(60)
                .with_render_cursor(false)
                .wgpu()
                .build_eframe(|_| Window::new(Pane::Pattern(PatternPane::new()), design));
            harness.state_mut().look = look;
            for view in [SurfaceView::Shaded, SurfaceView::Warp, SurfaceView::LengthError] {
                harness.state_mut().view = view;
                harness.run();
                let picture = harness.render().unwrap();
                let file = format!("pattern-{name}-{look:?}-{view:?}.png");
                picture.save(folder.join(file)).unwrap();
            }
        }
    }
}
