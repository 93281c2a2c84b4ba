//! Rungs: straight segments between two samples of a boundary that are no neighbours.

mod visible;

pub use visible::Visibility;

use sheetwright_geometry::index::SampleIndex;
use std::fmt;

/// A segment between two samples, the lower number first; prints as `⟨3,17⟩`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Rung {
    low: SampleIndex,
    high: SampleIndex,
}

impl Rung {
    /// The rung between two samples, in either order.
    ///
    /// # Panics
    /// If both are the same sample.
    pub fn new(a: usize, b: usize) -> Self {
        assert_ne!(a, b, "a rung joins two samples");
        Self { low: SampleIndex::new(a.min(b)), high: SampleIndex::new(a.max(b)) }
    }

    /// Its two samples, the lower number first.
    pub fn ends(self) -> [SampleIndex; 2] {
        [self.low, self.high]
    }

    /// Whether two rungs of one closed loop cross: their ends alternate round the loop.
    pub fn crosses(self, other: Self) -> bool {
        let inside = |s: SampleIndex| self.low < s && s < self.high;
        let beside = |s: SampleIndex| s == self.low || s == self.high;
        let [a, b] = other.ends();
        !beside(a) && !beside(b) && inside(a) != inside(b)
    }
}

impl fmt::Display for Rung {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "⟨{},{}⟩", self.low.get(), self.high.get())
    }
}

impl fmt::Debug for Rung {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rungs_cross_when_their_ends_alternate() {
        assert!(Rung::new(0, 4).crosses(Rung::new(2, 6)));
        assert!(!Rung::new(0, 4).crosses(Rung::new(4, 6)));
        assert!(!Rung::new(0, 4).crosses(Rung::new(1, 3)));
        assert_eq!(Rung::new(7, 2).to_string(), "⟨2,7⟩");
    }
}
