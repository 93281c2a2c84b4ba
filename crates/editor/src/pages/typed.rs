//! A path that is typed, where the system has no dialog for files.

use super::{PageWindow, main_button};
use crate::editor::FileWish;
use crate::io::Typed;
use crate::theme::Theme;
use eframe::egui::{self, Key, Modifiers, RichText, TextEdit};

/// What a path is typed for, and what is typed so far.
pub struct TypedPath {
    wish: FileWish,
    path: String,
    /// What came of it last, if it was not granted.
    outcome: Option<Typed>,
}

/// What the person wants with the typed path.
pub enum PathAct {
    /// Use it; files that are there are replaced if so said.
    Use {
        /// Whether files that are there are replaced.
        replaces: bool,
    },
    /// Nothing.
    Leave,
}

impl TypedPath {
    /// Asks for a path for a wish, beginning with a folder.
    pub fn new(wish: FileWish, folder: &str) -> Self {
        let name = if let FileWish::Save { name, .. } = &wish { name } else { "" };
        Self { path: format!("{folder}{name}"), wish, outcome: None }
    }

    /// The wish that it is for.
    pub fn wish(&self) -> &FileWish {
        &self.wish
    }

    /// What was typed.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// It was not granted: this is why.
    pub fn refused(&mut self, outcome: Typed) {
        self.outcome = Some(outcome);
    }

    /// Shows the field, above everything else; what the person wants.
    pub fn ui(&mut self, ctx: &egui::Context, theme: &Theme) -> Option<PathAct> {
        let none = Modifiers::NONE;
        let (leaves, enters) =
            ctx.input_mut(|i| (i.consume_key(none, Key::Escape), i.consume_key(none, Key::Enter)));
        let mut act = leaves.then_some(PathAct::Leave);
        let [title, label, verb] = words(&self.wish);
        PageWindow::new("Path", 480.0).show(ctx, |ui, is_new| {
            ui.heading(title);
            ui.label(
                "This system shows no dialog for files: it has neither a desktop portal nor zenity. \
                 Type a path instead.",
            );
            ui.add_space(6.0);
            let name = ui.label(RichText::new(label).color(theme.faint));
            let edit = TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY);
            let edit = ui.add(edit).labelled_by(name.id);
            if is_new {
                edit.request_focus();
            }
            if edit.changed() {
                self.outcome = None;
            }
            let mut replaces = None;
            match &self.outcome {
                Some(Typed::IsThere { first, count }) => {
                    let (text, verb) = is_there(first, *count);
                    replaces = Some(verb);
                    ui.label(RichText::new(text).color(theme.verdicts[1]));
                }
                Some(Typed::Failed(text)) => {
                    ui.label(RichText::new(text).color(theme.verdicts[2]));
                }
                _ => {}
            }
            ui.add_space(10.0);
            ui.horizontal_wrapped(|ui| {
                let verb = replaces.unwrap_or(verb);
                let replaces = replaces.is_some();
                ui.add_enabled_ui(!self.path.trim().is_empty(), |ui| {
                    // Enter replaces nothing: that takes a click.
                    if main_button(ui, theme, verb).clicked()
                        || enters && !replaces && !self.path.trim().is_empty()
                    {
                        act = Some(PathAct::Use { replaces });
                    }
                });
                if ui.button("Cancel").clicked() {
                    act = Some(PathAct::Leave);
                }
            });
        });
        act
    }
}

/// What is said of files that are there, and what the button says that replaces them.
fn is_there(first: &str, count: usize) -> (String, &'static str) {
    let more = match count {
        0 | 1 => {
            let text = format!("{first} is there already. Type another path or replace it.");
            return (text, "Replace it");
        }
        2 => "1 more file".to_owned(),
        count => format!("{} more files", count - 1),
    };
    let text = format!("{first} and {more} are there already. Type another path or replace them.");
    (text, "Replace them")
}

/// The title, the name of the field, and what the button says.
fn words(wish: &FileWish) -> [&'static str; 3] {
    match wish {
        FileWish::Open => ["Open a design or a table", "Path of the file", "Open"],
        FileWish::Picture => ["Open a picture to trace", "Path of the file", "Open"],
        FileWish::Save { .. } => ["Save the design", "Path of the file", "Save"],
        FileWish::Export(_) => ["Write the files", "Path of the folder", "Write"],
    }
}
