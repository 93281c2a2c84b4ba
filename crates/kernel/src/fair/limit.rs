//! Limits of displacements, and the exact projections on them: the nearest displacements within.

use sheetwright_geometry::math::Vec3;

/// A limit of the displacements of the unknowns.
#[derive(Clone, Debug, PartialEq)]
pub enum Limit {
    /// One budget for all, equation (6): the sum of weight × displacement over the unknowns is at
    /// most `total_mm`, and each unknown has a limit of its own.
    Budget {
        /// The budget, mm; finite and not negative.
        total_mm: f64,
        /// The weight of each unknown, positive: 1 for a sample, for a control point the sum of the
        /// shares that samples have in it.
        weights: Vec<f64>,
        /// The limits, mm, not negative; infinite where the budget alone limits an unknown.
        radii_mm: Vec<f64>,
    },
    /// A limit for each unknown, mm; finite and not negative, 0 holds it fixed.
    Each {
        /// The limits.
        radii_mm: Vec<f64>,
    },
}

impl Limit {
    /// One budget for all, without other limits.
    pub fn budget(total_mm: f64, weights: Vec<f64>) -> Self {
        let radii_mm = vec![f64::INFINITY; weights.len()];
        Self::Budget { total_mm, weights, radii_mm }
    }

    /// The number of unknowns.
    pub fn len(&self) -> usize {
        match self {
            Self::Budget { radii_mm, .. } | Self::Each { radii_mm } => radii_mm.len(),
        }
    }

    /// Whether there are no unknowns.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether its numbers are valid limits.
    pub(super) fn is_valid(&self) -> bool {
        let length = |mm: &f64| mm.is_finite() && *mm >= 0.0;
        match self {
            Self::Budget { total_mm, weights, radii_mm } => {
                length(total_mm)
                    && weights.len() == radii_mm.len()
                    && weights.iter().all(|w| w.is_finite() && *w > 0.0)
                    && radii_mm.iter().all(|r| *r >= 0.0)
            }
            Self::Each { radii_mm } => radii_mm.iter().all(length),
        }
    }

    /// The farthest that one unknown may move, mm.
    pub(super) fn farthest_mm(&self) -> f64 {
        match self {
            Self::Budget { total_mm, weights, radii_mm } => {
                let each = weights.iter().zip(radii_mm).map(|(w, r)| r.min(total_mm / w));
                each.fold(0.0, f64::max)
            }
            Self::Each { radii_mm } => radii_mm.iter().copied().fold(0.0, f64::max),
        }
    }

    /// This limit, `factor` times as wide.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let scaled = |radii: &[f64]| radii.iter().map(|r| r * factor).collect();
        match self {
            Self::Budget { total_mm, weights, radii_mm } => Self::Budget {
                total_mm: total_mm * factor,
                weights: weights.clone(),
                radii_mm: scaled(radii_mm),
            },
            Self::Each { radii_mm } => Self::Each { radii_mm: scaled(radii_mm) },
        }
    }

    /// The share of the limit that displacements use, 0 ..= 1 within it.
    pub(super) fn used(&self, displacements: &[Vec3]) -> f64 {
        let of_each = |radii: &[f64]| {
            let free = displacements.iter().zip(radii).filter(|(_, radius)| **radius > 0.0);
            free.map(|(way, radius)| way.length() / radius).fold(0.0, f64::max)
        };
        match self {
            Self::Budget { total_mm, weights, radii_mm } if *total_mm > 0.0 => {
                let lengths = displacements.iter().zip(weights).map(|(way, w)| way.length() * w);
                (lengths.sum::<f64>() / total_mm).max(of_each(radii_mm))
            }
            Self::Budget { .. } => 0.0,
            Self::Each { radii_mm } => of_each(radii_mm),
        }
    }

    /// Moves the displacements to the nearest ones within the limit.
    ///
    /// # Panics
    /// Unless there is one for every unknown.
    pub fn project(&self, displacements: &mut [Vec3]) {
        assert_eq!(self.len(), displacements.len(), "one displacement an unknown");
        match self {
            Self::Budget { total_mm, weights, radii_mm } => {
                // Twice, since very long displacements lose the digits of the budget.
                project_on_budget(displacements, weights, radii_mm, *total_mm);
                project_on_budget(displacements, weights, radii_mm, *total_mm);
            }
            Self::Each { radii_mm } => {
                for (way, radius) in displacements.iter_mut().zip(radii_mm) {
                    *way = shortened(*way, *radius);
                }
            }
        }
    }
}

