//! The flat pattern: outline, rulings, folds, overall dimensions and the lengths of its edges.

use super::canvas::{Anchor, PathData, Picture, WIDTH, circle, line, number, text};
use super::legend::legend;
use crate::space::{APART, APART_CLASSES, MOST_RUNGS, Middles, rung_classes};
use crate::wording::{millimetres, thinned};
use sheetwright::edge::{Edge, EdgeSource};
use sheetwright::index::VertexIndex;
use sheetwright::make::Part;
use sheetwright::material::Material;
use sheetwright::math::{Point2, Vec2, angle_between, from_deg, unit2};
use sheetwright::pattern::{LabelKind, PathKind, Piece, Role, seam_mark};
use sheetwright::rung::Rung;
use sheetwright::sheet::steps_of;
use std::collections::BTreeSet;

/// The margins left and right of the pattern; the chart of warp has equal ones, so that the two
/// line up.
pub(super) const LEFT: f64 = 66.0;
pub(super) const RIGHT: f64 = 34.0;
pub(super) const TOP: f64 = 32.0;
pub(super) const FOOT: f64 = 66.0;
/// The most edges with a letter; the longest have one.
const LETTERED: usize = 8;
/// The least turn of the outline at a corner, degrees. An edge of several sides is measured from
/// corner to corner.
const CORNER_DEG: f64 = 10.0;
/// The distance of a letter from its edge, and the least distance between letters.
const LETTER_AWAY: f64 = 15.0;
const LETTER_APART: f64 = 22.0;
/// The least distance of a letter's middle from lines to cut; its circle has a radius of 9.5.
const LETTER_CLEAR: f64 = 11.0;

/// The width of a letter of a text in the picture, about, and the height of a line.
const LETTER: f64 = 7.5;
const LINE: f64 = 14.0;

/// A stretch of an edge with a letter in the picture, or a side of a seam.
pub(super) struct Tagged<'a> {
    /// Its letter; of a side of a seam, the mark of the seam.
    pub(super) letter: String,
    /// The edge; `None` of a side of a seam.
    pub(super) edge: Option<&'a Edge>,
    /// Its length, mm.
    pub(super) length_mm: f64,
    /// Where its letter stands in the picture.
    at: Point2,
}

/// The scale of the pattern in the picture, in units of the picture per millimetre.
pub(super) fn scale_of(piece: &Piece) -> f64 {
    (WIDTH - LEFT - RIGHT) / piece.size.x.max(1e-12)
}

/// The flat pattern of a part whose surface was found.
pub(super) fn ruled_picture(panel: &Part, material: Option<&Material>) -> Picture {
    let (scale, size) = (scale_of(&panel.piece), panel.piece.size);
    let bottom = TOP + scale * size.y;
    let place = |p: Point2| in_picture(&panel.piece, p);
    let mut outline = PathData::default();
    // Holes run the other way round, so that they are not filled.
    for line in panel.piece.loops() {
        outline.ring(line.iter().map(|&p| place(p)));
    }
    let mut body = outline.element("sheet");
    let classes = rung_classes(panel, material, MOST_RUNGS);
    body += &rungs(panel, &classes, place);
    body += &marks(panel, place);
    body += &trims(&panel.piece, place);
    body += &outline.element("cut");
    body += &overlap(panel, place);
    body += &dimensions(size, scale, bottom);
    for edge in edges(panel) {
        body += &circle("tag", edge.at, 9.5);
        let below = Point2::new(edge.at.x, edge.at.y + 4.5);
        body += &text("letter", Anchor::Middle, below, &edge.letter);
    }
    let shown = legend(classes.iter().copied().flatten(), bottom + FOOT);
    let height = bottom + FOOT + shown.height;
    Picture::new(WIDTH, height, format!("{} laid flat", panel.name), body + &shown.body)
}

