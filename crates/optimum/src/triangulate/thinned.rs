//! Thinning: the loops of some of the samples, whose optimum is near to that of all samples and is
//! found far sooner (coarse to fine \[Raphael2001\]).

use super::{Rule, Terms};
use crate::cost::Prices;
use crate::rung::Visibility;
use std::ops::Range;

/// Corners are kept while there are at most as many as one in so many samples.
const SAMPLES_A_CORNER: usize = 8;

/// The samples of a loop that are kept: the first one, the corners, and about one in `thinning`
/// between.
pub(super) fn kept(prices: &Prices, of_loop: &Range<usize>, thinning: usize) -> Vec<usize> {
    let Range { start, end } = *of_loop;
    let mut fixed: Vec<usize> =
        (start + 1..end).filter(|&i| prices.smooth_end(i).2 < 0.0).collect();
    if fixed.len() * SAMPLES_A_CORNER > of_loop.len() {
        fixed.clear();
    }
    fixed.push(end);
    let mut kept = Vec::new();
    let mut from = start;
    for to in fixed {
        let steps = (to - from).div_ceil(thinning);
        kept.extend((0..steps).map(|step| from + step * (to - from) / steps));
        from = to;
    }
    kept
}

/// The terms of loops that keep only some of the samples.
pub(super) struct Thinned {
    prices: Prices,
    visibility: Visibility,
    forced: bool,
    rule: Rule,
    memory: u64,
}

impl Thinned {
    /// Divides the weight of folds by the thinning: in the loop of all samples a rung of a twisted
    /// part becomes that many rungs, while a fold between two flat parts stays one.
    pub(super) fn with_cheaper_folds(self, thinning: usize) -> Self {
        let fold = self.prices.options().fold / thinning as f64;
        Self { prices: self.prices.with_fold(fold), ..self }
    }

    /// Their terms without the bar: fewer samples may have no triangulation below it, and the bound
    /// needs one.
    pub(super) fn terms(&self) -> Terms<'_> {
        let terms = Terms::new(&self.prices, &self.visibility, self.forced).within(self.memory);
        Terms { rule: self.rule, ..terms }
    }
}

impl Terms<'_> {
    /// The terms of the loops of some of the samples: those of each are a range of `kept`.
    pub(super) fn thinned(&self, kept: &[usize], loops: &[Range<usize>]) -> Thinned {
        Thinned {
            prices: self.prices.thinned(kept, loops),
            visibility: self.visibility.thinned(kept),
            forced: self.forced,
            rule: self.rule,
            memory: self.memory,
        }
    }
}
