//! PLY, as text or binary of either byte order: the elements `vertex` and `face`; others are passed
//! over.
//!
//! Old programs wrote their names into the header without the word `comment`: before the first
//! element, lines that begin with no word of a header are comments. Others wrote more numbers a row
//! than the header says: in text with a line for each row, the rest of a line is passed over.

use super::build::Builder;
use super::scan::{Cursor, cut_off, number, quoted, words};
use super::{NO_SURFACE, too_many};
use crate::reading::InputError;
use sheetwright::mesh::MAX_TRIANGLES;

/// The most lines of a header; a dozen are usual.
const MAX_HEADER_LINES: usize = 1000;
/// Names of the list of a face's corners.
const CORNERS: [&[u8]; 2] = [b"vertex_indices", b"vertex_index"];
const AGAIN: &str = "Export it again as PLY, or as OBJ or STL.";

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Text,
    Little,
    Big,
}

#[derive(Clone, Copy, PartialEq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

struct Property {
    name: Vec<u8>,
    /// The type of the count if the property is a list; else `None`.
    count: Option<Scalar>,
    scalar: Scalar,
}

struct Element {
    name: Vec<u8>,
    count: usize,
    properties: Vec<Property>,
}

/// A face; one common list holds the corners of all faces.
struct Face {
    /// The line that it ends on, or the byte after it.
    at: usize,
    count: usize,
}

pub(super) fn read(bytes: &[u8], place: &str, builder: &mut Builder) -> Result<(), InputError> {
    let mut values = Values::new(bytes, place);
    let elements = header(&mut values)?;
    values.look_at_rows(elements.iter().map(|element| element.count));
    let has = |name: &[u8]| elements.iter().any(|element| element.name == name);
    if !has(b"vertex") || !has(b"face") {
        let message = if has(b"tristrips") {
            "its triangles are given as strips"
        } else {
            "it has no elements 'vertex' and 'face'"
        };
        let hint = if has(b"tristrips") { AGAIN } else { NO_SURFACE };
        return Err(InputError::at(place, message, hint));
    }
    // Faces may come before the points that they name.
    let mut faces: Vec<Face> = Vec::new();
    let mut corners: Vec<u32> = Vec::new();
    for element in &elements {
        // Refuses a count that the remaining bytes can't hold, before anything is stored.
        let least: usize = match values.encoding {
            Encoding::Text => element.properties.len(),
            _ => element.properties.iter().map(|p| p.count.unwrap_or(p.scalar).size()).sum(),
        };
        if element.count.checked_mul(least).is_none_or(|needed| needed > values.cursor.left()) {
            let message = format!(
                "the file ends before its {} elements {}",
                element.count,
                quoted(&element.name)
            );
            let hint = "The file is incomplete: copy or export it again.";
            return Err(InputError::at(place, message, hint));
        }
        if least == 0 {
            continue;
        }
        let wanted = element.name == b"vertex" || element.name == b"face";
        if wanted && element.count > 3 * MAX_TRIANGLES {
            return Err(too_many(place));
        }
        let axes = [b"x", b"y", b"z"].map(|axis| {
            element.properties.iter().position(|p| p.name == axis && p.count.is_none())
        });
        let list = element
            .properties
            .iter()
            .position(|p| CORNERS.contains(&p.name.as_slice()) && p.count.is_some());
        if element.name == b"vertex" && axes.contains(&None) {
            return Err(InputError::at(place, "its points have no x, y and z", AGAIN));
        }
        if element.name == b"face" && list.is_none() {
            let message = "its faces have no list 'vertex_indices'";
            return Err(InputError::at(place, message, AGAIN));
        }
        for _ in 0..element.count {
            values.next_row();
            let mut point = [0.0; 3];
            let first = corners.len();
            for (n, property) in element.properties.iter().enumerate() {
                let Some(count) = property.count else {
                    let value = values.number(property.scalar)?;
                    if let Some(axis) = axes.iter().position(|axis| *axis == Some(n)) {
                        point[axis] = value;
                    }
                    continue;
                };
                let count = values.whole(count)?;
                for _ in 0..count {
                    if Some(n) == list && element.name == b"face" {
                        corners.push(values.whole(property.scalar)?);
                    } else {
                        values.number(property.scalar)?;
                    }
                }
            }
            let at = values.number_of_row();
            if element.name == b"vertex" {
                builder.point(point, || values.row(at))?;
            } else if element.name == b"face" {
                faces.push(Face { at, count: corners.len() - first });
            }
            values.end_row();
        }
    }
    let mut corners = corners.into_iter();
    for Face { at, count } in faces {
        let at = || values.row(at);
        let ring: Vec<usize> = corners.by_ref().take(count).map(|n| n as usize).collect();
        let points = builder.points();
        if let Some(beyond) = ring.iter().find(|&&corner| corner >= points) {
            let message =
                format!("the face names point {beyond}; there are {points}, counted from 0");
            return Err(InputError::at(at(), message, AGAIN));
        }
        if ring.len() < 3 {
            let message = format!("the face has {} corners", ring.len());
            return Err(InputError::at(at(), message, "A face has three corners or more."));
        }
        builder.polygon(&ring, at)?;
    }
    Ok(())
}

