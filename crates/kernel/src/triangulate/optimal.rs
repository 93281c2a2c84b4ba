//! The cheapest triangulation of all: equations (2) and (5) as one triangular table.
//!
//! 1. The edge ⟨0, m−1⟩ belongs to every triangulation, so one table answers the whole loop. Let
//!    E(i,j) be the least price of the part of the loop from i to j *with* the rung ⟨i,j⟩; it is 0
//!    for an edge of the boundary. Then equation (5) reads
//!    E(i,j) = w(i,j) + min over i<k<j of E(i,k) + E(k,j) + F(i,k,j),
//!    with F the fold price of the triangle. Θ(m³) sums, Θ(m²) memory.
//! 2. The table is kept in tiles of 16 × 16. A few columns of them are filled together, from the
//!    diagonal upwards, so that what they share comes from the processor's cache. The innermost loop
//!    runs over 16 j side by side, for one i and one k, which the compiler vectorises for the widest
//!    registers that the processor has (crate `pulp`; the bits are the same with any). With the feature
//!    `rayon`, threads share the tiles of diagonals, which need nothing of one another (`table/shared`).
//! 3. Prices are never negative, so no entry above the price of a known triangulation is a part of the
//!    answer. One is found by way of the loop of the corners and every fourth sample (`thinned`): only
//!    rungs near to the rungs of its optimum are priced and put together (a band of the table), which is
//!    cheap, and near to the optimum or the optimum itself. In the table of all rungs, entries above
//!    that price are then dropped. Where the samples of a tile's rows and columns show that none of its
//!    rungs can cost so little (`span`), the tile is not looked at, and where the least entries of the
//!    tiles between show that none of its own can, its rungs are not priced (`table/between`); where
//!    none of its entries is left, it is not kept, and those of flat stretches are kept once for all of
//!    them (`store`), in planes along the axes without a look at their rungs (`flat`). Next to a
//!    developable surface so few are left that their number grows like m^1.5.
//!    Far from one, where the band is dearer than the thinned loop, its optimum may have another shape
//!    than that of all samples; then the thinned loop is solved with cheaper folds as well, and the
//!    cheaper of two bands is the bound. If none has a triangulation, the bound is guessed from the
//!    optimum of the thinned loop, and raised until there is an answer below it. While a handle is
//!    dragged, the triangulation from before gives a bound instead (`mend`). From some hundred samples on and
//!    with folds, even fewer are left, since it is worked out first what the rest of the loop costs beside
//!    each rung (`outside`).
//! 4. Those k come first that were best one row below, and then all triangles i, j − 1, j on edges of the
//!    boundary at once (`table/entries`), so that few others are left to be looked at.
//!    These are taken tile by tile, where both tiles are kept. Their least entries, together with the
//!    least F where N lie as theirs (`normals`), may rule out two tiles at once. Else E(i,k) and the
//!    least E(k,j) of the 16 j together say for 16 k at once which may lie below the prices so far. F is
//!    never negative, and dear to work out. So for the same 16 k, the share that the side ⟨i,k⟩ has in
//!    it is bounded for all 16 j together, which leaves out a tenth to a third of them. For the others,
//!    the sums E(i,k) + E(k,j) are compared, 16 j at a time. Where one lies below, a test without root
//!    and quotient says whether F may leave it there, and only then F is worked out.
//! 5. Which k was best is not stored but found again on the way back, for the m − 2 entries that
//!    belong to the answer, among those that make its price. Of equal prices (prices are exact, see
//!    [`crate::cost`], so flat regions do tie) the k with the least |P_i P_k| + |P_k P_j| wins, then the
//!    smallest: strips of compact triangles rather than fans.

mod flat;
mod lanes;
mod near;
mod normals;
mod open;
mod outside;
mod store;
mod table;
mod threads;

use super::part::Part;
use super::thinned::kept;
use super::{Solved, Terms, TriangulateError, if_it_fits};
use crate::cost::{LANES, quantised};
use crate::rung::Visibility;
use crate::watch::Watch;
use near::Band;
use table::Table;

