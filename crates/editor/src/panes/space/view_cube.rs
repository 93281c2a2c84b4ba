//! A cube that turns with the view: a click on a face looks at it, a drag turns. Its letters lie on
//! its faces, as if printed there.

use super::camera::{Camera, Direction};
use crate::theme::Theme;
use eframe::egui::accesskit::Role;
use eframe::egui::{
    Align2, Color32, CursorIcon, FontId, Mesh, Painter, Pos2, Rect, Response, Sense, Shape, Stroke,
    Ui, Vec2, WidgetInfo, pos2, vec2,
};
use sheetwright::math::Vec3;

/// Half a side of the cube, points.
const HALF: f32 = 25.0;
/// The middle of the cube, from the upper right corner of the pane.
const FROM_CORNER: Vec2 = vec2(-64.0, 66.0);
/// The size of its letters, points.
const LETTERS: f32 = 12.0;

/// A face: what people call it, and where it looks.
struct Face {
    name: &'static str,
    printed: &'static str,
    out: Vec3,
    /// To the right and upwards of its letters.
    right: Vec3,
    up: Vec3,
}

const FACES: [Face; 6] = [
    Face { name: "top", printed: "TOP", out: Vec3::Z, right: Vec3::X, up: Vec3::Y },
    Face { name: "front", printed: "FRONT", out: Vec3::NEG_Y, right: Vec3::X, up: Vec3::Z },
    Face { name: "right", printed: "RIGHT", out: Vec3::X, right: Vec3::Y, up: Vec3::Z },
    Face { name: "back", printed: "BACK", out: Vec3::Y, right: Vec3::NEG_X, up: Vec3::Z },
    Face { name: "left", printed: "LEFT", out: Vec3::NEG_X, right: Vec3::NEG_Y, up: Vec3::Z },
    Face { name: "bottom", printed: "BELOW", out: Vec3::NEG_Z, right: Vec3::X, up: Vec3::NEG_Y },
];

/// Shows the cube; the direction that was asked for, if one was, and what drags it.
pub(super) fn ui(
    ui: &Ui,
    camera: &Camera,
    pane: Rect,
    theme: &Theme,
) -> (Option<Direction>, Response) {
    let centre = pane.right_top() + FROM_CORNER;
    let on_screen = |p: Vec3| {
        let (x, y) = (p.dot(camera.right()) as f32, p.dot(camera.up()) as f32);
        centre + vec2(x, -y) * HALF
    };
    let base = ui.scope_id().with("view cube");
    let around = Rect::from_center_size(centre, Vec2::splat(3.2 * HALF));
    let whole = ui.interact(around, base, Sense::click_and_drag());
    let mut asked = None;
    let pointed = whole.hover_pos().or_else(|| ui.input(|i| i.pointer.hover_pos()));
    let painter = ui.painter();
    let mut visible: Vec<(&Face, [Pos2; 4], f64)> = FACES
        .iter()
        .map(|face| {
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let at = corners.map(|(x, y)| on_screen(face.out + face.right * x + face.up * y));
            (face, at, face.out.dot(camera.toward()))
        })
        .collect();
    // Faces that look away are there for keys and screen readers only.
    visible.sort_by(|a, b| a.2.total_cmp(&b.2));
    axes(painter, camera, theme, true, on_screen);
    for (face, corners, facing) in &visible {
        let seen = *facing > 0.02;
        let middle = corners[0].lerp(corners[2], 0.5);
        let small = Vec2::splat(8.0);
        let at = if seen { middle } else { pos2(-1e4, -1e4) };
        let rect = Rect::from_center_size(at, small);
        let response = ui.interact(rect, base.with(face.name), Sense::click());
        let name = format!("View from {}", if face.name == "bottom" { "below" } else { face.name });
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let inside = |at: Pos2| seen && contains(corners, at);
        let by_hand = |r: &Response| match r.interact_pointer_pos() {
            Some(at) => r.clicked() && inside(at),
            None => false,
        };
        let by_key = response.clicked() && response.interact_pointer_pos().is_none();
        if by_key || by_hand(&response) || by_hand(&whole) {
            asked = Some(Direction::towards(face.out));
        }
        if !seen {
            continue;
        }
        let hovered = (whole.hovered() || response.hovered()) && pointed.is_some_and(inside);
        let edge = Stroke::new(1.0, if hovered { theme.accent } else { theme.line });
        let fill = if hovered { theme.accent } else { shade(theme, *facing) };
        painter.add(Shape::convex_polygon(corners.to_vec(), fill, edge));
        if response.has_focus() {
            let ring = corners.map(|at| middle.lerp(at, 1.08)).to_vec();
            painter.add(Shape::closed_line(ring, Stroke::new(2.0, theme.accent)));
        }
        let ink = if hovered { theme.on_accent } else { theme.faint };
        let place = |x: f32, y: f32| {
            let across = face.right * f64::from(x) + face.up * f64::from(y);
            on_screen(face.out + across)
        };
        if *facing > 0.25 {
            printed(painter, face.printed, ink, place);
        }
        if hovered {
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
        }
    }
    axes(painter, camera, theme, false, on_screen);
    if home(ui, centre + vec2(-2.5 * HALF, -1.8 * HALF), theme) {
        asked = Some(Direction::CORNER);
    }
    (asked, whole)
}

