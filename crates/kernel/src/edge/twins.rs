//! Edges on two curves that lie on one another, as where two pipes meet of which each has a curve
//! of its own, or where three meet and each edge lies on a part of either other. The straight end
//! of a strip may lie on a curve likewise, as planks end on the edge of a transom.
//!
//! Sampled apart, two polylines on one curve are as far from one another as their chords are from
//! the curve. How far that is can be told from a polyline alone: a point lies four times as far
//! from the chord of its neighbours. So each corner of one must lie nearer to the other than both
//! chords may lie, and likewise the other way round. Where that holds for a run of corners alone,
//! the run is a common stretch, unless it is so short that two curves which merely touch would be
//! as near to one another.

use super::shared::{Line, Shared, parted};
use sheetwright_geometry::math::{Point3, unit};

/// A point where a polyline turns by more than this (the cosine of 30°) is a corner of its curve,
/// which lies on both.
const CORNER_COS: f64 = 0.866;
/// A common stretch is no shorter than this share of the shorter edge.
const LEAST_SHARE: f64 = 0.05;
/// A common stretch is no shorter than so many times the distance within which it is found: two
/// curves that part by half a degree are as near to one another along a hundred times that.
const LEAST_TIMES: f64 = 100.0;
/// Both lengths of a common stretch differ by less than this share.
const SAME_LENGTH: f64 = 0.1;

/// Two edges that lie on one another.
pub(super) struct Twins {
    /// Their numbers, the smaller one first.
    pub(super) pair: [usize; 2],
    /// Along which stretches; `None` where the whole of one lies on the whole of the other.
    pub(super) common: Option<Vec<Shared>>,
}

/// Steps of a polyline that are looked at together.
const BLOCK: usize = 32;

struct Course<'a> {
    line: Line<'a>,
    low: Point3,
    high: Point3,
    /// The boxes around its steps, so many at a time.
    blocks: Vec<[Point3; 2]>,
    /// The largest distance of its chords from its curve, mm, estimated.
    off_mm: f64,
}

