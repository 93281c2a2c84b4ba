//! The points that move, as unknowns, and how samples follow them.

use crate::boundary::size_of;
use crate::curve::{CurveKind, PointShare, SpanShares, point_shares};
use crate::design::sampling::{OnCurve, Sourced, kind_of_part};
use crate::design::{Design, DesignCurve, Prepared};
use crate::math::{Point3, Vec3};
use crate::tolerance::Tolerance;
use crate::vary::{Lean, Motion, Share, motions};
use std::collections::{BTreeMap, BTreeSet};

/// A derivative below this share of the size of the boundary has no direction to tell; its tangent
/// follows the samples beside it.
const NO_DERIVATIVE: f64 = 1e-9;

/// A curve that moves.
struct MovingCurve {
    /// What its spans follow; empty where its points are the samples.
    spans: Vec<SpanShares>,
    /// Where its points lie, mm.
    points: Vec<Vec3>,
    /// The unknown of each point.
    unknown: Vec<Option<usize>>,
    /// How far each point may move by what it says itself, mm.
    move_mm: Vec<f64>,
    /// The largest sum of shares, each without its sign, that a sample has in the points.
    most_shares: f64,
}

/// The unknowns of a problem.
pub(super) struct Unknowns {
    curves: BTreeMap<usize, MovingCurve>,
    count: usize,
}

impl Unknowns {
    /// Those of the points of these curves. Points on one spot are one; those on the spot of a curve
    /// that stays, stay.
    pub(super) fn new(design: &Design, moving: &BTreeSet<usize>, panels: &[Prepared]) -> Self {
        let sources = || panels.iter().flat_map(|panel| &panel.sources);
        let all: BTreeSet<usize> = sources().filter_map(|s| Some(s.at?.curve)).collect();
        let size = size_of(sources().map(|s| s.sample.position));
        let same_mm = Tolerance::CHAIN.length_mm(size);
        // Points that lie on their curve, or are all of it: curve, point, place.
        let mut spots: Vec<(usize, usize, Point3)> = Vec::new();
        for &number in all.iter().chain(moving.difference(&all)) {
            let curve = &design.curves[number];
            let last = curve.points.len() - 1;
            let on_it = |n: usize| {
                curve.kind != Some(CurveKind::BSpline)
                    || (!curve.closed && (n == 0 || n == last))
                    || curve.points[n].corner
            };
            let points = curve.points.iter().enumerate().filter(|(n, _)| on_it(*n));
            spots.extend(points.map(|(n, point)| (number, n, point.at)));
        }
        spots.sort_by(|a, b| a.2.x.total_cmp(&b.2.x).then((a.0, a.1).cmp(&(b.0, b.1))));
        // The first of each group of points on one spot stands for all.
        let mut stands_for: Vec<usize> = (0..spots.len()).collect();
        for n in 0..spots.len() {
            for other in n + 1..spots.len() {
                if spots[other].2.x - spots[n].2.x > same_mm {
                    break;
                }
                let same_curve = spots[other].0 == spots[n].0;
                if !same_curve && spots[other].2.distance(spots[n].2) <= same_mm {
                    let (a, b) = (stands_for[n], stands_for[other]);
                    stands_for.iter_mut().for_each(|s| *s = if *s == b { a } else { *s });
                }
            }
        }
        let stays: BTreeSet<usize> = (0..spots.len())
            .filter(|&n| !moving.contains(&spots[n].0))
            .map(|n| stands_for[n])
            .collect();
        let group: BTreeMap<(usize, usize), usize> =
            spots.iter().enumerate().map(|(n, s)| ((s.0, s.1), stands_for[n])).collect();
        let mut count = 0;
        let mut of_group: BTreeMap<usize, usize> = BTreeMap::new();
        let mut curves = BTreeMap::new();
        for &number in moving {
            let curve = &design.curves[number];
            let mut new = || {
                count += 1;
                count - 1
            };
            let unknown = (0..curve.points.len())
                .map(|n| match group.get(&(number, n)) {
                    None => Some(new()),
                    Some(group) if stays.contains(group) => None,
                    Some(group) => Some(*of_group.entry(*group).or_insert_with(&mut new)),
                })
                .collect();
            curves.insert(number, MovingCurve::new(curve, unknown, sources(), number));
        }
        Self { curves, count }
    }

    /// The same unknowns where they have moved the design.
    pub(super) fn drawn_anew(&self, design: &Design, panels: &[Prepared]) -> Self {
        let sources = || panels.iter().flat_map(|panel| &panel.sources);
        let anew = |(&number, curve): (&usize, &MovingCurve)| {
            let drawn = &design.curves[number];
            (number, MovingCurve::new(drawn, curve.unknown.clone(), sources(), number))
        };
        Self { curves: self.curves.iter().map(anew).collect(), count: self.count }
    }

    /// The largest sum of shares, each without its sign, that a sample has in the points of a curve.
    pub(super) fn most_shares(&self) -> f64 {
        self.curves.values().map(|curve| curve.most_shares).fold(1.0, f64::max)
    }

    /// Where the samples of a panel are moved to, if they are held at their places of the curves.
    pub(super) fn places(&self, panel: &Prepared, displacements: &[Vec3]) -> Vec<Point3> {
        let moved = |(source, from): (&Sourced, Point3)| {
            let way: Vec3 =
                self.position(source).iter().map(|s| displacements[s.unknown] * s.factor).sum();
            if way == Vec3::ZERO { from } else { from + way }
        };
        panel.sources.iter().zip(panel.boundary.positions()).map(moved).collect()
    }

