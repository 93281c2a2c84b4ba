//! The overall dimensions of a piece: a line with ticks below it and one to its left.

use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use sheetwright_geometry::math::{Point2, Vec2};

/// Lines and texts that give the width and height of a piece of this size, mm, whose lower left
/// corner is the origin. `height_mm` is that of the letters.
pub(super) fn overall(size: Vec2, height_mm: f64) -> (Vec<PatternPath>, Vec<PatternLabel>) {
    let away = 2.0 * height_mm;
    let tick = 0.5 * height_mm;
    let (below, left) = (-away, -away);
    let line = |a: Point2, b: Point2| PatternPath {
        role: Role::Note,
        kind: PathKind::Dimension,
        points: vec![a, b],
        closed: false,
    };
    let at = Point2::new;
    let paths = vec![
        line(at(0.0, below), at(size.x, below)),
        line(at(0.0, below - tick), at(0.0, below + tick)),
        line(at(size.x, below - tick), at(size.x, below + tick)),
        line(at(left, 0.0), at(left, size.y)),
        line(at(left - tick, 0.0), at(left + tick, 0.0)),
        line(at(left - tick, size.y), at(left + tick, size.y)),
    ];
    let label = |at: Point2, along: Vec2, length: f64| PatternLabel {
        kind: LabelKind::Overall,
        role: Role::Note,
        at,
        along,
        height_mm,
        text: millimetres(length),
    };
    let labels = vec![
        label(at(0.5 * size.x, below - 1.6 * height_mm), Vec2::X, size.x),
        label(at(left - 0.6 * height_mm, 0.5 * size.y), Vec2::Y, size.y),
    ];
    (paths, labels)
}

/// A length in words: tenths of a millimetre.
pub(super) fn millimetres(length: f64) -> String {
    format!("{length:.1} mm")
}
