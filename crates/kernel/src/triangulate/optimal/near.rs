//! The rungs near those of a triangulation of a thinned loop: where a good triangulation of the loop
//! itself is looked for.

use crate::cost::{FarEnds, LANES};

/// The thinned loop has every fourth sample: its table takes a 64th of the time.
pub(super) const THINNING: usize = 4;
/// How far from a rung of the thinned loop rungs are tried, in samples of the thinned loop.
const REACH: usize = 1;

/// The rungs near those of a triangulation of the thinned loop.
pub(super) struct Band {
    /// How many samples the thinned loop has.
    n: usize,
    /// Whether rungs from the samples of one part of the loop to those of another are near, by
    /// pairs of parts, the lower first; part a begins with sample a of the thinned loop.
    near: Vec<bool>,
}

impl Band {
    /// What is near to these triangles, for a loop of `m` samples.
    pub(super) fn along(triangles: &[[usize; 3]], m: usize) -> Self {
        let n = m.div_ceil(THINNING);
        let mut near = vec![false; n * n];
        for &[i, k, j] in triangles {
            for (a, b) in [(i, k), (k, j), (i, j)] {
                for a in (0..=2 * REACH).map(|step| (a + n + step - REACH) % n) {
                    for b in (0..=2 * REACH).map(|step| (b + n + step - REACH) % n) {
                        near[a.min(b) * n + a.max(b)] = true;
                    }
                }
            }
        }
        Self { n, near }
    }

    /// Whether some rungs from `count` samples to `count` others are near.
    pub(super) fn has(&self, from: usize, to: usize, count: usize) -> bool {
        let parts = |first: usize| first / THINNING..(first + count).div_ceil(THINNING).min(self.n);
        parts(from).any(|a| self.near[a * self.n..][parts(to)].contains(&true))
    }

    /// Which of the rungs from sample `i` to the far ends are near.
    pub(super) fn lanes(&self, i: usize, to: &FarEnds) -> [bool; LANES] {
        let row = &self.near[i / THINNING * self.n..][..self.n];
        std::array::from_fn(|n| row[((to.first + n) / THINNING).min(self.n - 1)])
    }
}
