//! The published hull: offsets of the UBC series fishing vessel \[ZB18\].
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::Boundary;
use sheetwright::cost::{DEFAULT_FOLD, PriceOptions, Prices};
use sheetwright::curve::{Curve, CurveKind, Sample, sample_open};
use sheetwright::design::PanelMethod;
use sheetwright::make::{Made, make};
use sheetwright::math::{Point3, to_deg};
use sheetwright::rung::Rung;
use sheetwright::triangulate::{Goal, Method, TriangulateOptions, triangulate};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::hull::{curves, planks};

/// Pairs of rails, with the largest and the mean warp angle of a plain least-twist path, degrees.
const PLANKS: [(&str, &str, f64, f64); 3] = [
    ("Main deck", "Upper chine", 3.9, 0.80),
    ("Upper chine", "Lower chine", 1.9, 0.30),
    ("Lower chine", "Profile", 26.6, 2.9),
];

fn made(method: PanelMethod, goal: Goal, run_on: bool) -> Made {
    let mut design = planks(200, DEFAULT_FOLD);
    for panel in &mut design.panels {
        (panel.method, panel.goal, panel.run_on) = (method, goal, run_on);
    }
    make(&design, &mut Unwatched).unwrap()
}

#[test]
fn every_plank_is_at_least_as_good_as_published() {
    for method in [PanelMethod::Optimal, PanelMethod::Bridge, PanelMethod::Rails] {
        let made = made(method, Goal::Price, false);
        for (panel, (.., most, mean)) in made.parts.iter().zip(PLANKS) {
            let measures = &panel.measures;
            let found = (to_deg(measures.warp_max), to_deg(measures.warp_mean));
            println!("{method:?} {}: {:.2}° / {:.3}°", panel.name, found.0, found.1);
            assert!(found.0 <= most && found.1 <= mean, "{} {found:?}", panel.name);
            assert!(measures.length_error_max < 1e-12 && measures.self_crossing.is_none());
            assert!(panel.flat.overlap.is_none());
        }
    }
}

/// Where the ends of the rails are no corners, so that rungs there must obey the tangent of their
/// own rail, the numbers are the published ones: the free fans at the corners make the difference.
#[test]
fn without_corners_the_numbers_are_those_of_the_plain_path() {
    let curves = curves();
    let rail = |name: &str| -> Vec<Sample> {
        let curve = curves.iter().find(|curve| curve.name == name).unwrap();
        let curve = Curve::new(CurveKind::Spline, &curve.points, false).unwrap();
        sample_open(&curve, 200).unwrap()
    };
    for (first, second, most, mean) in PLANKS {
        let mut samples = rail(first);
        samples.extend(rail(second).into_iter().rev().map(|s| Sample {
            position: s.position,
            tangent_in: -s.tangent_out,
            tangent_out: -s.tangent_in,
        }));
        let boundary = Boundary::new(vec![samples]).unwrap();
        let price = PriceOptions { fold: 0.0, ..Default::default() };
        let method = Method::Rails { first: 200 };
        let options = TriangulateOptions { method, price, ..Default::default() };
        let found = triangulate(&boundary, None, &options, &mut Unwatched).unwrap();
        let prices = Prices::new(&boundary, None, price);
        // The first and last rung of the path are the ends of the strip, edges of the boundary.
        let warps: Vec<f64> = found
            .rungs
            .iter()
            .map(|rung| {
                let [a, b] = rung.ends();
                to_deg(prices.planes(a.get(), b.get()).unwrap().warp())
            })
            .collect();
        let largest = warps.iter().copied().fold(0.0, f64::max);
        let average = warps.iter().sum::<f64>() / warps.len() as f64;
        println!("{first}–{second}: {largest:.2}° / {average:.3}°");
        assert!((largest - most).abs() < 0.1, "{first}: {largest}");
        assert!((average - mean).abs() < 0.05, "{first}: {average}");
    }
}

/// With rails that run on and no change of the curves, the plain path on the trimmed strip, all of
/// whose rungs obey the tangents of their own rails, has at most 16° on the last plank
/// [published]. (Between the longer rails themselves no rung does: the profile lies in a plane,
/// wherever it runs on, and the chine leaves that plane at 26.6°.) Where corners are free, straight
/// ends are as good, and the report says so.
#[test]
fn the_last_plank_runs_on() {
    let made = made(PanelMethod::Rails, Goal::Price, true);
    let mut warps_of_planks = Vec::new();
    for (panel, (first, second, ..)) in made.parts.iter().zip(PLANKS) {
        let ends = |name: &str| {
            let curves = curves();
            let points = &curves.iter().find(|curve| curve.name == name).unwrap().points;
            [points[0].at, points[points.len() - 1].at]
        };
        let (p, q) = (ends(first), ends(second));
        // Corners keep the tangents of their rails: the first runs forth, the second back.
        let own = |s: &Sample| {
            let is = |at: Point3| s.position.distance(at) < 1e-6;
            if is(p[0]) || is(q[1]) {
                Sample { tangent_in: s.tangent_out, ..*s }
            } else if is(p[1]) || is(q[0]) {
                Sample { tangent_out: s.tangent_in, ..*s }
            } else {
                *s
            }
        };
        let samples: Vec<Sample> =
            panel.found().unwrap().boundary.samples().iter().map(own).collect();
        assert!(samples.len() > 400 && samples.iter().all(|s| !s.is_corner()));
        let second_begins = samples.iter().position(|s| s.position.distance(q[1]) < 1e-6).unwrap();
        let boundary = Boundary::new(vec![samples]).unwrap();
        let price = PriceOptions { fold: 0.0, ..Default::default() };
        let method = Method::Rails { first: second_begins };
        let options = TriangulateOptions { method, price, ..Default::default() };
        let found = triangulate(&boundary, None, &options, &mut Unwatched).unwrap();
        let prices = Prices::new(&boundary, None, price);
        let warp = |rung: &Rung| {
            let [a, b] = rung.ends();
            to_deg(prices.planes(a.get(), b.get()).unwrap().warp())
        };
        let warps: Vec<f64> = found.rungs.iter().map(warp).collect();
        let largest = warps.iter().copied().fold(0.0, f64::max);
        let average = warps.iter().sum::<f64>() / warps.len() as f64;
        let free = to_deg(panel.measures.warp_max);
        println!("{first}–{second}: {largest:.2}° / {average:.3}°, with free corners {free:.2}°");
        assert!(panel.measures.length_error_max < 1e-12 && panel.flat.overlap.is_none());
        assert!(panel.checked.findings.iter().any(|finding| finding.code() == "ran-on"));
        warps_of_planks.push((largest, average));
    }
    let (largest, average) = warps_of_planks[2];
    assert!(largest < 9.1 && average < 1.1, "{largest} {average}");
}
