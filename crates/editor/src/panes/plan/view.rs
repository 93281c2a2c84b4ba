//! Where the plan lies on the screen.

use crate::document::Document;
use eframe::egui::{Pos2, Rect, Vec2, pos2};
use sheetwright::design::PanelShape;
use sheetwright::math::Point2;

/// A view of the plan: y runs upwards there and downwards on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlanView {
    /// What lies in the middle, mm.
    pub(super) centre: Point2,
    /// Points of the screen for a millimetre.
    pub(super) scale: f64,
}

/// Points of the screen for a millimetre, at the least and at the most.
const SCALES: [f64; 2] = [1e-6, 1e4];

impl Default for PlanView {
    fn default() -> Self {
        Self { centre: Point2::new(0.0, 0.0), scale: 0.5 }
    }
}

impl PlanView {
    /// Where a place of the plan lies on the screen.
    pub(super) fn to_screen(self, pane: Rect, p: Point2) -> Pos2 {
        let middle = pane.center();
        pos2(
            middle.x + ((p.x - self.centre.x) * self.scale) as f32,
            middle.y - ((p.y - self.centre.y) * self.scale) as f32,
        )
    }

    /// The place of the plan under a point of the screen, mm.
    pub(super) fn to_plan(self, pane: Rect, p: Pos2) -> Point2 {
        let from_middle = p - pane.center();
        Point2::new(
            self.centre.x + f64::from(from_middle.x) / self.scale,
            self.centre.y - f64::from(from_middle.y) / self.scale,
        )
    }

    /// Moves what is shown along with the hand.
    pub(super) fn pan(&mut self, by: Vec2) {
        self.centre.x -= f64::from(by.x) / self.scale;
        self.centre.y += f64::from(by.y) / self.scale;
    }

    /// Makes it larger or smaller, and keeps what lies under the hand there.
    pub(super) fn zoom(&mut self, pane: Rect, at: Pos2, by: f64) {
        let held = self.to_plan(pane, at);
        self.scale = (self.scale * by).clamp(SCALES[0], SCALES[1]);
        let now = self.to_plan(pane, at);
        self.centre.x += held.x - now.x;
        self.centre.y += held.y - now.y;
    }

    /// Brings places into sight, with some room around them.
    pub(super) fn fit(&mut self, pane: Rect, places: impl Iterator<Item = Point2>) {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in places {
            for (axis, at) in [p.x, p.y].into_iter().enumerate() {
                low[axis] = low[axis].min(at);
                high[axis] = high[axis].max(at);
            }
        }
        if low[0] > high[0] {
            *self = Self::default();
            return;
        }
        self.centre = Point2::new((low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0);
        let room = [f64::from(pane.width()) * 0.8, f64::from(pane.height()) * 0.8];
        let scales = [room[0] / (high[0] - low[0]), room[1] / (high[1] - low[1])];
        let scale = scales[0].min(scales[1]);
        self.scale = if scale.is_finite() { scale.clamp(SCALES[0], SCALES[1]) } else { 0.5 };
    }
}

/// All points of all curves of a document, as the plan shows them.
pub(super) fn places(document: &Document) -> impl Iterator<Item = Point2> + '_ {
    let plan = document.drawing.plan;
    let points = document.design.curves.iter().flat_map(|curve| &curve.points);
    points.map(move |point| plan.flat(point.at))
}

/// All points of all curves and meshes of a document, as the plan shows them.
pub(super) fn extent(document: &Document) -> impl Iterator<Item = Point2> + '_ {
    let plan = document.drawing.plan;
    let meshes = document.design.panels.iter().filter_map(|panel| match &panel.shape {
        PanelShape::Mesh(mesh) => Some(&mesh.triangles.positions),
        _ => None,
    });
    places(document).chain(meshes.flatten().map(move |&p| plan.flat(p)))
}

/// The distance of grid lines that are easy to tell apart: that of the document, times 1, 2, 5, 10
/// …
pub(super) fn grid_step(scale: f64, grid_mm: f64) -> f64 {
    const APART: f64 = 14.0;
    let mut step = grid_mm.max(1e-9);
    let mut factor = [2.0, 2.5, 2.0].into_iter().cycle();
    while step * scale < APART {
        step *= factor.next().unwrap_or(2.0);
    }
    step
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANE: Rect = Rect { min: pos2(100.0, 50.0), max: pos2(500.0, 350.0) };

    #[test]
    fn the_screen_and_the_plan_agree() {
        let view = PlanView { centre: Point2::new(30.0, -20.0), scale: 2.5 };
        let p = Point2::new(37.0, 11.0);
        let there = view.to_screen(PANE, p);
        assert!(view.to_plan(PANE, there).distance(p) < 1e-4);
        assert!(there.y < view.to_screen(PANE, Point2::new(37.0, 0.0)).y, "y runs upwards");
    }

    #[test]
    fn zooming_keeps_what_is_under_the_hand() {
        let mut view = PlanView::default();
        let hand = pos2(140.0, 320.0);
        let before = view.to_plan(PANE, hand);
        view.zoom(PANE, hand, 3.7);
        assert!(view.to_plan(PANE, hand).distance(before) < 1e-9);
    }

    #[test]
    fn fitting_shows_everything_with_room_around() {
        let mut view = PlanView::default();
        let places = [Point2::new(-900.0, 10.0), Point2::new(1100.0, 60.0)];
        view.fit(PANE, places.into_iter());
        for p in places {
            assert!(PANE.shrink(20.0).contains(view.to_screen(PANE, p)));
        }
        view.fit(PANE, std::iter::once(places[0]));
        assert_eq!(view.to_screen(PANE, places[0]), PANE.center());
    }
}
