//! The work itself, wherever it is done: a job in, an answer out.
//!
//! What is made of a design is kept, so that the next one, which differs in little, is made from it
//! ([`sheetwright::make::Live`]).

use super::fineness::Fineness;
use super::shown::{Shown, ShownPanel};
use super::{Answer, Detail, Job, Refusal, Varied};
use sheetwright::check::Finding;
use sheetwright::design::Design;
use sheetwright::make::{Live, LivePanel, Made, MakeError, Part, make};
use sheetwright::material::Material;
use sheetwright::watch::Watch;
use sheetwright_files::{Format, OutputFile, OutputOptions, hint_for, output_files};
use web_time::{Duration, Instant};

/// How long the search for divisions goes on at a time: a worker hears nothing meanwhile. A step
/// more may have begun before.
const SLICE: Duration = Duration::from_millis(100);

/// One who works.
#[derive(Default)]
pub struct Work {
    live: Live,
    fineness: Fineness,
}

impl Work {
    /// Does a job. `None` where it was stopped.
    pub fn run(&mut self, job: &Job, watch: &mut dyn Watch) -> Option<Answer> {
        match job {
            Job::Show { number, design, detail } => {
                let panels = match detail {
                    Detail::Coarse => self.keep_up(design, watch),
                    Detail::Full => self.rest(design, watch),
                };
                Some(Answer::Shown { number: *number, detail: *detail, panels: panels? })
            }
            Job::Advise { number, design } => {
                let (advice, is_over) = self.advise(design, watch)?;
                Some(Answer::Advised { number: *number, advice, is_over })
            }
            Job::Vary { number, design } => {
                let made = make(design, watch);
                if watch.stop() {
                    return None;
                }
                let outcome = made.map(|made| Box::new(varied(made))).map_err(|e| refusal(&e));
                Some(Answer::Varied { number: *number, outcome })
            }
            Job::Export { number, design, formats } => {
                let outcome = files(design, formats, watch)?;
                Some(Answer::Files { number: *number, outcome })
            }
        }
    }

    /// Panels as fine as leaves time to keep up with the hand.
    fn keep_up(&mut self, design: &Design, watch: &mut dyn Watch) -> Option<Vec<ShownPanel>> {
        let begun = Instant::now();
        let fine = self.fineness.apply(design);
        let changed = self.live.follow(fine, watch);
        let panels = (!watch.stop()).then(|| shown_panels(&self.live));
        let (now, time) = (Instant::now(), begun.elapsed());
        // What can't be made is refused at once, and says nothing of what takes how long.
        let is_made = |&n: &usize| self.live.panels()[n].made.is_ok();
        if panels.is_none() {
            self.fineness.gave_up(time, now);
        } else if !changed.is_empty() && changed.iter().all(is_made) {
            self.fineness.took(time, now);
        }
        panels
    }

    /// Panels as the design says, with all that is found of them.
    fn rest(&mut self, design: &Design, watch: &mut dyn Watch) -> Option<Vec<ShownPanel>> {
        self.live.update(design.clone(), watch);
        (!watch.stop()).then(|| shown_panels(&self.live))
    }

    /// Goes on with the search for divisions of panels that will not bend, until there is something
    /// new, or for [`SLICE`]: all that is known, and whether that is all there is. `None` where it
    /// was stopped; what was found until then is kept.
    fn advise(&mut self, design: &Design, watch: &mut dyn Watch) -> Option<Advice> {
        let begun = Instant::now();
        // Nothing, unless this is a worker that has begun after the panels were shown.
        self.live.update(design.clone(), watch);
        let known = advice(&self.live).len();
        loop {
            if watch.stop() {
                return None;
            }
            let goes_on = self.live.advise(watch);
            let found = advice(&self.live);
            if !goes_on || found.len() > known || begun.elapsed() >= SLICE {
                return (!watch.stop()).then_some((found, !goes_on));
            }
        }
    }
}

/// Findings on where to divide parts, by their names; and whether these are all.
type Advice = (Vec<(String, Finding)>, bool);

/// What is known of where to divide panels.
fn advice(live: &Live) -> Vec<(String, Finding)> {
    let parts = live.panels().iter().filter_map(|panel| panel.made.as_ref().ok()).flatten();
    parts.filter_map(|part| Some((part.name.clone(), live.advice_on(part)?.clone()))).collect()
}

/// Points that may move stay where they are drawn until somebody asks.
fn shown_panels(live: &Live) -> Vec<ShownPanel> {
    let material = live.design().material.as_ref();
    let shown = |part: &Part| {
        let mut shown = shown(part, material);
        if let (Ok(made), Some(finding)) = (&mut shown.made, live.advice_on(part)) {
            _ = made.add(finding.clone());
        }
        shown
    };
    let of_panel = |panel: &LivePanel, made: &Result<Vec<Part>, MakeError>| match made {
        Ok(parts) => parts.iter().map(shown).collect(),
        Err(error) => {
            let (name, made) = (panel.name.clone(), Err(refusal(error)));
            vec![ShownPanel { name: name.clone(), panel: name, made }]
        }
    };
    let panels = live.panels().iter();
    match live.trimmed() {
        None => panels.flat_map(|panel| of_panel(panel, &panel.made)).collect(),
        Some(trimmed) => {
            panels.zip(&trimmed).flat_map(|(panel, made)| of_panel(panel, made)).collect()
        }
    }
}

