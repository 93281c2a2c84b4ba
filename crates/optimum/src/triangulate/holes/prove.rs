//! The optimum of a domain with several holes, or a lower bound on it.
//!
//! The bound of [`super::bound`] drops all triangles that no cheaper triangulation has; mostly none
//! are left, and the best known triangulation is proven optimal. Otherwise branch and bound
//! searches the triangles that are left: beginning at an edge of the boundary, the open side with
//! the fewest triangles to choose from gets one after the other, and the bound is raised anew. A
//! complete surface is cheaper than the best known one, and is checked to be a surface: without a
//! plane, the relaxation also admits holes that are closed by lids of their own, and the like.
//! Where the work limit ends the search, the lowest bound of the branches not searched is the lower
//! bound.

use super::super::{Solved, TriangulateError};
use super::Part;
use super::bound::{Left, Relaxation, price_of, units};
use super::chains::Chains;
use super::search::{Sides, one_chain};
use super::work::LOOK;
use crate::cost::EXACT_BELOW;
use sheetwright_geometry::watch::Watch;
use std::collections::BTreeSet;

/// The share of the remaining work for sweeps before the search begins.
const SHARE_OF_SWEEPS: f64 = 0.5;
/// Steps for each step of the search, beside the triangles that it looks at.
const OF_STEP: u64 = 1000;
/// Limits of the sweeps before the search begins, and at each of its steps.
const FIRST_SWEEPS: usize = 400;
const SWEEPS: usize = 12;
/// The part of the difference that a rung moves, in sixteenths: 8 leaves both sides equal, 16 moves
/// all. Of 8, 10, 12, 14 and 16, 12 closed the gap of panels with two to eight holes on a plane in
/// the fewest sweeps. Without a plane, where remaining prices begin negative, 8 for the first
/// sweeps and then 10 gave the best bound of the few that were tried.
const SHARE: i64 = 12;
const SHARE_FIRST: i64 = 8;
const SHARE_OPEN: i64 = 10;
const HALVING: usize = 40;
/// Without a plane, this part of the price to beat is taken off every triangle at the beginning: a
/// lid over a hole saves four of them.
const FOR_COUNT: i64 = 4;
/// Without a plane, no search is tried if more triangles are left than this many times those of a
/// triangulation, and than [`SEARCHED`]: it would not end.
const HOPELESS: usize = 40;
const SEARCHED: usize = 20_000;
/// Sweeps that close less than a hundredth of the gap have stalled, or a thousandth without a
/// plane; so many in a row are enough.
const STALLED: i64 = 100;
const STALLED_OPEN: i64 = 1000;
const ENOUGH_STALLED: usize = 4;

/// The best triangulation, and the lower bound if that is below its price.
pub(super) fn prove(
    chains: &Chains<'_>,
    best: Solved,
    watch: &mut dyn Watch,
) -> Result<(Solved, Option<f64>), TriangulateError> {
    if best.price >= EXACT_BELOW {
        // A sum so large is rounded, so no whole number represents it.
        return Ok((best, Some(0.0)));
    }
    let chain = one_chain(chains, &best);
    let Some(relaxation) = Relaxation::new(chains, &chain, &best, watch)? else {
        return Ok((best, Some(0.0)));
    };
    let wanted = chains.terms.prices.len() + 2 * chains.chains.len() - 4;
    let mut left = relaxation.whole();
    // Without a fold price, pairs of triangles back to back cost nothing and undo it.
    if !chains.has_plane() && chains.terms.prices.options().fold > 0.0 {
        left.take((relaxation.limit / FOR_COUNT).min(i64::MAX / 4 / wanted as i64), wanted);
    }
    let sweeping = &chains.within(chains.work.part(SHARE_OF_SWEEPS));
    let mut any = raise(sweeping, &relaxation, &mut left, FIRST_SWEEPS, watch)?;
    if any && !left.is_bound() {
        left = relaxation.whole();
        let sweeping = &chains.within(chains.work.part(SHARE_OF_SWEEPS));
        any = raise(sweeping, &relaxation, &mut left, FIRST_SWEEPS, watch)?;
    }
    if !any {
        return Ok((best, None));
    }
    if !chains.has_plane() && left.triangles() > (HOPELESS * wanted).max(SEARCHED) {
        return Ok((best, Some(price_of(left.bound).max(0.0))));
    }
    let (relaxation, left) = relaxation.without_dropped(&left);
    let mut search =
        Search { chains, limit: relaxation.limit, relaxation, best, open_bound: None, wanted };
    search.grow(left, Grown::default(), watch)?;
    let lower_bound = search.open_bound.map(price_of);
    Ok((search.best, lower_bound))
}

