//! Whether a surface passes through itself, decided by exact predicates.
//!
//! Two triangles that share no side pass through one another only if a side of one meets the other
//! somewhere else than at a common sample. So every pair of triangles whose boxes touch is looked
//! at: each side of the one that has no end on the other against that other. Triangles in one plane
//! are compared there. Samples on one spot (the two sides of a seam) count as common.
//!
//! Nearly all of these pairs are told apart sooner: one lies wholly on one side of the plane of the
//! other, which plain arithmetic shows unless it is near; or, as in a flat panel, a side of one has
//! the other wholly beyond it as both are seen along an axis, where predicates of the plane
//! suffice.
//!
//! A triangle without area crosses none: its longest side is one of a neighbour, which is compared.
//!
//! Before all that stands a look at the whole (`seen`), after which most panels need nothing else.

mod seen;

use crate::surface::Surface;
use seen::is_simple_as_seen;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Point2, Point3, Vec3};
use sheetwright_geometry::predicate::{
    any_touching_boxes, for_touching_boxes, orientation, orientation3,
};
use sheetwright_geometry::tolerance::Tolerance;
use std::cmp::Ordering;

/// The first two triangles, by their numbers, that pass through one another.
pub(super) fn first_self_crossing(surface: &Surface) -> Option<[TriangleIndex; 2]> {
    if is_simple_as_seen(surface) { None } else { first_crossing_pair(surface) }
}

fn first_crossing_pair(surface: &Surface) -> Option<[TriangleIndex; 2]> {
    let triangles = triangles(surface);
    let mut first: Option<[usize; 2]> = None;
    for_touching_boxes(&boxes(&triangles), |i, j| {
        if first.is_none_or(|best| [i, j] < best) && cross(&triangles[i], &triangles[j]) {
            first = Some([i, j]);
        }
    });
    first.map(|pair| pair.map(TriangleIndex::new))
}

/// Whether any two triangles pass through one another: sooner known than which are the first.
pub(crate) fn crosses_itself(surface: &Surface) -> bool {
    if is_simple_as_seen(surface) {
        return false;
    }
    let triangles = triangles(surface);
    any_touching_boxes(&boxes(&triangles), |i, j| cross(&triangles[i], &triangles[j]))
}

fn triangles(surface: &Surface) -> Vec<Triangle> {
    let spots = spots(surface.positions());
    let corners = |triangle: &[SampleIndex; 3]| triangle.map(|sample| spots[sample.get()]);
    surface.connectivity().triangles().iter().map(|t| Triangle::new(corners(t))).collect()
}

