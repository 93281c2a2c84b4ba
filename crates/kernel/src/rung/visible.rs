//! Which rungs lie inside the projection of the boundary on its supporting plane.
//!
//! Triangular expansion \[Bungiu2014\], with exact predicates:
//! 1. The projected loop is cut into triangles by clipping ears; which triangles does not matter.
//! 2. A sample sees its own triangles. Through the side opposite to it, it looks into the next
//!    triangle, within the window between that side's ends.
//! 3. The far corner of that triangle is seen if it lies strictly inside the window; it splits the
//!    window in two. Otherwise the window passes on one side of it, unchanged.
//! 4. A boundary edge ends the view.
//!
//! The triangles of a simple polygon form a tree, so a sample meets each at most once: O(m) for
//! each sample, O(m²) for all, plus the ears: O(m²) for outlines as people draw them, O(m³) for
//! spirals. A rung that touches the boundary
//! between its ends is not inside.

use crate::boundary::SupportingPlane;
use crate::math::Point2;
use crate::predicate::orientation;
use std::cmp::Ordering;

/// Which pairs of samples of the outer loop may be joined: any two, or those whose rung lies inside
/// the projection.
#[derive(Clone, Debug)]
pub struct Visibility {
    inside: Option<PairSet>,
}

/// A set of unordered pairs of samples, one bit each.
#[derive(Clone, Debug)]
struct PairSet {
    words: Vec<u64>,
    words_a_row: usize,
}

impl PairSet {
    fn new(m: usize) -> Self {
        let words_a_row = m.div_ceil(64);
        Self { words: vec![0; words_a_row * m], words_a_row }
    }

    fn insert(&mut self, i: usize, j: usize) {
        for (a, b) in [(i, j), (j, i)] {
            self.words[a * self.words_a_row + b / 64] |= 1 << (b % 64);
        }
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        self.words[i * self.words_a_row + j / 64] >> (j % 64) & 1 == 1
    }
}

impl Visibility {
    /// What a plane lets be seen of the outer loop, whose samples are the first `m`; everything
    /// without a plane.
    pub fn new(plane: Option<&SupportingPlane>, m: usize) -> Self {
        Self { inside: plane.map(|plane| inside_pairs(&plane.projected[..m])) }
    }

    /// What is seen between every `step`-th of m samples.
    pub(crate) fn thinned(&self, step: usize, m: usize) -> Self {
        let Some(pairs) = &self.inside else { return Self { inside: None } };
        let kept = m.div_ceil(step);
        let mut thinned = PairSet::new(kept);
        for i in 0..kept {
            for j in 0..i {
                if pairs.contains(i * step, j * step) {
                    thinned.insert(i, j);
                }
            }
        }
        Self { inside: Some(thinned) }
    }

    /// Whether samples `i` and `j`, which are no neighbours, may be joined.
    pub fn allows(&self, i: usize, j: usize) -> bool {
        self.inside.as_ref().is_none_or(|pairs| pairs.contains(i, j))
    }
}

/// The pairs that see one another inside a simple polygon that runs counter-clockwise, neighbours
/// included.
fn inside_pairs(polygon: &[Point2]) -> PairSet {
    let m = polygon.len();
    let ears = Ears::clip(polygon);
    let mut pairs = PairSet::new(m);
    for i in 0..m {
        pairs.insert(i, (i + 1) % m);
    }
    for source in 0..m {
        ears.look_from(source, polygon, &mut |seen| pairs.insert(source, seen));
    }
    pairs
}

/// A triangulation of a polygon, for looking through.
struct Ears {
    /// Corners of each triangle, in the order of the polygon.
    corners: Vec<[usize; 3]>,
    /// The triangle beyond the side opposite to each corner.
    beyond: Vec<[Option<usize>; 3]>,
    /// The triangles at each corner of the polygon.
    around: Vec<Vec<usize>>,
}

impl Ears {
    fn clip(polygon: &[Point2]) -> Self {
        let m = polygon.len();
        let mut next: Vec<usize> = (0..m).map(|i| (i + 1) % m).collect();
        let mut previous: Vec<usize> = (0..m).map(|i| (i + m - 1) % m).collect();
        let mut corners = Vec::with_capacity(m.saturating_sub(2));
        let is_ear = |next: &[usize], previous: &[usize], i: usize| {
            let (a, b) = (previous[i], next[i]);
            if orientation(polygon[a], polygon[i], polygon[b]) != Ordering::Greater {
                return false;
            }
            let mut k = next[b];
            while k != a {
                if in_closed_triangle(polygon[k], polygon[a], polygon[i], polygon[b]) {
                    return false;
                }
                k = next[k];
            }
            true
        };
        let (mut left, mut at, mut since_last) = (m, 0, 0);
        // A simple polygon always has an ear, so a whole round without one can't be.
        while left > 3 && since_last <= left {
            if is_ear(&next, &previous, at) {
                let (a, b) = (previous[at], next[at]);
                corners.push([a, at, b]);
                next[a] = b;
                previous[b] = a;
                left -= 1;
                since_last = 0;
                // Skip one, so that ears come from all round and the triangles stay compact.
                at = next[b];
            } else {
                at = next[at];
                since_last += 1;
            }
        }
        debug_assert_eq!(left, 3, "a simple polygon always has an ear");
        corners.push([previous[at], at, next[at]]);
        for triangle in &mut corners {
            triangle.sort_unstable();
        }
        Self::linked(corners, m)
    }

