//! Whether a stroke ends where it began.
//!
//! A hand rarely ends at the very spot: it stops short, or runs past or across the beginning. So
//! places near both ends are compared in pairs. The best pair has the least sum of its gap and a
//! quarter of the length that is cut off outside of it. The gap is then closed by moving a short
//! stretch at both ends.

use super::path::Path;
use sheetwright_geometry::math::Point2;

/// The stretch at each end that is searched, as a share of the length.
const NEAR_END: f64 = 0.12;
/// Places compared near each end.
const PLACES: usize = 48;
/// The cost of a mm that is cut off, in mm of gap.
const CUT_COST: f64 = 0.25;
/// The stretch at each end that is moved to close a gap, as a share of the length: the ends are
/// turned by a few degrees only.
const DRAWN_TOGETHER: f64 = 0.15;

/// The points of the closed path that a stroke makes, the last joined to the first; `None` where
/// its ends don't meet within `close_share` of its length.
pub(super) fn closing(points: &[Point2], close_share: f64) -> Option<Vec<Point2>> {
    let path = Path::new(points.to_vec(), false);
    let length = path.length();
    let step = NEAR_END * length / PLACES as f64;
    let cut = |i: usize| i as f64 * step;
    let mut best: Option<(f64, usize, usize)> = None;
    for i in 0..PLACES {
        for j in 0..PLACES {
            let gap = path.at(cut(i)).distance(path.at(length - cut(j)));
            let cost = gap + CUT_COST * (cut(i) + cut(j));
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, i, j));
            }
        }
    }
    let (cost, i, j) = best?;
    if cost > close_share * length || points.len() < 3 {
        return None;
    }
    let kept = trimmed(&path, cut(i), length - cut(j));
    Some(drawn_together(kept)).filter(|points| points.len() >= 3)
}

/// The path between two lengths along it.
fn trimmed(path: &Path, from: f64, to: f64) -> Vec<Point2> {
    let mut kept = vec![path.at(from)];
    let mut way = 0.0;
    for (a, b) in path.steps() {
        way += a.distance(b);
        if way > from && way < to {
            kept.push(b);
        }
    }
    kept.push(path.at(to));
    kept.dedup();
    kept
}

/// The points with both ends moved to the middle between them, and the others less and less with
/// the distance from there; without the last, which repeats the first.
fn drawn_together(points: Vec<Point2>) -> Vec<Point2> {
    let path = Path::new(points, false);
    let (first, last) = (path.at(0.0), path.at(path.length()));
    let middle = first.lerp(last, 0.5);
    let over = DRAWN_TOGETHER * path.length();
    let mut way = 0.0;
    let mut before = first;
    let mut drawn: Vec<Point2> = Vec::with_capacity(path.points.len());
    for &p in &path.points {
        way += before.distance(p);
        before = p;
        let (at_start, at_end) = (1.0 - way / over, 1.0 - (path.length() - way) / over);
        drawn.push(p + (middle - first) * at_start.max(0.0) + (middle - last) * at_end.max(0.0));
    }
    drawn.pop();
    drawn
}
