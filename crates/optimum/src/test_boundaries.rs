//! Boundaries that tests of several modules use.

use sheetwright_geometry::boundary::{Boundary, samples_from_points};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, cos, sin};
use std::f64::consts::TAU;

fn boundary(points: impl Iterator<Item = CurvePoint>) -> Boundary {
    let samples = samples_from_points(&points.collect::<Vec<_>>());
    Boundary::new(vec![samples]).unwrap_or_else(|error| panic!("{error}"))
}

/// Of `m` samples, waving three times about a circle: far from developable where `height` is large.
pub(crate) fn waving(m: usize, height: f64) -> Boundary {
    boundary((0..m).map(|i| {
        let t = TAU * i as f64 / m as f64;
        CurvePoint::smooth(Point3::new(cos(t), sin(t), height * sin(3.0 * t)))
    }))
}

/// A bent plate of `m` samples with four corners and two straight sides.
pub(crate) fn plate(m: usize) -> Boundary {
    boundary((0..m).map(|i| {
        let (side, t) = (4 * i / m, (4 * i % m) as f64 / m as f64);
        let [s, z] = [[t, 0.0], [1.0, t], [1.0 - t, 1.0], [0.0, 1.0 - t]][side];
        let at = Point3::new(sin(2.0 * s), 0.3 * s * z - cos(2.0 * s), z);
        CurvePoint { corner: (4 * i).is_multiple_of(m), ..CurvePoint::smooth(at) }
    }))
}

/// A square with two straight sides and two bent ones, `n` samples each.
pub(crate) fn bent_square(n: usize) -> Boundary {
    let corners: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    boundary((0..4 * n).map(|at| {
        let (side, t) = (at / n, (at % n) as f64 / n as f64);
        let (from, to) = (corners[side], corners[(side + 1) % 4]);
        let [x, y] = [0, 1].map(|axis| (1.0 - t) * from[axis] + t * to[axis]);
        let at = Point3::new(x, y, 0.3 * sin(3.0 * x));
        CurvePoint { corner: t == 0.0, ..CurvePoint::smooth(at) }
    }))
}

/// With a side along which triangles are slivers, whose normals rounding turns.
pub(crate) fn nearly_straight(bend: f64) -> Boundary {
    let side = (0..=400).map(|n| {
        let x = f64::from(n) / 400.0;
        Point3::new(0.8 * x, 0.6 * x + bend * x * x, 3.0 * bend * x * x * x)
    });
    let points = side.chain([Point3::new(1.0, 2.0, 0.0), Point3::new(0.0, 2.0, 0.0)]);
    boundary(points.map(CurvePoint::smooth))
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.next() * n as f64) as usize).min(n - 1)
    }
}

/// Boundaries of all kinds: near to developable, far from it, tied, with straight and with doubled
/// back runs, with corners and without.
pub(crate) fn random_boundary(seed: u64) -> Option<Boundary> {
    let mut random = Random(seed * 7919 + 17);
    for _ in 0..4 {
        random.next();
    }
    let m = 24 + random.below(120);
    let kind = seed % 8;
    let wave: Vec<f64> = (0..12).map(|_| random.next() - 0.5).collect();
    let at = |i: usize, random: &mut Random| {
        let t = TAU * i as f64 / m as f64;
        let bent = |u: f64, v: f64| {
            let angle = u * (0.5 + wave[0]);
            [40.0 * sin(angle), 40.0 * v, 40.0 * cos(angle)]
        };
        match kind {
            // Closed smooth curves, with fewer and more waves.
            0 => [50.0 * cos(t), 50.0 * sin(t), 15.0 * sin(3.0 * t)],
            1 | 2 => {
                let size = if kind == 1 { 8.0 } else { 50.0 };
                let z = (0..4).map(|k| wave[k] * sin(f64::from(k as u8 + 1) * t + wave[k + 4]));
                let r = 50.0 + 10.0 * wave[9] * cos(2.0 * t + wave[10]);
                [r * cos(t), r * sin(t), size * z.sum::<f64>()]
            }
            // On a cylinder.
            3 => bent(cos(t), sin(t) * (1.0 + 0.3 * wave[1] * cos(2.0 * t))),
            // Four sides on a cylinder, aligned, so that much is tied.
            4 | 5 => {
                let quarter = m.div_ceil(4);
                let (side, share) = (i / quarter, (i % quarter) as f64 / quarter as f64);
                let (u, v) = match side {
                    0 => (2.0 * share - 1.0, -1.0),
                    1 => (1.0, 2.0 * share - 1.0),
                    2 => (1.0 - 2.0 * share, 1.0),
                    _ => (-1.0, 1.0 - 2.0 * share),
                };
                if kind == 4 { bent(u, v) } else { [30.0 * u, 30.0 * v, 0.0] }
            }
            // Flat, on a grid.
            6 => {
                let r = 20.0 + 8.0 * wave[2] * cos(3.0 * t);
                [(r * cos(t)).round(), (r * sin(t)).round(), 0.0]
            }
            // Hopeless.
            _ => {
                let mut near = |x: f64| x + 6.0 * random.next();
                [near(40.0 * cos(t)), near(40.0 * sin(t)), near(0.0)]
            }
        }
    };
    let corners = random.below(4);
    let points: Vec<CurvePoint> = (0..m)
        .map(|i| {
            let [x, y, z] = at(i, &mut random);
            let is_corner = match corners {
                0 => false,
                1 => i % m.div_ceil(4) == 0,
                2 => random.below(m) < 3,
                _ => kind == 6,
            };
            CurvePoint { corner: is_corner, ..CurvePoint::smooth(Point3::new(x, y, z)) }
        })
        .collect();
    Boundary::new(vec![samples_from_points(&points)]).ok()
}
