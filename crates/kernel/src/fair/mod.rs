//! Variational interpolation, \[G14\]: samples move, within limits, so that the surface bends more
//! like a sheet.
//!
//! **The problem** (equation 6). Among the displacements within a [`Limit`], find those with the
//! least price of the cheapest triangulation of the moved boundary; or ([`VaryGoal::Warp`]) the
//! smallest with which no rung has a warp angle above a given one.
//!
//! **The unknowns** are displacements in space. Every sample follows them linearly ([`Motion`]): a
//! sample may be an unknown itself, the copies of a sample on a seam are one unknown, and samples
//! along a curve may follow the control points of a B-spline. Panels are varied together, so their
//! shared samples stay shared, to the bit.
//!
//! **The method.**
//! 1. Triangulate. Hold the triangulation.
//! 2. Descend by projected gradients on the price of that triangulation, a sum over its rungs and
//!    triangles in which tangents turn as the samples beside them move. \[G14\] holds the tangents
//!    of the neighbours; its slopes are then no gradient of a function.
//! 3. Triangulate anew, and take the step only if the true price falls and the total twist does not
//!    rise; else half of it, a quarter, an eighth.
//! 4. Repeat until the price falls no more.
//!
//! For a warp angle, the squares of the excess of warp angles are added to the price with growing
//! weight. When no rung exceeds the angle, bisection lowers the limit for as long as that holds.
//!
//! This finds a local minimum: triangulations are proven optimal, displacements are not.

mod descend;
mod design;
mod limit;
mod motion;
mod outcome;
mod reach;
mod sampling;
mod state;
mod value;

pub use design::{FairCause, FairError, VaryCause};
pub(crate) use design::{Shift, varied_design};
pub use limit::Limit;
pub use motion::{
    Lean, Motion, Share, Slip, control_shares, counted_shares, motions, motions_of_samples,
};
pub use outcome::{Ended, Varied, VariedPanel, VaryError};

use crate::design::VaryGoal;
use descend::{DescentEnd, descend};
#[cfg(test)]
pub(crate) use motion::moved as moved_samples;
use motion::moved_on;
use sheetwright_geometry::boundary::{Boundary, PlaneChoice, SupportingPlane, supporting_plane};
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::cost::{Piece, TwistForm};
use sheetwright_optimum::triangulate::{TriangulateOptions, Triangulation};
use state::{NoState, PanelState, State};
use std::collections::BTreeMap;
use value::PanelValue;

/// Shares of a step that are tried until one makes the true price fall.
const SHARES: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
/// A round that gains less than this share of the price is the last.
const LEAST_GAIN: f64 = 1e-4;
/// Factor of the weight of twist where it would rise, and the largest weight.
const MORE_TWIST: f64 = 10.0;
const MOST_TWIST: f64 = 1000.0;

/// A panel whose samples may move.
#[derive(Clone, Copy, Debug)]
pub struct VaryPanel<'a> {
    /// The boundary as it is given.
    pub boundary: &'a Boundary,
    /// The supporting plane, which is found anew as the samples move.
    pub plane: PlaneChoice,
    /// How it is triangulated and priced.
    pub triangulate: &'a TriangulateOptions,
    /// How its samples follow the unknowns, one motion a sample.
    pub motions: &'a [Motion],
    /// Whether its samples only follow those of the others: its price counts, but the goal's warp
    /// angle does not hold for it.
    pub follows: bool,
}

/// Panels as unknowns move them.
///
/// An implementation decides where samples lie: at held places of the boundary, as for [`vary`], or
/// spread anew over curves that are drawn from the unknowns.
pub trait Moving {
    /// The panels where the unknowns have moved them.
    ///
    /// # Errors
    /// A [`VaryError`] where the moved samples make no panels; [`VaryError::Stopped`] if the watch
    /// stops it.
    fn panels(
        &self,
        unknowns: &[Vec3],
        watch: &mut dyn Watch,
    ) -> Result<Vec<MovingPanel>, VaryError>;
}

/// A panel where the unknowns have moved it.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingPanel {
    /// Its boundary there.
    pub boundary: Boundary,
    /// Its supporting plane there.
    pub plane: Option<SupportingPlane>,
    /// How it is triangulated and priced.
    pub triangulate: TriangulateOptions,
    /// How its samples follow the unknowns from there, one motion a sample.
    pub motions: Vec<Motion>,
    /// See [`VaryPanel::follows`].
    pub follows: bool,
}

