//! Finds the stations and the lines of a table, whichever way round it is.
//!
//! A table comes in blocks: rows beside one another, below a title or an empty row. A block has
//! its stations across, with a line in each row, or down, with a line in each column; the words
//! tell which, and a block of the second kind is looked at as its mirror image, so that all that
//! follows knows the first kind alone. A block without a row of stations has those of the block
//! before it, as where half-breadths stand below heights under one head.

use super::grid::Grid;
use super::label::{
    LineKind, LineLabel, Quantity, is_line, is_position_word, is_spacing_word, is_station_word,
    label_below, length_in_words, line_label, quantity_of, station_name, unit_in,
};
use super::notation::{Cell, cell, shows_decimal_comma};
use crate::names::shown;
use crate::units::Units;
use std::collections::BTreeMap;

/// The most columns of labels before the first station.
const MOST_LABELS: usize = 3;

/// A cell with its place.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// What it holds.
    pub(super) cell: Cell,
    /// The text that was typed.
    pub(super) typed: String,
    /// Its place, for messages.
    pub(super) place: String,
    /// The unit that the label of its row names.
    pub(super) unit: Option<Units>,
}

/// A station.
#[derive(Clone, Debug)]
pub(super) struct Station {
    /// Its name, without the word for stations.
    pub(super) name: String,
    /// Its name as it was typed, and where.
    pub(super) head: Placed,
    /// Its place along the boat, if a row gives it.
    pub(super) at: Option<Placed>,
}

/// A row of lengths of one line.
#[derive(Clone, Debug)]
pub(super) struct LineRow {
    /// What its label says.
    pub(super) label: LineLabel,
    /// What its cells give, if the table says it.
    pub(super) quantity: Option<Quantity>,
    /// The place of its label.
    pub(super) place: String,
    /// Its cells, each with the number of its station.
    pub(super) cells: Vec<(usize, Placed)>,
}

/// What a table holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    /// The stations, in the order in which the table first names them.
    pub(super) stations: Vec<Station>,
    /// The rows of lines.
    pub(super) rows: Vec<LineRow>,
    /// The unit that the table names.
    pub(super) unit: Option<Units>,
    /// Whether it says that it is in feet and inches, so that a number alone is neither.
    pub(super) is_in_feet: bool,
    /// The distance of two stations, of two waterlines and of two buttocks, where it is given.
    pub(super) spacing: [Option<Placed>; 3],
    /// Lengths that stand under no station: their texts and places.
    pub(super) astray: Vec<Placed>,
    /// What is to be noted of rows of lengths that are not used.
    pub(super) unused: Vec<String>,
    /// The numbers of the stations by their names in small letters.
    numbers: BTreeMap<String, usize>,
}

/// A block of a grid, looked at with its stations across.
struct View<'a> {
    grid: &'a Grid,
    first: usize,
    count: usize,
    is_turned: bool,
    decimal_comma: bool,
}

impl View<'_> {
    fn rows(&self) -> usize {
        if self.is_turned { self.grid.columns() } else { self.count }
    }

    fn columns(&self) -> usize {
        if self.is_turned { self.count } else { self.grid.columns() }
    }

    /// The row and column in the grid.
    fn at(&self, row: usize, column: usize) -> (usize, usize) {
        if self.is_turned { (self.first + column, row) } else { (self.first + row, column) }
    }

    fn text(&self, row: usize, column: usize) -> &str {
        let (row, column) = self.at(row, column);
        self.grid.cell(row, column)
    }

    fn cell(&self, row: usize, column: usize) -> Cell {
        cell(self.text(row, column), self.decimal_comma)
    }

    fn place(&self, row: usize, column: usize) -> String {
        let (row, column) = self.at(row, column);
        self.grid.place(row, column)
    }

    fn placed(&self, row: usize, column: usize, unit: Option<Units>) -> Placed {
        Placed {
            cell: self.cell(row, column),
            typed: self.text(row, column).to_owned(),
            place: self.place(row, column),
            unit,
        }
    }
}

