//! Which rungs lie inside the projection of the boundary on its supporting plane.
//!
//! Exactly, by triangular expansion (`expansion`); or, for most searches, by the ends of the rungs
//! alone (`at_ends`), which excludes most rungs outside in a fraction of the time. If the triangles
//! of the optimum do not overlap in the projection, all of its rungs are inside, and the exact test
//! is not needed (`triangulate::plane_check`).

mod at_ends;
mod expansion;
mod pairs;

use at_ends::pairs_at_ends;
use expansion::inside_pairs;
use pairs::PairSet;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::math::Point2;
use std::sync::OnceLock;

/// Which pairs of samples may be joined: any two, or those whose rung lies inside the projection.
#[derive(Clone, Debug)]
pub struct Visibility {
    seen: Seen,
}

#[derive(Clone, Debug)]
enum Seen {
    Everything,
    Pairs(PairSet),
    /// The rungs inside at both ends, computed at first use.
    AtEnds(Vec<Point2>, OnceLock<PairSet>),
}

impl Visibility {
    /// The visible pairs of a boundary over a plane; all pairs without a plane.
    pub fn new(boundary: &Boundary, plane: Option<&SupportingPlane>) -> Self {
        let inside = |plane: &SupportingPlane| inside_pairs(&plane.projected, boundary.loops());
        Self { seen: plane.map_or(Seen::Everything, |plane| Seen::Pairs(inside(plane))) }
    }

    /// All pairs, as without a plane.
    pub(crate) fn everything() -> Self {
        Self { seen: Seen::Everything }
    }

    /// The pairs of samples of one loop whose rung leaves into the inside at both ends, or for
    /// which rounding leaves that open: all that see one another, and few others unless the
    /// projection winds. Computed at first use, in a fraction of the time.
    pub(crate) fn at_ends(plane: &SupportingPlane) -> Self {
        Self { seen: Seen::AtEnds(plane.projected.clone(), OnceLock::new()) }
    }

    /// The pairs of samples that see one another; `None` where any two do.
    #[inline(always)]
    fn pairs(&self) -> Option<&PairSet> {
        match &self.seen {
            Seen::Everything => None,
            Seen::Pairs(pairs) => Some(pairs),
            Seen::AtEnds(polygon, pairs) => Some(pairs.get_or_init(|| pairs_at_ends(polygon))),
        }
    }

    /// Memory for so many samples where not all pairs are visible, bytes.
    pub(crate) fn memory_needed(m: usize) -> u64 {
        PairSet::bytes_of(m)
    }

    /// Memory once the pairs are computed, bytes.
    pub(crate) fn bytes(&self) -> u64 {
        match &self.seen {
            Seen::Everything => 0,
            Seen::Pairs(pairs) => pairs.bytes(),
            Seen::AtEnds(polygon, _) => PairSet::bytes_of(polygon.len()),
        }
    }

    /// Which of the 16 samples from `first` on, a multiple of 16, may be joined with sample `i`, a
    /// lower one: one bit each, the lowest for the first.
    #[inline(always)]
    pub(crate) fn allowed(&self, i: usize, first: usize) -> u16 {
        match self.pairs() {
            None => u16::MAX,
            Some(pairs) => pairs.sixteen(i, first),
        }
    }

    /// The visible pairs of a chain of `m` members, by `sees` of two of them, the lower first.
    pub(crate) fn of_pairs(m: usize, mut sees: impl FnMut(usize, usize) -> bool) -> Self {
        let mut pairs = PairSet::new(m);
        for j in 0..m {
            for i in 0..j {
                if sees(i, j) {
                    pairs.insert(i, j);
                }
            }
        }
        Self { seen: Seen::Pairs(pairs) }
    }

