//! Saves the work of a window while it is made.
//!
//! The app says with every frame which version its document has. When a save is due, it hands over
//! a job that makes the bytes: on the desktop a thread does it, so that no frame waits for a disk,
//! and of jobs that come while it is at work only the newest is done. In the browser the database
//! works beside the page; there too only the newest waits. What is put aside, into slots of their
//! own, is kept first, and all of it.

use super::{Due, Pace, Store, StoreError};
use std::collections::VecDeque;
use std::time::Duration;
use web_time::Instant;

/// Makes the bytes that are saved.
pub type Job = Box<dyn FnOnce() -> Vec<u8> + Send>;

/// Saves the work of a window.
#[derive(Debug)]
pub struct Autosave {
    pace: Pace,
    saver: Saver,
    problem: Option<StoreError>,
    /// The version that was handed over last, and the one that is kept for certain.
    handed: Option<u64>,
    kept: Option<u64>,
}

impl Autosave {
    /// Saves into the slot of this window. `version` needs no save: it is that of a new document,
    /// or of one that was just opened.
    pub fn new(store: Store, version: u64) -> Self {
        Self {
            pace: Pace::new(version),
            saver: Saver::new(store),
            problem: None,
            handed: None,
            kept: None,
        }
    }

    /// To be called with every frame; `job` is asked for only where a save is due. Gives the time
    /// after which it should be called again, if there is something left to do.
    pub fn frame(
        &mut self,
        version: u64,
        now: Instant,
        job: impl FnOnce() -> Job,
    ) -> Option<Duration> {
        if let Some(outcome) = self.saver.outcome() {
            if outcome.is_err() {
                self.pace.failed();
            } else if !self.saver.is_busy() {
                self.kept = self.handed;
            }
            self.problem = outcome.err();
        }
        match self.pace.due(version, now) {
            Due::Now => {
                self.saver.hand(Task::Save(job()));
                self.handed = Some(version);
                // To learn how it ended.
                Some(super::PAUSE)
            }
            Due::In(left) => Some(left),
            Due::Nothing => self.saver.is_busy().then_some(super::PAUSE),
        }
    }

    /// Empties the slot: this version is in a file, or nobody wants it. What changes from now on is
    /// saved as before.
    pub fn settled(&mut self, version: u64) {
        self.pace = Pace::new(version);
        self.handed = None;
        self.saver.hand(Task::Empty);
    }

    /// Keeps bytes in a slot of their own, before the slot of this window is saved or emptied next.
    pub fn put_aside(&mut self, slot: String, bytes: Vec<u8>) {
        self.saver.hand(Task::PutAside(slot, bytes));
    }

    /// Why something that was put aside is not kept; once for each time.
    pub fn not_put_aside(&mut self) -> Option<StoreError> {
        self.saver.not_put_aside()
    }

    /// Whether everything that was handed over is done, and worked out.
    pub fn rests(&self) -> bool {
        !self.saver.is_busy() && self.problem.is_none()
    }

    /// Whether this version is in the slot.
    pub fn has_kept(&self, version: u64) -> bool {
        self.kept == Some(version)
    }

    /// Why the last save has failed, to be shown as long as it is so.
    pub fn problem(&self) -> Option<&StoreError> {
        self.problem.as_ref()
    }

    /// Waits until everything that was handed over is done.
    pub fn wait(&mut self) {
        self.saver.wait();
    }
}

/// What is done with the slot of this window, or with one of their own.
enum Task {
    Save(Job),
    Empty,
    PutAside(String, Vec<u8>),
}

/// What is to be done: all that is put aside, and the newest of the rest.
#[derive(Default)]
struct Tasks {
    aside: VecDeque<Task>,
    newest: Option<Task>,
}

impl Tasks {
    fn add(&mut self, task: Task) {
        match task {
            Task::PutAside(..) => self.aside.push_back(task),
            Task::Save(_) | Task::Empty => self.newest = Some(task),
        }
    }

