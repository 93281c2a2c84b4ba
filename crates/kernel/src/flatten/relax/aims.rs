//! The aims where lengths cannot all be true: least mean error, least largest error, or least
//! squares with a true border. The first two begin with the least squares, which a step or two
//! reach.

use super::guard::Guard;
use super::springs::{Form, factored, guarded_by};
use super::{Aim, Ended, Inner, RelaxError};
use sheetwright_geometry::math::ln;
use sheetwright_geometry::math::sparse::Plan;
use sheetwright_geometry::watch::Watch;

/// Errors below this are those of rounding: lengths of 16 digits, sides a ten-thousandth of the
/// size.
const TRUE: f64 = 1e-12;
/// The most last steps that make the border true; each squares the error, or nearly.
const MOST_LAST: usize = 10;
/// Least squares end when a step lowers them by less than this share.
const SQUARES_GAIN: f64 = 1e-3;
/// The mean is at its least when a step lowers it by less than this share.
const MEAN_GAIN: f64 = 5e-4;
/// Errors are weighed by their squares below this share of their median, by themselves above: where
/// it is lower the mean gets no lower that one could see, and steps get shorter.
const MEAN_ROUND: f64 = 0.01;
/// The largest error ends within this share of the least that it can be near there.
const MAX_GAP: f64 = 0.01;
/// The factor by which each round divides that gap.
const MAX_PACE: f64 = 4.0;
/// The most steps of a round; two mostly do.
const MAX_ROUND: usize = 6;
/// How much stiffer edges of the border are than other sides, at first and at last: what a step
/// leaves of their errors is about one part in so many, but steps along a bent border are short
/// while they are stiff.
const STIFF: [f64; 2] = [10.0, 1e5];
/// The factor by which they get stiffer from step to step, once the form has nearly settled.
const STIFFENING: f64 = 10.0;
/// The border is stiffened when a step changes the squares by less than this share.
const SETTLED: f64 = 0.1;

/// A run towards an aim: its mesh, its plan of elimination and its steps.
pub(super) struct Run<'a> {
    pub inner: &'a Inner<'a>,
    pub plan: &'a Plan<2>,
    pub most_steps: usize,
    pub steps: usize,
}

/// How often steps are taken, about, before an aim is reached: for showing progress.
const USUAL_STEPS: f64 = 20.0;

