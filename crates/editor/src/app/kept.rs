//! What outlasts the window: work that no file has, designs that were closed without being saved,
//! recent files and settings.

use crate::document::Draft;
use crate::editor::{Coming, Editor, Next, Source};
use crate::store::{Autosave, Job, Recovered, Store};
use crate::theme::Look;
use crate::views::Navigation;
use eframe::egui;
use web_time::{Duration, Instant, SystemTime};

/// Recent files that are offered.
const RECENT: usize = 8;
/// Designs that were closed without being saved and are kept: the newest.
const CLOSED: usize = 8;
/// How their slots begin; others are of windows that ended.
const CLOSED_SLOT: &str = "closed-";
/// What settings are kept under.
const RECENT_FILES: &str = "recent-files";
const LOOK: &str = "look";
const MOUSE: &str = "mouse";

/// What outlasts the window. Without a store it lasts as long as the window.
#[derive(Default)]
pub(super) struct Kept {
    /// Where work and settings are kept, if there is such a place.
    store: Option<Store>,
    autosave: Option<Autosave>,
    /// The version of the document that needs no keeping, as autosave was told last.
    settled: Option<u64>,
    /// The paths of recent files, the newest first.
    recent: Vec<String>,
    /// What windows left behind, the newest first.
    recovered: Vec<Left>,
    /// What was closed without being saved, the newest first.
    closed: Vec<Left>,
    /// How many of these this window has kept.
    count: usize,
    /// Slots of what has come back, until it is kept in the slot of this window, or in a file: then
    /// they are emptied.
    came_back: Vec<String>,
    /// The settings as they are kept.
    settings: (Look, Navigation),
}

/// Work that is kept, and since when this window knows of it.
struct Left {
    found: Recovered,
    name: String,
    since: Instant,
}

impl Left {
    fn new(found: Recovered) -> Self {
        let name = Draft::read(&found.bytes).map_or_else(
            |_| "A design that can't be read".to_owned(),
            |it| it.document.design.name,
        );
        Self { found, name, since: Instant::now() }
    }

    /// `hood, 3 minutes ago`.
    fn in_words(&self) -> String {
        let Some(age) = self.found.age else { return self.name.clone() };
        let (count, unit) = match (age + self.since.elapsed()).as_secs() {
            seconds @ 0..60 => (seconds.max(1), "second"),
            seconds @ 60..3600 => (seconds / 60, "minute"),
            seconds @ 3600..86_400 => (seconds / 3600, "hour"),
            seconds => (seconds / 86_400, "day"),
        };
        format!("{}, {count} {unit}{} ago", self.name, if count == 1 { "" } else { "s" })
    }
}

impl Kept {
    /// Keeps everything in a store from now on, and finds what it holds.
    pub(super) fn begin(&mut self, mut store: Store, editor: &mut Editor) {
        let all = store.load_all().into_iter().map(Left::new);
        (self.closed, self.recovered) = all.partition(|left| is_closed(&left.found.slot));
        for oldest in self.closed.split_off(CLOSED.min(self.closed.len())) {
            // What can't be emptied is offered to be let go of once more.
            let _ = store.remove(&oldest.found.slot);
        }
        self.recent = store
            .get(RECENT_FILES)
            .map_or(Vec::new(), |text| text.lines().map(str::to_owned).take(RECENT).collect());
        let named = |look: &Look| store.get(LOOK).is_some_and(|name| name == look.name());
        if let Some(look) = Look::ALL.into_iter().find(named) {
            editor.look = look;
        }
        let named = |habit: &Navigation| store.get(MOUSE).is_some_and(|name| name == habit.name());
        if let Some(habit) = Navigation::ALL.into_iter().find(named) {
            editor.navigation = habit;
        }
        self.settings = (editor.look, editor.navigation);
        if let Some(warning) = store.warning() {
            editor.done(warning.to_owned());
        }
        let version = editor.history().version();
        self.autosave = Some(Autosave::new(store.clone(), version));
        self.settled = Some(version);
        self.store = Some(store);
    }

    /// The paths of recent files, the newest first.
    pub(super) fn recent(&self) -> &[String] {
        &self.recent
    }

    /// What windows left behind, in words.
    pub(super) fn recovered_in_words(&self) -> Vec<String> {
        self.recovered.iter().map(Left::in_words).collect()
    }

    /// What was closed without being saved, in words.
    pub(super) fn closed_in_words(&self) -> Vec<String> {
        self.closed.iter().map(Left::in_words).collect()
    }

