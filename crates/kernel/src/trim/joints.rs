//! Joints that are cut into both of two joined edges: fingers, puzzle joints, and tabs in slots.
//!
//! Fingers and slots are those of sheets whose inner faces were drawn: each reaches beyond the net
//! line over the edge of the other. A strip with slots lies beyond the net line of the second edge,
//! so its slots, which begin at that line, take nothing of the net.

use super::TrimFault;
use super::holes::circle;
use super::places::MOST;
use super::stretch::Stretch;
use crate::design::{Fingers, Puzzle, Slots};
use crate::edge::Shared;
use sheetwright_geometry::math::Point2;

/// The middle of a knob lies as far beyond the net line as this share of its radius, so that its
/// neck is three fifths as wide as it is.
pub(super) const KNOB: f64 = 0.8;
/// A knob has as many sides.
const SIDES: u16 = 48;

/// What a joint adds to the two parts and takes from them, first that of the first edge.
#[derive(Default)]
pub(super) struct Jointed {
    pub(super) added: [Vec<Vec<Point2>>; 2],
    pub(super) removed: [Vec<Vec<Point2>>; 2],
    /// Polygons that are taken from what is added beyond the second net line: holes.
    pub(super) slots: Vec<Vec<Point2>>,
}

/// An odd number of fingers, by turns on the first and the second edge, so that both ends of the
/// joint have one of the first.
pub(super) fn fingers(edges: [&Stretch; 2], shared: &Shared, fingers: &Fingers) -> Jointed {
    let length = shared.first[1] - shared.first[0];
    let pairs = (0.5 * (length / fingers.width - 1.0)).round().clamp(1.0, MOST);
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
    let count = (length / puzzle.pitch).round().clamp(1.0, MOST);
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

/// Tabs on the first edge, and slots for them in a strip beyond the second. A slot is as long and
/// as wide as a tab is long and its sheet thick, each with the clearance.
///
/// # Errors
/// Slots that run into one another, and holes in their corners that are wider than they.
pub(super) fn slots(
    edges: [&Stretch; 2],
    shared: &Shared,
    slots: &Slots,
    called: impl Fn() -> String,
) -> Result<Jointed, TrimFault> {
    let &Slots { pitch, width, depth, thickness, clearance, beyond, dogbone } = slots;
    let length = shared.first[1] - shared.first[0];
    let count = (length / pitch).round().clamp(1.0, MOST);
    let (slot_mm, wide_mm) = (width + clearance, thickness + clearance);
    let (over_mm, pitch_mm) = (slot_mm + dogbone, length / count);
    if over_mm >= pitch_mm {
        let edge = called();
        return Err(TrimFault::SlotsMeet { edge, slot_mm: over_mm, pitch_mm });
    }
    if dogbone > wide_mm {
        let edge = called();
        return Err(TrimFault::DogboneWide { edge, dogbone_mm: dogbone, slot_mm: wide_mm });
    }
    let beside = |edge: &Stretch, span: [f64; 2], reach_mm: f64| {
        let line = edge.part(span);
        let mut polygon = super::stretch::moved_out(&line, reach_mm);
        polygon.reverse();
        polygon.splice(0..0, line);
        polygon
    };
    let mut made = Jointed::default();
    let [low, high] = shared.second;
    let strip = [low.min(high), low.max(high)];
    made.added[1].push(beside(edges[1], strip, wide_mm + beyond));
    for n in 0..count as usize {
        let middle = (n as f64 + 0.5) / count;
        let [of_first, of_second] =
            [shared.first, shared.second].map(|[from, to]| from + middle * (to - from));
        let around = |at: f64, long_mm: f64| [at - 0.5 * long_mm, at + 0.5 * long_mm];
        made.added[0].push(beside(edges[0], around(of_first, width), depth));
        let ends = around(of_second, slot_mm);
        made.slots.push(beside(edges[1], ends, wide_mm));
        if dogbone > 0.0 {
            // They touch the long sides, and widen the slot along the edge alone.
            let radius = 0.5 * dogbone;
            for end in ends.map(|end| edges[1].at(end)) {
                let centres = [radius, wide_mm - radius].map(|out| end.beside(0.0, out));
                made.slots.extend(centres.map(|centre| circle(centre, radius, SIDES)));
            }
        }
    }
    Ok(made)
}
