//! Fewer pieces: small ones are taken apart and grown again, together with what lies around them.
//! Then shorter cuts, less seen: a cut is folded in place of a cheaper fold of its piece, if the
//! piece does not overlap then.

use super::facets::Facets;
use super::grow::Pieces;
use super::order::{by, seam_cost};
use sheetwright_geometry::random::Random;
use sheetwright_geometry::watch::Watch;
use std::collections::VecDeque;

/// Tries without success before it ends.
const MOST_TRIES: usize = 300;

/// The work to copy a facet, in pairs that are compared.
const COPY_WORK: usize = 5;
/// A fold is cut in place of a cut if it costs less than this share.
const WORTH_IT: f64 = 0.9;
/// Folds of a piece that are tried in place of a cut.
const MOST_SWAPS: usize = 2;
/// How often all cuts are gone through.
const ROUNDS: usize = 4;

/// The pieces with as few of them as tries give, down to `enough`; `None` if the watcher asks to
/// stop.
pub(super) fn mended<'a>(
    mut best: Pieces<'a>,
    enough: usize,
    left: &mut usize,
    watch: &mut dyn Watch,
) -> Option<Pieces<'a>> {
    let mut random = Random::new(39);
    let mut tries = 0;
    best.work = 0;
    let mut work = 0;
    while best.count() > enough && tries < MOST_TRIES && work < *left {
        let mut tried = best.clone();
        if !change(&mut tried, &mut random, watch) {
            return None;
        }
        work += std::mem::take(&mut tried.work) + COPY_WORK * tried.facets.list.len();
        if is_no_worse(&tried, &best) {
            if tried.count() < best.count() {
                tries = 0;
            }
            best = tried;
        }
        tries += 1;
    }
    *left = left.saturating_sub(work);
    Some(best)
}

/// The pieces with shorter cuts: as many as before; `None` if the watcher asks to stop.
pub(super) fn tidied<'a>(
    mut pieces: Pieces<'a>,
    left: &mut usize,
    watch: &mut dyn Watch,
) -> Option<Pieces<'a>> {
    let facets = pieces.facets;
    let image = |n: usize| pieces.mirror.map_or(n, |mirror| mirror.image(n));
    let images: Vec<usize> = (0..facets.hinges.len()).map(image).collect();
    let cost = |n: usize| 0.5 * (seam_cost(facets, n) + seam_cost(facets, images[n]));
    // A pair of folds takes the place of a pair of cuts, one of one.
    let takes_place = |fold: usize, cut: usize| (images[fold] == fold) == (images[cut] == cut);
    let dearest = by(facets, |n| -cost(n) / facets.size_mm);
    pieces.work = 0;
    'rounds: for _ in 0..ROUNDS {
        // Rounding might keep a fold from being folded again.
        let before = pieces.clone();
        if watch.stop() {
            return None;
        }
        let mut is_better = false;
        for &cut in &dearest {
            let [a, b] = facets.hinges[cut].facets;
            let is_given = facets.hinges[cut].is_seam;
            if is_given || pieces.folded[cut] || pieces.of_facet[a] != pieces.of_facet[b] {
                continue;
            }
            if pieces.work > *left {
                break 'rounds;
            }
            pieces.work += facets.list.len();
            let mut way = way(&pieces, a, b);
            way.sort_by(|&m, &n| cost(m).total_cmp(&cost(n)).then(m.cmp(&n)));
            let cheaper =
                way.into_iter().filter(|&n| takes_place(n, cut) && cost(n) < WORTH_IT * cost(cut));
            for fold in cheaper.take(MOST_SWAPS) {
                pieces.unfold(&[fold]);
                // Round a flat vertex, the fold closed again by itself.
                if pieces.folded[fold] {
                    continue;
                }
                if pieces.fold(cut) {
                    is_better = true;
                    break;
                }
                if !pieces.fold(fold) {
                    return Some(before);
                }
            }
        }
        if !is_better {
            break;
        }
    }
    *left = left.saturating_sub(pieces.work);
    Some(pieces)
}

