//! The flat pattern: outline, rulings, folds, overall dimensions and the lengths of its edges.

use super::canvas::{Anchor, PathData, Picture, WIDTH, circle, line, number, text};
use super::space_picture::rung_classes;
use super::wording::{millimetres, thinned};
use sheetwright::design::MadePanel;
use sheetwright::index::SampleIndex;
use sheetwright::material::Material;
use sheetwright::math::{Point2, Vec2, angle_between, from_deg, unit2};
use sheetwright::pattern::{PathKind, Role, seam_mark};
use sheetwright::rung::Rung;
use std::collections::BTreeSet;
use std::ops::Range;

/// Room left and right of the pattern; the chart of warp has the same, so that the two line up.
pub(super) const LEFT: f64 = 66.0;
pub(super) const RIGHT: f64 = 34.0;
pub(super) const TOP: f64 = 32.0;
pub(super) const FOOT: f64 = 66.0;
/// Rulings drawn, at the most.
const RULINGS: usize = 60;
/// Edges with a letter, at the most: the longest.
const LETTERED: usize = 8;
/// Two edges meet where the outline turns by more than this, degrees.
const CORNER_DEG: f64 = 10.0;
/// How far a letter stands from its edge, and how far letters stay apart.
const LETTER_AWAY: f64 = 15.0;
const LETTER_APART: f64 = 22.0;

/// An edge of the outline from corner to corner.
pub(super) struct Edge {
    /// Its letter in the picture; of a side of a seam, the mark of the seam.
    pub(super) letter: String,
    /// Its length, mm.
    pub(super) length_mm: f64,
    /// Its middle and the way out of the piece there, in the picture.
    at: Point2,
}

/// Where the pattern lies in the picture: pixels a millimetre.
pub(super) fn scale_of(panel: &MadePanel) -> f64 {
    (WIDTH - LEFT - RIGHT) / panel.piece.size.x.max(1e-12)
}

/// The flat pattern of a panel, seen from the side that the surface faces.
pub fn flat_picture(panel: &MadePanel, material: Option<&Material>) -> Picture {
    let (scale, size) = (scale_of(panel), panel.piece.size);
    let bottom = TOP + scale * size.y;
    let place = |p: Point2| Point2::new(LEFT + scale * p.x, bottom - scale * p.y);
    let mut outline = PathData::default();
    // Holes run the other way round, so that they are not filled.
    for line in panel.piece.loops() {
        outline.ring(line.iter().map(|&p| place(p)));
    }
    let mut body = outline.element("sheet");
    body += &rungs(panel, material, place);
    body += &marks(panel, place);
    body += &outline.element("cut");
    body += &overlap(panel, place);
    body += &dimensions(size, scale, bottom);
    for edge in edges(panel) {
        body += &circle("tag", edge.at, 9.5);
        let below = Point2::new(edge.at.x, edge.at.y + 4.5);
        body += &text("letter", Anchor::Middle, below, &edge.letter);
    }
    Picture::new(WIDTH, bottom + FOOT, format!("{} laid flat", panel.name), body)
}

fn rungs(
    panel: &MadePanel,
    material: Option<&Material>,
    place: impl Fn(Point2) -> Point2,
) -> String {
    let classes = rung_classes(panel, material, RULINGS);
    let scored: BTreeSet<Rung> = panel
        .piece
        .paths
        .iter()
        .filter(|path| path.role == Role::Score)
        .filter_map(|path| if let PathKind::Rung(rung) = path.kind { Some(rung) } else { None })
        .collect();
    let measured = &panel.measures.rungs;
    let on_sheet = |n: usize| panel.sheet.rung_ends(n);
    let is_fold = |n: &usize| {
        let [a, b] = on_sheet(*n).map(|s| s.get());
        scored.contains(&Rung::new(a, b))
    };
    let of_class = |class: &str| {
        (0..measured.len()).filter(|&n| classes[n] == Some(class)).collect::<Vec<usize>>()
    };
    let folds: Vec<usize> = (0..measured.len()).filter(is_fold).collect();
    let rulings = of_class("r").into_iter().filter(|n| !is_fold(n)).collect();
    let mut body = String::new();
    for (class, list) in [
        ("r", rulings),
        ("score", thinned(&folds, RULINGS)),
        ("x", of_class("x")),
        ("w", of_class("w")),
    ] {
        let mut path = PathData::default();
        for n in list {
            path.line(on_sheet(n).map(|s| place(panel.flat.points[s.get()])));
        }
        body += &path.element(class);
    }
    body
}

/// The ticks that are engraved at the ends of rulings and on the sides of seams.
fn marks(panel: &MadePanel, place: impl Fn(Point2) -> Point2) -> String {
    let mut path = PathData::default();
    let is_tick = |kind: PathKind| matches!(kind, PathKind::RulingTick | PathKind::SeamTick);
    for tick in panel.piece.paths.iter().filter(|p| is_tick(p.kind)) {
        path.line(tick.points.iter().map(|&p| place(p)));
    }
    path.element("tick")
}

