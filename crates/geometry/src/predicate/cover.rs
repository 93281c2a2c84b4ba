//! How often a sheet covers the points of the plane, by the winding number of its border.
//!
//! A sheet laid flat lies to the left of its border. So it covers a point as often as the lines of
//! the border wind round it, counter-clockwise less clockwise. Where no two edges cross or touch,
//! this winding number changes only at lines: along all of a line it is one more on the left than
//! on the right. A sheet that covers no point twice has 1 on the left of each of its lines and 0 on
//! the right.
//!
//! Lines that do not cross can still have more. An example is a flap on one side of a slit: round
//! the ends of the slit, the sheet makes more than a full turn. The hole between slit and flap runs
//! counter-clockwise as the outline does, and the sheet covers its inside twice.
//!
//! The winding number beside a line is counted along a ray from its leftmost corner, by the edges
//! that cross the ray: a sweep over y with the edges that are open there.

use super::orientation;
use crate::math::Point2;
use std::cmp::Ordering;
use std::ops::Range;

/// An edge from corner `from` to the next on its line.
struct PolygonEdge {
    from: usize,
    of_line: usize,
    ends: [Point2; 2],
}

impl PolygonEdge {
    fn low(&self) -> f64 {
        self.ends[0].y.min(self.ends[1].y)
    }

    fn high(&self) -> f64 {
        self.ends[0].y.max(self.ends[1].y)
    }

    /// The part of the edge in the winding number of its line round `p`: 1 if it crosses the ray
    /// from `p` along x upwards, −1 downwards, 0 if not at all. The lower end belongs to an edge
    /// and the upper one does not, so that a corner on the ray counts once. Exact.
    fn passes(&self, p: Point2) -> i64 {
        let [a, b] = self.ends;
        if a.y <= p.y && p.y < b.y && orientation(a, b, p) == Ordering::Greater {
            1
        } else if b.y <= p.y && p.y < a.y && orientation(a, b, p) == Ordering::Less {
            -1
        } else {
            0
        }
    }

    /// Where it meets the height `y`, approximately: only to name the nearest edge.
    fn x_at(&self, y: f64) -> f64 {
        let [a, b] = self.ends;
        a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))
    }
}

/// Two edges, by the corners that they begin at, where a sheet to the left of closed lines does not
/// lie exactly once: an edge of the line on whose left it does not, and the edge nearest beside it;
/// `None` if it lies once on the left of every line. The lines neither cross nor touch. Exact; time
/// O(m log m) for lines as people draw them, O(m²) at worst.
pub(super) fn first_not_covered_once(
    points: &[Point2],
    lines: &[Range<usize>],
) -> Option<(usize, usize)> {
    let lines: Vec<&Range<usize>> = lines.iter().filter(|line| !line.is_empty()).collect();
    if lines.len() < 2 {
        // A simple polygon winds once round what is inside.
        return None;
    }
    let next = |i: usize, line: &Range<usize>| if i + 1 == line.end { line.start } else { i + 1 };
    let mut edges: Vec<PolygonEdge> = Vec::with_capacity(points.len());
    for (of_line, line) in lines.iter().enumerate() {
        edges.extend((*line).clone().map(|from| PolygonEdge {
            from,
            of_line,
            ends: [points[from], points[next(from, line)]],
        }));
    }
    edges.sort_by(|a, b| a.low().total_cmp(&b.low()));
    let leftmost = |line: &Range<usize>| {
        let at = |i: usize| (points[i].x, points[i].y);
        line.clone().reduce(|best, i| if at(i) < at(best) { i } else { best }).unwrap_or(line.start)
    };
    let corners: Vec<usize> = lines.iter().map(|line| leftmost(line)).collect();
    let mut order: Vec<usize> = (0..lines.len()).collect();
    order.sort_by(|&a, &b| points[corners[a]].y.total_cmp(&points[corners[b]].y));
    let (mut open, mut waiting) = (Vec::<&PolygonEdge>::new(), edges.iter().peekable());
    let mut first: Option<(usize, usize)> = None;
    for line in order {
        let corner = corners[line];
        let p = points[corner];
        while let Some(edge) = waiting.next_if(|edge| edge.low() <= p.y) {
            open.push(edge);
        }
        open.retain(|edge| edge.high() > p.y);
        let others = open.iter().filter(|edge| edge.of_line != line && edge.passes(p) != 0);
        let around: i64 = others.clone().map(|edge| edge.passes(p)).sum();
        let before = if corner == lines[line].start { lines[line].end - 1 } else { corner - 1 };
        let turns_left = orientation(points[before], p, points[next(corner, lines[line])]).is_gt();
        if around + i64::from(turns_left) != 1 && first.is_none_or(|(best, _)| line < best) {
            let beside = others.min_by(|a, b| a.x_at(p.y).total_cmp(&b.x_at(p.y)));
            let other = lines[usize::from(line == 0)].start;
            first = Some((line, beside.map_or(other, |edge| edge.from)));
        }
    }
    first.map(|(line, beside)| (corners[line].min(beside), corners[line].max(beside)))
}

