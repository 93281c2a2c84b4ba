//! The editor without its window: what is edited, what was made of it, and the one place where acts
//! are carried out.

mod commands;
mod files;
mod jobs;
mod leave;
mod notice;

pub use files::{Dropped, FileWish, Opened, Unitless};
pub(crate) use files::{PICTURES, name_of};
pub use jobs::Work;
pub use leave::{Coming, Decision, Next, Source};
pub use notice::Notice;

use crate::document::{Document, Draft, FARTHEST_MM, History, edit};
use crate::document::{Edit, Selection};
use crate::engine::shown::ShownPanel;
use crate::engine::{Engine, Refusal, Varied, Wake};
use crate::panes::plan::Tool;
use crate::room::{Room, WindowPart};
use crate::scene::{Act, Scene};
use crate::theme::{Look, Theme};
use crate::views::Navigation;
use crate::views::SurfaceView;
use jobs::Jobs;
use sheetwright::check::Place;
use sheetwright::math::Point2;
use web_time::Instant;

/// Everything but the window.
pub struct Editor {
    history: History,
    /// What is selected.
    selection: Selection,
    /// The tool of the plan.
    pub tool: Tool,
    /// How surfaces look.
    pub view: SurfaceView,
    /// Whether parallel lines stay parallel in space.
    pub orthographic: bool,
    /// What the buttons of the mouse do in space.
    pub navigation: Navigation,
    /// Which colours.
    pub look: Look,
    /// How much of it all there is room for, as whoever shows it says.
    pub room: Room,
    /// What is seen where there is no room for everything, if there is room for one.
    part: WindowPart,
    /// What is open over the panes.
    pub page: Page,
    /// Whether everything is to be brought into sight.
    pub wants_fit: bool,
    /// A panel and a place on it that are to be brought into sight.
    pub wants_sight: Option<(usize, Place)>,
    /// How much larger or smaller than they were made things are to be, where somebody asked.
    pub wants_zoom: Option<Zoom>,
    /// What was last said to the person.
    pub notice: Option<Notice>,
    /// When it was said, where it is said for a moment only, and of which version of the document.
    said: Option<(Instant, u64)>,
    /// What the app has to ask the system for.
    pub wishes: Vec<FileWish>,
    shown: Vec<ShownPanel>,
    shown_version: u64,
    jobs: Jobs,
    /// The points moved so that the sheet bends, until they are accepted or dropped.
    varied: Option<Result<Box<Varied>, Refusal>>,
    /// Two places of the picture, mm, until their distance is typed.
    calibrated: Option<[Point2; 2]>,
    /// A table that is opened once the person has said in which unit its numbers are.
    unitless: Option<Unitless>,
    /// The name of the file, the version of the document that it holds, and that document, if it is
    /// known: undo comes back to it with another version.
    file: Option<String>,
    saved_version: u64,
    saved_document: Option<Document>,
    /// The version that this document began with.
    first_version: u64,
    /// What takes its place once the person has decided what becomes of work that no file has.
    next: Option<Next>,
    /// What was dropped on the way, until somebody keeps it.
    dropped: Vec<Draft>,
    /// Where documents have come from, until somebody asks.
    sources: Vec<Source>,
    /// Whether the window is to close.
    closes: bool,
}

/// What is open over the panes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Page {
    /// Templates, examples and recent files.
    #[default]
    Start,
    /// Nothing: the panes.
    Panes,
    /// Which files to write.
    Export,
    /// What may move.
    Vary,
    /// Every command by its name.
    Palette,
    /// The five steps.
    Tour,
    /// The keys.
    Keys,
    /// How far two places of the picture are apart.
    Calibrate,
    /// In which unit the numbers of a table are.
    Unit,
}

/// How large things are to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zoom {
    /// Larger.
    In,
    /// Smaller.
    Out,
    /// As they were made.
    Normal,
}

impl Editor {
    /// An editor with an empty document. `wake` is called when there is an answer of the engine.
    pub fn new(wake: Wake) -> Self {
        Self {
            history: History::default(),
            selection: Selection::default(),
            tool: Tool::default(),
            view: SurfaceView::default(),
            orthographic: false,
            navigation: Navigation::default(),
            look: Look::default(),
            room: Room::default(),
            part: WindowPart::default(),
            page: Page::default(),
            wants_fit: true,
            wants_sight: None,
            wants_zoom: None,
            notice: None,
            said: None,
            wishes: Vec::new(),
            shown: Vec::new(),
            shown_version: 0,
            jobs: Jobs::new(Engine::new(wake)),
            varied: None,
            calibrated: None,
            unitless: None,
            file: None,
            saved_version: 0,
            saved_document: Some(Document::default()),
            first_version: 0,
            next: None,
            dropped: Vec::new(),
            sources: Vec::new(),
            closes: false,
        }
    }

    /// The document as it is now.
    pub fn document(&self) -> &Document {
        self.history.now()
    }

    /// Its past and its future.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// What is selected.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// What was last made.
    pub fn shown(&self) -> &[ShownPanel] {
        &self.shown
    }

    /// What moving points has come to, until it is accepted or dropped.
    pub fn varied(&self) -> Option<&Result<Box<Varied>, Refusal>> {
        self.varied.as_ref()
    }

    /// The name of the file, if there is one.
    pub fn file(&self) -> Option<&str> {
        self.file.as_deref()
    }

    /// What people know the document by: its file's name without folders, or its own.
    pub fn title(&self) -> &str {
        self.file().map_or(self.document().design.name.as_str(), name_of)
    }

