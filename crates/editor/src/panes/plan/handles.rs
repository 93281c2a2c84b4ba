//! The handles of curves, as the plan shows them.

use super::view::PlanView;
use crate::document::{PointRef, Selection};
use crate::panes::words::length;
use crate::scene::{Act, Scene};
use crate::theme::{HANDLE, TOUCH};
use eframe::egui::{self, Pos2, Rect, Sense, Ui, Vec2};
use sheetwright::math::{Point2, Point3};

/// Curves of more points show the handles of the selected curve alone: the points of a table are
/// samples, which nobody moves one by one.
const MANY: usize = 200;

/// A handle that is farther from the hand than another by no more than this, points, is as near.
const AS_NEAR: f32 = 3.0;

/// All handles that can be taken hold of.
pub(super) struct Handles {
    shown: Vec<Handle>,
}

#[derive(Clone, Copy)]
struct Handle {
    point: PointRef,
    place: Point2,
    at: Pos2,
    radius: f32,
    /// Whether an open curve ends here.
    is_end: bool,
}

impl Handles {
    pub(super) fn new(scene: &Scene<'_>, view: PlanView, pane: Rect) -> Self {
        let plan = scene.document.drawing.plan;
        let mut shown = Vec::new();
        for (curve, of) in scene.document.design.curves.iter().enumerate() {
            if of.points.len() > MANY && scene.selection.curve != Some(curve) {
                continue;
            }
            let places: Vec<Point2> = of.points.iter().map(|p| plan.flat(p.at)).collect();
            let on_screen = |&place: &Point2| view.to_screen(pane, place);
            let at: Vec<Pos2> = places.iter().map(on_screen).collect();
            let radius = radius(&at);
            let is_end = |point| !of.closed && (point == 0 || point + 1 == of.points.len());
            shown.extend(places.iter().zip(at).enumerate().map(|(point, (&place, at))| Handle {
                point: PointRef { curve, point },
                place,
                at,
                radius,
                is_end: is_end(point),
            }));
        }
        Self { shown }
    }

    /// Every handle and where it lies, mm.
    pub(super) fn all(&self) -> impl Iterator<Item = (PointRef, Point2)> + '_ {
        self.shown.iter().map(|handle| (handle.point, handle.place))
    }

    /// Every handle, where it lies on the screen, and how large it is drawn.
    pub(super) fn on_screen(&self) -> impl Iterator<Item = (PointRef, Pos2, f32)> + '_ {
        self.shown.iter().map(|handle| (handle.point, handle.at, handle.radius))
    }

    /// The handle under the hand. Of those that are about as near, an end or a joint comes before
    /// an inner handle; of several on one spot it is the last drawn, which lies on top.
    pub(super) fn at(&self, at: Pos2) -> Option<PointRef> {
        const REACH: f32 = TOUCH / 3.0;
        let distance = |handle: &Handle| handle.at.distance(at);
        let near = self.shown.iter().rev().filter(|handle| distance(handle) <= REACH);
        let near: Vec<&Handle> = near.collect();
        let least = near.iter().map(|handle| distance(handle)).fold(REACH, f32::min);
        let is_inner = |handle: &Handle| {
            let meets = |other: &&Handle| {
                other.place == handle.place && other.point.curve != handle.point.curve
            };
            !handle.is_end && !near.iter().any(meets)
        };
        let as_near = near.iter().filter(|handle| distance(handle) <= least + AS_NEAR);
        let rank = |handle: &Handle| (is_inner(handle), distance(handle));
        let order = |a: (bool, f32), b: (bool, f32)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        as_near.min_by(|a, b| order(rank(a), rank(b))).map(|handle| handle.point)
    }

    /// The handles in a box on the screen.
    pub(super) fn within(&self, area: Rect) -> Vec<PointRef> {
        let inside = self.shown.iter().filter(|handle| area.contains(handle.at));
        inside.map(|handle| handle.point).collect()
    }

    /// A place for each handle that keys and screen readers come to; to come to it selects it.
    pub(super) fn widgets(&self, ui: &mut Ui, scene: &Scene<'_>, acts: &mut Vec<Act>) {
        if self.shown.len() > MANY {
            return;
        }
        for handle in &self.shown {
            let PointRef { curve, point } = handle.point;
            let id = ui.scope_id().with(("handle", curve, point));
            let area = Rect::from_center_size(handle.at, Vec2::splat(12.0));
            let response = ui.interact(area, id, Sense::focusable_noninteractive());
            let is_selected = scene.selection.points.contains(&handle.point);
            if response.gained_focus() && !is_selected {
                acts.push(Act::Select(Selection::of_point(handle.point)));
            }
            let name = name(scene, handle);
            response.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::Button, true, is_selected, name.clone())
            });
        }
    }
}

