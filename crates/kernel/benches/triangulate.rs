//! How fast the methods are, on one thread: `cargo bench -p sheetwright`.
//!
//! Method: for every curve family and every number of samples, the least of five runs (three at
//! 1,600) of the whole of `triangulate`, visibility and bound included. The table of a plain
//! programmer (equation (5) as three nested loops over a square array, without folds) is timed in
//! the same run, so that machines can be compared. Exponents are fitted by least squares through
//! the logarithms of all sizes from 200 on.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // it prints; what fails should stop it

use sheetwright::boundary::{Boundary, PlaneChoice, supporting_plane};
use sheetwright::cost::{DEFAULT_FOLD, PriceOptions, Prices};
use sheetwright::triangulate::{Goal, Method, TriangulateOptions, triangulate};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::family::Family;
use std::hint::black_box;
use std::time::Instant;

const SIZES: [usize; 5] = [100, 200, 400, 800, 1600];

fn main() {
    println!("optimal triangulation, one thread, least of several runs, milliseconds\n");
    print!("{:<16} {:<22}", "family", "method");
    SIZES.iter().for_each(|m| print!(" {:>9}", format!("m = {m}")));
    println!(" {:>9}", "exponent");
    for family in Family::ALL {
        let boundaries: Vec<Boundary> = SIZES.iter().map(|&m| family.boundary(m)).collect();
        let row = |method: &str, time: &dyn Fn(&Boundary) -> f64| {
            let times: Vec<f64> = boundaries.iter().map(time).collect();
            print!("{:<16} {method:<22}", family.name());
            times.iter().for_each(|t| print!(" {:>9.2}", t * 1e3));
            println!(" {:>9.2}", exponent(&SIZES[1..], &times[1..]));
        };
        row("plain, ν = 0", &|b| least_time(b, || plain_table(b)));
        let folds =
            [("optimal, ν = 0", 0.0), ("optimal, ν = 0.1", 0.1), ("optimal, ν = 1", DEFAULT_FOLD)];
        for (name, fold) in folds {
            row(name, &|b| least_time(b, || solve(b, Method::Optimal, PlaneChoice::None, fold)));
        }
        row("optimal, ν = 1, plane", &|b| {
            least_time(b, || solve(b, Method::Optimal, PlaneChoice::Auto, DEFAULT_FOLD))
        });
        row("bridge, ν = 1", &|b| {
            least_time(b, || solve(b, Method::Bridge, PlaneChoice::None, DEFAULT_FOLD))
        });
        row("worst warp, ν = 1", &|b| least_time(b, || solve_worst(b)));
    }
}

fn solve_worst(boundary: &Boundary) -> f64 {
    let options = TriangulateOptions { goal: Goal::WorstWarp, ..Default::default() };
    triangulate(boundary, None, &options, &mut Unwatched).unwrap().largest_twist
}

fn solve(boundary: &Boundary, method: Method, plane: PlaneChoice, fold: f64) -> f64 {
    let plane = supporting_plane(boundary, plane).unwrap();
    let price = PriceOptions { fold, ..Default::default() };
    let options = TriangulateOptions { method, price, ..Default::default() };
    triangulate(boundary, plane.as_ref(), &options, &mut Unwatched).unwrap().price
}

/// Equation (5) as it is written.
fn plain_table(boundary: &Boundary) -> f64 {
    let prices = Prices::new(boundary, None, PriceOptions { fold: 0.0, ..Default::default() });
    let m = boundary.len();
    let mut least = vec![0.0; m * m];
    for length in 2..m {
        for i in 0..m - length {
            let j = i + length;
            let mut best = f64::INFINITY;
            for k in i + 1..j {
                best = f64::min(best, least[i * m + k] + least[k * m + j]);
            }
            let rung = match prices.planes(i, j) {
                _ if prices.neighbours(i, j) => 0.0,
                Some(planes) => prices.rung(i, j, &planes),
                None => f64::INFINITY,
            };
            least[i * m + j] = best + rung;
        }
    }
    least[m - 1]
}

fn least_time(boundary: &Boundary, run: impl Fn() -> f64) -> f64 {
    let runs = if boundary.len() >= 1600 { 3 } else { 5 };
    (0..runs)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

#[allow(clippy::disallowed_methods)] // logarithms of times need not be the same bits everywhere
fn exponent(sizes: &[usize], times: &[f64]) -> f64 {
    let x: Vec<f64> = sizes.iter().map(|&m| (m as f64).ln()).collect();
    let y: Vec<f64> = times.iter().map(|t| t.ln()).collect();
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
    let (x_mean, y_mean) = (mean(&x), mean(&y));
    let over: f64 = x.iter().zip(&y).map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    over / x.iter().map(|x| (x - x_mean) * (x - x_mean)).sum::<f64>()
}
