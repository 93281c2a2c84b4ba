//! A mark from its file's form to the kernel's.

use super::form::{KindFile, PlaceFile, StationFile};
use crate::design_json::in_our_words;
use crate::design_json::trims::{LengthFile, OneOrMore, Problem, Reader, Written, problem};
use crate::names::{refused_anywhere, shown};
use crate::table::{RANGE_HINT, in_range_mm};
use serde_json::Value;
use sheetwright::design::{Mark, MarkAt, MarkKind, MarkOn, MarkWay, StationPlaces, StationPlane};
use sheetwright::math::{Point2, Point3, Vec3, from_deg, unit};

const ON_HINT: &str = "Write the name of a part or panel, all, or a list of names.";
const PLACE_HINT: &str =
    "Write three numbers of a place in space, [x, y, z], or two of one on the pattern, [x, y].";
/// A place in space may be so far off a part, mm, unless a mark says.
const WITHIN_MM: f64 = 1.0;
/// The length of an arrow of the grain, mm, unless a mark says.
const GRAIN_MM: f64 = 100.0;
/// That of an arrow of a face.
const FACE_MM: f64 = 50.0;

/// A mark, or what is wrong with it and what to do.
pub(super) fn mark(reader: &Reader, mut written: Written) -> Result<Mark, Problem> {
    let on = match written.remove("on") {
        None => vec!["all".to_owned()],
        Some(on) => match serde_json::from_value::<OneOrMore>(on) {
            Ok(OneOrMore::One(one)) => vec![one],
            Ok(OneOrMore::More(list)) if !list.is_empty() => list,
            Ok(OneOrMore::More(_)) => return Err(problem("the list `on` is empty", ON_HINT)),
            Err(_) => return Err(problem("`on` is neither a text nor a list of texts", ON_HINT)),
        },
    };
    let is_place = |at: &Value| {
        let numbers = at.as_array().filter(|list| list.iter().all(Value::is_number));
        numbers.is_some_and(|list| (2..=3).contains(&list.len()))
    };
    let at = written.get("at").filter(|_| written.get("kind") != Some(&"stations".into()));
    if let Some(at) = at.filter(|at| !is_place(at)) {
        return Err(problem(format!("`at` is {}", shown(&at.to_string())), PLACE_HINT));
    }
    let kind = serde_json::from_value(Value::Object(written))
        .map_err(|error: serde_json::Error| in_our_words(&error.to_string()))?;
    let of_name = |name: String| match &name[..] {
        "all" => MarkOn::All,
        _ => MarkOn::Part { name },
    };
    Ok(Mark { on: on.into_iter().map(of_name).collect(), kind: of_kind(reader, kind)? })
}

fn of_kind(reader: &Reader, kind: KindFile) -> Result<MarkKind, Problem> {
    Ok(match kind {
        KindFile::Stations { axis, at, pitch, from } => {
            MarkKind::Stations { axis: axis.into(), at: stations(reader, at, pitch, from)? }
        }
        KindFile::Grain { toward, edge, angle_deg, length } => MarkKind::Grain {
            way: way(toward, edge, angle_deg)?,
            length: reader.above_0_or("length", length, GRAIN_MM)?,
        },
        KindFile::Fold { edge } => MarkKind::Fold { edge },
        KindFile::Face { text, toward, length } => MarkKind::Face {
            text: said("text", text.unwrap_or_else(|| "face up".to_owned()))?,
            toward: direction(toward.unwrap_or([0.0, 0.0, 1.0]))?,
            length: reader.above_0_or("length", length, FACE_MM)?,
        },
        KindFile::Drill { at, within, diameter } => MarkKind::Drill {
            at: place(reader, &at, within)?,
            diameter: reader.above_0("diameter", &diameter)?,
        },
        KindFile::Text { text, at, within, height } => MarkKind::Text {
            at: at.map(|at| place(reader, &at, within)).transpose()?,
            text: said("text", text)?,
            height: height.map(|height| reader.above_0("height", &height)).transpose()?,
        },
    })
}

