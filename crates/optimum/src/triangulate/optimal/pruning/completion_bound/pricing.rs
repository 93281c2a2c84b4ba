//! How the rungs from the samples of a run to all later ones are priced, and the triangles on edges
//! of the boundary that they are sides of: sample by sample, and sixteen at a time.

use super::normals::NormalBox;
use super::on_edges::OnEdges;
use super::runs::Runs;
use crate::cost::{Aligned, FarEnds, LANES, Lanes, Strip};
use crate::triangulate::Terms;
use crate::triangulate::optimal::lanes::lowest;
use crate::triangulate::optimal::pruning::spans::Spans;

/// What is known of two runs, a and b, which may be one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// No rung between them costs less; infinite if there is none up to the bound.
    pub(super) least: f64,
    /// Where N of the rungs up to the bound lies.
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

/// The rungs from one sample to all of the loop.
struct Row {
    /// The sample; no sample at first.
    i: usize,
    /// The price of each, infinite where there is none up to the bound; N of each and the way from
    /// the sample, by axis. All begin with [`LANES`] numbers that mean nothing, so that there is
    /// one before that of sample 0.
    prices: Vec<f64>,
    means: [Vec<f64>; 3],
    ways: [Vec<f64>; 3],
    /// The columns of tiles with rungs up to the bound.
    columns: Vec<usize>,
}

/// Sixteen numbers of a list that begins with as many.
#[inline(always)]
fn lanes(list: &[f64], first: usize) -> Lanes {
    let mut lanes = [0.0; LANES];
    lanes.copy_from_slice(&list[first..][..LANES]);
    lanes
}

#[inline(always)]
fn lanes_of_each(lists: &[Vec<f64>; 3], first: usize) -> [Lanes; 3] {
    [lanes(&lists[0], first), lanes(&lists[1], first), lanes(&lists[2], first)]
}

impl Row {
    fn new(tiles: usize) -> Self {
        let list = |of: f64| vec![of; (tiles + 1) * LANES];
        let zeros = || [list(0.0), list(0.0), list(0.0)];
        let prices = list(f64::INFINITY);
        Self { i: usize::MAX, prices, means: zeros(), ways: zeros(), columns: vec![] }
    }
}

/// What the rungs from the samples of one run to those of a tile have in common, for each of the
/// latter.
#[derive(Clone, Copy)]
struct Gathered {
    prices: Aligned<Lanes>,
    least: Aligned<[Lanes; 3]>,
    greatest: Aligned<[Lanes; 3]>,
    /// Of triangles on edges within the run, on the edge before each sample of the tile, and on the
    /// edge from the run to the next one.
    on_own: Aligned<Lanes>,
    on_far: Aligned<Lanes>,
    on_link: Aligned<Lanes>,
}

impl Gathered {
    const NOTHING: Self = Self {
        prices: Aligned([f64::INFINITY; LANES]),
        least: Aligned([[f64::INFINITY; LANES]; 3]),
        greatest: Aligned([[f64::NEG_INFINITY; LANES]; 3]),
        on_own: Aligned([f64::INFINITY; LANES]),
        on_far: Aligned([f64::INFINITY; LANES]),
        on_link: Aligned([f64::INFINITY; LANES]),
    };

    #[inline(always)]
    fn take_rungs(&mut self, prices: &Lanes, means: &[Lanes; 3]) {
        for n in 0..LANES {
            self.prices[n] = if prices[n] < self.prices[n] { prices[n] } else { self.prices[n] };
        }
        for axis in 0..3 {
            let (least, greatest) = (&mut self.least[axis], &mut self.greatest[axis]);
            for n in 0..LANES {
                let (x, is_one) = (means[axis][n], prices[n] < f64::INFINITY);
                least[n] = if is_one & (x < least[n]) { x } else { least[n] };
                greatest[n] = if is_one & (x > greatest[n]) { x } else { greatest[n] };
            }
        }
    }

    /// Lowers what is known of a cell by that of one lane.
    fn lower(&self, n: usize, cell: &mut Cell) {
        let at = |of: &[Lanes; 3]| [of[0][n], of[1][n], of[2][n]];
        cell.least = cell.least.min(self.prices[n]);
        cell.normals.include(&NormalBox::between(at(&self.least), at(&self.greatest)));
        cell.on_edges[0] = cell.on_edges[0].min(self.on_own[n]);
    }
}

