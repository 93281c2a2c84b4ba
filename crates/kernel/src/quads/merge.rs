//! Steps 1 to 4: rungs are removed, the flattest first, until every other vertex has one left.
//!
//! \[L11\] section 6: a vertex of more than three sides is a candidate, and so is a rung between
//! two of them; the heap holds the candidate rungs by their bending angle, and the one with the
//! least is removed. Two things change with each removal, and both are put right in the heap at
//! once:
//!
//! - Degrees: an end that is left with three sides is no candidate any more, nor are its rungs.
//! - Angles: the two faces at the rung become one polygon. The bending angle at a rung is the angle
//!   between the area vectors of its two faces. The area vector of a polygon in space is the sum of
//!   those of its triangles (Newell): so for triangles the angle is the crease, and a merged face
//!   has the mean direction of its triangles by area.
//!
//! Angles that agree to [`SAME_ANGLE`] tie, and the rung that is listed first is removed. We depart
//! from the paper where a strip ends in a straight side (the end of a panel between two rails):
//! such a side is a ruling already, and the rung from its corner into the strip is a diagonal. That
//! corner counts as a candidate, or the strip would begin with a triangle and a doubled vertex.

use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Vec3, angle_between};
use std::collections::BTreeSet;

/// Angles within the same multiple of this, radians, tie: on a flat surface they are rounding.
const SAME_ANGLE: f64 = 1e-9;

/// A face: its samples in order, counter-clockwise as seen from the side that the surface faces.
pub(super) type Face = Vec<usize>;

/// The result when no candidate rung is left.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Merged {
    /// The faces.
    pub(super) faces: Vec<Face>,
    /// The rungs that are left, each with its ends in increasing order, in order.
    pub(super) rungs: Vec<[usize; 2]>,
    /// The rungs that were removed, in the order of their removal.
    #[cfg_attr(not(test), allow(dead_code))]
    pub(super) removed: Vec<[usize; 2]>,
}

/// The faces of a surface while its rungs are removed.
struct Merging<'a> {
    connectivity: &'a Connectivity,
    /// The rungs of each triangle and of each sample; rungs are numbered as the hinges.
    of_triangles: Vec<Vec<usize>>,
    of_samples: Vec<Vec<usize>>,
    /// Whether a rung is still there.
    there: Vec<bool>,
    degree: Vec<usize>,
    /// The corner that a rung ends at beside a straight end of the strip.
    at_end: Vec<Option<usize>>,
    /// The face that each triangle has become part of, and the triangles of each face.
    face_of: Vec<usize>,
    triangles: Vec<Vec<usize>>,
    faces: Vec<Face>,
    areas: Vec<Vec3>,
}

/// Removes the candidate rungs of a surface. `is_corner` tells for each sample whether the boundary
/// has a corner there.
pub(super) fn merge(surface: &Surface, is_corner: &dyn Fn(usize) -> bool) -> Merged {
    let mut merging = Merging::new(surface, is_corner);
    let rungs = surface.connectivity().hinges().len();
    let mut keys: Vec<Option<u64>> = (0..rungs).map(|n| merging.key(n)).collect();
    let mut heap: BTreeSet<(u64, usize)> =
        keys.iter().enumerate().filter_map(|(n, key)| key.map(|key| (key, n))).collect();
    let mut removed = Vec::new();
    while let Some((_, rung)) = heap.pop_first() {
        keys[rung] = None;
        removed.push(merging.ends(rung));
        for n in merging.remove(rung) {
            let key = merging.key(n);
            if key != keys[n] {
                if let Some(old) = keys[n] {
                    heap.remove(&(old, n));
                }
                heap.extend(key.map(|key| (key, n)));
                keys[n] = key;
            }
        }
    }
    merging.finished(removed)
}

