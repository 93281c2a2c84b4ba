//! Edges on two curves that lie on one another, as where two pipes meet of which each has a curve
//! of its own.
//!
//! Sampled apart, two polylines on one curve are as far from one another as their chords are from
//! the curve. How far that is can be told from a polyline alone: a point lies four times as far
//! from the chord of its neighbours. So each corner of one must lie nearer to the other than both
//! chords may lie, and likewise the other way round.

use sheetwright_geometry::math::{Point3, unit};

/// A point where a polyline turns by more than this (the cosine of 30°) is a corner of its curve,
/// which lies on both.
const CORNER_COS: f64 = 0.866;

struct Line<'a> {
    points: &'a [Point3],
    low: Point3,
    high: Point3,
    /// The largest distance of its chords from its curve, mm, estimated.
    off_mm: f64,
}

impl<'a> Line<'a> {
    fn new(points: &'a [Point3]) -> Self {
        let [low, high] = [f64::min, f64::max].map(|of| {
            let both = |a: Point3, b: Point3| Point3::new(of(a.x, b.x), of(a.y, b.y), of(a.z, b.z));
            points.iter().copied().reduce(both).unwrap_or_default()
        });
        let off_mm = points.windows(3).filter_map(|three| {
            let [a, b] = [three[1] - three[0], three[2] - three[1]];
            let is_smooth = unit(a)?.dot(unit(b)?) > CORNER_COS;
            is_smooth.then(|| 0.25 * three[1].distance_to_segment([three[0], three[2]]))
        });
        Self { points, low, high, off_mm: off_mm.fold(0.0, f64::max) }
    }

    fn is_near(&self, other: &Self, within_mm: f64) -> bool {
        self.points.iter().all(|&p| {
            let mut steps = other.points.windows(2);
            steps.any(|step| p.distance_to_segment([step[0], step[1]]) <= within_mm)
        })
    }
}

/// The pairs of polylines that lie on one another as wholes, up to `least_mm` and how far chords
/// lie from curves.
pub(super) fn twins(lines: &[&[Point3]], least_mm: f64) -> Vec<[usize; 2]> {
    let lines: Vec<Line<'_>> = lines.iter().map(|points| Line::new(points)).collect();
    let most_mm = least_mm + 2.0 * lines.iter().map(|line| line.off_mm).fold(0.0, f64::max);
    let mut by_x: Vec<usize> = (0..lines.len()).collect();
    by_x.sort_by(|&a, &b| lines[a].low.x.total_cmp(&lines[b].low.x).then(a.cmp(&b)));
    let mut pairs = Vec::new();
    for (place, &n) in by_x.iter().enumerate() {
        let a = &lines[n];
        let beside = by_x[place + 1..].iter();
        for &k in beside.take_while(|&&k| lines[k].low.x - a.low.x <= most_mm) {
            let b = &lines[k];
            let within_mm = least_mm + a.off_mm + b.off_mm;
            let is_in_box = a.low.distance(b.low).max(a.high.distance(b.high)) <= 2.0 * within_mm;
            if is_in_box && a.is_near(b, within_mm) && b.is_near(a, within_mm) {
                pairs.push([n.min(k), n.max(k)]);
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::math::{cos, sin};
    use std::f64::consts::TAU;

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
        assert_eq!(twins(&lines, 1e-6), [[0, 1]]);
        let half = &rings[0][..31];
        assert_eq!(twins(&[half, lines[1]], 1e-6), Vec::<[usize; 2]>::new());
    }

    #[test]
    fn corners_do_not_make_a_polyline_near_to_others() {
        let zigzag = |d: f64| -> Vec<Point3> {
            let points = [[0.0, 0.0], [10.0, 8.0 + d], [20.0, 0.0]];
            points.map(|[x, y]| Point3::new(x, y, 0.0)).to_vec()
        };
        let [a, b] = [zigzag(0.0), zigzag(0.5)];
        assert!(twins(&[&a, &b], 1e-6).is_empty());
        assert_eq!(twins(&[&a, &a], 1e-6), [[0, 1]]);
    }
}
