//! The cheapest path from one set of starts on the cover of a band to its image, once round.
//!
//! Every walk jumps over the outer edge before o once, from a place P before it to a place Q at or
//! behind it, along some inner place A. For given (Q, A) the walk is a shortest path from (Q, A) to
//! (Q + m, A + k) through an acyclic grid: O(m k (m + k)). A *sweep* goes through the grid once,
//! for all starts of a set.

use super::super::cover::{Along, BandWalk, Count, Grid, Least, Pair, Starts, before};
use super::super::pockets::least_of;
use super::super::work::Work;
use super::{Band, TriangulateError};
use crate::cost::QUANTUM;
use sheetwright_geometry::watch::Watch;

impl Band<'_, '_> {
    /// The cheapest path from one of the starts to the image of one of them.
    pub(super) fn sweep(
        &self,
        starts: &Starts,
        bound: f64,
        work: Work<'_>,
        watch: &mut dyn Watch,
    ) -> Result<Option<BandWalk>, TriangulateError> {
        let grid = Grid::new(starts, self.m(), self.k());
        let mut least = Least::new(&grid);
        let is_whole = self.each_join(&grid, bound, work, watch, |at, price| {
            let reached = if starts.contain(grid.pair(at.0, at.1)) {
                Some(0.0)
            } else {
                let below = bound - price + QUANTUM;
                self.arrive(&grid, &least, at, below).map(|(least, _)| price + least)
            };
            if let Some(reached) = reached {
                least.set(&grid, at, reached);
            }
        })?;
        if !is_whole {
            return Ok(None);
        }
        Ok(self.last_step(&grid, &least, starts, bound).map(|(price, (c, r), end)| {
            let mut at = (c, r);
            let mut pairs = vec![grid.pair(c, r)];
            while !starts.contain(grid.pair(at.0, at.1)) {
                let Some((_, before)) = self.arrive(&grid, &least, at, f64::INFINITY) else {
                    break;
                };
                at = before;
                pairs.push(grid.pair(at.0, at.1));
            }
            pairs.reverse();
            BandWalk { price, pairs, end, m: self.m(), k: self.k() }
        }))
    }

    /// Goes through the pairs of a grid, column by column, and visits those whose rungs cost no
    /// more than `bound`: the column and the row, and the price. Returns whether it came to the
    /// end; false where the work limit ended it.
    #[inline(always)]
    fn each_join(
        &self,
        grid: &Grid,
        bound: f64,
        work: Work<'_>,
        watch: &mut dyn Watch,
        mut visit: impl FnMut((usize, usize), f64),
    ) -> Result<bool, TriangulateError> {
        for c in 0..grid.columns {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            if work.is_out() {
                return Ok(false);
            }
            watch.progress(c as f64 / grid.columns as f64);
            work.count(grid.rows as u64);
            for r in 0..grid.rows {
                let (p, a) = grid.pair(c, r);
                let price = self.join_price(p, a);
                if price <= bound {
                    visit((c, r), price);
                }
            }
        }
        Ok(true)
    }

    /// The cheapest way to arrive at a pair, without its own rung, if it is below `below`.
    fn arrive(
        &self,
        grid: &Grid,
        least: &Least,
        at: (usize, usize),
        below: f64,
    ) -> Option<(f64, (usize, usize))> {
        let outer = self.arrive_along(grid, least, at, below, Along::Outer);
        let below = outer.map_or(below, |(price, _)| price);
        self.arrive_along(grid, least, at, below, Along::Inner).or(outer)
    }

    /// The cheapest last step of all paths: its price, where it begins, and where it arrives.
    fn last_step(
        &self,
        grid: &Grid,
        least: &Least,
        starts: &Starts,
        bound: f64,
    ) -> Option<(f64, (usize, usize), Pair)> {
        let mut best: Option<(f64, (usize, usize), Pair)> = None;
        for q in starts.outer.0..=starts.outer.1 {
            for a in starts.inner.0..=starts.inner.1 {
                let price = self.join_price(q, a);
                if price > bound {
                    continue;
                }
                let r = grid.row_of(a + self.k());
                let below = best.map_or(bound + QUANTUM, |best| best.0) - price;
                if let Some((sum, c)) = self.closing(grid, least.row(grid, r), (q, a), below) {
                    best = Some((price + sum, (c, r), (q, a)));
                }
            }
        }
        best
    }