/// The two edges where the pattern overlaps itself.
fn overlap(panel: &MadePanel, place: impl Fn(Point2) -> Point2) -> String {
    let Some((a, b)) = panel.flat.overlap else { return String::new() };
    let mut body = String::new();
    for i in [a, b] {
        let ends = [i, next_on_sheet(panel, i)].map(|k| place(panel.flat.points[k]));
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
pub(super) fn outline_length(panel: &MadePanel) -> f64 {
    outer_loop(panel).map(|i| step(panel, i)).sum()
}

/// The samples of the outline on the sheet.
fn outer_loop(panel: &MadePanel) -> Range<usize> {
    panel.sheet.surface().connectivity().loops()[0].clone()
}

/// The sample after one on its loop of the sheet.
fn next_on_sheet(panel: &MadePanel, i: usize) -> usize {
    let loops = panel.sheet.surface().connectivity().loops();
    let own = &loops[loops.partition_point(|range| range.end <= i)];
    if i + 1 == own.end { own.start } else { i + 1 }
}

fn step(panel: &MadePanel, i: usize) -> f64 {
    panel.flat.points[i].distance(panel.flat.points[next_on_sheet(panel, i)])
}

/// The longest edges of the outline, from corner to corner, in the order of the boundary, and the
/// sides of seams; none where it has fewer than two corners.
pub(super) fn edges(panel: &MadePanel) -> Vec<Edge> {
    let corners = corners(panel);
    if corners.len() < 2 {
        return Vec::new();
    }
    let mut sides: Vec<Edge> = Vec::new();
    for (n, seam) in panel.sheet.seams().iter().enumerate() {
        for side in seam.sides {
            let (length_mm, at) = stretch(panel, &side.map(|s| s.get()));
            sides.push(Edge { letter: seam_mark(n), length_mm, at });
        }
    }
    let is_seam = |samples: &[usize]| {
        let sides = panel.sheet.seams().iter().flat_map(|seam| seam.sides);
        sides.map(|side| side.map(|s| s.get())).any(|side| side == samples)
    };
    let mut stretches: Vec<(usize, f64, Point2)> = (0..corners.len())
        .filter_map(|n| {
            let to = corners[(n + 1) % corners.len()];
            let mut samples = vec![corners[n]];
            loop {
                let next = next_on_sheet(panel, samples[samples.len() - 1]);
                samples.push(next);
                if next == to {
                    break;
                }
            }
            let (length, at) = stretch(panel, &samples);
            (!is_seam(&samples)).then_some((n, length, at))
        })
        .collect();
    stretches.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut chosen: Vec<(usize, f64, Point2)> = Vec::new();
    for found in stretches {
        let tags = chosen.iter().map(|other| other.2).chain(sides.iter().map(|side| side.at));
        let free = tags.into_iter().all(|other| other.distance(found.2) >= LETTER_APART);
        if free && chosen.len() < LETTERED {
            chosen.push(found);
        }
    }
    chosen.sort_by_key(|c| c.0);
    let named = chosen.into_iter().zip('A'..='Z');
    let mut edges: Vec<Edge> = named
        .map(|((_, length_mm, at), letter)| Edge { letter: letter.to_string(), length_mm, at })
        .collect();
    edges.extend(sides);
    edges
}

fn corners(panel: &MadePanel) -> Vec<usize> {
    // The ends of a seam are corners of the pattern wherever they lie.
    let of_seams: BTreeSet<usize> =
        panel.sheet.seams().iter().flat_map(|seam| seam.sides).flatten().map(|s| s.get()).collect();
    outer_loop(panel)
        .filter(|&i| {
            let sample = panel.boundary.samples()[panel.sheet.origin(SampleIndex::new(i)).get()];
            of_seams.contains(&i)
                || angle_between(sample.tangent_in, sample.tangent_out) > from_deg(CORNER_DEG)
        })
        .collect()
}

/// The length of some steps of the outline, mm, and where their letter stands in the picture.
fn stretch(panel: &MadePanel, samples: &[usize]) -> (f64, Point2) {
    let at = |i: usize| panel.flat.points[i];
    let length: f64 = samples.windows(2).map(|w| at(w[0]).distance(at(w[1]))).sum();
    let mut left = 0.5 * length;
    let (mut middle, mut along) = (at(samples[0]), Vec2::X);
    for pair in samples.windows(2) {
        let (from, to) = (at(pair[0]), at(pair[1]));
        let step = from.distance(to);
        along = to - from;
        middle = from.lerp(to, if step > 0.0 { (left / step).min(1.0) } else { 0.0 });
        if left <= step {
            break;
        }
        left -= step;
    }
    // The outline runs counter-clockwise: out is to its right. The picture's y points down.
    let out = unit2(along).map_or(Vec2::Y, |a| Vec2::new(a.y, -a.x));
    let scale = scale_of(panel);
    let bottom = TOP + scale * panel.piece.size.y;
    let on = Point2::new(LEFT + scale * middle.x, bottom - scale * middle.y);
    (length, Point2::new(on.x + LETTER_AWAY * out.x, on.y - LETTER_AWAY * out.y))
}
