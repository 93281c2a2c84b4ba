//! What a pattern is printed on: sheets of a size, a roll, or the picture of a projector.

use super::page::{HEADER_MM, MARGIN_MM};
use crate::quantity::distance_mm;
use sheetwright::math::Vec2;

/// What a pattern is printed on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Paper {
    /// 210 × 297 mm.
    #[default]
    A4,
    /// 297 × 420 mm.
    A3,
    /// 420 × 594 mm.
    A2,
    /// 594 × 841 mm.
    A1,
    /// 841 × 1189 mm.
    A0,
    /// 8.5 × 11 inches.
    Letter,
    /// 8.5 × 14 inches.
    Legal,
    /// 11 × 17 inches.
    Tabloid,
    /// Pages as wide as a roll, and as long as what they show.
    Roll(RollWidth),
    /// All parts beside one another on one page with a grid.
    Projector,
    /// A page with a grid for every part.
    ProjectorEach,
}

/// The width of a roll of paper, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollWidth(f64);

impl RollWidth {
    /// The least and the largest width, mm: the check square and the list of lines need the one,
    /// and no plotter is wider than the other.
    pub const RANGE_MM: [f64; 2] = [210.0, 5000.0];

    /// A width within [`RollWidth::RANGE_MM`]; `None` for others.
    pub fn new(mm: f64) -> Option<Self> {
        let [least, most] = Self::RANGE_MM;
        (least..=most).contains(&mm).then_some(Self(mm))
    }
}

/// A side of a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    /// It is this long, mm.
    Fixed(f64),
    /// It is as long as what the page shows, up to this, mm.
    UpTo(f64),
}

/// The least gap between a piece and the edge of the window of a page, mm, so that no line lies on
/// the edge.
pub(super) const AIR_MM: f64 = 1.0;
/// The longest side of a page, mm: readers of PDF take 200 inches.
const LONGEST_MM: f64 = 5000.0;
/// The least width of a page, mm, for the scale bar beside the name.
const LEAST_WIDE_MM: f64 = 210.0;
/// The least height of a page, mm.
const LEAST_HIGH_MM: f64 = 100.0;
/// The height of the overview on a roll, mm.
const OVERVIEW_MM: f64 = 297.0;

impl Paper {
    /// The sheets of a size.
    pub const SHEETS: [Self; 8] = [
        Self::A4,
        Self::A3,
        Self::A2,
        Self::A1,
        Self::A0,
        Self::Letter,
        Self::Legal,
        Self::Tabloid,
    ];

