//! The cheapest triangulation of all, found and proved among few rungs.
//!
//! The dense table (`optimal`) works out E(i,j) for every pair of samples. Next to a developable
//! surface nearly all of them are in vain. Here they are ruled out first, by bounds that hold for
//! every triangulation, and the table is filled for those that are left; the answer is the same,
//! bit by bit, ties included.
//!
//! 1. **A good triangulation** (`corridor`). Every fourth sample is solved, by the same means; its
//!    rungs, widened by a block of four samples at both ends, are a corridor in which the table
//!    finds a triangulation of all samples. Its price U is nearly always the optimum already; what
//!    follows proves that, or finds what is better. A triangulation cheaper than U, or as cheap,
//!    is called good.
//! 2. **Blocks** (`blocks`, `sweep`). Contract neighbouring samples to blocks of 2, 4, 8 … In a
//!    triangulation of the samples, the triangles with two corners in one block collapse, and what
//!    is left is a triangulation of the polygon of blocks. Each of its rungs stands for at least
//!    one rung of the samples, and each of its triangles for just one triangle. So the table over
//!    blocks, with the least price of a rung between two blocks and the least of a fold price
//!    between three, is a lower bound: inner side plus outer side of a pair of blocks exceeds U
//!    only if no rung between them is part of a good triangulation. From the top down, only parts
//!    of pairs that were left are looked at, so that no level looks at all pairs. What is known of
//!    all rungs between two blocks comes from cones of their tangents and positions. A fold price
//!    is at least ν/6 Σ |N − N′|² over the pairs of sides, whatever the triangle's normal: no unit
//!    n makes Σ (1 − n·N) less than 3 − |Σ N| ≥ (9 − |Σ N|²) / 6.
//! 3. **Debts** (`debts`). The bounds of step 2 are weak where rungs are cheap and what they force
//!    upon others is not. So each edge of the boundary asks for a price, and what the triangles on
//!    it do not pay is passed on as a debt. Where all debts are paid in the end, what the edges ask
//!    for together is a lower bound on every good triangulation (the dual of the linear relaxation
//!    of triangulations, as in `holes::bound`); it is nearly always U itself next to a developable
//!    surface, and then the outer side of every rung has a bound that is as good.
//! 4. **The table** (`table`) of what is left, with equation (5) as it is and the dense table's rule
//!    for equals.
//!
//! All prices are whole quanta and the debts half quanta, so that the bounds of steps 3 and 4 are
//! exact; those of step 2 are worked out in f32 with an allowance for every rounding.
//!
//! Far from a developable surface the bounds rule out little. Where step 2 leaves most pairs, or
//! where no corridor has a triangulation, the dense table takes over; by then a small part of its
//! time is spent.

mod blocks;
mod corridor;
mod debts;
mod sweep;
mod table;

use super::part::Part;
use super::{Solved, Terms, TriangulateError, optimal};
use crate::watch::Watch;
use blocks::{Blocks, levels};
use corridor::corridor;
use debts::Debts;
use sweep::{Alive, Sweep};
use table::Table;

/// Loops with fewer samples are left to the dense table.
const LEAST_SAMPLES: usize = 500;
/// So are those with fewer samples than this if it fits: it is faster there, or as fast.
const FASTER_FROM: usize = 8000;
/// The same for the loops of fewer samples on the way.
const LEAST_THINNED: usize = 200;
/// One sample in so many is kept on the way.
const THINNING: usize = 4;
/// Levels of blocks end where no more than this are left: all their pairs are few.
const TOP: usize = 40;
/// The lowest level of blocks: four samples each.
const LOWEST: usize = 2;
/// Loops with fewer samples have tables so small that looking for debts would cost more.
const LEAST_WITH_DEBTS: usize = 2048;
/// Loops of the samples on the way up to this length show whether debts can be paid.
const ALWAYS_WITH_DEBTS: usize = 1024;
/// The share of the price up to which debts must bound it, for them to be looked for among four
/// times as many samples.
const TIGHT: f64 = 0.95;
/// Answers that cost more are left to the dense table.
const HIGHEST_PRICE: f64 = 100.0;
/// The share of all pairs of blocks above which the dense table takes over.
const MOST_ALIVE: f64 = 0.8;
/// From so many blocks on, that is decided at every level: the next would cost much.
const MANY_BLOCKS: usize = 1000;
/// What a sample takes at least, bytes: the spread rows, the blocks and the debts.
const BYTES_A_SAMPLE: u64 = 2048;

