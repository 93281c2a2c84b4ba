//! What a rung and a triangle cost: twist, and the price of folds.
//!
//! **Twist** (equation 1, normalised as in [L11] and [WT05]). With t_i the unit tangent at P_i,
//! n_i^j = (P_j − P_i) × t_i and n_j^i = (P_i − P_j) × t_j, both normalised,
//! w(i,j) = 1 − n_i^j · n_j^i. It is computed as ½ |n_i^j − n_j^i|², the same number without
//! cancellation. Here both normals are turned round, t_i × (P_j − P_i), so that they point to the
//! side that the surface faces; the product does not change.
//!
//! Three places where the formula says nothing, and what is done there:
//!
//! * A **corner** has two tangents, t⁻ as the curve arrives and t⁺ as it leaves. It is the limit of
//!   a rounded corner, whose tangents sweep from t⁻ to t⁺, and a rung takes the one that suits it
//!   best. So the end of a rung at a corner has not one normal but the sector between t⁻ × d and
//!   t⁺ × d, and the twist is the least between the two ends. A cone whose apex is a corner has no
//!   twist, as it should. Where both ends leave a choice, the middle of it is taken.
//! * At a **concave sample** a rung may leave between the two edges that meet there, where the
//!   polyline cannot tell on which side of the tangent it lies: (e⁻ × d) · (e⁺ × d) ≤ 0. There the
//!   sign of the normal is open, and the other end decides; where both are open, the supporting
//!   plane's normal does, or else the area vector of the loop.
//! * A rung **parallel to a tangent** has no tangent plane and is not allowed while there is a
//!   triangulation without it. At a corner that concerns the rungs that lie on its own edges.
//!
//! **Fold price.** Twist does not see how triangles lie between their rungs, so that slivers may
//! turn over at no cost. With N the direction of n_i^j + n_j^i and n the normal of a triangle, the
//! price of a triangulation is Π = Σ_rungs w + ν Σ_triangles Σ_{its rungs} (1 − n · N). A triangle
//! without area has no normal and counts as turned over, 2 a rung.
//!
//! **Exact sums.** Every price is rounded to a multiple of [`QUANTUM`]. Sums of such multiples are
//! exact in f64 below [`EXACT_BELOW`], so that the price of a triangulation does not depend on the
//! order in which it is summed, equal prices are equal, and every method that finds the optimum
//! finds the same number.

use crate::boundary::{Boundary, SupportingPlane};
use crate::math::{Vec3, atan2, cos, sin, turned, unit};

/// What all prices are multiples of: 2⁻⁴⁴. As a twist it is a warp angle of 2·10⁻⁵ degrees, which
/// is above the rounding of 1 − n·n (2⁻⁵²) and below anything that can be measured on a sheet.
pub const QUANTUM: f64 = 1.0 / (1u64 << 44) as f64;
/// Sums of prices are exact below this: 2⁵³ quanta.
pub const EXACT_BELOW: f64 = 512.0;
/// Largest weight of the fold price, so that the price of one triangle stays far inside the
/// range of exact sums.
pub const MAX_FOLD: f64 = 10.0;
/// The default weight ν of the fold price; `docs/fold-price.md` has the table that argues for it.
pub const DEFAULT_FOLD: f64 = 0.1;

/// Sine of the angle between rung and tangent up to which they count as parallel. At it, the
/// rounding of coordinates (10⁻¹⁶ of the size) still leaves the normal seven digits on rungs of the
/// size of the boundary; samples would have to stand a million to a radian of turning to come near.
const PARALLEL_SINE: f64 = 1e-9;

/// Which form of equation (1) twist has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TwistForm {
    /// With unit normals: only twist counts.
    #[default]
    Normalised,
    /// As printed in the seed and in [G14], divided by the length of the rung alone: oblique rungs
    /// cost too. For comparison.
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

/// The tangent planes along a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungPlanes {
    /// Unit normals at the two ends, towards the side that the surface faces; the end with the
    /// lower sample number first.
    pub at_ends: [Vec3; 2],
    /// N: the direction of their sum; zero where they are opposite.
    pub mean: Vec3,
    /// w, 0 ..= 2, without unit: 1 minus the cosine of the angle between them.
    pub twist: f64,
}

