//! The right pane: the sheets in space, looked at from anywhere, with the handles that lift curves
//! off the plan.
//!
//! ```text
//! scene ──► picture (triangles, lines) ──► graphics card ──► pane
//!   │            ▲ only when something changed                ▲
//!   └──► handles, labels, cube, legend ── drawn by egui ──────┘
//! ```
//!
//! Without a graphics card nothing of the picture shows, but everything else works.

pub mod camera;
mod gauss;
mod gpu;
pub(crate) mod handles;
pub(crate) mod legend;
mod lines;
pub mod navigation;
pub(crate) mod pick;
pub(crate) mod picture;
pub(crate) mod sheets;
mod view_cube;

use crate::panes::is_resized;
use crate::panes::lit::are_many;
use crate::panes::marks::{Marks, SPOT};
use crate::panes::measured::{Quantity, twist, worst_colour, worst_of_all};
use crate::panes::tag::tag;
use crate::panes::words::{self, degrees};
use crate::scene::{Act, Scene};
use crate::views::{Navigation, SurfaceView};
use camera::{Camera, Direction};
use eframe::CreationContext;
use eframe::egui::accesskit::Role;
use eframe::egui::emath::GuiRounding as _;
use eframe::egui::{
    Align2, EventFilter, FontId, PointerButton, Pos2, Rect, Response, Sense, Stroke, StrokeKind,
    Ui, UiBuilder, Vec2, WidgetInfo, vec2,
};
use eframe::egui_wgpu::Callback;
use handles::{Handles, Look};
use legend::Legend;
use picture::{Built, around, colour};
use sheetwright::check::Place;
use sheetwright::math::{Point3, Vec3};

/// How much is seen of the Gauss image, whose sphere has the radius 1.
const GAUSS_HEIGHT: f64 = 2.7;
/// Seconds that a turn to another view takes.
const TURN: f64 = 0.25;

/// The pane, with what it keeps from frame to frame.
#[derive(Debug)]
pub struct SpacePane {
    /// From where the sheets are looked at.
    pub camera: Camera,
    /// Whose habits the hand has.
    pub navigation: Navigation,
    gauss: Camera,
    /// Whether it was turned to the middle of the image.
    gauss_turned: bool,
    built: Built,
    handles: Handles,
    turn: Option<Turn>,
    /// What is to be brought into sight once the size of the pane is known.
    to_fit: Fit,
    /// A panel and a place on it that are to be brought into sight.
    to_bring: Option<(usize, Place)>,
    /// How large the pane was when everything was brought into sight, unless the hand has shifted
    /// or zoomed since then.
    fitted: Option<Vec2>,
    has_card: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fit {
    No,
    /// At once, when there is something to see.
    AtFirst,
    /// In a way that the eye can follow.
    Asked,
}

/// From where the whole sphere of the Gauss image is seen in a pane, with its words above it.
fn gauss_camera(rect: Rect) -> Camera {
    let narrow = f64::from(rect.height() / rect.width()).max(1.0);
    Camera { perspective: false, height_mm: GAUSS_HEIGHT * narrow, ..Camera::default() }
}

/// A turn on its way.
#[derive(Clone, Copy, Debug)]
struct Turn {
    from: Camera,
    to: Camera,
    since: f64,
}

impl SpacePane {
    /// A pane that draws on the window's graphics card, if it has one.
    pub fn new(cc: &CreationContext<'_>) -> Self {
        let card = cc.wgpu_render_state.as_ref();
        if let Some(card) = card {
            gpu::prepare_card(card);
        }
        Self {
            camera: Camera::default(),
            navigation: Navigation::default(),
            gauss: Camera::default(),
            gauss_turned: false,
            built: Built::default(),
            handles: Handles::default(),
            turn: None,
            to_fit: Fit::AtFirst,
            to_bring: None,
            fitted: None,
            has_card: card.is_some(),
        }
    }

    /// Brings everything into sight.
    pub fn fit(&mut self) {
        self.to_fit = Fit::Asked;
    }

    /// Brings a place on a panel into sight, where it is not.
    pub(crate) fn bring_into_sight(&mut self, panel: usize, place: Place) {
        self.to_bring = Some((panel, place));
    }

    /// What the hand holds is let go where it is: the pane is not shown any more.
    pub(crate) fn let_go(&mut self, acts: &mut Vec<Act>) {
        self.handles.let_go(acts);
    }

