//! How fast the methods are, on one thread: `cargo bench -p sheetwright-optimum`; with `-- holes`,
//! only the domains with holes; with `-- many`, only boundaries of 1,600 and 10,000 samples; with
//! `-- many 100000 blob`, of that many samples, of the families with `blob` in their names. With
//! `--features rayon` all cores share the tables, and times are wall-clock times.
//!
//! Method: for every curve family and every number of samples, the least of five runs (three at
//! 1,600) of the whole of `triangulate`, visibility and bound included. The
//! specification (equation (5) as three nested loops over a square array), without folds, is timed
//! in the same run, so that machines can be compared. Exponents are fitted by least squares through
//! the logarithms of all sizes from 200 on.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // it prints; what fails should stop it

use sheetwright_geometry::boundary::{
    Boundary, PlaneChoice, samples_from_points, supporting_plane,
};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, cos, sin};
use sheetwright_geometry::watch::Unwatched;
use sheetwright_optimum::cost::{DEFAULT_FOLD, PriceOptions};
use sheetwright_optimum::specification;
use sheetwright_optimum::triangulate::{Goal, Method, TriangulateOptions, triangulate};
use sheetwright_shapes::family::Family;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

const SIZES: [usize; 5] = [100, 200, 400, 800, 1600];
const THREADS: &str = if cfg!(feature = "rayon") { "all cores, on the wall" } else { "one thread" };

fn main() {
    if std::env::args().any(|argument| argument == "many") {
        return many();
    }
    holes();
    if std::env::args().any(|argument| argument == "holes") {
        return;
    }
    println!("optimal triangulation, {THREADS}, least of several runs, milliseconds\n");
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
        row("plain, ν = 0", &|b| least_time(b, || plain(b)));
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

/// Boundaries of many samples, one run each, above 1,600 only those near to developable: time,
/// price, and the peak memory of the program so far, where the system tells.
fn many() {
    let sizes: Vec<usize> = std::env::args().filter_map(|size| size.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![1600, 10_000] } else { sizes };
    println!("optimal triangulation of many samples, {THREADS}\n");
    println!(
        "{:<16} {:>7} {:>4} {:>9} {:>12} {:>7} {:>9}",
        "family", "samples", "ν", "s", "price", "proven", "peak, MB"
    );
    for m in sizes {
        for family in Family::ALL {
            if !wanted(&family.name()) {
                continue;
            }
            if m > SIZES[4] && matches!(family, Family::TwistedStrip | Family::Fourier(_)) {
                continue;
            }
            for fold in [0.0, DEFAULT_FOLD] {
                let boundary = family.boundary(m);
                let price = PriceOptions { fold, ..Default::default() };
                let options = TriangulateOptions { price, ..Default::default() };
                let (start, before) = (Instant::now(), processor_seconds());
                let found = triangulate(&boundary, None, &options, &mut Unwatched);
                let used = processor_seconds().zip(before).map(|(after, before)| after - before);
                let name = family.name();
                let time = used.unwrap_or(start.elapsed().as_secs_f64());
                print!("{name:<16} {m:>7} {fold:>4} {time:>9.3} ");
                match found {
                    Ok(found) => print!("{:>12.3e} {:>7}", found.price, found.proven_optimal),
                    Err(error) => print!("{error}"),
                }
                println!(" {:>9}", peak_megabytes().unwrap_or_default());
            }
        }
    }
}

/// Whether the command names this family, or no family.
fn wanted(family: &str) -> bool {
    let names = || Family::ALL.iter().map(|family| family.name());
    let words = || std::env::args().skip(1);
    let is_name = |word: &str| names().any(|name| name.contains(word));
    !words().any(|word| is_name(&word)) || words().any(|word| family.contains(&word))
}

/// The processor time of this thread, seconds, which other work on the machine does not change.
/// `None` where threads share the work.
fn processor_seconds() -> Option<f64> {
    if cfg!(feature = "rayon") {
        return None;
    }
    let stat = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    Some(stat.split(' ').next()?.parse::<f64>().ok()? * 1e-9)
}

fn peak_megabytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().trim_end_matches(" kB").trim().parse::<u64>().ok()? / 1000)
}

