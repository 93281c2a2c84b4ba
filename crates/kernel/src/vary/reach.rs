//! The target form: no warp angle above a given one, by small displacements.

use super::descend::DescentEnd;
use super::state::State;
use super::{Ended, Goal, Limit, Way};
use crate::math::Vec3;
use crate::watch::Watch;

/// Descents aim this share below the angle, so that squares of excess, which press less the less is
/// left, come below it.
const AIM: f64 = 0.98;
/// What excess counts beside the price at first, and how much more from round to round: a rung a
/// tenth of a radian too far counts like its own price, then like that of its panel.
const FIRST_WEIGHT: f64 = 10.0;
const HEAVIER: f64 = 10.0;
const HEAVIEST: f64 = 1e6;
/// The displacements are as small as they get when the bisection is within this share of them.
const CLOSE_ENOUGH: f64 = 0.03;
/// Bisections of the limit at the most.
const BISECTIONS: usize = 8;
/// Rounds of each bisection.
const ROUNDS_DRAWN_IN: usize = 4;

/// How an attempt to come below the angle ended.
enum Attempt {
    Within,
    Above,
    Stopped,
}

/// Brings every warp angle to `largest` or below, then draws the limit in while that can be kept.
pub(super) fn reach(
    way: &mut Way<'_>,
    start: State,
    limit: &Limit,
    largest: f64,
    watch: &mut dyn Watch,
) -> (State, Ended) {
    let goal = Goal::Warp { largest };
    let rounds = way.options.rounds;
    let (mut state, attempt) = come_below(way, start.clone(), limit, goal, rounds, watch);
    match attempt {
        Attempt::Stopped => return (state, Ended::Stopped),
        Attempt::Above => {
            let reached = state.warp_max();
            let resisting = state.above(largest);
            return (state, Ended::Closest { wanted: largest, reached, resisting });
        }
        Attempt::Within => {}
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
        let Ok(from) = State::new(way.panels, unknowns, Some(&state), watch) else {
            too_small = share;
            continue;
        };
        match come_below(way, from, &drawn_in, goal, ROUNDS_DRAWN_IN, watch) {
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

/// Descends with growing weight of the excess until no warp angle is above the goal's; takes a step
/// only if the true excess falls.
fn come_below(
    way: &mut Way<'_>,
    start: State,
    limit: &Limit,
    goal: Goal,
    rounds: usize,
    watch: &mut dyn Watch,
) -> (State, Attempt) {
    let Goal::Warp { largest } = goal else { return (start, Attempt::Within) };
    let aim = Goal::Warp { largest: AIM * largest };
    let mut weight = FIRST_WEIGHT;
    let mut state = start;
    for _ in 0..rounds {
        if state.warp_max() <= largest {
            return (state, Attempt::Within);
        }
        let descent = way.descend(&state, limit, aim, weight, watch);
        if descent.end == DescentEnd::Stopped {
            return (state, Attempt::Stopped);
        }
        let before = state.excess(goal);
        let accepted = |next: &State| next.excess(goal) < before;
        match way.first_accepted(&state, &descent.point, accepted, watch) {
            Err(_) => return (state, Attempt::Stopped),
            Ok(Some(next)) => state = next,
            Ok(None) if weight >= HEAVIEST => break,
            Ok(None) => {}
        }
        weight = (weight * HEAVIER).min(HEAVIEST);
    }
    let attempt = if state.warp_max() <= largest { Attempt::Within } else { Attempt::Above };
    (state, attempt)
}
