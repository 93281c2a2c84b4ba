//! Marks as they stand in a file: what serde reads and writes, and the JSON Schema.

use crate::design_json::trims::{LengthFile, OneOrMore};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sheetwright::design::Axis;

/// A mark on the faces of some parts.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[schemars(rename = "Mark")]
pub(in crate::design_json) struct MarkFile {
    /// The part or panel, or `all`; or a list of parts. Default: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) on: Option<OneOrMore>,
    #[serde(flatten)]
    pub(super) kind: KindFile,
}

/// A station: its place, or its place and its name.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum StationFile {
    /// Its coordinate along the axis.
    Place(f64),
    /// With a name.
    Named(NamedStation),
}

/// A station with its name.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct NamedStation {
    /// Its coordinate along the axis.
    pub(super) at: f64,
    /// Its name.
    pub(super) name: String,
}

/// A place: three numbers in space, or two on the flat pattern.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum PlaceFile {
    /// In space: the nearest point of the part is taken.
    Space([f64; 3]),
    /// On the flat pattern.
    Flat([f64; 2]),
}

/// An axis of space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum AxisName {
    /// The first.
    #[default]
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

/// What is marked.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub(super) enum KindFile {
    /// Where planes square to an axis cut the part: the frames of a boat.
    Stations {
        /// The axis. Default: x.
        #[serde(default)]
        axis: AxisName,
        /// Where the planes lie along it, in the units of the design.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at: Option<Vec<StationFile>>,
        /// Their distance; not beside `at`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pitch: Option<f64>,
        /// The place that they are counted from. Default: 0.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        from: Option<f64>,
    },
    /// An arrow along the grain.
    Grain {
        /// Its direction in space, laid on the part.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        toward: Option<[f64; 3]>,
        /// The edge that it runs along; not beside `toward`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        edge: Option<String>,
        /// Its angle to the horizontal on the pattern, degrees, counter-clockwise; beside neither.
        /// Default: 0.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        angle_deg: Option<f64>,
        /// Its length, where there is room for it. Default: 100 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        length: Option<LengthFile>,
    },
    /// An edge that lies on the fold of the cloth: the piece is cut double.
    Fold {
        /// The name of the edge.
        edge: String,
    },
    /// Which face of the sheet is seen, and which way it lies in space.
    Face {
        /// Its text. Default: face up.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        text: Option<String>,
        /// The direction in space that its arrow points in. Default: `[0, 0, 1]`, upwards.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        toward: Option<[f64; 3]>,
        /// The length of the arrow, where there is room for it. Default: 50 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        length: Option<LengthFile>,
    },
    /// A hole.
    Drill {
        /// Its middle.
        at: PlaceFile,
        /// How far a place in space may be off the part. Default: 1 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        within: Option<LengthFile>,
        /// Its diameter.
        diameter: LengthFile,
    },
    /// A text.
    Text {
        /// What it says.
        text: String,
        /// Its middle. Default: where there is most room.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at: Option<PlaceFile>,
        /// How far a place in space may be off the part. Default: 1 mm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        within: Option<LengthFile>,
        /// How high its letters are, where there is room for them. Default: as edge names.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        height: Option<LengthFile>,
    },
}

impl From<AxisName> for Axis {
    fn from(name: AxisName) -> Self {
        match name {
            AxisName::X => Self::X,
            AxisName::Y => Self::Y,
            AxisName::Z => Self::Z,
        }
    }
}

impl From<Axis> for AxisName {
    fn from(axis: Axis) -> Self {
        match axis {
            Axis::X => Self::X,
            Axis::Y => Self::Y,
            Axis::Z => Self::Z,
        }
    }
}