/// Raises the bound by sweeps until it stalls; false if no triangle below the limit is left.
fn raise(
    chains: &Chains<'_>,
    relaxation: &Relaxation,
    left: &mut Left,
    most: usize,
    watch: &mut dyn Watch,
) -> Result<bool, TriangulateError> {
    let mut stalled = 0;
    let stall = if chains.has_plane() { STALLED } else { STALLED_OPEN };
    for sweep in 0..most {
        if watch.stop() {
            return Err(TriangulateError::Stopped);
        }
        if left.is_bound() {
            watch.progress((left.bound as f64 / relaxation.limit.max(1) as f64).clamp(0.0, 1.0));
        }
        let before = left.bound;
        let share = match chains.has_plane() {
            true => SHARE,
            false if sweep < HALVING => SHARE_FIRST,
            false => SHARE_OPEN,
        };
        let any = left.sweep(relaxation, sweep % 2 == 0, share);
        chains.work.count(LOOK * left.looked);
        if !any {
            return Ok(false);
        }
        let gap = relaxation.limit - left.bound;
        stalled = if left.is_bound() && (left.bound - before).saturating_mul(stall) < gap {
            stalled + 1
        } else {
            0
        };
        if stalled >= ENOUGH_STALLED || chains.work.is_out() {
            break;
        }
    }
    Ok(true)
}

/// A partial surface: its triangles, the sides it has walked, and the open ones.
#[derive(Clone, Default)]
struct Grown {
    triangles: Vec<u32>,
    walked: BTreeSet<u32>,
    waiting: BTreeSet<u32>,
}

struct Search<'c, 'a> {
    chains: &'c Chains<'a>,
    relaxation: Relaxation,
    best: Solved,
    limit: i64,
    /// The lowest bound of what was not searched, in half quanta.
    open_bound: Option<i64>,
    /// How many triangles a triangulation has.
    wanted: usize,
}

impl Search<'_, '_> {
    /// Searches all triangulations that contain the partial surface.
    fn grow(
        &mut self,
        mut left: Left,
        mut grown: Grown,
        watch: &mut dyn Watch,
    ) -> Result<(), TriangulateError> {
        loop {
            let Some(mut candidates) = self.candidates(&mut left, &grown, watch)? else {
                return Ok(());
            };
            candidates.sort_by_key(|&t| (left.with(t), t));
            // In this loop while there is no choice; else a recursive call for each choice.
            let [.., last] = candidates[..] else { return Ok(()) };
            for &triangle in &candidates[..candidates.len() - 1] {
                let (mut left, mut grown) = (left.clone(), grown.clone());
                self.chains.work.count(self.relaxation.corners.len() as u64);
                if self.take(&mut left, &mut grown, triangle) {
                    self.grow(left, grown, watch)?;
                }
            }
            if !self.take(&mut left, &mut grown, last) {
                return Ok(());
            }
        }
    }

    /// Adds a triangle, and drops those that it shuts out; false if it does not fit.
    fn take(&self, left: &mut Left, grown: &mut Grown, triangle: u32) -> bool {
        for way in self.relaxation.ways[triangle as usize] {
            let others = self.relaxation.on(way).iter().filter(|&&t| t != triangle);
            others.for_each(|&t| left.drop_triangle(t));
        }
        grown.take(&self.relaxation, triangle)
    }

    /// The triangles for the open side with the fewest to choose from; `None` if no side is open,
    /// no cheaper surface is left, or the search is given up.
    fn candidates(
        &mut self,
        left: &mut Left,
        grown: &Grown,
        watch: &mut dyn Watch,
    ) -> Result<Option<Vec<u32>>, TriangulateError> {
        self.relaxation.limit = self.limit;
        watch.progress(self.chains.work.share());
        if grown.waiting.is_empty() && !grown.triangles.is_empty() {
            self.finish(grown);
            return Ok(None);
        }
        if self.chains.work.is_out() {
            self.open_bound = Some(self.open_bound.map_or(left.bound, |b| b.min(left.bound)));
            return Ok(None);
        }
        let part = &mut Part::silent(watch);
        let any = raise(self.chains, &self.relaxation, left, SWEEPS, part)?;
        self.chains.work.count(OF_STEP);
        if !any {
            return Ok(None);
        }
        let candidates = |way: u32| {
            let list = self.relaxation.on(way).iter().copied();
            list.filter(|&t| !left.is_dropped(t)).collect::<Vec<u32>>()
        };
        let ways = if grown.triangles.is_empty() {
            self.relaxation.edges().to_vec()
        } else {
            grown.waiting.iter().copied().collect()
        };
        Ok(ways.into_iter().map(candidates).min_by_key(Vec::len))
    }

    /// Keeps a complete surface, if it is one and cheaper than the best.
    fn finish(&mut self, grown: &Grown) {
        let price: i64 = grown.triangles.iter().map(|&t| self.relaxation.prices[t as usize]).sum();
        let triangles: Vec<[usize; 3]> = grown
            .triangles
            .iter()
            .map(|&t| self.relaxation.corners[t as usize].map(|sample| sample as usize))
            .collect();
        let edges = self.relaxation.edges();
        let complete = triangles.len() == self.wanted
            && edges.iter().all(|edge| grown.walked.contains(edge))
            && Sides::new(self.chains, &triangles)
                .is_some_and(|sides| sides.fans_are_whole(&triangles));
        if complete && price < self.limit {
            self.best = Solved { price: price_of(price), triangles };
            self.limit = units(self.best.price);
        }
    }
}

impl Grown {
    /// Adds a triangle; false if it does not fit.
    fn take(&mut self, relaxation: &Relaxation, triangle: u32) -> bool {
        self.triangles.push(triangle);
        for way in relaxation.ways[triangle as usize] {
            if !self.walked.insert(way) {
                return false;
            }
            if !self.waiting.remove(&way) && !relaxation.is_edge(way) {
                self.waiting.insert(way ^ 1);
            }
        }
        true
    }
}
