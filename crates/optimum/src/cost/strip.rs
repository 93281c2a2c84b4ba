//! Many rungs and triangles priced at once: side by side in vector registers.
//!
//! A strip is the rungs from one sample to [`LANES`] samples in a row. The arithmetic of prices is
//! that of single rungs and triangles, in the same order, so the bits are the same too. Tests that
//! leave out rungs or triangles use other arithmetic, with a margin for rounding.

use super::planes::{cross, dot, smooth};
use super::{Prices, QUANTUM, TwistForm, fold_of, quantised};
use std::ops::{Deref, DerefMut};

/// How many rungs stand side by side: two to four of the widest vector registers of common
/// processors.
pub(crate) const LANES: usize = 16;

/// Rounding error of the share of a normal in a sum of three N, at most.
const SLACK: f64 = 1e-12;

/// The least height above a side's tangent plane that counts, as a share of the distance from the
/// end of the side. From there on, rounding turns the normal of the triangle by less than a
/// thousandth of its angle to N, and [`SHARE_OF_SQUARE`] leaves more than that.
const LEAST_SLOPE: f64 = 1e-6;
/// The factor of the square of that angle, a little below one half.
const SHARE_OF_SQUARE: f64 = 0.49;
/// (a + b)² ≤ (1 + 1/16) a² + 17 b².
const OF_SQUARES: [f64; 2] = [17.0 / 16.0, 17.0];

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

/// The rungs of a strip that are wanted; others may be given as without tangent planes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    /// One bit each, the lowest for the first.
    pub(crate) lanes: u16,
    /// The largest price that is wanted.
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
            positions: Aligned([0, 1, 2].map(|axis| lanes(&self.positions[axis]))),
            tangents: Aligned([0, 1, 2].map(|axis| lanes(&self.tangents[axis]))),
            special_cosines_squared: Aligned(lanes(&self.special_cosines_squared)),
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

    /// From sample `i` to the [`LANES`] samples from `first` on; `None` if there are fewer.
    #[inline(always)]
    pub(crate) fn offsets_to_run(&self, i: usize, first: usize) -> Option<Aligned<[Lanes; 3]>> {
        let mut offsets = Aligned([[0.0; LANES]; 3]);
        for (lanes, all) in offsets.iter_mut().zip(&self.positions) {
            let run: &Lanes = all.get(first..)?.first_chunk()?;
            for n in 0..LANES {
                lanes[n] = run[n] - all[i];
            }
        }
        Some(offsets)
    }

    /// From sample `i` to another.
    #[inline(always)]
    pub(crate) fn offset(&self, i: usize, k: usize) -> [f64; 3] {
        let [x, y, z] = &self.positions;
        [x[k] - x[i], y[k] - y[i], z[k] - z[i]]
    }

    /// The triangles from sample i to the far ends, with the offsets from it to them and the N of
    /// the sides to them.
    #[inline(always)]
    pub(crate) fn fans<'a>(&self, offsets: &'a [Lanes; 3], across: &'a [Lanes; 3]) -> Fans<'a> {
        let fold = self.options.fold;
        Fans { fold, weight: 1.0 / fold, offsets, across }
    }

    /// Which of the sides ⟨i,k⟩ may belong to a triangle i, k, j whose price lies below the
    /// `limits` of its k, for some j of a run: a bit for each k, 0 only if no triangle does.
    /// `offsets` lead from i to the k, `means` are the N of the sides.
    ///
    /// The normal n of the triangle is perpendicular to u = P_k − P_i and to v = P_j − P_i, and so
    /// to the height h = v − λ u with λ = u · v / |u|². Hence
    /// |h · N| = |h · (N − n)| ≤ |h| |N − n|, and the share of this side in F is
    /// ν (1 − n · N) = ½ ν |N − n|² ≥ ½ ν (h · N)² / |h|², as N is a unit vector, or zero for a
    /// side without, which is never left out. The other sides' shares are 0 or more.
    ///
    /// At a sample of the run, h differs from its value on the segment by b = `bow` or less. On
    /// the segment h is linear, and where h · N does not change its sign,
    /// |h · N| − κ √(17/16 |h|² + 17 b²) is concave for every κ ≥ 0: if it is above b at both ends,
    /// it is so between them. The root is |h| + b or more.
    #[inline(always)]
    pub(crate) fn sides_below<const FUSED: bool>(
        &self,
        i: usize,
        offsets: &[Lanes; 3],
        means: &[Lanes; 3],
        run: &Segment,
        limits: &Lanes,
    ) -> u32 {
        let fold = self.options.fold;
        let [x, y, z] = self.smooth_end(i).0;
        let to_ends = run.ends.map(|end| [end[0] - x, end[1] - y, end[2] - z]);
        let squares = to_ends.map(|v| dot(v, v));
        let off = run.bow + LEAST_SLOPE * squares[0].max(squares[1]).sqrt();
        let slack = SLACK * fold + QUANTUM;
        let mut below = 0;
        for n in 0..LANES {
            let u = [offsets[0][n], offsets[1][n], offsets[2][n]];
            let mean = [means[0][n], means[1][n], means[2][n]];
            let (square, slant) = (fused_dot::<FUSED>(u, u), fused_dot::<FUSED>(u, mean));
            let along = [fused_dot::<FUSED>(to_ends[0], u), fused_dot::<FUSED>(to_ends[1], u)];
            // Both times |u|², as squares of heights are below.
            let limit = (limits[n] + slack) * square;
            let bow = OF_SQUARES[1] * run.bow * run.bow * square;
            let mut is_above = true;
            let mut slopes = [0.0; 2];
            for end in 0..2 {
                // h · N and |h|², times |u|².
                let slope = fused_dot::<FUSED>(to_ends[end], mean) * square - along[end] * slant;
                let height = squares[end] * square - along[end] * along[end];
                let least = slope.abs() - off * square;
                is_above &= (least > 0.0)
                    & (SHARE_OF_SQUARE * fold * least * least
                        > limit * (OF_SQUARES[0] * height + bow));
                slopes[end] = slope;
            }
            is_above &= slopes[0] * slopes[1] > 0.0;
            below |= u32::from(!is_above) << n;
        }
        below
    }
}