/// Faces towards the eye are as fields are, those beside it a little like lines.
fn shade(theme: &Theme, facing: f64) -> Color32 {
    theme.line.lerp_to_gamma(theme.field, (0.35 + 0.65 * facing as f32).clamp(0.0, 1.0))
}

/// Letters on a face: laid out flat, then put where the face has them.
fn printed(painter: &Painter, text: &str, colour: Color32, place: impl Fn(f32, f32) -> Pos2) {
    let font = FontId::proportional(LETTERS);
    let galley = painter.layout_no_wrap(text.to_owned(), font, colour);
    let middle = galley.rect.center();
    let size = painter.fonts(|fonts| fonts.font_image_size());
    let mut mesh = Mesh::default();
    for row in &galley.rows {
        let from = mesh.vertices.len() as u32;
        let glyphs = &row.visuals.mesh;
        mesh.indices.extend(glyphs.indices.iter().map(|n| n + from));
        mesh.vertices.extend(glyphs.vertices.iter().map(|vertex| {
            let off = row.pos.to_vec2() + vertex.pos.to_vec2() - middle.to_vec2();
            let mut vertex = *vertex;
            vertex.pos = place(off.x / HALF, -off.y / HALF);
            vertex.uv = pos2(vertex.uv.x / size[0] as f32, vertex.uv.y / size[1] as f32);
            vertex.color = colour;
            vertex
        }));
    }
    painter.add(Shape::mesh(mesh));
}

/// Where x, y and z point, from the corner of the cube that they meet in: those that the cube hides
/// before it is drawn, the others over it.
fn axes(
    painter: &Painter,
    camera: &Camera,
    theme: &Theme,
    hidden: bool,
    on_screen: impl Fn(Vec3) -> Pos2,
) {
    let corner = Vec3::splat(-1.0);
    let named = [(Vec3::X, "x"), (Vec3::Y, "y"), (Vec3::Z, "z")];
    for ((axis, name), colour) in named.into_iter().zip(theme.axes) {
        // An edge is behind the cube unless one of the two faces that meet in it is seen.
        let mut faces = named.into_iter().filter(|&(other, _)| other != axis);
        let is_hidden = faces.all(|(out, _)| -out.dot(camera.toward()) < 0.02);
        let (from, tip) = (on_screen(corner), on_screen(corner + axis * 2.35));
        if is_hidden == hidden && from.distance(tip) > 6.0 {
            painter.line_segment([from, tip], Stroke::new(2.0, colour));
            let beyond = tip + (tip - from).normalized() * 7.0;
            painter.text(beyond, Align2::CENTER_CENTER, name, FontId::proportional(12.0), colour);
        }
    }
}

/// A small house: back to where a shape is best seen from.
fn home(ui: &Ui, at: Pos2, theme: &Theme) -> bool {
    let rect = Rect::from_center_size(at, Vec2::splat(22.0));
    let response = ui.interact(rect, ui.scope_id().with("view from a corner"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "View from a corner"));
    let lit = response.hovered() || response.has_focus();
    let stroke = Stroke::new(1.5, if lit { theme.accent } else { theme.faint });
    let point = |x: f32, y: f32| at + vec2(x, y);
    let roof = vec![point(-7.0, 0.0), point(0.0, -6.5), point(7.0, 0.0)];
    let walls = vec![point(-4.5, -2.0), point(-4.5, 6.0), point(4.5, 6.0), point(4.5, -2.0)];
    ui.painter().add(Shape::line(roof, stroke));
    ui.painter().add(Shape::line(walls, stroke));
    response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text("View from a corner").clicked()
}

/// Whether a point lies in a quadrilateral.
fn contains(corners: &[Pos2; 4], at: Pos2) -> bool {
    let side = |n: usize| {
        let (a, b) = (corners[n], corners[(n + 1) % 4]);
        (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)
    };
    (0..4).all(|n| side(n) >= 0.0) || (0..4).all(|n| side(n) <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_read_from_outside() {
        for face in FACES {
            assert_eq!(face.right.cross(face.up), face.out, "{}", face.name);
            let camera = Camera { direction: Direction::towards(face.out), ..Camera::default() };
            assert!((camera.toward() - face.out).length() < 1e-12, "{}", face.name);
            assert!((camera.right() - face.right).length() < 1e-12, "{}", face.name);
        }
    }
}
