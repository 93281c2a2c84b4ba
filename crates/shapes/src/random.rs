//! Random numbers from a seed, and random boundaries.

use sheetwright::boundary::{Boundary, samples_from_points};
use sheetwright::curve::CurvePoint;
use sheetwright::math::{Point3, cos, sin};

pub use sheetwright::random::Random;

/// A closed polygon of m samples about the axis z, some of them corners, of random height; its
/// projection is star-shaped, so that it has a supporting plane. `None` if it is no boundary.
pub fn star(random: &mut Random, m: usize, corners: f64) -> Option<Boundary> {
    let points: Vec<CurvePoint> = (0..m)
        .map(|i| {
            let angle = std::f64::consts::TAU * (i as f64 + random.between(0.0, 0.8)) / m as f64;
            let r = random.between(40.0, 100.0);
            CurvePoint {
                at: Point3::new(r * cos(angle), r * sin(angle), random.between(-40.0, 40.0)),
                corner: random.unit() < corners,
                move_mm: 0.0,
            }
        })
        .collect();
    Boundary::new(vec![samples_from_points(&points)]).ok()
}

/// A closed polygon of m random points of a cube: mostly knotted about itself.
pub fn tangle(random: &mut Random, m: usize, corners: f64) -> Option<Boundary> {
    let points: Vec<CurvePoint> = (0..m)
        .map(|_| CurvePoint {
            at: Point3::new(random.unit() * 100.0, random.unit() * 100.0, random.unit() * 100.0),
            corner: random.unit() < corners,
            move_mm: 0.0,
        })
        .collect();
    Boundary::new(vec![samples_from_points(&points)]).ok()
}

/// A closed polygon on a coarse grid, so that many rungs and triangles tie, lie on lines or in
/// planes. `None` if it is no boundary.
pub fn grid(random: &mut Random, m: usize) -> Option<Boundary> {
    let flat = random.unit() < 0.5;
    let points: Vec<CurvePoint> = (0..m)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / m as f64;
            let r = random.between(1.0, 4.0);
            let z = if flat { 0.0 } else { random.below(3) as f64 };
            CurvePoint {
                at: Point3::new((r * cos(angle)).round(), (r * sin(angle)).round(), z),
                corner: random.unit() < 0.5,
                move_mm: 0.0,
            }
        })
        .collect();
    Boundary::new(vec![samples_from_points(&points)]).ok()
}
