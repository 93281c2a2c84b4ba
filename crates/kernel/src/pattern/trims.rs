//! A pattern with its trims, and without them again.

use super::{LabelKind, PathKind, PatternLabel, PatternPath, Piece, Role, dimension};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::Box2;
use sheetwright_geometry::region::Region;

impl PathKind {
    /// Whether a trim or a mark drew it.
    fn is_added(self) -> bool {
        let is_of_trim = matches!(self, Self::Notch | Self::TrimFold { .. } | Self::TrimTick);
        let is_of_mark = matches!(self, Self::Station | Self::Grain | Self::OnFold | Self::Arrow);
        is_of_trim || is_of_mark || matches!(self, Self::Drill { .. })
    }
}

impl Piece {
    /// Draws trims: the lines to cut, where they are not those of the net, and the lines and texts
    /// of the trims. The net stays, beside the lines to cut.
    pub(crate) fn trim(
        &mut self,
        cut: Option<Region>,
        paths: Vec<PatternPath>,
        labels: Vec<PatternLabel>,
    ) {
        if let Some(Region { outline, holes }) = cut {
            for path in &mut self.paths {
                if matches!(path.kind, PathKind::Outline | PathKind::Hole) {
                    (path.kind, path.role) = (PathKind::Net, Role::Net);
                }
            }
            let line = |role: Role, kind: PathKind, points: Vec<Point2>| PatternPath {
                role,
                kind,
                points,
                closed: true,
            };
            let holes = holes.into_iter().map(|hole| line(Role::Inner, PathKind::Hole, hole));
            let outline = line(Role::Cut, PathKind::Outline, outline);
            let cut: Vec<PatternPath> = std::iter::once(outline).chain(holes).collect();
            self.paths.splice(0..0, cut);
            self.measure();
        }
        self.paths.extend(paths);
        self.labels.extend(labels);
    }

    /// Takes all trims and marks away; texts stay where they are.
    pub(crate) fn untrim(&mut self) {
        let has_net = self.has_net();
        self.paths.retain(|path| {
            let is_cut = matches!(path.kind, PathKind::Outline | PathKind::Hole);
            !(path.kind.is_added() || has_net && is_cut)
        });
        self.labels.retain(|label| label.kind != LabelKind::Trim);
        if !has_net {
            return;
        }
        let nets = self.paths.iter_mut().filter(|path| path.kind == PathKind::Net);
        for (n, path) in nets.enumerate() {
            (path.kind, path.role) = match n {
                0 => (PathKind::Outline, Role::Cut),
                _ => (PathKind::Hole, Role::Inner),
            };
        }
        self.measure();
    }

    /// Takes the size from the outline, and draws the overall dimensions anew.
    fn measure(&mut self) {
        let around = Box2::of_points(self.outline().iter().copied());
        let Some(around) = around else { return };
        self.size = around.max - around.min;
        self.corner = around.min;
        let is_line = |path: &PatternPath| path.kind == PathKind::Dimension;
        let at = self.paths.iter().position(is_line).unwrap_or(self.paths.len());
        self.paths.retain(|path| path.kind != PathKind::Dimension);
        let is_text = |label: &PatternLabel| label.kind == LabelKind::Overall;
        let height_mm = self.labels.iter().find(|label| is_text(label)).map(|l| l.height_mm);
        let first = self.labels.iter().position(is_text).unwrap_or(0);
        self.labels.retain(|label| !is_text(label));
        let Some(height_mm) = height_mm else { return };
        let (mut paths, mut labels) = dimension::overall(self.size, height_mm);
        let by: Vec2 = around.min.to_vec();
        let moved = |p: Point2| p + by;
        paths.iter_mut().flat_map(|path| &mut path.points).for_each(|p| *p = moved(*p));
        labels.iter_mut().for_each(|label| label.at = moved(label.at));
        self.paths.splice(at..at, paths);
        self.labels.splice(first..first, labels);
    }
}
