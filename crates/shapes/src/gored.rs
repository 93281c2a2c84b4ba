//! The area and length that gores lose of a sphere: they bend one way only, and a sphere bends two.

use sheetwright::make::{Found, Part, make};
use sheetwright::math::Point3;
use sheetwright::measure::area_flat;
use sheetwright::template::{Value, template};
use sheetwright::watch::Unwatched;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How a hemisphere in gores differs from the hemisphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// How many gores there are.
    pub gores: usize,
    /// The area of all flat gores, mm².
    pub area_mm2: f64,
    /// The area that they lose, as a share of the hemisphere's area.
    pub area_lost: f64,
    /// The largest loss of length of a flat gore against an arc of the sphere, as a share of the
    /// arc: of the circle of latitude between its rails, at any height, or of the meridian midway.
    pub length_lost: f64,
    /// The largest distance of the surface from the sphere, as a share of the radius.
    pub off_sphere: f64,
}

/// The loss of `gores` gores of the template `dome` against a hemisphere of this radius, mm.
pub fn loss(gores: usize, radius: f64) -> Loss {
    let dome = template("dome").expect("the catalogue has domes");
    let mut values = dome.defaults();
    for (name, value) in [("diameter", 2.0 * radius), ("height", radius), ("gores", gores as f64)] {
        values.set(name, Value::Number(value)).expect("the dome takes it");
    }
    let mut design = values.design().expect("a hemisphere is drawn");
    // All gores are one, turned.
    design.panels.truncate(1);
    let made = make(&design, &mut Unwatched).expect("a gore is made");
    let gore = &made.parts[0];
    let area_mm2 = gores as f64 * area_flat(&gore.sheet, &gore.flat);
    let area = TAU * radius * radius;
    Loss {
        gores,
        area_mm2,
        area_lost: (area - area_mm2) / area,
        length_lost: length_lost(gore, gores, radius),
        off_sphere: off_sphere(gore, radius),
    }
}

/// Pairs of samples at one height, the first on the first rail, from the foot up; both rails share
/// the pole.
fn level_pairs(gore: &Part) -> Vec<[usize; 2]> {
    let positions = found(gore).boundary.positions();
    let m = positions.len();
    let first_is_low = positions[0].z < positions[m / 2].z;
    assert!(first_is_low && m % 2 == 1, "rails from the foot to a shared pole");
    (0..m / 2).map(|i| [i, m - 1 - i]).collect()
}

fn found(gore: &Part) -> &Found {
    gore.found().expect("a gore is bounded by curves")
}

fn length_lost(gore: &Part, gores: usize, radius: f64) -> f64 {
    let (space, flat) = (found(gore).boundary.positions(), &gore.flat.points);
    let pairs = level_pairs(gore);
    let widths = pairs.iter().map(|&[a, b]| {
        assert!((space[a].z - space[b].z).abs() < 1e-9 * radius);
        let around = (space[a].x * space[a].x + space[a].y * space[a].y).sqrt();
        let arc = TAU / gores as f64 * around;
        (arc - flat[a].distance(flat[b])) / arc
    });
    let pole = flat[pairs.len()];
    let [a, b] = pairs[0];
    let meridian = FRAC_PI_2 * radius;
    let midway = (meridian - pole.distance(flat[a].lerp(flat[b], 0.5))) / meridian;
    widths.fold(midway, f64::max)
}

fn off_sphere(gore: &Part, radius: f64) -> f64 {
    let space = found(gore).boundary.positions();
    let off = |p: Point3| (p.to_vec().length() / radius - 1.0).abs();
    // A triangle of points on a sphere is farthest from it inside; a gore is so at its level rungs.
    let middles = level_pairs(gore).into_iter().map(|[a, b]| off(space[a].lerp(space[b], 0.5)));
    let inside = found(gore).surface.connectivity().triangles().iter().map(|corners| {
        let [a, b, c] = corners.map(|s| space[s.get()]);
        off(a + ((b - a) + (c - a)) * (1.0 / 3.0))
    });
    middles.chain(inside).fold(0.0, f64::max)
}

/// The theoretical losses of n gores that are pieces of cylinders: the shares of area, of length
/// and of the radius, each to the leading order in 1/n.
pub fn expected(gores: usize) -> [f64; 3] {
    let square = (PI / gores as f64) * (PI / gores as f64);
    // A gore's middle is a quarter of an ellipse with the half axes R cos(π/n) and R, which is a
    // quarter shorter than R is; its width is a chord, a sixth shorter than its arc; its area is
    // the integral of the two along it, a third.
    [square / 3.0, square / 4.0, square / 2.0]
}
