//! STL, as text or binary. Every triangle has corners of its own; the reader makes corners with
//! equal coordinates, to the last bit, one.

use super::build::Builder;
use super::scan::{Cursor, coordinates, cut_off, lines, quoted, words};
use super::{NO_SURFACE, too_many};
use crate::reading::InputError;
use sheetwright::mesh::MAX_TRIANGLES;

/// The length of the header, bytes, which may have any content; the number of triangles follows.
const HEADER: usize = 80;
/// The length of a triangle, bytes: a normal and three corners of 32-bit floats, and two bytes
/// without a fixed meaning.
const FACET: usize = 50;
const NORMAL: usize = 12;

pub(super) fn read(bytes: &[u8], place: &str, builder: &mut Builder) -> Result<(), InputError> {
    builder.weld();
    match promised(bytes) {
        // Also where the header begins with `solid`, as some programs write it into binary files.
        Some(count) if bytes.len() == HEADER + 4 + FACET * count => binary(bytes, place, builder),
        _ if is_text(bytes) => text(bytes, place, builder),
        Some(_) => binary(bytes, place, builder),
        None if bytes.is_empty() => Err(InputError::at(place, "the input is empty", NO_SURFACE)),
        None => Err(cut_off(place, "the header")),
    }
}

/// The number of triangles that a binary file states.
fn promised(bytes: &[u8]) -> Option<usize> {
    let mut cursor = Cursor::new(bytes, HEADER);
    cursor.array().map(|count| u32::from_le_bytes(count) as usize)
}

/// Whether the input is text: it begins with `solid`, and its first 1024 bytes have no zero byte.
fn is_text(bytes: &[u8]) -> bool {
    const LOOKED_AT: usize = 1024;
    let beginning = &bytes[..bytes.len().min(LOOKED_AT)];
    let begins = words(beginning).next().is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    begins && !beginning.contains(&0)
}

fn binary(bytes: &[u8], place: &str, builder: &mut Builder) -> Result<(), InputError> {
    let count = promised(bytes).unwrap_or(0);
    let there = bytes.len().saturating_sub(HEADER + 4) / FACET;
    if count > there {
        return Err(InputError::at(
            format!("{place}, byte {}", bytes.len()),
            format!("the file ends after {there} of {count} triangles"),
            "The file is incomplete, or is no STL: copy or export it again.",
        ));
    }
    if count > MAX_TRIANGLES {
        return Err(too_many(place));
    }
    let mut cursor = Cursor::new(bytes, HEADER + 4);
    for _ in 0..count {
        let start = cursor.at();
        let at = || format!("{place}, byte {start}");
        cursor.take(NORMAL);
        let first = builder.points();
        for _ in 0..3 {
            let mut coordinate = || Some(f64::from(f32::from_le_bytes(cursor.array()?)));
            let point = [coordinate(), coordinate(), coordinate()];
            let [Some(x), Some(y), Some(z)] = point else {
                return Err(cut_off(&at(), "a triangle"));
            };
            builder.point([x, y, z], at)?;
        }
        cursor.take(2);
        builder.polygon(&[first, first + 1, first + 2], at)?;
    }
    Ok(())
}

/// Reads the names of solids and the corners of each loop, and skips the rest.
fn text(bytes: &[u8], place: &str, builder: &mut Builder) -> Result<(), InputError> {
    let mut of_facet: Vec<usize> = Vec::new();
    // The first line of the facet that has not ended yet.
    let mut open: Option<usize> = None;
    for (number, line) in lines(bytes) {
        let at = || format!("{place}:{number}");
        let mut words = words(line);
        let Some(word) = words.next() else { continue };
        match word.to_ascii_lowercase().as_slice() {
            b"solid" => {
                let name = words.map(String::from_utf8_lossy).collect::<Vec<_>>().join(" ");
                builder.begin(&name, at)?;
            }
            b"facet" => {
                if let Some(open) = open {
                    return Err(unfinished(&format!("{place}:{open}"), of_facet.len()));
                }
                open = Some(number);
            }
            b"vertex" => {
                of_facet.push(builder.points());
                builder.point(coordinates(words, at)?, at)?;
            }
            b"endfacet" => {
                if of_facet.len() != 3 {
                    return Err(unfinished(&at(), of_facet.len()));
                }
                builder.polygon(&of_facet, at)?;
                of_facet.clear();
                open = None;
            }
            b"outer" | b"endloop" | b"endsolid" => {}
            _ => {
                let message = format!("{} is no word of an STL file", quoted(word));
                let hint = "Export it again, as binary STL if the program lets you choose.";
                return Err(InputError::at(at(), message, hint));
            }
        }
    }
    match open {
        Some(open) => Err(cut_off(&format!("{place}:{open}"), "a facet")),
        None => Ok(()),
    }
}

fn unfinished(place: &str, corners: usize) -> InputError {
    let message = match corners {
        1 => "the facet has one corner".to_owned(),
        _ => format!("the facet has {corners} corners"),
    };
    InputError::at(place, message, "A facet of an STL file has three corners: export it again.")
}
