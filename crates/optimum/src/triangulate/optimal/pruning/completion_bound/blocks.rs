//! Cells, the bounds for pairs of runs, and the blocks of neighbouring runs that threads take one
//! after the other: data gathered from the rungs between two tiles goes into the cells of its
//! block.

use super::normals::NormalBox;
use super::runs::Runs;
use crate::cost::{Aligned, FarEnds, LANES, Lanes, Strip};
use std::ops::Range;

/// The bounds for two runs, a and b, which may be one run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// Lower bound on the price of a rung between them; infinite if there is none up to the bound.
    pub(super) least: f64,
    /// A box around the N of the rungs up to the bound.
    pub(super) normals: NormalBox,
    /// Lower bounds on the price, with half of the prices of its rungs, of a triangle on an edge
    /// between samples of a with its third corner in b, and of one on an edge in b with its third
    /// corner in a. Close to the least price where folds are slight.
    pub(super) on_edges: [f64; 2],
    /// Lower bounds on the price, with half of the prices of its rungs, of a triangle on the edge
    /// from a to the run after it with its third corner in b, and of one on the edge from b to the
    /// run after it with its third corner in a.
    pub(super) on_links: [f64; 2],
}

impl Cell {
    pub(super) const UNKNOWN: Self = Self {
        least: f64::INFINITY,
        normals: NormalBox::NONE,
        on_edges: [f64::INFINITY; 2],
        on_links: [f64::INFINITY; 2],
    };
}

/// Common bounds of the rungs from some samples of one run to those of a tile, for each sample of
/// the tile.
pub(super) struct Gathered {
    pub(super) prices: Aligned<Lanes>,
    pub(super) least: Aligned<[Lanes; 3]>,
    pub(super) greatest: Aligned<[Lanes; 3]>,
    pub(super) on_row_edges: Aligned<Lanes>,
    pub(super) on_column_edges: Aligned<Lanes>,
}

impl Gathered {
    pub(super) const NOTHING: Self = Self {
        prices: Aligned([f64::INFINITY; LANES]),
        least: Aligned([[f64::INFINITY; LANES]; 3]),
        greatest: Aligned([[f64::NEG_INFINITY; LANES]; 3]),
        on_row_edges: Aligned([f64::INFINITY; LANES]),
        on_column_edges: Aligned([f64::INFINITY; LANES]),
    };

    #[inline(always)]
    pub(super) fn take_rungs(&mut self, i: usize, first: usize, last: usize, strip: &Strip) {
        let mut prices = *strip.prices;
        // Edges of the boundary are none.
        for lane in 0..LANES {
            let j = first + lane;
            if j <= i + 1 || (i == 0 && j == last) {
                prices[lane] = f64::INFINITY;
            }
        }
        for lane in 0..LANES {
            let is_lower = prices[lane] < self.prices[lane];
            self.prices[lane] = if is_lower { prices[lane] } else { self.prices[lane] };
        }
        for axis in 0..3 {
            let (least, greatest) = (&mut self.least[axis], &mut self.greatest[axis]);
            for lane in 0..LANES {
                let (x, is_one) = (strip.means[axis][lane], prices[lane] < f64::INFINITY);
                least[lane] = if is_one & (x < least[lane]) { x } else { least[lane] };
                greatest[lane] = if is_one & (x > greatest[lane]) { x } else { greatest[lane] };
            }
        }
    }
}

/// Parts `count` rows of tiles to blocks of `rows` or some more, which begin with a run.
pub(super) fn blocks<'c>(
    runs: &'c Runs,
    rows: usize,
    count: usize,
    mut cells: &'c mut [Cell],
) -> Vec<Block<'c>> {
    let begins_run =
        |row: usize| row == count || runs.samples(runs.of(row * LANES)).start == row * LANES;
    let mut blocks = vec![];
    let (mut row, mut run) = (0, 0);
    while row < count {
        let end = (row + rows..count).find(|row| begins_run(*row)).unwrap_or(count);
        let next = if end == count { runs.len() } else { runs.of(end * LANES) };
        let (own, others) = cells.split_at_mut((next - run) * runs.len());
        cells = others;
        blocks.push(Block { runs, rows: row..end, first: run, cells: own });
        (row, run) = (end, next);
    }
    blocks
}

/// The cells of neighbouring runs with all others.
pub(super) struct Block<'c> {
    pub(super) runs: &'c Runs,
    /// The rows of tiles with the samples of its runs.
    pub(super) rows: Range<usize>,
    first: usize,
    cells: &'c mut [Cell],
}

impl Block<'_> {
    #[inline(always)]
    fn of_mut(&mut self, a: usize, b: usize) -> &mut Cell {
        &mut self.cells[(a - self.first) * self.runs.len() + b]
    }

    /// Merges the data gathered for run a and one column of tiles.
    pub(super) fn take(&mut self, a: usize, to: &FarEnds, gathered: &Gathered) {
        for lane in 0..to.count {
            let j = to.first + lane;
            let b = self.runs.of(j);
            if b < a {
                continue;
            }
            let cell = self.of_mut(a, b);
            cell.least = cell.least.min(gathered.prices[lane]);
            let at = |of: &[Lanes; 3]| [of[0][lane], of[1][lane], of[2][lane]];
            cell.normals.include(&NormalBox::between(at(&gathered.least), at(&gathered.greatest)));
            cell.on_edges[0] = cell.on_edges[0].min(gathered.on_row_edges[lane]);
            // That of a column is the edge before it.
            let price = gathered.on_column_edges[lane];
            let before = if j == 0 { b } else { self.runs.of(j - 1) };
            if before == b {
                let cell = self.of_mut(a, b);
                cell.on_edges[1] = cell.on_edges[1].min(price);
            } else if before > a {
                let cell = self.of_mut(a, before);
                cell.on_links[1] = cell.on_links[1].min(price);
            }
        }
    }

    /// Merges the least prices of triangles on the edge before sample i, the first of a run, and of
    /// one column of tiles.
    pub(super) fn take_link(&mut self, i: usize, to: &FarEnds, least: &Lanes) {
        let (before, run) = (self.runs.of(i - 1), self.runs.of(i));
        for lane in 0..to.count {
            let b = self.runs.of(to.first + lane);
            if b > run {
                let cell = self.of_mut(before, b);
                cell.on_links[0] = cell.on_links[0].min(least[lane]);
            }
        }
    }
}