/// a b + c, rounded once where `FUSED`; slow on processors without such an instruction.
#[expect(
    clippy::disallowed_methods,
    reason = "says only what need not be worked out, with a margin"
)]
#[inline(always)]
fn fused<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

#[inline(always)]
fn fused_dot<const FUSED: bool>(a: [f64; 3], b: [f64; 3]) -> f64 {
    fused::<FUSED>(a[0], b[0], fused::<FUSED>(a[1], b[1], a[2] * b[2]))
}

/// Where the samples of a run lie: within `bow` of the segment between two points, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) ends: [[f64; 3]; 2],
    pub(crate) bow: f64,
}

/// Triangles one side of which is an edge of the boundary, on loops whose members are numbered in
/// order.
pub(crate) struct OnEdges<'a> {
    /// From the lowest corner of each to the two others, by axis.
    pub(crate) offsets: [&'a [Lanes; 3]; 2],
    /// N of its two other sides, by axis; zero for an edge.
    pub(crate) means: [&'a [Lanes; 3]; 2],
    /// How many of them are rungs.
    pub(crate) rungs: Lanes,
}

impl OnEdges<'_> {
    #[inline(always)]
    fn side(&self, side: usize, n: usize) -> [f64; 3] {
        let [x, y, z] = self.offsets[side];
        [x[n], y[n], z[n]]
    }

    #[inline(always)]
    fn sum(&self, n: usize) -> [f64; 3] {
        let on = |axis: usize| self.means[0][axis][n] + self.means[1][axis][n];
        [on(0), on(1), on(2)]
    }

    /// A lower bound on the price of each with the weight `fold`, close to it where folds are
    /// slight.
    ///
    /// With c = n · s for the normal n and the sum s of the N, and r rungs, x = r² − c² gives it
    /// without a root: r − c = x / (r + c), and c ≤ r − x / 2r, so that
    /// r − c ≥ x / 2r (1 + x / 4r²). Prices are rounded to the quantum.
    #[inline(always)]
    pub(crate) fn least_prices(&self, fold: f64) -> Lanes {
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            let area_vector = cross(self.side(0, n), self.side(1, n));
            let (square, along) = (dot(area_vector, area_vector), dot(area_vector, self.sum(n)));
            // Without area c is −r; where c is negative, r − c exceeds the bound for c = 0.
            let cosine_squared = if along > 0.0 { along * along / square } else { 0.0 };
            // ½ r⁻¹ and ¼ r⁻².
            let [half, quarter] = if self.rungs[n] > 1.5 { [0.25, 0.0625] } else { [0.5, 0.25] };
            let x = self.rungs[n] * self.rungs[n] - cosine_squared;
            // The bound is 0 where squares leave the range of numbers.
            let x = if x > 0.0 { x } else { 0.0 };
            let price = fold * (x * half) * (1.0 + x * quarter) - QUANTUM;
            prices[n] = if price > 0.0 { price } else { 0.0 };
        }
        prices
    }
}

