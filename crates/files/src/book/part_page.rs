//! Each part once: its flat picture, how often it is cut, its edges and its bends.

use super::corners::{far_corners, letter};
use super::flow::{Flow, LINE_MM, TEXT_PT, number, words};
use super::scene::Frame;
use super::{
    Book, both_lengths, counted, edge_name, first_lines, free_of_edge_mm, ranges, seam_names,
    seam_or_own_names,
};
use crate::brake::reference;
use crate::pdf::{Anchor, Detail, PaperView, PdfPage, Type, draw, shortened, text_mm, wrapped};
use crate::wording::{area, decimal, degrees, millimetres, radius, verdict_sentence, verdict_word};
use sheetwright::bend::{BendLine, Hit};
use sheetwright::check::Severity;
use sheetwright::edge::{Edge, EdgePlace, EdgeSource};
use sheetwright::make::{CutItem, Made, Part};
use sheetwright::math::{Point2, Vec2, to_deg};
use sheetwright::pattern::Piece;
use sheetwright::predicate::Box2;
use std::collections::BTreeMap;

/// Pictures are no higher than this, mm.
const PICTURE_MM: f64 = 70.0;
/// Those of nets, whose facets are small.
const NET_MM: f64 = 120.0;
/// Room around a picture for letters and names, mm.
const AIR_MM: f64 = 7.0;
/// A part that is longer than its width times this has a picture across the page.
const LONG: f64 = 2.4;
/// The share of the width that a picture takes beside text.
const PICTURE_SHARE: f64 = 0.52;
/// Of more patterns, pictures are small, and edges and bends stand beside them.
const MOST_LARGE: usize = 12;
const SMALL_MM: f64 = 46.0;
/// The most edges in a table, and with their names in a picture; more are a paragraph.
const MOST_EDGES: usize = 12;
/// The most bends in a table.
const MOST_BENDS: usize = 24;
/// The most names of equal parts that are listed.
const MOST_NAMES: usize = 8;
/// The heading of a block and the gap below it take so much of its page, mm.
const HEAD_MM: f64 = 9.0;

/// The section.
pub(super) fn parts(flow: &mut Flow, book: &Book<'_>) {
    flow.section("Parts");
    flow.paragraph(
        "Each pattern once, seen from the side that the finished surface faces. Edges of one name \
         are joined. Letters name corners: the chapter on checks says how far they lie apart.",
    );
    if book.patterns.iter().any(|item| item.piece.has_net()) {
        flow.paragraph(
            "Where two lines run along one another, the outer one is cut, and the dashed one is the \
             finished edge.",
        );
    }
    for (n, item) in book.patterns.iter().enumerate() {
        block(flow, book, n, item);
    }
}

/// How a part is shown: its picture beside or above its text.
struct Layout {
    is_compact: bool,
    is_long: bool,
    /// The size of the picture, mm, and the denominator of its scale.
    picture: Vec2,
    scale: f64,
}

impl Layout {
    fn new(flow: &Flow, book: &Book<'_>, part: &Part, size: Vec2) -> Self {
        let is_compact = book.patterns.len() > MOST_LARGE;
        let has_many = part.edges.len() > MOST_EDGES;
        let is_long = !is_compact && (size.x > LONG * size.y || has_many);
        let high = match (is_compact, has_many) {
            (true, _) => SMALL_MM,
            (false, true) => NET_MM,
            (false, false) => PICTURE_MM,
        };
        let share = if is_long { 1.0 } else { PICTURE_SHARE };
        let width = share * flow.width();
        let room = Vec2::new(width, high) - Vec2::splat(2.0 * AIR_MM);
        let scale = (size.x / room.x).max(size.y / room.y).max(1e-9);
        let picture = Vec2::new(width, size.y / scale + 2.0 * AIR_MM);
        Self { is_compact, is_long, picture, scale }
    }
}

