//! As many samples as a tolerance takes.
//!
//! A polygon through samples of a smooth curve lies off it, and is shorter, by lengths that fall
//! with the square of the number of samples: a step of length h of a curve with curvature κ lies
//! κh²/8 off and is κ²h³/24 shorter. So from what one number of samples leaves follows, nearly,
//! the number that is wanted. Around it the least is looked for that does while one fewer does
//! not: what is tried next follows from the last trial, or halves what is left, by turns, so
//! that the search ends also where the curve has wiggles narrower than a step.
//!
//! Panels with rails that share a rail get the larger of their numbers, so that both sides of
//! the seam have the same samples.

use super::chords::Chords;
use super::error::{PanelCause, PanelError};
use super::loops::{Matched, Sampler};
use super::prepare::sampled;
use crate::design::{Design, DesignCurve, DesignPanel, PanelShape, SampleTolerance, used};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::curve::SampleError;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

/// The most numbers of samples that are tried for a panel: twice the halvings of its range.
const MOST_TRIALS: usize = 26;

/// The design with the numbers of samples that the tolerances of its panels take, as `samples`.
/// Panels with rails that share a curve get the larger of their numbers.
pub(crate) fn counted(design: &Design) -> Cow<'_, Design> {
    Counts::default().of(design)
}

/// The numbers of samples of the panels of a design as they were found last. While a handle is
/// dragged, most panels keep theirs.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    /// By the names of panels.
    known: BTreeMap<String, Known>,
}

/// A number of samples, and what it depends on.
#[derive(Clone, Debug, PartialEq)]
struct Known {
    /// The panel, and those that it joins.
    panels: Vec<DesignPanel>,
    curves: Vec<DesignCurve>,
    samples: usize,
}

impl Counts {
    /// The design with the numbers of samples that its tolerances take; as it is, where it has
    /// none.
    pub fn of<'a>(&mut self, design: &'a Design) -> Cow<'a, Design> {
        let mut before = std::mem::take(&mut self.known);
        let has_tolerance = |panel: &&DesignPanel| panel.tolerance.is_some();
        let panels: Vec<&DesignPanel> =
            design.panels_to_make().into_iter().filter(has_tolerance).collect();
        if panels.is_empty() {
            return Cow::Borrowed(design);
        }
        let mut counts = Vec::with_capacity(panels.len());
        for panel in &panels {
            let with = with_parts(design, panel);
            let curves: Vec<DesignCurve> = used(design, &panel.shape).cloned().collect();
            let is_it = |known: &Known| known.panels == with && known.curves == curves;
            let known = before.remove(&panel.name).filter(is_it).unwrap_or_else(|| {
                let samples = wanted(design, panel);
                Known { panels: with, curves, samples }
            });
            counts.push(known.samples);
            self.known.insert(panel.name.clone(), known);
        }
        agree_on_rails(&panels, &mut counts);
        let of_name: BTreeMap<&str, usize> =
            panels.iter().map(|panel| &panel.name[..]).zip(counts).collect();
        let mut counted = design.clone();
        for panel in &mut counted.panels {
            if let Some(&samples) = of_name.get(&panel.name[..]) {
                panel.samples = samples;
            }
        }
        Cow::Owned(counted)
    }
}

/// A panel and those that it joins.
fn with_parts(design: &Design, panel: &DesignPanel) -> Vec<DesignPanel> {
    let mut panels = vec![panel.clone()];
    if let PanelShape::Join(join) = &panel.shape {
        let parts = design.panels.iter().filter(|part| join.parts.contains(&part.name));
        panels.extend(parts.cloned());
    }
    panels
}

