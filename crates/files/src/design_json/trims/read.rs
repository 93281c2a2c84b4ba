//! A trim from its file's form to the kernel's.

use super::Written;
use super::form::{KindFile, LengthFile, OneOrMore, WidthFile};
use crate::design_json::in_our_words;
use crate::names::shown;
use crate::quantity::read_length;
use crate::table::in_range_mm;
use crate::units::Units;
use serde_json::Value;
use sheetwright::design::{
    Allowance, Fingers, Flange, Hem, Holes, Notches, Places, Puzzle, Slots, Tabs, Ticks, Trim,
    TrimKind, TrimOn,
};
use sheetwright::math::from_deg;

const LENGTH_HINT: &str = "Write a number in the units of the design, or a text with a unit: \
     \"10 mm\"; \"2 t\" is two thicknesses of the sheet.";
const ON_HINT: &str = "Write PART/EDGE, an edge's name, or one of all, free, joined, cuts, holes; \
     or a list of these.";

pub(in crate::design_json) struct Reader {
    pub(in crate::design_json) units: Units,
    pub(in crate::design_json) thickness_mm: Option<f64>,
}

/// What is wrong, and what to do.
pub(in crate::design_json) type Problem = (String, String);

pub(in crate::design_json) fn problem(
    message: impl Into<String>,
    hint: impl Into<String>,
) -> Problem {
    (message.into(), hint.into())
}

impl Reader {
    /// A trim, or what is wrong with it and what to do.
    pub(super) fn trim(&self, mut written: Written) -> Result<Trim, Problem> {
        let of_json = |error: serde_json::Error| in_our_words(&error.to_string());
        let on = match written.remove("on") {
            None => return Err(problem("the field `on` is missing", ON_HINT)),
            Some(on) => serde_json::from_value::<OneOrMore>(on)
                .map_err(|_| problem("`on` is neither a text nor a list of texts", ON_HINT))?,
        };
        let span = match written.remove("span") {
            None => [0.0, 1.0],
            Some(span) => serde_json::from_value(span).map_err(of_json)?,
        };
        if !(0.0 <= span[0] && span[0] < span[1] && span[1] <= 1.0) {
            let hint = "Write two shares of the edge from 0 to 1, the smaller one first: [0, 0.5].";
            return Err(problem(format!("the span is {span:?}"), hint));
        }
        let kind = serde_json::from_value(Value::Object(written)).map_err(of_json)?;
        let on = match on {
            OneOrMore::One(one) => vec![one],
            OneOrMore::More(list) => list,
        };
        if on.is_empty() {
            return Err(problem("the list `on` is empty", ON_HINT));
        }
        Ok(Trim { on: on.iter().map(|on| on_of(on)).collect(), span, kind: self.kind(kind)? })
    }

