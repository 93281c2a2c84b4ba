//! The first pages: a list of the pieces, instructions, and a square that checks the printed scale.

use super::layout::{Layout, Leaves, Plan};
use super::list::{self, Row};
use super::page::{Anchor, MARGIN_MM, PdfPage, Pen, Type};
use super::paper::Paper;
use super::piece::{Detail, PaperView, draw, is_valley};
use super::shared::{draw_parts, names};
use super::text::{encoded, width};
use super::tiling::{PaperSheet, Tiling};
use super::way_to_sheets;
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::{PathKind, PatternPath, Piece, Role};
use sheetwright::predicate::Box2;
use std::collections::BTreeMap;

/// The side of the check square, mm.
const CHECK_MM: f64 = 100.0;
/// The height of the title above the check square, mm.
const TITLE_MM: f64 = 18.0;
/// The gap below the check square, mm.
const BELOW_MM: f64 = 10.0;
/// Pieces are drawn no higher than this, mm, so that at least one stands on the first page.
const DRAWING_MM: f64 = 110.0;
/// Pieces of one sheet are drawn no higher than this, mm: there is no grid to read off.
const ONE_SHEET_MM: f64 = 55.0;
/// Pages of several pieces are drawn no larger than this, mm: three stand beside one another.
const SHARED_MM: Vec2 = Vec2::new(58.0, 58.0);
/// The height above the drawing of a piece for its name and size, mm.
const CAPTION_MM: f64 = 12.0;
/// The gap between two pieces, mm.
const GAP_MM: f64 = 6.0;

/// The drawing of some leaves: the part that it shows, mm, and the denominator of its scale.
struct Block {
    leaves: Leaves,
    shown: Box2,
    scale: f64,
    /// The width that it takes, mm.
    width_mm: f64,
}

impl Block {
    fn new(layout: &Layout<'_>, leaves: Leaves, width_mm: f64) -> Self {
        let none = Box2 { min: Point2::default(), max: Point2::default() };
        let outline = |n: usize| Box2::of_points(layout.pieces[n].outline().iter().copied());
        let (shown, most) = match leaves {
            Leaves::Shared(n) => {
                let max = Point2::default() + layout.shared[n].page;
                (Box2 { max, ..none }, SHARED_MM)
            }
            Leaves::Piece(n) => match &layout.plans[n] {
                Plan::Tiled(tiling) => {
                    let one_sheet = tiling.sheets.len() == 1;
                    let height_mm = if one_sheet { ONE_SHEET_MM } else { DRAWING_MM };
                    (tiling.extent(), Vec2::new(width_mm, height_mm))
                }
                Plan::Reduced(_) | Plan::Shared(_) | Plan::OnFirst => {
                    (outline(n).unwrap_or(none), Vec2::new(width_mm, DRAWING_MM))
                }
            },
        };
        let size = shown.max - shown.min;
        let scale = (size.x / most.x).max(size.y / most.y).max(1.0);
        let width_mm = if matches!(leaves, Leaves::Shared(_)) { most.x } else { width_mm };
        Self { leaves, shown, scale, width_mm }
    }

    fn height_mm(&self) -> f64 {
        CAPTION_MM + (self.shown.max.y - self.shown.min.y) / self.scale + GAP_MM
    }
}

/// What the first page has left below its head for pieces, mm.
pub(super) fn first_room(paper: Paper) -> Vec2 {
    let size = paper.overview_mm();
    let head = TITLE_MM + CHECK_MM + BELOW_MM;
    size - Vec2::new(2.0 * MARGIN_MM, 2.0 * MARGIN_MM + head)
}

