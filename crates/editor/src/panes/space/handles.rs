//! Handles in space: every point of every curve, on a stem over its place in the plan. They move
//! across the plan only, so the plan stays as it was drawn.

use super::camera::{Camera, Ray};
use crate::document::{PointRef, Selection};
use crate::panes::dashes::dashed;
use crate::panes::lit::{Lit, paint_dim};
use crate::panes::tag::tag;
use crate::panes::words::length;
use crate::scene::{Act, Scene};
use crate::theme::{HANDLE, TOUCH, Theme};
use eframe::egui::accesskit::{Action, Role};
use eframe::egui::{
    CursorIcon, Id, Key, Modifiers, Painter, PointerButton, Pos2, Rect, Response, Sense, Stroke,
    StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use sheetwright::math::{Point3, Vec3};

/// A lift settles on another one within this, points.
const SNAP: f32 = 6.0;
/// Views that see stems shorter than this share of their length do not tell lifts apart.
const END_ON: f64 = 0.12;
/// With more points than this, handles are small and only selected ones have stems.
const MANY: usize = 80;
/// And with more than this, somewhat smaller.
const SOME: usize = 30;
/// Points closer than this share of the size of their coordinates are on one spot, as where curves
/// are chained.
const SAME_SPOT: f64 = 1e-6;
/// The share of a step of the grid that a careful step is.
const CAREFUL: f64 = 0.1;

/// What the hand holds.
#[derive(Debug, Default)]
pub(crate) struct Handles {
    drag: Option<Drag>,
}

#[derive(Debug)]
struct Drag {
    grabbed: PointRef,
    /// Where everything that moves was.
    starts: Vec<(PointRef, Point3)>,
    /// Where the hand went down.
    pressed: Pos2,
    /// How far everything is lifted now, mm.
    by: f64,
    snapped: Option<Snap>,
}

/// What a lift settled on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Snap {
    /// The plane of the plan.
    Plan,
    /// The lift of another point.
    Level(PointRef),
    /// A line of the grid.
    Grid,
}

/// A point that has a handle.
struct Handle {
    of: PointRef,
    at: Point3,
    corner: bool,
    response: Response,
    seen: Option<Pos2>,
}

/// Where handles are shown.
pub(crate) struct Look<'a> {
    /// From where.
    pub(crate) camera: &'a Camera,
    /// The pane.
    pub(crate) rect: Rect,
    /// The pane's own response, which has the focus after a click beside handles.
    pub(crate) ground: &'a Response,
    /// The curve under the hand.
    pub(crate) curve: Option<usize>,
}

impl Handles {
    /// Whether a handle is being dragged.
    pub(crate) fn dragging(&self) -> bool {
        self.drag.is_some()
    }

    /// What the hand holds is let go where it is: the pane is not shown any more.
    pub(crate) fn let_go(&mut self, acts: &mut Vec<Act>) {
        if self.drag.take().is_some() {
            acts.push(Act::Rest);
        }
    }

    /// Shows the handles and answers the hand. What is dragged with other buttons than the first is
    /// for the camera, and comes back.
    pub(crate) fn ui(
        &mut self,
        ui: &Ui,
        scene: &Scene<'_>,
        look: &Look<'_>,
        acts: &mut Vec<Act>,
    ) -> Option<Response> {
        let handles = all(ui, scene, look);
        self.keys(ui, scene, look, &handles, acts);
        for handle in &handles {
            self.drag(ui, scene, look, handle, acts);
            if handle.response.clicked() && self.drag.is_none() {
                handle.response.request_focus();
                let held = ui.input(|i| i.modifiers);
                let more = held.shift || held.command;
                acts.push(Act::Select(clicked(scene.selection, handle.of, more)));
            }
        }
        // What was dragged may be gone by an undo in the middle of it.
        if let Some(drag) = &self.drag {
            let lost = !handles.iter().any(|h| h.of == drag.grabbed);
            if lost || !ui.input(|i| i.pointer.any_down()) {
                self.drag = None;
                acts.push(Act::Rest);
            }
        }
        self.paint(ui, scene, look, &handles);
        let other = |h: &Handle| {
            let by = |button| h.response.dragged_by(button);
            by(PointerButton::Secondary) || by(PointerButton::Middle)
        };
        handles.into_iter().find(other).map(|h| h.response)
    }

