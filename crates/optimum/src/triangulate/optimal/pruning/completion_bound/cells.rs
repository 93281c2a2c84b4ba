//! Bounds for all rungs between two runs, and for the triangles on edges of one run whose third
//! corner lies in the other.
//!
//! Each thread takes one *block* of neighbouring runs after the other, and prices the rungs from
//! their samples to all later ones (`pricing`), row by row of tiles. Each block also prices the
//! triangles on the edge to the next one, so that no block depends on another.

use super::blocks::{Block, Cell, blocks};
use super::normals::NormalBox;
use super::pricing::{LastRow, LastRung, Linking, Pricing, Row};
use super::runs::Runs;
use crate::cost::{FarEnds, LANES};
use crate::triangulate::optimal::pruning::spans::Spans;
use crate::triangulate::optimal::threads::{Helpers, MOST_THREADS};
use crate::triangulate::{Terms, TriangulateError};
use sheetwright_geometry::watch::Watch;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// Least number of rows of tiles in a block where threads share them: rungs from the first sample
/// of the next block are priced twice.
const LEAST_ROWS: usize = 4;
/// Blocks for each thread, so that none waits long for the others.
const BLOCKS_A_THREAD: usize = 8;

/// The cells of all pairs of runs, by the first.
pub(super) struct Cells {
    pub(super) runs: Runs,
    cells: Vec<Cell>,
}

impl Cells {
    /// Memory during pricing, for so many runs of so many samples, with as many threads as there
    /// may be, bytes.
    pub(super) fn bytes(runs: usize, samples: usize) -> u64 {
        let of_tiles = size_of::<FarEnds>() + MOST_THREADS * size_of::<LastRow>();
        let of_pairs = (runs as u64).pow(2) * size_of::<Cell>() as u64;
        of_pairs + (samples.div_ceil(LANES) * of_tiles) as u64
    }

    /// Prices all rungs that spans do not exclude.
    pub(super) fn new(
        terms: &Terms<'_>,
        registers: pulp::Arch,
        spans: &Spans,
        runs: Runs,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let count = terms.prices.len().div_ceil(LANES);
        let helpers = Helpers::call(count);
        let rows = helpers.as_ref().map_or(count, |helpers| {
            count.div_ceil(BLOCKS_A_THREAD * (1 + helpers.count())).max(LEAST_ROWS)
        });
        Self::in_blocks(terms, registers, spans, runs, rows, helpers.as_ref(), watch)
    }

    /// Prices all rungs that spans do not exclude, with this many rows of tiles in a block or some
    /// more, and these helpers.
    pub(super) fn in_blocks(
        terms: &Terms<'_>,
        registers: pulp::Arch,
        spans: &Spans,
        runs: Runs,
        rows: usize,
        helpers: Option<&Helpers>,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let count = terms.prices.len().div_ceil(LANES);
        let ends: Vec<FarEnds> = (0..count).map(|at| terms.prices.far_ends(at * LANES)).collect();
        let mut cells = vec![Cell::UNKNOWN; runs.len() * runs.len()];
        let all = All {
            terms,
            registers,
            spans,
            ends: &ends,
            blocks: Mutex::new(blocks(&runs, rows, count, &mut cells).into_iter()),
            is_stopped: AtomicBool::new(false),
        };
        let mut lead = || {
            all.price(&mut |row| {
                // Rows have as many tiles as there are rows below.
                let below = (count - row) as f64 / count as f64;
                watch.progress(1.0 - below * below);
                !watch.stop()
            });
        };
        match helpers {
            Some(helpers) => helpers.join(|| all.price(&mut |_| true), lead),
            None => lead(),
        }
        if all.is_stopped.into_inner() {
            return Err(TriangulateError::Stopped);
        }
        // The edge from the last sample to the first is no rung, and costs nothing.
        let root = &mut cells[runs.len() - 1];
        (root.least, root.normals) = (0.0, NormalBox::ANY);
        Ok(Self { runs, cells })
    }

    #[inline(always)]
    pub(super) fn of(&self, a: usize, b: usize) -> &Cell {
        &self.cells[a * self.runs.len() + b]
    }
}

/// The data shared by the threads that price all blocks.
struct All<'s, 'c> {
    terms: &'s Terms<'s>,
    registers: pulp::Arch,
    spans: &'s Spans,
    ends: &'s [FarEnds],
    /// Those that no thread has taken.
    blocks: Mutex<std::vec::IntoIter<Block<'c>>>,
    is_stopped: AtomicBool,
}

impl All<'_, '_> {
    /// Prices blocks until none is left, or `goes_on` returns false before some row of tiles.
    fn price(&self, goes_on: &mut dyn FnMut(usize) -> bool) {
        // The last row that was priced in each column of tiles.
        let mut above = vec![];
        let next = || self.blocks.lock().unwrap_or_else(PoisonError::into_inner).next();
        while let Some(mut block) = next() {
            above.clear();
            above.resize(self.ends.len(), LastRow::NONE);
            for row in block.rows.clone() {
                if self.is_stopped.load(Ordering::Relaxed) || !goes_on(row) {
                    self.is_stopped.store(true, Ordering::Relaxed);
                    return;
                }
                self.price_row(&mut block, row, &mut above);
            }
            self.link(&mut block, &above);
        }
    }

    /// Prices a row of tiles.
    fn price_row(&self, block: &mut Block<'_>, row: usize, above: &mut [LastRow]) {
        let (terms, bound) = (self.terms, self.spans.bound);
        let rows = row * LANES..terms.prices.len().min((row + 1) * LANES);
        let mut before = [LastRung::NONE; LANES];
        let mut turns = [Row::NONE; 2];
        for column in row..self.ends.len() {
            let above = &mut above[column];
            if !self.spans.is_open(row, column) {
                *above = LastRow::NONE;
                before = [LastRung::NONE; LANES];
                continue;
            }
            let (rows, to) = (rows.clone(), &self.ends[column]);
            let (before, turns) = (&mut before, &mut turns);
            self.registers.dispatch(Pricing {
                terms,
                bound,
                rows,
                to,
                above,
                before,
                turns,
                block,
            });
        }
    }

    /// Prices the triangles on the edge after the last sample of a block.
    fn link(&self, block: &mut Block<'_>, above: &[LastRow]) {
        let (terms, bound, row) = (self.terms, self.spans.bound, block.rows.end);
        for column in row..self.ends.len() {
            if self.spans.is_open(row, column) {
                let (i, to, above) = (row * LANES, &self.ends[column], &above[column]);
                self.registers.dispatch(Linking { terms, bound, i, to, above, block });
            }
        }
    }
}
