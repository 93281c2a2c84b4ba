//! Every method against all triangulations, enumerated one by one.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright_geometry::boundary::{Boundary, PlaneChoice, supporting_plane};
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Unwatched;
use sheetwright_optimum::cost::{DEFAULT_FOLD, PriceOptions, Prices, TwistForm};
use sheetwright_optimum::rung::Visibility;
use sheetwright_optimum::triangulate::{
    Goal, Method, TriangulateError, TriangulateOptions, Triangulation, triangulate,
};
use sheetwright_shapes::random::{Random, grid, star, tangle};
use std::sync::OnceLock;

type Triangles = Vec<[usize; 3]>;

/// All triangulations of the part of a loop from `i` to `j`.
fn triangulations(i: usize, j: usize) -> Vec<Triangles> {
    if j - i < 2 {
        return vec![vec![]];
    }
    let mut all = Vec::new();
    for k in i + 1..j {
        for left in triangulations(i, k) {
            for right in triangulations(k, j) {
                let mut triangles = vec![[i, k, j]];
                triangles.extend(&left);
                triangles.extend(&right);
                all.push(triangles);
            }
        }
    }
    all
}

/// All triangulations of loops of every size up to 11.
fn all_triangulations() -> &'static [Vec<Triangles>] {
    static ALL: OnceLock<Vec<Vec<Triangles>>> = OnceLock::new();
    ALL.get_or_init(|| (0..=11).map(|m| triangulations(0, usize::max(m, 1) - 1)).collect())
}

/// The price of a side, and its N.
#[derive(Clone, Copy)]
enum Side {
    Edge,
    Hidden,
    WithoutPlanes,
    Rung(f64, Vec3),
}

struct Loop {
    prices: Prices,
    sides: Vec<Vec<Side>>,
}

impl Loop {
    fn new(boundary: &Boundary, choice: PlaneChoice, options: PriceOptions) -> Self {
        let plane = supporting_plane(boundary, choice).unwrap();
        let prices = Prices::new(boundary, plane.as_ref(), options);
        let visibility = Visibility::new(boundary, plane.as_ref());
        let side = |i: usize, j: usize| match prices.planes(i, j) {
            _ if prices.neighbours(i, j) => Side::Edge,
            _ if !visibility.allows(i, j) => Side::Hidden,
            None => Side::WithoutPlanes,
            Some(planes) => Side::Rung(prices.rung(i, j, &planes), planes.mean),
        };
        let m = boundary.len();
        let sides = (0..m)
            .map(|i| (0..m).map(|j| if i < j { side(i, j) } else { Side::Edge }).collect())
            .collect();
        Self { prices, sides }
    }

    /// The price of the triangle i < k < j.
    fn fold(&self, [i, k, j]: [usize; 3]) -> f64 {
        let mean = |a: usize, b: usize| match self.sides[a][b] {
            Side::Rung(_, mean) => mean,
            _ => Vec3::ZERO,
        };
        self.prices.triangle([i, k, j], [mean(i, k), mean(k, j), mean(i, j)])
    }

    /// The price of a triangulation and how many of its rungs have no tangent planes; `None` if a
    /// rung leaves the projection.
    fn price(&self, triangles: &Triangles) -> Option<(f64, usize)> {
        let (mut price, mut forced) = (0.0, 0);
        for &[i, k, j] in triangles {
            // Every rung is the long side of exactly one triangle.
            match self.sides[i][j] {
                Side::Edge => {}
                Side::Hidden => return None,
                Side::WithoutPlanes => {
                    forced += 1;
                    price += 2.0;
                }
                Side::Rung(twist, _) => price += twist,
            }
            price += self.fold([i, k, j]);
        }
        Some((price, forced))
    }

    /// The least price of all triangulations for which `admits` holds; those with rungs without
    /// tangent planes count only if there are no others.
    fn least(&self, admits: impl Fn(&Triangles) -> bool) -> Option<f64> {
        self.least_and_forced(admits).map(|(price, _)| price)
    }