/// Panels whose samples are held at their places of the boundary.
struct Held<'a>(&'a [VaryPanel<'a>]);

impl Moving for Held<'_> {
    fn panels(&self, unknowns: &[Vec3], _: &mut dyn Watch) -> Result<Vec<MovingPanel>, VaryError> {
        let moved = |(n, panel): (usize, &VaryPanel<'_>)| {
            let start = panel.boundary.samples();
            let (samples, motions) =
                moved_on(start, panel.motions, unknowns).ok_or(VaryError::Tangent { panel: n })?;
            let loops = panel.boundary.loops().iter().map(|l| samples[l.clone()].to_vec());
            let boundary = Boundary::new(loops.collect())
                .map_err(|error| VaryError::Boundary { panel: n, error })?;
            let plane = supporting_plane(&boundary, panel.plane)
                .map_err(|error| VaryError::Plane { panel: n, error })?;
            let triangulate = panel.triangulate.clone();
            Ok(MovingPanel { boundary, plane, triangulate, motions, follows: panel.follows })
        };
        self.0.iter().enumerate().map(moved).collect()
    }
}

/// Options of a variation.
#[derive(Clone, Debug, PartialEq)]
pub struct VaryOptions {
    /// The goal. Default: the least price.
    pub goal: VaryGoal,
    /// Weight of zig-zag, without unit: the factor of the sum of the squares of the angles
    /// (radians) by which the edges of the boundary turn against one another. Default 0.01: not a
    /// part of the true price, and so small that it decides only between displacements of about
    /// equal price.
    pub fairness: f64,
    /// Limit of the triangulations in one descent. Default 20.
    pub rounds: usize,
    /// Limit of the steps between two triangulations. Default 200.
    pub steps: usize,
    /// Whether a boundary stays as it is if its sampling explains every warp angle, because the
    /// sheet bends by as much from one sample to the next: it is developable already, as far as its
    /// samples tell. Default true.
    pub leave_developable: bool,
}

impl Default for VaryOptions {
    fn default() -> Self {
        Self {
            goal: VaryGoal::Price,
            fairness: 0.01,
            rounds: 20,
            steps: 200,
            leave_developable: true,
        }
    }
}

/// Moves the samples of panels within a limit.
///
/// # Errors
/// See [`VaryError`]: the panels are invalid before they move.
pub fn vary(
    panels: &[VaryPanel<'_>],
    limit: &Limit,
    options: &VaryOptions,
    watch: &mut dyn Watch,
) -> Result<Varied, VaryError> {
    refuse(panels, limit)?;
    vary_moving(&Held(panels), &[], limit, options, watch)
}

/// Moves panels within a limit; `moving` decides where their samples lie. `known` are displacements
/// to go on from if, projected on the limit, they are better than none; empty if there are none.
///
/// # Errors
/// See [`VaryError`]: the panels are invalid before they move.
///
/// # Panics
/// If a motion follows an unknown that the limit does not have, or some but not all displacements
/// are known.
pub fn vary_moving(
    moving: &dyn Moving,
    known: &[Vec3],
    limit: &Limit,
    options: &VaryOptions,
    watch: &mut dyn Watch,
) -> Result<Varied, VaryError> {
    refuse_options(limit, options)?;
    let start = match State::new(moving, vec![Vec3::ZERO; limit.len()], None, watch) {
        Ok(state) => state,
        Err(NoState::Refused(error)) => return Err(error),
        Err(NoState::Stopped) => return Err(VaryError::Stopped),
    };
    let within = match options.goal {
        VaryGoal::Price | VaryGoal::Strain { .. } => start.price == 0.0,
        VaryGoal::Warp { largest } => start.warp_asked() <= largest,
    };
    let warp_max_before = start.warp_max();
    let before: Vec<Boundary> = start.panels.iter().map(|p| p.boundary.clone()).collect();
    let before_asked = start.warp_asked();
    let mut way = Way { moving, options, prices: vec![start.price], twists: vec![start.twist] };
    let (state, ended) = if within
        || (options.leave_developable && start.panels.iter().all(sampling::explains))
    {
        (start, Ended::NothingToDo)
    } else {
        let start = going_on(&mut way, start, known, limit, watch);
        match options.goal {
            VaryGoal::Price | VaryGoal::Strain { .. } => least_price(&mut way, start, limit, watch),
            VaryGoal::Warp { largest } => {
                let angles = [largest, before_asked];
                reach::reach(&mut way, start, limit, angles, watch)
            }
        }
    };
    Ok(varied(&before, state, ended, way, warp_max_before))
}

/// The state at known displacements, if it is better than the start.
fn going_on(
    way: &mut Way<'_>,
    start: State,
    known: &[Vec3],
    limit: &Limit,
    watch: &dyn Watch,
) -> State {
    if known.is_empty() {
        return start;
    }
    let mut known = known.to_vec();
    limit.project(&mut known);
    let Ok(state) = State::new(way.moving, known, Some(&start), watch) else { return start };
    let is_better = match way.options.goal {
        VaryGoal::Price | VaryGoal::Strain { .. } => {
            state.price < start.price && state.twist <= start.twist
        }
        VaryGoal::Warp { .. } => state.warp_asked() < start.warp_asked(),
    };
    if is_better {
        way.note(&state);
        return state;
    }
    start
}

/// The given data of a variation, and its history.
struct Way<'a> {
    moving: &'a dyn Moving,
    options: &'a VaryOptions,
    prices: Vec<f64>,
    twists: Vec<f64>,
}

