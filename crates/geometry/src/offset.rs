//! A region that grows on all sides, as a cutter needs it whose cut has a width.
//!
//! Everything within a distance of the region is added to it: beside every edge a rectangle, and in
//! every corner that points outwards what lies between two rectangles. There the lines beside the
//! edges run on until they meet (a mitre), up to a bound; beyond it the corner is round: a polygon
//! around the arc. The union is exact ([`region`](crate::region)), and no angle is computed, so the
//! bits are the same on every platform.

use crate::math::{Point2, Vec2, unit2};
use crate::region::{Region, combined};

/// A mitre ends no farther from its corner than this many times the distance.
pub const MITRE: f64 = 2.0;
/// Normals of neighbouring sides of a round corner have at least this cosine: 20°.
const STEP_COS: f64 = 0.939_692_620_785_908_4;
/// Opposite normals have no direction between them where their sum is shorter.
const OPPOSITE: f64 = 1e-3;

/// The region to the left of the `lines`, grown by a distance, mm: its connected pieces, the
/// largest first. Holes shrink, and those no wider than twice the distance are gone. The new lines
/// are nowhere nearer to the old ones than the distance, and nowhere farther than [`MITRE`] times
/// it, up to rounding by 1e-9 mm.
pub fn grown(lines: &[Vec<Point2>], by_mm: f64) -> Vec<Region> {
    let added: Vec<Vec<Point2>> = lines.iter().flat_map(|line| beside(line, by_mm)).collect();
    combined(lines, &added, &[])
}

/// What is added beside a closed line with the region to its left.
fn beside(line: &[Point2], by_mm: f64) -> Vec<Vec<Point2>> {
    let edges: Vec<(Point2, Point2, Vec2)> = (0..line.len())
        .filter_map(|n| {
            let (from, to) = (line[n], line[(n + 1) % line.len()]);
            Some((from, to, unit2(to - from)?))
        })
        .collect();
    let mut added = Vec::with_capacity(2 * edges.len());
    for (n, &(from, to, way)) in edges.iter().enumerate() {
        let out = -way.perp() * by_mm;
        added.push(vec![from, from + out, to + out, to]);
        let (_, _, next) = edges[(n + 1) % edges.len()];
        let turn = way.perp().dot(next);
        if turn > 0.0 || (turn == 0.0 && way.dot(next) < 0.0) {
            added.push(corner(to, way, next, by_mm));
        }
    }
    added
}

/// What is added at a corner that points outwards, between two edges of these directions.
fn corner(at: Point2, before: Vec2, after: Vec2, by_mm: f64) -> Vec<Point2> {
    let (first, last) = (-before.perp(), -after.perp());
    let mut normals = vec![first, last];
    // The cosine of half the turn, squared, is the square of the distance over that of the tip.
    if 0.5 * (1.0 + first.dot(last)) * MITRE * MITRE < 1.0 {
        // Halved until no two are farther apart than a step: 180° take four rounds.
        while normals.windows(2).any(|pair| pair[0].dot(pair[1]) < STEP_COS) {
            let halves = normals.windows(2).flat_map(|pair| {
                let between = pair[0] + pair[1];
                let middle = if between.length() > OPPOSITE { unit2(between) } else { None };
                [pair[0], middle.unwrap_or(before)]
            });
            normals = halves.chain([last]).collect();
        }
    }
    let tips = normals.windows(2).map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        at + (a + b) * (by_mm / (1.0 + a.dot(b)))
    });
    let ends = [at + first * by_mm, at + last * by_mm];
    [at, ends[0]].into_iter().chain(tips).chain([ends[1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{cos, sin};
    use crate::predicate::{first_crossing_of_loops, signed_area_doubled};

    /// A closed line round a point with some corners at random distances.
    fn star(next: &mut impl FnMut() -> f64, at: Point2, least: f64, most: f64) -> Vec<Point2> {
        let count = 3 + (20.0 * next()) as usize;
        let corner = |n: usize, share: f64| {
            let angle = core::f64::consts::TAU * n as f64 / count as f64;
            at + Vec2::new(cos(angle), sin(angle)) * (least + (most - least) * share)
        };
        (0..count).map(|n| corner(n, next())).collect()
    }

    fn distance(lines: &[Vec<Point2>], p: Point2) -> f64 {
        let of_line = |line: &Vec<Point2>| {
            let edges = (0..line.len()).map(|n| [line[n], line[(n + 1) % line.len()]]);
            edges.map(|edge| p.distance_to_segment(edge)).fold(f64::INFINITY, f64::min)
        };
        lines.iter().map(of_line).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn new_lines_keep_their_distance_and_do_not_cross() {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        let mut holes = 0;
        for _ in 0..300 {
            let by_mm = 0.01 + 3.0 * next() * next();
            let outline = star(&mut next, Point2::default(), 12.0, 60.0);
            let mut hole = star(&mut next, Point2::default(), 0.5, 5.0);
            hole.reverse();
            let lines = [outline, hole];
            let regions = grown(&lines, by_mm);
            assert_eq!(regions.len(), 1);
            let Region { outline, holes: left } = &regions[0];
            holes += left.len();
            let new: Vec<&Vec<Point2>> = std::iter::once(outline).chain(left).collect();
            assert!(signed_area_doubled(outline) > signed_area_doubled(&lines[0]));
            for line in &new {
                for n in 0..line.len() {
                    let (a, b) = (line[n], line[(n + 1) % line.len()]);
                    for share in [0.0, 0.25, 0.5, 0.75] {
                        let off = distance(&lines, a.lerp(b, share));
                        assert!(off > by_mm - 1e-6, "{off} of {by_mm}");
                        assert!(off < MITRE * by_mm + 1e-6, "{off} of {by_mm}");
                    }
                }
            }
            let points: Vec<Point2> = new.iter().flat_map(|line| line.iter().copied()).collect();
            let mut end = 0;
            let loops = new.iter().map(|line| {
                end += line.len();
                end - line.len()..end
            });
            let loops: Vec<_> = loops.collect();
            assert_eq!(first_crossing_of_loops(&points, &loops), None);
        }
        assert!(holes > 150, "{holes} holes are left");
    }

    #[test]
    fn a_square_keeps_its_corners_and_a_narrow_hole_is_gone() {
        let square = |side: f64| {
            let at = |x: f64, y: f64| Point2::new(x * side, y * side);
            vec![at(-0.5, -0.5), at(0.5, -0.5), at(0.5, 0.5), at(-0.5, 0.5)]
        };
        let turned = |line: Vec<Point2>| line.into_iter().rev().collect::<Vec<_>>();
        let lines = [square(10.0), turned(square(2.0))];
        let one = &grown(&lines, 0.1)[0];
        assert!((signed_area_doubled(&one.outline) - 2.0 * 10.2 * 10.2).abs() < 1e-7);
        assert_eq!((one.outline.len(), one.holes[0].len()), (4, 4));
        assert!((signed_area_doubled(&one.holes[0]) + 2.0 * 1.8 * 1.8).abs() < 1e-7);
        assert!(grown(&lines, 1.0)[0].holes.is_empty());
    }
}
