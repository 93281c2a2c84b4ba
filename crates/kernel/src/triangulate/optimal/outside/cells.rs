//! What is known of all rungs between two runs, and of the triangles on edges of the one whose third corner
//! lies in the other: priced once, sixteen at a time.

use super::runs::Runs;
use crate::cost::{Aligned, FarEnds, LANES, Lanes, OnEdges, Strip};
use crate::triangulate::TriangulateError;
use crate::triangulate::optimal::lanes::{lowest, of_lane};
use crate::triangulate::optimal::normals::NormalBox;
use crate::triangulate::optimal::open::Open;
use crate::triangulate::optimal::table::Table;
use crate::watch::Watch;

/// Numbers of the rungs from one sample to those of a tile, with that of the rung before them in front: on edges
/// before samples of the tile each rung meets the one before. To move them by one lane takes longer than to
/// read them at another place.
#[derive(Clone, Copy)]
struct Row(Aligned<[f64; 2 * LANES]>);

impl Row {
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
struct Rungs {
    /// Infinite where there is none up to the bound.
    prices: Row,
    /// Where any of them is finite.
    any: bool,
    means: [Row; 3],
    offsets: [Row; 3],
}

impl Rungs {
    /// If none is up to the bound.
    const NONE: Self = Self {
        prices: Row::all(f64::INFINITY),
        any: false,
        means: [Row::all(0.0); 3],
        offsets: [Row::all(0.0); 3],
    };

    #[inline(always)]
    fn set(&mut self, before: &LastRung, to_before: [f64; 3], strip: &Strip, offsets: &[Lanes; 3]) {
        self.prices.set(before.price, &strip.prices);
        for axis in 0..3 {
            self.means[axis].set(before.mean[axis], &strip.means[axis]);
            self.offsets[axis].set(to_before[axis], &offsets[axis]);
        }
    }

    /// The same as [`lower_on_edges`] for those before the samples of the tile: the triangles i, j − 1, j. The
    /// last sample of the loop comes after `i`.
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
                &self.offsets.each_ref().map(Row::before),
                &self.offsets.each_ref().map(Row::lanes),
            ],
            means: [
                &self.means.each_ref().map(Row::before),
                &self.means.each_ref().map(Row::lanes),
            ],
            rungs: rungs(to.first, [i + 2, if i == 0 { last } else { usize::MAX }]),
        };
        let prices = [&self.prices.before(), &beyond(i + 1, to, &self.prices.lanes())];
        lower_on_edges(least, fold, prices, &triangles);
    }
}

/// What is known of two runs, a and b, which may be one.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    /// No rung between them costs less; infinite if there is none up to the bound.
    pub(super) least: f64,
    /// Where N of the rungs up to the bound lies.
    pub(super) normals: NormalBox,
    /// No triangle on an edge between samples of a whose third corner is of b costs less, with half of the
    /// prices of its rungs, nor the other way round; hardly less than the least where folds are slight.
    pub(super) on_edges: [f64; 2],
    /// The same on the edge from a to the run after it, and on that from b to the run after it.
    pub(super) on_links: [f64; 2],
}

impl Cell {
    const UNKNOWN: Self = Self {
        least: f64::INFINITY,
        normals: NormalBox::NONE,
        on_edges: [f64::INFINITY; 2],
        on_links: [f64::INFINITY; 2],
    };
}

/// The cells of all pairs of runs, by the first.
pub(super) struct Cells {
    pub(super) runs: Runs,
    cells: Vec<Cell>,
}

impl Cells {
    /// What they take while they are priced, for so many runs of so many samples, bytes.
    pub(super) fn bytes(runs: usize, samples: usize) -> u64 {
        let of_tiles = size_of::<FarEnds>() + size_of::<Rungs>();
        let of_pairs = (runs as u64).pow(2) * size_of::<Cell>() as u64;
        of_pairs + (samples.div_ceil(LANES) * of_tiles) as u64
    }

    /// Prices all rungs that spans leave open.
    pub(super) fn new(
        table: &Table<'_>,
        open: &Open<'_>,
        runs: Runs,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let count = table.m.div_ceil(LANES);
        let ends: Vec<FarEnds> =
            (0..count).map(|at| table.terms.prices.far_ends(at * LANES)).collect();
        let mut cells = Self { cells: vec![Cell::UNKNOWN; runs.len() * runs.len()], runs };
        // The last row that was priced in each column of tiles.
        let mut above = vec![Rungs::NONE; count];
        for row in 0..count {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            // Rows have as many tiles as there are rows below.
            let below = (count - row) as f64 / count as f64;
            watch.progress(1.0 - below * below);
            let mut before = [LastRung::NONE; LANES];
            for column in row..count {
                if !open.is_open(row, column) {
                    above[column].any = false;
                    before = [LastRung::NONE; LANES];
                    continue;
                }
                let (to, cells) = (&ends[column], &mut cells);
                let (above, before) = (&mut above[column], &mut before);
                let bound = open.bound;
                let pricing = Pricing { table, bound, row, to, above, before, cells };
                table.registers.dispatch(pricing);
            }
        }
        // The edge from the last sample to the first is no rung, and costs nothing.
        let last = cells.runs.len() - 1;
        let root = cells.of_mut(0, last);
        (root.least, root.normals) = (0.0, NormalBox::ANY);
        Ok(cells)
    }

    #[inline(always)]
    pub(super) fn of(&self, a: usize, b: usize) -> &Cell {
        &self.cells[a * self.runs.len() + b]
    }

    #[inline(always)]
    fn of_mut(&mut self, a: usize, b: usize) -> &mut Cell {
        &mut self.cells[a * self.runs.len() + b]
    }

