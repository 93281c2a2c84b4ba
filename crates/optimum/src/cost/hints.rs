//! Hints: points that a surface should pass near, or keep away from.
//!
//! A closed curve may bound two developable surfaces, as the two sides of its convex hull do, and
//! samples alone decide which of them costs less. A person knows, and says so by a point. So that
//! the table of equation (5) stays exact, a hint is a price of single rungs: seen along the
//! direction that the boundary faces, a rung that passes over or under the point costs by the
//! distance at which it does so. With d that distance, and u the distance at which it passes the
//! point sideways,
//!
//! price = WEIGHT · max(0, 1 − u/reach)² · max(0, (d − u)/near − 1)², at most the largest twist
//! there is, for a surface that should pass near (u is taken off d since a slanting surface that
//! passes through the point is higher beside it), and
//!
//! price = WEIGHT · max(0, 1 − u/reach)² · max(0, 1 − d/near)², for one that should keep away.
//!
//! Rungs that pass elsewhere cost nothing more, so the rest of the surface is free.

use super::quantised;
use sheetwright_geometry::math::{Point3, Vec3};

/// What a rung right over a hint costs at twice the distance [`NEAR`], and one through a hint that
/// it should keep away from: the twist of a warp angle of 26°.
const WEIGHT: f64 = 0.1;
/// The most that a hint adds to a rung: the largest twist there is.
const MOST: f64 = 2.0;
/// How far to the side of a hint rungs are looked at, as a share of the size of the boundary: with
/// 100 samples some ten rungs pass there.
const REACH: f64 = 0.05;
/// The distance that a surface may have from a hint, and from which on it keeps away, as a share of
/// the size of the boundary: what a hand misses in the editor.
const NEAR: f64 = 0.005;

/// Whether a surface should pass a hint or avoid it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HintKind {
    /// It should pass near.
    Near,
    /// It should keep away.
    Away,
}

/// A point in space that a surface should pass near, or keep away from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hint {
    /// Where it lies, mm.
    pub at: Point3,
    /// What it asks for.
    pub kind: HintKind,
}

/// The hints of a boundary.
#[derive(Clone, Debug)]
pub(super) struct Hints {
    hints: Vec<Hint>,
    /// The direction that the boundary faces.
    up: Vec3,
    reach_mm: f64,
    near_mm: f64,
}

impl Hints {
    /// Those of a boundary of this size that faces `up`; `None` if there are none.
    pub(super) fn new(hints: &[Hint], up: Vec3, size_mm: f64) -> Option<Self> {
        let (reach_mm, near_mm) = (REACH * size_mm, NEAR * size_mm);
        (!hints.is_empty()).then(|| Self { hints: hints.to_vec(), up, reach_mm, near_mm })
    }

    /// The price of a rung between two points, a multiple of [`super::QUANTUM`].
    pub(super) fn price(&self, from: Vec3, to: Vec3) -> f64 {
        let along = to - from;
        let flat = along - self.up * along.dot(self.up);
        let flat_squared = flat.dot(flat);
        let of_hint = |hint: &Hint| {
            let offset = hint.at.to_vec() - from;
            let way = if flat_squared > 0.0 { offset.dot(flat) / flat_squared } else { 0.5 };
            let off = offset - along * way.clamp(0.0, 1.0);
            let height = off.dot(self.up);
            let aside = (off - self.up * height).length();
            let share = (1.0 - aside / self.reach_mm).max(0.0);
            let by_height = match hint.kind {
                HintKind::Near => ((height.abs() - aside) / self.near_mm - 1.0).max(0.0),
                HintKind::Away => (1.0 - height.abs() / self.near_mm).max(0.0),
            };
            quantised((WEIGHT * share * share * by_height * by_height).min(MOST))
        };
        self.hints.iter().map(of_hint).sum()
    }
}
