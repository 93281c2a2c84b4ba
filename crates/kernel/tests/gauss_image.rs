//! The area of the Gauss image of surfaces for which it is known.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::{Boundary, PlaneChoice, samples_from_points, supporting_plane};
use sheetwright::cost::{PriceOptions, Prices};
use sheetwright::curve::CurvePoint;
use sheetwright::index::SampleIndex;
use sheetwright::math::{Point3, cos, sin};
use sheetwright::measure::{gauss_area, rung_measures};
use sheetwright::surface::{Connectivity, Surface};
use sheetwright::triangulate::{TriangulateOptions, triangulate};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::developable::blobs;
use sheetwright_shapes::family::Family;

fn area(boundary: &Boundary, triangles: Vec<[SampleIndex; 3]>) -> f64 {
    let prices = Prices::new(boundary, None, PriceOptions::default());
    let connectivity = Connectivity::new(boundary.loops(), triangles).unwrap();
    let surface = Surface::new(connectivity, boundary.positions());
    gauss_area(surface.connectivity(), &rung_measures(&surface, &prices))
}

fn of_best(boundary: &Boundary) -> f64 {
    let plane = supporting_plane(boundary, PlaneChoice::Auto).unwrap();
    let options = TriangulateOptions::default();
    let found = triangulate(boundary, plane.as_ref(), &options, &mut Unwatched).unwrap();
    area(boundary, found.triangles)
}

/// A strip between two rails of n samples each, ruled from each sample to that of the other.
fn ruled(n: usize, at: impl Fn(f64, f64) -> Point3) -> f64 {
    let share = |i: usize| i as f64 / (n - 1) as f64;
    let rail = |i: usize, side: f64| {
        let point = at(share(i), side);
        if i == 0 || i + 1 == n { CurvePoint::corner(point) } else { CurvePoint::smooth(point) }
    };
    let points: Vec<CurvePoint> =
        (0..n).map(|i| rail(i, -1.0)).chain((0..n).rev().map(|i| rail(i, 1.0))).collect();
    let boundary = Boundary::new(vec![samples_from_points(&points)]).unwrap();
    let across = |i: usize| 2 * n - 1 - i;
    let quads = (0..n - 1).flat_map(|i| {
        let (a, b, c, d) = (i, i + 1, across(i + 1), across(i));
        [[a, b, d], [b, c, d]].map(|t| t.map(SampleIndex::new))
    });
    area(&boundary, quads.collect())
}

#[test]
fn a_helicoid_turns_as_its_curvature_says() {
    // ∫ |K| dA of (c θ, r cos θ, r sin θ) over |r| ≤ a and 0 ≤ θ ≤ Θ is 2 a Θ / √(a² + c²).
    let (a, c, whole) = (50.0, 250.0, 1.5);
    let truth = 2.0 * a * whole / f64::sqrt(a * a + c * c);
    let error = |n: usize| {
        let found = ruled(n, |share, side| {
            let (angle, r) = (whole * share, a * side);
            Point3::new(c * angle, r * cos(angle), r * sin(angle))
        });
        (found / truth - 1.0).abs()
    };
    let errors = [50, 100, 200, 400].map(error);
    println!("helicoid: errors of the area of its Gauss image: {errors:?}");
    assert!(errors[3] < 0.01 && errors.windows(2).all(|pair| pair[1] < 0.6 * pair[0]));
}

#[test]
fn a_warp_that_changes_its_sign_counts_on_both_sides() {
    // z = x² y: rulings along y, whose warp is 4 x to first order and changes its sign in the
    // middle.
    let signed = |from: f64| {
        ruled(401, |share, side| {
            let x = from + (1.0 - from) * share;
            Point3::new(100.0 * x, 100.0 * side, 2.0 * x * x * side)
        })
    };
    let (both, half) = (signed(-1.0), signed(0.0));
    println!("x² y: {both:.6} sr over both halves, {half:.6} over one");
    assert!(half > 1e-4 && (both / (2.0 * half) - 1.0).abs() < 0.02);
}

#[test]
fn what_is_developable_has_none_but_for_the_sampling() {
    for blob in blobs() {
        let areas = [100, 200, 400].map(|m| of_best(&blob.boundary(m).0));
        println!("{}: {areas:?} sr", blob.name);
        assert!(areas[2] < 2e-4 && areas.windows(2).all(|pair| pair[1] < 0.3 * pair[0]));
    }
    // Folds are no part of the image: this strip is two cones that meet in one.
    let strip = of_best(&Family::TwistedStrip.boundary(400));
    assert!(strip < 1e-6, "strip twisted by 90°: {strip} sr");
    let curve = [200, 400].map(|m| of_best(&Family::Fourier(3).boundary(m)));
    println!("random curve: {curve:?} sr");
    assert!(curve[1] > 0.2 && curve[1] > 0.75 * curve[0], "what is not keeps it");
}
