//! Spectral projected gradient, \[BMR00\]: the length of a step comes from the last change of the
//! slopes (Barzilai and Borwein). The step is projected on the limits, and along it the value must
//! fall below the largest of the last few.

use super::limit::Limit;
use sheetwright_geometry::math::Vec3;

/// How many values back a step is compared with.
const MEMORY: usize = 8;
/// The share of the fall predicted by the slopes that a step must achieve (Armijo).
const KEPT: f64 = 1e-4;
/// How often a step is shortened.
const SHORTENED: usize = 25;
/// No step before projection moves an unknown by more than this many times its limit: beyond,
/// projections lose digits.
const LONGEST_MOVE: f64 = 1e3;
/// The first step moves the farthest unknown by this share of its limit.
const FIRST_MOVE: f64 = 0.01;
/// A step below this share of the limit counts as none.
const NO_MOVE: f64 = 1e-9;

/// A descent ends when this many steps,
const PATIENCE: usize = 20;
/// together, have lowered the best value by less than this share of it: a new triangulation gains
/// more.
const LEAST_FALL: f64 = 1e-4;

/// How a descent ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DescentEnd {
    /// No direction within the limits lowers the value any more beyond rounding, or none was found.
    Converged,
    /// All steps are used.
    Steps,
    /// The watch stopped it.
    Stopped,
}

/// The best point of a descent.
pub(super) struct Descent {
    pub(super) point: Vec<Vec3>,
    pub(super) value: f64,
    pub(super) first_value: f64,
    pub(super) end: DescentEnd,
}

/// Descends from `start`, which is within the limit, by at most so many steps. `value` gives the
/// value at a point and fills in its slopes; it is infinite at impossible points.
pub(super) fn descend(
    start: &[Vec3],
    limit: &Limit,
    steps: usize,
    value: &mut dyn FnMut(&[Vec3], &mut [Vec3]) -> f64,
    stop: &dyn Fn() -> bool,
) -> Descent {
    let count = start.len();
    let mut at = start.to_vec();
    let mut slopes = vec![Vec3::ZERO; count];
    let mut here = value(&at, &mut slopes);
    let first_value = here;
    let mut best = (here, at.clone());
    let reach = limit.farthest_mm();
    let steepest = farthest(&slopes);
    let ended =
        |best: (f64, Vec<Vec3>), end| Descent { value: best.0, point: best.1, first_value, end };
    if !(steepest > 0.0 && reach > 0.0 && here.is_finite()) {
        return ended(best, DescentEnd::Converged);
    }
    let mut length = FIRST_MOVE * reach / steepest;
    let mut recent = vec![here];
    let mut direction = vec![Vec3::ZERO; count];
    let mut trial = at.clone();
    let mut trial_slopes = slopes.clone();
    let mut milestone = here;
    for step in 1..=steps {
        if stop() {
            return ended(best, DescentEnd::Stopped);
        }
        for n in 0..count {
            direction[n] = at[n] - slopes[n] * length;
        }
        limit.project(&mut direction);
        for n in 0..count {
            direction[n] -= at[n];
        }
        let promised = dot(&slopes, &direction);
        if farthest(&direction) <= NO_MOVE * reach || promised >= 0.0 {
            return ended(best, DescentEnd::Converged);
        }
        let bar = recent.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut share = 1.0;
        let mut found = None;
        for _ in 0..SHORTENED {
            for n in 0..count {
                trial[n] = at[n] + direction[n] * share;
            }
            let there = value(&trial, &mut trial_slopes);
            if there <= bar + KEPT * share * promised {
                found = Some(there);
                break;
            }
            // The minimum of the parabola through both values, kept within bounds.
            let curved = there - here - share * promised;
            let least = -0.5 * promised * share * share / curved;
            let within = least.is_finite() && least > 0.1 * share && least < 0.5 * share;
            share = if within { least } else { 0.5 * share };
        }
        let Some(there) = found else { return ended(best, DescentEnd::Converged) };
        let (mut moved, mut turned) = (0.0, 0.0);
        for n in 0..count {
            let step = trial[n] - at[n];
            moved += step.length_squared();
            turned += step.dot(trial_slopes[n] - slopes[n]);
        }
        std::mem::swap(&mut at, &mut trial);
        std::mem::swap(&mut slopes, &mut trial_slopes);
        let steepest = farthest(&slopes);
        if steepest == 0.0 {
            return ended(if there < best.0 { (there, at) } else { best }, DescentEnd::Converged);
        }
        let longest = LONGEST_MOVE * reach / steepest;
        length = if turned > 0.0 { (moved / turned).min(longest) } else { longest };
        here = there;
        if here < best.0 {
            best = (here, at.clone());
        }
        if recent.len() == MEMORY {
            recent.remove(0);
        }
        recent.push(here);
        if step % PATIENCE == 0 {
            if milestone - best.0 <= LEAST_FALL * best.0.abs() {
                return ended(best, DescentEnd::Converged);
            }
            milestone = best.0;
        }
    }
    ended(best, DescentEnd::Steps)
}

fn dot(a: &[Vec3], b: &[Vec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

/// The length of the longest.
fn farthest(list: &[Vec3]) -> f64 {
    list.iter().map(|way| way.length()).fold(0.0, f64::max)
}
