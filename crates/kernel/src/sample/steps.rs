//! The source of each step of a boundary, from one sample to the next. It names the edges of
//! patterns.

use sheetwright_geometry::boundary::Boundary;
use sheetwright_geometry::math::Point3;
use std::collections::BTreeMap;

/// The source of a step of a boundary: the curve or the end that it lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum StepSource {
    /// A curve, by its number in the design.
    Curve(usize),
    /// The end that joins the beginnings of two rails: straight, unless they run on.
    Start,
    /// The end that joins the ends of two rails.
    End,
}

impl StepSource {
    /// Whether it joins two rails.
    pub(crate) fn is_end(&self) -> bool {
        matches!(self, Self::Start | Self::End)
    }
}

/// The first and the last sample of a rail itself, among its samples with the new ends that it runs
/// on to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Own {
    pub(super) first: usize,
    pub(super) last: usize,
}

impl Own {
    /// All of a rail of this number of samples, which does not run on.
    pub(super) fn all(samples: usize) -> Self {
        Self { first: 0, last: samples - 1 }
    }

    /// That of the reversed rail of this number of samples.
    pub(super) fn back(self, samples: usize) -> Self {
        Self { first: samples - 1 - self.last, last: samples - 1 - self.first }
    }

    /// The sources of the steps from each sample of a rail of this number of samples: `before`,
    /// `on` and `after` its curve.
    pub(super) fn steps(
        self,
        samples: usize,
        [before, on, after]: [StepSource; 3],
    ) -> Vec<StepSource> {
        let step = |n: usize| match n {
            _ if n < self.first => before,
            _ if n < self.last => on,
            _ => after,
        };
        (0..samples).map(step).collect()
    }
}

/// Where a step lies: the places of its ends in space, bit by bit, whichever way it is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct StepPlace([[u64; 3]; 2]);

impl StepPlace {
    /// That of the step between two places.
    pub(crate) fn between(ends: [Point3; 2]) -> Self {
        // 0 and −0 are one place.
        let bits = |p: Point3| [p.x + 0.0, p.y + 0.0, p.z + 0.0].map(f64::to_bits);
        let [a, b] = ends.map(bits);
        Self([a.min(b), a.max(b)])
    }
}

/// The steps of boundaries by where they lie.
#[derive(Debug, Default)]
pub(super) struct StepsByPlace(BTreeMap<StepPlace, StepSource>);

impl StepsByPlace {
    pub(super) fn insert(&mut self, ends: [Point3; 2], step: StepSource) {
        self.0.insert(StepPlace::between(ends), step);
    }

    /// The steps of a boundary that is joined from these. Where joining moved samples, a step is of
    /// what the nearest one beside it is of that was not moved, the earlier of two.
    pub(super) fn of(&self, boundary: &Boundary) -> Vec<Vec<StepSource>> {
        let at = |i: usize| boundary.samples()[i].position;
        let of_loop = |range: &std::ops::Range<usize>| {
            let known: Vec<Option<StepSource>> = range
                .clone()
                .map(|i| self.0.get(&StepPlace::between([at(i), at(boundary.next(i))])).copied())
                .collect();
            let m = known.len();
            let nearest = |n: usize| {
                let beside = (0..m).flat_map(|far| [(n + m - far) % m, (n + far) % m]);
                beside.filter_map(|k| known[k]).next().unwrap_or(StepSource::Start)
            };
            (0..m).map(nearest).collect()
        };
        boundary.loops().iter().map(of_loop).collect()
    }
}