    /// Takes what was gathered of one run of rows and one column of tiles.
    fn take(&mut self, a: usize, to: &FarEnds, gathered: &Gathered) {
        let n = self.runs.len();
        for lane in 0..to.count {
            let j = to.first + lane;
            let b = self.runs.of(j);
            if b < a {
                continue;
            }
            let cell = &mut self.cells[a * n + b];
            cell.least = cell.least.min(gathered.prices[lane]);
            let at = |of: &[Lanes; 3]| [of[0][lane], of[1][lane], of[2][lane]];
            cell.normals.include(&NormalBox::between(at(&gathered.least), at(&gathered.greatest)));
            cell.on_edges[0] = cell.on_edges[0].min(gathered.on_row_edges[lane]);
            // That of a column is the edge before it.
            let before = if j == 0 { b } else { self.runs.of(j - 1) };
            let price = gathered.on_column_edges[lane];
            if before == b {
                cell.on_edges[1] = cell.on_edges[1].min(price);
            } else if before > a {
                let cell = self.of_mut(a, before);
                cell.on_links[1] = cell.on_links[1].min(price);
            }
        }
    }
}

/// The rung that leads to the last sample of a tile.
#[derive(Clone, Copy)]
struct LastRung {
    /// Infinite if there is none up to the bound.
    price: f64,
    mean: [f64; 3],
}

impl LastRung {
    const NONE: Self = Self { price: f64::INFINITY, mean: [0.0; 3] };
}

/// Takes the prices of triangles on edges of the boundary, with half of those of their rungs, `prices`, where
/// they are lower than the least so far.
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

/// How many of the sides to samples from `first` on are rungs, where those to `edges` are not.
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

/// What the rungs from some samples of one run to those of a tile have in common, for each of the latter.
struct Gathered {
    prices: Aligned<Lanes>,
    least: Aligned<[Lanes; 3]>,
    greatest: Aligned<[Lanes; 3]>,
    on_row_edges: Aligned<Lanes>,
    on_column_edges: Aligned<Lanes>,
}

impl Gathered {
    const NOTHING: Self = Self {
        prices: Aligned([f64::INFINITY; LANES]),
        least: Aligned([[f64::INFINITY; LANES]; 3]),
        greatest: Aligned([[f64::NEG_INFINITY; LANES]; 3]),
        on_row_edges: Aligned([f64::INFINITY; LANES]),
        on_column_edges: Aligned([f64::INFINITY; LANES]),
    };

    #[inline(always)]
    fn take_rungs(&mut self, i: usize, first: usize, last: usize, strip: &Strip) {
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

/// A tile to be priced. A type rather than a closure, as that of the table.
struct Pricing<'a> {
    table: &'a Table<'a>,
    bound: f64,
    row: usize,
    to: &'a FarEnds,
    /// The rungs from the last sample of the tile above, and then from the last of this one.
    above: &'a mut Rungs,
    /// The last rung of each row of the tile to the left, and then of this one.
    before: &'a mut [LastRung; LANES],
    cells: &'a mut Cells,
}

impl pulp::WithSimd for Pricing<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { table, bound, row, to, above: of_last, before, cells } = self;
        let (terms, last, fold) = (table.terms, table.m - 1, table.terms.prices.options().fold);
        let rows = row * LANES..table.m.min((row + 1) * LANES);
        let mut gathered = Gathered::NOTHING;
        let mut strip = Strip::BLANK;
        // The rungs of a row and of the row above, in turn.
        let mut turns = [*of_last, Rungs::NONE];
        let mut upper = 0;
        for i in rows.clone() {
            let run = cells.runs.of(i);
            let [zeroth, first] = &mut turns;
            let (above, own) = if upper == 0 { (zeroth, first) } else { (first, zeroth) };
            upper = 1 - upper;
            if i > rows.start {
                above.lower_on_column_edges(&mut gathered.on_column_edges, fold, [i - 1, last], to);
                if cells.runs.of(i - 1) != run {
                    cells.take(cells.runs.of(i - 1), to, &gathered);
                    gathered = Gathered::NOTHING;
                }
            }
            terms.strip::<true>(i, to, bound, &mut strip);
            for price in strip.prices.iter_mut() {
                *price = if *price <= bound { *price } else { f64::INFINITY };
            }
            let left = std::mem::replace(&mut before[i - rows.start], LastRung::NONE);
            own.any = lowest(&strip.prices) < f64::INFINITY;
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
            if i == 0 || !above.any {
                continue;
            }
            // On the edge before sample i: the triangles i − 1, i, j.
            let triangles = OnEdges {
                offsets: [
                    &terms.prices.offset(i - 1, i).map(|x| [x; LANES]),
                    &above.offsets.each_ref().map(Row::lanes),
                ],
                means: [&strip.means, &above.means.each_ref().map(Row::lanes)],
                rungs: rungs(to.first, [i + 1, if i == 1 { last } else { usize::MAX }]),
            };
            let prices = [&beyond(i, to, &strip.prices), &above.prices.lanes()];
            let before = cells.runs.of(i - 1);
            if before == run {
                lower_on_edges(&mut gathered.on_row_edges, fold, prices, &triangles);
                continue;
            }
            let mut least = [f64::INFINITY; LANES];
            lower_on_edges(&mut least, fold, prices, &triangles);
            for lane in 0..to.count {
                let b = cells.runs.of(to.first + lane);
                if b > run {
                    let link = &mut cells.of_mut(before, b).on_links[0];
                    *link = link.min(least[lane]);
                }
            }
        }
        let (own, i) = (&turns[upper], rows.end - 1);
        own.lower_on_column_edges(&mut gathered.on_column_edges, fold, [i, last], to);
        cells.take(cells.runs.of(i), to, &gathered);
        *of_last = *own;
    }
}
