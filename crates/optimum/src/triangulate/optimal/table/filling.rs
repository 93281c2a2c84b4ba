//! How a tile of the table is filled: equation (5) for 16 rows, and in each row for 16 rungs side
//! by side.

use super::{Pruning, Table};
use crate::cost::{Aligned, Fan, FarEnds, LANES, Lanes, QUANTUM, Strip};
use crate::triangulate::Rule;
use crate::triangulate::optimal::lanes::{highest, lowest, of_lane};
use crate::triangulate::optimal::tile_pool::{Tile, TilePool};
use sheetwright_geometry::math::Vec3;

/// A tile to be filled. A type rather than a closure: the call of a closure by value goes through a
/// function of its own, which is not compiled for the wider registers.
pub(super) struct Filling<'a> {
    pub(super) table: &'a Table<'a>,
    pub(super) pruning: &'a dyn Pruning,
    pub(super) row: usize,
    pub(super) to: &'a FarEnds,
    pub(super) tile: &'a mut Tile,
}

impl pulp::WithSimd for Filling<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        match (self.table.folds, self.table.terms.rule) {
            (true, _) => self.fill::<true>(|a, b| a + b),
            (false, Rule::Sum) => self.fill::<false>(|a, b| a + b),
            (false, Rule::Worst) => self.fill::<false>(|a, b| if a > b { a } else { b }),
        }
    }
}

/// Two tiles whose rungs are sides of triangles with those of the tile that is filled.
struct Sides<'t> {
    /// The columns of the first, which are the rows of the second.
    at: usize,
    own: &'t Tile,
    beyond: &'t Tile,
    /// The least that two entries, one of each, are together.
    least: f64,
}

/// The rungs from one sample to those of the tile.
struct Row {
    i: usize,
    /// The price of each; infinite where nothing is looked for.
    prices: Aligned<Lanes>,
    /// What the sums below each must be less than; infinitely low where nothing is looked for.
    below: Aligned<Lanes>,
    /// The least sums so far.
    sums: Aligned<Lanes>,
    /// The ways to the far ends, and N of the rungs, by axis; mean nothing without folds.
    offsets: Aligned<[Lanes; 3]>,
    means: Aligned<[Lanes; 3]>,
}

impl Row {
    /// Takes the sums of one k that are lower.
    #[inline(always)]
    fn lower(&mut self, sum: impl Fn(usize) -> f64) {
        let mut sums = [0.0; LANES];
        for n in 0..LANES {
            sums[n] = sum(n);
        }
        // One list after the other: else the lanes are compared one by one.
        for n in 0..LANES {
            self.sums[n] = if sums[n] < self.sums[n] { sums[n] } else { self.sums[n] };
        }
    }
}

impl<'a> Filling<'a> {
    #[inline(always)]
    fn fill<const FOLDS: bool>(self, together: impl Fn(f64, f64) -> f64 + Copy) {
        let Self { table, row, to, .. } = self;
        let column = to.first / LANES;
        let between = self.between(together);
        // On the diagonal and next to it are the edges ⟨i,i+1⟩, which need nothing below them. Of
        // the entries of another tile, the first that is found has its k between.
        if row + 1 < column {
            let limit = self.sums_below(self.pruning.least(row, column));
            if between.iter().all(|sides| sides.least >= limit) {
                return;
            }
        }
        for i in (row * LANES..table.m.min((row + 1) * LANES)).rev() {
            let Some(mut of_row) = self.price_rungs::<FOLDS>(i) else { continue };
            if let Some(means) = &mut self.tile.means {
                means[i % LANES] = *of_row.means;
            }
            // With k in the rows of the tile itself, in a tile between, and in its own column.
            if let Some(own) = table.store.tile(row, row) {
                self.look_through::<FOLDS>(&mut of_row, row, [own, self.tile], together);
            }
            let mut reach = highest(&of_row.sums);
            for sides in &between {
                if sides.least < reach {
                    let Sides { at, own, beyond, .. } = *sides;
                    self.look_through::<FOLDS>(&mut of_row, at, [own, beyond], together);
                    reach = highest(&of_row.sums);
                }
            }
            // The tile of the diagonal is not stored while it is being filled.
            let diagonal =
                if row == column { Some(&*self.tile) } else { table.store.tile(column, column) };
            let mut entries = [f64::INFINITY; LANES];
            for n in 0..to.count {
                let j = to.first + n;
                if j == i + 1 {
                    entries[n] = of_row.prices[n];
                } else if j > i && of_row.sums[n] < of_row.below[n] {
                    entries[n] = together(of_row.prices[n], of_row.sums[n]);
                }
                if entries[n] < f64::INFINITY
                    && let Some(diagonal) = diagonal
                {
                    let mean = of_lane(&of_row.means, n);
                    self.look::<FOLDS>(&mut of_row, (j, entries[n]), mean, diagonal, together);
                }
            }
            self.tile.sums.least[i % LANES] = lowest(&entries);
            self.tile.sums.entries[i % LANES] = entries;
        }
    }

