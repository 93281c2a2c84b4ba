//! From the curves of a panel to the samples of its loops, each of which knows where it is from.

use super::{
    CurveUse, Design, DesignCurve, DesignPanel, MakeCause, MakeError, PanelShape, joining, run_on,
};
use crate::boundary::{BoundaryError, MAX_SAMPLES, samples_from_points, size_of};
use crate::check::Finding;
use crate::cost::PriceOptions;
use crate::curve::{
    Curve, CurveKind, Place, Placed, Sample, SampleError, chain_placed, divisions_of, open_placed,
};
use crate::tolerance::Tolerance;
use std::collections::BTreeMap;

/// Lengths that differ by less than this share of the spacing get as many samples: two equal
/// circles are built from different numbers.
const SAME_SPACING: f64 = 1e-6;
/// Samples of a hole at the least, however small it is: a round one must not be cut as a triangle.
pub(crate) const LEAST_OF_HOLE: usize = 24;

/// A place on a curve of the design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OnCurve {
    /// The curve, by its number in the design.
    pub(super) curve: usize,
    /// The span of the curve as it was drawn; where its points are the samples, the point.
    pub(super) span: usize,
    /// Where on the span, 0 ..= 1.
    pub(super) t: f64,
    /// Whether the loop runs against the curve.
    pub(super) reversed: bool,
}

/// A sample, and where it is from. What comes from no curve has no place: the straight edges
/// between rails, new ends of rails that run on, and joined panels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sourced {
    pub(super) sample: Sample,
    /// What its position is from.
    pub(super) at: Option<OnCurve>,
    /// What its tangent of arrival is from.
    pub(super) arriving: Option<OnCurve>,
    /// What its tangent of leaving is from.
    pub(super) leaving: Option<OnCurve>,
}

impl Sourced {
    fn from_nowhere(sample: Sample) -> Self {
        Self { sample, at: None, arriving: None, leaving: None }
    }

    /// Run the other way.
    pub(super) fn back(self) -> Self {
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
pub(super) struct Sampled {
    pub(super) loops: Vec<Vec<Sourced>>,
    /// How many of the samples lie on the first rail.
    pub(super) on_first_rail: Option<usize>,
    /// Where rails ran on: how far each end bulges from the straight line, mm, if it does.
    pub(super) new_ends: Option<[Option<f64>; 2]>,
    /// What is to be said of the samples.
    pub(super) findings: Vec<Finding>,
}

impl Sampled {
    /// Samples that come from no single curve.
    pub(super) fn from_nowhere(loops: Vec<Vec<Sample>>, findings: Vec<Finding>) -> Self {
        let sourced =
            |list: Vec<Sample>| list.into_iter().map(Sourced::from_nowhere).collect::<Vec<_>>();
        let loops = loops.into_iter().map(sourced).collect();
        Self { loops, on_first_rail: None, new_ends: None, findings }
    }

    /// The samples alone.
    pub(super) fn samples(&self) -> Vec<Vec<Sample>> {
        let of_loop = |list: &Vec<Sourced>| list.iter().map(|s| s.sample).collect();
        self.loops.iter().map(of_loop).collect()
    }
}

/// How many divisions the smooth runs of curves get, as they were drawn, where seams are matched.
pub(super) type Matched = BTreeMap<usize, Vec<usize>>;

/// The divisions of the curves that several loops share: of each smooth run, the most that it has
/// in any of them. Empty unless the design matches its seams. Panels that can't be sampled are left
/// out.
pub(super) fn matched(design: &Design) -> Matched {
    let mut most = Matched::new();
    if !design.match_seams {
        return most;
    }
    let mut uses: BTreeMap<usize, usize> = BTreeMap::new();
    let mut note = |curve: usize, divisions: Vec<usize>| {
        *uses.entry(curve).or_default() += 1;
        let known = most.entry(curve).or_default();
        known.resize(known.len().max(divisions.len()), 0);
        known.iter_mut().zip(divisions).for_each(|(most, n)| *most = n.max(*most));
    };
    let sampler = Sampler { design, matched: &Matched::new() };
    for panel in design.panels_to_make() {
        match &panel.shape {
            PanelShape::Rails(rails) => {
                for rail in rails {
                    let Ok((number, curve)) = sampler.built(panel, rail) else { continue };
                    let Ok(samples) = open_placed(&curve, panel.samples, None) else { continue };
                    note(number, drawn(counted(&curve, &samples), &curve, rail.reversed));
                }
            }
            PanelShape::Loops { outer, holes } => {
                let Ok(loops) = sampler.loops(panel, outer, holes) else { continue };
                for (uses, samples) in std::iter::once(outer).chain(holes).zip(loops) {
                    let built: Result<Vec<_>, _> =
                        uses.iter().map(|part| sampler.built(panel, part)).collect();
                    let Ok(built) = built else { continue };
                    let curves: Vec<Curve> = built.iter().map(|(_, c)| c.clone()).collect();
                    let Ok(divisions) = divisions_of(&curves, samples.len()) else { continue };
                    for ((number, curve), (part, found)) in
                        built.iter().zip(uses.iter().zip(divisions))
                    {
                        if design.curves[*number].kind.is_some() {
                            note(*number, drawn(found, curve, part.reversed));
                        }
                    }
                }
            }
            PanelShape::Join(_) => {}
        }
    }
    most.retain(|curve, _| uses.get(curve).is_some_and(|&n| n > 1));
    most
}

/// The divisions of each smooth run of an open curve with these samples.
fn counted(curve: &Curve, samples: &[Placed]) -> Vec<usize> {
    let runs = curve.smooth_runs();
    let mut ends = 0;
    let ends: Vec<usize> = runs
        .iter()
        .map(|run| {
            ends += run.spans().len();
            ends
        })
        .collect();
    let mut found = vec![0; runs.len()];
    for placed in &samples[..samples.len() - 1] {
        let run = ends.partition_point(|&end| end <= placed.leaving.span);
        found[run.min(runs.len() - 1)] += 1;
    }
    found
}

/// Divisions of the runs of a curve as it is run, in the order of the curve as it was drawn; and
/// the other way round. The runs of a closed curve begin at its first corner, and the last runs
/// over its beginning if that is none: it stays the last.
fn drawn(mut divisions: Vec<usize>, curve: &Curve, reversed: bool) -> Vec<usize> {
    if reversed {
        let over_the_beginning = curve.closed() && !curve.begins_with_a_corner();
        let kept = divisions.len() - usize::from(over_the_beginning && !divisions.is_empty());
        divisions[..kept].reverse();
    }
    divisions
}

/// Samples the panels of a design.
pub(super) struct Sampler<'a> {
    pub(super) design: &'a Design,
    pub(super) matched: &'a Matched,
}

impl Sampler<'_> {
    pub(super) fn sampled(&self, panel: &DesignPanel) -> Result<Sampled, MakeError> {
        if panel.run_on && !matches!(panel.shape, PanelShape::Rails(_)) {
            let cause = MakeCause::RunOn;
            return Err(MakeError { panel: panel.name.clone(), curve: None, cause });
        }
        match &panel.shape {
            PanelShape::Rails(rails) => self.rails(panel, rails),
            PanelShape::Join(join) => joining::sampled(self.design, panel, join),
            PanelShape::Loops { outer, holes } => {
                let loops = self.loops(panel, outer, holes)?;
                Ok(Sampled { loops, on_first_rail: None, new_ends: None, findings: Vec::new() })
            }
        }
    }