/// The pages that stand before the sheets.
pub(super) fn pages(layout: &Layout<'_>) -> Vec<PdfPage> {
    let size = layout.paper.overview_mm();
    let width_mm = size.x - 2.0 * MARGIN_MM;
    let blocks: Vec<Block> =
        layout.order().into_iter().map(|leaves| Block::new(layout, leaves, width_mm)).collect();

    // Places all blocks first, since the captions name the pages that follow them.
    let first_top = size.y - MARGIN_MM - TITLE_MM - CHECK_MM - BELOW_MM;
    let is_listed = |plan: &&Plan| matches!(plan, Plan::Shared(_));
    let listed = layout.plans.iter().filter(is_listed).count();
    let (on_page, top) = list::end(listed, first_top, size);
    let mut flow = Flow { page: size, on_page, top, left: MARGIN_MM, high: 0.0 };
    let places: Vec<(usize, Point2)> =
        blocks.iter().map(|block| flow.place(block.width_mm, block.height_mm())).collect();

    let count = flow.on_page + 1;
    let mut pages: Vec<PdfPage> = (0..count).map(|_| PdfPage::new(size)).collect();
    first(&mut pages[0], layout);
    let corner = Point2::new(MARGIN_MM, MARGIN_MM);
    draw_parts(&mut pages[0], layout, &layout.on_first, corner, 1.0, Detail::Full);
    let mut next_page = count + 1;
    let mut shared_on = vec![0; layout.shared.len()];
    for (block, (on_page, at)) in blocks.iter().zip(places) {
        let take = layout.pages(block.leaves);
        let page = &mut pages[on_page];
        match block.leaves {
            Leaves::Shared(n) => {
                shared_on[n] = next_page;
                shared_block(page, layout, n, block, at, next_page);
            }
            Leaves::Piece(n) => {
                let on = (next_page, next_page + take - 1);
                piece_block(page, layout.pieces[n], &layout.plans[n], block, at.y, on);
            }
        }
        next_page += take;
    }
    let rows = layout.plans.iter().zip(layout.pieces).filter_map(|(plan, piece)| match plan {
        Plan::Shared(n) => Some(Row { piece, page: shared_on[*n] }),
        Plan::Tiled(_) | Plan::Reduced(_) | Plan::OnFirst => None,
    });
    let rows: Vec<Row<'_>> = rows.collect();
    list::draw(&mut pages, &rows, first_top);
    pages
}

/// Where the next block stands: blocks fill rows from left to right.
struct Flow {
    page: Vec2,
    on_page: usize,
    /// The top of the row.
    top: f64,
    /// Where the next block begins.
    left: f64,
    /// The height of the row so far.
    high: f64,
}

impl Flow {
    /// The page and the upper left corner of a block of this size, mm.
    fn place(&mut self, width_mm: f64, height_mm: f64) -> (usize, Point2) {
        const EPS: f64 = 1e-9;
        if self.left + width_mm > self.page.x - MARGIN_MM + EPS {
            self.end_row();
        }
        if self.top - height_mm < MARGIN_MM - GAP_MM {
            self.end_row();
            self.on_page += 1;
            self.top = self.page.y - MARGIN_MM;
        }
        let at = Point2::new(self.left, self.top);
        self.left += width_mm + GAP_MM;
        self.high = self.high.max(height_mm);
        (self.on_page, at)
    }

    fn end_row(&mut self) {
        self.top -= self.high;
        (self.left, self.high) = (MARGIN_MM, 0.0);
    }
}

/// A page of several pieces.
fn shared_block(
    page: &mut PdfPage,
    layout: &Layout<'_>,
    number: usize,
    block: &Block,
    at: Point2,
    on: usize,
) {
    let shared = &layout.shared[number];
    let title = format!("Page {on}: {} parts", shared.parts.len());
    let most_mm = block.width_mm;
    page.fitted_text(at + Vec2::new(0.0, -4.5), &title, Type::new(10.0).bold(), most_mm / 1.1);
    let told = names(layout, &shared.parts);
    page.fitted_text(at + Vec2::new(0.0, -9.5), &told, Type::new(7.5), most_mm);
    let size = (block.shown.max - block.shown.min) / block.scale;
    let corner = at + Vec2::new(0.0, -CAPTION_MM - size.y);
    page.rectangle(Box2 { min: corner, max: corner + size }, Pen::FRAME);
    let window = corner + Vec2::splat(MARGIN_MM / block.scale);
    draw_parts(page, layout, &shared.parts, window, block.scale, Detail::Lines);
}

