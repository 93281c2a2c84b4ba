//! The fields `trims` and `for`: what is done along edges, from a design's file and back.
//!
//! A trade (`for`) is a list of trims with defaults, of which `trades.json` holds one for each. A
//! trim of the design with the `kind` and the `on` of one of these replaces single fields of it;
//! others come after them. Lengths are numbers in the design's units, or texts: `"10 mm"`, or
//! `"2 t"`, two thicknesses of the sheet.

use super::in_our_words;
use super::source::Source;
use crate::names::{did_you_mean, shown};
use crate::quantity::read_length;
use crate::reading::InputError;
use crate::table::in_range_mm;
use crate::units::Units;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use sheetwright::design::{
    Allowance, Corner, Design, Fingers, Flange, Hem, Holes, NotchForm, Notches, Places, Puzzle,
    Tabs, Ticks, Trim, TrimKind, TrimOn,
};
use sheetwright::math::{from_deg, to_deg};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A trim as it stands in a file: a JSON object.
pub(super) type Written = Map<String, Value>;

const LENGTH_HINT: &str = "Write a number in the units of the design, or a text with a unit: \
     \"10 mm\"; \"2 t\" is two thicknesses of the sheet.";
const ON_HINT: &str = "Write PART/EDGE, an edge's name, or one of all, free, joined, cuts, holes; \
     or a list of these.";
/// The most trims of a design.
const MAX_TRIMS: usize = 1000;

/// What is done along some edges.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[schemars(rename = "Trim")]
pub(super) struct TrimFile {
    /// Where: `PART/EDGE`, the name of an edge, or one of `all`, `free` (joined to none), `joined`,
    /// `cuts` (sides of cuts) and `holes` (around holes); or a list of these.
    on: OneOrMore,
    /// From which share of each edge to which. Default: `[0, 1]`, the whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    span: Option<[f64; 2]>,
    #[serde(flatten)]
    kind: KindFile,
}

/// One text, or some.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
enum OneOrMore {
    /// One.
    One(String),
    /// Some.
    More(Vec<String>),
}

/// A length: a number in the units of the design, or a text such as `10 mm` or `2 t`, which is two
/// thicknesses of the sheet.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
enum LengthFile {
    /// In the units of the design.
    Number(f64),
    /// With its unit.
    Text(String),
}

/// One length, or one at each end.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
enum WidthFile {
    /// Everywhere.
    Even(LengthFile),
    /// At the beginning and at the end.
    Ends([LengthFile; 2]),
}

/// What is done.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
enum KindFile {
    /// Material beyond the net line, to sew or glue.
    Allowance {
        /// Its width; two of them change evenly from end to end.
        width: WidthFile,
        /// How it ends at corners. Default: by-length.
        #[serde(default)]
        corners: CornerName,
    },
    /// Material that is folded back over the net line.
    Hem {
        /// The width that is folded back.
        width: LengthFile,
        /// The width that is turned in under the hem. Default: 0, a single fold.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        turn: Option<LengthFile>,
    },
    /// Material that is bent up at the net line.
    Flange {
        /// Its width on the flat.
        width: LengthFile,
        /// By how much it is bent, degrees. Default: 90.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        angle_deg: Option<f64>,
        /// How far it keeps from a corner where the next edge has a flange, too. Default: 2 t, at
        /// least 1 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        relief: Option<LengthFile>,
    },
    /// Tabs on one of two joined edges, to glue under the other.
    Tabs {
        /// Their width, where there is room for it. Default: 5 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        width: Option<LengthFile>,
        /// The angle of their ends at the net line, at the most, degrees. Default: 45.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        angle_deg: Option<f64>,
        /// How far the edge may leave a straight line along one tab. Default: 0.3 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        tolerance: Option<LengthFile>,
    },
    /// Holes inside the net line, for stitches, ties or rivets.
    Holes {
        /// The distance from hole to hole, about.
        pitch: LengthFile,
        /// That near the ends. Default: `pitch`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        end_pitch: Option<LengthFile>,
        /// How far from the ends it is that. Default: 0.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        end_length: Option<LengthFile>,
        /// How far the first and the last hole are from the ends. Default: half of `end_pitch`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ends: Option<LengthFile>,
        /// How far their centres are from the net line. Default: three diameters.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        inset: Option<LengthFile>,
        /// Their diameter.
        diameter: LengthFile,
    },
    /// Notches in the cut line, to match edges by.
    Notches {
        /// Where, as shares of the edge. Default: in its middle.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at: Option<Vec<f64>>,
        /// Where, as lengths from its beginning; not beside `at`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at_lengths: Option<Vec<LengthFile>>,
        /// At every such length from its middle; not beside `at`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        every: Option<LengthFile>,
        /// Their form. Default: slit.
        #[serde(default)]
        form: FormName,
        /// How deep they are. Default: 4 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        depth: Option<LengthFile>,
        /// How wide they are. Default: as they are deep.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        width: Option<LengthFile>,
        /// How many stand side by side, 1 to 3. Default: 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        count: Option<usize>,
        /// The distance between those. Default: twice `width`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        gap: Option<LengthFile>,
    },
    /// Ticks inside the net line, to match edges by.
    Ticks {
        /// As for notches.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at: Option<Vec<f64>>,
        /// As for notches.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at_lengths: Option<Vec<LengthFile>>,
        /// As for notches.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        every: Option<LengthFile>,
        /// How long they are. Default: 4 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        length: Option<LengthFile>,
        /// Whether they have numbers. Default: false.
        #[serde(default)]
        numbered: bool,
    },
    /// Fingers of one of two joined edges in gaps of the other.
    Fingers {
        /// The width of a finger, about. Default: three times `depth`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        width: Option<LengthFile>,
        /// How far fingers reach beyond the net line. Default: 1 t.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        depth: Option<LengthFile>,
        /// How much wider gaps are than fingers. Default: 0.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        clearance: Option<LengthFile>,
    },
    /// Knobs of one of two joined edges in sockets of the other.
    Puzzle {
        /// The distance from knob to knob, about. Default: twice `width`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pitch: Option<LengthFile>,
        /// The width of a knob. Default: 50 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        width: Option<LengthFile>,
        /// How much wider sockets are than knobs. Default: 0.6 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        clearance: Option<LengthFile>,
    },
}

