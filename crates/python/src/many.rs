//! Many panels by several threads: a row each, and an error of one is a row too.
//!
//! Threads take panels from one queue, so that none waits for a slow neighbour. Each panel is made
//! by one thread alone, and rows stand in the order of the panels: neither the number of threads
//! nor their order changes a bit. The rows are those of a batch (`sheetwright::make::make_rows`).

use crate::arrays::array_of_points2;
use crate::failure::Failure;
use crate::settings::{Keywords, judging, read_options};
use crate::signals::EVERY;
use crate::source::{BoundArrays, Bounds};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use sheetwright::Watch;
use sheetwright::check::Finding;
use sheetwright::design::Design;
use sheetwright::make::{Judging, MakeError, PanelRow, PanelValues, make_judged, make_rows};
use sheetwright::math::Point2;
use sheetwright::triangulate::on_one_thread;
use sheetwright_files::ReadOptions;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Instant;

/// What is told of a panel in a number: the name of its column, as in `report.json`, and its value,
/// none where there is none.
type Number = (&'static str, fn(&PanelValues) -> Option<f64>);

/// What is told of a panel in numbers.
const NUMBERS: [Number; 9] = [
    ("area_space_mm2", |of| Some(of.area_space_mm2)),
    ("area_flat_mm2", |of| Some(of.area_flat_mm2)),
    ("flat_width_mm", |of| Some(of.flat_width_mm)),
    ("flat_height_mm", |of| Some(of.flat_height_mm)),
    ("outline_length_mm", |of| Some(of.outline_length_mm)),
    ("warp_max_deg", |of| of.warp_max_deg),
    ("bend_radius_min_mm", |of| of.bend_radius_min_mm),
    ("strain_p95", |of| of.strain_p95),
    ("strain_limit", |of| Some(of.strain_limit)),
];

/// The most threads, whatever is asked for: more than any machine of today makes use of.
const MOST_THREADS: usize = 256;

/// What is told of a panel.
struct Row {
    verdict: &'static str,
    /// The codes of its findings, the worst first.
    findings: String,
    numbers: [f64; NUMBERS.len()],
    outline: Vec<Point2>,
    /// Why there is no more to tell; empty where all is well.
    error: String,
    hint: String,
}

impl Row {
    fn of(row: &PanelRow, outline: Vec<Point2>) -> Self {
        let codes: Vec<&str> = row.findings.iter().map(Finding::code).collect();
        Self {
            verdict: row.verdict.name(),
            findings: codes.join(" "),
            numbers: NUMBERS.map(|(_, number)| number(&row.values).unwrap_or(f64::NAN)),
            outline,
            error: String::new(),
            hint: String::new(),
        }
    }

    fn failed(failure: Failure) -> Self {
        Self {
            verdict: "",
            findings: String::new(),
            numbers: [f64::NAN; NUMBERS.len()],
            outline: Vec::new(),
            error: failure.message,
            hint: failure.hint,
        }
    }
}

/// How panels are made.
struct Job {
    options: ReadOptions,
    judging: Judging,
    has_outline: bool,
}

impl Job {
    fn row(&self, bounds: Result<Bounds, Failure>, watch: &mut dyn Watch) -> Row {
        let made = bounds.and_then(|bounds| {
            let design = bounds.design("panel", &self.options)?;
            let made = on_one_thread(|| self.made(&design, watch));
            made.map_err(|error| Failure::of_make(&error, &design))
        });
        match made {
            Ok((rows, outline)) => match &rows[..] {
                [row] => Row::of(row, outline),
                rows => Row::failed(Failure::new(
                    format!("the panel becomes {} parts", rows.len()),
                    "Make it alone, and look at its parts.",
                )),
            },
            Err(failure) => Row::failed(failure),
        }
    }

    /// The rows of a design, and the first outline where outlines are wanted.
    fn made(
        &self,
        design: &Design,
        watch: &mut dyn Watch,
    ) -> Result<(Vec<PanelRow>, Vec<Point2>), MakeError> {
        if !self.has_outline {
            return Ok((make_rows(design, self.judging, watch)?, Vec::new()));
        }
        let made = make_judged(design, self.judging, watch)?;
        let outline = made.parts.first().map(|part| part.piece.outline().to_vec());
        Ok((made.rows(), outline.unwrap_or_default()))
    }
}

/// The watch of a thread: it stops where the call is given up.
struct GivenUp<'a>(&'a AtomicBool);

