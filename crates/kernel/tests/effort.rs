//! A search with holes ends with the work that it may do, and answers with what it has found by
//! then.
#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::boundary::{Boundary, PlaneChoice, samples_from_points, supporting_plane};
use sheetwright::check::{FindingKind, Remedy};
use sheetwright::cost::PriceOptions;
use sheetwright::curve::CurvePoint;
use sheetwright::design::{Design, DesignCurve, DesignPanel, PanelShape};
use sheetwright::index::SampleIndex;
use sheetwright::make::make;
use sheetwright::math::{Point3, cos, sin};
use sheetwright::triangulate::{
    DEFAULT_WORK, TriangulateOptions, Triangulation, triangulate, with_holes_facing,
};
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::domain::fault;
use sheetwright_shapes::pierced::{FROM_ABOVE, plate, tangled_loops, tube};
use sheetwright_shapes::random::Random;
use std::f64::consts::TAU;

/// A square plate of 1,000 mm of `m` samples, with `side` times `side` round holes of `k` samples.
fn pierced(m: usize, side: usize, k: usize, height: impl Fn(f64, f64) -> f64) -> Boundary {
    let at = |x: f64, y: f64| CurvePoint::smooth(Point3::new(x, y, height(x, y)));
    let outer = (0..m).map(|i| {
        let t = 4.0 * i as f64 / m as f64;
        let (edge, u) = (t as usize, 1000.0 * (t - t.floor()));
        let [x, y] = [[u, 0.0], [1000.0, u], [1000.0 - u, 1000.0], [0.0, 1000.0 - u]][edge];
        at(x, y)
    });
    let mut loops: Vec<Vec<CurvePoint>> = vec![outer.collect()];
    let cell = 1000.0 / side as f64;
    for n in 0..side * side {
        let [x, y] = [n % side, n / side].map(|n| (n as f64 + 0.5) * cell);
        let around = (0..k).map(|i| TAU * i as f64 / k as f64);
        loops.push(around.map(|t| at(x + 0.3 * cell * cos(t), y - 0.3 * cell * sin(t))).collect());
    }
    Boundary::new(loops.iter().map(|points| samples_from_points(points)).collect()).unwrap()
}

fn wave(x: f64, y: f64) -> f64 {
    60.0 * sin(x / 120.0) * cos(y / 90.0)
}

/// Curves that are far from the edges of a sheet: over a plane and without, one hole and several.
fn far_from_developable() -> Vec<(&'static str, Boundary, PlaneChoice)> {
    vec![
        ("wavy ring", pierced(120, 1, 80, wave), FROM_ABOVE),
        ("wavy plate", pierced(80, 2, 24, wave), FROM_ABOVE),
        ("roof", plate(&mut Random::new(3), &[40, 20, 20], 0.2).unwrap(), FROM_ABOVE),
        ("wavy ring, no plane", pierced(40, 1, 24, wave), PlaneChoice::None),
        ("tube", tube(&mut Random::new(4), [40, 40], 0.1).unwrap(), PlaneChoice::None),
        ("wavy plate, no plane", pierced(40, 2, 8, wave), PlaneChoice::None),
        (
            "tangle",
            tangled_loops(&mut Random::new(5), &[24, 20, 16], 0.1).unwrap(),
            PlaneChoice::None,
        ),
    ]
}

fn solved(boundary: &Boundary, choice: PlaneChoice, work_limit: u64) -> Triangulation {
    let plane = supporting_plane(boundary, choice).unwrap();
    let options = TriangulateOptions { work_limit, ..Default::default() };
    triangulate(boundary, plane.as_ref(), &options, &mut Unwatched).unwrap()
}

#[test]
fn a_search_ends_with_the_work_that_it_may_do() {
    let mut cut_short = 0;
    for (name, boundary, choice) in far_from_developable() {
        // What a first answer takes, which there is in any case.
        let first = solved(&boundary, choice, 0);
        for limit in [0, 100_000, 1_000_000, 10_000_000, 100_000_000] {
            let found = solved(&boundary, choice, limit);
            let triangles: Vec<[usize; 3]> =
                found.triangles.iter().map(|t| t.map(SampleIndex::get)).collect();
            assert_eq!(fault(boundary.loops(), &triangles), None, "{name} {limit}");
            let most = limit + limit / 10 + 2 * first.work;
            assert!(found.work <= most, "{name} {limit}: {} of {most}", found.work);
            assert!(found.price <= first.price || limit == 0, "{name} {limit}");
            assert!(!(found.proven_optimal && found.cut_short), "{name} {limit}");
            // What is cut short says so; what is not is all that can be found out.
            let all = solved(&boundary, choice, 4 * limit);
            assert!(found.cut_short || found.proven_optimal || !all.cut_short, "{name} {limit}");
            assert_eq!(found, solved(&boundary, choice, limit), "{name} {limit}");
            cut_short += usize::from(found.cut_short);
        }
    }
    assert!(cut_short > 10, "{cut_short}");
}

/// A table on the chain of all samples takes half of the work that may be done: there is one, and
/// what comes after the end of the work is the lower bound of the edges alone.
#[test]
fn a_large_first_table_is_filled_once() {
    let m = 680_u64;
    let (table, limit) = (m.pow(3) / 6, m.pow(3) / 3);
    for seed in 1..4 {
        let sizes = [m as usize / 2; 2];
        let boundary = tangled_loops(&mut Random::new(seed), &sizes, 0.1).unwrap();
        let found = solved(&boundary, PlaneChoice::None, limit);
        assert!(found.cut_short && found.work > table, "{seed}: {}", found.work);
        assert!(found.work < limit + table / 2 + 60 * m.pow(2), "{seed}: {}", found.work);
    }
}

