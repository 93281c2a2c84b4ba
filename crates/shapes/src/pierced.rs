//! Random boundaries with holes. The outer loop runs counter-clockwise as seen from above, holes
//! run clockwise. Each generator returns `None` where the loops are no boundary.

use crate::random::Random;
use sheetwright::boundary::{Boundary, PlaneChoice, samples_from_points, supporting_plane};
use sheetwright::curve::{CurvePoint, Sample};
use sheetwright::math::{Point2, Point3, Vec3, cos, sin};
use sheetwright::predicate::signed_area_doubled;
use std::f64::consts::TAU;

/// The plane that [`plate`] and [`grid_plate`] always have: seen from above.
pub const FROM_ABOVE: PlaneChoice = PlaneChoice::Normal(Vec3::Z);

/// Tries for a hole before a plate is given up.
const THROWS: usize = 200;

/// A loop of points as samples; each is a corner with probability `corners`.
fn looped(random: &mut Random, points: &[Point3], corners: f64) -> Vec<Sample> {
    let points: Vec<CurvePoint> = points
        .iter()
        .map(|&at| CurvePoint { at, corner: random.unit() < corners, move_mm: 0.0 })
        .collect();
    samples_from_points(&points)
}

/// A star-shaped polygon about a point, counter-clockwise, each radius between `low` and `high`.
fn rays(random: &mut Random, middle: Point2, m: usize, [low, high]: [f64; 2]) -> Vec<Point2> {
    (0..m)
        .map(|i| {
            let angle = TAU * (i as f64 + random.between(0.0, 0.8)) / m as f64;
            let r = random.between(low, high);
            Point2::new(middle.x + r * cos(angle), middle.y + r * sin(angle))
        })
        .collect()
}

fn lifted(plan: &[Point2], mut height: impl FnMut(Point2) -> f64) -> Vec<Point3> {
    plan.iter().map(|&p| Point3::new(p.x, p.y, height(p))).collect()
}

/// The boundary of these loops, in either direction, if it has a supporting plane seen from above.
fn over_its_plan(random: &mut Random, loops: &[Vec<Point3>], corners: f64) -> Option<Boundary> {
    let loops: Vec<Vec<Sample>> = loops
        .iter()
        .enumerate()
        .map(|(n, points)| {
            let mut points = points.clone();
            let plan: Vec<Point2> = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
            if (signed_area_doubled(&plan) > 0.0) != (n == 0) {
                points.reverse();
            }
            looped(random, &points, corners)
        })
        .collect();
    let boundary = Boundary::new(loops).ok()?;
    supporting_plane(&boundary, FROM_ABOVE).is_ok().then_some(boundary)
}

/// A star-shaped outer loop of random heights with star-shaped holes beside one another: as many
/// samples a loop as `sizes` says, the outer one first. Seen from above it is a polygon with holes.
pub fn plate(random: &mut Random, sizes: &[usize], corners: f64) -> Option<Boundary> {
    let height = 40.0;
    let plan = rays(random, Point2::default(), sizes[0], [60.0, 100.0]);
    let mut loops = vec![lifted(&plan, |_| random.between(-height, height))];
    let largest = 60.0 / (sizes.len() as f64).sqrt();
    for &m in &sizes[1..] {
        let fits = (0..THROWS).find_map(|_| {
            let (angle, away) = (random.between(0.0, TAU), 75.0 * random.unit().sqrt());
            let middle = Point2::new(away * cos(angle), away * sin(angle));
            let r = random.between(0.2, 1.0) * largest;
            let plan = rays(random, middle, m, [0.4 * r, r]);
            loops.push(lifted(&plan, |_| random.between(-height, height)));
            let fits = over_its_plan(random, &loops, corners).is_some();
            let hole = loops.pop();
            if fits { hole } else { None }
        });
        loops.push(fits?);
    }
    over_its_plan(random, &loops, corners)
}

/// A smooth roof: the plate's plan on a finer scale, its heights those of one random quadratic
/// surface, so that it is nearly developable in places and folds nowhere.
pub fn roof(random: &mut Random, sizes: &[usize]) -> Option<Boundary> {
    let [a, b, c] = [0; 3].map(|_| random.between(-0.004, 0.004));
    let height = |p: Point2| a * p.x * p.x + b * p.x * p.y + c * p.y * p.y;
    let circle = |middle: Point2, m: usize, r: f64, wave: f64, phase: f64| -> Vec<Point3> {
        let plan: Vec<Point2> = (0..m)
            .map(|i| {
                let angle = TAU * i as f64 / m as f64;
                let r = r * (1.0 + wave * cos(3.0 * angle + phase));
                Point2::new(middle.x + r * cos(angle), middle.y + r * sin(angle))
            })
            .collect();
        lifted(&plan, height)
    };
    let (wave, phase) = (random.between(0.0, 0.15), random.between(0.0, TAU));
    let mut loops = vec![circle(Point2::default(), sizes[0], 100.0, wave, phase)];
    let largest = 50.0 / (sizes.len() as f64).sqrt();
    for &m in &sizes[1..] {
        let fits = (0..THROWS).find_map(|_| {
            let (angle, away) = (random.between(0.0, TAU), 75.0 * random.unit().sqrt());
            let middle = Point2::new(away * cos(angle), away * sin(angle));
            let r = random.between(0.3, 1.0) * largest;
            let (wave, phase) = (random.between(0.0, 0.2), random.between(0.0, TAU));
            loops.push(circle(middle, m, r, wave, phase));
            let fits = over_its_plan(random, &loops, 0.0).is_some();
            let hole = loops.pop();
            if fits { hole } else { None }
        });
        loops.push(fits?);
    }
    over_its_plan(random, &loops, 0.0)
}