/// The rungs of one run after the other, on the way.
pub(super) struct Pricing<'s> {
    terms: &'s Terms<'s>,
    spans: &'s Spans,
    runs: &'s Runs,
    ends: &'s [FarEnds],
    /// The rungs from the sample that was priced last, and from the one before.
    own: Row,
    above: Row,
    /// A row of tiles, and the columns of those of it that spans leave open.
    open: (usize, Vec<usize>),
    /// By column of tiles.
    gathered: Vec<Gathered>,
}

impl<'s> Pricing<'s> {
    /// What it takes, bytes.
    pub(super) fn bytes(tiles: usize) -> usize {
        tiles * (size_of::<Gathered>() + 2 * 7 * size_of::<Lanes>())
    }

    pub(super) fn new(
        terms: &'s Terms<'s>,
        spans: &'s Spans,
        runs: &'s Runs,
        ends: &'s [FarEnds],
    ) -> Self {
        let (own, above) = (Row::new(ends.len()), Row::new(ends.len()));
        let (open, gathered) = ((usize::MAX, vec![]), vec![Gathered::NOTHING; ends.len()]);
        Self { terms, spans, runs, ends, own, above, open, gathered }
    }

    /// Prices the rungs from sample `i`, unless that was done last, and the triangles on edges
    /// within its run.
    pub(super) fn price(&mut self, registers: pulp::Arch, i: usize) {
        self.move_to(registers, i);
        registers.dispatch(Gathering { pricing: self, is_link: false });
    }

    /// Prices the triangles on the edge from a run to the next one, and writes all that was
    /// gathered of the run to its cells.
    pub(super) fn close(&mut self, registers: pulp::Arch, run: usize, cells: &mut [Cell]) {
        let end = self.runs.samples(run).end;
        if end < self.terms.prices.len() {
            self.move_to(registers, end);
            registers.dispatch(Gathering { pricing: self, is_link: true });
        }
        let first = self.runs.samples(run).start / LANES;
        for (gathered, to) in self.gathered[first..].iter_mut().zip(&self.ends[first..]) {
            for n in 0..to.count {
                let j = to.first + n;
                let b = self.runs.of(j);
                if b < run {
                    continue;
                }
                gathered.lower(n, &mut cells[b]);
                if b > run + 1 {
                    cells[b].on_links[0] = cells[b].on_links[0].min(gathered.on_link[n]);
                }
                // That of a column is the edge before it.
                let before = self.runs.of(j.max(1) - 1);
                if before == b {
                    cells[b].on_edges[1] = cells[b].on_edges[1].min(gathered.on_far[n]);
                } else if before > run {
                    let cell = &mut cells[before];
                    cell.on_links[1] = cell.on_links[1].min(gathered.on_far[n]);
                }
            }
            *gathered = Gathered::NOTHING;
        }
    }

    fn move_to(&mut self, registers: pulp::Arch, i: usize) {
        if self.own.i != i {
            std::mem::swap(&mut self.own, &mut self.above);
            self.own.i = i;
            let (row, count) = (i / LANES, self.ends.len());
            if self.open.0 != row {
                let open = (row..count).filter(|column| self.spans.is_open(row, *column));
                self.open = (row, open.collect());
            }
            registers.dispatch(Moving { pricing: self });
        }
    }
}

/// Prices the rungs of a row anew, for its sample. A type rather than a closure, as that of the
/// table.
struct Moving<'p, 's> {
    pricing: &'p mut Pricing<'s>,
}

impl pulp::WithSimd for Moving<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Pricing { terms, spans, ends, own, open, .. } = self.pricing;
        for column in own.columns.drain(..) {
            own.prices[(column + 1) * LANES..][..LANES].fill(f64::INFINITY);
        }
        let (i, mut strip) = (own.i, Strip::BLANK);
        for &column in &open.1 {
            terms.strip::<true>(i, &ends[column], &mut strip);
            for price in strip.prices.iter_mut() {
                *price = if *price <= spans.bound { *price } else { f64::INFINITY };
            }
            if lowest(&strip.prices) == f64::INFINITY {
                continue;
            }
            let (first, ways) = ((column + 1) * LANES, terms.prices.offsets(i, &ends[column]));
            own.prices[first..][..LANES].copy_from_slice(&*strip.prices);
            for axis in 0..3 {
                own.means[axis][first..][..LANES].copy_from_slice(&strip.means[axis]);
                own.ways[axis][first..][..LANES].copy_from_slice(&ways[axis]);
            }
            own.columns.push(column);
        }
    }
}

