//! Polygons with more than three corners become triangles.
//!
//! A quadrilateral is divided along its shorter diagonal, unless that lies outside. A polygon with
//! more corners is projected along its mean normal (Newell's). Its ears, convex corners whose
//! triangle contains no other corner, are cut off one by one, those with the shortest cut first. A
//! polygon that can't be divided in this way, because it crosses itself, becomes a fan.

use sheetwright::math::{Point2, Point3, Vec3, unit};
use sheetwright::predicate::orientation;
use std::cmp::Ordering;

/// The most corners of a polygon that is divided by cutting off ears, whose time grows with the
/// cube of that number; a larger polygon becomes a fan.
const MOST_CORNERS: usize = 200;

/// The triangles of a polygon, which has three corners or more.
pub(super) fn split(points: &[Point3], ring: &[usize]) -> Vec<[usize; 3]> {
    match ring {
        [a, b, c] => vec![[*a, *b, *c]],
        _ if ring.len() > MOST_CORNERS => fan(ring),
        _ => by_ears(points, ring).unwrap_or_else(|| fan(ring)),
    }
}

fn fan(ring: &[usize]) -> Vec<[usize; 3]> {
    (1..ring.len() - 1).map(|n| [ring[0], ring[n], ring[n + 1]]).collect()
}

fn by_ears(points: &[Point3], ring: &[usize]) -> Option<Vec<[usize; 3]>> {
    let at = |n: usize| points[ring[n]];
    // Twice the area vector, relative to the first corner so that polygons far from the origin lose
    // no digits.
    let normal: Vec3 = (1..ring.len() - 1).map(|n| (at(n) - at(0)).cross(at(n + 1) - at(0))).sum();
    let normal = unit(normal)?;
    let across = if normal.x.abs() < 0.6 { Vec3::X } else { Vec3::Y };
    let right = unit(across.cross(normal))?;
    let up = normal.cross(right);
    let flat: Vec<Point2> = (0..ring.len())
        .map(|n| Point2::new((at(n) - at(0)).dot(right), (at(n) - at(0)).dot(up)))
        .collect();
    let mut left: Vec<usize> = (0..ring.len()).collect();
    let mut triangles = Vec::with_capacity(ring.len() - 2);
    while left.len() > 3 {
        let count = left.len();
        let ear = |n: usize| [left[(n + count - 1) % count], left[n], left[(n + 1) % count]];
        let length = |n: usize| at(ear(n)[0]).distance(at(ear(n)[2]));
        let best = (0..count)
            .filter(|&n| is_ear(&flat, &left, ear(n)))
            .reduce(|best, n| if length(n) < length(best) { n } else { best })?;
        triangles.push(ear(best).map(|n| ring[n]));
        left.remove(best);
    }
    let last = [left[0], left[1], left[2]];
    is_ear(&flat, &left, last).then_some(())?;
    triangles.push(last.map(|n| ring[n]));
    Some(triangles)
}

/// Whether a corner is an ear: convex, with no other corner in its triangle.
fn is_ear(flat: &[Point2], left: &[usize], ear: [usize; 3]) -> bool {
    let [a, b, c] = ear.map(|n| flat[n]);
    let turns_left = |p, q, r| orientation(p, q, r) == Ordering::Greater;
    let holds = |p: Point2| {
        let is_right = |q, r| orientation(q, r, p) == Ordering::Less;
        !is_right(a, b) && !is_right(b, c) && !is_right(c, a)
    };
    turns_left(a, b, c) && !left.iter().any(|n| !ear.contains(n) && holds(flat[*n]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 3]]) -> Vec<Point3> {
        list.iter().map(|&[x, y, z]| Point3::new(x, y, z)).collect()
    }

    #[test]
    fn a_quadrilateral_is_divided_along_its_shorter_diagonal() {
        let quad = points(&[[0., 0., 0.], [4., 0., 0.], [3., 1., 0.], [0., 1., 0.]]);
        assert_eq!(split(&quad, &[0, 1, 2, 3]), [[0, 1, 2], [0, 2, 3]]);
        // An arrowhead has one diagonal inside, however long it is.
        let arrow = points(&[[0., 0., 0.], [5., 1., 0.], [0., 2., 0.], [4., 1., 0.]]);
        assert_eq!(split(&arrow, &[0, 1, 2, 3]), [[3, 0, 1], [1, 2, 3]]);
    }

    #[test]
    fn an_l_shape_is_covered_once() {
        let corners =
            [[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [1., 1., 0.], [1., 2., 0.], [0., 2., 0.]];
        let shape = points(&corners);
        let ring = [2, 3, 4, 5, 0, 1];
        let triangles = split(&shape, &ring);
        assert_eq!(triangles.len(), 4);
        let area = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|n| shape[n]);
            0.5 * (b - a).cross(c - a).z
        };
        assert!(triangles.iter().all(|t| area(t) > 0.0));
        assert_eq!(triangles.iter().map(area).sum::<f64>(), 3.0);
    }

    #[test]
    fn what_crosses_itself_becomes_a_fan() {
        let bow = points(&[[0., 0., 0.], [1., 1., 0.], [1., 0., 0.], [0., 1., 0.]]);
        assert_eq!(split(&bow, &[0, 1, 2, 3]), [[0, 1, 2], [0, 2, 3]]);
    }
}
