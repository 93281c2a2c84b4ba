//! A pattern whose triangles are coloured: a mesh by the relative length error, and a panel by the
//! strain that its sheet has in its shape.

use super::canvas::{Anchor, PathData, Picture, WIDTH, circle, line, rectangle, round_below, text};
use super::flat_picture::{
    FOOT, LEFT, RIGHT, TOP, Tags, beside, dimensions, in_picture, scale_of, trims,
};
use super::paint::cells_element;
use super::style::HEATS;
use crate::space::{Facet, MOST_PATHS, Raster};
use crate::wording::plain_per_cent;
use sheetwright::index::{TriangleIndex, VertexIndex};
use sheetwright::make::{Given, Part};
use sheetwright::material::{Material, stretch_limit};
use sheetwright::math::{Point2, Vec2};
use sheetwright::measure::Distortion;
use sheetwright::pattern::{PathKind, seam_marks};
use std::collections::BTreeMap;

/// Room for the legend of the colour map, below the pattern.
const LEGEND: f64 = 58.0;
/// Below this the colour map has one colour: nothing that a workshop could measure.
pub(super) const NO_ERROR: f64 = 1e-9;

/// The top of the colour map for a largest error `most`: a round number that is not below it.
pub(super) fn heat_top(most: f64) -> f64 {
    let round = round_below(most.max(NO_ERROR));
    [1.0, 1.5, 2.0, 2.5].into_iter().map(|n| n * round).find(|&top| top >= most).unwrap_or(most)
}

/// The step of the colour map up to `top` for a share.
pub(super) fn heat_class(share: f64, top: f64) -> u16 {
    ((share / top * HEATS as f64) as usize).min(HEATS - 1) as u16
}

/// Rings round places of a picture, each with its words beside it, but where they would lie on
/// those of an earlier one.
pub(super) fn named(places: impl Iterator<Item = (Point2, String)>) -> String {
    const RING: f64 = 8.0;
    /// About how wide a letter is, and how high a line.
    const LETTER: Vec2 = Vec2::new(7.5, 16.0);
    let mut body = String::new();
    let mut taken: Vec<[Point2; 2]> = Vec::new();
    for (at, words) in places {
        body += &circle("here", at, RING);
        let (away, width) = (RING + 4.0, LETTER.x * words.chars().count() as f64);
        let is_left = at.x + away + width > WIDTH;
        let (anchor, way) = if is_left { (Anchor::End, -1.0) } else { (Anchor::Start, 1.0) };
        let left = at.x + way * away - if is_left { width } else { 0.0 };
        let room = [Point2::new(left, at.y), Point2::new(left + width, at.y + LETTER.y)];
        let is_free = |[low, high]: &[Point2; 2]| {
            high.x < room[0].x || low.x > room[1].x || high.y < room[0].y || low.y > room[1].y
        };
        if taken.iter().all(is_free) {
            let word = Point2::new(at.x + way * away, at.y + 4.5);
            body += &text("halo", anchor, word, &words);
            taken.push(room);
        }
    }
    body
}

/// The pattern of a mesh, each triangle coloured by the largest relative length error of its sides,
/// with the legend below.
pub(super) fn heat_picture(
    panel: &Part,
    given: &Given,
    distortion: &Distortion,
    material: Option<&Material>,
) -> Picture {
    let mesh = panel.sheet.mesh();
    let share = |t: usize| {
        let sides = mesh.topology().edges_of(TriangleIndex::new(t));
        let error = sides.map(|n| distortion.length_errors[n].abs());
        error.into_iter().fold(0.0, f64::max)
    };
    let count = mesh.triangles().len();
    let corners = |t: &[VertexIndex; 3]| t.map(|v| panel.flat.points[v.get()]);
    let heat = Heat {
        panel,
        triangles: mesh.triangles().iter().map(corners).collect(),
        shares: (0..count).map(share).collect(),
        worst: distortion.worst_edge().map_or(Vec::new(), |n| {
            let [a, b] = mesh.edges()[n].ends.map(|v| panel.flat.points[v.get()]);
            vec![(a.lerp(b, 0.5), distortion.length_errors[n].abs())]
        }),
        title: format!("{} laid flat, coloured by the error of its lengths", panel.name),
        meaning: "difference of lengths, flat against space",
        nothing: "No length differs: it lies flat exactly.",
        limit: stretch_limit(material),
    };
    heat.drawn(&seam_tags(panel, given))
}

