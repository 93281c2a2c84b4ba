//! Wavefront OBJ: `v` and `f`, in groups by `o` and `g`, and lines `l`, which are seams where they
//! run along sides of faces. Everything else is passed over; a name is kept once a face follows.

use super::build::Builder;
use super::scan::{coordinates, lines, quoted, words};
use crate::reading::InputError;
use std::borrow::Cow;

/// Reads the groups. A face may name later points, so faces are resolved last, and lines checked.
pub(super) fn read(bytes: &[u8], place: &str, builder: &mut Builder) -> Result<(), InputError> {
    // The byte order mark that some editors write.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut faces: Vec<Face> = Vec::new();
    // Lines that name later points: the number of each, and the last of its points.
    let mut ahead: Vec<(usize, usize)> = Vec::new();
    let mut corners: Vec<usize> = Vec::new();
    let mut names: Vec<String> = vec![String::new()];
    let mut next_name: Option<String> = None;
    let mut object = String::new();
    let mut points = 0;
    for (number, text) in whole_lines(bytes) {
        let at = || format!("{place}:{number}");
        let mut words = words(&text);
        match words.next() {
            Some(b"v") => {
                builder.point(coordinates(words, at)?, at)?;
                points += 1;
            }
            Some(b"f") => {
                let first = corners.len();
                for word in words.take_while(|word| !word.starts_with(b"#")) {
                    corners.push(corner(word, points).ok_or_else(|| no_corner(word, &at()))?);
                }
                let count = corners.len() - first;
                if count < 3 {
                    let message = match count {
                        1 => "the face has one corner".to_owned(),
                        _ => format!("the face has {count} corners"),
                    };
                    return Err(InputError::at(at(), message, "A face has three corners or more."));
                }
                names.extend(next_name.take());
                faces.push(Face { line: number, group: names.len() - 1, count });
            }
            Some(b"l") => {
                let words = words.take_while(|word| !word.starts_with(b"#"));
                let line =
                    words.map(|word| corner(word, points).ok_or_else(|| no_corner(word, &at())));
                let line = line.collect::<Result<Vec<usize>, _>>()?;
                ahead.extend(
                    line.iter().max().filter(|last| **last >= points).map(|&n| (number, n)),
                );
                // One point alone is no line.
                if line.len() > 1 {
                    builder.line(line, at)?;
                }
            }
            Some(keyword @ (b"o" | b"g")) => {
                let name = words.map(String::from_utf8_lossy).collect::<Vec<_>>().join(" ");
                let group = if keyword == b"g" { name.as_str() } else { "" };
                next_name = Some(panel_name(if keyword == b"g" { &object } else { &name }, group));
                if keyword == b"o" {
                    object = name;
                }
            }
            _ => {}
        }
    }
    let mut corners = corners.into_iter();
    let mut last = usize::MAX;
    for face in faces {
        let at = || format!("{place}:{}", face.line);
        if last != face.group {
            builder.go_on(&names[face.group], at)?;
            last = face.group;
        }
        let ring: Vec<usize> = corners.by_ref().take(face.count).collect();
        refuse_beyond("face", &ring, points, at)?;
        builder.polygon(&ring, at)?;
    }
    for (number, last) in ahead {
        refuse_beyond("line", &[last], points, || format!("{place}:{number}"))?;
    }
    Ok(())
}

/// Refuses points that the file does not have.
fn refuse_beyond(
    what: &str,
    given: &[usize],
    points: usize,
    at: impl Fn() -> String,
) -> Result<(), InputError> {
    let Some(beyond) = given.iter().find(|&&point| point >= points) else { return Ok(()) };
    let message = format!("the {what} names point {}; the file has {points}", beyond + 1);
    let hint = "Points are counted from 1 through the whole file; export it again.";
    Err(InputError::at(at(), message, hint))
}

/// A face of the file; one common list holds the corners of all faces.
struct Face {
    line: usize,
    group: usize,
    count: usize,
}

/// The name of the panel of a group. Most programs write the object alone, or the same name as
/// object and as group, or `default` and `off` for no group.
fn panel_name(object: &str, group: &str) -> String {
    let is_none = |name: &str| ["", "default", "off"].contains(&name);
    if is_none(group) { object.to_owned() } else { group.to_owned() }
}

/// The index of a point, from 0, of a corner in the notation `7`, `7/1`, `7//3`, or `-1`, which
/// counts back from the last of `points`.
fn corner(word: &[u8], points: usize) -> Option<usize> {
    let number = word.split(|&byte| byte == b'/').next()?;
    let number: i64 = std::str::from_utf8(number).ok()?.parse().ok()?;
    match number {
        1.. => usize::try_from(number - 1).ok(),
        0 => None,
        _ => points.checked_sub(usize::try_from(number.unsigned_abs()).ok()?),
    }
}

fn no_corner(word: &[u8], place: &str) -> InputError {
    InputError::at(
        place,
        format!("{} names no point", quoted(word)),
        "Points are counted from 1, or back from the last one with -1; export it again.",
    )
}

/// The lines of the file, those that end in `\` joined with the next; each with the number of its
/// first line.
fn whole_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut lines = lines(bytes);
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let goes_on = |line: &[u8]| line.trim_ascii_end().ends_with(b"\\");
        if !goes_on(line) {
            return Some((number, Cow::Borrowed(line)));
        }
        let mut whole = line.to_vec();
        while goes_on(&whole) {
            let kept = whole.trim_ascii_end().len() - 1;
            whole.truncate(kept);
            whole.push(b' ');
            let Some((_, next)) = lines.next() else { break };
            whole.extend_from_slice(next);
        }
        Some((number, Cow::Owned(whole)))
    })
}