    /// The least price of all triangulations for which `admits` holds, and whether rungs without
    /// tangent planes had to be admitted.
    fn least_and_forced(&self, admits: impl Fn(&Triangles) -> bool) -> Option<(f64, bool)> {
        let all = &all_triangulations()[self.prices.len()];
        let priced: Vec<(f64, usize)> =
            all.iter().filter(|t| admits(t)).filter_map(|t| self.price(t)).collect();
        let least = |list: &mut dyn Iterator<Item = &(f64, usize)>| {
            list.map(|(price, _)| *price).reduce(f64::min)
        };
        least(&mut priced.iter().filter(|(_, forced)| *forced == 0))
            .map(|price| (price, false))
            .or_else(|| least(&mut priced.iter()).map(|price| (price, true)))
    }

    /// The largest twist of the rungs of a triangulation that has a price.
    fn worst(&self, triangles: &Triangles) -> f64 {
        let twist = |&[i, _, j]: &[usize; 3]| match self.sides[i][j] {
            Side::Edge => 0.0,
            Side::WithoutPlanes => 2.0,
            Side::Rung(twist, _) => twist,
            Side::Hidden => panic!("it has no price"),
        };
        triangles.iter().map(twist).fold(0.0, f64::max)
    }

    /// The largest twist and the price of the triangulation whose largest twist is the least, and
    /// of those the cheapest.
    fn least_worst(&self, admits: impl Fn(&Triangles) -> bool) -> Option<(f64, f64)> {
        let all = &all_triangulations()[self.prices.len()];
        let priced: Vec<(usize, f64, f64)> = all
            .iter()
            .filter(|t| admits(t))
            .filter_map(|t| self.price(t).map(|(p, forced)| (forced.min(1), self.worst(t), p)))
            .collect();
        let least = priced.into_iter().reduce(|a, b| if b < a { b } else { a });
        least.map(|(_, worst, price)| (worst, price))
    }

    /// The least possible largest twist, by the plain table.
    fn bottleneck(&self) -> f64 {
        let m = self.prices.len();
        let mut least = vec![vec![0.0f64; m]; m];
        for length in 2..m {
            for i in 0..m - length {
                let j = i + length;
                let parts = (i + 1..j).map(|k| f64::max(least[i][k], least[k][j]));
                let own = match self.sides[i][j] {
                    Side::Edge => 0.0,
                    Side::Rung(twist, _) => twist,
                    Side::Hidden | Side::WithoutPlanes => f64::INFINITY,
                };
                least[i][j] = own.max(parts.fold(f64::INFINITY, f64::min));
            }
        }
        least[0][m - 1]
    }

    /// This loop without its rungs above a twist.
    fn barred(mut self, bar: f64) -> Self {
        for side in self.sides.iter_mut().flatten() {
            if matches!(side, Side::Rung(twist, _) if *twist > bar) {
                *side = Side::Hidden;
            }
        }
        self
    }

    /// Equations (2) and (5) as they are written, over L(i) for the sample `i`: the table of both
    /// sides of every rung, by start and length round the loop.
    fn least_over_rungs_of(&self, i: usize) -> f64 {
        let m = self.prices.len();
        let side = |a: usize, b: usize| match self.sides[a.min(b)][a.max(b)] {
            Side::Edge => 0.0,
            Side::Rung(price, _) => price,
            Side::Hidden | Side::WithoutPlanes => f64::INFINITY,
        };
        let fold = |mut corners: [usize; 3]| {
            corners.sort_unstable();
            self.fold(corners)
        };
        let mut least = vec![vec![0.0; m]; m];
        for length in 2..m {
            for start in 0..m {
                let end = (start + length) % m;
                least[length][start] = (1..length)
                    .map(|part| {
                        let k = (start + part) % m;
                        let left = least[part][start] + side(start, k);
                        let right = least[length - part][k] + side(k, end);
                        left + right + fold([start, k, end])
                    })
                    .fold(f64::INFINITY, f64::min);
            }
        }
        let next = (i + 1) % m;
        let previous = (i + m - 1) % m;
        let cut_off = least[m - 2][next] + side(previous, next) + fold([previous, i, next]);
        (2..m - 1)
            .map(|length| {
                let j = (i + length) % m;
                least[length][i] + least[m - length][j] + side(i, j)
            })
            .fold(cut_off, f64::min)
    }
}

fn has_edge_everywhere(prices: &Prices) -> impl Fn(&Triangles) -> bool {
    move |triangles| {
        triangles.iter().all(|&[i, k, j]| {
            prices.neighbours(i, k) || prices.neighbours(k, j) || prices.neighbours(i, j)
        })
    }
}

