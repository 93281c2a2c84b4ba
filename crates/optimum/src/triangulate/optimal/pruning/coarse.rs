//! Thinning: the loop of about every fourth sample, whose optimum is near to that of all samples.

use crate::cost::Prices;
use crate::rung::Visibility;
use crate::triangulate::{Rule, Terms};
use std::slice;

/// One sample in about so many is kept.
const THINNING: usize = 4;
/// Corners are kept while there are at most as many as one in so many samples.
const SAMPLES_A_CORNER: usize = 8;

/// The samples of a thinned loop: the first one, the corners, and about one in four between.
pub(super) fn kept(terms: &Terms<'_>) -> Vec<usize> {
    let m = terms.prices.len();
    let mut fixed: Vec<usize> = (1..m).filter(|&i| terms.prices.smooth_end(i).2 < 0.0).collect();
    if fixed.len() * SAMPLES_A_CORNER > m {
        fixed.clear();
    }
    fixed.push(m);
    let mut kept = Vec::new();
    let mut from = 0;
    for to in fixed {
        let steps = (to - from).div_ceil(THINNING);
        kept.extend((0..steps).map(|step| from + step * (to - from) / steps));
        from = to;
    }
    kept
}

/// The terms of a loop that keeps only some of the samples.
pub(super) struct Thinned {
    prices: Prices,
    visibility: Visibility,
    forced: bool,
    rule: Rule,
    memory: u64,
}

impl Thinned {
    /// Divides the weight of folds by [`THINNING`]: in the loop of all samples a rung of a twisted
    /// part becomes that many rungs, while a fold between two flat parts stays one.
    pub(super) fn with_cheaper_folds(self) -> Self {
        let fold = self.prices.options().fold / THINNING as f64;
        Self { prices: self.prices.with_fold(fold), ..self }
    }

    /// Its terms without the bar: fewer samples may have no triangulation below it, and the bound
    /// needs one.
    pub(super) fn terms(&self) -> Terms<'_> {
        let terms = Terms::new(&self.prices, &self.visibility, self.forced).within(self.memory);
        Terms { rule: self.rule, ..terms }
    }
}

impl Terms<'_> {
    /// The terms of the loop of some of the samples.
    pub(super) fn thinned(&self, kept: &[usize]) -> Thinned {
        Thinned {
            prices: self.prices.thinned(kept, slice::from_ref(&(0..kept.len()))),
            visibility: self.visibility.thinned(kept),
            forced: self.forced,
            rule: self.rule,
            memory: self.memory,
        }
    }
}
