//! Curve tables (`*.csv`): one row a point, one or more curves. The grammar is in docs/files.md.

use crate::names::{did_you_mean, refused_for_curve, shown};
use crate::reading::{InputError, display_name};
use crate::units::Units;
use sheetwright::boundary::MAX_SAMPLES;
use sheetwright::curve::MAX_COORDINATE_MM;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::DesignCurve;
use sheetwright::math::Point3;
use std::collections::BTreeMap;

/// The most rows of a table, which is the most samples of a boundary.
pub const MAX_ROWS: usize = MAX_SAMPLES;
/// The most curves of a table or of a design.
pub const MAX_CURVES: usize = 10_000;
/// The name of the only curve of a table without the column `curve`.
const UNNAMED: &str = "outline";
/// The columns, required ones first.
const COLUMNS: [&str; 6] = ["x", "y", "z", "curve", "corner", "move"];
/// The column that groups curves to panels, in tables of many panels.
const PANEL: &str = "panel";
const HEADER_HINT: &str = "The first line names the columns, as in: curve,x,y,z";
const NUMBER_HINT: &str = "Write numbers as in 12.5 or 1e-3, with a decimal point and no unit.";
const COMMA_HINT: &str =
    "Write decimals with a point (12.5), or separate the columns by semicolons.";

/// A curve of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableCurve {
    /// Its name.
    pub name: String,
    /// Its points, in the order of the rows, including a last one that repeats the first.
    pub points: Vec<CurvePoint>,
}

impl TableCurve {
    /// Its points for the kernel. Of a closed curve, a last point that repeats the first is
    /// dropped.
    pub fn curve_points(&self, closed: bool) -> Vec<CurvePoint> {
        let mut points = self.points.clone();
        if let (true, [first, .., last]) = (closed, points.as_mut_slice())
            && first.at == last.at
        {
            // The two are one point, which is a corner if either is.
            first.corner |= last.corner;
            first.move_mm = first.move_mm.min(last.move_mm);
            points.pop();
        }
        points
    }
}

/// What stands behind the name of a line in that of its mirror image.
const STARBOARD: &str = "-starboard";

/// The points of the curve of this name. Where the table has none and the name is `NAME-starboard`,
/// those of the curve `NAME` in the mirror of the plane y = 0, so that a hull's other half follows
/// the table, too.
pub(crate) fn points_named(
    curves: &[TableCurve],
    name: &str,
    closed: bool,
) -> Option<Vec<CurvePoint>> {
    let find = |name: &str| curves.iter().find(|curve| curve.name == name);
    if let Some(curve) = find(name) {
        return Some(curve.curve_points(closed));
    }
    let mut points = find(name.strip_suffix(STARBOARD)?)?.curve_points(closed);
    // Not -y, which would make -0 of a point in the plane.
    points.iter_mut().for_each(|point| point.at.y = 0.0 - point.at.y);
    Some(points)
}

/// The curves of a table, in the order in which they begin. `name` is the file's, for messages.
///
/// # Errors
/// A header without x, y and z, a row with another number of cells, or an invalid value; each with
/// its line.
pub fn read_table(text: &str, name: &str, units: Units) -> Result<Vec<TableCurve>, InputError> {
    let place = display_name(name);
    let separator = separator_of(text);
    let mut rows = reader(text, separator);
    let mut row = csv::StringRecord::new();
    if !rows.read_record(&mut row).map_err(|error| unreadable(place, &error))? {
        return Err(InputError::at(place, "the table has no header", HEADER_HINT));
    }
    let columns = Columns::of_header(&row, separator, &format!("{place}:{}", line_of(&row, text)))?;
    if columns.panel.is_some() {
        let hint = "Leave the column out: the first curve is the outline, others are holes.";
        let message = "the column 'panel' is for tables of many panels";
        return Err(InputError::at(place, message, hint));
    }
    let curves = columns.curves(&mut rows, text, (place, 0), units)?;
    if curves.is_empty() {
        return Err(no_rows(place));
    }
    Ok(curves)
}

/// The refusal of a table without rows.
pub(crate) fn no_rows(place: &str) -> InputError {
    let hint = "Add one row for each point, in the order of the curve.";
    InputError::at(place, "the table has no rows below its header", hint)
}

fn reader(text: &str, separator: u8) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes())
}

// Reading can't fail here: the reader reads memory, and the text is valid UTF-8.
fn unreadable(place: &str, error: &csv::Error) -> InputError {
    InputError::at(place, error.to_string(), HEADER_HINT)
}

