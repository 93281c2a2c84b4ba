//! Whether the facets of a mesh are meant, or sample a smooth shape.

use super::facets::Facets;
use crate::mesh::{Cut, Mesh};
use sheetwright_geometry::math::from_deg;

/// A mesh whose facets are meant has no more of them: a paper model of more takes a week to glue.
pub const MOST_FACETS: usize = 2000;
/// Two neighbouring facets that are meant mostly turn by this much or more, degrees: a circle of 24
/// sides, the coarsest that makers of ducts use for a round one, turns by 15° at each.
pub const MEANT_DEG: f64 = 15.0;
/// Rounding of an angle, degrees: all the sides of such a circle in a file count alike.
const ROUNDING_DEG: f64 = 0.05;

/// How coarse a mesh is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coarseness {
    /// How many facets it has.
    pub facets: usize,
    /// The angle by which it turns at half of the length of its hinges or more, radians; 0 without
    /// any.
    pub median_turn: f64,
}

impl Coarseness {
    /// Whether it has so few facets that they can be folded by hand.
    pub fn has_few(&self) -> bool {
        self.facets <= MOST_FACETS
    }

    /// Whether its facets are meant: few, and most of the length of the lines between them turns
    /// sharply.
    pub fn is_meant(&self) -> bool {
        self.has_few() && self.median_turn >= from_deg(MEANT_DEG - ROUNDING_DEG)
    }
}

/// How coarse a mesh is.
pub fn coarseness(mesh: &Mesh) -> Coarseness {
    let facets = Facets::of(mesh, &Cut::new());
    let turns = facets.hinges.iter().map(|hinge| (hinge.crease.abs(), hinge.length_mm));
    let mut turns: Vec<(f64, f64)> = turns.collect();
    turns.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * turns.iter().map(|turn| turn.1).sum::<f64>();
    let mut sum = 0.0;
    let median = turns.iter().find(|turn| {
        sum += turn.1;
        sum >= half
    });
    Coarseness { facets: facets.list.len(), median_turn: median.map_or(0.0, |turn| turn.0) }
}
