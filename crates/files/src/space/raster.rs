//! Which triangle of a picture lies nearest, cell by cell.
//!
//! The depth buffer of Catmull (1974): every triangle goes into the cells whose middles it covers,
//! and each cell keeps the nearest. Its time is proportional to the number of cells that the
//! triangles cover. It gives the order in which triangles are drawn ([`order`](super::order)) and
//! the hidden parts of lines. It is the picture itself where a path for each triangle would make
//! the file large.

use sheetwright::math::{Point2, Vec2};
use std::collections::BTreeMap;

/// The largest distance between places where the visibility of a line is checked, in units of the
/// picture, up to [`MOST_PIECES`] places.
const PIECE: f64 = 2.0;
/// The most places where the visibility of a line is checked.
const MOST_PIECES: f64 = 256.0;
/// The bisection steps that locate a change of the visibility of a line.
const HALVINGS: usize = 4;

/// A triangle as it lies in a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    pub(crate) corners: [Point2; 3],
    /// The nearness of its corners to the eye.
    pub(crate) near: [f64; 3],
    /// The number of its class.
    pub(crate) class: u16,
}

impl Facet {
    fn doubled_area(&self) -> f64 {
        let [a, b, c] = self.corners;
        (b - a).perp_dot(c - a)
    }

    /// Its least and its greatest nearness.
    fn span(&self) -> [f64; 2] {
        let [a, b, c] = self.near;
        [a.min(b).min(c), a.max(b).max(c)]
    }

    pub(crate) fn mean_near(&self) -> f64 {
        self.near.iter().sum::<f64>() / 3.0
    }

    /// The gradient of its nearness, per unit to the right and downwards; zero if it is seen edge
    /// on.
    fn slope(&self) -> Vec2 {
        let whole = self.doubled_area();
        if whole == 0.0 {
            return Vec2::ZERO;
        }
        let ([a, b, c], [of_a, of_b, of_c]) = (self.corners, self.near);
        let (ab, ac, up_b, up_c) = (b - a, c - a, of_b - of_a, of_c - of_a);
        Vec2::new(up_b * ac.y - up_c * ab.y, up_c * ab.x - up_b * ac.x) / whole
    }

    /// The nearness of its plane at a place, limited to the range of the triangle's own.
    pub(crate) fn near_at(&self, at: Point2) -> f64 {
        let [least, most] = self.span();
        if self.doubled_area() == 0.0 {
            return self.mean_near();
        }
        (self.near[0] + self.slope().dot(at - self.corners[0])).clamp(least, most)
    }
}

/// A line as it lies in a picture.
pub(crate) struct Line<'a> {
    pub(crate) ends: [Point2; 2],
    /// The nearness of its ends to the eye.
    pub(crate) near: [f64; 2],
    /// A facet hides it only if it is nearer by more than this.
    pub(crate) enough: f64,
    /// Whether it may lie on facets of a class.
    pub(crate) belongs: &'a dyn Fn(u16) -> bool,
}

/// The nearest facets of a picture, in the cells of the box around them.
pub(crate) struct Raster<'a> {
    pub(crate) facets: &'a [Facet],
    /// Cells per unit of the picture.
    per_unit: f64,
    /// The cells left of the box and above it.
    left: usize,
    above: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// The nearest facet of each cell, [`NONE`] where there is none.
    top: Vec<u32>,
    /// Whether a facet covers the middle of a cell at all.
    covers: Vec<bool>,
    /// Whether some cell is covered twice.
    overlaps: bool,
}

const NONE: u32 = u32::MAX;

