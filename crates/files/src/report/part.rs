//! A panel as it lies in a picture.

use sheetwright::design::MadePanel;
use sheetwright::index::{SampleIndex, TriangleIndex};
use sheetwright::math::Point2;

/// A panel as it lies in the picture.
pub(super) struct Part<'a> {
    pub(super) panel: &'a MadePanel,
    /// Where its samples lie in the picture.
    pub(super) points: Vec<Point2>,
    /// The class of every rung that is drawn.
    pub(super) rungs: Vec<Option<&'static str>>,
}

impl Part<'_> {
    pub(super) fn corners(&self, triangle: TriangleIndex) -> [Point2; 3] {
        let corners = self.panel.surface.connectivity().triangles()[triangle.get()];
        corners.map(|s| self.points[s.get()])
    }

    /// The rungs of a class, by their samples.
    pub(super) fn rungs_of(
        &self,
        class: &'static str,
    ) -> impl Iterator<Item = [SampleIndex; 2]> + '_ {
        let rungs = self.panel.measures.rungs.iter().zip(&self.rungs);
        rungs.filter(move |(_, c)| **c == Some(class)).map(|(rung, _)| rung.rung.ends())
    }
}