impl<'a> Course<'a> {
    fn new((points, is_loop): (&'a [Point3], bool)) -> Self {
        let [low, high] = around(points);
        // A block has the point that the next one begins with.
        let count = points.len().saturating_sub(1);
        let blocks = (0..count).step_by(BLOCK);
        let blocks = blocks.map(|from| around(&points[from..=(from + BLOCK).min(count)])).collect();
        let off_mm = points.windows(3).filter_map(|three| {
            let [a, b] = [three[1] - three[0], three[2] - three[1]];
            let is_smooth = unit(a)?.dot(unit(b)?) > CORNER_COS;
            is_smooth.then(|| 0.25 * three[1].distance_to_segment([three[0], three[2]]))
        });
        let off_mm = off_mm.fold(0.0, f64::max);
        Self { line: Line::new(points, is_loop), low, high, blocks, off_mm }
    }

    /// Whether a point lies near to it.
    fn has_near(&self, p: Point3, within_mm: f64) -> bool {
        let is_between =
            |at: f64, low: f64, high: f64| low - within_mm <= at && at <= high + within_mm;
        let is_in = |[low, high]: [Point3; 2]| {
            is_between(p.x, low.x, high.x)
                && is_between(p.y, low.y, high.y)
                && is_between(p.z, low.z, high.z)
        };
        let points = self.line.points;
        is_in([self.low, self.high])
            && self.blocks.iter().enumerate().filter(|(_, block)| is_in(**block)).any(|(n, _)| {
                let steps = points[n * BLOCK..].windows(2).take(BLOCK);
                steps.into_iter().any(|s| p.distance_to_segment([s[0], s[1]]) <= within_mm)
            })
    }

    /// Which of its points lie near to another.
    fn near(&self, other: &Self, within_mm: f64) -> Vec<bool> {
        self.line.points.iter().map(|&p| other.has_near(p, within_mm)).collect()
    }
}

/// The least and the greatest coordinates of some points.
fn around(points: &[Point3]) -> [Point3; 2] {
    [f64::min, f64::max].map(|of| {
        let both = |a: Point3, b: Point3| Point3::new(of(a.x, b.x), of(a.y, b.y), of(a.z, b.z));
        points.iter().copied().reduce(both).unwrap_or_default()
    })
}

/// The pairs of polylines that lie on one another, up to `least_mm` and how far chords lie from
/// curves; of each it is said whether it is a whole loop, and `may_meet` says which are looked at.
pub(super) fn twins(
    lines: &[(&[Point3], bool)],
    least_mm: f64,
    may_meet: impl Fn([usize; 2]) -> bool,
) -> Vec<Twins> {
    let lines: Vec<Course<'_>> = lines.iter().map(|&line| Course::new(line)).collect();
    let most_mm = least_mm + 2.0 * lines.iter().map(|line| line.off_mm).fold(0.0, f64::max);
    let mut by_x: Vec<usize> = (0..lines.len()).collect();
    by_x.sort_by(|&a, &b| lines[a].low.x.total_cmp(&lines[b].low.x).then(a.cmp(&b)));
    let mut found = Vec::new();
    for (place, &n) in by_x.iter().enumerate() {
        let beside = by_x[place + 1..].iter();
        for &k in beside.take_while(|&&k| lines[k].low.x <= lines[n].high.x + most_mm) {
            let pair = [n.min(k), n.max(k)];
            if may_meet(pair) {
                let common = common(&lines[pair[0]], &lines[pair[1]], least_mm);
                found.extend(common.map(|common| Twins { pair, common }));
            }
        }
    }
    found.sort_by_key(|twins| twins.pair);
    found
}

/// How two polylines lie on one another, if they do: along which stretches, or as wholes.
fn common(a: &Course<'_>, b: &Course<'_>, least_mm: f64) -> Option<Option<Vec<Shared>>> {
    let within_mm = least_mm + a.off_mm + b.off_mm;
    let [low, high] = [a.low.to_vec() - b.high.to_vec(), b.low.to_vec() - a.high.to_vec()];
    let apart = [low.x, low.y, low.z, high.x, high.y, high.z];
    if apart.into_iter().any(|gap| gap > within_mm) {
        return None;
    }
    let near = [a.near(b, within_mm), b.near(a, within_mm)];
    if near.iter().flatten().all(|&is_near| is_near) {
        return Some(None);
    }
    let stretches = stretches([a, b], [&near[0], &near[1]], within_mm);
    (!stretches.is_empty()).then_some(Some(stretches))
}

/// The common stretches of two polylines of which these points lie near to the other.
fn stretches(
    [a, b]: [&Course<'_>; 2],
    [near_a, near_b]: [&[bool]; 2],
    within_mm: f64,
) -> Vec<Shared> {
    let whole = a.line.length();
    let least_mm = (LEAST_SHARE * whole.min(b.line.length())).max(LEAST_TIMES * within_mm);
    // Where the points of each lie on the first one: a stretch may end between two of its own.
    let own = near_a.iter().zip(&a.line.lengths).map(|(&near, &at)| (at, near));
    let points_of_b = near_b.iter().zip(b.line.points).filter(|(near, _)| **near);
    let others = points_of_b.map(|(_, &p)| (a.line.nearest(p), true));
    let mut places: Vec<(f64, bool)> = own.chain(others).collect();
    places.sort_by(|p, q| p.0.total_cmp(&q.0));
    if a.line.is_loop {
        // A loop begins where it is apart, so that no stretch runs over its beginning.
        places.pop();
        let first = places.iter().position(|(_, near)| !near).unwrap_or(0);
        places.rotate_left(first);
        let turned = places.len() - first;
        places[turned..].iter_mut().for_each(|(at, _)| *at += whole);
    }
    let runs = places.chunk_by(|p, q| p.1 == q.1).filter(|run| run[0].1);
    let stretch = |run: &[(f64, bool)]| {
        let [from, to] = [run[0].0, run[run.len() - 1].0];
        let mut along = b.line.nearest(a.line.at(from));
        let start = along;
        for &(at, _) in &run[1..] {
            along = b.line.nearest_about(a.line.at(at), along);
        }
        Shared { first: [from, to], second: [start, along] }
    };
    let is_common = |shared: &Shared| {
        let [own, other] = [shared.first, shared.second].map(|[from, to]| (to - from).abs());
        own >= least_mm
            && (own - other).abs() <= SAME_LENGTH * own
            && !strays([a, b], shared, within_mm)
    };
    let found = runs.map(stretch).filter(is_common);
    found.flat_map(|shared| parted(shared, &a.line, &b.line)).collect()
}

/// Whether the second polyline leaves the first between the ends of a stretch, as an arc leaves its
/// chord: the first may have no point between. Where curves part, the ends are not exact.
fn strays([a, b]: [&Course<'_>; 2], stretch: &Shared, within_mm: f64) -> bool {
    let [from, to] = stretch.second;
    let (low, high) = (from.min(to), from.max(to));
    let turn = if b.line.is_closed { b.line.length() } else { 0.0 };
    let is_between =
        |at: f64| (-2..=2).map(|n| at + f64::from(n) * turn).any(|at| low < at && at < high);
    let mut points = b.line.lengths.iter().zip(b.line.points);
    points.any(|(&at, &p)| is_between(at) && !a.has_near(p, 2.0 * within_mm))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::math::{cos, sin};
    use std::f64::consts::{PI, TAU};

    fn of(lines: &[&[Point3]]) -> Vec<([usize; 2], Option<Vec<Shared>>)> {
        let lines: Vec<(&[Point3], bool)> = lines.iter().map(|&points| (points, false)).collect();
        twins(&lines, 1e-6, |_| true).into_iter().map(|t| (t.pair, t.common)).collect()
    }

    /// A ring of 100 mm about a height, closed, in so many steps from an angle.
    fn ring(steps: usize, from: f64, z: f64) -> Vec<Point3> {
        let at = |n: usize| {
            let angle = from + TAU * n as f64 / steps as f64;
            Point3::new(100.0 * cos(angle), 100.0 * sin(angle), z)
        };
        (0..=steps).map(|n| at(n % steps)).collect()
    }

    #[test]
    fn rings_that_begin_elsewhere_are_twins_and_rings_beside_them_are_none() {
        let rings = [ring(60, 0.0, 0.0), ring(47, 1.0, 0.0), ring(60, 0.3, 1.0)];
        let lines: Vec<&[Point3]> = rings.iter().map(|ring| &ring[..]).collect();
        assert_eq!(of(&lines), [([0, 1], None)]);
    }

    #[test]
    fn a_part_of_a_ring_is_a_stretch_of_it() {
        let [ring, other] = [ring(60, 0.0, 0.0), ring(47, 1.0, 0.0)];
        let half = &ring[..31];
        let found = of(&[half, &other]);
        assert_eq!(found.len(), 1);
        let length_mm = PI * 100.0;
        // The other one begins at an angle of 1, on the half: the stretch is parted there.
        let stretches = found[0].1.clone().unwrap();
        let lengths: Vec<f64> = stretches.iter().map(|s| s.first[1] - s.first[0]).collect();
        assert_eq!(lengths.len(), 2, "{lengths:?}");
        assert!((lengths[0] - 100.0).abs() < 0.5, "{lengths:?}");
        assert!((lengths[0] + lengths[1] - length_mm).abs() < 0.5, "{lengths:?}");
        // Two arcs that begin and end at other places have what lies between in common.
        let arcs = [&ring[..31], &ring[20..51]];
        let stretches = of(&arcs)[0].1.clone().unwrap();
        assert_eq!(stretches.len(), 1);
        assert!((stretches[0].first[1] - stretches[0].first[0] - length_mm / 3.0).abs() < 0.1);
        assert!(stretches[0].second[0].abs() < 1e-9, "{stretches:?}");
    }

    #[test]
    fn lines_that_cross_or_touch_have_nothing_in_common() {
        let ring = ring(60, 0.0, 0.0);
        let touching = [Point3::new(100.0, -50.0, 0.0), Point3::new(100.0, 50.0, 0.0)];
        let crossing = [Point3::new(0.0, 0.0, 0.0), Point3::new(200.0, 1.0, 0.0)];
        assert!(of(&[&ring, &touching]).is_empty());
        assert!(of(&[&ring, &crossing]).is_empty());
        // Of two straight ones that overlap, the overlap.
        let along = |from: f64, to: f64| [from, to].map(|x| Point3::new(x, 0.0, 0.0));
        let found = of(&[&along(0.0, 10.0), &along(16.0, 6.0)]);
        assert_eq!(found[0].1, Some(vec![Shared { first: [6.0, 10.0], second: [10.0, 6.0] }]));
    }

    #[test]
    fn an_arc_and_its_chord_have_nothing_in_common() {
        let chord = [0.0, 1000.0].map(|x| Point3::new(x, 0.0, 0.0));
        let arc: Vec<Point3> = (0..=199)
            .map(|n| f64::from(n) / 199.0)
            .map(|t| Point3::new(1000.0 * t, 320.0 * t * (1.0 - t), 0.0))
            .collect();
        assert!(of(&[&chord, &arc]).is_empty());
        assert!(of(&[&arc, &chord]).is_empty());
    }

    #[test]
    fn corners_do_not_make_a_polyline_near_to_others() {
        let zigzag = |d: f64| -> Vec<Point3> {
            let points = [[0.0, 0.0], [10.0, 8.0 + d], [20.0, 0.0]];
            points.map(|[x, y]| Point3::new(x, y, 0.0)).to_vec()
        };
        let [a, b] = [zigzag(0.0), zigzag(0.5)];
        assert!(of(&[&a, &b]).is_empty());
        assert_eq!(of(&[&a, &a]), [([0, 1], None)]);
    }
}
