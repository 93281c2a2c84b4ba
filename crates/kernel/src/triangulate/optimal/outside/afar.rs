//! The loop as it is seen from afar: equation (5) for runs, from short bundles to long ones, and what that
//! leaves for the rest of the loop, from long ones to short ones.
//!
//! Both go through all triples of runs A < K < B for one A and K after the other, with sixteen B side by
//! side, as the table does. What wide triangles pay at the least is worked out once, in between.

use super::cells::Cells;
use super::runs::{Direction, directions};
use crate::cost::{LANES, Lanes};
use crate::triangulate::TriangulateError;
use crate::triangulate::optimal::lanes::lowest;
use crate::triangulate::optimal::normals::{NormalBox, least_fold, least_fold_about};
use crate::triangulate::optimal::table::Table;
use crate::watch::Watch;

/// What sums of prices over all runs may gain by rounding, far more than they do.
const SLACK: f64 = 1e-10;
/// The share that is taken off a price before it is rounded to single precision, which may add 2⁻²⁴.
const ROUNDED: f64 = 1e-6;

/// Prices of a bundle with neither of its runs charged, the first, the second, and both: bit 0 says whether
/// the first is, bit 1 whether the second is.
type Charged = [f64; 4];
const NONE: usize = 0;
const FIRST: usize = 1;
const SECOND: usize = 2;
const BOTH: usize = 3;

/// The same of bundles that begin at one run and end at [`LANES`] runs in a row.
type Bundles = [Lanes; 4];
const NEVER: Bundles = [[f64::INFINITY; LANES]; 4];

#[inline(always)]
fn of_lane(bundles: &Bundles, lane: usize) -> Charged {
    [bundles[NONE][lane], bundles[FIRST][lane], bundles[SECOND][lane], bundles[BOTH][lane]]
}

#[inline(always)]
fn set_lane(bundles: &mut Bundles, lane: usize, charged: Charged) {
    for (bundle, price) in bundles.iter_mut().zip(charged) {
        bundle[lane] = price;
    }
}

/// The rungs of bundles that begin at one run and end at [`LANES`] runs in a row.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Rungs {
    /// None costs less.
    least: Lanes,
    /// Where their N lie, by axis.
    lower: [Lanes; 3],
    upper: [Lanes; 3],
    /// Their directions, by axis, and how far off these may be.
    along: [Lanes; 3],
    off: Lanes,
}

impl Rungs {
    const NONE: Self = Self {
        least: [f64::INFINITY; LANES],
        lower: [[f64::INFINITY; LANES]; 3],
        upper: [[f64::NEG_INFINITY; LANES]; 3],
        along: [[0.0; LANES]; 3],
        off: [f64::INFINITY; LANES],
    };

    /// Those of one bundle, so many times.
    #[inline(always)]
    fn all_like(&self, lane: usize) -> Self {
        let all = |of: &Lanes| [of[lane]; LANES];
        let by_axis = |of: &[Lanes; 3]| [all(&of[0]), all(&of[1]), all(&of[2])];
        Self {
            least: all(&self.least),
            lower: by_axis(&self.lower),
            upper: by_axis(&self.upper),
            along: by_axis(&self.along),
            off: all(&self.off),
        }
    }
}

/// What is known of a loop of runs.
pub(super) struct Afar<'a> {
    /// ν.
    fold: f64,
    bound: f64,
    registers: pulp::Arch,
    cells: &'a Cells,
    directions: Vec<Direction>,
    /// How many groups of [`LANES`] runs there are.
    width: usize,
    /// By first run, and the groups of the second.
    rungs: Vec<Rungs>,
    /// What the edges within a run are charged with third corners in another, by the first.
    charges: Vec<f64>,
}

impl<'a> Afar<'a> {
    /// What it takes for so many runs, bytes.
    pub(super) fn bytes(runs: usize) -> u64 {
        let width = runs.div_ceil(LANES);
        let of_triples = Wide::starts(runs)[runs] * size_of::<f32>();
        let of_pairs = size_of::<Direction>() + 2 * size_of::<f64>();
        let of_groups = size_of::<Rungs>() + 2 * size_of::<Bundles>();
        (of_triples + runs * runs * of_pairs + runs * width * of_groups) as u64
    }

