//! Sheets of a workbook (`.xlsx`, `.ods`) as grids of cells.
//!
//! Both formats are XML in a ZIP archive. Of a cell its value is taken, not how it is shown: a
//! number in the fewest digits that are it, a text as it is, a date as a date, so that the reader
//! can say what the spreadsheet made of `2-3-5`. Cells that are repeated many times are empty or
//! end at the limit of cells.
//!
//! A small archive may unpack to much, and a short text may be that of many cells: nodes, sheets,
//! cells and the length of each text are limited, for all sheets together.

use super::grid::{Grid, MOST_CELLS, cut};
use crate::reading::InputError;
use crate::unzip::{ZipFault, unzipped};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::{BTreeMap, BTreeSet};

/// The most sheets of a workbook, and rows and columns of a sheet, that are looked at.
const MOST_SHEETS: usize = 100;
const MOST_ROWS: usize = 10_000;
const MOST_COLUMNS: usize = 1_000;
/// The number of the last row of a sheet, in every program.
const LAST_ROW: u64 = 1_048_576;
/// The most nodes of an XML file; a table of offsets has some thousands.
const MOST_NODES: u32 = 1_000_000;
const HINT: &str = "Open it in a spreadsheet and save it again as .xlsx, .ods or CSV.";

/// The sheets of a workbook with their names, those that have cells.
///
/// # Errors
/// Bytes that are no workbook, or more cells than a table has.
pub(super) fn sheets(bytes: &[u8], place: &str) -> Result<Vec<(String, Grid)>, InputError> {
    let wanted = |name: &str| {
        let name = name.to_lowercase();
        name == "content.xml" || name.starts_with("xl/") && !name.starts_with("xl/media/")
    };
    let files: BTreeMap<String, String> =
        unzipped(bytes, |name| wanted(name) && (name.ends_with(".xml") || name.ends_with(".rels")))
            .map_err(|fault| fault_in_words(fault, place))?
            .into_iter()
            .map(|(name, bytes)| (name, String::from_utf8_lossy(&bytes).into_owned()))
            .collect();
    let damaged = || InputError::at(place, "this is no workbook that can be read", HINT);
    let read = match (files.get("content.xml"), files.get("xl/workbook.xml")) {
        (Some(content), _) => ods(content, place)?,
        (None, Some(_)) => xlsx(&files, place)?,
        (None, None) => None,
    };
    let mut sheets = read.ok_or_else(damaged)?;
    sheets.retain(|(_, grid)| grid.rows.iter().flatten().any(|cell| !cell.is_empty()));
    if sheets.is_empty() {
        return Err(InputError::at(place, "the workbook is empty", "Give a table of offsets."));
    }
    Ok(sheets)
}

fn fault_in_words(fault: ZipFault, place: &str) -> InputError {
    let (message, hint) = match fault {
        ZipFault::Damaged => ("this is no workbook, or a damaged one", HINT),
        ZipFault::Unknown => ("the workbook is encrypted", "Save it without a password."),
        ZipFault::TooLarge => (
            "the workbook unpacks to more than 32 MiB",
            "Keep the table of offsets alone in it: a few hundred cells.",
        ),
    };
    InputError::at(place, message, hint)
}

type Sheets = Option<Vec<(String, Grid)>>;

/// The sheets of an OpenDocument spreadsheet; `None` if its XML is none.
fn ods(content: &str, place: &str) -> Result<Sheets, InputError> {
    let Some(document) = parsed(content) else { return Ok(None) };
    let mut sheets = Vec::new();
    let mut room = MOST_CELLS;
    for table in named(document.root(), "table").take(MOST_SHEETS) {
        let name = cut(attribute(table, "name").unwrap_or_default());
        let mut grid = Grid::empty(&sheet_place(place, &name), room, true);
        let mut line: u64 = 1;
        for row in table.descendants().filter(|node| node.tag_name().name() == "table-row") {
            let cells = ods_cells(row);
            let count = repeated(row, "number-rows-repeated");
            if cells.iter().any(|cell| !cell.is_empty()) {
                for n in 0..count.min(MOST_ROWS as u64) {
                    grid.push(cells.clone(), line + n)?;
                }
            } else {
                grid.push([], line)?;
            }
            line = (line + count).min(LAST_ROW);
        }
        room = grid.room_left();
        sheets.push((name, grid));
    }
    Ok(Some(sheets))
}