/// Triangles i, k, j of one i and all far ends j: a fan for each k.
pub(crate) struct Fans<'a> {
    /// ν, and its reciprocal.
    fold: f64,
    weight: f64,
    /// From sample i to the far ends, by axis.
    offsets: &'a [Lanes; 3],
    /// N of ⟨i,j⟩, by axis.
    across: &'a [Lanes; 3],
}

/// A fan: the triangles i, k, j that share the side ⟨i,k⟩. N is zero for an edge of the boundary.
pub(crate) struct Fan<'a> {
    /// From sample i to sample k.
    pub(crate) side: [f64; 3],
    /// N of ⟨i,k⟩.
    pub(crate) shared: [f64; 3],
    /// N of ⟨k,j⟩, by axis.
    pub(crate) beyond: &'a [Lanes; 3],
}

/// How many sides of the triangles of a fan are rungs.
#[derive(Clone, Copy)]
pub(crate) struct FanRungs {
    /// Of all lanes but those in `fewer`.
    pub(crate) most: f64,
    /// One less for the lanes with these numbers; a number beyond the lanes stands for none.
    pub(crate) fewer: [usize; 2],
}

impl FanRungs {
    #[inline(always)]
    pub(crate) fn of(&self, n: usize) -> f64 {
        let less = |lane: usize| if n == lane { 1.0 } else { 0.0 };
        self.most - less(self.fewer[0]) - less(self.fewer[1])
    }

    /// The least of all lanes.
    #[inline(always)]
    pub(crate) fn least(&self) -> f64 {
        let less = |lane: usize| if lane < LANES { 1.0 } else { 0.0 };
        self.most - less(self.fewer[0]) - less(self.fewer[1])
    }
}

