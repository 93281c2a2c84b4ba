//! The completion bound against the true price of the rest of the loop, and against the table
//! without it.

use super::super::{Pruned, fill_up_to, solve_priced, solve_within};
use super::*;
use crate::cost::{PriceOptions, Prices, QUANTUM, TwistForm, quantised};
use crate::rung::Visibility;
use crate::test_boundaries::random_boundary;
use crate::triangulate::optimal::table::Table;
use sheetwright_geometry::boundary::{Boundary, samples_from_points};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, Vec3, cos, sin};
use sheetwright_geometry::watch::Unwatched;
use sheetwright_shapes::random::Random;
use std::f64::consts::TAU;

fn with_terms<T>(boundary: &Boundary, fold: f64, what: impl FnOnce(&Terms<'_>) -> T) -> T {
    let prices = Prices::new(boundary, None, PriceOptions { fold, ..Default::default() });
    let everything = Visibility::everything();
    what(&Terms::new(&prices, &everything, false))
}

/// The true price of the rest of the loop beside each rung ⟨i,j⟩, from E of all.
fn rests_in_truth(terms: &Terms<'_>, full: &Table<'_>) -> Vec<f64> {
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
                for (side, other) in [(i * m + k, full.entry(k, j)), (k * m + j, full.entry(i, k))]
                {
                    rests[side] = rests[side].min(through + other + fold);
                }
            }
        }
    }
    rests
}

/// Checks that the bound is never above the true price of the rest of the loop, if the rung is part
/// of a triangulation up to the upper bound, and that it does not change the optimum. Returns the
/// number of entries left with the price as the upper bound, and that of all.
fn check(terms: &Terms<'_>, length: usize, registers: pulp::Arch, what: &str) -> [usize; 2] {
    let mut full = Table::new(terms);
    let price = fill_up_to(&mut full, f64::INFINITY, &mut Unwatched).unwrap();
    let mut counts = [0; 2];
    if price > 60.0 {
        return counts;
    }
    let in_truth = rests_in_truth(terms, &full);
    for share in [0.9, 1.0, 1.5] {
        let bound = quantised(share * price);
        let mut table = Table::new(terms);
        table.registers = registers;
        let spans = Spans::new(terms, bound);
        let runs = Runs::new(terms, length);
        let found = CompletionBound::new(runs, terms, registers, &spans, &mut Unwatched).unwrap();
        for (i, j) in (0..table.m).flat_map(|i| (i + 1..table.m).map(move |j| (i, j))) {
            let (entry, truth) = (full.entry(i, j), in_truth[i * table.m + j]);
            let half = 0.5 * terms.side(i, j).price;
            let rest = found.row(i, j - j % LANES)[j % LANES] - half;
            if entry + truth <= bound {
                assert!(rest <= truth, "{what}, {share}, {i} {j}: {rest} {truth} of {price}");
                let least = found.least(i / LANES, j / LANES);
                assert!(terms.prices.neighbours(i, j) || least < f64::INFINITY, "{what}, {i} {j}");
            }
            if share == 1.0 {
                counts[0] += usize::from(entry + rest <= bound);
                counts[1] += usize::from(entry <= bound);
            }
        }
        let pruned = Pruned { spans, band: None, completion: Some(found) };
        let answer = table.fill(&pruned, &mut Unwatched, 0.0..1.0).unwrap();
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
fn no_rest_costs_less_and_the_answer_is_that_of_the_table() {
    let (mut compared, mut counts) = (0, [0; 2]);
    for seed in 0..480 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let fold = [0.1, 1.0, 3.0][(seed / 8 % 3) as usize];
        let length = [2, 4, 7, 16][(seed / 24 % 4) as usize];
        let registers = if seed / 96 % 2 == 1 { pulp::Arch::Scalar } else { pulp::Arch::new() };
        with_terms(&boundary, fold, |terms| {
            let [left, all] = check(terms, length, registers, &format!("seed {seed}"));
            counts = [counts[0] + left, counts[1] + all];
            compared += usize::from(all > 0);
        });
    }
    let [left, all] = counts;
    assert!(compared > 300 && 10 * left < 9 * all, "{compared}: {left} of {all}");
}

#[test]
fn no_rest_costs_less_where_rungs_are_barred_or_forced() {
    let mut compared = 0;
    for seed in 0..48 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let form = [TwistForm::Normalised, TwistForm::Printed][(seed / 8 % 2) as usize];
        let prices = Prices::new(&boundary, None, PriceOptions { form, ..Default::default() });
        let some = Visibility::of_pairs(boundary.len(), |i, j| (i * 7 + j * 3) % 5 != 0);
        for visibility in [Visibility::everything(), some] {
            for (forced, bar) in [(false, 1.5), (true, f64::INFINITY), (true, 1.5)] {
                let terms = Terms { bar, ..Terms::new(&prices, &visibility, forced) };
                let what = format!("{seed} {forced} {bar}");
                let [_, all] = check(&terms, 4, pulp::Arch::new(), &what);
                compared += usize::from(all > 0);
            }
        }
    }
    assert!(compared > 150, "{compared}");
}