/// A plate on a coarse grid, so that rungs and triangles tie, lie on lines, pass through samples
/// and run along tangents.
pub fn grid_plate(random: &mut Random, sizes: &[usize]) -> Option<Boundary> {
    let flat = random.unit() < 0.5;
    let snapped = |random: &mut Random, plan: &[Point2]| -> Vec<Point3> {
        plan.iter()
            .map(|p| {
                let z = if flat { 0.0 } else { random.below(3) as f64 };
                Point3::new(p.x.round(), p.y.round(), z)
            })
            .collect()
    };
    let plan = rays(random, Point2::default(), sizes[0], [4.0, 7.0]);
    let mut loops = vec![snapped(random, &plan)];
    for &m in &sizes[1..] {
        let fits = (0..THROWS).find_map(|_| {
            let middle = Point2::new(random.between(-4.0, 4.0), random.between(-4.0, 4.0));
            let plan = rays(random, middle, m, [0.7, 2.5]);
            loops.push(snapped(random, &plan));
            let fits = over_its_plan(random, &loops, 0.5).is_some();
            let hole = loops.pop();
            if fits { hole } else { None }
        });
        loops.push(fits?);
    }
    over_its_plan(random, &loops, 0.5)
}

/// A tube between two random star-shaped curves, one above the other and tilted: each projects onto
/// the other, so there is no plane seen from above. Few of them could be made of sheet.
pub fn tube(random: &mut Random, sizes: [usize; 2], corners: f64) -> Option<Boundary> {
    let rim = |random: &mut Random, m: usize, z: f64| {
        let plan = rays(random, Point2::default(), m, [50.0, 100.0]);
        let [along, across] = [0; 2].map(|_| random.between(-0.3, 0.3));
        lifted(&plan, |p| z + along * p.x + across * p.y + random.between(-15.0, 15.0))
    };
    let bottom = rim(random, sizes[0], 0.0);
    let mut top = rim(random, sizes[1], 130.0);
    top.reverse();
    let loops = [bottom, top].map(|points| looped(random, &points, corners));
    Boundary::new(loops.to_vec()).ok()
}

/// A pipe between two smooth closed curves, one above the other: about circles, waved, tilted and
/// moved aside.
pub fn pipe(random: &mut Random, sizes: [usize; 2]) -> Option<Boundary> {
    let mut rim = |m: usize, z: f64| -> Vec<Point3> {
        let [wave, phase] = [random.between(0.0, 0.1), random.between(0.0, TAU)];
        let [along, across] = [0; 2].map(|_| random.between(-0.2, 0.2));
        let [aside, ahead] = [0; 2].map(|_| random.between(-30.0, 30.0));
        let r = random.between(60.0, 100.0);
        (0..m)
            .map(|i| {
                let angle = TAU * i as f64 / m as f64;
                let r = r * (1.0 + wave * cos(2.0 * angle + phase));
                let (x, y) = (r * cos(angle), r * sin(angle));
                Point3::new(x + aside, y + ahead, z + along * x + across * y)
            })
            .collect()
    };
    let bottom = rim(sizes[0], 0.0);
    let mut top = rim(sizes[1], 130.0);
    top.reverse();
    let loops = [bottom, top].map(|points| looped(random, &points, 0.0));
    Boundary::new(loops.to_vec()).ok()
}

/// A tube whose two loops of m samples are one in the plan: every wall between them stands upright.
pub fn upright_tube(random: &mut Random, m: usize, corners: f64) -> Option<Boundary> {
    let plan = rays(random, Point2::default(), m, [50.0, 100.0]);
    let bottom = lifted(&plan, |_| 0.0);
    let mut top = lifted(&plan, |_| 90.0);
    top.reverse();
    let loops = [bottom, top].map(|points| looped(random, &points, corners));
    Boundary::new(loops.to_vec()).ok()
}

/// Loops through random points of a cube: mostly knotted about themselves and one another.
pub fn tangled_loops(random: &mut Random, sizes: &[usize], corners: f64) -> Option<Boundary> {
    let anywhere = |random: &mut Random| {
        Point3::new(random.unit() * 100.0, random.unit() * 100.0, random.unit() * 100.0)
    };
    let loops = sizes
        .iter()
        .map(|&m| {
            let points: Vec<Point3> = (0..m).map(|_| anywhere(random)).collect();
            looped(random, &points, corners)
        })
        .collect();
    Boundary::new(loops).ok()
}
