//! What panes look at, and what they answer with.

use crate::command::Command;
use crate::document::{Document, Edit, PointRef, Selection};
use crate::engine::shown::{Shown, ShownPanel};
use crate::theme::Theme;
use sheetwright::math::Point3;

/// Everything that a pane looks at.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// What is edited.
    pub document: &'a Document,
    /// What was last made of it; its panels may lag behind the document while the hand moves.
    pub panels: &'a [ShownPanel],
    /// Counts up with every change of [`Self::panels`], so that a pane knows when to prepare anew.
    pub panels_version: u64,
    /// What is selected.
    pub selection: &'a Selection,
    /// The colours.
    pub theme: &'static Theme,
}

impl<'a> Scene<'a> {
    /// The panels that were made, by their numbers.
    pub fn made(&self) -> impl Iterator<Item = (usize, &'a Shown)> + use<'a> {
        let panels = self.panels.iter().enumerate();
        panels.filter_map(|(n, panel)| Some((n, panel.made.as_ref().ok()?)))
    }
}

/// What a pane answers with. The app carries it out; no pane changes a document.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// A command, as from a menu.
    Run(Command),
    /// Something is selected.
    Select(Selection),
    /// Something is selected and brought into sight.
    Show(Selection),
    /// Points are moved to these places, mm, and may move on: a drag. Where the drawing has a
    /// mirror, their images follow. Until [`Act::Rest`] it is one step of undo.
    Move(Vec<(PointRef, Point3)>),
    /// The hand rests: what moved is done.
    Rest,
    /// An edit that is one step of undo by itself.
    Edit(Edit),
}