fn ods_cells(row: Node<'_, '_>) -> Vec<String> {
    let mut cells: Vec<String> = Vec::new();
    let is_cell =
        |node: &Node<'_, '_>| matches!(node.tag_name().name(), "table-cell" | "covered-table-cell");
    for cell in row.children().filter(is_cell) {
        let text = match (attribute(cell, "value-type"), attribute(cell, "value")) {
            (Some("float" | "currency"), Some(value)) => shortest(value),
            (Some("date"), _) => cut(attribute(cell, "date-value").unwrap_or("a date")),
            (Some("time"), _) => "1900-01-01".to_owned(),
            _ => {
                let lines = cell.children().filter(|node| node.tag_name().name() == "p");
                cut(lines.map(text_of).collect::<Vec<String>>().join(" ").trim())
            }
        };
        let count = repeated(cell, "number-columns-repeated");
        let most = MOST_COLUMNS.saturating_sub(cells.len());
        cells.extend(std::iter::repeat_n(text, most.min(count as usize)));
    }
    cells
}

/// How often a row or a cell stands in a sheet.
fn repeated(node: Node<'_, '_>, name: &str) -> u64 {
    let count = attribute(node, name).and_then(|count| count.parse::<u64>().ok()).unwrap_or(1);
    count.min(LAST_ROW)
}

fn parsed(text: &str) -> Option<Document<'_>> {
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).ok()
}

/// The sheets of an Office Open XML workbook; `None` if its XML is none.
fn xlsx(files: &BTreeMap<String, String>, place: &str) -> Result<Sheets, InputError> {
    let file = |name: &str| files.get(name).and_then(|text| parsed(text));
    let Some(workbook) = file("xl/workbook.xml") else { return Ok(None) };
    let shared: Vec<String> = file("xl/sharedStrings.xml")
        .map_or(Vec::new(), |strings| named(strings.root(), "si").map(text_of_runs).collect());
    let dates = file("xl/styles.xml").map_or(Vec::new(), |styles| date_styles(&styles));
    let targets: BTreeMap<String, String> =
        file("xl/_rels/workbook.xml.rels").map_or_else(BTreeMap::new, |rels| {
            let target = |rel: Node<'_, '_>| {
                let path = attribute(rel, "Target")?;
                let path = path.strip_prefix('/').map_or(format!("xl/{path}"), str::to_owned);
                Some((attribute(rel, "Id")?.to_owned(), path))
            };
            named(rels.root(), "Relationship").filter_map(target).collect()
        });
    let mut sheets = Vec::new();
    let (mut room, mut seen) = (MOST_CELLS, BTreeSet::new());
    for (n, sheet) in named(workbook.root(), "sheet").enumerate().take(MOST_SHEETS) {
        let name = cut(attribute(sheet, "name").unwrap_or_default());
        let usual = format!("xl/worksheets/sheet{}.xml", n + 1);
        let path = attribute(sheet, "id").and_then(|id| targets.get(id)).unwrap_or(&usual);
        if !seen.insert(path.clone()) {
            continue;
        }
        let Some(document) = file(path) else { continue };
        let mut grid = Grid::empty(&sheet_place(place, &name), room, true);
        for row in named(document.root(), "row").take(MOST_ROWS) {
            let line = attribute(row, "r").and_then(|r| r.parse().ok());
            let line: u64 = line.unwrap_or(grid.last_line() + 1).clamp(1, LAST_ROW);
            // Rows without cells are left out of the file: they divide blocks.
            if grid.last_line() + 1 < line {
                grid.push([], line - 1)?;
            }
            grid.push(xlsx_cells(row, &shared, &dates), line)?;
        }
        room = grid.room_left();
        sheets.push((name, grid));
    }
    Ok(Some(sheets))
}

