//! The text of a DXF file: pairs of a group code and a value, each on a line of its own.

use crate::shapes::{FileLine, Form, digits};
use sheetwright::math::Point2;
use std::fmt::{Display, Write as _};

/// The text of a DXF file so far.
#[derive(Default)]
pub(crate) struct Pairs(String);

impl Pairs {
    pub(crate) fn put(&mut self, code: u16, value: impl Display) {
        // Writing to a string does not fail.
        let _ = write!(self.0, "{code:>3}\r\n{value}\r\n");
    }

    pub(crate) fn section(&mut self, name: &str, fill: impl FnOnce(&mut Self)) {
        self.put(0, "SECTION");
        self.put(2, name);
        fill(self);
        self.put(0, "ENDSEC");
    }

    pub(crate) fn place(&mut self, at: Point2) {
        self.put(10, real(at.x));
        self.put(20, real(at.y));
        self.put(30, "0.0");
    }

    /// A number of the header.
    pub(crate) fn variable(&mut self, name: &str, code: u16, value: impl Display) {
        self.put(9, name);
        self.put(code, value);
    }

    /// The bulge of the side that begins at a corner, if it is an arc.
    pub(crate) fn bulge(&mut self, line: &FileLine, corner: usize) {
        if let Some(&bulge) = line.bulges.get(corner).filter(|bulge| **bulge != 0.0) {
            self.put(42, real(bulge));
        }
    }

    /// A line of release 12, of this line type or of that of its layer.
    pub(crate) fn line(&mut self, layer: &str, line_type: Option<&str>, line: &FileLine) {
        if let (Form::Circle { radius_mm }, Some(&centre)) = (line.form, line.points.first()) {
            self.put(0, "CIRCLE");
            self.put(8, layer);
            self.place(centre);
            self.put(40, real(radius_mm));
            return;
        }
        self.put(0, "POLYLINE");
        self.put(8, layer);
        if let Some(line_type) = line_type {
            self.put(6, line_type);
        }
        self.put(66, 1);
        self.place(Point2::default());
        self.put(70, u8::from(line.form == Form::Closed));
        for (n, &point) in line.points.iter().enumerate() {
            self.put(0, "VERTEX");
            self.put(8, layer);
            self.place(point);
            self.bulge(line, n);
        }
        self.put(0, "SEQEND");
        self.put(8, layer);
    }

    /// Goes on with another text.
    pub(crate) fn append(&mut self, other: Self) {
        self.0.push_str(&other.0);
    }

    pub(crate) fn into_bytes(mut self) -> Vec<u8> {
        self.put(0, "EOF");
        self.0.into_bytes()
    }
}

/// A coordinate with all its digits and a decimal point, which DXF requires.
pub(crate) fn real(x: f64) -> String {
    let mut digits = digits(x);
    if !digits.contains('.') {
        digits.push_str(".0");
    }
    digits
}

/// A text in ASCII, as release 12 requires; other characters become their code points, in the
/// notation of AutoCAD.
pub(crate) fn ascii(text: &str) -> String {
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
