//! A piece on sheets of paper, true to scale.
//!
//! The sheets form a grid of rows A, B, … from the top and columns 1, 2, … from the left. Each
//! shows a window of the piece that overlaps its neighbours' by 10 mm; the seams run along the
//! middle of the overlaps, and where they cross, all four sheets print the same cross.

use super::Paper;
use super::labels::labels;
use super::page::{Anchor, Page, Pen, Type};
use super::piece::{Detail, View, draw};
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::{PatternLabel, Piece};
use sheetwright::predicate::Box2;
use std::ops::Range;

/// Printers leave the edge of a sheet blank, few more than this, mm.
pub(super) const MARGIN_MM: f64 = 10.0;
/// The strip above the window for the name of the sheet and the scale bar, mm.
pub(super) const HEADER_MM: f64 = 16.0;
/// How far the windows of neighbours overlap, mm.
const OVERLAP_MM: f64 = 10.0;
/// At least this much of the window lies around the piece, mm, so that no line lies on its edge.
const AIR_MM: f64 = 1.0;
/// Arms of a cross, mm.
const CROSS_MM: f64 = 4.0;
/// The length of the scale bar, mm.
const BAR_MM: f64 = 100.0;

/// How a piece is divided into sheets.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tiling {
    /// Width and height of a sheet as it is printed, upright or lying, mm.
    page: Vec2,
    /// The lower left corner of the window of the lower left sheet, mm.
    origin: Point2,
    /// How many columns and rows of sheets there are.
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// The sheets that have a part of the piece, row after row.
    pub(super) sheets: Vec<Sheet>,
}

/// A place in the grid of sheets, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Sheet {
    pub(super) row: usize,
    pub(super) column: usize,
}

impl Sheet {
    /// Its name, such as B3: A, B, … Z, AA, AB, … are the rows.
    pub(super) fn name(self) -> String {
        let mut letters = Vec::new();
        let mut row = self.row;
        loop {
            letters.push(char::from(b'A' + (row % 26) as u8));
            if row < 26 {
                break;
            }
            row = row / 26 - 1;
        }
        let letters: String = letters.into_iter().rev().collect();
        format!("{letters}{}", self.column + 1)
    }
}

/// The sheets that a piece takes, on paper upright or lying, whichever takes fewer.
///
/// # Errors
/// About how many, if they are more than `most`. So many would always be enough.
pub(super) fn tiling(piece: &Piece, paper: Paper, most: usize) -> Result<Tiling, usize> {
    let upright = paper.size_mm();
    let candidates =
        [upright, Vec2::new(upright.y, upright.x)].map(|page| on_page(piece, page, most));
    let [first, second] = candidates;
    match (first, second) {
        (Ok(first), Ok(second)) if second.sheets.len() < first.sheets.len() => Ok(second),
        (Ok(tiling), _) | (Err(_), Ok(tiling)) => Ok(tiling),
        (Err(first), Err(second)) => Err(first.min(second)),
    }
}

/// The size of the window of a page, mm.
fn window(page: Vec2) -> Vec2 {
    page - Vec2::new(2.0 * MARGIN_MM, 2.0 * MARGIN_MM + HEADER_MM)
}

fn on_page(piece: &Piece, page: Vec2, most: usize) -> Result<Tiling, usize> {
    let around = Box2::of_points(piece.outline().iter().copied())
        .unwrap_or(Box2 { min: Point2::default(), max: Point2::default() });
    let step = window(page) - Vec2::splat(OVERLAP_MM);
    let need = around.max - around.min + Vec2::splat(2.0 * AIR_MM - OVERLAP_MM);
    // Conversion saturates, so that no size runs over.
    let count = |need: f64, step: f64| (need / step).ceil().max(1.0) as usize;
    let (columns, rows) = (count(need.x, step.x), count(need.y, step.y));
    // Pieces lie in the rectangle of least area around them, so few leave most of it empty.
    let grid = columns.saturating_mul(rows);
    if grid > most.saturating_mul(20) {
        return Err(grid);
    }
    let size = Vec2::new(columns as f64 * step.x, rows as f64 * step.y) + Vec2::splat(OVERLAP_MM);
    let middle = around.min.lerp(around.max, 0.5);
    let corner = middle + size * -0.5;
    // In steps of 0.001 mm, so that the digits on the sheets are exact.
    let rounded = |x: f64| (x * 1000.0).round() / 1000.0;
    let origin = Point2::new(rounded(corner.x), rounded(corner.y));
    let mut tiling = Tiling { page, origin, columns, rows, sheets: Vec::new() };
    tiling.sheets = tiling.touched(piece.loops());
    if tiling.sheets.len() > most { Err(grid) } else { Ok(tiling) }
}

