//! How far the straight steps from sample to sample lie from the curves, and how much shorter they
//! are: the pattern is cut along the steps.
//!
//! Between two samples of one curve the curve itself is known. Samples of joined panels and of
//! rails that run on have lost their places; between them stands the cubic with their tangents,
//! whose distance is that of the curve up to the square of the turn. Points that are
//! samples themselves have no curve between them.

use super::outline::KnownCurves;
use super::source::Sourced;
use super::steps::StepSource;
use crate::design::Design;
use sheetwright_geometry::curve::{Chord, chord};
use std::ops::Range;

/// How far the straight steps of a boundary lie from its curves, step by step.
#[derive(Clone, Debug, PartialEq)]
pub struct Chords {
    /// That of the step from each sample; `None` where points are the samples themselves.
    steps: Vec<Option<Chord>>,
    /// By how much the steps are shorter along the edge that loses most, mm.
    shorter_max_mm: f64,
}

impl Chords {
    /// Those of loops of samples, and of the step from each sample to the next.
    pub(crate) fn new(
        design: &Design,
        sources: &[Sourced],
        steps: &[StepSource],
        loops: &[Range<usize>],
    ) -> Self {
        let mut known = KnownCurves::of(design);
        let mut chords = Vec::with_capacity(sources.len());
        for range in loops {
            for i in range.clone() {
                let (from, to) = (&sources[i], &sources[next(range, i)]);
                chords.push((!is_of_rows(design, steps[i])).then(|| {
                    let pieces = known.between(from, to);
                    chord(&pieces.unwrap_or_else(|| vec![from.sample.cubic_to(&to.sample)]))
                }));
            }
        }
        let shorter = loops.iter().map(|range| most_of_an_edge(range, steps, &chords));
        let shorter_max_mm = shorter.fold(0.0, f64::max);
        Self { steps: chords, shorter_max_mm }
    }

    /// Those of a boundary whose steps lie on these, each with the share of it that it is; `None`
    /// of a step that no curve is known of. It loses no more along an edge than this one.
    pub(crate) fn divided(&self, steps: &[Option<(usize, f64)>]) -> Self {
        let chord = |(step, share): (usize, f64)| {
            let of_step = (*self.steps.get(step)?)?;
            Some(Chord { shorter_mm: share * of_step.shorter_mm, ..of_step })
        };
        let steps: Vec<Option<Chord>> = steps.iter().map(|step| step.and_then(chord)).collect();
        let lost: f64 = steps.iter().flatten().map(|chord| chord.shorter_mm).sum();
        Self { steps, shorter_max_mm: self.shorter_max_mm.min(lost) }
    }

    /// The largest distance of a curve from a step, mm; `None` where no curve is known.
    pub fn distance_max_mm(&self) -> Option<f64> {
        self.steps.iter().flatten().map(|chord| chord.distance_mm).reduce(f64::max)
    }

    /// The length by which the steps are shorter than the curves, along the edge that loses most,
    /// mm; `None` where no curve is known.
    pub fn shorter_max_mm(&self) -> Option<f64> {
        self.distance_max_mm().map(|_| self.shorter_max_mm)
    }

    /// The length by which the steps from these samples are shorter than the curves, mm; `None`
    /// where one of them has no curve.
    pub fn shorter_mm(&self, samples: impl IntoIterator<Item = usize>) -> Option<f64> {
        samples.into_iter().map(|i| self.steps.get(i)?.map(|chord| chord.shorter_mm)).sum()
    }
}

fn next(range: &Range<usize>, i: usize) -> usize {
    if i + 1 == range.end { range.start } else { i + 1 }
}

/// Whether the points of a curve are the samples themselves.
fn is_of_rows(design: &Design, step: StepSource) -> bool {
    let StepSource::Curve(number) = step else { return false };
    design.curves.get(number).is_some_and(|curve| curve.kind.is_none() && curve.closed)
}

/// By how much the steps of a loop are shorter along the edge of it that loses most, mm. An edge is
/// a run of steps along one curve; it may run over the end of the loop.
fn most_of_an_edge(range: &Range<usize>, steps: &[StepSource], chords: &[Option<Chord>]) -> f64 {
    let m = range.len();
    let at = |n: usize| range.start + n % m;
    // Where the first edge begins; anywhere on a loop of one curve.
    let first = (0..m).find(|&n| steps[at(n)] != steps[at(n + m - 1)]).unwrap_or(0);
    let (mut most, mut of_edge) = (0.0f64, 0.0);
    for n in first..first + m {
        if steps[at(n)] != steps[at(n + m - 1)] {
            of_edge = 0.0;
        }
        of_edge += chords[at(n)].map_or(0.0, |chord| chord.shorter_mm);
        most = most.max(of_edge);
    }
    most
}
