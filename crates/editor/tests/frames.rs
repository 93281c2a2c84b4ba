//! How long a frame takes while a handle is dragged: what the program itself does for it (all
//! panes, laying out, drawing lists, triangles for the card), without the card; and how the panel
//! keeps up with the hand, with 120 frames a second.
//!
//! `cargo test -p sheetwright-editor --test frames -- --nocapture` prints the figures. Half of the
//! frames have to be within the time of one at 60 a second, however busy the machine is; the 99th
//! percentile is to be read where nothing else runs.

#![allow(clippy::print_stdout)] // a measurement

mod hands;

use eframe::egui::vec2;
use hands::{Hands, round};
use sheetwright_editor::command::Command;
use std::time::{Duration, Instant};

/// Moves of the hand.
const MOVES: usize = 1000;

/// The time of a frame at 60 a second, ms.
const FRAME_MS: f64 = 1e3 / 60.0;
/// The hand moves so often.
const MOVED: Duration = Duration::from_micros(8333);

#[test]
fn a_drag_of_a_handle_of_a_panel_of_400_samples() {
    let mut hands = Hands::new([1280.0, 800.0], false);
    hands.run(Command::New);
    let middle = hands.on_plan(0.0, 0.0);
    hands.drag(&round(middle, vec2(170.0, 110.0), 90));
    hands.settle();
    for (point, z) in [(0, 50.0), (2, 70.0)] {
        let editor = hands.harness.state_mut().editor_mut();
        let at = sheetwright_editor::document::PointRef { curve: 0, point };
        let mut to = editor.document().design.curves[0].points[point].at;
        to.z = z;
        editor.carry_out(sheetwright_editor::scene::Act::Move(vec![(at, to)]));
        editor.carry_out(sheetwright_editor::scene::Act::Rest);
    }
    hands.settle();
    let at = hands.app().editor().document().design.curves[0].points[1].at;
    let from = hands.on_plan(at.x, at.y);
    let mut way = vec![from];
    way.extend((0..MOVES).map(|n| {
        let angle = n as f32 * 0.05;
        from + vec2(30.0 * angle.sin(), 12.0 * (1.3 * angle).cos())
    }));
    let mut times_ms = Vec::new();
    let mut pictures = Vec::new();
    hands.press(way[0]);
    for &at in &way[1..] {
        let start = Instant::now();
        hands.move_to(at);
        let shapes = hands.harness.output().shapes.clone();
        let pixels = hands.harness.output().pixels_per_point;
        let triangles = hands.harness.ctx.tessellate(shapes, pixels);
        times_ms.push(start.elapsed().as_secs_f64() * 1e3);
        assert!(!triangles.is_empty());
        let panel = hands.app().editor().shown()[0].made.as_ref().unwrap();
        if pictures.last().is_none_or(|last| *last != panel.positions) {
            pictures.push(panel.positions.clone());
        }
        std::thread::sleep(MOVED.saturating_sub(start.elapsed()));
    }
    hands.release(way[MOVES]);
    hands.settle();
    times_ms.sort_by(f64::total_cmp);
    let part = |share: f64| times_ms[((times_ms.len() - 1) as f64 * share) as usize];
    println!(
        "{MOVES} frames of a drag: median {:.2} ms, 99th percentile {:.2} ms, largest {:.2} ms",
        part(0.5),
        part(0.99),
        part(1.0)
    );
    // The first is what was there before.
    pictures.remove(0);
    let all = hands.app().editor().shown()[0].made.as_ref().unwrap().positions.len();
    let fine = pictures.iter().filter(|positions| positions.len() == all).count();
    println!("{} pictures, {fine} of them with all {all} samples", pictures.len());
    assert!(part(0.5) < FRAME_MS);
    assert!(pictures.len() > MOVES / 10, "the panel follows while the hand moves");
    assert!(fine > 0, "with all its samples, where there is time");
}
