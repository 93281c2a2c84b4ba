//! The cheapest triangulation of a domain whose cuts have joined all loops into one chain.

use super::super::optimal;
use super::super::{Solved, Terms, TriangulateError};
use super::Part;
use super::chains::{Chains, Spot};
use crate::rung::Visibility;
use crate::watch::Watch;
use std::collections::BTreeMap;

/// The cheapest triangulation of the only chain that is a surface; `None` if there is none up to
/// `bound`, or none after `most` tries.
///
/// Without a plane, the cheapest of all may use a rung from both banks of a cut, which is no
/// surface. Then there are two cases, with one of the two barred, and the cheapest case is tried
/// first.
pub(super) fn solve_simple(
    chains: &Chains<'_>,
    bound: f64,
    most: usize,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut cases: Vec<(Solved, Chains<'_>)> = Vec::new();
    if let Some(solved) = solve(chains, bound, watch)? {
        cases.push((solved, chains.clone()));
    }
    for _ in 0..most {
        let cheapest =
            (0..cases.len()).min_by(|&a, &b| cases[a].0.price.total_cmp(&cases[b].0.price));
        let Some((solved, case)) = cheapest.map(|n| cases.swap_remove(n)) else { break };
        let Some(twice) = used_twice(&case, &solved.triangles) else {
            let sample = |at: usize| case.sample(Spot { chain: 0, at });
            let triangles = solved.triangles.iter().map(|t| t.map(sample)).collect();
            return Ok(Some(Solved { triangles, ..solved }));
        };
        for barred in twice {
            let mut case = case.clone();
            case.barred.insert(barred);
            if let Some(solved) = solve(&case, bound, watch)? {
                cases.push((solved, case));
            }
        }
    }
    Ok(None)
}

/// Two rungs between different places that join the same samples, if some do.
fn used_twice(chains: &Chains<'_>, places: &[[usize; 3]]) -> Option<[[usize; 2]; 2]> {
    let mut of_samples: BTreeMap<[usize; 2], [usize; 2]> = BTreeMap::new();
    for &[a, b, c] in places {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let spots = [p, q].map(|at| Spot { chain: 0, at });
            if chains.consecutive(spots[0], spots[1]) {
                continue;
            }
            let [s, t] = spots.map(|spot| chains.sample(spot));
            let own = [p.min(q), p.max(q)];
            let first = *of_samples.entry([s.min(t), s.max(t)]).or_insert(own);
            if first != own {
                return Some([first, own]);
            }
        }
    }
    None
}

/// The triangles of the cheapest triangulation of the only chain, as places on it, and its price
/// with that of the cuts; `None` if there is none up to `bound`.
fn solve(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let of_cuts = chains.price_of_cuts();
    let n = chains.len(0);
    // The table takes its last edge for one of the boundary, so it must not be a bank.
    let Some(start) = (0..n).find(|&at| {
        let spot = Spot { chain: 0, at };
        !chains.is_cut(chains.previous(spot), chains.sample(spot))
    }) else {
        return Ok(None);
    };
    let spot = |i: usize| Spot { chain: 0, at: (start + i) % n };
    let order: Vec<usize> = (0..n).map(|i| chains.sample(spot(i))).collect();
    let prices = chains.terms.prices.chain(&order, |a, b| chains.is_cut(a, b));
    let visibility = Visibility::of_pairs(n, |i, j| chains.sees(spot(i), spot(j)));
    let terms = Terms::new(&prices, &visibility, chains.terms.forced);
    let found = if bound < f64::INFINITY {
        optimal::solve_within(&terms, bound - of_cuts, &mut Part::silent(watch))?
    } else {
        optimal::solve_priced(&terms, watch)?
    };
    Ok(found.map(|Solved { price, mut triangles }| {
        for triangle in &mut triangles {
            *triangle = triangle.map(|i| spot(i).at);
        }
        Solved { price: price + of_cuts, triangles }
    }))
}
