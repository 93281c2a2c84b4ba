//! The order in which divisions are looked at, part by part: a search that can be left after every
//! part, and gone on with later.

use crate::check::{CutWay, Verdict};

/// A panel is divided into so many parts at the most.
pub(super) const MOST_PARTS: usize = 4;

/// A division, as far as its parts are judged: all of them take their shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Division {
    pub(super) way: CutWay,
    pub(super) parts: usize,
    /// The largest strain of a part, without unit.
    pub(super) strain: f64,
    /// The worst verdict on a part.
    pub(super) verdict: Verdict,
}

impl Division {
    /// One of which no part is judged yet.
    fn new(way: CutWay, parts: usize) -> Self {
        Self { way, parts, strain: 0.0, verdict: Verdict::Bends }
    }
}

/// A search for the division with the fewest parts; of two with as many, that with the better
/// verdict.
#[derive(Clone, Debug)]
pub(in crate::make) struct Search {
    /// The division that is looked at.
    now: Division,
    /// So many parts of it are judged.
    judged: usize,
    /// The best with as many parts of which all parts are judged.
    best: Option<Division>,
}

impl Default for Search {
    fn default() -> Self {
        Self { now: Division::new(CutWay::Across, 2), judged: 0, best: None }
    }
}

/// What a step of a search comes to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// There is more to look at.
    GoesOn,
    /// The division that is advised; `None` where none helps.
    Over(Option<Division>),
}

impl Search {
    /// Judges one part. `judge` takes the division and the number of the part, and gives its strain
    /// and the verdict on it, if it takes its shape.
    pub(super) fn step<E>(
        &mut self,
        judge: impl FnOnce(&Division, usize) -> Result<Option<(f64, Verdict)>, E>,
    ) -> Result<Step, E> {
        if let Some((strain, verdict)) = judge(&self.now, self.judged)? {
            self.judged += 1;
            self.now.strain = self.now.strain.max(strain);
            if rank(verdict) > rank(self.now.verdict) {
                self.now.verdict = verdict;
            }
            if self.judged < self.now.parts {
                return Ok(Step::GoesOn);
            }
            if self.best.is_none_or(|best| rank(self.now.verdict) < rank(best.verdict)) {
                self.best = Some(self.now);
            }
        }
        let parts = self.now.parts;
        self.judged = 0;
        self.now = match self.now.way {
            CutWay::Across => Division::new(CutWay::Lengthwise, parts),
            CutWay::Lengthwise if self.best.is_none() && parts < MOST_PARTS => {
                Division::new(CutWay::Across, parts + 1)
            }
            CutWay::Lengthwise => return Ok(Step::Over(self.best)),
        };
        Ok(Step::GoesOn)
    }
}

/// How good a verdict is, the best first.
pub(super) fn rank(verdict: Verdict) -> usize {
    Verdict::ALL.iter().position(|other| *other == verdict).unwrap_or(Verdict::ALL.len())
}
