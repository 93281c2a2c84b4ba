//! Whether a surface passes through itself, decided by exact predicates.
//!
//! Two triangles that share no side pass through one another only if a side of one meets the other
//! somewhere else than at a common sample. So every pair of triangles whose boxes touch is looked
//! at: each side of the one that has no end on the other against that other. Triangles in one plane
//! are compared there. Samples on one spot (the two sides of a seam) count as common.

use crate::boundary::size_of;
use crate::index::TriangleIndex;
use crate::math::{Point2, Point3, Vec3};
use crate::predicate::{for_touching_boxes, orientation, orientation3};
use crate::surface::Surface;
use crate::tolerance::Tolerance;
use std::cmp::Ordering;

/// The first two triangles, by their numbers, that pass through one another.
pub fn first_self_crossing(surface: &Surface) -> Option<[TriangleIndex; 2]> {
    let count = surface.connectivity().triangles().len();
    let spots = spots(surface.positions());
    let corners: Vec<[Point3; 3]> = (0..count)
        .map(|n| surface.connectivity().triangles()[n].map(|sample| spots[sample.get()]))
        .collect();
    let boxes: Vec<(Vec3, Vec3)> = corners
        .iter()
        .map(|c| {
            let [a, b, c] = c.map(Point3::to_vec);
            (a.min(b).min(c), a.max(b).max(c))
        })
        .collect();
    let mut first: Option<[usize; 2]> = None;
    for_touching_boxes(&boxes, |i, j| {
        if first.is_none_or(|best| [i, j] < best) && cross(corners[i], corners[j]) {
            first = Some([i, j]);
        }
    });
    first.map(|pair| pair.map(TriangleIndex::new))
}

/// The samples, each moved to the first of those that lie on its spot.
fn spots(positions: &[Point3]) -> Vec<Point3> {
    let same = Tolerance::SAME_POINT.length_mm(size_of(positions.iter().copied()));
    let mut order: Vec<usize> = (0..positions.len()).collect();
    order.sort_by(|&i, &j| positions[i].x.total_cmp(&positions[j].x).then(i.cmp(&j)));
    let mut first: Vec<usize> = (0..positions.len()).collect();
    for (n, &i) in order.iter().enumerate() {
        let before = order[..n].iter().rev().copied();
        for j in before.take_while(|&j| positions[i].x - positions[j].x <= same) {
            if positions[i].distance(positions[j]) <= same {
                first[i] = first[j];
                break;
            }
        }
    }
    first.into_iter().map(|i| positions[i]).collect()
}

/// The two triangles at a rung are never told to cross here unless they lie in one plane, folded
/// onto one another.
fn cross(t: [Point3; 3], u: [Point3; 3]) -> bool {
    let sides = |t: [Point3; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let sides_of_u = off_plane(t, u);
    // Beyond their common samples, one lies wholly on one side of the other.
    if sides_of_u.are_one() {
        return false;
    }
    if sides_of_u.all(Ordering::Equal) {
        return overlap_in_plane(t, u);
    }
    if off_plane(u, t).are_one() {
        return false;
    }
    let meets = |t: [Point3; 3], u: [Point3; 3]| {
        sides(t)
            .into_iter()
            .filter(|side| side.iter().all(|end| !u.contains(end)))
            .any(|[a, b]| pierces(a, b, u))
    };
    meets(t, u) || meets(u, t)
}

/// On which sides of the plane of a triangle the corners of another lie that are none of its own.
fn off_plane(plane: [Point3; 3], corners: [Point3; 3]) -> Sides {
    let mut sides = Sides { list: [Ordering::Equal; 3], count: 0 };
    for p in corners.into_iter().filter(|p| !plane.contains(p)) {
        sides.list[sides.count] = orientation3(plane[0], plane[1], plane[2], p);
        sides.count += 1;
    }
    sides
}

/// Up to three sides of a plane.
struct Sides {
    list: [Ordering; 3],
    count: usize,
}

impl Sides {
    fn all(&self, side: Ordering) -> bool {
        self.list[..self.count].iter().all(|&s| s == side)
    }

    /// Whether there are some, all on one side and none in the plane.
    fn are_one(&self) -> bool {
        self.count > 0 && (self.all(Ordering::Less) || self.all(Ordering::Greater))
    }
}

/// Whether the segment a–b meets a triangle that it has no corner in common with.
fn pierces(a: Point3, b: Point3, [p, q, r]: [Point3; 3]) -> bool {
    let (from, to) = (orientation3(p, q, r, a), orientation3(p, q, r, b));
    if from == to {
        // Both on one side; or both in the plane, and then the triangle's own sides will tell.
        return false;
    }
    let turns = [(p, q), (q, r), (r, p)].map(|(s, t)| orientation3(a, b, s, t));
    let none = |sign: Ordering| turns.iter().all(|&turn| turn != sign);
    none(Ordering::Less) || none(Ordering::Greater)
}

/// Whether two triangles in one plane have inner points in common.
fn overlap_in_plane(t: [Point3; 3], u: [Point3; 3]) -> bool {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).abs();
    // Seen along the axis nearest to the normal, the order of points is kept.
    let flat = |p: Point3| {
        if normal.x >= normal.y && normal.x >= normal.z {
            Point2::new(p.y, p.z)
        } else if normal.y >= normal.z {
            Point2::new(p.x, p.z)
        } else {
            Point2::new(p.x, p.y)
        }
    };
    let [t, u] = [t.map(flat), u.map(flat)].map(counter_clockwise);
    // Apart exactly if a side of one has the other wholly on its right or on its line.
    let separated = |t: [Point2; 3], u: [Point2; 3]| {
        (0..3).any(|n| u.iter().all(|&p| orientation(t[n], t[(n + 1) % 3], p) != Ordering::Greater))
    };
    !separated(t, u) && !separated(u, t)
}

fn counter_clockwise([a, b, c]: [Point2; 3]) -> [Point2; 3] {
    if orientation(a, b, c) == Ordering::Less { [a, c, b] } else { [a, b, c] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64, z: f64) -> Point3 {
        Point3::new(x, y, z)
    }

    #[test]
    fn triangles_that_cross_and_others() {
        let t = [p(0., 0., 0.), p(4., 0., 0.), p(0., 4., 0.)];
        assert!(cross(t, [p(1., 1., -1.), p(1., 1., 1.), p(9., 9., 1.)]));
        assert!(!cross(t, [p(1., 1., 0.5), p(1., 1., 1.), p(9., 9., 1.)]));
        assert!(!cross(t, [p(4., 0., 0.), p(0., 4., 0.), p(4., 4., 3.)]), "a common side");
        assert!(!cross(t, [p(4., 0., 0.), p(8., 0., 1.), p(8., 1., -1.)]), "a common corner");
        assert!(cross(t, [p(4., 0., 0.), p(0., 2., 1.), p(0., 2., -1.)]), "corner and crossing");
        assert!(cross(t, [p(4., 0., 0.), p(0., 4., 0.), p(1., 1., 0.)]), "folded back in a plane");
        assert!(!cross(t, [p(4., 0., 0.), p(0., 4., 0.), p(4., 4., 0.)]), "side by side");
    }
}
