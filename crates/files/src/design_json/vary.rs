//! The field `vary`, which says what may move: from a design's file and back.

use super::grammar::{MovedByName, VaryFile};
use super::source::Source;
use crate::names::{did_you_mean, shown};
use crate::quantity::{MOST_WARP_DEG, strain_shares};
use crate::reading::InputError;
use crate::table::in_range_mm;
use crate::units::Units;
use sheetwright::design::VaryGoal;
use sheetwright::design::{DesignCurve, DesignPanel, MovedBy, Vary};
use sheetwright::math::{from_deg, to_deg};

pub(crate) const WARP_HINT: &str = "Set an angle above 0° and up to 90°.";
pub(crate) const STRAIN_HINT: &str = "Set a share of what the sheet takes, from 0.05 to 1: 0.8.";
const DISTANCE_HINT: &str = "Write a distance of 0 or more, in the units of the design.";

/// Reads the field `vary` of a design and of its panels.
pub(super) struct VaryReader<'a> {
    pub(super) units: Units,
    pub(super) curves: &'a [DesignCurve],
    pub(super) source: &'a Source<'a>,
}

impl VaryReader<'_> {
    /// `path` is its JSON path; `of_panel` is the panel that contains it, `None` for the design's
    /// own.
    pub(super) fn read(
        &self,
        file: VaryFile,
        path: &str,
        of_panel: Option<&str>,
        panels: &[DesignPanel],
    ) -> Result<Vary, InputError> {
        let error = |field: &str, message: String, hint: String| {
            self.source.error(&format!("{path}{field}"), message, hint)
        };
        let distance = |field: &str, written: Option<f64>| {
            let Some(written) = written else { return Ok(None) };
            match in_range_mm(written, self.units).filter(|mm| *mm >= 0.0) {
                Some(mm) => Ok(Some(mm)),
                None => {
                    let message = format!(
                        "the distance is {} {}",
                        crate::table::number(written),
                        self.units.name()
                    );
                    Err(error(field, message, DISTANCE_HINT.to_owned()))
                }
            }
        };
        let known = |field: &str, written: Option<Vec<String>>, what: &str, known: &[&str]| {
            let Some(names) = written else { return Ok(Vec::new()) };
            if names.is_empty() {
                let hint = format!("Name a {what}, or leave the list out to take all {what}s.");
                return Err(error(field, format!("the list of {what}s is empty"), hint));
            }
            match names.iter().position(|name| !known.contains(&name.as_str())) {
                None => Ok(names),
                Some(n) => {
                    let message = format!("there is no {what} {}", shown(&names[n]));
                    let hint = did_you_mean(&names[n], known);
                    Err(error(&format!("{field}[{n}]"), message, hint))
                }
            }
        };
        let curve_names: Vec<&str> = self.curves.iter().map(|c| c.name.as_str()).collect();
        let panel_names: Vec<&str> = panels.iter().map(|p| p.name.as_str()).collect();
        let panels = match (of_panel, file.panels) {
            (None, panels) => known(".panels", panels, "panel", &panel_names)?,
            (Some(panel), None) => vec![panel.to_owned()],
            (Some(_), Some(_)) => {
                let message = "the `vary` of a panel has no `panels`".to_owned();
                let hint =
                    "Leave `panels` out, or write `vary` beside `panels`, for the whole design.";
                return Err(error(".panels", message, hint.to_owned()));
            }
        };
        if let (Some(_), Some(_)) = (file.warp_deg, file.strain) {
            let message = "`vary` has two goals, `warp_deg` and `strain`".to_owned();
            return Err(error("", message, "Keep one of the two.".to_owned()));
        }
        let strain = file.strain.map(|share| {
            if strain_shares().contains(&share) {
                Ok(VaryGoal::Strain { share })
            } else {
                let message = format!("the share of the strain is {share}");
                Err(error(".strain", message, STRAIN_HINT.to_owned()))
            }
        });
        let goal = match file.warp_deg {
            None => strain.transpose()?.unwrap_or(VaryGoal::Price),
            Some(deg) if deg > 0.0 && deg <= MOST_WARP_DEG => {
                VaryGoal::Warp { largest: from_deg(deg) }
            }
            Some(deg) => {
                let message = format!("the warp angle is {deg}°");
                return Err(error(".warp_deg", message, WARP_HINT.to_owned()));
            }
        };
        Ok(Vary {
            panels,
            curves: known(".curves", file.curves, "curve", &curve_names)?,
            goal,
            limit_mm: distance(".limit", file.limit)?,
            budget_mm: distance(".budget", file.budget)?,
            by: match file.by {
                None | Some(MovedByName::Points) => MovedBy::Points,
                Some(MovedByName::Samples) => MovedBy::Samples,
            },
            leave_developable: file.leave_developable.unwrap_or(true),
        })
    }
}

/// The field `vary` of a file in millimetres: of a panel if `in_panel`, else of the design.
pub(super) fn written(vary: &Vary, in_panel: bool) -> VaryFile {
    let some = |list: &Vec<String>| (!list.is_empty()).then(|| list.clone());
    VaryFile {
        budget: vary.budget_mm,
        limit: vary.limit_mm,
        warp_deg: match vary.goal {
            VaryGoal::Price | VaryGoal::Strain { .. } => None,
            VaryGoal::Warp { largest } => Some(plain_deg(largest)),
        },
        strain: match vary.goal {
            VaryGoal::Strain { share } => Some(share),
            VaryGoal::Price | VaryGoal::Warp { .. } => None,
        },
        curves: some(&vary.curves),
        panels: if in_panel { None } else { some(&vary.panels) },
        by: match vary.by {
            MovedBy::Points => None,
            MovedBy::Samples => Some(MovedByName::Samples),
        },
        leave_developable: (!vary.leave_developable).then_some(false),
    }
}

/// Degrees from radians, with the fewest decimals that convert back to the same radians.
fn plain_deg(angle: f64) -> f64 {
    let deg = to_deg(angle);
    let short = |digits: usize| format!("{deg:.digits$}").parse::<f64>().ok();
    let exact = (0..=15).filter_map(short).find(|short| from_deg(*short) == angle);
    exact.unwrap_or(deg)
}
