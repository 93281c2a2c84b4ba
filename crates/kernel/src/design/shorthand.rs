//! Designs and curves in one line, as examples and small programs write them.

use super::{CurveUse, Design, DesignCurve, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright_geometry::curve::{CurveKind, CurvePoint};
use sheetwright_geometry::math::Point3;

impl DesignCurve {
    /// An open spline through points, mm.
    pub fn spline(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        Self::open(name.into(), CurveKind::Spline, points)
    }

    /// An open polyline through points, mm.
    pub fn polyline(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        Self::open(name.into(), CurveKind::Polyline, points)
    }

    fn open(name: String, kind: CurveKind, points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let point = |[x, y, z]: [f64; 3]| CurvePoint::smooth(Point3::new(x, y, z));
        let points = points.into_iter().map(point).collect();
        Self { name, kind: Some(kind), closed: false, points }
    }

    /// The curve, which ends where it begins; its last point does not repeat the first.
    #[must_use]
    pub fn closed(self) -> Self {
        Self { closed: true, ..self }
    }
}

impl Design {
    /// One panel between two rails, which may run either way, sampled by the usual
    /// tolerance. The panel and the design have this name.
    pub fn between(name: impl Into<String>, rails: [DesignCurve; 2]) -> Self {
        let uses = rails.each_ref().map(along);
        Self::of_panel(name.into(), PanelShape::Rails(uses), rails.into())
    }

    /// One panel inside closed curves, its outline and its holes, sampled by the usual tolerance.
    /// The panel and the design have this name.
    pub fn inside(name: impl Into<String>, outline: DesignCurve, holes: Vec<DesignCurve>) -> Self {
        let shape = PanelShape::Loops {
            outer: vec![along(&outline)],
            holes: holes.iter().map(|hole| vec![along(hole)]).collect(),
        };
        let curves = std::iter::once(outline).chain(holes).collect();
        Self::of_panel(name.into(), shape, curves)
    }

    /// One panel that is a mesh. The panel and the design have this name.
    pub fn of_mesh(name: impl Into<String>, triangles: Triangles) -> Self {
        let shape = PanelShape::Mesh(PanelMesh::new(triangles));
        Self::of_panel(name.into(), shape, Vec::new())
    }

    fn of_panel(name: String, shape: PanelShape, curves: Vec<DesignCurve>) -> Self {
        let panels = vec![DesignPanel::usual(name.clone(), shape)];
        Self { name, curves, panels, ..Self::default() }
    }
}

fn along(curve: &DesignCurve) -> CurveUse {
    CurveUse { name: curve.name.clone(), reversed: false }
}
