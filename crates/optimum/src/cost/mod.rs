//! What a rung and a triangle cost: twist, and the price of folds.
//!
//! **Twist** (equation 1, normalised as in \[L11\] and \[WT05\]). With t_i the unit tangent at P_i,
//! n_i^j = (P_j − P_i) × t_i and n_j^i = (P_i − P_j) × t_j, both normalised,
//! w(i,j) = 1 − n_i^j · n_j^i. It is computed as ½ |n_i^j − n_j^i|², the same number without
//! cancellation. Here both normals have the opposite sign, t_i × (P_j − P_i), so that they point to
//! the side that the surface faces; the product does not change.
//!
//! The formula leaves three cases open. They are priced so:
//!
//! * A **corner** has two tangents, t⁻ as the curve arrives and t⁺ as it leaves. It is the limit of
//!   a rounded corner, whose tangents sweep from t⁻ to t⁺, and a rung takes the one with the least
//!   twist. So the end of a rung at a corner has not one normal but the sector between t⁻ × d and
//!   t⁺ × d, and the twist is the least between the two ends. A cone whose apex is a corner has no
//!   twist, as it should. Where both ends are corners and leave a choice, the normal nearest to
//!   those of the planes of their two tangents is taken.
//! * At a **concave sample** a rung may leave between the two edges that meet there, where the
//!   polyline cannot tell on which side of the tangent it lies: (e⁻ × d) · (e⁺ × d) ≤ 0. There the
//!   sign of the normal is open, and the other end decides; where both are open, the supporting
//!   plane's normal does, or else the area vector of the loop.
//! * A rung **parallel to a tangent** has no tangent plane and is not allowed while there is a
//!   triangulation without it. At a corner that concerns the rungs that lie on its own edges.
//!
//! **Fold price.** Twist does not depend on how triangles lie between their rungs, so slivers may
//! turn over at no price. With N the direction of n_i^j + n_j^i and n the normal of a triangle, the
//! price of a triangulation is Π = Σ_rungs w + ν Σ_triangles Σ_{its rungs} (1 − n · N). A triangle
//! without area has no normal and counts as turned over, 2 a rung.
//!
//! **Hints.** Where two surfaces through a boundary cost about as much, a person says by a point
//! which one is meant, see [`Hint`]: every rung that passes the point at another height costs more.
//!
//! **Exact sums.** Every price is rounded to a multiple of [`QUANTUM`]. Sums of such multiples are
//! exact in f64 below [`EXACT_BELOW`]. So the price of a triangulation does not depend on the order
//! of its sum, ties are exact, and every method that finds the optimum finds the same number.

mod hints;
mod planes;
mod slopes;
mod strip;

pub use hints::{Hint, HintKind};
pub use planes::RungPlanes;
pub(crate) use planes::{cross, dot};
pub use slopes::{Piece, SampleSlope, SlopedRung};
pub(crate) use strip::{Aligned, Fan, FarEnds, LANES, Lanes, Strip};

use hints::Hints;
use planes::{End, smooth, special};
use sheetwright_geometry::boundary::{Boundary, SupportingPlane, size_of};
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::math::{Vec3, unit};
use std::ops::Range;
use std::sync::Arc;

/// All prices are multiples of this, 2⁻⁴⁴. As a twist it is a warp angle of 2·10⁻⁵ degrees, above
/// the rounding of 1 − n·n (2⁻⁵²) and below any angle that can be measured on a sheet.
pub const QUANTUM: f64 = 1.0 / (1u64 << 44) as f64;
/// Sums of prices are exact below this: 2⁵³ quanta.
pub const EXACT_BELOW: f64 = 512.0;
/// Largest weight of the fold price, so that the price of one triangle stays far inside the
/// range of exact sums.
pub const MAX_FOLD: f64 = 10.0;
/// The default weight ν of the fold price; `docs/fold-price.md` has the reasons.
pub const DEFAULT_FOLD: f64 = 1.0;

/// Which form of equation (1) twist has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TwistForm {
    /// With unit normals: only twist counts.
    #[default]
    Normalised,
    /// As printed in the seed and in \[G14\], divided by the length of the rung alone: oblique
    /// rungs cost too. For comparison.
    Printed,
}

/// How triangulations are priced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PriceOptions {
    /// The weight ν of the fold price, without unit, 0 ..= [`MAX_FOLD`]; 0 is pure twist.
    pub fold: f64,
    /// The form of equation (1).
    pub form: TwistForm,
}

impl Default for PriceOptions {
    fn default() -> Self {
        Self { fold: DEFAULT_FOLD, form: TwistForm::Normalised }
    }
}

