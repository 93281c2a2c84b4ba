//! Panels joined to one.

use sheetwright_geometry::boundary::{Continuity, Within};

/// Panels that are joined to one: P1 ⊕ P2 ⊕ … of their boundaries.
#[derive(Clone, Debug, PartialEq)]
pub struct Join {
    /// The names of the panels, two or more, none of them a join.
    pub parts: Vec<String>,
    /// How smooth the boundary is made where two of them meet on it.
    pub smooth: Continuity,
    /// How far from there it may be changed for that.
    pub within: Within,
    /// Whether the parts are made too. Otherwise this panel takes their place.
    pub keep_parts: bool,
}
