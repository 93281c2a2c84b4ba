//! The rungs that are cheap for where they are, found without looking at all pairs.

use super::super::{Terms, TriangulateError};
use super::blocks::Blocks;
use crate::cost::{FarEnds, Strip};
use sheetwright_geometry::watch::Watch;
use std::ops::Range;

/// The rungs (a, b) that cost no more than twice what may be owed at a and at b together, by their
/// first sample, the second ones in increasing order; `None` if there are more than `most`.
///
/// For each leaf (a block of the lowest level, of no more samples than stand side by side), blocks
/// are opened from the top down as long as the spans do not rule out that one of their rungs is
/// cheap.
pub(super) fn listed(
    terms: &Terms<'_>,
    levels: &[Blocks],
    owed: &[f64],
    most: u64,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<Vec<u32>>>, TriangulateError> {
    let mut rows: Vec<Vec<u32>> = vec![Vec::new(); terms.prices.len()];
    let (leaves, top) = (&levels[0], levels.len() - 1);
    // The most that is owed in each block.
    let mut in_blocks: Vec<Vec<f64>> = Vec::new();
    for blocks in levels {
        let most = |block: usize| blocks.samples(block).map(|x| owed[x]).fold(0.0, f64::max);
        in_blocks.push((0..blocks.len()).map(most).collect());
    }
    let far: Vec<FarEnds> =
        (0..leaves.len()).map(|leaf| terms.prices.far_ends(leaves.samples(leaf).start)).collect();
    let registers = pulp::Arch::new();
    let mut open = Vec::new();
    let mut count = 0;
    for leaf in 0..leaves.len() {
        // Those that come later have the rest of the rungs to this leaf.
        let is_later = |level: usize, block: usize| {
            levels[level].samples(block).end > leaves.samples(leaf).start
        };
        open.extend((0..levels[top].len()).filter(|&b| is_later(top, b)).map(|b| (top, b)));
        while let Some((level, block)) = open.pop() {
            if level == 0 {
                let (from, to) = (leaves.samples(leaf), leaves.samples(block));
                let (far, rows) = (&far[block], &mut rows);
                count += registers.dispatch(Comparing { terms, from, to, far, owed, rows });
                continue;
            }
            let below = level - 1;
            for part in levels[level].parts(block).filter(|&part| is_later(below, part)) {
                let most = 2.0 * (in_blocks[0][leaf] + in_blocks[below][part]);
                if leaves.least(leaf, &levels[below], part) <= most {
                    open.push((below, part));
                }
            }
        }
        if leaf % 16 == 0 && watch.stop() {
            return Err(TriangulateError::Stopped);
        }
        if count > most {
            return Ok(None);
        }
    }
    rows.iter_mut().for_each(|row| row.sort_unstable());
    Ok(Some(rows))
}

/// Lists the rungs from the samples of one leaf to higher ones of another; how many there are. A
/// type rather than a closure, so that it is compiled for the widest registers.
struct Comparing<'a> {
    terms: &'a Terms<'a>,
    from: Range<usize>,
    to: Range<usize>,
    far: &'a FarEnds,
    owed: &'a [f64],
    rows: &'a mut [Vec<u32>],
}

impl pulp::WithSimd for Comparing<'_> {
    type Output = u64;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> u64 {
        let Self { terms, from, to, far, owed, rows } = self;
        let m = owed.len();
        let mut count = 0;
        let mut strip = Strip::BLANK;
        for x in from {
            terms.strip::<false>(x, far, f64::INFINITY, &mut strip);
            for (y, price) in to.clone().zip(*strip.prices) {
                let is_rung = y > x + 1 && y - x + 1 < m;
                if is_rung && price <= 2.0 * (owed[x] + owed[y]) {
                    rows[x].push(y as u32);
                    count += 1;
                }
            }
        }
        count
    }
}