    fn next(&mut self) -> Option<Task> {
        self.aside.pop_front().or_else(|| self.newest.take())
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn is_empty(&self) -> bool {
        self.aside.is_empty() && self.newest.is_none()
    }
}

/// What came of tasks, until it is asked for.
#[derive(Default)]
struct Outcomes {
    /// Of the slot of this window.
    own: Option<Result<(), StoreError>>,
    /// Why something was not put aside.
    aside: Option<StoreError>,
}

impl Outcomes {
    fn note(&mut self, is_aside: bool, outcome: Result<(), StoreError>) {
        if !is_aside {
            self.own = Some(outcome);
        } else if let Err(error) = outcome {
            self.aside = Some(error);
        }
    }
}

#[cfg(not(target_arch = "wasm32"))]
impl Task {
    fn run(self, store: &mut Store) -> Result<(), StoreError> {
        let slot = store.own_slot().to_owned();
        match self {
            Self::Save(job) => store.save(&slot, &job()),
            Self::Empty => store.remove(&slot),
            Self::PutAside(slot, bytes) => store.save(&slot, &bytes),
        }
    }
}

#[cfg(target_arch = "wasm32")]
use page::Saver;
#[cfg(not(target_arch = "wasm32"))]
use thread::Saver;

/// In the browser: asked of its database.
#[cfg(target_arch = "wasm32")]
mod page {
    use super::{Outcomes, Store, StoreError, Task, Tasks};
    use std::cell::RefCell;
    use std::rc::Rc;
    use wasm_bindgen_futures::spawn_local;

    #[derive(Default)]
    struct Desk {
        is_busy: bool,
        /// What is asked for as soon as the database has done what it is at.
        tasks: Tasks,
        outcomes: Outcomes,
    }

    pub(super) struct Saver {
        store: Rc<Store>,
        desk: Rc<RefCell<Desk>>,
    }

    impl std::fmt::Debug for Saver {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.debug_struct("Saver").field("store", &self.store).finish_non_exhaustive()
        }
    }

    impl Saver {
        pub(super) fn new(store: Store) -> Self {
            Self { store: Rc::new(store), desk: Rc::default() }
        }

        pub(super) fn hand(&mut self, task: Task) {
            let mut desk = self.desk.borrow_mut();
            desk.tasks.add(task);
            if !std::mem::replace(&mut desk.is_busy, true) {
                spawn_local(work(self.store.clone(), self.desk.clone()));
            }
        }

        pub(super) fn outcome(&mut self) -> Option<Result<(), StoreError>> {
            self.desk.borrow_mut().outcomes.own.take()
        }

        pub(super) fn not_put_aside(&mut self) -> Option<StoreError> {
            self.desk.borrow_mut().outcomes.aside.take()
        }

        pub(super) fn is_busy(&self) -> bool {
            let desk = self.desk.borrow();
            desk.is_busy || desk.outcomes.own.is_some()
        }

        /// A page can't wait; what was asked for is done without it.
        pub(super) fn wait(&mut self) {}
    }

    /// Does tasks until there are no more.
    async fn work(store: Rc<Store>, desk: Rc<RefCell<Desk>>) {
        loop {
            let Some(task) = desk.borrow_mut().tasks.next() else { break };
            let is_aside = matches!(task, Task::PutAside(..));
            let outcome = match task {
                Task::Save(job) => store.save(store.own_slot(), &job()).await,
                Task::Empty => store.emptied(store.own_slot()).await,
                Task::PutAside(slot, bytes) => store.save(&slot, &bytes).await,
            };
            desk.borrow_mut().outcomes.note(is_aside, outcome);
        }
        desk.borrow_mut().is_busy = false;
    }
}

/// On the desktop: in a thread.
#[cfg(not(target_arch = "wasm32"))]
mod thread {
    use super::{Outcomes, Store, StoreError, Task, Tasks};
    use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
    use std::thread::JoinHandle;
    use std::time::Duration;

