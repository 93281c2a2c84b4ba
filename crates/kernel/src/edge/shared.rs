//! The stretch that two joined edges have in common, so that places on the one are found on the
//! other.
//!
//! The ends of each edge are looked for on the other, at the point that lies nearest in space. What
//! lies between the inner two of the four is the common stretch. A place on it is named by its
//! share of the length in space, from the end at which it begins on the first edge; so holes and
//! notches on both meet when the edges are joined, however each of them was sampled.

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
struct Line<'a> {
    points: &'a [Point3],
    lengths: Vec<f64>,
}

impl<'a> Line<'a> {
    fn new(points: &'a [Point3]) -> Self {
        Self { points, lengths: lengths(points) }
    }

    fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    fn is_loop(&self) -> bool {
        self.points.first() == self.points.last()
    }

    /// The length to the point that lies nearest to `p`, mm.
    fn nearest(&self, p: Point3) -> f64 {
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

    fn at(&self, along: f64) -> Point3 {
        let along = if self.is_loop() { along.rem_euclid(self.length()) } else { along };
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

/// What two edges through these points, two or more each, have in common; `None` if that is no
/// more than a point.
pub(crate) fn shared(first: &[Point3], second: &[Point3]) -> Option<Shared> {
    let (a, b) = (Line::new(first), Line::new(second));
    let least = LEAST * a.length().min(b.length());
    let found = match (a.is_loop(), b.is_loop()) {
        (true, true) => {
            let start = b.nearest(a.at(0.0));
            let third = b.nearest(a.at(a.length() / 3.0));
            let forwards = (third - start).rem_euclid(b.length()) < 0.5 * b.length();
            let end = start + if forwards { b.length() } else { -b.length() };
            Shared { first: [0.0, a.length()], second: [start, end] }
        }
        (true, false) => on_loop(&a, &b).forwards(),
        (false, true) => {
            let Shared { first, second } = on_loop(&b, &a);
            Shared { first: second, second: first }.forwards()
        }
        (false, false) => between(&a, &b)?,
    };
    let [from, to] = found.first;
    let [from_b, to_b] = found.second;
    let middle = a.at(0.5 * (from + to)).distance(b.at(0.5 * (from_b + to_b)));
    (to - from > least && middle <= MEET * (to - from)).then_some(found)
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
        shared(&line(a), &line(b)).map(|found| (found.first, found.second))
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
}
