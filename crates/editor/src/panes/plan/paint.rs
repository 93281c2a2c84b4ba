//! How the plan looks.

use super::Tool;
use super::handles::Handles;
use super::snap::Snap;
use super::view::{PlanView, grid_step};
use crate::document::PointRef;
use crate::document::{Plan, Reference};
use crate::panes::dashes::dashed;
use crate::panes::lit::{Lit, paint_dim};
use crate::panes::marks::{Marks, SPOT};
use crate::scene::Scene;
use crate::theme::{CURVE_WIDTH, HANDLE};
use eframe::egui::{
    self, Align2, Color32, CornerRadius, FontId, Painter, Pos2, Rect, Shape, Stroke, TextureHandle,
    Vec2, pos2, vec2,
};
use sheetwright::curve::Curve;
use sheetwright::design::DesignCurve;
use sheetwright::math::Point2;

/// The plan as it is drawn on: painter, pane and view.
pub(super) struct PlanCanvas<'a> {
    pub(super) painter: &'a Painter,
    pub(super) pane: Rect,
    pub(super) view: PlanView,
    pub(super) scene: &'a Scene<'a>,
}

impl PlanCanvas<'_> {
    fn at(&self, p: Point2) -> Pos2 {
        self.view.to_screen(self.pane, p)
    }

    pub(super) fn ground(&self) {
        self.painter.rect_filled(self.pane, CornerRadius::ZERO, self.scene.theme.paper);
    }

    /// The grid, its axes, and the mirror.
    pub(super) fn grid(&self) {
        let theme = self.scene.theme;
        let drawing = &self.scene.document.drawing;
        let step = grid_step(self.view.scale, drawing.grid_mm);
        let low = self.view.to_plan(self.pane, self.pane.left_bottom());
        let high = self.view.to_plan(self.pane, self.pane.right_top());
        let lines = |from: f64, to: f64| {
            let (first, last) = ((from / step).ceil(), (to / step).floor());
            // Even the smallest window has fewer lines than a screen has points.
            let count = (last - first).clamp(-1.0, 10_000.0) as i64;
            (0..=count).map(move |n| first + n as f64)
        };
        let colour = |n: f64| theme.grid[usize::from(n.rem_euclid(10.0) == 0.0)];
        for n in lines(low.x, high.x) {
            let x = self.at(Point2::new(n * step, 0.0)).x;
            self.painter.vline(x, self.pane.y_range(), Stroke::new(1.0, colour(n)));
        }
        for n in lines(low.y, high.y) {
            let y = self.at(Point2::new(0.0, n * step)).y;
            self.painter.hline(self.pane.x_range(), y, Stroke::new(1.0, colour(n)));
        }
        let origin = self.at(Point2::new(0.0, 0.0));
        let [across, up] = match drawing.plan {
            Plan::Top => [0, 1],
            Plan::Front => [0, 2],
            Plan::Side => [1, 2],
        };
        let axis = |n: usize| Stroke::new(1.0, theme.axes[n].gamma_multiply(0.55));
        self.painter.hline(self.pane.x_range(), origin.y, axis(across));
        self.painter.vline(origin.x, self.pane.y_range(), axis(up));
        if let Some(mirror) = drawing.mirror {
            let stroke = Stroke::new(1.5, theme.mirror);
            let at = self.at(Point2::new(mirror.at_mm, mirror.at_mm));
            let ends = if mirror.upright {
                [pos2(at.x, self.pane.top()), pos2(at.x, self.pane.bottom())]
            } else {
                [pos2(self.pane.left(), at.y), pos2(self.pane.right(), at.y)]
            };
            dashed(self.painter, &ends, stroke, 9.0, 5.0);
        }
    }

    /// What panels cover, faintly, and what is marked of them.
    pub(super) fn panels(&self) {
        let theme = self.scene.theme;
        let plan = self.scene.document.drawing.plan;
        for (n, shown) in self.scene.made() {
            let mut mesh = egui::Mesh::default();
            let fill = theme.sheet[0].gamma_multiply(0.32);
            for &p in &shown.positions {
                mesh.colored_vertex(self.at(plan.flat(p)), fill);
            }
            for t in &shown.triangles {
                mesh.add_triangle(t[0], t[1], t[2]);
            }
            self.painter.add(mesh);
            let selection = self.scene.selection;
            if selection.panel == Some(n) {
                let marks = Marks::of(&selection.place, shown);
                for ends in marks.lines {
                    let ends = ends.map(|p| self.at(plan.flat(p)));
                    self.painter.line_segment(ends, Stroke::new(2.5, theme.accent));
                }
                for spot in marks.spots {
                    self.painter.circle_filled(self.at(plan.flat(spot)), SPOT, theme.accent);
                }
            }
        }
    }

    /// The handles that are lit, and those in the box that the hand draws.
    pub(super) fn handles(
        &self,
        handles: &Handles,
        hovered: Option<PointRef>,
        lit: &Lit,
        boxed: Option<Rect>,
    ) {
        let theme = self.scene.theme;
        for (point, at, radius) in handles.on_screen() {
            let is_shown = lit.shows(point) || boxed.is_some_and(|area| area.contains(at));
            if !self.pane.expand(HANDLE).contains(at) {
                continue;
            }
            if !is_shown {
                paint_dim(self.painter, theme, at);
                continue;
            }
            let curve = &self.scene.document.design.curves[point.curve];
            let is_selected = self.scene.selection.points.contains(&point);
            let radius = if hovered == Some(point) { HANDLE + 2.0 } else { radius };
            let (fill, line) =
                if is_selected { (theme.accent, theme.paper) } else { (theme.paper, theme.accent) };
            let width = if is_selected || radius < HANDLE { 1.5 } else { 2.0 };
            let stroke = Stroke::new(width, line);
            // A corner has corners.
            if curve.points[point.point].corner {
                let area = Rect::from_center_size(at, Vec2::splat(radius * 1.8));
                self.painter.rect(
                    area,
                    CornerRadius::same(1),
                    fill,
                    stroke,
                    egui::StrokeKind::Middle,
                );
            } else {
                self.painter.circle(at, radius, fill, stroke);
            }
        }
    }

    /// A curve on its way: a stroke, or corners and the line to the hand.
    pub(super) fn stroke(&self, stroke: &[Point2], corners: &[Point2], hand: Option<Pos2>) {
        let theme = self.scene.theme;
        let line = Stroke::new(CURVE_WIDTH + 0.5, theme.accent);
        let points: Vec<Pos2> = stroke.iter().map(|&p| self.at(p)).collect();
        self.painter.add(Shape::line(points, line));
        if corners.is_empty() {
            return;
        }
        let mut points: Vec<Pos2> = corners.iter().map(|&p| self.at(p)).collect();
        for &at in &points {
            self.painter.circle_filled(at, HANDLE, theme.accent);
        }
        points.extend(hand);
        self.painter.add(Shape::line(points, line));
    }

    /// Places of the picture that were taken.
    pub(super) fn places(&self, places: &[Point2]) {
        for &p in places {
            let at = self.at(p);
            let stroke = Stroke::new(2.0, self.scene.theme.accent);
            self.painter.hline(at.x - 9.0..=at.x + 9.0, at.y, stroke);
            self.painter.vline(at.x, at.y - 9.0..=at.y + 9.0, stroke);
        }
    }

    /// What the hand has settled on.
    pub(super) fn snaps(&self, snaps: &[Snap]) {
        let theme = self.scene.theme;
        let fine = Stroke::new(1.0, theme.accent);
        for snap in snaps {
            match *snap {
                Snap::Point(p) => {
                    self.painter.circle_stroke(
                        self.at(p),
                        HANDLE + 6.0,
                        Stroke::new(2.0, theme.accent),
                    );
                }
                Snap::Upright(p) => {
                    let x = self.at(p).x;
                    let ends = [pos2(x, self.pane.top()), pos2(x, self.pane.bottom())];
                    dashed(self.painter, &ends, fine, 3.0, 5.0);
                }
                Snap::Level(p) => {
                    let y = self.at(p).y;
                    let ends = [pos2(self.pane.left(), y), pos2(self.pane.right(), y)];
                    dashed(self.painter, &ends, fine, 3.0, 5.0);
                }
                Snap::Mirror(_) => {}
                Snap::Grid(p) => {
                    let at = self.at(p);
                    self.painter.hline(at.x - 5.0..=at.x + 5.0, at.y, fine);
                    self.painter.vline(at.x, at.y - 5.0..=at.y + 5.0, fine);
                }
            }
        }
    }

    /// A bar of a round length, so that nobody has to guess how large things are.
    pub(super) fn scale(&self) {
        let theme = self.scene.theme;
        let units = self.scene.document.drawing.units;
        let most = 130.0 / self.view.scale / units.in_mm();
        let mut round = 1.0;
        for factor in [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6] {
            for digit in [1.0, 2.0, 5.0] {
                if digit * factor <= most {
                    round = digit * factor;
                }
            }
        }
        let mm = round * units.in_mm();
        let from = self.pane.left_bottom() + vec2(16.0, -18.0);
        let to = from + vec2((mm * self.view.scale) as f32, 0.0);
        let stroke = Stroke::new(1.5, theme.faint);
        self.painter.line_segment([from, to], stroke);
        for end in [from, to] {
            self.painter.line_segment([end - vec2(0.0, 4.0), end + vec2(0.0, 4.0)], stroke);
        }
        let text = sheetwright_files::length_text(mm, units);
        let at = from.lerp(to, 0.5) - vec2(0.0, 4.0);
        self.painter.text(at, Align2::CENTER_BOTTOM, text, FontId::proportional(12.0), theme.faint);
    }

    pub(super) fn lasso(&self, area: Rect) {
        let theme = self.scene.theme;
        let fill = theme.accent.gamma_multiply(0.12);
        let stroke = Stroke::new(1.0, theme.accent);
        self.painter.rect(area, CornerRadius::ZERO, fill, stroke, egui::StrokeKind::Inside);
    }

    /// What to do on an empty sheet.
    pub(super) fn invitation(&self, tool: Tool) {
        let theme = self.scene.theme;
        let middle = self.pane.center();
        let (title, hint) = match tool {
            Tool::Draw => (
                "Draw the outline",
                "Hold the button and draw round; let go to close it.\nOr click corner by corner.",
            ),
            _ => ("An empty sheet", "Press D, or choose Draw, to draw an outline."),
        };
        let font = FontId::proportional(19.0);
        self.painter.text(middle, Align2::CENTER_BOTTOM, title, font, theme.ink);
        for (n, line) in hint.lines().enumerate() {
            let at = middle + vec2(0.0, 10.0 + 20.0 * n as f32);
            let font = FontId::proportional(14.0);
            self.painter.text(at, Align2::CENTER_TOP, line, font, theme.faint);
        }
    }
}

