//! Against the dense table, and the bounds against what they bound.

use super::*;
use crate::cost::{PriceOptions, Prices};
use crate::rung::Visibility;
use sheetwright_geometry::boundary::{Boundary, samples_from_points};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, cos, sin};
use sheetwright_geometry::watch::Unwatched;
use std::f64::consts::TAU;

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.next() * n as f64) as usize).min(n - 1)
    }
}

/// Boundaries of all kinds: near to developable, far from it, tied, with straight and with doubled
/// back runs, with corners and without.
pub(in crate::triangulate) fn random_boundary(seed: u64) -> Option<Boundary> {
    let mut random = Random(seed * 7919 + 17);
    for _ in 0..4 {
        random.next();
    }
    let m = 24 + random.below(120);
    let kind = seed % 8;
    let wave: Vec<f64> = (0..12).map(|_| random.next() - 0.5).collect();
    let at = |i: usize, random: &mut Random| {
        let t = TAU * i as f64 / m as f64;
        let bent = |u: f64, v: f64| {
            let angle = u * (0.5 + wave[0]);
            [40.0 * sin(angle), 40.0 * v, 40.0 * cos(angle)]
        };
        match kind {
            // Closed smooth curves, with fewer and more waves.
            0 => [50.0 * cos(t), 50.0 * sin(t), 15.0 * sin(3.0 * t)],
            1 | 2 => {
                let size = if kind == 1 { 8.0 } else { 50.0 };
                let z = (0..4).map(|k| wave[k] * sin(f64::from(k as u8 + 1) * t + wave[k + 4]));
                let r = 50.0 + 10.0 * wave[9] * cos(2.0 * t + wave[10]);
                [r * cos(t), r * sin(t), size * z.sum::<f64>()]
            }
            // On a cylinder.
            3 => bent(cos(t), sin(t) * (1.0 + 0.3 * wave[1] * cos(2.0 * t))),
            // Four sides on a cylinder, aligned, so that much is tied.
            4 | 5 => {
                let quarter = m.div_ceil(4);
                let (side, share) = (i / quarter, (i % quarter) as f64 / quarter as f64);
                let (u, v) = match side {
                    0 => (2.0 * share - 1.0, -1.0),
                    1 => (1.0, 2.0 * share - 1.0),
                    2 => (1.0 - 2.0 * share, 1.0),
                    _ => (-1.0, 1.0 - 2.0 * share),
                };
                if kind == 4 { bent(u, v) } else { [30.0 * u, 30.0 * v, 0.0] }
            }
            // Flat, on a grid.
            6 => {
                let r = 20.0 + 8.0 * wave[2] * cos(3.0 * t);
                [(r * cos(t)).round(), (r * sin(t)).round(), 0.0]
            }
            // Hopeless.
            _ => {
                let mut near = |x: f64| x + 6.0 * random.next();
                [near(40.0 * cos(t)), near(40.0 * sin(t)), near(0.0)]
            }
        }
    };
    let corners = random.below(4);
    let points: Vec<CurvePoint> = (0..m)
        .map(|i| {
            let [x, y, z] = at(i, &mut random);
            let is_corner = match corners {
                0 => false,
                1 => i % m.div_ceil(4) == 0,
                2 => random.below(m) < 3,
                _ => kind == 6,
            };
            CurvePoint { corner: is_corner, ..CurvePoint::smooth(Point3::new(x, y, z)) }
        })
        .collect();
    Boundary::new(vec![samples_from_points(&points)]).ok()
}

fn sorted(solved: Option<Solved>) -> Option<(Vec<[usize; 3]>, f64)> {
    solved.map(|mut solved| {
        solved.triangles.sort_unstable();
        (solved.triangles, solved.price)
    })
}

pub(in crate::triangulate) fn with_terms<T>(
    boundary: &Boundary,
    fold: f64,
    what: impl FnOnce(&Terms<'_>) -> T,
) -> T {
    let prices = Prices::new(boundary, None, PriceOptions { fold, ..Default::default() });
    let everything = Visibility::everything();
    what(&Terms::new(&prices, &everything, false))
}

/// No bounds on work.
const UNBOUNDED: Budget = Budget { memory: 1 << 30, work: u64::MAX };

#[test]
fn the_answer_is_that_of_the_dense_table_to_the_last_triangle() {
    let (mut compared, mut without) = (0, 0);
    for seed in 0..2400 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let fold = [0.0, 0.1, 1.0][(seed / 8 % 3) as usize];
        with_terms(&boundary, fold, |terms| {
            let step = Step { least: 12, top: 6 };
            let dense = optimal::solve_priced(terms, &mut Unwatched).unwrap();
            match step.solve(terms, &UNBOUNDED, &mut Unwatched).unwrap() {
                Some(found) => {
                    assert_eq!(sorted(Some(found.solved)), sorted(dense), "seed {seed}");
                    compared += 1;
                }
                None => without += 1,
            }
        });
    }
    assert!(compared > 1500, "{compared} compared, {without} left to the dense table");
}

