//! Exact unfolding of a mesh that lies flat without stretching: triangle is laid beside triangle.
//!
//! Unlike a surface that was found, such a mesh may have interior vertices, round which the angles
//! make a full turn, and holes. From the triangle in the middle of the mesh, counted in sides, its
//! neighbours are laid, and so on outwards; a vertex stays where it is laid first. Where angles do
//! not make a full turn, lengths differ by what is missing: measures show it.

use super::pose::posed;
use super::relax::overlap;
use super::unroll::beside;
use super::{FlattenError, Flattened};
use crate::mesh::Mesh;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::Point2;
use std::collections::VecDeque;

/// Lays a mesh of one piece flat, whose lengths can all be kept.
///
/// # Errors
/// [`FlattenError::Pieces`] and [`FlattenError::NoTriangle`].
pub fn unfold(mesh: &Mesh) -> Result<Flattened, FlattenError> {
    let mut points: Vec<Option<Point2>> = vec![None; mesh.positions().len()];
    let length = |a: VertexIndex, b: VertexIndex| mesh.position(a).distance(mesh.position(b));
    for (triangle, entered_by) in order(mesh, middle(mesh)) {
        let corners = mesh.triangles()[triangle];
        // Turned so that the side that is already laid comes first.
        let k = entered_by.unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|n| corners[(k + n) % 3]);
        if entered_by.is_none() {
            points[a.get()] = Some(Point2::default());
            points[b.get()] = Some(Point2::new(length(a, b), 0.0));
        }
        let (Some(at_a), Some(at_b)) = (points[a.get()], points[b.get()]) else {
            return Err(FlattenError::Pieces);
        };
        if points[c.get()].is_none() {
            let laid = beside(at_a, at_b, length(a, b), length(a, c), length(b, c));
            let triangle = TriangleIndex::new(triangle);
            points[c.get()] = Some(laid.ok_or(FlattenError::NoTriangle { triangle })?);
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