/// The head of the first page: title, check square, legend and instructions.
fn first(page: &mut PdfPage, layout: &Layout<'_>) {
    let (title, paper) = (layout.title, layout.paper);
    let size = page.size();
    let (left, top) = (MARGIN_MM, size.y - MARGIN_MM);
    let width_mm = size.x - 2.0 * MARGIN_MM;
    let title = if title.is_empty() { "Pattern" } else { title };
    let at = Point2::new(left, top - 6.0);
    page.fitted_text(at, title, Type::new(18.0).bold(), width_mm / 1.1);
    let line = format!(
        "Flat pattern on {}. Print at 100 % (\"actual size\"), never \"fit to page\".",
        paper.title()
    );
    page.text(Point2::new(left, top - 12.5), &line, Type::new(9.0));

    let corner = Point2::new(left, top - TITLE_MM - CHECK_MM);
    let square = Box2 { min: corner, max: corner + Vec2::splat(CHECK_MM) };
    page.rectangle(square, Pen::MARK);
    let middle = corner + Vec2::splat(0.5 * CHECK_MM);
    let set = Type::new(11.0).bold().at(Anchor::Middle);
    page.text(middle + Vec2::new(0.0, 3.0), "Check square: 100 × 100 mm", set);
    let lines =
        ["Measure it both ways before you cut.", "If it is not 100 mm, print again at 100 %."];
    for (n, line) in lines.iter().enumerate() {
        let below = Vec2::new(0.0, -4.0 - 4.5 * n as f64);
        page.text(middle + below, line, Type::new(9.0).at(Anchor::Middle));
    }

    let column = left + CHECK_MM + 8.0;
    let mut y = square.max.y - 3.5;
    let heading = |page: &mut PdfPage, y: f64, text: &str| {
        page.text(Point2::new(column, y), text, Type::new(10.0).bold());
    };
    heading(page, y, "Lines");
    for (pen, text) in lines_drawn(layout) {
        y -= 5.5;
        page.line(Point2::new(column, y + 1.1), Point2::new(column + 14.0, y + 1.1), pen);
        page.text(Point2::new(column + 17.0, y), text, Type::new(9.0));
    }
    y -= 11.0;
    let (title, lines): (&str, &[&str]) = match layout.on_first.len() {
        0 => ("Putting sheets together", &TOGETHER),
        1 => ("Part", &["It stands below, at 1:1."]),
        _ => ("Parts", &["They stand below, at 1:1."]),
    };
    heading(page, y, title);
    for line in lines {
        y -= 4.6;
        page.text(Point2::new(column, y), line, Type::new(9.0));
    }
    // The sizes of a few pieces have room beside the check square.
    let sized = if layout.on_first.len() <= SIZED { &layout.on_first[..] } else { &[] };
    for placed in sized {
        y -= 4.6;
        let piece = layout.pieces[placed.part];
        let size = piece.size;
        let line = format!("{}: {:.1} × {:.1} mm", list::counted(piece), size.x, size.y);
        let most_mm = page.size().x - MARGIN_MM - column;
        page.fitted_text(Point2::new(column, y), &line, Type::new(9.0), most_mm);
    }
}

/// The kinds of lines that some page has, and what they mean.
fn lines_drawn(layout: &Layout<'_>) -> Vec<(Pen, &'static str)> {
    let has = |is_it: &dyn Fn(&PatternPath) -> bool| {
        let mut paths = layout.pieces.iter().flat_map(|piece| &piece.paths);
        paths.any(|path| path.kind != PathKind::Dimension && is_it(path))
    };
    let is_score = |path: &PatternPath| path.role == Role::Score && !is_valley(path);
    let is_tiled = layout.plans.iter().any(|plan| matches!(plan, Plan::Tiled(_)));
    let lines = [
        (true, Pen::CUT, "cut"),
        (has(&|path| path.role == Role::Net), Pen::NET, "outline of the finished piece"),
        (has(&is_score), Pen::SCORE, "score or fold"),
        (has(&is_valley), Pen::VALLEY, "fold towards you"),
        (true, Pen::ENGRAVE, "mark: names, ends of rulings"),
        (has(&|path| path.role == Role::Note), Pen::NOTE, "rulings: straight when bent"),
        (is_tiled, Pen::SEAM, "where sheets meet"),
    ];
    lines.into_iter().filter(|line| line.0).map(|(_, pen, text)| (pen, text)).collect()
}

