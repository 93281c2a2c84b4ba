//! The work itself, wherever it is done: a job in, an answer out.
//!
//! What is made of a design is kept, so that the next one, which differs in little, is made from it
//! ([`sheetwright::design::Live`]).

use super::pace::Pace;
use super::shown::{Shown, ShownPanel};
use super::{Answer, Detail, Job, Refusal, Varied};
use sheetwright::check::Verdict;
use sheetwright::design::{Design, Live, Made, MadePanel, MakeError, make};
use sheetwright::draw::coarse::coarse;
use sheetwright::material::Material;
use sheetwright::math::to_deg;
use sheetwright::watch::Watch;
use sheetwright_files::{Format, OutputFile, PdfOptions, hint_for, output_files};
use web_time::Instant;

/// One who works.
#[derive(Default)]
pub struct Work {
    live: Option<Live>,
    pace: Pace,
}

impl Work {
    /// Does a job. `None` where it was stopped.
    pub fn run(&mut self, job: &Job, watch: &mut dyn Watch) -> Option<Answer> {
        match job {
            Job::Show { number, design, detail } => {
                let panels = match detail {
                    Detail::Coarse => self.keep_up(design, watch),
                    Detail::Full => self.show(design, watch),
                };
                Some(Answer::Shown { number: *number, detail: *detail, panels: panels? })
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
                let outcome = files(design, formats, watch);
                (!watch.stop()).then_some(Answer::Files { number: *number, outcome })
            }
        }
    }

    /// Shows a design with as many samples as leave time to keep up with the hand.
    fn keep_up(&mut self, design: &Design, watch: &mut dyn Watch) -> Option<Vec<ShownPanel>> {
        let begun = Instant::now();
        let panels = self.show(&coarse(design, self.pace.samples()), watch);
        let most = design.panels.iter().map(|panel| panel.samples).max().unwrap_or(0);
        self.pace.took(panels.as_ref().map(|_| begun.elapsed()), most);
        panels
    }

    fn show(&mut self, design: &Design, watch: &mut dyn Watch) -> Option<Vec<ShownPanel>> {
        // Points that may move stay where they are drawn until somebody asks.
        let live = self.live.get_or_insert_with(|| Live::new(Design::default(), watch));
        live.follow(design.clone(), watch);
        if watch.stop() {
            return None;
        }
        // Where the hand has moved on, the panels are shown as they are.
        live.settle(watch);
        let shown = live.panels().iter().map(|panel| ShownPanel {
            name: panel.name.clone(),
            made: match &panel.made {
                Ok(made) => Ok(Shown::new(made, design.material)),
                Err(error) => Err(refusal(error)),
            },
        });
        Some(shown.collect())
    }
}

/// The files that the command line writes of a design.
fn files(
    design: &Design,
    formats: &[Format],
    watch: &mut dyn Watch,
) -> Result<Vec<OutputFile>, Refusal> {
    let made = make(design, watch).map_err(|error| refusal(&error))?;
    let outputs = output_files(&made, formats, &PdfOptions::default()).map_err(|error| {
        Refusal { message: error.to_string(), hint: "Give the panels other names.".to_owned() }
    })?;
    Ok(outputs.files)
}

fn refusal(error: &MakeError) -> Refusal {
    Refusal { message: error.to_string(), hint: hint_for(error) }
}

fn shown(panel: &MadePanel, material: Option<&Material>) -> ShownPanel {
    ShownPanel { name: panel.name.clone(), made: Ok(Shown::new(panel, material)) }
}

fn varied(made: Made) -> Varied {
    let before_of = |panel: &MadePanel| match &panel.change {
        Some(change) => shown(&change.before, made.material),
        None => shown(panel, made.material),
    };
    let worst = |panels: &mut dyn Iterator<Item = &MadePanel>| {
        to_deg(panels.map(|panel| panel.measures.warp_max).fold(0.0, f64::max))
    };
    let now = worst(&mut made.panels.iter());
    let was = worst(&mut made.panels.iter().map(|panel| match &panel.change {
        Some(change) => &*change.before,
        None => panel,
    }));
    let farthest = made
        .panels
        .iter()
        .filter_map(|panel| Some(panel.change.as_ref()?.moved_max_mm()))
        .fold(0.0, f64::max);
    let all_bend = made.panels.iter().all(|p| p.checked.verdict != Verdict::WillNotBend);
    let text = if made.moved.is_none() {
        "Nothing moved: either it bends already, or moving this far does not help.".to_owned()
    } else {
        format!(
            "The largest twist goes from {was:.1}° to {now:.1}°; no sample moves farther than \
             {farthest:.1} mm. {}",
            if all_bend { "Every panel bends now." } else { "Not every panel bends yet." }
        )
    };
    Varied {
        text,
        before: made.panels.iter().map(before_of).collect(),
        after: made.panels.iter().map(|panel| shown(panel, made.material)).collect(),
        moved: made.moved,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::curve::{CurveKind, CurvePoint};
    use sheetwright::design::{CurveUse, DesignCurve, DesignPanel, PanelShape};
    use sheetwright::math::{Point3, cos, sin};
    use sheetwright::watch::Stage;
    use std::sync::Arc;

    /// A saddle, which won't bend.
    fn saddle(height: f64) -> Arc<Design> {
        let at = |i: usize| {
            let t = std::f64::consts::TAU * i as f64 / 12.0;
            Point3::new(100.0 * cos(t), 100.0 * sin(t), height * cos(2.0 * t))
        };
        let curve = DesignCurve {
            name: "rim".to_owned(),
            kind: Some(CurveKind::Spline),
            closed: true,
            points: (0..12).map(|i| CurvePoint::smooth(at(i))).collect(),
        };
        let outer = vec![CurveUse { name: "rim".to_owned(), reversed: false }];
        let shape = PanelShape::Loops { outer, holes: Vec::new() };
        Arc::new(Design {
            name: "saddle".to_owned(),
            curves: vec![curve],
            panels: vec![DesignPanel::new("panel", shape, 60)],
            ..Design::default()
        })
    }

    /// Asks to stop from the n-th time on that panels are checked.
    struct StopAtCheck(usize);

    impl Watch for StopAtCheck {
        fn begin(&mut self, _panels: &[&str], stage: Stage) {
            self.0 = self.0.saturating_sub(usize::from(stage == Stage::Check));
        }

        fn stop(&self) -> bool {
            self.0 == 0
        }
    }

    #[test]
    fn a_hand_that_moves_on_stops_what_the_picture_does_not_need() {
        let mut work = Work::default();
        let show =
            |height: f64| Job::Show { number: 1, design: saddle(height), detail: Detail::Coarse };
        // Checked once as it is made, and once when it is asked whether it needs its plane.
        let Some(Answer::Shown { panels, .. }) = work.run(&show(60.0), &mut StopAtCheck(2)) else {
            panic!("a picture");
        };
        assert_ne!(panels[0].made.as_ref().unwrap().verdict, Verdict::Bends);
        assert_eq!(work.run(&show(61.0), &mut StopAtCheck(1)), None);
        let mut all = StopAtCheck(3);
        assert!(work.run(&show(60.0), &mut all).is_some());
        assert_eq!(all.0, 1);
    }
}
