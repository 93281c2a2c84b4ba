//! The goal of a warp angle: no rung above it, by small displacements.

use super::descend::DescentEnd;
use super::state::{NoState, State};
use super::{Ended, Limit, Way, Weights};
use crate::design::VaryGoal;
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;

/// Descents aim at this share of the angle, since the squares of the excess lose their effect near
/// the aim.
const AIM: f64 = 0.98;
/// First weight of the excess beside the price, about that of twist; its factor when a weight helps
/// no further; and the largest weight, with which a rung a hundredth of a degree too far outweighs
/// most panels.
const FIRST_WEIGHT: f64 = 1.0;
const HEAVIER: f64 = 10.0;
const HEAVIEST: f64 = 1e6;
/// A round that gains less than this share is the last with its weight.
const WORTH_ANOTHER: f64 = 0.2;
/// The bisection of the limit ends within this share.
const CLOSE_ENOUGH: f64 = 0.05;
/// Most bisections of the limit.
const BISECTIONS: usize = 8;
/// Rounds of each bisection.
const ROUNDS_DRAWN_IN: usize = 4;
/// Divisor of the steps there: the start is near the goal.
const STEPS_DRAWN_IN: usize = 4;
/// First weight of the excess while the limit is lowered: with less weight, a state near the angle
/// would move away from it.
const WEIGHT_DRAWN_IN: f64 = 10.0;

/// How an attempt to come below the angle ended.
enum Attempt {
    Within,
    Above,
    Stopped,
}

/// Brings every warp angle to `largest` or below, then lowers the limit while that holds. The two
/// angles are this one and the largest before any move.
pub(super) fn reach(
    way: &mut Way<'_>,
    start: State,
    limit: &Limit,
    [largest, before]: [f64; 2],
    watch: &mut dyn Watch,
) -> (State, Ended) {
    let goal = VaryGoal::Warp { largest };
    let (rounds, steps) = (way.options.rounds, way.options.steps);
    let patient = Effort { weight: FIRST_WEIGHT, rounds, steps, patient: true };
    let (mut state, attempt) = come_below(way, start, limit, goal, patient, watch);
    match attempt {
        Attempt::Stopped => return (state, Ended::Stopped),
        Attempt::Above => {
            let reached = state.warp_asked();
            let resisting = state.above(largest);
            return (state, Ended::Closest { wanted: largest, before, reached, resisting });
        }
        Attempt::Within => way.note(&state),
    }
    let (mut too_small, mut enough) = (0.0, limit.used(&state.unknowns));
    for bisection in 0..BISECTIONS {
        watch.progress(0.5 + 0.5 * bisection as f64 / BISECTIONS as f64);
        if enough - too_small <= CLOSE_ENOUGH * enough {
            break;
        }
        let share = 0.5 * (too_small + enough);
        let drawn_in = limit.scaled(share);
        let mut unknowns: Vec<Vec3> = state.unknowns.clone();
        drawn_in.project(&mut unknowns);
        let from = match State::new(way.moving, unknowns, Some(&state), watch) {
            Ok(from) => from,
            Err(NoState::Stopped) => return (state, Ended::Stopped),
            Err(NoState::Refused(_)) => {
                too_small = share;
                continue;
            }
        };
        let brief = Effort {
            weight: WEIGHT_DRAWN_IN,
            rounds: ROUNDS_DRAWN_IN,
            steps: steps.div_ceil(STEPS_DRAWN_IN),
            patient: false,
        };
        match come_below(way, from, &drawn_in, goal, brief, watch) {
            (next, Attempt::Within) => {
                enough = limit.used(&next.unknowns).min(share);
                state = next;
                way.note(&state);
            }
            (_, Attempt::Above) => too_small = share,
            (_, Attempt::Stopped) => return (state, Ended::Stopped),
        }
    }
    (state, Ended::Reached)
}

/// The limits of an attempt.
#[derive(Clone, Copy)]
struct Effort {
    /// First weight of the excess.
    weight: f64,
    /// Limit of the descents.
    rounds: usize,
    /// Limit of the steps of each.
    steps: usize,
    /// Whether more weight is tried where a descent is not accepted.
    patient: bool,
}

/// Descends with a weight of the excess that grows from the given one until no warp angle is above
/// the goal's; takes a step only if the true price with the weighted excess falls. Where the goal
/// is not reached, the nearest state is kept, which may be the start.
fn come_below(
    way: &Way<'_>,
    start: State,
    limit: &Limit,
    goal: VaryGoal,
    Effort { mut weight, rounds, steps, patient }: Effort,
    watch: &dyn Watch,
) -> (State, Attempt) {
    let VaryGoal::Warp { largest } = goal else { return (start, Attempt::Within) };
    let aim = VaryGoal::Warp { largest: AIM * largest };
    let mut nearest = start.clone();
    let mut state = start;
    for _ in 0..rounds {
        if state.warp_asked() <= largest {
            return (state, Attempt::Within);
        }
        let fairness = way.options.fairness;
        let weights = Weights { goal: aim, excess: weight, twist: 1.0, fairness };
        let descent = way.descend(&state, limit, (weights, steps), watch);
        if descent.end == DescentEnd::Stopped {
            return (nearest, Attempt::Stopped);
        }
        let merit = |state: &State| state.price + weight * state.excess(aim);
        let before = merit(&state);
        let accepted = |next: &State| merit(next) < before;
        let (gained, stuck) = match way.first_accepted(&state, &descent.point, accepted, watch) {
            Err(_) => return (nearest, Attempt::Stopped),
            Ok(None) => (0.0, !patient || weight >= HEAVIEST),
            Ok(Some(next)) => {
                let gained = before - merit(&next);
                state = next;
                (gained, false)
            }
        };
        if state.warp_asked() < nearest.warp_asked() {
            nearest = state.clone();
        }
        if stuck {
            break;
        }
        if gained < WORTH_ANOTHER * before {
            weight = (weight * HEAVIER).min(HEAVIEST);
        }
    }
    if state.warp_asked() <= largest {
        return (state, Attempt::Within);
    }
    (nearest, Attempt::Above)
}