    /// Looks from another direction, at the same place.
    pub fn look_from(&mut self, direction: Direction, ui: &Ui) {
        let to = Camera { direction, ..self.camera };
        self.go(to, ui);
    }

    /// Shows the scene and answers the hand.
    pub fn ui(&mut self, ui: &mut Ui, scene: &Scene<'_>, view: SurfaceView, acts: &mut Vec<Act>) {
        let (rect, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        if !rect.is_positive() {
            return;
        }
        let mut ui = ui.new_child(UiBuilder::new().max_rect(rect).id_salt("space"));
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        let ui = &ui;
        self.built.update(scene, view);
        let ground = ui.interact(rect, ui.scope_id().with("ground"), Sense::click_and_drag());
        name(ui, &ground, scene);
        self.settle(ui, scene, view, rect);
        self.navigate(ui, view, rect, &ground);
        if ground.clicked() || ground.drag_started() {
            ground.request_focus();
        }
        let is_gauss = view == SurfaceView::Gauss;
        let camera = if is_gauss { self.gauss } else { self.camera };
        self.paint_picture(ui, scene, view, &camera, rect);
        if ground.has_focus() {
            let ring = Stroke::new(1.5, scene.theme.accent);
            ui.painter().rect_stroke(rect, 0.0, ring, StrokeKind::Inside);
        }
        if is_gauss {
            self.paint_gauss(ui, scene, &camera, rect);
        } else {
            let hand = ui.input(|i| i.pointer.hover_pos());
            let hand = hand.filter(|_| ui.rect_contains_pointer(rect) && are_many(scene));
            let curve = hand.and_then(|hand| self.built.nearest(&camera, rect, hand));
            let look = Look { camera: &camera, rect, ground: &ground, curve };
            if let Some(other) = self.handles.ui(ui, scene, &look, acts) {
                self.turn = None;
                let before = (self.camera.target, self.camera.height_mm);
                navigation::drag(&mut self.camera, self.navigation, &other, rect, ui);
                self.notice_hand(before);
            }
            labels(ui, scene, view, &camera, rect);
            self.click(ui, scene, &ground, rect, acts);
        }
        if let Some(by) = Quantity::of(view, scene.made().map(|(_, shown)| shown))
            && !scene.panels.is_empty()
        {
            Legend::of(scene, by).ui(ui, rect, scene.theme);
        }
        let (asked, cube) = view_cube::ui(ui, &camera, rect, scene.theme);
        if let Some(direction) = asked {
            if is_gauss {
                self.gauss.direction = direction;
            } else {
                self.look_from(direction, ui);
            }
            ui.ctx().request_repaint();
        }
        if cube.dragged_by(PointerButton::Primary) {
            self.turn = None;
            let small = Rect::from_min_size(rect.min, vec2(240.0, 240.0));
            self.active(view).orbit(cube.drag_delta(), small);
            ui.ctx().request_repaint();
        }
        empty(ui, scene, rect);
    }

    fn active(&mut self, view: SurfaceView) -> &mut Camera {
        if view == SurfaceView::Gauss { &mut self.gauss } else { &mut self.camera }
    }

    /// Starts a turn, or is there at once where people want no animation.
    fn go(&mut self, to: Camera, ui: &Ui) {
        if ui.style().animation_time > 0.0 {
            let since = ui.input(|i| i.time);
            self.turn = Some(Turn { from: self.camera, to, since });
            ui.ctx().request_repaint();
        } else {
            self.camera = to;
        }
    }

    /// Brings into sight what is to be, and goes on with a turn.
    fn settle(&mut self, ui: &Ui, scene: &Scene<'_>, view: SurfaceView, rect: Rect) {
        let resized = self.fitted.is_some_and(|size| is_resized(size, rect.size()));
        if resized && self.to_fit == Fit::No && !self.handles.dragging() {
            self.to_fit = Fit::AtFirst;
        }
        if self.to_fit != Fit::No {
            let points: Vec<Point3> = self.built.points(scene);
            if !points.is_empty() {
                let mut to = self.turn.map_or(self.camera, |turn| turn.to);
                to.fit(&points, rect);
                match self.to_fit {
                    Fit::Asked => self.go(to, ui),
                    _ => (self.camera, self.turn) = (to, None),
                }
                self.to_fit = Fit::No;
                self.fitted = Some(rect.size());
            } else if self.to_fit == Fit::Asked {
                self.to_fit = Fit::AtFirst;
            }
            if view == SurfaceView::Gauss {
                self.gauss = Camera { direction: self.gauss.direction, ..gauss_camera(rect) };
            }
        }
        self.bring(ui, scene, rect);
        // The first look at the image is at its middle.
        if view == SurfaceView::Gauss && !self.gauss_turned {
            self.gauss = gauss_camera(rect);
            if let Some(middle) = gauss::middle(scene) {
                self.gauss.direction = Direction::towards(middle);
                self.gauss_turned = true;
            }
        }
        if let Some(turn) = self.turn {
            let share = ((ui.input(|i| i.time) - turn.since) / TURN).clamp(0.0, 1.0);
            // Quickly away, gently there.
            let eased = 1.0 - (1.0 - share) * (1.0 - share) * (1.0 - share);
            self.camera = turn.from.on_the_way(&turn.to, eased);
            if share < 1.0 {
                ui.ctx().request_repaint();
            } else {
                self.camera = turn.to;
                self.turn = None;
            }
        }
    }

    /// Looks at what is to be seen, unless it is in sight: from where it looks now, or
    /// from the other side if that shows the back of the sheet there.
    fn bring(&mut self, ui: &Ui, scene: &Scene<'_>, rect: Rect) {
        let Some((panel, place)) = self.to_bring.take() else { return };
        let Some(Ok(shown)) = scene.panels.get(panel).map(|panel| &panel.made) else { return };
        let marks = Marks::of(&place, shown);
        let points = marks.points();
        if points.is_empty() {
            return;
        }
        let mut to = self.turn.map_or(self.camera, |turn| turn.to);
        let is_seen = |p: &Point3| to.seen(*p, rect).is_some_and(|seen| rect.contains(seen.at));
        let direction = to.facing(marks.facing);
        if direction != to.direction || !points.iter().all(is_seen) {
            let (middle, radius) = around(&points);
            to.direction = direction;
            to.target = middle;
            // It is seen with what is round it.
            to.height_mm = to.height_mm.max(6.0 * radius);
            self.go(to, ui);
        }
    }

    fn navigate(&mut self, ui: &Ui, view: SurfaceView, rect: Rect, ground: &Response) {
        let by = self.navigation;
        let held = self.handles.dragging();
        let before = (self.camera.target, self.camera.height_mm);
        let camera = self.active(view);
        let mut moved = navigation::drag(camera, by, ground, rect, ui);
        if !held {
            moved |= navigation::wheel(camera, rect, ui);
        }
        if ground.has_focus() {
            let arrows = EventFilter {
                horizontal_arrows: true,
                vertical_arrows: true,
                ..EventFilter::default()
            };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(ground.id, arrows));
            moved |= navigation::keys(camera, rect, ui);
        }
        if moved {
            self.turn = None;
        }
        self.notice_hand(before);
    }