fn block(flow: &mut Flow, book: &Book<'_>, n: usize, item: &CutItem) {
    let part = &book.made.parts[item.first()];
    let layout = Layout::new(flow, book, part, item.piece.size);
    let Layout { is_compact, is_long, picture, scale } = layout;
    let beside = picture.x + 6.0;
    let text_width = if is_long { flow.width() } else { flow.width() - beside };
    let mut lines = facts(book, item, part, is_compact);
    if is_compact {
        lines.extend(joined_lines(book.made, item, part));
        lines.extend(bend_line(part));
    }
    let lines = lines.iter().flat_map(|line| wrapped(line, TEXT_PT, text_width)).collect();
    // A block stays on one page.
    let room_mm = flow.whole_room() - HEAD_MM - if is_long { picture.y } else { 0.0 };
    let lines: Vec<String> = first_lines(lines, ((room_mm / LINE_MM) as usize).max(2));
    let text_height = LINE_MM * lines.len() as f64;
    let height = if is_long { picture.y + text_height } else { picture.y.max(text_height) };
    let title = match item.quantity().text() {
        Some(quantity) => format!("{}. {}: {quantity}", n + 1, part.name),
        None => format!("{}. {}", n + 1, part.name),
    };
    flow.heading(&title, height + 2.0);
    let top = flow.take(height + 2.0);
    let frame = Frame { corner: Point2::new(flow.left(), top - picture.y), size: picture };
    flat_picture(flow.page(), frame, part, &item.piece, scale);
    let at = if is_long { frame.corner } else { Point2::new(flow.left() + beside, top) };
    for (n, line) in lines.iter().enumerate() {
        let at = at + Vec2::new(0.0, -3.4 - LINE_MM * n as f64);
        flow.page().text(at, line, Type::new(TEXT_PT));
    }
    if !is_compact {
        edges(flow, book.made, item, part);
        let plan = book.plans.map(|plans| &plans[item.first()]);
        bends(flow, part, plan);
    }
    flow.gap(3.0);
}

/// Sizes, verdict and names, a line each.
fn facts(book: &Book<'_>, item: &CutItem, part: &Part, is_compact: bool) -> Vec<String> {
    let piece = &item.piece;
    let size = format!("{} × {}", millimetres(piece.size.x), millimetres(piece.size.y));
    let verdict = verdict_word(part.checked.verdict);
    let sentence = verdict_sentence(part.checked.verdict, part.given().is_some());
    let mut lines = if is_compact {
        vec![format!("{size}, {}. {verdict}.", area(piece.area_mm2()))]
    } else {
        let area = area(piece.area_mm2());
        vec![format!("Size {size}"), format!("Area {area}"), format!("{verdict}. {sentence}")]
    };
    let of_severity = |severity: Severity| {
        part.checked.findings.iter().filter(|finding| finding.severity() == severity).count()
    };
    let (errors, warnings) = (of_severity(Severity::Error), of_severity(Severity::Warning));
    if errors > 0 {
        let errors = counted(errors, "error", "errors");
        lines.push(format!("Do not cut it yet: the report lists {errors}."));
    } else if warnings > 0 {
        let warnings = counted(warnings, "warning", "warnings");
        lines.push(format!("The report has {warnings}: read it before you cut."));
    }
    if item.instances.len() > 1 {
        let names = item.instances.iter().map(|instance| {
            let name = &book.made.parts[instance.number].name;
            if instance.mirrored { format!("{name} (mirrored)") } else { name.clone() }
        });
        lines.push(format!("For {}", listed(&names.collect::<Vec<_>>())));
    }
    lines
}

/// Names in a row; of many, the first ones and the last.
pub(super) fn listed(names: &[String]) -> String {
    match names {
        [first @ .., last] if names.len() > MOST_NAMES => {
            format!("{}, … {last}", first[..MOST_NAMES - 2].join(", "))
        }
        _ => names.join(", "),
    }
}

/// The lines of the piece, with letters at its corners and the names of its edges beside them.
fn flat_picture(page: &mut PdfPage, frame: Frame, part: &Part, piece: &Piece, scale: f64) {
    let air = Vec2::splat(AIR_MM * scale);
    let drawn = piece.size + air * 2.0;
    // In the middle of a frame that is wider.
    let aside = 0.5 * (frame.size.x - drawn.x / scale);
    let shown = Box2 { min: piece.corner + -air, max: piece.corner + piece.size + air };
    let corner = frame.corner + Vec2::new(aside.max(0.0), 0.0);
    let view = PaperView { shown, corner, scale };
    draw(page, piece, &view, Detail::Lines);
    let middle = view.place(piece.corner + piece.size * 0.5);
    let around = Box2 { min: frame.corner, max: frame.corner + frame.size };
    let mut taken: Vec<Box2> = Vec::new();
    for (n, &at) in far_corners(piece).iter().enumerate() {
        let at = view.place(at);
        let way = sheetwright::math::unit2(at - middle).unwrap_or(Vec2::X);
        let at = at + way * 3.4;
        taken.push(Box2 { min: at + Vec2::splat(-1.8), max: at + Vec2::splat(1.8) });
        let set = Type::new(9.0).bold().at(Anchor::Middle);
        page.text(at + Vec2::new(0.0, -1.2), &letter(n).to_string(), set);
    }
    if part.edges.len() > MOST_EDGES {
        return;
    }
    for edge in &part.edges {
        edge_label(page, part, edge, &view, &around, &mut taken);
    }
}