    /// Whether there is something that the file lacks, or that was typed or drawn without one.
    pub fn is_unsaved(&self) -> bool {
        self.saved_version != self.history.version()
            && self.saved_document.as_ref() != Some(self.document())
    }

    /// Whether there is something that no file has: also a shape as it was offered.
    pub fn is_in_no_file(&self) -> bool {
        self.is_unsaved() || self.file.is_none() && !self.document().is_blank()
    }

    /// What is being worked at.
    pub fn work(&self) -> Option<Work<'_>> {
        self.jobs.work()
    }

    /// Whether what is shown is what the document makes, to its last sample.
    pub fn is_settled(&self) -> bool {
        self.jobs.is_settled(self.history.version())
    }

    /// Whether it is known, too, where to divide what will not bend.
    pub fn is_advised(&self) -> bool {
        self.jobs.is_advised(self.history.version())
    }

    /// What is seen where there is no room for everything.
    pub fn shown_part(&self) -> WindowPart {
        let is_beside = self.room == Room::Two && self.part == WindowPart::Answer;
        if is_beside { WindowPart::default() } else { self.part }
    }

    /// What panes look at.
    pub fn scene(&self, theme: &'static Theme) -> Scene<'_> {
        Scene {
            document: self.history.now(),
            panels: &self.shown,
            panels_version: self.shown_version,
            selection: &self.selection,
            theme,
        }
    }

    /// Takes the answers of the engine, and asks for what is to be shown next. To be called with
    /// every frame.
    pub fn tick(&mut self) {
        self.take_answers();
        self.end_notice();
        let is_dragging = self.history.is_dragging();
        self.jobs.show(self.history.now(), self.history.version(), is_dragging);
    }

    /// Carries out what a pane answered.
    pub fn carry_out(&mut self, act: Act) {
        match act {
            Act::Run(command) => self.run(command),
            Act::Select(selection) => self.selection = self.cleaned(selection),
            Act::Show(selection) => self.bring_into_sight(selection),
            Act::Move(moved) => {
                let now = self.history.now();
                let before = self.history.before_drag().unwrap_or(now);
                let to = edit::moved(now, before, &moved);
                if !self.refuses_far(&to) {
                    self.history.drag(to);
                }
            }
            Act::Rest => {
                // What crossed no more has its panel within the same step.
                let before = self.history.before_drag();
                if let Some(to) = before.and_then(|b| edit::with_freed(b, self.history.now())) {
                    self.history.drag(to);
                    self.notice = None;
                }
                self.history.rest();
            }
            Act::Edit(edit) => self.edit(&edit),
        }
    }

    /// Another document takes the place of this one, unasked ([`Self::leave_for`] asks); undo does
    /// not bring the other back.
    pub fn replace(&mut self, document: Document, file: Option<String>) {
        self.jobs.forget();
        self.history = History::starting_at(document, self.history.version() + 1);
        self.saved_version = self.history.version();
        self.saved_document = Some(self.document().clone());
        self.first_version = self.saved_version;
        self.file = file;
        self.selection = Selection::default();
        self.shown.clear();
        self.shown_version += 1;
        self.varied = None;
        self.tool = Tool::Select;
        self.page = Page::Panes;
        self.part = WindowPart::Plan;
        self.wants_fit = true;
        self.notice = None;
    }

    /// The document counts as unsaved: what was recovered, or has typed numbers.
    pub fn mark_unsaved(&mut self) {
        self.saved_version = u64::MAX;
        self.saved_document = None;
    }

    fn edit(&mut self, edit: &Edit) {
        let outcome = edit::edited(self.history.now(), edit);
        self.step(outcome);
        if matches!(edit, Edit::Stroke { .. } | Edit::Corners { .. }) && !self.is_refused() {
            // Whoever has drawn wants to take hold of what came out.
            self.tool = Tool::Select;
        }
    }

    fn is_refused(&self) -> bool {
        self.notice.as_ref().is_some_and(|notice| notice.is_refusal)
    }

    /// The document becomes what came out, or why nothing did is said.
    fn step(&mut self, outcome: Result<edit::Edited, String>) {
        match outcome {
            Ok(edit::Edited { document, select, said }) => {
                if !self.becomes(document) {
                    return;
                }
                if let Some(selection) = select {
                    self.selection = selection;
                }
                self.selection = self.cleaned(self.selection.clone());
                self.notice = None;
                if let Some(text) = said {
                    self.say(text);
                }
            }
            Err(text) => self.refuse(text),
        }
    }

    /// The document becomes another: one step of undo. Whether it did: what no file could hold is
    /// refused.
    fn becomes(&mut self, to: Document) -> bool {
        let is_far = self.refuses_far(&to);
        if !is_far {
            self.history.step(to);
        }
        !is_far
    }

    /// Whether something of a document lies too far out for a file, which then is said.
    fn refuses_far(&mut self, to: &Document) -> bool {
        let Some(what) = to.out_of_range() else { return false };
        // A file may hold what is farther out; there it may stay.
        if self.document().out_of_range() == Some(what) {
            return false;
        }
        self.refuse(format!(
            "{what} would lie farther out than {} km. Check the units, the mirror and the numbers.",
            FARTHEST_MM / 1e6
        ));
        true
    }

    /// A selection without what is not there.
    fn cleaned(&self, mut selection: Selection) -> Selection {
        let curves = &self.history.now().design.curves;
        let is_there = |curve: usize| curve < curves.len();
        selection.points.retain(|r| curves.get(r.curve).is_some_and(|c| r.point < c.points.len()));
        selection.points.sort_unstable();
        selection.points.dedup();
        selection.curve = selection.curve.filter(|&curve| is_there(curve));
        selection
    }
}
