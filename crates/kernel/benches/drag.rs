//! How fast panels follow a handle that is dragged, on one thread: `cargo bench -p sheetwright
//! --bench drag`; with `-- stages`, where the time goes; with `-- prediction`, the share of a move
//! that the verdict by a formula takes, alone; with a part of a name, that family alone.
//! With `--features rayon` all cores share the tables, and all times are those of the clock on the
//! wall.
//!
//! Method: a panel of 400 samples whose outline is a curve of 24 handles along a curve family, and
//! the published hull of three planks of 400 samples each \[ZB18\]. Ten handles, one after the
//! other, make 100 moves each, by about 0.4 % of the size at a time and up to some 5 % in all;
//! every move ends with surface, pattern, measures and verdict; after every tenth the hand rests,
//! and the same design is made afresh. Then all of it once more with the hand at rest after every
//! move, so that the question that a move leaves open counts, too. What is counted is processor
//! time, where the system tells it, so that other work on the same machine counts as little as can
//! be, and beside it the clock on the wall. The ratio is that of making afresh to a move with the
//! hand at rest, which answers the same.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // it prints; what fails should stop it

use sheetwright::boundary::size_of;
use sheetwright::cost::DEFAULT_FOLD;
use sheetwright::design::Design;
use sheetwright::elastic::screen;
use sheetwright::make::{Live, make};
use sheetwright::watch::{Stage, Unwatched, Watch};
use sheetwright_shapes::drag::{Drag, one_panel, outline};
use sheetwright_shapes::family::Family;
use sheetwright_shapes::hull::planks;
use std::hint::black_box;
use std::time::{Duration, Instant};

const SAMPLES: usize = 400;
const HANDLES: usize = 10;
const MOVES: usize = 100;
/// After so many moves the hand rests, and the design is made afresh, too.
const AFRESH: usize = 10;
/// The formula is asked so often in a row: once takes hardly longer than asking the clock.
const SCREENS: u32 = 8;
/// How far a handle is dragged about where it was, as a share of the size.
const REACH: f64 = 0.02;

fn main() {
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let stages = arguments.iter().any(|argument| argument == "stages");
    let prediction = arguments.iter().any(|argument| argument == "prediction");
    let is_name = |argument: &&String| *argument != "stages" && *argument != "prediction";
    let names: Vec<&String> = arguments.iter().filter(is_name).collect();
    let row = if prediction { prediction_row } else { row };
    let wanted = |name: &str| names.is_empty() || names.iter().any(|part| name.contains(*part));
    let threads = if cfg!(feature = "rayon") { "all cores, on the wall" } else { "one thread" };
    println!("one handle dragged, {threads}, {} moves, milliseconds\n", HANDLES * MOVES);
    if !prediction {
        print_head();
    }
    for fold in [0.0, DEFAULT_FOLD] {
        for family in Family::ALL {
            let name = family.name();
            if wanted(&name) {
                let design = one_panel(outline(family), SAMPLES, fold);
                row(&name, fold, design, stages);
            }
        }
        if wanted("hull") {
            row("hull, 3 planks", fold, planks(SAMPLES / 2, fold), stages);
        }
    }
}

/// The names of the columns of [`row`].
fn print_head() {
    print!("{:<16} {:>4} {:>8} {:>8} {:>8}", "panel", "ν", "median", "99 %", "most");
    print!(" {:>10} {:>10}", "wall, 99 %", "all, 99 %");
    println!(" {:>8} {:>8} {:>6}", "afresh", "ratio", "failed");
}

/// Drags handles of a design and prints which share of a move the formula takes.
fn prediction_row(name: &str, fold: f64, design: Design, _stages: bool) {
    let mut live = Live::new(design, &mut Unwatched);
    let reach = REACH * size(live.design());
    let handles = handles(live.design());
    let (mut moved, mut screened) = (0.0, 0.0);
    for n in 0..HANDLES {
        let [c, p] = handles[n * handles.len() / HANDLES];
        let home = live.design().curves[c].points[p].at;
        let mut drag = Drag::new(home, reach, n as u64);
        for _ in 0..MOVES {
            let start = Time::now();
            let changed = live.move_point(c, p, drag.step(), &mut Unwatched);
            moved += start.elapsed()[0];
            screened += screen_changed(&live, &changed);
        }
        live.move_point(c, p, home, &mut Unwatched);
    }
    let mean = |sum: f64| sum / (HANDLES * MOVES) as f64;
    println!(
        "{name:<16} {fold:>4} a move {:.3}, the formula {:.4}: {:.2} %",
        mean(moved),
        mean(screened),
        100.0 * screened / moved
    );
}

/// How long it takes to predict the strain of panels by the formula, milliseconds.
fn screen_changed(live: &Live, changed: &[usize]) -> f64 {
    let material = live.design().material.as_ref();
    let parts = changed.iter().filter_map(|n| live.panels()[*n].made.as_ref().ok()).flatten();
    let start = Time::now();
    for part in parts {
        for _ in 0..SCREENS {
            black_box(screen(&part.sheet, &part.flat, &part.measures, material));
        }
    }
    start.elapsed()[0] / f64::from(SCREENS)
}