/// Whether the header of a text shows that it is a curve table, if perhaps one with mistakes: two
/// columns or more have names that only those have.
pub(crate) fn is_curve_table(text: &str) -> bool {
    let separator = char::from(separator_of(text));
    let header = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    let names = header.split(separator).map(|name| name.trim_matches([' ', '"']).to_lowercase());
    names.filter(|name| COLUMNS.contains(&name.as_str())).count() >= 2
}

/// The separator of the columns: a comma, or, if the header has none, its semicolon or tabulator,
/// which spreadsheets write where the comma separates decimals.
fn separator_of(text: &str) -> u8 {
    let header = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    let has = |separator: &u8| header.as_bytes().contains(separator);
    [b',', b';', b'\t'].into_iter().find(has).unwrap_or(b',')
}

/// The line number of a row. The reader gives the end of the row before, which lies before the LF
/// of a CRLF and before empty lines.
pub(crate) fn line_of(row: &csv::StringRecord, text: &str) -> u64 {
    let Some(position) = row.position() else { return 0 };
    let start = usize::try_from(position.byte()).unwrap_or(usize::MAX);
    let rest = text.as_bytes().get(start..).unwrap_or_default();
    let ends = rest.iter().take_while(|b| b"\r\n".contains(b)).filter(|&&b| b == b'\n');
    position.line() + ends.count() as u64
}

/// The refusal of a panel with more rows than it may have, on the line of the first beyond.
pub(crate) fn too_many_rows(place: &str) -> InputError {
    let message = format!("the table has more than {MAX_ROWS} rows");
    let hint = "Remove rows, or divide the table; a few hundred points are enough for a curve.";
    InputError::at(place, message, hint)
}

/// The curves so far.
#[derive(Default)]
struct Curves {
    list: Vec<TableCurve>,
    by_name: BTreeMap<String, usize>,
    /// The curve of the row before; most rows belong to it.
    last: usize,
}

impl Curves {
    fn push(&mut self, name: &str, point: CurvePoint, place: &str) -> Result<(), InputError> {
        if self.list.get(self.last).is_none_or(|curve| curve.name != name) {
            self.last = match self.by_name.get(name) {
                Some(&known) => known,
                None => self.begin(name, place)?,
            };
        }
        self.list[self.last].points.push(point);
        Ok(())
    }

    fn begin(&mut self, name: &str, place: &str) -> Result<usize, InputError> {
        if let Some(why) = refused_for_curve(name) {
            let message = format!("the curve's name {} {why}", shown(name));
            let hint = "Give every row the name of its curve, or leave the column `curve` out.";
            return Err(InputError::at(place, message, hint));
        }
        if self.list.len() == MAX_CURVES {
            let message = format!("the table has more than {MAX_CURVES} curves");
            let hint = "Give all rows of a curve one name, or divide the table.";
            return Err(InputError::at(place, message, hint));
        }
        self.by_name.insert(name.to_owned(), self.list.len());
        self.list.push(TableCurve { name: name.to_owned(), points: Vec::new() });
        Ok(self.list.len() - 1)
    }
}

/// The positions of the columns, from the header.
#[derive(Debug)]
pub(crate) struct Columns {
    separator: u8,
    count: usize,
    xyz: [usize; 3],
    curve: Option<usize>,
    panel: Option<usize>,
    corner: Option<usize>,
    movable: Option<usize>,
    /// Whether numbers may have a comma for the decimal point, as it separates no columns.
    decimal_comma: bool,
}

impl Columns {
    /// The columns that a line names.
    pub(crate) fn of_line(line: &str, place: &str) -> Result<Self, InputError> {
        let separator = separator_of(line);
        let mut header = csv::StringRecord::new();
        let read = reader(line, separator).read_record(&mut header);
        read.map_err(|error| unreadable(place, &error))?;
        Self::of_header(&header, separator, place)
    }

    fn of_header(
        header: &csv::StringRecord,
        separator: u8,
        place: &str,
    ) -> Result<Self, InputError> {
        let names: Vec<String> = header.iter().map(str::to_ascii_lowercase).collect();
        if names.iter().all(|name| name.parse::<f64>().is_ok()) {
            return Err(InputError::at(place, "the table has no header", HEADER_HINT));
        }
        for (n, name) in names.iter().enumerate() {
            if !COLUMNS.contains(&name.as_str()) && name != PANEL {
                let message = format!("the column {} is not known", shown(name));
                return Err(InputError::at(place, message, did_you_mean(name, &COLUMNS)));
            }
            if names[..n].contains(name) {
                let message = format!("the header names the column '{name}' twice");
                return Err(InputError::at(place, message, "Keep one of them."));
            }
        }
        let find = |wanted: &str| names.iter().position(|name| name == wanted);
        let required = |wanted: &str| {
            find(wanted).ok_or_else(|| {
                let message = format!("the table has no column '{wanted}'");
                InputError::at(place, message, "The columns x, y and z are required.")
            })
        };
        Ok(Self {
            separator,
            count: names.len(),
            xyz: [required("x")?, required("y")?, required("z")?],
            curve: find("curve"),
            panel: find(PANEL),
            corner: find("corner"),
            movable: find("move"),
            decimal_comma: separator != b',',
        })
    }

