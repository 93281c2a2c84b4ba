//! A better place for one part: many places are tried at random, all over the sheets and round
//! where it lies, and the best of them are improved step by step, along one axis after the other
//! \[GardeynVandenBergheWauters2025\].

use super::layout::{Placed, Pose, Room};
use super::shape::Shape;
use super::turns::Turns;
use sheetwright_geometry::math::{Point2, Vec2, from_deg};
use sheetwright_geometry::random::Random;

/// How many places are tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tries {
    /// All over the sheets.
    pub(super) anywhere: usize,
    /// Round where it lies.
    pub(super) near: usize,
    /// How many of the best are improved.
    pub(super) kept: usize,
}

/// Steps as shares of the smaller side of the part: the first one and the last.
const COARSE: [f64; 2] = [0.25, 0.02];
const FINE: [f64; 2] = [0.01, 0.001];
/// Steps of the angle, degrees: likewise.
const COARSE_DEG: [f64; 2] = [5.0, 1.0];
const FINE_DEG: [f64; 2] = [0.5, 0.05];
/// Places nearer than this share of the smaller side are one.
const SAME: f64 = 0.05;

/// What is sought: where a part may lie, and what a place costs.
pub(super) struct Sought<'a> {
    pub(super) shape: &'a Shape,
    pub(super) turns: &'a Turns,
    /// The sheets that it may lie on, and the rooms on all.
    pub(super) sheets: &'a [usize],
    pub(super) rooms: &'a [Room],
}

/// The best place that was found, and what it costs. `cost` is asked for the price of a place and
/// may give any number above the bound where the price is above it.
pub(super) fn best_place(
    sought: &Sought<'_>,
    now: Option<Pose>,
    tries: Tries,
    random: &mut Random,
    cost: &mut dyn FnMut(&Pose, &Placed, f64) -> f64,
) -> Option<(Pose, f64)> {
    let mut placed = Placed::default();
    let mut price = |pose: &Pose, bound: f64| {
        placed.set(sought.shape, pose);
        cost(pose, &placed, bound)
    };
    let mut best: Vec<(Pose, f64)> = Vec::with_capacity(tries.kept + 1);
    let same = SAME * sought.shape.least_side;
    let bound = |best: &Vec<(Pose, f64)>| match best.last() {
        Some(last) if best.len() == tries.kept => last.1,
        _ => f64::INFINITY,
    };
    fn note(best: &mut Vec<(Pose, f64)>, found: (Pose, f64), kept: usize, same: f64) {
        let is_same = |other: &(Pose, f64)| {
            other.0.sheet == found.0.sheet
                && other.0.at.distance(found.0.at) < same
                && (other.0.turn - found.0.turn).abs() < from_deg(1.0)
        };
        if let Some(n) = best.iter().position(is_same) {
            if best[n].1 <= found.1 {
                return;
            }
            best.remove(n);
        }
        let n = best.partition_point(|other| other.1 <= found.1);
        best.insert(n, found);
        best.truncate(kept);
    }
    if let Some(now) = now {
        let cost = price(&now, f64::INFINITY);
        note(&mut best, (now, cost), tries.kept, same);
        for _ in 0..tries.near {
            let (turn, is_over) = sought.turns.any(sought.shape, random);
            let around = Vec2::splat(sought.shape.radius);
            let room = &sought.rooms[now.sheet];
            let (low, high) = (now.at.to_vec() - around, now.at.to_vec() + around);
            let at = any_in(low.max(room.low), high.min(room.high), random);
            let pose = Pose { at, turn, is_over, ..now };
            let cost = price(&pose, bound(&best));
            note(&mut best, (pose, cost), tries.kept, same);
        }
    }
    if !sought.sheets.is_empty() {
        for _ in 0..tries.anywhere {
            let sheet = sought.sheets[random.below(sought.sheets.len())];
            let (turn, is_over) = sought.turns.any(sought.shape, random);
            let room = &sought.rooms[sheet];
            let pose = Pose { sheet, at: Point2::default(), turn, is_over };
            // The middle lies so that the box is inside the room, if it can.
            let (low, high) = within(sought.shape, &pose, room);
            let pose = Pose { at: any_in(low, high, random), ..pose };
            let cost = price(&pose, bound(&best));
            note(&mut best, (pose, cost), tries.kept, same);
        }
    }
    let steps = |[first, last]: [f64; 2]| [first, last].map(|s| s * sought.shape.least_side);
    let wiggles = sought.turns.wiggles();
    for start in best.clone() {
        let found = descend(
            start,
            steps(COARSE),
            COARSE_DEG.map(from_deg),
            wiggles,
            random,
            sought.turns,
            &mut price,
        );
        note(&mut best, found, tries.kept, same);
    }
    let first = *best.first()?;
    Some(descend(
        first,
        steps(FINE),
        FINE_DEG.map(from_deg),
        wiggles,
        random,
        sought.turns,
        &mut price,
    ))
}

