//! Boundaries of many samples, of whose table few tiles are kept.
#![allow(clippy::unwrap_used)] // tests panic

use sheetwright_geometry::boundary::{
    Boundary, PlaneChoice, samples_from_points, supporting_plane,
};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, cos, sin};
use sheetwright_geometry::watch::{Unwatched, Watch};
use sheetwright_optimum::cost::PriceOptions;
use sheetwright_optimum::specification;
use sheetwright_optimum::triangulate::{
    Method, TriangulateError, TriangulateOptions, Triangulation, memory_needed, triangulate,
};
use sheetwright_shapes::family::Family;
use sheetwright_shapes::random::{Random, star};
use std::f64::consts::TAU;

fn options(fold: f64) -> TriangulateOptions {
    TriangulateOptions { price: PriceOptions { fold, ..Default::default() }, ..Default::default() }
}

fn solved(boundary: &Boundary, choice: PlaneChoice, fold: f64) -> Triangulation {
    let plane = supporting_plane(boundary, choice).unwrap();
    triangulate(boundary, plane.as_ref(), &options(fold), &mut Unwatched).unwrap()
}

#[test]
fn the_price_is_that_of_the_plain_table() {
    for family in Family::ALL {
        let boundary = family.boundary(520);
        let found = solved(&boundary, PlaneChoice::None, 0.0);
        let plain = specification::cheapest(&boundary, None, options(0.0).price).unwrap();
        assert_eq!(found.price, plain.price, "{}", family.name());
        assert!(found.proven_optimal);
    }
}

