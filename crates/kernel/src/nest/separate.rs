//! Parts that overlap are moved until none does: guided local search
//! \[GardeynVandenBergheWauters2025\].
//!
//! In each round, every part that collides is moved, in another order each time, to the best place
//! that is found for it, where a collision costs its badness times a weight. After the round, the
//! weights of pairs that still collide grow, the worse the faster, and those of others shrink back,
//! so that no pair stays stuck. Where rounds no longer help, the best state so far is taken up
//! again, with the weights as they are; after some of these the search gives up.

use super::layout::{Placed, Pose, Work, collision};
use super::search::{Sought, Tries, best_place};
use super::state::State;
use sheetwright_geometry::random::Random;

/// How long parts are moved before the search gives up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    /// Rounds in a row that don't help.
    pub(super) rounds: usize,
    /// Times that the best state is taken up again.
    pub(super) strikes: usize,
}

/// A weight grows by a factor between these, and shrinks by the last.
const GROWTH: [f64; 2] = [1.2, 2.0];
const DECAY: f64 = 0.95;
/// What counts as better: less by this share.
const BETTER: f64 = 0.98;
const TRIES: Tries = Tries { anywhere: 50, near: 25, kept: 3 };

/// What is known of collisions of the items that may move.
struct Collisions {
    /// The items that may move, in order, and the place of each item among them.
    items: Vec<usize>,
    place: Vec<usize>,
    /// Badness and weight of each pair, in both orders; a part and itself: with its sheet.
    loss: Vec<f64>,
    weight: Vec<f64>,
}

impl Collisions {
    fn new(state: &State<'_>, items: Vec<usize>, work: &mut Work) -> Self {
        let m = items.len();
        let mut place = vec![usize::MAX; state.items.len()];
        items.iter().enumerate().for_each(|(n, &item)| place[item] = n);
        let mut all = Self { items, place, loss: vec![0.0; m * m], weight: vec![1.0; m * m] };
        for n in 0..m {
            all.measure(state, all.items[n], work);
        }
        all
    }

    fn measure(&mut self, state: &State<'_>, item: usize, work: &mut Work) {
        let (m, n) = (self.items.len(), self.place[item]);
        for k in 0..m {
            self.loss[n * m + k] = 0.0;
            self.loss[k * m + n] = 0.0;
        }
        let Some(pose) = state.poses[item] else { return };
        let (shape, placed) = (state.shape(item), &state.placed[item]);
        self.loss[n * m + n] = state.rooms[pose.sheet].left(shape, placed, work);
        for &other in &state.on[pose.sheet] {
            if other != item && self.place[other] != usize::MAX {
                let loss =
                    collision((shape, placed), (state.shape(other), &state.placed[other]), work);
                let k = self.place[other];
                self.loss[n * m + k] = loss;
                self.loss[k * m + n] = loss;
            }
        }
    }

    fn of(&self, item: usize) -> f64 {
        let (m, n) = (self.items.len(), self.place[item]);
        self.loss[n * m..(n + 1) * m].iter().sum()
    }

    fn total(&self) -> f64 {
        self.loss.iter().sum()
    }

    fn weigh(&mut self) {
        let worst = self.loss.iter().copied().fold(0.0, f64::max);
        for (loss, weight) in self.loss.iter().zip(&mut self.weight) {
            let by = match *loss {
                0.0 => DECAY,
                loss => GROWTH[0] + (GROWTH[1] - GROWTH[0]) * loss / worst,
            };
            *weight = (*weight * by).max(1.0);
        }
    }
}

/// What the search may still do, and whether it is to end.
pub(super) struct Budget<'a> {
    pub(super) left: i64,
    pub(super) stop: &'a mut dyn FnMut(i64) -> bool,
}

impl Budget<'_> {
    pub(super) fn spend(&mut self, work: &mut Work) {
        self.left -= work.0 as i64;
        work.0 = 0;
    }

    pub(super) fn is_over(&mut self) -> bool {
        self.left <= 0 || (self.stop)(self.left)
    }
}

/// Moves the parts on some sheets, also from one to another, until none overlaps; whether that was
/// reached. Else the state is the best that was found; the number is its badness.
pub(super) fn separate(
    state: &mut State<'_>,
    sheets: &[usize],
    patience: Patience,
    budget: &mut Budget<'_>,
    random: &mut Random,
) -> f64 {
    let mut work = Work::default();
    let mut items: Vec<usize> = sheets.iter().flat_map(|&sheet| state.on[sheet].clone()).collect();
    items.sort_unstable();
    let mut collisions = Collisions::new(state, items, &mut work);
    let mut best = (collisions.total(), state.poses.clone());
    let mut strikes = 0;
    while strikes < patience.strikes && best.0 > 0.0 {
        let at_strike = best.0;
        let mut idle = 0;
        while idle < patience.rounds && best.0 > 0.0 {
            budget.spend(&mut work);
            if budget.is_over() {
                restore(state, &best.1);
                return best.0;
            }
            round(state, sheets, &mut collisions, &mut work, random);
            let total = collisions.total();
            if total < best.0 {
                idle = if total < BETTER * best.0 { 0 } else { idle };
                best = (total, state.poses.clone());
            } else {
                idle += 1;
            }
            collisions.weigh();
        }
        strikes = if best.0 < BETTER * at_strike { 0 } else { strikes + 1 };
        restore(state, &best.1);
        for n in 0..collisions.items.len() {
            collisions.measure(state, collisions.items[n], &mut work);
        }
    }
    budget.spend(&mut work);
    best.0
}

/// Lays all parts as they lay.
pub(super) fn restore(state: &mut State<'_>, poses: &[Option<Pose>]) {
    for (item, pose) in poses.iter().enumerate() {
        if state.poses[item] != *pose {
            match pose {
                Some(pose) => state.lay(item, *pose),
                None => state.take_up(item),
            }
        }
    }
}

/// Moves every part that collides.
fn round(
    state: &mut State<'_>,
    sheets: &[usize],
    collisions: &mut Collisions,
    work: &mut Work,
    random: &mut Random,
) {
    let mut colliding: Vec<usize> =
        collisions.items.iter().copied().filter(|&item| collisions.of(item) > 0.0).collect();
    random.shuffle(&mut colliding);
    for item in colliding {
        if collisions.of(item) <= 0.0 {
            continue;
        }
        let Some(now) = state.poses[item] else { continue };
        let own = [now.sheet];
        // Parts of a group stay together.
        let may = if state.items[item].group.is_some() { &own[..] } else { sheets };
        let (m, n) = (collisions.items.len(), collisions.place[item]);
        let shape = state.shape(item);
        let weights = &collisions.weight[n * m..(n + 1) * m];
        let place = &collisions.place;
        let mut cost = |pose: &Pose, placed: &Placed, bound: f64| {
            work.0 += 4 * placed.points.len() as u64;
            let mut sum = weights[n] * state.rooms[pose.sheet].left(shape, placed, work);
            for &other in &state.on[pose.sheet] {
                if sum > bound {
                    break;
                }
                if other != item && place[other] != usize::MAX {
                    let it = (state.shape(other), &state.placed[other]);
                    sum += weights[place[other]] * collision((shape, placed), it, work);
                }
            }
            work.0 += state.on[pose.sheet].len() as u64;
            sum
        };
        let sought =
            Sought { shape, turns: &state.items[item].turns, sheets: may, rooms: &state.rooms };
        if let Some((pose, _)) = best_place(&sought, Some(now), TRIES, random, &mut cost)
            && pose != now
        {
            state.lay(item, pose);
            collisions.measure(state, item, work);
        }
    }
}
