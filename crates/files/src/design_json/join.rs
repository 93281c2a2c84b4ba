//! Panels that join others: their fields, and the checks of the names of the joined panels.

use super::grammar::{PanelFile, SmoothName, WithinFile};
use super::source::Source;
use crate::names::{did_you_mean, shown};
use crate::reading::InputError;
use crate::table::{RANGE_HINT, in_range_mm};
use crate::units::Units;
use sheetwright::boundary::{Continuity, MAX_SAMPLES, Within};
use sheetwright::design::{CurveUse, DesignCurve, DesignPanel, Join, PanelShape};
use std::collections::BTreeMap;

/// The most panels of a join: joining tries them in turn until all are connected.
const MAX_PARTS: usize = 100;

/// The join that the fields of a panel describe; `None` for a panel that is no join. `path` is the
/// panel's JSON path.
pub(super) fn join(
    file: &PanelFile,
    units: Units,
    path: &str,
    source: &Source<'_>,
) -> Result<Option<PanelShape>, InputError> {
    let at = |field: &str| format!("{path}{field}");
    let Some(parts) = &file.join else {
        for (field, given) in [
            (".smooth", file.smooth.is_some()),
            (".within", file.within.is_some()),
            (".keep_parts", file.keep_parts.is_some()),
        ] {
            if given {
                let hint = "Add \"join\": [\"left\", \"right\"], or leave this field out.";
                return Err(source.error(&at(field), "the panel joins no others", hint));
            }
        }
        return Ok(None);
    };
    let others = [
        ("rails", file.rails.is_some()),
        ("boundary", file.boundary.is_some()),
        ("holes", file.holes.is_some()),
    ];
    if let Some((field, _)) = others.into_iter().find(|(_, given)| *given) {
        let message = format!("the panel joins others and has `{field}` of its own");
        let hint = "Keep one of the two: a join has the boundary, and the holes, of its parts.";
        return Err(source.error(&at(""), message, hint));
    }
    if !(2..=MAX_PARTS).contains(&parts.len()) {
        let message = match parts.len() {
            0 => "`join` names no panel".to_owned(),
            1 => "`join` names one panel only".to_owned(),
            many => format!("`join` names {many} panels"),
        };
        let hint = format!("Name 2 to {MAX_PARTS} panels that share an edge or a sample.");
        return Err(source.error(&at(".join"), message, hint));
    }
    let smooth = match file.smooth {
        None | Some(SmoothName::None) => Continuity::G0,
        Some(SmoothName::G1) => Continuity::G1,
        Some(SmoothName::G2) => Continuity::G2,
    };
    if smooth == Continuity::G0 && file.within.is_some() {
        let message = "`within` applies to smooth joints only";
        let hint = "Add \"smooth\": \"G1\" or \"G2\", or leave `within` out.";
        return Err(source.error(&at(".within"), message, hint));
    }
    let within = match &file.within {
        None => Within::default(),
        Some(WithinFile::Way(way)) => {
            let mm = in_range_mm(*way, units).ok_or_else(|| {
                let message = format!("the distance {way:e} {} is out of range", units.name());
                source.error(&at(".within"), message, RANGE_HINT)
            })?;
            Within::Mm(mm)
        }
        Some(WithinFile::Share(of)) => Within::Share(of.share),
    };
    if !within.is_valid() {
        let message = "`within` is neither a distance above 0 nor a share above 0 and up to 0.5";
        let hint = "Write a distance, such as 40, or a share of the boundary, such as \
                    {\"share\": 0.05}.";
        return Err(source.error(&at(".within"), message, hint));
    }
    let keep_parts = file.keep_parts.unwrap_or(false);
    Ok(Some(PanelShape::Join(Join { parts: parts.clone(), smooth, within, keep_parts })))
}

/// The number of points of all curves of a panel. A curve counts once per use, since the kernel
/// builds it anew at each use.
pub(super) fn points_of(shape: &PanelShape, known: &BTreeMap<&str, &DesignCurve>) -> usize {
    let uses: Vec<&CurveUse> = match shape {
        PanelShape::Rails(rails) => rails.iter().collect(),
        PanelShape::Loops { outer, holes } => outer.iter().chain(holes.iter().flatten()).collect(),
        PanelShape::Join(_) | PanelShape::Mesh(_) => Vec::new(),
    };
    uses.iter().filter_map(|u| known.get(u.name.as_str())).map(|c| c.points.len()).sum()
}

/// Refuses joins of panels that do not exist, that the join names twice, or that are joins
/// themselves.
pub(super) fn check_joins(
    panels: &[DesignPanel],
    curves: &BTreeMap<&str, &DesignCurve>,
    error: &dyn Fn(&str, String, String) -> InputError,
) -> Result<(), InputError> {
    let known: BTreeMap<&str, &DesignPanel> = panels.iter().map(|p| (p.name.as_str(), p)).collect();
    for (n, panel) in panels.iter().enumerate() {
        let PanelShape::Join(join) = &panel.shape else { continue };
        let mut points = 0;
        for (place, name) in join.parts.iter().enumerate() {
            let refused = |message: String, hint: String| {
                error(&format!("panels[{n}].join[{place}]"), message, hint)
            };
            let shown = shown(name);
            match known.get(name.as_str()) {
                None => {
                    let simple = |p: &&DesignPanel| !matches!(p.shape, PanelShape::Join(_));
                    let names: Vec<&str> =
                        panels.iter().filter(simple).map(|p| p.name.as_str()).collect();
                    let hint = did_you_mean(name, &names);
                    return Err(refused(format!("there is no panel {shown}"), hint));
                }
                Some(part) if matches!(part.shape, PanelShape::Join(_)) => {
                    let message = if *name == panel.name {
                        "the panel joins itself".to_owned()
                    } else {
                        format!("the panel {shown} is a join itself")
                    };
                    let hint = "Name the panels that it joins.".to_owned();
                    return Err(refused(message, hint));
                }
                Some(part) => points += points_of(&part.shape, curves),
            }
            if join.parts[..place].contains(name) {
                let hint = "Name each panel once.".to_owned();
                return Err(refused(format!("the list names the panel {shown} twice"), hint));
            }
        }
        if points > MAX_SAMPLES {
            let message = format!("the curves of the joined panels have {points} points in total");
            let hint = format!("The limit is {MAX_SAMPLES} points.");
            return Err(error(&format!("panels[{n}].join"), message, hint));
        }
    }
    Ok(())
}