impl Run<'_> {
    /// Why no other step may be taken, if so; else counts it.
    fn over(&mut self, watch: &mut dyn Watch) -> Option<Ended> {
        if watch.stop() {
            return Some(Ended::Stopped);
        }
        if self.steps == self.most_steps {
            return Some(Ended::OutOfSteps);
        }
        self.steps += 1;
        watch.progress((self.steps as f64 / USUAL_STEPS).min(0.99));
        None
    }

    /// The form that an aim asks for, and how the way there ended.
    pub(super) fn towards(
        &mut self,
        aim: Aim,
        form: Form,
        watch: &mut dyn Watch,
    ) -> Result<(Form, Ended), RelaxError> {
        // The first form has a border that is nearly true: best left so where it shall be.
        if aim == Aim::Seams {
            return self.true_border(form, watch);
        }
        let (form, ended) = self.least_squares(form, watch)?;
        if ended != Ended::Least {
            return Ok((form, ended));
        }
        if aim == Aim::Mean {
            self.least_mean(form, watch)
        } else {
            self.least_largest(form, watch)
        }
    }

    fn least_squares(
        &mut self,
        mut form: Form,
        watch: &mut dyn Watch,
    ) -> Result<(Form, Ended), RelaxError> {
        let squares = |errors: &[f64]| 0.5 * errors.iter().map(|r| r * r).sum::<f64>();
        loop {
            if let Some(ended) = self.over(watch) {
                return Ok((form, ended));
            }
            let before = squares(&form.errors);
            let step = form.least_squares_step(self.inner, self.plan, |_| 1.0, |_| 0.0, squares)?;
            let Some(next) = step else {
                // Rounding stands in the way of a step, or the surface itself does.
                let ended = if form.largest() < 1e3 * TRUE { Ended::True } else { Ended::Least };
                return Ok((form, ended));
            };
            form = next;
            if form.largest() < TRUE {
                return Ok((form, Ended::True));
            }
            if squares(&form.errors) > (1.0 - SQUARES_GAIN) * before {
                return Ok((form, Ended::Least));
            }
        }
    }

    /// Least Σ |r|: squares with weights 1/|r| again and again \[Daubechies2010\], the weights
    /// rounded off near 0, less and less.
    fn least_mean(
        &mut self,
        mut form: Form,
        watch: &mut dyn Watch,
    ) -> Result<(Form, Ended), RelaxError> {
        let mut sizes: Vec<f64> = form.errors.iter().map(|r| r.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let median = sizes[sizes.len() / 2].max(TRUE);
        let mut round = median;
        loop {
            if let Some(ended) = self.over(watch) {
                return Ok((form, ended));
            }
            let goal = |errors: &[f64]| -> f64 {
                let cost = |r: &f64| {
                    let size = r.abs();
                    if size > round { size } else { 0.5 * (size * size / round + round) }
                };
                errors.iter().map(cost).sum()
            };
            let weights: Vec<f64> = form.errors.iter().map(|r| 1.0 / r.abs().max(round)).collect();
            let weight = |n: usize| weights[n];
            let before = form.mean();
            let step = form.least_squares_step(self.inner, self.plan, weight, |_| 0.0, goal)?;
            let least = round <= MEAN_ROUND * median;
            let Some(next) = step else { return Ok((form, Ended::Least)) };
            if least && next.mean() > (1.0 - MEAN_GAIN) * before {
                let best = if next.mean() < before { next } else { form };
                return Ok((best, Ended::Least));
            }
            form = next;
            round = (0.5 * round).max(MEAN_ROUND * median);
        }
    }

    /// Least t with |r| ≤ t for all sides: Newton's method on τ·t − Σ log(t² − r²) with τ growing
    /// \[BoydVandenberghe2004, chapter 11\]. Where that is least, t is within 2m/τ of its least for
    /// m sides (of the problem made linear there).
    fn least_largest(
        &mut self,
        mut form: Form,
        watch: &mut dyn Watch,
    ) -> Result<(Form, Ended), RelaxError> {
        let sides = form.errors.len() as f64;
        let mut best = form.clone();
        let mut t = 1.1 * form.largest();
        let mut tau: f64 = form.errors.iter().map(|r| 2.0 * t / (t * t - r * r)).sum();
        let mut round = 0;
        loop {
            if let Some(ended) = self.over(watch) {
                return Ok((best, ended));
            }
            // Derivatives of the barrier of a side: by r, twice by r, by r and t; h twice by t.
            let slope_r = |r: f64| 2.0 * r / ((t - r) * (t + r));
            let (near, far) =
                (|r: f64| 1.0 / ((t - r) * (t - r)), |r: f64| 1.0 / ((t + r) * (t + r)));
            let errors = &form.errors;
            let bend = |n: usize| near(errors[n]) + far(errors[n]);
            let mixed = |n: usize| far(errors[n]) - near(errors[n]);
            let guard = Guard::new(self.inner, &form.points, guarded_by(&form, bend));
            let mut matrix = form.stiffness(self.inner, self.plan, bend);
            guard.add_to(self.inner, &mut matrix);
            let Some(factor) = factored(&matrix)? else { return Ok((best, Ended::Least)) };
            let mut by_r = form.pulled(self.inner, |n| slope_r(errors[n]));
            guard.add_pulls(self.inner, &mut by_r);
            let by_t = form.pulled(self.inner, mixed);
            let [u, v] = factor.solve([&by_r, &by_t]);
            let (along_u, along_v) = (form.changes(self.inner, &u), form.changes(self.inner, &v));
            let mut slope_t = tau;
            let (mut h, mut mixed_u, mut mixed_v) = (0.0, 0.0, 0.0);
            for (n, &r) in errors.iter().enumerate() {
                slope_t -= 2.0 * t / ((t - r) * (t + r));
                h += bend(n);
                mixed_u += mixed(n) * along_u[n];
                mixed_v += mixed(n) * along_v[n];
            }
            let dt = -(slope_t + mixed_u) / (h + mixed_v);
            let step: Vec<[f64; 2]> =
                u.iter().zip(&v).map(|(u, v)| [u[0] + dt * v[0], u[1] + dt * v[1]]).collect();
            let mut slope = slope_t * dt;
            for (n, &r) in errors.iter().enumerate() {
                slope += slope_r(r) * (along_u[n] + dt * along_v[n]);
            }
            let goal = |errors: &[f64], share: f64| {
                let t = t + share * dt;
                if errors.iter().any(|r| r.abs() >= t) {
                    return f64::INFINITY;
                }
                tau * t - errors.iter().map(|r| ln((t - r) * (t + r))).sum::<f64>()
            };
            let moved = form.stepped(self.inner, &guard, &step, slope, goal);
            round += 1;
            // Near enough to the middle of the barrier, or as near as numbers go.
            let centred = -(slope + guard.slope(self.inner, &step)) < 1.0
                || moved.is_none()
                || round == MAX_ROUND;
            if let Some((next, share)) = moved {
                t += share * dt;
                form = next;
                if form.largest() < best.largest() {
                    best = form.clone();
                }
            }
            if centred {
                if 2.0 * sides / tau < MAX_GAP * t {
                    return Ok((best, Ended::Least));
                }
                (tau, round) = (tau * MAX_PACE, 0);
            }
        }
    }

    /// Least squares of the inner sides with true edges of the border: these are stiff springs,
    /// whose errors are added to what is asked of them (the method of multipliers
    /// \[Bertsekas1982\]) until none are left.
    fn true_border(
        &mut self,
        mut form: Form,
        watch: &mut dyn Watch,
    ) -> Result<(Form, Ended), RelaxError> {
        let on_border: Vec<bool> =
            self.inner.topology.edges().iter().map(|edge| edge.is_border()).collect();
        let border_largest = |form: &Form| {
            let errors = form.errors.iter().zip(&on_border);
            errors.filter(|(_, on)| **on).fold(0.0, |most: f64, (r, _)| most.max(r.abs()))
        };
        let rest = |form: &Form| -> f64 {
            let errors = form.errors.iter().zip(&on_border);
            errors.filter(|(_, on)| !**on).map(|(r, _)| r * r).sum()
        };
        let [mut stiff, stiffest] = STIFF;
        let mut shifts = vec![0.0; form.errors.len()];
        let mut idle = 0;
        loop {
            if let Some(ended) = self.over(watch) {
                return Ok((form, ended));
            }
            let weight = |n: usize| if on_border[n] { stiff } else { 1.0 };
            let goal = |errors: &[f64]| -> f64 {
                let terms = errors.iter().zip(&shifts).enumerate();
                0.5 * terms.map(|(n, (r, s))| weight(n) * (r + s) * (r + s)).sum::<f64>()
            };
            let shift = |n: usize| shifts[n];
            let step = form.least_squares_step(self.inner, self.plan, weight, shift, goal)?;
            let (before, rest_before) = (border_largest(&form), rest(&form));
            let stuck = step.is_none();
            if let Some(next) = step {
                form = next;
            }
            if form.largest() < TRUE {
                return Ok((form, Ended::True));
            }
            let now = border_largest(&form);
            let change = (rest(&form) - rest_before).abs();
            if !stuck {
                for (n, shift) in shifts.iter_mut().enumerate().filter(|(n, _)| on_border[*n]) {
                    *shift += form.errors[n];
                }
            }
            if stiff < stiffest {
                if stuck || change <= SETTLED * rest_before {
                    stiff *= STIFFENING;
                    // Shifts shrink as springs stiffen, so that the pulls stay what they were.
                    shifts.iter_mut().for_each(|shift| *shift /= STIFFENING);
                }
                continue;
            }
            // As true as rounding lets it be, or as steps with an eye on the rest make it.
            idle = if now < 0.5 * before { 0 } else { idle + 1 };
            if (change <= SQUARES_GAIN * rest_before && now < TRUE) || idle == 3 {
                break;
            }
        }
        // What is still missing is made up for the border alone: Newton's method on its lengths.
        let weight = |n: usize| if on_border[n] { stiff } else { 1.0 };
        for _ in 0..MOST_LAST {
            if border_largest(&form) < TRUE {
                break;
            }
            if let Some(ended) = self.over(watch) {
                return Ok((form, ended));
            }
            let errors = form.errors.clone();
            let shift = |n: usize| if on_border[n] { 0.0 } else { -errors[n] };
            let goal = |errors: &[f64]| -> f64 {
                let border = errors.iter().zip(&on_border).filter(|(_, on)| **on);
                0.5 * stiff * border.map(|(r, _)| r * r).sum::<f64>()
            };
            let step = form.least_squares_step(self.inner, self.plan, weight, shift, goal)?;
            let Some(next) = step else { break };
            form = next;
        }
        let ended = if form.largest() < 1e3 * TRUE { Ended::True } else { Ended::Least };
        Ok((form, ended))
    }
}
