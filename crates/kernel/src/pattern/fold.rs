//! The folds of a net: mountains and valleys, with their angles.

use super::wish::{FROM_MIDDLE, Instead, Wish, WishAt};
use super::{LabelKind, PathKind, PatternPath, Role};
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

/// The angle of a fold beside its middle; `None` of one that a hand can't fold so finely.
pub(super) fn wish(fold: &BendLine) -> Option<Wish> {
    let angle_deg = to_deg(fold.angle.abs());
    let (line, shares) = (fold.ends.to_vec(), FROM_MIDDLE);
    (angle_deg >= WRITTEN_DEG).then(|| Wish {
        kind: LabelKind::Angle,
        role: Role::Note,
        texts: vec![format!("{angle_deg:.0}°")],
        height_mm: None,
        at: vec![WishAt::Beside { line, shares, is_left: false, away_mm: 0.0 }],
        instead: Instead::Nothing,
    })
}
