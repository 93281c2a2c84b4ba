//! Findings on the origin of a boundary: its curves, and how they were joined, run on and moved.

use super::{Bend, Checked, Finding, FindingKind, Hindrance, Movement, Place, Severity, Verdict};
use crate::design::{DesignPanel, PanelShape, SampleTolerance};
use crate::fair::Ended;
use crate::measure::{Measures, RungMeasures};
use crate::sample::Chords;
use sheetwright_geometry::boundary::Joined;
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{angle_between, to_deg};

/// Points where a spline turns by more than this without being a corner, degrees, give a finding:
/// they may be meant as corners. A smooth closed curve of eight points turns by 45° at each.
const ROUNDED_CORNER_DEG: f64 = 60.0;

/// The finding that the points of a spline turn sharply where no corner is marked, so that the
/// curve runs round a corner that its maker may have meant; `None` if they do not. `points` are
/// those of the curve of this name.
pub(crate) fn rounded_corner(name: &str, points: &[CurvePoint], closed: bool) -> Option<Finding> {
    let m = points.len();
    let inner = if closed { 0..m } else { 1..m.saturating_sub(1) };
    let turn = |i: usize| {
        let at = |k: usize| points[k % m].at;
        angle_between(at(i) - at(i + m - 1), at(i + 1) - at(i))
    };
    let rounded: Vec<(usize, f64)> = inner
        .filter(|&i| !points[i].corner)
        .map(|i| (i, turn(i)))
        .filter(|(_, turn)| to_deg(*turn) > ROUNDED_CORNER_DEG)
        .collect();
    let turn = rounded.iter().map(|(_, turn)| *turn).reduce(f64::max)?;
    let kind = FindingKind::RoundedCorner { curve: name.to_owned(), turn };
    let numbers = rounded.iter().map(|(i, _)| *i).collect();
    Some(Finding::new(kind, Place::CurvePoints { curve: name.to_owned(), numbers }))
}

/// What a tolerance may be exceeded by without a finding, as a share: the numbers of samples were
/// found without new ends of rails and matched seams, and between samples that have lost their
/// places the curves are known to that.
const TOLERANCE_SLACK: f64 = 0.01;

/// The finding that the polygon through the samples of a panel lies farther from its curves, or is
/// shorter along an edge, than its tolerance in mm; `None` if it does not, and where only holes do
/// by the usual tolerance, which does not count for them.
pub(crate) fn off_tolerance(
    panel: &DesignPanel,
    chords: &Chords,
    tolerance_mm: f64,
) -> Option<Finding> {
    let (distance_mm, shorter_mm) = (chords.distance_max_mm()?, chords.shorter_max_mm()?);
    let is_rails = matches!(panel.shape, PanelShape::Rails(_));
    let is_usual = matches!(panel.tolerance, Some(SampleTolerance::Share(_)));
    let (samples, is_most) = (panel.samples, panel.samples >= panel.most_by_tolerance());
    let is_within = distance_mm.max(shorter_mm) <= tolerance_mm * (1.0 + TOLERANCE_SLACK);
    if is_within || is_usual && !is_most {
        return None;
    }
    Some(Finding::of_whole(FindingKind::OffTolerance {
        distance_mm,
        shorter_mm,
        tolerance_mm,
        samples,
        is_rails,
        is_usual,
        is_most,
    }))
}

/// The finding that a boundary was made smooth where the panels that it joins meet; `None` if it
/// was left as it came.
pub(crate) fn smoothed_joints(joined: &Joined) -> Option<Finding> {
    let smoothed = joined.joints.iter().filter(|joint| joint.window.is_some());
    let numbers: Vec<SampleIndex> = smoothed.map(|joint| joint.sample).collect();
    let count = numbers.len();
    let kind = FindingKind::JointsSmoothed { count, deviation_mm: joined.deviation_mm() };
    (count > 0).then(|| Finding::new(kind, Place::Samples { numbers }))
}

/// The finding that the rails of a panel run on, with the shape of its ends and how it bends: a
/// warning if both the largest warp and the smallest bend radius are worse than with straight ends.
/// `bulges_mm` is how far the end at the beginning of the first rail, and that at its end, bulge
/// from the straight line, mm; `None` for an end that stays straight. `straight` are the measures
/// of the same panel with straight ends, if it can be made.
pub(crate) fn ran_on(
    bulges_mm: [Option<f64>; 2],
    measures: &Measures,
    straight: Option<&Measures>,
) -> Finding {
    let bend = |m: &Measures| Bend { warp: m.warp_max, radius_mm: m.bend_radius_min_mm };
    let is_bent = bulges_mm != [None; 2];
    let bends = straight.filter(|_| is_bent).map(|straight| [measures, straight].map(bend));
    Finding::of_whole(FindingKind::RanOn { bulges_mm, bends })
}

