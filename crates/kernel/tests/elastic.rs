//! The elastic sheet against theory: a cylinder's energy, a twisted strip's compression, and
//! strains that settle as the net becomes finer.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::elastic::{Edges, Elastic, ElasticOptions, Stiffness, elastic, elastic_on};
use sheetwright::flatten::{Flattened, lay_flat};
use sheetwright::index::SampleIndex;
use sheetwright::math::{Point2, Point3, cos, sin};
use sheetwright::sheet::Sheet;
use sheetwright::surface::{Connectivity, Surface};
use sheetwright::watch::Unwatched;
use std::f64::consts::{FRAC_PI_2, PI};

/// A strip of quadrilaterals between two rails of as many points, each divided into triangles.
fn strip(low: Vec<Point3>, high: Vec<Point3>) -> Surface {
    let n = low.len();
    let top = |i: usize| 2 * n - 1 - i;
    let triangles = (0..n - 1)
        .flat_map(|i| [[i, i + 1, top(i)], [i + 1, top(i + 1), top(i)]])
        .map(|t| t.map(SampleIndex::new))
        .collect();
    let positions: Vec<Point3> = low.into_iter().chain(high.into_iter().rev()).collect();
    Surface::new(
        Connectivity::new(std::slice::from_ref(&(0..2 * n)), triangles).unwrap(),
        positions,
    )
}

fn at_rest(surface: &Surface, stiffness: Stiffness, triangles: usize) -> Elastic {
    let (sheet, flat) = lay_flat(surface, &[], &mut Unwatched).unwrap();
    let options = ElasticOptions { triangles, ..ElasticOptions::default() };
    elastic(&sheet, &flat, stiffness, &options, &mut Unwatched).unwrap()
}

/// Steel of a thickness, mm, as if it had this Poisson's number.
fn steel(thickness_mm: f64, poisson: f64) -> Stiffness {
    Stiffness::new(thickness_mm, 210_000.0, poisson)
}

/// A piece of a cylinder of this radius and height, mm, over this angle, radians.
fn cylinder(radius: f64, height: f64, turn: f64) -> Surface {
    frustum([radius; 2], height, turn)
}

/// A piece of a frustum between circles of these radii, mm, over this angle, radians.
fn frustum(radii: [f64; 2], height: f64, turn: f64) -> Surface {
    let rail = |radius: f64, z: f64| -> Vec<Point3> {
        let at = |i: usize| {
            let a = turn * i as f64 / 199.0;
            Point3::new(radius * cos(a), radius * sin(a), z)
        };
        (0..200).map(at).collect()
    };
    let [low, high] = radii;
    strip(rail(low, 0.0), rail(high, height))
}

#[test]
fn a_cylinder_has_the_energy_of_theory_and_hardly_stretches() {
    let (radius, height, thickness_mm) = (400.0, 300.0, 0.5);
    let plate = steel(thickness_mm, 0.0);
    for turn in [FRAC_PI_2, PI] {
        let surface = cylinder(radius, height, turn);
        let arc = turn * radius;
        let theory = 0.5 * plate.bending_n_mm / (radius * radius) * arc * height;
        // The straight edges are free to turn, and beside them the sheet bends less: like a beam
        // on an elastic ground, at each edge by at most what a length of √(t R) / ⁴√3 would store.
        let least = 1.0 - 2.0 * (thickness_mm * radius).sqrt() / 3_f64.sqrt().sqrt() / arc;
        let mut strains = Vec::new();
        for triangles in [350, 1400] {
            let found = at_rest(&surface, plate, triangles);
            let energy = found.bending_n_mm + found.stretching_n_mm;
            let share = energy / theory;
            assert!((least..1.005).contains(&share), "{share}");
            // Over half a turn, both edges together store little of the whole.
            assert!(turn < PI || (share - 1.0).abs() < 0.025, "{share}");
            assert!(found.is_stable);
            strains.push(found.strain_at(0.95));
            let curvature = found.curvature_at(0.5) * radius;
            assert!((curvature - 1.0).abs() < 0.05, "{curvature}");
        }
        // Theory has up to 0.11 t / 2R beside straight edges.
        let bound = 0.15 * 0.5 * thickness_mm / radius;
        assert!(strains.iter().all(|&strain| strain < bound), "{strains:?}");
    }
}

