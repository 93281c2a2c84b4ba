//! The engine in the browser: one worker for what follows the hand, and one for what takes long.
//!
//! A page has one thread, and a page that computes is a page that hangs. So jobs and answers cross
//! to workers as bytes. Nothing reaches a worker while it computes: to stop one is to end it, and
//! to begin another, which runs the program that the page has compiled.
//!
//! ```text
//! page                         worker
//! the program, compiled  ───►  worker.js starts it
//!                        ◄───  nothing: free
//! a job                  ───►
//!                        ◄───  progress …, an answer
//!                        ◄───  nothing: free
//! ```

use super::shown::ShownPanel;
use super::wire::{answer_bytes, answer_of, job_bytes, job_of};
use super::work::Work;
use super::{Answer, Detail, Job, PATIENCE, Refusal, Wake};
use js_sys::Uint8Array;
use sheetwright::watch::{Stage, Watch};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use web_sys::{DedicatedWorkerGlobalScope, MessageEvent, Worker, WorkerOptions, WorkerType};
use web_time::{Duration, Instant};

/// What the workers run; it lies beside the page.
const SCRIPT: &str = "worker.js";
/// Workers that fail before they did anything, one after the other, until no more are begun.
const TRIES: u32 = 3;
/// How often progress is told.
const PAUSE: Duration = Duration::from_millis(100);

/// The engine.
#[derive(Debug)]
pub struct Engine {
    quick: Desk,
    slow: Desk,
    answers: Rc<RefCell<Vec<Answer>>>,
}

impl Engine {
    /// Starts the workers. `wake` is called whenever there is an answer.
    pub fn new(wake: Wake) -> Self {
        let answers: Rc<RefCell<Vec<Answer>>> = Rc::default();
        let teller = Teller { answers: answers.clone(), wake };
        Self { quick: Desk::new(teller.clone()), slow: Desk::new(teller), answers }
    }

    /// Asks for something.
    pub fn ask(&mut self, job: Job) {
        match job {
            Job::Show { detail: Detail::Coarse, .. } => self.quick.put(job),
            _ => self.slow.put(job),
        }
    }

    /// Stops what takes long, and drops what waits for it. An export that lays parts out goes on
    /// with the least effort; returns whether one does.
    pub fn stop(&mut self) -> bool {
        self.slow.stop()
    }

    /// Stops everything, for another document.
    pub fn stop_all(&mut self) {
        self.quick.end();
        self.slow.end();
    }

    /// The answers since the last call.
    pub fn answers(&mut self) -> Vec<Answer> {
        self.answers.take()
    }
}

/// Where answers go to.
#[derive(Clone)]
struct Teller {
    answers: Rc<RefCell<Vec<Answer>>>,
    wake: Wake,
}

impl Teller {
    fn tell(&self, answer: Option<Answer>) {
        self.answers.borrow_mut().extend(answer);
        (self.wake)();
    }
}

/// A worker with what it is to do.
#[derive(Clone)]
struct Desk(Rc<RefCell<Tray>>);

impl std::fmt::Debug for Desk {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Desk").finish_non_exhaustive()
    }
}

struct Tray {
    teller: Teller,
    worker: Option<Hired>,
    jobs: VecDeque<Job>,
    at_work: Option<(Job, Instant)>,
    /// The stage that it has told.
    stage: Option<Stage>,
    /// A new worker has nothing made yet: waiting for an old one soon costs less.
    patience: Duration,
    is_free: bool,
    failures: u32,
    /// What the worker said when it failed.
    fault: String,
}

/// A worker, with what listens to it: both end together.
struct Hired {
    worker: Worker,
    _listen: Closure<dyn Fn(MessageEvent)>,
    _fail: Closure<dyn Fn(JsValue)>,
}

impl Drop for Hired {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

impl Desk {
    fn new(teller: Teller) -> Self {
        let desk = Self(Rc::new(RefCell::new(Tray {
            teller,
            worker: None,
            jobs: VecDeque::new(),
            at_work: None,
            stage: None,
            patience: PATIENCE,
            is_free: false,
            failures: 0,
            fault: String::new(),
        })));
        desk.hire();
        desk
    }

