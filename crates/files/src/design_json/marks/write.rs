//! A mark from the kernel's form to its file's.

use super::form::{KindFile, MarkFile, NamedStation, PlaceFile, StationFile};
use crate::design_json::trims::{LengthFile, OneOrMore};
use crate::units::Units;
use sheetwright::design::{Mark, MarkAt, MarkKind, MarkOn, MarkWay, StationPlaces, StationPlane};
use sheetwright::math::to_deg;

/// A mark as its file has it, in units.
pub(super) fn file_of(mark: &Mark, units: Units) -> MarkFile {
    let name = |on: &MarkOn| match on {
        MarkOn::All => "all".to_owned(),
        MarkOn::Part { name } => name.clone(),
    };
    let names: Vec<String> = mark.on.iter().map(name).collect();
    let on = match &names[..] {
        [one] => OneOrMore::One(one.clone()),
        _ => OneOrMore::More(names),
    };
    MarkFile { on: Some(on), kind: kind_file(&mark.kind, units) }
}

fn kind_file(kind: &MarkKind, units: Units) -> KindFile {
    let some = |length: f64| Some(LengthFile::of_mm(length));
    let number = |mm: f64| units.number(mm);
    match kind {
        MarkKind::Stations { axis, at } => {
            let axis = (*axis).into();
            match at {
                StationPlaces::Listed { planes } => {
                    let station = |plane: &StationPlane| match &plane.name {
                        None => StationFile::Place(number(plane.at)),
                        Some(name) => StationFile::Named(NamedStation {
                            at: number(plane.at),
                            name: name.clone(),
                        }),
                    };
                    let at = Some(planes.iter().map(station).collect());
                    KindFile::Stations { axis, at, pitch: None, from: None }
                }
                StationPlaces::Every { pitch, from } => {
                    let (pitch, from) = (Some(number(*pitch)), Some(number(*from)));
                    KindFile::Stations { axis, at: None, pitch, from }
                }
            }
        }
        MarkKind::Grain { way, length } => {
            let (toward, edge, angle_deg) = match way {
                MarkWay::Space { way } => (Some(way.to_array()), None, None),
                MarkWay::Edge { edge } => (None, Some(edge.clone()), None),
                MarkWay::Angle { angle } => (None, None, Some(to_deg(*angle))),
            };
            KindFile::Grain { toward, edge, angle_deg, length: some(*length) }
        }
        MarkKind::Fold { edge } => KindFile::Fold { edge: edge.clone() },
        MarkKind::Face { text, toward, length } => KindFile::Face {
            text: Some(text.clone()),
            toward: Some(toward.to_array()),
            length: some(*length),
        },
        MarkKind::Drill { at, diameter } => {
            let (at, within) = place(at, units);
            KindFile::Drill { at, within, diameter: LengthFile::of_mm(*diameter) }
        }
        MarkKind::Text { at, text, height } => {
            let (at, within) = at.as_ref().map(|at| place(at, units)).unzip();
            let height = height.map(LengthFile::of_mm);
            KindFile::Text { text: text.clone(), at, within: within.flatten(), height }
        }
    }
}

fn place(at: &MarkAt, units: Units) -> (PlaceFile, Option<LengthFile>) {
    let number = |mm: f64| units.number(mm);
    match *at {
        MarkAt::Space { at, within } => {
            (PlaceFile::Space([at.x, at.y, at.z].map(number)), Some(LengthFile::of_mm(within)))
        }
        MarkAt::Flat { at } => (PlaceFile::Flat([at.x, at.y].map(number)), None),
    }
}
