//! Polygons with more than three corners become triangles.
//!
//! A quadrilateral is divided along its shorter diagonal, unless that lies outside. A polygon with
//! more corners is projected along its mean normal (Newell's). Its ears, convex corners whose
//! triangle contains no other corner, are cut off one by one, those with the shortest cut first. A
//! polygon may pass through a corner twice, as where a bridge leads to a hole or a slit begins; and
//! go out to a point and straight back, which has no area and is left out. One that can't be
//! divided in this way, because it crosses itself, becomes a fan.

use sheetwright::math::{Point2, Point3, Vec3, unit};
use sheetwright::predicate::orientation;
use std::cmp::Ordering;

/// The most corners of a polygon that is divided by cutting off ears, whose time grows with the
/// square of that number. A larger polygon must be convex, and becomes a fan.
pub(super) const MOST_CORNERS: usize = 2000;

/// The triangles of a polygon, which has three corners or more; `None` of one with more than
/// [`MOST_CORNERS`] that is no fan.
pub(super) fn split(points: &[Point3], ring: &[usize]) -> Option<Vec<[usize; 3]>> {
    Some(match ring {
        [a, b, c] => vec![[*a, *b, *c]],
        _ if ring.len() > MOST_CORNERS => return is_fan(points, ring).then(|| fan(ring)),
        _ => by_ears(points, ring).unwrap_or_else(|| fan(ring)),
    })
}

/// Whether all triangles of the fan of a polygon face the way that the polygon does on average.
fn is_fan(points: &[Point3], ring: &[usize]) -> bool {
    let at = |n: usize| points[ring[n]] - points[ring[0]];
    let normals = || (1..ring.len() - 1).map(|n| at(n).cross(at(n + 1)));
    let normal: Vec3 = normals().sum();
    normals().all(|one| one.dot(normal) >= 0.0)
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
    let mut left = Left::new(&flat);
    let mut triangles = Vec::with_capacity(ring.len() - 2);
    while left.corners.len() > 3 {
        let count = left.corners.len();
        let length = |n: usize| at(left.ear(n)[0]).distance(at(left.ear(n)[2]));
        let ears = (0..count).filter(|&n| left.corners[n].state == State::Ear);
        let best = ears.reduce(|best, n| if length(n) < length(best) { n } else { best });
        // Corners that other visits kept from being ears may have become some.
        let Some(best) = best else {
            left.look_again();
            left.corners.iter().any(|corner| corner.state == State::Ear).then_some(())?;
            continue;
        };
        triangles.push(left.ear(best).map(|n| ring[n]));
        left.remove(best);
    }
    if let [_, last, _] = left.corners[..] {
        (last.state == State::Ear).then_some(())?;
        triangles.push(left.ear(1).map(|n| ring[n]));
    }
    Some(triangles)
}

/// Whether a corner of what is left of a polygon is an ear.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Ear,
    /// It does not turn left.
    Never,
    /// The triangle holds this corner, or what leads to this other visit to the corner.
    Holds(usize),
}

#[derive(Clone, Copy)]
struct Corner {
    number: usize,
    state: State,
}

/// The corners of a polygon that are left, in order.
struct Left<'a> {
    flat: &'a [Point2],
    corners: Vec<Corner>,
}

impl<'a> Left<'a> {
    fn new(flat: &'a [Point2]) -> Self {
        let corner = |number| Corner { number, state: State::Never };
        Self { flat, corners: (0..flat.len()).map(corner).collect() }.without_spurs()
    }

    fn look_again(&mut self) {
        (0..self.corners.len()).for_each(|n| self.look_at(n));
    }

    /// The corner of a place in the list, between its neighbours.
    fn ear(&self, n: usize) -> [usize; 3] {
        let count = self.corners.len();
        [n + count - 1, n, n + 1].map(|n| self.corners[n % count].number)
    }

    fn look_at(&mut self, n: usize) {
        self.corners[n].state = self.state(n);
    }

    /// Of an ear no corner lies in the triangle, but those in the place of one of its own: a
    /// polygon may pass through a place twice. Where it passes through that of the ear itself, it
    /// must not do so within the triangle; from the other two it can't lead in and out again.
    fn state(&self, n: usize) -> State {
        let ear = self.ear(n);
        let [a, b, c] = ear.map(|n| self.flat[n]);
        if !turns_left(a, b, c) {
            return State::Never;
        }
        let is_right = |q, r, p| orientation(q, r, p) == Ordering::Less;
        for (k, corner) in self.corners.iter().enumerate() {
            let p = self.flat[corner.number];
            if ear.contains(&corner.number)
                || is_right(a, b, p)
                || is_right(b, c, p)
                || is_right(c, a, p)
            {
                continue;
            }
            if p == b {
                let [from, _, to] = self.ear(k).map(|n| self.flat[n]);
                let is_between = |p| turns_left(a, b, p) && turns_left(b, c, p);
                if is_between(from) || is_between(to) {
                    return State::Holds(corner.number);
                }
            } else if p != a && p != c {
                return State::Holds(corner.number);
            }
        }
        State::Ear
    }

    /// Cuts off an ear.
    fn remove(&mut self, n: usize) {
        let gone = self.corners.remove(n).number;
        let count = self.corners.len();
        self.look_at((n + count - 1) % count);
        self.look_at(n % count);
        for n in 0..count {
            if self.corners[n].state == State::Holds(gone) {
                self.look_at(n);
            }
        }
    }

