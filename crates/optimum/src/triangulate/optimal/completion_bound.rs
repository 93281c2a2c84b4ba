//! What the rest of the loop costs at the least beside a rung: found among runs of neighbouring
//! samples.
//!
//! The table goes from short rungs to long ones, and keeps what costs little by itself. Short rungs
//! do so wherever they lie: the planes of one are near to the osculating plane of the boundary
//! there. But a triangle beyond it leans away from that plane, and its folds cost more than the
//! whole surface does. The table can't know that.
//!
//! So the loop is first looked at from afar, as in the coarse-to-fine search of \[Raphael2001\] and
//! the abstractions of \[FM07\]: its samples are put together to some hundred runs, and equation
//! (5) is solved for these, with prices that no triangle between three runs costs less than. What
//! that leaves for the rest of the loop is a bound for all rungs between two runs.
//!
//! 1. A triangle pays its folds and half the price of each of its rungs; all triangles of a
//!    triangulation pay its price. Let A, B … be runs. A triangle is *wide* if its corners belong
//!    to three of them, *thin* if just two belong to one. The rungs of a triangulation that join A
//!    and B follow one another, with thin triangles between them: a *bundle*. Bundles and wide
//!    triangles are a triangulation of the runs. The first sample and the last are runs of their
//!    own, so that none runs across the edge between them, and so are corners, unless there are
//!    many (`runs`).
//! 2. A wide triangle pays g or more: half of the least that rungs of its three bundles cost, and
//!    the least that its folds can cost, from where N of these rungs and the normal of the triangle
//!    lie (`cells`, `three_run_bound`). The edge from one run to the next is no rung; what
//!    triangles on it pay is known well, as the least over third corners in each run.
//! 3. The |A| − 1 edges within a run are sides of thin triangles, or lie below a *nibble*: a rung
//!    between two samples of A. The triangle beyond the outermost nibble is thin, too, with its
//!    third corner in another run. If each thin triangle with the third corner in X pays c or more
//!    for each edge of A on it or below its nibble, they pay (|A| − 1) c together in that X where c
//!    is least. So in one of its bundles each run is *charged*: with the least that triangles on
//!    its edges pay there, times their number, or with the least that a triangle beyond a nibble
//!    pays, if that is less.
//! 4. Let Q(A,B) be what is charged in the bundle of A and B and inside of it, with the wide
//!    triangles there, and R(A,B) the same outside of it. Each has four values, for whether A and
//!    whether B is charged inside or in the bundle. Then Q(A,B) = min over K of Q(A,K) + Q(K,B) +
//!    g(A,K,B), with K charged on one side, and with what A and B are charged, if they are; and R
//!    likewise, from outer bundles to inner ones.
//! 5. Outside of a rung ⟨i,j⟩ of that bundle are all other runs that are not inside. So with a
//!    bound U on the price, only entries of the table with E(i,j) − ½ w(i,j) + R(A,B) ≤ U are part
//!    of the answer. A nibble has all outside but its own run, and the triangle beyond it.
//!
//! With a hundred runs Q of the whole loop is 0.7 to 1 times its price on boundaries of developable
//! surfaces, and 0.2 to 0.9 times on random curves. Of the entries up to U a tenth (patch, strip)
//! to two thirds (random curves) are left. Where folds cost nothing, neither do nibbles, and R
//! tells nothing.
//!
//! R is no more than what the rest of the loop costs, so that the table keeps all triangulations
//! that cost U or less, ties included.

mod abstraction;
mod blocks;
mod cells;
mod pricing;
mod runs;
mod three_run_bound;

use super::prune::Open;
use crate::cost::{LANES, Lanes};
use crate::triangulate::{Terms, TriangulateError};
use abstraction::Abstraction;
use cells::Cells;
use runs::Runs;
use sheetwright_geometry::watch::Watch;

/// There are no more runs than so many for each root of a sample, corners excepted, as far as whole
/// tiles allow. With 2.5 random curves of 3,200 samples take 1.2 to 1.4 times as long.
const RUNS_A_ROOT: f64 = 3.6;
/// More of them take more memory than they save.
const MOST_RUNS: usize = 400;

/// What the rest of the loop costs at the least beside the rungs between two runs.
pub(super) struct CompletionBound {
    runs: Runs,
    /// R(A,B) by A, with A and B charged inside; infinite where no rung is part of the answer.
    rests: Vec<f64>,
}

impl CompletionBound {
    /// The runs that a loop is put together to.
    pub(super) fn runs(terms: &Terms<'_>) -> Runs {
        let m = terms.prices.len();
        let length = ((m as f64).sqrt() / RUNS_A_ROOT).ceil() as usize;
        Runs::new(terms, length.max(m.div_ceil(MOST_RUNS)).next_multiple_of(LANES))
    }

    /// What it takes while it is worked out, bytes.
    pub(super) fn most_bytes(runs: &Runs) -> u64 {
        Cells::bytes(runs.len(), runs.samples(runs.len() - 1).end)
            + Abstraction::bytes(runs.len())
            + runs.bytes()
    }

    /// Works it out where folds cost something, for a loop that is numbered in order, up to a
    /// bound.
    pub(super) fn new(
        runs: Runs,
        terms: &Terms<'_>,
        registers: pulp::Arch,
        open: &Open<'_>,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let cells = Cells::new(terms, registers, open, runs, watch)?;
        let rests = Abstraction::new(terms, registers, open.bound, &cells).rests(watch)?;
        Ok(Self { runs: cells.runs, rests })
    }

    /// What it takes, bytes.
    pub(super) fn bytes(&self) -> u64 {
        (self.rests.len() * size_of::<f64>()) as u64 + self.runs.bytes()
    }

    /// What the rest of the loop and half of each rung cost at the least, of the rungs from sample
    /// `i` to those from `first` on; infinite where none is part of the answer, and 0 beside edges
    /// of the boundary.
    #[inline(always)]
    pub(super) fn row(&self, i: usize, first: usize) -> Lanes {
        let n = self.runs.len();
        let rests = &self.rests[self.runs.of(i) * n..][..n];
        let last = self.last();
        let mut row = [rests[self.runs.of(first)]; LANES];
        if self.runs.of(first) != self.runs.of(last.min(first + LANES - 1)) {
            for lane in 0..LANES {
                row[lane] = rests[self.runs.of(last.min(first + lane))];
            }
        }
        for edge in [i + 1, if i == 0 { last } else { usize::MAX }] {
            if let Some(rest) = row.get_mut(edge.wrapping_sub(first)) {
                *rest = 0.0;
            }
        }
        row
    }

    /// The last sample, which is a run of its own.
    #[inline(always)]
    fn last(&self) -> usize {
        self.runs.samples(self.runs.len() - 1).start
    }

    /// The least R of the rungs of a tile; infinite if none is part of the answer.
    pub(super) fn least(&self, row: usize, column: usize) -> f64 {
        let n = self.runs.len();
        let last = self.last();
        let runs =
            |at: usize| self.runs.of(at * LANES)..=self.runs.of(last.min(at * LANES + LANES - 1));
        let mut least = f64::INFINITY;
        for a in runs(row) {
            for b in runs(column).skip_while(|b| *b < a) {
                least = least.min(self.rests[a * n + b]);
            }
        }
        least
    }
}

#[cfg(test)]
mod random_boundary;
#[cfg(test)]
mod tests;