    pub(super) fn new(table: &Table<'_>, bound: f64, cells: &'a Cells) -> Self {
        let n = cells.runs.len();
        let width = n.div_ceil(LANES);
        let mut afar = Self {
            fold: table.terms.prices.options().fold,
            bound,
            registers: table.registers,
            cells,
            directions: directions(table.terms, &cells.runs),
            width,
            rungs: vec![Rungs::NONE; n * width],
            charges: vec![f64::INFINITY; n * n],
        };
        for a in 0..n {
            for b in a + 1..n {
                let (group, lane) = (&mut afar.rungs[a * width + b / LANES], b % LANES);
                let (cell, direction) = (cells.of(a, b), &afar.directions[a * n + b]);
                let (lower, upper) = cell.normals.extremes();
                let along = direction.middle.to_array();
                (group.least[lane], group.off[lane]) = (cell.least, direction.off);
                for axis in 0..3 {
                    group.lower[axis][lane] = lower[axis];
                    group.upper[axis][lane] = upper[axis];
                    group.along[axis][lane] = along[axis];
                }
                if cell.least <= bound {
                    afar.charges[a * n + b] = afar.charge(a, b);
                    afar.charges[b * n + a] = afar.charge(b, a);
                }
            }
        }
        afar
    }

    /// What is outside of all bundles with both runs charged inside, by first run, and of rungs within a run;
    /// infinite where none is part of the answer.
    pub(super) fn rests(&self, watch: &mut dyn Watch) -> Result<Vec<f64>, TriangulateError> {
        let n = self.cells.runs.len();
        let mut wide = Wide::new(n);
        let mut inside = vec![NEVER; n * self.width];
        for a in (0..n).rev() {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let (wide, inside) = (&mut wide, &mut inside);
            self.registers.dispatch(Outwards { afar: self, a, wide, inside });
        }
        let mut outside = vec![NEVER; n * self.width];
        // Nothing is outside of the edge from the last sample to the first.
        set_lane(&mut outside[(n - 1) / LANES], (n - 1) % LANES, [0.0; 4]);
        for a in 0..n {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let (wide, inside, outside) = (&wide, &inside, &mut outside);
            self.registers.dispatch(Inwards { afar: self, a, wide, inside, outside });
        }
        let mut rests = vec![f64::INFINITY; n * n];
        for a in 0..n {
            for b in a + 1..n {
                let at = a * self.width + b / LANES;
                let within = of_lane(&inside[at], b % LANES);
                let beyond = of_lane(&outside[at], b % LANES);
                let both = (0..4).map(|at| within[at] + beyond[at]).fold(f64::INFINITY, f64::min);
                if both <= self.bound + SLACK {
                    rests[a * n + b] = beyond[BOTH] - SLACK;
                }
            }
            rests[a * n + a] = self.beyond_nibbles(a, &inside, &outside);
        }
        Ok(rests)
    }

    /// What the edges within run a are charged with third corners in run x.
    fn charge(&self, a: usize, x: usize) -> f64 {
        let edges = self.cells.runs.inner_edges(a);
        if edges == 0 {
            return 0.0;
        }
        let at = usize::from(a > x);
        let of_edges = edges as f64 * self.cells.of(a.min(x), a.max(x)).on_edges[at];
        if edges == 1 { of_edges } else { of_edges.min(self.nibble(a, x)) }
    }

    /// No triangle pays less whose corners are two samples of run a, which are no neighbours, and one of x.
    fn nibble(&self, a: usize, x: usize) -> f64 {
        let of_rungs = self.nibble_of_rungs(a, x);
        // One of its sides may be the edge to the next run.
        if a.abs_diff(x) == 1 { of_rungs.min(self.nibble_of_edge(a, x)) } else { of_rungs }
    }

