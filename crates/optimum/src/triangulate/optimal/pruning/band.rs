//! The band of the table: the rungs near those of a triangulation of a thinned loop, among which a
//! good triangulation of the whole loop is found.

use crate::cost::{FarEnds, LANES};
use std::ops::Range;

/// How far from a rung of the thinned loop rungs are tried, in samples of the thinned loop.
const REACH: usize = 1;

/// The rungs near those of a triangulation of the thinned loop.
pub(super) struct Band {
    /// The part of the loop that each sample belongs to; part a begins with sample a of the thinned
    /// loop.
    part_of: Vec<u32>,
    /// For each part, in increasing order, the parts with rungs between both that are near, itself
    /// and higher ones.
    near: Vec<Vec<u32>>,
}

impl Band {
    /// The rungs near to these triangles between any of the samples: those between the parts of
    /// their corners, which begin with the kept samples, and the parts beside those.
    pub(super) fn about(
        triangles: impl Iterator<Item = [usize; 3]>,
        kept: &[usize],
        m: usize,
    ) -> Self {
        let part = |sample: usize| kept.partition_point(|first| *first <= sample) - 1;
        let parts: Vec<[usize; 3]> = triangles.map(|corners| corners.map(part)).collect();
        Self::along(&parts, kept, m)
    }

    /// The rungs near to these triangles between the kept samples, for a loop of `m` samples.
    pub(super) fn along(triangles: &[[usize; 3]], kept: &[usize], m: usize) -> Self {
        let n = kept.len();
        let mut part_of = vec![0; m];
        for part in 0..n {
            let end = kept.get(part + 1).copied().unwrap_or(m);
            part_of[kept[part]..end].fill(part as u32);
        }
        let around = |a: usize| (0..=2 * REACH).map(move |step| (a + n + step - REACH) % n);
        let mut near = vec![Vec::new(); n];
        for &[i, k, j] in triangles {
            for (a, b) in [(i, k), (k, j), (i, j)] {
                for a in around(a) {
                    for b in around(b) {
                        near[a.min(b)].push(a.max(b) as u32);
                    }
                }
            }
        }
        for near in &mut near {
            near.sort_unstable();
            near.dedup();
        }
        Self { part_of, near }
    }

    /// Whether all rungs near those of `other`, for the same samples kept, are near these, too.
    pub(super) fn covers(&self, other: &Self) -> bool {
        let has = |row: &[u32], part: &u32| row.binary_search(part).is_ok();
        self.near.iter().zip(&other.near).all(|(row, of)| of.iter().all(|part| has(row, part)))
    }

    /// Whether some rungs between samples of these two runs are near, the lower one first.
    pub(super) fn has(&self, from: Range<usize>, to: Range<usize>) -> bool {
        let parts = |run: Range<usize>| self.part_of[run.start]..=self.part_of[run.end - 1];
        let (rows, wanted) = (parts(from), parts(to));
        rows.into_iter().any(|row| {
            let row = &self.near[row as usize];
            let next = row.partition_point(|part| part < wanted.start());
            row.get(next).is_some_and(|part| part <= wanted.end())
        })
    }

    /// Which of the rungs from sample `i` to the far ends are near.
    pub(super) fn lanes(&self, i: usize, to: &FarEnds) -> [bool; LANES] {
        let row = &self.near[self.part_of[i] as usize];
        let last = self.part_of.len() - 1;
        let (mut near, mut part) = (false, u32::MAX);
        std::array::from_fn(|n| {
            // Neighbours mostly belong to one part.
            let of_lane = self.part_of[(to.first + n).min(last)];
            if of_lane != part {
                (near, part) = (row.binary_search(&of_lane).is_ok(), of_lane);
            }
            near
        })
    }
}