    /// A view that the hand has shifted or zoomed stays as it is when the pane changes its size;
    /// one that was only turned does not.
    fn notice_hand(&mut self, before: (Point3, f64)) {
        if before != (self.camera.target, self.camera.height_mm) {
            self.fitted = None;
        }
    }

    fn click(
        &mut self,
        ui: &Ui,
        scene: &Scene<'_>,
        ground: &Response,
        rect: Rect,
        acts: &mut Vec<Act>,
    ) {
        let Some(at) = ground.interact_pointer_pos() else { return };
        if !ground.clicked() {
            return;
        }
        let found = pick::selected(scene, &self.camera, rect, at);
        if ground.double_clicked() && found.is_empty() {
            self.fit();
            ui.ctx().request_repaint();
        } else if found != *scene.selection {
            acts.push(Act::Select(found));
        }
    }

    fn paint_picture(
        &self,
        ui: &Ui,
        scene: &Scene<'_>,
        view: SurfaceView,
        camera: &Camera,
        rect: Rect,
    ) {
        let painter = ui.painter();
        painter.rect_filled(rect, 0.0, scene.theme.paper);
        if !self.has_card {
            return;
        }
        let scale = ui.pixels_per_point();
        let globals = self.built.globals(camera, rect, scale, view, scene.theme);
        let size = [rect.width(), rect.height()].map(|side| (side * scale).round() as u32);
        let ground = colour(scene.theme.paper);
        let picture = self.built.picture.clone();
        let frame = gpu::Frame { picture, globals, ground, size };
        painter.add(Callback::new_paint_callback(rect, frame));
    }