/// Finds the stations and lines of some grids, such as the sheets of a workbook, each with the
/// quantity that its name says.
pub(super) fn layout(grids: &[(Option<Quantity>, Grid)]) -> Layout {
    let mut layout = Layout::default();
    for (quantity, grid) in grids {
        let texts = || grid.rows.iter().flatten();
        let decimal_comma = texts().any(|text| shows_decimal_comma(text));
        let mut quantity = *quantity;
        let mut columns = Columns::default();
        let head = head_row(grid);
        let title = |grid: &Grid, row: usize| title(grid, row, head);
        let mut row = 0;
        while row < grid.rows.len() {
            if let Some(title) = title(grid, row) {
                layout.read_title(&title, grid, row, &mut quantity);
                row += 1;
                continue;
            }
            if grid.rows[row].iter().all(String::is_empty) {
                row += 1;
                continue;
            }
            let ends =
                |n: &usize| title(grid, *n).is_some() || grid.rows[*n].iter().all(String::is_empty);
            let end = (row..grid.rows.len()).find(ends).unwrap_or(grid.rows.len());
            let view = View { grid, first: row, count: end - row, is_turned: false, decimal_comma };
            let is_turned = is_turned(&view);
            let view = View { is_turned, ..view };
            layout.read_block(&view, quantity, &mut columns);
            row = end;
        }
    }
    layout
}

/// The first row that heads the stations: a word for stations or for their places, without a
/// number, stands at its left. 0 if there is none.
fn head_row(grid: &Grid) -> usize {
    let is_word = |text: &String| {
        (is_station_word(text) || is_position_word(text))
            && !text.contains(|c: char| c.is_ascii_digit())
    };
    let is_head = |row: &Vec<String>| {
        row.iter().filter(|text| !text.is_empty()).count() > 2
            && row.iter().take(MOST_LABELS).any(is_word)
    };
    grid.rows.iter().position(is_head).unwrap_or(0)
}

/// The text of a row that is a title, a remark or a setting: it begins with `#`, has a single text,
/// a text and a value beside it, or, above the row `head`, is a sentence that its commas divide.
fn title(grid: &Grid, row: usize, head: usize) -> Option<String> {
    let cells: Vec<&str> =
        grid.rows[row].iter().map(String::as_str).filter(|text| !text.is_empty()).collect();
    let is_setting = |name: &str| {
        let lower = name.to_lowercase();
        is_spacing_word(name) || lower.starts_with("unit")
    };
    match cells[..] {
        [first, ..] if first.starts_with('#') => Some(cells.join(" ")),
        [only] if cell(only, false) == Cell::Text => Some(only.to_owned()),
        [name, value] if is_setting(name) => Some(format!("{name} {value}")),
        [first, ..] if row < head && grid.cell(row, 0) == first => {
            is_sentence(&cells, &grid.rows[head]).then(|| cells.join(", "))
        }
        _ => None,
    }
}

/// Whether the cells of a row above the head of a table are a sentence: texts mostly, and fewer
/// than the head has cells. A row of lengths or of names of stations is none.
fn is_sentence(cells: &[&str], head: &[String]) -> bool {
    let filled = head.iter().filter(|text| !text.is_empty()).count();
    let is_text = |text: &&&str| cell(text, false) == Cell::Text;
    let texts = cells.iter().filter(is_text).count();
    let [first, ..] = cells else { return false };
    let heads_values = quantity_of(first).is_some() || is_spacing_word(first);
    let has_station = cells.iter().any(|text| is_station_word(text));
    let is_prose = is_text(&first) && texts + 1 >= cells.len() && !heads_values && !has_station;
    cells.len() < filled && is_prose
}

/// Whether a block has its stations down and its lines across.
fn is_turned(view: &View<'_>) -> bool {
    let (rows, columns) = (view.rows(), view.columns());
    let is_station = |text: &str| is_station_word(text) && !station_name(text).is_empty();
    let count = |cells: &mut dyn Iterator<Item = (usize, usize)>, is: &dyn Fn(&str) -> bool| {
        cells.filter(|&(row, column)| is(view.text(row, column))).count()
    };
    let in_row = |row: usize, is: &dyn Fn(&str) -> bool| {
        count(&mut (1..columns).map(|column| (row, column)), is)
    };
    let in_column = |column: usize, is: &dyn Fn(&str) -> bool| {
        count(&mut (0..rows).map(|row| (row, column)), is)
    };
    let heads = rows.min(MOST_LABELS);
    let lines_across = (0..heads).map(|row| in_row(row, &is_line)).max().unwrap_or(0);
    let lines_down =
        (0..columns.min(MOST_LABELS)).map(|column| in_column(column, &is_line)).max().unwrap_or(0);
    let stations_across = (0..heads).map(|row| in_row(row, &is_station)).max().unwrap_or(0);
    let stations_down = in_column(0, &is_station);
    let (down, across) = (stations_down + lines_across, stations_across + lines_down);
    if down != across {
        return down > across;
    }
    // Names that no word list has: those of lines are texts, those of stations mostly numbers.
    let is_text = |text: &str| cell(text, false) == Cell::Text;
    let texts_across = in_row(0, &is_text) + 1;
    2 * texts_across > columns && 2 * in_column(0, &is_text) <= rows.max(2)
}

