//! Against what the rest of the loop costs in truth, and against the table without.

use super::super::{Terms, solve_in_table, solve_priced};
use super::*;
use crate::boundary::{Boundary, samples_from_points};
use crate::cost::quantised;
use crate::curve::CurvePoint;
use crate::math::{Point3, cos, sin};
use crate::triangulate::sparse::tests::{random_boundary, with_terms};
use crate::watch::Unwatched;

const UNBOUNDED: Limits = Limits { bound: 0.0, looks: usize::MAX, memory: u64::MAX };

fn outside(table: &Table<'_>, limits: Limits) -> Option<Outside> {
    let open = Open::new(table.terms, limits.bound, None);
    Outside::new(table, &open, limits, &mut Unwatched).unwrap()
}

/// O as it is defined, but with E for w: what is outside of each rung at the least.
fn least_outside(full: &Table<'_>) -> Vec<f64> {
    let m = full.m;
    let mut rests = vec![f64::INFINITY; m * m];
    rests[m - 1] = 0.0;
    for i in 0..m {
        for j in (i + 2..m).rev() {
            let through = rests[i * m + j] + full.terms.side(i, j).price;
            for k in i + 1..j {
                let sides = [full.entry(i, k), full.entry(k, j)];
                let price = through + sides[0] + sides[1];
                if price == f64::INFINITY {
                    continue;
                }
                let fold = full.fold(i, k, j);
                for (side, other) in [(i * m + k, sides[1]), (k * m + j, sides[0])] {
                    rests[side] = rests[side].min(through + other + fold);
                }
            }
        }
    }
    rests
}

#[test]
fn no_rung_has_less_outside_and_the_answer_is_that_of_the_table() {
    let (mut compared, mut left, mut all) = (0, 0, 0);
    for seed in 0..600 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let fold = [0.1, 1.0, 3.0][(seed / 8 % 3) as usize];
        with_terms(&boundary, fold, |terms| {
            let mut full = Table::new(terms);
            let price = full.fill(f64::INFINITY, None, &mut Unwatched, 0.0..1.0).unwrap();
            if price > 100.0 {
                return;
            }
            let rests = least_outside(&full);
            for share in [1.0, 1.5] {
                let bound = quantised(share * price);
                let mut table = Table::new(terms);
                if seed % 2 == 1 {
                    table.registers = pulp::Arch::Scalar;
                }
                let found = outside(&table, Limits { bound, ..UNBOUNDED }).unwrap();
                for (i, j) in (0..table.m).flat_map(|i| (i + 1..table.m).map(move |j| (i, j))) {
                    let rest = found.row(i, j / LANES).map_or(f64::INFINITY, |row| row[j % LANES]);
                    let (entry, least) = (full.entry(i, j), rests[i * table.m + j]);
                    if entry + least <= bound {
                        assert!(rest <= least, "seed {seed}, {i} {j}: {rest} {least}");
                        assert!(found.has(i / LANES, j / LANES), "seed {seed}, {i} {j}");
                    }
                    all += usize::from(entry <= bound);
                    left += usize::from(entry + rest <= bound);
                }
                table.set_outside(found);
                let open = Open::new(terms, bound, None);
                let answer = table.fill_open(&open, &mut Unwatched, 0.0..1.0).unwrap();
                assert_eq!(answer, price, "seed {seed}");
                assert_eq!(table.trace(), full.trace(), "seed {seed}");
                compared += 1;
            }
            // No triangulation costs less than the cheapest.
            let bound = quantised(0.9 * price);
            if bound < price {
                let mut table = Table::new(terms);
                let found = outside(&table, Limits { bound, ..UNBOUNDED });
                table.set_outside(found.unwrap());
                let open = Open::new(terms, bound, None);
                let answer = table.fill_open(&open, &mut Unwatched, 0.0..1.0).unwrap();
                assert_eq!(answer, f64::INFINITY, "seed {seed}");
            }
        });
    }
    assert!(compared > 700 && 10 * left < 9 * all, "{compared}: {left} of {all}");
}

/// A curve on a cone, and one that waves.
fn closed(m: usize) -> [Boundary; 2] {
    let round = |t: f64| {
        let r = 1.0 + 0.1 * cos(3.0 * t);
        let (angle, along) = (1.2 * r * cos(t), 2.0 + 0.8 * r * sin(t));
        Point3::new(0.5 * along * cos(angle), 0.5 * along * sin(angle), 0.866 * along)
    };
    let waving = |t: f64| Point3::new(cos(t), sin(t), 0.3 * sin(3.0 * t));
    let curves: [&dyn Fn(f64) -> Point3; 2] = [&round, &waving];
    curves.map(|curve| {
        let at = |i: usize| curve(std::f64::consts::TAU * i as f64 / m as f64);
        let points: Vec<CurvePoint> = (0..m).map(|i| CurvePoint::smooth(at(i))).collect();
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    })
}

#[test]
fn thinned_loops_show_where_it_is_worth_it() {
    // One sample in the last tile.
    for (boundary, is_worth_it) in closed(1105).iter().zip([true, false]) {
        with_terms(boundary, 1.0, |terms| {
            let plain = solve_priced(terms, &mut Unwatched).unwrap().unwrap();
            let solve = |terms| solve_in_table(terms, true, &mut Unwatched).unwrap().unwrap();
            let found = solve(terms);
            assert_eq!(found.from_outside, Some(is_worth_it));
            assert_eq!(found.solved.price, plain.price);
            assert_eq!(found.solved.triangles, plain.triangles);
        });
    }
}

#[test]
fn it_is_given_up_where_it_takes_too_much_and_stops_when_asked() {
    struct Impatient;

    impl Watch for Impatient {
        fn stop(&self) -> bool {
            true
        }
    }

    let [boundary, _] = closed(400);
    with_terms(&boundary, 1.0, |terms: &Terms<'_>| {
        let bound = solve_priced(terms, &mut Unwatched).unwrap().unwrap().price;
        let table = Table::new(terms);
        let all = outside(&table, Limits { bound, ..UNBOUNDED }).unwrap();
        let (looks, taken) = (all.looks.div_ceil(all.open), all.bytes());
        let least = Outside::least_bytes(25);
        assert!(least < taken && looks > 1, "{least} {taken} {looks}");
        let with = |looks, memory| outside(&table, Limits { bound, looks, memory }).is_some();
        assert!(with(looks, u64::MAX) && !with(looks - 1, u64::MAX));
        // While it is worked out, there are prices, too.
        assert!(with(looks, 100 * taken) && !with(looks, taken) && !with(looks, least - 1));
        let open = Open::new(terms, bound, None);
        let stopped = Outside::new(&table, &open, Limits { bound, ..UNBOUNDED }, &mut Impatient);
        assert_eq!(stopped.err(), Some(TriangulateError::Stopped));
    });
}
