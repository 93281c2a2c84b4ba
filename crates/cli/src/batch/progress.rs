//! How far a batch is: how many panels are made, and how many in a second. The number of all panels
//! is known only when all inputs are read.

use crate::voice::Voice;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal as _, stderr};
use std::time::{Duration, Instant};

/// Work that takes less shows nothing.
const SHOWN_AFTER: Duration = Duration::from_secs(1);

pub(super) struct Progress {
    start: Instant,
    shows: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    pub(super) fn new(voice: Voice) -> Self {
        let shows = !voice.quiet && !voice.json && stderr().is_terminal();
        Self { start: Instant::now(), shows, bar: None }
    }

    pub(super) fn show(&mut self, made: u64) {
        let seconds = self.start.elapsed().as_secs_f64();
        if !self.shows || seconds < SHOWN_AFTER.as_secs_f64() {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
            // The style is the default one where the template is not understood.
            if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}") {
                bar.set_style(style);
            }
            bar
        });
        bar.set_message(format!("{made} panels, {:.0} in a second", made as f64 / seconds));
        bar.tick();
    }

    pub(super) fn end(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}