/// The finding that the rails of a panel can't run on, so that its ends stay straight. `cause` is
/// the error of the panel with the new ends, in words.
pub(crate) fn stayed_straight(cause: &str) -> Finding {
    Finding::of_whole(FindingKind::StayedStraight { cause: cause.to_owned() })
}

/// The finding that some of the joined panels were turned round to face as the first does; `None`
/// if all do. `names` are theirs.
pub(crate) fn turned_round(joined: &Joined, names: &[String]) -> Option<Finding> {
    let turned = names.iter().zip(&joined.turned).filter(|(_, turned)| **turned);
    let panels: Vec<String> = turned.map(|(name, _)| name.clone()).collect();
    let first = names.first()?.clone();
    let is_any = !panels.is_empty();
    is_any.then(|| Finding::of_whole(FindingKind::TurnedRound { panels, first }))
}

/// How a boundary was moved so that the sheet bends better.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundaryMoved<'a> {
    /// How it ended.
    pub(crate) ended: &'a Ended,
    /// The largest warp angle that is the goal, radians, if one is.
    pub(crate) wanted: Option<f64>,
    /// The curves of the panel that moved, by name.
    pub(crate) curves: &'a [String],
    /// The largest distance that a sample was moved, mm.
    pub(crate) moved_max_mm: f64,
    /// All those distances, summed, mm.
    pub(crate) moved_total_mm: f64,
    /// The size of the boundary, mm.
    pub(crate) size_mm: f64,
    /// The measures before.
    pub(crate) before: &'a Measures,
    /// The measures now.
    pub(crate) after: &'a Measures,
    /// The findings now.
    pub(crate) checked: &'a Checked,
}

/// The finding that a boundary was moved, with the change of warp and twist: a warning if the goal
/// is not reached.
pub(crate) fn moved(moving: &BoundaryMoved<'_>) -> Finding {
    let BoundaryMoved { ended, wanted, before, after, .. } = *moving;
    let missed = wanted.filter(|&wanted| after.warp_max > wanted);
    let movement = Movement {
        curves: moving.curves.to_vec(),
        moved_max_mm: moving.moved_max_mm,
        moved_total_mm: moving.moved_total_mm,
        size_mm: moving.size_mm,
        warp: [before, after].map(|m| m.warp_max),
        twist: [before, after].map(|m| m.twist_total),
    };
    let hindrance = hindrance(moving.checked);
    match (ended, missed) {
        (Ended::NothingToDo, missed) => {
            let is_above = missed.is_some();
            Finding::of_whole(FindingKind::NotMoved { movement, wanted, is_above, hindrance })
        }
        (ended, Some(wanted)) => {
            let kind = FindingKind::WarpNotReached { movement, wanted, ended: ended.clone() };
            let resists = |rung: &RungMeasures| to_deg(rung.warp) > to_deg(wanted);
            Finding::new(kind, Place::rungs(&after.rungs, resists))
        }
        (ended, None) => {
            let ended = ended.clone();
            Finding::of_whole(FindingKind::Moved { movement, ended, hindrance })
        }
    }
}

impl Checked {
    /// Leaves out the angles that a boundary was moved for in place of a strain: they are steps of
    /// the search, no goals of the design.
    pub(crate) fn forget_angles(&mut self) {
        for Finding { kind, place } in &mut self.findings {
            match kind {
                FindingKind::NotMoved { wanted, is_above, .. } => {
                    (*wanted, *is_above) = (None, false);
                }
                FindingKind::Moved { hindrance, .. } => *hindrance = None,
                FindingKind::WarpNotReached { movement, ended, .. } => {
                    let (movement, ended) = (movement.clone(), ended.clone());
                    *kind = FindingKind::Moved { movement, ended, hindrance: None };
                    *place = Place::Whole;
                }
                _ => {}
            }
        }
        // What was a warning may be a note now.
        self.sort();
    }
}

/// What keeps a panel from bending although its warp angles reach the goal.
fn hindrance(checked: &Checked) -> Option<Hindrance> {
    let is_error = |finding: &&Finding| finding.severity() == Severity::Error;
    let has = |is_it: fn(&FindingKind) -> bool| {
        checked.findings.iter().filter(is_error).any(|finding| is_it(&finding.kind))
    };
    if checked.verdict != Verdict::WillNotBend {
        None
    } else if has(|kind| matches!(kind, FindingKind::StrainTooLarge { .. })) {
        Some(Hindrance::Strain)
    } else if has(|kind| matches!(kind, FindingKind::RadiusTooSmall { .. })) {
        Some(Hindrance::Radius)
    } else {
        Some(Hindrance::Other)
    }
}
