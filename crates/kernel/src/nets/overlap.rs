//! Whether two facets that are laid in the plane overlap.
//!
//! Predicates are exact; one tolerance makes them careful. Facets that share a vertex of the net
//! touch there and no more. Others must keep apart: where two sides come nearer than [`APART`] of
//! the size they count as overlapping, so that rounding, which is ten thousand times smaller, can't
//! decide, nor does the pattern touch itself when it is laid out again from its lengths. Where the
//! numbers of the file are rounded, facets that are laid in another order lie elsewhere by that
//! rounding; a net that overlaps itself for it is sought again with sides that keep apart by more.

use super::facets::Facets;
use sheetwright_geometry::math::Point2;
use sheetwright_geometry::predicate::segments_touch;
use std::cmp::Ordering;

/// Sides that share no vertex are apart by this share of the size of the mesh, and sides that share
/// one by an angle of so many radians. A cutter can't part lines nearer than that.
const APART: f64 = 1e-9;

/// How far sides must be apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Apart {
    /// Those that share no vertex, mm.
    pub(super) sides_mm: f64,
    /// The end of the shorter of two that share a vertex from the line of the longer, mm, if that
    /// is more than [`APART`] of its length.
    ends_mm: f64,
}

impl Apart {
    pub(super) fn of(facets: &Facets) -> Self {
        Self::new(facets.size_mm, facets.apart_mm)
    }

    /// That of a mesh of this size where `least_mm` is the least of both distances.
    pub(super) fn new(size_mm: f64, least_mm: f64) -> Self {
        Self { sides_mm: least_mm.max(APART * size_mm), ends_mm: least_mm }
    }
}

/// A side of a facet in the plane: its ends, and the vertices of the net that they are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) ends: [Point2; 2],
    pub(super) vertices: [u32; 2],
}

/// Whether two sides of facets touch or cross elsewhere than at a vertex that they share.
pub(super) fn meet(a: &Side, b: &Side, apart: Apart) -> bool {
    let shared = |n: usize, k: usize| a.vertices[n] == b.vertices[k];
    let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)];
    let mut common = pairs.into_iter().filter(|&(n, k)| shared(n, k));
    match (common.next(), common.next()) {
        // They are the two sides of a fold.
        (Some(_), Some(_)) => false,
        (Some((n, k)), None) => {
            let (from, to) = (a.ends[n], a.ends[1 - n]);
            let (u, v) = (to - from, b.ends[1 - k] - b.ends[k]);
            let (short, long) = (u.length().min(v.length()), u.length().max(v.length()));
            let near_mm = apart.ends_mm.max(APART * short);
            u.dot(v) > 0.0 && u.perp_dot(v).abs() <= near_mm * long
        }
        _ => {
            let ([[p, q], [r, s]], apart_mm) = ([a.ends, b.ends], apart.sides_mm);
            is_near_box(a, b, apart_mm)
                && (segments_touch(p, q, r, s)
                    || [(p, [r, s]), (q, [r, s]), (r, [p, q]), (s, [p, q])]
                        .into_iter()
                        .any(|(point, line)| point.distance_to_segment(line) <= apart_mm))
        }
    }
}

fn is_near_box(a: &Side, b: &Side, apart_mm: f64) -> bool {
    let [[p, q], [r, s]] = [a.ends, b.ends];
    p.x.min(q.x) <= r.x.max(s.x) + apart_mm
        && r.x.min(s.x) <= p.x.max(q.x) + apart_mm
        && p.y.min(q.y) <= r.y.max(s.y) + apart_mm
        && r.y.min(s.y) <= p.y.max(q.y) + apart_mm
}

/// Whether a point lies inside a facet with these sides, as far as no side runs through it: how
/// often a ray crosses them.
pub(super) fn is_inside(point: Point2, sides: &[Side]) -> bool {
    let crosses = |side: &&Side| {
        let [a, b] = side.ends;
        (a.y <= point.y) != (b.y <= point.y) && {
            let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
            sheetwright_geometry::predicate::orientation(low, high, point) == Ordering::Greater
        }
    };
    sides.iter().filter(crosses).count() % 2 == 1
}

/// Whether a side of a facet that begins or ends at a vertex of another one lies within that, as
/// far as the sides of both meet nowhere else: beside a hole that a narrow facet fills but for
/// rounding, no side crosses another.
pub(super) fn reaches_into(facet: &[Side], other: &[Side]) -> bool {
    let is_corner = |vertex: u32| other.iter().any(|side| side.vertices.contains(&vertex));
    facet.iter().any(|side| {
        let [from, to] = side.vertices.map(is_corner);
        // Of a fold, both are, and its middle lies on the border of both.
        let is_shared = || {
            let ends = |other: &Side| other.vertices.iter().all(|v| side.vertices.contains(v));
            other.iter().any(ends)
        };
        (from || to) && !is_shared() && is_inside(side.ends[0].lerp(side.ends[1], 0.5), other)
    })
}