    fn paint_gauss(&self, ui: &Ui, scene: &Scene<'_>, camera: &Camera, rect: Rect) {
        let theme = scene.theme;
        for (axis, name) in [(Vec3::X, "x"), (Vec3::Y, "y"), (Vec3::Z, "z")] {
            if let Some(seen) = camera.seen(Point3::from_vec(axis * 1.25), rect)
                && axis.dot(camera.toward()) > -0.2
            {
                let font = FontId::proportional(13.0);
                ui.painter().text(seen.at, Align2::CENTER_CENTER, name, font, theme.ink);
            }
        }
        let text = match gauss::middle(scene) {
            Some(_) => {
                "The directions that the sheet faces. A line bends freely, a band twists: its colour says how far."
            }
            None => "There is no sheet yet.",
        };
        // Below, beside the axis that points down.
        let width = (0.5 * rect.width() - 40.0).max(120.0);
        let font = FontId::proportional(13.0);
        let galley = ui.painter().layout(text.to_owned(), font, theme.faint, width);
        let at = rect.left_bottom() + vec2(14.0, -12.0 - galley.size().y);
        ui.painter().galley(at, galley, theme.faint);
    }
}

/// The name of the pane and what there is to say of it.
fn name(ui: &Ui, ground: &Response, scene: &Scene<'_>) {
    ground.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Space"));
    ui.ctx().accesskit_node_builder(ground.id, |node| {
        node.set_description(words::description(scene));
    });
}

/// The worst rung and the selected one say how far they twist; spots that are marked stand out.
fn labels(ui: &Ui, scene: &Scene<'_>, view: SurfaceView, camera: &Camera, rect: Rect) {
    let theme = scene.theme;
    let at_rung = |panel: usize, rung: usize| {
        let shown = scene.panels.get(panel)?.made.as_ref().ok()?;
        let found = shown.rungs.get(rung)?;
        let ends = found.ends.map(|end| shown.positions.get(end as usize).copied());
        let [Some(a), Some(b)] = ends else { return None };
        Some((shown, found, camera.seen(a.lerp(b, 0.5), rect)?.at))
    };
    let selected = scene.selection.rung();
    let paint = |at: Pos2, text: &str, colour| {
        if !rect.contains(at) {
            return;
        }
        let painter = ui.painter();
        let to = at + vec2(26.0, -26.0);
        painter.line_segment([at, to], Stroke::new(1.2, colour));
        painter.circle_filled(at, 3.0, colour);
        tag(painter, theme, to, text, colour, rect);
    };
    if let Some((panel, rung)) = worst_of_all(scene)
        && let Some((shown, found, at)) = at_rung(panel, rung)
        && selected != Some((panel, rung))
    {
        let most = twist(found);
        let asked = matches!(view, SurfaceView::Warp | SurfaceView::Rungs);
        if asked || most > shown.warp_limit_deg {
            paint(at, &format!("{} here", degrees(most)), worst_colour(shown, rung, theme));
        }
    }
    if let Some((panel, rung)) = selected
        && let Some((_, found, at)) = at_rung(panel, rung)
    {
        let unsure = if found.is_unsure && found.warp_deg > 0.05 { " or less" } else { "" };
        let text = format!("rung {}: {}{unsure} of twist", rung + 1, degrees(found.warp_deg));
        paint(at, &text, theme.accent);
    }
    let chosen = scene.selection.panel.and_then(|n| scene.panels.get(n)?.made.as_ref().ok());
    let marks = chosen.map(|shown| Marks::of(&scene.selection.place, shown)).unwrap_or_default();
    for seen in marks.spots.iter().filter_map(|&spot| camera.seen(spot, rect)) {
        ui.painter().circle(seen.at, SPOT, theme.accent, Stroke::new(1.0, theme.paper));
    }
}

/// What to do where there is nothing yet.
fn empty(ui: &Ui, scene: &Scene<'_>, rect: Rect) {
    if scene.document.is_undrawn() {
        let text = "What you draw on the plan stands here in space.";
        let font = FontId::proportional(14.0);
        ui.painter().text(rect.center(), Align2::CENTER_CENTER, text, font, scene.theme.faint);
    }
}