/// Writes the name of an edge beside its middle, outside if there is room, else inside.
fn edge_label(
    page: &mut PdfPage,
    part: &Part,
    edge: &Edge,
    view: &PaperView,
    around: &Box2,
    taken: &mut Vec<Box2>,
) {
    const PT: f64 = 7.0;
    const HIGH_MM: f64 = 2.6;
    const MOST_MM: f64 = 34.0;
    let name = shortened(&edge.name, PT, MOST_MM);
    let half = Vec2::new(0.5 * text_mm(&name, PT) + 0.6, 0.5 * HIGH_MM);
    let points: Vec<Point2> = edge.run.iter().map(|&v| view.place(part.flat.points[v])).collect();
    for share in [0.5, 0.35, 0.65, 0.2, 0.8] {
        let n = ((points.len() - 1) as f64 * share) as usize;
        let (from, to) = (points[n], points[(n + 1).min(points.len() - 1)]);
        let Some(along) = sheetwright::math::unit2(to - from) else { continue };
        let out = Vec2::new(along.y, -along.x);
        let on = from.lerp(to, 0.5);
        for side in [1.0, -1.0] {
            let reach = half.x * out.x.abs() + half.y * out.y.abs() + 1.0;
            let at = on + out * (side * reach);
            let room = Box2 { min: at + -half, max: at + half };
            let is_inside = around.min.x <= room.min.x
                && around.min.y <= room.min.y
                && room.max.x <= around.max.x
                && room.max.y <= around.max.y;
            let is_free = taken.iter().all(|other| !overlap(other, &room));
            let crosses = part.edges.iter().any(|edge| {
                let placed = |v: usize| view.place(part.flat.points[v]);
                let mut steps = edge.run.windows(2).map(|s| (placed(s[0]), placed(s[1])));
                steps.any(|(a, b)| room.part_inside(a, b).is_some())
            });
            if is_inside && is_free && !crosses {
                taken.push(room);
                let at = at + Vec2::new(0.0, -0.9);
                page.text(at, &name, Type::new(PT).at(Anchor::Middle));
                return;
            }
        }
    }
}

fn overlap(a: &Box2, b: &Box2) -> bool {
    a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y
}

/// The edges with their lengths, and what they are joined to.
fn edges(flow: &mut Flow, made: &Made, item: &CutItem, part: &Part) {
    if part.edges.is_empty() {
        return;
    }
    if part.edges.len() > MOST_EDGES {
        for line in joined_lines(made, item, part) {
            flow.paragraph(&line);
        }
        return;
    }
    let rows = part.edges.iter().enumerate().map(|(n, edge)| {
        let mates = mates(made, EdgePlace { part: item.first(), edge: n });
        let joined = if mates.is_empty() { "free".to_owned() } else { listed_mates(&mates) };
        vec![on_pattern(part, edge), millimetres(edge.length_flat_mm), joined]
    });
    let joined = if item.instances.len() > 1 { "Joined to (of the first)" } else { "Joined to" };
    let columns = [words("Edge", 0.3), number("Length", 0.16), words(joined, 0.54)];
    flow.table(&columns, &rows.collect::<Vec<_>>());
}

/// An edge as the pattern names it: a side of a cut with the mark of its seam.
fn on_pattern(part: &Part, edge: &Edge) -> String {
    match edge.source {
        EdgeSource::Cut { .. } => format!("{} ({})", edge_name(part, edge, 0), edge.name),
        _ => edge.name.clone(),
    }
}

/// What an edge is joined to, with its lengths.
fn mates(made: &Made, own: EdgePlace) -> Vec<String> {
    let part = &made.parts[own.part];
    let edge = &part.edges[own.edge];
    let mate = |(&mate, &[own_mm, other_mm]): (&EdgePlace, &[f64; 2])| {
        let other = &made.parts[mate.part];
        let length = both_lengths(own_mm, other_mm);
        let of_other = edge_name(other, &other.edges[mate.edge], own.part);
        match seam_names(made, [own, mate]).map(ranges) {
            _ if mate.part == own.part => format!("{of_other} of its own, {length}"),
            Some(marks) if marks != edge.name => format!("{} at {marks}, {length}", other.name),
            _ => format!("{}/{of_other}, {length}", other.name),
        }
    };
    edge.mates.iter().zip(&edge.shared_mm).map(mate).collect()
}

/// What a part is joined to, a line for each other part and for its own seams.
fn joined_lines(made: &Made, item: &CutItem, part: &Part) -> Vec<String> {
    let mut marks: BTreeMap<usize, (Vec<String>, f64)> = BTreeMap::new();
    let mut free_mm = 0.0;
    for (n, edge) in part.edges.iter().enumerate() {
        free_mm += free_of_edge_mm(edge);
        for (mate, shared_mm) in edge.mates.iter().zip(&edge.shared_mm) {
            // Both sides of an own seam are one.
            if mate.part != item.first() || n < mate.edge {
                let (names, length_mm) = marks.entry(mate.part).or_default();
                let own = EdgePlace { part: item.first(), edge: n };
                names.extend(seam_or_own_names(made, [own, *mate]));
                *length_mm += shared_mm[0];
            }
        }
    }
    let said = marks.into_iter().map(|(other, (names, length_mm))| {
        let to = if other == item.first() {
            "Closed along its own".to_owned()
        } else {
            format!("Joined to {} along", made.parts[other].name)
        };
        format!("{to} {}, {} in all", ranges(names), millimetres(length_mm))
    });
    let mut lines: Vec<String> = said.collect();
    if free_mm > 0.0 {
        lines.push(format!("Free edges: {} in all", millimetres(free_mm)));
    }
    lines
}

