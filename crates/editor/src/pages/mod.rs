//! What opens over the panes: the start page, and the windows of single commands.

pub mod calibrate;
pub mod export;
pub mod keys;
pub mod palette;
pub mod start;
pub mod tour;
pub mod vary;

use crate::room::fitting;
use crate::theme::Theme;
use eframe::egui::{self, Align2, Ui};

/// What is left free around a window, in points.
const MARGIN: f32 = 12.0;

/// A window in the middle, closed by its cross; whether it stays open. It is never larger than what
/// it stands in: what finds no room is scrolled to.
fn window(ctx: &egui::Context, title: &str, width: f32, content: impl FnOnce(&mut Ui)) -> bool {
    let mut is_open = true;
    let room = ctx.content_rect().size();
    // The title, and the margins of the frame.
    let around = egui::vec2(40.0, 90.0);
    egui::Window::new(title)
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .default_width(width)
        .show(ctx, |ui| {
            ui.set_width(fitting(width, room.x - around.x));
            let height = fitting(f32::INFINITY, room.y - around.y - 2.0 * MARGIN);
            let area = egui::ScrollArea::vertical().auto_shrink([false, true]);
            area.max_height(height).min_scrolled_height(height).show(ui, content);
        });
    is_open
}

/// A button that stands out, as it is what people came for.
fn main_button(ui: &mut Ui, theme: &Theme, text: &str) -> egui::Response {
    let text = egui::RichText::new(text).color(theme.on_accent).strong();
    ui.add(egui::Button::new(text).fill(theme.accent).min_size(egui::vec2(120.0, 32.0)))
}