impl Way<'_> {
    fn note(&mut self, state: &State) {
        self.prices.push(state.price);
        self.twists.push(state.twist);
    }

    /// Descends from a state with its triangulations held.
    fn descend(
        &self,
        state: &State,
        limit: &Limit,
        (weights, steps): (Weights, usize),
        watch: &dyn Watch,
    ) -> descend::Descent {
        let base = &state.unknowns;
        let held: Vec<PanelValue<'_>> =
            state.panels.iter().map(|panel| PanelValue::new(panel, base)).collect();
        let mut value = |at: &[Vec3], slopes: &mut [Vec3]| {
            slopes.fill(Vec3::ZERO);
            held.iter().map(|panel| panel.add(&weights, at, slopes)).sum()
        };
        let stop = || watch.stop();
        descend(&state.unknowns, limit, steps, &mut value, &stop)
    }

    /// The first accepted state between `state` and `target`, by the shares of [`SHARES`].
    fn first_accepted(
        &self,
        state: &State,
        target: &[Vec3],
        accepted: impl Fn(&State) -> bool,
        watch: &dyn Watch,
    ) -> Result<Option<State>, NoState> {
        for share in SHARES {
            let between = |(from, to): (&Vec3, &Vec3)| *from + (*to - *from) * share;
            let unknowns = state.unknowns.iter().zip(target).map(between).collect();
            match State::new(self.moving, unknowns, Some(state), watch) {
                Ok(next) if accepted(&next) => return Ok(Some(next)),
                // A boundary that touches itself, or has no triangulation: try a shorter step.
                Ok(_) | Err(NoState::Refused(_)) => {}
                Err(NoState::Stopped) => return Err(NoState::Stopped),
            }
        }
        Ok(None)
    }
}

fn refuse_options(limit: &Limit, options: &VaryOptions) -> Result<(), VaryError> {
    let goal_is_angle = match options.goal {
        VaryGoal::Price => true,
        // It takes an elastic sheet: `make` looks for the angle that it comes to.
        VaryGoal::Strain { .. } => false,
        VaryGoal::Warp { largest } => largest.is_finite() && largest > 0.0,
    };
    let fair = options.fairness.is_finite() && options.fairness >= 0.0;
    if limit.is_valid() && goal_is_angle && fair { Ok(()) } else { Err(VaryError::Limit) }
}

