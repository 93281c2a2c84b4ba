//! Which files to write.

use super::{main_button, window};
use crate::editor::Editor;
use crate::theme::Theme;
use eframe::egui::{self, RichText};
use sheetwright::check::Verdict;
use sheetwright_files::{Format, formats_for};

/// What is chosen.
#[derive(Clone, Debug, Default)]
pub struct ExportPage {
    /// The formats; `None` until a person chooses, for those that the design or its trade names.
    formats: Option<Vec<Format>>,
}

impl ExportPage {
    /// Shows the page: whether it stays open, and the formats if they are to be written now.
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        editor: &Editor,
        theme: &Theme,
    ) -> (bool, Option<Vec<Format>>) {
        let mut wanted = None;
        let stays = window(ctx, "Export", 430.0, |ui| {
            let bad: Vec<&str> = editor
                .shown()
                .iter()
                .filter(|panel| match &panel.made {
                    Ok(shown) => shown.verdict == Verdict::WillNotBend,
                    Err(_) => true,
                })
                .map(|panel| panel.name.as_str())
                .collect();
            if !bad.is_empty() {
                let text =
                    format!("Read the findings before you cut: {} will not bend.", bad.join(", "));
                ui.label(RichText::new(text).color(theme.verdicts[2]));
                ui.add_space(6.0);
            }
            let of_design = formats_for(&editor.document().design);
            let mut formats = self.formats.clone().unwrap_or(of_design);
            for format in Format::ALL {
                let (name, what) = format.about();
                let mut is_chosen = formats.contains(&format);
                if ui.checkbox(&mut is_chosen, name).changed() {
                    formats.retain(|other| *other != format);
                    formats.extend(is_chosen.then_some(format));
                    formats.sort_unstable();
                    self.formats = Some(formats.clone());
                }
                ui.indent(name, |ui| ui.label(RichText::new(what).color(theme.faint).small()));
            }
            ui.add_space(10.0);
            let text = if cfg!(target_arch = "wasm32") { "Download" } else { "Choose a folder…" };
            ui.add_enabled_ui(!formats.is_empty(), |ui| {
                if main_button(ui, theme, text).clicked() {
                    wanted = Some(formats.clone());
                }
            });
            let same = "The files are those of the command line, byte by byte.";
            ui.label(RichText::new(same).color(theme.faint).small());
        });
        (stays, wanted)
    }
}
