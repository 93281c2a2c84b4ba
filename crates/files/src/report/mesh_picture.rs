//! Pictures of a mesh: in space, shaded, with its border, seams and sharp creases; and laid flat,
//! coloured by how much lengths differ.

use super::canvas::{Anchor, PathData, Picture, WIDTH, circle, line, rectangle, round_below, text};
use super::flat_picture::{FOOT, LEFT, RIGHT, TOP, Tags, beside, dimensions};
use super::paint::{MOST_PATHS, Scene, is_front, joined, shades_of};
use super::raster::{Facet, Raster};
use super::space_picture::Fit;
use super::style::HEATS;
use super::view::{View, best_view, longest_direction};
use super::wording::plain_per_cent;
use sheetwright::index::{TriangleIndex, VertexIndex};
use sheetwright::make::{MadeMesh, MadeMeshes};
use sheetwright::material::{Material, stretch_limit};
use sheetwright::math::{Point2, Vec2, Vec3, from_deg};
use sheetwright::mesh::crease_angles;
use sheetwright::pattern::{PathKind, SCORED_CREASE_DEG, seam_marks};
use std::collections::{BTreeMap, BTreeSet};

/// The view is chosen by so many triangles at the most.
const LOOKED_AT: usize = 4000;
/// What lies behind a surface by less than this, in units of the picture, lies on it.
const LIES_ON: f64 = 2.0;
/// Room for the legend of the colour map, below the pattern.
const LEGEND: f64 = 58.0;
/// Below this the colour map has one colour: nothing that a workshop could measure.
pub(super) const NO_ERROR: f64 = 1e-9;

/// The surface of a mesh panel in space.
pub fn mesh_picture(panel: &MadeMesh) -> Picture {
    pictured(std::slice::from_ref(panel), format!("{} in space", panel.name))
}

/// The surfaces of all mesh panels, as they lie in space.
pub fn meshes_picture(made: &MadeMeshes) -> Picture {
    pictured(&made.panels, format!("{} in space", made.name))
}

fn pictured(panels: &[MadeMesh], title: String) -> Picture {
    let view = view_of(panels);
    let projected: Vec<Vec<Point2>> = panels
        .iter()
        .map(|panel| panel.sheet.mesh.positions().iter().map(|&p| view.project(p)).collect())
        .collect();
    let fit = Fit::new(projected.iter().flatten());
    let placed: Vec<Vec<Point2>> =
        projected.iter().map(|list| list.iter().map(|p| fit.place(*p)).collect()).collect();
    let areas: Vec<Vec<Vec3>> = panels.iter().map(areas).collect();
    let shades = shades_of(&view, &areas);
    let near = |panel: usize, v: VertexIndex| view.nearness(panels[panel].sheet.mesh.position(v));
    let facets: Vec<Facet> = (0..panels.len())
        .flat_map(|n| {
            let triangles = panels[n].sheet.mesh.triangles().iter().zip(&shades[n]);
            let (placed, near) = (&placed, &near);
            triangles.map(move |(corners, &class)| Facet {
                corners: corners.map(|v| placed[n][v.get()]),
                near: corners.map(|v| near(n, v)),
                class,
            })
        })
        .collect();
    let size = Vec2::new(WIDTH, fit.total);
    let scene = Scene::new(size, &facets, fit.millimetres(LIES_ON));
    let mut body = scene.fills();
    let mut path = PathData::default();
    for (n, panel) in panels.iter().enumerate() {
        let seen = turns(panel, &shades[n]).flat_map(|ends| {
            scene.visible_turn(ends.map(|v| placed[n][v.get()]), ends.map(|v| near(n, v)))
        });
        joined(seen).into_iter().for_each(|run| path.line(run));
    }
    body += &path.element("e thin");
    for (class, wanted) in [("score", Line::Crease), ("e", Line::Border), ("seam", Line::Seam)] {
        let mut path = PathData::default();
        for (n, panel) in panels.iter().enumerate() {
            let seen = lines(panel, wanted).into_iter().flat_map(|ends| {
                scene.visible(ends.map(|v| placed[n][v.get()]), ends.map(|v| near(n, v)))
            });
            joined(seen).into_iter().for_each(|run| path.line(run));
        }
        body += &path.element(class);
    }
    body += &fit.foot(&view);
    Picture::new(WIDTH, fit.total, title, body)
}