/// A displacement, shortened to at most `longest`.
fn shortened(way: Vec3, longest: f64) -> Vec3 {
    let length = way.length();
    if length > longest { way * (longest / length) } else { way }
}

/// The projection on Σ wₖ |uₖ| ≤ ε and |uₖ| ≤ rₖ shortens every uₖ by λ wₖ, to zero where it is no
/// longer than that, and then to rₖ. The remaining sum falls with λ and is linear between the
/// ratios
/// |uₖ| / wₖ and (|uₖ| − rₖ) / wₖ, so the two ratios between which it reaches ε give λ.
fn project_on_budget(displacements: &mut [Vec3], weights: &[f64], radii_mm: &[f64], total_mm: f64) {
    let count = displacements.len();
    let lengths: Vec<f64> = displacements.iter().map(|way| way.length()).collect();
    let left =
        |n: usize, shrink: f64| (lengths[n] - shrink * weights[n]).clamp(0.0, radii_mm[n].max(0.0));
    let sum_at = |shrink: f64| -> f64 { (0..count).map(|n| weights[n] * left(n, shrink)).sum() };
    let mut shrink = 0.0;
    if sum_at(0.0) > total_mm {
        let ratios = |n: usize| [lengths[n] - radii_mm[n], lengths[n]].map(|x| x / weights[n]);
        let mut bends: Vec<f64> = (0..count).flat_map(ratios).filter(|&bend| bend > 0.0).collect();
        bends.sort_by(f64::total_cmp);
        let above = bends.partition_point(|&bend| sum_at(bend) > total_mm);
        let low = if above == 0 { 0.0 } else { bends[above - 1] };
        let high = bends.get(above).copied().unwrap_or(low);
        // Between the two the same unknowns are at rest, in motion or at their limits.
        let middle = 0.5 * (low + high);
        let (mut sum, mut squares) = (0.0, 0.0);
        for n in 0..count {
            let free = lengths[n] - middle * weights[n];
            if free >= radii_mm[n] {
                sum += weights[n] * radii_mm[n];
            } else if free > 0.0 {
                sum += weights[n] * lengths[n];
                squares += weights[n] * weights[n];
            }
        }
        shrink = if squares > 0.0 { ((sum - total_mm) / squares).clamp(low, high) } else { high };
    }
    for (n, way) in displacements.iter_mut().enumerate() {
        if total_mm <= 0.0 {
            *way = Vec3::ZERO;
        } else if lengths[n] > 0.0 && left(n, shrink) < lengths[n] {
            *way *= left(n, shrink) / lengths[n];
        }
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

    /// Checks the properties of a projection on a convex set: the result is in the set, no element
    /// of the set is nearer (the variational inequality), and projecting again does not move it.
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
                let radii_mm: Vec<f64> =
                    (0..count).map(|_| numbers.next().max(0.0) * 10.0).collect();
                let in_budget = |ways: &[Vec3]| used_mm(&weights, ways) <= total_mm * (1.0 + 1e-12);
                let budget = Limit::budget(total_mm, weights.clone());
                check(&budget, in_budget, &mut numbers);
                let in_both = |ways: &[Vec3]| {
                    let mut each = ways.iter().zip(&radii_mm);
                    in_budget(ways) && each.all(|(way, r)| way.length() <= r * (1.0 + 1e-12))
                };
                let both = Limit::Budget {
                    total_mm,
                    weights: weights.clone(),
                    radii_mm: radii_mm.clone(),
                };
                check(&both, in_both, &mut numbers);
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
        let limit = |total_mm| Limit::budget(total_mm, vec![1.0; 3]);
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