/// The stations of the columns of the block before.
#[derive(Default)]
struct Columns {
    /// The number of the station of each column.
    stations: Vec<Option<usize>>,
    is_turned: bool,
}

/// The rows of a block below one head; mostly the block has one.
#[derive(Default)]
struct Part {
    /// The row of the names of its stations.
    head: Option<usize>,
    /// The row of their places, and its unit.
    positions: Option<(usize, Option<Units>)>,
    /// The rows of lines, with what a section before them gives.
    lines: Vec<(usize, Option<Quantity>)>,
}

/// What a row of a block is.
enum RowKind {
    Head,
    Positions,
    Spacing,
    Line,
    Nothing,
}

impl Layout {
    fn read_title(&mut self, text: &str, grid: &Grid, row: usize, quantity: &mut Option<Quantity>) {
        if is_spacing_word(text) {
            self.set_spacing(text, grid.place(row, 0), length_in_words(text));
            return;
        }
        match unit_in(text) {
            Some(Ok(unit)) => self.unit = self.unit.or(Some(unit)),
            Some(Err(())) => self.is_in_feet = true,
            None => {}
        }
        if !text.starts_with('#') {
            *quantity = quantity_of(text).or(*quantity);
        }
    }

    fn set_spacing(&mut self, text: &str, place: String, length: Option<Cell>) {
        let lower = text.to_lowercase();
        let of = if lower.contains("water") || lower.contains("wl") || lower.contains("w.l") {
            1
        } else if lower.contains("buttock") {
            2
        } else {
            0
        };
        let Some(cell) = length else { return };
        let unit = unit_in(text).and_then(Result::ok);
        let placed = Placed { cell, typed: text.to_owned(), place, unit };
        self.spacing[of].get_or_insert(placed);
    }

    fn read_block(
        &mut self,
        view: &View<'_>,
        mut quantity: Option<Quantity>,
        before: &mut Columns,
    ) {
        let labels = label_columns(view);
        let mut part = Part::default();
        let of_before = before.is_turned == view.is_turned && !before.stations.is_empty();
        for row in 0..view.rows() {
            let texts: Vec<&str> = (0..labels).map(|column| view.text(row, column)).collect();
            let text = texts.join(" ").trim().to_owned();
            let section = texts.iter().find_map(|text| quantity_of(text).filter(|q| !is_along(*q)));
            quantity = section.or(quantity);
            let unit = unit_in(&text);
            let kind = kind_of(view, row, labels, part.head.is_some() || of_before);
            let is_again = matches!(kind, RowKind::Head) && part.head.is_some() && unit.is_none();
            if is_again && !part.lines.is_empty() {
                self.read_part(view, labels, &part, before);
                part = Part::default();
            }
            match kind {
                RowKind::Head if part.head.is_none() => {
                    part.head = Some(row);
                    let has_place = texts.iter().any(|text| is_position_word(text));
                    if has_place || unit.is_some() {
                        part.positions = Some((row, unit.and_then(Result::ok)));
                    }
                }
                // Other names of the stations, such as those of frames.
                RowKind::Head if is_again => {}
                RowKind::Head | RowKind::Positions => {
                    part.positions.get_or_insert((row, unit.and_then(Result::ok)));
                }
                RowKind::Spacing => {
                    let cells = (labels..view.columns()).map(|column| view.cell(row, column));
                    let length = cells
                        .into_iter()
                        .find(|cell| matches!(cell, Cell::Length { .. } | Cell::Bare { .. }));
                    self.set_spacing(&text, view.place(row, 0), length);
                }
                RowKind::Line => part.lines.push((row, quantity)),
                RowKind::Nothing => self.note_unused(view, row, labels),
            }
        }
        self.read_part(view, labels, &part, before);
    }

    /// Notes a row of lengths that is not used.
    fn note_unused(&mut self, view: &View<'_>, row: usize, labels: usize) {
        let is_length = |column: &usize| {
            matches!(view.cell(row, *column), Cell::Length { .. } | Cell::Bare { .. })
        };
        let Some(first) = (labels..view.columns()).find(is_length) else { return };
        let texts = (0..labels).map(|column| view.text(row, column));
        let named = texts.filter(|text| !text.is_empty()).collect::<Vec<&str>>().join(" ");
        let what = match &named[..] {
            "" => "lengths without the name of a line".to_owned(),
            named => format!("{}, which is no line of a hull", shown(named)),
        };
        self.unused.push(format!("left out from {} on: {what}", view.place(row, first)));
    }

