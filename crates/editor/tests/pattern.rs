//! The pane of the flat pattern: what is selected in it, how it is looked at, and what it says.

mod panes;

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Shape, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use panes::{Pane, Window, example, template};
use sheetwright::design::Design;
use sheetwright_editor::panes::SurfaceView;
use sheetwright_editor::panes::pattern::PatternPane;
use sheetwright_editor::scene::Selection;
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
    assert!(selected.rung.unwrap().abs_diff(rung) <= 1, "{selected:?} for rung {rung}");
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

#[test]
fn dimensions_cover_no_piece_and_no_other_dimension() {
    let mut measured = 0;
    for design in [template("dinghy"), example("ubc-fishing-vessel.sheet.json"), template("cone")] {
        for size in [SIZE, vec2(497.0, 258.0), vec2(900.0, 200.0), vec2(320.0, 500.0)] {
            let design = design.clone();
            let mut harness = Harness::builder()
                .with_size(size)
                .with_max_steps(60)
                .build_eframe(|_| Window::new(Pane::Pattern(PatternPane::new()), design));
            harness.run();
            let state = harness.state();
            let unit = format!(" {}", state.document.drawing.units.name());
            let texts: Vec<Rect> = harness
                .output()
                .shapes
                .iter()
                .filter_map(|clipped| match &clipped.shape {
                    Shape::Text(text) if text.galley.text().ends_with(&unit) => {
                        Some(text.visual_bounding_rect())
                    }
                    _ => None,
                })
                .collect();
            let pieces: Vec<Rect> = state
                .panels
                .iter()
                .map(|panel| harness.get_by_label_contains(&format!("{}, ", panel.name)).rect())
                .collect();
            for (n, text) in texts.iter().enumerate() {
                assert!(Rect::from_min_size(Pos2::ZERO, size).contains_rect(*text), "{text}");
                assert!(!pieces.iter().any(|piece| piece.intersects(*text)), "{text} {pieces:?}");
                assert!(!texts[..n].iter().any(|other| other.intersects(*text)), "{text}");
            }
            measured += texts.len();
        }
    }
    assert!(measured > 20, "{measured}");
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
