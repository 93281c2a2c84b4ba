//! What is done along edges: the data alone. `trim` makes it.
//!
//! A trim stands on edges, over a span of each. One on edges that are joined is made on both, at
//! equal shares of their common length. Of trims that move the cut line (allowances, hems, flanges,
//! tabs, fingers, slots and puzzles), an edge has one: the last in the list takes the place of the
//! others.

/// What is done along some edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Trim {
    /// Where it stands.
    pub on: Vec<TrimOn>,
    /// From which share of an edge to which, within 0 ..= 1.
    pub span: [f64; 2],
    /// What is done.
    pub kind: TrimKind,
}

impl Trim {
    /// This along the whole of these edges.
    pub fn new(on: impl IntoIterator<Item = TrimOn>, kind: TrimKind) -> Self {
        Self { on: on.into_iter().collect(), span: [0.0, 1.0], kind }
    }
}

/// Edges of a design.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TrimOn {
    /// All.
    All,
    /// Those that are joined to none.
    Free,
    /// Those that are joined to another, sides of cuts included.
    Joined,
    /// The sides of cuts.
    Cuts,
    /// Those around holes.
    Holes,
    /// Those of this name.
    Edge {
        /// The part or panel; `None` for every one.
        part: Option<String>,
        /// The name of the edge.
        edge: String,
    },
}

/// What is done along an edge. Lengths are mm, angles radians.
#[derive(Clone, Debug, PartialEq)]
pub enum TrimKind {
    /// Material beyond the net line, to sew or glue.
    Allowance(Allowance),
    /// Material that is folded back over the net line, once or twice.
    Hem(Hem),
    /// Material that is bent up or down at the net line.
    Flange(Flange),
    /// Tabs on one of two joined edges, to glue under the other.
    Tabs(Tabs),
    /// Holes inside the net line, for stitches, ties or rivets.
    Holes(Holes),
    /// Notches in the cut line, to match edges by.
    Notches(Notches),
    /// Ticks inside the net line, to match edges by.
    Ticks(Ticks),
    /// Fingers of one of two joined edges in gaps of the other.
    Fingers(Fingers),
    /// Knobs of one of two joined edges in sockets of the other.
    Puzzle(Puzzle),
    /// Tabs of one of two joined edges through slots of the other.
    Slots(Slots),
}

impl TrimKind {
    /// Its name in designs.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Allowance(_) => "allowance",
            Self::Hem(_) => "hem",
            Self::Flange(_) => "flange",
            Self::Tabs(_) => "tabs",
            Self::Holes(_) => "holes",
            Self::Notches(_) => "notches",
            Self::Ticks(_) => "ticks",
            Self::Fingers(_) => "fingers",
            Self::Puzzle(_) => "puzzle",
            Self::Slots(_) => "slots",
        }
    }

    /// Whether it moves the cut line along the whole of its span.
    pub const fn moves_the_cut(&self) -> bool {
        !matches!(self, Self::Holes(_) | Self::Notches(_) | Self::Ticks(_))
    }
}

/// How the material beyond two edges ends at the corner between them, in the words of pattern
/// makers' programs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Corner {
    /// Both cut lines run on to where they meet, and are cut off squarely where that is far.
    #[default]
    ByLength,
    /// Each cut line runs on to the other net line, and a straight line joins both points.
    ByIntersection,
    /// The first edge's ends so that it lies on the second's when it is folded over the first.
    FirstEdgeSymmetry,
    /// The second edge's ends so that it lies on the first's when it is folded over the second.
    SecondEdgeSymmetry,
    /// The first edge's ends at a right angle to it, where the second's cut line meets its net
    /// line.
    FirstEdgeRightAngle,
    /// The second edge's ends at a right angle to it, where the first's cut line meets its net
    /// line.
    SecondEdgeRightAngle,
}

/// See [`TrimKind::Allowance`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowance {
    /// Its width at the beginning and at the end of the span, changing evenly between.
    pub width: [f64; 2],
    /// How it ends at both corners.
    pub corner: Corner,
}

/// See [`TrimKind::Hem`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hem {
    /// The width that is folded back.
    pub width: f64,
    /// The width of that which is turned in under the hem; 0 for a single fold.
    pub turn: f64,
}

/// See [`TrimKind::Flange`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flange {
    /// Its width on the flat.
    pub width: f64,
    /// By how much it is bent, up, away from the back of the sheet.
    pub angle: f64,
    /// How far it keeps from a corner where the next edge has a flange, too.
    pub relief: f64,
}

/// See [`TrimKind::Tabs`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tabs {
    /// Their width, where there is room for it.
    pub width: f64,
    /// The angle of their ends at the net line, at the most.
    pub angle: f64,
    /// How far the edge may leave a straight line along one tab.
    pub tolerance: f64,
}

/// See [`TrimKind::Holes`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Holes {
    /// The distance from hole to hole, about.
    pub pitch: f64,
    /// That near the ends.
    pub end_pitch: f64,
    /// How far from the ends it is that.
    pub end_length: f64,
    /// How far the first and the last hole are from the ends.
    pub ends: f64,
    /// How far their centres are from the net line.
    pub inset: f64,
    /// Their diameter.
    pub diameter: f64,
}

/// Places along an edge.
#[derive(Clone, Debug, PartialEq)]
pub enum Places {
    /// At shares of its length, within 0 ..= 1.
    Shares(Vec<f64>),
    /// At these lengths from its beginning.
    Lengths(Vec<f64>),
    /// At every such length from its middle.
    Every(f64),
}

/// The form of a notch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotchForm {
    /// A cut straight inwards.
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

impl NotchForm {
    /// Whether it reaches outwards from the cut line.
    pub const fn is_outward(self) -> bool {
        matches!(self, Self::VOut | Self::Castle)
    }
}

/// See [`TrimKind::Notches`].
#[derive(Clone, Debug, PartialEq)]
pub struct Notches {
    /// Where they stand.
    pub at: Places,
    /// Their form.
    pub form: NotchForm,
    /// How deep they are.
    pub depth: f64,
    /// How wide they are, if they have a width.
    pub width: f64,
    /// How many stand side by side, 1 to 3.
    pub count: usize,
    /// The distance between those.
    pub gap: f64,
}

/// See [`TrimKind::Ticks`].
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    /// Where they stand.
    pub at: Places,
    /// How long they are.
    pub length: f64,
    /// Whether they have numbers, through all that this trim stands on.
    pub numbered: bool,
}

/// See [`TrimKind::Fingers`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fingers {
    /// The width of a finger, about.
    pub width: f64,
    /// How far fingers reach beyond the net line: the thickness of the other sheet.
    pub depth: f64,
    /// How much wider gaps are than fingers.
    pub clearance: f64,
}

/// See [`TrimKind::Puzzle`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Puzzle {
    /// The distance from knob to knob, about.
    pub pitch: f64,
    /// The width of a knob.
    pub width: f64,
    /// How much wider sockets are than knobs.
    pub clearance: f64,
}

/// See [`TrimKind::Slots`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slots {
    /// The distance from tab to tab, about.
    pub pitch: f64,
    /// The length of a tab along the edge.
    pub width: f64,
    /// How far tabs reach beyond the net line.
    pub depth: f64,
    /// The thickness of the sheet with the tabs: slots are as wide.
    pub thickness: f64,
    /// How much longer and wider slots are than tabs.
    pub clearance: f64,
    /// How much material stays beyond the slots.
    pub beyond: f64,
    /// The diameter of the holes in the corners of slots, which a round cutter needs; 0 without.
    pub dogbone: f64,
}