/// Rounds a price to a multiple of [`QUANTUM`]; for prices below 128.
#[inline]
pub(crate) fn quantised(price: f64) -> f64 {
    // Numbers in 256 .. 512 have an ulp of 2⁻⁴⁴, so the sum is rounded to it, ties to even.
    const SHIFT: f64 = 384.0;
    (price + SHIFT) - SHIFT
}

/// No sample.
const NONE: usize = usize::MAX;

/// Prices of the rungs and triangles between the samples of a boundary.
#[derive(Clone, Debug)]
pub struct Prices {
    ends: Vec<End>,
    /// The sample that follows each on its loop, along an edge; empty where there is one loop, in
    /// order.
    after: Vec<usize>,
    /// The sample of the boundary for each member of a chain; empty where each is itself.
    numbers: Vec<usize>,
    /// Coordinates of positions and tangents by axis, for pricing many rungs at once.
    positions: [Vec<f64>; 3],
    tangents: [Vec<f64>; 3],
    special_cosines_squared: Vec<f64>,
    options: PriceOptions,
    facing: Vec3,
    /// Which places rungs should pass near, or keep away from.
    hints: Option<Arc<Hints>>,
}

impl Prices {
    /// The prices of `boundary`, all of its loops.
    pub fn new(
        boundary: &Boundary,
        plane: Option<&SupportingPlane>,
        options: PriceOptions,
    ) -> Self {
        let ends: Vec<End> = (0..boundary.len())
            .map(|i| {
                let s = boundary.samples()[i];
                let at = |k: usize| boundary.samples()[k].position;
                End {
                    position: s.position.to_vec(),
                    tangent_in: s.tangent_in,
                    tangent_out: s.tangent_out,
                    edge_in: unit(s.position - at(boundary.previous(i))).unwrap_or(Vec3::ZERO),
                    edge_out: unit(at(boundary.next(i)) - s.position).unwrap_or(Vec3::ZERO),
                }
            })
            .collect();
        let facing = plane
            .map_or_else(|| unit(boundary.area_vector()).unwrap_or(Vec3::Z), |plane| plane.frame.z);
        let mut prices = Self::of_ends(ends, options, facing);
        if boundary.holes() > 0 {
            prices.after = (0..boundary.len()).map(|i| boundary.next(i)).collect();
        }
        prices
    }

    /// The prices of a loop of samples that need not be a valid boundary; it faces along its area
    /// vector.
    pub fn of_ring(samples: &[Sample], options: PriceOptions) -> Self {
        let m = samples.len();
        let at = |k: usize| samples[k % m].position;
        let edge = |i: usize| unit(at(i + 1) - at(i)).unwrap_or(Vec3::ZERO);
        let ends = samples.iter().enumerate().map(|(i, s)| End {
            position: s.position.to_vec(),
            tangent_in: s.tangent_in,
            tangent_out: s.tangent_out,
            edge_in: edge(i + m - 1),
            edge_out: edge(i),
        });
        let twice = |i: usize| (at(i) - at(0)).cross(at(i + 1) - at(0));
        let area_vector = (0..m).fold(Vec3::ZERO, |sum, i| sum + twice(i));
        Self::of_ends(ends.collect(), options, unit(area_vector).unwrap_or(Vec3::Z))
    }

    /// The prices of the closed polygon that walks the samples of `order`; it may pass a sample
    /// more than once, as the banks of a cut do, and `is_cut` says which of its edges are banks.
    /// Rungs and triangles have the same bits as here.
    pub(crate) fn chain(&self, order: &[usize], is_cut: impl Fn(usize, usize) -> bool) -> Self {
        let ends = order.iter().map(|&i| self.ends[i]).collect();
        let numbers = order.iter().map(|&i| self.number(i)).collect();
        let next = |i: usize| if i + 1 == order.len() { 0 } else { i + 1 };
        let after = |i: usize| if is_cut(order[i], order[next(i)]) { NONE } else { next(i) };
        let after = (0..order.len()).map(after).collect();
        Self { numbers, after, ..self.of_some(ends) }
    }

    /// The prices of the closed polygon that walks the samples of `order`, taken for a loop in
    /// order. Unlike those of [`Self::chain`], they treat banks as edges, which leaves out the
    /// folds at the cuts, and the prices of triangles may differ in their last bit. Tables of these
    /// prices are filled many times as fast.
    pub(crate) fn chain_in_order(&self, order: &[usize]) -> Self {
        self.of_some(order.iter().map(|&i| self.ends[i]).collect())
    }

