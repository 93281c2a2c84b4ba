//! Bodies of flat faces: the Platonic and Archimedean solids, prisms, cones with a base, and balls
//! of triangles. Their nets fold up exactly.

use sheetwright::index::VertexIndex;
use sheetwright::math::{Point3, Vec3, cos, sin, unit};
use sheetwright::mesh::Mesh;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// A body of polygons, each counter-clockwise as seen from outside.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Its corners, mm.
    pub points: Vec<Point3>,
    /// Its faces, by corners.
    pub faces: Vec<Vec<usize>>,
}

/// The golden ratio.
const PHI: f64 = 1.618_033_988_749_895;
/// The real root of t³ = t² + t + 1.
const TRIBONACCI: f64 = 1.839_286_755_214_161;
/// The real root of ξ³ − 2ξ = φ.
const XI: f64 = 1.715_561_499_697_367_6;

impl Solid {
    /// Its triangles: faces are divided into fans.
    pub fn mesh(&self) -> Mesh {
        let fan = |face: &Vec<usize>| -> Vec<[VertexIndex; 3]> {
            let corner = |n: usize| VertexIndex::new(face[n]);
            (1..face.len() - 1).map(|n| [corner(0), corner(n), corner(n + 1)]).collect()
        };
        let triangles = self.faces.iter().flat_map(fan).collect();
        Mesh::new(self.points.clone(), triangles).expect("a solid is a mesh")
    }

    /// An OBJ file of it, with its faces whole.
    pub fn obj(&self) -> String {
        let points = self.points.iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z));
        let faces = self.faces.iter().map(|face| {
            let corners = face.iter().map(|n| format!(" {}", n + 1));
            format!("f{}\n", corners.collect::<String>())
        });
        points.chain(faces).collect()
    }

    /// The body of which these are the corners, all of whose edges are equally long and are the
    /// shortest distances between corners: so it is with the Platonic and Archimedean solids.
    fn of_corners(mut points: Vec<Point3>) -> Self {
        let size = points[0].to_vec().length();
        let near = 1e-9 * size;
        points.iter_mut().for_each(|p| *p = Point3::from_vec(p.to_vec() * (50.0 / size)));
        let near = near * 50.0 / size;
        let distance = |a: usize, b: usize| points[a].distance(points[b]);
        let count = points.len();
        let edge = (1..count).map(|n| distance(0, n)).fold(f64::INFINITY, f64::min);
        let is_edge = |a: usize, b: usize| a != b && distance(a, b) < edge + near;
        let mut faces: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for a in 0..count {
            let beside: Vec<usize> = (0..count).filter(|&b| is_edge(a, b)).collect();
            for (&b, &c) in beside.iter().flat_map(|b| beside.iter().map(move |c| (b, c))) {
                let Some(out) = unit((points[b] - points[a]).cross(points[c] - points[a])) else {
                    continue;
                };
                let height = |n: usize| (points[n] - points[a]).dot(out);
                // The plane of a face has all corners on it or behind it.
                if (0..count).any(|n| height(n) > near) {
                    continue;
                }
                let of_face: Vec<usize> = (0..count).filter(|&n| height(n) > -near).collect();
                faces.entry(of_face.clone()).or_insert_with(|| in_order(&points, &of_face, out));
            }
        }
        Self { faces: faces.into_values().collect(), points }
    }
}

/// The corners of a face in their order round `out`.
fn in_order(points: &[Point3], face: &[usize], out: Vec3) -> Vec<usize> {
    let sum: Vec3 = face.iter().map(|&n| points[n].to_vec()).sum();
    let middle = sum / face.len() as f64;
    let first = points[face[0]].to_vec() - middle;
    let angle = |n: usize| {
        let way = points[n].to_vec() - middle;
        sheetwright::math::atan2(first.cross(way).dot(out), first.dot(way))
    };
    let mut order = face.to_vec();
    order.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
    order
}

/// All points that have these coordinates with any signs and in any order, or in any that a turn of
/// them gives (`even`).
fn all(kinds: &[[f64; 3]], even: bool, sign: impl Fn(usize, bool) -> bool) -> Vec<Point3> {
    let mut points: Vec<Point3> = Vec::new();
    for &[a, b, c] in kinds {
        let turns = [[a, b, c], [b, c, a], [c, a, b]].map(|p| (p, true));
        let others = [[b, a, c], [a, c, b], [c, b, a]].map(|p| (p, false));
        let orders = turns.into_iter().chain(others.into_iter().filter(|_| !even));
        for (order, is_even) in orders {
            for bits in 0..8usize {
                let at = |n: usize| if bits >> n & 1 == 1 { -order[n] } else { order[n] };
                let point = Point3::new(at(0) + 0.0, at(1) + 0.0, at(2) + 0.0);
                let is_new = points.iter().all(|p| p.distance(point) > 1e-9);
                if is_new && sign(bits.count_ones() as usize, is_even) {
                    points.push(point);
                }
            }
        }
    }
    points
}

