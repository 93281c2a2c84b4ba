//! Against the dense table, and the bounds against what they bound.

use super::super::{BARRED, EDGE};
use super::*;
use crate::boundary::{Boundary, samples_from_points};
use crate::cost::{PriceOptions, Prices};
use crate::curve::CurvePoint;
use crate::math::{Point3, cos, sin};
use crate::rung::Visibility;
use crate::watch::Unwatched;
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
fn random_boundary(seed: u64) -> Option<Boundary> {
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

fn with_terms<T>(boundary: &Boundary, fold: f64, what: impl FnOnce(&Terms<'_>) -> T) -> T {
    let prices = Prices::new(boundary, None, PriceOptions { fold, ..Default::default() });
    let everything = Visibility::everything();
    what(&Terms::new(&prices, &everything, false))
}

#[test]
fn the_answer_is_that_of_the_dense_table_to_the_last_triangle() {
    let (mut compared, mut tight, mut left) = (0, 0, 0);
    for seed in 0..2400 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let fold = [0.0, 0.1, 1.0][(seed / 8 % 3) as usize];
        let with_debts = seed / 24 % 4 != 0;
        with_terms(&boundary, fold, |terms| {
            let step = Step { memory: 1 << 30, with_debts, least: 12, top: 6, most: 2.0 };
            let Some(found) = step.solve(terms, &mut Unwatched).unwrap() else {
                left += 1;
                return;
            };
            tight += usize::from(found.is_tight);
            let dense = optimal::solve_priced(terms, &mut Unwatched).unwrap();
            assert_eq!(sorted(Some(found.solved)), sorted(dense), "seed {seed}");
            compared += 1;
        });
    }
    assert!(compared > 1500, "{compared} compared, {left} left to the dense table");
    assert!(tight > 200, "{tight} of {compared} with debts that bound the price well");
}

#[test]
fn no_rung_costs_less_than_its_bundle() {
    let mut cones = 0;
    for seed in 0..160 {
        let Some(boundary) = random_boundary(seed) else { continue };
        with_terms(&boundary, 1.0, |terms| {
            for blocks in levels(terms, 6) {
                for a in 0..blocks.len() {
                    for b in a + 2..blocks.len() {
                        let pairs = || {
                            let from = blocks.samples(a);
                            from.flat_map(|i| blocks.samples(b).map(move |j| (i, j)))
                        };
                        let Some(bundle) = blocks.bundle(terms, a, b, 4.0) else {
                            assert!(pairs().all(|(i, j)| terms.side(i, j).price > 4.0));
                            continue;
                        };
                        cones += usize::from(bundle.radius < 1.0 && blocks.samples(a).len() > 1);
                        for side in pairs().map(|(i, j)| terms.side(i, j)) {
                            assert!(side.price >= bundle.least, "{side:?} {bundle:?}");
                            let mean = bundle.mean.map(f64::from);
                            let off = (side.mean - crate::math::Vec3::from_array(mean)).length();
                            let is_known = side.price < f64::INFINITY;
                            assert!(!is_known || off <= f64::from(bundle.radius), "{bundle:?}");
                        }
                    }
                }
            }
        });
    }
    assert!(cones > 10_000, "{cones}");
}

#[test]
fn every_triangle_pays_what_is_asked_less_what_it_owes() {
    // Over all triangles, by the definition; the search for debts looks at few.
    let mut compared = 0;
    for seed in 0..48 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let m = boundary.len();
        if m > 80 {
            continue;
        }
        let fold = [0.0, 1.0][(seed / 8 % 2) as usize];
        with_terms(&boundary, fold, |terms| {
            let Some(known) = optimal::solve_priced(terms, &mut Unwatched).unwrap() else { return };
            let levels = levels(terms, 6);
            let blocks = &levels[levels.len() - 1];
            let alive = Alive::all(blocks.len());
            let Some(debts) = Debts::new(terms, blocks, &alive, &known, &mut Unwatched).unwrap()
            else {
                return;
            };
            let mut owed = vec![vec![0.0; m]; m];
            for (a, row) in owed.iter_mut().enumerate() {
                debts.row(a).for_each(|(b, debt)| row[b] = debt);
            }
            let side = |i: usize, j: usize| if i + 1 == j { EDGE } else { terms.side(i, j) };
            for i in 0..m {
                for k in i + 1..m {
                    for j in k + 1..m {
                        let sides = [side(i, k), side(k, j), side(i, j)];
                        if sides.iter().any(|side| side.price == BARRED.price)
                            || (i == 0 && j + 1 == m)
                        {
                            continue;
                        }
                        let twist: f64 = sides.iter().map(|side| side.price).sum();
                        let pays = 0.5 * twist + terms.fold([i, k, j], sides.map(|side| side.mean));
                        assert!(pays + owed[i][j] >= owed[i][k] + owed[k][j], "{seed} {i} {k} {j}");
                    }
                }
            }
            assert!(debts.bound <= known.price);
            compared += 1;
        });
    }
    assert!(compared > 8, "{compared}");
}
