//! Joints that are cut into both of two joined edges: fingers, and puzzle joints.

use super::holes::circle;
use super::stretch::Stretch;
use crate::design::{Fingers, Puzzle};
use crate::edge::Shared;
use sheetwright_geometry::math::Point2;

/// The middle of a knob lies as far beyond the net line as this share of its radius, so that its
/// neck is three fifths as wide as it is.
const KNOB: f64 = 0.8;
/// A knob has as many sides.
const SIDES: u16 = 48;

/// What a joint adds to the two parts and takes from them, first that of the first edge.
#[derive(Default)]
pub(super) struct Jointed {
    pub(super) added: [Vec<Vec<Point2>>; 2],
    pub(super) removed: [Vec<Vec<Point2>>; 2],
}

/// An odd number of fingers, by turns on the first and the second edge, so that both ends of the
/// joint have one of the first.
pub(super) fn fingers(edges: [&Stretch; 2], shared: &Shared, fingers: &Fingers) -> Jointed {
    let length = shared.first[1] - shared.first[0];
    let pairs = (0.5 * (length / fingers.width - 1.0)).round().max(1.0);
    let count = 2 * pairs as usize + 1;
    let gap = 0.5 * fingers.clearance / length;
    let mut made = Jointed::default();
    for n in 0..count {
        let [from, to] = [n, n + 1].map(|n| n as f64 / count as f64);
        // The ends of the joint have no neighbour to keep clear of.
        let from = if n == 0 { from } else { from + gap };
        let to = if n + 1 == count { to } else { to - gap };
        let of_second = n % 2;
        let [begin, end] = [shared.first, shared.second][of_second];
        let mut span = [from, to].map(|share| begin + share * (end - begin));
        span.sort_by(f64::total_cmp);
        let line = edges[of_second].part(span);
        let mut polygon = super::stretch::moved_out(&line, fingers.depth);
        polygon.reverse();
        polygon.splice(0..0, line);
        made.added[of_second].push(polygon);
    }
    made
}

/// Knobs by turns on the first and the second edge, each with its socket on the other.
pub(super) fn puzzle(edges: [&Stretch; 2], shared: &Shared, puzzle: &Puzzle) -> Jointed {
    let length = shared.first[1] - shared.first[0];
    let count = (length / puzzle.pitch).round().max(1.0);
    let radius = 0.5 * puzzle.width;
    let mut made = Jointed::default();
    for n in 0..count as usize {
        let share = (n as f64 + 0.5) / count;
        let spots = [(edges[0], shared.first), (edges[1], shared.second)]
            .map(|(edge, [from, to])| edge.at(from + share * (to - from)));
        let (knob, socket) = (n % 2, 1 - n % 2);
        let beyond = spots[knob].beside(0.0, KNOB * radius);
        made.added[knob].push(circle(beyond, radius, SIDES));
        let within = spots[socket].beside(0.0, -KNOB * radius);
        made.removed[socket].push(circle(within, radius + 0.5 * puzzle.clearance, SIDES));
    }
    made
}
