//! Short texts in boxes.

use crate::theme::Theme;
use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, vec2};

/// A short text in a box, kept within a rectangle.
pub(crate) fn tag(
    painter: &Painter,
    theme: &Theme,
    at: Pos2,
    text: &str,
    colour: Color32,
    within: Rect,
) -> Rect {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), theme.ink);
    let size = galley.size() + vec2(14.0, 8.0);
    let mut rect = Align2::LEFT_CENTER.anchor_size(at, size);
    let room = within.shrink(4.0);
    rect = rect.translate(vec2(
        (room.right() - rect.right()).min(0.0) + (room.left() - rect.left()).max(0.0),
        (room.bottom() - rect.bottom()).min(0.0) + (room.top() - rect.top()).max(0.0),
    ));
    painter.rect(rect, 5.0, theme.ground, Stroke::new(1.0, colour), StrokeKind::Middle);
    painter.galley(rect.min + vec2(7.0, 4.0), galley, theme.ink);
    rect
}
