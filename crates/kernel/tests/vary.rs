//! What holds whenever samples are varied.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::{Boundary, PlaneChoice, samples_from_points};
use sheetwright::cost::PriceOptions;
use sheetwright::curve::CurvePoint;
use sheetwright::design::VaryGoal;
use sheetwright::fair::{
    Ended, Limit, Motion, Varied, VaryError, VaryOptions, VaryPanel, control_shares,
    counted_shares, motions, motions_of_samples, vary,
};
use sheetwright::math::{Point3, cos, from_deg, sin, to_deg};
use sheetwright::triangulate::{TriangulateOptions, triangulate};
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::developable::blobs;
use sheetwright_shapes::random::{Random, star, tangle};

fn panel<'a>(
    boundary: &'a Boundary,
    triangulate: &'a TriangulateOptions,
    motions: &'a [Motion],
) -> VaryPanel<'a> {
    VaryPanel { boundary, plane: PlaneChoice::Auto, triangulate, motions, follows: false }
}

/// One panel whose samples are all unknowns, with a limit for each.
fn varied(boundary: &Boundary, radius_mm: f64, options: &VaryOptions) -> Varied {
    let m = boundary.len();
    let motions = motions_of_samples(boundary, &(0..m).map(Some).collect::<Vec<_>>());
    let limit = Limit::Each { radii_mm: vec![radius_mm; m] };
    let triangulate = TriangulateOptions::default();
    vary(&[panel(boundary, &triangulate, &motions)], &limit, options, &mut Unwatched).unwrap()
}

#[test]
fn limits_hold_fixed_samples_stay_and_the_twist_never_rises() {
    let (mut tried, mut gained) = (0, 0);
    for seed in 0..60u64 {
        let mut random = Random::new(4_400 + seed);
        let m = 6 + random.below(30);
        let made =
            if seed % 2 == 0 { star(&mut random, m, 0.2) } else { tangle(&mut random, m, 0.2) };
        let Some(boundary) = made else { continue };
        tried += 1;
        let size = boundary.size();
        let unknown: Vec<Option<usize>> = (0..m).map(|i| (i % 3 != 1).then_some(i)).collect();
        let motions = motions_of_samples(&boundary, &unknown);
        let total_mm = 0.01 * size;
        let limit = match seed % 4 {
            0 | 1 => Limit::budget(total_mm, vec![1.0; m]),
            _ => Limit::Each { radii_mm: vec![0.1 * total_mm; m] },
        };
        let fold = [0.0, 1.0][usize::from(seed % 8 < 4)];
        let price = PriceOptions { fold, ..Default::default() };
        let triangulate_options = TriangulateOptions { price, ..Default::default() };
        let panels = [panel(&boundary, &triangulate_options, &motions)];
        let options = VaryOptions { leave_developable: false, ..Default::default() };
        let run = || vary(&panels, &limit, &options, &mut Unwatched).unwrap();
        let found = run();
        assert_eq!(found, run(), "the same bits every time");
        let after = &found.panels[0];
        for (i, unknown) in unknown.iter().enumerate() {
            let (from, to) = (boundary.samples()[i], after.boundary.samples()[i]);
            let moved = from.position.distance(to.position);
            assert!((moved - after.moved_mm[i]).abs() == 0.0);
            match unknown {
                None => assert_eq!(from.position, to.position),
                Some(_) => assert!(seed % 4 < 2 || moved <= 0.1 * total_mm + 1e-9 * size),
            }
        }
        if seed % 4 < 2 {
            let spent = found.moved_total_mm;
            assert!(spent <= total_mm + 1e-9 * size, "{spent} {total_mm}");
        }
        assert!(found.prices.windows(2).all(|pair| pair[1] < pair[0]), "{:?}", found.prices);
        assert!(found.twists.windows(2).all(|pair| pair[1] <= pair[0]), "{:?}", found.twists);
        gained += usize::from(found.prices.len() > 1);
        // The price that is told is that of the moved boundary, triangulated anew.
        let plane = after.plane.as_ref();
        let anew =
            triangulate(&after.boundary, plane, &triangulate_options, &mut Unwatched).unwrap();
        assert_eq!(anew, after.triangulation);
        assert_eq!(anew.price, found.prices[found.prices.len() - 1]);
        assert!(Boundary::new(vec![after.boundary.samples().to_vec()]).is_ok());
    }
    println!("{gained} of {tried} gained");
    assert!(gained * 10 >= tried * 9, "{gained} of {tried}");
}