impl RungPlanes {
    fn new(a: Vec3, b: Vec3) -> Self {
        Self { at_ends: [a, b], mean: unit(a + b).unwrap_or(Vec3::ZERO), twist: half_square(a, b) }
    }

    /// The warp angle: how far the tangent plane turns along the rung, radians, 0 ..= π.
    pub fn warp(&self) -> f64 {
        crate::math::angle_between(self.at_ends[0], self.at_ends[1])
    }
}

/// 1 − a·b of two unit vectors, without cancellation.
fn half_square(a: Vec3, b: Vec3) -> f64 {
    0.5 * (a - b).length_squared()
}

/// Rounds a price to a multiple of [`QUANTUM`]; for prices below 128.
pub fn quantised(price: f64) -> f64 {
    // Numbers in 256 .. 512 have an ulp of 2⁻⁴⁴, so the sum is rounded to it, ties to even.
    const SHIFT: f64 = 384.0;
    (price + SHIFT) - SHIFT
}

/// Prices of the rungs and triangles of one loop.
#[derive(Clone, Debug)]
pub struct Prices {
    ends: Vec<End>,
    options: PriceOptions,
    facing: Vec3,
}

/// What prices need to know of a sample.
#[derive(Clone, Copy, Debug)]
struct End {
    position: Vec3,
    tangent_in: Vec3,
    tangent_out: Vec3,
    /// Unit directions of the edges that arrive and leave.
    edge_in: Vec3,
    edge_out: Vec3,
    /// Cosine of an angle to the tangent within which the sign of the normal may be open.
    open_cosine: f64,
}

/// The normals that one end of a rung may have.
#[derive(Clone, Copy)]
enum Normals {
    One(Vec3),
    EitherSign(Vec3),
    Sector(Vec3, Vec3),
}

impl Prices {
    /// The prices of the outer loop of `boundary`.
    pub fn new(
        boundary: &Boundary,
        plane: Option<&SupportingPlane>,
        options: PriceOptions,
    ) -> Self {
        let outer = boundary.loops()[0].clone();
        let ends = outer
            .map(|i| {
                let s = boundary.samples()[i];
                let at = |k: usize| boundary.samples()[k].position;
                let edge_in = unit(s.position - at(boundary.previous(i))).unwrap_or(Vec3::ZERO);
                let edge_out = unit(at(boundary.next(i)) - s.position).unwrap_or(Vec3::ZERO);
                // The open directions lie on and inside the cone whose diameter the edges are, so
                // within twice the larger angle between the tangent and an edge.
                let half = s.tangent_in.dot(edge_in).min(s.tangent_in.dot(edge_out)).max(0.0);
                let open_cosine = (2.0 * half * half - 1.0).max(0.0) - 1e-12;
                End {
                    position: s.position.to_vec(),
                    tangent_in: s.tangent_in,
                    tangent_out: s.tangent_out,
                    edge_in,
                    edge_out,
                    open_cosine,
                }
            })
            .collect();
        let facing = plane.map_or_else(
            || unit(boundary.area_vector()).unwrap_or(Vec3::Z),
            |plane| plane.frame.z,
        );
        Self { ends, options, facing }
    }

    /// How many samples the loop has.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Never: a loop has at least three samples.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// How prices are made up.
    pub fn options(&self) -> PriceOptions {
        self.options
    }

    /// Whether two samples are neighbours on the loop.
    pub fn neighbours(&self, i: usize, j: usize) -> bool {
        let apart = i.abs_diff(j);
        apart == 1 || apart + 1 == self.len()
    }

    /// The tangent planes along the rung between samples `i` < `j`; `None` where it has none,
    /// because it is parallel to a tangent or has no length.
    pub fn planes(&self, i: usize, j: usize) -> Option<RungPlanes> {
        let (a, b) = (&self.ends[i], &self.ends[j]);
        let d = unit(b.position - a.position)?;
        let normals = (a.normals(d)?, b.normals(-d)?);
        Some(match normals {
            (Normals::One(u), Normals::One(v)) => RungPlanes::new(u, v),
            (Normals::One(u), Normals::EitherSign(v)) => RungPlanes::new(u, along(v, u)),
            (Normals::EitherSign(u), Normals::One(v)) => RungPlanes::new(along(u, v), v),
            (Normals::EitherSign(u), Normals::EitherSign(v)) => {
                let v = along(v, u);
                let sign = if (u + v).dot(self.facing) < 0.0 { -1.0 } else { 1.0 };
                RungPlanes::new(u * sign, v * sign)
            }
            (u, v) => self.between_sectors(u, v, d),
        })
    }

