//! The value of a displacement with triangulations held: the price, the excess of warp angles and
//! the zig-zag, with their slopes.

use super::Weights;
use super::motion::{Motion, carry, displacement, moved};
use super::state::PanelState;
use crate::design::VaryGoal;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{Vec3, sin};
use sheetwright_optimum::cost::{Piece, PriceOptions, Prices, SampleSlope};
use sheetwright_optimum::rung::Rung;
use sheetwright_optimum::triangulate::Triangulation;

/// Lower limit of the sines of warp angles, so that a rung whose planes are opposite has a slope.
const LEAST_SINE: f64 = 1e-6;

/// The rungs and triangles of a panel, as the sums walk over them.
struct Net {
    rungs: Vec<[usize; 2]>,
    /// Corners, and the rungs among the sides.
    triangles: Vec<([usize; 3], [Option<usize>; 3])>,
}

impl Net {
    fn new(triangulation: &Triangulation) -> Self {
        let number = |a: SampleIndex, b: SampleIndex| {
            triangulation.rungs.binary_search(&Rung::new(a.get(), b.get())).ok()
        };
        let triangles = triangulation.triangles.iter().map(|&[i, k, j]| {
            ([i, k, j].map(SampleIndex::get), [number(i, k), number(k, j), number(i, j)])
        });
        Self {
            rungs: triangulation.rungs.iter().map(|r| r.ends().map(SampleIndex::get)).collect(),
            triangles: triangles.collect(),
        }
    }
}

/// One panel with its triangulation held.
pub(super) struct PanelValue<'a> {
    boundary: &'a Boundary,
    plane: Option<&'a SupportingPlane>,
    price: PriceOptions,
    motions: &'a [Motion],
    follows: bool,
    net: Net,
    /// The unknowns of the panel's current boundary.
    base: &'a [Vec3],
}

impl<'a> PanelValue<'a> {
    /// The value of a panel whose current boundary belongs to the unknowns `base`.
    pub(super) fn new(panel: &'a PanelState, base: &'a [Vec3]) -> Self {
        Self {
            boundary: &panel.boundary,
            plane: panel.plane.as_ref(),
            price: panel.triangulate.price,
            motions: &panel.motions,
            follows: panel.follows,
            net: Net::new(&panel.triangulation),
            base,
        }
    }

    /// The displacements of the unknowns from those of the current boundary.
    fn onward(&self, unknowns: &[Vec3]) -> Vec<Vec3> {
        unknowns.iter().zip(self.base).map(|(to, from)| *to - *from).collect()
    }

    /// The value at the unknowns; adds its slopes. Infinite where a tangent has lost its direction.
    pub(super) fn add(&self, weights: &Weights, unknowns: &[Vec3], with: &mut [Vec3]) -> f64 {
        let start = self.boundary.samples();
        let onward = self.onward(unknowns);
        let Some(samples) = moved(start, self.motions, &onward) else {
            return f64::INFINITY;
        };
        let boundary = self.boundary.with_samples(samples);
        let mut slopes = vec![SampleSlope::default(); boundary.len()];
        let price = self.price(&boundary, weights, &mut slopes);
        carry(start, boundary.samples(), self.motions, &onward, &slopes, with);
        price
            + if weights.fairness > 0.0 {
                self.zig_zag(weights.fairness, unknowns, with)
            } else {
                0.0
            }
    }

    fn price(&self, boundary: &Boundary, weights: &Weights, slopes: &mut [SampleSlope]) -> f64 {
        let prices = Prices::new(boundary, self.plane, self.price);
        let rungs: Vec<_> = self.net.rungs.iter().map(|&[i, j]| prices.sloped_rung(i, j)).collect();
        let mean =
            |n: Option<usize>| n.and_then(|n| rungs[n].planes).map_or(Vec3::ZERO, |p| p.mean);
        let mut with_means = vec![Vec3::ZERO; rungs.len()];
        let mut total = 0.0;
        for (corners, sides) in &self.net.triangles {
            let sum = sides.iter().map(|&side| mean(side)).sum();
            let count = sides.iter().flatten().count() as f64;
            let (price, with_sum) = prices.carry_triangle(*corners, count, sum, slopes);
            total += price;
            sides.iter().flatten().for_each(|&side| with_means[side] += with_sum);
        }
        for (rung, with_mean) in rungs.iter().zip(with_means) {
            let Some(planes) = rung.planes else {
                total += 2.0;
                continue;
            };
            total += weights.twist * planes.twist;
            let mut with_twist = weights.twist;
            if let (VaryGoal::Warp { largest }, false) = (weights.goal, self.follows) {
                let warp = planes.warp();
                let excess = (warp - largest).max(0.0);
                total += weights.excess * excess * excess;
                with_twist += weights.excess * 2.0 * excess / sin(warp).max(LEAST_SINE);
            }
            prices.carry_rung(rung, with_twist, with_mean, slopes);
        }
        total
    }

    /// The squares of the angles by which the edges of the boundary turn against one another where
    /// the unknowns have moved them, at samples that are no corners. Slipping along a curve is no
    /// zig-zag.
    fn zig_zag(&self, weight: f64, unknowns: &[Vec3], with: &mut [Vec3]) -> f64 {
        let boundary = self.boundary;
        let samples = boundary.samples();
        let motions = self.motions;
        let way = |n: usize| displacement(&motions[n].position, unknowns);
        let mut total = 0.0;
        for (n, sample) in samples.iter().enumerate() {
            let (before, after) = (boundary.previous(n), boundary.next(n));
            let at = |n: usize| samples[n].position;
            let spacing = 0.5 * at(after).distance(at(before));
            let fixed = [before, n, after].iter().all(|&n| motions[n].position.is_empty());
            if Sample::is_corner(sample) || fixed || spacing == 0.0 {
                continue;
            }
            let turn = (way(before) + way(after) - way(n) * 2.0) / spacing;
            total += weight * turn.length_squared();
            let with_turn = turn * (2.0 * weight / spacing);
            for (n, slope) in [(before, with_turn), (after, with_turn), (n, with_turn * -2.0)] {
                for share in &motions[n].position {
                    with[share.unknown] += slope * share.factor;
                }
            }
        }
        total
    }

    /// Which piece of its price is active on each rung, and whether its warp angle is above the
    /// goal's.
    pub(super) fn pieces(&self, goal: VaryGoal, unknowns: &[Vec3]) -> Option<Vec<(Piece, bool)>> {
        let samples = moved(self.boundary.samples(), self.motions, &self.onward(unknowns))?;
        let boundary = self.boundary.with_samples(samples);
        let prices = Prices::new(&boundary, self.plane, self.price);
        let largest = match goal {
            VaryGoal::Warp { largest } if !self.follows => largest,
            _ => f64::INFINITY,
        };
        let piece = |&[i, j]: &[usize; 2]| {
            let rung = prices.sloped_rung(i, j);
            (rung.piece, rung.planes.is_some_and(|planes| planes.warp() > largest))
        };
        Some(self.net.rungs.iter().map(piece).collect())
    }
}
