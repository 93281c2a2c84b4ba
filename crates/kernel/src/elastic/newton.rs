//! The least energy of a sheet whose border is held, by Newton's method.
//!
//! Far from rest the whole curvature of the energy may have no inverse that leads down, since what
//! is pressed may buckle. So steps begin with the compression left out of it, with which it is
//! positive in every direction, and take it whole once that is positive. Where it is not, they take
//! as large a share of the compression as leaves it positive, by halves: without any, a sheet that
//! buckles creeps. Steps are shortened until the energy falls. A place of rest at which the whole
//! curvature is not positive is a pass, not a valley: the way down from there is the direction of
//! the least curvature, found by inverse iteration from a fixed start, so that one sheet always
//! buckles the same way.
//!
//! A node that slides along a track (`hold`) has a direction in place of three: slopes and
//! curvatures are projected on it, the curvature of the track times the slope across it is added,
//! and after a step the node is put back on its track.

use super::ElasticError;
use super::energy::Energy;
use super::hold::{Hold, Holds, OnTrack};
use super::net::Net;
use sheetwright_geometry::math::sparse::{Factor, Matrix, Plan, elimination_order};
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::watch::Watch;
use std::collections::BTreeMap;

/// A step that would lower the energy by less than this share of it is the last. Strains are then
/// within 1e-3 of those at rest.
const AT_REST: f64 = 1e-7;
/// A step is halved so often at the most.
const MOST_HALVINGS: usize = 30;
/// Of the fall that a step promises, so much must come true.
const TRUE_SHARE: f64 = 1e-4;
/// The least share of the compression that is tried before it is left out.
const LEAST_PRESSED: f64 = 1.0 / 16.0;
/// A pass is left so often at the most.
const MOST_PASSES: usize = 6;
/// How far a pass is left, as a share of the size of the sheet.
const LEAVE: f64 = 1e-4;
/// Steps of inverse iteration.
const ITERATIONS: usize = 12;

/// A sheet at rest.
#[derive(Clone)]
pub(super) struct Rest {
    pub(super) positions: Vec<Point3>,
    /// How far a node slid along its track at the most, mm.
    pub(super) slid_max_mm: f64,
    pub(super) is_stable: bool,
    pub(super) steps: usize,
}

/// Where the nodes lie.
#[derive(Clone)]
struct Placed {
    /// In space, mm.
    positions: Vec<Point3>,
    /// How far along its track a node that slides lies, mm.
    along_mm: Vec<f64>,
}

/// The nodes that move, and the pairs of them that act on one another.
struct Free {
    holds: Holds,
    nodes: Vec<usize>,
    number: Vec<Option<usize>>,
    pairs: BTreeMap<[usize; 2], usize>,
}

impl Free {
    fn new(net: &Net, energy: &Energy) -> Self {
        let holds = Holds::new(&net.space, &net.stretches);
        let moves = |&n: &usize| holds.of(n) != Hold::Stays;
        let nodes: Vec<usize> = (0..net.flat.len()).filter(moves).collect();
        let mut number = vec![None; net.flat.len()];
        for (k, &n) in nodes.iter().enumerate() {
            number[n] = Some(k);
        }
        let free = energy.pairs().into_iter().filter_map(|[a, b]| Some([number[a]?, number[b]?]));
        let pairs = free.enumerate().map(|(k, pair)| (pair, k)).collect();
        Self { holds, nodes, number, pairs }
    }

    fn plan(&self) -> Result<Plan<3>, ElasticError> {
        let mut pairs = vec![[0; 2]; self.pairs.len()];
        self.pairs.iter().for_each(|(pair, &k)| pairs[k] = *pair);
        let too_large = |_| ElasticError::TooLarge;
        let order = elimination_order(self.nodes.len(), &pairs).map_err(too_large)?;
        Plan::new(&order, &pairs).map_err(too_large)
    }

    /// The places of the nodes that slide on their tracks; `None` of those that move freely.
    fn on_tracks(&self, placed: &Placed) -> Vec<Option<OnTrack>> {
        let on_track = |&n: &usize| match self.holds.of(n) {
            Hold::Slides { track, .. } => Some(self.holds.place(track, placed.along_mm[n])),
            _ => None,
        };
        self.nodes.iter().map(on_track).collect()
    }

