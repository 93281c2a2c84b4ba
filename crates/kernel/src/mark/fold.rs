//! An edge on the fold of the cloth: the piece is cut double, and opened.

use super::Marked;
use super::fault::MarkNote;
use super::part::MarkPart;
use crate::pattern::{PathKind, PatternPath, Role, Wish};
use sheetwright_geometry::math::Point2;

/// An edge on a fold leaves the straight line between its ends by no more than this share of it.
const STRAIGHT: f64 = 1e-3;

/// Marks an edge of a part, if it has one of this name.
pub(super) fn mark(part: &MarkPart<'_>, edge: &str, made: &mut Marked) {
    let Some(edge) = part.edge(edge) else { return };
    let points: Vec<Point2> = edge.run.iter().map(|&v| part.flat[v]).collect();
    let ends = [points[0], points[points.len() - 1]];
    let off_mm = points.iter().map(|p| p.distance_to_segment(ends)).fold(0.0, f64::max);
    if off_mm > STRAIGHT * ends[0].distance(ends[1]) {
        let edge = format!("{}/{}", part.name, edge.name);
        made.notes.push(MarkNote::CurvedFold { edge, off_mm });
        return;
    }
    made.wishes.push(Wish::inside_edge("cut on fold".to_owned(), &points));
    let (role, kind) = (Role::Note, PathKind::OnFold);
    made.paths.push(PatternPath { role, kind, points, closed: false });
}
