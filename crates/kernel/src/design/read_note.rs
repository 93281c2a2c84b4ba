//! What is to be said of how the curves of a design came out of a drawing.

use sheetwright_geometry::math::Point3;

/// A note about how a drawing was read; `make` says it with the first part.
#[derive(Clone, Debug, PartialEq)]
pub enum ReadNote {
    /// Things of the drawing bound no panel.
    NotUsed {
        /// What they are.
        what: Unused,
        /// How many.
        count: usize,
        /// The names of some of them, of their layers or of their types.
        names: Vec<String>,
        /// Where the first of them begins, if that is known.
        at: Option<Point3>,
    },
    /// Curves whose ends do not meet exactly were joined.
    GapsClosed {
        /// How many gaps.
        count: usize,
        /// The widest, mm.
        widest_mm: f64,
        /// Where that is.
        at: Point3,
    },
    /// Two open curves were taken for the rails of a panel.
    TakenForRails {
        /// Their names.
        names: [String; 2],
    },
    /// Two closed curves in space were taken for the two borders of a ring.
    TakenForRing {
        /// Their names.
        names: [String; 2],
    },
    /// Curves that are many short straight lines in space were made smooth through their points.
    Smoothed {
        /// Their names.
        names: Vec<String>,
    },
    /// The drawing names no unit of length, and was read in millimetres or pixels.
    NoUnit {
        /// The length of its unit, mm.
        unit_mm: f64,
    },
}

/// What bounds no panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unused {
    /// Open curves that close no outline.
    Open,
    /// Closed curves beside what was named.
    Closed,
    /// Curves beside those that were named.
    NotNamed,
    /// Curves that are drawn twice, one on the other.
    Doubled,
    /// Curves on layers of marks, such as `engrave` or `note`.
    Marks,
    /// What is hidden, or lies on a hidden layer.
    Hidden,
    /// Texts.
    Text,
    /// Pictures.
    Image,
    /// Hatches.
    Hatch,
    /// Dimensions and leaders.
    Dimension,
    /// Points.
    Point,
    /// Faces and solids of a drawing of lines.
    Surface,
    /// Lines of a file with a mesh.
    Lines,
    /// What lies on the pages of a drawing, beside its model.
    Page,
    /// Entities of types that are not read.
    Other,
}