/// What the tables of m samples take at least, bytes. How much more depends on the boundary; what
/// would exceed the limit is given up.
pub(super) fn memory_needed(m: usize) -> u64 {
    if m < LEAST_SAMPLES { u64::MAX } else { m as u64 * BYTES_A_SAMPLE }
}

/// The cheapest triangulation; `None` if that is left to the dense table. `memory` bounds what the
/// tables may take, bytes.
pub(super) fn solve(
    terms: &Terms<'_>,
    memory: u64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let m = terms.prices.len();
    let dense_is_better = m < FASTER_FROM && optimal::memory_needed(m) <= memory;
    if memory_needed(m) > memory || dense_is_better {
        return Ok(None);
    }
    let step = Step {
        memory,
        with_debts: m >= LEAST_WITH_DEBTS,
        least: LEAST_THINNED,
        top: TOP,
        most: MOST_ALIVE,
    };
    Ok(step.solve(terms, watch)?.map(|found| found.solved))
}

/// How the loops on the way are solved.
struct Step {
    memory: u64,
    /// Whether debts are looked for.
    with_debts: bool,
    /// Loops with fewer samples have the dense table.
    least: usize,
    /// The highest level of blocks has no more than this.
    top: usize,
    /// The share of all pairs of blocks above which the dense table takes over.
    most: f64,
}

/// A triangulation, and whether its debts bound it well.
struct Found {
    solved: Solved,
    is_tight: bool,
}

impl Step {
    fn solve(
        &self,
        terms: &Terms<'_>,
        watch: &mut dyn Watch,
    ) -> Result<Option<Found>, TriangulateError> {
        let m = terms.prices.len();
        if m < self.least {
            let solved = optimal::solve_priced(terms, &mut Part::silent(watch))?;
            return Ok(solved.map(|solved| Found { solved, is_tight: true }));
        }
        let thinned = terms.thinned(THINNING);
        let Some(few) = self.solve(&thinned.terms(), &mut Part::silent(watch))? else {
            return Ok(None);
        };
        watch.progress(0.25);
        let levels = levels(terms, self.top);
        let Some(lowest) = levels.get(LOWEST) else { return Ok(None) };
        let Some(known) = self.known(terms, lowest, &few.solved, watch)? else { return Ok(None) };
        watch.progress(0.5);
        let Some(alive) = self.alive(terms, &levels, known.price, watch)? else { return Ok(None) };
        watch.progress(0.6);
        let debts = if self.with_debts && (few.is_tight || m < ALWAYS_WITH_DEBTS) {
            Debts::new(terms, lowest, &alive, &known, watch)?
        } else {
            None
        };
        watch.progress(0.75);
        let is_tight = debts.as_ref().is_some_and(|debts| debts.bound >= TIGHT * known.price);
        let table =
            Table::fill(terms, lowest, &alive, debts.as_ref(), known.price, self.memory, watch)?;
        let solved = table.and_then(|table| table.solved());
        Ok(solved.map(|solved| Found { solved, is_tight }))
    }

    /// A good triangulation, near that of fewer samples.
    fn known(
        &self,
        terms: &Terms<'_>,
        blocks: &Blocks,
        few: &Solved,
        watch: &mut dyn Watch,
    ) -> Result<Option<Solved>, TriangulateError> {
        let alive = corridor(blocks, few, THINNING, terms.prices.len());
        for bound in [few.price, HIGHEST_PRICE] {
            let table = Table::fill(terms, blocks, &alive, None, bound, self.memory, watch)?;
            if let Some(known) = table.and_then(|table| table.solved()) {
                return Ok(Some(known));
            }
        }
        Ok(None)
    }

    /// The pairs of blocks of the lowest level that rungs of good triangulations may join; `None`
    /// if they are too many.
    fn alive(
        &self,
        terms: &Terms<'_>,
        levels: &[Blocks],
        bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Option<Alive>, TriangulateError> {
        let top = levels.len() - 1;
        let mut alive = Alive::all(levels[top].len());
        for level in (LOWEST..=top).rev() {
            let upper = levels.get(level + 1);
            let blocks = &levels[level];
            let sweep = Sweep::inside(terms, blocks, upper, &alive, bound, self.memory, watch)?;
            let Some(sweep) = sweep else { return Ok(None) };
            alive = sweep.outside(watch)?;
            let n = blocks.len() as f64;
            let is_decided = level == LOWEST || blocks.len() >= MANY_BLOCKS;
            if is_decided && alive.len() as f64 > self.most * 0.5 * n * n {
                return Ok(None);
            }
        }
        Ok(Some(alive))
    }
}

#[cfg(test)]
mod tests;
