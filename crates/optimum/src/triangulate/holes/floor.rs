//! A lower bound on the price of all triangulations, without a search.
//!
//! Each edge of the boundary is a side of one triangle, and each rung a side of two. So the price
//! is at least the sum, over the edges, of the cheapest triangle at each: its fold price with half
//! the price of its rungs, divided by the number of its edges. That takes O(m²) triangles. The
//! bound is low, as a triangle that cuts off a corner costs little, but it always exists.

use super::super::{BARRED, Side};
use super::bound::{price_of, units};
use super::chains::Chains;
use super::work::SIDE;
use sheetwright_geometry::math::Vec3;

/// The lower bound.
pub(super) fn floor(chains: &Chains<'_>) -> f64 {
    let m = chains.terms.prices.len();
    chains.work.count(SIDE * (m as u64).pow(2));
    let of_loop = |list: &Vec<usize>| -> i64 {
        let side = |a: usize, c: usize| if a == c { BARRED } else { chains.terms.side(a, c) };
        let from = |a: usize| (0..m).map(|c| side(a, c)).collect::<Vec<Side>>();
        let mut sides = from(list[0]);
        let next = list.iter().cycle().skip(1);
        let edges = list.iter().zip(next).map(|(&a, &b)| {
            let from_a = std::mem::replace(&mut sides, from(b));
            at_edge(chains, [a, b], [&from_a, &sides])
        });
        edges.sum()
    };
    price_of(chains.chains.iter().map(of_loop).sum())
}

/// The least share in the price, in half quanta, of a triangle on an edge. `sides` are those from
/// each of its ends to all samples.
fn at_edge(chains: &Chains<'_>, [a, b]: [usize; 2], sides: [&[Side]; 2]) -> i64 {
    let mut least: Option<i64> = None;
    for c in (0..chains.terms.prices.len()).filter(|&c| c != a && c != b) {
        let [ca, bc] = [sides[0][c], sides[1][c]];
        let rungs = bc.price + ca.price;
        if rungs == f64::INFINITY {
            continue;
        }
        let is_edge = |p| chains.terms.prices.neighbours(p, c);
        let edges = 1 + i64::from(is_edge(a)) + i64::from(is_edge(b));
        let of_rungs = units(rungs) / 2;
        // Folds are never negative.
        if least.is_none_or(|least| of_rungs / edges < least) {
            let fold = chains.fold([a, b, c], [Vec3::ZERO, bc.mean, ca.mean]);
            let share = (units(fold) + of_rungs) / edges;
            least = Some(least.map_or(share, |least| least.min(share)));
        }
    }
    least.unwrap_or(0)
}
