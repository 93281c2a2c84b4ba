//! Where a point of a flat sheet lies: the triangle over it, found by a grid of cells.

use sheetwright_geometry::math::Point2;

/// Triangles in the plane, and a grid of square cells, each with the triangles that reach into it,
/// in increasing order.
pub(super) struct Places {
    triangles: Vec<[Point2; 3]>,
    low: Point2,
    cell_mm: f64,
    columns: usize,
    cells: Vec<Vec<usize>>,
}

impl Places {
    pub(super) fn new(triangles: impl Iterator<Item = [Point2; 3]>) -> Self {
        let triangles: Vec<[Point2; 3]> = triangles.collect();
        let (mut low, mut high) = (
            Point2::new(f64::INFINITY, f64::INFINITY),
            Point2::new(-f64::INFINITY, -f64::INFINITY),
        );
        for p in triangles.iter().flatten() {
            (low.x, low.y) = (low.x.min(p.x), low.y.min(p.y));
            (high.x, high.y) = (high.x.max(p.x), high.y.max(p.y));
        }
        // About as many cells as triangles, and a little room for rounding.
        let (width, height) = (high.x - low.x, high.y - low.y);
        let fine = (width * height / triangles.len().max(1) as f64).sqrt();
        let cell_mm = fine.max(width.max(height) / MOST_COLUMNS);
        let rows = (height / cell_mm) as usize + 1;
        let columns = (width / cell_mm) as usize + 1;
        let mut places = Self { triangles, low, cell_mm, columns, cells: Vec::new() };
        places.cells = vec![Vec::new(); rows * columns];
        let room = 1e-9 * cell_mm;
        for n in 0..places.triangles.len() {
            let xs = places.triangles[n].map(|p| p.x);
            let ys = places.triangles[n].map(|p| p.y);
            let span = |all: [f64; 3], from: f64, most: usize| {
                let least = all.into_iter().fold(f64::INFINITY, f64::min) - room;
                let greatest = all.into_iter().fold(f64::NEG_INFINITY, f64::max) + room;
                let cell = |x: f64| (((x - from) / cell_mm).max(0.0) as usize).min(most - 1);
                cell(least)..=cell(greatest)
            };
            for row in span(ys, low.y, rows) {
                for column in span(xs, low.x, columns) {
                    places.cells[row * columns + column].push(n);
                }
            }
        }
        places
    }

    /// The triangle that a point lies in, or nearest to, and its barycentric coordinates there.
    pub(super) fn located(&self, p: Point2) -> (usize, [f64; 3]) {
        let rows = self.cells.len() / self.columns;
        let number = |x: f64, most: usize| ((x / self.cell_mm).max(0.0) as usize).min(most - 1);
        let (row, column) =
            (number(p.y - self.low.y, rows), number(p.x - self.low.x, self.columns));
        let near = self.best(self.cells[row * self.columns + column].iter().copied(), p);
        // A triangle that holds the point is in the cell. Beside all of them, each may be nearest.
        let (_, triangle, weights) =
            if near.0 >= 0.0 { near } else { self.best(0..self.triangles.len(), p) };
        (triangle, weights)
    }

    /// Of some triangles, the first whose least coordinate is the greatest.
    fn best(&self, of: impl Iterator<Item = usize>, p: Point2) -> (f64, usize, [f64; 3]) {
        let mut best = (f64::NEG_INFINITY, 0, [1.0, 0.0, 0.0]);
        for n in of {
            let [a, b, c] = self.triangles[n];
            let whole = (b - a).perp_dot(c - a);
            let weights =
                [(b - p).perp_dot(c - p), (c - p).perp_dot(a - p), (a - p).perp_dot(b - p)]
                    .map(|w| w / whole);
            let least = weights.into_iter().fold(f64::INFINITY, f64::min);
            if least > best.0 {
                best = (least, n, weights);
            }
        }
        best
    }
}

/// The grid has at most about so many cells a side: of a needle, cells by its area would be many.
const MOST_COLUMNS: f64 = 2000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_finds_what_a_look_at_all_triangles_finds() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let at = |i: usize, j: usize| Point2::new(3.0 * i as f64, j as f64 + 0.2 * (i % 3) as f64);
        let cells = (0..20).flat_map(|i| (0..30).map(move |j| (i, j)));
        let halves = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        let places = Places::new(halves);
        let mut inside = 0;
        for _ in 0..2000 {
            let p = Point2::new(66.0 * random() - 3.0, 36.0 * random() - 3.0);
            let (least, n, weights) = places.best(0..places.triangles.len(), p);
            assert_eq!(places.located(p), (n, weights));
            inside += usize::from(least >= 0.0);
        }
        assert!(inside > 1000 && inside < 1900, "{inside}");
    }
}