#[test]
fn a_plate_that_is_pressed_together_buckles_the_same_way_each_time() {
    // A square that is held 0.2 % shorter one way: sixty times what a plate of 1 mm bears flat.
    let (side, share) = (300.0, 0.998);
    let line = |y: f64| -> Vec<Point3> {
        (0..40).map(|i| Point3::new(share * side * i as f64 / 39.0, y, 0.0)).collect()
    };
    let pressed = Sheet::whole(&strip(line(0.0), line(side)));
    let points = pressed.mesh().positions().iter().map(|p| Point2::new(p.x / share, p.y));
    let flat = Flattened { points: points.collect(), overlap: None };
    let options = ElasticOptions::default();
    let found = || elastic(&pressed, &flat, steel(1.0, 0.3), &options, &mut Unwatched).unwrap();
    let buckled = found();
    assert!(buckled.is_stable && buckled.distance_max_mm > 2.0, "{}", buckled.distance_max_mm);
    // Flat, it would bear the whole of it.
    let flat_n_mm = 0.5 * 210_000.0 / (1.0 - 0.09) * 0.002 * 0.002 * side * side;
    assert!(buckled.stretching_n_mm + buckled.bending_n_mm < 0.5 * flat_n_mm);
    assert_eq!(found(), buckled);
}

#[test]
fn a_pattern_that_is_too_small_is_fitted_to_its_sheet() {
    // A plate whose pattern is 0.2 % too short one way and 0.1 % the other.
    let line = |y: f64| (0..40).map(|i| Point3::new(300.0 * i as f64 / 39.0, y, 0.0)).collect();
    let plate = Sheet::whole(&strip(line(0.0), line(200.0)));
    let points = plate.mesh().positions().iter().map(|p| Point2::new(0.998 * p.x, 0.999 * p.y));
    let flat = Flattened { points: points.collect(), overlap: None };
    let found = |fits: usize| {
        let options = ElasticOptions { fits, fitted: 1e-6, ..ElasticOptions::default() };
        elastic(&plate, &flat, steel(1.0, 0.3), &options, &mut Unwatched).unwrap()
    };
    let strained = found(0).strain();
    assert!((strained / 0.002 - 1.0).abs() < 0.01, "{strained}");
    let fitted = found(3);
    assert!(fitted.strain() < 1e-5, "{}", fitted.strain());
    let far = |way: f64| fitted.moves.iter().map(|m| m.length()).fold(way, f64::max);
    assert!((0.2..0.5).contains(&far(0.0)), "{}", far(0.0));
}

/// A strip whose rails lie on a helicoid: `turn` radians in all.
fn helicoid(length: f64, width: f64, turn: f64) -> Surface {
    let rail = |side: f64| -> Vec<Point3> {
        let at = |i: usize| {
            let share = i as f64 / 299.0;
            let a = turn * share;
            Point3::new(length * share, 0.5 * side * width * cos(a), 0.5 * side * width * sin(a))
        };
        (0..300).map(at).collect()
    };
    strip(rail(-1.0), rail(1.0))
}

