//! In which unit the numbers of a table are, where the table does not say.

use super::window;
use crate::editor::Unitless;
use crate::panes::words;
use eframe::egui::{self, Button, vec2};
use sheetwright_files::Units;

/// How wide the page is, points.
const WIDTH: f32 = 340.0;

/// Shows the page: whether it stays open, and the unit once it is chosen.
pub fn unit_ui(ctx: &egui::Context, of: &Unitless) -> (bool, Option<Units>) {
    let mut chosen = None;
    let stays = window(ctx, "Which unit?", WIDTH, |ui| {
        ui.label(format!("{} does not say in which unit its numbers are.", of.name()));
        for unit in Units::ALL {
            let mm = of.length * unit.in_mm();
            let length =
                words::length(mm, if mm < 1000.0 { Units::Millimetres } else { Units::Metres });
            let text = format!("{}: {length} long", unit.name());
            if ui.add(Button::new(text).min_size(vec2(ui.available_width(), 32.0))).clicked() {
                chosen = Some(unit);
            }
        }
    });
    (stays, chosen)
}
