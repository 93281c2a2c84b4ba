//! Files on the desktop: the system's own dialogs, each on a thread, so that the window stays alive.

use super::{Dialogs, FileAnswer};
use crate::editor::{FileWish, Opened};
use crate::engine::Wake;
use sheetwright_files::{OutputFile, whole::Folder, whole::WriteError, whole::write_one};
use std::path::Path;
use std::sync::mpsc::{Receiver, Sender, channel};

/// The dialogs of the system.
pub struct SystemDialogs {
    send: Sender<FileAnswer>,
    answers: Receiver<FileAnswer>,
    wake: Wake,
}

impl SystemDialogs {
    /// Dialogs that wake the window when they are answered.
    pub fn new(wake: Wake) -> Self {
        let (send, answers) = channel();
        Self { send, answers, wake }
    }
}

impl Dialogs for SystemDialogs {
    fn grant(&mut self, wish: FileWish) {
        let (send, wake) = (self.send.clone(), self.wake.clone());
        let answer_later = move || {
            if let Some(answer) = granted(wish) {
                // Nobody listens once the window is closed.
                let _ = send.send(answer);
            }
            wake();
        };
        let thread = std::thread::Builder::new().name("dialog".to_owned()).spawn(answer_later);
        if thread.is_err() {
            let text = "The system has no room for a dialog. Close something and try again.";
            let _ = self.send.send(FileAnswer::Failed(text.to_owned()));
        }
    }

    fn answers(&mut self) -> Vec<FileAnswer> {
        self.answers.try_iter().collect()
    }

    fn read(&mut self, path: &str) -> Result<Opened, String> {
        let bytes =
            std::fs::read(path).map_err(|error| format!("{path} can't be read: {error}."))?;
        Ok(Opened { path: path.to_owned(), bytes })
    }
}

fn granted(wish: FileWish) -> Option<FileAnswer> {
    let opened = |file: std::path::PathBuf, answer: fn(Opened) -> FileAnswer| {
        let path = file.display().to_string();
        match std::fs::read(&file) {
            Ok(bytes) => answer(Opened { path, bytes }),
            Err(error) => FileAnswer::Failed(format!("{path} can't be read: {error}.")),
        }
    };
    match wish {
        FileWish::Open => {
            let dialog = rfd::FileDialog::new().add_filter("Designs and tables", &["json", "csv"]);
            Some(opened(dialog.pick_file()?, FileAnswer::Opened))
        }
        FileWish::Picture => {
            let dialog = rfd::FileDialog::new().add_filter("Pictures", &["png", "jpg", "jpeg"]);
            Some(opened(dialog.pick_file()?, FileAnswer::Picture))
        }
        FileWish::Save { to, name, bytes, version } => {
            let path = match to {
                Some(to) => to.into(),
                None => {
                    let dialog = rfd::FileDialog::new().add_filter("Designs", &["json"]);
                    dialog.set_file_name(name).save_file()?
                }
            };
            let shown = path.display().to_string();
            Some(match write_one(&path, &bytes) {
                Ok(()) => FileAnswer::Saved { path: shown, version },
                Err(error) => FileAnswer::Failed(in_words(&error)),
            })
        }
        FileWish::Export(files) => {
            let folder =
                rfd::FileDialog::new().set_title("Where to put the files").pick_folder()?;
            Some(export(&folder, &files))
        }
    }
}

/// Writes files to a folder, together or not at all.
fn export(folder: &Path, files: &[OutputFile]) -> FileAnswer {
    let kept = Folder::new(folder).and_then(|folder| {
        let mut batch = folder.batch()?;
        files.iter().try_for_each(|file| batch.add(&file.name, &file.bytes))?;
        batch.keep()
    });
    match kept {
        Ok(()) => FileAnswer::Exported { count: files.len(), folder: folder.display().to_string() },
        Err(error) => FileAnswer::Failed(in_words(&error)),
    }
}

fn in_words(error: &WriteError) -> String {
    format!("{error}. {}", error.hint)
}
