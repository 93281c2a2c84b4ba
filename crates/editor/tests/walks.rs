//! The two walks of `docs/editor.md`, with every click and key counted, and their pictures:
//! `SHEETWRIGHT_REWRITE=1 cargo test -p sheetwright-editor --test walks` draws them anew, and with
//! `SHEETWRIGHT_COMPARE=1` they are drawn and compared with those of the docs. That takes the
//! software rasteriser that drew them (Mesa's), so it is not done unless somebody asks.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::{Pos2, vec2};
use egui_kittest::kittest::Queryable;
use hands::{Hands, round};
use sheetwright::check::Verdict;
use sheetwright_editor::command::Command;
use sheetwright_editor::theme::Look;
use std::path::PathBuf;

const DOCS: &str = include_str!("../../../docs/editor.md");

fn is_set(variable: &str) -> bool {
    std::env::var_os(variable).is_some()
}

/// Points of a picture that may look otherwise, as a share of all: edges, where rasterisers round.
const OTHERWISE: f64 = 0.005;
/// How much otherwise a point has to look to count.
const NOTICED: u8 = 24;

/// The share of points that look otherwise in two pictures.
fn otherwise(a: &image::RgbaImage, b: &image::RgbaImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let differ = |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| {
        a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > NOTICED)
    };
    let count = a.pixels().zip(b.pixels()).filter(|pair| differ(*pair)).count();
    count as f64 / f64::from(a.width() * a.height())
}

/// A window in light colours; drawn where pictures are wanted.
fn window() -> (Hands, bool) {
    let is_drawn = is_set("SHEETWRIGHT_REWRITE") || is_set("SHEETWRIGHT_COMPARE");
    let mut hands = Hands::new([1280.0, 800.0], is_drawn);
    hands.run(Command::Look(Look::Light));
    (hands, is_drawn)
}

/// Draws a picture of the docs anew, or compares it, where that is wanted.
fn picture(hands: &mut Hands, is_drawn: bool, name: &str) {
    if is_drawn {
        // Windows fade in.
        hands.harness.run_steps(30);
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/pictures");
        let drawn = hands.harness.render().unwrap();
        let path = folder.join(format!("editor-{name}.png"));
        if is_set("SHEETWRIGHT_REWRITE") {
            drawn.save(path).unwrap();
        } else {
            let kept = image::open(path).unwrap().to_rgba8();
            let share = otherwise(&drawn, &kept);
            assert!(share <= OTHERWISE, "{name}: {:.2} % look otherwise", 100.0 * share);
        }
    }
}

/// The docs say how many clicks and keys a walk takes.
fn compare(hands: &Hands) {
    let said = format!("{} clicks or drags and {} keys", hands.clicks, hands.keys);
    assert!(DOCS.contains(&said), "docs/editor.md should say: {said}");
}

fn pattern_of(hands: &Hands, name: &str) -> String {
    let disk = hands.disk.lock().unwrap();
    let file = disk.exported.iter().find(|file| file.name == name).unwrap();
    String::from_utf8(file.bytes.clone()).unwrap()
}

#[test]
fn from_a_template_to_a_pattern() {
    let (mut hands, is_drawn) = window();
    hands.harness.run_steps(40);
    picture(&mut hands, is_drawn, "start");
    hands.click("Lampshade");
    hands.harness.run_steps(3);
    hands.type_into("Diameter of the lower ring", "30cm");
    hands.type_into("Height along the side, as the shade is sold", "1' 0\"");
    picture(&mut hands, is_drawn, "template");
    hands.click("Make it");
    hands.settle();
    picture(&mut hands, is_drawn, "made");
    hands.click("Export…");
    hands.harness.run_steps(3);
    hands.click("Choose a folder…");
    hands.settle();
    let shown = hands.app().editor().shown()[0].clone();
    assert!(shown.made.is_ok_and(|made| made.verdict != Verdict::WillNotBend));
    assert!(pattern_of(&hands, &format!("{}.svg", shown.name)).contains("<svg"));
    compare(&hands);
}

#[test]
fn from_a_stroke_to_a_pattern() {
    let (mut hands, is_drawn) = window();
    hands.click("Draw an outline");
    let middle = hands.on_plan(0.0, 0.0);
    let way = round(middle, vec2(180.0, 120.0), 90);
    hands.press(way[0]);
    for &at in &way[1..60] {
        hands.move_to(at);
    }
    picture(&mut hands, is_drawn, "stroke");
    for &at in &way[60..] {
        hands.move_to(at);
    }
    hands.release(way[90]);
    hands.settle();
    // Space turns to what was drawn.
    hands.harness.run_steps(40);
    // The plan has the same handle, farther to the left.
    let handles = hands.harness.get_all_by_label_contains("outline, point 2,");
    let places = handles.map(|handle| handle.rect().center());
    let from: Pos2 = places.max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
    let up: Vec<Pos2> = (0..=12).map(|n| from - vec2(0.0, 6.0 * n as f32)).collect();
    hands.drag(&up);
    hands.settle();
    let curve = &hands.app().editor().document().design.curves[0];
    assert!(curve.points[1].at.z > 10.0, "{curve:?}");
    picture(&mut hands, is_drawn, "lifted");
    hands.click("Export…");
    hands.harness.run_steps(3);
    picture(&mut hands, is_drawn, "export");
    hands.click("Choose a folder…");
    hands.settle();
    assert!(pattern_of(&hands, "outline.svg").contains("<svg"));
    assert!(pattern_of(&hands, "report.json").contains("outline"));
    compare(&hands);
}
