//! How a tile of the table is filled: the order in which sums are tested for each of its entries.

use super::Table;
use super::between::{Between, Sides};
use super::entries::{OnEdgesOfRow, RungsOfRow};
use super::least::Least;
use crate::cost::{Aligned, Fan, FanRungs, FarEnds, LANES, Lanes, QUANTUM, Strip};
use crate::triangulate::optimal::lanes::{are_fused, highest, lowest, of_lane};
use crate::triangulate::optimal::normals::NormalBox;
use crate::triangulate::optimal::prune::Open;
use crate::triangulate::optimal::tile_pool::Tile;
use crate::triangulate::{Rule, Terms};
use sheetwright_geometry::math::Vec3;

/// Rounding error of the bound of F at most, for ν = 1: |s|² is at most 9 and comes from some ten
/// operations.
const SLACK: f64 = 1e-13;

/// A column of tiles, while it is filled from the diagonal upwards.
pub(super) struct Column {
    to: FarEnds,
    /// The best k of the row that was filled last, which is near to that of the next one; 0 for
    /// none.
    best: Lanes,
}

impl Column {
    pub(super) fn new(terms: &Terms<'_>, at: usize) -> Self {
        Self { to: terms.prices.far_ends(at * LANES), best: [0.0; LANES] }
    }
}

/// A tile to be filled. A type rather than a closure: the call of a closure by value goes through a
/// function of its own, which is not compiled for the wider registers.
pub(super) struct Filling<'a> {
    pub(super) table: &'a Table<'a>,
    pub(super) open: &'a Open<'a>,
    pub(super) row: usize,
    pub(super) column: &'a mut Column,
    pub(super) tile: &'a mut Tile,
}

impl pulp::WithSimd for Filling<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { table, open, row, column, tile } = self;
        if are_fused::<S>() {
            table.fill_tile::<true>(open, row, column, tile);
        } else {
            table.fill_tile::<false>(open, row, column, tile);
        }
    }
}

/// The rungs of a tile, row by row.
struct Rungs {
    /// Infinite where no entry is wanted.
    prices: [Lanes; LANES],
    /// The sums below each must be less than this; −∞ where no entry is wanted.
    below: [Lanes; LANES],
}