fn rungs(
    panel: &Part,
    classes: &[Option<&'static str>],
    place: impl Fn(Point2) -> Point2,
) -> String {
    let scored: BTreeSet<Rung> = panel
        .piece
        .paths
        .iter()
        .filter(|path| path.role == Role::Score)
        .filter_map(|path| if let PathKind::Rung(rung) = path.kind { Some(rung) } else { None })
        .collect();
    let measured = &panel.measures.rungs;
    let on_sheet = |n: usize| panel.sheet.rung_ends()[n];
    let is_fold = |n: &usize| {
        let [a, b] = on_sheet(*n).map(|s| s.get());
        scored.contains(&Rung::new(a, b))
    };
    let of_class = |class: &str| {
        (0..measured.len()).filter(|&n| classes[n] == Some(class)).collect::<Vec<usize>>()
    };
    let folds: Vec<usize> = (0..measured.len()).filter(is_fold).collect();
    let place = |n: usize| on_sheet(n).map(|s| place(panel.flat.points[s.get()]));
    let mut drawn = Middles::apart(APART);
    let mut is_clear = |n: &usize| {
        let [a, b] = place(*n);
        let middle = a.lerp(b, 0.5);
        let is_free = drawn.is_free(middle);
        if is_free {
            drawn.take(middle);
        }
        is_free
    };
    let [turns, rulings] = APART_CLASSES.map(|class| {
        let all = of_class(class).into_iter().filter(|n| !is_fold(n));
        all.filter(&mut is_clear).collect()
    });
    let mut body = String::new();
    for (class, list) in [
        ("turn", turns),
        ("r", rulings),
        ("score", thinned(&folds, MOST_RUNGS)),
        ("t", of_class("t")),
        ("x", of_class("x")),
        ("w", of_class("w")),
    ] {
        let mut path = PathData::default();
        for n in list {
            path.line(place(n));
        }
        body += &path.element(class);
    }
    body
}

/// The ticks that are engraved at the ends of rulings and on the sides of seams, and the ends of
/// laps.
fn marks(panel: &Part, place: impl Fn(Point2) -> Point2) -> String {
    let mut path = PathData::default();
    let is_tick =
        |kind: PathKind| matches!(kind, PathKind::BendTick | PathKind::SeamTick | PathKind::LapEnd);
    for tick in panel.piece.paths.iter().filter(|p| is_tick(p.kind)) {
        path.line(tick.points.iter().map(|&p| place(p)));
    }
    path.element("tick")
}

/// The words for both lines of a pattern that is not cut at its edge.
pub(super) const CUT_AND_NET: &str =
    "The outer line is cut; the dashed one inside is the edge of the finished piece. ";

/// What is done along the edges and marked on the face: the edge of the finished piece where it is
/// not cut, folds, holes, notches, ticks, stations and arrows.
pub(super) fn trims(piece: &Piece, place: impl Fn(Point2) -> Point2) -> String {
    let class_of = |kind: PathKind| match kind {
        PathKind::Net => Some("net"),
        PathKind::TrimFold { .. } | PathKind::OnFold => Some("score"),
        PathKind::TrimTick | PathKind::Station | PathKind::Grain | PathKind::Arrow => Some("tick"),
        PathKind::Drill { .. } | PathKind::Notch => Some("cut thin"),
        _ => None,
    };
    let mut body = String::new();
    for class in ["net", "score", "tick", "cut thin"] {
        let mut drawn = PathData::default();
        for path in piece.paths.iter().filter(|path| class_of(path.kind) == Some(class)) {
            let points = path.points.iter().map(|&p| place(p));
            if path.closed { drawn.ring(points) } else { drawn.line(points) }
        }
        body += &drawn.element(class);
    }
    // The pattern has all texts; here those that have room beside the ones before.
    let mut taken: Vec<(Point2, f64)> = Vec::new();
    for label in piece.labels.iter().filter(|label| label.kind == LabelKind::OnFace) {
        let (at, half) = (place(label.at), 0.5 * LETTER * label.text.chars().count() as f64);
        let is_clear = |(other, its_half): &(Point2, f64)| {
            (at.x - other.x).abs() > half + its_half || (at.y - other.y).abs() > LINE
        };
        if taken.iter().all(is_clear) {
            body += &text("halo", Anchor::Middle, at, &label.text);
            taken.push((at, half));
        }
    }
    body
}

/// The two edges where the pattern overlaps itself.
fn overlap(panel: &Part, place: impl Fn(Point2) -> Point2) -> String {
    let Some((a, b)) = panel.flat.overlap else { return String::new() };
    let mut body = String::new();
    for i in [a, b] {
        let vertex = VertexIndex::new(i);
        let next = panel.sheet.next_on_border(vertex).unwrap_or(vertex);
        let ends = [vertex, next].map(|v| place(panel.flat.points[v.get()]));
        body += &line("w", &ends);
        if i == a {
            body += &circle("ring", ends[0].lerp(ends[1], 0.5), 13.0);
        }
    }
    body
}

/// The lines and numbers of the overall size.
pub(super) fn dimensions(size: Vec2, scale: f64, bottom: f64) -> String {
    let (width, height) = (scale * size.x, scale * size.y);
    let (y, x) = (bottom + 36.0, LEFT - 36.0);
    let at = Point2::new;
    let mut path = PathData::default();
    path.line([at(LEFT, y), at(LEFT + width, y)]);
    path.line([at(x, bottom), at(x, bottom - height)]);
    for end in [LEFT, LEFT + width] {
        path.line([at(end, y - 5.0), at(end, y + 5.0)]);
    }
    for end in [bottom, bottom - height] {
        path.line([at(x - 5.0, end), at(x + 5.0, end)]);
    }
    let below = at(LEFT + 0.5 * width, y + 21.0);
    let beside = at(x - 10.0, bottom - 0.5 * height);
    // Turned, so that it reads from the right.
    let turned = format!(
        r#"<g transform="translate({} {}) rotate(-90)">{}</g>"#,
        number(beside.x),
        number(beside.y),
        text("", Anchor::Middle, at(0.0, 0.0), &millimetres(size.y))
    );
    path.element("axis") + &text("", Anchor::Middle, below, &millimetres(size.x)) + &turned
}

/// The length of the whole outline, mm.
pub(super) fn outline_length(panel: &Part) -> f64 {
    let at = |v: VertexIndex| panel.flat.points[v.get()];
    steps_of(&panel.sheet.loops()[0]).map(|[a, b]| at(a).distance(at(b))).sum()
}

/// The vertices along some steps of the border, by their numbers.
fn way_along(steps: &[[VertexIndex; 2]]) -> Vec<usize> {
    let first = steps.first().map(|step| step[0].get());
    first.into_iter().chain(steps.iter().map(|step| step[1].get())).collect()
}

/// The longest stretches of the outline's edges, from corner to corner, in the order of the
/// outline, and the sides of seams. None where the outline is one edge without corners.
pub(super) fn edges(panel: &Part) -> Vec<Tagged<'_>> {
    let outline = &panel.sheet.loops()[0];
    let is_outer = |edge: &&Edge| outline.contains(&VertexIndex::new(edge.run[0]));
    let of_outline = panel.edges.iter().filter(is_outer);
    let is_cut = |edge: &&Edge| matches!(edge.source, EdgeSource::Cut { .. });
    let runs = of_outline.filter(|edge| !is_cut(edge));
    let runs: Vec<(&Edge, Vec<usize>)> =
        runs.flat_map(|edge| between_corners(panel, edge)).collect();
    if let [(edge, run)] = &runs[..]
        && run.len() == edge.run.len()
        && edge.is_loop()
    {
        return Vec::new();
    }
    let mut tags = Tags::of(&panel.piece);
    let mut sides: Vec<Tagged<'_>> = Vec::new();
    for (n, seam) in panel.sheet.seams().iter().enumerate() {
        for steps in seam.steps() {
            let side = EdgeStretch::new(panel, &way_along(&steps));
            let at = tags.place(&side.places);
            sides.push(Tagged {
                letter: seam_mark(panel.sheet.first_seam() + n),
                edge: None,
                length_mm: side.length_mm,
                at,
            });
        }
    }
    let mut stretches: Vec<(usize, EdgeStretch)> =
        runs.iter().map(|(_, run)| EdgeStretch::new(panel, run)).enumerate().collect();
    stretches.sort_by(|a, b| b.1.length_mm.total_cmp(&a.1.length_mm).then(a.0.cmp(&b.0)));
    let mut chosen: Vec<(usize, f64, Point2)> = Vec::new();
    for (n, found) in stretches {
        if chosen.len() == LETTERED {
            break;
        }
        if let Some(at) = tags.place_free(&found.places) {
            chosen.push((n, found.length_mm, at));
        }
    }
    chosen.sort_by_key(|c| c.0);
    let named = chosen.into_iter().zip('A'..='Z');
    let mut tagged: Vec<Tagged<'_>> = named
        .map(|((n, length_mm, at), letter)| Tagged {
            letter: letter.to_string(),
            edge: Some(runs[n].0),
            length_mm,
            at,
        })
        .collect();
    tagged.extend(sides);
    tagged
}