    /// The same if all of its sides are rungs.
    fn nibble_of_rungs(&self, a: usize, x: usize) -> f64 {
        let n = self.cells.runs.len();
        let (from, to) = (a.min(x), a.max(x));
        let (own, across) = (self.cells.of(a, a), self.cells.of(from, to));
        let sides = [&own.normals, &across.normals, &across.normals];
        let [own_way, way] = [(a, a), (from, to)].map(|(i, j)| &self.directions[i * n + j]);
        let [first, second] = if a < x { [own_way, way] } else { [way, own_way] };
        let normal = Direction::across(first, second);
        let mut fold = least_fold(self.fold, sides);
        if normal.off < f64::INFINITY {
            let about = (normal.middle.to_array(), normal.off);
            fold = fold.max(least_fold_about(self.fold, about, sides));
        }
        0.5 * own.least + across.least + fold
    }

    /// The same if one of them is the edge between the runs.
    fn nibble_of_edge(&self, a: usize, x: usize) -> f64 {
        let (own, across) = (self.cells.of(a, a), self.cells.of(a.min(x), a.max(x)));
        let fold = least_fold(self.fold, [&own.normals, &across.normals, &NormalBox::ANY]);
        0.5 * (own.least + across.least) + fold
    }

    /// What is outside of a rung between two samples of one run: the triangle beyond it, what lies below the
    /// other side of that, and what is outside of its bundle.
    fn beyond_nibbles(&self, a: usize, inside: &[Bundles], outside: &[Bundles]) -> f64 {
        let n = self.cells.runs.len();
        let mut least = f64::INFINITY;
        for x in (0..n).filter(|&x| x != a && self.cells.of(a, a).least <= self.bound) {
            let (from, to) = (a.min(x), a.max(x));
            let at = from * self.width + to / LANES;
            let beyond = outside[at][BOTH][to % LANES];
            if beyond > self.bound {
                continue;
            }
            let below = inside[at][NONE][to % LANES];
            least = least.min(beyond + below + self.nibble_of_rungs(a, x));
            if to - from == 1 {
                least = least.min(beyond + self.nibble_of_edge(a, x));
            }
        }
        if least <= self.bound + SLACK { least - SLACK } else { f64::INFINITY }
    }

    /// What is inside of the edge between two runs: nothing is charged there, but that runs without inner
    /// edges are at no cost.
    #[inline(always)]
    fn edge(&self, a: usize, b: usize) -> Charged {
        let is_free = |run: usize| self.cells.runs.inner_edges(run) == 0;
        let charged = |run: usize| if is_free(run) { 0.0 } else { f64::INFINITY };
        let (a, b) = (charged(a), charged(b));
        [0.0, a, b, a + b]
    }

    /// What the first and the second of two runs are charged in their bundle.
    #[inline(always)]
    fn charged(&self, a: usize, b: usize) -> [f64; 2] {
        let n = self.cells.runs.len();
        [self.charges[a * n + b], self.charges[b * n + a]]
    }
}

/// What wide triangles pay at the least, rounded down: for each first run and each second one, side by side,
/// as many groups of third ones as from that of the first on.
struct Wide {
    prices: Vec<f32>,
    /// Where those of each first run begin, and how many there are.
    starts: Vec<usize>,
}

impl Wide {
    fn starts(n: usize) -> Vec<usize> {
        let width = n.div_ceil(LANES);
        let mut starts = vec![0];
        for a in 0..n {
            starts.push(starts[a] + (n - a - 1) * (width - a / LANES) * LANES);
        }
        starts
    }

    fn new(n: usize) -> Self {
        let starts = Self::starts(n);
        Self { prices: vec![f32::INFINITY; starts[n]], starts }
    }

    /// Where the group of the third run stands.
    #[inline(always)]
    fn place(&self, a: usize, k: usize, group: usize) -> usize {
        let width = (self.starts.len() - 1).div_ceil(LANES);
        let groups = (k - a - 1) * (width - a / LANES) + group - a / LANES;
        self.starts[a] + groups * LANES
    }

    #[inline(always)]
    fn of(&self, place: usize) -> Lanes {
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            prices[n] = f64::from(self.prices[place + n]);
        }
        prices
    }
}

