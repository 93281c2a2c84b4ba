//! Painting the visible parts of surfaces: shaded triangles, and the parts of lines that no
//! triangle hides.

use super::canvas::{PathData, simplified};
use super::order::{Order, order};
use super::raster::{Facet, Line, Raster};
use super::style::SHADES;
use super::view::View;
use sheetwright::math::{Point2, Vec2, Vec3, unit};
use std::collections::BTreeMap;

/// The most triangles drawn as paths. More are drawn in cells, since they are smaller than the
/// thickness of their lines.
pub(super) const MOST_PATHS: usize = 12_000;
/// Cells per unit of the picture, which is about a pixel of a page.
const PER_UNIT: f64 = 1.0;
/// The least range of brightness over which the shades are spread. A surface with a smaller range
/// is nearly flat, and may look flat.
const LEAST_CONTRAST: f64 = 0.18;
/// The offset of the numbers of the shades of the back side.
const BACK: u16 = 100;
/// The offset of the numbers of the steps of the colour map.
const HEAT: u16 = 200;

/// Painted triangles, and the visibility of lines among them.
pub(super) struct Scene<'a> {
    raster: Raster<'a>,
    order: Option<Order>,
    /// A triangle hides a line only if it is nearer by more than this.
    enough: f64,
}

impl<'a> Scene<'a> {
    /// Facets in a picture of a size. A line that lies behind a facet by less than `enough` is
    /// visible.
    pub(super) fn new(size: Vec2, facets: &'a [Facet], enough: f64) -> Self {
        let raster = Raster::new(size, PER_UNIT, facets);
        let order = (facets.len() <= MOST_PATHS).then(|| order(&raster));
        Self { raster, order, enough }
    }

    /// Whether no facet hides anything, so that every line is visible all along.
    pub(super) fn is_plain(&self) -> bool {
        self.order == Some(Order::Any)
    }

    /// All triangles, each in the class of its shade.
    pub(super) fn fills(&self) -> String {
        let facets = self.raster.facets;
        match &self.order {
            None => self.raster.elements(shade_name),
            // Those of one shade are one path, which makes the page small.
            Some(Order::Any) => {
                let mut fills: BTreeMap<u16, PathData> = BTreeMap::new();
                for facet in facets {
                    fills.entry(facet.class).or_default().ring(facet.corners);
                }
                fills.iter().map(|(class, path)| path.element(&shade_name(*class))).collect()
            }
            Some(Order::Of(list, wrong)) => {
                let mut body = String::new();
                let (mut class, mut run) = (0, PathData::default());
                for facet in list.iter().map(|&n| &facets[n]) {
                    if class != facet.class {
                        body += &std::mem::take(&mut run).element(&shade_name(class));
                        class = facet.class;
                    }
                    run.ring(facet.corners);
                }
                body += &run.element(&shade_name(class));
                let patches = wrong
                    .as_ref()
                    .map(|wrong| self.raster.elements_where(|cell| wrong[cell], shade_name));
                body + &patches.unwrap_or_default()
            }
        }
    }

    /// The visible pieces of a line.
    pub(super) fn visible(&self, ends: [Point2; 2], near: [f64; 2]) -> Vec<[Point2; 2]> {
        self.visible_on(ends, near, [true; 2])
    }

    /// The visible pieces of a silhouette line, where a surface turns away from the eye: the steep
    /// facets of that surface do not hide it.
    pub(super) fn visible_turn(&self, ends: [Point2; 2], near: [f64; 2]) -> Vec<[Point2; 2]> {
        const STEEP: f64 = 8.0;
        self.visible_beyond(ends, near, [true; 2], STEEP * self.enough)
    }

    /// The visible pieces of a line that lies on the front of a surface, on its back, or on both.
    pub(super) fn visible_on(
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
pub(super) fn is_front(shade: u16) -> bool {
    shade < BACK
}

/// The shade of a facet in a step of the colour map.
pub(super) fn heat_shade(class: u16) -> u16 {
    HEAT + class
}

/// The class of a shade.
pub(super) fn shade_name(shade: u16) -> String {
    match shade {
        HEAT.. => format!("k{}", shade - HEAT),
        BACK.. => format!("b{}", shade - BACK),
        _ => format!("f{shade}"),
    }
}

/// A shade rounded to one of a few, for surfaces that change from cell to cell: fewer shades make
/// the page smaller.
pub(super) fn coarse_shade(shade: u16) -> u16 {
    /// The number of shades that become one.
    const TOGETHER: u16 = 4;
    shade / TOGETHER * TOGETHER + TOGETHER / 2
}

/// The shades of the faces of each panel, from their area vectors. A shade gives the visible side
/// of a face and its brightness.
pub(super) fn shades_of(view: &View, areas: &[Vec<Vec3>]) -> Vec<Vec<u16>> {
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
pub(super) fn joined(pieces: impl Iterator<Item = [Point2; 2]>) -> Vec<Vec<Point2>> {
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
