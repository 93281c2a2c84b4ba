//! Refuses boundaries that touch themselves other than along seams.
//!
//! Points are on one spot, and edges touch, within a tolerance: after sampling, curves that cross
//! in space miss one another by rounding at least, so an exact test would find no crossing.

use super::{Boundary, BoundaryError};
use crate::math::{Point3, Vec3};
use crate::predicate::for_touching_boxes;
use crate::tolerance::Tolerance;

/// Edges nearer than this share of the size touch: far above rounding (1e-16), and below any gap
/// that is drawn on purpose or can be cut.
const TOUCH: f64 = 1e-9;

/// Refuses a boundary with two samples on one spot, or two edges that touch, unless both belong to
/// an edge that is walked both ways; and a loop with such edges only.
pub(super) fn refuse_touching(boundary: &Boundary) -> Result<(), BoundaryError> {
    let edges = Edges::new(boundary);
    let mut worst: Option<(usize, usize, bool)> = None;
    edges.for_near_pairs(TOUCH * boundary.size(), |i, j, same_spot| {
        let found = (i, j, same_spot);
        // The first in the order of the boundary counts, a repeated sample before a crossing.
        let key = |(i, j, same): (usize, usize, bool)| (!same, j, i);
        if worst.is_none_or(|best| key(found) < key(best)) {
            worst = Some(found);
        }
    });
    let Some((i, j, same_spot)) = worst else { return edges.refuse_bounding_nothing() };
    let (other_loop, other) = boundary.within_loop(i);
    let (of_loop, sample) = boundary.within_loop(j);
    Err(if same_spot && edges.walked_twice(i, j) {
        BoundaryError::OneSided { of_loop, sample, other_loop, other }
    } else if same_spot {
        BoundaryError::Repeated { of_loop, sample, other_loop, other }
    } else {
        BoundaryError::Crossing {
            of_loop: other_loop,
            sample: other,
            other_loop: of_loop,
            other: sample,
            near: Box::new(edges.at(i)),
        }
    })
}

struct Edges<'a> {
    boundary: &'a Boundary,
    same: f64,
}

impl<'a> Edges<'a> {
    fn new(boundary: &'a Boundary) -> Self {
        Self { boundary, same: Tolerance::SAME_POINT.length_mm(boundary.size()) }
    }

    fn at(&self, i: usize) -> Point3 {
        self.boundary.samples()[i].position
    }

    /// Whether the edges before or behind two samples on one spot are one edge, walked twice in the
    /// same direction.
    fn walked_twice(&self, i: usize, j: usize) -> bool {
        let boundary = self.boundary;
        self.same_spot(boundary.next(i), boundary.next(j))
            || self.same_spot(boundary.previous(i), boundary.previous(j))
    }

    fn same_spot(&self, i: usize, j: usize) -> bool {
        self.at(i).distance(self.at(j)) <= self.same
    }

    /// Refuses a loop whose every edge is walked both ways.
    fn refuse_bounding_nothing(&self) -> Result<(), BoundaryError> {
        let b = self.boundary;
        let mut walked_back = vec![false; b.len()];
        self.for_touching_boxes(self.same, |i, j| {
            if self.same_spot(i, b.next(j)) && self.same_spot(j, b.next(i)) {
                (walked_back[i], walked_back[j]) = (true, true);
            }
        });
        let nothing =
            |range: &std::ops::Range<usize>| walked_back[range.clone()].iter().all(|w| *w);
        match b.loops().iter().position(nothing) {
            Some(of_loop) => Err(BoundaryError::BoundsNothing { of_loop }),
            None => Ok(()),
        }
    }

    /// Whether samples `i` and `j`, on one spot, lie on an edge that is walked both ways.
    fn on_seam(&self, i: usize, j: usize) -> bool {
        let b = self.boundary;
        let apart = |p: usize, q: usize| p != q && self.same_spot(p, q);
        // Neighbours on one spot make no seam: an edge must lie between them.
        (b.next(i) != j && b.next(j) != i)
            && (apart(b.next(i), b.previous(j)) || apart(b.previous(i), b.next(j)))
    }

    /// Calls `found(i, j, same_spot)` with i < j for samples i, j on one spot and for edges i, j
    /// (which begin at samples i, j) that touch though they share no end.
    fn for_near_pairs(&self, near: f64, mut found: impl FnMut(usize, usize, bool)) {
        self.for_touching_boxes(near, |i, j| self.look_at(i, j, near, &mut found));
    }

    /// Calls `visit(i, j)` with i < j for any two edges whose boxes, `near` wider, touch.
    fn for_touching_boxes(&self, near: f64, mut visit: impl FnMut(usize, usize)) {
        let b = self.boundary;
        let m = b.len();
        let low_high = |i: usize| {
            let (p, q) = (self.at(i).to_vec(), self.at(b.next(i)).to_vec());
            (p.min(q) - near, p.max(q) + near)
        };
        let boxes: Vec<(Vec3, Vec3)> = (0..m).map(low_high).collect();
        for_touching_boxes(&boxes, &mut visit);
    }

    fn look_at(&self, i: usize, j: usize, near: f64, found: &mut impl FnMut(usize, usize, bool)) {
        let (i_end, j_end) = (self.boundary.next(i), self.boundary.next(j));
        let mut on_one_spot = false;
        for (p, q) in [(i, j), (i, j_end), (i_end, j), (i_end, j_end)] {
            if p == q {
                on_one_spot = true;
            } else if self.same_spot(p, q) {
                on_one_spot = true;
                if !self.on_seam(p, q) {
                    found(p.min(q), p.max(q), true);
                }
            }
        }
        if on_one_spot {
            return;
        }
        let gap = segment_gap(self.at(i), self.at(i_end), self.at(j), self.at(j_end));
        if gap <= near {
            found(i, j, false);
        }
    }
}

/// The distance between two segments in space, mm \[Ericson2005, 5.1.9\].
fn segment_gap(a: Point3, b: Point3, c: Point3, d: Point3) -> f64 {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, vv, uv) = (u.dot(u), v.dot(v), u.dot(v));
    let (uw, vw) = (u.dot(w), v.dot(w));
    let clamp = |x: f64| x.clamp(0.0, 1.0);
    let det = uu * vv - uv * uv;
    // Parallel segments: begin with any point of the first.
    let s = if det > 0.0 { clamp((uv * vw - vv * uw) / det) } else { 0.0 };
    let t = if vv > 0.0 { (uv * s + vw) / vv } else { 0.0 };
    let (s, t) = if t < 0.0 {
        (if uu > 0.0 { clamp(-uw / uu) } else { 0.0 }, 0.0)
    } else if t > 1.0 {
        (if uu > 0.0 { clamp((uv - uw) / uu) } else { 0.0 }, 1.0)
    } else {
        (s, t)
    };
    (a + u * s).distance(c + v * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_between_segments() {
        let p = Point3::new;
        let gap = segment_gap(p(0., 0., 0.), p(2., 0., 0.), p(1., -1., 3.), p(1., 1., 3.));
        assert!((gap - 3.0).abs() < 1e-15);
        let gap = segment_gap(p(0., 0., 0.), p(1., 0., 0.), p(2., 0., 0.), p(3., 0., 0.));
        assert!((gap - 1.0).abs() < 1e-15);
        let gap = segment_gap(p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.), p(1., 1., 0.));
        assert!((gap - 1.0).abs() < 1e-15);
    }
}
