//! How a piece looks: its sheet, what is done along its lines, its texts and its dimensions.

use super::arrange::{Takes, Texts};
use super::view::{PatternView, Placed, box_of};
use crate::engine::shown::Shown;
use crate::panes::marks::{Marks, SPOT};
use crate::panes::measured::worst_colour;
use crate::panes::measured::{PALE, Quantity, UNSURE, strained, twist, values, worst};
use crate::panes::tag::tag;
use crate::panes::words::{degrees, length};
use crate::scene::Scene;
use crate::theme::{Theme, mapped};
use crate::views::SurfaceView;
use eframe::egui::epaint::TextShape;
use eframe::egui::{
    Align2, Color32, FontId, Galley, Mesh, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2, vec2,
};
use sheetwright::math::{Point2, Vec2 as Way, atan2};
use sheetwright::pattern::{PathKind, PatternLabel, Role};
use std::sync::Arc;

/// Rungs that are drawn of a piece, at the most.
const RUNGS: usize = 90;
/// The shorter side of a piece that is shown with its rungs, points; of one whose rungs are asked
/// for, the longer side.
const LEAST_WITH_RUNGS: f32 = 40.0;
/// A piece whose rungs all together bend by less is flat, degrees: they say nothing.
const FLAT_DEG: f64 = 0.1;
/// How far a dimension stands from its piece, points.
const AWAY: f32 = 20.0;
/// How far a height that lies stands from its line, points.
const BESIDE: f32 = 9.0;
/// A height is written upwards along its line if that is longer by this, points.
const STANDS: f32 = 24.0;
/// The size of the letters of dimensions, points.
const DIMENSION: f32 = 12.5;
/// Letters smaller than this are left out, points.
const READABLE: f32 = 7.0;
/// The height of a capital letter as a share of the size of its font.
const CAPITAL: f32 = 0.7;

/// How a piece is looked at.
pub(super) struct Look<'a> {
    /// Which part of the paper is in sight.
    pub(super) view: &'a PatternView,
    /// The pane.
    pub(super) rect: Rect,
    /// Where the piece lies.
    pub(super) piece: &'a Placed,
    /// What colours it.
    pub(super) by: Option<Quantity>,
    /// What is looked at.
    pub(super) detail: SurfaceView,
    /// Whether no piece has a rung that twists more.
    pub(super) is_worst: bool,
    /// What stands above it: its name, where there is room, and how many there are.
    pub(super) name: Option<&'a str>,
    /// What is free about it for its dimensions.
    pub(super) free: Takes,
}

impl Look<'_> {
    fn seen(&self, p: Point2) -> Pos2 {
        self.view.seen(self.piece.on_paper(p), self.rect)
    }

    /// Whether its rungs are drawn: they tell something, and can be told apart.
    fn has_rungs(&self, shown: &Shown) -> bool {
        let size = box_of(self.piece, self.view, self.rect).size();
        let side = match self.detail {
            SurfaceView::Rungs => size.max_elem(),
            _ => size.min_elem(),
        };
        let bends: f64 = shown.rungs.iter().map(|rung| rung.crease_deg.abs()).sum();
        side >= LEAST_WITH_RUNGS && bends > FLAT_DEG
    }
}

/// Draws a piece.
pub(super) fn piece(painter: &Painter, scene: &Scene<'_>, shown: &Shown, look: &Look<'_>) {
    let theme = scene.theme;
    let chosen = scene.selection.panel == Some(look.piece.panel);
    sheet(painter, shown, look, theme, chosen);
    paths(painter, shown, look, theme);
    rungs(painter, scene, shown, look);
    let mut named = false;
    for label in &shown.piece.labels {
        // Its own dimensions are in mm; ours are in the units of the drawing.
        if label.role != Role::Note && letters(painter, label, look, theme) {
            named |= Some(&label.text[..]) == look.name;
        }
    }
    if let Some(name) = look.name.filter(|_| !named) {
        let at = box_of(look.piece, look.view, look.rect).left_top() + vec2(0.0, -5.0);
        let font = FontId::proportional(DIMENSION);
        painter.text(at, Align2::LEFT_BOTTOM, name, font, theme.ink);
    }
    dimensions(painter, scene, look);
}

