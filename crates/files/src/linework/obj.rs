//! Lines (`l`) of Wavefront OBJ as curves, named after their groups. A file with faces is a mesh;
//! its lines are counted alone.

use super::drawn::{Drawing, Drawn, MAX_NAME};
use super::segment::Segment;
use super::too_large;
use crate::mesh::scan::{coordinates, lines, quoted, words};
use crate::mesh::units_said;
use crate::reading::{InputError, display_name, without_utf16};
use crate::units::Units;
use sheetwright::design::Unused;
use sheetwright::math::Point3;
use std::rc::Rc;

/// The most points of a file.
const MAX_POINTS: usize = 3_000_000;

/// Whether an OBJ file has lines and no face.
pub(crate) fn is_lines(bytes: &[u8]) -> bool {
    let [faces, lines] = counted(bytes);
    faces == 0 && lines > 0
}

/// The number of lines of a file that has faces.
pub(super) fn lines_beside(bytes: &[u8]) -> usize {
    let [faces, lines] = counted(bytes);
    if faces > 0 { lines } else { 0 }
}

fn counted(bytes: &[u8]) -> [usize; 2] {
    let bytes = without_utf16(bytes);
    let mut found = [0; 2];
    for (_, line) in lines(&bytes) {
        match words(line).next() {
            Some(b"f") => found[0] += 1,
            Some(b"l") => found[1] += 1,
            _ => {}
        }
    }
    found
}

/// Reads the lines. With `units`, or where a comment names one, the coordinates are in that unit.
pub(super) fn read(bytes: &[u8], name: &str, units: Option<Units>) -> Result<Drawing, InputError> {
    let place = display_name(name);
    let unit_mm = units.or_else(|| units_said(bytes)).unwrap_or_default().in_mm();
    let bytes = without_utf16(bytes);
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let mut points: Vec<Point3> = Vec::new();
    let mut drawing = Drawing::default();
    let mut layers: Rc<Vec<String>> = Rc::default();
    let mut object = String::new();
    for (number, line) in lines(bytes) {
        let at = || format!("{place}:{number}");
        let mut words = words(line);
        match words.next() {
            Some(b"v") => {
                let [x, y, z] = coordinates(words, at)?.map(|c| c * unit_mm);
                let point = Point3::new(x, y, z);
                if !point.is_finite() || points.len() == MAX_POINTS {
                    let message = match point.is_finite() {
                        true => format!("the file has more than {MAX_POINTS} points"),
                        false => "a coordinate is no finite number".to_owned(),
                    };
                    return Err(InputError::at(at(), message, "Export it again."));
                }
                points.push(point);
            }
            Some(b"l") => {
                let ends: Result<Vec<Point3>, InputError> = words
                    .take_while(|word| !word.starts_with(b"#"))
                    .map(|word| corner(word, &points).ok_or_else(|| no_point(word, &at())))
                    .collect();
                let segments: Vec<Segment> =
                    ends?.windows(2).map(|pair| Segment::line(pair[0], pair[1])).collect();
                let closed =
                    segments.len() > 2 && segments[0].start() == segments[segments.len() - 1].end();
                let curve = Drawn { names: Vec::new(), layers: layers.clone(), segments, closed };
                if !drawing.add(curve) {
                    return Err(too_large(place));
                }
            }
            Some(keyword @ (b"o" | b"g")) => {
                let name = words.map(String::from_utf8_lossy).collect::<Vec<_>>().join(" ");
                let name: String = name.chars().take(MAX_NAME).collect();
                let group = if keyword == b"g" { name.clone() } else { String::new() };
                if keyword == b"o" {
                    object = name;
                }
                let named = [group, object.clone()];
                let is_name = |name: &String| !["", "default", "off"].contains(&name.as_str());
                layers = Rc::new(named.into_iter().filter(is_name).collect());
            }
            Some(b"p") => drawing.unused.add(Unused::Point, "", None),
            Some(keyword @ (b"curv" | b"curv2" | b"surf")) => {
                drawing.unused.add(Unused::Other, &String::from_utf8_lossy(keyword), None);
            }
            _ => {}
        }
    }
    Ok(drawing)
}

/// A point in the notation `7`, `7/1`, or `-1`, which counts back from the last.
fn corner(word: &[u8], points: &[Point3]) -> Option<Point3> {
    let number = word.split(|&byte| byte == b'/').next()?;
    let number: i64 = std::str::from_utf8(number).ok()?.parse().ok()?;
    let index = match number {
        1.. => usize::try_from(number - 1).ok()?,
        0 => return None,
        _ => points.len().checked_sub(usize::try_from(number.unsigned_abs()).ok()?)?,
    };
    points.get(index).copied()
}

fn no_point(word: &[u8], place: &str) -> InputError {
    let message = format!("{} names no point above this line", quoted(word));
    InputError::at(place, message, "Points are counted from 1; export it again.")
}
