//! The slopes that variation descends on, against central differences, and its value against
//! prices.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::{Boundary, PlaneChoice, supporting_plane};
use sheetwright::cost::{PriceOptions, QUANTUM};
use sheetwright::design::VaryGoal;
use sheetwright::fair::{
    Share, Sloped, VaryPanel, Weights, control_shares, motions, motions_of_samples, sloped,
};
use sheetwright::math::{Vec3, from_deg};
use sheetwright::triangulate::{TriangulateOptions, triangulate};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::pierced::{plate, tube};
use sheetwright_shapes::random::{Random, grid, star, tangle};

/// Smooth boundaries, boundaries with corners, knotted ones, plane ones with ties, and some with a
/// hole.
fn boundaries() -> impl Iterator<Item = (usize, Boundary)> {
    (0..240u64).filter_map(|seed| {
        let mut random = Random::new(8_100 + seed);
        let m = 5 + random.below(30);
        let family = (seed % 6) as usize;
        let boundary = match family {
            0 => star(&mut random, m, 0.0),
            1 => star(&mut random, m, 0.3),
            2 => tangle(&mut random, m, 0.3),
            3 => grid(&mut random, m),
            4 => plate(&mut random, &[m, 5], 0.3),
            _ => tube(&mut random, [m, 7], 0.2),
        };
        Some((family, boundary?))
    })
}

fn random_vector(random: &mut Random) -> Vec3 {
    let mut unit = || random.between(-1.0, 1.0);
    Vec3::new(unit(), unit(), unit())
}

#[test]
fn slopes_are_those_of_central_differences() {
    let (mut compared, mut kinks, mut worst) = ([0; 6], [0; 6], 0.0f64);
    for (n, (family, boundary)) in boundaries().enumerate() {
        let mut random = Random::new(n as u64);
        let m = boundary.len();
        // Samples that are unknowns themselves, every seventh of them fixed; or control points.
        let (count, motions) = if n % 3 < 2 {
            let unknown: Vec<Option<usize>> = (0..m).map(|i| (i % 7 != 3).then_some(i)).collect();
            (m, motions_of_samples(&boundary, &unknown))
        } else {
            let along = |i: usize| control_shares(i as f64 / (m - 1) as f64, 0, 6);
            (6, motions(&boundary, (0..m).map(along).collect::<Vec<Vec<Share>>>()))
        };
        let fold = [0.0, 0.1, 1.0][n % 3];
        let options = TriangulateOptions {
            price: PriceOptions { fold, ..Default::default() },
            ..Default::default()
        };
        let plane = supporting_plane(&boundary, PlaneChoice::Auto).unwrap();
        let found = triangulate(&boundary, plane.as_ref(), &options, &mut Unwatched).unwrap();
        let panel = VaryPanel {
            boundary: &boundary,
            plane: PlaneChoice::Auto,
            triangulate: &options,
            motions: &motions,
            follows: false,
        };
        let pure = Weights { goal: VaryGoal::Price, excess: 0.0, twist: 1.0, fairness: 0.0 };
        let all = Weights {
            goal: VaryGoal::Warp { largest: from_deg(6.0) },
            excess: 3.0,
            twist: 2.5,
            fairness: 0.2,
        };
        let at = |weights: &Weights, unknowns: &[Vec3]| {
            sloped(&panel, plane.as_ref(), &found, weights, unknowns).unwrap()
        };
        let priced = at(&pure, &vec![Vec3::ZERO; count]).value;
        let terms = (found.rungs.len() + found.triangles.len()) as f64;
        assert!((priced - found.price).abs() <= terms * QUANTUM, "{n}: {priced} {}", found.price);

        let least = boundary
            .loops()
            .iter()
            .flat_map(|l| l.clone())
            .map(|i| {
                let to = boundary.samples()[boundary.next(i)].position;
                boundary.samples()[i].position.distance(to)
            })
            .fold(f64::INFINITY, f64::min);
        let base: Vec<Vec3> =
            (0..count).map(|_| random_vector(&mut random) * (0.02 * least)).collect();
        let way: Vec<Vec3> = (0..count).map(|_| random_vector(&mut random)).collect();
        let step = 3e-5 * least;
        for weights in [&pure, &all] {
            let here = at(weights, &base);
            let moved = |by: f64| -> Sloped {
                let unknowns: Vec<Vec3> =
                    base.iter().zip(&way).map(|(b, w)| *b + *w * by).collect();
                at(weights, &unknowns)
            };
            let around: Vec<Sloped> = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(k * step)).to_vec();
            if around.iter().any(|s| s.pieces != here.pieces) {
                kinks[family] += 1;
                continue;
            }
            // Five points: the error falls with the fourth power of the step.
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| around[k].value);
            let difference = (a - 8.0 * b + 8.0 * c - d) / (12.0 * step);
            let slope: f64 = here.slopes.iter().zip(&way).map(|(s, w)| s.dot(*w)).sum();
            let size: f64 = here.slopes.iter().map(|s| s.length()).sum();
            let off =
                if size == 0.0 { difference.abs() } else { (slope - difference).abs() / size };
            worst = worst.max(off);
            compared[family] += 1;
        }
    }
    println!("{compared:?} compared, {kinks:?} at a kink, the worst off by {worst:e}");
    assert!(worst < 1e-6, "{worst:e}");
    // Every boundary is compared twice.
    assert!(compared.iter().sum::<i32>() >= 200 && compared.iter().all(|&n| n >= 20));
}
