//! What of a document is selected.

use sheetwright::check::Place;

/// A point of a curve, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PointRef {
    /// The curve.
    pub curve: usize,
    /// The point on it.
    pub point: usize,
}

/// What is selected. What is marked of a panel, a rung or the place of a finding, is a place on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Points, each once, in order.
    pub points: Vec<PointRef>,
    /// A curve, by its number.
    pub curve: Option<usize>,
    /// A panel, by its number among those that are shown.
    pub panel: Option<usize>,
    /// What is marked of that panel.
    pub place: Place,
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

    /// A place on a panel.
    pub fn of_place(panel: usize, place: Place) -> Self {
        Self { panel: Some(panel), place, ..Self::default() }
    }

    /// A rung of a panel.
    pub fn of_rung(panel: usize, rung: usize) -> Self {
        Self::of_place(panel, Place::Rungs { numbers: vec![rung] })
    }

    /// The panel and its rung, where one rung alone is marked.
    pub fn rung(&self) -> Option<(usize, usize)> {
        match &self.place {
            Place::Rungs { numbers } if numbers.len() == 1 => self.panel.zip(Some(numbers[0])),
            _ => None,
        }
    }
}
