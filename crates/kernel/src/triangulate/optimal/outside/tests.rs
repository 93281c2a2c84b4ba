//! Against what the rest of the loop costs in truth, and against the table without.

use super::super::{solve_in_table, solve_priced, solve_within};
use super::*;
use crate::boundary::{Boundary, samples_from_points};
use crate::cost::{PriceOptions, Prices, TwistForm, quantised};
use crate::curve::CurvePoint;
use crate::math::{Point3, cos, sin};
use crate::rung::Visibility;
use crate::triangulate::Terms;
use crate::triangulate::sparse::tests::{random_boundary, with_terms};
use crate::watch::Unwatched;

const UNBOUNDED: Limits =
    Limits { bound: 0.0, looks: usize::MAX, left: f64::INFINITY, memory: u64::MAX };

fn outside(table: &Table<'_>, limits: Limits) -> Option<Outside> {
    let open = Open::new(table.terms, limits.bound, None);
    Outside::new(table, &open, limits, &mut Unwatched).unwrap()
}

/// O as it is defined, with what `of` says of third sides: their prices, or E, with which it is what the
/// rest of the loop costs in truth.
fn defined(terms: &Terms<'_>, of: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let m = terms.prices.len();
    let sides: Vec<_> = (0..m * m).map(|at| (at / m, at % m)).collect();
    let sides: Vec<_> = sides.iter().map(|&(i, j)| (i < j).then(|| terms.side(i, j))).collect();
    let mut rests = vec![f64::INFINITY; m * m];
    rests[m - 1] = 0.0;
    for i in 0..m {
        for j in (i + 2..m).rev() {
            let Some(across) = sides[i * m + j] else { continue };
            let through = rests[i * m + j] + across.price;
            for k in i + 1..j {
                let (Some(first), Some(second)) = (sides[i * m + k], sides[k * m + j]) else {
                    continue;
                };
                if through + first.price + second.price == f64::INFINITY {
                    continue;
                }
                let fold = terms.fold([i, k, j], [first.mean, second.mean, across.mean]);
                for (side, other) in [(i * m + k, of(k, j)), (k * m + j, of(i, k))] {
                    rests[side] = rests[side].min(through + other + fold);
                }
            }
        }
    }
    rests
}

/// O of all rungs with O + w up to a bound is as it is defined, no more than what the rest costs in truth,
/// and changes nothing of the answer. Returns how many entries are left of how many.
fn check(terms: &Terms<'_>, registers: pulp::Arch, what: &str) -> [usize; 2] {
    let mut full = Table::new(terms);
    let price = full.fill(f64::INFINITY, None, &mut Unwatched, 0.0..1.0).unwrap();
    let mut counts = [0; 2];
    if price > 100.0 {
        return counts;
    }
    let by_definition = defined(terms, |i, j| terms.side(i, j).price);
    let in_truth = defined(terms, |i, j| full.entry(i, j));
    for share in [0.9, 1.0, 1.5] {
        let bound = quantised(share * price);
        let mut table = Table::new(terms);
        table.registers = registers;
        let found = outside(&table, Limits { bound, ..UNBOUNDED }).unwrap();
        for (i, j) in (0..table.m).flat_map(|i| (i + 1..table.m).map(move |j| (i, j))) {
            let rest = found.row(i, j / LANES).map_or(f64::INFINITY, |row| row[j % LANES]);
            let (at, side, entry) = (i * table.m + j, terms.side(i, j).price, full.entry(i, j));
            if by_definition[at] + side <= bound {
                assert_eq!(rest, by_definition[at], "{what}, {i} {j}");
                assert!(found.has(i / LANES, j / LANES), "{what}, {i} {j}");
            } else {
                assert!(rest + side > bound, "{what}, {i} {j}: {rest}");
            }
            assert!(rest <= in_truth[at] || in_truth[at] + entry > bound, "{what}, {i} {j}");
            counts[0] += usize::from(entry + rest <= bound);
            counts[1] += usize::from(entry <= bound);
        }
        table.set_outside(found);
        let answer = table.fill_open(&Open::new(terms, bound, None), &mut Unwatched, 0.0..1.0);
        let answer = answer.unwrap();
        if price <= bound {
            assert_eq!(answer, price, "{what}");
            assert_eq!(table.trace(), full.trace(), "{what}");
        } else {
            assert_eq!(answer, f64::INFINITY, "{what}");
        }
    }
    counts
}