    fn loops(
        &self,
        panel: &DesignPanel,
        outer: &[CurveUse],
        holes: &[Vec<CurveUse>],
    ) -> Result<Vec<Vec<Sourced>>, MakeError> {
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
    fn built(&self, panel: &DesignPanel, wanted: &CurveUse) -> Result<(usize, Curve), MakeError> {
        let (number, _) = self.numbered(panel, wanted)?;
        Ok((number, built(self.design, panel, wanted)?))
    }

    fn numbered(
        &self,
        panel: &DesignPanel,
        wanted: &CurveUse,
    ) -> Result<(usize, &DesignCurve), MakeError> {
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
    ) -> Result<Vec<Sourced>, MakeError> {
        let failed = |curve: &str, cause: MakeCause| MakeError {
            panel: panel.name.clone(),
            curve: Some(curve.to_owned()),
            cause,
        };
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
                    return Err(failed(&parts[n].name, MakeCause::ClosedCurve));
                }
                continue;
            }
            let next = (n + 1) % curves.len();
            let gap_mm = curve.end().distance(curves[next].start());
            if gap_mm > Tolerance::CHAIN.length_mm(size) {
                let cause = MakeCause::NotChained { next: parts[next].name.clone(), gap_mm };
                return Err(failed(&parts[n].name, cause));
            }
        }
        let length: f64 = curves.iter().map(Curve::length).sum();
        let count = count(length).max(least);
        if count > MAX_SAMPLES {
            let cause = MakeCause::Boundary(BoundaryError::TooManySamples { found: count });
            return Err(MakeError { panel: panel.name.clone(), curve: None, cause });
        }
        let divisions: Vec<Option<Vec<usize>>> = (0..curves.len())
            .map(|n| {
                let given = self.matched.get(&numbers[n]).cloned();
                given.map(|given| drawn(given, &curves[n], parts[n].reversed))
            })
            .collect();
        let sampled = match chain_placed(&curves, count, &divisions) {
            // Nobody asked for a number of samples of a hole.
            Err(SampleError::TooFew { needed, .. }) if least > 0 => {
                chain_placed(&curves, needed, &divisions)
            }
            sampled => sampled,
        };
        let sampled = sampled.map_err(|error| MakeError {
            panel: panel.name.clone(),
            curve: None,
            cause: MakeCause::Sampling(error),
        })?;
        let uses: Vec<Use> = (0..curves.len())
            .map(|n| Use::new(numbers[n], &curves[n], parts[n].reversed))
            .collect();
        Ok(sampled.into_iter().map(|placed| sourced(placed, &uses)).collect())
    }

    fn rails(&self, panel: &DesignPanel, rails: &[CurveUse; 2]) -> Result<Sampled, MakeError> {
        let failed = |curve: Option<&str>, cause: MakeCause| MakeError {
            panel: panel.name.clone(),
            curve: curve.map(str::to_owned),
            cause,
        };
        if rails[0].name == rails[1].name {
            return Err(failed(Some(&rails[0].name), MakeCause::SameRails));
        }
        let first = self.built(panel, &rails[0])?;
        let second = self.built(panel, &rails[1])?;
        for ((_, curve), rail) in [&first, &second].into_iter().zip(rails) {
            if curve.closed() {
                return Err(failed(Some(&rail.name), MakeCause::ClosedCurve));
            }
        }
        let sample = |(number, curve): &(usize, Curve), rail: &CurveUse| {
            let given = self.matched.get(number).cloned();
            let given = given.map(|given| drawn(given, curve, rail.reversed));
            let samples = open_placed(curve, panel.samples, given.as_deref())
                .map_err(|e| failed(None, MakeCause::Sampling(e)))?;
            let uses = [Use::new(*number, curve, rail.reversed)];
            Ok(samples.into_iter().map(|placed| sourced(placed, &uses)).collect::<Vec<_>>())
        };
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
        if panel.run_on {
            let price = PriceOptions { fold: panel.fold, ..PriceOptions::default() };
            let samples = |rail: &[Sourced]| rail.iter().map(|s| s.sample).collect::<Vec<_>>();
            let ran = run_on::run_on(&samples(&first), &samples(&second), same, price);
            new_ends = Some(ran.bulges_mm);
            [first, second] =
                ran.rails.map(|rail| rail.into_iter().map(Sourced::from_nowhere).collect());
        }
        // Rails that meet at an end share that sample; it keeps the tangents of both.
        let meet = |a: &[Sourced], b: &[Sourced]| {
            let (end, start) = (&a[a.len() - 1], &b[0]);
            end.sample.position.distance(start.sample.position) <= same
        };
        let (at_end, at_start) = (meet(&first, &second), meet(&second, &first));
        if at_end {
            let start = second.remove(0);
            let last = first.len() - 1;
            first[last].sample.tangent_out = start.sample.tangent_out;
            first[last].leaving = start.leaving;
        }
        if at_start && let Some(end) = second.pop() {
            first[0].sample.tangent_in = end.sample.tangent_in;
            first[0].arriving = end.arriving;
        }
        let on_first_rail = first.len();
        first.extend(second);
        close_ends(&mut first, on_first_rail, [at_start, at_end]);
        let loops = vec![first];
        let findings = Vec::new();
        Ok(Sampled { loops, on_first_rail: Some(on_first_rail), new_ends, findings })
    }
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

