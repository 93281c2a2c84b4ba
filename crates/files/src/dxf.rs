//! Patterns as DXF of release 12, and back.
//!
//! Every shop reads release 12: polylines on layers, without handles, dates or styles. It is small
//! enough for this module to write and read it: the crate for all of DXF adds dates to the header
//! and 50 crates to the program, and panics on a date out of range. The tests read the written
//! files with that crate.

use crate::preset::{LAYERS, Layer, layers};
use crate::read_back::{Lines, MAX_BYTES, PatternReadError, ReadPattern, pattern};
use crate::shapes::{digits, extent, shapes};
use sheetwright::math::Point2;
use sheetwright::pattern::Piece;
use std::fmt::{Display, Write as _};

/// The DXF file of a piece. `docs/outputs.md` specifies it for readers.
pub fn write_dxf(piece: &Piece) -> Vec<u8> {
    let shapes = shapes(piece);
    let around = extent(&shapes);
    let mut pairs = Pairs(String::new());
    pairs.put(
        999,
        format_args!("Flat pattern of {}, by Sheetwright. Units: mm.", ascii(&piece.name)),
    );
    pairs.section("HEADER", |pairs| {
        pairs.put(9, "$ACADVER");
        pairs.put(1, "AC1009");
        for (name, corner) in [("$EXTMIN", around.min), ("$EXTMAX", around.max)] {
            pairs.put(9, name);
            pairs.place(corner);
        }
    });
    let layers: Vec<&Layer> = layers(&shapes).collect();
    pairs.section("TABLES", |pairs| tables(pairs, &layers));
    pairs.section("BLOCKS", |_| {});
    pairs.section("ENTITIES", |pairs| {
        for layer in &layers {
            for shape in layer.shapes(&shapes) {
                for line in &shape.lines {
                    pairs.polyline(layer.name, line, shape.closed);
                }
            }
        }
    });
    pairs.put(0, "EOF");
    pairs.0.into_bytes()
}

fn tables(pairs: &mut Pairs, layers: &[&Layer]) {
    pairs.table("LTYPE", 1, |pairs| {
        pairs.put(0, "LTYPE");
        pairs.put(2, "CONTINUOUS");
        pairs.put(70, 0);
        pairs.put(3, "Solid line");
        pairs.put(72, 65);
        pairs.put(73, 0);
        pairs.put(40, "0.0");
    });
    pairs.table("LAYER", 1 + layers.len(), |pairs| {
        let layer_0 = ("0", 7);
        let layers = layers.iter().map(|layer| (layer.name, layer.number));
        for (name, colour) in std::iter::once(layer_0).chain(layers) {
            pairs.put(0, "LAYER");
            // FreeCAD 0.20 reads no name of a layer that stands before the flags.
            pairs.put(70, 0);
            pairs.put(2, name);
            pairs.put(62, colour);
            pairs.put(6, "CONTINUOUS");
        }
    });
}

/// The text of a DXF file so far: pairs of a group code and a value, each on a line of its own.
struct Pairs(String);

impl Pairs {
    fn put(&mut self, code: u16, value: impl Display) {
        // Writing to a string does not fail.
        let _ = write!(self.0, "{code:>3}\r\n{value}\r\n");
    }

    fn section(&mut self, name: &str, fill: impl FnOnce(&mut Self)) {
        self.put(0, "SECTION");
        self.put(2, name);
        fill(self);
        self.put(0, "ENDSEC");
    }

    fn table(&mut self, name: &str, entries: usize, fill: impl FnOnce(&mut Self)) {
        self.put(0, "TABLE");
        self.put(2, name);
        self.put(70, entries);
        fill(self);
        self.put(0, "ENDTAB");
    }

    fn place(&mut self, at: Point2) {
        self.put(10, real(at.x));
        self.put(20, real(at.y));
        self.put(30, "0.0");
    }

    fn polyline(&mut self, layer: &str, points: &[Point2], closed: bool) {
        self.put(0, "POLYLINE");
        self.put(8, layer);
        self.put(66, 1);
        self.place(Point2::default());
        self.put(70, u8::from(closed));
        for &point in points {
            self.put(0, "VERTEX");
            self.put(8, layer);
            self.place(point);
        }
        self.put(0, "SEQEND");
        self.put(8, layer);
    }
}

/// A coordinate with all its digits and a decimal point, which DXF requires.
fn real(x: f64) -> String {
    let mut digits = digits(x);
    if !digits.contains('.') {
        digits.push_str(".0");
    }
    digits
}

/// A text in ASCII, as release 12 requires; other characters become their code points, in the
/// notation of AutoCAD.
fn ascii(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_ascii_graphic() || character == ' ' {
            out.push(character);
        } else {
            let _ = write!(out, "\\U+{:04X}", u32::from(character));
        }
    }
    out
}

