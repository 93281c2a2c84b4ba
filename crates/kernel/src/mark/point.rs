//! Marks at single places: holes and texts.

use super::Marked;
use super::fault::MarkNote;
use super::part::MarkPart;
use crate::design::{MarkAt, MarkKind};
use crate::pattern::Wish;
use crate::trim::drilled;
use sheetwright_geometry::math::Point2;

/// The place on the pattern of a part; `None` where a place in space is too far from it.
pub(super) fn place(part: &MarkPart<'_>, at: &MarkAt) -> Option<Point2> {
    match *at {
        MarkAt::Flat { at } => Some(at),
        MarkAt::Space { at, within } => {
            let (place, off_mm) = part.nearest(at);
            (off_mm <= within).then_some(place)
        }
    }
}

/// Marks a hole or a text; whether its place lies on the part.
pub(super) fn mark(part: &MarkPart<'_>, kind: &MarkKind, made: &mut Marked) -> bool {
    let (at, radius_mm) = match kind {
        MarkKind::Drill { at, diameter } => (Some(at), 0.5 * diameter),
        MarkKind::Text { at, .. } => (at.as_ref(), 0.0),
        _ => return false,
    };
    let at = match at.map(|at| place(part, at)) {
        Some(None) => return false,
        Some(Some(at)) => Some(at),
        None => None,
    };
    if let Some(at) = at
        && (!part.room.holds(at) || part.room.clearance(at) < radius_mm)
    {
        let what = kind.name().to_owned();
        made.notes.push(MarkNote::OverTheEdge { what, at, radius_mm });
        return true;
    }
    match (kind, at) {
        (MarkKind::Drill { diameter, .. }, Some(at)) => made.paths.push(drilled(at, *diameter)),
        (MarkKind::Text { text, height, .. }, at) => {
            let wish = match at {
                Some(at) => Wish::near(text.clone(), at),
                None => Wish::anywhere(text.clone()),
            };
            made.wishes.push(wish.high(*height));
        }
        _ => {}
    }
    true
}