/// Reads up to the line `end_header`.
fn header(values: &mut Values<'_>) -> Result<Vec<Element>, InputError> {
    let mut elements: Vec<Element> = Vec::new();
    let mut encoding = None;
    let first = values.next_line().unwrap_or_default();
    if first.trim_ascii() != b"ply" {
        let message = "a PLY file begins with the line 'ply', and this one does not";
        return Err(InputError::at(format!("{}:1", values.place), message, AGAIN));
    }
    for _ in 0..MAX_HEADER_LINES {
        let Some(line) = values.next_line() else {
            return Err(cut_off(values.place, "the header"));
        };
        let at = format!("{}:{}", values.place, values.line);
        let unknown = || {
            let message = format!("{} is no line of a PLY header", quoted(line.trim_ascii()));
            InputError::at(at.clone(), message, AGAIN)
        };
        let list: Vec<&[u8]> = words(line).collect();
        match list[..] {
            [] | [b"comment" | b"obj_info", ..] => {}
            [b"format", name, ..] => {
                encoding = Some(match name {
                    b"ascii" => Encoding::Text,
                    b"binary_little_endian" => Encoding::Little,
                    b"binary_big_endian" => Encoding::Big,
                    _ => return Err(unknown()),
                });
            }
            [b"element", name, count] => {
                let count = std::str::from_utf8(count).ok().and_then(|count| count.parse().ok());
                elements.push(Element {
                    name: name.to_vec(),
                    count: count.ok_or_else(unknown)?,
                    properties: Vec::new(),
                });
            }
            [b"property", ref rest @ ..] => {
                let (count, scalar, name) = match rest {
                    [b"list", count, scalar, name] => (Some(*count), *scalar, *name),
                    [scalar, name] => (None, *scalar, *name),
                    _ => return Err(unknown()),
                };
                let scalar_of = |name| Scalar::named(name).ok_or_else(unknown);
                let property = Property {
                    name: name.to_vec(),
                    count: count.map(scalar_of).transpose()?,
                    scalar: scalar_of(scalar)?,
                };
                elements.last_mut().ok_or_else(unknown)?.properties.push(property);
            }
            [b"end_header"] => {
                let missing = || InputError::at(at.clone(), "the header names no format", AGAIN);
                values.encoding = encoding.ok_or_else(missing)?;
                return Ok(elements);
            }
            // A comment, as old programs write them.
            _ if elements.is_empty() && !is_word_of_headers(list[0]) => {}
            _ => return Err(unknown()),
        }
    }
    let message = format!("the header has more than {MAX_HEADER_LINES} lines");
    Err(InputError::at(values.place, message, AGAIN))
}

fn is_word_of_headers(word: &[u8]) -> bool {
    [&b"format"[..], b"element", b"property", b"end_header"].contains(&word)
}

/// The values of the body, one after the other.
struct Values<'a> {
    cursor: Cursor<'a>,
    encoding: Encoding,
    place: &'a str,
    /// The line, from 1, in text.
    line: usize,
    /// Whether each row is a line of its own, in text.
    rows_are_lines: bool,
}

impl<'a> Values<'a> {
    fn new(bytes: &'a [u8], place: &'a str) -> Self {
        let cursor = Cursor::new(bytes, 0);
        Self { cursor, encoding: Encoding::Text, place, line: 0, rows_are_lines: false }
    }

