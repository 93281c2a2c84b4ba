//! The list of the pieces that share pages: what each is called, how large it is and where it is.

use super::page::{Anchor, MARGIN_MM, PdfPage, Type};
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::{LabelKind, Piece};

/// The least width of a column, mm.
const COLUMN_MM: f64 = 58.0;
/// The gap between two columns, mm.
const BETWEEN_MM: f64 = 6.0;
/// The height of a row, mm.
const ROW_MM: f64 = 3.8;
/// The height of the heading, mm.
const HEADING_MM: f64 = 6.0;
/// The gap below the list, mm.
const BELOW_MM: f64 = 5.0;
/// The width of a size and of a page in a column, mm.
const SIZE_MM: f64 = 23.0;
const PAGE_MM: f64 = 13.0;

/// A piece, and the number of its page from 1.
pub(super) struct Row<'a> {
    pub(super) piece: &'a Piece,
    pub(super) page: usize,
}

/// A piece's name, and how often it is cut.
pub(super) fn counted(piece: &Piece) -> String {
    let quantity = piece.labels.iter().find(|label| label.kind == LabelKind::Quantity);
    match quantity {
        Some(quantity) => format!("{}, {}", piece.name, quantity.text),
        None => piece.name.clone(),
    }
}

/// Where a list of so many rows ends that begins at a height of a page, mm: how many pages later,
/// and at which height.
pub(super) fn end(rows: usize, top: f64, page: Vec2) -> (usize, f64) {
    if rows == 0 {
        return (0, top);
    }
    let (mut after, mut top, mut rest) = (0, top, rows);
    while rest > fit(top - MARGIN_MM, page) {
        rest -= fit(top - MARGIN_MM, page);
        after += 1;
        top = page.y - MARGIN_MM;
    }
    (after, top - HEADING_MM - ROW_MM * rest.div_ceil(columns(page)) as f64 - BELOW_MM)
}

fn columns(page: Vec2) -> usize {
    let width_mm = page.x - 2.0 * MARGIN_MM + BETWEEN_MM;
    ((width_mm / (COLUMN_MM + BETWEEN_MM)) as usize).max(1)
}

/// The rows that have room in a height, mm.
fn fit(room_mm: f64, page: Vec2) -> usize {
    // The conversion saturates.
    // Every page is higher than its margins and a row.
    columns(page) * (((room_mm - HEADING_MM) / ROW_MM) as usize)
}

/// Draws a list on some pages; on the first of them it begins at a height, mm.
pub(super) fn draw(pages: &mut [PdfPage], rows: &[Row<'_>], top: f64) {
    let mut rest = rows;
    for (n, page) in pages.iter_mut().enumerate() {
        let size = page.size();
        let top = if n == 0 { top } else { size.y - MARGIN_MM };
        let (here, after) = rest.split_at(fit(top - MARGIN_MM, size).min(rest.len()));
        rest = after;
        if !here.is_empty() {
            on_page(page, here, top);
        }
    }
}

fn on_page(page: &mut PdfPage, rows: &[Row<'_>], top: f64) {
    let columns = columns(page.size());
    let room_mm = page.size().x - 2.0 * MARGIN_MM + BETWEEN_MM;
    let step_mm = room_mm / columns as f64;
    let width_mm = step_mm - BETWEEN_MM;
    let heading = Point2::new(MARGIN_MM, top - 4.0);
    page.text(heading, "Parts that share pages: size in mm, and page", Type::new(10.0).bold());
    let set = Type::new(8.0);
    for (column, rows) in rows.chunks(rows.len().div_ceil(columns)).enumerate() {
        let left = MARGIN_MM + step_mm * column as f64;
        for (n, row) in rows.iter().enumerate() {
            let y = top - HEADING_MM - ROW_MM * (n + 1) as f64 + 0.8;
            let name_mm = width_mm - SIZE_MM - PAGE_MM - 1.0;
            page.fitted_text(Point2::new(left, y), &counted(row.piece), set, name_mm);
            let size = format!("{:.1} × {:.1}", row.piece.size.x, row.piece.size.y);
            let end = Point2::new(left + width_mm - PAGE_MM, y);
            page.text(end, &size, set.at(Anchor::End));
            let end = Point2::new(left + width_mm, y);
            page.text(end, &format!("page {}", row.page), set.at(Anchor::End));
        }
    }
}
