//! Which closed curves lie inside which: a curve lies inside another one if it lies in its plane,
//! and a point of it inside the polygon through the points of the other (even–odd rule). The
//! smallest that it lies inside of is its parent.

use sheetwright::math::{Frame, Point2, Point3, Vec3};

/// Points this near to a plane lie in it, as a share of the size of the drawing.
const FLAT: f64 = 1e-6;

/// Points of curves that are drawn twice lie this near to the polygon of the other, as a share of
/// the size: the arcs between its points rise by less.
const ON: f64 = 1e-3;

/// A closed curve by the points that it runs through.
pub(super) struct Ring {
    points: Vec<Point3>,
    low: Vec3,
    high: Vec3,
    /// The plane that it lies in, and itself there; `None` of a curve that is not plane.
    flat: Option<(Frame, Vec<Point2>)>,
    /// The area that it encloses in its plane, mm², positive where it runs counter-clockwise as
    /// seen against the normal of the plane, whose largest component is positive.
    area: f64,
}

impl Ring {
    pub(super) fn new(points: Vec<Point3>, size: f64) -> Self {
        let none = (Vec3::splat(f64::INFINITY), Vec3::splat(f64::NEG_INFINITY));
        let fold =
            |(low, high): (Vec3, Vec3), p: &Point3| (low.min(p.to_vec()), high.max(p.to_vec()));
        let (low, high) = points.iter().fold(none, fold);
        let (flat, area) = match plane(&points, size) {
            Some(frame) => {
                let flat: Vec<Point2> = points.iter().map(|p| frame.project(*p)).collect();
                let area = signed_area(&flat);
                (Some((frame, flat)), area)
            }
            None => (None, 0.0),
        };
        Self { points, low, high, flat, area }
    }

    pub(super) fn is_flat(&self) -> bool {
        self.flat.is_some()
    }

    pub(super) fn is_clockwise(&self) -> bool {
        self.area < 0.0
    }

    /// Whether another curve lies in its plane.
    pub(super) fn holds_in_plane(&self, other: &Self, size: f64) -> bool {
        let Some((frame, _)) = &self.flat else { return false };
        other.points.iter().all(|p| (*p - frame.origin).dot(frame.z).abs() <= FLAT * size)
    }

    /// Whether another curve lies inside of it.
    fn contains(&self, other: &Self, size: f64) -> bool {
        let near = Vec3::splat(FLAT * size);
        let is_in_box =
            (self.low - near).cmple(other.low).all() && other.high.cmple(self.high + near).all();
        let Some((frame, polygon)) = &self.flat else { return false };
        if !is_in_box || self.area.abs() <= other.area.abs() || !self.holds_in_plane(other, size) {
            return false;
        }
        // Points on the border of the other may fall either way: most of some decide.
        let step = (other.points.len() / 9).max(1);
        let tried: Vec<bool> = other
            .points
            .iter()
            .step_by(step)
            .map(|p| is_inside(polygon, frame.project(*p)))
            .collect();
        2 * tried.iter().filter(|inside| **inside).count() > tried.len()
    }

    /// Whether another curve is drawn on this one.
    fn is_on(&self, other: &Self, size: f64) -> bool {
        let near = FLAT * size;
        (self.low - other.low).abs().max_element() <= near
            && (self.high - other.high).abs().max_element() <= near
            && (self.area.abs() - other.area.abs()).abs() <= near * size
            && self.is_flat()
            && self.holds_in_plane(other, size)
            && self.runs_through(other, ON * size)
    }

    /// Whether some points of another curve lie on this one.
    fn runs_through(&self, other: &Self, near: f64) -> bool {
        let step = (other.points.len() / 9).max(1);
        other.points.iter().step_by(step).all(|&p| {
            let sides = self.points.iter().zip(self.points.iter().cycle().skip(1));
            sides.into_iter().any(|(a, b)| {
                let (way, from) = (*b - *a, p - *a);
                let share = (from.dot(way) / way.length_squared()).clamp(0.0, 1.0);
                (from - way * share).length() <= near
            })
        })
    }
}

