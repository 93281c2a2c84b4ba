//! The folds of a net: mountains and valleys, with their angles.

use super::wish::{FROM_MIDDLE, Instead, Wish, WishAt};
use super::{LabelKind, PathKind, PatternPath, Piece, Role};
use crate::bend::BendLine;
use sheetwright_geometry::math::to_deg;

/// Angles below it, degrees, are not written: a hand can't fold so finely.
const WRITTEN_DEG: f64 = 5.0;

/// A fold as it is scored.
pub(super) fn path(fold: &BendLine) -> PatternPath {
    PatternPath {
        role: Role::Score,
        kind: PathKind::Fold { mountain: !fold.is_up() },
        points: fold.ends.to_vec(),
        closed: false,
    }
}

/// The angle of a fold along it, in a facet that it folds: beside another line it would be taken
/// for the angle of that. `None` of a fold that a hand can't fold so finely.
pub(super) fn wish(fold: &BendLine) -> Option<Wish> {
    let angle_deg = to_deg(fold.angle.abs());
    let (line, shares) = (fold.ends.to_vec(), FROM_MIDDLE);
    (angle_deg >= WRITTEN_DEG).then(|| Wish {
        kind: LabelKind::Angle,
        role: Role::Note,
        texts: vec![format!("{angle_deg:.0}°")],
        height_mm: None,
        at: vec![WishAt::Along { line, shares }],
        instead: Instead::Nothing,
    })
}

impl Piece {
    /// How many folds of a net have no angle, since there is no room for it along them, and how
    /// many would have one.
    pub fn folds_without_angle(&self) -> (usize, usize) {
        let written = self.labels.iter().filter(|label| label.kind == LabelKind::Angle).count();
        let wanted = self.bends.iter().filter(|fold| wish(fold).is_some()).count();
        (wanted.saturating_sub(written), wanted)
    }
}