    /// How far each unknown may move, mm: by `limit_mm`, and, if points say so themselves, as they
    /// say.
    pub(super) fn radii_mm(&self, limit_mm: Option<f64>, by_point: bool) -> Vec<f64> {
        let mut radii = vec![f64::INFINITY; self.count];
        for curve in self.curves.values() {
            for (unknown, move_mm) in curve.unknown.iter().zip(&curve.move_mm) {
                let Some(radius) = unknown.and_then(|unknown| radii.get_mut(unknown)) else {
                    continue;
                };
                if let Some(limit_mm) = limit_mm {
                    *radius = radius.min(limit_mm);
                }
                if by_point {
                    *radius = radius.min(*move_mm);
                }
            }
        }
        radii
    }

    /// The design with its points moved.
    pub(super) fn moved(&self, design: &Design, displacements: &[Vec3]) -> Design {
        let mut moved = design.clone();
        for (&number, curve) in &self.curves {
            for (point, unknown) in moved.curves[number].points.iter_mut().zip(&curve.unknown) {
                // A point that stays keeps its bits.
                if let Some(way) = unknown.map(|unknown| displacements[unknown])
                    && way != Vec3::ZERO
                {
                    point.at += way;
                }
            }
        }
        moved
    }

    /// How the samples of a panel follow.
    pub(super) fn motions(&self, panel: &Prepared) -> Vec<Motion> {
        let positions = panel.sources.iter().map(|source| self.position(source)).collect();
        let mut motions = motions(&panel.boundary, positions);
        let size = panel.boundary.size();
        for (motion, source) in motions.iter_mut().zip(&panel.sources) {
            for (lean, place) in [
                (&mut motion.tangent_in, source.arriving),
                (&mut motion.tangent_out, source.leaving),
            ] {
                let Some(place) = place else { continue };
                // A tangent of a curve that stays does not turn.
                let Some(curve) = self.curves.get(&place.curve) else {
                    *lean = Lean { length_mm: size, shares: Vec::new() };
                    continue;
                };
                if let Some(exact) = curve.lean(place, NO_DERIVATIVE * size) {
                    *lean = exact;
                }
            }
        }
        motions
    }

    /// What the position of a sample follows.
    fn position(&self, source: &Sourced) -> Vec<Share> {
        let Some(place) = source.at else { return Vec::new() };
        let Some(curve) = self.curves.get(&place.curve) else { return Vec::new() };
        match curve.spans.get(place.span) {
            Some(span) => curve.shares(&position_shares(span, place.t)),
            // The point is the sample.
            None => {
                let unknown = curve.unknown[place.span];
                unknown.map(|unknown| Share { unknown, factor: 1.0 }).into_iter().collect()
            }
        }
    }
}

impl MovingCurve {
    fn new<'a>(
        curve: &DesignCurve,
        unknown: Vec<Option<usize>>,
        sources: impl Iterator<Item = &'a Sourced>,
        number: usize,
    ) -> Self {
        let are_samples = curve.kind.is_none() && curve.closed;
        let spans = if are_samples {
            Vec::new()
        } else {
            point_shares(kind_of_part(curve), &curve.points, curve.closed)
        };
        let on_it = sources.filter_map(|source| source.at.filter(|place| place.curve == number));
        let sum_of_shares = |place: OnCurve| -> f64 {
            let shares = spans.get(place.span).map(|span| position_shares(span, place.t));
            shares.iter().flatten().map(|share| share.factor.abs()).sum()
        };
        let most_shares = on_it.map(sum_of_shares).fold(1.0, f64::max);
        let points = curve.points.iter().map(|point| point.at.to_vec()).collect();
        let move_mm = curve.points.iter().map(|point| point.move_mm).collect();
        Self { spans, points, unknown, move_mm, most_shares }
    }

    /// The same shares in the unknowns; points that stay have none.
    fn shares(&self, of_points: &[PointShare]) -> Vec<Share> {
        let mut by_unknown: BTreeMap<usize, f64> = BTreeMap::new();
        for share in of_points {
            if let Some(unknown) = self.unknown[share.point] {
                *by_unknown.entry(unknown).or_default() += share.factor;
            }
        }
        let some = by_unknown.into_iter().filter(|(_, factor)| *factor != 0.0);
        some.map(|(unknown, factor)| Share { unknown, factor }).collect()
    }

    /// How a tangent follows: it is the direction of the derivative, which is linear in the points.
    fn lean(&self, place: OnCurve, least_mm: f64) -> Option<Lean> {
        let shares = derivative_shares(self.spans.get(place.span)?, place.t);
        let derivative: Vec3 = shares.iter().map(|s| self.points[s.point] * s.factor).sum();
        let length_mm = derivative.length();
        let sign = if place.reversed { -1.0 } else { 1.0 };
        let along: Vec<PointShare> =
            shares.iter().map(|s| PointShare { factor: sign * s.factor, ..*s }).collect();
        (length_mm > least_mm).then(|| Lean { length_mm, shares: self.shares(&along) })
    }
}

/// The shares of the points of a curve in its position at `t` of a span.
pub(super) fn position_shares(span: &SpanShares, t: f64) -> Vec<PointShare> {
    let s = 1.0 - t;
    weighed(span, [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t])
}

/// Their shares in its derivative by `t`.
fn derivative_shares(span: &SpanShares, t: f64) -> Vec<PointShare> {
    let s = 1.0 - t;
    let (a, b, c) = (3.0 * s * s, 6.0 * s * t, 3.0 * t * t);
    weighed(span, [-a, a - b, b - c, c])
}

fn weighed(span: &SpanShares, weights: [f64; 4]) -> Vec<PointShare> {
    let mut by_point: BTreeMap<usize, f64> = BTreeMap::new();
    for (list, weight) in span.iter().zip(weights) {
        for share in list {
            *by_point.entry(share.point).or_default() += weight * share.factor;
        }
    }
    by_point.into_iter().map(|(point, factor)| PointShare { point, factor }).collect()
}
