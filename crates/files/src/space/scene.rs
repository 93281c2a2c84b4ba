//! The visible parts of surfaces: shaded triangles, and the parts of lines that no triangle hides.

use super::order::{Order, order};
use super::raster::{CellRow, Facet, Line, Raster};
use super::view::View;
use sheetwright::math::{Point2, Vec2, Vec3, unit};
use std::collections::BTreeMap;

/// The number of levels of brightness of a surface.
pub(crate) const SHADES: usize = 24;
/// The most triangles drawn as paths. More are drawn in cells, since they are smaller than the
/// thickness of their lines.
pub(crate) const MOST_PATHS: usize = 12_000;
/// A line behind a surface by less than this, in units of the picture, counts as on it.
pub(crate) const LIES_ON: f64 = 1.0;
/// Cells per unit of the picture, which is about a pixel of a page.
const PER_UNIT: f64 = 1.0;
/// The least range of brightness over which the shades are spread. A surface with a smaller range
/// is nearly flat, and may look flat.
const LEAST_CONTRAST: f64 = 0.18;
/// The offset of the numbers of the shades of the back side.
const BACK: u16 = 100;
/// The offset of the numbers of the steps of the colour map.
const HEAT: u16 = 200;
/// The offset of the shades of parts that stand back.
const FAINT: u16 = 400;

/// Something that is filled in one shade.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fill {
    /// Triangles, with a thin line in their shade, so that no gap shows between them.
    Triangles { shade: u16, triangles: Vec<[Point2; 3]> },
    /// Rows of cells.
    Cells { shade: u16, rows: Vec<CellRow> },
}

/// The side and the brightness of a shade, or its step of the colour map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shade {
    /// Of the side that the surface faces, from dark to light, below [`SHADES`].
    Front(u16),
    /// Of the other side.
    Back(u16),
    /// A step of the colour map of errors.
    Heat(u16),
    /// Of a part that is to stand back, on either side.
    Faint(u16),
}

impl Shade {
    /// The shade of a number.
    pub(crate) fn of(number: u16) -> Self {
        match number {
            FAINT.. => Self::Faint((number - FAINT) % BACK),
            HEAT.. => Self::Heat(number - HEAT),
            BACK.. => Self::Back(number - BACK),
            _ => Self::Front(number),
        }
    }
}

/// Painted triangles, and the visibility of lines among them.
pub(crate) struct Scene<'a> {
    raster: Raster<'a>,
    order: Option<Order>,
    /// A triangle hides a line only if it is nearer by more than this.
    enough: f64,
}

impl<'a> Scene<'a> {
    /// Facets in a picture of a size. A line that lies behind a facet by less than `enough` is
    /// visible.
    pub(crate) fn new(size: Vec2, facets: &'a [Facet], enough: f64) -> Self {
        Self::in_paths(size, facets, enough, MOST_PATHS)
    }

    /// Likewise, drawn in cells if there are more than `most_paths` facets.
    pub(crate) fn in_paths(
        size: Vec2,
        facets: &'a [Facet],
        enough: f64,
        most_paths: usize,
    ) -> Self {
        let raster = Raster::new(size, PER_UNIT, facets);
        let order = (facets.len() <= most_paths).then(|| order(&raster));
        Self { raster, order, enough }
    }

    /// The share of what some facets cover in which they are seen, from 0 to 1; 1 if they cover
    /// nothing.
    pub(crate) fn share_seen(&self, facets: std::ops::Range<usize>) -> f64 {
        let mut cells: Vec<usize> = facets.clone().flat_map(|n| self.raster.cells(n)).collect();
        cells.sort_unstable();
        cells.dedup();
        let is_seen = |cell: &&usize| self.raster.top(**cell).is_some_and(|n| facets.contains(&n));
        let seen = cells.iter().filter(is_seen).count();
        if cells.is_empty() { 1.0 } else { seen as f64 / cells.len() as f64 }
    }

    /// Whether no facet hides anything, so that every line is visible all along.
    pub(crate) fn is_plain(&self) -> bool {
        self.order == Some(Order::Any)
    }

    /// Everything that is filled, in the order in which it is drawn.
    pub(crate) fn fills(&self) -> Vec<Fill> {
        let facets = self.raster.facets;
        let cells = |rows: BTreeMap<u16, Vec<CellRow>>| {
            rows.into_iter().map(|(shade, rows)| Fill::Cells { shade, rows })
        };
        match &self.order {
            None => cells(self.raster.rows_of_cells()).collect(),
            // Those of one shade are one path, which makes the file small.
            Some(Order::Any) => {
                let mut fills: BTreeMap<u16, Vec<[Point2; 3]>> = BTreeMap::new();
                for facet in facets {
                    fills.entry(facet.class).or_default().push(facet.corners);
                }
                let fill = |(shade, triangles)| Fill::Triangles { shade, triangles };
                fills.into_iter().map(fill).collect()
            }
            Some(Order::Of(list, wrong)) => {
                let mut fills: Vec<Fill> = Vec::new();
                for facet in list.iter().map(|&n| &facets[n]) {
                    match fills.last_mut() {
                        Some(Fill::Triangles { shade, triangles }) if *shade == facet.class => {
                            triangles.push(facet.corners);
                        }
                        _ => {
                            let triangles = vec![facet.corners];
                            fills.push(Fill::Triangles { shade: facet.class, triangles });
                        }
                    }
                }
                let patches =
                    wrong.iter().map(|wrong| self.raster.rows_of_cells_where(|cell| wrong[cell]));
                fills.extend(patches.flat_map(cells));
                fills
            }
        }
    }

