//! Where a piece is cut across: the fewest lines, at the places that cost least.
//!
//! Lines stand square to the long side of the smallest box around the piece. How far a slab may
//! reach from a line so that it still fits a sheet grows with the place of the line, so all slabs
//! that fit are known from one walk along the piece. Places are a grid, even shares, and those at
//! which slabs are as long as can be, counted from either end: with these, the number of slabs is
//! the least that there is. Of all ways with that number, the cheapest is found by dynamic
//! programming over the places. What costs: tight bends, folds, holes and stations nearby, joints
//! that are long or in several stretches, and pieces of uneven lengths.

use sheetwright_geometry::math::Point2;

/// Places of the grid.
const GRID: usize = 240;
/// Even shares of up to so many pieces are tried.
const SHARES: usize = 24;
/// A hindrance costs nothing from this share of the width of the piece on.
const NEAR: f64 = 0.25;
/// The cost of a joint as long as the piece is wide.
const OF_LENGTH: f64 = 0.5;
/// The cost of every stretch of a joint beyond the first, as between a hole and the outline.
const OF_STRETCH: f64 = 5.0;
/// The cost of a piece that is longer or shorter than the mean by the mean.
const OF_UNEVENNESS: f64 = 1.0;
/// Halvings of the interval in which the longest slab ends.
const HALVINGS: usize = 60;

/// Something that joints keep away from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Hindrance {
    /// Its points on the pattern, mm.
    pub(crate) points: Vec<Point2>,
    /// What a joint through it costs.
    pub(crate) weight: f64,
}

/// A piece that is to be cut across, with the way along it as x.
pub(super) struct Span<'a> {
    /// The steps of its border, and where its joints reach to beyond it.
    pub(super) steps: &'a [[Point2; 2]],
    /// The first and the last place of each hindrance, and its weight.
    pub(super) hindrances: Vec<([f64; 2], f64)>,
    /// How far the material of a joint reaches beyond its line, mm.
    pub(super) reach_mm: f64,
    /// Whether points fit a sheet.
    pub(super) fits: &'a dyn Fn(&[Point2]) -> bool,
}