pub(super) fn found<'a>(
    design: &'a Design,
    panel: &DesignPanel,
    wanted: &CurveUse,
) -> Result<&'a DesignCurve, MakeError> {
    design.curves.iter().find(|curve| curve.name == wanted.name).ok_or_else(|| MakeError {
        panel: panel.name.clone(),
        curve: Some(wanted.name.clone()),
        cause: MakeCause::UnknownCurve,
    })
}

/// The curve of a name, run the way that it is used.
pub(super) fn built(
    design: &Design,
    panel: &DesignPanel,
    wanted: &CurveUse,
) -> Result<Curve, MakeError> {
    let source = found(design, panel, wanted)?;
    let curve = Curve::new(kind_of_part(source), &source.points, source.closed);
    let curve = curve.map_err(|error| MakeError {
        panel: String::new(),
        curve: Some(wanted.name.clone()),
        cause: MakeCause::Curve(error),
    })?;
    Ok(if wanted.reversed { curve.reversed() } else { curve })
}

/// How a curve is made when it is a part of something: points that are samples themselves are
/// joined straight.
pub(super) fn kind_of_part(source: &DesignCurve) -> CurveKind {
    source.kind.unwrap_or(CurveKind::Polyline)
}

/// Whether the second of two rails, to run back, is to be turned.
fn runs_back(first: &[Sourced], second: &[Sourced]) -> bool {
    let samples = |rail: &[Sourced]| rail.iter().map(|s| s.sample).collect::<Vec<_>>();
    let (first, second) = (samples(first), samples(second));
    apart(&first, &second) < apart(&first, &run_back(&second))
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

fn back(rail: Vec<Sourced>) -> Vec<Sourced> {
    rail.into_iter().rev().map(Sourced::back).collect()
}

/// Where straight edges join the ends of two rails, those ends are corners of the loop.
fn close_ends(samples: &mut [Sourced], on_first: usize, meeting: [bool; 2]) {
    let m = samples.len();
    for ((from, to), meeting) in
        [((m - 1, 0), meeting[0]), ((on_first - 1, on_first % m), meeting[1])]
    {
        let way = samples[to].sample.position - samples[from].sample.position;
        if let (false, Some(across)) = (meeting, crate::math::unit(way)) {
            samples[from].sample.tangent_out = across;
            samples[from].leaving = None;
            samples[to].sample.tangent_in = across;
            samples[to].arriving = None;
        }
    }
}