fn xlsx_cells(row: Node<'_, '_>, shared: &[String], dates: &[bool]) -> Vec<String> {
    let mut cells: Vec<String> = Vec::new();
    for cell in row.children().filter(|node| node.tag_name().name() == "c") {
        let column = attribute(cell, "r").and_then(column_of).unwrap_or(cells.len());
        let value = cell.children().find(|node| node.tag_name().name() == "v").map(text_of);
        let value = value.unwrap_or_default();
        let style = attribute(cell, "s").and_then(|s| s.parse::<usize>().ok()).unwrap_or(0);
        let text = match attribute(cell, "t") {
            Some("s") => value.parse().ok().and_then(|n: usize| shared.get(n)).cloned(),
            Some("inlineStr") => Some(text_of_runs(cell)),
            Some("str" | "e" | "b" | "d") => Some(value),
            _ if dates.get(style) == Some(&true) => value.parse().ok().map(date_of_serial),
            _ => Some(shortest(&value)),
        };
        if column < MOST_COLUMNS {
            cells.resize(cells.len().max(column + 1), String::new());
            cells[column] = cut(text.unwrap_or_default().trim());
        }
    }
    cells
}

/// The column of a reference such as C4.
fn column_of(reference: &str) -> Option<usize> {
    let letters = reference.bytes().take_while(u8::is_ascii_alphabetic).take(4);
    let number =
        letters.fold(0, |n, letter| 26 * n + usize::from(letter.to_ascii_uppercase() - b'A') + 1);
    number.checked_sub(1)
}

/// Whether the cells of each style show dates or times.
fn date_styles(styles: &Document<'_>) -> Vec<bool> {
    let own: BTreeMap<&str, bool> = named(styles.root(), "numFmt")
        .filter_map(|format| {
            let code = attribute(format, "formatCode")?.to_lowercase();
            // Colours in brackets and texts in quotation marks show no date.
            let bare: String = code.split(['"', '[', ']']).step_by(2).collect();
            let is_date = bare.contains(['y', 'd', 'm', 'h']) && !bare.contains("general");
            Some((attribute(format, "numFmtId")?, is_date))
        })
        .collect();
    let is_date = |id: &str| {
        own.get(id).copied().unwrap_or_else(|| {
            id.parse().is_ok_and(|id: u32| matches!(id, 14..=22 | 27..=36 | 45..=47 | 50..=58))
        })
    };
    let cells = styles.descendants().find(|node| node.tag_name().name() == "cellXfs");
    let formats = cells.into_iter().flat_map(|cells| cells.children());
    let formats = formats.filter(|node| node.tag_name().name() == "xf");
    formats.map(|xf| attribute(xf, "numFmtId").is_some_and(is_date)).collect()
}

/// The date of a number of days since the end of 1899, as year-month-day (Howard Hinnant's
/// algorithm for civil dates). Times of day, below 1, are of the first day of 1900.
fn date_of_serial(serial: f64) -> String {
    let days = serial.clamp(2.0, 2_958_465.0) as i64 - 25_569 + 719_468;
    let era = days.div_euclid(146_097);
    let of_era = days.rem_euclid(146_097);
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * of_year + 2) / 153;
    let day = of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    let year = year_of_era + era * 400 + i64::from(month <= 2);
    format!("{year}-{month:02}-{day:02}")
}

/// A number in the fewest digits that are it.
fn shortest(number: &str) -> String {
    number.trim().parse::<f64>().map_or_else(|_| cut(number), |number| number.to_string())
}

fn sheet_place(place: &str, name: &str) -> String {
    format!("{place}: sheet {}", crate::names::shown(name))
}

fn named<'a, 'b: 'a>(node: Node<'a, 'b>, name: &'static str) -> impl Iterator<Item = Node<'a, 'b>> {
    node.descendants().filter(move |node| node.tag_name().name() == name)
}

/// An attribute by its name without its namespace.
fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    node.attributes().find(|attribute| attribute.name() == name).map(|found| found.value())
}

fn text_of(node: Node<'_, '_>) -> String {
    node.descendants().filter(|node| node.is_text()).filter_map(|node| node.text()).collect()
}

