//! Where parts lie while they are searched for, and how deeply they overlap.
//!
//! Two parts collide if two of their circles overlap, if two of their sides cross or if one lies
//! inside the other. How badly is told by the circles: the depths to which they overlap, times
//! their radii, in all, as an area; circles that lie apart count a little, so that a part feels
//! which way leads out \[GardeynVandenBergheWauters2025\].

use super::shape::{Pole, Shape};
use sheetwright_geometry::math::{Point2, Vec2, cos, sin};

/// Circles that come nearer than this share of the radius of the larger form feel one another.
const NEAR: f64 = 0.02;

/// Where a part lies: turned over or not, turned, and moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    /// On which of the sheets.
    pub(super) sheet: usize,
    /// Where the middle of its form lies.
    pub(super) at: Point2,
    /// By which angle it is turned, radians.
    pub(super) turn: f64,
    /// Whether it is turned over first, top to bottom.
    pub(super) is_over: bool,
}

/// A form where it lies.
#[derive(Clone, Debug, Default)]
pub(super) struct Placed {
    pub(super) points: Vec<Point2>,
    pub(super) poles: Vec<Pole>,
    pub(super) low: Vec2,
    pub(super) high: Vec2,
}

impl Placed {
    /// Lays a form down.
    pub(super) fn set(&mut self, shape: &Shape, pose: &Pose) {
        let (sin, cos) = (sin(pose.turn), cos(pose.turn));
        let side = if pose.is_over { -1.0 } else { 1.0 };
        let laid = |p: Point2| {
            let y = side * p.y;
            Point2::new(pose.at.x + cos * p.x - sin * y, pose.at.y + sin * p.x + cos * y)
        };
        self.points.clear();
        self.points.extend(shape.points.iter().map(|&p| laid(p)));
        self.poles.clear();
        self.poles.extend(shape.poles.iter().map(|p| Pole { at: laid(p.at), radius: p.radius }));
        (self.low, self.high) = (Vec2::splat(f64::INFINITY), Vec2::splat(f64::NEG_INFINITY));
        let mut reach = |p: Point2, by: Vec2| {
            self.low = self.low.min(p.to_vec() - by);
            self.high = self.high.max(p.to_vec() + by);
        };
        // What lies within a distance of a part lies in its box, grown by that.
        match &shape.boxed {
            Some(boxed) => {
                boxed.hull.iter().for_each(|&p| reach(laid(p), Vec2::splat(boxed.by_mm)));
            }
            None => self.points.iter().for_each(|&p| reach(p, Vec2::ZERO)),
        }
    }
}

/// How much work was done, in steps that take about as long.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work(pub(super) u64);

/// How badly two forms collide; 0 if they don't.
pub(super) fn collision(a: (&Shape, &Placed), b: (&Shape, &Placed), work: &mut Work) -> f64 {
    let (low, high) = (a.1.low.max(b.1.low), a.1.high.min(b.1.high));
    if low.x >= high.x || low.y >= high.y {
        return 0.0;
    }
    let feel = NEAR * a.0.radius.max(b.0.radius);
    let (mut depth, mut is_met) = (0.0, false);
    for p in &a.1.poles {
        for q in &b.1.poles {
            let deep = p.radius + q.radius - p.at.distance(q.at);
            is_met |= deep > 0.0;
            let felt = if deep >= feel { deep } else { feel * feel / (2.0 * feel - deep) };
            depth += felt * p.radius.min(q.radius);
        }
    }
    work.0 += (a.1.poles.len() * b.1.poles.len()) as u64 / 2;
    if !is_met && !sides_cross(a, b, low, high, work) && !holds(a, b.1) && !holds(b, a.1) {
        return 0.0;
    }
    let area = std::f64::consts::PI * depth + feel * feel;
    // Large forms are harder to place: theirs weighs more.
    area.sqrt() * (a.0.hull_area * b.0.hull_area).sqrt().sqrt()
}

/// Whether a side of one crosses a side of the other, in the box that both have in common.
fn sides_cross(
    a: (&Shape, &Placed),
    b: (&Shape, &Placed),
    low: Vec2,
    high: Vec2,
    work: &mut Work,
) -> bool {
    let in_box = |p: Point2, q: Point2| {
        p.x.min(q.x) <= high.x
            && p.x.max(q.x) >= low.x
            && p.y.min(q.y) <= high.y
            && p.y.max(q.y) >= low.y
    };
    let sides = |of: (&Shape, &Placed)| -> Vec<[Point2; 2]> {
        let points = &of.1.points;
        let side = |(n, &p): (usize, &Point2)| [p, points[of.0.next[n]]];
        points.iter().enumerate().map(side).filter(|[p, q]| in_box(*p, *q)).collect()
    };
    work.0 += (a.1.points.len() + b.1.points.len()) as u64;
    let of_a = sides(a);
    if of_a.is_empty() {
        return false;
    }
    let of_b = sides(b);
    work.0 += (of_a.len() * of_b.len()) as u64;
    of_a.iter().any(|&one| of_b.iter().any(|&other| cross(one, other)))
}

