//! Files on the desktop: the system's own dialogs, each on a thread, so that the window stays
//! alive.

use super::{Dialogs, FileAnswer, Typed};
use crate::editor::{Dropped, FileWish, Opened};
use crate::engine::Wake;
use eframe::egui::DroppedFileHandle;
use sheetwright_files::{OutputFile, whole::Folder, whole::WriteError, whole::write_one};
use std::cell::Cell;
use std::path::{Path, PathBuf};
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
        listen();
        let (send, answers) = channel();
        Self { send, answers, wake }
    }

    /// Answers on a thread of its own.
    fn answer_later(&self, answer: impl FnOnce() -> Option<FileAnswer> + Send + 'static) {
        let (send, wake) = (self.send.clone(), self.wake.clone());
        let work = move || {
            if let Some(answer) = answer() {
                // Nobody listens once the window is closed.
                let _ = send.send(answer);
            }
            wake();
        };
        let thread = std::thread::Builder::new().name("dialog".to_owned()).spawn(work);
        if thread.is_err() {
            let text = "The system has no room for a dialog. Close something and try again.";
            let _ = self.send.send(FileAnswer::Failed(text.to_owned()));
        }
    }
}

impl Dialogs for SystemDialogs {
    fn grant(&mut self, wish: FileWish) {
        self.answer_later(move || granted(wish));
    }

    fn answers(&mut self) -> Vec<FileAnswer> {
        self.answers.try_iter().collect()
    }

    fn grant_at(&mut self, wish: &FileWish, path: &str, replaces: bool) -> Typed {
        granted_at(wish, typed_path(path), replaces)
    }

    fn read_dropped(&mut self, files: Vec<DroppedFileHandle>) {
        self.answer_later(move || Some(FileAnswer::Dropped(read_dropped(&files))));
    }

    fn read(&mut self, path: &str) -> Result<Opened, String> {
        opened(Path::new(path))
    }
}

/// Files that were dropped on the window.
pub fn read_dropped(files: &[DroppedFileHandle]) -> Vec<Dropped> {
    let read = |file: &DroppedFileHandle| Dropped {
        path: file.path().display().to_string(),
        bytes: file.bytes(),
    };
    files.iter().map(read).collect()
}

fn opened(path: &Path) -> Result<Opened, String> {
    let shown = path.display().to_string();
    match std::fs::read(path) {
        Ok(bytes) => Ok(Opened { path: shown, bytes }),
        Err(error) => Err(format!("{shown} can't be read: {error}.")),
    }
}

/// What comes of a wish; nothing if the person changes his mind.
fn granted(wish: FileWish) -> Option<FileAnswer> {
    if let FileWish::Save { to: Some(to), .. } = &wish {
        return Some(done_at(&wish, Path::new(to)));
    }
    NO_DIALOG.set(false);
    match chosen(&wish) {
        Some(path) => Some(done_at(&wish, &path)),
        None if NO_DIALOG.get() => Some(FileAnswer::NoDialog { wish, folder: folder() }),
        None => None,
    }
}

/// The path that the person chooses in a dialog of the system.
fn chosen(wish: &FileWish) -> Option<PathBuf> {
    let dialog = rfd::FileDialog::new();
    match wish {
        FileWish::Open => {
            dialog.add_filter("Designs, tables and meshes", &super::OPENED).pick_file()
        }
        FileWish::Picture => dialog.add_filter("Pictures", &crate::editor::PICTURES).pick_file(),
        FileWish::Save { name, .. } => {
            dialog.add_filter("Designs", &["json"]).set_file_name(name).save_file()
        }
        FileWish::Export(_) => dialog.set_title("Where to put the files").pick_folder(),
    }
}

/// What comes of a wish with this path.
fn done_at(wish: &FileWish, path: &Path) -> FileAnswer {
    let or_failed = |opened: Result<Opened, String>, answer: fn(Opened) -> FileAnswer| {
        opened.map_or_else(FileAnswer::Failed, answer)
    };
    match wish {
        FileWish::Open => or_failed(opened(path), FileAnswer::Opened),
        FileWish::Picture => or_failed(opened(path), FileAnswer::Picture),
        FileWish::Save { bytes, version, .. } => match write_one(path, bytes) {
            Ok(()) => FileAnswer::Saved { path: path.display().to_string(), version: *version },
            Err(error) => FileAnswer::Failed(in_words(&error)),
        },
        FileWish::Export(files) => export(path, files),
    }
}

/// What comes of a wish with a typed path.
fn granted_at(wish: &FileWish, mut path: PathBuf, replaces: bool) -> Typed {
    if let FileWish::Save { name, .. } = wish {
        if path.is_dir() {
            path.push(name);
        } else if path.extension().is_none_or(|ending| ending != "json") {
            path.as_mut_os_string().push(".sheet.json");
        }
    }
    if !replaces && let Some(is_there) = in_the_way(wish, &path) {
        return is_there;
    }
    match done_at(wish, &path) {
        FileAnswer::Failed(text) => Typed::Failed(text),
        answer => Typed::Granted(answer),
    }
}

/// The files that a wish would replace at this path, if there are any.
fn in_the_way(wish: &FileWish, path: &Path) -> Option<Typed> {
    let all = match wish {
        FileWish::Open | FileWish::Picture => Vec::new(),
        FileWish::Save { .. } => vec![path.to_owned()],
        FileWish::Export(files) => files.iter().map(|file| path.join(&file.name)).collect(),
    };
    // A folder of this name is never replaced: writing says so.
    let is_file = |path: &&PathBuf| path.exists() && !path.is_dir();
    let there: Vec<&PathBuf> = all.iter().filter(is_file).collect();
    let first = there.first()?.display().to_string();
    Some(Typed::IsThere { first, count: there.len() })
}

/// A typed path: `~` is the folder of the person, and what begins nowhere begins where the program
/// runs.
fn typed_path(text: &str) -> PathBuf {
    let text = text.trim();
    let of_home = text.strip_prefix('~').filter(|rest| rest.is_empty() || rest.starts_with('/'));
    let path = match (of_home, dirs::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest.trim_start_matches('/')),
        _ => PathBuf::from(text),
    };
    std::path::absolute(&path).unwrap_or(path)
}

/// The folder that a typed path may begin with: the one that the program runs in.
fn folder() -> String {
    let here = std::env::current_dir().ok().or_else(dirs::home_dir);
    here.map_or(String::new(), |here| here.join("").display().to_string())
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

thread_local! {
    /// Whether the last dialog of this thread could not be shown at all.
    static NO_DIALOG: Cell<bool> = const { Cell::new(false) };
}

/// `rfd` gives the same answer whether a person changes his mind or there is nothing to show a
/// dialog with, neither a portal nor zenity; only its log tells. It logs on the thread that asks.
struct Listener;

impl log::Log for Listener {
    fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
        metadata.level() == log::Level::Error && metadata.target().starts_with("rfd")
    }

    fn log(&self, record: &log::Record<'_>) {
        // What fails before it, the portal, has zenity to stand in for it.
        if self.enabled(record.metadata()) && record.args().to_string().contains("with zenity") {
            NO_DIALOG.set(true);
        }
    }

    fn flush(&self) {}
}

/// Listens to what `rfd` logs, unless a logger is there already.
fn listen() {
    if log::set_logger(&Listener).is_ok() {
        log::set_max_level(log::LevelFilter::Error);
    }
}