/// So many pieces on the first page have their sizes there.
const SIZED: usize = 10;

/// How sheets are put together.
const TOGETHER: [&str; 9] = [
    "Sheets are named by row and column: B3 is",
    "the third of the second row from the top.",
    "Neighbours overlap by 10 mm. Lay crosses on",
    "crosses and dotted lines on dotted lines,",
    "against a window if need be, then tape.",
    "Sheets that show nothing are left out.",
    "",
    "Paper grows and shrinks with the weather:",
    "check long pieces by the sizes given below.",
];

/// One piece, with its sheets.
fn piece_block(
    page: &mut PdfPage,
    piece: &Piece,
    plan: &Plan,
    block: &Block,
    top: f64,
    on: (usize, usize),
) {
    let width_mm = page.size().x - 2.0 * MARGIN_MM;
    let at = Point2::new(MARGIN_MM, top - 4.5);
    let title = list::counted(piece);
    page.fitted_text(at, &title, Type::new(12.0).bold(), width_mm / 1.1);
    let size = format!("{:.1} × {:.1} mm", piece.size.x, piece.size.y);
    let pages =
        if on.0 == on.1 { format!("page {}", on.0) } else { format!("pages {}–{}", on.0, on.1) };
    let told = match plan {
        Plan::Tiled(tiling) => {
            let count = tiling.sheets.len();
            let sheets = if count == 1 { "1 sheet".to_owned() } else { format!("{count} sheets") };
            format!("{size}. {sheets} on {pages}. Drawn here at 1:{:.1}.", block.scale)
        }
        Plan::Reduced(reduced) => format!(
            "{size}. About {} sheets at 1:1, so it is drawn at 1:{} with a table of offsets on \
             {pages}.{}",
            reduced.sheets,
            reduced.scale,
            way_to_sheets(reduced.sheets, reduced.file_full)
                .map_or(String::new(), |way| format!(" {way}"))
        ),
        // They have no block of their own.
        Plan::Shared(_) | Plan::OnFirst => size,
    };
    page.fitted_text(Point2::new(MARGIN_MM, top - 9.5), &told, Type::new(9.0), width_mm);
    let height_mm = (block.shown.max.y - block.shown.min.y) / block.scale;
    let corner = Point2::new(MARGIN_MM, top - CAPTION_MM - height_mm);
    let view = PaperView { shown: block.shown, corner, scale: block.scale };
    if let Plan::Tiled(tiling) = plan {
        grid(page, piece, tiling, &view);
    }
    draw(page, piece, &view, Detail::Lines);
}

/// Draws the cells of the sheets, and their names clear of the lines of the piece if possible.
fn grid(page: &mut PdfPage, piece: &Piece, tiling: &Tiling, view: &PaperView) {
    let lines = lines_of_cells(piece, tiling);
    for &sheet in &tiling.sheets {
        let cell = tiling.cell(sheet);
        let cell = Box2 { min: view.place(cell.min), max: view.place(cell.max) };
        page.rectangle(cell, Pen::FRAME);
        let near = lines.get(&sheet).map_or(&[][..], |list| &list[..]);
        let near: Vec<[Point2; 2]> = near.iter().map(|e| e.map(|p| view.place(p))).collect();
        let name = sheet.name();
        let (size_pt, base) = name_place(&name, cell, &near);
        page.text(base, &name, Type::new(size_pt));
    }
}

