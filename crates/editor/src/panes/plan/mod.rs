//! The plan: outlines are drawn and their handles moved in a plane.
//!
//! One tool at a time: [`Tool::Select`] takes hold of handles, [`Tool::Draw`] records strokes (and
//! single clicks, which put corners), [`Tool::Calibrate`] takes two places of the picture under the
//! drawing. All of them pan with the middle or right button, or two fingers, and zoom with the
//! wheel.

mod drag;
mod handles;
mod paint;
mod snap;
mod view;

use view::PlanView;

use crate::command::Command;
use crate::document::{Edit, PointRef, Selection};
use crate::panes::is_resized;
use crate::panes::lit::Lit;
use crate::panes::space::handles::lift;
use crate::scene::{Act, Scene};
use drag::Drag;
use eframe::egui::{self, Key, PointerButton, Pos2, Rect, Response, Sense, Ui, Vec2};
use handles::Handles;
use sheetwright::math::Point2;
use snap::{Snap, snapped};

/// What the hand does on the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Takes hold of handles.
    #[default]
    Select,
    /// Draws curves.
    Draw,
    /// Takes two places of the picture.
    Calibrate,
}

/// The pane.
pub struct PlanPane {
    /// What the hand does.
    pub tool: Tool,
    view: PlanView,
    /// Where the pane lay in the last frame.
    pane: Rect,
    /// How large the pane was when everything was brought into sight; `None` if that is to be done.
    fitted: Option<Vec2>,
    /// Whether the hand has moved the view since then.
    is_by_hand: bool,
    /// The stroke under way, mm.
    stroke: Vec<Point2>,
    /// Corners put by single clicks, mm.
    corners: Vec<Point2>,
    /// The two places of the picture, mm, once the first is taken.
    calibrated: Vec<Point2>,
    /// The box that is drawn round handles: where it began, on the screen.
    lasso: Option<Pos2>,
    drag: Option<Drag>,
    snaps: Vec<Snap>,
    picture: paint::ReferencePicture,
    outlines: paint::Outlines,
}

/// How far a snap may jump, points of the screen.
const SNAP: f64 = 7.0;
/// What the right button offers.
const MENU: [Command; 7] = [
    Command::ToggleCorner,
    Command::ToggleStraight,
    Command::Join,
    Command::Reverse,
    Command::Delete,
    Command::SelectAll,
    Command::Fit,
];
/// A stroke begins when the hand has moved this far, points of the screen.
const STROKE_STEP: f64 = 2.0;

impl Default for PlanPane {
    fn default() -> Self {
        Self {
            tool: Tool::default(),
            view: PlanView::default(),
            pane: Rect::ZERO,
            fitted: None,
            is_by_hand: false,
            stroke: Vec::new(),
            corners: Vec::new(),
            calibrated: Vec::new(),
            lasso: None,
            drag: None,
            snaps: Vec::new(),
            picture: paint::ReferencePicture::default(),
            outlines: paint::Outlines::default(),
        }
    }
}

impl PlanPane {
    /// Brings everything into sight with the next frame.
    pub fn fit(&mut self) {
        self.fitted = None;
    }

    /// Brings everything into sight, if that is to be done, or if the pane has another size now and
    /// the hand has left the view as it was. What is under way stays where it is.
    fn settle(&mut self, pane: Rect, scene: &Scene<'_>) {
        let is_busy = self.drag.is_some() || !self.stroke.is_empty() || !self.corners.is_empty();
        let resized = self.fitted.is_some_and(|size| is_resized(size, pane.size()));
        if self.fitted.is_none() || resized && !self.is_by_hand && !is_busy {
            self.view.fit(pane, view::extent(scene.document));
            self.fitted = Some(pane.size());
            self.is_by_hand = false;
        }
    }

    /// Ends what is under way; whether there was something.
    pub fn escape(&mut self) -> bool {
        let was_busy = !self.stroke.is_empty() || !self.corners.is_empty();
        self.stroke.clear();
        self.corners.clear();
        self.calibrated.clear();
        self.lasso = None;
        if self.tool == Tool::Select || was_busy {
            return was_busy;
        }
        self.tool = Tool::Select;
        true
    }

