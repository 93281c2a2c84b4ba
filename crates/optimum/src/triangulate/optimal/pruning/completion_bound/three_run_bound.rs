//! Lower bounds on the prices of wide triangles, from the bounds of three bundles.

use crate::cost::{LANES, Lanes};

/// The share that a price is lowered by before it is rounded to single precision, which may add
/// 2⁻²⁴.
const ROUNDED: f64 = 1e-6;

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

/// Lower bounds on the prices of wide triangles, rounded down: for each first and second run, the
/// groups of third runs from the group of the first on, side by side.
pub(super) struct Wide {
    prices: Vec<f32>,
    /// The places where those of each first run begin, and the number of all.
    starts: Vec<usize>,
}

impl Wide {
    /// Memory for so many runs, bytes.
    pub(super) fn bytes(runs: usize) -> u64 {
        let width = runs.div_ceil(LANES);
        let of_first = |a: usize| ((runs - a - 1) * (width - a / LANES) * LANES) as u64;
        (0..runs).map(of_first).sum::<u64>() * size_of::<f32>() as u64
    }

    fn starts(n: usize) -> Vec<usize> {
        let width = n.div_ceil(LANES);
        let mut starts = vec![0];
        for a in 0..n {
            starts.push(starts[a] + (n - a - 1) * (width - a / LANES) * LANES);
        }
        starts
    }

    pub(super) fn new(n: usize) -> Self {
        let starts = Self::starts(n);
        Self { prices: vec![f32::INFINITY; starts[n]], starts }
    }

    /// Where the group of the third run stands.
    #[inline(always)]
    pub(super) fn place(&self, a: usize, k: usize, group: usize) -> usize {
        let width = (self.starts.len() - 1).div_ceil(LANES);
        let groups = (k - a - 1) * (width - a / LANES) + group - a / LANES;
        self.starts[a] + groups * LANES
    }

    /// Sets those of a group, rounded down.
    #[inline(always)]
    pub(super) fn set(&mut self, place: usize, prices: &Lanes) {
        for lane in 0..LANES {
            self.prices[place + lane] = (prices[lane] * (1.0 - ROUNDED)) as f32;
        }
    }

    #[inline(always)]
    pub(super) fn of(&self, place: usize) -> Lanes {
        let mut prices = [0.0; LANES];
        for n in 0..LANES {
            prices[n] = f64::from(self.prices[place + n]);
        }
        prices
    }
}

/// The distance of a value from an interval, from its distances above and below.
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
        prices[n] = rungs + fold * (apart[n] / 6.0);
    }
    prices
}
