//! How parts that are larger than the sheet are divided: the data alone. `divide` does it.

/// What joins the pieces of a divided part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DivideJoint {
    /// Both pieces are planed to a taper and glued over one another.
    Scarf,
    /// Both pieces meet, with a strap behind them.
    Butt,
    /// Knobs of each piece in sockets of the other.
    Puzzle,
    /// Both pieces lie over one another.
    Overlap,
}

impl DivideJoint {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Scarf, Self::Butt, Self::Puzzle, Self::Overlap];

    /// Its name in designs.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scarf => "scarf",
            Self::Butt => "butt",
            Self::Puzzle => "puzzle",
            Self::Overlap => "overlap",
        }
    }
}

/// How parts that are larger than every sheet are divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Divide {
    /// What joins the pieces.
    pub joint: DivideJoint,
    /// How long the taper of a scarf is, in thicknesses of the sheet. Default: 8.
    pub ratio: f64,
    /// How far pieces lie over one another, mm. Default: 30.
    pub overlap_mm: f64,
}

impl Divide {
    /// With the usual sizes of this joint.
    pub const fn by(joint: DivideJoint) -> Self {
        Self { joint, ratio: 8.0, overlap_mm: 30.0 }
    }
}
