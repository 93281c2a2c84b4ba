//! A lower bound on the price of the rest of the loop beside a rung, from runs of neighbouring
//! samples.
//!
//! The table goes from short rungs to long ones, and keeps parts that are cheap by themselves.
//! Short rungs are cheap wherever they lie: the planes of one are near to the osculating plane of
//! the boundary there. But a triangle beyond such a rung leans away from that plane, and its folds
//! cost more than the whole surface. The table can't know that.
//!
//! So the loop is first abstracted, as in the coarse-to-fine search of \[Raphael2001\] and the
//! abstractions of \[FM07\]: its samples are grouped to some hundred runs, and equation (5) is
//! solved for the runs, with lower bounds on the prices of all triangles between three runs. The
//! solution gives a lower bound on the rest of the loop for all rungs between two runs.
//!
//! 1. A triangle pays its folds and half the price of each of its rungs; all triangles of a
//!    triangulation pay its price. Let A, B … be runs. A triangle is *wide* if its corners belong
//!    to three of them, *thin* if just two belong to one. The rungs of a triangulation that join A
//!    and B follow one another, with thin triangles between them: a *bundle*. Bundles and wide
//!    triangles are a triangulation of the runs. The first sample and the last are runs of their
//!    own, so that none runs across the edge between them, and so are corners, unless there are
//!    many (`runs`).
//! 2. A wide triangle pays g or more: half of the least that rungs of its three bundles cost, and
//!    the least that its folds can cost, from where N of these rungs lie (`cells`,
//!    `three_run_bound`). The edge from one run to the next is no rung; what triangles on it pay is
//!    known well, as the least over third corners in each run.
//! 3. The |A| − 1 edges within a run are sides of thin triangles, or lie below a *nibble*: a rung
//!    between two samples of A. The triangle beyond the outermost nibble is thin, too, with its
//!    third corner in another run. If each thin triangle with the third corner in X pays at least c
//!    for each edge of A on it or below its nibble, they pay at least (|A| − 1) c together, with
//!    the X where c is least. So each run is *charged* in one of its bundles: with the least price
//!    of triangles on its edges there, times their number, or with the least price of a triangle
//!    beyond a nibble, if that is lower.
//! 4. Let Q(A,B) be the sum of the charges in the bundle of A and B and inside of it, and of the
//!    wide triangles there, and R(A,B) that sum outside of it. Each has four values, for whether A
//!    and whether B is charged inside or in the bundle. Then Q(A,B) is the minimum over K of
//!    Q(A,K) + Q(K,B) + g(A,K,B), with K charged on one side, plus the charges of A and B, if any;
//!    and R likewise, from outer bundles to inner ones.
//! 5. Outside of a rung ⟨i,j⟩ of that bundle are all other runs that are not inside. So with an
//!    upper bound U on the price, only entries of the table with E(i,j) − ½ w(i,j) + R(A,B) ≤ U are
//!    part of the optimum. Outside of a nibble are all runs except its own, and the triangle beyond
//!    it.
//!
//! With a hundred runs Q of the whole loop is 0.7 to 1 times its price on boundaries of developable
//! surfaces, and 0.2 to 0.9 times on random curves. Of the entries up to U a tenth (patch, strip)
//! to two thirds (random curves) are left. Without a fold price, nibbles cost nothing, and R bounds
//! nothing.
//!
//! R is a lower bound, so the table keeps all triangulations that cost U or less, ties included.

mod abstraction;
mod cells;
mod normals;
mod on_edges;
mod pricing;
mod runs;
mod three_run_bound;

use super::spans::Spans;
use crate::cost::{LANES, Lanes};
use crate::triangulate::{Terms, TriangulateError};
use abstraction::Abstraction;
use cells::{Cells, RUNS_OF_BLOCK};
use runs::Runs;
use sheetwright_geometry::watch::Watch;

/// There are at most this many runs times the root of the number of samples, corners excepted, as
/// far as whole tiles allow. With 2.5 random curves of 3,200 samples take 1.2 to 1.4 times as long.
const RUNS_A_ROOT: f64 = 3.6;
/// Limit of the runs: more take more memory than they save.
const MOST_RUNS: usize = 400;

/// Lower bounds on the price of the rest of the loop beside the rungs between two runs.
pub(super) struct CompletionBound {
    runs: Runs,
    /// R(A,B) by A, with A and B charged inside; infinite where no rung is part of the optimum.
    rests: Vec<f64>,
}

impl CompletionBound {
    /// The runs of a loop.
    pub(super) fn runs(terms: &Terms<'_>) -> Runs {
        let m = terms.prices.len();
        let length = ((m as f64).sqrt() / RUNS_A_ROOT).ceil() as usize;
        Runs::new(terms, length.max(m.div_ceil(MOST_RUNS)).next_multiple_of(LANES))
    }

    /// Memory while it is computed, bytes.
    pub(super) fn most_bytes(runs: &Runs) -> u64 {
        Cells::bytes(runs.len(), runs.samples(runs.len() - 1).end)
            + Abstraction::bytes(runs.len())
            + runs.bytes()
    }

    /// Computes it for a loop that is numbered in order, with a positive fold price, up to a bound.
    pub(super) fn new(
        runs: Runs,
        terms: &Terms<'_>,
        registers: pulp::Arch,
        spans: &Spans,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let cells = Cells::new(RUNS_OF_BLOCK, terms, registers, spans, runs, watch)?;
        let rests = Abstraction::new(terms, registers, spans.bound, &cells).rests(watch)?;
        Ok(Self { runs: cells.runs, rests })
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> u64 {
        (self.rests.len() * size_of::<f64>()) as u64 + self.runs.bytes()
    }

    /// Lower bounds on the price of the rest of the loop with half of each rung, for the rungs from
    /// sample `i` to those from `first` on; infinite where none is part of the optimum, and 0
    /// beside edges of the boundary.
    #[inline(always)]
    pub(super) fn row(&self, i: usize, first: usize) -> Lanes {
        let n = self.runs.len();
        let rests = &self.rests[self.runs.of(i) * n..][..n];
        let (last, mut row) = (self.last(), [0.0; LANES]);
        for lane in 0..LANES {
            let j = last.min(first + lane);
            let is_edge = j == i + 1 || (i == 0 && j == last);
            row[lane] = if is_edge { 0.0 } else { rests[self.runs.of(j)] };
        }
        row
    }

    /// The last sample, which is a single run.
    #[inline(always)]
    fn last(&self) -> usize {
        self.runs.samples(self.runs.len() - 1).start
    }

    /// The least R of the rungs of a tile; infinite if none is part of the optimum.
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
mod tests;
