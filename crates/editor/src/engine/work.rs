//! The work itself, wherever it is done: a job in, an answer out.
//!
//! What is made of a design is kept, so that the next one, which differs in little, is made from it
//! ([`sheetwright::design::Live`]).

use super::shown::{Shown, ShownPanel};
use super::{Answer, Detail, Job, Refusal, Varied};
use sheetwright::check::Verdict;
use sheetwright::design::{Design, Live, Made, MadePanel, MakeError, make};
use sheetwright::draw::coarse::coarse;
use sheetwright::material::Material;
use sheetwright::math::to_deg;
use sheetwright::watch::Watch;
use sheetwright_files::{Format, OutputFile, PdfOptions, hint_for, output_files};

/// Samples of a panel while the hand moves.
pub const COARSE_SAMPLES: usize = 96;

/// One who works.
#[derive(Default)]
pub struct Work {
    live: Option<Live>,
}

impl Work {
    /// Does a job. `None` where it was stopped.
    pub fn run(&mut self, job: &Job, watch: &mut dyn Watch) -> Option<Answer> {
        match job {
            Job::Show { number, design, detail } => {
                let panels = match detail {
                    Detail::Coarse => self.show(&coarse(design, COARSE_SAMPLES), watch)?,
                    Detail::Full => self.show(design, watch)?,
                };
                Some(Answer::Shown { number: *number, detail: *detail, panels })
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

    fn show(&mut self, design: &Design, watch: &mut dyn Watch) -> Option<Vec<ShownPanel>> {
        // Points that may move stay where they are drawn until somebody asks.
        let live = match &mut self.live {
            Some(live) => {
                live.update(design.clone(), watch);
                live
            }
            none => none.insert(Live::new(design.clone(), watch)),
        };
        if watch.stop() {
            return None;
        }
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