    fn linked(corners: Vec<[usize; 3]>, m: usize) -> Self {
        let mut sides: Vec<([usize; 2], usize, usize)> = Vec::with_capacity(3 * corners.len());
        let mut around = vec![Vec::new(); m];
        for (t, &[a, b, c]) in corners.iter().enumerate() {
            sides.extend([([b, c], t, 0), ([a, c], t, 1), ([a, b], t, 2)]);
            for corner in [a, b, c] {
                around[corner].push(t);
            }
        }
        sides.sort_unstable();
        let mut beyond = vec![[None; 3]; corners.len()];
        for pair in sides.windows(2) {
            let ((side, t, n), (other, u, k)) = (pair[0], pair[1]);
            if side == other {
                beyond[t][n] = Some(u);
                beyond[u][k] = Some(t);
            }
        }
        Self { corners, beyond, around }
    }

    fn look_from(&self, source: usize, polygon: &[Point2], see: &mut impl FnMut(usize)) {
        let eye = polygon[source];
        // (triangle to look into, side it is entered by, right and left end of the window)
        let mut views: Vec<(usize, [usize; 2], usize, usize)> = Vec::new();
        for &t in &self.around[source] {
            let n = self.corners[t].iter().position(|&c| c == source).unwrap_or(0);
            // Counter-clockwise from the source, the corners are increasing but for one wrap.
            let (right, left) = (self.corners[t][(n + 1) % 3], self.corners[t][(n + 2) % 3]);
            see(right);
            see(left);
            if let Some(u) = self.beyond[t][n] {
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
                && let Some(u) = opposite(side_left)
            {
                let new_left = if from_left == Ordering::Greater { far } else { left };
                views.push((u, [side_right, far], right, new_left));
            }
            if from_left == Ordering::Greater
                && let Some(u) = opposite(side_right)
            {
                let new_right = if from_right == Ordering::Greater { far } else { right };
                views.push((u, [far, side_left], new_right, left));
            }
        }
    }
}

/// Whether `p` lies in the triangle a, b, c (counter-clockwise) or on its border.
fn in_closed_triangle(p: Point2, a: Point2, b: Point2, c: Point2) -> bool {
    orientation(a, b, p) != Ordering::Less
        && orientation(b, c, p) != Ordering::Less
        && orientation(c, a, p) != Ordering::Less
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicate::{first_crossing, segments_touch, signed_area_doubled};

    /// Seen or not by the definition: the rung leaves into the inside at both ends and touches no
    /// edge but at its ends.
    fn sees(polygon: &[Point2], i: usize, j: usize) -> bool {
        let m = polygon.len();
        let leaves_inside = |i: usize, j: usize| {
            let (a, b, c) = (polygon[(i + m - 1) % m], polygon[i], polygon[(i + 1) % m]);
            let to = polygon[j];
            let (left_in, left_out) =
                (orientation(a, b, to).is_gt(), orientation(b, c, to).is_gt());
            if orientation(a, b, c).is_gt() { left_in && left_out } else { left_in || left_out }
        };
        let touched = (0..m).any(|k| {
            let l = (k + 1) % m;
            ![k, l].contains(&i)
                && ![k, l].contains(&j)
                && segments_touch(polygon[i], polygon[j], polygon[k], polygon[l])
        });
        let through = (0..m).any(|k| {
            k != i && k != j && segments_touch(polygon[i], polygon[j], polygon[k], polygon[k])
        });
        leaves_inside(i, j) && leaves_inside(j, i) && !touched && !through
    }

    fn star_shaped(m: usize, seed: u64, grid: bool) -> Vec<Point2> {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        (0..m)
            .map(|i| {
                let t = std::f64::consts::TAU * (i as f64 + 0.8 * random()) / m as f64;
                let r = 1.0 + 4.0 * random();
                let p = Point2::new(r * crate::math::cos(t), r * crate::math::sin(t));
                if grid { Point2::new(p.x.round(), p.y.round()) } else { p }
            })
            .collect()
    }

    #[test]
    fn what_is_seen_is_what_the_definition_says() {
        let mut tried = 0;
        for seed in 0..600 {
            let polygon = star_shaped(4 + (seed % 14) as usize, seed, seed % 2 == 0);
            if first_crossing(&polygon).is_some() || signed_area_doubled(&polygon) <= 0.0 {
                continue;
            }
            tried += 1;
            let pairs = inside_pairs(&polygon);
            let m = polygon.len();
            for i in 0..m {
                for j in i + 2..m {
                    if i == 0 && j == m - 1 {
                        continue;
                    }
                    assert_eq!(pairs.contains(i, j), sees(&polygon, i, j), "{seed} {i} {j}");
                }
            }
        }
        assert!(tried > 300, "{tried}");
    }
}
