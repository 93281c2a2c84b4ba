//! Threads that help the one that computes a table.
//!
//! Helpers are called once for all shared work, and take parts of it until none is left. The thread
//! that called them, the *leader*, begins at once, so that a late helper costs no time until the
//! end, where the leader waits for each. Without the feature `rayon` there are none.

use std::cell::Cell;
#[cfg(feature = "rayon")]
use std::{
    error::Error,
    sync::OnceLock,
    sync::atomic::{AtomicUsize, Ordering},
};

/// Limit of the threads, with the leader: at most twice as many tiles of the table are filled at a
/// time.
pub(super) const MOST_THREADS: usize = if cfg!(feature = "rayon") { 16 } else { 1 };
/// Least number of columns of tiles for each thread: with fewer it would mostly wait, since a
/// diagonal has at most as many tiles as there are columns, and half as many in the mean.
#[cfg(feature = "rayon")]
const LEAST_COLUMNS: usize = 4;

/// Helpers that leaders outside of the pool have called. A leader waits in the end for each that it
/// called, so it must not call one that helps another leader for long; leaders in the pool don't
/// wait for helpers that have not begun.
#[cfg(feature = "rayon")]
static CALLED: AtomicUsize = AtomicUsize::new(0);

thread_local! {
    /// Whether this thread calls no helpers.
    static IS_ALONE: Cell<bool> = const { Cell::new(false) };
}

/// Does some work whose triangulations use the thread that calls alone: for callers that do as
/// much at once as there are cores.
pub fn on_one_thread<R>(work: impl FnOnce() -> R) -> R {
    /// What holds for the thread before, set again even after a panic.
    struct Before(bool);
    impl Drop for Before {
        fn drop(&mut self) {
            IS_ALONE.set(self.0);
        }
    }
    let _before = Before(IS_ALONE.replace(true));
    work()
}

/// Whether the thread that calls is within [`on_one_thread`].
pub fn is_on_one_thread() -> bool {
    IS_ALONE.get()
}

/// Threads that are free, besides the one that leads.
#[cfg(feature = "rayon")]
pub(super) struct Helpers {
    count: usize,
    is_outside: bool,
}

#[cfg(feature = "rayon")]
impl Helpers {
    /// As many free threads of the pool as so many columns of tiles can use, if there are any.
    pub(super) fn call(columns: usize) -> Option<Self> {
        let threads = (columns / LEAST_COLUMNS).min(MOST_THREADS);
        if threads > 1 { Self::up_to(threads - 1) } else { None }
    }

    /// Up to so many of the pool, if there are any.
    fn up_to(most: usize) -> Option<Self> {
        if is_on_one_thread() {
            return None;
        }
        let is_outside = rayon::current_thread_index().is_none();
        if !is_outside {
            let count = most.min(rayon::current_num_threads() - 1);
            return (count > 0).then_some(Self { count, is_outside });
        }
        if !has_started() {
            return None;
        }
        let threads = rayon::current_num_threads();
        let free = |called: usize| most.min(threads - 1).min(threads.saturating_sub(called));
        let (order, more) = (Ordering::Relaxed, |called| Some(called + free(called)));
        let called = CALLED.fetch_update(order, order, more).unwrap_or(threads);
        (free(called) > 0).then(|| Self { count: free(called), is_outside })
    }

    /// Has each of them `help`, while this thread leads.
    pub(super) fn join<R>(&self, help: impl Fn() + Sync, lead: impl FnOnce() -> R) -> R {
        rayon::in_place_scope(|scope| {
            for _ in 0..self.count {
                scope.spawn(|_| help());
            }
            lead()
        })
    }
}

#[cfg(feature = "rayon")]
impl Drop for Helpers {
    fn drop(&mut self) {
        if self.is_outside {
            CALLED.fetch_sub(self.count, Ordering::Relaxed);
        }
    }
}

/// Starts the pool, unless it runs; returns whether it runs. Where the system starts no threads,
/// asking `rayon` for their number would panic.
#[cfg(feature = "rayon")]
fn has_started() -> bool {
    static STARTED: OnceLock<bool> = OnceLock::new();
    *STARTED.get_or_init(|| match rayon::ThreadPoolBuilder::new().build_global() {
        Ok(()) => true,
        // Else it has run before.
        Err(error) => error.source().is_none(),
    })
}

/// None.
#[cfg(not(feature = "rayon"))]
pub(super) enum Helpers {}

#[cfg(not(feature = "rayon"))]
impl Helpers {
    pub(super) fn call(_columns: usize) -> Option<Self> {
        None
    }

    pub(super) fn join<R>(&self, _help: impl Fn() + Sync, _lead: impl FnOnce() -> R) -> R {
        match *self {}
    }
}

#[cfg(all(test, feature = "rayon"))]
mod tests {
    use super::*;

    #[test]
    fn a_thread_that_works_alone_calls_no_helpers() {
        on_one_thread(|| assert!(Helpers::up_to(8).is_none() && is_on_one_thread()));
        assert!(std::panic::catch_unwind(|| on_one_thread(|| panic!("stop"))).is_err());
        assert!(!is_on_one_thread());
    }

    #[test]
    fn no_more_helpers_are_called_than_are_free() {
        let called: Vec<Helpers> = std::iter::from_fn(|| Helpers::up_to(1)).take(1000).collect();
        assert!(called.len() <= rayon::current_num_threads(), "{}", called.len());
        drop(called);
        if rayon::current_num_threads() > 1 {
            while Helpers::up_to(1).is_none() {
                // Other tests have them.
                std::thread::yield_now();
            }
        }
    }
}