#[test]
fn it_is_as_defined_and_the_answer_is_that_of_the_table() {
    let (mut compared, mut counts) = (0, [0; 2]);
    for seed in 0..480 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let fold = [0.1, 1.0, 3.0][(seed / 8 % 3) as usize];
        let registers = if seed / 24 % 2 == 1 { pulp::Arch::Scalar } else { pulp::Arch::new() };
        with_terms(&boundary, fold, |terms| {
            let [left, all] = check(terms, registers, &format!("seed {seed}"));
            counts = [counts[0] + left, counts[1] + all];
            compared += usize::from(all > 0);
        });
    }
    let [left, all] = counts;
    assert!(compared > 300 && 10 * left < 9 * all, "{compared}: {left} of {all}");
}

#[test]
fn it_is_as_defined_where_rungs_are_barred_or_forced() {
    let mut compared = 0;
    for seed in 0..48 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let form = [TwistForm::Normalised, TwistForm::Printed][(seed / 8 % 2) as usize];
        let prices = Prices::new(&boundary, None, PriceOptions { form, ..Default::default() });
        let some = Visibility::of_pairs(boundary.len(), |i, j| (i * 7 + j * 3) % 5 != 0);
        for visibility in [Visibility::everything(), some] {
            for (forced, bar) in [(false, 1.5), (true, f64::INFINITY), (true, 1.5)] {
                let terms = Terms { bar, ..Terms::new(&prices, &visibility, forced) };
                let [_, all] = check(&terms, pulp::Arch::new(), &format!("{seed} {forced} {bar}"));
                compared += usize::from(all > 0);
            }
        }
    }
    assert!(compared > 150, "{compared}");
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
fn loops_of_many_samples_have_the_answer_of_the_table() {
    /// Whether progress never fell, and the last of it.
    struct Onwards(bool, f64);

    impl Watch for Onwards {
        fn progress(&mut self, done: f64) {
            (self.0, self.1) = (self.0 && done >= self.1, done);
        }
    }

    let [boundary, _] = closed(4420);
    with_terms(&boundary, 1.0, |terms| {
        let mut watch = Onwards(true, 0.0);
        let found = solve_in_table(terms, false, &mut watch).unwrap().unwrap();
        assert!(watch.0 && watch.1 > 0.4, "{}", watch.1);
        assert_eq!(found.from_outside, Some(true));
        let (price, triangles) = (found.solved.price, found.solved.triangles);
        let mut plain = Table::new(terms);
        assert_eq!(plain.fill(price, None, &mut Unwatched, 0.0..1.0).unwrap(), price);
        assert_eq!(plain.trace(), triangles);
        // With a bound that is known, and with none below it.
        for (bound, is_found) in [(quantised(1.2 * price), true), (quantised(0.9 * price), false)] {
            let found = solve_within(terms, bound, &mut Unwatched).unwrap();
            let found = found.map(|found| (found.price, found.triangles));
            assert_eq!(found, is_found.then(|| (price, triangles.clone())));
        }
        // Where it takes more than is left beside the table, and where it does not.
        let mut given_up = 0;
        for memory in [plain.bytes(), 4 * plain.bytes()] {
            let few = terms.within(memory);
            let mut table = Table::new(&few);
            let found = table.fill_from_outside((price, true), &mut Unwatched, 0.0..1.0).unwrap();
            assert_eq!((found, table.trace()), (price, triangles.clone()));
            assert!(table.bytes() <= memory);
            given_up += usize::from(!table.is_from_outside());
        }
        assert_eq!(given_up, 1);
    });
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
        let with =
            |looks, memory| outside(&table, Limits { bound, looks, memory, ..UNBOUNDED }).is_some();
        assert!(with(looks, u64::MAX) && !with(looks - 1, u64::MAX));
        // While it is worked out, there are prices, too, and then half of it is left for the table.
        assert!(with(looks, 100 * taken) && !with(looks, taken) && !with(looks, least - 1));
        let few = outside(&table, Limits { bound, left: 0.01, ..UNBOUNDED });
        assert!(few.is_none());
        let open = Open::new(terms, bound, None);
        let stopped = Outside::new(&table, &open, Limits { bound, ..UNBOUNDED }, &mut Impatient);
        assert_eq!(stopped.err(), Some(TriangulateError::Stopped));
    });
}
