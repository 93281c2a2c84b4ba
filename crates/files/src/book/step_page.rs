//! The order of joining: a picture for each step, or for several that are alike, and the edges
//! that are joined.

use super::flow::{Flow, LINE_MM, TEXT_PT};
use super::part_page::listed;
use super::scene::{Extras, Frame, Stage, height_per_width};
use super::stages::{StageOf, stages};
use super::{Book, both_lengths, edge_name, first_lines, ranges, seam_names, seam_or_own_names};
use crate::pdf::{Anchor, PdfPage, Type, wrapped};
use crate::wording::millimetres;
use sheetwright::edge::EdgePlace;
use sheetwright::make::{Join, JoiningStep, Made};
use sheetwright::math::{Point2, Point3, Vec2, Vec3, unit2};
use std::collections::BTreeMap;

/// The share of the width that a picture takes.
const PICTURE_SHARE: f64 = 0.45;
/// Pictures are not lower than this, mm, and have this room for numbers above and below.
const LEAST_MM: f64 = 30.0;
const AIR_MM: f64 = 10.0;
/// The gap below a step, mm.
const BELOW_MM: f64 = 5.0;
/// The most joins with a number in the picture.
const MOST_NUMBERED: usize = 6;
/// How far a number stands from the seam, mm.
const BESIDE_MM: f64 = 3.2;
/// Of steps that are alike, as many are told in full, and the last one.
const TOLD: usize = 2;
/// The most lines of text beside a picture.
const MOST_LINES: usize = 16;

/// The section.
pub(super) fn steps(flow: &mut Flow, book: &Book<'_>) {
    let made = book.made;
    let steps = made.joining_order();
    if steps.iter().all(|step| step.joins.is_empty()) {
        return;
    }
    let stages = stages(made, book.patterns, &steps);
    flow.section("Order of joining");
    flow.paragraph(
        "Each next part is the one that is joined to what stands along the greatest length. The new \
         part is dark, what stands is light; dashes show what is hidden, thick lines the edges to \
         join.",
    );
    let on_page = match stages.len() {
        ..=3 => 3.0,
        4..=12 => 4.0,
        _ => 5.0,
    };
    let most_mm = flow.room() / on_page - BELOW_MM - 0.1;
    let width_mm = PICTURE_SHARE * flow.width();
    // Lower for what is wide.
    let high_mm = (width_mm * height_per_width(&made.parts) + AIR_MM).clamp(LEAST_MM, most_mm);
    let size = Vec2::new(width_mm, high_mm);
    let scenery = Stage::new(&made.parts, size);
    for stage in &stages {
        block(flow, made, &steps, stage, &scenery, size);
    }
}

fn block(
    flow: &mut Flow,
    made: &Made,
    steps: &[JoiningStep],
    stage: &StageOf,
    scenery: &Stage,
    size: Vec2,
) {
    let new = &steps[stage.steps.clone()];
    let (before, joins) = (&steps[..stage.steps.start], new.iter().flat_map(|step| &step.joins));
    // A number in the picture stands in the text, too.
    let is_told = !stage.alike || new.len() <= TOLD + 1;
    let is_numbered = is_told && joins.clone().count() <= MOST_NUMBERED;
    let text_left = flow.left() + size.x + 6.0;
    let width = flow.width() - size.x - 6.0;
    let said = lines(made, new, stage, is_numbered);
    let lines = said.iter().flat_map(|line| wrapped(line, TEXT_PT, width)).collect();
    let lines = first_lines(lines, MOST_LINES);
    let title = title(made, new, stage);
    let titles = wrapped(&title, 10.0, width / 1.1);
    let text_mm = 5.0 * titles.len() as f64 + LINE_MM * lines.len() as f64;
    let height = size.y.max(text_mm) + BELOW_MM;
    let top = flow.take(height);
    let frame = Frame { corner: Point2::new(flow.left(), top - size.y), size };
    let parts = |steps: &[JoiningStep]| steps.iter().map(|step| step.part).collect::<Vec<_>>();
    let runs: Vec<Vec<Point3>> =
        new.iter().flat_map(|step| step.joins.iter().map(|j| run(made, step.part, j))).collect();
    let middles: Vec<Point3> = runs.iter().map(|run| run[run.len() / 2]).collect();
    let part_of_each = new.iter().flat_map(|step| step.joins.iter().map(|_| step.part));
    let extras = Extras { joined: runs, measured: Vec::new() };
    let from = {
        let page = flow.page();
        let seen = scenery.draw(page, frame, &parts(before), &parts(new), &extras);
        if is_numbered {
            let mut taken: Vec<Point2> = Vec::new();
            for (n, (&middle, part)) in middles.iter().zip(part_of_each).enumerate() {
                // Beside the seam, so that a small part is seen.
                let (on, centre) = (seen.place(middle), seen.place(middle_of(made, part)));
                let away = unit2(on - centre).unwrap_or(Vec2::Y) * BESIDE_MM;
                let at = clear_of(on + away, &taken);
                taken.push(at);
                numbered(page, at, n + 1);
            }
        }
        seen.from
    };
    if let Some(from) = from {
        let at = frame.corner + Vec2::new(0.0, 0.5);
        flow.page().text(at, from, Type::new(7.5));
    }
    let mut y = top - 4.0;
    for line in titles {
        flow.page().text(Point2::new(text_left, y), &line, Type::new(10.0).bold());
        y -= 5.0;
    }
    for line in lines {
        flow.page().text(Point2::new(text_left, y), &line, Type::new(TEXT_PT));
        y -= LINE_MM;
    }
    flow.rule(top - height + 2.0);
}

