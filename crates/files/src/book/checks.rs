//! What to measure: each part before it is joined, the edges that are joined, and the whole.

use super::corners::{SpaceCorner, diagonals, far_corners, far_in_space, openings};
use super::flow::{Flow, number, words};
use super::scene::{Extras, Frame, Stage};
use super::{Book, EQUAL_MM, JoinedPair, joined_pairs, ranges, seam_or_own_names};
use crate::pdf::{Anchor, Type};
use crate::wording::{decimal, millimetres};
use sheetwright::math::{Point2, Vec2};
use std::collections::BTreeMap;

/// The most rows of joined edges; of more, those that differ most.
const MOST_PAIRS: usize = 60;
/// The height of the picture with the distances, mm.
const PICTURE_MM: f64 = 80.0;

/// The section.
pub(super) fn checks(flow: &mut Flow, book: &Book<'_>) {
    flow.section("Checks to make");
    flow.heading("Each part, when it is cut", 20.0);
    flow.paragraph(
        "Width and height of the box around it as it is cut, and straight distances between the \
         corners of the finished edge that have letters in the pictures of the parts.",
    );
    let rows: Vec<Vec<String>> = book
        .patterns
        .iter()
        .map(|item| {
            let piece = &item.piece;
            let between = diagonals(&far_corners(piece));
            let between: Vec<String> =
                between.iter().map(|(name, mm)| format!("{name} {}", millimetres(*mm))).collect();
            vec![
                piece.name.clone(),
                format!("{} × {}", millimetres(piece.size.x), millimetres(piece.size.y)),
                if between.is_empty() { "no corners".to_owned() } else { between.join(", ") },
                String::new(),
            ]
        })
        .collect();
    let columns = [
        words("Part", 0.24),
        number("Width × height", 0.24),
        words("Between corners", 0.42),
        words("Measured", 0.1),
    ];
    flow.table(&columns, &rows);
    joined(flow, book);
    in_space(flow, book);
    across(flow, book);
}

/// A pair of joined edges as a row is told: its name, its length and the difference, in
/// hundredths of a millimetre: pairs that are alike share them.
type Row = (String, i64, i64);

/// The edges that are joined, with their lengths; equal seams of equal parts are one row.
fn joined(flow: &mut Flow, book: &Book<'_>) {
    let pairs = joined_pairs(book.made);
    if pairs.is_empty() {
        return;
    }
    // The name of the pattern that each part is cut from.
    let mut patterns: Vec<&str> = book.made.parts.iter().map(|part| &part.name[..]).collect();
    for item in book.patterns {
        item.instances.iter().for_each(|part| patterns[part.number] = &item.piece.name);
    }
    let mut rows: BTreeMap<Row, Vec<String>> = BTreeMap::new();
    let mut order: Vec<Row> = Vec::new();
    for pair in &pairs {
        let [own_mm, other_mm] = pair.lengths_mm;
        let hundredths = |mm: f64| (100.0 * mm).round() as i64;
        let difference = hundredths((own_mm - other_mm).abs());
        let row = (alike_name(&patterns, pair), hundredths(own_mm), difference);
        let names = rows.entry(row.clone()).or_default();
        if names.is_empty() {
            order.push(row);
        }
        names.push(ranges(seam_or_own_names(book.made, pair.places)));
    }
    let count = order.len();
    if count > MOST_PAIRS {
        order.sort_by(|a, b| b.2.cmp(&a.2).then(b.1.cmp(&a.1)));
        order.truncate(MOST_PAIRS);
    }
    flow.heading("Edges that are joined", 20.0);
    flow.paragraph(&if count > MOST_PAIRS {
        format!(
            "Lay both on one another before you join them. Of {count} different seams, the \
             {MOST_PAIRS} that differ most are listed."
        )
    } else {
        "Lay both on one another before you join them: these are their lengths on the patterns."
            .to_owned()
    });
    let rows: Vec<Vec<String>> = order
        .iter()
        .map(|row| {
            let names = &rows[row];
            let hundredths = |n: i64| n as f64 / 100.0;
            let difference = hundredths(row.2);
            vec![
                row.0.clone(),
                names[0].clone() + &more(names.len() - 1),
                millimetres(hundredths(row.1)),
                if difference < EQUAL_MM {
                    "none".to_owned()
                } else {
                    format!("{}\u{a0}mm", decimal(difference, 2))
                },
            ]
        })
        .collect();
    let columns = [
        words("Parts", 0.34),
        words("Edge", 0.32),
        number("Length", 0.17),
        number("Difference", 0.17),
    ];
    flow.table(&columns, &rows);
}