#[test]
fn surpluses_are_no_larger_than_they_are() {
    // Against equation (5) as it is written, over all rungs.
    let mut compared = 0;
    for seed in 0..200 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let m = boundary.len();
        if m > 70 {
            continue;
        }
        let fold = [0.0, 1.0][(seed / 8 % 2) as usize];
        with_terms(&boundary, fold, |terms| {
            let Some(known) = optimal::solve_priced(terms, &mut Unwatched).unwrap() else { return };
            let asks = asks(terms, &known);
            assert_eq!(asks.iter().sum::<f64>(), known.price);
            let levels = levels(terms, 6);
            let most = asks.iter().copied().fold(0.0, f64::max);
            let mut random = Random(seed);
            let owed: Vec<f64> = (0..m).map(|_| halves(most * (1.0 + random.next()))).collect();
            let rungs = listed(terms, &levels, &owed, u64::MAX, &mut Unwatched).unwrap().unwrap();
            let proof = Proof::new(&asks, owed, halves(0.1 * known.price));
            let aim = Aim::Proof(&proof);
            let table = Table::fill(terms, &rungs, aim, &UNBOUNDED, &mut Unwatched).unwrap();
            let table = table.unwrap();
            if table.owed.iter().zip(&proof.owed).any(|(found, owed)| found > owed) {
                return;
            }
            // The least that is paid inside, with half of the rung's own price, by second sample.
            let side = |i: usize, j: usize| terms.side(i, j);
            let mut inside = vec![vec![0.0; m]; m];
            let mut surplus = vec![vec![0.0; m]; m];
            for i in (0..m).rev() {
                for j in i + 1..m {
                    let ask: f64 = asks[i..j].iter().sum();
                    if j > i + 1 {
                        let own = side(i, j);
                        let through = |k: usize| {
                            let sides = [side(i, k), side(k, j), own];
                            let fold = terms.fold([i, k, j], sides.map(|side| side.mean));
                            let half: f64 = sides.iter().map(|side| 0.5 * side.price).sum();
                            inside[i][k] + inside[k][j] + half + fold
                        };
                        inside[i][j] = (i + 1..j).map(through).fold(f64::INFINITY, f64::min);
                    }
                    surplus[i][j] = inside[i][j] - ask;
                }
            }
            for i in 0..m {
                for (j, &surplus) in surplus[i].iter().enumerate().skip(i + 2) {
                    if i == 0 && j + 1 == m {
                        continue;
                    }
                    match table.surplus_of(i, j) {
                        Some(bound) => assert!(bound <= surplus, "{seed} {i} {j}"),
                        None => assert!(surplus > 0.0, "{seed} {i} {j}"),
                    }
                }
            }
            compared += 1;
        });
    }
    assert!(compared > 20, "{compared}");
}

#[test]
fn all_cheap_rungs_are_listed() {
    let (mut count, mut pairs) = (0, 0);
    for seed in 0..240 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let m = boundary.len();
        with_terms(&boundary, 1.0, |terms| {
            let mut random = Random(seed);
            let size = [0.0, 1e-4, 1e-2][(seed / 8 % 3) as usize];
            let owed: Vec<f64> = (0..m).map(|_| size * random.next()).collect();
            for lowest in 0..4 {
                let levels = levels(terms, 6);
                let levels = &levels[lowest.min(levels.len() - 1)..];
                let rungs =
                    listed(terms, levels, &owed, u64::MAX, &mut Unwatched).unwrap().unwrap();
                for a in 0..m {
                    let is_cheap = |b: &usize| {
                        (a > 0 || b + 1 < m)
                            && terms.side(a, *b).price <= 2.0 * (owed[a] + owed[*b])
                    };
                    let cheap: Vec<u32> = (a + 2..m).filter(is_cheap).map(|b| b as u32).collect();
                    assert_eq!(rungs[a], cheap, "seed {seed}, sample {a}");
                    count += cheap.len();
                }
                pairs += m * (m - 1) / 2;
            }
        });
    }
    assert!(count > 10_000 && count < pairs / 2, "{count} of {pairs}");
}

#[test]
fn what_takes_more_than_the_budget_is_given_up() {
    let boundary = random_boundary(1).unwrap();
    with_terms(&boundary, 1.0, |terms| {
        let step = Step { least: 12, top: 6 };
        for budget in [Budget { memory: 1000, ..UNBOUNDED }, Budget { work: 100, ..UNBOUNDED }] {
            let solved = step.solve(terms, &budget, &mut Unwatched).unwrap();
            assert!(solved.is_none());
        }
        assert!(step.solve(terms, &UNBOUNDED, &mut Unwatched).unwrap().is_some());
    });
}
