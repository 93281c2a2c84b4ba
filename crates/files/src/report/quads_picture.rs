//! A panel in planar quads, in space: shaded faces with their sides.

use super::canvas::{PathData, Picture, WIDTH};
use super::mesh_picture::{shade_name, shades_of};
use super::space_picture::Fit;
use super::view::view_of;
use sheetwright::design::MadePanel;
use sheetwright::math::{Point2, Vec3};
use sheetwright::quads::QuadMesh;

/// The quads of a panel in space.
pub fn quads_picture(panel: &MadePanel, quads: &QuadMesh) -> Picture {
    let view = view_of(std::slice::from_ref(panel));
    let positions = quads.positions();
    let projected: Vec<Point2> = positions.iter().map(|&p| view.project(p)).collect();
    let fit = Fit::new(projected.iter());
    let faces: Vec<&[usize]> = quads.faces().collect();
    let area = |face: &&[usize]| -> Vec3 {
        let first = positions[face[0]];
        let fan = face.windows(2).map(|pair| [pair[0], pair[1]].map(|v| positions[v] - first));
        fan.map(|[a, b]| a.cross(b) * 0.5).sum()
    };
    let shades = shades_of(&view, &[faces.iter().map(area).collect()]);
    let depth = |face: &[usize]| {
        face.iter().map(|&v| view.nearness(positions[v])).sum::<f64>() / face.len() as f64
    };
    // From far to near, each with its sides, so that what lies before them hides them.
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|&a, &b| depth(faces[a]).total_cmp(&depth(faces[b])).then(a.cmp(&b)));
    let mut body = String::new();
    for n in order {
        let mut path = PathData::default();
        path.ring(faces[n].iter().map(|&v| fit.place(projected[v])));
        body += &path.element(&shade_name(shades[0][n]));
        body += &path.element("r");
    }
    body += &fit.foot(&view);
    Picture::new(WIDTH, fit.total, format!("{} in planar quads", panel.name), body)
}
