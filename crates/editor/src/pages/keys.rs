//! The keys of all commands.

use super::window;
use crate::command::Command;
use crate::theme::Theme;
use eframe::egui::{self, Label, RichText};

/// Shows the page; whether it stays open.
pub fn keys_ui(ctx: &egui::Context, theme: &Theme) -> bool {
    window(ctx, "Keys", 460.0, |ui| {
        let width = (ui.available_width() - 170.0).max(100.0);
        let grid = egui::Grid::new("keys").num_columns(2).striped(true).max_col_width(width);
        grid.show(ui, |ui| {
            for command in Command::all() {
                let key = ctx.format_shortcut(&command.key());
                ui.label(RichText::new(key).monospace());
                ui.add(Label::new(command.name()).wrap()).on_hover_text(command.tooltip());
                ui.end_row();
            }
            for (key, what) in HAND {
                ui.label(RichText::new(key).color(theme.faint));
                ui.add(Label::new(what).wrap());
                ui.end_row();
            }
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