/// Gives panels with rails that share one the larger of their numbers.
fn agree_on_rails(panels: &[&DesignPanel], counts: &mut [usize]) {
    let rails = |n: usize| match &panels[n].shape {
        PanelShape::Rails(rails) => &rails[..],
        _ => &[],
    };
    let mut on: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for n in 0..panels.len() {
        rails(n).iter().for_each(|rail| on.entry(&rail.name).or_default().push(n));
    }
    let mut is_seen = vec![false; panels.len()];
    for first in 0..panels.len() {
        let mut joined = Vec::new();
        let mut waiting = vec![first];
        while let Some(n) = waiting.pop() {
            if !std::mem::replace(&mut is_seen[n], true) {
                joined.push(n);
                waiting
                    .extend(rails(n).iter().filter_map(|rail| on.remove(&rail.name[..])).flatten());
            }
        }
        let most = joined.iter().map(|&n| counts[n]).max().unwrap_or_default();
        joined.into_iter().for_each(|n| counts[n] = most);
    }
}

/// What a number of samples leaves.
enum Trial {
    /// The larger of both lengths, as a share of the tolerance.
    Off(f64),
    /// The corners need so many.
    TooFew(usize),
}

/// The number of samples that the tolerance of a panel takes; that which it has, where it can't be
/// sampled, which making it says.
fn wanted(design: &Design, panel: &DesignPanel) -> usize {
    let most = panel.most_by_tolerance();
    let tried = |samples: usize| trial(design, panel, samples).ok();
    let (mut few, mut share) = match tried(panel.samples) {
        Some(Trial::Off(share)) => (panel.samples, share),
        Some(Trial::TooFew(needed)) => match tried(needed) {
            Some(Trial::Off(share)) => (needed, share),
            _ => return panel.samples,
        },
        None => return panel.samples,
    };
    if share <= 1.0 || few >= most {
        return few;
    }
    // `few` are too few; `enough` are enough, if the limit is.
    let mut enough = most + 1;
    let mut last = few;
    for n in 0..MOST_TRIALS {
        if enough - few <= 1 {
            break;
        }
        let next = if n % 3 == 2 {
            usize::midpoint(few, enough)
        } else {
            (last as f64 * share.sqrt()).ceil().min(most as f64) as usize
        };
        last = next.clamp(few + 1, enough - 1);
        let Some(Trial::Off(left)) = tried(last) else { return panel.samples };
        share = left;
        if share <= 1.0 {
            enough = last;
        } else {
            few = last;
        }
    }
    enough.min(most)
}

/// What this number of samples leaves of the tolerance of a panel.
fn trial(design: &Design, panel: &DesignPanel, samples: usize) -> Result<Trial, PanelError> {
    let Some(tolerance) = panel.tolerance else { return Ok(Trial::Off(0.0)) };
    // New ends of rails that run on are sampled as the rails are.
    let panel = DesignPanel { samples, run_on: false, ..panel.clone() };
    let sampler = Sampler { design, matched: &Matched::new() };
    let mut sampled = match sampled(&sampler, &panel) {
        Err(error) => {
            return match error.cause {
                PanelCause::Sampling(SampleError::TooFew { needed, .. }) if needed > samples => {
                    Ok(Trial::TooFew(needed))
                }
                _ => Err(error),
            };
        }
        Ok(sampled) => sampled,
    };
    let outer = sampled.loops.iter().take(1).flatten();
    let most_mm = tolerance.mm(size_of(outer.map(|s| s.sample.position)));
    if let SampleTolerance::Share(_) = tolerance {
        // Holes have the spacing of the outline.
        sampled.loops.truncate(1);
    }
    let mut begin = 0;
    let range = |samples: &Vec<_>| {
        let range = begin..begin + samples.len();
        begin = range.end;
        range
    };
    let loops: Vec<Range<usize>> = sampled.loops.iter().map(range).collect();
    let (sources, steps) = (sampled.loops.concat(), sampled.steps.concat());
    let chords = Chords::new(design, &sources, &steps, &loops);
    let both = [chords.distance_max_mm(), chords.shorter_max_mm()];
    Ok(Trial::Off(both.into_iter().flatten().fold(0.0, f64::max) / most_mm))
}