#[test]
fn developable_boundaries_do_not_move() {
    for blob in blobs() {
        for m in [60, 160] {
            let (boundary, _) = blob.boundary(m);
            for goal in [VaryGoal::Price, VaryGoal::Warp { largest: from_deg(0.5) }] {
                let options = VaryOptions { goal, ..Default::default() };
                let found = varied(&boundary, 0.01 * boundary.size(), &options);
                assert_eq!(found.ended, Ended::NothingToDo, "{} {m}", blob.name);
                assert_eq!(found.panels[0].boundary, boundary);
                assert_eq!((found.moved_max_mm, found.moved_total_mm), (0.0, 0.0));
            }
        }
    }
}

/// A strip 1,000 long and 200 wide that turns about its middle line, with or without corners at the
/// ends of its rails.
fn twisted(turn: f64, samples: usize, corners: bool) -> Boundary {
    let rail = |side: f64, n: usize| {
        let along = n as f64 / (samples - 1) as f64;
        let angle = turn * along;
        let at = Point3::new(1000.0 * along, side * 100.0 * cos(angle), side * 100.0 * sin(angle));
        CurvePoint { at, corner: corners && (n == 0 || n + 1 == samples), move_mm: 0.0 }
    };
    let points: Vec<CurvePoint> = (0..samples)
        .map(|n| rail(-1.0, n))
        .chain((0..samples).rev().map(|n| rail(1.0, n)))
        .collect();
    Boundary::new(vec![samples_from_points(&points)]).unwrap()
}

#[test]
fn a_strip_twisted_by_a_right_angle_says_how_close_it_came() {
    let boundary = twisted(from_deg(90.0), 40, false);
    for share in [0.002, 0.02] {
        let goal = VaryGoal::Warp { largest: from_deg(6.0) };
        let options = VaryOptions { goal, ..Default::default() };
        let found = varied(&boundary, share * boundary.size(), &options);
        println!("{share}: {}", found.ended);
        let Ended::Closest { wanted, before, reached, resisting } = &found.ended else {
            panic!("{:?}", found.ended);
        };
        assert_eq!([*wanted, *before], [from_deg(6.0), found.warp_max_before]);
        assert_eq!(*reached, found.warp_max);
        assert!(wanted < reached && reached <= before && !resisting.is_empty());
        let words = found.ended.to_string();
        assert!(words.contains("above 6.0°") && words.contains("20.9°"), "{words}");
    }
}

/// A wave round a circle, three times up and down.
fn wave() -> Boundary {
    let points: Vec<CurvePoint> = (0..60)
        .map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / 60.0;
            let height = 25.0 * sin(3.0 * angle);
            CurvePoint::smooth(Point3::new(100.0 * cos(angle), 100.0 * sin(angle), height))
        })
        .collect();
    Boundary::new(vec![samples_from_points(&points)]).unwrap()
}

#[test]
fn a_warp_angle_is_reached_by_small_displacements() {
    let boundary = wave();
    let radius_mm = 0.05 * boundary.size();
    let still = VaryOptions { leave_developable: false, ..Default::default() };
    let before = varied(&boundary, 0.0, &still);
    assert_eq!((before.moved_max_mm, &before.ended), (0.0, &Ended::Converged));
    let largest = 0.6 * before.warp_max;
    let goal = VaryGoal::Warp { largest };
    let found = varied(&boundary, radius_mm, &VaryOptions { goal, ..still });
    println!(
        "{:.2}° -> {:.2}°, moved {:.2} of {radius_mm:.2} mm: {}",
        to_deg(before.warp_max),
        to_deg(found.warp_max),
        found.moved_max_mm,
        found.ended
    );
    assert_eq!(found.ended, Ended::Reached);
    assert!(found.warp_max <= largest);
    assert!(found.moved_max_mm > 0.0 && found.moved_max_mm < 0.5 * radius_mm);
}

#[test]
fn a_budget_for_samples_holds_for_control_points() {
    let boundary = wave();
    let m = boundary.len();
    // The first half of the loop follows eight control points, the rest is fixed.
    let shares = |i: usize| match i {
        0..=30 => control_shares(i as f64 / 30.0, 0, 8),
        _ => Vec::new(),
    };
    let motions = motions(&boundary, (0..m).map(shares).collect());
    let total_mm = 0.05 * boundary.size();
    let limit = Limit::budget(total_mm, counted_shares(&motions, 8));
    let triangulate = TriangulateOptions::default();
    let options = VaryOptions { leave_developable: false, ..Default::default() };
    let panels = [panel(&boundary, &triangulate, &motions)];
    let found = vary(&panels, &limit, &options, &mut Unwatched).unwrap();
    println!(
        "{:?} moved {:.2} of {total_mm:.2} mm: {}",
        found.prices, found.moved_total_mm, found.ended
    );
    assert!(found.prices.len() > 1);
    assert!(found.moved_total_mm > 0.0 && found.moved_total_mm <= total_mm + 1e-9);
    for i in 31..m {
        assert_eq!(found.panels[0].boundary.samples()[i].position, boundary.samples()[i].position);
    }
}