/// What wide triangles pay at the least for ν = `fold`, of which these are the sides, `across` the one that
/// spans the others: for their folds what the N of their sides leave, taken two at a time, as in
/// [`least_fold`], or what their normals do, as in [`least_fold_about`], from the two sides that tell these
/// best.
#[inline(always)]
fn wide(fold: f64, first: &Rungs, second: &Rungs, across: &Rungs) -> Lanes {
    let mut apart = [0.0; LANES];
    for (one, other) in [(first, second), (first, across), (second, across)] {
        for axis in 0..3 {
            for n in 0..LANES {
                let above = one.lower[axis][n] - other.upper[axis][n];
                let below = other.lower[axis][n] - one.upper[axis][n];
                let gap = if above > below { above } else { below };
                let gap = if gap > 0.0 { gap } else { 0.0 };
                apart[n] += gap * gap;
            }
        }
    }
    // The square of how far off it may be, as a share of its length.
    let (mut normal, mut share) = ([[0.0; LANES]; 3], [f64::INFINITY; LANES]);
    for (one, other) in [(first, across), (first, second), (across, second)] {
        let (mut middle, mut shares) = ([[0.0; LANES]; 3], [0.0; LANES]);
        for n in 0..LANES {
            let (u, v) = (&one.along, &other.along);
            let x = u[1][n] * v[2][n] - u[2][n] * v[1][n];
            let y = u[2][n] * v[0][n] - u[0][n] * v[2][n];
            let z = u[0][n] * v[1][n] - u[1][n] * v[0][n];
            (middle[0][n], middle[1][n], middle[2][n]) = (x, y, z);
            let off = one.off[n] + other.off[n] + one.off[n] * other.off[n];
            shares[n] = off * off / (x * x + y * y + z * z);
        }
        for n in 0..LANES {
            let is_closer = shares[n] < share[n];
            share[n] = if is_closer { shares[n] } else { share[n] };
            for axis in 0..3 {
                normal[axis][n] = if is_closer { middle[axis][n] } else { normal[axis][n] };
            }
        }
    }
    let mut off = [0.0; LANES];
    for n in 0..LANES {
        let [x, y, z] = [normal[0][n], normal[1][n], normal[2][n]];
        let scale = 1.0 / (x * x + y * y + z * z).sqrt();
        (normal[0][n], normal[1][n], normal[2][n]) = (x * scale, y * scale, z * scale);
        off[n] = Direction::OFF_OF_SHARE * share[n].sqrt() + Direction::LEAST_OFF;
    }
    let mut about = [0.0; LANES];
    for side in [first, second, across] {
        let mut squares = [0.0; LANES];
        for axis in 0..3 {
            for n in 0..LANES {
                let above = normal[axis][n] - side.upper[axis][n];
                let below = side.lower[axis][n] - normal[axis][n];
                let gap = if above > below { above } else { below };
                let gap = if gap > 0.0 { gap } else { 0.0 };
                squares[n] += gap * gap;
            }
        }
        for n in 0..LANES {
            let apart = squares[n].sqrt() - off[n];
            let apart = if apart > 0.0 { apart } else { 0.0 };
            about[n] += apart * apart;
        }
    }
    let mut prices = [0.0; LANES];
    for n in 0..LANES {
        let is_known = share[n] <= Direction::FARTHEST * Direction::FARTHEST;
        let about = if is_known { 0.5 * about[n] } else { 0.0 };
        let apart = apart[n] / 6.0;
        let folds = if about > apart { about } else { apart };
        prices[n] = 0.5 * (first.least[n] + second.least[n] + across.least[n]) + fold * folds;
    }
    prices
}

