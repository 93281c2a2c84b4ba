//! Which files to write.

use super::{main_button, window};
use crate::editor::Editor;
use crate::theme::Theme;
use eframe::egui::{self, RichText, Ui};
use sheetwright::check::Verdict;
use sheetwright_files::{Format, formats_for};

/// How wide the page is, points.
const WIDTH: f32 = 620.0;
/// From this width on the formats stand in two columns.
const TWO_COLUMNS: f32 = 480.0;

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
        let stays = window(ctx, "Export", WIDTH, |ui| {
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
            // Two columns where there is room, so that the button below is seen.
            let columns = if ui.available_width() >= TWO_COLUMNS { 2 } else { 1 };
            let rows = Format::ALL.len().div_ceil(columns);
            ui.columns(columns, |uis| {
                for (ui, list) in uis.iter_mut().zip(Format::ALL.chunks(rows)) {
                    for &format in list {
                        if format_ui(ui, theme, format, &mut formats) {
                            self.formats = Some(formats.clone());
                        }
                    }
                }
            });
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

/// A format and what it is for; whether it was chosen or left out.
fn format_ui(ui: &mut Ui, theme: &Theme, format: Format, formats: &mut Vec<Format>) -> bool {
    let (name, what) = format.about();
    let mut is_chosen = formats.contains(&format);
    let is_changed = ui.checkbox(&mut is_chosen, name).changed();
    if is_changed {
        formats.retain(|other| *other != format);
        formats.extend(is_chosen.then_some(format));
        formats.sort_unstable();
    }
    ui.indent(name, |ui| ui.label(RichText::new(what).color(theme.faint).small()));
    is_changed
}