impl<'a> Raster<'a> {
    /// The raster of facets, at most 2³² − 1, in a picture of a size with `per_unit` cells per
    /// unit.
    pub(crate) fn new(size: Vec2, per_unit: f64, facets: &'a [Facet]) -> Self {
        let range = |size: f64, along: fn(&Point2) -> f64| {
            let corners = || facets.iter().flat_map(|facet| &facet.corners).map(along);
            let least = corners().fold(size, f64::min);
            let most = corners().fold(least, f64::max).min(size);
            // Conversion saturates at 0.
            let first = (least * per_unit).floor() as usize;
            (first, ((most * per_unit).ceil() as usize).saturating_sub(first).max(1))
        };
        let ((left, width), (above, height)) = (range(size.x, |p| p.x), range(size.y, |p| p.y));
        let covers = vec![false; facets.len()];
        let (top, overlaps) = (Vec::new(), false);
        let mut raster =
            Self { facets, per_unit, left, above, width, height, top, covers, overlaps };
        let mut top = vec![NONE; width * height];
        let mut near = vec![f64::NEG_INFINITY; width * height];
        for (n, facet) in facets.iter().enumerate() {
            let slope = facet.slope();
            let [least, most] = facet.span();
            let step = slope.x / per_unit;
            for (row, from, to) in raster.rows(facet) {
                raster.covers[n] = true;
                let first = raster.middle(row, from) - facet.corners[0];
                let start = facet.near[0] + slope.dot(first);
                for column in from..to {
                    let here = (start + step * (column - from) as f64).clamp(least, most);
                    let cell = row * width + column;
                    raster.overlaps |= top[cell] != NONE;
                    if here > near[cell] {
                        near[cell] = here;
                        top[cell] = n as u32;
                    }
                }
            }
        }
        raster.top = top;
        raster
    }

    /// The middle of a cell, in units of the picture.
    fn middle(&self, row: usize, column: usize) -> Point2 {
        let at = |n: usize| (n as f64 + 0.5) / self.per_unit;
        Point2::new(at(self.left + column), at(self.above + row))
    }

    /// A place of the picture, in cells from the middle of the first cell.
    fn in_cells(&self, p: Point2) -> Point2 {
        let along = |x: f64, first: usize| self.per_unit * x - first as f64 - 0.5;
        Point2::new(along(p.x, self.left), along(p.y, self.above))
    }

    /// The cells whose middles a facet covers: rows, each from a column to before another. Facets
    /// that share a side share no cell.
    fn rows(&self, facet: &Facet) -> impl Iterator<Item = (usize, usize, usize)> + use<> {
        let mut corners = facet.corners.map(|p| self.in_cells(p));
        corners.sort_unstable_by(|a, b| a.y.total_cmp(&b.y));
        let [low, middle, high] = corners;
        let (long, lower, upper) =
            (FacetSide::new(low, high), FacetSide::new(low, middle), FacetSide::new(middle, high));
        let width = self.width;
        (whole_from(low.y)..whole_from(high.y).min(self.height)).filter_map(move |row| {
            let y = row as f64;
            let (a, b) = (long.at(y), if y < middle.y { &lower } else { &upper }.at(y));
            let [from, to] = [a.min(b), a.max(b)].map(|x| whole_from(x).min(width));
            (from < to).then_some((row, from, to))
        })
    }

    /// The cells of a facet.
    pub(crate) fn cells(&self, n: usize) -> impl Iterator<Item = usize> + use<> {
        let width = self.width;
        let rows = self.rows(&self.facets[n]);
        rows.flat_map(move |(row, from, to)| row * width + from..row * width + to)
    }

    /// The facet that shows in a cell.
    pub(crate) fn top(&self, cell: usize) -> Option<usize> {
        Some(self.top[cell]).filter(|&n| n != NONE).map(|n| n as usize)
    }

    /// Whether a facet covers the middle of a cell: one that is thinner than a cell may not.
    pub(crate) fn covers(&self, n: usize) -> bool {
        self.covers[n]
    }

    /// Whether no facet can hide anything: every facet covers cells, and no cell is covered twice.
    pub(crate) fn is_plain(&self) -> bool {
        !self.overlaps && self.covers.iter().all(|&covers| covers)
    }

    /// The facet that shows at a place.
    pub(crate) fn top_at(&self, at: Point2) -> Option<usize> {
        let cell = |x: f64, count: usize| ((x + 0.5).max(0.0) as usize).min(count - 1);
        let at = self.in_cells(at);
        self.top(cell(at.y, self.height) * self.width + cell(at.x, self.width))
    }

