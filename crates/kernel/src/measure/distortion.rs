//! How true a mesh is once it lies flat, and where a cut would help.

use crate::flatten::triangle_stretches;
use crate::mesh::{Mesh, Ways, angle_defects};
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::Point2;
use std::f64::consts::TAU;

/// A hole whose border turns by this share of a full turn more or less than that of a hole in a
/// plane does not lie flat unless it is cut open: a tube's does not turn at all.
const HOLE_TURN: f64 = 0.05;

/// How far a mesh is from lying flat without stretching.
#[derive(Clone, Debug, PartialEq)]
pub struct Distortion {
    /// The relative length error of every side, (flat − space) / space, signed, in the order of
    /// [`Mesh::edges`]: positive where the pattern is longer.
    pub length_errors: Vec<f64>,
    /// The largest size of these.
    pub length_error_max: f64,
    /// Their mean size, with equal weights.
    pub length_error_mean: f64,
    /// Their mean size, each side weighted by the area of its triangles in space.
    pub length_error_mean_by_area: f64,
    /// The largest size of the errors of border edges.
    pub border_error_max: f64,
    /// The largest and the smallest stretch of every triangle, flat by space: 1 and 1 where its
    /// lengths are true, the smallest negative where it is turned over.
    pub stretches: Vec<[f64; 2]>,
    /// The largest of all stretches.
    pub stretch_max: f64,
    /// The smallest of all stretches.
    pub stretch_min: f64,
}

impl Distortion {
    /// The side with the largest length error, by its number among those of the sheet, the first of
    /// equals.
    pub fn worst_edge(&self) -> Option<usize> {
        let size = |n: usize| self.length_errors[n].abs();
        (0..self.length_errors.len()).reduce(|best, n| if size(n) > size(best) { n } else { best })
    }

    /// By how much the sheet must stretch, and by how much it must shrink, where that is most, to
    /// come from the pattern to the shape of its triangles. Shares; infinite where a triangle is
    /// turned over.
    pub fn to_shape(&self) -> [f64; 2] {
        [stretched(self.stretch_min), (1.0 - 1.0 / self.stretch_max).max(0.0)]
    }

    /// The larger of both that 95 % of the area of the mesh stays below.
    pub fn strain_p95(&self, mesh: &Mesh) -> f64 {
        let of = |&[most, least]: &[f64; 2]| stretched(least).max(1.0 - 1.0 / most);
        let mut strains: Vec<(f64, usize)> =
            self.stretches.iter().map(of).enumerate().map(|(n, s)| (s, n)).collect();
        strains.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let area = |n: usize| mesh.area_vector(TriangleIndex::new(n)).length();
        let wanted = 0.95 * (0..strains.len()).map(area).sum::<f64>();
        let mut below = 0.0;
        let found = strains.iter().find(|(_, n)| {
            below += area(*n);
            below >= wanted
        });
        found.or(strains.last()).map_or(0.0, |(strain, _)| *strain)
    }

    /// The strain of a triangle: by which share it is stretched or squeezed where that is most.
    pub fn strain(&self, triangle: TriangleIndex) -> f64 {
        let [most, least] = self.stretches[triangle.get()];
        (most - 1.0).max(1.0 - least)
    }
}

/// By how much a direction must stretch that is so many times as long on the pattern, a share.
fn stretched(least: f64) -> f64 {
    if least > 0.0 { (1.0 / least - 1.0).max(0.0) } else { f64::INFINITY }
}

/// The distortion of a mesh whose vertices lie at these points of the plane.
///
/// # Panics
/// Unless there is one point a vertex.
pub fn distortion(mesh: &Mesh, points: &[Point2]) -> Distortion {
    assert_eq!(mesh.positions().len(), points.len(), "one point a vertex");
    let lengths = mesh.lengths();
    let length_errors: Vec<f64> = mesh
        .edges()
        .iter()
        .zip(&lengths)
        .map(|(edge, space)| {
            let [a, b] = edge.ends.map(|v| points[v.get()]);
            (a.distance(b) - space) / space
        })
        .collect();
    let mut area_of = vec![0.0; lengths.len()];
    let mut stretches = Vec::with_capacity(mesh.triangles().len());
    for (n, corners) in mesh.triangles().iter().enumerate() {
        let triangle = TriangleIndex::new(n);
        let edges = mesh.topology().edges_of(triangle);
        let flat = corners.map(|v| points[v.get()]);
        let area = mesh.area_vector(triangle).length();
        for edge in edges {
            area_of[edge] += area;
        }
        stretches
            .push(triangle_stretches(edges.map(|edge| lengths[edge]), flat).unwrap_or([1.0, 1.0]));
    }
    let sizes = || length_errors.iter().map(|r| r.abs());
    let weighed: f64 = sizes().zip(&area_of).map(|(r, area)| r * area).sum();
    let border = mesh.edges().iter().zip(sizes()).filter(|(edge, _)| edge.is_border());
    Distortion {
        length_error_max: sizes().fold(0.0, f64::max),
        length_error_mean: sizes().sum::<f64>() / length_errors.len() as f64,
        length_error_mean_by_area: weighed / area_of.iter().sum::<f64>(),
        border_error_max: border.fold(0.0, |most, (_, r)| most.max(r)),
        stretch_max: stretches.iter().fold(0.0, |most, s| s[0].max(most)),
        stretch_min: stretches.iter().fold(f64::INFINITY, |least, s| s[1].min(least)),
        stretches,
        length_errors,
    }
}

