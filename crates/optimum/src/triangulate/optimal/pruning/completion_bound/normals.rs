//! Boxes around the N of many rungs, and lower bounds on the fold price F of triangles with such
//! sides.
//!
//! With n the normal of a triangle whose three sides are rungs and s the sum of their N, its F is ν
//! (3 − n · s) ≥ ν (3 − |s|) ≥ ν (9 − |s|²) / 6. As each N is a unit vector or zero, 9 − |s|² is at
//! least the sum of the squares of what the three differ by, two at a time. Where one side is an
//! edge of the boundary, 2 − |s| ≥ (4 − |s|²) / 4 is more than a sixth of the square of what the
//! other two differ by. Of a triangle with two edges nothing is said; one without area costs 2 ν a
//! rung, which is more than any of this.

use crate::cost::QUANTUM;

/// What N and F may lose to rounding, for ν = 1: some twenty operations on numbers up to 12.
pub(super) const SLACK: f64 = 1e-13;

/// A box that the N of some rungs lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NormalBox {
    /// By axis.
    least: [f64; 3],
    greatest: [f64; 3],
}

impl NormalBox {
    /// Of unknown rungs, or of rungs and edges of the boundary.
    pub(super) const ANY: Self =
        Self { least: [f64::NEG_INFINITY; 3], greatest: [f64::INFINITY; 3] };

    /// Of no rung.
    pub(super) const NONE: Self =
        Self { least: [f64::INFINITY; 3], greatest: [f64::NEG_INFINITY; 3] };

    /// The box between these values, by axis.
    #[inline(always)]
    pub(super) fn between(least: [f64; 3], greatest: [f64; 3]) -> Self {
        Self { least, greatest }
    }

    /// Its corners, by axis.
    pub(super) fn extremes(&self) -> ([f64; 3], [f64; 3]) {
        (self.least, self.greatest)
    }

    /// Extends this box to include another.
    #[inline(always)]
    pub(super) fn include(&mut self, other: &Self) {
        for axis in 0..3 {
            self.least[axis] = self.least[axis].min(other.least[axis]);
            self.greatest[axis] = self.greatest[axis].max(other.greatest[axis]);
        }
    }

    /// The square of what the N of one and of the other differ by at the least.
    #[inline(always)]
    fn apart_squared(&self, other: &Self) -> f64 {
        let mut sum = 0.0;
        for axis in 0..3 {
            let above = self.least[axis] - other.greatest[axis];
            let below = other.least[axis] - self.greatest[axis];
            let gap = if above > below { above } else { below };
            // NaN where one box is ANY and the other NONE: that adds nothing.
            sum += if gap > 0.0 { gap * gap } else { 0.0 };
        }
        sum
    }
}

/// The least F of triangles whose sides have their N in these boxes, one each, with the weight ν =
/// `fold`.
#[inline(always)]
pub(super) fn least_fold(fold: f64, [a, b, c]: [&NormalBox; 3]) -> f64 {
    let squares = a.apart_squared(b) + a.apart_squared(c) + b.apart_squared(c);
    // Prices are rounded to the quantum.
    let least = fold * (squares / 6.0 - SLACK) - QUANTUM;
    if least > 0.0 { least } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::{PriceOptions, Prices};
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, Vec3, cos, sin, unit};
    use sheetwright_shapes::random::Random;
    use std::f64::consts::TAU;

    /// Some N around this one, and their box.
    fn around(random: &mut Random, middle: Vec3, reach: f64) -> (NormalBox, Vec<Vec3>) {
        let (mut within, mut list) = (NormalBox::NONE, Vec::new());
        for _ in 0..12 {
            let off = [(); 3].map(|()| random.between(-reach, reach));
            let mean = unit(middle + Vec3::from_array(off)).unwrap();
            within.include(&NormalBox::between(mean.to_array(), mean.to_array()));
            list.push(mean);
        }
        (within, list)
    }

    #[test]
    fn no_triangle_costs_less_than_the_boxes_of_its_sides() {
        let mut random = Random::new(61);
        let mut shares = Vec::new();
        for turn in 0..300 {
            let apart = [0.01, 0.1, 0.6][turn % 3];
            let middle = |random: &mut Random| {
                let off = [(); 3].map(|()| random.between(-apart, apart));
                unit(Vec3::Z + Vec3::from_array(off)).unwrap()
            };
            let sides = [(); 3].map(|()| {
                let middle = middle(&mut random);
                around(&mut random, middle, 0.1 * apart)
            });
            let [a, b, c] = &sides;
            let least = least_fold(1.0, [&a.0, &b.0, &c.0]);
            let of_two = least_fold(1.0, [&a.0, &b.0, &NormalBox::ANY]);
            assert_eq!(least_fold(1.0, [&a.0, &NormalBox::ANY, &NormalBox::ANY]), 0.0);
            // The cheapest normal lies along the sum.
            let mut cheapest = f64::INFINITY;
            for &x in &a.1 {
                for &y in &b.1 {
                    assert!(2.0 - (x + y).length() >= of_two);
                    for &z in &c.1 {
                        cheapest = cheapest.min(3.0 - (x + y + z).length());
                    }
                }
            }
            assert!(cheapest >= least, "{cheapest} {least}");
            assert!(least_fold(0.5, [&a.0, &b.0, &c.0]) <= 0.5 * least);
            shares.push(least / cheapest);
        }
        // They tell something.
        shares.sort_by(f64::total_cmp);
        assert!(shares[150] > 0.5, "{}", shares[150]);
    }

    #[test]
    fn no_triangle_of_a_boundary_costs_less_than_its_own_sides_tell() {
        let at = |i: u32| {
            let t = TAU * f64::from(i) / 60.0;
            CurvePoint::smooth(Point3::new(cos(t), sin(t), if i < 30 { 0.0 } else { 0.2 * sin(t) }))
        };
        let samples = samples_from_points(&(0..60).map(at).collect::<Vec<_>>());
        let boundary = Boundary::new(vec![samples]).unwrap();
        let prices = Prices::new(&boundary, None, PriceOptions::default());
        let mean = |i: usize, j: usize| {
            let planes = if prices.neighbours(i, j) { None } else { prices.planes(i, j) };
            planes.map_or(Vec3::ZERO, |planes| planes.mean)
        };
        let of_one = |i: usize, j: usize, mean: Vec3| {
            if prices.neighbours(i, j) {
                return NormalBox::ANY;
            }
            NormalBox { least: mean.to_array(), greatest: mean.to_array() }
        };
        let mut told = 0;
        for (i, k) in (0..60).flat_map(|i| (i + 1..60).map(move |k| (i, k))) {
            for j in k + 1..60 {
                let means = [mean(i, k), mean(k, j), mean(i, j)];
                // As they are, and with a rung whose planes are opposite, which has no N.
                for means in [means, [Vec3::ZERO, means[1], means[2]]] {
                    let boxes =
                        [of_one(i, k, means[0]), of_one(k, j, means[1]), of_one(i, j, means[2])];
                    let least = least_fold(1.0, [&boxes[0], &boxes[1], &boxes[2]]);
                    assert!(prices.triangle([i, k, j], means) >= least, "{i} {k} {j}");
                    told += usize::from(least > 0.0);
                }
            }
        }
        assert!(told > 10_000, "{told}");
    }

    #[test]
    fn without_rungs_there_is_no_triangle() {
        let (none, some) = (NormalBox::NONE, NormalBox::between([0.0; 3], [0.0; 3]));
        assert_eq!(least_fold(1.0, [&none, &some, &some]), f64::INFINITY);
        assert_eq!(least_fold(1.0, [&some; 3]), 0.0);
    }
}
