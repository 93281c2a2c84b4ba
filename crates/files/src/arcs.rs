//! Arcs in place of the many sides of a cut line, within a tolerance.
//!
//! A pattern is a polygon through samples. Machines that take arcs cut them more smoothly, and the
//! file is smaller. From one corner on, the longest run is sought whose corners and sides lie
//! within the tolerance of one arc of a circle, and that arc of them: it begins and ends at corners
//! of the polygon, at most half round, through the corner that is farthest from the chord. The run
//! is doubled while it fits, and then found by halving. Sharp corners, and those at which notches
//! and folds end, are ends of arcs.
//!
//! The distance is bounded both ways: if the corners p and q of a side lie within d of the circle,
//! and the arc between the points of the circle nearest to them rises by s over its chord, no point
//! of that arc is farther from the side than d + s, nor the other way.

use crate::shapes::{FileLine, Form, Shape, What};
use sheetwright::math::{Point2, Vec2, atan2, cos, from_deg, sin, unit2};

/// Where a polygon turns by more than this, degrees, it has a corner in any case.
const SHARP_DEG: f64 = 30.0;
/// Where it turns by more than this, degrees, it has one if it turns far less before and after.
const CORNER_DEG: f64 = 5.0;
/// How much less.
const LESS: f64 = 1.0 / 3.0;
/// A run is straight if it leaves its chord by less than this share of it.
const STRAIGHT: f64 = 1e-9;
/// Ends of notches and folds lie on a corner if they are nearer, mm.
const ON_CORNER_MM: f64 = 1e-6;
/// Arcs that are read become chords that rise so little, mm.
const RISE_MM: f64 = 1e-3;

/// How arcs are fitted to the cut lines of a pattern.
pub(crate) struct Arcs {
    tolerance_mm: f64,
    /// Points that stay ends of arcs, by increasing x.
    kept: Vec<Point2>,
}

impl Arcs {
    /// For a pattern of these shapes.
    pub(crate) fn of(shapes: &[Shape], tolerance_mm: f64) -> Self {
        let keeps = |shape: &&Shape| match shape.what {
            What::Notch | What::Fold { .. } | What::Crease | What::TrimTick => true,
            What::SeamTick | What::LapEnd => true,
            What::Rung(_) => shape.role == sheetwright::pattern::Role::Score,
            _ => false,
        };
        let lines = shapes.iter().filter(keeps).flat_map(|shape| &shape.lines);
        let ends = lines.flat_map(|line| line.first().into_iter().chain(line.last()));
        let mut kept: Vec<Point2> = ends.copied().collect();
        kept.sort_by(|a, b| a.x.total_cmp(&b.x));
        Self { tolerance_mm, kept }
    }

    /// A line of a shape, with arcs where it is an outline or a hole to cut.
    pub(crate) fn fitted(&self, shape: &Shape, line: FileLine) -> FileLine {
        let is_cut = matches!(shape.what, What::Outline | What::Hole) && line.form == Form::Closed;
        if !is_cut || line.points.len() < 3 {
            return line;
        }
        let all = &line.points;
        let count = all.len();
        let ends: Vec<usize> = (1..count).filter(|&n| self.is_end(all, n)).chain([count]).collect();
        let (mut points, mut bulges) = (Vec::new(), Vec::new());
        let (mut from, mut next) = (0, 0);
        while from < count {
            while ends[next] <= from {
                next += 1;
            }
            let (to, bulge) = self.longest(all, from, ends[next]);
            points.push(all[from]);
            bulges.push(bulge);
            from = to;
        }
        FileLine { points, form: line.form, bulges }
    }

    /// Whether an arc must end at a corner of a closed line.
    fn is_end(&self, all: &[Point2], n: usize) -> bool {
        let at = all[n];
        let near = self.kept.partition_point(|p| p.x < at.x - ON_CORNER_MM);
        let mut near = self.kept[near..].iter().take_while(|p| p.x <= at.x + ON_CORNER_MM);
        if near.any(|p| p.distance(at) <= ON_CORNER_MM) {
            return true;
        }
        let count = all.len();
        let way = |n: usize| unit2(all[(n + 1) % count] - all[n % count]);
        let turn = |n: usize| match (way(n + count - 1), way(n)) {
            (Some(a), Some(b)) => atan2(a.perp_dot(b), a.dot(b)).abs(),
            _ => 0.0,
        };
        let here = turn(n);
        let beside = turn(n + count - 1).max(turn(n + 1));
        here > from_deg(SHARP_DEG) || (here > from_deg(CORNER_DEG) && beside < LESS * here)
    }