    /// What the hand holds is let go where it is: the pane is not shown any more.
    pub(crate) fn let_go(&mut self, acts: &mut Vec<Act>) {
        self.stroke.clear();
        self.lasso = None;
        if self.drag.take().is_some() {
            acts.push(Act::Rest);
        }
    }

    /// Where a place of the plan, mm, lies on the screen.
    pub fn on_screen(&self, p: Point2) -> Pos2 {
        self.view.to_screen(self.pane, p)
    }

    /// The two places of the picture, mm, once both are taken; they are given away.
    pub fn take_calibrated(&mut self) -> Option<[Point2; 2]> {
        let &[a, b] = &self.calibrated[..] else { return None };
        self.calibrated.clear();
        self.tool = Tool::Select;
        Some([a, b])
    }

    /// Shows the pane.
    pub fn ui(&mut self, ui: &mut Ui, scene: &Scene<'_>, acts: &mut Vec<Act>) {
        let pane = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(pane, Sense::click_and_drag());
        self.pane = pane;
        self.settle(pane, scene);
        self.snaps.clear();
        let view = self.view;
        self.navigate(ui, &response, pane);
        let handles = Handles::new(scene, self.view, pane);
        match self.tool {
            Tool::Select => self.select(ui, &response, pane, scene, &handles, acts),
            Tool::Draw => self.draw(ui, &response, pane, scene, acts),
            Tool::Calibrate => self.calibrate(&response, pane),
        }
        self.keys(ui, &response, scene, acts);
        self.is_by_hand |= self.view != view;
        self.paint(ui, &response, pane, scene, &handles);
        Self::menu(&response, &handles, scene, acts);
        handles.widgets(ui, scene, acts);
        let said = paint::said(scene, self.tool);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, said.clone()));
    }

    fn navigate(&mut self, ui: &Ui, response: &Response, pane: Rect) {
        let pans = |button| response.dragged_by(button);
        let is_space = ui.input(|i| i.key_down(Key::Space));
        if pans(PointerButton::Middle)
            || pans(PointerButton::Secondary)
            || is_space && pans(PointerButton::Primary)
        {
            self.view.pan(response.drag_delta());
        }
        if let Some(touch) = ui.input(egui::InputState::multi_touch)
            && response.rect.contains(touch.center_pos)
        {
            self.view.pan(touch.translation_delta);
            self.view.zoom(pane, touch.center_pos, f64::from(touch.zoom_delta));
            // What a finger began before the second one came was no stroke.
            self.stroke.clear();
            self.lasso = None;
        } else if let Some(at) = response.hover_pos() {
            let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta(), i.zoom_delta()));
            let by = f64::from(pinch) * sheetwright::math::pow(1.0015, f64::from(scroll.y));
            if by != 1.0 {
                self.view.zoom(pane, at, by);
            }
        }
    }

    fn select(
        &mut self,
        ui: &Ui,
        response: &Response,
        pane: Rect,
        scene: &Scene<'_>,
        handles: &Handles,
        acts: &mut Vec<Act>,
    ) {
        let is_adding = ui.input(|i| i.modifiers.shift || i.modifiers.command);
        let is_space = ui.input(|i| i.key_down(Key::Space));
        let pressed = ui.input(|i| i.pointer.press_origin());
        if response.drag_started_by(PointerButton::Primary) && !is_space {
            match pressed.and_then(|at| Some((at, handles.at(at)?))) {
                Some((at, held)) => self.take_hold(held, at, pane, scene, acts),
                None => self.lasso = pressed,
            }
        }
        if let (Some(drag), Some(at)) = (&self.drag, response.interact_pointer_pos()) {
            let hand = self.view.to_plan(pane, at);
            let wanted = Point2::new(hand.x - drag.grip.x, hand.y - drag.grip.y);
            let (to, snaps) = self.snapped_drag(ui, drag, wanted, scene, handles);
            let moved = drag.moved(to, &snaps, scene);
            self.snaps = snaps;
            acts.push(Act::Move(moved));
        }
        if response.drag_stopped() {
            if self.drag.take().is_some() {
                acts.push(Act::Rest);
            }
            if let (Some(from), Some(to)) = (self.lasso.take(), response.interact_pointer_pos()) {
                let points = handles.within(Rect::from_two_pos(from, to));
                acts.push(Act::Select(Selection { points, ..Selection::default() }));
            }
        }
        let Some(at) = response.interact_pointer_pos() else { return };
        if response.double_clicked() {
            if handles.at(at).is_none()
                && let Some(curve) = self.outlines.nearest(pane, self.view, at)
            {
                acts.push(Act::Edit(Edit::InsertPoint { curve, at: self.view.to_plan(pane, at) }));
            }
        } else if response.clicked() {
            let selection = match handles.at(at) {
                Some(point) if is_adding => with_toggled(scene.selection, point),
                Some(point) => Selection::of_point(point),
                None => {
                    let curve = self.outlines.nearest(pane, self.view, at);
                    Selection { curve, ..Selection::default() }
                }
            };
            acts.push(Act::Select(selection));
        }
    }

    fn take_hold(
        &mut self,
        held: PointRef,
        at: Pos2,
        pane: Rect,
        scene: &Scene<'_>,
        acts: &mut Vec<Act>,
    ) {
        let mut points = scene.selection.points.clone();
        if !points.contains(&held) {
            points = vec![held];
            acts.push(Act::Select(Selection::of_point(held)));
        }
        self.drag = Drag::new(held, &points, self.view.to_plan(pane, at), scene);
    }

    /// Where the handle under the hand settles.
    fn snapped_drag(
        &self,
        ui: &Ui,
        drag: &Drag,
        wanted: Point2,
        scene: &Scene<'_>,
        handles: &Handles,
    ) -> (Point2, Vec<Snap>) {
        if ui.input(|i| i.modifiers.alt) {
            return (wanted, Vec::new());
        }
        let others: Vec<Point2> =
            handles.all().filter(|(r, _)| !drag.moves(*r)).map(|h| h.1).collect();
        let may_meet: Vec<Point2> =
            handles.all().filter(|(r, _)| drag.may_meet(*r)).map(|h| h.1).collect();
        snapped(wanted, &may_meet, &others, &scene.document.drawing, SNAP / self.view.scale)
    }

    fn draw(
        &mut self,
        ui: &Ui,
        response: &Response,
        pane: Rect,
        scene: &Scene<'_>,
        acts: &mut Vec<Act>,
    ) {
        let is_space = ui.input(|i| i.key_down(Key::Space));
        let reach = SNAP / self.view.scale;
        if response.drag_started_by(PointerButton::Primary)
            && !is_space
            && let Some(origin) = ui.input(|i| i.pointer.press_origin())
        {
            self.stroke = vec![self.on_point(self.view.to_plan(pane, origin), scene)];
        }
        if !self.stroke.is_empty() {
            // Every place since the last frame: a quick hand moves far in one.
            let events = ui.input(|i| i.events.clone());
            let moved = events.iter().filter_map(|event| match event {
                egui::Event::PointerMoved(at) => Some(*at),
                _ => None,
            });
            for at in moved.chain(response.interact_pointer_pos()) {
                let p = self.view.to_plan(pane, at);
                let is_far = |last: &Point2| last.distance(p) * self.view.scale >= STROKE_STEP;
                if self.stroke.last().is_some_and(is_far) {
                    self.stroke.push(p);
                }
            }
            if response.drag_stopped() {
                let mut places = std::mem::take(&mut self.stroke);
                if let Some(end) = places.last_mut() {
                    *end = self.on_point(*end, scene);
                }
                acts.push(Act::Edit(Edit::Stroke { places, grain_mm: 1.0 / self.view.scale }));
            }
            return;
        }
        let Some(at) = response.hover_pos().or(response.interact_pointer_pos()) else { return };
        let (to, snaps) = self.snapped_corner(self.view.to_plan(pane, at), reach, scene);
        self.snaps = snaps;
        let first = self.corners.first().copied();
        if response.clicked() {
            let closes = first.is_some_and(|f| self.corners.len() > 2 && f.distance(to) <= reach);
            let is_repeated =
                self.corners.last().is_some_and(|last| last.distance(to) <= reach / 4.0);
            if closes || response.double_clicked() && self.corners.len() > 1 {
                self.finish_corners(closes, acts);
            } else if !is_repeated {
                self.corners.push(to);
            }
        }
    }

    /// Where the next corner settles.
    fn snapped_corner(&self, wanted: Point2, reach: f64, scene: &Scene<'_>) -> (Point2, Vec<Snap>) {
        let places: Vec<Point2> = view::places(scene.document).collect();
        // The first corner, which closes the outline, before what others it lies on.
        let first = self.corners.first().filter(|_| self.corners.len() > 2);
        let points: Vec<Point2> = match first.filter(|first| first.distance(wanted) <= reach) {
            Some(&first) => vec![first],
            None => places.iter().filter(|&p| !self.corners.contains(p)).copied().collect(),
        };
        let lines: Vec<Point2> = self.corners.iter().copied().chain(places).collect();
        snapped(wanted, &points, &lines, &scene.document.drawing, reach)
    }

    /// The place of the handle of a curve that is near a place of the plan, or that place itself.
    fn on_point(&self, at: Point2, scene: &Scene<'_>) -> Point2 {
        let near = view::places(scene.document).map(|p| (p.distance(at) * self.view.scale, p));
        let near = near.filter(|(points, _)| *points <= SNAP);
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(at, |(_, p)| p)
    }

    /// What was clicked becomes a curve.
    fn finish_corners(&mut self, closed: bool, acts: &mut Vec<Act>) {
        let corners = std::mem::take(&mut self.corners);
        if corners.len() >= if closed { 3 } else { 2 } {
            acts.push(Act::Edit(Edit::Corners { corners, closed }));
        }
    }

    fn calibrate(&mut self, response: &Response, pane: Rect) {
        if response.clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            self.calibrated.push(self.view.to_plan(pane, at));
            self.calibrated.truncate(2);
        }
    }

    fn keys(&mut self, ui: &Ui, response: &Response, scene: &Scene<'_>, acts: &mut Vec<Act>) {
        // Keys that a field or a page has are not for the plan.
        let is_free = ui.memory(|m| m.allows_interaction(response.layer_id));
        if !self.corners.is_empty() && is_free && !ui.ctx().text_edit_focused() {
            let (enter, back) =
                ui.input(|i| (i.key_pressed(Key::Enter), i.key_pressed(Key::Backspace)));
            if enter {
                let closes = self.corners.len() > 2;
                self.finish_corners(closes, acts);
            } else if back {
                self.corners.pop();
            }
        }
        // After a click nothing has the keys; then they are for what is selected on the plan.
        let is_nobodys = is_free && ui.memory(|m| m.focused().is_none());
        if !(response.has_focus() || is_nobodys) {
            return;
        }
        ui.memory_mut(|m| {
            let filter = egui::EventFilter {
                horizontal_arrows: true,
                vertical_arrows: true,
                ..egui::EventFilter::default()
            };
            m.set_focus_lock_filter(response.id, filter);
        });
        let fine = if ui.input(|i| i.modifiers.shift) { 0.1 } else { 1.0 };
        let step = scene.document.drawing.grid_mm * fine;
        let pressed = |key| ui.input(|i| i.num_presses(key)) as f64;
        let by = Point2::new(
            (pressed(Key::ArrowRight) - pressed(Key::ArrowLeft)) * step,
            (pressed(Key::ArrowUp) - pressed(Key::ArrowDown)) * step,
        );
        if by != Point2::new(0.0, 0.0) && !scene.selection.points.is_empty() {
            acts.push(Act::Move(handles::moved_by(scene, by)));
            acts.push(Act::Rest);
        }
        let lifted = (pressed(Key::PageUp) - pressed(Key::PageDown)) * step;
        if lifted != 0.0 {
            lift(scene, &scene.selection.points, lifted, acts);
        }
        let (zoom_in, zoom_out) = ui.input(|i| {
            let plain = i.modifiers.is_none() || i.modifiers.shift_only();
            (plain && i.key_pressed(Key::Plus), plain && i.key_pressed(Key::Minus))
        });
        if zoom_in || zoom_out {
            let by = if zoom_in { 1.25 } else { 0.8 };
            self.view.zoom(response.rect, response.rect.center(), by);
        }
    }

    fn paint(
        &mut self,
        ui: &mut Ui,
        response: &Response,
        pane: Rect,
        scene: &Scene<'_>,
        handles: &Handles,
    ) {
        let painter = ui.painter_at(pane);
        let canvas = paint::PlanCanvas { painter: &painter, pane, view: self.view, scene };
        canvas.ground();
        self.picture.show(&canvas, ui.ctx());
        canvas.grid();
        canvas.panels();
        self.outlines.show(&canvas);
        let hovered = response.hover_pos().and_then(|at| handles.at(at));
        let hand = response.hover_pos().or(response.interact_pointer_pos());
        let curve = hand.and_then(|at| self.outlines.nearest(pane, self.view, at));
        let held = self.drag.iter().flat_map(|drag| &drag.moving);
        let under = hovered.iter().chain(held).map(|r| r.curve).chain(curve);
        let boxed = self.lasso.zip(response.interact_pointer_pos());
        let boxed = boxed.map(|(from, to)| Rect::from_two_pos(from, to));
        canvas.handles(handles, hovered, &Lit::new(scene, under), boxed);
        canvas.stroke(&self.stroke, &self.corners, response.hover_pos());
        canvas.places(&self.calibrated);
        canvas.snaps(&self.snaps);
        canvas.scale();
        if let Some(area) = boxed {
            canvas.lasso(area);
        }
        if scene.document.is_undrawn() && self.stroke.is_empty() && self.corners.is_empty() {
            canvas.invitation(self.tool);
        }
        let is_on_curve = curve.is_some();
        let icon = match self.tool {
            Tool::Draw | Tool::Calibrate => egui::CursorIcon::Crosshair,
            Tool::Select if self.drag.is_some() => egui::CursorIcon::Grabbing,
            Tool::Select if hovered.is_some() => egui::CursorIcon::Grab,
            Tool::Select if is_on_curve => egui::CursorIcon::PointingHand,
            Tool::Select => egui::CursorIcon::Default,
        };
        if response.hovered() || self.drag.is_some() {
            ui.set_cursor_icon(icon);
        }
    }

    /// What can be done with what lies under the right button.
    fn menu(response: &Response, handles: &Handles, scene: &Scene<'_>, acts: &mut Vec<Act>) {
        if response.secondary_clicked()
            && let Some(point) = response.interact_pointer_pos().and_then(|at| handles.at(at))
            && !scene.selection.points.contains(&point)
        {
            acts.push(Act::Select(Selection::of_point(point)));
        }
        response.context_menu(|ui| {
            for command in MENU {
                if ui.button(command.name()).on_hover_text(command.tooltip()).clicked() {
                    acts.push(Act::Run(command));
                    ui.close();
                }
            }
        });
    }
}

/// A selection with one point more, or less.
fn with_toggled(selection: &Selection, point: PointRef) -> Selection {
    let mut points = selection.points.clone();
    match points.binary_search(&point) {
        Ok(n) => {
            points.remove(n);
        }
        Err(n) => points.insert(n, point),
    }
    Selection { points, curve: Some(point.curve), ..Selection::default() }
}
