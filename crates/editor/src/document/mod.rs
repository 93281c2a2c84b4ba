//! What a person edits: a design, and how it is drawn.

mod draft;
pub mod edit;
mod edits;
pub(crate) mod file;
mod history;
mod selection;
mod size;

pub use draft::Draft;
pub use edits::Edit;
pub use history::History;
pub use selection::{PointRef, Selection};

use sheetwright::curve::MAX_COORDINATE_MM;
use sheetwright::design::{CurveUse, Design, DesignPanel, PanelShape};
pub use sheetwright_files::{Drawing, Mirror, Plan, Reference};

/// Everything that undo brings back and that a file keeps. One plain value, cheap to clone as long
/// as pictures are shared.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// The design, as the command line reads it.
    pub design: Design,
    /// How it is drawn.
    pub drawing: Drawing,
}

impl Default for Document {
    /// An empty one.
    fn default() -> Self {
        let design = Design { name: "untitled".to_owned(), ..Design::default() };
        Self { design, drawing: Drawing::default() }
    }
}

/// Nothing is put farther out, mm. Files hold coordinates of up to [`MAX_COORDINATE_MM`], and a
/// curve swings out beyond its handles by less than ten times.
pub const FARTHEST_MM: f64 = 0.1 * MAX_COORDINATE_MM;

impl Document {
    /// Whether there is nothing on it that could be lost: no curve, no panel and no picture.
    pub fn is_blank(&self) -> bool {
        self.is_undrawn() && self.drawing.reference.is_none()
    }

    /// Whether it has nothing to show in space: no curve and no panel.
    pub fn is_undrawn(&self) -> bool {
        self.design.curves.is_empty() && self.design.panels.is_empty()
    }

    /// What lies further out than [`FARTHEST_MM`]: a curve by its name, or the picture.
    pub fn out_of_range(&self) -> Option<&str> {
        let fits = |mm: f64| mm.abs() <= FARTHEST_MM;
        let curve = self.design.curves.iter().find(|curve| {
            !curve.points.iter().all(|p| fits(p.at.x) && fits(p.at.y) && fits(p.at.z))
        });
        let picture = self.drawing.reference.as_ref().filter(|picture| {
            let is_seen = fits(picture.mm_per_pixel) && picture.mm_per_pixel > 0.0;
            !(is_seen && fits(picture.centre.x) && fits(picture.centre.y))
        });
        curve.map(|curve| curve.name.as_str()).or(picture.map(|_| "The picture"))
    }
}

/// The curves that bound a panel, by their names.
pub fn curves_of(panel: &DesignPanel) -> Vec<&CurveUse> {
    match &panel.shape {
        PanelShape::Rails(rails) => rails.iter().collect(),
        PanelShape::Loops { outer, holes } => outer.iter().chain(holes.iter().flatten()).collect(),
        PanelShape::Join(_) | PanelShape::Mesh(_) => Vec::new(),
    }
}
