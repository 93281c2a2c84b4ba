//! The panes: the plan on the left, space on the right, and the flat pattern.

mod dashes;
mod lit;
mod marks;
pub mod measured;
pub mod pattern;
pub mod plan;
pub mod space;
mod tag;
pub mod words;

use eframe::egui::Vec2;

/// A pane that grew or shrank by less, as a share of its size, looks the same: so bars may come and
/// go.
const SAME_SIZE: f32 = 0.06;

/// Whether a pane has another size than it had.
fn is_resized(from: Vec2, to: Vec2) -> bool {
    let differs = |from: f32, to: f32| (to - from).abs() > SAME_SIZE * from;
    differs(from.x, to.x) || differs(from.y, to.y)
}