    /// Whether the facet that shows at a place of a line hides it. The facet is certain to hide it
    /// if its plane is nearer by more than `enough` and the depth range of a steep plane within a
    /// cell. Within that margin, only a facet to which the line does not belong hides it.
    fn is_hidden(&self, at: Point2, line: &Line<'_>, near: f64) -> bool {
        self.top_at(at).is_some_and(|n| {
            let facet = &self.facets[n];
            let [least, most] = facet.span();
            let unsure = (facet.slope().length() / self.per_unit).min(0.5 * (most - least));
            let before = facet.near_at(at) - near;
            let doubt = line.enough + unsure;
            before > doubt || (before > -doubt && !(line.belongs)(facet.class))
        })
    }

    /// The pieces of a line that nothing hides.
    pub(crate) fn visible(&self, line: &Line<'_>) -> Vec<[Point2; 2]> {
        let ([a, b], [near_a, near_b]) = (line.ends, line.near);
        let pieces = (a.distance(b) / PIECE).ceil().clamp(1.0, MOST_PIECES);
        let seen = |share: f64| {
            !self.is_hidden(a.lerp(b, share), line, near_a + share * (near_b - near_a))
        };
        // Not at the very ends, where other lines begin.
        let middles = (0..pieces as usize).map(|n| (n as f64 + 0.5) / pieces);
        let mut found: Vec<[f64; 2]> = Vec::new();
        let (mut last, mut was_seen) = (0.0, false);
        for (n, share) in middles.enumerate() {
            let is_seen = seen(share);
            let turn = if n == 0 { 0.0 } else { halved(seen, [last, share], was_seen) };
            match (was_seen, is_seen) {
                (false, true) => found.push([turn, 1.0]),
                (true, false) => {
                    if let Some(piece) = found.last_mut() {
                        piece[1] = turn;
                    }
                }
                _ => {}
            }
            (last, was_seen) = (share, is_seen);
        }
        // To the very end, where the next line begins.
        let at = |share: f64| if share == 1.0 { b } else { a.lerp(b, share) };
        found.iter().map(|ends| ends.map(at)).collect()
    }

    /// All cells by their classes, as rows.
    pub(crate) fn rows_of_cells(&self) -> BTreeMap<u16, Vec<CellRow>> {
        self.rows_of_cells_where(|_| true)
    }

    /// Some of the cells by their classes, as rows.
    pub(crate) fn rows_of_cells_where(
        &self,
        wanted: impl Fn(usize) -> bool,
    ) -> BTreeMap<u16, Vec<CellRow>> {
        let class =
            |cell: usize| self.top(cell).filter(|_| wanted(cell)).map(|n| self.facets[n].class);
        let size = |cells: usize| cells as f64 / self.per_unit;
        let mut rows: BTreeMap<u16, Vec<CellRow>> = BTreeMap::new();
        for row in 0..self.height {
            let mut x = 0;
            while x < self.width {
                let (start, here) = (x, class(row * self.width + x));
                while x < self.width && class(row * self.width + x) == here {
                    x += 1;
                }
                if let Some(here) = here {
                    let corner = Point2::new(size(self.left + start), size(self.above + row));
                    let size = Vec2::new(size(x - start), size(1));
                    rows.entry(here).or_default().push(CellRow { corner, size });
                }
            }
        }
        rows
    }
}

/// Cells of one class side by side, in units of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CellRow {
    /// Its upper left corner.
    pub(crate) corner: Point2,
    pub(crate) size: Vec2,
}

/// A side of a facet, in cells, from its lower to its upper end, so that both facets of a side
/// compute equal places on it.
struct FacetSide {
    from: Point2,
    slope: f64,
}

impl FacetSide {
    fn new(low: Point2, high: Point2) -> Self {
        Self { from: low, slope: (high.x - low.x) / (high.y - low.y) }
    }