    /// Ends the worker, if there is one, and begins another.
    fn hire(&self) {
        let hired = self.hired();
        let mut tray = self.0.borrow_mut();
        tray.is_free = false;
        tray.at_work = None;
        tray.worker = hired.ok();
        if tray.worker.is_none() {
            tray.failures = TRIES;
        }
    }

    fn hired(&self) -> Result<Hired, JsValue> {
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        let worker = Worker::new_with_options(SCRIPT, &options)?;
        // Weak, since the tray holds what listens.
        let tray = Rc::downgrade(&self.0);
        let listen = Closure::<dyn Fn(MessageEvent)>::new(move |event: MessageEvent| {
            if let Some(tray) = tray.upgrade() {
                Self(tray).hear(&event.data());
            }
        });
        let tray = Rc::downgrade(&self.0);
        let fail = Closure::<dyn Fn(JsValue)>::new(move |_| {
            if let Some(tray) = tray.upgrade() {
                Self(tray).failed();
            }
        });
        worker.set_onmessage(Some(listen.as_ref().unchecked_ref()));
        worker.set_onerror(Some(fail.as_ref().unchecked_ref()));
        worker.post_message(&wasm_bindgen::module())?;
        Ok(Hired { worker, _listen: listen, _fail: fail })
    }

    fn put(&self, job: Job) {
        let mut tray = self.0.borrow_mut();
        let mut outdated = false;
        if matches!(job, Job::Show { .. }) {
            tray.jobs.retain(|other| !other.is_for_shown());
            let patience = tray.patience;
            let is_late =
                |(job, since): &(Job, Instant)| job.is_for_shown() && since.elapsed() >= patience;
            outdated = tray.at_work.as_ref().is_some_and(is_late);
            if outdated {
                tray.patience = patience.saturating_mul(2);
            }
        }
        tray.jobs.push_back(job);
        drop(tray);
        if outdated {
            self.hire();
        }
        self.next();
    }

    /// Stops what is at work. A layout can't be had of a worker that is ended: another makes it
    /// with the least effort. Returns whether it does.
    fn stop(&self) -> bool {
        let cut_short = {
            let mut tray = self.0.borrow_mut();
            tray.jobs.clear();
            let Some((job, _)) = &tray.at_work else { return false };
            job.cut_short(tray.stage)
        };
        let goes_on = cut_short.is_some();
        self.0.borrow_mut().jobs.extend(cut_short);
        self.hire();
        goes_on
    }

    /// Ends what is at work, whatever it is.
    fn end(&self) {
        self.0.borrow_mut().jobs.clear();
        if self.0.borrow().at_work.is_some() {
            self.hire();
        }
    }

    /// Hands over the next job, if the worker is free.
    fn next(&self) {
        let mut tray = self.0.borrow_mut();
        if tray.failures >= TRIES {
            let answers = std::mem::take(&mut tray.jobs);
            let fault = tray.fault.clone();
            let teller = tray.teller.clone();
            drop(tray);
            answers.iter().for_each(|job| teller.tell(Some(refused(job, &fault))));
            return;
        }
        if !tray.is_free {
            return;
        }
        let Some(job) = tray.jobs.pop_front() else { return };
        let bytes = Uint8Array::from(&job_bytes(&job)[..]);
        let sent = tray.worker.as_ref().map(|hired| hired.worker.post_message(&bytes));
        tray.is_free = false;
        tray.at_work = Some((job, Instant::now()));
        tray.stage = None;
        drop(tray);
        if !matches!(sent, Some(Ok(()))) {
            self.failed();
        }
    }

    /// The worker says something.
    fn hear(&self, data: &JsValue) {
        if let Some(fault) = data.as_string() {
            self.0.borrow_mut().fault = fault;
            return;
        }
        let bytes = Uint8Array::new(data).to_vec();
        if bytes.is_empty() {
            let mut tray = self.0.borrow_mut();
            tray.is_free = true;
            // Free after a job, not at its beginning.
            if tray.at_work.take().is_some() {
                tray.failures = 0;
                tray.patience = PATIENCE;
            }
            drop(tray);
            self.next();
            return;
        }
        let (teller, answer) = (self.0.borrow().teller.clone(), answer_of(&bytes));
        if let Some(Answer::Progress { stage, .. }) = &answer {
            self.0.borrow_mut().stage = Some(*stage);
        }
        teller.tell(answer);
    }