impl Tiling {
    /// What a sheet shows of the piece, mm.
    fn window(&self, sheet: Sheet) -> Box2 {
        let window = window(self.page);
        let step = window - Vec2::splat(OVERLAP_MM);
        let from_below = self.rows - 1 - sheet.row;
        let min = self.origin + Vec2::new(sheet.column as f64 * step.x, from_below as f64 * step.y);
        Box2 { min, max: min + window }
    }

    /// The window up to the seams with its neighbours, mm: the cells of all sheets fill the grid
    /// without overlapping.
    pub(super) fn cell(&self, sheet: Sheet) -> Box2 {
        let Box2 { min, max } = self.window(sheet);
        let half = 0.5 * OVERLAP_MM;
        let inner = |is_inner: bool| if is_inner { half } else { 0.0 };
        let left = inner(sheet.column > 0);
        let right = inner(sheet.column + 1 < self.columns);
        let above = inner(sheet.row > 0);
        let below = inner(sheet.row + 1 < self.rows);
        Box2 { min: min + Vec2::new(left, below), max: max + Vec2::new(-right, -above) }
    }

    /// The box around all windows, mm.
    pub(super) fn extent(&self) -> Box2 {
        let lower_left = Sheet { row: self.rows - 1, column: 0 };
        let upper_right = Sheet { row: 0, column: self.columns - 1 };
        Box2 { min: self.window(lower_left).min, max: self.window(upper_right).max }
    }

    /// The sheets whose cells have a point of the piece: those that its outline or a hole passes
    /// through, and those whose middle lies inside. Edges look at the cells about them alone.
    fn touched<'a>(&self, loops: impl Iterator<Item = &'a [Point2]>) -> Vec<Sheet> {
        let middle = |sheet| {
            let cell = self.cell(sheet);
            cell.min.lerp(cell.max, 0.5)
        };
        let columns: Vec<f64> =
            (0..self.columns).map(|column| middle(Sheet { row: 0, column }).x).collect();
        let mut passed = vec![false; self.rows * self.columns];
        // Whether an odd number of edges crosses the middle of a row between the middles of two
        // columns, the first one left of the middle of column 0.
        let width = self.columns + 1;
        let mut odd = vec![false; self.rows * width];
        for (a, b) in loops.flat_map(edges) {
            let around = Box2::of_segment(a, b);
            for row in self.rows_about(around) {
                let y = middle(Sheet { row, column: 0 }).y;
                if (a.y > y) != (b.y > y) {
                    let x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
                    odd[row * width + columns.partition_point(|&middle| middle < x)] ^= true;
                }
                for column in self.columns_about(around) {
                    passed[row * self.columns + column] |=
                        self.cell(Sheet { row, column }).part_inside(a, b).is_some();
                }
            }
        }
        let mut sheets = Vec::new();
        for row in 0..self.rows {
            let mut inside = false;
            for column in 0..self.columns {
                inside ^= odd[row * width + column];
                if inside || passed[row * self.columns + column] {
                    sheets.push(Sheet { row, column });
                }
            }
        }
        sheets
    }

    /// The columns whose cells a box may have a point of.
    fn columns_about(&self, around: Box2) -> Range<usize> {
        let step = window(self.page).x - OVERLAP_MM;
        about(
            (around.min.x - self.origin.x) / step,
            (around.max.x - self.origin.x) / step,
            self.columns,
        )
    }

    /// The rows whose cells a box may have a point of.
    fn rows_about(&self, around: Box2) -> Range<usize> {
        let step = window(self.page).y - OVERLAP_MM;
        let top = self.origin.y + self.rows as f64 * step;
        about((top - around.max.y) / step, (top - around.min.y) / step, self.rows)
    }

    /// The sheets whose cells a box may have a point of.
    pub(super) fn sheets_about(&self, around: Box2) -> impl Iterator<Item = Sheet> + use<> {
        let columns = self.columns_about(around);
        let rows = self.rows_about(around);
        rows.flat_map(move |row| columns.clone().map(move |column| Sheet { row, column }))
    }

    /// The cells of the sheets that a box reaches into.
    pub(super) fn cells_about(&self, around: Box2) -> Vec<Box2> {
        let sheets = self.sheets_about(around).filter(|&sheet| self.has(sheet));
        let reach = |cell: &Box2| {
            cell.min.x <= around.max.x
                && around.min.x <= cell.max.x
                && cell.min.y <= around.max.y
                && around.min.y <= cell.max.y
        };
        sheets.map(|sheet| self.cell(sheet)).filter(reach).collect()
    }

    fn has(&self, sheet: Sheet) -> bool {
        self.sheets.binary_search(&sheet).is_ok()
    }

    /// The sheets beside one, each with the direction in which it lies.
    fn neighbours(&self, sheet: Sheet) -> Vec<(Vec2, Sheet)> {
        let Sheet { row, column } = sheet;
        let beside = [
            (Vec2::NEG_X, column.checked_sub(1).map(|column| Sheet { row, column })),
            (Vec2::X, Some(Sheet { row, column: column + 1 })),
            (Vec2::Y, row.checked_sub(1).map(|row| Sheet { row, column })),
            (Vec2::NEG_Y, Some(Sheet { row: row + 1, column })),
        ];
        let there = beside.into_iter().filter_map(|(way, sheet)| Some((way, sheet?)));
        there.filter(|&(_, sheet)| self.has(sheet)).collect()
    }
}

