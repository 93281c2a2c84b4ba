//! Which triangles of a mesh are one flat face.
//!
//! From the largest triangle that is left, a face spreads over its neighbours as long as one plane
//! passes within the rounding of the file (`mesh/rounding`) of all its points. The plane stands
//! square to the sum of the area vectors, which is that of the border alone and so hardly feels how
//! points inside, or narrow triangles, are rounded; it passes midway between the points on its two
//! sides.

use crate::mesh::{Cut, Mesh, Rounding};
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Vec3, unit};
use std::collections::VecDeque;

/// Number of points up to which the plane is laid anew for each triangle; from there on, it is
/// whenever there are an eighth more of them.
const FEW: usize = 64;
/// Cosine of 15°, the most by which a triangle of a face turns from its plane. A narrow one may
/// turn further by rounding; but so do grooves and chamfers of a step of the file, which are meant.
const LEAST_COSINE: f64 = 0.965_925_826;
/// Most rounds in which triangles that did not fit are tried again, once the face has grown.
const TRIALS: usize = 3;

/// The number of the face of every triangle; no face lies on both sides of a seam.
pub(super) fn face_of_triangles(mesh: &Mesh, seams: &Cut, rounding: &Rounding) -> Vec<usize> {
    let count = mesh.triangles().len();
    let areas: Vec<Vec3> = (0..count).map(|n| mesh.area_vector(TriangleIndex::new(n))).collect();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| areas[b].length().total_cmp(&areas[a].length()).then(a.cmp(&b)));
    let mut of = vec![usize::MAX; count];
    let mut last_face = vec![usize::MAX; mesh.positions().len()];
    let mut faces = 0;
    for seed in order {
        if of[seed] != usize::MAX {
            continue;
        }
        of[seed] = faces;
        let mut face = Face::new(mesh, rounding, &areas, seed);
        mesh.triangles()[seed].iter().for_each(|v| last_face[v.get()] = faces);
        let mut waiting = VecDeque::from([seed]);
        let mut refused = Vec::new();
        for _ in 0..TRIALS {
            while let Some(here) = waiting.pop_front() {
                let sides = mesh.topology().edges_of(TriangleIndex::new(here));
                let open = sides.iter().filter(|n| !seams.contains(n));
                let across = open.flat_map(|&n| mesh.edges()[n].triangles);
                for there in across.flatten().map(|t| t.get()) {
                    if of[there] != usize::MAX {
                        continue;
                    }
                    let corners = mesh.triangles()[there];
                    let new = corners.into_iter().filter(|v| last_face[v.get()] != faces);
                    let new: Vec<VertexIndex> = new.collect();
                    if face.take(there, &new) {
                        of[there] = faces;
                        new.iter().for_each(|v| last_face[v.get()] = faces);
                        waiting.push_back(there);
                    } else {
                        refused.push((here, face.vertices.len()));
                    }
                }
            }
            // Only where the plane has more points by now.
            let grown = face.vertices.len();
            waiting.extend(refused.drain(..).filter(|r| r.1 < grown).map(|r| r.0));
        }
        faces += 1;
    }
    of
}

/// A face that grows.
struct Face<'a> {
    mesh: &'a Mesh,
    rounding: &'a Rounding,
    areas: &'a [Vec3],
    vertices: Vec<VertexIndex>,
    /// The sum of its area vectors, mm².
    area: Vec3,
    plane: Plane,
    /// At so many points, the plane is laid anew.
    next: usize,
}

/// A plane by its unit normal, and how far points lie along that at least and at most, mm.
#[derive(Clone, Copy)]
struct Plane {
    normal: Vec3,
    low: f64,
    high: f64,
}

impl<'a> Face<'a> {
    fn new(mesh: &'a Mesh, rounding: &'a Rounding, areas: &'a [Vec3], seed: usize) -> Self {
        let area = areas[seed];
        let vertices = mesh.triangles()[seed].to_vec();
        let normal = unit(area).unwrap_or(Vec3::ZERO);
        let none = Plane { normal, low: f64::INFINITY, high: f64::NEG_INFINITY };
        let mut face = Self { mesh, rounding, areas, vertices, area, plane: none, next: FEW };
        face.plane = face.with(none, &face.vertices);
        face
    }

    /// A plane with more points.
    fn with(&self, plane: Plane, more: &[VertexIndex]) -> Plane {
        let height = |v: &VertexIndex| self.mesh.position(*v).to_vec().dot(plane.normal);
        more.iter().map(height).fold(plane, |plane, height| Plane {
            low: plane.low.min(height),
            high: plane.high.max(height),
            ..plane
        })
    }

    /// Whether all points lie in a plane within what rounding explains at a triangle.
    fn is_flat(&self, plane: Plane, triangle: usize) -> bool {
        let [a, b, c] = self.mesh.triangles()[triangle].map(|v| self.mesh.position(v));
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let height_mm = 2.0 * self.areas[triangle].length() / longest;
        0.5 * (plane.high - plane.low) <= self.rounding.off_plane_mm(plane.normal, height_mm)
    }

    /// Whether a triangle, which has these vertices beside those of the face, is of the face; if
    /// so, the face has it from now on.
    fn take(&mut self, triangle: usize, new: &[VertexIndex]) -> bool {
        let area = self.areas[triangle];
        if area.dot(self.plane.normal) < LEAST_COSINE * area.length() {
            return false;
        }
        let plane = if self.vertices.len() <= FEW {
            let Some(normal) = unit(self.area + area) else { return false };
            self.laid_anew(normal, new)
        } else {
            self.with(self.plane, new)
        };
        if !self.is_flat(plane, triangle) {
            return false;
        }
        self.plane = plane;
        self.area += area;
        self.vertices.extend(new);
        if self.vertices.len() > FEW && self.vertices.len() >= self.next {
            self.next = self.vertices.len() + self.vertices.len() / 8;
            let anew = unit(self.area).map(|normal| self.laid_anew(normal, &[]));
            if let Some(plane) = anew.filter(|&plane| self.is_flat(plane, triangle)) {
                self.plane = plane;
            }
        }
        true
    }

    /// The plane of this normal with all points of the face, and more.
    fn laid_anew(&self, normal: Vec3, more: &[VertexIndex]) -> Plane {
        let none = Plane { normal, low: f64::INFINITY, high: f64::NEG_INFINITY };
        self.with(self.with(none, &self.vertices), more)
    }
}