fn listed_mates(mates: &[String]) -> String {
    const MOST: usize = 6;
    let shown = mates[..mates.len().min(MOST)].join("; ");
    if mates.len() > MOST { format!("{shown}; and {} more", mates.len() - MOST) } else { shown }
}

/// The bends: in order for the press brake where its plan is asked for, else how many there are of
/// each angle.
fn bends(flow: &mut Flow, part: &Part, plan: Option<&Vec<Hit>>) {
    if part.piece.bends.is_empty() {
        return;
    }
    let is_net = part.given().is_some_and(|given| given.is_net);
    let Some(hits) = plan.filter(|hits| !is_net && hits.len() <= MOST_BENDS) else {
        return bend_line(part).iter().for_each(|line| flow.paragraph(line));
    };
    let rows = hits.iter().enumerate().map(|(n, hit)| {
        let pair = |[a, b]: [f64; 2]| {
            let [a, b] = [a, b].map(|mm| decimal(mm, 1));
            if a == b { a } else { format!("{a} / {b}") }
        };
        let [left, right] = hit.line.radius_mm().map(radius);
        let radius = match (hit.line.is_fold, left == right) {
            (true, _) => match hit.line.inside_radius_mm {
                Some(mm) => format!("fold, inside {}", radius(mm)),
                None => "fold".to_owned(),
            },
            (false, true) => left,
            (false, false) => format!("{left} / {right}"),
        };
        vec![
            (n + 1).to_string(),
            format!("{} {}", way(&hit.line, false), degrees(to_deg(hit.line.angle.abs()))),
            radius,
            millimetres(hit.line.length_mm()),
            format!("{} from {}", pair(hit.gauges_mm), reference(part, hit)),
        ]
    });
    let columns = [
        number("Bend", 0.09),
        words("Angle", 0.16),
        words("Radius left / right", 0.25),
        number("Length", 0.15),
        words("Gauge left / right, mm", 0.35),
    ];
    flow.table(&columns, &rows.collect::<Vec<_>>());
}

/// How many bends a part has of each angle, in a line; none of a part that is flat.
fn bend_line(part: &Part) -> Option<String> {
    let lines = &part.piece.bends;
    let is_net = part.given().is_some_and(|given| given.is_net);
    let are_folds = lines.iter().all(|line| line.is_fold);
    let (one, many) = if are_folds { ("fold", "folds") } else { ("bend line", "bend lines") };
    let count = counted(lines.len(), one, many);
    let radii = if are_folds { String::new() } else { radii(lines) };
    (!lines.is_empty()).then(|| format!("{count}: {}{radii}.", by_angle(lines, is_net)))
}

fn way(line: &BendLine, is_net: bool) -> &'static str {
    match (line.is_up(), is_net) {
        (true, false) => "up",
        (false, false) => "down",
        (true, true) => "valley",
        (false, true) => "mountain",
    }
}

/// The range of the radii of smooth bends, in words.
fn radii(lines: &[BendLine]) -> String {
    let smooth = lines.iter().filter(|line| !line.is_fold);
    let all = smooth.flat_map(BendLine::radius_mm).filter(|mm| *mm > 0.0);
    let (least, most) =
        all.fold((f64::INFINITY, 0.0_f64), |(least, most), mm| (least.min(mm), most.max(mm)));
    match [least, most].map(radius) {
        _ if most == 0.0 => String::new(),
        [least, most] if least == most => format!(", radius {least}"),
        [least, most] => format!(", radius {least} to {most}"),
    }
}

/// How many bends there are of each way and angle, the most frequent first.
fn by_angle(lines: &[BendLine], is_net: bool) -> String {
    const MOST: usize = 12;
    let mut counts: BTreeMap<(&str, String), usize> = BTreeMap::new();
    for line in lines {
        let angle = format!("{}°", decimal(to_deg(line.angle.abs()), 1));
        *counts.entry((way(line, is_net), angle)).or_default() += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    let shown =
        counts.iter().take(MOST).map(|((way, angle), count)| format!("{count} × {angle} {way}"));
    let shown = shown.collect::<Vec<_>>().join(", ");
    if counts.len() > MOST {
        format!("{shown}, and {} other angles: the pattern has each", counts.len() - MOST)
    } else {
        shown
    }
}
