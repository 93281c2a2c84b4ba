//! The edits of a document that there are; [`super::edit`] carries them out.

use super::Drawing;
use sheetwright::design::{DesignPanel, Dimensions, Stock, TrimKind};
use sheetwright::math::Point2;

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
    /// The trade that the design is made for, by name.
    SetTrade(Option<String>),
    /// The width of the allowance along a curve, mm; 0 for none.
    SetAllowance {
        /// The number of the curve.
        curve: usize,
        /// The width.
        width_mm: f64,
    },
    /// What else is done along a curve, in order.
    SetTrims {
        /// The number of the curve.
        curve: usize,
        /// What is done.
        kinds: Vec<TrimKind>,
    },
    /// The preset of its SVG and DXF files, by name; `None` for that of its trade.
    SetPreset(Option<String>),
    /// What the parts are cut from; `None` where they are not laid out.
    SetStock(Option<Box<Stock>>),
    /// How thick the sheet is, which face of it is drawn, and how sharply it is folded.
    SetSheet {
        /// The thickness, mm; `None` for that of its material.
        thickness_mm: Option<f64>,
        /// The face; `None` where the pattern is that of what is drawn.
        dimensions: Option<Dimensions>,
        /// The inner radius of the tool that makes sharp folds, mm; `None` for that of its
        /// material.
        bend_radius_mm: Option<f64>,
    },
    /// All lengths of the design and of its drawing change by this factor.
    Scale(f64),
    /// How the design is drawn.
    SetDrawing(Box<Drawing>),
}