/// Loops with fewer samples are solved without a bound: it would cost more than it saves.
const LEAST_THINNED: usize = 64;
/// How much more than that of the thinned loop the answer may cost, where its rungs lead to none.
const GUESSES: [f64; 2] = [1.3, 5.2];
/// A table has so many times the tiles of the thinned loop's, each counted with entries up to its own
/// price: the first next to a developable surface, the second where all are there.
const GROWTH: [f64; 2] = [6.0, 16.0];
/// The least growth, and the least as a share of the growth one step before. On the families and the planks of
/// 2,600 to 16,000 samples, with folds, they were 3.74 (*wavy* of 2,600, whose thinned loop has hardly enough
/// samples for `outside`; 4.02 on all others) and 0.80.
/// Flat tiles, stored once, may make it less: 1.86 where all lies in one plane (1,200 to 4,000 samples): such
/// a loop may be refused though it would just fit.
const LEAST_GROWTH: f64 = 3.5;
const LEAST_SHARE: f64 = 0.65;
/// Where the table may not fit, that of the thinned loop may take one part in so many of the memory.
/// With bounds as good as one another the table takes [`LEAST_GROWTH`] times as much or more, and would
/// not fit either.
const SHARE_OF_THINNED: u64 = 3;
/// Above it no bound is tried: a boundary like that needs all entries.
const HIGHEST_BOUND: f64 = 100.0;

/// What the tables of m samples take at the most, bytes: this one, with folds, who sees whom, and
/// the same of the thinned loops, a sixteenth each of the one before.
pub fn memory_needed(m: usize) -> u64 {
    let seen = Visibility::memory_needed(m);
    (store::most_bytes(m.div_ceil(LANES)) + seen).div_ceil(15) * 16
}

/// The same at the least, where hardly any entry can belong to the answer and nobody asks who sees
/// whom.
pub(super) fn least_memory_needed(m: usize) -> u64 {
    store::least_bytes(m.div_ceil(LANES)).div_ceil(15) * 16
}

/// The triangles of the cheapest triangulation; `None` if there is none. Its price is looked for below
/// these bounds first, one after the other.
pub(super) fn solve(
    terms: &Terms<'_>,
    bounds: &[f64],
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    for &bound in bounds.iter().filter(|bound| **bound <= HIGHEST_BOUND) {
        if let Some(solved) = if_it_fits(solve_within(terms, bound, watch))? {
            return Ok(Some(solved.triangles));
        }
    }
    Ok(solve_priced(terms, watch)?.map(|solved| solved.triangles))
}

/// The same, with its price.
pub(super) fn solve_priced(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    Ok(solve_in_table(terms, watch)?.map(|filled| filled.solved))
}

/// A table with what was found in it.
struct Filled<'a> {
    solved: Solved,
    table: Table<'a>,
    /// How many tiles it has with entries up to the price.
    tiles: usize,
    /// How many times the tiles of that of the thinned loop these are, if there is one that was filled in the
    /// same way.
    growth: Option<f64>,
}

/// The same, with the table.
fn solve_in_table<'a>(
    terms: &'a Terms<'a>,
    watch: &mut dyn Watch,
) -> Result<Option<Filled<'a>>, TriangulateError> {
    let mut table = Table::new(terms);
    let mut left = 1.0;
    let Bounds { bounds, tiles_of_thinned } = bounds(&mut table, watch)?;
    for bound in bounds {
        // Nobody knows how many bounds it takes: each gets half of what is left of the progress.
        let share = 1.0 - left..1.0 - 0.5 * left;
        let price = table.fill(bound, None, watch, share)?;
        if price < f64::INFINITY {
            let solved = Solved { price, triangles: table.trace() };
            let tiles = table.tiles_up_to(price);
            let growth = tiles_of_thinned.map(|few| tiles as f64 / few as f64);
            return Ok(Some(Filled { solved, table, tiles, growth }));
        }
        left *= 0.5;
    }
    Ok(None)
}