    /// The visible pairs among some of the samples, or, where pairs are not yet computed, those of
    /// the loop of these samples.
    pub(crate) fn thinned(&self, kept: &[usize]) -> Self {
        let pairs = match &self.seen {
            Seen::Everything => return Self::everything(),
            Seen::Pairs(pairs) => pairs,
            Seen::AtEnds(polygon, _) => {
                let polygon = kept.iter().map(|&i| polygon[i]).collect();
                return Self { seen: Seen::AtEnds(polygon, OnceLock::new()) };
            }
        };
        let mut thinned = PairSet::new(kept.len());
        for (n, &i) in kept.iter().enumerate() {
            for (k, &j) in kept[..n].iter().enumerate() {
                if pairs.contains(i, j) {
                    thinned.insert(n, k);
                }
            }
        }
        Self { seen: Seen::Pairs(thinned) }
    }

    /// Whether samples `i` and `j`, which are no neighbours, may be joined.
    pub fn allows(&self, i: usize, j: usize) -> bool {
        self.pairs().is_none_or(|pairs| pairs.contains(i, j))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::predicate::{
        first_crossing, orientation, segments_touch, signed_area_doubled,
    };

    fn one_loop(polygon: &[Point2]) -> PairSet {
        inside_pairs(polygon, std::slice::from_ref(&(0..polygon.len())))
    }

    /// Visibility by its definition: the rung leaves into the inside at both ends and touches no
    /// edge except at its ends.
    fn sees(polygon: &[Point2], i: usize, j: usize) -> bool {
        let m = polygon.len();
        let leaves_inside = |i: usize, j: usize| {
            let (a, b, c) = (polygon[(i + m - 1) % m], polygon[i], polygon[(i + 1) % m]);
            let to = polygon[j];
            let (left_in, left_out) =
                (orientation(a, b, to).is_gt(), orientation(b, c, to).is_gt());
            if orientation(a, b, c).is_gt() { left_in && left_out } else { left_in || left_out }
        };
        let touched = (0..m).any(|k| {
            let l = (k + 1) % m;
            ![k, l].contains(&i)
                && ![k, l].contains(&j)
                && segments_touch(polygon[i], polygon[j], polygon[k], polygon[l])
        });
        let through = (0..m).any(|k| {
            k != i && k != j && segments_touch(polygon[i], polygon[j], polygon[k], polygon[k])
        });
        leaves_inside(i, j) && leaves_inside(j, i) && !touched && !through
    }

    fn star_shaped(m: usize, seed: u64, grid: bool) -> Vec<Point2> {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        (0..m)
            .map(|i| {
                let t = std::f64::consts::TAU * (i as f64 + 0.8 * random()) / m as f64;
                let r = 1.0 + 4.0 * random();
                let p = Point2::new(
                    r * sheetwright_geometry::math::cos(t),
                    r * sheetwright_geometry::math::sin(t),
                );
                if grid { Point2::new(p.x.round(), p.y.round()) } else { p }
            })
            .collect()
    }

    #[test]
    fn what_is_seen_is_what_the_definition_says() {
        let mut tried = 0;
        let mut more = 0;
        for seed in 0..600 {
            // Some have rows of several words.
            let m = match seed {
                0 => 128,
                200 => 130,
                _ => 4 + (seed % 14) as usize,
            };
            let polygon = star_shaped(m, seed, seed % 2 == 1);
            if first_crossing(&polygon).is_some() || signed_area_doubled(&polygon) <= 0.0 {
                continue;
            }
            tried += 1;
            let pairs = one_loop(&polygon);
            let m = polygon.len();
            let at_ends = pairs_at_ends(&polygon);
            for i in 0..m {
                for j in i + 2..m {
                    if i == 0 && j == m - 1 {
                        continue;
                    }
                    assert!(at_ends.contains(i, j) || !pairs.contains(i, j), "{seed} {i} {j}");
                    more += usize::from(at_ends.contains(i, j) && !pairs.contains(i, j));
                    assert_eq!(pairs.contains(i, j), sees(&polygon, i, j), "{seed} {i} {j}");
                }
            }
        }
        assert!(tried > 300 && more > 0, "{tried} {more}");
    }
}
