//! What opens over the panes: the start page, and the windows of single commands.

pub mod calibrate;
pub mod export;
pub mod keys;
pub mod palette;
pub mod start;
pub mod tour;
pub mod vary;

use crate::theme::Theme;
use eframe::egui::{self, Align2, Ui};

/// A window in the middle, closed by its cross; whether it stays open.
fn window(ctx: &egui::Context, title: &str, width: f32, content: impl FnOnce(&mut Ui)) -> bool {
    let mut is_open = true;
    egui::Window::new(title)
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .default_width(width)
        .show(ctx, |ui| {
            ui.set_width(width);
            content(ui);
        });
    is_open
}

/// A button that stands out, as it is what people came for.
fn main_button(ui: &mut Ui, theme: &Theme, text: &str) -> egui::Response {
    let text = egui::RichText::new(text).color(theme.on_accent).strong();
    ui.add(egui::Button::new(text).fill(theme.accent).min_size(egui::vec2(120.0, 32.0)))
}
