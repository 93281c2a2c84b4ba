//! Why a trim can't be made, in words.

use std::fmt;

/// Why a trim can't be made on a part.
#[derive(Clone, Debug, PartialEq)]
pub enum TrimFault {
    /// No part has such an edge.
    NoSuchEdge {
        /// As it was asked for, `PART/EDGE` or `EDGE`.
        wanted: String,
        /// The edges that there are, as `PART/EDGE`, up to a dozen.
        known: Vec<String>,
    },
    /// A trim that joins two edges stands on one that is joined to none.
    NoMate {
        /// What is done.
        what: &'static str,
        /// The edge.
        edge: String,
    },
    /// A strip is wider than the part.
    TooWide {
        /// What is done.
        what: &'static str,
        /// The edge.
        edge: String,
        /// Its width, mm.
        width_mm: f64,
        /// The shorter side of the part, mm.
        part_mm: f64,
    },
    /// Holes overlap.
    TooDense {
        /// The edge.
        edge: String,
        /// The distance from hole to hole, mm.
        pitch_mm: f64,
        /// Their diameter, mm.
        diameter_mm: f64,
    },
    /// Holes reach over the net line.
    OverTheLine {
        /// The edge.
        edge: String,
        /// How far their centres are from the net line, mm.
        inset_mm: f64,
        /// Their radius, mm.
        radius_mm: f64,
    },
    /// A notch reaches over the net line.
    TooDeep {
        /// The edge.
        edge: String,
        /// Its depth, mm.
        depth_mm: f64,
        /// The width of the material beyond the net line there, mm.
        margin_mm: f64,
    },
    /// Slots run into one another.
    SlotsMeet {
        /// The edge.
        edge: String,
        /// How long a slot is with the holes in its corners, mm.
        slot_mm: f64,
        /// The distance from slot to slot, mm.
        pitch_mm: f64,
    },
    /// The holes in the corners of slots are wider than these.
    DogboneWide {
        /// The edge.
        edge: String,
        /// Their diameter, mm.
        dogbone_mm: f64,
        /// How wide a slot is, mm.
        slot_mm: f64,
    },
    /// A part is too large for exact cuts.
    TooLarge {
        /// The largest coordinate of a part that is trimmed, mm.
        most_mm: f64,
    },
    /// The cut lines part a piece.
    Parted {
        /// Into how many.
        pieces: usize,
    },
}

impl fmt::Display for TrimFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchEdge { wanted, known } => {
                let known = known.join(", ");
                write!(f, "no edge is called '{wanted}'; there are {known}")
            }
            Self::NoMate { what, edge } => {
                write!(f, "edge '{edge}' is joined to no other, so it can't have {what}")
            }
            Self::TooWide { what, edge, width_mm, part_mm } => write!(
                f,
                "edge '{edge}': {what} of {width_mm:.1} mm is wider than the part, which measures \
                 {part_mm:.1} mm"
            ),
            Self::TooDense { edge, pitch_mm, diameter_mm } => write!(
                f,
                "edge '{edge}': holes of {diameter_mm:.2} mm overlap at {pitch_mm:.2} mm from one \
                 to the next"
            ),
            Self::OverTheLine { edge, inset_mm, radius_mm } => write!(
                f,
                "edge '{edge}': holes {inset_mm:.2} mm inside reach over the edge, with a radius \
                 of {radius_mm:.2} mm"
            ),
            Self::TooDeep { edge, depth_mm, margin_mm } => write!(
                f,
                "edge '{edge}': a notch {depth_mm:.2} mm deep reaches into the part, which has \
                 {margin_mm:.2} mm of allowance there"
            ),
            Self::SlotsMeet { edge, slot_mm, pitch_mm } => write!(
                f,
                "edge '{edge}': slots of {slot_mm:.2} mm run into one another at {pitch_mm:.2} mm \
                 from one to the next"
            ),
            Self::DogboneWide { edge, dogbone_mm, slot_mm } => write!(
                f,
                "edge '{edge}': holes of {dogbone_mm:.2} mm in the corners are wider than the \
                 slots, which have {slot_mm:.2} mm"
            ),
            Self::TooLarge { most_mm } => write!(
                f,
                "the part is larger than {:.0} km, too large for anything along its edges",
                1e-6 * most_mm
            ),
            Self::Parted { pieces } => {
                write!(f, "its cut lines fall apart into {pieces} pieces")
            }
        }
    }
}
