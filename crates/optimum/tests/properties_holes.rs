//! Properties of every boundary with holes, tested on random ones.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::surface::Connectivity;
use sheetwright_geometry::boundary::{Boundary, PlaneChoice, supporting_plane};
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{Point3, Vec3, from_deg, turned, unit};
use sheetwright_geometry::predicate::{orientation, segments_touch, signed_area_doubled};
use sheetwright_geometry::watch::{Unwatched, Watch};
use sheetwright_optimum::cost::{DEFAULT_FOLD, PriceOptions, QUANTUM};
use sheetwright_optimum::triangulate::{
    Goal, Method, TriangulateError, TriangulateOptions, Triangulation, triangulate,
    with_holes_facing,
};
use sheetwright_shapes::domain::fault;
use sheetwright_shapes::pierced::{
    FROM_ABOVE, grid_plate, pipe, plate, roof, tangled_loops, tube, upright_tube,
};
use sheetwright_shapes::random::Random;

/// A random boundary of 30 to 120 samples with one to four holes, or about 50 where there is no
/// plane to bound the search, and whether it has a plane seen from above.
fn boundary(seed: u64) -> Option<(Boundary, bool)> {
    let random = &mut Random::new(31_000 + seed);
    let holes = 1 + (seed / KINDS % 4) as usize;
    let all = 30 + random.below(91);
    let hole = 4 + random.below((all / (2 * holes)).max(5) - 4);
    let mut sizes = vec![all - holes * hole];
    sizes.extend(vec![hole; holes]);
    match seed % KINDS {
        0 | 1 => roof(random, &sizes).map(|b| (b, true)),
        2 => plate(random, &sizes, 0.0).map(|b| (b, true)),
        3 => plate(random, &sizes, 0.2).map(|b| (b, true)),
        GRID => grid_plate(random, &[20, 8, 6]).map(|b| (b, true)),
        5 => pipe(random, [all / 2, all - all / 2]).map(|b| (b, false)),
        6 => tube(random, [20, 16], 0.1).map(|b| (b, false)),
        UPRIGHT => upright_tube(random, 18, 0.0).map(|b| (b, false)),
        _ => tangled_loops(random, &[9, 7], 0.1).map(|b| (b, false)),
    }
}

const KINDS: u64 = 9;
const GRID: u64 = 4;
const UPRIGHT: u64 = 7;

fn boundaries(seeds: u64) -> impl Iterator<Item = (u64, Boundary, PlaneChoice)> {
    (0..seeds).filter_map(|seed| {
        let (boundary, has_plane) = boundary(seed)?;
        // Most plates over their plane; some without, though it would help.
        let few = boundary.len() < 60 && boundary.holes() < 3;
        let without = !has_plane || (few && seed % 5 == 0);
        let choice = if without { PlaneChoice::None } else { FROM_ABOVE };
        Some((seed, boundary, choice))
    })
}

fn solve(boundary: &Boundary, choice: PlaneChoice, fold: f64) -> Triangulation {
    let plane = supporting_plane(boundary, choice).unwrap();
    let price = PriceOptions { fold, ..Default::default() };
    let options = TriangulateOptions { price, ..Default::default() };
    triangulate(boundary, plane.as_ref(), &options, &mut Unwatched).unwrap()
}

fn loops(boundary: &Boundary) -> Vec<Vec<Sample>> {
    boundary.loops().iter().map(|l| boundary.samples()[l.clone()].to_vec()).collect()
}

#[test]
fn every_result_is_a_triangulation_of_its_domain() {
    let (mut made, mut rings, mut proven) = (0, 0, 0);
    for (seed, boundary, choice) in boundaries(KINDS * 12) {
        let found = solve(&boundary, choice, DEFAULT_FOLD);
        let (m, h) = (boundary.len(), boundary.holes());
        assert_eq!(found.triangles.len(), m + 2 * h - 2, "{seed}");
        assert_eq!(found.rungs.len(), m + 3 * h - 3, "{seed}");
        let triangles: Vec<[usize; 3]> =
            found.triangles.iter().map(|t| t.map(SampleIndex::get)).collect();
        assert_eq!(fault(boundary.loops(), &triangles), None, "{seed}");
        let connectivity = Connectivity::new(boundary.loops(), found.triangles.clone()).unwrap();
        assert!(
            connectivity.hinges().iter().map(|hinge| hinge.rung).eq(found.rungs.iter().copied())
        );
        assert!(found.lower_bound <= found.price, "{seed}");
        assert!(!found.proven_optimal || found.lower_bound == found.price, "{seed}");
        made += 1;
        rings += usize::from(h == 1);
        proven += usize::from(found.proven_optimal);
        assert!(h > 1 || found.proven_optimal, "{seed}: a ring is solved exactly");
        if choice == FROM_ABOVE {
            lies_in_its_plan(&boundary, &found, seed);
        }
    }
    println!("{made} made, {rings} of them rings, {proven} proven optimal");
    assert!(made > 90 && rings > 20, "{made} {rings}");
}