    /// Whether the column `panel` names the panel of each row.
    pub(crate) fn has_panels(&self) -> bool {
        self.panel.is_some()
    }

    /// Whether a column names the panel or the curve of each row.
    pub(crate) fn names_panels(&self) -> bool {
        self.panel.or(self.curve).is_some()
    }

    /// The panel that a row belongs to by its name: that of the column `panel`, else of `curve`.
    pub(crate) fn panel_of(&self, line: &str) -> String {
        let Some(column) = self.panel.or(self.curve) else { return String::new() };
        if !line.contains('"') {
            let cell = line.split(char::from(self.separator)).nth(column).unwrap_or("");
            return unguarded(cell.trim()).to_owned();
        }
        let mut row = csv::StringRecord::new();
        let is_read = reader(line, self.separator).read_record(&mut row).unwrap_or(false);
        let cell = row.get(column).filter(|_| is_read).unwrap_or("");
        unguarded(cell).to_owned()
    }

    /// The curves of some rows below the header, which begin on the line after `lines_above`.
    pub(crate) fn curves_of(
        &self,
        text: &str,
        place: &str,
        lines_above: u64,
        units: Units,
    ) -> Result<Vec<TableCurve>, InputError> {
        self.curves(&mut reader(text, self.separator), text, (place, lines_above), units)
    }

    fn curves(
        &self,
        rows: &mut csv::Reader<&[u8]>,
        text: &str,
        (place, lines_above): (&str, u64),
        units: Units,
    ) -> Result<Vec<TableCurve>, InputError> {
        let mut row = csv::StringRecord::new();
        let mut curves = Curves::default();
        let mut count = 0;
        while rows.read_record(&mut row).map_err(|error| unreadable(place, &error))? {
            count += 1;
            let place = format!("{place}:{}", lines_above + line_of(&row, text));
            if count > MAX_ROWS {
                return Err(too_many_rows(&place));
            }
            let (curve, point) = self.read(&row, &place, units)?;
            curves.push(curve, point, &place)?;
        }
        Ok(curves.list)
    }

    /// The curve's name and the point of a row.
    fn read<'a>(
        &self,
        row: &'a csv::StringRecord,
        place: &str,
        units: Units,
    ) -> Result<(&'a str, CurvePoint), InputError> {
        let failed = |message: String, hint: &str| InputError::at(place, message, hint);
        if row.len() != self.count {
            let message = format!("the row has {} values for {} columns", row.len(), self.count);
            let hint = if row.len() > self.count {
                COMMA_HINT
            } else {
                "Give a value for every column; those of `corner` and `move` may be empty."
            };
            return Err(failed(message, hint));
        }
        let value = |column: usize| row.get(column).unwrap_or("");
        let mut xyz = [0.0; 3];
        for (n, &column) in self.xyz.iter().enumerate() {
            xyz[n] = self
                .length_mm(COLUMNS[n], value(column), units)
                .map_err(|(message, hint)| failed(message, hint))?;
        }
        let corner = match self.corner.map_or("", value) {
            "" | "0" => false,
            "1" => true,
            other => {
                let message = format!("the value of `corner` is {}", shown(other));
                return Err(failed(message, "Write 1 at a corner, and 0 or nothing elsewhere."));
            }
        };
        let move_mm = match self.movable.map_or("", value) {
            "" => 0.0,
            text => {
                let length = self.length_mm("move", text, units);
                length.map_err(|(message, hint)| failed(message, hint))?
            }
        };
        if move_mm < 0.0 {
            let message = format!("the value of `move` is {move_mm} mm");
            return Err(failed(
                message,
                "Write a distance above 0; write 0 or nothing to fix the point.",
            ));
        }
        let at = Point3::new(xyz[0], xyz[1], xyz[2]);
        let name = self.curve.map_or(UNNAMED, |column| unguarded(value(column)));
        Ok((name, CurvePoint { at, corner, move_mm }))
    }
}

