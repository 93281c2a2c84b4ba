//! Shapes of the gallery, after the figures of the paper that the project grew from: a multiply
//! connected region on a curved surface, a raised surface, and half a sphere.

use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape, Triangles};
use sheetwright::index::VertexIndex;
use sheetwright::math::{Point2, Point3, cos, sin};
use std::f64::consts::TAU;

/// The radius of the plan of every shape, mm.
const RADIUS: f64 = 200.0;

/// A region with two windows on a saddle-backed hood, which no sheet fits exactly.
pub fn multiply_connected(samples: usize) -> Design {
    let hood = |p: Point2| {
        let (x, y) = (p.x / RADIUS, p.y / RADIUS);
        Point3::new(p.x, p.y, RADIUS * (0.5 - 0.42 * y * y - 0.06 * x * x))
    };
    let outer = ring("rim", 16, |t| {
        let reach = RADIUS * (1.0 + 0.08 * cos(3.0 * t));
        hood(Point2::new(1.3 * reach * cos(t), reach * sin(t)))
    });
    let window = |name: &str, middle: Point2, radii: [f64; 2]| {
        ring(name, 10, |t| {
            hood(Point2::new(middle.x + radii[0] * cos(t), middle.y + radii[1] * sin(t)))
        })
    };
    let windows = [
        window("window-1", Point2::new(-115.0, 10.0), [55.0, 75.0]),
        window("window-2", Point2::new(110.0, -15.0), [60.0, 60.0]),
    ];
    designed("multiply connected", samples, outer, windows.into())
}

/// A round outline whose rim waves up and down: a surface that stands up in the middle.
pub fn raised(samples: usize) -> Design {
    let rim = ring("rim", 16, |t| {
        let wave = RADIUS * (0.22 * cos(2.0 * t) + 0.05 * cos(3.0 * t));
        Point3::new(1.25 * RADIUS * cos(t), RADIUS * sin(t), wave)
    });
    designed("raised", samples, rim, Vec::new())
}

/// Half a sphere, of `rings` rings of triangles round the pole, counter-clockwise as seen from
/// outside.
pub fn half_sphere(rings: usize) -> Triangles {
    disk(rings, |r, t| {
        let angle = 0.25 * TAU * r;
        let level = RADIUS * sin(angle);
        Point3::new(level * cos(t), level * sin(t), RADIUS * cos(angle))
    })
}

/// The image of the unit disk, given in polar coordinates: ring k has 6 k vertices, so that all
/// triangles of the disk are about equal.
fn disk(rings: usize, map: impl Fn(f64, f64) -> Point3) -> Triangles {
    let mut positions = vec![map(0.0, 0.0)];
    for k in 1..=rings {
        let radius = k as f64 / rings as f64;
        let count = 6 * k;
        positions.extend((0..count).map(|n| map(radius, TAU * n as f64 / count as f64)));
    }
    let first = |k: usize| if k == 0 { 0 } else { 3 * k * (k - 1) + 1 };
    let at = |k: usize, n: usize| if k == 0 { 0 } else { first(k) + n % (6 * k) };
    let mut triangles = Vec::with_capacity(6 * rings * rings);
    for k in 1..=rings {
        for sector in 0..6 {
            for n in 0..k {
                let (outer, inner) = (sector * k + n, sector * (k - 1) + n);
                triangles.push([at(k, outer), at(k, outer + 1), at(k - 1, inner)]);
                if n + 1 < k {
                    triangles.push([at(k - 1, inner), at(k, outer + 1), at(k - 1, inner + 1)]);
                }
            }
        }
    }
    let triangles = triangles.into_iter().map(|t: [usize; 3]| t.map(VertexIndex::new)).collect();
    Triangles { positions, triangles, left_out: 0 }
}

/// A closed spline through `count` points, rounded to a hundredth of a millimetre, as in files that
/// are typed.
fn ring(name: &str, count: usize, at: impl Fn(f64) -> Point3) -> DesignCurve {
    let hundredth = |x: f64| (x * 100.0).round() / 100.0 + 0.0;
    let points = (0..count).map(|n| {
        let p = at(TAU * n as f64 / count as f64);
        CurvePoint::smooth(Point3::new(hundredth(p.x), hundredth(p.y), hundredth(p.z)))
    });
    DesignCurve {
        name: name.to_owned(),
        kind: Some(CurveKind::Spline),
        closed: true,
        points: points.collect(),
    }
}

fn designed(name: &str, samples: usize, outer: DesignCurve, holes: Vec<DesignCurve>) -> Design {
    let used = |curve: &DesignCurve| vec![CurveUse { name: curve.name.clone(), reversed: false }];
    let panel = DesignPanel::new(
        "sheet",
        PanelShape::Loops { outer: used(&outer), holes: holes.iter().map(used).collect() },
        samples,
    );
    let mut curves = vec![outer];
    curves.extend(holes);
    Design { name: name.to_owned(), curves, panels: vec![panel], ..Design::default() }
}
