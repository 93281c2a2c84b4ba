//! Pictures of a mesh: in space, shaded, with its border, seams and sharp creases; and laid flat,
//! coloured by how much lengths differ.

use super::canvas::{Anchor, PathData, Picture, WIDTH, circle, line, rectangle, round_below, text};
use super::cells::Cells;
use super::flat_picture::{FOOT, LEFT, RIGHT, TOP, dimensions};
use super::space_picture::Fit;
use super::style::{HEATS, SHADES};
use super::view::{View, best_view, longest_direction};
use super::wording::plain_per_cent;
use sheetwright::design::{MadeMesh, MadeMeshes};
use sheetwright::index::{TriangleIndex, VertexIndex};
use sheetwright::material::{Material, stretch_limit};
use sheetwright::math::{Point2, Vec2, Vec3, from_deg, unit};
use sheetwright::mesh::crease_angles;
use sheetwright::pattern::{PathKind, SCORED_CREASE_DEG, seam_marks};
use std::collections::{BTreeMap, BTreeSet};

/// A mesh of more triangles is drawn in cells: by then they are smaller than its lines are thick.
const MOST_PATHS: usize = 12_000;
/// The view is chosen by so many triangles at the most.
const LOOKED_AT: usize = 4000;
/// What hides a line lies before it by more than this share of the picture's size.
const BEHIND: f64 = 0.012;
/// The least difference of brightness that the shades are spread over.
const LEAST_CONTRAST: f64 = 0.18;
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
    let mut cells = Cells::new(Vec2::new(WIDTH, fit.total));
    let shades = shades(&view, panels);
    let near = |panel: usize, v: VertexIndex| view.nearness(panels[panel].sheet.mesh.position(v));
    let mut facets: Vec<(f64, usize, usize)> = Vec::new();
    for (n, panel) in panels.iter().enumerate() {
        for (t, corners) in panel.sheet.mesh.triangles().iter().enumerate() {
            let depths = corners.map(|v| near(n, v));
            cells.triangle(corners.map(|v| placed[n][v.get()]), depths, shades[n][t]);
            facets.push((depths.iter().sum(), n, t));
        }
    }
    // Large triangles that hide one another have no order from far to near that is right all over.
    let hides = shades.iter().flatten().any(|&shade| shade >= 100);
    let mut body = if hides || facets.len() > MOST_PATHS {
        cells.elements(shade_name)
    } else {
        facets.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        painted(
            &facets,
            |n, t| {
                let corners = panels[n].sheet.mesh.triangles()[t];
                (shades[n][t], corners.map(|v| placed[n][v.get()]))
            },
            shade_name,
        )
    };
    let depths = (0..panels.len()).flat_map(|n| {
        let count = panels[n].sheet.mesh.positions().len();
        (0..count).map(move |v| (n, VertexIndex::new(v)))
    });
    let span = depths
        .map(|(n, v)| near(n, v))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |s, d| [s[0].min(d), s[1].max(d)]);
    // A picture that is flat has no depth, but what lies in it is still seen.
    let width = fit.millimetres(WIDTH);
    let enough = BEHIND * width.max(span[1] - span[0]);
    for (class, wanted) in [("score", Line::Crease), ("e", Line::Border), ("seam", Line::Seam)] {
        let mut path = PathData::default();
        for (n, panel) in panels.iter().enumerate() {
            for ends in lines(panel, wanted) {
                let at = ends.map(|v| placed[n][v.get()]);
                for piece in cells.visible(at, ends.map(|v| near(n, v)), enough) {
                    path.line(piece);
                }
            }
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

fn shades(view: &View, panels: &[MadeMesh]) -> Vec<Vec<u16>> {
    let areas = panels.iter().map(|panel| {
        let all = 0..panel.mesh.triangles().len();
        all.map(|t| panel.mesh.area_vector(TriangleIndex::new(t))).collect()
    });
    shades_of(view, &areas.collect::<Vec<_>>())
}

/// The class of a shade.
pub(super) fn shade_name(shade: u16) -> String {
    let (side, n) = if shade < 100 { ('f', shade) } else { ('b', shade - 100) };
    format!("{side}{n}")
}

/// The shades of faces, given by the area vectors of those of each panel; 100 is added to those that
/// show their other side.
pub(super) fn shades_of(view: &View, areas: &[Vec<Vec3>]) -> Vec<Vec<u16>> {
    // A lamp above the left shoulder.
    let lamp = unit(view.toward * 0.75 + view.up * 0.55 - view.right * 0.45).unwrap_or(Vec3::Z);
    let light = |area: &Vec3| {
        let normal = unit(*area).unwrap_or(view.toward);
        let front = normal.dot(view.toward) >= 0.0;
        let seen = if front { normal } else { -normal };
        (front, 0.5 + 0.5 * seen.dot(lamp))
    };
    let lit: Vec<Vec<(bool, f64)>> =
        areas.iter().map(|areas| areas.iter().map(light).collect()).collect();
    let all = || lit.iter().flatten().map(|l| l.1);
    let most = all().fold(0.0, f64::max);
    let least = all().fold(most - LEAST_CONTRAST, f64::min);
    let shade = |&(front, brightness): &(bool, f64)| {
        let share = (brightness - least) / (most - least);
        let shade = (((SHADES - 1) as f64 * share).round() as usize).min(SHADES - 1) as u16;
        if front { shade } else { shade + 100 }
    };
    lit.iter().map(|list| list.iter().map(shade).collect()).collect()
}

/// Triangles from far to near, neighbours of one class in one path.
fn painted(
    facets: &[(f64, usize, usize)],
    of: impl Fn(usize, usize) -> (u16, [Point2; 3]),
    name: impl Fn(u16) -> String,
) -> String {
    let mut body = String::new();
    let (mut last, mut run) = (0, PathData::default());
    for &(_, n, t) in facets {
        let (class, corners) = of(n, t);
        if class != last {
            body += &std::mem::take(&mut run).element(&name(last));
            last = class;
        }
        run.ring(corners);
    }
    body + &run.element(&name(last))
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
        let mut cells = Cells::new(Vec2::new(WIDTH, bottom + 1.0));
        (0..count).for_each(|t| cells.triangle(corners(t), [0.0; 3], heat(t)));
        cells.elements(name)
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
    body += &seam_tags(panel, place);
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

/// The marks of seams and joints on their sides, until they would lie on one another.
fn seam_tags(panel: &MadeMesh, place: impl Fn(Point2) -> Point2) -> String {
    const APART: f64 = 24.0;
    let mut body = String::new();
    let mut taken: Vec<Point2> = Vec::new();
    let of_joints = panel.joints.iter().map(|joint| (joint.mark.clone(), &joint.steps));
    let marks = seam_marks(&panel.sheet.seams);
    let of_seams = marks.iter().map(|mark| (mark.mark.clone(), &mark.steps));
    for (mark, steps) in of_seams.chain(of_joints) {
        let at = |v: VertexIndex| place(panel.flat.points[v.get()]);
        let Some([a, b]) = steps.get(steps.len() / 2) else { continue };
        // An odd number of steps has its middle on one of them, an even one between two.
        let middle = if steps.len() % 2 == 1 { at(*a).lerp(at(*b), 0.5) } else { at(*a) };
        if taken.iter().any(|other| other.distance(middle) < APART) {
            continue;
        }
        taken.push(middle);
        body += &circle("tag", middle, 10.5);
        let below = Point2::new(middle.x, middle.y + 4.5);
        body += &text("letter", Anchor::Middle, below, &mark);
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
