//! Undo without limit: a list of documents, of which one is current.

use super::Document;

/// A document with all that it was.
#[derive(Clone, Debug, Default)]
pub struct History {
    now: Document,
    past: Vec<Document>,
    future: Vec<Document>,
    /// What the document was when the drag that is under way began.
    before_drag: Option<Document>,
    version: u64,
}

impl History {
    /// A document without a past.
    pub fn new(document: Document) -> Self {
        Self { now: document, ..Self::default() }
    }

    /// A document without a past, whose version is this: so that it is told apart from those of
    /// another history.
    pub fn starting_at(document: Document, version: u64) -> Self {
        Self { now: document, version, ..Self::default() }
    }

    /// The document as it is now.
    pub fn now(&self) -> &Document {
        &self.now
    }

    /// Counts up with every change, undone ones too; so equal versions are equal documents.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Whether a drag is under way.
    pub fn is_dragging(&self) -> bool {
        self.before_drag.is_some()
    }

    /// What the document was when the drag that is under way began.
    pub fn before_drag(&self) -> Option<&Document> {
        self.before_drag.as_ref()
    }

    /// How many steps can be taken back.
    pub fn steps_back(&self) -> usize {
        self.past.len() + usize::from(self.before_drag.is_some())
    }

    /// How many steps that were taken back can be done again.
    pub fn steps_forth(&self) -> usize {
        self.future.len()
    }

    /// The document becomes another: one step. Nothing happens if it is the same.
    pub fn step(&mut self, to: Document) {
        self.rest();
        if to != self.now {
            self.past.push(std::mem::replace(&mut self.now, to));
            self.future.clear();
            self.version += 1;
        }
    }

    /// The document becomes another on the way of a drag, all of which is one step.
    pub fn drag(&mut self, to: Document) {
        if to != self.now {
            let before = std::mem::replace(&mut self.now, to);
            self.before_drag.get_or_insert(before);
            self.version += 1;
        }
    }

    /// The drag ends where it is.
    pub fn rest(&mut self) {
        if let Some(before) = self.before_drag.take()
            && before != self.now
        {
            self.past.push(before);
            self.future.clear();
        }
    }

    /// The drag ends where it began.
    pub fn drop_drag(&mut self) {
        if let Some(before) = self.before_drag.take() {
            self.now = before;
            self.version += 1;
        }
    }

    /// Takes the last step back; whether there was one.
    pub fn undo(&mut self) -> bool {
        self.rest();
        let Some(before) = self.past.pop() else { return false };
        self.future.push(std::mem::replace(&mut self.now, before));
        self.version += 1;
        true
    }

    /// Does the last step that was taken back again; whether there was one.
    pub fn redo(&mut self) -> bool {
        self.rest();
        let Some(after) = self.future.pop() else { return false };
        self.past.push(std::mem::replace(&mut self.now, after));
        self.version += 1;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &str) -> Document {
        let mut document = Document::default();
        document.design.name = name.to_owned();
        document
    }

    #[test]
    fn steps_go_back_and_forth_and_a_new_one_ends_what_could_come() {
        let mut history = History::new(named("a"));
        for name in ["b", "b", "c"] {
            history.step(named(name));
        }
        assert_eq!((history.steps_back(), history.steps_forth()), (2, 0));
        assert!(history.undo() && history.undo() && !history.undo());
        assert_eq!(history.now().design.name, "a");
        assert!(history.redo());
        history.step(named("d"));
        assert!(!history.redo());
        assert!(history.undo());
        assert_eq!(history.now().design.name, "b");
    }

    #[test]
    fn a_drag_is_one_step_or_none() {
        let mut history = History::new(named("a"));
        for n in 0..100 {
            history.drag(named(&n.to_string()));
        }
        assert!(history.is_dragging());
        history.rest();
        assert_eq!(history.steps_back(), 1);
        history.drag(named("far"));
        history.drop_drag();
        assert_eq!((history.now().design.name.as_str(), history.steps_back()), ("99", 1));
        history.drag(named("there"));
        history.drag(named("99"));
        history.rest();
        assert_eq!(history.steps_back(), 1);
    }
}
