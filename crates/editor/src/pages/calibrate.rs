//! How far two places of the picture are apart, which makes it true to scale.

use super::{main_button, window};
use crate::document::FARTHEST_MM;
use crate::editor::Editor;
use crate::field::Field;
use crate::theme::Theme;
use eframe::egui::{self, Id, Key};

/// What is typed so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct CalibratePage {
    is_open: bool,
    /// The distance that was typed, mm.
    typed: Option<f64>,
}

impl CalibratePage {
    /// The page is not shown.
    pub fn close(&mut self) {
        *self = Self::default();
    }

    /// Shows the page: whether it stays open, and the distance when it is to be taken, mm.
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        editor: &Editor,
        theme: &Theme,
    ) -> (bool, Option<f64>) {
        let mut taken = None;
        let stays = window(ctx, "Scale the picture", 320.0, |ui| {
            ui.label("Type the real distance between the two places and press Enter.");
            let now = self.typed.or(editor.calibrating()).unwrap_or(0.0);
            let units = editor.document().drawing.units;
            let field = Field { theme, of: Id::unique("picture"), label: "Distance" };
            let typed = field.length(ui, now, units, 0.01..=FARTHEST_MM);
            if !std::mem::replace(&mut self.is_open, true) {
                field.focus(ui);
            }
            self.typed = typed.or(self.typed);
            // Whoever leaves the field may still want to drop it.
            let is_entered = typed.is_some() && ui.input(|i| i.key_pressed(Key::Enter));
            let is_fine = !field.is_refused(ui);
            let wants = ui.add_enabled_ui(is_fine, |ui| main_button(ui, theme, "Scale it")).inner;
            if wants.clicked() || is_entered {
                taken = self.typed.or(editor.calibrating());
            }
        });
        (stays, taken)
    }
}