/// Rings of two loops of 200 samples, and a bent panel of 4 × 8 with round windows in two rows, 200
/// samples on its rim and 25 on each: time, and relative optimality gap.
fn holes() {
    println!("domains with holes, {THREADS}, least of three runs\n");
    println!("{:<34} {:>9} {:>9} {:>9} {:>9}", "domain", "samples", "ν", "ms", "gap, %");
    let circle = |radius: f64, z: f64| move |t: f64| [radius * cos(t), radius * sin(t), z];
    let wild = |t: f64| [100.0 * cos(t) + 20.0 * cos(2.0 * t), 115.0 * sin(t), 20.0 * sin(3.0 * t)];
    let rings = [
        ("frustum", loops(200, &circle(100.0, 0.0), &[&circle(50.0, 80.0)], 200)),
        ("cylinder, no plane", loops(200, &circle(100.0, 0.0), &[&circle(100.0, 80.0)], 200)),
        ("far from developable", loops(200, &wild, &[&circle(40.0, 90.0)], 200)),
    ];
    type Bent = fn(f64, f64) -> [f64; 3];
    let bent: [(&str, Bent); 3] = [
        ("cylinder", |u, v| [4.0 * sin(u / 4.0), v, 4.0 * cos(u / 4.0)]),
        ("waves both ways", |u, v| [u, v, 0.4 * sin(0.8 * u) * cos(0.9 * v)]),
        ("saddle", |u, v| [u, v, 0.15 * u * v]),
    ];
    let rows = rings.into_iter().map(|(name, boundary)| (name.to_owned(), boundary));
    let panels = bent.into_iter().flat_map(|(name, bent)| {
        [2, 8].map(|windows| (format!("{name}, {windows} windows"), panel(bent, windows)))
    });
    for (name, boundary) in rows.chain(panels) {
        for fold in [0.0, DEFAULT_FOLD] {
            let plane = supporting_plane(&boundary, PlaneChoice::Auto).unwrap();
            let price = PriceOptions { fold, ..Default::default() };
            let options = TriangulateOptions { price, ..Default::default() };
            let (mut least, mut gap) = (f64::INFINITY, None);
            for _ in 0..3 {
                let start = Instant::now();
                let found = triangulate(&boundary, plane.as_ref(), &options, &mut Unwatched);
                least = least.min(start.elapsed().as_secs_f64());
                gap = found.unwrap().gap();
            }
            let gap = gap.map_or("unknown".to_owned(), |gap| format!("{:.2}", 100.0 * gap));
            println!("{name:<34} {:>9} {fold:>9} {:>9.1} {gap:>9}", boundary.len(), least * 1e3);
        }
    }
    println!();
}

/// A closed curve of a parameter that runs round once.
type Closed<'a> = &'a dyn Fn(f64) -> [f64; 3];

/// The boundary of an outer curve of m samples and holes of k, each a function of a parameter that
/// runs round counter-clockwise.
fn loops(m: usize, outer: Closed<'_>, holes: &[Closed<'_>], k: usize) -> Boundary {
    let sampled = |n: usize, curve: Closed<'_>, backwards: bool| {
        let at = |i: usize| {
            let i = if backwards { n - i } else { i };
            let [x, y, z] = curve(TAU * i as f64 / n as f64);
            CurvePoint::smooth(Point3::new(x, y, z))
        };
        samples_from_points(&(0..n).map(at).collect::<Vec<_>>())
    };
    let holes = holes.iter().map(|hole| sampled(k, *hole, true));
    Boundary::new(std::iter::once(sampled(m, outer, false)).chain(holes).collect()).unwrap()
}

/// A rectangle of 8 × 4 with round windows in two rows, bent.
fn panel(bent: impl Fn(f64, f64) -> [f64; 3], windows: usize) -> Boundary {
    let rim = |t: f64| {
        // Round the rectangle from its lower left corner.
        let s = 24.0 * t / TAU;
        let (u, v) = match s {
            s if s < 8.0 => (s - 4.0, -2.0),
            s if s < 12.0 => (4.0, s - 10.0),
            s if s < 20.0 => (16.0 - s, 2.0),
            s => (-4.0, 22.0 - s),
        };
        bent(u, v)
    };
    let columns = windows.div_ceil(2) as f64;
    let window = |n: usize| {
        let (x, y) =
            (((n / 2) as f64 + 0.5) / columns, if n.is_multiple_of(2) { -0.9 } else { 0.85 });
        let bent = &bent;
        move |t: f64| bent(8.0 * x - 4.0 + 0.6 * cos(t), y + 0.5 * sin(t))
    };
    let curves: Vec<_> = (0..windows).map(window).collect();
    let holes: Vec<Closed<'_>> = curves.iter().map(|curve| curve as Closed<'_>).collect();
    loops(200, &rim, &holes, 25)
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

/// The specification, without folds.
fn plain(boundary: &Boundary) -> f64 {
    let price = PriceOptions { fold: 0.0, ..Default::default() };
    specification::cheapest(boundary, None, price).unwrap().price
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
