//! The stretches that two joined edges have in common, so that places on the one are found on the
//! other.
//!
//! The ends of each edge are looked for on the other, at the point that lies nearest in space. What
//! lies between the inner two of the four is the common stretch. A place on it is named by its
//! share of the length in space, from the end at which it begins on the first edge; so holes and
//! notches on both meet when the edges are joined, however each of them was sampled.
//!
//! An edge may be closed in two ways. Round a hole it has no end at all, and a stretch may run on
//! over its beginning. The ring at the end of a rolled pipe begins and ends at the pipe's seam,
//! where the pattern is open: a stretch that runs over the seam of one of both edges is two.

use sheetwright_geometry::math::Point3;

/// Both edges must pass this near in the middle of what they share, as a share of its length; two
/// halves of a ring meet at their ends alone.
const MEET: f64 = 0.1;
/// What is shorter than this share of the shorter edge is a common corner.
const LEAST: f64 = 1e-6;

/// What two edges share: from where to where on each, mm in space from its beginning. The second
/// one is usually run backwards. A value beyond the length of a closed edge goes on from its
/// beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shared {
    /// On the first edge, forwards.
    pub(crate) first: [f64; 2],
    /// On the second edge, at the points that meet those.
    pub(crate) second: [f64; 2],
}

/// A polyline in space with the lengths to its points, mm.
#[derive(Clone, Debug)]
pub(super) struct Line<'a> {
    pub(super) points: &'a [Point3],
    pub(super) lengths: Vec<f64>,
    /// Whether it ends where it begins.
    pub(super) is_closed: bool,
    /// Whether it is closed on the pattern, too.
    pub(super) is_loop: bool,
}

impl<'a> Line<'a> {
    /// The line through two points or more; `is_loop` says whether it is a whole loop of a border.
    pub(super) fn new(points: &'a [Point3], is_loop: bool) -> Self {
        let lengths = lengths(points);
        let gap_mm = points[0].distance(points[points.len() - 1]);
        let is_closed = is_loop || gap_mm <= LEAST * lengths[lengths.len() - 1];
        Self { points, lengths, is_closed, is_loop }
    }

    pub(super) fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Whether its pattern is open at a seam, where it ends and begins in space.
    fn has_seam(&self) -> bool {
        self.is_closed && !self.is_loop
    }

    /// The length to the point that lies nearest to `p`, mm.
    pub(super) fn nearest(&self, p: Point3) -> f64 {
        let on_step = |n: usize| {
            let way = self.points[n + 1] - self.points[n];
            let share = (p - self.points[n]).dot(way) / way.length_squared();
            let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
            let at = self.points[n].lerp(self.points[n + 1], share);
            let along = self.lengths[n] + share * (self.lengths[n + 1] - self.lengths[n]);
            (p.distance(at), along)
        };
        let steps = (0..self.points.len() - 1).map(on_step);
        steps.reduce(|a, b| if b.0 < a.0 { b } else { a }).map_or(0.0, |(_, along)| along)
    }

    /// The length to the point that lies nearest to `p`, mm; on a closed line so many times round
    /// it as comes nearest to `about`.
    pub(super) fn nearest_about(&self, p: Point3, about: f64) -> f64 {
        let along = self.nearest(p);
        if !self.is_closed {
            return along;
        }
        along + ((about - along) / self.length()).round() * self.length()
    }

    pub(super) fn at(&self, along: f64) -> Point3 {
        let along = if self.is_closed { along.rem_euclid(self.length()) } else { along };
        let last = self.points.len() - 2;
        let n = self.lengths[1..].partition_point(|&length| length < along).min(last);
        let step = self.lengths[n + 1] - self.lengths[n];
        let share =
            if step > 0.0 { ((along - self.lengths[n]) / step).clamp(0.0, 1.0) } else { 0.0 };
        self.points[n].lerp(self.points[n + 1], share)
    }
}

