//! The keys of all commands.

use super::window;
use crate::command::Command;
use crate::theme::Theme;
use eframe::egui::{self, RichText};

/// Shows the page; whether it stays open.
pub fn keys_ui(ctx: &egui::Context, theme: &Theme) -> bool {
    window(ctx, "Keys", 460.0, |ui| {
        egui::ScrollArea::vertical().max_height(440.0).show(ui, |ui| {
            egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
                for command in Command::all() {
                    let Some(key) = command.key() else { continue };
                    ui.label(RichText::new(ctx.format_shortcut(&key)).monospace());
                    ui.label(command.name()).on_hover_text(command.tooltip());
                    ui.end_row();
                }
                for (key, what) in HAND {
                    ui.label(RichText::new(key).color(theme.faint));
                    ui.label(what);
                    ui.end_row();
                }
            });
        });
    })
}

/// What mouse and arrows do.
const HAND: [(&str, &str); 9] = [
    ("Arrows", "Move the selected handles on the plan by a step of the grid"),
    ("Shift+arrows", "By a tenth of it"),
    ("Page up, page down", "Lift or lower them in space"),
    ("Tab", "Go to the next handle or button"),
    ("Double click on a curve", "Put a handle there"),
    ("Wheel, pinch", "Nearer or farther"),
    ("Middle or right button", "Move the plan; turn space"),
    ("Alt while dragging", "Do not snap"),
    ("Backspace while drawing", "Take the last corner back"),
];