    /// Whether two samples that follow one another on a chain are the ends of a cut.
    #[inline]
    pub(crate) fn is_bank(&self, i: usize, j: usize) -> bool {
        let apart = i.abs_diff(j);
        !self.numbers.is_empty()
            && !self.after.is_empty()
            && (apart == 1 || apart + 1 == self.len())
            && !self.neighbours(i, j)
    }

    /// The sample of the boundary that a member of the chain is.
    #[inline]
    fn number(&self, i: usize) -> usize {
        if self.numbers.is_empty() { i } else { self.numbers[i] }
    }

    /// The prices of the loops of some of the samples, with the tangents that they have: those of
    /// each loop are a range of `kept`.
    pub(crate) fn thinned(&self, kept: &[usize], loops: &[Range<usize>]) -> Self {
        let mut ends: Vec<End> = kept.iter().map(|&i| self.ends[i]).collect();
        let mut after = vec![0; kept.len()];
        for of_loop in loops {
            for i in of_loop.clone() {
                let next = if i + 1 == of_loop.end { of_loop.start } else { i + 1 };
                let edge = unit(ends[next].position - ends[i].position).unwrap_or(Vec3::ZERO);
                ends[i].edge_out = edge;
                ends[next].edge_in = edge;
                after[i] = next;
            }
        }
        let mut thinned = self.of_some(ends);
        if loops.len() > 1 {
            thinned.after = after;
        }
        if !self.numbers.is_empty() {
            thinned.numbers = kept.iter().map(|&i| self.numbers[i]).collect();
        }
        thinned
    }

    /// The prices of other members of the boundary, with these options and hints.
    fn of_some(&self, ends: Vec<End>) -> Self {
        let hints = self.hints.clone();
        Self { hints, ..Self::of_ends(ends, self.options, self.facing) }
    }

    fn of_ends(ends: Vec<End>, options: PriceOptions, facing: Vec3) -> Self {
        let by_axis = |of: fn(&End) -> Vec3| {
            [0, 1, 2].map(|axis| ends.iter().map(|end| of(end)[axis]).collect())
        };
        Self {
            positions: by_axis(|end| end.position),
            tangents: by_axis(|end| end.tangent_out),
            special_cosines_squared: ends.iter().map(End::special_cosine_squared).collect(),
            ends,
            after: Vec::new(),
            numbers: Vec::new(),
            options,
            facing,
            hints: None,
        }
    }