fn boxes(triangles: &[Triangle]) -> Vec<(Vec3, Vec3)> {
    let around = |triangle: &Triangle| {
        let [a, b, c] = triangle.corners.map(Point3::to_vec);
        (a.min(b).min(c), a.max(b).max(c))
    };
    triangles.iter().map(around).collect()
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

/// What rounding may make of the sixfold volume of a tetrahedron, as a share of the sum of its six
/// products: a little more than the (7 + 56 ε) ε of \[Shewchuk1997\], whose ε is half of
/// `f64::EPSILON`.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The plane of two directions.
struct Plane {
    /// Their cross product, and the same with the sizes of its products.
    normal: Vec3,
    most: Vec3,
}

impl Plane {
    fn new(u: Vec3, v: Vec3) -> Self {
        let most = |u: [f64; 2], v: [f64; 2]| (u[0] * v[1]).abs() + (u[1] * v[0]).abs();
        Self {
            normal: u.cross(v),
            most: Vec3::new(
                most([u.y, u.z], [v.y, v.z]),
                most([u.z, u.x], [v.z, v.x]),
                most([u.x, u.y], [v.x, v.y]),
            ),
        }
    }

    /// To which side of it a third one points, `Greater` if to that of its normal; `None` where
    /// rounding leaves it open.
    fn certain_side(&self, way: Vec3) -> Option<Ordering> {
        let (volume, most) = (way.dot(self.normal), way.abs().dot(self.most));
        if most == 0.0 {
            // No product is left, as in a plane along two axes.
            return Some(Ordering::Equal);
        }
        (volume.abs() > ROUNDING * most).then(|| volume.total_cmp(&0.0))
    }
}

/// A triangle and its plane.
struct Triangle {
    corners: [Point3; 3],
    plane: Plane,
    /// Whether its corners do not lie on one line.
    has_area: bool,
}

impl Triangle {
    fn new(corners: [Point3; 3]) -> Self {
        let plane = Plane::new(corners[1] - corners[0], corners[2] - corners[0]);
        let is_seen_along = |axis: Vec3| {
            let [a, b, c] = corners.map(seen_along(axis));
            orientation(a, b, c).is_ne()
        };
        Self {
            corners,
            // Seen along the first of these, it nearly always has area if it has any.
            has_area: [plane.normal, Vec3::X, Vec3::Y, Vec3::Z].into_iter().any(is_seen_along),
            plane,
        }
    }

    fn sides(&self) -> [[Point3; 2]; 3] {
        let [a, b, c] = self.corners;
        [[a, b], [b, c], [c, a]]
    }

    /// On which side of its plane a point lies, as [`orientation3`] says, which is asked only where
    /// rounding leaves it open.
    fn side(&self, p: Point3) -> Ordering {
        let [a, b, c] = self.corners;
        self.certain_side(p).unwrap_or_else(|| orientation3(a, b, c, p))
    }

    /// On which side of its plane a point lies; `None` where rounding leaves it open.
    fn certain_side(&self, p: Point3) -> Option<Ordering> {
        self.plane.certain_side(p - self.corners[0])
    }

    /// The corners of another that are none of its own.
    fn others_of(&self, other: &Self) -> impl Iterator<Item = Point3> {
        other.corners.into_iter().filter(|p| !self.corners.contains(p))
    }

    /// Whether these certainly lie on one side of its plane.
    fn has_on_one_side(&self, other: &Self) -> bool {
        let mut sides = self.others_of(other).map(|p| self.certain_side(p));
        let first = sides.next().flatten().filter(|side| side.is_ne());
        first.is_some() && sides.all(|side| side == first)
    }

    /// On which sides of its plane these lie.
    fn sides_of(&self, other: &Self) -> Sides {
        let mut sides = Sides { list: [Ordering::Equal; 3], count: 0 };
        for p in self.others_of(other) {
            sides.list[sides.count] = self.side(p);
            sides.count += 1;
        }
        sides
    }
}

/// The two triangles at a rung are never told to cross here unless they lie in one plane, folded
/// onto one another.
fn cross(t: &Triangle, u: &Triangle) -> bool {
    let are_apart = t.has_on_one_side(u) || u.has_on_one_side(t) || are_apart_as_seen(t, u);
    !are_apart && cross_by_sides(t, u)
}

/// Whether two triangles cross, by the sides of planes alone, on which the corners lie, and the
/// sides that lead through them.
fn cross_by_sides(t: &Triangle, u: &Triangle) -> bool {
    if !(t.has_area && u.has_area) {
        return false;
    }
    let sides_of_u = t.sides_of(u);
    // Beyond their common samples, one lies wholly on one side of the other.
    if sides_of_u.are_one() {
        return false;
    }
    if sides_of_u.all(Ordering::Equal) {
        return overlap_in_plane(t.corners, u.corners);
    }
    if u.sides_of(t).are_one() {
        return false;
    }
    let meets = |t: &Triangle, u: &Triangle| {
        t.sides()
            .into_iter()
            .filter(|side| side.iter().all(|end| !u.corners.contains(end)))
            .any(|[a, b]| pierces(a, b, u))
    };
    meets(t, u) || meets(u, t)
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
fn pierces(a: Point3, b: Point3, triangle: &Triangle) -> bool {
    if triangle.side(a) == triangle.side(b) {
        // Both on one side; or both in the plane, and then the triangle's own sides will tell.
        return false;
    }
    let turns = triangle.sides().map(|[s, t]| orientation3(a, b, s, t));
    let none = |sign: Ordering| turns.iter().all(|&turn| turn != sign);
    none(Ordering::Less) || none(Ordering::Greater)
}

/// Whether, seen along the axis nearest to the normal of the first, a side of one triangle has all
/// of the other beyond it but for common samples, so that they have nothing else in common.
fn are_apart_as_seen(t: &Triangle, u: &Triangle) -> bool {
    let flat = seen_along(t.plane.normal);
    let [seen_t, seen_u] = [t, u].map(|triangle| triangle.corners.map(&flat));
    has_beyond_a_side((t.corners, seen_t), (u.corners, seen_u))
        || has_beyond_a_side((u.corners, seen_u), (t.corners, seen_t))
}

/// Whether a side of one triangle has all corners of another beyond it but for common samples,
/// given the corners of each and how they are seen.
fn has_beyond_a_side(
    (corners, seen): ([Point3; 3], [Point2; 3]),
    (others, seen_others): ([Point3; 3], [Point2; 3]),
) -> bool {
    let inwards = orientation(seen[0], seen[1], seen[2]);
    let has_beyond = |[from, to]: [usize; 2]| {
        others.iter().zip(seen_others).all(|(other, seen_other)| {
            *other == corners[from]
                || *other == corners[to]
                || orientation(seen[from], seen[to], seen_other) == inwards.reverse()
        })
    };
    inwards.is_ne() && [[0, 1], [1, 2], [2, 0]].into_iter().any(has_beyond)
}

/// Whether two triangles in one plane have inner points in common.
fn overlap_in_plane(t: [Point3; 3], u: [Point3; 3]) -> bool {
    // Seen along the axis nearest to the normal, the order of points is kept.
    let flat = seen_along((t[1] - t[0]).cross(t[2] - t[0]));
    let [t, u] = [t.map(&flat), u.map(&flat)].map(counter_clockwise);
    // Apart exactly if a side of one has the other wholly on its right or on its line.
    let separated = |t: [Point2; 3], u: [Point2; 3]| {
        (0..3).any(|n| u.iter().all(|&p| orientation(t[n], t[(n + 1) % 3], p) != Ordering::Greater))
    };
    !separated(t, u) && !separated(u, t)
}

/// Points as they are seen along the axis nearest to a direction.
fn seen_along(direction: Vec3) -> impl Fn(Point3) -> Point2 {
    let along = direction.abs();
    move |p| {
        if along.x >= along.y && along.x >= along.z {
            Point2::new(p.y, p.z)
        } else if along.y >= along.z {
            Point2::new(p.x, p.z)
        } else {
            Point2::new(p.x, p.y)
        }
    }
}

fn counter_clockwise([a, b, c]: [Point2; 3]) -> [Point2; 3] {
    if orientation(a, b, c) == Ordering::Less { [a, c, b] } else { [a, b, c] }
}

#[cfg(test)]
mod tests {
    use super::seen::{is_simple_along, is_simple_along_axis};
    use super::*;
    use crate::surface::Connectivity;
    use sheetwright_geometry::math::Frame;

    fn p(x: f64, y: f64, z: f64) -> Point3 {
        Point3::new(x, y, z)
    }

    #[test]
    fn triangles_that_cross_and_others() {
        let cross = |t, u| cross(&Triangle::new(t), &Triangle::new(u));
        let t = [p(0., 0., 0.), p(4., 0., 0.), p(0., 4., 0.)];
        assert!(cross(t, [p(1., 1., -1.), p(1., 1., 1.), p(9., 9., 1.)]));
        assert!(!cross(t, [p(1., 1., 0.5), p(1., 1., 1.), p(9., 9., 1.)]));
        assert!(!cross(t, [p(4., 0., 0.), p(0., 4., 0.), p(4., 4., 3.)]), "a common side");
        assert!(!cross(t, [p(4., 0., 0.), p(8., 0., 1.), p(8., 1., -1.)]), "a common corner");
        assert!(cross(t, [p(4., 0., 0.), p(0., 2., 1.), p(0., 2., -1.)]), "corner and crossing");
        assert!(cross(t, [p(4., 0., 0.), p(0., 4., 0.), p(1., 1., 0.)]), "folded back in a plane");
        assert!(!cross(t, [p(4., 0., 0.), p(0., 4., 0.), p(4., 4., 0.)]), "side by side");
        let line = [p(-2., 0., 0.), p(0., 2., -2.), p(-1., 1., -1.)];
        let beside = [p(-2., 2., -1.), p(-1., 0., 2.), p(1., -2., 0.)];
        assert!(!cross(line, beside) && !cross(beside, line), "one without area");
    }

    /// Numbers between -0.5 and 0.5.
    fn random() -> impl FnMut() -> f64 {
        let mut state = 1u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        }
    }

    #[test]
    fn shortcuts_change_nothing() {
        let mut random = random();
        let (mut found, mut without_area) = ([0; 3], 0);
        for n in 0..60_000 {
            // Few places, so that corners are shared, lie on sides and in planes: in space, in a
            // plane along two axes, and in a slanted one where rounding is felt.
            let mut at = || {
                let [x, y, z] = [0, 1, 2].map(|_| (4.0 * random()).round());
                match n % 3 {
                    0 => p(x, y, z),
                    1 => p(x, y, 7.0),
                    _ => p(x, y, 0.1 * x + 0.3 * y),
                }
            };
            let [t, u] = [0, 1].map(|_| Triangle::new([at(), at(), at()]));
            let crosses = cross_by_sides(&t, &u);
            assert_eq!(cross(&t, &u), crosses, "{:?} {:?}", t.corners, u.corners);
            found[n % 3] += usize::from(crosses);
            without_area += usize::from(!(t.has_area && u.has_area));
        }
        assert!(found.iter().all(|count| *count > 2000), "{found:?}");
        assert!(without_area > 2000, "{without_area}");
    }

    /// A fan of triangles around the first corner, heights at will.
    fn fan(corners: Vec<Point3>) -> Surface {
        let triangles = (2..corners.len()).map(|n| [0, n - 1, n].map(SampleIndex::new)).collect();
        let of_loop = 0..corners.len();
        let connectivity = Connectivity::new(std::slice::from_ref(&of_loop), triangles).unwrap();
        Surface::new(connectivity, corners)
    }

    #[test]
    fn what_is_simple_as_seen_crosses_nowhere() {
        let mut random = random();
        // Turns the surfaces about, so that no axis is near to where they are seen from.
        let turned = Frame::with_normal(p(50., -20., 30.), Vec3::new(0.5, 0.6, 0.7)).unwrap();
        let (mut found, mut found_along) = ([[0; 2]; 2], [0; 2]);
        for _ in 0..6000 {
            // Around the first corner, mostly in order as seen along z; few places, so that some
            // touch.
            let mut corners = vec![p(0., 0., 0.)];
            let mut angle = 0.0;
            for _ in 0..9 {
                angle += 0.6 + random();
                let (x, y) = (
                    sheetwright_geometry::math::cos(angle),
                    sheetwright_geometry::math::sin(angle),
                );
                let far = 2.5 + 2.0 * random();
                corners.push(p((far * x).round(), (far * y).round(), 4.0 * random()));
            }
            let Frame { origin, x, y, z } = turned;
            let turn = |c: &Point3| origin + x * c.x + y * c.y + z * c.z;
            let surfaces = [fan(corners.iter().map(turn).collect()), fan(corners)];
            let [turned, surface] = surfaces.each_ref();
            let [crosses_turned, crosses] =
                [turned, surface].map(|s| first_crossing_pair(s).is_some());
            let simple = is_simple_along_axis(surface, Vec3::Z);
            assert!(!(simple && crosses), "{:?}", surface.positions());
            found[usize::from(simple)][usize::from(crosses)] += 1;
            // Where samples touch, rounding leaves it open.
            let along = [is_simple_along(surface, Vec3::Z), is_simple_along(turned, z)];
            assert!(simple || !along[0], "{:?}", surface.positions());
            assert!(!(along[1] && crosses_turned), "{:?}", turned.positions());
            for (count, along) in found_along.iter_mut().zip(along) {
                *count += usize::from(along);
            }
            for (s, crosses) in [(surface, crosses), (turned, crosses_turned)] {
                assert!(!(is_simple_as_seen(s) && crosses), "{:?}", s.positions());
            }
        }
        let [[other, crossing], [simple, _]] = found;
        assert!(other > 100 && crossing > 100 && simple > 100, "{found:?}");
        assert!(
            found_along.iter().all(|along| 10 * along > 9 * simple),
            "{found_along:?} {simple}"
        );
    }

    #[test]
    fn the_side_of_a_triangle_is_exact() {
        let mut random = random();
        let mut found = [0; 3];
        for n in 0..3000 {
            // Far from the origin rounding is large; points between the corners are in the plane,
            // or a last digit off it.
            let far = [0.0, 1.0, 1e6][n % 3];
            let mut at = || p(far + random(), random(), far + random());
            let [a, b, c, aside] = [at(), at(), at(), at()];
            let between = a.lerp(b, random()).lerp(c, random());
            let triangle = Triangle::new([a, b, c]);
            for point in [aside, between, a, a.lerp(b, 0.5)] {
                let side = orientation3(a, b, c, point);
                assert_eq!(triangle.side(point), side, "{a:?} {b:?} {c:?} {point:?}");
                found[(side as i8 + 1) as usize] += 1;
            }
        }
        assert!(found.iter().all(|count| *count > 2000), "{found:?}");
    }
}