#[test]
fn a_twisted_plate_is_pressed_in_the_middle_as_theory_says() {
    // Thick enough not to buckle: the edges are longer than the middle by ω²/8.
    let (length, width, turn) = (1200.0, 300.0, 0.35);
    let omega = turn * width / length;
    let found = at_rest(&helicoid(length, width, turn), steel(30.0, 0.0), 1400);
    let middle = (0..found.triangles.len()).filter(|&n| {
        let [a, b, c] = found.triangles[n].map(|v| found.flat[v]);
        let (x, y) = ((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0);
        (x - 0.5 * length).abs() < 0.2 * length && (y - 0.5 * width).abs() < 0.05 * width
    });
    let strains: Vec<f64> = middle.map(|n| found.strains[n]).collect();
    let mean = strains.iter().sum::<f64>() / strains.len() as f64;
    assert!((mean / (omega * omega / 8.0) - 1.0).abs() < 0.01, "{mean}");
}

#[test]
fn a_twisted_plate_whose_edges_slide_is_strained_as_a_free_one() {
    // Along lines of the strip, by the lengths on a helicoid and no force along it in all: −ω²/24
    // in the middle, +ω²/12 at the edges.
    let (length, width, turn) = (1200.0, 300.0, 0.35);
    let omega = turn * width / length;
    let surface = helicoid(length, width, turn);
    let (sheet, flat) = lay_flat(&surface, &[], &mut Unwatched).unwrap();
    let last = surface.positions().len() - 1;
    let end = |a: usize, b: usize| [a, b].map(SampleIndex::new);
    let edges = Edges::sliding(&sheet, &[end(last / 2, last / 2 + 1), end(last, 0)]);
    let options = ElasticOptions { triangles: 1400, ..ElasticOptions::default() };
    let plate = steel(30.0, 0.0);
    let found = elastic_on(&edges, &sheet, &flat, plate, &options, &mut Unwatched).unwrap();
    assert!(found.is_stable);
    let mean_strain = |low: f64, high: f64| {
        let within = (0..found.triangles.len()).filter(|&n| {
            let [a, b, c] = found.triangles[n].map(|v| found.flat[v]);
            let (x, y) = ((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0);
            let off = (y / width - 0.5).abs();
            (x - 0.5 * length).abs() < 0.2 * length && (low..high).contains(&off)
        });
        let strains: Vec<f64> = within.map(|n| found.strains[n]).collect();
        strains.iter().sum::<f64>() / strains.len() as f64
    };
    let by = omega * omega;
    let (middle, edge) = (mean_strain(0.0, 0.05), mean_strain(0.45, 0.5));
    // Over the outermost twentieth, (y² / 2 − 1 / 24) ω² is 0.855 of that at the edge.
    assert!((middle / (by / 24.0) - 1.0).abs() < 0.05, "{middle}");
    assert!((edge / (by / 12.0) / 0.855 - 1.0).abs() < 0.1, "{edge}");
    // Where the edges are held, 95 % of the area stays below nearly half as much again.
    let held = elastic(&sheet, &flat, plate, &options, &mut Unwatched).unwrap();
    assert!(held.strain() > 1.4 * found.strain());
}

#[test]
fn a_sheet_far_away_is_strained_as_one_at_the_origin() {
    // By whole powers of two, so that rounding loses nothing of where it lies.
    let (grid, far) = (1.0 / f64::from(1 << 20), f64::from(1 << 25));
    let round = |x: f64| (x / grid).round() * grid;
    let wound = helicoid(800.0, 200.0, 0.4);
    let at = |far: f64| {
        let points = wound.positions().iter();
        let points = points.map(|p| Point3::new(round(p.x) + far, round(p.y) - far, round(p.z)));
        at_rest(&Surface::new(wound.connectivity().clone(), points.collect()), steel(1.0, 0.3), 350)
    };
    let (here, there) = (at(0.0), at(far));
    assert_eq!(here.flat, there.flat);
    let share = there.strain_at(0.95) / here.strain_at(0.95);
    assert!((share - 1.0).abs() < 1e-6, "{share}");
    let moved = there.positions.iter().zip(&here.positions);
    assert!(moved.clone().all(|(b, a)| (b.x - far - a.x).abs() < 1e-3), "{moved:?}");
}

#[test]
fn strains_converge_on_a_cylinder_a_cone_and_a_helicoid() {
    // Thick enough for the net to show the strip beside the edges that is strained, √(t R) wide.
    let plate = steel(5.0, 0.3);
    for (name, surface) in [
        ("cylinder", cylinder(400.0, 300.0, FRAC_PI_2)),
        ("cone", frustum([450.0, 250.0], 300.0, FRAC_PI_2)),
        ("helicoid", helicoid(1200.0, 300.0, 0.35)),
    ] {
        let [coarse, fine, finest] = [200, 500, 1250].map(|n| at_rest(&surface, plate, n).strain());
        let [first, second] = [(fine - coarse).abs(), (finest - fine).abs()];
        assert!(second < first, "{name}: {coarse} {fine} {finest}");
        assert!(second < 0.05 * finest, "{name}: {coarse} {fine} {finest}");
    }
}

#[test]
fn strains_settle_as_the_net_becomes_finer() {
    let wavy = |z: f64, phase: f64| -> Vec<Point3> {
        let at = |i: usize| {
            let x = 1000.0 * i as f64 / 199.0;
            Point3::new(x, 40.0 * sin(0.0063 * x + phase), z)
        };
        (0..200).map(at).collect()
    };
    let surface = strip(wavy(0.0, 0.0), wavy(250.0, 0.35));
    let plate = steel(1.0, 0.3);
    let [coarse, fine, finest] =
        [350, 1000, 2800].map(|n| at_rest(&surface, plate, n).strain_at(0.95));
    assert!((coarse / finest - 1.0).abs() < 0.5, "{coarse} {finest}");
    assert!((fine / finest - 1.0).abs() < 0.25, "{fine} {finest}");
}
