//! The pattern that a sheet at rest would rather have: what is strained all over has a wrong size.
//!
//! A mesh is laid flat by the lengths of its sides, whereas a sheet leaves the surface a little and
//! so has other lengths. The pattern is moved by the displacement u whose strain is nearest to that
//! of the sheet at rest, Σ A·|½(∇u + ∇uᵀ) − E|² over its triangles: a linear system of plane
//! elasticity with the strain E given. The sheet is then free of what a pattern can take away, and
//! what is left is what the surface itself asks for.

use super::energy::Energy;
use super::net::{Net, ordered};
use sheetwright_geometry::math::sparse::{Plan, elimination_order};
use sheetwright_geometry::math::{Point3, Vec2};
use std::collections::BTreeMap;

/// Nothing holds the whole in the plane but springs at every corner of this share of the stiffness.
const HOLD: f64 = 1e-9;

/// The displacement of every node of the net, mm; `None` where the system can't be solved.
pub(super) fn displacement(net: &Net, energy: &Energy, positions: &[Point3]) -> Option<Vec<Vec2>> {
    let mut numbers: BTreeMap<usize, usize> = BTreeMap::new();
    let mut pairs: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for nodes in &net.elements {
        for n in &nodes[..3] {
            let next = numbers.len();
            numbers.entry(*n).or_insert(next);
        }
        for k in 0..3 {
            let next = pairs.len();
            let ends = [nodes[k], nodes[(k + 1) % 3]].map(|n| numbers[&n]);
            pairs.entry(ordered(ends)).or_insert(next);
        }
    }
    let mut list = vec![[0; 2]; pairs.len()];
    pairs.iter().for_each(|(pair, &n)| list[n] = *pair);
    let order = elimination_order(numbers.len(), &list).ok()?;
    let plan = Plan::<2>::new(&order, &list).ok()?;
    let mut matrix = plan.zero();
    let mut force = vec![[0.0; 2]; numbers.len()];
    for (nodes, [xx, yy, xy]) in net.elements.iter().zip(energy.strains(positions)) {
        let corners = [nodes[0], nodes[1], nodes[2]];
        let [a, b, c] = corners.map(|n| net.flat[n]);
        let doubled = (b - a).perp_dot(c - a);
        let gradients = [c - b, a - c, b - a].map(|side| side.perp() * (1.0 / doubled));
        let area = 0.5 * doubled;
        let of = corners.map(|n| numbers[&n]);
        for i in 0..3 {
            let g = gradients[i];
            force[of[i]][0] += area * (xx * g.x + 0.5 * xy * g.y);
            force[of[i]][1] += area * (yy * g.y + 0.5 * xy * g.x);
            for k in 0..3 {
                let h = gradients[k];
                // The product of the strains that moves of both corners bring.
                let block = [
                    [g.x * h.x + 0.5 * g.y * h.y, 0.5 * g.y * h.x],
                    [0.5 * g.x * h.y, g.y * h.y + 0.5 * g.x * h.x],
                ]
                .map(|row| row.map(|x| area * x));
                if i == k {
                    matrix.add_diagonal(of[i], block);
                } else if of[i] < of[k] {
                    matrix.add_pair(*pairs.get(&[of[i], of[k]])?, block);
                }
            }
        }
    }
    let hold = HOLD * matrix.diagonal_max();
    (0..numbers.len()).for_each(|n| matrix.add_diagonal(n, [[hold, 0.0], [0.0, hold]]));
    let [moves] = matrix.factor().ok()??.solve([&force]);
    let mut all = vec![Vec2::ZERO; net.flat.len()];
    numbers.iter().for_each(|(&n, &k)| all[n] = Vec2::from(moves[k]));
    for nodes in &net.elements {
        for k in 0..3 {
            all[nodes[3 + k]] = (all[nodes[k]] + all[nodes[(k + 1) % 3]]) * 0.5;
        }
    }
    Some(all)
}