fn any_in(low: Vec2, high: Vec2, random: &mut Random) -> Point2 {
    let x = random.between(low.x, high.x.max(low.x));
    let y = random.between(low.y, high.y.max(low.y));
    Point2::new(x, y)
}

/// Between which corners the middle of a form may lie so that its box is inside a room; both in the
/// middle of the room where it is too large.
fn within(shape: &Shape, pose: &Pose, room: &Room) -> (Vec2, Vec2) {
    let mut placed = Placed::default();
    placed.set(shape, pose);
    let (low, high) = (room.low - placed.low, room.high - placed.high);
    let middle = 0.5 * (low + high);
    let fits =
        |low: f64, high: f64, middle: f64| if low <= high { [low, high] } else { [middle; 2] };
    let (x, y) = (fits(low.x, high.x, middle.x), fits(low.y, high.y, middle.y));
    (Vec2::new(x[0], y[0]), Vec2::new(x[1], y[1]))
}

/// Goes down from a place: two places are tried, one on either side along an axis. A step that
/// helps grows a little, one that does not is halved, and another axis is taken.
fn descend(
    start: (Pose, f64),
    steps: [f64; 2],
    angles: [f64; 2],
    wiggles: bool,
    random: &mut Random,
    turns: &Turns,
    price: &mut dyn FnMut(&Pose, f64) -> f64,
) -> (Pose, f64) {
    const GROWS: f64 = 1.1;
    const SHRINKS: f64 = 0.5;
    const ROOT_OF_HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
    const ROOT_OF_GROWS: f64 = 1.048_808_848_170_151_6;
    let (mut pose, mut cost) = start;
    let (mut x, mut y, mut angle) = (steps[0], steps[0], angles[0]);
    let axes = if wiggles { 6 } else { 4 };
    let mut axis = random.below(axes);
    while cost > 0.0 && (x >= steps[1] || y >= steps[1] || (wiggles && angle >= angles[1])) {
        let moved = |way: f64| {
            let (by, turn) = match axis {
                0 => (Vec2::new(way * x, 0.0), 0.0),
                1 => (Vec2::new(0.0, way * y), 0.0),
                2 => (Vec2::new(way * x, way * y), 0.0),
                3 => (Vec2::new(-way * x, way * y), 0.0),
                _ => (Vec2::ZERO, way * angle),
            };
            Pose { at: pose.at + by, turn: turns.kept(pose.turn, pose.is_over, turn), ..pose }
        };
        let (one, other) = (moved(1.0), moved(-1.0));
        let of_one = price(&one, cost);
        let of_other = price(&other, cost.min(of_one));
        let (found, least) = if of_one <= of_other { (one, of_one) } else { (other, of_other) };
        let is_better = least < cost;
        if least <= cost {
            (pose, cost) = (found, least);
        }
        let by = if is_better { GROWS } else { SHRINKS };
        match axis {
            0 => x *= by,
            1 => y *= by,
            2 | 3 => {
                let by = if is_better { ROOT_OF_GROWS } else { ROOT_OF_HALF };
                (x, y) = (x * by, y * by);
            }
            _ => angle *= by,
        }
        if !is_better {
            axis = random.below(axes);
        }
    }
    (pose, cost)
}