#[inline(always)]
fn lower_of(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// What is inside of a bundle, from what is inside of the two other sides of a triangle: their common run
/// is charged in one of them.
#[inline(always)]
fn joined(first: &Charged, second: &Charged, at: usize) -> f64 {
    let (of_first, of_second) = (at & FIRST, at & SECOND);
    lower_of(
        first[of_first | SECOND] + second[of_second],
        first[of_first] + second[of_second | FIRST],
    )
}

/// What is outside of the first side of a triangle, from what is inside of the second and outside of
/// the one that spans both: the common run of the sides is charged in one of them, the far end of the second
/// in that or farther out.
#[inline(always)]
fn beside_first(second: &Charged, across: &Charged, at: usize) -> f64 {
    let of_first = at & FIRST;
    let of_middle = if at & SECOND == 0 { FIRST } else { NONE };
    lower_of(
        second[of_middle] + across[of_first],
        second[of_middle | SECOND] + across[of_first | SECOND],
    )
}

/// The same of the second side.
#[inline(always)]
fn beside_second(first: &Charged, across: &Charged, at: usize) -> f64 {
    let of_middle = if at & FIRST == 0 { SECOND } else { NONE };
    let of_second = at & SECOND;
    lower_of(
        first[of_middle] + across[of_second],
        first[of_middle | FIRST] + across[of_second | FIRST],
    )
}

/// Works out Q of all bundles that begin at run a, when that of later ones is known. A type rather than a
/// closure, as that of the table.
struct Outwards<'o, 'a> {
    afar: &'o Afar<'a>,
    a: usize,
    wide: &'o mut Wide,
    inside: &'o mut [Bundles],
}

impl pulp::WithSimd for Outwards<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { afar, a, wide: prices, inside } = self;
        let (n, width) = (afar.cells.runs.len(), afar.width);
        for k in a + 1..n {
            let (at, lane) = (a * width + k / LANES, k % LANES);
            // All is known that is inside of the bundle to k, but for what is charged in it.
            let mut first = if k == a + 1 { afar.edge(a, k) } else { of_lane(&inside[at], lane) };
            let [of_a, of_k] = afar.charged(a, k);
            if afar.cells.of(a, k).least > afar.bound {
                first = [f64::INFINITY; 4];
            }
            first[FIRST] = first[FIRST].min(first[NONE] + of_a);
            first[BOTH] = first[BOTH].min(first[SECOND] + of_a);
            first[SECOND] = first[SECOND].min(first[NONE] + of_k);
            first[BOTH] = first[BOTH].min(first[FIRST] + of_k);
            set_lane(&mut inside[at], lane, first);
            // Triangles on the edge from a to k, with the third corner in later runs.
            if k == a + 1 {
                let edge = afar.edge(a, k);
                for b in k + 1..n {
                    let second = of_lane(&inside[k * width + b / LANES], b % LANES);
                    let price = afar.cells.of(a, b).on_links[0];
                    let sums = &mut inside[a * width + b / LANES];
                    for at in 0..4 {
                        let sum = price + joined(&edge, &second, at);
                        sums[at][b % LANES] = lower_of(sums[at][b % LANES], sum);
                    }
                }
            }
            // Those on the edge from k to the run after it, with the third corner in a. Two edges of the
            // boundary may meet in the one sample of k.
            if k + 1 < n {
                let (b, edge) = (k + 1, afar.edge(k, k + 1));
                let is_between = k == a + 1 && afar.cells.runs.inner_edges(k) == 0;
                let before = if is_between { afar.edge(a, k) } else { [f64::INFINITY; 4] };
                let price = afar.cells.of(a, k).on_links[1];
                let sums = &mut inside[a * width + b / LANES];
                for at in 0..4 {
                    let sum = price + joined(&first, &edge, at).min(joined(&before, &edge, at));
                    sums[at][b % LANES] = lower_of(sums[at][b % LANES], sum);
                }
            }
            if first[NONE] > afar.bound {
                continue;
            }
            let own = afar.rungs[at].all_like(lane);
            for group in (k + 1) / LANES..width {
                let second = &afar.rungs[k * width + group];
                let across = &afar.rungs[a * width + group];
                let below = inside[k * width + group];
                let mut any = false;
                for n in 0..LANES {
                    let rungs = 0.5 * (own.least[n] + second.least[n] + across.least[n]);
                    any |= first[NONE] + below[NONE][n] + rungs <= afar.bound;
                }
                if !any {
                    continue;
                }
                let place = prices.place(a, k, group);
                let found = wide(afar.fold, &own, second, across);
                for n in 0..LANES {
                    let is_third = group * LANES + n > k;
                    let price = if is_third { found[n] } else { f64::INFINITY };
                    prices.prices[place + n] = (price * (1.0 - ROUNDED)) as f32;
                }
                let found = prices.of(place);
                let sums = &mut inside[a * width + group];
                for n in 0..LANES {
                    let below = of_lane(&below, n);
                    for at in 0..4 {
                        let sum = found[n] + joined(&first, &below, at);
                        sums[at][n] = lower_of(sums[at][n], sum);
                    }
                }
            }
        }
    }
}