/// The text of runs, without the readings that some languages write above them.
fn text_of_runs(node: Node<'_, '_>) -> String {
    let is_run = |node: &Node<'_, '_>| {
        node.tag_name().name() == "t"
            && node.parent().is_none_or(|parent| parent.tag_name().name() != "rPh")
    };
    cut(&node.descendants().filter(is_run).map(text_of).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::archive::zipped;
    use crate::output::OutputFile;

    fn workbook(files: &[(&str, String)]) -> Result<Vec<(String, Grid)>, InputError> {
        let file = |(name, text): &(&str, String)| OutputFile {
            name: (*name).to_owned(),
            bytes: text.clone().into_bytes(),
        };
        let files: Vec<OutputFile> = files.iter().map(file).collect();
        sheets(&zipped(&files).unwrap(), "t")
    }

    fn bytes(sheets: &[(String, Grid)]) -> usize {
        sheets.iter().flat_map(|(_, grid)| grid.rows.iter().flatten()).map(String::len).sum()
    }

    /// A text of a megabyte in each of thousands of cells.
    #[test]
    fn a_short_workbook_does_not_become_a_large_table() {
        let long = "a".repeat(1 << 20);
        let cells = "<c t=\"s\"><v>0</v></c>".repeat(900);
        let sheet = format!("<worksheet>{}</worksheet>", format!("<row>{cells}</row>").repeat(50));
        let of_sheets = |count: usize| {
            vec![
                ("xl/workbook.xml", format!("<w>{}</w>", "<sheet id=\"rId1\"/>".repeat(count))),
                ("xl/sharedStrings.xml", format!("<sst><si><t>{long}</t></si></sst>")),
                ("xl/worksheets/sheet1.xml", sheet.clone()),
                (
                    "xl/_rels/workbook.xml.rels",
                    "<r><Relationship Id=\"rId1\" Target=\"worksheets/sheet1.xml\"/></r>"
                        .to_owned(),
                ),
            ]
        };
        let read = workbook(&of_sheets(10_000)).unwrap();
        assert_eq!((read.len(), bytes(&read)), (1, 45_000 * 1000));

        let text = format!(
            "<d xmlns:t=\"t\"><table><table-row t:number-rows-repeated=\"50\"><table-cell \
             t:number-columns-repeated=\"18446744073709551615\"><p>{long}</p></table-cell>\
             </table-row></table></d>"
        );
        let read = workbook(&[("content.xml", text)]).unwrap();
        assert_eq!(bytes(&read), 50 * MOST_COLUMNS * 1000);
        let nodes = format!("<d>{}</d>", "<a/>".repeat(1_100_000));
        assert!(workbook(&[("content.xml", nodes)]).is_err());
    }

    #[test]
    fn cells_are_counted_over_all_sheets() {
        let row = "<table-row><table-cell><p>a</p></table-cell></table-row>";
        let table = format!("<table>{}</table>", row.repeat(60_000));
        let one = format!("<d>{table}</d>");
        assert!(workbook(&[("content.xml", one)]).is_ok());
        let error = workbook(&[("content.xml", format!("<d>{table}{table}</d>"))]).unwrap_err();
        assert!(error.message.contains("more than 100000 cells"), "{error}");
    }

    #[test]
    fn numbers_of_rows_stay_within_a_sheet() {
        let most = "18446744073709551615";
        let row = format!("<table-row number-rows-repeated=\"{most}\"/>");
        let text = format!(
            "<d><table>{row}{row}<table-row><table-cell><p>a</p></table-cell></table-row></table></d>"
        );
        let read = workbook(&[("content.xml", text)]).unwrap();
        assert_eq!(read[0].1.place(2, 0), "t: sheet '', cell A1048576");
        let sheet = format!(
            "<w><row r=\"{most}\"><c><v>1</v></c><c/></row><row r=\"{most}\"><c><v>2</v></c></row></w>"
        );
        let files = [
            ("xl/workbook.xml", "<w><sheet name=\"a\"/></w>".to_owned()),
            ("xl/worksheets/sheet1.xml", sheet),
        ];
        let read = workbook(&files).unwrap();
        assert_eq!(read[0].1.rows.iter().map(Vec::len).collect::<Vec<usize>>(), [0, 1, 1]);
        assert_eq!(read[0].1.place(1, 0), "t: sheet 'a', cell A1048576");
    }

    #[test]
    fn columns_and_dates_of_cells() {
        assert_eq!(["A1", "C4", "AA10"].map(column_of), [Some(0), Some(2), Some(26)]);
        assert_eq!([38_386.0, 25_569.0].map(date_of_serial), ["2005-02-03", "1970-01-01"]);
        assert_eq!([0.5, -1.0].map(date_of_serial), ["1900-01-01"; 2]);
    }
}