fn refuse(panels: &[VaryPanel<'_>], limit: &Limit) -> Result<(), VaryError> {
    for (n, panel) in panels.iter().enumerate() {
        if panel.motions.len() != panel.boundary.len() {
            return Err(VaryError::Motions { panel: n });
        }
        if panel.triangulate.price.form == TwistForm::Printed {
            return Err(VaryError::PrintedTwist { panel: n });
        }
        let unknown = |motion: &Motion| {
            let leans = [&motion.tangent_in, &motion.tangent_out];
            let shares = leans.into_iter().flat_map(|lean| &lean.shares);
            shares.chain(&motion.position).any(|share| share.unknown >= limit.len())
        };
        if let Some(sample) = panel.motions.iter().position(unknown) {
            return Err(VaryError::Unknown { panel: n, sample });
        }
    }
    Ok(())
}

/// Equation (6): alternates descents and triangulations while the true price falls.
fn least_price(
    way: &mut Way<'_>,
    start: State,
    limit: &Limit,
    watch: &mut dyn Watch,
) -> (State, Ended) {
    let mut state = start;
    // With a fold price, folds may fall while twist rises, which is not allowed: then the weight of
    // twist in the descent grows.
    let mut twist = 1.0;
    let rounds = way.options.rounds;
    for round in 0..rounds {
        watch.progress(round as f64 / rounds as f64);
        let fairness = way.options.fairness;
        let weights = Weights { goal: VaryGoal::Price, excess: 0.0, twist, fairness };
        let descent = way.descend(&state, limit, (weights, way.options.steps), watch);
        if descent.end == DescentEnd::Stopped {
            return (state, Ended::Stopped);
        }
        if descent.value >= descent.first_value {
            return (state, Ended::Converged);
        }
        let accepted = |next: &State| next.price < state.price && next.twist <= state.twist;
        match way.first_accepted(&state, &descent.point, accepted, watch) {
            Err(_) => return (state, Ended::Stopped),
            Ok(None) if twist < MOST_TWIST => twist *= MORE_TWIST,
            Ok(None) => return (state, Ended::NoGain),
            Ok(Some(next)) => {
                let gain = state.price - next.price;
                state = next;
                way.note(&state);
                if gain <= LEAST_GAIN * state.price {
                    return (state, Ended::Converged);
                }
            }
        }
    }
    (state, Ended::Rounds)
}

fn varied(
    before: &[Boundary],
    state: State,
    ended: Ended,
    way: Way<'_>,
    warp_max_before: f64,
) -> Varied {
    let warp_max = state.warp_max();
    let mut by_place = BTreeMap::new();
    let of_panel = |(before, now): (&Boundary, PanelState)| {
        let samples = before.samples().iter().zip(now.boundary.samples());
        let moved_mm: Vec<f64> = samples
            .map(|(from, to)| {
                let moved = from.position.distance(to.position);
                let place = [from.position.x, from.position.y, from.position.z].map(f64::to_bits);
                let farthest = by_place.entry(place).or_insert(moved);
                *farthest = moved.max(*farthest);
                moved
            })
            .collect();
        let count = now.warps.len().max(1) as f64;
        VariedPanel {
            boundary: now.boundary,
            plane: now.plane,
            triangulation: now.triangulation,
            moved_mm,
            warp_max: now.warps.iter().copied().fold(0.0, f64::max),
            warp_mean: now.warps.iter().sum::<f64>() / count,
        }
    };
    let panels: Vec<VariedPanel> = before.iter().zip(state.panels).map(of_panel).collect();
    Varied {
        panels,
        displacements: state.unknowns,
        ended,
        prices: way.prices,
        twists: way.twists,
        warp_max_before,
        warp_max,
        moved_max_mm: by_place.values().copied().fold(0.0, f64::max),
        moved_total_mm: by_place.values().sum(),
    }
}

/// Weights of the value that is minimised while a triangulation is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// The goal.
    pub goal: VaryGoal,
    /// Weight of the squared excess of warp angles above the goal's, radians², beside the price.
    pub excess: f64,
    /// Weight of twist; 1 as in the price.
    pub twist: f64,
    /// See [`VaryOptions::fairness`].
    pub fairness: f64,
}

/// A value for a triangulation that is held, and its slopes.
#[derive(Clone, Debug, PartialEq)]
pub struct Sloped {
    /// The value, without unit: Π without the rounding of prices, and the other weighted terms.
    pub value: f64,
    /// Its derivative by each unknown, per mm.
    pub slopes: Vec<Vec3>,
    /// Which piece of its price is active on each rung, and whether its warp angle is above the
    /// goal's; where one changes, the value has a kink.
    pub pieces: Vec<(Piece, bool)>,
}

/// The value that is minimised, for a panel with its triangulation held and its samples moved by
/// the unknowns. `None` where a tangent has lost its direction.
///
/// # Panics
/// If a motion follows an unknown that is not among `unknowns`.
pub fn sloped(
    panel: &VaryPanel<'_>,
    plane: Option<&SupportingPlane>,
    triangulation: &Triangulation,
    weights: &Weights,
    unknowns: &[Vec3],
) -> Option<Sloped> {
    let here = PanelState::held(panel, plane, triangulation);
    let base = vec![Vec3::ZERO; unknowns.len()];
    let held = PanelValue::new(&here, &base);
    let mut slopes = vec![Vec3::ZERO; unknowns.len()];
    let value = held.add(weights, unknowns, &mut slopes);
    Some(Sloped { value, slopes, pieces: held.pieces(weights.goal, unknowns)? })
}
