//! Materials as they stand in a file.

use crate::json::{Called, Object};
use schemars::JsonSchema;
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use serde::{Deserialize as Derived, Serialize};
use std::fmt;

/// What a sheet of one material and one thickness takes.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialFile {
    /// How reports call it. Default: its name.
    #[serde(default)]
    pub(crate) title: Option<String>,
    /// Thickness, mm: 0.001 to 1000.
    pub(super) thickness_mm: NumberFile,
    /// The smallest radius that it is bent to, mm: 0.001 to 1,000,000. A sheet folds along a scored
    /// line if this is at most 10 times the thickness.
    pub(super) bend_radius_mm: NumberFile,
    /// The largest warp angle along a ruling that it takes, degrees: 0.01 to 90. Default: 6.
    #[serde(default)]
    pub(super) warp_limit_deg: Option<NumberFile>,
    /// By which share lengths within its plane may change: 0.000001 to 1. Of a metal, the yield
    /// stress over Young's modulus. Default: 0.001.
    #[serde(default)]
    pub(super) stretch_limit: Option<NumberFile>,
    /// Young's modulus, N/mm²: 0.001 to 2,000,000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) modulus_n_per_mm2: Option<NumberFile>,
    /// Poisson's number: 0 to 0.499.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) poisson: Option<NumberFile>,
    /// The strain of the outer fibre from which the sheet keeps its bend, a share: 0.000001 to 1.
    /// Leave it out for a sheet that springs back until it breaks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) yield_strain: Option<NumberFile>,
    /// Mass per volume, kg/m³: 1 to 30,000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) density_kg_per_m3: Option<NumberFile>,
    /// Where the neutral fibre of a bend lies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<KFactorsFile>")]
    pub(super) k_factors: Option<Object<KFactorsFile>>,
    /// By how much bends shorten the flat sheet, as measured; it goes before the K-factors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<DeductionsFile>")]
    pub(super) deductions: Option<Object<DeductionsFile>>,
    /// Bending along and across the grain of the face. The direction is that which becomes curved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<GrainFile>")]
    pub(super) grain: Option<Object<GrainFile>>,
}

impl Called for MaterialFile {
    const CALLED: &str = "material";
}

/// K-factors by the ANSI convention.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct KFactorsFile {
    /// Rows of the inner radius over the thickness, 0 to 10,000 and increasing, and the depth of
    /// the neutral fibre below the inner face over the thickness, 0.05 to 0.6.
    #[schemars(length(min = 1, max = 100))]
    pub(super) table: Vec<[f64; 2]>,
    /// As of a number. Default: `assumed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub(super) source: Option<String>,
}

/// Bend deductions: by how much the flat sheet is shorter than both flanges together, each measured
/// from its end to where the outer faces meet.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DeductionsFile {
    /// Rows of the inner radius of the tool, mm, the angle by which the sheet is turned, degrees,
    /// 0.1 to 170, and the deduction, mm; by increasing radius, and then by increasing angle.
    #[schemars(length(min = 1, max = 1000))]
    pub(super) table: Vec<[f64; 3]>,
    /// As of a number. Default: `assumed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub(super) source: Option<String>,
}

/// How a sheet bends along and across the grain of its face.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GrainFile {
    /// The fibres of the face become curved.
    #[schemars(with = "GrainBendingFile")]
    pub(super) along: Object<GrainBendingFile>,
    /// The fibres of the face stay straight.
    #[schemars(with = "GrainBendingFile")]
    pub(super) across: Object<GrainBendingFile>,
}

/// How a sheet bends in one direction.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GrainBendingFile {
    /// Young's modulus in bending, N/mm²: 0.001 to 2,000,000.
    pub(super) modulus_n_per_mm2: NumberFile,
    /// The smallest bend radius, mm: 0.001 to 1,000,000.
    pub(super) bend_radius_mm: NumberFile,
}

/// A number, without a source or with one.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum NumberFile {
    /// A number without a source: it is assumed.
    Bare(f64),
    /// A number and where it comes from.
    Sourced(SourcedFile),
}

/// A number and where it comes from.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SourcedFile {
    /// The number.
    pub(super) value: f64,
    /// A publication, a data sheet or a measurement; begins with `assumed` where there is none.
    #[schemars(length(min = 1))]
    pub(super) source: String,
}

/// The sheet that a design is made from.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(crate) enum MaterialChoice {
    /// The name of one of `materials`, or of one in the catalogue.
    Name(String),
    /// What it takes. Its name is its `title`, or `own`.
    Own(Box<MaterialFile>),
}

impl<'de> Deserialize<'de> for NumberFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Number;
        impl<'de> Visitor<'de> for Number {
            type Value = NumberFile;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a number or an object with `value` and `source`")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<NumberFile, E> {
                Ok(NumberFile::Bare(value))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<NumberFile, E> {
                Ok(NumberFile::Bare(value as f64))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<NumberFile, E> {
                Ok(NumberFile::Bare(value as f64))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<NumberFile, A::Error> {
                SourcedFile::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(NumberFile::Sourced)
            }
        }
        deserializer.deserialize_any(Number)
    }
}

impl<'de> Deserialize<'de> for MaterialChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = MaterialChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "the name of a material or an object")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<MaterialChoice, E> {
                Ok(MaterialChoice::Name(name.to_owned()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialChoice, A::Error> {
                MaterialFile::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(|own| MaterialChoice::Own(Box::new(own)))
            }
        }
        deserializer.deserialize_any(Choice)
    }
}