/// Gathers what the rungs of a row and the triangles on edges before its sample cost.
struct Gathering<'p, 's> {
    pricing: &'p mut Pricing<'s>,
    /// Whether the sample is the first after the run, so that only the triangles on the edge to it
    /// are looked at.
    is_link: bool,
}

impl pulp::WithSimd for Gathering<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Pricing { terms, runs, ends, own, above, gathered, .. } = self.pricing;
        let (i, last, fold) = (own.i, terms.prices.len() - 1, terms.prices.options().fold);
        let has_edge = i > 0 && above.i == i - 1 && (self.is_link || runs.of(i - 1) == runs.of(i));
        for &column in &own.columns {
            let (first, at) = (ends[column].first, (column + 1) * LANES);
            let gathered = &mut gathered[column];
            let (prices, means) = (lanes(&own.prices, at), lanes_of_each(&own.means, at));
            if !self.is_link {
                // Edges of the boundary are no rungs.
                let closing = if i == 0 { last } else { usize::MAX };
                let mut rungs = beyond(i + 1, first, &prices);
                if let Some(rung) = rungs.get_mut(closing.wrapping_sub(first)) {
                    *rung = f64::INFINITY;
                }
                gathered.take_rungs(&rungs, &means);
                // The triangles i, j − 1, j.
                let triangles = OnEdges {
                    offsets: [&lanes_of_each(&own.ways, at - 1), &lanes_of_each(&own.ways, at)],
                    means: [&lanes_of_each(&own.means, at - 1), &means],
                    rungs: count(first, [i + 2, closing]),
                };
                let of_rungs = [&lanes(&own.prices, at - 1), &beyond(i + 1, first, &prices)];
                lower_on_edges(&mut gathered.on_far, fold, of_rungs, &triangles);
            }
            if has_edge {
                // The triangles i − 1, i, j.
                let to_own = terms.prices.offset(i - 1, i).map(|x| [x; LANES]);
                let closing = if i == 1 { last } else { usize::MAX };
                let triangles = OnEdges {
                    offsets: [&to_own, &lanes_of_each(&above.ways, at)],
                    means: [&means, &lanes_of_each(&above.means, at)],
                    rungs: count(first, [i + 1, closing]),
                };
                let of_rungs = [&beyond(i, first, &prices), &lanes(&above.prices, at)];
                let is_link = self.is_link;
                let least = if is_link { &mut gathered.on_link } else { &mut gathered.on_own };
                lower_on_edges(least, fold, of_rungs, &triangles);
            }
        }
    }
}

/// Lowers the least prices to those of triangles on edges of the boundary, with half of the prices
/// of their rungs, `prices`, where these are lower.
#[inline(always)]
fn lower_on_edges(least: &mut Lanes, fold: f64, prices: [&Lanes; 2], triangles: &OnEdges<'_>) {
    let mut rungs = [0.0; LANES];
    let mut any = false;
    for n in 0..LANES {
        rungs[n] = 0.5 * (prices[0][n] + prices[1][n]);
        any |= rungs[n] < least[n];
    }
    if !any {
        return;
    }
    let folds = triangles.least_prices(fold);
    for n in 0..LANES {
        let price = rungs[n] + folds[n];
        least[n] = if price < least[n] { price } else { least[n] };
    }
}

/// The prices of the rungs to samples beyond i.
#[inline(always)]
fn beyond(i: usize, first: usize, prices: &Lanes) -> Lanes {
    let mut beyond = *prices;
    for n in 0..LANES {
        beyond[n] = if first + n > i { prices[n] } else { f64::INFINITY };
    }
    beyond
}

/// How many of two sides to samples from `first` on are rungs, where those to `edges` are not.
#[inline(always)]
fn count(first: usize, edges: [usize; 2]) -> Lanes {
    let mut rungs = [2.0; LANES];
    for edge in edges {
        if let Some(rungs) = rungs.get_mut(edge.wrapping_sub(first)) {
            *rungs -= 1.0;
        }
    }
    rungs
}
