//! The sides as springs: weighted least squares of relative length errors, a step at a time.
//!
//! With the error r = (l_flat − l_space)/l_space of a side and its weight w, ½·Σ w·(r + s)² is made
//! smaller by Gauss and Newton's step: the matrix is Σ (w/l_space²)·d·dᵀ over the sides, d being
//! the side's direction in the plane. All aims are this step with weights w and shifts s of their
//! own. What moves without changing a length (the whole in the plane) is held at two vertices. A
//! step is shortened until it makes the goal smaller, and never flattens a triangle on its way.

use super::guard::Guard;
use super::shape::longest_step;
use super::{Inner, RelaxError};
use sheetwright_geometry::math::sparse::{Factor, Matrix, Plan};
use sheetwright_geometry::math::{Point2, Vec2, unit2};

/// How often a step is halved before it is given up.
const MOST_HALVINGS: usize = 30;
/// A step must gain at least this share of what its slope promises (Armijo's rule).
const LEAST_GAIN: f64 = 1e-4;

/// The flat form as it is now, with what is often asked of it.
#[derive(Clone)]
pub(super) struct Form {
    pub points: Vec<Point2>,
    /// The relative length error of each side, signed.
    pub errors: Vec<f64>,
}

impl Form {
    pub(super) fn new(inner: &Inner<'_>, points: Vec<Point2>) -> Self {
        let errors = inner.errors(&points);
        Self { points, errors }
    }

    /// The largest relative length error.
    pub(super) fn largest(&self) -> f64 {
        self.errors.iter().fold(0.0, |most, r| most.max(r.abs()))
    }

    /// The mean relative length error.
    pub(super) fn mean(&self) -> f64 {
        self.errors.iter().map(|r| r.abs()).sum::<f64>() / self.errors.len() as f64
    }

    /// The direction of a side, and one over its length in space.
    fn direction(&self, inner: &Inner<'_>, edge: usize) -> Vec2 {
        let [a, b] = inner.topology.edges()[edge].ends.map(|v| self.points[v.get()]);
        unit2(b - a).unwrap_or(Vec2::ZERO)
    }

