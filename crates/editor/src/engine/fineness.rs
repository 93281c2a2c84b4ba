//! How fine panels are made while the hand moves.
//!
//! There is to be an answer for every frame, and nobody knows beforehand how long one takes: it
//! depends on the design, the handle and the machine. So it is measured. The first answers have few
//! samples; what is early enough is followed by twice as many, up to all that the design asks for,
//! and what is late again and again, by half as many.
//!
//! Another fineness makes all panels afresh, the next answer those alone that the hand changes. So
//! the first answer of a fineness is no measure for the next ones, but for what the first of the
//! next fineness would take, for which the picture stands still. What was too much is not tried
//! again for a while.

use sheetwright::design::{Design, DesignPanel, SampleTolerance};
use sheetwright::draw::coarse::coarse;
use sheetwright::sample::Counts;
use web_time::{Duration, Instant};

/// Samples of a panel at first, and at the least.
const LEAST: usize = 96;
/// What an answer may take: a frame at 60 a second.
const FRAME: Duration = Duration::from_micros(16_667);
/// What the first answer of a fineness may take, with all panels afresh: it is hardly noticed.
const HITCH: Duration = Duration::from_millis(100);
/// Twice the samples take no more than so many times as long. Measured: 2 to 3.5 times in the
/// examples, up to 5.7 where the table is all of it (`docs/speed.md`).
const GROWTH: u32 = 6;
/// Late answers weigh twice as much as others; at this weight there are too many.
const TOO_LATE: u32 = 6;
/// What was too much is tried again after so long: another handle may be under the hand, or the
/// machine have less to do.
const AGAIN: Duration = Duration::from_secs(60);

/// How fine panels are made, and how long that took.
#[derive(Clone, Debug)]
pub(super) struct Fineness {
    /// The names of the panels, their samples and tolerances: other panels are measured anew.
    panels: Vec<(String, usize, Option<SampleTolerance>)>,
    /// The numbers of samples that tolerances take.
    counts: Counts,
    /// Samples of a panel.
    samples: usize,
    /// Whether these are all that the design asks for; `None` before the first answer with so many.
    is_all: Option<bool>,
    /// How long the first answer with so many took; `None` before it.
    first: Option<Duration>,
    /// How long was spent on it before, in vain.
    spent: Duration,
    late: u32,
    /// So many samples were too many, and since when that is known.
    too_many: Option<(usize, Instant)>,
}

impl Default for Fineness {
    fn default() -> Self {
        Self {
            panels: Vec::new(),
            counts: Counts::default(),
            samples: LEAST,
            is_all: None,
            first: None,
            spent: Duration::ZERO,
            late: 0,
            too_many: None,
        }
    }
}

impl Fineness {
    /// The design as fine as there is time for.
    pub(super) fn apply(&mut self, design: &Design) -> Design {
        let of_panel = |p: &DesignPanel| (p.name.clone(), p.samples, p.tolerance);
        let panels = || design.panels.iter().map(of_panel);
        if !panels().eq(self.panels.iter().cloned()) {
            *self = Self { panels: panels().collect(), ..Self::default() };
        }
        // Half as many again are not worth a fineness of their own; but the least are the least.
        let most = if self.samples > LEAST { self.samples + self.samples / 2 } else { LEAST };
        let design = self.counts.of(design);
        let samples = |design: &Design| design.panels.iter().map(|p| p.samples).collect::<Vec<_>>();
        let fits = || samples(&coarse(&design, most)) == samples(&design);
        if *self.is_all.get_or_insert_with(fits) && self.samples > LEAST {
            design.into_owned()
        } else {
            coarse(&design, self.samples)
        }
    }

    /// Learns how long an answer took in which the hand has changed something.
    pub(super) fn took(&mut self, time: Duration, now: Instant) {
        let Some(first) = self.first else {
            self.first = Some(self.spent + time);
            return;
        };
        self.late = if time > FRAME { self.late + 2 } else { self.late.saturating_sub(1) };
        self.too_many.take_if(|(_, since)| now.saturating_duration_since(*since) >= AGAIN);
        let finer = self.samples.saturating_mul(2);
        if self.late >= TOO_LATE {
            self.coarsen(now);
        } else if self.is_all == Some(false)
            && time * GROWTH <= FRAME
            && first * GROWTH <= HITCH
            && self.too_many.is_none_or(|(samples, _)| finer < samples)
        {
            self.change(finer);
        }
    }

    /// An answer was given up after this time, since it took too long.
    pub(super) fn gave_up(&mut self, time: Duration, now: Instant) {
        if self.samples > LEAST {
            self.coarsen(now);
        } else {
            self.spent += time;
        }
    }

    fn coarsen(&mut self, now: Instant) {
        self.late = 0;
        if self.samples > LEAST {
            self.too_many = Some((self.samples, now));
            self.change(self.samples / 2);
        }
    }

