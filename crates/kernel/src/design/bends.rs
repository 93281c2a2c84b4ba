//! How the bends of a panel are marked on its pattern.

/// What decides how many bend lines a bend is divided into. Names are those of lofted flanges in
/// CAD.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum BendRule {
    /// As many as a hand makes: steps of [`AUTO_STEP_DEG`], and [`AUTO_LINES`] lines a part at the
    /// most.
    #[default]
    Auto,
    /// Steps of equal angles, each of this at the most, radians.
    Angle(f64),
    /// So many lines a part, in steps of equal angles; a bend that turns the other way, and one
    /// behind a fold, gets a line of its own in any case.
    Number(usize),
    /// The smooth surface is no farther than this from the flat steps, mm.
    Chord(f64),
    /// Steps of equal widths, each of this at the most at its wider end, mm.
    Pitch(f64),
}

/// Steps of automatic bend lines, degrees: as [`crate::measure::SHARP_CREASE_DEG`], a bend of 90°
/// in 18, the coarsest that workshops make without a straight line being seen.
pub const AUTO_STEP_DEG: f64 = 5.0;
/// The most bend lines of a part that are made unasked: as many as the classical triangulation of
/// ducts divides a round into.
pub const AUTO_LINES: usize = 24;
/// The most bend lines of a part: five times as many as a shop bumps on a large radius.
pub const MOST_BEND_LINES: usize = 1000;

/// How bend lines are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BendMarks {
    /// A tick at each end is engraved, from which a straightedge is laid to the other; the line and
    /// its text are notes.
    #[default]
    Ticks,
    /// The whole line and its text are engraved.
    Lines,
    /// As [`Self::Ticks`], and all rulings as notes.
    Rulings,
    /// Not at all; folds alone are.
    None,
}

/// How many bend lines a panel gets, and how they are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bends {
    /// How many.
    pub rule: BendRule,
    /// How they are drawn.
    pub marks: BendMarks,
}
