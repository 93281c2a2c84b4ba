//! Many rungs and triangles priced at once: side by side in vector registers.
//!
//! A strip is the rungs from one sample to [`LANES`] samples in a row. The arithmetic of prices is
//! that of single rungs and triangles, in the same order, so the bits are the same too. Tests that
//! leave out rungs or triangles use other arithmetic, with a margin for rounding.

use super::planes::{is_parallel, smooth};
use super::{Prices, TwistForm, fold_of, quantised};
use std::ops::{Deref, DerefMut};

/// How many rungs stand side by side: two to four of the widest vector registers of common
/// processors.
pub(crate) const LANES: usize = 16;

/// One number for each rung of a strip.
pub(crate) type Lanes = [f64; LANES];

/// A value aligned to the lines of the processor's cache, so that no register is filled from two.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Aligned<T>(pub(crate) T);

impl<T> Deref for Aligned<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T> DerefMut for Aligned<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut T {
        &mut self.0
    }
}

/// The samples at the far ends of strips.
#[derive(Clone, Debug)]
pub(crate) struct FarEnds {
    /// The number of the first one.
    pub(crate) first: usize,
    /// How many there are; lanes beyond repeat the last.
    pub(crate) count: usize,
    positions: Aligned<[Lanes; 3]>,
    tangents: Aligned<[Lanes; 3]>,
    special_cosines_squared: Aligned<Lanes>,
}

impl FarEnds {
    #[inline(always)]
    pub(super) fn end(&self, n: usize) -> ([f64; 3], [f64; 3], f64) {
        let at = |of: &[Lanes; 3]| [of[0][n], of[1][n], of[2][n]];
        (at(&self.positions), at(&self.tangents), self.special_cosines_squared[n])
    }
}

/// The rungs from one sample to [`FarEnds`]. Neighbours, rungs without tangent planes, and those
/// back to lower samples get arbitrary prices; the caller tells them apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip {
    /// The price of each rung, a multiple of [`super::QUANTUM`]; infinite without tangent planes.
    pub(crate) prices: Aligned<Lanes>,
    /// N of each rung by axis; zero without tangent planes. Undefined in strips without `MEANS`.
    pub(crate) means: Aligned<[Lanes; 3]>,
}

impl Strip {
    /// Undefined values, to be written.
    pub(crate) const BLANK: Self =
        Self { prices: Aligned([0.0; LANES]), means: Aligned([[0.0; LANES]; 3]) };
}

impl Prices {
    /// The samples from `first` on, at most [`LANES`].
    pub(crate) fn far_ends(&self, first: usize) -> FarEnds {
        let count = LANES.min(self.len() - first);
        let lanes = |list: &[f64]| std::array::from_fn(|n| list[first + n.min(count - 1)]);
        FarEnds {
            first,
            count,
            positions: Aligned([0, 1, 2].map(|axis| lanes(&self.positions[axis]))),
            tangents: Aligned([0, 1, 2].map(|axis| lanes(&self.tangents[axis]))),
            special_cosines_squared: Aligned(lanes(&self.special_cosines_squared)),
        }
    }

    /// Writes to `strip` the rungs from sample `i` to higher ones; without N unless `MEANS`. Of
    /// those without a bit in `wanted`, the lowest for the first, it may say that they have no
    /// tangent planes.
    #[inline(always)]
    pub(crate) fn strip<const MEANS: bool>(
        &self,
        i: usize,
        to: &FarEnds,
        wanted: u16,
        strip: &mut Strip,
    ) {
        let from = self.smooth_end(i);
        let mut special = [false; LANES];
        for n in 0..LANES {
            let rung = smooth(from, to.end(n));
            strip.prices[n] = quantised(rung.twist);
            if MEANS {
                for axis in 0..3 {
                    strip.means[axis][n] = rung.mean[axis];
                }
            }
            special[n] = rung.is_special;
        }
        if special != [false; LANES] || self.options.form == TwistForm::Printed {
            self.special_lanes(i, to, wanted, &special, strip);
        }
        if self.hints.is_some() {
            self.add_hints(i, to, &special, strip);
        }
    }

