//! Files of the window: opened by their paths, dropped on it, and what the dialogs answer.

use super::App;
use crate::io::{FileAnswer, Typed};
use crate::pages::typed::{PathAct, TypedPath};
use crate::theme::Theme;
use eframe::egui::{self, Align2, FontId, Id, LayerId, Order, Stroke, StrokeKind};

/// How thick the frame is that a window shows under a file, points.
const FRAME: f32 = 4.0;

impl App {
    /// Opens a file by its path.
    pub fn open_path(&mut self, path: &str) {
        match self.dialogs.read(path) {
            Ok(opened) => self.editor.open(opened),
            Err(text) => self.editor.failed(text),
        }
    }

    pub(super) fn take_file_answers(&mut self) {
        for answer in self.dialogs.answers() {
            self.take_file_answer(answer);
        }
    }

    fn take_file_answer(&mut self, answer: FileAnswer) {
        match answer {
            FileAnswer::Opened(opened) => self.editor.open(opened),
            FileAnswer::Picture(opened) => self.editor.trace(opened),
            FileAnswer::Saved { path, version } => {
                self.kept.remember(&path);
                self.editor.saved(path, version);
            }
            FileAnswer::Exported { count, folder } => {
                self.editor.done(format!("{count} files are in {folder}."));
            }
            FileAnswer::Dropped(files) => self.editor.open_first(files),
            FileAnswer::NoDialog { wish, folder } => {
                self.typed = Some(TypedPath::new(wish, &folder));
            }
            FileAnswer::Failed(text) => self.editor.failed(text),
        }
    }

    /// Files that were dropped on the window are read; not while something is asked.
    pub(super) fn take_dropped_files(&mut self, ctx: &egui::Context) {
        let files = ctx.input_mut(|i| std::mem::take(&mut i.raw.dropped_files));
        if files.is_empty() {
            return;
        }
        if self.typed.is_some() || self.editor.asks().is_some() {
            self.editor.failed("Answer the question first, then drop the file again.".to_owned());
        } else {
            self.dialogs.read_dropped(files);
        }
    }

    /// The page on which a path is typed, where the system has no dialog.
    pub(super) fn typed_ui(&mut self, ctx: &egui::Context, theme: &Theme) {
        let Some(mut typed) = self.typed.take() else { return };
        let stays = match typed.ui(ctx, theme) {
            Some(PathAct::Use { replaces }) => self.refuses_path(&mut typed, replaces),
            Some(PathAct::Leave) => false,
            None => true,
        };
        if stays {
            self.typed = Some(typed);
        }
    }

    /// Uses a typed path; whether it was refused, so that another one can be typed.
    fn refuses_path(&mut self, typed: &mut TypedPath, replaces: bool) -> bool {
        let refused = match self.dialogs.grant_at(typed.wish(), typed.path(), replaces) {
            Typed::Granted(answer) => {
                // A file that was read may still be refused for what it holds.
                let is_read = matches!(answer, FileAnswer::Opened(_) | FileAnswer::Picture(_));
                let before = self.editor.notice.take();
                self.take_file_answer(answer);
                let notice = self.editor.notice.take_if(|said| is_read && said.is_refusal);
                let Some(notice) = notice else { return false };
                self.editor.notice = before;
                Typed::Failed(notice.text)
            }
            refused => refused,
        };
        typed.refused(refused);
        true
    }
}

/// A frame round the window while a file hovers over it, and what letting go would do.
pub(super) fn hover_ui(ctx: &egui::Context, theme: &Theme) {
    let count = ctx.input(|i| i.raw.hovered_files.len());
    if count == 0 {
        return;
    }
    let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::unique("dropped files")));
    let area = ctx.content_rect();
    painter.rect_filled(area, 0.0, theme.accent.gamma_multiply(0.15));
    let stroke = Stroke::new(FRAME, theme.accent);
    painter.rect_stroke(area, 0.0, stroke, StrokeKind::Inside);
    let text = if count == 1 { "Drop the file to open it" } else { "Drop the files to open one" };
    let galley =
        painter.layout_no_wrap(text.to_owned(), FontId::proportional(22.0), theme.on_accent);
    let place = Align2::CENTER_CENTER.anchor_size(area.center(), galley.size());
    painter.rect_filled(place.expand(14.0), 8.0, theme.accent);
    painter.galley(place.min, galley, theme.on_accent);
}
