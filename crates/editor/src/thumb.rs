//! Small pictures of designs: their sheets as seen from above one corner, made one a frame so that
//! the page comes at once.

use crate::theme::Theme;
use eframe::egui::text::LayoutJob;
use eframe::egui::{
    self, Align, Align2, Color32, CornerRadius, FontId, Mesh, Pos2, Rect, Sense, Stroke,
    StrokeKind, Ui, Vec2,
};
use sheetwright::design::Design;
use sheetwright::draw::coarse::coarse;
use sheetwright::make::{Judging, make_judged};
use sheetwright::math::{Vec3, unit};
use sheetwright::watch::Unwatched;
use std::collections::BTreeMap;

/// Samples of a panel in a picture.
const SAMPLES: usize = 64;

/// Pictures by their names.
#[derive(Default)]
pub(crate) struct Thumbs {
    kept: BTreeMap<String, Option<Thumb>>,
    /// The picture of a design that is being changed.
    live: Option<(Design, Option<Thumb>)>,
    made_in: u64,
}

/// A picture: triangles from back to front, in a square of −1 ..= 1, and how much light each has.
#[derive(Clone, Debug)]
struct Thumb {
    triangles: Vec<([[f32; 2]; 3], f32, bool)>,
}

impl Thumbs {
    /// A card with a picture and a name; whether it was clicked.
    pub(crate) fn card_ui(
        &mut self,
        ui: &mut Ui,
        theme: &Theme,
        size: Vec2,
        name: &str,
        what: &str,
        shape: impl FnOnce() -> Option<Design>,
    ) -> bool {
        let (area, response) = ui.allocate_exact_size(size, Sense::click());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
        let is_hot = response.hovered() || response.has_focus();
        if ui.is_rect_visible(area) {
            let stroke =
                if is_hot { Stroke::new(2.0, theme.accent) } else { Stroke::new(1.0, theme.line) };
            let painter = ui.painter();
            painter.rect(area, CornerRadius::same(8), theme.paper, stroke, StrokeKind::Inside);
            let mut picture = area.shrink(10.0);
            picture.max.y -= 34.0;
            let frame = ui.ctx().cumulative_frame_nr();
            if !self.kept.contains_key(name) && self.made_in != frame {
                self.made_in = frame;
                let thumb = shape().and_then(|design| Thumb::new(&design));
                self.kept.insert(name.to_owned(), thumb);
                ui.ctx().request_repaint();
            }
            if let Some(Some(thumb)) = self.kept.get(name) {
                thumb.paint(ui, theme, picture);
            }
            let mut job = LayoutJob::simple(
                name.to_owned(),
                FontId::proportional(14.0),
                theme.ink,
                area.width() - 20.0,
            );
            job.halign = Align::Center;
            job.wrap.max_rows = 2;
            let galley = painter.layout_job(job);
            let at = Align2::CENTER_CENTER.align_size_within_rect(
                galley.size(),
                Rect::from_min_max(Pos2::new(area.left(), area.bottom() - 42.0), area.max),
            );
            painter.galley(at.center_top(), galley, theme.ink);
        }
        response.on_hover_text(what).clicked()
    }

    /// The picture of a design as it is now.
    pub(crate) fn picture_ui(&mut self, ui: &mut Ui, theme: &Theme, size: Vec2, design: &Design) {
        let (area, response) = ui.allocate_exact_size(size, Sense::hover());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "How it will look"));
        ui.painter().rect_filled(area, CornerRadius::same(8), theme.paper);
        if self.live.as_ref().is_none_or(|(of, _)| of != design) {
            self.live = Some((design.clone(), Thumb::new(design)));
        }
        if let Some((_, Some(thumb))) = &self.live {
            thumb.paint(ui, theme, area.shrink(20.0));
        }
    }
}

impl Thumb {
    fn new(design: &Design) -> Option<Self> {
        let mut design = coarse(design, SAMPLES);
        design.vary.clear();
        let made = make_judged(&design, Judging::Quick, &mut Unwatched).ok()?;
        // Seen from the front, the right and above.
        let right = unit(Vec3::new(0.82, 0.57, 0.0))?;
        let away = unit(Vec3::new(-0.5, 0.72, -0.48))?;
        let up = right.cross(away);
        let light = unit(Vec3::new(-0.3, -0.5, 0.9))?;
        let mut found: Vec<([[f64; 2]; 3], f64, f64, bool)> = Vec::new();
        for mesh in made.parts.iter().map(|part| part.sheet.mesh()) {
            for triangle in mesh.triangles() {
                let corners = triangle.map(|v| mesh.position(v).to_vec());
                let Some(normal) = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]))
                else {
                    continue;
                };
                let at = corners.map(|p| [p.dot(right), p.dot(up)]);
                let depth = corners.iter().map(|p| p.dot(away)).sum::<f64>();
                let faces = normal.dot(away) < 0.0;
                found.push((at, depth, 0.55 + 0.45 * normal.dot(light).abs(), faces));
            }
        }
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        let all = || found.iter().flat_map(|(at, ..)| at.iter());
        let least = |axis: usize| all().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let most = |axis: usize| all().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = ([least(0), least(1)], [most(0), most(1)]);
        let half = ((high[0] - low[0]).max(high[1] - low[1]) / 2.0).max(1e-9);
        let middle = [f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1])];
        let placed = |p: [f64; 2]| [0, 1].map(|axis| ((p[axis] - middle[axis]) / half) as f32);
        let triangles = found.into_iter();
        let triangles =
            triangles.map(|(at, _, light, faces)| (at.map(placed), light as f32, faces));
        Some(Self { triangles: triangles.collect() })
    }

    fn paint(&self, ui: &Ui, theme: &Theme, area: Rect) {
        let half = area.size().min_elem() / 2.0;
        let mut mesh = Mesh::default();
        for (corners, light, faces) in &self.triangles {
            let sheet = theme.sheet[usize::from(!faces)];
            let colour = Color32::BLACK.lerp_to_gamma(sheet, *light);
            let first = mesh.vertices.len() as u32;
            for [x, y] in corners {
                let at = area.center() + Vec2::new(x * half, -y * half);
                mesh.colored_vertex(at, colour);
            }
            mesh.add_triangle(first, first + 1, first + 2);
        }
        ui.painter().add(mesh);
    }
}