/// Smooth curves on a cone, waving and wild, a patch of a cylinder and a twisted strip with four
/// corners.
fn curves(m: usize) -> Vec<(&'static str, Boundary)> {
    let round = |t: f64| {
        let r = 1.0 + 0.1 * cos(3.0 * t);
        let (angle, along) = (1.2 * r * cos(t), 2.0 + 0.8 * r * sin(t));
        Point3::new(0.5 * along * cos(angle), 0.5 * along * sin(angle), 0.866 * along)
    };
    let waving = |t: f64| Point3::new(cos(t), sin(t), 0.3 * sin(3.0 * t));
    let wild = |t: f64| {
        let z = 0.3 * sin(2.0 * t + 1.0) + 0.2 * sin(3.0 * t) + 0.1 * cos(5.0 * t);
        Point3::new(1.3 * cos(t) + 0.2 * cos(2.0 * t), sin(t), z)
    };
    let round_four = |t: f64| {
        let (side, share) = ((4.0 * t / TAU).floor() as usize % 4, (4.0 * t / TAU).fract());
        [[share, 0.0], [1.0, share], [1.0 - share, 1.0], [0.0, 1.0 - share]][side]
    };
    let patch = |t: f64| {
        let [u, v] = round_four(t);
        Point3::new(cos(2.0 * u - 1.0), sin(2.0 * u - 1.0), 1.6 * v)
    };
    let strip = |t: f64| {
        let [u, v] = round_four(t);
        Point3::new(4.0 * u, (v - 0.5) * cos(1.5 * u), (v - 0.5) * sin(1.5 * u))
    };
    let smooth: [(_, &dyn Fn(f64) -> Point3); 3] =
        [("cone", &round), ("waving", &waving), ("wild", &wild)];
    let cornered: [(_, &dyn Fn(f64) -> Point3); 2] = [("patch", &patch), ("strip", &strip)];
    let smooth = smooth.iter().map(|curve| (curve, 0));
    let all = smooth.chain(cornered.iter().map(|curve| (curve, 4)));
    all.map(|(&(name, curve), corners)| {
        let at = |i: usize| CurvePoint {
            corner: corners > 0 && (corners * i).is_multiple_of(m),
            ..CurvePoint::smooth(curve(TAU * i as f64 / m as f64))
        };
        let samples = samples_from_points(&(0..m).map(at).collect::<Vec<_>>());
        (name, Boundary::new(vec![samples]).unwrap())
    })
    .collect()
}

#[test]
fn no_rest_costs_less_in_tilted_planes_and_where_folds_are_dear() {
    // Where N differs in its last bits, all costs nothing or nearly so.
    let star = |i: usize, m: usize| {
        let t = TAU * i as f64 / m as f64;
        let r = 30.0 + 12.0 * cos(5.0 * t);
        [r * cos(t), r * sin(t), 0.0]
    };
    for seed in 0..48 {
        let m = 60 + 2 * (seed % 5);
        let (a, b) = (0.3 + 0.37 * seed as f64, 1.1 + 0.53 * seed as f64);
        let at = |i: usize| {
            let [x, y, _] = star(i, m);
            let [y, z] = [y * cos(a), y * sin(a)];
            let [x, z] = [x * cos(b) - z * sin(b), x * sin(b) + z * cos(b)];
            CurvePoint::smooth(Point3::new(x, y, z))
        };
        let samples = samples_from_points(&(0..m).map(at).collect::<Vec<_>>());
        let boundary = Boundary::new(vec![samples]).unwrap();
        let (fold, length) = ([1.0, 10.0][seed % 2], [1, 2, 4][seed % 3]);
        with_terms(&boundary, fold, |terms| {
            check(terms, length, pulp::Arch::new(), &format!("tilted {seed}"));
        });
    }
    for (name, boundary) in curves(140) {
        for length in [4, 32, 48] {
            with_terms(&boundary, 10.0, |terms| {
                let [_, all] = check(terms, length, pulp::Arch::new(), name);
                assert!(all > 0, "{name}");
            });
        }
    }
}