/// Whether two sides cross. It is exact only up to rounding, which is enough while parts are moved
/// about, and much faster than `predicate`; the proof at the end is exact.
fn cross([p, q]: [Point2; 2], [r, s]: [Point2; 2]) -> bool {
    let (pq, rs) = (q - p, s - r);
    (pq.perp_dot(r - p) > 0.0) != (pq.perp_dot(s - p) > 0.0)
        && (rs.perp_dot(p - r) > 0.0) != (rs.perp_dot(q - r) > 0.0)
}

/// Whether the first circle of `b` has its middle in `a`.
fn holds(a: (&Shape, &Placed), b: &Placed) -> bool {
    let Some(pole) = b.poles.first() else { return false };
    let p = pole.at;
    if p.x < a.1.low.x || p.x > a.1.high.x || p.y < a.1.low.y || p.y > a.1.high.y {
        return false;
    }
    is_in(&a.1.points, &a.0.next, p)
}

/// Whether a point lies in a region, up to rounding.
fn is_in(points: &[Point2], next: &[usize], p: Point2) -> bool {
    let mut is_in = false;
    for (n, &a) in points.iter().enumerate() {
        let b = points[next[n]];
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
            is_in = !is_in;
        }
    }
    is_in
}

/// The room on a sheet in which grown forms may lie.
#[derive(Clone, Debug)]
pub(super) struct Room {
    /// The box around it.
    pub(super) low: Vec2,
    pub(super) high: Vec2,
    /// Its corners, counter-clockwise, where it is no rectangle.
    pub(super) outline: Vec<Point2>,
    /// The corner that follows each.
    next: Vec<usize>,
}

impl Room {
    /// A room in a box, with these corners where it is no rectangle.
    pub(super) fn new(low: Vec2, high: Vec2, outline: Vec<Point2>) -> Self {
        let m = outline.len();
        Self { low, high, outline, next: (0..m).map(|k| (k + 1) % m).collect() }
    }

    pub(super) fn area(&self) -> f64 {
        let size = self.high - self.low;
        size.x * size.y
    }

    /// How badly a form leaves the room; 0 if it does not.
    pub(super) fn left(&self, shape: &Shape, placed: &Placed, work: &mut Work) -> f64 {
        let penalty = shape.hull_area.sqrt();
        let size = placed.high - placed.low;
        let area = (size.x * size.y).max(f64::MIN_POSITIVE);
        let common = placed.high.min(self.high) - placed.low.max(self.low);
        if common.x < 0.0 || common.y < 0.0 {
            let away = (0.5 * (placed.low + placed.high - self.low - self.high)).length();
            return 2.0 * (area + away * shape.radius).sqrt() * penalty;
        }
        let is_in_box = placed.low.cmpge(self.low).all() && placed.high.cmple(self.high).all();
        if !is_in_box {
            let out = (area - common.x * common.y).max(0.0) + 1e-4 * area;
            return 2.0 * out.sqrt() * penalty;
        }
        if self.outline.is_empty() || !self.crosses(shape, placed, work) {
            return 0.0;
        }
        let mut out = 1e-4 * area;
        for pole in &placed.poles {
            let to_side = |[r, s]: [Point2; 2]| pole.at.distance_to_segment([r, s]);
            let off = self.sides().map(to_side).fold(f64::INFINITY, f64::min);
            let off = if is_in(&self.outline, &self.next, pole.at) { off } else { -off };
            out += (pole.radius - off).max(0.0) * pole.radius;
        }
        work.0 += (self.outline.len() * placed.poles.len()) as u64;
        2.0 * out.sqrt() * penalty
    }

    fn sides(&self) -> impl Iterator<Item = [Point2; 2]> + '_ {
        self.outline.iter().zip(&self.next).map(|(&p, &next)| [p, self.outline[next]])
    }

    /// Whether a form crosses the outline or lies beyond it.
    fn crosses(&self, shape: &Shape, placed: &Placed, work: &mut Work) -> bool {
        work.0 += (self.outline.len() * placed.points.len()) as u64;
        let sides =
            placed.points.iter().zip(&shape.next).map(|(&p, &next)| [p, placed.points[next]]);
        placed.points.iter().any(|&p| !is_in(&self.outline, &self.next, p))
            || sides.into_iter().any(|side| self.sides().any(|other| cross(side, other)))
    }
}