    /// Its x at a height between those of its ends. The side must not be level.
    fn at(&self, y: f64) -> f64 {
        self.from.x + self.slope * (y - self.from.y)
    }
}

/// The least whole number that is not below `x`, at least 0.
fn whole_from(x: f64) -> usize {
    // The conversion truncates, and saturates at 0.
    let whole = x as usize;
    if (whole as f64) < x { whole + 1 } else { whole }
}

/// The place between two where visibility changes, by bisection. `from_seen` is the visibility of
/// the first; the second has the opposite.
fn halved(seen: impl Fn(f64) -> bool, [mut from, mut to]: [f64; 2], from_seen: bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        *(if seen(middle) == from_seen { &mut from } else { &mut to }) = middle;
    }
    0.5 * (from + to)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facet(corners: [[f64; 2]; 3], near: f64, class: u16) -> Facet {
        Facet { corners: corners.map(|[x, y]| Point2::new(x, y)), near: [near; 3], class }
    }

    #[test]
    fn what_is_nearer_shows_and_hides() {
        let p = Point2::new;
        let facets = [
            facet([[0., 0.], [4., 0.], [0., 2.]], 0.0, 1),
            facet([[0., 0.], [2., 0.], [0., 10.]], 1.0, 2),
            facet([[0., 0.], [2., 0.], [0., 10.]], -1.0, 3),
        ];
        let cells = Raster::new(Vec2::new(4.0, 2.0), 1.0, &facets);
        let row =
            |[x, y, width]: [f64; 3]| CellRow { corner: p(x, y), size: Vec2::new(width, 1.0) };
        let rows = cells.rows_of_cells().into_iter();
        let wanted =
            [(1, vec![row([2., 0., 1.])]), (2, vec![row([0., 0., 2.]), row([0., 1., 2.])])];
        assert_eq!(rows.collect::<Vec<_>>(), wanted);
        let line = |near: f64, belongs: &dyn Fn(u16) -> bool| {
            let ends = [p(0., 0.5), p(4., 0.5)];
            cells.visible(&Line { ends, near: [near; 2], enough: 0.1, belongs })
        };
        let seen = line(0.5, &|_| true);
        assert_eq!(seen.len(), 1);
        assert!((seen[0][0].x - 2.0).abs() < 0.1 && seen[0][1] == p(4., 0.5), "{seen:?}");
        // On the facet of class 1 as far as that can be told, and on no other.
        assert_eq!(line(0.05, &|class| class == 1).len(), 1);
        assert!(line(0.05, &|class| class == 2).iter().all(|piece| piece[0].x > 2.9));
    }

    #[test]
    fn facets_with_a_common_side_share_no_cell_and_leave_none_out() {
        let corners = [[0.3, 0.1], [19.7, 2.9], [17.2, 18.8], [1.6, 15.5]];
        let [a, b, c, d] = corners;
        let facets = [facet([a, b, c], 0.0, 1), facet([a, c, d], 0.0, 2), facet([a, b, d], 0.0, 0)];
        let raster = Raster::new(Vec2::new(20.0, 20.0), 2.0, &facets);
        let of = |n: usize| raster.cells(n).collect::<std::collections::BTreeSet<usize>>();
        assert!(of(0).is_disjoint(&of(1)));
        assert!(of(2).is_subset(&of(0).union(&of(1)).copied().collect()));
    }

    #[test]
    fn there_are_cells_where_facets_are_and_nowhere_else() {
        let far = facet([[90.2, 70.0], [94.0, 70.0], [90.2, 72.5]], 1.0, 7);
        let facets = [far];
        let raster = Raster::new(Vec2::new(100.0, 80.0), 2.0, &facets);
        assert_eq!((raster.width, raster.height), (8, 5));
        assert_eq!(raster.top_at(Point2::new(90.7, 70.2)), Some(0));
        assert_eq!(raster.top_at(Point2::new(93.9, 72.4)), None);
        let rows = raster.rows_of_cells();
        assert_eq!((rows.len(), rows[&7][0].corner), (1, Point2::new(90.0, 70.0)));
    }
}
