//! Parts judged and advised on by several threads: each part by itself, so that neither their
//! number nor the order in which parts are taken changes a bit. Without the feature `rayon`, or
//! where the system starts no threads, the caller's thread does it all.

use super::Judging;
use super::division::add_division;
use super::judged::{is_to_judge, judge};
use super::part::Part;
use crate::material::Material;
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::triangulate::is_on_one_thread;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// The most threads that help: each takes the memory of a computed sheet.
const MOST_HELPERS: usize = 15;

/// Judges all parts that a formula has screened and that want an elastic sheet. Where it is
/// stopped, the rest stays as it is.
pub(super) fn judge_all(
    parts: &mut [Part],
    judging: Judging,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) {
    judge_with(helpers(), parts, judging, material, watch);
}

/// Adds to parts that will not bend where to divide them. Where it is stopped, the rest stays as it
/// is.
pub(super) fn advise_all(
    parts: Vec<&mut Part>,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) {
    share(helpers(), parts, watch, &|part, watch| {
        // A part whose work was stopped has no finding more, which is all that stopping asks for.
        let _ = add_division(part, material, watch);
    });
}

/// Number of threads beside the one that calls.
fn helpers() -> usize {
    let helpers = if cfg!(feature = "rayon") && !is_on_one_thread() {
        thread::available_parallelism().map_or(0, |threads| threads.get() - 1)
    } else {
        0
    };
    helpers.min(MOST_HELPERS)
}

/// Judges them with so many threads beside the one that calls.
fn judge_with(
    helpers: usize,
    parts: &mut [Part],
    judging: Judging,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) {
    let parts = parts.iter_mut().filter(|part| is_to_judge(part, judging)).collect();
    share(helpers, parts, watch, &|part, watch| {
        judge(part, material, watch);
    });
}

/// Calls `work` with every item, on `helpers` threads beside the one that calls.
fn share<T: Send>(
    helpers: usize,
    items: Vec<T>,
    watch: &mut dyn Watch,
    work: &(dyn Fn(T, &mut dyn Watch) + Sync),
) {
    let count = items.len();
    let queue = Mutex::new(items.into_iter());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let stopped = AtomicBool::new(false);
    let help = || {
        while let Some(item) = next() {
            work(item, &mut Helper(&stopped));
        }
    };
    thread::scope(|scope| {
        for _ in 0..helpers.min(count.saturating_sub(1)) {
            if thread::Builder::new().spawn_scoped(scope, help).is_err() {
                break;
            }
        }
        let mut leader = Leader { watch, stopped: &stopped };
        while let Some(item) = next() {
            work(item, &mut leader);
        }
    });
}

/// The watch of the thread that calls: what it hears goes for all.
struct Leader<'a> {
    watch: &'a mut dyn Watch,
    stopped: &'a AtomicBool,
}

impl Watch for Leader<'_> {
    fn progress(&mut self, done: f64) {
        self.watch.progress(done);
    }

    fn stop(&self) -> bool {
        let is_stopped = self.watch.stop();
        if is_stopped {
            self.stopped.store(true, Ordering::Relaxed);
        }
        is_stopped
    }
}

/// The watch of a thread that helps.
struct Helper<'a>(&'a AtomicBool);

impl Watch for Helper<'_> {
    fn stop(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;
    use crate::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
    use crate::make::judged::is_screened;
    use crate::make::make_judged;
    use sheetwright_geometry::curve::{CurveKind, CurvePoint};
    use sheetwright_geometry::math::{Point3, sin};
    use sheetwright_geometry::watch::Unwatched;

    /// Seven strips side by side between rails that wave more and more.
    fn strips() -> Vec<Part> {
        waving(1.0)
    }

    /// Strips that wave so many times as much.
    fn waving(times: f64) -> Vec<Part> {
        let rail = |n: usize| {
            let at = |i: usize| {
                let x = 50.0 * i as f64;
                let high = 3.0 * times * n as f64;
                Point3::new(x, 100.0 * n as f64, high * sin(0.02 * x + 0.1 * n as f64))
            };
            (0..12).map(|i| CurvePoint::smooth(at(i))).collect()
        };
        let curve = |n: usize| DesignCurve {
            name: format!("rail {n}"),
            kind: Some(CurveKind::Spline),
            closed: false,
            points: rail(n),
        };
        let on = |n: usize| CurveUse { name: format!("rail {n}"), reversed: false };
        let panel =
            |n: usize| DesignPanel::new(format!("{n}"), PanelShape::Rails([on(n), on(n + 1)]), 40);
        let design = Design {
            name: "strips".into(),
            curves: (0..8).map(curve).collect(),
            panels: (0..7).map(panel).collect(),
            ..Design::default()
        };
        make_judged(&design, Judging::Quick, &mut Unwatched).unwrap().parts
    }

    #[test]
    fn threads_change_no_bit() {
        let judged = |helpers: usize| {
            let mut parts = strips();
            judge_with(helpers, &mut parts, Judging::Exact, None, &mut Unwatched);
            parts
        };
        let alone = judged(0);
        assert!(alone.iter().all(|part| !is_screened(part)));
        for helpers in [1, 3, 20] {
            assert_eq!(judged(helpers), alone, "{helpers}");
        }
    }

    #[test]
    fn an_elastic_sheet_is_for_parts_near_their_limit() {
        let mut parts = [0.1, 0.3, 1.0, 3.0].map(waving).concat();
        let is_near = |part: &Part| {
            let predicted = part.predicted.as_ref().unwrap();
            let [least, most] = predicted.strain_range;
            (least..=most).contains(&predicted.limits.strain)
        };
        let near: Vec<bool> = parts.iter().map(is_near).collect();
        assert!(near.contains(&true) && near.contains(&false), "{near:?}");
        judge_with(0, &mut parts, Judging::Auto, None, &mut Unwatched);
        let judged: Vec<bool> = parts.iter().map(|part| !is_screened(part)).collect();
        assert_eq!(judged, near);
    }

    /// Stops all work from the start.
    struct Stopped;

    impl Watch for Stopped {
        fn stop(&self) -> bool {
            true
        }
    }

    #[test]
    fn what_is_stopped_stays_screened() {
        let mut parts = strips();
        judge_with(0, &mut parts, Judging::Exact, None, &mut Stopped);
        assert_eq!(parts, strips());
    }
}