impl<'a> Merging<'a> {
    fn new(surface: &'a Surface, is_corner: &dyn Fn(usize) -> bool) -> Self {
        let connectivity = surface.connectivity();
        let hinges = connectivity.hinges();
        let mut of_samples = vec![Vec::new(); connectivity.samples()];
        for (n, hinge) in hinges.iter().enumerate() {
            for end in hinge.rung.ends() {
                of_samples[end.get()].push(n);
            }
        }
        let triangles = connectivity.triangles();
        let of_triangles = connectivity.hinges_of_triangles();
        let mut at_end = vec![None; hinges.len()];
        for (triangle, rungs) in triangles.iter().zip(&of_triangles) {
            if let &[rung] = &rungs[..] {
                let ends = hinges[rung].rung.ends();
                let tip = triangle.iter().find(|s| !ends.contains(s)).map_or(0, |s| s.get());
                let corners = ends.map(|end| is_corner(end.get()));
                at_end[rung] = match corners {
                    [true, false] if is_corner(tip) => Some(ends[0].get()),
                    [false, true] if is_corner(tip) => Some(ends[1].get()),
                    _ => None,
                };
            }
        }
        Self {
            connectivity,
            there: vec![true; hinges.len()],
            degree: of_samples.iter().map(|rungs| 2 + rungs.len()).collect(),
            at_end,
            face_of: (0..triangles.len()).collect(),
            triangles: (0..triangles.len()).map(|n| vec![n]).collect(),
            faces: triangles.iter().map(|t| t.map(SampleIndex::get).into()).collect(),
            areas: (0..triangles.len())
                .map(|n| surface.area_vector(TriangleIndex::new(n)))
                .collect(),
            of_triangles,
            of_samples,
        }
    }

    fn ends(&self, rung: usize) -> [usize; 2] {
        self.connectivity.hinges()[rung].rung.ends().map(SampleIndex::get)
    }

    /// The key of a rung in the heap; `None` if it is no candidate.
    fn key(&self, rung: usize) -> Option<u64> {
        let [a, b] = self.faces_at(rung);
        let is_candidate = |end: usize| self.degree[end] > 3 || self.at_end[rung] == Some(end);
        // With one face on both sides, removal would leave no polygon.
        if !self.there[rung] || a == b || !self.ends(rung).into_iter().all(is_candidate) {
            return None;
        }
        Some((angle_between(self.areas[a], self.areas[b]) / SAME_ANGLE).round() as u64)
    }

    /// The faces to the left and to the right of a rung, from its lower end to its higher one.
    fn faces_at(&self, rung: usize) -> [usize; 2] {
        self.connectivity.hinges()[rung].triangles.map(|t| self.face_of[t.get()])
    }

    /// Removes a rung. Returns the rungs whose keys may have changed.
    fn remove(&mut self, rung: usize) -> Vec<usize> {
        let [a, b] = self.faces_at(rung);
        let [low, high] = self.ends(rung);
        self.there[rung] = false;
        let polygon = joined(&self.faces[a], &self.faces[b], low, high);
        // The face of fewer triangles is merged into the other, so that no triangle changes its
        // face often.
        let (kept, gone) =
            if self.triangles[a].len() >= self.triangles[b].len() { (a, b) } else { (b, a) };
        for triangle in std::mem::take(&mut self.triangles[gone]) {
            self.face_of[triangle] = kept;
            self.triangles[kept].push(triangle);
        }
        (self.faces[kept], self.faces[gone]) = (polygon, Face::new());
        self.areas[kept] = self.areas[a] + self.areas[b];
        let of_face = self.triangles[kept].iter().flat_map(|&t| &self.of_triangles[t]);
        let mut changed: BTreeSet<usize> = of_face.copied().collect();
        for end in [low, high] {
            self.degree[end] -= 1;
            // Before, its other rungs were candidates at this end as well.
            if self.degree[end] == 3 {
                changed.extend(&self.of_samples[end]);
            }
        }
        changed.into_iter().filter(|&n| self.there[n]).collect()
    }

    fn finished(self, removed: Vec<[usize; 2]>) -> Merged {
        let left = (0..self.there.len()).filter(|&n| self.there[n]);
        Merged {
            rungs: left.map(|n| self.ends(n)).collect(),
            faces: self.faces.into_iter().filter(|face| !face.is_empty()).collect(),
            removed,
        }
    }
}