/// What a screen reader says of the pane.
pub(super) fn said(scene: &Scene<'_>, tool: Tool) -> String {
    let curves = &scene.document.design.curves;
    let points: usize = curves.iter().map(|curve| curve.points.len()).sum();
    let tool = match tool {
        Tool::Select => "selecting",
        Tool::Draw => "drawing",
        Tool::Calibrate => "scaling the picture",
    };
    format!("Plan: {} curves with {points} handles; {tool}", curves.len())
}

/// The boundary curves as polylines of the plan, kept until they change.
#[derive(Default)]
pub(super) struct Outlines {
    curves: Vec<(DesignCurve, Plan, Vec<Point2>)>,
}

/// Places on each span of a curve.
const STEPS: usize = 24;

impl Outlines {
    pub(super) fn show(&mut self, canvas: &PlanCanvas<'_>) {
        let scene = canvas.scene;
        let plan = scene.document.drawing.plan;
        let mut kept = std::mem::take(&mut self.curves);
        for (n, curve) in scene.document.design.curves.iter().enumerate() {
            let is_it = kept.get(n).is_some_and(|(of, on, _)| of == curve && *on == plan);
            let line = if is_it {
                std::mem::take(&mut kept[n].2)
            } else {
                line_of(curve).into_iter().map(|p| plan.flat(p)).collect()
            };
            self.curves.push((curve.clone(), plan, line));
        }
        let theme = scene.theme;
        for (n, (curve, _, line)) in self.curves.iter().enumerate() {
            let points: Vec<Pos2> = line.iter().map(|&p| canvas.at(p)).collect();
            let is_selected = scene.selection.curve == Some(n);
            let colour = if is_selected { theme.accent } else { theme.curve };
            let width = if is_selected { CURVE_WIDTH + 1.0 } else { CURVE_WIDTH };
            if !is_used(scene, &curve.name) {
                // What bounds no panel yet is dashed.
                dashed(canvas.painter, &points, Stroke::new(width, colour), 8.0, 5.0);
            } else {
                canvas.painter.add(Shape::line(points, Stroke::new(width, colour)));
            }
        }
    }

