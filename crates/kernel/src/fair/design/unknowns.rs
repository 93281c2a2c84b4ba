//! The points that move, as unknowns, and how samples follow them.

use super::respacing::slips;
use super::symmetry::{CurvePlace, IN_PLANE, MIRRORED, Symmetry};
use crate::design::{Design, DesignCurve};
use crate::fair::{Lean, Motion, Share, motions};
use crate::sample::{OnCurve, Prepared, Sourced, kind_of_part};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::curve::{
    Curve, CurveKind, PointShare, SpanShares, derivative_shares, point_shares, position_shares,
};
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::tolerance::Tolerance;
use std::collections::{BTreeMap, BTreeSet};

/// A derivative below this share of the size of the boundary has no clear direction; the tangent
/// there follows the samples beside it.
const NO_DERIVATIVE: f64 = 1e-9;

/// A curve that moves.
struct MovingCurve {
    /// The curve, and the shares of its spans; none where its points are the samples.
    curve: Option<Curve>,
    spans: Vec<SpanShares>,
    /// The positions of its points, mm.
    points: Vec<Vec3>,
    /// The unknown that each point follows, and how; none of a point that stays.
    follows: Vec<Option<Share>>,
    /// The distance that each point itself allows, mm.
    move_mm: Vec<f64>,
    /// The largest sum of absolute shares that a sample has in the points.
    most_shares: f64,
}

/// The unknowns of a problem.
pub(super) struct Unknowns {
    curves: BTreeMap<usize, MovingCurve>,
    count: usize,
}

impl Unknowns {
    /// Those of the points of these curves. Points on one spot are one, and so are mirror images of
    /// one another; those on the spot of a curve that stays, stay.
    pub(super) fn new(
        design: &Design,
        moving: &BTreeSet<usize>,
        panels: &[Prepared],
        symmetry: Option<&Symmetry>,
    ) -> Self {
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
        let mut alike = Alike::default();
        for n in 0..spots.len() {
            for other in n + 1..spots.len() {
                if spots[other].2.x - spots[n].2.x > same_mm {
                    break;
                }
                let same_curve = spots[other].0 == spots[n].0;
                if !same_curve && spots[other].2.distance(spots[n].2) <= same_mm {
                    let place = |n: usize| (spots[n].0, spots[n].1);
                    alike.join([place(n), place(other)], false);
                }
            }
        }
        for pair in symmetry.map_or_else(Vec::new, |symmetry| symmetry.pairs(design, moving)) {
            alike.join(pair, true);
        }
        let classes = alike.classes(|place| !moving.contains(&place.0));
        let mut count = 0;
        // The first point of a class is its unknown.
        let mut firsts: BTreeMap<usize, (usize, bool)> = BTreeMap::new();
        let mut curves = BTreeMap::new();
        for &number in moving {
            let curve = &design.curves[number];
            let mut new = || {
                count += 1;
                count - 1
            };
            let mut share = |n: usize| -> Option<Share> {
                let Some(place) = classes.places.get(&(number, n)) else {
                    return Some(Share { unknown: new(), factor: Vec3::ONE });
                };
                let &Member { class, is_image } = place;
                if classes.stay.contains(&class) {
                    return None;
                }
                let (unknown, of_image) = *firsts.entry(class).or_insert_with(|| (new(), is_image));
                let factor = match classes.in_plane.contains(&class) {
                    true => IN_PLANE,
                    false if is_image == of_image => Vec3::ONE,
                    false => MIRRORED,
                };
                Some(Share { unknown, factor })
            };
            let follows = (0..curve.points.len()).map(&mut share).collect();
            curves.insert(number, MovingCurve::new(curve, follows, sources(), number));
        }
        Self { curves, count }
    }