    /// Adds to `strip` the price of hints; special rungs, all as [`TwistForm::Printed`], have it
    /// already. A function of its own, so that it does not slow down the many boundaries without
    /// hints.
    #[inline(never)]
    fn add_hints(&self, i: usize, to: &FarEnds, special: &[bool; LANES], strip: &mut Strip) {
        if self.options.form == TwistForm::Printed {
            return;
        }
        for n in (0..to.count).filter(|&n| !special[n] && to.first + n > i) {
            strip.prices[n] += self.of_hints(i, to.first + n);
        }
    }

    /// Writes to `strip` those of the rungs from sample `i` that are special; all as
    /// [`TwistForm::Printed`]. Rarely called, and a function of its own, so that it does not slow
    /// the others down.
    #[inline(never)]
    fn special_lanes(
        &self,
        i: usize,
        to: &FarEnds,
        wanted: u16,
        special: &[bool; LANES],
        strip: &mut Strip,
    ) {
        let printed = self.options.form == TwistForm::Printed;
        for n in 0..to.count {
            let j = to.first + n;
            if !(special[n] || printed) || j <= i {
                continue;
            }
            // Most of them run along a straight stretch.
            let is_lost = wanted >> n & 1 == 0 || is_parallel(self.smooth_end(i), to.end(n));
            let planes = match special[n] {
                _ if is_lost => None,
                true => self.special_planes(i, j),
                false => self.planes(i, j),
            };
            strip.prices[n] = planes.map_or(f64::INFINITY, |planes| self.rung(i, j, &planes));
            for axis in 0..3 {
                strip.means[axis][n] = planes.map_or(0.0, |planes| planes.mean[axis]);
            }
        }
    }

    /// From sample `i` to each of the far ends.
    #[inline(always)]
    pub(crate) fn offsets(&self, i: usize, to: &FarEnds) -> Aligned<[Lanes; 3]> {
        let mut offsets = to.positions;
        for (lanes, from) in offsets.iter_mut().zip(&self.positions) {
            for lane in lanes {
                *lane -= from[i];
            }
        }
        offsets
    }

    /// From sample `i` to another.
    #[inline(always)]
    pub(crate) fn offset(&self, i: usize, k: usize) -> [f64; 3] {
        let [x, y, z] = &self.positions;
        [x[k] - x[i], y[k] - y[i], z[k] - z[i]]
    }

    /// The prices of the triangles of a fan, as [`Prices::triangle`] has them; on loops whose
    /// members are numbered in order.
    #[inline(always)]
    pub(crate) fn fan(&self, fan: &Fan<'_>) -> Lanes {
        let Fan { corners: [i, k], to, offsets, means: (shared, beyond, across) } = *fan;
        let side = self.offset(i, k);
        // How many sides are rungs: any of them may be an edge of the boundary.
        let last = if i == 0 { self.len() - 1 } else { usize::MAX };
        let edges = [k + 1, last].map(|j| j.wrapping_sub(to.first));
        let most = if k == i + 1 { 2.0 } else { 3.0 };
        let less = |is_edge: bool| if is_edge { 1.0 } else { 0.0 };
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            let rungs = most - less(n == edges[0]) - less(n == edges[1]);
            let on = |axis: usize| shared[axis] + beyond[axis][n] + across[axis][n];
            let other_side = [offsets[0][n], offsets[1][n], offsets[2][n]];
            prices[n] = fold_of(self.options.fold, side, other_side, rungs, [on(0), on(1), on(2)]);
        }
        prices
    }
}

