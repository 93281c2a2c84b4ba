//! Trims as they stand in a file: what serde reads and writes, and the JSON Schema.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sheetwright::design::{Corner, NotchForm};

/// What is done along some edges.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[schemars(rename = "Trim")]
pub(in crate::design_json) struct TrimFile {
    /// Where: `PART/EDGE`, the name of an edge, or one of `all`, `free` (joined to none), `joined`,
    /// `cuts` (sides of cuts) and `holes` (around holes); or a list of these.
    pub(super) on: OneOrMore,
    /// From which share of each edge to which. Default: `[0, 1]`, the whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) span: Option<[f64; 2]>,
    #[serde(flatten)]
    pub(super) kind: KindFile,
}

/// One text, or some.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub(in crate::design_json) enum OneOrMore {
    /// One.
    One(String),
    /// Some.
    More(Vec<String>),
}

/// A length: a number in the units of the design, or a text such as `10 mm` or `2 t`, which is two
/// thicknesses of the sheet.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub(in crate::design_json) enum LengthFile {
    /// In the units of the design.
    Number(f64),
    /// With its unit.
    Text(String),
}

impl LengthFile {
    /// A length, mm, with its unit.
    pub(in crate::design_json) fn of_mm(mm: f64) -> Self {
        Self::Text(format!("{mm} mm"))
    }
}

/// One length, or one at each end.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum WidthFile {
    /// Everywhere.
    Even(LengthFile),
    /// At the beginning and at the end.
    Ends([LengthFile; 2]),
}

/// What is done.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub(super) enum KindFile {
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
    /// Tabs of one of two joined edges through slots of the other, in a strip beyond its net line.
    Slots {
        /// The distance from tab to tab, about. Default: three times `width`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pitch: Option<LengthFile>,
        /// The length of a tab along the edge. Default: five times `thickness`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        width: Option<LengthFile>,
        /// How far tabs reach beyond the net line. Default: as `thickness`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        depth: Option<LengthFile>,
        /// The thickness of the sheet with the tabs: slots are as wide. Default: 1 t.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        thickness: Option<LengthFile>,
        /// How much longer and wider slots are than tabs. Default: 0.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        clearance: Option<LengthFile>,
        /// How much material stays beyond the slots. Default: twice `thickness`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        beyond: Option<LengthFile>,
        /// The diameter of the holes in the corners of slots, which a round cutter needs. Default:
        /// 0, none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        dogbone: Option<LengthFile>,
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
pub(super) enum CornerName {
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
pub(super) enum FormName {
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