    /// What a window left behind comes back.
    pub(super) fn recover(&self, n: usize, editor: &mut Editor) {
        come_back(self.recovered.get(n), editor);
    }

    /// What was closed without being saved comes back.
    pub(super) fn reopen(&self, n: usize, editor: &mut Editor) {
        come_back(self.closed.get(n), editor);
    }

    /// What a window left behind is not needed.
    pub(super) fn forget(&mut self, n: usize, editor: &mut Editor) {
        let slot = self.recovered.remove(n).found.slot;
        self.empty(&slot, editor);
    }

    /// A file was opened or saved.
    pub(super) fn remember(&mut self, path: &str) {
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

    /// To be called at the end of every frame: keeps what has changed.
    pub(super) fn frame(&mut self, ctx: &egui::Context, editor: &mut Editor) {
        for draft in editor.take_dropped() {
            self.put_aside(&draft, editor);
        }
        for source in editor.take_sources() {
            match source {
                Source::Shape => {}
                Source::File(path) => self.remember(&path),
                Source::Slot(slot) => {
                    self.recovered.retain(|left| left.found.slot != slot);
                    self.closed.retain(|left| left.found.slot != slot);
                    self.came_back.push(slot);
                    self.settled = None;
                }
            }
        }
        self.keep_settings(editor);
        self.save_by_itself(ctx, editor);
    }

    /// Keeps a setting; that it can't be kept is no reason to stop anybody.
    fn set(&mut self, name: &str, text: &str) {
        if let Some(store) = &mut self.store {
            let _ = store.set(name, text);
        }
    }

    fn keep_settings(&mut self, editor: &Editor) {
        let now = (editor.look, editor.navigation);
        if self.settings != now {
            self.settings = now;
            self.set(LOOK, now.0.name());
            self.set(MOUSE, now.1.name());
        }
    }

    /// Keeps what is not in a file yet.
    fn save_by_itself(&mut self, ctx: &egui::Context, editor: &mut Editor) {
        let Some(autosave) = &mut self.autosave else { return };
        let version = editor.history().version();
        let is_unsaved = editor.is_unsaved();
        if !is_unsaved && self.settled != Some(version) {
            autosave.settled(version);
            self.settled = Some(version);
        }
        let draft = || {
            let draft = editor.draft();
            Box::new(move || draft.bytes()) as Job
        };
        if let Some(after) = autosave.frame(version, Instant::now(), draft) {
            ctx.request_repaint_after(after);
        }
        if let Some(problem) = autosave.not_put_aside() {
            editor.failed(format!("What was closed last is not kept: {problem}"));
        }
        if let Some(problem) = autosave.problem() {
            editor.failed(format!("Work is not kept by itself: {problem}"));
        } else if autosave.has_kept(version) || !is_unsaved && autosave.rests() {
            for slot in std::mem::take(&mut self.came_back) {
                self.empty(&slot, editor);
            }
        }
    }

    /// Keeps what was closed without being saved, and lets go of the oldest.
    fn put_aside(&mut self, draft: &Draft, editor: &mut Editor) {
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        let own = self.store.as_ref().map_or("here", |store| store.own_slot());
        let slot = format!("{CLOSED_SLOT}{}-{own}-{}", since.as_millis(), self.count);
        self.count += 1;
        let bytes = draft.bytes();
        if let Some(autosave) = &mut self.autosave {
            autosave.put_aside(slot.clone(), bytes.clone());
        }
        let found = Recovered { slot, bytes, age: Some(Duration::ZERO) };
        self.closed.insert(0, Left::new(found));
        for oldest in self.closed.split_off(CLOSED.min(self.closed.len())) {
            self.empty(&oldest.found.slot, editor);
        }
    }

    fn empty(&mut self, slot: &str, editor: &mut Editor) {
        if let Some(store) = &mut self.store
            && let Err(error) = store.remove(slot)
        {
            editor.failed(error.to_string());
        }
    }
}

fn is_closed(slot: &str) -> bool {
    slot.starts_with(CLOSED_SLOT)
}

/// What is kept takes the place of the document, with the name of its file.
fn come_back(left: Option<&Left>, editor: &mut Editor) {
    let Some(left) = left else { return };
    match Draft::read(&left.found.bytes) {
        Ok(draft) => {
            let source = Source::Slot(left.found.slot.clone());
            let coming = Coming { draft, is_safe: false, source, said: None };
            editor.leave_for(Next::Document(Box::new(coming)));
        }
        Err(text) => editor.failed(text),
    }
}
