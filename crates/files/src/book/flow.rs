//! Pages that fill from the top: headings, paragraphs and tables, each where there is room for it.

use crate::pdf::{Anchor, Paper, PdfPage, Pen, Type, shortened, text_mm, wrapped};
use sheetwright::math::{Point2, Vec2};

/// The margin left, right and below, mm.
const MARGIN_MM: f64 = 15.0;
/// From the upper edge of a page to what stands on it, mm; the header lies between.
const TOP_MM: f64 = 24.0;
/// The height of the foot with the number of the page, mm.
const FOOT_MM: f64 = 8.0;
/// Bold letters are wider than those of the table of widths by less than this.
const BOLD: f64 = 1.1;
/// The size of letters of paragraphs and tables, pt.
pub(super) const TEXT_PT: f64 = 9.0;
/// From one base line of them to the next, mm.
pub(super) const LINE_MM: f64 = 4.4;

/// The gap between two columns of a table, mm.
const COLUMN_GAP_MM: f64 = 4.5;

/// A page with the name of its section.
struct FlowPage {
    page: PdfPage,
    section: String,
}

/// Pages, and where on the last of them the next thing goes.
pub(super) struct Flow {
    size: Vec2,
    pages: Vec<FlowPage>,
    /// The height of the cursor above the lower edge, mm.
    y: f64,
}

/// A column of a table.
#[derive(Clone, Copy)]
pub(super) struct Column {
    pub(super) title: &'static str,
    /// Its share of the width.
    pub(super) share: f64,
    /// Whether it holds numbers, which end on one line.
    pub(super) is_number: bool,
}

/// A column of words.
pub(super) const fn words(title: &'static str, share: f64) -> Column {
    Column { title, share, is_number: false }
}

/// A column of numbers.
pub(super) const fn number(title: &'static str, share: f64) -> Column {
    Column { title, share, is_number: true }
}

impl Flow {
    pub(super) fn new(paper: Paper) -> Self {
        Self { size: paper.book_mm(), pages: Vec::new(), y: 0.0 }
    }

    /// Width and height of a page, mm.
    pub(super) fn size(&self) -> Vec2 {
        self.size
    }

    /// The left end of everything, mm.
    pub(super) fn left(&self) -> f64 {
        MARGIN_MM
    }

    /// The width of everything, mm.
    pub(super) fn width(&self) -> f64 {
        self.size.x - 2.0 * MARGIN_MM
    }

    /// The height that is left on the page, mm.
    pub(super) fn room(&self) -> f64 {
        self.y - MARGIN_MM - FOOT_MM
    }

    /// The height of an empty page, mm.
    pub(super) fn whole_room(&self) -> f64 {
        self.size.y - TOP_MM - MARGIN_MM - FOOT_MM
    }

    /// Begins a page of a section.
    fn begin(&mut self, section: &str) -> &mut PdfPage {
        self.y = self.size.y - TOP_MM;
        let page = PdfPage::new(self.size);
        self.pages.push(FlowPage { page, section: section.to_owned() });
        let last = self.pages.len() - 1;
        &mut self.pages[last].page
    }

    /// The page with the cursor.
    pub(super) fn page(&mut self) -> &mut PdfPage {
        if self.pages.is_empty() {
            self.begin("");
        }
        let last = self.pages.len() - 1;
        &mut self.pages[last].page
    }

    /// Takes a height of a page, which may be the next one, and returns the upper end of it, mm.
    pub(super) fn take(&mut self, height_mm: f64) -> f64 {
        self.keep(height_mm);
        let top = self.y;
        self.y -= height_mm;
        top
    }

    /// Goes on to the next page unless this one has room for a height, mm.
    pub(super) fn keep(&mut self, height_mm: f64) {
        if self.room() < height_mm.min(self.whole_room()) {
            let section = self.pages.last().map(|page| page.section.clone()).unwrap_or_default();
            self.begin(&section);
        }
    }

    /// Leaves a gap, mm.
    pub(super) fn gap(&mut self, height_mm: f64) {
        self.y -= height_mm;
    }

    /// Begins a section on a page of its own.
    pub(super) fn section(&mut self, title: &str) {
        self.begin(title);
        self.bold(title, 16.0, 9.0);
    }

    /// A heading that stays with a height of what follows, mm.
    pub(super) fn heading(&mut self, text: &str, with_mm: f64) {
        self.keep(7.0 + with_mm);
        self.bold(text, 11.0, 6.0);
    }

    fn bold(&mut self, text: &str, size_pt: f64, height_mm: f64) {
        let top = self.take(height_mm);
        let text = shortened(text, size_pt, self.width() / BOLD);
        let at = Point2::new(self.left(), top - size_pt * 0.36);
        self.page().text(at, &text, Type::new(size_pt).bold());
    }

    /// A text in lines.
    pub(super) fn paragraph(&mut self, text: &str) {
        for line in wrapped(text, TEXT_PT, self.width()) {
            let at = Point2::new(self.left(), self.take(LINE_MM) - 3.2);
            self.page().text(at, &line, Type::new(TEXT_PT));
        }
        self.gap(1.5);
    }

