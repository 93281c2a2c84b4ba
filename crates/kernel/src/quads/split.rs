//! Divides larger polygons into quads.
//!
//! A polygon of 2k corners becomes k − 1 quads; one with an odd number of corners has a triangle
//! besides. Dynamic programming over all part polygons, as for a triangulation, finds the
//! diagonals: the corners of the quads, all four, turn least from the planes of the quads, so that
//! flat and convex ones win. (\[L11\] uses a general method for plane polygons; ours have six or
//! eight corners, so that the optimum can be computed.)

use super::{QuadMesh, Vertex};
use sheetwright_geometry::math::{Vec3, unit};
use std::ops::Range;

/// Polygons with more corners are halved first: the time of the table grows with the fourth power.
const MOST_CORNERS: usize = 40;

/// Fills in the faces of all cells.
pub(super) fn split(mesh: &mut QuadMesh) {
    for cell in &mut mesh.cells {
        cell.faces = faces_of(&mesh.vertices, &cell.corners);
    }
}

fn faces_of(vertices: &[Vertex], corners: &[usize]) -> Vec<Vec<usize>> {
    let count = corners.len();
    if count <= 4 {
        return vec![corners.to_vec()];
    }
    if count > MOST_CORNERS {
        // Along a diagonal that leaves an even number on one side.
        let half = (count / 2) | 1;
        let mut rest = corners[half..].to_vec();
        rest.push(corners[0]);
        let mut faces = faces_of(vertices, &corners[..=half]);
        faces.extend(faces_of(vertices, &rest));
        return faces;
    }
    let mut table = SplitTable { vertices, corners, best: vec![(0.0, None); count * count] };
    for length in 2..count {
        for i in 0..count - length {
            table.fill(i, i + length);
        }
    }
    let mut faces = Vec::new();
    table.collect(0..count - 1, &mut faces);
    faces
}

/// The cheapest division of every part polygon i, i + 1 … j, with the further corners of the face
/// at the side from i to j; none for two neighbours.
struct SplitTable<'a> {
    vertices: &'a [Vertex],
    corners: &'a [usize],
    best: Vec<(f64, Option<[usize; 2]>)>,
}

impl SplitTable<'_> {
    fn cost(&self, i: usize, j: usize) -> f64 {
        self.best[i * self.corners.len() + j].0
    }

    fn fill(&mut self, i: usize, j: usize) {
        let mut best: (f64, Option<[usize; 2]>) = (f64::INFINITY, None);
        let mut offer = |cost: f64, between: [usize; 2]| {
            if cost < best.0 {
                best = (cost, Some(between));
            }
        };
        let is_odd = (j - i).is_multiple_of(2);
        for a in i + 1..j {
            for b in a + 1..j {
                // A part with an odd number of corners has the only triangle.
                let is_part_odd = [(i, a), (a, b), (b, j)].map(|(p, q)| (q - p).is_multiple_of(2));
                if is_part_odd.into_iter().filter(|&odd| odd).count() == usize::from(is_odd) {
                    let parts = self.cost(i, a) + self.cost(a, b) + self.cost(b, j);
                    offer(parts + self.turned([i, a, b, j]), [a, b]);
                }
            }
            if is_odd && (a - i) % 2 == 1 {
                offer(self.cost(i, a) + self.cost(a, j), [a, a]);
            }
        }
        self.best[i * self.corners.len() + j] = best;
    }

    /// How far the corners of a quad turn from its plane, summed: 1 − the cosine each.
    fn turned(&self, quad: [usize; 4]) -> f64 {
        let at = quad.map(|n| self.vertices[self.corners[n]].position);
        let plane = (at[2] - at[0]).cross(at[3] - at[1]);
        let Some(plane) = unit(plane) else { return 8.0 };
        let corner =
            |n: usize| -> Vec3 { (at[(n + 1) % 4] - at[n]).cross(at[(n + 3) % 4] - at[n]) };
        (0..4).map(|n| unit(corner(n)).map_or(1.0, |normal| 1.0 - normal.dot(plane))).sum()
    }

    fn collect(&self, range: Range<usize>, faces: &mut Vec<Vec<usize>>) {
        let (i, j) = (range.start, range.end);
        let Some([a, b]) = self.best[i * self.corners.len() + j].1 else { return };
        let mut face = vec![i, a, b, j];
        face.dedup();
        faces.push(face.into_iter().map(|n| self.corners[n]).collect());
        for (from, to) in [(i, a), (a, b), (b, j)] {
            if to > from + 1 {
                self.collect(from..to, faces);
            }
        }
    }
}