fn view_of(panels: &[MadeMesh]) -> View {
    let count: usize = panels.iter().map(|panel| panel.mesh.triangles().len()).sum();
    let step = count.div_ceil(LOOKED_AT).max(1);
    let mut areas: Vec<Vec3> = Vec::new();
    let mut long = Vec3::ZERO;
    for panel in panels {
        let all = 0..panel.mesh.triangles().len();
        areas.extend(all.step_by(step).map(|t| panel.mesh.area_vector(TriangleIndex::new(t))));
        let of_panel = longest_direction(panel.sheet.mesh.positions(), &panel.flat.points)
            * panel.piece.size.length();
        long += if of_panel.dot(long) < 0.0 { -of_panel } else { of_panel };
    }
    best_view(&areas, long)
}

/// The area vectors of the triangles of a panel.
fn areas(panel: &MadeMesh) -> Vec<Vec3> {
    let all = 0..panel.mesh.triangles().len();
    all.map(|t| panel.mesh.area_vector(TriangleIndex::new(t))).collect()
}

/// Where the surface turns from the eye: the edges between triangles of its front and of its back,
/// given the shades of all triangles.
fn turns<'a>(
    panel: &'a MadeMesh,
    shades: &'a [u16],
) -> impl Iterator<Item = [VertexIndex; 2]> + 'a {
    let edges = panel.sheet.mesh.edges().iter();
    let turning = edges.filter(|edge| {
        let [Some(left), Some(right)] = edge.triangles else { return false };
        is_front(shades[left.get()]) != is_front(shades[right.get()])
    });
    turning.map(|edge| edge.ends)
}

/// What is drawn of a mesh beside its triangles.
#[derive(Clone, Copy, PartialEq)]
enum Line {
    Border,
    Seam,
    Crease,
}

fn lines(panel: &MadeMesh, wanted: Line) -> Vec<[VertexIndex; 2]> {
    let mesh = &panel.sheet.mesh;
    let pairs = |side: &[VertexIndex]| -> Vec<[VertexIndex; 2]> {
        side.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    };
    match wanted {
        Line::Seam => panel.sheet.seams.iter().flat_map(|seam| pairs(&seam.sides[0])).collect(),
        Line::Border => {
            let sides = panel.sheet.seams.iter().flat_map(|seam| &seam.sides);
            let cut: BTreeSet<[VertexIndex; 2]> =
                sides.flat_map(|side| pairs(side)).map(|[a, b]| [a.min(b), a.max(b)]).collect();
            let edges = mesh.edges().iter().filter(|edge| edge.is_border());
            edges.map(|edge| edge.ends).filter(|ends| !cut.contains(ends)).collect()
        }
        Line::Crease => mesh
            .edges()
            .iter()
            .zip(crease_angles(mesh))
            .filter(|(_, angle)| *angle > from_deg(SCORED_CREASE_DEG))
            .map(|(edge, _)| edge.ends)
            .collect(),
    }
}

/// The largest error that the colour map of a panel shows: a round number above its largest.
pub(super) fn heat_top(panel: &MadeMesh) -> f64 {
    let most = panel.measures.length_error_max;
    let round = round_below(most.max(NO_ERROR));
    [1.0, 1.5, 2.0, 2.5].into_iter().map(|n| n * round).find(|&top| top >= most).unwrap_or(most)
}

