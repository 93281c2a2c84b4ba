//! A picture of triangles as rows of cells, one unit wide each: what lies nearest shows. It serves to
//! tell which lines are hidden, and to draw meshes of so many triangles that a path for each would
//! make the page large.

use super::canvas::number;
use sheetwright::math::{Point2, Vec2};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A line is decided in pieces of this length.
const PIECE: f64 = 2.0;
/// A line is decided in this many pieces at the most.
const MOST_PIECES: f64 = 256.0;

/// Cells of a picture.
pub(super) struct Cells {
    width: usize,
    height: usize,
    /// How near what shows is; minus infinity where nothing does.
    near: Vec<f64>,
    /// Its class.
    class: Vec<u16>,
}

impl Cells {
    /// Cells of an empty picture.
    pub(super) fn new(size: Vec2) -> Self {
        let [width, height] = [size.x, size.y].map(|side| side.ceil().max(1.0) as usize);
        let count = width * height;
        Self { width, height, near: vec![f64::NEG_INFINITY; count], class: vec![0; count] }
    }

    /// Puts a triangle into the cells whose middles it covers, where nothing is nearer.
    pub(super) fn triangle(&mut self, corners: [Point2; 3], near: [f64; 3], class: u16) {
        let [a, b, c] = corners;
        let whole = (b - a).perp_dot(c - a);
        let [left, right] = bounds(corners.map(|p| p.x), self.width);
        let [top, bottom] = bounds(corners.map(|p| p.y), self.height);
        if whole == 0.0 {
            return;
        }
        for y in top..bottom {
            for x in left..right {
                let at = Point2::new(x as f64 + 0.5, y as f64 + 0.5);
                let weights = [
                    (b - at).perp_dot(c - at) / whole,
                    (c - at).perp_dot(a - at) / whole,
                    (a - at).perp_dot(b - at) / whole,
                ];
                if weights.iter().any(|&w| w < 0.0) {
                    continue;
                }
                let here: f64 = weights.iter().zip(near).map(|(w, n)| w * n).sum();
                let cell = y * self.width + x;
                if here > self.near[cell] {
                    self.near[cell] = here;
                    self.class[cell] = class;
                }
            }
        }
    }

    /// The pieces of a line that nothing hides by more than `enough`.
    pub(super) fn visible(
        &self,
        [a, b]: [Point2; 2],
        [near_a, near_b]: [f64; 2],
        enough: f64,
    ) -> Vec<[Point2; 2]> {
        let pieces = (a.distance(b) / PIECE).ceil().clamp(1.0, MOST_PIECES);
        let mut found: Vec<[Point2; 2]> = Vec::new();
        let mut going_on = false;
        let mut n = 0.0;
        while n < pieces {
            let (from, middle, to) = (n / pieces, (n + 0.5) / pieces, (n + 1.0) / pieces);
            let at = a.lerp(b, middle);
            let here = near_a + middle * (near_b - near_a);
            let (x, y) = (at.x.max(0.0) as usize, at.y.max(0.0) as usize);
            let cell = y.min(self.height - 1) * self.width + x.min(self.width - 1);
            let seen = self.near[cell] <= here + enough;
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

    /// All cells as one element a class: rows of equal cells are rectangles.
    pub(super) fn elements(&self, name: impl Fn(u16) -> String) -> String {
        let mut paths: BTreeMap<u16, String> = BTreeMap::new();
        for y in 0..self.height {
            let row = y * self.width..(y + 1) * self.width;
            let shows = |x: usize| self.near[row.start + x] > f64::NEG_INFINITY;
            let mut x = 0;
            while x < self.width {
                let class = self.class[row.start + x];
                let start = x;
                x += 1;
                if !shows(start) {
                    continue;
                }
                while x < self.width && shows(x) && self.class[row.start + x] == class {
                    x += 1;
                }
                let length = number((x - start) as f64);
                // Writing to a string does not fail.
                let path = paths.entry(class).or_default();
                let _ = write!(path, "M{start} {y}h{length}v1h-{length}z");
            }
        }
        let mut body = String::new();
        for (class, path) in paths {
            let _ = write!(body, r#"<path class="{} cells" d="{path}"/>"#, name(class));
        }
        body
    }
}

/// The cells that some coordinates reach into: from the first, to before the last.
fn bounds(coordinates: [f64; 3], count: usize) -> [usize; 2] {
    let least = coordinates.into_iter().fold(f64::INFINITY, f64::min);
    let most = coordinates.into_iter().fold(f64::NEG_INFINITY, f64::max);
    [least.floor().max(0.0) as usize, (most.ceil().max(0.0) as usize).min(count)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_nearer_shows_and_hides() {
        let p = Point2::new;
        let mut cells = Cells::new(Vec2::new(4.0, 2.0));
        let half = [p(0., 0.), p(4., 0.), p(0., 2.)];
        cells.triangle(half, [0.0; 3], 1);
        cells.triangle([p(0., 0.), p(2., 0.), p(0., 10.)], [1.0; 3], 2);
        cells.triangle([p(0., 0.), p(2., 0.), p(0., 10.)], [-1.0; 3], 3);
        let body = cells.elements(|class| format!("c{class}"));
        assert_eq!(
            body,
            r#"<path class="c1 cells" d="M2 0h1v1h-1z"/><path class="c2 cells" d="M0 0h2v1h-2zM0 1h2v1h-2z"/>"#
        );
        let seen = cells.visible([p(0., 0.5), p(4., 0.5)], [0.5, 0.5], 0.1);
        assert_eq!(seen, [[p(2., 0.5), p(4., 0.5)]]);
    }
}
