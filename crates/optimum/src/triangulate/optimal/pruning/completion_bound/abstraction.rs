//! The abstracted loop: equation (5) for runs, from short bundles to long ones, and the bounds on
//! the rest of the loop, from long bundles to short ones.
//!
//! Both go through all triples of runs A < K < B for one A and K after the other, with sixteen B
//! side by side, as the table does.

use super::cells::Cells;
use super::normals::{NormalBox, least_fold};
use super::three_run_bound::{Rungs, least_wide};
use crate::cost::{LANES, Lanes};
use crate::triangulate::optimal::lanes::lowest;
use crate::triangulate::{Terms, TriangulateError};
use sheetwright_geometry::watch::Watch;

/// By how much sums over all runs may exceed the prices of triangulations: by rounding, and by half
/// a quantum for each triangle whose folds are rounded down; 4e-11 for 1,500 runs.
const SLACK: f64 = 1e-10;

/// Prices of a bundle with neither of its runs charged, the first, the second, and both: bit 0 says
/// whether the first is, bit 1 whether the second is.
type Charged = [f64; 4];
const NEITHER: usize = 0;
const FIRST: usize = 1;
const SECOND: usize = 2;
const BOTH: usize = 3;

/// Prices of the bundles that begin at one run and end at [`LANES`] runs in a row, as [`Charged`]
/// has them of one.
type Bundles = [Lanes; 4];
const NEVER: Bundles = [[f64::INFINITY; LANES]; 4];

#[inline(always)]
fn of_lane(bundles: &Bundles, lane: usize) -> Charged {
    [bundles[NEITHER][lane], bundles[FIRST][lane], bundles[SECOND][lane], bundles[BOTH][lane]]
}

#[inline(always)]
fn set_lane(bundles: &mut Bundles, lane: usize, charged: Charged) {
    for (bundle, price) in bundles.iter_mut().zip(charged) {
        bundle[lane] = price;
    }
}

/// Lowers the prices of a lane to these, where they are lower.
#[inline(always)]
fn lower_lane(bundles: &mut Bundles, lane: usize, price: impl Fn(usize) -> f64) {
    for at in 0..4 {
        bundles[at][lane] = lower_of(bundles[at][lane], price(at));
    }
}

/// A loop of runs with its bounds.
pub(super) struct Abstraction<'a> {
    /// ν.
    fold: f64,
    /// With [`SLACK`].
    bound: f64,
    registers: pulp::Arch,
    cells: &'a Cells,
    /// How many groups of [`LANES`] runs there are.
    width: usize,
    /// By first run, and the groups of the second.
    rungs: Vec<Rungs>,
    /// The charges of the edges within a run with third corners in another, by the first.
    charges: Vec<f64>,
}

impl<'a> Abstraction<'a> {
    /// Memory for so many runs, bytes.
    pub(super) fn bytes(runs: usize) -> u64 {
        let width = runs.div_ceil(LANES);
        let of_pair = 2 * size_of::<f64>();
        let of_group = size_of::<Rungs>() + 2 * size_of::<Bundles>();
        (runs * (runs * of_pair + width * of_group)) as u64
    }

    pub(super) fn new(
        terms: &Terms<'_>,
        registers: pulp::Arch,
        bound: f64,
        cells: &'a Cells,
    ) -> Self {
        let n = cells.runs.len();
        let width = n.div_ceil(LANES);
        let mut afar = Self {
            fold: terms.prices.options().fold,
            bound: bound + SLACK,
            registers,
            cells,
            width,
            rungs: vec![Rungs::NONE; n * width],
            charges: vec![f64::INFINITY; n * n],
        };
        for a in 0..n {
            for b in a + 1..n {
                let (group, lane) = (&mut afar.rungs[a * width + b / LANES], b % LANES);
                let cell = cells.of(a, b);
                let (lower, upper) = cell.normals.extremes();
                group.least[lane] = cell.least;
                for axis in 0..3 {
                    group.lower[axis][lane] = lower[axis];
                    group.upper[axis][lane] = upper[axis];
                }
                if cell.least <= afar.bound {
                    afar.charges[a * n + b] = afar.charge(a, b);
                    afar.charges[b * n + a] = afar.charge(b, a);
                }
            }
        }
        afar
    }

    /// R of all bundles with both runs charged inside, by first run, and of rungs within a run;
    /// infinite where no rung is part of the optimum.
    pub(super) fn rests(&self, watch: &mut dyn Watch) -> Result<Vec<f64>, TriangulateError> {
        let n = self.cells.runs.len();
        let mut inside = vec![NEVER; n * self.width];
        for a in (0..n).rev() {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            self.registers.dispatch(Outwards { afar: self, a, inside: &mut inside });
        }
        let mut outside = vec![NEVER; n * self.width];
        // Nothing is outside of the edge from the last sample to the first.
        set_lane(&mut outside[(n - 1) / LANES], (n - 1) % LANES, [0.0; 4]);
        for a in 0..n {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let (inside, outside) = (&inside, &mut outside);
            self.registers.dispatch(Inwards { afar: self, a, inside, outside });
        }
        let mut rests = vec![f64::INFINITY; n * n];
        for a in 0..n {
            for b in a + 1..n {
                let at = a * self.width + b / LANES;
                let within = of_lane(&inside[at], b % LANES);
                let beyond = of_lane(&outside[at], b % LANES);
                let both = (0..4).map(|at| within[at] + beyond[at]).fold(f64::INFINITY, f64::min);
                if both <= self.bound {
                    rests[a * n + b] = beyond[BOTH] - SLACK;
                }
            }
            rests[a * n + a] = self.beyond_nibbles(a, &inside, &outside);
        }
        Ok(rests)
    }