    /// The curve nearest to a place on the screen, if one is near.
    pub(super) fn nearest(&self, pane: Rect, view: PlanView, at: Pos2) -> Option<usize> {
        const REACH: f32 = 9.0;
        let distance = |line: &[Point2]| {
            let points: Vec<Pos2> = line.iter().map(|&p| view.to_screen(pane, p)).collect();
            let to_side = |side: &[Pos2]| distance_to(side[0], side[1], at);
            points.windows(2).map(to_side).fold(f32::INFINITY, f32::min)
        };
        let near = self.curves.iter().enumerate().map(|(n, (_, _, line))| (n, distance(line)));
        near.filter(|(_, d)| *d <= REACH).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(n, _)| n)
    }
}

fn is_used(scene: &Scene<'_>, curve: &str) -> bool {
    let panels = &scene.document.design.panels;
    panels.iter().any(|panel| crate::document::curves_of(panel).iter().any(|u| u.name == curve))
}

fn distance_to(a: Pos2, b: Pos2, p: Pos2) -> f32 {
    let way = b - a;
    let share = if way.length_sq() > 0.0 {
        ((p - a).dot(way) / way.length_sq()).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (a + way * share).distance(p)
}

/// A curve as a polyline; where its points make no curve yet, through its points.
pub(crate) fn line_of(curve: &DesignCurve) -> Vec<sheetwright::math::Point3> {
    let made = curve.kind.and_then(|kind| Curve::new(kind, &curve.points, curve.closed).ok());
    match made {
        Some(made) => {
            let steps = made.spans().len() * STEPS;
            (0..=steps).map(|n| made.position(n as f64 / STEPS as f64)).collect()
        }
        None => {
            let mut line: Vec<_> = curve.points.iter().map(|p| p.at).collect();
            line.extend(line.first().copied().filter(|_| curve.closed));
            line
        }
    }
}

/// The picture under the plan, on the graphics card.
#[derive(Default)]
pub(super) struct ReferencePicture {
    shown: Option<(Reference, Option<TextureHandle>)>,
}

impl ReferencePicture {
    pub(super) fn show(&mut self, canvas: &PlanCanvas<'_>, ctx: &egui::Context) {
        let Some(reference) = &canvas.scene.document.drawing.reference else {
            self.shown = None;
            return;
        };
        let is_it = |shown: &&(Reference, Option<TextureHandle>)| {
            std::sync::Arc::ptr_eq(&shown.0.bytes, &reference.bytes)
        };
        if self.shown.as_ref().filter(is_it).is_none() {
            self.shown = Some((reference.clone(), texture(reference, ctx)));
        }
        let Some((_, Some(texture))) = &self.shown else { return };
        let [width, height] =
            texture.size().map(|pixels| pixels as f64 * reference.mm_per_pixel / 2.0);
        let centre = reference.centre;
        let corner = |x: f64, y: f64| canvas.at(Point2::new(centre.x + x, centre.y + y));
        let area = Rect::from_min_max(corner(-width, height), corner(width, -height));
        let uv = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        let tint = Color32::WHITE.gamma_multiply(reference.opacity as f32);
        canvas.painter.image(texture.id(), area, uv, tint);
    }
}

fn texture(reference: &Reference, ctx: &egui::Context) -> Option<TextureHandle> {
    let picture = image::load_from_memory(&reference.bytes).ok()?.to_rgba8();
    let size = [picture.width() as usize, picture.height() as usize];
    let pixels = egui::ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
    Some(ctx.load_texture("reference", pixels, egui::TextureOptions::LINEAR))
}