    /// The worker can't go on: its job is answered, and the next gets another worker.
    fn failed(&self) {
        let mut tray = self.0.borrow_mut();
        tray.failures += 1;
        let job = tray.at_work.take();
        let (teller, fault, failures) = (tray.teller.clone(), tray.fault.clone(), tray.failures);
        drop(tray);
        if let Some((job, _)) = job {
            teller.tell(Some(refused(&job, &fault)));
        }
        if failures < TRIES {
            self.hire();
        } else {
            self.0.borrow_mut().worker = None;
            self.next();
        }
    }
}

/// The answer to a job that the worker has not survived, or that none could take.
fn refused(job: &Job, fault: &str) -> Answer {
    let error = match fault {
        "" => "the browser does not let this page work beside the drawing".to_owned(),
        fault => format!("the program has a fault: {fault}"),
    };
    let refusal = Refusal::new(&error, "Save your work to a file and load the page again.");
    match job {
        Job::Show { number, design, detail } => {
            let panel = |name: &String| {
                let (name, made) = (name.clone(), Err(refusal.clone()));
                ShownPanel { name: name.clone(), panel: name, made }
            };
            let panels = design.panels_to_make().iter().map(|made| panel(&made.name)).collect();
            Answer::Shown { number: *number, detail: *detail, panels }
        }
        // There is no advice then, and the panels are shown.
        Job::Advise { number, .. } => {
            Answer::Advised { number: *number, advice: Vec::new(), is_over: true }
        }
        Job::Vary { number, .. } => Answer::Varied { number: *number, outcome: Err(refusal) },
        Job::Export { number, .. } => Answer::Files { number: *number, outcome: Err(refusal) },
    }
}

/// Begins the worker's side: called by its script, in the worker, once the program is there.
#[wasm_bindgen]
pub fn worker_main() {
    let scope: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    std::panic::set_hook(Box::new(|info| {
        let page: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
        let _ = page.post_message(&JsValue::from_str(&info.to_string()));
    }));
    let (page, mut work) = (scope.clone(), Work::default());
    let free = || Uint8Array::new_with_length(0);
    let hear = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        let job = job_of(&Uint8Array::new(&event.data()).to_vec());
        if let Some(job) = job {
            let mut watch = Post {
                page: &page,
                number: job.number(),
                stage: Stage::Sample,
                doing: String::new(),
                told: Instant::now(),
            };
            if let Some(answer) = work.run(&job, &mut watch) {
                post(&page, &answer);
            }
        }
        let _ = page.post_message(&free());
    });
    scope.set_onmessage(Some(hear.as_ref().unchecked_ref()));
    // As long as the worker.
    hear.forget();
    let _ = scope.post_message(&free());
}

fn post(page: &DedicatedWorkerGlobalScope, answer: &Answer) {
    // A page that is gone needs no answer.
    let _ = page.post_message(&Uint8Array::from(&answer_bytes(answer)[..]));
}

/// Tells the page how far a job is.
struct Post<'a> {
    page: &'a DedicatedWorkerGlobalScope,
    number: u64,
    stage: Stage,
    doing: String,
    told: Instant,
}

impl Watch for Post<'_> {
    fn begin(&mut self, panels: &[&str], stage: Stage) {
        self.stage = stage;
        self.doing = super::doing(panels, stage);
    }

    fn progress(&mut self, done: f64) {
        if self.told.elapsed() >= PAUSE {
            self.told = Instant::now();
            let (number, stage, text) = (self.number, self.stage, self.doing.clone());
            post(self.page, &Answer::Progress { number, stage, text, done });
        }
    }

    /// A worker that is to stop is ended by the page.
    fn stop(&self) -> bool {
        false
    }
}