    /// The charge of the edges within run a with third corners in run x.
    fn charge(&self, a: usize, x: usize) -> f64 {
        let edges = self.cells.runs.inner_edges(a);
        if edges == 0 {
            return 0.0;
        }
        let at = usize::from(a > x);
        let of_edges = edges as f64 * self.cells.of(a.min(x), a.max(x)).on_edges[at];
        if edges == 1 { of_edges } else { of_edges.min(self.nibble(a, x)) }
    }

    /// Lower bound on what a triangle pays beyond a nibble: its corners are two samples of run a,
    /// which are no neighbours, and one of x. One of its sides may be the edge between the runs.
    fn nibble(&self, a: usize, x: usize) -> f64 {
        let (own, across) = (self.cells.of(a, a), self.cells.of(a.min(x), a.max(x)));
        let fold = least_fold(self.fold, [&own.normals, &across.normals, &NormalBox::ANY]);
        0.5 * (own.least + across.least) + fold
    }

    /// Lower bound on the price outside of a rung between two samples of one run: the triangle
    /// beyond it, the part below the other side of that triangle, and R of its bundle.
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
            // Below the edge between two runs there is nothing.
            let below = if to - from == 1 { 0.0 } else { inside[at][NEITHER][to % LANES] };
            least = least.min(beyond + below + self.nibble(a, x));
        }
        if least <= self.bound { least - SLACK } else { f64::INFINITY }
    }

    /// Q of the edge between two runs: nothing is charged there, except runs without inner edges,
    /// at no cost.
    #[inline(always)]
    fn edge(&self, a: usize, b: usize) -> Charged {
        let is_free = |run: usize| self.cells.runs.inner_edges(run) == 0;
        let charged = |run: usize| if is_free(run) { 0.0 } else { f64::INFINITY };
        let (a, b) = (charged(a), charged(b));
        [0.0, a, b, a + b]
    }

    /// What wide triangles between runs a, k and those of a group pay at the least; infinite for
    /// third runs that do not come after k. `first` are the rungs between a and k.
    #[inline(always)]
    fn wide(&self, first: &Rungs, [a, k]: [usize; 2], group: usize) -> Lanes {
        let [second, across] = [k, a].map(|run| &self.rungs[run * self.width + group]);
        let mut prices = least_wide(self.fold, [first, second, across]);
        for lane in 0..LANES {
            let is_third = group * LANES + lane > k;
            prices[lane] = if is_third { prices[lane] } else { f64::INFINITY };
        }
        prices
    }

    /// What the first and the second of two runs are charged in their bundle.
    #[inline(always)]
    fn charged(&self, a: usize, b: usize) -> [f64; 2] {
        let n = self.cells.runs.len();
        [self.charges[a * n + b], self.charges[b * n + a]]
    }
}

