//! Work on many threads whose outcomes come in the order of the work, with a limit on what waits.
//!
//! One thread reads, so that a slow source holds up no rows; some work; the one that calls takes
//! the outcomes. An outcome that is early waits for those before it, and reading waits where too
//! much does: so memory stays bounded although single panels take a thousand times as long as
//! others.

use crate::failure::Failure;
use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, Scope};
use std::time::{Duration, Instant};

/// Bytes of the stack of a thread that works: as those of the thread of a program.
const STACK: usize = 8 << 20;

/// Limits of what is done at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// How many threads work.
    pub(super) threads: usize,
    /// The most items that wait or are at work.
    pub(super) items: usize,
    /// The most bytes of those, unless one item has more.
    pub(super) bytes: usize,
    /// The longest time between two calls of `take(None)`, about.
    pub(super) every: Duration,
}

/// Hands `take` the outcomes of the work on all items, in their order, and `None` now and then.
///
/// # Errors
/// The first error among the items or of `take`; outcomes before it are taken.
pub(super) fn in_order<T: Send, R: Send>(
    limits: &Limits,
    items: impl Iterator<Item = Result<T, Failure>> + Send,
    size: fn(&T) -> usize,
    work: impl Fn(T) -> R + Sync,
    mut take: impl FnMut(Option<R>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    if cfg!(target_family = "wasm") {
        return one_by_one(items, work, take);
    }
    let gate = Gate::new(limits);
    let (to_workers, queue) = channel();
    let (done, outcomes) = channel();
    let queue = Mutex::new(queue);
    thread::scope(|scope| {
        // However this ends, the reader does not wait at the gate.
        let _stops = Stops(&gate);
        let reader = Reader { gate: &gate, size, to_workers, done: done.clone() };
        spawn(scope, || reader.read(items))?;
        let help = |done: Sender<Outcome<R>>| {
            let (queue, gate, work) = (&queue, &gate, &work);
            move || work_on(queue, gate, work, &done)
        };
        for n in 0..limits.threads {
            match spawn(scope, help(done.clone())) {
                // Fewer threads do as well.
                Err(failure) if n == 0 => return Err(failure),
                Err(_) => break,
                Ok(()) => {}
            }
        }
        drop(done);
        // Whatever is left to do after an error, is left.
        take_in_order(&outcomes, &gate, limits.every, &mut take)
    })
}

/// The work on the thread that calls, where the system has no others.
fn one_by_one<T, R>(
    items: impl Iterator<Item = Result<T, Failure>>,
    work: impl Fn(T) -> R,
    mut take: impl FnMut(Option<R>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    for item in items {
        take(Some(work(item?)))?;
        take(None)?;
    }
    Ok(())
}

fn spawn<'scope>(
    scope: &'scope Scope<'scope, '_>,
    work: impl FnOnce() + Send + 'scope,
) -> Result<(), Failure> {
    let spawned = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
    spawned.map(drop).map_err(|error| {
        Failure::new(format!("the system starts no thread: {error}"), "End other programs.")
    })
}

/// What came of the item of a number; an error ends the work.
type Outcome<R> = (u64, Result<(usize, R), Failure>);

/// Reads items and hands them out.
struct Reader<'a, T, R> {
    gate: &'a Gate,
    size: fn(&T) -> usize,
    to_workers: Sender<(u64, usize, T)>,
    done: Sender<Outcome<R>>,
}

impl<T, R> Reader<'_, T, R> {
    fn read(self, items: impl Iterator<Item = Result<T, Failure>>) {
        for (number, item) in (0..).zip(items) {
            let sent = match item {
                Ok(item) => {
                    let bytes = (self.size)(&item);
                    self.gate.enter(bytes) && self.to_workers.send((number, bytes, item)).is_ok()
                }
                Err(failure) => {
                    let _ = self.done.send((number, Err(failure)));
                    false
                }
            };
            if !sent {
                break;
            }
        }
    }
}

fn work_on<T, R>(
    queue: &Mutex<Receiver<(u64, usize, T)>>,
    gate: &Gate,
    work: &impl Fn(T) -> R,
    done: &Sender<Outcome<R>>,
) {
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).recv();
    while let Ok((number, bytes, item)) = next() {
        if gate.is_stopped() || done.send((number, Ok((bytes, work(item))))).is_err() {
            break;
        }
    }
}

