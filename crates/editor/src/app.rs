//! The window: bars, panes and pages around the [`Editor`], the same on the desktop and in a browser.

use crate::bars;
use crate::command::Command;
use crate::document::Document;
use crate::editor::{Editor, Page, Zoom};
use crate::engine::Wake;
use crate::io::{Dialogs, FileAnswer, SystemDialogs};
use crate::layout::{Panes, bar_frame};
use crate::pages::calibrate::CalibratePage;
use crate::pages::export::ExportPage;
use crate::pages::keys::keys_ui;
use crate::pages::palette::Palette;
use crate::pages::start::{Offers, StartAct, StartPage};
use crate::pages::tour::Tour;
use crate::pages::vary::{VaryAct, VaryPage};
use crate::panes::plan::PlanPane;
use crate::panes::space::SpacePane;
use crate::panes::space::navigation::Navigation;
use crate::room::Room;
use crate::scene::Act;
use crate::store::{Autosave, Recovered, Store};
use crate::theme::{Look, Theme};
use eframe::egui::{self, Panel, SurrenderFocusOn, Ui};
use std::sync::Arc;
use web_time::{Duration, Instant};

/// The window.
pub struct App {
    editor: Editor,
    dialogs: Box<dyn Dialogs>,
    panes: Panes,
    start: StartPage,
    export: ExportPage,
    vary: VaryPage,
    calibrate: CalibratePage,
    palette: Palette,
    tour: Tour,
    /// Whether somebody was typing when the last frame ended.
    was_typing: bool,
    recent: Vec<String>,
    /// Where work and settings are kept, if there is such a place.
    store: Option<Store>,
    autosave: Option<Autosave>,
    /// The version of the document that needs no keeping, as autosave was told last.
    settled: Option<u64>,
    recovered: Vec<Recovered>,
    /// What has come back, until it is kept in the slot of this window: then its own is emptied.
    came_back: Vec<Recovered>,
    /// The settings as they are kept.
    kept: (Look, Navigation),
    dressed: Option<(Look, bool)>,
}

/// While something is under way, the window looks again this often.
const LOOK_AGAIN: Duration = Duration::from_millis(50);
/// Recent files that are offered.
const RECENT: usize = 8;
/// What settings are kept under.
const RECENT_FILES: &str = "recent-files";
const LOOK: &str = "look";
const MOUSE: &str = "mouse";

impl App {
    /// The window with the dialogs of the system.
    pub fn new(cc: &eframe::CreationContext<'_>) -> Self {
        let wake = waker(&cc.egui_ctx);
        let mut app = Self::with_dialogs(cc, Box::new(SystemDialogs::new(wake)));
        match Store::open() {
            Ok(store) => app.keep_in(store),
            Err(error) => app.editor.failed(format!("Work is not kept by itself: {error}")),
        }
        app
    }

    /// Work and settings are kept in a store from now on, and what it holds comes back.
    pub fn keep_in(&mut self, mut store: Store) {
        self.recovered = store.load_all();
        self.recent = store
            .get(RECENT_FILES)
            .map_or(Vec::new(), |text| text.lines().map(str::to_owned).take(RECENT).collect());
        let named = |look: &Look| store.get(LOOK).is_some_and(|name| name == look.name());
        if let Some(look) = Look::ALL.into_iter().find(named) {
            self.editor.look = look;
        }
        let named = |habit: &Navigation| store.get(MOUSE).is_some_and(|name| name == habit.name());
        if let Some(habit) = Navigation::ALL.into_iter().find(named) {
            self.editor.navigation = habit;
        }
        self.kept = (self.editor.look, self.editor.navigation);
        if let Some(warning) = store.warning() {
            self.editor.done(warning.to_owned());
        }
        let version = self.editor.history().version();
        self.autosave = Some(Autosave::new(store.clone(), version));
        self.settled = Some(version);
        self.store = Some(store);
    }

