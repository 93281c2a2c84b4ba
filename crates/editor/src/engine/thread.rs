//! The engine on the desktop: one thread for what follows the hand, and one for what takes long.
//!
//! Of what is to be shown, only the newest waits; whatever is at work on an older one is stopped.

use super::work::Work;
use super::{Answer, Detail, Job, Wake};
use sheetwright::watch::{Stage, Watch};
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use web_time::{Duration, Instant};

/// The engine.
pub struct Engine {
    quick: Desk,
    slow: Desk,
    answers: Receiver<Answer>,
}

impl Engine {
    /// Starts the threads. `wake` is called whenever there is an answer.
    pub fn new(wake: Wake) -> Self {
        let (send, answers) = channel();
        Self { quick: Desk::new(send.clone(), wake.clone()), slow: Desk::new(send, wake), answers }
    }

    /// Asks for something.
    pub fn ask(&mut self, job: Job) {
        match job {
            Job::Show { detail: Detail::Coarse, .. } => self.quick.put(job),
            _ => self.slow.put(job),
        }
    }

    /// Stops what is at work, and drops what waits.
    pub fn stop(&mut self) {
        self.slow.stop();
    }

    /// The answers since the last call.
    pub fn answers(&mut self) -> Vec<Answer> {
        self.answers.try_iter().collect()
    }
}

/// A thread with what it is to do.
struct Desk {
    tray: Arc<Tray>,
}

#[derive(Default)]
struct Tray {
    waiting: Mutex<Waiting>,
    filled: Condvar,
}

#[derive(Default)]
struct Waiting {
    jobs: VecDeque<Job>,
    /// What stops the job at work, and whether that job shows something.
    at_work: Option<(Arc<AtomicBool>, bool)>,
    over: bool,
}

impl Desk {
    fn new(send: Sender<Answer>, wake: Wake) -> Self {
        let tray = Arc::new(Tray::default());
        let its = tray.clone();
        let named = std::thread::Builder::new().name("engine".to_owned());
        // Without a thread there are no answers, and the window says that it is still at work.
        let _ = named.spawn(move || work_at(&its, &send, &wake));
        Self { tray }
    }

    fn put(&self, job: Job) {
        let mut waiting = self.tray.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        if matches!(job, Job::Show { .. }) {
            waiting.jobs.retain(|other| !matches!(other, Job::Show { .. }));
            if let Some((stop, true)) = &waiting.at_work {
                stop.store(true, Ordering::Relaxed);
            }
        }
        waiting.jobs.push_back(job);
        self.tray.filled.notify_one();
    }

    fn stop(&self) {
        let mut waiting = self.tray.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.jobs.clear();
        if let Some((stop, _)) = &waiting.at_work {
            stop.store(true, Ordering::Relaxed);
        }
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        self.stop();
        self.tray.waiting.lock().unwrap_or_else(PoisonError::into_inner).over = true;
        self.tray.filled.notify_one();
    }
}

fn work_at(tray: &Tray, send: &Sender<Answer>, wake: &Wake) {
    let mut work = Work::default();
    loop {
        let mut waiting = tray.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.at_work = None;
        while waiting.jobs.is_empty() && !waiting.over {
            waiting = tray.filled.wait(waiting).unwrap_or_else(PoisonError::into_inner);
        }
        let Some(job) = waiting.jobs.pop_front() else { return };
        let stop = Arc::new(AtomicBool::new(false));
        waiting.at_work = Some((stop.clone(), matches!(job, Job::Show { .. })));
        drop(waiting);
        let mut teller = Teller {
            number: job.number(),
            stop,
            send,
            wake,
            doing: String::new(),
            told: Instant::now(),
        };
        if let Some(answer) = work.run(&job, &mut teller) {
            // Nobody listens once the window is closed.
            let _ = send.send(answer);
        }
        wake();
    }
}

/// How often progress is told.
const PAUSE: Duration = Duration::from_millis(100);

/// Tells the window how far a job is.
struct Teller<'a> {
    number: u64,
    stop: Arc<AtomicBool>,
    send: &'a Sender<Answer>,
    wake: &'a Wake,
    doing: String,
    told: Instant,
}

impl Watch for Teller<'_> {
    fn begin(&mut self, panels: &[&str], stage: Stage) {
        self.doing = super::doing(panels, stage);
    }

    fn progress(&mut self, done: f64) {
        if self.told.elapsed() >= PAUSE {
            self.told = Instant::now();
            let text = self.doing.clone();
            let _ = self.send.send(Answer::Progress { number: self.number, text, done });
            (self.wake)();
        }
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}