/// The five Platonic solids with their names, 50 mm from their middles to their corners.
pub fn platonic() -> Vec<(&'static str, Solid)> {
    let any = |_, _| true;
    let solids = [
        ("tetrahedron", all(&[[1.0, 1.0, 1.0]], true, |minus, _| minus % 2 == 0)),
        ("cube", all(&[[1.0, 1.0, 1.0]], true, any)),
        ("octahedron", all(&[[1.0, 0.0, 0.0]], true, any)),
        ("dodecahedron", all(&[[1.0, 1.0, 1.0], [0.0, 1.0 / PHI, PHI]], true, any)),
        ("icosahedron", all(&[[0.0, 1.0, PHI]], true, any)),
    ];
    solids.into_iter().map(|(name, points)| (name, Solid::of_corners(points))).collect()
}

/// The thirteen Archimedean solids with their names, 50 mm from their middles to their corners.
pub fn archimedean() -> Vec<(&'static str, Solid)> {
    let (p, root) = (PHI, std::f64::consts::SQRT_2);
    let (p2, p3) = (p * p, p * p * p);
    let t = TRIBONACCI;
    let any = |_, _| true;
    let solids = [
        ("truncated tetrahedron", all(&[[3.0, 1.0, 1.0]], true, |minus, _| minus % 2 == 0)),
        ("cuboctahedron", all(&[[1.0, 1.0, 0.0]], true, any)),
        ("truncated cube", all(&[[root - 1.0, 1.0, 1.0]], true, any)),
        ("truncated octahedron", all(&[[0.0, 1.0, 2.0]], false, any)),
        ("rhombicuboctahedron", all(&[[1.0, 1.0, 1.0 + root]], true, any)),
        ("truncated cuboctahedron", all(&[[1.0, 1.0 + root, 1.0 + 2.0 * root]], false, any)),
        ("snub cube", all(&[[1.0, 1.0 / t, t]], false, |minus, even| (minus % 2 == 1) == even)),
        ("icosidodecahedron", all(&[[0.0, 0.0, 2.0 * p], [1.0, p, p2]], true, any)),
        (
            "truncated dodecahedron",
            all(&[[0.0, 1.0 / p, 2.0 + p], [1.0 / p, p, 2.0 * p], [p, 2.0, p + 1.0]], true, any),
        ),
        ("truncated icosahedron", truncated_icosahedron()),
        (
            "rhombicosidodecahedron",
            all(&[[1.0, 1.0, p3], [p2, p, 2.0 * p], [2.0 + p, 0.0, p2]], true, any),
        ),
        (
            "truncated icosidodecahedron",
            all(
                &[
                    [1.0 / p, 1.0 / p, 3.0 + p],
                    [2.0 / p, p, 1.0 + 2.0 * p],
                    [1.0 / p, p2, 3.0 * p - 1.0],
                    [2.0 * p - 1.0, 2.0, 2.0 + p],
                    [p, 3.0, 2.0 * p],
                ],
                true,
                any,
            ),
        ),
        ("snub dodecahedron", snub_dodecahedron()),
    ];
    solids.into_iter().map(|(name, points)| (name, Solid::of_corners(points))).collect()
}

fn truncated_icosahedron() -> Vec<Point3> {
    let p = PHI;
    let kinds = [[0.0, 1.0, 3.0 * p], [1.0, 2.0 + p, 2.0 * p], [p, 2.0, 2.0 * p + 1.0]];
    all(&kinds, true, |_, _| true)
}

fn snub_dodecahedron() -> Vec<Point3> {
    let p = PHI;
    let (a, b) = (XI - 1.0 / XI, XI * p + p * p + p / XI);
    let kinds = [
        [2.0 * a, 2.0, 2.0 * b],
        [a + b / p + p, -a * p + b + 1.0 / p, a / p + b * p - 1.0],
        [-a / p + b * p + 1.0, -a + b / p - p, a * p + b - 1.0 / p],
        [-a / p + b * p - 1.0, a - b / p - p, a * p + b + 1.0 / p],
        [a + b / p - p, a * p - b + 1.0 / p, a / p + b * p + 1.0],
    ];
    all(&kinds, true, |minus, _| minus % 2 == 1)
}