impl Fans<'_> {
    #[inline(always)]
    fn other_side(&self, n: usize) -> [f64; 3] {
        [self.offsets[0][n], self.offsets[1][n], self.offsets[2][n]]
    }

    /// The sum of the N.
    #[inline(always)]
    fn sum(&self, fan: &Fan<'_>, n: usize) -> [f64; 3] {
        let on = |axis: usize| fan.shared[axis] + fan.beyond[axis][n] + self.across[axis][n];
        [on(0), on(1), on(2)]
    }

    /// The price of each, as [`Prices::triangle`] has it; on loops whose members are numbered in
    /// order.
    #[inline(always)]
    pub(crate) fn prices(&self, fan: &Fan<'_>, rungs: FanRungs) -> Lanes {
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            let sum = self.sum(fan, n);
            prices[n] = fold_of(self.fold, fan.side, self.other_side(n), rungs.of(n), sum);
        }
        prices
    }

    /// The prices of the triangles i, j − 1, j on edges of the boundary, with so many rungs, as
    /// [`Prices::triangle`] has them. `before` is where the sample before the first j lies, and N
    /// of its rung.
    #[inline(always)]
    pub(crate) fn on_edges(&self, before: [[f64; 3]; 2], rungs: FanRungs) -> Lanes {
        let one_before = |of: &[Lanes; 3], before: [f64; 3]| {
            let mut moved = [[0.0; LANES]; 3];
            for axis in 0..3 {
                moved[axis][0] = before[axis];
                for n in 1..LANES {
                    moved[axis][n] = of[axis][n - 1];
                }
            }
            moved
        };
        let sides = one_before(self.offsets, before[0]);
        let means = one_before(self.across, before[1]);
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            let side = [sides[0][n], sides[1][n], sides[2][n]];
            let on = |axis: usize| means[axis][n] + self.across[axis][n];
            let sum = [on(0), on(1), on(2)];
            prices[n] = fold_of(self.fold, side, self.other_side(n), rungs.of(n), sum);
        }
        prices
    }

    /// Whether some of them may cost less than their limit, with so many rungs or more; false only
    /// if none does. Limits of 0 or less admit none.
    ///
    /// With a the area vector and s the sum of the N, that is a · s > c |a| for
    /// c = rungs − limit / ν, which takes no root and no quotient.
    #[inline(always)]
    pub(crate) fn may_be_below<const FUSED: bool>(
        &self,
        fan: &Fan<'_>,
        rungs: f64,
        limits: &Lanes,
    ) -> bool {
        let rungs = rungs - (SLACK + QUANTUM * self.weight);
        let mut any = false;
        for n in 0..LANES {
            // Not fused: the normal of a sliver turns with the rounding of it, in the price too.
            let area_vector = cross(fan.side, self.other_side(n));
            let along = fused_dot::<FUSED>(area_vector, self.sum(fan, n));
            let least = rungs - limits[n] * self.weight;
            // Squares that keep the sign of their root.
            let is_too_short = along * along.abs()
                < least * least.abs() * fused_dot::<FUSED>(area_vector, area_vector);
            // `!` of what is certain: squares that leave the range of numbers decide nothing.
            any |= (limits[n] > 0.0) & !is_too_short;
        }
        any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::PriceOptions;
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, Vec3, cos, sin};
    use std::ops::Range;

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

    /// A smooth loop that is far from developable where `height` is large.
    fn waving(n: usize, height: f64) -> Prices {
        let points = (0..n).map(|at| {
            let t = std::f64::consts::TAU * at as f64 / n as f64;
            CurvePoint::smooth(Point3::new(cos(t), sin(t), height * sin(3.0 * t)))
        });
        let samples = samples_from_points(&points.collect::<Vec<_>>());
        let boundary = Boundary::new(vec![samples]).unwrap();
        Prices::new(&boundary, None, PriceOptions::default())
    }

    /// A loop with a side along which triangles are slivers, whose normals rounding turns.
    fn nearly_straight(bend: f64) -> Prices {
        let side = (0..=400).map(|n| {
            let x = f64::from(n) / 400.0;
            Point3::new(0.8 * x, 0.6 * x + bend * x * x, 3.0 * bend * x * x * x)
        });
        let points = side.chain([Point3::new(1.0, 2.0, 0.0), Point3::new(0.0, 2.0, 0.0)]);
        let samples = samples_from_points(&points.map(CurvePoint::smooth).collect::<Vec<_>>());
        Prices::new(&Boundary::new(vec![samples]).unwrap(), None, PriceOptions::default())
    }

    /// The segment from the first to the last of a run of samples, and how far from it others are.
    fn segment(prices: &Prices, run: Range<usize>) -> Segment {
        let at = |i: usize| prices.ends[i].position;
        let (start, end) = (at(run.start), at(run.end - 1));
        let off = |i: usize| {
            let along = (at(i) - start).dot(end - start) / (end - start).length_squared();
            (at(i) - start - (end - start) * along.clamp(0.0, 1.0)).length()
        };
        Segment { ends: [start.to_array(), end.to_array()], bow: run.map(off).fold(0.0, f64::max) }
    }

    #[test]
    fn sides_that_are_left_out_have_no_triangle_below_their_limit() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let reflex = [[0.0, 0.0], [2.0, 0.0], [0.5, 0.4], [0.3, 2.0]];
        for (prices, least) in [
            (waving(160, 0.1), 0.2),
            (waving(160, 1.0), 0.1),
            (waving(640, 0.3), 0.4),
            (bent(40, square), 0.15),
            (bent(40, reflex), 0.04),
            (nearly_straight(1e-3), 0.0),
            (nearly_straight(1e-5), -1.0),
        ] {
            let m = prices.len();
            let mean = |i: usize, j: usize| {
                if prices.neighbours(i, j) {
                    return Vec3::ZERO;
                }
                prices.planes(i, j).map_or(Vec3::ZERO, |planes| planes.mean)
            };
            let (mut left_out, mut all) = (0, 0);
            for i in (0..m - 2 * LANES).step_by(7) {
                for first in (i.next_multiple_of(LANES)..m - 2 * LANES + 1).step_by(3 * LANES) {
                    let offsets = prices.offsets_to_run(i, first).unwrap();
                    let mut means = [[0.0; LANES]; 3];
                    for n in 0..LANES {
                        let mean = mean(i, first + n).to_array();
                        (0..3).for_each(|axis| means[axis][n] = mean[axis]);
                    }
                    for start in (first + LANES..m - LANES + 1).step_by(2 * LANES) {
                        let run = start..start + LANES;
                        let segment = segment(&prices, run.clone());
                        let cheapest = std::array::from_fn(|n| {
                            let k = first + n;
                            let price = |j: usize| {
                                prices.triangle([i, k, j], [mean(i, k), mean(k, j), mean(i, j)])
                            };
                            run.clone().map(price).fold(f64::INFINITY, f64::min)
                        });
                        let below = |limits: &Lanes| {
                            [
                                prices.sides_below::<false>(i, &offsets, &means, &segment, limits),
                                prices.sides_below::<true>(i, &offsets, &means, &segment, limits),
                            ]
                        };
                        let above = cheapest.map(|price| price + QUANTUM);
                        assert_eq!(below(&above), [0xffff; 2], "{i} {first} {start}");
                        let far_below = cheapest.map(|price| 0.2 * price);
                        left_out += LANES as u32 - below(&far_below)[1].count_ones();
                        all += LANES as u32;
                    }
                }
            }
            let share = f64::from(left_out) / f64::from(all);
            assert!(share > least, "{share}");
        }
    }

    #[test]
    fn no_triangle_on_an_edge_costs_less_than_is_said() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let (mut hardly_less, mut all) = (0, 0);
        for (mut prices, fold) in [0.1, 1.0, 10.0].into_iter().flat_map(|fold| {
            let loops = [bent(100, square), waving(400, 0.3), waving(400, 0.0)];
            let slivers = [nearly_straight(1e-5), nearly_straight(1e-6)];
            loops.into_iter().chain(slivers).map(move |prices| (prices, fold))
        }) {
            prices.options.fold = fold;
            let mean = |i: usize, j: usize| {
                let planes = prices.planes(i, j).filter(|_| !prices.neighbours(i, j));
                planes.map_or(Vec3::ZERO, |planes| planes.mean)
            };
            for (i, first) in (0..300).flat_map(|i| (i + 2..384).step_by(7).map(move |j| (i, j))) {
                let means = [i + 1, i].map(|from| {
                    let means: [_; LANES] = std::array::from_fn(|n| mean(from, first + n));
                    [0, 1, 2].map(|axis| means.map(|mean| mean[axis]))
                });
                let rungs_to = |j: usize| {
                    [i, i + 1].iter().map(|&from| f64::from(!prices.neighbours(from, j))).sum()
                };
                let triangles = OnEdges {
                    offsets: [
                        &prices.offset(i, i + 1).map(|x| [x; LANES]),
                        &prices.offsets_to_run(i, first).unwrap(),
                    ],
                    means: [&means[0], &means[1]],
                    rungs: std::array::from_fn(|n| rungs_to(first + n)),
                };
                let least = triangles.least_prices(fold);
                for n in 0..LANES {
                    let j = first + n;
                    let means = [Vec3::ZERO, mean(i + 1, j), mean(i, j)];
                    let price = prices.triangle([i, i + 1, j], means);
                    assert!(least[n] <= price, "{fold}, {i} {j}: {} {price}", least[n]);
                    hardly_less += usize::from(least[n] >= 0.99 * price - 2.0 * QUANTUM);
                    all += 1;
                }
            }
        }
        assert!(hardly_less > all / 2, "{hardly_less} of {all}");
    }

    #[test]
    fn no_triangle_below_its_limit_is_left_out() {
        for prices in [waving(400, 0.3), nearly_straight(1e-5), nearly_straight(1e-6)] {
            let mean = |i: usize, j: usize| {
                let planes = prices.planes(i, j).filter(|_| !prices.neighbours(i, j));
                planes.map_or([0.0; 3], |planes| planes.mean.to_array())
            };
            let lanes = |from: usize, first: usize| {
                let means: [_; LANES] = std::array::from_fn(|n| mean(from, first + n));
                [0, 1, 2].map(|axis| means.map(|mean| mean[axis]))
            };
            let (mut left_out, mut all) = (0, 0);
            for i in (0..300).step_by(37) {
                for k in (i + 1..340).step_by(11) {
                    for first in (k + 1..380).step_by(48) {
                        let offsets = prices.offsets_to_run(i, first).unwrap();
                        let (across, beyond) = (lanes(i, first), lanes(k, first));
                        let fans = prices.fans(&offsets, &across);
                        let side = prices.offset(i, k);
                        let fan = Fan { side, shared: mean(i, k), beyond: &beyond };
                        let last = if i == 0 { prices.len() - 1 } else { usize::MAX };
                        let rungs = FanRungs {
                            most: if k == i + 1 { 2.0 } else { 3.0 },
                            fewer: [(k + 1).wrapping_sub(first), last.wrapping_sub(first)],
                        };
                        let costs = fans.prices(&fan, rungs);
                        for n in 0..LANES {
                            let below = |limit: f64| {
                                let mut limits = [0.0; LANES];
                                limits[n] = limit;
                                [
                                    fans.may_be_below::<false>(&fan, rungs.least(), &limits),
                                    fans.may_be_below::<true>(&fan, rungs.least(), &limits),
                                ]
                            };
                            assert_eq!(below(costs[n] + QUANTUM), [true; 2], "{i} {k} {first} {n}");
                            left_out += usize::from(below(0.9 * costs[n]) == [false; 2]);
                            all += 1;
                        }
                    }
                }
            }
            assert!(left_out > all / 2, "{left_out} of {all}");
        }
    }

    /// A loop whose samples stand to either side of a line in turn, so that the sign of many
    /// normals is open.
    fn zigzag(off: f64) -> Prices {
        let points = (0..120).map(|n| {
            let t = std::f64::consts::TAU * f64::from(n) / 120.0;
            let r = 1.0 + if n % 2 == 0 { off } else { -off };
            CurvePoint::smooth(Point3::new(r * cos(t), 0.4 * r * sin(t), 0.2 * sin(2.0 * t)))
        });
        let samples = samples_from_points(&points.collect::<Vec<_>>());
        Prices::new(&Boundary::new(vec![samples]).unwrap(), None, PriceOptions::default())
    }

    #[test]
    fn strips_are_what_single_rungs_are() {
        let bent = bent(20, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let all = Wanted { lanes: u16::MAX, limit: f64::INFINITY };
        for (prices, least_without, least_open) in [
            (bent, 200, 20),
            (nearly_straight(1e-7), 0, 400),
            (zigzag(0.01), 0, 1000),
            (zigzag(0.002), 0, 200),
        ] {
            let (mut without, mut open) = (0, 0);
            for i in 0..prices.len() {
                for first in (0..prices.len()).step_by(LANES) {
                    let mut strip = Strip::BLANK;
                    let to = prices.far_ends(first);
                    prices.strip::<true>(i, &to, all, &mut strip);
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
