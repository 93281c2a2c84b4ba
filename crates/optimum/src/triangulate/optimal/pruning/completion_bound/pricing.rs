//! Prices of the rungs between the samples of two tiles, and of the triangles on edges of the
//! boundary with such rungs as sides: sixteen at a time.

use super::blocks::{Block, Gathered};
use super::on_edges::OnEdges;
use crate::cost::{Aligned, FarEnds, LANES, Lanes, Strip};
use crate::triangulate::Terms;
use crate::triangulate::optimal::lanes::{lowest, of_lane};
use std::ops::Range;

/// Numbers of the rungs from one sample to those of a tile, preceded by that of the rung before
/// them: triangles on edges of the tile combine each rung with the one before. To read them one
/// place earlier is faster than to shift them by one lane.
#[derive(Clone, Copy)]
struct Numbers(Aligned<[f64; 2 * LANES]>);

impl Numbers {
    const fn all(of: f64) -> Self {
        Self(Aligned([of; 2 * LANES]))
    }

    #[inline(always)]
    fn set(&mut self, before: f64, lanes: &Lanes) {
        self.0[LANES - 1] = before;
        self.0[LANES..].copy_from_slice(lanes);
    }

    /// Of the rungs to the samples of the tile.
    #[inline(always)]
    fn lanes(&self) -> Lanes {
        self.from(LANES)
    }

    /// Of the rungs to the samples before those.
    #[inline(always)]
    fn before(&self) -> Lanes {
        self.from(LANES - 1)
    }

    #[inline(always)]
    fn from(&self, first: usize) -> Lanes {
        let mut lanes = [0.0; LANES];
        for n in 0..LANES {
            lanes[n] = self.0[first + n];
        }
        lanes
    }
}

/// The rungs from one sample to those of a tile.
#[derive(Clone, Copy)]
pub(super) struct Row {
    /// Infinite where there is none up to the bound.
    prices: Numbers,
    /// Where any of them is finite.
    any: bool,
    means: [Numbers; 3],
    offsets: [Numbers; 3],
}

impl Row {
    /// If none is up to the bound.
    pub(super) const NONE: Self = Self {
        prices: Numbers::all(f64::INFINITY),
        any: false,
        means: [Numbers::all(0.0); 3],
        offsets: [Numbers::all(0.0); 3],
    };

    /// Takes over the last row of a tile, whose rungs before the first one no longer matter.
    #[inline(always)]
    fn set_last(&mut self, row: &LastRow, offsets: impl Fn() -> Aligned<[Lanes; 3]>) {
        self.any = row.any;
        if row.any {
            self.set(&LastRung::NONE, [0.0; 3], &row.strip, &offsets());
        }
    }

    #[inline(always)]
    fn set(&mut self, before: &LastRung, to_before: [f64; 3], strip: &Strip, offsets: &[Lanes; 3]) {
        self.prices.set(before.price, &strip.prices);
        for axis in 0..3 {
            self.means[axis].set(before.mean[axis], &strip.means[axis]);
            self.offsets[axis].set(to_before[axis], &offsets[axis]);
        }
    }

    /// Lowers the least prices by the triangles on the edges before the samples j of the tile:
    /// those with the corners i, j − 1 and j. The last sample of the loop comes after `i`.
    #[inline(always)]
    fn lower_on_column_edges(
        &self,
        least: &mut Lanes,
        fold: f64,
        [i, last]: [usize; 2],
        to: &FarEnds,
    ) {
        if !self.any {
            return;
        }
        let triangles = OnEdges {
            offsets: [
                &self.offsets.each_ref().map(Numbers::before),
                &self.offsets.each_ref().map(Numbers::lanes),
            ],
            means: [
                &self.means.each_ref().map(Numbers::before),
                &self.means.each_ref().map(Numbers::lanes),
            ],
            rungs: rungs(to.first, [i + 2, if i == 0 { last } else { usize::MAX }]),
        };
        let prices = [&self.prices.before(), &beyond(i + 1, to, &self.prices.lanes())];
        lower_on_edges(least, fold, prices, &triangles);
    }

