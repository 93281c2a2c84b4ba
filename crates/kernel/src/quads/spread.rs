//! Step 5: a vertex for every rung.
//!
//! A sample v with k = deg(v) − 2 rungs becomes k vertices along the outline about v, in the order
//! of the rungs round v, each with one of the rungs. They lie within half the distance to the
//! samples beside v, a k-th of the edge from one another, as evenly as the samples: they represent
//! a stretch of boundary whose rulings all ended at v. At a corner one copy stays, the middle one.

use super::merge::{Face, Merged};
use super::{Cell, QuadMesh, Vertex};
use sheetwright_geometry::boundary::{Boundary, Outline, Side};
use std::collections::BTreeMap;

/// The mesh of the cells between the rungs; the cells are not split yet.
pub(super) fn spread(merged: &Merged, boundary: &Boundary, outline: &Outline) -> QuadMesh {
    let rungs_at = rungs_in_order(merged, boundary);
    let (mut vertices, mut loops) = (Vec::new(), Vec::new());
    // The vertex of each sample that has no rung, and of each end of a rung.
    let mut without = vec![None; boundary.len()];
    let mut of_end = BTreeMap::new();
    for (of_loop, range) in boundary.loops().iter().enumerate() {
        let first = vertices.len();
        for v in range.clone() {
            let is_corner = boundary.samples()[v].is_corner();
            let count = rungs_at[v].len().max(1);
            let last = count - 1;
            let middle = if is_corner { (last / 2) as f64 } else { 0.5 * last as f64 };
            if rungs_at[v].is_empty() {
                without[v] = Some(vertices.len());
            }
            for n in 0..count {
                if let Some(&other) = rungs_at[v].get(n) {
                    of_end.insert((v, other), vertices.len());
                }
                let step = n as f64 - middle;
                let edge = if step < 0.0 { boundary.previous(v) } else { v };
                let away = step * edge_length(boundary, outline, edge) / count as f64;
                let along_mm = outline.of_sample(v) + away;
                // Exactly the position of the sample, if it is the sample.
                let position = if step == 0.0 {
                    boundary.samples()[v].position
                } else {
                    outline.at(of_loop, along_mm, Side::Leaving).position
                };
                let is_corner = is_corner && step == 0.0;
                vertices.push(Vertex { of_loop, along_mm, is_corner, position });
            }
        }
        loops.push(first..vertices.len());
    }
    let cells = merged.faces.iter().map(|face| {
        let corners = vertices_of(face, boundary, &without, &of_end);
        Cell { corners, faces: Vec::new() }
    });
    let cells = cells.collect();
    let mut rungs: Vec<[usize; 2]> = merged
        .rungs
        .iter()
        .map(|&[a, b]| {
            let ends = [of_end[&(a, b)], of_end[&(b, a)]];
            [ends[0].min(ends[1]), ends[0].max(ends[1])]
        })
        .collect();
    rungs.sort_unstable();
    QuadMesh { vertices, loops, cells, rungs }
}

/// The length of the outline from a sample to the next, mm.
fn edge_length(boundary: &Boundary, outline: &Outline, sample: usize) -> f64 {
    let next = boundary.next(sample);
    let end = if next > sample {
        outline.of_sample(next)
    } else {
        let of_loop = boundary.loops().iter().position(|range| range.contains(&sample));
        outline.length(of_loop.unwrap_or(0))
    };
    end - outline.of_sample(sample)
}

/// The far ends of the rungs of each sample, in the order in which copies of it follow one another
/// along the boundary.
fn rungs_in_order(merged: &Merged, boundary: &Boundary) -> Vec<Vec<usize>> {
    // For v → y, the corner before v in the face to the left.
    let mut before = BTreeMap::new();
    for face in &merged.faces {
        for n in 0..face.len() {
            let (x, v, y) = around(face, n);
            before.insert((v, y), x);
        }
    }
    (0..boundary.len())
        .map(|v| {
            // From the edge that leaves v, rung by rung to the edge that arrives.
            let (mut rungs, mut at) = (Vec::new(), boundary.next(v));
            while let Some(&x) = before.get(&(v, at)) {
                if boundary.next(x) == v {
                    break;
                }
                rungs.push(x);
                at = x;
            }
            rungs.reverse();
            rungs
        })
        .collect()
}

/// Corner n of a face, between the ones before and behind it.
fn around(face: &Face, n: usize) -> (usize, usize, usize) {
    let count = face.len();
    (face[(n + count - 1) % count], face[n], face[(n + 1) % count])
}

fn vertices_of(
    face: &Face,
    boundary: &Boundary,
    without: &[Option<usize>],
    of_end: &BTreeMap<(usize, usize), usize>,
) -> Vec<usize> {
    let mut corners: Vec<usize> = Vec::with_capacity(face.len() + 2);
    for n in 0..face.len() {
        let (x, v, y) = around(face, n);
        let arriving = (boundary.next(x) != v).then(|| of_end.get(&(v, x)).copied()).flatten();
        let leaving = (boundary.next(v) != y).then(|| of_end.get(&(v, y)).copied()).flatten();
        for vertex in [arriving, leaving, without[v]].into_iter().flatten() {
            if corners.last() != Some(&vertex) {
                corners.push(vertex);
            }
        }
    }
    corners
}