    /// The cheapest last step that arrives at the image of (q, a), below `below`, from a row of
    /// prices: without the rung that it arrives at, and the column where it begins.
    fn closing(&self, grid: &Grid, row: &[f64], (q, a): Pair, below: f64) -> Option<(f64, usize)> {
        let m = self.m();
        // From the first place behind q, over m − 1 edges at the most.
        let first = q + 1 - grid.first.0;
        if first >= grid.columns {
            return None;
        }
        self.chains.work.count((grid.columns - first) as u64);
        let longest = q + m - grid.pair(first, 0).0;
        let jumps = &self.outer_pockets.ending_at(q)[m - longest..][..grid.columns - first];
        least_of(&row[first..], jumps, below, |at| {
            self.outer_fold(grid.pair(first + at, 0).0, q, a)
        })
        .map(|(price, at)| (price, first + at))
    }

    /// As [`Self::sweep`], over paths that count their steps, of which only simple walks count.
    pub(super) fn counting_sweep(
        &self,
        starts: &Starts,
        bound: f64,
        work: Work<'_>,
        watch: &mut dyn Watch,
    ) -> Result<Option<BandWalk>, TriangulateError> {
        let grid = Grid::new(starts, self.m(), self.k());
        let mut layers: Vec<Least> = (0..Count::ALL).map(|_| Least::new(&grid)).collect();
        let mut from: Vec<Option<(u32, u32, u8)>> = vec![None; Count::ALL * grid.cells()];
        let steps: Vec<Vec<(usize, Along)>> =
            (0..Count::ALL).map(|number| before(Count::of_number(number)).collect()).collect();
        let is_whole = self.each_join(&grid, bound, work, watch, |at, price| {
            if starts.contain(grid.pair(at.0, at.1)) {
                layers[Count::START.number()].set(&grid, at, 0.0);
            }
            for number in 0..Count::ALL {
                let here = layers[number].at(&grid, at);
                let mut arrived: Vec<(f64, usize, (usize, usize))> = Vec::new();
                for &(before, along) in &steps[number] {
                    let layer = &layers[before];
                    let below = (bound - price + QUANTUM).min(here);
                    let found = self.arrive_along(&grid, layer, at, below, along);
                    arrived.extend(found.map(|(sum, at)| (price + sum, before, at)));
                }
                let best = arrived.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((sum, before, (c, r))) = best.filter(|best| best.0 < here) {
                    layers[number].set(&grid, at, sum);
                    from[number * grid.cells() + grid.cell(at)] =
                        Some((c as u32, r as u32, before as u8));
                }
            }
        })?;
        if !is_whole {
            return Ok(None);
        }
        let mut best: Option<(f64, (usize, usize), Pair, usize)> = None;
        for (number, layer) in layers.iter().enumerate() {
            if Count::of_number(number).after(Along::Outer).is_simple() {
                let bound = best.map_or(bound, |best| best.0);
                if let Some((price, at, end)) = self.last_step(&grid, layer, starts, bound)
                    && best.is_none_or(|best| price < best.0)
                {
                    best = Some((price, at, end, number));
                }
            }
        }
        Ok(best.map(|(price, mut at, end, mut number)| {
            let mut pairs = vec![grid.pair(at.0, at.1)];
            while let Some((c, r, before)) = from[number * grid.cells() + grid.cell(at)] {
                (at, number) = ((c as usize, r as usize), usize::from(before));
                pairs.push(grid.pair(at.0, at.1));
            }
            pairs.reverse();
            BandWalk { price, pairs, end, m: self.m(), k: self.k() }
        }))
    }

    /// As [`Self::arrive`], along one chain only.
    fn arrive_along(
        &self,
        grid: &Grid,
        least: &Least,
        (c, r): (usize, usize),
        below: f64,
        along: Along,
    ) -> Option<(f64, (usize, usize))> {
        let (m, k) = (self.m(), self.inner.len());
        let (p, a) = grid.pair(c, r);
        match along {
            Along::Outer => {
                let jumps = &self.outer_pockets.ending_at(p % m)[m - c..];
                self.chains.work.count(c as u64);
                least_of(&least.row(grid, r)[..c], jumps, below, |c| {
                    self.outer_fold(grid.pair(c, r).0, p, a)
                })
                .map(|(price, at)| (price, (at, r)))
            }
            Along::Inner => {
                let first = r.saturating_sub(k - 1);
                self.chains.work.count((r - first) as u64);
                let jumps = &self.inner_pockets.ending_at(self.below(a))[k - (r - first)..];
                least_of(&least.column(grid, c)[first..r], jumps, below, |at| {
                    self.inner_fold(p, grid.pair(c, first + at).1, a)
                })
                .map(|(price, at)| (price, (c, first + at)))
            }
        }
    }
}
