//! The sheet at rest in space, coloured by the strain in its plane: beside the picture on the
//! pattern, with the colours and the scale of that.

use super::canvas::{PathData, Picture, WIDTH};
use super::heat_picture::{NO_ERROR, heat_class, heat_top, named};
use super::paint::fill_elements;
use super::space_picture::Fit;
use crate::space::{Drawn, Facet, LIES_ON, Scene, Solid, heat_shade, joined, view_of};
use crate::wording::plain_per_cent;
use sheetwright::make::Part;
use sheetwright::math::{Point2, Point3, Vec2};

/// The sheet of a part as it rests in its shape, with the places that are strained most; `None`
/// where no sheet was computed, or none is strained.
pub(super) fn strain_in_space(part: &Part) -> Option<Picture> {
    let sheet = part.predicted.as_ref()?.at_rest.as_ref()?;
    let most = sheet.strains.iter().copied().fold(0.0, f64::max);
    if most < NO_ERROR {
        return None;
    }
    let top = heat_top(most);
    let view = view_of(std::slice::from_ref(part));
    let project = |points: &[Point3]| points.iter().map(|&p| view.project(p)).collect();
    let nodes: Vec<Point2> = project(&sheet.positions);
    let solid = Solid::of(part, None);
    let samples: Vec<Point2> = project(&solid.positions);
    let fit = Fit::new(nodes.iter().chain(&samples));
    let facet = |(corners, &strain): (&[usize; 3], &f64)| Facet {
        corners: corners.map(|n| fit.place(nodes[n])),
        near: corners.map(|n| view.nearness(sheet.positions[n])),
        class: heat_shade(heat_class(strain, top)),
    };
    let facets: Vec<Facet> = sheet.triangles.iter().zip(&sheet.strains).map(facet).collect();
    let scene = Scene::new(Vec2::new(WIDTH, fit.total), &facets, fit.millimetres(LIES_ON));
    let mut body = fill_elements(&scene.fills());
    let points = samples.iter().map(|&p| fit.place(p)).collect();
    let border = Drawn::new(solid, &view, points);
    let lines = border.solid.border.iter().map(|&step| border.line(step));
    let mut path = PathData::default();
    let pieces = lines.flat_map(|(ends, near)| scene.visible(ends, near));
    joined(pieces).into_iter().for_each(|run| path.line(run));
    body += &path.element("e");
    let worst = sheet.most_strained_triangles().into_iter();
    let name = |n: usize| {
        let (at, near) = (fit.place(view.project(sheet.middle(n))), view.nearness(sheet.middle(n)));
        let is_hidden = scene.visible([at; 2], [near; 2]).is_empty();
        let behind = if is_hidden { ", behind" } else { "" };
        (at, plain_per_cent(sheet.strains[n]) + behind)
    };
    body += &named(worst.map(name));
    body += &fit.foot(&view);
    let title = format!("{} in space, coloured by its strain in its shape", part.name);
    Some(Picture::new(WIDTH, fit.total, title, body))
}