    /// Lowers the least prices by the triangles on the edge between the sample that these rungs
    /// lead from and the next one, i, whose rungs are `strip`: those with the corners i − 1, i and
    /// j.
    #[inline(always)]
    fn lower_on_row_edge(
        &self,
        least: &mut Lanes,
        terms: &Terms<'_>,
        i: usize,
        to: &FarEnds,
        strip: &Strip,
    ) {
        let (prices, last) = (terms.prices, terms.prices.len() - 1);
        let triangles = OnEdges {
            offsets: [
                &prices.offset(i - 1, i).map(|x| [x; LANES]),
                &self.offsets.each_ref().map(Numbers::lanes),
            ],
            means: [&strip.means, &self.means.each_ref().map(Numbers::lanes)],
            rungs: rungs(to.first, [i + 1, if i == 1 { last } else { usize::MAX }]),
        };
        let of_rungs = [&beyond(i, to, &strip.prices), &self.prices.lanes()];
        lower_on_edges(least, prices.options().fold, of_rungs, &triangles);
    }
}

/// The rung that leads to the last sample of a tile.
#[derive(Clone, Copy)]
pub(super) struct LastRung {
    /// Infinite if there is none up to the bound.
    price: f64,
    mean: [f64; 3],
}

impl LastRung {
    pub(super) const NONE: Self = Self { price: f64::INFINITY, mean: [0.0; 3] };
}

/// The rungs from the last sample of a tile's rows.
#[derive(Clone, Copy)]
pub(super) struct LastRow {
    strip: Strip,
    /// Whether any of them is up to the bound; if not, the other fields are undefined.
    any: bool,
}

impl LastRow {
    pub(super) const NONE: Self = Self { strip: Strip::BLANK, any: false };
}

/// Prices the rungs from sample i to those of a tile, infinite if above the bound; returns whether
/// any is not.
#[inline(always)]
fn price_up_to(terms: &Terms<'_>, bound: f64, i: usize, to: &FarEnds, strip: &mut Strip) -> bool {
    terms.strip::<true>(i, to, strip);
    for price in strip.prices.iter_mut() {
        *price = if *price <= bound { *price } else { f64::INFINITY };
    }
    lowest(&strip.prices) < f64::INFINITY
}

/// Lowers the least prices to those of triangles on edges of the boundary, with half of the prices
/// of their rungs, `prices`, where these are lower.
#[inline(always)]
fn lower_on_edges(least: &mut Lanes, fold: f64, prices: [&Lanes; 2], triangles: &OnEdges<'_>) {
    let mut rungs = [0.0; LANES];
    let mut any = false;
    for lane in 0..LANES {
        rungs[lane] = 0.5 * (prices[0][lane] + prices[1][lane]);
        any |= rungs[lane] < least[lane];
    }
    if !any {
        return;
    }
    let folds = triangles.least_prices(fold);
    for lane in 0..LANES {
        let price = rungs[lane] + folds[lane];
        least[lane] = if price < least[lane] { price } else { least[lane] };
    }
}

/// The prices of the rungs to samples beyond i.
#[inline(always)]
fn beyond(i: usize, to: &FarEnds, prices: &Lanes) -> Lanes {
    let mut beyond = *prices;
    for lane in 0..LANES {
        beyond[lane] = if to.first + lane > i { prices[lane] } else { f64::INFINITY };
    }
    beyond
}

/// For samples from `first` on, how many of the two sides to each are rungs, if those to `edges`
/// are not.
#[inline(always)]
fn rungs(first: usize, edges: [usize; 2]) -> Lanes {
    let mut rungs = [2.0; LANES];
    for edge in edges {
        if let Some(rungs) = rungs.get_mut(edge.wrapping_sub(first)) {
            *rungs -= 1.0;
        }
    }
    rungs
}