    /// A table, whose titles stand on every page that it reaches.
    pub(super) fn table(&mut self, columns: &[Column], rows: &[Vec<String>]) {
        if rows.is_empty() {
            return;
        }
        let broken = |row: &Vec<String>| -> Vec<Vec<String>> {
            let cell =
                |(column, text): (&Column, &String)| wrapped(text, TEXT_PT, self.cell_mm(column));
            columns.iter().zip(row).map(cell).collect()
        };
        let rows: Vec<Vec<Vec<String>>> = rows.iter().map(broken).collect();
        let height = |row: &Vec<Vec<String>>| {
            LINE_MM * row.iter().map(Vec::len).max().unwrap_or(1) as f64 + 0.8
        };
        self.keep(LINE_MM + 1.0 + rows.iter().take(2).map(height).sum::<f64>());
        self.titles(columns);
        for row in rows {
            if self.room() < height(&row) {
                self.keep(self.whole_room());
                self.titles(columns);
            }
            let top = self.take(height(&row));
            self.cells(columns, top, &row, Type::new(TEXT_PT));
            self.rule(top - height(&row));
        }
        self.gap(3.0);
    }

    fn titles(&mut self, columns: &[Column]) {
        let has_titles = columns.iter().any(|column| !column.title.is_empty());
        if !has_titles {
            return self.rule(self.y);
        }
        let top = self.take(LINE_MM + 1.0);
        let titles: Vec<Vec<String>> =
            columns.iter().map(|column| vec![column.title.to_owned()]).collect();
        self.cells(columns, top, &titles, Type::new(TEXT_PT - 1.0).bold());
        self.rule(top - LINE_MM - 1.0);
    }

    fn cell_mm(&self, column: &Column) -> f64 {
        column.share * self.width() - COLUMN_GAP_MM
    }

    fn cells(&mut self, columns: &[Column], top: f64, row: &[Vec<String>], set: Type) {
        let mut left = self.left();
        for (column, lines) in columns.iter().zip(row) {
            let right = left + column.share * self.width();
            let (x, anchor) = if column.is_number {
                (right - COLUMN_GAP_MM, Anchor::End)
            } else {
                (left, Anchor::Start)
            };
            for (n, line) in lines.iter().enumerate() {
                let at = Point2::new(x, top - 3.4 - LINE_MM * n as f64);
                self.page().text(at, line, set.at(anchor));
            }
            left = right;
        }
    }

    /// A line across the page.
    pub(super) fn rule(&mut self, y: f64) {
        let (from, to) = (self.left(), self.left() + self.width());
        self.page().line(Point2::new(from, y), Point2::new(to, y), Pen::RULE);
    }

    /// The pages, each with the name of the design, its section and its number.
    pub(super) fn finish(self, title: &str) -> Vec<PdfPage> {
        let (size, count) = (self.size, self.pages.len());
        let numbered =
            self.pages.into_iter().enumerate().map(|(n, FlowPage { mut page, section })| {
                let right = size.x - MARGIN_MM;
                let foot = Point2::new(right, MARGIN_MM - 3.0);
                page.text(foot, &format!("{} of {count}", n + 1), Type::new(8.0).at(Anchor::End));
                if n > 0 {
                    let y = size.y - 14.0;
                    let room = right - MARGIN_MM - text_mm(&section, 8.0) - 6.0;
                    let name = shortened(title, 8.0, room);
                    page.text(Point2::new(MARGIN_MM, y), &name, Type::new(8.0));
                    page.text(Point2::new(right, y), &section, Type::new(8.0).at(Anchor::End));
                    let rule = [MARGIN_MM, right].map(|x| Point2::new(x, y - 2.0));
                    page.line(rule[0], rule[1], Pen::RULE);
                }
                page
            });
        numbered.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_room_goes_on_the_next_page() {
        let mut flow = Flow::new(Paper::A4);
        flow.section("Parts");
        let (room, whole) = (flow.room(), flow.whole_room());
        assert!(room < whole);
        let top = flow.take(room);
        assert_eq!((flow.pages.len(), top - flow.y), (1, room));
        flow.take(1.0);
        assert_eq!((flow.pages.len(), flow.room()), (2, whole - 1.0));
        // What is higher than a page does not leave empty pages.
        flow.take(2.0 * whole);
        assert_eq!(flow.pages.len(), 3);
    }

    #[test]
    fn a_long_table_has_its_titles_on_every_page() {
        let mut flow = Flow::new(Paper::Letter);
        flow.section("Parts");
        let rows: Vec<Vec<String>> = (0..120).map(|n| vec![format!("row {n}")]).collect();
        flow.table(&[words("Name", 1.0)], &rows);
        assert_eq!(flow.pages.len(), 3);
        for page in flow.finish("design") {
            let (_, content) = page.finish();
            let content = String::from_utf8_lossy(&content).into_owned();
            assert!(content.contains("(Name)"), "{content}");
        }
    }
}