/// How material ends at corners, in the words of pattern makers' programs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum CornerName {
    /// Both cut lines run on to where they meet, and are cut off squarely where that is far.
    #[default]
    ByLength,
    /// Each cut line runs on to the other net line.
    ByIntersection,
    /// The first edge's lies on the second's when it is folded over the first.
    FirstEdgeSymmetry,
    /// The second edge's lies on the first's when it is folded over the second.
    SecondEdgeSymmetry,
    /// The first edge's ends at a right angle.
    FirstEdgeRightAngle,
    /// The second edge's ends at a right angle.
    SecondEdgeRightAngle,
}

/// The form of a notch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum FormName {
    /// A cut straight inwards.
    #[default]
    Slit,
    /// A cut with a crossbar at its end.
    T,
    /// A triangle that is cut out.
    V,
    /// A triangle that stands out.
    VOut,
    /// A slot that is cut out, with a round bottom.
    U,
    /// A rectangle that stands out.
    Castle,
}

/// The names of both sides.
macro_rules! alike {
    ($file:ident, $kernel:ident { $($name:ident),* }) => {
        impl From<$file> for $kernel {
            fn from(name: $file) -> Self {
                match name { $($file::$name => Self::$name),* }
            }
        }
        impl From<$kernel> for $file {
            fn from(kind: $kernel) -> Self {
                match kind { $($kernel::$name => Self::$name),* }
            }
        }
    };
}
alike!(
    CornerName,
    Corner {
        ByLength,
        ByIntersection,
        FirstEdgeSymmetry,
        SecondEdgeSymmetry,
        FirstEdgeRightAngle,
        SecondEdgeRightAngle
    }
);
alike!(FormName, NotchForm { Slit, T, V, VOut, U, Castle });

/// A trade: what people of one kind do along the edges of their patterns.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Trade {
    /// What it is for, in a line.
    title: String,
    /// The thickness that its trims reckon with where no material is named, mm.
    thickness_mm: f64,
    /// Its trims.
    trims: Vec<Written>,
}

/// The trades, by name.
///
/// # Panics
/// Where the list of the program itself can't be read, which its tests show.
fn trades() -> &'static BTreeMap<String, Trade> {
    static TRADES: OnceLock<BTreeMap<String, Trade>> = OnceLock::new();
    TRADES.get_or_init(|| match serde_json::from_str(include_str!("../trades.json")) {
        Ok(trades) => trades,
        Err(error) => panic!("trades.json: {error}"),
    })
}

/// The names of the trades, in order.
pub fn trade_names() -> Vec<&'static str> {
    trades().keys().map(String::as_str).collect()
}

/// What a trade is for, in a line; `None` if there is none of this name.
pub fn trade_title(name: &str) -> Option<&'static str> {
    trades().get(name).map(|trade| trade.title.as_str())
}