    fn read_part(&mut self, view: &View<'_>, labels: usize, part: &Part, before: &mut Columns) {
        if let Some(row) = part.head.or(part.positions.map(|(row, _)| row)) {
            before.stations = self.stations_of(view, row, labels);
            before.is_turned = view.is_turned;
        }
        if let Some((row, unit)) = part.positions {
            for (column, station) in before.stations.iter().enumerate() {
                let placed = view.placed(row, column, unit);
                if let Some(station) = station.filter(|_| placed.cell != Cell::None) {
                    self.stations[station].at.get_or_insert(placed);
                }
            }
        }
        for (row, quantity) in &part.lines {
            self.read_line(view, *row, labels, *quantity, &before.stations);
        }
    }

    /// The stations that a row names, by columns; new ones are added.
    fn stations_of(&mut self, view: &View<'_>, row: usize, labels: usize) -> Vec<Option<usize>> {
        let station = |column: usize| {
            let head = view.placed(row, column, None);
            if column < labels || head.typed.is_empty() {
                return None;
            }
            let name = station_name(&head.typed);
            let next = self.stations.len();
            let number = *self.numbers.entry(name.to_lowercase()).or_insert(next);
            if number == next {
                self.stations.push(Station { name, head, at: None });
            }
            Some(number)
        };
        (0..view.columns()).map(station).collect()
    }

    fn read_line(
        &mut self,
        view: &View<'_>,
        row: usize,
        labels: usize,
        quantity: Option<Quantity>,
        stations: &[Option<usize>],
    ) {
        let texts = (0..labels).map(|column| (column, view.text(row, column)));
        let named = texts.filter(|(_, text)| !text.is_empty());
        let Some((column, text)) = named.clone().find(|(_, text)| quantity_of(text).is_none())
        else {
            self.note_unused(view, row, labels);
            return;
        };
        let label = label_below(text, quantity);
        let of_kind = match label.kind {
            LineKind::Waterline => Some(Quantity::HalfBreadth),
            LineKind::Buttock => Some(Quantity::Height),
            LineKind::Edge | LineKind::Middle | LineKind::Diagonal => None,
        };
        let unit = unit_in(text).and_then(Result::ok);
        let mut cells = Vec::new();
        for column in labels..view.columns() {
            let placed = view.placed(row, column, unit);
            match (stations.get(column).copied().flatten(), &placed.cell) {
                (Some(station), _) => cells.push((station, placed)),
                (None, Cell::None | Cell::Text) => {}
                (None, _) => self.astray.push(placed),
            }
        }
        let quantity = label.quantity.or(of_kind).or(quantity);
        self.rows.push(LineRow { label, quantity, place: view.place(row, column), cells });
    }
}

/// How many columns at the left of a block hold labels: the first, and those after it that hold
/// texts mostly.
fn label_columns(view: &View<'_>) -> usize {
    let is_label = |column: usize| {
        let cells = (0..view.rows()).map(|row| view.cell(row, column));
        let filled: Vec<Cell> = cells.filter(|cell| *cell != Cell::None).collect();
        let texts = filled.iter().filter(|cell| **cell == Cell::Text).count();
        2 * texts > filled.len()
    };
    let more = (1..view.columns().min(MOST_LABELS)).take_while(|&column| is_label(column)).count();
    1 + more
}

fn kind_of(view: &View<'_>, row: usize, labels: usize, has_stations: bool) -> RowKind {
    let texts: Vec<&str> = (0..labels).map(|column| view.text(row, column)).collect();
    let has_values = (labels..view.columns()).any(|column| !view.text(row, column).is_empty());
    let any = |is: &dyn Fn(&str) -> bool| texts.iter().any(|text| is(text));
    let all_empty = texts.iter().all(|text| text.is_empty());
    let is_known = any(&|text| is_line(text) && !is_position_word(&line_label(text).name));
    if !has_values {
        return RowKind::Nothing;
    }
    if any(&is_spacing_word) {
        return RowKind::Spacing;
    }
    if is_known {
        return RowKind::Line;
    }
    if any(&|text| is_position_word(text) && quantity_of(text).is_none_or(is_along)) {
        let is_head = any(&is_station_word) && !has_stations;
        return if is_head { RowKind::Head } else { RowKind::Positions };
    }
    if any(&is_station_word) || all_empty && !has_stations {
        return RowKind::Head;
    }
    if any(&|text| text.to_lowercase().contains("angle")) || all_empty {
        return RowKind::Nothing;
    }
    if has_stations { RowKind::Line } else { RowKind::Head }
}

fn is_along(quantity: Quantity) -> bool {
    quantity == Quantity::Along
}
