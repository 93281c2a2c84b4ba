//! The cheapest triangulation of a ring domain: a cheapest closed walk round the band between its
//! two chains.
//!
//! 1. In a triangulation of a ring, the rungs that join the two chains follow one another round the
//!    band: after ⟨i,a⟩ comes ⟨j,a⟩, with a triangle on the side ⟨i,j⟩, whose other side is an edge
//!    or closes off a pocket, or ⟨i,b⟩ likewise. They are a closed walk on the torus of all pairs
//!    that winds once round each chain; a step costs the pocket that it jumps over, the fold price
//!    of its triangle and the twist of the rung that it reaches.
//! 2. The band is laid out on its universal cover, outer places I = 0, 1, 2, … and inner places A.
//!    The same pair of samples stands there once for each way to wind round the hole. On a
//!    supporting plane a rung is straight and has one way: whether it crosses a reference cut
//!    ⟨o,e⟩, and on which side of that cut it leaves where it begins at o or e, says which,
//!    exactly.
//! 3. Every walk jumps over the outer edge before o once, from a place P before it to a place Q at
//!    or behind it, along some inner place A. For given (Q, A) the walk is a shortest path from
//!    (Q, A) to (Q + m, A + k) through an acyclic grid: O(m k (m + k)).
//! 4. For a set of starts, the cheapest path from any of them to the image of any other is a lower
//!    bound on all of their walks, and the answer if it happens to close. Sets are halved between
//!    start and end until the cheapest path of all closes (branch and bound, as for circular
//!    shortest paths \[Appleton2003\]); a set that is no cheaper than a walk that is known is
//!    dropped. A few dozen sets are usual; at worst there is one for each pair. Where the work that
//!    may be done ends before, the best closed walk is the answer, and the cheapest path of the
//!    sets that are left is the lower bound.
//! 5. A walk with fewer than three steps along one chain, or one that takes all steps along one
//!    chain before all along the other, uses a rung twice and is no surface. It is possible only
//!    without a plane. Where the cheapest walk is one of those, the search is run again over paths
//!    that count their steps and turns.

use super::super::{Found, Side, Solved, TriangulateError};
use super::chains::{Chains, shortest_join};
use super::cover::{Along, BandWalk, Count, Grid, Least, Pair, Starts, before};
use super::pockets::{Pockets, Walk, least_of};
use super::winding::Winding;
use super::work::Work;
use super::{Part, search};
use crate::cost::QUANTUM;
use crate::watch::Watch;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What the tables of two chains of m and k samples take, bytes.
pub(super) fn memory_needed(m: usize, k: usize) -> u64 {
    let grid = (m as u64) * (k as u64);
    let joins = grid * size_of::<Join>() as u64;
    // Grids are up to four rounds high on a plane, and up to two without.
    let paths = 4 * grid * 2 * size_of::<f64>() as u64;
    let counting = (2 * grid * Count::ALL as u64).min(MOST_COUNTING_CELLS) * 32;
    Pockets::memory_needed(m) + Pockets::memory_needed(k) + joins + paths.max(counting)
}

/// Cells of all layers of a grid of paths that count, at the most: 32 bytes each, so 1.8 GiB.
const MOST_COUNTING_CELLS: u64 = 60_000_000;

