//! Round a triangulation of few samples, a corridor for one of all.

use super::super::Solved;
use super::blocks::Blocks;
use super::sweep::Alive;

/// How many blocks a rung may move at either end.
const WIDTH: usize = 1;

/// The pairs of blocks next to the rungs of a triangulation of every `step`-th of m samples.
pub(super) fn corridor(blocks: &Blocks, few: &Solved, step: usize, m: usize) -> Alive {
    let n = blocks.len();
    let of = blocks.of_samples(m);
    let mut rows: Vec<Vec<usize>> = vec![Vec::new(); n];
    let near = |a: usize| a.saturating_sub(WIDTH)..(a + WIDTH + 1).min(n);
    for &[i, k, j] in &few.triangles {
        for (i, j) in [(i, k), (k, j), (i, j)] {
            let (a, b) = (of[step * i] as usize, of[step * j] as usize);
            for a in near(a) {
                rows[a].extend(near(b).filter(|&b| b > a + 1));
            }
        }
    }
    let mut alive = Alive::new();
    for mut row in rows {
        row.sort_unstable();
        row.dedup();
        row.into_iter().for_each(|b| alive.push(b, 0.0, 0.0));
        alive.end_row();
    }
    alive
}
