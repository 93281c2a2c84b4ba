//! What of a piece is drawn on paper, and the boxes around it.

use crate::stroke_font::strokes;
use sheetwright::math::Point2;
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, Piece, Role};
use sheetwright::predicate::Box2;

/// The texts of a piece that are drawn. Dimensions stand in the margins of other files; the
/// overview has the size.
pub(super) fn drawn_labels(piece: &Piece) -> impl Iterator<Item = &PatternLabel> {
    use LabelKind::{Bend, Length, Overall};
    piece
        .labels
        .iter()
        .filter(|label| label.role != Role::Note || !matches!(label.kind, Length | Overall | Bend))
}

/// The box around the strokes of a text, mm.
pub(super) fn text_around(label: &PatternLabel) -> Option<Box2> {
    let lines = strokes(&label.text, label.at, label.along, label.height_mm);
    Box2::of_points(lines.into_iter().flatten())
}

/// The lines of a piece beside those to cut: texts, and what leads to them.
pub(super) fn drawn_lines(piece: &Piece) -> Vec<Vec<Point2>> {
    let texts = drawn_labels(piece)
        .flat_map(|label| strokes(&label.text, label.at, label.along, label.height_mm));
    let is_other =
        |kind: PathKind| !matches!(kind, PathKind::Dimension | PathKind::Outline | PathKind::Hole);
    let others = piece.paths.iter().filter(|path| is_other(path.kind));
    texts.chain(others.map(|path| path.points.clone())).collect()
}

/// The box around the outline as it is cut, mm.
pub(super) fn cut_around(piece: &Piece) -> Box2 {
    Box2::of_points(piece.outline().iter().copied())
        .unwrap_or(Box2 { min: Point2::default(), max: Point2::default() })
}

/// The box around all that is drawn, mm.
pub(super) fn drawn_around(piece: &Piece) -> Box2 {
    let cut = cut_around(piece);
    let others = drawn_lines(piece).into_iter().flatten();
    Box2::of_points(others.chain([cut.min, cut.max])).unwrap_or(cut)
}