/// A football: the truncated icosahedron, each panel of which is raised in its middle to the sphere
/// through its corners and so divided into triangles, 180 in all.
pub fn football() -> Solid {
    let flat = Solid::of_corners(truncated_icosahedron());
    let mut ball = Solid { points: flat.points.clone(), faces: Vec::new() };
    for face in &flat.faces {
        let sum: Vec3 = face.iter().map(|&n| flat.points[n].to_vec()).sum();
        let middle = ball.points.len();
        ball.points.push(Point3::from_vec(sum * (50.0 / sum.length())));
        let next = face.iter().cycle().skip(1);
        ball.faces.extend(face.iter().zip(next).map(|(&a, &b)| vec![middle, a, b]));
    }
    ball
}

/// A right prism over a regular polygon of so many sides, of 50 mm radius and this height, mm.
pub fn prism(sides: usize, height: f64) -> Solid {
    let ring = |z: f64| (0..sides).map(move |n| on_circle(n, sides, 50.0, z));
    let points = ring(0.0).chain(ring(height)).collect();
    let wall = |n: usize| {
        let next = (n + 1) % sides;
        vec![n, next, sides + next, sides + n]
    };
    let mut faces: Vec<Vec<usize>> = (0..sides).map(wall).collect();
    faces.push((0..sides).rev().collect());
    faces.push((sides..2 * sides).collect());
    Solid { points, faces }
}

/// A pyramid over a regular polygon of so many sides, of 50 mm radius and this height, mm: a cone
/// with its base.
pub fn closed_cone(sides: usize, height: f64) -> Solid {
    let mut points: Vec<Point3> = (0..sides).map(|n| on_circle(n, sides, 50.0, 0.0)).collect();
    points.push(Point3::new(0.0, 0.0, height));
    let mut faces: Vec<Vec<usize>> = (0..sides).map(|n| vec![n, (n + 1) % sides, sides]).collect();
    faces.push((0..sides).rev().collect());
    Solid { points, faces }
}

fn on_circle(n: usize, sides: usize, radius: f64, z: f64) -> Point3 {
    let turn = TAU * n as f64 / sides as f64;
    Point3::new(radius * cos(turn), radius * sin(turn), z)
}

/// A ball of triangles, 50 mm in radius: an icosahedron each of whose faces was divided into four
/// so many times, corners pushed out to the sphere. 80, 320 and 1,280 triangles after one, two and
/// three times.
pub fn icosphere(times: usize) -> Solid {
    let mut ball = Solid::of_corners(all(&[[0.0, 1.0, PHI]], true, |_, _| true));
    for _ in 0..times {
        let mut middles: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut faces = Vec::with_capacity(4 * ball.faces.len());
        for face in std::mem::take(&mut ball.faces) {
            let middle = [0, 1, 2].map(|k| {
                let (a, b) = (face[k], face[(k + 1) % 3]);
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    let sum = ball.points[a].to_vec() + ball.points[b].to_vec();
                    ball.points.push(Point3::from_vec(sum * (50.0 / sum.length())));
                    ball.points.len() - 1
                })
            });
            faces.extend((0..3).map(|k| vec![face[k], middle[k], middle[(k + 2) % 3]]));
            faces.push(middle.to_vec());
        }
        ball.faces = faces;
    }
    ball
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solids_have_the_faces_that_books_give() {
        let counts = |list: &[(&str, Solid)]| -> Vec<[usize; 2]> {
            list.iter().map(|(_, s)| [s.points.len(), s.faces.len()]).collect()
        };
        let wanted = [[4, 4], [8, 6], [6, 8], [20, 12], [12, 20]];
        assert_eq!(counts(&platonic()), wanted);
        let wanted = [
            [12, 8],
            [12, 14],
            [24, 14],
            [24, 14],
            [24, 26],
            [48, 26],
            [24, 38],
            [30, 32],
            [60, 32],
            [60, 32],
            [60, 62],
            [120, 62],
            [60, 92],
        ];
        assert_eq!(counts(&archimedean()), wanted);
        for (name, solid) in platonic().into_iter().chain(archimedean()) {
            let mesh = solid.mesh();
            assert!(mesh.loops().is_empty() && mesh.euler() == 2, "{name}");
        }
        let balls = [1, 2, 3].map(|times| icosphere(times).mesh().triangles().len());
        assert_eq!(balls, [80, 320, 1280]);
        assert_eq!(football().faces.len(), 180);
    }
}