    /// The end of the longest run from a corner on, up to another, that one arc fits, and its
    /// bulge.
    fn longest(&self, all: &[Point2], from: usize, most: usize) -> (usize, f64) {
        let (mut best, mut failed) = ((from + 1, 0.0), most + 1);
        let mut steps = 2;
        while best.0 < most {
            let to = (from + steps).min(most);
            let Some(bulge) = self.arc(all, from, to) else {
                failed = to;
                break;
            };
            best = (to, bulge);
            steps *= 2;
        }
        while best.0 + 1 < failed && best.0 < most {
            let middle = best.0 + (failed - best.0) / 2;
            match self.arc(all, from, middle) {
                Some(bulge) => best = (middle, bulge),
                None => failed = middle,
            }
        }
        best
    }

    /// The bulge of the arc from one corner to another that lies within the tolerance of the sides
    /// between them, if there is one: the tangent of a quarter of its angle, positive
    /// counter-clockwise, and 0 of a straight line.
    fn arc(&self, all: &[Point2], from: usize, to: usize) -> Option<f64> {
        let at = |n: usize| all[n % all.len()];
        let (start, end) = (at(from), at(to));
        let chord = end - start;
        let length = chord.length();
        let along = unit2(chord)?;
        let rise = |n: usize| along.perp_dot(at(n) - start);
        let highest =
            (from + 1..to).reduce(|a, b| if rise(b).abs() > rise(a).abs() { b } else { a })?;
        if rise(highest).abs() <= STRAIGHT * length {
            let goes_on = |n: usize| (at(n + 1) - at(n)).dot(along) > 0.0;
            return (from..to).all(goes_on).then_some(0.0);
        }
        let [back, forth] = [start - at(highest), end - at(highest)];
        let sharp = (back.length() * forth.length() + back.dot(forth)) / back.perp_dot(forth).abs();
        // What lies to the left of its chord runs clockwise.
        let bulge = if rise(highest) > 0.0 { -sharp } else { sharp };
        let is_beside = (from + 1..to).all(|n| rise(n) * rise(highest) >= 0.0);
        if !is_beside || bulge.is_nan() || bulge.abs() > 1.0 {
            return None;
        }
        let (centre, radius) = circle(start, end, bulge);
        let off = |n: usize| (at(n).distance(centre) - radius).abs();
        let out = |n: usize| unit2(at(n) - centre);
        for n in from..to {
            let [a, b] = [out(n)?, out(n + 1)?];
            let goes_on = a.perp_dot(b) * bulge > 0.0 && a.dot(b) > 0.0;
            let half = 0.5 * (b - a).length();
            let rises_mm = radius * (1.0 - (1.0 - half * half).max(0.0).sqrt());
            if !goes_on || off(n).max(off(n + 1)) + rises_mm > self.tolerance_mm {
                return None;
            }
        }
        Some(bulge)
    }
}

/// The centre and the radius of an arc with a bulge, mm.
fn circle(start: Point2, end: Point2, bulge: f64) -> (Point2, f64) {
    let chord = end - start;
    let from_middle = chord.perp() * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let radius = chord.length() * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
    (start.lerp(end, 0.5) + from_middle, radius)
}

