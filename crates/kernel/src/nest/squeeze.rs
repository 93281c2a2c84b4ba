//! The parts of one sheet are pushed together along it, so that what is left over is one piece, or
//! that a roll gets short: the room is shortened bit by bit, and the parts are separated again
//! \[GardeynVandenBergheWauters2025\].
//!
//! At first the room gets shorter by a thousandth at a time. Where the parts can't be separated,
//! two large ones change places and the search begins anew; after some failures, the last state
//! without overlaps is squeezed by ever smaller steps.

use super::layout::Pose;
use super::separate::{Budget, Patience, restore, separate};
use super::state::State;
use sheetwright_geometry::math::Vec2;
use sheetwright_geometry::random::Random;

/// The most rounds; few parts have fewer, [`PER_PART`] each.
const EXPLORE: Patience = Patience { rounds: 60, strikes: 3 };
/// Likewise.
const COMPRESS: Patience = Patience { rounds: 40, strikes: 3 };
/// See [`EXPLORE`].
const PER_PART: usize = 5;
/// By which share the room gets shorter while the search explores.
const STEP: f64 = 0.001;
/// From which share to which while it compresses, and how it changes after a failure.
const STEPS: [f64; 2] = [0.0005, 0.00001];
const AFTER_FAILURE: f64 = 0.9;
/// So many failures in a row end the exploring, and fewer with few parts.
const FAILURES: usize = 10;
/// The share of the budget for exploring.
const EXPLORES: f64 = 0.8;
/// Large parts: those that make up this share of the area of all hulls.
const LARGE: f64 = 0.75;

/// Squeezes the parts on a sheet, which do not overlap. `least` is a length that no layout beats,
/// mm.
pub(super) fn squeeze(
    state: &mut State<'_>,
    sheet: usize,
    least: f64,
    budget: &mut Budget<'_>,
    random: &mut Random,
) {
    let low = state.rooms[sheet].low.x;
    let full = state.rooms[sheet].high.x;
    let mut best = (state.reach(sheet), state.poses.clone());
    let whole = budget.left;
    let count = state.on[sheet].len();
    let of_few = |most: Patience| Patience { rounds: most.rounds.min(PER_PART * count), ..most };
    let is_late = |budget: &mut Budget<'_>, share: f64| {
        (budget.left as f64) < (1.0 - share) * whole as f64 || budget.is_over()
    };
    state.rooms[sheet].high.x = best.0;
    let mut pool: Vec<(f64, Vec<Option<Pose>>)> = Vec::new();
    while !is_late(budget, EXPLORES) && best.0 - low > 1.0005 * least {
        if pool.is_empty() {
            let length = (state.rooms[sheet].high.x - low) * (1.0 - STEP);
            shorten(state, sheet, low + length, 0.5);
        }
        let loss = separate(state, &[sheet], of_few(EXPLORE), budget, random);
        if loss == 0.0 {
            // The parts may reach less far than the room.
            let reach = state.reach(sheet);
            state.rooms[sheet].high.x = reach;
            best = (reach, state.poses.clone());
            pool.clear();
            continue;
        }
        let at = pool.partition_point(|other| other.0 <= loss);
        pool.insert(at, (loss, state.poses.clone()));
        if pool.len() >= FAILURES.min(1 + count) {
            break;
        }
        // Better states are more likely.
        let share = random.unit() * random.unit();
        let chosen = pool[((share * pool.len() as f64) as usize).min(pool.len() - 1)].1.clone();
        restore(state, &chosen);
        swap(state, sheet, random);
    }
    let mut step = STEPS[0];
    while step >= STEPS[1] && !budget.is_over() && best.0 - low > 1.0005 * least {
        restore(state, &best.1);
        state.rooms[sheet].high.x = best.0;
        let length = (best.0 - low) * (1.0 - step);
        let split = random.unit();
        shorten(state, sheet, low + length, split);
        if separate(state, &[sheet], of_few(COMPRESS), budget, random) == 0.0 {
            let reach = state.reach(sheet);
            best = (reach, state.poses.clone());
        } else {
            step *= AFTER_FAILURE;
        }
    }
    restore(state, &best.1);
    state.rooms[sheet].high.x = full;
}

/// Makes the room of a sheet end at `end`. Parts beyond a share of its length move with the end.
fn shorten(state: &mut State<'_>, sheet: usize, end: f64, share: f64) {
    let room = &mut state.rooms[sheet];
    let split = room.low.x + share * (room.high.x - room.low.x);
    let by = Vec2::new(end - room.high.x, 0.0);
    room.high.x = end;
    for item in state.on[sheet].clone() {
        if let Some(pose) = state.poses[item]
            && pose.at.x > split
        {
            state.lay(item, Pose { at: pose.at + by, ..pose });
        }
    }
}

/// Two large parts change places.
fn swap(state: &mut State<'_>, sheet: usize, random: &mut Random) {
    let mut items = state.on[sheet].clone();
    if items.len() < 2 {
        return;
    }
    let area = |item: usize| state.shape(item).hull_area;
    items.sort_by(|&a, &b| area(b).total_cmp(&area(a)).then(a.cmp(&b)));
    let whole: f64 = items.iter().map(|&item| area(item)).sum();
    let mut sum = 0.0;
    let count = items.iter().take_while(|&&item| {
        let is_large = sum < LARGE * whole;
        sum += area(item);
        is_large
    });
    let large = items[..count.count().max(2)].to_vec();
    let first = large[random.below(large.len())];
    let differs = |item: &usize| (area(*item) - area(first)).abs() > 0.01 * area(first);
    let others: Vec<usize> = large.iter().copied().filter(|item| differs(item)).collect();
    let others = if others.is_empty() {
        items.iter().copied().filter(|&item| item != first).collect()
    } else {
        others
    };
    let second = others[random.below(others.len())];
    if let (Some(one), Some(other)) = (state.poses[first], state.poses[second]) {
        state.lay(first, Pose { at: other.at, ..one });
        state.lay(second, Pose { at: one.at, ..other });
    }
}
