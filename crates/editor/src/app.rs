//! The window: bars, panes and pages around the [`Editor`], the same on the desktop and in a
//! browser.

mod files;
mod kept;

use crate::bars;
use crate::command::Command;
use crate::document::Draft;
use crate::editor::{Coming, Editor, Next, Page, Source, Zoom};
use crate::engine::Wake;
use crate::io::{Dialogs, SystemDialogs};
use crate::layout::{Panes, bar_frame};
use crate::pages::calibrate::CalibratePage;
use crate::pages::export::ExportPage;
use crate::pages::keys::keys_ui;
use crate::pages::palette::Palette;
use crate::pages::start::{Offers, StartAct, StartPage};
use crate::pages::tour::Tour;
use crate::pages::typed::TypedPath;
use crate::pages::unit::unit_ui;
use crate::pages::unsaved::unsaved_ui;
use crate::pages::vary::{VaryAct, VaryPage};
use crate::panes::plan::PlanPane;
use crate::panes::space::SpacePane;
use crate::room::Room;
use crate::scene::Act;
use crate::store::Store;
use crate::theme::{Look, Theme};
use eframe::egui::{self, Event, Panel, SurrenderFocusOn, Ui, ViewportCommand};
use kept::Kept;
use std::sync::Arc;
use web_time::Duration;

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
    /// A path that is typed, where the system has no dialog.
    typed: Option<TypedPath>,
    kept: Kept,
    dressed: Option<(Look, bool)>,
}

/// While something is under way, the window looks again this often.
const LOOK_AGAIN: Duration = Duration::from_millis(50);

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
    pub fn keep_in(&mut self, store: Store) {
        self.kept.begin(store, &mut self.editor);
    }

    /// The window with other dialogs, which keeps nothing by itself.
    pub fn with_dialogs(cc: &eframe::CreationContext<'_>, dialogs: Box<dyn Dialogs>) -> Self {
        Theme::load_fonts(&cc.egui_ctx);
        // Zooming is a command of ours, so that it stands in menus too.
        cc.egui_ctx.options_mut(|options| {
            options.zoom_with_keyboard = false;
            // A press on a handle selects it: what is typed is to be taken before, for what it was
            // meant.
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
            typed: None,
            kept: Kept::default(),
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

    fn dress(&mut self, ctx: &egui::Context) -> &'static Theme {
        let system_is_dark = ctx.system_theme() == Some(egui::Theme::Dark);
        let theme = Theme::of(self.editor.look, system_is_dark);
        if self.dressed != Some((self.editor.look, system_is_dark)) {
            theme.apply(ctx);
            self.dressed = Some((self.editor.look, system_is_dark));
        }
        theme
    }

    /// Keys that mean a command, unless somebody is typing. Esc first closes a menu or a list, then
    /// drops what is typed.
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

    fn start_ui(&mut self, ui: &mut Ui, theme: &'static Theme, acts: &mut Vec<Act>) {
        let offers = Offers {
            recent: self.kept.recent(),
            recovered: &self.kept.recovered_in_words(),
            closed: &self.kept.closed_in_words(),
            back_to: (!self.editor.document().is_blank()).then(|| self.editor.title()),
            notice: self.editor.notice.as_ref(),
        };
        match self.start.ui(ui, theme, &offers, acts) {
            Some(StartAct::Take { document, is_safe }) => {
                let draft = Draft { document: *document, file: None };
                let coming = Coming { draft, is_safe, source: Source::Shape, said: None };
                self.editor.leave_for(Next::Document(Box::new(coming)));
            }
            Some(StartAct::Recent(path)) => self.open_path(&path),
            Some(StartAct::Recover(n)) => self.kept.recover(n, &mut self.editor),
            Some(StartAct::Forget(n)) => self.kept.forget(n, &mut self.editor),
            Some(StartAct::Reopen(n)) => self.kept.reopen(n, &mut self.editor),
            Some(StartAct::Back) => self.editor.page = Page::Panes,
            None => {}
        }
    }

    /// Questions that stand above everything else, which gets no keys meanwhile.
    fn questions_ui(&mut self, ctx: &egui::Context, theme: &'static Theme) {
        if self.typed.is_some() {
            self.typed_ui(ctx, theme);
        } else if self.editor.asks().is_some() {
            if let Some(decision) = unsaved_ui(ctx, &self.editor, theme) {
                self.editor.decide(decision);
            }
        } else {
            return;
        }
        let is_key = |event: &Event| matches!(event, Event::Key { .. } | Event::Text(_));
        ctx.input_mut(|i| i.events.retain(|event| !is_key(event)));
    }

    /// The window closes when nothing is lost by it, or when the person has decided so.
    fn close(&self, ctx: &egui::Context) {
        if self.editor.closes() {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
    }

    fn ask_before_closing(&mut self, ctx: &egui::Context) {
        if self.editor.closes() || !ctx.input(|i| i.viewport().close_requested()) {
            return;
        }
        self.editor.leave_for(Next::Close);
        if !self.editor.closes() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
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
            Page::Unit => {
                let Some(of) = self.editor.unitless() else {
                    self.editor.page = Page::Panes;
                    return;
                };
                let (stays, unit) = unit_ui(ctx, of);
                if unit.is_some() || !stays {
                    self.editor.unit_is(unit);
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
        if let Some((panel, place)) = self.editor.wants_sight.take() {
            self.panes.bring_into_sight(panel, &place);
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

/// Whether a key reaches what its command changes: nothing behind a page, nor what the start page
/// hides.
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
        Page::Export | Page::Vary | Page::Keys | Page::Calibrate | Page::Unit => is_of_window,
    }
}

fn waker(ctx: &egui::Context) -> Wake {
    let ctx = ctx.clone();
    Arc::new(move || ctx.request_repaint())
}

impl eframe::App for App {
    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let theme = self.dress(&ctx);
        let mut acts = Vec::new();
        self.take_file_answers();
        self.take_dropped_files(&ctx);
        self.editor.tick();
        self.editor.room = Room::of(ctx.content_rect().size());
        self.ask_before_closing(&ctx);
        self.questions_ui(&ctx, theme);
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
        files::hover_ui(&ctx, theme);
        self.grant(&ctx);
        // A person who stays with what is not saved comes back to the numbers that were typed.
        if self.editor.took_shape() {
            self.start.close_form();
        }
        self.kept.frame(&ctx, &mut self.editor);
        self.close(&ctx);
        if !self.editor.is_settled() {
            ctx.request_repaint_after(LOOK_AGAIN);
        }
        if let Some(left) = self.editor.notice_ends_in() {
            ctx.request_repaint_after(left);
        }
    }
}