/// The letter size of a sheet's name, pt, and the place where it begins in the cell: the largest
/// size and the first place that no line crosses, else those that the fewest lines cross.
fn name_place(name: &str, cell: Box2, lines: &[[Point2; 2]]) -> (f64, Point2) {
    let room = cell.max - cell.min;
    let largest_pt = (room.y * 1.6).min(room.x * 3.6 / name.len() as f64).min(8.0);
    let sizes = [1.0, 0.75, 0.55].map(|share| share * largest_pt);
    let tries = sizes
        .into_iter()
        .flat_map(|size_pt| places(cell, name_box(name, size_pt)).map(move |base| (size_pt, base)));
    let crossings = |&(size_pt, base): &(f64, Point2)| {
        let air = Vec2::splat(NAME_AIR_MM);
        let around = Box2 { min: base + -air, max: base + name_box(name, size_pt) + air };
        lines.iter().filter(|[a, b]| around.part_inside(*a, *b).is_some()).count()
    };
    tries.min_by_key(crossings).unwrap_or((largest_pt, cell.min))
}

/// The least gap between the name of a sheet and a line, mm.
const NAME_AIR_MM: f64 = 0.3;

/// Width and height of the name of a sheet, mm.
fn name_box(name: &str, size_pt: f64) -> Vec2 {
    let mm = size_pt * (25.4 / 72.0);
    Vec2::new(width(&encoded(name)) * mm, 0.72 * mm)
}

/// The places where the name of a sheet may begin in its cell, the best first: the corners, the
/// middles of the sides, the middle.
fn places(cell: Box2, size: Vec2) -> impl Iterator<Item = Point2> {
    let low = cell.min + Vec2::splat(0.5);
    let high = cell.max + -(size + Vec2::splat(0.5));
    let shares = [(0.0, 1.0), (1.0, 1.0), (0.0, 0.0), (1.0, 0.0)];
    let more = [(0.5, 1.0), (0.5, 0.0), (0.0, 0.5), (1.0, 0.5), (0.5, 0.5)];
    let at = move |(x, y): (f64, f64)| {
        Point2::new(low.x + x * (high.x - low.x), low.y + y * (high.y - low.y))
    };
    shares.into_iter().chain(more).map(at)
}

/// The lines that the overview draws, by the sheets whose cells they may pass.
fn lines_of_cells(piece: &Piece, tiling: &Tiling) -> BTreeMap<PaperSheet, Vec<[Point2; 2]>> {
    let mut found: BTreeMap<PaperSheet, Vec<[Point2; 2]>> = BTreeMap::new();
    let drawn = piece.paths.iter().filter(|p| p.role.is_cut() || p.role == Role::Score);
    for path in drawn {
        let count = path.points.len() - usize::from(!path.closed);
        for n in 0..count {
            let ends = [path.points[n], path.points[(n + 1) % path.points.len()]];
            for sheet in tiling.sheets_about(Box2::of_segment(ends[0], ends[1])) {
                found.entry(sheet).or_default().push(ends);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_sheet_stands_off_the_lines() {
        let at = Point2::new;
        let cell = Box2 { min: at(0.0, 0.0), max: at(20.0, 14.0) };
        let crossed = |lines: &[[Point2; 2]]| {
            let (size_pt, base) = name_place("B13", cell, lines);
            let around = Box2 { min: base, max: base + name_box("B13", size_pt) };
            assert!(cell.min.x <= around.min.x && around.max.x <= cell.max.x);
            assert!(cell.min.y <= around.min.y && around.max.y <= cell.max.y);
            lines.iter().any(|[a, b]| around.part_inside(*a, *b).is_some())
        };
        let (_, corner) = name_place("B13", cell, &[]);
        assert!(corner.x < 1.0 && corner.y > 10.0, "in the upper left corner");
        assert!(!crossed(&[[at(0.0, 12.0), at(20.0, 12.0)]]));
        assert!(!crossed(&[[at(0.0, 14.0), at(20.0, 0.0)], [at(0.0, 0.0), at(20.0, 14.0)]]));
        let steps = (0..3).map(|n| 12.5 - 5.0 * f64::from(n));
        let lines: Vec<_> = steps.map(|y| [at(0.0, y), at(20.0, y)]).collect();
        assert!(!crossed(&lines), "smaller, between lines");
    }
}