    /// The ways in which the energy falls, by the nodes.
    fn down(&self, energy: &Energy, placed: &Placed) -> Vec<[f64; 3]> {
        let slopes = energy.slopes(&placed.positions);
        let mut down: Vec<[f64; 3]> = self.nodes.iter().map(|&n| (-slopes[n]).to_array()).collect();
        self.project(placed, &mut down);
        down
    }

    /// Leaves of these ways what lies along tracks.
    fn project(&self, placed: &Placed, ways: &mut [[f64; 3]]) {
        for (way, on_track) in ways.iter_mut().zip(self.on_tracks(placed)) {
            if let Some(on_track) = on_track {
                let unit = on_track.along / on_track.along.length();
                let [x, y, z] = *way;
                *way = (unit * Vec3::new(x, y, z).dot(unit)).to_array();
            }
        }
    }

    /// The curvatures of the energy by the nodes, with a multiple of one added.
    fn matrix<'a>(
        &self,
        plan: &'a Plan<3>,
        energy: &Energy,
        placed: &Placed,
        pressed: f64,
        shift: f64,
    ) -> Matrix<'a, 3> {
        let on_tracks = self.on_tracks(placed);
        let projection = |k: usize| on_tracks[k].map(|on_track| Projection::on(on_track.along));
        let mut matrix = plan.zero();
        energy.curvature_blocks(&placed.positions, pressed, |[a, b], block| {
            let (Some(a), Some(b)) = (self.number[a], self.number[b]) else { return };
            let block = projection(a).map_or(block, |projection| projection.rows(block));
            let block = projection(b).map_or(block, |projection| projection.columns(block));
            if a == b {
                matrix.add_diagonal(a, block);
            } else if let Some(&pair) = self.pairs.get(&[a, b]) {
                matrix.add_pair(pair, block);
            }
        });
        self.add_tracks(&mut matrix, energy, placed, pressed, &on_tracks);
        if shift != 0.0 {
            let one =
                std::array::from_fn(|r| std::array::from_fn(|c| if r == c { shift } else { 0.0 }));
            (0..self.nodes.len()).for_each(|n| matrix.add_diagonal(n, one));
        }
        matrix
    }

    /// Adds how the slope across the tracks grows with their curvature, and one across them, where
    /// nothing moves.
    fn add_tracks(
        &self,
        matrix: &mut Matrix<'_, 3>,
        energy: &Energy,
        placed: &Placed,
        pressed: f64,
        on_tracks: &[Option<OnTrack>],
    ) {
        if on_tracks.iter().all(Option::is_none) {
            return;
        }
        let slopes = energy.slopes(&placed.positions);
        let across = energy.across_tracks();
        for (k, &n) in self.nodes.iter().enumerate() {
            let Some(on_track) = on_tracks[k] else { continue };
            let speed = on_track.along.length();
            let bends = slopes[n].dot(on_track.turn) / (speed * speed);
            let bends = bends.max(pressed * bends);
            let [x, y, z] = (on_track.along / speed).to_array();
            let unit = [x, y, z];
            matrix.add_diagonal(
                k,
                std::array::from_fn(|r| {
                    std::array::from_fn(|c| {
                        let one = if r == c { across } else { 0.0 };
                        one + (bends - across) * unit[r] * unit[c]
                    })
                }),
            );
        }
    }

    fn rest(&self, placed: Placed, is_stable: bool, steps: usize) -> Rest {
        let begin_mm = self.holds.begin_mm();
        let slid = placed.along_mm.iter().zip(begin_mm).map(|(now, begin)| (now - begin).abs());
        let slid_max_mm = slid.fold(0.0, f64::max);
        Rest { positions: placed.positions, slid_max_mm, is_stable, steps }
    }

    /// Where the energy is lower than this value along a step, by as much as its fall promises, and
    /// whether that is at the end of the step; `None` where it is so nowhere.
    fn lower(
        &self,
        energy: &Energy,
        placed: &Placed,
        step: &[[f64; 3]],
        [value, fall]: [f64; 2],
    ) -> Option<(Placed, bool)> {
        let mut share = 1.0;
        for _ in 0..MOST_HALVINGS {
            let tried = self.moved(placed, step, share);
            let now = energy.value(&tried.positions);
            if now.is_finite() && now <= value - TRUE_SHARE * share * fall {
                return Some((tried, share == 1.0));
            }
            share *= 0.5;
        }
        None
    }

    fn moved(&self, placed: &Placed, step: &[[f64; 3]], share: f64) -> Placed {
        let mut moved = placed.clone();
        for (&n, &[x, y, z]) in self.nodes.iter().zip(step) {
            let way = Vec3::new(x, y, z) * share;
            if let Hold::Slides { track, .. } = self.holds.of(n) {
                let along = self.holds.place(track, placed.along_mm[n]).along;
                moved.along_mm[n] += way.dot(along) / along.length_squared();
                moved.positions[n] = self.holds.place(track, moved.along_mm[n]).at;
            } else {
                moved.positions[n] += way;
            }
        }
        moved
    }
}

