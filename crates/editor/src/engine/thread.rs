//! The engine on the desktop: one thread for what follows the hand, and one for what takes long.
//!
//! Of what is to be shown, only the newest waits. What takes long and is at work on an older one is
//! stopped at once; what follows the hand, once it has taken too long for that.

use super::work::Work;
use super::{Answer, Detail, Job, PATIENCE, Wake};
use sheetwright::watch::{Stage, Watch};
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
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
        let quick = Desk::new(send.clone(), wake.clone(), PATIENCE);
        let slow = Desk::new(send, wake, Duration::ZERO);
        Self { quick, slow, answers }
    }

    /// Asks for something.
    pub fn ask(&mut self, job: Job) {
        match job {
            Job::Show { detail: Detail::Coarse, .. } => {
                // All that is done at rest for what is shown is outdated, and would only take time
                // from the hand.
                self.slow.drop_shows();
                self.quick.put(job);
            }
            _ => self.slow.put(job),
        }
    }

    /// Stops what takes long, and drops what waits for it. An export that lays parts out goes on
    /// with the best layout so far; returns whether one may go on.
    pub fn stop(&mut self) -> bool {
        self.slow.stop();
        true
    }

    /// Stops everything, for another document.
    pub fn stop_all(&mut self) {
        self.quick.stop();
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
    at_work: Option<AtWork>,
    over: bool,
}

/// A job at work.
struct AtWork {
    is_for_shown: bool,
    orders: Arc<Orders>,
}

/// What is said to a job at work.
#[derive(Default)]
struct Orders {
    /// It is to stop.
    stop: AtomicBool,
    /// Something newer waits.
    outdated: AtomicBool,
}

impl Desk {
    fn new(send: Sender<Answer>, wake: Wake, patience: Duration) -> Self {
        let tray = Arc::new(Tray::default());
        let its = tray.clone();
        let named = std::thread::Builder::new().name("engine".to_owned());
        // Without a thread there are no answers, and the window says that it is still at work.
        let _ = named.spawn(move || work_at(&its, &send, &wake, patience));
        Self { tray }
    }

    fn put(&self, job: Job) {
        if matches!(job, Job::Show { .. }) {
            self.drop_shows();
        }
        self.waiting().jobs.push_back(job);
        self.tray.filled.notify_one();
    }

    /// What is to be shown is outdated.
    fn drop_shows(&self) {
        let mut waiting = self.waiting();
        waiting.jobs.retain(|other| !other.is_for_shown());
        if let Some(at_work) = waiting.at_work.as_ref().filter(|at_work| at_work.is_for_shown) {
            at_work.orders.outdated.store(true, Relaxed);
        }
    }

    fn waiting(&self) -> MutexGuard<'_, Waiting> {
        self.tray.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn stop(&self) {
        let mut waiting = self.waiting();
        waiting.jobs.clear();
        if let Some(at_work) = &waiting.at_work {
            at_work.orders.stop.store(true, Relaxed);
        }
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        self.stop();
        self.waiting().over = true;
        self.tray.filled.notify_one();
    }
}

fn work_at(tray: &Tray, send: &Sender<Answer>, wake: &Wake, patience: Duration) {
    let mut work = Work::default();
    let mut patience_now = patience;
    loop {
        let mut waiting = tray.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.at_work = None;
        while waiting.jobs.is_empty() && !waiting.over {
            waiting = tray.filled.wait(waiting).unwrap_or_else(PoisonError::into_inner);
        }
        let Some(job) = waiting.jobs.pop_front() else { return };
        let orders = Arc::<Orders>::default();
        let is_for_shown = job.is_for_shown();
        waiting.at_work = Some(AtWork { is_for_shown, orders: orders.clone() });
        drop(waiting);
        let mut teller = Teller {
            number: job.number(),
            orders,
            since: Instant::now(),
            patience: patience_now,
            send,
            wake,
            stage: Stage::Sample,
            doing: String::new(),
            told: Instant::now(),
        };
        if let Some(answer) = work.run(&job, &mut teller) {
            patience_now = patience;
            // Nobody listens once the window is closed.
            let _ = send.send(answer);
        } else {
            patience_now = patience_now.saturating_mul(2);
        }
        wake();
    }
}

/// How often progress is told.
const PAUSE: Duration = Duration::from_millis(100);

/// Tells the window how far a job is.
struct Teller<'a> {
    number: u64,
    orders: Arc<Orders>,
    since: Instant,
    patience: Duration,
    send: &'a Sender<Answer>,
    wake: &'a Wake,
    stage: Stage,
    doing: String,
    told: Instant,
}

impl Watch for Teller<'_> {
    fn begin(&mut self, panels: &[&str], stage: Stage) {
        self.stage = stage;
        self.doing = super::doing(panels, stage);
    }

    fn progress(&mut self, done: f64) {
        if self.told.elapsed() >= PAUSE {
            self.told = Instant::now();
            let (number, stage, text) = (self.number, self.stage, self.doing.clone());
            let _ = self.send.send(Answer::Progress { number, stage, text, done });
            (self.wake)();
        }
    }

    fn stop(&self) -> bool {
        let is_outdated = || self.orders.outdated.load(Relaxed);
        self.orders.stop.load(Relaxed) || is_outdated() && self.since.elapsed() >= self.patience
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::tests::saddles;

    #[test]
    fn answers_come_while_the_hand_is_faster_than_they_are() {
        let mut engine = Engine::new(Arc::new(|| {}));
        let begun = Instant::now();
        let mut answers = 0;
        for number in 0.. {
            let design = Arc::new(saddles(10, 96, 40.0 + (number % 100) as f64 * 0.01));
            engine.ask(Job::Show { number, design, detail: Detail::Coarse });
            answers +=
                engine.answers().iter().filter(|a| matches!(a, Answer::Shown { .. })).count();
            if answers == 5 || begun.elapsed() > Duration::from_secs(20) {
                break;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(answers, 5);
    }
}