/// Over a plane, triangles face up and fill the plan, and no rung touches the boundary.
fn lies_in_its_plan(boundary: &Boundary, found: &Triangulation, seed: u64) {
    let plan = supporting_plane(boundary, FROM_ABOVE).unwrap().unwrap().projected;
    let mut area = 0.0;
    for triangle in &found.triangles {
        let [a, b, c] = triangle.map(|s| plan[s.get()]);
        assert!(orientation(a, b, c).is_gt(), "{seed}: {triangle:?}");
        area += (b - a).perp_dot(c - a);
    }
    // Holes run clockwise and count negative.
    let wanted: f64 = boundary.loops().iter().map(|l| signed_area_doubled(&plan[l.clone()])).sum();
    assert!((area - wanted).abs() < 1e-9 * wanted, "{seed}: {area} {wanted}");
    for rung in &found.rungs {
        let [a, b] = rung.ends().map(SampleIndex::get);
        for i in 0..boundary.len() {
            let j = boundary.next(i);
            if ![a, b].contains(&i) && ![a, b].contains(&j) {
                assert!(!segments_touch(plan[a], plan[b], plan[i], plan[j]), "{seed}: {rung}");
            }
        }
    }
}

#[test]
fn the_answer_is_the_same_bits_every_time() {
    for (seed, boundary, choice) in boundaries(KINDS * 3) {
        let runs = [0, 1].map(|_| solve(&boundary, choice, DEFAULT_FOLD));
        assert_eq!(runs[0], runs[1], "{seed}");
        assert_eq!(runs[0].price.to_bits(), runs[1].price.to_bits(), "{seed}");
        assert_eq!(runs[0].lower_bound.to_bits(), runs[1].lower_bound.to_bits(), "{seed}");
    }
}

/// Compares two results for one boundary, given in two ways: their prices are equal if both are
/// proven, and neither is below the other's bound. `slack` is the allowed difference of prices.
fn agree(first: &Triangulation, second: &Triangulation, slack: f64, case: &str) {
    assert!(
        first.lower_bound <= second.price + slack,
        "{case}: {} {}",
        first.lower_bound,
        second.price
    );
    assert!(
        second.lower_bound <= first.price + slack,
        "{case}: {} {}",
        second.lower_bound,
        first.price
    );
    if first.proven_optimal && second.proven_optimal {
        let (a, b) = (first.price, second.price);
        assert!((a - b).abs() <= slack, "{case}: {a} {b}, {} apart", a - b);
    }
}

/// The surface does not depend on where loops begin or on the order of holes, except for rounding:
/// the first corner of a triangle changes the last bit of its price, and that may move it by a
/// quantum. The twist of rungs between smooth samples has no such order, so without the fold price
/// the sum is equal to the last bit.
#[test]
fn loops_may_begin_anywhere_and_holes_come_in_any_order() {
    let mut exact = 0;
    for (seed, boundary, choice) in boundaries(KINDS * 5) {
        let mut rotated = loops(&boundary);
        for (n, of_loop) in rotated.iter_mut().enumerate() {
            let by = 1 + (seed as usize + 3 * n) % (of_loop.len() - 1);
            of_loop.rotate_left(by);
        }
        let mut reordered = rotated.clone();
        reordered[1..].reverse();
        let smooth = boundary.samples().iter().all(|s| !s.is_corner());
        for fold in [0.0, DEFAULT_FOLD] {
            let first = solve(&boundary, choice, fold);
            let prices = (first.triangles.len() + first.rungs.len()) as f64;
            let is_exact = fold == 0.0 && smooth && choice == FROM_ABOVE;
            let slack = if is_exact { 0.0 } else { prices * QUANTUM };
            for other in [&rotated, &reordered] {
                let other = Boundary::new(other.clone()).unwrap();
                let second = solve(&other, choice, fold);
                agree(&first, &second, slack, &format!("{seed} {choice:?} {fold}"));
                exact += usize::from(is_exact && first.proven_optimal && second.proven_optimal);
            }
        }
    }
    assert!(exact > 5, "{exact}");
}

/// The surface does not depend on the place, the rotation and the size of the boundary, except for
/// rounding.
#[test]
fn the_surface_may_be_turned_moved_and_scaled() {
    let axis = unit(Vec3::new(1.0, -2.0, 0.7)).unwrap();
    for (seed, boundary, choice) in boundaries(KINDS * 5) {
        let turn = |v: Vec3| turned(v, axis, from_deg(40.0 + seed as f64));
        let place =
            |p: Point3| Point3::from_vec(turn(p.to_vec()) * 3.7 + Vec3::new(50.0, 9.0, -7.0));
        let mut placed = loops(&boundary);
        for sample in placed.iter_mut().flatten() {
            *sample = Sample {
                position: place(sample.position),
                tangent_in: turn(sample.tangent_in),
                tangent_out: turn(sample.tangent_out),
            };
        }
        let placed = Boundary::new(placed).unwrap();
        let placed_choice = match choice {
            PlaneChoice::Normal(normal) => PlaneChoice::Normal(turn(normal)),
            other => other,
        };
        // On a grid, samples that lie on a line exactly no longer do once they are turned, so that
        // other rungs are inside the plan or parallel to a tangent. Upright walls stand at right
        // angles to the area vector, which decides the sign of a normal that is open at both ends.
        if [GRID, UPRIGHT].contains(&(seed % KINDS)) {
            continue;
        }
        let first = solve(&boundary, choice, DEFAULT_FOLD);
        let second = solve(&placed, placed_choice, DEFAULT_FOLD);
        agree(&first, &second, 1e-9 * first.price.max(1.0), &format!("{seed} {choice:?}"));
    }
}