/// What leaves of a move its part along a direction.
struct Projection {
    unit: [f64; 3],
}

impl Projection {
    fn on(along: Vec3) -> Self {
        Self { unit: (along / along.length()).to_array() }
    }

    fn columns(&self, block: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        block.map(|row| {
            let along: f64 = row.iter().zip(self.unit).map(|(x, u)| x * u).sum();
            self.unit.map(|u| along * u)
        })
    }

    fn rows(&self, block: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let along: [f64; 3] =
            std::array::from_fn(|c| (0..3).map(|r| self.unit[r] * block[r][c]).sum());
        self.unit.map(|u| along.map(|x| x * u))
    }
}

/// The place of rest next below where the nodes begin.
pub(super) fn rest(
    net: &Net,
    energy: &Energy,
    begin: Vec<Point3>,
    most_steps: usize,
    watch: &mut dyn Watch,
) -> Result<Rest, ElasticError> {
    let free = Free::new(net, energy);
    let mut placed = Placed { positions: begin, along_mm: free.holds.begin_mm() };
    if free.nodes.is_empty() {
        return Ok(free.rest(placed, true, 0));
    }
    let plan = free.plan()?;
    let size = sheetwright_geometry::boundary::size_of(net.space.iter().copied());
    let too_large = |_| ElasticError::TooLarge;
    let (mut steps, mut passes) = (0, 0);
    let mut pressed = Pressed::new();
    loop {
        if watch.stop() {
            return Err(ElasticError::Stopped);
        }
        if steps == most_steps {
            return Err(ElasticError::NoRest);
        }
        steps += 1;
        let down = free.down(energy, &placed);
        let factor_of = |share: f64| {
            free.matrix(&plan, energy, &placed, share, 0.0).factor().map_err(too_large)
        };
        let factor = pressed.positive(factor_of)?.ok_or(ElasticError::NoRest)?;
        let [step] = factor.solve([&down]);
        let fall = product(&down, &step);
        let value = energy.value(&placed.positions);
        let is_low = fall <= AT_REST * value.abs() + energy.negligible();
        let lower = (!is_low).then(|| free.lower(energy, &placed, &step, [value, fall])).flatten();
        let Some((next, is_long)) = lower else {
            // It rests here if all of the compression counts. Where nothing falls any more,
            // rounding is all there is.
            if pressed.is_whole() {
                return Ok(free.rest(placed, true, steps));
            }
            if factor_of(1.0)?.is_some() {
                pressed.share = 1.0;
                continue;
            }
            // A pass: out along the direction of the least curvature.
            if passes == MOST_PASSES {
                return Ok(free.rest(placed, false, steps));
            }
            passes += 1;
            placed = beyond_pass(&free, &plan, energy, &placed, LEAVE * size)?;
            continue;
        };
        placed = next;
        pressed.after_step(is_long);
    }
}

/// The share of the compression that enters the curvature of the energy.
struct Pressed {
    share: f64,
    /// Whether compression has entered at all: once steps are long.
    has_begun: bool,
    /// Whether the last share that was tried was too large.
    was_lowered: bool,
}

