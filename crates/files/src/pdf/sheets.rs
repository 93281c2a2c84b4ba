//! A piece on sheets of paper, true to scale.
//!
//! The sheets form a grid of rows A, B, … from the top and columns 1, 2, … from the left. Each
//! shows a window of the piece that overlaps its neighbours' by 10 mm; the seams run along the
//! middle of the overlaps, and where they cross, all four sheets print the same cross.

use super::labels::placed;
use super::page::{Anchor, MARGIN_MM, PdfPage, Pen, Type};
use super::piece::{Detail, PaperView, draw};
use super::tiling::{OVERLAP_MM, PaperSheet, Tiling};
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::Piece;
use sheetwright::predicate::Box2;

/// Arms of a cross, mm.
const CROSS_MM: f64 = 4.0;
/// The length of the scale bar, mm.
pub(super) const BAR_MM: f64 = 100.0;

/// The sheets of a piece.
pub(super) fn pages<'a>(
    piece: &'a Piece,
    tiling: &'a Tiling,
) -> impl Iterator<Item = PdfPage> + 'a {
    let drawn = placed(piece, tiling);
    tiling.sheets.iter().map(move |&sheet| page(&drawn, tiling, sheet))
}

fn page(piece: &Piece, tiling: &Tiling, sheet: PaperSheet) -> PdfPage {
    let mut page = PdfPage::of(tiling.page, tiling.turned);
    let corner = Point2::new(MARGIN_MM, MARGIN_MM);
    let view = PaperView { shown: tiling.window(sheet), corner, scale: 1.0 };
    let place = format!(
        "row {} of {}, column {} of {}",
        sheet.row + 1,
        tiling.rows,
        sheet.column + 1,
        tiling.columns
    );
    header(&mut page, &piece.name, &sheet.name(), &place, &view);
    draw(&mut page, piece, &view, Detail::Full);
    page.rectangle(view.frame(), Pen::FRAME);
    seams(&mut page, tiling, sheet, &view);
    page
}

/// Draws the name of the sheet, the range of the piece that it shows, and the scale bar.
pub(super) fn header(page: &mut PdfPage, piece: &str, sheet: &str, place: &str, view: &PaperView) {
    let size = page.size();
    let top = size.y - MARGIN_MM;
    let right = size.x - MARGIN_MM;
    let left_room = right - BAR_MM - MARGIN_MM - 5.0;
    let title = format!("{piece}   {sheet}");
    let at = Point2::new(MARGIN_MM, top - 6.0);
    // The widths are those of the regular font; the bold one is wider by less than a tenth.
    page.fitted_text(at, &title, Type::new(14.0).bold(), left_room / 1.1);
    let Box2 { min, max } = view.shown;
    let shown = format!(
        "This sheet: {piece} {sheet}, {place}. It shows x {:.3} to {:.3} mm, y {:.3} to {:.3} mm \
         at 1:{}. Print at 100 %.",
        min.x, max.x, min.y, max.y, view.scale
    );
    let at = Point2::new(MARGIN_MM, top - 13.5);
    page.fitted_text(at, &shown, Type::new(7.5), right - MARGIN_MM);
    scale_bar(page, Point2::new(right - BAR_MM, top - 7.0));
}

/// A bar of 100 mm, divided into tens.
pub(super) fn scale_bar(page: &mut PdfPage, from: Point2) {
    page.line(from, from + Vec2::new(BAR_MM, 0.0), Pen::MARK);
    for n in 0..=10 {
        let high = if n % 5 == 0 { 2.5 } else { 1.5 };
        let at = from + Vec2::new(f64::from(n) * BAR_MM / 10.0, 0.0);
        page.line(at, at + Vec2::new(0.0, high), Pen::MARK);
    }
    let caption = Type::new(7.0).at(Anchor::End);
    let text = "100 mm on paper: measure it";
    page.text(from + Vec2::new(BAR_MM, 3.5), text, caption);
}

/// Draws the seams with neighbours, names them, and draws a cross in every corner: neighbours
/// print the same crosses.
fn seams(page: &mut PdfPage, tiling: &Tiling, sheet: PaperSheet, view: &PaperView) {
    let cell = tiling.cell(sheet);
    let cell = Box2 { min: view.place(cell.min), max: view.place(cell.max) };
    let middle = cell.min.lerp(cell.max, 0.5);
    let half = (cell.max - cell.min) * 0.5;
    for (way, neighbour) in tiling.neighbours(sheet) {
        let along = way.perp();
        let seam = middle + Vec2::new(way.x * half.x, way.y * half.y);
        let reach = Vec2::new(along.x * half.x, along.y * half.y);
        page.line(seam + -reach, seam + reach, Pen::SEAM);
        let upwards = way.y == 0.0;
        let mut set = Type::new(7.0).at(Anchor::Middle);
        // The base line lies below letters that run along x, and right of those that run upwards.
        let outwards = if way == Vec2::X || way == Vec2::NEG_Y { 3.4 } else { 1.4 };
        if upwards {
            set = set.upwards();
        }
        page.text(seam + way * outwards, &format!("joins {}", neighbour.name()), set);
    }
    // Half an overlap from the edges everywhere, also where no neighbour is.
    let frame = view.frame();
    let inset = Vec2::splat(0.5 * OVERLAP_MM);
    let (low, high) = (frame.min + inset, frame.max + -inset);
    for (x, y) in [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)] {
        for arm in [Vec2::X, Vec2::Y].map(|way| way * CROSS_MM) {
            let at = Point2::new(x, y);
            page.line(at + -arm, at + arm, Pen::MARK);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_go_on_after_z() {
        let name = |row: usize| PaperSheet { row, column: 2 }.name();
        assert_eq!(
            [0, 1, 25, 26, 27, 51, 52, 701, 702].map(name),
            ["A3", "B3", "Z3", "AA3", "AB3", "AZ3", "BA3", "ZZ3", "AAA3"]
        );
    }
}
