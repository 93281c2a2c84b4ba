//! Hands for tests: they point, draw and type as a person does, and files go to memory.

#![allow(dead_code, clippy::unwrap_used)] // each test uses some of it, and tests panic

use eframe::egui::accesskit::Role;
use eframe::egui::{DroppedFileHandle, Event, Key, Modifiers, PointerButton, Pos2, Vec2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use sheetwright::math::Point2;
use sheetwright_editor::app::App;
use sheetwright_editor::command::Command;
use sheetwright_editor::editor::{Editor, FileWish, Opened};
use sheetwright_editor::io::{Dialogs, FileAnswer, Typed, read_dropped};
use sheetwright_editor::scene::Act;
use sheetwright_files::OutputFile;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Files in memory.
#[derive(Default)]
pub(crate) struct Disk {
    /// What was exported last.
    pub(crate) exported: Vec<OutputFile>,
    /// What was saved last.
    pub(crate) saved: Vec<u8>,
    /// What is chosen when somebody is asked for a file.
    pub(crate) to_open: Option<Opened>,
    /// Where somebody who is asked chooses not to save after all.
    pub(crate) saves_nothing: bool,
    /// Where the system has no dialogs: paths are typed, and these are there.
    pub(crate) paths: Option<Vec<String>>,
    answers: Vec<FileAnswer>,
}

/// Dialogs that choose at once.
pub(crate) struct Chosen(pub(crate) Arc<Mutex<Disk>>);

impl Dialogs for Chosen {
    fn grant(&mut self, wish: FileWish) {
        let mut disk = self.0.lock().unwrap();
        let is_known = matches!(wish, FileWish::Save { to: Some(_), .. });
        if disk.paths.is_some() && !is_known {
            disk.answers.push(FileAnswer::NoDialog { wish, folder: "/home/".to_owned() });
            return;
        }
        let answer = match wish {
            FileWish::Save { to: None, .. } if disk.saves_nothing => None,
            FileWish::Open => disk.to_open.take().map(FileAnswer::Opened),
            FileWish::Picture => disk.to_open.take().map(FileAnswer::Picture),
            FileWish::Save { to, name, bytes, version } => {
                disk.saved = bytes;
                Some(FileAnswer::Saved { path: to.unwrap_or(name), version })
            }
            FileWish::Export(files) => {
                disk.exported = files;
                let count = disk.exported.len();
                Some(FileAnswer::Exported { count, folder: "memory".to_owned() })
            }
        };
        disk.answers.extend(answer);
    }

    fn answers(&mut self) -> Vec<FileAnswer> {
        std::mem::take(&mut self.0.lock().unwrap().answers)
    }

    fn grant_at(&mut self, wish: &FileWish, path: &str, replaces: bool) -> Typed {
        let mut disk = self.0.lock().unwrap();
        let has = |path: &str| disk.paths.iter().flatten().any(|other| other == path);
        let is_there = has(path);
        let in_folder = |file: &OutputFile| format!("{path}/{}", file.name);
        let there: Vec<String> = match wish {
            FileWish::Export(files) => files.iter().map(in_folder).filter(|at| has(at)).collect(),
            FileWish::Save { .. } if is_there => vec![path.to_owned()],
            _ => Vec::new(),
        };
        if let (false, Some(first)) = (replaces, there.first()) {
            return Typed::IsThere { first: first.clone(), count: there.len() };
        }
        match wish {
            FileWish::Open | FileWish::Picture if !is_there => {
                Typed::Failed(format!("{path} is not there."))
            }
            FileWish::Open => Typed::Granted(FileAnswer::Opened(disk.to_open.take().unwrap())),
            FileWish::Picture => Typed::Granted(FileAnswer::Picture(disk.to_open.take().unwrap())),
            FileWish::Save { bytes, version, .. } => {
                disk.saved.clone_from(bytes);
                Typed::Granted(FileAnswer::Saved { path: path.to_owned(), version: *version })
            }
            FileWish::Export(files) => {
                disk.exported.clone_from(files);
                let (count, folder) = (files.len(), path.to_owned());
                Typed::Granted(FileAnswer::Exported { count, folder })
            }
        }
    }

    fn read_dropped(&mut self, files: Vec<DroppedFileHandle>) {
        self.0.lock().unwrap().answers.push(FileAnswer::Dropped(read_dropped(&files)));
    }

    fn read(&mut self, path: &str) -> Result<Opened, String> {
        let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
        Ok(Opened { path: path.to_owned(), bytes })
    }
}

/// A window with hands.
pub(crate) struct Hands {
    /// The window.
    pub(crate) harness: Harness<'static, App>,
    /// Its files.
    pub(crate) disk: Arc<Mutex<Disk>>,
    /// How often a button of the mouse was pressed.
    pub(crate) clicks: usize,
    /// How many keys were pressed.
    pub(crate) keys: usize,
}

impl Hands {
    /// A window of this size, drawn by the graphics card if `drawn`.
    pub(crate) fn new(size: [f32; 2], drawn: bool) -> Self {
        let disk = Arc::new(Mutex::new(Disk::default()));
        let its = disk.clone();
        let builder = Harness::builder().with_size(Vec2::from(size)).with_step_dt(1.0 / 60.0);
        let builder = if drawn { builder.wgpu() } else { builder };
        let harness =
            builder.build_eframe(move |cc| App::with_dialogs(cc, Box::new(Chosen(its.clone()))));
        Self { harness, disk, clicks: 0, keys: 0 }
    }

    /// The window.
    pub(crate) fn app(&self) -> &App {
        self.harness.state()
    }

    /// A frame.
    pub(crate) fn step(&mut self) {
        self.harness.step();
    }

    /// Saves the document, and exports its files into a folder.
    pub(crate) fn save_and_export(&mut self) {
        self.key(Modifiers::COMMAND, Key::S);
        self.step();
        self.key(Modifiers::COMMAND, Key::E);
        self.click("Choose a folder…");
        self.settle();
    }

    /// Frames until everything is worked out.
    pub(crate) fn settle(&mut self) {
        self.frames_until(Editor::is_settled);
    }

    /// Frames until it is known, too, where to divide what will not bend.
    pub(crate) fn advise(&mut self) {
        self.frames_until(Editor::is_advised);
    }

    fn frames_until(&mut self, is_it: impl Fn(&Editor) -> bool) {
        let start = Instant::now();
        loop {
            self.step();
            if is_it(self.app().editor()) {
                self.step();
                return;
            }
            assert!(start.elapsed() < Duration::from_secs(120), "it never settles");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// A command by its name.
    pub(crate) fn run(&mut self, command: Command) {
        self.harness.state_mut().editor_mut().carry_out(Act::Run(command));
        self.step();
        self.step();
    }

    /// A key.
    pub(crate) fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.keys += 1;
        self.harness.key_press_modifiers(modifiers, key);
        self.step();
        self.step();
    }

    /// Whether something of this name, or with this in its name, is seen.
    pub(crate) fn sees(&self, label: &str) -> bool {
        self.harness.query_all_by_label_contains(label).next().is_some()
    }

    /// Clicks on what has this name.
    pub(crate) fn click(&mut self, label: &str) {
        self.clicks += 1;
        self.harness.get_by_label(label).click();
        self.step();
        self.step();
    }

    /// Where a place of the plan lies on the screen.
    pub(crate) fn on_plan(&self, x: f64, y: f64) -> Pos2 {
        self.app().plan().on_screen(Point2::new(x, y))
    }

    /// Presses the button.
    pub(crate) fn press(&mut self, at: Pos2) {
        self.clicks += 1;
        self.harness.event(Event::PointerMoved(at));
        self.step();
        self.button(at, true);
    }

    /// Moves the hand: a frame.
    pub(crate) fn move_to(&mut self, at: Pos2) {
        self.harness.event(Event::PointerMoved(at));
        self.step();
    }

    /// Lets go.
    pub(crate) fn release(&mut self, at: Pos2) {
        self.button(at, false);
        self.step();
    }

    fn button(&mut self, pos: Pos2, pressed: bool) {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        self.harness.event(Event::PointerButton { pos, button, pressed, modifiers });
        self.step();
    }

    /// Presses the button, moves along, and lets go: a frame each.
    pub(crate) fn drag(&mut self, way: &[Pos2]) {
        self.press(way[0]);
        for &at in &way[1..] {
            self.move_to(at);
        }
        self.release(way[way.len() - 1]);
    }

    /// Types into the field of this name.
    pub(crate) fn type_into(&mut self, label: &str, text: &str) {
        let field = |harness: &Harness<'static, App>| {
            harness
                .query_all_by_label(label)
                .find(|node| node.accesskit_node().role() == Role::TextInput)
                .map(|node| node.rect().center())
        };
        let at = field(&self.harness).unwrap_or_else(|| panic!("no field {label}"));
        // A click into a field selects what it holds; two that follow one another quickly, a word.
        self.harness.run_steps(30);
        self.drag(&[at, at]);
        self.keys += text.chars().count();
        self.harness.event(Event::Text(text.to_owned()));
        self.step();
        self.key(Modifiers::NONE, Key::Enter);
    }
}

/// A picture of 200 × 100 pixels, as a PNG of this path.
pub(crate) fn picture(path: &str) -> Opened {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(200, 100).write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    Opened { path: path.to_owned(), bytes: bytes.into_inner() }
}

/// A round way of the hand about a place of the screen, with a little tremor.
pub(crate) fn round(centre: Pos2, radii: Vec2, steps: usize) -> Vec<Pos2> {
    let at = |n: usize| {
        let angle = n as f32 / steps as f32 * std::f32::consts::TAU;
        let tremor = (n as f32 * 1.7).sin() * 0.6;
        pos2(
            centre.x + (radii.x + tremor) * angle.cos(),
            centre.y - (radii.y + tremor) * angle.sin(),
        )
    };
    (0..=steps).map(at).collect()
}