    /// These prices, with a price for every rung that passes a hint as it should not. The distances
    /// that count follow the size of the boundary.
    pub fn with_hints(self, hints: &[Hint], boundary: &Boundary) -> Self {
        let hints = Hints::new(hints, self.facing, size_of(boundary.positions()));
        Self { hints: hints.map(Arc::new), ..self }
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Always false: a boundary has at least three samples.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// These prices with the weight `fold` of the fold price.
    pub(crate) fn with_fold(self, fold: f64) -> Self {
        Self { options: PriceOptions { fold, ..self.options }, ..self }
    }

    /// The options of these prices.
    pub fn options(&self) -> PriceOptions {
        self.options
    }

    /// Whether there is only one loop.
    pub(crate) fn one_loop(&self) -> bool {
        self.after.is_empty()
    }

    /// Whether two samples are neighbours on a loop.
    #[inline]
    pub fn neighbours(&self, i: usize, j: usize) -> bool {
        if !self.after.is_empty() {
            return self.after[i] == j || self.after[j] == i;
        }
        let apart = i.abs_diff(j);
        apart == 1 || apart + 1 == self.len()
    }

    #[inline(always)]
    pub(crate) fn smooth_end(&self, i: usize) -> ([f64; 3], [f64; 3], f64) {
        // Not `[0, 1, 2].map`, whose check of each index keeps it from being inlined.
        let at = |[x, y, z]: &[Vec<f64>; 3]| [x[i], y[i], z[i]];
        (at(&self.positions), at(&self.tangents), self.special_cosines_squared[i])
    }

    /// The tangent planes along the rung between samples `i` < `j`; `None` where it has none,
    /// because it is parallel to a tangent or has no length.
    pub fn planes(&self, i: usize, j: usize) -> Option<RungPlanes> {
        let smooth = smooth(self.smooth_end(i), self.smooth_end(j));
        if smooth.is_special { self.special_planes(i, j) } else { Some(smooth.into()) }
    }

    /// The tangent planes along a special rung; `None` where it has none.
    fn special_planes(&self, i: usize, j: usize) -> Option<RungPlanes> {
        // In the order of the boundary, so that rounding does not depend on the chain.
        let (i, j) = if self.number(i) < self.number(j) { (i, j) } else { (j, i) };
        special(&self.ends[i], &self.ends[j], self.facing)
    }

    /// The price of the rung between samples `i` < `j` without its folds, a multiple of
    /// [`QUANTUM`], from its planes: its twist, and the price of the hints that it passes.
    pub fn rung(&self, i: usize, j: usize, planes: &RungPlanes) -> f64 {
        let twist = match self.options.form {
            TwistForm::Normalised => planes.twist,
            TwistForm::Printed => self.printed_twist(i, j),
        };
        quantised(twist) + self.of_hints(i, j)
    }

    /// The price of the hints that the rung between two samples passes, a multiple of [`QUANTUM`].
    pub(crate) fn of_hints(&self, i: usize, j: usize) -> f64 {
        let Some(hints) = &self.hints else { return 0.0 };
        // In the order of the boundary, so that rounding does not depend on the chain.
        let (i, j) = if self.number(i) < self.number(j) { (i, j) } else { (j, i) };
        hints.price(self.ends[i].position, self.ends[j].position)
    }

    /// Equation (1) as printed: the cross products divided by the length of the rung alone. At a
    /// corner, with the mean of the two tangents.
    pub(crate) fn printed_twist(&self, i: usize, j: usize) -> f64 {
        let (a, b) = (&self.ends[i], &self.ends[j]);
        let Some(d) = unit(b.position - a.position) else { return 2.0 };
        1.0 - a.mean_tangent().cross(d).dot(b.mean_tangent().cross(-d))
    }

    /// The price of the triangle with corners i, k, j, counter-clockwise as seen from the side that
    /// the surface faces (on one loop: in its order): ν Σ (1 − n · N) over those of its sides that
    /// are rungs, a multiple of [`QUANTUM`]. `means` are the N of the sides ⟨i,k⟩, ⟨k,j⟩, ⟨i,j⟩;
    /// zero for a side that is an edge of the boundary.
    #[inline]
    pub fn triangle(&self, [i, k, j]: [usize; 3], means: [Vec3; 3]) -> f64 {
        // The lowest sample first, so that rounding does not depend on the order of the corners.
        let [a, b, c] = [self.number(i), self.number(k), self.number(j)];
        let ([i, k, j], means) = if a < b && a < c {
            ([i, k, j], means)
        } else if b < c {
            ([k, j, i], [means[1], means[2], means[0]])
        } else {
            ([j, i, k], [means[2], means[0], means[1]])
        };
        let sides = [(i, k), (k, j), (i, j)];
        let rungs = sides.iter().filter(|(a, b)| !self.neighbours(*a, *b)).count();
        self.fold_price([i, k, j], rungs as f64, means[0] + means[1] + means[2])
    }

    /// The distance between two samples, mm.
    pub(crate) fn length(&self, i: usize, j: usize) -> f64 {
        (self.ends[j].position - self.ends[i].position).length()
    }

    /// The length of the way from `i` over `k` to `j`, mm.
    pub(crate) fn detour(&self, i: usize, k: usize, j: usize) -> f64 {
        self.length(i, k) + self.length(k, j)
    }

    /// The price of the triangle i, k, j with this many rungs and this sum of their N.
    #[inline]
    fn fold_price(&self, [i, k, j]: [usize; 3], rungs: f64, sum: Vec3) -> f64 {
        let at = |n: usize| self.ends[n].position;
        let (u, v) = (at(k) - at(i), at(j) - at(i));
        fold_of(self.options.fold, u.to_array(), v.to_array(), rungs, sum.to_array())
    }

    /// Whether the members are numbered in order, as those of a loop are and those of a chain need
    /// not be.
    pub(crate) fn in_order(&self) -> bool {
        self.numbers.is_empty() && self.after.is_empty()
    }
}

/// The price of a triangle with the sides `u` and `v` from one of its corners, this many rungs and
/// this sum of their N, with the weight `fold`.
#[inline(always)]
fn fold_of(fold: f64, u: [f64; 3], v: [f64; 3], rungs: f64, sum: [f64; 3]) -> f64 {
    let area_vector = cross(u, v);
    let doubled_area = dot(area_vector, area_vector).sqrt();
    let along = if doubled_area > 0.0 { dot(area_vector, sum) / doubled_area } else { -rungs };
    quantised(fold * (rungs - along))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::boundary::samples_from_points;
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, cos, sin};

    fn prices(list: &[[f64; 3]], corners: bool, options: PriceOptions) -> Prices {
        let points: Vec<CurvePoint> = list
            .iter()
            .map(|p| CurvePoint {
                at: Point3::new(p[0], p[1], p[2]),
                corner: corners,
                move_mm: 0.0,
            })
            .collect();
        let boundary = Boundary::new(vec![samples_from_points(&points)]).unwrap();
        Prices::new(&boundary, None, options)
    }

