//! What of a document is selected.

/// A point of a curve, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PointRef {
    /// The curve.
    pub curve: usize,
    /// The point on it.
    pub point: usize,
}

/// What is selected.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Points, each once, in order.
    pub points: Vec<PointRef>,
    /// A curve, by its number.
    pub curve: Option<usize>,
    /// A panel, by its number among those that are shown.
    pub panel: Option<usize>,
    /// A rung of that panel, by its number.
    pub rung: Option<usize>,
}

impl Selection {
    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// One point, and the curve that it is on.
    pub fn of_point(at: PointRef) -> Self {
        Self { points: vec![at], curve: Some(at.curve), ..Self::default() }
    }

    /// A rung of a panel.
    pub fn of_rung(panel: usize, rung: usize) -> Self {
        Self { panel: Some(panel), rung: Some(rung), ..Self::default() }
    }
}