/// Where a cut would let a sheet lie that stretches or is squeezed by too much.
#[derive(Clone, Debug, PartialEq)]
pub struct CutSuggestion {
    /// The triangle of the largest strain.
    pub worst: TriangleIndex,
    /// Its strain, without unit.
    pub strain: f64,
    /// How many triangles are strained by more than the limit.
    pub triangles: usize,
    /// The vertices of the cut, joined by sides; the last lies on the border, and so does the first
    /// where the cut joins two loops of it.
    pub path: Vec<VertexIndex>,
}

/// The cut that is suggested where triangles are strained by more than `limit` (a share, as
/// [`crate::material::stretch_limit`] tells): from a hole that cannot lie flat to the nearest other
/// loop; or else, of the strained triangles that hang together with the worst, from the vertex that
/// lies deepest inside to the border, along the shortest way. `None` where the sheet takes all.
pub fn cut_suggestion(mesh: &Mesh, distortion: &Distortion, limit: f64) -> Option<CutSuggestion> {
    let strain = |n: usize| distortion.strain(TriangleIndex::new(n));
    let count = mesh.triangles().len();
    let worst = (0..count).reduce(|a, b| if strain(b) > strain(a) { b } else { a })?;
    if strain(worst) <= limit {
        return None;
    }
    let path = match hole_to_open(mesh) {
        Some(hole) => {
            let others = (0..mesh.loops().len()).filter(|&n| n != hole);
            let ends: Vec<VertexIndex> =
                others.flat_map(|n| mesh.loops()[n].iter().copied()).collect();
            let ways = Ways::from(mesh, &ends, |_| false);
            ways.vertices_back(mesh, nearest(&ways, mesh.loops()[hole].iter().copied())?)
        }
        None => {
            let border: Vec<VertexIndex> = mesh.loops().iter().flatten().copied().collect();
            let ways = Ways::from(mesh, &border, |_| false);
            let region = region(mesh, worst, |n| strain(n) > limit);
            let within = region.into_iter().flat_map(|n| mesh.triangles()[n]);
            let mut inside = deepest(&ways, within)?;
            if ways.length[inside.get()] == 0.0 {
                inside = deepest(&ways, (0..mesh.positions().len()).map(VertexIndex::new))?;
            }
            ways.vertices_back(mesh, inside)
        }
    };
    Some(CutSuggestion {
        worst: TriangleIndex::new(worst),
        strain: strain(worst),
        triangles: (0..count).filter(|&n| strain(n) > limit).count(),
        path,
    })
}

/// The hole, of those of one piece, whose turn is farthest from that of a hole in a plane, if it is
/// far.
fn hole_to_open(mesh: &Mesh) -> Option<usize> {
    let defects = angle_defects(mesh);
    let off = |n: &usize| {
        let turn: f64 = mesh.loops()[*n].iter().map(|v| defects[v.get()]).sum();
        (turn + TAU).abs()
    };
    let worst = (1..mesh.loops().len()).reduce(|a, b| if off(&b) > off(&a) { b } else { a });
    worst.filter(|n| off(n) > HOLE_TURN * TAU)
}

/// The triangles that hang together with one and are chosen as it is.
fn region(mesh: &Mesh, from: usize, chosen: impl Fn(usize) -> bool) -> Vec<usize> {
    let mut seen = vec![false; mesh.triangles().len()];
    seen[from] = true;
    let mut found = vec![from];
    let mut at = 0;
    while at < found.len() {
        let edges = mesh.topology().edges_of(TriangleIndex::new(found[at]));
        at += 1;
        for there in edges.into_iter().flat_map(|edge| mesh.edges()[edge].triangles).flatten() {
            let there = there.get();
            if !seen[there] && chosen(there) {
                seen[there] = true;
                found.push(there);
            }
        }
    }
    found
}

/// The vertex of some with the shortest way, of equals the lowest.
fn nearest(ways: &Ways, of: impl Iterator<Item = VertexIndex>) -> Option<VertexIndex> {
    of.min_by(|a, b| ways.length[a.get()].total_cmp(&ways.length[b.get()]).then(a.cmp(b)))
}

/// The vertex of some with the longest way, of those with any.
fn deepest(ways: &Ways, of: impl Iterator<Item = VertexIndex>) -> Option<VertexIndex> {
    of.filter(|v| ways.length[v.get()].is_finite())
        .max_by(|a, b| ways.length[a.get()].total_cmp(&ways.length[b.get()]).then(b.cmp(a)))
}
