//! What happens before another document takes the place of one with work that no file has: the
//! person is asked, and what waits goes on once the work is saved or dropped. What is dropped is
//! handed to whoever keeps things, so that it can be had back.

use super::Editor;
use crate::document::{Document, Draft};
use crate::panes::plan::Tool;

/// What comes after the document.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// An empty one, to be drawn on.
    Blank,
    /// Another one.
    Document(Box<Coming>),
    /// Nothing: the window closes.
    Close,
}

/// A document that takes the place of another.
#[derive(Clone, Debug, PartialEq)]
pub struct Coming {
    /// The document, and its file.
    pub draft: Draft,
    /// Whether it is to be had again as it is: from its file, or from the list of shapes.
    pub is_safe: bool,
    /// Where it comes from.
    pub source: Source,
    /// What is to be said once it is there.
    pub said: Option<&'static str>,
}

/// Where a document comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A template or an example.
    Shape,
    /// A file of this name.
    File(String),
    /// This slot of the store.
    Slot(String),
}

/// The answer to the question what is to become of work that no file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decision {
    /// Save it, then go on.
    Save,
    /// Go on without it.
    Drop,
    /// Stay with it.
    Stay,
}

impl Editor {
    /// Something else takes the place of the document: at once, or when the person has decided what
    /// becomes of work that no file has.
    pub fn leave_for(&mut self, next: Next) {
        self.history.rest();
        if self.would_lose() {
            self.next = Some(next);
        } else {
            self.go_on(next);
        }
    }

    /// What waits for the person to decide.
    pub fn asks(&self) -> Option<&Next> {
        self.next.as_ref()
    }

    /// The person has decided. What is to be saved goes on when it is.
    pub fn decide(&mut self, decision: Decision) {
        match decision {
            Decision::Save => self.save(self.file.clone()),
            Decision::Drop => {
                let Some(next) = self.next.take() else { return };
                self.dropped.push(self.draft());
                self.go_on(next);
            }
            Decision::Stay => self.next = None,
        }
    }

    /// What was dropped since the last call, to be kept for a while.
    pub fn take_dropped(&mut self) -> Vec<Draft> {
        std::mem::take(&mut self.dropped)
    }

    /// Where documents have come from since the last call.
    pub fn take_sources(&mut self) -> Vec<Source> {
        std::mem::take(&mut self.sources)
    }

    /// Whether a template or an example has come since [`Self::take_sources`] was called last.
    pub fn took_shape(&self) -> bool {
        self.sources.contains(&Source::Shape)
    }

    /// Whether the window is to close.
    pub fn closes(&self) -> bool {
        self.closes
    }

    /// The document with the name of its file.
    pub fn draft(&self) -> Draft {
        Draft { document: self.document().clone(), file: self.file.clone() }
    }

    /// Whether another document in its place would lose work.
    pub(crate) fn would_lose(&self) -> bool {
        self.is_unsaved() && (self.file.is_some() || !self.document().is_blank())
    }

    /// Goes on to what waits, if nothing is lost by it any more.
    pub(super) fn go_on_if_safe(&mut self) {
        if !self.would_lose()
            && let Some(next) = self.next.take()
        {
            self.go_on(next);
        }
    }

    fn go_on(&mut self, next: Next) {
        match next {
            Next::Blank => {
                self.replace(Document::default(), None);
                self.tool = Tool::Draw;
            }
            Next::Document(coming) => {
                let Coming { draft, is_safe, source, said } = *coming;
                self.replace(draft.document, draft.file);
                if !is_safe {
                    self.mark_unsaved();
                }
                self.sources.push(source);
                if let Some(said) = said {
                    self.say(said);
                }
            }
            Next::Close => {
                // Whatever of it was wanted is saved, or kept as dropped.
                self.saved_version = self.history.version();
                self.closes = true;
            }
        }
    }
}
