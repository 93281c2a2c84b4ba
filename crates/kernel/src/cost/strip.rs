//! Many rungs and triangles priced at once: side by side in vector registers.
//!
//! A strip is what leads from one sample to [`LANES`] samples in a row. The arithmetic is that of
//! single rungs and triangles, in the same order, so the bits are the same too.

use super::planes::{cross, dot, is_parallel, is_twisted_above, smooth};
use super::{Prices, QUANTUM, TwistForm, fold_of, quantised};

/// How many rungs stand side by side: two to four of the widest vector registers of common processors.
pub(crate) const LANES: usize = 16;

/// What the share of a normal in a sum of three N may lose to rounding.
const SLACK: f64 = 1e-12;

/// One number for each rung of a strip.
pub(crate) type Lanes = [f64; LANES];

/// The samples at the far ends of strips.
#[derive(Clone, Debug)]
pub(crate) struct FarEnds {
    /// The number of the first one.
    pub(crate) first: usize,
    /// How many there are; lanes beyond repeat the last.
    pub(crate) count: usize,
    positions: [Lanes; 3],
    tangents: [Lanes; 3],
    special_cosines_squared: Lanes,
}

impl FarEnds {
    #[inline(always)]
    fn end(&self, n: usize) -> ([f64; 3], [f64; 3], f64) {
        let at = |of: &[Lanes; 3]| [of[0][n], of[1][n], of[2][n]];
        (at(&self.positions), at(&self.tangents), self.special_cosines_squared[n])
    }
}

/// The rungs from one sample to [`FarEnds`]. Neighbours, rungs without tangent planes, and those
/// back to lower samples are priced like the rest, as whatever comes out; the caller tells them
/// apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip {
    /// The price of each rung, a multiple of [`super::QUANTUM`]; infinite without tangent planes.
    pub(crate) prices: Lanes,
    /// N of each rung by axis; zero without tangent planes. Means nothing where it was not asked for.
    pub(crate) means: [Lanes; 3],
}

impl Strip {
    /// A place to write to: nothing in it means anything yet.
    pub(crate) const BLANK: Self = Self { prices: [0.0; LANES], means: [[0.0; LANES]; 3] };
}

/// The rungs of a strip that matter; of others it may say that they have no tangent planes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    /// One bit each, the lowest for the first.
    pub(crate) lanes: u16,
    /// The dearest.
    pub(crate) limit: f64,
}

impl Prices {
    /// The samples from `first` on, at most [`LANES`].
    pub(crate) fn far_ends(&self, first: usize) -> FarEnds {
        let count = LANES.min(self.len() - first);
        let lanes = |list: &[f64]| std::array::from_fn(|n| list[first + n.min(count - 1)]);
        FarEnds {
            first,
            count,
            positions: [0, 1, 2].map(|axis| lanes(&self.positions[axis])),
            tangents: [0, 1, 2].map(|axis| lanes(&self.tangents[axis])),
            special_cosines_squared: lanes(&self.special_cosines_squared),
        }
    }

    /// Writes to `strip` the rungs from sample `i` to higher ones; without N unless `MEANS`.
    #[inline(always)]
    pub(crate) fn strip<const MEANS: bool>(
        &self,
        i: usize,
        to: &FarEnds,
        wanted: Wanted,
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
    }

    /// The same for the special ones among them; all as [`TwistForm::Printed`]. Rarely called, and a
    /// function of its own, so that it does not slow the others down.
    #[inline(never)]
    fn special_lanes(
        &self,
        i: usize,
        to: &FarEnds,
        wanted: Wanted,
        special: &[bool; LANES],
        strip: &mut Strip,
    ) {
        let (from, printed) = (self.smooth_end(i), self.options.form == TwistForm::Printed);
        for n in 0..to.count {
            let j = to.first + n;
            if !(special[n] || printed) || j <= i {
                continue;
            }
            // Most of them run along a straight stretch, or end at a corner and are dear.
            let is_lost = wanted.lanes >> n & 1 == 0
                || is_parallel(from, to.end(n))
                || !printed && self.is_corner_above(i, j, wanted.limit);
            let planes = if is_lost {
                None
            } else if special[n] {
                self.special_planes(i, j)
            } else {
                self.planes(i, j)
            };
            strip.prices[n] = planes.map_or(f64::INFINITY, |planes| self.rung(i, j, &planes));
            for axis in 0..3 {
                strip.means[axis][n] = planes.map_or(0.0, |planes| planes.mean[axis]);
            }
        }
    }

