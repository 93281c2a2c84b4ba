//! Runs of neighbouring samples, and what is known of all rungs between two of them.
//!
//! A corner is a block of its own at every level while there are few of them: its rungs have
//! normals to choose from, which would blur whatever block it shared.

use super::super::Terms;
use super::super::span::Span;
use std::ops::Range;

/// Corners are kept apart while there are at most as many as one in so many samples.
const SAMPLES_A_CORNER: usize = 64;

/// The blocks of one level.
pub(super) struct Blocks {
    /// The first sample of each block, and the number of samples.
    starts: Vec<u32>,
    /// The first block of the level below of each block, and their number; the samples at the
    /// lowest level.
    children: Vec<u32>,
    spans: Vec<Span>,
}

/// The levels of a loop, from single samples up to about `top` blocks.
pub(super) fn levels(terms: &Terms<'_>, top: usize) -> Vec<Blocks> {
    let m = terms.prices.len();
    let is_corner: Vec<bool> = (0..m).map(|i| terms.prices.smooth_end(i).2 < 0.0).collect();
    let corners = is_corner.iter().filter(|c| **c).count();
    let apart = |i: u32| corners * SAMPLES_A_CORNER <= m && is_corner[i as usize];
    let mut starts: Vec<u32> = (0..=m as u32).collect();
    let mut children = starts.clone();
    let mut levels = Vec::new();
    loop {
        let n = starts.len() - 1;
        let span = |a: usize| Span::of(terms, starts[a] as usize..starts[a + 1] as usize);
        let spans = (0..n).map(span).collect();
        let mut merged = vec![0];
        let mut a = 0;
        while a < n {
            let pair = a + 1 < n && !apart(starts[a]) && !apart(starts[a + 1]);
            a += if pair { 2 } else { 1 };
            merged.push(a as u32);
        }
        levels.push(Blocks { starts: starts.clone(), children, spans });
        if n <= top || merged.len() > n - n / 4 {
            return levels;
        }
        starts = merged.iter().map(|&a| starts[a as usize]).collect();
        children = merged;
    }
}

impl Blocks {
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn samples(&self, a: usize) -> Range<usize> {
        self.starts[a] as usize..self.starts[a + 1] as usize
    }

    /// The block of each of m samples.
    pub(super) fn of_samples(&self, m: usize) -> Vec<u32> {
        let mut of = vec![0; m];
        for a in 0..self.len() {
            self.samples(a).for_each(|i| of[i] = a as u32);
        }
        of
    }

    /// The blocks of the level below that make up block `a`.
    pub(super) fn parts(&self, a: usize) -> Range<usize> {
        self.children[a] as usize..self.children[a + 1] as usize
    }

    /// No rung between block `a` of these and block `b` of others costs less.
    pub(super) fn least(&self, a: usize, others: &Self, b: usize) -> f64 {
        self.spans[a].least(&others.spans[b])
    }
}
