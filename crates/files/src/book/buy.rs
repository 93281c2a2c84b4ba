//! What to buy: the sheet and what goes along its edges.

use super::flow::{Flow, number, words};
use super::title::material;
use super::{Book, JoinedPair, counted, free_of_edge_mm, joined_pairs};
use crate::pdf::Type;
use crate::sheets::{SheetRow, sheet_rows, weight_kg};
use crate::wording::{area, decimal, length_short, millimetres};
use sheetwright::make::{Made, Part};
use sheetwright::math::Point2;
use sheetwright::pattern::Quantity;

/// The section.
pub(super) fn what_to_buy(flow: &mut Flow, book: &Book<'_>) {
    flow.section("What to buy");
    let rows: Vec<Vec<String>> =
        amounts(book).into_iter().map(|(name, value)| vec![name.to_owned(), value]).collect();
    flow.table(&[words("", 0.3), words("", 0.7)], &rows);
    sheets(book, flow);
    flow.heading("What to cut", 20.0);
    let rows: Vec<Vec<String>> = book
        .patterns
        .iter()
        .enumerate()
        .map(|(n, item)| {
            let (piece, quantity) = (&item.piece, item.quantity());
            let mirrored =
                if quantity.mirrored == 0 { String::new() } else { quantity.mirrored.to_string() };
            vec![
                (n + 1).to_string(),
                piece.name.clone(),
                quantity.count.to_string(),
                mirrored,
                format!("{} × {}", millimetres(piece.size.x), millimetres(piece.size.y)),
                area(piece.area_mm2()),
            ]
        })
        .collect();
    let columns = [
        number("No.", 0.07),
        words("Part", 0.31),
        number("Cut", 0.08),
        number("Mirrored", 0.12),
        number("Size", 0.26),
        number("Area of one", 0.16),
    ];
    flow.table(&columns, &rows);
}

/// The sheets that parts are laid out on, or where they are written down: how many of which size.
fn sheets(book: &Book<'_>, flow: &mut Flow) {
    let rows = book.made.nested.as_ref().map(|nested| sheet_rows(book.made, nested));
    if let Some(rows) = rows.filter(|rows| !rows.is_empty()) {
        let mut kinds: Vec<(&SheetRow, usize, f64, Option<f64>)> = Vec::new();
        for row in &rows {
            match kinds.iter_mut().find(|(kind, ..)| kind.kind == row.kind) {
                Some((_, count, long_mm, cost)) => {
                    *count += 1;
                    *long_mm += row.size[0];
                    *cost = cost.zip(row.cost).map(|(a, b)| a + b);
                }
                None => kinds.push((row, 1, row.size[0], row.cost)),
            }
        }
        let line = |&(row, count, long_mm, cost): &(&SheetRow, usize, f64, Option<f64>)| {
            let size = match row.is_roll {
                true => format!("{}, {} of it", row.title, length_about(long_mm)),
                false => row.named(),
            };
            let cost = cost.map_or(String::new(), |cost| decimal(cost, 2));
            vec![size, count.to_string(), cost]
        };
        let lines: Vec<Vec<String>> = kinds.iter().map(line).collect();
        flow.heading("Sheets", 20.0);
        let columns = [words("Size", 0.6), number("Sheets", 0.15), number("Cost", 0.25)];
        flow.table(&columns, &lines);
        to_fill_in(flow, &[ALSO]);
        return;
    }
    flow.heading("Sheets", 3.0 * LINE_MM);
    to_fill_in(flow, &["Size of a sheet", "Sheets", ALSO]);
}

/// The height of a line to write on, mm.
const LINE_MM: f64 = 8.0;
/// What is bought besides.
const ALSO: &str = "Also (thread, tape, glue, rivets)";

/// Lines to write on.
fn to_fill_in(flow: &mut Flow, lines: &[&str]) {
    for line in lines {
        let top = flow.take(LINE_MM);
        let at = Point2::new(flow.left(), top - LINE_MM + 1.5);
        flow.page().text(at, line, Type::new(9.0));
        flow.rule(top - LINE_MM);
    }
    flow.gap(5.0);
}

/// Names and amounts.
fn amounts(book: &Book<'_>) -> Vec<(&'static str, String)> {
    let made = book.made;
    let total_mm2: f64 =
        book.patterns.iter().map(|item| item.piece.area_mm2() * item.quantity().count as f64).sum();
    let pairs = joined_pairs(made);
    // As often as both of its parts are cut.
    let times = |pair: &JoinedPair| {
        let [a, b] = pair.places.map(|place| made.wanted[place.part].count);
        a.min(b)
    };
    let seams: usize = pairs.iter().map(times).sum();
    let seams_mm: f64 = pairs.iter().map(|pair| pair.lengths_mm[0] * times(pair) as f64).sum();
    let mut rows = vec![
        ("Material", material(made)),
        ("Thickness", made.thickness_mm.map_or("any".to_owned(), millimetres)),
        ("Area of all parts", format!("{}, without what is left over", area(total_mm2))),
    ];
    if let Some(kg) = weight_kg(made, total_mm2) {
        rows.push(("Weight of all parts", weight(kg)));
    }
    let seams = counted(seams, "seam", "seams");
    let joined = if pairs.is_empty() {
        "none".to_owned()
    } else {
        format!("{} in {seams}", length_about(seams_mm))
    };
    rows.push(("Joined edges", joined));
    rows.push(("Free edges", length_about(free_mm(made))));
    let patterns = counted(book.patterns.len(), "pattern", "patterns");
    rows.push(("Parts", format!("{} from {patterns}", book.count())));
    rows
}

/// How long all edges are along which nothing is joined, on the patterns, mm.
fn free_mm(made: &Made) -> f64 {
    let of_part = |(part, quantity): (&Part, &Quantity)| {
        part.edges.iter().map(free_of_edge_mm).sum::<f64>() * quantity.count as f64
    };
    made.parts.iter().zip(&made.wanted).map(of_part).sum()
}

/// A length to buy by: hundredths of a metre from one metre on.
fn length_about(mm: f64) -> String {
    if mm == 0.0 {
        "none".to_owned()
    } else if mm >= 1000.0 {
        length_short((mm / 10.0).ceil() * 10.0)
    } else {
        millimetres(mm)
    }
}

fn weight(kg: f64) -> String {
    if kg >= 1.0 {
        format!("{}\u{a0}kg", decimal(kg, if kg < 100.0 { 1 } else { 0 }))
    } else {
        format!("{}\u{a0}g", decimal(1000.0 * kg, if kg < 0.01 { 1 } else { 0 }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_are_rounded_as_a_buyer_needs_them() {
        assert_eq!(length_about(0.0), "none");
        assert_eq!(length_about(31_415.9), "31.42\u{a0}m");
        assert_eq!(length_about(943.41), "943.4\u{a0}mm");
        assert_eq!(weight(12.345), "12.3\u{a0}kg");
        assert_eq!(weight(0.0123), "12\u{a0}g");
    }
}
