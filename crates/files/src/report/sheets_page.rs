//! The sheets with the parts on them, in `report.html`: a picture each, and what is left of them.

use super::canvas::{Anchor, PathData, Picture, WIDTH, text};
use super::page::table;
use crate::sheets::{SheetRow, sheet_rows, weight_kg, without_sheet};
use crate::wording::{area, decimal, millimetres};
use maud::{Markup, PreEscaped, html};
use sheetwright::make::Made;
use sheetwright::math::Point2;
use sheetwright::pattern::{PathKind, Piece, Role};

/// The most sheets with a picture; the table has all.
const MOST_PICTURES: usize = 24;
/// No picture of a sheet is higher than this, in its units.
const MOST_HIGH: f64 = 620.0;
/// The room around a sheet in its picture.
const AROUND: f64 = 10.0;
/// Letters are this wide, as a share of their height.
const LETTER: f64 = 0.62;
/// The height of the letters of a picture.
const LETTERS: f64 = 12.0;

/// The section about sheets; nothing where parts are not laid out.
pub(super) fn sheets(made: &Made) -> Markup {
    let Some(nested) = &made.nested else { return html! {} };
    let pieces = made.sheet_pieces(&nested.list);
    let rows = sheet_rows(made, nested);
    let labels = ["Sheet", "Parts", "Area of parts", "Used", "Length of cuts", "Cost"];
    let row = |(row, piece): (&SheetRow, &Piece)| {
        let values = vec![
            row.named(),
            row.parts.to_string(),
            area(row.used_mm2),
            format!("{} %", decimal(100.0 * row.share(), 0)),
            millimetres(crate::parts::cut_length_mm(piece)),
            row.cost.map_or_else(|| "–".to_owned(), |cost| decimal(cost, 2)),
        ];
        (piece.name.clone(), values)
    };
    let whole: f64 = rows.iter().map(|row| row.area_mm2).sum();
    let used: f64 = rows.iter().map(|row| row.used_mm2).sum();
    let cost: Option<f64> = rows.iter().map(|row| row.cost).sum();
    let weight_kg = weight_kg(made, used);
    let without = without_sheet(made, nested);
    html! {
        section.sheets {
            h2 { "Sheets" }
            @if !without.is_empty() {
                p.warning { (without) }
            }
            @if !rows.is_empty() {
                p {
                    "All parts take " (area(used)) " of " (area(whole)) ", "
                    (decimal(100.0 * used / whole, 0)) " %."
                    @if let Some(cost) = cost { " The sheets cost " (decimal(cost, 2)) "." }
                    @if let Some(kg) = weight_kg { " The parts weigh " (decimal(kg, 2)) " kg." }
                }
                (table(None, "Name", &labels, rows.iter().zip(&pieces).map(row)))
                div.panel {
                    @for (piece, row) in pieces.iter().zip(&rows).take(MOST_PICTURES) {
                        figure {
                            (PreEscaped(sheet_picture(piece, row).inline()))
                            figcaption { (piece.name) ", " (row.title) }
                        }
                    }
                }
                @if pieces.len() > MOST_PICTURES {
                    p.sub { "Of " (pieces.len()) " sheets, the first " (MOST_PICTURES) " are shown; "
                        "sheets.svg has all." }
                }
            }
        }
    }
}

/// A sheet and the parts on it.
fn sheet_picture(piece: &Piece, row: &SheetRow) -> Picture {
    let size = piece.size;
    let across = (WIDTH - 2.0 * AROUND) / size.x.max(1e-9);
    let scale = across.min((MOST_HIGH - 2.0 * AROUND) / size.y.max(1e-9));
    let height = scale * size.y + 2.0 * AROUND;
    let left = 0.5 * (WIDTH - scale * size.x);
    let place = |p: &Point2| Point2::new(left + scale * p.x, height - AROUND - scale * p.y);
    let mut body = String::new();
    let mut edge = PathData::default();
    let mut parts = PathData::default();
    let mut lines = PathData::default();
    for path in &piece.paths {
        match (path.kind, path.role) {
            (PathKind::SheetEdge, _) => edge.ring(path.points.iter().map(place)),
            (PathKind::Outline | PathKind::Hole, _) => parts.ring(path.points.iter().map(place)),
            (PathKind::Rung(_), Role::Note) | (PathKind::Bend { .. }, _) => {}
            (_, Role::Score | Role::Net | Role::Engrave) if !path.closed => {
                lines.line(path.points.iter().map(place));
            }
            _ => {}
        }
    }
    body += &edge.element("sheet-edge");
    body += &parts.element("sheet");
    body += &lines.element("tick");
    body += &parts.element("cut thin");
    for (name, at, room) in &row.names {
        let wide = LETTER * LETTERS * name.chars().count() as f64;
        if wide <= scale * room {
            let at = place(at);
            body += &text("", Anchor::Middle, Point2::new(at.x, at.y + 0.35 * LETTERS), name);
        }
    }
    Picture::new(WIDTH, height, format!("{} with its parts", piece.name), body)
}
