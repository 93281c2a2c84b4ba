//! Every command by a few letters of its name.

use super::PageWindow;
use crate::command::Command;
use crate::editor::Editor;
use crate::room::fitting;
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{self, Align2, Id, Key, RichText, TextEdit, Ui};

/// What is typed so far, and the line that is chosen.
#[derive(Clone, Debug, Default)]
pub struct Palette {
    text: String,
    chosen: usize,
}

impl Palette {
    /// The palette is not shown.
    pub fn close(&mut self) {
        *self = Self::default();
    }

    /// Shows it; whether it stays open.
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        editor: &Editor,
        theme: &Theme,
        acts: &mut Vec<Act>,
    ) -> bool {
        let found = found(&self.text);
        let (up, down, enter) = ctx.input_mut(|i| {
            let none = egui::Modifiers::NONE;
            (
                i.consume_key(none, Key::ArrowUp),
                i.consume_key(none, Key::ArrowDown),
                i.consume_key(none, Key::Enter),
            )
        });
        let last = found.len().saturating_sub(1);
        self.chosen = (self.chosen + usize::from(down)).saturating_sub(usize::from(up)).min(last);
        let mut stays = true;
        let room = ctx.content_rect().size();
        let place = (Align2::CENTER_TOP, egui::vec2(0.0, (0.11 * room.y).min(90.0)));
        let page = PageWindow { place, ..PageWindow::new("Find a command", 480.0) };
        let touched = page.show(ctx, |ui, is_new| {
            let edit = TextEdit::singleline(&mut self.text)
                .id(Id::unique("palette"))
                .hint_text("What do you want to do?")
                .desired_width(f32::INFINITY);
            let response = ui.add(edit);
            response.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Find a command")
            });
            if is_new {
                response.request_focus();
            }
            if response.changed() {
                self.chosen = 0;
            }
            let height = fitting(360.0, 0.8 * room.y - 90.0);
            let area = egui::ScrollArea::vertical().max_height(height);
            area.min_scrolled_height(height).show(ui, |ui| {
                for (n, &command) in found.iter().enumerate() {
                    let response = line_ui(ui, editor, theme, command, n == self.chosen);
                    if n == self.chosen && (up || down) {
                        response.scroll_to_me(None);
                    }
                    if response.clicked() || enter && n == self.chosen {
                        acts.push(Act::Run(command));
                        stays = false;
                    }
                }
                if found.is_empty() {
                    ui.label(RichText::new("No command has these letters.").color(theme.faint));
                }
            });
        });
        stays && !touched.beside
    }
}

fn line_ui(
    ui: &mut Ui,
    editor: &Editor,
    theme: &Theme,
    command: Command,
    is_chosen: bool,
) -> egui::Response {
    let why_not = editor.why_not(command);
    let [ink, faint] = match (is_chosen, why_not) {
        (true, _) => [theme.on_accent; 2],
        (false, None) => [theme.ink, theme.faint],
        (false, Some(_)) => [theme.faint; 2],
    };
    let key = ui.ctx().format_shortcut(&command.key());
    let button = egui::Button::selectable(is_chosen, RichText::new(command.name()).color(ink))
        .shortcut_text(RichText::new(key).color(faint))
        .min_size(egui::vec2(ui.available_width(), 0.0));
    ui.add_enabled(why_not.is_none(), button)
        .on_hover_text(command.tooltip())
        .on_disabled_hover_text(why_not.unwrap_or_default())
}

/// The commands that a few letters may mean, the likeliest first.
fn found(text: &str) -> Vec<Command> {
    let wanted = text.trim().to_lowercase();
    let mut found: Vec<(usize, Command)> = Command::all()
        .into_iter()
        .filter(|command| !matches!(command, Command::Palette | Command::Escape))
        .filter_map(|command| Some((place(command, &wanted)?, command)))
        .collect();
    found.sort_by_key(|(place, _)| *place);
    found.into_iter().map(|(_, command)| command).collect()
}

/// How well letters fit a command: 0 where its name begins with them, then inside, then in what it
/// does.
fn place(command: Command, wanted: &str) -> Option<usize> {
    let name = command.name().to_lowercase();
    if name.starts_with(wanted) {
        Some(0)
    } else if name.split([' ', ':']).any(|word| word.starts_with(wanted)) {
        Some(1)
    } else if name.contains(wanted) {
        Some(2)
    } else {
        command.tooltip().to_lowercase().contains(wanted).then_some(3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_likeliest_command_comes_first() {
        assert_eq!(found("exp")[0], Command::Export);
        assert_eq!(found("corner")[0], Command::ToggleCorner);
        assert_eq!(found("dark")[0], Command::Look(crate::theme::Look::Dark));
        assert!(found("photograph").contains(&Command::AddReference));
        assert!(found("qqq").is_empty());
    }

    #[test]
    fn every_command_has_words_and_a_key_of_its_own() {
        let all = Command::all();
        for (n, command) in all.iter().enumerate() {
            assert!(!command.name().is_empty() && command.tooltip().ends_with('.'), "{command:?}");
            for other in &all[n + 1..] {
                assert_ne!(command.name(), other.name());
                assert_ne!(command.key(), other.key(), "{command:?}");
            }
        }
    }
}