fn found(boundary: &Boundary, choice: PlaneChoice, options: &TriangulateOptions) -> Option<f64> {
    solved(boundary, choice, options).map(|found| found.price)
}

fn solved(
    boundary: &Boundary,
    choice: PlaneChoice,
    options: &TriangulateOptions,
) -> Option<Triangulation> {
    let plane = supporting_plane(boundary, choice).unwrap();
    match triangulate(boundary, plane.as_ref(), options, &mut Unwatched) {
        Ok(found) => Some(found),
        Err(TriangulateError::NoneInside) => None,
        Err(error) => panic!("{error}"),
    }
}

/// Boundaries of 5 to 11 samples of all kinds.
fn boundaries(count: u64) -> impl Iterator<Item = Boundary> {
    (0..)
        .filter_map(|seed| {
            let mut random = Random::new(seed);
            let m = 5 + (seed % 7) as usize;
            match seed % 4 {
                0 => star(&mut random, m, 0.0),
                1 => star(&mut random, m, 0.4),
                2 => tangle(&mut random, m, 0.3),
                _ => grid(&mut random, m),
            }
        })
        .take(count as usize)
}

#[test]
fn optimal_and_bridge_are_the_least_of_all() {
    let mut with_plane = 0;
    for boundary in boundaries(200) {
        for choice in [PlaneChoice::Auto, PlaneChoice::None] {
            for fold in [0.0, DEFAULT_FOLD, 0.05] {
                let price = PriceOptions { fold, form: TwistForm::Normalised };
                let mut options = TriangulateOptions { price, ..Default::default() };
                let brute = Loop::new(&boundary, choice, price);
                let least = brute.least_and_forced(|_| true);
                let price = least.map(|(price, _)| price);
                assert_eq!(found(&boundary, choice, &options), price, "optimal {boundary:?}");
                if let Some((least, forced)) = least {
                    let over_rungs = brute.least_over_rungs_of(boundary.len() / 2);
                    assert!(forced || over_rungs == least, "{over_rungs} {least}");
                }
                options.method = Method::Bridge;
                let least = brute.least(has_edge_everywhere(&brute.prices));
                assert_eq!(found(&boundary, choice, &options), least, "bridge {boundary:?}");
            }
            with_plane +=
                usize::from(supporting_plane(&boundary, choice).is_ok_and(|p| p.is_some()));
        }
    }
    assert!(with_plane > 100, "{with_plane}");
}

#[test]
fn the_printed_form_is_minimised_too() {
    for boundary in boundaries(40) {
        let price = PriceOptions { fold: 0.0, form: TwistForm::Printed };
        let options = TriangulateOptions { price, ..Default::default() };
        let least = Loop::new(&boundary, PlaneChoice::None, price).least(|_| true);
        assert_eq!(found(&boundary, PlaneChoice::None, &options), least);
    }
}

#[test]
fn rails_are_the_least_of_all_strips() {
    for (seed, boundary) in boundaries(100).enumerate() {
        let m = boundary.len();
        let first = 1 + seed % (m - 1);
        let joins = |i: usize, j: usize| (i < first) != (j < first);
        for fold in [0.0, DEFAULT_FOLD] {
            let price = PriceOptions { fold, form: TwistForm::Normalised };
            let options =
                TriangulateOptions { method: Method::Rails { first }, price, ..Default::default() };
            let brute = Loop::new(&boundary, PlaneChoice::None, price);
            let least = brute.least(|triangles| {
                triangles.iter().all(|&[i, _, j]| brute.prices.neighbours(i, j) || joins(i, j))
            });
            assert_eq!(found(&boundary, PlaneChoice::None, &options), least, "{seed} {first}");
        }
    }
}