/// The cheapest triangulation of a ring; `None` if there is none up to `bound`. `first` is one that
/// is known. Where there is no work left to be done, the best that is known by then, and what none
/// is cheaper than.
pub(super) fn solve_exactly(
    chains: &Chains<'_>,
    first: Option<Solved>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Found>, TriangulateError> {
    let limit = first.as_ref().map_or(bound, |first| first.price.min(bound));
    let Some(band) = Band::new(chains, limit, &mut Part::new(watch, 0.0..0.3))? else {
        return Ok(None);
    };
    let mut sought = band.cheapest_walk(false, limit, &mut Part::new(watch, 0.3..0.7))?;
    if let Some(walk) = sought.walk.take_if(|walk| !walk.is_simple()) {
        // The cheapest walk of all is no surface, but no surface is cheaper.
        let no_cheaper = sought.lower_bound.unwrap_or(walk.price);
        sought.lower_bound = Some(no_cheaper);
        let cells = 2 * (chains.len(0) * chains.len(1) * Count::ALL) as u64;
        if cells <= MOST_COUNTING_CELLS && !chains.work.is_out() {
            sought = band.cheapest_walk(true, limit, &mut Part::new(watch, 0.7..1.0))?;
            sought.lower_bound = sought.lower_bound.map(|bound| bound.max(no_cheaper));
        }
    }
    let Sought { walk, lower_bound } = sought;
    if let Some(walk) = walk {
        return Ok(Some(Found { triangles: band.triangles(&walk), lower_bound }));
    }
    // Where nothing is left open, there is none.
    if lower_bound.is_none() {
        return Ok(None);
    }
    let first = match first {
        Some(first) => Some(first),
        None => search::first(chains, bound, &mut Part::silent(watch))?,
    };
    Ok(first.map(|first| Found { triangles: first.triangles, lower_bound }))
}

/// The cheapest triangulation of the ring between two chains up to `bound`, without the price of
/// its cuts, or the best that was found before there was no work left; `None` if there is none, or
/// it is no surface.
pub(super) fn solve(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let Some(band) = Band::new(chains, bound, watch)? else { return Ok(None) };
    let sought = band.cheapest_walk(false, bound, watch)?;
    Ok(sought
        .walk
        .filter(BandWalk::is_simple)
        .map(|walk| Solved { price: walk.price, triangles: band.triangles(&walk) }))
}

/// A rung that may join the chains.
#[derive(Clone, Copy)]
struct Join {
    side: Side,
    /// How often its inner place winds round the hole, seen from its outer place in 0 .. m.
    winding: i8,
}

struct Band<'c, 'a> {
    chains: &'c Chains<'a>,
    outer: Walk,
    inner: Walk,
    /// The joining rungs at outer · k + inner.
    joins: Vec<Join>,
    outer_pockets: Pockets,
    inner_pockets: Pockets,
}

/// The share of the work that sets of starts get; the rest is for closed walks where that was not
/// enough.
const SHARE_OF_SETS: f64 = 0.8;

/// What a search for the cheapest closed walk has found.
struct Sought {
    /// The cheapest that is known.
    walk: Option<BandWalk>,
    /// What no closed walk is cheaper than, if one may be cheaper than that.
    lower_bound: Option<f64>,
}

/// A set of starts waiting to be halved; the cheapest first.
struct Open {
    walk: BandWalk,
    starts: Starts,
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |open: &Self| (!open.walk.closes(), open.starts);
        other.walk.price.total_cmp(&self.walk.price).then_with(|| key(other).cmp(&key(self)))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl<'c, 'a> Band<'c, 'a> {
    fn new(
        chains: &'c Chains<'a>,
        bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>, TriangulateError> {
        let Some((o, e)) = shortest_join(chains) else { return Ok(None) };
        let outer = Walk::new(chains, 0, o.at, false);
        let inner = Walk::new(chains, 1, e.at, true);
        let points = |sample: usize| chains.point(sample).unwrap_or_default();
        let winding = chains.has_plane().then_some(Winding { chains, o, e, points: &points });
        let joins = outer
            .spots
            .iter()
            .flat_map(|&p| inner.spots.iter().map(move |&q| (p, q)))
            .map(|(p, q)| {
                let side = chains.side(p, q);
                let winding = match &winding {
                    Some(winding) if side.price < f64::INFINITY => winding.of_join(p, q),
                    _ => 0,
                };
                Join { side, winding }
            })
            .collect();
        let closes = |walk: &Walk, s: usize, q: usize| {
            winding.as_ref().is_none_or(|winding| winding.closes(walk, s, q))
        };
        let mut part = Part::new(watch, 0.0..0.7);
        let outer_pockets =
            Pockets::new(chains, &outer, |s, q| closes(&outer, s, q), bound, &mut part)?;
        let mut part = Part::new(watch, 0.7..1.0);
        let inner_pockets =
            Pockets::new(chains, &inner, |s, q| closes(&inner, s, q), bound, &mut part)?;
        Ok(Some(Self { chains, outer, inner, joins, outer_pockets, inner_pockets }))
    }

    fn m(&self) -> usize {
        self.outer.len()
    }

    fn k(&self) -> i64 {
        self.inner.len() as i64
    }

    /// The inner place below a place on the cover.
    fn below(&self, a: i64) -> usize {
        a.rem_euclid(self.k()) as usize
    }

    fn join(&self, p: usize, a: i64) -> Join {
        self.joins[p * self.inner.len() + self.below(a)]
    }

    /// The price of a joining rung between places on the cover; infinite if it winds otherwise.
    fn join_price(&self, p: usize, a: i64) -> f64 {
        let join = self.join(p, a);
        let winds = !self.chains.has_plane() || i64::from(join.winding) == a.div_euclid(self.k());
        if winds { join.side.price } else { f64::INFINITY }
    }

    /// The fold price of the triangle of a step along the outer chain.
    fn outer_fold(&self, p: usize, q: usize, a: i64) -> f64 {
        let [p, q] = [p, q].map(|place| place % self.m());
        let (at_p, at_q) = (self.join(p, a).side.mean, self.join(q, a).side.mean);
        let corners =
            [self.outer.samples[p], self.outer.samples[q], self.inner.samples[self.below(a)]];
        self.chains.fold(corners, [self.outer_pockets.mean(p, q), at_q, at_p])
    }

    /// The fold price of the triangle of a step along the inner chain.
    fn inner_fold(&self, p: usize, a: i64, b: i64) -> f64 {
        let (at_a, at_b) = (self.join(p, a).side.mean, self.join(p, b).side.mean);
        let [a, b] = [a, b].map(|place| self.below(place));
        let corners = [self.outer.samples[p], self.inner.samples[b], self.inner.samples[a]];
        self.chains.fold(corners, [at_b, self.inner_pockets.mean(a, b), at_a])
    }

    /// The cheapest closed walk up to `bound`; with `counting`, of those that use no rung twice.
    fn cheapest_walk(
        &self,
        counting: bool,
        mut bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Sought, TriangulateError> {
        let work = self.chains.work.part(SHARE_OF_SETS);
        let (m, k) = (self.m(), self.k());
        // A walk through the reference cut gives a first bound.
        let through_cut = Starts { outer: (0, 0), inner: (0, 0) };
        let mut open = BinaryHeap::new();
        let mut left = 1.0;
        let mut part = Part::new(watch, 0.0..0.3);
        if let Some(walk) =
            self.swept(&through_cut, counting, bound, self.chains.work, &mut part)?
        {
            // From here on, only what is cheaper counts.
            bound = bound.min(walk.price - QUANTUM);
            open.push(Open { walk, starts: through_cut });
        }
        let (first, all) = if self.chains.has_plane() {
            ((-k, k - 1), (-k, 2 * k - 1))
        } else {
            ((0, k - 1), (0, k - 1))
        };
        let mut sets = vec![
            (Starts { outer: (0, 0), inner: first }, 0.0),
            (Starts { outer: (1, m - 1), inner: all }, 0.0),
        ];
        left *= 0.7;
        // The least that a walk may cost from starts that were not sought.
        let mut unsought = f64::INFINITY;
        loop {
            for (starts, least) in sets.drain(..) {
                // How often sets are halved is not known: each sweep gets half of what is left.
                let mut part = Part::new(watch, 1.0 - left..1.0 - 0.5 * left);
                left *= 0.5;
                if let Some(walk) = self.swept(&starts, counting, bound, work, &mut part)? {
                    if walk.closes() {
                        // From here on, only what is cheaper counts.
                        bound = bound.min(walk.price - QUANTUM);
                    }
                    open.push(Open { walk, starts });
                } else if work.is_out() {
                    unsought = unsought.min(least);
                }
            }
            if unsought < f64::INFINITY {
                return self.given_up(open.into_sorted_vec(), unsought, counting, bound, watch);
            }
            let Some(Open { walk, starts }) = open.pop() else {
                return Ok(self.sought(None, f64::INFINITY));
            };
            if walk.closes() {
                let price = walk.price;
                return Ok(self.sought(Some(walk), price));
            }
            sets.extend(starts.halved(walk.start(), walk.end).map(|half| (half, walk.price)));
        }
    }

    /// What was found when no walk is cheaper than `least`, as far as all pockets are worked out.
    fn sought(&self, walk: Option<BandWalk>, least: f64) -> Sought {
        let are_all = self.outer_pockets.are_all && self.inner_pockets.are_all;
        let least = if are_all { least } else { 0.0 };
        let is_least = least >= walk.as_ref().map_or(f64::INFINITY, |walk| walk.price);
        Sought { walk, lower_bound: (!is_least).then_some(least) }
    }

    /// The best closed walk that is known when not all starts could be sought: `open` has the
    /// cheapest paths from those that were, the cheapest last. From where they begin, a few closed
    /// walks more are sought with what work is left.
    fn given_up(
        &self,
        open: Vec<Open>,
        unsought: f64,
        counting: bool,
        mut bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Sought, TriangulateError> {
        let least = open.iter().map(|open| open.walk.price).fold(unsought, f64::min);
        let (mut closed, paths): (Vec<Open>, Vec<Open>) =
            open.into_iter().rev().partition(|open| open.walk.closes());
        for (p, a) in paths.iter().flat_map(|path| [path.walk.start(), path.walk.end]) {
            let starts = Starts { outer: (p, p), inner: (a, a) };
            let part = &mut Part::silent(watch);
            if let Some(walk) = self.swept(&starts, counting, bound, self.chains.work, part)? {
                bound = bound.min(walk.price - QUANTUM);
                closed.push(Open { walk, starts });
            }
        }
        let key = |open: &Open| (!open.walk.is_simple(), open.walk.price);
        let best = closed.into_iter().min_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        Ok(self.sought(best.map(|best| best.walk), least))
    }

    /// The cheapest path from one of the starts to the image of one of them, if there is work left
    /// to find it.
    fn swept(
        &self,
        starts: &Starts,
        counting: bool,
        bound: f64,
        work: Work<'_>,
        watch: &mut dyn Watch,
    ) -> Result<Option<BandWalk>, TriangulateError> {
        if work.is_out() {
            return Ok(None);
        }
        if counting {
            self.counting_sweep(starts, bound, work, watch)
        } else {
            self.sweep(starts, bound, work, watch)
        }
    }

    /// The cheapest path from one of the starts to the image of one of them.
    fn sweep(
        &self,
        starts: &Starts,
        bound: f64,
        work: Work<'_>,
        watch: &mut dyn Watch,
    ) -> Result<Option<BandWalk>, TriangulateError> {
        let grid = Grid::new(starts, self.m(), self.k());
        let mut least = Least::new(&grid);
        for c in 0..grid.columns {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            if work.is_out() {
                return Ok(None);
            }
            watch.progress(c as f64 / grid.columns as f64);
            work.count(grid.rows as u64);
            for r in 0..grid.rows {
                let (p, a) = grid.pair(c, r);
                let price = self.join_price(p, a);
                if price > bound {
                    continue;
                }
                let reached = if starts.contain((p, a)) {
                    Some(0.0)
                } else {
                    let below = bound - price + QUANTUM;
                    self.arrive(&grid, &least, (c, r), below).map(|(least, _)| price + least)
                };
                if let Some(reached) = reached {
                    least.set(&grid, (c, r), reached);
                }
            }
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
    fn counting_sweep(
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
        for c in 0..grid.columns {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            if work.is_out() {
                return Ok(None);
            }
            watch.progress(c as f64 / grid.columns as f64);
            work.count(grid.rows as u64);
            for r in 0..grid.rows {
                let (p, a) = grid.pair(c, r);
                let price = self.join_price(p, a);
                if price > bound {
                    continue;
                }
                if starts.contain((p, a)) {
                    layers[Count::START.number()].set(&grid, (c, r), 0.0);
                }
                for number in 0..Count::ALL {
                    let here = layers[number].at(&grid, (c, r));
                    let mut arrived: Vec<(f64, usize, (usize, usize))> = Vec::new();
                    for &(before, along) in &steps[number] {
                        let layer = &layers[before];
                        let below = (bound - price + QUANTUM).min(here);
                        let found = self.arrive_along(&grid, layer, (c, r), below, along);
                        arrived.extend(found.map(|(sum, at)| (price + sum, before, at)));
                    }
                    let best = arrived.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
                    if let Some((sum, before, at)) = best.filter(|best| best.0 < here) {
                        layers[number].set(&grid, (c, r), sum);
                        from[number * grid.cells() + grid.cell((c, r))] =
                            Some((at.0 as u32, at.1 as u32, before as u8));
                    }
                }
            }
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

    /// The triangles of a closed walk and its pockets.
    fn triangles(&self, walk: &BandWalk) -> Vec<[usize; 3]> {
        let mut triangles = Vec::new();
        for [(p, a), (q, b)] in walk.steps() {
            let [p_at, q_at] = [p, q].map(|place| place % self.m());
            let [a_at, b_at] = [a, b].map(|place| self.below(place));
            let [p_is, q_is] = [p_at, q_at].map(|place| self.outer.samples[place]);
            let [a_is, b_is] = [a_at, b_at].map(|place| self.inner.samples[place]);
            if a == b {
                triangles.push([p_is, q_is, a_is]);
                self.outer_pockets.trace(self.chains, &self.outer, p_at, q - p, &mut triangles);
            } else {
                triangles.push([p_is, b_is, a_is]);
                let length = (b - a) as usize;
                self.inner_pockets.trace(self.chains, &self.inner, a_at, length, &mut triangles);
            }
        }
        triangles
    }
}
