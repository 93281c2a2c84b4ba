//! What parts are cut from: sheets, rolls and offcuts, and how parts may lie on them.

use super::Divide;
use sheetwright_geometry::math::Point2;

/// What parts are cut from, and how they may lie on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stock {
    /// The sheets there are. None: parts are not laid out.
    pub sheets: Vec<StockSheet>,
    /// The least distance between two parts, mm.
    pub gap_mm: f64,
    /// The least distance of a part from the edge of its sheet, mm.
    pub margin_mm: f64,
    /// The width that a cut takes away, mm; 0 where the machine sees to it itself.
    pub kerf_mm: f64,
    /// How parts may be turned.
    pub turn: Turn,
    /// By how much the grain of a part may lie off that of the sheet, radians.
    pub grain_tolerance: f64,
    /// Whether parts may be turned over: both faces of the sheet are alike.
    pub may_turn_over: bool,
    /// Groups of panels whose parts lie on one sheet together, by name.
    pub together: Vec<Vec<String>>,
    /// Whether equal parts lie side by side, a kerf apart, so that one cut parts two.
    pub has_common_lines: bool,
    /// Whether each sheet has files of its own; else all are drawn beside each other.
    pub has_file_each: bool,
    /// How much work the search may do, as a multiple of the default.
    pub effort: f64,
    /// How parts that are larger than every sheet are divided, if they are.
    pub divide: Option<Divide>,
}

impl Default for Stock {
    fn default() -> Self {
        Self {
            sheets: Vec::new(),
            gap_mm: 3.0,
            margin_mm: 5.0,
            kerf_mm: 0.0,
            turn: Turn::Free,
            grain_tolerance: 0.0,
            may_turn_over: false,
            together: Vec::new(),
            has_common_lines: false,
            has_file_each: false,
            effort: 1.0,
            divide: None,
        }
    }
}

/// A kind of sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct StockSheet {
    /// Its name; where it has none, its size says it.
    pub name: Option<String>,
    /// Its form.
    pub form: SheetForm,
    /// How many there are; `None`: as many as it takes.
    pub count: Option<usize>,
    /// What one costs, or a metre of a roll, in any currency.
    pub cost: Option<f64>,
}

/// The form of a sheet. The grain runs along its longer side, of a roll along its length, of an
/// offcut along x.
#[derive(Clone, Debug, PartialEq)]
pub enum SheetForm {
    /// A rectangle of this width and height, mm.
    Rectangle {
        /// Along x and along y.
        size: [f64; 2],
    },
    /// A roll of this width, mm: as long as it takes.
    Roll {
        /// Across the roll.
        width: f64,
    },
    /// An offcut of this outline, mm, counter-clockwise.
    Outline {
        /// Its corners.
        points: Vec<Point2>,
    },
}

/// How parts may be turned on a sheet. A part with a grain arrow lies with it along the grain of
/// the sheet, whatever else is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// By any angle.
    Free,
    /// By multiples of this angle, radians.
    Steps {
        /// Above 0.
        angle: f64,
    },
    /// With their grain along that of the sheet, either way round. The grain of a part without an
    /// arrow runs along x of its pattern.
    Grain,
    /// With their grain along that of the sheet, all the same way, as pile and prints need it.
    OneWay,
}