    /// The window with other dialogs, which keeps nothing by itself.
    pub fn with_dialogs(cc: &eframe::CreationContext<'_>, dialogs: Box<dyn Dialogs>) -> Self {
        Theme::load_fonts(&cc.egui_ctx);
        // Zooming is a command of ours, so that it stands in menus too.
        cc.egui_ctx.options_mut(|options| {
            options.zoom_with_keyboard = false;
            // A press on a handle selects it: what is typed is to be taken before, for what it was meant.
            options.input_options.surrender_focus_on = SurrenderFocusOn::Presses;
        });
        Self {
            editor: Editor::new(waker(&cc.egui_ctx)),
            dialogs,
            panes: Panes::new(cc),
            start: StartPage::default(),
            export: ExportPage::default(),
            vary: VaryPage::default(),
            calibrate: CalibratePage::default(),
            palette: Palette::default(),
            tour: Tour::default(),
            was_typing: false,
            recent: Vec::new(),
            store: None,
            autosave: None,
            settled: None,
            recovered: Vec::new(),
            came_back: Vec::new(),
            kept: (Look::default(), Navigation::default()),
            dressed: None,
        }
    }

    /// What is edited.
    pub fn editor(&self) -> &Editor {
        &self.editor
    }

    /// What is edited, to be changed from outside: by tests, and to open what the program was
    /// started with.
    pub fn editor_mut(&mut self) -> &mut Editor {
        &mut self.editor
    }

    /// How the plan is seen now, and where: for whoever points at it from outside.
    pub fn plan(&self) -> &PlanPane {
        &self.panes.plan
    }

    /// From where space is looked at: likewise.
    pub fn space(&self) -> &SpacePane {
        &self.panes.space
    }

    /// Opens a file by its path.
    pub fn open_path(&mut self, path: &str) {
        match self.dialogs.read(path) {
            Ok(opened) => {
                if self.editor.open(&opened) {
                    self.remember(path);
                }
            }
            Err(text) => self.editor.failed(text),
        }
    }

    fn remember(&mut self, path: &str) {
        // Nobody can open it again by its name alone.
        if cfg!(target_arch = "wasm32") {
            return;
        }
        self.recent.retain(|other| other != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(RECENT);
        let text = self.recent.join("\n");
        self.set(RECENT_FILES, &text);
    }

    /// Keeps a setting; that it can't be kept is no reason to stop anybody.
    fn set(&mut self, name: &str, text: &str) {
        if let Some(store) = &mut self.store {
            let _ = store.set(name, text);
        }
    }

    fn keep_settings(&mut self) {
        let now = (self.editor.look, self.editor.navigation);
        if self.kept != now {
            self.kept = now;
            self.set(LOOK, now.0.name());
            self.set(MOUSE, now.1.name());
        }
    }

    /// Keeps what is not in a file yet.
    fn save_by_itself(&mut self, ctx: &egui::Context) {
        let Some(autosave) = &mut self.autosave else { return };
        let version = self.editor.history().version();
        if !self.editor.is_unsaved() && self.settled != Some(version) {
            autosave.settled(version);
            self.settled = Some(version);
        }
        let document = || {
            let document = self.editor.document().clone();
            Box::new(move || document.bytes()) as crate::store::Job
        };
        if let Some(after) = autosave.frame(version, Instant::now(), document) {
            ctx.request_repaint_after(after);
        }
        if let Some(problem) = autosave.problem() {
            self.editor.failed(format!("Work is not kept by itself: {problem}"));
        } else if autosave.has_kept(version) {
            for found in std::mem::take(&mut self.came_back) {
                self.forget(&found);
            }
        }
    }

    /// What a window left behind comes back.
    fn recover(&mut self, n: usize) {
        let found = self.recovered.remove(n);
        match Document::read("recovered.sheet.json", &found.bytes) {
            Ok(document) => {
                self.editor.replace(document, None);
                self.editor.mark_unsaved();
                self.settled = None;
                self.came_back.push(found);
            }
            Err(text) => self.editor.failed(text),
        }
    }

    fn forget(&mut self, found: &Recovered) {
        if let Some(store) = &mut self.store
            && let Err(error) = store.remove(&found.slot)
        {
            self.editor.failed(error.to_string());
        }
    }

    fn dress(&mut self, ctx: &egui::Context) -> &'static Theme {
        let system_is_dark = ctx.system_theme() == Some(egui::Theme::Dark);
        let theme = Theme::of(self.editor.look, system_is_dark);
        if self.dressed != Some((self.editor.look, system_is_dark)) {
            theme.apply(ctx);
            self.dressed = Some((self.editor.look, system_is_dark));
        }
        theme
    }

