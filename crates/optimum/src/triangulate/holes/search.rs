//! A good triangulation of a domain with several holes, by local search over cuts.
//!
//! Any h joining rungs that tie h + 1 loops together cut the domain open into one chain, whose
//! cheapest triangulation the table finds. Then one cut at a time is replaced: h − 1 rungs of the
//! triangulation are kept as cuts, so that a ring is left, and the cheapest triangulation of the
//! ring ([`super::band`]) is no dearer. The kept rungs change from round to round; the search ends
//! when a round of each kind has brought no gain.

use super::super::{Solved, TriangulateError};
use super::chains::{Chains, Spot};
use super::{Part, band, polygon, zigzag};
use sheetwright_geometry::watch::Watch;
use std::collections::BTreeMap;

/// A triangulation as directed sides, each with the far corner of the triangle to its left.
pub(super) struct Sides {
    far: BTreeMap<(usize, usize), usize>,
}

impl Sides {
    /// The sides of some triangles; `None` if a side is used twice in one direction, or is an edge
    /// of the boundary as well: then they are no surface.
    pub(super) fn new(chains: &Chains<'_>, triangles: &[[usize; 3]]) -> Option<Self> {
        let mut far = BTreeMap::new();
        for &[a, b, c] in triangles {
            for (from, to, beyond) in [(a, b, c), (b, c, a), (c, a, b)] {
                if far.insert((from, to), beyond).is_some() {
                    return None;
                }
            }
        }
        let inner = |a: usize, b: usize| far.contains_key(&(a, b)) && far.contains_key(&(b, a));
        let folded = far.keys().any(|&(a, b)| chains.terms.prices.neighbours(a, b) && inner(a, b));
        (!folded).then_some(Self { far })
    }

    /// Whether the triangles around each sample hang together: one fan from edge to edge.
    pub(super) fn fans_are_whole(&self, triangles: &[[usize; 3]]) -> bool {
        let mut at: BTreeMap<usize, usize> = BTreeMap::new();
        for &corner in triangles.iter().flatten() {
            *at.entry(corner).or_default() += 1;
        }
        // Where a side leaves a sample that no triangle walks back along, a fan begins.
        let begins: Vec<(usize, usize)> =
            self.far.keys().copied().filter(|&(a, b)| !self.far.contains_key(&(b, a))).collect();
        begins.len() == at.len()
            && begins.iter().all(|&(sample, first)| {
                let (mut turned, mut next) = (0, first);
                while let Some(&far) = self.far.get(&(sample, next)) {
                    turned += 1;
                    next = far;
                }
                at.get(&sample) == Some(&turned)
            })
    }

    /// The closed chains that bound the surface when it is cut along `cuts`, that of sample 0
    /// first.
    fn bounds(&self, chains: &Chains<'_>, cuts: &[[usize; 2]]) -> Vec<Vec<usize>> {
        let is_border = |a: usize, b: usize| {
            chains.terms.prices.neighbours(a, b) || cuts.contains(&[a.min(b), a.max(b)])
        };
        let mut left: BTreeMap<(usize, usize), ()> =
            self.far.keys().filter(|&&(a, b)| is_border(a, b)).map(|&side| (side, ())).collect();
        let mut bounds = Vec::new();
        while let Some((start, ())) = left.pop_first() {
            let (mut chain, mut side) = (vec![start.0], start);
            loop {
                // Round the end of the side, from triangle to triangle, to the next border.
                let end = side.1;
                let mut next = self.far[&side];
                while !is_border(end, next) {
                    next = self.far[&(next, end)];
                }
                side = (end, next);
                if side == start {
                    break;
                }
                left.remove(&side);
                chain.push(end);
            }
            bounds.push(chain);
        }
        bounds
    }
}

/// The best triangulation that the replacement of cuts finds within the work limit, beginning with
/// `best`.
pub(super) fn improved(
    chains: &Chains<'_>,
    mut best: Solved,
    watch: &mut dyn Watch,
) -> Result<Solved, TriangulateError> {
    let mut left = 1.0;
    for _ in 0..MOST_ROUNDS {
        let mut better = false;
        for kind in [Prefer::Short, Prefer::Long, Prefer::Straight] {
            // How many rounds it takes is not known: each gets a part of what is left.
            let mut part = Part::new(watch, 1.0 - left..1.0 - 0.8 * left);
            better |= improve(chains, &mut best, kind, &mut part)?;
            left *= 0.8;
        }
        if !better || chains.work.is_out() {
            break;
        }
    }
    Ok(best)
}

/// Limit of the rounds of improvement; two or three are usual.
const MOST_ROUNDS: usize = 6;

/// Which rungs are kept as cuts.
#[derive(Clone, Copy)]
enum Prefer {
    Short,
    Long,
    /// Those with the least twist.
    Straight,
}

