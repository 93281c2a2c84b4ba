//! Watches the kernel at work: a clock for `timing.json`, and a bar for whoever waits.

use crate::voice::Voice;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sheetwright::watch::{Stage, Watch};
use sheetwright_files::PanelTimes;
use std::collections::BTreeMap;
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

/// Work that takes less shows no bar.
const SHOWN_AFTER: Duration = Duration::from_secs(1);
/// Steps of the bar.
const STEPS: u64 = 1000;

/// What is measured and shown while a design is made.
pub(crate) struct Watcher {
    start: Instant,
    /// The panels and the stage at work, and when it began.
    at_work: Option<(Vec<String>, Stage, Instant)>,
    times: BTreeMap<String, PanelTimes>,
    writing: Option<Instant>,
    shows: bool,
    bar: Option<ProgressBar>,
}

impl Watcher {
    pub(crate) fn new(voice: Voice) -> Self {
        let shows = !voice.quiet && !voice.json && stderr().is_terminal();
        Self {
            start: Instant::now(),
            at_work: None,
            times: BTreeMap::new(),
            writing: None,
            shows,
            bar: None,
        }
    }

    /// The kernel is done, or has failed.
    pub(crate) fn end(&mut self) {
        self.note_time();
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }

    /// From here on, files are made and written.
    pub(crate) fn begin_writing(&mut self) {
        self.writing = Some(Instant::now());
    }

    /// The times of these panels, as far as they are made until now.
    pub(crate) fn times(&self, panels: &[&str]) -> Vec<PanelTimes> {
        let writing = self.writing.map_or(0.0, |start| start.elapsed().as_secs_f64());
        let write = writing / panels.len() as f64;
        let times = |name: &&str| {
            let known = self.times.get(*name).cloned().unwrap_or_default();
            PanelTimes { name: (*name).to_owned(), write, ..known }
        };
        panels.iter().map(times).collect()
    }

    fn note_time(&mut self) {
        let Some((panels, stage, since)) = self.at_work.take() else { return };
        let seconds = since.elapsed().as_secs_f64() / panels.len().max(1) as f64;
        for panel in panels {
            let times = self.times.entry(panel).or_default();
            *match stage {
                Stage::Sample | Stage::Solve => &mut times.solve,
                Stage::Vary => &mut times.vary,
                Stage::Flatten | Stage::Check | Stage::Nest => &mut times.flatten,
            } += seconds;
        }
    }

    fn show(&mut self, done: f64) {
        if !self.shows || self.start.elapsed() < SHOWN_AFTER {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
            // The style is the default one where the template is not understood.
            if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %") {
                bar.set_style(style);
            }
            bar
        });
        if let Some((panels, stage, _)) = &self.at_work {
            let who = match &panels[..] {
                [one] => one.clone(),
                several => format!("{} panels", several.len()),
            };
            bar.set_message(format!("{who}: {}", in_words(*stage)));
        }
        bar.set_position((done.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }
}

impl Watch for Watcher {
    fn begin(&mut self, panels: &[&str], stage: Stage) {
        self.note_time();
        let panels = panels.iter().map(|&panel| panel.to_owned()).collect();
        self.at_work = Some((panels, stage, Instant::now()));
        self.show(0.0);
    }

    fn progress(&mut self, done: f64) {
        self.show(done);
    }
}

fn in_words(stage: Stage) -> &'static str {
    match stage {
        Stage::Sample => "sampling",
        Stage::Solve => "finding the surface",
        Stage::Vary => "moving samples",
        Stage::Flatten => "laying flat",
        Stage::Check => "checking",
        Stage::Nest => "laying out",
    }
}