impl Span<'_> {
    /// The places of the lines, in increasing order, and their cost; `None` where no slabs fit.
    pub(super) fn places(&self, most: usize) -> Option<(Vec<f64>, f64)> {
        let xs = || self.steps.iter().flatten().map(|p| p.x);
        let [low, high] = [xs().fold(f64::INFINITY, f64::min), xs().fold(-f64::INFINITY, f64::max)];
        let whole = [low, high];
        let candidates = self.candidates(whole, most)?;
        let count = candidates.len();
        // The last candidate that a slab from each may reach to.
        let mut reaches = vec![0; count];
        let mut to = 0;
        for from in 0..count {
            to = to.max(from);
            while to + 1 < count && self.is_slab([candidates[from], candidates[to + 1]], whole) {
                to += 1;
            }
            reaches[from] = to;
        }
        // The least number of slabs up to each candidate.
        let mut least = vec![usize::MAX; count];
        least[0] = 0;
        for from in 0..count {
            let Some(one_more) = least[from].checked_add(1) else { continue };
            for slabs in &mut least[from + 1..=reaches[from]] {
                *slabs = (*slabs).min(one_more);
            }
        }
        let slabs = *least.last()?;
        if slabs == usize::MAX || slabs > most {
            return None;
        }
        self.cheapest(&candidates, &reaches, slabs)
    }

    /// The cheapest lines that make so many slabs.
    fn cheapest(
        &self,
        candidates: &[f64],
        reaches: &[usize],
        slabs: usize,
    ) -> Option<(Vec<f64>, f64)> {
        let count = candidates.len();
        let (low, high) = (candidates[0], candidates[count - 1]);
        let mean = (high - low) / slabs as f64;
        let costs: Vec<f64> = candidates.iter().map(|&at| self.cost(at)).collect();
        let uneven = |from: usize, to: usize| {
            let share = (candidates[to] - candidates[from]) / mean - 1.0;
            OF_UNEVENNESS * share * share
        };
        let mut best = vec![f64::INFINITY; count];
        best[0] = 0.0;
        let mut before = Vec::with_capacity(slabs);
        for slab in 0..slabs {
            let mut next = vec![f64::INFINITY; count];
            let mut from_where = vec![0; count];
            for from in (0..count).filter(|&from| best[from].is_finite()) {
                for to in from + 1..=reaches[from] {
                    let is_end = to + 1 == count;
                    if is_end != (slab + 1 == slabs) {
                        continue;
                    }
                    let of_line = if is_end { 0.0 } else { costs[to] };
                    let cost = best[from] + uneven(from, to) + of_line;
                    if cost < next[to] {
                        (next[to], from_where[to]) = (cost, from);
                    }
                }
            }
            before.push(from_where);
            best = next;
        }
        let mut at = count - 1;
        let cost = best[at];
        let mut places = Vec::with_capacity(slabs - 1);
        for from_where in before.iter().rev() {
            at = from_where[at];
            places.push(candidates[at]);
        }
        places.pop();
        places.reverse();
        cost.is_finite().then_some((places, cost))
    }

    /// Places at which lines may stand, both ends included; `None` where even the first slab does
    /// not fit.
    fn candidates(&self, [low, high]: [f64; 2], most: usize) -> Option<Vec<f64>> {
        let length = high - low;
        let share = |n: usize, of: usize| low + length * n as f64 / of as f64;
        let mut all: Vec<f64> = (0..=GRID).map(|n| share(n, GRID)).collect();
        for of in 2..=SHARES {
            all.extend((1..of).map(|n| share(n, of)));
        }
        let whole = [low, high];
        let mut from = low;
        for _ in 0..most {
            let to = self.longest(high, from, |to| self.is_slab([from, to], whole))?;
            all.push(to);
            from = to;
            if to >= high {
                break;
            }
        }
        let mut to = high;
        for _ in 0..most {
            let from = self.longest(low, to, |from| self.is_slab([from, to], whole))?;
            all.push(from);
            to = from;
            if from <= low {
                break;
            }
        }
        all.retain(|at| low < *at && *at < high);
        all.extend(whole);
        all.sort_by(f64::total_cmp);
        all.dedup();
        Some(all)
    }

    /// The place farthest from `near` towards `far` up to which a slab fits; `None` where it does
    /// not reach a step of the grid.
    fn longest(&self, far: f64, near: f64, fits: impl Fn(f64) -> bool) -> Option<f64> {
        if fits(far) {
            return Some(far);
        }
        let (mut good, mut bad) = (near, far);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (good + bad);
            if fits(middle) { good = middle } else { bad = middle }
        }
        let least = (far - near).abs() / (GRID * GRID) as f64;
        ((good - near).abs() > least).then_some(good)
    }

    /// Whether the slab from one place to another fits a sheet, with the material of its joints.
    fn is_slab(&self, [from, to]: [f64; 2], [low, high]: [f64; 2]) -> bool {
        let mut points: Vec<Point2> = Vec::new();
        for &[a, b] in self.steps {
            points.extend([a, b].into_iter().filter(|p| from <= p.x && p.x <= to));
            for (at, end, way) in [(from, low, -1.0), (to, high, 1.0)] {
                let is_crossed = (a.x - at) * (b.x - at) <= 0.0 && a.x != b.x;
                if at != end && is_crossed {
                    let p = a.lerp(b, (at - a.x) / (b.x - a.x));
                    points.extend([p, Point2::new(at + way * self.reach_mm, p.y)]);
                }
            }
        }
        (self.fits)(&points)
    }

    /// The cost of a line at a place.
    fn cost(&self, at: f64) -> f64 {
        let mut crossed: Vec<f64> = Vec::new();
        let mut sides = [f64::INFINITY, f64::NEG_INFINITY];
        for &[a, b] in self.steps {
            for y in [a.y, b.y] {
                sides = [sides[0].min(y), sides[1].max(y)];
            }
            if (a.x < at) != (b.x < at) {
                crossed.push(a.lerp(b, (at - a.x) / (b.x - a.x)).y);
            }
        }
        crossed.sort_by(f64::total_cmp);
        let width = sides[1] - sides[0];
        let length: f64 = crossed.chunks_exact(2).map(|pair| pair[1] - pair[0]).sum();
        let stretches = (crossed.len() / 2).max(1) - 1;
        let near_mm = NEAR * width + self.reach_mm;
        let hindered: f64 = self
            .hindrances
            .iter()
            .map(|&([from, to], weight)| {
                let off = (from - at).max(at - to).max(0.0);
                weight * (1.0 - off / near_mm).max(0.0)
            })
            .sum();
        OF_LENGTH * length / width + OF_STRETCH * stretches as f64 + hindered
    }
}