#[test]
fn no_rest_costs_less_where_samples_all_but_coincide() {
    // No boundary is built of them, but seams of panels that are joined come as close.
    let (mut random, mut compared) = (Random::new(3), 0);
    for seed in 0..60 {
        let m = 24 + seed % 9;
        let (one, other) = (3 + seed % 5, m / 2 + seed % 7);
        let mut points: Vec<CurvePoint> = (0..m)
            .map(|i| {
                let t = TAU * i as f64 / m as f64;
                let z = 20.0 * sin(2.0 * t) + random.between(-5.0, 5.0);
                CurvePoint::smooth(Point3::new(50.0 * cos(t), 50.0 * sin(t), z))
            })
            .collect();
        let close = [1e-14, 1e-13, 1e-12, 1e-11][seed % 4];
        let off = Vec3::from_array([(); 3].map(|()| random.between(-close, close)));
        points[other].at = points[one].at + off;
        points[one].corner = true;
        points[other].corner = true;
        let prices = Prices::of_ring(&samples_from_points(&points), PriceOptions::default());
        let everything = Visibility::everything();
        for forced in [false, true] {
            let terms = Terms::new(&prices, &everything, forced);
            let [_, all] = check(&terms, 1, pulp::Arch::new(), &format!("close {seed}"));
            compared += usize::from(all > 0);
        }
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn of_curves_few_entries_are_left() {
    // Of a hundred, of those up to the price.
    let most = [("cone", 30), ("waving", 60), ("wild", 80), ("patch", 20), ("strip", 25)];
    for ((name, boundary), (of, most)) in curves(240).iter().zip(most) {
        assert_eq!(*name, of);
        with_terms(boundary, 1.0, |terms| {
            let [left, all] = check(terms, 4, pulp::Arch::new(), name);
            assert!(100 * left < most * all, "{name}: {left} of {all}");
        });
    }
}

#[test]
fn loops_of_many_samples_have_the_answer_of_the_table_without() {
    /// Whether progress never fell, and the last of it.
    struct Onwards(bool, f64);

    impl Watch for Onwards {
        fn progress(&mut self, done: f64) {
            (self.0, self.1) = (self.0 && done >= self.1, done);
        }
    }

    // One sample in the last tile.
    for (name, boundary) in curves(1105) {
        with_terms(&boundary, 1.0, |terms| {
            let mut watch = Onwards(true, 0.0);
            let found = solve_priced(terms, &mut watch).unwrap().unwrap();
            assert!(watch.0 && watch.1 > 0.4, "{name}: {}", watch.1);
            let mut without = Table::new(terms);
            let spans = Spans::new(terms, found.price);
            let pruned = Pruned { spans, band: None, completion: None };
            let price = without.fill(&pruned, &mut Unwatched, 0.0..1.0).unwrap();
            assert_eq!((price, without.trace()), (found.price, found.triangles.clone()), "{name}");
            // With a bound that is known, and with none below it.
            for (share, is_found) in [(1.2, true), (0.9, false)] {
                let again = solve_within(terms, quantised(share * price), &mut Unwatched).unwrap();
                let again = again.map(|again| (again.price, again.triangles));
                assert_eq!(again, is_found.then(|| (price, found.triangles.clone())), "{name}");
            }
        });
    }
}

#[test]
fn it_is_left_out_where_memory_is_short_and_stops_when_asked() {
    struct Impatient;

    impl Watch for Impatient {
        fn stop(&self) -> bool {
            true
        }
    }

    let curves = curves(700);
    with_terms(&curves[0].1, 1.0, |terms| {
        let solved = solve_priced(terms, &mut Unwatched).unwrap().unwrap();
        let (bound, mut plain) = (solved.price, Table::new(terms));
        let spans = Spans::new(terms, bound);
        let pruned = Pruned { spans: Spans::new(terms, bound), band: None, completion: None };
        plain.fill(&pruned, &mut Unwatched, 0.0..1.0).unwrap();
        // What the table takes at last within so much memory, if that is enough.
        let taken = |memory: u64| {
            let few = terms.within(memory);
            let mut table = Table::new(&few);
            match fill_up_to(&mut table, bound, &mut Unwatched) {
                Ok(price) => {
                    assert_eq!((price, table.trace()), (bound, solved.triangles.clone()));
                    Some(table.bytes())
                }
                Err(TriangulateError::TooLarge { limit, .. }) if limit == memory => None,
                Err(error) => panic!("{error}"),
            }
        };
        let runs = CompletionBound::runs(terms);
        let known = CompletionBound::new(runs, terms, plain.registers, &spans, &mut Unwatched);
        let beside = known.unwrap().bytes();
        let all = taken(u64::MAX).unwrap() + beside;
        assert!(all < plain.bytes(), "{all} {}", plain.bytes());
        let needed =
            Table::new(terms).bytes() + CompletionBound::most_bytes(&CompletionBound::runs(terms));
        assert_eq!(taken(needed.max(all)), Some(all - beside));
        let mut refused = 0;
        for memory in [plain.bytes(), needed - 1, needed / 2, all - 1, all / 4] {
            match taken(memory) {
                Some(bytes) => assert!(bytes <= memory, "{bytes} {memory}"),
                None => refused += 1,
            }
        }
        assert!(refused > 0 && refused < 5, "{refused}");
        let stopped = CompletionBound::new(
            CompletionBound::runs(terms),
            terms,
            plain.registers,
            &spans,
            &mut Impatient,
        );
        assert_eq!(stopped.err(), Some(TriangulateError::Stopped));
    });
}

/// How many sides of a triangle are rungs.
fn rungs_of(terms: &Terms<'_>, [a, b, c]: [usize; 3]) -> f64 {
    [(a, b), (b, c), (a, c)].iter().map(|&(a, b)| f64::from(!terms.prices.neighbours(a, b))).sum()
}

/// The close lower bound on the fold price of a triangle with so many rungs on an edge, ν = 1.
fn hardly_less(fold: f64, rungs: f64) -> f64 {
    let cosine = (rungs - fold).max(0.0);
    let x = rungs * rungs - cosine * cosine;
    let less = (x / (2.0 * rungs) * (1.0 + x / (4.0 * rungs * rungs)) - QUANTUM).max(0.0);
    assert!(less <= fold, "{less} {fold} {rungs}");
    assert!(fold > 0.05 || less >= 0.999 * fold - 2.0 * QUANTUM, "{less} {fold} {rungs}");
    less
}

#[test]
fn cells_hold_what_their_rungs_and_triangles_cost() {
    for seed in [1, 2, 4, 11, 12, 20, 26] {
        let Some(boundary) = random_boundary(seed) else { continue };
        with_terms(&boundary, 1.0, |terms| {
            let m = terms.prices.len();
            // Dear rungs and triangles have no bound.
            let bound = 0.3;
            let spans = Spans::new(terms, bound);
            let cells = Cells::new(
                RUNS_OF_BLOCK,
                terms,
                pulp::Arch::new(),
                &spans,
                Runs::new(terms, 5),
                &mut Unwatched,
            )
            .unwrap();
            let (runs, n) = (&cells.runs, cells.runs.len());
            let mut least = vec![[f64::INFINITY; 5]; n * n];
            let of = |i: usize| runs.of(i);
            let lower = |place: &mut f64, price: f64| *place = place.min(price);
            for (i, j) in (0..m).flat_map(|i| (i + 2..m).map(move |j| (i, j))) {
                let side = terms.side(i, j);
                if (i, j) != (0, m - 1) && side.price <= bound {
                    lower(&mut least[of(i) * n + of(j)][0], side.price);
                    let (below, above) = cells.of(of(i), of(j)).normals.extremes();
                    for (axis, x) in side.mean.to_array().into_iter().enumerate() {
                        assert!(below[axis] <= x && x <= above[axis], "seed {seed}, {i} {j}");
                    }
                }
            }
            for (i, x) in (0..m - 1).flat_map(|i| (0..m).map(move |x| (i, x))) {
                if x == i || x == i + 1 {
                    continue;
                }
                let corners = if x < i { [x, i, i + 1] } else { [i, i + 1, x] };
                let [a, b, c] = corners;
                let sides = [(a, b), (b, c), (a, c)].map(|(a, b)| terms.side(a, b));
                if sides.iter().any(|side| side.price > bound) {
                    continue;
                }
                let of_rungs: f64 = sides.iter().map(|side| 0.5 * side.price).sum();
                let fold = terms.fold(corners, sides.map(|side| side.mean));
                let price = of_rungs + hardly_less(fold, rungs_of(terms, corners));
                let far = usize::from(x < i);
                let (own, third) = (of(i), of(x));
                if own != third && (own == of(i + 1) || of(i + 1) != third) {
                    let place = own.min(third) * n + own.max(third);
                    let kind = if own == of(i + 1) { 1 } else { 3 };
                    lower(&mut least[place][kind + far], price);
                }
            }
            let mut told = 0;
            for (a, b) in (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b))) {
                let cell = cells.of(a, b);
                let [rung, first, second, to_first, to_second] = least[a * n + b];
                if (a, b) != (0, n - 1) {
                    assert_eq!(cell.least, rung, "seed {seed}, {a} {b}");
                }
                let are_equal =
                    |one: f64, other: f64| one == other || (one - other).abs() <= 2.0 * QUANTUM;
                assert!(are_equal(cell.on_edges[0], first), "seed {seed}, {a} {b}");
                assert!(are_equal(cell.on_edges[1], second), "seed {seed}, {a} {b}");
                // That from a to b itself has its third corners elsewhere.
                let is_link = b > a + 1;
                assert!(!is_link || are_equal(cell.on_links[0], to_first), "seed {seed}, {a} {b}");
                assert!(are_equal(cell.on_links[1], to_second), "seed {seed}, {a} {b}");
                told += usize::from(first < f64::INFINITY) + usize::from(to_second < f64::INFINITY);
            }
            assert!(told > n, "seed {seed}: {told}");
        });
    }
}