fn take_in_order<R>(
    outcomes: &Receiver<Outcome<R>>,
    gate: &Gate,
    every: Duration,
    take: &mut impl FnMut(Option<R>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut early = BTreeMap::new();
    let mut next = 0;
    let mut heard = Instant::now();
    loop {
        match outcomes.recv_timeout(every) {
            Ok((number, outcome)) => drop(early.insert(number, outcome)),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
        while let Some(outcome) = early.remove(&next) {
            let (bytes, outcome) = outcome?;
            take(Some(outcome))?;
            gate.leave(bytes);
            next += 1;
        }
        if heard.elapsed() >= every {
            take(None)?;
            heard = Instant::now();
        }
    }
}

/// Stops a gate at the end of a scope.
struct Stops<'a>(&'a Gate);

impl Drop for Stops<'_> {
    fn drop(&mut self) {
        self.0.stop();
    }
}

/// Where items wait to be handed out.
struct Gate {
    most: Inside,
    inside: Mutex<Inside>,
    changed: Condvar,
}

/// What has been handed out and not been taken.
#[derive(Clone, Copy)]
struct Inside {
    items: usize,
    bytes: usize,
    is_stopped: bool,
}

impl Gate {
    fn new(limits: &Limits) -> Self {
        let most = Inside { items: limits.items, bytes: limits.bytes, is_stopped: false };
        let inside = Mutex::new(Inside { items: 0, bytes: 0, is_stopped: false });
        Self { most, inside, changed: Condvar::new() }
    }

    fn lock(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until there is room for an item with so many bytes; `false` if all is stopped.
    fn enter(&self, bytes: usize) -> bool {
        let Inside { items: most_items, bytes: most_bytes, .. } = self.most;
        let is_full = |inside: &mut Inside| {
            let has_room = inside.items < most_items && inside.bytes + bytes <= most_bytes;
            !inside.is_stopped && inside.items > 0 && !has_room
        };
        let waited = self.changed.wait_while(self.lock(), is_full);
        let mut inside = waited.unwrap_or_else(PoisonError::into_inner);
        inside.items += 1;
        inside.bytes += bytes;
        !inside.is_stopped
    }

    fn leave(&self, bytes: usize) {
        let mut inside = self.lock();
        inside.items -= 1;
        inside.bytes -= bytes;
        self.changed.notify_all();
    }

    fn stop(&self) {
        self.lock().is_stopped = true;
        self.changed.notify_all();
    }

    fn is_stopped(&self) -> bool {
        self.lock().is_stopped
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    const LIMITS: Limits =
        Limits { threads: 3, items: 8, bytes: 100, every: Duration::from_millis(5) };

    #[test]
    fn outcomes_come_in_order_and_few_wait() {
        let inside = AtomicUsize::new(0);
        let most = AtomicUsize::new(0);
        let items = (0..500_u64).map(|n| {
            most.fetch_max(inside.fetch_add(1, Ordering::SeqCst), Ordering::SeqCst);
            Ok(n)
        });
        let work = |n: u64| {
            // One in a while takes much longer than those after it.
            thread::sleep(Duration::from_micros(if n.is_multiple_of(50) { 3000 } else { 10 }));
            n * n
        };
        let mut taken = Vec::new();
        let take = |outcome: Option<u64>| {
            if outcome.is_some() {
                inside.fetch_sub(1, Ordering::SeqCst);
            }
            taken.extend(outcome);
            Ok(())
        };
        in_order(&LIMITS, items, |_| 20, work, take).unwrap();
        assert_eq!(taken, (0..500).map(|n| n * n).collect::<Vec<u64>>());
        // Five of them have 100 bytes; one more is read and waits at the gate.
        assert!(most.load(Ordering::SeqCst) <= 6, "{most:?}");
    }

    #[test]
    fn one_thread_takes_an_outcome_after_the_other() {
        let items = [Ok(1), Ok(2), Err(Failure::new("no more", "rest")), Ok(4)].into_iter();
        let mut taken = Vec::new();
        let take = |outcome: Option<u64>| {
            taken.push(outcome);
            Ok(())
        };
        assert_eq!(one_by_one(items, |n| 10 * n, take).unwrap_err().message, "no more");
        assert_eq!(taken, [Some(10), None, Some(20), None]);
    }

    #[test]
    fn an_error_ends_the_work_after_what_comes_before() {
        let items =
            (0..).map(|n| if n == 40 { Err(Failure::new("no more", "rest")) } else { Ok(n) });
        let mut taken = Vec::new();
        let take = |outcome: Option<u64>| {
            taken.extend(outcome);
            Ok(())
        };
        let error = in_order(&LIMITS, items, |_| 1, |n| n, take).unwrap_err();
        assert_eq!((error.message.as_str(), taken.len()), ("no more", 40));
        let full = |outcome: Option<u64>| match outcome {
            Some(20) => Err(Failure::new("the disk is full", "make room")),
            _ => Ok(()),
        };
        let error = in_order(&LIMITS, (0..).map(Ok), |_| 1000, |n| n, full).unwrap_err();
        assert_eq!(error.message, "the disk is full");
    }
}
