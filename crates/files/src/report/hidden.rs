//! Which parts of lines on a surface are hidden by the surfaces.

use super::canvas::WIDTH;
use super::part::Part;
use super::view::View;
use sheetwright::index::{SampleIndex, TriangleIndex};
use sheetwright::math::{Point2, Vec2};

/// Triangles are looked up by the columns of the picture that they reach into.
const COLUMNS: usize = 48;
/// A line is decided in pieces of this length in the picture, at the most this many.
const PIECE: f64 = 5.0;
const MOST_PIECES: f64 = 96.0;
/// A triangle hides what lies behind it by more than this share of the largest panel's size: what is
/// nearer lies on the triangle itself, but for rounding.
const BEHIND: f64 = 1e-6;

/// Surfaces as they are seen.
pub(super) struct Seen<'a> {
    view: &'a View,
    parts: &'a [Part<'a>],
    /// The size of all, mm.
    size: f64,
    columns: Vec<Vec<(usize, TriangleIndex)>>,
}

impl<'a> Seen<'a> {
    pub(super) fn new(view: &'a View, parts: &'a [Part<'a>]) -> Self {
        let mut columns = vec![Vec::new(); COLUMNS];
        for (part, Part { panel, points, .. }) in parts.iter().enumerate() {
            for (n, corners) in panel.surface.connectivity().triangles().iter().enumerate() {
                let [a, b, c] = corners.map(|s| column(points[s.get()].x));
                for column in &mut columns[a.min(b).min(c)..=a.max(b).max(c)] {
                    column.push((part, TriangleIndex::new(n)));
                }
            }
        }
        let size = parts.iter().map(|part| part.panel.boundary.size()).fold(0.0, f64::max);
        Self { view, parts, size, columns }
    }

    /// The pieces of the line between two samples of a part that are seen.
    pub(super) fn visible(&self, part: usize, ends: [SampleIndex; 2]) -> Vec<[Point2; 2]> {
        let Part { panel, points, .. } = &self.parts[part];
        let [a, b] = ends.map(|s| points[s.get()]);
        let [near_a, near_b] = ends.map(|s| self.view.nearness(panel.surface.position(s)));
        let pieces = (a.distance(b) / PIECE).ceil().clamp(1.0, MOST_PIECES);
        let mut found: Vec<[Point2; 2]> = Vec::new();
        let mut going_on = false;
        let mut n = 0.0;
        while n < pieces {
            let (from, middle, to) = (n / pieces, (n + 0.5) / pieces, (n + 1.0) / pieces);
            let nearness = near_a + middle * (near_b - near_a);
            let seen = !self.is_hidden(a.lerp(b, middle), nearness, (part, ends));
            match found.last_mut() {
                Some(last) if seen && going_on => last[1] = a.lerp(b, to),
                _ if seen => found.push([a.lerp(b, from), a.lerp(b, to)]),
                _ => {}
            }
            going_on = seen;
            n += 1.0;
        }
        found
    }

    /// Whether a triangle lies before a place on a line; those at the line's own ends do not count.
    fn is_hidden(
        &self,
        at: Point2,
        nearness: f64,
        (of_part, ends): (usize, [SampleIndex; 2]),
    ) -> bool {
        let enough = BEHIND * self.size;
        self.columns[column(at.x)].iter().any(|&(part, triangle)| {
            let Part { panel, points, .. } = &self.parts[part];
            let corners = panel.surface.connectivity().triangles()[triangle.get()];
            if part == of_part && corners.iter().any(|c| ends.contains(c)) {
                return false;
            }
            let places = corners.map(|s| points[s.get()]);
            let Some(weights) = weights(at, places) else { return false };
            let of_corners = corners.map(|s| self.view.nearness(panel.surface.position(s)));
            let there: f64 = weights.iter().zip(of_corners).map(|(w, near)| w * near).sum();
            there > nearness + enough
        })
    }
}

fn column(x: f64) -> usize {
    ((x * COLUMNS as f64 / WIDTH).floor().max(0.0) as usize).min(COLUMNS - 1)
}

/// How much each corner of a triangle counts at a place inside it; `None` outside, and for
/// a triangle that is seen edge on.
fn weights(at: Point2, [a, b, c]: [Point2; 3]) -> Option<[f64; 3]> {
    let cross = |u: Vec2, v: Vec2| u.perp_dot(v);
    let whole = cross(b - a, c - a);
    if whole == 0.0 {
        return None;
    }
    let weights = [cross(b - at, c - at), cross(c - at, a - at), cross(a - at, b - at)];
    let weights = weights.map(|w| w / whole);
    weights.iter().all(|&w| w > 0.0).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_weighed_by_its_triangle() {
        let p = Point2::new;
        let corners = [p(0., 0.), p(4., 0.), p(0., 4.)];
        assert_eq!(weights(p(1., 1.), corners), Some([0.5, 0.25, 0.25]));
        assert_eq!(weights(p(3., 3.), corners), None);
        assert_eq!(weights(p(1., 1.), [p(0., 0.), p(2., 2.), p(4., 4.)]), None);
    }
}