/// The files that the command line writes of a design, advice on dividing among them. `None` where
/// it was stopped before parts were laid out; the best layout so far counts where that was stopped.
fn files(
    design: &Design,
    formats: &[Format],
    watch: &mut dyn Watch,
) -> Option<Result<Vec<OutputFile>, Refusal>> {
    let mut made = make(design, watch);
    // No other file tells notes.
    if let Ok(made) = &mut made
        && formats.contains(&Format::Report)
    {
        made.advise(watch);
    }
    if watch.stop() {
        return None;
    }
    Some(made.map_err(|error| refusal(&error)).and_then(|mut made| {
        made.lay_out(watch);
        let outputs = output_files(&made, formats, OutputOptions::of(design));
        let refused = outputs.map_err(|it| Refusal::new(&it, it.hint().unwrap_or_default()));
        Ok(refused?.files)
    }))
}

fn refusal(error: &MakeError) -> Refusal {
    Refusal::new(error, hint_for(error))
}

fn shown(part: &Part, material: Option<&Material>) -> ShownPanel {
    let (name, panel) = (part.name.clone(), part.panel.clone());
    ShownPanel { name, panel, made: Ok(Shown::new(part, material)) }
}

fn varied(made: Made) -> Varied {
    let material = made.material.as_ref();
    let before_of = |part: &Part| match part.change() {
        Some(change) => shown(&change.before, material),
        None => shown(part, material),
    };
    let moved_max_mm = made
        .parts
        .iter()
        .filter_map(|part| Some(part.change()?.moved_max_mm()))
        .fold(0.0, f64::max);
    Varied {
        moved_max_mm,
        before: made.parts.iter().map(before_of).collect(),
        after: made.parts.iter().map(|part| shown(part, material)).collect(),
        moved: made.moved,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::tests::saddles;
    use sheetwright::check::FindingKind;
    use sheetwright::design::{SheetForm, Stock, StockSheet};
    use sheetwright::watch::{Stage, Unwatched};
    use sheetwright_shapes::drag::Drag;
    use sheetwright_shapes::hull::planks;
    use std::sync::Arc;

    fn shown(work: &mut Work, design: &Design, detail: Detail) -> Vec<ShownPanel> {
        let job = Job::Show { number: 1, design: Arc::new(design.clone()), detail };
        match work.run(&job, &mut Unwatched) {
            Some(Answer::Shown { panels, .. }) => panels,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn under_the_hand_a_small_design_is_what_it_is_at_rest_but_for_what_waits() {
        let (mut quick, mut slow) = (Work::default(), Work::default());
        // So few samples that all of them are shown under the hand.
        let mut design = planks(30, 0.0);
        let ends = [0, 8].map(|n| design.curves[1].points[n].at);
        let mut drag =
            Drag::new(design.curves[1].points[1].at, 0.02 * ends[0].distance(ends[1]), 1);
        let mut waited = 0;
        for _ in 0..6 {
            design.curves[1].points[1].at = drag.step();
            let rested = shown(&mut slow, &design, Detail::Full);
            let moving = shown(&mut quick, &design, Detail::Coarse);
            for (rested, moving) in rested.into_iter().zip(moving) {
                let (mut rested, moving) = (rested.made.unwrap(), moving.made.unwrap());
                let is_late =
                    |f: &Finding| matches!(f.kind, FindingKind::BetterWithoutPlane { .. });
                assert!(!moving.findings.iter().any(is_late));
                waited += rested.findings.iter().filter(|finding| is_late(finding)).count();
                // A formula gives the verdict under the hand, and takes every fold for needed.
                rested.verdict = moving.verdict;
                rested.findings.clone_from(&moving.findings);
                rested.piece = moving.piece.clone();
                assert!(moving.strain.is_none());
                rested.strain = None;
                assert_eq!(moving, rested);
            }
        }
        assert!(waited > 0);
    }

    /// Stops once a stage has begun.
    struct StopAt {
        stage: Stage,
        is_there: bool,
    }

    impl Watch for StopAt {
        fn begin(&mut self, _panels: &[&str], stage: Stage) {
            self.is_there |= stage == self.stage;
        }

        fn stop(&self) -> bool {
            self.is_there
        }
    }

    #[test]
    fn a_stop_keeps_the_best_layout_so_far_and_nothing_before_one() {
        let form = SheetForm::Rectangle { size: [5000.0, 5000.0] };
        let stock = Stock {
            sheets: vec![StockSheet { name: None, form, count: None, cost: None }],
            ..Stock::default()
        };
        let design = Arc::new(Design { stock: Some(stock), ..saddles(5, 48, 10.0) });
        let job = Job::Export { number: 1, design, formats: vec![Format::Sheets] };
        let stopped_at = |stage| {
            let mut watch = StopAt { stage, is_there: false };
            Work::default().run(&job, &mut watch)
        };
        assert_eq!(stopped_at(Stage::Solve), None);
        let Some(Answer::Files { outcome: Ok(files), .. }) = stopped_at(Stage::Nest) else {
            panic!("no files");
        };
        let svg = String::from_utf8_lossy(&files[0].bytes);
        for n in 0..5 {
            assert!(svg.contains(&format!("panel {n}")), "{svg}");
        }
    }

    #[test]
    fn what_is_refused_at_once_does_not_count_as_early() {
        let mut work = Work::default();
        let mut design = saddles(1, 3000, 40.0);
        let rim = design.curves[0].points.clone();
        for n in 0..20 {
            // Two handles on one spot are no curve; where they are is another design each time.
            design.curves[0].points[1].at = design.curves[0].points[0].at;
            design.curves[0].points[5].at.z = f64::from(n);
            assert!(shown(&mut work, &design, Detail::Coarse)[0].made.is_err());
        }
        design.curves[0].points = rim;
        let panels = shown(&mut work, &design, Detail::Coarse);
        assert_eq!(panels[0].made.as_ref().unwrap().positions.len(), 96);
    }
}
