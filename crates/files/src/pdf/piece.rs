//! A piece on a page: the part of it that the page shows, at a scale.

use super::page::{Page, Pen};
use crate::stroke_font::strokes;
use sheetwright::math::Point2;
use sheetwright::pattern::{PathKind, Piece, Role};
use sheetwright::predicate::Box2;

/// A part of the plane of a piece and where it lies on a page.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// The part, in the coordinates of the piece, mm.
    pub(super) shown: Box2,
    /// Where its lower left corner lies on the page, mm.
    pub(super) corner: Point2,
    /// The scale, as 400 of 1:400.
    pub(super) scale: f64,
}

impl View {
    /// Where a point of the piece lies on the page.
    pub(super) fn place(&self, point: Point2) -> Point2 {
        self.corner + (point - self.shown.min) / self.scale
    }

    /// The rectangle of the page that shows the part.
    pub(super) fn frame(&self) -> Box2 {
        Box2 { min: self.corner, max: self.place(self.shown.max) }
    }
}

/// How much of a piece is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// All but dimensions, which stand in the margins of other files.
    Full,
    /// The outline and the folds.
    Lines,
}

/// Draws the part of the piece that the view shows.
pub(super) fn draw(page: &mut Page, piece: &Piece, view: &View, detail: Detail) {
    page.clipped(view.frame(), |page| {
        // The lines that matter most are drawn last, over the others.
        for (role, pen) in [
            (Role::Note, Pen::NOTE),
            (Role::Engrave, Pen::ENGRAVE),
            (Role::Score, Pen::SCORE),
            (Role::Cut, Pen::CUT),
        ] {
            if detail == Detail::Lines && matches!(role, Role::Note | Role::Engrave) {
                continue;
            }
            for path in piece.paths.iter().filter(|path| path.role == role) {
                if path.kind != PathKind::Dimension {
                    page.lines(&visible(&path.points, path.closed, view), pen);
                }
            }
            for label in piece.labels.iter().filter(|l| l.role == role && role != Role::Note) {
                for stroke in strokes(&label.text, label.at, label.along, label.height_mm) {
                    page.lines(&visible(&stroke, false, view), pen);
                }
            }
        }
    });
}

/// The runs of a line whose edges may be seen in a view, on the page.
fn visible(line: &[Point2], closed: bool, view: &View) -> Vec<Vec<Point2>> {
    let count = if closed { line.len() } else { line.len().saturating_sub(1) };
    let mut runs: Vec<Vec<Point2>> = Vec::new();
    let mut running = false;
    for n in 0..count {
        let (from, to) = (line[n], line[(n + 1) % line.len()]);
        let seen = overlap(Box2::of_segment(from, to), view.shown);
        if seen {
            match runs.last_mut().filter(|_| running) {
                Some(run) => run.push(view.place(to)),
                None => runs.push(vec![view.place(from), view.place(to)]),
            }
        }
        running = seen;
    }
    runs
}

/// Whether two boxes have a point in common.
pub(super) fn overlap(a: Box2, b: Box2) -> bool {
    a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y
}
