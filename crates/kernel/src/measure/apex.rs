//! Points that rulings run together in, and how tightly the sheet is bent around them.
//!
//! Around such a point the surface is a cone: at a distance r from it, the rulings that turn by β
//! all together lie φ r apart, with φ their angle at the point, so the bend radius is r φ/β. A
//! sheet that takes a least radius can't follow the cone nearer than r = radius · β/φ: there it
//! forms a soft crease instead.

use crate::surface::Surface;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::angle_between;

/// A sample that rulings run together in, as in the point of a cone: towards it the bend radius
/// falls to nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apex {
    /// The sample.
    pub sample: SampleIndex,
    /// By how much the sheet turns round it, radians.
    pub turn: f64,
    /// The radius of the shallowest roll that sheets make instead of it, mm.
    pub radius_mm: f64,
    /// The mean bend radius around it over the distance from it, without unit: φ/β; infinite where
    /// its turns cancel out.
    pub radius_by_distance: f64,
}

impl Apex {
    /// How far from it the bend radius is smaller than this, mm, on average round it.
    pub fn reach_mm(&self, radius_mm: f64) -> f64 {
        radius_mm / self.radius_by_distance
    }
}

/// The mean bend radius around an apex over the distance from it, by the creases of the hinges of
/// the surface; infinite where none turns there.
pub(super) fn radius_by_distance(
    surface: &Surface,
    creases: &[f64],
    apex: SampleIndex,
    least_turn: f64,
) -> f64 {
    let connectivity = surface.connectivity();
    let mut turned = 0.0f64;
    let mut far_ends = Vec::new();
    for (hinge, crease) in connectivity.hinges().iter().zip(creases) {
        let [low, high] = hinge.rung.ends();
        if (low == apex || high == apex) && crease.abs() > least_turn {
            turned += crease;
            far_ends.push(if low == apex { high } else { low });
        }
    }
    // The far sides of the triangles around it, which are a fan.
    let far_side = |corners: &[SampleIndex; 3]| {
        let mut others = corners.iter().copied().filter(|&corner| corner != apex);
        let (a, b) = (others.next()?, others.next()?);
        corners.contains(&apex).then_some([a, b])
    };
    let mut fan: Vec<[SampleIndex; 2]> =
        connectivity.triangles().iter().filter_map(far_side).collect();
    // Flat triangles are taken off both ends of the fan, up to the outermost hinges that turn.
    loop {
        let is_end = |of: SampleIndex| {
            !far_ends.contains(&of)
                && fan.iter().flatten().filter(|&&other| other == of).count() == 1
        };
        let kept: Vec<[SampleIndex; 2]> =
            fan.iter().copied().filter(|&[a, b]| !is_end(a) && !is_end(b)).collect();
        if kept.len() == fan.len() {
            break;
        }
        fan = kept;
    }
    let way = |to: SampleIndex| surface.position(to) - surface.position(apex);
    let inside: f64 = fan.iter().map(|&[a, b]| angle_between(way(a), way(b))).sum();
    // Each crease stands for half of the triangles beside it: those beyond the outermost two, which
    // may be flat faces, count as wide as the others.
    let count = far_ends.len() as f64;
    let wide = inside * count / (count - 1.0).max(1.0);
    if turned == 0.0 { f64::INFINITY } else { wide / turned.abs() }
}