/// The triangles of the cheapest triangulation up to the price `bound`, and that price; `None` if
/// there is none.
pub(super) fn solve_within(
    terms: &Terms<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut table = Table::new(terms);
    let bound = if bound > HIGHEST_BOUND { f64::INFINITY } else { bound };
    let price = table.fill(bound, None, watch, 0.0..1.0)?;
    Ok((price < f64::INFINITY).then(|| Solved { price, triangles: table.trace() }))
}

/// Bounds to try on the price of the answer, one after the other; the last is none at all.
struct Bounds {
    bounds: Vec<f64>,
    /// How many tiles with entries up to its price the table of the thinned loop has.
    tiles_of_thinned: Option<usize>,
}

fn bounds(table: &mut Table<'_>, watch: &mut dyn Watch) -> Result<Bounds, TriangulateError> {
    let (terms, m) = (table.terms, table.m);
    let none = Bounds { bounds: vec![f64::INFINITY], tiles_of_thinned: None };
    if m < LEAST_THINNED {
        return Ok(none);
    }
    let kept = kept(terms);
    let thinned = terms.thinned(&kept);
    let may_fail = memory_needed(m) > terms.memory;
    let share = if may_fail { terms.memory / SHARE_OF_THINNED } else { terms.memory };
    let left = terms.memory.saturating_sub(table.bytes()).min(share);
    let few = thinned.terms().within(left);
    let too_large = |needed| TriangulateError::TooLarge { needed, limit: terms.memory };
    let coarse = solve_in_table(&few, &mut Part::silent(watch)).map_err(|error| match error {
        TriangulateError::TooLarge { needed, .. } => {
            too_large((table.bytes() + (GROWTH[0] * needed as f64) as u64).min(memory_needed(m)))
        }
        error => error,
    })?;
    let Some(Filled { solved: coarse, table: few, tiles, growth }) = coarse else {
        return Ok(none);
    };
    let places = table.bytes() + GROWTH[1] as u64 * few.bytes_of_places();
    let grown = |growth: f64| places + (growth * few.bytes_of(tiles) as f64) as u64;
    let growth = growth.unwrap_or(GROWTH[0]);
    // Of a table that alone has what the rest of the loop costs in view, the other tells nothing.
    let is_alike = few.has_outside() == table.has_outside();
    if may_fail && is_alike && grown(LEAST_GROWTH.max(LEAST_SHARE * growth)) > terms.memory {
        let expected = grown(growth.clamp(GROWTH[0], GROWTH[1]));
        return Err(too_large(expected.min(memory_needed(m))));
    }
    let tiles_of_thinned = is_alike.then_some(tiles);
    drop(few);
    let band = |triangles: &[[usize; 3]]| Band::along(triangles, &kept, m);
    let mut price = table.fill(f64::INFINITY, Some(&band(&coarse.triangles)), watch, 0.0..0.0)?;
    if terms.folds() && coarse.price <= HIGHEST_BOUND && price > coarse.price {
        let needed = memory_needed(kept.len()).min(share);
        table.clear_for(needed);
        let left = terms.memory.saturating_sub(table.bytes()).min(needed);
        let thinned = thinned.with_cheaper_folds();
        let few = thinned.terms().within(left);
        let other = if_it_fits(solve_in_table(&few, &mut Part::silent(watch)))?;
        if let Some(triangles) = other.map(|other| other.solved.triangles) {
            price = price.min(table.fill(price, Some(&band(&triangles)), watch, 0.0..0.0)?);
        }
    }
    let bounds = match price {
        _ if coarse.price.min(price) > HIGHEST_BOUND => vec![f64::INFINITY],
        f64::INFINITY => {
            let guessed = |guess: f64| quantised((guess * coarse.price).min(HIGHEST_BOUND));
            GUESSES.map(guessed).into_iter().chain([f64::INFINITY]).collect()
        }
        _ => vec![price],
    };
    Ok(Bounds { bounds, tiles_of_thinned })
}
