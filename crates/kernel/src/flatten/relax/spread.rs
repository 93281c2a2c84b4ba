//! From an embedding that squeezes to one that hardly does, without turning a triangle over.
//!
//! A form in a circle squeezes triangles by any factor, and a conformal one of a strongly curved
//! surface by many. The symmetric Dirichlet energy, Σ A·(σ₁² + σ₂² + σ₁⁻² + σ₂⁻²) with the
//! stretches σ of each triangle, grows without bound as one is flattened. It is brought down as in
//! \[Rabinovich2017\]: the rotations R nearest to the maps J of the triangles are kept fixed, and Σ
//! A·‖W(J − R)‖² is least at a linear system; W is chosen so that both energies fall alike. A step
//! goes only as far as no triangle is flattened and the energy falls.

use super::shape::{Shape, laid_down, longest_step};
use super::{Inner, RelaxError};
use crate::mesh::Topology;
use sheetwright_geometry::math::sparse::Plan;
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::watch::Watch;

/// Triangles stretched by less than this, or squeezed by less, are left to what comes after. The
/// conformal form of a hemisphere squeezes by 2, and has a true border, which is worth keeping.
const SPREAD: f64 = 3.0;
/// The most steps; a hundred thousand triangles in a circle take some thirty.
const MOST_STEPS: usize = 100;
/// A step that lowers the energy's excess by less than this share is the last: what remains is not
/// for this energy.
const LEAST_GAIN: f64 = 1e-2;
/// How often a step is halved before it is given up.
const MOST_HALVINGS: usize = 40;

/// A triangle as it is in space: gradients of the three corners' hat functions, and twice its area.
pub(super) struct Reference {
    gradients: [Vec2; 3],
    doubled_area: f64,
}

impl Reference {
    pub(super) fn new(shape: &Shape, first_side: f64) -> Self {
        let [a, b, c] = laid_down(shape, first_side);
        let gradient = |from: Vec2, to: Vec2| (to - from).perp() / shape.doubled_area;
        Self {
            gradients: [gradient(b, c), gradient(c, a), gradient(a, b)],
            doubled_area: shape.doubled_area,
        }
    }

    /// The columns of the linear map that lays the triangle at these points.
    pub(super) fn map(&self, points: [Point2; 3]) -> [Vec2; 2] {
        let mut columns = [Vec2::ZERO; 2];
        for (point, gradient) in points.iter().zip(&self.gradients) {
            columns[0] += point.to_vec() * gradient.x;
            columns[1] += point.to_vec() * gradient.y;
        }
        columns
    }
}

/// The largest and the smallest stretch of a linear map with these columns, the smallest negative
/// where it turns over; and the first column of the rotation nearest to it.
pub(super) fn stretches([c0, c1]: [Vec2; 2]) -> ([f64; 2], Vec2) {
    // The map is a similarity and one that turns over, added up.
    let turning = Vec2::new(c0.x + c1.y, c0.y - c1.x) * 0.5;
    let mirroring = Vec2::new(c0.x - c1.y, c0.y + c1.x) * 0.5;
    let (q, r) = (turning.length(), mirroring.length());
    ([q + r, q - r], turning / q)
}

/// Σ A·(σ₁² + σ₂² + σ₁⁻² + σ₂⁻² − 4), twice; infinite where a triangle is not kept the right way
/// up.
fn energy(inner: &Inner<'_>, references: &[Reference], points: &[Point2]) -> f64 {
    let mut sum = 0.0;
    for (n, reference) in references.iter().enumerate() {
        let [c0, c1] = reference.map(inner.corners(n, points));
        let determinant = c0.perp_dot(c1);
        if determinant.is_nan() || determinant <= 0.0 {
            return f64::INFINITY;
        }
        let squares = c0.length_squared() + c1.length_squared();
        let excess = squares + squares / (determinant * determinant) - 4.0;
        sum += reference.doubled_area * excess.max(0.0);
    }
    sum
}

