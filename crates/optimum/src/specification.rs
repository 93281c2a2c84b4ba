//! What the optimum is: equation (5) as it is written, the specification of [`crate::triangulate`].
//!
//! Number the samples of a loop 0 … m − 1. The edge ⟨0, m−1⟩ belongs to every triangulation. Let
//! E(i,j) be the least price of a triangulation of the samples i … j, the rung ⟨i,j⟩ included; it
//! is 0 for an edge of the boundary. The triangle on ⟨i,j⟩ has its third corner at some k between
//! i and j, and leaves two smaller parts, so that
//!
//! E(i,j) = w(i,j) + min over i<k<j of E(i,k) + E(k,j) + F(i,k,j)
//!
//! with w the price of a rung ([`Prices::rung`]) and F the fold price of a triangle
//! ([`Prices::triangle`]). E(0, m−1) is the price of the optimum. Tracing back the best k of each
//! E(i,j) gives its triangles.
//!
//! Prices are multiples of a quantum, so different triangulations do tie, most of all on flat
//! stretches. **Of equal prices, the k with the shortest way |P_i P_k| + |P_k P_j| wins, then the
//! smallest k**: strips of compact triangles rather than fans.
//!
//! This takes Θ(m³) time and Θ(m²) memory. [`crate::triangulate`] gives the same triangles and the
//! same bits of the price in a small part of that, and tests compare the two. Beyond these lines it
//! only leaves out entries that can't be part of the optimum. Not specified here are holes, other
//! methods, and boundaries that need rungs without a tangent plane.

use crate::cost::{PriceOptions, Prices};
use crate::rung::Visibility;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::math::Vec3;

/// The cheapest triangulation of a boundary of one loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// Its price, without unit.
    pub price: f64,
    /// Its triangles: the samples at their corners, in increasing order.
    pub triangles: Vec<[usize; 3]>,
}

/// The cheapest triangulation of a boundary of one loop. With a supporting plane, rungs lie inside
/// the projection of the boundary. `None` if no triangulation has tangent planes at all rungs.
pub fn cheapest(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    options: PriceOptions,
) -> Option<Optimum> {
    cheapest_of(boundary, plane, &Prices::new(boundary, plane, options))
}

/// [`cheapest`] by these prices, which may have hints.
pub fn cheapest_of(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    prices: &Prices,
) -> Option<Optimum> {
    let sides = Sides::new(boundary, plane, prices);
    best(boundary, &sides, |a, b| a + b, |corners, means| prices.triangle(corners, means))
}

/// The least possible largest twist of a triangulation, without unit: the least price of its
/// dearest rung. Equation (5) with the larger of two prices instead of their sum, without folds.
pub fn least_worst_twist(boundary: &Boundary, plane: Option<&SupportingPlane>) -> Option<f64> {
    let prices = Prices::new(boundary, plane, PriceOptions::default());
    let sides = Sides::new(boundary, plane, &prices);
    Some(best(boundary, &sides, f64::max, |_, _| 0.0)?.price)
}

/// The price w and the mean normal N of every side ⟨i,j⟩, i < j: 0 for edges of the boundary, an
/// infinite price for rungs that are not admitted.
struct Sides {
    samples: usize,
    prices: Vec<f64>,
    means: Vec<Vec3>,
}

impl Sides {
    fn new(boundary: &Boundary, plane: Option<&SupportingPlane>, prices: &Prices) -> Self {
        let m = boundary.len();
        let inside = Visibility::new(boundary, plane);
        let mut sides =
            Self { samples: m, prices: vec![0.0; m * m], means: vec![Vec3::ZERO; m * m] };
        for (i, j) in (0..m).flat_map(|i| (i + 1..m).map(move |j| (i, j))) {
            if prices.neighbours(i, j) {
                continue;
            }
            let planes = prices.planes(i, j).filter(|_| inside.allows(i, j));
            let at = sides.at(i, j);
            sides.prices[at] = planes.map_or(f64::INFINITY, |planes| prices.rung(i, j, &planes));
            sides.means[at] = planes.map_or(Vec3::ZERO, |planes| planes.mean);
        }
        sides
    }

    fn at(&self, i: usize, j: usize) -> usize {
        i * self.samples + j
    }
}

/// The triangulation with the least price of rungs and folds.
fn best(
    boundary: &Boundary,
    sides: &Sides,
    together: impl Fn(f64, f64) -> f64,
    fold: impl Fn([usize; 3], [Vec3; 3]) -> f64,
) -> Option<Optimum> {
    let m = boundary.len();
    let position = |i: usize| boundary.samples()[i].position.to_vec();
    let (mut least, mut chosen) = (vec![0.0; m * m], vec![0; m * m]);
    for (length, i) in (2..m).flat_map(|length| (0..m - length).map(move |i| (length, i))) {
        let j = i + length;
        let at = sides.at(i, j);
        let mut best = (f64::INFINITY, f64::INFINITY);
        for k in i + 1..j {
            let below = [sides.at(i, k), sides.at(k, j)];
            let means = [below[0], below[1], at].map(|side| sides.means[side]);
            let price = together(least[below[0]], least[below[1]]) + fold([i, k, j], means);
            if price > best.0 {
                continue;
            }
            let way = (position(k) - position(i)).length() + (position(j) - position(k)).length();
            if (price, way) < best {
                best = (price, way);
                chosen[at] = k;
            }
        }
        least[at] = together(best.0, sides.prices[at]);
    }
    let price = least[m - 1];
    if price == f64::INFINITY {
        return None;
    }
    let (mut triangles, mut parts) = (Vec::new(), vec![(0, m - 1)]);
    while let Some((i, j)) = parts.pop() {
        if j - i > 1 {
            let k = chosen[sides.at(i, j)];
            triangles.push([i, k, j]);
            parts.extend([(i, k), (k, j)]);
        }
    }
    triangles.sort_unstable();
    Some(Optimum { price, triangles })
}