    /// Whether the rung from a corner to a smooth sample, or the other way round, certainly costs more
    /// than `limit`.
    fn is_corner_above(&self, i: usize, j: usize, limit: f64) -> bool {
        let is_above = |corner: usize, smooth: usize| {
            is_twisted_above(&self.ends[corner], self.smooth_end(smooth), limit)
        };
        let is_corner = |i: usize| self.ends[i].tangent_in != self.ends[i].tangent_out;
        match (is_corner(i), is_corner(j)) {
            (true, false) => is_above(i, j),
            (false, true) => is_above(j, i),
            _ => false,
        }
    }

    /// From sample `i` to each of the far ends.
    #[inline(always)]
    pub(crate) fn offsets(&self, i: usize, to: &FarEnds) -> [Lanes; 3] {
        let mut offsets = to.positions;
        for (lanes, from) in offsets.iter_mut().zip(&self.positions) {
            for lane in lanes {
                *lane -= from[i];
            }
        }
        offsets
    }

    /// The triangles i, k, j, for every j of the far ends, with the offsets from i to them.
    #[inline(always)]
    pub(crate) fn fan<'a>(
        &self,
        [i, k]: [usize; 2],
        offsets: &'a [Lanes; 3],
        rungs: FanRungs,
        means: FanMeans<'a>,
    ) -> Fan<'a> {
        let side = (self.ends[k].position - self.ends[i].position).to_array();
        Fan { fold: self.options.fold, side, offsets, rungs, means }
    }
}

/// Triangles that share one side.
pub(crate) struct Fan<'a> {
    fold: f64,
    /// From the first end of the side to the other.
    side: [f64; 3],
    /// From the first end to the third corners, by axis.
    offsets: &'a [Lanes; 3],
    rungs: FanRungs,
    means: FanMeans<'a>,
}

/// How many sides of triangles that share one side are rungs.
#[derive(Clone, Copy)]
pub(crate) struct FanRungs {
    /// Of all lanes but those in `fewer`.
    pub(crate) most: f64,
    /// One less for the lanes with these numbers; a number beyond is none.
    pub(crate) fewer: [usize; 2],
}

impl FanRungs {
    #[inline(always)]
    pub(crate) fn of(&self, n: usize) -> f64 {
        let less = |lane: usize| if n == lane { 1.0 } else { 0.0 };
        self.most - less(self.fewer[0]) - less(self.fewer[1])
    }
}

/// N of the sides of triangles i, k, j that share the side ⟨i,k⟩; zero for an edge of the boundary.
pub(crate) struct FanMeans<'a> {
    pub(crate) shared: [f64; 3],
    /// Of ⟨k,j⟩, by axis.
    pub(crate) beyond: &'a [Lanes; 3],
    /// Of ⟨i,j⟩, by axis.
    pub(crate) across: &'a [Lanes; 3],
}