#[cfg(test)]
mod tests {
    use super::super::{first_crossing_of_loops, first_overlap_of_loops};
    use super::*;

    fn p(x: f64, y: f64) -> Point2 {
        Point2::new(x, y)
    }

    /// Closed lines one after the other, with the numbers of the corners of each.
    fn together(lines: &[Vec<Point2>]) -> (Vec<Point2>, Vec<Range<usize>>) {
        let mut ranges = Vec::new();
        let mut end = 0;
        for line in lines {
            ranges.push(end..end + line.len());
            end += line.len();
        }
        (lines.concat(), ranges)
    }

    fn square(x: f64, y: f64, r: f64) -> Vec<Point2> {
        vec![p(x - r, y - r), p(x + r, y - r), p(x + r, y + r), p(x - r, y + r)]
    }

    fn diamond(x: f64, y: f64, r: f64) -> Vec<Point2> {
        vec![p(x - r, y), p(x, y - r), p(x + r, y), p(x, y + r)]
    }

    fn backwards(mut line: Vec<Point2>) -> Vec<Point2> {
        line.reverse();
        line
    }

    #[test]
    fn a_hole_that_runs_as_the_outline_does_is_covered_twice() {
        let overlap = |lines: &[Vec<Point2>]| {
            let (points, ranges) = together(lines);
            first_overlap_of_loops(&points, &ranges)
        };
        let (outer, hole) = (square(0.0, 0.0, 9.0), square(1.0, 1.0, 2.0));
        assert_eq!(overlap(&[outer.clone(), backwards(hole.clone())]), None);
        // Edge 1 is the right side of the outline, edge 4 begins at the hole's lower left corner.
        assert_eq!(overlap(&[outer.clone(), hole.clone()]), Some((1, 4)));
        let outline_last = [backwards(hole.clone()), outer.clone()];
        assert_eq!(overlap(&outline_last), None, "whichever comes first");
        assert!(overlap(&[backwards(outer.clone()), hole.clone()]).is_some(), "turned over");
        assert_eq!(overlap(std::slice::from_ref(&outer)), None);
        let island = square(1.0, 1.0, 1.0);
        let three = [outer.clone(), backwards(hole.clone()), island.clone()];
        assert_eq!(overlap(&three), None, "an island in a hole is covered once");
        let [outer, hole, island] = three;
        assert_eq!(overlap(&[outer.clone(), hole.clone(), backwards(island)]), Some((5, 11)));
        assert!(overlap(&[outer, backwards(square(20.0, 0.0, 2.0))]).is_some(), "a hole outside");
    }

    /// The winding number of lines round a point that lies on none of them, edge by edge.
    fn winding(lines: &[Vec<Point2>], at: Point2) -> i64 {
        let edges = lines.iter().flat_map(|line| (0..line.len()).map(move |i| (line, i)));
        let passes = edges.map(|(line, i)| {
            let (a, b) = (line[i], line[(i + 1) % line.len()]);
            match (a.y <= at.y, b.y <= at.y) {
                (true, false) if orientation(a, b, at).is_gt() => 1,
                (false, true) if orientation(a, b, at).is_lt() => -1,
                _ => 0,
            }
        });
        passes.sum()
    }

    #[test]
    fn what_is_found_is_what_counting_at_many_points_finds() {
        let mut state = 7u64;
        let mut below = |n: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) % n
        };
        let mut found = [0; 2];
        for _ in 0..3000 {
            let count = 2 + below(4);
            let lines: Vec<Vec<Point2>> = (0..count)
                .map(|n| {
                    let most = if n == 0 { 1 } else { 7 };
                    let [x, y] = [0, 1].map(|_| below(most) as f64 * 2.0 - (most - 1) as f64);
                    let r = if n == 0 { 12.0 } else { (1 + below(5)) as f64 };
                    let line = if below(2) == 0 { square(x, y, r) } else { diamond(x, y, r) };
                    if below(2) == 0 { line } else { backwards(line) }
                })
                .collect();
            let (points, ranges) = together(&lines);
            let overlap = first_overlap_of_loops(&points, &ranges);
            if first_crossing_of_loops(&points, &ranges).is_some() {
                assert!(overlap.is_some());
                continue;
            }
            // All edges run along sides and diagonals of unit squares: each has four places off
            // them.
            let places = [(0.5, 0.2), (0.8, 0.5), (0.5, 0.8), (0.2, 0.5)];
            let squares =
                (-13..13).flat_map(|i| (-13..13).map(move |j| (f64::from(i), f64::from(j))));
            let wrong = squares
                .flat_map(|(i, j)| places.map(|(x, y)| p(i + x, j + y)))
                .map(|at| winding(&lines, at))
                .any(|cover| cover != 0 && cover != 1);
            assert_eq!(overlap.is_some(), wrong, "{lines:?}");
            found[usize::from(wrong)] += 1;
        }
        assert!(found.iter().all(|count| *count > 100), "{found:?}");
    }
}
