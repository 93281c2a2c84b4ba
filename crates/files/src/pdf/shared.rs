//! Several small pieces on one page, true to scale.

use super::layout::Layout;
use super::packing::{Placed, SharedPage};
use super::page::{MARGIN_MM, PdfPage, Pen, Type};
use super::paper::window;
use super::piece::{Detail, PaperView, draw};
use super::sheets::{BAR_MM, scale_bar};
use sheetwright::math::{Point2, Vec2};
use sheetwright::predicate::Box2;

/// What is shown about a piece beyond its box, mm: half of the widest line.
const ABOUT_MM: f64 = 0.5;
/// The distance of the lines of the grid that is projected, mm.
const GRID_MM: f64 = 50.0;
/// A page names no more pieces.
const NAMED: usize = 6;

/// A page of several pieces.
pub(super) fn page(layout: &Layout<'_>, shared: &SharedPage) -> PdfPage {
    let mut page = PdfPage::of(shared.page, shared.turned);
    let corner = Point2::new(MARGIN_MM, MARGIN_MM);
    if layout.paper.is_projected() {
        grid(&mut page, Box2 { min: corner, max: corner + window(shared.page) });
    }
    header(&mut page, layout, shared);
    draw_parts(&mut page, layout, &shared.parts, corner, 1.0, Detail::Full);
    page
}

/// Draws some pieces in their places, from the lower left corner of what they lie in.
pub(super) fn draw_parts(
    page: &mut PdfPage,
    layout: &Layout<'_>,
    parts: &[Placed],
    corner: Point2,
    scale: f64,
    detail: Detail,
) {
    for placed in parts {
        let about = Vec2::splat(ABOUT_MM);
        let Box2 { min, max } = layout.boxes[placed.part];
        let shown = Box2 { min: min + -about, max: max + about };
        let corner = corner + (placed.at - about) / scale;
        draw(page, layout.pieces[placed.part], &PaperView { shown, corner, scale }, detail);
    }
}

/// The names of the pieces of a page: all of a few, else the first and how many more.
pub(super) fn names(layout: &Layout<'_>, parts: &[Placed]) -> String {
    let name = |placed: &Placed| layout.pieces[placed.part].name.clone();
    if parts.len() <= NAMED {
        return parts.iter().map(name).collect::<Vec<_>>().join(", ");
    }
    let first: Vec<String> = parts.iter().take(NAMED - 1).map(name).collect();
    format!("{} and {} more", first.join(", "), parts.len() + 1 - NAMED)
}

fn header(page: &mut PdfPage, layout: &Layout<'_>, shared: &SharedPage) {
    let size = page.size();
    let (top, right) = (size.y - MARGIN_MM, size.x - MARGIN_MM);
    let left_room = right - BAR_MM - MARGIN_MM - 5.0;
    let count = shared.parts.len();
    let parts = if count == 1 { "1 part".to_owned() } else { format!("{count} parts") };
    let title = match layout.title {
        "" => parts,
        title => format!("{title}   {parts}"),
    };
    let at = Point2::new(MARGIN_MM, top - 6.0);
    // The widths are those of the regular font; the bold one is wider by less than a tenth.
    page.fitted_text(at, &title, Type::new(14.0).bold(), left_room / 1.1);
    let how = if layout.paper.is_projected() {
        format!("Show it at true size: the lines of the grid are {GRID_MM} mm apart.")
    } else {
        "Print at 100 %.".to_owned()
    };
    let shown = format!("This page: {} at 1:1. {how}", names(layout, &shared.parts));
    let at = Point2::new(MARGIN_MM, top - 13.5);
    page.fitted_text(at, &shown, Type::new(7.5), right - MARGIN_MM);
    scale_bar(page, Point2::new(right - BAR_MM, top - 7.0));
}

/// Draws lines of a grid from the lower left corner of a box.
fn grid(page: &mut PdfPage, around: Box2) {
    let Box2 { min, max } = around;
    let size = max - min;
    let count = |length: f64| (length / GRID_MM).floor() as usize;
    for n in 0..=count(size.x) {
        let x = min.x + GRID_MM * n as f64;
        page.line(Point2::new(x, min.y), Point2::new(x, max.y), Pen::FRAME);
    }
    for n in 0..=count(size.y) {
        let y = min.y + GRID_MM * n as f64;
        page.line(Point2::new(min.x, y), Point2::new(max.x, y), Pen::FRAME);
    }
}