impl Fan<'_> {
    #[inline(always)]
    fn other_side(&self, n: usize) -> [f64; 3] {
        [self.offsets[0][n], self.offsets[1][n], self.offsets[2][n]]
    }

    /// The sum of the N.
    #[inline(always)]
    fn sum(&self, n: usize) -> [f64; 3] {
        let FanMeans { shared, beyond, across } = &self.means;
        let on = |axis: usize| shared[axis] + beyond[axis][n] + across[axis][n];
        [on(0), on(1), on(2)]
    }

    /// The price of each, as [`Prices::triangle`] has it; on loops whose members are numbered in
    /// order.
    #[inline(always)]
    pub(crate) fn prices(&self) -> Lanes {
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            prices[n] =
                fold_of(self.fold, self.side, self.other_side(n), self.rungs.of(n), self.sum(n));
        }
        prices
    }

    /// Whether some of them may cost less than `limits`; not, only if none does.
    ///
    /// With a the area vector and s the sum of the N, that is ν a · s > c |a| for
    /// c = ν rungs − limit, which takes no root and no quotient.
    #[inline(always)]
    pub(crate) fn may_be_below(&self, limits: &Lanes) -> bool {
        let slack = SLACK * self.fold + QUANTUM;
        let mut any = false;
        for n in 0..LANES {
            let area_vector = cross(self.side, self.other_side(n));
            let along = self.fold * dot(area_vector, self.sum(n));
            let least = self.fold * self.rungs.of(n) - limits[n] - slack;
            let too_short = along * along < least * least * dot(area_vector, area_vector);
            // `!` of what is certain: squares that leave the range of numbers decide nothing.
            any |= (least <= 0.0) | !((along <= 0.0) | too_short);
        }
        any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::{Boundary, samples_from_points};
    use crate::cost::PriceOptions;
    use crate::curve::CurvePoint;
    use crate::math::{Point3, sin};

    /// A quadrangle with two straight sides and two bent ones, so many samples each.
    fn bent(n: usize, corners: [[f64; 2]; 4]) -> Prices {
        let sides = (0..4 * n).map(|at| {
            let (side, t) = (at / n, (at % n) as f64 / n as f64);
            let (from, to) = (corners[side], corners[(side + 1) % 4]);
            let [x, y] = [0, 1].map(|axis| (1.0 - t) * from[axis] + t * to[axis]);
            let at = Point3::new(x, y, 0.3 * sin(3.0 * x));
            CurvePoint { corner: t == 0.0, ..CurvePoint::smooth(at) }
        });
        let samples = samples_from_points(&sides.collect::<Vec<_>>());
        let boundary = Boundary::new(vec![samples]).unwrap();
        Prices::new(&boundary, None, PriceOptions::default())
    }

    #[test]
    fn rungs_of_corners_that_are_called_dear_are() {
        // Corners that are right, acute, reflex and nearly straight.
        for (corners, least) in [
            ([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 60),
            ([[0.0, 0.0], [1.0, 0.3], [2.0, 1.0], [0.4, 0.6]], 60),
            ([[0.0, 0.0], [2.0, 0.0], [0.5, 0.4], [0.3, 2.0]], 60),
            ([[0.0, 0.0], [1.0, -1e-5], [2.0, 0.0], [1.0, 1.0]], 60),
        ] {
            let prices = bent(20, corners);
            let mut found = 0;
            for j in 2..prices.len() {
                for i in (0..j - 1).filter(|&i| !prices.neighbours(i, j)) {
                    let Some(planes) = prices.planes(i, j) else { continue };
                    let price = prices.rung(i, j, &planes);
                    for limit in [price, price + QUANTUM, 2.0 * price] {
                        assert!(!prices.is_corner_above(i, j, limit), "{i} {j}: {price} {limit}");
                    }
                    found += usize::from(prices.is_corner_above(i, j, price - 1e-6));
                }
            }
            assert!(found > least, "{corners:?}: {found}");
        }
    }

    #[test]
    fn strips_are_what_single_rungs_are() {
        let n = 20;
        let prices = bent(n, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let mut without = 0;
        let all = Wanted { lanes: u16::MAX, limit: f64::INFINITY };
        for i in 0..prices.len() {
            for first in (0..prices.len()).step_by(LANES) {
                let mut strip = Strip::BLANK;
                prices.strip::<true>(i, &prices.far_ends(first), all, &mut strip);
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
                }
            }
        }
        assert!(without > n * n / 2, "{without}");
    }
}