#[test]
fn cells_are_the_same_however_many_blocks_they_are_priced_in() {
    // Corners before, on and after the edges of tiles, and a last tile of one sample.
    for (what, boundary) in [700, 1_024, 1_028, 1_105].into_iter().flat_map(curves) {
        with_terms(&boundary, 1.0, |terms| {
            let registers = pulp::Arch::new();
            let spans = Spans::new(terms, 0.3);
            for length in [16, 32, 48] {
                let in_blocks = |size: usize| {
                    let runs = Runs::new(terms, length);
                    Cells::new(size, terms, registers, &spans, runs, &mut Unwatched).unwrap()
                };
                let (one, n) = (in_blocks(1 << 20), Runs::new(terms, length).len());
                let known = |cells: &Cells, a, b| cells.of(a, b).least < f64::INFINITY;
                let pairs: Vec<_> = (0..n).flat_map(|a| (a..n).map(move |b| (a, b))).collect();
                assert!(pairs.iter().filter(|(a, b)| known(&one, *a, *b)).count() > n, "{what}");
                for rows in [1, 4, 20] {
                    let many = in_blocks(rows);
                    for &(a, b) in &pairs {
                        assert_eq!(many.of(a, b), one.of(a, b), "{what}, {length} {rows}, {a} {b}");
                    }
                }
            }
        });
    }
}

#[test]
fn prices_rounded_up_all_along_lose_no_answer() {
    // Congruent triangles between two arcs, whose prices are all rounded the same way.
    let arcs = 4_000;
    let at = |i: usize| {
        let (u, v) = if i <= arcs { (i, 0.0) } else { (2 * arcs + 1 - i, 1.6) };
        let angle = 2.0 * u as f64 / arcs as f64 - 1.0;
        let corner = i.is_multiple_of(arcs + 1) || (i + 1).is_multiple_of(arcs + 1);
        CurvePoint { corner, ..CurvePoint::smooth(Point3::new(cos(angle), sin(angle), v)) }
    };
    let points: Vec<CurvePoint> = (0..2 * arcs + 2).map(at).collect();
    let boundary = Boundary::new(vec![samples_from_points(&points)]).unwrap();
    for fold in [0.9, 1.2, 1.3] {
        with_terms(&boundary, fold, |terms| {
            let mut table = Table::new(terms);
            let price = fill_up_to(&mut table, 0.01, &mut Unwatched).unwrap();
            assert!(price < 0.01, "{fold}: {price}");
            let again = fill_up_to(&mut table, price, &mut Unwatched).unwrap();
            assert_eq!(again, price, "{fold}");
        });
    }
}
