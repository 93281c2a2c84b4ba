//! The first layout: parts one after the other, the largest first, each where it reaches least far
//! along the first sheet that takes it.

use super::layout::{Placed, Pose, Room, Work};
use super::search::{Sought, Tries, best_place};
use super::separate::Budget;
use super::state::State;
use sheetwright_geometry::random::Random;

const TRIES: Tries = Tries { anywhere: 600, near: 0, kept: 3 };
/// Across the sheet counts this much less than along it.
const ACROSS: f64 = 0.1;

/// Lays a part on a sheet beside what lies there, where it reaches least far along it; whether
/// there was a place.
pub(super) fn lay_on(
    state: &mut State<'_>,
    item: usize,
    sheet: usize,
    budget: &mut Budget<'_>,
    random: &mut Random,
) -> bool {
    let mut work = Work::default();
    let shape = state.shape(item);
    let room = &state.rooms[sheet];
    let low = room.low;
    let mut cost = |pose: &Pose, placed: &Placed, bound: f64| {
        work.0 += 4 * placed.points.len() as u64;
        let reach = placed.high - low;
        let score = (reach.x + ACROSS * reach.y).max(f64::MIN_POSITIVE);
        if score > bound || !state.is_free(item, pose, placed, &mut work) {
            return f64::INFINITY;
        }
        score
    };
    let sheets = [sheet];
    let sought =
        Sought { shape, turns: &state.items[item].turns, sheets: &sheets, rooms: &state.rooms };
    let found = best_place(&sought, None, TRIES, random, &mut cost);
    budget.spend(&mut work);
    match found {
        Some((pose, cost)) if cost < f64::INFINITY => {
            state.lay(item, pose);
            true
        }
        _ => false,
    }
}

/// Whether a part fits on an empty sheet in some way.
pub(super) fn fits(
    state: &State<'_>,
    item: usize,
    room: &Room,
    budget: &mut Budget<'_>,
    random: &mut Random,
) -> bool {
    let mut alone = State::new(state.shapes, state.items);
    alone.open(room.clone());
    lay_on(&mut alone, item, 0, budget, random)
}

/// The order in which parts are laid: groups together, the largest hull first.
pub(super) fn order(state: &State<'_>) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut known: Vec<(usize, usize)> = Vec::new();
    for (item, it) in state.items.iter().enumerate() {
        match it.group.and_then(|g| known.iter().find(|(group, _)| *group == g)) {
            Some(&(_, n)) => groups[n].push(item),
            None => {
                known.extend(it.group.map(|g| (g, groups.len())));
                groups.push(vec![item]);
            }
        }
    }
    let size = |item: usize| {
        state.shape(item).hull_area.max(state.shape(item).radius * state.shape(item).radius)
    };
    for group in &mut groups {
        group.sort_by(|&a, &b| size(b).total_cmp(&size(a)).then(a.cmp(&b)));
    }
    let most = |group: &[usize]| group.iter().map(|&item| size(item)).fold(0.0, f64::max);
    groups.sort_by(|a, b| most(b).total_cmp(&most(a)).then(a[0].cmp(&b[0])));
    groups
}