/// The stretches of an edge between sharp corners of the boundary: of a closed one, from its first
/// corner on.
fn between_corners<'a>(panel: &Part, edge: &'a Edge) -> Vec<(&'a Edge, Vec<usize>)> {
    let is_corner = |n: usize| {
        let sample = panel.sheet.sample(VertexIndex::new(edge.run[n]));
        let sample = panel.found().map(|found| found.boundary.samples()[sample.get()]);
        sample.is_some_and(|s| angle_between(s.tangent_in, s.tangent_out) > from_deg(CORNER_DEG))
    };
    let last = edge.run.len() - 1;
    let mut run = edge.run.clone();
    let mut corners: Vec<usize> = (1..last).filter(|&n| is_corner(n)).collect();
    if edge.is_loop() {
        let Some(first) = (0..last).find(|&n| is_corner(n)) else { return vec![(edge, run)] };
        run.pop();
        run.rotate_left(first);
        run.push(run[0]);
        corners = corners.into_iter().filter(|&n| n > first).map(|n| n - first).collect();
    }
    let ends = corners.iter().copied().chain([last]);
    let starts = std::iter::once(0).chain(corners.iter().copied());
    starts.zip(ends).map(|(from, to)| (edge, run[from..=to].to_vec())).collect()
}

/// A run of steps of the outline with one letter.
struct EdgeStretch {
    length_mm: f64,
    /// Where its letter may stand in the picture, the best place first.
    places: Vec<Point2>,
}