impl Columns {
    /// The length in a cell, mm. The error is a message and a hint.
    fn length_mm(
        &self,
        column: &str,
        text: &str,
        units: Units,
    ) -> Result<f64, (String, &'static str)> {
        if self.decimal_comma {
            return length_mm(column, &text.replacen(',', ".", 1), units);
        }
        length_mm(column, text, units)
    }
}

/// The length in a cell, mm. The error is a message and a hint.
fn length_mm(column: &str, text: &str, units: Units) -> Result<f64, (String, &'static str)> {
    if text.is_empty() {
        return Err((format!("{column} is empty"), NUMBER_HINT));
    }
    let Ok(number) = text.parse::<f64>() else {
        let with_point = text.replacen(',', ".", 1);
        let hint = if with_point.parse::<f64>().is_ok() { COMMA_HINT } else { NUMBER_HINT };
        return Err((format!("{column} is {}, which is no number", shown(text)), hint));
    };
    in_range_mm(number, units).ok_or_else(|| {
        let message = format!("{column} is {}, which is out of range", shown(text));
        (message, RANGE_HINT)
    })
}

pub(crate) const RANGE_HINT: &str =
    "Lengths are finite numbers within ±1e9 mm (a thousand kilometres).";

/// A number as a length, mm; `None` unless it is finite and within the range of the kernel.
pub(crate) fn in_range_mm(number: f64, units: Units) -> Option<f64> {
    let mm = number * units.in_mm();
    (mm.abs() <= MAX_COORDINATE_MM).then_some(mm)
}

/// The points of curves as a table in millimetres, which reads back to the same bits.
///
/// A table says neither how its points make a curve nor whether it is closed: the reader does.
/// Every point of a polyline is marked as a corner.
pub fn write_table(curves: &[DesignCurve]) -> Vec<u8> {
    let is_corner =
        |curve: &DesignCurve, p: &CurvePoint| p.corner || curve.kind == Some(CurveKind::Polyline);
    let any = |is_so: &dyn Fn(&DesignCurve, &CurvePoint) -> bool| {
        curves.iter().any(|c| c.points.iter().any(|p| is_so(c, p)))
    };
    let (corners, moves) = (any(&is_corner), any(&|_, p| p.move_mm > 0.0));
    let mut table = String::from("curve,x,y,z");
    table.push_str(if corners { ",corner" } else { "" });
    table.push_str(if moves { ",move\n" } else { "\n" });
    for curve in curves {
        let name = name_cell(&curve.name);
        for point in &curve.points {
            let [x, y, z] = [point.at.x, point.at.y, point.at.z].map(number);
            table.push_str(&format!("{name},{x},{y},{z}"));
            if corners {
                table.push_str(if is_corner(curve, point) { ",1" } else { ",0" });
            }
            if moves {
                table.push_str(&format!(",{}", number(point.move_mm)));
            }
            table.push('\n');
        }
    }
    table.into_bytes()
}

/// The characters that begin a formula in some spreadsheet, in half and full width.
const FORMULA: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];
/// The mark of a text in spreadsheets, written before a name that begins so.
const AS_TEXT: char = '\'';

/// Whether a spreadsheet could take a name for a formula, or would if it had fewer apostrophes.
fn looks_like_a_formula(name: &str) -> bool {
    name.trim_start_matches(AS_TEXT).starts_with(FORMULA)
}

/// The name of a curve as a table holds it: no spreadsheet that opens the table runs it.
pub(crate) fn guarded(name: &str) -> String {
    if looks_like_a_formula(name) { format!("{AS_TEXT}{name}") } else { name.to_owned() }
}

/// A name as a cell of a table.
pub(crate) fn name_cell(name: &str) -> String {
    quoted(&guarded(name))
}

/// The inverse of [`guarded`].
fn unguarded(cell: &str) -> &str {
    cell.strip_prefix(AS_TEXT).filter(|name| looks_like_a_formula(name)).unwrap_or(cell)
}