/// The smallest ring that each lies inside of.
pub(super) fn parents(rings: &[&Ring], size: f64) -> Vec<Option<usize>> {
    let parent = |n: usize| {
        let around = (0..rings.len()).filter(|&m| m != n && rings[m].contains(rings[n], size));
        around.min_by(|&a, &b| rings[a].area.abs().total_cmp(&rings[b].area.abs()))
    };
    (0..rings.len()).map(parent).collect()
}

/// Which rings lie on an earlier one.
pub(super) fn doubled(rings: &[Ring], size: f64) -> Vec<bool> {
    (0..rings.len())
        .map(|n| rings[..n].iter().any(|before| before.is_on(&rings[n], size)))
        .collect()
}

/// The plane through the first point, the farthest from it, and the one that is farthest from the
/// line between them, if all points lie in it.
fn plane(points: &[Point3], size: f64) -> Option<Frame> {
    let first = *points.first()?;
    let far = |p: &&Point3| (**p - first).length_squared();
    let last = *points.iter().max_by(|p, q| far(p).total_cmp(&far(q)))?;
    let across = points.iter().map(|p| (last - first).cross(*p - first));
    let normal = across.max_by(|n, m| n.length_squared().total_cmp(&m.length_squared()))?;
    let largest = normal.abs().max_element();
    let lead = normal.to_array().into_iter().find(|c| c.abs() == largest)?;
    let normal = if lead < 0.0 { -normal } else { normal };
    let frame = Frame::with_normal(first, normal)?;
    let is_in = |p: &Point3| (*p - first).dot(frame.z).abs() <= FLAT * size;
    points.iter().all(is_in).then_some(frame)
}

fn signed_area(polygon: &[Point2]) -> f64 {
    let Some(first) = polygon.first() else { return 0.0 };
    let from = |p: &Point2| (p.x - first.x, p.y - first.y);
    let pairs = polygon.iter().zip(polygon.iter().cycle().skip(1));
    pairs
        .map(|(a, b)| {
            let (a, b) = (from(a), from(b));
            0.5 * (a.0 * b.1 - a.1 * b.0)
        })
        .sum()
}

fn is_inside(polygon: &[Point2], p: Point2) -> bool {
    let pairs = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed = pairs.filter(|(a, b)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
    });
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(middle: [f64; 3], half: f64) -> Ring {
        let [x, y, z] = middle;
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let points = corners.map(|(i, j)| Point3::new(x + half * i, y + half * j, z));
        Ring::new(points.to_vec(), 100.0)
    }

    #[test]
    fn halves_of_a_square_are_two() {
        let ring = |corners: [(f64, f64); 3]| {
            Ring::new(corners.map(|(x, y)| Point3::new(x, y, 0.0)).to_vec(), 100.0)
        };
        let lower = [(0.0, 0.0), (100.0, 0.0), (0.0, 100.0)];
        let upper = [(100.0, 0.0), (100.0, 100.0), (0.0, 100.0)];
        let turned = [(100.0, 0.0), (0.0, 100.0), (0.0, 0.0)];
        assert_eq!(doubled(&[lower, upper, turned].map(ring), 100.0), [false, false, true]);
    }

    #[test]
    fn a_figure_of_eight_is_plane() {
        let eight = [(0.0, 0.0), (2.0, 1.0), (2.0, 0.0), (0.0, 1.0)];
        let points = eight.map(|(x, y)| Point3::new(x, y, 3.0 + x)).to_vec();
        assert!(Ring::new(points, 2.0).is_flat());
    }

    #[test]
    fn the_smallest_around_is_the_parent() {
        let rings = [
            square([0.0; 3], 50.0),
            square([5.0, 0.0, 0.0], 10.0),
            square([5.0, 0.0, 0.0], 2.0),
            square([-30.0, 0.0, 0.0], 10.0),
            square([0.0, 0.0, 7.0], 10.0),
            square([5.0, 0.0, 0.0], 10.0),
        ];
        let found = parents(&rings.iter().collect::<Vec<_>>(), 100.0);
        assert_eq!(found, [None, Some(0), Some(1), Some(0), None, Some(0)]);
        assert_eq!(doubled(&rings, 100.0), [false, false, false, false, false, true]);
    }
}
