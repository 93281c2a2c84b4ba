//! Panels on both sides of the limit of a sheet: strips that twist or wave, rolled sheets, saddles
//! and random closed curves. How far a sheet stretches in them depends on its thickness.

use crate::random::Random;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
use sheetwright::math::{Point3, cos, from_deg, sin};
use std::f64::consts::TAU;

/// Points of every curve but the closed ones.
const POINTS: usize = 25;
/// Points of a closed curve.
const RING: usize = 48;
/// Samples of each rail.
const SAMPLES: usize = 100;
/// The radius of saddles and of closed curves in their plan, mm.
const RADIUS: f64 = 300.0;

/// A strip between two rails of points.
pub fn strip(name: &str, rails: [Vec<Point3>; 2], kind: CurveKind) -> Design {
    let names = ["low", "high"];
    let curves = rails.into_iter().zip(names).map(|(points, name)| DesignCurve {
        name: name.into(),
        kind: Some(kind),
        closed: false,
        points: points.into_iter().map(CurvePoint::smooth).collect(),
    });
    let on = |name: &str| CurveUse { name: name.into(), reversed: false };
    Design {
        name: name.into(),
        curves: curves.collect(),
        panels: vec![DesignPanel::new("strip", PanelShape::Rails(names.map(on)), SAMPLES)],
        ..Design::default()
    }
}

/// The points of a rail over the share of its way, 0 to 1.
fn rail(at: impl Fn(f64) -> Point3) -> Vec<Point3> {
    (0..POINTS).map(|i| at(i as f64 / (POINTS - 1) as f64)).collect()
}

/// A strip of 1200 x 300 mm that is twisted by an angle, its rails on a helicoid.
pub fn twisted(deg: f64) -> Design {
    let side = |side: f64| {
        rail(|share| {
            let angle = from_deg(deg) * share;
            Point3::new(1200.0 * share, 150.0 * side * cos(angle), 150.0 * side * sin(angle))
        })
    };
    strip(&format!("twisted by {deg}°"), [side(-1.0), side(1.0)], CurveKind::Spline)
}

/// A strip of about 1000 x 250 mm between two rails that wave by so many mm, out of step by a
/// phase, radians.
pub fn wavy(height_mm: f64, phase: f64) -> Design {
    let at = |z: f64, phase: f64| {
        rail(|share| Point3::new(1000.0 * share, height_mm * sin(6.3 * share + phase), z))
    };
    let rails = [at(0.0, 0.0), at(250.0, phase)];
    strip(&format!("wavy, {height_mm} mm, {phase} out of step"), rails, CurveKind::Spline)
}

/// A quarter of a cylinder of this radius, 300 mm high.
pub fn cylinder(radius_mm: f64) -> Design {
    let arc = |z: f64| {
        rail(|share| {
            let angle = 0.25 * TAU * share;
            Point3::new(radius_mm * cos(angle), radius_mm * sin(angle), z)
        })
    };
    let name = format!("cylinder of radius {radius_mm} mm");
    strip(&name, [arc(0.0), arc(300.0)], CurveKind::Spline)
}

/// A quarter of a frustum of a cone between circles of these radii, 300 mm apart.
pub fn cone(radii_mm: [f64; 2]) -> Design {
    let arc = |radius: f64, z: f64| {
        rail(|share| {
            let angle = 0.25 * TAU * share;
            Point3::new(radius * cos(angle), radius * sin(angle), z)
        })
    };
    let [low, high] = radii_mm;
    let name = format!("cone of radii {low} to {high} mm");
    strip(&name, [arc(low, 0.0), arc(high, 300.0)], CurveKind::Spline)
}

/// A disk of radius 300 mm whose rim rises and falls twice, by so many mm.
pub fn saddle(height_mm: f64) -> Design {
    closed(&format!("saddle, {height_mm} mm"), |t| {
        Point3::new(RADIUS * cos(t), RADIUS * sin(t), height_mm * cos(2.0 * t))
    })
}

/// A random smooth closed curve: Fourier series of order 5 in the radius about 300 mm and of order
/// 4 in the height, amplitudes about 1/k²; the number is the seed.
pub fn fourier(seed: u64) -> Design {
    let mut random = Random::new(seed);
    let mut waves = |orders: std::ops::RangeInclusive<u32>| -> Vec<[f64; 3]> {
        orders
            .map(|k| {
                let k = f64::from(k);
                [k, random.between(-1.7, 1.7) / (k * k), random.between(0.0, TAU)]
            })
            .collect()
    };
    let (outward, upward) = (waves(2..=5), waves(2..=4));
    let sum = |waves: &[[f64; 3]], t: f64| -> f64 {
        waves.iter().map(|[k, size, phase]| size * cos(k * t + phase)).sum()
    };
    closed(&format!("random curve {seed}"), |t| {
        let radius = RADIUS * (1.0 + 0.3 * sum(&outward, t));
        Point3::new(radius * cos(t), radius * sin(t), 0.4 * RADIUS * sum(&upward, t))
    })
}

/// The panel inside a closed spline through points at even angles.
fn closed(name: &str, at: impl Fn(f64) -> Point3) -> Design {
    let points = (0..RING).map(|n| CurvePoint::smooth(at(TAU * n as f64 / RING as f64)));
    let rim = DesignCurve {
        name: "rim".into(),
        kind: Some(CurveKind::Spline),
        closed: true,
        points: points.collect(),
    };
    let outer = vec![CurveUse { name: "rim".into(), reversed: false }];
    let shape = PanelShape::Loops { outer, holes: Vec::new() };
    Design {
        name: name.into(),
        curves: vec![rim],
        panels: vec![DesignPanel::new("sheet", shape, 2 * SAMPLES)],
        ..Design::default()
    }
}