    /// Keys that mean a command, unless somebody is typing. Esc first closes a menu or a list, then drops
    /// what is typed.
    fn keys(&self, ctx: &egui::Context, acts: &mut Vec<Act>) {
        let types = ctx.egui_wants_keyboard_input() && ctx.text_edit_focused();
        let lists = egui::Popup::is_any_open(ctx);
        let page = self.editor.page;
        // These have nothing but what is typed.
        let is_of_field = self.was_typing && !matches!(page, Page::Calibrate | Page::Palette);
        // With Shift first: without it, a key means the same with or without.
        let mut all = Command::all();
        all.sort_by_key(|command| !command.key().modifiers.shift);
        for command in all {
            let key = command.key();
            let types_text = !key.modifiers.command && !key.modifiers.alt;
            let is_plain = types_text && key.logical_key != egui::Key::Escape;
            // In a field, these are the field's own.
            let is_of_text = matches!(command, Command::SelectAll | Command::Undo | Command::Redo);
            if is_plain && (types || lists) || is_of_text && types || !reaches(command, page) {
                continue;
            }
            if command == Command::Escape && (lists || is_of_field) {
                continue;
            }
            if ctx.input_mut(|i| i.consume_shortcut(&key)) {
                acts.push(Act::Run(command));
            }
        }
    }

    fn take_file_answers(&mut self) {
        for answer in self.dialogs.answers() {
            match answer {
                FileAnswer::Opened(opened) => {
                    if self.editor.open(&opened) {
                        self.remember(&opened.path);
                    }
                }
                FileAnswer::Picture(opened) => self.editor.trace(opened),
                FileAnswer::Saved { path, version } => {
                    self.remember(&path);
                    self.editor.saved(path, version);
                }
                FileAnswer::Exported { count, folder } => {
                    self.editor.done(format!("{count} files are in {folder}."));
                }
                FileAnswer::Failed(text) => self.editor.failed(text),
            }
        }
    }

    fn start_ui(&mut self, ui: &mut Ui, theme: &'static Theme, acts: &mut Vec<Act>) {
        let recovered: Vec<String> = self.recovered.iter().map(in_words).collect();
        let notice = self.editor.notice.as_ref();
        let offers = Offers { recent: &self.recent, recovered: &recovered, notice };
        match self.start.ui(ui, theme, &offers, acts) {
            Some(StartAct::Take(document)) => {
                self.editor.replace(*document, None);
                self.editor.mark_unsaved();
            }
            Some(StartAct::Recent(path)) => self.open_path(&path),
            Some(StartAct::Recover(n)) => self.recover(n),
            Some(StartAct::Forget(n)) => {
                let found = self.recovered.remove(n);
                self.forget(&found);
            }
            None => {}
        }
    }

    fn pages_ui(&mut self, ctx: &egui::Context, theme: &'static Theme, acts: &mut Vec<Act>) {
        let page = self.editor.page;
        let stays = match page {
            Page::Start | Page::Panes => true,
            Page::Export => {
                let (stays, formats) = self.export.ui(ctx, &self.editor, theme);
                if let Some(formats) = formats {
                    self.editor.export(formats);
                }
                stays
            }
            Page::Vary => {
                let (stays, act) = self.vary.ui(ctx, &self.editor, theme, acts);
                match act {
                    Some(VaryAct::Move(vary)) => self.editor.vary(*vary),
                    Some(VaryAct::End { accept }) => self.editor.end_vary(accept),
                    None => {}
                }
                stays
            }
            Page::Palette => self.palette.ui(ctx, &self.editor, theme, acts),
            Page::Tour => self.tour.ui(ctx, &self.editor, theme, acts),
            Page::Keys => keys_ui(ctx, theme),
            Page::Calibrate => {
                let (stays, distance) = self.calibrate.ui(ctx, &self.editor, theme);
                if let Some(mm) = distance {
                    self.editor.calibrated(mm);
                }
                stays
            }
        };
        // What was chosen on a page may have opened another.
        if !stays && self.editor.page == page {
            self.editor.page = Page::Panes;
        }
        if page != Page::Palette {
            self.palette.close();
        }
        if page != Page::Calibrate {
            self.calibrate.close();
        }
    }