    /// Leaves out what goes out of the polygon to a point and comes straight back.
    fn without_spurs(mut self) -> Self {
        let count = |left: &Self| left.corners.len();
        let is_spur = |left: &Self, n: usize| {
            let [a, b, c] = left.ear(n).map(|n| left.flat[n]);
            a == c && !left.is_inside(a.lerp(b, 0.5))
        };
        while count(&self) > 3
            && let Some(n) = (0..count(&self)).find(|&n| is_spur(&self, n))
        {
            self.corners.remove(n);
            // Its two neighbours are in one place: one of them is enough.
            self.corners.remove(n % count(&self));
        }
        self.look_again();
        self
    }

    /// Whether a point lies inside: a ray to the right crosses the polygon an odd number of times.
    /// Both ways along a bridge or a slit count, and so do not matter.
    fn is_inside(&self, p: Point2) -> bool {
        let count = self.corners.len();
        let side = |n: usize| [n, (n + 1) % count].map(|n| self.flat[self.corners[n].number]);
        let crosses = |[a, b]: [Point2; 2]| {
            let upwards = a.y <= p.y && b.y > p.y;
            let downwards = b.y <= p.y && a.y > p.y;
            (upwards && turns_left(a, b, p)) || (downwards && turns_left(b, a, p))
        };
        (0..count).filter(|&n| crosses(side(n))).count() % 2 == 1
    }
}

fn turns_left(p: Point2, q: Point2, r: Point2) -> bool {
    orientation(p, q, r) == Ordering::Greater
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
        assert_eq!(split(&quad, &[0, 1, 2, 3]).unwrap(), [[0, 1, 2], [0, 2, 3]]);
        // An arrowhead has one diagonal inside, however long it is.
        let arrow = points(&[[0., 0., 0.], [5., 1., 0.], [0., 2., 0.], [4., 1., 0.]]);
        assert_eq!(split(&arrow, &[0, 1, 2, 3]).unwrap(), [[3, 0, 1], [1, 2, 3]]);
    }

    #[test]
    fn an_l_shape_is_covered_once() {
        let corners =
            [[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [1., 1., 0.], [1., 2., 0.], [0., 2., 0.]];
        let shape = points(&corners);
        let ring = [2, 3, 4, 5, 0, 1];
        let triangles = split(&shape, &ring).unwrap();
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
        assert_eq!(split(&bow, &[0, 1, 2, 3]).unwrap(), [[0, 1, 2], [0, 2, 3]]);
    }

    /// The area of the triangles, all of which must turn left in the plane z = 0.
    fn area(points: &[Point3], triangles: &[[usize; 3]]) -> f64 {
        let of = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|n| points[n]);
            0.5 * (b - a).cross(c - a).z
        };
        assert!(triangles.iter().all(|t| of(t) > 0.0), "{triangles:?}");
        triangles.iter().map(of).sum()
    }

    #[test]
    fn a_polygon_may_pass_a_corner_twice() {
        let square = |from: f64, to: f64| [[from, from], [to, from], [to, to], [from, to]];
        let corners = [square(0.0, 40.0), square(10.0, 18.0), square(22.0, 30.0)].concat();
        let flat: Vec<[f64; 3]> = corners.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        let points = points(&flat);
        for (name, ring, wanted) in [
            ("one bridge", vec![0, 1, 2, 3, 0, 4, 7, 6, 5, 4], 1600.0 - 64.0),
            (
                "a bridge from either end",
                vec![0, 1, 2, 10, 9, 8, 11, 10, 2, 3, 0, 4, 7, 6, 5, 4],
                1472.0,
            ),
            (
                "a hole behind a hole",
                vec![0, 1, 2, 3, 0, 4, 7, 6, 8, 11, 10, 9, 8, 6, 5, 4],
                1472.0,
            ),
            ("a slit", vec![0, 1, 2, 3, 0, 4], 1600.0),
            ("a slit with a bend", vec![0, 1, 2, 3, 0, 4, 5, 4], 1600.0),
            ("a spur outwards", vec![4, 5, 6, 2, 6, 7], 64.0),
            ("a spur from a spur", vec![4, 5, 6, 2, 1, 2, 6, 7], 64.0),
        ] {
            let triangles = split(&points, &ring).unwrap();
            assert_eq!(area(&points, &triangles), wanted, "{name}: {triangles:?}");
        }
    }

    #[test]
    fn loops_that_meet_in_a_corner_are_covered_once() {
        // A hole that begins at a corner of the outline, and one at a corner of another hole.
        let corners =
            [[0., 0.], [9., 0.], [9., 9.], [0., 9.], [4., 1.], [1., 4.], [6., 6.], [6., 4.]];
        let points = points(&corners.map(|[x, y]| [x, y, 0.0]));
        let triangles = split(&points, &[0, 1, 2, 3, 0, 5, 4]).unwrap();
        assert_eq!(area(&points, &triangles), 81.0 - 7.5);
        let triangles = split(&points, &[0, 1, 2, 3, 0, 5, 4, 6, 7, 4]).unwrap();
        assert_eq!(area(&points, &triangles), 81.0 - 7.5 - 2.0);
    }

    #[test]
    fn a_large_polygon_is_divided_unless_it_is_too_large_and_not_convex() {
        let comb = |teeth: usize| {
            let tooth = |n: usize| [[n as f64, 0.0, 0.0], [n as f64 + 0.5, 5.0, 0.0]];
            let mut corners: Vec<[f64; 3]> = (0..teeth).flat_map(tooth).collect();
            corners.extend([[teeth as f64, 0.0, 0.0], [0.5 * teeth as f64, -9.0, 0.0]]);
            corners.reverse();
            points(&corners)
        };
        let (fine, large) = (comb(900), comb(1500));
        let all = |points: &[Point3]| (0..points.len()).collect::<Vec<usize>>();
        let triangles = split(&fine, &all(&fine)).unwrap();
        assert_eq!(area(&fine, &triangles), 900.0 * 2.5 + 900.0 * 4.5);
        assert_eq!(split(&large, &all(&large)), None);
    }
}