impl Pressed {
    fn new() -> Self {
        Self { share: 0.0, has_begun: false, was_lowered: false }
    }

    fn is_whole(&self) -> bool {
        self.share == 1.0
    }

    /// The factor of the curvature with this share or, while that is not positive, with half of it.
    fn positive<F>(
        &mut self,
        factor_of: impl Fn(f64) -> Result<Option<F>, ElasticError>,
    ) -> Result<Option<F>, ElasticError> {
        self.was_lowered = false;
        loop {
            let factor = factor_of(self.share)?;
            if factor.is_some() || self.share == 0.0 {
                return Ok(factor);
            }
            self.was_lowered = true;
            self.share = if self.share > LEAST_PRESSED { 0.5 * self.share } else { 0.0 };
        }
    }

    /// Tries all of it once steps are long, and then twice the share that was positive at once.
    fn after_step(&mut self, is_long: bool) {
        if !self.has_begun {
            self.has_begun = is_long;
            self.share = if is_long { 1.0 } else { 0.0 };
        } else if !self.was_lowered {
            self.share = (2.0 * self.share).clamp(LEAST_PRESSED, 1.0);
        }
    }
}

/// The places a little way down from a pass.
fn beyond_pass(
    free: &Free,
    plan: &Plan<3>,
    energy: &Energy,
    placed: &Placed,
    far_mm: f64,
) -> Result<Placed, ElasticError> {
    let too_large = |_| ElasticError::TooLarge;
    let whole = free.matrix(plan, energy, placed, 1.0, 0.0);
    // The least shift, by powers of four, that makes the curvature positive.
    let mut shift = 1e-10 * whole.diagonal_max();
    let factor: Factor<'_, 3> = loop {
        let shifted = free.matrix(plan, energy, placed, 1.0, shift);
        if let Some(factor) = shifted.factor().map_err(too_large)? {
            break factor;
        }
        if shift > whole.diagonal_max() {
            return Err(ElasticError::NoRest);
        }
        shift *= 4.0;
    };
    let start = |n: usize| {
        let share = n as f64 / free.nodes.len() as f64;
        [1.0 + share, 0.7 - share * share, 0.4 + 0.5 * share]
    };
    let mut way: Vec<[f64; 3]> = (0..free.nodes.len()).map(start).collect();
    free.project(placed, &mut way);
    for _ in 0..ITERATIONS {
        let [next] = factor.solve([&way]);
        let length = product(&next, &next).sqrt();
        way = next.into_iter().map(|v| v.map(|x| x / length)).collect();
    }
    let most = way.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let both = [far_mm / most, -far_mm / most].map(|share| free.moved(placed, &way, share));
    let [one, other] = both;
    Ok(if energy.value(&other.positions) < energy.value(&one.positions) { other } else { one })
}

fn product(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share that is taken where those up to `most` are positive.
    fn taken(pressed: &mut Pressed, most: f64) -> f64 {
        let found = pressed.positive(|share| Ok((share <= most).then_some(share)));
        found.unwrap().unwrap()
    }

    #[test]
    fn as_much_of_the_compression_enters_as_leaves_the_curvature_positive() {
        let mut pressed = Pressed::new();
        assert_eq!(taken(&mut pressed, 0.3), 0.0);
        pressed.after_step(false);
        assert_eq!(taken(&mut pressed, 0.3), 0.0, "steps are short");
        pressed.after_step(true);
        assert_eq!(taken(&mut pressed, 0.3), 0.25);
        pressed.after_step(true);
        assert_eq!(taken(&mut pressed, 0.6), 0.25, "it was lowered in the step before");
        pressed.after_step(true);
        assert_eq!(taken(&mut pressed, 0.6), 0.5);
        assert_eq!(taken(&mut pressed, 0.0), 0.0);
        assert!(pressed.positive(|_| Ok(None::<f64>)).unwrap().is_none());
        pressed.after_step(true);
        pressed.after_step(true);
        assert!(!pressed.is_whole() && pressed.share > 0.0);
    }
}