    /// These unknowns for `design`, whose points they have moved: its curves are drawn anew.
    pub(super) fn drawn_anew(&self, design: &Design, panels: &[Prepared]) -> Self {
        let sources = || panels.iter().flat_map(|panel| &panel.sources);
        let anew = |(&number, curve): (&usize, &MovingCurve)| {
            let drawn = &design.curves[number];
            (number, MovingCurve::new(drawn, curve.follows.clone(), sources(), number))
        };
        Self { curves: self.curves.iter().map(anew).collect(), count: self.count }
    }

    /// The largest sum of absolute shares that a sample has in the points of a curve.
    pub(super) fn most_shares(&self) -> f64 {
        self.curves.values().map(|curve| curve.most_shares).fold(1.0, f64::max)
    }

    /// The moved positions of the samples of a panel, held at their places of the curves.
    pub(super) fn places(&self, panel: &Prepared, displacements: &[Vec3]) -> Vec<Point3> {
        let moved = |(source, from): (&Sourced, Point3)| {
            let way: Vec3 =
                self.position(source).iter().map(|s| displacements[s.unknown] * s.factor).sum();
            if way == Vec3::ZERO { from } else { from + way }
        };
        panel.sources.iter().zip(panel.boundary.positions()).map(moved).collect()
    }

    /// The limit of each unknown, mm: the least of `limit_mm` and, if `by_point`, the distances of
    /// its points.
    pub(super) fn radii_mm(&self, limit_mm: Option<f64>, by_point: bool) -> Vec<f64> {
        let mut radii = vec![f64::INFINITY; self.count];
        for curve in self.curves.values() {
            for (share, move_mm) in curve.follows.iter().zip(&curve.move_mm) {
                let Some(radius) = share.and_then(|share| radii.get_mut(share.unknown)) else {
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
            for (point, share) in moved.curves[number].points.iter_mut().zip(&curve.follows) {
                // A point that stays keeps its bits.
                if let Some(way) = share.map(|share| displacements[share.unknown] * share.factor)
                    && way != Vec3::ZERO
                {
                    point.at += way;
                }
            }
        }
        moved
    }

    /// How the samples of a panel follow the unknowns.
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
                    *lean = Lean { length_mm: size, ..Lean::default() };
                    continue;
                };
                if let Some(exact) = curve.lean(place, NO_DERIVATIVE * size) {
                    *lean = exact;
                }
            }
        }
        self.let_slip(&mut motions, panel);
        motions
    }

    fn let_slip(&self, motions: &mut [Motion], panel: &Prepared) {
        for (&number, moving) in &self.curves {
            let Some(curve) = &moving.curve else { continue };
            let on_it = panel.sources.iter().enumerate().filter_map(|(n, source)| {
                let place = source.at.filter(|place| place.curve == number)?;
                Some((n, place.span, place.t))
            });
            let places: Vec<(usize, usize, f64)> = on_it.collect();
            for slipping in slips(curve, &moving.spans, &moving.follows, &places) {
                let motion = &mut motions[slipping.number];
                let reversed = panel.sources[slipping.number].at.is_some_and(|p| p.reversed);
                let bend = if reversed { -slipping.bend } else { slipping.bend };
                motion.slip = slipping.slip;
                motion.along = slipping.along;
                motion.tangent_in.bend = bend;
                motion.tangent_out.bend = bend;
            }
        }
    }

    /// The shares of the unknowns in the position of a sample.
    fn position(&self, source: &Sourced) -> Vec<Share> {
        let Some(place) = source.at else { return Vec::new() };
        let Some(curve) = self.curves.get(&place.curve) else { return Vec::new() };
        match curve.spans.get(place.span) {
            Some(span) => curve.shares(&position_shares(span, place.t)),
            // The point is the sample.
            None => curve.follows[place.span].into_iter().collect(),
        }
    }
}