/// The lengths from the beginning of a polyline to its points, mm.
pub(crate) fn lengths(points: &[Point3]) -> Vec<f64> {
    let mut sum = 0.0;
    let steps = points.windows(2).map(|step| {
        sum += step[0].distance(step[1]);
        sum
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// The stretches that two edges have in common, each through two points or more and with whether
/// it is a whole loop of a border: none if it is no more than a point, two where one begins beside
/// the seam of the other.
pub(crate) fn shared(first: (&[Point3], bool), second: (&[Point3], bool)) -> Vec<Shared> {
    let (a, b) = (Line::new(first.0, first.1), Line::new(second.0, second.1));
    let found = match (a.is_closed, b.is_closed) {
        // Where one has no seam, the other begins at its own.
        (true, true) if a.is_loop && !b.is_loop => {
            let Shared { first, second } = round(&b, &a);
            Some(Shared { first: second, second: first }.forwards())
        }
        (true, true) => Some(round(&a, &b)),
        (true, false) => Some(on_loop(&a, &b).forwards()),
        (false, true) => {
            let Shared { first, second } = on_loop(&b, &a);
            Some(Shared { first: second, second: first }.forwards())
        }
        (false, false) => between(&a, &b),
    };
    found.map_or_else(Vec::new, |found| parted(found, &a, &b))
}

/// A stretch of two lines, in two or more where it runs over a seam of one of them; none if it is
/// no more than a point, or the lines do not meet along it.
pub(super) fn parted(found: Shared, a: &Line<'_>, b: &Line<'_>) -> Vec<Shared> {
    let least = LEAST * a.length().min(b.length());
    let [from, to] = found.first;
    let [from_b, to_b] = found.second;
    let middle = a.at(0.5 * (from + to)).distance(b.at(0.5 * (from_b + to_b)));
    if to - from <= least || middle > MEET * (to - from) {
        return Vec::new();
    }
    let mut places = vec![[from, from_b], [to, to_b]];
    let about = |at: f64, [from, to]: [f64; 2], [over, until]: [f64; 2]| {
        over + (until - over) * (at - from) / (to - from)
    };
    for at in seams(a, found.first) {
        places.push([at, b.nearest_about(a.at(at), about(at, found.first, found.second))]);
    }
    for at in seams(b, found.second) {
        places.push([a.nearest_about(b.at(at), about(at, found.second, found.first)), at]);
    }
    places.sort_by(|p, q| p[0].total_cmp(&q[0]));
    let steps = places
        .windows(2)
        .map(|ends| Shared { first: [ends[0][0], ends[1][0]], second: [ends[0][1], ends[1][1]] });
    let is_stretch = |part: &Shared| {
        let [own, other] = [part.first, part.second].map(|[from, to]| (to - from).abs());
        own > least && other > least
    };
    steps.filter(is_stretch).map(|part| part.within(a, b)).collect()
}

/// The lengths between these two at which a line passes its seam.
fn seams(line: &Line<'_>, [from, to]: [f64; 2]) -> Vec<f64> {
    if !line.has_seam() {
        return Vec::new();
    }
    let (low, high) = (from.min(to), from.max(to));
    let first = (low / line.length()).floor();
    let rounds = (0..4).map(|n| (first + f64::from(n)) * line.length());
    rounds.filter(|&at| low < at && at < high).collect()
}

impl Shared {
    /// With the first edge run forwards.
    fn forwards(self) -> Self {
        let [from, to] = self.first;
        if from <= to {
            return self;
        }
        Self { first: [to, from], second: [self.second[1], self.second[0]] }
    }

    /// With both edges in each other's place.
    pub(crate) fn swapped(self) -> Self {
        Self { first: self.second, second: self.first }.forwards()
    }

    /// With lengths along lines that have a seam between those of their ends.
    fn within(self, a: &Line<'_>, b: &Line<'_>) -> Self {
        let back = |line: &Line<'_>, range: [f64; 2]| {
            if !line.has_seam() {
                return range;
            }
            let whole = line.length();
            let rounds = (0.5 * (range[0] + range[1]) / whole).floor();
            range.map(|at| (at - rounds * whole).clamp(0.0, whole))
        };
        Self { first: back(a, self.first), second: back(b, self.second) }
    }
}

/// What two closed edges share: the whole of the first, from its beginning.
fn round(a: &Line<'_>, b: &Line<'_>) -> Shared {
    let start = b.nearest(a.at(0.0));
    // Where both begin in one place, up to rounding.
    let is_end = start.min(b.length() - start) <= LEAST * b.length();
    let start = if is_end { 0.0 } else { start };
    let third = b.nearest(a.at(a.length() / 3.0));
    let forwards = (third - start).rem_euclid(b.length()) < 0.5 * b.length();
    let end = start + if forwards { b.length() } else { -b.length() };
    Shared { first: [0.0, a.length()], second: [start, end] }
}

/// The stretch of a closed edge along which an open one lies; of the two ways round, the one whose
/// length is nearer to that of the open one.
fn on_loop(closed: &Line<'_>, open: &Line<'_>) -> Shared {
    let [from, to] = [0.0, open.length()].map(|along| closed.nearest(open.at(along)));
    let ahead = (to - from).rem_euclid(closed.length());
    let behind = ahead - closed.length();
    let miss = |way: f64| (way.abs() - open.length()).abs();
    let way = if miss(ahead) <= miss(behind) { ahead } else { behind };
    Shared { first: [from, from + way], second: [0.0, open.length()] }
}

/// What two open edges share.
fn between(a: &Line<'_>, b: &Line<'_>) -> Option<Shared> {
    let on_a = [0.0, b.length()].map(|along| a.nearest(b.at(along)));
    let (low, high) = (on_a[0].min(on_a[1]), on_a[0].max(on_a[1]));
    let (from, to) = (low.max(0.0), high.min(a.length()));
    let [from_b, to_b] = [from, to].map(|along| b.nearest(a.at(along)));
    (to > from && from_b != to_b).then_some(Shared { first: [from, to], second: [from_b, to_b] })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[[f64; 2]]) -> Vec<Point3> {
        points.iter().map(|p| Point3::new(p[0], p[1], 0.0)).collect()
    }

    fn of(a: &[[f64; 2]], b: &[[f64; 2]]) -> Option<([f64; 2], [f64; 2])> {
        let (a, b) = (line(a), line(b));
        let found = shared((&a, a.first() == a.last()), (&b, b.first() == b.last()));
        assert!(found.len() < 2, "{found:?}");
        found.first().map(|found| (found.first, found.second))
    }

    #[test]
    fn edges_are_shared_whichever_way_they_run() {
        let long = [[0., 0.], [3., 0.], [7., 0.], [10., 0.]];
        let back = [[10., 0.], [5., 0.], [0., 0.]];
        assert_eq!(of(&long, &back), Some(([0., 10.], [10., 0.])));
        assert_eq!(of(&long, &long), Some(([0., 10.], [0., 10.])));
        assert_eq!(of(&long, &[[10., 0.], [8., 0.], [5., 0.]]), Some(([5., 10.], [5., 0.])));
        assert_eq!(of(&[[2., 0.], [6., 0.]], &long), Some(([0., 4.], [2., 6.])));
        assert_eq!(of(&long, &[[10., 0.], [12., 0.]]), None);
    }

    #[test]
    fn a_ring_and_its_halves() {
        let ring = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 0.]];
        let turned = [[4., 4.], [4., 0.], [0., 0.], [0., 4.], [4., 4.]];
        assert_eq!(of(&ring, &turned), Some(([0., 16.], [8., -8.])));
        let corner = [[0., 1.], [0., 0.], [1., 0.]];
        assert_eq!(of(&ring, &corner), Some(([15., 17.], [0., 2.])));
        assert_eq!(of(&corner, &ring), Some(([0., 2.], [15., 17.])));
        let halves = [[[0., 0.], [2., 1.5], [4., 0.]], [[4., 0.], [2., -1.5], [0., 0.]]];
        assert_eq!(of(&halves[0], &halves[1]), None, "both meet at their ends alone");
    }

    #[test]
    fn rings_with_seams_in_two_places_share_two_stretches() {
        let one = line(&[[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 1e-12]]);
        let other = line(&[[4., 3.], [4., 0.], [0., 0.], [0., 4.], [4., 4.], [4., 3.]]);
        let found = shared((&one, false), (&other, false));
        let near = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        assert_eq!(found.len(), 2, "{found:?}");
        // The first runs on from its seam to that of the other one, which is run backwards.
        assert!(near(found[0].first, [0., 7.]) && near(found[0].second, [7., 0.]), "{found:?}");
        assert!(near(found[1].first, [7., 16.]) && near(found[1].second, [16., 7.]), "{found:?}");
        // A hole has no seam of its own, so it is run through from that of the ring.
        let found = shared((&one, false), (&other, true));
        assert_eq!(found.len(), 1);
        assert!(near(found[0].first, [0., 16.]) && near(found[0].second, [7., -9.]), "{found:?}");
        let found = shared((&other, true), (&one, false));
        assert_eq!(found.len(), 1);
        assert!(near(found[0].second, [16., 0.]) || near(found[0].second, [0., 16.]), "{found:?}");
        // An open edge over a seam lies on either side of it.
        let corner = line(&[[0., 2.], [0., 0.], [3., 0.]]);
        let found = shared((&corner, false), (&one, false));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(near(found[0].first, [0., 2.]) && near(found[0].second, [14., 16.]), "{found:?}");
        assert!(near(found[1].first, [2., 5.]) && near(found[1].second, [0., 3.]), "{found:?}");
    }
}
