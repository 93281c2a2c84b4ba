//! The planes in which the edges of a sheet stay while it grows thick: the mouths of pipes, and the
//! edges along which pipes are mitred, lie in planes of their own, and a seam in one square to the
//! sheet.
//!
//! A rail is looked at as a whole; where it bends out of one plane, each stretch of it from one
//! corner to the next. Straight lines lie in many planes, and so in none of their own.

use sheetwright_geometry::boundary::{Boundary, size_of};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{Point3, Vec3, unit};

/// How far an edge may leave its plane, as a share of its size.
const OFF_PLANE: f64 = 5e-4;
/// The area between an edge and its chord, as a share of its size squared: less is straight.
const STRAIGHT: f64 = 1e-3;

/// The plane in which an edge stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum EdgePlane {
    /// Its own, with this normal.
    Own(Vec3),
    /// The one through it that is square to the sheet.
    Square,
    /// None.
    Free,
}

/// The planes of the edges that the steps of a boundary belong to, from each sample to the next.
/// `ends` holds the steps between two rails.
pub(crate) fn plane_edges(boundary: &Boundary, ends: &[[SampleIndex; 2]]) -> Vec<EdgePlane> {
    let mut is_end = vec![false; boundary.len()];
    ends.iter().for_each(|[from, _]| is_end[from.get()] = true);
    let of_step = |&is_end: &bool| if is_end { EdgePlane::Square } else { EdgePlane::Free };
    let mut planes: Vec<EdgePlane> = is_end.iter().map(of_step).collect();
    for line in boundary.loops() {
        let steps: Vec<usize> = line.clone().collect();
        for edge in divided(&steps, |n| is_end[n] || is_end[boundary.previous(n)]) {
            if is_end[edge[0]] {
                continue;
            }
            let first = edge[0];
            let is_corner = |n: usize| n == first || boundary.samples()[n].is_corner();
            let plane_of = |steps: &[usize]| plane_of(boundary, steps);
            let stretches = match plane_of(&edge) {
                Some(_) => vec![edge],
                None => divided(&edge, is_corner),
            };
            for stretch in stretches {
                let plane = plane_of(&stretch).map_or(EdgePlane::Free, EdgePlane::Own);
                stretch.iter().for_each(|&n| planes[n] = plane);
            }
        }
    }
    planes
}

/// A closed line of steps, divided where a step begins anew; whole where none does.
fn divided(steps: &[usize], begins: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let first = steps.iter().position(|&n| begins(n)).unwrap_or(0);
    let mut parts: Vec<Vec<usize>> = Vec::new();
    for &n in steps[first..].iter().chain(&steps[..first]) {
        match parts.last_mut() {
            Some(part) if !begins(n) => part.push(n),
            _ => parts.push(vec![n]),
        }
    }
    parts
}

/// The normal of the plane in which consecutive steps lie.
fn plane_of(boundary: &Boundary, steps: &[usize]) -> Option<Vec3> {
    let samples = boundary.samples();
    let last = boundary.next(*steps.last()?);
    let points = || steps.iter().chain([&last]).map(|&n| samples[n].position);
    let (begin, size) = (samples[steps[0]].position, size_of(points()));
    let triangle = |[a, b]: [Point3; 2]| (a - begin).cross(b - begin) * 0.5;
    let area: Vec3 = points().zip(points().skip(1)).map(|(a, b)| triangle([a, b])).sum();
    let normal = unit(area).filter(|_| area.length() > STRAIGHT * size * size)?;
    points().all(|p| (p - begin).dot(normal).abs() <= OFF_PLANE * size).then_some(normal)
}