impl EdgeStretch {
    fn new(panel: &Part, samples: &[usize]) -> Self {
        let at = |i: usize| panel.flat.points[i];
        let steps = samples.windows(2).map(|w| at(w[0]).distance(at(w[1])));
        let length_mm = steps.sum();
        let points: Vec<Point2> = samples.iter().map(|&i| at(i)).collect();
        Self { length_mm, places: beside(&panel.piece, &points) }
    }
}

/// Places in the picture for a letter that belongs to a line of the pattern: beside its middle,
/// first right of it, which is outside for the outline, then left; then nearer to its ends. The
/// best place comes first.
pub(super) fn beside(piece: &Piece, line: &[Point2]) -> Vec<Point2> {
    let length: f64 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let shares = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8];
    let both = |share| [LETTER_AWAY, -LETTER_AWAY].map(|right| (share * length, right));
    let places = shares.into_iter().flat_map(both);
    places.map(|(along, right)| place_beside(piece, line, along, right)).collect()
}

/// The place in the picture at `along_mm`, mm, along a line of the pattern, and at `right`, in
/// units of the picture, to its right.
fn place_beside(piece: &Piece, line: &[Point2], along_mm: f64, right: f64) -> Point2 {
    let mut left = along_mm;
    let (mut middle, mut along) = (line[0], Vec2::X);
    for pair in line.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let step = from.distance(to);
        along = to - from;
        middle = from.lerp(to, if step > 0.0 { (left / step).min(1.0) } else { 0.0 });
        if left <= step {
            break;
        }
        left -= step;
    }
    let way = unit2(along).map_or(Vec2::Y, |a| Vec2::new(a.y, -a.x));
    let on = in_picture(piece, middle);
    // The picture's y points down.
    Point2::new(on.x + right * way.x, on.y - right * way.y)
}

/// Where a point of the pattern lies in the picture.
pub(super) fn in_picture(piece: &Piece, p: Point2) -> Point2 {
    let scale = scale_of(piece);
    let bottom = TOP + scale * piece.size.y;
    let at = p - piece.corner;
    Point2::new(LEFT + scale * at.x, bottom - scale * at.y)
}

/// The letters of a picture, which keep apart from one another and off the lines to cut.
pub(super) struct Tags {
    /// The lines to cut, in the picture.
    lines: Vec<[Point2; 2]>,
    taken: Vec<Point2>,
    /// The height of the picture.
    height: f64,
}

impl Tags {
    /// No letters yet, for the picture of a piece.
    pub(super) fn of(piece: &Piece) -> Self {
        let placed = |line: &[Point2]| -> Vec<Point2> {
            line.iter().map(|&p| in_picture(piece, p)).collect()
        };
        let ends = |line: Vec<Point2>| {
            let next = line.iter().copied().cycle().skip(1);
            line.iter().copied().zip(next).map(|(a, b)| [a, b]).collect::<Vec<_>>()
        };
        let lines = piece.loops().flat_map(|line| ends(placed(line))).collect();
        let height = TOP + scale_of(piece) * piece.size.y + FOOT;
        Self { lines, taken: Vec::new(), height }
    }

    /// The room for a letter at a place as a share of its need, at most 1.
    fn room(&self, at: Point2) -> f64 {
        let other = self.taken.iter().map(|other| other.distance(at) / LETTER_APART);
        let line = self.lines.iter().map(|line| at.distance_to_segment(*line) / LETTER_CLEAR);
        let sides = [at.x, WIDTH - at.x, at.y, self.height - at.y].map(|room| room / LETTER_CLEAR);
        other.chain(line).chain(sides).fold(1.0, f64::min)
    }

    /// The first of some places with enough room for a letter, else that with the most.
    fn place(&mut self, places: &[Point2]) -> Point2 {
        let mut best = (f64::NEG_INFINITY, Point2::default());
        for &at in places {
            let room = self.room(at);
            if room > best.0 {
                best = (room, at);
            }
        }
        self.taken.push(best.1);
        best.1
    }

    /// The first place with enough room, if there is one.
    pub(super) fn place_free(&mut self, places: &[Point2]) -> Option<Point2> {
        let at = places.iter().copied().find(|&at| self.room(at) >= 1.0)?;
        self.taken.push(at);
        Some(at)
    }
}