    /// Looks whether each of so many rows has a line of its own. In some files rows stand behind
    /// one another on a line.
    fn look_at_rows(&mut self, counts: impl Iterator<Item = usize>) {
        if self.encoding == Encoding::Text {
            let rows = counts.fold(0, usize::saturating_add);
            let lines = self.cursor.rest().split(|&byte| byte == b'\n');
            let lines = lines.filter(|line| !line.trim_ascii().is_empty()).count();
            self.rows_are_lines = lines >= rows;
        }
    }

    /// Passes over what is left of a row's line.
    fn end_row(&mut self) {
        if self.rows_are_lines {
            let rest = self.cursor.rest();
            let left = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
            self.cursor.take(left);
        }
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        let rest = self.cursor.rest();
        let length = rest.iter().position(|&byte| byte == b'\n').map_or(rest.len(), |n| n + 1);
        self.line += 1;
        (length > 0).then(|| self.cursor.take(length)).flatten()
    }

    /// In text, moves on to the line of the next row, for messages alone.
    fn next_row(&mut self) {
        if self.encoding == Encoding::Text {
            self.skip_blanks();
        }
    }

    fn skip_blanks(&mut self) {
        let rest = self.cursor.rest();
        let blanks = rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        self.line += rest[..blanks].iter().filter(|&&byte| byte == b'\n').count();
        self.cursor.take(blanks);
    }

    /// The current position, for messages.
    fn at(&self) -> String {
        self.row(self.number_of_row())
    }

    /// The current line in text, else the current byte.
    fn number_of_row(&self) -> usize {
        match self.encoding {
            // `line` counts finished lines, so the current one is the next.
            Encoding::Text => self.line + 1,
            _ => self.cursor.at(),
        }
    }

    /// The position that [`Self::number_of_row`] tells.
    fn row(&self, number: usize) -> String {
        match self.encoding {
            Encoding::Text => format!("{}:{number}", self.place),
            _ => format!("{}, byte {number}", self.place),
        }
    }

    fn number(&mut self, scalar: Scalar) -> Result<f64, InputError> {
        if self.encoding == Encoding::Text {
            self.skip_blanks();
            let rest = self.cursor.rest();
            let length = rest.iter().take_while(|byte| !byte.is_ascii_whitespace()).count();
            let word = self.cursor.take(length).unwrap_or_default();
            if word.is_empty() {
                return Err(cut_off(&self.at(), "its elements"));
            }
            return number(word).ok_or_else(|| {
                InputError::at(self.at(), format!("{} is no number", quoted(word)), AGAIN)
            });
        }
        let little = self.encoding == Encoding::Little;
        let value = match scalar {
            Scalar::I8 => self.cursor.array().map(|b| f64::from(i8::from_le_bytes(b))),
            Scalar::U8 => self.cursor.array().map(|b| f64::from(u8::from_le_bytes(b))),
            Scalar::I16 => self.ordered(little).map(|b| f64::from(i16::from_le_bytes(b))),
            Scalar::U16 => self.ordered(little).map(|b| f64::from(u16::from_le_bytes(b))),
            Scalar::I32 => self.ordered(little).map(|b| f64::from(i32::from_le_bytes(b))),
            Scalar::U32 => self.ordered(little).map(|b| f64::from(u32::from_le_bytes(b))),
            Scalar::F32 => self.ordered(little).map(|b| f64::from(f32::from_le_bytes(b))),
            Scalar::F64 => self.ordered(little).map(f64::from_le_bytes),
        };
        value.ok_or_else(|| cut_off(&self.at(), "its elements"))
    }

    /// The next bytes, the least significant first.
    fn ordered<const N: usize>(&mut self, little: bool) -> Option<[u8; N]> {
        let mut bytes: [u8; N] = self.cursor.array()?;
        if !little {
            bytes.reverse();
        }
        Some(bytes)
    }

    /// A whole number: a count of corners, or the index of a point.
    fn whole(&mut self, scalar: Scalar) -> Result<u32, InputError> {
        let value = self.number(scalar)?;
        if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
            return Ok(value as u32);
        }
        let message = format!("{value} is no count");
        Err(InputError::at(self.at(), message, AGAIN))
    }
}
