//! The cheapest triangulation of a ring domain: a cheapest closed walk round the band between its
//! two chains.
//!
//! 1. In a triangulation of a ring, the rungs that join the two chains follow one another round the
//!    band: after ⟨i,a⟩ comes ⟨j,a⟩, with a triangle on the side ⟨i,j⟩, whose other side is an edge
//!    or closes off a pocket, or ⟨i,b⟩ likewise. They are a closed walk on the torus of all pairs
//!    that winds once round each chain; a step costs the pocket that it jumps over, the fold price
//!    of its triangle and the twist of the rung that it reaches.
//! 2. The band is laid out on its universal cover, outer places I = 0, 1, 2, … and inner places A.
//!    A pair of samples stands there once for each way to wind round the hole. On a
//!    supporting plane a rung is straight and has one way: whether it crosses a reference cut
//!    ⟨o,e⟩, and on which side of that cut it leaves where it begins at o or e, says which,
//!    exactly.
//! 3. The walk is sought over sets of starts ([`starts`]), with a sweep through the cover for each
//!    ([`sweep`]).
//! 4. A walk with fewer than three steps along one chain, or one that takes all steps along one
//!    chain before all along the other, uses a rung twice and is no surface. That is possible only
//!    without a plane. If the cheapest walk is such a walk, the search is repeated over paths that
//!    count their steps and turns.

mod starts;
mod sweep;

use super::super::{Side, Solved, TriangulateError};
use super::Part;
use super::chains::{Chains, shortest_join};
use super::cover::{BandWalk, Count};
use super::pockets::{Pockets, Walk};
use super::winding::Winding;
use sheetwright_geometry::watch::Watch;
use starts::Sought;

/// Memory of the tables of two chains of m and k samples, bytes.
pub(super) fn memory_needed(m: usize, k: usize) -> u64 {
    let grid = (m as u64) * (k as u64);
    let joins = grid * size_of::<Join>() as u64;
    // Grids are up to four rounds high on a plane, and up to two without.
    let paths = 4 * grid * 2 * size_of::<f64>() as u64;
    let counting = (2 * grid * Count::ALL as u64).min(MOST_COUNTING_CELLS) * 32;
    Pockets::memory_needed(m) + Pockets::memory_needed(k) + joins + paths.max(counting)
}

/// Limit of the cells in all layers of a grid of counting paths: 32 bytes each, so 1.8 GiB.
const MOST_COUNTING_CELLS: u64 = 60_000_000;

/// The result of the search on a ring.
pub(super) struct RingFound {
    /// The triangles of the cheapest triangulation that was found; `None` if none was.
    pub(super) triangles: Option<Vec<[usize; 3]>>,
    /// Lower bound on the price of every triangulation, if it is below the price of these
    /// triangles, or if the work ended before it was known whether there are any.
    pub(super) lower_bound: Option<f64>,
}

/// The cheapest triangulation of a ring up to `bound`; or, where the work limit ends the search,
/// the best found so far, and a lower bound.
pub(super) fn solve_exactly(
    chains: &Chains<'_>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<RingFound, TriangulateError> {
    let Some(band) = Band::new(chains, bound, &mut Part::new(watch, 0.0..0.3))? else {
        return Ok(RingFound { triangles: None, lower_bound: None });
    };
    let mut sought = band.cheapest_walk(false, bound, &mut Part::new(watch, 0.3..0.7))?;
    if let Some(walk) = sought.walk.take_if(|walk| !walk.is_simple()) {
        // The cheapest walk of all is no surface, but no surface is cheaper.
        let no_cheaper = sought.lower_bound.unwrap_or(walk.price);
        sought.lower_bound = Some(no_cheaper);
        let cells = 2 * (chains.len(0) * chains.len(1) * Count::ALL) as u64;
        if cells <= MOST_COUNTING_CELLS && !chains.work.is_out() {
            sought = band.cheapest_walk(true, bound, &mut Part::new(watch, 0.7..1.0))?;
            sought.lower_bound = sought.lower_bound.map(|bound| bound.max(no_cheaper));
        }
    }
    let Sought { walk, lower_bound } = sought;
    Ok(RingFound { triangles: walk.map(|walk| band.triangles(&walk)), lower_bound })
}

/// The cheapest triangulation of the ring between two chains up to `bound`, without the price of
/// its cuts, or the best found before the work ended; `None` if there is none, or it is no surface.
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
    /// The winding number of its inner place round the hole, seen from its outer place in 0 .. m.
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

    /// The price of a joining rung between places on the cover; infinite if its winding differs.
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
