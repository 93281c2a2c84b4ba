//! Texts that are to stand on a piece, and the places that each may have, the best first.

use super::{LabelKind, Role};
use sheetwright_geometry::math::{Point2, Vec2, unit2};

/// A text that is to be placed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wish {
    /// Its meaning.
    pub(super) kind: LabelKind,
    /// The work along its strokes, where it stands on the piece.
    pub(super) role: Role,
    /// What it says, then what it says where that has no room.
    pub(super) texts: Vec<String>,
    /// How high its letters are where there is room, mm; `None`: as those of edge names.
    pub(super) height_mm: Option<f64>,
    /// Where it may stand, the best first.
    pub(super) at: Vec<WishAt>,
    /// Where it stands if that has no room.
    pub(super) instead: Instead,
}

/// Where a text may stand.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum WishAt {
    /// Anywhere on the piece.
    Anywhere,
    /// With its middle at a point, or as near as can be.
    Near(Point2),
    /// Beside a line at some shares of its length, the best first: on its left side alone, as
    /// inside an edge, or on both.
    Beside { line: Vec<Point2>, shares: &'static [f64], is_left: bool, away_mm: f64 },
    /// Along a line, so near that nothing passes between, at some shares of its length.
    Along { line: Vec<Point2>, shares: &'static [f64] },
}

/// What becomes of a text that has no room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instead {
    /// It is left out.
    Nothing,
    /// It may cross lines to read; else it stands beside the piece, with a line that leads there.
    Leader,
}

/// Shares of a line from its middle outwards.
pub(super) const FROM_MIDDLE: &[f64] = &[0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8];
/// Shares of a line near its ends, and then elsewhere.
const NEAR_ENDS: &[f64] = &[0.1, 0.9, 0.2, 0.8, 0.3, 0.7, 0.4, 0.6, 0.5];

impl Wish {
    fn on_face(text: String, at: Vec<WishAt>, instead: Instead) -> Self {
        let (kind, role) = (LabelKind::OnFace, Role::Engrave);
        Self { kind, role, texts: vec![text], height_mm: None, at, instead }
    }

    /// A text of a mark near the ends of its line.
    pub(crate) fn at_ends(text: String, line: &[Point2]) -> Self {
        let (line, shares) = (line.to_vec(), NEAR_ENDS);
        let at = WishAt::Beside { line, shares, is_left: false, away_mm: 0.0 };
        Self::on_face(text, vec![at], Instead::Leader)
    }

    /// A text of an arrow, beside it; one that is needed stands near it where that has no room.
    pub(crate) fn beside(text: String, [from, to]: [Point2; 2], is_needed: bool) -> Self {
        let (line, shares) = (vec![from, to], FROM_MIDDLE);
        let beside = WishAt::Beside { line, shares, is_left: false, away_mm: 0.0 };
        if is_needed {
            let near = WishAt::Near(from.lerp(to, 0.5));
            return Self::on_face(text, vec![beside, near], Instead::Leader);
        }
        Self::on_face(text, vec![beside], Instead::Nothing)
    }

    /// A text of a mark inside an edge, which runs with the sheet to its left.
    pub(crate) fn inside_edge(text: String, line: &[Point2]) -> Self {
        let (line, shares) = (line.to_vec(), FROM_MIDDLE);
        let at = WishAt::Beside { line, shares, is_left: true, away_mm: 0.0 };
        Self::on_face(text, vec![at], Instead::Leader)
    }

    /// A text of a mark where there is most room.
    pub(crate) fn anywhere(text: String) -> Self {
        Self::on_face(text, vec![WishAt::Anywhere], Instead::Leader)
    }

    /// A text of a mark at a point.
    pub(crate) fn near(text: String, at: Point2) -> Self {
        Self::on_face(text, vec![WishAt::Near(at)], Instead::Leader)
    }

    /// How often a piece is cut, at a point.
    pub(super) fn quantity(text: String, at: Point2) -> Self {
        Self { kind: LabelKind::Quantity, ..Self::near(text, at) }
    }

    /// The text with letters of a height, mm.
    pub(crate) fn high(self, height_mm: Option<f64>) -> Self {
        Self { height_mm, ..self }
    }
}

/// The point at a share of a line's length, and its direction there; `None` of a line without
/// length.
pub(super) fn along(line: &[Point2], share: f64) -> Option<(Point2, Vec2)> {
    let length: f64 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut left = share * length;
    let mut last = None;
    for pair in line.windows(2) {
        let step_mm = pair[0].distance(pair[1]);
        let Some(step) = unit2(pair[1] - pair[0]) else { continue };
        if left <= step_mm {
            return Some((pair[0] + step * left, step));
        }
        left -= step_mm;
        last = Some((pair[1], step));
    }
    last
}

/// A direction or its opposite: that in which letters stand upright as far as they can.
pub(super) fn upright(way: Vec2) -> Vec2 {
    if way.x > 0.0 || (way.x == 0.0 && way.y > 0.0) { way } else { -way }
}
