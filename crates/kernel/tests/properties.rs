//! What holds for every boundary, tried on random ones.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::{Boundary, PlaneChoice, supporting_plane};
use sheetwright::cost::{DEFAULT_FOLD, PriceOptions, Prices};
use sheetwright::flatten::{RefoldError, refold, unroll};
use sheetwright::measure::{CutFrom, area_flat, area_space, length_errors, measures};
use sheetwright::sheet::Sheet;
use sheetwright::surface::{Connectivity, Surface};
use sheetwright::triangulate::{Method, TriangulateError, TriangulateOptions, triangulate};
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::random::{Random, grid, star, tangle};

fn boundaries() -> impl Iterator<Item = Boundary> {
    (0..300u64).filter_map(|seed| {
        let mut random = Random::new(77_000 + seed);
        let m = 3 + random.below(60);
        match seed % 3 {
            0 => star(&mut random, m, 0.2),
            1 => tangle(&mut random, m, 0.2),
            _ => grid(&mut random, m),
        }
    })
}

#[test]
fn every_result_is_a_surface_that_unrolls_and_folds_back() {
    let mut made = 0;
    for boundary in boundaries() {
        let m = boundary.len();
        for choice in [PlaneChoice::Auto, PlaneChoice::None] {
            let plane = supporting_plane(&boundary, choice).unwrap();
            for method in [Method::Optimal, Method::Bridge, Method::Rails { first: m / 2 }] {
                let options = TriangulateOptions { method, ..Default::default() };
                let found = triangulate(&boundary, plane.as_ref(), &options, &mut Unwatched);
                let Ok(found) = found else {
                    assert_eq!(found, Err(TriangulateError::NoneInside));
                    assert!(plane.is_some() && method != Method::Optimal);
                    continue;
                };
                made += 1;
                assert_eq!((found.rungs.len(), found.triangles.len()), (m - 3, m - 2));
                for (n, rung) in found.rungs.iter().enumerate() {
                    assert!(!found.rungs[..n].iter().any(|other| rung.crosses(*other)));
                }
                let connectivity =
                    Connectivity::new(boundary.loops(), found.triangles.clone()).unwrap();
                let surface = Surface::new(connectivity, boundary.positions());
                let flat =
                    unroll(surface.connectivity(), |a, b| surface.length(a, b), &mut Unwatched)
                        .unwrap();
                let sheet = Sheet::whole(&surface);
                let worst =
                    length_errors(&sheet, &flat).into_iter().map(f64::abs).fold(0.0, f64::max);
                assert!(worst < 1e-9, "{worst}");
                let (space, laid) = (area_space(&sheet), area_flat(&sheet, &flat));
                assert!((space - laid).abs() < 1e-9 * boundary.size() * boundary.size());
                let prices = Prices::new(&boundary, plane.as_ref(), PriceOptions::default());
                let measured = measures(CutFrom::Surface(&surface, &prices), &sheet, &flat);
                if plane.is_some() && found.forced_rungs == 0 {
                    assert_eq!(measured.self_crossing, None, "a roof does not cross itself");
                }
                let folded = refold(&sheet, &flat.points, &found.rungs);
                if let Ok(error) = folded {
                    assert!(error < 1e-6 * boundary.size(), "{error}");
                }
            }
        }
    }
    assert!(made > 1000, "{made}");
}

#[test]
fn a_wrong_pattern_does_not_fold_back() {
    let mut random = Random::new(5);
    let boundary = star(&mut random, 30, 0.0).unwrap();
    let found =
        triangulate(&boundary, None, &TriangulateOptions::default(), &mut Unwatched).unwrap();
    let connectivity = Connectivity::new(boundary.loops(), found.triangles.clone()).unwrap();
    let surface = Surface::new(connectivity, boundary.positions());
    let flat = unroll(surface.connectivity(), |a, b| surface.length(a, b), &mut Unwatched).unwrap();
    let (sheet, size) = (Sheet::whole(&surface), boundary.size());
    let right = refold(&sheet, &flat.points, &found.rungs).unwrap();
    assert!(right < 1e-9 * size);
    // A millimetre off, mirrored, turned round by one sample, a rung missing, a rung too many.
    let mut moved = flat.points.clone();
    moved[7].x += 1.0;
    assert!(refold(&sheet, &moved, &found.rungs).unwrap() > 0.3);
    let mirrored: Vec<_> =
        flat.points.iter().map(|p| sheetwright::math::Point2::new(-p.x, p.y)).collect();
    assert_eq!(refold(&sheet, &mirrored, &found.rungs), Err(RefoldError::Mirrored));
    let mut shifted = flat.points.clone();
    shifted.rotate_left(1);
    assert!(!refold(&sheet, &shifted, &found.rungs).is_ok_and(|error| error < 1.0));
    assert!(refold(&sheet, &flat.points, &found.rungs[1..]).is_err());
    assert!(refold(&sheet, &flat.points[1..], &found.rungs).is_err());
}

#[test]
fn the_answer_is_the_same_bits_every_time() {
    for boundary in boundaries().take(40) {
        let run = || triangulate(&boundary, None, &TriangulateOptions::default(), &mut Unwatched);
        assert_eq!(run(), run());
    }
}

#[test]
fn the_watcher_sees_progress_and_may_stop() {
    struct Impatient {
        seen: Vec<f64>,
        patience: std::cell::Cell<usize>,
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
    let boundary = star(&mut Random::new(3), 300, 0.0).unwrap();
    for method in [Method::Optimal, Method::Bridge, Method::Rails { first: 150 }] {
        let options = TriangulateOptions { method, ..Default::default() };
        let mut patient = Impatient { seen: vec![], patience: 1_000_000.into() };
        assert!(triangulate(&boundary, None, &options, &mut patient).is_ok());
        assert!(patient.seen.len() > 10 && patient.seen.windows(2).all(|w| w[0] <= w[1]));
        assert!(patient.seen.iter().all(|done| (0.0..=1.0).contains(done)));
        let mut hasty = Impatient { seen: vec![], patience: 5.into() };
        let stopped = triangulate(&boundary, None, &options, &mut hasty);
        assert_eq!(stopped, Err(TriangulateError::Stopped));
    }
}

#[test]
fn what_does_not_fit_is_refused_with_its_size() {
    let boundary = star(&mut Random::new(3), 50, 0.0).unwrap();
    let options = TriangulateOptions { memory_limit: 10_000, ..Default::default() };
    let refused = triangulate(&boundary, None, &options, &mut Unwatched);
    let Err(TriangulateError::TooLarge { needed, limit: 10_000 }) = refused else {
        panic!("{refused:?}")
    };
    assert!(needed > 10_000 && needed == sheetwright::triangulate::memory_needed(50));
    let options = TriangulateOptions {
        price: PriceOptions { fold: -DEFAULT_FOLD, ..Default::default() },
        ..Default::default()
    };
    let refused = triangulate(&boundary, None, &options, &mut Unwatched);
    assert_eq!(refused, Err(TriangulateError::Fold));
}