/// The corners of a closed line with its arcs as chords; without bulges, its own.
pub(crate) fn chords(points: &[Point2], bulges: &[f64]) -> Vec<Point2> {
    let mut chords = Vec::with_capacity(points.len());
    for (n, &start) in points.iter().enumerate() {
        chords.push(start);
        let bulge = bulges.get(n).copied().unwrap_or(0.0);
        if bulge == 0.0 || !bulge.is_finite() {
            continue;
        }
        let (centre, radius) = circle(start, points[(n + 1) % points.len()], bulge);
        let sweep = 4.0 * atan2(bulge, 1.0);
        let steps = (sweep.abs() * (radius / (8.0 * RISE_MM)).sqrt()).ceil().clamp(1.0, 10_000.0);
        let out = start - centre;
        for step in 1..steps as usize {
            let angle = sweep * step as f64 / steps;
            chords.push(
                centre
                    + Vec2::new(
                        out.x * cos(angle) - out.y * sin(angle),
                        out.x * sin(angle) + out.y * cos(angle),
                    ),
            );
        }
    }
    chords
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::pattern::Role;

    fn outline(points: Vec<Point2>) -> Shape {
        Shape { role: Role::Cut, what: What::Outline, lines: vec![points], closed: true }
    }

    fn fitted(points: &[Point2], tolerance_mm: f64) -> FileLine {
        let shapes = [outline(points.to_vec())];
        let arcs = Arcs::of(&shapes, tolerance_mm);
        arcs.fitted(&shapes[0], FileLine::polyline(points.to_vec(), true))
    }

    /// The largest distance of the corners of a closed line from another, mm.
    fn off_mm(corners: &[Point2], line: &[Point2]) -> f64 {
        let side = |n: usize| [line[n], line[(n + 1) % line.len()]];
        let off = |p: &Point2| {
            (0..line.len()).map(|n| p.distance_to_segment(side(n))).fold(f64::INFINITY, f64::min)
        };
        corners.iter().map(off).fold(0.0, f64::max)
    }

    /// A stadium: two straight sides and two half circles, all of them sampled.
    fn stadium(radius: f64, steps: usize) -> Vec<Point2> {
        let half = |middle: f64, from_deg_: f64| {
            (0..=steps).map(move |n| {
                let angle = from_deg(from_deg_ + 180.0 * n as f64 / steps as f64);
                Point2::new(middle + radius * cos(angle), radius * sin(angle))
            })
        };
        half(100.0, -90.0).chain(half(0.0, 90.0)).collect()
    }

    #[test]
    fn half_circles_become_arcs_of_their_radius() {
        let points = stadium(40.0, 60);
        let line = fitted(&points, 0.05);
        assert!(line.points.len() <= 6, "{line:?}");
        let straight = line.bulges.iter().filter(|bulge| **bulge == 0.0).count();
        assert!(straight >= 2);
        for (n, &bulge) in line.bulges.iter().enumerate().filter(|(_, bulge)| **bulge != 0.0) {
            let next = line.points[(n + 1) % line.points.len()];
            let (_, radius) = circle(line.points[n], next, bulge);
            assert!((radius - 40.0).abs() < 1e-9 && bulge > 0.0, "{radius} {bulge}");
        }
        let read = chords(&line.points, &line.bulges);
        assert!(off_mm(&read, &points) <= 0.05 && off_mm(&points, &read) <= 0.05);
        // Clockwise, as a hole.
        let back: Vec<Point2> = points.iter().rev().copied().collect();
        let hole = fitted(&back, 0.05);
        assert!(hole.bulges.iter().all(|bulge| *bulge <= 0.0) && hole.points.len() <= 6);
    }

    #[test]
    fn any_curve_stays_within_the_tolerance_both_ways_and_sharp_corners_stay() {
        let count = 720;
        let mut points: Vec<Point2> = (0..count)
            .map(|n| {
                let turn = from_deg(360.0 * f64::from(n) / f64::from(count));
                let radius = 150.0 + 30.0 * cos(3.0 * turn) + 8.0 * sin(7.0 * turn);
                Point2::new(radius * cos(turn), radius * sin(turn))
            })
            .collect();
        let corner = Point2::new(400.0, 3.0);
        points.insert(3, corner);
        for tolerance_mm in [0.02, 0.1, 0.5] {
            let line = fitted(&points, tolerance_mm);
            assert!(line.points.contains(&corner));
            assert!(line.points.len() < points.len() / 4, "{}", line.points.len());
            let read = chords(&line.points, &line.bulges);
            let off = [off_mm(&read, &points), off_mm(&points, &read)];
            assert!(off.iter().all(|off| *off <= tolerance_mm + RISE_MM), "{off:?}");
        }
    }

    #[test]
    fn notches_keep_their_corner_and_coarse_polygons_their_sides() {
        let points = stadium(40.0, 60);
        let notch = Shape {
            role: Role::Cut,
            what: What::Notch,
            lines: vec![vec![points[17], Point2::new(100.0, 0.0)]],
            closed: false,
        };
        let shapes = [outline(points.clone()), notch];
        let arcs = Arcs::of(&shapes, 0.05);
        let line = arcs.fitted(&shapes[0], FileLine::polyline(points.clone(), true));
        assert!(line.points.contains(&points[17]));
        // Five sides of a half circle rise by 2 mm.
        let coarse = stadium(40.0, 5);
        let line = fitted(&coarse, 0.05);
        assert_eq!((line.points.len(), line.bulges.iter().all(|b| *b == 0.0)), (12, true));
    }
}
