//! Why a mark can't be made, and what is to be said about one.

use crate::design::Axis;
use sheetwright_geometry::math::{Point2, Point3};
use std::fmt;

/// Why a mark can't be made.
#[derive(Clone, Debug, PartialEq)]
pub enum MarkFault {
    /// No part has this name.
    NoSuchPart {
        /// As it was asked for.
        wanted: String,
        /// The parts that there are, up to a dozen.
        known: Vec<String>,
    },
    /// No part that the mark is on has this edge.
    NoSuchEdge {
        /// As it was asked for.
        wanted: String,
        /// The edges that there are, as `PART/EDGE`, up to a dozen.
        known: Vec<String>,
    },
    /// More stations than anyone reads.
    TooManyStations {
        /// How many they would be.
        count: usize,
        /// The limit.
        most: usize,
    },
}

impl fmt::Display for MarkFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchPart { wanted, known } => {
                write!(f, "marks: no part is called '{wanted}'; there are {}", known.join(", "))
            }
            Self::NoSuchEdge { wanted, known } => {
                write!(f, "marks: no edge is called '{wanted}'; there are {}", known.join(", "))
            }
            Self::TooManyStations { count, most } => {
                write!(f, "marks: {count} stations cross the part; the limit is {most}")
            }
        }
    }
}

/// What is to be said about a mark that was not made as it was asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum MarkNote {
    /// A station crosses none of its parts.
    StationMissed {
        /// Its name.
        name: String,
        /// The axis.
        axis: Axis,
        /// Its coordinate, mm.
        at_mm: f64,
        /// From where to where its parts reach, mm.
        reach_mm: [f64; 2],
    },
    /// A place in space lies off every part of the mark.
    PlaceFar {
        /// The kind of the mark.
        what: String,
        /// The place, mm.
        at: Point3,
        /// Its distance from the nearest part, mm.
        off_mm: f64,
        /// The limit, mm.
        within_mm: f64,
    },
    /// A mark would reach over the edge of the part.
    OverTheEdge {
        /// The kind of the mark.
        what: String,
        /// Its place on the flat pattern, mm.
        at: Point2,
        /// How far from the edge it must be, mm.
        radius_mm: f64,
    },
    /// A direction in space is square to the part.
    SquareToPart {
        /// The kind of the mark.
        what: String,
    },
    /// A straight frame at a station misses the part, which is curved there. Of a part, the station
    /// where it does most is named.
    CurvedFrame {
        /// The station.
        name: String,
        /// How far the part leaves the straight line between its edges there, mm.
        off_mm: f64,
        /// The length of that line, mm.
        length_mm: f64,
    },
    /// An edge on the fold is not straight.
    CurvedFold {
        /// The edge, as `PART/EDGE`.
        edge: String,
        /// How far it leaves the straight line between its ends, mm.
        off_mm: f64,
    },
}
