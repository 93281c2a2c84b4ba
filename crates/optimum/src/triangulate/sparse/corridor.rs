//! Round a triangulation of few samples, a corridor for one of all.

use super::super::Solved;
use super::blocks::Blocks;

/// How many blocks a rung may move at either end.
const WIDTH: usize = 1;

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
