//! A panel as it lies in a picture.

use super::paint::is_front;
use super::raster::Facet;
use super::view::View;
use sheetwright::index::{SampleIndex, TriangleIndex};
use sheetwright::make::MadePanel;
use sheetwright::math::{Point2, Vec3};

/// A panel as it lies in the picture.
pub(super) struct Part<'a> {
    pub(super) panel: &'a MadePanel,
    /// Where its samples lie in the picture.
    pub(super) points: Vec<Point2>,
    /// How near to the eye they are.
    near: Vec<f64>,
    /// The class of every rung that is drawn.
    pub(super) rungs: Vec<Option<&'static str>>,
}

impl<'a> Part<'a> {
    pub(super) fn new(
        panel: &'a MadePanel,
        view: &View,
        points: Vec<Point2>,
        rungs: Vec<Option<&'static str>>,
    ) -> Self {
        let near = panel.surface.positions().iter().map(|&p| view.nearness(p)).collect();
        Self { panel, points, near, rungs }
    }

    /// The area vectors of its triangles.
    pub(super) fn areas(&self) -> Vec<Vec3> {
        let count = self.panel.surface.connectivity().triangles().len();
        (0..count).map(|n| self.panel.surface.area_vector(TriangleIndex::new(n))).collect()
    }

    /// Its triangles in their shades.
    pub(super) fn facets<'b>(&'b self, shades: &'b [u16]) -> impl Iterator<Item = Facet> + 'b {
        let triangles = self.panel.surface.connectivity().triangles();
        triangles.iter().zip(shades).map(|(corners, &class)| Facet {
            corners: corners.map(|s| self.points[s.get()]),
            near: corners.map(|s| self.near[s.get()]),
            class,
        })
    }

    /// Where the ends of a line lie, and how near they are.
    pub(super) fn line(&self, ends: [SampleIndex; 2]) -> ([Point2; 2], [f64; 2]) {
        (ends.map(|s| self.points[s.get()]), ends.map(|s| self.near[s.get()]))
    }

    /// The rungs of a class, each with its ends and whether it lies on the front and on the back,
    /// given the shades of the triangles.
    pub(super) fn rungs_of<'b>(
        &'b self,
        class: &'static str,
        shades: &'b [u16],
    ) -> impl Iterator<Item = ([SampleIndex; 2], [bool; 2])> + 'b {
        let rungs = self.panel.measures.rungs.iter().zip(&self.rungs).enumerate();
        let of_class = rungs.filter(move |(_, (_, c))| **c == Some(class));
        of_class.map(|(n, (rung, _))| (rung.rung.ends(), self.sides(n, shades)))
    }

    /// Where the surface turns from the eye: the rungs between its front and its back.
    pub(super) fn turns<'b>(
        &'b self,
        shades: &'b [u16],
    ) -> impl Iterator<Item = [SampleIndex; 2]> + 'b {
        let hinges = self.panel.surface.connectivity().hinges().iter().enumerate();
        let turning = hinges.filter(|(n, _)| self.sides(*n, shades) == [true; 2]);
        turning.map(|(_, hinge)| hinge.rung.ends())
    }

    /// The rungs along which the sheet is cut open, by their ends.
    pub(super) fn cuts(&self) -> impl Iterator<Item = [SampleIndex; 2]> + '_ {
        self.panel.sheet.seams().iter().map(|seam| seam.rung.ends())
    }

    fn sides(&self, rung: usize, shades: &[u16]) -> [bool; 2] {
        let of = self.panel.surface.connectivity().hinges()[rung].triangles;
        let front = of.map(|t| is_front(shades[t.get()]));
        [front[0] || front[1], !front[0] || !front[1]]
    }
}