/// How large the handles of a curve are drawn: smaller where they lie near one another.
fn radius(at: &[Pos2]) -> f32 {
    const LEAST: f32 = 2.0;
    let mut apart: Vec<f32> = at.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    apart.sort_by(f32::total_cmp);
    let median = apart.get(apart.len() / 2).copied().unwrap_or(f32::INFINITY);
    (0.35 * median).clamp(LEAST, HANDLE)
}

/// `outline, point 3, at 400 mm, 120 mm`.
fn name(scene: &Scene<'_>, handle: &Handle) -> String {
    let PointRef { curve, point } = handle.point;
    let units = scene.document.drawing.units;
    let length = |mm| length(mm, units);
    let of = scene.document.design.curves.get(curve).map_or("", |curve| &curve.name);
    format!("{of}, point {}, at {}, {}", point + 1, length(handle.place.x), length(handle.place.y))
}

/// Where the selected points go if they move by this much on the plan, mm.
pub(super) fn moved_by(scene: &Scene<'_>, by: Point2) -> Vec<(PointRef, Point3)> {
    let plan = scene.document.drawing.plan;
    let curves = &scene.document.design.curves;
    let moved = |&r: &PointRef| {
        let now = curves.get(r.curve)?.points.get(r.point)?.at;
        let flat = plan.flat(now);
        Some((r, plan.space(Point2::new(flat.x + by.x, flat.y + by.y), plan.lift(now))))
    };
    scene.selection.points.iter().filter_map(moved).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    fn handle(curve: usize, point: usize, x: f32, is_end: bool) -> Handle {
        let point = PointRef { curve, point };
        let place = Point2::new(f64::from(x), 0.0);
        Handle { point, place, at: pos2(x, 0.0), radius: HANDLE, is_end }
    }

    fn found(handles: &[Handle], x: f32) -> Option<(usize, usize)> {
        let handles = Handles { shown: handles.to_vec() };
        handles.at(pos2(x, 0.0)).map(|of| (of.curve, of.point))
    }

    #[test]
    fn an_end_comes_before_an_inner_handle_that_is_about_as_near() {
        let seam = [handle(0, 0, 0.0, true), handle(0, 1, 4.0, false), handle(0, 2, 8.0, false)];
        assert_eq!(found(&seam, 3.0), Some((0, 0)));
        assert_eq!(found(&seam, 4.0), Some((0, 1)));
        assert_eq!(found(&seam, 6.5), Some((0, 2)));
        assert_eq!(found(&seam, 30.0), None);
    }

    #[test]
    fn so_does_a_joint_of_closed_curves_and_of_its_handles_the_last_drawn_is_on_top() {
        let outlines = [
            handle(0, 5, 0.0, false),
            handle(0, 6, 4.0, false),
            handle(1, 2, 0.0, false),
            handle(1, 3, -9.0, false),
        ];
        assert_eq!(found(&outlines, 3.0), Some((1, 2)));
        assert_eq!(found(&outlines, 4.0), Some((0, 6)));
    }
}
