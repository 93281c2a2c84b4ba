//! The box around a line of text, as wide as the widest letters of the alphabet make it.
//!
//! A letter stands on a grid: a capital is 6 units high, letters are 4 units wide at the most and 2
//! apart, tails go down 2 units and dots up to 7.

use super::{PatternLabel, Piece};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::{Box2, inside};

/// The step from letter to letter, as a share of the height of a capital.
const STEP: f64 = 1.0;
/// The gap between two letters.
const GAP: f64 = 2.0 / 6.0;
/// How far tails reach below the base line.
const TAIL: f64 = 2.0 / 6.0;
/// How far dots reach above it.
const TOP: f64 = 7.0 / 6.0;
/// A text that leaves a plumb line by less than this, as the sine, is read from the right.
const LEVEL: f64 = 1e-6;

impl PatternLabel {
    /// The text in the same place, turned by half a turn about its own middle where it would be
    /// read from above or from the left.
    pub(crate) fn upright(self) -> Self {
        let Vec2 { x, y } = self.along;
        let is_upright = x > LEVEL || (x.abs() <= LEVEL && y > 0.0);
        if is_upright {
            return self;
        }
        let middle = TextBox::of(&self).middle;
        let along = -self.along;
        Self { at: TextBox::base(middle, along, self.height_mm), along, ..self }
    }
}

/// A rectangle in any direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TextBox {
    pub(super) middle: Point2,
    pub(super) along: Vec2,
    /// Half of its width and of its height, mm.
    pub(super) half: Vec2,
}

impl TextBox {
    /// The box around a text of this many letters whose base line has this middle.
    pub(super) fn new(letters: usize, at: Point2, along: Vec2, height_mm: f64) -> Self {
        let width = (STEP * letters as f64 - GAP).max(0.0) * height_mm;
        Self {
            middle: at + along.perp() * (0.5 * (TOP - TAIL) * height_mm),
            along,
            half: Vec2::new(0.5 * width, 0.5 * (TOP + TAIL) * height_mm),
        }
    }

    /// The box around a label.
    pub(crate) fn of(label: &PatternLabel) -> Self {
        Self::new(label.text.chars().count(), label.at, label.along, label.height_mm)
    }

    /// Where the base line of a text has its middle whose box has its middle at a place.
    pub(super) fn base(middle: Point2, along: Vec2, height_mm: f64) -> Point2 {
        middle + along.perp() * (-0.5 * (TOP - TAIL) * height_mm)
    }

    /// The box down to the base line of letters of this height, mm.
    pub(super) fn without_tails(self, height_mm: f64) -> Self {
        let tails_mm = 0.5 * TAIL * height_mm;
        let half = Vec2::new(self.half.x, self.half.y - tails_mm);
        Self { middle: self.middle + self.along.perp() * tails_mm, half, ..self }
    }

    /// The box with so much room around it, mm.
    pub(super) fn grown(self, by_mm: f64) -> Self {
        Self { half: self.half + Vec2::splat(by_mm), ..self }
    }

    fn seen(&self, p: Point2) -> Point2 {
        let way = p - self.middle;
        Point2::new(way.dot(self.along), way.dot(self.along.perp()))
    }

    fn own(&self) -> Box2 {
        let corner = Point2::default() + self.half;
        Box2 { min: Point2::default() + -self.half, max: corner }
    }

    /// Whether a segment passes through it.
    pub(crate) fn meets(&self, [a, b]: [Point2; 2]) -> bool {
        self.own().part_inside(self.seen(a), self.seen(b)).is_some()
    }

    /// Its corners, counter-clockwise.
    pub(crate) fn corners(&self) -> [Point2; 4] {
        let (x, y) = (self.along * self.half.x, self.along.perp() * self.half.y);
        [self.middle + -x + -y, self.middle + x + -y, self.middle + x + y, self.middle + -x + y]
    }

    /// Whether it overlaps another: two rectangles are apart if a side of one parts them.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        let reach_squared = self.half.length_squared() + other.half.length_squared();
        if (other.middle - self.middle).length_squared() > 2.0 * reach_squared {
            return false;
        }
        let is_parted = |one: &Self, other: &Self| {
            let corners = other.corners().map(|p| one.seen(p));
            let beyond = |of: fn(&Point2) -> f64, half: f64| {
                corners.iter().all(|p| of(p) >= half) || corners.iter().all(|p| of(p) <= -half)
            };
            beyond(|p| p.x, one.half.x) || beyond(|p| p.y, one.half.y)
        };
        !is_parted(self, other) && !is_parted(other, self)
    }

    /// The box around it with sides along x and y.
    pub(super) fn around(&self) -> Box2 {
        let corners = self.corners();
        Box2::of_points(corners).unwrap_or(Box2 { min: self.middle, max: self.middle })
    }

    /// The point of it that is nearest to a place.
    pub(super) fn nearest(&self, p: Point2) -> Point2 {
        let seen = self.seen(p);
        let (x, y) =
            (seen.x.clamp(-self.half.x, self.half.x), seen.y.clamp(-self.half.y, self.half.y));
        self.middle + self.along * x + self.along.perp() * y
    }
}

/// Whether a text stands on a piece, not beside it.
pub(crate) fn is_text_inside(label: &PatternLabel, piece: &Piece) -> bool {
    let outline = piece.outline();
    TextBox::of(label).corners().into_iter().all(|corner| inside(outline, corner))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_meet_where_they_overlap() {
        let at = Point2::new;
        let one = TextBox::new(4, at(0.0, 0.0), Vec2::X, 6.0);
        assert!((one.half.x - 11.0).abs() < 1e-12 && (one.half.y - 4.5).abs() < 1e-12);
        assert_eq!(TextBox::base(one.middle, Vec2::X, 6.0), at(0.0, 0.0));
        assert!(one.meets([at(-20.0, 0.0), at(20.0, 0.0)]));
        assert!(
            !one.meets([at(-20.0, 7.1), at(20.0, 7.1)])
                && !one.meets([at(12.0, -9.0), at(12.0, 9.0)])
        );
        let aside = |x: f64, y: f64| TextBox::new(4, at(x, y), Vec2::X, 6.0);
        assert!(one.overlaps(&aside(21.9, 0.0)) && !one.overlaps(&aside(22.1, 0.0)));
        assert!(one.overlaps(&aside(0.0, 8.9)) && !one.overlaps(&aside(0.0, 9.1)));
        let slanting = TextBox::new(4, at(16.0, 12.0), Vec2::new(0.6, -0.8), 6.0);
        assert!(one.overlaps(&slanting) == slanting.overlaps(&one));
        assert_eq!(one.nearest(at(50.0, one.middle.y)), at(11.0, one.middle.y));
    }
}
