//! The sheet of paper that pieces lie on: where each lies, and which part of it is looked at.

use eframe::egui::{Pos2, Rect, Vec2, pos2};
use sheetwright::math::{Point2, Vec2 as Way};

/// Where a piece lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placed {
    /// Its panel.
    pub(super) panel: usize,
    /// The lower left corner of its box on the paper, mm.
    offset: Way,
    /// The lower left corner of its box as files have it, mm.
    corner: Point2,
    /// Its width and height as files have it, mm.
    pub(super) size: Way,
    /// Whether it is turned by a right angle, counter-clockwise.
    pub(super) turned: bool,
}

impl Placed {
    /// A piece about a place of the paper, by two corners of its box, the lower left one first.
    pub(super) fn about(middle: Point2, panel: usize, piece: [Point2; 2], turned: bool) -> Self {
        let [corner, opposite] = piece;
        let size = opposite - corner;
        let placed = Self { panel, offset: Way::ZERO, corner, size, turned };
        Self { offset: middle.to_vec() - placed.box_size() * 0.5, ..placed }
    }

    /// Its width and height on the paper, mm.
    pub(super) fn box_size(&self) -> Way {
        if self.turned { Way::new(self.size.y, self.size.x) } else { self.size }
    }

    /// Where a place of the piece lies on the paper, mm.
    pub(super) fn on_paper(&self, p: Point2) -> Point2 {
        let p = p + -self.corner.to_vec();
        let p = if self.turned { Point2::new(self.size.y - p.y, p.x) } else { p };
        p + self.offset
    }

    /// The place of the piece at a place of the paper, mm.
    pub(super) fn on_piece(&self, p: Point2) -> Point2 {
        let p = p + -self.offset;
        let p = if self.turned { Point2::new(p.y, self.size.y - p.x) } else { p };
        p + self.corner.to_vec()
    }

    /// A direction on the piece, as it lies on the paper.
    pub(super) fn along(&self, way: Way) -> Way {
        if self.turned { way.perp() } else { way }
    }
}

/// Which part of the paper is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PatternView {
    /// What is in the middle, mm.
    pub(super) middle: Point2,
    /// The size of a point of the screen, mm.
    pub(super) mm_per_point: f64,
}

impl Default for PatternView {
    fn default() -> Self {
        Self { middle: Point2::default(), mm_per_point: 1.0 }
    }
}

impl PatternView {
    /// Where a place shows; y goes up.
    pub(super) fn seen(&self, p: Point2, rect: Rect) -> Pos2 {
        let way = (p - self.middle) / self.mm_per_point;
        rect.center() + Vec2::new(way.x as f32, -way.y as f32)
    }

    /// The place under a point of the screen, mm.
    pub(super) fn under(&self, at: Pos2, rect: Rect) -> Point2 {
        let way = at - rect.center();
        self.middle + Way::new(f64::from(way.x), -f64::from(way.y)) * self.mm_per_point
    }

    /// Shifts with the hand.
    pub(super) fn pan(&mut self, way: Vec2) {
        let shift = Way::new(-f64::from(way.x), f64::from(way.y)) * self.mm_per_point;
        self.middle = self.middle + shift;
    }

    /// Makes things larger by a factor, keeping what is under a point of the screen there.
    pub(super) fn zoom(&mut self, factor: f64, at: Pos2, rect: Rect) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        let fixed = self.under(at, rect);
        let size = (self.mm_per_point / factor).clamp(1e-6, 1e7);
        self.middle = fixed.lerp(self.middle, size / self.mm_per_point);
        self.mm_per_point = size;
    }
}

/// A rectangle around a piece on the screen.
pub(super) fn box_of(piece: &Placed, view: &PatternView, rect: Rect) -> Rect {
    let low = Point2::default() + piece.offset;
    let high = low + piece.box_size();
    let (a, b) = (view.seen(low, rect), view.seen(high, rect));
    Rect::from_min_max(pos2(a.x, b.y), pos2(b.x, a.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_what_is_under_the_hand() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(300.0, 200.0));
        let mut view = PatternView { middle: Point2::new(50.0, -20.0), mm_per_point: 2.0 };
        let at = pos2(40.0, 180.0);
        let under = view.under(at, rect);
        view.zoom(2.5, at, rect);
        assert!(view.under(at, rect).distance(under) < 1e-9);
        assert!(view.seen(under, rect).distance(at) < 1e-3);
    }

    #[test]
    fn a_piece_that_stands_has_its_places_where_it_lies() {
        let size = Way::new(30.0, 10.0);
        for turned in [false, true] {
            let of_piece = [Point2::default(), Point2::default() + size];
            let placed = Placed::about(Point2::new(100.0, 50.0), 0, of_piece, turned);
            let (low, high) =
                (placed.on_paper(Point2::default()), placed.on_paper(Point2::default() + size));
            assert_eq!(low.lerp(high, 0.5), Point2::new(100.0, 50.0));
            let p = Point2::new(7.0, 3.0);
            assert!(placed.on_piece(placed.on_paper(p)).distance(p) < 1e-12);
            let way = placed.on_paper(p + Way::X) - placed.on_paper(p);
            assert!((way - placed.along(Way::X)).length() < 1e-12);
        }
    }
}
