//! The cheapest triangulation of all: equations (2) and (5) as one triangular table.
//!
//! 1. The edge ⟨0, m−1⟩ belongs to every triangulation, so one table serves the whole loop. Let
//!    E(i,j) be the least price of the part of the loop from i to j *with* the rung ⟨i,j⟩; it is 0
//!    for an edge of the boundary. Then equation (5) reads
//!    E(i,j) = w(i,j) + min over i<k<j of E(i,k) + E(k,j) + F(i,k,j),
//!    with F the fold price of the triangle. Θ(m³) sums, Θ(m²) memory.
//! 2. The table is kept in tiles of 16 × 16. A few columns of them are filled together, from the
//!    diagonal upwards, so that shared data comes from the processor's cache. The innermost loop
//!    runs over 16 j side by side, for one i and one k, which the compiler vectorises for the
//!    widest registers of the processor (crate `pulp`; the bits are the same with any). With the
//!    feature `rayon`, threads share the tiles of a diagonal, which do not depend on one another
//!    (`table/shared`).
//! 3. Prices are never negative, so no entry above the price of a known triangulation is a part of
//!    the optimum. The loop of the corners and every fourth sample gives such an upper bound
//!    (`upper_bound`): only rungs near to the rungs of its optimum are priced and combined (a band
//!    of the table). That is cheap, and gives the optimum or a price near to it. In the table of
//!    all rungs, entries above the upper bound are dropped:
//!
//!    * A tile is skipped if lower bounds from the samples of its rows and columns exclude all of
//!      its rungs (`prune`).
//!    * Its rungs are not priced if the least entries of the tiles between exclude all of its
//!      entries (`table/between`).
//!    * A tile without finite entries is not stored; tiles of flat stretches are stored once
//!      (`tile_pool`).
//!
//!    Next to a developable surface, the number of entries left grows like m^1.5. While a handle is
//!    dragged, the previous triangulation gives the upper bound instead (`warm_start`). From some
//!    hundred samples on and with folds, a lower bound on the price of the rest of the loop beside
//!    each rung leaves even fewer (`completion_bound`).
//! 4. The k that were best one row below come first, and then all triangles i, j − 1, j on edges of
//!    the boundary at once (`table/entries`), so that few others can lower the price. The others
//!    are taken tile by tile, where both tiles are stored, through tests that get more and more
//!    precise:
//!
//!    * The least entries of two tiles, with the least F for the boxes of their N (`normals`), may
//!      rule out both.
//!    * E(i,k) and the least E(k,j) of the 16 j are compared for 16 k at once.
//!    * F is never negative and expensive. So for 16 k, the share of the side ⟨i,k⟩ in F is bounded
//!      for all 16 j together, which leaves out a tenth to a third of them.
//!    * The sums E(i,k) + E(k,j) are compared, 16 j at a time.
//!    * A test without root and quotient decides whether F may be low enough; only then F is
//!      computed.
//! 5. The best k is not stored but found again on the way back, for the m − 2 entries of the
//!    optimum, among those that give the price. Of equal prices (prices are exact, see
//!    [`crate::cost`], so flat regions do tie) the k with the least |P_i P_k| + |P_k P_j| wins,
//!    then the smallest: strips of compact triangles rather than fans.

mod band;
mod completion_bound;
mod lanes;
mod normals;
mod prune;
mod table;
mod threads;
mod tile_pool;
mod upper_bound;

use super::{Solved, Terms, TriangulateError, if_it_fits};
use crate::cost::LANES;
use crate::rung::Visibility;
use sheetwright_geometry::watch::Watch;
use table::Table;

pub(super) use upper_bound::{price_near, solve_priced};

/// Larger bounds are not tried: such a boundary needs all entries.
const HIGHEST_BOUND: f64 = 100.0;

/// Upper bound on the memory of the tables of m samples, bytes: the table of all rungs with folds,
/// the pairs that see one another, and both again for each thinned loop, a sixteenth of the one
/// before.
pub fn memory_needed(m: usize) -> u64 {
    let seen = Visibility::memory_needed(m);
    (tile_pool::most_bytes(m.div_ceil(LANES)) + seen).div_ceil(15) * 16
}

/// Lower bound on the memory of the tables of m samples, bytes: no tile has a finite entry, and no
/// pairs that see one another are stored.
pub(super) fn least_memory_needed(m: usize) -> u64 {
    tile_pool::least_bytes(m.div_ceil(LANES)).div_ceil(15) * 16
}

/// The triangles of the cheapest triangulation; `None` if there is none. Given a `bound` on its
/// price, no other is computed.
pub(super) fn solve(
    terms: &Terms<'_>,
    bound: Option<f64>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    if let Some(bound) = bound.filter(|bound| *bound <= HIGHEST_BOUND)
        && let Some(solved) = if_it_fits(solve_within(terms, bound, watch))?
    {
        return Ok(Some(solved.triangles));
    }
    Ok(solve_priced(terms, watch)?.map(|solved| solved.triangles))
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