    /// The planes of a rung, along the unit direction `d`, that ends at a corner: the two normals,
    /// one from each end, that differ least.
    fn between_sectors(&self, u: Normals, v: Normals, d: Vec3) -> RungPlanes {
        let mut best: Option<(f64, RungPlanes)> = None;
        for u in u.sectors() {
            for v in v.sectors() {
                let planes = closest(u, v, d);
                // Of equals, the one on the side that the loop faces.
                let key = planes.twist - 1e-12 * planes.mean.dot(self.facing);
                if best.is_none_or(|(least, _)| key < least) {
                    best = Some((key, planes));
                }
            }
        }
        best.map_or_else(|| RungPlanes::new(self.facing, self.facing), |(_, planes)| planes)
    }

    /// The price of the rung between samples `i` < `j` without its folds, a multiple of
    /// [`QUANTUM`], from its planes.
    pub fn rung(&self, i: usize, j: usize, planes: &RungPlanes) -> f64 {
        quantised(match self.options.form {
            TwistForm::Normalised => planes.twist,
            TwistForm::Printed => self.printed_twist(i, j),
        })
    }

    /// Equation (1) as printed: the cross products divided by the length of the rung alone. At a
    /// corner, with the mean of the two tangents.
    pub fn printed_twist(&self, i: usize, j: usize) -> f64 {
        let (a, b) = (&self.ends[i], &self.ends[j]);
        let Some(d) = unit(b.position - a.position) else { return 2.0 };
        1.0 - a.mean_tangent().cross(d).dot(b.mean_tangent().cross(-d))
    }

    /// The price of the triangle between samples i < k < j: ν Σ (1 − n · N) over those of its
    /// sides that are rungs, a multiple of [`QUANTUM`]. `means` are the N of the sides ⟨i,k⟩,
    /// ⟨k,j⟩, ⟨i,j⟩; zero for a side that is an edge of the boundary.
    pub fn triangle(&self, [i, k, j]: [usize; 3], means: [Vec3; 3]) -> f64 {
        let sides = [(i, k), (k, j), (i, j)];
        let rungs = sides.iter().filter(|(a, b)| !self.neighbours(*a, *b)).count();
        self.fold_price([i, k, j], rungs as f64, means[0] + means[1] + means[2])
    }

    /// The length of the way from `i` over `k` to `j`, mm.
    pub(crate) fn detour(&self, i: usize, k: usize, j: usize) -> f64 {
        let at = |n: usize| self.ends[n].position;
        (at(k) - at(i)).length() + (at(j) - at(k)).length()
    }

    /// The price of the triangle i, k, j with this many rungs and this sum of their N.
    fn fold_price(&self, [i, k, j]: [usize; 3], rungs: f64, sum: Vec3) -> f64 {
        let at = |n: usize| self.ends[n].position;
        let area_vector = (at(k) - at(i)).cross(at(j) - at(i));
        let doubled_area = area_vector.length();
        let along = if doubled_area > 0.0 { area_vector.dot(sum) / doubled_area } else { -rungs };
        quantised(self.options.fold * (rungs - along))
    }
}

/// `v` or −`v`, whichever lies along `u`.
fn along(v: Vec3, u: Vec3) -> Vec3 {
    if v.dot(u) < 0.0 { -v } else { v }
}

impl End {
    fn mean_tangent(&self) -> Vec3 {
        unit(self.tangent_in + self.tangent_out).unwrap_or(self.tangent_in)
    }

    /// The normals of a rung that leaves this sample in the unit direction `d`.
    fn normals(&self, d: Vec3) -> Option<Normals> {
        let leaving = self.tangent_out.cross(d);
        if self.tangent_in == self.tangent_out {
            let sine = leaving.length();
            if sine <= PARALLEL_SINE {
                return None;
            }
            let normal = leaving / sine;
            let open = self.tangent_out.dot(d).abs() >= self.open_cosine
                && self.edge_in.cross(d).dot(self.edge_out.cross(d)) <= 0.0;
            return Some(if open { Normals::EitherSign(normal) } else { Normals::One(normal) });
        }
        let arriving = self.tangent_in.cross(d);
        let (sine_in, sine_out) = (arriving.length(), leaving.length());
        let (lost_in, lost_out) = (sine_in <= PARALLEL_SINE, sine_out <= PARALLEL_SINE);
        let on_own_edge = (lost_in && self.tangent_in.dot(d) < 0.0)
            || (lost_out && self.tangent_out.dot(d) > 0.0);
        match (lost_in, lost_out) {
            _ if on_own_edge => None,
            (true, true) => None,
            (true, false) => Some(Normals::One(leaving / sine_out)),
            (false, true) => Some(Normals::One(arriving / sine_in)),
            (false, false) => Some(Normals::Sector(arriving / sine_in, leaving / sine_out)),
        }
    }
}

