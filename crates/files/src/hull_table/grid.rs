//! The cells of a table, from text or from a sheet of a workbook, with their places for messages.

use crate::reading::InputError;
use crate::table::line_of;

/// The most cells of a table, empty ones between them too; a table of offsets has a few hundred.
pub(super) const MOST_CELLS: usize = 100_000;
/// The most bytes of a cell that are kept.
const MOST_TEXT: usize = 1000;

/// Rows of cells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    /// The cells, trimmed; rows may be of different lengths.
    pub(super) rows: Vec<Vec<String>>,
    /// How messages name the file, and the sheet of a workbook.
    source: String,
    /// The line of each row.
    lines: Vec<u64>,
    /// The number of cells of the longest row.
    widest: usize,
    /// How many cells the rectangle of all rows may have.
    room: usize,
    /// Whether the rows are those of a sheet, whose cells have names such as C4.
    is_sheet: bool,
}

impl Grid {
    /// The cells of a text whose columns are separated by tabulators, semicolons, commas or, with
    /// none of them, by two spaces or more.
    ///
    /// # Errors
    /// A rectangle of more than [`MOST_CELLS`] cells.
    pub(super) fn of_text(text: &str, place: &str) -> Result<Self, InputError> {
        let separator = separator_of(text);
        let mut grid = Self::empty(place, MOST_CELLS, false);
        match separator {
            Some(separator) => {
                let mut reader = csv::ReaderBuilder::new()
                    .delimiter(separator)
                    .has_headers(false)
                    .flexible(true)
                    .trim(csv::Trim::All)
                    .from_reader(text.as_bytes());
                let mut row = csv::StringRecord::new();
                let mut next = 1;
                // Reading can't fail here: the reader reads memory, and the text is valid UTF-8.
                while reader.read_record(&mut row).unwrap_or(false) {
                    let line = line_of(&row, text);
                    // Empty lines, which the reader skips, divide blocks.
                    if next < line {
                        grid.push([], line - 1)?;
                    }
                    grid.push(row.iter().map(cut), line)?;
                    next = line + 1 + feeds_inside(&row, reader.position(), text);
                }
            }
            None => {
                for (line, row) in text.lines().enumerate() {
                    let cells = row.split("  ").map(str::trim).filter(|cell| !cell.is_empty());
                    grid.push(cells.map(cut), line as u64 + 1)?;
                }
            }
        }
        Ok(grid)
    }

    /// A grid without rows, which may have `room` cells.
    pub(super) fn empty(source: &str, room: usize, is_sheet: bool) -> Self {
        let (rows, lines) = (Vec::new(), Vec::new());
        Self { rows, source: source.to_owned(), lines, widest: 0, room, is_sheet }
    }

    /// Adds a row, which stands in a line of the file or the sheet. Empty cells at its end are left
    /// out. All that looks at a table looks at the rectangle around its rows: its size is limited.
    ///
    /// # Errors
    /// A rectangle of more cells than there is room for.
    pub(super) fn push(
        &mut self,
        cells: impl IntoIterator<Item = String>,
        line: u64,
    ) -> Result<(), InputError> {
        let mut cells: Vec<String> = cells.into_iter().take(MOST_CELLS + 1).collect();
        while cells.last().is_some_and(String::is_empty) {
            cells.pop();
        }
        let widest = self.widest.max(cells.len());
        if (self.rows.len() + 1) * widest.max(1) > self.room {
            let message = format!("the table has more than {MOST_CELLS} cells");
            let hint = "Keep the table of offsets alone: a few hundred cells.";
            return Err(InputError::at(&self.source, message, hint));
        }
        self.widest = widest;
        self.rows.push(cells);
        self.lines.push(line);
        Ok(())
    }

    /// How many cells another grid may have beside this one.
    pub(super) fn room_left(&self) -> usize {
        self.room - self.rows.len() * self.widest.max(1)
    }

    /// The cell of a row and a column; empty beyond the end of the row.
    pub(super) fn cell(&self, row: usize, column: usize) -> &str {
        self.rows.get(row).and_then(|row| row.get(column)).map_or("", String::as_str)
    }

    /// The number of columns of the longest row.
    pub(super) fn columns(&self) -> usize {
        self.widest
    }

    /// The line of the last row; 0 if there is none.
    pub(super) fn last_line(&self) -> u64 {
        self.lines.last().copied().unwrap_or(0)
    }

    /// How messages name the file.
    pub(super) fn source(&self) -> &str {
        &self.source
    }

    /// Where a cell is: `hull.csv:4, column C`, or `hull.xlsx: sheet 'Offsets', cell C4`.
    pub(super) fn place(&self, row: usize, column: usize) -> String {
        let line = self.lines.get(row).copied().unwrap_or(0);
        let name = column_name(column);
        if self.is_sheet {
            format!("{}, cell {name}{line}", self.source)
        } else {
            format!("{}:{line}, column {name}", self.source)
        }
    }
}

