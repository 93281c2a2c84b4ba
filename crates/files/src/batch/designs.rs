//! Designs as JSON lines: a `.sheet.json` in one line, one after the other.

use super::lines::{Line, Lines};
use crate::input::{InputFormat, read_bytes};
use crate::reading::{InputError, MAX_INPUT_BYTES, ReadOptions, display_name, io_error};
use serde::Deserialize;
use sheetwright::design::Design;
use std::io::BufRead;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A design in a line.
#[derive(Debug)]
pub struct DesignLine {
    /// Its field `name`, if that can be read.
    pub name: Option<String>,
    /// Its line.
    pub line: u64,
    from: Arc<From>,
    text: Vec<u8>,
    fault: Option<InputError>,
}

/// What the lines are read from.
#[derive(Debug)]
struct From {
    /// How messages name it.
    place: String,
    /// The folder of the tables and meshes that designs name.
    folder: Option<PathBuf>,
}

impl DesignLine {
    /// About how much memory it takes, bytes.
    pub fn size(&self) -> usize {
        self.text.len()
    }

    /// The design.
    ///
    /// # Errors
    /// As those of a design in a file of its own; places are lines of the input.
    pub fn design(&self, options: &ReadOptions) -> Result<Design, InputError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        let From { place, folder } = &*self.from;
        let here = format!("{place}:{}", self.line);
        let read = read_bytes(InputFormat::Design, &self.text, &here, folder.as_deref(), options);
        read.map_err(|error| {
            // The line of the design is the first of its own; that of the input stands before it.
            let first = format!("{here}:1:");
            let shown = error.place.map(|place| place.replacen(&first, &format!("{here}:"), 1));
            InputError { place: shown, ..error }
        })
    }
}

/// Reads the designs of a stream; empty lines count and are left out.
#[derive(Debug)]
pub struct DesignLines<R> {
    lines: Lines<R>,
    from: Arc<From>,
    is_at_end: bool,
}

impl<R: BufRead> DesignLines<R> {
    /// Reads from a file of this name, or from standard input, `-`. Tables and meshes that designs
    /// name lie in `folder`.
    pub fn new(from: R, name: &str, folder: Option<&Path>) -> Self {
        let (place, folder) = (display_name(name).to_owned(), folder.map(Path::to_owned));
        let most = usize::try_from(MAX_INPUT_BYTES).unwrap_or(usize::MAX);
        Self {
            lines: Lines::new(from, most),
            from: From { place, folder }.into(),
            is_at_end: false,
        }
    }
}

impl<R: BufRead> Iterator for DesignLines<R> {
    type Item = Result<DesignLine, InputError>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut text = Vec::new();
        while !self.is_at_end {
            let place = &self.from.place;
            let fault = match self.lines.read(&mut text) {
                Err(error) => {
                    self.is_at_end = true;
                    return Some(Err(io_error(place, &error)));
                }
                Ok(Line::End) => break,
                Ok(Line::Read) if text.trim_ascii().is_empty() => continue,
                Ok(Line::Read) => None,
                Ok(Line::TooLong) => {
                    let place = format!("{place}:{}", self.lines.number);
                    let hint = "Give each design a line of its own.";
                    Some(InputError::at(place, "the line is larger than 256 MiB", hint))
                }
            };
            let name = name_in(&text);
            let (line, from) = (self.lines.number, self.from.clone());
            return Some(Ok(DesignLine { name, line, from, text, fault }));
        }
        None
    }
}

/// The name that a design gives itself, if its line is JSON.
fn name_in(text: &[u8]) -> Option<String> {
    #[derive(Deserialize)]
    struct NameOnly {
        name: String,
    }
    // Programs of Windows put a mark before a text.
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    serde_json::from_slice::<NameOnly>(text).ok().map(|only| only.name)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;

    #[test]
    fn a_mark_before_the_text_takes_no_name_away() {
        assert_eq!(name_in(b"\xef\xbb\xbf{\"name\": \"a\"}").as_deref(), Some("a"));
    }

    #[test]
    fn each_line_is_a_design_or_an_error_of_its_own() {
        let text = "{\"sheetwright\":1,\"name\":\"a\",\"curves\":{\"r\":{\"kind\":\"polyline\",\
                    \"closed\":true,\"points\":[[0,0,0],[9,0,0],[9,9,0]]}},\"panels\":[{\"name\":\
                    \"p\",\"boundary\":[\"r\"]}]}\n\n{\"sheetwright\":1,\n{\"name\": \"b\"}\n";
        let lines: Vec<DesignLine> =
            DesignLines::new(text.as_bytes(), "-", None).map(Result::unwrap).collect();
        let heads: Vec<_> = lines.iter().map(|l| (l.line, l.name.as_deref())).collect();
        assert_eq!(heads, [(1, Some("a")), (3, None), (4, Some("b"))]);
        let read = |n: usize| lines[n].design(&ReadOptions::default());
        assert_eq!(read(0).unwrap().name, "a");
        let place = read(1).unwrap_err().place.unwrap();
        assert!(place.starts_with("standard input:3:") && !place.contains(":1:"), "{place}");
        assert!(read(2).is_err());
    }
}