    /// How often somebody who waits looks whether the thread is still there.
    const LOOK: Duration = Duration::from_millis(50);

    #[derive(Default)]
    struct Desk {
        tasks: Tasks,
        working: bool,
        closing: bool,
        outcomes: Outcomes,
    }

    #[derive(Default)]
    struct Shared {
        desk: Mutex<Desk>,
        changed: Condvar,
    }

    impl Shared {
        /// The desk, also after a panic of the other side: it is whole at any time.
        fn desk(&self) -> MutexGuard<'_, Desk> {
            self.desk.lock().unwrap_or_else(PoisonError::into_inner)
        }

        fn wait<'a>(&self, desk: MutexGuard<'a, Desk>) -> MutexGuard<'a, Desk> {
            self.changed.wait(desk).unwrap_or_else(PoisonError::into_inner)
        }

        /// Does tasks until the desk is closed and empty.
        fn work(&self, store: &mut Store) {
            let mut desk = self.desk();
            loop {
                if let Some(task) = desk.tasks.next() {
                    desk.working = true;
                    drop(desk);
                    let is_aside = matches!(task, Task::PutAside(..));
                    let outcome = task.run(store);
                    desk = self.desk();
                    desk.working = false;
                    desk.outcomes.note(is_aside, outcome);
                    self.changed.notify_all();
                } else if desk.closing {
                    return;
                } else {
                    desk = self.wait(desk);
                }
            }
        }
    }

    pub(super) struct Saver {
        shared: Arc<Shared>,
        thread: Option<JoinHandle<()>>,
        /// Where no thread can be had, the work is done at once.
        here: Option<Store>,
    }

    impl std::fmt::Debug for Saver {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.debug_struct("Saver").field("thread", &self.thread).finish_non_exhaustive()
        }
    }

    impl Saver {
        pub(super) fn new(store: Store) -> Self {
            let shared = Arc::new(Shared::default());
            let (theirs, mut their_store) = (Arc::clone(&shared), store.clone());
            let thread = std::thread::Builder::new()
                .name("autosave".to_owned())
                .spawn(move || theirs.work(&mut their_store))
                .ok();
            let here = thread.is_none().then_some(store);
            Self { shared, thread, here }
        }

        pub(super) fn hand(&mut self, task: Task) {
            if let Some(store) = &mut self.here {
                let is_aside = matches!(task, Task::PutAside(..));
                let outcome = task.run(store);
                self.shared.desk().outcomes.note(is_aside, outcome);
                return;
            }
            self.shared.desk().tasks.add(task);
            self.shared.changed.notify_all();
        }

        pub(super) fn outcome(&mut self) -> Option<Result<(), StoreError>> {
            self.shared.desk().outcomes.own.take()
        }

        pub(super) fn not_put_aside(&mut self) -> Option<StoreError> {
            self.shared.desk().outcomes.aside.take()
        }

        pub(super) fn is_busy(&self) -> bool {
            let desk = self.shared.desk();
            desk.working || !desk.tasks.is_empty() || desk.outcomes.own.is_some()
        }

        pub(super) fn wait(&mut self) {
            let mut desk = self.shared.desk();
            // A thread that has panicked does nothing more.
            while desk.working || !desk.tasks.is_empty() {
                if self.thread.as_ref().is_none_or(JoinHandle::is_finished) {
                    return;
                }
                let waited = self.shared.changed.wait_timeout(desk, LOOK);
                desk = waited.unwrap_or_else(PoisonError::into_inner).0;
            }
        }
    }

    impl Drop for Saver {
        fn drop(&mut self) {
            self.shared.desk().closing = true;
            self.shared.changed.notify_all();
            if let Some(thread) = self.thread.take() {
                let _ = thread.join();
            }
        }
    }
}