impl MovingCurve {
    fn new<'a>(
        curve: &DesignCurve,
        follows: Vec<Option<Share>>,
        sources: impl Iterator<Item = &'a Sourced>,
        number: usize,
    ) -> Self {
        let are_samples = curve.kind.is_none() && curve.closed;
        let kind = kind_of_part(curve);
        let drawn = Curve::new(kind, &curve.points, curve.closed).ok().filter(|_| !are_samples);
        let spans = match drawn {
            Some(_) => point_shares(kind, &curve.points, curve.closed),
            None => Vec::new(),
        };
        let on_it = sources.filter_map(|source| source.at.filter(|place| place.curve == number));
        let sum_of_shares = |place: OnCurve| -> f64 {
            let shares = spans.get(place.span).map(|span| position_shares(span, place.t));
            shares.iter().flatten().map(|share| share.factor.abs()).sum()
        };
        let most_shares = on_it.map(sum_of_shares).fold(1.0, f64::max);
        let points = curve.points.iter().map(|point| point.at.to_vec()).collect();
        let move_mm = curve.points.iter().map(|point| point.move_mm).collect();
        Self { curve: drawn, spans, points, follows, move_mm, most_shares }
    }

    /// Shares of the unknowns, from those of the points; points that stay have none.
    fn shares(&self, of_points: &[PointShare]) -> Vec<Share> {
        let mut by_unknown: BTreeMap<usize, Vec3> = BTreeMap::new();
        for share in of_points {
            if let Some(Share { unknown, factor }) = self.follows[share.point] {
                *by_unknown.entry(unknown).or_default() += factor * share.factor;
            }
        }
        let some = by_unknown.into_iter().filter(|(_, factor)| *factor != Vec3::ZERO);
        some.map(|(unknown, factor)| Share { unknown, factor }).collect()
    }

    /// How a tangent follows the unknowns: it is the direction of the derivative, which is linear
    /// in the points.
    fn lean(&self, place: OnCurve, least_mm: f64) -> Option<Lean> {
        let shares = derivative_shares(self.spans.get(place.span)?, place.t);
        let derivative: Vec3 = shares.iter().map(|s| self.points[s.point] * s.factor).sum();
        let length_mm = derivative.length();
        let sign = if place.reversed { -1.0 } else { 1.0 };
        let along: Vec<PointShare> =
            shares.iter().map(|s| PointShare { factor: sign * s.factor, ..*s }).collect();
        (length_mm > least_mm).then(|| Lean {
            length_mm,
            shares: self.shares(&along),
            bend: Vec3::ZERO,
        })
    }
}

/// Which points move alike.
#[derive(Default)]
struct Alike {
    /// The points that each moves alike with, and whether as its mirror image.
    with: BTreeMap<CurvePlace, Vec<(CurvePlace, bool)>>,
}

/// The classes of points that move alike.
struct Classes {
    places: BTreeMap<CurvePlace, Member>,
    /// The classes with a point that is its own mirror image.
    in_plane: BTreeSet<usize>,
    /// The classes with a point that stays.
    stay: BTreeSet<usize>,
}

/// A point in its class.
#[derive(Clone, Copy)]
struct Member {
    class: usize,
    /// Whether it is the mirror image of the first.
    is_image: bool,
}

impl Alike {
    fn join(&mut self, [a, b]: [CurvePlace; 2], is_image: bool) {
        self.with.entry(a).or_default().push((b, is_image));
        self.with.entry(b).or_default().push((a, is_image));
    }

