//! The rungs near those of a triangulation of a thinned loop: where a good triangulation of the loop
//! itself is looked for.

use crate::cost::{FarEnds, LANES};

/// The thinned loop has every fourth sample: where all of its table is there, that takes a 64th of the
/// time.
pub(super) const THINNING: usize = 4;
/// How far from a rung of the thinned loop rungs are tried, in samples of the thinned loop.
const REACH: usize = 1;

/// The rungs near those of a triangulation of the thinned loop.
pub(super) struct Band {
    /// For each part of the loop, in increasing order, the parts with rungs between both that are
    /// near, itself and higher ones; part a begins with sample a of the thinned loop.
    near: Vec<Vec<u32>>,
}

impl Band {
    /// What is near to these triangles, for a loop of `m` samples.
    pub(super) fn along(triangles: &[[usize; 3]], m: usize) -> Self {
        let n = m.div_ceil(THINNING);
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
        Self { near }
    }

    /// Whether some rungs from `count` samples to as many others are near.
    pub(super) fn has(&self, from: usize, to: usize, count: usize) -> bool {
        let parts = |first: usize| first / THINNING..(first + count).div_ceil(THINNING);
        let (rows, wanted) = (parts(from), parts(to));
        self.near[rows.start..rows.end.min(self.near.len())].iter().any(|row| {
            let next = row.partition_point(|&part| (part as usize) < wanted.start);
            row.get(next).is_some_and(|&part| (part as usize) < wanted.end)
        })
    }

    /// Which of the rungs from sample `i` to the far ends are near.
    pub(super) fn lanes(&self, i: usize, to: &FarEnds) -> [bool; LANES] {
        let row = &self.near[i / THINNING];
        let last = self.near.len() - 1;
        std::array::from_fn(|n| {
            let part = ((to.first + n) / THINNING).min(last);
            row.binary_search(&(part as u32)).is_ok()
        })
    }
}