/// The sheet itself: plain, or in the colours of what is measured.
fn sheet(painter: &Painter, shown: &Shown, look: &Look<'_>, theme: &Theme, chosen: bool) {
    let at = |n: u32| look.seen(shown.flat.get(n as usize).copied().unwrap_or_default());
    let mut mesh = Mesh::default();
    let plain = theme.paper.lerp_to_gamma(theme.sheet[0], 0.45);
    let plain_sheet = |mesh: &mut Mesh| {
        let fill = if chosen { plain.lerp_to_gamma(theme.accent, 0.16) } else { plain };
        for &p in &shown.flat {
            mesh.colored_vertex(look.seen(p), fill);
        }
        let count = shown.flat.len() as u32;
        for &[a, b, c] in &shown.flat_triangles {
            if a < count && b < count && c < count {
                mesh.add_triangle(a, b, c);
            }
        }
    };
    if let Some((strain, triangles)) = strained(shown, look.by) {
        for (triangle, share) in triangles {
            let at = |n: u32| strain.flat.get(n as usize).copied().unwrap_or_default();
            let corners = triangle.map(|n| look.seen(at(n)));
            measured(&mut mesh, corners, [Some(mapped(share)); 3]);
        }
    } else if let Some(Quantity::Strain(_)) | None = look.by {
        plain_sheet(&mut mesh);
    } else if let Some(by) = look.by {
        let colour = |value: f32| match value {
            value if value < 0.0 => None,
            value if value < UNSURE => Some(mapped(f64::from(value))),
            value => Some(plain.lerp_to_gamma(mapped(f64::from(value - UNSURE)), PALE)),
        };
        for (triangle, values) in shown.flat_triangles.iter().zip(values(shown, Some(by))) {
            measured(&mut mesh, triangle.map(at), values.map(colour));
        }
    }
    painter.add(Shape::mesh(mesh));
}

/// A triangle with a colour along each of its sides that has one: four smaller ones, whose corners
/// in the middle of sides have those colours.
fn measured(mesh: &mut Mesh, corners: [Pos2; 3], sides: [Option<Color32>; 3]) {
    let between = |a: Option<Color32>, b: Option<Color32>| match (a, b) {
        (Some(a), Some(b)) => Some(a.lerp_to_gamma(b, 0.5)),
        (a, b) => a.or(b),
    };
    let none = mapped(0.0);
    let from = mesh.vertices.len() as u32;
    for n in 0..3 {
        let (before, after, opposite) = (sides[(n + 2) % 3], sides[n], sides[(n + 1) % 3]);
        let colour = between(before, after).or(opposite).unwrap_or(none);
        mesh.colored_vertex(corners[n], colour);
    }
    for n in 0..3 {
        let colour = sides[n].or(between(sides[(n + 1) % 3], sides[(n + 2) % 3])).unwrap_or(none);
        let middle = corners[n].lerp(corners[(n + 1) % 3], 0.5);
        mesh.colored_vertex(middle, colour);
    }
    for [a, b, c] in [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]] {
        mesh.add_triangle(from + a, from + b, from + c);
    }
}

/// What is done along lines.
fn paths(painter: &Painter, shown: &Shown, look: &Look<'_>, theme: &Theme) {
    let has_rungs = look.has_rungs(shown);
    let are_asked = has_rungs && look.detail == SurfaceView::Rungs;
    if are_asked {
        all_rungs(painter, shown, look, theme);
    }
    let [cut, score, engrave, _] = theme.roles;
    for path in &shown.piece.paths {
        let stroke = match (path.kind, path.role) {
            (PathKind::Dimension, _) => continue,
            (PathKind::Rung(_), Role::Note) => continue,
            (PathKind::Bend { .. } | PathKind::BendTick, _) if !has_rungs => continue,
            (PathKind::Bend { .. }, Role::Note) if are_asked => continue,
            (PathKind::Bend { .. }, Role::Note) => match look.by {
                Some(_) => Stroke::new(1.0, theme.paper.gamma_multiply(0.3)),
                None => Stroke::new(1.0, theme.rung.gamma_multiply(0.7)),
            },
            (_, Role::Cut | Role::Inner | Role::Drill) => Stroke::new(2.0, cut),
            (_, Role::Score | Role::Net) => Stroke::new(1.6, score),
            (_, Role::Engrave) => Stroke::new(1.2, engrave),
            (_, Role::Note | Role::Sheet) => Stroke::new(1.0, theme.faint),
        };
        let points: Vec<Pos2> = path.points.iter().map(|&p| look.seen(p)).collect();
        painter.add(match (path.closed, &points[..]) {
            (true, _) => Shape::closed_line(points, stroke),
            (false, &[a, b]) => Shape::line_segment([a, b], stroke),
            (false, _) => Shape::line(points, stroke),
        });
    }
}

