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
//! 3. F is never negative, and dear to work out: the sums E(i,k) + E(k,j) are compared first, and F
//!    is worked out for those 16 j of which one lies below the least so far. Where the least
//!    entries of the tiles between show that no entry of a tile lies below the bound, its rungs are
//!    not priced; where none of its entries does, it is not kept (`tile_pool`).
//! 4. What else is left out stands behind one door, the trait `table::Pruning` with a bound on the
//!    price and lower bounds for tiles and rungs. The folder `pruning` is behind it. Without it the
//!    table gives the same triangulation.
//! 5. Which k was best is not stored but found again on the way back, for the m − 2 entries that
//!    belong to the answer. Of equal prices (prices are exact, see [`crate::cost`], so flat regions
//!    do tie) the k with the least |P_i P_k| + |P_k P_j| wins, then the smallest: strips of compact
//!    triangles rather than fans.

mod lanes;
mod pruning;
mod table;
mod threads;
mod tile_pool;

use super::{Terms, TriangulateError, Triangulation, if_it_fits};
use crate::cost::LANES;
use crate::rung::Visibility;
use sheetwright_geometry::watch::Watch;

pub(super) use pruning::{solve_priced, solve_within, warm_start};
pub use threads::{is_on_one_thread, on_one_thread};

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

/// The triangles of the cheapest triangulation; `None` if there is none. Where one is `known` of
/// nearly the same boundary, what it costs now is a bound.
pub(super) fn solve(
    terms: &Terms<'_>,
    known: Option<&Triangulation>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    if let Some(bound) = warm_start::bound(terms, known, watch)?
        && let Some(solved) = if_it_fits(solve_within(terms, bound, watch))?
    {
        return Ok(Some(solved.triangles));
    }
    Ok(solve_priced(terms, watch)?.map(|solved| solved.triangles))
}
