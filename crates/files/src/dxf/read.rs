//! The lines of the DXF files that this program writes.

use crate::read_back::PatternReadError;
use crate::shapes::{FileLine, Form};
use sheetwright::math::Point2;

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

/// The bulge of an arc that is written is not smaller.
const LEAST_BULGE: f64 = 1e-9;

/// What is being read.
#[derive(Default)]
struct Place<'a> {
    section: &'a str,
    entity: &'a str,
    variable: &'a str,
    release: &'a str,
}

/// The lines of the entities with the names of their layers, in order, up to the end of the file.
pub(super) fn lines(text: &str) -> Result<Vec<(&str, FileLine)>, PatternReadError> {
    let mut reader = Reader { lines: text.lines(), line: 0 };
    let mut done: Vec<(&str, FileLine)> = Vec::new();
    let mut at = Place::default();
    loop {
        let (code, value) = reader.pair()?;
        if code == 0 {
            if value == "EOF" {
                break;
            }
            begun(value, &mut at, &mut done, &reader)?;
            continue;
        }
        match (at.entity, code) {
            ("SECTION", 2) if at.section.is_empty() => at.section = value,
            (_, 9) if at.section == "HEADER" => at.variable = value,
            (_, 1) if at.section == "HEADER" && at.variable == "$ACADVER" => at.release = value,
            _ => {}
        }
        if let Some(line) = done.last_mut().filter(|_| at.section == "ENTITIES") {
            filled(line, at.entity, code, value, &reader)?;
        }
    }
    if !matches!(at.release, "AC1009" | "AC1015") {
        return Err(PatternReadError::Missing("$ACADVER AC1009 or AC1015"));
    }
    if !matches!(at.entity, "ENDSEC") {
        return Err(reader.wrong("a section does not end"));
    }
    Ok(done)
}

/// Begins a section or an entity, or ends one.
fn begun<'a>(
    value: &'a str,
    at: &mut Place<'a>,
    done: &mut Vec<(&'a str, FileLine)>,
    reader: &Reader<'_>,
) -> Result<(), PatternReadError> {
    let in_polyline = matches!(at.entity, "POLYLINE" | "VERTEX");
    let expected = match value {
        "SECTION" => at.section.is_empty(),
        "ENDSEC" => !in_polyline,
        _ if at.section != "ENTITIES" => true,
        "POLYLINE" | "LWPOLYLINE" | "CIRCLE" => !in_polyline,
        "VERTEX" | "SEQEND" => in_polyline,
        _ => return Err(PatternReadError::Unexpected(format!("entity '{value}'"))),
    };
    if !expected {
        return Err(reader.wrong("this stands in the wrong place"));
    }
    if at.section == "ENTITIES" {
        match (value, done.last_mut()) {
            ("POLYLINE" | "LWPOLYLINE", _) => {
                done.push(("", FileLine::polyline(Vec::new(), false)));
            }
            ("CIRCLE", _) => done.push(("", FileLine::circle(Point2::default(), 0.0))),
            ("VERTEX", Some((_, line))) => line.points.push(Point2::default()),
            _ => {}
        }
    }
    if value == "ENDSEC" {
        at.section = "";
    }
    at.entity = value;
    Ok(())
}

/// Takes a value of an entity.
fn filled<'a>(
    (layer, line): &mut (&'a str, FileLine),
    entity: &str,
    code: u16,
    value: &'a str,
    reader: &Reader<'_>,
) -> Result<(), PatternReadError> {
    match (entity, code) {
        ("POLYLINE" | "LWPOLYLINE" | "CIRCLE", 8) => *layer = value,
        ("POLYLINE" | "LWPOLYLINE", 70) => {
            let flags: u16 = value.parse().map_err(|_| reader.wrong("no number"))?;
            line.form = if flags & 1 == 1 { Form::Closed } else { Form::Open };
        }
        ("CIRCLE", 40) => line.form = Form::Circle { radius_mm: reader.number(value)? },
        ("VERTEX" | "LWPOLYLINE" | "CIRCLE", 10 | 20) => {
            let coordinate = reader.number(value)?;
            // The corners of a lightweight polyline begin with their x.
            if entity == "LWPOLYLINE" && code == 10 {
                line.points.push(Point2::default());
            }
            if let Some(point) = line.points.last_mut() {
                *(if code == 10 { &mut point.x } else { &mut point.y }) = coordinate;
            }
        }
        ("VERTEX" | "LWPOLYLINE", 42) => {
            let bulge = reader.number(value)?;
            // Arcs that are written go half round at the most, and none is as good as straight.
            if bulge.abs() > 1.0 || (bulge != 0.0 && bulge.abs() < LEAST_BULGE) {
                return Err(reader.wrong("no bulge of a pattern"));
            }
            line.bulges.resize(line.points.len(), 0.0);
            if let Some(last) = line.bulges.last_mut() {
                *last = bulge;
            }
        }
        _ => {}
    }
    Ok(())
}
