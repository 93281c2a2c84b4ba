//! What is marked on the faces of parts: the data alone. `mark` makes it.

use sheetwright_geometry::math::{Point2, Point3, Vec3};

/// A mark on some parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The parts that it stands on.
    pub on: Vec<MarkOn>,
    /// What is marked.
    pub kind: MarkKind,
}

/// Parts of a design.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MarkOn {
    /// All.
    All,
    /// Those of this name, or of the panel of this name.
    Part {
        /// The name.
        name: String,
    },
}

/// What is marked on a part. Lengths are mm, angles radians.
#[derive(Clone, Debug, PartialEq)]
pub enum MarkKind {
    /// Where planes square to an axis cut the part: the frames of a boat.
    Stations {
        /// The axis.
        axis: Axis,
        /// Where the planes lie.
        at: StationPlaces,
    },
    /// An arrow along the grain.
    Grain {
        /// Its direction.
        way: MarkWay,
        /// Its length, where there is room for it.
        length: f64,
    },
    /// An edge that lies on the fold of the cloth: the piece is cut double.
    Fold {
        /// The name of the edge.
        edge: String,
    },
    /// Which face of the sheet is seen, and which way it lies in space.
    Face {
        /// Its text.
        text: String,
        /// The direction in space that its arrow points in.
        toward: Vec3,
        /// The length of the arrow, where there is room for it.
        length: f64,
    },
    /// A hole.
    Drill {
        /// Its middle.
        at: MarkAt,
        /// Its diameter.
        diameter: f64,
    },
    /// A text.
    Text {
        /// Its middle; `None`: where there is most room.
        at: Option<MarkAt>,
        /// What it says.
        text: String,
        /// How high its letters are, where there is room for them; `None`: as edge names.
        height: Option<f64>,
    },
}

impl MarkKind {
    /// Its name in designs.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Stations { .. } => "stations",
            Self::Grain { .. } => "grain",
            Self::Fold { .. } => "fold",
            Self::Face { .. } => "face",
            Self::Drill { .. } => "drill",
            Self::Text { .. } => "text",
        }
    }
}

/// An axis of space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    #[default]
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    /// The coordinate of a point along it, mm.
    pub fn of(self, point: Point3) -> f64 {
        match self {
            Self::X => point.x,
            Self::Y => point.y,
            Self::Z => point.z,
        }
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

/// Where stations lie along their axis.
#[derive(Clone, Debug, PartialEq)]
pub enum StationPlaces {
    /// At these places.
    Listed {
        /// The planes, in order.
        planes: Vec<StationPlane>,
    },
    /// At all multiples of a distance.
    Every {
        /// The distance.
        pitch: f64,
        /// The place that they are counted from.
        from: f64,
    },
}

/// A station.
#[derive(Clone, Debug, PartialEq)]
pub struct StationPlane {
    /// Its coordinate along the axis.
    pub at: f64,
    /// Its name; `None`: the axis and the coordinate.
    pub name: Option<String>,
}

/// A place on a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MarkAt {
    /// The point of the part that is nearest to a place in space.
    Space {
        /// The place.
        at: Point3,
        /// How far off the part it may be.
        within: f64,
    },
    /// A place on the flat pattern.
    Flat {
        /// The place.
        at: Point2,
    },
}

/// A direction on a part.
#[derive(Clone, Debug, PartialEq)]
pub enum MarkWay {
    /// That of a vector in space, laid on the part.
    Space {
        /// The vector.
        way: Vec3,
    },
    /// From end to end of an edge.
    Edge {
        /// The name of the edge.
        edge: String,
    },
    /// At this angle to the horizontal on the flat pattern, counter-clockwise.
    Angle {
        /// The angle.
        angle: f64,
    },
}

impl Mark {
    /// The mark in a design whose lengths are times a factor: places in space move, sizes of
    /// arrows, holes and letters stay.
    pub(super) fn scaled(&mut self, factor: f64) {
        let place = |at: &mut MarkAt| match at {
            MarkAt::Space { at, within } => {
                *at = Point3::from_vec(at.to_vec() * factor);
                *within *= factor;
            }
            MarkAt::Flat { at } => *at = Point2::default() + at.to_vec() * factor,
        };
        match &mut self.kind {
            MarkKind::Stations { at: StationPlaces::Listed { planes }, .. } => {
                planes.iter_mut().for_each(|plane| plane.at *= factor);
            }
            MarkKind::Stations { at: StationPlaces::Every { pitch, from }, .. } => {
                *pitch *= factor;
                *from *= factor;
            }
            MarkKind::Drill { at, .. } | MarkKind::Text { at: Some(at), .. } => place(at),
            _ => {}
        }
    }
}