/// Reads back the outline, the holes and the rungs of a pattern that [`write_dxf`] wrote: the
/// closed polylines on `net`, or on `cut` where there is no net, and the segments on the other
/// layers between their corners.
///
/// # Errors
/// See [`PatternReadError`]. Another release than 12 and other entities than polylines are refused.
pub fn read_dxf(bytes: &[u8]) -> Result<ReadPattern, PatternReadError> {
    pattern(dxf_lines(bytes)?)
}

/// The lines of a pattern that [`write_dxf`] wrote, not yet told apart into outline, holes and
/// rungs.
pub(crate) fn dxf_lines(bytes: &[u8]) -> Result<Lines, PatternReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(PatternReadError::TooLarge);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| PatternReadError::NotText)?;
    let polylines = polylines(&mut Reader { lines: text.lines(), line: 0 })?;
    let mut found = Lines::default();
    for Polyline { layer, points, closed } in polylines {
        match LAYERS.iter().find(|known| known.name == layer) {
            Some(layer) => found.add(layer, points, closed),
            None => return Err(PatternReadError::Unexpected(format!("layer '{layer}'"))),
        }
    }
    Ok(found)
}

struct Reader<'a> {
    lines: std::str::Lines<'a>,
    /// The number of the line read last, from 1.
    line: usize,
}

impl<'a> Reader<'a> {
    fn wrong(&self, problem: &'static str) -> PatternReadError {
        PatternReadError::Dxf { line: self.line, problem }
    }

    /// The next group code and its value; comments are passed over.
    fn pair(&mut self) -> Result<(u16, &'a str), PatternReadError> {
        loop {
            let (Some(code), Some(value)) = (self.lines.next(), self.lines.next()) else {
                return Err(self.wrong("the file ends too early"));
            };
            self.line += 2;
            let code: u16 = code.trim().parse().map_err(|_| self.wrong("no group code"))?;
            if code != 999 {
                return Ok((code, value.trim()));
            }
        }
    }

    fn number(&self, value: &str) -> Result<f64, PatternReadError> {
        value.parse().map_err(|_| self.wrong("no number"))
    }
}

struct Polyline<'a> {
    layer: &'a str,
    points: Vec<Point2>,
    closed: bool,
}

/// The polylines of the entities, up to the end of the file.
fn polylines<'a>(reader: &mut Reader<'a>) -> Result<Vec<Polyline<'a>>, PatternReadError> {
    let mut done: Vec<Polyline<'a>> = Vec::new();
    let mut entity = "";
    let mut section = "";
    let mut variable = "";
    let mut release = "";
    loop {
        let (code, value) = reader.pair()?;
        if code == 0 {
            if value == "EOF" {
                break;
            }
            let in_polyline = matches!(entity, "POLYLINE" | "VERTEX");
            let expected = match value {
                "SECTION" => section.is_empty(),
                "ENDSEC" => !in_polyline,
                _ if section != "ENTITIES" => true,
                "POLYLINE" => !in_polyline,
                "VERTEX" | "SEQEND" => in_polyline,
                _ => {
                    return Err(PatternReadError::Unexpected(format!("entity '{value}'")));
                }
            };
            if !expected {
                return Err(reader.wrong("this stands in the wrong place"));
            }
            if section == "ENTITIES" {
                match (value, done.last_mut()) {
                    ("POLYLINE", _) => {
                        done.push(Polyline { layer: "", points: Vec::new(), closed: false });
                    }
                    ("VERTEX", Some(polyline)) => polyline.points.push(Point2::default()),
                    _ => {}
                }
            }
            if value == "ENDSEC" {
                section = "";
            }
            entity = value;
            continue;
        }
        match (entity, code) {
            ("SECTION", 2) if section.is_empty() => section = value,
            (_, 9) if section == "HEADER" => variable = value,
            (_, 1) if section == "HEADER" && variable == "$ACADVER" => release = value,
            _ => {}
        }
        let Some(polyline) = done.last_mut().filter(|_| section == "ENTITIES") else { continue };
        match (entity, code) {
            ("POLYLINE", 8) => polyline.layer = value,
            ("POLYLINE", 70) => {
                let flags: u16 = value.parse().map_err(|_| reader.wrong("no number"))?;
                polyline.closed = flags & 1 == 1;
            }
            ("VERTEX", 10 | 20) => {
                let coordinate = reader.number(value)?;
                if let Some(point) = polyline.points.last_mut() {
                    *(if code == 10 { &mut point.x } else { &mut point.y }) = coordinate;
                }
            }
            ("VERTEX", 42) => return Err(PatternReadError::Unexpected("bulge".to_owned())),
            _ => {}
        }
    }
    if release != "AC1009" {
        return Err(PatternReadError::Missing("$ACADVER AC1009"));
    }
    if !matches!(entity, "ENDSEC") {
        return Err(reader.wrong("a section does not end"));
    }
    Ok(done)
}