    /// The sheets of a name in commands.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::SHEETS.into_iter().find(|paper| paper.title().eq_ignore_ascii_case(name))
    }

    /// The paper of a name in commands: a sheet such as `a4`, `roll:914mm`, `projector` or
    /// `projector:each`.
    ///
    /// # Errors
    /// What the paper may be, in words.
    pub fn parse(given: &str) -> Result<Self, String> {
        let given = given.trim().to_lowercase();
        if let Some(width) = given.strip_prefix("roll:") {
            let roll = distance_mm(width.trim()).and_then(RollWidth::new);
            let [least, most] = RollWidth::RANGE_MM;
            return roll.map(Self::Roll).ok_or_else(|| {
                format!("give the width of the roll, {least} to {most} mm, such as roll:914mm")
            });
        }
        match &given[..] {
            "projector" => Ok(Self::Projector),
            "projector:each" => Ok(Self::ProjectorEach),
            name => Self::from_name(name).ok_or_else(|| {
                let names = Self::SHEETS.map(|sheet| sheet.title().to_lowercase()).join(", ");
                format!("give {names}, roll:WIDTH, projector or projector:each")
            }),
        }
    }

    /// The largest piece that one page shows whole, mm, the longer side first. Pieces lie on their
    /// longer side, so the page lies on its side too.
    pub fn whole_piece_mm(self) -> [f64; 2] {
        let [_, lying] = self.pages();
        let size = window(lying.largest()) - Vec2::splat(2.0 * AIR_MM);
        [size.x, size.y]
    }

    /// Width and height of the pages of a book, mm: those of the sheet of the same family that
    /// every printer takes.
    pub(crate) fn book_mm(self) -> Vec2 {
        match self {
            Self::Letter | Self::Legal | Self::Tabloid => Vec2::new(215.9, 279.4),
            _ => Vec2::new(210.0, 297.0),
        }
    }

    /// Its name on printed sheets.
    pub(crate) fn title(self) -> String {
        let name = match self {
            Self::A4 => "A4",
            Self::A3 => "A3",
            Self::A2 => "A2",
            Self::A1 => "A1",
            Self::A0 => "A0",
            Self::Letter => "Letter",
            Self::Legal => "Legal",
            Self::Tabloid => "Tabloid",
            Self::Roll(RollWidth(mm)) => return format!("a roll of {mm} mm"),
            Self::Projector | Self::ProjectorEach => "a projector",
        };
        name.to_owned()
    }

    /// Its sides upright: width and height.
    fn sides(self) -> [Side; 2] {
        use Side::{Fixed, UpTo};
        let inches = |width: f64, height: f64| [Fixed(25.4 * width), Fixed(25.4 * height)];
        match self {
            Self::A4 => [Fixed(210.0), Fixed(297.0)],
            Self::A3 => [Fixed(297.0), Fixed(420.0)],
            Self::A2 => [Fixed(420.0), Fixed(594.0)],
            Self::A1 => [Fixed(594.0), Fixed(841.0)],
            Self::A0 => [Fixed(841.0), Fixed(1189.0)],
            Self::Letter => inches(8.5, 11.0),
            Self::Legal => inches(8.5, 14.0),
            Self::Tabloid => inches(11.0, 17.0),
            Self::Roll(RollWidth(mm)) => [Fixed(mm), UpTo(LONGEST_MM)],
            Self::Projector | Self::ProjectorEach => [UpTo(LONGEST_MM); 2],
        }
    }

    /// Whether pages have a grid, and nothing is printed.
    pub(super) fn is_projected(self) -> bool {
        matches!(self, Self::Projector | Self::ProjectorEach)
    }

    /// The pages that it has, upright and lying.
    pub(super) fn pages(self) -> [PageSides; 2] {
        let [x, y] = self.sides();
        let turned = matches!(self, Self::Roll(_));
        [PageSides { x, y, turned: false }, PageSides { x: y, y: x, turned }]
    }

    /// Width and height of the pages of the overview, mm.
    pub(super) fn overview_mm(self) -> Vec2 {
        let [x, y] = self.sides().map(|side| match side {
            Side::Fixed(mm) => mm,
            Side::UpTo(_) => OVERVIEW_MM,
        });
        Vec2::new(x, y)
    }
}

/// A kind of page, as it is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PageSides {
    x: Side,
    y: Side,
    /// Whether it lies along a roll, so that it is turned by a quarter for printing.
    pub(super) turned: bool,
}

impl PageSides {
    /// The largest page of this kind, mm.
    pub(super) fn largest(self) -> Vec2 {
        let most = |side| match side {
            Side::Fixed(mm) | Side::UpTo(mm) => mm,
        };
        Vec2::new(most(self.x), most(self.y))
    }

    /// Whether pages are as large as what they show, both ways.
    pub(super) fn grows(self) -> bool {
        matches!((self.x, self.y), (Side::UpTo(_), Side::UpTo(_)))
    }

    /// Whether pages are of one height, and as long as what they show.
    pub(super) fn grows_along_x(self) -> bool {
        matches!((self.x, self.y), (Side::UpTo(_), Side::Fixed(_)))
    }

    /// The page whose window holds a box of this size, mm, if a page may be so large.
    pub(super) fn around(self, window: Vec2) -> Vec2 {
        let beside = Self::beside_window();
        let side = |side, window: f64, least: f64| match side {
            Side::Fixed(mm) => mm,
            Side::UpTo(mm) => window.ceil().max(least).min(mm),
        };
        Vec2::new(
            side(self.x, window.x + beside.x, LEAST_WIDE_MM),
            side(self.y, window.y + beside.y, LEAST_HIGH_MM),
        )
    }

    /// What a page is larger by than its window, mm.
    fn beside_window() -> Vec2 {
        Vec2::new(2.0 * MARGIN_MM, 2.0 * MARGIN_MM + HEADER_MM)
    }
}

/// The size of the window of a page, mm.
pub(super) fn window(page: Vec2) -> Vec2 {
    page - PageSides::beside_window()
}
