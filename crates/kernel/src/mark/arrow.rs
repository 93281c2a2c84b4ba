//! Arrows on parts: the grain, and which way a face lies in space.
//!
//! An arrow stands at the place, of those that lie farthest from the lines, at which it can be
//! longest. Its direction is that at its middle: on a bent part, a direction in space is another at
//! each place.

use super::Marked;
use super::fault::MarkNote;
use super::part::MarkPart;
use crate::design::{MarkKind, MarkWay};
use crate::pattern::{PathKind, PatternPath, Role, Spot, Wish};
use sheetwright_geometry::math::{Point2, Vec2, cos, sin, unit2};
use sheetwright_geometry::predicate::segments_touch;

/// Places that are tried for an arrow.
const TRIED: usize = 120;
/// An arrow that crosses another mark counts as so much shorter.
const CROSSING: f64 = 0.5;
/// An arrow keeps this share of its half from the line ahead of it, at the least.
const SHARES: [f64; 5] = [0.9, 0.8, 0.7, 0.6, 0.4];
/// The head is as long as this share of an arrow, and no longer than [`HEAD_MM`].
const HEAD: f64 = 0.2;
/// See [`HEAD`].
const HEAD_MM: f64 = 10.0;
/// A barb spreads by this share of its length.
const BARB: f64 = 0.35;

/// Marks the grain or the face of a part.
pub(super) fn mark(part: &MarkPart<'_>, kind: &MarkKind, made: &mut Marked) {
    let (way, length, drawn, text) = match kind {
        MarkKind::Grain { way, length } => {
            (way.clone(), *length, PathKind::Grain, "grain".to_owned())
        }
        MarkKind::Face { text, toward, length } => {
            (MarkWay::Space { way: *toward }, *length, PathKind::Arrow, text.clone())
        }
        _ => return,
    };
    // An edge that only other parts have gives this one no direction.
    if matches!(&way, MarkWay::Edge { edge } if part.edge(edge).is_none()) {
        return;
    }
    let Some(points) = longest(part, &way, length, &made.paths) else {
        made.notes.push(MarkNote::SquareToPart { what: kind.name().to_owned() });
        if drawn == PathKind::Arrow {
            made.wishes.push(Wish::anywhere(text));
        }
        return;
    };
    let is_needed = drawn == PathKind::Arrow;
    made.wishes.push(Wish::beside(text, [points[0], points[1]], is_needed));
    made.paths.push(PatternPath { role: Role::Engrave, kind: drawn, points, closed: false });
}

/// The direction of a mark at a place of the pattern.
fn way_at(part: &MarkPart<'_>, way: &MarkWay, at: Point2) -> Option<Vec2> {
    match way {
        MarkWay::Space { way } => part.way_at(at, *way),
        MarkWay::Angle { angle } => Some(Vec2::new(cos(*angle), sin(*angle))),
        MarkWay::Edge { edge } => {
            let run = &part.edge(edge)?.run;
            let [first, last] = [run.first()?, run.last()?].map(|&v| part.flat[v]);
            unit2(last - first)
        }
    }
}

/// The longest arrow of a direction that fits inside a part, up to a length, mm: its line and then
/// its head, in one stroke. One that crosses another mark counts as shorter. `None` where the
/// direction is square to the part.
fn longest(
    part: &MarkPart<'_>,
    way: &MarkWay,
    most_mm: f64,
    others: &[PatternPath],
) -> Option<Vec<Point2>> {
    let mut best: Option<(f64, Vec<Point2>)> = None;
    for Spot { at, .. } in part.room.places([]).into_iter().take(TRIED) {
        let Some(way) = way_at(part, way, at) else { continue };
        let [ahead, back] = part.room.reach(at, way);
        let reach = ahead.min(back);
        let of_share = |share: &f64| arrow(at, way, (2.0 * share * reach).min(most_mm));
        let fitting = SHARES.iter().map(of_share).find(|points| part.room.holds_line(points));
        let Some(points) = fitting else { continue };
        let crossed = others.iter().any(|other| crosses(other, [points[0], points[1]]));
        let length = points[0].distance(points[1]) * if crossed { CROSSING } else { 1.0 };
        // A little longer is no reason to leave the middle.
        if best.as_ref().is_none_or(|(longest, _)| length > 1.001 * longest) {
            best = Some((length, points));
        }
    }
    best.map(|(_, points)| points)
}

/// Whether a path crosses a segment.
fn crosses(path: &PatternPath, [a, b]: [Point2; 2]) -> bool {
    let last = path.points.last().filter(|_| path.closed).zip(path.points.first());
    let steps = path.points.windows(2).map(|step| (step[0], step[1]));
    steps.chain(last.map(|(p, q)| (*p, *q))).any(|(p, q)| segments_touch(a, b, p, q))
}

/// An arrow about its middle.
fn arrow(middle: Point2, way: Vec2, length: f64) -> Vec<Point2> {
    let (tail, tip) = (middle + way * (-0.5 * length), middle + way * (0.5 * length));
    let head = (HEAD * length).min(HEAD_MM);
    let barb = |side: f64| tip + way * -head + way.perp() * (side * BARB * head);
    vec![tail, tip, barb(1.0), tip, barb(-1.0)]
}