/// The middle of the corners of a part in space, mm.
fn middle_of(made: &Made, part: usize) -> Point3 {
    let positions = made.parts[part].sheet.mesh().positions();
    let sum: Vec3 = positions.iter().map(|p| p.to_vec()).sum();
    Point3::from_vec(sum / positions.len() as f64)
}

/// A place for a number that lies on none of the others: to the right of them.
fn clear_of(mut at: Point2, taken: &[Point2]) -> Point2 {
    const APART_MM: f64 = 4.6;
    while taken.iter().any(|other| other.distance(at) < APART_MM - 1e-9) {
        at = at + Vec2::new(APART_MM, 0.0);
    }
    at
}

/// A number on a white square.
fn numbered(page: &mut PdfPage, at: Point2, n: usize) {
    let half = Vec2::splat(1.9);
    let (low, high) = (at + -half, at + half);
    let corners = [low, Point2::new(high.x, low.y), high, Point2::new(low.x, high.y)];
    page.fill(std::iter::once(&corners[..]), [255.0; 3]);
    let set = Type::new(8.0).bold().at(Anchor::Middle);
    page.text(at + Vec2::new(0.0, -1.05), &n.to_string(), set);
}

/// The points along what two edges share, in space: those of the shorter edge.
fn run(made: &Made, part: usize, join: &Join) -> Vec<Point3> {
    let own = (part, join.edge);
    let other = (join.to.part, join.to.edge);
    let length = |(part, edge): (usize, usize)| made.parts[part].edges[edge].length_space_mm;
    // Equal ones: that of the new part.
    let (part, edge) = if length(other) < 0.99 * length(own) { other } else { own };
    let positions = made.parts[part].sheet.mesh().positions();
    made.parts[part].edges[edge].run.iter().map(|&v| positions[v]).collect()
}

fn title(made: &Made, new: &[JoiningStep], stage: &StageOf) -> String {
    let name = |step: &JoiningStep| made.parts[step.part].name.clone();
    let first = stage.steps.start + 1;
    let names = listed(&new.iter().map(name).collect::<Vec<_>>());
    let is_loose = new.iter().all(|step| step.begins && step.joins.is_empty())
        && new.iter().all(|step| made.parts[step.part].edges.iter().all(|e| e.mates.is_empty()));
    if is_loose {
        return format!("Not joined to anything: {names}");
    }
    match new {
        [_] if made.parts.len() == 1 => format!("Close {names}"),
        [only] if only.begins && first == 1 => format!("{first}. Begin with {names}"),
        [only] if only.begins => format!("{first}. Begin anew with {names}"),
        [_] => format!("{first}. Add {names}"),
        _ => format!("{first} to {}. Add {names}", stage.steps.end),
    }
}

/// What is joined in a stage, a line or more for each join.
fn lines(made: &Made, new: &[JoiningStep], stage: &StageOf, is_numbered: bool) -> Vec<String> {
    let mut lines = Vec::new();
    let mut count = 0;
    for (n, step) in new.iter().enumerate() {
        let is_told = !stage.alike || n < TOLD || n + 1 == new.len();
        if stage.alike && n == TOLD && new.len() > TOLD + 1 {
            lines.push("… and so on, one after the other …".to_owned());
        }
        let part = &made.parts[step.part];
        let whose = if new.len() > 1 { format!("{}: ", part.name) } else { String::new() };
        if step.joins.len() > MOST_NUMBERED {
            if is_told {
                lines.extend(gathered(made, step).into_iter().map(|line| format!("{whose}{line}")));
            }
            continue;
        }
        for join in &step.joins {
            count += 1;
            if is_told {
                let number = if is_numbered { format!("({count}) ") } else { String::new() };
                lines.push(format!("{number}{whose}{}", said(made, step.part, join)));
            }
        }
        if step.joins.is_empty() && new.len() > 1 && !stage.alike {
            lines.push(format!("{}: laid down to begin with", part.name));
        }
    }
    if lines.is_empty() && new.len() == 1 && new[0].begins {
        lines.push("Nothing is joined yet.".to_owned());
    }
    lines
}

/// The joins of a step that has many, a line for each part that it is joined to.
fn gathered(made: &Made, step: &JoiningStep) -> Vec<String> {
    let mut marks: BTreeMap<usize, (Vec<String>, f64)> = BTreeMap::new();
    for join in &step.joins {
        let (names, length_mm) = marks.entry(join.to.part).or_default();
        let own = EdgePlace { part: step.part, edge: join.edge };
        names.extend(seam_or_own_names(made, [own, join.to]));
        *length_mm += join.shared_mm[0];
    }
    let said = marks.into_iter().map(|(other, (names, length_mm))| {
        let (names, length) = (ranges(names), millimetres(length_mm));
        if other == step.part {
            format!("close its seams {names}, {length} together")
        } else {
            format!("{names} to {}, {length} together", made.parts[other].name)
        }
    });
    said.collect()
}

/// A join in words.
fn said(made: &Made, part: usize, join: &Join) -> String {
    let own = EdgePlace { part, edge: join.edge };
    let other = &made.parts[join.to.part];
    let length = both_lengths(join.shared_mm[0], join.shared_mm[1]);
    let is_own = join.to.part == part;
    // One name or mark stands on both patterns.
    if let Some(names) = seam_names(made, [own, join.to]) {
        let names = ranges(names);
        return if is_own {
            format!("close {names}, {length}")
        } else {
            format!("{names} to {}, {length}", other.name)
        };
    }
    let name = ranges(seam_or_own_names(made, [own, join.to]));
    let of_other = edge_name(other, &other.edges[join.to.edge], part);
    if is_own {
        format!("close it: {name} to {of_other}, {length}")
    } else {
        format!("{name} to {}/{of_other}, {length}", other.name)
    }
}
