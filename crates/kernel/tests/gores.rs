//! Gores against the sphere that they stand for.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured
#![allow(clippy::disallowed_methods)] // no bits depend on this logarithm

use sheetwright::check::Verdict;
use sheetwright::curve::Curve;
use sheetwright::make::make;
use sheetwright::template::template;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::gored::{expected, loss};

const GORES: [usize; 6] = [6, 8, 12, 16, 24, 36];

#[test]
fn what_gores_lose_of_a_hemisphere_falls_with_the_square_of_their_number() {
    let shares = |gores: usize| {
        let loss = loss(gores, 200.0);
        println!("{loss:?} {:?}", expected(gores));
        [loss.area_lost, loss.length_lost, loss.off_sphere]
    };
    let losses = GORES.map(shares);
    for (n, loss) in GORES.into_iter().zip(losses) {
        for (lost, expected) in loss.into_iter().zip(expected(n)) {
            // The next term is of the order 1/n⁴.
            let room = 2.0 / (n * n) as f64 + 2e-3;
            assert!(
                (lost / expected - 1.0).abs() < room,
                "{n} gores: {lost} instead of {expected}"
            );
        }
    }
    for pair in 1..GORES.len() {
        let by = (GORES[pair] as f64 / GORES[pair - 1] as f64).ln();
        for kind in 0..3 {
            let order = (losses[pair - 1][kind] / losses[pair][kind]).ln() / by;
            assert!((order - 2.0).abs() < 0.1, "{} gores: order {order}", GORES[pair]);
        }
    }
}

#[test]
fn meridians_lie_on_the_sphere() {
    for name in ["dome", "ball"] {
        let values = template(name).unwrap().defaults();
        let design = values.design().unwrap();
        let (radius, middle) = if name == "dome" { (2000.0, 0.0) } else { (150.0, 150.0) };
        for source in &design.curves {
            let curve = Curve::new(source.kind.unwrap(), &source.points, false).unwrap();
            for n in 0..=1000 {
                let p = curve.position(curve.spans().len() as f64 * f64::from(n) / 1000.0);
                let away = (p.x * p.x + p.y * p.y + (p.z - middle) * (p.z - middle)).sqrt();
                assert!((away / radius - 1.0).abs() < 1e-6, "{name}: {away}");
            }
        }
    }
}

#[test]
fn the_hemisphere_has_36_pieces_of_64_triangles() {
    let design = template("hemisphere").unwrap().defaults().design().unwrap();
    let made = make(&design, &mut Unwatched).unwrap();
    let triangles: usize = made
        .parts
        .iter()
        .map(|p| p.found().unwrap().surface.connectivity().triangles().len())
        .sum();
    assert_eq!((made.parts.len(), triangles), (36, 2304));
    assert!(made.parts.iter().all(|p| p.checked.verdict == Verdict::Bends));
    assert!(made.parts.iter().all(|p| p.found().unwrap().triangulation.proven_optimal));
}