    fn drag(
        &mut self,
        ui: &Ui,
        scene: &Scene<'_>,
        look: &Look<'_>,
        handle: &Handle,
        acts: &mut Vec<Act>,
    ) {
        let response = &handle.response;
        if response.drag_started_by(PointerButton::Primary) {
            let at = response.interact_pointer_pos().unwrap_or(response.rect.center());
            let pressed = ui.input(|i| i.pointer.press_origin()).unwrap_or(at);
            let starts = if scene.selection.points.contains(&handle.of) {
                joined(scene, &scene.selection.points)
            } else {
                acts.push(Act::Select(Selection::of_point(handle.of)));
                joined(scene, &[handle.of])
            };
            let grabbed = handle.of;
            self.drag = Some(Drag { grabbed, starts, pressed, by: 0.0, snapped: None });
        }
        let Some(drag) = self.drag.as_mut().filter(|drag| drag.grabbed == handle.of) else {
            return;
        };
        if let Some(at) = response.interact_pointer_pos() {
            let free = ui.input(|i| i.modifiers.alt);
            let before = drag.by;
            drag.follow(at, free, scene, look);
            if drag.by != before {
                let way = scene.document.drawing.plan.normal() * drag.by;
                acts.push(Act::Move(drag.starts.iter().map(|&(p, at)| (p, at + way)).collect()));
            }
            ui.ctx().set_cursor_icon(CursorIcon::ResizeVertical);
        }
        if response.drag_stopped() {
            self.drag = None;
            acts.push(Act::Rest);
        }
    }

    /// Keys that lift what is selected, or the handle that has the focus.
    fn keys(
        &self,
        ui: &Ui,
        scene: &Scene<'_>,
        look: &Look<'_>,
        handles: &[Handle],
        acts: &mut Vec<Act>,
    ) {
        let focused = handles.iter().find(|h| h.response.has_focus());
        for handle in handles {
            let id = handle.response.id;
            let asked = |action| ui.input(|i| i.num_accesskit_action_requests(id, action)) as f64;
            let steps = asked(Action::Increment) - asked(Action::Decrement);
            if steps != 0.0 {
                lift(scene, &[handle.of], steps * scene.document.drawing.grid_mm, acts);
            }
        }
        if self.drag.is_some() || !(look.ground.has_focus() || focused.is_some()) {
            return;
        }
        let points: &[PointRef] = match focused {
            Some(handle) if !scene.selection.points.contains(&handle.of) => &[handle.of],
            _ => &scene.selection.points,
        };
        let steps = ui.input_mut(|i| {
            let mut pressed = |held, key| i.count_and_consume_key(held, key) as f64;
            let mut both = |held| pressed(held, Key::PageUp) - pressed(held, Key::PageDown);
            CAREFUL * both(Modifiers::SHIFT) + both(Modifiers::NONE)
        });
        if steps != 0.0 && !points.is_empty() {
            lift(scene, points, steps * scene.document.drawing.grid_mm, acts);
        }
    }

