//! What panes look at, and what they answer with.

use crate::command::Command;
use crate::document::{Document, Drawing};
use crate::engine::shown::{Shown, ShownPanel};
use crate::theme::Theme;
use sheetwright::design::{CurveUse, DesignPanel, PanelShape};
use sheetwright::math::{Point2, Point3};

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

/// A point of a curve, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PointRef {
    /// The curve.
    pub curve: usize,
    /// The point on it.
    pub point: usize,
}

/// What is selected.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Points, each once, in order.
    pub points: Vec<PointRef>,
    /// A curve, by its number.
    pub curve: Option<usize>,
    /// A panel, by its number among those that are shown.
    pub panel: Option<usize>,
    /// A rung of that panel, by its number.
    pub rung: Option<usize>,
}

impl Selection {
    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// One point, and the curve that it is on.
    pub fn of_point(at: PointRef) -> Self {
        Self { points: vec![at], curve: Some(at.curve), ..Self::default() }
    }

    /// A rung of a panel.
    pub fn of_rung(panel: usize, rung: usize) -> Self {
        Self { panel: Some(panel), rung: Some(rung), ..Self::default() }
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

/// A change of the document.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// A stroke of the hand becomes a curve.
    Stroke {
        /// The places that the hand came through, in the plan, mm.
        places: Vec<Point2>,
        /// What the hand could not tell apart, mm: the size of a point of the screen.
        grain_mm: f64,
    },
    /// Corners put one by one, in the plan, mm: becomes a curve of straight sides.
    Corners {
        /// The corners.
        corners: Vec<Point2>,
        /// Whether the last is joined to the first.
        closed: bool,
    },
    /// A point is put on a curve, where this place of the plan is nearest to it.
    InsertPoint {
        /// The curve.
        curve: usize,
        /// The place, mm.
        at: Point2,
    },
    /// A span of a curve becomes straight, or one that is straight can be bent again.
    ToggleStraight {
        /// The curve.
        curve: usize,
        /// The span, by the number of the point that it begins at.
        span: usize,
    },
    /// A curve gets another name.
    RenameCurve {
        /// The curve.
        curve: usize,
        /// Its name.
        name: String,
    },
    /// A panel is changed in whatever way, but for its name.
    SetPanel {
        /// The panel, by its number in the design.
        panel: usize,
        /// What it is to be.
        to: Box<DesignPanel>,
    },
    /// A panel gets another name.
    RenamePanel {
        /// The panel, by its number in the design.
        panel: usize,
        /// Its name.
        name: String,
    },
    /// The sheet is another, by its name; or none is named.
    SetMaterial(Option<String>),
    /// How the design is drawn.
    SetDrawing(Box<Drawing>),
}

/// The curves that bound a panel, by their names.
pub fn curves_of(panel: &DesignPanel) -> Vec<&CurveUse> {
    match &panel.shape {
        PanelShape::Rails(rails) => rails.iter().collect(),
        PanelShape::Loops { outer, holes } => outer.iter().chain(holes.iter().flatten()).collect(),
        PanelShape::Join(_) => Vec::new(),
    }
}