/// Works out R of all bundles that begin at run a, when that of earlier ones is known, and what these say
/// of later ones.
struct Inwards<'i, 'a> {
    afar: &'i Afar<'a>,
    a: usize,
    wide: &'i Wide,
    inside: &'i [Bundles],
    outside: &'i mut [Bundles],
}

impl pulp::WithSimd for Inwards<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { afar, a, wide, inside, outside } = self;
        let (n, width) = (afar.cells.runs.len(), afar.width);
        // R of the bundles, with what is charged in them; and the least of each group.
        let (mut through, mut least) = (vec![NEVER; width], vec![f64::INFINITY; width]);
        for k in (a + 1..n).rev() {
            let (at, lane) = (a * width + k / LANES, k % LANES);
            let first = of_lane(&inside[at], lane);
            let mut beyond = of_lane(&outside[at], lane);
            for group in (k + 1) / LANES..width {
                if first[NONE] + least[group] > afar.bound {
                    continue;
                }
                let price = wide.of(wide.place(a, k, group));
                let (below, parents) = (&inside[k * width + group], &through[group]);
                let mut any = false;
                for n in 0..LANES {
                    let sum = first[NONE] + below[NONE][n] + parents[BOTH][n] + price[n];
                    any |= sum <= afar.bound + SLACK;
                }
                if !any {
                    continue;
                }
                let sums = &mut outside[k * width + group];
                let mut of_first = NEVER;
                for n in 0..LANES {
                    let (below, parent) = (of_lane(below, n), of_lane(parents, n));
                    for at in 0..4 {
                        of_first[at][n] = price[n] + beside_first(&below, &parent, at);
                        let sum = price[n] + beside_second(&first, &parent, at);
                        sums[at][n] = lower_of(sums[at][n], sum);
                    }
                }
                for at in 0..4 {
                    beyond[at] = beyond[at].min(lowest(&of_first[at]));
                }
            }
            // Triangles on the edge from a to k.
            if k == a + 1 {
                let edge = afar.edge(a, k);
                for b in k + 1..n {
                    let parent = of_lane(&through[b / LANES], b % LANES);
                    let price = afar.cells.of(a, b).on_links[0];
                    let sums = &mut outside[k * width + b / LANES];
                    for at in 0..4 {
                        let sum = price + beside_second(&edge, &parent, at);
                        sums[at][b % LANES] = lower_of(sums[at][b % LANES], sum);
                    }
                }
            }
            // Those on the edge from k to the run after it.
            if k + 1 < n {
                let (b, edge) = (k + 1, afar.edge(k, k + 1));
                let parent = of_lane(&through[b / LANES], b % LANES);
                let price = afar.cells.of(a, k).on_links[1];
                for at in 0..4 {
                    beyond[at] = beyond[at].min(price + beside_first(&edge, &parent, at));
                }
            }
            set_lane(&mut outside[at], lane, beyond);
            let [of_a, of_k] = afar.charged(a, k);
            let mut own = beyond;
            own[FIRST] = own[FIRST].min(own[BOTH] + of_k);
            own[SECOND] = own[SECOND].min(own[BOTH] + of_a);
            own[NONE] = own[NONE].min(own[FIRST] + of_a).min(own[SECOND] + of_k);
            set_lane(&mut through[k / LANES], lane, own);
            least[k / LANES] = least[k / LANES].min(own[BOTH]);
        }
    }
}