    fn kind(&self, kind: KindFile) -> Result<TrimKind, Problem> {
        Ok(match kind {
            KindFile::Allowance { width, corners } => {
                let width = match width {
                    WidthFile::Even(width) => [self.above_0("width", &width)?; 2],
                    WidthFile::Ends([from, to]) => {
                        let ends = [self.mm("width", &from)?, self.mm("width", &to)?];
                        if ends[0].max(ends[1]) <= 0.0 {
                            return Err(problem("both widths are 0", LENGTH_HINT));
                        }
                        ends
                    }
                };
                TrimKind::Allowance(Allowance { width, corner: corners.into() })
            }
            KindFile::Hem { width, turn } => TrimKind::Hem(Hem {
                width: self.above_0("width", &width)?,
                turn: turn.map_or(Ok(0.0), |turn| self.mm("turn", &turn))?,
            }),
            KindFile::Flange { width, angle_deg, relief } => TrimKind::Flange(Flange {
                width: self.above_0("width", &width)?,
                angle: angle(angle_deg, 90.0, 180.0)?,
                relief: match relief {
                    Some(relief) => self.mm("relief", &relief)?,
                    None => (2.0 * self.thickness_mm.unwrap_or(0.0)).max(1.0),
                },
            }),
            KindFile::Tabs { width, angle_deg, tolerance } => TrimKind::Tabs(Tabs {
                width: self.above_0_or("width", width, 5.0)?,
                angle: angle(angle_deg, 45.0, 89.0)?,
                tolerance: self.above_0_or("tolerance", tolerance, 0.3)?,
            }),
            KindFile::Holes { pitch, end_pitch, end_length, ends, inset, diameter } => {
                let pitch = self.above_0("pitch", &pitch)?;
                let end_pitch = self.above_0_or("end_pitch", end_pitch, pitch)?;
                let diameter = self.above_0("diameter", &diameter)?;
                TrimKind::Holes(Holes {
                    pitch,
                    end_pitch,
                    end_length: end_length.map_or(Ok(0.0), |l| self.mm("end_length", &l))?,
                    ends: ends.map_or(Ok(0.5 * end_pitch), |l| self.mm("ends", &l))?,
                    inset: self.above_0_or("inset", inset, 3.0 * diameter)?,
                    diameter,
                })
            }
            KindFile::Notches { at, at_lengths, every, form, depth, width, count, gap } => {
                let depth = self.above_0_or("depth", depth, 4.0)?;
                let width = self.above_0_or("width", width, depth)?;
                let count = count.unwrap_or(1);
                if !(1..=3).contains(&count) {
                    let message = format!("`count` is {count}");
                    return Err(problem(message, "Write 1, 2 or 3 notches side by side."));
                }
                TrimKind::Notches(Notches {
                    at: self.places(at, at_lengths, every)?,
                    form: form.into(),
                    depth,
                    width,
                    count,
                    gap: self.above_0_or("gap", gap, 2.0 * width)?,
                })
            }
            KindFile::Ticks { at, at_lengths, every, length, numbered } => TrimKind::Ticks(Ticks {
                at: self.places(at, at_lengths, every)?,
                length: self.above_0_or("length", length, 4.0)?,
                numbered,
            }),
            KindFile::Fingers { width, depth, clearance } => {
                let hint = "Name a material, or write the `depth` of the fingers.";
                let depth = self.as_thick("depth", depth, hint)?;
                TrimKind::Fingers(Fingers {
                    width: self.above_0_or("width", width, 3.0 * depth)?,
                    depth,
                    clearance: clearance.map_or(Ok(0.0), |l| self.mm("clearance", &l))?,
                })
            }
            KindFile::Slots { pitch, width, depth, thickness, clearance, beyond, dogbone } => {
                let hint = "Name a material, or write the `thickness` of the tabs.";
                let thickness = self.as_thick("thickness", thickness, hint)?;
                let width = self.above_0_or("width", width, 5.0 * thickness)?;
                TrimKind::Slots(Slots {
                    pitch: self.above_0_or("pitch", pitch, 3.0 * width)?,
                    width,
                    depth: self.above_0_or("depth", depth, thickness)?,
                    thickness,
                    clearance: clearance.map_or(Ok(0.0), |l| self.mm("clearance", &l))?,
                    beyond: self.above_0_or("beyond", beyond, 2.0 * thickness)?,
                    dogbone: dogbone.map_or(Ok(0.0), |l| self.mm("dogbone", &l))?,
                })
            }
            KindFile::Puzzle { pitch, width, clearance } => {
                let width = self.above_0_or("width", width, 50.0)?;
                TrimKind::Puzzle(Puzzle {
                    pitch: self.above_0_or("pitch", pitch, 2.0 * width)?,
                    width,
                    clearance: clearance.map_or(Ok(0.6), |l| self.mm("clearance", &l))?,
                })
            }
        })
    }

    /// A length that is the thickness of the sheet where none is written.
    fn as_thick(
        &self,
        field: &str,
        written: Option<LengthFile>,
        hint: &'static str,
    ) -> Result<f64, Problem> {
        match (written, self.thickness_mm) {
            (Some(length), _) => self.above_0(field, &length),
            (None, Some(thickness)) => Ok(thickness),
            (None, None) => Err(problem("the thickness of the sheet is not known", hint)),
        }
    }

