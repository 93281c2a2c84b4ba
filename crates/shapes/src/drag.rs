//! Designs with handles to drag, and the path of a handle under a hand.

use crate::family::Family;
use crate::random::Random;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
use sheetwright::math::{Point3, Vec3};

/// Handles of a family's curve.
const HANDLES: usize = 24;

/// A panel whose outline is this curve, alone in its design, with this many samples and this weight
/// of the fold price.
pub fn one_panel(outline: DesignCurve, samples: usize, fold: f64) -> Design {
    let on = CurveUse { name: outline.name.clone(), reversed: false };
    let panel = DesignPanel {
        fold,
        ..DesignPanel::new(
            "panel",
            PanelShape::Loops { outer: vec![on], holes: Vec::new() },
            samples,
        )
    };
    Design {
        name: outline.name.clone(),
        curves: vec![outline],
        panels: vec![panel],
        ..Design::default()
    }
}

/// A curve of 24 handles that follows a family's: a B-spline, or a spline between the corners if it
/// has any.
pub fn outline(family: Family) -> DesignCurve {
    let boundary = family.boundary(HANDLES);
    let samples = boundary.samples();
    let points = samples.iter().map(|sample| CurvePoint {
        at: sample.position,
        corner: sample.is_corner(),
        move_mm: 0.0,
    });
    let has_corners = samples.iter().any(|sample| sample.is_corner());
    let kind = if has_corners { CurveKind::Spline } else { CurveKind::BSpline };
    DesignCurve { name: family.name(), kind: Some(kind), closed: true, points: points.collect() }
}

/// A handle that is dragged: it wanders about its first place, as under a hand.
pub struct Drag {
    home: Point3,
    off: Vec3,
    reach: f64,
    random: Random,
}

impl Drag {
    /// Steps of this share of the reach.
    const STEP: f64 = 0.2;

    /// The drag of a handle at `home` by about `reach`, mm.
    pub fn new(home: Point3, reach: f64, seed: u64) -> Self {
        Self { home, off: Vec3::ZERO, reach, random: Random::new(seed) }
    }

    /// Moves one step and returns the new place.
    pub fn step(&mut self) -> Point3 {
        let mut between = || self.random.between(-1.0, 1.0);
        let step = Vec3::new(between(), between(), between());
        self.off = self.off * 0.98 + step * (Self::STEP * self.reach);
        self.home + self.off
    }
}
