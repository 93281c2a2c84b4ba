//! The ranges of numbers, which are those of the options of the command: what is outside of them is
//! refused before anything is computed with it.

use crate::failure::Failure;
use sheetwright::design::{LEAST_EFFORT, MOST_EFFORT};

/// The longest length, mm: that of a coordinate in a file.
pub(crate) const MOST_MM: f64 = 1e9;

/// The range of a number.
pub(crate) struct Range {
    /// Whether a number is within it; NaN is within none.
    holds: fn(f64) -> bool,
    /// What to give.
    hint: &'static str,
}

/// A length of 0 or more, mm.
pub(crate) const DISTANCE: Range =
    Range { holds: |mm| (0.0..=MOST_MM).contains(&mm), hint: "Give a length of 0 or more, in mm." };
/// A length above 0, mm.
pub(crate) const SIZE: Range =
    Range { holds: |mm| mm > 0.0 && mm <= MOST_MM, hint: "Give a length above 0, in mm." };
/// A thickness, mm.
pub(crate) const THICKNESS: Range = Range {
    holds: |mm| mm > 0.0 && mm <= 1000.0,
    hint: "Give a thickness above 0 and up to 1000 mm.",
};
/// The radius of a tool, mm.
pub(crate) const RADIUS: Range =
    Range { holds: |mm| (0.0..=1000.0).contains(&mm), hint: "Give a radius of 0 to 1000 mm." };
/// The distance of stations, mm.
pub(crate) const PITCH: Range = Range {
    holds: |mm| (0.01..=MOST_MM).contains(&mm),
    hint: "Give a length of at least 0.01 mm.",
};
/// How far arcs lie from the pattern, mm.
pub(crate) const ARCS: Range =
    Range { holds: |mm| (0.0001..=10.0).contains(&mm), hint: "Give a length of 0.0001 to 10 mm." };
/// The angle of a crease, degrees.
pub(crate) const CREASE: Range = Range {
    holds: |deg| (1.0..180.0).contains(&deg),
    hint: "Give an angle from 1 to below 180 degrees.",
};
/// A goal for the warp angle, degrees.
pub(crate) const WARP: Range = Range {
    holds: |deg| deg > 0.0 && deg <= 90.0,
    hint: "Give an angle above 0 and up to 90 degrees.",
};
/// A goal for the strain, as a share of what the sheet takes.
pub(crate) const SHARE: Range = Range {
    holds: |share| (0.05..=1.0).contains(&share),
    hint: "Give a share of what the sheet takes, 0.05 to 1.",
};
/// A multiple of the work that a search may do.
pub(crate) const EFFORT: Range = Range {
    holds: |effort| (LEAST_EFFORT..=MOST_EFFORT).contains(&effort),
    hint: "Give a multiple of the default, 0.001 to 1000.",
};
/// An angle, degrees.
pub(crate) const ANGLE: Range =
    Range { holds: |deg| deg.abs() <= 360.0, hint: "Give angles from -360 to 360 degrees." };
/// A coordinate, mm.
pub(crate) const COORDINATE: Range =
    Range { holds: |mm| mm.abs() <= MOST_MM, hint: "Give finite numbers up to 1e9 mm." };

impl Range {
    /// A number that is within the range.
    pub(crate) fn checked(&self, name: &str, number: f64) -> Result<f64, Failure> {
        let is_within = (self.holds)(number);
        let refused = || Failure::new(format!("{name}: {number} is out of range"), self.hint);
        is_within.then_some(number).ok_or_else(refused)
    }
}

/// A whole number, 0 or more.
pub(crate) fn whole(name: &str, given: i64) -> Result<usize, Failure> {
    usize::try_from(given).map_err(|_| {
        Failure::new(format!("{name}: {given} is out of range"), "Give a whole number, 0 or more.")
    })
}
