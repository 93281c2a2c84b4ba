//! The optimal triangulation against its specification, equation (5) as it is written, beyond the
//! sizes that can be enumerated: the same triangles, ties included, and the same bits of the price.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright_geometry::boundary::{Boundary, samples_from_points};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, cos, sin};
use sheetwright_geometry::watch::Unwatched;
use sheetwright_optimum::cost::{Hint, HintKind, PriceOptions, Prices, TwistForm};
use sheetwright_optimum::specification;
use sheetwright_optimum::triangulate::{Goal, TriangulateOptions, triangulate};
use sheetwright_shapes::family::Family;
use std::f64::consts::TAU;

fn check(boundary: &Boundary, price: PriceOptions, what: &str) {
    let plain = specification::cheapest(boundary, None, price).unwrap();
    let options = TriangulateOptions { price, ..TriangulateOptions::default() };
    let found = triangulate(boundary, None, &options, &mut Unwatched).unwrap();
    let same: Vec<[usize; 3]> =
        found.triangles.iter().map(|corners| corners.map(|corner| corner.get())).collect();
    assert!(same == plain.triangles, "{what}: {} {}", found.price, plain.price);
    assert_eq!(found.price.to_bits(), plain.price.to_bits(), "{what}");
}

/// An outline of so many samples in a plane, x and y along the given directions: a square with four
/// corners, or an egg without straight runs.
fn plane_outline(m: u32, square: bool, along: [[f64; 3]; 2]) -> Boundary {
    let point = |i: u32| {
        let s = 4.0 * f64::from(i) / f64::from(m);
        let (x, y) = match s {
            _ if !square => {
                let t = TAU * s / 4.0;
                ((3.0 + cos(t)) * cos(t), 2.0 * sin(t))
            }
            _ if s < 1.0 => (s, 0.0),
            _ if s < 2.0 => (1.0, s - 1.0),
            _ if s < 3.0 => (3.0 - s, 1.0),
            _ => (0.0, 4.0 - s),
        };
        let [x, y] = [x, y].map(|x| 100.0 * x);
        let at = |axis: usize| x * along[0][axis] + y * along[1][axis];
        let at = Point3::new(at(0), at(1), at(2));
        if square && (4 * i).is_multiple_of(m) {
            CurvePoint::corner(at)
        } else {
            CurvePoint::smooth(at)
        }
    };
    Boundary::new(vec![samples_from_points(&(0..m).map(point).collect::<Vec<_>>())]).unwrap()
}

#[test]
fn flat_outlines_have_the_triangles_of_the_plain_table() {
    // In one plane along the axes, and in two others, N has the same bits or not.
    let planes = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
        [[0.6, 0.0, 0.8], [0.1, 0.9, -0.3]],
    ];
    for along in planes {
        for (m, square) in [(64, true), (260, true), (65, false), (259, false)] {
            for fold in [0.0, 1.0] {
                let price = PriceOptions { fold, ..PriceOptions::default() };
                let outline = plane_outline(m, square, along);
                check(&outline, price, &format!("{m} {square} {along:?} {fold}"));
            }
        }
    }
}

#[test]
fn families_of_all_sizes_have_the_triangles_of_the_plain_table() {
    // On both sides of where tiles end, where bounds begin to be tried, and where they nest.
    let sizes = [8, 15, 16, 17, 31, 32, 33, 47, 63, 64, 65, 80, 97, 130, 259];
    for m in sizes {
        for family in Family::ALL {
            let boundary = family.boundary(m);
            for fold in [0.0, 1e-9, 0.1, 1.0] {
                let price = PriceOptions { fold, ..PriceOptions::default() };
                check(&boundary, price, &format!("{} {m} {fold}", family.name()));
            }
        }
    }
}

#[test]
fn random_curves_have_the_triangles_of_the_plain_table() {
    for seed in 10..170 {
        let m = 40 + (seed as usize * 37) % 90;
        let boundary = Family::Fourier(seed).boundary(m);
        for fold in [0.0, 1.0, 10.0] {
            let price = PriceOptions { fold, ..PriceOptions::default() };
            check(&boundary, price, &format!("seed {seed} {m} {fold}"));
        }
    }
}

#[test]
fn the_printed_form_has_the_triangles_of_the_plain_table() {
    // Prices far above what bounds are tried for.
    for (m, family) in [(70, Family::Fourier(4)), (90, Family::TwistedStrip), (150, Family::Wavy)] {
        for fold in [0.0, 1.0] {
            let price = PriceOptions { fold, form: TwistForm::Printed };
            check(&family.boundary(m), price, &format!("{} {m} {fold}", family.name()));
        }
    }
}

#[test]
fn the_worst_rung_is_that_of_the_plain_table() {
    for m in [17, 33, 64, 97, 150] {
        for family in Family::ALL {
            let boundary = family.boundary(m);
            let least = specification::least_worst_twist(&boundary, None).unwrap();
            let options = TriangulateOptions { goal: Goal::WorstWarp, ..Default::default() };
            let found = triangulate(&boundary, None, &options, &mut Unwatched).unwrap();
            assert_eq!(found.largest_twist, least, "{} {m}", family.name());
        }
    }
}

#[test]
fn with_hints_too_the_triangles_are_those_of_the_plain_table() {
    let mut changed = 0;
    for (m, form) in
        [(61, TwistForm::Normalised), (200, TwistForm::Normalised), (61, TwistForm::Printed)]
    {
        for kind in [HintKind::Near, HintKind::Away] {
            let boundary = Family::Wavy.boundary(m);
            let price = PriceOptions { form, ..PriceOptions::default() };
            let size = boundary.size();
            let hint = |[x, y, z]: [f64; 3]| Hint { at: Point3::new(x, y, z), kind };
            let hints = vec![hint([0.0, 0.0, 0.02 * size]), hint([0.1 * size, 0.05 * size, 0.0])];
            let prices = Prices::new(&boundary, None, price).with_hints(&hints, &boundary);
            let plain = specification::cheapest_of(&boundary, None, &prices).unwrap();
            let options = TriangulateOptions { price, hints, ..TriangulateOptions::default() };
            let found = triangulate(&boundary, None, &options, &mut Unwatched).unwrap();
            let same: Vec<[usize; 3]> =
                found.triangles.iter().map(|corners| corners.map(|corner| corner.get())).collect();
            assert_eq!(found.price.to_bits(), plain.price.to_bits(), "{m} {kind:?}");
            assert_eq!(same, plain.triangles, "{m} {kind:?}");
            let free = TriangulateOptions { price, ..TriangulateOptions::default() };
            let free = triangulate(&boundary, None, &free, &mut Unwatched).unwrap();
            changed += usize::from(found.triangles != free.triangles);
            assert!(free.price <= found.price_without_hints());
        }
    }
    assert!(changed >= 4, "{changed}");
}