    fn classes(&self, stays: impl Fn(CurvePlace) -> bool) -> Classes {
        let (places, in_plane, stay) = (BTreeMap::new(), BTreeSet::new(), BTreeSet::new());
        let mut classes = Classes { places, in_plane, stay };
        for (class, &first) in self.with.keys().enumerate() {
            if classes.places.contains_key(&first) {
                continue;
            }
            classes.places.insert(first, Member { class, is_image: false });
            let mut left = vec![(first, false)];
            while let Some((place, own)) = left.pop() {
                if stays(place) {
                    classes.stay.insert(class);
                }
                for &(other, turned) in &self.with[&place] {
                    let is_image = own != turned;
                    match classes.places.get(&other) {
                        None => {
                            classes.places.insert(other, Member { class, is_image });
                            left.push((other, is_image));
                        }
                        Some(known) if known.is_image != is_image => {
                            classes.in_plane.insert(class);
                        }
                        Some(_) => {}
                    }
                }
            }
        }
        classes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::design::{CurveUse, DesignPanel, PanelShape};
    use crate::fair::moved_samples;
    use crate::sample::{Sampler, matched, prepare};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{cos, sin};
    use sheetwright_geometry::watch::Unwatched;

    /// A loop of two curves of a kind with a corner in one of them, the other run backwards.
    fn leaf(kind: CurveKind) -> Design {
        let at = |x: f64, y: f64| Point3::new(x, y, 12.0 * sin(0.05 * x) + 0.1 * y);
        let arc = |side: f64| {
            let point = move |n: usize| {
                let t = n as f64 / 8.0;
                let bulge =
                    side * 40.0 * sin(std::f64::consts::PI * t) * (1.0 + 0.2 * cos(9.0 * t));
                CurvePoint::smooth(at(200.0 * t * (1.3 - 0.3 * t), bulge))
            };
            (0..9).map(point).collect::<Vec<_>>()
        };
        let curve = |name: &str, points| DesignCurve {
            name: name.into(),
            kind: Some(kind),
            closed: false,
            points,
        };
        let mut curves = vec![curve("low", arc(-1.0)), curve("high", arc(1.0))];
        curves[1].points[5].corner = true;
        let uses = [("low", false), ("high", true)];
        let outer = uses.map(|(name, reversed)| CurveUse { name: name.into(), reversed });
        let panel = DesignPanel {
            fold: 1.0,
            ..DesignPanel::new(
                "leaf",
                PanelShape::Loops { outer: outer.to_vec(), holes: Vec::new() },
                60,
            )
        };
        Design { curves, panels: vec![panel], ..Design::default() }
    }

    fn prepared(design: &Design) -> Prepared {
        let matched = matched(design);
        let sampler = Sampler { design, matched: &matched };
        prepare(&sampler, &design.panels[0], &mut Unwatched).unwrap()
    }

    /// Samples and tangents agree with those of the moved design up to the square of the
    /// displacement; with splines, also up to the effect of their chord lengths.
    #[test]
    fn samples_follow_as_moved_curves_are_sampled() {
        for (kind, exact) in
            [(CurveKind::Polyline, true), (CurveKind::BSpline, true), (CurveKind::Spline, false)]
        {
            let design = leaf(kind);
            let before = prepared(&design);
            let unknowns =
                Unknowns::new(&design, &BTreeSet::from([0, 1]), &[prepared(&design)], None);
            assert_eq!(unknowns.count, 16, "the ends are shared");
            let motions = unknowns.motions(&before);
            let missed = |long: f64| {
                let way = |n: usize| {
                    let t = n as f64;
                    Vec3::new(sin(3.0 * t), cos(5.0 * t), sin(7.0 * t + 1.0)) * long
                };
                let ways: Vec<Vec3> = (0..unknowns.count).map(way).collect();
                let told = moved_samples(before.boundary.samples(), &motions, &ways).unwrap();
                let drawn = prepared(&unknowns.moved(&design, &ways));
                let pairs = told.iter().zip(drawn.boundary.samples());
                pairs.fold([0.0f64; 2], |[at, along], (told, drawn)| {
                    assert_eq!(told.is_corner(), drawn.is_corner());
                    let turned = |a: Vec3, b: Vec3| (a - b).length();
                    [
                        at.max(told.position.distance(drawn.position)),
                        along
                            .max(turned(told.tangent_in, drawn.tangent_in))
                            .max(turned(told.tangent_out, drawn.tangent_out)),
                    ]
                })
            };
            let [far, near] = [missed(0.01), missed(0.001)];
            for (far, near) in far.into_iter().zip(near) {
                if exact {
                    assert!(near < 0.02 * far + 1e-12, "{kind:?}: {far:e} {near:e}");
                }
                // A spline of nine points that all move independently: chords matter most here.
                assert!(near < 5e-4, "{kind:?}: {near:e}");
            }
        }
    }
}
