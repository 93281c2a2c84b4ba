//! Round a triangulation of few samples, a corridor for one of all.

use super::super::{Solved, Terms};
use super::blocks::Blocks;

/// One sample in about so many is kept.
const THINNING: usize = 4;
/// Corners are kept while there are at most as many as one in so many samples.
const SAMPLES_A_CORNER: usize = 8;
/// How many blocks a rung may move at either end.
const WIDTH: usize = 1;

/// The samples of a thinned loop: the first one, the corners, and about one in four between.
pub(super) fn kept(terms: &Terms<'_>) -> Vec<usize> {
    let m = terms.prices.len();
    let mut fixed: Vec<usize> = (1..m).filter(|&i| terms.prices.smooth_end(i).2 < 0.0).collect();
    if fixed.len() * SAMPLES_A_CORNER > m {
        fixed.clear();
    }
    fixed.push(m);
    let mut kept = Vec::new();
    let mut from = 0;
    for to in fixed {
        let steps = (to - from).div_ceil(THINNING);
        kept.extend((0..steps).map(|step| from + step * (to - from) / steps));
        from = to;
    }
    kept
}

/// The rungs next to those of a triangulation of the samples that were kept, by their first sample.
pub(super) fn corridor(blocks: &Blocks, few: &Solved, kept: &[usize], m: usize) -> Vec<Vec<u32>> {
    let n = blocks.len();
    let of = blocks.of_samples(m);
    let mut rows: Vec<Vec<usize>> = vec![Vec::new(); n];
    let near = |a: usize| a.saturating_sub(WIDTH)..(a + WIDTH + 1).min(n);
    for &[i, k, j] in &few.triangles {
        for (i, j) in [(i, k), (k, j), (i, j)] {
            let (a, b) = (of[kept[i]] as usize, of[kept[j]] as usize);
            for a in near(a) {
                rows[a].extend(near(b).filter(|&b| b >= a));
            }
        }
    }
    let mut rungs = Vec::with_capacity(m);
    for (a, mut row) in rows.into_iter().enumerate() {
        row.sort_unstable();
        row.dedup();
        for i in blocks.samples(a) {
            let all = row.iter().flat_map(|&b| blocks.samples(b));
            rungs.push(all.filter(|&j| j > i + 1).map(|j| j as u32).collect());
        }
    }
    rungs
}
