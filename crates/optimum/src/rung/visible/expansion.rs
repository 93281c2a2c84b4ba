//! Visibility between samples inside a projection: triangular expansion \[Bungiu2014\], with exact
//! predicates.
//!
//! 1. The domain between the projected loops is cut into triangles (a constrained Delaunay
//!    triangulation, crate `spade`); which triangles does not matter.
//! 2. A sample sees its own triangles. Through the side opposite to it, it looks into the next
//!    triangle, within the window between that side's ends.
//! 3. The far corner of that triangle is seen if it lies strictly inside the window; it splits the
//!    window in two. Otherwise the window passes on one side of it, unchanged.
//! 4. A boundary edge ends the view.
//!
//! Without holes the triangles form a tree, so a sample meets each at most once: O(m) for each
//! sample, O(m²) for all. Beyond a side lies the part of the loop between its ends; a part with
//! lower samples only is skipped, since those have been paired from their side. Round h holes a
//! sample may meet a triangle from h + 1 sides. A rung that touches the boundary between its ends
//! is not inside.

use super::pairs::PairSet;
use sheetwright_geometry::math::Point2;
use sheetwright_geometry::predicate::orientation;
use spade::{ConstrainedDelaunayTriangulation, Triangulation};
use std::cmp::Ordering;
use std::ops::Range;

/// The pairs that see one another inside polygons that do not touch, the outer one running
/// counter-clockwise and the holes clockwise, neighbours included.
pub(super) fn inside_pairs(points: &[Point2], loops: &[Range<usize>]) -> PairSet {
    let view = Triangles::between(points, loops);
    let mut pairs = PairSet::new(points.len());
    let is_one_loop = loops.len() == 1;
    for source in 0..points.len() {
        // Counter-clockwise, what lies beyond a side runs from its right end to its left one.
        let is_worth = |right: usize, left: usize| !is_one_loop || left < right || left > source;
        view.look_from(source, points, is_worth, &mut |seen| pairs.insert(source, seen));
    }
    pairs
}

/// A triangulation of the domain, for the expansion.
struct Triangles {
    /// Corners of each triangle, counter-clockwise.
    corners: Vec<[usize; 3]>,
    /// The triangle beyond the side opposite to each corner.
    beyond: Vec<[Option<usize>; 3]>,
    /// The triangles at each sample.
    around: Vec<Vec<usize>>,
}

impl Triangles {
    fn between(points: &[Point2], loops: &[Range<usize>]) -> Self {
        // Coordinates too small for the crate only choose other triangles.
        let vertex = |p: &Point2| spade::mitigate_underflow(spade::Point2::new(p.x, p.y));
        let edges: Vec<[usize; 2]> = loops
            .iter()
            .flat_map(|l| l.clone().map(|i| [i, if i + 1 == l.end { l.start } else { i + 1 }]))
            .collect();
        let vertices = points.iter().map(vertex).collect();
        let none = Self { corners: vec![], beyond: vec![], around: vec![vec![]; points.len()] };
        // A set of loops that is no domain has no visible pairs; a validated boundary is one.
        let Ok(all) = ConstrainedDelaunayTriangulation::<spade::Point2<f64>>::try_bulk_load_cdt(
            vertices,
            edges.clone(),
            |_| {},
        ) else {
            return none;
        };
        if all.num_vertices() != points.len() {
            return none;
        }
        // The domain lies to the left of every edge of the boundary; from there it is flooded.
        let mut number = vec![None; all.num_all_faces()];
        let mut found = Vec::new();
        let mut reached: Vec<_> = edges
            .iter()
            .filter_map(|&[a, b]| {
                let handle = spade::handles::FixedVertexHandle::from_index;
                all.get_edge_from_neighbors(handle(a), handle(b))
            })
            .filter_map(|edge| edge.face().as_inner())
            .collect();
        while let Some(face) = reached.pop() {
            let place = &mut number[face.fix().index()];
            if place.is_some() {
                continue;
            }
            *place = Some(found.len());
            found.push(face);
            let inner = face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge());
            reached.extend(inner.filter_map(|edge| edge.rev().face().as_inner()));
        }
        let corners: Vec<[usize; 3]> =
            found.iter().map(|face| face.vertices().map(|v| v.fix().index())).collect();
        let beyond = found
            .iter()
            .zip(&corners)
            .map(|(face, corners)| {
                let mut beyond = [None; 3];
                for edge in face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge()) {
                    let ends = edge.vertices().map(|v| v.fix().index());
                    if let Some(n) = corners.iter().position(|c| !ends.contains(c)) {
                        beyond[n] = number[edge.rev().face().fix().index()];
                    }
                }
                beyond
            })
            .collect();
        let mut around = vec![Vec::new(); points.len()];
        for (t, corners) in corners.iter().enumerate() {
            for &corner in corners {
                around[corner].push(t);
            }
        }
        Self { corners, beyond, around }
    }

    /// Calls `see` for the samples that one sample sees. Parts beyond a side, given by its right
    /// and its left end, are skipped unless the side is worth it.
    fn look_from(
        &self,
        source: usize,
        polygon: &[Point2],
        is_worth: impl Fn(usize, usize) -> bool,
        see: &mut impl FnMut(usize),
    ) {
        let eye = polygon[source];
        // (triangle to look into, side it is entered by, right and left end of the window)
        let mut views: Vec<(usize, [usize; 2], usize, usize)> = Vec::new();
        for &t in &self.around[source] {
            let n = self.corners[t].iter().position(|&c| c == source).unwrap_or(0);
            let (right, left) = (self.corners[t][(n + 1) % 3], self.corners[t][(n + 2) % 3]);
            see(right);
            see(left);
            if let Some(u) = self.beyond[t][n].filter(|_| is_worth(right, left)) {
                views.push((u, [right, left], right, left));
            }
        }
        while let Some((t, [side_right, side_left], right, left)) = views.pop() {
            let entered = |c: &usize| *c != side_right && *c != side_left;
            let Some(n) = self.corners[t].iter().position(entered) else { continue };
            let far = self.corners[t][n];
            let from_right = orientation(eye, polygon[right], polygon[far]);
            let from_left = orientation(eye, polygon[far], polygon[left]);
            let opposite = |corner: usize| {
                let k = self.corners[t].iter().position(|&c| c == corner).unwrap_or(0);
                self.beyond[t][k]
            };
            if from_right == Ordering::Greater && from_left == Ordering::Greater {
                see(far);
            }
            // Through the side from the right end to the far corner, which is opposite to the
            // left end: seen if the far corner lies to the left of the window's right edge.
            if from_right == Ordering::Greater
                && is_worth(side_right, far)
                && let Some(u) = opposite(side_left)
            {
                let new_left = if from_left == Ordering::Greater { far } else { left };
                views.push((u, [side_right, far], right, new_left));
            }
            if from_left == Ordering::Greater
                && is_worth(far, side_left)
                && let Some(u) = opposite(side_right)
            {
                let new_right = if from_right == Ordering::Greater { far } else { right };
                views.push((u, [far, side_left], new_right, left));
            }
        }
    }
}