    fn regular(m: usize) -> Vec<[f64; 3]> {
        (0..m)
            .map(|i| {
                let t = std::f64::consts::TAU * i as f64 / m as f64;
                [cos(t), sin(t), 0.0]
            })
            .collect()
    }

    #[test]
    fn a_planar_polygon_has_no_twist_but_in_the_printed_form() {
        let prices = prices(&regular(54), false, PriceOptions::default());
        let planes = prices.planes(3, 20).unwrap();
        assert!(planes.twist < 1e-15);
        assert!((planes.mean - Vec3::Z).length() < 1e-12);
        assert!(prices.printed_twist(3, 5) > 0.9);
    }

    #[test]
    fn concave_samples_do_not_turn_the_plane_over() {
        // A comb: all rungs between its samples, inside or not, keep the plane.
        let comb = [
            [0., 0., 0.],
            [6., 0., 0.],
            [6., 3., 0.],
            [4., 1.1, 0.],
            [3., 3.3, 0.],
            [2., 0.8, 0.],
            [0., 3., 0.],
        ];
        for corners in [false, true] {
            let prices = prices(&comb, corners, PriceOptions::default());
            for (i, j) in [(0, 3), (0, 5), (1, 3), (1, 5), (3, 5), (0, 4), (1, 4)] {
                let planes = prices.planes(i, j).unwrap();
                assert!(planes.twist < 1e-15, "{corners} {i} {j} {planes:?}");
                assert!(planes.mean.z > 0.9, "{corners} {i} {j} {planes:?}");
            }
        }
    }

    #[test]
    fn a_rung_on_its_own_edge_has_no_plane() {
        let run = [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [3., 0., 0.], [1., 2., 1.]];
        let prices = prices(&run, true, PriceOptions::default());
        assert!(prices.planes(0, 2).is_none());
        assert!(prices.planes(1, 3).is_none());
        assert!(prices.planes(0, 3).is_none());
        assert!(prices.planes(1, 4).is_some());
    }

    #[test]
    fn a_cone_from_a_corner_has_no_twist() {
        // Apex at a corner between two rulings; the far ends on a circle about the axis z.
        let mut list = vec![[0.0, 0.0, 2.0]];
        list.extend((0..9).map(|i| {
            let t = 0.2 * f64::from(i);
            [cos(t), sin(t), 0.0]
        }));
        let mut points: Vec<CurvePoint> =
            list.iter().map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2]))).collect();
        for i in [0, 1, 9] {
            points[i].corner = true;
        }
        let boundary = Boundary::new(vec![samples_from_points(&points)]).unwrap();
        let prices = Prices::new(&boundary, None, PriceOptions::default());
        for j in 2..9 {
            let planes = prices.planes(0, j).unwrap();
            assert!(planes.twist == 0.0, "{j} {planes:?}");
            assert!(planes.warp() == 0.0);
        }
    }

    #[test]
    fn a_flat_triangle_costs_nothing_and_one_turned_over_costs_two_a_rung() {
        let options = PriceOptions { fold: 1.0, ..PriceOptions::default() };
        let prices = prices(&regular(9), false, options);
        let mean = |i, j| if prices.neighbours(i, j) { Vec3::ZERO } else { Vec3::Z };
        let means = |i, k, j| [mean(i, k), mean(k, j), mean(i, j)];
        assert_eq!(prices.triangle([0, 3, 6], means(0, 3, 6)), 0.0);
        assert_eq!(prices.triangle([0, 3, 6], [-Vec3::Z; 3]), 6.0);
        assert_eq!(prices.triangle([0, 1, 6], means(0, 1, 6)), 0.0);
    }

    #[test]
    fn a_triangle_without_area_counts_as_turned_over() {
        let line = [[0., 0., 0.], [2., 0., 0.], [2., 2., 0.], [1., 1., 0.]];
        let options = PriceOptions { fold: 1.0, ..PriceOptions::default() };
        let prices = prices(&line, true, options);
        assert_eq!(prices.triangle([0, 2, 3], [Vec3::Z, Vec3::ZERO, Vec3::ZERO]), 2.0);
    }

    #[test]
    fn sums_of_prices_do_not_depend_on_their_order() {
        let list: Vec<f64> = (0..1000).map(|i| quantised(f64::from(i * i % 997) * 3e-4)).collect();
        let forwards: f64 = list.iter().sum();
        let backwards: f64 = list.iter().rev().sum();
        assert_eq!(forwards, backwards);
        assert!(list.iter().all(|p| (p / QUANTUM).fract() == 0.0));
    }
}
