//! Progress of a part of a larger work.

use sheetwright_geometry::watch::Watch;
use std::ops::Range;

/// A part of the work, with its range of the whole progress.
pub(super) struct Part<'w> {
    watch: &'w mut dyn Watch,
    share: Range<f64>,
    told: f64,
}

impl<'w> Part<'w> {
    pub(super) fn new(watch: &'w mut dyn Watch, share: Range<f64>) -> Self {
        Self { watch, share, told: f64::NEG_INFINITY }
    }

    /// A part of the work whose progress is not passed on.
    pub(super) fn silent(watch: &'w mut dyn Watch) -> Self {
        Self { watch, share: 0.0..0.0, told: f64::INFINITY }
    }
}

impl Watch for Part<'_> {
    fn progress(&mut self, done: f64) {
        // Some work is done in several passes, whose progress begins again at 0.
        if done > self.told {
            self.told = done;
            self.watch.progress(self.share.start + (self.share.end - self.share.start) * done);
        }
    }

    fn stop(&self) -> bool {
        self.watch.stop()
    }
}
