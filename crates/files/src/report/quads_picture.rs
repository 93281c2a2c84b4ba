//! A panel in planar quads, in space: shaded faces with their sides and the border.

use super::canvas::{PathData, Picture, WIDTH};
use super::paint::fill_elements;
use super::space_picture::Fit;
use crate::space::{Facet, LIES_ON, Scene, joined, shades_of, view_of};
use sheetwright::make::Part;
use sheetwright::math::{Point2, Vec2, Vec3};
use sheetwright::quads::QuadMesh;
use std::collections::BTreeMap;

/// The quads of a panel in space.
pub fn quads_picture(part: &Part, quads: &QuadMesh) -> Picture {
    let view = view_of(std::slice::from_ref(part));
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
    let near = |v: usize| view.nearness(positions[v]);
    let placed: Vec<Point2> = projected.iter().map(|p| fit.place(*p)).collect();
    let fans = faces.iter().zip(&shades[0]).flat_map(|(face, &class)| {
        let fan = face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]);
        fan.map(move |corners| (corners, class))
    });
    let facets: Vec<Facet> = fans
        .map(|(v, class)| Facet { corners: v.map(|v| placed[v]), near: v.map(near), class })
        .collect();
    let size = Vec2::new(WIDTH, fit.total);
    let scene = Scene::new(size, &facets, fit.millimetres(LIES_ON));
    let mut body = fill_elements(&scene.fills());
    let sides = faces
        .iter()
        .flat_map(|face| (0..face.len()).map(|n| [face[n], face[(n + 1) % face.len()]]));
    // Every side once: one of a single face is the border.
    let mut faces_of: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    sides.for_each(|[a, b]| *faces_of.entry([a.min(b), a.max(b)]).or_default() += 1);
    let (border, rulings): (Vec<_>, Vec<_>) = faces_of.into_iter().partition(|side| side.1 == 1);
    for (class, sides) in [("r", rulings), ("e", border)] {
        let mut path = PathData::default();
        let seen = sides
            .into_iter()
            .flat_map(|(ends, _)| scene.visible(ends.map(|v| placed[v]), ends.map(near)));
        joined(seen).into_iter().for_each(|run| path.line(run));
        body += &path.element(class);
    }
    body += &fit.foot(&view);
    Picture::new(WIDTH, fit.total, format!("{} in planar quads", part.name), body)
}