impl Watch for GivenUp<'_> {
    fn stop(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Makes many panels, and returns columns.
#[pyfunction]
pub(crate) fn solve_many<'py>(
    py: Python<'py>,
    panels: Vec<BoundArrays<'py>>,
    threads: usize,
    has_outline: bool,
    settings: Keywords<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    let job = Job { options: read_options(&settings)?, judging: judging(&settings)?, has_outline };
    let bounds: Vec<_> = panels.iter().map(BoundArrays::copied).collect();
    drop(panels);
    let threads = match threads {
        0 => thread::available_parallelism().map_or(1, usize::from),
        some => some,
    };
    let rows = py.detach(|| rows(&job, bounds, threads))?;
    columns(py, &rows, has_outline)
}

/// The rows of all panels, in their order.
fn rows(job: &Job, bounds: Vec<Result<Bounds, Failure>>, threads: usize) -> PyResult<Vec<Row>> {
    let count = bounds.len();
    let queue = Mutex::new(bounds.into_iter().enumerate());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let given_up = AtomicBool::new(false);
    let (done, arriving) = channel();
    let work = |done: Sender<(usize, Row)>| {
        let mut watch = GivenUp(&given_up);
        while let Some((number, bounds)) = next().filter(|_| !watch.stop()) {
            // The other end is there until all are done.
            let _ = done.send((number, job.row(bounds, &mut watch)));
        }
    };
    thread::scope(|scope| {
        for number in 0..threads.min(count).min(MOST_THREADS) {
            let done = done.clone();
            match thread::Builder::new().spawn_scoped(scope, || work(done)) {
                Ok(_) => {}
                // Where the system has no more of them, those that there are do all.
                Err(_) if number > 0 => break,
                Err(error) => return Err(error.into()),
            }
        }
        drop(done);
        let collected = collected(count, &arriving);
        given_up.store(true, Ordering::Relaxed);
        collected
    })
}

/// The rows as they arrive; between them the interpreter is asked for signals.
fn collected(count: usize, arriving: &Receiver<(usize, Row)>) -> PyResult<Vec<Row>> {
    let mut rows: Vec<Option<Row>> = (0..count).map(|_| None).collect();
    let mut asked = Instant::now();
    loop {
        match arriving.recv_timeout(EVERY) {
            Ok((number, row)) => rows[number] = Some(row),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        if asked.elapsed() >= EVERY {
            Python::attach(|py| py.check_signals())?;
            asked = Instant::now();
        }
    }
    Ok(rows.into_iter().flatten().collect())
}

fn columns<'py>(py: Python<'py>, rows: &[Row], has_outline: bool) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    let texts = |text: fn(&Row) -> &str| PyList::new(py, rows.iter().map(text));
    columns.set_item("verdict", texts(|row| row.verdict)?)?;
    columns.set_item("findings", texts(|row| &row.findings)?)?;
    for (n, (name, _)) in NUMBERS.iter().enumerate() {
        columns.set_item(name, PyArray1::from_iter(py, rows.iter().map(|row| row.numbers[n])))?;
    }
    if has_outline {
        let outlines = rows.iter().map(|row| array_of_points2(py, &row.outline));
        columns.set_item("outline", outlines.collect::<PyResult<Vec<_>>>()?)?;
    }
    columns.set_item("error", texts(|row| &row.error)?)?;
    columns.set_item("hint", texts(|row| &row.hint)?)?;
    Ok(columns)
}
