//! What the engine is asked for, and what it answers.

use super::{Editor, Page};
use crate::document::Document;
use crate::document::Selection;
use crate::engine::shown::ShownPanel;
use crate::engine::{Answer, Detail, Engine, Job};
use sheetwright::check::{Finding, Place, Verdict};
use sheetwright::design::{Design, Vary};
use sheetwright::watch::Stage;
use sheetwright_files::Format;
use std::sync::Arc;
use web_time::{Duration, Instant};

/// The hand rests when nothing has changed for so long.
const REST: Duration = Duration::from_millis(140);
/// What takes longer than this is shown at work.
const NOTICED: Duration = Duration::from_millis(250);

/// The jobs under way.
pub(super) struct Jobs {
    engine: Engine,
    next: u64,
    /// What was asked for in either detail and not answered yet, the last one last.
    asked: [Vec<Asked>; 2],
    /// The version whose panels are shown, and how fine they are.
    shown: Option<(u64, Detail)>,
    /// Where to divide what is shown.
    advice: Advice,
    changed: Instant,
    seen_version: Option<u64>,
    /// A long job: its number, what it is, since when, and how far it is.
    long: Option<Long>,
    /// The version of the document whose points are being moved.
    varied_version: u64,
    /// The exports whose files are awaited.
    exports: Vec<u64>,
}

#[derive(Clone, Copy)]
struct Asked {
    number: u64,
    version: u64,
}

/// How far it is known where to divide panels that will not bend.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Advice {
    /// It is to be asked for.
    #[default]
    Open,
    /// It is asked for.
    Asked(u64),
    /// All of it is there.
    Known,
}

struct Long {
    number: u64,
    /// Whether it is for what is shown.
    shows: bool,
    text: String,
    /// The stage that it has told.
    stage: Option<Stage>,
    done: f64,
    since: Instant,
}

/// What is being worked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work<'a> {
    /// In words.
    pub text: &'a str,
    /// The part that is done, 0 ..= 1.
    pub done: f64,
}

impl Jobs {
    pub(super) fn new(engine: Engine) -> Self {
        Self {
            engine,
            next: 0,
            asked: Default::default(),
            shown: None,
            advice: Advice::Open,
            changed: Instant::now(),
            seen_version: None,
            long: None,
            varied_version: 0,
            exports: Vec::new(),
        }
    }

    pub(super) fn is_settled(&self, version: u64) -> bool {
        self.shown == Some((version, Detail::Full)) && self.long.is_none()
    }

    pub(super) fn is_advised(&self, version: u64) -> bool {
        self.is_settled(version) && self.advice == Advice::Known
    }