#[test]
fn the_gap_is_true() {
    for (name, boundary, choice) in far_from_developable() {
        let most = solved(&boundary, choice, DEFAULT_WORK / 4);
        for limit in [300_000, 3_000_000, 30_000_000] {
            let found = solved(&boundary, choice, limit);
            assert!(
                found.lower_bound <= most.price,
                "{name} {limit}: {} is too high",
                found.lower_bound
            );
            assert!(most.lower_bound <= found.price, "{name} {limit}: {} is too low", found.price);
        }
    }
}

#[test]
fn what_lies_flat_is_known_at_once() {
    // In the plan, and in a plane that lies askew, where nothing is a whole number.
    let heights: [fn(f64, f64) -> f64; 2] = [|_, _| 0.0, |x, y| 0.3 * x + 0.7 * y];
    for height in heights {
        let boundary = pierced(96, 8, 12, height);
        let found = solved(&boundary, PlaneChoice::Auto, DEFAULT_WORK);
        assert!(found.proven_optimal && found.price == 0.0, "{}", found.price);
        assert!(found.work < DEFAULT_WORK / 5, "{}", found.work);
    }
}

/// Which way holes run is found out with a part of that work, and there may be many of them.
#[test]
fn many_loops_without_a_plane_are_made_with_little_work() {
    let sizes: Vec<usize> = std::iter::repeat_n(8, 17).collect();
    let boundary = tangled_loops(&mut Random::new(9), &sizes, 0.0).unwrap();
    let options = TriangulateOptions { work_limit: 3_000_000, ..Default::default() };
    let faced = with_holes_facing(&boundary, None, &options, &mut Unwatched).unwrap();
    let found = triangulate(&faced, None, &options, &mut Unwatched).unwrap();
    assert!(found.cut_short && found.triangles.len() == boundary.len() + 2 * 16 - 2);
}

/// Keeps how often it is told of progress.
struct Told(usize);

impl Watch for Told {
    fn progress(&mut self, _done: f64) {
        self.0 += 1;
    }
}

#[test]
fn a_panel_has_the_effort_that_it_asks_for() {
    let boundary = pierced(80, 2, 24, wave);
    let loops = boundary.loops().iter().enumerate();
    let curves = loops.map(|(n, range)| DesignCurve {
        name: n.to_string(),
        kind: None,
        closed: true,
        points: range.clone().map(|i| CurvePoint::smooth(boundary.samples()[i].position)).collect(),
    });
    let mut design = Design { curves: curves.collect(), ..Design::default() };
    let used =
        |n: usize| vec![sheetwright::design::CurveUse { name: n.to_string(), reversed: false }];
    let shape = PanelShape::Loops { outer: used(0), holes: (1..5).map(used).collect() };
    design.panels = vec![DesignPanel { effort: 0.001, ..DesignPanel::new("plate", shape, 80) }];
    let made = make(&design, &mut Unwatched).unwrap();
    let (few, note) =
        (&made.parts[0].found().unwrap().triangulation, &made.parts[0].checked.findings);
    assert!(few.cut_short && few.work < DEFAULT_WORK / 500, "{}", few.work);
    let note = note.iter().find(|finding| finding.code() == "not-proven").unwrap();
    assert!(matches!(note.kind, FindingKind::NotProven { cut_short: true, .. }), "{note:?}");
    assert_eq!(note.remedies(), [Remedy::Effort]);
    design.panels[0].effort = 0.1;
    let mut told = Told(0);
    let more = make(&design, &mut told).unwrap().parts[0].found().unwrap().triangulation.clone();
    assert!(
        more.work > few.work && more.price <= few.price && more.gap() < few.gap().or(Some(1.0))
    );
    assert!(told.0 > 5, "{}", told.0);
}

/// Without a plane any two samples may be joined, so that there is a surface for any loops; on a
/// plane, loops beside one another bound a polygon with holes.
#[test]
fn there_always_is_a_surface() {
    let mut random = Random::new(36);
    for round in 0..60 {
        let sizes: Vec<usize> = (0..2 + random.below(5)).map(|_| 3 + random.below(14)).collect();
        let corners = [0.0, 0.3][round % 2];
        let tangled = tangled_loops(&mut random, &sizes, corners);
        let flat = plate(&mut random, &sizes, corners);
        let tangled = tangled.map(|boundary| (boundary, PlaneChoice::None));
        let flat = flat.map(|boundary| (boundary, FROM_ABOVE));
        for (boundary, choice) in tangled.into_iter().chain(flat) {
            for (fold, work_limit) in [(0.0, 0), (0.1, DEFAULT_WORK / 1000), (1.0, 0)] {
                let plane = supporting_plane(&boundary, choice).unwrap();
                let price = PriceOptions { fold, ..Default::default() };
                let options = TriangulateOptions { work_limit, price, ..Default::default() };
                let found = triangulate(&boundary, plane.as_ref(), &options, &mut Unwatched);
                let found = found.unwrap_or_else(|error| panic!("{sizes:?} {fold}: {error}"));
                let triangles: Vec<[usize; 3]> =
                    found.triangles.iter().map(|t| t.map(SampleIndex::get)).collect();
                assert_eq!(fault(boundary.loops(), &triangles), None, "{sizes:?} {fold}");
                assert!(found.lower_bound <= found.price, "{sizes:?} {fold}");
            }
        }
    }
}