    /// The springs' matrix, for one stiffness a side, held so that it is positive definite.
    pub(super) fn stiffness<'p>(
        &self,
        inner: &Inner<'_>,
        plan: &'p Plan<2>,
        stiffness: impl Fn(usize) -> f64,
    ) -> Matrix<'p, 2> {
        let mut matrix = plan.zero();
        for (n, edge) in inner.topology.edges().iter().enumerate() {
            let d = self.direction(inner, n);
            let k = stiffness(n) / (inner.lengths[n] * inner.lengths[n]);
            let (xx, xy, yy) = (k * d.x * d.x, k * d.x * d.y, k * d.y * d.y);
            let block = [[xx, xy], [xy, yy]];
            matrix.add_diagonal(edge.ends[0].get(), block);
            matrix.add_diagonal(edge.ends[1].get(), block);
            matrix.add_pair(n, [[-xx, -xy], [-xy, -yy]]);
        }
        let hold = matrix.diagonal_max();
        let [first, far] = inner.held;
        matrix.add_diagonal(first, [[hold, 0.0], [0.0, hold]]);
        let across = unit2(self.points[far] - self.points[first]).unwrap_or(Vec2::X).perp();
        let (x, y) = (across.x, across.y);
        matrix.add_diagonal(far, [[hold * x * x, hold * x * y], [hold * x * y, hold * y * y]]);
        matrix
    }

    /// The sum of pulls at the vertices, for one pull a side that wants it shorter.
    pub(super) fn pulled(&self, inner: &Inner<'_>, pull: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
        let mut sum = vec![[0.0; 2]; self.points.len()];
        for (n, edge) in inner.topology.edges().iter().enumerate() {
            let force = self.direction(inner, n) * (pull(n) / inner.lengths[n]);
            let [a, b] = edge.ends.map(|v| v.get());
            sum[a][0] += force.x;
            sum[a][1] += force.y;
            sum[b][0] -= force.x;
            sum[b][1] -= force.y;
        }
        sum
    }

    /// The relative change of each side's length for small steps of the vertices.
    pub(super) fn changes(&self, inner: &Inner<'_>, step: &[[f64; 2]]) -> Vec<f64> {
        let change = |(n, edge): (usize, &crate::mesh::MeshEdge)| {
            let [a, b] = edge.ends.map(|v| Vec2::from(step[v.get()]));
            self.direction(inner, n).dot(b - a) / inner.lengths[n]
        };
        inner.topology.edges().iter().enumerate().map(change).collect()
    }

    /// The form after a share of a step, the longest of those tried that flattens no triangle and
    /// whose goal, from `goal`, falls with the guard's cost as `slope` (the goal's derivative along
    /// the step) and the guard promise; `None` if none does.
    pub(super) fn stepped(
        &self,
        inner: &Inner<'_>,
        guard: &Guard,
        step: &[[f64; 2]],
        slope: f64,
        goal: impl Fn(&[f64], f64) -> f64,
    ) -> Option<(Self, f64)> {
        let slope = slope + guard.slope(inner, step);
        let step: Vec<Vec2> = step.iter().copied().map(Vec2::from).collect();
        if !step.iter().all(|way| way.is_finite()) {
            return None;
        }
        let now = goal(&self.errors, 0.0) + guard.cost(inner, &self.points);
        let mut share = longest_step(inner.topology, inner.shapes, &self.points, &step);
        for _ in 0..MOST_HALVINGS {
            let trial = Self::new(inner, inner.moved(&self.points, &step, share));
            let then = goal(&trial.errors, share) + guard.cost(inner, &trial.points);
            if then < now + LEAST_GAIN * share * slope && inner.is_unflipped(&trial.points) {
                return Some((trial, share));
            }
            share *= 0.5;
        }
        None
    }

    /// The form after one step of Gauss and Newton towards the least ½·Σ w·(r + s)², by the goal
    /// that this stands for; `None` where no step makes it smaller.
    pub(super) fn least_squares_step(
        &self,
        inner: &Inner<'_>,
        plan: &Plan<2>,
        weight: impl Fn(usize) -> f64,
        shift: impl Fn(usize) -> f64,
        goal: impl Fn(&[f64]) -> f64,
    ) -> Result<Option<Self>, RelaxError> {
        let guard = Guard::new(inner, &self.points, guarded_by(self, &weight));
        let mut matrix = self.stiffness(inner, plan, &weight);
        guard.add_to(inner, &mut matrix);
        let Some(factor) = factored(&matrix)? else { return Ok(None) };
        let pull = |n: usize| weight(n) * (self.errors[n] + shift(n));
        let mut force = self.pulled(inner, pull);
        guard.add_pulls(inner, &mut force);
        let [step] = factor.solve([&force]);
        let changes = self.changes(inner, &step);
        let slope: f64 = changes.iter().enumerate().map(|(n, change)| pull(n) * change).sum();
        Ok(self
            .stepped(inner, &guard, &step, slope, |errors, _| goal(errors))
            .map(|(form, _)| form))
    }
}

/// How stiff the guard is beside springs of these weights: as the softest tenth, so that it is felt
/// and no spring gives way to it.
pub(super) fn guarded_by(form: &Form, weight: impl Fn(usize) -> f64) -> f64 {
    let mut weights: Vec<f64> = (0..form.errors.len()).map(weight).collect();
    let tenth = weights.len() / 10;
    *weights.select_nth_unstable_by(tenth, f64::total_cmp).1
}

/// The factor of a matrix of springs.
pub(super) fn factored<'p>(matrix: &Matrix<'p, 2>) -> Result<Option<Factor<'p, 2>>, RelaxError> {
    matrix.factor().map_err(|_| RelaxError::TooLarge)
}
