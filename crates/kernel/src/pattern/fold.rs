//! The folds of a net: mountains and valleys, with their angles.

use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use crate::bend::BendLine;
use sheetwright_geometry::math::{Vec2, to_deg, unit2};

/// Angles below it, degrees, are not written: a hand can't fold so finely.
const WRITTEN_DEG: f64 = 5.0;
/// Letters of an angle are as high as those of the piece times this, at the most.
const BESIDE_NAME: f64 = 0.3;
/// Letters are as high as this share of the fold, at the most.
const ALONG: f64 = 0.12;
/// Lower letters can't be read.
const LEAST_MM: f64 = 1.5;

/// A fold as it is scored.
pub(super) fn path(fold: &BendLine) -> PatternPath {
    PatternPath {
        role: Role::Score,
        kind: PathKind::Fold { mountain: !fold.is_up() },
        points: fold.ends.to_vec(),
        closed: false,
    }
}

/// The angle of a fold beside its middle, upright as far as it can; `None` where there is no room.
pub(super) fn label(fold: &BendLine, height_mm: f64) -> Option<PatternLabel> {
    let [from, to] = fold.ends;
    let height_mm = (BESIDE_NAME * height_mm).min(ALONG * from.distance(to));
    let is_written = height_mm >= LEAST_MM && to_deg(fold.angle.abs()) >= WRITTEN_DEG;
    let way = unit2(to - from).filter(|_| is_written)?;
    let along = if way.x > 0.0 || (way.x == 0.0 && way.y > 0.0) { way } else { -way };
    let beside: Vec2 = along.perp() * (0.4 * height_mm);
    Some(PatternLabel {
        kind: LabelKind::Angle,
        role: Role::Note,
        at: from.lerp(to, 0.5) + beside,
        along,
        height_mm,
        text: format!("{:.0}°", to_deg(fold.angle.abs())),
    })
}
