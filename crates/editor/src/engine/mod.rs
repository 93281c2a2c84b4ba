//! What makes a document into surfaces and patterns, beside the hand that draws: a thread on the
//! desktop, a worker in the browser.

mod fineness;
pub mod shown;
#[cfg(not(target_arch = "wasm32"))]
mod thread;
pub mod wire;
pub mod work;
#[cfg(target_arch = "wasm32")]
pub mod worker;

#[cfg(not(target_arch = "wasm32"))]
pub use thread::Engine;
#[cfg(target_arch = "wasm32")]
pub use worker::Engine;

use crate::words::sentence;
use sheetwright::check::Finding;
use sheetwright::design::{Design, LEAST_EFFORT, Stock};
use sheetwright::watch::Stage;
use sheetwright_files::{Format, OutputFile};
use shown::ShownPanel;
use std::sync::Arc;
use web_time::Duration;

/// How long something outdated may be at work before it is stopped. An answer that is a little old
/// is better than none: where frames are shorter than answers, none would ever come. After each
/// that was stopped it is twice as long, until there is an answer.
const PATIENCE: Duration = Duration::from_millis(400);

/// Wakes the window up because there is an answer.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// What the engine can be asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Job {
    /// The panels of a design as it is drawn. A later one takes the place of an earlier one.
    Show {
        /// Counts up; the answer repeats it.
        number: u64,
        /// The design.
        design: Arc<Design>,
        /// How fine.
        detail: Detail,
    },
    /// Where to divide panels that will not bend, once the panels are shown in full: a part of the
    /// search, so that what comes meanwhile need not wait.
    Advise {
        /// Counts up; the answer repeats it.
        number: u64,
        /// The design.
        design: Arc<Design>,
    },
    /// The design with its points moved as [`Design::vary`] says.
    Vary {
        /// Counts up; the answer repeats it.
        number: u64,
        /// The design.
        design: Arc<Design>,
    },
    /// The files that the command line writes of a design.
    Export {
        /// Counts up; the answer repeats it.
        number: u64,
        /// The design.
        design: Arc<Design>,
        /// Which formats.
        formats: Vec<Format>,
    },
}

impl Job {
    /// Its number.
    pub fn number(&self) -> u64 {
        match self {
            Self::Show { number, .. }
            | Self::Advise { number, .. }
            | Self::Vary { number, .. }
            | Self::Export { number, .. } => *number,
        }
    }

    /// Whether it is for what is shown, so that a change makes it outdated.
    pub(crate) fn is_for_shown(&self) -> bool {
        matches!(self, Self::Show { .. } | Self::Advise { .. })
    }

    /// What a job that is to stop at a stage becomes where nothing of it can be kept: while parts
    /// are laid out, the export with the least effort. `None` where nothing is to follow.
    #[cfg_attr(not(target_arch = "wasm32"), allow(dead_code, reason = "workers alone are ended"))]
    pub(crate) fn cut_short(&self, stage: Option<Stage>) -> Option<Self> {
        let Self::Export { number, design, formats } = self else { return None };
        let stock = design.stock.as_ref().filter(|_| stage == Some(Stage::Nest))?;
        let stock = Stock { effort: LEAST_EFFORT, ..stock.clone() };
        if design.stock.as_ref() == Some(&stock) {
            return None;
        }
        let design = Design { stock: Some(stock), ..(**design).clone() };
        Some(Self::Export { number: *number, design: Arc::new(design), formats: formats.clone() })
    }
}

/// What is being done, in words.
pub fn doing(panels: &[&str], stage: Stage) -> String {
    let what = match stage {
        Stage::Sample => "Sampling",
        Stage::Solve => "Finding the best sheet for",
        Stage::Vary => "Moving points of",
        Stage::Flatten => "Laying flat",
        Stage::Check => "Checking",
        Stage::Nest => "Laying out",
    };
    let rest = panels.len().saturating_sub(NAMED);
    let names = panels[..panels.len() - rest].join(", ");
    let more = if rest == 0 { String::new() } else { format!(" and {rest} more") };
    format!("{what} {names}{more}")
}

/// So many panels are named while something is done to them: a line has no room for more.
const NAMED: usize = 2;

/// How fine panels are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// While the hand moves: as fine as leaves time to keep up with it.
    Coarse,
    /// As the design says.
    Full,
}