/// Two polygons merged into one, without the side from `low` to `high` of the first, along which
/// the second runs back.
fn joined(first: &Face, second: &Face, low: usize, high: usize) -> Face {
    let from = |face: &Face, start: usize, before: usize| {
        let count = face.len();
        // A polygon may touch itself at a sample, so both ends of the side are looked for.
        let at = (0..count)
            .find(|&n| face[n] == start && face[(n + count - 1) % count] == before)
            .unwrap_or(0);
        (0..count - 1).map(|n| face[(at + n) % count]).collect::<Vec<_>>()
    };
    // From the end of the side round to just before its beginning.
    let mut polygon = from(first, high, low);
    polygon.extend(from(second, low, high));
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, cos, sin};
    use sheetwright_geometry::watch::Unwatched;
    use sheetwright_optimum::triangulate::{TriangulateOptions, triangulate};

    /// A wavy ring of samples, every seventh a corner if there are any.
    fn surface(m: usize, waves: f64, corners: bool) -> (Boundary, Surface) {
        let point = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / m as f64;
            let r = 100.0 + 30.0 * cos(3.0 * angle);
            let z = 20.0 * sin(waves * angle) + 3.0 * cos(5.0 * angle + waves);
            let at = Point3::new(r * cos(angle), 2.0 * r * sin(angle), z);
            CurvePoint { at, corner: corners && i.is_multiple_of(7), move_mm: 0.0 }
        };
        let points: Vec<CurvePoint> = (0..m).map(point).collect();
        let boundary = Boundary::new(vec![samples_from_points(&points)]).unwrap();
        let options = TriangulateOptions::default();
        let found = triangulate(&boundary, None, &options, &mut Unwatched).unwrap();
        let connectivity = Connectivity::new(boundary.loops(), found.triangles).unwrap();
        let surface = Surface::new(connectivity, boundary.positions());
        (boundary, surface)
    }

    /// The rungs in the order of their removal, with all keys computed anew each time.
    fn plainly(surface: &Surface, is_corner: &dyn Fn(usize) -> bool) -> Vec<[usize; 2]> {
        let mut merging = Merging::new(surface, is_corner);
        let mut removed = Vec::new();
        loop {
            let rungs = 0..surface.connectivity().hinges().len();
            let keys = rungs.filter_map(|n| Some((merging.key(n)?, n)));
            let Some((_, rung)) = keys.min() else { return removed };
            removed.push(merging.ends(rung));
            merging.remove(rung);
        }
    }

    #[test]
    fn the_heap_stays_true() {
        for (m, waves, corners) in [(40, 2.0, false), (61, 3.0, true), (90, 4.0, false)] {
            let (boundary, surface) = surface(m, waves, corners);
            let is_corner = |i: usize| boundary.samples()[i].is_corner();
            let merged = merge(&surface, &is_corner);
            assert_eq!(merged.removed, plainly(&surface, &is_corner));
            assert!(merged.removed.len() > m / 5);
            // No rung is left between two candidates, and no sample lost its last one.
            let mut degree = vec![2; m];
            for &end in merged.rungs.iter().flatten() {
                degree[end] += 1;
            }
            for &[a, b] in &merged.rungs {
                assert!(degree[a] <= 3 || degree[b] <= 3);
            }
            assert_eq!(merged.rungs.len() + 1, merged.faces.len());
        }
    }

    #[test]
    fn merged_faces_have_the_area_vectors_of_their_polygons() {
        let (boundary, surface) = surface(50, 3.0, false);
        let mut merging = Merging::new(&surface, &|_| false);
        for n in 0..surface.connectivity().hinges().len() {
            if merging.key(n).is_some() {
                merging.remove(n);
            }
        }
        for (face, area) in merging.faces.iter().zip(&merging.areas).filter(|(f, _)| !f.is_empty())
        {
            let at = |i: usize| boundary.samples()[i].position - Point3::default();
            let ring = (0..face.len()).map(|n| (face[n], face[(n + 1) % face.len()]));
            let newell: Vec3 = ring.map(|(i, j)| at(i).cross(at(j)) * 0.5).sum();
            assert!((newell - *area).length() < 1e-8, "{newell} {area}");
        }
    }
}