/// The pattern of a panel as its sheet rests in its shape, coloured by the strain in the plane;
/// `None` where no sheet was computed.
pub(super) fn strain_picture(panel: &Part) -> Option<Picture> {
    let predicted = panel.predicted.as_ref()?;
    let sheet = predicted.at_rest.as_ref()?;
    let triangles: Vec<[Point2; 3]> =
        sheet.triangles.iter().map(|t| t.map(|n| sheet.flat[n])).collect();
    let middle = |[a, b, c]: [Point2; 3]| a + ((b - a) + (c - a)) / 3.0;
    let worst = sheet.most_strained_triangles().into_iter();
    let heat = Heat {
        panel,
        worst: worst.map(|n| (middle(triangles[n]), sheet.strains[n])).collect(),
        triangles,
        shares: sheet.strains.clone(),
        title: format!("{} laid flat, coloured by its strain in its shape", panel.name),
        meaning: "strain within the plane of the sheet, in its shape",
        nothing: "The sheet is not strained.",
        limit: predicted.limits.strain,
    };
    Some(heat.drawn(""))
}

/// A pattern whose triangles are coloured by a share.
struct Heat<'a> {
    panel: &'a Part,
    /// The triangles on the pattern, mm, each with its share.
    triangles: Vec<[Point2; 3]>,
    shares: Vec<f64>,
    /// Where the share is largest, mm, each place with its share.
    worst: Vec<(Point2, f64)>,
    title: String,
    /// The meaning of the share, below the colours.
    meaning: &'static str,
    /// The words in place of the colours where no share is above [`NO_ERROR`].
    nothing: &'static str,
    /// The share that the sheet takes.
    limit: f64,
}

impl Heat<'_> {
    /// The picture, with tags.
    fn drawn(&self, tags: &str) -> Picture {
        let size = self.panel.piece.size;
        let scale = scale_of(&self.panel.piece);
        let bottom = TOP + scale * size.y;
        let place = |p: Point2| in_picture(&self.panel.piece, p);
        let most = self.shares.iter().copied().fold(0.0, f64::max);
        let top = heat_top(most);
        let exact = most < NO_ERROR;
        let class = |t: usize| if exact { 0 } else { heat_class(self.shares[t], top) };
        let corners = |t: usize| self.triangles[t].map(place);
        let name = |class: u16| format!("k{class}");
        let count = self.triangles.len();
        let mut body: String = if count > MOST_PATHS {
            let facet = |t| Facet { corners: corners(t), near: [0.0; 3], class: class(t) };
            let facets: Vec<Facet> = (0..count).map(facet).collect();
            let raster = Raster::new(Vec2::new(WIDTH, bottom + 1.0), 1.0, &facets);
            let rows = raster.rows_of_cells().into_iter();
            rows.map(|(class, rows)| cells_element(&name(class), &rows)).collect()
        } else {
            let mut fills: BTreeMap<u16, PathData> = BTreeMap::new();
            (0..count).for_each(|t| fills.entry(class(t)).or_default().ring(corners(t)));
            fills.iter().map(|(class, path)| path.element(&name(*class))).collect()
        };
        for (class, kinds) in [
            ("score", &[PathKind::Crease, PathKind::MOUNTAIN, PathKind::VALLEY][..]),
            ("tick", &[PathKind::SeamTick]),
            ("cut", &[PathKind::Outline, PathKind::Hole]),
        ] {
            let mut path = PathData::default();
            for line in self.panel.piece.paths.iter().filter(|path| kinds.contains(&path.kind)) {
                let points = line.points.iter().map(|&p| place(p));
                if line.closed { path.ring(points) } else { path.line(points) }
            }
            body += &path.element(class);
        }
        body += &trims(&self.panel.piece, place);
        body += tags;
        if !exact {
            body +=
                &named(self.worst.iter().map(|&(at, share)| (place(at), plain_per_cent(share))));
        }
        body += &dimensions(size, scale, bottom);
        let legend = bottom + FOOT + 4.0;
        body += &if exact {
            let at = Point2::new(0.5 * WIDTH, legend + 16.0);
            text("", Anchor::Middle, at, self.nothing)
        } else {
            scale_of_colours(top, self.limit, self.meaning, legend)
        };
        Picture::new(WIDTH, bottom + FOOT + LEGEND, self.title.clone(), body)
    }
}

/// The marks of seams and joints beside their sides, where there is room.
fn seam_tags(panel: &Part, given: &Given) -> String {
    let mut body = String::new();
    let mut tags = Tags::of(&panel.piece);
    let of_joints = given.joints.iter().map(|joint| (joint.mark.clone(), &joint.steps));
    let marks = seam_marks(&panel.sheet);
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

/// The colours with their errors; a line marks the limit of the material.
fn scale_of_colours(top: f64, limit: f64, meaning: &str, y: f64) -> String {
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
    body += &text("quiet", Anchor::Middle, what, meaning);
    if limit < top {
        let x = left + limit / top * width;
        body += &line("limit", &[Point2::new(x, y - 5.0), Point2::new(x, y + 19.0)]);
    }
    body
}
