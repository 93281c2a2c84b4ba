//! The least energy of a sheet whose border is held, by Newton's method.
//!
//! Far from rest the whole curvature of the energy may have no inverse that leads down, since what
//! is pressed may buckle. So steps begin with the compression left out of it, with which it is
//! positive in every direction, and take it whole once that is positive. Steps are shortened until
//! the energy falls. A place of rest at which the whole curvature is not positive is a pass, not a
//! valley: the way down from there is the direction of the least curvature, found by inverse
//! iteration from a fixed start, so that the same sheet always buckles the same way.

use super::ElasticError;
use super::energy::{Energy, Stress};
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
/// A pass is left so often at the most.
const MOST_PASSES: usize = 6;
/// How far a pass is left, as a share of the size of the sheet.
const LEAVE: f64 = 1e-4;
/// Steps of inverse iteration.
const ITERATIONS: usize = 12;

/// A sheet at rest.
pub(super) struct Rest {
    pub(super) positions: Vec<Point3>,
    pub(super) is_stable: bool,
    pub(super) steps: usize,
}

/// The free nodes, and the pairs of them that act on one another.
struct Free {
    nodes: Vec<usize>,
    number: Vec<Option<usize>>,
    pairs: BTreeMap<[usize; 2], usize>,
}

impl Free {
    fn new(net: &Net, energy: &Energy) -> Self {
        let nodes: Vec<usize> = (0..net.flat.len()).filter(|&n| !net.on_border[n]).collect();
        let mut number = vec![None; net.flat.len()];
        for (k, &n) in nodes.iter().enumerate() {
            number[n] = Some(k);
        }
        let free = energy.pairs().into_iter().filter_map(|[a, b]| Some([number[a]?, number[b]?]));
        let pairs = free.enumerate().map(|(k, pair)| (pair, k)).collect();
        Self { nodes, number, pairs }
    }

    fn plan(&self) -> Result<Plan<3>, ElasticError> {
        let mut pairs = vec![[0; 2]; self.pairs.len()];
        self.pairs.iter().for_each(|(pair, &k)| pairs[k] = *pair);
        let too_large = |_| ElasticError::TooLarge;
        let order = elimination_order(self.nodes.len(), &pairs).map_err(too_large)?;
        Plan::new(&order, &pairs).map_err(too_large)
    }

    /// The curvatures of the energy by the free nodes, with a multiple of one added.
    fn matrix<'a>(
        &self,
        plan: &'a Plan<3>,
        energy: &Energy,
        positions: &[Point3],
        stress: Stress,
        shift: f64,
    ) -> Matrix<'a, 3> {
        let mut matrix = plan.zero();
        energy.curvature_blocks(positions, stress, |[a, b], block| {
            let (Some(a), Some(b)) = (self.number[a], self.number[b]) else { return };
            if a == b {
                matrix.add_diagonal(a, block);
            } else if let Some(&pair) = self.pairs.get(&[a, b]) {
                matrix.add_pair(pair, block);
            }
        });
        if shift != 0.0 {
            let one =
                std::array::from_fn(|r| std::array::from_fn(|c| if r == c { shift } else { 0.0 }));
            (0..self.nodes.len()).for_each(|n| matrix.add_diagonal(n, one));
        }
        matrix
    }

    fn moved(&self, positions: &[Point3], step: &[[f64; 3]], share: f64) -> Vec<Point3> {
        let mut moved = positions.to_vec();
        for (&n, &[x, y, z]) in self.nodes.iter().zip(step) {
            moved[n] += Vec3::new(x, y, z) * share;
        }
        moved
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
    let mut positions = begin;
    if free.nodes.is_empty() {
        return Ok(Rest { positions, is_stable: true, steps: 0 });
    }
    let plan = free.plan()?;
    let size = sheetwright_geometry::boundary::size_of(net.space.iter().copied());
    let too_large = |_| ElasticError::TooLarge;
    let (mut steps, mut passes) = (0, 0);
    let mut whole = false;
    loop {
        if watch.stop() {
            return Err(ElasticError::Stopped);
        }
        if steps == most_steps {
            return Err(ElasticError::NoRest);
        }
        steps += 1;
        let slopes = energy.slopes(&positions);
        let down: Vec<[f64; 3]> = free.nodes.iter().map(|&n| (-slopes[n]).to_array()).collect();
        let factor_of = |stress: Stress| {
            free.matrix(&plan, energy, &positions, stress, 0.0).factor().map_err(too_large)
        };
        let of_whole = if whole { factor_of(Stress::Whole)? } else { None };
        let is_whole = of_whole.is_some();
        let factor = match of_whole {
            Some(factor) => factor,
            None => factor_of(Stress::TensionAlone)?.ok_or(ElasticError::NoRest)?,
        };
        let [step] = factor.solve([&down]);
        let fall = product(&down, &step);
        let value = energy.value(&positions);
        if fall <= AT_REST * value.abs() + energy.negligible() {
            if is_whole {
                return Ok(Rest { positions, is_stable: true, steps });
            }
            if !whole {
                whole = true;
                continue;
            }
            // A pass: out along the direction of the least curvature.
            if passes == MOST_PASSES {
                return Ok(Rest { positions, is_stable: false, steps });
            }
            passes += 1;
            positions = beyond_pass(&free, &plan, energy, &positions, LEAVE * size)?;
            continue;
        }
        let mut share = 1.0;
        let mut next = None;
        for _ in 0..MOST_HALVINGS {
            let tried = free.moved(&positions, &step, share);
            let now = energy.value(&tried);
            if now.is_finite() && now <= value - TRUE_SHARE * share * fall {
                next = Some(tried);
                break;
            }
            share *= 0.5;
        }
        // Where nothing falls any more, rounding is all there is.
        let Some(next) = next else {
            if is_whole || passes == MOST_PASSES {
                return Ok(Rest { positions, is_stable: is_whole, steps });
            }
            whole = true;
            passes += 1;
            positions = beyond_pass(&free, &plan, energy, &positions, LEAVE * size)?;
            continue;
        };
        positions = next;
        // The whole curvature is tried as soon as steps are long.
        whole = whole || share == 1.0;
    }
}

/// The positions a little way down from a pass.
fn beyond_pass(
    free: &Free,
    plan: &Plan<3>,
    energy: &Energy,
    positions: &[Point3],
    far_mm: f64,
) -> Result<Vec<Point3>, ElasticError> {
    let too_large = |_| ElasticError::TooLarge;
    let whole = free.matrix(plan, energy, positions, Stress::Whole, 0.0);
    // The least shift, by powers of four, that makes the curvature positive.
    let mut shift = 1e-10 * whole.diagonal_max();
    let factor: Factor<'_, 3> = loop {
        let shifted = free.matrix(plan, energy, positions, Stress::Whole, shift);
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
    for _ in 0..ITERATIONS {
        let [next] = factor.solve([&way]);
        let length = product(&next, &next).sqrt();
        way = next.into_iter().map(|v| v.map(|x| x / length)).collect();
    }
    let most = way.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let both = [far_mm / most, -far_mm / most].map(|share| free.moved(positions, &way, share));
    let [one, other] = both;
    Ok(if energy.value(&other) < energy.value(&one) { other } else { one })
}

fn product(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| x * y).sum()
}
