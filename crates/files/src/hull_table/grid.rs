//! The cells of a table, from text or from a sheet of a workbook, with their places for messages.

use crate::reading::InputError;
use crate::table::line_of;

/// The most cells of a table; a table of offsets has a few hundred.
pub(super) const MOST_CELLS: usize = 100_000;

/// Rows of cells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    /// The cells, trimmed; rows may be of different lengths.
    pub(super) rows: Vec<Vec<String>>,
    /// How messages name the file, and the sheet of a workbook.
    source: String,
    /// The line of each row.
    lines: Vec<u64>,
    /// Whether the rows are those of a sheet, whose cells have names such as C4.
    is_sheet: bool,
}

impl Grid {
    /// The cells of a text whose columns are separated by tabulators, semicolons, commas or, with
    /// none of them, by two spaces or more.
    ///
    /// # Errors
    /// More than [`MOST_CELLS`] cells.
    pub(super) fn of_text(text: &str, place: &str) -> Result<Self, InputError> {
        let separator = separator_of(text);
        let mut grid = Self::empty(place, false);
        match separator {
            Some(separator) => {
                let mut reader = csv::ReaderBuilder::new()
                    .delimiter(separator)
                    .has_headers(false)
                    .flexible(true)
                    .trim(csv::Trim::All)
                    .from_reader(text.as_bytes());
                let mut row = csv::StringRecord::new();
                // Reading can't fail here: the reader reads memory, and the text is valid UTF-8.
                while reader.read_record(&mut row).unwrap_or(false) {
                    let line = line_of(&row, text);
                    // Empty lines, which the reader skips, divide blocks.
                    if grid.last_line() + 1 < line {
                        grid.push(Vec::new(), line - 1)?;
                    }
                    grid.push(row.iter().map(str::to_owned).collect(), line)?;
                }
            }
            None => {
                for (line, row) in text.lines().enumerate() {
                    let cells = row.split("  ").map(str::trim).filter(|cell| !cell.is_empty());
                    grid.push(cells.map(str::to_owned).collect(), line as u64 + 1)?;
                }
            }
        }
        Ok(grid)
    }

    /// A grid without rows.
    pub(super) fn empty(source: &str, is_sheet: bool) -> Self {
        Self { rows: Vec::new(), source: source.to_owned(), lines: Vec::new(), is_sheet }
    }

    /// Adds a row, which stands in a line of the file or the sheet.
    ///
    /// # Errors
    /// More than [`MOST_CELLS`] cells.
    pub(super) fn push(&mut self, cells: Vec<String>, line: u64) -> Result<(), InputError> {
        let count: usize = self.rows.iter().map(Vec::len).sum();
        if count + cells.len() > MOST_CELLS {
            let message = format!("the table has more than {MOST_CELLS} cells");
            let hint = "Keep the table of offsets alone: a few hundred cells.";
            return Err(InputError::at(&self.source, message, hint));
        }
        self.rows.push(cells);
        self.lines.push(line);
        Ok(())
    }

    /// The cell of a row and a column; empty beyond the end of the row.
    pub(super) fn cell(&self, row: usize, column: usize) -> &str {
        self.rows.get(row).and_then(|row| row.get(column)).map_or("", String::as_str)
    }

    /// The number of columns of the longest row.
    pub(super) fn columns(&self) -> usize {
        self.rows.iter().map(Vec::len).max().unwrap_or(0)
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

/// The separator that most rows have most of; `None` if there is none at all. Commas that separate
/// the decimals of numbers count for less than any other separator.
fn separator_of(text: &str) -> Option<u8> {
    let rows: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).take(100).collect();
    let with = |separator: u8, count: usize| {
        let has = |row: &&&str| row.bytes().filter(|&b| b == separator).count() >= count;
        2 * rows.iter().filter(has).count() >= rows.len().max(1)
    };
    let by_count =
        |count: usize| [b'\t', b';', b','].into_iter().find(|&separator| with(separator, count));
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
}