/// A cell, in quotation marks where a table needs them.
pub(crate) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The fewest digits that read back to the same number.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-5..1e16).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<TableCurve>, InputError> {
        read_table(text, "t.csv", Units::Millimetres)
    }

    fn refused(text: &str) -> String {
        read(text).unwrap_err().to_string()
    }

    #[test]
    fn columns_stand_in_any_order() {
        let curves =
            read("move,z,curve,x,corner,y\n5,3,a,1,1,2\n,6, b ,4,0,5\n0,9,a,7,,8\n").unwrap();
        let point =
            |x, y, z, corner, move_mm| CurvePoint { at: Point3::new(x, y, z), corner, move_mm };
        assert_eq!(
            curves,
            [
                TableCurve {
                    name: "a".into(),
                    points: vec![point(1.0, 2.0, 3.0, true, 5.0), point(7.0, 8.0, 9.0, false, 0.0)]
                },
                TableCurve { name: "b".into(), points: vec![point(4.0, 5.0, 6.0, false, 0.0)] },
            ]
        );
    }

    #[test]
    fn spreadsheets_of_every_country_are_read() {
        let point = read("x,y,z\n0.5,1e3,-2").unwrap();
        for text in ["x;y;z\n0,5;1e3;-2", "x\ty\tz\n0,5\t1000\t-2", "\n x;y;z \r\n0.5;1000;-2\r\n"]
        {
            assert_eq!(read(text), Ok(point.clone()), "{text}");
        }
    }

    #[test]
    fn errors_name_the_line_of_the_file() {
        assert_eq!(
            refused("x,y,z\r\n1,2,3\r\n1,2\r\n"),
            "t.csv:3: the row has 2 values for 3 columns"
        );
        assert_eq!(refused("x,y,z\n\n\n1,2,a\n"), "t.csv:4: z is 'a', which is no number");
        assert_eq!(refused("x,y,z\n1,\"2,5\",3\n"), "t.csv:2: y is '2,5', which is no number");
        assert_eq!(refused("x,y,z\n1,2,inf\n"), "t.csv:2: z is 'inf', which is out of range");
        assert_eq!(refused("x,y,z,move\n1,2,3,-1\n"), "t.csv:2: the value of `move` is -1 mm");
        assert_eq!(refused("1,2,3\n4,5,6\n"), "t.csv:1: the table has no header");
    }

    #[test]
    fn units_become_millimetres() {
        let curves = read_table("x,y,z,move\n1,2,0.5,1\n", "t.csv", Units::Inches).unwrap();
        let point = curves[0].points[0];
        assert_eq!((point.at, point.move_mm), (Point3::new(25.4, 50.8, 12.7), 25.4));
    }

    #[test]
    fn a_closed_curve_drops_a_last_point_that_repeats_the_first() {
        let curves = read("x,y,z,corner\n0,0,0,0\n1,0,0,0\n1,1,0,0\n0,0,0,1\n").unwrap();
        assert_eq!(curves[0].curve_points(false).len(), 4);
        let closed = curves[0].curve_points(true);
        assert_eq!(closed.len(), 3);
        assert!(closed[0].corner);
    }

    #[test]
    fn no_name_is_a_formula_in_a_written_table_and_all_read_back() {
        let names = ["=1+1", "+", "@SUM(A1)", "'=1", "''+", "＝1", "a=b", "it's", "'", "=1,\"2\""];
        let points = vec![CurvePoint::smooth(Point3::new(0.0, 0.0, 0.0))];
        let curve = |name: &str| DesignCurve {
            name: name.to_owned(),
            kind: None,
            closed: false,
            points: points.clone(),
        };
        let written = write_table(&names.map(curve));
        let text = String::from_utf8(written).unwrap();
        for row in text.lines() {
            let cell = row.trim_start_matches('"');
            assert!(!cell.starts_with(FORMULA), "{row}");
        }
        let back: Vec<String> = read(&text).unwrap().into_iter().map(|c| c.name).collect();
        assert_eq!(back, names);
        // Names that are no formula stay as they are.
        assert!(text.contains("\na=b,") && text.contains("\nit's,") && text.contains("\n',"));
    }

    #[test]
    fn what_is_written_reads_back_to_the_same_bits() {
        let values = [0.1 + 0.2, -0.0, 1.0 / 3.0, 5e-324, 1e-5, 123_456_789.123_456_78, -1e9];
        let points: Vec<CurvePoint> = (0..values.len())
            .map(|i| CurvePoint {
                at: Point3::new(values[i], values[(i + 1) % 7], values[(i + 3) % 7]),
                corner: i == 2,
                move_mm: 0.0,
            })
            .collect();
        let curve = |name: &str| DesignCurve {
            name: name.into(),
            kind: None,
            closed: true,
            points: points.clone(),
        };
        let written = write_table(&[curve("a, \"b\""), curve("c")]);
        let read = read(std::str::from_utf8(&written).unwrap()).unwrap();
        assert_eq!(read.len(), 2);
        assert_eq!(read[0].name, "a, \"b\"");
        for curve in &read {
            for (p, q) in curve.curve_points(true).iter().zip(&points) {
                let bits = |p: Point3| [p.x, p.y, p.z].map(f64::to_bits);
                assert_eq!((bits(p.at), p.corner), (bits(q.at), q.corner));
            }
        }
    }
}