#[test]
fn a_plane_that_bars_nothing_changes_nothing() {
    let mut with_plane = 0;
    for family in Family::ALL {
        let boundary = family.boundary(520);
        let (one, other) = (PlaneChoice::None, PlaneChoice::Auto);
        let free = solved(&boundary, one, 0.1);
        let Some(plane) = supporting_plane(&boundary, other).unwrap() else { continue };
        let at = |i: usize| plane.projected[i];
        let lies_on = free.triangles.iter().all(|t| {
            let [a, b, c] = t.map(|sample| at(sample.get()));
            (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 1e-9
        });
        let bound = solved(&boundary, other, 0.1);
        if lies_on {
            assert_eq!(free.triangles, bound.triangles, "{}", family.name());
            with_plane += 1;
        } else {
            assert!(bound.price >= free.price, "{}", family.name());
        }
    }
    assert!(with_plane >= 2, "{with_plane}");
}

#[test]
fn what_a_plane_bars_is_left_out() {
    // A flower: many rungs that are cheap leave its projection.
    let at = |i: u32| {
        let t = TAU * f64::from(i) / 520.0;
        let r = 100.0 + 50.0 * cos(5.0 * t);
        CurvePoint::smooth(Point3::new(r * cos(t), r * sin(t), 10.0 * sin(2.0 * t)))
    };
    let samples = samples_from_points(&(0..520).map(at).collect::<Vec<_>>());
    let boundary = Boundary::new(vec![samples]).unwrap();
    let plane = supporting_plane(&boundary, PlaneChoice::Auto).unwrap().unwrap();
    let found = triangulate(&boundary, Some(&plane), &options(0.0), &mut Unwatched).unwrap();
    assert!(found.proven_optimal && found.triangles.len() == 518);
    assert!(found.price > solved(&boundary, PlaneChoice::None, 0.0).price);
    for triangle in &found.triangles {
        let [a, b, c] = triangle.map(|sample| plane.projected[sample.get()]);
        assert!((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0);
    }
}

#[test]
fn many_samples_need_no_full_table() {
    let boundary = Family::CylinderBlob.boundary(6000);
    let memory_limit = memory_needed(6000) / 12;
    let narrow = TriangulateOptions { memory_limit, ..options(1.0) };
    let found = triangulate(&boundary, None, &narrow, &mut Unwatched).unwrap();
    assert!(found.proven_optimal && found.triangles.len() == 5998);
}

#[test]
fn flat_stretches_take_hardly_any_memory() {
    // The arcs of the patch lie in a plane each. Without the fold price the tiles have no N.
    for (fold, part) in [(0.0, 20), (1.0, 8)] {
        let boundary = Family::CylinderPatch.boundary(4000);
        let memory_limit = memory_needed(4000) / part;
        let narrow = TriangulateOptions { memory_limit, ..options(fold) };
        let found = triangulate(&boundary, None, &narrow, &mut Unwatched).unwrap();
        assert!(found.proven_optimal && found.triangles.len() == 3998);
    }
    // All of this outline lies in one.
    let at = |i: u32| match (i / 750, f64::from(i % 750)) {
        (0, s) => (s, 0.0),
        (1, s) => (750.0, s),
        (2, s) => (750.0 - s, 750.0),
        (_, s) => (0.0, 750.0 - s),
    };
    let corner = |i: u32| {
        let (x, y) = at(i);
        let point = Point3::new(x, y, 0.0);
        if i.is_multiple_of(750) { CurvePoint::corner(point) } else { CurvePoint::smooth(point) }
    };
    let samples = samples_from_points(&(0..3000).map(corner).collect::<Vec<_>>());
    let square = Boundary::new(vec![samples]).unwrap();
    for (fold, part) in [(0.0, 20), (1.0, 8)] {
        let memory_limit = memory_needed(3000) / part;
        let narrow = TriangulateOptions { memory_limit, ..options(fold) };
        let found = triangulate(&square, None, &narrow, &mut Unwatched).unwrap();
        assert!(found.price == 0.0 && found.triangles.len() == 2998);
    }
}

#[test]
fn tables_that_grow_too_large_are_refused_with_their_size() {
    // Far from developable, nearly all of the dense table is needed.
    let tangled = star(&mut Random::new(5), 2600, 0.4).unwrap();
    let limit = 16 << 20;
    let narrow = TriangulateOptions { memory_limit: limit, ..options(1.0) };
    let refused = triangulate(&tangled, None, &narrow, &mut Unwatched);
    let Err(TriangulateError::TooLarge { needed, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(needed, memory_needed(2600));
    // Next to a developable surface little of it is. The least memory that is enough:
    let wavy = Family::Wavy.boundary(1600);
    let solve = |memory_limit: u64| {
        let narrow = TriangulateOptions { memory_limit, ..options(1.0) };
        triangulate(&wavy, None, &narrow, &mut Unwatched)
    };
    let roomy = solve(4 << 30).unwrap();
    let enough = (18..32).find(|&bits| solve(1 << bits).is_ok()).unwrap();
    assert!(2 << enough < memory_needed(1600), "{enough}");
    assert_eq!(solve(1 << enough), Ok(roomy));
    let refused = solve(1 << (enough - 1));
    assert!(matches!(refused, Err(TriangulateError::TooLarge { .. })), "{refused:?}");
}

#[test]
fn the_search_can_be_watched_and_stopped() {
    struct Impatient {
        seen: Vec<f64>,
        patience: std::cell::Cell<u32>,
    }
    impl Watch for Impatient {
        fn progress(&mut self, done: f64) {
            self.seen.push(done);
        }
        fn stop(&self) -> bool {
            self.patience.set(self.patience.get().saturating_sub(1));
            self.patience.get() == 0
        }
    }
    let boundary = Family::Wavy.boundary(800);
    let mut patient = Impatient { seen: vec![], patience: 1_000_000.into() };
    let found = triangulate(&boundary, None, &options(1.0), &mut patient);
    assert!(found.is_ok() && patient.seen.len() >= 4);
    assert!(patient.seen.windows(2).all(|w| w[0] <= w[1]));
    for patience in [2, 20, 60] {
        let mut hasty = Impatient { seen: vec![], patience: patience.into() };
        let stopped = triangulate(&boundary, None, &options(1.0), &mut hasty);
        assert_eq!(stopped, Err(TriangulateError::Stopped), "{patience}");
    }
    let bridge = TriangulateOptions { method: Method::Bridge, ..options(1.0) };
    assert!(triangulate(&boundary, None, &bridge, &mut Unwatched).is_ok());
}