/// The pattern of a mesh panel, each triangle coloured by the largest relative length error of its
/// sides, with the legend below.
pub fn heat_picture(panel: &MadeMesh, material: Option<&Material>) -> Picture {
    let size = panel.piece.size;
    let scale = (WIDTH - LEFT - RIGHT) / size.x.max(1e-12);
    let bottom = TOP + scale * size.y;
    let place = |p: Point2| Point2::new(LEFT + scale * p.x, bottom - scale * p.y);
    let mesh = &panel.sheet.mesh;
    let top = heat_top(panel);
    let exact = panel.measures.length_error_max < NO_ERROR;
    let heat = |t: usize| {
        let sides = mesh.topology().edges_of(TriangleIndex::new(t));
        let error = sides.map(|n| panel.measures.length_errors[n].abs());
        let error = error.into_iter().fold(0.0, f64::max);
        let step = (error / top * HEATS as f64) as usize;
        if exact { 0 } else { step.min(HEATS - 1) as u16 }
    };
    let corners = |t: usize| mesh.triangles()[t].map(|v| place(panel.flat.points[v.get()]));
    let name = |class: u16| format!("k{class}");
    let count = mesh.triangles().len();
    let mut body = if count > MOST_PATHS {
        let facet = |t| Facet { corners: corners(t), near: [0.0; 3], class: heat(t) };
        let facets: Vec<Facet> = (0..count).map(facet).collect();
        Raster::new(Vec2::new(WIDTH, bottom + 1.0), 1.0, &facets).elements(name)
    } else {
        let mut fills: BTreeMap<u16, PathData> = BTreeMap::new();
        (0..count).for_each(|t| fills.entry(heat(t)).or_default().ring(corners(t)));
        fills.iter().map(|(class, path)| path.element(&name(*class))).collect()
    };
    for (class, kinds) in [
        ("score", &[PathKind::Crease][..]),
        ("tick", &[PathKind::SeamTick]),
        ("cut", &[PathKind::Outline, PathKind::Hole]),
    ] {
        let mut path = PathData::default();
        for line in panel.piece.paths.iter().filter(|path| kinds.contains(&path.kind)) {
            let points = line.points.iter().map(|&p| place(p));
            if line.closed { path.ring(points) } else { path.line(points) }
        }
        body += &path.element(class);
    }
    body += &seam_tags(panel);
    if let (Some(worst), false) = (panel.worst_edge(), exact) {
        let [a, b] = mesh.edges()[worst].ends.map(|v| place(panel.flat.points[v.get()]));
        body += &circle("here", a.lerp(b, 0.5), 8.0);
    }
    body += &dimensions(size, scale, bottom);
    let legend = bottom + FOOT + 4.0;
    body += &if exact {
        let at = Point2::new(0.5 * WIDTH, legend + 16.0);
        text("", Anchor::Middle, at, "No length differs: it lies flat exactly.")
    } else {
        scale_of_colours(top, stretch_limit(material), legend)
    };
    let title = format!("{} laid flat, coloured by the error of its lengths", panel.name);
    Picture::new(WIDTH, bottom + FOOT + LEGEND, title, body)
}

/// The marks of seams and joints beside their sides, where there is room.
fn seam_tags(panel: &MadeMesh) -> String {
    let mut body = String::new();
    let mut tags = Tags::of(&panel.piece);
    let of_joints = panel.joints.iter().map(|joint| (joint.mark.clone(), &joint.steps));
    let marks = seam_marks(&panel.sheet.seams);
    let of_seams = marks.iter().map(|mark| (mark.mark.clone(), &mark.steps));
    for (mark, steps) in of_seams.chain(of_joints) {
        let at = |v: VertexIndex| panel.flat.points[v.get()];
        let Some(last) = steps.last() else { continue };
        let line: Vec<Point2> = steps.iter().map(|step| at(step[0])).chain([at(last[1])]).collect();
        let Some(at) = tags.place_free(&beside(&panel.piece, &line)) else { continue };
        body += &circle("tag", at, 10.5);
        body += &text("letter", Anchor::Middle, Point2::new(at.x, at.y + 4.5), &mark);
    }
    body
}

/// The colours with the errors that they stand for; a line marks what the material takes.
fn scale_of_colours(top: f64, limit: f64, y: f64) -> String {
    let (left, width) = (LEFT, WIDTH - LEFT - RIGHT);
    let step = width / HEATS as f64;
    let mut body = String::new();
    for n in 0..HEATS {
        let mut path = PathData::default();
        let at = |dx: f64, dy: f64| Point2::new(left + (n as f64 + dx) * step, y + dy);
        path.ring([at(0.0, 0.0), at(1.0, 0.0), at(1.0, 14.0), at(0.0, 14.0)]);
        body += &path.element(&format!("k{n}"));
    }
    body += &rectangle("frame", Point2::new(left, y), Vec2::new(width, 14.0));
    for (share, anchor) in [(0.0, Anchor::Start), (0.5, Anchor::Middle), (1.0, Anchor::End)] {
        let at = Point2::new(left + share * width, y + 30.0);
        let label = if share == 0.0 { "0".to_owned() } else { plain_per_cent(share * top) };
        body += &text("", anchor, at, &label);
    }
    let what = Point2::new(left + 0.5 * width, y + 48.0);
    body += &text("quiet", Anchor::Middle, what, "difference of lengths, flat against space");
    if limit < top {
        let x = left + limit / top * width;
        body += &line("limit", &[Point2::new(x, y - 5.0), Point2::new(x, y + 19.0)]);
    }
    body
}