/// The rungs of the surface; of many close to one another some stand for all.
fn all_rungs(painter: &Painter, shown: &Shown, look: &Look<'_>, theme: &Theme) {
    let at = |n: u32| look.seen(shown.flat.get(n as usize).copied().unwrap_or_default());
    let (most, colour) = match look.by {
        Some(_) => (RUNGS / 2, theme.paper.gamma_multiply(0.2)),
        None => (RUNGS, theme.rung.gamma_multiply(0.8)),
    };
    for rung in shown.rungs.iter().step_by(shown.rungs.len().div_ceil(most).max(1)) {
        painter.line_segment(rung.flat_ends.map(at), Stroke::new(1.0, colour));
    }
}

/// The worst rung where it is looked at, and the selected one.
fn rungs(painter: &Painter, scene: &Scene<'_>, shown: &Shown, look: &Look<'_>) {
    let theme = scene.theme;
    let at = |n: u32| look.seen(shown.flat.get(n as usize).copied().unwrap_or_default());
    let asked = matches!(look.detail, SurfaceView::Warp | SurfaceView::Rungs);
    let told = |&n: &usize| look.is_worst || twist(&shown.rungs[n]) > shown.warp_limit_deg;
    if let Some(n) = worst(shown).filter(|_| asked).filter(told) {
        let colour = worst_colour(shown, n, theme);
        let [a, b] = shown.rungs[n].flat_ends.map(at);
        painter.line_segment([a, b], Stroke::new(2.5, colour));
        if look.detail == SurfaceView::Warp && a.distance(b) > 30.0 {
            let text = degrees(twist(&shown.rungs[n]));
            tag(painter, theme, a.lerp(b, 0.5) + vec2(8.0, 0.0), &text, colour, look.rect);
        }
    }
    let chosen = scene.selection.panel == Some(look.piece.panel);
    if !chosen {
        return;
    }
    let marks = Marks::of(&scene.selection.place, shown);
    for (width, colour) in [(5.0, theme.paper), (3.0, theme.accent)] {
        for ends in &marks.flat_lines {
            painter.line_segment(ends.map(|p| look.seen(p)), Stroke::new(width, colour));
        }
    }
    for &spot in &marks.flat_spots {
        painter.circle(look.seen(spot), SPOT, theme.accent, Stroke::new(1.0, theme.paper));
    }
}

/// A text of the pattern, as large as it is there; whether it can be read, else it is left out.
fn letters(painter: &Painter, label: &PatternLabel, look: &Look<'_>, theme: &Theme) -> bool {
    let size = (label.height_mm / look.view.mm_per_point) as f32 / CAPITAL;
    if size < READABLE {
        return false;
    }
    let ink = match label.role {
        // The dark end of the map is dark in every look.
        Role::Engrave if look.by.is_some() && !theme.is_dark => theme.paper,
        Role::Cut | Role::Inner | Role::Drill => theme.roles[0],
        Role::Score | Role::Net => theme.roles[1],
        Role::Engrave => theme.roles[2],
        Role::Note | Role::Sheet => theme.roles[3],
    };
    // Letters are laid out in whole sizes, so that zooming does not fill the memory with them.
    let font = FontId::proportional(size.min(96.0).round());
    let galley = painter.layout_no_wrap(label.text.clone(), font, ink);
    let along = look.piece.along(label.along);
    let angle = -atan2(along.y, along.x) as f32;
    turned(painter, look.seen(label.at), &galley, angle, CAPITAL, ink);
    true
}