/// Brings an embedding to one whose triangles are stretched by little, as far as steps do.
pub(super) fn spread(
    inner: &Inner<'_>,
    plan: &Plan<2>,
    points: &mut Vec<Point2>,
    watch: &mut dyn Watch,
) -> Result<(), RelaxError> {
    let topology = inner.topology;
    let references = inner.references();
    let worst = |points: &[Point2]| {
        let stretch = |(n, reference): (usize, &Reference)| {
            let [most, least] = stretches(reference.map(inner.corners(n, points))).0;
            most.max(1.0 / least)
        };
        references.iter().enumerate().map(stretch).fold(1.0, f64::max)
    };
    let mut now = energy(inner, &references, points);
    for _ in 0..MOST_STEPS {
        if worst(points) < SPREAD {
            break;
        }
        if watch.stop() {
            return Err(RelaxError::Stopped);
        }
        let Some(step) = step(inner, plan, &references, points)? else { break };
        let mut share = longest_step(topology, inner.shapes, points, &step);
        let mut moved = None;
        for _ in 0..MOST_HALVINGS {
            let trial = inner.moved(points, &step, share);
            let then = energy(inner, &references, &trial);
            if then < now && inner.is_unflipped(&trial) {
                moved = Some((trial, then));
                break;
            }
            share *= 0.5;
        }
        let Some((trial, then)) = moved else { break };
        let gain = 1.0 - then / now;
        (*points, now) = (trial, then);
        if gain < LEAST_GAIN {
            break;
        }
    }
    Ok(())
}

/// The step to the least of Σ A·‖W(J − R)‖².
fn step(
    inner: &Inner<'_>,
    plan: &Plan<2>,
    references: &[Reference],
    points: &[Point2],
) -> Result<Option<Vec<Vec2>>, RelaxError> {
    let topology: &Topology = inner.topology;
    let mut matrix = plan.zero();
    let mut force = vec![[0.0; 2]; points.len()];
    for (n, reference) in references.iter().enumerate() {
        let map = reference.map(inner.corners(n, points));
        let ([most, least], turn) = stretches(map);
        // WᵀW has the stretches' directions and these values; one plus the first three powers of
        // 1/σ is (σ − σ⁻³)/(σ − 1).
        let value = |s: f64| 1.0 + (1.0 + (1.0 + 1.0 / s) / s) / s;
        let rotation = [turn, turn.perp()];
        // J·Rᵀ, symmetric with the stretches as its values.
        let xx = map[0].x * rotation[0].x + map[1].x * rotation[1].x;
        let xy = map[0].x * rotation[0].y + map[1].x * rotation[1].y;
        let yy = map[0].y * rotation[0].y + map[1].y * rotation[1].y;
        let apart = most - least;
        let (a, b) = (value(most), value(least));
        let slope = if apart > 1e-9 * most { (a - b) / apart } else { 0.0 };
        let shift = 0.5 * (a + b) - slope * 0.5 * (most + least);
        let w = [[shift + slope * xx, slope * xy], [slope * xy, shift + slope * yy]];
        let scaled = |by: f64| w.map(|row| row.map(|value| value * by));
        let apart = [map[0] - rotation[0], map[1] - rotation[1]];
        let corners = topology.triangles()[n];
        let edges = inner.edges_of(n);
        for k in 0..3 {
            let g = reference.gradients[k];
            let pull = (apart[0] * g.x + apart[1] * g.y) * reference.doubled_area;
            let at = corners[k].get();
            force[at][0] -= w[0][0] * pull.x + w[0][1] * pull.y;
            force[at][1] -= w[1][0] * pull.x + w[1][1] * pull.y;
            matrix.add_diagonal(at, scaled(reference.doubled_area * g.length_squared()));
            let next = reference.gradients[(k + 1) % 3];
            matrix.add_pair(edges[k], scaled(reference.doubled_area * g.dot(next)));
        }
    }
    // Held at one vertex: forces add up to none, so it would not move anyway.
    let hold = matrix.diagonal_max();
    matrix.add_diagonal(0, [[hold, 0.0], [0.0, hold]]);
    let factor = matrix.factor().map_err(|_| RelaxError::TooLarge)?;
    Ok(factor.map(|factor| {
        let [step] = factor.solve([&force]);
        step.into_iter().map(Vec2::from).collect()
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_of_maps() {
        let (most, least) = (3.0, 0.5);
        // Stretched along directions at 30°, then turned by 50°.
        let (c, s) = (0.75f64.sqrt(), 0.5);
        let xx = most * c * c + least * s * s;
        let xy = (most - least) * c * s;
        let yy = most * s * s + least * c * c;
        let turn = Vec2::new(0.6, 0.8);
        let map = [Vec2::new(xx, xy), Vec2::new(xy, yy)].map(|column| turn.rotate(column));
        let (found, rotation) = stretches(map);
        assert!((found[0] - most).abs() < 1e-14 && (found[1] - least).abs() < 1e-14);
        assert!((rotation - turn).length() < 1e-14);
        assert!(stretches([Vec2::X, -Vec2::Y]).0[1] < 0.0);
    }
}
