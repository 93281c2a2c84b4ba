//! By how much a flange stretches when it is bent.
//!
//! Along a straight line a strip is bent without stretching. Along a curve its rim gets longer, or
//! shorter, than it is on the pattern.

use super::margin::{Margin, MarginForm};
use super::stretch::{Stretch, moved_out};
use sheetwright_geometry::math::{Point2, Point3, Vec3, cos, sin};

/// Less is not said: what ductile sheet gives by itself.
const SAID: f64 = 0.01;

/// The rim of a flange.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    /// How long it is on the pattern, mm.
    pub(super) flat_mm: f64,
    /// How long it is once the flange is bent, mm.
    pub(super) bent_mm: f64,
}

impl Rim {
    /// By what share it gets longer; negative where it gets shorter.
    pub(super) fn strain(&self) -> f64 {
        self.bent_mm / self.flat_mm - 1.0
    }

    /// Whether it stretches so much that it is said.
    pub(super) fn is_strained(&self) -> bool {
        self.strain().abs() > SAID
    }
}

/// The rim of a flange along an edge; `None` of another strip, and where the sheet beside the edge
/// is not known.
pub(super) fn rim(stretch: &Stretch, margin: &Margin) -> Option<Rim> {
    let MarginForm::Flange { angle, .. } = margin.form else { return None };
    let width_mm = margin.width[0];
    let stations = stretch.stations(margin.span);
    // Along each step, the direction from the fold to the rim.
    let across = |pair: &[f64]| -> Option<Vec3> {
        let face = stretch.face_at(0.5 * (pair[0] + pair[1]))?;
        Some(face.into * -cos(angle) + face.up * sin(angle))
    };
    let across: Vec<Vec3> = stations.windows(2).map(across).collect::<Option<_>>()?;
    let last = across.len().checked_sub(1)?;
    let bent = stations.iter().enumerate().map(|(n, &along)| {
        let [before, after] = [across[n.saturating_sub(1)], across[n.min(last)]];
        // As `moved_out` does on the pattern.
        let mean = (before + after) * (1.0 / (1.0 + before.dot(after)).max(0.2));
        stretch.in_space(along) + mean * width_mm
    });
    let bent: Vec<Point3> = bent.collect();
    let flat: Vec<Point2> = moved_out(&stretch.part(margin.span), width_mm);
    let flat_mm: f64 = flat.windows(2).map(|p| p[0].distance(p[1])).sum();
    let bent_mm: f64 = bent.windows(2).map(|p| p[0].distance(p[1])).sum();
    (flat_mm > 0.0).then_some(Rim { flat_mm, bent_mm })
}