/// The trims of a design when it is made for another trade, or of another material: those of the
/// trade that it had give way to those of the new one, its own stay. `thickness_mm` is that of its
/// sheet before and now. `None` if there is no such trade.
pub fn trims_for(
    design: &Design,
    trade: Option<&str>,
    thickness_mm: [Option<f64>; 2],
) -> Option<Vec<Trim>> {
    let of = |trade: Option<&str>, thickness_mm| {
        trims_of(trade, Vec::new(), Units::Millimetres, thickness_mm).ok()
    };
    let before = of(design.trade.as_deref(), thickness_mm[0])?;
    let own = design.trims.strip_prefix(&before[..]).unwrap_or(&design.trims);
    let mut trims = of(trade, thickness_mm[1])?;
    trims.extend_from_slice(own);
    Some(trims)
}

/// Why a list of trims can't be read: where in it, the problem, and what to do.
pub(crate) type Refused = (String, String, String);

/// The trims of a design with its trade: those that it has of its own replace fields of the
/// trade's. `thickness_mm` is that of its sheet.
pub(crate) fn trims_of(
    trade: Option<&str>,
    own: Vec<Written>,
    units: Units,
    thickness_mm: Option<f64>,
) -> Result<Vec<Trim>, Refused> {
    let known = trades();
    let trade = match trade {
        None => None,
        Some(name) => Some(known.get(name).ok_or_else(|| {
            let names: Vec<&str> = known.keys().map(String::as_str).collect();
            let hint = did_you_mean(name, &names);
            ("for".to_owned(), format!("there is no trade {}", shown(name)), hint)
        })?),
    };
    if own.len() > MAX_TRIMS {
        let hint = format!("The limit is {MAX_TRIMS} trims.");
        return Err(("trims".to_owned(), format!("the design has {} trims", own.len()), hint));
    }
    let thickness_mm = thickness_mm.or(trade.map(|trade| trade.thickness_mm));
    let mut list: Vec<(String, Written, Units)> = Vec::new();
    for (n, written) in trade.into_iter().flat_map(|trade| &trade.trims).enumerate() {
        list.push((format!("for.trims[{n}]"), written.clone(), Units::Millimetres));
    }
    let of_trade = list.len();
    for (n, written) in own.into_iter().enumerate() {
        let path = format!("trims[{n}]");
        let names = |written: &Written| [written.get("kind").cloned(), written.get("on").cloned()];
        let replaced =
            list[..of_trade].iter_mut().find(|(_, other, _)| names(other) == names(&written));
        match replaced {
            None => list.push((path, written, units)),
            Some((place, other, _)) => {
                // The trade's own numbers are mm; those of the design are in its units.
                let in_mm = |value: Value| match value.as_f64() {
                    Some(number) => Value::from(number * units.in_mm()),
                    None => value,
                };
                *place = path;
                let is_length = |field: &str| !PLAIN.contains(&field);
                other.extend(written.into_iter().map(|(field, value)| {
                    let value = if is_length(&field) { in_mm(value) } else { value };
                    (field, value)
                }));
            }
        }
    }
    let read = |(path, written, units): (String, Written, Units)| {
        let reader = Reader { units, thickness_mm };
        reader.trim(written).map_err(|(message, hint)| (path, message, hint))
    };
    list.into_iter().map(read).collect()
}

/// The fields that are numbers without a unit.
const PLAIN: [&str; 4] = ["angle_deg", "count", "numbered", "span"];

struct Reader {
    units: Units,
    thickness_mm: Option<f64>,
}

type Problem = (String, String);

fn problem(message: impl Into<String>, hint: impl Into<String>) -> Problem {
    (message.into(), hint.into())
}