    pub(super) fn work(&self) -> Option<Work<'_>> {
        let long = self.long.as_ref().filter(|long| long.since.elapsed() > NOTICED)?;
        Some(Work { text: &long.text, done: long.done })
    }

    pub(super) fn stop(&mut self) {
        let goes_on = self.engine.stop();
        // An export goes on with the layout that there is.
        let is_export = |long: &Long| self.exports.contains(&long.number);
        match self.long.as_mut().filter(|long| goes_on && is_export(long)) {
            Some(long) if long.stage == Some(Stage::Nest) => {
                "Writing files with the layout so far".clone_into(&mut long.text);
            }
            _ => self.long = None,
        }
        self.asked[Detail::Full as usize].clear();
        // Where it waited, it is asked for again.
        if self.advice != Advice::Known {
            self.advice = Advice::Open;
        }
    }

    /// Stops, and takes no answer to what was asked before: for another document.
    pub(super) fn forget(&mut self) {
        self.engine.stop_all();
        self.long = None;
        self.exports.clear();
        self.asked = Default::default();
        self.advice = Advice::Open;
    }

    /// Asks for the panels of a document as far as they are not shown: coarse ones at once, and the
    /// full ones when the hand rests. When these are shown, asks where to divide them.
    pub(super) fn show(&mut self, document: &Document, version: u64, is_dragging: bool) {
        if self.seen_version != Some(version) {
            self.seen_version = Some(version);
            self.changed = Instant::now();
        }
        let is_asked = |asked: &[Asked]| asked.last().is_some_and(|last| last.version == version);
        let rests = !is_dragging || self.changed.elapsed() >= REST;
        if self.shown == Some((version, Detail::Full)) {
            self.advise(document);
            return;
        }
        if is_asked(&self.asked[1]) {
            return;
        }
        let is_coarse = self.shown == Some((version, Detail::Coarse)) || is_asked(&self.asked[0]);
        let detail = match (is_coarse, rests) {
            (false, _) => Detail::Coarse,
            (true, true) => Detail::Full,
            (true, false) => return,
        };
        let design = Arc::new(document.design.clone());
        let number = self.number();
        self.asked[detail as usize].push(Asked { number, version });
        match detail {
            // What was asked for at rest is outdated.
            Detail::Coarse => _ = self.long.take_if(|long| long.shows),
            Detail::Full => self.begin(number, true, "Working out the panels"),
        }
        self.engine.ask(Job::Show { number, design, detail });
    }

    /// Asks where to divide panels, as far as that is not known. It is not said that this is looked
    /// for: nobody need wait for it.
    fn advise(&mut self, document: &Document) {
        if self.advice == Advice::Open {
            let number = self.number();
            self.advice = Advice::Asked(number);
            self.engine.ask(Job::Advise { number, design: Arc::new(document.design.clone()) });
        }
    }

    fn number(&mut self) -> u64 {
        self.next += 1;
        self.next
    }

    fn begin(&mut self, number: u64, shows: bool, text: &str) {
        let (text, since) = (text.to_owned(), Instant::now());
        self.long = Some(Long { number, shows, text, stage: None, done: 0.0, since });
    }

    fn end(&mut self, number: u64) {
        self.long.take_if(|long| long.number <= number);
    }

    pub(super) fn vary(&mut self, design: Design, version: u64) {
        self.varied_version = version;
        let number = self.number();
        self.begin(number, false, "Moving points");
        self.engine.ask(Job::Vary { number, design: Arc::new(design) });
    }

    pub(super) fn export(&mut self, design: Design, formats: Vec<Format>) {
        let number = self.number();
        self.exports.push(number);
        self.begin(number, false, "Writing files");
        self.engine.ask(Job::Export { number, design: Arc::new(design), formats });
    }
}

impl Editor {
    pub(super) fn take_answers(&mut self) {
        for answer in self.jobs.engine.answers() {
            match answer {
                Answer::Shown { number, detail, panels } => {
                    // Where the hand is faster than the answers, one to an older question is still
                    // newer than what is shown.
                    let all = &mut self.jobs.asked[detail as usize];
                    let Some(n) = all.iter().position(|asked| asked.number == number) else {
                        continue;
                    };
                    let asked = all[n];
                    all.drain(..=n);
                    if detail == Detail::Full {
                        self.jobs.end(number);
                    }
                    let is_newer = self.jobs.shown.is_none_or(|(version, fineness)| {
                        version < asked.version
                            || version == asked.version && fineness == Detail::Coarse
                    });
                    if is_newer {
                        self.jobs.shown = Some((asked.version, detail));
                        let may_help = panels.iter().any(will_not_bend);
                        self.jobs.advice = if may_help { Advice::Open } else { Advice::Known };
                        self.show(panels);
                    }
                }
                Answer::Advised { number, advice, is_over } => {
                    if self.jobs.advice == Advice::Asked(number) {
                        self.jobs.advice = if is_over { Advice::Known } else { Advice::Open };
                        self.advised(advice);
                    }
                }
                Answer::Varied { number, outcome } => {
                    self.jobs.end(number);
                    if self.jobs.varied_version == self.history.version() {
                        self.varied = Some(outcome);
                        self.page = Page::Vary;
                    } else {
                        self.say("The drawing has changed meanwhile: try again.");
                    }
                }
                Answer::Files { number, outcome } => {
                    self.jobs.end(number);
                    let Some(n) = self.jobs.exports.iter().position(|it| *it == number) else {
                        continue;
                    };
                    self.jobs.exports.remove(n);
                    match outcome {
                        Ok(files) => self.wishes.push(super::FileWish::Export(files)),
                        Err(refusal) => {
                            self.refuse(format!("{} {}", refusal.message, refusal.hint));
                        }
                    }
                }
                Answer::Progress { number, stage, text, done } => {
                    if let Some(long) = self.jobs.long.as_mut().filter(|l| l.number == number) {
                        (long.stage, long.text, long.done) = (Some(stage), text, done);
                    }
                }
            }
        }
    }