/// The beginning of a text, as much as a cell keeps: no label or length is as long.
pub(super) fn cut(text: &str) -> String {
    text[..text.floor_char_boundary(MOST_TEXT)].to_owned()
}

/// The name of a column in a spreadsheet: A to Z, AA and so on.
fn column_name(column: usize) -> String {
    let (mut name, mut rest) = (String::new(), column + 1);
    while rest > 0 {
        rest -= 1;
        name.insert(0, char::from(b'A' + (rest % 26) as u8));
        rest /= 26;
    }
    name
}

/// The line feeds inside a row, which may stand in quotation marks.
fn feeds_inside(row: &csv::StringRecord, end: &csv::Position, text: &str) -> u64 {
    let start = row.position().map_or(0, csv::Position::byte);
    let bytes = text.as_bytes().get(start as usize..end.byte() as usize).unwrap_or_default();
    bytes.trim_ascii().iter().filter(|&&b| b == b'\n').count() as u64
}

/// The separator that most rows have most of; `None` if there is none at all. Commas that separate
/// the decimals of numbers count for less than any other separator.
fn separator_of(text: &str) -> Option<u8> {
    // Where spaces stand between columns, commas between digits are those of decimals.
    let is_inner = |(at, _): (usize, &str)| {
        let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        is_digit(text[..at].chars().next_back()) && is_digit(text[at + 1..].chars().next())
    };
    let are_decimal = text.contains("  ") && text.match_indices(',').all(is_inner);
    let rows: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).take(100).collect();
    let with = |separator: u8, count: usize| {
        let has = |row: &&&str| row.bytes().filter(|&b| b == separator).count() >= count;
        2 * rows.iter().filter(has).count() >= rows.len().max(1)
    };
    let candidates = if are_decimal { &b"\t;"[..] } else { b"\t;," };
    let by_count =
        |count: usize| candidates.iter().copied().find(|&separator| with(separator, count));
    // One comma a row may be that of a decimal, between columns of spaces.
    by_count(2).or_else(|| by_count(1).filter(|_| !text.contains("  ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_named_as_in_spreadsheets() {
        let named = [0, 1, 25, 26, 701, 702].map(column_name);
        assert_eq!(named, ["A", "B", "Z", "AA", "ZZ", "AAA"]);
    }

    #[test]
    fn every_separator_gives_the_cells() {
        let cells = [["Station", "0", "1"], ["Sheer", "12,5", "13"]];
        for (text, what) in [
            ("Station;0;1\nSheer;12,5;13\n", "semicolons"),
            ("Station\t0\t1\nSheer\t12,5\t13\n", "tabulators"),
            ("Station,0,1\nSheer,\"12,5\",13\n", "commas"),
            ("Station   0   1\nSheer  12,5   13\n", "spaces"),
        ] {
            let grid = Grid::of_text(text, "t.csv").unwrap();
            assert_eq!(grid.rows, cells, "{what}");
            assert_eq!(grid.place(1, 2), "t.csv:2, column C");
        }
    }

    #[test]
    fn commas_of_decimals_do_not_part_columns_of_spaces() {
        let grid = Grid::of_text("Station   0   1   2\nSheer   12,5   13,2   14,1\n", "t").unwrap();
        let cells = [["Station", "0", "1", "2"], ["Sheer", "12,5", "13,2", "14,1"]];
        assert_eq!(grid.rows, cells);
    }

    #[test]
    fn a_line_feed_in_a_cell_is_no_empty_line() {
        for text in [
            "Station,\"Sheer\nheight\",Chine\n0,1,2\n\n1,3,4\n",
            "Station,\"Sheer\r\nheight\",Chine\r\n0,1,2\r\n\r\n1,3,4\r\n",
        ] {
            let grid = Grid::of_text(text, "t").unwrap();
            assert_eq!(grid.rows.iter().map(Vec::len).collect::<Vec<usize>>(), [3, 3, 0, 3]);
            assert_eq!(grid.lines, [1, 3, 4, 5], "{text:?}");
        }
    }

    /// What is looked at is the rectangle: 33,000 rows and one row of 33,000 cells are 1 MB.
    #[test]
    fn the_rectangle_is_limited_and_texts_are_cut() {
        let long = format!("Station{}\n{}", ",1".repeat(33_000), "Sheer,1\n".repeat(33_000));
        let error = Grid::of_text(&long, "t").unwrap_err();
        assert!(error.message.contains("more than 100000 cells"), "{error}");
        let empty = format!("Station;0;1\n{}", ";;\n".repeat(30_000));
        assert_eq!(Grid::of_text(&empty, "t").unwrap().rows.len(), 30_001);
        let text = format!("{},1\n", "é".repeat(5000));
        assert_eq!(Grid::of_text(&text, "t").unwrap().rows[0][0].len(), MOST_TEXT);
    }
}