fn edges(outline: &[Point2]) -> impl Iterator<Item = (Point2, Point2)> + '_ {
    (0..outline.len()).map(|n| (outline[n], outline[(n + 1) % outline.len()]))
}

/// The cells of a row or column of `count` between two places, in cells from its beginning, and
/// one more on either side: cells begin half an overlap later than windows.
fn about(from: f64, to: f64, count: usize) -> Range<usize> {
    // Conversion saturates, so that what lies outside is cut off.
    let first = ((from - 1.0).floor() as usize).min(count);
    first..((to + 2.0).ceil() as usize).min(count)
}

/// The sheets of a piece.
pub(super) fn pages<'a>(piece: &'a Piece, tiling: &'a Tiling) -> impl Iterator<Item = Page> + 'a {
    let labels = labels(piece, tiling);
    tiling.sheets.iter().map(move |&sheet| page(piece, &labels, tiling, sheet))
}

fn page(piece: &Piece, labels: &[PatternLabel], tiling: &Tiling, sheet: Sheet) -> Page {
    let mut page = Page::new(tiling.page);
    let corner = Point2::new(MARGIN_MM, MARGIN_MM);
    let view = View { shown: tiling.window(sheet), corner, scale: 1.0 };
    let place = format!(
        "row {} of {}, column {} of {}",
        sheet.row + 1,
        tiling.rows,
        sheet.column + 1,
        tiling.columns
    );
    header(&mut page, &piece.name, &sheet.name(), &place, &view);
    draw(&mut page, piece, labels, &view, Detail::Full);
    page.rectangle(view.frame(), Pen::FRAME);
    seams(&mut page, tiling, sheet, &view);
    page
}

/// Names the sheet, says what it shows, and draws the scale bar.
pub(super) fn header(page: &mut Page, piece: &str, sheet: &str, place: &str, view: &View) {
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
fn scale_bar(page: &mut Page, from: Point2) {
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
fn seams(page: &mut Page, tiling: &Tiling, sheet: Sheet, view: &View) {
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
        let name = |row: usize| Sheet { row, column: 2 }.name();
        assert_eq!(
            [0, 1, 25, 26, 27, 51, 52, 701, 702].map(name),
            ["A3", "B3", "Z3", "AA3", "AB3", "AZ3", "BA3", "ZZ3", "AAA3"]
        );
    }
}
