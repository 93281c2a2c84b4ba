//! The question what is to become of work that no file has, before something else takes its place.

use super::{PageWindow, main_button};
use crate::editor::{Decision, Editor, Next};
use crate::theme::Theme;
use eframe::egui::{self, Key, Modifiers, RichText};

/// Shows the question, if there is one, above everything else; what the person decides.
pub fn unsaved_ui(ctx: &egui::Context, editor: &Editor, theme: &Theme) -> Option<Decision> {
    let next = editor.asks()?;
    let mut decision = None;
    if ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
        decision = Some(Decision::Stay);
    }
    PageWindow::new("Unsaved work", 400.0).show(ctx, |ui, is_new| {
        ui.heading(format!("{} is not saved yet", editor.title()));
        let back = "Work that you drop stays on the start page, under Recently closed.";
        ui.label(format!("{} {back}", what_comes(next)));
        if let Some(notice) = editor.notice.as_ref().filter(|notice| notice.is_refusal) {
            ui.label(RichText::new(&notice.text).color(theme.verdicts[2]));
        }
        ui.add_space(10.0);
        ui.horizontal_wrapped(|ui| {
            let save = main_button(ui, theme, "Save");
            if is_new {
                save.request_focus();
            }
            if save.on_hover_text("Save it to a file, then go on.").clicked() {
                decision = Some(Decision::Save);
            }
            let drop = ui.button("Drop").on_hover_text(
                "Go on without saving it. It stays on the start page, under Recently closed.",
            );
            if drop.clicked() {
                decision = Some(Decision::Drop);
            }
            if ui.button("Cancel").on_hover_text("Go on working at it.").clicked() {
                decision = Some(Decision::Stay);
            }
        });
        ui.label(RichText::new("Esc cancels.").color(theme.faint).small());
    });
    decision
}

fn what_comes(next: &Next) -> String {
    match next {
        Next::Blank => "An empty sheet takes its place.".to_owned(),
        Next::Document(coming) => {
            format!("{} takes its place.", coming.draft.document.design.name)
        }
        Next::Close => "The window closes.".to_owned(),
    }
}
