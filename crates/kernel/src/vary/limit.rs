//! What holds samples back, and the exact projections on it: the nearest displacements that obey.

use crate::math::Vec3;

/// How far the unknowns may move.
#[derive(Clone, Debug, PartialEq)]
pub enum Limit {
    /// One budget in all, equation (6): the sum of weight × displacement over the unknowns is at
    /// most `total_mm`.
    Budget {
        /// The budget, mm; finite and not negative.
        total_mm: f64,
        /// What a displacement of each unknown counts, positive: 1 for a sample, for a control point
        /// the sum of the shares that samples have in it.
        weights: Vec<f64>,
    },
    /// A limit for each unknown, mm; finite and not negative, 0 holds it fixed.
    Each {
        /// The limits.
        radii_mm: Vec<f64>,
    },
}

impl Limit {
    /// How many unknowns it is for.
    pub fn len(&self) -> usize {
        match self {
            Self::Budget { weights, .. } => weights.len(),
            Self::Each { radii_mm } => radii_mm.len(),
        }
    }

    /// Whether it is for none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether its numbers are limits at all.
    pub(super) fn is_valid(&self) -> bool {
        let length = |mm: &f64| mm.is_finite() && *mm >= 0.0;
        match self {
            Self::Budget { total_mm, weights } => {
                length(total_mm) && weights.iter().all(|w| w.is_finite() && *w > 0.0)
            }
            Self::Each { radii_mm } => radii_mm.iter().all(length),
        }
    }

    /// The farthest that one unknown may move, mm.
    pub(super) fn farthest_mm(&self) -> f64 {
        match self {
            Self::Budget { total_mm, weights } => {
                total_mm / weights.iter().copied().fold(f64::INFINITY, f64::min)
            }
            Self::Each { radii_mm } => radii_mm.iter().copied().fold(0.0, f64::max),
        }
    }

    /// The same limit, `factor` times as wide.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Budget { total_mm, weights } => {
                Self::Budget { total_mm: total_mm * factor, weights: weights.clone() }
            }
            Self::Each { radii_mm } => {
                Self::Each { radii_mm: radii_mm.iter().map(|r| r * factor).collect() }
            }
        }
    }

    /// The share of the limit that displacements use, 0 ..= 1 within it.
    pub(super) fn used(&self, displacements: &[Vec3]) -> f64 {
        match self {
            Self::Budget { total_mm, weights } if *total_mm > 0.0 => {
                let lengths = displacements.iter().zip(weights).map(|(way, w)| way.length() * w);
                lengths.sum::<f64>() / total_mm
            }
            Self::Budget { .. } => 0.0,
            Self::Each { radii_mm } => {
                let free = displacements.iter().zip(radii_mm).filter(|(_, radius)| **radius > 0.0);
                free.map(|(way, radius)| way.length() / radius).fold(0.0, f64::max)
            }
        }
    }

    /// Moves the displacements to the nearest ones within the limit.
    ///
    /// # Panics
    /// Unless there is one for every unknown.
    pub fn project(&self, displacements: &mut [Vec3]) {
        assert_eq!(self.len(), displacements.len(), "one displacement an unknown");
        match self {
            Self::Budget { total_mm, weights } => {
                // Twice, since what is very long loses the digits that the budget is counted in.
                project_on_budget(displacements, weights, *total_mm);
                project_on_budget(displacements, weights, *total_mm);
            }
            Self::Each { radii_mm } => {
                for (way, radius) in displacements.iter_mut().zip(radii_mm) {
                    let length = way.length();
                    if length > *radius {
                        *way *= radius / length;
                    }
                }
            }
        }
    }
}

