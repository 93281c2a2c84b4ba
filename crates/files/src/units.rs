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

    /// The unit that a mesh is meant in whose file names none, by its largest extent as a number:
    /// metres from 0.01 up to 5, else millimetres. What is shorter than 5 mm is no sheet, and what
    /// is shorter than 10 mm in metres is none either.
    pub fn meant(extent: f64) -> Self {
        if (0.01..5.0).contains(&extent) { Self::Metres } else { Self::Millimetres }
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

    /// A length in mm as a number of it, which reads back to the length itself where there is such
    /// a number.
    pub(crate) fn number(self, mm: f64) -> f64 {
        let near = mm / self.in_mm();
        let [up, down] = [near.next_up(), near.next_down()];
        let mut numbers = [near, up, down, up.next_up(), down.next_down()].into_iter();
        numbers.find(|number| number * self.in_mm() == mm).unwrap_or(near)
    }

    /// The step of a grid that is round in this unit and nearest to a length by its ratio, mm: 1, 2
    /// or 5 times a power of ten; inches and what is less than a foot in 1/64, 1/32 … 1/2, 1, 2, 3
    /// and 6 in. The length itself where it is none.
    pub fn round_step_mm(self, mm: f64) -> f64 {
        if !(mm.is_finite() && mm > 0.0) {
            return mm;
        }
        let inch = Self::Inches.in_mm();
        let small = [64.0, 32.0, 16.0, 8.0, 4.0, 2.0].map(|part| inch / part);
        let inches = [1.0, 2.0, 3.0, 6.0].map(|count| inch * count);
        let (unit, below): (f64, Vec<f64>) = match self {
            Self::Inches => (inch, small.to_vec()),
            Self::Feet => (self.in_mm(), [&small[..], &inches[..]].concat()),
            _ => (0.01, Vec::new()),
        };
        let tens = (0..12).scan(unit, |ten, _| {
            let now = *ten;
            *ten *= 10.0;
            Some(now)
        });
        let round = tens.flat_map(|ten| [1.0, 2.0, 5.0].map(|digit| digit * ten));
        let off = |step: &f64| (step / mm).max(mm / step);
        let steps = below.into_iter().chain(round);
        steps.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_a_grid_are_round_in_their_unit() {
        for (units, mm, step) in [
            (Units::Millimetres, 50.8, 50.0),
            (Units::Metres, 120.0, 100.0),
            (Units::Inches, 50.0, 50.8),
            (Units::Inches, 3.0, 3.175),
            (Units::Inches, 120.0, 127.0),
            (Units::Feet, 50.0, 50.8),
            (Units::Feet, 290.0, 304.8),
            (Units::Feet, 500.0, 609.6),
        ] {
            let found = units.round_step_mm(mm);
            assert!((found - step).abs() < 1e-9, "{units:?} {mm}: {found}");
            assert_eq!(units.round_step_mm(found), found);
        }
    }

    #[test]
    fn what_would_be_too_small_for_a_sheet_is_meant_in_metres() {
        for (extent, units) in [
            (0.0, Units::Millimetres),
            (0.003, Units::Millimetres),
            (0.3, Units::Metres),
            (2.0, Units::Metres),
            (5.0, Units::Millimetres),
            (300.0, Units::Millimetres),
            (f64::NAN, Units::Millimetres),
        ] {
            assert_eq!(Units::meant(extent), units, "{extent}");
        }
    }

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
