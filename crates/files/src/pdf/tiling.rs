//! How a piece is divided into sheets of paper: a grid of rows A, B, … from the top and columns 1,
//! 2, … from the left, portrait or landscape, the one with fewer sheets.
//!
//! Texts beside the piece are shown in their places where that takes no more sheets; else the
//! sheets are those of the lines to cut, and such texts move ([`super::labels`]).

use super::drawn::{cut_around, drawn_around, drawn_lines};
use super::paper::{AIR_MM, PageSides, Paper, window};
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::Piece;
use sheetwright::predicate::Box2;
use std::ops::Range;

/// How far the windows of neighbours overlap, mm.
pub(super) const OVERLAP_MM: f64 = 10.0;
/// How a piece is divided into sheets.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tiling {
    /// Width and height of a sheet as printed, portrait or landscape, mm.
    pub(super) page: Vec2,
    /// Whether a sheet is turned by a quarter when it is finished.
    pub(super) turned: bool,
    /// The lower left corner of the window of the lower left sheet, mm.
    origin: Point2,
    /// The numbers of columns and rows of sheets.
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// The sheets that have a part of the piece, row after row.
    pub(super) sheets: Vec<PaperSheet>,
}

/// A place in the grid of sheets, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PaperSheet {
    pub(super) row: usize,
    pub(super) column: usize,
}

impl PaperSheet {
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

/// The sheets that a piece takes, portrait or landscape, the one with fewer sheets.
///
/// # Errors
/// An upper bound on the number of sheets, if they are more than `most`.
pub(super) fn tiling(piece: &Piece, paper: Paper, most: usize) -> Result<Tiling, u64> {
    let cut = cut_around(piece);
    let alone = best(piece, cut, &[], paper, most);
    let drawn = drawn_around(piece);
    if drawn == cut {
        return alone;
    }
    match (alone, best(piece, drawn, &drawn_lines(piece), paper, most)) {
        (Ok(alone), Ok(with_texts)) if with_texts.sheets.len() <= alone.sheets.len() => {
            Ok(with_texts)
        }
        (alone, _) => alone,
    }
}

/// The sheets that show the lines to cut and some others in a box, portrait or landscape: fewest
/// sheets, then least paper.
fn best(
    piece: &Piece,
    around: Box2,
    lines: &[Vec<Point2>],
    paper: Paper,
    most: usize,
) -> Result<Tiling, u64> {
    let on_pages = |sides| on_pages(piece, around, lines, sides, most);
    let [first, second] = paper.pages().map(on_pages);
    let cost = |tiling: &Tiling| {
        let Vec2 { x, y } = tiling.page;
        (tiling.sheets.len(), x * y)
    };
    match (first, second) {
        (Ok(first), Ok(second)) if cost(&second) < cost(&first) => Ok(second),
        (Ok(tiling), _) | (Err(_), Ok(tiling)) => Ok(tiling),
        (Err(first), Err(second)) => Err(first.min(second)),
    }
}

fn on_pages(
    piece: &Piece,
    around: Box2,
    lines: &[Vec<Point2>],
    sides: PageSides,
    most: usize,
) -> Result<Tiling, u64> {
    let need = around.max - around.min + Vec2::splat(2.0 * AIR_MM - OVERLAP_MM);
    // The conversion saturates, so that no size overflows: at 64 bits on every machine, since the
    // number is told where it is too large.
    let count = |need: f64, step: f64| (need / step).ceil().max(1.0) as u64;
    let step = window(sides.largest()) - Vec2::splat(OVERLAP_MM);
    let (columns, rows) = (count(need.x, step.x), count(need.y, step.y));
    // Where pages are as large as need be, those of a row share it equally.
    let share = Vec2::new(need.x / columns as f64, need.y / rows as f64);
    let page = sides.around(share + Vec2::splat(OVERLAP_MM));
    let step = window(page) - Vec2::splat(OVERLAP_MM);
    // A piece lies in its bounding rectangle of least area and seldom leaves most of it empty. So a
    // grid of 20 times the limit is refused before its cells are checked.
    let grid = columns.saturating_mul(rows);
    if grid > (most as u64).saturating_mul(20) {
        return Err(grid);
    }
    let (columns, rows) = (columns as usize, rows as usize);
    let size = Vec2::new(columns as f64 * step.x, rows as f64 * step.y) + Vec2::splat(OVERLAP_MM);
    let middle = around.min.lerp(around.max, 0.5);
    let corner = middle + size * -0.5;
    // In steps of 0.001 mm, so that the digits on the sheets are exact.
    let rounded = |x: f64| (x * 1000.0).round() / 1000.0;
    let origin = Point2::new(rounded(corner.x), rounded(corner.y));
    let turned = sides.turned;
    let mut tiling = Tiling { page, turned, origin, columns, rows, sheets: Vec::new() };
    tiling.sheets = tiling.touched(piece.loops(), lines);
    if tiling.sheets.len() > most { Err(grid) } else { Ok(tiling) }
}

impl Tiling {
    /// The part of the piece that a sheet shows, mm.
    pub(super) fn window(&self, sheet: PaperSheet) -> Box2 {
        let window = window(self.page);
        let step = window - Vec2::splat(OVERLAP_MM);
        let from_below = self.rows - 1 - sheet.row;
        let min = self.origin + Vec2::new(sheet.column as f64 * step.x, from_below as f64 * step.y);
        Box2 { min, max: min + window }
    }

