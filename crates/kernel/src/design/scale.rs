//! A design in another size: all its lengths times a factor, so that the shape stays.

use super::{Design, PanelShape, Triangles};
use sheetwright_geometry::boundary::Within;
use sheetwright_geometry::math::{Point3, Vec3};
use std::collections::BTreeMap;
use std::sync::Arc;

impl Design {
    /// The largest extent of all points of curves and vertices of meshes along x, y or z, mm; 0
    /// without any.
    pub fn extent_mm(&self) -> f64 {
        let meshes = self.panels.iter().filter_map(|panel| match &panel.shape {
            PanelShape::Mesh(mesh) => Some(&mesh.triangles.positions),
            _ => None,
        });
        let of_curves = self.curves.iter().flat_map(|curve| &curve.points).map(|point| point.at);
        let none = (Vec3::splat(f64::INFINITY), Vec3::splat(f64::NEG_INFINITY));
        let (low, high) = meshes
            .flatten()
            .copied()
            .chain(of_curves)
            .map(Point3::to_vec)
            .fold(none, |(low, high), p| (low.min(p), high.max(p)));
        (high - low).max_element().max(0.0)
    }

    /// The design with all its lengths times a factor: points, cuts, places of marks, distances by
    /// which they may move, and limits on moving. The sheet keeps its thickness, and the paper its
    /// size.
    pub fn scaled(mut self, factor: f64) -> Self {
        let place = |p: Point3| Point3::from_vec(p.to_vec() * factor);
        for point in self.curves.iter_mut().flat_map(|curve| &mut curve.points) {
            point.at = place(point.at);
            point.move_mm *= factor;
        }
        for vary in &mut self.vary {
            vary.limit_mm = vary.limit_mm.map(|mm| mm * factor);
            vary.budget_mm = vary.budget_mm.map(|mm| mm * factor);
        }
        self.marks.iter_mut().for_each(|mark| mark.scaled(factor));
        // Panels that share triangles, or seams, share them afterwards.
        let mut known: BTreeMap<*const Triangles, Arc<Triangles>> = BTreeMap::new();
        let mut known_seams: BTreeMap<*const Vec<Vec<Point3>>, Arc<Vec<Vec<Point3>>>> =
            BTreeMap::new();
        for panel in &mut self.panels {
            panel.cut.iter_mut().for_each(|p| *p = place(*p));
            match &mut panel.shape {
                PanelShape::Mesh(mesh) => {
                    let larger = known.entry(Arc::as_ptr(&mesh.triangles)).or_insert_with(|| {
                        let mut triangles = (*mesh.triangles).clone();
                        triangles.positions.iter_mut().for_each(|p| *p = place(*p));
                        Arc::new(triangles)
                    });
                    mesh.triangles = larger.clone();
                    let larger = known_seams.entry(Arc::as_ptr(&mesh.seams)).or_insert_with(|| {
                        let way = |way: &Vec<Point3>| way.iter().copied().map(place).collect();
                        Arc::new(mesh.seams.iter().map(way).collect())
                    });
                    mesh.seams = larger.clone();
                }
                PanelShape::Join(join) => {
                    if let Within::Mm(mm) = &mut join.within {
                        *mm *= factor;
                    }
                }
                PanelShape::Rails(_) | PanelShape::Loops { .. } => {}
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::super::{DesignCurve, DesignPanel, Join, PanelMesh, Vary};
    use super::*;
    use sheetwright_geometry::boundary::Continuity;
    use sheetwright_geometry::index::VertexIndex;

    #[test]
    fn all_lengths_of_a_design_change_with_its_size() {
        let positions = [[0.0, 0.0, 1.0], [5.0, 0.0, 1.0], [0.0, 7.0, 1.0]];
        let triangles = Triangles {
            positions: positions.iter().map(|&[x, y, z]| Point3::new(x, y, z)).collect(),
            triangles: vec![[0, 1, 2].map(VertexIndex::new)],
            left_out: 0,
        };
        let seams = Arc::new(vec![triangles.positions[..2].to_vec()]);
        let mesh = PanelShape::Mesh(PanelMesh { seams, ..PanelMesh::new(triangles) });
        let join = PanelShape::Join(Join {
            parts: vec!["a".into(), "b".into()],
            smooth: Continuity::G0,
            within: Within::Mm(3.0),
            keep_parts: false,
        });
        let mut panels =
            vec![DesignPanel::new("a", mesh.clone(), 0), DesignPanel::new("b", mesh, 0)];
        panels.push(DesignPanel::new("both", join, 0));
        panels[2].cut.push(Point3::new(1.0, 2.0, 3.0));
        let mut curve = DesignCurve::spline("rim", [[-4.0, 0.0, 0.0], [0.0, 0.0, 0.0]]);
        curve.points[0].move_mm = 0.5;
        let vary = Vary { limit_mm: Some(2.0), budget_mm: Some(9.0), ..Vary::default() };
        let design = Design { curves: vec![curve], panels, vary: vec![vary], ..Design::default() };
        assert_eq!(design.extent_mm(), 9.0);
        let twice = design.clone().scaled(2.0);
        assert_eq!(twice.extent_mm(), 18.0);
        assert_eq!(twice.curves[0].points[0].move_mm, 1.0);
        assert_eq!((twice.vary[0].limit_mm, twice.vary[0].budget_mm), (Some(4.0), Some(18.0)));
        assert_eq!(twice.panels[2].cut, [Point3::new(2.0, 4.0, 6.0)]);
        let [PanelShape::Mesh(a), PanelShape::Mesh(b), PanelShape::Join(join)] =
            [0, 1, 2].map(|n| &twice.panels[n].shape)
        else {
            panic!()
        };
        assert!(Arc::ptr_eq(&a.triangles, &b.triangles) && Arc::ptr_eq(&a.seams, &b.seams));
        assert_eq!(a.seams[0], a.triangles.positions[..2]);
        assert_eq!(
            (a.triangles.positions[2], join.within),
            (Point3::new(0.0, 14.0, 2.0), Within::Mm(6.0))
        );
        assert_eq!(twice.scaled(0.5), design);
        assert_eq!(Design::default().extent_mm(), 0.0);
    }
}
