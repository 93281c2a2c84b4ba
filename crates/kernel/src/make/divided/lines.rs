//! Lines of a part as far as they lie on a piece of it: its bend lines, and where laps end.

use super::cutout::Cutout;
use crate::bend::BendLine;
use crate::pattern::Room;
use sheetwright_geometry::math::{Point2, unit2};

/// What is left of a line, as a share of its length, is too short to bend along.
const LEAST: f64 = 1e-6;

/// The loops of a piece on the pattern of the whole.
pub(super) fn loops(cutout: &Cutout<'_>) -> Vec<Vec<Point2>> {
    let flat = cutout.flat();
    cutout.loops().into_iter().map(|range| flat[range].to_vec()).collect()
}

/// The stretches of a straight line that lie inside some loops, as shares of it.
fn inside(line: [Point2; 2], loops: &[Vec<Point2>]) -> Vec<[f64; 2]> {
    let room = Room::new(loops.iter().map(|line| &line[..]));
    let way = line[1] - line[0];
    let mut shares = vec![0.0, 1.0];
    for points in loops {
        let next = points.iter().cycle().skip(1);
        for (&a, &b) in points.iter().zip(next) {
            let sine = way.perp_dot(b - a);
            let share = (a - line[0]).perp_dot(b - a) / sine;
            let on_side = (a - line[0]).perp_dot(way) / sine;
            let is_met = (-LEAST..=1.0 + LEAST).contains(&on_side);
            if is_met && LEAST < share && share < 1.0 - LEAST {
                shares.push(share);
            }
        }
    }
    shares.sort_by(f64::total_cmp);
    let mut stretches: Vec<[f64; 2]> = Vec::new();
    for pair in shares.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if to - from <= LEAST || !room.holds(line[0].lerp(line[1], 0.5 * (from + to))) {
            continue;
        }
        match stretches.last_mut() {
            Some(last) if from - last[1] <= LEAST => last[1] = to,
            _ => stretches.push([from, to]),
        }
    }
    stretches
}

/// The bend lines of the whole that a piece has, cut off at its border: they keep their angles.
pub(super) fn bends(whole: &[BendLine], loops: &[Vec<Point2>]) -> Vec<BendLine> {
    let clipped = whole.iter().flat_map(|line| {
        inside(line.ends, loops).into_iter().map(move |shares| {
            let between = |[a, b]: [f64; 2]| shares.map(|share| a + share * (b - a));
            let end = |share: f64| match share {
                0.0 => line.ends[0],
                1.0 => line.ends[1],
                share => line.ends[0].lerp(line.ends[1], share),
            };
            BendLine {
                ends: shares.map(end),
                pitch_mm: between(line.pitch_mm),
                along_mm: between(line.along_mm),
                ..line.clone()
            }
        })
    });
    clipped.collect()
}

/// Where a lap that reaches so far to either side of a straight cut ends on a piece, which lies to
/// the left of the cut.
pub(super) fn lap_ends(cut: [Point2; 2], reach_mm: f64, loops: &[Vec<Point2>]) -> Vec<[Point2; 2]> {
    let Some(along) = unit2(cut[1] - cut[0]) else { return Vec::new() };
    let length = cut[0].distance(cut[1]);
    let inwards = along.perp() * reach_mm;
    // Beside a border that runs aslant, it is longer than the cut.
    let line = [cut[0] + (inwards - along * length), cut[1] + (inwards + along * length)];
    let on_line = inside(line, loops).into_iter().filter(|[from, to]| *to > 0.34 && *from < 0.66);
    on_line.map(|shares| shares.map(|share| line[0].lerp(line[1], share))).collect()
}
