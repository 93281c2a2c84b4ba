//! From the curves of a panel that joins no others to the samples of its loops, each of which knows
//! where it is from.

use super::curves::{built, found};
use super::error::{PanelCause, PanelError};
use super::run_on;
use super::source::{OnCurve, Sampled, Sourced, apart, back, run_back};
use super::steps::{Own, StepSource};
use crate::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
use sheetwright_geometry::boundary::{BoundaryError, MAX_SAMPLES, samples_from_points, size_of};
use sheetwright_geometry::curve::{
    Curve, Place, Placed, Sample, SampleError, chain_placed, open_placed,
};
use sheetwright_geometry::tolerance::Tolerance;
use sheetwright_optimum::cost::PriceOptions;
use std::collections::BTreeMap;

/// Lengths that differ by less than this share of the spacing get as many samples: two equal
/// circles are built from different numbers.
const SAME_SPACING: f64 = 1e-6;
/// Samples of a hole at the least, however small it is: a round one must not be cut as a triangle.
pub(crate) const LEAST_OF_HOLE: usize = 24;

/// How many divisions the smooth runs of curves get, as they were drawn, where seams are matched.
pub(crate) type Matched = BTreeMap<usize, Vec<usize>>;

/// Divisions of the runs of a curve as it is run, in the order of the curve as it was drawn; and
/// the other way round. The runs of a closed curve begin at its first corner, and the last runs
/// over its beginning if that is none: it stays the last.
pub(super) fn drawn(mut divisions: Vec<usize>, curve: &Curve, reversed: bool) -> Vec<usize> {
    if reversed {
        let over_the_beginning = curve.closed() && !curve.begins_with_a_corner();
        let kept = divisions.len() - usize::from(over_the_beginning && !divisions.is_empty());
        divisions[..kept].reverse();
    }
    divisions
}

/// Samples the panels of a design.
pub(crate) struct Sampler<'a> {
    pub(crate) design: &'a Design,
    pub(crate) matched: &'a Matched,
}