impl Normals {
    /// As sectors from one normal to another by the shorter way.
    fn sectors(self) -> impl Iterator<Item = (Vec3, Vec3)> {
        let (first, second) = match self {
            Self::One(n) => ((n, n), None),
            Self::EitherSign(n) => ((n, n), Some((-n, -n))),
            Self::Sector(a, b) => ((a, b), None),
        };
        std::iter::once(first).chain(second)
    }
}

/// The two normals, one from each sector of the plane across the unit direction `d`, that differ
/// least; where the sectors overlap, both are the middle of the overlap.
fn closest(u: (Vec3, Vec3), v: (Vec3, Vec3), d: Vec3) -> RungPlanes {
    let angle = |from: Vec3, to: Vec3| atan2(from.cross(to).dot(d), from.dot(to));
    // All angles are measured about d from the first normal of u.
    let span = |start: f64, turn: f64| (start.min(start + turn), start.max(start + turn));
    let (u_low, u_high) = span(0.0, angle(u.0, u.1));
    let (v_low, v_high) = span(angle(u.0, v.0), angle(v.0, v.1));
    let at = |angle: f64| {
        if angle == 0.0 { u.0 } else { unit(turned(u.0, d, angle)).unwrap_or(u.0) }
    };
    let mut best: Option<(f64, f64, f64)> = None;
    for round in [0.0, -std::f64::consts::TAU, std::f64::consts::TAU] {
        let (low, high) = (v_low + round, v_high + round);
        let (gap, a, b) = if low > u_high {
            (low - u_high, u_high, low)
        } else if u_low > high {
            (u_low - high, u_low, high)
        } else {
            let middle = 0.5 * (low.max(u_low) + high.min(u_high));
            (0.0, middle, middle)
        };
        if best.is_none_or(|(least, ..)| gap < least) {
            best = Some((gap, a, b));
        }
    }
    let (gap, a, b) = best.unwrap_or((0.0, 0.0, 0.0));
    let mut planes = RungPlanes::new(at(a), at(b));
    // The gap itself, rather than the difference of two turned vectors, so that no rounding is
    // left where there is no twist.
    planes.twist = if gap == 0.0 { 0.0 } else { 2.0 * sin(0.5 * gap) * sin(0.5 * gap) };
    if gap == 0.0 {
        planes.at_ends[1] = planes.at_ends[0];
    }
    debug_assert!((planes.twist - (1.0 - cos(gap))).abs() < 1e-12);
    planes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::samples_from_points;
    use crate::curve::CurvePoint;
    use crate::math::Point3;

    fn prices(list: &[[f64; 3]], corners: bool, options: PriceOptions) -> Prices {
        let points: Vec<CurvePoint> = list
            .iter()
            .map(|p| CurvePoint { at: Point3::new(p[0], p[1], p[2]), corner: corners })
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
        let mut points: Vec<CurvePoint> = list
            .iter()
            .map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2])))
            .collect();
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
    fn sectors_find_the_least_gap_round_the_back_too() {
        let n = |angle: f64| Vec3::new(cos(angle), sin(angle), 0.0);
        let planes = closest((n(0.0), n(1.0)), (n(-3.0), n(-2.5)), Vec3::Z);
        // Forwards from 1.0 to −3.0 + 2π the gap is 2.283; backwards from 0 to −2.5 it is 2.5.
        let gap = std::f64::consts::TAU - 4.0;
        assert!((planes.warp() - gap).abs() < 1e-12);
        let planes = closest((n(0.0), n(1.0)), (n(0.5), n(2.0)), Vec3::Z);
        assert_eq!(planes.twist, 0.0);
        assert!((planes.mean - n(0.75)).length() < 1e-12);
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
