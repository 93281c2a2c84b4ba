//! Orders in which hinges are folded, and what a cut costs.

use super::facets::Facets;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Vec3, unit};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// What the length of a hinge counts against its angle in the order of makers' programs: Blender's
/// own weights, with the angle in half turns and lengths in mean ones.
const CONVEX: f64 = 0.5;
/// See [`CONVEX`].
const CONCAVE: f64 = 1.0;
/// See [`CONVEX`].
const LENGTH: f64 = -0.05;

/// The direction in which cuts are least seen: to the back and below.
pub(super) const HIDDEN: Vec3 =
    Vec3::new(0.0, std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2);

/// The orders in which hinges are tried, those to fold first in front.
pub(super) fn orders(facets: &Facets) -> Vec<Vec<usize>> {
    let hinges = &facets.hinges;
    let mean = hinges.iter().map(|h| h.length_mm).sum::<f64>() / hinges.len().max(1) as f64;
    let length = |n: usize| hinges[n].length_mm / mean;
    let angle = |n: usize| hinges[n].crease.abs() / PI;
    let maker = |n: usize| {
        let weight = if hinges[n].crease > 0.0 { CONVEX } else { CONCAVE };
        weight * angle(n) + LENGTH * length(n)
    };
    let mut orders = vec![
        by(facets, |n| -length(n)),
        by(facets, |n| -length(n) * (1.0 - hidden(facets, n))),
        by(facets, angle),
        by(facets, maker),
        by(facets, |n| angle(n) - 0.5 * length(n)),
    ];
    for way in directions() {
        let steepest = steepest(facets, way);
        orders.push(by(facets, |n| if steepest[n] { 0.0 } else { -1.0 - length(n) }));
    }
    orders
}

/// The hinges by a key, the least first.
pub(super) fn by(facets: &Facets, key: impl Fn(usize) -> f64) -> Vec<usize> {
    // Keys that are equal but for rounding are equal; then hinges stand in their order.
    let keys: Vec<f64> = (0..facets.hinges.len()).map(|n| (key(n) * 1e9).round()).collect();
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]).then(a.cmp(&b)));
    order
}

/// Directions for the steepest edges: first those by which cuts run to where they are least seen.
/// None is along an axis, so that few edges are equally steep.
fn directions() -> [Vec3; 8] {
    let tilted = |x: f64, y: f64, z: f64| unit(Vec3::new(x, y, z)).unwrap_or(HIDDEN);
    [
        tilted(0.03, 0.7, -0.7),
        tilted(0.05, 0.02, -1.0),
        tilted(0.02, 1.0, -0.05),
        tilted(0.04, 0.03, 1.0),
        tilted(0.03, -1.0, 0.06),
        tilted(1.0, 0.05, -0.07),
        tilted(-1.0, 0.09, 0.04),
        tilted(0.6, -0.5, 0.7),
    ]
}

/// The hinges that climb most steeply along `way`, of all that end at one vertex: cut along them, a
/// convex body lies flat in one piece, nearly always \[Schlickenrieder1997\].
fn steepest(facets: &Facets, way: Vec3) -> Vec<bool> {
    let mut best: BTreeMap<VertexIndex, (f64, usize)> = BTreeMap::new();
    for (n, hinge) in facets.hinges.iter().enumerate() {
        let [a, b] = [hinge.line[0], hinge.line[hinge.line.len() - 1]];
        for (from, to) in [(a, b), (b, a)] {
            let climb = facets.positions[to.get()] - facets.positions[from.get()];
            let climb = unit(climb).map_or(0.0, |climb| climb.dot(way));
            let is_best = best.get(&from).is_none_or(|&(most, _)| climb > most + 1e-12);
            if climb > 0.0 && is_best {
                best.insert(from, (climb, n));
            }
        }
    }
    let mut steepest = vec![false; facets.hinges.len()];
    best.values().for_each(|&(_, n)| steepest[n] = true);
    steepest
}

/// How little a hinge is seen, 0 ..= 1: 1 where it faces down and to the back.
fn hidden(facets: &Facets, hinge: usize) -> f64 {
    let [a, b] = facets.hinges[hinge].facets.map(|f| facets.list[f].normal);
    0.5 + 0.25 * (a + b).dot(HIDDEN)
}

/// What it costs to cut a hinge: its length, mm, half of that where it is least seen.
pub(super) fn seam_cost(facets: &Facets, hinge: usize) -> f64 {
    facets.hinges[hinge].length_mm * (1.0 - 0.5 * hidden(facets, hinge))
}