    fn change(&mut self, samples: usize) {
        (self.samples, self.is_all) = (samples, None);
        (self.first, self.spent, self.late) = (None, Duration::ZERO, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::tests::saddles;

    /// A hand that moves, and a machine on which a panel of 96 samples takes so many microseconds,
    /// and one of twice as many so many times as long. One panel follows the hand.
    struct Hand {
        fineness: Fineness,
        design: Design,
        now: Instant,
        micros: f64,
        growth: f64,
    }

    impl Hand {
        fn new(design: Design, micros: f64, growth: f64) -> Self {
            Self { fineness: Fineness::default(), design, now: Instant::now(), micros, growth }
        }

        /// Moves so often; how many samples panels have then, and how long each answer took.
        fn moves(&mut self, times: usize) -> Vec<(usize, Duration)> {
            let made = |_| {
                let fine = self.fineness.apply(&self.design);
                let samples = fine.panels[0].samples;
                let doublings = (0..).take_while(|n| samples >> n > LEAST * 4 / 3).count();
                let growth: f64 = std::iter::repeat_n(self.growth, doublings).product();
                let afresh = if self.fineness.first.is_none() { fine.panels.len() } else { 1 };
                let micros = self.micros * growth * afresh as f64;
                let time = Duration::from_secs_f64(micros * 1e-6);
                self.now += time.max(FRAME);
                self.fineness.took(time, self.now);
                (samples, time)
            };
            (0..times).map(made).collect()
        }

        fn samples(&mut self, times: usize) -> Vec<usize> {
            self.moves(times).into_iter().map(|(samples, _)| samples).collect()
        }
    }

    #[test]
    fn small_designs_are_soon_shown_with_all_their_samples() {
        let mut hand = Hand::new(saddles(1, 400, 20.0), 300.0, 4.0);
        assert_eq!(hand.samples(6), [96, 96, 192, 192, 400, 400]);
        assert_eq!(hand.samples(200), [400; 200]);
        // No fineness for a few samples more.
        let mut hand = Hand::new(saddles(1, 250, 20.0), 300.0, 4.0);
        assert_eq!(hand.samples(4), [96, 96, 250, 250]);
        assert_eq!(Hand::new(saddles(3, 60, 20.0), 300.0, 4.0).samples(3), [60; 3]);
    }

    #[test]
    fn a_fineness_is_found_that_stays_and_leaves_time() {
        for panels in [1, 3, 100] {
            for micros in [1.0, 10.0, 100.0, 1000.0, 10_000.0] {
                for growth in [2.5, 4.0, 6.0, 9.0] {
                    let mut hand = Hand::new(saddles(panels, 3000, 20.0), micros, growth);
                    hand.moves(60);
                    let last = hand.moves(60);
                    let case = format!("{panels} panels, {micros} µs, × {growth}: {:?}", last[0]);
                    assert!(last.iter().all(|answer| *answer == last[0]), "{case}");
                    assert!(last[0].1 <= FRAME || last[0].0 == LEAST, "{case}");
                }
            }
        }
    }

    #[test]
    fn no_other_fineness_stops_the_picture_for_longer_than_a_moment() {
        for panels in [1, 3, 17, 40] {
            for micros in [5.0, 50.0, 500.0, 2500.0] {
                for growth in [2.0, 4.5, 6.0] {
                    let mut hand = Hand::new(saddles(panels, 3000, 20.0), micros, growth);
                    let times = hand.moves(40).into_iter().map(|(_, time)| time);
                    let longest = times.skip(1).max().unwrap();
                    assert!(longest <= HITCH, "{panels}, {micros}, {growth}: {longest:?}");
                }
            }
        }
    }

    #[test]
    fn one_late_answer_is_nothing_and_many_are_remembered_for_a_while() {
        let mut hand = Hand::new(saddles(1, 400, 20.0), 300.0, 4.0);
        hand.moves(10);
        for _ in 0..50 {
            hand.fineness.took(FRAME * 5, hand.now);
            assert_eq!(hand.samples(3), [400; 3]);
        }
        (0..3).for_each(|_| hand.fineness.took(FRAME * 2, hand.now));
        assert_eq!(hand.samples(100), [192; 100]);
        hand.now += AGAIN;
        assert_eq!(hand.samples(4), [192, 400, 400, 400]);
        hand.fineness.gave_up(HITCH, hand.now);
        assert_eq!(hand.samples(5), [192; 5]);
    }

    #[test]
    fn what_was_given_up_counts_as_part_of_the_first_answer() {
        let mut hand = Hand::new(saddles(1, 400, 20.0), 300.0, 4.0);
        assert_eq!(hand.fineness.apply(&hand.design).panels[0].samples, LEAST);
        (0..9).for_each(|_| hand.fineness.gave_up(HITCH, hand.now));
        assert_eq!(hand.samples(20), [LEAST; 20]);
    }

    #[test]
    fn other_panels_are_measured_anew() {
        let mut hand = Hand::new(saddles(1, 400, 20.0), 300.0, 4.0);
        hand.moves(10);
        hand.design = saddles(1, 800, 20.0);
        assert_eq!(hand.samples(2), [96; 2]);
        hand.moves(10);
        hand.design = saddles(2, 800, 20.0);
        assert_eq!(hand.samples(2), [96; 2]);
    }
}
