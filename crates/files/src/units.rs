//! Units of length in files. Inside, and in every report, lengths are millimetres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A unit of length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Units {
    /// Millimetres.
    #[default]
    #[serde(rename = "mm")]
    Millimetres,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetres,
    /// Metres.
    #[serde(rename = "m")]
    Metres,
    /// Inches of exactly 25.4 mm.
    #[serde(rename = "in")]
    Inches,
    /// Feet of exactly 304.8 mm.
    #[serde(rename = "ft")]
    Feet,
}

impl Units {
    /// Every unit.
    pub const ALL: [Self; 5] =
        [Self::Millimetres, Self::Centimetres, Self::Metres, Self::Inches, Self::Feet];

    /// How files name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Millimetres => "mm",
            Self::Centimetres => "cm",
            Self::Metres => "m",
            Self::Inches => "in",
            Self::Feet => "ft",
        }
    }

    /// The unit of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// One of it, mm.
    pub fn in_mm(self) -> f64 {
        match self {
            Self::Millimetres => 1.0,
            Self::Centimetres => 10.0,
            Self::Metres => 1000.0,
            Self::Inches => 25.4,
            Self::Feet => 304.8,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_files() {
        for unit in Units::ALL {
            assert_eq!(Units::from_name(unit.name()), Some(unit));
            assert_eq!(serde_json::to_value(unit).unwrap(), unit.name());
        }
        assert_eq!(Units::from_name("mile"), None);
        assert_eq!(Units::Feet.in_mm(), 304.8);
    }
}