#[inline(always)]
fn lower_of(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// Q of a bundle, from the Q of the two other sides of a triangle: their common run is charged in
/// one of them.
#[inline(always)]
fn joined(first: &Charged, second: &Charged, at: usize) -> f64 {
    let (of_first, of_second) = (at & FIRST, at & SECOND);
    lower_of(
        first[of_first | SECOND] + second[of_second],
        first[of_first] + second[of_second | FIRST],
    )
}

/// R of the first side of a triangle, from Q of the second and R of the side that spans both: the
/// common run of the sides is charged in one of them, the far end of the second in that or farther
/// out.
#[inline(always)]
fn beside_first(second: &Charged, across: &Charged, at: usize) -> f64 {
    let of_first = at & FIRST;
    let of_middle = if at & SECOND == 0 { FIRST } else { NEITHER };
    lower_of(
        second[of_middle] + across[of_first],
        second[of_middle | SECOND] + across[of_first | SECOND],
    )
}

/// R of the second side of a triangle, from Q of the first and R of the side that spans both: the
/// common run of the sides is charged in one of them, the far end of the first in that or farther
/// out.
#[inline(always)]
fn beside_second(first: &Charged, across: &Charged, at: usize) -> f64 {
    let of_middle = if at & FIRST == 0 { SECOND } else { NEITHER };
    let of_second = at & SECOND;
    lower_of(
        first[of_middle] + across[of_second],
        first[of_middle | FIRST] + across[of_second | FIRST],
    )
}

/// Computes Q of all bundles that begin at run a, from Q of later ones. A type rather than a
/// closure, as that of the table.
struct Outwards<'o, 'a> {
    afar: &'o Abstraction<'a>,
    a: usize,
    inside: &'o mut [Bundles],
}

impl pulp::WithSimd for Outwards<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { afar, a, inside } = self;
        let (n, width) = (afar.cells.runs.len(), afar.width);
        for k in a + 1..n {
            let (at, lane) = (a * width + k / LANES, k % LANES);
            // Q of the bundle to k lacks only the charges in it.
            let mut first = if k == a + 1 { afar.edge(a, k) } else { of_lane(&inside[at], lane) };
            let [of_a, of_k] = afar.charged(a, k);
            if afar.cells.of(a, k).least > afar.bound {
                first = [f64::INFINITY; 4];
            }
            first[FIRST] = first[FIRST].min(first[NEITHER] + of_a);
            first[BOTH] = first[BOTH].min(first[SECOND] + of_a);
            first[SECOND] = first[SECOND].min(first[NEITHER] + of_k);
            first[BOTH] = first[BOTH].min(first[FIRST] + of_k);
            set_lane(&mut inside[at], lane, first);
            // Triangles on the edge from a to k, with the third corner in later runs.
            if k == a + 1 {
                let edge = afar.edge(a, k);
                for b in k + 1..n {
                    let second = of_lane(&inside[k * width + b / LANES], b % LANES);
                    let price = afar.cells.of(a, b).on_links[0];
                    let sums = &mut inside[a * width + b / LANES];
                    lower_lane(sums, b % LANES, |at| price + joined(&edge, &second, at));
                }
            }
            // Those on the edge from k to the run after it, with the third corner in a. Two edges
            // of the boundary may meet in the one sample of k.
            if k + 1 < n {
                let (b, edge) = (k + 1, afar.edge(k, k + 1));
                let is_between = k == a + 1 && afar.cells.runs.inner_edges(k) == 0;
                let before = if is_between { afar.edge(a, k) } else { [f64::INFINITY; 4] };
                let price = afar.cells.of(a, k).on_links[1];
                let sums = &mut inside[a * width + b / LANES];
                lower_lane(sums, b % LANES, |at| {
                    price + lower_of(joined(&first, &edge, at), joined(&before, &edge, at))
                });
            }
            if first[NEITHER] > afar.bound {
                continue;
            }
            let own = afar.rungs[at].all_like(lane);
            for group in (k + 1) / LANES..width {
                let second = &afar.rungs[k * width + group];
                let across = &afar.rungs[a * width + group];
                let below = inside[k * width + group];
                let mut any = false;
                for lane in 0..LANES {
                    let rungs = 0.5 * (own.least[lane] + second.least[lane] + across.least[lane]);
                    any |= first[NEITHER] + below[NEITHER][lane] + rungs <= afar.bound;
                }
                if !any {
                    continue;
                }
                let prices = afar.wide(&own, [a, k], group);
                let sums = &mut inside[a * width + group];
                for lane in 0..LANES {
                    let below = of_lane(&below, lane);
                    lower_lane(sums, lane, |at| prices[lane] + joined(&first, &below, at));
                }
            }
        }
    }
}

/// Computes R of all bundles that begin at run a, from R of earlier ones, and lowers R of later
/// ones.
struct Inwards<'i, 'a> {
    afar: &'i Abstraction<'a>,
    a: usize,
    inside: &'i [Bundles],
    outside: &'i mut [Bundles],
}

impl pulp::WithSimd for Inwards<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { afar, a, inside, outside } = self;
        let (n, width) = (afar.cells.runs.len(), afar.width);
        // R of the bundles, with the charges in them; and the least of each group.
        let (mut through, mut least) = (vec![NEVER; width], vec![f64::INFINITY; width]);
        for k in (a + 1..n).rev() {
            let (at, lane) = (a * width + k / LANES, k % LANES);
            let (first, own_rungs) = (of_lane(&inside[at], lane), afar.rungs[at].all_like(lane));
            let mut beyond = of_lane(&outside[at], lane);
            for group in (k + 1) / LANES..width {
                if first[NEITHER] + least[group] > afar.bound {
                    continue;
                }
                let (below, parents) = (&inside[k * width + group], &through[group]);
                let mut any = false;
                for lane in 0..LANES {
                    let inner = first[NEITHER] + below[NEITHER][lane];
                    any |= inner + parents[BOTH][lane] <= afar.bound;
                }
                if !any {
                    continue;
                }
                let price = afar.wide(&own_rungs, [a, k], group);
                let sums = &mut outside[k * width + group];
                let mut of_first = NEVER;
                for lane in 0..LANES {
                    let (below, parent) = (of_lane(below, lane), of_lane(parents, lane));
                    for at in 0..4 {
                        of_first[at][lane] = price[lane] + beside_first(&below, &parent, at);
                    }
                    lower_lane(sums, lane, |at| price[lane] + beside_second(&first, &parent, at));
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
                    lower_lane(sums, b % LANES, |at| price + beside_second(&edge, &parent, at));
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
            own[NEITHER] = own[NEITHER].min(own[FIRST] + of_a).min(own[SECOND] + of_k);
            set_lane(&mut through[k / LANES], lane, own);
            least[k / LANES] = least[k / LANES].min(own[BOTH]);
        }
    }
}
