//! A lower bound on the price of all triangulations that takes no search.
//!
//! Each edge of the boundary is a side of one triangle, and each rung a side of two. So the price
//! is at least the sum, over the edges, of the cheapest triangle at each: its fold with half the
//! price of its rungs, divided by its edges where it has several. That needs O(m²) triangles. It is
//! low, as a triangle that cuts off a corner costs little, but it is never without a number.

use super::bound::{price_of, units};
use super::chains::Chains;
use super::work::SIDE;
use crate::math::Vec3;

/// What no triangulation is cheaper than.
pub(super) fn floor(chains: &Chains<'_>) -> f64 {
    let prices = &chains.terms.prices;
    let m = prices.len();
    chains.work.count(2 * SIDE * (m as u64).pow(2));
    let at_edge = |a: usize, b: usize| {
        let of_apex = |c: usize| {
            let [bc, ca] = [chains.terms.side(b, c), chains.terms.side(c, a)];
            let rungs = bc.price + ca.price;
            if rungs == f64::INFINITY {
                return None;
            }
            let fold = chains.fold([a, b, c], [Vec3::ZERO, bc.mean, ca.mean]);
            let edges =
                1 + [(b, c), (c, a)].into_iter().filter(|&(p, q)| prices.neighbours(p, q)).count();
            Some((units(fold) + units(rungs) / 2) / edges as i64)
        };
        (0..m).filter(|&c| c != a && c != b).filter_map(of_apex).min().unwrap_or(0)
    };
    let of_loop = |list: &Vec<usize>| -> i64 {
        let next = list.iter().cycle().skip(1);
        list.iter().zip(next).map(|(&a, &b)| at_edge(a, b)).sum()
    };
    price_of(chains.chains.iter().map(of_loop).sum())
}