/// A text round the middle of its base line.
fn turned(painter: &Painter, at: Pos2, galley: &Arc<Galley>, angle: f32, up: f32, ink: Color32) {
    // The base line is so far below the upper edge of the text.
    let base = vec2(0.5 * galley.size().x, (0.5 + 0.5 * up) * galley.size().y * 0.92);
    let (s, c) = (angle.sin(), angle.cos());
    let off = vec2(c * base.x - s * base.y, s * base.x + c * base.y);
    painter.add(TextShape::new(at - off, galley.clone(), ink).with_angle(angle));
}

/// A length in the units of the drawing.
fn dimension(painter: &Painter, scene: &Scene<'_>, mm: f64) -> Arc<Galley> {
    let text = length(mm, scene.document.drawing.units);
    painter.layout_no_wrap(text, FontId::proportional(DIMENSION), scene.theme.ink)
}

/// Whether the height of a piece is written upwards, along its line.
fn stands(around: &Rect, high: &Galley) -> bool {
    around.height() > high.size().x + STANDS
}

/// The texts of a part.
pub(super) fn texts(painter: &Painter, scene: &Scene<'_>, name: &str, size: Way) -> Texts {
    let font = FontId::proportional(DIMENSION);
    let name = painter.layout_no_wrap(name.to_owned(), font, scene.theme.ink).size().x;
    let sizes = [size.x, size.y].map(|mm| dimension(painter, scene, mm).size());
    Texts { name, dimension: sizes[0].max(sizes[1]) }
}

/// The room that the dimensions of a piece take about it, which is so large on the screen.
pub(super) fn takes(of: Vec2, texts: &Texts) -> Takes {
    let text = texts.dimension;
    let stands = of.y > text.x + STANDS;
    let left = if stands { AWAY + 0.5 * text.y } else { AWAY + BESIDE + text.x };
    // The width below may be wider than the piece.
    let over = 0.5 * (text.x - of.x).max(0.0);
    Takes { left: left.max(over), right: over, below: AWAY + 0.5 * text.y }
}

/// Width below and height to the left, in the units of the drawing, where there is room for them:
/// else the answer to a hand that rests there has them.
fn dimensions(painter: &Painter, scene: &Scene<'_>, look: &Look<'_>) {
    let theme = scene.theme;
    let around = box_of(look.piece, look.view, look.rect);
    let size = look.piece.box_size();
    let [wide, high] = [size.x, size.y].map(|mm| dimension(painter, scene, mm));
    let texts = Texts { name: 0.0, dimension: wide.size().max(high.size()) };
    if !takes(around.size(), &texts).fits_into(look.free) {
        return;
    }
    let stroke = Stroke::new(1.0, theme.faint);
    let line = |from: Pos2, to: Pos2, gap: f32| {
        let way = (to - from).normalized();
        let half = 0.5 * (from.distance(to) - gap);
        if half > 4.0 {
            for (end, inwards) in [(from, way), (to, -way)] {
                painter.line_segment([end, end + inwards * half], stroke);
                arrow(painter, end, inwards, theme.faint);
            }
        }
        let across = vec2(way.y, -way.x) * 5.0;
        for end in [from, to] {
            painter.line_segment([end - across, end + across], stroke);
        }
    };
    let below = around.bottom() + AWAY;
    line(pos2(around.left(), below), pos2(around.right(), below), wide.size().x + 12.0);
    let at = pos2(around.center().x, below);
    painter.galley(Align2::CENTER_CENTER.anchor_size(at, wide.size()).min, wide, theme.ink);
    let beside = around.left() - AWAY;
    let upright = stands(&around, &high);
    let gap = if upright { high.size().x + 12.0 } else { 0.0 };
    line(pos2(beside, around.bottom()), pos2(beside, around.top()), gap);
    let at = pos2(beside, around.center().y);
    if upright {
        let off = Vec2::new(-0.5 * high.size().y, 0.5 * high.size().x);
        let angle = -std::f32::consts::FRAC_PI_2;
        painter.add(TextShape::new(at + off, high, theme.ink).with_angle(angle));
    } else {
        let place = Align2::RIGHT_CENTER.anchor_size(at - vec2(BESIDE, 0.0), high.size());
        painter.galley(place.min, high, theme.ink);
    }
}

fn arrow(painter: &Painter, tip: Pos2, inwards: Vec2, colour: Color32) {
    let across = vec2(inwards.y, -inwards.x) * 2.6;
    let back = tip + inwards * 7.0;
    let corners = vec![tip, back + across, back - across];
    painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
}
