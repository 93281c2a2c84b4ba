//! A document in another size.

use super::Document;
use sheetwright::curve::MAX_COORDINATE_MM;
use sheetwright::design::PanelShape;
use sheetwright::math::{Point2, Point3};
use sheetwright::mesh::MAX_MESH_COORDINATE_MM;

/// The document with all its lengths times a factor: the design, the picture under it and the line
/// that both sides are alike of. The grid stays, and so do the sheet and its paper.
pub(super) fn scaled(document: &Document, factor: f64) -> Result<Document, String> {
    if !(factor.is_finite() && factor > 0.0) {
        return Err("The drawing has no size that could change.".to_owned());
    }
    let mut next = document.clone();
    next.design = next.design.scaled(factor);
    if let Some(mirror) = &mut next.drawing.mirror {
        mirror.at_mm *= factor;
    }
    if let Some(picture) = &mut next.drawing.reference {
        let Point2 { x, y } = picture.centre;
        picture.centre = Point2::new(x * factor, y * factor);
        picture.mm_per_pixel *= factor;
    }
    if is_within_reach(&next) {
        Ok(next)
    } else {
        Err("So large, the drawing would lie farther out than a file can say.".to_owned())
    }
}

/// Whether all of it lies where files hold coordinates.
fn is_within_reach(document: &Document) -> bool {
    let within = |p: &Point3, most: f64| [p.x, p.y, p.z].iter().all(|c| c.abs() <= most);
    let meshes = document.design.panels.iter().all(|panel| match &panel.shape {
        PanelShape::Mesh(mesh) => {
            mesh.triangles.positions.iter().all(|p| within(p, MAX_MESH_COORDINATE_MM))
        }
        _ => true,
    });
    let mut points = document.design.curves.iter().flat_map(|curve| &curve.points);
    meshes
        && points.all(|point| within(&point.at, MAX_COORDINATE_MM))
        && document.out_of_range().is_none()
}