    /// What the editor wants of the window.
    fn grant(&mut self, ctx: &egui::Context) {
        for wish in std::mem::take(&mut self.editor.wishes) {
            self.dialogs.grant(wish);
        }
        if std::mem::take(&mut self.editor.wants_fit) {
            self.panes.fit();
        }
        if let Some((panel, rung)) = self.editor.wants_sight.take() {
            self.panes.bring_into_sight(panel, rung);
        }
        if let Some(zoom) = self.editor.wants_zoom.take() {
            let now = ctx.zoom_factor();
            ctx.set_zoom_factor(match zoom {
                Zoom::In => (now * 1.1).min(3.0),
                Zoom::Out => (now / 1.1).max(0.5),
                Zoom::Normal => 1.0,
            });
        }
    }
}

/// Whether a key reaches what its command changes: nothing behind a page, nor what the start page hides.
fn reaches(command: Command, page: Page) -> bool {
    use Command as C;
    let is_of_window = matches!(
        command,
        C::Escape | C::Stop | C::ZoomIn | C::ZoomOut | C::ZoomReset | C::Look(_) | C::Navigate(_)
    );
    match page {
        Page::Panes | Page::Tour => true,
        Page::Start => {
            let begins = matches!(command, C::New | C::Open | C::Draw | C::Select | C::Start);
            let opens = matches!(command, C::Tour | C::Keys | C::Palette | C::Save | C::SaveAs);
            is_of_window || begins || opens
        }
        Page::Palette => matches!(command, C::Escape | C::Stop),
        Page::Export | Page::Vary | Page::Keys | Page::Calibrate => is_of_window,
    }
}

/// `hood, 3 minutes ago`.
fn in_words(found: &Recovered) -> String {
    let name = Document::read("recovered.sheet.json", &found.bytes)
        .map_or_else(|_| "A design that can't be read".to_owned(), |found| found.design.name);
    let Some(age) = found.age else { return name };
    let (count, unit) = match age.as_secs() {
        seconds @ 0..60 => (seconds, "second"),
        seconds @ 60..3600 => (seconds / 60, "minute"),
        seconds @ 3600..86_400 => (seconds / 3600, "hour"),
        seconds => (seconds / 86_400, "day"),
    };
    format!("{name}, {count} {unit}{} ago", if count == 1 { "" } else { "s" })
}

fn waker(ctx: &egui::Context) -> Wake {
    let ctx = ctx.clone();
    Arc::new(move || ctx.request_repaint())
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let theme = self.dress(&ctx);
        let mut acts = Vec::new();
        self.take_file_answers();
        self.editor.tick();
        self.editor.room = Room::of(ctx.content_rect().size());
        self.keys(&ctx, &mut acts);
        let bar = bar_frame(theme);
        if self.editor.page == Page::Start {
            self.panes.let_go(&[], &mut acts);
            self.start_ui(ui, theme, &mut acts);
        } else {
            Panel::top("top").frame(bar).show(ui, |ui| {
                bars::top_ui(ui, &self.editor, theme, &mut acts);
            });
            Panel::bottom("bottom").frame(bar).show(ui, |ui| {
                bars::bottom_ui(ui, &self.editor, theme, &mut acts);
            });
            self.panes.ui(ui, &self.editor, theme, &mut acts);
            self.pages_ui(&ctx, theme, &mut acts);
        }
        for act in acts {
            // Esc ends what the hand has begun before it ends anything else.
            if act == Act::Run(Command::Escape) && self.panes.plan.escape() {
                self.editor.tool = self.panes.plan.tool;
                continue;
            }
            self.editor.carry_out(act);
        }
        if let Some(places) = self.panes.plan.take_calibrated() {
            self.editor.calibrate(places);
        }
        self.was_typing = ctx.text_edit_focused();
        self.grant(&ctx);
        self.keep_settings();
        self.save_by_itself(&ctx);
        if !self.editor.is_settled() {
            ctx.request_repaint_after(LOOK_AGAIN);
        }
    }
}