/// A fan: the triangles i, k, j of two samples i < k and all far ends j.
#[derive(Clone, Copy)]
pub(crate) struct Fan<'a> {
    /// i and k.
    pub(crate) corners: [usize; 2],
    /// The j.
    pub(crate) to: &'a FarEnds,
    /// From i to the j, by axis.
    pub(crate) offsets: &'a [Lanes; 3],
    /// N of ⟨i,k⟩, of the ⟨k,j⟩ and of the ⟨i,j⟩, by axis; zero for an edge of the boundary.
    pub(crate) means: ([f64; 3], &'a [Lanes; 3], &'a [Lanes; 3]),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::PriceOptions;
    use crate::test_boundaries::{bent_square, nearly_straight, waving};
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, Vec3, cos, sin};

    fn priced(boundary: Boundary) -> Prices {
        Prices::new(&boundary, None, PriceOptions::default())
    }

    #[test]
    fn fans_are_what_single_triangles_are() {
        let slivers = [nearly_straight(1e-5), nearly_straight(1e-6)];
        for boundary in [waving(400, 0.3), bent_square(100)].into_iter().chain(slivers) {
            let prices = priced(boundary);
            let m = prices.len();
            let mean = |i: usize, j: usize| {
                let planes = prices.planes(i, j).filter(|_| !prices.neighbours(i, j));
                planes.map_or(Vec3::ZERO, |planes| planes.mean)
            };
            let lanes = |from: usize, first: usize| {
                let means: [_; LANES] = std::array::from_fn(|n| mean(from, first + n).to_array());
                [0, 1, 2].map(|axis| means.map(|mean| mean[axis]))
            };
            for i in (0..300).step_by(37) {
                for k in (i + 1..340).step_by(11) {
                    for first in (k + 1..m - LANES).step_by(48).chain([k + 1, m - LANES]) {
                        let to = prices.far_ends(first);
                        let (across, beyond) = (lanes(i, first), lanes(k, first));
                        let offsets = prices.offsets(i, &to);
                        let means = (mean(i, k).to_array(), &beyond, &across);
                        let fan = Fan { corners: [i, k], to: &to, offsets: &offsets, means };
                        let costs = prices.fan(&fan);
                        for (n, j) in (first..first + LANES).enumerate().filter(|(_, j)| *j > k) {
                            let means = [mean(i, k), mean(k, j), mean(i, j)];
                            assert_eq!(costs[n], prices.triangle([i, k, j], means), "{i} {k} {j}");
                        }
                    }
                }
            }
        }
    }

    /// A loop whose samples stand to either side of a line in turn, so that the sign of many
    /// normals is open.
    fn zigzag(off: f64) -> Boundary {
        let points = (0..120).map(|n| {
            let t = std::f64::consts::TAU * f64::from(n) / 120.0;
            let r = 1.0 + if n % 2 == 0 { off } else { -off };
            CurvePoint::smooth(Point3::new(r * cos(t), 0.4 * r * sin(t), 0.2 * sin(2.0 * t)))
        });
        let samples = samples_from_points(&points.collect::<Vec<_>>());
        Boundary::new(vec![samples]).unwrap()
    }

    #[test]
    fn strips_are_what_single_rungs_are() {
        for (boundary, least_without, least_open) in [
            (bent_square(20), 200, 20),
            (nearly_straight(1e-7), 0, 400),
            (zigzag(0.01), 0, 1000),
            (zigzag(0.002), 0, 200),
        ] {
            let prices = priced(boundary);
            let (mut without, mut open) = (0, 0);
            for i in 0..prices.len() {
                for first in (0..prices.len()).step_by(LANES) {
                    let mut strip = Strip::BLANK;
                    let to = prices.far_ends(first);
                    prices.strip::<true>(i, &to, u16::MAX, &mut strip);
                    for (n, j) in (first..prices.len().min(first + LANES)).enumerate() {
                        if j <= i + 1 || prices.neighbours(i, j) {
                            continue;
                        }
                        let planes = prices.planes(i, j);
                        let price = planes.map_or(f64::INFINITY, |p| prices.rung(i, j, &p));
                        let mean = planes.map_or([0.0; 3], |p| [p.mean.x, p.mean.y, p.mean.z]);
                        assert_eq!(strip.prices[n], price, "{i} {j}");
                        assert_eq!(strip.means.map(|mean| mean[n]), mean, "{i} {j}");
                        without += usize::from(planes.is_none());
                        let is_special = smooth(prices.smooth_end(i), to.end(n)).is_special;
                        open += usize::from(is_special && planes.is_some());
                    }
                }
            }
            assert!(without >= least_without && open >= least_open, "{without} {open}");
        }
    }
}
