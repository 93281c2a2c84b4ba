//! When to save.

use std::time::Duration;
use web_time::Instant;

/// The least time from one save to the next. A change after a rest is saved at once, and changes
/// that follow each other are saved together, so that nothing older than this waits for its save;
/// a save under way may add what it takes.
pub const PAUSE: Duration = Duration::from_millis(500);

/// What is to be done now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Due {
    /// Nothing has changed since the last save.
    Nothing,
    /// Save.
    Now,
    /// Ask again after this time.
    In(Duration),
}

/// Says when to save.
#[derive(Clone, Debug)]
pub struct Pace {
    saved_version: u64,
    saved_at: Option<Instant>,
}

impl Pace {
    /// With the version that needs no save: that of the document when it is new or opened.
    pub fn new(version: u64) -> Self {
        Self { saved_version: version, saved_at: None }
    }

    /// What is to be done at this time with this version. When it says [`Due::Now`], it counts on
    /// the version being saved.
    pub fn due(&mut self, version: u64, now: Instant) -> Due {
        if version == self.saved_version {
            return Due::Nothing;
        }
        let since = self.saved_at.map(|at| now.saturating_duration_since(at));
        match since.and_then(|since| PAUSE.checked_sub(since)).filter(|left| !left.is_zero()) {
            Some(left) => Due::In(left),
            None => {
                self.saved_version = version;
                self.saved_at = Some(now);
                Due::Now
            }
        }
    }

    /// The last save has failed: the version still waits.
    pub fn failed(&mut self) {
        // Versions count up, so none is this one again.
        self.saved_version = u64::MAX;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ms(n: u64) -> Duration {
        Duration::from_millis(n)
    }

    #[test]
    fn a_change_after_a_rest_is_saved_at_once() {
        let start = Instant::now();
        let mut pace = Pace::new(0);
        assert_eq!(pace.due(0, start), Due::Nothing);
        assert_eq!(pace.due(1, start + ms(10)), Due::Now);
        assert_eq!(pace.due(1, start + ms(20)), Due::Nothing);
        assert_eq!(pace.due(2, start + ms(9000)), Due::Now);
    }

    #[test]
    fn changes_that_follow_each_other_are_saved_together() {
        let start = Instant::now();
        let mut pace = Pace::new(0);
        let mut saves = Vec::new();
        // The oldest change that is not saved, while a hand drags for ten seconds at 60 frames.
        let (mut waiting, mut longest) = (None, ms(0));
        for frame in 0..600_u64 {
            let now = start + Duration::from_micros(16_667 * frame);
            let since = *waiting.get_or_insert(now);
            longest = longest.max(now - since);
            if pace.due(frame + 1, now) == Due::Now {
                saves.push(frame);
                waiting = None;
            }
        }
        assert!((19..=21).contains(&saves.len()), "{saves:?}");
        assert!(longest < PAUSE + ms(17), "{longest:?}");
    }

    #[test]
    fn the_last_change_is_not_forgotten() {
        let start = Instant::now();
        let mut pace = Pace::new(0);
        assert_eq!(pace.due(1, start), Due::Now);
        let Due::In(left) = pace.due(2, start + ms(100)) else { panic!("too early") };
        assert_eq!(left, ms(400));
        assert_eq!(pace.due(2, start + ms(100) + left), Due::Now);
    }

    #[test]
    fn what_failed_is_tried_again() {
        let start = Instant::now();
        let mut pace = Pace::new(0);
        assert_eq!(pace.due(1, start), Due::Now);
        pace.failed();
        assert_eq!(pace.due(1, start + ms(10)), Due::In(ms(490)));
        assert_eq!(pace.due(1, start + ms(500)), Due::Now);
    }

    #[test]
    fn a_clock_that_goes_back_stops_nothing() {
        let start = Instant::now() + ms(10_000);
        let mut pace = Pace::new(0);
        assert_eq!(pace.due(1, start), Due::Now);
        assert_eq!(pace.due(2, start - ms(5000)), Due::In(PAUSE));
        assert_eq!(pace.due(2, start + PAUSE), Due::Now);
    }
}