/// A tile to be priced. A type rather than a closure, as that of the table.
pub(super) struct Pricing<'p, 'c> {
    pub(super) terms: &'p Terms<'p>,
    pub(super) bound: f64,
    pub(super) rows: Range<usize>,
    pub(super) to: &'p FarEnds,
    /// The rungs from the last sample of the tile above, and then from the last of this one.
    pub(super) above: &'p mut LastRow,
    /// The last rung of each row of the tile to the left, and then of this one.
    pub(super) before: &'p mut [LastRung; LANES],
    /// Where the rungs of a row and of the row above are kept, in turn.
    pub(super) turns: &'p mut [Row; 2],
    pub(super) block: &'p mut Block<'c>,
}

impl pulp::WithSimd for Pricing<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { terms, bound, rows, to, above: last_row, before, turns, block } = self;
        let (last, fold) = (terms.prices.len() - 1, terms.prices.options().fold);
        let mut gathered = Gathered::NOTHING;
        let mut strip = Strip::BLANK;
        turns[0].set_last(last_row, || terms.prices.offsets(rows.start - 1, to));
        let mut upper = 0;
        for i in rows.clone() {
            let run = block.runs.of(i);
            let [zeroth, first] = &mut *turns;
            let (above, own) = if upper == 0 { (zeroth, first) } else { (first, zeroth) };
            upper = 1 - upper;
            if i > rows.start {
                above.lower_on_column_edges(&mut gathered.on_column_edges, fold, [i - 1, last], to);
                if block.runs.of(i - 1) != run {
                    block.take(block.runs.of(i - 1), to, &gathered);
                    gathered = Gathered::NOTHING;
                }
            }
            own.any = price_up_to(terms, bound, i, to, &mut strip);
            let left = std::mem::replace(&mut before[i - rows.start], LastRung::NONE);
            if !own.any {
                continue;
            }
            if to.count == LANES {
                let mean = of_lane(&strip.means, LANES - 1);
                before[i - rows.start] = LastRung { price: strip.prices[LANES - 1], mean };
            }
            let to_first =
                if to.first > i { terms.prices.offset(i, to.first - 1) } else { [0.0; 3] };
            own.set(&left, to_first, &strip, &terms.prices.offsets(i, to));
            gathered.take_rungs(i, to.first, last, &strip);
            if !above.any {
                continue;
            }
            if block.runs.of(i - 1) == run {
                above.lower_on_row_edge(&mut gathered.on_row_edges, terms, i, to, &strip);
            } else {
                let mut least = [f64::INFINITY; LANES];
                above.lower_on_row_edge(&mut least, terms, i, to, &strip);
                block.take_link(i, to, &least);
            }
        }
        let (own, i) = (&turns[upper], rows.end - 1);
        own.lower_on_column_edges(&mut gathered.on_column_edges, fold, [i, last], to);
        block.take(block.runs.of(i), to, &gathered);
        *last_row = LastRow { strip, any: own.any };
    }
}

/// The triangles on the edge before sample i, the first that is not of a block, with the third
/// corner in the samples of a tile.
pub(super) struct Linking<'p, 'c> {
    pub(super) terms: &'p Terms<'p>,
    pub(super) bound: f64,
    pub(super) i: usize,
    pub(super) to: &'p FarEnds,
    /// The rungs from the sample before.
    pub(super) above: &'p LastRow,
    pub(super) block: &'p mut Block<'c>,
}

impl pulp::WithSimd for Linking<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { terms, bound, i, to, above, block } = self;
        let mut strip = Strip::BLANK;
        if above.any && price_up_to(terms, bound, i, to, &mut strip) {
            let mut last = Row::NONE;
            last.set_last(above, || terms.prices.offsets(i - 1, to));
            let mut least = [f64::INFINITY; LANES];
            last.lower_on_row_edge(&mut least, terms, i, to, &strip);
            block.take_link(i, to, &least);
        }
    }
}