impl Table<'_> {
    /// Fills the tile of these rows and the columns of the far ends, from all tiles to its left and
    /// below.
    #[inline(always)]
    fn fill_tile<const FUSED: bool>(
        &self,
        open: &Open<'_>,
        row: usize,
        column: &mut Column,
        tile: &mut Tile,
    ) {
        match (self.folds, self.terms.rule) {
            (true, _) => self.fill_by::<true, FUSED>(open, row, column, tile, |a, b| a + b),
            (false, Rule::Sum) => {
                self.fill_by::<false, FUSED>(open, row, column, tile, |a, b| a + b);
            }
            (false, Rule::Worst) => {
                self.fill_by::<false, FUSED>(
                    open,
                    row,
                    column,
                    tile,
                    |a, b| if a > b { a } else { b },
                );
            }
        }
    }

    #[inline(always)]
    fn fill_by<const FOLDS: bool, const FUSED: bool>(
        &self,
        open: &Open<'_>,
        row: usize,
        Column { to, best }: &mut Column,
        tile: &mut Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let rows = row * LANES..self.m.min((row + 1) * LANES);
        let (to, column) = (&*to, to.first / LANES);
        let segment = if FOLDS && self.in_order { open.segment(column) } else { None };
        let mut between = Between::new(row, column);
        // On the diagonal and next to it are the edges ⟨i,i+1⟩, which need nothing below them.
        if row + 1 < column {
            let limit = self.sums_below(open.bound, self.least_beside_sums(open, row, column));
            if self.leaves_nothing::<FOLDS>(&mut between, limit, together) {
                return;
            }
        }
        let rungs = self.price_rungs::<FOLDS>(open, row, to, tile);
        let has_box = FOLDS && self.in_order && !open.has_edges(row, column);
        if has_box && let Some(means) = &tile.means {
            self.know_normals(&mut between, NormalBox::of(&rungs.prices, &means.rows));
        }
        for i in rows.rev() {
            let (prices, below) = (&rungs.prices[i % LANES], &rungs.below[i % LANES]);
            if *below == [f64::NEG_INFINITY; LANES] {
                continue;
            }
            let none = Aligned([[0.0; LANES]; 3]);
            let means = &Aligned(tile.means_from(i).copied().unwrap_or(*none));
            let offsets = if FOLDS { self.terms.prices.offsets(i, to) } else { none };
            let mut least = Least {
                i,
                to,
                means,
                fans: self.terms.prices.fans(&offsets, means),
                segment: segment.as_ref(),
                prices: Aligned(*below),
                best: Aligned([0.0; LANES]),
            };
            self.look_first::<FOLDS, FUSED>(&mut least, best, column, tile, together);
            let rungs = RungsOfRow { prices, below };
            let mut on_edges = OnEdgesOfRow::NONE;
            // On flat stretches no price can be lower.
            if FOLDS && self.in_order && highest(&least.prices) > 0.0 {
                on_edges = self.on_edges_of_row(&least, row);
                on_edges.lower(&mut least, &rungs);
            }
            self.look_between::<FOLDS, FUSED>(&mut least, tile, &mut between, together);
            // The tile of the diagonal is not stored while it is being filled.
            let diagonal =
                if row == column { Some(&*tile) } else { self.store.tile(column, column) };
            let entries = self
                .entries_of_row::<FOLDS, FUSED>(&mut least, &rungs, &on_edges, diagonal, together);
            tile.sums.least[i % LANES] = lowest(&entries);
            tile.sums.entries[i % LANES] = entries;
            *best = *least.best;
        }
        if has_box && let Some(means) = &mut tile.means {
            means.within = NormalBox::of(&tile.sums.entries, &means.rows);
        }
    }

    /// How many sides of the triangles i, k, j are rungs at the least, where ⟨k,j⟩ is.
    #[inline(always)]
    pub(super) fn least_rungs(&self, i: usize, k: usize) -> f64 {
        let across = if i == 0 { 0.0 } else { 1.0 };
        across + if k == i + 1 { 1.0 } else { 2.0 }
    }

    /// Prices the rungs of the tile of this row, and writes their N to it.
    #[inline(always)]
    fn price_rungs<const FOLDS: bool>(
        &self,
        open: &Open<'_>,
        row: usize,
        to: &FarEnds,
        tile: &mut Tile,
    ) -> Rungs {
        let mut rungs = Rungs {
            prices: [[f64::INFINITY; LANES]; LANES],
            below: [[f64::NEG_INFINITY; LANES]; LANES],
        };
        let mut strip = Strip::BLANK;
        for i in row * LANES..self.m.min((row + 1) * LANES) {
            let near = open.band.map(|band| band.lanes(i, to));
            if near.is_some_and(|near| near == [false; LANES]) {
                continue;
            }
            let rests = self.outside.as_ref().map_or([0.0; LANES], |of| of.row(i, to.first));
            let least = lowest(&rests);
            if least == f64::INFINITY {
                continue;
            }
            // Half the price of a rung and the rest of the loop must not exceed the bound.
            let dearest = open.bound.min(2.0 * (open.bound - least));
            self.terms.strip::<FOLDS>(i, to, dearest, &mut strip);
            if let Some(of_tile) = &mut tile.means {
                of_tile.rows[i % LANES] = *strip.means;
            }
            // The share of the price of a rung that counts beside the bound on the rest.
            let share = if self.outside.is_some() { 0.5 } else { 1.0 };
            let mut together = [0.0; LANES];
            for n in 0..LANES {
                together[n] = share * strip.prices[n] + rests[n];
            }
            if let Some(near) = near {
                for n in 0..LANES {
                    let is_near = near[n] || to.first + n <= i + 1;
                    together[n] = if is_near { together[n] } else { f64::INFINITY };
                }
            }
            // One list after the other: else the lanes are looked at one by one.
            let (prices, below) = (&mut rungs.prices[i % LANES], &mut rungs.below[i % LANES]);
            let most = open.bound.min(f64::MAX);
            for n in 0..LANES {
                prices[n] = if together[n] <= most { strip.prices[n] } else { f64::INFINITY };
            }
            for n in 0..LANES {
                let limit = self.sums_below(open.bound, together[n]);
                below[n] = if together[n] <= most { limit } else { f64::NEG_INFINITY };
            }
        }
        rungs
    }

    /// Lower bound on the price of a rung of the tile of these rows and columns together with the
    /// rest of the loop.
    #[inline(always)]
    fn least_beside_sums(&self, open: &Open<'_>, row: usize, column: usize) -> f64 {
        let least = open.least(row, column).max(0.0);
        match &self.outside {
            Some(outside) if !open.has_edges(row, column) => {
                (outside.least(row, column) + 0.5 * least).max(least)
            }
            _ => least,
        }
    }

    /// Upper limit of the sums below a rung of this price, for entries up to `bound`.
    #[inline(always)]
    fn sums_below(&self, bound: f64, price: f64) -> f64 {
        let left = match self.terms.rule {
            Rule::Sum => bound - price,
            Rule::Worst => bound,
        };
        // Prices up to the bound lie below the next multiple of the quantum.
        left + QUANTUM
    }

    /// Tests those k before the column that were best one row below.
    #[inline(always)]
    fn look_first<const FOLDS: bool, const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        best: &Lanes,
        column: usize,
        tile: &Tile,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let row = least.i / LANES;
        // The sample before those of the column matters for the triangle on the edge between, which
        // is done.
        let end = least.to.first.saturating_sub(usize::from(FOLDS && self.in_order));
        let mut last = 0;
        for n in 0..LANES {
            let k = best[n] as usize;
            if k <= least.i || k == last || k >= end {
                continue;
            }
            last = k;
            let (Some(own), Some(beyond)) =
                (self.store.tile(row, k / LANES), self.tile_of(k / LANES, row, column, tile))
            else {
                continue;
            };
            let entry = own.sums.entries[least.i % LANES][k % LANES];
            if entry < f64::INFINITY {
                let means = own.means_from(least.i);
                self.look::<FOLDS, FUSED>(least, k, entry, means, beyond, together);
            }
        }
    }

    /// Tests the k before those of the column.
    #[inline(always)]
    fn look_between<'a, const FOLDS: bool, const FUSED: bool>(
        &'a self,
        least: &mut Least<'_>,
        tile: &Tile,
        between: &mut Between<'a>,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) {
        let (row, mut reach) = (between.row, highest(&least.prices));
        // The tile itself is not stored while it is being filled.
        if reach > 0.0
            && let Some(own) = self.store.tile(row, row)
        {
            reach = self.look_through::<FOLDS, FUSED>(least, reach, row, (own, tile), together);
        }
        let mut n = 0;
        while reach > 0.0 && (n < between.found.len() || self.find_next::<FOLDS>(between, together))
        {
            let sides = &between.found[n];
            if sides.least < reach {
                let Sides { at, own, beyond, .. } = *sides;
                reach =
                    self.look_through::<FOLDS, FUSED>(least, reach, at, (own, beyond), together);
            }
            n += 1;
        }
    }

    /// Tests the k of one column of tiles. Of the 16, only those are tested whose E(i,k) and the
    /// least E(k,j) together lie below `reach`, the highest of the least prices. Returns the new
    /// `reach`.
    #[inline(always)]
    fn look_through<const FOLDS: bool, const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        reach: f64,
        at: usize,
        (own, beyond): (&Tile, &Tile),
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) -> f64 {
        let (entries, means) = (&own.sums.entries[least.i % LANES], own.means_from(least.i));
        let mut left = 0u32;
        for n in 0..LANES {
            let is_below = together(entries[n], beyond.sums.least[n]) < reach;
            left |= u32::from(is_below) << n;
        }
        if left == 0 {
            return reach;
        }
        if FOLDS
            && self.in_order
            && let Some(offsets) = self.terms.prices.offsets_to_run(least.i, at * LANES)
        {
            self.look_at_sides::<FUSED>(least, at, &offsets, (left, reach), (own, beyond));
            return highest(&least.prices);
        }
        while left != 0 {
            let n = left.trailing_zeros() as usize;
            left &= left - 1;
            let k = at * LANES + n;
            self.look::<FOLDS, FUSED>(least, k, entries[n], means, beyond, together);
        }
        highest(&least.prices)
    }

    /// The tile in a column of them, of which `tile`, in `row`, is not yet stored.
    #[inline(always)]
    fn tile_of<'t>(
        &'t self,
        wanted: usize,
        row: usize,
        column: usize,
        tile: &'t Tile,
    ) -> Option<&'t Tile> {
        if wanted == row { Some(tile) } else { self.store.tile(wanted, column) }
    }

    /// Tests the triangles i, k, j of all j of the tile `beyond`, with E(i,k) = `entry` and N of
    /// the rungs from i to the samples around k.
    #[inline(always)]
    pub(super) fn look<const FOLDS: bool, const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        means_from_i: Option<&[Lanes; 3]>,
        beyond: &Tile,
        together: impl Fn(f64, f64) -> f64,
    ) {
        let entries = &beyond.sums.entries[k % LANES];
        if FOLDS {
            let mut below = false;
            for n in 0..LANES {
                below |= entry + entries[n] < least.prices[n];
            }
            if below && let (Some(from_i), Some(means)) = (means_from_i, beyond.means_from(k)) {
                let shared = of_lane(from_i, k % LANES);
                self.look_closer::<FUSED>(least, k, entry, shared, (entries, means));
            }
            return;
        }
        least.lower(k, |n| together(entry, entries[n]));
    }

    /// Tests the triangles i, k, j of one k and all j where F decides: some of the sums
    /// E(i,k) + E(k,j) lie below the least prices. `shared` is the N of ⟨i,k⟩, `means` are those of
    /// the ⟨k,j⟩.
    #[inline(always)]
    fn look_closer<const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        k: usize,
        entry: f64,
        shared: [f64; 3],
        (entries, means): (&Lanes, &[Lanes; 3]),
    ) {
        let fan = Fan { side: self.terms.prices.offset(least.i, k), shared, beyond: means };
        if !self.in_order {
            return self.look_singly(least, (k, entry), &fan, entries);
        }
        let rungs = self.rungs_of_fan(least.i, k, least.to).least();
        let left = least.left(entry, entries);
        self.look_at_fan::<FUSED>(least, (k, entry), (&fan, rungs), (entries, &left));
    }

    /// Tests the triangles of those sides ⟨i,k⟩ that have a bit in `left`, with k in the column of
    /// tiles `at`, which `offsets` lead to, on loops whose members are numbered in order. Sides
    /// whose own share in F is too large for all j are skipped as a whole.
    #[inline(always)]
    fn look_at_sides<const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        at: usize,
        offsets: &[Lanes; 3],
        (mut left, reach): (u32, f64),
        (own, beyond): (&Tile, &Tile),
    ) {
        let (i, first) = (least.i, at * LANES);
        let entries = &own.sums.entries[i % LANES];
        let (Some(means), Some(means_beyond)) = (own.means_from(i), &beyond.means) else { return };
        if let Some(segment) = least.segment {
            let mut limits = [0.0; LANES];
            for n in 0..LANES {
                limits[n] = reach - (entries[n] + beyond.sums.least[n]);
            }
            left &= self.terms.prices.sides_below::<FUSED>(i, offsets, means, segment, &limits);
        }
        while left != 0 {
            let n = left.trailing_zeros() as usize;
            left &= left - 1;
            let fan = Fan {
                side: of_lane(offsets, n),
                shared: of_lane(means, n),
                beyond: &means_beyond.rows[n],
            };
            let (k, entry, sums) = (first + n, entries[n], &beyond.sums.entries[n]);
            // The triangle on an edge to the column is done.
            let edge = if k + 1 == least.to.first { 0 } else { usize::MAX };
            let left = least.left_but(edge, entry, sums);
            let rungs = self.least_rungs(i, k);
            self.look_at_fan::<FUSED>(least, (k, entry), (&fan, rungs), (sums, &left));
        }
    }

    /// Tests the triangles i, k, j of one k and all j, with E(i,k) = `entry`, E(k,j) = `entries`,
    /// and at least so many `rungs` each, whose F is below `left`.
    #[inline(always)]
    pub(super) fn look_at_fan<const FUSED: bool>(
        &self,
        least: &mut Least<'_>,
        (k, entry): (usize, f64),
        (fan, rungs): (&Fan<'_>, f64),
        (entries, left): (&Lanes, &Lanes),
    ) {
        if !least.fans.may_be_below::<FUSED>(fan, rungs, left) {
            return;
        }
        let folds = least.fans.prices(fan, self.rungs_of_fan(least.i, k, least.to));
        least.lower(k, |n| entry + entries[n] + folds[n]);
    }

    /// How many sides of the triangles i, k, j are rungs: ⟨i,k⟩, ⟨k,j⟩ or ⟨i,j⟩ may be an edge of
    /// the boundary.
    #[inline(always)]
    pub(in crate::triangulate::optimal) fn rungs_of_fan(
        &self,
        i: usize,
        k: usize,
        to: &FarEnds,
    ) -> FanRungs {
        let last = if i == 0 { self.m - 1 } else { usize::MAX };
        FanRungs {
            most: if k == i + 1 { 2.0 } else { 3.0 },
            fewer: [(k + 1).wrapping_sub(to.first), last.wrapping_sub(to.first)],
        }
    }

    /// Tests the triangles i, k, j of one k, one j after the other, where samples are not numbered
    /// in order. A lower bound on F from the N alone comes first, and spares most of them F itself.
    #[inline(never)]
    fn look_singly(
        &self,
        least: &mut Least<'_>,
        (k, entry): (usize, f64),
        fan: &Fan<'_>,
        entries: &Lanes,
    ) {
        let rungs = self.rungs_of_fan(least.i, k, least.to);
        let fold = self.terms.prices.options().fold;
        for n in 0..least.to.count {
            let sum = entry + entries[n];
            if sum >= least.prices[n] {
                continue;
            }
            let of_sides =
                [fan.shared, of_lane(fan.beyond, n), of_lane(least.means, n)].map(Vec3::from_array);
            let square = (of_sides[0] + of_sides[1] + of_sides[2]).length_squared();
            let rungs = rungs.of(n);
            let bound = fold * ((rungs * rungs - square) / (2.0 * rungs.max(1.0)) - SLACK);
            if sum + bound < least.prices[n] {
                let corners = [least.i, k, least.to.first + n];
                let price = sum + self.terms.prices.triangle(corners, of_sides);
                if price < least.prices[n] {
                    (least.prices[n], least.best[n]) = (price, k as f64);
                }
            }
        }
    }
}