fn stations(
    reader: &Reader,
    at: Option<Vec<StationFile>>,
    pitch: Option<f64>,
    from: Option<f64>,
) -> Result<StationPlaces, Problem> {
    match (at, pitch) {
        (Some(list), None) if from.is_none() => {
            let plane = |station: StationFile| {
                let (at, name) = match station {
                    StationFile::Place(at) => (at, None),
                    StationFile::Named(station) => (station.at, Some(station.name)),
                };
                let name = name.map(|name| said("name", name)).transpose()?;
                Ok(StationPlane { at: mm(reader, at)?, name })
            };
            Ok(StationPlaces::Listed {
                planes: list.into_iter().map(plane).collect::<Result<_, Problem>>()?,
            })
        }
        (None, Some(pitch)) => {
            let pitch_mm = mm(reader, pitch)?;
            if pitch_mm <= 0.0 {
                let hint = "Write the distance of two stations, above 0.";
                return Err(problem(format!("`pitch` is {pitch}"), hint));
            }
            Ok(StationPlaces::Every { pitch: pitch_mm, from: mm(reader, from.unwrap_or(0.0))? })
        }
        (None, None) => {
            let hint = "Add \"at\": [500, 1000], or \"pitch\": 500.";
            Err(problem("the stations have neither `at` nor `pitch`", hint))
        }
        _ => {
            let hint = "Keep `at` alone, or `pitch` with `from`.";
            Err(problem("the stations have `at` beside `pitch` or `from`", hint))
        }
    }
}

fn way(
    toward: Option<[f64; 3]>,
    edge: Option<String>,
    angle_deg: Option<f64>,
) -> Result<MarkWay, Problem> {
    match (toward, edge, angle_deg) {
        (Some(toward), None, None) => Ok(MarkWay::Space { way: direction(toward)? }),
        (None, Some(edge), None) => Ok(MarkWay::Edge { edge }),
        (None, None, angle_deg) => {
            let angle_deg = angle_deg.unwrap_or(0.0);
            if angle_deg.abs() > 360.0 {
                let hint = "Write an angle from -360° to 360°.";
                return Err(problem(format!("`angle_deg` is {angle_deg}"), hint));
            }
            Ok(MarkWay::Angle { angle: from_deg(angle_deg) })
        }
        _ => {
            let message = "it has two of `toward`, `edge` and `angle_deg`";
            Err(problem(message, "Keep one of them."))
        }
    }
}

fn direction([x, y, z]: [f64; 3]) -> Result<Vec3, Problem> {
    let way = Vec3::new(x, y, z);
    let hint = "Write a direction in space that is not [0, 0, 0].";
    unit(way).map(|_| way).ok_or_else(|| problem(format!("`toward` is [{x}, {y}, {z}]"), hint))
}

fn place(reader: &Reader, at: &PlaceFile, within: Option<LengthFile>) -> Result<MarkAt, Problem> {
    match *at {
        PlaceFile::Space(at) => {
            let within = reader.above_0_or("within", within, WITHIN_MM)?;
            let [x, y, z] = at;
            let at = Point3::new(mm(reader, x)?, mm(reader, y)?, mm(reader, z)?);
            Ok(MarkAt::Space { at, within })
        }
        PlaceFile::Flat([x, y]) => {
            if within.is_some() {
                let hint = "Leave `within` out, or write a place in space, [x, y, z].";
                return Err(problem("a place on the pattern has no `within`", hint));
            }
            Ok(MarkAt::Flat { at: Point2::new(mm(reader, x)?, mm(reader, y)?) })
        }
    }
}

fn mm(reader: &Reader, number: f64) -> Result<f64, Problem> {
    in_range_mm(number, reader.units)
        .ok_or_else(|| problem(format!("{number} is too far"), RANGE_HINT))
}

/// A text of one line that files can hold.
fn said(field: &str, text: String) -> Result<String, Problem> {
    match refused_anywhere(&text) {
        None => Ok(text),
        Some(why) => {
            let message = format!("`{field}` {} {why}", shown(&text));
            Err(problem(message, "Write a short text in one line."))
        }
    }
}
