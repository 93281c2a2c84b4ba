//! The outline of a net: corners and middles in turn along a loop of the border.
//!
//! An outline that was sampled from curves has a corner wherever it turns sharply from one sample
//! to the next. The border of a mesh may run in zigzags along the sides of triangles that are far
//! smaller than those of the net. There a corner is where the border turns over the length of half
//! a side of the net, and between corners the net cuts across the zigzags, flat and in space alike.

use super::hold::{Edge, Edges};
use crate::flatten::Flattened;
use crate::sheet::Sheet;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec2, atan2, from_deg};

/// The outline has a corner where it turns by more than this, degrees: a node stands there.
const CORNER_DEG: f64 = 20.0;
/// The border of a mesh has a corner where it turns by more than this over half a side of the net,
/// degrees. Zigzags of sides of a fifth of the net's turn by less.
const COARSE_CORNER_DEG: f64 = 30.0;
/// A loop has so many nodes at the least.
const LEAST_ON_LOOP: usize = 6;

/// How the corners of an outline are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outline {
    /// From sample to sample.
    Sampled,
    /// Over half a side of the net.
    Coarse,
}

/// A point of the border, flat and in space.
#[derive(Clone, Copy)]
pub(super) struct OnBorder {
    pub(super) flat: Point2,
    pub(super) space: Point3,
}

/// A loop of the border as corners and middles in turn.
pub(super) struct Divided {
    pub(super) points: Vec<OnBorder>,
    /// Where an edge of the outline begins: at which point, and what holds it.
    pub(super) edges: Vec<(usize, Edge)>,
}

/// A loop of the border as corners and middles in turn, about `side_mm` from corner to corner, with
/// one wherever the outline turns sharply, or is held in another way. All lie on the outline, by
/// its length.
pub(super) fn divided(
    sheet: &Sheet,
    flat: &Flattened,
    line: &[VertexIndex],
    side_mm: f64,
    outline: Outline,
    held: &Edges,
) -> Divided {
    let point =
        |v: VertexIndex| OnBorder { flat: flat.points[v.get()], space: sheet.mesh().position(v) };
    let m = line.len();
    let at = |n: usize| point(line[n % m]);
    let mut corners = match outline {
        Outline::Sampled => {
            let edge = |n: usize| held.of([line[n % m], line[(n + 1) % m]]);
            let is_corner = |&n: &usize| turns(|k| at(k).flat, n, m) || edge(n + m - 1) != edge(n);
            (0..m).filter(is_corner).collect()
        }
        Outline::Coarse => coarse_corners(&(0..m).map(|n| at(n).flat).collect::<Vec<_>>(), side_mm),
    };
    let least = LEAST_ON_LOOP.div_ceil(corners.len().max(1));
    if corners.is_empty() {
        corners.push(0);
    }
    let mut divided = Divided { points: Vec::new(), edges: Vec::new() };
    for (k, &from) in corners.iter().enumerate() {
        let to = if k + 1 < corners.len() { corners[k + 1] } else { corners[0] + m };
        let lengths: Vec<f64> = (from..to).map(|n| at(n).flat.distance(at(n + 1).flat)).collect();
        let whole: f64 = lengths.iter().sum();
        let count = ((whole / side_mm).round() as usize).max(least).max(1);
        divided.edges.push((divided.points.len(), held.of([line[from], line[(from + 1) % m]])));
        let mut walked = 0.0;
        let mut n = 0;
        for step in 0..2 * count {
            let wanted = whole * step as f64 / (2 * count) as f64;
            while n + 1 < lengths.len() && walked + lengths[n] <= wanted {
                walked += lengths[n];
                n += 1;
            }
            let share = ((wanted - walked) / lengths[n]).clamp(0.0, 1.0);
            let (a, b) = (at(from + n), at(from + n + 1));
            divided.points.push(OnBorder {
                flat: a.flat.lerp(b.flat, share),
                space: a.space.lerp(b.space, share),
            });
        }
    }
    divided
}

/// Whether a loop of `m` points turns sharply at one of them.
fn turns(at: impl Fn(usize) -> Point2, n: usize, m: usize) -> bool {
    let (before, here, after) = (at(n + m - 1), at(n), at(n + 1));
    turn(here - before, after - here) > from_deg(CORNER_DEG)
}

/// The angle between two directions, radians.
fn turn(came: Vec2, goes: Vec2) -> f64 {
    atan2(came.perp_dot(goes), came.dot(goes)).abs()
}

/// The points of a loop at which it turns sharply over half a side of the net on either side, the
/// sharpest of those that are nearer to one another than that; in increasing order.
fn coarse_corners(points: &[Point2], side_mm: f64) -> Vec<usize> {
    let m = points.len();
    let mut along = vec![0.0];
    for n in 0..m {
        along.push(along[n] + points[n].distance(points[(n + 1) % m]));
    }
    let whole = along[m];
    let reach = (0.5 * side_mm).min(whole / (2 * LEAST_ON_LOOP) as f64);
    let at = |s: f64| {
        let s = s.rem_euclid(whole);
        let n = along.partition_point(|&other| other <= s).clamp(1, m) - 1;
        let length = along[n + 1] - along[n];
        let share = if length > 0.0 { (s - along[n]) / length } else { 0.0 };
        points[n].lerp(points[(n + 1) % m], share)
    };
    let sharp = (0..m).filter_map(|n| {
        let (before, after) = (at(along[n] - reach), at(along[n] + reach));
        let angle = turn(points[n] - before, after - points[n]);
        (angle > from_deg(COARSE_CORNER_DEG)).then_some((n, angle))
    });
    let mut sharp: Vec<(usize, f64)> = sharp.collect();
    sharp.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut corners: Vec<usize> = Vec::new();
    for (n, _) in sharp {
        let is_apart = |&other: &usize| {
            let apart = (along[n] - along[other]).abs();
            apart.min(whole - apart) > reach
        };
        if corners.iter().all(is_apart) {
            corners.push(n);
        }
    }
    corners.sort_unstable();
    corners
}
