//! What the edges of the boundary ask for.

use super::super::{Solved, Terms};
use crate::cost::QUANTUM;
use std::collections::BTreeMap;

/// What asks and debts are multiples of.
pub(super) const HALF: f64 = 0.5 * QUANTUM;

/// What each edge asks for: the price of its triangle in a triangulation that is known, with half
/// of its rungs', shared with the other edges of the triangle. What a triangle without edges costs
/// is asked for by an edge on each of its inner sides. The last edge runs from the last sample to
/// the first; it asks for nothing, as nothing lies outside of it. All of them together ask for what
/// the triangulation costs.
pub(super) fn asks(terms: &Terms<'_>, known: &Solved) -> Vec<f64> {
    let mut asks = vec![0.0; terms.prices.len()];
    let mut triangles = known.triangles.clone();
    triangles.sort_unstable_by_key(|&[i, k, j]| (j - i, i, k));
    // An edge near each rung, on its inner side.
    let mut nearest: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for &[i, k, j] in &triangles {
        let sides = [terms.side(i, k), terms.side(k, j), terms.side(i, j)];
        let twist: f64 = sides.iter().map(|side| side.price).sum();
        let price = 0.5 * twist + terms.fold([i, k, j], sides.map(|side| side.mean));
        let is_edge = [k == i + 1, j == k + 1];
        let [one, other] =
            [(i, k), (k, j)].map(|side| nearest.get(&side).copied().unwrap_or(side.0));
        // Both ask for a whole number of half quanta.
        let half = (0.5 * price / HALF).floor() * HALF;
        let shares = match is_edge {
            [true, false] => [price, 0.0],
            [false, true] => [0.0, price],
            _ => [half, price - half],
        };
        asks[one] += shares[0];
        asks[other] += shares[1];
        nearest.insert((i, j), if is_edge[1] && !is_edge[0] { other } else { one });
    }
    asks
}