    fn paint(&self, ui: &Ui, scene: &Scene<'_>, look: &Look<'_>, handles: &[Handle]) {
        let theme = scene.theme;
        let plan = scene.document.drawing.plan;
        let painter = ui.painter();
        let is_met = |h: &&Handle| h.response.hovered() || h.response.has_focus();
        let met = handles.iter().filter(is_met).map(|h| h.of.curve);
        let held = self.drag.iter().flat_map(|drag| &drag.starts).map(|(of, _)| of.curve);
        let lit = Lit::new(scene, met.chain(held).chain(look.curve));
        let shown = || handles.iter().filter(|handle| lit.shows(handle.of));
        let count = shown().count();
        let many = count > MANY;
        let is_selected = |h: &Handle| scene.selection.points.contains(&h.of);
        for at in handles.iter().filter(|h| !lit.shows(h.of)).filter_map(|h| h.seen) {
            paint_dim(painter, theme, at);
        }
        for handle in shown() {
            let chosen = is_selected(handle);
            let Some(top) = handle.seen else { continue };
            if many && !chosen && !handle.response.hovered() {
                continue;
            }
            let foot = look.camera.seen(plan.space(plan.flat(handle.at), 0.0), look.rect);
            let Some(foot) = foot else { continue };
            let colour = if chosen { theme.accent } else { theme.faint };
            let colour = colour.gamma_multiply(if chosen { 1.0 } else { 0.55 });
            if top.distance(foot.at) > 1.0 {
                let stem = Stroke::new(1.0, colour);
                dashed(painter, &[foot.at, top], stem, 3.0, 3.0);
                painter.circle_filled(foot.at, 2.0, colour);
            }
        }
        if let Some(drag) = &self.drag {
            drag.paint_snap(painter, scene, look);
        }
        for handle in shown() {
            let Some(at) = handle.seen else { continue };
            let hovered = handle.response.hovered() || handle.response.dragged();
            let size = match count {
                _ if hovered => HANDLE + 1.5,
                _ if is_selected(handle) => HANDLE,
                n if n > MANY => 0.5 * HANDLE,
                n if n > SOME => 0.8 * HANDLE,
                _ => HANDLE,
            };
            paint_handle(painter, theme, at, handle, is_selected(handle), hovered, size);
        }
        if let Some(drag) = &self.drag
            && let Some(handle) = handles.iter().find(|h| h.of == drag.grabbed)
            && let Some(at) = handle.seen
        {
            let lifted = drag.lift(scene);
            let text = length(lifted, scene.document.drawing.units);
            tag(painter, theme, at + vec2(16.0, -16.0), &text, theme.accent, look.rect);
        }
    }
}

impl Drag {
    fn start(&self) -> Point3 {
        let mut starts = self.starts.iter();
        starts.find(|(of, _)| *of == self.grabbed).map(|&(_, at)| at).unwrap_or_default()
    }

    /// How far the grabbed point is lifted off the plan, mm.
    fn lift(&self, scene: &Scene<'_>) -> f64 {
        scene.document.drawing.plan.lift(self.start()) + self.by
    }

    /// Lifts by as much as the hand went along the stem.
    fn follow(&mut self, at: Pos2, free: bool, scene: &Scene<'_>, look: &Look<'_>) {
        let plan = scene.document.drawing.plan;
        let (start, normal) = (self.start(), plan.normal());
        let here = look.camera.mm_per_point(start + normal * self.by, look.rect);
        let slope = (1.0 - normal.dot(look.camera.toward()) * normal.dot(look.camera.toward()))
            .max(0.0)
            .sqrt();
        let (by, per_point) = if slope < END_ON {
            // From above, stems are points: upwards on the screen lifts.
            (f64::from(self.pressed.y - at.y) * here, here)
        } else {
            let on = |pos| along(start, normal, look.camera.ray(pos, look.rect)).unwrap_or(0.0);
            (on(at) - on(self.pressed), here / slope)
        };
        let lifted = plan.lift(start);
        let found =
            if free { None } else { self.settled(lifted + by, f64::from(SNAP) * per_point, scene) };
        self.snapped = found.map(|(_, snap)| snap);
        self.by = found.map_or(by, |(lift, _)| lift - lifted);
    }