/// What the engine says.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The panels of a design.
    Shown {
        /// The number of the job.
        number: u64,
        /// How fine they are.
        detail: Detail,
        /// The panels.
        panels: Vec<ShownPanel>,
    },
    /// Where to divide panels.
    Advised {
        /// The number of the job.
        number: u64,
        /// All that is known of it, by the names of the parts.
        advice: Vec<(String, Finding)>,
        /// Whether that is all: else the search is to go on.
        is_over: bool,
    },
    /// A design whose points were moved.
    Varied {
        /// The number of the job.
        number: u64,
        /// The moved design, with the panels before and after; or why there is none.
        outcome: Result<Box<Varied>, Refusal>,
    },
    /// Files to write.
    Files {
        /// The number of the job.
        number: u64,
        /// The files; or why there are none.
        outcome: Result<Vec<OutputFile>, Refusal>,
    },
    /// How far a job is.
    Progress {
        /// The number of the job.
        number: u64,
        /// The stage that it is at.
        stage: Stage,
        /// What is being done, in words: `sampling bottom`.
        text: String,
        /// The part that is done, 0 ..= 1.
        done: f64,
    },
}

/// A design whose points were moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// The design with its points moved; `None` if nothing had to move, or nothing helped.
    pub moved: Option<Design>,
    /// How far a sample of the panels moves at most, mm.
    pub moved_max_mm: f64,
    /// The panels before.
    pub before: Vec<ShownPanel>,
    /// The panels after.
    pub after: Vec<ShownPanel>,
}

/// Why something can't be done, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What is wrong, in sentences.
    pub message: String,
    /// What to do, in sentences.
    pub hint: String,
}

impl Refusal {
    /// Of an error and what to do about it: as sentences, which may follow one another.
    pub fn new(error: &impl std::fmt::Display, hint: impl Into<String>) -> Self {
        Self { message: sentence(error), hint: hint.into() }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use sheetwright::curve::{CurveKind, CurvePoint};
    use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
    use sheetwright::math::{Point3, cos, sin};

    #[test]
    fn what_is_done_to_many_panels_fits_a_line() {
        use super::{Stage, doing};
        assert_eq!(doing(&["a"], Stage::Check), "Checking a");
        assert_eq!(doing(&["a", "b"], Stage::Check), "Checking a, b");
        assert_eq!(doing(&["a", "b", "c", "d"], Stage::Flatten), "Laying flat a, b and 2 more");
    }

    #[test]
    fn an_export_that_is_laying_out_is_cut_short_by_less_effort() {
        use super::{Arc, Job, LEAST_EFFORT, Stage, Stock};
        let export = |stock: Option<Stock>| {
            let design = Arc::new(Design { stock, ..saddles(1, 96, 40.0) });
            Job::Export { number: 7, design, formats: Vec::new() }
        };
        let job = export(Some(Stock::default()));
        let least = export(Some(Stock { effort: LEAST_EFFORT, ..Stock::default() }));
        assert_eq!(job.cut_short(Some(Stage::Nest)), Some(least.clone()));
        // A second stop ends it.
        assert_eq!(least.cut_short(Some(Stage::Nest)), None);
        assert_eq!(job.cut_short(Some(Stage::Solve)), None);
        assert_eq!(job.cut_short(None), None);
        assert_eq!(export(None).cut_short(Some(Stage::Nest)), None);
    }

    /// So many panels with so many samples each, all bounded by the rim of a saddle so high, mm.
    pub(crate) fn saddles(panels: usize, samples: usize, height: f64) -> Design {
        let at = |i: usize| {
            let t = std::f64::consts::TAU * i as f64 / 12.0;
            let at = Point3::new(100.0 * cos(t), 100.0 * sin(t), height * cos(2.0 * t));
            CurvePoint::smooth(at)
        };
        let rim = DesignCurve {
            name: "rim".to_owned(),
            kind: Some(CurveKind::Spline),
            closed: true,
            points: (0..12).map(at).collect(),
        };
        let panel = |n: usize| {
            let outer = vec![CurveUse { name: "rim".to_owned(), reversed: false }];
            let shape = PanelShape::Loops { outer, holes: Vec::new() };
            DesignPanel::new(format!("panel {n}"), shape, samples)
        };
        Design {
            name: "saddles".to_owned(),
            curves: vec![rim],
            panels: (0..panels).map(panel).collect(),
            ..Design::default()
        }
    }
}
