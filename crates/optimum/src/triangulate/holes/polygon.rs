//! The cheapest triangulation of a domain whose cuts have joined all loops into one chain.

use super::super::optimal;
use super::super::{Found, Method, Solved, Terms, TriangulateError};
use super::chains::{Chains, Spot};
use super::{Part, WORTH_A_BOUND, outcome};
use crate::rung::Visibility;
use sheetwright_geometry::watch::Watch;
use std::collections::BTreeMap;

/// Steps for a sum of the table with folds, on a chain.
const FOLDED_SUM: u64 = 10;
/// So many tables are several: two surfaces are tried, and a search is to follow.
const SEVERAL: u64 = 3;
/// A table is large if it takes more than the remaining work divided by this.
const LARGE: u64 = 4;

/// Limit of the cases of rungs used from both banks.
const MOST_CASES: usize = 200;
/// Limit of the tables for a quick surface.
const MOST_QUICK: usize = 4;
/// Such a table that takes no more steps than this, a twentieth of a second, is filled even where
/// no work is left.
const SMALL: u64 = 50_000_000;

/// The cheapest triangulation of the only chain that is a surface, or a quick one; `None` if there
/// is none up to `bound`, or none was found.
///
/// Without a plane, the cheapest of all may use a rung from both banks of a cut, which is no
/// surface. Then there are two cases, with the rung barred from one of the banks, and the cheapest
/// case is tried first. Where tables are large, or the remaining work does not suffice for two of
/// them, all such rungs are barred from one bank at once: that mostly gives a surface after a few
/// tables.
pub(super) fn solve_simple(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let places = chains.len(0);
    let (steps, is_large) = (least_steps(places), is_large(chains, places));
    let Some(solved) = solve(chains, bound, watch)? else { return Ok(None) };
    let mut cases = vec![(solved, chains.clone())];
    for _ in 0..MOST_CASES {
        let cheapest =
            (0..cases.len()).min_by(|&a, &b| cases[a].0.price.total_cmp(&cases[b].0.price));
        let Some((solved, case)) = cheapest.map(|n| cases.swap_remove(n)) else { break };
        let Some(&twice) = used_twice(&case, &solved.triangles).first() else {
            return Ok(Some(by_samples(&case, solved)));
        };
        if is_large || chains.work.left() < 2 * steps {
            chains.work.cut_short();
            return quickly(case, solved, bound, watch);
        }
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

/// A quick surface from a triangulation that uses rungs from both banks of a cut; `None` if a few
/// tables, as many as the work limit allows, do not find one.
fn quickly(
    mut case: Chains<'_>,
    mut solved: Solved,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let steps = least_steps(case.len(0));
    let mut tables = 0;
    loop {
        let twice = used_twice(&case, &solved.triangles);
        if twice.is_empty() {
            return Ok(Some(by_samples(&case, solved)));
        }
        if tables == MOST_QUICK || steps > SMALL.max(case.work.left()) {
            return Ok(None);
        }
        // The shorter run along the chain keeps its rung.
        let apart = |places: &[usize; 2]| {
            let apart = places[1] - places[0];
            apart.min(case.len(0) - apart)
        };
        let barred =
            twice.iter().map(|&[one, other]| if apart(&one) > apart(&other) { one } else { other });
        let barred: Vec<[usize; 2]> = barred.collect();
        case.barred.extend(barred);
        let Some(next) = solve(&case, bound, watch)? else { return Ok(None) };
        solved = next;
        tables += 1;
    }
}

/// Triangles between samples, from triangles between places on the chain.
fn by_samples(chains: &Chains<'_>, solved: Solved) -> Solved {
    let sample = |at: usize| chains.sample(Spot { chain: 0, at });
    let triangles = solved.triangles.iter().map(|t| t.map(sample)).collect();
    Solved { triangles, ..solved }
}

/// Pairs of rungs between different places that join the same samples, in the order of the
/// triangles.
fn used_twice(chains: &Chains<'_>, places: &[[usize; 3]]) -> Vec<[[usize; 2]; 2]> {
    let mut twice = Vec::new();
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
                twice.push([first, own]);
            }
        }
    }
    twice
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
    let found = solve_on_chain(chains, &terms, &order, bound - of_cuts, watch)?;
    Ok(found.map(|Solved { price, mut triangles }| {
        for triangle in &mut triangles {
            *triangle = triangle.map(|i| spot(i).at);
        }
        Solved { price: price + of_cuts, triangles }
    }))
}

/// Least work of a table on a chain of so many places, steps: each of its sums.
fn least_steps(places: usize) -> u64 {
    (places as u64).pow(3) / 6
}

/// Whether the remaining work suffices for several tables on a chain of so many places.
pub(super) fn is_affordable(chains: &Chains<'_>, places: usize) -> bool {
    SEVERAL * least_steps(places) <= chains.work.left()
}

/// Most work of a table on a chain of so many places, steps.
fn most_steps(terms: &Terms<'_>, places: usize) -> u64 {
    least_steps(places) * if terms.folds() { FOLDED_SUM } else { 1 }
}

/// Whether the table on a chain of so many places may take a large part of the remaining work.
pub(super) fn is_large(chains: &Chains<'_>, places: usize) -> bool {
    most_steps(chains.terms, places) > chains.work.left() / LARGE
}

/// The triangles of the cheapest triangulation of a chain of these samples, numbered in order, and
/// its price; `None` if there is none up to `bound`.
///
/// Members of a chain are not numbered in order, and for those the table with folds takes about ten
/// times as long. Where that is a large part of the work, the chain is first treated as a loop in
/// order, which leaves out the folds at its cuts. The result is a bound for the table; or, where
/// the bound would prune too little, it is the answer: good, and not the cheapest.
fn solve_on_chain(
    chains: &Chains<'_>,
    terms: &Terms<'_>,
    order: &[usize],
    mut bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let places = order.len();
    let (sums, all) = (least_steps(places), most_steps(terms, places));
    if terms.folds() && is_large(chains, places) {
        chains.work.count(sums);
        let in_order = chains.terms.prices.chain_in_order(order);
        let in_order = Terms::new(&in_order, terms.visibility, terms.forced);
        let Some(rough) = optimal::solve_priced(&in_order, &mut Part::silent(watch))? else {
            return Ok(None);
        };
        let found = Found { triangles: rough.triangles.clone(), lower_bound: None };
        let price = outcome(terms, found, Method::Optimal).price;
        if price > bound {
            return Ok(None);
        }
        if price >= WORTH_A_BOUND {
            return Ok(Some(Solved { price, ..rough }));
        }
        bound = price;
    }
    // Far from developable the table needs all sums; below a low bound, few.
    chains.work.count(if bound < WORTH_A_BOUND { sums } else { all });
    if bound < f64::INFINITY {
        optimal::solve_within(terms, bound, &mut Part::silent(watch))
    } else {
        optimal::solve_priced(terms, watch)
    }
}