#[test]
fn a_seam_stays_one_seam() {
    // Two quarters of a twisted strip, side by side: they share the middle rail.
    let samples = 12;
    let rail = |width: f64, n: usize| {
        let along = n as f64 / (samples - 1) as f64;
        let angle = 0.8 * along + 0.002 * width;
        let corner = n == 0 || n + 1 == samples;
        CurvePoint {
            at: Point3::new(400.0 * along, width * cos(angle), width * sin(angle)),
            corner,
            move_mm: 0.0,
        }
    };
    let half = |low: f64, high: f64| {
        let points: Vec<CurvePoint> = (0..samples)
            .map(|n| rail(low, n))
            .chain((0..samples).rev().map(|n| rail(high, n)))
            .collect();
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    };
    let boundaries = [half(0.0, 80.0), half(80.0, 160.0)];
    let on_seam = [samples..2 * samples, 0..samples];
    let seam_number = |panel: usize, i: usize| if panel == 0 { 2 * samples - 1 - i } else { i };
    let motions: Vec<Vec<Motion>> = (0..2)
        .map(|n| {
            let unknown: Vec<Option<usize>> = (0..2 * samples)
                .map(|i| on_seam[n].contains(&i).then(|| seam_number(n, i)))
                .collect();
            motions_of_samples(&boundaries[n], &unknown)
        })
        .collect();
    let triangulate = TriangulateOptions::default();
    let panels = [0, 1].map(|n| panel(&boundaries[n], &triangulate, &motions[n]));
    let limit = Limit::budget(20.0, vec![1.0; samples]);
    let options = VaryOptions { leave_developable: false, ..Default::default() };
    let found = vary(&panels, &limit, &options, &mut Unwatched).unwrap();
    println!("{:?} {:?} {}", found.prices, found.moved_total_mm, found.ended);
    assert!(found.prices.len() > 1 && found.moved_total_mm > 0.0);
    assert!(found.moved_total_mm <= 20.0 + 1e-9);
    let of = |n: usize| found.panels[n].boundary.samples();
    for i in 0..samples {
        assert_eq!(of(0)[2 * samples - 1 - i].position, of(1)[i].position);
        assert_eq!(of(0)[i].position, boundaries[0].samples()[i].position);
    }
}

#[test]
fn whoever_watches_may_stop() {
    struct Impatient(std::cell::Cell<usize>);
    impl Watch for Impatient {
        fn stop(&self) -> bool {
            let left = self.0.get();
            self.0.set(left.saturating_sub(1));
            left == 0
        }
    }
    let boundary = twisted(from_deg(60.0), 20, true);
    let m = boundary.len();
    let motions = motions_of_samples(&boundary, &(0..m).map(Some).collect::<Vec<_>>());
    let limit = Limit::Each { radii_mm: vec![5.0; m] };
    let triangulate = TriangulateOptions::default();
    let panels = [panel(&boundary, &triangulate, &motions)];
    let mut stopped = 0;
    for patience in (0..400).step_by(7) {
        for goal in [VaryGoal::Price, VaryGoal::Warp { largest: from_deg(3.0) }] {
            let options = VaryOptions { goal, leave_developable: false, ..Default::default() };
            let mut watch = Impatient(std::cell::Cell::new(patience));
            match vary(&panels, &limit, &options, &mut watch) {
                Err(error) => assert_eq!((error, patience < 60), (VaryError::Stopped, true)),
                Ok(found) => stopped += usize::from(found.ended == Ended::Stopped),
            }
        }
    }
    assert!(stopped > 10, "{stopped}");
}

#[test]
fn what_cannot_be_varied_is_refused() {
    let boundary = twisted(0.3, 5, true);
    let m = boundary.len();
    let motions = motions_of_samples(&boundary, &vec![Some(3); m]);
    let triangulate = TriangulateOptions::default();
    let run = |motions: &[Motion], radii_mm: Vec<f64>, goal: VaryGoal| {
        let options = VaryOptions { goal, ..Default::default() };
        let panels = [panel(&boundary, &triangulate, motions)];
        vary(&panels, &Limit::Each { radii_mm }, &options, &mut Unwatched).unwrap_err()
    };
    let unknown = VaryError::Unknown { panel: 0, sample: 0 };
    assert_eq!(run(&motions, vec![1.0; 3], VaryGoal::Price), unknown);
    assert_eq!(run(&motions[1..], vec![1.0; 4], VaryGoal::Price), VaryError::Motions { panel: 0 });
    assert_eq!(run(&motions, vec![-1.0; 4], VaryGoal::Price), VaryError::Limit);
    assert_eq!(run(&motions, vec![f64::NAN; 4], VaryGoal::Price), VaryError::Limit);
    assert_eq!(run(&motions, vec![1.0; 4], VaryGoal::Warp { largest: 0.0 }), VaryError::Limit);
}