/// The size of a design, mm.
fn size(design: &Design) -> f64 {
    let points = design.curves.iter().flat_map(|curve| &curve.points);
    size_of(points.map(|point| point.at))
}

/// The points of a design, each by its curve and its number there.
fn handles(design: &Design) -> Vec<[usize; 2]> {
    let of_curve = |c: usize| (0..design.curves[c].points.len()).map(move |p| [c, p]);
    (0..design.curves.len()).flat_map(of_curve).collect()
}

/// Drags handles of a design and prints how long that takes.
fn row(name: &str, fold: f64, design: Design, stages: bool) {
    let made = Live::new(design, &mut Unwatched);
    let moved = Dragged::new(made.clone(), false);
    let rested = Dragged::new(made, true);
    let at = |list: &[f64], share: f64| list[((list.len() - 1) as f64 * share).round() as usize];
    let (median, fresh) = (at(&moved.worked, 0.5), at(&rested.afresh, 0.5));
    print!("{name:<16} {fold:>4} {median:>8.2} {:>8.2}", at(&moved.worked, 0.99));
    print!(" {:>8.2} {:>10.2}", at(&moved.worked, 1.0), at(&moved.wall, 0.99));
    print!(
        " {:>10.2} {fresh:>8.2} {:>8.1}",
        at(&rested.worked, 0.99),
        fresh / at(&rested.worked, 0.5)
    );
    println!(" {:>6}", moved.failed);
    if stages {
        let mean =
            |stage: Stage| moved.clock.times[stage as usize] * 1e3 / moved.worked.len() as f64;
        println!(
            "    in the mean: sample {:.2}, solve {:.2}, flatten {:.2}, check {:.2}",
            mean(Stage::Sample),
            mean(Stage::Solve),
            mean(Stage::Flatten),
            mean(Stage::Check)
        );
    }
}

/// How long all moves took, milliseconds in increasing order.
#[derive(Default)]
struct Dragged {
    worked: Vec<f64>,
    wall: Vec<f64>,
    afresh: Vec<f64>,
    /// Moves after which a panel could not be made.
    failed: usize,
    clock: Clock,
}

impl Dragged {
    /// Drags handles, and says what each move takes: with the hand at rest after it, or not.
    fn new(mut live: Live, rests: bool) -> Self {
        let design = live.design();
        let (reach, handles) = (REACH * size(design), handles(design));
        let mut dragged = Self::default();
        for n in 0..HANDLES {
            let [c, p] = handles[n * handles.len() / HANDLES];
            let home = live.design().curves[c].points[p].at;
            let mut drag = Drag::new(home, reach, n as u64);
            for step in 0..MOVES {
                let to = drag.step();
                let start = Time::now();
                live.move_point(c, p, to, &mut dragged.clock);
                if rests {
                    live.settle(&mut dragged.clock);
                }
                dragged.clock.end();
                let [worked, wall] = start.elapsed();
                dragged.worked.push(worked);
                dragged.wall.push(wall);
                let has_failed = live.panels().iter().any(|panel| panel.made.is_err());
                dragged.failed += usize::from(has_failed);
                if step % AFRESH == 0 {
                    live.settle(&mut Unwatched);
                    let start = Time::now();
                    let made = black_box(make(live.design(), &mut Unwatched));
                    dragged.afresh.push(start.elapsed()[0]);
                    assert!(made == live.made(), "the same as made afresh");
                }
            }
            live.move_point(c, p, home, &mut Unwatched);
        }
        for list in [&mut dragged.worked, &mut dragged.wall, &mut dragged.afresh] {
            list.sort_by(f64::total_cmp);
        }
        dragged
    }
}

/// A point in time: of the processor's work for this thread, where the system tells, and on the
/// wall.
struct Time {
    worked: Option<u64>,
    wall: Instant,
}

impl Time {
    fn now() -> Self {
        if cfg!(feature = "rayon") {
            return Self { worked: None, wall: Instant::now() };
        }
        // The system counts up to the last time that the thread was put aside.
        std::thread::sleep(Duration::from_micros(1));
        let status = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
        let worked = status.and_then(|status| status.split(' ').next()?.parse().ok());
        Self { worked, wall: Instant::now() }
    }

    /// What has passed since, milliseconds: of work, and on the wall.
    fn elapsed(&self) -> [f64; 2] {
        let wall = self.wall.elapsed().as_secs_f64() * 1e3;
        let worked = Self::now().worked.zip(self.worked);
        [worked.map_or(wall, |(to, from)| (to - from) as f64 * 1e-6), wall]
    }
}

/// How long stages take, on the wall.
#[derive(Default)]
struct Clock {
    at_work: Option<(Stage, Instant)>,
    times: [f64; 5],
}

impl Clock {
    fn end(&mut self) {
        if let Some((stage, since)) = self.at_work.take() {
            self.times[stage as usize] += since.elapsed().as_secs_f64();
        }
    }
}

impl Watch for Clock {
    fn begin(&mut self, _panels: &[&str], stage: Stage) {
        self.end();
        self.at_work = Some((stage, Instant::now()));
    }
}