impl Sampler<'_> {
    /// The samples of a panel that joins no others.
    pub(super) fn of_curves(&self, panel: &DesignPanel) -> Result<Sampled, PanelError> {
        if panel.run_on && !matches!(panel.shape, PanelShape::Rails(_)) {
            return Err(PanelError::of_panel(&panel.name, PanelCause::RunOn));
        }
        match &panel.shape {
            PanelShape::Rails(rails) => self.rails(panel, rails),
            PanelShape::Join(_) => {
                let cause = PanelCause::JoinOfJoins { name: panel.name.clone() };
                Err(PanelError::of_panel(&panel.name, cause))
            }
            PanelShape::Mesh(_) => {
                let cause = PanelCause::NoCurves { name: panel.name.clone() };
                Err(PanelError::of_panel(&panel.name, cause))
            }
            PanelShape::Loops { outer, holes } => {
                let loops = self.loops(panel, outer, holes)?;
                let steps = loops.iter().map(|samples| along_curves(samples)).collect();
                Ok(Sampled::of_loops(loops, steps))
            }
        }
    }

    pub(super) fn loops(
        &self,
        panel: &DesignPanel,
        outer: &[CurveUse],
        holes: &[Vec<CurveUse>],
    ) -> Result<Vec<Vec<Sourced>>, PanelError> {
        let outer = self.one_loop(panel, outer, |_| panel.samples, 0)?;
        let spacing = ring_length(&outer) / outer.len() as f64;
        let mut loops = vec![outer];
        for hole in holes {
            let as_spaced = |length: f64| (length / spacing - SAME_SPACING).ceil() as usize;
            loops.push(self.one_loop(panel, hole, as_spaced, LEAST_OF_HOLE)?);
        }
        Ok(loops)
    }

    /// The curve of a name, with its number in the design, run the way that it is used.
    pub(super) fn built(
        &self,
        panel: &DesignPanel,
        wanted: &CurveUse,
    ) -> Result<(usize, Curve), PanelError> {
        let (number, _) = self.numbered(panel, wanted)?;
        Ok((number, built(self.design, panel, wanted)?))
    }

    fn numbered(
        &self,
        panel: &DesignPanel,
        wanted: &CurveUse,
    ) -> Result<(usize, &DesignCurve), PanelError> {
        let source = found(self.design, panel, wanted)?;
        let number = self.design.curves.iter().position(|curve| curve.name == wanted.name);
        Ok((number.unwrap_or_default(), source))
    }

    fn one_loop(
        &self,
        panel: &DesignPanel,
        parts: &[CurveUse],
        count: impl Fn(f64) -> usize,
        least: usize,
    ) -> Result<Vec<Sourced>, PanelError> {
        let failed =
            |curve: &str, cause: PanelCause| PanelError::of_curve_in(&panel.name, curve, cause);
        if let [only] = parts {
            let (number, source) = self.numbered(panel, only)?;
            if source.kind.is_none() && source.closed {
                return Ok(points_as_samples(source, number, only.reversed));
            }
        }
        let built = parts
            .iter()
            .map(|part| self.built(panel, part))
            .collect::<Result<Vec<(usize, Curve)>, _>>()?;
        let (numbers, curves): (Vec<usize>, Vec<Curve>) = built.into_iter().unzip();
        let controls = curves.iter().flat_map(|c| c.spans()).flat_map(|span| span.control);
        let size = size_of(controls);
        for (n, curve) in curves.iter().enumerate() {
            if curve.closed() {
                if curves.len() > 1 {
                    return Err(failed(&parts[n].name, PanelCause::ClosedCurve));
                }
                continue;
            }
            let next = (n + 1) % curves.len();
            let gap_mm = curve.end().distance(curves[next].start());
            if gap_mm > Tolerance::CHAIN.length_mm(size) {
                let cause = PanelCause::NotChained { next: parts[next].name.clone(), gap_mm };
                return Err(failed(&parts[n].name, cause));
            }
        }
        let length: f64 = curves.iter().map(Curve::length).sum();
        let count = count(length).max(least);
        if count > MAX_SAMPLES {
            let cause = PanelCause::Boundary(BoundaryError::TooManySamples { found: count });
            return Err(PanelError::of_panel(&panel.name, cause));
        }
        let divisions: Vec<Option<Vec<usize>>> = (0..curves.len())
            .map(|n| {
                let given = self.matched.get(&numbers[n]).cloned();
                given.map(|given| drawn(given, &curves[n], parts[n].reversed))
            })
            .collect();
        let sampled = match chain_placed(&curves, count, &divisions) {
            // The number of samples of the panel does not count for a hole.
            Err(SampleError::TooFew { needed, .. }) if least > 0 => {
                chain_placed(&curves, needed, &divisions)
            }
            sampled => sampled,
        };
        let failed = |error| PanelError::of_panel(&panel.name, PanelCause::Sampling(error));
        let sampled = sampled.map_err(failed)?;
        let uses: Vec<Use> = (0..curves.len())
            .map(|n| Use::new(numbers[n], &curves[n], parts[n].reversed))
            .collect();
        Ok(sampled.into_iter().map(|placed| sourced(placed, &uses)).collect())
    }

    fn rails(&self, panel: &DesignPanel, rails: &[CurveUse; 2]) -> Result<Sampled, PanelError> {
        if rails[0].name == rails[1].name {
            let cause = PanelCause::SameRails;
            return Err(PanelError::of_curve_in(&panel.name, &rails[0].name, cause));
        }
        let first = self.built(panel, &rails[0])?;
        let second = self.built(panel, &rails[1])?;
        for ((_, curve), rail) in [&first, &second].into_iter().zip(rails) {
            if curve.closed() {
                let cause = PanelCause::ClosedCurve;
                return Err(PanelError::of_curve_in(&panel.name, &rail.name, cause));
            }
        }
        let sample = |(number, curve): &(usize, Curve), rail: &CurveUse| {
            let given = self.matched.get(number).cloned();
            let given = given.map(|given| drawn(given, curve, rail.reversed));
            let samples = open_placed(curve, panel.samples, given.as_deref())
                .map_err(|e| PanelError::of_panel(&panel.name, PanelCause::Sampling(e)))?;
            let uses = [Use::new(*number, curve, rail.reversed)];
            Ok(samples.into_iter().map(|placed| sourced(placed, &uses)).collect::<Vec<_>>())
        };
        let curves = [first.0, second.0].map(StepSource::Curve);
        let (mut first, mut second) = (sample(&first, &rails[0])?, sample(&second, &rails[1])?);
        // The second runs back: the way that leaves the rails nearer to one another all along.
        // Their ends alone would not tell where each rail ends where it begins, as those of a duct
        // do.
        if runs_back(&first, &second) {
            second = back(second);
        }
        let size = size_of(first.iter().chain(&second).map(|s| s.sample.position));
        let same = Tolerance::CHAIN.length_mm(size);
        let mut new_ends = None;
        let mut own = [Own::all(first.len()), Own::all(second.len())];
        if panel.run_on {
            let price = PriceOptions { fold: panel.fold, ..PriceOptions::default() };
            let samples = |rail: &[Sourced]| rail.iter().map(|s| s.sample).collect::<Vec<_>>();
            let ran = run_on::run_on(&samples(&first), &samples(&second), same, price);
            (new_ends, own) = (Some(ran.bulges_mm), ran.own);
            [first, second] =
                ran.rails.map(|rail| rail.into_iter().map(Sourced::from_nowhere).collect());
        }
        let [start, end] = [StepSource::Start, StepSource::End];
        let mut steps = own[0].steps(first.len(), [start, curves[0], end]);
        let steps_back = own[1].steps(second.len(), [end, curves[1], start]);
        // Rails that meet at an end share that sample; it keeps the tangents of both.
        let meet = |a: &[Sourced], b: &[Sourced]| {
            let (end, start) = (&a[a.len() - 1], &b[0]);
            end.sample.position.distance(start.sample.position) <= same
        };
        let (at_end, at_start) = (meet(&first, &second), meet(&second, &first));
        if at_end {
            steps.pop();
            let start = second.remove(0);
            let last = first.len() - 1;
            first[last].sample.tangent_out = start.sample.tangent_out;
            first[last].leaving = start.leaving;
        }
        steps.extend(steps_back);
        if at_start && let Some(end) = second.pop() {
            steps.pop();
            first[0].sample.tangent_in = end.sample.tangent_in;
            first[0].arriving = end.arriving;
        }
        let on_first_rail = first.len();
        first.extend(second);
        close_ends(&mut first, on_first_rail, [at_start, at_end]);
        let on_first_rail = Some(on_first_rail);
        Ok(Sampled { on_first_rail, new_ends, ..Sampled::of_loops(vec![first], vec![steps]) })
    }
}

