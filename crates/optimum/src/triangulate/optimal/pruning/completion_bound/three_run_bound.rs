//! Lower bounds on the prices of wide triangles, from the bounds of three bundles.

use super::normals::SLACK;
use crate::cost::{LANES, Lanes, QUANTUM};

/// The rungs of bundles that begin at one run and end at [`LANES`] runs in a row.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Rungs {
    /// Lower bounds on their prices.
    pub(super) least: Lanes,
    /// The boxes around their N, by axis.
    pub(super) lower: [Lanes; 3],
    pub(super) upper: [Lanes; 3],
}

impl Rungs {
    pub(super) const NONE: Self = Self {
        least: [f64::INFINITY; LANES],
        lower: [[f64::INFINITY; LANES]; 3],
        upper: [[f64::NEG_INFINITY; LANES]; 3],
    };

    /// Those of one bundle in all lanes.
    #[inline(always)]
    pub(super) fn all_like(&self, lane: usize) -> Self {
        let all = |of: &Lanes| [of[lane]; LANES];
        let by_axis = |of: &[Lanes; 3]| [all(&of[0]), all(&of[1]), all(&of[2])];
        Self { least: all(&self.least), lower: by_axis(&self.lower), upper: by_axis(&self.upper) }
    }
}

/// How far a value is from an interval that it is so much above or below of.
#[inline(always)]
fn gap_of(above: f64, below: f64) -> f64 {
    let gap = if above > below { above } else { below };
    if gap > 0.0 { gap } else { 0.0 }
}

/// What wide triangles cost at the least for ν = `fold`, of which these are the sides: for their
/// folds what the N of their sides leave, taken two at a time, as in `normals::least_fold`.
#[inline(always)]
pub(super) fn least_wide(fold: f64, sides: [&Rungs; 3]) -> Lanes {
    let [first, second, across] = sides;
    let mut apart = [0.0; LANES];
    for (one, other) in [(first, second), (first, across), (second, across)] {
        for axis in 0..3 {
            for n in 0..LANES {
                let above = one.lower[axis][n] - other.upper[axis][n];
                let below = other.lower[axis][n] - one.upper[axis][n];
                let gap = gap_of(above, below);
                apart[n] += gap * gap;
            }
        }
    }
    let mut prices = [0.0; LANES];
    for n in 0..LANES {
        let rungs = 0.5 * (first.least[n] + second.least[n] + across.least[n]);
        let folds = fold * (apart[n] / 6.0 - SLACK) - QUANTUM;
        prices[n] = rungs + if folds > 0.0 { folds } else { 0.0 };
    }
    prices
}
