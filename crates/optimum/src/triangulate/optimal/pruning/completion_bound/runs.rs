//! The loop in runs of neighbouring samples.

use crate::triangulate::Terms;
use std::ops::Range;

/// Corners are single runs while they are at most one in so many runs: their rungs have a choice of
/// normals, which would loosen the bounds of a longer run.
const RUNS_A_CORNER: usize = 4;
/// Runs of neighbouring samples. The first sample, the last, and each corner are single runs.
pub(in crate::triangulate::optimal) struct Runs {
    /// The first sample of each run, and the number of samples.
    starts: Vec<u32>,
    /// The run of each sample.
    of: Vec<u32>,
}

impl Runs {
    /// Runs of no more than `length` samples, which begin at multiples of it or next to corners.
    pub(super) fn new(terms: &Terms<'_>, length: usize) -> Self {
        let m = terms.prices.len();
        let is_corner: Vec<bool> = (0..m).map(|i| terms.prices.smooth_end(i).2 < 0.0).collect();
        let corners = is_corner.iter().filter(|is| **is).count();
        let apart = |i: usize| {
            let is_apart = is_corner[i] && corners * RUNS_A_CORNER * length <= m;
            i == 0 || i + 1 == m || is_apart
        };
        let starts_here = |i: usize| i.is_multiple_of(length) || apart(i) || apart(i - 1);
        let mut starts: Vec<u32> = (0..m).filter(|&i| starts_here(i)).map(|i| i as u32).collect();
        starts.push(m as u32);
        let mut of = vec![0; m];
        for (run, ends) in starts.windows(2).enumerate() {
            of[ends[0] as usize..ends[1] as usize].fill(run as u32);
        }
        Self { starts, of }
    }

    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn samples(&self, run: usize) -> Range<usize> {
        self.starts[run] as usize..self.starts[run + 1] as usize
    }

    /// How many edges of the boundary join samples of a run.
    pub(super) fn inner_edges(&self, run: usize) -> usize {
        self.samples(run).len() - 1
    }

    #[inline(always)]
    pub(super) fn of(&self, sample: usize) -> usize {
        self.of[sample] as usize
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> u64 {
        ((self.starts.len() + self.of.len()) * size_of::<u32>()) as u64
    }
}
