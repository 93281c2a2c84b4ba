//! Lower bounds on the prices of triangles on edges of the boundary, sixteen at a time.

use crate::cost::{LANES, Lanes, QUANTUM, cross, dot};

/// Triangles one side of which is an edge of the boundary, on loops whose members are numbered in
/// order.
pub(super) struct OnEdges<'a> {
    /// From the lowest corner of each to the two others, by axis.
    pub(super) offsets: [&'a [Lanes; 3]; 2],
    /// N of its two other sides, by axis; zero for an edge.
    pub(super) means: [&'a [Lanes; 3]; 2],
    /// How many of them are rungs.
    pub(super) rungs: Lanes,
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

    /// No more than the price of each with the weight `fold`, and hardly less where folds are
    /// slight.
    ///
    /// With c = n · s for the normal n and the sum s of the N, and r rungs, x = r² − c² says it
    /// without a root: r − c = x / (r + c), and c ≤ r − x / 2r, so that
    /// r − c ≥ x / 2r (1 + x / 4r²). Prices are rounded to the quantum.
    #[inline(always)]
    pub(super) fn least_prices(&self, fold: f64) -> Lanes {
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            let area_vector = cross(self.side(0, n), self.side(1, n));
            let (square, along) = (dot(area_vector, area_vector), dot(area_vector, self.sum(n)));
            // Without area c is −r, and where it is negative, r − c is more than what is said of 0.
            let cosine_squared = if along > 0.0 { along * along / square } else { 0.0 };
            // ½ r⁻¹ and ¼ r⁻².
            let [half, quarter] = if self.rungs[n] > 1.5 { [0.25, 0.0625] } else { [0.5, 0.25] };
            let x = self.rungs[n] * self.rungs[n] - cosine_squared;
            // Nothing is said where squares leave the range of numbers.
            let x = if x > 0.0 { x } else { 0.0 };
            let price = fold * (x * half) * (1.0 + x * quarter) - QUANTUM;
            prices[n] = if price > 0.0 { price } else { 0.0 };
        }
        prices
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::{PriceOptions, Prices};
    use crate::test_boundaries::{bent_square, nearly_straight, waving};
    use sheetwright_geometry::boundary::Boundary;
    use sheetwright_geometry::math::Vec3;

    fn priced(boundary: Boundary) -> Prices {
        Prices::new(&boundary, None, PriceOptions::default())
    }

    #[test]
    fn no_triangle_on_an_edge_costs_less_than_is_said() {
        let (mut hardly_less, mut all) = (0, 0);
        for (prices, fold) in [0.1, 1.0, 10.0].into_iter().flat_map(|fold| {
            let loops = [bent_square(100), waving(400, 0.3), waving(400, 0.0)];
            let slivers = [nearly_straight(1e-5), nearly_straight(1e-6)];
            loops.into_iter().chain(slivers).map(move |boundary| (priced(boundary), fold))
        }) {
            let prices = prices.with_fold(fold);
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
                        &prices.offsets(i, &prices.far_ends(first)),
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
}