/// A first triangulation: the loops are tied together by the shortest rungs. `None` if there is
/// none up to `bound`, or none was found up to it. Without a bound one is found wherever there is
/// one: on a plane a domain that is cut open is a polygon, whose rungs lie apart, and without a
/// plane see [`zigzag`].
pub(super) fn first(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut cut = chains.clone();
    while cut.chains.len() > 1 {
        let mut shortest: Option<(f64, Spot, Spot)> = None;
        for (chain, list) in cut.chains.iter().enumerate().skip(1) {
            for q in (0..list.len()).map(|at| Spot { chain, at }) {
                cut.work.count(cut.len(0) as u64);
                for p in (0..cut.len(0)).map(|at| Spot { chain: 0, at }) {
                    let length = cut.terms.prices.length(cut.sample(p), cut.sample(q));
                    if shortest.is_none_or(|(least, ..)| length < least)
                        && cut.side(p, q).price < f64::INFINITY
                    {
                        shortest = Some((length, p, q));
                    }
                }
            }
        }
        let Some((_, p, q)) = shortest else { return Ok(None) };
        cut = cut.with_cut(p, q);
    }
    let found = polygon::solve_simple(&cut, bound, watch)?;
    if found.is_some() || chains.has_plane() || bound < f64::INFINITY {
        return Ok(found);
    }
    // Any two samples may be joined, so this always finds one.
    Ok(zigzag::nested(chains))
}

/// Replaces the cuts of one choice, one after the other; returns whether that lowered the price.
fn improve(
    chains: &Chains<'_>,
    best: &mut Solved,
    prefer: Prefer,
    watch: &mut dyn Watch,
) -> Result<bool, TriangulateError> {
    let mut better = false;
    let holes = chains.chains.len() - 1;
    for left_out in 0..holes {
        if chains.work.is_out() {
            break;
        }
        watch.progress((left_out as f64 / holes as f64).max(chains.work.share()));
        let Some(sides) = Sides::new(chains, &best.triangles) else { return Ok(better) };
        let mut cuts = tree(chains, &sides, prefer);
        if left_out >= cuts.len() {
            break;
        }
        cuts.remove(left_out);
        let ring = Chains { chains: sides.bounds(chains, &cuts), cuts, ..chains.clone() };
        if ring.chains.len() != 2 {
            continue;
        }
        let of_cuts = ring.price_of_cuts();
        if let Some(solved) = band::solve(&ring, best.price - of_cuts, &mut Part::silent(watch))?
            && solved.price + of_cuts < best.price
            && Sides::new(chains, &solved.triangles).is_some()
        {
            *best = Solved { price: solved.price + of_cuts, ..solved };
            better = true;
        }
    }
    Ok(better)
}

/// Rungs that tie all loops together, those that are preferred first.
fn tree(chains: &Chains<'_>, sides: &Sides, prefer: Prefer) -> Vec<[usize; 2]> {
    let mut of_loop = BTreeMap::new();
    for (chain, list) in chains.chains.iter().enumerate() {
        of_loop.extend(list.iter().map(|&sample| (sample, chain)));
    }
    let mut joining: Vec<(f64, [usize; 2])> = sides
        .far
        .keys()
        .filter(|(a, b)| a < b && of_loop[a] != of_loop[b])
        .map(|&(a, b)| {
            let length = chains.terms.prices.length(a, b);
            let key = match prefer {
                Prefer::Short => length,
                Prefer::Long => -length,
                Prefer::Straight => chains.terms.side(a, b).price,
            };
            (key, [a, b])
        })
        .collect();
    joining.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut group: Vec<usize> = (0..chains.chains.len()).collect();
    let mut tree = Vec::new();
    for (_, [a, b]) in joining {
        let (a_group, b_group) = (group[of_loop[&a]], group[of_loop[&b]]);
        if a_group != b_group {
            for member in &mut group {
                if *member == b_group {
                    *member = a_group;
                }
            }
            tree.push([a, b]);
        }
    }
    tree
}

/// The chain that is left when a triangulation is cut along rungs that tie all loops together. Its
/// last edge, to its first sample, is an edge of the boundary.
pub(super) fn one_chain(chains: &Chains<'_>, best: &Solved) -> Vec<usize> {
    let Some(sides) = Sides::new(chains, &best.triangles) else { return Vec::new() };
    let mut chain = sides.bounds(chains, &tree(chains, &sides, Prefer::Short)).swap_remove(0);
    let edge = |at: usize| {
        let before = chain[(at + chain.len() - 1) % chain.len()];
        chains.terms.prices.neighbours(before, chain[at])
    };
    if let Some(start) = (0..chain.len()).find(|&at| edge(at)) {
        chain.rotate_left(start);
    }
    chain
}
