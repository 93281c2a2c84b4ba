//! All pruning: what the table leaves out, since it can't be part of the answer.
//!
//! To read this folder is a choice. The table ([`super::table`]) asks what stands in its trait
//! [`Pruning`] and nothing else, and gives the same triangles and the same bits of the price where
//! nothing is left out; the tests compare both.
//!
//! Prices are never negative, so no entry above the price of a known triangulation, U, is a part of
//! the answer. Each file has one bound that says which are:
//!
//! - `upper_bound` finds U: what the cheapest triangulation costs near to that of the loop of every
//!   fourth sample (`thinned`), in a `band` of the table. Without it 400 samples take 2.3 times as
//!   long with the fold price and 1.2 times without, 1,600 samples 17 and 4.7 times.
//! - `warm_start` has U for little while a handle is dragged: what the triangulation from one move
//!   before costs now, mended by exchanges of rungs. Without it a move of 400 samples takes 1.25 to
//!   1.9 times as long.
//! - `spans` bounds the price of any rung between two runs of 16 samples from below: no rung of a
//!   tile costs less. Without it 1,600 samples take 1.17 and 1.06 times as long.
//! - `completion_bound` bounds what the rest of the loop costs beside a rung, from the loop as seen
//!   from afar, by runs of samples (coarse to fine \[Raphael2001\], abstraction \[FM07\]). Without
//!   it 1,600 samples take 1.6 times as long with the fold price, the twisted strip 6 times.

mod band;
mod completion_bound;
mod spans;
mod upper_bound;
pub(in crate::triangulate) mod warm_start;

use super::table::{Pruning, Table, Unpruned};
use crate::cost::{FarEnds, LANES, Lanes};
use crate::triangulate::part::Part;
use crate::triangulate::{Solved, Terms, TriangulateError};
use band::Band;
use completion_bound::CompletionBound;
use sheetwright_geometry::watch::Watch;
use spans::Spans;
use std::ops::Range;

/// Above it no bound is tried: a boundary like that needs all entries.
const HIGHEST_BOUND: f64 = 100.0;
/// With fewer samples it takes longer, on the whole, to look first at what the rest of the loop
/// costs than that saves: at 400 a strip takes 0.65 times as long with it, but random curves 1.1 to
/// 1.3 times.
const LEAST_COMPLETED: usize = 640;
/// The share of the time that it takes, about.
const SHARE_OF_COMPLETION: f64 = 0.3;

/// The cheapest triangulation; `None` if there is none.
pub(in crate::triangulate) fn solve_priced(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut table = Table::new(terms);
    let mut left = 1.0;
    for bound in upper_bound::bounds(&mut table, &mut Part::silent(watch))? {
        // How many bounds it takes is not known: each gets half of what is left of the progress.
        let share = 1.0 - left..1.0 - 0.5 * left;
        let price = fill(&mut table, bound, None, watch, share)?;
        if price < f64::INFINITY {
            return Ok(Some(Solved { price, triangles: table.trace() }));
        }
        left *= 0.5;
    }
    Ok(None)
}

/// The triangles of the cheapest triangulation up to the price `bound`, and that price; `None` if
/// there is none.
pub(in crate::triangulate) fn solve_within(
    terms: &Terms<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut table = Table::new(terms);
    let bound = if bound > HIGHEST_BOUND { f64::INFINITY } else { bound };
    let price = fill(&mut table, bound, None, watch, 0.0..1.0)?;
    Ok((price < f64::INFINITY).then(|| Solved { price, triangles: table.trace() }))
}

/// Fills the table with all entries that may be part of a triangulation up to `bound`, those of
/// rungs outside the band excepted, and returns the price of the answer. `share` is the part of the
/// progress that this is.
fn fill(
    table: &mut Table<'_>,
    bound: f64,
    band: Option<&Band>,
    watch: &mut dyn Watch,
    share: Range<f64>,
) -> Result<f64, TriangulateError> {
    if bound == f64::INFINITY && band.is_none() {
        return table.fill(&Unpruned, watch, share);
    }
    table.clear();
    let terms = table.terms;
    let mut pruned = Pruned { spans: Spans::new(terms, bound), band, completion: None };
    let mut start = share.start;
    let tells = terms.folds() && terms.prices.in_order() && table.m >= LEAST_COMPLETED;
    if tells && bound <= HIGHEST_BOUND && band.is_none() {
        let runs = CompletionBound::runs(terms);
        let needed = CompletionBound::most_bytes(&runs);
        if table.bytes().saturating_add(needed) <= terms.memory {
            start += SHARE_OF_COMPLETION * (share.end - share.start);
            let part = &mut Part::new(watch, share.start..start);
            let completion =
                CompletionBound::new(runs, terms, table.registers, &pruned.spans, part)?;
            pruned.completion = Some(completion);
        }
    }
    table.fill(&pruned, watch, start..share.end)
}

/// What all bounds leave open.
struct Pruned<'a> {
    spans: Spans,
    /// Only rungs of it.
    band: Option<&'a Band>,
    completion: Option<CompletionBound>,
}

impl Pruning for Pruned<'_> {
    fn bound(&self) -> f64 {
        self.spans.bound
    }

    fn least(&self, row: usize, column: usize) -> f64 {
        if self.spans.has_edges(row, column) {
            return 0.0;
        }
        let is_near = |band: &Band| band.has(self.spans.run(row), self.spans.run(column));
        let rest = self.completion.as_ref().map_or(0.0, |of| of.least(row, column));
        if rest == f64::INFINITY || !self.band.is_none_or(is_near) {
            return f64::INFINITY;
        }
        let rung = self.spans.least(row, column);
        (0.5 * rung + rest).max(rung)
    }

    fn rests(&self, i: usize, to: &FarEnds) -> Lanes {
        if let Some(completion) = &self.completion {
            return completion.row(i, to.first);
        }
        let Some(band) = self.band else { return [0.0; LANES] };
        let near = band.lanes(i, to);
        let is_in = |n: usize| near[n] || to.first + n <= i + 1;
        std::array::from_fn(|n| if is_in(n) { 0.0 } else { f64::INFINITY })
    }

    fn bytes(&self) -> u64 {
        self.completion.as_ref().map_or(0, CompletionBound::bytes)
    }
}

/// Fills a table with all bounds that there are but a band.
#[cfg(test)]
pub(super) fn fill_up_to(
    table: &mut Table<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<f64, TriangulateError> {
    fill(table, bound, None, watch, 0.0..1.0)
}

#[cfg(test)]
mod tests;
