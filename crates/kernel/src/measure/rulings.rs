//! Which rungs lie beside a ruling.
//!
//! Rungs end at samples, rulings anywhere between. Along a ruling, the tangents of the boundary at
//! both ends lie in one plane with it. A rung whose end lies off the ruling to one side is warped
//! one way, and one off to the other side is warped the other way. So if the way turns over from a
//! rung to one that ends a sample farther, a ruling lies between, and the warp of the rung is that
//! of the samples and not of the surface. On a strip that is twisted it does not turn over.

use crate::surface::Surface;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::unit;
use sheetwright_optimum::cost::Prices;
use sheetwright_optimum::rung::Rung;
use std::ops::Range;

/// The ruling may lie so far beyond the next sample, as a share of the step to it: where samples
/// face each other, rounding decides on which side of them it lies.
const BEYOND: f64 = 0.01;

/// A surface whose rulings are looked for.
pub(super) struct Rulings<'a> {
    surface: &'a Surface,
    prices: &'a Prices,
    /// The samples before and after each on its loop.
    beside: Vec<[SampleIndex; 2]>,
}

impl<'a> Rulings<'a> {
    /// Those of a surface with the prices of the boundary that it spans.
    pub(super) fn new(surface: &'a Surface, prices: &'a Prices) -> Self {
        let beside = |of_loop: &Range<usize>| {
            let (start, length) = (of_loop.start, of_loop.len());
            let at = move |n: usize| SampleIndex::new(start + n % length);
            (0..length).map(move |n| [at(n + length - 1), at(n + 1)])
        };
        let beside = surface.connectivity().loops().iter().flat_map(beside).collect();
        Self { surface, prices, beside }
    }

    /// Whether a rung from one end of this one to a sample beside the other is warped the other
    /// way, or not at all; or this one cuts off a single sample, towards which rulings get shorter
    /// and shorter.
    pub(super) fn has_one_beside(&self, rung: Rung) -> bool {
        let [low, high] = rung.ends();
        let is_rung =
            |a: SampleIndex, b: SampleIndex| a != b && !self.prices.neighbours(a.get(), b.get());
        if self.beside[low.get()].iter().any(|&between| !is_rung(between, high)) {
            return true;
        }
        let Some(here) = self.way([low, high]) else { return false };
        let moved = |end: SampleIndex, other: SampleIndex| {
            self.beside[end.get()]
                .into_iter()
                .filter(move |&a| is_rung(a, other))
                .map(move |a| [a, other])
        };
        let mut ways = moved(low, high).chain(moved(high, low)).filter_map(|ends| self.way(ends));
        ways.any(|way| way * here <= BEYOND * here * here)
    }

    /// The sine of the warp angle between two samples, positive where the tangent plane turns like
    /// a right-handed screw; `None` without tangent planes.
    fn way(&self, [a, b]: [SampleIndex; 2]) -> Option<f64> {
        let [low, high] = [a.min(b), a.max(b)];
        let planes = self.prices.planes(low.get(), high.get())?;
        let along = unit(self.surface.position(high) - self.surface.position(low))?;
        let [at_low, at_high] = planes.at_ends;
        Some(at_low.cross(at_high).dot(along))
    }
}