    /// The tiles between the rows and the column of the tile.
    fn between(&self, together: impl Fn(f64, f64) -> f64) -> Vec<Sides<'a>> {
        let (store, column): (&'a TilePool, _) = (&self.table.store, self.to.first / LANES);
        let columns = store.beside(self.row).iter().map(|at| *at as usize);
        let sides = columns.filter(|at| *at > self.row).filter_map(|at| {
            let (own, beyond) = (store.tile(self.row, at)?, store.tile(at, column)?);
            let least = together(lowest(&own.sums.least), lowest(&beyond.sums.least));
            Some(Sides { at, own, beyond, least })
        });
        sides.collect()
    }

    /// Prices the rungs from sample i; `None` where none of them is looked for.
    #[inline(always)]
    fn price_rungs<const FOLDS: bool>(&self, i: usize) -> Option<Row> {
        let Self { table, to, .. } = self;
        let rests = self.pruning.rests(i, to);
        if lowest(&rests) == f64::INFINITY {
            return None;
        }
        let mut strip = Strip::BLANK;
        table.terms.strip::<FOLDS>(i, to, &mut strip);
        let (mut prices, mut below) = (strip.prices, Aligned([f64::NEG_INFINITY; LANES]));
        let most = self.pruning.bound().min(f64::MAX);
        let mut any = false;
        for n in 0..LANES {
            // The price of the rung is at least the half of it that the rest of the loop leaves.
            let with_rest = (0.5 * prices[n] + rests[n]).max(prices[n]);
            let is_in = with_rest <= most;
            below[n] = if is_in { self.sums_below(with_rest) } else { f64::NEG_INFINITY };
            prices[n] = if is_in { prices[n] } else { f64::INFINITY };
            any |= is_in;
        }
        let offsets = if FOLDS { table.terms.prices.offsets(i, to) } else { strip.means };
        any.then_some(Row { i, prices, below, sums: below, offsets, means: strip.means })
    }

    /// What sums below a rung must be less than that costs so much with the rest of the loop.
    #[inline(always)]
    fn sums_below(&self, with_rest: f64) -> f64 {
        let left = match self.table.terms.rule {
            Rule::Sum => self.pruning.bound() - with_rest,
            Rule::Worst => self.pruning.bound(),
        };
        // Prices up to the bound lie below the next multiple of the quantum.
        left + QUANTUM
    }

    /// Looks at the k of one column of tiles, which are the columns of the first and the rows of
    /// the second: at those whose E(i,k) and least E(k,j) together lie below any sum so far.
    #[inline(always)]
    fn look_through<const FOLDS: bool>(
        &self,
        of_row: &mut Row,
        at: usize,
        [own, beyond]: [&Tile; 2],
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let entries = &own.sums.entries[of_row.i % LANES];
        let highest = highest(&of_row.sums);
        let mut left = 0u32;
        for n in 0..LANES {
            let is_below = together(entries[n], beyond.sums.least[n]) < highest;
            left |= u32::from(is_below) << n;
        }
        while left != 0 {
            let n = left.trailing_zeros() as usize;
            left &= left - 1;
            let mean = own.means_from(of_row.i).map_or([0.0; 3], |means| of_lane(means, n));
            self.look::<FOLDS>(of_row, (at * LANES + n, entries[n]), mean, beyond, together);
        }
    }

    /// Looks at the triangles i, k, j of one k and all j of the tile `beyond`, with E(i,k) =
    /// `entry` and `mean` the N of ⟨i,k⟩. F is never negative, so it is worked out only where one
    /// of the sums without it is lower than those so far.
    #[inline(always)]
    fn look<const FOLDS: bool>(
        &self,
        of_row: &mut Row,
        (k, entry): (usize, f64),
        mean: [f64; 3],
        beyond: &Tile,
        together: impl Fn(f64, f64) -> f64,
    ) {
        let entries = &beyond.sums.entries[k % LANES];
        if !FOLDS {
            return of_row.lower(|n| together(entry, entries[n]));
        }
        let mut any = false;
        for n in 0..LANES {
            any |= entry + entries[n] < of_row.sums[n];
        }
        let Some(means) = beyond.means_from(k).filter(|_| any) else { return };
        if self.table.in_order {
            let fan = Fan {
                corners: [of_row.i, k],
                to: self.to,
                offsets: &of_row.offsets,
                means: (mean, means, &of_row.means),
            };
            let folds = self.table.terms.prices.fan(&fan);
            of_row.lower(|n| entry + entries[n] + folds[n]);
        } else {
            self.look_singly(of_row, (k, entry), mean, (entries, means));
        }
    }

    /// As [`Self::look`], one j after the other, where samples are not numbered in order.
    #[inline(never)]
    fn look_singly(
        &self,
        of_row: &mut Row,
        (k, entry): (usize, f64),
        mean: [f64; 3],
        (entries, means): (&Lanes, &[Lanes; 3]),
    ) {
        for n in 0..self.to.count {
            let sum = entry + entries[n];
            if sum < of_row.sums[n] {
                let sides = [mean, of_lane(means, n), of_lane(&of_row.means, n)];
                let corners = [of_row.i, k, self.to.first + n];
                let fold = self.table.terms.prices.triangle(corners, sides.map(Vec3::from_array));
                of_row.sums[n] = of_row.sums[n].min(sum + fold);
            }
        }
    }
}