    /// What a lift settles on within a distance, mm.
    fn settled(&self, lift: f64, within: f64, scene: &Scene<'_>) -> Option<(f64, Snap)> {
        // The plan before others, which may lie close to it and to one another.
        if lift.abs() <= within {
            return Some((0.0, Snap::Plan));
        }
        let plan = scene.document.drawing.plan;
        let moves = |of: &PointRef| self.starts.iter().any(|(moved, _)| moved == of);
        let others = points(scene).filter(|(of, ..)| !moves(of));
        let lifts = others.map(|(of, at, _)| (plan.lift(at), Snap::Level(of)));
        let near = lifts.map(|(to, snap)| ((to - lift).abs(), to, snap)).filter(|n| n.0 <= within);
        let best = near.min_by(|a, b| a.0.total_cmp(&b.0));
        let drawing = &scene.document.drawing;
        let step = drawing.grid_mm;
        let on_grid = || {
            let to = (lift / step).round() * step;
            (drawing.snap_to_grid && (to - lift).abs() <= within).then_some((to, Snap::Grid))
        };
        best.map(|(_, to, snap)| (to, snap)).or_else(on_grid)
    }

    /// A line to what the lift is level with.
    fn paint_snap(&self, painter: &Painter, scene: &Scene<'_>, look: &Look<'_>) {
        let theme = scene.theme;
        let plan = scene.document.drawing.plan;
        let start = self.start();
        let here = start + plan.normal() * self.by;
        let Some(from) = look.camera.seen(here, look.rect) else { return };
        match self.snapped {
            Some(Snap::Level(other)) => {
                let Some(at) = place(scene, other) else { return };
                let Some(to) = look.camera.seen(at, look.rect) else { return };
                let stroke = Stroke::new(1.5, theme.accent);
                dashed(painter, &[from.at, to.at], stroke, 6.0, 4.0);
                painter.circle_stroke(to.at, HANDLE + 4.0, stroke);
            }
            Some(Snap::Plan) => {
                let across = vec2(14.0, 0.0);
                let stroke = Stroke::new(2.0, theme.accent);
                painter.line_segment([from.at - across, from.at + across], stroke);
            }
            Some(Snap::Grid) | None => {}
        }
    }
}

/// Where on a line through `start` along `way`, unit, it is nearest to a ray, mm from the start;
/// `None` if they run alike.
fn along(start: Point3, way: Vec3, ray: Ray) -> Option<f64> {
    let sight = sheetwright::math::unit(ray.way)?;
    let between = start - ray.from;
    let b = way.dot(sight);
    let apart = 1.0 - b * b;
    (apart > 1e-9).then(|| (b * sight.dot(between) - way.dot(between)) / apart)
}

/// Every point of every curve, and whether it is a corner.
fn points<'a>(scene: &Scene<'a>) -> impl Iterator<Item = (PointRef, Point3, bool)> + use<'a> {
    let curves = scene.document.design.curves.iter().enumerate();
    curves.flat_map(|(curve, drawn)| {
        let points = drawn.points.iter().enumerate();
        points.map(move |(point, p)| (PointRef { curve, point }, p.at, p.corner))
    })
}

fn place(scene: &Scene<'_>, of: PointRef) -> Option<Point3> {
    Some(scene.document.design.curves.get(of.curve)?.points.get(of.point)?.at)
}

/// Points and those of other curves on the same spot, which they are joined at.
fn joined(scene: &Scene<'_>, of: &[PointRef]) -> Vec<(PointRef, Point3)> {
    let wanted: Vec<Point3> = of.iter().filter_map(|&p| place(scene, p)).collect();
    let size = wanted.iter().map(|p| p.to_vec().abs().max_element()).fold(1.0, f64::max);
    let moves = |&(p, at, _): &(PointRef, Point3, bool)| {
        of.contains(&p) || wanted.iter().any(|spot| spot.distance(at) <= SAME_SPOT * size)
    };
    points(scene).filter(moves).map(|(p, at, _)| (p, at)).collect()
}

/// Lifts points by a step, mm.
pub(in crate::panes) fn lift(scene: &Scene<'_>, of: &[PointRef], by: f64, acts: &mut Vec<Act>) {
    let way = scene.document.drawing.plan.normal() * by;
    let moved: Vec<_> = joined(scene, of).into_iter().map(|(p, at)| (p, at + way)).collect();
    if !moved.is_empty() {
        acts.extend([Act::Move(moved), Act::Rest]);
    }
}

