//! A piece on a page: the part of it that the page shows, at a scale.

use super::drawn::{drawn_labels, text_around};
use super::page::{PdfPage, Pen};
use crate::stroke_font::strokes;
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::{PathKind, PatternLabel, PatternPath, Piece, Role};
use sheetwright::predicate::Box2;

/// An upper bound on the distance that a pen draws from its line, mm on the page: the widest line
/// is 0.35 mm wide.
const WIDEST_MM: f64 = 1.0;

/// A part of the plane of a piece and where it lies on a page.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PaperView {
    /// The part, in the coordinates of the piece, mm.
    pub(crate) shown: Box2,
    /// Where its lower left corner lies on the page, mm.
    pub(crate) corner: Point2,
    /// The denominator of the scale, such as 400 for 1:400.
    pub(crate) scale: f64,
}

impl PaperView {
    /// Where a point of the piece lies on the page.
    pub(crate) fn place(&self, point: Point2) -> Point2 {
        self.corner + (point - self.shown.min) / self.scale
    }

    /// The rectangle of the page that shows the part.
    pub(crate) fn frame(&self) -> Box2 {
        Box2 { min: self.corner, max: self.place(self.shown.max) }
    }
}

/// How much of a piece is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Detail {
    /// All but dimensions, which stand in the margins of other files.
    Full,
    /// The outline and the folds.
    Lines,
}

/// Draws the part of the piece that the view shows, with the texts that it shows whole: others
/// stand whole on a neighbour.
pub(crate) fn draw(page: &mut PdfPage, piece: &Piece, view: &PaperView, detail: Detail) {
    let labels: Vec<&PatternLabel> = match detail {
        Detail::Full => drawn_labels(piece).filter(|label| is_whole(label, view)).collect(),
        Detail::Lines => Vec::new(),
    };
    page.clipped(view.frame(), |page| {
        // The lines that matter most are drawn last, over the others.
        for (role, pen) in [
            (Role::Note, Pen::NOTE),
            (Role::Engrave, Pen::ENGRAVE),
            (Role::Net, Pen::NET),
            (Role::Score, Pen::SCORE),
            (Role::Cut, Pen::CUT),
            (Role::Inner, Pen::CUT),
            (Role::Drill, Pen::CUT),
        ] {
            if detail == Detail::Lines && matches!(role, Role::Note | Role::Engrave) {
                continue;
            }
            for path in piece.paths.iter().filter(|path| path.role == role) {
                if path.kind != PathKind::Dimension {
                    let pen = if is_valley(path) { Pen::VALLEY } else { pen };
                    page.lines(&visible(&path.points, path.closed, view), pen);
                }
            }
            for label in labels.iter().filter(|label| label.role == role) {
                for stroke in strokes(&label.text, label.at, label.along, label.height_mm) {
                    page.lines(&visible(&stroke, false, view), pen);
                }
            }
        }
    });
}

/// Whether a path is folded towards the viewer, as its pen shows.
pub(super) fn is_valley(path: &PatternPath) -> bool {
    matches!(path.kind, PathKind::VALLEY | PathKind::TrimFold { mountain: false })
}

/// Whether a view shows a text whole.
fn is_whole(label: &PatternLabel, view: &PaperView) -> bool {
    let Box2 { min, max } = view.shown;
    text_around(label).is_none_or(|text| {
        min.x <= text.min.x && min.y <= text.min.y && text.max.x <= max.x && text.max.y <= max.y
    })
}

/// The runs of edges of a line that may be visible in a view, in coordinates of the page.
fn visible(line: &[Point2], closed: bool, view: &PaperView) -> Vec<Vec<Point2>> {
    let count = if closed { line.len() } else { line.len().saturating_sub(1) };
    let wide = Vec2::splat(WIDEST_MM * view.scale);
    let around = Box2 { min: view.shown.min + -wide, max: view.shown.max + wide };
    let mut runs: Vec<Vec<Point2>> = Vec::new();
    let mut running = false;
    for n in 0..count {
        let (from, to) = (line[n], line[(n + 1) % line.len()]);
        let seen = around.part_inside(from, to).is_some();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_lines_that_cross_the_view_are_drawn() {
        let at = Point2::new;
        let shown = Box2 { min: at(100.0, 100.0), max: at(200.0, 200.0) };
        let view = PaperView { shown, corner: at(10.0, 10.0), scale: 1.0 };
        let runs = |line: &[Point2]| visible(line, false, &view).len();
        // It passes a corner of the view, although its bounding box overlaps the view.
        assert_eq!(runs(&[at(0.0, 250.0), at(180.0, 0.0)]), 1);
        assert_eq!(runs(&[at(0.0, 150.0), at(150.0, 0.0)]), 0);
        // Half of its width is visible.
        assert_eq!(runs(&[at(0.0, 99.9), at(300.0, 99.9)]), 1);
        // Within half a pen of the frame on the page, at a smaller scale.
        let small = PaperView { scale: 400.0, ..view };
        let beside = |y: f64| visible(&[at(0.0, y), at(300.0, y)], false, &small).len();
        assert_eq!((beside(100.0 - 0.1 * 400.0), beside(100.0 - 2.0 * 400.0)), (1, 0));
        // An outline with two visible sides of four.
        let outline = [at(50.0, 50.0), at(150.0, 50.0), at(150.0, 150.0), at(50.0, 150.0)];
        assert_eq!(
            visible(&outline, true, &view),
            [[at(60.0, -40.0), at(60.0, 60.0), at(-40.0, 60.0)]]
        );
        // Out and in again.
        assert_eq!(
            runs(&[at(150.0, 150.0), at(300.0, 150.0), at(300.0, 170.0), at(150.0, 170.0)]),
            2
        );
    }
}