    /// Adds to panels where to divide them.
    fn advised(&mut self, advice: Vec<(String, Finding)>) {
        for (name, finding) in advice {
            let part = self.shown.iter_mut().find(|part| part.name == name);
            if let Some(Ok(made)) = part.map(|part| &mut part.made)
                && made.add(finding)
            {
                self.shown_version += 1;
            }
        }
    }

    fn show(&mut self, panels: Vec<ShownPanel>) {
        self.shown = panels;
        self.shown_version += 1;
        let Selection { panel, place, .. } = &mut self.selection;
        let shown = panel.and_then(|n| self.shown.get(n)?.made.as_ref().ok());
        if !shown.is_some_and(|shown| shown.has(place)) {
            *place = Place::Whole;
        }
        if panel.is_some_and(|panel| panel >= self.shown.len()) {
            *panel = None;
        }
    }

    /// Moves points so that the sheet bends.
    pub fn vary(&mut self, vary: Vary) {
        let mut design = self.document().design.clone();
        design.vary = vec![vary];
        self.varied = None;
        self.jobs.vary(design, self.history.version());
    }

    /// Points stay where moving has brought them, as one step of undo; or they are dropped.
    pub fn end_vary(&mut self, accept: bool) {
        let is_of_now = self.jobs.varied_version == self.history.version();
        let moved = match self.varied.take() {
            Some(Ok(varied)) if accept && is_of_now => varied.moved,
            _ => None,
        };
        if let Some(mut moved) = moved {
            moved.vary.clear();
            let mut document = self.document().clone();
            document.design = moved;
            if self.becomes(document) {
                self.say("The points stay where they were moved; undo takes them back.");
            }
        }
        self.page = Page::Panes;
    }

    /// Asks for the files of the formats.
    pub fn export(&mut self, formats: Vec<Format>) {
        let design = self.document().design.clone();
        self.page = Page::Panes;
        self.jobs.export(design, formats);
    }
}

fn will_not_bend(panel: &ShownPanel) -> bool {
    panel.made.as_ref().is_ok_and(|made| made.verdict == Verdict::WillNotBend)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::PointRef;
    use crate::engine::tests::saddles;
    use crate::scene::Act;

    fn editor_with(design: Design) -> Editor {
        let mut editor = Editor::new(Arc::new(|| {}));
        editor.replace(Document { design, ..Document::default() }, None);
        editor
    }

    /// Moves a handle a little, as a frame does.
    fn moves(editor: &mut Editor, n: usize) {
        let mut to = editor.document().design.curves[0].points[0].at;
        to.z += if n.is_multiple_of(2) { 0.01 } else { -0.01 };
        editor.carry_out(Act::Move(vec![(PointRef { curve: 0, point: 0 }, to)]));
        editor.tick();
        std::thread::sleep(Duration::from_millis(1));
    }

    #[test]
    fn panels_follow_a_hand_that_is_faster_than_the_answers() {
        let mut editor = editor_with(saddles(10, 96, 40.0));
        let begun = Instant::now();
        let first = editor.shown_version;
        let mut n = 0;
        while editor.shown_version < first + 5 && begun.elapsed() < Duration::from_secs(20) {
            moves(&mut editor, n);
            n += 1;
        }
        assert!(editor.shown_version >= first + 5, "{} of {n}", editor.shown_version - first);
    }

    #[test]
    fn another_document_gets_no_answer_that_was_meant_for_the_last() {
        let mut editor = editor_with(saddles(10, 96, 40.0));
        for n in 0..20 {
            moves(&mut editor, n);
        }
        editor.replace(Document::default(), None);
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_millis(300) {
            editor.tick();
            assert!(editor.shown().is_empty());
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}