/// The steps along a loop of curves.
fn along_curves(samples: &[Sourced]) -> Vec<StepSource> {
    let curve = |sourced: &Sourced| sourced.leaving.or(sourced.at).map(|place| place.curve);
    samples.iter().map(|sourced| StepSource::Curve(curve(sourced).unwrap_or_default())).collect()
}

/// A curve as it is used: its number in the design, and how to find a place on it as it was drawn.
struct Use {
    number: usize,
    spans: usize,
    reversed: bool,
}

impl Use {
    fn new(number: usize, curve: &Curve, reversed: bool) -> Self {
        Self { number, spans: curve.spans().len(), reversed }
    }

    fn on_curve(&self, place: Place) -> OnCurve {
        let (span, t) = if self.reversed {
            (self.spans - 1 - place.span, 1.0 - place.t)
        } else {
            (place.span, place.t)
        };
        OnCurve { curve: self.number, span, t, reversed: self.reversed }
    }
}

fn sourced(placed: Placed, uses: &[Use]) -> Sourced {
    let on = |place: Place| Some(uses[place.curve].on_curve(place));
    let (arriving, leaving) = (on(placed.arriving), on(placed.leaving));
    Sourced { sample: placed.sample, at: leaving, arriving, leaving }
}

/// The points of a closed curve that are samples themselves.
fn points_as_samples(source: &DesignCurve, number: usize, reversed: bool) -> Vec<Sourced> {
    let mut points: Vec<(usize, _)> = source.points.iter().copied().enumerate().collect();
    if reversed {
        points.reverse();
    }
    let at: Vec<_> = points.iter().map(|(_, point)| *point).collect();
    let place = |span: usize| Some(OnCurve { curve: number, span, t: 0.0, reversed });
    let sourced = |(sample, (n, _)): (Sample, &(usize, _))| {
        // Their tangents are differences of the samples beside them.
        Sourced { sample, at: place(*n), arriving: None, leaving: None }
    };
    samples_from_points(&at).into_iter().zip(&points).map(sourced).collect()
}

fn ring_length(samples: &[Sourced]) -> f64 {
    let m = samples.len();
    let at = |i: usize| samples[i % m].sample.position;
    (0..m).map(|i| at(i).distance(at(i + 1))).sum()
}

/// Whether the second of two rails, to run back, is to be turned.
fn runs_back(first: &[Sourced], second: &[Sourced]) -> bool {
    let samples = |rail: &[Sourced]| rail.iter().map(|s| s.sample).collect::<Vec<_>>();
    let (first, second) = (samples(first), samples(second));
    apart(&first, &second) < apart(&first, &run_back(&second))
}

/// Where straight edges join the ends of two rails, those ends are corners of the loop.
fn close_ends(samples: &mut [Sourced], on_first: usize, meeting: [bool; 2]) {
    let m = samples.len();
    for ((from, to), meeting) in
        [((m - 1, 0), meeting[0]), ((on_first - 1, on_first % m), meeting[1])]
    {
        let way = samples[to].sample.position - samples[from].sample.position;
        if let (false, Some(across)) = (meeting, sheetwright_geometry::math::unit(way)) {
            samples[from].sample.tangent_out = across;
            samples[from].leaving = None;
            samples[to].sample.tangent_in = across;
            samples[to].arriving = None;
        }
    }
}
