//! How far two places of the picture are apart, which makes it true to scale.

use super::window;
use crate::editor::Editor;
use crate::field::length_ui;
use crate::theme::Theme;
use eframe::egui;

/// Shows the page: whether it stays open, and the distance when it was typed, mm.
pub fn calibrate_ui(ctx: &egui::Context, editor: &Editor, theme: &Theme) -> (bool, Option<f64>) {
    let mut typed = None;
    let stays = window(ctx, "Scale the picture", 320.0, |ui| {
        ui.label("How far apart are the two places in truth? Type it and press Enter.");
        let now = editor.calibrating().unwrap_or(0.0);
        let units = editor.document().drawing.units;
        typed = length_ui(ui, theme, "Distance", now, units).filter(|mm| *mm > 0.0);
    });
    (stays, typed)
}