/// Holes are turned to run the other way round than the outer loop, in whichever direction they
/// were drawn.
#[test]
fn holes_may_be_drawn_either_way() {
    for (seed, boundary, choice) in boundaries(KINDS * 4) {
        if choice != FROM_ABOVE {
            continue;
        }
        let options = TriangulateOptions::default();
        let facing = |boundary: &Boundary| {
            let plane = supporting_plane(boundary, choice).unwrap();
            with_holes_facing(boundary, plane.as_ref(), &options, &mut Unwatched).unwrap()
        };
        assert!(facing(&boundary) == boundary, "{seed}");
        for hole in 1..=boundary.holes() {
            assert!(facing(&boundary.with_hole_turned(hole)) == boundary, "{seed}");
        }
    }
}

/// A tube between two circles is a tube however its ends are drawn.
#[test]
fn tubes_may_be_drawn_either_way() {
    for seed in 0..6 {
        let boundary = pipe(&mut Random::new(seed), [12, 14]).unwrap();
        let options = TriangulateOptions::default();
        let wrong = boundary.with_hole_turned(1);
        for drawn in [&boundary, &wrong] {
            let facing = with_holes_facing(drawn, None, &options, &mut Unwatched).unwrap();
            assert!(facing == boundary, "{seed}");
        }
    }
}

#[test]
fn only_the_optimal_method_takes_holes() {
    let (boundary, _) = boundary(0).unwrap();
    for method in [Method::Bridge, Method::Rails { first: 10 }] {
        let options = TriangulateOptions { method, ..Default::default() };
        let refused = triangulate(&boundary, None, &options, &mut Unwatched);
        assert_eq!(refused, Err(TriangulateError::Holes { count: boundary.holes() }));
    }
    let options = TriangulateOptions { goal: Goal::WorstWarp, ..Default::default() };
    let refused = triangulate(&boundary, None, &options, &mut Unwatched);
    assert_eq!(refused, Err(TriangulateError::GoalWithHoles { count: boundary.holes() }));
    let options = TriangulateOptions { memory_limit: 10_000, ..Default::default() };
    let refused = triangulate(&boundary, None, &options, &mut Unwatched);
    assert!(matches!(refused, Err(TriangulateError::TooLarge { limit: 10_000, .. })));
}

/// Records progress, and stops after it was asked so often.
struct Impatient {
    seen: Vec<f64>,
    patience: std::cell::Cell<usize>,
}

impl Impatient {
    fn new(patience: usize) -> Self {
        Self { seen: vec![], patience: patience.into() }
    }
}

impl Watch for Impatient {
    fn progress(&mut self, done: f64) {
        self.seen.push(done);
    }
    fn stop(&self) -> bool {
        let left = self.patience.get();
        self.patience.set(left.saturating_sub(1));
        left == 0
    }
}

/// A ring over a plane, two holes over a plane, a pipe.
fn watched() -> [(Boundary, PlaneChoice); 3] {
    [
        (roof(&mut Random::new(5), &[60, 30]).unwrap(), FROM_ABOVE),
        (roof(&mut Random::new(6), &[40, 20, 20]).unwrap(), FROM_ABOVE),
        (pipe(&mut Random::new(7), [60, 60]).unwrap(), PlaneChoice::None),
    ]
}

#[test]
fn the_watcher_may_stop() {
    for (boundary, choice) in watched() {
        let plane = supporting_plane(&boundary, choice).unwrap();
        let options = TriangulateOptions::default();
        let run =
            |watcher: &mut Impatient| triangulate(&boundary, plane.as_ref(), &options, watcher);
        let mut patient = Impatient::new(usize::MAX);
        assert!(run(&mut patient).is_ok());
        let asked = usize::MAX - patient.patience.get();
        for patience in [0, 5, asked / 2, asked - 1] {
            let stopped = run(&mut Impatient::new(patience));
            assert_eq!(stopped, Err(TriangulateError::Stopped), "{patience} of {asked}");
        }
    }
}

#[test]
fn the_watcher_sees_progress() {
    for (boundary, choice) in watched() {
        let plane = supporting_plane(&boundary, choice).unwrap();
        let mut patient = Impatient::new(usize::MAX);
        let options = TriangulateOptions::default();
        assert!(triangulate(&boundary, plane.as_ref(), &options, &mut patient).is_ok());
        let seen = patient.seen;
        assert!(seen.len() > 5 && seen.windows(2).all(|w| w[0] <= w[1]), "{}", seen.len());
        assert!(seen.iter().all(|done| (0.0..=1.0).contains(done)));
    }
}