fn more(count: usize) -> String {
    if count == 0 { String::new() } else { format!(", and {count} like it") }
}

/// Both parts by the names of their patterns.
fn alike_name(patterns: &[&str], pair: &JoinedPair) -> String {
    let [a, b] = pair.places.map(|place| place.part);
    if a == b {
        format!("{} with itself", patterns[a])
    } else if patterns[a] == patterns[b] {
        format!("{} and its like", patterns[a])
    } else {
        // One name whichever of them comes first.
        format!("{} and {}", patterns[a].min(patterns[b]), patterns[a].max(patterns[b]))
    }
}

/// The largest distances between corners when everything is joined.
fn in_space(flow: &mut Flow, book: &Book<'_>) {
    let pairs = far_in_space(book.made);
    if pairs.is_empty() {
        return;
    }
    flow.heading("When it is joined", PICTURE_MM + 30.0);
    flow.paragraph(
        "Straight distances between corners, the largest first. A corner is named by its part and \
         the edges that meet there.",
    );
    let top = flow.take(PICTURE_MM + 3.0);
    let size = Vec2::new(0.75 * flow.width(), PICTURE_MM);
    let frame = Frame { corner: Point2::new(flow.left(), top - PICTURE_MM), size };
    let scenery = Stage::new(&book.made.parts, size);
    let all: Vec<usize> = (0..book.made.parts.len()).collect();
    let ends = pairs.iter().map(|pair| [pair[0].at, pair[1].at]).collect();
    let extras = Extras { joined: Vec::new(), measured: ends };
    let page = flow.page();
    let seen = scenery.draw(page, frame, &all, &[], &extras);
    for (n, pair) in pairs.iter().enumerate() {
        for corner in pair {
            let (at, middle) = (seen.place(corner.at), frame.corner + size * 0.5);
            let way = sheetwright::math::unit2(at - middle).unwrap_or(Vec2::X);
            let at = at + way * 3.0 + Vec2::new(0.0, -1.2);
            let set = Type::new(9.0).bold().at(Anchor::Middle);
            page.text(at, &(n + 1).to_string(), set);
        }
    }
    let row = |(n, [a, b]): (usize, &[SpaceCorner; 2])| {
        let distance = millimetres(a.at.distance(b.at));
        vec![(n + 1).to_string(), a.name.clone(), b.name.clone(), distance, String::new()]
    };
    let rows: Vec<Vec<String>> = pairs.iter().enumerate().map(row).collect();
    let columns = [
        number("", 0.05),
        words("From", 0.34),
        words("To", 0.34),
        number("Distance", 0.16),
        words("Measured", 0.11),
    ];
    flow.table(&columns, &rows);
}

/// The widths of round openings.
fn across(flow: &mut Flow, book: &Book<'_>) {
    let openings = openings(book.made);
    if openings.is_empty() {
        return;
    }
    flow.heading("Openings", 20.0);
    flow.paragraph("Free edges that run round, across where they are widest.");
    let row = |(name, mm): &(String, f64)| vec![name.clone(), millimetres(*mm), String::new()];
    let rows: Vec<Vec<String>> = openings.iter().map(row).collect();
    let columns = [words("Edge", 0.62), number("Widest", 0.22), words("Measured", 0.16)];
    flow.table(&columns, &rows);
}