/// The projection on Σ wₖ |uₖ| ≤ ε shortens every uₖ by λ wₖ, to nothing where it is no longer than
/// that. The sum that is left falls with λ and is linear between the ratios |uₖ| / wₖ at which one
/// more unknown comes to rest, so λ follows from the ratios in order.
fn project_on_budget(displacements: &mut [Vec3], weights: &[f64], total_mm: f64) {
    let lengths: Vec<f64> = displacements.iter().map(|way| way.length()).collect();
    let used: f64 = lengths.iter().zip(weights).map(|(length, w)| length * w).sum();
    if used <= total_mm {
        return;
    }
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    let ratio = |n: usize| lengths[n] / weights[n];
    order.sort_by(|&a, &b| ratio(b).total_cmp(&ratio(a)).then(a.cmp(&b)));
    // Of the unknowns that stay in motion: Σ w |u| and Σ w².
    let (mut sum, mut squares, mut shrink) = (0.0, 0.0, 0.0);
    for n in order {
        let (with_sum, with_squares) =
            (sum + weights[n] * lengths[n], squares + weights[n] * weights[n]);
        let shrink_with = (with_sum - total_mm) / with_squares;
        if shrink_with >= ratio(n) {
            break;
        }
        (sum, squares, shrink) = (with_sum, with_squares, shrink_with);
    }
    // Summed in another order, the excess may vanish in rounding; nothing is ever made longer.
    let shrink = shrink.max(0.0);
    for (n, way) in displacements.iter_mut().enumerate() {
        let left = lengths[n] - shrink * weights[n];
        *way = if total_mm > 0.0 && left > 0.0 { *way * (left / lengths[n]) } else { Vec3::ZERO };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1 from a linear congruence.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }

        fn ways(&mut self, count: usize, long: f64) -> Vec<Vec3> {
            (0..count).map(|_| Vec3::new(self.next(), self.next(), self.next()) * long).collect()
        }
    }

    fn used_mm(weights: &[f64], ways: &[Vec3]) -> f64 {
        weights.iter().zip(ways).map(|(w, way)| w * way.length()).sum()
    }

    /// What every projection on a convex set obeys: it is in it, nothing in it is in a direction
    /// that leads on to what is projected, and it stays where it is when projected again.
    fn check(limit: &Limit, within: impl Fn(&[Vec3]) -> bool, numbers: &mut Numbers) {
        let count = limit.len();
        for long in [1e-3, 1.0, 30.0, 1e4] {
            let given = numbers.ways(count, long);
            let mut found = given.clone();
            limit.project(&mut found);
            assert!(within(&found), "{limit:?} {found:?}");
            let mut again = found.clone();
            limit.project(&mut again);
            let moved = found.iter().zip(&again).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(moved <= 1e-12 * long, "{moved:e}");
            if within(&given) {
                assert_eq!(given, found);
            }
            for _ in 0..50 {
                let mut other = numbers.ways(count, long);
                limit.project(&mut other);
                let shrink = numbers.next().abs();
                let towards: f64 = (0..count)
                    .map(|n| (given[n] - found[n]).dot(other[n] * shrink - found[n]))
                    .sum();
                assert!(towards <= 1e-9 * long * long * count as f64, "{limit:?} {towards:e}");
            }
        }
    }

    #[test]
    fn projections_are_the_nearest_displacements_within_the_limit() {
        let mut numbers = Numbers(1);
        for count in [1, 2, 5, 40] {
            for round in 0..10 {
                let even = round % 2 == 0;
                let weights: Vec<f64> = (0..count)
                    .map(|_| if even { 1.0 } else { 0.1 + numbers.next().abs() })
                    .collect();
                let total_mm = if round == 9 { 0.0 } else { 5.0 * numbers.next().abs() };
                let budget = Limit::Budget { total_mm, weights: weights.clone() };
                check(
                    &budget,
                    |ways| used_mm(&weights, ways) <= total_mm * (1.0 + 1e-12),
                    &mut numbers,
                );
                let radii_mm: Vec<f64> =
                    (0..count).map(|_| numbers.next().max(0.0) * 10.0).collect();
                let each = Limit::Each { radii_mm: radii_mm.clone() };
                let within = |ways: &[Vec3]| {
                    ways.iter().zip(&radii_mm).all(|(way, r)| way.length() <= r * (1.0 + 1e-12))
                };
                check(&each, within, &mut numbers);
            }
        }
    }

    #[test]
    fn a_budget_is_spent_on_the_longest() {
        let ways = [5.0, -1.0, 3.0].map(|x| Vec3::X * x);
        let limit = |total_mm| Limit::Budget { total_mm, weights: vec![1.0; 3] };
        for (total_mm, expected) in
            [(2.0, [2.0, 0.0, 0.0]), (4.0, [3.0, 0.0, 1.0]), (7.5, [4.5, -0.5, 2.5])]
        {
            let mut found = ways;
            limit(total_mm).project(&mut found);
            let expected = expected.map(|x| Vec3::X * x);
            assert!(found.iter().zip(expected).all(|(a, b)| a.distance(b) < 1e-15), "{found:?}");
        }
    }
}
