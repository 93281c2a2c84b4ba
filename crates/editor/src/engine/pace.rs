//! How many samples panels get while the hand moves.
//!
//! Work grows at least like the square of the samples, so the next fineness is twice or half as many:
//! twice where that should still leave time, half where the last answer came late, or was stopped since
//! the hand had moved on. Small designs are soon shown with all their samples, large ones never.

use web_time::Duration;

/// Samples of a panel at first, and at the least.
const LEAST: usize = 96;
/// An answer within this time is followed by one with twice the samples, which takes four times as
/// long or more: about half of a frame.
const EARLY: Duration = Duration::from_millis(2);
/// An answer after this time is followed by one with half the samples: most of a frame.
const LATE: Duration = Duration::from_millis(12);

/// How fast the work goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pace {
    samples: usize,
}

impl Default for Pace {
    fn default() -> Self {
        Self { samples: LEAST }
    }
}

impl Pace {
    /// The most samples for a panel.
    pub(super) fn samples(self) -> usize {
        self.samples
    }

    /// Learns how long the panels took with so many; `None` where they were stopped. `most` is what a
    /// panel of the design has in all, at the most.
    pub(super) fn took(&mut self, time: Option<Duration>, most: usize) {
        match time {
            Some(time) if time <= EARLY && self.samples < most => self.samples *= 2,
            Some(time) if time <= LATE => {}
            _ => self.samples = (self.samples / 2).max(LEAST),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The samples of a design after so many answers, where a sample squared takes so many
    /// nanoseconds.
    fn after(answers: usize, nanoseconds: u64, most: usize) -> Vec<usize> {
        let mut pace = Pace::default();
        let next = |_| {
            let samples = pace.samples();
            let squared = samples.min(most).pow(2) as u64;
            pace.took(Some(Duration::from_nanos(nanoseconds * squared)), most);
            samples
        };
        (0..answers).map(next).collect()
    }

    #[test]
    fn small_designs_are_soon_shown_with_all_their_samples() {
        assert_eq!(after(5, 30, 300), [96, 192, 384, 384, 384]);
        assert_eq!(after(3, 30, 90), [96, 96, 96]);
    }

    #[test]
    fn a_fineness_that_leaves_time_stays() {
        for nanoseconds in [1, 10, 100, 1000] {
            let samples = after(40, nanoseconds, 100_000);
            assert_eq!(samples[20..].iter().min(), samples[20..].iter().max(), "{nanoseconds}");
            let squared = samples[39].pow(2) as u64;
            let takes = Duration::from_nanos(nanoseconds * squared);
            assert!(takes > EARLY && takes <= LATE, "{takes:?}");
        }
    }

    #[test]
    fn what_is_late_or_stopped_gets_coarser() {
        let mut pace = Pace { samples: 384 };
        pace.took(Some(Duration::from_millis(30)), 400);
        assert_eq!(pace.samples(), 192);
        pace.took(None, 400);
        assert_eq!(pace.samples(), LEAST);
        pace.took(None, 400);
        assert_eq!(pace.samples(), LEAST);
    }
}