/// The folds on the shortest way from one facet of a piece to another.
fn way(pieces: &Pieces<'_>, from: usize, to: usize) -> Vec<usize> {
    let facets = pieces.facets;
    let mut by: Vec<Option<usize>> = vec![None; facets.list.len()];
    let mut waiting = VecDeque::from([from]);
    let across = |n: usize, f: usize| {
        let [a, b] = facets.hinges[n].facets;
        if a == f { b } else { a }
    };
    while let Some(here) = waiting.pop_front().filter(|&here| here != to) {
        for &n in facets.list[here].hinges.iter().filter(|&&n| pieces.folded[n]) {
            let there = across(n, here);
            if there != from && by[there].is_none() {
                by[there] = Some(n);
                waiting.push_back(there);
            }
        }
    }
    let mut way = Vec::new();
    let mut at = to;
    while let Some(n) = by[at].filter(|_| at != from) {
        way.push(n);
        at = across(n, at);
    }
    way
}

/// Takes a small piece apart with some folds of its neighbours, and grows all of it again;
/// `false` if the watcher asks to stop.
fn change(pieces: &mut Pieces<'_>, random: &mut Random, watch: &mut dyn Watch) -> bool {
    let facets = pieces.facets;
    let mut sizes: Vec<(usize, usize)> = (0..pieces.members.len())
        .map(|n| (pieces.members[n].len(), n))
        .filter(|&(size, _)| size > 0)
        .collect();
    sizes.sort_unstable();
    // Of the smaller half of the pieces, mostly the smallest.
    let most = 1 + random.below(8);
    let pick = random.below(sizes.len().div_ceil(2).min(most));
    let piece = sizes[pick].1;
    let mut loose = vec![false; facets.list.len()];
    let mut around: Vec<usize> = pieces.members[piece].clone();
    around.iter().for_each(|&f| loose[f] = true);
    let rings = 1 + random.below(3);
    let mut from = 0;
    for _ in 0..rings {
        let to = around.len();
        for at in from..to {
            for &n in &facets.list[around[at]].hinges {
                for other in facets.hinges[n].facets {
                    if !loose[other] {
                        loose[other] = true;
                        around.push(other);
                    }
                }
            }
        }
        from = to;
    }
    let share = 0.3 + 0.7 * random.unit();
    let mut undone: Vec<usize> = Vec::new();
    for &f in &around {
        let own = pieces.of_facet[f] == piece;
        for &n in &facets.list[f].hinges {
            if pieces.folded[n] && (own || random.unit() < share) {
                undone.push(n);
            }
        }
    }
    pieces.unfold(&undone);
    let noise: Vec<f64> = facets.hinges.iter().map(|_| random.unit()).collect();
    let mean =
        facets.hinges.iter().map(|h| h.length_mm).sum::<f64>() / facets.hinges.len().max(1) as f64;
    let weight = random.unit();
    let order = by(facets, |n| noise[n] - weight * (facets.hinges[n].length_mm / mean).min(2.0));
    // Pieces that were not touched did not go together before.
    let mut touched = vec![false; facets.list.len()];
    around.iter().for_each(|&f| touched[pieces.of_facet[f]] = true);
    let joins = |n: &usize| {
        let [a, b] = facets.hinges[*n].facets.map(|f| pieces.of_facet[f]);
        a != b && (touched[a] || touched[b])
    };
    let order: Vec<usize> = order.into_iter().filter(joins).collect();
    let order =
        pieces.mirror.map_or(order.clone(), |mirror| mirror.arranged(facets, &order, false));
    pieces.grow(&order, watch)
}

/// Fewer pieces; or as many, and more facets in large ones: a piece that shrinks can vanish.
fn is_no_worse(tried: &Pieces<'_>, best: &Pieces<'_>) -> bool {
    let squares = |pieces: &Pieces<'_>| -> usize {
        pieces.members.iter().map(|members| members.len() * members.len()).sum()
    };
    let (own, others) = (tried.count(), best.count());
    own < others || (own == others && squares(tried) >= squares(best))
}

/// How many pieces there are at the least: facets that hang together at all.
pub(super) fn components(facets: &Facets) -> usize {
    let mut sets = sheetwright_geometry::disjoint::DisjointSets::new(facets.list.len());
    let open = facets.hinges.iter().filter(|h| !h.is_seam);
    let joins = open.filter(|h| sets.join(h.facets[0], h.facets[1])).count();
    facets.list.len() - joins
}