    /// The visible pieces of a line.
    pub(crate) fn visible(&self, ends: [Point2; 2], near: [f64; 2]) -> Vec<[Point2; 2]> {
        self.visible_on(ends, near, [true; 2])
    }

    /// The visible pieces of a silhouette line, where a surface turns away from the eye: the steep
    /// facets of that surface do not hide it.
    pub(crate) fn visible_turn(&self, ends: [Point2; 2], near: [f64; 2]) -> Vec<[Point2; 2]> {
        const STEEP: f64 = 8.0;
        self.visible_beyond(ends, near, [true; 2], STEEP * self.enough)
    }

    /// The visible pieces of a line that lies on the front of a surface, on its back, or on both.
    pub(crate) fn visible_on(
        &self,
        ends: [Point2; 2],
        near: [f64; 2],
        sides: [bool; 2],
    ) -> Vec<[Point2; 2]> {
        self.visible_beyond(ends, near, sides, self.enough)
    }

    fn visible_beyond(
        &self,
        ends: [Point2; 2],
        near: [f64; 2],
        sides: [bool; 2],
        enough: f64,
    ) -> Vec<[Point2; 2]> {
        if self.is_plain() {
            return vec![ends];
        }
        let belongs = |class: u16| sides[usize::from(!is_front(class))];
        self.raster.visible(&Line { ends, near, enough, belongs: &belongs })
    }
}

/// Whether a shade belongs to the front side of a surface.
pub(crate) fn is_front(shade: u16) -> bool {
    shade % FAINT < BACK
}

/// The shade of a part that stands back.
pub(crate) fn faint(shade: u16) -> u16 {
    FAINT + shade
}

/// The shade of a facet in a step of the colour map.
pub(crate) fn heat_shade(class: u16) -> u16 {
    HEAT + class
}

/// A shade rounded to one of a few, for surfaces that change from cell to cell: fewer shades make
/// the page smaller.
pub(crate) fn coarse_shade(shade: u16) -> u16 {
    /// The number of shades that become one.
    const TOGETHER: u16 = 4;
    shade / TOGETHER * TOGETHER + TOGETHER / 2
}

/// The shades of the faces of each panel, from their area vectors. A shade gives the visible side
/// of a face and its brightness.
pub(crate) fn shades_of(view: &View, areas: &[Vec<Vec3>]) -> Vec<Vec<u16>> {
    // The lamp is above the viewer's left shoulder.
    let lamp = unit(view.toward * 0.75 + view.up * 0.55 - view.right * 0.45).unwrap_or(Vec3::Z);
    let light = |area: &Vec3| {
        let normal = unit(*area).unwrap_or(view.toward);
        let front = normal.dot(view.toward) >= 0.0;
        let seen = if front { normal } else { -normal };
        (front, 0.5 + 0.5 * seen.dot(lamp))
    };
    let lit: Vec<Vec<(bool, f64)>> =
        areas.iter().map(|areas| areas.iter().map(light).collect()).collect();
    let all = || lit.iter().flatten().map(|l| l.1);
    let most = all().fold(0.0, f64::max);
    let least = all().fold(most - LEAST_CONTRAST, f64::min);
    let shade = |&(front, brightness): &(bool, f64)| {
        let share = (brightness - least) / (most - least);
        let shade = (((SHADES - 1) as f64 * share).round() as usize).min(SHADES - 1) as u16;
        if front { shade } else { shade + BACK }
    };
    lit.iter().map(|list| list.iter().map(shade).collect()).collect()
}

/// Joins consecutive steps to lines, without points whose absence is not visible.
pub(crate) fn joined(pieces: impl Iterator<Item = [Point2; 2]>) -> Vec<Vec<Point2>> {
    const SEEN: f64 = 0.15;
    let mut runs: Vec<Vec<Point2>> = Vec::new();
    for [from, to] in pieces {
        match runs.last_mut() {
            Some(run) if run.last() == Some(&from) => run.push(to),
            _ => runs.push(vec![from, to]),
        }
    }
    runs.iter().map(|run| simplified(run, SEEN)).collect()
}

/// A line with fewer points: every point left out lies within `off` of it.
pub(crate) fn simplified(points: &[Point2], off: f64) -> Vec<Point2> {
    /// The most consecutive points left out, since each new point checks all of them.
    const RUN: usize = 50;
    let Some((&first, rest)) = points.split_first() else { return Vec::new() };
    let mut kept = vec![first];
    let mut left: Vec<Point2> = Vec::new();
    for &point in rest {
        let from = kept[kept.len() - 1];
        let is_near = |other: &Point2| other.distance_to_segment([from, point]) <= off;
        if left.len() == RUN || !left.iter().all(is_near) {
            kept.extend(left.last());
            left.clear();
        }
        left.push(point);
    }
    kept.extend(left.last());
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simpler_line_stays_near_and_keeps_its_ends() {
        let arc = |n: u32| {
            let a = f64::from(n) / 300.0;
            Point2::new(100.0 * sheetwright::math::cos(a), 100.0 * sheetwright::math::sin(a))
        };
        let points: Vec<Point2> = (0..900).map(arc).collect();
        let few = simplified(&points, 0.15);
        assert!(few.len() < 60 && few[0] == points[0] && few.last() == points.last());
        for &point in &points {
            assert!(
                few.windows(2).any(|pair| point.distance_to_segment([pair[0], pair[1]]) <= 0.15)
            );
        }
        assert_eq!(simplified(&points[..2], 0.15), &points[..2]);
        assert_eq!(simplified(&[], 0.15), []);
    }
}
