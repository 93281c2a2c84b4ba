//! Unfolding of a mesh of flat faces, as the pieces of nets are: face is laid beside face.
//!
//! Each face is laid in its plane first (`face`). From the one in the middle of the mesh, counted
//! in sides of triangles, its neighbours are laid, and so on outwards; a vertex stays where it is
//! laid first, and a face is laid as near as can be to those of its vertices that are there
//! already. Where faces are flat but for rounding, lengths differ by that: measures show it.

use super::face::laid_face;
use super::motion::Motion;
use super::pose::posed;
use super::relax::overlap;
use super::{FlattenError, Flattened};
use crate::mesh::Mesh;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::Point2;
use std::collections::{BTreeMap, VecDeque};

/// Lays a mesh of one piece flat, each of whose triangles is of the flat face of that number; ways
/// round vertices and holes have to close.
///
/// # Errors
/// [`FlattenError::Pieces`].
pub fn unfold(mesh: &Mesh, faces: &[usize]) -> Result<Flattened, FlattenError> {
    let mut triangles: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (n, &face) in faces.iter().enumerate() {
        triangles.entry(face).or_default().push(n);
    }
    let mut points: Vec<Option<Point2>> = vec![None; mesh.positions().len()];
    for (triangle, _) in order(mesh, middle(mesh)) {
        // None is left of a face that is laid.
        let Some(face) = faces.get(triangle).and_then(|face| triangles.remove(face)) else {
            continue;
        };
        let face = laid_face(mesh, &face, faces);
        let known = face.vertices.iter().zip(&face.points);
        let known = known.filter_map(|(v, &p)| Some([p, points[v.get()]?]));
        let motion = Motion::laying(&known.collect::<Vec<_>>());
        for (v, &p) in face.vertices.iter().zip(&face.points) {
            points[v.get()].get_or_insert(motion.moved(p));
        }
    }
    let points: Option<Vec<Point2>> = points.into_iter().collect();
    let points = posed(&points.ok_or(FlattenError::Pieces)?, &(0..mesh.positions().len()));
    Ok(Flattened { overlap: overlap(mesh.topology(), &points), points })
}

/// A triangle in the middle of the longest way through a mesh, nearly: rounding then travels half
/// as far.
fn middle(mesh: &Mesh) -> usize {
    let last = |from: usize| order(mesh, from).last().map_or(from, |&(triangle, _)| triangle);
    let end = last(last(0));
    let mut ways = vec![0usize; mesh.triangles().len()];
    for (n, &(triangle, side)) in order(mesh, end).iter().enumerate() {
        if let (Some(side), true) = (side, n > 0) {
            ways[triangle] = 1 + across(mesh, triangle, side).map_or(0, |before| ways[before]);
        }
    }
    let longest = ways.iter().copied().max().unwrap_or(0);
    ways.iter().position(|&way| way == longest / 2).unwrap_or(0)
}

/// The triangle across a side, which begins at a corner of that place.
fn across(mesh: &Mesh, triangle: usize, side: usize) -> Option<usize> {
    let n = mesh.topology().edges_of(TriangleIndex::new(triangle))[side];
    let both = mesh.edges()[n].triangles.into_iter().flatten().map(|t| t.get());
    both.into_iter().find(|&other| other != triangle)
}

/// The triangles outwards from one, each with the side by which it is entered.
fn order(mesh: &Mesh, start: usize) -> Vec<(usize, Option<usize>)> {
    let mut reached = vec![false; mesh.triangles().len()];
    reached[start] = true;
    let mut order = Vec::with_capacity(reached.len());
    let mut waiting = VecDeque::from([(start, None)]);
    while let Some((triangle, entered)) = waiting.pop_front() {
        order.push((triangle, entered));
        for side in 0..3 {
            let Some(other) = across(mesh, triangle, side).filter(|&other| !reached[other]) else {
                continue;
            };
            reached[other] = true;
            let shared = mesh.topology().edges_of(TriangleIndex::new(triangle))[side];
            let sides = mesh.topology().edges_of(TriangleIndex::new(other));
            waiting.push_back((other, sides.iter().position(|&n| n == shared)));
        }
    }
    order
}
