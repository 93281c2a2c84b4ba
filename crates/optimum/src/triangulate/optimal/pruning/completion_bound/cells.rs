//! Bounds for all rungs between two runs, and for the triangles on edges of one run whose third
//! corner lies in the other.
//!
//! Each thread takes one *block* of neighbouring runs after the other, and prices the rungs from
//! their samples to all later ones (`pricing`).

use super::normals::NormalBox;
use super::pricing::{Cell, Pricing};
use super::runs::Runs;
use crate::cost::{FarEnds, LANES};
use crate::triangulate::optimal::pruning::spans::Spans;
use crate::triangulate::optimal::threads::{Helpers, MOST_THREADS};
use crate::triangulate::{Terms, TriangulateError};
use sheetwright_geometry::watch::Watch;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// Runs of a block: the rungs from the first sample of the next are priced twice.
pub(super) const RUNS_OF_BLOCK: usize = 8;

/// The cells of all pairs of runs, by the first.
pub(super) struct Cells {
    pub(super) runs: Runs,
    cells: Vec<Cell>,
}

impl Cells {
    /// Memory during pricing, for so many runs of so many samples, with as many threads as there
    /// may be, bytes.
    pub(super) fn bytes(runs: usize, samples: usize) -> u64 {
        let tiles = samples.div_ceil(LANES);
        let of_tiles = tiles * size_of::<FarEnds>() + MOST_THREADS * Pricing::bytes(tiles);
        (runs * runs * size_of::<Cell>() + of_tiles) as u64
    }

    /// Prices all rungs that spans leave open. A block has `length` runs, which changes no bit.
    pub(super) fn new(
        length: usize,
        terms: &Terms<'_>,
        registers: pulp::Arch,
        spans: &Spans,
        runs: Runs,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let (n, count) = (runs.len(), terms.prices.len().div_ceil(LANES));
        let ends: Vec<FarEnds> = (0..count).map(|at| terms.prices.far_ends(at * LANES)).collect();
        let mut cells = vec![Cell::UNKNOWN; n * n];
        let blocks = Mutex::new(cells.chunks_mut(n * length).enumerate());
        let is_stopped = AtomicBool::new(false);
        let price = |goes_on: &mut dyn FnMut(usize) -> bool| {
            let mut pricing = Pricing::new(terms, spans, &runs, &ends);
            let next = || blocks.lock().unwrap_or_else(PoisonError::into_inner).next();
            while let Some((block, cells)) = next() {
                let first = block * length;
                for run in first..n.min(first + length) {
                    let cells = &mut cells[(run - first) * n..][..n];
                    for i in runs.samples(run) {
                        if is_stopped.load(Ordering::Relaxed) || !goes_on(i) {
                            return is_stopped.store(true, Ordering::Relaxed);
                        }
                        pricing.price(registers, i);
                    }
                    pricing.close(registers, run, cells);
                }
            }
        };
        let mut lead = || {
            price(&mut |i| {
                // Later samples have fewer rungs.
                let left = 1.0 - i as f64 / terms.prices.len() as f64;
                watch.progress(1.0 - left * left);
                !watch.stop()
            });
        };
        match Helpers::call(count) {
            Some(helpers) => helpers.join(|| price(&mut |_| true), lead),
            None => lead(),
        }
        if is_stopped.into_inner() {
            return Err(TriangulateError::Stopped);
        }
        // The edge from the last sample to the first is no rung, and costs nothing.
        let root = &mut cells[n - 1];
        (root.least, root.normals) = (0.0, NormalBox::ANY);
        Ok(Self { runs, cells })
    }

    #[inline(always)]
    pub(super) fn of(&self, a: usize, b: usize) -> &Cell {
        &self.cells[a * self.runs.len() + b]
    }
}