    fn places(
        &self,
        at: Option<Vec<f64>>,
        at_lengths: Option<Vec<LengthFile>>,
        every: Option<LengthFile>,
    ) -> Result<Places, Problem> {
        match (at, at_lengths, every) {
            (None, None, None) => Ok(Places::Shares(vec![0.5])),
            (Some(shares), None, None) => {
                if let Some(share) = shares.iter().find(|share| !(0.0..=1.0).contains(*share)) {
                    let hint = "Write shares of the edge from 0 to 1: [0.25, 0.75].";
                    return Err(problem(format!("`at` has {share}"), hint));
                }
                Ok(Places::Shares(shares))
            }
            (None, Some(lengths), None) => {
                let lengths = lengths.iter().map(|length| self.mm("at_lengths", length));
                Ok(Places::Lengths(lengths.collect::<Result<_, _>>()?))
            }
            (None, None, Some(every)) => Ok(Places::Every(self.above_0("every", &every)?)),
            _ => Err(problem("it has two of `at`, `at_lengths` and `every`", "Keep one of them.")),
        }
    }

    pub(in crate::design_json) fn above_0_or(
        &self,
        field: &str,
        length: Option<LengthFile>,
        default_mm: f64,
    ) -> Result<f64, Problem> {
        length.map_or(Ok(default_mm), |length| self.above_0(field, &length))
    }

    pub(in crate::design_json) fn above_0(
        &self,
        field: &str,
        length: &LengthFile,
    ) -> Result<f64, Problem> {
        let mm = self.mm(field, length)?;
        if mm > 0.0 { Ok(mm) } else { Err(problem(format!("`{field}` is 0"), LENGTH_HINT)) }
    }

    /// A length, mm, 0 or more.
    pub(in crate::design_json) fn mm(
        &self,
        field: &str,
        length: &LengthFile,
    ) -> Result<f64, Problem> {
        let mm = match length {
            LengthFile::Number(number) => in_range_mm(*number, self.units),
            LengthFile::Text(text) => match text.trim().strip_suffix(['t', 'T']) {
                // Feet end in `ft`.
                Some(times) if !times.ends_with(['f', 'F']) => {
                    let Some(thickness) = self.thickness_mm else {
                        let message = format!("`{field}` is in thicknesses, and no sheet is named");
                        return Err(problem(message, "Name a material, or write a length."));
                    };
                    times.trim().parse::<f64>().ok().map(|times| times * thickness)
                }
                _ => read_length(text, self.units).ok(),
            },
        };
        match mm.filter(|mm| mm.is_finite() && *mm >= 0.0) {
            Some(mm) => Ok(mm),
            None => {
                let said = match length {
                    LengthFile::Number(number) => number.to_string(),
                    LengthFile::Text(text) => shown(text),
                };
                Err(problem(format!("`{field}` is {said}"), LENGTH_HINT))
            }
        }
    }
}

fn angle(written: Option<f64>, default_deg: f64, most_deg: f64) -> Result<f64, Problem> {
    let deg = written.unwrap_or(default_deg);
    if deg > 0.0 && deg <= most_deg {
        return Ok(from_deg(deg));
    }
    let hint = format!("Write an angle above 0° and up to {most_deg}°.");
    Err(problem(format!("`angle_deg` is {deg}"), hint))
}

fn on_of(written: &str) -> TrimOn {
    match written {
        "all" => TrimOn::All,
        "free" => TrimOn::Free,
        "joined" => TrimOn::Joined,
        "cuts" => TrimOn::Cuts,
        "holes" => TrimOn::Holes,
        _ => match written.rsplit_once('/') {
            None => TrimOn::Edge { part: None, edge: written.to_owned() },
            Some((part, edge)) => {
                TrimOn::Edge { part: Some(part.to_owned()), edge: edge.to_owned() }
            }
        },
    }
}
