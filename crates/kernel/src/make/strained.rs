//! Moving curves until the sheet stretches by no more than a share of what it takes.
//!
//! The strain of an elastic sheet has no slopes that a descent could follow at little cost. But it
//! falls with the warp angles, and [`crate::fair`] moves curves as little as a largest warp angle
//! takes. So the largest such angle is looked for with which the strain is within the share: the
//! angle is halved until it is, then bisected. Each trial moves the curves and judges the panels.

use super::{How, MakeError, make_panels};
use crate::check::strain_not_reached;
use crate::design::{Design, DesignPanel, Vary, VaryGoal};
use crate::fair::varied_design;
use crate::make::Part;
use sheetwright_geometry::watch::Watch;
use std::borrow::Cow;

/// How often the angle is halved until the strain is within its share: down to a 64th.
const HALVINGS: usize = 6;
/// How often the angle is bisected then: to 5 %.
const BISECTIONS: usize = 4;

/// The strain that panels were to have at the most.
pub(super) struct Wanted {
    vary: Vary,
    share: f64,
}

impl Wanted {
    fn of(vary: &Vary) -> Option<Self> {
        let VaryGoal::Strain { share } = vary.goal else { return None };
        Some(Self { vary: vary.clone(), share })
    }

    /// What moves, with an angle as the goal. A panel that stretches too much moves although its
    /// warp angles may be those of its sampling.
    fn by_angle(&self, largest: f64) -> Vary {
        let goal = VaryGoal::Warp { largest };
        Vary { goal, leave_developable: false, ..self.vary.clone() }
    }

    fn has(&self, panel: &str) -> bool {
        self.vary.panels.is_empty() || self.vary.panels.iter().any(|name| name == panel)
    }

    /// Adds a finding to parts that stretch by more, and leaves out the angles that were tried.
    pub(super) fn say_missed(&self, parts: &mut [Part]) {
        for part in parts.iter_mut().filter(|part| self.has(&part.panel)) {
            part.checked.forget_angles();
            if let Some(missed) = strain_share(part).filter(|share| *share > self.share) {
                part.checked.add(strain_not_reached(self.share, missed));
            }
        }
    }
}

/// The design with angles in place of strains as the goals of moving, and the strains that were
/// wanted.
pub(super) fn aimed_by_angles<'a>(
    design: &'a Design,
    how: How,
    watch: &mut dyn Watch,
) -> Result<(Cow<'a, Design>, Vec<Wanted>), MakeError> {
    let wanted: Vec<Wanted> = design.vary.iter().filter_map(Wanted::of).collect();
    if wanted.is_empty() {
        return Ok((Cow::Borrowed(design), wanted));
    }
    let mut aimed = design.clone();
    for n in 0..aimed.vary.len() {
        if let Some(wanted) = Wanted::of(&aimed.vary[n]) {
            let first = Design { vary: aimed.vary[..n].to_vec(), ..design.clone() };
            let trials = Trials { first, wanted, how };
            let largest = trials.largest_angle(watch)?;
            aimed.vary[n] = trials.wanted.by_angle(largest);
        }
    }
    Ok((Cow::Owned(aimed), wanted))
}

/// Trials of moving a design.
struct Trials {
    /// The design with what moves first.
    first: Design,
    wanted: Wanted,
    how: How,
}

/// The outcome of a trial.
#[derive(Clone, Copy)]
struct Trial {
    /// The largest warp angle of the panels, radians.
    warp: f64,
    /// The largest strain, as a share of what the sheet takes.
    share: f64,
}

impl Trials {
    /// The largest warp angle with which the strain is within its share, radians; the angle with
    /// the least strain, if none is.
    fn largest_angle(&self, watch: &mut dyn Watch) -> Result<f64, MakeError> {
        let drawn = self.tried(None, watch)?;
        if drawn.share <= self.wanted.share || drawn.warp == 0.0 || watch.stop() {
            return Ok(drawn.warp.max(f64::MIN_POSITIVE));
        }
        let (mut beyond, mut angle) = (drawn.warp, drawn.warp);
        let mut least = (drawn.share, drawn.warp);
        let mut within = None;
        for _ in 0..HALVINGS {
            angle *= 0.5;
            let tried = self.tried(Some(angle), watch)?;
            if tried.share < least.0 {
                least = (tried.share, angle);
            }
            if tried.share <= self.wanted.share {
                within = Some(angle);
                break;
            }
            if watch.stop() {
                break;
            }
            beyond = angle;
        }
        let Some(mut within) = within else { return Ok(least.1) };
        for _ in 0..BISECTIONS {
            let middle = (within * beyond).sqrt();
            if self.tried(Some(middle), watch)?.share <= self.wanted.share {
                within = middle;
            } else {
                beyond = middle;
            }
        }
        Ok(within)
    }

    /// The panels as they are with this goal; as they are drawn without one.
    fn tried(&self, angle: Option<f64>, watch: &mut dyn Watch) -> Result<Trial, MakeError> {
        let mut design = self.first.clone();
        if let Some(largest) = angle {
            design.vary.push(self.wanted.by_angle(largest));
        }
        let is_still = design.vary.is_empty();
        let varied = if is_still { None } else { varied_design(&design, watch)? };
        let after = varied.map_or(design, |varied| varied.after);
        let after = Design { vary: Vec::new(), ..after };
        let is_asked = |panel: &DesignPanel| self.wanted.has(&panel.name);
        let parts = make_panels(&after, is_asked, self.how, watch)?;
        let largest = |of: fn(&Part) -> f64| parts.iter().map(of).fold(0.0, f64::max);
        Ok(Trial {
            warp: largest(|part| part.measures.warp_max),
            share: largest(|part| strain_share(part).unwrap_or(0.0)),
        })
    }
}

/// The predicted strain of a part as a share of what its sheet takes.
fn strain_share(part: &Part) -> Option<f64> {
    part.predicted.as_ref().map(|predicted| predicted.strain / predicted.limits.strain)
}