    /// The window up to the seams with its neighbours, mm: the cells of all sheets fill the grid
    /// without overlapping.
    pub(super) fn cell(&self, sheet: PaperSheet) -> Box2 {
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
        let lower_left = PaperSheet { row: self.rows - 1, column: 0 };
        let upper_right = PaperSheet { row: 0, column: self.columns - 1 };
        Box2 { min: self.window(lower_left).min, max: self.window(upper_right).max }
    }

    /// The sheets whose cells have a point of the piece: those that its outline or a hole passes
    /// through, those whose middle lies inside, and those that one of some other lines passes
    /// through. Each edge checks only the cells near it.
    fn touched<'a>(
        &self,
        loops: impl Iterator<Item = &'a [Point2]>,
        lines: &[Vec<Point2>],
    ) -> Vec<PaperSheet> {
        let middle = |sheet| {
            let cell = self.cell(sheet);
            cell.min.lerp(cell.max, 0.5)
        };
        let columns: Vec<f64> =
            (0..self.columns).map(|column| middle(PaperSheet { row: 0, column }).x).collect();
        let mut passed = vec![false; self.rows * self.columns];
        // For each row, whether an odd number of edges crosses its middle line between the middles
        // of two neighbouring columns; the first entry is for the part left of the middle of column
        // 0.
        let width = self.columns + 1;
        let mut odd = vec![false; self.rows * width];
        for (a, b) in loops.flat_map(edges) {
            let around = Box2::of_segment(a, b);
            for row in self.rows_about(around) {
                let y = middle(PaperSheet { row, column: 0 }).y;
                if (a.y > y) != (b.y > y) {
                    let x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
                    odd[row * width + columns.partition_point(|&middle| middle < x)] ^= true;
                }
                for column in self.columns_about(around) {
                    passed[row * self.columns + column] |=
                        self.cell(PaperSheet { row, column }).part_inside(a, b).is_some();
                }
            }
        }
        for step in lines.iter().flat_map(|line| line.windows(2)) {
            for sheet in self.sheets_about(Box2::of_segment(step[0], step[1])) {
                passed[sheet.row * self.columns + sheet.column] |=
                    self.cell(sheet).part_inside(step[0], step[1]).is_some();
            }
        }
        let mut sheets = Vec::new();
        for row in 0..self.rows {
            let mut inside = false;
            for column in 0..self.columns {
                inside ^= odd[row * width + column];
                if inside || passed[row * self.columns + column] {
                    sheets.push(PaperSheet { row, column });
                }
            }
        }
        sheets
    }

    /// The columns whose cells a box may overlap.
    fn columns_about(&self, around: Box2) -> Range<usize> {
        let step = window(self.page).x - OVERLAP_MM;
        about(
            (around.min.x - self.origin.x) / step,
            (around.max.x - self.origin.x) / step,
            self.columns,
        )
    }

    /// The rows whose cells a box may overlap.
    fn rows_about(&self, around: Box2) -> Range<usize> {
        let step = window(self.page).y - OVERLAP_MM;
        let top = self.origin.y + self.rows as f64 * step;
        about((top - around.max.y) / step, (top - around.min.y) / step, self.rows)
    }

    /// The sheets whose cells a box may overlap.
    pub(super) fn sheets_about(&self, around: Box2) -> impl Iterator<Item = PaperSheet> + use<> {
        let columns = self.columns_about(around);
        let rows = self.rows_about(around);
        rows.flat_map(move |row| columns.clone().map(move |column| PaperSheet { row, column }))
    }

    /// The cells of the sheets that a box overlaps.
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

    /// The cell of the sheet nearest to a box.
    pub(super) fn nearest_cell(&self, around: Box2) -> Option<Box2> {
        let middle = around.min.lerp(around.max, 0.5);
        let off = |cell: &Box2| {
            let x = middle.x.clamp(cell.min.x, cell.max.x);
            Point2::new(x, middle.y.clamp(cell.min.y, cell.max.y)).distance(middle)
        };
        let cells = self.sheets.iter().map(|&sheet| self.cell(sheet));
        cells.min_by(|a, b| off(a).total_cmp(&off(b)))
    }

    fn has(&self, sheet: PaperSheet) -> bool {
        self.sheets.binary_search(&sheet).is_ok()
    }

    /// The sheets beside one, each with the direction in which it lies.
    pub(super) fn neighbours(&self, sheet: PaperSheet) -> Vec<(Vec2, PaperSheet)> {
        let PaperSheet { row, column } = sheet;
        let beside = [
            (Vec2::NEG_X, column.checked_sub(1).map(|column| PaperSheet { row, column })),
            (Vec2::X, Some(PaperSheet { row, column: column + 1 })),
            (Vec2::Y, row.checked_sub(1).map(|row| PaperSheet { row, column })),
            (Vec2::NEG_Y, Some(PaperSheet { row: row + 1, column })),
        ];
        let there = beside.into_iter().filter_map(|(way, sheet)| Some((way, sheet?)));
        there.filter(|&(_, sheet)| self.has(sheet)).collect()
    }
}

fn edges(outline: &[Point2]) -> impl Iterator<Item = (Point2, Point2)> + '_ {
    (0..outline.len()).map(|n| (outline[n], outline[(n + 1) % outline.len()]))
}

/// The indices of the cells between two places of a row or column of `count` cells, and one more on
/// either side, since cells begin half an overlap later than windows. Places are in cells from the
/// beginning.
fn about(from: f64, to: f64, count: usize) -> Range<usize> {
    // The conversion saturates, which clips places outside.
    let first = ((from - 1.0).floor() as usize).min(count);
    first..((to + 2.0).ceil() as usize).min(count)
}
