//! Work without the interpreter's lock, which Ctrl-C ends.

use pyo3::prelude::*;
use sheetwright::Watch;
use std::cell::{Cell, OnceCell};
use std::time::{Duration, Instant};

/// How often the interpreter is asked.
pub(crate) const EVERY: Duration = Duration::from_millis(50);

/// A watch that stops the work where a signal raises an exception, such as `KeyboardInterrupt`.
pub(crate) struct Signals {
    asked: Cell<Instant>,
    raised: OnceCell<PyErr>,
}

impl Watch for Signals {
    fn stop(&self) -> bool {
        if self.raised.get().is_none() && self.asked.get().elapsed() >= EVERY {
            // Only the main thread hears signals; the interpreter answers others at once.
            if let Err(error) = Python::attach(|py| py.check_signals()) {
                self.raised.get_or_init(|| error);
            }
            self.asked.set(Instant::now());
        }
        self.raised.get().is_some()
    }
}

/// Does some work while other threads of the interpreter run.
///
/// # Errors
/// The exception of a signal that came meanwhile, whatever the work came to.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&mut Signals) -> T + Send,
) -> PyResult<T> {
    py.detach(|| {
        let mut signals = Signals { asked: Cell::new(Instant::now()), raised: OnceCell::new() };
        let done = work(&mut signals);
        signals.raised.into_inner().map_or(Ok(done), Err)
    })
}