/// What is selected after a click on a point.
fn clicked(before: &Selection, of: PointRef, more: bool) -> Selection {
    if !more {
        return Selection::of_point(of);
    }
    let mut points = before.points.clone();
    match points.binary_search(&of) {
        Ok(n) => {
            points.remove(n);
        }
        Err(n) => points.insert(n, of),
    }
    let curve = points.last().map(|_| of.curve);
    Selection { points, curve, ..Selection::default() }
}

/// The handles, each a widget of its own.
fn all(ui: &Ui, scene: &Scene<'_>, look: &Look<'_>) -> Vec<Handle> {
    let drawing = &scene.document.drawing;
    let touch = ui.input(|i| i.has_touch_screen());
    let size = Vec2::splat(if touch { TOUCH } else { 2.0 * HANDLE + 8.0 });
    let base = ui.scope_id().with("handle");
    let handle = |(of, at, corner): (PointRef, Point3, bool)| {
        let seen = look.camera.seen(at, look.rect).map(|seen| seen.at);
        // What is out of sight is still there for keys and screen readers.
        let centre = seen.unwrap_or(pos2(-1e4, -1e4));
        let id: Id = base.with((of.curve, of.point));
        let rect = Rect::from_center_size(centre, size);
        let response = ui.interact(rect, id, Sense::click_and_drag());
        let name = || {
            let curve = &scene.document.design.curves[of.curve].name;
            let lift = drawing.plan.lift(at);
            let lifted = match length(lift, drawing.units) {
                _ if lift.abs() < 1e-6 => "on the plan".to_owned(),
                up if lift > 0.0 => format!("lifted {up}"),
                _ => format!("lowered {}", length(-lift, drawing.units)),
            };
            format!("{curve}, point {}, {lifted}", of.point + 1)
        };
        let chosen = scene.selection.points.contains(&of);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, name()));
        ui.ctx().accesskit_node_builder(id, |node| {
            node.add_action(Action::Increment);
            node.add_action(Action::Decrement);
        });
        Handle { of, at, corner, response, seen }
    };
    points(scene).map(handle).collect()
}

fn paint_handle(
    painter: &Painter,
    theme: &Theme,
    at: Pos2,
    handle: &Handle,
    chosen: bool,
    hovered: bool,
    size: f32,
) {
    let focused = handle.response.has_focus();
    let fill = if chosen { theme.accent } else { theme.paper };
    let edge = if chosen || hovered { theme.accent } else { theme.curve };
    let stroke = Stroke::new(1.4, if chosen { theme.paper } else { edge });
    if focused {
        painter.circle_stroke(at, size + 4.0, Stroke::new(2.0, theme.accent));
    }
    if handle.corner {
        let square = Rect::from_center_size(at, Vec2::splat(1.8 * size));
        painter.rect(square, 1.0, fill, stroke, StrokeKind::Middle);
    } else {
        painter.circle(at, size, fill, stroke);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_stays_on_its_stem() {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(600.0, 400.0));
        for perspective in [false, true] {
            let camera = Camera { perspective, ..Camera::default() };
            let start = Point3::new(100.0, 50.0, 0.0);
            let lifted = Point3::new(100.0, 50.0, 120.0);
            let at = camera.seen(lifted, rect).unwrap().at;
            let found = along(start, Vec3::Z, camera.ray(at, rect)).unwrap();
            assert!((found - 120.0).abs() < 0.1, "{found}");
        }
    }

    #[test]
    fn clicks_add_and_take_away() {
        let [a, b] = [0, 1].map(|point| PointRef { curve: 2, point });
        let one = clicked(&Selection::default(), b, false);
        let two = clicked(&one, a, true);
        assert_eq!(two.points, [a, b]);
        assert_eq!(clicked(&two, b, true).points, [a]);
        assert_eq!(clicked(&two, b, false), Selection::of_point(b));
    }
}