impl Reader {
    fn trim(&self, mut written: Written) -> Result<Trim, Problem> {
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
                let depth = match (depth, self.thickness_mm) {
                    (Some(depth), _) => self.above_0("depth", &depth)?,
                    (None, Some(thickness)) => thickness,
                    (None, None) => {
                        let hint = "Name a material, or write the `depth` of the fingers.";
                        return Err(problem("the thickness of the sheet is not known", hint));
                    }
                };
                TrimKind::Fingers(Fingers {
                    width: self.above_0_or("width", width, 3.0 * depth)?,
                    depth,
                    clearance: clearance.map_or(Ok(0.0), |l| self.mm("clearance", &l))?,
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

    fn above_0_or(
        &self,
        field: &str,
        length: Option<LengthFile>,
        default_mm: f64,
    ) -> Result<f64, Problem> {
        length.map_or(Ok(default_mm), |length| self.above_0(field, &length))
    }

    fn above_0(&self, field: &str, length: &LengthFile) -> Result<f64, Problem> {
        let mm = self.mm(field, length)?;
        if mm > 0.0 { Ok(mm) } else { Err(problem(format!("`{field}` is 0"), LENGTH_HINT)) }
    }

    /// A length, mm, 0 or more.
    fn mm(&self, field: &str, length: &LengthFile) -> Result<f64, Problem> {
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

/// An edge as files name it.
fn on_name(on: &TrimOn) -> String {
    match on {
        TrimOn::All => "all".to_owned(),
        TrimOn::Free => "free".to_owned(),
        TrimOn::Joined => "joined".to_owned(),
        TrimOn::Cuts => "cuts".to_owned(),
        TrimOn::Holes => "holes".to_owned(),
        TrimOn::Edge { part: None, edge } => edge.clone(),
        TrimOn::Edge { part: Some(part), edge } => format!("{part}/{edge}"),
    }
}

/// Reads the fields `for` and `trims` of a design.
pub(super) fn read(
    trade: Option<&str>,
    own: Vec<Written>,
    units: Units,
    thickness_mm: Option<f64>,
    source: &Source<'_>,
) -> Result<Vec<Trim>, InputError> {
    trims_of(trade, own, units, thickness_mm)
        .map_err(|(path, message, hint)| source.error(&path, message, hint))
}

/// The trims of a design as its file has them: without those of its trade, if it has them as
/// they are.
pub(super) fn written(
    trade: Option<&str>,
    trims: &[Trim],
    thickness_mm: Option<f64>,
) -> (Option<String>, Vec<TrimFile>) {
    let of_trade =
        trims_of(trade, Vec::new(), Units::Millimetres, thickness_mm).unwrap_or_default();
    let has_all = trims.starts_with(&of_trade);
    let rest = if has_all { &trims[of_trade.len()..] } else { trims };
    let trade = trade.filter(|_| has_all).map(str::to_owned);
    (trade, rest.iter().map(file_of).collect())
}

fn file_of(trim: &Trim) -> TrimFile {
    let names: Vec<String> = trim.on.iter().map(on_name).collect();
    let on = match &names[..] {
        [one] => OneOrMore::One(one.clone()),
        _ => OneOrMore::More(names),
    };
    let span = (trim.span != [0.0, 1.0]).then_some(trim.span);
    TrimFile { on, span, kind: kind_file(&trim.kind) }
}

fn kind_file(kind: &TrimKind) -> KindFile {
    // With its unit, so that it does not depend on that of the file.
    let mm = |mm: f64| LengthFile::Text(format!("{mm} mm"));
    let some = |length: f64| Some(mm(length));
    let places = |places: &Places| match places {
        Places::Shares(shares) => (Some(shares.clone()), None, None),
        Places::Lengths(lengths) => (None, Some(lengths.iter().copied().map(mm).collect()), None),
        Places::Every(every) => (None, None, some(*every)),
    };
    match kind {
        TrimKind::Allowance(Allowance { width: [from, to], corner }) => KindFile::Allowance {
            width: match from == to {
                true => WidthFile::Even(mm(*from)),
                false => WidthFile::Ends([mm(*from), mm(*to)]),
            },
            corners: (*corner).into(),
        },
        TrimKind::Hem(hem) => KindFile::Hem { width: mm(hem.width), turn: some(hem.turn) },
        TrimKind::Flange(flange) => KindFile::Flange {
            width: mm(flange.width),
            angle_deg: Some(to_deg(flange.angle)),
            relief: some(flange.relief),
        },
        TrimKind::Tabs(tabs) => KindFile::Tabs {
            width: some(tabs.width),
            angle_deg: Some(to_deg(tabs.angle)),
            tolerance: some(tabs.tolerance),
        },
        TrimKind::Holes(holes) => KindFile::Holes {
            pitch: mm(holes.pitch),
            end_pitch: some(holes.end_pitch),
            end_length: some(holes.end_length),
            ends: some(holes.ends),
            inset: some(holes.inset),
            diameter: mm(holes.diameter),
        },
        TrimKind::Notches(notches) => {
            let (at, at_lengths, every) = places(&notches.at);
            KindFile::Notches {
                at,
                at_lengths,
                every,
                form: notches.form.into(),
                depth: some(notches.depth),
                width: some(notches.width),
                count: Some(notches.count),
                gap: some(notches.gap),
            }
        }
        TrimKind::Ticks(ticks) => {
            let (at, at_lengths, every) = places(&ticks.at);
            let (length, numbered) = (some(ticks.length), ticks.numbered);
            KindFile::Ticks { at, at_lengths, every, length, numbered }
        }
        TrimKind::Fingers(fingers) => KindFile::Fingers {
            width: some(fingers.width),
            depth: some(fingers.depth),
            clearance: some(fingers.clearance),
        },
        TrimKind::Puzzle(puzzle) => KindFile::Puzzle {
            pitch: some(puzzle.pitch),
            width: some(puzzle.width),
            clearance: some(puzzle.clearance),
        },
    }
}