/// The least largest twist of all, and the least price with it, bit by bit.
#[test]
fn the_worst_warp_is_the_least_of_all() {
    let (mut solvable, mut better) = (0, 0);
    let forced = std::cell::Cell::new(0);
    for (seed, boundary) in boundaries(200).enumerate() {
        let m = boundary.len();
        let first = 1 + seed % (m - 1);
        let joins = |i: usize, j: usize| (i < first) != (j < first);
        for (choice, fold, form) in [
            (PlaneChoice::Auto, DEFAULT_FOLD, TwistForm::Normalised),
            (PlaneChoice::None, DEFAULT_FOLD, TwistForm::Normalised),
            (PlaneChoice::None, 0.0, TwistForm::Normalised),
            (PlaneChoice::None, 0.05, TwistForm::Printed),
        ] {
            let price = PriceOptions { fold, form };
            let brute = Loop::new(&boundary, choice, price);
            let check = |method: Method, admits: &dyn Fn(&Triangles) -> bool| {
                let options = TriangulateOptions { method, price, ..Default::default() };
                let cheapest = solved(&boundary, choice, &options);
                let options = TriangulateOptions { goal: Goal::WorstWarp, ..options };
                let found = solved(&boundary, choice, &options);
                let pair = found.as_ref().map(|found| (found.largest_twist, found.price));
                assert_eq!(pair, brute.least_worst(admits), "{method:?} {seed} {boundary:?}");
                let rungs = found.as_ref().map_or(0, |found| found.forced_rungs);
                forced.set(forced.get() + usize::from(rungs > 0));
                (cheapest, found)
            };
            let (cheapest, found) = check(Method::Optimal, &|_| true);
            if let (Some(cheapest), Some(found)) = (cheapest, found) {
                assert!(found.proven_optimal && found.lower_bound == found.price);
                assert!(found.largest_twist <= cheapest.largest_twist);
                assert!(found.price >= cheapest.price);
                solvable += 1;
                better += usize::from(found.largest_twist < cheapest.largest_twist);
            }
            check(Method::Bridge, &has_edge_everywhere(&brute.prices));
            check(Method::Rails { first }, &|triangles| {
                triangles.iter().all(|&[i, _, j]| brute.prices.neighbours(i, j) || joins(i, j))
            });
        }
    }
    let forced = forced.get();
    println!("{solvable} solvable, {better} with a smaller largest twist, {forced} forced");
    assert!(better > 50 && forced > 0);
}

/// Long loops, whose tables are filled up to a guessed bound, against the plain tables.
#[test]
fn bounds_do_not_change_the_worst_warp() {
    for seed in 0..60 {
        let mut random = Random::new(3000 + seed);
        let m = 64 + random.below(60);
        let boundary = match seed % 3 {
            0 => star(&mut random, m, 0.1),
            1 => tangle(&mut random, m, 0.1),
            _ => grid(&mut random, m),
        };
        let Some(boundary) = boundary else { continue };
        for choice in [PlaneChoice::Auto, PlaneChoice::None] {
            for fold in [0.0, DEFAULT_FOLD] {
                let price = PriceOptions { fold, form: TwistForm::Normalised };
                let brute = Loop::new(&boundary, choice, price);
                let worst = brute.bottleneck();
                if worst.is_finite() {
                    let options = TriangulateOptions {
                        price,
                        goal: Goal::WorstWarp,
                        ..TriangulateOptions::default()
                    };
                    let found = solved(&boundary, choice, &options).unwrap();
                    let least = brute.barred(worst).least_over_rungs_of(0);
                    assert_eq!((found.largest_twist, found.price), (worst, least), "{seed}");
                }
            }
        }
    }
}

/// The bound that the table is filled up to is guessed; with every guess, the result is that of the
/// whole table.
#[test]
fn bounds_do_not_change_the_answer() {
    for seed in 0..60 {
        let mut random = Random::new(1000 + seed);
        let m = 64 + random.below(60);
        let boundary = match seed % 3 {
            0 => star(&mut random, m, 0.1),
            1 => tangle(&mut random, m, 0.1),
            _ => grid(&mut random, m),
        };
        let Some(boundary) = boundary else { continue };
        for choice in [PlaneChoice::Auto, PlaneChoice::None] {
            for fold in [0.0, DEFAULT_FOLD] {
                let price = PriceOptions { fold, form: TwistForm::Normalised };
                let options = TriangulateOptions { price, ..Default::default() };
                let brute = Loop::new(&boundary, choice, price);
                let whole = brute.least_over_rungs_of(0);
                if whole.is_finite() {
                    assert_eq!(found(&boundary, choice, &options), Some(whole), "{seed}");
                }
            }
        }
    }
}
