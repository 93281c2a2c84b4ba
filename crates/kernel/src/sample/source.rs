//! Samples with their places on curves.

use super::steps::StepSource;
use sheetwright_geometry::boundary::Joined;
use sheetwright_geometry::curve::Sample;
use std::ops::Range;

/// A place on a curve of the design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnCurve {
    /// The curve, by its number in the design.
    pub(crate) curve: usize,
    /// The span of the curve as it was drawn; where its points are the samples, the point.
    pub(crate) span: usize,
    /// The parameter on the span, 0 ..= 1.
    pub(crate) t: f64,
    /// Whether the loop runs against the curve.
    pub(crate) reversed: bool,
}

/// A sample, and its place on a curve. Samples of straight edges between rails, of new ends of
/// rails that run on and of joined panels have no place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sourced {
    pub(crate) sample: Sample,
    /// The place of its position.
    pub(crate) at: Option<OnCurve>,
    /// The place of its tangent of arrival.
    pub(crate) arriving: Option<OnCurve>,
    /// The place of its tangent of leaving.
    pub(crate) leaving: Option<OnCurve>,
}

impl Sourced {
    pub(super) fn from_nowhere(sample: Sample) -> Self {
        Self { sample, at: None, arriving: None, leaving: None }
    }

    /// The sample of the loop reversed.
    pub(crate) fn back(self) -> Self {
        let back = |place: Option<OnCurve>| {
            place.map(|place| OnCurve { reversed: !place.reversed, ..place })
        };
        Self {
            sample: Sample {
                position: self.sample.position,
                tangent_in: -self.sample.tangent_out,
                tangent_out: -self.sample.tangent_in,
            },
            at: back(self.at),
            arriving: back(self.leaving),
            leaving: back(self.arriving),
        }
    }
}

/// The samples of a panel.
pub(crate) struct Sampled {
    pub(crate) loops: Vec<Vec<Sourced>>,
    /// What the step from each sample to the next lies on.
    pub(crate) steps: Vec<Vec<StepSource>>,
    /// How many of the samples lie on the first rail.
    pub(crate) on_first_rail: Option<usize>,
    /// Where rails ran on: how far each end bulges from the straight line, mm, if it does.
    pub(crate) new_ends: Option<[Option<f64>; 2]>,
    /// Where panels were joined: how.
    pub(crate) joined: Option<Joined>,
}

impl Sampled {
    /// Those of a panel that joins no others.
    pub(super) fn of_loops(loops: Vec<Vec<Sourced>>, steps: Vec<Vec<StepSource>>) -> Self {
        Self { loops, steps, on_first_rail: None, new_ends: None, joined: None }
    }

    /// Those of joined panels, which come from no single curve.
    pub(super) fn joined(joined: Joined, steps: Vec<Vec<StepSource>>) -> Self {
        let boundary = &joined.boundary;
        let of_loop = |range: &Range<usize>| boundary.samples()[range.clone()].iter();
        let sourced = |range| of_loop(range).copied().map(Sourced::from_nowhere).collect();
        let loops = boundary.loops().iter().map(sourced).collect();
        Self { joined: Some(joined), ..Self::of_loops(loops, steps) }
    }

    /// The samples alone.
    pub(super) fn samples(&self) -> Vec<Vec<Sample>> {
        let of_loop = |list: &Vec<Sourced>| list.iter().map(|s| s.sample).collect();
        self.loops.iter().map(of_loop).collect()
    }
}

/// How far apart two rails are, run side by side: the sum over the samples of the one that has
/// fewer, mm.
pub(super) fn apart(first: &[Sample], second: &[Sample]) -> f64 {
    let count = first.len().min(second.len());
    let at = |rail: &[Sample], n: usize| rail[n * (rail.len() - 1) / (count - 1).max(1)].position;
    (0..count).map(|n| at(first, n).distance(at(second, n))).sum()
}

/// A rail run from its end to its beginning.
pub(super) fn run_back(rail: &[Sample]) -> Vec<Sample> {
    rail.iter().rev().map(|s| Sourced::from_nowhere(*s).back().sample).collect()
}

pub(super) fn back(rail: Vec<Sourced>) -> Vec<Sourced> {
    rail.into_iter().rev().map(Sourced::back).collect()
}
