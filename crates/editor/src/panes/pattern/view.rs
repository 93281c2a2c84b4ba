//! The sheet of paper that pieces lie on: where each lies, and which part of it is looked at.

use crate::scene::Scene;
use eframe::egui::{Pos2, Rect, Vec2, pos2};
use sheetwright::math::{Point2, Vec2 as Way};

/// The gap between pieces at the least, points: below a piece its width stands in it, and the name of
/// the next one.
const GAP: f64 = 56.0;
/// The room between the height of a piece and the piece to the left of it, points.
const CLEAR: f64 = 10.0;
/// The room beside, above and below what fits, points: names and dimensions stand in it.
const ROOM: Vec2 = Vec2::new(86.0, 46.0);

/// Where a piece lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placed {
    /// Its panel.
    pub(super) panel: usize,
    /// What is added to its own places, mm.
    pub(super) offset: Way,
    /// Its width and height, mm.
    pub(super) size: Way,
}

/// The pieces in rows from above, each as the pattern has it; together they are about as wide to
/// their height as the pane. `gap` is between them, beside and below, mm.
pub(super) fn placed(scene: &Scene<'_>, pane: Rect, gap: Way) -> Vec<Placed> {
    let aspect = f64::from((pane.width() / pane.height()).clamp(0.3, 4.0));
    let sizes: Vec<(usize, Way)> = scene.made().map(|(n, shown)| (n, shown.piece.size)).collect();
    let area: f64 = sizes.iter().map(|(_, size)| (size.x + gap.x) * (size.y + gap.y)).sum();
    let widest = sizes.iter().map(|(_, size)| size.x).fold(0.0, f64::max);
    let row_width = (area * aspect).sqrt().max(widest);
    let mut all = Vec::new();
    let (mut x, mut top, mut row_height) = (0.0, 0.0, 0.0_f64);
    for (panel, size) in sizes {
        if x > 0.0 && x + size.x > row_width {
            top -= row_height + gap.y;
            (x, row_height) = (0.0, 0.0);
        }
        all.push(Placed { panel, offset: Way::new(x, top - size.y), size });
        x += size.x + gap.x;
        row_height = row_height.max(size.y);
    }
    all
}

/// The gap between pieces that leaves room for their names and dimensions where all are in sight,
/// beside and below, mm. `height_takes` says how much room the height of a piece takes beside it,
/// points.
pub(super) fn roomy_gap(
    scene: &Scene<'_>,
    pane: Rect,
    height_takes: impl Fn(&Placed, &View) -> f32,
) -> Way {
    let mut view = View::default();
    let mut gap = Way::default();
    // The wider the gap, the smaller everything; three rounds come near enough.
    for _ in 0..3 {
        let pieces = placed(scene, pane, gap);
        view.fit(&pieces, pane);
        let heights = pieces.iter().map(|piece| f64::from(height_takes(piece, &view)));
        let beside = (heights.fold(0.0, f64::max) + CLEAR).max(GAP);
        gap = Way::new(beside, GAP) * view.mm_per_point;
    }
    gap
}

/// Which part of the paper is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    /// What is in the middle, mm.
    pub(super) middle: Point2,
    /// The size of a point of the screen, mm.
    pub(super) mm_per_point: f64,
}

impl Default for View {
    fn default() -> Self {
        Self { middle: Point2::default(), mm_per_point: 1.0 }
    }
}

impl View {
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

    /// Brings all pieces into sight, with room for their dimensions.
    pub(super) fn fit(&mut self, pieces: &[Placed], rect: Rect) {
        let (mut low, mut high) = (Way::splat(f64::INFINITY), Way::splat(f64::NEG_INFINITY));
        for piece in pieces {
            low = low.min(piece.offset);
            high = high.max(piece.offset + piece.size);
        }
        if !(high - low).is_finite() {
            return;
        }
        let room = (rect.size() - 2.0 * ROOM).max(Vec2::splat(40.0));
        let size = (high - low).max(Way::splat(1e-3));
        let scale = (size.x / f64::from(room.x)).max(size.y / f64::from(room.y));
        self.mm_per_point = scale;
        // Dimensions stand below and to the left.
        let middle = (low + high) * 0.5 + Way::new(-24.0, -8.0) * scale;
        self.middle = Point2::new(middle.x, middle.y);
    }
}

/// A rectangle around a piece on the screen.
pub(super) fn box_of(piece: &Placed, view: &View, rect: Rect) -> Rect {
    let low = Point2::new(piece.offset.x, piece.offset.y);
    let high = low + piece.size;
    let (a, b) = (view.seen(low, rect), view.seen(high, rect));
    Rect::from_min_max(pos2(a.x, b.y), pos2(b.x, a.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_what_is_under_the_hand() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(300.0, 200.0));
        let mut view = View { middle: Point2::new(50.0, -20.0), mm_per_point: 2.0 };
        let at = pos2(40.0, 180.0);
        let under = view.under(at, rect);
        view.zoom(2.5, at, rect);
        assert!(view.under(at, rect).distance(under) < 1e-9);
        assert!(view.seen(under, rect).distance(at) < 1e-3);
    }

    #[test]
    fn what_fits_is_in_the_pane() {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), Vec2::new(300.0, 200.0));
        let piece = |x, y, w, h| Placed { panel: 0, offset: Way::new(x, y), size: Way::new(w, h) };
        let pieces = [piece(0.0, -500.0, 900.0, 500.0), piece(1000.0, -80.0, 70.0, 80.0)];
        let mut view = View::default();
        view.fit(&pieces, rect);
        for piece in &pieces {
            assert!(rect.contains_rect(box_of(piece, &view, rect)));
        }
    }
}
